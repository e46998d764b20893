//! Samples that no motion makes: a channel that keeps its value, samples that stand alone; another range, scale or zero.

use super::{Compared, NOTHING_COMMON, before, ends, root_mean_square};

/// Deviations from which on a sample stands alone beside its neighbours; noise of 100 000 samples comes to six.
const ALONE: f64 = 8.0;
/// Neighbouring samples of one value that are no chance, and the share of its range that the prediction moves meanwhile.
const HELD: usize = 6;
const MOVES: f64 = 0.05;
/// Share of its noise that a channel beyond the end of its range has at most.
const QUIET: f64 = 0.5;

impl Compared {
    /// The longest stretch of neighbouring samples of one value, or at the end of the channel's range with less than its noise, over which the
    /// prediction moves by more than noise and a share of its range, and beyond that end: how many, the first row, and by how much it moves.
    pub(super) fn held(&self) -> Option<(usize, usize, f64)> {
        let deviation = self.deviation().unwrap_or(0.0);
        let noise = ALONE * deviation;
        let least = noise.max(MOVES * self.range());
        let (lowest, highest) = ends(&self.measured);
        let mut longest: Option<(usize, usize, f64)> = None;
        for within in [0.0, noise] {
            let mut first = 0;
            while first < self.measured.len() {
                let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
                let near = self.measured[first..].iter().take_while(|own| {
                    (low, high) = (low.min(**own), high.max(**own));
                    high - low <= within
                });
                let count = near.count();
                let rows = first..first + count;
                let (own, predicted) = (&self.measured[rows.clone()], ends(&self.predicted[rows]));
                let beyond = own.contains(&highest) && predicted.1 > highest + noise
                    || own.contains(&lowest) && predicted.0 < lowest - noise;
                // a rotor that rests shows the noise of its sensor, one beyond the end of the range less
                let quiet =
                    count >= 2 * HELD && beyond && before::white(own).deviation < QUIET * deviation;
                let moves = predicted.1 - predicted.0;
                let is_held = count >= HELD && moves > least && (within == 0.0 || quiet);
                if is_held && longest.is_none_or(|(samples, ..)| count > samples) {
                    longest = Some((count, first, moves));
                }
                first += count.max(1);
            }
        }
        longest
    }

    /// Ranges of the measured and of the predicted values.
    pub(super) fn ranges(&self) -> [f64; 2] {
        let (low, high) = ends(&self.measured);
        [high - low, self.range()]
    }

    /// Slope and offset of the straight line through the measured over the predicted values, and the share of the difference that it leaves.
    pub(super) fn line(&self) -> Option<[f64; 3]> {
        let of = Some(self.range()).filter(|range| *range > 0.0)?;
        let rows = self.predicted.iter().map(|own| [1.0, own / of]);
        let ([offset, slope], _) = before::solved(rows.collect(), &self.measured)?;
        let (slope, offset) = (slope.value / of, offset.value);
        let both = self.measured.iter().zip(&self.predicted);
        let beside = both.map(|(own, predicted)| own - offset - slope * predicted);
        let left = root_mean_square(beside, NOTHING_COMMON).ok()?;
        Some([slope, offset, left / self.rms().ok()?])
    }

    /// Rows of the samples that stand alone, and by how much.
    pub(super) fn alone(&self, values: &[f64]) -> Vec<(usize, f64)> {
        self.deviation()
            .map_or(Vec::new(), |deviation| alone(values, deviation))
    }
}

/// Rows of the samples that stand alone, and by how much: beside the cubic through two neighbours on each side by more than noise.
pub(super) fn alone(values: &[f64], deviation: f64) -> Vec<(usize, f64)> {
    let five = values.windows(5);
    let beside: Vec<f64> = five
        .map(|own| (own[2] - (4.0 * (own[1] + own[3]) - own[0] - own[4]) / 6.0).abs())
        .collect();
    // beside one that stands alone its neighbours are off as well, by less
    let largest = |row: &usize| {
        let around = &beside[row.saturating_sub(2)..beside.len().min(row + 3)];
        around.iter().all(|own| *own <= beside[*row])
    };
    let far = (0..beside.len()).filter(|row| beside[*row] > ALONE * deviation);
    far.filter(largest)
        .map(|row| (row + 2, beside[row]))
        .collect()
}
