//! The balls of a warm bearing under its radial load.

use crate::clearance::{Seat, ThermalClearance};
use physics::load_zone::{ball_load, cosines, displacement};

/// ΣQ over the radial load of balls without clearance: the integral of cos^1.5 over that of cos^2.5. Source: derived.
const WITHOUT_CLEARANCE: f64 = 1.216;

/// A bearing whose balls share a radial load by the clearance that its temperatures leave.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadZone {
    /// Radial load, N.
    pub load: f64,
    /// Ball and both races in series, over a radial approach, N/m^1.5: at a contact angle α K cos^1.5 α.
    pub stiffness: f64,
    /// Cosine of the contact angle: what of the load of a ball is radial.
    pub radial: f64,
    /// Cosines of the angles of the balls from the load line.
    pub cosines: Vec<f64>,
    /// Clearance over temperatures.
    pub clearance: ThermalClearance,
    /// Nodes of inner ring, balls and outer ring.
    pub nodes: [usize; 3],
    /// Seats of the inner ring on its shaft and of the outer ring in its housing, where they are known.
    pub seats: [Option<Seat>; 2],
    /// Clearance that the inner ring takes as it grows with its speed, over the square of the speed, m s².
    pub growth: f64,
}

impl LoadZone {
    /// Diametral clearance at the temperatures of a network in °C and at a speed of the inner race, rad/s: m; negative: the balls are
    /// preloaded.
    pub fn clearance_at(&self, temperatures: &[f64], speed: f64) -> f64 {
        let [inner, balls, outer] = self.nodes;
        let free = (self.clearance).at(
            temperatures[inner],
            temperatures[balls],
            temperatures[outer],
        );
        free + self.by_seats(temperatures).iter().sum::<f64>() - self.growth * speed * speed
    }
    /// Strains of inner ring, balls and outer ring that grow freely.
    pub fn strains_at(&self, temperatures: &[f64]) -> [f64; 3] {
        let ThermalClearance {
            expansions,
            reference,
            ..
        } = self.clearance;
        [0, 1, 2].map(|k| expansions[k] * (temperatures[self.nodes[k]] - reference))
    }
    /// What both seats have added to it, m.
    pub fn by_seats(&self, temperatures: &[f64]) -> [f64; 2] {
        let reference = self.clearance.reference;
        (self.seats).map(|seat| seat.map_or(0.0, |seat| seat.adds(temperatures, reference)))
    }
    /// What inner ring, balls and outer ring with their seats have added to it, m.
    pub fn changes_at(&self, temperatures: &[f64]) -> [f64; 3] {
        let [inner, balls, outer] = self.nodes.map(|node| temperatures[node]);
        let [inner, balls, outer] = self.clearance.changes(inner, balls, outer);
        let [shaft, housing] = self.by_seats(temperatures);
        [inner + shaft, balls, outer + housing]
    }
    /// A ring that was pressed at the start and is loose at these temperatures: on its shaft, in its housing.
    pub fn loose(&self, temperatures: &[f64]) -> [bool; 2] {
        let reference = self.clearance.reference;
        (self.seats).map(|seat| {
            seat.is_some_and(|seat| {
                seat.interference > 0.0 && seat.at(temperatures, reference) <= 0.0
            })
        })
    }
    /// Load of each ball at a clearance, N.
    pub fn loads(&self, clearance: f64) -> Vec<f64> {
        self.loads_under(self.load, clearance)
    }
    /// The same under another radial load, N.
    pub fn loads_under(&self, load: f64, clearance: f64) -> Vec<f64> {
        let along = load / self.radial;
        let moved = displacement(along, self.stiffness, clearance, &self.cosines, 1.0);
        let loads = self.cosines.iter();
        loads
            .map(|cosine| ball_load(self.stiffness, moved, clearance, *cosine))
            .collect()
    }
    /// The radial load that presses the balls as hard as they are at a clearance, N: W ΣQ/ΣQ_0.
    ///
    /// - `unpreloaded`: ΣQ_0 of the radial load without preload, N; 0 without a load, where ΣQ is shared as without clearance
    pub fn pressing(&self, clearance: f64, unpreloaded: f64) -> f64 {
        let pressed: f64 = self.loads(clearance).iter().sum();
        match unpreloaded > 0.0 {
            true => self.load * pressed / unpreloaded,
            false => pressed / WITHOUT_CLEARANCE,
        }
    }
    /// Load of a ball at each of a number of places around the bearing at a clearance, N: balls that pass by, the load shared by as
    /// many as there are.
    pub fn all_round(&self, clearance: f64, places: usize) -> Vec<f64> {
        let cosines = cosines(places);
        let weight = self.cosines.len() as f64 / places as f64;
        let along = self.load / self.radial;
        let moved = displacement(along, self.stiffness, clearance, &cosines, weight);
        let loads = cosines.iter();
        loads
            .map(|cosine| ball_load(self.stiffness, moved, clearance, *cosine))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::palmgren::Palmgren;

    #[test]
    fn a_preload_of_the_weight_adds_to_any_load_as_the_balls_say() {
        let zone = |load: f64| LoadZone {
            load,
            stiffness: 8.35e9,
            radial: 1.0,
            cosines: cosines(10),
            clearance: ThermalClearance {
                at_reference: 0.0,
                reference: 20.0,
                tracks: [29.65e-3, 42.35e-3],
                ball: 6.35e-3,
                expansions: [11.5e-6; 3],
            },
            nodes: [0, 1, 2],
            seats: [None; 2],
            growth: 0.0,
        };
        let pressing = |load: f64, clearance: f64| {
            let zone = zone(load);
            zone.pressing(clearance, zone.loads(0.0).iter().sum())
        };
        let weight = 39.0;
        for clearance in [-0.4e-6, -4.4e-6, -10e-6, -35e-6] {
            let at_weight = pressing(weight, clearance);
            let law = |exponent: f64| Palmgren {
                viscous_factor: 0.0,
                viscosity: 1e-4,
                pitch_diameter: 36e-3,
                load_factor: 1.0,
                load_exponent: exponent,
                static_load_rating: 1.0,
                preload: (at_weight * at_weight - weight * weight).sqrt(),
            };
            // with exponent 0 M1 is P d_m
            let load = |radial: f64| law(0.0).load_moment(radial) / 36e-3;
            assert!((load(weight) / at_weight - 1.0).abs() < 1e-12);
            for radial in [100.0, 400.0, 2000.0, 5800.0] {
                let ratio = load(radial) / pressing(radial, clearance);
                assert!((ratio - 1.0).abs() < 0.12, "{clearance} {radial} {ratio}");
            }
        }
    }

    #[test]
    fn rings_that_grow_apart_leave_the_load_to_few_balls_and_those_that_close_load_all() {
        let zone = LoadZone {
            load: 100.0,
            stiffness: 8e9,
            radial: 1.0,
            cosines: cosines(10),
            clearance: ThermalClearance {
                at_reference: 5e-6,
                reference: 20.0,
                tracks: [29.65e-3, 42.35e-3],
                ball: 6.35e-3,
                expansions: [11.5e-6; 3],
            },
            nodes: [0, 1, 2],
            seats: [None; 2],
            growth: 0.0,
        };
        let at = |inner: f64| zone.loads(zone.clearance_at(&[inner, inner, 20.0], 0.0));
        let carrying = |loads: &[f64]| loads.iter().filter(|load| **load > 0.0).count();
        assert!(carrying(&at(20.0)) < 6);
        assert_eq!(carrying(&at(60.0)), 10);
        // whatever closes, the radial load is carried
        for inner in [20.0, 60.0] {
            let sum: f64 = at(inner)
                .iter()
                .zip(&zone.cosines)
                .map(|(q, cosine)| q * cosine)
                .sum();
            assert!((sum / 100.0 - 1.0).abs() < 1e-9, "{sum}");
        }
    }
}
