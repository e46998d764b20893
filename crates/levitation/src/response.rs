//! Answers of the closed loop: to unbalance, to constant loads, to an impulse.

use crate::plant::Coordinates;
use crate::{Amplifier, C64, ClosedLoop, Levitation, Plant, Refused};
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
    /// Displacements of the magnet axes in the same way, m.
    pub gaps: Vec<C64>,
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
    let planes = closed.plant().size() / size;
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
        gaps: (closed.act.map(T::complex) * answer.rows(0, size * planes))
            .iter()
            .copied()
            .collect(),
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
    /// k_i and k_s of the magnet axes there.
    pub slopes: Vec<(f64, f64)>,
}

/// Steps of the search for the equilibrium of magnets that are not linear.
const SEARCH: usize = 50;

/// Equilibrium under constant forces on the coordinates, offsets and references of the sensors included, with the full force laws.
pub fn equilibrium(
    plant: &Plant<f64>,
    levitation: &Levitation,
    loads: &DVector<f64>,
) -> Result<Equilibrium, Refused> {
    let mut slopes = levitation.slopes_at_centre();
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
            let scale = actuator.magnet.current_stiffness() * pair.bias_current();
            let (old_ki, old_ks) = slopes[index];
            let linear = old_ki * current + old_ks * gap + beside[index];
            moved |= (force - linear).abs() > 1e-12 * scale;
            (slopes[index], beside[index]) = ((ki, ks), rest);
        }
        if !moved {
            return Ok(Equilibrium { slopes, ..found });
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
        slopes: Vec::new(),
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

/// A limit that a steady motion would pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit {
    /// Control current that a coil leaves above its bias, A.
    Current,
    /// Voltage of an amplifier, V.
    Voltage,
    /// Gap of a magnet, m.
    Gap,
    /// Control current at which the other coil has none left, A.
    Idle,
}

/// A magnet axis whose steady motion passes a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Excess {
    /// Index of the axis.
    pub axis: usize,
    /// Which limit.
    pub limit: Limit,
    /// Size of the limit.
    pub allowed: f64,
    /// Static part.
    pub fixed: f64,
    /// Amplitude of the part that turns.
    pub amplitude: f64,
}

/// Every limit that static position and unbalance together pass at a speed, rad/s.
#[must_use]
pub fn excesses(
    levitation: &Levitation,
    rest: &Equilibrium,
    turning: Option<&Synchronous>,
    speed: f64,
) -> Vec<Excess> {
    let mut out = Vec::new();
    for (axis, actuator) in levitation.actuators().iter().enumerate() {
        let amplitudes = turning.map(|own| (own.currents[axis], own.gaps[axis]));
        let (current, gap) = amplitudes.unwrap_or_default();
        let mut judge = |limit, range: [f64; 2], fixed: f64, amplitude: f64| {
            let end = usize::from(fixed + amplitude - range[1] >= range[0] - fixed + amplitude);
            let beyond = [range[0] - fixed + amplitude, fixed + amplitude - range[1]][end];
            if beyond > 0.0 {
                out.push(Excess {
                    axis,
                    limit,
                    allowed: range[end].abs(),
                    fixed,
                    amplitude,
                });
            }
        };
        let range = [actuator.lowest_current, actuator.largest_current];
        judge(Limit::Current, range, rest.currents[axis], current.norm());
        if let Amplifier::Voltage {
            inductance,
            resistance,
            largest_voltage,
            ..
        } = actuator.amplifier
        {
            let s = C64::new(0.0, speed);
            let induced = s * actuator.magnet.current_stiffness() * gap;
            let volts = (resistance + s * inductance) * current + induced;
            let range = [-largest_voltage, largest_voltage];
            let fixed = resistance * rest.currents[axis];
            judge(Limit::Voltage, range, fixed, volts.norm());
        }
        if let Magnet::Pair(pair) = actuator.magnet {
            let range = [-pair.gap, pair.gap];
            judge(Limit::Gap, range, rest.gaps[axis], gap.norm());
            let range = [-pair.bias_plus, pair.bias_minus];
            judge(Limit::Idle, range, rest.currents[axis], current.norm());
        }
    }
    out
}

/// A levitated rotor at one speed: its static equilibrium, and the closed loop about it.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The equilibrium.
    pub rest: Equilibrium,
    /// The loop with the slopes of the magnets there.
    pub closed: ClosedLoop<f64>,
    /// Speed, rad/s.
    pub speed: f64,
}

impl Loaded {
    /// About an equilibrium of a plant.
    ///
    /// - `speed` rad/s, that of the plant
    pub fn about(
        rest: Equilibrium,
        plant: &Plant<f64>,
        levitation: &Levitation,
        speed: f64,
    ) -> Result<Self, Refused> {
        let closed = ClosedLoop::about(plant.clone(), levitation, rest.slopes.clone())?;
        Ok(Self {
            rest,
            closed,
            speed,
        })
    }

    /// Static equilibrium and synchronous response together, at rotor angle `angle` (rad): closed form, nothing settles.
    ///
    /// A sampled controller starts as its continuous equal with the delay T_c + T_s/2; held commands are those of that instant.
    pub fn start(
        &self,
        levitation: &Levitation,
        imbalance: &[Unbalance],
        angle: f64,
    ) -> Result<Start, Refused> {
        let (rest, closed) = (&self.rest, &self.closed);
        let forces = turning_forces(closed.plant(), imbalance, self.speed);
        let turning = closed.response(C64::new(0.0, self.speed), forces)?;
        let currents = DVector::from_vec(closed.currents_of(&turning, C64::from));
        let size = closed.plant().size();
        let part = |from: usize, size: usize| turning.rows(from, size).into_owned();
        let phase = C64::from_polar(1.0, angle);
        let now = |amplitudes: &DVector<C64>| amplitudes.map(|value| (value * phase).re);
        let coordinates = &rest.coordinates + now(&part(0, size));
        let states = &rest.states + now(&part(2 * size, rest.states.len()));
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
}

/// [`Loaded::start`] of a rotor under constant forces on its coordinates.
///
/// - `speed` rad/s, that of the plant
pub fn start(
    plant: &Plant<f64>,
    levitation: &Levitation,
    loads: &DVector<f64>,
    imbalance: &[Unbalance],
    speed: f64,
    angle: f64,
) -> Result<Start, Refused> {
    let rest = equilibrium(plant, levitation, loads)?;
    Loaded::about(rest, plant, levitation, speed)?.start(levitation, imbalance, angle)
}
