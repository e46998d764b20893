//! A measured friction moment over speed, as a curve through the points.
//!
//! ```text
//!   M │            ·───── constant beyond the last point
//!     │        · ╱
//!     │ ──·───·        between points a cubic that rises and falls only where the points do
//!     │╱  first point: constant below it, fading to 0 at rest with tanh(Ω/0.1 rad/s)
//!     └──────────────── |Ω|
//! ```
//! The curve is odd in speed and has a continuous slope between its first and last point. At its ends it goes on
//! constant: a slope is never extrapolated. [`MomentCurve::range`] are the speeds between which it was measured.
//!
//! Not modelled: load and temperature; the curve holds for those it was measured at.

use crate::palmgren::fading;
use number::{Gather, Real};

/// Most points of a curve: each costs a comparison in every evaluation.
pub const MOST_POINTS: usize = 200;

number::constants! {
    /// A cubic between two points: M = value + t (first + t (second + t third)), t = |Ω| - start.
    pub struct CurvePiece {
        /// Speed at its start, rad/s.
        start: R,
        /// Moment at its start, N m.
        value: R,
        /// Slope at its start, N m s.
        first: R,
        /// Coefficient of t², N m s².
        second: R,
        /// Coefficient of t³, N m s³.
        third: R,
    }
}

/// A measured moment over speed.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentCurve<R> {
    /// The pieces, by rising speed.
    pieces: Vec<CurvePiece<R>>,
    /// Speed of the last point, rad/s.
    last: R,
}

impl MomentCurve<f64> {
    /// Multiplies the moment.
    pub(crate) fn scale(&mut self, factor: f64) {
        for piece in &mut self.pieces {
            for coefficient in [
                &mut piece.value,
                &mut piece.first,
                &mut piece.second,
                &mut piece.third,
            ] {
                *coefficient *= factor;
            }
        }
    }

    /// The curve through measured points (speed in rad/s, moment in N m).
    ///
    /// Formula: cubic Hermite pieces; slope at an inner point the weighted harmonic mean of its neighbouring secants,
    /// 0 where they differ in sign; at the ends from three points, limited
    ///
    /// - `points`: speeds from 0, strictly rising; moments not negative
    ///
    /// Source: F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300 (from memory).
    /// Valid: 2 to [`MOST_POINTS`] points; monotone between two points, so never negative.
    pub fn through(points: &[(f64, f64)]) -> Result<Self, String> {
        validate(points)?;
        let width: Vec<f64> = points.windows(2).map(|p| p[1].0 - p[0].0).collect();
        let secant: Vec<f64> = points
            .windows(2)
            .map(|p| (p[1].1 - p[0].1) / (p[1].0 - p[0].0))
            .collect();
        let slope = slopes(&width, &secant);
        let pieces: Vec<_> = (0..width.len())
            .map(|k| CurvePiece {
                start: points[k].0,
                value: points[k].1,
                first: slope[k],
                second: (3.0 * secant[k] - 2.0 * slope[k] - slope[k + 1]) / width[k],
                third: (slope[k] + slope[k + 1] - 2.0 * secant[k]) / (width[k] * width[k]),
            })
            .collect();
        let steep = pieces.iter().position(|piece| !piece.third.is_finite());
        if let Some(point) = steep {
            return Err(not_finite(point));
        }
        Ok(MomentCurve {
            pieces,
            last: points[points.len() - 1].0,
        })
    }

    /// Least and largest speed measured, rad/s.
    ///
    /// Source: the points.
    /// Valid: always.
    pub fn range(&self) -> (f64, f64) {
        (self.pieces[0].start, self.last)
    }
}

impl<R: Real> MomentCurve<R> {
    /// The moment, N m; it has the sign of the speed and vanishes at rest.
    ///
    /// Formula: M = M(clamp |Ω|) tanh(Ω/0.1 rad/s)
    ///
    /// - `speed`: Ω, rad/s, either sign
    ///
    /// Source: the measured points.
    /// Valid: between the first and last point; beyond them the moment of the nearest is returned.
    #[inline(always)]
    pub fn moment(&self, speed: R) -> R {
        let size = speed.abs().max(self.pieces[0].start).min(self.last);
        let mut piece = self.pieces[0];
        for next in &self.pieces[1..] {
            let beyond = size.greater(next.start);
            piece.start = R::select(beyond, next.start, piece.start);
            piece.value = R::select(beyond, next.value, piece.value);
            piece.first = R::select(beyond, next.first, piece.first);
            piece.second = R::select(beyond, next.second, piece.second);
            piece.third = R::select(beyond, next.third, piece.third);
        }
        let t = size - piece.start;
        let moment = piece.value + t * (piece.first + t * (piece.second + t * piece.third));
        // a rounding below a point at zero must not turn the sign
        moment.max(R::zero()) * fading(speed)
    }
}

