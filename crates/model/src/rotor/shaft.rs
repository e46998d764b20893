//! What is elastic, turns and damps in a rotor: matrices over its coordinates.
//!
//! ```text
//!   s = jΩGη̇ - D_e η̇ - Kη,  -D_i ξ,  ξ = η̇ - jΩη = η̇_G - jΩη_G        p = -½ jGη
//!   heats η̇ᴴD_e η̇, ξᴴD_i ξ ≥ 0;  D_e turns against the ground by Im(ηᴴD_e η̇), D_i against the spin
//! ```
//! η = η_G - N and η̇ = η̇_G - jΩN: the matrices meet the states themselves, and N turned by φ, which they met once before.
//! Coordinates are computed a group at a time, in an order of sums that does not depend on its width.

use super::constants::RotorConstants;
use super::motion::RotorMotion;
use crate::bearing::ball_sums::BallSums;
use number::Real;

/// A symmetric matrix over the coordinates.
#[derive(Clone, Debug)]
struct Matrix<R> {
    /// Of each group of rows column by column; rows behind the last are zero. Of groups of one: row by row.
    entries: Vec<R>,
    /// Row by row, where all lanes have the same: an eighth of the memory to read.
    shared: Option<Vec<f64>>,
    /// Its diagonal, where nothing stands beside it: damping by masses and stiffnesses, which the coordinates make diagonal.
    diagonal: Option<Vec<R>>,
    /// Times N at φ = 0, x then y.
    of_unbalance: [Vec<R>; 2],
}

/// Matrices of a rotor over `R`; one at least, or a frequency.
#[derive(Clone, Debug)]
pub struct Shaft<R: Real> {
    gyroscopic: Option<Matrix<R>>,
    damping: Option<Matrix<R>>,
    damping_rotating: Option<Matrix<R>>,
}

/// What the shaft does, besides its forces on the coordinates.
#[derive(Clone, Copy, Debug)]
pub struct ShaftReaction<R> {
    /// -Im(Nᴴs) + Im(η_Gᴴ D_i ξ), N m.
    pub moment: R,
    /// -2 Im(Nᴴp) - pᴴM⁻¹p, what it adds to the polar inertia, kg m².
    pub inertia: R,
    /// Heats of D_e and D_i, W.
    pub heats: [R; 2],
    /// Moment of D_e about the origin, from the ground, N m.
    pub external: R,
}

impl<R: Real> ShaftReaction<R> {
    /// Of a point.
    #[inline(always)]
    pub fn none() -> Self {
        let zero = R::zero();
        ShaftReaction {
            moment: zero,
            inertia: zero,
            heats: [zero; 2],
            external: zero,
        }
    }
}

