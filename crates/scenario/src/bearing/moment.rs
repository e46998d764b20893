//! The friction of a bearing as a whole, as typed values in SI.

use crate::bearing::kind::{BallMaterial, BearingType};
use crate::values::Values;
use physics::friction::Friction;
use physics::moment_curve::MomentCurve;
use physics::palmgren::{Palmgren, PalmgrenCombined};
use physics::palmgren_factors::FactorSource;
use physics::skf_constants::{SkfBearing, SkfLubricant, SkfOil, SkfSupply};
use physics::static_load::static_load_factors;
use problem::words;

words! {
    /// Law of the friction moment, as a word.
    pub enum MomentLaw {
        None = "none",
        /// Palmgren's, continuous.
        Palmgren = "palmgren",
        /// Palmgren's, as printed.
        PalmgrenPrinted = "palmgren printed",
        /// The SKF model.
        Skf = "skf",
        /// A measured curve.
        Measured = "measured",
    }
}

words! {
    /// How a bearing is lubricated, as a word.
    pub enum Lubricated {
        Grease = "grease",
        OilMist = "oil mist",
        OilAndAir = "oil and air",
        OilBath = "oil bath",
        /// Oil bath up to the lowest ball.
        LowOilBath = "low oil bath",
        OilJet = "oil jet",
    }
}

words! {
    /// Kind of an oil in the SKF model, as a word.
    pub enum OilKind {
        Mineral = "mineral",
        Synthetic = "synthetic",
        TransmissionFluid = "transmission fluid",
    }
}

words! {
    /// Whose form of P1, as a word.
    pub enum EquivalentLoad {
        /// Schaeffler's.
        Schaeffler = "schaeffler",
        /// Timken's.
        Timken = "timken",
    }
}

words! {
    /// Kind of the loss of accelerated balls, as a word.
    pub enum LossKind {
        None = "none",
        /// F0.
        Constant = "constant",
        /// F1 times the acceleration.
        Proportional = "proportional",
        /// F0 over speed.
        OverSpeed = "over speed",
        /// Both over speed.
        Affine = "affine",
    }
}

impl EquivalentLoad {
    /// The form of a source.
    pub fn of(source: FactorSource) -> Self {
        match source {
            FactorSource::Schaeffler => EquivalentLoad::Schaeffler,
            FactorSource::Timken => EquivalentLoad::Timken,
        }
    }
    /// The source of the form.
    fn source(self) -> FactorSource {
        match self {
            EquivalentLoad::Schaeffler => FactorSource::Schaeffler,
            EquivalentLoad::Timken => FactorSource::Timken,
        }
    }
}

/// Steady friction moment.
#[derive(Clone, Debug, PartialEq)]
pub enum Moment {
    /// No moment.
    None,
    /// Palmgren's two terms.
    Palmgren {
        /// As printed, with its steps; else continuous and odd in speed.
        printed: bool,
        /// Factor f0.
        f0: f64,
        /// Kinematic viscosity, m²/s.
        viscosity: f64,
        /// Factor z of f1 = z (P0/C0)^y.
        f1_factor: f64,
        /// Exponent y of f1 = z (P0/C0)^y.
        f1_exponent: f64,
        /// Load of rings that have closed by their warmth on the balls, N; 0 in a scenario.
        preload: f64,
        /// Axial load, N; the printed form has none.
        axial_load: f64,
        /// Contact angle under load, rad, where it is known.
        contact_angle: Option<f64>,
        /// Whose form of the load P1 goes with f1; the printed form has P1 = W.
        equivalent_load: FactorSource,
    },
    /// The SKF model.
    Skf {
        /// Series, as its tables write it.
        series: String,
        /// Bore of the bearing, m.
        bore_diameter: f64,
        /// Outer diameter of the bearing, m.
        outer_diameter: f64,
        /// Axial load, N.
        axial_load: f64,
        /// Kinematic viscosity, m²/s.
        viscosity: f64,
        /// How the lubricant reaches the contacts.
        supply: SkfSupply,
        /// Kind of oil.
        oil: SkfOil,
        /// Variable V_M of the drag in an oil bath.
        drag_variable: f64,
        /// Moment of the seals, N m.
        seal_moment: f64,
    },
    /// A measured curve over speed.
    Measured {
        /// Rows of speed, rad/s, and moment, N m.
        curve: Vec<[f64; 2]>,
    },
}

/// How balls that move by themselves share the steady moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentShare {
    /// Share of the speed-dependent part that drags on the orbit.
    pub orbit_share: f64,
    /// Speed of rolling that regularises the load-dependent part, rad/s.
    pub reference_spin: f64,
    /// Scale of the law.
    pub scale: f64,
}

