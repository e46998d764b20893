//! Constants of the SKF friction model by bearing type and series, and what is refused for want of them.
//!
//! | type | series |
//! |---|---|
//! | deep groove | 2, 3, 42, 43, 60, 630, 62, 622, 63, 623, 64, 160, 161, 617, 618, 628, 637, 638, 619, 639 |
//! | angular contact, single row of 40°, double row of 30°; four-point contact of 35° | all |
//! | spherical roller | 213 E, 222 E, 222, 223, 223 E, 230, 231, 232, 238, 239, 240, 241, 248, 249 |
//!
//! Refused: every other type, ceramic balls outside angular contact bearings, seals outside the table.
//! The variable V_M of the drag in an oil bath stands in a diagram of the source and is the user's to read.
//! Spindle bearings of 15° to 25° have no constants here: the load factors hold the contact angle of their type.
//!
//! All of it after the SKF General Catalogue (edition 6000, 2006), chapter Friction, pp. 88-105.

use crate::skf::{SkfAngularContact, SkfContacts, SkfDeepGroove, SkfMoment, SkfSphericalRoller};
use std::fmt;

/// Bearing types as the model distinguishes them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SkfType {
    /// Deep groove ball bearing.
    DeepGroove,
    /// Angular contact ball bearing, single row.
    AngularContactSingleRow,
    /// Angular contact ball bearing, double row.
    AngularContactDoubleRow,
    /// Four-point contact ball bearing.
    FourPointContact,
    /// Spherical roller bearing.
    SphericalRoller,
    /// Self-aligning ball bearing.
    SelfAligningBall,
    /// Cylindrical roller bearing.
    CylindricalRoller,
    /// Tapered roller bearing.
    TaperedRoller,
}

/// How the lubricant reaches the contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SkfSupply {
    /// Oil bath above the centre of the lowest rolling element: no starvation.
    OilBath,
    /// Oil bath below that centre, or oil jet.
    LowOilBathOrJet,
    /// Grease, or oil and air.
    GreaseOrOilAir,
}

/// Kind of oil, for the sliding friction of a full film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SkfOil {
    /// Mineral oil, μ_EHL 0.05.
    Mineral,
    /// Synthetic oil, μ_EHL 0.04.
    Synthetic,
    /// Transmission fluid, μ_EHL 0.1.
    Transmission,
}

/// A bearing as the model needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkfBearing<'a> {
    /// Type.
    pub kind: SkfType,
    /// Series as the tables write it, such as "60"; no effect for angular contact and four-point contact.
    pub series: &'a str,
    /// Bore d, m.
    pub bore: f64,
    /// Outer diameter D, m.
    pub outer_diameter: f64,
    /// Width B of the inner ring, m; for rollers in an oil bath.
    pub width: f64,
    /// Static load rating C0, N; deep groove bearings need it.
    pub static_load_rating: Option<f64>,
    /// Ceramic balls between steel rings.
    pub ceramic_balls: bool,
}

/// The lubricant in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkfLubricant {
    /// Kinematic viscosity at the running temperature ν, m²/s; of the base oil for grease.
    pub viscosity: f64,
    /// Supply.
    pub supply: SkfSupply,
    /// Oil.
    pub oil: SkfOil,
    /// V_M, read from diagram 2 of the source; 0 without an oil bath.
    pub drag_variable: f64,
    /// Moment of the seals, N m; 0 without. Of contact seals table 4, p. 96, of the source has it.
    pub seal_moment: f64,
}

impl fmt::Display for SkfType {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            SkfType::DeepGroove => "deep groove ball bearing",
            SkfType::AngularContactSingleRow => "single row angular contact ball bearing",
            SkfType::AngularContactDoubleRow => "double row angular contact ball bearing",
            SkfType::FourPointContact => "four-point contact ball bearing",
            SkfType::SphericalRoller => "spherical roller bearing",
            SkfType::SelfAligningBall => "self-aligning ball bearing",
            SkfType::CylindricalRoller => "cylindrical roller bearing",
            SkfType::TaperedRoller => "tapered roller bearing",
        })
    }
}

