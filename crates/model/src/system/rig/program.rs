//! What is done to the rig, and when.
//!
//! | program | start | what is done |
//! |---|---|---|
//! | [`Program::coast_down`] | turning | nothing: motor off, clutch open, or locked to the flywheel |
//! | [`Program::spin_up`] | flywheel at speed, shaft at rest | the clutch engages; the motor holds its speed or is off |
//! | [`Program::ramp_and_hold`] | at rest, locked | the motor ramps to a speed and holds it |
//!
//! Any other program is a list of actions.

use super::refusal::Refusal;

/// A start and a list of actions in the order of their times.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// How the run starts: motor off, clutch open.
    pub start: Start,
    /// Actions at their times, s; of several at one time the last of a kind counts.
    pub actions: Vec<(f64, Action)>,
}

/// Speeds at the start; balls and cage roll with the shaft.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Start {
    /// Of the shaft, rad/s.
    pub shaft_speed: f64,
    /// Of the flywheel, rad/s.
    pub flywheel_speed: f64,
}

impl Start {
    /// Everything at rest.
    pub const REST: Start = Start {
        shaft_speed: 0.0,
        flywheel_speed: 0.0,
    };
}

/// Something that is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// The motor is set to a speed, from the speed the flywheel has.
    MotorTo {
        /// Speed to reach, rad/s.
        speed: f64,
        /// Size of the rate at which the set speed goes there, rad/s²; infinite for at once.
        rate: f64,
    },
    /// The motor is off.
    MotorOff,
    /// The clutch is pressed.
    Engage(Engagement),
    /// The clutch opens.
    Disengage,
}

/// How the clutch is pressed: its capacity goes from what it is, zero where it is open, to its largest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Engagement {
    /// Size of the rate at which it does, N m/s; infinite for at once.
    pub rate: f64,
    /// Largest capacity, N m.
    pub largest: f64,
}

impl Engagement {
    /// The whole capacity at once, N m.
    pub fn at_once(largest: f64) -> Self {
        Engagement {
            rate: f64::INFINITY,
            largest,
        }
    }
}

impl Program {
    /// From a speed of the shaft (rad/s) down, the motor off: alone, or locked to the flywheel by a clutch of a largest
    /// capacity (N m).
    pub fn coast_down(speed: f64, locked: Option<f64>) -> Self {
        Program {
            start: Start {
                shaft_speed: speed,
                flywheel_speed: if locked.is_some() { speed } else { 0.0 },
            },
            actions: locked
                .map(|largest| (0.0, Action::Engage(Engagement::at_once(largest))))
                .into_iter()
                .collect(),
        }
    }
    /// The flywheel at a speed (rad/s), the shaft at rest; the clutch engages at a time (s). The motor holds the flywheel's
    /// speed, or is off.
    pub fn spin_up(speed: f64, engage_at: f64, engagement: Engagement, motor_holds: bool) -> Self {
        let hold = (
            0.0,
            Action::MotorTo {
                speed,
                rate: f64::INFINITY,
            },
        );
        Program {
            start: Start {
                shaft_speed: 0.0,
                flywheel_speed: speed,
            },
            actions: motor_holds
                .then_some(hold)
                .into_iter()
                .chain([(engage_at, Action::Engage(engagement))])
                .collect(),
        }
    }
    /// From rest, the clutch locked by its largest capacity (N m): the motor ramps to a speed (rad/s) at a rate (rad/s²) and
    /// holds it.
    pub fn ramp_and_hold(speed: f64, rate: f64, largest: f64) -> Self {
        Program {
            start: Start::REST,
            actions: vec![
                (0.0, Action::Engage(Engagement::at_once(largest))),
                (0.0, Action::MotorTo { speed, rate }),
            ],
        }
    }

    /// Refuses what has no meaning.
    pub fn check(&self) -> Result<(), Refusal> {
        if !(self.start.shaft_speed.is_finite() && self.start.flywheel_speed.is_finite()) {
            return Err(Refusal::Negative("size of a speed at the start"));
        }
        let mut last = 0.0;
        for (index, (time, action)) in self.actions.iter().enumerate() {
            if !(time.is_finite() && *time >= last) {
                return Err(Refusal::Order(index));
            }
            last = *time;
            let sound = match action {
                Action::MotorTo { speed, rate } => speed.is_finite() && *rate > 0.0,
                Action::Engage(by) => by.rate > 0.0 && by.largest > 0.0 && by.largest.is_finite(),
                Action::MotorOff | Action::Disengage => true,
            };
            if !sound {
                return Err(Refusal::Action(index));
            }
        }
        Ok(())
    }
}
