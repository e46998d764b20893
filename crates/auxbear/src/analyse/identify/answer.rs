//! Named results of an identification: the steady moment, the map of F, the explanations; those of each test on their own
//! page.

use crate::analyse::identify::found::Found;
use crate::analyse::identify::per_test;
use crate::analyse::identify::read::Asked;
use crate::result::list::{List, Origin};
use crate::result::outcome::{Quantity, Value};
use identify::coasting::Windage;
use identify::explain::{self, Conclusion, Explanation};
use identify::moment::{Form, Moment};
use identify::slip::{Established, SlipSettings};
use statistics::uncertain::Uncertain;

/// Speeds at which the steady moment is listed.
const CURVE_POINTS: usize = 60;
/// Speeds and accelerations of the map.
const MAP_POINTS: usize = 24;

/// All named results; what was not asked for has none.
pub(crate) fn quantities(asked: &Asked, found: &Found) -> Vec<Quantity> {
    let mut list = List::default();
    verdict(&mut list, found);
    moment(&mut list, found);
    for (number, test) in found.tests.iter().enumerate() {
        let given = asked.tests.iter().find(|given| given.name == test.name);
        let cage = given.is_some_and(|given| given.signals.cage.is_some());
        per_test::name(&mut list, number + 1, test, &found.set, cage);
    }
    map(&mut list, found);
    if asked.rotor.is_some() {
        rotor(&mut list, found);
    }
    list.quantities
}

fn word(form: Form) -> &'static str {
    match form {
        Form::Palmgren => "palmgren",
        Form::Skf => "skf",
        Form::Spline => "spline",
    }
}

fn text_or(value: Result<String, String>) -> Value {
    match value {
        Ok(text) => Value::Text(text),
        Err(why) => Value::None { why },
    }
}

fn list_or(value: Result<Vec<f64>, String>) -> Value {
    match value {
        Ok(list) => Value::List(list),
        Err(why) => Value::None { why },
    }
}

fn verdict(list: &mut List, found: &Found) {
    let verdict = found.verdict.as_ref();
    let conclusion = verdict
        .map_err(Clone::clone)
        .map(|verdict| match &verdict.conclusion {
            Conclusion::Supported(explanation) => explanation.name().to_string(),
            Conclusion::Undecided(left) => {
                let names: Vec<&str> = left.iter().map(|left| left.name()).collect();
                format!("undecided: {}", names.join(", or "))
            }
            Conclusion::NoneOfThese => "none of these".to_string(),
        });
    list.push("explanation", "", text_or(conclusion), &VERDICT);
    let limits = verdict.map_err(Clone::clone).map(|_| slip_limits(found));
    list.push("explanation_slip_limit", "", text_or(limits), &VERDICT);
    for explanation in Explanation::ALL {
        let name = format!("probability_of_{}", explanation.name().replace(' ', "_"));
        let of = verdict.map_err(Clone::clone);
        let assessment = of.map(|verdict| verdict.of(explanation).probability);
        list.number(&name, "1", assessment, &VERDICT);
    }
    let parameters = verdict.map_err(Clone::clone).map(|verdict| {
        let best = verdict.best();
        let values = best.parameters.iter().map(|p| {
            let unit = if p.unit == "1" { "" } else { p.unit };
            let value = Uncertain::new(p.mean, p.deviation);
            format!("{} {value} {unit}", p.name)
        });
        let values: Vec<String> = values.map(|text| text.trim_end().to_string()).collect();
        let name = best.explanation.name();
        let form = match best.form == name {
            true => name.to_string(),
            false => format!("{name} ({})", best.form),
        };
        match values.is_empty() {
            true => form,
            false => format!("{form}: {}", values.join("; ")),
        }
    });
    list.push("explanation_parameters", "", text_or(parameters), &VERDICT);
    let fit = verdict.map_err(Clone::clone).and_then(|verdict| {
        let fit = verdict.best().fit.map(|fit| fit.probability);
        fit.ok_or_else(|| "it fits nowhere in the range of its parameters".to_string())
    });
    list.number("explanation_fit_probability", "1", fit, &FIT);
    let effective = verdict.map_err(Clone::clone);
    let effective = effective.map(|verdict| verdict.effective_means);
    list.number("explanation_effective_data", "", effective, &MEANS);
    let next = found.next.as_ref().map_err(Clone::clone);
    let named = next.map(|candidates| {
        let lines = candidates.iter().take(5).enumerate().map(|(k, candidate)| {
            format!(
                "{}. {} ({:.0} % of what is open): {}",
                k + 1,
                candidate.proposal.name(),
                1e2 * candidate.share,
                candidate.proposal.difference()
            )
        });
        lines.collect::<Vec<_>>().join("\n")
    });
    list.push("next_tests", "", text_or(named), &NEXT);
}

