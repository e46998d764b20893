//! Frequencies over speed, each followed from speed to speed, and the speeds at which one of them equals the speed.
//!
//! At every speed all eigenvalues are computed, and what they were read from is kept while branches pass: a step of their
//! iteration costs n² then, where magnets hold the rotor n³. Each branch is carried on by Newton's iteration from where its
//! last two points lead, with its last vector: crossing branches keep their shapes, not their order. What the iteration finds must be
//! one of the eigenvalues of that speed, and no two branches may take the same; else the nearest that is left is taken.
//! A mode that comes into the range from above is followed back from the highest speed.

use crate::modes::{Analysis, Mode, RIGID_BELOW};
use crate::triangle::Triangle;
use crate::{C64, RotorError};
use nalgebra::DVector;

/// One frequency over speed.
#[derive(Debug, Clone)]
pub struct Branch {
    /// Its mode at each speed of the diagram; `None` where it does not oscillate.
    pub modes: Vec<Option<Mode>>,
    /// Eigenvalue (signed) and vector at each speed, in the coordinates of the analysis.
    states: Vec<Option<State>>,
}

type State = (C64, DVector<C64>);

/// A branch on its way from speed to speed.
struct Runner {
    /// Where it was at each speed.
    states: Vec<Option<State>>,
    /// Where it was last.
    last: State,
    /// How far it went in the last step.
    step: C64,
}

/// Frequencies over speed.
#[derive(Debug, Clone)]
pub struct Campbell {
    /// The speeds, rad/s, rising.
    pub speeds: Vec<f64>,
    /// The branches, by rising frequency at the first speed.
    pub branches: Vec<Branch>,
    /// The eigenvalue that grows fastest at each speed, as [`Analysis::growing`].
    pub growing: Vec<Option<C64>>,
    /// Modes that whirl faster than the rotor turns at each speed: with positive Im λ, with negative.
    above: Vec<[usize; 2]>,
}

/// A speed at which a mode whirls once a turn.
#[derive(Debug, Clone)]
pub struct Critical {
    /// The speed, rad/s.
    pub speed: f64,
    /// The mode there; its frequency is the speed.
    pub mode: Mode,
    /// What round-off may leave of no damping, 1/s.
    round_off: f64,
}

impl Critical {
    /// Amplification of a single mode, 1/(2ζ); infinite without damping, `None` where the mode grows.
    #[must_use]
    pub fn amplification(&self) -> Option<f64> {
        let ratio = self.mode.damping_ratio();
        // What round-off leaves of no damping has either sign.
        if ratio.abs() < 1e-9 || self.mode.eigenvalue.re.abs() <= self.round_off {
            return Some(f64::INFINITY);
        }
        (ratio > 0.0).then(|| 0.5 / ratio)
    }

    /// Distance from a range of operating speeds, as a share of its nearer end; zero within.
    #[must_use]
    pub fn separation(&self, from: f64, to: f64) -> f64 {
        if self.speed < from {
            (from - self.speed) / from
        } else if self.speed > to {
            (self.speed - to) / to
        } else {
            0.0
        }
    }
}

/// How far above the range modes are followed, because they may come down into it.
const HEADROOM: f64 = 1.5;
/// Eigenvalues that agree to this share of their size are the same.
const SAME: f64 = 1e-6;
/// Critical speeds within this share of each other are one that two searches found.
const CLOSE: f64 = 1e-9;

/// A branch at a speed.
#[derive(Debug, Clone)]
struct Point {
    speed: f64,
    state: State,
    /// |Im λ| less the speed.
    gap: f64,
}

impl Point {
    fn new(speed: f64, state: State) -> Self {
        let gap = state.0.im.abs() - speed.abs();
        Self { speed, state, gap }
    }

    fn above(&self) -> bool {
        self.gap > 0.0
    }

    /// 1 where Im λ is negative.
    fn sense(&self) -> usize {
        usize::from(self.state.0.im < 0.0)
    }
}

/// How many eigenvalues whirl faster than a speed: with positive Im λ, with negative.
fn above(all: &[C64], speed: f64) -> [usize; 2] {
    let count = |sign: f64| all.iter().filter(|z| sign * z.im > speed.abs()).count();
    [count(1.0), count(-1.0)]
}

