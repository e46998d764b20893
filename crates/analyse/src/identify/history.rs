//! The tests over time since their engagement, side by side.

use crate::identify::found::{Found, TestFound};
use identify::explain::TorqueMean;
use outcome::Column;
use statistics::interpolation::between;
use statistics::uncertain::Uncertain;

/// Interval in the quick part, s, and how long that lasts after the engagement.
const QUICK: f64 = 5e-4;
const QUICK_UNTIL: f64 = 0.6;
/// Interval in the slow part, s.
const SLOW: f64 = 5e-3;
/// Time shown before the engagement, s.
const BEFORE: f64 = 0.2;

/// All columns; `time` first, from the engagement of each test on.
pub(crate) fn columns(found: &Found) -> Vec<Column> {
    let times = times(&found.tests);
    let mut columns = vec![Column {
        name: "time".to_string(),
        unit: "s",
        meaning: "time since the engagement of each test, or since its start where nothing engages"
            .to_string(),
        values: times.clone(),
    }];
    for (number, test) in found.tests.iter().enumerate() {
        of_test(&mut columns, number + 1, test, found, &times);
        columns.extend(explained(number, test, found, &times));
    }
    columns
}

/// Explanations whose torque is shown beside the data: the most probable and the next best.
const SHOWN_EXPLANATIONS: usize = 2;

/// The means of torque on which the explanations were compared, and what the best ones predict for each; between means nothing.
fn explained(test: usize, shown: &TestFound, found: &Found, times: &[f64]) -> Vec<Column> {
    let Ok(verdict) = &found.verdict else {
        return Vec::new();
    };
    let begin = shown.measurement.begin();
    let means: Vec<(usize, &TorqueMean)> = (verdict.torque_means.iter().enumerate())
        .filter(|(_, mean)| mean.test == test)
        .collect();
    let column = |name: String, meaning: String, values: &dyn Fn(usize) -> f64| Column {
        name: format!("test_{}.{name}", test + 1),
        unit: "N m",
        meaning: format!("{}: {meaning}", shown.name),
        values: (times.iter())
            .map(|time| {
                let inside = |mean: &TorqueMean| (mean.from..mean.to).contains(&(begin + time));
                let at = means.iter().find(|(_, mean)| inside(mean));
                at.map_or(f64::NAN, |(place, _)| values(*place))
            })
            .collect(),
    };
    let measured = column(
        "torque_mean".to_string(),
        "mean torque t_O, on which the explanations were compared".to_string(),
        &|place: usize| verdict.torque_means[place].torque,
    );
    let predicted = (verdict.ranked().into_iter())
        .filter(|assessment| !assessment.predicted_torque.is_empty())
        .take(SHOWN_EXPLANATIONS)
        .map(|assessment| {
            column(
                format!(
                    "predicted_by.{}",
                    assessment.explanation.name().replace(' ', "_")
                ),
                format!("what \"{}\" predicts for it", assessment.explanation.name()),
                &|place: usize| assessment.predicted_torque[place],
            )
        });
    std::iter::once(measured).chain(predicted).collect()
}

fn times(tests: &[TestFound]) -> Vec<f64> {
    let longest = tests.iter().map(|test| {
        let m = &test.measurement;
        m.time.last().copied().unwrap_or(0.0) - m.begin()
    });
    let longest = longest.fold(0.0, f64::max);
    if tests.is_empty() {
        return Vec::new();
    }
    let count = |length: f64, interval: f64| (length / interval).ceil().max(0.0) as usize;
    let before = (0..count(BEFORE, SLOW)).map(|k| -BEFORE + k as f64 * SLOW);
    let quick = (0..count(QUICK_UNTIL.min(longest), QUICK)).map(|k| k as f64 * QUICK);
    let slow = (0..count(longest - QUICK_UNTIL, SLOW)).map(|k| QUICK_UNTIL + k as f64 * SLOW);
    before.chain(quick).chain(slow).collect()
}

