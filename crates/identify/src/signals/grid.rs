//! The times of a measurement, and what the torque is there.
//!
//! A list of values stands for the straight lines between its times. Where a clutch engages and where it locks the speed has a kink
//! and the torque jumps, and a line across either is wrong by far more than the deviations say: at 9000 rad/s² two rows 1.6 ms
//! apart cut 3 rad/s off the corner, which reads as slip of a cage that rolls. So the times are
//!
//! ```text
//!   those of the torque                     every nth where they are many
//!   engagement and lock, and both sides     speed and acceleration are those of the side, the torque by its rate from its side
//!   halves of an interval of the change     as long as speed or torque in its middle lie off the line by half a deviation
//! ```

use measure::speed::Speed;
use measure::torque_sensor::Torque;

/// Most times of the torque that are taken: beyond, neighbours add nothing.
const MOST_TIMES: usize = 20_000;
/// Distance of the rows beside a kink, s: the quickest spin-up changes by 1e-3 rad/s within it.
const SIDE: f64 = 1e-7;
/// Shortest interval that is halved, s: a kink of 10 000 rad/s² is cut off by 0.05 rad/s over it at most.
const SHORTEST: f64 = 2e-5;
/// What a line may be off by, over the deviation.
const OFF: f64 = 0.5;
/// Least deviation of a speed that lines are drawn for, rad/s: that of a shaft at rest.
const LEAST_SPEED: f64 = 0.01;
/// How long behind its end a quick change still bends, over its length.
const SETTLES: f64 = 2.0;

/// Where a value of the torque's lists comes from.
#[derive(Clone, Copy)]
enum Source {
    /// Between an index and the next one: its share.
    Line(usize, f64),
    /// One index, and the time since it, s: a jump lies between it and the next.
    Side(usize, f64),
}

/// Times with the sources of the torque.
pub(super) struct Grid<'a> {
    /// Times, s; rising.
    pub time: Vec<f64>,
    torque: &'a Torque,
    knots: Vec<f64>,
}

impl<'a> Grid<'a> {
    /// The times for a torque and the motion of its shaft.
    pub fn of(torque: &'a Torque, speed: &Speed) -> Grid<'a> {
        let (first, last) = match (torque.time.first(), torque.time.last()) {
            (Some(first), Some(last)) => (*first, *last),
            _ => (0.0, 0.0),
        };
        let inside = |knot: &f64| *knot > first + SIDE && *knot < last - SIDE;
        let change = speed.change;
        let begin = change.map(|change| change.engagement.0);
        let end = change.and_then(|change| change.end).map(|end| end.0);
        let knots: Vec<f64> = begin.into_iter().chain(end).filter(inside).collect();
        let step = torque.time.len().div_ceil(MOST_TIMES).max(1);
        let apart = |time: &f64| knots.iter().all(|knot| (time - knot).abs() > 2.0 * SIDE);
        let mut time: Vec<f64> = (torque.time.iter().copied().step_by(step))
            .filter(apart)
            .chain(
                knots
                    .iter()
                    .flat_map(|knot| [knot - SIDE, *knot, knot + SIDE]),
            )
            .collect();
        time.sort_by(f64::total_cmp);
        let mut grid = Grid {
            time,
            torque,
            knots,
        };
        if let Some(begin) = begin {
            let until = end.map_or(last, |end| end + SETTLES * (end - begin));
            grid.refine(speed, begin, until);
        }
        grid
    }

    /// Halves the intervals between two times, s, in which speed or torque bend.
    fn refine(&mut self, speed: &Speed, from: f64, until: f64) {
        let value = |time: f64| (time, speed.at(time).speed, self.torque_at(time).0);
        let mut finer = Vec::new();
        for pair in self.time.windows(2) {
            if pair[0] < from || pair[1] > until {
                continue;
            }
            let mut open = vec![(value(pair[0]), value(pair[1]))];
            while let Some((left, right)) = open.pop() {
                if right.0 - left.0 < 2.0 * SHORTEST {
                    continue;
                }
                let motion = speed.at(0.5 * (left.0 + right.0));
                let (torque, deviation) = self.torque_at(motion.time);
                let bends = |left: f64, middle: f64, right: f64, deviation: f64| {
                    (0.5 * (left + right) - middle).abs() > OFF * deviation
                };
                let known = motion.speed_uncertainty().max(LEAST_SPEED);
                if bends(left.1, motion.speed, right.1, known)
                    || bends(left.2, torque, right.2, deviation)
                {
                    let middle = (motion.time, motion.speed, torque);
                    finer.push(motion.time);
                    open.push((left, middle));
                    open.push((middle, right));
                }
            }
        }
        self.time.append(&mut finer);
        self.time.sort_by(f64::total_cmp);
    }

    fn source(&self, time: f64) -> Source {
        let times = &self.torque.time;
        let next = times.partition_point(|t| *t <= time);
        let before = next.saturating_sub(1);
        let (Some(&left), Some(&right)) = (times.get(before), times.get(next)) else {
            return Source::Line(before, 0.0);
        };
        let mut between = self
            .knots
            .iter()
            .filter(|knot| left < **knot && **knot <= right);
        match (between.next(), between.next_back()) {
            (Some(first), _) if time < *first => Source::Side(before, time - left),
            (Some(first), last) if time >= *last.unwrap_or(first) => {
                Source::Side(next, time - right)
            }
            _ => Source::Line(before, (time - left) / (right - left)),
        }
    }

    /// Torque and its deviation at a time, N m.
    fn torque_at(&self, time: f64) -> (f64, f64) {
        let torque = self.torque;
        match self.source(time) {
            source @ Source::Line(..) => (
                listed(&torque.torque, source),
                listed(&torque.deviation, source),
            ),
            Source::Side(k, since) => (
                torque.torque[k] + torque.rate[k] * since,
                torque.deviation[k].hypot(torque.rate_deviation[k] * since),
            ),
        }
    }

    /// The torque and its deviation at all times, N m.
    pub fn torques(&self) -> (Vec<f64>, Vec<f64>) {
        self.time.iter().map(|time| self.torque_at(*time)).unzip()
    }

    /// Another list over the times of the torque.
    pub fn values(&self, list: &[f64]) -> Vec<f64> {
        (self.time.iter())
            .map(|time| listed(list, self.source(*time)))
            .collect()
    }
}

fn listed(list: &[f64], source: Source) -> f64 {
    match source {
        Source::Line(k, share) if share > 0.0 => list[k] + share * (list[k + 1] - list[k]),
        Source::Line(k, _) | Source::Side(k, _) => list[k],
    }
}
