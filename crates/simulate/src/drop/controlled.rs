//! A drop or machine whose controllers are not of its file: whoever has them is asked at every sample.
//!
//! The machine is driven from outside at the instants at which its own controllers, which the linear analysis and the start take, would
//! sample and release: a controller that computes what these do gives the same numbers.

use crate::drop::driven::{Commands, Driven, Driving, Reached};
use crate::drop::each::One;
use levitation::Timing;
use model::magnets::ControlEvent;
use model::system::machine::Event;
use outcome::options::{Controller, Options};
use outcome::{Attached, Attachment, Outcome, Stop};
use std::path::Path;
use std::sync::atomic::Ordering;

/// Runs it with the controller in a file.
pub(super) fn run(one: &One, file: &str, options: &Options) -> Outcome {
    let controlled = Driving {
        commands: commands(one),
        keep_history: one.member.keep_rows,
        stops_at_contacts: false,
    };
    match Driven::of(one, controlled) {
        Err(problem) => Outcome::not_built(&problem),
        Ok(mut driven) => {
            let ended = begun(file, options)
                .map_err(|why| (0.0, why))
                .and_then(|mut controller| drive(one, &mut driven, &mut *controller, options));
            let mut outcome = driven.outcome();
            if let Err((time, why)) = ended {
                outcome.stop = Stop {
                    reason: "controller",
                    time,
                    text: format!("{file} at {time:.6} s: {why}."),
                };
            } else if options.interrupt.load(Ordering::Relaxed) && !outcome.stop.complete() {
                outcome.stop = crate::ending::interrupted(driven.time());
            }
            let content = options.controllers.and_then(|own| own.content(file));
            if let (Some(content), true) = (content, one.member.keep_rows) {
                let name = Path::new(file).file_name();
                outcome.files.push(Attachment {
                    name: name.map_or_else(String::new, |own| own.to_string_lossy().into_owned()),
                    content: Attached::Bytes(content),
                });
            }
            outcome
        }
    }
}

fn begun(file: &str, options: &Options) -> Result<Box<dyn Controller>, String> {
    match options.controllers {
        Some(own) => own.start(file),
        None => Err("units are run by the command auxbear run alone".to_string()),
    }
}

/// What the commands of its magnets are.
fn commands(one: &One) -> Commands {
    let control = (one.member.machine.constants.magnets.as_ref()).and_then(|own| own.control());
    let volts = control.is_some_and(|own| own.levitation.takes_volts());
    match volts {
        true => Commands::Voltage,
        false => Commands::Current,
    }
}

/// Goes through the samples of its run; what the controller refused, and when, s.
fn drive(
    one: &One,
    driven: &mut Driven,
    controller: &mut dyn Controller,
    options: &Options,
) -> Result<(), (f64, String)> {
    let schedule = &one.member.machine.constants.schedule;
    let mut samples = schedule
        .all()
        .filter_map(|(time, event)| match event {
            Event::Control(event @ (ControlEvent::Sample | ControlEvent::Release)) => {
                Some((time, event))
            }
            _ => None,
        })
        .peekable();
    let machine = &one.member.machine;
    let control = (machine.constants.magnets.as_ref()).and_then(|own| own.control());
    let period = match control.map(|own| own.levitation.timing()) {
        Some(Timing::Sampled { period, .. }) => period,
        _ => return Ok(()),
    };
    let mut asked =
        |driven: &mut Driven| asked(driven, controller, (machine.axes().count(), period));
    let mut commands = None;
    if driven.powered() {
        commands = Some(asked(driven)?);
    }
    // without computing time the first sample is released in the start already
    if !matches!(samples.peek(), Some((_, ControlEvent::Release))) {
        put(driven, commands.take())?;
    }
    for (time, event) in samples {
        if let Reached::End(_) = driven.advance(time, options.interrupt) {
            return Ok(());
        }
        (options.progress)(time / driven.end());
        if !driven.powered() {
            continue;
        }
        match event {
            ControlEvent::Sample => commands = Some(asked(driven)?),
            _ => put(driven, commands.take())?,
        }
    }
    driven.advance(f64::INFINITY, options.interrupt);
    Ok(())
}

/// The commands of a sample.
fn asked(
    driven: &mut Driven,
    controller: &mut dyn Controller,
    (axes, period): (usize, f64),
) -> Result<Vec<f64>, (f64, String)> {
    let time = driven.time();
    let found = controller.sample(time, &driven.signals(), period);
    let found = found.map_err(|why| (time, why))?;
    let wrong = found.iter().find(|own| !own.is_finite());
    match (found.len() == axes, wrong) {
        (true, None) => Ok(found),
        (true, Some(value)) => Err((time, format!("its command is {value}"))),
        (false, _) => Err((
            time,
            format!(
                "it gives {} commands, and {axes} axes of magnets need one each",
                found.len()
            ),
        )),
    }
}

/// Holds commands from now on.
fn put(driven: &mut Driven, commands: Option<Vec<f64>>) -> Result<(), (f64, String)> {
    for (axis, command) in commands.into_iter().flatten().enumerate() {
        let time = driven.time();
        (driven.change(axis, command)).map_err(|problem| (time, problem.to_string()))?;
    }
    Ok(())
}
