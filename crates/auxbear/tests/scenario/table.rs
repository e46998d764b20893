//! The table of keys: documented, right in itself, and each number of it reaches the typed scenario.

use super::bases::{MOUNT, base};
use super::files::must_read;
use auxbear::scenario::{
    BuiltIn, Kind, Presence, Range, Scenario, SystemName, keys, keys_of, parts_of, sections,
    sections_of, systems,
};

fn read(text: &str, sets: &[String]) -> Scenario {
    must_read(&BuiltIn, text, sets)
}

#[test]
fn every_key_is_documented_and_belongs_to_a_section() {
    let mut paths = Vec::new();
    for key in keys() {
        assert!(key.doc.ends_with('.') && key.doc.len() > 10, "{}", key.path);
        assert!(!key.example.is_empty(), "{}", key.path);
        assert!(!paths.contains(&key.path), "{} twice", key.path);
        paths.push(key.path);
        let section = key.section();
        let known = sections().find(|known| known.path == section);
        assert!(section.is_empty() || known.is_some(), "{}", key.path);
        if let Some(known) = known {
            let inside = systems(key).iter().all(|s| known.systems.contains(s));
            assert!(inside, "{} in a system without [{section}]", key.path);
        }
        let units = match key.kind {
            Kind::Quantity(unit) => vec![unit],
            Kind::Table(first, second) => vec![first, second],
            _ => Vec::new(),
        };
        for unit in units {
            let unit = units::Unit::parse(unit).unwrap();
            assert_eq!(unit.to_si(1.0), 1.0, "{}", key.path);
            assert!(
                unit.dimension().name().is_some() || key.path.contains("per_acceleration"),
                "{}",
                key.path
            );
        }
        let reason = match key.presence {
            Presence::Required | Presence::FromBearing => "needs none",
            Presence::Optional(text) | Presence::Derived(text) => text,
            Presence::Default(fallback) | Presence::DefaultWhen(_, fallback, _) => fallback.reason,
        };
        assert!(reason.len() > 8, "{}: {reason}", key.path);
        for condition in key.when.iter() {
            assert!(
                paths.contains(&condition.path),
                "{} stands before {}",
                key.path,
                condition.path
            );
        }
    }
    for section in sections() {
        assert!(section.doc.ends_with('.'), "{}", section.path);
        for system in section.systems {
            let parts =
                || parts_of(SystemName::Machine).any(|(path, _)| path.starts_with(section.path));
            assert!(keys_of(*system).any(|key| key.section() == section.path) || parts());
        }
    }
    for system in SystemName::ALL {
        assert!(sections_of(*system).count() > 0);
    }
}

