//! Response to unbalance, sag under weight, loads of supports.
//!
//! Unbalance: (K - jΩD_i - Ω²M + jΩ(D_e + D_i - jΩG)) Q = Σ u Ω² e^{jδ} at its nodes, w(t) = f e^{jφ} + conj(b) e^{-jφ} with φ
//! the angle of the rotor; b = 0 where every support turns with the rotor.

use crate::assembly::Carried;
use crate::feedback::{Feedback, Whole};
use crate::modes::split;
use crate::{Analysis, C64, Dynamics, Matrices, Place, Rotor, RotorError, Unbalance};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// How a rotor whirls under its unbalance at one speed.
#[derive(Debug, Clone)]
pub struct Response {
    /// The speed, rad/s.
    pub speed: f64,
    /// f of each coordinate, m and rad: turns with the spin.
    pub forward: DVector<C64>,
    /// b of each coordinate: turns against it.
    pub backward: DVector<C64>,
    /// f and b of the motion across each support, in the order of the rotor, m.
    pub across: Vec<[C64; 2]>,
    /// f and b of the force of each support on what it holds, N.
    pub forces: Vec<[C64; 2]>,
}

impl Response {
    /// Half the longer axis of the orbit at a coordinate, m.
    #[must_use]
    pub fn amplitude(&self, coordinate: usize) -> f64 {
        self.forward[coordinate].norm() + self.backward[coordinate].norm()
    }

    /// Farthest distance of the orbit at a coordinate, less that at another where there is one, about `middle` (x + jy, m) from the origin, at 64 points a
    /// turn, m.
    #[must_use]
    pub fn farthest(&self, coordinate: usize, less: Option<usize>, middle: C64) -> f64 {
        const POINTS: u32 = 64;
        let of = |list: &DVector<C64>| list[coordinate] - less.map_or(C64::default(), |k| list[k]);
        let (f, b) = (of(&self.forward), of(&self.backward).conj());
        let points = (0..POINTS).map(|k| {
            let turn = C64::from_polar(
                1.0,
                std::f64::consts::TAU * f64::from(k) / f64::from(POINTS),
            );
            (middle + f * turn + b * turn.conj()).norm()
        });
        points.fold(0.0, f64::max)
    }

    /// X of x = Re(X e^{jφ}) and Y of y = Re(Y e^{jφ}).
    #[must_use]
    pub fn planes(&self, coordinate: usize) -> (C64, C64) {
        let (f, b) = (self.forward[coordinate], self.backward[coordinate]);
        (f + b, C64::i() * (b - f))
    }

    /// How far the x-displacement is behind the mark that phases count from, rad in 0..2π.
    #[must_use]
    pub fn lag(&self, coordinate: usize) -> f64 {
        let (x, _) = self.planes(coordinate);
        (-x.arg()).rem_euclid(std::f64::consts::TAU)
    }
}

/// Amplitude along a direction (a unit x + jy) of what turns with f and against the spin with b.
#[must_use]
pub fn along([f, b]: [C64; 2], direction: C64) -> f64 {
    (direction.conj() * f + direction * b).norm()
}

/// A rotor at hand for many speeds.
#[derive(Debug, Clone)]
pub struct Responder {
    matrices: Matrices,
    carried: Carried,
    feedback: Option<Arc<dyn Feedback>>,
    turns: bool,
    /// The coordinates that it is solved in; the rotor's own without.
    basis: Option<DMatrix<f64>>,
}

impl Responder {
    /// Of a rotor in the coordinates of an analysis.
    #[must_use]
    pub fn within(analysis: &Analysis) -> Self {
        Self {
            matrices: analysis.turned.matrices.clone(),
            carried: analysis.turned.carried.clone(),
            feedback: analysis.feedback.clone(),
            turns: analysis.turns(),
            basis: Some(analysis.turned.shapes.clone()),
        }
    }

    /// Of a rotor.
    #[must_use]
    pub fn new(rotor: &Rotor) -> Self {
        Self {
            matrices: Matrices::new(rotor),
            carried: Carried::new(rotor),
            feedback: None,
            turns: rotor.turns(),
            basis: None,
        }
    }

