//! Point contact between ball and race: Hertz's theory with exact elliptic integrals.
//!
//! ```text
//!        ball, radius D/2                 across the groove: radius f D, concave
//!      ───( )───  load Q                  along the rolling direction: the track, convex on the
//!    ══════════════ race                  inner race, concave on the outer race
//!
//!    Q = K δ^(3/2),   p_max = 3Q/(2πab),   a ∝ Q^(1/3),   b ∝ Q^(1/3)
//! ```
//!
//! The semi-axis a lies across the groove, b along the rolling direction. With Carlson's integrals and x = (b/a)²
//!
//! ```text
//!    ρ_a/ρ_b = R_D(0, x, 1) / R_D(0, 1, x)        gives x from the curvature sums
//!    a³ = Q R_D(0, x, 1) / (π E* ρ_a)
//!    δ  = 3Q R_F(0, x, 1) / (2π E* a)
//! ```
//!
//! which is Hertz's solution without the differences of nearly equal integrals of its textbook form.
//!
//! Assumed: smooth, dry, elastic half-spaces; contact small against the radii. Not modelled: plastic
//! indentation, the shoulder cutting the ellipse, tangential tractions, lubricant film.
//!
//! The law of the time loop is Q = K δ^(3/2) in [`contact`](crate::contact); here its constants are built once.

mod elliptic;
mod subsurface;

pub use elliptic::{carlson_rd, carlson_rf};

use number::Real;
use std::f64::consts::PI;
use std::fmt;

/// Sums of the principal curvatures of two touching bodies, 1/m: convex positive, concave negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvature {
    /// Sum across the groove, in the axial plane of the bearing, 1/m.
    pub axial: f64,
    /// Sum along the rolling direction, 1/m.
    pub rolling: f64,
}

/// The race that a ball touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Race {
    /// Inner race: convex along the rolling direction.
    Inner,
    /// Outer race: concave along the rolling direction.
    Outer,
}

/// Geometry of the contact between a ball and a race with a circular groove.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallRace {
    /// Ball diameter D, m.
    pub ball_diameter: f64,
    /// Pitch diameter d_m: circle of the ball centres, m.
    pub pitch_diameter: f64,
    /// Groove curvature f: groove radius over ball diameter.
    pub groove_curvature: f64,
    /// Contact angle α, rad; 0 for a radial contact.
    pub contact_angle: f64,
    /// The race.
    pub race: Race,
}

/// The curvature sums do not make a point contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotAPoint(pub Curvature);

impl fmt::Display for NotAPoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "no point contact: both curvature sums must be positive, found {} 1/m across the groove and {} 1/m along \
             the rolling direction (a groove must be wider than the ball: groove curvature above 0.5)",
            self.0.axial, self.0.rolling
        )
    }
}

impl std::error::Error for NotAPoint {}

impl BallRace {
    /// Curvature sums of a ball in the groove of a race.
    ///
    /// Formula: ρ_a = 2/D - 1/(f D), inner ρ_b = 2/D · 1/(1 - γ), outer ρ_b = 2/D · 1/(1 + γ), γ = D cos α/d_m
    ///
    /// Source: T. A. Harris, Rolling Bearing Analysis, 4th ed. 2001, section 2 (from memory); geometry.
    /// Valid: f > 0.5 and |γ| < 1; else the sums are no point contact and [`PointContact::new`] says so.
    pub fn curvature(&self) -> Curvature {
        let d = self.ball_diameter;
        let gamma = d * self.contact_angle.cos() / self.pitch_diameter;
        let side = match self.race {
            Race::Inner => 1.0 - gamma,
            Race::Outer => 1.0 + gamma,
        };
        Curvature {
            axial: (2.0 - 1.0 / self.groove_curvature) / d,
            rolling: 2.0 / d / side,
        }
    }
}

