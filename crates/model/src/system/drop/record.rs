//! What is watched and kept of a drop.
//!
//! Contacts begin, end and peak on dense output, not on the steps. Rows are sampled at equal intervals and at the end.
//! The rows are allocated before the run; only the list of contacts may grow during it.

use super::DropMachine;
use super::layout::{
    BEARING, INNER, LAND_FORCE, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE,
    NORMAL_FORCE, NORMAL_FORCE_RATE, OUTER, PENETRATION, PENETRATION_SPEED, ROTOR,
};
use super::rate::{race_motion, rotor_motion};
use crate::contact::ContactReaction;
use crate::system::sampling::{Peak, Rise, Row, Rows};
use number::Vec2;
use solve::watch::{maximum, root};
use solve::{Flow, Observer, Step};

/// One contact of rotor and inner race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Begin, s.
    pub start: f64,
    /// End, s; none while it lasts.
    pub end: Option<f64>,
    /// Largest normal force, N.
    pub peak_force: f64,
    /// Its instant, s.
    pub peak_time: f64,
}

/// Everything kept of one machine.
#[derive(Clone, Debug)]
pub struct Record {
    /// Contacts in order.
    pub contacts: Vec<Contact>,
    /// Largest ball load at the inner race, N.
    pub largest_inner_load: Peak,
    /// Largest ball load at the outer race, N.
    pub largest_outer_load: Peak,
    /// Largest force between a ball and its pocket, or between two balls without a cage, N.
    pub largest_pocket_force: Peak,
    /// Largest force between cage and land, N.
    pub largest_land_force: Peak,
    /// Largest distance of the rotor's geometric centre from the inner race's centre, m.
    pub rotor_race_displacement: Peak,
    /// Largest distance of the rotor's geometric centre from the origin while it touches the race, m.
    pub rotor_displacement: Peak,
    /// Largest displacement of the outer race, m.
    pub mount_displacement: Peak,
    /// Largest kinetic energy of the rotor's centre, J.
    pub largest_translation: f64,
    /// Turns of the rotor about the inner race while it is out of the middle half of its clearance.
    pub whirl_turns: f64,
    rises: Vec<Rise>,
    /// The watched forces at the start of the last step, N, and its length, s.
    last_forces: ([f64; WATCHED.len()], f64),
    rows: Rows,
    clearance: f64,
    whirl_angle: Option<f64>,
    next_look: f64,
    look_interval: f64,
    limits: Limits,
    limit_passed: bool,
}

/// Where the equations stop being true.
#[derive(Clone, Copy, Debug)]
struct Limits {
    mount_displacement: f64,
    penetration: f64,
}

/// Forces whose largest values are kept.
const WATCHED: [usize; 4] = [
    LARGEST_INNER_LOAD,
    LARGEST_OUTER_LOAD,
    LARGEST_POCKET_FORCE,
    LAND_FORCE,
];

/// So many of the first of them are searched for between the steps as well; the others are chaotic.
const SEARCHED: usize = 2;

/// A peak is searched for inside a step when a value comes this near to the record.
const NEAR_RECORD: f64 = 0.9;
/// A peak that rises above both ends of its step by less than this share of the record is not worth searching.
const STEADY: f64 = 1e-4;
/// Points a turn of the rotor at which its whirl is followed.
const WHIRL_POINTS: f64 = 64.0;
/// Contacts for which room is made before the run.
const CONTACTS: usize = 4096;

impl Record {
    /// A record for a run until `end`, with a row every `interval`, or without rows.
    pub fn new(machine: &DropMachine, end: f64, interval: f64, keep_rows: bool) -> Self {
        let constants = &machine.constants;
        let speed = constants.speed;
        let mut rises = vec![
            Rise::through(INNER + 5, 0.5 * speed),
            Rise::through(INNER + 5, 0.95 * speed),
        ];
        if machine.layout().ball_states {
            let ratio = machine.rolling_cage_ratio();
            rises.push(Rise::through(BEARING + 1, 0.95 * speed * ratio));
        }
        Record {
            contacts: Vec::with_capacity(CONTACTS),
            largest_inner_load: Peak::NONE,
            largest_outer_load: Peak::NONE,
            largest_pocket_force: Peak::NONE,
            largest_land_force: Peak::NONE,
            rotor_race_displacement: Peak::NONE,
            rotor_displacement: Peak::NONE,
            mount_displacement: Peak::NONE,
            largest_translation: 0.0,
            whirl_turns: 0.0,
            rises,
            last_forces: ([0.0; WATCHED.len()], f64::INFINITY),
            rows: Rows::new(machine, end, interval, keep_rows),
            clearance: constants.machine.contact.radial_clearance,
            whirl_angle: None,
            next_look: 0.0,
            look_interval: 2.0 * std::f64::consts::PI / (WHIRL_POINTS * speed.abs().max(1.0)),
            limits: Limits {
                mount_displacement: 0.1 * machine.pitch_radius(),
                penetration: 0.1 * constants.machine.contact.bore_radius,
            },
            limit_passed: false,
        }
    }

