//! Columns that every moving system has: races, balls, pressures, energies.

use crate::bearing::film::Films;
use crate::bearing::run::BearingRun;
use model::auxiliary_bearing::probe::{
    AXIAL_FORCE, LAND_FORCE, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE,
};
use model::bearing::ball_states::CAGE_PLACE;
use model::bearing::{BearingConstants, LubricantAt, Separation};
use model::body::BodyAt;
use model::spatial::SpatialBearing;
use model::spatial::part::SPIN;
use model::spatial::rigid_body::BODY_STATES;
use model::system::energy::Balance;
use model::system::layout::{Entry, Layout};
use model::system::machine::RotorMachine;
use model::system::sampling::Row;
use outcome::columns::{Columns, columns};
use physics::hertz::maximum_pressure;

/// A history that is being named.
pub(crate) struct Table<'a> {
    pub columns: Columns<'a, Row<'a>>,
    pub run: &'a BearingRun<'a>,
}

/// Detail of a ball: name, unit, meaning; the loads are known in every fidelity.
const DETAILS: [(&str, &str, &str); 5] = [
    ("inner_load", "N", "load of the ball on the inner race"),
    ("outer_load", "N", "load of the ball on the outer race"),
    (
        "inner_slip",
        "m/s",
        "sliding speed at the inner race, race less ball surface",
    ),
    (
        "outer_slip",
        "m/s",
        "sliding speed at the outer race, race less ball surface",
    ),
    POCKET,
];
/// The force that keeps balls apart: of a pocket, or of the next ball.
const POCKET: (&str, &str, &str) = ("pocket_force", "N", "force of the cage pocket");
const NEIGHBOUR: (&str, &str, &str) = (
    "next_ball_force",
    "N",
    "force between the ball and the next one",
);
/// How many of [`DETAILS`] are loads.
const LOADS: usize = 2;
const RACES: [&str; 2] = ["inner", "outer"];

/// Whether balls touch their neighbours.
fn full_complement(bearing: &BearingConstants) -> bool {
    matches!(bearing, BearingConstants::Planar(planar) if matches!(planar.separation, Separation::Neighbours(_)))
}

impl<'a> Table<'a> {
    /// No columns yet.
    pub fn over(run: &'a BearingRun<'a>) -> Self {
        Table {
            columns: Columns::over(&run.rows),
            run,
        }
    }

    /// Place and speed of the inner race.
    pub fn inner_race(&mut self, race: BodyAt) {
        let [x, y] = race.centre();
        columns! { self.columns, |row|
            "bearing.inner_race.x": "m", "inner race centre, to the right" => row.state[x];
            "bearing.inner_race.y": "m", "inner race centre, upwards" => row.state[y];
            "bearing.inner_race.speed": "rad/s", "spin of the inner race" => row.state[race.spin()];
        }
    }

    /// Cage, lubricant and balls.
    pub fn bearing(&mut self) {
        self.cage();
        self.lubricant();
        self.balls();
    }

    /// Place of a cage that is free to move, and the largest forces on it.
    fn cage(&mut self) {
        let run = self.run;
        let bearing = match run.bearing {
            BearingConstants::Planar(bearing) => bearing,
            BearingConstants::Spatial(bearing) => return self.cages_in_space(bearing),
            BearingConstants::Rolling(_) => return,
        };
        let [pocket, land] = [LARGEST_POCKET_FORCE, LAND_FORCE].map(|kind| run.at.probe(kind));
        let has_cage = !full_complement(run.bearing);
        let place = run.at.bearing + CAGE_PLACE;
        let (is_free, is_guided) = match &bearing.separation {
            Separation::FreeCage(guide) => (true, guide.is_some()),
            Separation::Neighbours(_) | Separation::CentredCage => (false, false),
        };
        columns! { self.columns, |row|
            "bearing.largest_ball_ball_force": "N", "largest force between two neighbouring balls" when !has_cage => row.probe[pocket];
            "bearing.cage.largest_pocket_force": "N", "largest force between a ball and its pocket" when has_cage => row.probe[pocket];
            "bearing.cage.x": "m", "cage centre, to the right" when is_free => row.state[place];
            "bearing.cage.y": "m", "cage centre, upwards" when is_free => row.state[place + 1];
            "bearing.cage.land_force": "N", "normal force of cage and land" when is_guided => row.probe[land];
        }
    }

