//! Values that follow from others.

use crate::bearing::kind::{BUSHING, BallMaterial, BearingType, FIDELITY, Fidelity, TYPE};
use crate::bearing::lubricant::Lubricant;
use crate::bearing::moment::{EquivalentLoad, Lubricated, MomentLaw};
use crate::heat::Network;
use crate::key::{Key, quoted};
use crate::resolve::Before;
use crate::system::{COAST_DOWN, FALLING, TORQUE};
use crate::table;
use crate::values::{COMPARED_LAWS, Known, LAW, LUBRICATION, Value, Values};
use physics::hertz::{BallRace, PointContact, Race};
use physics::materials::{BEARING_STEEL, SILICON_NITRIDE, ball_mass, contact_modulus};
use physics::palmgren_factors::{FactorSource, Lubrication, palmgren_factors};
use physics::viscosity::Viscosity;
use problem::provenance::Provenance;
use problem::value::quantity_text;
use problem::words::Words;
use problem::{Code, Place, Result};

pub(super) const F0: &str = "bearing.moment.f0";
pub(super) const F1_FACTOR: &str = "bearing.moment.f1_factor";
pub(super) const F1_EXPONENT: &str = "bearing.moment.f1_exponent";
pub(super) const SERIES: &str = "bearing.moment.series";
const TEMPERATURE: &str = "bearing.moment.temperature";
const VISCOSITY_POINTS: &str = "bearing.moment.viscosity_points";
const LUBRICANTS: &str = "torque.lubricants";
const AXIAL_LOAD: &str = "bearing.moment.axial_load";
pub(super) const CONTACT_ANGLE: &str = "bearing.moment.contact_angle";
const EQUIVALENT_LOAD: &str = "bearing.moment.equivalent_load";
const PRELOAD: &str = "bearing.axial_preload";
pub(super) const ANGLE: &str = "bearing.contact_angle";
const BALL_MASS: &str = "bearing.ball_mass";
const BALL: &str = "bearing.ball_diameter";
const PITCH: &str = "bearing.pitch_diameter";
const MATERIAL: &str = "bearing.ball_material";

/// Contact angle of a deep groove bearing under axial load, degrees: 0.9 cot(16.7 degrees) = 3.
const DEEP_GROOVE_ANGLE: f64 = 16.7;

/// Largest speed of a torque table for a bearing whose limiting speed is not known, rad/s.
const SPEED_WITHOUT_LIMIT: f64 = 1000.0;
/// Radial load over static load rating where no load is given.
const LOAD_SHARE: f64 = 0.01;

type Done = Result<()>;

impl Values {
    /// A bushing is what a rotor drops into; nothing of it follows from other values.
    fn bushing(&self) -> Done {
        if FALLING.contains(&self.system()) {
            return Ok(());
        }
        let found = format!("{} where a bearing turns", quoted(BUSHING));
        let needed = "a type with balls is needed, e.g. \"deep groove\": a bushing does not turn";
        self.refuse(Code::Conflict, TYPE, found, needed)
    }

