//! From a flexible rotor to the coordinates of the model, and the motion in which it is released.

use crate::drop::housings::{self, row_against};
use crate::drop::magnets_in_time::{self, InTime, OnMagnets};
use crate::drop::{Drop, Shaft, events, record_file, torque, unbalances};
use crate::levitated;
use crate::rotor::RotorModel;
use levitation::response::{Loaded, excesses, unbalance};
use levitation::{Axis, Plant, weight};
use model::force::ForceConstants;
use model::rotor::{Coordinate, RotorConstants, Unbalance};
use model::seal::SealConstants;
use nalgebra::{DMatrix, DVector};
use number::Vec2;
use outcome::Warning;
use problem::{Code, Problem};
use rotor::{Analysis, Basis, C64, Matrices, Place, Responder, Rotor};
use scenario::{CUTOFFS, Spin, problem_at};
use std::cmp::Ordering;

/// A flexible rotor in the coordinates of the model.
#[derive(Clone, Debug, PartialEq)]
pub struct BuiltShaft {
    /// The rotor.
    pub rotor: RotorConstants,
    /// Its free modes up to this frequency are coordinates, rad/s.
    pub cutoff: f64,
    /// Row of each auxiliary bearing's node.
    pub nodes: Vec<Vec<f64>>,
    /// Of each: the row of its rotation, and its place along the shaft from the centre of mass, m.
    pub turns: Vec<(Vec<f64>, f64)>,
    /// Row of the housing on which each of them stands; none on the ground.
    pub stands: Vec<Option<Vec<f64>>>,
    /// Nodes whose displacement is watched, along the shaft.
    pub places: Vec<usize>,
    /// Nodes that are watched besides against a housing, with it; the housings themselves are watched after them.
    pub against: Vec<(usize, usize)>,
    /// Its magnets as they act in the run.
    pub(super) in_time: InTime,
    /// Seals.
    pub seals: Vec<SealConstants>,
    /// Forces from outside.
    pub forces: Vec<ForceConstants>,
    /// Rows of the nodes at which loads come on the way.
    pub loaded: Vec<Vec<f64>>,
    /// Unbalances that come on the way.
    pub unbalances: Vec<Unbalance>,
    /// Where its coordinates are at the release, m √kg.
    pub position: Vec<Vec2<f64>>,
    /// Their rates, m √kg/s.
    pub velocity: Vec<Vec2<f64>>,
    /// Modes of the rotor as it is held until the release, by rising frequency.
    pub held: Vec<HeldMode>,
    /// What its steady motion on magnets makes doubtful.
    pub warnings: Vec<Warning>,
    /// By the name of each event that cuts loops: the largest real part of an eigenvalue of the machine after it alone, 1/s.
    pub growth: Vec<(String, f64)>,
}

/// A mode of the rotor as it is held, at the speed of the release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldMode {
    /// Frequency, rad/s; positive where its motion turns as the rotor spins.
    pub frequency: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Whether unbalance excites it: it turns with the spin, or on an ellipse.
    pub excited: bool,
}

/// Share of a motion that turns one way from which on it is a circle.
const CIRCLE: f64 = 0.99;

impl HeldMode {
    /// From an eigenvalue and the share of its motion that turns as its sign says.
    fn new(value: C64, turning: f64, speed: f64) -> HeldMode {
        let with = value.im * speed.signum();
        HeldMode {
            frequency: with,
            damping_ratio: -value.re / value.norm(),
            excited: with > 0.0 || turning < CIRCLE,
        }
    }
}

impl BuiltShaft {
    /// Frequency of the quickest free mode that is a coordinate, rad/s.
    pub fn quickest_mode(&self) -> f64 {
        let frequencies = self.rotor.coordinates.iter().map(|own| own.frequency);
        let modes = frequencies.filter(|omega| *omega <= self.cutoff);
        modes.fold(0.0, f64::max)
    }
    /// Where the displacement of a node is watched, against a housing where one is given.
    pub fn watched(&self, node: usize, on: Option<usize>) -> Option<usize> {
        let Some(on) = on else {
            return self.places.iter().position(|own| *own == node);
        };
        let at = self.against.iter().position(|own| *own == (node, on))?;
        Some(self.places.len() + at)
    }
    /// Where that of a housing is watched.
    pub fn housing(&self, housing: usize) -> usize {
        self.places.len() + self.against.len() + housing
    }
    /// Displacement of a node's row at the release, m.
    pub fn displacement(&self, row: &[f64]) -> Vec2<f64> {
        let parts = row.iter().zip(&self.position);
        parts.fold(Vec2::zero(), |sum, (share, at)| sum + *at * *share)
    }
}

