//! An instance of a unit, from its resources to its end: what both versions of the interface share. Safe; knows no pointers.

use crate::package::{self, Resources};
use crate::variables::{self, Choice, Kind, Role, Variable};
use auxbear::report::directory::NewDirectory;
use auxbear::run::{Driven, DrivenState, Driving};
use auxbear::{BuiltIn, Reached, Scenario, build};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// Why something was refused, in words.
pub type Fault = String;

/// How far an instance has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Phase {
    /// Parameters may be set.
    Instantiated,
    /// The same, and inputs show in outputs.
    Initializing,
    /// It goes on.
    Stepping,
    /// It is over.
    Terminated,
}

/// Where a step ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Stepped {
    /// Where it was to end.
    There,
    /// Earlier, at a contact.
    Contact,
    /// Earlier, and nothing comes after it; why.
    Over(String),
}

/// What was done since the start: inputs that changed, by value references, then the time that was gone on to, s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Entry {
    pub inputs: Vec<(u32, f64)>,
    pub until: f64,
}

/// What was set besides the defaults.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Settings {
    /// Parameters by their value references.
    pub parameters: BTreeMap<u32, f64>,
    pub stops_at_contacts: bool,
    pub run_directory: String,
}

/// What an instance has done, from which its state follows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Past {
    settings: Settings,
    /// Inputs before the first step, by their value references.
    inputs: BTreeMap<u32, f64>,
    phase: Phase,
    /// Time of the importer at the start of the run, s.
    start: f64,
    done: Vec<Entry>,
    /// Inputs since the last step.
    pending: Vec<(u32, f64)>,
}

impl Past {
    /// Of one that was just instantiated.
    fn none() -> Self {
        Past {
            settings: Settings::default(),
            inputs: BTreeMap::new(),
            phase: Phase::Instantiated,
            start: 0.0,
            done: Vec::new(),
            pending: Vec::new(),
        }
    }
}

/// An instance.
pub struct Instance {
    resources: Resources,
    scenario: Scenario,
    variables: Vec<Variable>,
    past: Past,
    /// The machine, with the settings that it was built with.
    driven: Option<(Driven, Settings)>,
    /// The place of its run directory, from the end of the initialisation on.
    directory: Option<NewDirectory>,
}

/// An instance at an instant.
#[derive(Clone)]
pub struct State {
    pub(crate) past: Past,
    driven: DrivenState,
}

/// Share of a time by which the importer's may differ from ours: it adds its steps up.
const TIME_ROUNDING: f64 = 1e-9;

impl Instance {
    /// From the resources in a folder; `guid` is that of the description.
    pub fn new(folder: &Path, guid: &str) -> Result<Self, Fault> {
        let resources = package::resources(folder)?;
        if resources.guid != guid {
            return Err(format!(
                "the description has the guid {guid}, the resources have {}: they are not of one unit",
                resources.guid
            ));
        }
        let scenario = Scenario::read(&folder.join(package::SCENARIO), &[], &BuiltIn);
        let scenario = scenario.map_err(|problem| problem.to_string())?;
        let mut own = Instance {
            resources,
            scenario,
            variables: Vec::new(),
            past: Past::none(),
            driven: None,
            directory: None,
        };
        own.build()?;
        let driven = own.driven.as_ref().map(|(driven, _)| driven);
        let found = driven.map(|driven| variables::of(&own.scenario, driven));
        own.variables = found.unwrap_or_default();
        Ok(own)
    }

    /// The machine with the settings.
    fn build(&mut self) -> Result<&mut Driven, Fault> {
        let fits = (self.driven.as_ref()).is_some_and(|(_, with)| *with == self.past.settings);
        if !fits {
            let mut changes = Vec::new();
            for (reference, value) in &self.past.settings.parameters {
                let own = &self.variables[*reference as usize];
                let Role::Parameter(path) = &own.role else {
                    continue;
                };
                let text = match own.unit.is_empty() {
                    true => format!("{value:?}"),
                    false => format!("{value:?} {}", own.unit),
                };
                changes.push((path.clone(), text));
            }
            let way = Driving {
                commands: self.resources.commands,
                keep_history: !self.past.settings.run_directory.is_empty(),
                stops_at_contacts: self.past.settings.stops_at_contacts,
            };
            let changed = self.scenario.with(&changes);
            let changed = changed.map_err(|problem| problem.to_string())?;
            let driven = variables::driven(&changed, way);
            let mut driven = driven.map_err(|problem| problem.to_string())?;
            let outputs = |own: &&Variable| matches!(own.role, Role::Output(..));
            let known = self.variables.iter().filter(outputs).map(|own| &own.name);
            if !self.variables.is_empty() && !known.eq(driven.outputs().iter().map(|own| &own.name))
            {
                return Err(
                    "parameters that change which outputs there are: set them in the scenario and export the unit again"
                        .to_string(),
                );
            }
            for (reference, value) in &self.past.inputs {
                if let Role::Input(place) = self.variables[*reference as usize].role {
                    driven
                        .change(place, *value)
                        .map_err(|problem| problem.to_string())?;
                }
            }
            self.driven = Some((driven, self.past.settings.clone()));
        }
        match &mut self.driven {
            Some((driven, _)) => Ok(driven),
            None => Err("no machine".to_string()),
        }
    }

