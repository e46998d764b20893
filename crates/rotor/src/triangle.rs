//! The rotor at one speed in first-order form, made triangular once: A = QTQᴴ.
//!
//! The diagonal holds all eigenvalues, and inverse iteration in the coordinates of T is a back substitution: n² products where a
//! factor of λ²M + λC + K takes n³. Diagrams that follow many modes live on that.

use crate::{C64, Dynamics, RotorError};
use nalgebra::{ComplexField, DMatrix, DVector, Schur};

/// The first-order form of a rotor at one speed, triangular; over real numbers with blocks of two on its diagonal.
pub(crate) struct Triangle {
    /// The upper half of Q, of displacements, and the lower half, of velocities.
    upper: Turn,
    lower: Turn,
    t: DMatrix<C64>,
    /// Frequencies that the displacements are scaled with.
    scale: DVector<f64>,
    /// All eigenvalues; of the real form conjugates count.
    pub eigenvalues: Vec<C64>,
}

/// Rows of Q. A real one takes both parts of complex vectors in turn.
enum Turn {
    Real(DMatrix<f64>),
    Complex(DMatrix<C64>),
}

/// Vectors of the analysis in the coordinates of T, a column each: x as displacements, and as velocities.
pub(crate) struct Entered {
    displacements: DMatrix<C64>,
    velocities: DMatrix<C64>,
}

/// The iteration is at its end where a step is below this share of the eigenvalue: the vector is a step ahead.
const LAST_STEP: f64 = 1e-10;

impl Triangle {
    pub fn real(dynamics: &Dynamics<f64>) -> Result<Self, RotorError> {
        let (state, scale) = state_matrix(dynamics)?;
        let schur = schur(state)?;
        let eigenvalues = schur.complex_eigenvalues().iter().copied().collect();
        let (q, t) = schur.unpack();
        let half = q.nrows() / 2;
        Ok(Self {
            upper: Turn::Real(q.rows(0, half).into_owned()),
            lower: Turn::Real(q.rows(half, half).into_owned()),
            t: t.map(C64::from),
            scale,
            eigenvalues,
        })
    }

    pub fn complex(dynamics: &Dynamics<C64>) -> Result<Self, RotorError> {
        let (state, scale) = state_matrix(dynamics)?;
        let (q, t) = schur(state)?.unpack();
        let half = q.nrows() / 2;
        Ok(Self {
            upper: Turn::Complex(q.rows(0, half).into_owned()),
            lower: Turn::Complex(q.rows(half, half).into_owned()),
            eigenvalues: t.diagonal().iter().copied().collect(),
            t,
            scale,
        })
    }

    /// Vectors of the analysis in the coordinates of T.
    pub fn enter(&self, vectors: &[&DVector<C64>]) -> Entered {
        let velocities = DMatrix::from_fn(self.scale.len(), vectors.len(), |i, k| vectors[k][i]);
        let mut displacements = velocities.clone();
        for mut column in displacements.column_iter_mut() {
            column.zip_apply(&self.scale, |x, scale| *x *= scale);
        }
        Entered {
            displacements: self.upper.adjoint_times(&displacements),
            velocities: self.lower.adjoint_times(&velocities),
        }
    }

    /// Vectors of T in the coordinates of the analysis, of length one.
    pub fn leave(&self, vectors: &[&DVector<C64>]) -> Vec<DVector<C64>> {
        if vectors.is_empty() {
            return Vec::new();
        }
        let all = DMatrix::from_fn(self.t.nrows(), vectors.len(), |i, k| vectors[k][i]);
        let out = self.upper.times(&all);
        let unscaled = |column: DVector<C64>| column.zip_map(&self.scale, |x, scale| x / scale);
        (out.column_iter())
            .map(|column| unscaled(column.into_owned()).normalize())
            .collect()
    }