fn of_test(
    columns: &mut Vec<Column>,
    number: usize,
    test: &TestFound,
    found: &Found,
    times: &[f64],
) {
    let m = &test.measurement;
    let begin = m.begin();
    let mut add = |name: &str, unit: &'static str, meaning: &str, values: Vec<f64>| {
        columns.push(Column {
            name: format!("test_{number}.{name}"),
            unit,
            meaning: format!("{}: {meaning}", test.name),
            values,
        });
    };
    let at = |list: &[f64]| -> Vec<f64> {
        let value = |time: &f64| between(&m.time, list, begin + time).unwrap_or(f64::NAN);
        times.iter().map(value).collect()
    };
    add("speed", "rad/s", "speed of the inner race", at(&m.speed));
    add(
        "speed_deviation",
        "rad/s",
        "its standard deviation",
        at(&m.speed_deviation),
    );
    add(
        "acceleration",
        "rad/s^2",
        "acceleration of the inner race",
        at(&m.acceleration),
    );
    add(
        "acceleration_deviation",
        "rad/s^2",
        "its standard deviation",
        at(&m.acceleration_deviation),
    );
    add(
        "torque",
        "N m",
        "torque t_O on the outer race, without the sensor's swing",
        at(&m.torque),
    );
    add(
        "torque_deviation",
        "N m",
        "its standard deviation with zero and scale",
        at(&m.torque_deviation),
    );
    if let Ok(moment) = &found.moment {
        let steady: Vec<Option<Uncertain>> = m
            .speed
            .iter()
            .map(|speed| moment.curve.at(*speed))
            .collect();
        let part = |pick: fn(&Uncertain) -> f64| -> Vec<f64> {
            let list = steady.iter().map(|u| u.as_ref().map_or(f64::NAN, pick));
            list.collect()
        };
        add(
            "steady_moment",
            "N m",
            "steady moment M at this speed, from the slow tests",
            at(&part(|u| u.value)),
        );
        add(
            "steady_moment_deviation",
            "N m",
            "its standard deviation",
            at(&part(|u| u.deviation)),
        );
    }
    if let Ok(loss) = &test.loss {
        let time: Vec<f64> = loss.points.iter().map(|point| point.time).collect();
        let mut both = |name: &str, unit, meaning: &str, list: Vec<Option<Uncertain>>| {
            if list.iter().all(Option::is_none) {
                return;
            }
            let part = |pick: fn(&Uncertain) -> f64| -> Vec<f64> {
                let list: Vec<f64> = list
                    .iter()
                    .map(|u| u.as_ref().map_or(f64::NAN, pick))
                    .collect();
                times
                    .iter()
                    .map(|t| between(&time, &list, begin + t).unwrap_or(f64::NAN))
                    .collect()
            };
            add(name, unit, meaning, part(|u| u.value));
            let deviation = format!("{name}_deviation");
            add(
                &deviation,
                unit,
                "its standard deviation",
                part(|u| u.deviation),
            );
        };
        both(
            "excess",
            "N m",
            "t_O - M: torque on the outer race beyond the steady moment",
            loss.points.iter().map(|point| point.excess).collect(),
        );
        // as for the map: with another M or another cause what is left is not F
        if test.withheld().is_none() {
            both(
                "friction",
                "N",
                "friction F of accelerated balls, their sum",
                loss.points.iter().map(|point| point.friction).collect(),
            );
        }
    }
    if let Ok(slip) = &test.slip {
        let time: Vec<f64> = slip.points.iter().map(|point| point.time).collect();
        let part = |pick: fn(&identify::slip::SlipPoint) -> f64| -> Vec<f64> {
            let list: Vec<f64> = slip.points.iter().map(pick).collect();
            times
                .iter()
                .map(|t| between(&time, &list, begin + t).unwrap_or(f64::NAN))
                .collect()
        };
        add("cage_slip", "1", "slip of the cage", part(|p| p.slip.value));
        add(
            "cage_slip_deviation",
            "1",
            "its standard deviation",
            part(|p| p.slip.deviation),
        );
        add(
            "slip_probability",
            "1",
            "probability that the cage slips by more than the limit",
            part(|p| p.slipping),
        );
    }
}
