//! How near each axis comes to instability: S = 1/(1 + L), its peak over a band, and the open loop L.

use crate::plant::Coordinates;
use crate::resolvent::Transfer;
use crate::{C64, ClosedLoop, Pole, Refused, ZERO};
use nalgebra::DMatrix;
use std::f64::consts::{PI, TAU};

/// Points of a grid over a decade.
const PER_DECADE: f64 = 120.0;
/// Distance of grid points from an eigenvalue's frequency, in units of its decay |Re λ|.
const AROUND: [f64; 9] = [-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0];
/// Size of an open loop at ω = 0 from which on it is without bound: an integrator leaves round-off of its inverse.
const INTEGRATES: f64 = 1e6;
/// Relative width at which the search of a peak ends: |S| is flat there, its error is of the square of this.
const WIDTH: f64 = 1e-8;

/// Zones of new and running machines by their largest |S|: least values of B, C and D.
///
/// Source: ISO 14839-3 (from memory, to be verified before it is quoted): A below 3 (9.5 dB), B below 4 (12 dB), C below 5 (14 dB).
pub const ZONES: [f64; 3] = [3.0, 4.0, 5.0];

/// The letter of a largest |S|.
#[must_use]
pub fn zone(peak: f64) -> char {
    let passed = ZONES.iter().filter(|least| peak >= **least).count();
    ['A', 'B', 'C', 'D'][passed]
}

/// A band of frequencies, rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// Lowest, above 0.
    pub from: f64,
    /// Highest.
    pub to: f64,
}

impl Band {
    /// From 1 Hz to three times a speed (rad/s) or 2 kHz, whichever is more.
    ///
    /// Source: ISO 14839-3 (from memory).
    #[must_use]
    pub fn of_speed(speed: f64) -> Self {
        Self {
            from: TAU,
            to: (3.0 * speed.abs()).max(TAU * 2000.0),
        }
    }

    /// Frequencies that miss no peak: a logarithmic grid, and points about |Im λ| of every eigenvalue.
    #[must_use]
    pub fn grid(&self, poles: &[Pole]) -> Vec<f64> {
        let decades = (self.to / self.from).log10();
        let count = (decades * PER_DECADE).ceil().max(2.0) as usize;
        let even =
            (0..=count).map(|k| self.from * 10.0_f64.powf(decades * k as f64 / count as f64));
        let near = poles.iter().flat_map(|pole| {
            let (at, width) = (pole.value.im.abs(), pole.value.re.abs());
            AROUND.map(|step| at + step * width)
        });
        let mut grid: Vec<f64> = even.chain(near).collect();
        grid.retain(|omega| (self.from..=self.to).contains(omega));
        grid.sort_by(f64::total_cmp);
        grid.dedup_by(|a, b| *a - *b <= 1e-9 * *b);
        grid
    }
}

/// The largest |S| of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// |S|.
    pub size: f64,
    /// Its frequency, rad/s.
    pub at: f64,
}

/// S of every sensor axis over a grid.
#[derive(Debug, Clone, Default)]
pub struct Sensitivity {
    /// Frequencies, rad/s.
    pub grid: Vec<f64>,
    /// S of each axis over the grid.
    pub values: Vec<Vec<C64>>,
    /// The largest |S| of each axis, found between the points of the grid.
    pub peaks: Vec<Peak>,
    /// S of each axis below the grid, over rising frequencies from 0 on: gain margins count from there.
    pub below: Vec<Vec<C64>>,
}

/// S of one axis at a time, all others closed, at any frequency: e/d for a signal d added to that of one sensor,
/// S = 1 + c (jω - A)⁻¹ b on the diagonal, c the rows of the sensors and b what d does to the closed loop A.
///
/// That is (1 - P k)⁻¹ with P from force to sensor, k_s in it, and k from sensor to force. Over complex coordinates a real axis has
/// ½(S_c(jω) + conj S_c(-jω)): S_c alone is that of a motion that turns.
pub struct Axes<'a> {
    transfer: Transfer<'a>,
    complex: bool,
}

impl<'a> Axes<'a> {
    /// Of a closed loop.
    pub fn new<T: Coordinates>(closed: &'a ClosedLoop<T>) -> Result<Self, Refused> {
        let sensors = closed.observe.nrows();
        let mut rows = DMatrix::zeros(sensors, closed.states());
        rows.columns_mut(0, closed.plant().size())
            .copy_from(&closed.observe.map(T::complex));
        let columns = closed.disturbance()?.map(T::complex);
        Ok(Self {
            transfer: closed.resolvent().between(&rows, &columns),
            complex: T::COMPLEX,
        })
    }

