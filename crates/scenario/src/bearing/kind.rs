//! Kinds of a bearing: type, material of the balls, how it is modelled.

use physics::heat_conduction::{SILICON_NITRIDE_HEAT, STEEL_HEAT, ThermalMaterial};
use physics::materials::{BEARING_STEEL, Material, SILICON_NITRIDE, ball_mass};
use physics::palmgren_factors::FactorType;
use physics::skf_constants::SkfType;
use problem::words;

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
/// What an auxiliary bearing is computed as.
pub enum Modelled {
    /// A rolling bearing, ball by ball.
    Planar = "planar",
    /// A rolling bearing whose balls roll.
    Rolling = "rolling",
    /// A rolling bearing, ball by ball in space.
    Spatial = "spatial",
    /// A ring that does not turn.
    Bushing = "bushing",
}
}

words! {
/// Type of a bearing.
pub enum BearingType {
    DeepGroove = "deep groove",
    /// Angular contact, single row.
    AngularContact = "angular contact",
    AngularContactDoubleRow = "angular contact double row",
    FourPointContact = "four-point contact",
}
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