/// Builds a flexible rotor.
pub(crate) fn build(
    drop: &Drop,
    shaft: &Shaft,
    gravity: Vec2<f64>,
) -> Result<BuiltShaft, Box<Problem>> {
    magnets_in_time::lost_later(drop, shaft)?;
    let rotor = &shaft.model.rotor;
    let matrices = Matrices::new(rotor);
    let (basis, cutoff) = basis(drop, shaft, &matrices)?;
    let within = Analysis::new(rotor, &matrices, basis);
    let loads = weight(rotor, &within, [gravity.x, gravity.y]);
    let Held {
        steady: (position, velocity),
        still,
        carried,
        on_mounts,
        magnets: on_magnets,
        warnings,
        modes: mut held,
        growth,
    } = match &shaft.model.levitation {
        Some(_) => levitating(drop, shaft, &within, (loads, gravity))?,
        None => on_supports(drop, rotor, &matrices, &within, (loads, gravity))?,
    };
    held.sort_by(|a, b| a.frequency.abs().total_cmp(&b.frequency.abs()));
    let at = |node: usize| row(&within.basis, node);
    let whole = (rotor, &within.basis);
    let of_axis = |axis: &Axis| row_against(whole, Place::Node(axis.node), axis.on);
    let end = drop.run.duration;
    let mut in_time = match on_magnets {
        Some(own) => magnets_in_time::built(shaft, end, &of_axis, &position, &own)?,
        None => InTime::default(),
    };
    let unbalances = unbalances::built(shaft, &at, &mut in_time);
    let seals = staying(&shaft.model, &within.basis, &still, (&carried, &on_mounts));
    let forces = (shaft.model.forces.iter().zip(&shaft.model.pushed)).map(|(own, node)| {
        Ok(ForceConstants {
            node: at(*node),
            over_time: record_file::force(own)?,
        })
    });
    let forces = forces.collect::<problem::Result<_>>()?;
    let loaded = unbalances::loaded(shaft).into_iter().map(at).collect();
    let places = places(shaft);
    let mut constants = constants(drop, shaft, &matrices, &within.basis);
    if constants.polar_inertia.partial_cmp(&0.0) != Some(Ordering::Greater) {
        return Err(too_unbalanced());
    }
    unbalances::check(&constants, &unbalances)?;
    let against = housings::against(shaft);
    let housing = |k| row_against(whole, Place::Housing(k), None);
    constants.places = places.iter().map(|node| at(*node)).collect();
    let besides = against
        .iter()
        .map(|(node, on)| row_against(whole, Place::Node(*node), Some(*on)));
    constants.places.extend(besides);
    (constants.places).extend((0..rotor.housings.len()).map(housing));
    let stands = (shaft.places.iter()).map(|own| own.on.map(housing));
    let nodes = shaft.nodes.iter().map(|node| at(*node)).collect();
    let centre = rotor::properties(rotor).centre;
    let turn = |node: &usize| {
        let row = within.basis.shapes.row(rotor.displacement(*node) + 1);
        (row.iter().copied().collect(), rotor.nodes[*node] - centre)
    };
    let turns = shaft.nodes.iter().map(turn).collect();
    Ok(BuiltShaft {
        rotor: constants,
        cutoff,
        nodes,
        turns,
        places,
        against,
        stands: stands.collect(),
        in_time,
        seals,
        forces,
        loaded,
        unbalances,
        position,
        velocity,
        held,
        warnings,
        growth,
    })
}

/// Modes up to fewer than so many times the speed and the first bending mode leave out what an impact bends.
const FEW_MODES: f64 = 10.0;

/// The least cutoff that keeps what an impact bends, rad/s, of a rotor with these frequencies, rad/s; none of one that does not bend.
pub(super) fn least_cutoff(frequencies: impl Iterator<Item = f64>, speed: f64) -> Option<f64> {
    let mut frequencies = frequencies;
    let first = frequencies.find(|omega| *omega > 0.0)?;
    Some(FEW_MODES * first.max(speed))
}

