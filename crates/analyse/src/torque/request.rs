//! A bearing whose moments can be asked for.

use model::bearing::AccelerationLoss;
use physics::friction::{Friction, MomentParts};
use physics::rolling::RollingSet;
use problem::{Code, Result};
use scenario::{Moment, Torque, problem_at};

/// The moments at one speed, load and acceleration, N m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Moments {
    pub friction: MomentParts<f64>,
    /// J_I Ω̇.
    pub inner_inertia: f64,
    /// -J_O Ω̇.
    pub outer_inertia: f64,
    /// arm F.
    pub loss: f64,
}

impl Moments {
    /// t_I.
    pub fn inner(&self) -> f64 {
        self.friction.sum() + self.inner_inertia + self.loss
    }

    /// t_O.
    pub fn outer(&self) -> f64 {
        self.friction.sum() + self.outer_inertia + self.loss
    }
}

/// A bearing whose moments can be asked for.
pub struct Request<'a> {
    /// What was written.
    pub torque: &'a Torque,
    pub(crate) set: RollingSet<f64>,
    pub(crate) law: Friction<f64>,
    loss: AccelerationLoss,
}

impl Request<'_> {
    /// Builds the laws of a bearing.
    pub fn of(torque: &Torque) -> Result<Request<'_>> {
        let radius = 0.5 * torque.ball_diameter;
        let inner_track_radius = 0.5 * torque.pitch_diameter - radius;
        let ball = (torque.ball_mass)
            .unwrap_or_else(|| torque.ball_material.ball_mass(torque.ball_diameter));
        let law = law_of(torque, &torque.moment).map_err(|why| {
            let allowed = "a law that has constants for this bearing";
            problem_at(Code::NoLawData, "bearing.moment.law", why, allowed)
        })?;
        Ok(Request {
            torque,
            set: RollingSet {
                inner_track_radius,
                ball_ratio: radius / inner_track_radius,
                balls_mass: torque.ball_count as f64 * ball,
                cage_mass: torque.cage_mass,
            },
            law,
            loss: simulate::bearing::loss::law(&torque.acceleration_loss),
        })
    }

    /// The first load.
    pub fn load(&self) -> f64 {
        self.torque.loads.first().copied().unwrap_or(0.0)
    }

    /// The moments under the first load.
    pub(crate) fn moments(&self, speed: f64, acceleration: f64) -> Moments {
        Moments {
            friction: self.friction(&self.law, speed, self.load()),
            inner_inertia: self.set.inner_inertia() * acceleration,
            // less from 0, so that a steady run has no -0
            outer_inertia: 0.0 - self.set.outer_inertia() * acceleration,
            loss: self.set.pocket_friction_arm() * self.loss.force(speed, acceleration),
        }
    }

    /// M0 and M1 of a law.
    pub fn friction(&self, law: &Friction<f64>, speed: f64, load: f64) -> MomentParts<f64> {
        law.parts(speed, load, self.torque.moment.axial_load())
    }

    /// The speeds of the curves, rad/s.
    pub fn speeds(&self) -> Vec<f64> {
        let (from, to) = (self.torque.speed_from, self.torque.speed_to);
        let last = self.torque.speed_count - 1;
        (0..=last)
            .map(|row| from + (to - from) * row as f64 / last as f64)
            .collect()
    }
}

/// A law with its constants for this bearing.
pub(crate) fn law_of(torque: &Torque, moment: &Moment) -> Result<Friction<f64>, String> {
    moment.law(&torque.rated())
}

/// A word of a file as a part of a name.
pub(crate) fn name_of(law: &str) -> String {
    format!("law_{}", law.replace(' ', "_"))
}
