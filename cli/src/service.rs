//! `auxbear service`.

use crate::arguments::Service;
use crate::console;
use crate::digits::{four_digits, readable};
use auxbear::problem::{Code, Problem, Result};
use auxbear::report::service::{Mode, Occasion, service};
use std::path::PathBuf;

/// Services until 1 % of machines fail beyond which fatigue decides nothing.
const DECISIVE: f64 = 1000.0;

/// Prints what many drops do to the bearings together.
pub fn perform(wish: &Service) -> Result<()> {
    let occasions = wish.occasions.iter().map(|text| occasion(text));
    let occasions: Vec<Occasion> = occasions.collect::<Result<_, _>>()?;
    let found = service(&occasions)?;
    let mut rows = vec![head(&occasions)];
    rows.extend(found.modes.iter().map(row));
    console::print(&console::table(&rows))?;
    if let (Some(survival), Some(services)) = (found.survival, found.services) {
        let text = match services[0] > DECISIVE {
            true => "Rolling fatigue is not decisive: see its share of L10.\n".to_string(),
            false => format!(
                "{} % of machines have lost a bearing by rolling fatigue after it; 1, 10 and 50 % after {} such services.\n",
                four_digits(100.0 * (1.0 - survival)),
                services.map(four_digits).join(", ")
            ),
        };
        console::print(&text)?;
    }
    console::report(
        "What ends auxiliary bearings is seldom fatigue: cage, smearing, spalls that grow from dents and the life of the lubricant have no law here.",
    );
    Ok(())
}

/// `40:runs/full_speed`.
fn occasion(text: &str) -> Result<Occasion> {
    let parts = text.split_once(':');
    match parts.and_then(|(count, path)| Some((count.trim().parse().ok()?, path))) {
        Some((count, path)) if count > 0 && !path.is_empty() => Ok(Occasion {
            count,
            directory: PathBuf::from(path),
        }),
        _ => Err(Problem::new(
            Code::WrongType,
            "auxbear service",
            format!("\"{text}\""),
            "the number of drops and the directory of a run of one are needed, e.g. 40:runs/full_speed".to_string(),
        )),
    }
}

fn head(occasions: &[Occasion]) -> Vec<String> {
    let each = (occasions.iter()).map(|one| format!("{} x {}", one.count, one.directory.display()));
    let mut row = vec!["bearing".to_string(), String::new(), "service".to_string()];
    row.extend(each);
    row
}

fn row(mode: &Mode) -> Vec<String> {
    let value = match (&mode.value, mode.band) {
        (Err(why), _) => format!("- ({why})"),
        (Ok(value), None) => readable(*value, &mode.unit),
        (Ok(value), Some(band)) => {
            let [value, band] = [*value, band].map(|size| readable(size, &mode.unit));
            format!("{value} ± {band}")
        }
    };
    let how = if mode.adds { "" } else { ", the worst" };
    let mut row = vec![mode.bearing.clone(), format!("{}{how}", mode.what), value];
    if mode.value.is_ok() {
        let parts = mode.parts.iter();
        row.extend(parts.map(|part| readable(*part, &mode.unit)));
    }
    row
}