/// Friction of the balls in their pockets while the race accelerates: forces in N, with the sign of the rotation.
#[derive(Clone, Debug, PartialEq)]
pub enum AccelerationLoss {
    /// None.
    None,
    /// A constant force.
    Constant {
        /// F0, N.
        force: f64,
    },
    /// A force proportional to the size of the acceleration.
    Proportional {
        /// F1, N s²/rad.
        per_acceleration: f64,
    },
    /// A force over speed.
    OverSpeed {
        /// Rows of speed, rad/s, and F0, N.
        force_over_speed: Vec<[f64; 2]>,
    },
    /// Both over speed.
    Affine {
        /// Rows of speed, rad/s, and F0, N.
        force_over_speed: Vec<[f64; 2]>,
        /// Rows of speed, rad/s, and F1, N s²/rad.
        per_acceleration_over_speed: Vec<[f64; 2]>,
    },
}

/// What a friction law needs to know of a bearing besides its own constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RatedBearing {
    /// Type.
    pub kind: BearingType,
    /// Diameter of the circle through the ball centres, m.
    pub pitch_diameter: f64,
    /// Static load rating, N.
    pub static_load_rating: Option<f64>,
    /// Material of the balls.
    pub ball_material: BallMaterial,
    /// Whether its axial loads are computed, in space.
    pub in_space: bool,
}

impl Moment {
    pub(crate) fn from_values(values: &Values) -> Moment {
        let moment = values.section("bearing.moment");
        let law = moment.chosen("law").unwrap_or(MomentLaw::None);
        // none in space, where it is computed
        let axial_load: Option<f64> = moment.maybe("axial_load");
        match law {
            MomentLaw::None => Moment::None,
            MomentLaw::Palmgren | MomentLaw::PalmgrenPrinted => {
                let printed = law == MomentLaw::PalmgrenPrinted;
                Moment::Palmgren {
                    printed,
                    f0: moment.number("f0"),
                    viscosity: moment.number("viscosity"),
                    f1_factor: moment.number("f1_factor"),
                    f1_exponent: moment.number("f1_exponent"),
                    preload: 0.0,
                    axial_load: axial_load.filter(|_| !printed).unwrap_or(0.0),
                    contact_angle: moment.maybe("contact_angle").filter(|_| !printed),
                    // as printed there is no axial load, and P1 is the radial one
                    equivalent_load: moment
                        .chosen::<EquivalentLoad>("equivalent_load")
                        .map_or(FactorSource::Timken, EquivalentLoad::source),
                }
            }
            MomentLaw::Skf => Moment::Skf {
                series: values.text("bearing.moment.series").unwrap_or_default(),
                bore_diameter: moment.number("bore_diameter"),
                outer_diameter: moment.number("outer_diameter"),
                axial_load: axial_load.unwrap_or(0.0),
                viscosity: moment.number("viscosity"),
                supply: match moment.choice("lubrication") {
                    Lubricated::Grease | Lubricated::OilMist | Lubricated::OilAndAir => {
                        SkfSupply::GreaseOrOilAir
                    }
                    Lubricated::OilBath => SkfSupply::OilBath,
                    Lubricated::LowOilBath | Lubricated::OilJet => SkfSupply::LowOilBathOrJet,
                },
                oil: match moment.choice("oil") {
                    OilKind::Mineral => SkfOil::Mineral,
                    OilKind::Synthetic => SkfOil::Synthetic,
                    OilKind::TransmissionFluid => SkfOil::Transmission,
                },
                drag_variable: moment.number("drag_variable"),
                seal_moment: moment.number("seal_moment"),
            },
            MomentLaw::Measured => Moment::Measured {
                curve: moment.rows("curve").unwrap_or_default(),
            },
        }
    }

