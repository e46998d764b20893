//! Kinds of a bearing: type, material of the balls, how it is modelled.

use physics::materials::{BEARING_STEEL, Material, SILICON_NITRIDE, ball_mass};
use physics::palmgren_factors::FactorType;
use physics::skf_constants::SkfType;

/// How the bearing is modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fidelity {
    /// Each ball and the cage move in the plane, with slip.
    Planar,
    /// Pure rolling.
    Rolling,
}

/// Type of a bearing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BearingType {
    /// Deep groove.
    DeepGroove,
    /// Angular contact, single row.
    AngularContact,
    /// Angular contact, double row.
    AngularContactDoubleRow,
    /// Four-point contact.
    FourPointContact,
}

impl BearingType {
    /// The type of a word of the table.
    pub(crate) fn of(word: &str) -> BearingType {
        match word {
            "angular contact" => BearingType::AngularContact,
            "angular contact double row" => BearingType::AngularContactDoubleRow,
            "four-point contact" => BearingType::FourPointContact,
            _ => BearingType::DeepGroove,
        }
    }
    /// The type as the laws' tables know it.
    pub(crate) fn factor_type(self) -> FactorType {
        match self {
            BearingType::DeepGroove => FactorType::DeepGroove,
            BearingType::AngularContact => FactorType::AngularContact,
            BearingType::AngularContactDoubleRow => FactorType::AngularContactDoubleRow,
            BearingType::FourPointContact => FactorType::FourPointContact,
        }
    }
    /// The type as the SKF model knows it.
    pub(crate) fn skf_type(self) -> SkfType {
        match self {
            BearingType::DeepGroove => SkfType::DeepGroove,
            BearingType::AngularContact => SkfType::AngularContactSingleRow,
            BearingType::AngularContactDoubleRow => SkfType::AngularContactDoubleRow,
            BearingType::FourPointContact => SkfType::FourPointContact,
        }
    }
}

/// Material of the balls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BallMaterial {
    /// Bearing steel.
    Steel,
    /// Silicon nitride: a hybrid bearing.
    SiliconNitride,
}

impl BallMaterial {
    /// Its constants.
    pub fn data(self) -> Material {
        match self {
            BallMaterial::Steel => BEARING_STEEL,
            BallMaterial::SiliconNitride => SILICON_NITRIDE,
        }
    }
    /// Mass of a ball of this material, kg.
    pub fn ball_mass(self, diameter: f64) -> f64 {
        ball_mass(diameter, self.data().density)
    }
}