    /// S of every axis at a frequency, rad/s.
    pub fn at(&self, omega: f64) -> Result<Vec<C64>, Refused> {
        let diagonal = |omega: f64| -> Result<Vec<C64>, Refused> {
            let own = self.transfer.at(C64::new(0.0, omega))?;
            Ok(own.diagonal().iter().map(|value| value + 1.0).collect())
        };
        let plus = diagonal(omega)?;
        if !self.complex {
            return Ok(plus);
        }
        let minus = diagonal(-omega)?;
        let half = |(plus, minus): (&C64, &C64)| (plus + minus.conj()) * 0.5;
        Ok(plus.iter().zip(&minus).map(half).collect())
    }
}

/// The open loop L = 1/S - 1 of an axis with all others closed: its distance from -1 is 1/|S|.
#[must_use]
pub fn open_loop(sensitivity: C64) -> C64 {
    sensitivity.inv() - 1.0
}

impl Sensitivity {
    /// Margins of an axis from ω = 0 to the end of the band.
    #[must_use]
    pub fn margins(&self, axis: usize) -> Margins {
        let [below, values] = [&self.below[axis], &self.values[axis]];
        let open: Vec<C64> = (below.iter().chain(values))
            .map(|s| open_loop(*s))
            .collect();
        margins(&open)
    }

    /// The same with each axis twice: over complex coordinates one stands for two that are alike.
    #[must_use]
    pub fn of_both_axes(self) -> Self {
        let twice = |index: usize| [index, index];
        let all = || (0..self.peaks.len()).flat_map(twice);
        Self {
            values: all().map(|index| self.values[index].clone()).collect(),
            below: all().map(|index| self.below[index].clone()).collect(),
            peaks: all().map(|index| self.peaks[index]).collect(),
            grid: self.grid,
        }
    }

    /// Over a band, with peaks searched about the eigenvalues of the loop.
    pub fn new<T: Coordinates>(
        closed: &ClosedLoop<T>,
        poles: &[Pole],
        band: Band,
    ) -> Result<Self, Refused> {
        let axes = Axes::new(closed)?;
        let grid = band.grid(poles);
        let over = |grid: &[f64]| -> Result<Vec<Vec<C64>>, Refused> {
            let mut values: Vec<Vec<C64>> = Vec::new();
            for omega in grid {
                let row = axes.at(*omega)?;
                values.resize(row.len(), Vec::new());
                for (axis, value) in values.iter_mut().zip(row) {
                    axis.push(value);
                }
            }
            Ok(values)
        };
        let values = over(&grid)?;
        let sizes = poles.iter().map(|pole| pole.value.norm());
        let slowest = sizes.filter(|size| *size > ZERO).fold(band.from, f64::min);
        let slow = Band {
            from: 0.1 * slowest,
            to: band.from,
        };
        let below = over(&[vec![0.0], slow.grid(poles)].concat())?;
        let search = |(axis, values): (usize, &Vec<C64>)| {
            let size = |omega| Ok(axes.at(omega)?[axis].norm());
            largest(&grid, values, size)
        };
        let peaks = values
            .iter()
            .enumerate()
            .map(search)
            .collect::<Result<_, _>>()?;
        Ok(Self {
            grid,
            values,
            peaks,
            below,
        })
    }
}

/// The largest value of a function known on a grid, searched between the neighbours of the best points.
fn largest(
    grid: &[f64],
    values: &[C64],
    size: impl Fn(f64) -> Result<f64, Refused>,
) -> Result<Peak, Refused> {
    let known = |index: usize| values[index].norm();
    let top = (0..grid.len()).map(known).fold(0.0, f64::max);
    let mut best = Peak { size: 0.0, at: 0.0 };
    for index in 0..grid.len() {
        let (before, after) = (index.saturating_sub(1), (index + 1).min(grid.len() - 1));
        let local = known(index) >= known(before) && known(index) >= known(after);
        // a peak between points of a grid this fine stands less than a fifth above the best of them
        if !local || known(index) < top / 1.2 {
            continue;
        }
        let found = golden(grid[before], grid[after], &size)?;
        let own = Peak {
            size: known(index),
            at: grid[index],
        };
        for peak in [own, found] {
            if peak.size > best.size {
                best = peak;
            }
        }
    }
    Ok(best)
}

/// Golden-section search of a maximum.
fn golden(
    mut from: f64,
    mut to: f64,
    size: &impl Fn(f64) -> Result<f64, Refused>,
) -> Result<Peak, Refused> {
    let share = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = (to - share * (to - from), from + share * (to - from));
    let (mut at_low, mut at_high) = (size(low)?, size(high)?);
    while to - from > WIDTH * to {
        if at_low > at_high {
            (to, high, at_high) = (high, low, at_low);
            low = to - share * (to - from);
            at_low = size(low)?;
        } else {
            (from, low, at_low) = (low, high, at_high);
            high = from + share * (to - from);
            at_high = size(high)?;
        }
    }
    let peak = if at_low > at_high {
        (at_low, low)
    } else {
        (at_high, high)
    };
    Ok(Peak {
        size: peak.0,
        at: peak.1,
    })
}