/// From which slip on the comparison calls it slip, beside the narrower limit of the slip itself.
fn slip_limits(found: &Found) -> String {
    let least = 1e2 * explain::Settings::default().least_slip;
    let limit = 1e2 * SlipSettings::default().limit;
    let never = found.tests.iter().filter(
        |test| matches!(&test.slip, Ok(slip) if matches!(slip.established, Established::Never)),
    );
    let names: Vec<&str> = never.map(|test| test.name.as_str()).collect();
    let tests = match names.is_empty() {
        true => String::new(),
        false => format!("; by that one {} never came to roll", names.join(", ")),
    };
    format!(
        "a slip of the cage below {least} % counts as rolling among the explanations; slip_probability and rolling_established_at count from {limit} % on{tests}"
    )
}

fn moment(list: &mut List, found: &Found) {
    let moment = found.moment.as_ref().map_err(Clone::clone);
    let best = moment
        .clone()
        .map(|moment| word(moment.best().form).to_string());
    list.push("steady_moment_form", "", text_or(best), &EVIDENCE);
    for form in [Form::Palmgren, Form::Skf, Form::Spline] {
        let probability = moment.clone().and_then(|moment| {
            let fit = moment.forms.iter().find(|fit| fit.form == form);
            fit.map(|fit| fit.probability)
                .ok_or_else(|| "this form was not fitted".to_string())
        });
        let name = format!("probability_of_{}_form", word(form));
        list.number(&name, "1", probability, &EVIDENCE);
    }
    let parameters = moment.clone().map(|moment| {
        let fits = moment.forms.iter().map(|fit| {
            let values = fit.parameters.iter().map(|p| {
                let unit = if p.unit == "1" { "" } else { p.unit };
                format!("{} {} {unit}", p.name, p.value)
            });
            let values: Vec<String> = values.map(|text| text.trim_end().to_string()).collect();
            format!("{}: {}", word(fit.form), values.join("; "))
        });
        fits.collect::<Vec<_>>().join("\n")
    });
    list.push("steady_moment_parameters", "", text_or(parameters), &CURVE);
    let largest = moment
        .clone()
        .and_then(|moment| largest_correlation(moment).ok_or_else(|| "one parameter".to_string()));
    list.number("largest_parameter_correlation", "1", largest, &CURVE);
    let speeds = moment.clone().map(|moment| {
        let (from, to) = moment.curve.range();
        let speed = |k: usize| from + (to - from) * k as f64 / (CURVE_POINTS - 1) as f64;
        (0..CURVE_POINTS).map(speed).collect::<Vec<f64>>()
    });
    let of_speeds = |pick: fn(Uncertain) -> f64| {
        let moment = found.moment.as_ref().map_err(Clone::clone)?;
        let at = |speed: &f64| moment.curve.at(*speed).map_or(f64::NAN, pick);
        Ok::<Vec<f64>, String>(speeds.clone()?.iter().map(at).collect())
    };
    let (values, deviations) = (of_speeds(|u| u.value), of_speeds(|u| u.deviation));
    list.push(
        "steady_moment_speeds",
        "rad/s",
        list_or(speeds.clone()),
        &CURVE,
    );
    list.push("steady_moments", "N m", list_or(values), &CURVE);
    list.push(
        "steady_moment_deviations",
        "N m",
        list_or(deviations),
        &CURVE,
    );
    let windage = |pick: fn(&Windage, f64) -> Option<f64>| {
        let windage = found.windage.as_ref();
        let windage = windage.ok_or_else(|| "no slow test takes a windage out".to_string())?;
        let at = |speed: &f64| pick(windage, *speed).unwrap_or(f64::NAN);
        Ok::<Vec<f64>, String>(speeds.clone()?.iter().map(at).collect())
    };
    if found.windage.is_some() {
        let values = windage(|windage, speed| windage.at(speed));
        let deviations = windage(|w, speed| w.covariance(speed, speed).map(f64::sqrt));
        list.push("windage_torques", "N m", list_or(values), &WINDAGE);
        list.push("windage_deviations", "N m", list_or(deviations), &WINDAGE);
    }
    let (speeds, torques) = measured_curve(found);
    list.push(
        "coast_down_speeds",
        "rad/s",
        Value::List(speeds),
        &COAST_DOWN,
    );
    list.push(
        "coast_down_torques",
        "N m",
        Value::List(torques),
        &COAST_DOWN,
    );
    list.number(
        "effective_steady_data",
        "",
        moment.map(|moment| moment.effective_data),
        &WORTH,
    );
}

