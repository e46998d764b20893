//! Keys that users try and that nothing describes yet: the answer says so, with the page of the book, instead of a near name.

use crate::system::{SystemName, WITH_NETWORK};
use catalogue::designation::PAIRS;

/// Something that no system describes.
#[derive(Debug)]
pub struct Absent {
    /// Paths as users write them, with blanks between: a section or key with all below it, or `*.name` in any section.
    paths: &'static str,
    /// What it is.
    what: &'static str,
    /// Number on the page of limits.
    point: u8,
    /// What there is instead; empty for nothing.
    instead: &'static str,
}

impl Absent {
    /// What to read.
    pub fn allowed(&self) -> String {
        format!(
            "{} (\"When not to trust this\" in the book, point {})",
            self.what, self.point
        )
    }

    /// What there is instead.
    pub fn hint(&self) -> Option<String> {
        (!self.instead.is_empty()).then(|| self.instead.to_string())
    }
}

/// What a path asks for, where the system does not describe it.
pub fn of(path: &str, system: SystemName) -> Option<&'static Absent> {
    let path = path.to_lowercase();
    if WITH_NETWORK.contains(&system) && (path == "heat" || path.starts_with("heat.")) {
        return None;
    }
    let name = path.rsplit('.').next().unwrap_or(&path);
    let asks = |pattern: &str| match pattern.strip_prefix("*.") {
        Some(wanted) => name == wanted,
        None => path
            .strip_prefix(pattern)
            .is_some_and(|rest| rest.is_empty() || rest.starts_with('.')),
    };
    let own = if system.bends() { MACHINE } else { &[] };
    std::iter::once(&BASE)
        .chain(own)
        .chain(TABLE)
        .find(|absent| absent.paths.split_whitespace().any(&asks))
}

/// Other motion of the base.
const BASE: Absent = Absent {
    paths: "base.shock_z base.record_z base.channel_z base.spectrum_z base.axial base.tilt base.angle base.rotation base.roll base.pitch base.yaw",
    what: "the base translates in the plane of the bearings: its motion along the shaft and its rotation are not described",
    point: 10,
    instead: "Motion in the plane is record, channel, spectrum and shock of [base], each along x and along y",
};

/// What a machine lacks, or has under another name.
const MACHINE: &[Absent] = &[
    Absent {
        paths: "levitation.noise *.noise",
        what: "noise of sensors is an event",
        point: 2,
        instead: "[[event]] with do = \"sensor noise\"; an offset is levitation.sensor.offset_1",
    },
    Absent {
        paths: "relevitation drop.relevitate drop.relevitation levitation.recovery levitation.relevitation levitation.on_at \
                levitation.power_restored_at levitation.failure levitation.fault levitation.magnet.power_lost_at \
                *.fails_at *.lost_axis *.fault",
        what: "no key of the levitation describes faults of magnets, amplifiers, controllers and sensors, or levitation that comes back: events do",
        point: 2,
        instead: "[[event]] with do, at, and the magnet and axis that it happens to",
    },
    Absent {
        paths: "foundation seismic shock earthquake rotor.impulse rotor.initial_displacement rotor.initial_velocity rotor.lost_mass \
                rotor.blade_loss *.lost_at",
        what: "motion of the base, starts and lost blades have keys of their own",
        point: 2,
        instead: "Base: [base]; starts: rotor.start_x, start_speed_x; a lost blade: [[event]] with do = \"unbalance\"; a force over time: [[rotor.force]]",
    },
    Absent {
        paths: "*.tilt *.misalignment",
        what: "a contact lies in the plane of its node: tilt within the landing sleeve is not described",
        point: 2,
        instead: "contact.misalignment_x and misalignment_y shift a bearing against the line of levitation",
    },
    Absent {
        paths: "bearing.rows bearing.row bearing.paired bearing.pair bearing.duplex bearing.set bearing.count \
                bearing.number bearing.number_of_bearings bearing.number_of_rows rotor.planes",
        what: "a pair or a set is described as one bearing in space alone",
        point: 10,
        instead: "With bearing.fidelity = \"spatial\" it is bearing.arrangement. In the plane equal rows at one node are an [[auxiliary_bearing]] with planes = 2, with the ball_count of one row and half of the place's \
                  mount.stiffness, mount.damping and mount.moving_mass; rows that differ, or at nodes a bearing's width apart, are tables of \
                  their own",
    },
];