/// Series; R1, R2, S1, S2: table 3a, p. 93.
#[rustfmt::skip]
const DEEP_GROOVE: [(&[&str], [f64; 4]); 9] = [
    (&["2", "3"],                                [4.4e-7, 1.7,  2.00e-3, 100.0]),
    (&["42", "43"],                              [5.4e-7, 0.96, 3.00e-3, 40.0]),
    (&["60", "630"],                             [4.1e-7, 1.7,  3.73e-3, 14.6]),
    (&["62", "622"],                             [3.9e-7, 1.7,  3.23e-3, 36.5]),
    (&["63", "623"],                             [3.7e-7, 1.7,  2.84e-3, 92.8]),
    (&["64"],                                    [3.6e-7, 1.7,  2.43e-3, 198.0]),
    (&["160", "161"],                            [4.3e-7, 1.7,  4.63e-3, 4.25]),
    (&["617", "618", "628", "637", "638"],       [4.7e-7, 1.7,  6.50e-3, 0.78]),
    (&["619", "639"],                            [4.3e-7, 1.7,  4.75e-3, 3.6]),
];

/// R1, R2, R3, S1, S2, S3: table 3, p. 92.
const ANGULAR_CONTACT_SINGLE_ROW: [f64; 6] = [5.03e-7, 1.97, 1.90e-12, 1.30e-2, 0.68, 1.91e-12];
const ANGULAR_CONTACT_DOUBLE_ROW: [f64; 6] = [6.34e-7, 1.41, 7.83e-13, 7.56e-3, 1.21, 7.83e-13];
const FOUR_POINT_CONTACT: [f64; 6] = [4.78e-7, 2.42, 1.40e-12, 1.20e-2, 0.9, 1.40e-12];

/// Share of R3 and S3 that stays with ceramic balls: p. 102.
const CERAMIC_SHARE: f64 = 0.41;

/// Series; R1, R2, R3, R4, S1, S2, S3, S4: table 3e, p. 94.
#[rustfmt::skip]
const SPHERICAL_ROLLER: [(&str, [f64; 8]); 14] = [
    ("213 E", [1.6e-6, 5.84, 2.81e-6, 5.8,  3.62e-3, 508.0,  8.8e-3, 117.0]),
    ("222 E", [1.6e-6, 5.84, 2.81e-6, 5.8,  3.62e-3, 508.0,  8.8e-3, 117.0]),
    ("222",   [2.0e-6, 5.54, 2.92e-6, 5.5,  5.10e-3, 414.0,  9.7e-3, 100.0]),
    ("223",   [1.7e-6, 4.1,  3.13e-6, 4.05, 6.92e-3, 124.0,  1.7e-2, 41.0]),
    ("223 E", [1.6e-6, 4.1,  3.14e-6, 4.05, 6.23e-3, 124.0,  1.7e-2, 41.0]),
    ("230",   [2.4e-6, 6.44, 3.76e-6, 6.4,  4.13e-3, 755.0,  1.1e-2, 160.0]),
    ("231",   [2.4e-6, 4.7,  4.04e-6, 4.72, 6.70e-3, 231.0,  1.7e-2, 65.0]),
    ("232",   [2.3e-6, 4.1,  4.00e-6, 4.05, 8.66e-3, 126.0,  2.1e-2, 41.0]),
    ("238",   [3.1e-6, 12.1, 3.82e-6, 12.0, 1.74e-3, 9495.0, 5.9e-3, 1057.0]),
    ("239",   [2.7e-6, 8.53, 3.87e-6, 8.47, 2.77e-3, 2330.0, 8.5e-3, 371.0]),
    ("240",   [2.9e-6, 4.87, 4.78e-6, 4.84, 6.95e-3, 240.0,  2.1e-2, 68.0]),
    ("241",   [2.6e-6, 3.8,  4.79e-6, 3.7,  1.00e-2, 86.7,   2.9e-2, 31.0]),
    ("248",   [3.8e-6, 9.4,  5.09e-6, 9.3,  2.80e-3, 3415.0, 1.2e-2, 486.0]),
    ("249",   [3.0e-6, 6.67, 5.09e-6, 6.62, 3.90e-3, 887.0,  1.7e-2, 180.0]),
];

/// Sliding friction of boundary lubrication μ_bl: p. 101.
const BOUNDARY_FRICTION: f64 = 0.15;

