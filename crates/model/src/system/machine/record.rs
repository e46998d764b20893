//! What is watched and kept of a machine.
//!
//! Contacts begin, end and peak on dense output, not on the steps. Rows are sampled at equal intervals and at the end.
//! The rows are allocated before the run; only the list of contacts may grow during it.

pub use super::bearing_record::{BearingRecord, Contact};
use super::{MOST_SPEEDS, Mode, RotorMachine};
use crate::auxiliary_bearing::AuxiliaryBearingConstants;
use crate::rotor::{GeometricCentre, RotorAt};
use crate::system::energy::Content;
use crate::system::rig::Tap;
use crate::system::rig::record::RigRecord;
use crate::system::sampling::{Peak, Row, Rows};
use number::Vec2;
use solve::{Flow, Observer, Step};

/// Everything kept of one machine.
#[derive(Clone, Debug)]
pub struct Record {
    /// Of each auxiliary bearing.
    pub bearings: Vec<BearingRecord>,
    rig: Option<Box<RigRecord>>,
    /// Largest kinetic energy of the rotor's centre, J.
    pub largest_translation: f64,
    /// Largest displacement of the rotor along its axis, m, at the ends of the steps.
    pub axial: Peak,
    /// Largest displacement of the rotor at each watched place, m; seen at 64 points a turn.
    pub places: Vec<Peak>,
    /// Largest force of each housing on its mount besides what this carries at rest, N; seen there too.
    pub on_ground: Vec<Peak>,
    /// Of each axis of magnets with controllers: control current, and how long it was at its limit.
    pub currents: Vec<CurrentPeak>,
    /// Of each of these axes: how long its amplifier was at its largest voltage.
    pub voltages: Vec<AtLimit>,
    rows: Rows,
    next_look: f64,
    /// When the first magnet or axis with a controller had lost its power, s, and the spin then, rad/s; none where all have it still.
    pub released: Option<(f64, f64)>,
    /// The same of the last one.
    pub lost: Option<(f64, f64)>,
    /// How long any magnet with a controller had power, s.
    pub powered: f64,
    /// When the rotor reached each of the speeds at which something happens, s; infinite where it did not.
    pub reached: [f64; MOST_SPEEDS],
    /// Which of the unbalances that come on the way the state has.
    pub unbalances: u16,
    /// In which shares of the clearance of each bearing a rotor that is levitated again is to stay.
    within: Vec<f64>,
    /// Each time that it was.
    pub again: Vec<Levitated>,
    limit_passed: bool,
    /// From when on the run halts once the rotor rolls, s.
    rolling_from: Option<f64>,
}

/// The largest control current of an axis of a magnet.
#[derive(Clone, Copy, Debug)]
pub struct CurrentPeak {
    /// Its size, A, at the ends of steps.
    pub largest: Peak,
    /// Largest current of one of its coils, A; of a linear magnet the same.
    pub coil: Peak,
    /// When it was at its limit.
    pub limited: AtLimit,
    /// That limit when it was there first, A.
    pub limit: f64,
}

/// A rotor that is levitated again, until the next loss of all power.
#[derive(Clone, Debug)]
pub struct Levitated {
    /// From when, s.
    pub since: f64,
    /// Until when, s; none where it lasts.
    pub until: Option<f64>,
    /// When it was last outside each share of a clearance within which it is to stay, s.
    pub outside: Vec<Option<f64>>,
    /// When it was last on a face, s.
    pub on_face: Option<f64>,
    /// Largest current of a coil, A.
    pub coil: Peak,
    /// When a coil of each axis was at its limit.
    pub limited: Vec<AtLimit>,
}

/// When something was at its limit, seen at the ends of steps.
#[derive(Clone, Copy, Debug, Default)]
pub struct AtLimit {
    /// How long, s.
    pub duration: f64,
    /// Since when, s; none where it never was.
    pub first: Option<f64>,
}

impl AtLimit {
    const NEVER: AtLimit = AtLimit {
        duration: 0.0,
        first: None,
    };
    /// A step at its limit.
    fn add(&mut self, time: f64, length: f64) {
        self.duration += length;
        self.first.get_or_insert(time);
    }
}

/// Share of the largest current, or voltage, from which on it is at its limit.
const AT_LIMIT: f64 = 0.999;

/// Why a run halts whose rotor rolls in all of its bearings.
pub const ROLLS: &str = "the rotor rolls in its bearings";

/// Points a turn of the rotor at which its whirl is followed.
const WHIRL_POINTS: f64 = 64.0;
/// Spin below which it is looked at no less often, rad/s.
const SLOWEST: f64 = 100.0;

