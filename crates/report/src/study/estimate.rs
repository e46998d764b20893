//! What measured curves say of the inputs of an estimate, as a table of the page and of the terminal.

use super::cells::{amount, scaled, short, table};
use crate::page::escape_text as plain;
use run::study::answer::Answer;
use run::study::estimate::{Estimate, Estimated};

const HEAD: [&str; 5] = [
    "input",
    "estimate",
    "standard uncertainty",
    "bounds",
    "determined",
];

/// A row an input behind the heads; none where nothing was estimated.
pub fn rows(found: &Estimate) -> Vec<[String; 5]> {
    let row = |own: &Estimated| {
        let number = |value: f64| amount(value, &own.unit);
        let [low, high] = own.bounds.map(number);
        let (factor, label) = scaled("", &own.unit, [own.value].into_iter());
        let unit = label.trim_start_matches(", ");
        // as many digits as are known, and one more
        let exact = |value: f64, uncertainty: f64| {
            let places = (1.0 - (factor * uncertainty).log10().floor()).clamp(0.0, 12.0) as usize;
            let text = format!("{:.places$} {unit}", factor * value);
            text.trim_end().to_string()
        };
        let known = own.uncertainty;
        let why = if own.why.is_empty() { "yes" } else { &own.why };
        [
            own.path.clone(),
            known.map_or_else(|| number(own.value), |known| exact(own.value, known)),
            known.map_or("–".to_string(), |known| exact(known, known)),
            format!("{low} to {high}"),
            why.to_string(),
        ]
    };
    let head = HEAD.map(str::to_string);
    std::iter::once(head)
        .chain(found.inputs.iter().map(row))
        .collect()
}

/// What qualifies the rows, in sentences.
pub fn note(found: &Estimate) -> String {
    let [samples, independent] = found.rows.map(f64::round);
    let mut text = format!(
        "Misfit {} over {samples} samples, of which {independent} count as independent; {} runs besides the members.",
        short(found.misfit),
        found.runs
    );
    if !found.explained {
        text.push_str(" Noise does not explain the residuals, by their size or by how they repeat each other: an input that was kept, the clock or the model is off, or the search has not found the lowest misfit. The uncertainty counts their size, not their cause.");
    }
    if let Some(member) = found.rival {
        text.push_str(&format!(
            " Member {member} fits as well with other values: the estimate is not the only one."
        ));
    }
    let pairs = (0..found.inputs.len()).flat_map(|i| (0..i).map(move |k| (k, i)));
    for (k, i) in pairs {
        let coefficient = found.correlation[k][i];
        if coefficient.is_finite() {
            let [one, other] = [k, i].map(|at| found.inputs[at].path.as_str());
            text.push_str(&format!(
                " Correlation of {one} and {other}: {coefficient:.2}."
            ));
        }
    }
    text
}

/// The section of the page.
pub(super) fn html(answer: &Answer) -> String {
    let body = match &answer.estimate {
        None => return String::new(),
        Some(Err(why)) => format!("<p>Nothing was estimated: {}.</p>\n", plain(why)),
        Some(Ok(found)) => {
            let cells = |row: &[String; 5]| row.each_ref().map(|cell| plain(cell)).to_vec();
            let all: Vec<Vec<String>> = rows(found)[1..].iter().map(cells).collect();
            let note = plain(&note(found));
            format!("{}<p class=\"small\">{note}</p>\n", table(&HEAD, all))
        }
    };
    format!("<h2>Estimate from the measured curves</h2>\n{body}")
}