/// K_L of spherical roller bearings: table 5, p. 98.
const SPHERICAL_ROLLER_DRAG: f64 = 0.8;

impl SkfBearing<'_> {
    /// The friction moment of this bearing with this lubricant.
    ///
    /// Formula: the constants of [`SkfMoment`]
    ///
    /// - `lubricant`: viscosity, supply, kind of oil, drag, seals
    ///
    /// Source: SKF General Catalogue (edition 6000), tables 3, 3a, 3e, 5 and pp. 97-102.
    /// Valid: the types and series of this module's page; else an error says why.
    pub fn moment(&self, lubricant: &SkfLubricant) -> Result<SkfMoment<f64>, String> {
        let contacts = self.contacts()?;
        let geometry = self.geometry_factor()?;
        positive("bore", self.bore)?;
        positive("outer diameter", self.outer_diameter)?;
        positive("outer diameter less bore", self.outer_diameter - self.bore)?;
        positive("viscosity", lubricant.viscosity)?;
        not_negative("drag variable V_M", lubricant.drag_variable)?;
        not_negative("seal moment", lubricant.seal_moment)?;
        let mean_diameter = 0.5 * (self.bore + self.outer_diameter);
        let (bore_mm, outer_mm) = (1e3 * self.bore, 1e3 * self.outer_diameter);
        Ok(SkfMoment {
            contacts,
            mean_diameter,
            viscosity: lubricant.viscosity,
            starvation: lubricant.supply.starvation_constant()
                * (bore_mm + outer_mm)
                * (geometry / (2.0 * (outer_mm - bore_mm))).sqrt(),
            boundary_friction: BOUNDARY_FRICTION,
            film_friction: lubricant.oil.film_friction(),
            drag: self.drag(lubricant, geometry)?,
            seal_moment: lubricant.seal_moment,
        })
    }

    /// The load factors of the type and series.
    fn contacts(&self) -> Result<SkfContacts<f64>, String> {
        let kind = self.kind;
        let unknown = || {
            let known = match kind {
                SkfType::SphericalRoller => SPHERICAL_ROLLER.map(|row| row.0).join(", "),
                _ => DEEP_GROOVE.map(|row| row.0.join(", ")).join(", "),
            };
            let series = self.series;
            format!(
                "SKF model: no constants for series \"{series}\" of a {kind}; known are {known}"
            )
        };
        if self.ceramic_balls
            && !matches!(
                kind,
                SkfType::AngularContactSingleRow | SkfType::AngularContactDoubleRow
            )
        {
            return Err(format!(
                "SKF model: no factor for ceramic balls in a {kind}; the source has one for angular contact ball bearings only"
            ));
        }
        match kind {
            SkfType::DeepGroove => {
                let static_load_rating = self
                    .static_load_rating
                    .ok_or("SKF model: a deep groove bearing needs its static load rating C0: the contact angle under axial load depends on it")?;
                positive("static load rating", static_load_rating)?;
                let row = DEEP_GROOVE
                    .iter()
                    .find(|row| row.0.contains(&self.series))
                    .ok_or_else(unknown)?;
                let [r1, r2, s1, s2] = row.1;
                Ok(SkfContacts::DeepGroove(SkfDeepGroove {
                    r1,
                    r2,
                    s1,
                    s2,
                    static_load_rating,
                }))
            }
            SkfType::AngularContactSingleRow => Ok(self.angular(ANGULAR_CONTACT_SINGLE_ROW)),
            SkfType::AngularContactDoubleRow => Ok(self.angular(ANGULAR_CONTACT_DOUBLE_ROW)),
            SkfType::FourPointContact => Ok(self.angular(FOUR_POINT_CONTACT)),
            SkfType::SphericalRoller => {
                let row = SPHERICAL_ROLLER
                    .iter()
                    .find(|row| row.0 == self.series)
                    .ok_or_else(unknown)?;
                let [r1, r2, r3, r4, s1, s2, s3, s4] = row.1;
                Ok(SkfContacts::SphericalRoller(SkfSphericalRoller {
                    r1,
                    r2,
                    r3,
                    r4,
                    s1,
                    s2,
                    s3,
                    s4,
                }))
            }
            _ => Err(without_constants(kind)),
        }
    }

    fn angular(&self, [r1, r2, r3, s1, s2, s3]: [f64; 6]) -> SkfContacts<f64> {
        let share = if self.ceramic_balls {
            CERAMIC_SHARE
        } else {
            1.0
        };
        SkfContacts::AngularContact(SkfAngularContact {
            r1,
            r2,
            r3: share * r3,
            s1,
            s2,
            s3: share * s3,
        })
    }

    /// K_z: table 5, p. 98.
    fn geometry_factor(&self) -> Result<f64, String> {
        match self.kind {
            SkfType::DeepGroove | SkfType::AngularContactDoubleRow | SkfType::FourPointContact => {
                Ok(3.1)
            }
            SkfType::AngularContactSingleRow => Ok(4.4),
            SkfType::SphericalRoller => Ok(5.5),
            kind => Err(without_constants(kind)),
        }
    }

    /// M_drag/n², N mm/rpm²: V_M K_ball d_m⁵ or 10 V_M K_roll B d_m⁴, p. 99.
    fn drag(&self, lubricant: &SkfLubricant, geometry: f64) -> Result<f64, String> {
        let variable = lubricant.drag_variable;
        if variable == 0.0 {
            return Ok(0.0);
        }
        if lubricant.supply == SkfSupply::GreaseOrOilAir {
            return Err(
                "SKF model: a drag variable V_M belongs to an oil bath or jet, not to grease or oil and air".to_string(),
            );
        }
        let factor = geometry * (self.bore + self.outer_diameter)
            / (self.outer_diameter - self.bore)
            * 1e-12;
        let mean_mm = 500.0 * (self.bore + self.outer_diameter);
        if self.kind == SkfType::SphericalRoller {
            positive("width", self.width)?;
            let width_mm = 1e3 * self.width;
            Ok(10.0 * variable * SPHERICAL_ROLLER_DRAG * factor * width_mm * mean_mm.powi(4))
        } else {
            Ok(variable * self.rows() * factor * mean_mm.powi(5))
        }
    }

    /// Rows of balls.
    fn rows(&self) -> f64 {
        let double_row_groove =
            self.kind == SkfType::DeepGroove && matches!(self.series, "42" | "43");
        if double_row_groove || self.kind == SkfType::AngularContactDoubleRow {
            2.0
        } else {
            1.0
        }
    }
}