/// What must be chosen for the key to have a meaning.
fn choices(path: &str) -> Vec<String> {
    let list: &[&str] = match path {
        "bearing.arrangement"
        | "bearing.thrust_side"
        | "bearing.contact_nodes"
        | "bearing.shoulder_height"
        | "contact.gap_to_end"
        | "contact.gap_to_start"
        | "contact.face_radius"
        | "contact.face_width"
        | "contact.face_stiffness"
        | "mount.axial_stiffness"
        | "mount.axial_damping" => &["bearing.fidelity=spatial"],
        "mount.tilt_stiffness" => &["bearing.fidelity=spatial", "bearing.cage.guidance=balls"],
        "mount.tilt_damping" | "mount.torsion_stiffness" | "mount.tilt_inertia" => &[
            "bearing.fidelity=spatial",
            "bearing.cage.guidance=balls",
            "mount.tilt_stiffness=1 N m/rad",
        ],
        _ if path.starts_with("bearing.preload_spring_") => &[
            "bearing.fidelity=spatial",
            "bearing.type=angular contact",
            "bearing.contact_angle=15 deg",
            "bearing.arrangement=DB",
            "bearing.row_spacing=12 mm",
            "bearing.axial_preload=100 N",
            "bearing.preload_spring_stiffness=1e6 N/m",
        ],
        "bearing.row_spacing" => &[
            "bearing.fidelity=spatial",
            "bearing.type=angular contact",
            "bearing.contact_angle=15 deg",
            "bearing.arrangement=DT",
        ],
        _ if path.contains(".axial") && !path.starts_with("bearing.") => &[
            "bearing.fidelity=spatial",
            "levitation.axial_stiffness=1 MN/m",
            "contact.gap_to_end=0.2 mm",
            "contact.gap_to_start=0.2 mm",
            "gravity.acceleration=0 m/s^2",
        ],
        "rotor.brake_torque" => &["rotor.spin=braked"],
        "rotor.brake_start" => &["rotor.spin=braked", "rotor.brake_torque=1 N m"],
        "rotor.torque_over_speed" => &["rotor.speed=1 rad/s"], // its rows reach beyond
        "rotor.torque_share_over_time" => {
            &["rotor.torque_over_speed=[[\"0 rpm\", \"0 N m\"], [\"1e5 rpm\", \"-1 N m\"]]"]
        }
        "drive.rotor_polar_inertia" => &["drive.rotor_spin=free"],
        "analysis.operating_to" => &["analysis.operating_from=1e-6 rad/s"],
        "analysis.map_to" => &["analysis.map_from=1e-6 N/m"],
        // it would be the largest speed of the torque as well
        "bearing.limiting_speed" => &["torque.speed_to=200 rad/s"],
        "torque.temperatures" => &[
            "bearing.moment.temperature=60 degC",
            "bearing.moment.viscosity_points=[[\"40 degC\", \"100 mm^2/s\"], [\"100 degC\", \"11 mm^2/s\"]]",
        ],
        "torque.lubricants" => &["bearing.moment.temperature=60 degC"],
        "bearing.traction.a" | "bearing.traction.b" | "bearing.traction.c"
        | "bearing.traction.d" => &[
            "bearing.traction.law=four parameter",
            "bearing.traction.a=-0.07",
            "bearing.traction.b=0.35 s/m",
            "bearing.traction.c=5 s/m",
            "bearing.traction.d=0.07",
        ],
        "bearing.traction.kinetic" | "bearing.traction.static" | "bearing.traction.decay_speed" => {
            &[
                "bearing.traction.law=dry",
                "bearing.traction.kinetic=0.1",
                "bearing.traction.static=0.15",
                "bearing.traction.decay_speed=0.5 m/s",
            ]
        }
        "bearing.traction.oil"
        | "bearing.traction.oil_temperature"
        | "bearing.traction.oil_conductivity"
        | "bearing.traction.composite_roughness"
        | "bearing.traction.boundary_friction_coefficient"
        | "bearing.traction.boundary_reference_speed"
        | "bearing.traction.supply" => &[
            "bearing.traction.law=lubricant",
            "bearing.traction.oil=FVA 3",
            "bearing.traction.oil_temperature=60 degC",
        ],
        "bearing.contact_angle" => &["bearing.type=angular contact"],
        "bearing.axial_preload" => &[
            "bearing.type=angular contact",
            "bearing.contact_angle=15 deg",
        ],
        "heat.atmosphere" => &["heat.surroundings=0.8 W/K"],
        "heat.gas_pressure" | "heat.emissivity" | "heat.housing_emissivity" => {
            &["heat.rotor_surroundings=0 W/K"]
        }
        "contact.surface.wear_coefficient" | "heat.rotor_bodies" => &["contact.width=12 mm"],
        "heat.mount_contact" | "heat.mount_surroundings" => &["heat.mount_capacity=30 J/K"],
        "bearing.inner_race_growth" => &["bearing.fits.bore_diameter=25 mm"],
        "bearing.unmounted_diametral_clearance" => &["bearing.fits.shaft_interference=5 um"],
        _ if path.starts_with("bearing.fits.housing_") || path == "bearing.fits.outer_diameter" => {
            &[
                "bearing.unmounted_diametral_clearance=12 um",
                "bearing.fits.housing_outer_diameter=80 mm",
            ]
        }
        _ if path.starts_with("bearing.fits.") => &["bearing.unmounted_diametral_clearance=12 um"],
        _ if path.starts_with("bearing.cage.land_") => &[
            "bearing.cage.guidance=outer land",
            "bearing.cage.land_radial_clearance=0.1 mm",
        ],
        _ if path.starts_with("bearing.full_complement.") => {
            &["bearing.separation=full complement"]
        }
        "bearing.moment.curve" => &["bearing.moment.law=measured"],
        "bearing.moment.viscosity_points" => &[
            "bearing.moment.law=skf",
            "bearing.moment.lubrication=grease",
            "bearing.moment.temperature=60 degC",
        ],
        "bearing.moment.temperature" => &[
            "bearing.moment.law=skf",
            "bearing.moment.lubrication=grease",
            "bearing.moment.viscosity_points=[[\"40 degC\", \"100 mm^2/s\"], [\"100 degC\", \"11 mm^2/s\"]]",
        ],
        "bearing.moment.contact_angle"
        | "bearing.moment.equivalent_load"
        | "bearing.moment.f0"
        | "bearing.moment.f1_factor"
        | "bearing.moment.f1_exponent"
        | "bearing.moment.orbit_share"
        | "bearing.moment.reference_spin"
        | "bearing.moment.scale" => &[
            "bearing.moment.law=palmgren",
            "bearing.moment.f0=2",
            "bearing.moment.viscosity=100 mm^2/s",
            "bearing.moment.f1_factor=9e-4",
            "bearing.moment.f1_exponent=0.55",
        ],
        "bearing.moment.law" => &[],
        "bearing.moment.drag_variable" => &[
            "bearing.moment.law=skf",
            "bearing.moment.lubrication=oil bath",
            "bearing.moment.viscosity=100 mm^2/s",
        ],
        _ if path.starts_with("bearing.moment.") => &[
            "bearing.moment.law=skf",
            "bearing.moment.lubrication=grease",
            "bearing.moment.viscosity=100 mm^2/s",
        ],
        "bearing.lubricant_state.kind" => &[],
        "bearing.lubricant_state.rest_before" => &[
            "bearing.moment.law=measured",
            "bearing.moment.curve=[[\"1 rad/s\", \"1 N mm\"], [\"2 rad/s\", \"1 N mm\"]]",
            "bearing.lubricant_state.kind=grease",
            "bearing.lubricant_state.rested_factor=0.3",
            "bearing.lubricant_state.build_up_turns=0.7",
            "bearing.lubricant_state.worked_factor=0.7",
            "bearing.lubricant_state.breakdown_time=3.5 s",
            "bearing.lubricant_state.recovery_time=600 s",
            "bearing.lubricant_state.start=after rest",
        ],
        _ if path.starts_with("bearing.lubricant_state.initial_") => &[
            "bearing.moment.law=measured",
            "bearing.moment.curve=[[\"1 rad/s\", \"1 N mm\"], [\"2 rad/s\", \"1 N mm\"]]",
            "bearing.lubricant_state.kind=grease",
            "bearing.lubricant_state.rested_factor=0.3",
            "bearing.lubricant_state.build_up_turns=0.7",
            "bearing.lubricant_state.worked_factor=0.7",
            "bearing.lubricant_state.breakdown_time=3.5 s",
            "bearing.lubricant_state.recovery_time=600 s",
            "bearing.lubricant_state.start=given",
            "bearing.lubricant_state.initial_build_up=0.4",
            "bearing.lubricant_state.initial_breakdown=0.3",
        ],
        _ if path.starts_with("bearing.lubricant_state.") => &[
            "bearing.moment.law=measured",
            "bearing.moment.curve=[[\"1 rad/s\", \"1 N mm\"], [\"2 rad/s\", \"1 N mm\"]]",
            "bearing.lubricant_state.kind=grease and films",
            "bearing.lubricant_state.rested_factor=0.3",
            "bearing.lubricant_state.build_up_turns=0.7",
            "bearing.lubricant_state.worked_factor=0.7",
            "bearing.lubricant_state.breakdown_time=3.5 s",
            "bearing.lubricant_state.recovery_time=600 s",
            "bearing.lubricant_state.film_heat_capacity=0.5 J/K",
            "bearing.lubricant_state.film_conductance=0.25 W/K",
            "bearing.lubricant_state.drag_temperature_coefficient=0.03 1/K",
        ],
        "rig.load.mass" => &["rig.load.housing=hanging", "rig.load.mass=6 kg"],
        "rig.pickup.stamp_deviation" => &["rig.pickup.kind=edges"],
        _ if path.starts_with("identify.rotor_friction.") => &[
            "identify.rotor_friction.file=a.toml",
            "identify.rotor_friction.rotor_speed=1000 rad/s",
            "identify.rotor_friction.radial_load=80 N",
            "identify.rotor_friction.bore_diameter=25 mm",
            "identify.rotor_friction.inertia=4e-6 kg m^2",
        ],
        "signals.speed.stamp_deviation" => &["signals.speed.kind=edges"],
        "signals.speed.change_from" => &["signals.speed.change_to=6 s"],
        "signals.speed.change_to" => &["signals.speed.change_from=0 s"],
        _ if path.starts_with("signals.converter.") => &[
            "signals.converter.channels=[\"torque\"]",
            "signals.converter.highest=10",
            "signals.converter.bits=14",
        ],
        _ if path.starts_with("signals.vibration.") => &["signals.vibration.channel=arm"],
        "signals.steady.up_from" => &[
            "signals.steady.from=0 s",
            "signals.steady.to=100 s",
            "signals.steady.up_to=100 s",
        ],
        "signals.steady.up_to" => &[
            "signals.steady.from=0 s",
            "signals.steady.to=100 s",
            "signals.steady.up_from=0 s",
        ],
        "signals.steady.inertia" | "signals.steady.inertia_deviation" => &[
            "signals.steady.from=0 s",
            "signals.steady.to=100 s",
            "signals.steady.inertia=1 kg m^2",
        ],
        _ if path.starts_with("signals.steady.string_") => &[
            "signals.steady.from=0 s",
            "signals.steady.to=100 s",
            "signals.steady.inertia_from=bifilar",
            "signals.steady.test_mass=0.4 kg",
            "signals.steady.test_period=0.6 s",
            "signals.steady.string_distance=50 mm",
            "signals.steady.string_length=1 m",
        ],
        _ if path.starts_with("signals.steady.test_torque")
            || path.starts_with("signals.steady.acceleration_") =>
        {
            &[
                "signals.steady.from=0 s",
                "signals.steady.to=100 s",
                "signals.steady.inertia_from=known torque",
                "signals.steady.test_torque=20 N mm",
                "signals.steady.acceleration_with=80 rad/s^2",
                "signals.steady.acceleration_without=-15 rad/s^2",
            ]
        }
        "signals.steady.windage_deviation" => &[
            "signals.steady.from=0 s",
            "signals.steady.to=100 s",
            "signals.steady.windage_constant=0.2 N mm",
        ],
        _ if path.starts_with("signals.steady.test_") => &[
            "signals.steady.from=0 s",
            "signals.steady.to=100 s",
            "signals.steady.inertia_from=pendulum",
            "signals.steady.test_mass=0.4 kg",
            "signals.steady.test_period=0.6 s",
            "signals.steady.test_arm=60 mm",
        ],
        _ if path.starts_with("signals.steady.") => {
            &["signals.steady.from=0 s", "signals.steady.to=100 s"]
        }
        "signals.cage.highest_slip" => &["signals.cage.kind=vibration"],
        "bearing.acceleration_loss.kind" => &["bearing.fidelity=rolling"],
        "bearing.acceleration_loss.force" => &[
            "bearing.fidelity=rolling",
            "bearing.acceleration_loss.kind=constant",
        ],
        "bearing.acceleration_loss.per_acceleration" => &[
            "bearing.fidelity=rolling",
            "bearing.acceleration_loss.kind=proportional",
        ],
        _ if path.starts_with("bearing.acceleration_loss.") => &[
            "bearing.fidelity=rolling",
            "bearing.acceleration_loss.kind=affine",
            "bearing.acceleration_loss.force_over_speed=[[\"0 rad/s\", \"1 N\"], [\"1 rad/s\", \"1 N\"]]",
            "bearing.acceleration_loss.per_acceleration_over_speed=[[\"0 rad/s\", \"1e-5 N s^2/rad\"], [\"1 rad/s\", \"1e-5 N s^2/rad\"]]",
        ],
        "rotor.balance_planes" => &["rotor.balance_grade=2.5 mm/s"],
        _ => &[],
    };
    list.iter().map(|set| set.to_string()).collect()
}

