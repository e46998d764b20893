//! Constants of a spin-up.

use crate::bearing::BearingConstants;
use crate::system::refusal::{self, Refusal};
use crate::table::{Piece, Table};
use number::{Vec2, constants};

/// Constants of one machine.
#[derive(Clone, Debug, PartialEq)]
pub struct SpinUpConstants {
    /// The inner race.
    pub race: InnerRace<f64>,
    /// The bearing.
    pub bearing: BearingConstants,
    /// What turns the inner race.
    pub drive: Drive,
    /// Radial load W on the inner race over time, N over s; not negative.
    pub load: Table,
    /// Speed that counts as reached, rad/s: scales of errors and of the record. Either sign, not 0.
    pub target_speed: f64,
}

constants! {
    /// The inner race with its sleeve.
    pub struct InnerRace {
        /// Mass, kg.
        mass: R,
        /// Polar inertia I_I, kg m².
        inertia: R,
        /// True where its centre is held in the middle: the concentric rig.
        centre_held: bool,
        /// Direction of the radial load, a unit vector.
        load_direction: Vec2<R>,
        /// Gravity, m/s². The balls have their own.
        gravity: Vec2<R>,
    }
}

/// What turns the inner race.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// A rotor that the radial load presses on the bore.
    SlidingRotor(SlidingRotor<f64>),
    /// A torque on the inner race over time, N m over s.
    Torque(Table),
    /// A speed of the inner race over time, rad/s over s; the first row is the speed at the start.
    /// See [`Drive::ramp`] and [`Drive::step`].
    Speed(Table),
}

constants! {
    /// A rotor that slides in the bore of the inner race.
    pub struct SlidingRotor {
        /// Radius of the bore R_0, m.
        bore_radius: R,
        /// Friction coefficient μ.
        friction: R,
        /// 1/u0, s/m: inverse of the slip at which friction reaches 76 %.
        inverse_reference_speed: R,
        /// Spin at the start, rad/s.
        speed: R,
        /// Polar moment of inertia, kg m²; without effect where the spin is held.
        polar_inertia: R,
        /// True where a drive holds the spin whatever it takes.
        spin_held: bool,
    }
}

impl Drive {
    /// A constant acceleration (its size, rad/s²) from rest to a speed of either sign (rad/s), which then stays.
    pub fn ramp(acceleration: f64, speed: f64) -> Self {
        let end = (speed / acceleration).abs();
        match Table::through(vec![(0.0, 0.0), (end, speed)]) {
            Ok(table) => Drive::Speed(table),
            // no acceleration to speak of, or one beyond measure
            Err(_) => Drive::step(speed),
        }
    }
    /// A speed from the first instant, rad/s, while the balls are at rest.
    pub fn step(speed: f64) -> Self {
        Drive::Speed(Table::constant(speed))
    }
}

/// Load and drive between two landings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode<R> {
    /// Radial load, N.
    pub load: Piece<R>,
    /// Torque, N m, or speed, rad/s; zero with a sliding rotor.
    pub drive: Piece<R>,
}

impl SpinUpConstants {
    /// Refuses what has no meaning.
    pub fn check(&self) -> Result<(), Refusal> {
        if self.load.smallest() < 0.0 {
            return Err(Refusal::NegativeLoad);
        }
        let given_speed = matches!(self.drive, Drive::Speed(_));
        let free_inertia = (!given_speed).then_some(self.race.inertia);
        refusal::of_bearing(&self.bearing, free_inertia)?;
        let rolls = matches!(self.bearing, BearingConstants::Rolling(_));
        if rolls && given_speed && self.start_speed() != 0.0 {
            return Err(Refusal::StepOfRollingBalls);
        }
        Ok(())
    }
    /// Speed of the inner race at the start, rad/s.
    pub fn start_speed(&self) -> f64 {
        match &self.drive {
            Drive::Speed(speed) => speed.value(0.0),
            _ => 0.0,
        }
    }
    /// Load and drive from an instant until the next landing.
    pub(super) fn mode(&self, time: f64) -> Mode<f64> {
        Mode {
            load: self.load.piece(time),
            drive: match &self.drive {
                Drive::SlidingRotor(_) => Table::constant(0.0).piece(time),
                Drive::Torque(table) | Drive::Speed(table) => table.piece(time),
            },
        }
    }
    pub(super) fn landings(&self) -> Vec<f64> {
        let of_drive = match &self.drive {
            Drive::SlidingRotor(_) => &[][..],
            Drive::Torque(table) | Drive::Speed(table) => table.points(),
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