impl SkfType {
    /// Least and largest contact angle of the bearings that the constants are for, degrees; none where they do not hold one.
    ///
    /// Source: the catalogue's chapters of the types (40°, 30° and 35°, from memory), 5° either way.
    /// Valid: the bearings of that catalogue.
    pub fn angles_deg(self) -> Option<[f64; 2]> {
        match self {
            SkfType::AngularContactSingleRow => Some([35.0, 45.0]),
            SkfType::AngularContactDoubleRow => Some([25.0, 35.0]),
            SkfType::FourPointContact => Some([30.0, 40.0]),
            _ => None,
        }
    }
}

impl SkfSupply {
    /// K_rs: p. 98.
    fn starvation_constant(self) -> f64 {
        match self {
            SkfSupply::OilBath => 0.0,
            SkfSupply::LowOilBathOrJet => 3e-8,
            SkfSupply::GreaseOrOilAir => 6e-8,
        }
    }
}

impl SkfOil {
    /// μ_EHL: p. 90.
    fn film_friction(self) -> f64 {
        match self {
            SkfOil::Mineral => 0.05,
            SkfOil::Synthetic => 0.04,
            SkfOil::Transmission => 0.1,
        }
    }
}

fn without_constants(kind: SkfType) -> String {
    format!(
        "SKF model: no checked load formula and constants for a {kind} here; known are deep groove, angular contact, \
         four-point contact and spherical roller bearings"
    )
}

fn positive(what: &str, value: f64) -> Result<(), String> {
    possible(what, value, value > 0.0)
}

fn not_negative(what: &str, value: f64) -> Result<(), String> {
    possible(what, value, value >= 0.0)
}

fn possible(what: &str, value: f64, is_possible: bool) -> Result<(), String> {
    match is_possible && value.is_finite() {
        true => Ok(()),
        false => Err(format!("SKF model: {what} {value} (SI) is not possible")),
    }
}