impl CurrentPeak {
    const NONE: CurrentPeak = CurrentPeak {
        largest: Peak::NONE,
        coil: Peak::NONE,
        limited: AtLimit::NEVER,
        limit: f64::NAN,
    };
}

/// From one look at the rotor to the next, s; its spin, rad/s.
fn look_interval(spin: f64) -> f64 {
    2.0 * std::f64::consts::PI / (WHIRL_POINTS * spin.max(SLOWEST))
}

impl Record {
    /// A record for a run until `end`, with a row every `interval`, or without rows.
    pub fn new(machine: &RotorMachine, end: f64, interval: f64, keep_rows: bool) -> Self {
        Record::with_taps(machine, end, keep_rows.then_some(interval), &[])
    }
    /// A record for a run until `end`, with a row every `interval` where there is one; of a rig with what a converter samples.
    pub fn with_taps(
        machine: &RotorMachine,
        end: f64,
        interval: Option<f64>,
        taps: &[Tap],
    ) -> Self {
        let keep_rows = interval.is_some();
        let bearings = 0..machine.constants.bearings.len();
        let at_once = |lost: bool| lost.then_some((0.0, machine.constants.speed));
        let [released, lost] = machine.starts_without_power().map(at_once);
        Record {
            bearings: bearings
                .map(|k| BearingRecord::new(machine, k, keep_rows))
                .collect(),
            rig: RigRecord::new(machine, end, taps).map(Box::new),
            largest_translation: 0.0,
            axial: Peak::NONE,
            places: vec![Peak::NONE; machine.constants.rotor.places.len()],
            on_ground: vec![Peak::NONE; machine.constants.rotor.housings],
            currents: match machine.controlled() {
                true => vec![CurrentPeak::NONE; machine.axes().count()],
                false => Vec::new(),
            },
            voltages: match machine.controlled() {
                true => vec![AtLimit::default(); machine.axes().count()],
                false => Vec::new(),
            },
            rows: Rows::new(machine, end, interval.unwrap_or(f64::INFINITY), keep_rows),
            next_look: 0.0,
            released,
            lost,
            powered: 0.0,
            reached: [f64::INFINITY; MOST_SPEEDS],
            unbalances: machine.unbalances,
            within: Vec::new(),
            again: Vec::new(),
            limit_passed: false,
            rolling_from: None,
        }
    }
    /// The same of a run that halts with [`ROLLS`] when the rotor rolls, from a time on, s.
    #[must_use]
    pub fn until_rolling(self, from: f64) -> Self {
        Record {
            rolling_from: Some(from),
            ..self
        }
    }
    /// The same of a run that sees when a rotor that is levitated again is last outside these shares of the clearances.
    #[must_use]
    pub fn staying_within(self, within: Vec<f64>) -> Self {
        Record { within, ..self }
    }
    /// What is kept of a rig besides its bearing.
    ///
    /// # Panics
    /// When the machine is none.
    pub fn rig(&self) -> &RigRecord {
        self.rig.as_deref().expect("a machine on a rig")
    }
    /// The same with one row alone, that of an instant, s.
    #[must_use]
    pub fn now(&mut self, machine: &RotorMachine, time: f64, state: &[f64]) -> Self {
        let one = self.rows.of_one();
        // the rows of a run are many
        let rows = std::mem::replace(&mut self.rows, one);
        let mut now = self.clone();
        self.rows = rows;
        for bearing in &mut now.bearings {
            bearing.warmth = (bearing.warmth.take()).map(|own| Box::new(own.going_on()));
        }
        now.finish(machine, time, state);
        now
    }
    /// Contacts of all bearings so far, those that last among them, and ends of contacts.
    pub fn touched(&self) -> [usize; 2] {
        let all = || self.bearings.iter().flat_map(|own| &own.contacts);
        [all().count(), all().filter(|own| own.end.is_some()).count()]
    }
    /// Number of rows.
    pub fn row_count(&self) -> usize {
        self.rows.count()
    }
    /// The sampled rows.
    pub fn rows(&self) -> impl DoubleEndedIterator<Item = Row<'_>> {
        self.rows.iter()
    }
    /// Adds the last state of a run as a row, where it is not one already.
    pub fn finish(&mut self, machine: &RotorMachine, time: f64, state: &[f64]) {
        // of very many members the room that none needed would fill the memory
        for bearing in &mut self.bearings {
            bearing.contacts.shrink_to_fit();
            bearing.warm(machine, time, &|channel| state[channel]);
        }
        let probe = match &self.rig {
            Some(rig) => machine.last_probes(&rig.mode, time, state),
            None => machine.inspect(state).1,
        };
        if self.rig.is_none() {
            for bearing in &mut self.bearings {
                bearing.look(machine, time, state);
            }
        }
        let mut state = state.to_vec();
        let content = machine.row(&mut state);
        self.rows.finish(&Row {
            time,
            state: &state,
            probe: &probe,
            content,
        });
    }

    /// Follows the control currents, at the end of each step, and sees them lost.
    fn currents_of(&mut self, step: &mut Step<RotorMachine>) {
        if self.currents.is_empty() {
            return;
        }
        let (machine, time, length) = (step.machine, step.end, step.end - step.start);
        let on_face = self.bearings.iter().any(|own| own.is_on_face(step));
        let state = step.leading_state(1.0, machine.layout().magnets.end);
        let [powered, _] = machine.powered(state);
        if powered {
            self.powered += length;
        }
        let currents = machine.currents(time, state);
        let limits = machine.coil_limits(state);
        let mut again = self.again.last_mut().filter(|own| own.until.is_none());
        let axes = self.currents.iter_mut().zip(limits).zip(currents);
        for (axis, ((own, limit), (current, coils))) in axes.enumerate() {
            own.largest.raise(current.abs(), time);
            let coil = coils[0].max(coils[1]);
            own.coil.raise(coil, time);
            let limited = powered && coil >= AT_LIMIT * limit;
            if limited {
                if own.limited.first.is_none() {
                    own.limit = limit;
                }
                own.limited.add(time, length);
            }
            if let Some(again) = &mut again {
                again.coil.raise(coil, time);
                if limited {
                    again.limited[axis].add(time, length);
                }
            }
        }
        if let Some(again) = again {
            if on_face {
                again.on_face = Some(time);
            }
            let away = (0..self.bearings.len()).map(|k| {
                let clearance = machine.constants.bearings[k].contact.radial_clearance;
                let [ground, _] = machine.ground(k, state);
                let away = machine.node(k, state).position - ground;
                away.length_squared().sqrt() / clearance
            });
            let rotor = machine.layout().rotor;
            let along = |bearing: &AuxiliaryBearingConstants| {
                let place = state[rotor.place()];
                let faces = bearing.spatial().map_or(&[][..], |own| &own.landing.faces);
                let shares = faces
                    .iter()
                    .map(|face| place / (face.place - face.shoulder));
                shares.fold(0.0, f64::max)
            };
            let bearings = machine.constants.bearings.iter().filter(|_| rotor.axial);
            let away = away.chain(bearings.map(along)).fold(0.0, f64::max);
            for (_, last) in
                (self.within.iter().zip(&mut again.outside)).filter(|own| away > *own.0)
            {
                *last = Some(time);
            }
        }
        let shares = machine.voltage_shares(time, state);
        for (own, share) in self.voltages.iter_mut().zip(shares) {
            if share >= AT_LIMIT {
                own.add(time, length);
            }
        }
    }

    /// Follows the whirl, and the kinetic energy of the rotor's centre, at a few points of each turn.
    fn rotor_of(&mut self, step: &mut Step<RotorMachine>) {
        if step.end < self.next_look {
            return;
        }
        let (machine, time) = (step.machine, step.end);
        let rotor = machine.layout().rotor;
        let state = step.leading_state(1.0, rotor.channels());
        let motion = rotor.motion(state);
        // a rotor that runs up is looked at as often a turn
        let spin = motion.spin.abs().max(machine.constants.speed.abs());
        self.next_look = time + look_interval(spin);
        let content = (machine.one.rotor).content(&motion, machine.constants.gravity);
        self.largest_translation = self.largest_translation.max(content.translation);
        for (peak, place) in self.places.iter_mut().zip(&machine.places) {
            let position = place.centre(&motion).position;
            peak.raise(position.length_squared().sqrt(), time);
        }
        for (k, peak) in self.on_ground.iter_mut().enumerate() {
            peak.raise(machine.on_ground(k, state).length_squared().sqrt(), time);
        }
        for bearing in &mut self.bearings {
            bearing.whirl_of(step);
        }
    }
}

