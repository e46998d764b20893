//! Machines and states in the files of bearings in space.

use crate::json::{array, count, number, numbers, positive};
use model::contact::JournalContact;
use model::spatial::SpatialLevitation;
use model::spatial::ball::{BALL_STATES, BallState, Turned};
use model::spatial::face::Face;
use model::spatial::frame::Quaternion;
use model::spatial::mount::SpatialMount;
use model::spatial::pocket::SpatialPocket;
use model::spatial::race::RaceGroove;
use model::spatial::rigid_body::{BODY_STATES, Inertia};
use model::spatial::{
    AssemblyConstants, CageConstants, CageGuide, Frame, InnerRing, LandingConstants, OuterRing,
    RowConstants, SpatialBall, SpatialLand, SpatialRotor,
};
use number::Vec3;
use physics::contact_nodes::ContactNode;
use physics::groove::contact_surface_radius;
use physics::traction::{AlgebraicTraction, FourParameterTraction, TanhTraction, Traction};
use serde_json::Value;

/// Most rows, and balls of a row, of a file: far beyond any bearing.
pub(super) const MOST: usize = 1000;

/// The parameters of a file.
pub(super) struct Params<'a>(pub &'a Value);

impl Params<'_> {
    fn number(&self, key: &str) -> Result<f64, String> {
        number(self.0, key)
    }
    fn positive(&self, key: &str) -> Result<f64, String> {
        positive(self.0, key)
    }
    fn is(&self, key: &str) -> Result<bool, String> {
        match self.number(key)? {
            0.0 => Ok(false),
            1.0 => Ok(true),
            other => Err(format!("{key} is {other}, neither 0 nor 1")),
        }
    }
    fn list(&self, key: &str) -> Result<Vec<f64>, String> {
        let values = numbers(self.0, key)?;
        match values.is_empty() {
            false => Ok(values),
            true => Err(format!("{key} is empty")),
        }
    }
    fn vector(&self, key: &str) -> Result<Vec3<f64>, String> {
        let [x, y, z] = array(self.0, key)?;
        Ok(Vec3::new(x, y, z))
    }
    fn inertia(&self, [mass, axial, transverse]: [&str; 3]) -> Result<Inertia<f64>, String> {
        Ok(Inertia {
            mass: self.positive(mass)?,
            axial: self.positive(axial)?,
            transverse: self.positive(transverse)?,
        })
    }
    /// The axes of the bearing.
    pub fn frame(&self) -> Result<Frame, String> {
        let axis = self.vector("A")?;
        if (axis.length_squared() - 1.0).abs() > 1e-9 {
            return Err("A is no unit vector".to_string());
        }
        Ok(Frame::along(axis))
    }

    /// The machine, in the bearing's frame.
    pub fn constants(&self) -> Result<AssemblyConstants, String> {
        let frame = self.frame()?;
        let vector = |key: &str| Ok::<_, String>(frame.inward(self.vector(key)?));
        let gravity = vector("g")?;
        let rows: Result<_, _> = (0..count(self.0, "nr", MOST)?)
            .map(|row| self.row(row, gravity))
            .collect();
        let (turns, tied) = (self.is("o_rot")?, self.is("tied")?);
        if turns && tied {
            return Err("tied cages need an outer ring that does not turn: o_rot is 1".to_string());
        }
        Ok(AssemblyConstants {
            gravity,
            inner: InnerRing {
                inertia: self.inertia(["m_i", "Ii_a", "Ii_t"])?,
                held: self.is("fix_i")?,
                torque: self.number("tau_i")?,
                force: vector("Fext")?,
                moment: vector("Mext")?,
                settling: self.number("ci")?,
                tilt_settling: self.number("cit")?,
            },
            outer: OuterRing {
                inertia: self.inertia(["m_o", "Io_a", "Io_t"])?,
                turns,
                mount: SpatialMount {
                    radial_stiffness: self.number("ks")?,
                    axial_stiffness: self.number("kz")?,
                    radial_damping: self.number("cs")?,
                    axial_damping: self.number("cz")?,
                    tilt_stiffness: self.number("kt")?,
                    turn_damping: self.number("ct")?,
                    torsion_stiffness: self.number("kphi")?,
                    free_position: vector("xs")?,
                },
            },
            rows: rows?,
            spring: None,
            rotor: if self.is("rotor")? {
                Some(self.rotor()?)
            } else {
                None
            },
        })
    }

    fn row(&self, row: usize, gravity: Vec3<f64>) -> Result<RowConstants, String> {
        let place = |key: &str| {
            let places = self.list(key)?;
            let place = places.get(row).copied();
            place.ok_or_else(|| format!("{key} has no place of row {row}"))
        };
        let radius = self.positive("r")?;
        let groove = |[centre, groove, place_key, stiffness, axis]: [&str; 5]| {
            let groove = self.positive(groove)?;
            Ok::<_, String>(RaceGroove {
                centre_radius: self.positive(centre)?,
                place: place(place_key)?,
                slack: groove - radius,
                stiffness: self.positive(stiffness)?,
                half_axis: self.number(axis)?,
                half_curvature: 0.5 / contact_surface_radius(radius, groove),
            })
        };
        let (places, weights) = (self.list("xi")?, self.list("wt")?);
        if places.len() != weights.len() {
            return Err("xi and wt are not of one length".to_string());
        }
        let nodes = places.iter().zip(&weights);
        let land = if self.is("tied")? {
            0.0
        } else {
            self.number("land")?
        };
        let guide = match land {
            0.0 if self.is("tied")? => CageGuide::Tied,
            0.0 => CageGuide::Balls,
            1.0 => CageGuide::OuterLand(self.land(0.5 * (place("zgi")? + place("zgo")?))?),
            2.0 => CageGuide::InnerLand(self.land(0.0)?),
            other => return Err(format!("land is {other}, not 0, 1 or 2")),
        };
        Ok(RowConstants {
            balls: count(self.0, "N", MOST)?,
            ball: SpatialBall {
                inner_growth: 0.0,
                radius,
                mass: self.positive("m_b")?,
                inner: groove(["Rgi", "rgi", "zgi", "Ki", "cai"])?,
                outer: groove(["Rgo", "rgo", "zgo", "Ko", "cao"])?,
                damping_time: self.number("beta")?,
                orbit_drag: self.number("cd")?,
                spin_drag: self.number("cw")?,
                gravity,
                pocket: SpatialPocket {
                    circle: self.positive("Rp")?,
                    gap: self.number("gp")?,
                    stiffness: self.number("kp")?,
                    damping: self.number("ap")?,
                    friction: self.number("mu_c")?,
                    inverse_reference_speed: 1.0 / self.positive("u0c")?,
                },
            },
            nodes: nodes
                .map(|(place, weight)| ContactNode {
                    place: *place,
                    weight: *weight,
                })
                .collect(),
            traction: self.traction()?,
            moment: None,
            cage: CageConstants {
                inertia: self.inertia(["m_c", "Ic_a", "Ic_t"])?,
                drag: self.number("cc")?,
                guide,
            },
        })
    }
    fn traction(&self) -> Result<Traction<f64>, String> {
        Ok(match self.number("tr_kind")? {
            0.0 => Traction::Tanh(TanhTraction {
                maximum: self.number("mu_max")?,
                inverse_reference_speed: 1.0 / self.positive("u0")?,
            }),
            1.0 => Traction::FourParameter(FourParameterTraction {
                a: self.number("trA")?,
                b: self.number("trB")?,
                c: self.number("trC")?,
                d: self.number("trD")?,
            }),
            2.0 => Traction::Algebraic(AlgebraicTraction {
                maximum: self.number("mu_max")?,
                reference_speed: self.positive("u0")?,
            }),
            other => return Err(format!("traction law {other} is not known")),
        })
    }
    fn land(&self, middle: f64) -> Result<SpatialLand<f64>, String> {
        Ok(SpatialLand {
            contact: self.journal(["cl", "Rl", "kl", "al", "mul", "u0l"], [2.0, 1.0])?,
            middle,
            half_width: self.number("hl")?,
        })
    }
    /// A journal in a bore that shares its stiffness among stations.
    fn journal(
        &self,
        [clearance, bore, stiffness, damping, friction, speed]: [&str; 6],
        [stations, exponent]: [f64; 2],
    ) -> Result<JournalContact<f64>, String> {
        Ok(JournalContact {
            radial_clearance: self.number(clearance)?,
            bore_radius: self.positive(bore)?,
            stiffness: self.number(stiffness)? / stations,
            exponent,
            damping: self.number(damping)?,
            friction: self.number(friction)?,
            inverse_reference_speed: 1.0 / self.positive(speed)?,
        })
    }
    fn rotor(&self) -> Result<SpatialRotor, String> {
        let stations = self.list("sb")?;
        let face = |side: f64| {
            Ok::<_, String>(Face {
                side,
                shoulder: self.number("s_sh")?,
                place: self.number("s_f")?,
                radius: self.number("r_f")?,
                stiffness: self.number("kf")?,
                damping: self.number("af")?,
                friction: self.number("muf")?,
                inverse_reference_speed: 1.0 / self.positive("u0f")?,
            })
        };
        let levitation = SpatialLevitation {
            stiffness: self.number("ka")?,
            damping: self.number("ca")?,
            axial_stiffness: self.number("kaz")?,
            axial_damping: self.number("caz")?,
            carries: self.number("ka")? != 0.0 || self.number("ca")? != 0.0,
            carries_axially: self.number("kaz")? != 0.0 || self.number("caz")? != 0.0,
        };
        let shares = [stations.len() as f64, self.number("nrx")?];
        let (cosines, sines) = (self.list("cosf")?, self.list("sinf")?);
        Ok(SpatialRotor {
            inertia: self.inertia(["m_r", "Ir_a", "Ir_t"])?,
            eccentricity: self.number("e_u")?,
            landing: LandingConstants {
                contact: self.journal(["c0", "R0", "kr", "ar", "mur", "u0r"], shares)?,
                stations,
                faces: match self.number("face")? {
                    0.0 => Vec::new(),
                    side @ (1.0 | -1.0) => vec![face(side)?],
                    other => return Err(format!("face is {other}, not -1, 0 or 1")),
                },
                face_nodes: cosines.iter().zip(&sines).map(|(c, s)| [*c, *s]).collect(),
            },
            levitation: if levitation.carries || levitation.carries_axially {
                Some((levitation, self.list("sa")?))
            } else {
                None
            },
        })
    }
}

