//! Dynamic stiffness of the mounts of a drop or a machine over frequency, part by part, and a fit of spring, damper and Maxwell branches to a
//! measured one.
//!
//! ```text
//!   F = -K s,  s ~ e^{jωt},  K = K' + jK'',  loss factor K''/K'
//! ```
//! A squeeze film is its damping for small motion about its middle, a friction ring its first harmonic at one amplitude along a line, a hard stop
//! absent within its gap. Nothing is integrated in time.

pub mod fit;

use fit::{Fit, MeasuredStiffness};
use model::auxiliary_bearing::AuxiliaryBearingConstants;
use model::mount::{DynamicStiffness, Mount, MountParts};
use outcome::columns::{Columns, columns};
use outcome::list::{List, origins, results};
use outcome::{Column, Outcome, Picture, Stop, Work};
use problem::Code;
use scenario::{Scenario, problem_at};
use simulate::drop::build::auxiliary_bearings;
use units::number_text;

/// Frequencies of the curves without a table, rad/s, and their number.
const BAND: [f64; 2] = [1.0, 1e4];
const POINTS: usize = 161;

/// What is asked of the mounts of a file.
pub struct Request {
    /// Amplitude of the friction rings, m.
    pub amplitude: f64,
    /// A measured dynamic stiffness, to which branches are fitted.
    pub table: Option<MeasuredStiffness>,
}

problem::warnings! {
    /// Of mounts at small motion.
    pub enum MountWarning {
        AtAmplitude { amplitude: "m", parts: words } "AB2049" Uncertain
            ("The stiffness is that of small motion about the rest position: {parts}.");
        PoorFit { error: "1" } "AB2060" Uncertain
            ("Spring, damper and branches differ from the measured stiffness by up to {:.1} % of its size: one relaxation time a decade does not describe it, or it is noisy.", 100.0 * error);
    }
}

/// A part of a mount.
struct Part {
    name: String,
    /// Its dynamic stiffness over frequency, rad/s.
    law: Box<dyn Fn(f64) -> DynamicStiffness>,
}

impl Part {
    fn new(name: &str, law: impl Fn(f64) -> DynamicStiffness + 'static) -> Self {
        let (name, law) = (name.to_string(), Box::new(law));
        Self { name, law }
    }
}

/// The parts of a mount that are there, at a motion of an amplitude, m.
fn parts(spring: &Mount<f64>, given: &MountParts, amplitude: f64) -> Vec<Part> {
    let own = *spring;
    let law = move |frequency: f64| own.dynamic_stiffness(frequency);
    let mut out = vec![Part::new("spring_damper", law)];
    for (number, branch) in (1..).zip(given.branches.clone()) {
        let law = move |frequency: f64| branch.dynamic_stiffness(frequency);
        out.push(Part::new(&format!("branch_{number}"), law));
    }
    if let Some(ring) = &given.ring {
        let own = ring.harmonic(amplitude);
        out.push(Part::new("ring", move |_| own));
    }
    if let Some(film) = &given.film {
        let damping = film.small_damping();
        let law = move |frequency: f64| DynamicStiffness {
            storage: 0.0,
            loss: frequency * damping,
        };
        out.push(Part::new("film", law));
    }
    out
}

/// A mount with what its results are about.
struct Whole<'a> {
    constants: &'a AuxiliaryBearingConstants,
    parts: Vec<Part>,
    frequencies: &'a [f64],
}

impl Whole<'_> {
    /// Race to housing; to the ground with a housing that yields.
    fn sum(&self, frequency: f64) -> DynamicStiffness {
        let each = self.parts.iter().map(|own| (own.law)(frequency));
        let between = each.fold(DynamicStiffness::default(), |sum, own| sum + own);
        match &self.constants.mount_parts.housing {
            Some(housing) => between.in_series(housing.dynamic_stiffness(frequency)),
            None => between,
        }
    }

    fn loss_factor(&self, frequency: f64) -> f64 {
        let own = self.sum(frequency);
        own.loss / own.storage
    }

    /// Frequency of the largest loss factor.
    fn largest_loss(&self) -> Result<f64, String> {
        let stiff = |frequency: &f64| self.sum(*frequency).storage > 0.0;
        let all = self.frequencies.iter().copied().filter(stiff);
        let none = || "the mount has no stiffness at any of the frequencies".to_string();
        all.max_by(|a, b| self.loss_factor(*a).total_cmp(&self.loss_factor(*b)))
            .ok_or_else(none)
    }
}

