//! What is wrong with cells and lines, and how times are rounded.

use super::cell;
use super::lines;

/// What was found in one column that is no value.
#[derive(Clone, Default)]
pub(super) struct Faults {
    /// Empty cells, and the line of the first.
    pub missing: (u64, u64),
    /// Cells with a text, and the line of the first.
    pub texts: (u64, u64),
    pub example: String,
}

/// What was found in the lines.
#[derive(Default)]
pub(super) struct Lost {
    pub short: (u64, u64),
    pub long: (u64, u64),
    pub left_out: (u64, u64),
}

/// Counts a line, and keeps the first.
pub(super) fn count(found: &mut (u64, u64), line: u64) {
    if found.0 == 0 {
        found.1 = line;
    }
    found.0 += 1;
}

/// How the times of a column are rounded, learned from line to line.
#[derive(Default)]
pub(super) struct Rounding {
    decimals: i32,
    significant: i32,
}

impl Rounding {
    /// The spacing of numbers around the one of a cell: by the most decimals seen, or by the most significant digits
    /// where those leave fewer decimals.
    pub fn of(&mut self, cell: &[u8], comma: bool, number: f64) -> f64 {
        let (decimals, significant) = cell::digits(cell, comma);
        self.decimals = self.decimals.max(decimals);
        self.significant = self.significant.max(significant);
        let by_decimals = 10f64.powi(-self.decimals.clamp(-300, 300));
        if number == 0.0 || !number.is_finite() {
            return by_decimals;
        }
        let rank = number.abs().log10().floor() as i32;
        by_decimals.max(10f64.powi((rank - self.significant + 1).clamp(-300, 300)))
    }
}

impl Faults {
    /// Counts an empty cell, or one with a text.
    pub fn add(&mut self, text: Option<&[u8]>, line: u64) {
        match text {
            None => count(&mut self.missing, line),
            Some(cell) => {
                if self.texts.0 == 0 {
                    self.example = lines::text(cell).chars().take(20).collect();
                }
                count(&mut self.texts, line);
            }
        }
    }
}
