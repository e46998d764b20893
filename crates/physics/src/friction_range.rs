//! Where a friction law has been left: what a run notes.
//!
//! | law | range | source |
//! |---|---|---|
//! | Palmgren | P0 up to C0; ν n up to 1e6 mm²/s·rpm; without the combined form no axial load | as [`palmgren`](crate::palmgren) |
//! | SKF, deep groove | F_r up to C0, F_a up to ¼ C0 (½ C0 for heavier than light series and bores above 12 mm) | SKF General Catalogue (edition 6000), chapter deep groove ball bearings |
//! | SKF, angular contact | the centrifugal load S3 d_m⁴ n² up to the load of the bearing | beyond it the law extrapolates (own judgement) |
//! | curve | the measured speeds | its points |
//!
//! Not reported here: a temperature beyond the data of the oil, which [`viscosity`](crate::viscosity) knows; a load below the recommended minimum (it needs the dynamic rating), and the fading below 1 rad/s, which
//! every run passes on its way from rest.

use crate::friction::Friction;
use crate::palmgren::{Palmgren, viscosity_times_speed_mm2_s_rpm};
use crate::skf::SkfContacts;
use std::fmt;

/// Largest ν n of Palmgren's law, mm²/s · rpm.
const LARGEST_VISCOSITY_SPEED: f64 = 1e6;

/// Share of C0 that the axial load of a deep groove bearing of the light diameter series (8, 9, 0, 1) may reach.
const LARGEST_AXIAL_SHARE: f64 = 0.25;

/// Where a law is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OperatingPoint {
    /// Speed Ω, rad/s, either sign.
    pub speed: f64,
    /// Radial load, N.
    pub radial_load: f64,
    /// Axial load, N, either sign.
    pub axial_load: f64,
}

/// A quantity outside the range of a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// What it is.
    pub quantity: &'static str,
    /// Its value.
    pub value: f64,
    /// Least value of the range.
    pub least: f64,
    /// Largest value of the range.
    pub largest: f64,
    /// Unit of the three.
    pub unit: &'static str,
    /// What the law does there.
    pub consequence: &'static str,
}

impl fmt::Display for Departure {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Departure {
            quantity,
            value,
            least,
            largest,
            unit,
            consequence,
        } = self;
        let [value, least, largest] = [*value, *least, *largest].map(in_digits);
        write!(
            out,
            "{quantity} {value} {unit} is outside {least} to {largest} {unit}: {consequence}"
        )
    }
}

/// A number for people: five significant digits, four with an exponent.
fn in_digits(value: f64) -> String {
    if value == 0.0 {
        "0".to_string()
    } else if (1e-3..1e5).contains(&value.abs()) {
        let digits = 4 - value.abs().log10().floor() as i32;
        format!("{value:.*}", digits.clamp(0, 6) as usize)
    } else {
        format!("{value:.3e}")
    }
}

/// A departure where the value lies outside.
fn outside(departure: Departure) -> Option<Departure> {
    let inside = (departure.least..=departure.largest).contains(&departure.value);
    (!inside).then_some(departure)
}

impl Friction<f64> {
    /// Everything about an operating point that lies outside the range of this law.
    ///
    /// - `at`: speed and loads
    ///
    /// Source: the table of this module.
    /// Valid: always; an empty list says that nothing known was left.
    pub fn departures(&self, at: &OperatingPoint) -> Vec<Departure> {
        let speed = at.speed.abs();
        let axial = at.axial_load.abs();
        let found = match self {
            Friction::None => vec![],
            Friction::Palmgren(law) | Friction::PalmgrenPrinted(law) => vec![
                palmgren_load(law, at.radial_load),
                palmgren_speed(law, speed),
                outside(Departure {
                    quantity: "axial load",
                    value: axial,
                    least: 0.0,
                    largest: 0.0,
                    unit: "N",
                    consequence: "this form of Palmgren's law leaves it out",
                }),
            ],
            Friction::PalmgrenCombined(law) => vec![
                palmgren_load(&law.law, law.static_load(at.radial_load, axial)),
                palmgren_speed(&law.law, speed),
            ],
            Friction::Skf(law) => match law.contacts {
                SkfContacts::DeepGroove(groove) => vec![
                    outside(Departure {
                        quantity: "radial load",
                        value: at.radial_load,
                        least: 0.0,
                        largest: groove.static_load_rating,
                        unit: "N",
                        consequence: "above the static load rating the rings dent",
                    }),
                    outside(Departure {
                        quantity: "axial load",
                        value: axial,
                        least: 0.0,
                        largest: LARGEST_AXIAL_SHARE * groove.static_load_rating,
                        unit: "N",
                        consequence: "too much for light series and bores up to 12 mm; heavier ones bear half their static load rating",
                    }),
                ],
                SkfContacts::AngularContact(angular) => vec![outside(Departure {
                    quantity: "centrifugal load of the balls in the SKF model",
                    value: angular.centrifugal_load(law.mean_diameter, speed),
                    least: 0.0,
                    largest: at.radial_load.max(axial),
                    unit: "N",
                    consequence: "its moments are those of that load, extrapolated to a lightly loaded bearing",
                })],
                SkfContacts::SphericalRoller(_) => vec![],
            },
            Friction::Curve(law) => {
                let (least, largest) = law.range();
                vec![outside(Departure {
                    quantity: "speed",
                    value: speed,
                    least,
                    largest,
                    unit: "rad/s",
                    consequence: "the moment of the nearest measured speed is taken",
                })]
            }
        };
        found.into_iter().flatten().collect()
    }
}

