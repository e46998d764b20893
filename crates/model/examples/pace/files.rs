//! Machines of the files in `shared/cases/reference` beside the repository, as constants of the model.

use crate::machines::bent::Shaft;
use crate::machines::vec2;
use model::auxiliary_bearing::{AuxiliaryBearingConstants, RaceConstants};
use model::bearing::ball::BallConstants;
use model::bearing::{BearingConstants, PlanarConstants, Separation};
use model::contact::JournalContact;
use model::levitation::{Fade, FadingMagnet, Levitation};
use model::mount::{
    FrictionRing, HardStop, Housing, MaxwellBranch, Mount, MountParts, SqueezeFilm,
};
use model::rotor::RotorConstants;
use model::schedule::Schedule;
use model::system::machine::MachineConstants;
use nalgebra::DVector;
use number::Vec2;
use physics::traction::{FourParameterTraction, TanhTraction, Traction};
use rotor::{Annulus, Disk, Element, Material, PointMass, Rotor, Unbalance};
use serde_json::Value;

/// A file of a folder; none outside the reference's own place.
pub fn read(folder: &str, name: &str) -> Option<Value> {
    let path = format!(
        "{}/../../../shared/cases/{folder}/{name}.json",
        env!("CARGO_MANIFEST_DIR")
    );
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("NOT RUN: {path} is absent");
        return None;
    };
    Some(serde_json::from_str(&text).expect("a file of the reference"))
}

pub fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().unwrap_or_else(|| panic!("no {key}"))
}
pub fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("no {key}"))
}
fn index(value: &Value, key: &str) -> usize {
    number(value, key) as usize
}
pub fn numbers(value: &Value, key: &str) -> Vec<f64> {
    let numbers = list(value, key).iter().map(Value::as_f64);
    numbers.collect::<Option<_>>().expect("numbers")
}
pub fn pair(value: &Value, key: &str) -> Vec2<f64> {
    let both = numbers(value, key);
    vec2(both[0], both[1])
}
pub fn pairs(value: &Value, key: &str) -> Vec<Vec2<f64>> {
    let pairs = list(value, key).iter();
    pairs
        .map(|p| vec2(p[0].as_f64().expect("x"), p[1].as_f64().expect("y")))
        .collect()
}

/// The shaft with disks and masses of a file; supports are left out.
pub fn shaft(model: &Value) -> Rotor {
    let elements = list(model, "shaft_elements").iter().map(|e| {
        let annulus = |side: &str| Annulus {
            outer: number(e, &format!("od{side}")),
            inner: number(e, &format!("id{side}")),
        };
        let (young, density) = (number(e, "E"), number(e, "rho"));
        Element {
            left: index(e, "n_l"),
            length: number(e, "L"),
            start: annulus("l"),
            end: annulus("r"),
            material: match e["G"].as_f64() {
                Some(shear) => Material {
                    young,
                    shear,
                    density,
                },
                None => Material::new(young, number(e, "nu"), density),
            },
            carries: true,
            damping_of_mass: number(e, "alpha"),
            damping_of_stiffness: number(e, "beta"),
            damping_rotating: e["beta_internal"].as_f64().unwrap_or(0.0),
        }
    });
    let disks = list(model, "disks").iter().map(|d| Disk {
        node: index(d, "n"),
        mass: number(d, "m"),
        polar: number(d, "Ip"),
        diametral: number(d, "Id"),
    });
    let masses = list(model, "point_masses").iter().map(|m| PointMass {
        node: index(m, "n"),
        mass: number(m, "m"),
    });
    Rotor {
        nodes: numbers(model, "node_positions_m"),
        elements: elements.collect(),
        disks: disks.collect(),
        masses: masses.collect(),
        ..Rotor::default()
    }
}

/// Unbalances of a machine.
pub fn unbalance(machine: &Value) -> Vec<Unbalance> {
    let planes = list(machine, "unbalance").iter();
    planes
        .map(|plane| Unbalance {
            node: index(plane, "node"),
            amount: number(plane, "kg_m"),
            phase: number(plane, "phase_rad"),
        })
        .collect()
}

/// What a mount has besides spring and damper. A branch without stiffness stays: it keeps the place of its states.
pub fn mount_parts(b: &Value) -> MountParts {
    let of = |key: &str| number(b, key);
    let mass = b["m_h"].as_f64().unwrap_or(0.0);
    MountParts {
        branches: [("k1", "tau1"), ("k2", "tau2")]
            .map(|(stiffness, time)| MaxwellBranch {
                stiffness: of(stiffness),
                rate: 1.0 / of(time),
            })
            .to_vec(),
        ring: Some(FrictionRing {
            stiffness: of("kf"),
            travel: of("ef"),
            exponent: of("nf"),
        }),
        film: (of("sfd") > 0.0).then(|| SqueezeFilm {
            factor: of("sfd"),
            clearance: of("sfd_c"),
            cavitates: of("sfd_pi") == 1.0,
        }),
        stop: (of("hs_k") > 0.0).then(|| HardStop {
            stiffness: of("hs_k"),
            gap: of("hs_gap"),
            damping: of("hs_a"),
        }),
        housing: (mass > 0.0).then(|| Housing {
            mass,
            stiffness: of("kh"),
            damping: of("ch"),
        }),
        ..MountParts::NONE
    }
}

