//! The kinds of cases: what each takes and what it computes.
//!
//! | kind | inputs | quantities |
//! |---|---|---|
//! | `hertz_point_contact` | `load`, `ball_diameter`, `race` ("inner", "outer"), `groove_curvature` or `groove_radius`, `pitch_diameter` (and `contact_angle`) or `race_radius`, `young_modulus`, `poisson_ratio` (of both bodies; `ball_…` for a ball of its own) | `stiffness`, `ellipticity`, `semi_major_axis`, `semi_minor_axis`, `approach`, `max_pressure`, `max_shear`, `max_shear_depth` |
//! | `bearing_kinematics` | `ball_count`, `ball_diameter`, `pitch_diameter`, `contact_angle` (0) | per turn: `ball_pass_outer`, `ball_pass_inner`, `ball_spin`, `cage` |
//! | `rolling_moments` | `inner_track_radius`, `ball_radius`, `ball_count`, `ball_mass`, `cage_mass`, `race_acceleration`, `pocket_friction` (0), `steady_moment` (0) | `inner_traction`, `outer_traction`, `inner_moment`, `outer_moment`, `cage_load` |
//! | `palmgren_moment` | `form` ("printed", "continuous"), `viscous_factor`, `viscosity`, `speed`, `pitch_diameter`, and for the load part `load`, `static_load_rating`, `load_factor`, `load_exponent` | `viscous_moment`; with a load also `load_friction_factor`, `load_moment` |
//! | `skf_friction`, `palmgren_factors`, `oil_viscosity` | see `crates/validate/src/friction_kinds.rs` | |
//! | `film_thickness` | see `crates/validate/src/film_kinds.rs` | |
//! | `free_fall` | `clearance`, `gravity` | `time_to_first_contact` (simulated), `closed_form_time` |
//! | `scenario` | see `crates/validate/src/scenario_kind.rs` | |
//! | `elastic_bounce` | `mass`, `stiffness`, `clearance`, `gravity` | `peak_contact_force` (simulated), `closed_form_force` |

use super::inputs::{Computed, Inputs, ball_on_race, law, length, positive, ratio};
use super::simulator::{ElasticBounce, FreeFall, Simulator};
use super::{film_kinds, friction_kinds, scenario_kind};
use crate::compare::told;
use physics::hertz::{PointContact, maximum_pressure};
use physics::kinematics::BallSet;
use physics::palmgren::{
    load_friction_factor, load_moment, printed_viscous_moment, viscous_moment,
};
use physics::rolling::RollingSet;
use units::Dimension;

/// Names of all kinds.
pub const NAMES: [&str; 11] = [
    "hertz_point_contact",
    "bearing_kinematics",
    "rolling_moments",
    "palmgren_moment",
    "skf_friction",
    "palmgren_factors",
    "oil_viscosity",
    "film_thickness",
    "free_fall",
    "elastic_bounce",
    "scenario",
];

/// Computes a case; `None` for an unknown kind.
pub fn compute(
    kind: &str,
    inputs: &mut Inputs,
    simulator: &dyn Simulator,
) -> Result<Option<Vec<Computed>>, String> {
    match kind {
        "hertz_point_contact" => hertz_point_contact(inputs),
        "bearing_kinematics" => bearing_kinematics(inputs),
        "rolling_moments" => rolling_moments(inputs),
        "palmgren_moment" => palmgren_moment(inputs),
        "skf_friction" => friction_kinds::skf_friction(inputs),
        "palmgren_factors" => friction_kinds::factors(inputs),
        "oil_viscosity" => friction_kinds::oil_viscosity(inputs),
        "film_thickness" => film_kinds::film_thickness(inputs),
        "free_fall" => free_fall(inputs, simulator),
        "elastic_bounce" => elastic_bounce(inputs, simulator),
        "scenario" => scenario_kind::scenario(inputs, simulator),
        _ => return Ok(None),
    }
    .map(Some)
}

fn hertz_point_contact(inputs: &mut Inputs) -> Result<Vec<Computed>, String> {
    let given = ball_on_race(inputs)?;
    let load = given.load;
    let contact = PointContact::new(given.curvature, given.modulus).map_err(told)?;
    let shear = contact.maximum_shear(load, given.poisson_ratio);
    let stiffness_dimension = units::parse_quantity("1 N/m^1.5").map_err(told)?.dimension;
    let length = |quantity, value| law(quantity, Dimension::LENGTH, value);
    let pressure = |quantity, value| law(quantity, Dimension::PRESSURE, value);
    let maximum = maximum_pressure(contact.pressure_factor, load);
    Ok(vec![
        law("stiffness", stiffness_dimension, contact.stiffness),
        ratio("ellipticity", contact.ellipticity),
        length("semi_major_axis", contact.semi_major(load)),
        length("semi_minor_axis", contact.semi_minor(load)),
        length("approach", contact.approach(load)),
        pressure("max_pressure", maximum),
        pressure("max_shear", shear.shear),
        length("max_shear_depth", shear.depth),
    ])
}

