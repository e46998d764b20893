//! Why a machine with one bearing cannot be built.

use crate::bearing::BearingConstants;
use std::fmt;

/// Why a machine cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The steady moment is shared by the balls, and something drags on them from the ground as well.
    DragToGround,
    /// An acceleration loss that is negative somewhere would create energy.
    LossCreatesEnergy,
    /// An acceleration loss per acceleration so large that braking would have no answer.
    LossExceedsInertia,
    /// A radial load below zero.
    NegativeLoad,
    /// A step of speed on balls that always roll: they would need an infinite torque.
    StepOfRollingBalls,
    /// A share of the steady moment outside 0 to 1, or a scale or reference spin that is not positive.
    MomentShare,
    /// A state of the lubricant that starts outside 0 to 1, or a parameter of it that has no meaning.
    LubricantState,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Refusal::DragToGround => {
                "with the steady moment shared by the balls nothing may drag on balls or cage from the ground"
            }
            Refusal::LossCreatesEnergy => {
                "the acceleration loss is negative somewhere: it would create energy"
            }
            Refusal::LossExceedsInertia => {
                "the acceleration loss per acceleration exceeds the inertia: a braked race would have no answer"
            }
            Refusal::NegativeLoad => "the radial load is negative somewhere: turn its direction",
            Refusal::StepOfRollingBalls => {
                "balls that always roll cannot follow a step of speed: give a ramp, or compute them ball by ball"
            }
            Refusal::MomentShare => {
                "the orbit's share of the steady moment lies outside 0 to 1, or its scale or reference spin is not positive"
            }
            Refusal::LubricantState => {
                "the state of the lubricant starts outside 0 to 1, or one of its parameters is not positive"
            }
        })
    }
}

impl std::error::Error for Refusal {}

/// Refuses a bearing that has no meaning; `free_inertia` is that of an inner race whose speed is not given, kg m².
pub fn of_bearing(bearing: &BearingConstants, free_inertia: Option<f64>) -> Result<(), Refusal> {
    if (bearing.lubricant()).is_some_and(|lubricant| !lubricant.is_valid()) {
        return Err(Refusal::LubricantState);
    }
    match bearing {
        BearingConstants::Rolling(bearing) => {
            if !bearing.loss.is_passive() {
                return Err(Refusal::LossCreatesEnergy);
            }
            let loss = bearing.set.pocket_friction_arm() * bearing.loss.largest_per_acceleration();
            if free_inertia.is_some_and(|inertia| loss >= inertia + bearing.set.inner_inertia()) {
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
    }
    Ok(())
}
