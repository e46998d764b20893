//! The variables of a unit: one table for its description and for its values. A value reference is the place in the table.

use auxbear::outcome::Column;
use auxbear::run::{Commands, Driven, Driving};
use auxbear::scenario::ResolvedValue;
use auxbear::{Problem, Scenario, build};

/// The type of a variable.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A number, with its value at the start where it has one.
    Real(Option<f64>),
    /// A switch, with its value at the start.
    Boolean(bool),
    /// A text, empty at the start.
    Text,
}

/// What a variable is to the unit.
#[derive(Clone, Debug, PartialEq)]
pub enum Role {
    /// Time, s.
    Time,
    /// An input, by its place among them.
    Input(usize),
    /// An output, by its place among them; it shows these inputs at once, by their places.
    Output(usize, Vec<usize>),
    /// A value of the scenario with its SI unit, by its path, fixed from the initialisation on.
    Parameter(String),
    /// What the unit itself does.
    Choice(Choice),
}

/// What a user decides of a unit besides its scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Whether a step ends early where a contact begins or ends.
    StopsAtContacts,
    /// Where the run directory is written when it terminates.
    RunDirectory,
}

/// A variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its type.
    pub kind: Kind,
    /// What it is.
    pub role: Role,
    /// SI unit; empty for what has none.
    pub unit: String,
    /// What it means.
    pub meaning: String,
}

/// Whether a value of the scenario is a parameter: a number that does not follow from others, that acts in this machine, and whose change
/// leaves all names as they are.
fn parameters(scenario: &Scenario) -> impl Iterator<Item = Variable> {
    let acts = |own: &&ResolvedValue| match own.path.split('.').next() {
        // a unit is one member
        Some("repeat") => false,
        // each kind of motion has keys of its own
        Some("base") => own.provenance.mark() != "default",
        _ => own.provenance.mark() != "derived",
    };
    let values = scenario.resolved.values.iter().filter(acts);
    let numbers = values.filter(|own| own.text.is_some() && !own.is_of_kind());
    numbers.filter_map(|own| {
        Some(Variable {
            kind: Kind::Real(Some(own.value_si?)),
            role: Role::Parameter(own.shown()),
            // columns have names like those of keys
            name: format!("scenario.{}", own.shown()),
            unit: unit(&own.unit),
            meaning: "value of the scenario".to_string(),
        })
    })
}

/// A unit as a description has it: a ratio has none.
fn unit(of: &str) -> String {
    match of {
        "1" => String::new(),
        other => other.to_string(),
    }
}

/// The variables of a machine.
pub fn of(scenario: &Scenario, driven: &Driven) -> Vec<Variable> {
    let variable = |name: &str, kind, role, of: &str, meaning: &str| Variable {
        name: name.to_string(),
        kind,
        role,
        unit: unit(of),
        meaning: meaning.to_string(),
    };
    let time = variable("time", Kind::Real(None), Role::Time, "s", "time");
    let mut list = vec![time];
    for (place, own) in driven.inputs().enumerate() {
        let (kind, role) = (Kind::Real(Some(own.start)), Role::Input(place));
        list.push(variable(&own.name, kind, role, own.unit, &own.meaning));
    }
    for (place, own) in driven.outputs().iter().enumerate() {
        let Column { name, meaning, .. } = own;
        let role = Role::Output(place, driven.feeds(own));
        list.push(variable(name, Kind::Real(None), role, own.unit, meaning));
    }
    list.push(variable(
        "stop_at_contacts",
        Kind::Boolean(false),
        Role::Choice(Choice::StopsAtContacts),
        "",
        "whether a step ends early, behind the one in which a contact of rotor and race begins or ends",
    ));
    list.push(variable(
        "run_directory",
        Kind::Text,
        Role::Choice(Choice::RunDirectory),
        "",
        "where the run directory is written when the unit terminates; empty for none",
    ));
    list.extend(parameters(scenario));
    list
}

/// A machine that is driven by commands of a kind, at its start.
///
/// # Errors
/// What is wrong with the scenario, or why it cannot be driven so.
pub fn driven(scenario: &Scenario, way: Driving) -> Result<Driven, Box<Problem>> {
    build(scenario)?.driven(way)
}

/// Words for what the commands of a unit are.
pub const COMMANDS: [(&str, Commands); 3] = [
    ("current", Commands::Current),
    ("voltage", Commands::Voltage),
    ("force", Commands::Force),
];