    /// First instant the inner race reaches half the rotor's release speed, s.
    pub fn inner_race_time_to_50_percent(&self) -> Option<f64> {
        self.rises[0].time
    }
    /// First instant the inner race reaches 95 % of the rotor's release speed, s.
    pub fn inner_race_time_to_95_percent(&self) -> Option<f64> {
        self.rises[1].time
    }
    /// First instant the cage reaches 95 % of the rolling cage speed of the rotor's release speed, s.
    pub fn cage_time_to_95_percent(&self) -> Option<f64> {
        // where balls roll the cage follows the race
        self.rises.get(2).unwrap_or(&self.rises[1]).time
    }
    /// The largest normal force of all contacts.
    pub fn peak_contact_force(&self) -> Option<Peak> {
        let peaks = self.contacts.iter().map(|c| Peak {
            value: c.peak_force,
            time: c.peak_time,
        });
        peaks.reduce(|a, b| if b.value > a.value { b } else { a })
    }
    /// Number of rows.
    pub fn row_count(&self) -> usize {
        self.rows.count()
    }
    /// The sampled rows.
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter()
    }
    /// Adds the last state of a run as a row, where it is not one already.
    pub fn finish(&mut self, machine: &DropMachine, time: f64, state: &[f64]) {
        let (_, probe) = machine.inspect(state);
        self.rows.finish(&Row {
            time,
            state,
            probe: &probe,
            content: machine.content(state),
        });
    }

    fn contacts_of(&mut self, step: &mut Step<DropMachine>) {
        let (start, end) = (step.start_probe(PENETRATION), step.end_probe(PENETRATION));
        let rates = (
            step.start_probe(PENETRATION_SPEED),
            step.end_probe(PENETRATION_SPEED),
        );
        let length = step.end - step.start;
        // the extremum of the penetration inside the step, where its rate changes sign
        let turning = if (rates.0 > 0.0) != (rates.1 > 0.0) {
            // Hermite estimate of the bulge beyond the ends; searched only where it matters
            let bulge = 0.125 * length * (rates.0 - rates.1);
            let middle = 0.5 * (start + end) + bulge;
            let flips = (start > 0.0) == (end > 0.0) && (middle + bulge > 0.0) != (end > 0.0);
            let record = rates.0 > 0.0
                && middle + self.clearance + bulge > self.rotor_race_displacement.value;
            (flips || record).then(|| {
                let theta = root(step, (0.0, rates.0), (1.0, rates.1), |step, theta| {
                    contact_at(step, theta).penetration_speed
                });
                (theta, contact_at(step, theta).penetration)
            })
        } else {
            None
        };
        if let Some((theta, value)) = turning {
            let time = step.time(theta);
            self.rotor_race_displacement
                .raise(value + self.clearance, time);
        }
        self.rotor_race_displacement
            .raise(end + self.clearance, step.end);
        if end > 0.0 {
            let rotor = Vec2::new(step.end_state(ROTOR), step.end_state(ROTOR + 1));
            // nearer than this, the eccentric centre cannot be farther than ever before
            let eccentricity = step.machine.constants.machine.rotor.eccentricity;
            let least = (self.rotor_displacement.value - eccentricity.abs()).max(0.0);
            if rotor.length_squared() >= least * least {
                let centre = step.machine.rotor_centre(&end_of_rotor(step));
                self.rotor_displacement
                    .raise(centre.length_squared().sqrt(), step.end);
            }
        }

        if start > 0.0 && self.contacts.is_empty() {
            // a start in contact: it began before the run
            self.contacts.push(Contact {
                start: step.start,
                end: None,
                peak_force: step.start_probe(NORMAL_FORCE),
                peak_time: step.start,
            });
        }
        let mut from = (0.0, start);
        for to in turning.into_iter().chain([(1.0, end)]) {
            let crosses = (from.1 > 0.0) != (to.1 > 0.0);
            let event = crosses.then(|| {
                root(step, from, to, |step, theta| {
                    contact_at(step, theta).penetration
                })
            });
            if let (Some(begin), true) = (event, to.1 > 0.0) {
                self.contacts.push(Contact {
                    start: step.time(begin),
                    end: None,
                    peak_force: 0.0,
                    peak_time: step.time(begin),
                });
                self.force_peak(step, begin, to.0);
            } else if from.1 > 0.0 {
                self.force_peak(step, from.0, event.unwrap_or(to.0));
                if let (Some(open), Some(contact)) = (event, self.contacts.last_mut()) {
                    contact.end = Some(step.time(open));
                }
            }
            from = to;
        }
    }

    /// The largest normal force between two fractions of a step raises the peak of the current contact.
    fn force_peak(&mut self, step: &mut Step<DropMachine>, low: f64, high: f64) {
        let Some(contact) = self.contacts.last_mut() else {
            return;
        };
        let mut peak = Peak {
            value: contact.peak_force,
            time: contact.peak_time,
        };
        if high == 1.0 {
            peak.raise(step.end_probe(NORMAL_FORCE), step.end);
        }
        let force = (step.start_probe(NORMAL_FORCE), step.end_probe(NORMAL_FORCE));
        let rate = (
            step.start_probe(NORMAL_FORCE_RATE),
            step.end_probe(NORMAL_FORCE_RATE),
        );
        let whole = low == 0.0 && high == 1.0;
        if whole && rate.0 > 0.0 && rate.1 < 0.0 {
            let bulge = 0.125 * (step.end - step.start) * (rate.0 - rate.1);
            if force.0.max(force.1) + 2.0 * bulge > peak.value {
                let (theta, value) = maximum(step, 0.0, 1.0, |step, theta| {
                    contact_at(step, theta).normal_force
                });
                peak.raise(value, step.time(theta));
            }
        } else if !whole {
            // begin or end inside the step: a few points decide whether the peak is here too
            for i in 1..8 {
                let theta = low + (high - low) * f64::from(i) / 8.0;
                let value = contact_at(step, theta).normal_force;
                peak.raise(value, step.time(theta));
            }
        }
        contact.peak_force = peak.value;
        contact.peak_time = peak.time;
    }

    /// Records of the watched forces, in their order.
    fn forces(&mut self) -> [&mut Peak; WATCHED.len()] {
        [
            &mut self.largest_inner_load,
            &mut self.largest_outer_load,
            &mut self.largest_pocket_force,
            &mut self.largest_land_force,
        ]
    }

    fn forces_of(&mut self, step: &mut Step<DropMachine>) {
        let start = WATCHED.map(|probe| step.start_probe(probe));
        let end = WATCHED.map(|probe| step.end_probe(probe));
        let time = step.end;
        let length = step.end - step.start;
        let (last, last_length) = self.last_forces;
        let mut search = false;
        for (k, record) in self.forces().into_iter().enumerate() {
            record.raise(end[k], time);
            if k < SEARCHED && start[k].max(end[k]) > NEAR_RECORD * record.value {
                let last_slope = (start[k] - last[k]) / last_length;
                let slope = (end[k] - start[k]) / length;
                search |= may_peak(last_slope, slope, length, STEADY * record.value);
            }
        }
        self.last_forces = (start, length);
        if search {
            for theta in [0.25, 0.5, 0.75] {
                let time = step.time(theta);
                let (_, probe) = step.evaluate(theta);
                let values = WATCHED.map(|channel| probe[channel]);
                for (record, value) in self.forces().into_iter().zip(values) {
                    record.raise(value, time);
                }
            }
        }
    }

    fn mount_of(&mut self, step: &mut Step<DropMachine>) {
        let end = |k: usize| step.end_state(OUTER + k);
        let square = end(0) * end(0) + end(1) * end(1);
        let record = self.mount_displacement.value;
        if square < (NEAR_RECORD * record).powi(2) {
            return;
        }
        let start = |k: usize| step.start_state(OUTER + k);
        let outward = (
            start(0) * start(2) + start(1) * start(3),
            end(0) * end(2) + end(1) * end(3),
        );
        self.mount_displacement.raise(square.sqrt(), step.end);
        if outward.0 > 0.0 && outward.1 < 0.0 {
            for i in 1..8 {
                let theta = f64::from(i) / 8.0;
                let time = step.time(theta);
                let state = step.leading_state(theta, BEARING);
                self.mount_displacement
                    .raise(state[OUTER].hypot(state[OUTER + 1]), time);
            }
        }
    }

    /// Follows the whirl, and the kinetic energy of the rotor's centre, at a few points of each turn.
    fn rotor_of(&mut self, step: &mut Step<DropMachine>) {
        if step.end < self.next_look {
            return;
        }
        self.next_look = step.end + self.look_interval;
        let gap = -step.end_probe(PENETRATION);
        let constants = &step.machine.constants.machine;
        let rotor = rotor_motion(&end_of_rotor(step));
        let (translation, _) = constants.rotor.kinetic_energy(&rotor);
        self.largest_translation = self.largest_translation.max(translation);
        if gap > 0.5 * self.clearance {
            self.whirl_angle = None;
            return;
        }
        let centre = constants.rotor.geometric_centre(&rotor);
        let race = Vec2::new(step.end_state(INNER), step.end_state(INNER + 1));
        let offset = centre.position - race;
        let angle = offset.y.atan2(offset.x);
        if let Some(last) = self.whirl_angle {
            let turn = (angle - last) / (2.0 * std::f64::consts::PI);
            self.whirl_turns += turn - turn.round();
        }
        self.whirl_angle = Some(angle);
    }
}

