//! Normal force of a contact in time.
//!
//! Approach δ is positive when the bodies overlap, δ̇ when they close in. A contact pushes, it never pulls:
//! where damping would turn the force negative it is clipped to zero, and what the spring then gives up is heat.

use number::Real;

/// A normal contact force and its elastic part.
///
/// Heat made per second is (`force` - `elastic`)·δ̇: never negative, also where the force is clipped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalForce<R> {
    /// Force, N, never negative.
    pub force: R,
    /// The force of the spring alone, N.
    pub elastic: R,
}

/// Smallest approach that enters a logarithm, m: far below an atom.
const SMALLEST_APPROACH: f64 = 1e-18;

/// Force of a ball on a race: Hertz with viscoelastic damping.
///
/// Formula: Q = max(0, K(δ^1.5 + 1.5 β δ^½ δ̇)) for δ > 0, else 0.
///
/// - `stiffness` K, N/m^1.5
/// - `damping_time` β, s
/// - `approach` δ, m; `approach_speed` δ̇, m/s
///
/// Source: H. Hertz 1881 for δ^1.5; the damping term is that of a viscoelastic sphere,
/// Brilliantov, Spahn, Hertzsch, Pöschel, Phys. Rev. E 53 (1996) 5382 (from memory).
/// Valid: approach small against ball and groove radii; β small against the duration of the impact.
#[inline(always)]
pub fn ball_race<R: Real>(
    stiffness: R,
    damping_time: R,
    approach: R,
    approach_speed: R,
) -> NormalForce<R> {
    // an open contact has no depth: its root, and with it everything, is zero
    let depth = approach.max(R::zero());
    let slope = stiffness * depth.sqrt();
    let damped = slope * (depth + R::splat(1.5) * damping_time * approach_speed);
    NormalForce {
        force: damped.max(R::zero()),
        elastic: slope * depth,
    }
}

/// Energy stored in a ball/race contact, J.
///
/// Formula: U = ⅖ K δ^2.5 for δ > 0, else 0.
///
/// - `stiffness` K, N/m^1.5; `approach` δ, m
///
/// Source: integral of K δ^1.5.
/// Valid: as [`ball_race`].
#[inline(always)]
pub fn ball_race_energy<R: Real>(stiffness: R, approach: R) -> R {
    let depth = approach.max(R::zero());
    R::splat(0.4) * stiffness * depth.square() * depth.sqrt()
}

/// Force of a contact that hardens with a power of its penetration, with Hunt-Crossley damping.
///
/// Formula: N = max(0, k dⁿ (1 + a ḋ)) for d > 0, else 0.
///
/// - `stiffness` k, N/mⁿ; `exponent` n
/// - `damping` a, s/m
/// - `penetration` d, m; `penetration_speed` ḋ, m/s
///
/// Source: K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440 (from memory);
/// n = 10/9 is A. Palmgren's exponent of a line contact, 1959 (from memory); a journal in a bore is conformal, so its use
/// there is an assumption.
/// Valid: 1 ≤ n ≤ 2; a·ḋ well below 1.
#[inline(always)]
pub fn hunt_crossley<R: Real>(
    stiffness: R,
    exponent: R,
    damping: R,
    penetration: R,
    penetration_speed: R,
) -> NormalForce<R> {
    let closed = penetration.greater(R::zero());
    let spring = stiffness * penetration.max(R::splat(SMALLEST_APPROACH)).powf(exponent);
    let damped = spring * (R::one() + damping * penetration_speed);
    NormalForce {
        force: R::select(closed, damped.max(R::zero()), R::zero()),
        elastic: R::select(closed, spring, R::zero()),
    }
}

/// Energy stored in a contact that hardens with a power of its penetration, J.
///
/// Formula: U = k dⁿ⁺¹/(n + 1) for d > 0, else 0.
///
/// - `stiffness` k, N/mⁿ; `exponent` n; `penetration` d, m
///
/// Source: integral of k dⁿ.
/// Valid: as [`hunt_crossley`].
#[inline(always)]
pub fn hunt_crossley_energy<R: Real>(stiffness: R, exponent: R, penetration: R) -> R {
    let power = exponent + R::one();
    let energy = stiffness * penetration.max(R::splat(SMALLEST_APPROACH)).powf(power) / power;
    R::select(penetration.greater(R::zero()), energy, R::zero())
}

/// Force of a linear contact with Hunt-Crossley damping: [`hunt_crossley`] with n = 1, without its logarithm.
///
/// Formula: P = max(0, k p (1 + a ṗ)) for p > 0, else 0.
///
/// - `stiffness` k, N/m; `damping` a, s/m
/// - `penetration` p, m; `penetration_speed` ṗ, m/s
///
/// Source: as [`hunt_crossley`].
/// Valid: a·ṗ well below 1.
#[inline(always)]
pub fn linear_contact<R: Real>(
    stiffness: R,
    damping: R,
    penetration: R,
    penetration_speed: R,
) -> NormalForce<R> {
    let elastic = stiffness * penetration.max(R::zero());
    NormalForce {
        force: (elastic * (R::one() + damping * penetration_speed)).max(R::zero()),
        elastic,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn undamped_forces_are_their_springs() {
        let q = ball_race(2.5e10, 0.0, 1e-6, 0.3);
        assert!((q.force - 25.0).abs() < 1e-13 && q.force == q.elastic);
        let n = hunt_crossley(5e8, 10.0 / 9.0, 0.0, 1e-5, 0.1);
        assert!((n.force / (5e8 * 1e-5_f64.powf(10.0 / 9.0)) - 1.0).abs() < 1e-14);
        assert_eq!(linear_contact(1e7, 0.0, 1e-4, 1.0).force, 1e3);
    }
    #[test]
    fn open_contacts_neither_push_nor_pull() {
        for speed in [-10.0, 0.0, 10.0] {
            assert_eq!(ball_race(2.5e10, 2.5e-6, -1e-9, speed).force, 0.0);
            assert_eq!(hunt_crossley(5e8, 1.1, 0.5, -1e-9, speed).force, 0.0);
            assert_eq!(linear_contact(1e7, 0.5, -1e-9, speed).force, 0.0);
        }
    }
    #[test]
    fn energy_is_the_work_of_the_spring() {
        // midpoint rule, 4000 strips: relative error near 1e-7
        let work = |force: &dyn Fn(f64) -> f64| {
            (0..4000)
                .map(|i| force((i as f64 + 0.5) * 1e-5 / 4000.0))
                .sum::<f64>()
                * 1e-5
                / 4000.0
        };
        let hertz = work(&|d| ball_race(2e10, 0.0, d, 0.0).elastic);
        assert!((ball_race_energy(2e10, 1e-5) / hertz - 1.0).abs() < 1e-6);
        let power = work(&|d| hunt_crossley(5e8, 1.11, 0.0, d, 0.0).elastic);
        assert!((hunt_crossley_energy(5e8, 1.11, 1e-5) / power - 1.0).abs() < 1e-6);
    }

    proptest! {
        #[test]
        fn contacts_only_push_and_only_heat(d in -1e-5..5e-5_f64, speed in -20.0..20.0_f64) {
            for n in [
                ball_race(2.5e10, 2.5e-6, d, speed),
                hunt_crossley(5e8, 10.0 / 9.0, 0.5, d, speed),
                linear_contact(1e7, 0.5, d, speed),
            ] {
                prop_assert!(n.force >= 0.0);
                prop_assert!((n.force - n.elastic) * speed >= 0.0);
            }
        }
    }
}