/// The choices that the system has.
/// What a coast-down after a drop needs.
const COAST_DOWN: &[&str] = &[
    "heat.network=on",
    "run.until=standstill",
    "bearing.moment.law=palmgren",
    "bearing.moment.lubrication=grease",
    "bearing.moment.temperature=60 degC",
    "bearing.moment.viscosity_points=[[\"40 degC\", \"100 mm^2/s\"], [\"100 degC\", \"11 mm^2/s\"]]",
];

fn choices_of(system: SystemName, path: &str) -> Vec<String> {
    let known =
        |set: &String| keys_of(system).any(|key| set.starts_with(&format!("{}=", key.path)));
    let beside = MOUNT.iter().filter(|(part, _)| path.starts_with(part));
    let beside = beside.flat_map(|(_, sets)| sets.iter().map(|set| (*set).to_string()));
    let own = format!("{path}=");
    let runs_out = path.starts_with("coast_down.") || path == "run.until";
    let of_contact = path == "contact.friction_over_temperature";
    let of_network = path.starts_with("heat.") && path != "heat.network" || of_contact;
    let warms: &[&str] = match runs_out {
        true => COAST_DOWN,
        false if of_network => &COAST_DOWN[..1],
        false => &[],
    };
    let warms = (warms.iter()).filter(|_| system != SystemName::CoastDown);
    choices(path)
        .into_iter()
        .chain(warms.map(|set| (*set).to_string()))
        .chain(beside.filter(|set| !set.starts_with(&own)))
        .filter(known)
        // the viscosity of a coast-down is that of two points
        .filter(|set| {
            system != SystemName::CoastDown || !set.starts_with("bearing.moment.viscosity")
        })
        .collect()
}

