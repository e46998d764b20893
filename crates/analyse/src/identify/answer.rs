//! Named results of an identification: the steady moment, the map of F, the explanations; those of each test on their own
//! page.

use crate::identify::estimate::{Estimate, rolling_set};
use crate::identify::per_test::{self, OfTest};
use crate::identify::read::{Request, Test};
use identify::coasting::Windage;
use identify::explain::{self, Candidate, Conclusion, Explanation, Verdict};
use identify::loss::{LossMap, LossPoint};
use identify::moment::{Form, Moment};
use identify::rotor_friction::{FrictionPoint, RotorFriction};
use identify::slip::{self, Established};
use outcome::Quantity;
use outcome::list::results;
use outcome::list::{List, origins};
use statistics::uncertain::Uncertain;

/// Speeds at which the steady moment is listed.
const CURVE_POINTS: usize = 60;
/// Speeds and accelerations of the map.
const MAP_POINTS: usize = 24;

/// All named results, of what was not asked for none; without a second argument those of any such identification.
pub(crate) fn name(asked: &Request, found: Option<&Estimate>) -> Vec<Quantity> {
    let mut list = List::default();
    verdict(&mut list, asked, found);
    for explanation in Explanation::ALL {
        list.named(&[&explanation.name().replace(' ', "_")], |list| {
            probability(list, &explanation, found);
        });
    }
    explained(&mut list, asked, found);
    best_form(&mut list, asked, found);
    for form in [Form::Palmgren, Form::Skf, Form::Spline] {
        list.named(&[word(form)], |list| form_probability(list, &form, found));
    }
    moment(&mut list, asked, found);
    // tests that can be used are numbered without gaps
    for k in 0..found.map_or(asked.tests.len(), |found| found.tests.len()) {
        let test = found.map(|found| &found.tests[k]);
        let own = |given: &&Test| test.is_none_or(|test| test.name == given.name);
        let mut given = asked.tests[k..].iter().filter(own);
        let of = OfTest {
            set: rolling_set(asked),
            cage: given.any(|given| given.signals.cage.is_some()),
        };
        list.named(&[&format!("{}", k + 1)], |list| {
            per_test::table(list, &of, test);
        });
    }
    let grid = found.map(|found| found.map.as_ref().map(|map| found.grid(map)));
    loss_map(&mut list, asked, grid.as_ref());
    if asked.rotor.is_some() {
        rotor(&mut list, asked, found);
    }
    list.quantities
}