impl<R: Real> Matrix<R> {
    fn gather<'a>(
        constants: &dyn Fn(usize) -> &'a RotorConstants,
        of: &dyn Fn(&RotorConstants) -> &[f64],
    ) -> Option<Self> {
        let length = of(constants(0)).len();
        for lane in 1..R::LANES {
            let same = of(constants(lane)).len() == length;
            assert!(same, "lanes share the matrices of their rotors");
        }
        let count = constants(0).coordinates.len();
        let times = |lane: usize, row: usize, part: usize| -> f64 {
            let rotor = constants(lane);
            (rotor.coordinates.iter().enumerate())
                .map(|(k, own)| {
                    of(rotor)[row * count + k] * [own.unbalance.x, own.unbalance.y][part]
                })
                .sum()
        };
        let same = |lane: usize| of(constants(lane)) == of(constants(0));
        let shared = R::LANES > 1 && (0..R::LANES).all(same);
        let diagonal = (0..R::LANES).all(|lane| is_diagonal(of(constants(lane)), count));
        let along = |k: usize| R::from_lanes(|lane| of(constants(lane))[k * (count + 1)]);
        (length > 0).then(|| Matrix {
            diagonal: diagonal.then(|| (0..count).map(along).collect()),
            shared: shared.then(|| of(constants(0)).to_vec()),
            entries: (0..count)
                .step_by(R::GROUP)
                .flat_map(|from| (0..count * R::GROUP).map(move |k| (from, k)))
                .map(|(from, k)| {
                    let (column, row) = (k / R::GROUP, from + k % R::GROUP);
                    let entry = |lane: usize| of(constants(lane))[row * count + column];
                    R::from_lanes(|lane| if row < count { entry(lane) } else { 0.0 })
                })
                .collect(),
            of_unbalance: [0, 1].map(|part| {
                (0..count)
                    .map(|row| R::from_lanes(|lane| times(lane, row, part)))
                    .collect()
            }),
        })
    }
    /// Entries from `from` of its products with vectors.
    #[inline(always)]
    fn times<const K: usize>(&self, from: usize, vectors: [&[R]; K]) -> [R::Group; K] {
        let count = vectors[0].len();
        let mut sums = [R::Group::zero(); K];
        if let Some(diagonal) = &self.diagonal {
            let entry = R::load_group(diagonal, from);
            for (sum, vector) in sums.iter_mut().zip(&vectors) {
                *sum = entry * R::load_group(vector, from);
            }
            return sums;
        }
        if let Some(shared) = &self.shared {
            for (j, entry) in shared[from * count..(from + 1) * count].iter().enumerate() {
                let entry = R::Group::splat(*entry);
                for (sum, vector) in sums.iter_mut().zip(&vectors) {
                    *sum += entry * vector[j].grouped();
                }
            }
            return sums;
        }
        let columns = &self.entries[from * count..(from + R::GROUP) * count];
        for (j, column) in columns.chunks_exact(R::GROUP).enumerate() {
            let entry = R::load_group(column, 0);
            for (sum, vector) in sums.iter_mut().zip(&vectors) {
                *sum += entry * vector[j].grouped();
            }
        }
        sums
    }
    /// Entries from `from` of its product with N, x then y.
    #[inline(always)]
    fn times_unbalance(&self, from: usize, [s, c]: [R::Group; 2]) -> [R::Group; 2] {
        turned(&self.of_unbalance, from, [s, c])
    }
}

/// Whether what stands beside the diagonal is no more than the roundings of the coordinates.
fn is_diagonal(matrix: &[f64], count: usize) -> bool {
    let at = |row: usize, column: usize| matrix[row * count + column];
    let small = |row: usize, column: usize| {
        let size = (at(row, row) * at(column, column)).abs().sqrt();
        at(row, column).abs() <= ROUNDING * size
    };
    let mut rows = 0..if matrix.is_empty() { 0 } else { count };
    rows.all(|row| (0..count).all(|column| row == column || small(row, column)))
}

/// Of an entry beside the diagonal over the mean of both on it.
const ROUNDING: f64 = 1e-9;

/// Entries from `from` of a list of vectors turned by φ.
#[inline(always)]
fn turned<R: Real>(list: &[Vec<R>; 2], from: usize, [s, c]: [R::Group; 2]) -> [R::Group; 2] {
    let a = R::load_group(&list[0], from);
    let b = R::load_group(&list[1], from);
    [a * c - b * s, a * s + b * c]
}

