//! A rotor that bends, in modal coordinates; a rigid point with spin is the smallest.
//!
//! ```text
//!   w_b = φ_b·η                       node b, w = x + jy; φ_b is a row of real numbers: the shaft is round
//!   N = M⁻¹ Σ u_k e^{j(φ+δ_k)} φ_k     what the unbalances add to the axis;    η_G = η + N is the state
//!
//!        G  mass centre           C = G - φ_b·N  geometric centre at node b: contacts and magnets act here
//!
//!   M η̈_G = f - Ω̇ p,   p = -½ jGη
//!   f = (jΩGη̇ - D_e η̇ - Kη) - D_i ξ + W g + Σ φ_b F_b,   ξ = η̇ - jΩη           the bracket: s
//!   Ω̇ [I_G - 2 Im(Nᴴp) - pᴴM⁻¹p] = τ + Σ moments about G - Im(Nᴴs) + Im(η_Gᴴ D_i ξ) - Re pᴴ(M⁻¹f + Ω²N)
//! ```
//! States: η_G in x and in y (m; of coordinates made orthonormal m √kg), their rates, angle φ (rad), spin Ω (rad/s).
//! W = ΦᵀM1 is what gravity acts on. The masses that stand for the unbalances are part of the rotor; their moment of inertia
//! NᴴMN is not part of I_G. Gravity on the unbalance is in W g and has no moment about G.
//!
//! The kinetic energy ½ η̇_GᴴMη̇_G + ½ Ω Im(η̇ᴴGη) + ½ I_G Ω² is that of a round rotor whose spin is one angle φ: the second
//! term makes both jΩGη̇ and p. Derived; checked against an independent implementation.
//!
//! Where bearings in space carry it, it moves along its axis too: [`in_space`].
//!
//! Assumes: one real shape for both planes, small tilt, M and K diagonal in the coordinates. Does not model: torsion, stress stiffening, shafts that are not round.

pub mod constants;
pub mod in_space;
pub mod motion;
pub mod shaft;

pub use constants::{Coordinate, RotorConstants, TorqueTables, Unbalance};
pub use in_space::{AxialConstants, SpatialNode};
pub use motion::{GeometricCentre, Node, RotorAt, RotorMotion};

use crate::table::Lines;
use motion::products;
use number::{Gather, Real, Vec2};
use shaft::{Shaft, ShaftReaction};
use thermal::warm_machine::BRAKE_FADE;

/// A rotor over `R`.
#[derive(Clone, Debug)]
pub struct Rotor<R: Real> {
    /// Modal masses, kg.
    pub(crate) mass: Vec<R>,
    /// Reciprocals, because a division costs as much as ten products.
    inverse_mass: Vec<R>,
    /// Stiffnesses m ω², N/m.
    pub(crate) stiffness: Vec<R>,
    /// Diagonal of D_e + D_i, N s/m.
    pub(crate) damping: Vec<R>,
    weight: Vec<R>,
    /// W/m: acceleration by gravity.
    fall: Vec<R>,
    /// N at φ = 0, x then y.
    unbalance: [Vec<R>; 2],
    /// What is elastic, turns or damps in it; none of a point.
    shaft: Option<Shaft<R>>,
    /// I_G, kg m².
    pub(crate) polar_inertia: R,
    inverse_polar_inertia: R,
    drive: [R; 2],
    drag: [R; 2],
    /// Torque over speed, its share over time.
    torque: Option<[Lines<R>; 2]>,
    brake_torque: R,
    /// True where a drive holds the spin whatever it takes.
    pub(crate) spin_held: bool,
}

/// Moments about the axis that act on the rotor from outside, besides those at its nodes, N m.
#[derive(Clone, Copy, Debug)]
pub struct Torques<R> {
    /// Drive, brake, and what holds the spin.
    pub driving: R,
    /// Drag, against the spin.
    pub drag: R,
}