fn bearing_kinematics(inputs: &mut Inputs) -> Result<Vec<Computed>, String> {
    let orders = BallSet {
        ball_count: inputs.count("ball_count")?,
        ball_diameter: length(inputs, "ball_diameter")?,
        pitch_diameter: length(inputs, "pitch_diameter")?,
        contact_angle: inputs
            .maybe_quantity("contact_angle", Dimension::ANGLE)?
            .unwrap_or(0.0),
    }
    .passing_orders();
    Ok(vec![
        ratio("ball_pass_outer", orders.outer_race),
        ratio("ball_pass_inner", orders.inner_race),
        ratio("ball_spin", orders.ball_spin),
        ratio("cage", orders.cage),
    ])
}

fn rolling_moments(inputs: &mut Inputs) -> Result<Vec<Computed>, String> {
    let inner_track_radius = length(inputs, "inner_track_radius")?;
    let set = RollingSet {
        inner_track_radius,
        ball_ratio: length(inputs, "ball_radius")? / inner_track_radius,
        balls_mass: inputs.count("ball_count")? as f64
            * inputs.quantity("ball_mass", Dimension::MASS)?,
        cage_mass: inputs.quantity("cage_mass", Dimension::MASS)?,
    };
    let angular_acceleration = units::parse_quantity("1 rad/s^2").map_err(told)?.dimension;
    let motion = set.rolling(inputs.quantity("race_acceleration", angular_acceleration)?);
    let friction = inputs
        .maybe_quantity("pocket_friction", Dimension::FORCE)?
        .unwrap_or(0.0);
    let steady = inputs
        .maybe_quantity("steady_moment", Dimension::TORQUE)?
        .unwrap_or(0.0);
    let (inner, outer) = (
        set.inner_traction(motion, friction),
        set.outer_traction(motion, friction),
    );
    let force = |quantity, value| law(quantity, Dimension::FORCE, value);
    let torque = |quantity, value| law(quantity, Dimension::TORQUE, value);
    Ok(vec![
        force("inner_traction", inner),
        force("outer_traction", outer),
        torque("inner_moment", set.inner_moment(steady, inner)),
        torque("outer_moment", set.outer_moment(steady, outer)),
        force("cage_load", set.cage_load(motion.cage, friction)),
    ])
}

fn palmgren_moment(inputs: &mut Inputs) -> Result<Vec<Computed>, String> {
    let form = inputs.word("form", &["printed", "continuous"])?;
    let pitch_diameter = length(inputs, "pitch_diameter")?;
    let viscous_factor = inputs.number("viscous_factor")?;
    let viscosity = inputs.quantity("viscosity", Dimension::KINEMATIC_VISCOSITY)?;
    let speed = inputs.quantity("speed", Dimension::ANGULAR_SPEED)?;
    let viscous = if form == "printed" {
        printed_viscous_moment(viscous_factor, viscosity, speed, pitch_diameter)
    } else {
        viscous_moment(viscous_factor, viscosity, speed, pitch_diameter)
    };
    let mut computed = vec![law("viscous_moment", Dimension::TORQUE, viscous)];
    if let Some(load) = inputs.maybe_quantity("load", Dimension::FORCE)? {
        let factor = load_friction_factor(
            inputs.number("load_factor")?,
            inputs.number("load_exponent")?,
            load,
            inputs.quantity("static_load_rating", Dimension::FORCE)?,
        );
        computed.push(ratio("load_friction_factor", factor));
        let moment = load_moment(factor, load, pitch_diameter);
        computed.push(law("load_moment", Dimension::TORQUE, moment));
    }
    Ok(computed)
}

fn free_fall(inputs: &mut Inputs, simulator: &dyn Simulator) -> Result<Vec<Computed>, String> {
    let case = FreeFall {
        clearance: length(inputs, "clearance")?,
        gravity: positive(
            "gravity",
            inputs.quantity("gravity", Dimension::ACCELERATION)?,
        )?,
    };
    Ok(vec![
        law(
            "closed_form_time",
            Dimension::TIME,
            (2.0 * case.clearance / case.gravity).sqrt(),
        ),
        Computed {
            quantity: "time_to_first_contact".to_string(),
            dimension: Dimension::TIME,
            value: simulator.free_fall(&case),
        },
    ])
}

fn elastic_bounce(inputs: &mut Inputs, simulator: &dyn Simulator) -> Result<Vec<Computed>, String> {
    let case = ElasticBounce {
        mass: positive("mass", inputs.quantity("mass", Dimension::MASS)?)?,
        stiffness: positive(
            "stiffness",
            inputs.quantity("stiffness", Dimension::STIFFNESS)?,
        )?,
        clearance: length(inputs, "clearance")?,
        gravity: positive(
            "gravity",
            inputs.quantity("gravity", Dimension::ACCELERATION)?,
        )?,
    };
    // At the lowest point ½ k x² = m g (c0 + x) and F = k x: F = m g + √((m g)² + 2 k m g c0).
    let weight = case.mass * case.gravity;
    let force = weight + (weight * weight + 2.0 * case.stiffness * weight * case.clearance).sqrt();
    Ok(vec![
        law("closed_form_force", Dimension::FORCE, force),
        Computed {
            quantity: "peak_contact_force".to_string(),
            dimension: Dimension::FORCE,
            value: simulator.elastic_bounce(&case),
        },
    ])
}
