//! What measured curves say of the inputs of an estimate, as a table of the page and of the terminal.

use super::bars::{WIDTH, picture, room};
use super::cells::{amount, scaled, short, table};
use crate::page::escape_text as plain;
use crate::picture::{Panel, dot};
use run::Fitted;
use run::study::answer::Answer;
use run::study::estimate::{Estimate, Estimated};
use std::fmt::Write;

/// Samples of a picture, at most.
const POINTS: usize = 800;

const HEAD: [&str; 5] = [
    "input",
    "estimate",
    "standard uncertainty by noise",
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
        "Misfit {} over {samples} samples, of which {independent} count as independent; {} runs besides the members. Uncertainties are those of noise alone: all inputs that were kept are taken as exact, and one that is off by what noise hides moves an estimate by many of them.",
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

/// A channel beside the run of the estimate, and below what is left in deviations of its noise.
fn of_channel(own: &Fitted) -> String {
    let thinned = own.time.len().div_ceil(POINTS).max(1);
    let (seconds, along) = scaled("time after the release", "s", own.time.iter().copied());
    let both = own.measured.iter().chain(&own.predicted);
    let (factor, label) = scaled("", own.unit, both.clone().copied());
    let left: Vec<f64> = (own.measured.iter().zip(&own.predicted))
        .map(|(measured, predicted)| (measured - predicted) / own.deviation.unwrap_or(f64::NAN))
        .collect();
    let panel = |top: f64, height: f64, y: (f64, f64)| Panel {
        left: 78.0,
        top,
        width: WIDTH - 100.0,
        height,
        x: room(own.time.iter().map(|time| time * seconds)),
        y,
    };
    let curves = panel(32.0, 150.0, room(both.map(|value| value * factor)));
    let known = left.iter().filter(|own| own.is_finite());
    let widest = known.fold(2.5_f64, |most, own| most.max(own.abs()));
    let rest = panel(228.0, 80.0, (-1.05 * widest, 1.05 * widest));
    let title = format!("{}: measured (dots), run of the estimate (line)", own.name);
    let svg = picture(350.0, |svg| {
        curves.axes(svg, &plain(&title), "", label.trim_start_matches(", "));
        rest.axes(
            svg,
            "what is left, over the deviation of the noise; band: 2",
            &along,
            "",
        );
        let ends = rest.x;
        let band = [(ends.0, 2.0), (ends.1, 2.0), (ends.1, -2.0), (ends.0, -2.0)];
        let corners = band.map(|(x, y)| rest.place(x, y));
        let corners = corners.map(|(x, y)| format!("{x:.1},{y:.1}")).join(" ");
        let _ = writeln!(
            svg,
            "<polygon points=\"{corners}\" fill=\"#1f5fa8\" fill-opacity=\"0.12\"/>"
        );
        let rows = (0..own.time.len()).step_by(thinned);
        let mut run = Vec::new();
        for row in rows {
            let time = own.time[row] * seconds;
            dot(
                svg,
                curves.place(time, factor * own.measured[row]),
                1.3,
                "#8a6d1f",
                "",
            );
            if left[row].is_finite() {
                dot(svg, rest.place(time, left[row]), 1.3, "#8a6d1f", "");
            }
            let (x, y) = curves.place(time, factor * own.predicted[row]);
            run.push(format!("{x:.1},{y:.1}"));
        }
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"#1f5fa8\" stroke-width=\"1.2\"/>",
            run.join(" ")
        );
    });
    format!("<figure>{svg}</figure>\n")
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
            let pictures: String = found.curves.iter().map(of_channel).collect();
            format!(
                "{}<p class=\"small\">{note}</p>\n{pictures}",
                table(&HEAD, all)
            )
        }
    };
    format!("<h2>Estimate from the measured curves</h2>\n{body}")
}
