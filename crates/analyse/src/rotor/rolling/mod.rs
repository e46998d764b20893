//! A machine's rotor that rolls on its auxiliary bearings under its weight: critical speeds, response, distances during the coast-down.
//!
//! ```text
//!   shaft ──(contact, balls)── race, m ──(mount K)── housing        along the weight: dN/dd and the balls about the static load N
//!   shaft ──(N/ε)───────────── race, m ──(mount K)── housing        across: the rotor is a pendulum of length ε = c0 + d
//! ```
//! Small motion about the rest in the bottom of the bores, which is computed with the whole contact law; of n rows each carries its share. Races,
//! balls and what moves with them are one mass on the mount. K of a mount with Maxwell branches or a housing is that at the speed itself,
//! which is exact for unbalance and at critical speeds. Supports and seals that stay act in both.
//!
//! Not modelled: the rotor leaving its race (the speeds at which it would are named), friction and the inertia of a race that turns with it, damping across
//! the load but that of the mount, rings, films and stops, passing of the balls, tilt but that of bearings in space ([`in_space`]),
//! acceleration through a critical speed.

mod in_space;
pub(crate) mod results;

use self::in_space::InSpace;
use crate::rotor::quantities::undamped;
use crate::rotor::request::{Analyses, Request};
use model::auxiliary_bearing::AuxiliaryBearingConstants;
use nalgebra::DVector;
use physics::magnet::Magnet;
use physics::rolling_rotor::{contact_stiffness, pendulum_stiffness, penetration};
use physics::support::weight_share;
use rotor::{Block, C64, Coefficients, Place, Response, RotorError, along, sag_under};
use scenario::rotor::levitation::Magnets;
use scenario::rotor::{FlexibleRotor, Node, Support};
use scenario::{BearingPlace, Body, Drop, RotorAnalysis, Shaft};
use simulate::drop::build::auxiliary_bearings;
use simulate::rotor::RotorModel;
use std::ops::Range;

/// A rotor in the bottom of its auxiliary bearings.
pub(crate) struct RollingModel {
    /// The rotor on what its bearings are to small motion.
    pub asked: Box<Request>,
    pub bearings: Vec<RollingBearing>,
    /// The rotor at rest, its coordinates in x + jy, m.
    pub rest: DVector<C64>,
    /// Direction of the weight.
    pub down: C64,
}

/// An auxiliary bearing that the rotor rolls on; forces and stiffnesses are those of one row.
pub(crate) struct RollingBearing {
    pub constants: AuxiliaryBearingConstants,
    pub springs: Springs,
    /// Of one in space at the rated speed.
    pub in_space: Option<InSpace>,
    node: usize,
    /// Its contact among the supports of the rotor: how it swings across the weight, then the springs along it.
    link: Range<usize>,
}

/// What was found.
pub(crate) struct RollingFound {
    pub found: Analyses,
    pub bearings: Vec<BearingFound>,
    /// Least distance at each place with a clearance: at rest, or at a speed at which the linear answer holds.
    pub distances: Vec<Peak>,
    /// Ranges of speed at which the linear answer does not hold, rad/s.
    pub left_out: Vec<[f64; 2]>,
}

/// What was found of a bearing during the coast-down: each along the weight and across it.
pub(crate) struct BearingFound {
    /// Largest amplitude of the contact force, N; of the rotor in the bore, m.
    pub largest: [Result<Peak, String>; 2],
    /// Ranges of speed at which the force exceeds the static load; at which the rotor goes far up the bore, rad/s.
    pub beyond: [Vec<[f64; 2]>; 2],
}

/// A value with the speed at which it is found, rad/s.
#[derive(Clone, Copy)]
pub(crate) struct Peak {
    pub value: f64,
    pub speed: f64,
}

impl Peak {
    fn new(value: f64, speed: f64) -> Self {
        Self { value, speed }
    }
}

