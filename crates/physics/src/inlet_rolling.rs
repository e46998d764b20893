//! Rolling resistance of the oil that is squeezed into a contact: a couple between ball and race.
//!
//! ```text
//!            ω₁ ↻
//!           ( ball )        oil is pressed back out of the inlet: shear -F on *both* surfaces,
//!     ⇐ F ───inlet───       and the pressure that is not symmetric takes both forces back:
//!     ⇐ F ───────────       2F R_x/R₁ on one body, 2F R_x/R₂ on the other, sum 2F
//!           [ race ]
//!
//!   F  = E' R_x² (2a/R_x) [(0.77 β^(-1/3) κ^0.12 U^(-1/12) - 1.8 β^(-1/4))/(1 + M/6.6) + 1.8 β^(-1/4)] U^(3/4)
//!   U  = 2 η v/(E' R_x),  W = Q/(E' R_x²),  M = β^(1/4) κ W/U^(3/4),  κ = b/a ≤ 1,  β = (4/π) 𝓔/(1 + R_x/R_z)
//!   m  = 2 F R_x
//! ```
//! About the contact point the shear has no moment and the pressure has 2 F R_x on each body, against its rolling: a couple m on
//! the ball, -m on the race. Both turn against each other at v/R_x, so the heat is m v/R_x = 2 F v; the source's own dissipation
//! integral (its equations 26 and 37) gives the same 2 F v. What remains, a pair of forces F (R₂ - R₁)/(R₁ + R₂) along the
//! contact, does no work in pure rolling and is left out.
//!
//! Where the surfaces slide as well, v is what drags the oil in and sets F, and the couple opposes the rotation w of ball against
//! race that there is: its heat m |w| is never negative, and equal to 2 F v as long as both surfaces move alike. A starved or heated
//! inlet has less: [`InletResistance`].
//!
//! A low load and a high speed make the oil the softer partner (isoviscous, rigid), the reverse the steel: one formula for both.
//!
//! Assumed: rolling with little slip, isothermal and fully flooded but for the factors of [`InletResistance`]. Not modelled: a race narrower than the flow (the source's truncation).

use crate::film::{EntrainedContact, InletHeating, logarithms};
use crate::hertz::{PointContact, carlson_rd, carlson_rf};
use crate::sliding_contact::SlidingContact;
use number::{Real, constants};

constants! {
    /// Inlet rolling resistance of one contact in the time loop.
    pub struct InletRolling {
        /// F of the rigid, isoviscous limit at 1 m/s and 1 N, N.
        rigid_force: R,
        /// F of the elastic limit at 1 m/s and 1 N, N.
        elastic_force: R,
        /// M/6.6 at 1 m/s and 1 N.
        elasticity: R,
        /// 2 R_x, m.
        arm: R,
        /// v₀, m/s: rolling speed at which the couple has 71 % of its size.
        reference_speed: R,
    }
}

constants! {
    /// Inlet rolling resistance of one contact whose inlet may be starved and is heated by shear.
    pub struct InletResistance {
        /// Flooded and isothermal.
        rolling: InletRolling<R>,
        /// φ_T of the inlet.
        heating: InletHeating<R>,
        /// φ_s: what starvation leaves, above 0 up to 1.
        supply: R,
    }
}

constants! {
    /// Inlet rolling resistance at both races.
    pub struct ResistanceAtRaces {
        /// At the inner race.
        inner: InletResistance<R>,
        /// At the outer race.
        outer: InletResistance<R>,
    }
}

