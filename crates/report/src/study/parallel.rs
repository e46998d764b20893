//! Every member as a line over all inputs and results that the page shows, among which ranges are chosen with the pointer.

use super::cells::scaled;
use crate::page::escape_text as plain;
use run::study::Study;
use run::study::table::{Column, Table};
use scenario::Distribution;
use serde_json::{Value, json};

const SCRIPT: &str = include_str!("parallel.js");
/// Members that are drawn, at most: every so-manieth is.
const MOST_LINES: usize = 4000;
/// Axes, at most.
const MOST_AXES: usize = 14;

/// The picture with its script; nothing where there are fewer than two axes or members.
pub(super) fn html(study: &Study, table: &Table) -> String {
    let shown = study.shown();
    let results = shown.iter().filter_map(|name| table.column(name));
    let columns = table.columns.iter().take(table.inputs).chain(results);
    let columns: Vec<(usize, &Column)> = (columns.enumerate())
        .filter(|(_, column)| column.values.iter().any(|value| value.is_finite()))
        .take(MOST_AXES)
        .collect();
    let members = table.members.len();
    if columns.len() < 2 || members < 2 {
        return String::new();
    }
    let every = members.div_ceil(MOST_LINES);
    let axes: Vec<Value> = (columns.iter())
        .map(|(at, column)| axis(study, *at, column, every))
        .collect();
    let places: Vec<usize> = table.members.iter().step_by(every).copied().collect();
    let data = json!({
        "members": places,
        "axes": axes,
        "command": format!("auxbear study {}", study.file.file),
    });
    let thinned = match every {
        1 => String::new(),
        _ => format!(" One member in {every} is drawn."),
    };
    // inside a JSON string "<" may be an escape; without it no text closes the script element
    format!(
        "<h2>Members</h2>\n<p class=\"small\">A line a member. Draw along an axis to keep those within a range, click on the axis to let them go, click a line \
         to see whose it is.{thinned}</p>\n<figure id=\"parallel\" style=\"overflow-x: auto\"><canvas role=\"img\" aria-label=\"Every member as a line over inputs and results\"></canvas>\n\
         <p><output></output> <button type=\"button\" hidden>show all</button></p>\n<script type=\"application/json\">{}</script></figure>\n<script>{SCRIPT}</script>\n",
        data.to_string().replace('<', "\\u003c")
    )
}

fn axis(study: &Study, at: usize, column: &Column, every: usize) -> Value {
    let finite = column.values.iter().copied().filter(|v| v.is_finite());
    let name = column.name.strip_prefix("input.").unwrap_or(&column.name);
    let texts = match study.file.inputs.get(at).map(|i| &i.vary.distribution) {
        Some(Distribution::Choice(texts)) => Some(texts),
        _ => None,
    };
    let (factor, label) = scaled("", &column.unit, finite.clone());
    let low = finite.clone().fold(f64::INFINITY, f64::min) * factor;
    let high = finite.fold(f64::NEG_INFINITY, f64::max) * factor;
    let range = match texts {
        Some(texts) => [0.0, texts.len().saturating_sub(1) as f64],
        None => [low, high],
    };
    // seven digits: more than a picture shows
    let rounded = |value: &f64| match value.is_finite() {
        true => format!("{:.6e}", value * factor)
            .parse()
            .unwrap_or(value * factor),
        false => f64::NAN,
    };
    let values: Vec<f64> = column.values.iter().step_by(every).map(rounded).collect();
    let unit = label.trim_start_matches(", ");
    json!({
        "name": name,
        "label": if unit.is_empty() { name.to_string() } else { format!("{name} [{}]", plain(unit)) },
        "range": range,
        "texts": texts,
        "values": values,
    })
}