    /// The eigenvalue and vector, in the coordinates of T, that inverse iteration with its own quotient finds from a value and the
    /// `k`-th of the vectors that came in; `None` where it finds none.
    pub fn follow(
        &self,
        from: C64,
        entered: &Entered,
        k: usize,
        round_off: f64,
    ) -> Option<(C64, DVector<C64>)> {
        const STEPS: usize = 12;
        let mut value = from;
        let mut vector = entered.displacements.column(k) + entered.velocities.column(k) * from;
        vector.normalize_mut();
        for _ in 0..STEPS {
            let mut next = vector.clone();
            self.solve(value, &mut next);
            let share = vector.dotc(&next);
            let length = next.norm();
            if !(length.is_finite() && share.norm() > 0.0) {
                return None;
            }
            let step = C64::from(1.0) / share;
            vector = next.unscale(length);
            value += step;
            if step.norm() <= (LAST_STEP * value.norm()).max(round_off) {
                return Some((value, vector));
            }
        }
        None
    }

    /// (T - value)⁻¹ times a vector.
    fn solve(&self, value: C64, vector: &mut DVector<C64>) {
        let t = &self.t;
        // where the value is exact to its last digit, a digit beside it
        let least = f64::EPSILON * value.norm().max(f64::MIN_POSITIVE);
        let floor = |z: C64, least: f64| if z.norm() < least { least.into() } else { z };
        let mut end = vector.len();
        while end > 0 {
            let j = end - 1;
            let last = t[(j, j)] - value;
            if j > 0 && t[(j, j - 1)] != C64::default() {
                end = j - 1;
                let first = t[(end, end)] - value;
                let (above, below) = (t[(end, j)], t[(j, end)]);
                let size = first.norm().max(last.norm()).max(above.norm());
                let whole = floor(first * last - above * below, least * size);
                let (x, y) = (vector[end], vector[j]);
                vector[end] = (last * x - above * y) / whole;
                vector[j] = (first * y - below * x) / whole;
            } else {
                end = j;
                vector[j] /= floor(last, least);
            }
            for at in end..=j {
                let solved = vector[at];
                let column = t.view((0, at), (end, 1));
                let mut above = vector.rows_mut(0, end);
                above.axpy(-solved, &column.column(0), C64::from(1.0));
            }
        }
    }
}

impl Turn {
    fn adjoint_times(&self, vectors: &DMatrix<C64>) -> DMatrix<C64> {
        match self {
            Self::Real(q) => joined(vectors, |part| q.tr_mul(part)),
            Self::Complex(q) => q.ad_mul(vectors),
        }
    }

    fn times(&self, vectors: &DMatrix<C64>) -> DMatrix<C64> {
        match self {
            Self::Real(q) => joined(vectors, |part| q * part),
            Self::Complex(q) => q * vectors,
        }
    }
}

/// A real map of complex vectors.
fn joined(vectors: &DMatrix<C64>, map: impl Fn(&DMatrix<f64>) -> DMatrix<f64>) -> DMatrix<C64> {
    let parts = [vectors.map(|z| z.re), vectors.map(|z| z.im)];
    let [re, im] = parts.map(|part| map(&part));
    re.zip_map(&im, C64::new)
}

/// The first-order form: ż₁ = Wη̇, η̈ = -M⁻¹(K W⁻¹z₁ + Cη̇) with z₁ = Wη and W, returned too, the frequencies of the single coordinates.
fn state_matrix<T: ComplexField<RealField = f64>>(
    dynamics: &Dynamics<T>,
) -> Result<(DMatrix<T>, DVector<f64>), RotorError> {
    let size = dynamics.mass.nrows();
    let factor = dynamics.mass.clone().lu();
    let solve = |m: &DMatrix<T>| factor.solve(m).ok_or(RotorError::NoMass);
    let (stiffness, damping) = (solve(&dynamics.stiffness)?, solve(&dynamics.damping)?);
    let own = |i, _| stiffness[(i, i)].clone().modulus().sqrt().max(1.0);
    let scale = DVector::from_fn(size, own);
    let mut out = DMatrix::zeros(2 * size, 2 * size);
    for i in 0..size {
        out[(i, size + i)] = T::from_real(scale[i]);
        for j in 0..size {
            out[(size + i, j)] = -stiffness[(i, j)].clone() / T::from_real(scale[j]);
            out[(size + i, size + j)] = -damping[(i, j)].clone();
        }
    }
    Ok((out, scale))
}