impl Analysis {
    /// Frequencies up to `limit` (rad/s) over rising speeds (rad/s).
    ///
    /// # Errors
    ///
    /// As [`Analysis::eigenvalues`].
    pub fn campbell(&self, speeds: &[f64], limit: f64) -> Result<Campbell, RotorError> {
        let (mut all, mut taken) = (Vec::<Vec<C64>>::new(), Vec::new());
        let (mut growing, mut over) = (Vec::new(), Vec::new());
        let mut next = |speed: f64, all: &mut Vec<Vec<C64>>, taken: &mut Vec<Vec<bool>>| {
            let (spectrum, read_from) = self.spectrum(speed)?;
            growing.push(spectrum.growing);
            over.push(above(&spectrum.oscillations, speed));
            taken.push(vec![false; spectrum.oscillations.len()]);
            all.push(spectrum.oscillations);
            Ok::<_, RotorError>(read_from)
        };
        if let Some(first) = speeds.first() {
            next(*first, &mut all, &mut taken)?;
        }
        let mut branches = Vec::new();
        let last = speeds.len().saturating_sub(1);
        // what comes into the range from above, and what was lost on the way, begins where it is seen
        let ends = [(0, HEADROOM), (last, HEADROOM)].into_iter();
        for (start, range) in ends.chain((0..=last).map(|at| (at, 1.0))) {
            let mut runners: Vec<Runner> = Vec::new();
            for (k, value) in all.get(start).into_iter().flatten().enumerate() {
                if taken[start][k] || value.im.abs() > range * limit {
                    continue;
                }
                taken[start][k] = true;
                let state = (*value, self.vector(*value, speeds[start], k)?);
                let mut states = vec![None; speeds.len()];
                states[start] = Some(state.clone());
                runners.push(Runner {
                    states,
                    last: state,
                    step: C64::default(),
                });
            }
            for step in [1, -1_isize] {
                for runner in &mut runners {
                    if let Some(state) = &runner.states[start] {
                        runner.last.clone_from(state);
                    }
                    runner.step = C64::default();
                }
                let mut at = start;
                while let Some(to) = at.checked_add_signed(step).filter(|n| *n < speeds.len()) {
                    // on the way down the eigenvalues are known, and few are left to follow
                    let triangle = match to == all.len() {
                        true => next(speeds[to], &mut all, &mut taken)?,
                        false if runners.is_empty() => break,
                        false => None,
                    };
                    let known = (&all[to][..], triangle.as_ref());
                    let found = self.carry(speeds[to], known, &mut taken[to], &runners)?;
                    for (runner, state) in runners.iter_mut().zip(found) {
                        if let Some(state) = &state {
                            runner.step = state.0 - runner.last.0;
                            runner.last.clone_from(state);
                        }
                        runner.states[to] = state;
                    }
                    at = to;
                }
            }
            branches.extend(runners.into_iter().map(|runner| runner.states));
        }
        let inside = |states: &Vec<Option<State>>| {
            (states.iter().flatten()).any(|(value, _)| value.im.abs() <= limit)
        };
        branches.retain(inside);
        let mut branches: Vec<Branch> = (branches.into_iter())
            .map(|states| self.branch(states, speeds))
            .collect();
        let first = |branch: &Branch| {
            let mode = branch.modes.iter().flatten().next();
            mode.map_or(f64::INFINITY, Mode::frequency)
        };
        branches.sort_by(|a, b| first(a).total_cmp(&first(b)));
        Ok(Campbell {
            speeds: speeds.to_vec(),
            branches,
            growing,
            above: over,
        })
    }

