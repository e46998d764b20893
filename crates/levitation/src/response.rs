//! Answers of the closed loop: to unbalance, to constant loads, to an impulse.

use crate::plant::Coordinates;
use crate::{C64, ClosedLoop, Levitation, Plant, Refused};
use nalgebra::{DMatrix, DVector};
use physics::magnet::Magnet;
use rotor::Unbalance;

/// A motion with the spin: w = forward e^{jΩt} + backward e^{-jΩt} at each node, currents likewise.
#[derive(Debug, Clone)]
pub struct Synchronous {
    /// Forward part of every node, m.
    pub forward: Vec<C64>,
    /// Backward part of every node, m; zero over complex coordinates.
    pub backward: Vec<C64>,
    /// Currents Re(I e^{jΩt}) of the magnet axes, A; over complex coordinates along and across in one number.
    pub currents: Vec<C64>,
}

/// Steady response to unbalance at a speed, rad/s, that of the plant.
pub fn unbalance<T: Coordinates>(
    closed: &ClosedLoop<T>,
    unbalance: &[Unbalance],
    speed: f64,
) -> Result<Synchronous, Refused> {
    let forces = turning_forces(closed.plant(), unbalance, speed);
    let answer = closed.response(C64::new(0.0, speed), forces)?;
    let nodes = closed.plant().nodes.map(C64::from);
    let size = nodes.ncols();
    let x = &nodes * answer.rows(0, size);
    let (forward, backward) = if T::COMPLEX {
        (x.clone(), DVector::zeros(nodes.nrows()))
    } else {
        let y = &nodes * answer.rows(size, size);
        let j = C64::new(0.0, 1.0);
        let half = |sign: f64| x.zip_map(&y, |x, y| (x + j * sign * y) * 0.5);
        (half(1.0), half(-1.0).map(|value| value.conj()))
    };
    Ok(Synchronous {
        forward: forward.iter().copied().collect(),
        backward: backward.iter().copied().collect(),
        currents: closed.currents_of(&answer, T::complex),
    })
}

fn turning_forces<T: Coordinates>(
    plant: &Plant<T>,
    unbalance: &[Unbalance],
    speed: f64,
) -> DVector<C64> {
    let mut forces = DVector::zeros(plant.size());
    for part in unbalance {
        let force = C64::from_polar(part.amount * speed * speed, part.phase);
        forces += DVector::from_vec(T::turning(&plant.shape(part.node), force));
    }
    forces
}

/// State of the closed loop from rest at given instants after an impulse (N s) along +x at a node.
pub fn impulse<T: Coordinates>(
    closed: &ClosedLoop<T>,
    node: usize,
    impulse: f64,
    times: &[f64],
) -> Result<Vec<DVector<T>>, Refused> {
    let size = closed.plant().size();
    let push = closed.plant().row(node, 0.0).transpose() * T::from_real(impulse);
    let mut start = DVector::zeros(closed.states());
    let velocity = closed.over_mass(DMatrix::from_columns(&[push]))?;
    start.rows_mut(size, size).copy_from(&velocity.column(0));
    free(closed, &start, times)
}

/// Free motion from a state, at rising instants: powers of the transition over their largest common step.
pub fn free<T: Coordinates>(
    closed: &ClosedLoop<T>,
    start: &DVector<T>,
    times: &[f64],
) -> Result<Vec<DVector<T>>, Refused> {
    let step = common_step(times);
    let transition = (closed.matrix() * T::from_real(step)).exp();
    let mut state = start.clone();
    let (mut done, mut out) = (0, Vec::new());
    for time in times {
        let wanted = (time / step).round() as usize;
        for _ in done..wanted {
            state = &transition * state;
        }
        done = wanted;
        out.push(state.clone());
    }
    Ok(out)
}

/// A step that divides every instant to a millionth of itself, a thousandth of the first at least.
fn common_step(times: &[f64]) -> f64 {
    let first = times
        .iter()
        .copied()
        .filter(|t| *t > 0.0)
        .fold(f64::INFINITY, f64::min);
    let divides = |step: f64| {
        let odd = |time: &f64| ((time / step).round() - time / step).abs() > 1e-6;
        !times.iter().any(odd)
    };
    let parts = (1..1000).find(|parts| divides(first / f64::from(*parts)));
    first / f64::from(parts.unwrap_or(1000))
}

