//! Results that several systems have: first rises, ball loads, lubricant, cage, heats.

use crate::bearing::pressure::PressureFactors;
use crate::bearing::run::BearingRun;
use crate::bearing::{film, races, severity, skid};
use model::bearing::lubricant_state::LubricantAt;
use model::bearing::{BearingConstants, LubricantConstants, PlanarConstants};
use outcome::list::results;
use outcome::list::{List, origins};
use physics::traction::Traction;
use scenario::Bearing;

/// A bearing before a run.
#[derive(Clone, Copy)]
pub(crate) struct BearingSetup<'a> {
    /// What the scenario says of it.
    pub given: &'a Bearing,
    /// Its constants.
    pub constants: &'a BearingConstants,
    /// Hertz pressure in the contacts of a ball.
    pub factors: &'a PressureFactors,
}

impl<'a> BearingSetup<'a> {
    /// Its constants where balls may slide.
    pub fn planar(&self) -> Option<&'a PlanarConstants> {
        match self.constants {
            BearingConstants::Planar(planar) => Some(planar),
            BearingConstants::Rolling(_) | BearingConstants::Spatial(_) => None,
        }
    }
}

/// Loads, films, skids, lubricant and cage.
pub(crate) fn balls(list: &mut List, setup: &BearingSetup, run: Option<&BearingRun>) {
    ball_loads(list, setup, run);
    if let Some(planar) = setup.planar() {
        if let Traction::Lubricated(_) = planar.traction {
            film::films(list, &(), run.and_then(BearingRun::films).as_ref());
        }
        skid::skids(list, &(), run.and_then(BearingRun::skids).as_ref());
    }
    races_and_lubricant(list, setup, run);
    if let Some(apart) = Apart::of(setup.constants) {
        cage(list, &apart, run);
    }
}

/// What the races saw of the balls, and what the lubricant came to.
pub(crate) fn races_and_lubricant(list: &mut List, setup: &BearingSetup, run: Option<&BearingRun>) {
    if setup.constants.race_laws().is_some() {
        races::races(list, &(), run.and_then(|run| run.record?.races.as_ref()));
    }
    if let Some(part) = setup.constants.lubricant() {
        let at = |run: &BearingRun| run.bearing.lubricant_at(run.own(run.end));
        lubricant(list, part, run.and_then(at).as_ref());
    }
}

/// Largest ball load and Hertz pressures, against the limits of the bearing.
pub(crate) fn ball_loads(list: &mut List, setup: &BearingSetup, run: Option<&BearingRun>) {
    loads(list, setup, run);
    severity::of_ball_load(list, setup.given, run);
}

results! {
    fn loads(setup: &BearingSetup, run: &BearingRun) {
        "peak_ball_load": number "N", BALL_LOAD, "largest load of a ball" => run.peaks()[0].value.max(run.peaks()[1].value);
        "peak_hertz_pressure": number "Pa" headline, PRESSURE, "largest Hertz pressure between ball and race" in tile "Peak Hertz pressure" => run.pressures().races;
        "peak_ball_ball_pressure": number "Pa", PRESSURE, "largest Hertz pressure between two balls" in note "Peak Hertz pressure: between balls" when setup.factors.neighbours.is_some() => {
            run.pressures().neighbours.unwrap_or(0.0)
        };
        "hertz_pressure_share_of_limit": number "1", PRESSURE, "largest Hertz pressure over its limit" in note "Peak Hertz pressure: of its limit [%]" in bound "1" => run.pressures().share_of_limit(setup.given);
    }
    /// What the lubricant came to at the end.
    fn lubricant(part: &LubricantConstants, at: &LubricantAt) {
        "lubricant_build_up_at_end": number "1", LUBRICANT, "build-up of the grease at the end" when part.grease.is_some() => at.build_up;
        "lubricant_breakdown_at_end": number "1", LUBRICANT, "breakdown of the grease at the end" when part.grease.is_some() => at.breakdown;
        "lubricant_film_temperature_rise_at_end": number "K", LUBRICANT, "rise of the contact films at the end" when part.films.is_some() => {
            at.film_temperature_rise
        };
        "lubricant_drag_factor_at_end": number "1", LUBRICANT, "factor on the speed-dependent moment at the end" => at.drag_factor;
    }
    /// Largest forces on the cage, or between the balls, and what their friction took.
    fn cage(apart: &Apart, run: &BearingRun) {
        "peak_ball_ball_force": number "N", CAGE_FORCE, "largest force between two balls" when apart.neighbours => run.peaks()[2].value;
        "peak_pocket_force": number "N", CAGE_FORCE, "largest force between ball and pocket" when !apart.neighbours => run.peaks()[2].value;
        "peak_cage_land_force": number "N", CAGE_FORCE, "largest force between cage and land" when apart.land => {
            run.peaks()[3].value
        };
        "ball_ball_friction_energy": number "J", CAGE_FRICTION, "friction heat between the balls" when apart.neighbours => run.cage_friction();
        "cage_friction_energy": number "J", CAGE_FRICTION, "friction heat of pockets and land" when !apart.neighbours => run.cage_friction();
    }
}

