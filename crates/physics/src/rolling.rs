//! A bearing whose balls roll, or are known to deviate from rolling: the source paper's equations 6 to 19.
//!
//! ```text
//!          outer race (at rest)            R      radius of the inner race track
//!     ──────────────────────────           r = sR ball radius
//!        T_O ←   ( ball )   H →            Ω      speed of the inner race
//!                 ω_b ↺                    ω_c    speed of the cage, sign of Ω
//!     ──────────── T_I → ───────           ω_b    ball spin *against* Ω, absolute
//!          inner race, Ω →                 F      pocket friction, sum over the balls
//! ```
//!
//! Symbols without index are sums over the N balls. Signs: the inner race drives the balls forward with T_I, the
//! outer race holds them back with T_O, the cage pushes them forward with H, the pockets brake their spin with F.
//!
//! From the momentum of the balls along the track, N m_b R(1+s) ω̇_c = T_I - T_O + H, their spin,
//! ⅖ m_b r Σω̇_b = T_I + T_O - F, and the cage, m_c R²(1+s)² ω̇_c = -R(1+s) H - sR F, follow (6) and (7).
//! The last term of the cage is missing in the paper's (3), as its counterpart +sRF in (2); both cancel in (6), (7).
//!
//! t_I resists a positive Ω of the inner race; t_O is the moment that the bearing exerts on the outer race in the
//! direction of rotation. In a steady run both are M.
//!
//! Assumed: races concentric and fixed, contact radii those of the undeformed tracks. Not modelled: moving races
//! (the drop uses momentum itself), drag on the frame.

use number::Real;

number::constants! {
    /// Masses and radii of a set of balls with its cage.
    pub struct RollingSet {
        /// Radius R of the inner race track, m.
        inner_track_radius: R,
        /// s = r/R, ball radius over inner track radius.
        ball_ratio: R,
        /// Mass of all balls N m_b, kg.
        balls_mass: R,
        /// Mass of the cage m_c as a thin ring at the pitch circle, kg: of any other cage its [`ring_mass`].
        cage_mass: R,
    }
}

number::constants! {
    /// How a set departs from steady running.
    pub struct Acceleration {
        /// Mean over the balls of the rate of ball spin ω̇_b (against Ω positive), rad/s².
        ball_spin: R,
        /// Rate of cage speed ω̇_c, rad/s².
        cage: R,
    }
}

/// Mass of the thin ring at the pitch circle that turns as a cage does, kg: all that the rolling forms know of a cage.
///
/// Formula: m_c = I_c/(R (1+s))²
///
/// - `inertia`: moment of inertia of the cage I_c, kg m²
/// - `pitch_radius`: R (1+s), m
///
/// Source: definition; m_c enters (6) to (21) only where the cage turns.
/// Valid: positive radii.
pub fn ring_mass(inertia: f64, pitch_radius: f64) -> f64 {
    inertia / (pitch_radius * pitch_radius)
}

impl<R: Real> RollingSet<R> {
    /// 1 + s.
    #[inline(always)]
    fn centre(&self) -> R {
        R::one() + self.ball_ratio
    }
    /// 1 + 2s.
    #[inline(always)]
    fn outer(&self) -> R {
        self.centre() + self.ball_ratio
    }
    /// a = ⅖ m_b s R Σω̇_b, N.
    #[inline(always)]
    fn spin_force(&self, acceleration: Acceleration<R>) -> R {
        R::splat(0.4)
            * self.balls_mass
            * self.ball_ratio
            * self.inner_track_radius
            * acceleration.ball_spin
    }
    /// b = (N m_b + m_c) R (1+s)² ω̇_c, N.
    #[inline(always)]
    fn orbit_force(&self, acceleration: Acceleration<R>) -> R {
        (self.balls_mass + self.cage_mass)
            * self.inner_track_radius
            * self.centre().square()
            * acceleration.cage
    }

    /// Cage speed of rolling balls, rad/s.
    ///
    /// Formula: ω_c = Ω/(2(1+s))
    ///
    /// - `speed`: speed of the inner race Ω, rad/s
    ///
    /// Source: the source paper (8).
    /// Valid: rolling, outer race at rest.
    #[inline(always)]
    pub fn cage_speed(&self, speed: R) -> R {
        speed / (self.centre() + self.centre())
    }

