//! The clearance of a warm bearing, and the load of its balls when it has closed.

/// Sizes that decide how the clearance follows the temperatures of rings and balls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThermalClearance {
    /// Diametral clearance P_d at the reference temperature, m.
    pub at_reference: f64,
    /// Reference temperature, °C.
    pub reference: f64,
    /// Track diameters of inner and outer ring, m.
    pub tracks: [f64; 2],
    /// Ball diameter, m.
    pub ball: f64,
    /// Expansion of inner ring, balls and outer ring, 1/K.
    pub expansions: [f64; 3],
}

impl ThermalClearance {
    /// P_d = P_d0 + α_o d_o ΔT_o − α_i d_i ΔT_i − 2 α_b D ΔT_b, m; negative: the balls are preloaded.
    ///
    /// Arguments: temperatures of inner ring, balls and outer ring, °C.
    ///
    /// Source: heat-and-life, section 5; free expansion.
    /// Valid: rings free to grow, each at one temperature.
    pub fn at(&self, inner: f64, balls: f64, outer: f64) -> f64 {
        let [of_inner, of_balls, of_outer] = self.changes(inner, balls, outer);
        self.at_reference + of_outer + of_inner + of_balls
    }

    /// What inner ring, balls and outer ring have added to it, m.
    pub fn changes(&self, inner: f64, balls: f64, outer: f64) -> [f64; 3] {
        let [of_inner, of_balls, of_outer] = self.expansions;
        let [inner_track, outer_track] = self.tracks;
        [
            -of_inner * inner_track * (inner - self.reference),
            -2.0 * of_balls * self.ball * (balls - self.reference),
            of_outer * outer_track * (outer - self.reference),
        ]
    }
}

/// Load of every ball between rings that have closed by a clearance below zero: K (−P_d/2)^1.5, N.
///
/// Argument: stiffness of ball and both races in series, N/m^1.5.
///
/// Source: heat-and-life, section 5; H. Hertz 1881.
/// Valid: elastic contacts.
pub fn preload(stiffness: f64, clearance: f64) -> f64 {
    stiffness * (-0.5 * clearance).max(0.0).powf(1.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: f64 = 11.5e-6;
    const BEARING: ThermalClearance = ThermalClearance {
        at_reference: 5e-6,
        reference: 20.0,
        tracks: [0.02965, 0.04235],
        ball: 0.00635,
        expansions: [STEEL; 3],
    };

    #[test]
    fn uniform_warming_of_steel_closes_nothing() {
        // d_o = d_i + 2D
        assert!((BEARING.at(120.0, 120.0, 120.0) / 5e-6 - 1.0).abs() < 1e-10);
        // with the clearance in d_o as built, it grows as every length does
        let built = ThermalClearance {
            tracks: [0.02965, 0.042355],
            ..BEARING
        };
        let grown = 5e-6 * (1.0 + STEEL * 100.0);
        assert!((built.at(120.0, 120.0, 120.0) / grown - 1.0).abs() < 1e-10);
    }

    #[test]
    fn a_warm_inner_ring_closes_and_hybrid_balls_open() {
        // 10 K more on the inner ring: 3.4 µm, on the balls 1.5 µm
        let closed = BEARING.at(20.0, 20.0, 20.0) - BEARING.at(30.0, 20.0, 20.0);
        assert!((closed - 3.41e-6).abs() < 0.01e-6);
        let balls = BEARING.at(20.0, 20.0, 20.0) - BEARING.at(20.0, 30.0, 20.0);
        assert!((balls - 1.46e-6).abs() < 0.01e-6);
        let hybrid = ThermalClearance {
            expansions: [STEEL, 3.2e-6, STEEL],
            ..BEARING
        };
        let opened = hybrid.at(120.0, 120.0, 120.0) - 5e-6;
        assert!((opened - 10.5e-6).abs() < 0.1e-6, "{opened}");
    }

    #[test]
    fn only_a_closed_bearing_is_preloaded() {
        assert_eq!(preload(8e9, 1e-6), 0.0);
        assert!((preload(8e9, -2e-6) / (8e9 * 1e-6f64.powf(1.5)) - 1.0).abs() < 1e-12);
    }
}