/// Share of ε beyond which the motion across is not that of a small pendulum: at 1/2 its frequency is 2 % lower.
const FAR: f64 = 0.5;
/// Step of the load, as a share, by which the stiffness of the balls is found.
const STEP: f64 = 1e-4;
/// Speeds at which a bearing in space is computed, at most.
const SPEEDS: usize = 32;
/// Steps in which static loads are found, and the share of the weight to which they are.
const STEPS: usize = 60;
const EXACT: f64 = 1e-9;

/// An auxiliary bearing to small motion about a load on one row, N/m and m.
pub(crate) struct Springs {
    /// This load, N.
    pub load: f64,
    pub contact: f64,
    /// Of balls between races that move; none of a bushing, or of races that are held.
    pub balls: Option<f64>,
    /// Contact and balls in series; these with the mount at rest; across the load.
    link: f64,
    pub along: f64,
    pub across: f64,
    /// Distance of the centres of rotor and bore.
    distance: f64,
    /// Where the rotor lies below the middle of the bearing.
    depth: f64,
}

impl Springs {
    fn of(own: &AuxiliaryBearingConstants, load: f64) -> Self {
        let (k, n) = (own.contact.stiffness, own.contact.exponent);
        let contact = contact_stiffness(k, n, load);
        let distance = own.contact.radial_clearance + penetration(k, n, load);
        let held = own.inner_race.centre_held;
        let moved = |share: f64| (own.bearing).displacement_under(load * share);
        let slope = || 2.0 * STEP * load / (moved(1.0 + STEP) - moved(1.0 - STEP));
        let balls = (!held && !own.is_bushing()).then(slope);
        let housing = own.mount_parts.housing.as_ref();
        let of_mount = match held {
            true => 0.0,
            false => 1.0 / own.mount.stiffness + housing.map_or(0.0, |own| 1.0 / own.stiffness),
        };
        let link = 1.0 / (1.0 / contact + balls.map_or(0.0, |own| 1.0 / own));
        Self {
            depth: distance + balls.map_or(0.0, |_| moved(1.0)) + load * of_mount,
            along: 1.0 / (1.0 / link + of_mount),
            across: pendulum_stiffness(load, distance),
            load,
            contact,
            balls,
            link,
            distance,
        }
    }
}

/// A matrix with one value along a direction and another across it.
fn turned(along: f64, across: f64, direction: C64) -> [[f64; 2]; 2] {
    let (c, s) = (direction.re, direction.im);
    let mixed = (along - across) * c * s;
    [
        [along * c * c + across * s * s, mixed],
        [mixed, along * s * s + across * c * c],
    ]
}

/// The machine that a rotor belongs to.
pub(crate) fn machine_of(analysis: &RotorAnalysis) -> Option<(&Drop, &Shaft)> {
    let drop = analysis.machine.as_deref()?;
    match &drop.body {
        Body::Flexible(shaft) => Some((drop, shaft)),
        Body::Rigid(_) => None,
    }
}

impl RollingBearing {
    /// Its stiffness against tilt, N m/rad.
    pub fn tilt(&self) -> Option<f64> {
        Some(self.in_space?.tilt?.stiffness)
    }
}