    /// Displacement of a coordinate under a unit force on it that both go as e^{st}, in x + jy, m/N; s = jω turns with positive
    /// angles, -jω against them. Of supports that treat x and y differently the part that does not acts.
    ///
    /// # Errors
    ///
    /// At an undamped natural frequency.
    pub fn receptance(&self, coordinate: usize, speed: f64, s: C64) -> Result<C64, RotorError> {
        let row = match &self.basis {
            Some(basis) => basis.row(coordinate).transpose().map(C64::from),
            None => {
                let unit = |i, _| C64::from(f64::from(u8::from(i == coordinate)));
                DVector::from_fn(self.matrices.mass.nrows(), unit)
            }
        };
        let whole = Whole {
            dynamics: self.matrices.complex(&self.carried, speed),
            feedback: None,
        };
        let (system, _) = whole.at(s).ok_or(RotorError::NotHeld)?;
        let answer = system.lu().solve(&row).ok_or(RotorError::NotHeld)?;
        Ok(row.dot(&answer))
    }

    /// The response to unbalances at a speed, rad/s.
    ///
    /// # Errors
    ///
    /// Where the response has no bound: a critical speed without damping, or a free rotor at rest.
    pub fn unbalance(&self, all: &[Unbalance], speed: f64) -> Result<Response, RotorError> {
        let size = self.matrices.mass.nrows();
        let mut force = DVector::<C64>::zeros(size);
        for one in all {
            let push = C64::from_polar(one.amount * speed * speed, one.phase);
            match &self.basis {
                None => force[2 * one.node] += push,
                Some(basis) => {
                    for (to, share) in force.iter_mut().zip(basis.row(2 * one.node).iter()) {
                        *to += push * share;
                    }
                }
            }
        }
        let answer = |dynamics: Dynamics<C64>, force: &DVector<C64>| {
            let feedback = self.feedback.as_deref();
            let whole = Whole { dynamics, feedback };
            let (system, _) = whole.at(C64::i() * speed).ok_or(RotorError::NotHeld)?;
            system.lu().solve(force).ok_or(RotorError::NotHeld)
        };
        // X and Y of x = Re(X e^{jφ}), y = Re(Y e^{jφ})
        let [x, y] = if self.turns {
            let system = self.matrices.complex(&self.carried, speed);
            let forward = answer(system, &force)?;
            let y = &forward * -C64::i();
            [forward, y]
        } else {
            let system = self.matrices.real(&self.carried, speed);
            let [mass, damping, stiffness] =
                [&system.mass, &system.damping, &system.stiffness].map(|m| m.map(C64::from));
            let mut both = DVector::zeros(2 * size);
            both.rows_mut(0, size).copy_from(&force);
            both.rows_mut(size, size)
                .copy_from(&force.map(|f| -C64::i() * f));
            let system = Dynamics {
                mass,
                damping,
                stiffness,
            };
            let solution = answer(system, &both)?;
            [0, size].map(|from| solution.rows(from, size).into_owned())
        };
        let (forward, backward) = match self.turns {
            true => (x.clone(), DVector::zeros(size)),
            false => split(&x, &y),
        };
        let senses = |[x, y]: [C64; 2]| [(x + C64::i() * y) * 0.5, (x - C64::i() * y) * 0.5];
        let (mut across, mut forces) = (Vec::new(), Vec::new());
        for (row, support) in &self.carried.rows {
            let along =
                |part: &DVector<C64>| -> C64 { row.iter().zip(part).map(|(r, z)| z * *r).sum() };
            let motion = [along(&x), along(&y)];
            let block = support.coefficients.at(speed);
            let push = [0, 1].map(|i| {
                let of = |j: usize| {
                    let (k, c, m) = (block.stiffness[i][j], block.damping[i][j], block.mass[i][j]);
                    C64::new(k - speed * speed * m, speed * c) * motion[j]
                };
                -(of(0) + of(1))
            });
            across.push(senses(motion));
            forces.push(senses(push));
        }
        let lift = |part: DVector<C64>| match &self.basis {
            None => part,
            Some(basis) => DVector::from_fn(basis.nrows(), |i, _| {
                (0..part.len()).map(|k| part[k] * basis[(i, k)]).sum()
            }),
        };
        Ok(Response {
            speed,
            forward: lift(forward),
            backward: lift(backward),
            across,
            forces,
        })
    }
}

/// The rotor at rest under its weight.
#[derive(Debug, Clone)]
pub struct Sag {
    /// x + jy of each coordinate, m and rad.
    pub shape: DVector<C64>,
    /// Force of each support on what it holds, x + jy, N; zero of seals.
    pub loads: Vec<C64>,
}

/// Sag and loads under gravity (x + jy, m/s²) with the stiffness that the supports have at a speed, rad/s.
///
/// Seals do not count; the shaft does not turn.
///
/// # Errors
///
/// Where the supports leave a motion free.
pub fn sag(rotor: &Rotor, speed: f64, gravity: C64) -> Result<Sag, RotorError> {
    sag_under(rotor, speed, gravity, &[])
}

