//! Steady friction moment after the SKF model of 2003 to 2013.
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
//! a source, stands in `skf_constants`.
//!
//! G_sl of a deep groove bearing steps by the factor d_m^0.115 (1.5 at d_m 36 mm) where the axial load goes to 0: the
//! source has two formulas and so has this page.
//!
//! Not modelled: starting torque, clearance and misalignment, freshly greased bearings, hybrid balls, V_M (read from a
//! diagram of the source by the user).

use crate::friction::MomentParts;
use crate::palmgren::{fading, viscosity_times_speed_mm2_s_rpm};
use crate::power::power_from_zero;
use number::{Gather, Real};
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

impl<R: Real> Gather<R> for SkfContacts<f64> {
    type Out = SkfContacts<R>;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> SkfContacts<R>
    where
        Self: 'a,
    {
        macro_rules! variant {
            ($Variant:ident) => {
                SkfContacts::$Variant(Gather::<R>::gather(&|lane| match machine(lane) {
                    SkfContacts::$Variant(contacts) => contacts,
                    _ => panic!("lanes share the bearing type"),
                }))
            };
        }
        match machine(0) {
            SkfContacts::DeepGroove(_) => variant!(DeepGroove),
            SkfContacts::AngularContact(_) => variant!(AngularContact),
            SkfContacts::SphericalRoller(_) => variant!(SphericalRoller),
        }
    }
}

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
    /// Source: SKF General Catalogue (2005 edition), chapter Friction, pp. 88-105.
    /// Valid: steady running at ν 2 to 500 mm²/s (from memory), at least the minimum load, normal clearance.
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

    /// Everything between loads and moment, in the units of the source (N mm), without sign.
    ///
    /// Formula: as on the page of this module
    ///
    /// - `speed`: Ω, rad/s, either sign
    /// - `radial_load`: F_r, N; 0 below 0
    /// - `axial_load`: F_a, N, either direction
    ///
    /// Source: SKF General Catalogue (2005 edition), chapter Friction, pp. 88-105.
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
