//! The slow state of a lubricant: a grease that builds up and breaks down, and contact films that warm.
//!
//! ```text
//!   turning share    T = ω²/(ω² + ω_q²)          ω cage speed against the outer ring, ω_q = 1 rad/s
//!   build-up         ḃ = T |ω| (1 - b)/φ_b - (1 - T) b/τ_r        0..1, 1: drawn into all contacts, the level of the law
//!   breakdown        ẇ = T (1 - w)/τ_w     - (1 - T) w/τ_r        0..1, 1: worked as far as it goes
//!   film rise        C Θ̇ = P - G Θ                                P: heat of the films, W;  Θ ≥ 0, K
//!
//!   drag factor      D = [g_0 + (1 - g_0) b] · [1 - (1 - g_w) w] · e^(-k_D Θ)    > 0
//!   traction factor  F = e^(-k_T Θ)                                              0..1
//! ```
//! D multiplies the speed-dependent part of the steady friction moment ([`friction`](crate::friction)): what the flow of the
//! lubricant makes. A measured curve does not separate its parts and is multiplied as a whole. F multiplies the coefficient
//! of [`traction`](crate::traction) between balls and races. Both are positive, so what opposed a motion still does, and every
//! heat stays a heat.
//!
//! Build-up counts the angle the cage turns, since it is the passing balls that draw grease in; breakdown counts time, as
//! shear at a steady speed does. Both go back while the bearing rests, at one rate. What is between 0 and 1 stays there: at
//! b = 0 and w = 0 the rates are not negative, at 1 not positive.
//!
//! ω_q only separates a turning bearing from one at rest. 1 rad/s is small against any cage in use (10 rad/s is 99 % turning)
//! and large against the creep of a bearing that is said to rest; the time spent near it in a run-down is short against τ_r.
//!
//! | parameter | typical | where from |
//! |---|---|---|
//! | φ_b | 0.1 to 3 cage turns | of the order of what a cage needs to pass every place once |
//! | τ_w | 0.8 to 4 s | the slow transients of rig tests with greased bearings |
//! | τ_r | minutes to hours | rest; thixotropic recovery is slow |
//! | k_D | ⅔ of -d ln ν/dT: 0.02 to 0.04 1/K | M0 ~ ν^⅔ of Palmgren's law and the viscosity of oils |
//!
//! The typical values are the order of what explains measured transients, not data of a grease.
//!
//! Not modelled: places (one b, one w, one Θ for the whole bearing), churning that throws grease away for good, bleeding and
//! ageing, a yield stress at rest, breakdown that depends on the shear rate, how Θ feeds the film thickness.

use number::{Real, constants};

/// ω_q, rad/s: cage speed at which a bearing counts as half turning, half resting; see the page of this module.
pub const QUIET_SPEED: f64 = 1.0;

/// Share of turning in the motion of a bearing: 1 in use, 0 at rest.
///
/// Formula: T = ω²/(ω² + ω_q²), ω_q = 1 rad/s
///
/// - `cage_speed`: ω against the outer ring, rad/s, either sign
///
/// Source: assumed; a smooth switch, even in ω.
/// Valid: any speed.
#[inline(always)]
pub fn turning_share<R: Real>(cage_speed: R) -> R {
    let square = cage_speed.square();
    square / (square + R::splat(QUIET_SPEED * QUIET_SPEED))
}

constants! {
    /// A grease that is drawn into the contacts by turning, worked by time, and recovers at rest.
    pub struct Grease {
        /// g_0: drag of a rested grease over that of the law, above 0; below 1 where it lies beside the contacts, above 1
        /// where it is churned.
        rested_factor: R,
        /// φ_b: angle of the cage over which the build-up comes to 63 %, rad.
        build_up_angle: R,
        /// g_w: drag of a worked grease over that of the law, above 0.
        worked_factor: R,
        /// τ_w: time of turning over which the breakdown comes to 63 %, s.
        breakdown_time: R,
        /// τ_r: time at rest over which both fall to 37 %, s.
        recovery_time: R,
    }
}

impl<R: Real> Grease<R> {
    /// Rate of the build-up b, 1/s.
    ///
    /// Formula: ḃ = T |ω| (1 - b)/φ_b - (1 - T) b/τ_r
    ///
    /// - `build_up`: b, 0 to 1
    /// - `cage_speed`: ω against the outer ring, rad/s
    ///
    /// Source: first order in the angle of the cage; assumed. Structural kinetics of first order are the usual model of
    /// thixotropy: H. A. Barnes, J. Non-Newtonian Fluid Mech. 70 (1997) 1 (from memory).
    /// Valid: 0 ≤ b ≤ 1.
    #[inline(always)]
    pub fn build_up_rate(&self, build_up: R, cage_speed: R) -> R {
        let turning = turning_share(cage_speed);
        turning * cage_speed.abs() * (R::one() - build_up) / self.build_up_angle
            - (R::one() - turning) * build_up / self.recovery_time
    }

