//! How the rings of a bearing sit: what fits take from its clearance, and how its inner race grows with its speed.

use crate::checks::Check;
use crate::values::{Value, Values};
use physics::materials::BEARING_STEEL;
use physics::ring::{PressFit, outside_growth};
use problem::Code;
use problem::words;

pub(crate) const UNMOUNTED: &str = "bearing.unmounted_diametral_clearance";
pub(crate) const OPERATING: &str = "bearing.operating_diametral_clearance";
pub(crate) const BORE: &str = "bearing.fits.bore_diameter";
pub(crate) const OUTSIDE: &str = "bearing.fits.outer_diameter";
pub(crate) const HOUSING: &str = "bearing.fits.housing_outer_diameter";
pub(crate) const SHAFT_FIT: &str = "bearing.fits.shaft_interference";
pub(crate) const HOUSING_FIT: &str = "bearing.fits.housing_interference";
pub(crate) const SHAFT_BORE: &str = "bearing.fits.shaft_bore_diameter";
pub(crate) const GROWTH: &str = "bearing.inner_race_growth";

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

words! {
/// How the inner race grows with its speed.
pub enum Growth {
    /// Not at all.
    None = "none",
    /// As a ring by itself.
    FreeRing = "free ring",
    /// Together with the shaft it is pressed on.
    WithShaft = "with shaft",
}
}

impl Growth {
    /// Growth of the radius of an inner track with the square of its speed, m s²: of a ring of this bore on a shaft of that bore, diameters in m.
    pub fn of_track(self, track: f64, ring_bore: f64, shaft_bore: f64) -> f64 {
        let from = |inside: f64| outside_growth(BEARING_STEEL, 0.5 * inside, 0.5 * track);
        match self {
            Growth::None => 0.0,
            Growth::FreeRing => from(ring_bore),
            Growth::WithShaft => from(shaft_bore),
        }
    }
}

impl Fits {
    pub(crate) fn from_values(values: &Values) -> Self {
        let fits = values.section("bearing.fits");
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
    pub fn on_shaft(&self, track: f64) -> Option<PressFit> {
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
    pub fn in_housing(&self, track: f64) -> Option<PressFit> {
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

impl Values {
    /// The clearance that fits leave.
    pub fn clearance_by_fits(&mut self) -> Check {
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
        Err(self.problem(
            Code::MissingKey,
            path,
            self.place(fit),
            "no value",
            format!("{fit} needs it, to know how far the ring is pressed"),
        ))
    }
}
