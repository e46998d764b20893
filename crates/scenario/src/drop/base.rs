//! Motion of the base of a machine: a record of its acceleration, a record made of a response spectrum, a shock.

use crate::drop::case::{Cases, OF_BASE};
use crate::key::{Key, Kind, Range, Section};
use crate::run::Until;
use crate::system::{FALLING, MACHINE, SystemName};
use crate::values::Values;
use problem::{Code, Result};
use std::path::PathBuf;
use units::number_text;

const SYSTEMS: &[SystemName] = FALLING;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[Section::new("base", "How the base that carries magnets, mounts and seals is accelerated: an earthquake, a shock, a vehicle. Displacements are relative to it. What is given of record, spectrum and shock adds up. It translates in the plane of the bearings.", SYSTEMS)];

const fn record(path: &'static str, doc: &'static str) -> Key {
    let example = "[[\"0 s\", \"0 m/s^2\"], [\"10 ms\", \"5 m/s^2\"], [\"20 ms\", \"0 m/s^2\"]]";
    Key::new(path, Kind::Table("s", "m/s^2"), example, doc).optional("no such record")
}

const fn share(path: &'static str, doc: &'static str) -> Key {
    Key::new(path, Kind::Coefficient, "0.67", doc).within(Range::FromTo(0.0, 10.0))
}

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new(OF_BASE, Kind::Text, "earthquake", "Name of the case in which the base moves, as run.case has it.").optional("it moves in every case").only(MACHINE),
    record("base.record_x", "Acceleration of the base along x over time, in m/s^2 or gn: straight between the rows, none before the first and after the last."),
    record("base.record_y", "The same along y."),
    Key::new(FILE, Kind::Text, "earthquake.csv", "File with a record, relative to this one: CSV, Parquet, TDMS, UFF 58, MAT, HDF5 or WAV, with a clock and the unit of each channel.").optional("no record from a file"),
    Key::new("base.channel_x", Kind::Text, "east", "Channel of the file with the acceleration along x.").optional("none along x"),
    Key::new("base.channel_y", Kind::Text, "up", "Channel of the file with the acceleration along y.").optional("none along y"),
    Key::new("base.start", Kind::Quantity("s"), "0.2 s", "Instant of the run at which time 0 of the record lies, or the start of the record of a spectrum.").not_negative().default("0 s", "the record begins with the run"),
    Key::new("base.scale", Kind::Coefficient, "1.5", "Factor on all accelerations of record and spectrum; not on those of a shock.").within(Range::FromTo(0.0, 1000.0)).default("1.0", "no change of them"),
    Key::new(SPECTRUM, Kind::Table("Hz", "m/s^2"), "[[\"1 Hz\", \"2 m/s^2\"], [\"3 Hz\", \"6 m/s^2\"], [\"10 Hz\", \"6 m/s^2\"], [\"33 Hz\", \"2.5 m/s^2\"]]", "Largest absolute acceleration of an oscillator over its natural frequency, straight between the rows on logarithmic axes. A record is made of it: sines with drawn phases under an envelope, corrected until its own spectrum is within 10 % between the first and the last frequency, without velocity and displacement left at its end.").optional("no record of a spectrum"),
    Key::new("base.spectrum_damping", Kind::Coefficient, "0.05", "Damping ratio of the oscillators.").within(Range::FromTo(0.001, 0.5)).default("0.05", "that of most response spectra"),
    share("base.spectrum_x", "Factor on the spectrum along x; 0: no motion along x. Both directions have phases of their own.").default("1.0", "the whole spectrum"),
    share("base.spectrum_y", "The same along y.").default("0.0", "no motion along y"),
    Key::new("base.spectrum_rise", Kind::Quantity("s"), "2 s", "Time in which the envelope of its record rises, linearly.").positive().default("2 s", "an earthquake of moderate size"),
    Key::new("base.spectrum_hold", Kind::Quantity("s"), "10 s", "Time for which it stays.").not_negative().default("10 s", "the strong motion of such an earthquake"),
    Key::new("base.spectrum_decay", Kind::Quantity("s"), "8 s", "Time in which it falls, linearly.").positive().default("8 s", "the end of such an earthquake"),
    Key::new("base.spectrum_seed", Kind::Count, "1", "Seed of the phases: another seed is another earthquake of the same spectrum.").not_negative().default("1", "any number serves"),
    Key::new("base.shock_x", Kind::Quantity("m/s^2"), "50 m/s^2", "Largest acceleration along x of a shock whose acceleration is half a period of a sine.").optional("no acceleration along x"),
    Key::new("base.shock_y", Kind::Quantity("m/s^2"), "50 m/s^2", "The same along y.").optional("no acceleration along y"),
    Key::new("base.shock_start", Kind::Quantity("s"), "0.1 s", "Instant of the run at which the shock begins.").not_negative().default("0 s", "with the run"),
    Key::new(DURATION, Kind::Quantity("s"), "11 ms", "Duration of the shock.").positive().optional("needed beside a shock"),
];

