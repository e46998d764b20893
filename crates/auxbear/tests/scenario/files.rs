//! Complete files that tests start from, and how they are read.

use auxbear::scenario::{BearingSource, BuiltIn, Scenario, SpinUp, System};

/// A drop with a bearing given by hand.
pub const DROP: &str = r#"format = "auxbear.scenario/1"
system = "drop"

[rotor]
mass = "8 kg"
polar_inertia = "0.01 kg m^2"
unbalance_eccentricity = "5 um"
speed = "12000 rpm"

[levitation]
stiffness = "1e6 N/m"
damping = "1000 N s/m"

[contact]
radial_air_clearance = "0.25 mm"
bore_diameter = "25 mm"

[mount]
stiffness = "2e7 N/m"
damping = "5000 N s/m"
moving_mass = "0.15 kg"

[bearing]
ball_count = 10
ball_diameter = "6.35 mm"
pitch_diameter = "36 mm"
inner_race_mass = "20.4 g"
inner_race_inertia = "3.9e-6 kg m^2"
cage_mass = "5 g"
"#;

/// A spin-up of a bearing of the catalogue by a sliding rotor.
pub const SPIN_UP: &str = r#"format = "auxbear.scenario/1"
system = "spin_up"

[drive]
kind = "sliding rotor"
radial_load = "80 N"
rotor_speed = "1000 rad/s"

[bearing]
name = "6005"
cage_mass = "8 g"
"#;

/// Overrides as the command hands them over.
pub fn owned(sets: &[&str]) -> Vec<String> {
    sets.iter().map(|set| set.to_string()).collect()
}

/// A scenario, or the message; `name` is that of the file.
pub fn read_from(
    bearings: &dyn BearingSource,
    name: &str,
    text: &str,
    sets: &[&str],
) -> Result<Scenario, String> {
    Scenario::parse(text, name, &owned(sets), bearings).map_err(|problem| problem.to_string())
}

/// The same with the catalogue, from a file `a.toml`.
pub fn read(text: &str, sets: &[&str]) -> Result<Scenario, String> {
    read_from(&BuiltIn, "a.toml", text, sets)
}

/// The scenario of a file that is right.
pub fn must_read(bearings: &dyn BearingSource, text: &str, sets: &[String]) -> Scenario {
    Scenario::parse(text, "test.toml", sets, bearings)
        .unwrap_or_else(|problem| panic!("{problem}\n{sets:?}\n{text}"))
}

/// The spin-up of a scenario.
pub fn spin_up(scenario: Scenario) -> SpinUp {
    match scenario.system {
        System::SpinUp(spin_up) => spin_up,
        other => panic!("{other:?}"),
    }
}