impl InletRolling<f64> {
    /// Constants of a contact.
    ///
    /// Formula: the page's at v = 1 m/s and Q = 1 N; 𝓔 = ∫ √(1 - (1 - κ²) sin²ψ) dψ, R_z by the exact ellipse
    ///
    /// - `contact`: R_x, ellipticity and E*
    /// - `hertz`: semi-axes of the same contact
    /// - `viscosity`: η of the inlet at ambient pressure, Pa s
    /// - `reference_speed`: v₀, m/s: a regularisation of the sign at rest
    ///
    /// Source: as [`InletRolling::force`].
    /// Valid: as there.
    pub fn new(
        contact: &EntrainedContact,
        hertz: &PointContact,
        viscosity: f64,
        reference_speed: f64,
    ) -> Self {
        let radius = contact.rolling_radius;
        let modulus = contact.effective_modulus();
        let ratio = 1.0 / contact.ellipticity;
        let shape = shape(ratio);
        let speed = 2.0 * viscosity / (modulus * radius);
        let load = 1.0 / (modulus * radius * radius);
        // 2a/R_x E' R_x² at 1 N
        let scale = 2.0 * hertz.semi_major_factor * radius * modulus;
        InletRolling {
            rigid_force: scale
                * 0.77
                * shape.powf(-1.0 / 3.0)
                * ratio.powf(0.12)
                * speed.powf(2.0 / 3.0),
            elastic_force: scale * 1.8 * shape.powf(-0.25) * speed.powf(0.75),
            elasticity: shape.powf(0.25) * ratio * load * speed.powf(-0.75) / 6.6,
            arm: 2.0 * radius,
            reference_speed,
        }
    }
}

/// β from κ = b/a.
///
/// With x = κ² the exact ellipse has R_x/R_z = R_D(0, x, 1)/R_D(0, 1, x), and
/// 𝓔 = R_F(0, x, 1) - (1 - x)/3 R_D(0, x, 1).
fn shape(ratio: f64) -> f64 {
    let x = ratio * ratio;
    let radii = carlson_rd(0.0, x, 1.0) / carlson_rd(0.0, 1.0, x);
    let second_kind = carlson_rf(0.0, x, 1.0) - (1.0 - x) / 3.0 * carlson_rd(0.0, x, 1.0);
    4.0 / std::f64::consts::PI * second_kind / (1.0 + radii)
}

impl<R: Real> InletRolling<R> {
    /// Hydrodynamic rolling force F ≥ 0 on each of the two surfaces, N.
    ///
    /// Formula: F of the page
    ///
    /// - `load`: Q, N
    /// - `entrainment`: v, mean of the two surface speeds seen from the contact, m/s; its sign has no effect
    ///
    /// Source: N. Biboulet, L. Houpert, Proc. IMechE J 224 (2010), part 2, equation 32 (30 and 31 its limits).
    /// Valid: point contacts, M 0.2 to 800, κ 1/60 to 1, fully flooded; about 1.5 times what was published before. Zero without load.
    #[inline(always)]
    pub fn force(&self, load: R, entrainment: R) -> R {
        let (speed, force) = logarithms(entrainment, load);
        // Q^(1/3) as Q Q^(-2/3): the logarithm is clamped, and an open contact has none
        let third = load.max(R::zero()) * (force * R::splat(-2.0 / 3.0)).exp();
        let elastic = self.elastic_force * (speed * R::splat(0.75)).exp();
        let rigid = self.rigid_force * (speed * R::splat(2.0 / 3.0)).exp();
        let elasticity = self.elasticity * (force - R::splat(0.75) * speed).exp();
        third * ((rigid - elastic) / (R::one() + elasticity) + elastic)
    }

    /// Couple on the ball about the contact, N m; the race has the opposite one.
    ///
    /// Formula: m = -2 F R_x φ R_x w/√((R_x w)² + v₀²)
    ///
    /// - `load`: Q, N
    /// - `entrainment`: v, m/s; its sign has no effect
    /// - `rotation`: w, of the ball against the race, rad/s; v/R_x in pure rolling
    /// - `factor`: φ, what starvation and heating of the inlet leave, 0 to 1
    ///
    /// Source: as [`InletRolling::force`]; the couple by statics, see the page.
    /// Valid: as there, slip small against v; odd in w, so its power m w is never positive, whatever the slip. Heat is -m w.
    #[inline(always)]
    pub fn couple(&self, load: R, entrainment: R, rotation: R, factor: R) -> R {
        let rolling = R::splat(0.5) * self.arm * rotation;
        let sign = rolling / (rolling.square() + self.reference_speed.square()).sqrt();
        -(self.arm * factor * self.force(load, entrainment) * sign)
    }
}

