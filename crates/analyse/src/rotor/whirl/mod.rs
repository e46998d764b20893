//! Dry backward whirl of a machine's rotor in its auxiliary bearings: the friction that it needs over the frequency of the whirl.
//!
//! ```text
//!   α(ω) = n α_rotor(-jω; Ω) + conj α_race(jω)     rotor at rated speed without its magnets, race on its mount; N of each of n rows
//!   μ_e = Im α/|Re α|,  N (|Re α| + μ_e Im α) = c0 + d(N)
//! ```
//! The race is one mass m of outer and inner race, balls and cage, α_race = 1/(K(jω) - mω²) with K of spring, damper, Maxwell branches and the
//! housing below them. Frequencies go from √(g/c0), below which the weight keeps a rotor that nothing else carries from going round the bore, to
//! analysis.whirl_to or the frequency at which the surfaces roll on each other.
//!
//! Not modelled: friction rings, squeeze films and hard stops, deflection of the balls, races that turn, tilt, whirl that is no circle.

pub(crate) mod results;

use crate::rotor::rolling::machine_of;
use model::auxiliary_bearing::AuxiliaryBearingConstants;
use model::mount::Mount;
use physics::dry_whirl::{WhirlContact, rolling_limit};
use rotor::{
    Analysis, Basis, Block, C64, Coefficients, Matrices, ModeCount, Place, Responder, Rotor,
    RotorError, SmallestFriction, Support, WhirlCurve, WhirlPoint, WhirlRange,
};
use scenario::RotorAnalysis;
use simulate::drop::build::auxiliary_bearings;
use simulate::rotor::RotorModel;

/// Frequencies of the curve, evenly spaced on a logarithmic axis; natural frequencies of the rotor come between them.
const POINTS: usize = 600;
/// Steps of the map to each side of today's mount, and their number in a decade.
const SIDE: i32 = 10;
const PER_DECADE: f64 = 20.0 / 3.0;
/// Backward modes of the rotor whose surroundings are looked at closely.
const MODES: usize = 12;
/// Damping of the map over √(k m) where the mount has none.
const SMALL_DAMPING: f64 = 0.1;

/// A rotor with its auxiliary bearings, ready to be analysed.
pub(crate) struct WhirlModel {
    responder: Responder,
    speed: f64,
    /// Frequencies of the curve that the natural frequencies of the rotor ask for, rad/s.
    natural: Vec<f64>,
    /// Names of supports and seals that treat x and y differently.
    pub unequal: Vec<String>,
    pub bearings: Vec<WhirlBearing>,
}

/// An auxiliary bearing with what whirl in it depends on.
pub(crate) struct WhirlBearing {
    pub name: String,
    pub constants: AuxiliaryBearingConstants,
    coordinate: usize,
    /// Lowest and highest frequency of the curve, rad/s.
    pub range: [f64; 2],
    /// Whether the weight ends the curve below, or rolling above.
    pub ended_by: [bool; 2],
}

/// What was found of one bearing.
#[derive(Default)]
pub(crate) struct BearingWhirl {
    /// The curve; friction and force are no numbers where no whirl is possible at any friction.
    pub curve: Vec<WhirlPoint>,
    pub smallest: Option<SmallestFriction>,
    /// Ranges in which the file's friction exceeds the needed one.
    pub ranges: Vec<WhirlRange>,
    pub map: Option<MountMap>,
}

/// Smallest needed friction over stiffness and damping of the mount.
pub(crate) struct MountMap {
    pub stiffnesses: Vec<f64>,
    pub dampings: Vec<f64>,
    /// Row by row of the same damping.
    pub friction: Vec<f64>,
    /// The range of damping, at today's stiffness, in which the needed friction exceeds that of the file: the one nearest to today's.
    pub cure: Option<DampingRange>,
    /// The mount of the map nearest to today's on which the needed friction exceeds that of the file.
    pub nearest: Option<Mount<f64>>,
}