/// Gain margin and phase margin of an open loop over a grid: the least distances from -1 along the real axis and the unit circle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Margins {
    /// Largest factor above 1 that the loop stands, where it crosses the real axis between -1 and 0.
    pub upper_gain: Option<f64>,
    /// Smallest factor below 1 that the loop stands, where it crosses the real axis below -1.
    pub lower_gain: Option<f64>,
    /// Least angle from -1 on the unit circle, rad.
    pub phase: Option<f64>,
}

/// Margins of an open loop L over rising frequencies, the first of which is 0: there L is real, and 1/L(0) is 0 of an integrator.
#[must_use]
pub fn margins(open: &[C64]) -> Margins {
    let mut out = Margins::default();
    let least = |old: Option<f64>, new: f64| Some(old.map_or(new, |old| old.min(new)));
    let most = |old: Option<f64>, new: f64| Some(old.map_or(new, |old| old.max(new)));
    let mut crosses = |real: f64| {
        if real < -1.0 {
            out.lower_gain = most(out.lower_gain, -1.0 / real);
        } else if real < 0.0 {
            out.upper_gain = least(out.upper_gain, -1.0 / real);
        }
    };
    let (at_rest, open) = match open {
        [first, rest @ ..] => (first.re, rest),
        [] => return out,
    };
    if at_rest.abs() < INTEGRATES {
        crosses(at_rest);
    }
    for pair in open.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        if (a.im > 0.0) != (b.im > 0.0) {
            crosses(a.re + (b.re - a.re) * a.im / (a.im - b.im));
        }
    }
    for pair in open.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let (p, q) = (a.norm() - 1.0, b.norm() - 1.0);
        if (p > 0.0) != (q > 0.0) {
            let crossing = a + (b - a) * (p / (p - q));
            out.phase = least(out.phase, PI - crossing.arg().abs());
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_narrower_than_the_grid_is_found_because_its_eigenvalue_is_known() {
        // ζ 1e-4: half width 0.1 rad/s at 1000; a logarithmic grid steps by 20
        let pole = Pole {
            value: C64::new(-0.1, 1007.0),
            turning: 1.0,
        };
        let band = Band { from: 1.0, to: 1e4 };
        let hill = |omega: f64| 1.5 / (1.0 + ((omega - 100.0) / 30.0).powi(2));
        let narrow = |omega: f64| C64::from(0.5) / C64::new(0.1, omega - 1007.03);
        let height = |omega: f64| narrow(omega) + 1.0 + hill(omega);
        let search = |grid: Vec<f64>| {
            let values: Vec<C64> = grid.iter().map(|omega| height(*omega)).collect();
            largest(&grid, &values, |omega| Ok(height(omega).norm())).unwrap()
        };
        let found = search(band.grid(&[pole]));
        assert!(
            (found.size - 6.0 - hill(1007.03)).abs() < 1e-7 && (found.at - 1007.03).abs() < 1e-4
        );
        // a grid alone sees the broad hill
        assert!(search(band.grid(&[])).at < 110.0);
    }

    #[test]
    fn zones_by_their_letters_and_the_band_of_the_standard() {
        let letters: String = [1.0, 2.99, 3.0, 3.9, 4.5, 5.0].map(zone).iter().collect();
        assert_eq!(letters, "AABBCD");
        assert_eq!(Band::of_speed(1256.0).to, TAU * 2000.0);
        assert_eq!(Band::of_speed(-1e4).to, 3e4);
    }

    #[test]
    fn margins_of_a_loop_with_known_crossings() {
        // L = K/(s(s+1)²) has L(j) = -K/2: gain margin 2/K; unstable below nothing, so no lower one
        let open = (0..4000)
            .map(|k| C64::new(0.0, 10.0_f64.powf(-2.0 + 4.0 * f64::from(k) / 4000.0)))
            .map(|s| 0.5 / (s * (s + 1.0) * (s + 1.0)));
        // at rest the integrator has no bound
        let open: Vec<C64> = std::iter::once(C64::from(f64::NAN)).chain(open).collect();
        let found = margins(&open);
        assert!((found.upper_gain.unwrap() - 4.0).abs() < 1e-4);
        assert_eq!(found.lower_gain, None);
        // |L| = 1 at ω(1+ω²) = ½: ω = 0.4238; angle -90° - 2 atan ω
        let expected = PI / 2.0 - 2.0 * 0.423_853_8_f64.atan();
        assert!((found.phase.unwrap() - expected).abs() < 1e-4);
    }
}