/// A bearing.
fn auxiliary_bearing(b: &Value, shaft: &Shaft, gravity: Vec2<f64>) -> AuxiliaryBearingConstants {
    let of = |key: &str| number(b, key);
    let (radius, mass) = (of("r"), of("m_b"));
    let traction = match index(b, "tr_kind") {
        0 => Traction::Tanh(TanhTraction {
            maximum: of("mu_max"),
            inverse_reference_speed: 1.0 / of("u0"),
        }),
        _ => Traction::FourParameter(FourParameterTraction {
            a: of("trA"),
            b: of("trB"),
            c: of("trC"),
            d: of("trD"),
        }),
    };
    AuxiliaryBearingConstants {
        name: format!("at_{}", index(b, "node")),
        node: shaft.row(index(b, "node")),
        datum: vec2(of("ox"), of("oy")),
        contact: JournalContact {
            radial_clearance: of("c0"),
            bore_radius: of("R0"),
            stiffness: of("kr"),
            exponent: of("nr"),
            damping: of("ar"),
            friction: of("mur"),
            inverse_reference_speed: 1.0 / of("u0r"),
        },
        inner_race: RaceConstants {
            mass: of("m_i"),
            inertia: of("I_i"),
            centre_held: false,
            torque: 0.0,
        },
        bearing: BearingConstants::Planar(PlanarConstants {
            balls: index(b, "N"),
            ball: BallConstants {
                radius,
                ball_radius: radius,
                load_per_radial_force: 1.0,
                mass,
                inverse_mass: 1.0 / mass,
                inverse_inertia: 1.0 / (0.4 * mass * radius * radius),
                inner_track: of("Ri"),
                inner_track_growth: 0.0,
                outer_track: of("Ro"),
                inner_stiffness: of("Ki"),
                outer_stiffness: of("Ko"),
                damping_time: of("beta"),
                pocket_radius: of("Rp"),
                pocket_gap: of("gp"),
                pocket_stiffness: of("kp"),
                pocket_damping: of("ap"),
                pocket_friction: of("mu_c"),
                pocket_inverse_reference_speed: 1.0 / of("u0c"),
                orbit_drag: of("cd"),
                spin_drag: of("cw"),
                gravity,
            },
            traction,
            separation: Separation::CentredCage,
            cage_mass: of("m_c"),
            cage_inertia: of("I_c"),
            cage_drag: of("cc"),
            first_ball_angle: 0.0,
            moment: None,
            inlet_rolling: None,
            lubricant: None,
        }),
        outer_race_mass: of("m_o"),
        mount: Mount {
            stiffness: of("ks"),
            damping: of("cs"),
            free_position: vec2(0.0, 0.0),
        },
        mount_parts: mount_parts(b),
    }
}

/// A machine of a file on a shaft in some coordinates, at a speed at release.
pub fn machine(given: &Value, shaft: &Shaft, speed: f64) -> MachineConstants {
    let gravity = pair(given, "gravity");
    let bearings = list(given, "bearings").iter();
    let torque = |part: &str, key: &str| given[part][key].as_f64().unwrap_or(0.0);
    let mut constants = MachineConstants {
        rotor: RotorConstants {
            drive_torque: torque("drive", "d0"),
            drive_slope: torque("drive", "d1"),
            drag: torque("drag", "a"),
            drag_square: torque("drag", "b"),
            ..shaft.constants()
        },
        levitation: Levitation {
            stiffness: 0.0,
            damping: 0.0,
            centre: vec2(0.0, 0.0),
            carried: vec2(0.0, 0.0),
        },
        magnets: Vec::new(),
        bearings: bearings
            .map(|bearing| auxiliary_bearing(bearing, shaft, gravity))
            .collect(),
        gravity,
        speed,
        unbalance_angle: 0.0,
        schedule: Schedule::default(),
    };
    // with a decay time of zero they are off at once
    if number(given, "tau_m") > 0.0 {
        let magnets = list(given, "magnets").iter().map(|magnet| FadingMagnet {
            node: shaft.row(index(magnet, "node")),
            fade: Fade {
                force: pair(magnet, "i0") * number(magnet, "ki"),
                stiffness: number(magnet, "ks"),
                decay_rate: 1.0 / number(given, "tau_m"),
                cut: 0.0,
            },
        });
        constants.magnets = magnets.collect();
    }
    constants.balance_mounts();
    constants
}

/// Coordinates η of displacements and slopes of all nodes.
pub fn coordinates(shaft: &Shaft, q: &[Vec2<f64>]) -> Vec<Vec2<f64>> {
    let plane = |of: &dyn Fn(&Vec2<f64>) -> f64| {
        let values = DVector::from_iterator(q.len(), q.iter().map(of));
        shaft.basis.shapes.tr_mul(&(&shaft.matrices.mass * values))
    };
    let (x, y) = (plane(&|q| q.x), plane(&|q| q.y));
    x.iter().zip(y.iter()).map(|(x, y)| vec2(*x, *y)).collect()
}