    /// Fills what follows from other values; `before` is the file with other values at a few keys.
    pub fn derive(&mut self, before: Option<&Before>) -> Done {
        if let (Some(unbalance), Some(mass)) =
            (self.number("rotor.unbalance"), self.number("rotor.mass"))
        {
            let eccentricity = unbalance / mass;
            self.put_derived(
                "rotor.unbalance_eccentricity",
                Value::Number(eccentricity),
                "unbalance / mass",
            )?;
        }
        self.cutoff()?;
        if self.word(TYPE) == BUSHING {
            return self.bushing();
        }
        if self.lacks("bearing.cage_inertia")
            && let (Some(mass), Some(pitch)) = (
                self.number("bearing.cage_mass"),
                self.number("bearing.pitch_diameter"),
            )
        {
            let radius = 0.5 * pitch;
            self.put_derived(
                "bearing.cage_inertia",
                Value::Number(mass * radius * radius),
                "cage_mass (pitch_diameter/2)^2: a thin ring at the pitch circle",
            )?;
        }
        self.balls(before)?;
        self.clearance_by_fits()?;
        self.land_diameter()?;
        if self.is_in(TORQUE) {
            self.torque()?;
        }
        if self.is_in(COAST_DOWN) || self.chosen("heat.network") == Some(Network::On) {
            self.warm()?;
        }
        if let Some(preload) = self.number(PRELOAD)
            && self.number(AXIAL_LOAD).is_some()
            && !self.is_given(AXIAL_LOAD)
        {
            self.put_derived(AXIAL_LOAD, Value::Number(preload), PRELOAD)?;
        }
        match self.chosen(LAW).unwrap_or(MomentLaw::None) {
            MomentLaw::None | MomentLaw::Measured => Ok(()),
            MomentLaw::Palmgren | MomentLaw::PalmgrenPrinted => {
                self.series()?;
                self.palmgren_factors()?;
                self.viscosity()
            }
            MomentLaw::Skf => {
                self.series()?;
                self.skf_lubrication()?;
                let kind = self.bearing_type().skf_type();
                self.contact_angle(kind.angles_deg(), "the SKF model")?;
                self.viscosity()
            }
        }
    }

    /// Mass of a ball, and stiffness of its contacts.
    fn balls(&mut self, before: Option<&Before>) -> Done {
        let (Some(ball), Some(pitch)) = (self.number(BALL), self.number(PITCH)) else {
            return Ok(());
        };
        let (material, named) = match self.chosen(MATERIAL) {
            Some(BallMaterial::SiliconNitride) => (SILICON_NITRIDE, "silicon nitride"),
            Some(BallMaterial::Steel) | None => (BEARING_STEEL, "bearing steel"),
        };
        if self.lacks(BALL_MASS) {
            let how = format!("ball_diameter and {} kg/m³ of {named}", material.density);
            let mass = Value::Number(ball_mass(ball, material.density));
            self.put_derived(BALL_MASS, mass, &how)?;
        }
        for (path, race, curvature, how) in [
            (
                "bearing.inner_contact_stiffness",
                Race::Inner,
                "bearing.inner_groove_curvature",
                "Hertz contact of ball and inner groove",
            ),
            (
                "bearing.outer_contact_stiffness",
                Race::Outer,
                "bearing.outer_groove_curvature",
                "Hertz contact of ball and outer groove",
            ),
        ] {
            let (true, Some(groove_curvature)) = (self.lacks(path), self.number(curvature)) else {
                continue;
            };
            // the integrals of an ellipse take longer than all else of a file
            let inputs = [BALL, PITCH, curvature, ANGLE, MATERIAL];
            let known = before.and_then(|before| before.derived(path, &inputs, &self.known));
            if let Some(known) = known {
                self.put(path, known.clone());
                continue;
            }
            let geometry = BallRace {
                ball_diameter: ball,
                pitch_diameter: pitch,
                groove_curvature,
                contact_angle: self.number("bearing.contact_angle").unwrap_or(0.0),
                race,
            };
            let modulus = contact_modulus(material, BEARING_STEEL);
            // what gives no point contact is refused by the checks of geometry
            if let Ok(contact) = PointContact::new(geometry.curvature(), modulus) {
                self.put_derived(path, Value::Number(contact.stiffness), how)?;
            }
        }
        Ok(())
    }

