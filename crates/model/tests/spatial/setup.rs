//! Assemblies of every kind, and random states in which all contacts press.

use model::bearing::{SharedMoment, SteadyMoment};
use model::contact::JournalContact;
use model::spatial::SpatialLevitation;
use model::spatial::ball::BALL_STATES;
use model::spatial::face::Face;
use model::spatial::mount::SpatialMount;
use model::spatial::pocket::SpatialPocket;
use model::spatial::race::RaceGroove;
use model::spatial::rigid_body::Inertia;
use model::spatial::{
    AssemblyConstants, CageConstants, CageGuide, InnerRing, LandingConstants, OuterRing,
    PreloadSpring, RowConstants, SpatialBall, SpatialLand, SpatialRotor,
};
use number::Vec3;
use physics::contact_nodes::{ContactNode, legendre, matched, middle};
use physics::groove::{axis_over_root_approach, contact_surface_radius};
use physics::hertz::{BallRace, PointContact, Race};
use physics::materials::{BEARING_STEEL, ball_mass, contact_modulus};
use physics::palmgren::{Palmgren, PalmgrenCombined};
use physics::traction::{AlgebraicTraction, FourParameterTraction, TanhTraction, Traction};

/// Numbers between -1 and 1, the same ones in every run.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    pub fn vector(&mut self, size: f64) -> Vec3<f64> {
        let mut one = || size * self.next();
        Vec3::new(one(), one(), one())
    }
}

/// Rows of an assembly: signs of their contact angle by rising place.
pub const O: &[f64] = &[1.0, -1.0];
pub const X: &[f64] = &[-1.0, 1.0];
pub const T: &[f64] = &[1.0, 1.0];
pub const SINGLE: &[f64] = &[1.0];

pub const TANH: Traction<f64> = Traction::Tanh(TanhTraction {
    maximum: 0.07,
    inverse_reference_speed: 10.0,
});
pub const FOUR: Traction<f64> = Traction::FourParameter(FourParameterTraction {
    a: -0.07,
    b: 0.35,
    c: 5.0,
    d: 0.07,
});
pub const ALGEBRAIC: Traction<f64> = Traction::Algebraic(AlgebraicTraction {
    maximum: 0.07,
    reference_speed: 0.1,
});

/// What guides the cages of an assembly.
#[derive(Clone, Copy)]
pub enum Guide {
    Tied,
    Balls,
    Outer,
    Inner,
}

pub const DIAMETER: f64 = 7e-3;
pub const PITCH: f64 = 37.2e-3;
const CURVATURES: [f64; 2] = [0.52, 0.53];
const ANGLE: f64 = 0.3;

fn groove(race: Race, place: f64) -> RaceGroove<f64> {
    let f = CURVATURES[usize::from(race == Race::Outer)];
    let contact = BallRace {
        ball_diameter: DIAMETER,
        pitch_diameter: PITCH,
        groove_curvature: f,
        contact_angle: 0.0,
        race,
    };
    let modulus = contact_modulus(BEARING_STEEL, BEARING_STEEL);
    let contact = PointContact::new(contact.curvature(), modulus).unwrap();
    let distance = (CURVATURES[0] + CURVATURES[1] - 1.0) * DIAMETER;
    let inner = 0.5 * PITCH - 0.5 * DIAMETER + CURVATURES[0] * DIAMETER;
    let r_g = f * DIAMETER;
    RaceGroove {
        centre_radius: match race {
            Race::Inner => inner,
            Race::Outer => inner - distance * ANGLE.cos(),
        },
        place,
        slack: r_g - 0.5 * DIAMETER,
        stiffness: contact.stiffness,
        half_axis: axis_over_root_approach(&contact),
        half_curvature: 0.5 / contact_surface_radius(0.5 * DIAMETER, r_g),
    }
}

fn row(
    place: f64,
    sign: f64,
    traction: Traction<f64>,
    nodes: &[ContactNode<f64>],
    guide: Guide,
) -> RowConstants {
    let distance = (CURVATURES[0] + CURVATURES[1] - 1.0) * DIAMETER;
    let half = 0.5 * sign * distance * ANGLE.sin();
    let land = |middle: f64| SpatialLand {
        contact: surfaces(1.0, 5e6),
        middle,
        half_width: 2e-3,
    };
    RowConstants {
        balls: 9,
        ball: SpatialBall {
            inner_growth: 2e-11,
            radius: 0.5 * DIAMETER,
            mass: ball_mass(DIAMETER, 7850.0),
            inner: groove(Race::Inner, place + half + 0.5 * sign * 8e-6),
            outer: groove(Race::Outer, place - half),
            damping_time: 2.5e-6,
            orbit_drag: 0.0,
            spin_drag: 0.0,
            gravity: Vec3::new(1.0, -9.81, 2.0),
            pocket: SpatialPocket {
                circle: 0.5 * PITCH,
                gap: 1e-4,
                stiffness: 1e7,
                damping: 0.5,
                friction: 0.05,
                inverse_reference_speed: 10.0,
            },
        },
        nodes: nodes.to_vec(),
        traction,
        moment: None,
        cage: CageConstants {
            inertia: Inertia {
                mass: 5e-3,
                axial: 1.62e-6,
                transverse: 8.9e-7,
            },
            drag: 0.0,
            guide: match guide {
                Guide::Tied => CageGuide::Tied,
                Guide::Balls => CageGuide::Balls,
                Guide::Outer => CageGuide::OuterLand(land(place)),
                Guide::Inner => CageGuide::InnerLand(land(0.0)),
            },
        },
    }
}

