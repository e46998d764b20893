//! Contacts of rotor and race in a run: they begin, end and peak on dense output.

use super::{BearingRecord, centre_at_end, contact_at, mass_centre_at_end};
use crate::auxiliary_bearing::probe::{
    NORMAL_FORCE, NORMAL_FORCE_RATE, PENETRATION, PENETRATION_SPEED,
};
use crate::system::machine::RotorMachine;
use crate::system::sampling::Peak;
use solve::Step;
use solve::watch::{maximum, root};

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
    /// Largest temperature rise of the patch, K; 0 where surfaces are not followed.
    pub peak_rise: f64,
}

impl BearingRecord {
    pub(in super::super) fn contacts_of(&mut self, step: &mut Step<RotorMachine>) {
        let (at, bearing) = (self.at, self.bearing);
        // it may follow the temperatures
        self.clearance = step.machine.constants.bearings[bearing]
            .contact
            .radial_clearance;
        let (start, end) = (
            step.start_probe(at.probe(PENETRATION)),
            step.end_probe(at.probe(PENETRATION)),
        );
        let rates = (
            step.start_probe(at.probe(PENETRATION_SPEED)),
            step.end_probe(at.probe(PENETRATION_SPEED)),
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
                    contact_at(step, bearing, theta).penetration_speed
                });
                (theta, contact_at(step, bearing, theta).penetration)
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
        self.reach.watch(end + self.clearance, step.end);
        if end > 0.0 {
            // nearer than this, the eccentric centre cannot be farther than ever before
            let least = (self.rotor_displacement.value - self.eccentricity).max(0.0);
            if mass_centre_at_end(step, bearing).length_squared() >= least * least {
                let centre = centre_at_end(step, bearing) + step.machine.one.nodes[bearing].datum;
                self.rotor_displacement
                    .raise(centre.length_squared().sqrt(), step.end);
            }
        }

        if start > 0.0 && self.contacts.is_empty() {
            // a start in contact: it began before the run
            self.contacts.push(Contact {
                start: step.start,
                end: None,
                peak_force: step.start_probe(at.probe(NORMAL_FORCE)),
                peak_time: step.start,
                peak_rise: 0.0,
            });
        }
        let mut from = (0.0, start);
        for to in turning.into_iter().chain([(1.0, end)]) {
            let crosses = (from.1 > 0.0) != (to.1 > 0.0);
            let event = crosses.then(|| {
                root(step, from, to, |step, theta| {
                    contact_at(step, bearing, theta).penetration
                })
            });
            if let (Some(begin), true) = (event, to.1 > 0.0) {
                self.contacts.push(Contact {
                    start: step.time(begin),
                    end: None,
                    peak_force: 0.0,
                    peak_time: step.time(begin),
                    peak_rise: 0.0,
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
    fn force_peak(&mut self, step: &mut Step<RotorMachine>, low: f64, high: f64) {
        let (at, bearing) = (self.at, self.bearing);
        let Some(contact) = self.contacts.last_mut() else {
            return;
        };
        let mut peak = Peak {
            value: contact.peak_force,
            time: contact.peak_time,
        };
        if high == 1.0 {
            peak.raise(step.end_probe(at.probe(NORMAL_FORCE)), step.end);
        }
        let force = (
            step.start_probe(at.probe(NORMAL_FORCE)),
            step.end_probe(at.probe(NORMAL_FORCE)),
        );
        let rate = (
            step.start_probe(at.probe(NORMAL_FORCE_RATE)),
            step.end_probe(at.probe(NORMAL_FORCE_RATE)),
        );
        let whole = low == 0.0 && high == 1.0;
        if whole && rate.0 > 0.0 && rate.1 < 0.0 {
            let bulge = 0.125 * (step.end - step.start) * (rate.0 - rate.1);
            if force.0.max(force.1) + 2.0 * bulge > peak.value {
                let (theta, value) = maximum(step, 0.0, 1.0, |step, theta| {
                    contact_at(step, bearing, theta).normal_force
                });
                peak.raise(value, step.time(theta));
            }
        } else if !whole {
            // begin or end inside the step: a few points decide whether the peak is here too
            for i in 1..8 {
                let theta = low + (high - low) * f64::from(i) / 8.0;
                let value = contact_at(step, bearing, theta).normal_force;
                peak.raise(value, step.time(theta));
            }
        }
        contact.peak_force = peak.value;
        contact.peak_time = peak.time;
    }
}
