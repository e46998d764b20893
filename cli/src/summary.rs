//! What is printed after a run: where it is, the quantities most looked for, cost.

use crate::digits::four_digits;
use crate::{console, torque_tables};
use auxbear::result::outcome::{Outcome, Quantity, Value};
use std::path::Path;

/// The quantities most looked for in a drop; those a run does not have say why in the report.
const OF_DROP: &[&str] = &[
    "time_to_first_contact",
    "first_impact_force",
    "peak_contact_force",
    "contact_count",
    "whirl_direction",
    "inner_race_time_to_95_percent",
    "peak_hertz_pressure",
    "dissipated_energy",
    "energy_residual",
];
/// The same in a spin-up.
const OF_SPIN_UP: &[&str] = &[
    "inner_race_time_to_95_percent",
    "cage_time_to_95_percent_of_rolling",
    "peak_inner_race_moment",
    "peak_outer_race_moment",
    "law_moment_at_end",
    "traction_capacity",
    "balls_skid",
    "bearing_dissipated_energy",
    "outer_race_energy_exact",
    "outer_race_energy_corrected",
    "outer_race_energy_printed",
    "energy_residual",
];

/// The same in a measurement.
const OF_SIGNALS: &[&str] = &[
    "channels",
    "pulse_count",
    "pulses_repaired_share",
    "peak_speed",
    "engagement_time",
    "peak_acceleration",
    "peak_acceleration_deviation",
    "sensor_frequency",
    "peak_torque",
    "median_torque_deviation",
    "largest_synchronous_disturbance",
    "median_cage_slip",
    "median_cage_slip_deviation",
];

const OF_RIG: &[&str] = &[
    "engagement_time",
    "clutch_torque_rate",
    "clutch_lock_time",
    "peak_acceleration",
    "shaft_final_speed",
    "peak_clutch_torque",
    "peak_outer_race_moment",
    "cage_slip_at_end",
    "peak_temperature_rise",
    "bearing_dissipated_energy",
    "energy_residual",
    "angular_momentum_residual",
    "clipped_channels",
];
const OF_IDENTIFY: &[&str] = &[
    "explanation",
    "explanation_parameters",
    "explanation_fit_probability",
    "steady_moment_form",
    "rotor_friction_coefficient",
    "rotor_friction_coefficient_deviation",
];
/// Of each test of an identification.
const OF_TESTS: &[&str] = &[
    "name",
    "peak_acceleration",
    "excess_torque_settled",
    "excess_torque_settled_deviation",
    "excess_torque_at_end",
    "excess_torque_at_end_deviation",
    "dissipated_energy",
    "dissipated_energy_deviation",
    "slip_probability",
];
/// What an identification ends with.
const NEXT_TESTS: &str = "next_tests";

