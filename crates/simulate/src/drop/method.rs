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

use crate::drop::build::DropModel;
use crate::drop::shaft::BuiltShaft;
use crate::ending::DESIGN;
use crate::stepping::{StepRequest, Stepping};
use model::auxiliary_bearing::AuxiliaryBearingConstants;
use model::bearing::tangents::Known;
use model::bearing::{BearingConstants, PlanarConstants};

/// Tolerance of linearly implicit steps at design accuracy: their energies close as those of explicit ones at half of it.
const DESIGN_IMPLICIT: f64 = 2e-4;
/// Tolerance of linearly implicit steps at screening accuracy.
const SCREENING: f64 = 3e-2;
/// Tolerance where the rotor bends: impacts reach its quick coordinates, whose energy the ledger counts. Measured on the rotor of the
/// shipped machine: below 1e-6 by explicit steps over a second.
const DESIGN_BENT: f64 = 2e-5;
/// Tolerance of linearly implicit steps at screening accuracy that must follow quick modes: the ledger misses 1.6e-4 there.
const SCREENING_BOUND: f64 = 3e-3;

/// What decides the steps of a drop.
pub(crate) fn asked(built: &DropModel, known: Known) -> StepRequest<'_> {
    let shaft = built.shaft.as_ref();
    let asked = StepRequest {
        run: &built.drop.run,
        known,
        quickest_mode: shaft.map_or(0.0, BuiltShaft::quickest_mode),
        design: match shaft {
            Some(_) => [DESIGN_BENT; 2],
            None => [DESIGN, DESIGN_IMPLICIT],
        },
        screening: SCREENING,
    };
    match asked.is_bound_by_modes() {
        true => StepRequest {
            screening: SCREENING_BOUND,
            ..asked
        },
        false => asked,
    }
}

/// The steps of a drop.
pub(crate) fn stepping(built: &DropModel, known: Known) -> Stepping {
    asked(built, known).stepping(|| stiffest(built))
}

/// The largest λ/ω of its auxiliary bearings.
fn stiffest(built: &DropModel) -> f64 {
    let parts = built.constants.bearings.iter();
    let stiffnesses = parts.filter_map(|part| match &part.bearing {
        BearingConstants::Planar(bearing) => Some(stiffness(built, part, bearing)),
        BearingConstants::Rolling(_) | BearingConstants::Spatial(_) => None,
    });
    stiffnesses.fold(0.0, f64::max)
}

/// λ/ω of an auxiliary bearing in a first impact.
fn stiffness(
    built: &DropModel,
    part: &AuxiliaryBearingConstants,
    bearing: &PlanarConstants,
) -> f64 {
    let fall = 2.0 * built.drop.gravity.acceleration * part.contact.radial_clearance;
    let mass = built.constants.rotor.mass() / part.planes;
    let force = (fall * part.mount.stiffness * mass).sqrt();
    let load = 5.0 * force / bearing.balls as f64;
    let ball = &bearing.ball;
    let slope = bearing.traction.slope_at_rest(load, 0.0);
    let rate = 5.0 * slope * load / ball.mass;
    let stiffness = |hertz: f64| 1.5 * hertz.powf(2.0 / 3.0) * load.cbrt();
    let mode =
        ((stiffness(ball.inner_stiffness) + stiffness(ball.outer_stiffness)) / ball.mass).sqrt();
    rate / mode
}