/// A range of damping of a mount, N s/m.
#[derive(Clone, Copy)]
pub(crate) struct DampingRange {
    pub from: f64,
    pub to: f64,
    /// Whether an end is that of what was tried, below and above.
    pub open: [bool; 2],
}

impl WhirlModel {
    /// Of the machine that a rotor belongs to; none of a rotor alone, or one that stands.
    pub fn of(
        analysis: &RotorAnalysis,
        model: &RotorModel,
        full: &Basis,
        cut: f64,
    ) -> problem::Result<Option<Self>> {
        let turns = analysis.speed != 0.0;
        let Some((drop, shaft)) = machine_of(analysis).filter(|_| turns) else {
            return Ok(None);
        };
        let given = auxiliary_bearings(drop)?;
        let nodes = shaft.places.iter().map(|place| model.named[place.node]);
        let nodes: Vec<usize> = nodes.collect();
        let (free, unequal) = in_flight(model, &nodes);
        let carried = free
            .bearings()
            .any(|own| own.coefficients.at(analysis.speed).stiffness[0][0] > 0.0);
        let mass = rotor::properties(&model.rotor).mass;
        let springs: f64 = given.iter().map(static_to_glassy).sum();
        let most = (analysis.whirl_to)
            .unwrap_or_else(|| analysis.frequency_to.max(2.0 * (springs / mass).sqrt()));
        let speed = analysis.speed;
        let bearing = |(constants, node): (AuxiliaryBearingConstants, &usize)| {
            let contact = &constants.contact;
            let rolling = rolling_limit(
                contact.bore_radius,
                contact.radial_clearance,
                [speed.abs(), 0.0],
            );
            let weight = (drop.gravity.acceleration / contact.radial_clearance).sqrt();
            let falls = !carried && weight > 0.0;
            let high = most.min(rolling);
            WhirlBearing {
                name: constants.label(),
                coordinate: model.rotor.displacement(*node),
                range: [if falls { weight } else { 1e-3 * high }, high],
                ended_by: [falls, rolling <= most],
                constants,
            }
        };
        let bearings = given.into_iter().zip(&nodes).map(bearing).collect();
        let failed = |error: RotorError| simulate::levitated::failed(&error.to_string());
        let matrices = Matrices::new(&free);
        let small = full.len() <= super::request::SMALL;
        let basis = match small {
            true => full.clone(),
            false => {
                (full.for_analysis(&free, &matrices, cut.max(2.0 * most), most)).map_err(failed)?
            }
        };
        let within = Analysis::new(&free, &matrices, basis);
        let modes = within.modes(speed, ModeCount::AtMost(MODES));
        let near = |mode: &rotor::Mode| {
            let width = mode.damping_ratio().abs().clamp(1e-5, 0.05);
            let frequency = mode.frequency();
            [-16.0, -4.0, -1.0, 0.0, 1.0, 4.0, 16.0].map(|k| frequency * (1.0 + k * width))
        };
        Ok(Some(Self {
            natural: modes.map_err(failed)?.iter().flat_map(near).collect(),
            responder: Responder::within(&within),
            speed,
            unequal,
            bearings,
        }))
    }

    /// Receptance of the rotor at a bearing for backward whirl, by the force of one of its rows, m/N.
    fn rotor(&self, bearing: &WhirlBearing, frequency: f64) -> Result<C64, RotorError> {
        let turning = self.speed.signum();
        let s = C64::new(0.0, -turning * frequency);
        let own = (self.responder).receptance(bearing.coordinate, self.speed, s)?;
        // all rows push the rotor, and each race feels the force of its row
        let own = own * bearing.constants.planes;
        // against negative spin whirl turns with positive angles: the mirror image
        Ok(if turning < 0.0 { own.conj() } else { own })
    }