impl<R: Real> Gather<R> for MomentCurve<f64> {
    type Out = MomentCurve<R>;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> MomentCurve<R>
    where
        Self: 'a,
    {
        let count = machine(0).pieces.len();
        for lane in 1..R::LANES {
            assert!(
                machine(lane).pieces.len() == count,
                "lanes share the number of points"
            );
        }
        MomentCurve {
            pieces: (0..count)
                .map(|k| Gather::<R>::gather(&|lane| &machine(lane).pieces[k]))
                .collect(),
            last: R::from_lanes(|lane| machine(lane).last),
        }
    }
}

fn not_finite(point: usize) -> String {
    format!("point {}: not finite", point + 1)
}

/// Why points make no curve.
fn validate(points: &[(f64, f64)]) -> Result<(), String> {
    let found = points.len();
    if found < 2 {
        return Err(format!("{found} points; a curve needs at least two"));
    }
    if found > MOST_POINTS {
        return Err(format!(
            "{found} points; at most {MOST_POINTS} are possible"
        ));
    }
    let mut before = f64::NEG_INFINITY;
    for (k, &(speed, moment)) in points.iter().enumerate() {
        let point = k + 1;
        if !(speed.is_finite() && moment.is_finite()) {
            return Err(not_finite(k));
        }
        if speed < 0.0 {
            return Err(format!(
                "point {point}: speed {speed} rad/s; the curve is given for speeds from 0 and holds for both directions"
            ));
        }
        if speed <= before {
            return Err(format!(
                "point {point}: speed {speed} rad/s is not above the one before it"
            ));
        }
        // it would drive the bearing
        if moment < 0.0 {
            return Err(format!(
                "point {point}: moment {moment} N m at a positive speed would create energy"
            ));
        }
        before = speed;
    }
    Ok(())
}

/// Slopes at the points that keep the cubics monotone between them.
fn slopes(width: &[f64], secant: &[f64]) -> Vec<f64> {
    let last = secant.len() - 1;
    if last == 0 {
        return vec![secant[0]; 2];
    }
    let mut slope = vec![end_slope(width[0], width[1], secant[0], secant[1])];
    for k in 0..last {
        let (before, after) = (secant[k], secant[k + 1]);
        slope.push(if before * after > 0.0 {
            let (w1, w2) = (2.0 * width[k + 1] + width[k], width[k + 1] + 2.0 * width[k]);
            (w1 + w2) / (w1 / before + w2 / after)
        } else {
            0.0
        });
    }
    slope.push(end_slope(
        width[last],
        width[last - 1],
        secant[last],
        secant[last - 1],
    ));
    slope
}