    /// Where each branch goes at the next speed, whose eigenvalues are `all`.
    fn carry(
        &self,
        speed: f64,
        (all, triangle): (&[C64], Option<&Triangle>),
        taken: &mut [bool],
        runners: &[Runner],
    ) -> Result<Vec<Option<State>>, RotorError> {
        let (dynamics, round_off) = (self.dynamics(speed), self.round_off(speed));
        let vectors: Vec<&DVector<C64>> = runners.iter().map(|runner| &runner.last.1).collect();
        let entered = triangle.map(|triangle| (triangle, triangle.enter(&vectors)));
        let mut out: Vec<Option<State>> = vec![None; runners.len()];
        for (k, runner) in runners.iter().enumerate() {
            let (value, vector) = &runner.last;
            let ahead = value + runner.step;
            let found = [ahead, *value].iter().find_map(|from| {
                let (value, vector) = match &entered {
                    Some((triangle, entered)) => triangle.follow(*from, entered, k, round_off)?,
                    None => dynamics.follow(*from, vector, round_off)?,
                };
                let same = |(at, z): &(usize, &C64)| {
                    !taken[*at] && (*z - value).norm() <= SAME * value.norm() + round_off
                };
                let (at, _) = all.iter().enumerate().find(same)?;
                Some((at, vector))
            });
            if let Some((at, vector)) = found {
                taken[at] = true;
                out[k] = Some((all[at], vector));
            }
        }
        if let Some((triangle, _)) = entered {
            let found: Vec<&mut State> = out.iter_mut().flatten().collect();
            let left = triangle.leave(&found.iter().map(|state| &state.1).collect::<Vec<_>>());
            for (state, vector) in found.into_iter().zip(left) {
                state.1 = vector;
            }
        }
        for (k, runner) in runners.iter().enumerate() {
            let (value, _) = &runner.last;
            let ahead = value + runner.step;
            let free = (0..all.len()).filter(|at| !taken[*at]);
            let distance = |at: &usize| (all[*at] - ahead).norm();
            if out[k].is_none()
                && let Some(at) = free.min_by(|a, b| distance(a).total_cmp(&distance(b)))
                && distance(&at) < 0.2 * value.norm()
            {
                taken[at] = true;
                out[k] = Some((all[at], self.vector(all[at], speed, at)?));
            }
        }
        Ok(out)
    }

    fn branch(&self, states: Vec<Option<State>>, speeds: &[f64]) -> Branch {
        let modes = states.iter().zip(speeds).map(|(state, speed)| {
            let (value, vector) = state.as_ref()?;
            Some(self.mode(*value, vector, *speed))
        });
        Branch {
            modes: modes.collect(),
            states,
        }
    }

    /// The speeds at which a mode of the diagram whirls once a turn, of either sense, by rising speed.
    ///
    /// Between neighbouring speeds of the diagram the crossing of a branch is searched to round-off; where a branch comes near the line
    /// and turns away between two speeds, the nearest point is looked at too. As a mode comes below the line or above it only
    /// there, the numbers of modes above it at both speeds say how many there must be: what branches lack is searched by counting.
    ///
    /// # Errors
    ///
    /// As [`Analysis::eigenvalues`], and where one is missing.
    pub fn criticals(&self, diagram: &Campbell) -> Result<Vec<Critical>, RotorError> {
        let mut found: Vec<Point> = Vec::new();
        for branch in &diagram.branches {
            let points: Vec<Point> = (branch.states.iter().zip(&diagram.speeds))
                .filter_map(|(state, speed)| Some(Point::new(*speed, state.clone()?)))
                .collect();
            for (k, pair) in points.windows(2).enumerate() {
                let (from, to) = (&pair[0], &pair[1]);
                if from.above() != to.above() {
                    found.extend(self.crossing(from, to)?);
                } else if let Some(after) = points.get(k + 2)
                    && after.above() == to.above()
                    && to.gap.abs() < from.gap.abs().min(after.gap.abs())
                    && let Some(nearest) = self.nearest(from, to, after)
                    && nearest.above() != to.above()
                {
                    found.extend(self.crossing(from, &nearest)?);
                    found.extend(self.crossing(&nearest, after)?);
                }
            }
        }
        for k in 1..diagram.speeds.len() {
            let end = |at: usize| (diagram.speeds[at], diagram.above[at]);
            for sense in 0..2 {
                self.complete(end(k - 1), end(k), sense, &mut found)?;
            }
        }
        found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        let critical = |point: Point| Critical {
            speed: point.speed,
            mode: self.mode(point.state.0, &point.state.1, point.speed),
            round_off: self.round_off(point.speed),
        };
        Ok(found.into_iter().map(critical).collect())
    }