fn surfaces(exponent: f64, stiffness: f64) -> JournalContact<f64> {
    JournalContact {
        // so tight that random displacements of some 10 µm press
        radial_clearance: 1e-6,
        bore_radius: 12.5e-3,
        stiffness,
        exponent,
        damping: 0.5,
        friction: 0.15,
        inverse_reference_speed: 20.0,
    }
}

/// The steady moment of a row in grease.
pub fn greased() -> Option<SharedMoment> {
    Some(SharedMoment {
        law: SteadyMoment::PalmgrenCombined(PalmgrenCombined {
            law: Palmgren {
                viscous_factor: 2.0,
                viscosity: 5e-6,
                pitch_diameter: PITCH,
                load_factor: 5e-3,
                load_exponent: 0.33,
                static_load_rating: 4e3,
                preload: 0.0,
            },
            radial_factor: -0.1,
            axial_factor: 1.4,
            static_radial_factor: 0.5,
            static_axial_factor: 0.46,
        }),
        axial_load: 0.0,
        orbit_share: 0.3,
        reference_spin: 1.0,
    })
}

/// An assembly without a rotor whose mount, drags and drives are nothing.
pub fn bearing(
    signs: &[f64],
    traction: Traction<f64>,
    nodes: &[ContactNode<f64>],
    guide: Guide,
) -> AssemblyConstants {
    let places: &[f64] = if signs.len() == 1 {
        &[0.0]
    } else {
        &[-6e-3, 6e-3]
    };
    let rows = places.iter().zip(signs);
    AssemblyConstants {
        gravity: Vec3::new(1.0, -9.81, 2.0),
        inner: InnerRing {
            inertia: Inertia {
                mass: 0.0204,
                axial: 3.9e-6,
                transverse: 2.6e-6,
            },
            held: false,
            torque: 0.0,
            force: Vec3::zero(),
            moment: Vec3::zero(),
            settling: 0.0,
            tilt_settling: 0.0,
        },
        outer: OuterRing {
            inertia: Inertia {
                mass: 0.15,
                axial: 7e-5,
                transverse: 4e-5,
            },
            turns: !matches!(guide, Guide::Tied),
            mount: SpatialMount {
                radial_stiffness: 0.0,
                axial_stiffness: 0.0,
                radial_damping: 0.0,
                axial_damping: 0.0,
                tilt_stiffness: 0.0,
                turn_damping: 0.0,
                torsion_stiffness: 0.0,
                free_position: Vec3::zero(),
            },
        },
        rows: rows
            .map(|(place, sign)| row(*place, *sign, traction, nodes, guide))
            .collect(),
        spring: None,
        rotor: None,
    }
}

/// The same with a rotor in its bore, both faces and mount, drags, drives and levitation.
pub fn machine(mut bearing: AssemblyConstants, tilted: bool) -> AssemblyConstants {
    let face = |side: f64| Face {
        side,
        shoulder: side * 6e-3,
        place: side * 6e-3,
        radius: 14e-3,
        stiffness: 2e8,
        damping: 0.5,
        friction: 0.15,
        inverse_reference_speed: 20.0,
    };
    bearing.rotor = Some(SpatialRotor {
        inertia: Inertia {
            mass: 8.0,
            axial: 0.01,
            transverse: 0.05,
        },
        eccentricity: 5e-6,
        landing: LandingConstants {
            contact: surfaces(10.0 / 9.0, 2.5e8),
            stations: if tilted { vec![-5e-3, 6e-3] } else { vec![0.0] },
            faces: vec![face(1.0), face(-1.0)],
            face_nodes: face_nodes(12),
        },
        levitation: Some((
            SpatialLevitation {
                stiffness: 1e6,
                damping: 1e3,
                axial_stiffness: 2e6,
                axial_damping: 1e3,
                carries: true,
                carries_axially: true,
            },
            vec![-0.08, 0.08],
        )),
    });
    bearing.inner.torque = 0.02;
    bearing.inner.force = Vec3::new(3.0, -2.0, 5.0);
    bearing.inner.moment = Vec3::new(0.1, 0.2, -0.05);
    bearing.inner.settling = 3.0;
    bearing.inner.tilt_settling = 1e-3;
    for row in &mut bearing.rows {
        row.ball.orbit_drag = 2e-4;
        row.ball.spin_drag = 1e-9;
        row.cage.drag = 1e-6;
    }
    bearing.outer.mount = SpatialMount {
        radial_stiffness: 2e7,
        axial_stiffness: 1e7,
        radial_damping: 5e3,
        axial_damping: 3e3,
        tilt_stiffness: 5e3,
        turn_damping: 1.0,
        torsion_stiffness: 1e4,
        free_position: Vec3::zero(),
    };
    bearing.outer.mount.free_position = bearing.balanced_free_position();
    bearing
}

