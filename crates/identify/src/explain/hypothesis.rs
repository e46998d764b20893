//! What each explanation predicts.

use super::settings::{LEAST_EFFECT, LEAST_SETTLING, LEAST_SLIP};
use physics::lubricant_state::Grease;
use physics::rolling::RollingSet;

use super::explanation::Explanation;
use super::prior::{Range, share_of};
use super::record::{Past, Step, Trial};
use super::settings::Settings;
use super::slip::{Slip, load_moment_factor};
use super::steady::{Continued, Table};
use crate::SteadyMoment;

/// An explanation in the form that is computed: a sensor has several faults, each of one sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Hypothesis {
    Rolling,
    Grease,
    Slip,
    HeatedSlip,
    Drift { sign: f64 },
    Creep { sign: f64 },
    SlowSensor,
    WarmOil,
    AnotherMoment,
}

/// What predictions need beside parameters.
pub(crate) struct Bearing<'a> {
    /// The steady curve.
    pub steady: Continued<'a>,
    /// The same up to the highest speed of the tests, quick to read.
    pub table: Table,
    pub set: &'a RollingSet<f64>,
    /// Viscous share of the curve at the highest speed.
    pub share: Range,
    pub settings: &'a Settings,
    /// Whether a test follows another one after a rest: the recovery at rest is a parameter then.
    pub repeated: bool,
}

impl<'a> Bearing<'a> {
    /// Curve and its viscous share up to the highest speed of the tests, rad/s.
    pub fn new(
        steady: &'a SteadyMoment,
        top_speed: f64,
        set: &'a RollingSet<f64>,
        settings: &'a Settings,
        repeated: bool,
    ) -> Self {
        Self {
            steady: Continued(steady),
            repeated,
            table: Continued(steady).table(top_speed),
            set,
            share: share_of(steady, top_speed),
            settings,
        }
    }
}

/// Predicted means of all tests, test after test.
#[derive(Clone, Debug)]
pub(crate) struct Prediction {
    /// Torque, N m.
    pub torque: Vec<f64>,
    /// Cage speed, rad/s.
    pub cage: Vec<f64>,
    /// Share of the claim that it fulfils: 1 and more where it does what the explanation says.
    pub claim: f64,
}

impl Hypothesis {
    /// Prior probability of this form of its explanation: three faults of a sensor, two of them of either sign.
    pub fn weight(self) -> f64 {
        match self {
            Self::Drift { .. } | Self::Creep { .. } => 1.0 / 6.0,
            Self::SlowSensor => 1.0 / 3.0,
            _ => 1.0,
        }
    }

