//! `auxbear run`.

use crate::arguments::Run;
use crate::exit::Exit;
use crate::progress::{Busy, Progress};
use crate::{console, summary};
use auxbear::outcome::Stop;
use auxbear::outcome::options::Controllers;
use auxbear::problem::{Code, Problem, Result};
use auxbear::report::directory::{NewDirectory, besides, has_members, path_of_run};
use auxbear::run::Options;
use auxbear::scenario::{BuiltIn, Scenario};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use std::{fs, process};

/// Set by the first Ctrl-C.
pub static INTERRUPT: AtomicBool = AtomicBool::new(false);
/// The unfinished run directory, once there is one.
static PARTIAL: Mutex<Option<PathBuf>> = Mutex::new(None);

/// Signals within this time are one: job systems send theirs to a process and again to its group.
const ECHO: Duration = Duration::from_millis(500);

/// Simulates a scenario and writes its run directory.
pub fn perform(wish: &Run) -> Result<Exit> {
    let threads = wish.threads.as_deref().map(threads).transpose()?;
    let mut sets = wish.given.set.clone();
    // As an override it is checked like any value, and the resolved file repeats it.
    sets.extend(wish.repeat.iter().map(|n| format!("repeat.count={n}")));
    let scenario = Scenario::read(&wish.given.file, &sets, &BuiltIn)?;
    #[cfg(feature = "fmu")]
    let scenario = auxbear_fmu::controller::checked(&scenario)?.unwrap_or(scenario);
    let free = || path_of_run(&wish.given.name(), &scenario);
    let path = wish.output.out.clone().unwrap_or_else(free);
    execute(&scenario, &path, threads, wish.output.quiet)
}

/// Who has controllers that a file names.
pub fn controllers() -> Option<&'static dyn Controllers> {
    #[cfg(feature = "fmu")]
    return Some(&auxbear_fmu::controller::Units);
    #[cfg(not(feature = "fmu"))]
    return None;
}

/// The number of threads asked for.
pub fn threads(text: &str) -> Result<NonZeroUsize> {
    text.trim().parse().map_err(|_| {
        let found = format!("\"{text}\"");
        let needed = "a whole number from 1 on is needed; without it all cores are used";
        Problem::new(Code::OutOfRange, "auxbear run", found, needed).on_key("--threads")
    })
}

/// Runs a scenario, writes its run directory and prints what came out.
pub fn execute(
    scenario: &Scenario,
    path: &Path,
    threads: Option<NonZeroUsize>,
    quiet: bool,
) -> Result<Exit> {
    listen(false);
    let progress = Progress::new(quiet);
    let options = Options {
        threads: threads.map(usize::from),
        interrupt: &INTERRUPT,
        progress: &|fraction| progress.show(fraction),
        controllers: controllers(),
        rows: None,
    };
    let busy = (!quiet).then(|| Busy::building(scenario));
    let machine = auxbear::run::build(scenario).inspect_err(|_| progress.end())?;
    drop(busy);
    let directory =
        NewDirectory::of_run(path, scenario, machine.members()).inspect_err(|_| progress.end())?;
    let there = directory.there;
    if there > 0 {
        let besides = match besides(directory.partial()) {
            names if names.is_empty() => String::new(),
            names => format!("; left as it is, of the run before: {}", names.join(", ")),
        };
        console::report(&format!(
            "goes on: {there} of {} members are there{besides}",
            machine.members()
        ));
    }
    if let Ok(mut partial) = PARTIAL.lock() {
        *partial = Some(directory.partial().to_path_buf());
    }
    let outcome = machine.run_kept(&options, directory.store());
    progress.end();
    directory.finish(scenario, &outcome)?;
    let printed = match quiet {
        true => Ok(()),
        false => console::print(&summary::text(path, &outcome)),
    };
    console::warn(&outcome.warnings);
    printed?;
    let exit = exit_of(&outcome.stop);
    let word = match exit {
        Exit::Done => return Ok(exit),
        Exit::Interrupted => "interrupted",
        _ => "run failed",
    };
    let text = outcome.stop.text.trim_end_matches('.');
    let goes_on = match exit == Exit::Interrupted && machine.members() > 1 {
        true => "; the same call goes on from there",
        false => "",
    };
    console::report(&format!(
        "{word}: {text}. What was computed is in {}{goes_on}",
        path.display()
    ));
    Ok(exit)
}

fn exit_of(stop: &Stop) -> Exit {
    match stop.reason {
        _ if stop.complete() => Exit::Done,
        "interrupted" => Exit::Interrupted,
        _ => Exit::Failed,
    }
}

/// The first Ctrl-C (or termination) ends the run and keeps what was computed; one that follows later, or one before there is
/// anything to keep, ends the program and takes the unfinished directory away. What `keeps` its parts as they are computed has
/// always something to keep.
pub fn listen(keeps: bool) {
    let mut first = None;
    let handler = move || {
        let first = first.get_or_insert_with(Instant::now);
        let again = INTERRUPT.swap(true, Ordering::Relaxed) && first.elapsed() > ECHO;
        let Ok(partial) = PARTIAL.lock() else {
            return;
        };
        match partial.as_ref() {
            Some(partial) if again => {
                // members of a repetition stay: the next call goes on from them
                if !has_members(partial) {
                    let _ = fs::remove_dir_all(partial);
                }
            }
            Some(_) => return,
            None if keeps && !again => return,
            None if keeps => {}
            // Nothing is computed yet that could be kept: the input is read, or the machine built.
            None => console::report("interrupted: nothing was computed yet"),
        }
        process::exit(130);
    };
    if let Err(error) = ctrlc::set_handler(handler) {
        console::report(&format!("an interrupt will not keep results: {error}"));
    }
}
