//! Why a rig cannot be built.

use super::Drive;
use crate::bearing::BearingConstants;
use std::fmt;

/// Why a rig cannot be built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    /// The steady moment is shared by the balls, and something drags on them from the ground as well.
    DragToGround,
    /// An acceleration loss that is negative somewhere would create energy.
    LossCreatesEnergy,
    /// An acceleration loss per acceleration so large that braking would have no answer.
    LossExceedsInertia,
    /// A bearing in space.
    InSpace,
    /// A radial load below zero.
    NegativeLoad,
    /// A step of speed on balls that always roll: they would need an infinite torque.
    StepOfRollingBalls,
    /// A share of the steady moment outside 0 to 1, or a scale or reference spin that is not positive.
    MomentShare,
    /// A state of the lubricant that starts outside 0 to 1, or a parameter of it that has no meaning.
    LubricantState,
    /// A constant, by its name, that is not finite, or not positive where it must be.
    NotPositive(&'static str),
    /// A constant, by its name, that is not finite, or negative.
    Negative(&'static str),
    /// A direction that is no unit vector.
    Direction,
    /// A load that changes while a clutch acts.
    LoadChanges,
    /// An action, by its index, that lies before the start, or before the one before it, or at no time.
    Order(usize),
    /// An action, by its index, with a number that has no meaning.
    Action(usize),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::DragToGround => f.write_str(
                "with the steady moment shared by the balls nothing may drag on balls or cage from the ground",
            ),
            Refusal::InSpace => f.write_str("a rig has a bearing of the plane"),
            Refusal::LossCreatesEnergy => f.write_str(
                "the acceleration loss is negative somewhere: it would create energy",
            ),
            Refusal::LossExceedsInertia => f.write_str(
                "the acceleration loss per acceleration exceeds the inertia: a braked race would have no answer",
            ),
            Refusal::NegativeLoad => f.write_str("the radial load is negative somewhere: turn its direction"),
            Refusal::StepOfRollingBalls => f.write_str(
                "balls that always roll cannot follow a step of speed: give a ramp, or compute them ball by ball",
            ),
            Refusal::MomentShare => f.write_str(
                "the orbit's share of the steady moment lies outside 0 to 1, or its scale or reference spin is not positive",
            ),
            Refusal::LubricantState => f.write_str(
                "the state of the lubricant starts outside 0 to 1, or one of its parameters is not positive",
            ),
            Refusal::NotPositive(what) => write!(f, "the {what} must be a positive number"),
            Refusal::Negative(what) => write!(f, "the {what} must be a number and not negative"),
            Refusal::Direction => write!(f, "the direction of the load must be a unit vector"),
            Refusal::LoadChanges => write!(f, "the load of a rig with a clutch is constant"),
            Refusal::Order(index) => write!(
                f,
                "action {} of the program comes before the one above it, or before the start",
                index + 1
            ),
            Refusal::Action(index) => write!(
                f,
                "action {} of the program holds a number without meaning: rates and capacities are not negative, speeds finite",
                index + 1
            ),
        }
    }
}

impl std::error::Error for Refusal {}

/// Refuses a bearing that has no meaning under a drive, on an inner race with this inertia, kg m².
pub fn of_bearing(
    bearing: &BearingConstants,
    drive: &Drive,
    race_inertia: f64,
) -> Result<(), Refusal> {
    if (bearing.lubricant()).is_some_and(|lubricant| !lubricant.is_valid()) {
        return Err(Refusal::LubricantState);
    }
    match bearing {
        BearingConstants::Rolling(bearing) => {
            if !bearing.loss.is_passive() {
                return Err(Refusal::LossCreatesEnergy);
            }
            let loss = bearing.set.pocket_friction_arm() * bearing.loss.largest_per_acceleration();
            let is_free = !matches!(drive, Drive::Speed(_));
            if is_free && loss >= race_inertia + bearing.set.inner_inertia() {
                return Err(Refusal::LossExceedsInertia);
            }
        }
        BearingConstants::Planar(bearing) => {
            if let Some(moment) = &bearing.moment {
                if bearing.drags_to_ground() {
                    return Err(Refusal::DragToGround);
                }
                if !moment.is_valid() {
                    return Err(Refusal::MomentShare);
                }
            }
        }
        BearingConstants::Spatial(_) => return Err(Refusal::InSpace),
    }
    Ok(())
}