    /// The contact angle of the law: that of the bearing, else the middle of those that its constants are for, else what a deep
    /// groove bearing takes under axial load, which no catalogue tells. Constants for other angles are refused.
    fn contact_angle(&mut self, constants: Option<[f64; 2]>, of: &str) -> Done {
        self.refuse_angle(ANGLE, constants, of)?;
        // in space each row has an axial load of its own
        let in_space = self.chosen(FIDELITY) == Some(Fidelity::Spatial);
        let loaded = in_space || self.number(AXIAL_LOAD).is_some_and(|load| load != 0.0);
        // what the file says of the bearing counts before its catalogue
        let catalogued = self.mark(CONTACT_ANGLE) == "catalogue";
        if let Some(angle) = self.number(ANGLE)
            && (loaded || constants.is_some())
            && (self.lacks(CONTACT_ANGLE) || catalogued)
            && self.number(CONTACT_ANGLE) != Some(angle)
        {
            self.put_derived(CONTACT_ANGLE, Value::Number(angle), ANGLE)?;
        }
        self.refuse_angle(CONTACT_ANGLE, constants, of)?;
        if !self.lacks(CONTACT_ANGLE) {
            return Ok(());
        }
        let by_angle = self.chosen(EQUIVALENT_LOAD) == Some(EquivalentLoad::Timken);
        let (degrees, why) = match constants {
            Some([least, largest]) if !(by_angle && loaded) => (
                0.5 * (least + largest),
                format!("the constants of {of} are for {least} to {largest} deg"),
            ),
            None if by_angle && loaded && self.bearing_type() == BearingType::DeepGroove => (
                DEEP_GROOVE_ANGLE,
                "P1 = 3 F_a - 0.1 F_r of deep groove bearings (Harris, from memory)".to_string(),
            ),
            _ => return Ok(()),
        };
        let known = Known {
            value: Value::Number(degrees.to_radians()),
            text: format!("{degrees} deg"),
            provenance: Provenance::DefaultAssumed(why),
            place: Place::Whole,
            filled_in: false,
        };
        self.put(CONTACT_ANGLE, known);
        Ok(())
    }

    /// Refuses a contact angle that the constants of a law are not for.
    fn refuse_angle(&self, path: &'static str, constants: Option<[f64; 2]>, of: &str) -> Done {
        let (Some([least, largest]), Some(angle)) = (constants, self.number(path)) else {
            return Ok(());
        };
        // without the rounding of radians
        let degrees = (angle.to_degrees() * 1e9).round() / 1e9;
        if (least..=largest).contains(&degrees) {
            return Ok(());
        }
        let mut chosen = [path, SERIES, LAW].into_iter();
        let blamed = chosen
            .find(|path| self.place(path) != Place::Whole)
            .unwrap_or(path);
        self.refuse(
            Code::NoLawData,
            blamed,
            format!("a contact angle of {degrees} deg"),
            format!(
                "{least} to {largest} deg is needed, for which the constants of {of} are; else Palmgren's law with f0, f1_factor and f1_exponent by hand, or a measured curve"
            ),
        )
    }

    /// The type of the bearing; deep groove where nothing asks for it.
    pub(super) fn bearing_type(&self) -> BearingType {
        self.chosen(TYPE).unwrap_or(BearingType::DeepGroove)
    }

    /// Whether a key of this system has neither a value nor an obstacle.
    pub fn lacks(&self, path: &str) -> bool {
        let here = |key: &&Key| table::systems(key).contains(&self.system());
        let key = table::key(path).filter(here);
        !self.known.contains_key(path) && key.is_some_and(|key| self.unmet(key).is_none())
    }

    /// The series by the name of the bearing, where the name holds it.
    fn series(&mut self) -> Done {
        match self.series_by_name() {
            Some((series, how)) if self.lacks(SERIES) => {
                self.put_derived(SERIES, Value::Text(series), how)
            }
            _ => Ok(()),
        }
    }