    fn variable(&self, reference: u32) -> Result<&Variable, Fault> {
        let found = self.variables.get(reference as usize);
        found.ok_or_else(|| {
            format!(
                "value reference {reference}: there are 0 to {}",
                self.variables.len() - 1
            )
        })
    }
    /// Its variables; a value reference is a place among them.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }
    /// The time that is reached, as the importer counts it, s.
    pub fn time(&self) -> f64 {
        let time = self
            .driven
            .as_ref()
            .map_or(0.0, |(driven, _)| driven.time());
        self.past.start + time
    }

    /// The value of a number.
    pub fn real(&mut self, reference: u32) -> Result<f64, Fault> {
        let own = self.variable(reference)?;
        if !matches!(own.kind, Kind::Real(_)) {
            return Err(format!("{}: is no number", own.name));
        }
        match own.role {
            Role::Time => Ok(self.time()),
            Role::Input(place) => Ok(self.build()?.input(place)),
            Role::Output(place, _) => Ok(self.build()?.read(place)),
            _ => {
                let start = match own.kind {
                    Kind::Real(start) => start.unwrap_or_default(),
                    _ => 0.0,
                };
                Ok(*self
                    .past
                    .settings
                    .parameters
                    .get(&reference)
                    .unwrap_or(&start))
            }
        }
    }

    /// Sets an input, or before the first step a parameter.
    pub fn set_real(&mut self, reference: u32, value: f64) -> Result<(), Fault> {
        let own = self.variable(reference)?;
        let (name, role) = (own.name.clone(), own.role.clone());
        if !matches!(own.kind, Kind::Real(_)) {
            return Err(format!("{name}: is no number"));
        }
        if !value.is_finite() {
            return Err(format!(
                "{name}: {value} was given; a finite number is needed"
            ));
        }
        match role {
            Role::Input(place) if self.past.phase == Phase::Stepping => {
                let driven = self.build()?;
                driven
                    .change(place, value)
                    .map_err(|problem| problem.to_string())?;
                self.past.pending.push((reference, value));
                Ok(())
            }
            Role::Input(place) => {
                self.past.inputs.insert(reference, value);
                let driven = self.build()?;
                driven
                    .change(place, value)
                    .map_err(|problem| problem.to_string())
            }
            Role::Parameter(_) => {
                self.may_choose(&name)?;
                self.past.settings.parameters.insert(reference, value);
                Ok(())
            }
            Role::Time | Role::Output(..) => Err(format!(
                "{name}: is an output of the unit and cannot be set"
            )),
            Role::Choice(_) => Err(format!("{name}: is no number")),
        }
    }

    fn may_choose(&self, name: &str) -> Result<(), Fault> {
        match self.past.phase {
            Phase::Instantiated | Phase::Initializing => Ok(()),
            _ => Err(format!(
                "{name}: is a parameter, fixed since the initialisation"
            )),
        }
    }
    fn choice(&self, reference: u32, wanted: Choice) -> Result<String, Fault> {
        let own = self.variable(reference)?;
        match own.role == Role::Choice(wanted) {
            true => Ok(own.name.clone()),
            false => Err(format!("{}: has another type", own.name)),
        }
    }
    /// The value of a switch.
    pub fn boolean(&self, reference: u32) -> Result<bool, Fault> {
        self.choice(reference, Choice::StopsAtContacts)?;
        Ok(self.past.settings.stops_at_contacts)
    }
    /// Sets a switch.
    pub fn set_boolean(&mut self, reference: u32, value: bool) -> Result<(), Fault> {
        let name = self.choice(reference, Choice::StopsAtContacts)?;
        self.may_choose(&name)?;
        self.past.settings.stops_at_contacts = value;
        Ok(())
    }
    /// The value of a text.
    pub fn text(&self, reference: u32) -> Result<&str, Fault> {
        self.choice(reference, Choice::RunDirectory)?;
        Ok(&self.past.settings.run_directory)
    }
    /// Sets a text.
    pub fn set_text(&mut self, reference: u32, value: &str) -> Result<(), Fault> {
        let name = self.choice(reference, Choice::RunDirectory)?;
        self.may_choose(&name)?;
        self.past.settings.run_directory = value.to_string();
        Ok(())
    }

