//! `auxbear fmu`: the machine without its controller as a co-simulation unit.

use crate::arguments::{Fmu, stem};
use crate::console;
use auxbear::Commands;
use auxbear::problem::{Code, Problem, Result};
use auxbear_fmu::Version;
use auxbear_fmu::package::{Library, Unit, library_name};
use auxbear_fmu::variables::{COMMANDS, Role, Variable};
use std::path::{Path, PathBuf};

/// Writes the unit, and prints what it holds.
pub fn perform(wish: &Fmu) -> Result<()> {
    let words = COMMANDS.map(|(word, _)| word);
    let commands = COMMANDS.iter().find(|(word, _)| *word == wish.input);
    let Some((_, commands)) = commands else {
        return Err(crate::start::unknown("--input", &wish.input, &words));
    };
    let version = match wish.version.as_str() {
        "2" | "2.0" => Version::Two,
        "3" | "3.0" => Version::Three,
        other => return Err(crate::start::unknown("--version", other, &["2", "3"])),
    };
    let scenario = wish.given.read()?;
    let libraries = libraries(&wish.library)?;
    let out =
        (wish.out.clone()).unwrap_or_else(|| format!("{}.fmu", stem(&wish.given.file)).into());
    let unit = Unit {
        scenario: &scenario,
        commands: *commands,
        version,
        libraries: &libraries,
    };
    let list = unit
        .write(&out)
        .map_err(|problem| scenario.locate(problem))?;
    let count = |of: fn(&Role) -> bool| list.iter().filter(|own| of(&own.role)).count();
    let mut text = format!(
        "{}\nFMI {} for co-simulation: {} inputs, {} outputs, {} parameters\n",
        out.display(),
        match version {
            Version::Two => "2.0",
            Version::Three => "3.0",
        },
        count(|role| matches!(role, Role::Input(_))),
        count(|role| matches!(role, Role::Output(..))),
        count(|role| matches!(role, Role::Parameter(_) | Role::Choice(_))),
    );
    for library in &libraries {
        let (folder, path) = (library.folder(version), library.path.display());
        text += &format!("{folder}: {path}\n");
    }
    let of_magnets =
        |own: &&Variable| matches!(own.role, Role::Input(_)) && own.name.starts_with("magnet.");
    text += match (list.iter().find(of_magnets), *commands) {
        (None, _) => {
            "No magnets with controllers act in this file: forces and the torque of the drive are the inputs.\n"
        }
        (Some(_), Commands::Force) => {
            "Forces take the place of the magnets: their stiffness k_s, limits and loss of power are yours to give; events of magnets and \
             controllers have no effect.\n"
        }
        _ => "",
    };
    console::print(&text)
}

/// The libraries that were named, or the one beside the program.
fn libraries(named: &[PathBuf]) -> Result<Vec<Library>> {
    if !named.is_empty() {
        return named.iter().map(|path| Library::read(path)).collect();
    }
    let program = std::env::current_exe().ok();
    let folder = program.as_deref().and_then(Path::parent);
    let beside = folder.map(|folder| folder.join(library_name()));
    match beside.filter(|path| path.is_file()) {
        Some(path) => Ok(vec![Library::read(&path)?]),
        None => {
            let found = format!("no {} beside the program", library_name());
            let needed = "it is needed there, or named by --library: cargo build --release --package auxbear-fmu makes it";
            Err(Problem::new(
                Code::FileUnreadable,
                "auxbear fmu",
                found,
                needed,
            ))
        }
    }
}