/// What keeps balls apart that move by themselves.
struct Apart {
    /// The next ball.
    neighbours: bool,
    /// A cage on a land.
    land: bool,
}

impl Apart {
    /// None where balls roll always.
    fn of(bearing: &BearingConstants) -> Option<Self> {
        let may = |heat| bearing.may_make(heat);
        bearing.cage_speed_state().map(|_| Apart {
            neighbours: may("ball_ball_friction"),
            land: may("cage_land_friction"),
        })
    }
}

impl BearingRun<'_> {
    /// What friction of the cage, or between the balls, took, J.
    fn cage_friction(&self) -> f64 {
        let kinds = [
            "pocket_friction",
            "cage_land_friction",
            "ball_ball_friction",
        ];
        kinds.iter().map(|kind| self.heat(kind)).sum()
    }
    /// What the balls lost sliding on both races, J.
    pub fn ball_slip(&self) -> Result<f64, String> {
        match self.bearing {
            BearingConstants::Planar(_) | BearingConstants::Spatial(_) => {
                Ok(self.slips().iter().sum())
            }
            BearingConstants::Rolling(_) => {
                Err("balls do not slip in the rolling fidelity".to_string())
            }
        }
    }
}

origins! {
    LUBRICANT: law "first-order states of grease and films, factor on the speed-dependent part of the steady moment",
        source "Barnes 1997 (thixotropy), crates/physics/src/lubricant_state.rs; the parameters are the scenario's",
        valid "film rises of some 20 K; speeds of one order";
    CAGE_FORCE: law "P = max(0, k p(1 + a ṗ)) of pockets and land, Hertz between balls; largest at the ends of the steps",
        source "Hunt and Crossley 1975, crates/model/src/bearing/pocket.rs, cage.rs, full_complement.rs",
        valid "stiffness and damping as given; pocket impacts are often chaotic: repeat the run";
    CAGE_FRICTION: law "time integral of friction force times sliding speed in pockets, at the land, or between balls",
        source "energy ledger, crates/model/src/system/machine/ledger.rs",
        valid "dry friction with the coefficients given";
    BALL_LOAD: law "Q = max(0, K(δ^1.5 + 1.5 β δ^½ δ̇)), the rolling fidelity adds the centrifugal force at the outer race; largest \
          over balls and races at the steps; in drops also, near the record, on dense output between them",
        source "Hertz 1881 with viscoelastic damping, crates/physics/src/contact.rs",
        valid "elastic contact; pure radial load";
    PRESSURE: law "p_max = 3Q/(2πab) of the largest ball load, exact elliptic integrals",
        source "Hertz 1881, crates/physics/src/hertz.rs; the share is the largest of both kinds of contact, each by its own limit: bearing.hertz_pressure_limit, bearing.full_complement.hertz_pressure_limit",
        valid "elastic contact, groove curvatures as given";
}
