//! A drop or machine that is driven from outside, without its controllers: commands, forces, torque and motion of the base go in at
//! stops; what comes out are the columns of its history, an instant at a time, and at the end the results of its run.
//!
//! It takes the steps of its run: commands that change where those of its own sampled controllers did give the same bits.

use crate::drop::build::DropModel;
use crate::drop::context::{Context, Setup};
use crate::drop::driven_columns::{self as table, Variable};
use crate::drop::each::One;
use crate::drop::warning_table::{ShaftWarning, TOUCHES_WITH_POWER};
use crate::drop::{columns, events, outcome};
use crate::ending::{settings_at, stop};
use crate::ensemble::Member;
use crate::stepping::Stepping;
use crate::watch::Watch;
pub use levitation::Commands;
use model::system::machine::driven::{Driver, NotDriven, Outside, driver};
use model::system::machine::record::Record;
use model::system::machine::{MOST_LOADED, Mode, RotorMachine};
use outcome::{Column, Outcome, Stop};
use problem::{Code, Problem};
use scenario::{Scenario, problem_at};
use solve::{Ending, Flow, Observer, Pause, Saved, Step};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// How a machine is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Driving {
    /// What the commands of its magnets are.
    pub commands: Commands,
    /// Whether the rows of its history are kept for the results of its run.
    pub keep_history: bool,
    /// Whether it pauses behind each step in which a contact of rotor and race begins or ends.
    pub stops_at_contacts: bool,
}

/// Where a machine that was to go on stands.
#[derive(Clone, Debug, PartialEq)]
pub enum Reached {
    /// At the time that was asked for.
    Time,
    /// Earlier: a contact has begun or ended in the step that ends here.
    Contact,
    /// At its end.
    End(Stop),
}

/// What an input changes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Target {
    /// A command, by its channel.
    Command(usize),
    Torque,
    /// A force at a loaded node, along x or y.
    Force(usize, usize),
    Base(usize),
}

/// A machine on its way.
pub struct Driven {
    commands: Commands,
    scenario: Scenario,
    built: Arc<DropModel>,
    member: Member,
    stepping: Stepping,
    driver: Box<dyn Driver>,
    watch: Watching,
    inputs: Vec<(Variable, Target)>,
    values: Vec<f64>,
    changed: bool,
    /// Values of the outputs at the time that is reached, where all were read.
    shown: Option<Vec<f64>>,
    /// Outputs that the state alone shows, by their places.
    quick: Vec<Option<table::Quick>>,
}

/// A machine at a stop, with all that its further steps depend on.
#[derive(Clone)]
pub struct DrivenState {
    saved: Saved<'static, RotorMachine>,
    watch: Watching,
    values: Vec<f64>,
    changed: bool,
}

/// A watch that may want a pause.
#[derive(Clone)]
struct Watching {
    watch: Watch,
    stops: bool,
    touched: [usize; 2],
    owes_stop: bool,
}

impl Observer<RotorMachine> for Watching {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        let flow = self.watch.step(step);
        if !self.stops {
            return flow;
        }
        let touched = self.watch.record.touched();
        self.owes_stop |= touched != self.touched;
        self.touched = touched;
        // a machine that is renewed pauses a step later
        match flow {
            Flow::Continue if self.owes_stop => {
                self.owes_stop = false;
                Flow::Pause
            }
            flow => flow,
        }
    }
    fn renewed(
        &mut self,
        of: &RotorMachine,
        time: f64,
        state: &[f64],
    ) -> Option<Box<RotorMachine>> {
        self.watch.renewed(of, time, state)
    }
    fn switched(
        &mut self,
        machine: &RotorMachine,
        mode: &Mode<f64>,
        time: f64,
        state: &[f64],
    ) -> Flow {
        self.watch.switched(machine, mode, time, state)
    }
}

