//! A file of each system in which a key has a meaning.

use auxbear::scenario::SystemName;

const DROP: &str = r#"
[rotor]
mass = "8 kg"
polar_inertia = "0.01 kg m^2"
speed = "-12000 rpm"

[levitation]
stiffness = "1e6 N/m"
damping = "1000 N s/m"

[contact]
radial_air_clearance = "0.25 mm"

[mount]
stiffness = "2e7 N/m"
damping = "5000 N s/m"
moving_mass = "150 g"
"#;

const MACHINE: &str = r#"
[rotor]
speed = "-12000 rpm"

[contact]
radial_air_clearance = "0.25 mm"
node = "drive_end"

[mount]
stiffness = "2e7 N/m"
damping = "5000 N s/m"
moving_mass = "150 g"

[[rotor.section]]
length = "0.8 m"
outer_diameter = "40 mm"
material = "steel"

[[rotor.node]]
name = "drive_end"
at = "0.2 m"

[[rotor.support]]
at = "0.1 m"
stiffness = "1 MN/m"

[[rotor.support]]
at = "0.7 m"
stiffness = "1 MN/m"
after_release = "stays"

[[rotor.housing]]
name = "casing"
mass = "200 kg"
stiffness = "1e9 N/m"

[[rotor.seal]]
at = "0.4 m"
on = "casing"
stiffness = "1 N/m"
"#;

const BEARING: &str = r#"
[bearing]
name = "6005"
cage_mass = "6 g"
"#;

/// A file of the system in which the key has a meaning.
pub fn base(system: SystemName, path: &str) -> String {
    let own = match system {
        SystemName::Drop => DROP.to_string(),
        SystemName::SpinUp => drive(path),
        SystemName::Torque => String::new(),
        SystemName::Signals => return measurement(path),
        SystemName::Rig => rig(path),
        SystemName::Rotor => return format!("{}{}", rotor(), unbalanced(path)),
        SystemName::Machine => format!("{MACHINE}{}", unbalanced(path)),
        SystemName::CoastDown => coast_down(path),
        SystemName::Identify => {
            "[identify]\ncoast_down = [\"a.toml\"]\nradial_load = \"60 N\"\n".to_string()
        }
    };
    let bearing = if path.starts_with("bearing.full_complement.") || path == "bearing.separation" {
        BEARING.replace("cage_mass = \"6 g\"\n", "")
    } else {
        BEARING.to_string()
    };
    format!(
        "format = \"auxbear.scenario/1\"\nsystem = \"{}\"\n{own}{bearing}",
        system.word()
    )
}

/// A coast-down in which the key has a meaning; what is about the moment stands there already.
fn coast_down(path: &str) -> String {
    // a speed that is tried is a small one, and a vacuum needs a way out for the heat
    let beside = match path {
        "rotor.speed" => "[coast_down]\nstop_speed = \"1e-9 rad/s\"\n",
        "heat.atmosphere" => "[heat]\nsurroundings = \"1 W/K\"\n",
        _ => "",
    };
    let points = match path {
        "bearing.moment.viscosity_points" => "",
        _ => {
            "[bearing.moment]\nviscosity_points = [[\"40 degC\", \"100 mm^2/s\"], [\"100 degC\", \"11 mm^2/s\"]]\n"
        }
    };
    format!(
        "[rotor]\nmass = \"8 kg\"\npolar_inertia = \"0.01 kg m^2\"\nspeed = \"-12000 rpm\"\n{beside}{points}"
    )
}

/// What a grade scales.
fn unbalanced(path: &str) -> &'static str {
    match path {
        "rotor.balance_planes" => "[[rotor.node]]\nname = \"other_end\"\nat = \"0.6 m\"\n",
        "rotor.balance_grade" => "[[rotor.unbalance]]\nat = \"0.4 m\"\namount = \"40 g mm\"\n",
        _ => "",
    }
}

/// A flexible rotor.
fn rotor() -> String {
    "format = \"auxbear.scenario/1\"\nsystem = \"rotor\"\n\
     [rotor]\nspeed = \"9000 rpm\"\n\
     [[rotor.section]]\nlength = \"0.8 m\"\nouter_diameter = \"40 mm\"\nmaterial = \"steel\"\n\
     [[rotor.node]]\nname = \"drive_end\"\nat = \"0.2 m\"\n"
        .to_string()
}

