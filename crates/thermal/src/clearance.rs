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
    /// Source: free expansion.
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

/// A seat of a ring, whose interference follows the temperatures of what is pressed together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seat {
    /// Diametral interference at the reference temperature, m; below 0 the ring is loose.
    pub interference: f64,
    /// Diameter of the seat, m.
    pub diameter: f64,
    /// Nodes of what is inside and outside of it.
    pub nodes: [usize; 2],
    /// Expansion of both, 1/K.
    pub expansions: [f64; 2],
    /// Clearance that the track loses to an interference, over it.
    pub closes: f64,
    /// Pressure on the seat over the interference, Pa/m.
    pub presses: f64,
    /// Interference that is lost when both spin, over the square of their speed, m s².
    pub spins: f64,
}

impl Seat {
    /// Δ = Δ_0 + (α_in ΔT_in − α_out ΔT_out) d, m, at temperatures of the nodes, °C, with the reference temperature.
    ///
    /// Source: derived; book/src/theory/heat.md.
    /// Valid: as [`ThermalClearance::at`].
    pub fn at(&self, temperatures: &[f64], reference: f64) -> f64 {
        self.between(self.nodes.map(|node| temperatures[node]), reference)
    }

    /// The same at the temperatures of what is inside and outside of it, °C.
    pub fn between(&self, temperatures: [f64; 2], reference: f64) -> f64 {
        let [inside, outside] = [0, 1].map(|k| self.expansions[k] * (temperatures[k] - reference));
        self.interference + (inside - outside) * self.diameter
    }

    /// What that adds to the clearance, m.
    pub fn adds(&self, temperatures: &[f64], reference: f64) -> f64 {
        let pressed = self.at(temperatures, reference).max(0.0);
        self.closes * (self.interference.max(0.0) - pressed)
    }
}

/// Load of every ball between rings that have closed by a clearance below zero: K (−P_d/2)^1.5, N.
///
/// Argument: stiffness of ball and both races in series, N/m^1.5.
///
/// Source: H. Hertz 1881.
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
    fn a_seat_takes_no_more_than_it_presses_and_one_of_one_material_nothing_by_warmth_alone() {
        let seat = Seat {
            interference: 4e-6,
            diameter: 47e-3,
            nodes: [0, 1],
            expansions: [STEEL, 23e-6],
            closes: 0.8,
            presses: 0.0,
            spins: 0.0,
        };
        // an aluminium housing as warm as its ring: (11.5 − 23)e-6 · 47 mm · 5 K
        assert!((seat.at(&[25.0, 25.0], 20.0) - (4e-6 - 2.7025e-6)).abs() < 1e-15);
        assert!((seat.adds(&[25.0, 25.0], 20.0) - 0.8 * 2.7025e-6).abs() < 1e-15);
        // once it is loose nothing is left to give
        assert!(seat.at(&[60.0, 60.0], 20.0) < 0.0);
        assert!((seat.adds(&[60.0, 60.0], 20.0) - 3.2e-6).abs() < 1e-15);
        let steel = Seat {
            expansions: [STEEL; 2],
            ..seat
        };
        assert_eq!(steel.adds(&[80.0, 80.0], 20.0), 0.0);
        // the ring warmer than its housing is pressed harder
        assert!(steel.adds(&[40.0, 20.0], 20.0) < 0.0);
    }

    #[test]
    fn only_a_closed_bearing_is_preloaded() {
        assert_eq!(preload(8e9, 1e-6), 0.0);
        assert!((preload(8e9, -2e-6) / (8e9 * 1e-6f64.powf(1.5)) - 1.0).abs() < 1e-12);
    }
}