impl Driven {
    /// A machine at its start.
    ///
    /// # Errors
    /// Where amplifiers take no such commands, forces would act at too many nodes, or it coasts on until its standstill.
    pub fn new(
        scenario: &Scenario,
        built: &Arc<DropModel>,
        way: Driving,
    ) -> Result<Self, Box<Problem>> {
        Self::of(&One::of(scenario, built.clone()), way)
    }

    /// The machine of a drop that is ready to run, at its start.
    pub(super) fn of(one: &One, way: Driving) -> Result<Self, Box<Problem>> {
        let (scenario, built) = (one.scenario, &one.built);
        if built.drop.coast_down.is_some() {
            let found = "\"standstill\"";
            let needed = "\"duration\" is needed of a machine that is driven from outside: it stops where its caller stops it, at run.duration \
                          at the latest";
            return Err(problem_at(Code::Conflict, "run.until", found, needed));
        }
        let (run, stepping) = (&built.drop.run, one.stepping);
        let own = &one.member.machine;
        let pushed: Vec<Vec<f64>> = match &built.shaft {
            Some(shaft) => shaft.forces.iter().map(|own| own.node.clone()).collect(),
            None => vec![vec![1.0]],
        };
        let driven = own.without_controllers(way.commands, &one.member.start, &pushed);
        let (machine, start) = driven.map_err(|fault| refused(built, way.commands, fault))?;
        let setup = Setup {
            built,
            machine: &machine,
        };
        let inputs = inputs(setup, way.commands, &start, pushed.len());
        let quick = table::quick(setup, &outputs(setup));
        let interval = way.keep_history.then_some(run.output_interval);
        let record = Record::with_taps(&machine, run.duration, interval, &[]);
        let record = record.staying_within(events::within(&built.drop));
        let member = Member {
            following: one.member.following.clone(),
            keep_rows: way.keep_history,
            ..Member::of(machine, start)
        };
        let settings = settings_at(run, stepping.tolerance);
        Ok(Driven {
            commands: way.commands,
            quick,
            scenario: scenario.clone(),
            driver: driver(
                member.machine.clone(),
                &member.start,
                settings,
                stepping.steps,
            ),
            watch: Watching {
                watch: Watch::of(&member, record),
                stops: way.stops_at_contacts,
                touched: [0; 2],
                owes_stop: false,
            },
            values: inputs.iter().map(|(own, _)| own.start).collect(),
            inputs,
            changed: false,
            shown: None,
            built: built.clone(),
            member,
            stepping,
        })
    }

    /// What goes in, in a fixed order.
    pub fn inputs(&self) -> impl Iterator<Item = &Variable> {
        self.inputs.iter().map(|(own, _)| own)
    }
    /// What comes out, in a fixed order; columns without values.
    pub fn outputs(&self) -> Vec<Column> {
        outputs(self.setup())
    }
    /// Inputs, by their places, on which an output depends at once, without a step between.
    pub fn feeds(&self, output: &Column) -> Vec<usize> {
        table::feeds(self.setup(), output, self.inputs())
    }
    /// The time that is reached, s.
    pub fn time(&self) -> f64 {
        self.driver.time()
    }
    /// When its run ends at the latest, s.
    pub fn end(&self) -> f64 {
        self.built.drop.run.duration
    }
    /// The value of an input.
    pub fn input(&self, input: usize) -> f64 {
        self.values[input]
    }
    /// Changes an input from the time on that is reached.
    ///
    /// # Errors
    /// A number that is not finite.
    pub fn change(&mut self, input: usize, value: f64) -> Result<(), Box<Problem>> {
        if !value.is_finite() {
            let name = &self.inputs[input].0.name;
            let found = format!("{value} at {} s", self.time());
            return Err(problem_at(
                Code::Impossible,
                name,
                found,
                "a finite number is needed",
            ));
        }
        if self.values[input].to_bits() != value.to_bits() {
            self.values[input] = value;
            self.changed = true;
        }
        Ok(())
    }