fn schur<T: ComplexField<RealField = f64>>(
    state: DMatrix<T>,
) -> Result<Schur<T, nalgebra::Dyn>, RotorError> {
    if state.iter().any(|z| !z.clone().modulus().is_finite()) {
        return Err(RotorError::NotConverged);
    }
    let most = 200 * state.nrows();
    Schur::try_new(state, f64::EPSILON, most).ok_or(RotorError::NotConverged)
}

#[cfg(test)]
mod tests {
    use crate::{
        Analysis, Annulus, Block, Coefficients, Disk, Layer, Material, Place, Rotor, Support,
    };

    /// A shaft with a disk; stiffness of its supports upwards.
    fn rotor(upwards: f64) -> Rotor {
        let section = Annulus {
            outer: 0.04,
            inner: 0.0,
        };
        let shaft = Layer {
            from: 0.0,
            to: 0.6,
            start: section,
            end: section,
            material: Material::new(206e9, 0.3, 7850.0),
            longest: 0.1,
            carries: true,
            damping_of_mass: 0.0,
            damping_of_stiffness: 1e-6,
            damping_rotating: 0.0,
        };
        let mesh = crate::mesh(&[shaft], &[]).unwrap();
        let support = |node| Support {
            at: Place::Node(node),
            on: None,
            coefficients: Coefficients::constant(Block {
                stiffness: [[5e6, 0.0], [0.0, upwards]],
                ..Block::equal(0.0, 300.0)
            }),
            seal: false,
        };
        let disk = Disk {
            node: 6,
            mass: 5.0,
            polar: 0.05,
            diametral: 0.03,
        };
        Rotor {
            nodes: mesh.nodes,
            elements: mesh.elements,
            disks: vec![disk],
            supports: vec![support(1), support(5)],
            ..Rotor::default()
        }
    }

    /// What back substitution follows is what a factor of the whole system finds: value, and vector but for its phase.
    #[test]
    fn a_triangle_follows_to_the_same_mode_as_a_factor() {
        for (upwards, turns) in [(5e6, true), (4e6, false)] {
            let analysis = Analysis::full(&rotor(upwards)).unwrap();
            assert_eq!(analysis.turns(), turns);
            let before = analysis.oscillations(900.0).unwrap();
            let (spectrum, triangle) = analysis.spectrum(920.0).unwrap();
            let all = spectrum.oscillations;
            let (triangle, whole) = (triangle.unwrap(), analysis.dynamics(920.0));
            for (k, value) in before.iter().take(8).enumerate() {
                let vector = analysis.vector(*value, 900.0, k).unwrap();
                let (wanted, shape) = whole.follow(*value, &vector, 0.0).unwrap();
                let (found, own) =
                    (triangle.follow(*value, &triangle.enter(&[&vector]), 0, 0.0)).unwrap();
                assert!(
                    (found - wanted).norm() < 1e-9 * wanted.norm(),
                    "{found} {wanted}"
                );
                let nearest = all
                    .iter()
                    .map(|z| (z - found).norm())
                    .fold(f64::MAX, f64::min);
                assert!(nearest < 1e-12 * found.norm(), "{found}: {nearest:e}");
                let own = triangle.leave(&[&own]).remove(0);
                let alike = own.dotc(&shape).norm();
                assert!((alike - 1.0).abs() < 1e-10, "{found}: {alike}");
            }
        }
    }
}
