//! `auxbear signals`, `auxbear identify` and `auxbear rotor`: each takes files of its own system alone, the last one machines too.

use crate::arguments::Measured;
use crate::exit::Exit;
use crate::run;
use auxbear::problem::{Code, Problem, Result};
use auxbear::scenario::SystemName;

/// Computes what a file of this system asks for.
pub fn perform(wish: &Measured, wanted: SystemName) -> Result<Exit> {
    let mut scenario = wish.given.read()?;
    if !wanted.reads_measurements()
        && let Some(rotor) = scenario.rotor_alone()
    {
        scenario = rotor?;
    }
    let system = scenario.system.name();
    if system != wanted {
        let (found, wanted) = (system.word(), wanted.word());
        let found = format!("system = \"{found}\"");
        let needed = format!("system = \"{wanted}\" is needed; auxbear run runs any system");
        let problem = Problem::at_path(Code::UnknownWord, &wish.given.file, found, needed);
        return Err(problem.on_key("system"));
    }
    let path = wish.output.place(&wish.given.name());
    run::execute(&scenario, &path, None, wish.output.quiet)
}
