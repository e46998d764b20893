//! Jacobians in the form of an arrow, and the linear systems of a linearly implicit step.
//!
//! ```text
//!   border   p channels that everything may depend on                        ┌ own_1            right_1 ┐
//!   blocks   N groups of M channels; none depends on another one             │       own_2      right_2 │
//!   tail     q channels nothing depends on (quadratures)                     │             …       …    │
//!                                                                            │ left_1 left_2 …  corner  │
//!   (c I - J) u = r,  c = 1/(h γ)                                            └ tail_1 tail_2 …  tail_b  ┘
//! ```
//! Each block acts on ROWS rows of the border, and depends on COLUMNS of its columns, which it names: only those are kept, so that
//! blocks of one group may act on other bodies than those of the next. Each block is eliminated by itself, so the cost is linear
//! in their number:
//!
//! ```text
//!   M_j = c I - own_j      X_j = M_j⁻¹ right_j      z_j = M_j⁻¹ r_j
//!   (c I - corner - Σ left_j X_j) u_b = r_b + Σ left_j z_j        u_j = z_j + X_j u_b
//! ```
//! The tail needs no system: what it gains follows from the u of the others.

use std::ops::Range;

/// Where an arrow's parts stand in a state.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape<const M: usize, const COLUMNS: usize, const ROWS: usize> {
    /// Channels of the border, in its order.
    pub border: Vec<usize>,
    /// The blocks.
    pub blocks: Vec<BlockShape<M, COLUMNS, ROWS>>,
    /// Channels of the tail.
    pub tail: Range<usize>,
}

/// Where a block stands in a state, and which part of the border it touches.
#[derive(Clone, Debug, PartialEq)]
pub struct BlockShape<const M: usize, const COLUMNS: usize, const ROWS: usize> {
    /// Its channels, in its order.
    pub channels: [usize; M],
    /// Border rows, by their place in the border, that it acts on.
    pub rows: [usize; ROWS],
    /// Border columns, by their place in the border, that it depends on.
    pub columns: [usize; COLUMNS],
}

/// The part of a Jacobian that belongs to one block; row by row.
#[derive(Clone, Debug)]
pub struct Block<const M: usize, const COLUMNS: usize, const ROWS: usize> {
    /// Its own rates by its own channels.
    pub own: [[f64; M]; M],
    /// Its own rates by the columns of the border.
    pub right: [[f64; COLUMNS]; M],
    /// Rates of the rows of the border by its own channels.
    pub left: [[f64; M]; ROWS],
    /// Rates of the tail by its own channels, channel by channel.
    pub tail: [Vec<f64>; M],
}

/// A Jacobian.
#[derive(Clone, Debug)]
pub struct Arrowhead<const M: usize, const COLUMNS: usize, const ROWS: usize> {
    shape: Shape<M, COLUMNS, ROWS>,
    /// Rates of the border by the border, row by row.
    pub corner: Vec<f64>,
    /// The blocks.
    pub blocks: Vec<Block<M, COLUMNS, ROWS>>,
    /// Rates of the tail by the border, column by column.
    pub tail_border: Vec<f64>,
}

impl<const M: usize, const COLUMNS: usize, const ROWS: usize> Arrowhead<M, COLUMNS, ROWS> {
    /// A Jacobian of zeros.
    pub fn new(shape: Shape<M, COLUMNS, ROWS>) -> Self {
        let (p, q) = (shape.border.len(), shape.tail.len());
        let block = Block {
            own: [[0.0; M]; M],
            right: [[0.0; COLUMNS]; M],
            left: [[0.0; M]; ROWS],
            tail: std::array::from_fn(|_| vec![0.0; q]),
        };
        Arrowhead {
            corner: vec![0.0; p * p],
            blocks: vec![block; shape.blocks.len()],
            tail_border: vec![0.0; q * p],
            shape,
        }
    }
    /// Where its parts stand.
    pub fn shape(&self) -> &Shape<M, COLUMNS, ROWS> {
        &self.shape
    }
    /// Adds to each channel of the tail its row times a vector over the whole state.
    #[inline(always)]
    pub fn add_tail(&self, vector: &[f64], tail: &mut [f64]) {
        let shape = &self.shape;
        let mut add = |weights: &[f64], factor: f64| {
            for (value, weight) in tail.iter_mut().zip(weights) {
                *value += weight * factor;
            }
        };
        let columns = self.tail_border.chunks_exact(shape.tail.len().max(1));
        for (column, channel) in columns.zip(&shape.border) {
            add(column, vector[*channel]);
        }
        for (block, stands) in self.blocks.iter().zip(&shape.blocks) {
            for (column, channel) in block.tail.iter().zip(&stands.channels) {
                add(column, vector[*channel]);
            }
        }
    }
}

