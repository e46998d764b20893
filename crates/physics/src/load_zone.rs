//! Ball loads of a bearing under a radial load, quasi-static.

use std::f64::consts::TAU;

/// Stiffness of ball and both races in series: (K_i^(−2/3) + K_o^(−2/3))^(−3/2), N/m^1.5.
///
/// Source: H. Hertz 1881, approaches add.
/// Valid: elastic contacts in series.
pub fn joint_stiffness(inner: f64, outer: f64) -> f64 {
    (inner.powf(-2.0 / 3.0) + outer.powf(-2.0 / 3.0)).powf(-1.5)
}

/// Load of the ball at an angle φ from the load line: K max(0, δ cos φ − P_d/2)^1.5, N.
///
/// Arguments: stiffness N/m^1.5, displacement δ m, diametral clearance P_d m, cos φ.
///
/// Source: H. Hertz 1881.
/// Valid: quasi-static; elastic contacts, no centrifugal force.
pub fn ball_load(stiffness: f64, displacement: f64, clearance: f64, cosine: f64) -> f64 {
    let approach = (displacement * cosine - 0.5 * clearance).max(0.0);
    stiffness * approach * approach.sqrt()
}

/// Cosines of the angles of so many balls from the load line, one ball on it.
///
/// Source: definition.
/// Valid: balls at equal angles.
pub fn cosines(balls: usize) -> Vec<f64> {
    let angle = TAU / balls as f64;
    (0..balls).map(|ball| (angle * ball as f64).cos()).collect()
}

/// Displacement at which the balls at angles φ from the load line, given by their cosines, carry a load, m: weight Σ Q cos φ = load, by Newton's
/// method between a displacement at which they carry less and one at which they carry more.
///
/// `weight` is 1 for single balls, Z/n for a continuous zone on n points.
///
/// Source: equilibrium.
/// Valid: load > 0, at
/// least one angle in the loaded half.
pub fn displacement(
    load: f64,
    stiffness: f64,
    clearance: f64,
    cosines: &[f64],
    weight: f64,
) -> f64 {
    // what they carry less the load, over the stiffness, and its slope
    let left = |displacement: f64| {
        let each = cosines.iter().map(|cosine| {
            let approach = (displacement * cosine - 0.5 * clearance).max(0.0);
            let root = approach.sqrt();
            [approach * root * cosine, 1.5 * root * cosine * cosine]
        });
        let [sum, slope] = each.fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
        [weight * sum - load / stiffness, weight * slope]
    };
    let mut high = 0.5 * clearance.abs() + (load / stiffness).powf(2.0 / 3.0);
    for _ in 0..200 {
        if left(high)[0] >= 0.0 {
            break;
        }
        high *= 2.0;
    }
    let (mut low, mut now) = (0.0, high);
    for _ in 0..200 {
        let [excess, slope] = left(now);
        match excess < 0.0 {
            true => low = now,
            false => high = now,
        }
        let newton = now - excess / slope;
        let next = match newton > low && newton < high {
            true => newton,
            false => 0.5 * (low + high),
        };
        if (next - now).abs() <= 4.0 * f64::EPSILON * next {
            return next;
        }
        now = next;
    }
    now
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_balls_carry_the_load_and_preload_spreads_it() {
        let cosines = cosines(10);
        let stiffness = joint_stiffness(2.5e10, 2.2e10);
        let mut largest = f64::INFINITY;
        for clearance in [1e-3, 1e-5, 0.0, -6e-6, -1e-4] {
            let moved = displacement(3000.0, stiffness, clearance, &cosines, 1.0);
            let carried: f64 = cosines
                .iter()
                .map(|&cosine| ball_load(stiffness, moved, clearance, cosine) * cosine)
                .sum();
            assert!((carried / 3000.0 - 1.0).abs() < 1e-12);
            let top = ball_load(stiffness, moved, clearance, 1.0);
            assert!(top < largest || clearance < -1e-5);
            largest = top;
        }
    }
}
