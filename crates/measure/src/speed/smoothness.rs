//! Deviations within a quick change, given how smooth the change turns out to be.
//!
//! ```text
//! P(q)   variance at the density q: a part from the noise of the pulses and one from the motion, β P where P ~ q^β
//! δ      by how much an estimate moves when the fit is made ten times stiffer
//!        E δ² = P(q/10) (1 + 9 β) - P(q)   if the snap is white noise of the density q
//! ρ      ⟨δ²⟩/⟨E δ²⟩ over about a tenth of the change
//! variance   P - β P (1 - ρ)
//! ```
//! One density serves the whole change, its corners and its even middle; and a motion that is smoother than white snap is met
//! by the same fit with errors from the noise alone, which are 0.6 (acceleration) to 0.8 (speed) of the deviation P. Where the
//! estimate hardly moves as the fit is made stiffer, the motion has little to do with what is left open; where it moves
//! more than white snap would let it, the band is too narrow. The noise takes part in δ, so that a smooth motion keeps
//! some of βP.
//!
//! E δ²: an estimate from all pulses leaves an error that is uncorrelated with any other linear estimate from them, so that
//! the variances of two differ by E δ²; that of the stiffer fit is its noise part (1 - β) P(q/10) and ten times its motion
//! part β P(q/10).
//!
//! **Does not model**: the first and the last fifth of a change, where knots leave more open than the density does: there the
//! factor fades out.

use super::plan::Plan;
use super::track::{Track, mixed};
use super::transition::Belief;

/// How much stiffer the other fit is.
const STIFFER: f64 = 10.0;
/// Instants at which the two are compared.
const POINTS: usize = 80;
/// Standard deviation of the window of the mean, and length over which the factor fades in and out, as parts of the change.
const WINDOW: f64 = 0.08;
const FADES: f64 = 0.2;
/// Least part of a variance that is left.
const LEAST: f64 = 0.02;

/// Factors on the deviations of speed and acceleration over a quick change.
#[derive(Clone, Debug)]
pub(super) struct Smoothness {
    from: f64,
    to: f64,
    factors: Vec<[f64; 2]>,
}

/// A state at an instant: from the fit, and how the stiffer one differs.
struct Compared {
    /// Variance of the mixture.
    whole: f64,
    /// Mean variance of its tracks, and the exponent β.
    within: f64,
    exponent: f64,
    /// δ² and what is expected of it.
    moved: f64,
    expected: f64,
}

/// A plan that is ten times stiffer.
pub(super) fn stiffer(plan: &Plan) -> Plan {
    let mut plan = *plan;
    plan.quiet = plan.quiet.map(|density| density / STIFFER);
    if let Some(knots) = &mut plan.transient {
        knots.density /= STIFFER;
        if let Some(head) = &mut knots.head {
            head.share /= STIFFER;
        }
    }
    plan
}

impl Smoothness {
    /// That of a change between two instants, from its tracks and the stiffer ones with their weights.
    pub fn of(
        tracks: &[(f64, Track)],
        stiffer: &[(f64, Track)],
        (from, to): (f64, f64),
    ) -> Smoothness {
        let time = |k: usize| from + (to - from) * k as f64 / POINTS as f64;
        let rows: Vec<[Compared; 2]> = (0..=POINTS)
            .map(|k| compared(tracks, stiffer, time(k)))
            .collect();
        let factor = |k: usize, state: usize| {
            let here = &rows[k][state];
            let (mut moved, mut expected) = (0.0, 0.0);
            for (j, row) in rows.iter().enumerate() {
                let away = (j as f64 - k as f64) / POINTS as f64 / WINDOW;
                let weight = (-0.5 * away * away).exp();
                moved += weight * row[state].moved;
                expected += weight * row[state].expected;
            }
            let place = k as f64 / POINTS as f64;
            let faded = (place.min(1.0 - place) / FADES).min(1.0);
            let more = faded * here.exponent * here.within * (moved / expected - 1.0);
            let factor = (1.0 + more / here.whole).max(LEAST).sqrt();
            if factor.is_finite() { factor } else { 1.0 }
        };
        Smoothness {
            from,
            to,
            factors: (0..=POINTS).map(|k| [factor(k, 0), factor(k, 1)]).collect(),
        }
    }