    /// The law with its constants, or why there is none for this bearing.
    pub fn law(&self, bearing: &RatedBearing) -> Result<Friction<f64>, String> {
        match self {
            Moment::None => Ok(Friction::None),
            Moment::Palmgren {
                printed,
                f0,
                viscosity,
                f1_factor,
                f1_exponent,
                preload,
                axial_load,
                contact_angle,
                equivalent_load,
            } => {
                let law = Palmgren {
                    viscous_factor: *f0,
                    viscosity: *viscosity,
                    pitch_diameter: bearing.pitch_diameter,
                    load_factor: *f1_factor,
                    load_exponent: *f1_exponent,
                    static_load_rating: bearing
                        .static_load_rating
                        .ok_or("no static load rating C0 is given")?,
                    preload: *preload,
                };
                if *printed {
                    return Ok(Friction::PalmgrenPrinted(law));
                }
                let kind = bearing.kind.factor_type();
                let radial_factor = equivalent_load.radial_factor(kind);
                if !bearing.in_space && *axial_load == 0.0 && radial_factor <= 1.0 {
                    return Ok(Friction::Palmgren(law));
                }
                let (radial, axial) =
                    static_load_factors(kind, *contact_angle).map_err(|why| why.to_string())?;
                Ok(Friction::PalmgrenCombined(PalmgrenCombined {
                    law,
                    radial_factor,
                    axial_factor: equivalent_load
                        .axial_factor(kind, *contact_angle)
                        .ok_or("no contact angle under axial load is given")?,
                    static_radial_factor: radial,
                    static_axial_factor: axial,
                }))
            }
            Moment::Skf {
                series,
                bore_diameter,
                outer_diameter,
                viscosity,
                supply,
                oil,
                drag_variable,
                seal_moment,
                ..
            } => SkfBearing {
                kind: bearing.kind.skf_type(),
                series,
                bore: *bore_diameter,
                outer_diameter: *outer_diameter,
                // only rollers in an oil bath have a width in this law
                width: 0.0,
                static_load_rating: bearing.static_load_rating,
                ceramic_balls: bearing.ball_material == BallMaterial::SiliconNitride,
            }
            .moment(&SkfLubricant {
                viscosity: *viscosity,
                supply: *supply,
                oil: *oil,
                drag_variable: *drag_variable,
                seal_moment: *seal_moment,
            })
            .map(Friction::Skf)
            .map_err(|refusal| refusal.to_string()),
            Moment::Measured { curve } => {
                let points: Vec<(f64, f64)> = curve.iter().map(|row| (row[0], row[1])).collect();
                MomentCurve::through(&points)
                    .map(Friction::Curve)
                    .map_err(|error| error.to_string())
            }
        }
    }

    /// Viscosity that the law sees, m²/s.
    pub fn viscosity(&self) -> Option<f64> {
        match self {
            Moment::Palmgren { viscosity, .. } | Moment::Skf { viscosity, .. } => Some(*viscosity),
            Moment::None | Moment::Measured { .. } => None,
        }
    }

    /// The same law with another lubricant, where it sees one.
    pub fn with_viscosity(&self, other: f64) -> Moment {
        let mut moment = self.clone();
        if let Moment::Palmgren { viscosity, .. } | Moment::Skf { viscosity, .. } = &mut moment {
            *viscosity = other;
        }
        moment
    }

    /// The SKF model with a drag of its oil; none where it has one already, or no bath or jet of oil.
    pub fn with_drag_variable(&self, variable: f64) -> Option<Moment> {
        let mut moment = self.clone();
        match &mut moment {
            Moment::Skf {
                supply: SkfSupply::OilBath | SkfSupply::LowOilBathOrJet,
                drag_variable,
                ..
            } if *drag_variable == 0.0 => *drag_variable = variable,
            _ => return None,
        }
        Some(moment)
    }

    /// Axial load that the law sees, N.
    pub fn axial_load(&self) -> f64 {
        match self {
            Moment::Palmgren { axial_load, .. } | Moment::Skf { axial_load, .. } => *axial_load,
            Moment::None | Moment::Measured { .. } => 0.0,
        }
    }
}

impl MomentShare {
    pub(crate) fn from_values(values: &Values) -> MomentShare {
        let moment = values.section("bearing.moment");
        // where nothing is shared these have no meaning
        MomentShare {
            orbit_share: moment.maybe("orbit_share").unwrap_or(0.5),
            reference_spin: moment.maybe("reference_spin").unwrap_or(1.0),
            scale: moment.maybe("scale").unwrap_or(1.0),
        }
    }
}

impl AccelerationLoss {
    pub(crate) fn from_values(values: &Values) -> AccelerationLoss {
        let loss = values.section("bearing.acceleration_loss");
        let rows = |name| loss.rows(name).unwrap_or_default();
        match loss.chosen("kind").unwrap_or(LossKind::None) {
            LossKind::None => AccelerationLoss::None,
            LossKind::Constant => AccelerationLoss::Constant {
                force: loss.number("force"),
            },
            LossKind::Proportional => AccelerationLoss::Proportional {
                per_acceleration: loss.number("per_acceleration"),
            },
            LossKind::OverSpeed => AccelerationLoss::OverSpeed {
                force_over_speed: rows("force_over_speed"),
            },
            LossKind::Affine => AccelerationLoss::Affine {
                force_over_speed: rows("force_over_speed"),
                per_acceleration_over_speed: rows("per_acceleration_over_speed"),
            },
        }
    }
}