    /// Rings and cages of a bearing in space along and about the axis, and its faces.
    fn cages_in_space(&mut self, bearing: &SpatialBearing) {
        let at = self.run.at;
        let [pocket, land, force] =
            [LARGEST_POCKET_FORCE, LAND_FORCE, AXIAL_FORCE].map(|kind| at.probe(kind));
        let guided = bearing.may_make("cage_land_friction");
        let turns = bearing.outer_inertias.is_some();
        let sliding = at.own().start + bearing.sliding_state();
        let (springs, spring) = (bearing.spring.is_some(), bearing.spring);
        columns! { self.columns, |row|
            "bearing.inner_race.z": "m", "inner ring along the axis, towards the end of the shaft" => at.motion(row.state).inner.axial;
            "bearing.inner_race.tilt_x": "rad", "tilt of the inner ring about x" => at.motion(row.state).inner.tilt.x;
            "bearing.inner_race.tilt_y": "rad", "tilt of the inner ring about y" => at.motion(row.state).inner.tilt.y;
            "bearing.outer_race.z": "m", "outer rings along the axis, towards the end of the shaft" => at.motion(row.state).outer.axial;
            "bearing.outer_race.tilt_x": "rad", "tilt of the outer rings about x" when turns => at.motion(row.state).outer.tilt.x;
            "bearing.outer_race.tilt_y": "rad", "tilt of the outer rings about y" when turns => at.motion(row.state).outer.tilt.y;
            "bearing.sliding_outer_race.z": "m", "outer rings on the preload spring along the axis, beside the others" when springs => row.state[sliding];
            "bearing.preload_spring.force": "N", "force of the preload spring" when springs => spring.map_or(f64::NAN, |own| own.force(row.state[sliding]));
            "bearing.contact.axial_force": "N", "force between shoulders of the rotor and faces of the inner ring" when bearing.stops() => row.probe[force];
            "bearing.cage.largest_pocket_force": "N", "largest force between a ball and its pocket" => row.probe[pocket];
            "bearing.cage.land_force": "N", "normal force of cages and lands" when guided => row.probe[land];
        }
        for cage in 1..bearing.rows.len() {
            let number = cage + 1;
            let speed = at.bearing + cage * BODY_STATES + SPIN;
            columns! { self.columns, |row|
                "bearing.cage_{number}.speed": "rad/s", "spin of the cage of row {number}" => row.state[speed];
            }
        }
        for ball in 0..bearing.balls() {
            let number = ball + 1;
            let angle = move |row: &Row, race: usize| {
                let found = bearing.contacts(&at.motion(row.state), &row.state[at.own()], ball);
                let touch = &found.races.touch[race];
                match touch.load.force > 0.0 {
                    true => {
                        touch.triad.normal[1].asin() * (1.0 - 2.0 * f64::from(u8::from(race == 0)))
                    }
                    false => 0.0,
                }
            };
            columns! { self.columns, |row|
                "bearing.ball_{number:02}.inner_angle": "rad", "contact angle at the inner race, positive where the inner ring is pressed towards the end of the shaft; 0 without load" => angle(row, 0);
                "bearing.ball_{number:02}.outer_angle": "rad", "contact angle at the outer race, likewise" => angle(row, 1);
            }
        }
    }

    /// What changes of the lubricant, and its factors.
    fn lubricant(&mut self) {
        let run = self.run;
        let Some(lubricant) = run.bearing.lubricant() else {
            return;
        };
        let (grease, films) = (lubricant.grease.is_some(), lubricant.films.is_some());
        let planar = matches!(run.bearing, BearingConstants::Planar(_));
        // every row has it where the bearing does
        let of = |row: &Row, value: fn(&LubricantAt) -> f64| {
            let at = run.bearing.lubricant_at(run.own(row.state));
            at.map_or(f64::NAN, |at| value(&at))
        };
        columns! { self.columns, |row|
            "bearing.lubricant.build_up": "1", "build-up of the grease: 0 rested, 1 at the level of the law" when grease
                => of(row, |at| at.build_up);
            "bearing.lubricant.breakdown": "1", "breakdown of the grease: 0 rested, 1 worked for long" when grease
                => of(row, |at| at.breakdown);
            "bearing.lubricant.film_temperature_rise": "K", "temperature of the contact films above the bulk of the bearing" when films
                => of(row, |at| at.film_temperature_rise);
            "bearing.lubricant.drag_factor": "1", "speed-dependent part of the friction moment over that of the law"
                => of(row, |at| at.drag_factor);
            "bearing.lubricant.traction_factor": "1", "traction coefficient over that of the law" when films && planar
                => of(row, |at| at.traction_factor);
        }
    }

