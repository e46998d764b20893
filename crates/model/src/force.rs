//! A force from outside on the rotor at a node, over time: its table says it, whatever the rotor does.
//!
//! ```text
//!   F = (F_x(t), F_y(t)) at the geometric centre C; straight between its points, constant beyond them
//! ```
//! Its points are landed. Its work F·Ċ is a signed source; about the mass centre it has the moment of its arm.

use crate::rotor::Node;
use crate::table::{Lines, Table};
use number::{Real, Vec2};

/// A force at a node of the rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceConstants {
    /// Row φ of the node.
    pub node: Vec<f64>,
    /// Along x and along y over time, N over s.
    pub over_time: [Table; 2],
}

impl ForceConstants {
    /// Instants of its points, s.
    pub fn knots(&self) -> impl Iterator<Item = f64> + '_ {
        let points = self.over_time.iter().flat_map(Table::points);
        points.map(|(time, _)| *time)
    }
    /// Numbers of its points: lanes share them.
    pub(crate) fn rows(&self) -> [usize; 2] {
        self.over_time.each_ref().map(|table| table.points().len())
    }
}

/// A force over `R`, at its node.
#[derive(Clone, Debug)]
pub struct Force<R> {
    /// Its node.
    pub node: Node<R>,
    /// Along x and along y.
    pub over_time: [Lines<R>; 2],
}

impl<R: Real> Force<R> {
    /// The force at a time, N.
    #[inline(always)]
    pub fn at(&self, time: R) -> Vec2<R> {
        let [x, y] = &self.over_time;
        Vec2::new(x.value(time), y.value(time))
    }
}
