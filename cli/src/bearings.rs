//! `auxbear bearings`.

use crate::arguments::Bearings;
use crate::{console, stiffness};
use auxbear::catalogue::{self, Bearing, Catalogue, Filter, FilterTexts, Meant, Origin};
use auxbear::problem::Result;
use auxbear::units;
use std::path::Path;

/// Lists the catalogue or shows one bearing.
pub fn perform(command: &Bearings) -> Result<()> {
    match command {
        Bearings::List {
            bore,
            speed,
            kind,
            material,
            catalogue,
            json,
        } => {
            let texts = FilterTexts {
                bore: bore.as_deref(),
                speed: speed.as_deref(),
                kind: kind.as_deref(),
                material: material.as_deref(),
            };
            let filter = Filter::read(&texts, "auxbear bearings list")?;
            let catalogue = read(catalogue.as_deref())?;
            let wanted = catalogue.iter().filter(|bearing| filter.wants(bearing));
            let wanted: Vec<&Bearing> = wanted.collect();
            console::print(&if *json {
                catalogue::to_json(wanted)
            } else {
                list(&wanted)
            })?;
        }
        Bearings::Show {
            name,
            catalogue,
            json,
        } => {
            let catalogue = read(catalogue.as_deref())?;
            let meant = catalogue.meant(&name.join(" "), PLACE)?;
            report(&meant, &name.join(" "), &meant.beyond_one());
            let bearing = meant.bearing;
            console::print(&if *json {
                catalogue::to_json([bearing])
            } else {
                show(bearing)
            })?;
        }
        Bearings::Stiffness(wish) => stiffness::perform(wish)?,
    }
    Ok(())
}

/// Says which bearing is meant by a designation, and what of it is left out.
pub fn report(meant: &Meant<'_>, name: &str, left_out: &str) {
    if !meant.by_name {
        let left_out = match left_out {
            "" => String::new(),
            words => format!(". Left out: {words}"),
        };
        let own = &meant.bearing.name;
        console::report(&format!("{name}: the {own} of the catalogue{left_out}"));
    }
}

/// The catalogue, with a file's bearings.
pub fn read(file: Option<&Path>) -> Result<Catalogue> {
    file.map_or(Ok(Catalogue::built_in()), Catalogue::with_file)
}

fn list(bearings: &[&Bearing]) -> String {
    if bearings.is_empty() {
        return "no bearing of the catalogue is like that\n".to_string();
    }
    let head = [
        "name", "type", "bore", "outside", "width", "balls", "C0", "limiting", "assumed",
    ];
    let units = ["", "", "mm", "mm", "mm", "mm", "kN", "rpm", "values"];
    let rows = bearings.iter().map(|bearing| row(bearing));
    let heads = [head, units].map(|line| line.map(String::from));
    let rows: Vec<[String; 9]> = heads.into_iter().chain(rows).collect();
    console::table(&rows)
}

fn row(bearing: &Bearing) -> [String; 9] {
    let number = |key, unit| {
        let si = bearing.number(key);
        si.map_or("-".to_string(), |si| in_unit(si, unit))
    };
    let balls = bearing.number("ball_count");
    let balls = balls.map_or("-".to_string(), |count| {
        format!("{count} x {}", number("ball_diameter", "mm"))
    });
    [
        bearing.name.clone(),
        bearing.word("type").unwrap_or("-").to_string(),
        number("bore_diameter", "mm"),
        number("outer_diameter", "mm"),
        number("width", "mm"),
        balls,
        number("static_load_rating", "kN"),
        number("limiting_speed", "rpm"),
        bearing.assumed_count().to_string(),
    ]
}

/// The number alone, to five digits.
fn in_unit(si: f64, unit: &str) -> String {
    let text = units::display(si, unit).unwrap_or_default();
    let number = text.split(' ').next().unwrap_or_default();
    let number: f64 = number.parse().unwrap_or(f64::NAN);
    let rounded: f64 = format!("{number:.4e}").parse().unwrap_or(number);
    units::number_text(rounded)
}

fn show(bearing: &Bearing) -> String {
    let head = ["quantity", "value", "mark", "source, method or reason"].map(String::from);
    let values = bearing.values.iter().map(|value| {
        [
            value.key.clone(),
            value.text().to_string(),
            value.mark.word().to_string(),
            value.note.clone(),
        ]
    });
    let rows: Vec<[String; 4]> = std::iter::once(head).chain(values).collect();
    let mut title = bearing.name.clone();
    if !bearing.description.is_empty() {
        title = format!("{title}: {}", bearing.description);
    }
    if let Origin::File {
        file,
        replaces_built_in,
    } = &bearing.origin
    {
        title.push_str(&format!("\nfrom {file}"));
        if *replaces_built_in {
            title.push_str(", in place of the built-in bearing of this name");
        }
    }
    let count = bearing.assumed_count();
    let assumed = format!("{count} of {} values are assumed", bearing.values.len());
    format!("{title}\n{assumed}\n\n{}", console::table(&rows))
}

/// What messages name as the file.
const PLACE: &str = "auxbear bearings show";
