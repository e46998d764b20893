//! Scenario files: what a user writes, read into typed values with their origin.
//!
//! One table of keys (`table.rs`) is the single source of names, kinds, units, ranges, defaults and explanations, and of
//! which system has which keys. From it come the reading, the messages, the overrides, the resolved file and the starting file.
//!
//! ```text
//! text + overrides ──document──▶ system; key, raw value, place
//!                  ──resolve───▶ one value per key: given ▸ catalogue ▸ default ▸ derived
//!                  ──drop, spin_up, torque, signals, rig, identify, rotor, coast_down──▶ typed SI values  ──checks──▶ Scenario
//! ```

#![forbid(unsafe_code)]

pub mod bearing;
pub mod checks;
pub mod coast_down;
pub mod document;
pub mod drop;
pub mod heat;
pub mod identify;
pub mod key;
pub mod limit;
pub mod locate;
pub mod meant;
pub mod measured;
pub mod not_modelled;
pub mod notes;
mod renamed;
pub mod resolve;
pub mod resolved;
pub mod rig;
pub mod rotor;
pub mod run;
pub mod schema;
pub mod section;
pub mod several;
pub mod signals;
pub mod spin_up;
pub mod study_document;
pub mod study_file;
mod study_inputs;
pub mod system;
pub mod table;
pub mod template;
pub mod torque;
pub mod values;
pub mod vary;

pub use bearing::fits::{Fits, Growth};
pub use bearing::kind::{BallMaterial, BearingType, Fidelity};
pub use bearing::lubricant::{DRAWN_ON, LubricantWarning, drawn_on};
pub use bearing::lubricant::{Lubricant, LubricantViscosity};
pub use bearing::lubricant_state::LubricantState;
pub use bearing::moment::{AccelerationLoss, Moment, MomentShare, RatedBearing};
pub use bearing::separation::{Cage, FullComplement, Guidance, Land, Separation};
pub use bearing::source::{BearingRecord, BearingSource, BuiltIn, NoBearings};
pub use bearing::spatial::{Arrangement, ContactNodes, PreloadSpring, Spatial, ThrustSide};
pub use bearing::{Bearing, Drag, OilFilm, Traction};
pub use coast_down::{CoastDown, CoastDownEnd, CoastingBearing};
pub use drop::axial_share;
pub use drop::case::{CASE, Cases};
pub use drop::event_checks::{MOST_LOADED, MOST_SPEEDS, MOST_UNBALANCES};
pub use drop::{
    AuxiliaryBearing, Base, BearingPlace, Body, CUTOFFS, Contact, Drop, Event, Gravity, Happens,
    Levitation, MagnetEvent, Mount, RecordFile, Relevitation, Repeat, RigidBody, Rotor, Shaft,
    Shock, Spectrum, Spin, When,
};
pub use heat::{Atmosphere, CageMaterial, Feedback, Heat, Warm};
pub use identify::{Explanations, Identify, RotorFriction};
pub use key::quoted;
pub use key::{Condition, Fallback, Key, Kind, Otherwise, Presence, Range, Section};
pub use limit::{Forbidden, Limit, Side};
pub use locate::{UNNAMED, problem_at};
pub use measured::Measured;
pub use problem::provenance::Provenance;
pub use renamed::present_name;
pub use resolved::{Resolved, ResolvedValue};
pub use rig::{
    BallPass, Engagement, Logger, RawFormat, Rig, RigArm, RigFlywheel, RigLoad, RigMotor,
    RigPickup, RigPickupKind, RigProgram, RigShaft, RigTemperature,
};
pub use rotor::{FlexibleRotor, Force, RotorAnalysis, parts_of};
pub use run::{Accuracy, Method, Run};
pub use schema::schema;
pub use signals::analysis::{
    ConverterSignal, InertiaSource, SteadySignal, VibrationSignal, Windage,
};
pub use signals::{
    CageKind, CageSignal, Disturbance, PickupFlank, PickupKind, SensorSource, Signals, SpeedSignal,
    TorqueSignal,
};
pub use spin_up::{Course, Drive, SpeedCourse, SpinUp};
pub use study_file::{STUDY_FORMAT, StudyFile};
pub use study_inputs::StudyInput;
pub use system::{KINDS, SystemName};
pub use table::{FORMAT, keys, keys_of, presence, sections, sections_of, systems};
pub use template::template;
pub use torque::{ComparedLaw, Torque};
pub use vary::UNBALANCE_ANGLE;
pub use vary::{Distribution, Vary};

use problem::warning::Warning;
use problem::{Code, Problem, Result};
use resolve::Before;
use std::path::Path;

