//! `auxbear signals`.

use crate::arguments::Signals;
use crate::{Exit, run};
use auxbear::problem::{Code, Problem};
use auxbear::report::directory::free_path;
use auxbear::scenario::{BuiltIn, Scenario, SystemName};

/// Computes what a measurement holds, by a file of the system `signals`.
pub fn perform(wish: &Signals) -> Result<Exit, Box<Problem>> {
    let scenario = Scenario::read(&wish.file, &wish.set, &BuiltIn)?;
    let system = scenario.system.name();
    if system != SystemName::Signals {
        let problem = Problem::at_path(
            Code::UnknownWord,
            &wish.file,
            format!("system = \"{}\"", system.word()),
            "system = \"signals\" is needed; auxbear run runs any system",
        );
        return Err(Box::new(problem.on_key("system")));
    }
    let path = wish.out.clone().unwrap_or_else(|| {
        let stem = wish.file.file_stem().unwrap_or_default();
        free_path(&stem.to_string_lossy())
    });
    run::execute(&scenario, &path, None, wish.quiet)
}