/// The factors of c I - J.
#[derive(Clone, Debug)]
pub struct Factors<const M: usize, const COLUMNS: usize> {
    blocks: Vec<FactoredBlock<M, COLUMNS>>,
    /// Factored border with its pivots.
    border: (Vec<f64>, Vec<usize>),
    /// Right-hand side of the border on the way.
    side: Vec<f64>,
}

/// A block that is eliminated.
#[derive(Clone, Debug)]
struct FactoredBlock<const M: usize, const COLUMNS: usize> {
    /// M_j⁻¹.
    inverse: [[f64; M]; M],
    /// X_j.
    through: [[f64; COLUMNS]; M],
}

impl<const M: usize, const COLUMNS: usize> Factors<M, COLUMNS> {
    /// Room for the factors of such a Jacobian.
    pub fn of<const ROWS: usize>(jacobian: &Arrowhead<M, COLUMNS, ROWS>) -> Self {
        let p = jacobian.shape.border.len();
        let block = FactoredBlock {
            inverse: [[0.0; M]; M],
            through: [[0.0; COLUMNS]; M],
        };
        Factors {
            blocks: vec![block; jacobian.blocks.len()],
            border: (vec![0.0; p * p], vec![0; p]),
            side: vec![0.0; p],
        }
    }

    /// Factors c I - J. False where it is singular or holds what is not a number.
    #[inline(always)]
    pub fn factor<const ROWS: usize>(
        &mut self,
        jacobian: &Arrowhead<M, COLUMNS, ROWS>,
        diagonal: f64,
    ) -> bool {
        let shape = &jacobian.shape;
        let p = shape.border.len();
        let (border, pivots) = &mut self.border;
        for (out, value) in border.iter_mut().zip(&jacobian.corner) {
            *out = -value;
        }
        for i in 0..p {
            border[i * p + i] += diagonal;
        }
        let parts = self
            .blocks
            .iter_mut()
            .zip(&jacobian.blocks)
            .zip(&shape.blocks);
        for ((factored, block), stands) in parts {
            let Some(inverse) = inverse(&block.own, diagonal) else {
                return false;
            };
            let mut through = [[0.0; COLUMNS]; M];
            for (row, weights) in through.iter_mut().zip(&inverse) {
                for (weight, right) in weights.iter().zip(&block.right) {
                    for (value, right) in row.iter_mut().zip(right) {
                        *value += weight * right;
                    }
                }
            }
            for (place, left) in stands.rows.iter().zip(&block.left) {
                let mut product = [0.0; COLUMNS];
                for (weight, through) in left.iter().zip(&through) {
                    for (value, through) in product.iter_mut().zip(through) {
                        *value += weight * through;
                    }
                }
                let into = &mut border[place * p..(place + 1) * p];
                for (column, value) in stands.columns.iter().zip(product) {
                    into[*column] -= value;
                }
            }
            *factored = FactoredBlock { inverse, through };
        }
        factor(border, p, pivots)
    }