impl<T: Coordinates> ClosedLoop<T> {
    /// Displacements of all nodes in a state: over complex coordinates w, over real ones those along x, then along y.
    #[must_use]
    pub fn displacements(&self, state: &DVector<T>) -> Vec<T> {
        let nodes = self.plant().nodes.map(T::from_real);
        let size = nodes.ncols();
        let planes = self.plant().size() / size;
        let parts = (0..planes).map(|plane| &nodes * state.rows(plane * size, size));
        parts
            .flat_map(|part| part.iter().cloned().collect::<Vec<_>>())
            .collect()
    }

    /// Currents in a state, A.
    #[must_use]
    pub fn currents(&self, state: &DVector<T>) -> Vec<T> {
        self.currents_of(state, |value| value)
    }

    /// Currents in a state over other numbers, those of amplitudes.
    fn currents_of<U: Coordinates>(&self, state: &DVector<U>, of: impl Fn(T) -> U) -> Vec<U> {
        let size = self.plant().size();
        let real = |m: &DMatrix<f64>| m.map(U::from_real);
        let own = state.rows(2 * size, self.control.a.nrows());
        let displacements = self.observe.map(of) * state.rows(0, size);
        let all = real(&self.control.currents) * own + real(&self.control.through) * displacements;
        all.iter().cloned().collect()
    }
}

/// Where the rotor stands under constant loads.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    /// Coordinates q, then the states of the controller.
    pub coordinates: DVector<f64>,
    /// States of the controller.
    pub states: DVector<f64>,
    /// Control currents of the magnet axes, A.
    pub currents: Vec<f64>,
    /// Displacements of the magnet axes, m.
    pub gaps: Vec<f64>,
}

/// Steps of the search for the equilibrium of magnets that are not linear.
const SEARCH: usize = 50;

/// Equilibrium under constant forces on the coordinates, offsets and references of the sensors included, with the full force laws.
pub fn equilibrium(
    plant: &Plant<f64>,
    levitation: &Levitation,
    loads: &DVector<f64>,
) -> Result<Equilibrium, Refused> {
    let mut slopes: Vec<(f64, f64)> = (levitation.actuators().iter())
        .map(|a| (a.magnet.current_stiffness(), a.magnet.position_stiffness()))
        .collect();
    let mut beside = vec![0.0; slopes.len()];
    for _ in 0..SEARCH {
        let closed = ClosedLoop::about(plant.clone(), levitation, slopes.clone())?;
        let found = at_rest(
            &closed,
            &(loads + closed.act.tr_mul(&DVector::from_vec(beside.clone()))),
        )?;
        let mut moved = false;
        for (index, actuator) in levitation.actuators().iter().enumerate() {
            let (current, gap) = (found.currents[index], found.gaps[index]);
            let Magnet::Pair(pair) = actuator.magnet else {
                continue;
            };
            if gap.abs() >= pair.gap || !current.is_finite() {
                return Err(Refused::NoEquilibrium);
            }
            let (ki, ks) = actuator.magnet.slopes(current, gap);
            let force = actuator.magnet.force(current, gap, 1.0);
            let rest = force - ki * current - ks * gap;
            let scale = actuator.magnet.current_stiffness() * pair.bias_current;
            let (old_ki, old_ks) = slopes[index];
            let linear = old_ki * current + old_ks * gap + beside[index];
            moved |= (force - linear).abs() > 1e-12 * scale;
            (slopes[index], beside[index]) = ((ki, ks), rest);
        }
        if !moved {
            return Ok(found);
        }
    }
    Err(Refused::NoEquilibrium)
}

