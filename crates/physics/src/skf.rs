//! Steady friction moment after the SKF model, as the catalogues of about 2005 to 2013 print it.
//!
//! ```text
//!   M = φ_ish φ_rs M_rr + M_sl + M_seal + M_drag                     N mm; N, mm, rpm, mm²/s inside
//!   M_rr = G_rr (ν n)^0.6                  rolling: inlet of the contacts; G_rr(d_m, F_r, F_a, n)
//!   φ_ish = 1/(1 + 1.84e-9 (n d_m)^1.28 ν^0.64)                      heating by shear in the inlet
//!   φ_rs = exp(-K_rs ν n (d + D) √(K_z/(2(D - d))))                  starvation: oil not back in time
//!   M_sl = G_sl μ_sl,  μ_sl = φ_bl μ_bl + (1 - φ_bl) μ_EHL           sliding; G_sl(d_m, F_r, F_a, n)
//!   φ_bl = exp(-2.6e-8 (n ν)^1.4 d_m)                                share of boundary lubrication
//!   M_drag = V_M K_ball d_m⁵ n²  or  10 V_M K_roll B d_m⁴ n²         balls or rollers wading in an oil bath
//! ```
//! The product adds the sign of the speed and fades the whole with tanh(Ω/0.1 rad/s) towards rest.
//!
//! This page is the moment in the time loop. Which constants a bearing has, and which types are refused for want of
//! a source, stands in [`skf_constants`](crate::skf_constants).
//!
//! G_sl of a deep groove bearing steps by the factor d_m^0.115 (1.5 at d_m 36 mm) where the axial load goes to 0: the
//! source has two formulas and so has this page.
//!
//! Not modelled: clearance and misalignment, freshly greased bearings (sliding 2 to 4 times higher for the first hours
//! or days, after the source), V_M (read from a diagram of the source by the user), a moment at standstill: what starts the
//! bearing is given by [`SkfMoment::starting_moment`] and acts in no run.

use crate::moment_parts::MomentParts;
use crate::palmgren::{fading, viscosity_times_speed_mm2_s_rpm};
use crate::power::power_from_zero;
use number::Real;
use std::f64::consts::PI;

number::constants! {
    /// Load factors of a deep groove ball bearing.
    pub struct SkfDeepGroove {
        /// R1.
        r1: R,
        /// R2.
        r2: R,
        /// S1.
        s1: R,
        /// S2.
        s2: R,
        /// Static load rating C0, N: sets the contact angle under axial load.
        static_load_rating: R,
    }
}

number::constants! {
    /// Load factors of an angular contact or four-point contact ball bearing.
    pub struct SkfAngularContact {
        /// R1.
        r1: R,
        /// R2.
        r2: R,
        /// R3, of the centrifugal load.
        r3: R,
        /// S1.
        s1: R,
        /// S2.
        s2: R,
        /// S3, of the centrifugal load.
        s3: R,
    }
}

number::constants! {
    /// Load factors of a spherical roller bearing; the smaller of two branches counts.
    pub struct SkfSphericalRoller {
        /// R1, small load.
        r1: R,
        /// R2, small load.
        r2: R,
        /// R3, large load.
        r3: R,
        /// R4, large load.
        r4: R,
        /// S1, small load.
        s1: R,
        /// S2, small load.
        s2: R,
        /// S3, large load.
        s3: R,
        /// S4, large load.
        s4: R,
    }
}

/// How loads become the variables G_rr and G_sl.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SkfContacts<R> {
    /// Deep groove ball bearing.
    DeepGroove(SkfDeepGroove<R>),
    /// Angular contact (single, double row) and four-point contact ball bearing.
    AngularContact(SkfAngularContact<R>),
    /// Spherical roller bearing.
    SphericalRoller(SkfSphericalRoller<R>),
}

number::variants!(SkfContacts, "bearing type": ; DeepGroove, AngularContact, SphericalRoller);

number::constants! {
    /// Constants of the SKF moment of one bearing with its lubricant.
    pub struct SkfMoment {
        /// Load factors of the type.
        contacts: SkfContacts<R>,
        /// Mean diameter d_m = (d + D)/2, m.
        mean_diameter: R,
        /// Kinematic viscosity at the running temperature ν, m²/s.
        viscosity: R,
        /// Starvation K_rs (d + D) √(K_z/(2(D - d))), per mm²/s and rpm; 0 without starvation.
        starvation: R,
        /// Sliding friction of boundary lubrication μ_bl.
        boundary_friction: R,
        /// Sliding friction of a full film μ_EHL.
        film_friction: R,
        /// Drag in an oil bath per squared speed, N mm/rpm²; 0 without a bath.
        drag: R,
        /// Moment of both seals, N m; 0 without.
        seal_moment: R,
    }
}

