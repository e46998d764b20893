//! Whether a bearing runs away during a run.

use super::OfNodes;
use crate::system::sampling::Peak;

/// Time between two looks at how a disturbance grows, s.
const LOOKS: f64 = 50e-3;

/// How fast a disturbance of the temperatures grows at the speed of an instant and under the weight, while the balls are preloaded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Growth {
    /// The largest rate, 1/s; none where the balls never were preloaded.
    pub largest: Option<Peak>,
    /// From when on they run away, the rate there, and the temperatures, °C.
    pub runs_away: Option<(Peak, OfNodes)>,
    /// When it did so no longer, s.
    pub calm: Option<f64>,
    /// Instants and rates, where they are kept.
    pub course: Vec<(f64, f64)>,
    next: f64,
}

impl Growth {
    pub(super) fn look(
        &mut self,
        machine: impl FnOnce() -> Option<f64>,
        (time, nodes): (f64, OfNodes),
        keep: bool,
    ) {
        if time < self.next {
            return;
        }
        self.next = time + LOOKS;
        let Some(rate) = machine() else { return };
        let now = Peak { value: rate, time };
        self.largest.get_or_insert(now).raise(rate, time);
        if rate > 0.0 && self.runs_away.is_none() {
            self.runs_away = Some((now, nodes));
        }
        self.calm = match rate > 0.0 {
            true => None,
            false => self.calm.or(self.runs_away.is_some().then_some(time)),
        };
        if keep {
            self.course.push((time, rate));
        }
    }
    /// The rate at an instant, 1/s; not a number before the balls were preloaded.
    pub fn at(&self, time: f64) -> f64 {
        let past = self.course.partition_point(|(known, _)| *known <= time);
        past.checked_sub(1)
            .map_or(f64::NAN, |last| self.course[last].1)
    }
}