impl<R: Real> Rotor<R> {
    /// One rotor per lane.
    ///
    /// # Panics
    /// When rotors differ in which of their matrices there are.
    pub fn gather<'a>(constants: &dyn Fn(usize) -> &'a RotorConstants) -> Self {
        let lanes = |of: &dyn Fn(&RotorConstants) -> f64| R::from_lanes(|lane| of(constants(lane)));
        let count = constants(0).coordinates.len();
        let each = |of: &dyn Fn(&Coordinate) -> f64| -> Vec<R> {
            let own = |k: usize| lanes(&|rotor| of(&rotor.coordinates[k]));
            (0..count).map(own).collect()
        };
        let unbalance = [each(&|own| own.unbalance.x), each(&|own| own.unbalance.y)];
        let diagonal =
            |matrix: &[f64], k: usize| matrix.get(k * (count + 1)).copied().unwrap_or(0.0);
        let damping = (0..count).map(|k| {
            lanes(&|rotor| diagonal(&rotor.damping, k) + diagonal(&rotor.damping_rotating, k))
        });
        Rotor {
            mass: each(&|own| own.mass),
            inverse_mass: each(&|own| 1.0 / own.mass),
            stiffness: each(&|own| own.mass * own.frequency * own.frequency),
            damping: damping.collect(),
            weight: each(&|own| own.weight),
            fall: each(&|own| own.weight / own.mass),
            shaft: Shaft::gather(constants),
            unbalance,
            polar_inertia: lanes(&|rotor| rotor.polar_inertia),
            inverse_polar_inertia: lanes(&|rotor| 1.0 / rotor.polar_inertia),
            drive: [
                lanes(&|rotor| rotor.drive_torque),
                lanes(&|rotor| rotor.drive_slope),
            ],
            drag: [
                lanes(&|rotor| rotor.drag),
                lanes(&|rotor| rotor.drag_square),
            ],
            torque: Self::gather_torque(constants),
            brake_torque: lanes(&|rotor| rotor.brake_torque),
            spin_held: constants(0).spin_held,
        }
    }
    fn gather_torque<'a>(constants: &dyn Fn(usize) -> &'a RotorConstants) -> Option<[Lines<R>; 2]> {
        let there = |lane: usize| constants(lane).torque.is_some();
        let same = (0..R::LANES).all(|lane| there(lane) == there(0));
        assert!(same, "lanes share the presence of a torque over speed");
        let own = |lane: usize| constants(lane).torque.as_ref().expect("lanes share it");
        there(0).then(|| {
            [
                Gather::<R>::gather(&|lane| &own(lane).over_speed),
                Gather::<R>::gather(&|lane| &own(lane).share_over_time),
            ]
        })
    }
    /// Moment of the brake when it is on, N m.
    #[inline(always)]
    pub fn brake_moment(&self, spin: R) -> R {
        -(self.brake_torque * (spin * R::splat(1.0 / BRAKE_FADE)).tanh())
    }
    /// Moment of the torque by tables, N m: what drives acts in the positive sense, what brakes against the spin and fades out
    /// with it.
    ///
    /// Formula: τ = max(τ(|Ω|) s, 0) + min(τ(|Ω|) s, 0) tanh(Ω/Ω_f),  s = s(t)
    #[inline(always)]
    pub fn torque_by_tables(&self, time: R, spin: R) -> R {
        let Some([over_speed, share]) = &self.torque else {
            return R::zero();
        };
        let torque = over_speed.value(spin.abs()) * share.value(time);
        let fading = (spin * R::splat(1.0 / BRAKE_FADE)).tanh();
        torque.max(R::zero()) + torque.min(R::zero()) * fading
    }
    /// N, entry of a coordinate.
    #[inline(always)]
    fn offset(&self, k: usize, motion: &RotorMotion<R>) -> Vec2<R> {
        let (a, b) = (self.unbalance[0][k], self.unbalance[1][k]);
        let (s, c) = (motion.sine, motion.cosine);
        Vec2::new(a * c - b * s, a * s + b * c)
    }

    /// What bends, turns and damps in the rotor: forces on the coordinates into `force`, p into `spinning`.
    #[inline(always)]
    pub fn react(
        &self,
        motion: &RotorMotion<R>,
        force: [&mut [R]; 2],
        spinning: [&mut [R]; 2],
    ) -> ShaftReaction<R> {
        match &self.shaft {
            Some(shaft) => {
                let own = [&self.stiffness[..], &self.inverse_mass[..]];
                shaft.react(own, &self.unbalance, motion, force, spinning)
            }
            None => {
                for list in force {
                    for value in list {
                        *value = R::zero();
                    }
                }
                ShaftReaction::none()
            }
        }
    }

    /// From all forces on the coordinates to accelerations, in their place; `spinning` holds p, then the rates of the
    /// coordinates. `moment` is that about G at the nodes, `outside` that of the brake and of tables. Returns Ω̇ and the torques.
    #[inline(always)]
    pub fn accelerate(
        &self,
        motion: &RotorMotion<R>,
        gravity: Vec2<R>,
        (moment, outside): (R, R),
        shaft: &ShaftReaction<R>,
        [ax, ay]: [&mut [R]; 2],
        [px, py]: [&mut [R]; 2],
    ) -> (R, Torques<R>) {
        let n = self.mass.len();
        let (ax, ay) = (&mut ax[..n], &mut ay[..n]);
        let (px, py) = (&mut px[..n], &mut py[..n]);
        for k in 0..n {
            ax[k] = ax[k] * self.inverse_mass[k] + gravity.x * self.fall[k];
            ay[k] = ay[k] * self.inverse_mass[k] + gravity.y * self.fall[k];
        }
        let turns = self.shaft.as_ref().is_some_and(Shaft::turns);
        let mut bend = R::zero();
        if turns {
            // N = (a c - b s, a s + b c)
            let [a, b] = &self.unbalance;
            let ([px, py], [ax, ay]) = ([&*px, &*py], [&*ax, &*ay]);
            let [x, y] = [products(px, [ax, a, b]), products(py, [ay, a, b])];
            let (s, c) = (motion.sine, motion.cosine);
            let across = (x[1] * c - x[2] * s) + (y[1] * s + y[2] * c);
            bend = (x[0] + y[0]) + motion.spin.square() * across;
        }
        let drag = motion.spin * (self.drag[0] + self.drag[1] * motion.spin.abs());
        let others = moment - drag + (shaft.moment - bend);
        let (driving, spin_rate) = if self.spin_held {
            (-others, R::zero())
        } else {
            let driving = outside + (self.drive[0] - self.drive[1] * motion.spin);
            let all = others + driving;
            let rate = if turns || n == 0 {
                all / (self.polar_inertia + shaft.inertia)
            } else {
                all * self.inverse_polar_inertia
            };
            (driving, rate)
        };
        if turns {
            for k in 0..n {
                ax[k] -= spin_rate * (px[k] * self.inverse_mass[k]);
                ay[k] -= spin_rate * (py[k] * self.inverse_mass[k]);
            }
        }
        px.copy_from_slice(motion.velocity[0]);
        py.copy_from_slice(motion.velocity[1]);
        (spin_rate, Torques { driving, drag })
    }

    /// Momentum of the mass centres, kg m/s.
    #[inline(always)]
    pub fn momentum(&self, motion: &RotorMotion<R>) -> Vec2<R> {
        let [x, y] = products(&self.weight, motion.velocity);
        Vec2::new(x, y)
    }

    /// Moment of gravity about the origin, N m.
    #[inline(always)]
    pub fn weight_moment(&self, motion: &RotorMotion<R>, gravity: Vec2<R>) -> R {
        let [x, y] = products(&self.weight, motion.position);
        Vec2::new(x, y).cross(gravity)
    }
}

