//! The run of a machine taken apart by its auxiliary bearings.

use super::page::{PageColumn, PageRun};
use serde_json::Value;

/// A run as each of its auxiliary bearings has it, under its name; without a name the whole of a run that tells none apart.
pub(super) fn per_bearing(run: &PageRun) -> Vec<PageRun> {
    let summary: Value = serde_json::from_str(&run.summary_json).unwrap_or_default();
    let named = |list: &Value, key: &str, name: &str| -> Vec<Value> {
        let all = list.as_array().map_or(&[][..], Vec::as_slice);
        let of_bearing = all.iter().filter(|item| item[key].as_str() == Some(name));
        of_bearing.cloned().collect()
    };
    let bearings = summary["auxiliary_bearings"].as_array();
    let names = bearings.into_iter().flatten();
    let names = names.filter_map(|bearing| bearing["name"].as_str());
    let each: Vec<PageRun> = names
        .map(|name| {
            let [part] = &named(&summary["auxiliary_bearings"], "name", name)[..] else {
                return PageRun::default();
            };
            let mut own = part.clone();
            own["contacts"] = named(&summary["contacts"], "auxiliary_bearing", name).into();
            let column = |column: &PageColumn| {
                let prefix = format!("{name}.");
                let common = ["time", "rotor.speed"].contains(&column.name.as_str());
                let inner = column.name.strip_prefix(&prefix);
                Some(PageColumn {
                    name: inner.or(common.then_some(&column.name))?.to_string(),
                    ..column.clone()
                })
            };
            PageRun {
                name: name.to_string(),
                summary_json: own.to_string(),
                columns: run.columns.iter().filter_map(column).collect(),
                ..PageRun::default()
            }
        })
        .collect();
    match each.is_empty() {
        true => vec![PageRun {
            name: String::new(),
            ..run.clone()
        }],
        false => each,
    }
}