/// Slope at an end from its own and the next secant: of the parabola, within 0 and 3 times its own secant.
fn end_slope(width: f64, next_width: f64, secant: f64, next_secant: f64) -> f64 {
    let parabola =
        ((2.0 * width + next_width) * secant - width * next_secant) / (width + next_width);
    if parabola * secant <= 0.0 {
        0.0
    } else if parabola.abs() > 3.0 * secant.abs() {
        3.0 * secant
    } else {
        parabola
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use number::{Dual, Gather};
    use proptest::prelude::*;

    const MEASURED: [(f64, f64); 6] = [
        (2.0, 0.020),
        (10.0, 0.015),
        (30.0, 0.015),
        (80.0, 0.021),
        (150.0, 0.025),
        (400.0, 0.040),
    ];
    fn curve() -> MomentCurve<f64> {
        MomentCurve::through(&MEASURED).unwrap()
    }

    #[test]
    fn passes_its_points_and_is_odd() {
        for (speed, moment) in MEASURED {
            // the fading leaves 1e-17 at 2 rad/s; a cubic rounds
            assert!((curve().moment(speed) - moment).abs() < 1e-16, "{speed}");
            assert_eq!(curve().moment(-speed), -curve().moment(speed));
        }
        assert_eq!(curve().moment(0.0), 0.0);
    }
    #[test]
    fn keeps_the_shape_of_its_points() {
        let curve = curve();
        for pair in MEASURED.windows(2) {
            let (low, high) = (pair[0].1.min(pair[1].1), pair[0].1.max(pair[1].1));
            let mut last = curve.moment(pair[0].0);
            for step in 1..=100 {
                let speed = pair[0].0 + (pair[1].0 - pair[0].0) * f64::from(step) / 100.0;
                let moment = curve.moment(speed);
                assert!((low - 1e-16..=high + 1e-16).contains(&moment), "{speed}");
                // it rises and falls only where the points do
                assert!(
                    (moment - last) * (pair[1].1 - pair[0].1) >= -1e-18,
                    "{speed}"
                );
                last = moment;
            }
        }
    }
    #[test]
    fn the_slope_is_continuous_inside_and_follows_the_dual() {
        let curve = curve();
        let dual: MomentCurve<Dual<1>> = Gather::gather(&|_| &curve);
        let slope = |speed: f64| dual.moment(Dual::variable(speed, 0)).partial[0];
        for (speed, _) in &MEASURED[1..5] {
            let (before, after) = (slope(speed - 1e-9), slope(speed + 1e-9));
            // the second derivative is below 1e-3 N m s² here
            assert!((before - after).abs() < 1e-11, "{speed}: {before} {after}");
        }
        for speed in [5.0, 77.0, 200.0] {
            let difference = (curve.moment(speed + 1e-4) - curve.moment(speed - 1e-4)) / 2e-4;
            assert!((slope(speed) - difference).abs() < 1e-9);
        }
    }
    #[test]
    fn a_straight_line_and_two_points_are_met_exactly() {
        let line = MomentCurve::through(&[(0.0, 0.01), (50.0, 0.02), (200.0, 0.05)]).unwrap();
        for speed in [7.0, 50.0, 120.0, 199.0] {
            assert!((line.moment(speed) - (0.01 + 2e-4 * speed)).abs() < 1e-17);
        }
        let two = MomentCurve::through(&[(10.0, 0.01), (20.0, 0.03)]).unwrap();
        assert!((two.moment(15.0) - 0.02).abs() < 1e-17);
    }
    #[test]
    fn beyond_its_points_it_stays_constant_and_says_so() {
        let curve = curve();
        assert_eq!(curve.moment(5e3), curve.moment(400.0));
        assert!((curve.moment(1.5) - 0.020).abs() < 1e-14);
        assert_eq!(curve.range(), (2.0, 400.0));
    }
    #[test]
    fn points_that_make_no_curve_are_refused() {
        let refused = |points: &[(f64, f64)]| MomentCurve::through(points).unwrap_err().to_string();
        for (points, why) in [
            (vec![(1.0, 0.1)], "1 points; a curve needs at least two"),
            (
                vec![(1.0, 0.1), (1.0, 0.2)],
                "point 2: speed 1 rad/s is not above",
            ),
            (
                vec![(2.0, 0.1), (1.0, 0.2)],
                "point 2: speed 1 rad/s is not above",
            ),
            (vec![(1.0, 0.1), (2.0, -0.2)], "would create energy"),
            (vec![(-1.0, 0.1), (2.0, 0.2)], "holds for both directions"),
            (vec![(1.0, f64::NAN), (2.0, 0.2)], "point 1: not finite"),
            (
                vec![(1.0, 0.1), (f64::INFINITY, 0.2)],
                "point 2: not finite",
            ),
            (vec![(0.0, 0.0), (1e-300, 1e300)], "point 1: not finite"),
            (vec![(0.0, 0.0); 300], "at most 200"),
        ] {
            let found = refused(&points);
            assert!(found.contains(why), "{found}");
        }
    }

    proptest! {
        #[test]
        fn never_negative_never_beyond_its_points(
            steps in proptest::collection::vec((0.01..50.0_f64, 0.0..1.0_f64), 2..20),
            at in 0.0..1.2_f64,
        ) {
            let mut speed = 0.0;
            let points: Vec<_> = steps
                .iter()
                .map(|(step, moment)| {
                    speed += step;
                    (speed, *moment)
                })
                .collect();
            let curve = MomentCurve::through(&points).unwrap();
            let moment = curve.moment(at * speed);
            let largest = points.iter().map(|point| point.1).fold(0.0, f64::max);
            prop_assert!(moment >= 0.0 && moment <= largest * (1.0 + 1e-12));
        }
    }
}