/// The intermediate quantities of the model, in its own units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkfIntermediates<R> {
    /// G_rr.
    pub rolling_variable: R,
    /// M_rr before its two factors, N mm.
    pub rolling_moment: R,
    /// φ_ish.
    pub inlet_shear_factor: R,
    /// φ_rs.
    pub starvation_factor: R,
    /// G_sl.
    pub sliding_variable: R,
    /// φ_bl.
    pub boundary_share: R,
    /// μ_sl.
    pub sliding_friction: R,
    /// M_sl, N mm.
    pub sliding_moment: R,
    /// M_drag, N mm.
    pub drag_moment: R,
}

impl SkfMoment<f64> {
    /// Multiplies the moment: G_rr and G_sl go with the leading factors of the type.
    pub(crate) fn scale(&mut self, factor: f64) {
        match &mut self.contacts {
            SkfContacts::DeepGroove(c) => [&mut c.r1, &mut c.s1].map(|x| *x *= factor),
            SkfContacts::AngularContact(c) => [&mut c.r1, &mut c.s1].map(|x| *x *= factor),
            SkfContacts::SphericalRoller(c) => {
                for branch in [&mut c.r3, &mut c.s3] {
                    *branch *= factor;
                }
                [&mut c.r1, &mut c.s1].map(|x| *x *= factor)
            }
        };
        self.drag *= factor;
        self.seal_moment *= factor;
    }
}

impl<R: Real> SkfMoment<R> {
    /// The moment in its parts, N m, each with the sign of the speed.
    ///
    /// Formula: speed_dependent = (φ_ish φ_rs M_rr + M_drag) tanh(Ω/0.1 rad/s),
    /// load_dependent = (M_sl + M_seal) tanh(Ω/0.1 rad/s)
    ///
    /// - `speed`: Ω, rad/s, either sign
    /// - `radial_load`: F_r, N; 0 below 0
    /// - `axial_load`: F_a, N, either direction
    ///
    /// Source: SKF General Catalogue (edition 6000), chapter Friction, pp. 88-105.
    /// Valid: grease, oil bath, oil spot or jet; constant load of at least the recommended minimum; normal clearance.
    #[inline(always)]
    pub fn parts(&self, speed: R, radial_load: R, axial_load: R) -> MomentParts<R> {
        let model = self.intermediates(speed, radial_load, axial_load);
        let rolling = model.inlet_shear_factor * model.starvation_factor * model.rolling_moment;
        let (fading, to_n_m) = (fading(speed), R::splat(1e-3));
        MomentParts {
            speed_dependent: (rolling + model.drag_moment) * to_n_m * fading,
            load_dependent: (model.sliding_moment * to_n_m + self.seal_moment) * fading,
        }
    }

    /// Moment that has to be overcome to start the bearing, N m, without sign.
    ///
    /// Formula: M_start = G_sl μ_bl + M_seal
    ///
    /// - `radial_load`: F_r, N; 0 below 0
    /// - `axial_load`: F_a, N, either direction
    ///
    /// Source: SKF General Catalogue (edition 6000), p. 103.
    /// Valid: 20 to 30 °C. The moment over time has none of it: it fades to 0 at rest.
    #[inline(always)]
    pub fn starting_moment(&self, radial_load: R, axial_load: R) -> R {
        let model = self.intermediates(R::zero(), radial_load, axial_load);
        model.sliding_variable * self.boundary_friction * R::splat(1e-3) + self.seal_moment
    }