fn largest_correlation(moment: &Moment) -> Option<f64> {
    let rows = &moment.best().correlation;
    let mut largest: Option<f64> = None;
    for (i, row) in rows.iter().enumerate() {
        for value in &row[..i] {
            if largest.is_none_or(|most| value.abs() > most.abs()) {
                largest = Some(*value);
            }
        }
    }
    largest
}

/// Torque over speed as the slow tests measured it: means of equal parts of their time.
fn measured_curve(found: &Found) -> (Vec<f64>, Vec<f64>) {
    const PARTS: usize = 300;
    let (mut speeds, mut torques) = (Vec::new(), Vec::new());
    for test in &found.coast_downs {
        let length = test.time.len().div_ceil(PARTS).max(1);
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        for (speed, torque) in test.speed.chunks(length).zip(test.torque.chunks(length)) {
            speeds.push(mean(speed));
            torques.push(mean(torque));
        }
    }
    (speeds, torques)
}

fn map(list: &mut List, found: &Found) {
    let grid = found.map.as_ref().map_err(Clone::clone).map(|map| {
        let largest = |pick: fn(&identify::loss::LossPoint) -> f64| {
            let points = found
                .tests
                .iter()
                .filter_map(|test| test.loss.as_ref().ok());
            let points = points.flat_map(|loss| &loss.points);
            points
                .filter(|point| point.friction.is_some())
                .map(|point| pick(point).abs())
                .fold(0.0, f64::max)
        };
        let (speed, acceleration) = (largest(|p| p.speed), largest(|p| p.acceleration));
        let mut rows: [Vec<f64>; 5] = Default::default();
        for i in 0..MAP_POINTS {
            for k in 0..MAP_POINTS {
                let part = |index: usize| index as f64 / (MAP_POINTS - 1) as f64;
                let (speed, acceleration) = (part(i) * speed, part(k) * acceleration);
                let place = map.at(speed, acceleration);
                let values = [
                    speed,
                    acceleration,
                    place.friction.value,
                    place.friction.deviation,
                    f64::from(u8::from(place.known)),
                ];
                for (row, value) in rows.iter_mut().zip(values) {
                    row.push(value);
                }
            }
        }
        rows
    });
    for (index, (name, unit)) in [
        ("loss_map_speeds", "rad/s"),
        ("loss_map_accelerations", "rad/s^2"),
        ("loss_map_friction", "N"),
        ("loss_map_deviations", "N"),
        ("loss_map_known", ""),
    ]
    .into_iter()
    .enumerate()
    {
        let values = grid.clone().map(|rows| rows[index].clone());
        list.push(name, unit, list_or(values), &MAP);
    }
}

