//! What the user should know before trusting the numbers of a test on a rig.

use crate::assumptions::speed_rating;
use crate::bearing::warm;
use crate::bearing::warnings as shared;
use crate::rig::Context;
use crate::rig::chain::{self, taps};
use model::system::rig::layout::SHAFT;
use outcome::{Quantity, Warning};
use scenario::{Rig, Scenario};
use std::f64::consts::TAU;

/// Fewest samples of a mark from which its passing is read.
const FEWEST_SAMPLES: f64 = 4.0;

/// By how much the peak acceleration may miss the wanted one without a word.
const MISSED: f64 = 0.01;

problem::warnings! {
    /// Of a test on a rig.
    pub enum RigWarning {
        Clipped { count: "", channel: text } "AB1050" Uncertain
            ("{count} values of channel {channel} lie beyond the range of the converter and are clipped in the raw file.");
        PeakAcceleration { reached: "rad/s^2", wanted: "rad/s^2" } "AB1051" Uncertain
            ("The peak acceleration of {reached:.4e} rad/s² is not the wanted one of {wanted:.4e} rad/s²: the clutch's ramp is found with balls that roll.");
        Concentric "AB1052" Note
            ("The outer race stays in the middle (rig.load.housing is concentric): the dead weight reaches the friction law, not the balls, which carry their preload alone.");
        FewSamples { speed: "rad/s", passing: "s", interval: "s" } "AB1053" Uncertain
            ("At {speed:.4} rad/s a mark passes the pickup every {:.3} ms, and its channel is sampled every {:.3} ms: {:.2} samples a mark, of which {FEWEST_SAMPLES} are needed to read the speed from the raw file.", 1e3 * passing, 1e3 * interval, passing / interval);
    }
}

/// All warnings of a run, the most severe first.
pub(crate) fn of(scenario: &Scenario, context: &Context, quantities: &[Quantity]) -> Vec<Warning> {
    let bearing = &context.rig.bearing;
    let mut list = Vec::new();
    let speeds = context
        .record
        .rows()
        .map(|row| row.state[SHAFT.spin()].abs());
    let speed = speeds.fold(0.0, f64::max);
    list.extend(shared::skids(context.built.steady.as_ref()));
    if let Some(followed) = context.followed() {
        let judged = warm::judged(&followed);
        list.extend(judged.into_iter().map(|(_, warning)| warning));
    }
    for (name, count) in &context.clipped {
        let (count, channel) = (*count as f64, name.to_string());
        list.push(RigWarning::Clipped { count, channel }.into());
    }
    list.extend(sampled(context.rig, speed));
    if let (Some(wanted), Some(reached)) = (
        scenario
            .resolved
            .get("rig.peak_acceleration")
            .and_then(|value| value.value_si),
        shared::number(quantities, "peak_acceleration"),
    ) && (reached / wanted - 1.0).abs() > MISSED
    {
        list.push(RigWarning::PeakAcceleration { reached, wanted }.into());
    }
    if context.rig.load.hanging_mass.is_none() {
        list.push(RigWarning::Concentric.into());
    }
    list.extend(context.bearing().hot_skid().map(|(_, warning)| warning));
    list.extend(speed_rating(bearing, speed));
    list.extend(shared::lift_off(bearing, speed));
    let pressures = shared::pressure(bearing, &context.bearing().pressures()).into_iter();
    list.extend(pressures.map(|(_, warning)| warning));
    list.extend(preload_of_rig(context.rig));
    list.extend(shared::film_rise(&context.bearing()));
    list.extend(shared::law_range(
        bearing,
        speed,
        context.rig.load.radial_load,
    ));
    list.extend(shared::residual(quantities, shared::LARGEST_RESIDUAL));
    list.extend(shared::cage_inertia(bearing));
    list.extend(shared::rolling(bearing));
    list.extend(shared::no_moment(bearing));
    list.extend(shared::moment(scenario, "", bearing));
    list.extend(shared::kind(bearing));
    list.extend(shared::assumed(scenario, None, Some(bearing)));
    list
}

/// A dead weight beyond what the axial preload holds. Where the housing stays in the middle it does not reach the balls.
pub fn preload_of_rig(rig: &Rig) -> Option<Warning> {
    rig.load.hanging_mass?;
    let load = ("dead weight", rig.load.radial_load);
    shared::preload_left(&rig.bearing, load, None)
}

/// Marks that pass more quickly than their channel is sampled.
///
/// - `speed`: largest speed of the shaft, rad/s
fn sampled(rig: &Rig, speed: f64) -> Option<Warning> {
    if !chain::analog(rig) {
        return None;
    }
    let interval = taps(rig).first()?.interval;
    let passing = TAU / (speed * rig.pickup.marks as f64);
    let warning = RigWarning::FewSamples {
        speed,
        passing,
        interval,
    };
    (passing < FEWEST_SAMPLES * interval).then(|| warning.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use scenario::{BuiltIn, System};
    use std::path::Path;

    fn shipped(sets: &[&str]) -> Rig {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/rig_test_1.toml");
        let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
        let scenario = Scenario::read(&path, &sets, &BuiltIn).expect("it is shipped");
        match scenario.system {
            System::Rig(rig) => *rig,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn marks_that_pass_between_two_samples_are_reported() {
        // four channels at 42 kHz in all, 60 marks: 7.3 samples a mark at 150 rad/s, 4 at 275 rad/s
        let rig = shipped(&[]);
        let limit = TAU * 10_500.0 / (4.0 * 60.0);
        assert!(sampled(&rig, 150.0).is_none() && sampled(&rig, 0.99 * limit).is_none());
        let warning = sampled(&rig, 20_000.0 * TAU / 60.0).expect("half a sample a mark");
        assert!(warning.text.contains("0.52 samples"), "{}", warning.text);
        assert!(sampled(&rig, 1.01 * limit).is_some());
        // a counter has no samples
        let counted = shipped(&["rig.pickup.kind=edges"]);
        assert!(sampled(&counted, 1e4).is_none());
    }
}