/// Solves 0 = matrix · state + constants.
fn at_rest(closed: &ClosedLoop<f64>, loads: &DVector<f64>) -> Result<Equilibrium, Refused> {
    let size = closed.plant().size();
    let control = &closed.control;
    let own = control.a.nrows();
    let matrix = closed.matrix();
    // at rest q̇ is zero: rows of q̈ and of the controller, columns of q and of the controller
    let mut left = DMatrix::zeros(size + own, size + own);
    left.columns_mut(0, size)
        .copy_from(&matrix.view((size, 0), (size + own, size)));
    left.columns_mut(size, own)
        .copy_from(&matrix.view((size, 2 * size), (size + own, own)));
    let forces = loads + closed.force_over_current() * &control.constant_currents;
    let mut right = DVector::zeros(size + own);
    let accelerations = closed.over_mass(DMatrix::from_columns(&[forces]))?;
    right.rows_mut(0, size).copy_from(&-accelerations.column(0));
    right
        .rows_mut(size, own)
        .copy_from(&-control.constant_rates.clone());
    let found = solve_scaled(left, right)?;
    let (coordinates, states) = (
        found.rows(0, size).into_owned(),
        found.rows(size, own).into_owned(),
    );
    let currents = &control.currents * &states
        + &control.through * (&closed.observe * &coordinates)
        + &control.constant_currents;
    let gaps = &closed.act * &coordinates;
    Ok(Equilibrium {
        currents: currents.iter().copied().collect(),
        gaps: gaps.iter().copied().collect(),
        coordinates,
        states,
    })
}

/// Solves with rows scaled to their largest entry, and one step of refinement: rows differ by many powers of ten.
fn solve_scaled(mut left: DMatrix<f64>, mut right: DVector<f64>) -> Result<DVector<f64>, Refused> {
    for (index, mut row) in left.row_iter_mut().enumerate() {
        let largest = row.amax();
        if largest > 0.0 {
            row.unscale_mut(largest);
            right[index] /= largest;
        }
    }
    let factor = left.clone().lu();
    let first = factor.solve(&right).ok_or(Refused::Singular)?;
    let rest = &right - &left * &first;
    let found = first + factor.solve(&rest).ok_or(Refused::Singular)?;
    let finite = found.iter().all(|value| value.is_finite());
    finite.then_some(found).ok_or(Refused::Singular)
}

/// The state in which a levitated rotor turns steadily when a drop begins.
#[derive(Debug, Clone)]
pub struct Start {
    /// Coordinates q: the x-plane, then the y-plane.
    pub coordinates: DVector<f64>,
    /// Their rates.
    pub rates: DVector<f64>,
    /// States of the levitation, in its own order.
    pub states: Vec<f64>,
    /// Control currents of the magnet axes, A.
    pub currents: Vec<f64>,
}

/// Static equilibrium and synchronous response together, at rotor angle `angle` (rad): closed form, nothing settles.
///
/// - `speed` rad/s, that of the plant; `loads` constant forces on the coordinates, weight first of all
///
/// A sampled controller starts as its continuous equal with the delay T_c + T_s/2; held commands are those of that instant.
pub fn start(
    plant: &Plant<f64>,
    levitation: &Levitation,
    loads: &DVector<f64>,
    imbalance: &[Unbalance],
    speed: f64,
    angle: f64,
) -> Result<Start, Refused> {
    let rest = equilibrium(plant, levitation, loads)?;
    let slopes = levitation.actuators().iter().enumerate();
    let slopes = slopes.map(|(k, a)| a.magnet.slopes(rest.currents[k], rest.gaps[k]));
    let closed = ClosedLoop::about(plant.clone(), levitation, slopes.collect())?;
    let forces = turning_forces(plant, imbalance, speed);
    let s = C64::new(0.0, speed);
    let turning = closed.response(s, forces)?;
    let currents = DVector::from_vec(closed.currents_of(&turning, C64::from));
    let size = plant.size();
    let part = |from: usize, size: usize| turning.rows(from, size).into_owned();
    let phase = C64::from_polar(1.0, angle);
    let now = |amplitudes: &DVector<C64>| amplitudes.map(|value| (value * phase).re);
    let coordinates = rest.coordinates + now(&part(0, size));
    let states = rest.states.clone() + now(&part(2 * size, rest.states.len()));
    let displacements = &closed.observe * &coordinates;
    Ok(Start {
        states: levitation.adopted(states.as_slice(), displacements.as_slice()),
        rates: now(&part(size, size)),
        coordinates,
        currents: (rest.currents.iter().zip(now(&currents).iter()))
            .map(|(a, b)| a + b)
            .collect(),
    })
}
