//! `auxbear fmu`: the machine without its controllers as a co-simulation unit.

use crate::arguments::{Fmu, stem};
use crate::console;
use auxbear::problem::Result;
use auxbear::run::Commands;
use auxbear_fmu::Version;
use auxbear_fmu::package::{library_in, written};
use auxbear_fmu::variables::{Role, Variable};
use std::path::{Path, PathBuf};

/// Writes the unit, and prints what it holds.
pub fn perform(wish: &Fmu) -> Result<()> {
    let scenario = wish.given.read()?;
    let mut libraries = wish.library.clone();
    if libraries.is_empty() {
        let program = std::env::current_exe().ok();
        libraries.push(library_in(program.as_deref().and_then(Path::parent))?);
    }
    let beside = || PathBuf::from(format!("{}.fmu", stem(&wish.given.file)));
    let out = wish.out.clone().unwrap_or_else(beside);
    let unit = written(&scenario, (&wish.input, &wish.version), &libraries, &out)?;
    let count = |of: fn(&Role) -> bool| unit.variables.iter().filter(|own| of(&own.role)).count();
    let mut text = format!(
        "{}\nFMI {} for co-simulation: {} inputs, {} outputs, {} parameters\n",
        out.display(),
        match unit.version {
            Version::Two => "2.0",
            Version::Three => "3.0",
        },
        count(|role| matches!(role, Role::Input(_))),
        count(|role| matches!(role, Role::Output(..))),
        count(|role| matches!(role, Role::Parameter(_) | Role::Choice(_))),
    );
    for (folder, path) in &unit.platforms {
        text += &format!("{folder}: {}\n", path.display());
    }
    let of_magnets =
        |own: &&Variable| matches!(own.role, Role::Input(_)) && own.name.starts_with("magnet.");
    text += match (unit.variables.iter().find(of_magnets), unit.commands) {
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
