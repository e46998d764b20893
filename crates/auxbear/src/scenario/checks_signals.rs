//! Checks of what is asked of a measurement.

use super::checks::{Check, Context};
use super::signals::Signals;
use super::table;
use crate::problem::Code;

impl Context<'_> {
    pub(super) fn signals(&self, signals: &Signals) -> Check {
        if let (Some(from), Some(to)) = (signals.from, signals.to)
            && to <= from
        {
            return self.refuse(
                Code::OutOfRange,
                "signals.to",
                self.text("signals.to"),
                &format!(
                    "more than signals.from = {} is needed",
                    self.text("signals.from")
                ),
            );
        }
        for section in ["signals.speed", "signals.torque", "signals.cage"] {
            self.without_channel(section)?;
        }
        if signals.speed.is_some() {
            self.needed(
                "signals.speed.marks_per_revolution",
                "signals.speed.channel",
            )?;
        }
        if let Some(speed) = &signals.speed
            && speed.missing_marks >= speed.marks_per_revolution
        {
            return self.refuse(
                Code::OutOfRange,
                "signals.speed.missing_marks",
                self.text("signals.speed.missing_marks"),
                "fewer than signals.speed.marks_per_revolution are needed",
            );
        }
        if signals.torque.is_some() {
            let (frequency, damping) = (
                "signals.torque.sensor_frequency",
                "signals.torque.damping_ratio",
            );
            if self.values.is_given(frequency) {
                self.needed(damping, frequency)?;
            }
            if self.values.is_given(damping) {
                self.needed(frequency, damping)?;
            }
            for path in ["signals.torque.tap_channel", "signals.torque.tap_start"] {
                if self.values.is_given(path) {
                    self.needed("signals.torque.tap_file", path)?;
                }
            }
        }
        if signals.cage.is_some() {
            for path in [
                "signals.cage.ball_count",
                "signals.cage.rolling_ratio",
                "signals.speed.channel",
            ] {
                self.needed(path, "signals.cage.channel")?;
            }
        }
        Ok(())
    }

    /// Refuses a key that is given in a section whose channel is not.
    fn without_channel(&self, section: &str) -> Check {
        let channel = format!("{section}.channel");
        if self.values.is_given(&channel) {
            return Ok(());
        }
        let given =
            table::keys().find(|key| key.section() == section && self.values.is_given(key.path));
        let Some(key) = given else { return Ok(()) };
        self.refuse(
            Code::UnusedKey,
            key.path,
            "a key that has no effect".to_string(),
            &format!("{channel} is needed with it"),
        )
    }

    /// Refuses that a key is missing which another one needs.
    pub(super) fn needed(&self, path: &'static str, by: &str) -> Check {
        if self.values.is_given(path) {
            return Ok(());
        }
        let key = table::keys().find(|key| key.path == path);
        let needed = key.map_or(String::new(), |key| key.needed());
        self.refuse(
            Code::MissingKey,
            path,
            "no value".to_string(),
            &format!("with {by} {needed}"),
        )
    }

    pub(super) fn refuse(&self, code: Code, path: &str, found: String, needed: &str) -> Check {
        Err(Box::new(self.problem(
            code,
            path,
            found,
            needed.to_string(),
        )))
    }
}