    /// Solves (c I - J) u = r but for the tail; `side` holds r over the whole state, then u.
    #[inline(always)]
    pub fn solve<const ROWS: usize>(
        &mut self,
        jacobian: &Arrowhead<M, COLUMNS, ROWS>,
        side: &mut [f64],
    ) {
        let shape = &jacobian.shape;
        let p = shape.border.len();
        for (value, channel) in self.side.iter_mut().zip(&shape.border) {
            *value = side[*channel];
        }
        let parts = self.blocks.iter().zip(&jacobian.blocks).zip(&shape.blocks);
        for ((factored, block), stands) in parts {
            let mut given = [0.0; M];
            for (value, channel) in given.iter_mut().zip(&stands.channels) {
                *value = side[*channel];
            }
            let mut alone = [0.0; M];
            for (value, row) in alone.iter_mut().zip(&factored.inverse) {
                *value = dot(row, &given);
            }
            for (place, left) in stands.rows.iter().zip(&block.left) {
                self.side[*place] += dot(left, &alone);
            }
            for (value, channel) in alone.iter().zip(&stands.channels) {
                side[*channel] = *value;
            }
        }
        solve(&self.border.0, p, &self.border.1, &mut self.side);
        for (value, channel) in self.side.iter().zip(&shape.border) {
            side[*channel] = *value;
        }
        for (factored, stands) in self.blocks.iter().zip(&shape.blocks) {
            let mut seen = [0.0; COLUMNS];
            for (value, place) in seen.iter_mut().zip(&stands.columns) {
                *value = self.side[*place];
            }
            for (channel, row) in stands.channels.iter().zip(&factored.through) {
                side[*channel] += dot(row, &seen);
            }
        }
    }
}

#[inline(always)]
fn dot<const K: usize>(a: &[f64; K], b: &[f64; K]) -> f64 {
    let mut sum = 0.0;
    for (a, b) in a.iter().zip(b) {
        sum += a * b;
    }
    sum
}

/// Inverse of c I - J of a block, by Gauss and Jordan with row pivoting. None where no pivot is a finite number other
/// than zero.
#[inline(always)]
fn inverse<const M: usize>(own: &[[f64; M]; M], diagonal: f64) -> Option<[[f64; M]; M]> {
    let mut a = *own;
    let mut inverse = [[0.0; M]; M];
    for i in 0..M {
        for value in &mut a[i] {
            *value = -*value;
        }
        a[i][i] += diagonal;
        inverse[i][i] = 1.0;
    }
    for k in 0..M {
        let mut pivot = k;
        for row in k + 1..M {
            if a[row][k].abs() > a[pivot][k].abs() {
                pivot = row;
            }
        }
        a.swap(k, pivot);
        inverse.swap(k, pivot);
        let scale = 1.0 / a[k][k];
        if !scale.is_finite() {
            return None;
        }
        for column in 0..M {
            a[k][column] *= scale;
            inverse[k][column] *= scale;
        }
        let (pivot_row, pivot_inverse) = (a[k], inverse[k]);
        for row in 0..M {
            if row != k {
                let factor = a[row][k];
                for column in 0..M {
                    a[row][column] -= factor * pivot_row[column];
                    inverse[row][column] -= factor * pivot_inverse[column];
                }
            }
        }
    }
    Some(inverse)
}

/// Factors a matrix in place with row pivoting. False where no pivot is a finite number other than zero.
#[inline(always)]
fn factor(a: &mut [f64], size: usize, pivots: &mut [usize]) -> bool {
    for k in 0..size {
        let mut pivot = k;
        for row in k + 1..size {
            if a[row * size + k].abs() > a[pivot * size + k].abs() {
                pivot = row;
            }
        }
        pivots[k] = pivot;
        if pivot != k {
            for column in 0..size {
                a.swap(k * size + column, pivot * size + column);
            }
        }
        let inverse = 1.0 / a[k * size + k];
        if !inverse.is_finite() {
            return false;
        }
        a[k * size + k] = inverse;
        let (above, below) = a.split_at_mut((k + 1) * size);
        let pivot_row = &above[k * size + k + 1..];
        for row in below.chunks_exact_mut(size) {
            let factor = row[k] * inverse;
            row[k] = factor;
            // the border is sparse: most rows need nothing
            if factor != 0.0 {
                for (value, pivot) in row[k + 1..].iter_mut().zip(pivot_row) {
                    *value -= factor * pivot;
                }
            }
        }
    }
    true
}