impl RollingModel {
    /// Of the machine that a rotor belongs to, or why there is none; nothing of a rotor alone.
    pub fn of(analysis: &RotorAnalysis) -> problem::Result<Option<Result<Self, String>>> {
        let Some((drop, shaft)) = machine_of(analysis) else {
            return Ok(None);
        };
        let given = auxiliary_bearings(drop)?;
        let mut free = after_release(&analysis.rotor);
        let stands = (free.supports.iter()).any(|own| !own.seal && own.at.is_some());
        let why = if drop.gravity.acceleration == 0.0 {
            Some("no weight acts across the shaft, which presses the rotor on none of them")
        } else if stands && analysis.rotor.levitation.is_none() {
            Some(
                "a support stays that carried part of the weight before the release, and how much of it afterwards is not described",
            )
        } else {
            None
        };
        if let Some(why) = why {
            return Ok(Some(Err(why.to_string())));
        }
        let mut model = RotorModel::new(&free, analysis.speed)?;
        let in_space = in_space(&model, &given, drop, analysis.speed);
        let at = |place: &BearingPlace| analysis.rotor.nodes[place.node].at;
        let springs: Vec<Option<[f64; 2]>> = (in_space.iter().zip(&shaft.places))
            .map(|(own, place)| own.as_ref()?.places(at(place), &free))
            .collect();
        if springs.iter().any(Option::is_some) {
            // both rotors, at rest and in motion, have the same nodes
            for place in springs.iter().flatten().flatten() {
                free.nodes.push(Node {
                    name: format!("spring at {place} m"),
                    at: *place,
                    clearance: None,
                    on: None,
                });
            }
            model = RotorModel::new(&free, analysis.speed)?;
        }
        let held = analysis.rotor.levitation.as_ref();
        let rested = at_rest((&model, held), given, (drop, shaft));
        Ok(Some(rested.and_then(|(mut bearings, rest)| {
            let down = C64::from_polar(1.0, drop.gravity.direction);
            let mut own = RotorAnalysis {
                rotor: free,
                gravity: drop.gravity.acceleration,
                gravity_angle: drop.gravity.direction,
                machine: None,
                modes_given: false,
                separation_margin: None,
                map_count: 2,
                ..analysis.clone()
            };
            let speeds = analysis.speeds();
            for (k, (bearing, place)) in bearings.iter_mut().zip(&shaft.places).enumerate() {
                bearing.in_space = in_space[k];
                let places = (at(place), springs[k]);
                carry(&mut own.rotor, bearing, (places, place.on, down), &speeds);
            }
            Ok(Self {
                asked: Box::new(Request::of(&own).map_err(|own| own.found)?),
                bearings,
                rest,
                down,
            })
        })))
    }

    /// Everything about it.
    pub fn find(&self) -> Result<RollingFound, RotorError> {
        let found = self.asked.find()?;
        let fastest = match self.asked.analysis.speed {
            0.0 => self.asked.analysis.speed_to,
            speed => speed.abs(),
        };
        let mut steps: Vec<Step> = (found.speeds.iter().zip(&found.responses))
            .filter(|(speed, _)| **speed > 0.0 && **speed < fastest)
            .map(|(speed, own)| (*speed, own.as_ref()))
            .collect();
        if !steps.is_empty() {
            // that at the rated speed is the first of the deflections
            let rated = found.deflections.first();
            let rated = rated.filter(|own| own.speed.abs() == fastest);
            steps.push((fastest, rated));
        }
        let mut holds: Vec<bool> = steps.iter().map(|(_, own)| own.is_some()).collect();
        let mut bearings = Vec::new();
        for bearing in &self.bearings {
            let limits = [bearing.springs.load, FAR * bearing.springs.distance];
            let each = steps.iter().map(|(speed, own)| {
                let values = own.map_or([f64::NAN; 2], |own| self.amplitudes(bearing, own));
                values.map(|value| Peak::new(value, *speed))
            });
            let each: Vec<[Peak; 2]> = each.collect();
            let over = |own: &[Peak; 2], k: usize| own[k].value > limits[k];
            for (holds, own) in holds.iter_mut().zip(&each) {
                *holds &= !over(own, 0) && !over(own, 1);
            }
            let largest = |k: usize| {
                let all = each.iter().map(|own| own[k]);
                let known = all.filter(|own| own.value.is_finite());
                let peak = known.max_by(|a, b| a.value.total_cmp(&b.value));
                let peak = peak.ok_or_else(|| "no unbalance is given".to_string())?;
                undamped(&found, peak.speed).map_or(Ok(peak), Err)
            };
            bearings.push(BearingFound {
                largest: [0, 1].map(largest),
                beyond: [0, 1].map(|k| ranges(&steps, each.iter().map(|own| over(own, k)))),
            });
        }
        let kernel = &self.asked.model.rotor;
        let distances = self.places().map(|(_, node, clearance, on)| {
            let on = on.map(|housing| kernel.coordinate(Place::Housing(housing)));
            let rest = self.rest[2 * node] - on.map_or(C64::default(), |k| self.rest[k]);
            let held = steps.iter().zip(&holds).filter(|(_, holds)| **holds);
            let turning = held.filter_map(|((speed, own), _)| {
                let farthest = (*own)?.farthest(2 * node, on, rest);
                Some(Peak::new(clearance - farthest, *speed))
            });
            let all = turning.chain([Peak::new(clearance - rest.norm(), 0.0)]);
            all.min_by(|a, b| a.value.total_cmp(&b.value))
        });
        Ok(RollingFound {
            distances: distances.flatten().collect(),
            left_out: ranges(&steps, holds.iter().map(|holds| !holds)),
            bearings,
            found,
        })
    }