/// A value that no other key has, and small enough for every check: its text and its size in SI.
fn unlike_any_other(path: &str, kind: Kind, range: Range, example: &str) -> Option<(String, f64)> {
    match kind {
        Kind::Quantity(unit) => {
            let si = match path {
                "contact.bore_diameter" | "drive.bore_diameter" => 0.0234567,
                "contact.radial_air_clearance" => 0.000234567,
                "heat.outer_diameter" => 0.0567891,
                "heat.race_limit" | "heat.cage_limit" | "heat.lubricant_limit" => 412.34567,
                "bearing.pitch_diameter" => 0.0367891,
                "bearing.ball_diameter" => 0.00612345,
                "bearing.moment.bore_diameter" | "bearing.fits.bore_diameter" => 0.0234567,
                "bearing.fits.outer_diameter" | "bearing.row_spacing" => 0.0512345,
                "bearing.fits.housing_outer_diameter" => 0.0812345,
                "bearing.cage.land_diameter" => 0.0401234,
                "contact.face_radius" => 0.0143210,
                "bearing.moment.outer_diameter" => 0.0512345,
                "levitation.stiffness" => 1_234_567.0,
                "rotor.longest_element" => 0.0345678,
                "bearing.static_load_rating" => 6543.21,
                "torque.speed_to" | "rig.logger.total_rate" => 1234.567,
                "run.output_interval" => 0.000345678,
                "bearing.lubricant_state.breakdown_time"
                | "bearing.lubricant_state.recovery_time"
                | "bearing.lubricant_state.film_heat_capacity" => 0.0123456,
                _ if path.starts_with("run.") => {
                    units::parse_quantity(example).unwrap().value_si * 0.9876543
                }
                _ => 1.234567e-5,
            };
            Some((format!("{} {unit}", units::number_text(si)), si))
        }
        Kind::Table(first, second) => {
            let si = 1.234567e-5;
            let cell = |value: &str| match second {
                "1" => value.to_string(),
                unit => format!("\"{value} {unit}\""),
            };
            let (first_cell, second_cell) = (cell("1e-6"), cell(&si.to_string()));
            let text = format!("[[\"0 {first}\", {first_cell}], [\"1 {first}\", {second_cell}]]");
            Some((text, si))
        }
        Kind::Coefficient => {
            let si = match range {
                Range::Above(low) => low + 0.0123456,
                Range::FromTo(low, _) if low < 0.0 => low * 0.1234567,
                Range::FromTo(..) if path.ends_with("friction_coefficient") => 0.0612345,
                Range::FromTo(..) if path.starts_with("analysis.") || path.starts_with("base.") => {
                    0.0612345
                }
                Range::FromTo(low, _) => low * 1.234567,
                // a traction coefficient must not become negative, so A is
                _ if path == "bearing.traction.a" => -0.0612345,
                _ => 0.0612345,
            };
            Some((format!("{si:?}"), si))
        }
        _ => None,
    }
}

