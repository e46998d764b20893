//! Constants of a rig.

use super::drive::Drive;
use super::housing::Housing;
use super::mode::{ClutchMode, Mode};
use super::refusal::{self, Refusal};
use crate::bearing::BearingConstants;
use crate::table::Table;
use number::{Vec2, constants};

/// Constants of one rig.
#[derive(Clone, Debug, PartialEq)]
pub struct RigConstants {
    /// The inner race with what is rigidly on it.
    pub race: InnerRace<f64>,
    /// The test bearing.
    pub bearing: BearingConstants,
    /// What turns the inner race.
    pub drive: Drive,
    /// Radial load W over time, N over s; not negative: on the inner race, or by the housing on the outer one.
    pub load: Table,
    /// What carries the outer race and feels its moment; without it that race stands at the origin.
    pub housing: Option<Housing>,
    /// Speed that counts as reached, rad/s: scales of errors and of the record. Either sign, not 0.
    pub target_speed: f64,
}

constants! {
    /// The inner race with its sleeve; of a rig with a clutch with shaft and driven half of that.
    pub struct InnerRace {
        /// Mass, kg.
        mass: R,
        /// Polar inertia I_I, kg m²; without balls and cage.
        inertia: R,
        /// True where its centre is held in the middle, as it is where a housing carries the outer race.
        centre_held: bool,
        /// Direction of the radial load, a unit vector.
        load_direction: Vec2<R>,
        /// Gravity, m/s². The balls have their own.
        gravity: Vec2<R>,
    }
}

impl RigConstants {
    /// Refuses what has no meaning.
    pub fn check(&self) -> Result<(), Refusal> {
        let is_load = |point: &(f64, f64)| point.1.is_finite() && point.1 >= 0.0;
        if !self.load.points().iter().all(is_load) {
            return Err(Refusal::NegativeLoad);
        }
        let given_speed = matches!(self.drive, Drive::Speed(_));
        let free_inertia = (!given_speed).then_some(self.race.inertia);
        refusal::of_bearing(&self.bearing, free_inertia)?;
        let rolls = matches!(self.bearing, BearingConstants::Rolling(_));
        if rolls && given_speed && self.start_speed() != 0.0 {
            return Err(Refusal::StepOfRollingBalls);
        }
        // a hundredth of a percent: a direction written with five digits
        let length = self.race.load_direction.length_squared();
        if !(0.9999..1.0001).contains(&length) {
            return Err(Refusal::Direction);
        }
        if let Drive::Clutch(clutch) = &self.drive {
            if self.load.points().len() > 1 {
                return Err(Refusal::LoadChanges);
            }
            positive("inertia of the shaft", self.race.inertia)?;
            positive("size of the target speed", self.target_speed.abs())?;
            clutch.check()?;
        }
        self.housing.as_ref().map_or(Ok(()), Housing::check)
    }
    /// Speed of the inner race at the start, rad/s.
    pub fn start_speed(&self) -> f64 {
        match &self.drive {
            Drive::Speed(speed) => speed.value(0.0),
            Drive::Clutch(clutch) => clutch.program.start.shaft_speed,
            Drive::SlidingRotor(_) | Drive::Torque(_) => 0.0,
        }
    }
    /// Whether both races stay in the middle: the load does not reach the balls.
    pub fn is_concentric(&self) -> bool {
        (self.housing.as_ref()).map_or(self.race.centre_held, |housing| housing.centre_held)
    }
    /// Load and drive from an instant until the next landing, before a clutch does anything.
    pub(super) fn mode(&self, time: f64) -> Mode<f64> {
        Mode {
            load: self.load.piece(time),
            drive: match &self.drive {
                Drive::Torque(table) | Drive::Speed(table) => table.piece(time),
                Drive::SlidingRotor(_) | Drive::Clutch(_) => Table::constant(0.0).piece(time),
            },
            clutch: ClutchMode::idle(),
        }
    }
    /// Instants at which the load or the drive changes its line, s.
    pub(super) fn landings(&self) -> Vec<f64> {
        let of_drive = match &self.drive {
            Drive::Torque(table) | Drive::Speed(table) => table.points(),
            Drive::SlidingRotor(_) | Drive::Clutch(_) => &[],
        };
        let mut instants: Vec<f64> = (self.load.points().iter().chain(of_drive))
            .map(|point| point.0)
            .filter(|instant| *instant > 0.0)
            .collect();
        instants.sort_by(f64::total_cmp);
        instants.dedup();
        instants
    }
}

/// Refuses a constant that is not a positive number.
pub(super) fn positive(name: &'static str, value: f64) -> Result<(), Refusal> {
    match value.is_finite() && value > 0.0 {
        true => Ok(()),
        false => Err(Refusal::NotPositive(name)),
    }
}

/// Refuses a constant that is negative, or no number.
pub(super) fn not_negative(name: &'static str, value: f64) -> Result<(), Refusal> {
    match value.is_finite() && value >= 0.0 {
        true => Ok(()),
        false => Err(Refusal::Negative(name)),
    }
}
