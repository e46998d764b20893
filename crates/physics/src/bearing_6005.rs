//! The bearing 6005 that tests of several laws take.

use crate::palmgren::Palmgren;
use crate::rolling::RollingSet;
use crate::skf_constants::{SkfBearing, SkfLubricant, SkfOil, SkfSupply, SkfType};

/// With grease of 100 mm²/s; in round numbers.
pub(crate) const PALMGREN: Palmgren<f64> = Palmgren {
    viscous_factor: 1.7,
    viscosity: 100e-6,
    pitch_diameter: 36e-3,
    load_factor: 0.0007,
    load_exponent: 0.5,
    static_load_rating: 6550.0,
    preload: 0.0,
};

pub(crate) const SKF: SkfBearing<'static> = SkfBearing {
    kind: SkfType::DeepGroove,
    series: "60",
    bore: 25e-3,
    outer_diameter: 47e-3,
    width: 12e-3,
    static_load_rating: Some(6550.0),
    ceramic_balls: false,
};

pub(crate) const SKF_GREASE: SkfLubricant = SkfLubricant {
    viscosity: 100e-6,
    supply: SkfSupply::GreaseOrOilAir,
    oil: SkfOil::Mineral,
    drag_variable: 0.0,
    seal_moment: 0.0,
};

/// Balls and cage as in the reference file `rolling.json`.
pub(crate) fn rolling_set() -> RollingSet<f64> {
    RollingSet {
        inner_track_radius: 14.825e-3,
        ball_ratio: 3.175 / 14.825,
        balls_mass: 10.0 * 0.0010524208776796881,
        cage_mass: 5e-3,
    }
}