/// Energies and angular momentum of a rotor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorContent {
    /// Kinetic energy of the mass centres, J.
    pub translation: f64,
    /// Kinetic energy of spin, that of tilt and spin together in it, J.
    pub spin: f64,
    /// Of the flexible shaft, J.
    pub elastic: f64,
    /// Of its weight, J.
    pub weight: f64,
    /// Angular momentum about the axis through the origin, N m s.
    pub angular_momentum: f64,
}

impl Rotor<f64> {
    /// Energies and angular momentum.
    pub fn content(&self, motion: &RotorMotion<f64>, gravity: Vec2<f64>) -> RotorContent {
        let pair = |[x, y]: [&[f64]; 2], k: usize| Vec2::new(x[k], y[k]);
        let spin = motion.spin;
        let mut content = RotorContent {
            translation: 0.0,
            spin: 0.5 * self.polar_inertia * spin * spin,
            elastic: 0.0,
            weight: 0.0,
            angular_momentum: 0.0,
        };
        let count = self.mass.len();
        let axis = |k: usize| pair(motion.position, k) - self.offset(k, motion);
        let axis_rate =
            |k: usize| pair(motion.velocity, k) - self.offset(k, motion).turned() * spin;
        for k in 0..count {
            let (position, velocity) = (pair(motion.position, k), pair(motion.velocity, k));
            content.translation += 0.5 * self.mass[k] * velocity.length_squared();
            content.elastic += 0.5 * self.stiffness[k] * axis(k).length_squared();
            content.weight -= self.weight[k] * gravity.dot(position);
            content.angular_momentum += self.mass[k] * position.cross(velocity);
        }
        content.angular_momentum += self.polar_inertia * spin;
        if let Some(matrix) = self.shaft.as_ref().and_then(Shaft::gyroscopic) {
            for i in 0..count {
                let turned = (0..count).fold(Vec2::zero(), |sum: Vec2<f64>, j| {
                    sum + axis(j) * matrix[i * count + j]
                });
                let tilt = axis_rate(i).cross(turned);
                content.spin += 0.5 * spin * tilt;
                content.angular_momentum += 0.5 * tilt - 0.5 * spin * axis(i).dot(turned);
            }
        }
        content
    }
}