/// The departures of several operating points, each quantity once: where it is largest.
///
/// Source: as [`Friction::departures`].
/// Valid: always.
pub fn farthest(departures: impl IntoIterator<Item = Departure>) -> Vec<Departure> {
    let mut list: Vec<Departure> = Vec::new();
    for departure in departures {
        let mut known = list.iter_mut();
        match known.find(|known| known.quantity == departure.quantity) {
            Some(known) if known.value.abs() >= departure.value.abs() => {}
            Some(known) => *known = departure,
            None => list.push(departure),
        }
    }
    list
}

fn palmgren_load(law: &Palmgren<f64>, static_load: f64) -> Option<Departure> {
    outside(Departure {
        quantity: "load",
        value: static_load,
        least: 0.0,
        largest: law.static_load_rating,
        unit: "N",
        consequence: "Palmgren's moment is extrapolated above the static load rating",
    })
}

fn palmgren_speed(law: &Palmgren<f64>, speed: f64) -> Option<Departure> {
    outside(Departure {
        quantity: "viscosity times speed",
        value: viscosity_times_speed_mm2_s_rpm(law.viscosity, speed),
        least: 0.0,
        largest: LARGEST_VISCOSITY_SPEED,
        unit: "mm²/s·rpm",
        consequence: "Palmgren's viscous moment is extrapolated",
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing_6005::{PALMGREN, SKF, SKF_GREASE};
    use crate::moment_curve::MomentCurve;
    use crate::palmgren::PalmgrenCombined;

    fn at(speed: f64, radial_load: f64, axial_load: f64) -> OperatingPoint {
        OperatingPoint {
            speed,
            radial_load,
            axial_load,
        }
    }
    fn quantities(law: &Friction<f64>, at: OperatingPoint) -> Vec<&'static str> {
        law.departures(&at)
            .into_iter()
            .map(|departure| departure.quantity)
            .collect()
    }

    #[test]
    fn palmgren() {
        let law = Friction::Palmgren(PALMGREN);
        assert_eq!(quantities(&law, at(-150.0, 80.0, 0.0)), [""; 0]);
        // 1e6/100 = 10 000 rpm = 1047.2 rad/s
        assert_eq!(
            quantities(&law, at(-1048.0, 7e3, -1.0)),
            ["load", "viscosity times speed", "axial load"]
        );
        assert_eq!(quantities(&Friction::None, at(1e9, 1e9, 1e9)), [""; 0]);
    }
    #[test]
    fn combined_palmgren_counts_the_static_equivalent_load() {
        let law = Friction::PalmgrenCombined(PalmgrenCombined {
            law: PALMGREN,
            radial_factor: -0.1,
            axial_factor: 3.36,
            static_radial_factor: 0.6,
            static_axial_factor: 0.5,
        });
        // P0 = 0.6·1000 + 0.5·12 000 = 6600 N
        assert_eq!(quantities(&law, at(100.0, 1e3, 11e3)), [""; 0]);
        assert_eq!(quantities(&law, at(100.0, 1e3, -12e3)), ["load"]);
    }
    #[test]
    fn skf_deep_groove() {
        let law = Friction::Skf(SKF.moment(&SKF_GREASE).unwrap());
        assert_eq!(quantities(&law, at(100.0, 6e3, 1.6e3)), [""; 0]);
        assert_eq!(
            quantities(&law, at(100.0, 7e3, -1.7e3)),
            ["radial load", "axial load"]
        );
    }
    #[test]
    fn curve() {
        let law = Friction::Curve(MomentCurve::through(&[(10.0, 0.02), (100.0, 0.03)]).unwrap());
        assert_eq!(quantities(&law, at(-50.0, 1e9, 1e9)), [""; 0]);
        for speed in [5.0, -101.0] {
            assert_eq!(quantities(&law, at(speed, 0.0, 0.0)), ["speed"]);
        }
    }
}