/// Why a run halts whose rotor comes to a pole, beyond which no law of the magnets holds.
pub const AT_POLE: &str = "the rotor has come to a pole of a magnet";

/// Whether the rotor is at a pole of a magnet at the end of a step.
fn at_pole(step: &mut Step<RotorMachine>) -> bool {
    let machine = step.machine;
    let pairs = machine.axes().any(|axis| axis.law.gap().is_finite());
    let rotor = machine.layout().rotor.channels();
    pairs
        && (machine.towards_poles(step.leading_state(1.0, rotor)).iter()).any(|share| *share >= 1.0)
}

impl Observer<RotorMachine> for Record {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        if let Some(rig) = &mut self.rig {
            rig.step(step);
            self.bearings[0].on_rig(step);
            self.rows.sample(step, RotorMachine::row);
            return Flow::Continue;
        }
        for bearing in &mut self.bearings {
            bearing.contacts_of(step);
            bearing.forces_of(step);
            for rise in &mut bearing.rises {
                rise.watch(step);
            }
            bearing.mount_of(step);
            bearing.heat_of(step);
            bearing.warmth_of(step);
            bearing.balls_of(step);
        }
        if let rotor @ RotorAt { axial: true, .. } = step.machine.layout().rotor {
            self.axial
                .raise(step.end_state(rotor.place()).abs(), step.end);
        }
        self.rotor_of(step);
        self.currents_of(step);
        if at_pole(step) {
            return Flow::Halt(AT_POLE);
        }
        self.rows.sample(step, RotorMachine::row);
        if let Some(from) = self.rolling_from {
            let mut rolling = self
                .bearings
                .iter_mut()
                .map(|bearing| bearing.rolling_of(step));
            // every bearing counts its turns
            if rolling.by_ref().fold(true, |all, one| all & one) && step.end >= from {
                return Flow::Halt(ROLLS);
            }
        }
        let too_far = self.bearings.iter().any(|bearing| bearing.too_far(step));
        if too_far && !self.limit_passed {
            self.limit_passed = true;
            return Flow::Halt(
                "a displacement exceeded a tenth of the bearing: far outside what the model describes",
            );
        }
        Flow::Continue
    }
    fn switched(
        &mut self,
        machine: &RotorMachine,
        mode: &Mode<f64>,
        time: f64,
        state: &[f64],
    ) -> Flow {
        if machine.controlled() && self.lost.is_some() {
            let [any, _] = machine.powered(state);
            let last = self.again.last_mut().filter(|own| own.until.is_none());
            match last {
                Some(last) if !any => last.until = Some(time),
                None if any => self.again.push(Levitated {
                    since: time,
                    until: None,
                    outside: vec![None; self.within.len()],
                    on_face: None,
                    coil: Peak::NONE,
                    limited: vec![AtLimit::NEVER; self.currents.len()],
                }),
                _ => {}
            }
        } else if machine.controlled() {
            let spin = state[machine.layout().rotor.spin()];
            let [any, all] = machine.powered(state);
            if !all && self.released.is_none() {
                for bearing in &mut self.bearings {
                    bearing.released(machine, spin);
                }
                self.released = Some((time, spin));
            }
            self.lost = (!any).then_some((time, spin));
        }
        self.reached = mode.reached.map(|own| own.at);
        self.unbalances = mode.unbalances;
        if let Some(rig) = &mut self.rig {
            let speed = state[machine.layout().bearings[0].inner.spin()];
            rig.switched(mode, time, speed);
        }
        Flow::Continue
    }
}