    /// f0 and f1 by series and lubrication, where they are not given.
    fn palmgren_factors(&mut self) -> Done {
        let Some(missing) = [F0, F1_FACTOR, F1_EXPONENT]
            .into_iter()
            .find(|path| self.lacks(path))
        else {
            self.equivalent_load(FactorSource::Timken, "f1 is given by hand")?;
            self.contact_angle(None, "")?;
            if !self.is_given(LUBRICATION) {
                self.take_away(LUBRICATION);
            } else if self.words(COMPARED_LAWS).is_empty() {
                self.without_effect.push(LUBRICATION);
            }
            return Ok(());
        };
        let lubrication = match self.chosen(LUBRICATION) {
            Some(Lubricated::Grease | Lubricated::OilMist) => Lubrication::GreaseOrOilMist,
            Some(Lubricated::LowOilBath | Lubricated::OilJet) => Lubrication::OilBath,
            None => return Err(self.no_factor(missing)),
            Some(other @ (Lubricated::OilAndAir | Lubricated::OilBath)) => {
                let other = other.as_word();
                return self.refuse(
                    Code::NoLawData,
                    LUBRICATION,
                    format!("\"{other}\", which Palmgren's tables do not have"),
                    "one of \"grease\", \"oil mist\", \"low oil bath\", \"oil jet\" is needed, or f0 and f1 by hand",
                );
            }
        };
        let Some(series) = self.text(SERIES) else {
            return Err(self.no_factor(missing));
        };
        let kind = self.bearing_type().factor_type();
        let factors = palmgren_factors(kind, &series, lubrication).map_err(|refusal| {
            self.problem(
                Code::NoLawData,
                SERIES,
                self.place(SERIES),
                refusal.to_string(),
                "a series of the tables is needed, or f0, f1_factor and f1_exponent by hand",
            )
        })?;
        let told = if factors.lubrication_stated {
            ""
        } else {
            ", which does not state the lubrication"
        };
        let how = format!(
            "series {series}, {kind}: {}{told}",
            factors.source.citation()
        );
        match self.lacks(F1_FACTOR) {
            true => self.equivalent_load(factors.source, &how)?,
            false => self.equivalent_load(FactorSource::Timken, "f1 is given by hand")?,
        }
        self.contact_angle(factors.angles_deg, &format!("series {series}"))?;
        for (path, value) in [
            (F0, factors.viscous_factor),
            (F1_FACTOR, factors.load_factor),
            (F1_EXPONENT, factors.load_exponent),
        ] {
            if self.lacks(path) {
                self.put_derived(path, Value::Number(value), &how)?;
            }
        }
        Ok(())
    }

    /// The form of P1, which belongs to the source of f1.
    fn equivalent_load(&mut self, source: FactorSource, how: &str) -> Done {
        if !self.lacks(EQUIVALENT_LOAD) {
            return Ok(());
        }
        self.put_derived(
            EQUIVALENT_LOAD,
            Value::Word(EquivalentLoad::of(source).as_word()),
            how,
        )
    }

    fn skf_lubrication(&self) -> Done {
        let needed = "one of \"grease\", \"oil and air\", \"oil bath\", \"low oil bath\", \"oil jet\" is needed for the SKF model";
        match self.chosen(LUBRICATION) {
            None => self.refuse(Code::MissingKey, LUBRICATION, "no value", needed),
            Some(Lubricated::OilMist) => self.refuse(
                Code::NoLawData,
                LUBRICATION,
                "\"oil mist\", which the SKF model does not have",
                needed,
            ),
            Some(
                Lubricated::Grease
                | Lubricated::OilAndAir
                | Lubricated::OilBath
                | Lubricated::LowOilBath
                | Lubricated::OilJet,
            ) => Ok(()),
        }
    }

    /// Where the torque is computed, as far as it is not given.
    fn torque(&mut self) -> Done {
        if self.lacks("torque.speed_to") {
            let limit = self.number("bearing.limiting_speed");
            let how = match limit {
                Some(_) => "the limiting speed of the bearing",
                None => "no limiting speed is known",
            };
            let speed = limit.unwrap_or(SPEED_WITHOUT_LIMIT);
            self.put_derived("torque.speed_to", Value::Number(speed), how)?;
        }
        if self.lacks("torque.speed")
            && let Some(speed) = self.number("torque.speed_to")
        {
            self.put_derived("torque.speed", Value::Number(speed), "torque.speed_to")?;
        }
        if self.lacks("torque.loads") {
            let (load, why) = match self.number("bearing.static_load_rating") {
                Some(rating) => (
                    LOAD_SHARE * rating,
                    "1 % of the static load rating: the order of a rotor's weight",
                ),
                None => (0.0, "without a static load rating no load has an effect"),
            };
            let text = format!("[\"{} N\"]", units::number_text(load));
            self.put(
                "torque.loads",
                Known {
                    value: Value::Numbers(vec![load]),
                    text,
                    provenance: Provenance::DefaultAssumed(why.to_string()),
                    place: Place::Whole,
                    filled_in: false,
                },
            );
        }
        Ok(())
    }