impl Curvature {
    /// Curvature sum Σρ, 1/m.
    ///
    /// Formula: Σρ = ρ_a + ρ_b
    ///
    /// Source: T. A. Harris, Rolling Bearing Analysis, 4th ed. 2001, section 2 (from memory).
    /// Valid: any two bodies.
    pub fn sum(&self) -> f64 {
        self.axial + self.rolling
    }
    /// Curvature difference F(ρ), between -1 and 1.
    ///
    /// Formula: F(ρ) = (ρ_b - ρ_a)/(ρ_b + ρ_a)
    ///
    /// Source: T. A. Harris, Rolling Bearing Analysis, 4th ed. 2001, section 2 (from memory).
    /// Valid: any two bodies; positive where the ellipse is long across the groove.
    pub fn difference(&self) -> f64 {
        (self.rolling - self.axial) / self.sum()
    }
}

/// The factors that depend on the shape of the ellipse alone: the tabulated a*, b*, δ* of bearing books.
///
/// With c = (3Q/(2 Σρ E*))^(1/3): a = a* c, b = b* c, δ = δ* c² Σρ/2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipseFactors {
    /// Ellipticity κ = a/b, long axis over short axis.
    pub ellipticity: f64,
    /// a*: long semi-axis.
    pub semi_major: f64,
    /// b*: short semi-axis.
    pub semi_minor: f64,
    /// δ*: approach.
    pub approach: f64,
}

impl EllipseFactors {
    /// Exact factors for a curvature difference.
    ///
    /// Formula: x from (1 - F)/(1 + F) = R_D(0, x, 1)/R_D(0, 1, x), then κ = x^(-1/2),
    /// a*³ = 4 R_D(0, x, 1)/(3π (1 - F)), b* = a*/κ, δ* = 2 R_F(0, x, 1)/(π a*)
    ///
    /// - `difference`: |F(ρ)|, from 0 (circle) to just below 1 (a line)
    ///
    /// Returns `None` outside 0 ≤ F < 1.
    ///
    /// Source: H. Hertz 1881; elliptic integrals after Carlson, DLMF 19.25.
    /// Valid: 1 - F down to 1e-12; relative error 1e-13 or the rounding of 1 - F, whichever is larger.
    pub fn exact(difference: f64) -> Option<Self> {
        if !(0.0..1.0).contains(&difference) {
            return None;
        }
        Some(Self::of_ratio((1.0 - difference) / (1.0 + difference)))
    }

    /// Exact factors from the ratio of the smaller to the larger curvature sum.
    fn of_ratio(ratio: f64) -> Self {
        let x = squared_axis_ratio(ratio);
        let ellipticity = 1.0 / x.sqrt();
        // (1 - F)/2 is the share of the smaller sum: ratio/(1 + ratio).
        let share = ratio / (1.0 + ratio);
        let semi_major = (2.0 * carlson_rd(0.0, x, 1.0) / (3.0 * PI * share)).cbrt();
        EllipseFactors {
            ellipticity,
            semi_major,
            semi_minor: semi_major / ellipticity,
            approach: 2.0 * carlson_rf(0.0, x, 1.0) / (PI * semi_major),
        }
    }

    /// Hamrock and Brewe's fast fit: no root, no integral.
    ///
    /// Formula: κ = 1.0339 y^0.636, F = 1.5277 + 0.6023 ln y, E = 1.0003 + 0.5968/y with y = (1 + F(ρ))/(1 - F(ρ)),
    /// a* = (2κ²E/π)^(1/3), b* = a*/κ, δ* = 2F/(π a*)
    ///
    /// - `difference`: |F(ρ)|
    ///
    /// Returns `None` outside 0 ≤ F < 1.
    ///
    /// Source: B. J. Hamrock, D. E. Brewe, Simplified solution for stresses and deformations, J. Lubr. Technol. 105,
    /// 1983 (from memory); the resulting K agrees with the column `K_hamrock_brewe` of the reference `hertz.json`.
    /// Valid: 1.25 ≤ κ ≤ 15: approach within 3 % of the exact solution, so K within 4.5 %; near a circle 5.5 % and 9 %.
    pub fn hamrock_brewe(difference: f64) -> Option<Self> {
        if !(0.0..1.0).contains(&difference) {
            return None;
        }
        let y = (1.0 + difference) / (1.0 - difference);
        let ellipticity = 1.0339 * y.powf(0.636);
        let first = 1.5277 + 0.6023 * y.ln();
        let second = 1.0003 + 0.5968 / y;
        let semi_major = (2.0 * ellipticity * ellipticity * second / PI).cbrt();
        Some(EllipseFactors {
            ellipticity,
            semi_major,
            semi_minor: semi_major / ellipticity,
            approach: 2.0 * first / (PI * semi_major),
        })
    }
}