/// Ends of the names of measurement files.
const MEASUREMENTS: [&str; 11] = [
    "csv", "tsv", "tdms", "uff", "unv", "mat", "h5", "hdf5", "parquet", "wav", "wave",
];

/// What is simulated or computed: the one place in which the systems of a scenario meet.
#[allow(clippy::large_enum_variant)] // one of them stands in memory at a time
#[derive(Clone, Debug, PartialEq)]
pub enum System {
    /// A levitated rotor, rigid or bent, is released onto its auxiliary bearings.
    Drop(Drop),
    /// The inner race of a bearing is brought to speed.
    SpinUp(SpinUp),
    /// The torque of a bearing over speed, load and acceleration.
    Torque(Torque),
    /// What a measurement holds.
    Signals(Signals),
    /// A test on a rig.
    Rig(Box<Rig>),
    /// What measured tests tell.
    Identify(Box<Identify>),
    /// A flexible rotor.
    Rotor(Box<RotorAnalysis>),
    /// A rotor that coasts down on its warming bearings.
    CoastDown(Box<CoastDown>),
}

/// Speeds with which inner races turn.
const SPEEDS_OF_BEARINGS: [&str; 5] = [
    "rotor.speed",
    "drive.rotor_speed",
    "drive.final_speed",
    "rig.speed",
    "torque.speed_to",
];

impl System {
    /// Its cases; none of what is no machine.
    pub fn cases(&self) -> Cases {
        match self {
            System::Drop(drop) => match &drop.body {
                Body::Flexible(shaft) => shaft.cases.clone(),
                Body::Rigid(_) => Cases::default(),
            },
            _ => Cases::default(),
        }
    }

    /// Its name.
    pub fn name(&self) -> SystemName {
        match self {
            System::Drop(drop) => match drop.body {
                Body::Rigid(_) => SystemName::Drop,
                Body::Flexible(_) => SystemName::Machine,
            },
            System::SpinUp(_) => SystemName::SpinUp,
            System::Torque(_) => SystemName::Torque,
            System::Signals(_) => SystemName::Signals,
            System::Rig(_) => SystemName::Rig,
            System::Identify(_) => SystemName::Identify,
            System::Rotor(_) => SystemName::Rotor,
            System::CoastDown(_) => SystemName::CoastDown,
        }
    }

    fn drop(&self) -> Option<&Drop> {
        match self {
            System::Drop(drop) => Some(drop),
            _ => None,
        }
    }

    /// The typed values of a document's system, checked; several auxiliary bearings have values each.
    fn of(
        document: &document::Document,
        all: &[values::Values],
        bearings: &dyn BearingSource,
        file: &str,
    ) -> Result<System> {
        let values = &all[0];
        for own in all {
            for path in SPEEDS_OF_BEARINGS {
                let pitch = own.number("bearing.pitch_diameter").unwrap_or_default();
                own.holds_together(path, own.number(path).unwrap_or_default(), 0.5 * pitch)?;
            }
        }
        let context = checks::Context { values, file };
        let system = match document.system {
            SystemName::Drop | SystemName::Machine => {
                let drop = Drop::of(document, all)?;
                context.drop(&drop, all)?;
                System::Drop(drop)
            }
            SystemName::SpinUp => {
                let spin_up = SpinUp::from_values(values);
                context.spin_up(&spin_up)?;
                System::SpinUp(spin_up)
            }
            SystemName::Signals => {
                let signals = Signals::from_values(values);
                context.signals(&signals)?;
                System::Signals(signals)
            }
            SystemName::Identify => {
                let identify = Box::new(Identify::from_values(values));
                context.identify(&identify)?;
                System::Identify(identify)
            }
            SystemName::Rig => {
                let rig = Box::new(Rig::from_values(values));
                context.rig(&rig)?;
                System::Rig(rig)
            }
            SystemName::Rotor => System::Rotor(Box::new(RotorAnalysis::of(document, values)?)),
            SystemName::CoastDown => {
                let run = Box::new(CoastDown::of(all));
                context.coast_down(&run, all)?;
                System::CoastDown(run)
            }
            SystemName::Torque => {
                let laws = torque::compared_laws(document, values, bearings);
                let torque = Torque::from_values(values, laws)?;
                context.torque(&torque)?;
                System::Torque(torque)
            }
        };
        all.iter().try_for_each(values::Values::complete)?;
        Ok(system)
    }
}

/// A scenario of which many are made that differ in a few values: the other values are not read again.
pub struct Variations<'a> {
    scenario: &'a Scenario,
    /// Of each auxiliary bearing, or of the whole file.
    before: Vec<Before>,
}

