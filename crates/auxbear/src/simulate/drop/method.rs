//! Which steps a drop takes: explicit or linearly implicit.
//!
//! ```text
//!   friction rate    λ = 5 μ'(0) Q/m_b          a ball between two loaded races: its slip decays like e^(-λt)
//!   radial mode      ω = √(K_r/m_b)             K_r = 1.5 (K_i^(2/3) + K_o^(2/3)) Q^(1/3): what any step must follow
//! ```
//! Explicit steps are bound by λ, where it is large against ω; linearly implicit ones are not, and cost several times more.
//! Q is the largest ball load of a first impact, 5 F/N (Stribeck) of the radial force F = v √(k m): the rotor has fallen through its
//! clearance and is stopped by the mount. Where the slope depends on rolling, it is that of balls that do not roll yet:
//! the largest.

use crate::scenario::{Accuracy, Drop, Method};
use crate::simulate::drop::build::Built;
use crate::simulate::ending::DESIGN;
use model::auxiliary_bearing::AuxiliaryBearingConstants;
use model::bearing::{BearingConstants, PlanarConstants};
use model::system::machine::simulate::Steps;
use model::system::machine::tangents::Known;

/// λ/ω above which linearly implicit steps are the quicker ones at design accuracy; measured on the reference drop with
/// reference speeds of traction from 0.1 to 0.001 m/s.
const STIFF: f64 = 60.0;

/// Tolerance of linearly implicit steps at screening accuracy.
const SCREENING: f64 = 3e-2;
/// Tolerance of explicit steps there: stability bounds them, a larger one hardly saves any.
const SCREENING_EXPLICIT: f64 = 1e-3;

/// Tolerances where the rotor bends: impacts reach its quick coordinates, whose energy the ledger counts. Measured on the rotor of the
/// shipped machine: residuals of 7e-7 by explicit and 1.6e-4 by linearly implicit steps.
const DESIGN_BENT: f64 = 3e-5;
const SCREENING_BENT: f64 = 3e-3;

/// Names of the methods, for people.
pub(crate) const EXPLICIT: &str = "Bogacki-Shampine 3(2), explicit";
pub(crate) const IMPLICIT: &str = "ROS34PW2, linearly implicit";

/// How the steps of a drop are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stepping {
    /// Explicit or linearly implicit.
    pub steps: Steps,
    /// Tolerance, where none is given.
    pub tolerance: f64,
}

impl Stepping {
    /// Name of the method, for people.
    pub fn name(self) -> &'static str {
        match self.steps {
            Steps::Explicit => EXPLICIT,
            Steps::Implicit => IMPLICIT,
        }
    }
}

/// The steps of a drop. At design accuracy linearly implicit ones pay where friction is stiff; at screening accuracy wherever they
/// know all that is stiff. Balls that roll have nothing stiff.
pub(crate) fn stepping(drop: &Drop, built: &Built, known: Known) -> Stepping {
    let screening = drop.run.accuracy == Accuracy::Screening;
    let implicit = known < Known::Nothing
        && match drop.run.method {
            Method::Explicit => false,
            Method::Implicit => true,
            // linearly implicit steps that keep the energy of quick coordinates are dearer than explicit ones
            Method::Auto => {
                (screening && known == Known::All && drop.shaft.is_none()) || is_stiff(drop, built)
            }
        };
    let steps = if implicit {
        Steps::Implicit
    } else {
        Steps::Explicit
    };
    let bends = drop.shaft.is_some();
    let tolerance = match (screening, steps) {
        (false, _) if bends => DESIGN_BENT,
        (false, _) => DESIGN,
        (true, Steps::Implicit) if bends => SCREENING_BENT,
        (true, Steps::Implicit) => SCREENING,
        (true, Steps::Explicit) => SCREENING_EXPLICIT,
    };
    Stepping { steps, tolerance }
}

/// Whether sliding friction is too stiff for explicit steps.
fn is_stiff(drop: &Drop, built: &Built) -> bool {
    let parts = built.constants.bearings.iter();
    let stiffnesses = parts.filter_map(|part| match &part.bearing {
        BearingConstants::Planar(bearing) => Some(stiffness(drop, built, part, bearing)),
        BearingConstants::Rolling(_) => None,
    });
    stiffnesses.fold(0.0, f64::max) > STIFF
}

/// λ/ω of an auxiliary bearing in a first impact.
fn stiffness(
    drop: &Drop,
    built: &Built,
    part: &AuxiliaryBearingConstants,
    bearing: &PlanarConstants,
) -> f64 {
    let fall = 2.0 * drop.gravity.acceleration * part.contact.radial_clearance;
    let force = (fall * part.mount.stiffness * built.constants.rotor.mass()).sqrt();
    let load = 5.0 * force / bearing.balls as f64;
    let ball = &bearing.ball;
    let slope = bearing.traction.slope_at_rest(load, 0.0);
    let rate = 5.0 * slope * load / ball.mass;
    let stiffness = |hertz: f64| 1.5 * hertz.powf(2.0 / 3.0) * load.cbrt();
    let mode =
        ((stiffness(ball.inner_stiffness) + stiffness(ball.outer_stiffness)) / ball.mass).sqrt();
    rate / mode
}
