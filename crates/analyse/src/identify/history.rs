//! The tests over time since their engagement, side by side.

use crate::identify::estimate::{Estimate, TestEstimate};
use crate::identify::read::Request;
use identify::Measurement;
use identify::explain::TorqueMean;
use identify::loss::LossPoint;
use identify::slip::SlipPoint;
use outcome::Column;
use outcome::columns::{Columns, columns};
use statistics::interpolation::between;
use statistics::uncertain::Uncertain;

/// Interval in the quick part, s, and how long that lasts after the engagement.
const QUICK: f64 = 5e-4;
const QUICK_UNTIL: f64 = 0.6;
/// Interval in the slow part, s.
const SLOW: f64 = 5e-3;
/// Time shown before the engagement, s.
const BEFORE: f64 = 0.2;

/// All columns; `time` first, from the engagement of each test on. What a test does not show has none.
pub(crate) fn columns(asked: &Request, found: Option<&Estimate>) -> Vec<Column> {
    let times = found.map_or_else(Vec::new, |found| times(&found.tests));
    let mut table = Columns::over(&times);
    columns! { table, |time| "time": "s", "time since the engagement of each test, or since its start where nothing engages" => *time; }
    let tests: Vec<(&str, Run)> = match found {
        Some(found) => (found.tests.iter())
            .map(|test| (test.name.as_str(), Some((test, found))))
            .collect(),
        None => (asked.tests.iter().map(|test| (test.name.as_str(), None))).collect(),
    };
    for (k, (name, run)) in tests.into_iter().enumerate() {
        table.optional(None, |table| {
            of_test(table, (k + 1, name), run);
            explained(table, (k + 1, name), run);
        });
    }
    table.list
}

/// A test of a run with all that was found; none before a run.
type Run<'a> = Option<(&'a TestEstimate, &'a Estimate)>;

/// Explanations whose torque is shown beside the data: the most probable and the next best.
const SHOWN_EXPLANATIONS: usize = 2;

/// The means of torque on which the explanations were compared, and what the best ones predict for each; between means nothing.
fn explained(table: &mut Columns<f64>, (number, test): (usize, &str), run: Run) {
    let verdict = run.map(|(_, found)| found.verdict.as_ref().ok());
    let begin = run.map_or(0.0, |(test, _)| test.measurement.begin());
    let all = verdict
        .iter()
        .flatten()
        .flat_map(|verdict| &verdict.torque_means);
    let means = all.enumerate().filter(|(_, mean)| mean.test + 1 == number);
    let means: Vec<(usize, &TorqueMean)> = means.collect();
    let at = |time: &f64, value: &dyn Fn(usize, &TorqueMean) -> f64| {
        let inside = |mean: &TorqueMean| (mean.from..mean.to).contains(&(begin + time));
        let at = means.iter().find(|(_, mean)| inside(mean));
        at.map_or(f64::NAN, |(place, mean)| value(*place, mean))
    };
    let predicted: Vec<(&str, &[f64])> = match verdict {
        None => vec![("*", &[])],
        Some(verdict) => (verdict.iter().flat_map(|verdict| verdict.ranked()))
            .filter(|assessment| !assessment.predicted_torque.is_empty())
            .take(SHOWN_EXPLANATIONS)
            .map(|assessment| (assessment.explanation.name(), &*assessment.predicted_torque))
            .collect(),
    };
    table.optional(verdict.map(|verdict| verdict.is_some()), |table| {
        columns! { table, |time|
            "test_{number}.torque_mean": "N m", "{test}: mean torque t_O, on which the explanations were compared"
                => at(time, &|_, mean| mean.torque);
        }
        for (words, torques) in predicted {
            let name = words.replace(' ', "_");
            columns! { table, |time|
                "test_{number}.predicted_by.{name}": "N m", "{test}: what \"{words}\" predicts for it" => at(time, &|place, _| torques[place]);
            }
        }
    });
}