    /// Everything of one bearing.
    pub fn find(&self, bearing: &WhirlBearing) -> Result<BearingWhirl, RotorError> {
        let [low, high] = bearing.range;
        if low >= high {
            return Ok(BearingWhirl::default());
        }
        let last = (POINTS - 1) as f64;
        let even = (0..POINTS).map(|k| low * (high / low).powf(k as f64 / last));
        let near = self.natural.iter().copied();
        let mut frequencies: Vec<f64> = even
            .chain(near.filter(|own| (low..=high).contains(own)))
            .collect();
        frequencies.sort_by(f64::total_cmp);
        frequencies.dedup_by(|a, b| *a - *b <= 1e-9 * *a);
        let rotor = frequencies.iter().map(|own| self.rotor(bearing, *own));
        let rotor: Vec<C64> = rotor.collect::<Result<_, _>>()?;
        let samples = Samples {
            model: self,
            bearing,
            frequencies: &frequencies,
            rotor: &rotor,
        };
        let (mount, friction) = (&bearing.constants.mount, bearing.constants.contact.friction);
        let found = samples.on(mount, |curve| BearingWhirl {
            curve: curve.points(),
            smallest: curve.smallest(EXACT),
            ranges: curve.ranges(friction),
            map: (!bearing.is_held()).then(|| samples.map(friction)),
        });
        Ok(found)
    }
}

/// The rotor after its release: supports and seals that stay, averaged over the directions, and a place for each bearing. Names of those that differ
/// with the direction.
fn in_flight(model: &RotorModel, nodes: &[usize]) -> (Rotor, Vec<String>) {
    let mut free = model.rotor.clone();
    let stays = model.supports.iter().map(|given| given.stays);
    let mut kept = stays.clone();
    free.supports.retain(|_| kept.next().unwrap_or_default());
    let own = model.supports.iter().filter(|given| given.stays);
    let unequal = own.filter(|given| !given.coefficients.turns());
    let names = unequal.map(|given| given.name.clone()).collect();
    for support in &mut free.supports {
        let rows = support.coefficients.rows().iter();
        let rows = rows.map(|(speed, block)| (*speed, block.equal_part()));
        if let Some(equal) = Coefficients::table(rows.collect()) {
            support.coefficients = equal;
        }
    }
    // residual flexibility where the contact forces act
    free.supports.extend(nodes.iter().map(|node| Support {
        at: Place::Node(*node),
        on: None,
        coefficients: Coefficients::constant(Block::default()),
        seal: true,
    }));
    (free, names)
}

/// Stiffness of spring and branches of all rows together, N/m.
fn static_to_glassy(constants: &AuxiliaryBearingConstants) -> f64 {
    let branches = constants.mount_parts.branches.iter();
    let branches: f64 = branches.map(|branch| branch.stiffness).sum();
    constants.planes * (constants.mount.stiffness + branches)
}

impl WhirlBearing {
    /// Whether the race stands whatever happens.
    pub fn is_held(&self) -> bool {
        self.constants.inner_race.centre_held
    }

    /// Receptance of the race on a mount with another spring and damper, for motion e^{-jωt}, m/N.
    fn race(&self, spring: &Mount<f64>, frequency: f64) -> C64 {
        if self.is_held() {
            return C64::default();
        }
        let parts = &self.constants.mount_parts;
        let mut own = parts.linear(spring, frequency);
        if let Some(housing) = &parts.housing {
            own = own.in_series(housing.dynamic_stiffness(frequency));
        }
        let stiffness = C64::new(own.storage, own.loss);
        (stiffness - self.constants.mass_on_mount() * frequency * frequency)
            .inv()
            .conj()
    }
}

/// Share to which the frequency of least friction is found, in the curve and in the map.
const EXACT: f64 = 1e-9;
const COARSE: f64 = 1e-4;

/// The rotor at the frequencies of the curve of one bearing.
struct Samples<'a> {
    model: &'a WhirlModel,
    bearing: &'a WhirlBearing,
    frequencies: &'a [f64],
    rotor: &'a [C64],
}

