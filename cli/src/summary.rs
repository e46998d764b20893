//! What is printed after a run: where it is, the quantities most looked for, cost.

use crate::digits::readable;
use crate::{console, limits, torque_tables};
use auxbear::result::outcome::{Outcome, Quantity, Value};
use std::f64::consts::PI;
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
    "run_out.start_time",
    "run_out.stop_time",
    "run_out.peak_inner_race_temperature",
    "run_out.peak_lubricant_temperature",
    "run_out.smallest_clearance",
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
const OF_COAST_DOWN: &[&str] = &[
    "stop_time",
    "rotor_energy",
    "start_power",
    "peak_inner_race_temperature",
    "inner_race_limit_time",
    "inner_race_heat_to_take",
    "peak_outer_race_temperature",
    "peak_cage_temperature",
    "peak_lubricant_temperature",
    "lubricant_heat_to_take",
    "peak_housing_temperature",
    "smallest_clearance",
    "closing_time",
    "peak_ball_load",
    "peak_growth_rate",
    "life_share",
    "runs_until_ten_percent_fail",
    "relative_heat_residual",
];
const OF_IDENTIFY: &[&str] = &[
    "explanation",
    "explanation_parameters",
    "explanation_fit_probability",
    "steady_moment_form",
    "rotor_friction_coefficient",
    "rotor_friction_coefficient_deviation",
];
const OF_ROTOR: &[&str] = &[
    "mass",
    "mass_centre",
    "first_bending_frequency",
    "first_critical_speed",
    "separation_verdict",
    "first_unstable_speed",
    "largest_sag",
    "levitation.slowest_eigenvalue",
    "levitation.largest_sensitivity",
    "levitation.zone",
    "coordinates",
    "reduction_error",
];
/// Of each critical speed, place and support of a rotor.
const OF_ROTOR_PARTS: [(&str, &[&str]); 6] = [
    (
        "critical_",
        &["speed", "amplification", "separation", "verdict"],
    ),
    (
        "response.",
        &["peak_amplitude", "peak_speed", "rated_amplitude"],
    ),
    ("relative.", &["peak_amplitude", "rated_amplitude"]),
    ("force.", &["peak_amplitude", "rated_amplitude"]),
    ("load.", &[]),
    (
        "levitation.",
        &[
            "static_stiffness",
            "static_current",
            "sensitivity_peak",
            "phase_margin",
        ],
    ),
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

/// Ice point, K.
const ICE_POINT: f64 = 273.15;

/// The text printed after a run.
pub fn text(path: &Path, outcome: &Outcome) -> String {
    let mut rows = Vec::new();
    let names = match outcome.system {
        "torque" => return torque_tables::text(path, outcome),
        "spin_up" => OF_SPIN_UP,
        "signals" => OF_SIGNALS,
        "rig" => OF_RIG,
        "identify" => OF_IDENTIFY,
        "rotor" => OF_ROTOR,
        "coast_down" => OF_COAST_DOWN,
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
            if let Some(quantity) = known.find(of) {
                let name = quantity.name.replace(['_', '.'], " ");
                rows.push([format!("  {name}"), value(quantity)]);
            }
        }
    }
    rows.extend(steady(outcome));
    for quantity in &outcome.quantities {
        let of_test = quantity
            .name
            .strip_prefix("test_")
            .and_then(|name| name.split_once('.'));
        // of a deviation the value itself says why there is none
        let known = |name: &str| {
            !(name.ends_with("_deviation") && matches!(quantity.value, Value::None { .. }))
        };
        if of_test.is_some_and(|(_, name)| OF_TESTS.contains(&name) && known(name)) {
            let name = quantity.name.replace(['_', '.'], " ");
            rows.push([format!("  {name}"), value(quantity)]);
        }
    }
    if outcome.system == "rotor" {
        for quantity in &outcome.quantities {
            let part = OF_ROTOR_PARTS.iter().find(|(begin, ends)| {
                let end = quantity.name.rsplit('.').next().unwrap_or_default();
                quantity.name.starts_with(begin) && (ends.is_empty() || ends.contains(&end))
            });
            if part.is_some() && !matches!(quantity.value, Value::None { .. } | Value::List(_)) {
                let name = quantity.name.replace(['_', '.'], " ");
                rows.push([format!("  {name}"), value(quantity)]);
            }
        }
    }
    let mut text = format!("{}\n", outcome.title);
    if !outcome.stop.complete() {
        let whose = match outcome.work.members {
            1 => "",
            _ => " of the unperturbed run",
        };
        text.push_str(&format!(
            "NOT WHOLE, the values{whose} are those until it ended. {}\n",
            outcome.stop.text
        ));
    }
    if outcome.stop.complete() && outcome.stop.reason != "finished" {
        let word = outcome.stop.reason.to_uppercase();
        text.push_str(&format!("{word}. {}\n", outcome.stop.text));
    }
    text.push_str(&console::table(&rows));
    let next = outcome.quantities.iter().find(|q| q.name == NEXT_TESTS);
    if let Some(Value::Text(next)) = next.map(|q| &q.value) {
        text.push_str("the next test, the most informative first:\n");
        for line in next.lines() {
            text.push_str(&format!("  {line}\n"));
        }
    }
    text.push_str(&limits::text(outcome));
    if outcome.quantities.iter().any(|q| q.spread.is_some()) {
        let mut varied: Vec<&str> = Vec::new();
        for (path, _) in outcome.drawn.iter().flatten() {
            if !varied.contains(&path.as_str()) {
                varied.push(path);
            }
        }
        text.push_str(&match varied.is_empty() {
            true => "± is one standard deviation over the perturbed starts (repeat.*): chaos, not tolerances of the machine\n".to_string(),
            false => format!(
                "± is one standard deviation over members with sampled {} and perturbed starts (repeat.*)\n",
                varied.join(", ")
            ),
        });
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
            "signals" | "identify" | "rotor" => String::new(),
            _ => format!(", {} steps", work.steps),
        }
    ));
    text.push_str(&format!("{}\n", path.join("report.html").display()));
    text
}