    /// The forms of an explanation.
    pub fn of(explanation: Explanation) -> &'static [Self] {
        match explanation {
            Explanation::Rolling => &[Self::Rolling],
            Explanation::Grease => &[Self::Grease],
            Explanation::IsothermalSlip => &[Self::Slip],
            Explanation::HeatedSlip => &[Self::HeatedSlip],
            Explanation::Sensor => &[
                Self::Drift { sign: -1.0 },
                Self::Drift { sign: 1.0 },
                Self::Creep { sign: -1.0 },
                Self::Creep { sign: 1.0 },
                Self::SlowSensor,
            ],
            Explanation::WarmOil => &[Self::WarmOil],
            Explanation::AnotherMoment => &[Self::AnotherMoment],
        }
    }

    /// Name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rolling => Explanation::Rolling.name(),
            Self::Grease => Explanation::Grease.name(),
            Self::Slip => Explanation::IsothermalSlip.name(),
            Self::HeatedSlip => Explanation::HeatedSlip.name(),
            Self::Drift { .. } => "drift of the sensor's zero",
            Self::Creep { .. } => "creep of the sensor",
            Self::SlowSensor => "sensor slower than stated",
            Self::WarmOil => Explanation::WarmOil.name(),
            Self::AnotherMoment => Explanation::AnotherMoment.name(),
        }
    }

    /// Sign of the effect, for forms that have two.
    pub fn sign(self) -> f64 {
        match self {
            Self::Drift { sign } | Self::Creep { sign } => sign,
            _ => 1.0,
        }
    }

    /// Predicted means at standard normal coordinates.
    pub fn predict(self, coordinates: &[f64], tests: &[Trial], bearing: &Bearing) -> Prediction {
        let values = self.values(coordinates, bearing);
        let mut prediction = Prediction {
            torque: Vec::new(),
            cage: Vec::new(),
            claim: if self == Self::Rolling { 1.0 } else { 0.0 },
        };
        let needs_slip = matches!(self, Self::Slip | Self::HeatedSlip);
        let (mut effect, mut largest_slip, mut softened) = (0.0_f64, 0.0_f64, 0.0_f64);
        for test in tests {
            let after_a_rest = test.rest_before.map(|rest| {
                // what does not recover has no parameter for it
                let recovery = self.recovery(&values, bearing).unwrap_or(f64::INFINITY);
                let (left, film) = self.left(rest, recovery, &values);
                let past = Past {
                    left,
                    film,
                    ..test.past
                };
                Trial {
                    past,
                    ..test.clone()
                }
            });
            let test = after_a_rest.as_ref().unwrap_or(test);
            let (mut torque, mut cage, more) = self.run(&values, test, bearing);
            softened = softened.max(more);
            let rolling = test.means(rolling_torque(test, bearing, 1.0));
            for (i, bin) in test.bins.iter().enumerate() {
                if bin.before {
                    torque[i] = bearing.table.at(bin.speed).0;
                    cage[i] = bearing.set.cage_speed(bin.speed);
                    continue;
                }
                effect = effect.max((torque[i] - rolling[i]).abs());
                if bin.speed > 0.5 * bearing.table.top_speed {
                    largest_slip =
                        largest_slip.max(1.0 - cage[i] / bearing.set.cage_speed(bin.speed));
                }
            }
            prediction.torque.append(&mut torque);
            prediction.cage.append(&mut cage);
        }
        if self != Self::Rolling {
            let size = effect / (LEAST_EFFECT * bearing.table.reference);
            prediction.claim = if needs_slip {
                let slip = size.min(largest_slip / LEAST_SLIP);
                if self == Self::HeatedSlip {
                    slip.min(softened / LEAST_EFFECT)
                } else {
                    slip
                }
            } else if self == Self::SlowSensor {
                size.min(values[0] / LEAST_SETTLING)
            } else if self == Self::Grease {
                // both states must show, each where the other is as it is
                let smaller = (tests.iter())
                    .map(|test| smaller_effect(self, &values, test, bearing))
                    .fold(0.0, f64::max);
                smaller / (LEAST_EFFECT * bearing.table.reference)
            } else {
                size
            };
        }
        prediction
    }

    /// The grease of the parameters; it does not recover where no test asks for the recovery.
    fn grease(self, values: &[f64], bearing: &Bearing) -> Grease<f64> {
        Grease {
            rested_factor: values[1],
            worked_factor: values[2],
            build_up_angle: values[3],
            breakdown_time: values[4],
            recovery_time: self.recovery(values, bearing).unwrap_or(f64::INFINITY),
        }
    }

    /// Means of torque and cage speed of one test, and how much traction softened in it.
    fn run(self, values: &[f64], test: &Trial, bearing: &Bearing) -> (Vec<f64>, Vec<f64>, f64) {
        let reference = bearing.table.reference;
        let rolls =
            || test.cage_means((test.steps.iter()).map(|s| bearing.set.cage_speed(s.middle_speed)));
        let fresh = 1.0 - test.past.left;
        match self {
            Self::Rolling => (test.means(rolling_torque(test, bearing, 1.0)), rolls(), 0.0),
            Self::Grease => {
                let load_moment = (1.0 - values[0]) * reference;
                let torque = rolling_torque(test, bearing, 1.0 - values[0]);
                let grease = self.grease(values, bearing);
                let factor = grease_factor(grease, test, bearing.set);
                let moments =
                    (torque.zip(&test.steps))
                        .zip(factor)
                        .map(|((torque, step), factor)| {
                            let viscous = (step.steady - load_moment * step.fading).max(0.0);
                            torque + (factor - 1.0) * viscous
                        });
                (test.means(moments), rolls(), 0.0)
            }
            Self::Slip | Self::HeatedSlip => {
                let heated = self == Self::HeatedSlip;
                let slip = Slip {
                    load_moment: (1.0 - values[0]) * reference,
                    traction_limit: values[1] * reference,
                    slip_speed: values[2],
                    orbit_share: values[3],
                    traction_softening: if heated { values[4] } else { 0.0 },
                    drag_softening: if heated { values[5] } else { 0.0 },
                    film_time: if heated { values[6] } else { 1.0 },
                };
                let course = slip.course(test, &bearing.table, bearing.set);
                (
                    test.means(course.outer_moment.iter().copied()),
                    test.cage_means(course.cage.iter().copied()),
                    course.softened,
                )
            }
            Self::Drift { sign } => {
                let drift = (test.steps.iter()).map(|step| {
                    let middle = step.elapsed - 0.5 * step.duration;
                    sign * values[0] * reference * fresh * (1.0 - (-middle / values[1]).exp())
                });
                let torque = rolling_torque(test, bearing, 1.0)
                    .zip(drift)
                    .map(|(a, b)| a + b);
                (test.means(torque), rolls(), 0.0)
            }
            Self::Creep { sign } => {
                let creep = (test.steps.iter()).map(|step| {
                    let middle = step.elapsed - 0.5 * step.duration;
                    let new = fresh * (1.0 - (-middle / values[1]).exp());
                    1.0 + sign * values[0] * (test.past.left + new)
                });
                let torque = rolling_torque(test, bearing, 1.0)
                    .zip(creep)
                    .map(|(a, b)| a * b);
                (test.means(torque), rolls(), 0.0)
            }
            Self::SlowSensor => {
                let mut reading = if test.starts_turning {
                    test.steps.first().map_or(0.0, |step| step.steady)
                } else {
                    0.0
                };
                let torque =
                    (rolling_torque(test, bearing, 1.0).zip(&test.steps)).map(|(torque, step)| {
                        let kept = (-step.duration / values[0]).exp();
                        let mean_kept = (1.0 - kept) * values[0] / step.duration;
                        let mean = torque + (reading - torque) * mean_kept;
                        reading = torque + (reading - torque) * kept;
                        mean
                    });
                (test.means(torque), rolls(), 0.0)
            }
            Self::WarmOil => {
                let load_moment = (1.0 - values[0]) * reference;
                let torque = rolling_torque(test, bearing, 1.0 - values[0]);
                let mut oil = Oil {
                    softening: values[1],
                    time: values[2],
                    power: reference * bearing.table.top_speed,
                    rise: test.past.film,
                };
                let moments = torque.zip(&test.steps).map(|(torque, step)| {
                    let load = load_moment * step.fading;
                    let viscous = (step.steady - load).max(0.0);
                    torque + (oil.drag(step, load, viscous) - 1.0) * viscous
                });
                (test.means(moments), rolls(), 0.0)
            }
            Self::AnotherMoment => {
                let torque =
                    rolling_torque(test, bearing, 1.0)
                        .zip(&test.steps)
                        .map(|(torque, step)| {
                            torque + another_moment(values, step, &bearing.table) - step.steady
                        });
                (test.means(torque), rolls(), 0.0)
            }
        }
    }
}

