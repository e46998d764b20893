//! The command `auxbear`: reads the command line, calls the library, prints. No physics and no default values of its own.

#![forbid(unsafe_code)]

mod arguments;
mod bearings;
mod console;
mod digits;
mod exit;
#[cfg(feature = "fmu")]
mod fmu;
mod import;
mod limits;
mod measured;
mod mount;
mod progress;
mod qualify;
mod results;
mod run;
mod schema;
mod service;
mod start;
mod stiffness;
mod studio;
mod study;
mod summary;
mod torque;
mod torque_tables;
mod validation;

use arguments::{Arguments, Command};
use auxbear::problem::explain::explain;
use auxbear::problem::{Code, Result};
use auxbear::report::directory;
use auxbear::report::export::{self, Format};
use auxbear::run::panic_is_caught;
use auxbear::scenario::SystemName;
use clap::Parser;
use exit::Exit;
use progress::Busy;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn main() -> ExitCode {
    measured_quietly();
    full_files_are_errors();
    auxbear::run::start_pool();
    let performed = match Arguments::try_parse() {
        Ok(arguments) => perform(&arguments.command),
        Err(told) if told.use_stderr() => told.exit(),
        // help and version are results like any other
        Err(told) => console::print(&told.render().to_string()).map(|()| Exit::Done),
    };
    let exit = match performed {
        Ok(exit) => exit,
        Err(problem) => {
            console::report(&problem.to_string());
            match problem.code {
                Code::OutputFailed => Exit::Failed,
                _ => Exit::WrongInput,
            }
        }
    };
    exit.into()
}

/// A damaged measurement file may make the library that unpacks it panic: the reader catches that and reports it as a problem.
fn measured_quietly() {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !panic_is_caught() {
            usual(panic);
        }
    }));
}

/// A file that meets the limit of its size ends a program by a signal, without a word. Once somebody listens to that, the write
/// fails as on a full disk: what could be written is kept, and the error says so.
fn full_files_are_errors() {
    #[cfg(unix)]
    {
        let met = std::sync::Arc::default();
        // where it cannot be listened to, the signal ends the program as before
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, met);
    }
}

fn perform(command: &Command) -> Result<Exit> {
    match command {
        Command::Run(wish) => return run::perform(wish),
        Command::Study(wish) => return study::perform(wish),
        Command::Studio(wish) => return studio::perform(wish),
        Command::Qualify(wish) => return qualify::perform(wish),
        Command::Torque(wish) => return torque::perform(wish),
        Command::Signals(wish) => return measured::perform(wish, SystemName::Signals),
        Command::Identify(wish) => return measured::perform(wish, SystemName::Identify),
        Command::Rotor(wish) => return measured::perform(wish, SystemName::Rotor),
        Command::Mount(wish) => return mount::perform(wish),
        Command::Import(wish) => import::perform(wish)?,
        #[cfg(feature = "fmu")]
        Command::Fmu(wish) => fmu::perform(wish)?,
        Command::Check(given) => {
            let scenario = given.read()?;
            #[cfg(feature = "fmu")]
            auxbear_fmu::controller::there(&scenario)?;
            run::listen(false);
            let busy = Busy::building(&scenario);
            let machine = auxbear::run::build(&scenario)?;
            auxbear::run::of_other_cases(&scenario, &machine)?;
            drop(busy);
            console::print(&scenario.resolved.toml())?;
            console::warn(&machine.warnings());
        }
        Command::Results(given) => results::perform(given)?,
        Command::New { kind, path } => start::perform(kind, path.as_deref())?,
        Command::Schema { kind } => schema::perform(kind)?,
        Command::Report { directories, out } => report(directories, out.as_deref())?,
        Command::Export {
            directory,
            csv,
            out,
            only,
            ..
        } => {
            let format = if *csv { Format::Csv } else { Format::Xlsx };
            let written = export::export(directory, format, out.as_deref(), only)?;
            console::print(&format!("{}\n", written.display()))?;
        }
        Command::Validate { cases, all, json } => {
            return validation::perform(cases.as_deref(), *all, *json);
        }
        Command::Service(wish) => service::perform(wish)?,
        Command::Explain { code } => console::print(&explain(code)?)?,
        Command::Bearings { command } => bearings::perform(command)?,
    }
    Ok(Exit::Done)
}

fn report(directories: &[PathBuf], out: Option<&Path>) -> Result<()> {
    let written = match (directories, out) {
        ([only], None) => directory::rewrite_report(only)?,
        (_, out) => {
            let file = out.unwrap_or(Path::new("comparison.html"));
            directory::write_report(file, directories)?;
            file.to_path_buf()
        }
    };
    console::print(&format!("{}\n", written.display()))
}