/// x = (b/a)² for a ratio of curvature sums in (0, 1].
///
/// The ratio grows with x almost as a power, so a secant in logarithms that keeps its bracket
/// (Illinois rule) ends in about ten steps.
fn squared_axis_ratio(ratio: f64) -> f64 {
    let target = ratio.ln();
    let miss = |u: f64| {
        let x = u.exp();
        (carlson_rd(0.0, x, 1.0) / carlson_rd(0.0, 1.0, x)).ln() - target
    };
    // For small x the ratio is x (ln(4/√x) - 1), at x = 1 it is 1: x = (ratio/e)² lies below the root, 1 above it.
    let (mut low, mut high) = (2.0 * target - 2.0, 0.0);
    let (mut miss_low, mut miss_high) = (miss(low), miss(high));
    if miss_high <= 0.0 {
        return 1.0;
    }
    let mut last = low;
    for _ in 0..100 {
        let middle = high - miss_high * (high - low) / (miss_high - miss_low);
        let step = middle - last;
        last = middle;
        let miss_middle = miss(middle);
        if miss_middle == 0.0 || step.abs() < 1e-15 * (1.0 + middle.abs()) {
            break;
        }
        if miss_middle > 0.0 {
            (high, miss_high) = (middle, miss_middle);
            miss_low *= 0.5;
        } else {
            (low, miss_low) = (middle, miss_middle);
            miss_high *= 0.5;
        }
    }
    last.exp()
}

/// Constants of one point contact: everything grows with a fixed power of the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointContact {
    /// K of Q = K δ^(3/2), N/m^(3/2).
    pub stiffness: f64,
    /// p_max = factor·Q^(1/3), Pa/N^(1/3).
    pub pressure_factor: f64,
    /// Long semi-axis = factor·Q^(1/3), m/N^(1/3).
    pub semi_major_factor: f64,
    /// Short semi-axis = factor·Q^(1/3), m/N^(1/3).
    pub semi_minor_factor: f64,
    /// Ellipticity, long over short semi-axis.
    pub ellipticity: f64,
}

impl PointContact {
    /// The exact contact of two bodies.
    ///
    /// Formula: K = [2/(δ* Σρ)]^(3/2) · 2 Σρ E*/3, a = a* c Q^(1/3), b = b* c Q^(1/3), c = (3/(2 Σρ E*))^(1/3), p_max = 3Q/(2πab)
    ///
    /// - `curvature`: sums of principal curvatures, 1/m
    /// - `contact_modulus`: E* of [`contact_modulus`](crate::materials::contact_modulus), Pa
    ///
    /// Source: H. Hertz 1881; factors of [`EllipseFactors::exact`].
    /// Valid: both sums positive, contact small against the radii; agrees with `hertz.json` to 1e-10.
    pub fn new(curvature: Curvature, contact_modulus: f64) -> Result<Self, NotAPoint> {
        let (small, large) = ordered(curvature)?;
        let factors = EllipseFactors::of_ratio(small / large);
        Ok(Self::from_factors(
            factors,
            curvature.sum(),
            contact_modulus,
        ))
    }

    /// The same contact by Hamrock and Brewe's fit.
    ///
    /// Formula: as [`PointContact::new`] with the factors of [`EllipseFactors::hamrock_brewe`]
    ///
    /// - `curvature`: sums of principal curvatures, 1/m
    /// - `contact_modulus`: E*, Pa
    ///
    /// Source: Hamrock and Brewe 1983 (from memory).
    /// Valid: 1.25 ≤ κ ≤ 15: approach within 3 %, K within 4.5 %; near a circle 5.5 % and 9 %.
    pub fn hamrock_brewe(curvature: Curvature, contact_modulus: f64) -> Result<Self, NotAPoint> {
        ordered(curvature)?;
        let factors = EllipseFactors::hamrock_brewe(curvature.difference().abs())
            .ok_or(NotAPoint(curvature))?;
        Ok(Self::from_factors(
            factors,
            curvature.sum(),
            contact_modulus,
        ))
    }