/// Oil that the moment warms: the stream of the balls before metal that keeps its temperature.
///
/// ```text
///   θ̇ = (P/P_0 - θ)/τ,  P = (D M0 + M1) Ω, P_0 = M(Ω0) Ω0        D = e^(-λθ)
/// ```
/// λ = ⅔ |d ln ν/dT| times the rise in balance with P_0. Source: `crates/thermal/src/bearing_network.rs`, whose lubricant node comes to
/// within a few kelvin of its lead over the metal in 2 to 7 s. Assumes: the metal keeps its temperature within a test.
struct Oil {
    softening: f64,
    time: f64,
    power: f64,
    rise: f64,
}

impl Oil {
    /// Drag factor in the middle of the next step.
    fn drag(&mut self, step: &Step, load: f64, viscous: f64) -> f64 {
        let before = (-self.softening * self.rise).exp();
        let heat = (before * viscous + load) * step.middle_speed.abs();
        let kept = (-step.duration / self.time).exp();
        let after = self.rise * kept + (1.0 - kept) * heat / self.power;
        let middle = 0.5 * (self.rise + after);
        self.rise = after;
        (-self.softening * middle).exp()
    }
}

/// Steady moment where it is not that of the slow tests, N m.
///
/// Formula: k M(Ω) + d [M(Ω0) - M(Ω)], k = ratio at Ω0; d = k (h - 1) M(Ω0/2)/[M(Ω0) - M(Ω0/2)], h = k(Ω0/2)/k(Ω0); not below 0:
/// another level and another part that does not grow with the speed, as another bearing, load, temperature or loss has
fn another_moment(values: &[f64], step: &Step, table: &Table) -> f64 {
    let (ratio, at_half) = (values[0], values[1]);
    let reference = table.reference;
    let half = table.at(0.5 * table.top_speed).0;
    // of a flat curve the parts cannot be distinguished
    let growth = (reference - half).max(0.1 * reference);
    let shifted = ratio * (at_half - 1.0) * half / growth;
    (ratio * step.steady + shifted * (reference * step.fading - step.steady)).max(0.0)
}

