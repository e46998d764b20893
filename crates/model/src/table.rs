//! A value given by points: straight lines between them, constant beyond the first and the last.
//!
//! Over time a table is evaluated piece by piece: its knots are instants on which a step ends ([`Table::piece`]).
//! Over a speed it is evaluated at once for all lanes ([`Lines`]); lanes share the number of points.

use number::{Gather, Real, constants};
use std::fmt;

/// Points of a piecewise linear function.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    points: Vec<(f64, f64)>,
}

/// Why points make no table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableError {
    /// No points.
    Empty,
    /// A number that is not finite, in the point of this index.
    NotFinite(usize),
    /// The first number of this point is not larger than the one before.
    NotRising(usize),
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TableError::Empty => write!(f, "a table needs a point"),
            TableError::NotFinite(i) => write!(f, "row {} holds no finite number", i + 1),
            TableError::NotRising(i) => {
                write!(f, "row {} does not rise above the row before", i + 1)
            }
        }
    }
}

impl std::error::Error for TableError {}

constants! {
    /// One straight line.
    pub struct Piece {
        /// Where it starts.
        start: R,
        /// Its value there.
        value: R,
        /// Its slope.
        slope: R,
    }
}

impl Piece<f64> {
    /// Zero everywhere.
    pub const NONE: Self = Piece {
        start: 0.0,
        value: 0.0,
        slope: 0.0,
    };
}

impl<R: Real> Piece<R> {
    /// One line per lane.
    pub fn from_lanes(of: &dyn Fn(usize) -> Piece<f64>) -> Self {
        Piece {
            start: R::from_lanes(|lane| of(lane).start),
            value: R::from_lanes(|lane| of(lane).value),
            slope: R::from_lanes(|lane| of(lane).slope),
        }
    }
    /// The value at `x`.
    #[inline(always)]
    pub fn at(&self, x: R) -> R {
        self.value + self.slope * (x - self.start)
    }
}

impl Table {
    /// The same value everywhere.
    pub fn constant(value: f64) -> Self {
        Table {
            points: vec![(0.0, value)],
        }
    }
    /// A table through points whose first numbers rise.
    pub fn through(points: Vec<(f64, f64)>) -> Result<Self, TableError> {
        if points.is_empty() {
            return Err(TableError::Empty);
        }
        for (i, (x, y)) in points.iter().enumerate() {
            if !(x.is_finite() && y.is_finite()) {
                return Err(TableError::NotFinite(i));
            }
            if i > 0 && *x <= points[i - 1].0 {
                return Err(TableError::NotRising(i));
            }
        }
        Ok(Table { points })
    }
    /// The points.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }
    /// The line that holds from `x` until the next knot.
    pub fn piece(&self, x: f64) -> Piece<f64> {
        let next = self.points.partition_point(|point| point.0 <= x);
        let flat = |point: (f64, f64)| Piece {
            start: point.0,
            value: point.1,
            slope: 0.0,
        };
        if next == 0 {
            return flat(self.points[0]);
        }
        let from = self.points[next - 1];
        match self.points.get(next) {
            None => flat(from),
            Some(to) => Piece {
                slope: (to.1 - from.1) / (to.0 - from.0),
                ..flat(from)
            },
        }
    }
    /// The value at `x`.
    pub fn value(&self, x: f64) -> f64 {
        self.piece(x).at(x)
    }
    /// The smallest value.
    pub fn smallest(&self) -> f64 {
        (self.points.iter()).fold(f64::INFINITY, |least, point| least.min(point.1))
    }
    /// The largest value.
    pub fn largest(&self) -> f64 {
        (self.points.iter()).fold(f64::NEG_INFINITY, |most, point| most.max(point.1))
    }
}

/// A table over `R`: the first value, then the rise of each line as far as the argument has come along it.
///
/// y = y_0 + Σ slope_k · min(max(x - x_k, 0), width_k)
#[derive(Clone, Debug)]
pub struct Lines<R> {
    first: R,
    /// Start, width and slope of each line.
    lines: Vec<[R; 3]>,
}

impl<R: Real> Gather<R> for Table {
    type Out = Lines<R>;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> Lines<R>
    where
        Self: 'a,
    {
        let count = machine(0).points.len();
        for lane in 1..R::LANES {
            let same = machine(lane).points.len() == count;
            assert!(same, "lanes share the number of rows of a table");
        }
        let line = |k: usize| {
            let piece = |lane: usize| {
                let (from, to) = (machine(lane).points[k], machine(lane).points[k + 1]);
                [from.0, to.0 - from.0, (to.1 - from.1) / (to.0 - from.0)]
            };
            [0, 1, 2].map(|part| R::from_lanes(|lane| piece(lane)[part]))
        };
        Lines {
            first: R::from_lanes(|lane| machine(lane).points[0].1),
            lines: (0..count - 1).map(line).collect(),
        }
    }
}

impl<R: Real> Lines<R> {
    /// The value at `x`.
    #[inline(always)]
    pub fn value(&self, x: R) -> R {
        let mut value = self.first;
        for [start, width, slope] in &self.lines {
            value += *slope * (x - *start).max(R::zero()).min(*width);
        }
        value
    }
}