results! {
    fn verdict(asked: &Request, run: &Estimate) {
        "explanation": text "" headline, VERDICT, "explanation that the tests support" => run.verdict().map(conclusion);
        "explanation_slip_limit": text "", VERDICT, "slip that counts as rolling" => run.verdict().map(|_| slip_limits(run));
    }

    fn probability(explanation: &Explanation, run: &Estimate) {
        "probability_of_*": number "1", VERDICT, "probability of this explanation" in explanations "*" => run.verdict().map(|verdict| verdict.of(*explanation).probability);
    }

    fn explained(asked: &Request, run: &Estimate) {
        "explanation_parameters": text "" headline, VERDICT, "parameters of the most probable explanation" => run.verdict().map(explanation_parameters);
        "explanation_fit_probability": number "1" headline, FIT, "probability of a fit at least as bad" => {
            let none = || "it fits nowhere in the range of its parameters".to_string();
            run.verdict().and_then(|verdict| verdict.best().fit.map(|fit| fit.probability).ok_or_else(none))
        };
        "explanation_effective_data": number "", MEANS, "effective number of data of the comparison" => run.verdict().map(|verdict| verdict.effective_means);
        "next_tests": text "", NEXT, "tests that would tell most" => run.next.as_ref().map(|all| next_tests(all)).map_err(Clone::clone);
    }

    fn best_form(asked: &Request, run: &Estimate) {
        "steady_moment_form": text "" headline, EVIDENCE, "most probable form of the steady moment" => run.moment().map(|moment| word(moment.best().form));
    }

    fn form_probability(form: &Form, run: &Estimate) {
        "probability_of_*_form": number "1", EVIDENCE, "probability of this form" => {
            let fit = |moment: &Moment| moment.forms.iter().find(|fit| fit.form == *form).map(|fit| fit.probability);
            run.moment().and_then(|moment| fit(moment).ok_or_else(|| "this form was not fitted".to_string()))
        };
    }

    fn moment(asked: &Request, run: &Estimate) {
        "steady_moment_parameters": text "", CURVE, "parameters of each form" => run.moment().map(form_parameters);
        "largest_parameter_correlation": number "1", CURVE, "largest correlation of two parameters" => {
            run.moment().and_then(|moment| largest_correlation(moment).ok_or_else(|| "one parameter".to_string()))
        };
        "steady_moment_speeds": list "rad/s", CURVE, "speeds of the steady moment" in steady_curve "speed" => run.curve_speeds();
        "steady_moments": list "N m", CURVE, "steady moment at these" in steady_curve "moment" => run.curve(|moment| moment.value);
        "steady_moment_deviations": list "N m", CURVE, "its standard deviations" in steady_curve "deviation" => run.curve(|moment| moment.deviation);
        "windage_torques": list "N m", WINDAGE, "torque of the windage at these" when asked.has_windage() => run.windage(|w, speed| w.at(speed));
        "windage_deviations": list "N m", WINDAGE, "its standard deviations" when asked.has_windage() => {
            run.windage(|w, speed| w.covariance(speed, speed).map(f64::sqrt))
        };
        "coast_down_speeds": list "rad/s", COAST_DOWN, "speeds of the slow tests" in steady_points "speed" => run.measured_curve().0;
        "coast_down_torques": list "N m", COAST_DOWN, "torques of the slow tests" in steady_points "torque" => run.measured_curve().1;
        "effective_steady_data": number "", WORTH, "effective number of data of the steady moment" => run.moment().map(|moment| moment.effective_data);
    }

    fn loss_map(asked: &Request, run: &Result<[Vec<f64>; 5], &String>) {
        "loss_map_speeds": list "rad/s", MAP, "speeds of the map of F" in friction_map "speed" => column(run, 0);
        "loss_map_accelerations": list "rad/s^2", MAP, "accelerations of the map of F" in friction_map "acceleration" => column(run, 1);
        "loss_map_friction": list "N", MAP, "pocket friction F there" in friction_map "friction" => column(run, 2);
        "loss_map_deviations": list "N", MAP, "its standard deviations" in friction_map "deviation" => column(run, 3);
        "loss_map_known": list "", MAP, "1 where data are near" in friction_map "known" => column(run, 4);
    }

    fn rotor(asked: &Request, run: &Estimate) {
        "rotor_friction_coefficient": number "1" headline, ROTOR, "mean coefficient of friction" in tile "Friction rotor/race" => run.rotor().map(|rotor| rotor.mean().friction.value);
        "rotor_friction_coefficient_deviation": number "1" headline, ROTOR, "its standard deviation" => run.rotor().map(|rotor| rotor.mean().friction.deviation);
        "rotor_friction_slips": list "m/s", ROTOR, "slips of rotor and race" in rotor_friction "slip" => run.over_slip(|p| p.slip.value);
        "rotor_friction_slip_deviations": list "m/s", ROTOR, "their standard deviations" => run.over_slip(|p| p.slip.deviation);
        "rotor_friction_coefficients": list "1", ROTOR, "coefficient of friction at these" in rotor_friction "coefficient" => run.over_slip(|p| p.friction.value);
        "rotor_friction_deviations": list "1", ROTOR, "its standard deviations" in rotor_friction "deviation" => run.over_slip(|p| p.friction.deviation);
    }
}

fn word(form: Form) -> &'static str {
    match form {
        Form::Palmgren => "palmgren",
        Form::Skf => "skf",
        Form::Spline => "spline",
    }
}

fn conclusion(verdict: &Verdict) -> String {
    match &verdict.conclusion {
        Conclusion::Supported(explanation) => explanation.name().to_string(),
        Conclusion::Undecided(left) => {
            let names: Vec<&str> = left.iter().map(|left| left.name()).collect();
            format!("undecided: {}", names.join(", or "))
        }
        Conclusion::NoneOfThese => "none of these".to_string(),
    }
}

/// Names with values and units in words.
fn parameters<'a>(all: impl Iterator<Item = (&'a str, Uncertain, &'a str)>) -> String {
    let words = all.map(|(name, value, unit)| {
        let unit = if unit == "1" { "" } else { unit };
        let text = format!("{name} {value} {unit}");
        text.trim_end().to_string()
    });
    words.collect::<Vec<_>>().join("; ")
}

