//! What the user should know before trusting the numbers of a test on a rig.

use super::Context;
use crate::scenario::Scenario;
use crate::simulate::outcome::{Quantity, Warning};
use crate::simulate::warnings_shared::{self as shared, warning};
use model::system::rig::layout::SHAFT;

/// By how much the peak acceleration may miss the wanted one without a word.
const MISSED: f64 = 0.01;

/// All warnings of a run, the gravest first.
pub(super) fn of(scenario: &Scenario, context: &Context, quantities: &[Quantity]) -> Vec<Warning> {
    let bearing = &context.rig.bearing;
    let mut list = Vec::new();
    let speeds = context.record.rows().map(|row| row.state[SHAFT + 1].abs());
    let speed = speeds.fold(0.0, f64::max);
    list.extend(shared::skids(context.built.steady.as_ref()));
    for (name, count) in &context.clipped {
        list.push(warning(
            "AB1050",
            format!(
                "{count} values of channel {name} lie beyond the range of the converter and are clipped in the raw file."
            ),
        ));
    }
    if let (Some(wanted), Some(reached)) = (
        scenario
            .resolved
            .get("rig.peak_acceleration")
            .and_then(|value| value.value_si),
        shared::number(quantities, "peak_acceleration"),
    ) && (reached / wanted - 1.0).abs() > MISSED
    {
        list.push(warning(
            "AB1051",
            format!(
                "The peak acceleration of {reached:.4e} rad/s² is not the wanted one of {wanted:.4e} rad/s²: the clutch's \
                 ramp is found with balls that roll."
            ),
        ));
    }
    if context.rig.load.hanging_mass.is_none() {
        list.push(warning(
            "AB1052",
            "The outer race stays in the middle (rig.load.housing is concentric): the dead weight reaches the friction law, \
             not the balls, which carry their preload alone."
                .to_string(),
        ));
    }
    list.extend(shared::speed_rating(bearing, speed));
    list.extend(shared::lift_off(bearing, speed));
    if let Some(pressure) = shared::number(quantities, "peak_hertz_pressure") {
        list.extend(shared::pressure(bearing, pressure));
    }
    list.extend(shared::film_rise(&context.bearing()));
    list.extend(shared::law_range(
        bearing,
        speed,
        context.rig.load.radial_load,
    ));
    if context.ending.stop == solve::Stop::Finished {
        list.extend(shared::residual(quantities));
    }
    list.extend(shared::unscaled(context.built.steady.as_ref()));
    list.extend(shared::scale(context.built.steady.as_ref()));
    list.extend(shared::rolling(bearing));
    list.extend(shared::no_moment(bearing));
    list.extend(shared::kind(bearing));
    list.extend(shared::assumed(scenario, bearing));
    list
}