impl RotorMachine {
    /// Energies and momentum of a state, which is put as the machine of the start has it.
    fn row(&self, state: &mut [f64]) -> Content {
        let content = self.content(state);
        self.as_begun(state);
        content
    }
    /// Displacement of the rotor's geometric centre at a watched place from the line of levitation, m.
    pub fn place(&self, place: usize, state: &[f64]) -> Vec2<f64> {
        let motion = self.layout.rotor.motion(state);
        self.places[place].centre(&motion).position
    }
    /// Force of a housing on its mount besides what this carries at rest, N.
    pub fn on_ground(&self, housing: usize, state: &[f64]) -> Vec2<f64> {
        let motion = self.layout.rotor.motion(state);
        let mounts = self.one.seals.len() - self.constants.rotor.housings;
        let (node, mount) = &self.one.seals[mounts + housing];
        let centre = node.centre(&motion);
        mount.carried - (mount.react(centre.position, centre.velocity, motion.spin)).force
    }
    /// The rotor's geometric centre at its node in a bearing, from the datum of that.
    #[inline(always)]
    pub fn node(&self, bearing: usize, state: &[f64]) -> GeometricCentre<f64> {
        self.one.nodes[bearing].centre(&self.layout.rotor.motion(state))
    }
    /// Position, m, and speed, m/s, of what the mount of a bearing stands on.
    #[inline(always)]
    pub fn ground(&self, bearing: usize, state: &[f64]) -> [Vec2<f64>; 2] {
        match self.one.housed {
            false => [Vec2::zero(); 2],
            true => (self.one).ground(bearing, &self.layout().rotor.motion(state)),
        }
    }
    /// Cage speed of a bearing at a state, rad/s.
    pub fn cage_speed(&self, bearing: usize, state: &[f64]) -> f64 {
        let at = &self.layout().bearings[bearing];
        (self.constants.bearings[bearing].bearing).cage_speed(&at.motion(state), &state[at.own()])
    }
}