    /// Rate of the breakdown w, 1/s.
    ///
    /// Formula: ẇ = T (1 - w)/τ_w - (1 - T) w/τ_r
    ///
    /// - `breakdown`: w, 0 to 1
    /// - `cage_speed`: ω against the outer ring, rad/s
    ///
    /// Source: as [`Grease::build_up_rate`], first order in time.
    /// Valid: 0 ≤ w ≤ 1; speeds of one order, as the shear rate does not enter.
    #[inline(always)]
    pub fn breakdown_rate(&self, breakdown: R, cage_speed: R) -> R {
        let turning = turning_share(cage_speed);
        turning * (R::one() - breakdown) / self.breakdown_time
            - (R::one() - turning) * breakdown / self.recovery_time
    }

    /// Drag of this state over that of the law.
    ///
    /// Formula: [g_0 + (1 - g_0) b] · [1 - (1 - g_w) w], b and w taken between 0 and 1
    ///
    /// - `build_up`: b
    /// - `breakdown`: w
    ///
    /// Source: definition; linear in each state.
    /// Valid: positive for g_0, g_w > 0.
    #[inline(always)]
    pub fn drag_factor(&self, build_up: R, breakdown: R) -> R {
        let one = R::one();
        // stages of a step may overshoot the range by the step's error
        let within = |share: R| share.max(R::zero()).min(one);
        (self.rested_factor + (one - self.rested_factor) * within(build_up))
            * (one - (one - self.worked_factor) * within(breakdown))
    }
}

impl Grease<f64> {
    /// Build-up, and breakdown as well, of a worked grease after a time at rest.
    ///
    /// Formula: b = w = e^(-t/τ_r) from b = w = 1
    ///
    /// - `time`: at rest t, s, not negative
    ///
    /// Source: the two rates at ω = 0.
    /// Valid: t ≥ 0.
    pub fn rested(&self, time: f64) -> f64 {
        (-time / self.recovery_time).exp()
    }

    /// Build-up and breakdown after a time at one speed of the cage.
    ///
    /// Formula: x + ẋ (1 - e^(-λt))/λ, λ = ẋ(x = 0) - ẋ(x = 1), for x = b and x = w
    ///
    /// - `build_up`, `breakdown`: b and w before, 0 to 1
    /// - `cage_speed`: ω against the outer ring, rad/s
    /// - `time`: t, s, not negative
    ///
    /// Source: exact solution of the two rates, which are linear in their states while the speed stays.
    /// Valid: 0 ≤ b, w ≤ 1, one speed throughout; a recovery time may be infinite.
    pub fn after(&self, build_up: f64, breakdown: f64, cage_speed: f64, time: f64) -> (f64, f64) {
        let relaxed = |state: f64, rate: &dyn Fn(f64) -> f64| {
            let pace = rate(0.0) - rate(1.0);
            let reach = if pace > 0.0 {
                -(-pace * time).exp_m1() / pace
            } else {
                time
            };
            state + rate(state) * reach
        };
        (
            relaxed(build_up, &|b| self.build_up_rate(b, cage_speed)),
            relaxed(breakdown, &|w| self.breakdown_rate(w, cage_speed)),
        )
    }

    /// True where all parameters are positive numbers.
    ///
    /// Source: the rates and factors are defined for such alone.
    /// Valid: always.
    pub fn is_valid(&self) -> bool {
        [
            self.rested_factor,
            self.build_up_angle,
            self.worked_factor,
            self.breakdown_time,
            self.recovery_time,
        ]
        .iter()
        .all(|value| *value > 0.0 && value.is_finite())
    }
}

constants! {
    /// Contact films, and the steel skin they warm, as one node against the bulk of the bearing.
    pub struct FilmHeating {
        /// C: heat capacity of what warms with the films, J/K.
        heat_capacity: R,
        /// G: conductance from the films to the bulk of the bearing, W/K.
        conductance: R,
        /// k_D: relative fall of the drag per kelvin, 1/K, not negative.
        drag_coefficient: R,
        /// k_T: relative fall of the traction coefficient per kelvin, 1/K, not negative.
        traction_coefficient: R,
    }
}