/// A measurement in which the key has a meaning.
fn measurement(path: &str) -> String {
    let sensor = match path.rsplit_once('.').map_or(path, |(_, name)| name) {
        "tap_file" | "tap_channel" | "tap_start" => "tap_file = \"tap.tdms\"",
        _ => "sensor_frequency = \"30 Hz\"\ndamping_ratio = 0.2",
    };
    let speed = match path {
        "signals.speed.scale"
        | "signals.speed.bandwidth"
        | "signals.speed.delay"
        | "signals.speed.resolution"
        | "signals.speed.noise" => "kind = \"speed\"",
        _ => "marks_per_revolution = 60",
    };
    format!(
        "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"a.tdms\"\n\
         [signals.speed]\nchannel = \"tacho\"\n{speed}\n\
         [signals.torque]\nchannel = \"torque\"\n{sensor}\n\
         [signals.cage]\nchannel = \"balls\"\nball_count = 10\nrolling_ratio = 0.4\n"
    )
}

/// A test on a rig that has the key.
fn rig(path: &str) -> String {
    let own = match path {
        "rig.acceleration" => "program = \"ramp and hold\"\nacceleration = \"50 rad/s^2\"\n",
        "rig.coasts" => "program = \"coast-down\"\n",
        "rig.first_release_at" | "rig.engage_again_at" => {
            "program = \"repeat after rest\"\npeak_acceleration = \"7200 rad/s^2\"\nengage_at = \"1 us\"\n\
             first_release_at = \"2 us\"\nengage_again_at = \"3 s\"\n"
        }
        "rig.clutch.torque_rate" => "program = \"spin-up\"\nengage_at = \"1 us\"\n",
        _ => "program = \"spin-up\"\npeak_acceleration = \"7200 rad/s^2\"\nengage_at = \"1 us\"\n",
    };
    format!("[rig]\nspeed = \"150 rad/s\"\n{own}[rig.load]\nradial_load = \"60 N\"\n")
}

/// A drive of the kind that has the key.
fn drive(path: &str) -> String {
    let unless = |other: &str, line: &'static str| if path == other { "" } else { line };
    let own = match path {
        "drive.torque" | "drive.torque_history" | "drive.reference_speed" => [
            "kind = \"torque\"\nreference_speed = \"100 rad/s\"\n",
            unless("drive.torque_history", "torque = \"1 N m\"\n"),
        ],
        "drive.final_speed" | "drive.acceleration" | "drive.speed_history" => [
            "kind = \"speed\"\n",
            unless("drive.speed_history", "final_speed = \"100 rad/s\"\n"),
        ],
        _ => [
            "kind = \"sliding rotor\"\n",
            "rotor_speed = \"1000 rad/s\"\n",
        ],
    };
    let load = unless("drive.load_history", "radial_load = \"80 N\"\n");
    format!("[drive]\n{load}{}", own.concat())
}

/// A spectrum of a base.
const SPECTRUM: &str = "base.spectrum=[[\"1 Hz\", \"2 m/s^2\"], [\"30 Hz\", \"2 m/s^2\"]]";

/// What stands together in a mount, and in the motion of a base.
pub const MOUNT: [(&str, &[&str]); 14] = [
    (
        "base.shock_",
        &["base.shock_x=50 m/s^2", "base.shock_duration=11 ms"],
    ),
    ("base.spectrum", &[SPECTRUM]),
    ("base.scale", &[SPECTRUM]),
    ("base.case", &[SPECTRUM]),
    ("run.case", &[SPECTRUM, "base.case=axis lost"]),
    ("base.start", &[SPECTRUM]),
    ("base.file", &["base.channel_x=east"]),
    (
        "base.channel_",
        &["base.file=quake.csv", "base.channel_x=east"],
    ),
    (
        "mount.branch_",
        &[
            "mount.branch_stiffness=[\"1e6 N/m\", \"2e6 N/m\"]",
            "mount.branch_time=[\"2 ms\", \"1 ms\"]",
        ],
    ),
    (
        "mount.ring_",
        &["mount.ring_stiffness=1e6 N/m", "mount.ring_travel=20 um"],
    ),
    (
        "mount.film_",
        &[
            "mount.film_viscosity=0.1 Pa s",
            "mount.film_radius=20 mm",
            "mount.film_length=11 mm",
            "mount.film_clearance=0.3 mm",
            "mount.stop_gap=1 um",
            "mount.stop_stiffness=1e9 N/m",
        ],
    ),
    (
        "contact.friction_over_temperature",
        &["contact.width=12 mm"],
    ),
    (
        "mount.stop_",
        &["mount.stop_gap=1 um", "mount.stop_stiffness=1e9 N/m"],
    ),
    (
        "mount.housing_",
        &["mount.housing_mass=3 kg", "mount.housing_stiffness=1e7 N/m"],
    ),
];
