//! What of a bearing that warms follows from other values.

use crate::bearing::fits::{Fits, HOUSING_FIT};
use crate::heat::{Atmosphere, HOUSING_SIZE};
use crate::several::PLANES;
use crate::spin_up::DriveKind;
use crate::system::{COAST_DOWN, ON_RIG};
use crate::values::{Value, Values};
use physics::air::SEA_LEVEL;
use physics::heat_conduction::STEEL_HEAT;
use physics::heat_exchange::{GROUND_STEEL, pressed_joint, to_surroundings};
use physics::ring::PressFit;
use problem::{Code, Problem};
use std::f64::consts::PI;

/// Mass of lubricant over outer diameter and width, kg/m².
const GREASE: f64 = 5.0;
/// Pressure of a fit of the outer race, Pa.
const FIT_PRESSURE: f64 = 1e6;
/// Radial clearance of the rotor over the bore of the race.
const AIR_CLEARANCE: f64 = 0.01;

/// Widths of the bearing that the shaft of a rig is long.
const SHAFT_WIDTHS: f64 = 4.0;

/// Conductance of a seat of ground steel pressed with so many Pa, W/(m² K).
fn pressed_seat(pressure: f64) -> f64 {
    let (roughness, slope, hardness) = GROUND_STEEL;
    let metal = [STEEL_HEAT.conductivity; 2];
    pressed_joint(metal, roughness, slope, pressure, hardness)
}

type Done = Result<(), Box<Problem>>;

impl Values {
    /// Fills what follows from weight and geometry.
    pub fn warm(&mut self) -> Done {
        if let Some(mass) = self.number("rotor.mass") {
            let share = mass / self.rows;
            if self.is_in(COAST_DOWN) {
                let how = "mass / number of all rows, times its rows, times 9.80665 m/s²";
                let own = self.number(PLANES).unwrap_or(1.0) * share;
                self.fill("coast_down.radial_load", own * units::STANDARD_GRAVITY, how)?;
            }
            let capacity = share * STEEL_HEAT.specific_heat;
            let how = "mass / number of rows times 460 J/(kg K): all of the rotor";
            self.fill("heat.rotor_capacity", capacity, how)?;
        }
        if let Some(temperature) = self.number("bearing.moment.temperature") {
            let how = "bearing.moment.temperature";
            self.fill("heat.start_temperature", temperature, how)?;
        }
        if let Some(temperature) = self.number("heat.ambient_temperature") {
            let how = "heat.ambient_temperature";
            self.fill("heat.start_temperature", temperature, how)?;
        }
        let size = |name: &str| self.number(&format!("heat.{name}"));
        let (Some(bore), Some(outside), Some(width)) =
            (size("bore_diameter"), size("outer_diameter"), size("width"))
        else {
            return Ok(());
        };
        let how = "0.005 g/mm² times outer_diameter and width";
        self.fill("heat.lubricant_mass", GREASE * outside * width, how)?;
        let thick = HOUSING_SIZE * HOUSING_SIZE - 1.0;
        let ring = 0.25 * PI * thick * outside * outside * width * STEEL_HEAT.density;
        let how = "a steel ring around the bearing, outside twice its diameter; assumed";
        self.fill(
            "heat.housing_capacity",
            ring * STEEL_HEAT.specific_heat,
            how,
        )?;
        if self.is_in(ON_RIG) {
            self.shaft_of_a_rig([bore, width])?;
        }
        if self.is_in(COAST_DOWN) {
            let how = "1 % of bore_diameter; assumed";
            self.fill("heat.radial_air_clearance", AIR_CLEARANCE * bore, how)?;
        }
        if self.lacks("heat.outer_seat") && !self.outer_seat_follows()? {
            let how = "ground steel pressed with 1 MPa on π outer_diameter width; assumed";
            let seat = pressed_seat(FIT_PRESSURE) * PI * outside * width;
            self.fill("heat.outer_seat", seat, how)?;
        }
        self.open_surfaces(self.rows, [outside, width])?;
        let by_rule = self.chosen("heat.atmosphere") != Some(Atmosphere::Vacuum);
        if by_rule && !self.exchanges("heat.housing_emissivity") {
            let how = "ISO 15312: 320 W/(m² K) of π width (outer_diameter + bore_diameter)";
            self.fill(
                "heat.surroundings",
                to_surroundings(bore, outside, width),
                how,
            )?;
        }
        if !self.exchanges("heat.emissivity") || self.lacks("heat.rotor_area") {
            let how = "the rotor gives its heat to the bearings alone, as in vacuum; assumed";
            self.fill("heat.rotor_surroundings", 0.0, how)?;
        }
        Ok(())
    }