fn explanation_parameters(verdict: &Verdict) -> String {
    let best = verdict.best();
    let all = best.parameters.iter();
    let values = parameters(all.map(|p| (p.name, Uncertain::new(p.mean, p.deviation), p.unit)));
    let name = best.explanation.name();
    let form = match best.form == name {
        true => name.to_string(),
        false => format!("{name} ({})", best.form),
    };
    match values.is_empty() {
        true => form,
        false => format!("{form}: {values}"),
    }
}

fn form_parameters(moment: &Moment) -> String {
    let fits = moment.forms.iter().map(|fit| {
        let values = parameters(fit.parameters.iter().map(|p| (&*p.name, p.value, p.unit)));
        format!("{}: {values}", word(fit.form))
    });
    fits.collect::<Vec<_>>().join("\n")
}

fn next_tests(all: &[Candidate]) -> String {
    let lines = (1..).zip(all.iter().take(5)).map(|(number, candidate)| {
        let proposal = candidate.proposal;
        let (name, difference) = (proposal.name(), proposal.difference());
        let share = 1e2 * candidate.share;
        format!("{number}. {name} ({share:.0} % of what is open): {difference}")
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// From which slip on the comparison calls it slip, beside the narrower limit of the slip itself.
fn slip_limits(found: &Estimate) -> String {
    let least = 1e2 * explain::LEAST_SLIP;
    let limit = 1e2 * slip::LIMIT;
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

/// A column of the map.
fn column(grid: &Result<[Vec<f64>; 5], &String>, index: usize) -> Result<Vec<f64>, String> {
    let rows = grid.as_ref().map_err(|why| (*why).clone())?;
    Ok(rows[index].clone())
}

impl Request<'_> {
    /// Whether a slow test takes a windage out.
    fn has_windage(&self) -> bool {
        let takes = |test: &Test| {
            let steady = test.signals.steady.as_ref();
            test.signals.torque.is_none() && steady.is_some_and(|wish| wish.windage.is_some())
        };
        self.coast_downs.iter().any(takes)
    }
}

impl Estimate {
    fn verdict(&self) -> Result<&Verdict, String> {
        self.verdict.as_ref().map_err(Clone::clone)
    }

    fn moment(&self) -> Result<&Moment, String> {
        self.moment.as_ref().map_err(Clone::clone)
    }

    fn rotor(&self) -> Result<&RotorFriction, String> {
        self.rotor.as_ref().map_err(Clone::clone)
    }

    fn over_slip(&self, value: fn(&FrictionPoint) -> f64) -> Result<Vec<f64>, String> {
        let points = self.rotor()?.over_slip(20);
        Ok(points.iter().map(value).collect())
    }

    fn curve_speeds(&self) -> Result<Vec<f64>, String> {
        let (from, to) = self.moment()?.curve.range();
        let speed = |k: usize| from + (to - from) * k as f64 / (CURVE_POINTS - 1) as f64;
        Ok((0..CURVE_POINTS).map(speed).collect())
    }

    fn curve(&self, pick: fn(Uncertain) -> f64) -> Result<Vec<f64>, String> {
        let curve = &self.moment()?.curve;
        let at = |speed: &f64| curve.at(*speed).map_or(f64::NAN, pick);
        Ok(self.curve_speeds()?.iter().map(at).collect())
    }

    fn windage(&self, pick: fn(&Windage, f64) -> Option<f64>) -> Result<Vec<f64>, String> {
        let none = || "no slow test takes a windage out".to_string();
        let windage = self.windage.as_ref().ok_or_else(none)?;
        let at = |speed: &f64| pick(windage, *speed).unwrap_or(f64::NAN);
        Ok(self.curve_speeds()?.iter().map(at).collect())
    }

    /// Torque over speed as the slow tests measured it: means of equal parts of their time.
    fn measured_curve(&self) -> (Vec<f64>, Vec<f64>) {
        const PARTS: usize = 300;
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let (mut speeds, mut torques) = (Vec::new(), Vec::new());
        for test in &self.coast_downs {
            let length = test.time.len().div_ceil(PARTS).max(1);
            speeds.extend(test.speed.chunks(length).map(mean));
            torques.extend(test.torque.chunks(length).map(mean));
        }
        (speeds, torques)
    }

    /// Speeds and accelerations up to the largest that the tests show, with F, its deviation and whether it is known there.
    fn grid(&self, map: &LossMap) -> [Vec<f64>; 5] {
        let losses = self.tests.iter().filter_map(|test| test.loss.as_ref().ok());
        let points: Vec<&LossPoint> = losses
            .flat_map(|loss| &loss.points)
            .filter(|point| point.friction.is_some())
            .collect();
        let largest = |pick: fn(&LossPoint) -> f64| {
            let sizes = points.iter().map(|point| pick(point).abs());
            sizes.fold(0.0, f64::max)
        };
        let (speed, acceleration) = (largest(|p| p.speed), largest(|p| p.acceleration));
        let part = |index: usize| index as f64 / (MAP_POINTS - 1) as f64;
        let mut rows: [Vec<f64>; 5] = Default::default();
        for place in 0..MAP_POINTS * MAP_POINTS {
            let speed = part(place / MAP_POINTS) * speed;
            let acceleration = part(place % MAP_POINTS) * acceleration;
            let at = map.at(speed, acceleration);
            let (friction, deviation) = (at.friction.value, at.friction.deviation);
            let known = f64::from(u8::from(at.known));
            let values = [speed, acceleration, friction, deviation, known];
            for (row, value) in rows.iter_mut().zip(values) {
                row.push(value);
            }
        }
        rows
    }
}

origins! {
    VERDICT: law "posterior probability among seven explanations: ln Z = w ln L(θ*) + ln p(θ*) + (k/2) ln 2π - ½ ln det H, w = N_eff/N; no odds beyond exp(N_eff); decided from identify.explanations.decide_at on",
        source "Kass and Raftery 1995 (Laplace's method), crates/identify/src/evidence.rs",
        valid "the explanations listed, one at a time, with the priors of crates/identify/src/explain/prior.rs";
    FIT: law "probability of a χ² of data and parameters at least as large, where the explanation is true with parameters drawn from its priors",
        source "crates/identify/src/explain/mod.rs",
        valid "of the most probable explanation; below 0.1 % none of these fits; near 1 where the bands of the signals are wider than their errors";
    MEANS: law "N_eff = N/(1 + 2 Σ r_j), r_j autocorrelation of what the most probable explanation leaves of N means",
        source "crates/identify/src/evidence.rs",
        valid "errors that the tests share (zero, scale, level of M) are taken out before";
    NEXT: law "expected reduction of the entropy over the explanations",
        source "crates/identify/src/explain/next_test.rs",
        valid "an approximation: each candidate is predicted by draws of each explanation that is left";
    EVIDENCE: law "ln Z = w ln L(θ*) + ln p(θ*) + (k/2) ln 2π - ½ ln det H of each form, w = N_eff/N; no odds beyond exp(N_eff)",
        source "Kass and Raftery 1995 (Laplace's method), crates/identify/src/evidence.rs",
        valid "between the smallest and the largest speed of the slow tests";
    WORTH: law "N_eff = N/(1 + 2 Σ r_j), r_j autocorrelation of what the most probable form leaves of N means",
        source "crates/identify/src/evidence.rs",
        valid "few where what is left of the best form changes as slowly as the curve itself";
    CURVE: law "M(Ω) of the most probable form, with the band of its noise, zero, form and scale",
        source "Kass and Raftery 1995 (marginal likelihood), crates/identify/src/moment/mod.rs",
        valid "between the smallest and the largest speed of the slow tests; parameters correlate, the curve counts";
    WINDAGE: law "what brakes the shaft without the bearing, at the speeds of the steady moment; it is no part of M",
        source "crates/identify/src/coasting.rs",
        valid "the same shaft, gas and other bearings in both runs";
    COAST_DOWN: law "means of speed and torque over equal parts of each slow test",
        source "the measurement",
        valid "the torque with the inertia of balls and cage in it, as measured";
    MAP: law "F = F0(Ω) + F1(Ω)|Ω̇| by a Gaussian process over all tests where the balls are known to roll",
        source "crates/identify/src/loss/map.rs",
        valid "where data are near (known = 1): they give F there to within a quarter of M over its arm, whatever F is";
    ROTOR: law "μ = (I_I Ω̇ + t_I)/(R_0 W) over whole turns of the rotor, at the mean slip u = (R_0 - c0) ω - R_0 Ω of each",
        source "the source paper, (18); crates/identify/src/rotor_friction.rs",
        valid "while the rotor slides and lies on the race with the weight given";
}
