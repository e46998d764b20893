//! Flash temperatures: heat sources that move over a surface.

use crate::heat_conduction::ThermalMaterial;
use std::f64::consts::PI;

/// e^z K₀(z) and e^z K₁(z), by the trapezoid on ∫₀^∞ e^(−z(cosh t − 1)) cosh(νt) dt, which converges exponentially.
///
/// Source: Abramowitz and Stegun 9.6.24 (from memory: check before quoting).
/// Valid: z > 0.
pub fn scaled_bessel(z: f64) -> [f64; 2] {
    let step = (0.6 / (1.0 + z).sqrt()).min(0.125);
    let (mut zero, mut one) = (0.5, 0.5);
    let mut t = step;
    loop {
        // cosh t − 1 without cancellation
        let lift = 2.0 * (0.5 * t).sinh().powi(2);
        let weight = (-z * lift).exp();
        if weight * t.cosh() < 1e-18 * one {
            return [step * zero, step * one];
        }
        zero += weight;
        one += weight * t.cosh();
        t += step;
    }
}

/// ∫₀^z e^s K₀(s) ds = z e^z (K₀ + K₁) − 1.
fn rising(z: f64) -> f64 {
    if z <= 0.0 {
        return 0.0;
    }
    let [zero, one] = scaled_bessel(z);
    z * (zero + one) - 1.0
}

/// ∫₀^z e^(−s) K₀(s) ds = z e^(−z) (K₀ − K₁) + 1.
fn falling(z: f64) -> f64 {
    if z <= 0.0 {
        return 0.0;
    }
    let [zero, one] = scaled_bessel(z);
    z * (-2.0 * z).exp() * (zero - one) + 1.0
}

/// Steady surface rise under a uniform band that moves: T* = πkvT/(2αq) at X = vx/2α from its middle, downstream
/// positive, with Λ = vb/2α.
///
/// Source: J. C. Jaeger 1942, closed: I₊(Λ+X) + I₋(Λ−X) in the band, differences of them outside.
/// Valid: steady, Λ > 0.
pub fn band_rise(half_length: f64, place: f64) -> f64 {
    if place.abs() <= half_length {
        rising(half_length + place) + falling(half_length - place)
    } else if place > 0.0 {
        rising(place + half_length) - rising(place - half_length)
    } else {
        falling(half_length - place) - falling(-half_length - place)
    }
}

/// Where a band is hottest, and how hot: (X, T*).
///
/// There e^s K₀ is equal at both ends of the integral.
///
/// Source: derivative of [`band_rise`].
/// Valid: Λ > 0.
pub fn band_maximum(half_length: f64) -> (f64, f64) {
    let (mut low, mut high) = (0.0, half_length);
    for _ in 0..80 {
        let place = 0.5 * (low + high);
        let behind = half_length - place;
        let slope = scaled_bessel(half_length + place)[0]
            - (-2.0 * behind).exp() * scaled_bessel(behind)[0];
        if behind > 0.0 && slope > 0.0 {
            low = place;
        } else {
            high = place;
        }
    }
    (low, band_rise(half_length, low))
}

/// Mean of [`band_rise`] over the band: (1/2Λ)∫₀^{2Λ} (I₊ + I₋) dz.
///
/// The integrand begins as z ln z; z = 2Λu⁴ makes it smooth enough for Simpson's rule.
///
/// Source: integral of [`band_rise`].
/// Valid: steady, Λ > 0.
pub fn band_mean(half_length: f64) -> f64 {
    let n = 400;
    let value = |i: i32| {
        let u = f64::from(i) / f64::from(n);
        let z = 2.0 * half_length * u.powi(4);
        (rising(z) + falling(z)) * 4.0 * u.powi(3)
    };
    let sum: f64 = (1..n)
        .map(|i| if i % 2 == 1 { 4.0 } else { 2.0 } * value(i))
        .sum();
    (value(0) + sum + value(n)) / (3.0 * f64::from(n))
}

/// Largest and mean rise kT/(qa) of a circle of radius a under uniform flux: 2/√(π(1.273 + Pe)), 1.22/√(π(0.6575 + Pe)).
///
/// Argument: Pe = va/2α.
///
/// Source: Tian and Kennedy 1994 (from memory: check before quoting).
/// Valid: within 2.3 % and 3.8 % of the exact values.
pub fn circle_fit(peclet: f64) -> [f64; 2] {
    [
        2.0 / (PI * (1.273 + peclet)).sqrt(),
        1.22 / (PI * (0.6575 + peclet)).sqrt(),
    ]
}