fn rotor(list: &mut List, found: &Found) {
    let rotor = found.rotor.as_ref().map_err(Clone::clone);
    let mean = rotor.clone().map(|rotor| rotor.mean().friction);
    per_test::uncertain(list, "rotor_friction_coefficient", "1", mean, &ROTOR);
    let points = rotor.map(|rotor| rotor.over_slip(20));
    for (name, unit, pick) in [
        (
            "rotor_friction_slips",
            "m/s",
            (|p| p.slip.value) as fn(&identify::rotor_friction::FrictionPoint) -> f64,
        ),
        ("rotor_friction_slip_deviations", "m/s", |p| {
            p.slip.deviation
        }),
        ("rotor_friction_coefficients", "1", |p| p.friction.value),
        ("rotor_friction_deviations", "1", |p| p.friction.deviation),
    ] {
        let values = points
            .clone()
            .map(|points| points.iter().map(pick).collect());
        list.push(name, unit, list_or(values), &ROTOR);
    }
}

const VERDICT: Origin = Origin {
    law: "posterior probability among seven explanations: ln Z = w ln L(θ*) + ln p(θ*) + (k/2) ln 2π - ½ ln det H, w = N_eff/N; no odds beyond exp(N_eff); decided from identify.explanations.decide_at on",
    source: "Kass and Raftery 1995 (Laplace's method), crates/identify/src/evidence.rs",
    valid: "the explanations listed, one at a time, with the priors of crates/identify/src/explain/prior.rs",
};
const FIT: Origin = Origin {
    law: "probability of a χ² of data and parameters at least as large, where the explanation is true with parameters drawn from its priors",
    source: "crates/identify/src/explain/mod.rs",
    valid: "of the most probable explanation; below 0.1 % none of these fits; near 1 where the bands of the signals are wider than their errors",
};
const MEANS: Origin = Origin {
    law: "N_eff = N/(1 + 2 Σ r_j), r_j autocorrelation of what the most probable explanation leaves of N means",
    source: "crates/identify/src/evidence.rs",
    valid: "errors that the tests share (zero, scale, level of M) are taken out before",
};
const NEXT: Origin = Origin {
    law: "expected reduction of the entropy over the explanations",
    source: "crates/identify/src/explain/next_test.rs",
    valid: "an approximation: each candidate is predicted by draws of each explanation that is left",
};
const EVIDENCE: Origin = Origin {
    law: "ln Z = w ln L(θ*) + ln p(θ*) + (k/2) ln 2π - ½ ln det H of each form, w = N_eff/N; no odds beyond exp(N_eff)",
    source: "Kass and Raftery 1995 (Laplace's method), crates/identify/src/evidence.rs",
    valid: "between the smallest and the largest speed of the slow tests",
};
const WORTH: Origin = Origin {
    law: "N_eff = N/(1 + 2 Σ r_j), r_j autocorrelation of what the most probable form leaves of N means",
    source: "crates/identify/src/evidence.rs",
    valid: "few where what is left of the best form changes as slowly as the curve itself",
};
const CURVE: Origin = Origin {
    law: "M(Ω) of the most probable form, with the band of its noise, zero, form and scale",
    source: "Kass and Raftery 1995 (marginal likelihood), crates/identify/src/moment/mod.rs",
    valid: "between the smallest and the largest speed of the slow tests; parameters correlate, the curve counts",
};
const WINDAGE: Origin = Origin {
    law: "what brakes the shaft without the bearing, at the speeds of the steady moment; it is no part of M",
    source: "crates/identify/src/coasting.rs",
    valid: "the same shaft, gas and other bearings in both runs",
};
const COAST_DOWN: Origin = Origin {
    law: "means of speed and torque over equal parts of each slow test",
    source: "the measurement",
    valid: "the torque with the inertia of balls and cage in it, as measured",
};
const MAP: Origin = Origin {
    law: "F = F0(Ω) + F1(Ω)|Ω̇| by a Gaussian process over all tests where the balls are known to roll",
    source: "crates/identify/src/loss/map.rs",
    valid: "where data are near (known = 1): they give F there to within a quarter of M over its arm, whatever F is",
};
const ROTOR: Origin = Origin {
    law: "μ = (I_I Ω̇ + t_I)/(R_0 W) over whole turns of the rotor, at the mean slip u = (R_0 - c0) ω - R_0 Ω of each",
    source: "the source paper, (18); crates/identify/src/rotor_friction.rs",
    valid: "while the rotor slides and lies on the race with the weight given",
};