    /// Everything between loads and moment, in the units of the source (N mm), without sign.
    ///
    /// Formula: as on the page of this module
    ///
    /// - `speed`: Ω, rad/s, either sign
    /// - `radial_load`: F_r, N; 0 below 0
    /// - `axial_load`: F_a, N, either direction
    ///
    /// Source: SKF General Catalogue (edition 6000), chapter Friction, pp. 88-105.
    /// Valid: as [`SkfMoment::parts`].
    #[inline(always)]
    pub fn intermediates(&self, speed: R, radial_load: R, axial_load: R) -> SkfIntermediates<R> {
        let rpm = speed.abs() * R::splat(30.0 / PI);
        let diameter_mm = self.mean_diameter * R::splat(1e3);
        let product = viscosity_times_speed_mm2_s_rpm(self.viscosity, speed);
        let (rolling_variable, sliding_variable) = self.contacts.variables(
            diameter_mm,
            radial_load.max(R::zero()),
            axial_load.abs(),
            rpm,
        );
        let heating = R::splat(1.84e-9)
            * power_from_zero(rpm * diameter_mm, R::splat(1.28))
            * power_from_zero(self.viscosity * R::splat(1e6), R::splat(0.64));
        let film = power_from_zero(product, R::splat(1.4)) * diameter_mm;
        let boundary_share = (R::splat(-2.6e-8) * film).exp();
        let sliding_friction = boundary_share * self.boundary_friction
            + (R::one() - boundary_share) * self.film_friction;
        SkfIntermediates {
            rolling_variable,
            rolling_moment: rolling_variable * power_from_zero(product, R::splat(0.6)),
            inlet_shear_factor: (R::one() + heating).recip(),
            starvation_factor: (-(self.starvation * product)).exp(),
            sliding_variable,
            boundary_share,
            sliding_friction,
            sliding_moment: sliding_variable * sliding_friction,
            drag_moment: self.drag * rpm.square(),
        }
    }
}

impl<R: Real> SkfContacts<R> {
    /// G_rr and G_sl.
    #[inline(always)]
    fn variables(&self, diameter_mm: R, radial: R, axial: R, rpm: R) -> (R, R) {
        match self {
            SkfContacts::DeepGroove(own) => own.variables(diameter_mm, radial, axial),
            SkfContacts::AngularContact(own) => own.variables(diameter_mm, radial, axial, rpm),
            SkfContacts::SphericalRoller(own) => own.variables(diameter_mm, radial, axial),
        }
    }
}

/// x⁴.
#[inline(always)]
fn fourth<R: Real>(x: R) -> R {
    x.square().square()
}

impl<R: Real> SkfDeepGroove<R> {
    #[inline(always)]
    fn variables(&self, diameter_mm: R, radial: R, axial: R) -> (R, R) {
        let ratio = power_from_zero(axial / self.static_load_rating, R::splat(0.24));
        let (sine, _) = (R::splat(24.6 * PI / 180.0) * ratio).sin_cos();
        // without axial load the angle is 0 and so is what is divided by its sine
        let inverse_sine = sine.max(R::splat(1e-100)).recip();
        let rolling = self.r1
            * diameter_mm.powf(R::splat(1.96))
            * power_from_zero(radial + self.r2 * inverse_sine * axial, R::splat(0.54));
        let third = R::splat(1.0 / 3.0);
        let radial_only =
            diameter_mm.powf(R::splat(-0.26)) * power_from_zero(radial, R::splat(5.0 / 3.0));
        let load = fourth(radial) * radial
            + self.s2 * diameter_mm.powf(R::splat(1.5)) * inverse_sine * fourth(axial);
        let combined = diameter_mm.powf(R::splat(-0.145)) * power_from_zero(load, third);
        let sliding = self.s1 * R::select(axial.greater(R::zero()), combined, radial_only);
        (rolling, sliding)
    }
}

impl SkfAngularContact<f64> {
    /// Centrifugal load F_g of the balls, as the sliding part of the model counts it, N.
    ///
    /// Formula: F_g = S3 d_m⁴ n²
    ///
    /// - `mean_diameter` d_m, m; `speed` Ω, rad/s
    ///
    /// Source: SKF General Catalogue (edition 6000), chapter Friction, pp. 88-105.
    /// Valid: the contact angles of the constants.
    pub fn centrifugal_load(&self, mean_diameter: f64, speed: f64) -> f64 {
        self.s3 * fourth(mean_diameter * 1e3) * (speed * 30.0 / PI).powi(2)
    }
}

impl<R: Real> SkfAngularContact<R> {
    #[inline(always)]
    fn variables(&self, diameter_mm: R, radial: R, axial: R, rpm: R) -> (R, R) {
        let turning = fourth(diameter_mm) * rpm.square();
        let rolling = self.r1
            * diameter_mm.powf(R::splat(1.97))
            * power_from_zero(radial + self.r3 * turning + self.r2 * axial, R::splat(0.54));
        let power = R::splat(4.0 / 3.0);
        let sliding = self.s1
            * diameter_mm.powf(R::splat(0.26))
            * (power_from_zero(radial + self.s3 * turning, power)
                + self.s2 * power_from_zero(axial, power));
        (rolling, sliding)
    }
}