/// Mean rise kT/(qa) of a circle under uniform flux, exactly: (1/π)∫₀² [2 acos(r/2) − (r/2)√(4−r²)] e^(−Pe r) I₀(Pe r) dr.
///
/// Source: derived, the pairs of points of a circle by their distance; e^(−x) I₀(x) as the mean of e^(−x(1 − cos θ)).
/// Valid: steady, Pe ≥ 0.
pub fn circle_mean(peclet: f64) -> f64 {
    let bessel = |x: f64| {
        let n = 64 + 8 * (x.sqrt() as i32);
        (0..n)
            .map(|i| (-x * (1.0 - (2.0 * PI * f64::from(i) / f64::from(n)).cos())).exp())
            .sum::<f64>()
            / f64::from(n)
    };
    // r = 2 sin²(θ/2)·… would hide the root at 2; r = 2(1 − v²) takes it away; e^(−x) I₀(x) needs 1/Pe resolved at r = 0.
    let n = 400 + 40 * (peclet.min(1e4) as i32);
    let value = |i: i32| {
        let v = f64::from(i) / f64::from(n);
        let r = 2.0 * (1.0 - v * v);
        let lens = 2.0 * (0.5 * r).acos() - 0.5 * r * (4.0 - r * r).max(0.0).sqrt();
        lens * bessel(peclet * r) * 4.0 * v
    };
    let sum: f64 = (1..n)
        .map(|i| if i % 2 == 1 { 4.0 } else { 2.0 } * value(i))
        .sum();
    (value(0) + sum + value(n)) / (3.0 * f64::from(n)) / PI
}

/// How the flux of a patch is spread over it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flux {
    /// q₀ everywhere.
    Uniform,
    /// q₀ √(1 − ρ²), as the pressure of Hertz.
    Hertz,
}

/// Angles of [`ellipse_rise`], points along each, and how far these reach.
const ANGLES: usize = 1000;
const POINTS: usize = 48;
const REACH: f64 = 3.0;

/// Steady surface rise under a moving ellipse on its axis along the motion: kT/(q₀b) at x/b from its middle, downstream
/// positive: (1/2π)∫dθ∫₀^S f e^(−Pe s(1 + cos θ)) ds over the distances s to the edge at S(θ).
///
/// Arguments: x/b inside the ellipse; semi-axis across the motion over b, the one along it; Pe = vb/2α.
///
/// Source: derived, the moving point source of Carslaw and Jaeger (section 10.7, from memory) in polar coordinates about the point.
/// Valid: steady, |x| < b.
pub fn ellipse_rise(place: f64, aspect: f64, peclet: f64, flux: Flux) -> f64 {
    let inside = 1.0 - place * place;
    let of_angle = |k: usize| {
        let theta = PI * (k as f64 + 0.5) / ANGLES as f64;
        let (sine, cosine) = theta.sin_cos();
        // 1 − ρ² = inside − 2 slope s − curve s²
        let curve = cosine * cosine + (sine / aspect).powi(2);
        let slope = place * cosine;
        let edge = inside / (slope + (slope * slope + curve * inside).sqrt());
        let rate = peclet * (1.0 + cosine);
        match flux {
            Flux::Uniform if rate * edge < 1e-8 => edge,
            Flux::Uniform => -(-rate * edge).exp_m1() / rate,
            Flux::Hertz => {
                // s = S/(1 + e^(−π sinh τ)) is dense where the point is hot and where the ellipse ends
                let step = 2.0 * REACH / POINTS as f64;
                let at = |j: usize| {
                    let tau = step * (j as f64 + 0.5) - REACH;
                    let share = 1.0 / (1.0 + (-PI * tau.sinh()).exp());
                    let s = edge * share;
                    let rest = (inside - s * (2.0 * slope + curve * s)).max(0.0);
                    rest.sqrt() * (-rate * s).exp() * s * (1.0 - share) * PI * tau.cosh()
                };
                (0..POINTS).map(at).sum::<f64>() * step
            }
        }
    };
    (0..ANGLES).map(of_angle).sum::<f64>() / ANGLES as f64
}