    /// Adds the critical speeds of a sense that lie between two speeds by their numbers of modes above the line, and are not found yet.
    fn complete(
        &self,
        from: (f64, [usize; 2]),
        to: (f64, [usize; 2]),
        sense: usize,
        found: &mut Vec<Point>,
    ) -> Result<(), RotorError> {
        let lacking = |found: &[Point]| {
            let within = |point: &&Point| {
                point.sense() == sense
                    && point.speed >= from.0 * (1.0 - CLOSE)
                    && point.speed <= to.0 * (1.0 + CLOSE)
            };
            let needed = from.1[sense].abs_diff(to.1[sense]);
            needed.saturating_sub(found.iter().filter(within).count())
        };
        if lacking(found) == 0 {
            return Ok(());
        }
        let middle = 0.5 * (from.0 + to.0);
        let all = self.oscillations(middle)?;
        if to.0 - from.0 > 0.1 * CLOSE * to.0 {
            let there = (middle, above(&all, middle));
            self.complete(from, there, sense, found)?;
            return self.complete(there, to, sense, found);
        }
        let mut near: Vec<&C64> = (all.iter())
            .filter(|z| usize::from(z.im < 0.0) == sense)
            .filter(|z| {
                (z.im.abs() - middle).abs() <= 10.0 * CLOSE * middle + self.round_off(middle)
            })
            .collect();
        near.sort_by(|a, b| {
            (a.im.abs() - middle)
                .abs()
                .total_cmp(&(b.im.abs() - middle).abs())
        });
        for (k, value) in near.iter().take(lacking(found)).enumerate() {
            let state = (**value, self.vector(**value, middle, k)?);
            found.push(Point::new(middle, state));
        }
        // a mode that ceases to oscillate leaves the count without a critical speed
        let ceases = |z: &C64| {
            let least = (self.least_oscillation() * z.norm()).max(RIGID_BELOW);
            z.im.abs() >= middle && (0.5..2.0).contains(&(z.im.abs() / least))
        };
        if lacking(found) > 0 && !self.eigenvalues(middle)?.iter().any(ceases) {
            return Err(RotorError::CriticalMissing(middle));
        }
        Ok(())
    }

    /// The speed between two with gaps of opposite sign at which |Im λ| is the speed; `None` where the branch jumps there.
    fn crossing(&self, from: &Point, to: &Point) -> Result<Option<Point>, RotorError> {
        let (mut a, mut b) = (from.clone(), to.clone());
        let (mut fa, mut fb) = (a.gap, b.gap);
        // Regula falsi that halves the end that stays (Illinois), and the bracket at every third step.
        for step in 0..120 {
            let chord = (a.speed * fb - b.speed * fa) / (fb - fa);
            let inside = a.speed.min(b.speed) < chord && chord < a.speed.max(b.speed);
            let speed = match inside && step % 3 != 2 {
                true => chord,
                false => 0.5 * (a.speed + b.speed),
            };
            if speed == a.speed || speed == b.speed {
                break;
            }
            let Some(point) = self.between(&a, &b, speed)? else {
                return Ok(None);
            };
            if point.gap.abs() <= 1e-12 * speed {
                return Ok(Some(point));
            }
            if point.above() == b.above() {
                fa *= 0.5;
            } else {
                (a, fa) = (b, fb);
            }
            fb = point.gap;
            b = point;
            if (b.speed - a.speed).abs() <= 1e-14 * speed {
                break;
            }
        }
        let best = if a.gap.abs() < b.gap.abs() { a } else { b };
        let exact = best.gap.abs() <= CLOSE * best.speed + self.round_off(best.speed);
        Ok(exact.then_some(best))
    }

