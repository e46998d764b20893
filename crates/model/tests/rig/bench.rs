//! A rig like that of the source paper, and its runs.

use crate::machines::{planar_bearing, settings, vec2};
use model::auxiliary_bearing::RaceConstants;
use model::bearing::{
    BearingConstants, PlanarConstants, RollingConstants, SharedMoment, SteadyMoment,
};
use model::system::machine::RotorMachine;
use model::system::machine::record::Record;
use model::system::machine::simulate::{Runs, simulate};
use model::system::rig::{
    Arm, ClutchDrive, Disturbance, Drag, Drive, Flywheel, HeatNode, Housing, Motor, Program,
    RigConstants, Tap,
};
use model::table::Table;
use physics::palmgren::Palmgren;
use solve::{Ending, Steps, Stop};
use std::sync::atomic::AtomicBool;

/// Speed of the paper's tests, rad/s.
pub const SPEED: f64 = 150.0;
/// Dead weight, N.
pub const LOAD: f64 = 24.0;

/// The 6005 ball by ball, greased: nothing drags from the ground.
pub fn balls() -> PlanarConstants {
    let mut bearing = planar_bearing();
    bearing.ball.orbit_drag = 0.0;
    bearing.ball.spin_drag = 0.0;
    let pitch = bearing.ball.inner_track + bearing.ball.radius;
    bearing.cage_mass = 8e-3;
    // (7) lets the cage turn on the circle of the ball centres
    bearing.cage_inertia = bearing.cage_mass * pitch * pitch;
    bearing.moment = Some(SharedMoment {
        law: SteadyMoment::Palmgren(Palmgren {
            viscous_factor: 2.0,
            viscosity: 100e-6,
            pitch_diameter: 36e-3,
            load_factor: 9e-4,
            load_exponent: 0.55,
            static_load_rating: 6550.0,
            preload: 0.0,
        }),
        axial_load: 0.0,
        orbit_share: 0.5,
        reference_spin: 1.0,
    });
    bearing
}

/// The same bearing with balls that roll.
pub fn rolls() -> RollingConstants {
    RollingConstants::of(&balls())
}

/// The same without any friction.
pub fn frictionless() -> RollingConstants {
    RollingConstants {
        moment: SteadyMoment::None,
        ..rolls()
    }
}

/// Either fidelity.
pub fn fidelities() -> [BearingConstants; 2] {
    [
        BearingConstants::Rolling(rolls()),
        BearingConstants::Planar(balls()),
    ]
}

/// The rig, its housing under dead weight.
pub fn rig(bearing: BearingConstants, program: Program) -> RigConstants {
    let clutch = ClutchDrive {
        flywheel: Flywheel {
            inertia: 0.05,
            belt_drag: Drag {
                constant: 0.05,
                viscous: 1e-4,
                reference_speed: 0.5,
            },
        },
        motor: Motor {
            gain: 0.5,
            torque_limit: 3.0,
        },
        support_drag: Drag {
            constant: 5e-3,
            viscous: 2e-5,
            reference_speed: 0.5,
        },
        program,
    };
    let housing = Housing {
        mass: 2.0,
        centre_held: false,
        // 20.7 Hz: 2 % in 0.1 s
        arm: Arm {
            natural_frequency: 130.0,
            damping_ratio: 39.1 / 130.0,
            disturbance: Disturbance {
                amplitude: 2e-3,
                reference_speed: SPEED,
                exponent: 2.0,
                phase: 0.3,
            },
        },
        heat: HeatNode {
            capacity: 60.0,
            conductance: 0.3,
            thermocouple_lag: 2.0,
        },
    };
    RigConstants {
        race: RaceConstants {
            mass: 0.0,
            inertia: 1e-4,
            centre_held: true,
            torque: 0.0,
        },
        load_direction: vec2(0.0, -1.0),
        gravity: vec2(0.0, -9.81),
        bearing,
        drive: Drive::Clutch(Box::new(clutch)),
        load: Table::constant(LOAD),
        housing: Some(housing),
        warm: None,
        target_speed: SPEED,
    }
}

/// Flywheel, clutch and what is done.
pub fn clutch(constants: &mut RigConstants) -> &mut ClutchDrive {
    match &mut constants.drive {
        Drive::Clutch(clutch) => clutch,
        other => panic!("{other:?}"),
    }
}

/// The housing.
pub fn housing(constants: &mut RigConstants) -> &mut Housing {
    constants.housing.as_mut().expect("it has one")
}

/// The same, concentric: balls without weight, the housing held.
pub fn concentric(mut bearing: BearingConstants, program: Program) -> RigConstants {
    if let BearingConstants::Planar(planar) = &mut bearing {
        planar.ball.gravity = vec2(0.0, 0.0);
    }
    let mut constants = rig(bearing, program);
    housing(&mut constants).centre_held = true;
    constants
}

/// Without anything that drags on flywheel and shaft from the frame.
pub fn without_drag(mut constants: RigConstants) -> RigConstants {
    clutch(&mut constants).flywheel.belt_drag = Drag::NONE;
    clutch(&mut constants).support_drag = Drag::NONE;
    constants
}

/// A finished run.
pub struct Finished {
    pub machine: RotorMachine,
    pub start: Vec<f64>,
    pub ending: Ending,
    pub record: Record,
}

/// Runs a rig to an end, with a hundred rows.
pub fn run(constants: RigConstants, end: f64, tolerance: f64) -> Finished {
    run_with(constants, end, tolerance, &[])
}

/// The same with taps.
pub fn run_with(constants: RigConstants, end: f64, tolerance: f64, taps: &[Tap]) -> Finished {
    let machine = RotorMachine::on_rig(constants).expect("the rig can be built");
    let mut record = Record::with_taps(&machine, end, Some(end / 100.0), taps);
    let never = AtomicBool::new(false);
    let settings = settings(end, tolerance);
    let runs = Runs {
        machines: &[&machine],
        starts: &[machine.start()],
        settings,
        steps: Steps::Explicit,
        interrupt: &never,
    };
    let ending = simulate(runs, &mut [&mut record]).remove(0);
    record.finish(&machine, ending.time, &ending.state);
    assert_eq!(ending.stop, Stop::Finished);
    assert!(ending.state.iter().all(|value| value.is_finite()));
    Finished {
        start: machine.start(),
        machine,
        ending,
        record,
    }
}

impl Finished {
    /// The last state.
    pub fn end(&self) -> &[f64] {
        &self.ending.state
    }
    /// Residual of the energy over what was turned over.
    pub fn energy_residual(&self) -> f64 {
        let balance = self.machine.balance(&self.start, self.end());
        let turned_over = balance.heat().max(balance.work_size());
        balance.energy_residual() / turned_over
    }
    /// Residuals of angular momentum: of balls and cage, of the whole rig, N m s.
    pub fn momentum_residuals(&self) -> [f64; 2] {
        let (start, end) = (&self.start, self.end());
        [
            self.machine.bearing_momentum_residual(start, end),
            self.machine.balance(start, end).angular_momentum_residual(),
        ]
    }
    /// What a kind of heat has summed up, J.
    pub fn heat(&self, index: usize) -> f64 {
        self.end()[self.machine.layout().heat(index)]
    }
}