/// Where an ellipse is hottest, and how hot: (x/b, kT/(q₀b)).
///
/// Source: the largest value of [`ellipse_rise`], by golden section.
/// Valid: as [`ellipse_rise`].
pub fn ellipse_maximum(aspect: f64, peclet: f64, flux: Flux) -> (f64, f64) {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let rise = |place| ellipse_rise(place, aspect, peclet, flux);
    let (mut low, mut high) = (-0.5, 1.0 - 1e-9);
    let mut inner = [high - golden * (high - low), low + golden * (high - low)];
    let mut rises = inner.map(rise);
    for _ in 0..42 {
        if rises[0] > rises[1] {
            high = inner[1];
            inner = [high - golden * (high - low), inner[0]];
            rises = [rise(inner[0]), rises[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + golden * (high - low)];
            rises = [rises[1], rise(inner[1])];
        }
    }
    let place = 0.5 * (low + high);
    (place, rise(place))
}

/// Largest rise under pressure-shaped flux (Hertz) over that under uniform flux of the same power: 1.16 to 1.24.
const HERTZ_OVER_UNIFORM: f64 = 1.19;

/// A ball that slides on its race: Hertz's ellipse, both surfaces half-spaces.
///
/// ```text
///   q = P/(πab)    Pe_k = |U_k| b/(2α_k)    G_k = ½ k_k √(π(B + Pe_k))    rise = 1.19 q b/(G_ball + G_race)
/// ```
/// Both sides are equally hot where they are hottest, which divides the heat; B makes each side right at rest, and 1/√Pe is
/// Blok's law at speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkiddingContact {
    /// Semi-axes across the motion and along it, m per cube root of the load in N.
    axes: [f64; 2],
    /// B.
    at_rest: f64,
    /// Of ball and race.
    bodies: [ThermalMaterial; 2],
}

impl SkiddingContact {
    /// The contact of two bodies; semi-axes a across the motion and b along it, m/N^(1/3).
    ///
    /// Formula: B = 4/(π T²) = (4/π) M(1, b/a)²; T = kT/(qb) = 1/M(1, b/a) in the middle of a uniform ellipse at rest, M the
    /// arithmetic-geometric mean
    ///
    /// Source: derived; T = (2/π) K(√(1 − b²/a²)), equal to [`ellipse_rise`] at rest.
    /// Valid: any aspect.
    pub fn new(axes: [f64; 2], bodies: [ThermalMaterial; 2]) -> Self {
        let (mut one, mut other) = (1.0, axes[1] / axes[0]);
        while (one - other).abs() > 1e-12 * one {
            (one, other) = (0.5 * (one + other), (one * other).sqrt());
        }
        SkiddingContact {
            axes,
            at_rest: 4.0 / PI * one * one,
            bodies,
        }
    }

    /// Rise of both surfaces in the contact above their own means, K.
    ///
    /// Arguments: sliding power W, load N, speeds of the surfaces of ball and race past the contact m/s.
    ///
    /// Source: the fit of the Péclet number between rest and Blok's law is ours.
    /// Valid: within 4 % of [`ellipse_maximum`] for aspects up to 15; steady, which takes b/U and at rest b²/α; no film, no asperities.
    pub fn flash(&self, power: f64, load: f64, speeds: [f64; 2]) -> f64 {
        let [across, along] = self.axes.map(|axis| axis * load.cbrt());
        let conductance = |body: &ThermalMaterial, speed: f64| {
            let peclet = speed.abs() * along / (2.0 * body.diffusivity());
            0.5 * body.conductivity * (PI * (self.at_rest + peclet)).sqrt()
        };
        let [ball, race] = &self.bodies;
        let both = conductance(ball, speeds[0]) + conductance(race, speeds[1]);
        HERTZ_OVER_UNIFORM * power / (PI * across) / both
    }
}

/// Flash of a surface that passes a patch: 2q√(t_c/π)/e, t_c = min(2b/v, t), K.
///
/// Arguments: flux W/m², half-length b m, speed of the surface past the patch m/s, time since the touch s, effusivity.
///
/// Source: derived.
/// Valid: Λ = vb/2α > 5 (4 %).
pub fn flash_rise(
    flux: f64,
    half_length: f64,
    speed: f64,
    since_touch: f64,
    effusivity: f64,
) -> f64 {
    let passage = (2.0 * half_length / speed).min(since_touch);
    2.0 * flux * (passage / PI).sqrt() / effusivity
}

