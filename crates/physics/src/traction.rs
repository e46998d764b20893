//! Sliding friction between ball and race: traction coefficient against slip speed.
//!
//! Every law is odd in the slip u, so friction always opposes sliding and only makes heat.
//! The friction force is μ(u) Q along the slip, Q the ball load. Assumed curves know the slip alone ([`SlipLaw`]); a
//! lubricated contact asks for load and entrainment too, and differs between the races.
//!
//! Not modelled: slip that differs over the contact: in the curved groove (Heathcote), and by spin about the normal.

use crate::lubricant_traction::LubricantTraction;
pub use crate::sliding_contact::SlidingContact;
use number::{Real, Vectorized, constants};

/// A traction law of a ball between two races.
pub trait TractionLaw<R: Real> {
    /// Traction coefficients μ at the inner and the outer race. Odd in the slip.
    fn at_races(&self, inner: &SlidingContact<R>, outer: &SlidingContact<R>) -> (R, R);
    /// Slopes ∂μ/∂u at the inner and the outer race, s/m, never negative: [`slopes`], or what comes cheaper.
    #[inline(always)]
    fn slopes_at_races(&self, inner: &SlidingContact<R>, outer: &SlidingContact<R>) -> (R, R) {
        slopes(self, inner, outer)
    }
}

macro_rules! curve {
    ($($Curve:ident),*) => {$(
        impl<R: Real> TractionLaw<R> for $Curve<R> {
            #[inline(always)]
            fn at_races(&self, inner: &SlidingContact<R>, outer: &SlidingContact<R>) -> (R, R) {
                (self.coefficient(inner.slip), self.coefficient(outer.slip))
            }
        }
    )*};
}
curve!(FourParameterTraction, DryTraction, AlgebraicTraction);

impl<R: Real> TractionLaw<R> for TanhTraction<R> {
    #[inline(always)]
    fn at_races(&self, inner: &SlidingContact<R>, outer: &SlidingContact<R>) -> (R, R) {
        let k = self.inverse_reference_speed;
        let (inner, outer) = (inner.slip * k).tanh_pair(outer.slip * k);
        (self.maximum * inner, self.maximum * outer)
    }
    /// μ_max/u0 (1 - tanh²).
    #[inline(always)]
    fn slopes_at_races(&self, inner: &SlidingContact<R>, outer: &SlidingContact<R>) -> (R, R) {
        let k = self.inverse_reference_speed;
        let (inner, outer) = (inner.slip * k).tanh_pair(outer.slip * k);
        let most = self.maximum * k;
        (
            most * (R::one() - inner.square()),
            most * (R::one() - outer.square()),
        )
    }
}

/// A traction law that is a curve: coefficient of friction over slip speed, the same at both races.
pub trait SlipLaw<R: Real> {
    /// Traction coefficient μ at slip speed u, m/s. Odd in u.
    fn coefficient(&self, slip: R) -> R;
}

constants! {
    /// Law (a): a smooth step, the regularised Coulomb friction of the reference cases.
    ///
    /// Formula: μ = μ_max tanh(u/u0).
    pub struct TanhTraction {
        /// Largest coefficient μ_max.
        maximum: R,
        /// 1/u0, s/m: inverse of the slip at which μ reaches 76 % of its maximum.
        inverse_reference_speed: R,
    }
}
impl<R: Real> SlipLaw<R> for TanhTraction<R> {
    #[inline(always)]
    fn coefficient(&self, slip: R) -> R {
        self.maximum * (slip * self.inverse_reference_speed).tanh()
    }
}

constants! {
    /// Law (b): four parameters, with a peak at small slip when B is large.
    ///
    /// Formula: μ = sgn(u)[(A + B|u|) e^(-C|u|) + D], D = -A so that μ(0) = 0.
    pub struct FourParameterTraction {
        /// A.
        a: R,
        /// B, s/m.
        b: R,
        /// C, s/m.
        c: R,
        /// D = -A: the coefficient at large slip.
        d: R,
    }
}
impl<R: Real> SlipLaw<R> for FourParameterTraction<R> {
    #[inline(always)]
    fn coefficient(&self, slip: R) -> R {
        let u = slip.abs();
        let magnitude = (self.a + self.b * u) * (-(self.c * u)).exp() + self.d;
        slip.sign_or_plus() * magnitude
    }
}

impl FourParameterTraction<f64> {
    /// The smallest coefficient at any slip > 0: negative means a law that would make energy.
    ///
    /// Source: μ(|u|) has its only stationary point at |u| = 1/C - A/B; its ends are 0 and D.
    /// Valid: C > 0.
    pub fn smallest(&self) -> f64 {
        let stationary = 1.0 / self.c - self.a / self.b;
        let inside = if self.b != 0.0 && stationary > 0.0 {
            self.coefficient(stationary)
        } else {
            0.0
        };
        inside.min(self.d).min(0.0)
    }
}

