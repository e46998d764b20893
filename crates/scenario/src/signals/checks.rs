//! Checks of what is asked of a measurement.

use crate::checks::{Check, Context};
use crate::signals::{PickupKind, Signals, SpeedSignal};
use crate::table;
use problem::Code;

impl Context<'_> {
    pub(crate) fn signals(&self, signals: &Signals) -> Check {
        if let (Some(from), Some(to)) = (signals.from, signals.to)
            && to <= from
        {
            return self.refuse_value(
                Code::OutOfRange,
                "signals.to",
                format!(
                    "more than signals.from = {} is needed",
                    self.text("signals.from")
                ),
            );
        }
        for section in [
            "signals.speed",
            "signals.torque",
            "signals.cage",
            "signals.vibration",
        ] {
            self.without_channel(section)?;
        }
        let with_marks = |speed: &SpeedSignal| !matches!(speed.kind, PickupKind::Speed { .. });
        if signals.speed.as_ref().is_some_and(with_marks) {
            self.needed(
                "signals.speed.marks_per_revolution",
                "signals.speed.channel",
            )?;
        }
        if let Some(speed) = signals.speed.as_ref().filter(|speed| with_marks(speed))
            && speed.missing_marks >= speed.marks_per_revolution
        {
            return self.refuse_value(
                Code::OutOfRange,
                "signals.speed.missing_marks",
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
        if signals.vibration.is_some() {
            self.needed("signals.speed.channel", "signals.vibration.channel")?;
        }
        self.orders(signals)?;
        self.converter(signals)?;
        self.parts(signals)
    }

    fn orders(&self, signals: &Signals) -> Check {
        let path = "signals.vibration.orders";
        let Some(vibration) = &signals.vibration else {
            return Ok(());
        };
        let texts = self.values.texts(path);
        let sound = |order: &f64| *order > 0.0 && *order < 1e4;
        if let Some(at) = vibration.orders.iter().position(|order| !sound(order)) {
            let found = format!("\"{}\" as entry {}", texts[at], at + 1);
            return self.refuse(
                Code::OutOfRange,
                path,
                found,
                "positive numbers in quotes are needed, e.g. [\"1\", \"2\"]",
            );
        }
        if texts.len() > 8 {
            let found = format!("{} orders", texts.len());
            return self.refuse(Code::OutOfRange, path, found, "8 at most are followed");
        }
        Ok(())
    }

    fn converter(&self, signals: &Signals) -> Check {
        let channels = "signals.converter.channels";
        let Some(converter) = &signals.converter else {
            return self.together("signals.converter", channels);
        };
        for path in ["signals.converter.highest", "signals.converter.bits"] {
            self.needed(path, channels)?;
        }
        if converter.lowest < converter.highest {
            return Ok(());
        }
        let path = "signals.converter.highest";
        let needed = "more than signals.converter.lowest is needed; a positive number where that is not given";
        self.refuse_value(Code::OutOfRange, path, needed)
    }

    /// Parts of the record: begin and end together, in this order.
    fn parts(&self, signals: &Signals) -> Check {
        const PARTS: [[&str; 2]; 3] = [
            ["signals.speed.change_from", "signals.speed.change_to"],
            ["signals.steady.from", "signals.steady.to"],
            ["signals.steady.up_from", "signals.steady.up_to"],
        ];
        for [from, to] in PARTS {
            for (one, other) in [(from, to), (to, from)] {
                if self.values.is_given(one) {
                    self.needed(other, one)?;
                }
            }
            if let (Some(begin), Some(end)) = (self.values.number(from), self.values.number(to))
                && end <= begin
            {
                let needed = format!("more than {from} = {} is needed", self.text(from));
                return self.refuse_value(Code::OutOfRange, to, &needed);
            }
        }
        if signals.steady.is_some() {
            self.needed("signals.speed.channel", "signals.steady.from")?;
            return self.windage();
        }
        self.together("signals.steady", "signals.steady.from")
    }

    /// A windage is a law with a constant, a linear or a quadratic part, or a run without bearing.
    fn windage(&self) -> Check {
        const LAW: [&str; 3] = [
            "signals.steady.windage_constant",
            "signals.steady.windage_linear",
            "signals.steady.windage_quadratic",
        ];
        let file = "signals.steady.windage_file";
        let part = LAW.into_iter().find(|path| self.values.is_given(path));
        if let (Some(part), true) = (part, self.values.is_given(file)) {
            let needed = format!(
                "either the law of the windage ({part}) or a run without bearing is needed"
            );
            return self.refuse_value(Code::Conflict, file, &needed);
        }
        Ok(())
    }

    /// Refuses a key that is given in a section whose first key is not.
    fn together(&self, section: &str, first: &str) -> Check {
        let given =
            table::keys().find(|key| key.section() == section && self.values.is_given(key.path));
        match given {
            Some(key) if !self.values.is_given(first) => self.refuse(
                Code::UnusedKey,
                key.path,
                "a key that has no effect".to_string(),
                format!("{first} is needed with it"),
            ),
            _ => Ok(()),
        }
    }

    /// Refuses a key that is given in a section whose channel is not.
    fn without_channel(&self, section: &str) -> Check {
        self.together(section, &format!("{section}.channel"))
    }

    /// Refuses that a key is missing which another one needs.
    pub fn needed(&self, path: &'static str, by: &str) -> Check {
        if self.values.is_given(path) {
            return Ok(());
        }
        let key = table::key(path);
        let needed = key.map_or(String::new(), |key| key.needed());
        self.refuse(
            Code::MissingKey,
            path,
            "no value".to_string(),
            format!("with {by} {needed}"),
        )
    }
}