impl Variations<'_> {
    /// As [`Scenario::with`].
    ///
    /// # Errors
    /// What an override of this value would be refused for.
    pub fn with(&self, changes: &[(String, String)]) -> Result<Scenario> {
        self.scenario.changed(changes, &self.before)
    }
}

/// A scenario that was read and checked. It does not change; to vary it, read it again with an override.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Format of the file.
    pub format: String,
    /// Title of the report.
    pub title: Option<String>,
    /// Introduction of the report.
    pub description: Option<String>,
    /// What is simulated or computed.
    pub system: System,
    /// Every value with its origin.
    pub resolved: Resolved,
    /// What repeated runs vary.
    pub vary: Vec<Vary>,
    /// What results must hold.
    pub limits: Vec<Limit>,
    /// Measured channels beside predicted columns.
    pub measured: Vec<Measured>,
    /// What the user should know of the values themselves.
    pub notes: Vec<Warning>,
    /// What was read, to be read again with other values.
    document: document::Document,
}

impl Scenario {
    /// The drop of a rotor, rigid or flexible, where it is one.
    pub fn drop(&self) -> Option<&Drop> {
        self.system.drop()
    }

    /// The limits of the case that happens.
    pub fn limits_here(&self) -> Vec<Limit> {
        let cases = self.system.cases();
        let limits = self.limits.iter();
        let here = limits.filter(|limit| cases.happens(limit.case.as_deref()));
        here.cloned().collect()
    }

    /// The analysis of a rotor, where it is one.
    pub fn rotor(&self) -> Option<&RotorAnalysis> {
        match &self.system {
            System::Rotor(rotor) => Some(rotor),
            _ => None,
        }
    }

    /// Reads a file. An override is `path=value`, as after `--set`.
    pub fn read(path: &Path, sets: &[String], bearings: &dyn BearingSource) -> Result<Scenario> {
        if let Some(measurement) = measurement(path) {
            return Err(measurement);
        }
        let text = problem::read_text(path, "a scenario file")?;
        Scenario::parse(&text, &path.display().to_string(), sets, bearings)
    }

