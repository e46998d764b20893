//! `auxbear torque`.

use crate::arguments::Torque;
use crate::exit::Exit;
use crate::run;
use auxbear::problem::Result;
use auxbear::report::directory::free_path;
use auxbear::scenario::{BuiltIn, FORMAT, Scenario};

/// What messages name as the file.
const PLACE: &str = "auxbear torque";

/// Computes the moments of one bearing, by the scenario that the words of the command line make.
pub fn perform(wish: &Torque) -> Result<Exit> {
    let text = format!("format = \"{FORMAT}\"\nsystem = \"torque\"\n");
    let scenario = Scenario::parse(&text, PLACE, &overrides(wish), &BuiltIn)?;
    let path = wish
        .out
        .clone()
        .unwrap_or_else(|| free_path(&name(&wish.bearing)));
    run::execute(&scenario, &path, None, wish.quiet)
}

/// Name of a run directory.
fn name(bearing: &str) -> String {
    let plain = |letter: char| {
        if letter.is_alphanumeric() {
            letter
        } else {
            '-'
        }
    };
    format!("torque-{}", bearing.chars().map(plain).collect::<String>())
}

/// Each word of the command line as a value of the file; `--set` comes last and counts.
fn overrides(wish: &Torque) -> Vec<String> {
    let mut sets = vec![format!("bearing.name={}", wish.bearing)];
    let catalogue = wish.catalogue.as_ref();
    sets.extend(catalogue.map(|path| format!("catalogue={}", path.display())));
    sets.extend(
        wish.speed_to
            .iter()
            .map(|speed| format!("torque.speed_to={speed}")),
    );
    sets.extend(
        wish.law
            .first()
            .map(|law| format!("bearing.moment.law={law}")),
    );
    if wish.law.len() > 1 {
        sets.push(list("torque.laws", &wish.law));
    }
    let temperature = wish.temperature.first();
    sets.extend(temperature.map(|first| format!("bearing.moment.temperature={first}")));
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
