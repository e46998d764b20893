//! Named results: how they are collected, and what each tells of its origin.

use super::outcome::{Quantity, Value};
use model::bearing::{BearingConstants, Separation};
use physics::hertz::maximum_pressure;

/// Law, source and valid range of a kind of result.
pub(super) struct Origin {
    pub law: &'static str,
    pub source: &'static str,
    pub valid: &'static str,
}

/// Named results in their order.
pub(super) struct List(pub Vec<Quantity>);

impl List {
    pub fn push(&mut self, name: &str, unit: &'static str, value: Value, origin: &Origin) {
        self.0.push(Quantity {
            name: name.to_string(),
            value,
            unit,
            law: origin.law,
            source: origin.source,
            valid: origin.valid,
            chaotic: false,
            spread: None,
        });
    }
    /// Marks what tiny changes of the start change much.
    pub fn mark_chaotic(&mut self, names: &[&str]) {
        for quantity in &mut self.0 {
            quantity.chaotic |= names.contains(&quantity.name.as_str());
        }
    }
    /// Largest ball load and Hertz pressure: largest loads (N) and pressure factors (Pa/N^(1/3)) at the inner and the
    /// outer race, and the limit of the pressure, Pa.
    pub fn ball_loads(&mut self, loads: [f64; 2], factors: [f64; 2], limit: Option<f64>) {
        let pressure =
            maximum_pressure(factors[0], loads[0]).max(maximum_pressure(factors[1], loads[1]));
        self.number(
            "peak_ball_load",
            "N",
            Ok(loads[0].max(loads[1])),
            &BALL_LOAD,
        );
        self.number("peak_hertz_pressure", "Pa", Ok(pressure), &PRESSURE);
        self.number(
            "hertz_pressure_share_of_limit",
            "1",
            share_of_limit(pressure, limit),
            &PRESSURE,
        );
    }
    /// What the lubricant came to in the bearing's own states; nothing where it has no state.
    pub fn lubricant(&mut self, bearing: &BearingConstants, own: &[f64]) {
        let (Some(part), Some(at)) = (bearing.lubricant(), bearing.lubricant_at(own)) else {
            return;
        };
        let mut add = |name: &str, unit: &'static str, value: f64| {
            self.number(name, unit, Ok(value), &LUBRICANT);
        };
        if part.grease.is_some() {
            add("lubricant_build_up_at_end", "1", at.build_up);
            add("lubricant_breakdown_at_end", "1", at.breakdown);
        }
        if part.films.is_some() {
            let rise = at.film_temperature_rise;
            add("lubricant_film_temperature_rise_at_end", "K", rise);
        }
        add("lubricant_drag_factor_at_end", "1", at.drag_factor);
    }
    /// Largest forces on the cage, or between the balls, and what their friction took: peaks of pockets and land, N; heats of
    /// pockets, land and neighbours, J. The factor is that of the pressure between neighbours, Pa/N^(1/3).
    pub fn cage(
        &mut self,
        bearing: &BearingConstants,
        peaks: [f64; 2],
        pressure_factor: Option<f64>,
        friction: f64,
    ) {
        let BearingConstants::Planar(planar) = bearing else {
            return;
        };
        match &planar.separation {
            Separation::Neighbours(_) => {
                self.number("peak_ball_ball_force", "N", Ok(peaks[0]), &CAGE_FORCE);
                if let Some(factor) = pressure_factor {
                    let pressure = maximum_pressure(factor, peaks[0]);
                    self.number("peak_ball_ball_pressure", "Pa", Ok(pressure), &PRESSURE);
                }
                self.number(
                    "ball_ball_friction_energy",
                    "J",
                    Ok(friction),
                    &CAGE_FRICTION,
                );
            }
            Separation::CentredCage | Separation::FreeCage(_) => {
                self.number("peak_pocket_force", "N", Ok(peaks[0]), &CAGE_FORCE);
                if let Separation::FreeCage(Some(_)) = planar.separation {
                    self.number("peak_cage_land_force", "N", Ok(peaks[1]), &CAGE_FORCE);
                }
                self.number("cage_friction_energy", "J", Ok(friction), &CAGE_FRICTION);
            }
        }
    }
    /// Takes all values back: nothing was computed.
    pub fn clear(&mut self, why: &str) {
        for quantity in &mut self.0 {
            quantity.value = Value::None {
                why: why.to_string(),
            };
        }
    }
    pub fn number(
        &mut self,
        name: &str,
        unit: &'static str,
        value: Result<f64, String>,
        origin: &Origin,
    ) {
        let value = match value {
            Ok(value) if value.is_finite() => Value::Number(value),
            Ok(value) => Value::None {
                why: format!("the run ended with {value} here"),
            },
            Err(why) => Value::None { why },
        };
        self.push(name, unit, value, origin);
    }
}

/// A residual over what it is compared with.
pub(super) fn relative(residual: f64, scale: f64) -> Result<f64, String> {
    if scale > 0.0 {
        Ok(residual / scale)
    } else {
        Err("nothing turned, moved or was dissipated that it could be compared with".to_string())
    }
}

/// A Hertz pressure over its limit.
fn share_of_limit(pressure: f64, limit: Option<f64>) -> Result<f64, String> {
    limit.map(|limit| pressure / limit).ok_or_else(|| {
        "no limit is given: for hybrid bearings bearing.hertz_pressure_limit is yours to set"
            .to_string()
    })
}

const LUBRICANT: Origin = Origin {
    law: "first-order states of grease and films, factor on the speed-dependent part of the steady moment",
    source: "crates/physics/src/lubricant_state.rs; the parameters are the scenario's",
    valid: "film rises of some 20 K; speeds of one order",
};
const CAGE_FORCE: Origin = Origin {
    law: "P = max(0, k p(1 + a ṗ)) of pockets and land, Hertz between balls; largest at the ends of the steps",
    source: "Hunt-Crossley contact, crates/model/src/bearing/pocket.rs, cage.rs, full_complement.rs",
    valid: "stiffness and damping as given; pocket impacts are chaotic: repeat the run",
};
const CAGE_FRICTION: Origin = Origin {
    law: "time integral of friction force times sliding speed in pockets, at the land, or between balls",
    source: "energy ledger, crates/model/src/system/drop/ledger.rs and spin_up/ledger.rs",
    valid: "dry friction with the coefficients given",
};
const BALL_LOAD: Origin = Origin {
    law: "Q = max(0, K(δ^1.5 + 1.5 β δ^½ δ̇)), the rolling fidelity adds the centrifugal force at the outer race; largest \
          over balls and races at the steps; in drops also, near the record, on dense output between them",
    source: "Hertz 1881 with viscoelastic damping, crates/physics/src/contact.rs",
    valid: "elastic contact; pure radial load",
};
const PRESSURE: Origin = Origin {
    law: "p_max = 3Q/(2πab) of the largest ball load, exact elliptic integrals",
    source: "Hertz 1881, crates/physics/src/hertz.rs; static limit 4200 MPa for steel balls: ISO 76",
    valid: "elastic contact, groove curvatures as given",
};