/// Key of the file, which stands beside the scenario.
pub(crate) const FILE: &str = "base.file";
const SPECTRUM: &str = "base.spectrum";
const DURATION: &str = "base.shock_duration";

const OF_SPECTRUM: &[&str] = &[
    "spectrum_damping",
    "spectrum_x",
    "spectrum_y",
    "spectrum_rise",
    "spectrum_hold",
    "spectrum_decay",
    "spectrum_seed",
];

/// Motion of the base.
#[derive(Clone, Debug, PartialEq)]
pub struct Base {
    /// Rows of time, s, and acceleration, m/s², along x and along y.
    pub record: [Vec<[f64; 2]>; 2],
    /// A file with a record.
    pub file: Option<RecordFile>,
    /// When the record begins, s.
    pub start: f64,
    /// Factor on record and spectrum.
    pub scale: f64,
    /// A spectrum that a record is made of.
    pub spectrum: Option<Spectrum>,
    /// A shock.
    pub shock: Option<Shock>,
    /// The case in which it moves; in each without.
    pub case: Option<String>,
}

/// A file with a record of accelerations.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordFile {
    /// The file.
    pub path: PathBuf,
    /// Its channels along x and along y.
    pub channels: [Option<String>; 2],
}

/// A response spectrum with what makes a record of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Rows of frequency, rad/s, and acceleration, m/s².
    pub rows: Vec<[f64; 2]>,
    /// Damping ratio of the oscillators.
    pub damping: f64,
    /// Factors along x and along y.
    pub shares: [f64; 2],
    /// Rise, hold and decay of the envelope, s.
    pub envelope: [f64; 3],
    /// Seed of the phases.
    pub seed: u64,
}

/// A half-sine of acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shock {
    /// Its start, s.
    pub start: f64,
    /// Its duration, s.
    pub duration: f64,
    /// Largest acceleration along x and along y, m/s².
    pub acceleration: [f64; 2],
}

impl Base {
    /// The motion of the base of a file in the case that happens, where there is any.
    pub(crate) fn of(values: &Values, cases: &Cases) -> Result<Option<Base>> {
        let own = values.section("base");
        let record = ["record_x", "record_y"].map(|key| own.rows(key).unwrap_or_default());
        let path = values.text(FILE).map(PathBuf::from);
        let rows = own.rows("spectrum").unwrap_or_default();
        let shock = ["base.shock_x", "base.shock_y"].map(|path| values.number(path));
        let shaken = shock.iter().any(Option::is_some);
        let base = Base {
            file: path.map(|path| RecordFile {
                path,
                channels: ["base.channel_x", "base.channel_y"].map(|path| values.text(path)),
            }),
            start: own.number("start"),
            scale: own.number("scale"),
            spectrum: (!rows.is_empty()).then(|| Spectrum {
                rows: rows
                    .iter()
                    .map(|[frequency, acceleration]| {
                        [std::f64::consts::TAU * frequency, *acceleration]
                    })
                    .collect(),
                damping: own.number("spectrum_damping"),
                shares: ["spectrum_x", "spectrum_y"].map(|key| own.number(key)),
                envelope: ["spectrum_rise", "spectrum_hold", "spectrum_decay"]
                    .map(|key| own.number(key)),
                seed: own.count("spectrum_seed"),
            }),
            shock: shaken.then(|| Shock {
                start: own.number("shock_start"),
                duration: own.maybe("shock_duration").unwrap_or_default(),
                acceleration: shock.map(Option::unwrap_or_default),
            }),
            record,
            case: values.text(OF_BASE),
        };
        let any = base.record.iter().any(|rows| !rows.is_empty());
        let recorded = any || base.file.is_some() || base.spectrum.is_some();
        for (there, needed, keys) in [
            (
                base.file.is_some(),
                "base.file",
                &["channel_x", "channel_y"][..],
            ),
            (
                recorded,
                "a record, a file or a spectrum",
                &["start", "scale"],
            ),
            (base.spectrum.is_some(), "base.spectrum", OF_SPECTRUM),
            (
                recorded || shaken,
                "a record, a file, a spectrum or a shock",
                &["case"],
            ),
            (
                shaken,
                "base.shock_x or base.shock_y",
                &["shock_start", "shock_duration"],
            ),
        ] {
            let mut own = keys.iter().map(|key| format!("base.{key}"));
            if let Some(key) = own.find(|key| !there && values.is_own(key)) {
                let allowed = format!("it is used only beside {needed}");
                return values.refuse(Code::UnusedKey, &key, "a key that has no effect", allowed);
            }
        }
        if !(recorded || shaken) {
            return Ok(None);
        }
        base.check(values)?;
        if !cases.happens(base.case.as_deref()) {
            return Ok(None);
        }
        base.until_standstill(values)?;
        Ok(Some(base))
    }