fn triple(list: &[f64]) -> Vec3<f64> {
    Vec3::new(list[0], list[1], list[2])
}
fn put(list: &mut [f64], value: Vec3<f64>) {
    (list[0], list[1], list[2]) = (value.x, value.y, value.z);
}

/// Turns the vectors and orientations of bodies.
fn turn_bodies(
    bodies: &mut [f64],
    vector: impl Fn(Vec3<f64>) -> Vec3<f64>,
    orientation: impl Fn(Quaternion) -> Quaternion,
) {
    for body in bodies.chunks_exact_mut(BODY_STATES) {
        for first in [0, 3, 10] {
            let turned = vector(triple(&body[first..]));
            put(&mut body[first..], turned);
        }
        let (scalar, along) = orientation((body[6], triple(&body[7..])));
        body[6] = scalar;
        put(&mut body[7..], along);
    }
}

/// A state of a file as the assembly has it.
pub(super) fn inward(machine: &AssemblyConstants, frame: &Frame, y: &[f64]) -> Vec<f64> {
    let mut state = y.to_vec();
    let bodies = machine.first_ball_state(0);
    let own = &mut state[..bodies];
    turn_bodies(own, |v| frame.inward(v), |q| frame.orientation_inward(q));
    let mut balls = y[bodies..].chunks_exact(BALL_STATES);
    for (index, row) in machine.rows.iter().enumerate() {
        let first = machine.first_ball_state(index);
        for (j, ball) in balls.by_ref().take(row.balls).enumerate() {
            let [x, v, w] = [0, 3, 6].map(|k| frame.inward(triple(&ball[k..])));
            let (radius, azimuth) = (x.x.hypot(x.y), x.y.atan2(x.x));
            let turned = Turned::to(azimuth);
            let (speed, spin) = (turned.to_cylinder(v), turned.to_cylinder(w));
            let values = BallState {
                radius,
                radial_speed: speed.x,
                azimuth,
                orbit_speed: speed.y / radius,
                axial: x.z,
                axial_speed: v.z,
                spin,
            };
            for (k, value) in values.to_array().into_iter().enumerate() {
                state[first + k * row.balls + j] = value;
            }
        }
    }
    state
}