/// Up to which frequency free modes are kept at screening accuracy where the file does not say it, rad/s.
///
/// Measured on the shipped machines at 20 000 rad/s against 60 000: first impacts move by 0.9 % (rig), 1.6 % (run-up), 1.9 % (retainer
/// ring), lanes are 1.15, 1.28 and 1.44 times as quick.
fn default_cutoff(drop: &Drop, full: &Basis) -> f64 {
    let speed = drop.rotor.speed.abs();
    let least = least_cutoff(full.frequencies.iter().copied(), speed);
    least.unwrap_or_default().clamp(CUTOFFS[0], CUTOFFS[1])
}

/// Free modes up to the cutoff, which stands beside them, and the residual flexibility at each place that carries something.
fn basis(drop: &Drop, shaft: &Shaft, matrices: &Matrices) -> Result<(Basis, f64), Box<Problem>> {
    let rotor = &shaft.model.rotor;
    let full = Basis::full(rotor, matrices).map_err(|error| failed(&error.to_string()))?;
    let cutoff = (shaft.cutoff).unwrap_or_else(|| default_cutoff(drop, &full));
    let mut kept = rotor.kept();
    let coming = unbalances::loaded(shaft);
    let loaded = (shaft.nodes.iter().chain(&shaft.model.pushed)).chain(&coming);
    kept.extend(loaded.map(|node| rotor.displacement(*node)));
    let parts = shaft.nodes.iter().zip(&drop.auxiliary_bearings);
    let in_space = parts.filter(|(_, part)| {
        (part.bearing.as_ref()).is_some_and(|bearing| bearing.spatial.is_some())
    });
    kept.extend(in_space.map(|(node, _)| rotor.displacement(*node) + 1));
    if let Some(levitation) = &shaft.model.levitation {
        let nodes = levitation.magnets.iter().map(|(_, at, _)| *at);
        kept.extend(nodes.map(|node| rotor.displacement(node)));
    }
    kept.sort_unstable();
    kept.dedup();
    let forces = rotor::unit_forces(rotor.size(), &kept);
    let reduced = full.reduced(cutoff, &forces);
    let reduced = reduced.map_err(|error| failed(&error.to_string()))?;
    Ok((reduced, cutoff))
}

/// Parts of the shaft between which its shape is seen.
const PARTS: f64 = 16.0;

/// Nodes by which the shape of the shaft is seen: ends, bearings, magnets, names, and some between.
fn places(shaft: &Shaft) -> Vec<usize> {
    let rotor = &shaft.model.rotor;
    let (first, last) = (0, rotor.nodes.len() - 1);
    let mut places = vec![first, last];
    places.extend(shaft.nodes.iter().chain(&shaft.model.named));
    let magnets = shaft
        .model
        .levitation
        .iter()
        .flat_map(|model| &model.magnets);
    places.extend(magnets.map(|(_, at, _)| *at));
    let apart = (rotor.nodes[last] - rotor.nodes[first]) / PARTS;
    for (node, at) in rotor.nodes.iter().enumerate() {
        if places
            .iter()
            .all(|other| (rotor.nodes[*other] - at).abs() > apart)
        {
            places.push(node);
        }
    }
    places.sort_unstable();
    places.dedup();
    places
}

/// Row of a node's displacement.
pub fn row(basis: &Basis, node: usize) -> Vec<f64> {
    basis.shapes.row(2 * node).iter().copied().collect()
}

fn constants(drop: &Drop, shaft: &Shaft, matrices: &Matrices, basis: &Basis) -> RotorConstants {
    let (brake_torque, _) = torque::brakes(drop, &mut Vec::new());
    RotorConstants {
        polar_inertia: drop.body.polar_inertia,
        drive_torque: shaft.drive_torque,
        drive_slope: shaft.drive_slope,
        drag: shaft.drag,
        drag_square: shaft.windage,
        torque: torque::tables(drop),
        brake_torque,
        spin_held: drop.rotor.spin == Spin::Held,
        ..in_coordinates(&shaft.model.rotor, matrices, basis)
    }
    .with_unbalance(&planes(&shaft.model.rotor, basis))
}

