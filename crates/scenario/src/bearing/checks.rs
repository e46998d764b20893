//! Checks between the values of a bearing.

use crate::bearing::kind::BearingType;
use crate::bearing::kind::Fidelity;
use crate::bearing::moment::{AccelerationLoss, Moment, RatedBearing};
use crate::bearing::{Bearing, Traction};
use crate::checks::{Check, Context};
use catalogue::designation::PAIRS;
use catalogue::geometry::{Geometry, millimetres, rating_beyond_balls};
use physics::lubricant::LubricantError;
use physics::traction::FourParameterTraction;
use problem::Code;

/// How far D may be from -A: the sum of two decimals of four digits.
const NO_TRACTION_AT_REST: f64 = 1e-9;

/// Tightest internal clearance, as a share of the ball diameter: beyond, the balls are pressed past any elastic law.
const MOST_PRELOAD: f64 = -0.01;
/// Widest internal clearance, as a share of the ball diameter.
const MOST_CLEARANCE: f64 = 0.1;

/// Balls that hold a race from all sides.
const FEWEST_BALLS: usize = 3;

impl Context<'_> {
    /// Two rows share their loads by an angle of load and a tilt that no ring of balls in the plane has.
    pub fn one_row(&self, bearing: &Bearing) -> Check {
        if bearing.kind != BearingType::AngularContactDoubleRow {
            return Ok(());
        }
        let path = "bearing.type";
        let found = format!(
            "{}, which would be computed as a single row",
            self.text(path)
        );
        self.refuse(Code::NotModelled, path, found, PAIRS)
    }

    /// Everything about a bearing that moves; the bore is that of the key named, the load whether any presses on it.
    pub fn bearing(&self, bearing: &Bearing, bore: Option<(&str, f64)>, loaded: bool) -> Check {
        let (ball, pitch) = (bearing.ball_diameter, bearing.pitch_diameter);
        self.spatial(bearing)?;
        self.geometry(bearing.ball_count, ball, pitch)?;
        self.bore(bore, pitch - ball)?;
        self.enough_balls(bearing, loaded)?;
        self.fits(bearing)?;
        self.internal_clearance(bearing)?;
        self.separation(bearing)?;
        self.contact_angle(bearing)?;
        self.traction(bearing.traction)?;
        self.moment(&bearing.moment, &bearing.rated())?;
        self.drag(bearing)?;
        self.lubricant_state(bearing)?;
        self.static_rating()?;
        self.acceleration_loss(&bearing.acceleration_loss)
    }

    /// Diameters, width and balls go together, also with what the catalogue knows of the bearing named.
    pub fn geometry(&self, count: usize, ball: f64, pitch: f64) -> Check {
        let path = |key: &str| match key {
            "bore_diameter" => "bearing.moment.bore_diameter",
            "outer_diameter" => "bearing.moment.outer_diameter",
            "pitch_diameter" => "bearing.pitch_diameter",
            "ball_diameter" => "bearing.ball_diameter",
            "ball_count" => "bearing.ball_count",
            _ => "bearing.name",
        };
        let ring = |key: &str| {
            let given = self.values.number(path(key));
            given.or_else(|| self.values.dimension(key))
        };
        let geometry = Geometry {
            bore: ring("bore_diameter"),
            outside: ring("outer_diameter"),
            width: self.values.dimension("width"),
            pitch: Some(pitch),
            ball: Some(ball),
            count: Some(count as f64),
        };
        let text = |key: &str| {
            let written = self.values.text(path(key)).filter(|_| key != "width");
            let known = || self.values.dimension(key).map(millimetres);
            written.or_else(known).unwrap_or_default()
        };
        let Some(mut found) = geometry.contradiction(&text) else {
            return Ok(());
        };
        let paths: Vec<&str> = (found.blames.iter()).map(|blame| path(blame.key)).collect();
        let blamed = self.blamed(&paths);
        let position = paths.iter().position(|path| *path == blamed);
        let blame = found.blames.swap_remove(position.unwrap_or(0));
        let problem = self.problem(found.code, blamed, blame.found, blame.allowed);
        let named = self.values.text("bearing.name");
        Err(problem.with_hint(named.map(|name| {
            format!("The dimensions that are not given are those of bearing.name = \"{name}\"")
        })))
    }

    /// A given rating that such balls cannot have; that of the bearing named is told apart from given balls by a note.
    pub fn static_rating(&self) -> Check {
        let path = "bearing.static_load_rating";
        let given = self.values.is_own(path).then(|| self.values.number(path));
        let known = given.flatten().zip(self.values.area_of_balls());
        let allowed = known.and_then(|(rating, area)| rating_beyond_balls(rating, area));
        let Some(allowed) = allowed else {
            return Ok(());
        };
        let found = format!(
            "{} with {} balls of {}",
            self.text(path),
            self.text("bearing.ball_count"),
            self.text("bearing.ball_diameter")
        );
        let code = Code::RatingContradictsBalls;
        self.refuse(code, path, found, allowed)
    }

    /// The rotor's side of the inner race, which a sleeve may narrow.
    fn bore(&self, bore: Option<(&str, f64)>, track: f64) -> Check {
        match bore {
            Some((path, bore)) if bore >= track => self.refuse_value(
                Code::BearingGeometry,
                path,
                format!(
                    "less than the track of the inner race is needed: pitch_diameter - ball_diameter = {}",
                    millimetres(track)
                ),
            ),
            _ => Ok(()),
        }
    }

    /// Between two balls there is half a turn without a ball, through which a loaded inner race falls.
    fn enough_balls(&self, bearing: &Bearing, loaded: bool) -> Check {
        if bearing.ball_count >= FEWEST_BALLS || bearing.inner_race_centre_held || !loaded {
            return Ok(());
        }
        let path = "bearing.ball_count";
        self.refuse_value(
            Code::Impossible,
            path,
            format!(
                "at least {FEWEST_BALLS} balls are needed under a radial load: beside fewer the inner race falls out of the bearing. bearing.inner_race_centre_held = true would hold it"
            ),
        )
    }

    /// Fits and clearances are micrometres: a value of the ball's own size is a slip of the unit.
    fn internal_clearance(&self, bearing: &Bearing) -> Check {
        let share = bearing.operating_diametral_clearance / bearing.ball_diameter;
        if (MOST_PRELOAD..=MOST_CLEARANCE).contains(&share) {
            return Ok(());
        }
        let given = "bearing.operating_diametral_clearance";
        let fits = [
            "bearing.fits.shaft_interference",
            "bearing.fits.housing_interference",
            "bearing.unmounted_diametral_clearance",
        ];
        let (path, found) = match bearing.unmounted_diametral_clearance {
            None => (given, self.text(given)),
            Some(_) => {
                let path = self.blamed(&fits);
                let left = millimetres(bearing.operating_diametral_clearance);
                (path, format!("{}: fits leave {left}", self.text(path)))
            }
        };
        Err(self
            .problem(
                Code::ClearanceTooLarge,
                path,
                found,
                format!(
                    "between {} and {} is needed, {:.0} % to {:.0} % of the ball diameter",
                    millimetres(MOST_PRELOAD * bearing.ball_diameter),
                    millimetres(MOST_CLEARANCE * bearing.ball_diameter),
                    100.0 * MOST_PRELOAD,
                    100.0 * MOST_CLEARANCE
                ),
            )
            .with_hint(Some(
                "bearing clearances are a few um, and diametral".to_string(),
            )))
    }

    fn traction(&self, traction: Traction) -> Check {
        match traction {
            Traction::FourParameter { a, d, .. } if (a + d).abs() > NO_TRACTION_AT_REST => self
                .refuse(
                    Code::Conflict,
                    "bearing.traction.d",
                    units::number_text(d),
                    format!(
                        "d = -a = {} is needed, so that there is no traction without slip",
                        units::number_text(-a)
                    ),
                ),
            Traction::FourParameter { a, b, c, d } => {
                let smallest = FourParameterTraction { a, b, c, d }.smallest();
                if smallest >= -NO_TRACTION_AT_REST {
                    return Ok(());
                }
                self.refuse(
                    Code::Conflict,
                    "bearing.traction.law",
                    format!(
                        "four parameters whose coefficient falls to {smallest:.3e} at some slip, which would make energy"
                    ),
                    "a coefficient that is nowhere negative is needed: d >= 0, and b not below c·d",
                )
            }
            Traction::Lubricant(film) => match film.oil.at(film.temperature, film.conductivity) {
                Ok(_) => Ok(()),
                Err(error @ LubricantError::Temperature { .. }) => self.refuse_value(
                    Code::NoLawData,
                    "bearing.traction.oil_temperature",
                    error.to_string(),
                ),
                Err(error) => self.refuse(
                    Code::MissingKey,
                    "bearing.traction.oil_conductivity",
                    "no value",
                    error.to_string(),
                ),
            },
            Traction::Tanh { .. } | Traction::Dry { .. } => Ok(()),
        }
    }

    /// A law that there is no data for, or that the balls cannot share.
    pub fn moment(&self, moment: &Moment, bearing: &RatedBearing) -> Check {
        let needs_rating = matches!(moment, Moment::Palmgren { .. });
        if needs_rating && bearing.static_load_rating.is_none() {
            return self.refuse(
                Code::MissingKey,
                "bearing.static_load_rating",
                "no value",
                format!(
                    "bearing.moment.law = \"{}\" needs it, e.g. \"6.55 kN\"",
                    self.text("bearing.moment.law")
                ),
            );
        }
        if let Moment::Measured { curve } = moment
            && let Some(row) = curve.iter().position(|row| row[1] < 0.0)
        {
            return self.refuse(
                Code::CreatesEnergy,
                "bearing.moment.curve",
                format!(
                    "a moment below 0 in row {}, which would create energy",
                    row + 1
                ),
                "moments not below 0 are needed: the curve holds for both directions",
            );
        }
        let Err(why) = moment.law(bearing) else {
            return Ok(());
        };
        let path = match moment {
            Moment::Palmgren { axial_load, .. } if *axial_load != 0.0 => {
                self.blamed(&["bearing.moment.contact_angle", "bearing.moment.axial_load"])
            }
            _ => "bearing.moment.law",
        };
        self.refuse(
            Code::NoLawData,
            path,
            why,
            "another law is needed, or a bearing that this one has constants for",
        )
    }

    /// Balls that share the moment of a real lubricant are not dragged to the ground as well.
    fn drag(&self, bearing: &Bearing) -> Check {
        let drags = [
            ("bearing.drag.orbit", bearing.drag.orbit),
            ("bearing.drag.spin", bearing.drag.spin),
            ("bearing.drag.cage", bearing.drag.cage),
        ];
        let shared = bearing.fidelity != Fidelity::Rolling && bearing.moment != Moment::None;
        match drags.into_iter().find(|(_, drag)| shared && *drag != 0.0) {
            Some((path, _)) => self.refuse_value(
                Code::Conflict,
                path,
                format!(
                    "no drag to the ground is possible together with bearing.moment.law = \"{}\", which holds it already",
                    self.text("bearing.moment.law")
                ),
            ),
            None => Ok(()),
        }
    }

    /// F must take energy out whatever the race does.
    pub fn acceleration_loss(&self, loss: &AccelerationLoss) -> Check {
        let below = |rows: &[[f64; 2]]| rows.iter().position(|row| row[1] < 0.0);
        let (path, row) = match loss {
            AccelerationLoss::None => return Ok(()),
            AccelerationLoss::Constant { force } => ("force", (*force < 0.0).then_some(0)),
            AccelerationLoss::Proportional { per_acceleration } => {
                ("per_acceleration", (*per_acceleration < 0.0).then_some(0))
            }
            AccelerationLoss::OverSpeed { force_over_speed } => {
                ("force_over_speed", below(force_over_speed))
            }
            AccelerationLoss::Affine {
                force_over_speed,
                per_acceleration_over_speed,
            } => match below(force_over_speed) {
                Some(row) => ("force_over_speed", Some(row)),
                None => (
                    "per_acceleration_over_speed",
                    below(per_acceleration_over_speed),
                ),
            },
        };
        let Some(row) = row else {
            return Ok(());
        };
        let path = format!("bearing.acceleration_loss.{path}");
        let found = if path.ends_with("_over_speed") {
            format!(
                "a value below 0 in row {}, which would create energy",
                row + 1
            )
        } else {
            format!("{}, which would create energy", self.text(&path))
        };
        self.refuse(
            Code::CreatesEnergy,
            &path,
            found,
            "a value not below 0 is needed: F has the sign of the rotation, and resists it while the race speeds up and while it slows down",
        )
    }
}
