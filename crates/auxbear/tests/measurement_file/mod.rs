//! Measurement files that are wrong, and what is said of them.

use auxbear::run::build;
use auxbear::scenario::{BuiltIn, Scenario};
use std::fs;

/// The problem that a measurement file of this name and content makes.
pub fn problem(name: &str, content: &str, more: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(name), content).unwrap();
    let text = format!(
        "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"{name}\"\n{more}"
    );
    let file = folder.path().join("a.toml");
    fs::write(&file, text).unwrap();
    let scenario = Scenario::read(&file, &[], &BuiltIn).unwrap();
    let shown = match build(&scenario) {
        Ok(_) => panic!("nothing is found wrong with {name}"),
        Err(problem) => problem.to_string(),
    };
    shown.replace(&format!("{}/", folder.path().display()), "")
}

/// The section of a torque.
pub const TORQUE: &str = "[signals.torque]\nchannel = \"torque\"\n";

/// A table of 40 rows whose time is changed in one of them.
pub fn table(unit: &str, change: &dyn Fn(usize) -> Option<&'static str>) -> String {
    let mut text = format!("time,torque\ns,{unit}\n");
    for row in 0..40 {
        let time = change(row).map_or(format!("{:.3}", row as f64 * 0.001), str::to_string);
        text.push_str(&format!("{time},{}\n", (row * 7) % 11));
    }
    text
}
