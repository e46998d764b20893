//! `members.csv`: all members as one table of text.

use run::study::Study;
use run::study::table::Table;
use scenario::Distribution;

/// All members as text: names with units in the first line, an empty cell where there is nothing.
pub(super) fn csv(study: &Study, table: &Table) -> String {
    let cell = |text: &str| match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_string(),
    };
    let mut out = String::from("member");
    for column in &table.columns {
        let unit = match column.unit.as_str() {
            "" | "1" => String::new(),
            unit => format!(" [{unit}]"),
        };
        out.push(',');
        out.push_str(&cell(&format!("{}{unit}", column.name)));
    }
    out.push_str(",failed\n");
    for (row, member) in table.members.iter().enumerate() {
        out.push_str(&member.to_string());
        for (at, column) in table.columns.iter().enumerate() {
            out.push(',');
            let value = column.values[row];
            let input = study
                .file
                .inputs
                .get(at)
                .map(|input| &input.vary.distribution);
            match input {
                _ if !value.is_finite() => {}
                Some(Distribution::Choice(texts)) => {
                    out.push_str(&cell(texts.get(value as usize).map_or("", String::as_str)));
                }
                _ => out.push_str(&value.to_string()),
            }
        }
        out.push(',');
        out.push_str(&cell(table.failed.get(member).map_or("", String::as_str)));
        out.push('\n');
    }
    out
}
