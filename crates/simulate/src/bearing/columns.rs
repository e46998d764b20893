//! Columns that every moving system has: races, balls, pressures, energies.

use crate::bearing::film::Films;
use crate::bearing::run::BearingRun;
use model::bearing::ball_states::CAGE_PLACE;
use model::bearing::{BearingConstants, LubricantAt, Separation};
use model::system::energy::Balance;
use model::system::layout::{Entry, Layout};
use model::system::sampling::Row;
use outcome::Column;
use physics::hertz::maximum_pressure;

/// A history that is being named.
pub(crate) struct Table<'a> {
    pub columns: Vec<Column>,
    pub run: &'a BearingRun<'a>,
}

/// A value of the lubricant.
type OfLubricant = fn(&LubricantAt) -> f64;

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

/// Whether balls touch their neighbours.
fn full_complement(bearing: &BearingConstants) -> bool {
    matches!(bearing, BearingConstants::Planar(planar) if matches!(planar.separation, Separation::Neighbours(_)))
}

impl<'a> Table<'a> {
    /// No columns yet.
    pub fn over(run: &'a BearingRun<'a>) -> Self {
        Table {
            columns: Vec::new(),
            run,
        }
    }
    pub fn add(
        &mut self,
        name: &str,
        unit: &'static str,
        meaning: &str,
        value: impl Fn(&Row) -> f64,
    ) {
        self.columns.push(Column {
            name: name.to_string(),
            unit,
            meaning: meaning.to_string(),
            values: self.run.rows.iter().map(value).collect(),
        });
    }
    pub fn channel(&mut self, name: &str, unit: &'static str, meaning: &str, channel: usize) {
        self.add(name, unit, meaning, |row| row.state[channel]);
    }
    pub fn probe(&mut self, name: &str, unit: &'static str, meaning: &str, probe: usize) {
        self.add(name, unit, meaning, |row| row.probe[probe]);
    }

