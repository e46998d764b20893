//! `auxbear bearings`.

use crate::arguments::Bearings;
use crate::console;
use auxbear::catalogue::{self, Bearing, Datum};
use auxbear::problem::{Code, Problem, did_you_mean};

/// Lists the catalogue or shows one bearing.
pub fn perform(command: &Bearings) -> Result<(), Box<Problem>> {
    match command {
        Bearings::List => {
            let rows: Vec<[String; 2]> = catalogue::bearings()
                .iter()
                .map(|bearing| [bearing.name.clone(), bearing.description.clone()])
                .collect();
            console::print(&console::table(&rows));
        }
        Bearings::Show { name } => {
            let name = name.join(" ");
            let bearing = catalogue::find(&name).ok_or_else(|| unknown(&name))?;
            console::print(&show(bearing));
        }
    }
    Ok(())
}

fn show(bearing: &Bearing) -> String {
    let head = ["quantity", "value", "mark", "source, way or reason"].map(String::from);
    let values = bearing.values.iter().map(|value| {
        let text = match &value.datum {
            Datum::Number { text, .. } => text,
            Datum::Word(word) => word,
        };
        [
            value.key.clone(),
            text.clone(),
            value.mark.word().to_string(),
            value.note.clone(),
        ]
    });
    let rows: Vec<[String; 4]> = std::iter::once(head).chain(values).collect();
    format!(
        "{}: {}\n\n{}",
        bearing.name,
        bearing.description,
        console::table(&rows)
    )
}

fn unknown(name: &str) -> Box<Problem> {
    let names = catalogue::names();
    let near = did_you_mean(name, names.iter().map(String::as_str));
    Box::new(
        Problem::new(
            Code::UnknownBearing,
            "auxbear bearings show",
            format!("\"{name}\", which is not in the catalogue"),
            format!("one of these is needed: {}", names.join(", ")),
        )
        .with_hint(near),
    )
}