    /// Whether gas or the emissivity of a surface says how it exchanges heat.
    fn exchanges(&self, emissivity: &str) -> bool {
        self.number("heat.gas_pressure").is_some() || self.radiates(emissivity)
    }

    fn radiates(&self, emissivity: &str) -> bool {
        self.number(emissivity).is_some_and(|share| share > 0.0)
    }

    /// Surfaces that exchange heat with their surroundings, and the air that does.
    fn open_surfaces(&mut self, bearings: f64, [outside, width]: [f64; 2]) -> Done {
        let radiates = ["heat.emissivity", "heat.housing_emissivity"];
        if radiates.iter().any(|path| self.radiates(path)) {
            let how = "air at sea level, ISO 2533";
            self.fill("heat.gas_pressure", SEA_LEVEL, how)?;
        }
        // outside of a ring and both its faces
        let diameter = HOUSING_SIZE * outside;
        let faces = 0.5 * PI * (diameter * diameter - outside * outside);
        let how = "outside and faces of a ring twice outer_diameter, of the same width; assumed";
        self.fill("heat.housing_area", PI * diameter * width + faces, how)?;
        if let (Some(mass), Some(inertia)) = (
            self.number("rotor.mass"),
            self.number("rotor.polar_inertia"),
        ) {
            let how = "sqrt(8 polar_inertia / mass): as a solid cylinder";
            self.fill("heat.rotor_diameter", (8.0 * inertia / mass).sqrt(), how)?;
            if let Some(diameter) = self.number("heat.rotor_diameter") {
                let side = 4.0 * mass / (STEEL_HEAT.density * diameter);
                let area = (side + 0.5 * PI * diameter * diameter) / bearings;
                let how = "a solid steel cylinder of rotor_diameter and mass, over the number of bearings; assumed";
                self.fill("heat.rotor_area", area, how)?;
            }
        }
        Ok(())
    }

    /// Fits of both rings, where they are given and what is pressed together is known.
    pub fn known_fits(&self) -> [Option<PressFit>; 2] {
        let sizes = (self.number("bearing.pitch_diameter"))
            .zip(self.number("bearing.ball_diameter"))
            .filter(|_| self.number(HOUSING_FIT).is_some());
        let Some((pitch, ball)) = sizes else {
            return [None; 2];
        };
        let fits = Fits::from_values(self);
        [fits.on_shaft(pitch - ball), fits.in_housing(pitch + ball)]
            .map(|fit| fit.filter(|fit| fit.interference != 0.0))
    }

    /// Whether the outer ring conducts by its fit, which is given; refuses a loose one of which nothing else is known.
    fn outer_seat_follows(&self) -> Result<bool, Box<Problem>> {
        let follows = self.known_fits()[1].is_some();
        if self.number(HOUSING_FIT).unwrap_or(0.0) < 0.0 && !follows {
            return Err(self.problem(
                Code::MissingKey,
                "heat.outer_seat",
                self.place(HOUSING_FIT),
                "no value",
                format!("a conductance is needed, or bearing.fits.outer_diameter and housing_outer_diameter: {HOUSING_FIT} leaves the ring loose, and no rule of a pressed seat holds"),
            ));
        }
        Ok(follows)
    }

    /// The shaft that stands in the inner race of a rig.
    fn shaft_of_a_rig(&mut self, [bore, width]: [f64; 2]) -> Done {
        let volume = 0.25 * PI * bore * bore * SHAFT_WIDTHS * width;
        let capacity = volume * STEEL_HEAT.density * STEEL_HEAT.specific_heat;
        let how = "a steel shaft of the bore, four widths long; assumed";
        self.fill("heat.rotor_capacity", capacity, how)?;
        let slides = self.chosen("drive.kind") == Some(DriveKind::SlidingRotor);
        if slides || self.known_fits()[0].is_some() {
            return Ok(());
        }
        let how = "ground steel pressed with 1 MPa on π bore_diameter width; assumed";
        self.fill(
            "heat.rotor_contact",
            pressed_seat(FIT_PRESSURE) * PI * bore * width,
            how,
        )
    }

    fn fill(&mut self, path: &'static str, value: f64, how: &str) -> Done {
        match self.lacks(path) {
            true => self.put_derived(path, Value::Number(value), how),
            false => Ok(()),
        }
    }
}