    /// Refuses one beside a coast-down.
    fn until_standstill(&self, values: &Values) -> Result<()> {
        if values.chosen("run.until") != Some(Until::Standstill) {
            return Ok(());
        }
        let keys = [
            FILE,
            SPECTRUM,
            "base.record_x",
            "base.record_y",
            "base.shock_x",
        ];
        let key = keys.into_iter().find(|key| values.is_own(key));
        let found = "a base that moves beside run.until = \"standstill\"";
        let allowed =
            "run.until = \"duration\" is needed: the coast-down knows no motion of the base";
        values.refuse(
            Code::Conflict,
            key.unwrap_or("base.shock_y"),
            found,
            allowed,
        )
    }

    /// Refuses a motion that is none.
    fn check(&self, values: &Values) -> Result<()> {
        if let Some(file) = &self.file {
            if file.channels.iter().all(Option::is_none) {
                let allowed = "base.channel_x or base.channel_y is needed";
                let found = "a file of which no channel is named";
                return values.refuse(Code::MissingKey, FILE, found, allowed);
            }
            if let Some(key) = ["base.record_x", "base.record_y"]
                .into_iter()
                .find(|key| values.is_own(key))
            {
                let found = "a record beside that of base.file";
                return values.refuse(Code::Conflict, key, found, "one of the two is needed");
            }
        }
        if self.shock.is_some() && values.number(DURATION).is_none() {
            let allowed = "base.shock_duration is needed";
            return values.refuse(Code::MissingKey, DURATION, "a shock without it", allowed);
        }
        let Some(spectrum) = &self.spectrum else {
            return Ok(());
        };
        let wrong = |row: &[f64; 2]| row.iter().any(|value| *value <= 0.0);
        let found = match spectrum.rows.iter().position(wrong) {
            Some(row) => Some(format!("a value that is not positive in row {}", row + 1)),
            None => (spectrum.rows.len() < 2).then(|| "one row".to_string()),
        };
        if let Some(found) = found {
            let allowed = "two rows or more of positive frequencies and accelerations are needed";
            return values.refuse(Code::OutOfRange, SPECTRUM, found, allowed);
        }
        let slowest = std::f64::consts::TAU / spectrum.rows[0][0];
        let length: f64 = spectrum.envelope.iter().sum();
        if length < LEAST_PERIODS * slowest {
            let found = format!("{} s of envelope", number_text(length));
            let least = (1e6 * LEAST_PERIODS * slowest).round() / 1e6;
            let allowed = format!(
                "at least {} s, {LEAST_PERIODS} periods of the lowest frequency of base.spectrum, are needed",
                number_text(least)
            );
            return values.refuse(Code::OutOfRange, "base.spectrum_hold", found, allowed);
        }
        Ok(())
    }
}

/// Periods of its lowest frequency that a record of a spectrum lasts at least: fewer do not let that oscillator swing.
const LEAST_PERIODS: f64 = 4.0;
