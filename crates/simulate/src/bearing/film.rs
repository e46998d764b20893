//! The films between balls and races, reported after a run from its rows.

use crate::bearing::run::BearingRun;
use crate::bearing::warning_table::BearingWarning;
use model::bearing::{BearingConstants, PlanarConstants};
use model::system::sampling::Row;
use outcome::list::origins;
use outcome::list::results;
use outcome::{Value, Warning};
use physics::film::FilmRegime;
use physics::lubricant::HIGHEST_PRESSURE;
use physics::lubricant_traction::ContactState;
use physics::traction::{LubricatedRaces, Traction};
use physics::viscosity::ICE_POINT;
use scenario::{Bearing, Traction as TractionChoice};

/// λ = h_min/σ below which asperities carry much of the load.
const MIXED: f64 = 1.0;
/// Share of loaded contacts in rows above which a mixed film is worth a warning.
const MOSTLY: f64 = 0.5;
/// Share of the race's fastest speed from which on films are judged: at rest there are none.
const FAST: f64 = 0.5;
/// Temperature rise of a film up to which the law's stress is within 1.3 %, K.
const HOTTEST: f64 = 200.0;

/// The film of a loaded contact.
pub(crate) struct Film {
    /// The contact under its law.
    pub state: ContactState<f64>,
    load: f64,
    regime: FilmRegime,
}

/// The films of a bearing whose traction is that of its oil.
pub(crate) struct Films<'a> {
    run: &'a BearingRun<'a>,
    bearing: &'a PlanarConstants,
    law: &'a LubricatedRaces<f64>,
}

impl<'a> Films<'a> {
    /// None where traction is not that of an oil.
    pub fn of(run: &'a BearingRun<'a>) -> Option<Films<'a>> {
        let BearingConstants::Planar(bearing) = run.bearing else {
            return None;
        };
        let Traction::Lubricated(law) = &bearing.traction else {
            return None;
        };
        Some(Films { run, bearing, law })
    }

    /// Films of a ball at the inner and the outer race; none where it carries no load.
    pub fn at(&self, row: &Row, ball: usize) -> [Option<Film>; 2] {
        let motion = self.run.motion(row.state);
        let reaction = (self.bearing).ball_reaction(&motion, self.run.own(row.state), ball);
        let [inner, outer] = reaction.contacts();
        [(&self.law.inner, inner), (&self.law.outer, outer)].map(|(law, at)| {
            (at.load > 0.0).then(|| Film {
                state: law.state(at.slip, at.load, at.entrainment),
                load: at.load,
                regime: law.film.regime(at.entrainment, at.load),
            })
        })
    }

    /// What all loaded contacts came to in the rows in which the race turns fast.
    pub fn summary(&self) -> Summary {
        let least = FAST * self.run.fastest();
        let mut summary = Summary::default();
        for row in (self.run.rows.iter()).filter(|row| self.run.speed(row) >= least) {
            for film in (0..self.bearing.balls)
                .flat_map(|ball| self.at(row, ball))
                .flatten()
            {
                summary.add(&film);
            }
        }
        summary
    }
}

impl BearingRun<'_> {
    /// The films between balls and races, where traction is theirs.
    pub fn films(&self) -> Option<Summary> {
        Films::of(self).map(|films| films.summary())
    }
}

/// The films of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Summary {
    contacts: usize,
    mixed: usize,
    /// Contacts in each of [`FilmRegime::ALL`].
    regimes: [usize; 4],
    /// Load and regime of the heaviest contact.
    heaviest: Option<(f64, FilmRegime)>,
    thickness: f64,
    central: f64,
    lambda: f64,
    temperature_rise: f64,
    pressure: f64,
}

impl Default for Summary {
    fn default() -> Self {
        Summary {
            contacts: 0,
            mixed: 0,
            regimes: [0; 4],
            heaviest: None,
            thickness: f64::INFINITY,
            central: f64::INFINITY,
            lambda: f64::INFINITY,
            temperature_rise: 0.0,
            pressure: 0.0,
        }
    }
}