/// The same with forces besides: node and x + jy, N.
///
/// # Errors
///
/// As [`sag`].
pub fn sag_under(
    rotor: &Rotor,
    speed: f64,
    gravity: C64,
    forces: &[(Place, C64)],
) -> Result<Sag, RotorError> {
    let size = rotor.size();
    held(rotor, speed)?;
    let matrices = Matrices::new(rotor);
    let weight = {
        let mut shift = DVector::zeros(size);
        for node in 0..rotor.nodes.len() {
            shift[2 * node] = 1.0;
        }
        for housing in 0..rotor.housings.len() {
            shift[rotor.coordinate(Place::Housing(housing))] = 1.0;
        }
        &matrices.mass * shift
    };
    let mut standing = rotor.clone();
    standing.supports.retain(|support| !support.seal);
    let still = Matrices {
        damping_rotating: DMatrix::zeros(size, size),
        ..matrices
    };
    let stiffness = still.real(&Carried::new(&standing), speed).stiffness;
    let mut force = DVector::zeros(2 * size);
    force.rows_mut(0, size).copy_from(&(&weight * gravity.re));
    force
        .rows_mut(size, size)
        .copy_from(&(&weight * gravity.im));
    for (place, push) in forces {
        force[rotor.coordinate(*place)] += push.re;
        force[size + rotor.coordinate(*place)] += push.im;
    }
    let solution = stiffness.lu().solve(&force).ok_or(RotorError::NotHeld)?;
    let shape = DVector::from_fn(size, |i, _| C64::new(solution[i], solution[size + i]));
    Ok(Sag {
        loads: loads(rotor, speed, &shape),
        shape,
    })
}

/// Force of each support on what it holds in a shape at rest, x + jy, N, with its stiffness at a speed, rad/s; zero of seals.
#[must_use]
pub fn loads(rotor: &Rotor, speed: f64, shape: &DVector<C64>) -> Vec<C64> {
    let loads = rotor.supports.iter().map(|support| {
        if support.seal {
            return C64::default();
        }
        let ground = support.on.map_or(C64::default(), |h| {
            shape[rotor.coordinate(Place::Housing(h))]
        });
        let across = shape[rotor.coordinate(support.at)] - ground;
        let k = support.coefficients.at(speed).stiffness;
        -C64::new(
            k[0][0] * across.re + k[0][1] * across.im,
            k[1][0] * across.re + k[1][1] * across.im,
        )
    });
    loads.collect()
}

/// Refuses a rotor whose supports (without seals) leave a rigid motion of shaft or housings free at a speed, rad/s.
///
/// # Errors
///
/// [`RotorError::NotHeld`].
pub fn held(rotor: &Rotor, speed: f64) -> Result<(), RotorError> {
    let mut standing = rotor.clone();
    standing.supports.retain(|support| !support.seal);
    let size = rotor.size();
    let (first, last) = match (rotor.nodes.first(), rotor.nodes.last()) {
        (Some(first), Some(last)) => (*first, *last),
        _ => return Err(RotorError::NotHeld),
    };
    let (middle, half) = (0.5 * (first + last), (0.5 * (last - first)).max(1e-3));
    let motions = 2 + rotor.housings.len();
    let mut basis = DMatrix::zeros(size, motions);
    for (node, z) in rotor.nodes.iter().enumerate() {
        basis[(2 * node, 0)] = 1.0;
        basis[(2 * node, 1)] = (z - middle) / half;
        basis[(2 * node + 1, 1)] = 1.0 / half;
    }
    for housing in 0..rotor.housings.len() {
        basis[(rotor.coordinate(Place::Housing(housing)), 2 + housing)] = 1.0;
    }
    let carried = Carried::new(&standing).project(&basis);
    let mut stiffness = DMatrix::zeros(2 * motions, 2 * motions);
    for (row, support) in &carried.rows {
        let k = support.coefficients.at(speed).stiffness;
        let product = row.tr_mul(row);
        for (i, line) in k.iter().enumerate() {
            for (j, value) in line.iter().enumerate() {
                let mut part = stiffness.view_mut((i * motions, j * motions), (motions, motions));
                part += &product * *value;
            }
        }
    }
    if !stiffness.iter().all(|value| value.is_finite()) {
        return Err(RotorError::NotConverged);
    }
    let values = stiffness.singular_values();
    let (smallest, largest) = (values.min(), values.max());
    if largest > 0.0 && smallest > 1e-10 * largest {
        Ok(())
    } else {
        Err(RotorError::NotHeld)
    }
}
