//! What was found in a measurement.

use crate::signals::warning_table::SignalsWarning;
use crate::signals::{cage, converter, shaft, steady, temperature, torque, vibration};
use identify::coasting::Windage;
use measure::cage_speed::CageSpeed;
use measure::order::Order;
use measure::pulse::{Gap, Pulses};
use measure::speed::Change;
use measure::torque_sensor::{DesignError, Sensor, Torque};
use outcome::Warning;
use problem::note::Note;
use std::sync::Arc;

/// Why the torque is not known without the swing of its sensor.
const NO_SENSOR: &str = "no sensor is given";

/// A part of what was found that may have been refused.
type Part<F, T> = fn(&F) -> &Result<T, String>;

/// What was found, and what to know of it.
#[derive(Default)]
pub(crate) struct Estimate {
    pub shaft: Option<Arc<shaft::Estimate>>,
    pub torque: Option<Arc<torque::Estimate>>,
    pub cage: Option<cage::Estimate>,
    /// Temperature of the outer race, K, about every 50 ms.
    pub temperature: Option<temperature::Estimate>,
    pub vibration: Option<vibration::Estimate>,
    pub steady: Option<steady::Estimate>,
    /// Channels held against their converter.
    pub converted: Vec<converter::Converted>,
    /// What an estimator refused: a name of the channel's part, and why.
    pub refused: Vec<(&'static str, String)>,
    pub warnings: Vec<Warning>,
}

impl Estimate {
    /// Warns of each note of an estimator.
    pub(crate) fn warn<'a>(
        &mut self,
        about: &str,
        notes: impl IntoIterator<Item = &'a Note>,
        of: fn(String, Note) -> SignalsWarning,
    ) {
        let all = notes.into_iter().cloned();
        self.warnings
            .extend(all.map(|note| Warning::from(of(about.to_string(), note))));
    }

    /// What a part answers; remembers why one does not.
    pub(crate) fn answer<T>(&mut self, part: &'static str, answer: Result<T, String>) -> Option<T> {
        let refused = |why| self.refused.push((part, why));
        answer.map_err(refused).ok()
    }

    /// Warns of what an estimator says of its result.
    pub(crate) fn note(&mut self, about: &str, notes: &[Note]) {
        self.warn(about, notes, |about, note| SignalsWarning::Estimate {
            about,
            note,
        });
    }

    /// Why a part that was asked for has no numbers.
    pub fn why(&self, part: &'static str) -> String {
        let refused = self.refused.iter().find(|(name, _)| *name == part);
        refused.map_or_else(
            || "what it needs was not found".to_string(),
            |(_, why)| why.clone(),
        )
    }

    /// The motion of the shaft; why there is none.
    pub fn shaft(&self) -> Result<&shaft::Estimate, String> {
        self.shaft.as_deref().ok_or_else(|| self.why("speed"))
    }

    /// The channel of a speed.
    pub fn channel(&self) -> Result<&shaft::Channel, String> {
        match &self.shaft()?.seen {
            shaft::MotionSource::Channel(channel) => Ok(channel),
            shaft::MotionSource::Marks { .. } => Err("the channel holds marks".to_string()),
        }
    }

    /// The marks that passed.
    pub fn pulses(&self) -> Result<&Pulses, String> {
        self.shaft()?.pulses()
    }

    /// A value of each gap in the signal.
    pub fn over_gaps(&self, value: fn(&Gap) -> f64) -> Result<Vec<f64>, String> {
        let shaft = self.shaft()?;
        Ok(shaft.speed.gaps().map(value).collect())
    }

    /// The quick change of the speed.
    pub fn change(&self) -> Result<Change, String> {
        let none = || "there is no quick change of speed in the record".to_string();
        self.shaft()?.speed.change.ok_or_else(none)
    }

    /// Instant at which it ends with its deviation, s.
    pub fn change_end(&self) -> Result<(f64, f64), String> {
        let none = || "the record ends before the change does".to_string();
        self.change()?.end.ok_or_else(none)
    }

    fn reading(&self) -> Result<&torque::Estimate, String> {
        self.torque.as_deref().ok_or_else(|| self.why("torque"))
    }

    /// A part of what was found of the torque.
    pub fn torque<T>(&self, part: Part<torque::Estimate, T>) -> Result<&T, String> {
        part(self.reading()?).as_ref().map_err(Clone::clone)
    }

    /// The sensor of the torque.
    pub fn sensor(&self) -> Result<Sensor, String> {
        self.reading()?.sensor.ok_or_else(|| NO_SENSOR.to_string())
    }

    /// The torque without the swing of the sensor.
    pub fn inverted(&self) -> Result<&Torque, String> {
        let torque = self.reading()?.torque.as_ref();
        torque.ok_or_else(|| NO_SENSOR.to_string())
    }

    /// The same where all of it is known: the largest may be where a clipped reading hides it.
    pub fn whole_torque(&self) -> Result<&Torque, String> {
        let hidden = self.reading()?.hidden.clone();
        hidden.map_or_else(|| self.inverted(), Err)
    }

    /// A value of each sensor that was compared.
    pub fn designs(&self, value: fn(&DesignError) -> f64) -> Result<Vec<f64>, String> {
        let errors = self.torque(|part| &part.design)?;
        Ok(errors.iter().map(value).collect())
    }

    /// A value of the motion of the cage.
    pub fn cage(&self, value: impl Fn(&CageSpeed) -> f64) -> Result<f64, String> {
        let cage = self.cage.as_ref().ok_or_else(|| self.why("cage"))?;
        let none = "the cage speed has no value there: the warnings say why";
        let known = Some(value(&cage.told)).filter(|value| !value.is_nan());
        known.ok_or_else(|| none.to_string())
    }

    fn vibrations(&self) -> Result<&vibration::Estimate, String> {
        let found = self.vibration.as_ref();
        found.ok_or_else(|| self.why("vibration"))
    }

    /// A picture of a vibration.
    pub fn vibration<T>(&self, part: Part<vibration::Estimate, T>) -> Result<&T, String> {
        part(self.vibrations()?).as_ref().map_err(Clone::clone)
    }

    /// A value of each order of a vibration.
    pub fn orders(&self, value: fn(&Order) -> f64) -> Result<Vec<f64>, String> {
        let none = || "signals.vibration.orders is not given".to_string();
        let found = self.vibrations()?.orders.as_ref().ok_or_else(none)?;
        Ok(found.orders.iter().map(value).collect())
    }

    /// What was found in slow runs.
    pub fn slow(&self) -> Result<&steady::Estimate, String> {
        self.steady.as_ref().ok_or_else(|| self.why("steady"))
    }

    /// A part of it.
    pub fn steady<T>(&self, part: Part<steady::Estimate, T>) -> Result<&T, String> {
        part(self.slow()?).as_ref().map_err(Clone::clone)
    }

    /// A value of the windage at each speed of the slow runs.
    pub fn windage(&self, value: fn(&Windage, f64) -> Option<f64>) -> Result<Vec<f64>, String> {
        let windage = self.steady(|part| &part.windage)?;
        let speeds = self.slow()?.speed.iter();
        let values = speeds.map(|speed| value(windage, *speed).unwrap_or(f64::NAN));
        Ok(values.collect())
    }
}
