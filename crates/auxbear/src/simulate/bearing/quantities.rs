//! Results that several systems have: first rises, ball loads, lubricant, cage, heats.

use crate::result::list::{List, Origin};
use crate::scenario::Bearing;
use crate::simulate::bearing::pressure::Pressures;
use crate::simulate::bearing::run::BearingRun;
use model::bearing::{BearingConstants, Separation};
use model::system::layout::Layout;
use model::system::sampling::Peak;

/// A state at the end of a run.
pub(crate) struct End<'a> {
    /// Name of the part whose bearing is meant.
    pub part: &'a str,
    pub layout: &'a Layout,
    pub state: &'a [f64],
}

impl End<'_> {
    /// What a kind of heat has summed up, J.
    pub fn heat(&self, kind: &str) -> f64 {
        self.layout
            .heat_of(self.state, self.part, kind)
            .unwrap_or(0.0)
    }
    /// What the balls lost sliding on the inner and on the outer race, J.
    fn slips(&self) -> [f64; 2] {
        ["inner_ball_slip", "outer_ball_slip"].map(|kind| self.heat(kind))
    }
}

/// Largest forces of a run.
pub(crate) struct LargestForces {
    /// Ball loads at the inner and the outer race.
    pub loads: [Peak; 2],
    /// Of pockets, or between balls without a cage, and at the land.
    pub cage: [Peak; 2],
}

impl List {
    /// First instants at which a body reaches half and 95 % of the speed that counts, and the cage 95 % of its rolling speed;
    /// or why they are not reached.
    pub fn rises(
        &mut self,
        body: &str,
        times: [Option<f64>; 3],
        never: [String; 3],
        origin: &Origin,
    ) {
        let names = [
            format!("{body}_time_to_50_percent"),
            format!("{body}_time_to_95_percent"),
            "cage_time_to_95_percent_of_rolling".to_string(),
        ];
        for (name, (time, why)) in names.iter().zip(times.into_iter().zip(never)) {
            self.awaited(name, time.ok_or(why), origin);
        }
    }

    /// Largest ball load and Hertz pressures, against the limits of the bearing.
    pub fn ball_loads(&mut self, loads: [Peak; 2], pressures: &Pressures, bearing: &Bearing) {
        let load = loads[0].value.max(loads[1].value);
        self.number("peak_ball_load", "N", Ok(load), &BALL_LOAD);
        let mut pressure = |name: &str, unit: &'static str, value: f64| {
            self.number(name, unit, Ok(value), &PRESSURE);
        };
        pressure("peak_hertz_pressure", "Pa", pressures.races);
        if let Some(neighbours) = pressures.neighbours {
            pressure("peak_ball_ball_pressure", "Pa", neighbours);
        }
        let share = pressures.share_of_limit(bearing);
        pressure("hertz_pressure_share_of_limit", "1", share);
        self.ball_load_severity(loads, pressures.races, bearing);
    }

    /// What the lubricant came to in a state at the end; nothing where it has no state.
    pub fn lubricant(&mut self, run: &BearingRun, state: &[f64]) {
        let at = run.bearing.lubricant_at(run.own(state));
        let (Some(part), Some(at)) = (run.bearing.lubricant(), at) else {
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

    /// Loads, films, skids, lubricant and cage.
    pub fn balls(
        &mut self,
        run: &BearingRun,
        forces: &LargestForces,
        bearing: &Bearing,
        end: &End,
    ) {
        let pressures = (run.pressure_factors).pressures(forces.loads, forces.cage[0]);
        self.ball_loads(forces.loads, &pressures, bearing);
        if let Some(films) = run.films() {
            films.name(self);
        }
        if let Some(skids) = run.skids() {
            skids.name(self, end.slips());
        }
        self.races(run);
        self.lubricant(run, end.state);
        let friction = end.heat("pocket_friction")
            + end.heat("cage_land_friction")
            + end.heat("ball_ball_friction");
        self.cage(run, forces.cage.map(|force| force.value), friction);
    }

    /// Largest forces on the cage, or between the balls, N, and what their friction took, J.
    fn cage(&mut self, run: &BearingRun, [pocket, land]: [f64; 2], friction: f64) {
        let BearingConstants::Planar(planar) = run.bearing else {
            return;
        };
        let friction_name = match &planar.separation {
            Separation::Neighbours(_) => {
                self.number("peak_ball_ball_force", "N", Ok(pocket), &CAGE_FORCE);
                "ball_ball_friction_energy"
            }
            Separation::CentredCage | Separation::FreeCage(_) => {
                self.number("peak_pocket_force", "N", Ok(pocket), &CAGE_FORCE);
                if let Separation::FreeCage(Some(_)) = planar.separation {
                    self.number("peak_cage_land_force", "N", Ok(land), &CAGE_FORCE);
                }
                "cage_friction_energy"
            }
        };
        self.number(friction_name, "J", Ok(friction), &CAGE_FRICTION);
    }

    /// What sliding of the rotor and of the balls took, J.
    pub fn losses(&mut self, run: &BearingRun, end: &End, origin: &Origin) {
        let [inner, outer] = end.slips();
        let slip = matches!(run.bearing, BearingConstants::Planar(_))
            .then_some(inner + outer)
            .ok_or_else(|| "balls do not slip in the rolling fidelity".to_string());
        for (name, value) in [
            (
                "rotor_race_friction_energy",
                Ok(end.heat("rotor_race_friction")),
            ),
            ("ball_slip_energy", slip),
        ] {
            self.number(name, "J", value, origin);
        }
    }
}

const LUBRICANT: Origin = Origin {
    law: "first-order states of grease and films, factor on the speed-dependent part of the steady moment",
    source: "Barnes 1997 (thixotropy), crates/physics/src/lubricant_state.rs; the parameters are the scenario's",
    valid: "film rises of some 20 K; speeds of one order",
};
const CAGE_FORCE: Origin = Origin {
    law: "P = max(0, k p(1 + a ṗ)) of pockets and land, Hertz between balls; largest at the ends of the steps",
    source: "Hunt and Crossley 1975, crates/model/src/bearing/pocket.rs, cage.rs, full_complement.rs",
    valid: "stiffness and damping as given; pocket impacts are often chaotic: repeat the run",
};
const CAGE_FRICTION: Origin = Origin {
    law: "time integral of friction force times sliding speed in pockets, at the land, or between balls",
    source: "energy ledger, crates/model/src/system/machine/ledger.rs and spin_up/ledger.rs",
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
    source: "Hertz 1881, crates/physics/src/hertz.rs; the share is the largest of both kinds of contact, each by its own limit: bearing.hertz_pressure_limit, bearing.full_complement.hertz_pressure_limit",
    valid: "elastic contact, groove curvatures as given",
};
