//! Kinds of a bearing: type, material of the balls, how it is modelled.

use physics::heat_conduction::{SILICON_NITRIDE_HEAT, STEEL_HEAT, ThermalMaterial};
use physics::materials::{BEARING_STEEL, Material, SILICON_NITRIDE, ball_mass};
use physics::palmgren_factors::FactorType;
use physics::skf_constants::SkfType;
use problem::raw::{Input, Raw};
use problem::words;
use problem::words::Words;

words! {
/// How a rolling bearing is modelled.
pub enum Fidelity {
    /// Each ball and the cage move in the plane, with slip.
    Planar = "planar",
    /// Pure rolling.
    Rolling = "rolling",
    /// Each ball and the cage move in space.
    Spatial = "spatial",
}
}

words! {
/// Type of a rolling bearing.
pub enum BearingType {
    DeepGroove = "deep groove",
    /// Angular contact, single row.
    AngularContact = "angular contact",
    AngularContactDoubleRow = "angular contact double row",
    FourPointContact = "four-point contact",
}
}

/// Key of how its motion is modelled.
pub const FIDELITY: &str = "bearing.fidelity";
/// Key of the type of a bearing, on which all its other keys depend.
pub const TYPE: &str = "bearing.type";
/// Type of an auxiliary bearing that is a ring that does not turn.
pub const BUSHING: &str = "bushing";
/// All types of a bearing.
pub const TYPES: &[&str] = &{
    let [a, b, c, d] = *BearingType::WORDS else {
        panic!("four types have balls")
    };
    [a, b, c, d, BUSHING]
};

/// Whether the value given as a type is that of a ring.
pub fn is_bushing(given: &Input) -> bool {
    matches!(given.raw.plain(), Some(Raw::Text(text)) if text == BUSHING)
}

impl BearingType {
    /// The type as the laws' tables know it.
    pub fn factor_type(self) -> FactorType {
        match self {
            BearingType::DeepGroove => FactorType::DeepGroove,
            BearingType::AngularContact => FactorType::AngularContact,
            BearingType::AngularContactDoubleRow => FactorType::AngularContactDoubleRow,
            BearingType::FourPointContact => FactorType::FourPointContact,
        }
    }
    /// The type as the SKF model knows it.
    pub fn skf_type(self) -> SkfType {
        match self {
            BearingType::DeepGroove => SkfType::DeepGroove,
            BearingType::AngularContact => SkfType::AngularContactSingleRow,
            BearingType::AngularContactDoubleRow => SkfType::AngularContactDoubleRow,
            BearingType::FourPointContact => SkfType::FourPointContact,
        }
    }
}

words! {
/// Material of the balls.
pub enum BallMaterial {
    /// Bearing steel.
    Steel = "steel",
    /// Silicon nitride: a hybrid bearing.
    SiliconNitride = "silicon nitride",
}
}

impl BallMaterial {
    /// Its constants.
    pub fn data(self) -> Material {
        match self {
            BallMaterial::Steel => BEARING_STEEL,
            BallMaterial::SiliconNitride => SILICON_NITRIDE,
        }
    }
    /// What it is as a body that conducts.
    pub fn heat(self) -> ThermalMaterial {
        match self {
            BallMaterial::Steel => STEEL_HEAT,
            BallMaterial::SiliconNitride => SILICON_NITRIDE_HEAT,
        }
    }
    /// Mass of a ball of this material, kg.
    pub fn ball_mass(self, diameter: f64) -> f64 {
        ball_mass(diameter, self.data().density)
    }
}
