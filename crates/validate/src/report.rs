//! What a validation found: rows, verdicts, table and JSON.

use problem::{Code, Problem};
use serde::Serialize;
use std::fmt::Write;

/// What became of one comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Verdict {
    /// Within the tolerance.
    #[serde(rename = "pass")]
    Pass,
    /// Outside the tolerance, not a number, or a case of our format that cannot be read.
    #[serde(rename = "fail")]
    Fail,
    /// Nothing was compared; `why` has the reason.
    #[serde(rename = "not run")]
    NotRun,
}

impl Verdict {
    /// The word of the report.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Fail => "fail",
            Verdict::NotRun => "not run",
        }
    }
}

/// How far a value may lie from its reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// Share of the reference; absolute where the reference is 0.
    Relative(f64),
    /// In the unit of the row.
    Absolute(f64),
    /// On one side of the reference: not below it.
    Least,
    /// Not above it.
    Most,
}

/// One quantity compared.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Name of the case.
    pub case: String,
    /// Name of the quantity; empty when the whole case was not run.
    pub quantity: String,
    /// Unit of reference and ours; "" for ratios and counts.
    pub unit: String,
    /// The reference value.
    pub reference: Option<f64>,
    /// Our value.
    pub ours: Option<f64>,
    /// Share of the reference by which ours differs; in the unit of the row where the reference is 0.
    pub deviation: Option<f64>,
    /// Largest deviation allowed, in the same measure.
    pub tolerance: Option<f64>,
    /// Verdict.
    pub verdict: Verdict,
    /// Reason of the tolerance, or why nothing was compared.
    pub why: String,
    /// Whether the file is damaged: a wrong input, unlike one of another format.
    #[serde(skip)]
    pub damaged: bool,
}

impl Row {
    /// Compares a value with its reference.
    pub fn compared(
        quantity: impl Into<String>,
        unit: impl Into<String>,
        reference: f64,
        ours: f64,
        tolerance: Tolerance,
        why: impl Into<String>,
    ) -> Row {
        let scale = if reference == 0.0 {
            1.0
        } else {
            reference.abs()
        };
        let deviation = (ours - reference).abs() / scale;
        let allowed = match tolerance {
            Tolerance::Relative(share) => Some(share),
            Tolerance::Absolute(value) => Some(value / scale),
            Tolerance::Least | Tolerance::Most => None,
        };
        let holds = match tolerance {
            Tolerance::Least => ours >= reference,
            Tolerance::Most => ours <= reference,
            _ => allowed.is_some_and(|allowed| deviation <= allowed),
        };
        Row {
            quantity: quantity.into(),
            unit: unit.into(),
            reference: Some(reference),
            ours: Some(ours),
            deviation: Some(deviation),
            tolerance: allowed,
            verdict: if holds { Verdict::Pass } else { Verdict::Fail },
            ..Row::not_run(why)
        }
    }

    /// The same with a deviation in a measure of its own: complex numbers by their distance, entries by their diagonal.
    pub(super) fn by(mut self, deviation: f64) -> Row {
        self.deviation = Some(deviation);
        self.verdict = match self.tolerance {
            Some(tolerance) if deviation <= tolerance => Verdict::Pass,
            _ => Verdict::Fail,
        };
        self
    }

    /// A case, or with [`Row::of`] a quantity, that was not run.
    pub fn not_run(why: impl Into<String>) -> Row {
        Row {
            case: String::new(),
            quantity: String::new(),
            unit: String::new(),
            reference: None,
            ours: None,
            deviation: None,
            tolerance: None,
            verdict: Verdict::NotRun,
            why: why.into(),
            damaged: false,
        }
    }

    /// A file of cases that cannot be read.
    pub fn damaged(why: impl Into<String>) -> Row {
        Row {
            damaged: true,
            ..Row::not_run(why)
        }
    }

