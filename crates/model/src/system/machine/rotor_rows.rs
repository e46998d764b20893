//! The rotor in the border of a linearly implicit step.
//!
//! ```text
//!   coordinate k     S_k u_v = R̂ + Σ φ_bk F_b       S = m G + d + m ω²/G,  R̂ = m R_v - (m ω²/G) R_q,  u_q = (R_q + u_v)/G
//!
//!   no more coordinates than bearings     the rows are the coordinates:   S on the diagonal, R̂ on the right
//!   more                                  the rows are the velocities v of the nodes:
//!                                         v = v0 + A F,  A_bc = Σ φ_bk φ_ck/S_k,  v0_b = Σ φ_bk R̂_k/S_k
//!                                         A⁻¹ in the border, A⁻¹v0 on the right;   then F = A⁻¹(v - v0), and u_v from it
//! ```
//! All x, then all y. F_b is the force of the contact at node b; both forms are the same step. d is the diagonal of D_e + D_i.

use crate::bearing::tangents::ROWS;
use crate::rotor::{Node, Rotor, RotorAt};
use crate::system::border::{factor, solve};
use number::{Real, Vec2};

/// A row of the border that a contact touches.
#[derive(Clone, Copy, Debug)]
pub struct Touched<R> {
    /// The row.
    pub row: usize,
    /// Entry of the contact's direction: node x and y, spin, three of the inner race.
    pub entry: usize,
    /// What the row's velocity makes of that entry.
    pub shape: R,
}

/// The rows, and what they need of a step.
#[derive(Debug)]
pub struct RotorRows<R: Real> {
    /// Number of coordinates or nodes: rows of each plane.
    planes: usize,
    /// Whether the rows are the coordinates.
    of_coordinates: bool,
    /// Rows that the contact of each bearing touches, rising.
    touched: Vec<Vec<Touched<R>>>,
    /// m ω²/G and 1/S of each coordinate.
    spring: Vec<R>,
    inverse: Vec<R>,
    /// A, then its factors; A⁻¹ whole.
    compliance: Vec<R>,
    inverse_compliance: Vec<R>,
    /// v0 of each node, x and y.
    free: [Vec<R>; 2],
}

/// Share of the diagonal of A added to it: nodes that are one, or move as one, stay one.
const SEPARATE: f64 = 1e-9;

impl<R: Real> RotorRows<R> {
    /// Room for a rotor with a node in each bearing.
    pub fn new(nodes: &[Node<R>]) -> Self {
        let coordinates = nodes[0].row.len();
        let of_coordinates = coordinates <= nodes.len();
        let planes = coordinates.min(nodes.len());
        let one = |row, entry| Touched {
            row,
            entry,
            shape: R::one(),
        };
        let touched = |(k, node): (usize, &Node<R>)| {
            let mut rows = Vec::new();
            for plane in 0..2 {
                if of_coordinates {
                    let shapes = node.row.iter().enumerate();
                    rows.extend(shapes.map(|(j, shape)| Touched {
                        shape: *shape,
                        ..one(plane * planes + j, plane)
                    }));
                } else {
                    rows.push(one(plane * planes + k, plane));
                }
            }
            let spin = 2 * planes;
            let race = spin + 1 + ROWS * k;
            rows.push(one(spin, 2));
            rows.extend((0..3).map(|j| one(race + j, 3 + j)));
            rows
        };
        let zeros = |length: usize| vec![R::zero(); length];
        let square = if of_coordinates { 0 } else { planes * planes };
        RotorRows {
            planes,
            of_coordinates,
            touched: nodes.iter().enumerate().map(touched).collect(),
            spring: zeros(coordinates),
            inverse: zeros(coordinates),
            compliance: zeros(square),
            inverse_compliance: zeros(square),
            free: [zeros(planes), zeros(planes)],
        }
    }
    /// Number of rows, that of the spin the last.
    pub fn count(&self) -> usize {
        2 * self.planes + 1
    }
    /// Row of the spin.
    #[inline(always)]
    pub fn spin(&self) -> usize {
        2 * self.planes
    }
    /// First row of a bearing.
    #[inline(always)]
    pub fn of_bearing(&self, k: usize) -> usize {
        2 * self.planes + 1 + ROWS * k
    }
    /// Rows that the contact in a bearing touches.
    #[inline(always)]
    pub fn touched(&self, k: usize) -> &[Touched<R>] {
        &self.touched[k]
    }