impl<R: Real> FilmHeating<R> {
    /// Rate of the films' temperature rise above the bulk, K/s.
    ///
    /// Formula: Θ̇ = (P - G Θ)/C
    ///
    /// - `rise`: Θ, K
    /// - `power`: P, heat made in the films, W, not negative
    ///
    /// Source: heat balance of one node.
    /// Valid: changes slow against the conduction inside the films and the skin below them.
    #[inline(always)]
    pub fn rise_rate(&self, rise: R, power: R) -> R {
        (power - self.conductance * rise) / self.heat_capacity
    }

    /// Drag of warmed films over that of the law.
    ///
    /// Formula: e^(-k_D Θ)
    ///
    /// - `rise`: Θ, K
    ///
    /// Source: M0 ~ ν^⅔ (Palmgren) with ν falling exponentially near a temperature.
    /// Valid: rises over which -d ln ν/dT is nearly constant, some 20 K.
    #[inline(always)]
    pub fn drag_factor(&self, rise: R) -> R {
        (-(self.drag_coefficient * rise)).exp()
    }

    /// Traction coefficient of warmed films over that of the law.
    ///
    /// Formula: e^(-k_T Θ)
    ///
    /// - `rise`: Θ, K
    ///
    /// Source: limiting shear stress and viscosity fall with temperature; the exponential is assumed.
    /// Valid: as [`FilmHeating::drag_factor`].
    #[inline(always)]
    pub fn traction_factor(&self, rise: R) -> R {
        (-(self.traction_coefficient * rise)).exp()
    }
}

