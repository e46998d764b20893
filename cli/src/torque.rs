//! `auxbear torque`.

use crate::arguments::Torque;
use crate::exit::Exit;
use crate::run;
use auxbear::problem::Result;
use auxbear::scenario::{BuiltIn, FORMAT, Scenario};

/// What messages name as the file.
const PLACE: &str = "auxbear torque";

/// Computes the moments of one bearing, by the scenario that the words of the command line make.
pub fn perform(wish: &Torque) -> Result<Exit> {
    let text = format!("format = \"{FORMAT}\"\nsystem = \"torque\"\n");
    let scenario = Scenario::parse(&text, PLACE, &overrides(wish), &BuiltIn)?;
    let path = wish.output.place(&name(&wish.bearing));
    run::execute(&scenario, &path, None, wish.output.quiet)
}

/// Name of a run directory.
fn name(bearing: &str) -> String {
    let other = |letter: char| !letter.is_alphanumeric();
    format!("torque-{}", bearing.replace(other, "-"))
}

/// Each word of the command line as a value of the file; `--set` comes last and counts.
fn overrides(wish: &Torque) -> Vec<String> {
    let mut sets = vec![format!("bearing.name={}", wish.bearing)];
    let catalogue = wish.catalogue.as_ref();
    sets.extend(catalogue.map(|path| format!("catalogue={}", path.display())));
    for (path, value) in [
        ("torque.speed_to", wish.speed_to.as_ref()),
        ("bearing.moment.law", wish.law.first()),
        ("bearing.moment.temperature", wish.temperature.first()),
    ] {
        sets.extend(value.map(|value| format!("{path}={value}")));
    }
    if wish.law.len() > 1 {
        sets.push(list("torque.laws", &wish.law));
    }
    for (path, values) in [
        ("torque.loads", &wish.load),
        ("torque.accelerations", &wish.acceleration),
        ("torque.temperatures", &wish.temperature),
        ("torque.lubricants", &wish.lubricant),
    ] {
        if !values.is_empty() {
            sets.push(list(path, values));
        }
    }
    sets.extend(wish.set.iter().cloned());
    sets
}

/// A list as an override. Quotes and backslashes in a value stay what they are.
fn list(path: &str, values: &[String]) -> String {
    let quoted = |value: &String| {
        let value = value.replace('\\', "\\\\").replace('"', "\\\"");
        format!("\"{value}\"")
    };
    let values: Vec<String> = values.iter().map(quoted).collect();
    format!("{path}=[{}]", values.join(", "))
}