/// Solves with a factored matrix, in place.
#[inline(always)]
fn solve(a: &[f64], size: usize, pivots: &[usize], side: &mut [f64]) {
    let known = |weights: &[f64], values: &[f64]| {
        let mut sum = 0.0;
        for (a, b) in weights.iter().zip(values) {
            sum += a * b;
        }
        sum
    };
    for (row, pivot) in pivots.iter().enumerate() {
        side.swap(row, *pivot);
    }
    for row in 1..size {
        let (before, rest) = side.split_at_mut(row);
        rest[0] -= known(&a[row * size..row * size + row], before);
    }
    for row in (0..size).rev() {
        let weights = &a[row * size + row + 1..(row + 1) * size];
        let (before, after) = side.split_at_mut(row + 1);
        before[row] = (before[row] - known(weights, after)) * a[row * size + row];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers without pattern in -1 to 1.
    fn noise(seed: &mut u64) -> f64 {
        *seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn arrow(seed: &mut u64) -> Arrowhead<3, 3, 2> {
        let mut arrow = Arrowhead::new(Shape {
            border: vec![0, 1, 2, 9],
            blocks: vec![
                BlockShape {
                    channels: [3, 5, 7],
                    rows: [1, 3],
                    columns: [0, 2, 3],
                },
                BlockShape {
                    channels: [4, 6, 8],
                    rows: [0, 2],
                    columns: [3, 1, 0],
                },
            ],
            tail: 10..12,
        });
        let mut fill = |list: &mut [f64]| list.iter_mut().for_each(|value| *value = noise(seed));
        fill(&mut arrow.corner);
        fill(&mut arrow.tail_border);
        for block in &mut arrow.blocks {
            fill(block.own.as_flattened_mut());
            fill(block.right.as_flattened_mut());
            fill(block.left.as_flattened_mut());
            block.tail.iter_mut().for_each(|column| fill(column));
        }
        arrow
    }

    /// The whole Jacobian, 12 × 12.
    fn whole(arrow: &Arrowhead<3, 3, 2>) -> Vec<f64> {
        let s = arrow.shape();
        let mut all = vec![0.0; 144];
        for (i, row) in s.border.iter().enumerate() {
            for (k, column) in s.border.iter().enumerate() {
                all[row * 12 + column] = arrow.corner[i * 4 + k];
            }
        }
        for (j, block) in s.blocks.iter().enumerate() {
            for (i, row) in block.channels.iter().enumerate() {
                for (k, column) in block.channels.iter().enumerate() {
                    all[row * 12 + column] = arrow.blocks[j].own[i][k];
                }
                for (k, column) in block.columns.iter().enumerate() {
                    all[row * 12 + s.border[*column]] = arrow.blocks[j].right[i][k];
                }
                for (k, target) in block.rows.iter().enumerate() {
                    all[s.border[*target] * 12 + row] = arrow.blocks[j].left[k][i];
                }
                for k in 0..2 {
                    all[(10 + k) * 12 + row] = arrow.blocks[j].tail[i][k];
                }
            }
        }
        for k in 0..2 {
            for (i, column) in s.border.iter().enumerate() {
                all[(10 + k) * 12 + column] = arrow.tail_border[i * 2 + k];
            }
        }
        all
    }

    #[test]
    fn the_solution_solves_the_whole_system() {
        let mut seed = 7;
        for diagonal in [0.3, 3.0, 300.0] {
            let arrow = arrow(&mut seed);
            let mut factors = Factors::of(&arrow);
            assert!(factors.factor(&arrow, diagonal));
            let side: Vec<f64> = (0..12).map(|_| noise(&mut seed)).collect();
            let mut u = side.clone();
            factors.solve(&arrow, &mut u);
            let all = whole(&arrow);
            let row_times = |row: usize, u: &[f64]| -> f64 {
                all[row * 12..(row + 1) * 12]
                    .iter()
                    .zip(u)
                    .map(|(a, b)| a * b)
                    .sum()
            };
            for row in 0..10 {
                let image = diagonal * u[row] - row_times(row, &u);
                assert!(
                    (image - side[row]).abs() < 1e-11 * (1.0 + diagonal),
                    "{row}: {image} {}",
                    side[row]
                );
            }
            let mut tail = [1.0, 2.0];
            arrow.add_tail(&u, &mut tail);
            for (row, value) in tail.iter().enumerate() {
                let exact = (row + 1) as f64 + row_times(10 + row, &u);
                assert!((value - exact).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_singular_system_is_reported() {
        let mut seed = 3;
        let mut arrow = arrow(&mut seed);
        arrow.blocks[1].own = [[0.0; 3]; 3];
        let mut factors = Factors::of(&arrow);
        assert!(!factors.factor(&arrow, 0.0));
        arrow.blocks[1].own[0][0] = f64::NAN;
        assert!(!factors.factor(&arrow, 1.0));
    }
}
