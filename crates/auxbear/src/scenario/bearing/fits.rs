//! How the rings of a bearing sit: what fits take from its clearance, and how its inner race grows with its speed.

use crate::problem::Code;
use crate::scenario::bearing::Bearing;
use crate::scenario::checks::{Check, Context};
use crate::scenario::resolve::{Value, Values};
use crate::scenario::section::Section;
use physics::materials::BEARING_STEEL;
use physics::ring::{PressFit, outside_growth};

const UNMOUNTED: &str = "bearing.unmounted_diametral_clearance";
const OPERATING: &str = "bearing.operating_diametral_clearance";
const BORE: &str = "bearing.fits.bore_diameter";
const OUTSIDE: &str = "bearing.fits.outer_diameter";
const HOUSING: &str = "bearing.fits.housing_outer_diameter";
const SHAFT_FIT: &str = "bearing.fits.shaft_interference";
const HOUSING_FIT: &str = "bearing.fits.housing_interference";
const SHAFT_BORE: &str = "bearing.fits.shaft_bore_diameter";
const GROWTH: &str = "bearing.inner_race_growth";

/// How the rings sit on shaft and in housing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fits {
    /// Bore of the inner ring, m, where it is known.
    pub bore_diameter: Option<f64>,
    /// Diametral interference of the shaft, m.
    pub shaft_interference: f64,
    /// Bore of the shaft, m.
    pub shaft_bore_diameter: f64,
    /// Outside diameter of the outer ring, m, where it is known.
    pub outer_diameter: Option<f64>,
    /// Diametral interference in the housing, m.
    pub housing_interference: f64,
    /// Outside diameter of the housing, m, where it is known.
    pub housing_outer_diameter: Option<f64>,
}

/// How the inner race grows with its speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// Not at all.
    None,
    /// As a ring by itself.
    FreeRing,
    /// Together with the shaft it is pressed on.
    WithShaft,
}

impl Fits {
    pub(crate) fn from_values(values: &Values) -> Self {
        let fits = Section {
            values,
            path: "bearing.fits",
        };
        Fits {
            bore_diameter: fits.maybe("bore_diameter"),
            shaft_interference: fits.number("shaft_interference"),
            shaft_bore_diameter: fits.number("shaft_bore_diameter"),
            outer_diameter: fits.maybe("outer_diameter"),
            housing_interference: fits.number("housing_interference"),
            housing_outer_diameter: fits.maybe("housing_outer_diameter"),
        }
    }

    /// The inner ring on its shaft; `track` is the diameter of its track, m.
    fn on_shaft(&self, track: f64) -> Option<PressFit> {
        let joint = self.bore_diameter?;
        Some(PressFit {
            inner_material: BEARING_STEEL,
            outer_material: BEARING_STEEL,
            bore_radius: 0.5 * self.shaft_bore_diameter,
            joint_radius: 0.5 * joint,
            outside_radius: 0.5 * track,
            interference: self.shaft_interference,
        })
    }

    /// The outer ring in its housing; `track` is the diameter of its track, m.
    fn in_housing(&self, track: f64) -> Option<PressFit> {
        let (joint, outside) = self.outer_diameter.zip(self.housing_outer_diameter)?;
        Some(PressFit {
            inner_material: BEARING_STEEL,
            outer_material: BEARING_STEEL,
            bore_radius: 0.5 * track,
            joint_radius: 0.5 * joint,
            outside_radius: 0.5 * outside,
            interference: self.housing_interference,
        })
    }
}

impl Growth {
    pub(crate) fn of(word: &str) -> Self {
        match word {
            "free ring" => Growth::FreeRing,
            "with shaft" => Growth::WithShaft,
            _ => Growth::None,
        }
    }
}

impl Bearing {
    /// Growth of the inner track's radius with the square of its speed, m s².
    pub fn inner_track_growth(&self) -> f64 {
        let Some(fit) = self.fits.on_shaft(self.pitch_diameter - self.ball_diameter) else {
            return 0.0;
        };
        let from = |inside: f64| outside_growth(BEARING_STEEL, inside, fit.outside_radius);
        match self.inner_race_growth {
            Growth::None => 0.0,
            Growth::FreeRing => from(fit.joint_radius),
            Growth::WithShaft => from(fit.bore_radius),
        }
    }

    /// Speed at which an inner ring that is said to grow with its shaft leaves it, rad/s, where that is below a speed.
    pub fn lifts_off_below(&self, speed: f64) -> Option<f64> {
        if self.inner_race_growth != Growth::WithShaft {
            return None;
        }
        let fit = self
            .fits
            .on_shaft(self.pitch_diameter - self.ball_diameter)?;
        Some(fit.lift_off_speed()).filter(|lift_off| *lift_off < speed)
    }
}