const TABLE: &[Absent] = &[
    Absent {
        paths: "axial thrust thrust_bearing rotor.thrust rotor.axial_load *.axial_gap contact.axial_clearance bearing.axial_clearance \
                *.axial_air_clearance *.axial_play *.axial_speed *.thrust_load",
        what: "bearings of the plane know no motion along the shaft, no axial gap and no thrust faces",
        point: 10,
        instead: "A machine has bearings in space: bearing.fidelity = \"spatial\" with contact.gap_to_start, contact.gap_to_end and gravity.axial. In the plane constant axial loads are bearing.axial_preload, for contacts and friction, and bearing.moment.axial_load, for friction alone",
    },
    Absent {
        paths: "*.transverse_inertia *.diametral_inertia *.diametrical_inertia *.equatorial_inertia \
                *.transverse_moment_of_inertia *.centre_of_mass *.center_of_mass *.centre_of_gravity \
                *.center_of_gravity *.bearing_distance *.bearing_span *.axial_position rotor.position \
                contact.position mount.position bearing.position *.tilt *.misalignment *.dynamic_unbalance \
                *.couple_unbalance",
        what: "tilt and conical motion are not described: the rotor stays parallel to itself",
        point: 2,
        instead: "With system = \"machine\" the rotor is a shaft that tilts and bends, each bearing at a node of it (auxbear new machine)",
    },
    Absent {
        paths: "shaft rotor.shaft rotor.stiffness rotor.shaft_stiffness rotor.bending_stiffness rotor.damping \
                rotor.modes rotor.flexible rotor.elements rotor.nodes rotor.disks rotor.stations rotor.length \
                *.youngs_modulus *.elastic_modulus",
        what: "a rotor that bends is not described",
        point: 2,
        instead: "With system = \"machine\" it does (auxbear new machine); with rotor.first_bending_frequency a drop says whether it matters",
    },
    Absent {
        paths: "heat thermal temperature coolant cooling *.coolant *.heat rotor.temperature contact.temperature mount.temperature \
                bearing.temperature *.heat_capacity *.thermal_conductivity *.thermal_expansion",
        what: "no such value of heat is described",
        point: 5,
        instead: "heat.network = \"on\" follows the temperatures of a drop, machine, spin-up or rig, with viscosity and clearance (heat.feedback) and friction (contact.friction_over_temperature), run.until = \"standstill\" goes on until the rotor stands, and surfaces that rub warm with contact.width and contact.surface; the temperature of the lubricant is bearing.moment.temperature; its slow state, with films that warm, is [bearing.lubricant_state]",
    },
    Absent {
        paths: "life wear fatigue *.life *.wear *.l10 *.drops \
                *.number_of_drops *.landings",
        what: "a run is one drop of a fresh bearing: life, earlier drops and their number are no input",
        point: 11,
        instead: "Life, dents and the drops until bearings fail are results of a drop (life_share, indentation_index), auxbear service adds up many drops, and wear of the landing surfaces needs contact.surface.wear_coefficient",
    },
    Absent {
        paths: "controller magnet magnets amb magnetic_bearing levitation.controller levitation.control \
                levitation.pid levitation.kp levitation.ki levitation.kd levitation.ks levitation.gain \
                levitation.current levitation.current_limit levitation.bias_current levitation.force_limit \
                levitation.recovery levitation.relevitation levitation.off levitation.off_at levitation.on_at \
                levitation.failure levitation.force levitation.load_capacity relevitation drop.relevitate \
                drop.relevitation",
        what: "controllers, currents and faults of the magnetic bearing are not described: it is a spring and a damper until time 0, then off",
        point: 3,
        instead: "levitation.stiffness and levitation.damping set the orbit before the release; magnets and controllers are those of system = \"machine\"",
    },
    Absent {
        paths: "bearing.rows bearing.row bearing.paired bearing.pair bearing.duplex bearing.set \
                bearing.count bearing.number bearing.number_of_bearings bearing.number_of_rows",
        what: "a pair, set or several rows are not described as one bearing",
        point: 10,
        instead: PAIRS,
    },
    Absent {
        paths: "foundation pedestal support housing mount.friction mount.friction_coefficient mount.squeeze_film mount.tolerance_ring mount.stop \
                mount.gap mount.hysteresis mount.exponent mount.o_ring",
        what: "a mount is a sum of parts that are equal in all directions",
        point: 7,
        instead: "Besides stiffness and damping: branch_stiffness and branch_time (O-ring), ring_stiffness and ring_travel (tolerance ring), film_…, stop_…, housing_… of [mount]; of a machine a [[rotor.housing]] that several bearings and magnets share",
    },
    Absent {
        paths: "landing landing_sleeve sleeve landing.sleeve contact.sleeve contact.coating",
        what: "a landing sleeve is no body of its own: it is one with the inner race",
        point: 7,
        instead: "Its bore and width are contact.bore_diameter and contact.width, its mass belongs to bearing.inner_race_mass and inner_race_inertia",
    },
    Absent {
        paths: "*.starvation *.starved *.oil_quantity *.grease_fill *.relubrication",
        what: "contacts have all the oil they need: starved films and the quantity of the lubricant are not described",
        point: 6,
        instead: "",
    },
    Absent {
        paths: "motor generator drive_motor rotor.motor_torque seal seals windage gas process rotor.brake_curve rotor.braking_curve \
                rotor.speed_curve rotor.load_torque",
        what: "what drives or loads a rotor is a torque under another name, and forces of seals and gas on a rigid rotor are not described",
        point: 5,
        instead: "Torques are rotor.brake_torque with rotor.spin = \"braked\", and rotor.torque_over_speed with rotor.torque_share_over_time; a machine has [[rotor.seal]], rotor.drive_torque, drive_slope, drag and windage",
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table;

    #[test]
    fn what_exists_is_not_told_to_be_absent() {
        for key in table::keys() {
            for system in table::systems(key) {
                assert!(
                    of(key.path, *system).is_none() || key.path.starts_with("rig."),
                    "{}",
                    key.path
                );
            }
        }
        for section in table::sections() {
            for system in section.systems {
                assert!(of(section.path, *system).is_none(), "{}", section.path);
            }
        }
    }

    #[test]
    fn every_point_stands_on_the_page_of_limits() {
        let page = include_str!("../../../book/src/limits.md");
        for absent in TABLE.iter().chain([&BASE]) {
            assert!(
                page.contains(&format!("\n{}. ", absent.point)),
                "{}",
                absent.what
            );
        }
    }

    #[test]
    fn likely_words_are_known_in_any_case_and_with_what_is_below_them() {
        for path in [
            "rotor.axial_gap",
            "rotor.transverse_inertia",
            "thermal.enabled",
            "levitation.controller",
            "Levitation.Kp",
            "bearing.rows",
            "bearing.paired",
            "bearing.count",
            "rotor.shaft.length",
            "mount.tolerance_ring",
            "motor.torque",
            "coolant.flow",
            "foundation.mass",
            "drop.relevitate",
            "lubricant.starvation",
            "landing.sleeve",
            "levitation.force",
        ] {
            assert!(of(path, SystemName::Drop).is_some(), "{path}");
        }
        for path in [
            "rotor.mas",
            "heat.enabled",
            "heating",
            "bearing.counts",
            "levitation.kpa",
        ] {
            assert!(of(path, SystemName::Drop).is_none(), "{path}");
        }
        for (path, words) in [
            ("levitation.relevitation", "comes back"),
            ("levitation.sensor.1.noise", "noise"),
            ("seismic.acceleration", "motion of the base"),
            ("base.shock_z", "along the shaft"),
            ("contact.tilt", "landing sleeve"),
            ("bearing.duplex", "one node"),
            ("base.tilt", "plane of the bearings"),
        ] {
            let absent = of(path, SystemName::Machine).expect(path);
            let text = format!("{} {}", absent.what, absent.instead);
            assert!(text.contains(words), "{path}: {text}");
        }
    }
}