    /// Azimuth, loads, slips and pocket force of every ball, and the largest pressures.
    fn balls(&mut self) {
        let run = self.run;
        let n = run.bearing.balls();
        let known = match run.bearing {
            BearingConstants::Planar(_) | BearingConstants::Spatial(_) => DETAILS.len(),
            BearingConstants::Rolling(_) => LOADS,
        };
        let films = Films::of(run);
        for ball in 0..n {
            let number = ball + 1;
            columns! { self.columns, |row|
                "bearing.ball_{number:02}.azimuth": "rad", "azimuth of the ball from x" => run.bearing.azimuth(run.own(row.state), ball);
            }
            for (k, mut detail) in DETAILS.into_iter().take(known).enumerate() {
                if detail == POCKET && full_complement(run.bearing) {
                    detail = NEIGHBOUR;
                }
                let (what, unit, meaning) = detail;
                columns! { self.columns, |row|
                    "bearing.ball_{number:02}.{what}": unit, "{meaning}" => row.probe[run.at.detail + k * n + ball];
                }
            }
            let Some(films) = &films else { continue };
            for (race, side) in RACES.into_iter().enumerate() {
                columns! { self.columns, |row|
                    "bearing.ball_{number:02}.{side}_film": "m",
                        "central thickness of the oil film at the {side} race; 0 where the ball carries no load"
                        => films.at(row, ball)[race].as_ref().map_or(0.0, |film| film.state.thickness);
                }
            }
        }
        let factors = run.pressure_factors.races;
        let probes = [LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD].map(|kind| run.at.probe(kind));
        for (race, side) in RACES.into_iter().enumerate() {
            columns! { self.columns, |row|
                "bearing.{side}_pressure": "Pa", "largest Hertz pressure of all balls at the {side} race"
                    => maximum_pressure(factors[race], row.probe[probes[race]]);
            }
        }
    }

    /// Heats and works since the start, of all rows of each bearing. What a part's bearing cannot make has no column.
    pub fn flows(&mut self, machine: &RotorMachine, of: impl Fn(&str) -> &'a BearingConstants) {
        let (layout, rows) = (machine.layout(), machine.ledger_rows());
        let mut add = |what: &str, entry: &Entry, channel: usize| {
            let (name, kind) = (layout.channel_name(channel), entry.kind.replace('_', " "));
            columns! { self.columns, |row| "{name}": "J", "{what} since the start: {kind}" => rows[channel - layout.ledger()] * row.state[channel]; }
        };
        for (i, heat) in layout.heats().iter().enumerate() {
            if of(&heat.part).may_make(heat.kind) {
                add("heat made", heat, layout.heat(i));
            }
        }
        for (i, source) in layout.sources().iter().enumerate() {
            if source.kind != "inner_race_growth" || of(&source.part).grows() {
                add("work put in", source, layout.source(i));
            }
        }
    }

    /// The works by the moment on the outer race in a spin-up; `body`, for short `name`, turns with the inner race.
    pub fn outer_race_works(&mut self, body: &str, name: &str, layout: &Layout) {
        columns! { self.columns, |row|
            "energy.outer_race.moment_work": "J", "time integral of t_O times the speed of the {body}" => row.state[layout.work(1)];
            "energy.outer_race.path_term": "J", "integral of the {name}'s speed over the angular momentum of balls and cage"
                => row.state[layout.work(2)];
        }
    }

    /// What is stored, and what the ledger misses; before a run there is no balance.
    pub fn energies(&mut self, balance: impl Fn(&Row) -> Option<Balance>) {
        let of =
            |row: &Row, value: fn(&Balance) -> f64| balance(row).as_ref().map_or(f64::NAN, value);
        columns! { self.columns, |row|
            "energy.kinetic": "J", "kinetic energy of all bodies" => row.content.translation + row.content.spin;
            "energy.potential": "J", "energy in springs, contacts and height; zero at the origin where nothing touches" => row.content.potential;
            "energy.residual": "J", "what the energy ledger misses: works less heats less change of energy" => of(row, Balance::energy_residual);
            "angular_momentum.residual": "N m s", "external impulse less the change of angular momentum about the origin"
                => of(row, Balance::angular_momentum_residual);
        }
    }
}