constants! {
    /// Law (d): dry or solid-film contact, static friction falling to kinetic friction.
    ///
    /// Formula: μ = [μ_k + (μ_s - μ_k) e^(-|u|/u_s)] tanh(u/u0).
    pub struct DryTraction {
        /// Kinetic coefficient μ_k.
        kinetic: R,
        /// Static coefficient less the kinetic one, μ_s - μ_k.
        static_excess: R,
        /// 1/u_s, s/m: inverse of the speed at which the excess has fallen to 37 %.
        inverse_decay_speed: R,
        /// 1/u0, s/m: inverse of the speed that regularises the sign of u.
        inverse_reference_speed: R,
    }
}
impl<R: Real> SlipLaw<R> for DryTraction<R> {
    #[inline(always)]
    fn coefficient(&self, slip: R) -> R {
        let level =
            self.kinetic + self.static_excess * (-(slip.abs() * self.inverse_decay_speed)).exp();
        level * (slip * self.inverse_reference_speed).tanh()
    }
}

constants! {
    /// Law (f): a smooth step like (a), without an exponential.
    ///
    /// Formula: μ = μ_max u/√(u² + u0²).
    pub struct AlgebraicTraction {
        /// Largest coefficient μ_max.
        maximum: R,
        /// u0, m/s: slip at which μ reaches 71 % of its maximum.
        reference_speed: R,
    }
}
impl<R: Real> SlipLaw<R> for AlgebraicTraction<R> {
    #[inline(always)]
    fn coefficient(&self, slip: R) -> R {
        self.maximum * slip / (slip.square() + self.reference_speed.square()).sqrt()
    }
}

constants! {
    /// Law (e): the lubricant, whose film differs between the races.
    pub struct LubricatedRaces {
        /// At the inner race.
        inner: LubricantTraction<R>,
        /// At the outer race.
        outer: LubricantTraction<R>,
    }
}
impl<R: Real> TractionLaw<R> for LubricatedRaces<R> {
    /// Apart: the law is long, and asked for in many places.
    #[inline(always)]
    fn at_races(&self, inner: &SlidingContact<R>, outer: &SlidingContact<R>) -> (R, R) {
        R::vectorized(Lubricated {
            laws: self,
            inner,
            outer,
        })
    }
}

/// A lubricated ball between its races.
struct Lubricated<'a, R> {
    laws: &'a LubricatedRaces<R>,
    inner: &'a SlidingContact<R>,
    outer: &'a SlidingContact<R>,
}

impl<R: Real> Vectorized for Lubricated<'_, R> {
    type Output = (R, R);
    #[inline(always)]
    fn run(self) -> (R, R) {
        let Lubricated { laws, inner, outer } = self;
        (
            (laws.inner).coefficient(inner.slip, inner.load, inner.entrainment),
            (laws.outer).coefficient(outer.slip, outer.load, outer.entrainment),
        )
    }
}

/// The traction laws a bearing can be built with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Traction<R> {
    /// Law (a).
    Tanh(TanhTraction<R>),
    /// Law (b).
    FourParameter(FourParameterTraction<R>),
    /// Law (d).
    Dry(DryTraction<R>),
    /// Law (e).
    Lubricated(LubricatedRaces<R>),
    /// Law (f).
    Algebraic(AlgebraicTraction<R>),
}

impl<R: Real> TractionLaw<R> for Traction<R> {
    /// Traction coefficients of the chosen law.
    ///
    /// Source: (a) regularised Coulomb friction; (b) the four-parameter form of
    /// P. K. Gupta, Advanced Dynamics of Rolling Elements, 1984 (from memory);
    /// (d) the exponential Stribeck form of L. C. Bo, D. Pavelescu, Wear 82 (1982) 277 (from memory);
    /// (e) that of [`LubricantTraction::state`]; (f) regularised Coulomb friction.
    /// Valid: any slip; (b) only with C > 0 and μ ≥ 0 for all |u|; (e) as there.
    #[inline(always)]
    fn at_races(&self, inner: &SlidingContact<R>, outer: &SlidingContact<R>) -> (R, R) {
        match self {
            Traction::Tanh(law) => law.at_races(inner, outer),
            Traction::FourParameter(law) => law.at_races(inner, outer),
            Traction::Dry(law) => law.at_races(inner, outer),
            Traction::Lubricated(law) => law.at_races(inner, outer),
            Traction::Algebraic(law) => law.at_races(inner, outer),
        }
    }
}

/// Slopes ∂μ/∂u of a law at the inner and the outer race, s/m: differences over slips so near that no law bends between them.
/// Never negative: where friction falls with slip, or does not change, it is not stiff.
///
/// Formula: [μ(u + d) - μ(u - d)]/2d, d = 1e-6 m/s + 1e-4 |u|
///
/// - `inner`, `outer`: both contacts
///
/// Source: central difference of the law.
/// Valid: as the law; relative error some 1e-8 of smooth laws.
#[inline(always)]
pub fn slopes<R: Real, L: TractionLaw<R> + ?Sized>(
    law: &L,
    inner: &SlidingContact<R>,
    outer: &SlidingContact<R>,
) -> (R, R) {
    let (d_i, d_o) = (near(inner), near(outer));
    let above = law.at_races(&aside(inner, d_i), &aside(outer, d_o));
    let below = law.at_races(&aside(inner, -d_i), &aside(outer, -d_o));
    let two = R::splat(2.0);
    let inverse = (two * d_i * d_o).recip();
    (
        ((above.0 - below.0) * d_o * inverse).max(R::zero()),
        ((above.1 - below.1) * d_i * inverse).max(R::zero()),
    )
}