    /// Places with a clearance: name, node, clearance in m, and the housing that it is of; none of the ground.
    pub fn places(&self) -> impl Iterator<Item = (&str, usize, f64, Option<usize>)> {
        let model = &self.asked.model;
        let nodes = model.nodes.iter().zip(&model.named);
        nodes.filter_map(|(own, node)| Some((own.name.as_str(), *node, own.clearance?, own.on)))
    }

    /// Amplitudes of the contact force of a row along the weight, N, and of the rotor in the bore across it, m.
    fn amplitudes(&self, bearing: &RollingBearing, own: &Response) -> [f64; 2] {
        let (link, planes) = (bearing.link.clone(), bearing.constants.planes);
        let swing = along(own.across[link.start], self.down * C64::i());
        let all = link.map(|k| own.forces[k]);
        let force = all.fold([C64::default(); 2], |[x, y], own| [x + own[0], y + own[1]]);
        [along(force, self.down) / planes, swing]
    }
}

/// A speed of the coast-down, rad/s, with the response there.
type Step<'a> = (f64, Option<&'a Response>);

/// Ranges of neighbouring speeds that are marked.
fn ranges(steps: &[Step], marks: impl Iterator<Item = bool>) -> Vec<[f64; 2]> {
    let all: Vec<(f64, bool)> = steps.iter().map(|own| own.0).zip(marks).collect();
    let alike = all.chunk_by(|one, next| one.1 == next.1);
    let marked = alike.filter(|part| part[0].1);
    marked
        .map(|part| [part[0].0, part[part.len() - 1].0])
        .collect()
}

/// What the bearings in space are to small motion under equal shares of the weight, at a speed of the rotor, rad/s.
fn in_space(
    model: &RotorModel,
    given: &[AuxiliaryBearingConstants],
    drop: &Drop,
    speed: f64,
) -> Vec<Option<InSpace>> {
    let weight = rotor::properties(&model.rotor).mass * drop.gravity.acceleration;
    let load = weight / given.iter().map(|own| own.planes).sum::<f64>();
    let of = |own: &AuxiliaryBearingConstants| {
        let contact = contact_stiffness(own.contact.stiffness, own.contact.exponent, load);
        InSpace::of(own, (load, contact), speed)
    };
    given.iter().map(of).collect()
}

/// The rotor after its release, with places where magnets and sensors stand.
fn after_release(given: &FlexibleRotor) -> FlexibleRotor {
    let mut free = given.clone();
    free.supports.retain(|own| own.stays);
    let magnets = free.levitation.take();
    for magnet in magnets.iter().flat_map(|own| &own.magnets) {
        let clearance = match magnet.axes[0].law {
            Magnet::Pair(pair) => Some(pair.gap),
            Magnet::Linear { .. } => None,
        };
        free.nodes.push(Node {
            name: format!("magnet_{}", magnet.name),
            at: magnet.at,
            clearance,
            on: magnet.on,
        });
    }
    free
}