/// A state, or its rates, as the file has it: bodies turned, and of each ball three vectors in its cylinder.
fn outward(
    machine: &AssemblyConstants,
    frame: &Frame,
    (state, values): (&[f64], &[f64]),
    ball: impl Fn(&BallState<f64>, &BallState<f64>) -> [Vec3<f64>; 3],
) -> Vec<f64> {
    let mut list = values.to_vec();
    let bodies = machine.first_ball_state(0);
    let own = &mut list[..bodies];
    turn_bodies(own, |v| frame.outward(v), |q| frame.orientation_outward(q));
    let mut balls = list[bodies..].chunks_exact_mut(BALL_STATES);
    for (index, row) in machine.rows.iter().enumerate() {
        let first = machine.first_ball_state(index);
        for (j, own) in balls.by_ref().take(row.balls).enumerate() {
            let of = |list: &[f64]| {
                BallState::from_array(std::array::from_fn(|k| list[first + k * row.balls + j]))
            };
            let at = of(state);
            let turned = Turned::to(at.azimuth);
            for (k, v) in ball(&at, &of(values)).into_iter().enumerate() {
                put(&mut own[3 * k..], frame.outward(turned.to_frame(v)));
            }
        }
    }
    list
}

/// A state as the file has it, of one in the assembly's own.
pub(super) fn state_outward(machine: &AssemblyConstants, frame: &Frame, state: &[f64]) -> Vec<f64> {
    outward(machine, frame, (state, state), |at, _| {
        let velocity = Vec3::new(at.radial_speed, at.radius * at.orbit_speed, at.axial_speed);
        [Vec3::new(at.radius, 0.0, at.axial), velocity, at.spin]
    })
}