    /// Reads a text; the name stands for the file in messages.
    pub fn parse(
        text: &str,
        name: &str,
        sets: &[String],
        bearings: &dyn BearingSource,
    ) -> Result<Scenario> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.trim().is_empty() {
            return Err(Problem::new(
                Code::FileEmpty,
                name,
                "an empty file",
                "a scenario is needed; auxbear new drop writes one to start from",
            ));
        }
        Scenario::of(document::Document::read(text, name, sets)?, bearings, &[])
    }

    /// The scenario with other values at these paths, each as an override has it. Bearings are those of the built-in
    /// catalogue and of the file's own.
    ///
    /// # Errors
    /// What an override of this value would be refused for.
    pub fn with(&self, changes: &[(String, String)]) -> Result<Scenario> {
        self.changed(changes, &[])
    }

    fn changed(&self, changes: &[(String, String)], before: &[Before]) -> Result<Scenario> {
        let mut document = self.document.clone();
        for (path, value) in changes {
            document.add_override(&format!("{path}={value}"))?;
        }
        Scenario::of(document, &BuiltIn, before)
    }

    /// The scenario as the first of many that differ from it in a few values.
    pub fn variations(&self) -> Variations<'_> {
        let read = |document| Before::read(document, &BuiltIn);
        let documents = self.document.of_each_bearing();
        let before: Result<_> =
            documents.and_then(|documents| documents.into_iter().map(read).collect());
        Variations {
            scenario: self,
            // what cannot be read alone is read, and refused, with the changes
            before: before.unwrap_or_default(),
        }
    }

    /// The analysis of a machine's rotor, by default where a machine does not say what is asked; none of what is no machine.
    ///
    /// # Errors
    /// What this rotor would be refused for.
    pub fn rotor_alone(&self) -> Option<Result<Scenario>> {
        let machine = self.drop().filter(|drop| drop.body_bends())?;
        let alone = Scenario::of(self.document.rotor_alone(self.drive_speed()), &BuiltIn, &[]);
        Some(alone.map(|mut alone| {
            if let System::Rotor(analysis) = &mut alone.system {
                if let Body::Flexible(shaft) = &machine.body {
                    // with the angles of the machine's seed
                    (analysis.rotor.balance_planes).clone_from(&shaft.rotor.balance_planes);
                }
                analysis.machine = Some(Box::new(machine.clone()));
            }
            alone
        }))
    }

    /// Speed up to which a drive brings a rotor that starts at standstill, and what says so; none of a rotor that turns.
    fn drive_speed(&self) -> Option<(String, &'static str)> {
        let number = |path: &str| self.resolved.get(path)?.value_si;
        if number("rotor.speed") != Some(0.0) {
            return None;
        }
        let last = || self.document.last_of("rotor.torque_over_speed");
        let no_load = || {
            let (torque, slope) = (number("rotor.drive_torque")?, number("rotor.drive_slope")?);
            let runs = torque > 0.0 && slope > 0.0;
            runs.then(|| format!("{} rad/s", units::number_text(torque / slope)))
        };
        let table = last().map(|speed| (speed, "the last speed of rotor.torque_over_speed"));
        table.or_else(|| Some((no_load()?, "rotor.drive_torque over rotor.drive_slope")))
    }

    /// What a study varies of it: a path with its distribution as a table of one word.
    pub fn varied(&self, path: &str, raw: &document::Raw, place: problem::Place) -> Result<Vary> {
        let documents = self.document.of_each_bearing()?;
        let values = (documents.iter())
            .map(|document| values::Values::resolve(document, &BuiltIn, None))
            .collect::<Result<Vec<_>, _>>()?;
        let vary = vary::one(path, raw, place, &values)?;
        self.with_parts(std::slice::from_ref(&vary))?;
        Ok(vary)
    }

    /// Refuses what varies values of parts that are not there.
    fn with_parts(&self, list: &[Vary]) -> Result<()> {
        let middle = statistics::design::Coordinate::Share(0.5);
        let parts = list.iter().filter(|vary| vary.is_of_part());
        let values: Vec<_> = parts.flat_map(|vary| vary.at(middle).0).collect();
        if values.is_empty() {
            return Ok(());
        }
        let mut alone = self.clone();
        alone.document.vary.clear();
        alone.with(&values).map(|_| ())
    }

    /// Limits of its results from tables of another file.
    pub fn limits_of(
        &self,
        file: &str,
        tables: Vec<Vec<problem::raw::Written>>,
    ) -> Result<Vec<Limit>> {
        let mut document = self.document.clone();
        document.file = file.to_string();
        document.limits = tables;
        limit::of(&document, &self.system.cases())
    }

    /// Resolves and checks what was read.
    fn of(
        document: document::Document,
        bearings: &dyn BearingSource,
        before: &[Before],
    ) -> Result<Scenario> {
        let name = &document.file.clone();
        let documents = document.of_each_bearing()?;
        let mut values = (documents.iter().enumerate())
            .map(|(k, document)| values::Values::resolve(document, bearings, before.get(k)))
            .collect::<Result<Vec<_>, _>>()?;
        let system = System::of(&documents[0], &values, bearings, name)?;
        if system.drop().is_some_and(Drop::loses_power_by_events) {
            values[0].known.remove(drop::LOST_AT);
        }
        let vary = match &system {
            System::Drop(drop) => vary::of_drop(&drop.repeat, &document.vary, &values)?,
            _ => Vec::new(),
        };
        let limits = limit::of(&document, &system.cases())?;
        let measured = measured::of(&document)?;
        let parts = rotor::tables::toml(&document, &values[0]);
        let mut notes: Vec<Warning> = Vec::new();
        for note in values.iter().flat_map(values::Values::notes) {
            // what is of the whole file is noted of each of several bearings
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
        let scenario = Scenario {
            format: FORMAT.to_string(),
            title: values[0].text("title"),
            description: values[0].text("description"),
            system,
            resolved: values::Values::resolved(&values)
                .varied(&vary)
                .of_parts(parts)
                .listed(limits.iter().map(Limit::toml))
                .listed(measured.iter().map(Measured::toml)),
            vary,
            limits,
            measured,
            notes,
            document,
        };
        scenario.with_parts(&scenario.vary)?;
        Ok(scenario)
    }

    /// The problem with the file and the line of its key: where the key stands, else where the section begins.
    pub fn locate(&self, problem: Box<Problem>) -> Box<Problem> {
        self.document.locate(&self.resolved, problem)
    }
}

/// A file of measured values in the place of the scenario that should name it.
fn measurement(path: &Path) -> Option<Box<Problem>> {
    let end = path.extension()?.to_str()?.to_lowercase();
    if !MEASUREMENTS.contains(&end.as_str()) || !path.is_file() {
        return None;
    }
    let name = path.display();
    Some(Problem::at_path(
        Code::MeasurementInstead,
        path,
        "a file of measured values",
        format!(
            "a scenario that names it is needed: auxbear new signals writes one, with signals.file = \"{name}\", for auxbear signals; \
             auxbear new identify one for auxbear identify"
        ),
    ))
}