    /// What is wrong in itself.
    pub fn wrong(why: impl Into<String>) -> Row {
        Row {
            verdict: Verdict::Fail,
            ..Row::not_run(why)
        }
    }

    /// Names the quantity and its unit.
    pub fn of(mut self, quantity: impl Into<String>, unit: impl Into<String>) -> Row {
        self.quantity = quantity.into();
        self.unit = unit.into();
        self
    }
}

/// All rows of a validation, sorted by case and quantity.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The rows.
    pub cases: Vec<Row>,
}

impl Report {
    /// Sorts rows into a report.
    pub fn new(mut rows: Vec<Row>) -> Report {
        rows.sort_by(|a, b| (&a.case, &a.quantity).cmp(&(&b.case, &b.quantity)));
        Report { cases: rows }
    }

    /// Number of rows with a verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.cases
            .iter()
            .filter(|row| row.verdict == verdict)
            .count()
    }

    /// True when nothing failed.
    pub fn passed(&self) -> bool {
        self.count(Verdict::Fail) == 0
    }

    /// One problem for each damaged file.
    pub fn problems(&self) -> impl Iterator<Item = Box<Problem>> {
        self.cases.iter().filter(|row| row.damaged).map(|row| {
            let found = format!("a case file that is {}", row.why);
            let needed = "a whole case file is needed; nothing of this one was compared";
            Problem::new(Code::CaseDamaged, row.case.clone(), found, needed)
        })
    }

    /// The report as JSON: `{"cases": [{"case", "quantity", "unit", "reference", "ours", "deviation", "tolerance",
    /// "verdict", "why"}, …]}`. A value that is not a number is `null`.
    pub fn to_json(&self) -> String {
        // Strings and numbers always serialise.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    /// The report as a table for people, with a summary line.
    pub fn to_text(&self) -> String {
        const HEAD: [&str; 8] = [
            "case",
            "quantity",
            "reference",
            "ours",
            "unit",
            "deviation",
            "tolerance",
            "verdict",
        ];
        let number = |value: Option<f64>| value.map_or(String::new(), digits);
        let short = |value: Option<f64>| value.map_or(String::new(), |x| format!("{x:.1e}"));
        let mut lines = vec![HEAD.map(str::to_string)];
        lines.extend(self.cases.iter().map(|row| {
            [
                row.case.clone(),
                row.quantity.clone(),
                number(row.reference),
                number(row.ours),
                row.unit.clone(),
                short(row.deviation),
                short(row.tolerance),
                row.verdict.word().to_string(),
            ]
        }));
        let mut widths = [0; 8];
        for line in &lines {
            for (width, cell) in widths.iter_mut().zip(line) {
                *width = (*width).max(cell.chars().count());
            }
        }
        let mut text = String::new();
        for (index, line) in lines.iter().enumerate() {
            let mut out = String::new();
            for (column, (cell, width)) in line.iter().zip(widths).enumerate() {
                let right = matches!(column, 2 | 3 | 5 | 6);
                let padded = if right {
                    format!("{cell:>width$}  ")
                } else {
                    format!("{cell:<width$}  ")
                };
                out.push_str(&padded);
            }
            text.push_str(out.trim_end());
            // A row that passes needs no words; the reason of a failure or omission does.
            if let Some(row) = index.checked_sub(1).map(|row| &self.cases[row])
                && row.verdict != Verdict::Pass
            {
                let _ = write!(text, "  ({})", row.why);
            }
            text.push('\n');
        }
        let _ = writeln!(
            text,
            "{} pass, {} fail, {} not run",
            self.count(Verdict::Pass),
            self.count(Verdict::Fail),
            self.count(Verdict::NotRun)
        );
        text
    }
}

/// Seven digits, plain where that stays readable.
fn digits(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_string()
    } else if (1e-3..1e7).contains(&size) {
        let decimals = (6 - size.log10().floor() as i32).max(0) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').to_string()
        } else {
            text
        }
    } else {
        format!("{value:.6e}")
    }
}
