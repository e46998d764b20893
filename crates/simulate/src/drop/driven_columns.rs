//! What goes into a machine that is driven from outside, and what comes out of it besides the columns of its history.

use crate::bearing::columns::Table;
use crate::drop::context::{Context, Setup};
use crate::drop::magnets::value_of;
use crate::drop::{Shaft, events};
use levitation::{Amplifier, Commands};
use model::magnets::AxisConstants;
use model::system::machine::RotorMachine;
use outcome::Column;
use outcome::columns::columns;

/// An input.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name: `magnet.drive_end.command_1`.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// What it is, in words.
    pub meaning: String,
    /// Its value at the start.
    pub start: f64,
}

/// The command of an axis of a magnet.
pub(super) fn command(
    setup: Setup,
    (axis, own): (usize, &AxisConstants),
    commands: Commands,
    start: f64,
) -> Variable {
    let (word, unit, meaning) = match commands {
        Commands::Current => (
            "current_command",
            "A",
            "control current commanded to the amplifier of the magnet's axis",
        ),
        Commands::Voltage => (
            "voltage_command",
            "V",
            "voltage across the coils of the magnet's axis",
        ),
        Commands::Force => (
            "force_command",
            "N",
            "force on the rotor in place of the magnet's axis",
        ),
    };
    let angle = own.direction.y.atan2(own.direction.x).to_degrees();
    let given = setup.drop().shaft.as_deref();
    Variable {
        name: given.map_or_else(String::new, |given| value_of(given, axis, word)),
        unit,
        meaning: format!("{meaning} at {angle:.0} degrees from x"),
        start,
    }
}

pub(super) fn torque() -> Variable {
    Variable {
        name: "rotor.drive_torque_added".to_string(),
        unit: "N m",
        meaning: "torque on the rotor besides those of the file, counter-clockwise".to_string(),
        start: 0.0,
    }
}

/// A force at the place of a `[[rotor.force]]`, or on a rotor that does not bend.
pub(super) fn force(setup: Setup, place: usize, along: usize) -> Variable {
    let axis = ["x", "y"][along];
    let given = setup.drop().shaft.as_deref();
    let of = given.and_then(|own| own.model.forces.get(place));
    let (name, at) = match of {
        Some(own) => (
            format!("{}.{axis}_added", own.path),
            "at its place, besides its own",
        ),
        None => (format!("rotor.force.{axis}_added"), "on the rotor"),
    };
    Variable {
        name,
        unit: "N",
        meaning: format!("force along {axis} {at}"),
        start: 0.0,
    }
}

pub(super) fn base(along: usize) -> Variable {
    let axis = ["x", "y"][along];
    Variable {
        name: format!("base.acceleration_{axis}_added"),
        unit: "m/s^2",
        meaning: format!("acceleration of the base along {axis} besides those of the file"),
        start: 0.0,
    }
}

/// Inputs that an output shows at once: control currents that are their commands, and forces in their place.
pub(super) fn feeds<'a>(
    setup: Setup,
    output: &Column,
    inputs: impl Iterator<Item = &'a Variable>,
) -> Vec<usize> {
    let Some(given) = setup.drop().shaft.as_deref() else {
        return Vec::new();
    };
    let control = setup.machine.constants.magnets.as_ref();
    let Some(control) = control.and_then(|own| own.control()) else {
        return Vec::new();
    };
    let axes = control.levitation.actuators().iter().enumerate();
    let direct = axes.filter(|(_, own)| own.amplifier == Amplifier::Direct);
    let mut direct = direct.map(|(axis, _)| axis);
    let Some(axis) = direct.find(|axis| output.name == value_of(given, *axis, "current")) else {
        return Vec::new();
    };
    let own = value_of(given, axis, "");
    let (magnet, number) = own.rsplit_once('.').unwrap_or_default();
    let of = |name: &str| name.starts_with(magnet) && name.ends_with(number);
    let places = inputs.enumerate().filter(|(_, input)| of(&input.name));
    places.map(|(place, _)| place).collect()
}

