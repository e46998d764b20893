//! How far the centre of a rotor travels in its bearing.

use number::Vec2;
use std::f64::consts::PI;

/// Way of the rotor's geometric centre against that of the inner race, at the points at which the whirl is followed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Travel {
    /// All of it, m.
    pub way: f64,
    /// The longest of one turn of the rotor, m.
    pub longest: f64,
    /// What the rotor has turned, rad.
    pub turned: f64,
    /// Way and angle of this turn.
    turn: [f64; 2],
    /// Instant and place of the last look.
    last: Option<(f64, Vec2<f64>)>,
}

impl Travel {
    /// The centre is at a place, m, at a time, s; the rotor turns with a spin, rad/s.
    pub(super) fn to(&mut self, time: f64, place: Vec2<f64>, spin: f64) {
        if let Some((then, last)) = self.last {
            let piece = [
                (place - last).length_squared().sqrt(),
                spin.abs() * (time - then),
            ];
            self.way += piece[0];
            self.turned += piece[1];
            self.turn = [self.turn[0] + piece[0], self.turn[1] + piece[1]];
            if self.turn[1] >= 2.0 * PI {
                self.longest = self.longest.max(self.turn[0]);
                self.turn = [0.0; 2];
            }
        }
        self.last = Some((time, place));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_once_a_turn_has_its_circumference() {
        let mut travel = Travel::default();
        for look in 0..=200 {
            let angle = 2.0 * PI * f64::from(look) / 64.0;
            let radius = if look < 100 { 1.0 } else { 0.5 };
            let place = Vec2::new(angle.cos(), angle.sin()) * radius;
            travel.to(angle / 100.0, place, -100.0);
        }
        assert!((travel.longest / (2.0 * PI) - 1.0).abs() < 1e-3);
        assert!((travel.turned / (2.0 * PI * 200.0 / 64.0) - 1.0).abs() < 1e-12);
        assert!(travel.way < 200.0 / 64.0 * 2.0 * PI);
    }
}