    /// Absolute spin of rolling balls against the inner race, rad/s.
    ///
    /// Formula: ω_b = Ω/(2s)
    ///
    /// - `speed`: speed of the inner race Ω, rad/s
    ///
    /// Source: the source paper (9). The ball-spin frequency of catalogues is relative to the cage: ω_b + ω_c.
    /// Valid: rolling, outer race at rest.
    #[inline(always)]
    pub fn ball_spin(&self, speed: R) -> R {
        speed / (self.ball_ratio + self.ball_ratio)
    }

    /// The accelerations of rolling balls.
    ///
    /// Formula: ω̇_b = Ω̇/(2s), ω̇_c = Ω̇/(2(1+s))
    ///
    /// - `race_acceleration`: Ω̇, rad/s²
    ///
    /// Source: the source paper (8), (9).
    /// Valid: rolling, outer race at rest.
    #[inline(always)]
    pub fn rolling(&self, race_acceleration: R) -> Acceleration<R> {
        Acceleration {
            ball_spin: self.ball_spin(race_acceleration),
            cage: self.cage_speed(race_acceleration),
        }
    }

    /// Tangential force T_I of the inner race on the balls, forward positive, N.
    ///
    /// Formula: T_I = [a(1+s) + b + (1+2s) F]/(2(1+s)), a = ⅖ m_b s R Σω̇_b, b = (N m_b + m_c) R (1+s)² ω̇_c
    ///
    /// - `acceleration`: of ball spin and cage, rad/s²; [`RollingSet::rolling`] makes (10) of it
    /// - `pocket_friction`: F, N
    ///
    /// Source: the source paper (6); (10) when the balls roll.
    /// Valid: concentric races; slip is allowed.
    #[inline(always)]
    pub fn inner_traction(&self, acceleration: Acceleration<R>, pocket_friction: R) -> R {
        let (a, b) = (
            self.spin_force(acceleration),
            self.orbit_force(acceleration),
        );
        (a * self.centre() + b + self.outer() * pocket_friction) / (self.centre() + self.centre())
    }

    /// Tangential force T_O of the outer race on the balls, backward positive, N.
    ///
    /// Formula: T_O = [a(1+s) - b + F]/(2(1+s)), a and b as in [`RollingSet::inner_traction`]
    ///
    /// - `acceleration`: of ball spin and cage, rad/s²; [`RollingSet::rolling`] makes (11) of it
    /// - `pocket_friction`: F, N
    ///
    /// Source: the source paper (7); (11) when the balls roll.
    /// Valid: concentric races; slip is allowed.
    #[inline(always)]
    pub fn outer_traction(&self, acceleration: Acceleration<R>, pocket_friction: R) -> R {
        let (a, b) = (
            self.spin_force(acceleration),
            self.orbit_force(acceleration),
        );
        (a * self.centre() - b + pocket_friction) / (self.centre() + self.centre())
    }

    /// Force ΣH of the cage on the balls, forward positive, N: the cage is driven by its reaction.
    ///
    /// Formula: ΣH = -m_c R (1+s) ω̇_c - s F/(1+s)
    ///
    /// - `cage_acceleration`: ω̇_c, rad/s²
    /// - `pocket_friction`: F, N
    ///
    /// Source: moment balance of the cage; the source paper's (3) lacks the term of F.
    /// Valid: concentric races, no drag on the cage from its surroundings.
    #[inline(always)]
    pub fn cage_load(&self, cage_acceleration: R, pocket_friction: R) -> R {
        -(self.cage_mass * self.inner_track_radius * self.centre() * cage_acceleration)
            - self.ball_ratio * pocket_friction / self.centre()
    }

    /// Moment t_I that resists the inner race, N m.
    ///
    /// Formula: t_I = M + R T_I
    ///
    /// - `steady_moment`: M(Ω, W), N m, e.g. of [`palmgren`](crate::palmgren)
    /// - `inner_traction`: T_I, N
    ///
    /// Source: the source paper (14).
    /// Valid: concentric races.
    #[inline(always)]
    pub fn inner_moment(&self, steady_moment: R, inner_traction: R) -> R {
        steady_moment + self.inner_track_radius * inner_traction
    }