impl Values {
    /// The clearance that fits leave.
    pub(crate) fn clearance_by_fits(&mut self) -> Check {
        let (Some(unmounted), Some(pitch), Some(ball)) = (
            self.number(UNMOUNTED),
            self.number("bearing.pitch_diameter"),
            self.number("bearing.ball_diameter"),
        ) else {
            return Ok(());
        };
        self.seats_are_known()?;
        let fits = Fits::from_values(self);
        let by_shaft = fits
            .on_shaft(pitch - ball)
            .map_or(0.0, |fit| 2.0 * fit.outside_growth());
        let by_housing = fits
            .in_housing(pitch + ball)
            .map_or(0.0, |fit| 2.0 * fit.bore_shrinking());
        let how = format!(
            "unmounted_diametral_clearance less {:.2} um by the shaft and {:.2} um by the housing: thick rings (Lamé)",
            1e6 * by_shaft,
            1e6 * by_housing
        );
        let operating = unmounted - by_shaft - by_housing;
        self.put_derived(OPERATING, Value::Number(operating), &how)
    }

    /// Refuses a fit whose rings are not known.
    fn seats_are_known(&self) -> Check {
        let pressed = |path: &str| self.number(path).is_some_and(|fit| fit > 0.0);
        let missing = [
            (SHAFT_FIT, &[BORE][..]),
            (HOUSING_FIT, &[OUTSIDE, HOUSING][..]),
        ]
        .into_iter()
        .filter(|(fit, _)| pressed(fit))
        .find_map(|(fit, needed)| {
            let path = needed.iter().find(|path| self.number(path).is_none())?;
            Some((fit, *path))
        });
        let Some((fit, path)) = missing else {
            return Ok(());
        };
        Err(Box::new(self.problem(
            Code::MissingKey,
            path,
            self.place(fit),
            "no value",
            format!("{fit} needs it, to tell how far the ring is pressed"),
        )))
    }
}

impl Context<'_> {
    /// Seats that hold each other, and fits that change what they are given for.
    pub(crate) fn fits(&self, bearing: &Bearing) -> Check {
        let (pitch, ball) = (bearing.pitch_diameter, bearing.ball_diameter);
        let shaft = bearing.fits.on_shaft(pitch - ball);
        if bearing.inner_race_growth != Growth::None && shaft.is_none() {
            return Err(Box::new(self.problem(
                Code::MissingKey,
                BORE,
                "no value".to_string(),
                format!(
                    "{GROWTH} = \"{}\" needs it: a ring from its bore to its track grows",
                    self.text(GROWTH)
                ),
            )));
        }
        if let Some(fit) = shaft {
            self.nested(
                BORE,
                fit.joint_radius < fit.outside_radius,
                "less than the track of the inner race is needed: pitch_diameter - ball_diameter",
            )?;
            self.nested(
                SHAFT_BORE,
                fit.bore_radius < fit.joint_radius,
                "less than bearing.fits.bore_diameter is needed",
            )?;
        }
        if let Some(fit) = bearing.fits.in_housing(pitch + ball) {
            self.nested(
                OUTSIDE,
                fit.bore_radius < fit.joint_radius,
                "more than the track of the outer race is needed: pitch_diameter + ball_diameter",
            )?;
            self.nested(
                HOUSING,
                fit.joint_radius < fit.outside_radius,
                "more than bearing.fits.outer_diameter is needed",
            )?;
        }
        if bearing.inner_race_growth == Growth::FreeRing && bearing.fits.shaft_interference > 0.0 {
            return Err(Box::new(self.problem(
                Code::Conflict,
                GROWTH,
                format!(
                    "\"free ring\" beside {SHAFT_FIT} = {}",
                    self.text(SHAFT_FIT)
                ),
                "\"with shaft\" is needed while a fit presses the ring".to_string(),
            )));
        }
        self.fits_have_an_effect(bearing)
    }

    fn nested(&self, path: &str, holds: bool, allowed: &str) -> Check {
        if holds {
            return Ok(());
        }
        let allowed = allowed.to_string();
        Err(Box::new(self.problem(
            Code::BearingGeometry,
            path,
            self.text(path),
            allowed,
        )))
    }

    fn fits_have_an_effect(&self, bearing: &Bearing) -> Check {
        if bearing.unmounted_diametral_clearance.is_some() {
            return Ok(());
        }
        let holds_the_shaft = bearing.inner_race_growth == Growth::WithShaft;
        let idle = [
            (
                SHAFT_FIT,
                bearing.fits.shaft_interference != 0.0 && !holds_the_shaft,
            ),
            (HOUSING_FIT, bearing.fits.housing_interference != 0.0),
        ];
        let Some((path, _)) = idle.into_iter().find(|(_, idle)| *idle) else {
            return Ok(());
        };
        Err(Box::new(self.problem(
            Code::UnusedKey,
            path,
            format!("{}, which has no effect", self.text(path)),
            format!("{UNMOUNTED} is needed with it: {OPERATING} is what fits have left already"),
        )))
    }
}