    /// Begins the initialisation; the run starts at a time of the importer, s.
    pub fn initialize(&mut self, start: Option<f64>) -> Result<(), Fault> {
        self.in_turn(&[Phase::Instantiated])?;
        if let Some(start) = start {
            self.begin_at(start)?;
        }
        self.build()?;
        self.past.phase = Phase::Initializing;
        Ok(())
    }
    /// The run starts at a time of the importer, s.
    pub fn begin_at(&mut self, start: f64) -> Result<(), Fault> {
        if !start.is_finite() {
            return Err(format!(
                "start time: {start} was given; a finite number is needed"
            ));
        }
        self.past.start = start;
        Ok(())
    }
    /// Ends the initialisation.
    pub fn begin(&mut self) -> Result<(), Fault> {
        self.in_turn(&[Phase::Initializing])?;
        self.build()?;
        // one that cannot be written is no end of a run
        self.directory = self.reserved()?;
        self.past.phase = Phase::Stepping;
        Ok(())
    }
    /// The place of its run directory, where one is named.
    fn reserved(&self) -> Result<Option<NewDirectory>, Fault> {
        let folder = &self.past.settings.run_directory;
        let named = (!folder.is_empty()).then(|| NewDirectory::reserve(Path::new(folder)));
        named.transpose().map_err(|problem| problem.to_string())
    }
    fn in_turn(&self, turns: &[Phase]) -> Result<(), Fault> {
        match turns.contains(&self.past.phase) {
            true => Ok(()),
            false => Err(format!(
                "called in the phase {:?}; its turn is in {turns:?}",
                self.past.phase
            )),
        }
    }

    /// Goes on from a time by a step, s.
    pub fn step(&mut self, from: f64, length: f64) -> Result<Stepped, Fault> {
        self.in_turn(&[Phase::Stepping])?;
        let (reached, start) = (self.time(), self.past.start);
        if !(length > 0.0 && length.is_finite()) {
            return Err(format!(
                "a step of {length} s from {from} s: a step goes forwards, by a finite time"
            ));
        }
        let near = |a: f64, b: f64| (a - b).abs() <= TIME_ROUNDING * (b.abs() + length);
        if !near(from, reached) {
            let way = if from < reached {
                "backwards to"
            } else {
                "that leaps to"
            };
            return Err(format!(
                "a step {way} {from} s: {reached} s is reached; go back with a state that was saved"
            ));
        }
        let until = (from + length) - start;
        let entry = Entry {
            inputs: std::mem::take(&mut self.past.pending),
            until,
        };
        self.past.done.push(entry);
        let driven = self.build()?;
        let end = driven.end();
        let stepped = driven.advance(until, &AtomicBool::new(false));
        Ok(match stepped {
            Reached::Time => Stepped::There,
            Reached::Contact => Stepped::Contact,
            Reached::End(stop) if stop.complete() && near(until, end) => Stepped::There,
            Reached::End(stop) if stop.complete() => Stepped::Over(format!(
                "the run ends at run.duration, {} s; a longer one is a parameter",
                start + end
            )),
            Reached::End(stop) => Stepped::Over(stop.text),
        })
    }

    /// Ends the run; its directory is written where one was named.
    pub fn terminate(&mut self) -> Result<(), Fault> {
        let was = std::mem::replace(&mut self.past.phase, Phase::Terminated);
        let directory = match self.directory.take() {
            // a state of another instance was restored
            None if was == Phase::Stepping => self.reserved()?,
            own => own,
        };
        let (Phase::Stepping, Some(directory), Some((driven, _))) =
            (was, directory, &mut self.driven)
        else {
            return Ok(());
        };
        let scenario = driven.scenario().clone();
        let written = build(&scenario).and_then(|machine| {
            let outcome = machine.outcome(driven);
            directory.finish(&scenario, &outcome)
        });
        written.map_err(|problem| problem.to_string())
    }
    /// Back to where it was instantiated.
    pub fn reset(&mut self) -> Result<(), Fault> {
        self.past = Past::none();
        (self.driven, self.directory) = (None, None);
        self.build().map(|_| ())
    }

    /// What it stands at.
    pub fn save(&mut self) -> Result<State, Fault> {
        Ok(State {
            driven: self.build()?.save(),
            past: self.past.clone(),
        })
    }
    /// Back to what was saved.
    pub fn restore(&mut self, state: &State) -> Result<(), Fault> {
        self.past.clone_from(&state.past);
        self.build()?.restore(&state.driven);
        Ok(())
    }
    /// The guid of its description.
    pub fn guid(&self) -> &str {
        &self.resources.guid
    }
    /// Goes from its start through what another did, by the same steps: it has the same bits then.
    pub(crate) fn repeat(&mut self, other: Past) -> Result<(), Fault> {
        let known = |own: &(u32, f64)| (own.0 as usize) < self.variables.len();
        let all = other.done.iter().flat_map(|own| &own.inputs);
        if !all.chain(&other.pending).all(known) {
            return Err("bytes that are no state of this unit".to_string());
        }
        self.driven = None;
        self.past = Past {
            phase: Phase::Stepping,
            done: Vec::new(),
            pending: Vec::new(),
            ..other.clone()
        };
        self.build()?;
        for entry in &other.done {
            for (reference, value) in &entry.inputs {
                self.set_real(*reference, *value)?;
            }
            self.build()?.advance(entry.until, &AtomicBool::new(false));
        }
        for (reference, value) in &other.pending {
            self.set_real(*reference, *value)?;
        }
        self.past = other;
        Ok(())
    }
}