    /// Moment t_O on the outer race in the direction of rotation, N m.
    ///
    /// Formula: t_O = M + (1+2s) R T_O
    ///
    /// - `steady_moment`: M(Ω, W), N m
    /// - `outer_traction`: T_O, N
    ///
    /// Source: the source paper (15).
    /// Valid: concentric races.
    #[inline(always)]
    pub fn outer_moment(&self, steady_moment: R, outer_traction: R) -> R {
        steady_moment + self.outer() * self.inner_track_radius * outer_traction
    }

    /// Inertia of rolling balls and cage as the inner race feels it, kg m².
    ///
    /// Formula: J_I = (7/20 N m_b + ¼ m_c) R²; t_I = M + J_I Ω̇ + share·F
    ///
    /// Source: the source paper (10), (14), (19).
    /// Valid: rolling.
    #[inline(always)]
    pub fn inner_inertia(&self) -> R {
        (R::splat(0.35) * self.balls_mass + R::splat(0.25) * self.cage_mass)
            * self.inner_track_radius.square()
    }

    /// Inertia of rolling balls and cage as the outer race feels it, kg m²; it *reduces* t_O while speeding up.
    ///
    /// Formula: J_O = (1+2s)(3/20 N m_b + ¼ m_c) R²; t_O = M - J_O Ω̇ + share·F
    ///
    /// Source: the source paper (11), (15).
    /// Valid: rolling.
    #[inline(always)]
    pub fn outer_inertia(&self) -> R {
        (R::splat(0.15) * self.balls_mass + R::splat(0.25) * self.cage_mass)
            * self.outer()
            * self.inner_track_radius.square()
    }

    /// Arm of the pocket friction, m: what F adds to t_I and, by the same amount, to t_O.
    ///
    /// Formula: share = (1+2s) R/(2(1+s))
    ///
    /// Source: the source paper (10), (11), (14), (15).
    /// Valid: any accelerations; F is the sum over the balls.
    #[inline(always)]
    pub fn pocket_friction_arm(&self) -> R {
        self.outer() * self.inner_track_radius / (self.centre() + self.centre())
    }
}

/// Angular acceleration of an inner race that a rotor rubs along and whose balls roll, rad/s².
///
/// Formula: (I_I + J) Ω̇ = R_0 μ W - M, J = J_I + share·q for pocket friction F = q Ω̇
///
/// - `race_inertia`: inner race with its sleeve I_I, kg m²
/// - `set_inertia`: J, kg m²: [`RollingSet::inner_inertia`], plus [`RollingSet::pocket_friction_arm`]·q
/// - `drive_moment`: R_0 μ W, bore radius times friction coefficient times load, N m
/// - `steady_moment`: M(Ω, W), N m
///
/// Source: the source paper (18), (19).
/// Valid: rolling balls, rotor slipping in the bore.
#[inline(always)]
pub fn race_acceleration<R: Real>(
    race_inertia: R,
    set_inertia: R,
    drive_moment: R,
    steady_moment: R,
) -> R {
    (drive_moment - steady_moment) / (race_inertia + set_inertia)
}

/// Time to bring an inner race from rest to a speed under a constant drive moment, s.
///
/// Formula: t = ∫₀^Ω J dΩ/(T - M(Ω))
///
/// - `inertia`: J, race with sleeve and set, kg m²
/// - `drive_moment`: T = R_0 μ W, N m
/// - `steady_moment`: M(Ω), N m, at speeds in rad/s
/// - `knots`: ascending speeds from 0 to the end, rad/s; M may step or kink at a knot, nowhere else
///
/// Returns `None` when M reaches T first: the rotor never stops slipping.
///
/// Source: the source paper (19), separated; Gauss's rule with ten points on 32 parts between knots.
/// Valid: T - M not below 1e-6 T; relative error below 1e-10 for Palmgren's moment.
pub fn spin_up_time(
    inertia: f64,
    drive_moment: f64,
    steady_moment: impl Fn(f64) -> f64,
    knots: &[f64],
) -> Option<f64> {
    let mut time = 0.0;
    for piece in knots.windows(2) {
        let half = 0.5 * (piece[1] - piece[0]) / f64::from(PARTS);
        for part in 0..PARTS {
            let middle = piece[0] + half * f64::from(2 * part + 1);
            for (node, weight) in GAUSS_10 {
                for speed in [middle - half * node, middle + half * node] {
                    let net = drive_moment - steady_moment(speed);
                    if net.is_nan() || net <= 1e-6 * drive_moment.abs() {
                        return None;
                    }
                    time += weight * half * inertia / net;
                }
            }
        }
    }
    Some(time)
}

