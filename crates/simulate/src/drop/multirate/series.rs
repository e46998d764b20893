//! What the intervals of a coast-down have seen.

use crate::coast_down::build::CoastDownModel;
use crate::coast_down::rows::End;
use crate::drop::multirate::batch::{Interval, Observation};
use crate::drop::multirate::leap::{HARDER, at_rest, beside, pressed, rolls};
use crate::drop::multirate::macro_step::{Rubbed, Step};

/// A place on the coast-down.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Place {
    /// s.
    pub time: f64,
    /// rad/s.
    pub speed: f64,
}

impl Place {
    pub fn of(built: &CoastDownModel) -> Self {
        Place {
            time: built.start.time,
            speed: built.start.speed,
        }
    }
}

/// A largest value, and where.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Largest {
    pub value: f64,
    pub at: Place,
}

impl Largest {
    fn raise(&mut self, value: f64, at: Place) {
        if value > self.value {
            *self = Largest { value, at };
        }
    }
}

/// What was seen of a bearing.
#[derive(Clone, Debug, Default)]
pub(super) struct SeenBearing {
    /// Contact force in the bore and on the faces, N.
    pub force: Largest,
    pub thrust: Largest,
    /// Rise of the patch above the start, K.
    pub rise: Largest,
    /// Displacements of the rotor and of the mount, m.
    pub rotor_displacement: f64,
    pub mount_displacement: f64,
    /// What rotor and race have rubbed between the intervals.
    pub rubbed: Rubbed,
}

/// A stretch in which the rotor does not roll.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    pub from: Place,
    pub to: Place,
    /// Number of intervals.
    pub intervals: usize,
    /// Energy lost in it, J, and what rotor and races of each bearing have rubbed.
    pub energy: f64,
    pub rubbed: Vec<Rubbed>,
    /// Largest contact force, N, the largest over the load at rest, and how far the losses are from those of rolling, over them.
    pub force: f64,
    pub pressed: f64,
    pub beside: f64,
    /// Least speed of an inner race over that at which it rolls, and where.
    pub slowest: (f64, Place),
    /// Whether it begins with the coast-down.
    pub first: bool,
}

impl Stretch {
    /// Whether unbalance lifts the rotor; it slides else.
    pub fn lifts(&self) -> bool {
        self.pressed > HARDER
    }
    /// In words.
    pub fn words(&self, built: &CoastDownModel) -> String {
        let why = match self.lifts() {
            true => format!(
                "contact force up to {:.0} N, {:.0} N at rest",
                self.force,
                at_rest(built).fold(0.0, f64::max)
            ),
            false if built.by_laws() => format!(
                "bearings take {:.1} % of what laws of rolling give",
                100.0 * (1.0 + self.beside)
            ),
            false => format!(
                "friction of rotor and races makes up to {:.1} % of the losses",
                100.0 * self.beside
            ),
        };
        let (from, to) = (self.from, self.to);
        format!(
            "From {:.4} s and {:.1} rad/s to {:.4} s and {:.1} rad/s it did not roll: {why} ({} intervals).",
            from.time, from.speed, to.time, to.speed, self.intervals
        )
    }
}

/// The intervals of a coast-down.
#[derive(Clone, Debug, Default)]
pub(crate) struct IntervalSeries {
    /// Their number, and the largest relative error of a mean power by which a leap was taken.
    pub(super) intervals: usize,
    pub(super) error: f64,
    /// The largest error of a quasi-steady step between two intervals, as the page of the method has it.
    pub(super) step_error: Option<f64>,
    /// Steps of all of them.
    pub steps: u64,
    /// Where the rotor rolled first.
    pub(super) rolled: Option<Place>,
    /// How long after the drop the first interval from which a leap was taken ended, s.
    pub(super) settled: Option<f64>,
    pub(super) stretches: Vec<Stretch>,
    rolls: bool,
    pub(super) bearings: Vec<SeenBearing>,
    /// From where on the moment of bearings that no law knows was held.
    pub(super) held: Option<Place>,
    /// First and last instant at which the rotor whirled backward, and forward, s.
    pub(super) whirled: [Option<[f64; 2]>; 2],
}