fn times(tests: &[TestEstimate]) -> Vec<f64> {
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

/// Values over the time of a record with their standard deviations.
struct Course {
    time: Vec<f64>,
    values: [Vec<f64>; 2],
}

impl Course {
    fn of(points: impl Iterator<Item = (f64, Option<Uncertain>)>) -> Course {
        let none = Uncertain {
            value: f64::NAN,
            deviation: f64::NAN,
        };
        let (time, values): (Vec<f64>, Vec<Uncertain>) = points
            .map(|(time, value)| (time, value.unwrap_or(none)))
            .unzip();
        let part = |pick: fn(&Uncertain) -> f64| values.iter().map(pick).collect();
        Course {
            values: [part(|u| u.value), part(|u| u.deviation)],
            time,
        }
    }
}

/// What a test shows.
fn of_test(table: &mut Columns<f64>, (number, test): (usize, &str), run: Run) {
    let begin = run.map_or(0.0, |(test, _)| test.measurement.begin());
    let of = |time: &f64, values: fn(&Measurement) -> &Vec<f64>| {
        let m = run.map(|(test, _)| &test.measurement);
        let value = m.and_then(|m| between(&m.time, values(m), begin + time));
        value.unwrap_or(f64::NAN)
    };
    let steady = run.map(|(test, found)| {
        let (m, curve) = (&test.measurement, &found.moment.as_ref().ok()?.curve);
        let moments = m.speed.iter().map(|speed| curve.at(*speed));
        Some(Course::of(m.time.iter().copied().zip(moments)))
    });
    let lost = |value: fn(&LossPoint) -> Option<Uncertain>| {
        run.map(|(test, _)| {
            let points = &test.loss.as_ref().ok()?.points;
            let has_any = points.iter().any(|point| value(point).is_some());
            has_any.then(|| Course::of(points.iter().map(|point| (point.time, value(point)))))
        })
    };
    let excess = lost(|point| point.excess);
    // as for the map: with another M or another cause what is left is not F
    let friction = match run {
        Some((test, _)) if test.withheld().is_some() => Some(None),
        _ => lost(|point| point.friction),
    };
    let slipped = |value: fn(&SlipPoint) -> Uncertain| {
        run.map(|(test, _)| {
            let points = test.slip.as_ref().ok()?.points.iter();
            let points = points.map(|point| (point.time, Some(value(point))));
            Some(Course::of(points))
        })
    };
    let slip = slipped(|point| point.slip);
    let slipping = slipped(|point| Uncertain::exact(point.slipping));
    let at = |time: &f64, course: &Option<Option<Course>>, which: usize| {
        let own = course.as_ref().and_then(Option::as_ref);
        let value = own.and_then(|own| between(&own.time, &own.values[which], begin + time));
        value.unwrap_or(f64::NAN)
    };
    let has = |course: &Option<Option<Course>>| !matches!(course, Some(None));
    columns! { table, |time|
        "test_{number}.speed": "rad/s", "{test}: speed of the inner race" => of(time, |m| &m.speed);
        "test_{number}.speed_deviation": "rad/s", "{test}: its standard deviation" => of(time, |m| &m.speed_deviation);
        "test_{number}.acceleration": "rad/s^2", "{test}: acceleration of the inner race" => of(time, |m| &m.acceleration);
        "test_{number}.acceleration_deviation": "rad/s^2", "{test}: its standard deviation" => of(time, |m| &m.acceleration_deviation);
        "test_{number}.torque": "N m", "{test}: torque t_O on the outer race, without the sensor's swing" => of(time, |m| &m.torque);
        "test_{number}.torque_deviation": "N m", "{test}: its standard deviation with zero and scale" => of(time, |m| &m.torque_deviation);
        "test_{number}.steady_moment": "N m", "{test}: steady moment M at this speed, from the slow tests" when has(&steady)
            => at(time, &steady, 0);
        "test_{number}.steady_moment_deviation": "N m", "{test}: its standard deviation" when has(&steady) => at(time, &steady, 1);
        "test_{number}.excess": "N m", "{test}: t_O - M: torque on the outer race beyond the steady moment" when has(&excess)
            => at(time, &excess, 0);
        "test_{number}.excess_deviation": "N m", "{test}: its standard deviation" when has(&excess) => at(time, &excess, 1);
        "test_{number}.friction": "N", "{test}: friction F of accelerated balls, their sum" when has(&friction) => at(time, &friction, 0);
        "test_{number}.friction_deviation": "N", "{test}: its standard deviation" when has(&friction) => at(time, &friction, 1);
        "test_{number}.cage_slip": "1", "{test}: slip of the cage" when has(&slip) => at(time, &slip, 0);
        "test_{number}.cage_slip_deviation": "1", "{test}: its standard deviation" when has(&slip) => at(time, &slip, 1);
        "test_{number}.slip_probability": "1", "{test}: probability that the cage slips by more than the limit" when has(&slipping)
            => at(time, &slipping, 0);
    }
}