    /// The viscosity at the running temperature, of the first lubricant of a comparison.
    fn viscosity_of_lubricant(&mut self, text: &str) -> Done {
        let unknown = |path: &'static str, why: String| {
            let allowed = "a lubricant whose viscosity is known at the running temperature is needed, e.g. \"100 mm^2/s at 40 degC, 11 mm^2/s at 100 degC\"";
            self.problem(Code::NoLawData, path, self.place(path), why, allowed)
        };
        let lubricant = Lubricant::parse(text).map_err(|why| unknown(LUBRICANTS, why))?;
        let temperature = self.number(TEMPERATURE);
        let path = temperature.map_or(LUBRICANTS, |_| TEMPERATURE);
        let viscosity = lubricant
            .at(temperature)
            .map_err(|why| unknown(path, format!("{}: {why}", lubricant.name)))?;
        let how = format!(
            "{} at the running temperature, by ASTM D341",
            lubricant.name
        );
        self.put_derived("bearing.moment.viscosity", Value::Number(viscosity), &how)
    }

    /// The viscosity at the running temperature, by two points.
    fn viscosity(&mut self) -> Done {
        let Some(points) = self.rows(VISCOSITY_POINTS) else {
            if let Some(first) = self.texts(LUBRICANTS).first() {
                let first = first.clone();
                return self.viscosity_of_lubricant(&first);
            }
            return match self.text(TEMPERATURE) {
                Some(text) => self.refuse(
                    Code::UnusedKey,
                    TEMPERATURE,
                    format!("\"{text}\", which has no effect"),
                    "it is used only with bearing.moment.viscosity_points; a given viscosity holds as it is",
                ),
                None => Ok(()),
            };
        };
        let of_points = |code, found: String, allowed: &str| {
            let place = self.place(VISCOSITY_POINTS);
            self.problem(code, VISCOSITY_POINTS, place, found, allowed)
        };
        let [one, other] = points.as_slice() else {
            return Err(of_points(
                Code::WrongType,
                format!("{} rows", points.len()),
                "two rows are needed, e.g. at 40 degC and 100 degC",
            ));
        };
        let Some(temperature) = self.number(TEMPERATURE) else {
            return self.refuse(
                Code::MissingKey,
                TEMPERATURE,
                "no value",
                "a temperature above 0 is needed with viscosity_points, e.g. \"60 degC\"",
            );
        };
        let line = Viscosity::through((one[0], one[1]), (other[0], other[1])).map_err(|error| {
            of_points(
                Code::NoLawData,
                error.to_string(),
                "two points of one oil are needed",
            )
        })?;
        let viscosity = line.at(temperature).map_err(|error| {
            self.problem(
                Code::NoLawData,
                TEMPERATURE,
                self.place(TEMPERATURE),
                error.to_string(),
                "a temperature between those is needed, or the viscosity itself",
            )
        })?;
        self.put_derived(
            "bearing.moment.viscosity",
            Value::Number(viscosity),
            "viscosity_points at temperature, by ASTM D341",
        )
    }

    pub(crate) fn put_derived(&mut self, path: &'static str, value: Value, how: &str) -> Done {
        let Some(key) = table::key(path) else {
            return Ok(());
        };
        let text = match &value {
            Value::Number(number) => quantity_text(key, *number),
            Value::Text(text) => text.clone(),
            Value::Word(word) => word.to_string(),
            _ => String::new(),
        };
        if value
            .number()
            .is_some_and(|number| !key.range.holds(number))
        {
            return Err(self.problem(
                Code::OutOfRange,
                path,
                Place::Whole,
                format!("{text}, derived by {how}"),
                key.needed(),
            ));
        }
        self.put(
            path,
            Known {
                value,
                text,
                provenance: Provenance::Derived(how.to_string()),
                place: Place::Whole,
                filled_in: false,
            },
        );
        Ok(())
    }
}
