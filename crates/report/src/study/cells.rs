//! Numbers, texts and tables for the page of a study.

use crate::page::escape_text as plain;
use outcome::{Judged, Verdict};

/// A table; cells may hold markup.
pub(super) fn rows(head: &[&str], body: &[Vec<String>]) -> String {
    let cells = |tag: &str, row: &[String]| {
        row.iter()
            .map(|cell| format!("<{tag}>{cell}</{tag}>"))
            .collect::<String>()
    };
    let head: Vec<String> = head.iter().map(|text| plain(text)).collect();
    let body = body.iter();
    let body: String = (body.map(|row| format!("<tr>{}</tr>\n", cells("td", row)))).collect();
    format!(
        "<div class=\"wide\"><table class=\"quantities\"><thead><tr>{}</tr></thead><tbody>\n{body}</tbody></table></div>\n",
        cells("th", &head)
    )
}

/// A factor that gives numbers for people, and the label of an axis with its unit.
pub(super) fn scaled(name: &str, unit: &str, values: impl Iterator<Item = f64>) -> (f64, String) {
    let most = values
        .filter(|v| v.is_finite())
        .fold(0.0_f64, |most, v| most.max(v.abs()));
    let power = match unit {
        "" | "1" => return (1.0, plain(name)),
        // unbalance
        "kg m" => return (1e6, format!("{}, g mm", plain(name))),
        "rad" => {
            return (
                180.0 / std::f64::consts::PI,
                format!("{}, deg", plain(name)),
            );
        }
        "rad/s" => return (30.0 / std::f64::consts::PI, format!("{}, rpm", plain(name))),
        "s" | "m" | "N" | "J" | "W" | "Pa" | "N m" | "N/m" if most > 0.0 => {
            (most.log10() / 3.0 - 0.1).floor().clamp(-3.0, 3.0) as i32
        }
        _ => 0,
    };
    let prefix = ["n", "µ", "m", "", "k", "M", "G"][(power + 3) as usize];
    match power {
        1.. if unit == "s" || unit == "m" => (1.0, format!("{}, {unit}", plain(name))),
        _ => (
            1000_f64.powi(-power),
            format!("{}, {prefix}{}", plain(name), plain(unit)),
        ),
    }
}

/// A number to four digits.
pub(super) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    units::number_text(rounded)
}

/// A verdict in bold; one that fails in its colour.
pub(super) fn marked(verdict: Verdict) -> String {
    match verdict {
        Verdict::Fail => format!("<b class=\"failed\">{}</b>", verdict.word()),
        _ => format!("<b>{}</b>", verdict.word()),
    }
}

/// "most 3 kN".
pub(super) fn bound(judged: &Judged) -> String {
    let bound = amount(judged.limit.bound, judged.unit);
    format!("{} {bound}", judged.limit.side.word())
}

/// A number with its unit, or a dash; an instant that did not come is infinite.
pub(super) fn known(value: Option<f64>, unit: &str) -> String {
    match value {
        None => "–".to_string(),
        Some(value) if value.is_infinite() => "after the end of the run".to_string(),
        Some(value) => amount(value, unit),
    }
}

/// The same as markup, which does not break between number and unit.
pub(super) fn cell(value: Option<f64>, unit: &str) -> String {
    plain(&known(value, unit)).replace(' ', "\u{a0}")
}

/// A share in percent.
pub(super) fn percent(share: f64) -> String {
    format!("{}\u{a0}%", short(100.0 * share))
}

/// A table of rows that are computed one by one.
pub(super) fn table(head: &[&str], body: impl IntoIterator<Item = Vec<String>>) -> String {
    rows(head, &body.into_iter().collect::<Vec<_>>())
}

/// A number with its unit, for people.
pub(super) fn amount(value: f64, unit: &str) -> String {
    let (factor, label) = scaled("", unit, [value].into_iter());
    let (number, unit) = (short(factor * value), label.trim_start_matches(", "));
    format!("{number} {unit}").trim().to_string()
}