/// Whether a value with these mean slopes over the last and this step may have a peak inside this step that rises
/// above both ends by more than `least`: judged by the parabola through the three values, taken half as curved again.
fn may_peak(last_slope: f64, slope: f64, length: f64, least: f64) -> bool {
    let curving = 1.5 * (slope - last_slope);
    let (at_start, at_end) = (slope - 0.5 * curving, slope + 0.5 * curving);
    at_start > 0.0 && at_end < 0.0 && -0.125 * curving * length > least
}

/// The rotor's own channels at the end of a step.
fn end_of_rotor(step: &Step<DropMachine>) -> [f64; INNER - ROTOR] {
    let mut rotor = [0.0; INNER - ROTOR];
    for (channel, value) in rotor.iter_mut().enumerate() {
        *value = step.end_state(ROTOR + channel);
    }
    rotor
}

/// The contact of rotor and race at a fraction of a step; inlined, so that nothing is computed but what is asked for.
#[inline(always)]
fn contact_at(step: &mut Step<DropMachine>, theta: f64) -> ContactReaction<f64> {
    let machine = &step.machine.constants.machine;
    let state = step.leading_state(theta, BEARING);
    let rotor = rotor_motion(state);
    let centre = machine.rotor.geometric_centre(&rotor);
    machine
        .contact
        .react(&centre, rotor.spin, &race_motion(state).inner)
}