impl IntervalSeries {
    /// An interval at the present speed.
    pub(super) fn saw(
        &mut self,
        built: &CoastDownModel,
        now: &Observation,
        interval: &Interval,
        settling: usize,
    ) {
        let at = Place::of(built);
        self.intervals += 1;
        let rolls = rolls(built, now);
        if rolls {
            self.rolled.get_or_insert(at);
        }
        if let Some(open) = self.open() {
            open.to = at;
        }
        if !rolls && (self.rolls || self.stretches.is_empty()) {
            self.stretches.push(Stretch {
                from: at,
                to: at,
                intervals: 0,
                energy: 0.0,
                rubbed: vec![Rubbed::default(); built.parts.len()],
                force: 0.0,
                pressed: 0.0,
                beside: beside(built, now),
                slowest: (f64::INFINITY, at),
                first: self.rolled.is_none(),
            });
        }
        self.rolls = rolls;
        let bearings = &now.mean.bearings;
        if let Some(open) = self.open() {
            open.intervals += 1;
            let beside = beside(built, now);
            if beside.abs() > open.beside.abs() {
                open.beside = beside;
            }
            open.pressed = open.pressed.max(pressed(built, now));
            for own in bearings {
                open.force = open.force.max(own.peak_force).max(own.peak_thrust);
                if own.spin < open.slowest.0 {
                    open.slowest = (own.spin, at);
                }
            }
        }
        let turns = now.mean.speed * now.mean.span / std::f64::consts::TAU;
        let backward = bearings.iter().any(|own| own.whirl <= -1.0);
        let forward = bearings.iter().any(|own| own.whirl >= 0.5 * turns);
        for (whirled, found) in self.whirled.iter_mut().zip([backward, forward]) {
            if found {
                let since = whirled.map_or(at.time, |[since, _]| since);
                *whirled = Some([since, at.time]);
            }
        }
        self.largest(built, interval, settling);
    }

    /// The way to an interval.
    pub(super) fn swept(&mut self, built: &CoastDownModel, interval: &Interval) {
        self.largest(built, interval, 0);
    }

    /// The largest of all batches but the first, which settle.
    fn largest(&mut self, built: &CoastDownModel, interval: &Interval, settling: usize) {
        let at = Place::of(built);
        self.bearings
            .resize_with(built.parts.len(), Default::default);
        for (k, seen) in self.bearings.iter_mut().enumerate() {
            for batch in interval.batches.iter().skip(settling) {
                seen.force.raise(batch.bearings[k].peak_force, at);
                seen.thrust.raise(batch.bearings[k].peak_thrust, at);
                seen.rise.raise(batch.bearings[k].peak_rise, at);
            }
            let [rotor, mount] = interval.displacements[k];
            seen.rotor_displacement = seen.rotor_displacement.max(rotor);
            seen.mount_displacement = seen.mount_displacement.max(mount);
        }
    }

    /// A leap was taken by a mean power of this relative error, so long after the drop, s.
    pub(super) fn leaps(&mut self, error: f64, after: f64) {
        self.error = self.error.max(error);
        self.settled.get_or_insert(after);
    }

    /// A step of the coast-down; why it ends in it.
    pub(super) fn took(&mut self, step: Step) -> Option<End> {
        self.bearings
            .resize_with(step.rubbed.len(), Default::default);
        for (seen, own) in self.bearings.iter_mut().zip(&step.rubbed) {
            seen.rubbed.add(own);
        }
        if let Some(open) = self.open() {
            open.energy += step.energy;
            for (sum, own) in open.rubbed.iter_mut().zip(&step.rubbed) {
                sum.add(own);
            }
        }
        step.end
    }

    /// Where it ends.
    pub(super) fn ends(&mut self, built: &CoastDownModel) {
        let at = Place::of(built);
        if let Some(open) = self.open() {
            open.to = at;
        }
    }

    /// The stretch in which the rotor does not roll now.
    fn open(&mut self) -> Option<&mut Stretch> {
        match self.rolls {
            true => None,
            false => self.stretches.last_mut(),
        }
    }
}