impl Samples<'_> {
    /// What there is of the curve on a mount.
    fn on<T>(&self, mount: &Mount<f64>, find: impl FnOnce(&WhirlCurve) -> T) -> T {
        let contact = &self.bearing.constants.contact;
        let contact = WhirlContact {
            clearance: contact.radial_clearance,
            stiffness: contact.stiffness,
            exponent: contact.exponent,
        };
        let race = |frequency: f64| self.bearing.race(mount, frequency);
        let each = self.frequencies.iter().zip(self.rotor);
        let sampled = each.map(|(frequency, rotor)| (*frequency, rotor + race(*frequency)));
        let between = |frequency: f64| {
            let rotor = self.model.rotor(self.bearing, frequency).ok()?;
            Some(rotor + race(frequency))
        };
        find(&WhirlCurve::new(contact, sampled.collect(), &between))
    }

    fn map(&self, friction: f64) -> MountMap {
        let own = &self.bearing.constants.mount;
        let damping = match own.damping > 0.0 {
            true => own.damping,
            false => {
                SMALL_DAMPING * (own.stiffness * self.bearing.constants.mass_on_mount()).sqrt()
            }
        };
        let around = |middle: f64| -> Vec<f64> {
            let steps = (-SIDE..=SIDE).map(|k| middle * 10f64.powf(f64::from(k) / PER_DECADE));
            steps.collect()
        };
        let (stiffnesses, dampings) = (around(own.stiffness), around(damping));
        let with = |stiffness: f64, damping: f64| Mount {
            stiffness,
            damping,
            ..*own
        };
        // a mount on which no friction drives whirl has no number
        let smallest = |mount: &Mount<f64>| {
            let found = self.on(mount, |curve| curve.smallest(COARSE));
            found.map_or(f64::NAN, |own| own.point.friction)
        };
        let exceeds = |found: f64| found.is_nan() || found > friction;
        let (mut all, mut nearest, mut least) = (Vec::new(), None, i32::MAX);
        for (row, damping) in (-SIDE..).zip(&dampings) {
            for (column, stiffness) in (-SIDE..).zip(&stiffnesses) {
                let mount = with(*stiffness, *damping);
                let found = smallest(&mount);
                let distance = row * row + column * column;
                if exceeds(found) && distance < least {
                    (nearest, least) = (Some(mount), distance);
                }
                all.push(found);
            }
        }
        let enough = |damping: f64| exceeds(smallest(&with(own.stiffness, damping)));
        let cure = nearest_range(&dampings, own.damping, &enough);
        MountMap {
            stiffnesses,
            dampings,
            friction: all,
            cure,
            nearest,
        }
    }
}

/// The range nearest to today's damping in which a property holds, its ends between the values tried refined; more damping may lock a mount.
fn nearest_range(tried: &[f64], today: f64, enough: &dyn Fn(f64) -> bool) -> Option<DampingRange> {
    let mut all = tried.to_vec();
    if today > 0.0 {
        all.push(today);
    }
    all.sort_by(f64::total_cmp);
    let holds: Vec<bool> = all.iter().map(|damping| enough(*damping)).collect();
    let distance = |k: &usize| (all[*k] / today.max(all[0])).ln().abs();
    let good = (0..all.len()).filter(|k| holds[*k]);
    let middle = good.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let edge = |good: f64, bad: f64| {
        let (mut good, mut bad) = (good, bad);
        while (good - bad).abs() > 1e-4 * good {
            let half = 0.5 * (good + bad);
            match enough(half) {
                true => good = half,
                false => bad = half,
            }
        }
        good
    };
    let below = (0..middle).rev().find(|k| !holds[*k]);
    let above = (middle..all.len()).find(|k| !holds[*k]);
    Some(DampingRange {
        from: below.map_or(all[0], |k| edge(all[k + 1], all[k])),
        to: above.map_or(all[all.len() - 1], |k| edge(all[k - 1], all[k])),
        open: [below.is_none(), above.is_none()],
    })
}
