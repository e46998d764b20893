//! The frame of a bearing in that of its machine: axes D1, D2 and A, origin in the bearing's centre.

use number::Vec3;

/// Axes of a bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// D1, D2 and A, unit vectors.
    pub axes: [Vec3<f64>; 3],
}

/// A quaternion, its scalar first.
pub type Quaternion = (f64, Vec3<f64>);

impl Frame {
    /// The frame whose D1 and D2 are e_x and e_y under the smallest rotation that turns e_z into an axis.
    pub fn along(axis: Vec3<f64>) -> Self {
        let a = axis * axis.length_squared().sqrt().recip();
        let across = a.x * a.x + a.y * a.y;
        if a.z < 0.0 && across < 1e-30 {
            let axes = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
            return Frame {
                axes: axes.map(|[x, y, z]| Vec3::new(x, y, z)),
            };
        }
        // 1/(1 + a_z) without a difference
        let k = if a.z < 0.0 {
            (1.0 - a.z) / across
        } else {
            1.0 / (1.0 + a.z)
        };
        Frame {
            axes: [
                Vec3::new(1.0 - k * a.x * a.x, -k * a.x * a.y, -a.x),
                Vec3::new(-k * a.x * a.y, 1.0 - k * a.y * a.y, -a.y),
                a,
            ],
        }
    }
    /// A vector of the machine in the bearing's frame.
    pub fn inward(&self, v: Vec3<f64>) -> Vec3<f64> {
        let [x, y, z] = self.axes.map(|axis| axis.dot(v));
        Vec3::new(x, y, z)
    }
    /// A vector of the bearing's frame in that of the machine.
    pub fn outward(&self, v: Vec3<f64>) -> Vec3<f64> {
        let [d1, d2, a] = self.axes;
        d1 * v.x + d2 * v.y + a * v.z
    }
    /// The orientation of a body of the machine in the bearing's frame; its length is kept.
    pub fn orientation_inward(&self, q: Quaternion) -> Quaternion {
        let (w, v) = self.rotation();
        product((w, -v), q)
    }
    /// The orientation of a body of the bearing's frame in that of the machine.
    pub fn orientation_outward(&self, q: Quaternion) -> Quaternion {
        product(self.rotation(), q)
    }
    /// The unit quaternion that turns e_x, e_y, e_z into the axes: from the largest of four squares.
    fn rotation(&self) -> Quaternion {
        let [d1, d2, a] = self.axes;
        let squares = [
            1.0 + d1.x + d2.y + a.z,
            1.0 + d1.x - d2.y - a.z,
            1.0 - d1.x + d2.y - a.z,
            1.0 - d1.x - d2.y + a.z,
        ];
        let (x, y, z) = (d2.z - a.y, a.x - d1.z, d1.y - d2.x);
        let largest = (0..4).max_by(|i, j| squares[*i].total_cmp(&squares[*j]));
        let s = squares[largest.unwrap_or(0)];
        let (w, v) = match largest {
            Some(1) => (x, Vec3::new(s, d1.y + d2.x, a.x + d1.z)),
            Some(2) => (y, Vec3::new(d1.y + d2.x, s, d2.z + a.y)),
            Some(3) => (z, Vec3::new(a.x + d1.z, d2.z + a.y, s)),
            _ => (s, Vec3::new(x, y, z)),
        };
        let inverse = (w * w + v.length_squared()).sqrt().recip();
        (w * inverse, v * inverse)
    }
}

fn product((w, v): Quaternion, (u, p): Quaternion) -> Quaternion {
    (w * u - v.dot(p), p * w + v * u + v.cross(p))
}
