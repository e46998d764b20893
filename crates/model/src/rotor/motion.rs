//! Motion of a rotor and of its nodes.

use super::constants::RotorConstants;
use number::{Real, Vec2};
use std::ops::Range;

/// Where a rotor of so many coordinates stands in the state of its machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RotorAt {
    /// First channel: x of all coordinates, y, ẋ, ẏ, angle, spin.
    pub first: usize,
    /// Number of coordinates.
    pub coordinates: usize,
    /// Whether it moves along its axis: place and speed behind the spin.
    pub axial: bool,
}

impl RotorAt {
    /// Number of channels.
    #[inline(always)]
    pub fn channels(&self) -> usize {
        4 * self.coordinates + if self.axial { 4 } else { 2 }
    }
    /// Channels of x, y, ẋ or ẏ, blocks 0 to 3, of all coordinates.
    #[inline(always)]
    pub fn block(&self, block: usize) -> Range<usize> {
        let start = self.first + block * self.coordinates;
        start..start + self.coordinates
    }
    /// Channel of the angle.
    #[inline(always)]
    pub fn angle(&self) -> usize {
        self.first + 4 * self.coordinates
    }
    /// Channel of the spin.
    #[inline(always)]
    pub fn spin(&self) -> usize {
        self.angle() + 1
    }
    /// Channel of the place along the axis, where it moves along it; that of the speed follows.
    #[inline(always)]
    pub fn place(&self) -> usize {
        self.spin() + 1
    }
    /// Names of the channels, of a rotor of that name: of a point its own, else those of its modes.
    pub fn names(&self, rotor: &str) -> Vec<String> {
        let mut names = Vec::with_capacity(self.channels());
        for name in ["x", "y", "x_speed", "y_speed"] {
            for k in 1..=self.coordinates {
                names.push(if self.coordinates == 1 {
                    format!("{rotor}.{name}")
                } else {
                    format!("{rotor}.mode_{k}.{name}")
                });
            }
        }
        let along: &[_] = if self.axial { &["z", "z_speed"] } else { &[] };
        let names_of_all = ["angle", "speed"].iter().chain(along);
        names.extend(names_of_all.map(|name| format!("{rotor}.{name}")));
        names
    }
    /// Motion of the rotor in a state.
    #[inline(always)]
    pub fn motion<'a, R: Real>(&self, state: &'a [R]) -> RotorMotion<'a, R> {
        let (sine, cosine) = state[self.angle()].sin_cos();
        RotorMotion {
            position: [&state[self.block(0)], &state[self.block(1)]],
            velocity: [&state[self.block(2)], &state[self.block(3)]],
            sine,
            cosine,
            spin: state[self.spin()],
        }
    }
}

/// Motion of the rotor: η_G in x and y, its rate, the direction of φ, the spin.
#[derive(Clone, Copy, Debug)]
pub struct RotorMotion<'a, R> {
    /// Coordinates, x then y.
    pub position: [&'a [R]; 2],
    /// Their rates.
    pub velocity: [&'a [R]; 2],
    /// sin φ.
    pub sine: R,
    /// cos φ.
    pub cosine: R,
    /// Spin Ω, rad/s.
    pub spin: R,
}

/// The geometric centre C at a node seen from G.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeometricCentre<R> {
    /// C - G, m.
    pub arm: Vec2<R>,
    /// Position of C, m.
    pub position: Vec2<R>,
    /// Speed of C, m/s.
    pub velocity: Vec2<R>,
}

/// So many sums run side by side, because one sum after the other is a long wait.
const WAYS: usize = 4;

/// Products of a row with lists.
#[inline(always)]
pub(super) fn products<R: Real, const K: usize>(row: &[R], lists: [&[R]; K]) -> [R; K] {
    let mut part = [[R::zero(); WAYS]; K];
    let lists = lists.map(|list| &list[..row.len()]);
    let whole = row.len() / WAYS * WAYS;
    for from in (0..whole).step_by(WAYS) {
        for (part, list) in part.iter_mut().zip(&lists) {
            for i in 0..WAYS {
                part[i] += row[from + i] * list[from + i];
            }
        }
    }
    for (i, k) in (whole..row.len()).enumerate() {
        for (part, list) in part.iter_mut().zip(&lists) {
            part[i] += row[k] * list[k];
        }
    }
    let mut sums = [R::zero(); K];
    for (sum, part) in sums.iter_mut().zip(&part) {
        *sum = (part[0] + part[1]) + (part[2] + part[3]);
    }
    sums
}

/// A node of the rotor.
#[derive(Clone, Debug)]
pub struct Node<R> {
    /// Row φ.
    pub row: Vec<R>,
    /// C - G at φ = 0, m.
    arm: Vec2<R>,
    /// Point from which C is counted, m.
    pub datum: Vec2<R>,
}

impl<R: Real> Node<R> {
    /// One node per lane: its rotor, its row, its datum.
    pub fn gather<'a>(
        constants: &dyn Fn(usize) -> (&'a RotorConstants, &'a [f64], Vec2<f64>),
    ) -> Self {
        let vector = |of: &dyn Fn(usize) -> Vec2<f64>| {
            Vec2::new(
                R::from_lanes(|lane| of(lane).x),
                R::from_lanes(|lane| of(lane).y),
            )
        };
        let row = 0..constants(0).1.len();
        Node {
            row: row
                .map(|k| R::from_lanes(|lane| constants(lane).1[k]))
                .collect(),
            arm: vector(&|lane| constants(lane).0.arm(constants(lane).1)),
            datum: vector(&|lane| constants(lane).2),
        }
    }
    /// Its entry of lists over the coordinates, x and y.
    #[inline(always)]
    pub fn along(&self, x: &[R], y: &[R]) -> Vec2<R> {
        let [x, y] = products(&self.row, [x, y]);
        Vec2::new(x, y)
    }
    /// C - G at an angle of the rotor.
    #[inline(always)]
    fn arm(&self, motion: &RotorMotion<R>) -> Vec2<R> {
        let (a, s, c) = (self.arm, motion.sine, motion.cosine);
        Vec2::new(a.x * c - a.y * s, a.x * s + a.y * c)
    }
    /// Position, from the datum, and speed of the geometric centre.
    #[inline(always)]
    pub fn centre(&self, motion: &RotorMotion<R>) -> GeometricCentre<R> {
        let arm = self.arm(motion);
        let ([x, y], [vx, vy]) = (motion.position, motion.velocity);
        let [x, y, vx, vy] = products(&self.row, [x, y, vx, vy]);
        GeometricCentre {
            arm,
            position: Vec2::new(x, y) + arm - self.datum,
            velocity: Vec2::new(vx, vy) + arm.turned() * motion.spin,
        }
    }
    /// Acceleration of the geometric centre, for those of the coordinates: it has the centripetal and the spin-up part of the arm.
    #[inline(always)]
    pub fn acceleration(
        &self,
        centre: &GeometricCentre<R>,
        spin: R,
        [x, y]: [&[R]; 2],
        spin_rate: R,
    ) -> Vec2<R> {
        self.along(x, y) + centre.arm.turned() * spin_rate - centre.arm * spin.square()
    }
    /// Adds a force at the node to lists over the coordinates.
    #[inline(always)]
    pub fn push(&self, force: Vec2<R>, [x, y]: [&mut [R]; 2]) {
        for (shape, (x, y)) in self.row.iter().zip(x.iter_mut().zip(y)) {
            *x += *shape * force.x;
            *y += *shape * force.y;
        }
    }
}
