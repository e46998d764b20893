//! Constants of a rig.

use super::fixture::Fixture;
use super::refusal::{self, Refusal};
use super::{Drive, Housing};
use crate::auxiliary_bearing::{AuxiliaryBearingConstants, RaceConstants};
use crate::bearing::BearingConstants;
use crate::bearing_heat::WarmBearing;
use crate::contact::JournalContact;
use crate::levitation::Levitation;
use crate::mount::{Mount, MountParts};
use crate::schedule::Schedule;
use crate::system::machine::{Event, MachineConstants};
use crate::table::Table;
use number::Vec2;

/// Constants of one rig.
#[derive(Clone, Debug, PartialEq)]
pub struct RigConstants {
    /// The inner race with what is rigidly on it, of a rig with a clutch shaft and driven half of that; its centre is held where a housing
    /// carries the outer race.
    pub race: RaceConstants<f64>,
    /// The test bearing.
    pub bearing: BearingConstants,
    /// What turns the inner race.
    pub drive: Drive,
    /// Radial load W over time, N over s; not negative: on the inner race, or by the housing on the outer one.
    pub load: Table,
    /// Direction of that, a unit vector.
    pub load_direction: Vec2<f64>,
    /// Gravity, m/s², on the race and on what moves with the outer race besides (cage, rolling balls). The balls have their own.
    pub gravity: Vec2<f64>,
    /// What carries the outer race and feels its moment; without it that race stands at the origin.
    pub housing: Option<Housing>,
    /// What warms of the bearing, where that is followed.
    pub warm: Option<Box<WarmBearing>>,
    /// Speed that counts as reached, rad/s: scales of errors and of the record. Either sign, not 0.
    pub target_speed: f64,
}

impl RigConstants {
    /// Refuses what has no meaning.
    pub fn check(&self) -> Result<(), Refusal> {
        let is_load = |point: &(f64, f64)| point.1.is_finite() && point.1 >= 0.0;
        if !self.load.points().iter().all(is_load) {
            return Err(Refusal::NegativeLoad);
        }
        refusal::of_bearing(&self.bearing, &self.drive, self.race.inertia)?;
        let given_speed = matches!(self.drive, Drive::Speed(_));
        let rolls = matches!(self.bearing, BearingConstants::Rolling(_));
        if rolls && given_speed && self.drive.race_speed() != 0.0 {
            return Err(Refusal::StepOfRollingBalls);
        }
        // a hundredth of a percent: a direction written with five digits
        let length = self.load_direction.length_squared();
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
    /// The machine: its rotor is what drives the race, or rests.
    pub fn machine(self) -> MachineConstants {
        let RigConstants {
            race,
            bearing,
            drive,
            load,
            load_direction,
            gravity,
            housing,
            warm,
            target_speed: speed,
        } = self;
        let of_drive = match &drive {
            Drive::Torque(table) | Drive::Speed(table) => table.points(),
            Drive::SlidingRotor(_) | Drive::Clutch(_) => &[],
        };
        let mut knots: Vec<f64> = (load.points().iter().chain(of_drive))
            .map(|point| point.0)
            .collect();
        knots.sort_by(f64::total_cmp);
        knots.dedup();
        // without a sliding rotor a bore of 1 m without friction
        let mut bore = JournalContact {
            radial_clearance: 0.0,
            bore_radius: 1.0,
            stiffness: 0.0,
            exponent: 1.0,
            damping: 0.0,
            friction: 0.0,
            inverse_reference_speed: 0.0,
        };
        if let Drive::SlidingRotor(rotor) = &drive {
            bore.bore_radius = rotor.bore_radius;
            bore.friction = rotor.friction;
            bore.inverse_reference_speed = rotor.inverse_reference_speed;
        }
        MachineConstants {
            rotor: drive.rotor(),
            axial: None,
            levitation: Levitation::NONE,
            magnets: None,
            seals: Vec::new(),
            forces: Vec::new(),
            loaded: Vec::new(),
            base: None,
            unbalances: Vec::new(),
            gravity,
            speed,
            unbalance_angle: 0.0,
            schedule: Schedule::of(knots.into_iter().map(|knot| (knot, Event::Knot))),
            at_speeds: Vec::new(),
            bearings: vec![AuxiliaryBearingConstants {
                name: String::new(),
                node: Vec::new(),
                planes: 1.0,
                datum: Vec2::zero(),
                contact: bore,
                inner_race: race,
                bearing,
                outer_race_mass: housing.map_or(0.0, |housing| housing.mass),
                mount: Mount {
                    stiffness: 0.0,
                    damping: 0.0,
                    free_position: Vec2::zero(),
                },
                mount_parts: MountParts::NONE,
                surfaces: None,
                warm,
                fixture: Some(Box::new(Fixture {
                    drive,
                    load,
                    load_direction,
                    housing,
                })),
            }],
        }
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
