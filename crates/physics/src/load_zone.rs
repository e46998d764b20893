//! Ball loads of a bearing under a radial load, quasi-static.

/// Stiffness of ball and both races in series: (K_i^(−2/3) + K_o^(−2/3))^(−3/2), N/m^1.5.
///
/// Source: H. Hertz 1881, approaches add.
/// Valid: elastic contacts in series.
pub fn joint_stiffness(inner: f64, outer: f64) -> f64 {
    (inner.powf(-2.0 / 3.0) + outer.powf(-2.0 / 3.0)).powf(-1.5)
}

/// Load of the ball at an angle from the load line: K max(0, δ cos φ − P_d/2)^1.5, N.
///
/// Arguments: stiffness N/m^1.5, displacement δ m, diametral clearance P_d m, angle rad.
///
/// Source: H. Hertz 1881.
/// Valid: quasi-static; elastic contacts, no centrifugal force.
pub fn ball_load(stiffness: f64, displacement: f64, clearance: f64, angle: f64) -> f64 {
    let approach = displacement * angle.cos() - 0.5 * clearance;
    stiffness * approach.max(0.0).powf(1.5)
}

/// Displacement at which the balls at the given angles from the load line carry a load, m: weight Σ Q cos φ = load.
///
/// `weight` is 1 for single balls, Z/n for a continuous zone on n points.
///
/// Source: equilibrium.
/// Valid: load > 0, at
/// least one angle in the loaded half.
pub fn displacement(load: f64, stiffness: f64, clearance: f64, angles: &[f64], weight: f64) -> f64 {
    let carried = |displacement: f64| -> f64 {
        angles
            .iter()
            .map(|&angle| ball_load(stiffness, displacement, clearance, angle) * angle.cos())
            .sum::<f64>()
            * weight
    };
    let mut high = 0.5 * clearance.abs() + (load / stiffness).powf(2.0 / 3.0);
    for _ in 0..200 {
        if carried(high) >= load {
            break;
        }
        high *= 2.0;
    }
    let mut low = 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if carried(middle) < load {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn the_balls_carry_the_load_and_preload_spreads_it() {
        let angles: Vec<f64> = (0..10).map(|i| TAU * f64::from(i) / 10.0).collect();
        let stiffness = joint_stiffness(2.5e10, 2.2e10);
        let mut largest = f64::INFINITY;
        for clearance in [1e-5, 0.0, -6e-6] {
            let moved = displacement(3000.0, stiffness, clearance, &angles, 1.0);
            let carried: f64 = angles
                .iter()
                .map(|&angle| ball_load(stiffness, moved, clearance, angle) * angle.cos())
                .sum();
            assert!((carried / 3000.0 - 1.0).abs() < 1e-12);
            let top = ball_load(stiffness, moved, clearance, 0.0);
            assert!(top < largest);
            largest = top;
        }
    }
}