impl<R: Real> SkfSphericalRoller<R> {
    #[inline(always)]
    fn variables(&self, diameter_mm: R, radial: R, axial: R) -> (R, R) {
        let third = R::splat(1.0 / 3.0);
        let small = self.r1
            * diameter_mm.powf(R::splat(1.85))
            * power_from_zero(radial + self.r2 * axial, R::splat(0.54));
        let large = self.r3
            * diameter_mm.powf(R::splat(2.3))
            * power_from_zero(radial + self.r4 * axial, R::splat(0.31));
        let small_slide = self.s1
            * diameter_mm.powf(R::splat(0.25))
            * power_from_zero(fourth(radial) + self.s2 * fourth(axial), third);
        let large_slide = self.s3
            * diameter_mm.powf(R::splat(0.94))
            * power_from_zero(
                radial.square() * radial + self.s4 * axial.square() * axial,
                third,
            );
        (small.min(large), small_slide.min(large_slide))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use number::{Dual, Gather, Level, Task};
    use proptest::prelude::*;

    fn with(contacts: SkfContacts<f64>) -> SkfMoment<f64> {
        SkfMoment {
            contacts,
            mean_diameter: 36e-3,
            viscosity: 100e-6,
            starvation: 6e-8 * 72.0 * (3.1_f64 / 44.0).sqrt(),
            boundary_friction: 0.15,
            film_friction: 0.05,
            drag: 1e-7,
            seal_moment: 1e-3,
        }
    }
    /// A deep groove bearing of series 60, a single row angular contact bearing, a spherical roller bearing 222 E.
    fn bearings() -> [SkfMoment<f64>; 3] {
        [
            with(SkfContacts::DeepGroove(SkfDeepGroove {
                r1: 4.1e-7,
                r2: 1.7,
                s1: 3.73e-3,
                s2: 14.6,
                static_load_rating: 6550.0,
            })),
            with(SkfContacts::AngularContact(SkfAngularContact {
                r1: 5.03e-7,
                r2: 1.97,
                r3: 1.90e-12,
                s1: 1.30e-2,
                s2: 0.68,
                s3: 1.91e-12,
            })),
            with(SkfContacts::SphericalRoller(SkfSphericalRoller {
                r1: 1.6e-6,
                r2: 5.84,
                r3: 2.81e-6,
                r4: 5.8,
                s1: 3.62e-3,
                s2: 508.0,
                s3: 8.8e-3,
                s4: 117.0,
            })),
        ]
    }

    proptest! {
        #[test]
        fn odd_in_speed_and_never_a_source(
            speed in 1e-6..3e3_f64,
            radial in 0.0..5e3_f64,
            axial in -2e3..2e3_f64,
        ) {
            for bearing in bearings() {
                let (ahead, back) =
                    (bearing.parts(speed, radial, axial), bearing.parts(-speed, radial, axial));
                prop_assert_eq!(ahead.speed_dependent, -back.speed_dependent);
                prop_assert_eq!(ahead.load_dependent, -back.load_dependent);
                prop_assert!(ahead.speed_dependent >= 0.0 && ahead.load_dependent > 0.0);
                prop_assert_eq!(bearing.parts(speed, radial, -axial), ahead);
            }
        }
        #[test]
        fn more_radial_load_more_moment(speed in 1.0..3e3_f64, radial in 1.0..4e3_f64, axial in 0.0..1e3_f64) {
            for bearing in bearings() {
                let (less, more) = (
                    bearing.parts(speed, radial, axial).sum(),
                    bearing.parts(speed, 1.1 * radial, axial).sum(),
                );
                prop_assert!(more > less);
            }
        }
    }
    #[test]
    fn without_load_only_seals_and_bath_remain() {
        let [groove, angular, _] = bearings();
        let parts = groove.parts(100.0, 0.0, 0.0);
        assert_eq!(parts.load_dependent, 1e-3);
        let rpm = 100.0 * 30.0 / PI;
        // N mm/rpm² to N m
        assert!((parts.speed_dependent / (1e-10 * rpm * rpm) - 1.0).abs() < 1e-14);
        assert_eq!(groove.parts(0.0, 500.0, 100.0).sum(), 0.0);
        // centrifugal load: an angular contact bearing rolls and slides without any load from outside
        assert!(angular.intermediates(1e3, 0.0, 0.0).sliding_variable > 0.0);
    }
    #[test]
    fn the_source_steps_where_the_axial_load_of_a_deep_groove_bearing_begins() {
        let [groove, ..] = bearings();
        let sliding = |axial| groove.intermediates(100.0, 500.0, axial).sliding_variable;
        // d_m^(0.26 - 0.145) = 36^0.115
        let step = 36_f64.powf(0.115);
        assert!((sliding(1e-9) / sliding(0.0) / step - 1.0).abs() < 1e-12);
        assert!((step - 1.51).abs() < 0.01);
        // rolling does not step: F_a/sin(α_F) falls with F_a^0.76
        let rolling = |axial| groove.intermediates(100.0, 500.0, axial).rolling_variable;
        assert!((rolling(1e-9) / rolling(0.0) - 1.0).abs() < 1e-6);
    }
    #[test]
    fn starting_is_sliding_with_boundary_friction() {
        let [groove, ..] = bearings();
        let start = groove.starting_moment(80.0, 0.0);
        // 3.73e-3·36^-0.26·80^(5/3) = 2.18216, times 0.15 N mm, and the seals
        assert!((start - (2.182_161_2 * 0.15e-3 + 1e-3)).abs() < 1e-10);
        let slow = groove.parts(0.5, 80.0, 0.0).load_dependent;
        // φ_bl at 4.8 rpm and 100 mm²/s: 0.995
        assert!(slow < start && slow > 0.99 * start);
    }
    /// The moments of each type at as many speeds as there are lanes, as bits.
    struct SideBySide;
    impl Task for SideBySide {
        type Output = Vec<Vec<u64>>;
        #[inline(always)]
        fn run<R: Real>(self) -> Vec<Vec<u64>> {
            bearings()
                .iter()
                .map(|bearing| {
                    let wide: SkfMoment<R> = Gather::gather(&|_| bearing);
                    let moment = wide
                        .parts(
                            R::from_lanes(|lane| SPEEDS[lane]),
                            R::from_lanes(|lane| RADIAL[lane]),
                            R::from_lanes(|lane| AXIAL[lane]),
                        )
                        .sum();
                    (0..R::LANES)
                        .map(|lane| moment.lane(lane).to_bits())
                        .collect()
                })
                .collect()
        }
    }
    const SPEEDS: [f64; 8] = [-0.05, 400.0, 0.0, 3.0, -2e3, 19.0, 21.0, 1e-9];
    const RADIAL: [f64; 8] = [80.0, 0.0, 30.0, -5.0, 900.0, 1e-3, 3e3, 70.0];
    const AXIAL: [f64; 8] = [0.0, 20.0, 0.0, 40.0, -300.0, 0.0, 1e-4, 0.0];

    #[test]
    fn lanes_agree_with_the_scalar_bit_for_bit() {
        let level = Level::detect();
        for (wide, bearing) in level.run_many(SideBySide).iter().zip(bearings()) {
            assert_eq!(wide.len(), level.lanes());
            for (lane, bits) in wide.iter().enumerate() {
                let scalar = bearing.parts(SPEEDS[lane], RADIAL[lane], AXIAL[lane]).sum();
                assert_eq!(f64::from_bits(*bits), scalar);
            }
        }
    }
    #[test]
    fn duals_agree_with_differences() {
        for bearing in bearings() {
            let dual: SkfMoment<Dual<1>> = Gather::gather(&|_| &bearing);
            for speed in [0.0, 0.03, 1.0, 400.0] {
                let slope = dual
                    .parts(
                        Dual::variable(speed, 0),
                        Dual::splat(90.0),
                        Dual::splat(20.0),
                    )
                    .sum()
                    .partial[0];
                let h = 1e-6 * (1.0 + speed);
                let moment = |speed| bearing.parts(speed, 90.0, 20.0).sum();
                let difference = (moment(speed + h) - moment(speed - h)) / (2.0 * h);
                // truncation (h/0.1)², the kink of |Ω|^1.6 at rest h^0.6, and rounding 1e-16 M/h
                assert!(
                    (slope - difference).abs() < 2e-3 * slope.abs() + 1e-12,
                    "{speed}: {slope} {difference}"
                );
            }
        }
    }
}