/// A rotor in the coordinates of a basis, without unbalance, drive and drag.
pub fn in_coordinates(rotor: &Rotor, matrices: &Matrices, basis: &Basis) -> RotorConstants {
    let reduced = matrices.project(&basis.shapes);
    let mut ones = DVector::zeros(rotor.size());
    for node in 0..rotor.nodes.len() {
        ones[rotor.displacement(node)] = 1.0;
    }
    for housing in 0..rotor.housings.len() {
        ones[rotor.coordinate(Place::Housing(housing))] = 1.0;
    }
    let weights = basis.shapes.tr_mul(&(&matrices.mass * ones));
    // a matrix without entries is none
    let list = |matrix: &DMatrix<f64>| match matrix.amax() == 0.0 {
        true => Vec::new(),
        false => matrix.transpose().iter().copied().collect(),
    };
    let coordinates = basis.frequencies.iter().zip(weights.iter());
    RotorConstants {
        coordinates: coordinates
            .map(|(frequency, weight)| Coordinate {
                frequency: *frequency,
                mass: 1.0,
                weight: *weight,
                unbalance: Vec2::zero(),
            })
            .collect(),
        gyroscopic: list(&reduced.gyroscopic),
        damping: list(&reduced.damping),
        damping_rotating: list(&reduced.damping_rotating),
        housings: rotor.housings.len(),
        ..RotorConstants::point(1.0, rotor::properties(rotor).polar, 0.0)
    }
}

/// The unbalances of a rotor in the coordinates of a basis.
pub fn planes(rotor: &Rotor, basis: &Basis) -> Vec<Unbalance> {
    let planes = rotor.unbalance.iter().map(|plane| Unbalance {
        node: row(basis, plane.node),
        product: plane.amount,
        phase: plane.phase,
    });
    planes.collect()
}

/// Coordinates and their rates.
type Steady = (Vec<Vec2<f64>>, Vec<Vec2<f64>>);

/// A rotor as it is held until the release.
struct Held {
    steady: Steady,
    /// Coordinates at which its seals are centred.
    still: Vec<Vec2<f64>>,
    /// Nodes with what supports carry there, N.
    carried: Vec<(usize, Vec2<f64>)>,
    /// What the mounts of housings carry, N.
    on_mounts: Vec<Vec2<f64>>,
    magnets: Option<OnMagnets>,
    warnings: Vec<Warning>,
    modes: Vec<HeldMode>,
    growth: Vec<(String, f64)>,
}

/// The steady motion on magnets, which must hold the rotor.
fn levitating(
    drop: &Drop,
    shaft: &Shaft,
    within: &Analysis,
    (mut loads, gravity): (DVector<f64>, Vec2<f64>),
) -> Result<Held, Box<Problem>> {
    let Some(model) = &shaft.model.levitation else {
        return Err(failed("no magnets"));
    };
    let rotor = &shaft.model.rotor;
    let speed = drop.rotor.speed;
    let failed = |error: levitation::Refused| levitated::failed(&error.to_string());
    let plant = Plant::planes(within, rotor.nodes.len(), speed);
    let levitation = Some((model, &plant));
    let on_mounts = housings::carried(rotor, levitation, (&mut loads, gravity), speed)?;
    let rest = levitated::at_rest(model, &plant, &loads, speed)?;
    let loaded = Loaded::about(rest, &plant, &model.levitation, speed).map_err(failed)?;
    let poles = loaded.closed.poles().map_err(failed)?;
    levitated::holds(model, &poles, &loaded.rest.slopes, speed)?;
    let held = poles.iter().filter(|pole| pole.oscillates());
    let held = held.map(|pole| HeldMode::new(pole.value, pole.turning, speed));
    let held = held.collect();
    let turning = unbalance(&loaded.closed, &rotor.unbalance, speed).map_err(failed)?;
    let excesses = excesses(&model.levitation, &loaded.rest, Some(&turning), speed);
    levitated::within_limits(model, &excesses)?;
    let angle = drop.rotor.unbalance_angle;
    let start = loaded.start(&model.levitation, &rotor.unbalance, angle);
    let start = start.map_err(failed)?;
    let size = within.basis.len();
    let pairs = |list: &DVector<f64>| -> Vec<Vec2<f64>> {
        (0..size)
            .map(|k| Vec2::new(list[k], list[size + k]))
            .collect()
    };
    Ok(Held {
        steady: (pairs(&start.coordinates), pairs(&start.rates)),
        // the loop holds the rotor about the middle of its magnets
        still: vec![Vec2::zero(); size],
        carried: Vec::new(),
        on_mounts,
        magnets: Some(OnMagnets {
            currents: start.currents,
            states: start.states,
        }),
        warnings: levitated::warnings(model, &excesses, speed),
        modes: held,
        growth: events::growths(&shaft.events, model, &loaded).map_err(failed)?,
    })
}