    /// Place and speed of the inner race: x y, velocities, angle, speed, from a first channel.
    pub fn inner_race(&mut self, first: usize) {
        for (name, unit, meaning, channel) in [
            ("x", "m", "inner race centre, to the right", first),
            ("y", "m", "inner race centre, upwards", first + 1),
            ("speed", "rad/s", "spin of the inner race", first + 5),
        ] {
            self.channel(
                &format!("bearing.inner_race.{name}"),
                unit,
                meaning,
                channel,
            );
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
        let BearingConstants::Planar(bearing) = run.bearing else {
            return;
        };
        let [pocket, land] = run.cage_forces;
        match &bearing.separation {
            Separation::Neighbours(_) => {
                self.probe(
                    "bearing.largest_ball_ball_force",
                    "N",
                    "largest force between two neighbouring balls",
                    pocket,
                );
                return;
            }
            Separation::CentredCage | Separation::FreeCage(_) => self.probe(
                "bearing.cage.largest_pocket_force",
                "N",
                "largest force between a ball and its pocket",
                pocket,
            ),
        }
        let Separation::FreeCage(guide) = &bearing.separation else {
            return;
        };
        for (k, (name, meaning)) in [
            ("x", "cage centre, to the right"),
            ("y", "cage centre, upwards"),
        ]
        .into_iter()
        .enumerate()
        {
            let channel = run.states.start + CAGE_PLACE + k;
            self.channel(&format!("bearing.cage.{name}"), "m", meaning, channel);
        }
        if guide.is_some() {
            let meaning = "normal force of cage and land";
            self.probe("bearing.cage.land_force", "N", meaning, land);
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
        let columns: [(bool, &str, &str, &str, OfLubricant); 5] = [
            (
                grease,
                "build_up",
                "1",
                "build-up of the grease: 0 rested, 1 at the level of the law",
                |at| at.build_up,
            ),
            (
                grease,
                "breakdown",
                "1",
                "breakdown of the grease: 0 rested, 1 worked for long",
                |at| at.breakdown,
            ),
            (
                films,
                "film_temperature_rise",
                "K",
                "temperature of the contact films above the bulk of the bearing",
                |at| at.film_temperature_rise,
            ),
            (
                true,
                "drag_factor",
                "1",
                "speed-dependent part of the friction moment over that of the law",
                |at| at.drag_factor,
            ),
            (
                films && planar,
                "traction_factor",
                "1",
                "traction coefficient over that of the law",
                |at| at.traction_factor,
            ),
        ];
        for (_, name, unit, meaning, value) in columns.into_iter().filter(|column| column.0) {
            let name = format!("bearing.lubricant.{name}");
            self.add(&name, unit, meaning, |row| {
                // every row has it where the bearing does
                let at = run.bearing.lubricant_at(run.own(row.state));
                at.map_or(f64::NAN, |at| value(&at))
            });
        }
    }

    /// Azimuth, loads, slips and pocket force of every ball, and the largest pressures.
    fn balls(&mut self) {
        let run = self.run;
        let n = run.bearing.balls();
        let known = match run.bearing {
            BearingConstants::Planar(_) => DETAILS.len(),
            BearingConstants::Rolling(_) => LOADS,
        };
        let films = Films::of(run);
        for ball in 0..n {
            let name = |what: &str| format!("bearing.ball_{:02}.{what}", ball + 1);
            self.add(
                &name("azimuth"),
                "rad",
                "azimuth of the ball from x",
                |row| run.bearing.azimuth(run.own(row.state), ball),
            );
            for (k, mut detail) in DETAILS.into_iter().take(known).enumerate() {
                if detail == POCKET && full_complement(run.bearing) {
                    detail = NEIGHBOUR;
                }
                let (what, unit, meaning) = detail;
                self.probe(&name(what), unit, meaning, run.detail + k * n + ball);
            }
            if let Some(films) = &films {
                for (race, side) in ["inner", "outer"].into_iter().enumerate() {
                    self.add(
                        &name(&format!("{side}_film")),
                        "m",
                        &format!(
                            "central thickness of the oil film at the {side} race; 0 where the ball carries no load"
                        ),
                        |row| films.at(row, ball)[race].as_ref().map_or(0.0, |film| film.state.thickness),
                    );
                }
            }
        }
        for (race, (probe, factor)) in ["inner", "outer"].into_iter().zip(
            run.largest_loads
                .into_iter()
                .zip(run.pressure_factors.races),
        ) {
            self.add(
                &format!("bearing.{race}_pressure"),
                "Pa",
                &format!("largest Hertz pressure of all balls at the {race} race"),
                |row| maximum_pressure(factor, row.probe[probe]),
            );
        }
    }

    /// Heats and works since the start. What a part's bearing cannot make has no column.
    pub fn flows(&mut self, layout: &Layout, bearing_of: impl Fn(&str) -> &'a BearingConstants) {
        let mut add = |what: &str, entry: &Entry, channel: usize| {
            let meaning = format!("{what} since the start: {}", entry.kind.replace('_', " "));
            self.channel(&layout.channel_name(channel), "J", &meaning, channel);
        };
        for (i, heat) in layout.heats().iter().enumerate() {
            if bearing_of(&heat.part).may_make(heat.kind) {
                add("heat made", heat, layout.heat(i));
            }
        }
        for (i, source) in layout.sources().iter().enumerate() {
            if source.kind != "inner_race_growth" || bearing_of(&source.part).grows() {
                add("work put in", source, layout.source(i));
            }
        }
    }

    /// The works by the moment on the outer race in a spin-up; `body`, for short `name`, turns with the inner race.
    pub fn outer_race_works(&mut self, body: &str, name: &str, layout: &Layout) {
        self.channel(
            "energy.outer_race.moment_work",
            "J",
            &format!("time integral of t_O times the speed of the {body}"),
            layout.work(1),
        );
        self.channel(
            "energy.outer_race.path_term",
            "J",
            &format!("integral of the {name}'s speed over the angular momentum of balls and cage"),
            layout.work(2),
        );
    }

    /// What is stored, and what the ledger misses.
    pub fn energies(&mut self, balance: impl Fn(&Row) -> Balance) {
        self.add(
            "energy.kinetic",
            "J",
            "kinetic energy of all bodies",
            |row| row.content.translation + row.content.spin,
        );
        self.add(
            "energy.potential",
            "J",
            "energy in springs, contacts and height; zero at the origin where nothing touches",
            |row| row.content.potential,
        );
        self.add(
            "energy.residual",
            "J",
            "what the energy ledger misses: works less heats less change of energy",
            |row| balance(row).energy_residual(),
        );
        self.add(
            "angular_momentum.residual",
            "N m s",
            "external impulse less the change of angular momentum about the origin",
            |row| balance(row).angular_momentum_residual(),
        );
    }
}