    /// Factors on the deviations of angle, speed and acceleration at an instant, in units.
    pub fn at(&self, time: f64) -> [f64; 3] {
        let place = (time - self.from) / (self.to - self.from) * POINTS as f64;
        if !(0.0..POINTS as f64).contains(&place) {
            return [1.0; 3];
        }
        let (k, part) = (place as usize, place.fract());
        let (left, right) = (self.factors[k], self.factors[k + 1]);
        let between = |state: usize| left[state] + part * (right[state] - left[state]);
        [1.0, between(0), between(1)]
    }
}

/// Speed and acceleration at an instant.
fn compared(tracks: &[(f64, Track)], stiffer: &[(f64, Track)], time: f64) -> [Compared; 2] {
    let beliefs = |tracks: &[(f64, Track)]| -> Vec<(f64, Belief)> {
        let all = tracks.iter();
        all.map(|(weight, track)| (*weight, track.at(time)))
            .collect()
    };
    let (soft, hard) = (beliefs(tracks), beliefs(stiffer));
    let (mean_soft, mean_hard) = (mixed(soft.iter().copied()), mixed(hard.iter().copied()));
    [1, 2].map(|state| {
        let within = |beliefs: &[(f64, Belief)]| -> f64 {
            let variances = beliefs
                .iter()
                .map(|(w, b)| w * b.covariance[(state, state)]);
            variances.sum::<f64>().max(0.0)
        };
        let (soft, hard) = (within(&soft), within(&hard));
        let exponent = ((soft / hard).ln() / STIFFER.ln()).clamp(0.0, 1.0);
        Compared {
            whole: mean_soft.covariance[(state, state)],
            within: soft,
            exponent,
            moved: (mean_soft.mean[state] - mean_hard.mean[state]).powi(2),
            expected: (hard * (1.0 + (STIFFER - 1.0) * exponent) - soft).max(0.0),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::super::node::{Node, mark};
    use super::super::transition::{Matrix, Memory, Vector};
    use super::*;

    /// Integral of a function over u from 0 to infinity, by the rule of trapezia over ln u.
    fn integral(of: impl Fn(f64) -> f64) -> f64 {
        let step = 1e-3;
        (-20_000..20_000)
            .map(|k| {
                let u = (step * f64::from(k)).exp();
                step * u * of(u)
            })
            .sum()
    }

    /// A long record at even times, with its middle.
    fn track(density: f64, variance: f64) -> Track {
        let node = |k: i32| Node {
            time: f64::from(k),
            density,
            pulse: Some(mark(0.0, variance, 0.0)),
            added: None,
            fresh: None,
        };
        let start = Belief {
            mean: Vector::zeros(),
            covariance: Matrix::from_diagonal(&Vector::from([1.0, 0.1, 0.01, 1e-3, 0.0])),
        };
        let memory = Memory::of_clock(1e-9, 1.0);
        let nodes: Vec<Node> = (0..=400).map(node).collect();
        Track::new(&nodes, &start, density, memory)
    }

    /// A spline of order four through noise, in the frequency u that the density q and the noise r make one, u⁸ = ω⁸ r/q:
    /// it passes 1/(1 + u⁸); of a derivative d the variance is ∫ u^2d/(1 + u⁸), that from the noise alone
    /// ∫ u^2d/(1 + u⁸)².
    #[test]
    fn errors_from_the_noise_alone_are_three_fifths_and_four_fifths_of_the_deviation() {
        let (variance, corner) = (1e-4, 0.3f64);
        let soft = track(variance * corner.powi(8), variance);
        let hard = track(variance * corner.powi(8) / STIFFER, variance);
        let compared = compared(&[(1.0, soft)], &[(1.0, hard)], 200.3);
        for (order, compared, stated) in [(1, &compared[0], 0.8), (2, &compared[1], 0.6)] {
            let power = |u: f64| u.powi(2 * order);
            let whole = integral(|u| power(u) / (1.0 + u.powi(8)));
            let noise = integral(|u| power(u) / (1.0 + u.powi(8)).powi(2));
            let part = (noise / whole).sqrt();
            assert!((part - stated).abs() < 0.02, "{order}: {part}");
            // The rest is from the motion, and is what grows with the density.
            assert!(
                (compared.exponent - (1.0 - noise / whole)).abs() < 2e-3,
                "{order}: {} {}",
                compared.exponent,
                1.0 - noise / whole
            );
            // Both sides of the spectrum, over 2π; one pulse a unit of time.
            let wanted = variance * corner.powi(2 * order + 1) * whole / std::f64::consts::PI;
            assert!(
                (compared.within / wanted - 1.0).abs() < 1e-2,
                "{order}: {} {wanted}",
                compared.within
            );
        }
    }
}
