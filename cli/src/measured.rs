//! `auxbear signals`, `auxbear identify` and `auxbear rotor`: each takes files of its own system alone, the last one machines too.

use crate::arguments::Measured;
use crate::exit::Exit;
use crate::run;
use auxbear::problem::{Code, Problem, Result};
use auxbear::report::directory::free_path;
use auxbear::scenario::{BuiltIn, Scenario, SystemName};

/// Computes what a file of this system asks for.
pub fn perform(wish: &Measured, wanted: SystemName) -> Result<Exit> {
    let mut scenario = Scenario::read(&wish.file, &wish.set, &BuiltIn)?;
    if !wanted.reads_measurements()
        && let Some(rotor) = scenario.rotor_alone()
    {
        scenario = rotor?;
    }
    let system = scenario.system.name();
    if system != wanted {
        let problem = Problem::at_path(
            Code::UnknownWord,
            &wish.file,
            format!("system = \"{}\"", system.word()),
            format!(
                "system = \"{}\" is needed; auxbear run runs any system",
                wanted.word()
            ),
        );
        return Err(problem.on_key("system"));
    }
    let path = wish.out.clone().unwrap_or_else(|| {
        let stem = wish.file.file_stem().unwrap_or_default();
        free_path(&stem.to_string_lossy())
    });
    run::execute(&scenario, &path, None, wish.quiet)
}
