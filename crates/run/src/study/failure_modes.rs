//! The ways in which auxiliary bearings fail, with the results and warnings that show each.

use super::Study;
use super::table::Table;
use outcome::{Outcome, Quantity};
use scenario::Side;
use std::f64::consts::PI;

/// A way in which auxiliary bearings fail.
pub struct FailureMode {
    /// Its name.
    pub name: &'static str,
    /// Results that show it, without the name of their bearing, with the side on which they are safe.
    results: &'static [(&'static str, Side)],
    /// Codes of warnings that tell of it.
    pub warnings: &'static [&'static str],
}

use Side::{Least, Most};

/// All of them. Source: papers on auxiliary bearings as the book's page on failures cites them; the list is not complete by any standard.
pub const FAILURE_MODES: &[FailureMode] = &[
    FailureMode {
        name: "backward whirl",
        results: &[("travel_index", Most), ("peak_contact_force", Most)],
        warnings: &["AB1014", "AB2044"],
    },
    FailureMode {
        name: "contact of rotor and stator",
        results: &[("least_distance", Least)],
        warnings: &["AB2030", "AB1097"],
    },
    FailureMode {
        name: "dents",
        results: &[("indentation_index", Most), ("static_safety", Least)],
        warnings: &["AB1002", "AB1005"],
    },
    FailureMode {
        name: "ball over a shoulder, row without load",
        results: &[
            ("shoulder_run_over_time", Least),
            ("smallest_preload", Least),
        ],
        warnings: &["AB2411", "AB2412", "AB2345"],
    },
    FailureMode {
        name: "jam of balls, cage",
        results: &[("peak_pocket_force", Most)],
        warnings: &["AB1070", "AB1015"],
    },
    FailureMode {
        name: "skid",
        results: &[("ball_slip_energy", Most), ("skid_temperature_index", Most)],
        warnings: &["AB1017", "AB2303"],
    },
    FailureMode {
        name: "overheating",
        results: &[
            ("contact_temperature_index", Most),
            ("inner_race_rise_without_cooling", Most),
            ("face_temperature_rise", Most),
        ],
        warnings: &["AB2300", "AB2301", "AB2302", "AB2310", "AB2311", "AB2416"],
    },
    FailureMode {
        name: "rolling fatigue",
        results: &[("life_share", Most)],
        warnings: &[],
    },
    FailureMode {
        name: "wear of the landing surfaces",
        results: &[("wear_depth", Most)],
        warnings: &[],
    },
];

/// The worst value of a result that shows a failure mode.
pub struct Worst<'a> {
    /// The result.
    pub result: &'a Quantity,
    /// Its worst value over all members; none where no member has one.
    pub value: Option<f64>,
    /// The member that has it.
    pub member: Option<usize>,
}

impl Study {
    /// The worst of each result that shows a failure mode: of the bearing or node that is worst.
    pub fn worst_of<'a>(&'a self, mode: &FailureMode, table: &Table) -> Vec<Worst<'a>> {
        let of = |(name, side): &(&str, Side)| {
            let size = |value: f64| if *side == Most { value } else { -value };
            let own = |known: &&Quantity| known.name.rsplit('.').next() == Some(name);
            let named = self.known.iter().filter(own);
            let worst = named.map(|result| {
                let values = table.reached(&result.name).into_iter().zip(&table.members);
                let known = values.filter_map(|(value, member)| Some((value?, *member)));
                let worst = known.max_by(|a, b| size(a.0).total_cmp(&size(b.0)));
                Worst {
                    result,
                    value: worst.map(|(value, _)| value),
                    member: worst.map(|(_, member)| member),
                }
            });
            worst.max_by(|a, b| {
                let size = |one: &Worst| one.value.map_or(f64::NEG_INFINITY, size);
                size(a).total_cmp(&size(b))
            })
        };
        mode.results.iter().filter_map(of).collect()
    }
}

/// What API 617, 9th edition, is said to ask of vibration and close clearances.
///
/// Source: quoted second hand, from open software; the text of the standard was not at hand.
/// Valid: radial vibration of compressors and expanders at their largest continuous speed.
pub struct CloseClearances {
    /// Largest continuous speed, rad/s.
    pub speed: f64,
    /// Allowed vibration, peak to peak, m.
    pub vibration: f64,
    /// Unbalance of the check of clearances, kg m.
    pub unbalance: f64,
}

impl CloseClearances {
    /// Of a rotor that was analysed.
    pub fn of(rotor: &Outcome) -> Option<CloseClearances> {
        let speed = rotor.number("rated_speed").filter(|speed| *speed > 0.0)?;
        Some(CloseClearances::at(speed, rotor.number("mass")?))
    }

    /// min(25.4, 25.4 √(12 000/N)) µm and 2 · 6350 W/N g mm of a speed and a mass, with N in rpm and W in kg.
    fn at(speed: f64, mass: f64) -> CloseClearances {
        let rpm = speed * 30.0 / PI;
        CloseClearances {
            speed,
            vibration: 25.4e-6 * (12_000.0 / rpm).sqrt().min(1.0),
            unbalance: 2.0 * 6350e-6 * mass / rpm,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 25.4 µm up to 12 000 rpm, at 48 000 rpm half of it; 10 kg at 12 700 rpm 10 g mm.
    #[test]
    fn allowed_vibration_and_unbalance_are_those_of_a_hand_calculation() {
        let of = |rpm: f64| CloseClearances::at(rpm * PI / 30.0, 10.0);
        assert!((of(48_000.0).vibration - 12.7e-6).abs() < 1e-12);
        assert!((of(6_000.0).vibration - 25.4e-6).abs() < 1e-12);
        assert!((of(12_700.0).unbalance - 10e-6).abs() < 1e-12);
    }
}