/// The steady motion on springs and dampers that also carry the weight, as a levitation does: at rest no support is displaced.
fn on_supports(
    drop: &Drop,
    rotor: &Rotor,
    matrices: &Matrices,
    within: &Analysis,
    (mut loads, gravity): (DVector<f64>, Vec2<f64>),
) -> Result<Held, Box<Problem>> {
    let basis = &within.basis;
    let size = basis.len();
    // a seal carries no weight
    let mut nodes: Vec<usize> = (rotor.supports.iter().filter(|support| !support.seal))
        .filter_map(|support| match support.at {
            Place::Node(node) => Some(node),
            Place::Housing(_) => None,
        })
        .collect();
    nodes.sort_unstable();
    nodes.dedup();
    let on_mounts = housings::carried(rotor, None, (&mut loads, gravity), drop.rotor.speed)?;
    // housings rest where they are
    let still: Vec<Place> = (nodes.iter().map(|node| Place::Node(*node)))
        .chain((0..rotor.housings.len()).map(Place::Housing))
        .collect();
    let whole = size + still.len();
    let mut system = DMatrix::zeros(whole, whole);
    for (k, frequency) in basis.frequencies.iter().enumerate() {
        system[(k, k)] = frequency * frequency;
    }
    for (s, place) in still.iter().enumerate() {
        let row = row_against((rotor, basis), *place, None);
        for (k, shape) in row.into_iter().enumerate() {
            system[(size + s, k)] = shape;
            system[(k, size + s)] = shape;
        }
    }
    let factor = system.lu();
    let sagging = |from: usize| -> Result<DVector<f64>, Box<Problem>> {
        let mut side = DVector::zeros(whole);
        side.rows_mut(0, size).copy_from(&loads.rows(from, size));
        let found = factor
            .solve(&side)
            .filter(|list| list.iter().all(|x| x.is_finite()));
        found.ok_or_else(not_held)
    };
    let (x, y) = (sagging(0)?, sagging(size)?);
    let speed = drop.rotor.speed;
    let held = hold(rotor, within, speed)?;
    let turning = Responder::within(within).unbalance(&rotor.unbalance, speed);
    let turning = turning.map_err(|_| not_held())?;
    let modal = |list: &DVector<C64>| -> DVector<C64> {
        let moved = matrices.mass.map(C64::from) * list;
        basis.shapes.map(C64::from).tr_mul(&moved)
    };
    let (forward, backward) = (modal(&turning.forward), modal(&turning.backward));
    let phase = C64::from_polar(1.0, drop.rotor.unbalance_angle);
    let spin = C64::new(0.0, speed);
    let plane = |value: C64| Vec2::new(value.re, value.im);
    let parts = |k: usize| (forward[k] * phase, (backward[k] * phase).conj());
    let steady = (0..size).map(|k| {
        let (with, against) = parts(k);
        (
            Vec2::new(x[k], y[k]) + plane(with + against),
            plane(spin * (with - against)),
        )
    });
    Ok(Held {
        steady: steady.unzip(),
        still: (0..size).map(|k| Vec2::new(x[k], y[k])).collect(),
        // the multipliers of their places pull against the weight
        carried: (nodes.iter().enumerate())
            .map(|(s, node)| (*node, Vec2::new(-x[size + s], -y[size + s])))
            .collect(),
        on_mounts,
        magnets: None,
        warnings: Vec::new(),
        modes: held,
        growth: Vec::new(),
    })
}

/// What supports carry at nodes, and what the mounts of housings do, N.
type Carried<'a> = (&'a [(usize, Vec2<f64>)], &'a [Vec2<f64>]);