impl<R: Real> InletResistance<R> {
    /// Couple on the ball about the contact, N m; the race has the opposite one.
    ///
    /// Formula: [`InletRolling::couple`] with φ = φ_s φ_T(u, v, Q)
    ///
    /// - `contact`: slip u, load Q, entrainment v
    /// - `rotation`: w, of the ball against the race, rad/s
    ///
    /// Source: as [`InletRolling::couple`]; φ_T of [`InletHeating::factor`]. That both factors of the film thickness scale the
    /// force too is assumed; the SKF model's rolling moment has such factors of its own.
    /// Valid: as these.
    #[inline(always)]
    pub fn couple(&self, contact: &SlidingContact<R>, rotation: R) -> R {
        let (v, q) = (contact.entrainment, contact.load);
        let factor = self.supply * self.heating.factor(contact.slip, v, q);
        self.rolling.couple(q, v, rotation, factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hertz::{BallRace, Curvature, Race};
    use proptest::prelude::*;

    const MODULUS: f64 = 206e9 / 2.0 / 0.91;

    fn contact(curvature: Curvature) -> (EntrainedContact, PointContact) {
        (
            EntrainedContact::new(curvature, MODULUS).unwrap(),
            PointContact::new(curvature, MODULUS).unwrap(),
        )
    }
    fn inner_6005() -> (EntrainedContact, PointContact) {
        contact(
            BallRace {
                ball_diameter: 6.35e-3,
                pitch_diameter: 36e-3,
                groove_curvature: 0.515,
                contact_angle: 0.0,
                race: Race::Inner,
            }
            .curvature(),
        )
    }

    #[test]
    fn the_shape_lies_between_circle_and_line() {
        // the source's own limits of β: 1 and 4/π
        assert!((shape(1.0) - 1.0).abs() < 1e-14);
        assert!((shape(1e-3) / (4.0 / std::f64::consts::PI) - 1.0).abs() < 1e-4);
        let middle = shape(0.223);
        assert!(middle > 1.0 && middle < 4.0 / std::f64::consts::PI);
    }
    #[test]
    fn formula_term_by_term() {
        let (entrained, hertz) = inner_6005();
        let rolling = InletRolling::new(&entrained, &hertz, 0.03, 0.01);
        let (load, v) = (60.0, 8.0);
        let (modulus, radius) = (2.0 * MODULUS, entrained.rolling_radius);
        let u = 2.0 * 0.03 * v / (modulus * radius);
        let w = load / (modulus * radius * radius);
        let kappa = 1.0 / entrained.ellipticity;
        let beta = shape(kappa);
        let m = beta.powf(0.25) * kappa * w / u.powf(0.75);
        let rigid = 0.77 * beta.powf(-1.0 / 3.0) * kappa.powf(0.12) * u.powf(-1.0 / 12.0);
        let elastic = 1.8 * beta.powf(-0.25);
        let force = modulus
            * radius
            * radius
            * (2.0 * hertz.semi_major(load) / radius)
            * ((rigid - elastic) / (1.0 + m / 6.6) + elastic)
            * u.powf(0.75);
        assert!((rolling.force(load, v) / force - 1.0).abs() < 1e-12);
        let couple = -2.0 * force * radius * v / v.hypot(0.01) * 0.8;
        assert!((rolling.couple(load, -v, v / radius, 0.8) / couple - 1.0).abs() < 1e-12);
    }
    #[test]
    fn the_sources_dissipation_integral_is_twice_force_times_speed() {
        // Its equations (13), (26), (37) in dimensions, circle or line: power = 64 b³ p⁵/(E'³ η) ∬Θ with
        // ∬Θ = π T/((3/2)^(4/3) M^(4/3)), M^(4/3) = (128/3)^(1/3) π/λ, λ = 12 v η R²/(b³ p), T = R F/(p b³), and on a line
        // b = 4 R p/E'. Any p, R, E', η, v, F must give 2 F v; the factors of (37) are rounded nowhere.
        let (p, radius, modulus, eta, v, force) = (1.1e9_f64, 3e-3, 2.2e11, 0.05, 7.0, 0.4);
        let b = 4.0 * radius * p / modulus;
        let lambda = 12.0 * v * eta * radius * radius / (b.powi(3) * p);
        let m = ((128.0_f64 / 3.0).cbrt() * std::f64::consts::PI / lambda).powf(0.75);
        let t = radius * force / (p * b.powi(3));
        let theta = std::f64::consts::PI * t / (1.5 * m).powf(4.0 / 3.0);
        let power = 64.0 * b.powi(3) * p.powi(5) / (modulus.powi(3) * eta) * theta;
        assert!((power / (2.0 * force * v) - 1.0).abs() < 1e-12, "{power}");
        let (entrained, hertz) = inner_6005();
        let rolling = InletRolling::new(&entrained, &hertz, eta, 1e-9);
        let rotation = v / entrained.rolling_radius;
        let heat = -rolling.couple(100.0, v, rotation, 1.0) * rotation;
        assert!((heat / (2.0 * rolling.force(100.0, v) * v) - 1.0).abs() < 1e-12);
    }
    #[test]
    fn of_the_order_of_palmgrens_speed_dependent_moment() {
        // 6005, 10 balls, 100 mm²/s, 1000 rad/s: M0 = 2e-7·36³·(100·9549)^(2/3) N mm = 90 N mm. The heat of 20 contacts
        // over the speed is a part of it (drag and churning are the rest) and not more: factor 3 either way.
        let (entrained, hertz) = inner_6005();
        let rolling = InletRolling::new(&entrained, &hertz, 0.088, 1e-3);
        let entrainment = 1000.0 * (36e-3_f64.powi(2) - 6.35e-3_f64.powi(2)) / (4.0 * 36e-3);
        let moment = 20.0 * 2.0 * rolling.force(20.0, entrainment) * entrainment / 1000.0;
        assert!((0.03..0.27).contains(&moment), "{moment}");
    }
    #[test]
    fn both_regimes_are_reached() {
        let (entrained, hertz) = inner_6005();
        let rolling = InletRolling::new(&entrained, &hertz, 0.05, 1e-3);
        let exponent = |load, v: f64| {
            (rolling.force(load, 1.01 * v) / rolling.force(load, v)).ln() / 1.01_f64.ln()
        };
        // rigid U^(2/3), elastic U^(3/4); the transition is wide, M from 0.2 to 800
        assert!((exponent(1e-4, 50.0) - 2.0 / 3.0).abs() < 0.01);
        assert!((exponent(1e4, 0.1) - 0.75).abs() < 0.01);
    }
    proptest! {
        #[test]
        fn opposes_rolling_and_is_finite(
            q in -12.0..5.0_f64, v in -12.0..3.0_f64, w in -9.0..5.0_f64, factor in 0.0..1.0_f64,
        ) {
            let (entrained, hertz) = inner_6005();
            let rolling = InletRolling::new(&entrained, &hertz, 0.05, 1e-2);
            let [q, v, w] = [q, v, w].map(|exponent| 10_f64.powf(exponent));
            let couple = rolling.couple(q, v, w, factor);
            prop_assert!(couple.is_finite() && couple <= 0.0);
            prop_assert_eq!(couple, -rolling.couple(q, v, -w, factor));
            prop_assert_eq!(couple, rolling.couple(q, -v, w, factor));
            prop_assert_eq!(rolling.couple(q, v, 0.0, factor), 0.0);
            prop_assert_eq!(rolling.couple(0.0, v, w, factor), 0.0);
            prop_assert_eq!(rolling.couple(-q, v, w, factor), 0.0);
            // the force decides, which rises from none with the load: no jump where a contact opens
            let most = 2.0 * entrained.rolling_radius * rolling.force(q, v);
            prop_assert!(couple.abs() <= most * (1.0 + 1e-12));
        }
    }
}