/// Adds what an auxiliary bearing is to small motion: supports on its race, and the mount of that.
fn carry(
    rotor: &mut FlexibleRotor,
    bearing: &mut RollingBearing,
    ((at, springs_at), on, down): ((f64, Option<[f64; 2]>), Option<usize>, C64),
    speeds: &[f64],
) {
    let (own, planes) = (&bearing.constants, bearing.constants.planes);
    let held = own.inner_race.centre_held;
    let race = rotor.housings.len();
    let on_race = (!held).then_some(race);
    let first = rotor.supports.len();
    let mut add = |part: &str, at, on, coefficients| {
        rotor.supports.push(Support {
            name: format!("{}{part}", own.label()),
            at,
            on,
            coefficients,
            seal: false,
            stays: true,
        });
    };
    let springs = &bearing.springs;
    // of a damper in series with the balls, far below the frequency k/c
    let damping = own.contact.damping * springs.load * (springs.link / springs.contact).powi(2);
    let loads = (springs.load, springs.contact);
    // of one in space over the speed
    let few = speeds.iter().step_by(speeds.len().div_ceil(SPEEDS).max(1));
    let shift = |speed: &f64| Some((*speed, InSpace::of(own, loads, *speed)?.shift));
    let shifts: Vec<(f64, f64)> = few.filter_map(shift).collect();
    // a share of what acts along the weight, with what acts across it
    let part = |share: f64, across: f64| {
        let block = |along: f64| Block {
            stiffness: turned(planes * share * along, planes * across, down),
            damping: turned(planes * share * damping, 0.0, down),
            ..Block::default()
        };
        let rows = shifts.iter().map(|(speed, along)| (*speed, block(*along)));
        let constant = || Coefficients::constant(block(springs.link));
        Coefficients::table(rows.collect()).unwrap_or_else(constant)
    };
    match springs_at {
        None => add("", Some(at), on_race, part(1.0, springs.across)),
        Some([one, other]) => {
            add("", Some(at), on_race, part(0.0, springs.across));
            add("_start", Some(one), on_race, part(0.5, 0.0));
            add("_end", Some(other), on_race, part(0.5, 0.0));
        }
    }
    let mut mount = |coefficients| add("_mount", None, on, coefficients);
    if !held {
        let parts = &own.mount_parts;
        let row = |speed: f64| {
            // at standstill as of slow motion
            let frequency = speed.max(1e-3);
            let mut whole = parts.linear(&own.mount, frequency);
            if let Some(housing) = &parts.housing {
                whole = whole.in_series(housing.dynamic_stiffness(frequency));
            }
            Block::equal(planes * whole.storage, planes * whole.loss / frequency)
        };
        let rows = speeds.iter().map(|speed| (*speed, row(*speed)));
        let table = Coefficients::table(rows.collect());
        mount(table.unwrap_or_else(|| Coefficients::constant(row(0.0))));
        rotor.housings.push(planes * own.mass_on_mount());
    }
    let last = rotor.supports.len() - usize::from(!held);
    bearing.link = first..last;
}