    fn from_factors(factors: EllipseFactors, sum: f64, contact_modulus: f64) -> Self {
        let c = (1.5 / (sum * contact_modulus)).cbrt();
        let approach = factors.approach * c * c * sum / 2.0;
        let (a, b) = (factors.semi_major * c, factors.semi_minor * c);
        PointContact {
            stiffness: approach.powf(-1.5),
            pressure_factor: 1.5 / (PI * a * b),
            semi_major_factor: a,
            semi_minor_factor: b,
            ellipticity: factors.ellipticity,
        }
    }

    /// Approach of the two bodies under a load, m.
    ///
    /// Formula: δ = (Q/K)^(2/3)
    ///
    /// - `load`: Q ≥ 0, N
    ///
    /// Source: H. Hertz 1881.
    /// Valid: elastic contact.
    pub fn approach(&self, load: f64) -> f64 {
        let root = (load / self.stiffness).cbrt();
        root * root
    }
    /// Long semi-axis a of the contact ellipse, m.
    ///
    /// Formula: a = a* (3Q/(2 Σρ E*))^(1/3)
    ///
    /// - `load`: Q ≥ 0, N
    ///
    /// Source: H. Hertz 1881.
    /// Valid: elastic contact; the ellipse must not reach the shoulder of the groove.
    pub fn semi_major(&self, load: f64) -> f64 {
        self.semi_major_factor * load.cbrt()
    }
    /// Short semi-axis b of the contact ellipse, m.
    ///
    /// Formula: b = b* (3Q/(2 Σρ E*))^(1/3)
    ///
    /// - `load`: Q ≥ 0, N
    ///
    /// Source: H. Hertz 1881.
    /// Valid: elastic contact.
    pub fn semi_minor(&self, load: f64) -> f64 {
        self.semi_minor_factor * load.cbrt()
    }
    /// Load at which the maximum pressure reaches a limit, N.
    ///
    /// Formula: Q = (p_max/factor)³
    ///
    /// - `pressure`: p_max ≥ 0, Pa; 4200 MPa is the static limit of ISO 76 for steel balls
    ///
    /// Source: inverse of [`maximum_pressure`].
    /// Valid: elastic contact.
    pub fn load_at_pressure(&self, pressure: f64) -> f64 {
        (pressure / self.pressure_factor).powi(3)
    }
}

fn ordered(curvature: Curvature) -> Result<(f64, f64), NotAPoint> {
    let small = curvature.axial.min(curvature.rolling);
    let large = curvature.axial.max(curvature.rolling);
    if curvature.axial > 0.0 && curvature.rolling > 0.0 && large.is_finite() {
        Ok((small, large))
    } else {
        Err(NotAPoint(curvature))
    }
}

/// Maximum pressure of a point contact, Pa.
///
/// Formula: p_max = 3Q/(2πab) = factor·Q^(1/3), 0 without load
///
/// - `factor`: [`PointContact::pressure_factor`], Pa/N^(1/3)
/// - `load`: Q, N
///
/// Source: H. Hertz 1881.
/// Valid: elastic contact; loads above 1e-200 N (0 below).
#[inline(always)]
pub fn maximum_pressure<R: Real>(factor: R, load: R) -> R {
    let tiny = R::splat(1e-200);
    let loaded = load.greater(tiny);
    let root = load.max(tiny).powf(R::splat(1.0 / 3.0));
    R::select(loaded, factor * root, R::zero())
}

/// Largest tension of a circular contact, Pa: along the radius, on the surface, at the rim.
///
/// Formula: σ = (1 - 2ν) p_max/3; farther out it falls with the square of the distance
///
/// - `pressure`: p_max, Pa
/// - `poisson_ratio`: ν of the body looked into
///
/// Brittle bodies crack there in rings.
///
/// Source: M. T. Huber 1904 (K. L. Johnson, Contact Mechanics, 1985, section 3.4, from memory); tested against a sum of point loads.
/// Valid: a circular contact without friction; friction adds tension at the trailing rim.
pub fn rim_tension(pressure: f64, poisson_ratio: f64) -> f64 {
    (1.0 - 2.0 * poisson_ratio) * pressure / 3.0
}

#[cfg(test)]
mod tests;