/// The same, tied cages, the rows of one side on a spring that has just become solid.
pub fn sprung() -> AssemblyConstants {
    let mut pair = machine(bearing(O, TANH, &matched(8.0), Guide::Tied), true);
    pair.spring = Some(PreloadSpring {
        side: -1.0,
        preload: 90.0,
        stiffness: 1e6,
        travel: -5e-6,
        stop_stiffness: 2e8,
        stop_damping: 0.5,
        mass: 0.04,
    });
    pair
}

pub fn face_nodes(count: usize) -> Vec<[f64; 2]> {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
    (0..count)
        .map(|k| [angle(k).cos(), angle(k).sin()])
        .collect()
}

/// Every arrangement, law, set of nodes and guide, each several times.
pub fn every_kind() -> Vec<AssemblyConstants> {
    let sets = [middle(), matched(8.0), legendre(5), legendre(3)];
    let mut all = Vec::new();
    for (i, signs) in [O, X, T, SINGLE].into_iter().enumerate() {
        for (j, law) in [TANH, FOUR, ALGEBRAIC].into_iter().enumerate() {
            let guides = [Guide::Outer, Guide::Inner, Guide::Balls];
            let guide = guides[(i + j) % 3];
            let mut one = bearing(signs, law, &sets[(i + 2 * j) % 4], guide);
            if j == 1 {
                one.rows.iter_mut().for_each(|row| row.moment = greased());
            }
            all.push(one);
        }
    }
    all
}

/// A state with speeds of every kind: bodies some µm and mrad off their places, balls pressed into both races and into pockets.
pub fn random_state(machine: &AssemblyConstants, random: &mut Random, moving: f64) -> Vec<f64> {
    let mut state = vec![0.0; machine.states()];
    for body in 0..3 + machine.rows.len() {
        let at = machine.body(body);
        let place = random.vector(if body == 0 { 2e-5 } else { 1e-5 });
        let velocity = random.vector(0.05 * moving);
        let tilt = random.vector(1e-3);
        let spin = random.vector(5.0 * moving);
        let turn = 0.4 * random.next();
        let speed = [900.0, 600.0, 3.0, 300.0, 300.0][body] * moving;
        let row = if body >= 3 {
            row_place(machine, body - 3)
        } else {
            0.0
        };
        state[at..at + 3].copy_from_slice(&[place.x, place.y, place.z + row]);
        state[at + 3..at + 6].copy_from_slice(&[velocity.x, velocity.y, velocity.z]);
        let about = if body == 1 || body == 0 {
            turn
        } else {
            0.003 * turn
        };
        let length = 1.0 + 1e-3 * random.next();
        let q = [(0.5 * about).cos(), tilt.x, tilt.y, (0.5 * about).sin()];
        for (k, part) in q.iter().enumerate() {
            state[at + 6 + k] = length * part;
        }
        state[at + 10..at + 13].copy_from_slice(&[spin.x, spin.y, spin.z + speed]);
    }
    if !machine.outer.turns {
        let at = machine.body(2);
        state[at + 6..at + 13].copy_from_slice(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        for row in 0..machine.rows.len() {
            let outer: Vec<f64> = state[at..at + 6].to_vec();
            let cage = machine.body(3 + row);
            state[cage..cage + 6].copy_from_slice(&outer);
        }
    }
    for (index, row) in machine.rows.iter().enumerate() {
        let first = machine.first_ball_state(index);
        let (inner, outer) = (row.ball.inner, row.ball.outer);
        let radius = 0.5 * (inner.centre_radius + outer.centre_radius);
        let place = 0.5 * (inner.place + outer.place);
        for j in 0..row.balls {
            let spin = random.vector(100.0 * moving);
            let azimuth = std::f64::consts::TAU * j as f64 / row.balls as f64;
            let values = [
                radius + 3e-6 * random.next(),
                0.05 * random.next() * moving,
                azimuth + 9e-3 * random.next(),
                (250.0 + 5.0 * random.next()) * moving,
                place + 3e-6 * random.next(),
                0.05 * random.next() * moving,
                spin.x,
                spin.y,
                spin.z - 1500.0 * moving,
            ];
            for (k, value) in values.into_iter().enumerate() {
                state[first + k * row.balls + j] = value;
            }
        }
    }
    if machine.spring.is_some() {
        let at = machine.first_sliding();
        state[at] = 3e-6 * random.next();
        state[at + 1] = 0.05 * moving * random.next();
    }
    state
}

fn row_place(machine: &AssemblyConstants, row: usize) -> f64 {
    let ball = machine.rows[row].ball;
    0.5 * (ball.inner.place + ball.outer.place)
}

/// Index of a value of a ball in a state.
pub fn ball_state(machine: &AssemblyConstants, row: usize, ball: usize, value: usize) -> usize {
    assert!(value < BALL_STATES);
    machine.first_ball_state(row) + value * machine.rows[row].balls + ball
}
