//! A signal over the travel of a line instead of over time, turned back by a slip.
//!
//! Travel is counted in periods of the line as a rolling cage would make it, so that a slip is a frequency whatever the speed: a
//! line at slip s turns back against one at slip r with r − s cycles a period, and one cycle lost or won in a cell of P periods
//! is a slip that is wrong by 1/P.

use crate::shaft::Shaft;
use std::f64::consts::TAU;

/// Speed below which the shaft rests, over its highest.
const REST: f64 = 1e-3;

/// A signal with values at equal times and the shaft it was taken beside.
pub(super) struct Signal<'a> {
    pub(super) first: f64,
    pub(super) interval: f64,
    pub(super) values: &'a [f64],
    /// First value and the one behind the last that are looked at.
    pub(super) part: (usize, usize),
    pub(super) mean: f64,
    pub(super) shaft: &'a Shaft<'a>,
    /// Periods of the line in a turn of the shaft where the cage rolls.
    pub(super) periods: f64,
}

/// Mean of the turned signal over a Hann window in travel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cell {
    /// Real and imaginary part, unit of the signal; half of a line's amplitude.
    pub(super) value: [f64; 2],
    /// Mean time, s.
    pub(super) time: f64,
    /// Number of values of equal weight that would average as much noise away; 0 where there is none.
    pub(super) count: f64,
}

/// Sums of a cell that is not full yet.
#[derive(Clone, Copy, Default)]
struct Sums {
    value: [f64; 2],
    time: f64,
    weight: f64,
    squares: f64,
}

impl Sums {
    fn cell(&self) -> Cell {
        if self.weight <= 0.0 {
            return Cell::default();
        }
        Cell {
            value: self.value.map(|sum| sum / self.weight),
            time: self.time / self.weight,
            count: self.weight * self.weight / self.squares,
        }
    }
}

impl Signal<'_> {
    /// Calls for each value with its time, its travel and the step of travel that it stands for.
    fn visit(&self, mut each: impl FnMut(f64, f64, f64, f64)) {
        let slowest = REST * self.shaft.fastest();
        let per_angle = self.periods / TAU;
        let mut travel = 0.0;
        let mut before: Option<f64> = None;
        for k in self.part.0..self.part.1 {
            let time = self.first + k as f64 * self.interval;
            let angle = self.shaft.angle_at(time);
            if self.shaft.speed_at(time).abs() > slowest {
                let step = before.map_or(0.0, |last| per_angle * (angle - last).abs());
                travel += step;
                each(time, self.values[k] - self.mean, travel, step);
            }
            before = Some(angle);
        }
    }

    /// Travel of the whole, periods.
    pub(super) fn travel(&self) -> f64 {
        let mut whole = 0.0;
        self.visit(|_, _, travel, _| whole = travel);
        whole
    }

    /// The direction in which the shaft turns, 1 or -1.
    pub(super) fn direction(&self) -> f64 {
        let angle = |k: usize| self.shaft.angle_at(self.first + k as f64 * self.interval);
        1f64.copysign(angle(self.part.1.saturating_sub(1)) - angle(self.part.0))
    }

    /// Cells of `overlaps` times `hop` periods, one every `hop` periods, of the signal turned back by a slip over travel.
    pub(super) fn cells(
        &self,
        hop: f64,
        overlaps: usize,
        mut slip: impl FnMut(f64) -> f64,
    ) -> Vec<Cell> {
        let length = hop * overlaps as f64;
        let mut cells: Vec<Cell> = Vec::new();
        // Sums of the cells that hold the present travel: cell n in slot n modulo `overlaps`.
        let mut open = vec![Sums::default(); overlaps];
        let mut turned = 0.0;
        self.visit(|time, value, travel, step| {
            turned += (1.0 - slip(travel)) * step;
            let newest = (travel / hop) as usize;
            while cells.len() + overlaps <= newest {
                let slot = cells.len() % overlaps;
                cells.push(std::mem::take(&mut open[slot]).cell());
            }
            if !value.is_finite() {
                return;
            }
            let (sine, cosine) = (TAU * turned.fract()).sin_cos();
            for n in cells.len()..=newest {
                let place = (travel - n as f64 * hop) / length;
                let weight = (1.0 - (TAU * place).cos()) * step;
                let sums = &mut open[n % overlaps];
                sums.value[0] += weight * value * cosine;
                sums.value[1] -= weight * value * sine;
                sums.time += weight * time;
                sums.weight += weight;
                sums.squares += weight * weight;
            }
        });
        cells
    }
}