/// Share of the flash that stands above the surface's own mean: g = 1 − 0.7302√f − 0.2698 f^1.5.
///
/// Argument: f = patch over track area of that body.
///
/// Source: fit of [ζ(−½, f) − ζ(−½)]/√f.
/// Valid: 0 to 1, within 0.009.
pub fn return_factor(share: f64) -> f64 {
    1.0 - 0.7302 * share.sqrt() - 0.2698 * share.powf(1.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::heat_conduction::{SILICON_NITRIDE_HEAT, STEEL_HEAT};

    #[test]
    fn scaled_bessel_functions_have_the_printed_digits() {
        // K₀(1), K₁(1); e^50 K₀(50)
        let [zero, one] = scaled_bessel(1.0);
        assert!((zero * (-1f64).exp() / 0.421_024_438_240_708_3 - 1.0).abs() < 1e-13);
        assert!((one * (-1f64).exp() / 0.601_907_230_197_234_6 - 1.0).abs() < 1e-13);
        let asymptotic = (PI / 100.0).sqrt() * (1.0 - 1.0 / 400.0 + 9.0 / 320_000.0);
        assert!((scaled_bessel(50.0)[0] / asymptotic - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_fast_band_is_blok_s_and_its_mean_two_thirds_of_the_largest() {
        // T = 2q√(2b/(πv))/e ⇔ T* = √(4πΛ)
        let fast = 400.0;
        assert!((band_rise(fast, fast) / (4.0 * PI * fast).sqrt() - 1.0).abs() < 0.03);
        assert!((band_mean(fast) / band_maximum(fast).1 - 2.0 / 3.0).abs() < 0.02);
    }

    #[test]
    fn an_ellipse_at_rest_and_one_that_is_long_across_have_closed_forms() {
        // at rest: 1 of a uniform circle, π/4 of Hertz's
        let (place, rise) = ellipse_maximum(1.0, 0.0, Flux::Uniform);
        assert!(place.abs() < 1e-4 && (rise - 1.0).abs() < 1e-9);
        let (_, rise) = ellipse_maximum(1.0, 0.0, Flux::Hertz);
        assert!((rise - 0.25 * PI).abs() < 1e-4);
        // a band: kT/(q₀b) = T*/(π Pe)
        let (place, rise) = ellipse_maximum(200.0, 5.0, Flux::Uniform);
        let (band, largest) = band_maximum(5.0);
        assert!((rise / (largest / (PI * 5.0)) - 1.0).abs() < 1e-3, "{rise}");
        assert!((place - band / 5.0).abs() < 1e-3);
    }

    #[test]
    fn a_skidding_ball_is_as_hot_as_the_exact_ellipse() {
        let steel = STEEL_HEAT;
        let (load, power) = (8.0, 40.0);
        for aspect in [1.0, 15.0] {
            let along = 5e-5;
            let contact = SkiddingContact::new([aspect * along, along], [steel; 2]);
            let half = along * 2.0;
            for peclet in [0.0, 0.5, 5.0, 50.0] {
                let speed = peclet * 2.0 * steel.diffusivity() / half;
                let found = contact.flash(power, load, [speed, -speed]);
                // half of the heat each; the largest flux of Hertz's shape is 1.5 times its mean
                let flux = 1.5 * 0.5 * power / (PI * aspect * half * half);
                let exact = ellipse_maximum(aspect, peclet, Flux::Hertz).1 * flux * half
                    / steel.conductivity;
                assert!(
                    (found / exact - 1.0).abs() < 0.045,
                    "{aspect} {peclet}: {}",
                    found / exact
                );
            }
        }
    }

    #[test]
    fn the_middle_of_an_ellipse_at_rest_is_that_of_the_integral() {
        for aspect in [0.3, 1.0, 9.0] {
            let exact = ellipse_rise(0.0, aspect, 0.0, Flux::Uniform);
            let found = SkiddingContact::new([aspect, 1.0], [STEEL_HEAT; 2]).at_rest;
            assert!((found * PI * exact * exact / 4.0 - 1.0).abs() < 1e-4);
        }
    }

    #[test]
    fn the_faster_and_the_better_conductor_takes_more_of_a_skid() {
        let axes = [5e-4, 5e-5];
        let steel = SkiddingContact::new(axes, [STEEL_HEAT; 2]);
        let hybrid = SkiddingContact::new(axes, [SILICON_NITRIDE_HEAT, STEEL_HEAT]);
        let flash = |contact: &SkiddingContact, speeds| contact.flash(100.0, 27.0, speeds);
        assert!(flash(&hybrid, [5.0; 2]) > flash(&steel, [5.0; 2]));
        assert!(flash(&steel, [5.0, 20.0]) < flash(&steel, [5.0, 5.0]));
        // a ball that stands in its contact: the race takes nearly all, its flash is twice that of equal shares
        let (both, one) = (flash(&steel, [50.0; 2]), flash(&steel, [0.0, 50.0]));
        assert!((one / both - 2.0).abs() < 0.15, "{}", one / both);
        // twice the power at the same load and speeds: twice as hot
        assert!((steel.flash(200.0, 27.0, [5.0; 2]) / flash(&steel, [5.0; 2]) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn no_heat_no_flash_and_a_full_track_leaves_nothing_above_its_mean() {
        assert_eq!(flash_rise(0.0, 1e-4, 10.0, 1.0, 1e4), 0.0);
        assert!((return_factor(0.0) - 1.0).abs() < 1e-15 && return_factor(1.0).abs() < 1e-12);
        assert!((circle_mean(0.0) - 8.0 / (3.0 * PI)).abs() < 1e-7);
    }
}