/// The torque of slow runs at the lowest, middle and highest speed at which it is known.
fn steady(outcome: &Outcome) -> Vec<[String; 2]> {
    let list = |name: &str| {
        let known = outcome.quantities.iter().find(|q| q.name == name)?;
        match &known.value {
            Value::List(values) => Some(values.as_slice()),
            _ => None,
        }
    };
    let row = |(word, name): (&str, &str)| {
        let speeds = list("steady_speeds")?;
        let torques = list(&format!("steady_{word}_torques"))?;
        let deviations = list(&format!("steady_{word}_deviations"))?;
        let known: Vec<usize> = (0..torques.len())
            .filter(|k| torques[*k].is_finite())
            .collect();
        let places = [known.first(), known.get(known.len() / 2), known.last()];
        let told = places.into_iter().flatten().map(|&k| {
            format!(
                "{} ± {} at {}",
                readable(torques[k], "N m"),
                readable(deviations[k], "N m"),
                readable(speeds[k], "rad/s")
            )
        });
        let told: Vec<String> = told.collect();
        (!told.is_empty()).then(|| [format!("  {name}"), told.join("; ")])
    };
    let curves = [
        ("direct", "steady torque by the sensor"),
        ("inertial", "steady torque by the slope of the speed"),
        ("up", "steady torque while the speed rises"),
    ];
    curves.into_iter().filter_map(row).collect()
}

fn value(quantity: &Quantity) -> String {
    let text = match &quantity.value {
        // a temperature, not a rise
        Value::Number(kelvin) if quantity.name.ends_with("_temperature") => {
            format!("{:.1} °C", kelvin - ICE_POINT)
        }
        Value::Number(speed) if quantity.unit == "rad/s" => {
            let (factor, unit) = match quantity.name.ends_with("frequency") {
                true => (0.5 / PI, "Hz"),
                false => (30.0 / PI, "rpm"),
            };
            format!(
                "{} ({})",
                readable(*speed, "rad/s"),
                readable(speed * factor, unit)
            )
        }
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
