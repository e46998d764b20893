//! Frequencies over speed, each followed from speed to speed, and the speeds at which one of them equals the speed.
//!
//! At every speed all eigenvalues are computed, and what they were read from is kept while branches pass: a step of their
//! iteration costs n² then, where magnets hold the rotor n³. Each branch is carried on by Newton's iteration from where its
//! last two points lead, with its last vector: crossing branches keep their shapes, not their order. What the iteration finds must be
//! one of the eigenvalues of that speed, and no two branches may take the same; else the nearest that is left is taken.
//! A mode that comes into the range from above is followed back from the highest speed.

use crate::modes::{Analysis, Mode};
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
}

/// A speed at which a mode whirls once a turn.
#[derive(Debug, Clone)]
pub struct Critical {
    /// The speed, rad/s.
    pub speed: f64,
    /// The mode there; its frequency is the speed.
    pub mode: Mode,
    /// Index of its branch.
    pub branch: usize,
}

impl Critical {
    /// Amplification of a single mode, 1/(2ζ); infinite without damping, `None` where the mode grows.
    #[must_use]
    pub fn amplification(&self) -> Option<f64> {
        let ratio = self.mode.damping_ratio();
        // What round-off leaves of no damping has either sign.
        if ratio.abs() < 1e-9 {
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

impl Analysis {
    /// Frequencies up to `limit` (rad/s) over rising speeds (rad/s).
    ///
    /// # Errors
    ///
    /// As [`Analysis::eigenvalues`].
    pub fn campbell(&self, speeds: &[f64], limit: f64) -> Result<Campbell, RotorError> {
        let (mut all, mut taken) = (Vec::new(), Vec::new());
        if let Some(first) = speeds.first() {
            let found = self.oscillations(*first)?;
            taken.push(vec![false; found.len()]);
            all.push(found);
        }
        let mut branches = Vec::new();
        let last = speeds.len().saturating_sub(1);
        for (start, step) in [(0, 1_isize), (last, -1)] {
            let mut runners: Vec<Runner> = Vec::new();
            for (k, value) in all.get(start).into_iter().flatten().enumerate() {
                if taken[start][k] || value.im.abs() > HEADROOM * limit {
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
            let mut at = start;
            while let Some(next) = at.checked_add_signed(step).filter(|n| *n < speeds.len()) {
                // on the way down the eigenvalues are known, and few are left to follow
                let mut triangle = None;
                if next == all.len() {
                    let (found, read_from) = self.followed(speeds[next])?;
                    taken.push(vec![false; found.len()]);
                    all.push(found);
                    triangle = read_from;
                }
                let found = self.carry(
                    speeds[next],
                    (&all[next], triangle.as_ref()),
                    &mut taken[next],
                    &runners,
                )?;
                for (runner, state) in runners.iter_mut().zip(found) {
                    if let Some(state) = &state {
                        runner.step = state.0 - runner.last.0;
                        runner.last.clone_from(state);
                    }
                    runner.states[next] = state;
                }
                at = next;
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
        let dynamics = self.dynamics(speed);
        let vectors: Vec<&DVector<C64>> = runners.iter().map(|runner| &runner.last.1).collect();
        let entered = triangle.map(|triangle| (triangle, triangle.enter(&vectors)));
        let mut out: Vec<Option<State>> = vec![None; runners.len()];
        for (k, runner) in runners.iter().enumerate() {
            let (value, vector) = &runner.last;
            let ahead = value + runner.step;
            let found = [ahead, *value].iter().find_map(|from| {
                let (value, vector) = match &entered {
                    Some((triangle, entered)) => triangle.follow(*from, entered, k)?,
                    None => dynamics.follow(*from, vector)?,
                };
                let same = |(at, z): &(usize, &C64)| {
                    !taken[*at] && (*z - value).norm() <= SAME * value.norm()
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
    /// Between neighbouring speeds of the diagram the crossing is searched to round-off; where a branch comes near the line
    /// and turns away between two speeds, the nearest point is looked at too.
    #[must_use]
    pub fn criticals(&self, diagram: &Campbell) -> Vec<Critical> {
        let mut out = Vec::new();
        for (index, branch) in diagram.branches.iter().enumerate() {
            let gap = |at: usize| {
                let (value, _) = branch.states.get(at)?.as_ref()?;
                Some(value.im.abs() - diagram.speeds[at].abs())
            };
            for at in 1..diagram.speeds.len() {
                let (Some(before), Some(here)) = (gap(at - 1), gap(at)) else {
                    continue;
                };
                let ends = (diagram.speeds[at - 1], diagram.speeds[at]);
                let start = branch.states[at - 1].as_ref();
                let mut crossed = |from: (f64, f64), to: (f64, f64), start: &State| {
                    if let Some((speed, state)) = self.crossing(from, to, start) {
                        out.push(Critical {
                            speed,
                            mode: self.mode(state.0, &state.1, speed),
                            branch: index,
                        });
                    }
                };
                if let Some(start) = start {
                    if (before > 0.0) != (here > 0.0) {
                        crossed((ends.0, before), (ends.1, here), start);
                    } else if let Some(next) = gap(at + 1)
                        && (next > 0.0) == (here > 0.0)
                        && here.abs() < before.abs()
                        && here.abs() < next.abs()
                        && let Some((speed, value, state)) = self.nearest(
                            ends.0,
                            diagram.speeds[at + 1],
                            [before, here, next],
                            start,
                        )
                        && (value > 0.0) != (before > 0.0)
                    {
                        crossed((ends.0, before), (speed, value), start);
                        crossed((speed, value), (diagram.speeds[at + 1], next), &state);
                    }
                }
            }
        }
        out.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        out
    }

    /// The speed between two with gaps of opposite sign at which |Im λ| is the speed.
    fn crossing(&self, from: (f64, f64), to: (f64, f64), start: &State) -> Option<(f64, State)> {
        let ((mut a, mut fa), (mut b, mut fb)) = (from, to);
        let mut state = start.clone();
        // Regula falsi that halves the end that stays (Illinois).
        for _ in 0..80 {
            let speed = (a * fb - b * fa) / (fb - fa);
            state = self.dynamics(speed).follow(state.0, &state.1)?;
            let f = state.0.im.abs() - speed.abs();
            if f.abs() <= 1e-12 * speed.abs() || (b - a).abs() <= 1e-14 * speed.abs() {
                return Some((speed, state));
            }
            if (f > 0.0) == (fb > 0.0) {
                (b, fb) = (speed, f);
                fa *= 0.5;
            } else {
                (a, fa) = (b, fb);
                (b, fb) = (speed, f);
            }
        }
        None
    }

    /// The lowest point of a parabola through the gaps at two speeds and between them, with what the gap is there.
    fn nearest(
        &self,
        from: f64,
        to: f64,
        gaps: [f64; 3],
        start: &State,
    ) -> Option<(f64, f64, State)> {
        let bend = gaps[0] - 2.0 * gaps[1] + gaps[2];
        let step = 0.5 * (to - from);
        let speed = from + step * (1.0 - 0.5 * (gaps[2] - gaps[0]) / bend);
        let state = self.dynamics(speed).follow(start.0, &start.1)?;
        Some((speed, state.0.im.abs() - speed.abs(), state))
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