    /// Writes the rows' entries among themselves into a border of `n` rows, but for that of the spin.
    #[inline(always)]
    pub fn factor(
        &mut self,
        rotor: &Rotor<R>,
        nodes: &[Node<R>],
        [g, inverse_g]: [R; 2],
        border: &mut [R],
        n: usize,
    ) {
        let planes = self.planes;
        for k in 0..rotor.mass.len() {
            let spring = rotor.stiffness[k] * inverse_g;
            let own = g * rotor.mass[k] + (rotor.damping[k] + spring);
            self.spring[k] = spring;
            if self.of_coordinates {
                border[k * (n + 1)] = own;
                border[(planes + k) * (n + 1)] = own;
            } else {
                self.inverse[k] = own.recip();
            }
        }
        if self.of_coordinates {
            return;
        }
        for b in 0..planes {
            for c in 0..=b {
                let mut sum = R::zero();
                let shapes = nodes[b].row.iter().zip(&nodes[c].row);
                for ((first, second), inverse) in shapes.zip(&self.inverse) {
                    sum += *first * *second * *inverse;
                }
                self.compliance[b * planes + c] = sum;
            }
            self.compliance[b * (planes + 1)] *= R::splat(1.0 + SEPARATE);
        }
        factor(&mut self.compliance, planes);
        for c in 0..planes {
            let column = &mut self.inverse_compliance[c * planes..(c + 1) * planes];
            for (b, entry) in column.iter_mut().enumerate() {
                *entry = if b == c { R::one() } else { R::zero() };
            }
            solve(&self.compliance, planes, column);
        }
        for b in 0..planes {
            for c in 0..=b {
                let entry = self.inverse_compliance[b * planes + c];
                border[b * n + c] = entry;
                border[(planes + b) * n + planes + c] = entry;
            }
        }
    }

    /// R̂ of a coordinate.
    #[inline(always)]
    fn known(&self, rotor: &Rotor<R>, at: &RotorAt, side: &[R], k: usize) -> Vec2<R> {
        let of = |block: usize| side[at.block(block).start + k];
        let (mass, spring) = (rotor.mass[k], self.spring[k]);
        Vec2::new(mass * of(2) - spring * of(0), mass * of(3) - spring * of(1))
    }

    /// Writes the rows' right-hand sides, but for that of the spin.
    #[inline(always)]
    pub fn side(
        &mut self,
        rotor: &Rotor<R>,
        nodes: &[Node<R>],
        at: &RotorAt,
        side: &[R],
        border: &mut [R],
    ) {
        let planes = self.planes;
        if self.of_coordinates {
            for k in 0..planes {
                let known = self.known(rotor, at, side, k);
                border[k] = known.x;
                border[planes + k] = known.y;
            }
            return;
        }
        for b in 0..planes {
            self.free[0][b] = R::zero();
            self.free[1][b] = R::zero();
        }
        for k in 0..rotor.mass.len() {
            let free = self.known(rotor, at, side, k) * self.inverse[k];
            for (b, node) in nodes.iter().enumerate() {
                self.free[0][b] += node.row[k] * free.x;
                self.free[1][b] += node.row[k] * free.y;
            }
        }
        for b in 0..planes {
            let mut sum = Vec2::zero();
            for c in 0..planes {
                let entry = self.inverse_compliance[b * planes + c];
                sum += Vec2::new(self.free[0][c], self.free[1][c]) * entry;
            }
            border[b] = sum.x;
            border[planes + b] = sum.y;
        }
    }

    /// u of all coordinates and of their rates from the u of the rows.
    #[inline(always)]
    pub fn follow(
        &mut self,
        rotor: &Rotor<R>,
        nodes: &[Node<R>],
        at: &RotorAt,
        border: &[R],
        (side, inverse_g): (&mut [R], R),
    ) {
        let planes = self.planes;
        if !self.of_coordinates {
            // what the nodes do beyond the free answer, as forces in its place
            for b in 0..planes {
                self.free[0][b] = border[b] - self.free[0][b];
                self.free[1][b] = border[planes + b] - self.free[1][b];
            }
            solve(&self.compliance, planes, &mut self.free[0]);
            solve(&self.compliance, planes, &mut self.free[1]);
        }
        for k in 0..rotor.mass.len() {
            let velocity = if self.of_coordinates {
                Vec2::new(border[k], border[planes + k])
            } else {
                let mut sum = self.known(rotor, at, side, k);
                for (b, node) in nodes.iter().enumerate() {
                    sum.x += node.row[k] * self.free[0][b];
                    sum.y += node.row[k] * self.free[1][b];
                }
                sum * self.inverse[k]
            };
            for (block, value) in [(0, velocity.x), (1, velocity.y)] {
                let (position, rate) = (at.block(block).start + k, at.block(block + 2).start + k);
                side[position] = (side[position] + value) * inverse_g;
                side[rate] = value;
            }
        }
    }
}
