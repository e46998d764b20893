//! What was found in a measurement.

use crate::analyse::signals::{cage, converter, shaft, steady, temperature, torque, vibration};
use crate::result::outcome::Warning;
use std::sync::Arc;

/// What was found, and what to know of it.
#[derive(Default)]
pub(crate) struct Found {
    pub shaft: Option<Arc<shaft::Found>>,
    pub torque: Option<Arc<torque::Found>>,
    pub cage: Option<cage::Found>,
    /// Temperature of the outer race, K, about every 50 ms.
    pub temperature: Option<temperature::Found>,
    pub vibration: Option<vibration::Found>,
    pub steady: Option<steady::Found>,
    /// Channels held against their converter.
    pub converted: Vec<converter::Converted>,
    /// What an estimator refused: a name of the channel's part, and why.
    pub refused: Vec<(&'static str, String)>,
    pub warnings: Vec<Warning>,
}

impl Found {
    pub(crate) fn warn(&mut self, code: &'static str, part: &str, notes: &[String]) {
        for note in notes {
            let text = format!("{part}: {}.", note.trim_end_matches('.'));
            self.warnings.push(Warning { code, text });
        }
    }

    /// Why a part that was asked for has no numbers.
    pub fn why(&self, part: &'static str) -> String {
        let refused = self.refused.iter().find(|(name, _)| *name == part);
        refused.map_or_else(
            || "what it needs was not found".to_string(),
            |(_, why)| why.clone(),
        )
    }
}
