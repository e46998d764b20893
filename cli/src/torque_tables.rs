//! What `auxbear torque` prints: tables over acceleration, load, law and lubricant.

use crate::digits::{four_digits, readable};
use crate::{console, limits};
use auxbear::outcome::{Outcome, Quantity, Value};
use auxbear::units;
use std::path::Path;

/// The text printed after a computation.
pub fn text(path: &Path, outcome: &Outcome) -> String {
    let found = Figures(outcome);
    let mut text = format!("{}\n{}\n", outcome.title, found.place());
    text.push_str(&format!("\n{}", console::table(&found.accelerations())));
    for result in found.in_figure("torque_lines") {
        if let (Value::Number(number), Some(words)) =
            (&result.value, result.words_in("torque_lines"))
        {
            text.push_str(&format!("{words} {}\n", readable(*number, result.unit)));
        }
    }
    // of one load the first table has all
    for (table, least) in [
        (found.loads(), 2),
        (found.laws(), 1),
        (found.lubricants(), 1),
    ] {
        if table.len() > least {
            text.push_str(&format!("\n{}", console::table(&table)));
        }
    }
    text.push('\n');
    text.push_str(&limits::text(outcome));
    text.push_str(&format!("{}\n", path.join("report.html").display()));
    text
}

/// What was computed, by the figures that show it.
struct Figures<'a>(&'a Outcome);

impl<'a> Figures<'a> {
    fn in_figure(&self, figure: &'static str) -> impl Iterator<Item = &'a Quantity> {
        let all = self.0.quantities.iter();
        all.filter(move |quantity| quantity.words_in(figure).is_some())
    }

    /// Where the tables hold that vary one thing.
    fn place(&self) -> String {
        let parts = self.in_figure("place").filter_map(|quantity| {
            let unit = quantity.words_in("place")?;
            match quantity.value {
                Value::Number(number) => Some(format!("{} {unit}", in_unit(number, unit))),
                _ => None,
            }
        });
        let parts: Vec<String> = parts.collect();
        format!("at {}; moments in N mm", parts.join(", "))
    }

    /// Lists beside each other under their words: what is varied, then the moments.
    fn over(
        &self,
        figure: &'static str,
        unit: &str,
        fixed: &[(String, String)],
    ) -> Vec<Vec<String>> {
        let columns = self.in_figure(figure);
        let columns = columns.filter_map(|quantity| match &quantity.value {
            Value::List(list) => Some((quantity.words_in(figure)?, list)),
            _ => None,
        });
        let columns: Vec<_> = columns.collect();
        let words = |range: std::ops::Range<usize>| {
            columns[range].iter().map(|column| column.0.to_string())
        };
        let (first, all) = (columns.len().min(1), columns.len());
        let mut rows = vec![
            words(0..first)
                .chain(fixed.iter().map(|one| one.0.clone()))
                .chain(words(first..all))
                .collect(),
        ];
        let [(_, varied), moments @ ..] = columns.as_slice() else {
            return rows;
        };
        rows.extend(varied.iter().enumerate().map(|(row, at)| {
            let at = format!("{} {unit}", four_digits(*at));
            let moment = |si: &f64| in_unit(*si, "N mm");
            let moments =
                (moments.iter()).map(|(_, list)| list.get(row).map_or("-".to_string(), moment));
            [at].into_iter()
                .chain(fixed.iter().map(|one| one.1.clone()))
                .chain(moments)
                .collect()
        }));
        rows
    }

    fn accelerations(&self) -> Vec<Vec<String>> {
        let parts = self.in_figure("parts").take(2);
        let named = |part: &Quantity| part.words_in("parts").unwrap_or_default().to_string();
        let parts: Vec<_> = parts
            .map(|part| (named(part), value(part, "N mm")))
            .collect();
        self.over("by_acceleration", "rad/s^2", &parts)
    }

    fn loads(&self) -> Vec<Vec<String>> {
        self.over("by_load", "N", &[])
    }

    /// Results under the head, one row for those of equal words in a figure.
    fn rows(
        &self,
        figure: &'static str,
        head: &[&str],
        row: impl Fn(&str, &[&Quantity]) -> Vec<String>,
    ) -> Vec<Vec<String>> {
        let mut rows = vec![head.iter().map(ToString::to_string).collect()];
        let all: Vec<&Quantity> = self.in_figure(figure).collect();
        for some in all.chunk_by(|one, other| one.words_in(figure) == other.words_in(figure)) {
            rows.push(row(some[0].words_in(figure).unwrap_or_default(), some));
        }
        rows
    }

    fn laws(&self) -> Vec<Vec<String>> {
        self.rows("by_law", &["law", "M0", "M1", "M", ""], |law, moments| {
            let cells = moments.iter().map(|moment| value(moment, "N mm"));
            [law.to_string()]
                .into_iter()
                .chain(cells)
                .chain(moments.last().map(|moment| why(moment)))
                .collect()
        })
    }

    fn lubricants(&self) -> Vec<Vec<String>> {
        self.rows(
            "by_lubricant",
            &["lubricant", "mm^2/s", "M", ""],
            |_, results| match results {
                [name, viscosity, moment, ..] => vec![
                    value(name, ""),
                    value(viscosity, "mm^2/s"),
                    value(moment, "N mm"),
                    why(moment),
                ],
                _ => Vec::new(),
            },
        )
    }
}

/// A value in a unit, without the unit; a dash where there is none.
fn value(quantity: &Quantity, unit: &str) -> String {
    match &quantity.value {
        Value::Number(number) => in_unit(*number, unit),
        Value::Text(text) => text.clone(),
        _ => "-".to_string(),
    }
}

/// Why a result is not there; empty where it is.
fn why(quantity: &Quantity) -> String {
    quantity.value.why_absent().unwrap_or_default().to_string()
}

/// The number alone, to four digits.
fn in_unit(si: f64, unit: &str) -> String {
    let text = units::display(si, unit).unwrap_or_default();
    let number = text.split(' ').next().unwrap_or_default();
    number.parse().map_or("-".to_string(), four_digits)
}