/// What a state alone shows, at no cost of a whole row: what controllers read at every sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Quick {
    /// A channel of the state.
    Channel(usize),
    /// Displacement at an axis of a sensor.
    Displacement(usize),
    /// Signal of an axis of a sensor.
    Signal(usize),
    /// Whether any magnet has power.
    Powered,
}

impl Quick {
    pub fn read(self, machine: &RotorMachine, time: f64, state: &[f64]) -> f64 {
        match self {
            Quick::Channel(channel) => state[channel],
            Quick::Displacement(axis) => machine.sensed(time, state)[axis].0,
            Quick::Signal(axis) => machine.sensed(time, state)[axis].1,
            Quick::Powered => f64::from(u8::from(machine.powered(state)[0])),
        }
    }
}

/// Which of the outputs a state alone shows.
pub(super) fn quick(setup: Setup, outputs: &[Column]) -> Vec<Option<Quick>> {
    let machine = setup.machine;
    let mut known = vec![(
        SPEED.to_string(),
        Quick::Channel(machine.layout().rotor.spin()),
    )];
    if let Some(given) = setup.controlled() {
        known.push((POWERED.to_string(), Quick::Powered));
        for axis in 0..machine.axes().count() {
            known.push((sensor(given, axis, SHOWN), Quick::Displacement(axis)));
            known.push((sensor(given, axis, SIGNAL), Quick::Signal(axis)));
        }
    }
    let of = |own: &Column| {
        let found = known.iter().find(|(name, _)| *name == own.name);
        found.map(|(_, quick)| *quick)
    };
    outputs.iter().map(of).collect()
}

const SPEED: &str = "rotor.speed";
const POWERED: &str = "magnets.powered";
const SHOWN: &str = "displacement";
const SIGNAL: &str = "signal";

/// Columns of an instant besides those of the history: sensors, power, contacts, events.
pub(super) fn columns(setup: Setup, run: Option<&Context>) -> Vec<Column> {
    let machine = setup.machine;
    let of = run.map_or_else(|| setup.bearing(0), |run| run.bearing(0));
    let mut table = Table::over(&of);
    if let Some(given) = setup.controlled() {
        for axis in 0..machine.axes().count() {
            let [shown, signal] = [SHOWN, SIGNAL].map(|what| sensor(given, axis, what));
            columns! { table.columns, |row|
                "{shown}": "m", "displacement of the rotor that this axis of the sensor sees, before its filter" => machine.sensed(row.time, row.state)[axis].0;
                "{signal}": "m", "signal of this axis of the sensor, behind its filter" => machine.sensed(row.time, row.state)[axis].1;
            }
        }
        columns! { table.columns, |row|
            "{POWERED}": "1", "1 while any magnet has power, else 0" => f64::from(u8::from(machine.powered(row.state)[0]));
        }
    }
    for (k, part) in setup.parts().enumerate() {
        let of_part = |name: &str| model::system::layout::of_part(part, name);
        let [count, touching] = ["contact_count", "touching"].map(of_part);
        let contacts = run.map(|run| &run.record(k).contacts);
        let last = contacts.and_then(|list| list.last());
        columns! { table.columns, |_row|
            "{count}": "1", "contacts of rotor and race that have begun" => contacts.map_or(0.0, |list| list.len() as f64);
            "{touching}": "1", "1 while rotor and race touch, else 0" => f64::from(u8::from(last.is_some_and(|own| own.end.is_none())));
        }
    }
    let given = setup.drop().shaft.iter().flat_map(|own| &own.events);
    for event in given.filter(|event| !event.name.is_empty()) {
        let name = format!("event.{}.happened", event.name);
        let happened = |now: f64| {
            let time = run.and_then(|run| events::time_of(event.when, run));
            time.is_some_and(|time| time <= now)
        };
        columns! { table.columns, |row|
            "{name}": "1", "1 from this event on, else 0" => f64::from(u8::from(happened(row.time)));
        }
    }
    table.columns.list
}

/// Name of a value of an axis of a sensor, which serves that axis of a magnet.
fn sensor(given: &Shaft, axis: usize, what: &str) -> String {
    let of_magnet = value_of(given, axis, what);
    format!("sensor{}", of_magnet.trim_start_matches("magnet"))
}