/// Keys that stand for another value: positive frequencies in rad/s, eccentricity, viscosity, angle of the cage, state after a rest.
const BECOME_OTHERS: [&str; 6] = [
    "base.spectrum",
    "rotor.unbalance",
    "bearing.moment.viscosity_points",
    "bearing.moment.temperature",
    "bearing.lubricant_state.build_up_turns",
    "bearing.lubricant_state.rest_before",
];

/// Each number reaches the typed scenario, and only under its own name: a value that nothing else has is found there once.
#[test]
fn every_number_reaches_the_typed_scenario() {
    for system in SystemName::ALL {
        for key in keys_of(*system) {
            let Some((text, si)) = unlike_any_other(key.path, key.kind, key.range, key.example)
            else {
                continue;
            };
            // a temperature of the oil's data is read in the tests of lubricants
            if BECOME_OTHERS.contains(&key.path) || key.path == "bearing.traction.oil_temperature" {
                continue;
            }
            // a coast-down has one law of those that other systems are tried with
            if *system == SystemName::CoastDown && key.path.starts_with("bearing.moment.") {
                continue;
            }
            // the mesh has it
            if *system == SystemName::Machine && key.path == "rotor.longest_element" {
                continue;
            }
            // the unbalances have it
            if key.path == "rotor.balance_grade" {
                continue;
            }
            let mut list = choices_of(*system, key.path);
            if key.path == "bearing.traction.a" {
                list.push(format!("bearing.traction.d={:?}", -si));
            }
            if key.path == "bearing.traction.d" {
                list.push(format!("bearing.traction.a={:?}", -si));
            }
            list.push(format!("{}={text}", key.path));
            let typed = read(&base(*system, key.path), &list).system;
            let name = match key.name() {
                _ if key.path.starts_with("levitation.axial_") => "axial",
                name if name.starts_with("preload_spring_") => name.split_at(15).1,
                "face_radius" => "radius",
                "face_width" => "width",
                "face_stiffness" => "stiffness",
                "misalignment_x" | "misalignment_y" => "misalignment",
                "windage_constant" => "constant",
                "windage_linear" => "linear",
                "windage_quadratic" => "quadratic",
                "windage_deviation" => "deviation",
                "brake_torque" => "torque",
                "start_x" | "start_y" => "start_displacement",
                "start_speed_x" | "start_speed_y" => "start_velocity",
                "record_x" | "record_y" => "record",
                "shock_x" | "shock_y" => "acceleration",
                "shock_start" => "start",
                "shock_duration" => "duration",
                "spectrum_x" | "spectrum_y" => "shares",
                "spectrum_rise" | "spectrum_hold" | "spectrum_decay" => "envelope",
                "spectrum_damping" => "damping",
                "power_lost_at" => "power_lost",
                "brake_start" => "start",
                "torque_rate" | "peak_acceleration" => "engagement",
                "first_release_at" => "release_at",
                "largest_torque" => "clutch_torque",
                "kinetic" => "kinetic_coefficient",
                "static" => "static_coefficient",
                "oil_conductivity" => "conductivity",
                "load_history" => "radial_load",
                "torque_history" => "torque",
                "film_heat_capacity" => "heat_capacity",
                "film_conductance" => "conductance",
                "drag_temperature_coefficient" => "drag_coefficient",
                "traction_temperature_coefficient" => "traction_coefficient",
                "initial_build_up" => "build_up",
                "initial_breakdown" => "breakdown",
                name => name,
            };
            // the typed cage and its land, rotor and race of a surface have names of their own
            let short = ["cage_", "land_", "rotor_", "race_"]
                .iter()
                .fold(name, |name, of| name.trim_start_matches(of));
            let shown = format!("{typed:#?}");
            let wrapped = [
                ": Some(\n",
                ": Constant(\n",
                ": Table(\n",
                ": Rate(\n",
                ": PeakAcceleration(\n",
                ": [\n",
            ]
            .iter()
            .any(|form| {
                [name, short]
                    .iter()
                    .any(|name| shown.contains(&format!("{name}{form}")))
            }) || key.path == "drive.speed_history";
            // where nothing moves the inertia counts as a mass on the circle of the ball centres
            let counts_as_mass = ["Torque(", "Identify("]
                .iter()
                .any(|system| shown.starts_with(system));
            if key.path == "bearing.cage_inertia" && counts_as_mass {
                continue;
            }
            let found = shown.contains(&format!("{name}: {si:?},"))
                || shown.contains(&format!(" {short}: {si:?},"))
                || (wrapped && shown.matches(&format!(" {si:?},")).count() == 1);
            assert!(found, "{} = {text}\n{shown}", key.path);
        }
    }
}

/// Each default and each example is itself a right value.
#[test]
fn examples_and_defaults_are_right_values() {
    for system in SystemName::ALL {
        let own = |path| !["format", "system"].contains(&path);
        for key in keys_of(*system).filter(|key| own(key.path)) {
            let fallback = match key.presence {
                Presence::Default(fallback) | Presence::DefaultWhen(_, fallback, _) => {
                    Some(fallback.text)
                }
                _ => None,
            };
            for text in [Some(key.example), fallback].into_iter().flatten() {
                let mut list = choices_of(*system, key.path);
                list.push(format!("{}={text}", key.path));
                // A choice that needs more keys is read in another test, and the catalogue is no file here.
                let alone = [
                    "rotor.unbalance",
                    "catalogue",
                    "bearing.lubricant_state.kind",
                ];
                // a coast-down has one law, and its viscosity by two points
                let law =
                    *system == SystemName::CoastDown && key.path.starts_with("bearing.moment.");
                let needs_more = law
                    || alone.contains(&key.path)
                    || ["palmgren", "proportional", "inner land", "outer land", "DB"]
                        .contains(&text);
                if needs_more {
                    continue;
                }
                read(&base(*system, key.path), &list);
            }
        }
    }
}