results! {
    fn of_mount(setup: &(), run: &Whole) {
        "*.stiffness_low": number "N/m" headline, SUM, "K' of the mount at the lowest frequency" in mounts "K' lowest" => run.sum(run.frequencies[0]).storage;
        "*.stiffness_high": number "N/m" headline, SUM, "K' of the mount at the highest frequency" in mounts "K' highest" => run.sum(run.frequencies[run.frequencies.len() - 1]).storage;
        "*.largest_loss_factor": number "" headline, SUM, "largest loss factor K''/K' of the mount" in mounts "largest loss factor" => run.largest_loss().map(|at| run.loss_factor(at));
        "*.largest_loss_frequency": number "rad/s", SUM, "frequency of the largest loss factor" in mounts "at" => run.largest_loss();
    }

    fn of_fit(table: &MeasuredStiffness, run: &Fit) {
        "fit.stiffness": number "N/m" headline, FIT, "stiffness of the spring" in fit "stiffness" => run.stiffness;
        "fit.damping": number "N s/m" headline, FIT, "damping" in fit "damping" => run.damping;
        "fit.branch_stiffness": list "N/m", FIT, "stiffness of each branch" in fit_branches "stiffness" => run.branches.iter().map(|own| own.stiffness).collect::<Vec<_>>();
        "fit.branch_time": list "s", FIT, "relaxation time of each branch" in fit_branches "time" => run.branches.iter().map(|own| 1.0 / own.rate).collect::<Vec<_>>();
        "fit.worst_error": number "1" headline, FIT, "largest distance to the table over the size of its stiffness" in fit "worst error" => run.worst(table);
        "fit.mean_error": number "1" headline, FIT, "root mean square of these distances" in fit "mean error" => run.mean(table);
        "fit.decades": number "" headline, FIT, "decades of frequency that the table covers" in fit "decades" => table.decades();
        "fit.lines": text "", FIT, "lines for [mount]" in fit "for [mount]" in fit_lines "for [mount]" => run.lines();
    }
}

origins! {
    SUM: law "K = k + jωc + Σ k_j jωτ_j/(1 + jωτ_j) + ring + film; in series with a housing",
        source "crates/model/src/mount/mod.rs; book/src/theory/drop.md, mounts",
        valid "small motion; ring at the amplitude asked for, stop within its gap";
    FIT: law "least squares of (K_fit - K)/|K| over k, c and k_j, none negative, with relaxation times of whole decades within the table",
        source "crates/analyse/src/mount/fit.rs; Lawson and Hanson 1974 (from memory)",
        valid "frequencies of the table";
}

