//! Eigenvalues and shapes of a rotor at a speed, free or supported.
//!
//! λ of λ²M + λ(D_e + D_i - jΩG) + K - jΩD_i, supports and seals included, from the first-order form in the coordinates of a
//! [`Basis`], scaled so that both halves have the size of a speed: undamped it is then skew, and round-off stays at a
//! few 10⁻¹⁶ of the highest frequency. Where every support turns with the rotor the complex form is solved: Im λ > 0
//! turns with the spin (forward), Im λ < 0 against it. Else the real form, whose shapes tell the sense.

use crate::feedback::{Feedback, Whole};
use crate::frame::Frame;
use crate::triangle::Triangle;
use crate::{Basis, C64, Dynamics, Matrices, Rotor, RotorError};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// How many of the lowest modes are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModeCount {
    /// So many: fewer are refused.
    Exactly(usize),
    /// So many, or all where there are fewer.
    AtMost(usize),
}

impl ModeCount {
    /// Most modes that are wanted.
    #[must_use]
    pub fn most(self) -> usize {
        match self {
            Self::Exactly(count) | Self::AtMost(count) => count,
        }
    }
}

impl From<usize> for ModeCount {
    fn from(count: usize) -> Self {
        Self::Exactly(count)
    }
}

/// Sense of whirl.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Whirl {
    /// With the spin.
    Forward,
    /// Against the spin.
    Backward,
    /// Along a line, or at rest, where there is no sense.
    Planar,
}

/// A mode at a speed: w(t) = f e^{λt} + conj(b) e^{conj(λ)t} at each node.
#[derive(Debug, Clone)]
pub struct Mode {
    /// λ with Im λ not below zero, 1/s.
    pub eigenvalue: C64,
    /// Part f that turns with the spin, in the rotor's own coordinates; largest displacement 1 with the other part.
    pub forward: DVector<C64>,
    /// Part b that turns against the spin.
    pub backward: DVector<C64>,
    /// Sense of whirl.
    pub whirl: Whirl,
}

impl Mode {
    /// Damped frequency, rad/s.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.eigenvalue.im
    }

    /// Damping ratio, -Re λ/|λ|; negative where it grows.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        -self.eigenvalue.re / self.eigenvalue.norm()
    }
}

/// A rotor in coordinates that it is analysed in.
#[derive(Debug, Clone)]
pub struct Analysis {
    /// The coordinates.
    pub basis: Basis,
    /// Matrices in those coordinates.
    plain: Frame,
    /// Those in which eigenvalues and responses are computed; the same where magnets hold the rotor.
    pub(crate) turned: Frame,
    /// What holds the rotor besides its supports.
    pub(crate) feedback: Option<Arc<dyn Feedback>>,
    turns: bool,
    nodes: usize,
}

/// The eigenvalues at one speed.
pub(crate) struct Spectrum {
    /// Those that oscillate, as [`Analysis::oscillations`].
    pub oscillations: Vec<C64>,
    /// As [`Analysis::growing`].
    pub growing: Option<C64>,
}

/// Below this share of |λ| the imaginary part is no oscillation.
const OSCILLATION: f64 = 0.01;
/// The same where controllers hold the rotor: pairs of integrators and filters hardly oscillate.
const OSCILLATION_OF_FILTERS: f64 = 0.1;
/// Below this, rad/s, it is a rigid motion.
pub(crate) const RIGID_BELOW: f64 = 0.01;
/// Difference of the shares of both senses below which a whirl is planar.
const PLANAR: f64 = 1e-3;

impl Analysis {
    /// A rotor in a basis.
    #[must_use]
    pub fn new(rotor: &Rotor, matrices: &Matrices, basis: Basis) -> Self {
        let plain = Frame::new(rotor, matrices, &basis);
        Self {
            turned: plain.turned(),
            plain,
            feedback: None,
            turns: rotor.turns(),
            nodes: rotor.nodes.len(),
            basis,
        }
    }

    /// The same rotor held by magnets besides its supports.
    #[must_use]
    pub fn held_by(mut self, feedback: Arc<dyn Feedback>) -> Self {
        self.turns &= feedback.turns();
        self.turned = self.plain.clone();
        self.feedback = Some(feedback);
        self
    }

    /// A rotor in all its coordinates.
    ///
    /// # Errors
    ///
    /// Where the mass matrix is not positive.
    pub fn full(rotor: &Rotor) -> Result<Self, RotorError> {
        let matrices = Matrices::new(rotor);
        let basis = Basis::full(rotor, &matrices)?;
        Ok(Self::new(rotor, &matrices, basis))
    }

    /// Whether eigenvalues carry the sense of whirl in their sign.
    #[must_use]
    pub fn turns(&self) -> bool {
        self.turns
    }