/// Seals and supports that stay, centred where the rotor is held at rest; supports carry there what they did.
fn staying(
    model: &RotorModel,
    basis: &Basis,
    still: &[Vec2<f64>],
    (carried, on_mounts): Carried,
) -> Vec<SealConstants> {
    let supports = &model.rotor.supports;
    let beside = |node: usize| {
        let own = |other: &&rotor::Support| !other.seal && other.at == Place::Node(node);
        supports.iter().filter(own).count().max(1) as f64
    };
    let all = supports.iter().zip(&model.supports);
    all.filter(|(_, given)| given.stays)
        .map(|(support, _)| {
            let node = row_against((&model.rotor, basis), support.at, support.on);
            let pairs = node.iter().zip(still);
            let centre = pairs.fold(Vec2::zero(), |sum, (share, own)| sum + *own * *share);
            // supports of one place share what it carries
            let load = match support.at {
                Place::Housing(housing) => on_mounts[housing],
                Place::Node(at) => {
                    let mut own = carried.iter().filter(|(node, _)| *node == at);
                    let own = own.next().filter(|_| !support.seal);
                    own.map_or(Vec2::zero(), |(_, load)| *load * (1.0 / beside(at)))
                }
            };
            let axes = |m: [[f64; 2]; 2]| [m[0][0], m[0][1], m[1][0], m[1][1]];
            let rows = support.coefficients.rows().iter();
            let rows =
                rows.map(|(speed, block)| (*speed, axes(block.stiffness), axes(block.damping)));
            SealConstants {
                centre,
                carried: load,
                rows: rows.collect(),
                node,
            }
        })
        .collect()
}

/// Refuses supports on which the rotor does not stay: a motion that grows, or one without stiffness.
fn hold(rotor: &Rotor, within: &Analysis, speed: f64) -> Result<Vec<HeldMode>, Box<Problem>> {
    // beyond what rounding leaves of an undamped rotor
    const NOTHING: f64 = 1e-4;
    const ROUNDING: f64 = 1e-6;
    let found = within.eigenvalues(speed).map_err(|_| not_held())?;
    let at = format!("at {speed:.1} rad/s");
    let free = |axis: usize| {
        let stiffness = |own: &rotor::Support| own.coefficients.at(speed).stiffness[axis][axis];
        rotor.bearings().all(|own| stiffness(own) == 0.0)
    };
    let direction = match (free(0), free(1)) {
        (true, false) => ": no support has stiffness in x",
        (false, true) => ": no support has stiffness in y",
        _ => "",
    };
    let found = match found.iter().max_by(|a, b| a.re.total_cmp(&b.re)) {
        Some(value) if value.re > NOTHING + ROUNDING * value.norm() => format!(
            "a motion on the supports that grows {at}: eigenvalue {:.6} {:+.6}j 1/s",
            value.re, value.im
        ),
        _ if found.iter().any(|value| value.norm() < NOTHING) => {
            format!(
                "a motion without static stiffness {at}{direction}, an eigenvalue below 1e-4 1/s"
            )
        }
        _ => {
            let modes = within.oscillations(speed).map_err(|_| not_held())?;
            // eigenvalues of a rotor on unequal supports stand for both ways round
            let turning = if within.turns() { 1.0 } else { 0.5 };
            let modes = modes
                .into_iter()
                .map(|value| HeldMode::new(value, turning, speed));
            return Ok(modes.collect());
        }
    };
    let needed = "supports that hold the rotor until the release are needed";
    Err(problem_at(Code::NotHeld, "rotor.support", found, needed))
}

fn not_held() -> Box<Problem> {
    let found = "supports that do not hold the rotor";
    let needed =
        "two places at least, with stiffness in every direction, are needed until the release";
    problem_at(Code::NotHeld, "rotor.support", found, needed)
}

fn too_unbalanced() -> Box<Problem> {
    let found =
        "unbalances that together leave the rotor no moment of inertia about its mass centre";
    let needed = "smaller amounts are needed";
    problem_at(Code::Impossible, "rotor.unbalance", found, needed)
}

fn failed(text: &str) -> Box<Problem> {
    let needed = "another rotor is needed";
    problem_at(Code::Impossible, "rotor", text, needed)
}