    /// Puts changed inputs in.
    fn act(&mut self) {
        if !std::mem::take(&mut self.changed) {
            return;
        }
        self.shown = None;
        let (machine, time) = (self.member.machine.clone(), self.driver.time());
        let (inputs, values) = (&self.inputs, &self.values);
        self.driver.change(&mut |mode, state| {
            let mut outside = Outside::NONE;
            for ((_, target), value) in inputs.iter().zip(values) {
                match *target {
                    Target::Command(channel) => state[channel] = *value,
                    Target::Torque => outside.torque = *value,
                    Target::Force(node, 0) => mode.loads[node].x = *value,
                    Target::Force(node, _) => mode.loads[node].y = *value,
                    Target::Base(0) => outside.base.x = *value,
                    Target::Base(_) => outside.base.y = *value,
                }
            }
            machine.act_from_outside(mode, time, outside);
        });
    }

    /// Goes on to a time, s, which ends a step.
    pub fn advance(&mut self, until: f64, interrupt: &AtomicBool) -> Reached {
        self.act();
        if until > self.time() && self.driver.ending().is_none() {
            self.shown = None;
            self.driver.advance(until, &mut self.watch, interrupt);
        }
        match self.driver.pause() {
            Some(Pause::Wanted) if self.time() < until => Reached::Contact,
            Some(Pause::Ended(_)) => match self.driver.ending() {
                Some(ending) => Reached::End(stop(&ending)),
                None => Reached::Time,
            },
            _ => Reached::Time,
        }
    }

    /// The value of an output at the time that is reached; not a number where there is none.
    pub fn read(&mut self, output: usize) -> f64 {
        self.act();
        let (time, machine) = (self.driver.time(), &self.member.machine);
        if let (None, Some(quick)) = (&self.shown, self.quick[output]) {
            return quick.read(machine, time, &self.driver.state());
        }
        if self.shown.is_none() {
            let watch = self.watch.watch.at(machine, time, &self.driver.state());
            let finished = watch.finish(self.ending(), &self.member);
            let context = self.context(&finished);
            let mut list = columns::history(context.setup, Some(&context));
            list.extend(table::columns(context.setup, Some(&context)));
            list.retain(|own| !own.optional && own.name != "time");
            let last = |own: &Column| own.values.last().copied().unwrap_or(f64::NAN);
            self.shown = Some(list.iter().map(last).collect());
        }
        let shown = self.shown.as_ref().and_then(|list| list.get(output));
        shown.copied().unwrap_or(f64::NAN)
    }

    /// Whether any magnet has power.
    pub(super) fn powered(&self) -> bool {
        self.member.machine.powered(&self.driver.state())[0]
    }
    /// Signals of all sensor axes, m.
    pub(super) fn signals(&self) -> Vec<f64> {
        let state = self.driver.state();
        let all = self.member.machine.sensed(self.driver.time(), &state);
        all.into_iter().map(|(_, signal)| signal).collect()
    }

    /// What it stands at, to come back to.
    pub fn save(&mut self) -> DrivenState {
        DrivenState {
            saved: self.driver.save(),
            watch: self.watch.clone(),
            values: self.values.clone(),
            changed: self.changed,
        }
    }
    /// Goes back to where it was saved: from there it has the bits that it had.
    pub fn restore(&mut self, state: &DrivenState) {
        self.driver.restore(&state.saved);
        self.watch = state.watch.clone();
        self.values.clone_from(&state.values);
        self.changed = state.changed;
        self.shown = None;
    }

    /// The results of its run until now; with its history where that was kept.
    pub fn outcome(&mut self) -> Outcome {
        let ending = self.ending();
        let ended = self.driver.ending().is_some();
        let finished = self.watch.watch.clone().finish(ending, &self.member);
        let context = self.context(&finished);
        let mut one = One::of(&self.scenario, self.built.clone());
        one.member = self.member.clone();
        one.stepping = self.stepping;
        let mut outcome = outcome(&one, &context, None);
        if !ended {
            outcome.stop.text = format!(
                "Ended at {:.6} s by whoever drove the machine.",
                self.driver.time()
            );
        }
        outcome
    }

