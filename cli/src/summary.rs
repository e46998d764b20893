//! What is printed after a run: where it is, the quantities most looked for, cost.

use crate::digits::{of_result, readable};
use crate::{console, limits, torque_tables};
use auxbear::outcome::{Outcome, Quantity, Value};
use std::f64::consts::PI;
use std::path::Path;

/// What an identification ends with.
const NEXT_TESTS: &str = "next_tests";

/// The text printed after a run.
pub fn text(path: &Path, outcome: &Outcome) -> String {
    if outcome.system == "torque" {
        return torque_tables::text(path, outcome);
    }
    let mut rows: Vec<[String; 2]> = outcome.quantities.iter().filter_map(row).collect();
    rows.extend(steady(outcome));
    let mut text = format!("{}\n", outcome.title);
    if !outcome.stop.complete() {
        let begin = match (outcome.work.members, outcome.members.members.first()) {
            (1, _) => "NOT WHOLE, the values are those until it ended.",
            (_, Some(0)) => "NOT WHOLE.",
            _ => "NOT WHOLE, the values of the unperturbed run are those until it ended.",
        };
        text.push_str(&format!("{begin} {}\n", outcome.stop.text));
    }
    if outcome.stop.complete() && outcome.stop.reason != "finished" {
        let word = outcome.stop.reason.to_uppercase();
        text.push_str(&format!("{word}. {}\n", outcome.stop.text));
    }
    text.push_str(&console::table(&rows));
    let next = outcome.quantities.iter().find(|q| q.name == NEXT_TESTS);
    if let Some(Value::Text(next)) = next.map(|q| &q.value) {
        text.push_str("the next test, the most informative first:\n");
        for line in next.lines() {
            text.push_str(&format!("  {line}\n"));
        }
    }
    text.push_str(&limits::text(outcome));
    if outcome.quantities.iter().any(|q| q.spread.is_some()) {
        let mut varied: Vec<&str> = Vec::new();
        for (path, _) in outcome.drawn.iter().flatten() {
            if !varied.contains(&path.as_str()) {
                varied.push(path);
            }
        }
        text.push_str(&match varied.is_empty() {
            true => "± is one standard deviation over the perturbed starts (repeat.*): chaos, not tolerances of the machine\n".to_string(),
            false => format!(
                "± is one standard deviation over members with sampled {} and perturbed starts (repeat.*)\n",
                varied.join(", ")
            ),
        });
    }
    let work = &outcome.work;
    text.push_str(&format!(
        "{} in {:.2} s{}\n",
        match work.members {
            1 => "1 run".to_string(),
            members if outcome.members.len() < members => {
                format!("{} of {members} runs", outcome.members.len())
            }
            members => format!("{members} runs"),
        },
        work.seconds,
        match outcome.system {
            "signals" | "identify" | "rotor" => String::new(),
            _ => format!(", {} steps", work.steps),
        }
    ));
    text.push_str(&format!("{}\n", path.join("report.html").display()));
    text
}

/// The row of a result that is looked at first; of a deviation that is not there its value says why.
fn row(quantity: &Quantity) -> Option<[String; 2]> {
    let told = match &quantity.value {
        Value::List(_) => false,
        Value::None { .. } => !quantity.name.ends_with("_deviation"),
        Value::Number(_) | Value::Text(_) => true,
    };
    let name = quantity.name.replace(['_', '.'], " ");
    (quantity.headline && told).then(|| [format!("  {name}"), value(quantity)])
}

/// The torque of slow runs at the lowest, middle and highest speed at which it is known.
fn steady(outcome: &Outcome) -> Vec<[String; 2]> {
    let list = |quantity: Option<&Quantity>| match &quantity?.value {
        Value::List(values) => Some(values.clone()),
        _ => None,
    };
    let all = || outcome.quantities.iter();
    let row = |quantity: &Quantity| {
        let words = quantity.words_in("steady_torques")?;
        let speeds = list(all().find(|one| one.words_in("slow_speeds").is_some()))?;
        let torques = list(Some(quantity))?;
        let deviations = list(outcome.quantity(&quantity.name.replace("torques", "deviations")))?;
        let known = (0..torques.len()).filter(|k| torques[*k].is_finite());
        let known: Vec<usize> = known.collect();
        let places = [known.first(), known.get(known.len() / 2), known.last()];
        let told = places.into_iter().flatten().map(|&k| {
            let [torque, band] = [torques[k], deviations[k]].map(|own| readable(own, "N m"));
            format!("{torque} ± {band} at {}", readable(speeds[k], "rad/s"))
        });
        let told: Vec<String> = told.collect();
        (!told.is_empty()).then(|| [format!("  steady torque, {words}"), told.join("; ")])
    };
    all().filter_map(row).collect()
}

fn value(quantity: &Quantity) -> String {
    let text = match &quantity.value {
        Value::Number(speed) if quantity.unit == "rad/s" => {
            let (factor, unit) = match quantity.name.ends_with("frequency") {
                true => (0.5 / PI, "Hz"),
                false => (30.0 / PI, "rpm"),
            };
            let other = readable(speed * factor, unit);
            format!("{} ({other})", readable(*speed, "rad/s"))
        }
        Value::Number(number) => of_result(&quantity.name, *number, quantity.unit),
        Value::List(list) => format!("{} values", list.len()),
        Value::Text(text) => text.clone(),
        Value::None { why } => format!("none: {why}"),
    };
    match &quantity.spread {
        Some(spread) => {
            let both = [spread.mean, spread.standard_deviation];
            let [mean, sd] = both.map(|own| readable(own, quantity.unit));
            format!("{text} (mean {mean} ± {sd} of {} runs)", spread.members)
        }
        None => text,
    }
}
