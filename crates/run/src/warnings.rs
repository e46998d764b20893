//! Every warning that a run may give, from the tables of their homes.

use crate::measured::warnings::MeasuredWarning;
use analyse::identify::notes::IdentifyWarning;
use analyse::mount::MountWarning;
use analyse::rotor::warnings::RotorWarning;
use analyse::signals::warning_table::SignalsWarning;
use analyse::stiffness::warnings::StiffnessWarning;
use analyse::torque::warnings::TorqueWarning;
use outcome::Severity;
use problem::warning::Declared;
use scenario::notes::ValueWarning;
use scenario::{Body, LubricantWarning, Scenario};
use simulate::assumptions::{ASSUMED, AssumptionWarning};
use simulate::bearing::warning_table::{BearingWarning, HeatWarning, SpatialWarning};
use simulate::coast_down::warnings::CoastDownWarning;
use simulate::drop::warning_table::{DropWarning, ShaftWarning};
use simulate::levitated::LevitationWarning;
use simulate::rig::warnings::RigWarning;
use simulate::spin_up::warnings::SpinUpWarning;
use simulate::stepping::SteppingWarning;

/// Every kind of warning, home by home; kinds with one code differ in their sentences.
pub fn declared() -> impl Iterator<Item = &'static Declared> {
    of_runs().chain(StiffnessWarning::DECLARED)
}

/// Those that a run may give.
pub fn of_runs() -> impl Iterator<Item = &'static Declared> {
    let homes = [
        ValueWarning::DECLARED,
        LubricantWarning::DECLARED,
        AssumptionWarning::DECLARED,
        BearingWarning::DECLARED,
        HeatWarning::DECLARED,
        SpatialWarning::DECLARED,
        DropWarning::DECLARED,
        ShaftWarning::DECLARED,
        CoastDownWarning::DECLARED,
        SteppingWarning::DECLARED,
        SpinUpWarning::DECLARED,
        RigWarning::DECLARED,
        LevitationWarning::DECLARED,
        SignalsWarning::DECLARED,
        IdentifyWarning::DECLARED,
        RotorWarning::DECLARED,
        MountWarning::DECLARED,
        TorqueWarning::DECLARED,
        MeasuredWarning::DECLARED,
    ];
    homes.into_iter().flatten()
}

/// Those that a run of this scenario may give.
pub fn of(scenario: &Scenario) -> Vec<&'static Declared> {
    let of_others = [
        SpinUpWarning::DECLARED,
        RigWarning::DECLARED,
        SignalsWarning::DECLARED,
        IdentifyWarning::DECLARED,
        MountWarning::DECLARED,
        TorqueWarning::DECLARED,
    ];
    let of_shafts = [LevitationWarning::DECLARED, RotorWarning::DECLARED];
    let (others, shafts) = match scenario.drop().map(|drop| &drop.body) {
        None => (&[][..], &[][..]),
        Some(Body::Flexible(_)) => (&of_others[..], &[][..]),
        Some(Body::Rigid(_)) => (&of_others[..], &of_shafts[..]),
    };
    let foreign = |kind: &Declared| others.iter().chain(shafts).any(|home| home.contains(kind));
    of_runs().filter(|kind| !foreign(kind)).collect()
}

/// How severe a warning of a code is, and whether it says no more than what was assumed; a code that this version does not know is
/// uncertain.
pub fn rank(code: &str) -> (Severity, bool) {
    let kind = declared().find(|kind| kind.code == code);
    let severity = kind.map_or(Severity::Uncertain, |kind| kind.severity);
    (severity, code == ASSUMED.code)
}