/// Rates as the file has them, of a state in the assembly's own.
pub(super) fn rates_outward(
    machine: &AssemblyConstants,
    frame: &Frame,
    state: &[f64],
    rate: &[f64],
) -> Vec<f64> {
    outward(machine, frame, (state, rate), |at, change| {
        let (turn, radius) = (at.orbit_speed, at.radius);
        let velocity = Vec3::new(at.radial_speed, radius * turn, at.axial_speed);
        let acceleration = Vec3::new(
            change.radial_speed - radius * turn * turn,
            radius * change.orbit_speed + 2.0 * at.radial_speed * turn,
            change.axial_speed,
        );
        let spin = Vec3::new(
            change.spin.x - turn * at.spin.y,
            change.spin.y + turn * at.spin.x,
            change.spin.z,
        );
        [velocity, acceleration, spin]
    })
}

/// Classes of the states: name, unit, unit of the rates.
const CLASSES: [[&str; 3]; 8] = [
    ["body_positions", "m", "m/s"],
    ["body_velocities", "m/s", "m/s^2"],
    ["orientations", "", "1/s"],
    ["body_spins", "rad/s", "rad/s^2"],
    ["ball_positions", "m", "m/s"],
    ["ball_velocities", "m/s", "m/s^2"],
    ["ball_spins", "rad/s", "rad/s^2"],
    ["energy_accounts", "J", "W"],
];

/// The class of a state of the files, an index of [`CLASSES`].
fn class(machine: &AssemblyConstants, state: usize) -> usize {
    let balls = machine.first_ball_state(0);
    if state >= machine.first_account() {
        return 7;
    }
    if state >= balls {
        return 4 + (state - balls) % BALL_STATES / 3;
    }
    match state % BODY_STATES {
        0..3 => 0,
        3..6 => 1,
        6..10 => 2,
        _ => 3,
    }
}

/// Of every state its index, its class, and the size of the largest value of that class.
pub(super) fn by_class(
    machine: &AssemblyConstants,
    values: &[f64],
) -> Vec<(usize, [&'static str; 3], f64)> {
    let mut largest = [0.0_f64; CLASSES.len()];
    for (k, value) in values.iter().enumerate() {
        let own = &mut largest[class(machine, k)];
        *own = own.max(value.abs());
    }
    let of = |k| {
        let class = class(machine, k);
        (k, CLASSES[class], largest[class])
    };
    (0..values.len()).map(of).collect()
}