/// Computes the dynamic stiffness of each mount and the fit.
///
/// # Errors
/// Files without a mount, and tables of fewer points than a fit has unknowns.
pub fn run(scenario: &Scenario, request: &Request) -> problem::Result<Outcome> {
    let system = scenario.system.name();
    let Some(drop) = scenario.drop() else {
        let found = format!("system = \"{}\"", system.word());
        let needed = "a file with a mount is needed: system = \"drop\" or \"machine\"";
        return Err(problem_at(Code::UnknownWord, "system", found, needed));
    };
    let bearings = auxiliary_bearings(drop)?;
    let fit = request.table.as_ref().map(Fit::of);
    let last = (POINTS - 1) as f64;
    let even = |k: usize| BAND[0] * (BAND[1] / BAND[0]).powf(k as f64 / last);
    let frequencies: Vec<f64> = match &request.table {
        Some(table) => table.rows.iter().map(|row| row.frequency).collect(),
        None => (0..POINTS).map(even).collect(),
    };
    let (mut list, mut warnings) = (List::default(), Vec::new());
    let mut table = Columns::over(&frequencies);
    columns! { table, |row| "frequency": "rad/s", "frequency of the motion" => *row; }
    for constants in &bearings {
        let mount = Whole {
            parts: parts(&constants.mount, &constants.mount_parts, request.amplitude),
            constants,
            frequencies: &frequencies,
        };
        let name = match constants.name.as_str() {
            "" => "mount",
            name => name,
        };
        for part in &mount.parts {
            push(&mut table, &format!("{name}.{}", part.name), &part.law);
        }
        push(&mut table, &format!("{name}.sum"), &|own| mount.sum(own));
        list.named(&[name], |list| of_mount(list, &(), Some(&mount)));
        warnings.extend(at_amplitude(constants, request.amplitude).map(|own| own.of_part(name)));
    }
    if let (Some(measured), Some(fit)) = (&request.table, &fit) {
        of_fit(&mut list, measured, Some(fit));
        let rows = measured.rows.iter();
        let each = |own: fn(&DynamicStiffness) -> f64| {
            rows.clone().map(|row| own(&row.stiffness)).collect()
        };
        let mut column = |name: &str, meaning: &str, values: Vec<f64>| {
            table.list.push(Column {
                name: name.to_string(),
                unit: "N/m",
                meaning: meaning.to_string(),
                optional: false,
                values,
            });
        };
        column(
            "measured.storage",
            "K' of the table",
            each(|own| own.storage),
        );
        column("measured.loss", "K'' of the table", each(|own| own.loss));
        push(&mut table, "fit", &|own| fit.at(own));
        let error = fit.worst(measured);
        if error > 0.05 {
            warnings.push(MountWarning::PoorFit { error }.into());
        }
    }
    Ok(Outcome {
        system: "mount",
        title: scenario
            .title
            .clone()
            .unwrap_or_else(|| "Mounts".to_string()),
        quantities: list.quantities,
        history: table.list,
        warnings,
        stop: Stop {
            reason: "finished",
            time: 0.0,
            text: "Everything asked for was computed.".to_string(),
        },
        pictures: vec![Picture {
            bearing: String::new(),
            clearance: None,
            pressure_limit: None,
            rolling_cage_ratio: 0.0,
            balls: 0,
        }],
        work: Work {
            members: 1,
            ..Work::default()
        },
        ..Outcome::default()
    })
}

/// Adds K', K'' and the loss factor of a part.
fn push(table: &mut Columns<f64>, name: &str, law: &dyn Fn(f64) -> DynamicStiffness) {
    columns! { table, |row|
        "{name}.storage": "N/m", "K' of {name}" => law(*row).storage;
        "{name}.loss": "N/m", "K'' of {name}" => law(*row).loss;
        "{name}.loss_factor": "1", "loss factor K''/K' of {name}" => law(*row).loss / law(*row).storage;
    }
}

/// What is not linear in a mount, and how it counts.
fn at_amplitude(own: &AuxiliaryBearingConstants, amplitude: f64) -> Option<outcome::Warning> {
    let parts = &own.mount_parts;
    let text = number_text((amplitude * 1e9).round() * 1e-3);
    let all = [
        (
            parts.ring.is_some(),
            format!("the friction ring is its first harmonic at {text} um along a line"),
        ),
        (
            parts.film.is_some(),
            "the squeeze film is its damping at the centre".to_string(),
        ),
        (parts.stop.is_some(), "the hard stop is not met".to_string()),
    ];
    let there: Vec<String> = all
        .into_iter()
        .filter(|own| own.0)
        .map(|own| own.1)
        .collect();
    let parts = there.join(", ");
    (!there.is_empty()).then(|| MountWarning::AtAmplitude { amplitude, parts }.into())
}