/// A contact with more slip.
#[inline(always)]
fn aside<R: Real>(at: &SlidingContact<R>, by: R) -> SlidingContact<R> {
    SlidingContact {
        slip: at.slip + by,
        ..*at
    }
}

/// Half the distance of the slips of a difference, m/s.
#[inline(always)]
fn near<R: Real>(at: &SlidingContact<R>) -> R {
    R::splat(1e-6) + R::splat(1e-4) * at.slip.abs()
}

/// Slip that stands for none, m/s: far below any reference speed.
const SMALL_SLIP: f64 = 1e-9;

impl Traction<f64> {
    /// Slope ∂μ/∂u at zero slip, s/m: the larger one of both races.
    ///
    /// Formula: μ(1e-9 m/s)/(1e-9 m/s) of a curve; [`LubricantTraction::slope_at_rest`] of a lubricant
    ///
    /// - `load`: Q, N
    /// - `entrainment`: v, m/s
    ///
    /// Source: derivative of the law.
    /// Valid: as the law.
    pub fn slope_at_rest(&self, load: f64, entrainment: f64) -> f64 {
        match self {
            Traction::Lubricated(law) => {
                let [inner, outer] =
                    [&law.inner, &law.outer].map(|law| law.slope_at_rest(load, entrainment));
                inner.max(outer)
            }
            curve => {
                let at = SlidingContact {
                    slip: SMALL_SLIP,
                    load,
                    entrainment,
                };
                curve.at_races(&at, &at).0 / SMALL_SLIP
            }
        }
    }
}

number::variants!(Traction, "traction law": ; Tanh, FourParameter, Dry, Lubricated, Algebraic);

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const TANH: TanhTraction<f64> = TanhTraction {
        maximum: 0.07,
        inverse_reference_speed: 10.0,
    };
    const FOUR: FourParameterTraction<f64> = FourParameterTraction {
        a: -0.07,
        b: 0.35,
        c: 5.0,
        d: 0.07,
    };
    const DRY: DryTraction<f64> = DryTraction {
        kinetic: 0.1,
        static_excess: 0.1,
        inverse_decay_speed: 2.0,
        inverse_reference_speed: 100.0,
    };

    #[test]
    fn limits() {
        assert_eq!(TANH.coefficient(0.0), 0.0);
        assert!((TANH.coefficient(10.0) - 0.07).abs() < 1e-15);
        assert!((FOUR.coefficient(1e3) - 0.07).abs() < 1e-15);
        assert!(FOUR.coefficient(1e-12).abs() < 1e-12);
        // 0.1 + 0.1 e^-1 at the decay speed, the regularisation saturated
        assert!((DRY.coefficient(0.5) - 0.136_787_944_117_144_23).abs() < 1e-15);
        assert!((DRY.coefficient(100.0) - 0.1).abs() < 1e-15);
    }
    #[test]
    fn four_parameters_that_make_energy_are_found() {
        assert_eq!(FOUR.smallest(), 0.0);
        let pump = FourParameterTraction {
            a: -0.07,
            b: -0.9,
            c: 5.0,
            d: 0.07,
        };
        assert!(pump.smallest() < 0.0);
        let sink = (1..10_000)
            .map(|i| pump.coefficient(i as f64 * 1e-3))
            .fold(0.0, f64::min);
        assert!((pump.smallest() - sink).abs() < 1e-6);
    }

    proptest! {
        #[test]
        fn slopes_are_those_of_the_law(u in -2.0..2.0_f64) {
            let at = SlidingContact { slip: u, load: 100.0, entrainment: 5.0 };
            let (ours, _) = TANH.slopes_at_races(&at, &at);
            let (expected, _) = slopes(&TANH, &at, &at);
            // cancellation in the difference of two coefficients
            prop_assert!((ours - expected).abs() < 1e-7, "{ours} {expected}");
        }
        #[test]
        fn friction_is_odd_and_opposes_slip(u in -100.0..100.0_f64) {
            let algebraic = AlgebraicTraction { maximum: 0.07, reference_speed: 0.1 };
            let smooth = [Traction::Tanh(TANH), Traction::Algebraic(algebraic)];
            for law in [smooth[0], smooth[1], Traction::FourParameter(FOUR), Traction::Dry(DRY)] {
                let at = |slip| SlidingContact { slip, load: 100.0, entrainment: 5.0 };
                let (mu, same) = law.at_races(&at(u), &at(u));
                let (opposite, _) = law.at_races(&at(-u), &at(u));
                prop_assert!(mu * u >= 0.0 && mu == same);
                prop_assert!((mu + opposite).abs() < 1e-15);
            }
        }
    }
}