/// The rotor in the bottom of its bearings: what each row carries, and the displacement of each node. Newton's method over the loads.
fn at_rest(
    (model, levitation): (&RotorModel, Option<&Magnets>),
    given: Vec<AuxiliaryBearingConstants>,
    (drop, shaft): (&Drop, &Shaft),
) -> Result<(Vec<RollingBearing>, DVector<C64>), String> {
    let down = C64::from_polar(1.0, drop.gravity.direction);
    let weight = rotor::properties(&model.rotor).mass * drop.gravity.acceleration;
    let rows: f64 = given.iter().map(|own| own.planes).sum();
    let mut rotor = model.rotor.clone();
    for support in &mut rotor.supports {
        // at rest a seal pushes as in the run
        support.seal = false;
    }
    let mut bearings: Vec<RollingBearing> = Vec::new();
    for (mut constants, place) in given.into_iter().zip(&shaft.places) {
        let node = model.named[place.node];
        // what stands on a housing with others stands on it here
        if place.on.is_some() {
            constants.mount_parts.housing = None;
        }
        rotor.supports.push(rotor::Support {
            at: Place::Node(node),
            on: place.on,
            coefficients: Coefficients::constant(Block::default()),
            seal: false,
        });
        bearings.push(RollingBearing {
            springs: Springs::of(&constants, weight / rows),
            node,
            in_space: None,
            link: 0..0,
            constants,
        });
    }
    let first = rotor.supports.len() - bearings.len();
    let gravity = down * drop.gravity.acceleration;
    // housings count from where they rest with the levitated rotor
    let mut standing: Vec<(Place, C64)> = (rotor.housings.iter().enumerate())
        .map(|(k, own)| (Place::Housing(k), -gravity * own.mass))
        .collect();
    standing.extend(
        levitated_loads(levitation, &rotor, weight)
            .map(|(k, load)| (Place::Housing(k), -down * load)),
    );
    let datum = |place: &BearingPlace| {
        let [x, y] = place.misalignment;
        C64::new(x, y) * down.conj()
    };
    for _ in 0..STEPS {
        let mut pushes = standing.clone();
        for ((bearing, place), support) in
            (bearings.iter().zip(&shaft.places)).zip(&mut rotor.supports[first..])
        {
            let (planes, springs) = (bearing.constants.planes, &bearing.springs);
            support.coefficients = Coefficients::constant(Block {
                stiffness: turned(planes * springs.along, planes * springs.across, down),
                ..Block::default()
            });
            // what these springs lack to press with the load where the rotor lies under it
            let datum = datum(place);
            let along = springs.along * (datum.re + springs.depth) - springs.load;
            let push = C64::new(along, springs.across * datum.im) * planes;
            pushes.push((Place::Node(bearing.node), push * down));
            if let Some(on) = place.on {
                pushes.push((Place::Housing(on), -push * down));
            }
        }
        let sag = sag_under(&rotor, drop.rotor.speed, gravity, &pushes);
        let sag = sag.map_err(|_| "they leave the rotor free to tilt".to_string())?;
        let mut change: f64 = 0.0;
        for (bearing, place) in bearings.iter_mut().zip(&shaft.places) {
            let ground = place.on.map_or(C64::default(), |on| {
                sag.shape[rotor.coordinate(Place::Housing(on))]
            });
            let at = sag.shape[rotor.displacement(bearing.node)] - ground;
            let at = (at * down.conj()).re;
            let deeper = at - datum(place).re - bearing.springs.depth;
            let (load, more) = (bearing.springs.load, bearing.springs.along * deeper);
            change = change.max(more.abs());
            // a contact does not pull
            let load = (load + more).max(0.1 * load);
            bearing.springs = Springs::of(&bearing.constants, load);
        }
        if change <= EXACT * weight {
            return Ok((bearings, sag.shape));
        }
        let none = |own: &&RollingBearing| own.springs.load < LEAST * weight;
        if let Some(none) = bearings.iter().find(none) {
            return Err(format!(
                "{} carries none of the weight",
                none.constants.label()
            ));
        }
    }
    Err("their shares of the weight were not found".to_string())
}

/// What each magnet that stands on a housing puts on it while it holds the rotor, N: its share of the weight, where all are equally stiff.
fn levitated_loads(
    levitation: Option<&Magnets>,
    rotor: &rotor::Rotor,
    weight: f64,
) -> impl Iterator<Item = (usize, f64)> {
    let magnets = levitation.map_or(&[][..], |own| &own.magnets);
    let rows = magnets.iter().map(|own| (own.at, 1.0));
    let share = weight_share(rows, rotor::properties(rotor).centre);
    let loads: Vec<_> = (magnets.iter())
        .filter_map(|own| Some((own.on?, weight * share(own.at))))
        .collect();
    loads.into_iter()
}

/// Share of the weight below which a bearing carries none.
const LEAST: f64 = 1e-6;