impl Summary {
    fn add(&mut self, film: &Film) {
        let state = &film.state;
        self.contacts += 1;
        self.mixed += usize::from(state.lambda < MIXED);
        for (count, regime) in self.regimes.iter_mut().zip(FilmRegime::ALL) {
            *count += usize::from(film.regime == regime);
        }
        if self.heaviest.is_none_or(|(load, _)| film.load > load) {
            self.heaviest = Some((film.load, film.regime));
        }
        self.thickness = self.thickness.min(state.minimum_thickness);
        self.central = self.central.min(state.thickness);
        self.lambda = self.lambda.min(state.lambda);
        self.temperature_rise = self.temperature_rise.max(state.temperature_rise);
        self.pressure = self.pressure.max(1.5 * state.mean_pressure);
    }

    /// Share of the loaded contacts in rows.
    fn share(&self, count: usize) -> f64 {
        count as f64 / self.contacts as f64
    }

    /// A number of films, of which there must be some.
    fn seen(&self, value: f64) -> Result<f64, String> {
        (self.contacts > 0).then_some(value).ok_or_else(none)
    }

    /// Films that are thin, and laws outside their range.
    pub fn warnings(&self, bearing: &Bearing) -> Vec<Warning> {
        let mut list = Vec::new();
        let TractionChoice::Lubricant(film) = bearing.traction else {
            return list;
        };
        if self.contacts > 0 && self.share(self.mixed) > MOSTLY {
            let share = self.share(self.mixed);
            list.push(BearingWarning::MixedFilm { share }.into());
        }
        let mut departures = Vec::new();
        if self.pressure >= 0.999 * HIGHEST_PRESSURE {
            departures
                .push("contacts reach 5 GPa, at which the oil's viscosity is held".to_string());
        }
        let hottest = film.temperature + self.temperature_rise;
        if self.temperature_rise > HOTTEST {
            departures.push(format!(
                "films run up to {:.0} K above the oil in their inlet, and the law serves up to {HOTTEST:.0} K",
                self.temperature_rise
            ));
        } else if hottest > film.oil.temperatures.1 {
            departures.push(format!(
                "films reach {:.0} degC, and the viscosity of the oil is known up to {:.0} degC",
                hottest - ICE_POINT,
                film.oil.temperatures.1 - ICE_POINT
            ));
        }
        if !departures.is_empty() {
            let departures = departures.join("; ");
            list.push(BearingWarning::FilmLaw { departures }.into());
        }
        list
    }
}

/// Why there are no films.
fn none() -> String {
    "no ball carried load in any row".to_string()
}

results! {
    /// The films between balls and races.
    pub(crate) fn films(setup: &(), run: &Summary) {
        "smallest_film_thickness": number "m", FILM, "smallest minimum film thickness" => run.seen(run.thickness);
        "smallest_central_film_thickness": number "m", FILM, "smallest central film thickness" => run.seen(run.central);
        "smallest_lambda_ratio": number "1", FILM, "smallest film over the composite roughness" => run.seen(run.lambda);
        "mixed_film_share": number "1", FILM, "share of loaded contacts with lambda below 1" => run.seen(run.share(run.mixed));
        "isoviscous_rigid_film_share": number "1", FILM, "share of loaded contacts in this regime" => run.seen(run.share(run.regimes[0]));
        "piezoviscous_rigid_film_share": number "1", FILM, "share of loaded contacts in this regime" => run.seen(run.share(run.regimes[1]));
        "isoviscous_elastic_film_share": number "1", FILM, "share of loaded contacts in this regime" => run.seen(run.share(run.regimes[2]));
        "piezoviscous_elastic_film_share": number "1", FILM, "share of loaded contacts in this regime" => run.seen(run.share(run.regimes[3]));
        "film_regime_of_heaviest_contact": text "", FILM, "film regime of the most loaded contact" => {
            run.heaviest.map_or_else(|| Value::None { why: none() }, |(_, regime)| regime.name().into())
        };
    }
}

origins! {
    FILM: law "minimum or central film of elliptical contacts in four regimes with inlet shear heating, crates/physics/src/film.rs; \
          loaded contacts in those rows of the history in which the race turns at half its fastest speed or more; lambda is \
          the minimum film over the composite roughness",
        source "B. J. Hamrock, D. Dowson, J. Lubr. Technol. 99 (1977) 264; D. E. Brewe, B. J. Hamrock, C. M. Taylor, \
             J. Lubr. Technol. 101 (1979) 231",
        valid "flooded films that follow load and speed at once: near zero where a ball does not roll; a race that starts has none yet";
}