/// Units for people: SI unit, then units from large to small with their value in SI.
const UNITS: &[(&str, &[(&str, f64)])] = &[
    ("s", &[("s", 1.0), ("ms", 1e-3), ("µs", 1e-6), ("ns", 1e-9)]),
    ("m", &[("m", 1.0), ("mm", 1e-3), ("µm", 1e-6), ("nm", 1e-9)]),
    ("N", &[("kN", 1e3), ("N", 1.0), ("mN", 1e-3), ("µN", 1e-6)]),
    (
        "Pa",
        &[("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3), ("Pa", 1.0)],
    ),
    ("N m", &[("N m", 1.0), ("N mm", 1e-3)]),
    ("J", &[("kJ", 1e3), ("J", 1.0), ("mJ", 1e-3), ("µJ", 1e-6)]),
];

/// The text printed after a run.
pub fn text(path: &Path, outcome: &Outcome) -> String {
    let mut rows = Vec::new();
    let names = match outcome.system {
        "torque" => return torque_tables::text(path, outcome),
        "spin_up" => OF_SPIN_UP,
        "signals" => OF_SIGNALS,
        "rig" => OF_RIG,
        "identify" => OF_IDENTIFY,
        _ => OF_DROP,
    };
    let pictures = outcome.pictures.iter();
    let bearings: Vec<&str> = pictures.map(|picture| picture.bearing.as_str()).collect();
    for &name in names {
        // of several bearings each has the result under its name; of the whole machine there is one
        for bearing in &bearings {
            let of = |q: &&Quantity| match q.name.strip_prefix(bearing) {
                Some(rest) if !bearing.is_empty() => rest.strip_prefix('.') == Some(name),
                _ => q.name == name && *bearing == bearings[0],
            };
            let mut known = outcome.quantities.iter();
            if let Some(quantity) = known.find(|q| of(q) && !not_asked_for(q)) {
                let name = quantity.name.replace(['_', '.'], " ");
                rows.push([format!("  {name}"), value(quantity)]);
            }
        }
    }
    for quantity in &outcome.quantities {
        let of_test = quantity
            .name
            .strip_prefix("test_")
            .and_then(|name| name.split_once('.'));
        if of_test.is_some_and(|(_, name)| OF_TESTS.contains(&name)) {
            let name = quantity.name.replace(['_', '.'], " ");
            rows.push([format!("  {name}"), value(quantity)]);
        }
    }
    let mut text = format!("{}\n{}", outcome.title, console::table(&rows));
    let next = outcome.quantities.iter().find(|q| q.name == NEXT_TESTS);
    if let Some(Value::Text(next)) = next.map(|q| &q.value) {
        text.push_str("the next test, the most telling first:\n");
        for line in next.lines() {
            text.push_str(&format!("  {line}\n"));
        }
    }
    if outcome.quantities.iter().any(|q| q.spread.is_some()) {
        text.push_str(
            "± is one standard deviation over the perturbed starts (repeat.*): chaos, not tolerances of the machine\n",
        );
    }
    let work = &outcome.work;
    text.push_str(&format!(
        "{} in {:.2} s{}\n",
        match work.members {
            1 => "1 run".to_string(),
            members if outcome.members.len() < members => {
                format!("{} of {members} runs", outcome.members.len())
            }
            members => format!("{members} runs"),
        },
        work.seconds,
        match outcome.system {
            "signals" | "identify" => String::new(),
            _ => format!(", {} steps", work.steps),
        }
    ));
    text.push_str(&format!("{}\n", path.join("report.html").display()));
    text
}

/// Whether a quantity needs a channel or another file that the file does not name.
fn not_asked_for(quantity: &Quantity) -> bool {
    let absent = [".channel is not given", ".file is not given"];
    matches!(&quantity.value, Value::None { why } if absent.iter().any(|end| why.ends_with(end)))
}

fn value(quantity: &Quantity) -> String {
    let text = match &quantity.value {
        Value::Number(number) => readable(*number, quantity.unit),
        Value::List(list) => format!("{} values", list.len()),
        Value::Text(text) => text.clone(),
        Value::None { why } => format!("none: {why}"),
    };
    match &quantity.spread {
        Some(spread) => format!(
            "{text} (mean {} ± {} of {} runs)",
            readable(spread.mean, quantity.unit),
            readable(spread.standard_deviation, quantity.unit),
            spread.members
        ),
        None => text,
    }
}

/// Size in SI below which nothing that is printed here differs from zero.
const ROUNDED_AWAY: f64 = 1e-15;

/// A value with four digits in the unit that keeps it between 1 and 1000, where there is one.
fn readable(si: f64, unit: &str) -> String {
    // of a quantity with a unit so little is what rounding left
    let si = match unit {
        "" | "1" => si,
        _ if si.abs() < ROUNDED_AWAY => 0.0,
        _ => si,
    };
    let units = UNITS.iter().find(|(known, _)| *known == unit);
    let units = units.map_or(&[][..], |(_, units)| units);
    let fitting = units.iter().find(|(_, size)| si.abs() >= *size);
    let (unit, size) = match fitting.or(units.last()) {
        Some((unit, size)) if si != 0.0 => (*unit, *size),
        _ => (unit, 1.0),
    };
    let number = four_digits(si / size);
    match unit {
        "" | "1" => number,
        unit => format!("{number} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_printed_in_the_unit_that_fits() {
        for (si, unit, text) in [
            (7.139_21e-3, "s", "7.139 ms"),
            (675.498, "N", "675.5 N"),
            (13_450.0, "N", "13.45 kN"),
            (3.2e9, "Pa", "3.2 GPa"),
            (-2.5e-4, "m", "-250 µm"),
            (0.0, "m", "0 m"),
            (7.767e-26, "rad/s", "0 rad/s"),
            (2e-14, "1", "2e-14"),
            (12.0, "", "12"),
            (123_456.0, "", "123456"),
            (3.21e-8, "1", "3.21e-8"),
            (1256.64, "rad/s", "1257 rad/s"),
        ] {
            assert_eq!(readable(si, unit), text);
        }
    }
}
