//! What a doubt says, whom it is about, and whether an explanation may be sought in spite of it.

use super::{Doubt, Finding};
use crate::measurement::Measurement;
use problem::{note, note::Note};

/// Settled torque over M, or M over it, from which M is not of the same bearing, load and temperature: what lubricants, slip
/// and sensors do stays below it.
const FOREIGN: f64 = 2.0;

/// Part of a test above the speeds of M, from which on what the curve would be carried on to decides.
const MOSTLY: f64 = 0.05;

impl Doubt {
    pub(super) fn of(test: &Measurement, finding: Finding) -> Doubt {
        let test = Some(test.name.clone());
        Doubt { test, finding }
    }

    /// The same where a slip of the cage is known: then its count of balls is not what makes it look slow.
    pub fn beside_a_slip(mut self) -> Doubt {
        if let Finding::WrongBallCount { ratio, .. } = self.finding {
            self.finding = Finding::CageNeverRolls { ratio };
        }
        self
    }
}

impl Finding {
    /// Whether no explanation may be sought with this M: a torque that settles below half of it or above twice it would be
    /// called a sensor's fault; and so would one at speeds that the slow tests never reached.
    pub fn forbids_comparison(&self) -> bool {
        match self {
            Finding::Reversed { .. } | Finding::WrongUnit { .. } => true,
            Finding::OutsideMoment { above, .. } => *above > MOSTLY,
            Finding::ForeignSteadyMoment { ratio, .. } => {
                *ratio < 1.0 / FOREIGN || *ratio > FOREIGN
            }
            _ => false,
        }
    }

    /// What is found, as a sentence about the test.
    pub fn note(&self) -> Note {
        match self {
            Finding::Reversed { moment } => note!(
                "at steady speed the torque is {:.4} ± {:.4} N mm along the rotation, by which the bearing would drive the shaft: the sign of the reading is reversed (signals.torque.scale = \"-1 N mm\" for a channel in N mm)",
                1e3 * moment.value,
                1e3 * moment.deviation
            ),
            Finding::WrongUnit { moment, expected } => {
                let middle = (expected.0 * expected.1).sqrt();
                let (word, bound) = match *moment > middle {
                    true => ("most", expected.1),
                    false => ("least", expected.0),
                };
                note!(
                    "at steady speed the torque is {:.4} N mm, where Palmgren's law has {:.4} N mm at {} for a ball bearing of this size: the unit of the reading is wrong, by a factor of {} perhaps (signals.torque.scale, or the unit in the head of the file)",
                    1e3 * moment,
                    1e3 * bound,
                    word,
                    format!("1e{}", 3 * ((moment / middle).log10() / 3.0).round() as i32)
                )
            }
            Finding::NeverReaches { reached, wanted } => note!(
                "it reaches {:.4} rad/s, never the {:.4} rad/s at which it is to be analysed",
                reached,
                wanted
            ),
            Finding::OutsideMoment { part, range, .. } => note!(
                "it runs outside {:.4} to {:.4} rad/s, where M was measured, for {:.1} % of its time: nothing is reported there",
                range.0,
                range.1,
                100.0 * part
            ),
            Finding::ForeignSteadyMoment {
                speed,
                difference,
                ratio,
            } => note!(
                "the torque settles at {:.3} of the steady moment at {:.1} rad/s, {:.2} ± {:.2} N mm apart: the slow test belongs to another bearing, load or temperature, or the lubricant is in another state",
                ratio,
                speed,
                1e3 * difference.value,
                1e3 * difference.deviation
            ),
            Finding::LoadOfSteadyMoment { load, steady_load } => note!(
                "it was at {} N, the steady moment at {} N: M is not that of this test",
                load,
                steady_load
            ),
            Finding::MixedLoads { loads } => {
                let each: Vec<String> = (loads.iter())
                    .map(|(test, load)| format!("{test} {load} N"))
                    .collect();
                note!(
                    "tests at different loads are together: {}; M and F depend on the load, analyse each load by itself",
                    each.join("; ")
                )
            }
            Finding::WrongBallCount {
                stated,
                fits,
                ratio,
            } => note!(
                "the cage settles at {:.4} ± {:.4} of rolling with {} balls stated; {} balls would make it roll, or {:.3} times the marks per revolution that are stated",
                ratio.value,
                ratio.deviation,
                stated,
                fits,
                1.0 / ratio.value
            ),
            Finding::CageNeverRolls { ratio } => note!(
                "the cage settles at {:.4} ± {:.4} of rolling: it slips to the end, or radii, contact angle or marks per revolution are wrong",
                ratio.value,
                ratio.deviation
            ),
            Finding::TemperatureExplains {
                rise,
                expected,
                difference,
            } => note!(
                "the outer race warmed by {:.2} K, which changes the moment by {:.2} to {:.2} N mm and explains all of its {:.2} ± {:.2} N mm",
                rise,
                1e3 * expected.0,
                1e3 * expected.1,
                1e3 * difference.value,
                1e3 * difference.deviation
            ),
            Finding::NotSettled { change, over } => note!(
                "the torque still changes at the end of the hold: by {:.3} ± {:.3} N mm within {:.2} s",
                1e3 * change.value,
                1e3 * change.deviation,
                over
            ),
            Finding::TooShort { lasts, needed } => note!(
                "it holds its speed for {:.3} s; {} s are needed to see whether the torque settles",
                lasts,
                needed
            ),
        }
    }
}