    /// The same of a machine that its caller has driven, and not the controllers of its file.
    pub fn outcome_from_outside(&mut self) -> Outcome {
        let mut outcome = self.outcome();
        // what is said of controllers is of those of the file
        (outcome.warnings).retain(|warning| !warning.is(TOUCHES_WITH_POWER));
        let of_magnets = match self.commands {
            _ if self.member.machine.command(0).is_none() => "",
            Commands::Current => {
                "the currents of its magnets, in place of the controllers of the file, "
            }
            Commands::Voltage => {
                "the voltages of its magnets, in place of the controllers of the file, "
            }
            Commands::Force => {
                "the forces of its magnets, in place of the file's magnets and controllers, "
            }
        };
        let commands = format!("{of_magnets}torque, forces and motion of the base");
        outcome
            .warnings
            .insert(0, ShaftWarning::DrivenFromOutside { commands }.into());
        outcome.title += ", driven from outside";
        outcome
    }

    /// How it would have ended here.
    fn ending(&self) -> Ending {
        self.driver.ending().unwrap_or_else(|| Ending {
            stop: solve::Stop::Interrupted,
            time: self.driver.time(),
            state: self.driver.state(),
            work: self.driver.work(),
        })
    }
    fn setup(&self) -> Setup<'_> {
        Setup {
            built: &self.built,
            machine: &self.member.machine,
        }
    }
    fn context<'a>(&'a self, finished: &'a crate::ensemble::Finished) -> Context<'a> {
        Context {
            setup: self.setup(),
            finished,
            repeated: false,
            reached: finished.record.reached,
            end: finished.ending.time,
        }
    }
    /// Its scenario.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }
}

/// What comes out.
fn outputs(setup: Setup) -> Vec<Column> {
    let mut list = columns::history(setup, None);
    list.extend(table::columns(setup, None));
    list.retain(|own| !own.optional && own.name != "time");
    list
}

/// What goes in.
fn inputs(
    setup: Setup,
    commands: Commands,
    start: &[f64],
    pushed: usize,
) -> Vec<(Variable, Target)> {
    let machine = setup.machine;
    let mut list = Vec::new();
    for (axis, own) in machine.axes().enumerate() {
        if let Some(channel) = machine.command(axis) {
            let variable = table::command(setup, (axis, own), commands, start[channel]);
            list.push((variable, Target::Command(channel)));
        }
    }
    list.push((table::torque(), Target::Torque));
    let first = machine.first_pushed(pushed);
    for place in 0..pushed {
        for along in 0..2 {
            let variable = table::force(setup, place, along);
            list.push((variable, Target::Force(first + place, along)));
        }
    }
    if machine.constants.base.is_some() {
        list.extend((0..2).map(|along| (table::base(along), Target::Base(along))));
    }
    list
}

/// Why a machine cannot be driven so.
fn refused(built: &DropModel, commands: Commands, fault: NotDriven) -> Box<Problem> {
    match fault {
        NotDriven::Nodes => {
            let found = format!("forces from outside at more than {MOST_LOADED} nodes");
            let needed =
                "fewer [[rotor.force]], or fewer nodes at which events put loads, are needed";
            problem_at(Code::Conflict, "rotor.force", found, needed)
        }
        NotDriven::Amplifier(axis) => {
            let given = built.drop.shaft.as_deref();
            let name = given.map_or_else(String::new, |own| {
                crate::drop::magnets::value_of(own, axis, "amplifier")
            });
            let (found, needed) = match commands {
                Commands::Voltage => (
                    format!("{name}, which has no voltage"),
                    "inductance and resistance of the coils are needed for voltages; currents are the other input",
                ),
                _ => (
                    format!("{name}, whose commands are voltages"),
                    "voltages are needed as input, or an amplifier that controls its current",
                ),
            };
            problem_at(Code::Conflict, "levitation.magnet", found, needed)
        }
    }
}