/// t_O of rolling balls along the steps, N m: M - J_O Ω̇.
///
/// - `load_share`: share of M that grows with the load, where the load is another one
fn rolling_torque(test: &Trial, bearing: &Bearing, load_share: f64) -> impl Iterator<Item = f64> {
    let inertia = bearing.set.outer_inertia();
    // without an explanation that knows the share, the middle of the prior
    let share = if load_share < 1.0 {
        load_share
    } else {
        1.0 - bearing.share.share(0.0)
    };
    let extra = share * bearing.table.reference * (load_moment_factor(&test.past) - 1.0);
    (test.steps.iter())
        .map(move |step| step.steady + extra * step.fading - inertia * step.acceleration)
}

/// The smaller of the largest changes of a mean torque that build-up and breakdown make, N m.
fn smaller_effect(form: Hypothesis, values: &[f64], test: &Trial, bearing: &Bearing) -> f64 {
    let load_moment = (1.0 - values[0]) * bearing.table.reference;
    let grease = form.grease(values, bearing);
    let torque = |grease: Grease<f64>| {
        let factor = grease_factor(grease, test, bearing.set);
        test.means(
            (test.steps.iter().zip(factor))
                .map(|(step, factor)| factor * (step.steady - load_moment * step.fading).max(0.0)),
        )
    };
    let both = torque(grease);
    let without_build_up = torque(Grease {
        rested_factor: 1.0,
        ..grease
    });
    let without_breakdown = torque(Grease {
        worked_factor: 1.0,
        ..grease
    });
    let largest = |other: &[f64]| {
        (both.iter().zip(other))
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max)
    };
    largest(&without_build_up).min(largest(&without_breakdown))
}

/// Drag factor of the grease along the steps, each taken in its middle: the law of
/// [`lubricant_state`](physics::lubricant_state) at the speed of the step.
fn grease_factor(
    grease: Grease<f64>,
    test: &Trial,
    set: &RollingSet<f64>,
) -> impl Iterator<Item = f64> {
    let mut breakdown = test.past.left;
    let mut build_up = if test.starts_turning { 1.0 } else { breakdown };
    let set = *set;
    (test.steps.iter()).map(move |step| {
        let cage = set.cage_speed(step.middle_speed);
        let half = 0.5 * step.duration;
        let (middle_up, middle_down) = grease.after(build_up, breakdown, cage, half);
        (build_up, breakdown) = grease.after(middle_up, middle_down, cage, half);
        grease.drag_factor(middle_up, middle_down)
    })
}

#[cfg(test)]
#[path = "../../tests/unit/explain_hypothesis.rs"]
mod tests;