    /// A branch between two of its points.
    fn between(&self, a: &Point, b: &Point, speed: f64) -> Result<Option<Point>, RotorError> {
        let share = (speed - a.speed) / (b.speed - a.speed);
        let chord = b.state.0 - a.state.0;
        let expected = a.state.0 + chord * share;
        let nearer = if share < 0.5 { a } else { b };
        let followed =
            self.dynamics(speed)
                .follow(expected, &nearer.state.1, self.round_off(speed));
        let likely =
            |(value, _): &State| (value - expected).norm() <= chord.norm() + 0.01 * value.norm();
        if let Some(state) = followed.filter(likely) {
            return Ok(Some(Point::new(speed, state)));
        }
        let distance = |z: &C64| (z - expected).norm();
        let all = self.oscillations(speed)?;
        let Some(value) = all
            .into_iter()
            .min_by(|x, y| distance(x).total_cmp(&distance(y)))
        else {
            return Ok(None);
        };
        let vector = self.vector(value, speed, 0)?;
        Ok(Some(Point::new(speed, (value, vector))))
    }

    /// The lowest point of a parabola through the gaps at three speeds, evenly apart.
    fn nearest(&self, from: &Point, at: &Point, to: &Point) -> Option<Point> {
        let bend = from.gap - 2.0 * at.gap + to.gap;
        let step = 0.5 * (to.speed - from.speed);
        let speed = from.speed + step * (1.0 - 0.5 * (to.gap - from.gap) / bend);
        let state =
            (self.dynamics(speed)).follow(at.state.0, &at.state.1, self.round_off(speed))?;
        Some(Point::new(speed, state))
    }

    /// Ranges of speed in which a motion grows, of those of a diagram; their ends between its speeds to 1e-9 of the speed.
    ///
    /// # Errors
    ///
    /// As [`Analysis::eigenvalues`].
    pub fn unstable(&self, diagram: &Campbell) -> Result<Vec<(f64, f64)>, RotorError> {
        let mut out: Vec<(f64, f64)> = Vec::new();
        for (k, growing) in diagram.growing.iter().enumerate() {
            let here = diagram.speeds[k];
            let before = k
                .checked_sub(1)
                .map(|k| (diagram.speeds[k], diagram.growing[k].is_some()));
            match before {
                Some((speed, grew)) if grew != growing.is_some() => {
                    let (mut low, mut high) = (speed, here);
                    while high - low > 1e-9 * high {
                        let middle = 0.5 * (low + high);
                        match self.growing(middle)?.is_some() == grew {
                            true => low = middle,
                            false => high = middle,
                        }
                    }
                    match out.last_mut() {
                        Some(last) if grew => last.1 = high,
                        _ => out.push((high, here)),
                    }
                }
                None if growing.is_some() => out.push((here, here)),
                _ => {}
            }
            if let (Some(last), true) = (out.last_mut(), growing.is_some()) {
                last.1 = here;
            }
        }
        Ok(out)
    }

    /// Largest relative difference of modes at a speed from those of another analysis of the same rotor.
    ///
    /// # Errors
    ///
    /// As [`Analysis::eigenvalues`].
    pub fn error_of_modes(&self, modes: &[Mode], speed: f64) -> Result<f64, RotorError> {
        let exact = self.oscillations(speed)?;
        let error = |mode: &Mode| {
            let value = mode.eigenvalue;
            let distance = |z: &C64| (C64::new(z.re, z.im.abs()) - value).norm();
            exact.iter().map(distance).fold(f64::INFINITY, f64::min) / value.norm()
        };
        Ok(modes.iter().map(error).fold(0.0, f64::max))
    }

    /// Largest difference of the eigenvalues of a diagram from those of another analysis of the same rotor at one of its
    /// speeds, relative: what a reduced basis costs.
    ///
    /// # Errors
    ///
    /// As [`Analysis::eigenvalues`].
    pub fn error_of(&self, diagram: &Campbell, at: usize, limit: f64) -> Result<f64, RotorError> {
        let exact = self.oscillations(diagram.speeds[at])?;
        let states = (diagram.branches.iter()).filter_map(|branch| branch.states[at].as_ref());
        let error = |(value, _): &State| {
            let distances = exact.iter().map(|z| (z - value).norm());
            distances.fold(f64::INFINITY, f64::min) / value.norm()
        };
        Ok(states
            .filter(|(value, _)| value.im.abs() <= limit)
            .map(error)
            .fold(0.0, f64::max))
    }
}