impl Observer<DropMachine> for Record {
    fn step(&mut self, step: &mut Step<DropMachine>) -> Flow {
        self.contacts_of(step);
        self.forces_of(step);
        for rise in &mut self.rises {
            rise.watch(step);
        }
        self.mount_of(step);
        self.rotor_of(step);
        self.rows.sample(step, DropMachine::content);
        let too_far = self.mount_displacement.value > self.limits.mount_displacement
            || step.end_probe(PENETRATION) > self.limits.penetration;
        if too_far && !self.limit_passed {
            self.limit_passed = true;
            return Flow::Halt(
                "a displacement exceeded a tenth of the bearing: far outside what the model describes",
            );
        }
        Flow::Continue
    }
}

impl DropMachine {
    /// Cage speed per inner race speed when the balls roll.
    pub fn rolling_cage_ratio(&self) -> f64 {
        self.constants.bearing.rolling_cage_ratio()
    }
    /// Radius of the circle of the ball centres, m.
    pub fn pitch_radius(&self) -> f64 {
        self.constants.bearing.pitch_radius()
    }
    /// Position of the rotor's geometric centre, m.
    pub fn rotor_centre(&self, state: &[f64]) -> Vec2<f64> {
        self.constants
            .machine
            .rotor
            .geometric_centre(&rotor_motion(state))
            .position
    }
    /// Cage speed at a state, rad/s.
    pub fn cage_speed(&self, state: &[f64]) -> f64 {
        let own = BEARING..self.layout().ledger();
        self.constants
            .bearing
            .cage_speed(&race_motion(state), &state[own])
    }
    /// Azimuth of a ball at a state, rad.
    pub fn ball_azimuth(&self, state: &[f64], ball: usize) -> f64 {
        let own = BEARING..self.layout().ledger();
        self.constants.bearing.azimuth(&state[own], ball)
    }
}
