//! A force from outside on the rotor at a node, and a torque about its axis, over time: tables say them, whatever the rotor does.
//!
//! ```text
//!   F = (F_x(t), F_y(t)) at the geometric centre C, F_z(t) along the shaft, T(t); straight between their points, constant beyond them
//! ```
//! Its points are landed. A load that comes on the way is constant from its instant on. Its work F·Ċ is a signed source; about the mass centre it
//! has the moment of its arm. The torque is one of those that drive the rotor, T Ω a part of that source.

use crate::rotor::Node;
use crate::table::Table;
use number::{Real, Vec3};

/// A force at a node of the rotor, and a torque.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceConstants {
    /// Row φ of the node.
    pub node: Vec<f64>,
    /// Along x, y and the shaft over time, N over s; the torque, N m over s. A rotor that does not move along the shaft ignores the third.
    pub over_time: [Table; 4],
}

impl ForceConstants {
    /// Instants of its points, s.
    pub fn knots(&self) -> impl Iterator<Item = f64> + '_ {
        let points = self.over_time.iter().flat_map(Table::points);
        points.map(|(time, _)| *time)
    }
}

/// A force over `R`, at its node.
#[derive(Clone, Debug)]
pub struct Force<R> {
    /// Its node.
    pub node: Node<R>,
    /// Along x, y and the shaft and about the axis, of each lane: records have points of their own and many of them.
    pub over_time: Vec<[Table; 4]>,
}

impl<R: Real> Force<R> {
    /// The force, N, and the torque, N m, at a time.
    #[inline(always)]
    pub fn at(&self, time: R) -> (Vec3<R>, R) {
        let [x, y, z, torque] = std::array::from_fn(|k| {
            R::from_lanes(|lane| self.over_time[lane][k].value(time.lane(lane)))
        });
        (Vec3::new(x, y, z), torque)
    }
}