    /// The system at a speed (rad/s) over complex coordinates of the basis; `None` where a support treats x and y differently.
    #[must_use]
    pub fn complex_dynamics(&self, speed: f64) -> Option<Dynamics<C64>> {
        let whole = || self.plain.matrices.complex(&self.plain.carried, speed);
        self.turns.then(whole)
    }

    /// The system at a speed (rad/s) over real coordinates of the basis: the x-plane first, then the y-plane.
    #[must_use]
    pub fn real_dynamics(&self, speed: f64) -> Dynamics<f64> {
        self.plain.matrices.real(&self.plain.carried, speed)
    }

    /// The system at a speed over complex numbers; in real coordinates where something treats x and y differently.
    pub(crate) fn dynamics(&self, speed: f64) -> Whole<'_> {
        let Frame {
            matrices, carried, ..
        } = &self.turned;
        let dynamics = match self.turns {
            true => matrices.complex(carried, speed),
            false => {
                let real = matrices.real(carried, speed);
                Dynamics {
                    mass: real.mass.map(C64::from),
                    damping: real.damping.map(C64::from),
                    stiffness: real.stiffness.map(C64::from),
                }
            }
        };
        Whole {
            dynamics,
            feedback: self.feedback.as_deref(),
        }
    }

    /// All eigenvalues at a speed, 1/s; of conjugate pairs of the real form the one with Im λ ≥ 0.
    ///
    /// # Errors
    ///
    /// Where the eigen-solver does not converge or the mass matrix is singular.
    pub fn eigenvalues(&self, speed: f64) -> Result<Vec<C64>, RotorError> {
        if let Some(feedback) = &self.feedback {
            let all = feedback.eigenvalues(&self.dynamics(speed).dynamics)?;
            return Ok(self.upper_half(all));
        }
        Ok(self.upper_half(self.triangle(speed)?.eigenvalues))
    }

    /// Of conjugate pairs of the real form the one with Im λ ≥ 0.
    fn upper_half(&self, mut all: Vec<C64>) -> Vec<C64> {
        all.retain(|z| self.turns || z.im >= 0.0);
        all
    }

    /// The first-order form at a speed, without magnets.
    fn triangle(&self, speed: f64) -> Result<Triangle, RotorError> {
        let Frame {
            matrices, carried, ..
        } = &self.turned;
        match self.turns {
            true => Triangle::complex(&matrices.complex(carried, speed)),
            false => Triangle::real(&matrices.real(carried, speed)),
        }
    }

    /// The eigenvalues at a speed, sorted out, and what they were read from where there are no magnets.
    pub(crate) fn spectrum(&self, speed: f64) -> Result<(Spectrum, Option<Triangle>), RotorError> {
        let (all, triangle) = match self.feedback {
            Some(_) => (self.eigenvalues(speed)?, None),
            None => {
                let mut triangle = self.triangle(speed)?;
                let all = std::mem::take(&mut triangle.eigenvalues);
                (self.upper_half(all), Some(triangle))
            }
        };
        let growing = self.fastest_growth(&all, speed);
        let oscillations = self.oscillating(all);
        let spectrum = Spectrum {
            growing,
            oscillations,
        };
        Ok((spectrum, triangle))
    }

    /// The eigenvalue that grows fastest at a speed, of a motion that whirls or one that is pulled over; `None` where none grows by more
    /// than round-off.
    ///
    /// # Errors
    ///
    /// As [`Analysis::eigenvalues`].
    pub fn growing(&self, speed: f64) -> Result<Option<C64>, RotorError> {
        Ok(self.fastest_growth(&self.eigenvalues(speed)?, speed))
    }

    fn fastest_growth(&self, all: &[C64], speed: f64) -> Option<C64> {
        let round_off = self.round_off(speed);
        let grows = |z: &&C64| {
            let feedback = self.feedback.as_ref().map_or(0.0, |_| 1e-9 * z.norm());
            z.norm() > RIGID_BELOW && z.re > round_off.max(feedback)
        };
        let growing = all.iter().filter(grows);
        growing.max_by(|a, b| a.re.total_cmp(&b.re)).copied()
    }

    /// Error that round-off may leave in an eigenvalue at a speed, 1/s: ε times the highest, times the number of coordinates.
    #[must_use]
    pub fn round_off(&self, speed: f64) -> f64 {
        let Dynamics {
            mass: _,
            damping,
            stiffness,
        } = self.dynamics(speed).dynamics;
        let largest = |m: &DMatrix<C64>| m.iter().map(|z| z.norm()).fold(0.0, f64::max);
        let highest = largest(&stiffness).sqrt().max(largest(&damping));
        f64::EPSILON * highest * 2.0 * stiffness.nrows() as f64
    }

    /// Eigenvalues that oscillate, by rising frequency |Im λ|.
    ///
    /// # Errors
    ///
    /// As [`Analysis::eigenvalues`].
    pub fn oscillations(&self, speed: f64) -> Result<Vec<C64>, RotorError> {
        Ok(self.oscillating(self.eigenvalues(speed)?))
    }

    /// Share of |λ| that the imaginary part of an oscillation exceeds.
    pub(crate) fn least_oscillation(&self) -> f64 {
        match self.feedback {
            Some(_) => OSCILLATION_OF_FILTERS,
            None => OSCILLATION,
        }
    }

    fn oscillating(&self, mut all: Vec<C64>) -> Vec<C64> {
        let least = self.least_oscillation();
        all.retain(|z| z.im.abs() > least * z.norm() && z.im.abs() > RIGID_BELOW);
        all.sort_by(|a, b| a.im.abs().total_cmp(&b.im.abs()));
        all
    }

    /// The lowest modes at a speed.
    ///
    /// # Errors
    ///
    /// As [`Analysis::eigenvalues`], and where there are fewer modes than were asked for.
    pub fn modes(&self, speed: f64, count: impl Into<ModeCount>) -> Result<Vec<Mode>, RotorError> {
        let all = self.oscillations(speed)?;
        let count = match count.into() {
            ModeCount::Exactly(asked) if all.len() < asked => {
                return Err(RotorError::TooManyModes {
                    asked,
                    there: all.len(),
                });
            }
            count => count.most().min(all.len()),
        };
        let dynamics = self.dynamics(speed);
        let vectors = all[..count].iter().enumerate().map(|(k, eigenvalue)| {
            let vector = dynamics.vector(*eigenvalue, &dynamics.start(k))?;
            Ok(self.mode(*eigenvalue, &vector, speed))
        });
        vectors.collect()
    }

    /// The vector of an eigenvalue at a speed.
    pub(crate) fn vector(
        &self,
        eigenvalue: C64,
        speed: f64,
        k: usize,
    ) -> Result<DVector<C64>, RotorError> {
        let dynamics = self.dynamics(speed);
        dynamics.vector(eigenvalue, &dynamics.start(k))
    }

    /// A mode from its eigenvalue and vector in the coordinates of the analysis.
    pub(crate) fn mode(&self, eigenvalue: C64, vector: &DVector<C64>, speed: f64) -> Mode {
        let (mut forward, mut backward) = self.senses(vector, eigenvalue.im < 0.0);
        let largest = (0..self.nodes)
            .map(|node| forward[2 * node].norm() + backward[2 * node].norm())
            .fold(0.0, f64::max);
        if largest > 0.0 {
            forward /= C64::from(largest);
            backward /= C64::from(largest);
        }
        let power = |part: &DVector<C64>| -> f64 {
            (0..self.nodes).map(|node| part[2 * node].norm_sqr()).sum()
        };
        let (with, against) = (power(&forward), power(&backward));
        let whirl = if speed == 0.0 || (with - against).abs() < PLANAR * (with + against) {
            Whirl::Planar
        } else if (with > against) == (speed > 0.0) {
            Whirl::Forward
        } else {
            Whirl::Backward
        };
        Mode {
            eigenvalue: C64::new(eigenvalue.re, eigenvalue.im.abs()),
            forward,
            backward,
            whirl,
        }
    }

    /// Both senses of a vector of the analysis, in the rotor's own coordinates.
    pub(crate) fn senses(
        &self,
        vector: &DVector<C64>,
        against: bool,
    ) -> (DVector<C64>, DVector<C64>) {
        let shapes = &self.turned.shapes;
        let lift = |part: DVector<C64>| {
            DVector::from_fn(shapes.nrows(), |i, _| {
                (0..part.len()).map(|k| part[k] * shapes[(i, k)]).sum()
            })
        };
        if self.turns {
            let zero = DVector::zeros(shapes.nrows());
            return match against {
                false => (lift(vector.clone()), zero),
                true => (zero, lift(vector.map(|z| z.conj()))),
            };
        }
        let size = self.basis.len();
        let (x, y) = (vector.rows(0, size), vector.rows(size, size));
        split(&lift(x.into_owned()), &lift(y.into_owned()))
    }
}

/// Both senses of x = Re(X e^{jωt}), y = Re(Y e^{jωt}): f = (X + jY)/2, b = (X - jY)/2.
pub(crate) fn split(x: &DVector<C64>, y: &DVector<C64>) -> (DVector<C64>, DVector<C64>) {
    let j = C64::i();
    (
        x.zip_map(y, |x, y| (x + j * y) * 0.5),
        x.zip_map(y, |x, y| (x - j * y) * 0.5),
    )
}
