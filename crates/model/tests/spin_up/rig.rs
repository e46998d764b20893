//! Machines and runs of the spin-up tests.

use crate::machines::{planar_bearing, rolling_bearing, settings, vec2};
use model::auxiliary_bearing::RaceConstants;
use model::bearing::{BearingConstants, PlanarConstants, SharedMoment, SteadyMoment};
use model::system::machine::RotorMachine;
use model::system::machine::record::Record;
use model::system::machine::simulate::{Runs, simulate};
use model::system::rig::{Drive, RigConstants};
use model::table::Table;
use physics::palmgren::Palmgren;
use solve::{Ending, Observer, Settings, Steps, Stop};
use std::sync::atomic::AtomicBool;

/// First channel of the bearing.
pub const BEARING: usize = 8;

/// Grease of 100 mm²/s in a 6005 of 6.55 kN: the bearing of `rolling.json`.
pub fn palmgren() -> Palmgren<f64> {
    Palmgren {
        viscous_factor: 2.0,
        viscosity: 100e-6,
        pitch_diameter: 36e-3,
        load_factor: 9e-4,
        load_exponent: 0.55,
        static_load_rating: 6550.0,
        preload: 0.0,
    }
}

/// The inner race of the reference machine, without weight.
pub fn race() -> RaceConstants<f64> {
    RaceConstants {
        mass: 20.4e-3,
        inertia: 3.9e-6,
        centre_held: true,
        torque: 0.0,
    }
}

/// The planar bearing with nothing from the ground: no drag, no weight.
pub fn free_bearing() -> PlanarConstants {
    let mut bearing = planar_bearing();
    bearing.ball.orbit_drag = 0.0;
    bearing.ball.spin_drag = 0.0;
    bearing.ball.gravity = vec2(0.0, 0.0);
    // (7) lets the cage turn on the circle of the ball centres
    let pitch = bearing.ball.inner_track + bearing.ball.radius;
    bearing.cage_inertia = bearing.cage_mass * pitch * pitch;
    bearing
}

/// The same with Palmgren's moment shared by its balls.
pub fn greased_bearing() -> PlanarConstants {
    let mut bearing = free_bearing();
    bearing.moment = Some(shared(SteadyMoment::Palmgren(palmgren())));
    bearing
}

/// A law shared in halves.
pub fn shared(law: SteadyMoment<f64>) -> SharedMoment {
    SharedMoment {
        law,
        axial_load: 0.0,
        orbit_share: 0.5,
        reference_spin: 1.0,
    }
}

/// A concentric machine without load.
pub fn machine(bearing: BearingConstants, drive: Drive, speed: f64) -> RigConstants {
    RigConstants {
        race: race(),
        load_direction: vec2(0.0, -1.0),
        gravity: vec2(0.0, 0.0),
        bearing,
        drive,
        load: Table::constant(0.0),
        housing: None,
        warm: None,
        target_speed: speed,
    }
}

/// The rolling bearing that corresponds to the planar one.
pub fn rolling() -> model::bearing::RollingConstants {
    rolling_bearing(&free_bearing())
}

/// Runs a machine under an observer; it must finish.
pub fn observe(
    machine: &RotorMachine,
    start: &[f64],
    settings: &Settings,
    observer: &mut dyn Observer<RotorMachine>,
) -> Ending {
    observe_by(Steps::Explicit, machine, start, settings, observer)
}

/// The same by explicit or linearly implicit steps.
pub fn observe_by(
    steps: Steps,
    machine: &RotorMachine,
    start: &[f64],
    settings: &Settings,
    observer: &mut dyn Observer<RotorMachine>,
) -> Ending {
    let never = AtomicBool::new(false);
    let runs = Runs {
        machines: &[machine],
        starts: &[start.to_vec()],
        settings: *settings,
        steps,
        interrupt: &never,
    };
    let ending = simulate(runs, &mut [observer]).remove(0);
    assert_eq!(ending.stop, Stop::Finished);
    assert!(ending.state.iter().all(|value| value.is_finite()));
    ending
}

/// Runs a machine from its start: (start, end, record).
pub fn run(constants: RigConstants, end: f64, tolerance: f64) -> Run {
    run_by(Steps::Explicit, constants, end, tolerance)
}

/// The same by explicit or linearly implicit steps.
pub fn run_by(steps: Steps, constants: RigConstants, end: f64, tolerance: f64) -> Run {
    let machine = RotorMachine::on_rig(constants).expect("the machine can be built");
    let start = machine.start();
    let mut record = Record::new(&machine, end, end / 100.0, true);
    let settings = settings(end, tolerance);
    let ending = observe_by(steps, &machine, &start, &settings, &mut record);
    record.finish(&machine, ending.time, &ending.state);
    Run {
        machine,
        start,
        end: ending.state,
        record,
        steps: ending.work.accepted,
    }
}

/// A finished run.
pub struct Run {
    pub machine: RotorMachine,
    pub start: Vec<f64>,
    pub end: Vec<f64>,
    pub record: Record,
    /// Accepted steps.
    pub steps: u64,
}