impl<R: Real> Shaft<R> {
    /// One shaft per lane; none of points.
    pub(crate) fn gather<'a>(constants: &dyn Fn(usize) -> &'a RotorConstants) -> Option<Self> {
        let shaft = Shaft {
            gyroscopic: Matrix::gather(constants, &|rotor| &rotor.gyroscopic),
            damping: Matrix::gather(constants, &|rotor| &rotor.damping),
            damping_rotating: Matrix::gather(constants, &|rotor| &rotor.damping_rotating),
        };
        let mut coordinates = (0..R::LANES).flat_map(|lane| &constants(lane).coordinates);
        let elastic = coordinates.any(|own| own.frequency != 0.0);
        let any = shaft.turns() || shaft.damping.is_some() || shaft.damping_rotating.is_some();
        (elastic || any).then_some(shaft)
    }
    /// Whether it has gyroscopic moments.
    #[inline(always)]
    pub fn turns(&self) -> bool {
        self.gyroscopic.is_some()
    }

    /// Forces on the coordinates into `force`, p into `spinning`; `own` are stiffnesses and inverse masses.
    #[inline(always)]
    pub(crate) fn react(
        &self,
        [stiffness, inverse_mass]: [&[R]; 2],
        unbalance: &[Vec<R>; 2],
        motion: &RotorMotion<R>,
        [force_x, force_y]: [&mut [R]; 2],
        [p_x, p_y]: [&mut [R]; 2],
    ) -> ShaftReaction<R> {
        let count = stiffness.len();
        let zero = R::Group::zero();
        let half = R::Group::splat(0.5);
        let spin = motion.spin.grouped();
        let angle = [motion.sine.grouped(), motion.cosine.grouped()];
        let [x, y] = motion.position;
        let [vx, vy] = motion.velocity;
        let mut sums = BallSums::<R, 5>::new(count);
        let mut from = 0;
        while from < count {
            let [nx, ny] = turned(unbalance, from, angle);
            let (gx, gy) = (R::load_group(x, from), R::load_group(y, from));
            let (gvx, gvy) = (R::load_group(vx, from), R::load_group(vy, from));
            // the axis and its rate
            let (ax, ay) = (gx - nx, gy - ny);
            let (avx, avy) = (gvx + spin * ny, gvy - spin * nx);
            let k = R::load_group(stiffness, from);
            let (mut fx, mut fy) = (-(k * ax), -(k * ay));
            let (mut inertia, mut external) = (zero, zero);
            let (mut heat, mut heat_rotating) = (zero, zero);
            if let Some(damping) = &self.damping {
                let [dx, dy] = damping.times(from, [vx, vy]);
                let [ux, uy] = damping.times_unbalance(from, angle);
                let (dx, dy) = (dx + spin * uy, dy - spin * ux);
                fx -= dx;
                fy -= dy;
                heat = avx * dx + avy * dy;
                external = ay * dx - ax * dy;
            }
            if let Some(gyroscopic) = &self.gyroscopic {
                let [qx, qy, rx, ry] = gyroscopic.times(from, [x, y, vx, vy]);
                let [ux, uy] = gyroscopic.times_unbalance(from, angle);
                let (qx, qy) = (qx - ux, qy - uy);
                let (rx, ry) = (rx + spin * uy, ry - spin * ux);
                fx -= spin * ry;
                fy += spin * rx;
                let (px, py) = (half * qy, -(half * qx));
                let over_mass = R::load_group(inverse_mass, from);
                let cross = nx * py - ny * px;
                inertia = -(cross + cross) - (px * px + py * py) * over_mass;
                R::store_group(px, p_x, from);
                R::store_group(py, p_y, from);
            }
            let mut moment = ny * fx - nx * fy;
            if let Some(rotating) = &self.damping_rotating {
                let [qx, qy, rx, ry] = rotating.times(from, [x, y, vx, vy]);
                let (dx, dy) = (rx + spin * qy, ry - spin * qx);
                fx -= dx;
                fy -= dy;
                moment += gx * dy - gy * dx;
                let (wx, wy) = (gvx + spin * gy, gvy - spin * gx);
                heat_rotating = wx * dx + wy * dy;
            }
            R::store_group(fx, force_x, from);
            R::store_group(fy, force_y, from);
            sums.add(from, &[moment, inertia, heat, heat_rotating, external]);
            from += R::GROUP;
        }
        let [moment, inertia, heat, heat_rotating, external] = sums.total();
        ShaftReaction {
            moment,
            inertia,
            heats: [heat, heat_rotating],
            external,
        }
    }
}

impl Shaft<f64> {
    /// G row by row.
    pub fn gyroscopic(&self) -> Option<&[f64]> {
        self.gyroscopic.as_ref().map(|matrix| &matrix.entries[..])
    }
}
