//! What a sensor beside a turning part shows of its marks.
//!
//! ```text
//!   u(φ)     number of pitches turned: whole where the middle of a mark is at the sensor, straight between two marks
//!   signal   ½ [1 + tanh(κ cos 2πu)],   from 0 (between two marks) to 1 (on a mark)
//!   passage  of mark k: the signal rises through ½ at u = k - ¼
//! ```
//! Marks are those of a wheel, or the balls in their cage.
//!
//! Does not model: the sensor's own delay; a distance to the marks that changes.

use std::f64::consts::PI;

/// Steepness κ of the flanks: they take a tenth of a pitch.
const STEEPNESS: f64 = 6.0;

/// Marks around a turning part, not quite even.
#[derive(Clone, Debug, PartialEq)]
pub struct Marks {
    /// Place of each mark, in pitches: its number and its error. The first once more at the end, one turn on.
    places: Vec<f64>,
}

impl Marks {
    /// One mark per error; an error is the part of a pitch by which a mark comes late, above -½ and below ½.
    ///
    /// Errors are limited to 0.45 on either side, so that no mark passes its neighbour.
    pub fn new(errors: &[f64]) -> Marks {
        let place = |(number, error): (usize, &f64)| number as f64 + error.clamp(-0.45, 0.45);
        let mut places: Vec<f64> = errors.iter().enumerate().map(place).collect();
        if let Some(first) = places.first().copied() {
            places.push(first + errors.len() as f64);
        }
        Marks { places }
    }

    /// Number of marks.
    pub fn count(&self) -> usize {
        self.places.len().saturating_sub(1)
    }

    /// Pitches turned at an angle, rad: whole where the middle of a mark is at the sensor.
    pub fn pitches(&self, angle: f64) -> f64 {
        let count = self.count() as f64;
        let turned = angle / (2.0 * PI) * count;
        let turns = ((turned - self.places[0]) / count).floor();
        let inside = turned - turns * count;
        let after = (self.places.partition_point(|place| *place <= inside)).clamp(1, self.count());
        let (left, right) = (self.places[after - 1], self.places[after]);
        turns * count + (after - 1) as f64 + (inside - left) / (right - left)
    }

    /// The angle at which so many pitches are turned, rad: the inverse of [`Marks::pitches`].
    pub fn angle(&self, pitches: f64) -> f64 {
        let count = self.count() as f64;
        let turns = (pitches / count).floor();
        let inside = pitches - turns * count;
        let before = (inside as usize).min(self.count() - 1);
        let (left, right) = (self.places[before], self.places[before + 1]);
        let turned = turns * count + left + (inside - before as f64) * (right - left);
        turned / count * (2.0 * PI)
    }

    /// The signal at an angle, rad: from 0 to 1.
    pub fn signal(&self, angle: f64) -> f64 {
        0.5 + 0.5 * (STEEPNESS * (2.0 * PI * self.pitches(angle)).cos()).tanh()
    }

    /// The angle at which the signal rises through ½ for a mark, rad; the number of the mark may be any whole one.
    pub fn rise(&self, mark: i64) -> f64 {
        self.angle(mark as f64 - 0.25)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uneven() -> Marks {
        Marks::new(&[0.1, -0.05, 0.02, 0.0, -0.12])
    }

    #[test]
    fn the_middle_of_a_mark_is_a_whole_pitch() {
        let marks = uneven();
        assert_eq!(marks.count(), 5);
        for (angle, pitches) in [
            (0.1, 0.0),
            (0.95, 1.0),
            (3.88, 4.0),
            (5.1, 5.0),
            (-4.9, -5.0),
        ] {
            let found = marks.pitches(angle / 5.0 * 2.0 * PI);
            assert!((found - pitches).abs() < 1e-12, "{angle}: {found}");
        }
    }

    #[test]
    fn angle_and_pitches_are_inverse_and_rise_together() {
        let marks = uneven();
        let mut before = f64::NEG_INFINITY;
        for k in -400..400 {
            let pitches = 0.0371 * f64::from(k);
            let angle = marks.angle(pitches);
            assert!(angle > before);
            // rounding of a few turns
            assert!((marks.pitches(angle) - pitches).abs() < 1e-12, "{pitches}");
            before = angle;
        }
    }

    #[test]
    fn the_signal_rises_through_its_middle_where_the_passage_is() {
        let marks = uneven();
        for mark in -7..13 {
            let angle = marks.rise(mark);
            assert!((marks.signal(angle) - 0.5).abs() < 1e-9);
            assert!(marks.signal(angle + 1e-3) > 0.5 && marks.signal(angle - 1e-3) < 0.5);
        }
    }

    #[test]
    fn one_mark_is_seen_once_a_turn() {
        let marks = Marks::new(&[0.0]);
        let rises = (0..1000)
            .map(|k| marks.signal(0.02 * f64::from(k)))
            .collect::<Vec<_>>();
        let count = rises.windows(2).filter(|w| w[0] < 0.5 && w[1] >= 0.5);
        // 20 rad are 3.18 turns
        assert_eq!(count.count(), 3);
    }
}
