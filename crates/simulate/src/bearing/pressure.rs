//! Hertz pressures by what touches the balls.

use model::system::sampling::Peak;
use physics::hertz::maximum_pressure;
use scenario::Bearing;

/// Hertz pressure in the contacts of a ball per cube root of their load, Pa/N^(1/3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressureFactors {
    /// At the inner and at the outer race.
    pub races: [f64; 2],
    /// Between neighbouring balls; none where a cage keeps them apart.
    pub neighbours: Option<f64>,
}

impl PressureFactors {
    /// Of a bushing, which has no balls.
    pub const NONE: PressureFactors = PressureFactors {
        races: [0.0; 2],
        neighbours: None,
    };
    /// The pressures under the largest loads at the inner and the outer race and between balls, N.
    pub fn pressures(&self, races: [Peak; 2], neighbours: Peak) -> Pressures {
        let [inner, outer] = self.races;
        let of = |factor: f64, load: Peak| maximum_pressure(factor, load.value);
        Pressures {
            races: of(inner, races[0]).max(of(outer, races[1])),
            neighbours: self.neighbours.map(|factor| of(factor, neighbours)),
        }
    }
}

/// Largest Hertz pressures by what touches the balls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressures {
    /// Of balls and races, Pa.
    pub races: f64,
    /// Of neighbouring balls, Pa; none where a cage keeps them apart.
    pub neighbours: Option<f64>,
}

impl Pressures {
    /// Between neighbouring balls, with its limit, Pa.
    pub fn of_neighbours(&self, bearing: &Bearing) -> Option<(f64, f64)> {
        self.neighbours.zip(bearing.neighbour_pressure_limit())
    }
    /// The largest share of a limit: each pressure by the limit of what touches there.
    pub fn share_of_limit(&self, bearing: &Bearing) -> f64 {
        let neighbours = self
            .of_neighbours(bearing)
            .map_or(0.0, |(p, limit)| p / limit);
        (self.races / bearing.hertz_pressure_limit).max(neighbours)
    }
}
