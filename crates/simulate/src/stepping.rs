//! Which steps a run takes, explicit or linearly implicit, how large an error it allows, and what its user should know of that.

use model::bearing::tangents::Known;
use outcome::Warning;
use scenario::{Accuracy, Method, Run};
use solve::Steps;

problem::warnings! {
    /// Of the steps of a run.
    pub enum SteppingWarning {
        Tolerance { tolerance: "1", largest: "1" } "AB1123" Uncertain
            ("run.tolerance = {tolerance:e} is larger than the {largest:e} of design accuracy: the energy ledger may miss more than a millionth, and first impacts more than their spread.");
        NotImplicit { what: words } "AB1124" Uncertain ("run.method = \"implicit\" was asked for, but {what}: explicit steps were taken.");
        ShortSteps { what: words } "AB1124" Uncertain
            ("run.method = \"implicit\": {what}, so these steps are as short as explicit ones and cost several times more.");
        ScreeningExplicit { what: words } "AB1124" Uncertain
            ("run.accuracy = \"screening\" took explicit steps, because {what}: they are 1.2 to 2.5 times quicker than those of design, not several times.");
    }
}

/// Tolerance of explicit steps at screening accuracy, which are those of the extended scheme. Measured on the shipped machines: the energy
/// ledger misses up to 1e-5, as by Bogacki-Shampine at 1e-3, at 0.8 to 0.95 of the cost.
const SCREENING_EXPLICIT: f64 = 1e-2;

/// Stiffness λ/ω of sliding friction above which linearly implicit steps are the quicker ones at design accuracy, where they know all that
/// is stiff and the rotor does not bend. Measured on the reference drop: with a reference speed of traction of 0.03 m/s, 11, both cost
/// the same; at 0.025 m/s explicit ones leave 5e-6 of the energy, at 0.01 m/s, 33, they cost twice as much.
const STIFF: f64 = 10.0;
/// The same where something else binds them as it does explicit ones.
const STIFF_BOUND: f64 = 60.0;

/// Frequency of a mode of the rotor, rad/s, up to which linearly implicit steps of screening keep its energy. Measured on the rotor of the
/// test rig: with modes up to 20 000 rad/s the energy ledger misses 3e-5 at half of the steps of explicit ones, with one more below
/// 30 000 rad/s 2e-4, up to 60 000 rad/s 6e-4.
const QUICK_MODE: f64 = 20e3;

/// Names of the methods, for people.
pub(crate) const EXPLICIT: &str = "Bogacki-Shampine 3(2), explicit";
const EXTENDED: &str = "Heun 3(2) with extended stability, explicit";
pub(crate) const IMPLICIT: &str = "ROS34PW2, linearly implicit";

/// What the energy ledger may miss at screening accuracy.
pub(crate) const SCREENING_RESIDUAL: f64 = 2e-4;

/// How the steps of a run are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stepping {
    /// Explicit or linearly implicit.
    pub steps: Steps,
    /// Tolerance, where none is given.
    pub tolerance: f64,
}

/// What of a system decides its steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepRequest<'a> {
    /// Accuracy, tolerance and method that were asked for.
    pub run: &'a Run,
    /// How much of what is stiff linearly implicit steps know.
    pub known: Known,
    /// Frequency of the quickest free mode of its rotor that is a coordinate, rad/s; 0 where it does not bend.
    pub quickest_mode: f64,
    /// Tolerances of design accuracy, of explicit and of linearly implicit steps.
    pub design: [f64; 2],
    /// Tolerance of linearly implicit steps at screening accuracy.
    pub screening: f64,
}

/// The tolerance of these steps, of explicit and of linearly implicit ones.
fn of([explicit, implicit]: [f64; 2], steps: Steps) -> f64 {
    match steps {
        Steps::Explicit | Steps::Extended => explicit,
        Steps::Implicit => implicit,
    }
}

impl Stepping {
    /// Name of the method, for people.
    pub fn name(self) -> &'static str {
        match self.steps {
            Steps::Explicit => EXPLICIT,
            Steps::Extended => EXTENDED,
            Steps::Implicit => IMPLICIT,
        }
    }
}

impl StepRequest<'_> {
    /// Whether a mode of the rotor is so quick that linearly implicit steps must follow it to keep its energy.
    pub fn is_bound_by_modes(&self) -> bool {
        self.quickest_mode > QUICK_MODE
    }
    /// The steps. At design accuracy linearly implicit ones pay where friction is stiff; at screening accuracy wherever they
    /// know all that is stiff. Balls that roll have nothing stiff.
    pub fn stepping(&self, stiffness: impl FnOnce() -> f64) -> Stepping {
        let StepRequest { run, known, .. } = *self;
        let screening = run.accuracy == Accuracy::Screening;
        let all = known == Known::All && !self.is_bound_by_modes();
        let implicit = known < Known::Nothing
            && match run.method {
                Method::Explicit => false,
                Method::Implicit => true,
                // linearly implicit steps that keep the energy of quick modes are dearer than explicit ones
                Method::Auto => {
                    (screening && all) || stiffness() > if all { STIFF } else { STIFF_BOUND }
                }
            };
        let steps = match (implicit, screening) {
            (true, _) => Steps::Implicit,
            (false, true) => Steps::Extended,
            (false, false) => Steps::Explicit,
        };
        let tolerance = match (screening, steps) {
            (false, steps) => of(self.design, steps),
            (true, Steps::Implicit) => self.screening,
            (true, _) => SCREENING_EXPLICIT,
        };
        Stepping { steps, tolerance }
    }

    /// Steps that are not those that were asked for, or coarser ones than the accuracy means.
    pub fn warnings(&self, steps: Steps) -> Vec<Warning> {
        let StepRequest {
            run, known, design, ..
        } = *self;
        let mut list = Vec::new();
        if let (Accuracy::Design, Some(tolerance)) = (run.accuracy, run.tolerance)
            && let largest = of(design, steps)
            && tolerance > largest
        {
            list.push(SteppingWarning::Tolerance { tolerance, largest }.into());
        }
        let what = match known {
            Known::All if self.is_bound_by_modes() && run.method == Method::Auto => {
                "modes of the rotor above 20 000 rad/s (rotor.cutoff) bind linearly implicit steps too"
            }
            Known::All => return list,
            Known::Races => {
                "what keeps the balls apart (a free cage, its land, neighbours) has no tangents"
            }
            Known::Nothing => "balls that roll have nothing stiff",
            Known::NotControllers => "controllers of magnets have no tangents",
            Known::NotSpace => "bearings in space have no tangents",
            Known::NotMounts => "parts of a mount besides spring and damper have no tangents",
        };
        let what = what.to_string();
        let warning = match (run.method, run.accuracy) {
            (Method::Implicit, _) if known >= Known::Nothing => {
                SteppingWarning::NotImplicit { what }
            }
            (Method::Implicit, _) => SteppingWarning::ShortSteps { what },
            (Method::Auto, Accuracy::Screening) => SteppingWarning::ScreeningExplicit { what },
            _ => return list,
        };
        list.push(warning.into());
        list
    }

    /// What the energy ledger may miss.
    pub fn largest_residual(&self, at_design: f64) -> f64 {
        match self.run.accuracy {
            Accuracy::Design => at_design,
            Accuracy::Screening => SCREENING_RESIDUAL,
        }
    }
}