/// Equal parts between two knots.
const PARTS: u32 = 32;

/// Positive nodes and weights of Gauss and Legendre's rule with ten points.
const GAUSS_10: [(f64, f64); 5] = [
    (0.148_874_338_981_631_21, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_19, 0.269_266_719_309_996_36),
    (0.679_409_568_299_024_41, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_51, 0.149_451_349_150_580_59),
    (0.973_906_528_517_171_72, 0.066_671_344_308_688_14),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing_6005::rolling_set as set;
    use number::{Gather, Level, Task};

    fn near(value: f64, reference: f64) -> bool {
        (value / reference - 1.0).abs() < 1e-13 // rounding of a dozen operations
    }

    #[test]
    fn rolling_gives_the_closed_forms_10_and_11() {
        let set = set();
        let (s, r) = (set.ball_ratio, set.inner_track_radius);
        for (rate, f) in [(7200.0, 0.0), (7200.0, 0.2), (-900.0, 0.2), (0.0, 0.3)] {
            let motion = set.rolling(rate);
            let inner = (0.35 * set.balls_mass + 0.25 * set.cage_mass) * r * rate
                + (1.0 + 2.0 * s) / (2.0 * (1.0 + s)) * f;
            let outer =
                -(0.15 * set.balls_mass + 0.25 * set.cage_mass) * r * rate + f / (2.0 * (1.0 + s));
            assert!(near(set.inner_traction(motion, f), inner));
            assert!(near(set.outer_traction(motion, f), outer));
            let (inertia_in, inertia_out, arm) = (
                set.inner_inertia(),
                set.outer_inertia(),
                set.pocket_friction_arm(),
            );
            assert!(near(
                set.inner_moment(0.02, inner),
                0.02 + inertia_in * rate + arm * f
            ));
            assert!(near(
                set.outer_moment(0.02, outer),
                0.02 - inertia_out * rate + arm * f
            ));
        }
    }
    #[test]
    fn newton_and_euler_hold_for_balls_and_cage_out_of_rolling() {
        // Arbitrary accelerations, not those of rolling: the three balances of the module's page.
        let set = set();
        let (s, r) = (set.ball_ratio, set.inner_track_radius);
        let motion = Acceleration {
            ball_spin: -4000.0,
            cage: 2500.0,
        };
        let f = 0.37;
        let (inner, outer) = (set.inner_traction(motion, f), set.outer_traction(motion, f));
        let load = set.cage_load(motion.cage, f);
        let orbit = set.balls_mass * r * (1.0 + s) * motion.cage;
        let spin = 0.4 * set.balls_mass * s * r * motion.ball_spin;
        let cage = set.cage_mass * (r * (1.0 + s)).powi(2) * motion.cage;
        assert!(near(inner - outer + load, orbit));
        assert!(near(inner + outer - f, spin));
        assert!(near(-r * (1.0 + s) * load - s * r * f, cage));
    }
    #[test]
    fn angular_momentum_closes_about_the_centre() {
        // t_I - t_O = dL/dt, L = orbit + cage - spin (ω_b is against Ω), whatever the pocket friction.
        let set = set();
        let (s, r) = (set.ball_ratio, set.inner_track_radius);
        for (ball_spin, cage, f) in [(5000.0, 900.0, 0.0), (-300.0, 4000.0, 1.1)] {
            let motion = Acceleration { ball_spin, cage };
            let rate = (set.balls_mass + set.cage_mass) * (r * (1.0 + s)).powi(2) * cage
                - 0.4 * set.balls_mass * (s * r).powi(2) * ball_spin;
            let inner = set.inner_moment(0.0, set.inner_traction(motion, f));
            let outer = set.outer_moment(0.0, set.outer_traction(motion, f));
            assert!((inner - outer - rate).abs() < 1e-14);
        }
    }
    #[test]
    fn signs_of_a_spin_up() {
        let set = set();
        let motion = set.rolling(1000.0);
        assert!(set.inner_traction(motion, 0.0) > 0.0);
        assert!(set.outer_traction(motion, 0.0) < 0.0);
        assert!(set.cage_load(motion.cage, 0.0) < 0.0);
        // The outer race is at rest and does no work: ½ J_I Ω² is all the kinetic energy.
        let (s, r) = (set.ball_ratio, set.inner_track_radius);
        let (cage, spin) = (set.cage_speed(100.0), set.ball_spin(100.0));
        let energy = 0.5 * (set.balls_mass + set.cage_mass) * (r * (1.0 + s) * cage).powi(2)
            + 0.5 * 0.4 * set.balls_mass * (s * r * spin).powi(2);
        assert!(near(0.5 * set.inner_inertia() * 1e4, energy));
    }
    #[test]
    fn magnitudes_of_the_physics_page() {
        // Cage 5 g, Ω̇ 1300, 7200, 11500 rad/s²: inertia parts of t_O -1.15, -6.4, -10.2 N mm, as printed there.
        for (rate, moment) in [(1300.0, -1.15e-3), (7200.0, -6.4e-3), (11500.0, -10.2e-3)] {
            let ours = -set().outer_inertia() * rate;
            assert!((ours / moment - 1.0).abs() < 6e-3, "{ours}");
        }
    }
    #[test]
    fn spin_up_against_a_constant_and_a_linear_moment() {
        let constant = spin_up_time(2e-6, 0.05, |_| 0.01, &[0.0, 300.0, 1000.0]);
        assert!(near(constant.unwrap(), 2e-6 * 1000.0 / 0.04));
        let linear = spin_up_time(2e-6, 0.05, |speed| 4e-5 * speed, &[0.0, 1000.0]);
        assert!(near(linear.unwrap(), 2e-6 / 4e-5 * (0.05_f64 / 0.01).ln()));
        assert!(spin_up_time(2e-6, 0.05, |speed| 6e-5 * speed, &[0.0, 1000.0]).is_none());
        assert!(spin_up_time(2e-6, f64::NAN, |_| 0.0, &[0.0, 1000.0]).is_none());
    }
    #[test]
    fn friction_beyond_the_steady_moment_accelerates() {
        let j = set().inner_inertia();
        assert!(race_acceleration(3.9e-6, j, 0.02, 0.01) > 0.0);
        assert!(race_acceleration(3.9e-6, j, 0.01, 0.02) < 0.0);
        assert!(near(race_acceleration(3e-6, 1e-6, 0.03, 0.01), 5000.0));
    }
    /// Both inertias of machines whose cages differ, one machine a lane.
    struct SideBySide;
    impl Task for SideBySide {
        type Output = Vec<(f64, f64)>;
        #[inline(always)]
        fn run<R: Real>(self) -> Vec<(f64, f64)> {
            let machines = machines();
            let wide: RollingSet<R> = Gather::gather(&|lane| &machines[lane]);
            let (inner, outer) = (wide.inner_inertia(), wide.outer_inertia());
            (0..R::LANES)
                .map(|lane| (inner.lane(lane), outer.lane(lane)))
                .collect()
        }
    }
    fn machines() -> [RollingSet<f64>; 8] {
        std::array::from_fn(|lane| RollingSet {
            cage_mass: 1e-3 * lane as f64,
            ..set()
        })
    }

    #[test]
    fn lanes_agree_with_the_scalar_bit_for_bit() {
        let wide = Level::detect().run_many(SideBySide);
        for (lane, machine) in wide.into_iter().zip(machines()) {
            assert_eq!(lane, (machine.inner_inertia(), machine.outer_inertia()));
        }
    }
}