impl FilmHeating<f64> {
    /// Time over which the films come to 63 % of a rise, s.
    ///
    /// Formula: τ = C/G
    ///
    /// Source: the rate of the rise.
    /// Valid: always.
    pub fn time_constant(&self) -> f64 {
        self.heat_capacity / self.conductance
    }
    /// True where capacity and conductance are positive numbers, and nothing grows with temperature.
    ///
    /// Source: the rates and factors are defined for such alone.
    /// Valid: always.
    pub fn is_valid(&self) -> bool {
        let sizes = [self.heat_capacity, self.conductance];
        let falls = [self.drag_coefficient, self.traction_coefficient];
        sizes.iter().all(|value| *value > 0.0 && value.is_finite())
            && falls.iter().all(|value| *value >= 0.0 && value.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    const GREASE: Grease<f64> = Grease {
        rested_factor: 0.3,
        build_up_angle: 0.7 * TAU,
        worked_factor: 0.7,
        breakdown_time: 3.5,
        recovery_time: 600.0,
    };
    const FILMS: FilmHeating<f64> = FilmHeating {
        heat_capacity: 0.5,
        conductance: 0.25,
        drag_coefficient: 0.03,
        traction_coefficient: 0.01,
    };

    /// Steps of the midpoint rule, of second order.
    fn advance(mut value: f64, time: f64, rate: impl Fn(f64) -> f64) -> f64 {
        let steps = 20_000;
        let h = time / f64::from(steps);
        for _ in 0..steps {
            value += h * rate(value + 0.5 * h * rate(value));
        }
        value
    }

    #[test]
    fn one_angle_of_the_cage_builds_63_percent_whatever_its_speed() {
        for speed in [-300.0, 20.0, 62.0] {
            let time = GREASE.build_up_angle / f64::abs(speed);
            let built = advance(0.0, time, |b| GREASE.build_up_rate(b, speed));
            // 1 - 1/e; at 20 rad/s rest has a share of 1/401 in the rate
            let exact = 1.0 - (-turning_share(speed)).exp();
            assert!((built - exact).abs() < 1e-5, "{built} {exact}");
            assert!((built - 0.6321).abs() < 1e-3);
        }
    }
    #[test]
    fn breakdown_counts_time_and_rest_heals_both() {
        let worked = advance(0.0, 3.5, |w| GREASE.breakdown_rate(w, 62.0));
        // the share of rest at 62 rad/s is 2.6e-4
        assert!((worked - 0.6321).abs() < 2e-4, "{worked}");
        for rate in [Grease::build_up_rate, Grease::breakdown_rate] {
            let left = advance(1.0, 900.0, |x| rate(&GREASE, x, 0.0));
            assert!((left - GREASE.rested(900.0)).abs() < 1e-8, "{left}");
        }
        assert_eq!(GREASE.rested(0.0), 1.0);
        assert!((GREASE.rested(600.0) - (-1.0_f64).exp()).abs() < 1e-15);
    }
    #[test]
    fn states_after_a_time_are_the_integral_of_their_rates() {
        for (speed, time) in [(-62.0, 2.0), (1.0, 5.0), (0.0, 900.0), (0.3, 0.0)] {
            let (built, worked) = GREASE.after(0.2, 0.6, speed, time);
            // the midpoint rule with 20 000 steps: 1e-9 of the fastest change, 5e-4 of its time a step
            let steps = advance(0.2, time, |b| GREASE.build_up_rate(b, speed));
            assert!((built - steps).abs() < 1e-6, "{speed}: {built} {steps}");
            let steps = advance(0.6, time, |w| GREASE.breakdown_rate(w, speed));
            assert!((worked - steps).abs() < 1e-6, "{speed}: {worked} {steps}");
        }
        // a grease that never recovers stays as it is at rest
        let lasting = Grease {
            recovery_time: f64::INFINITY,
            ..GREASE
        };
        assert_eq!(lasting.after(0.2, 0.6, 0.0, 1e6), (0.2, 0.6));
    }
    #[test]
    fn half_of_it_is_turning_at_the_quiet_speed() {
        assert_eq!(turning_share(1.0), 0.5);
        assert_eq!(turning_share(0.0), 0.0);
        assert!((turning_share(-10.0) - 100.0 / 101.0).abs() < 1e-15);
    }
    #[test]
    fn the_level_of_the_law_is_built_up_and_not_worked() {
        assert!((GREASE.drag_factor(1.0, 0.0) - 1.0).abs() < 1e-15);
        assert_eq!(GREASE.drag_factor(0.0, 0.0), 0.3);
        assert!((GREASE.drag_factor(1.0, 1.0) - 0.7).abs() < 1e-15);
        assert_eq!(
            (FILMS.drag_factor(0.0), FILMS.traction_factor(0.0)),
            (1.0, 1.0)
        );
        // e^-0.3
        assert!((FILMS.drag_factor(10.0) - 0.740_818_220_681_718).abs() < 1e-14);
    }
    #[test]
    fn a_film_comes_to_power_over_conductance() {
        // 2 W over 0.25 W/K: 8 K, in 2 s to 63 %
        assert_eq!(FILMS.rise_rate(8.0, 2.0), 0.0);
        assert_eq!(FILMS.time_constant(), 2.0);
        let rise = advance(0.0, 2.0, |rise| FILMS.rise_rate(rise, 2.0));
        assert!((rise - 8.0 * (1.0 - (-1.0_f64).exp())).abs() < 1e-6);
    }
    #[test]
    fn parameters_without_meaning_are_known() {
        assert!(GREASE.is_valid() && FILMS.is_valid());
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(
                !Grease {
                    rested_factor: wrong,
                    ..GREASE
                }
                .is_valid()
            );
            assert!(
                !Grease {
                    recovery_time: wrong,
                    ..GREASE
                }
                .is_valid()
            );
            assert!(
                !FilmHeating {
                    conductance: wrong,
                    ..FILMS
                }
                .is_valid()
            );
        }
        assert!(
            !FilmHeating {
                drag_coefficient: -0.01,
                ..FILMS
            }
            .is_valid()
        );
        assert!(
            FilmHeating {
                traction_coefficient: 0.0,
                ..FILMS
            }
            .is_valid()
        );
    }

    proptest! {
        #[test]
        fn states_stay_between_0_and_1_and_factors_positive(
            speed in -2e3..2e3_f64,
            state in 0.0..1.0_f64,
            other in -0.5..1.5_f64,
            rested in 1e-3..10.0_f64,
            worked in 1e-3..10.0_f64,
            rise in 0.0..200.0_f64,
        ) {
            let grease = Grease { rested_factor: rested, worked_factor: worked, ..GREASE };
            for rate in [Grease::build_up_rate, Grease::breakdown_rate] {
                prop_assert!(rate(&grease, 0.0, speed) >= 0.0);
                prop_assert!(rate(&grease, 1.0, speed) <= 0.0);
                prop_assert_eq!(rate(&grease, state, speed), rate(&grease, state, -speed));
            }
            prop_assert!(grease.drag_factor(state, other) > 0.0);
            prop_assert!(grease.drag_factor(other, state) > 0.0);
            let films = [FILMS.drag_factor(rise), FILMS.traction_factor(rise)];
            prop_assert!(films.iter().all(|factor| *factor > 0.0 && *factor <= 1.0));
        }
    }
}
