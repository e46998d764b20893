//! Machines that differ from the reference in one thing each.

use crate::machines::{
    balance_mount, inlets, let_roll, lubricant, oil, planar, reference, separate, separations,
    tilt_contacts, vec2,
};
use model::bearing::{
    AccelerationLoss, BearingConstants, LubricantConstants, Separation, SharedMoment, SteadyMoment,
};
use model::schedule::Schedule;
use model::system::machine::{Event, RotorMachine};
use physics::palmgren::Palmgren;
use physics::traction::{DryTraction, FourParameterTraction, Traction};

/// The reference machine and its relatives: other traction laws, oil, oil that resists rolling, a brake, a drive, levitation, a
/// held race, seven balls, balls that roll, cages free to move, no cage, a race that grows, contacts at an angle, a grease
/// that builds up between films that warm.
pub fn machines() -> Vec<RotorMachine> {
    let base = || {
        let mut c = reference();
        planar(&mut c).cage_drag = 1e-6;
        c.bearings[0].inner_race.torque = 0.01;
        c.rotor.brake_torque = 0.3;
        c.schedule = Schedule::of([(0.0, Event::Brake(1.0))]);
        c
    };
    let mut peaked = base();
    planar(&mut peaked).traction = Traction::FourParameter(FourParameterTraction {
        a: -0.07,
        b: 0.35,
        c: 5.0,
        d: 0.07,
    });
    let mut dry = base();
    planar(&mut dry).traction = Traction::Dry(DryTraction {
        kinetic: 0.1,
        static_excess: 0.05,
        inverse_decay_speed: 2.0,
        inverse_reference_speed: 50.0,
    });
    let mut oiled = base();
    planar(&mut oiled).traction = oil();
    let mut seven = base();
    planar(&mut seven).balls = 7;
    balance_mount(&mut seven);
    let mut held = base();
    held.bearings[0].inner_race.centre_held = true;
    balance_mount(&mut held);
    let mut slanted = base();
    let gravity = vec2(3.0, -7.0);
    slanted.gravity = gravity;
    planar(&mut slanted).ball.gravity = gravity;
    let mut rolls = base();
    let_roll(&mut rolls);
    if let BearingConstants::Rolling(bearing) = &mut rolls.bearings[0].bearing {
        bearing.moment = SteadyMoment::Palmgren(grease());
        bearing.loss = AccelerationLoss::Proportional {
            per_acceleration: 2e-5,
        };
    }
    let mut greased = base();
    let bearing = planar(&mut greased);
    bearing.cage_drag = 0.0;
    bearing.ball.orbit_drag = 0.0;
    bearing.ball.spin_drag = 0.0;
    bearing.moment = Some(SharedMoment {
        law: SteadyMoment::Palmgren(grease()).scaled(0.9),
        axial_load: 0.0,
        orbit_share: 0.3,
        reference_spin: 2.0,
    });
    let mut grown = base();
    // 5 µm at 1000 rad/s
    planar(&mut grown).ball.inner_track_growth = 5e-12;
    let mut grown_rolling = grown.clone();
    let_roll(&mut grown_rolling);
    if let BearingConstants::Rolling(bearing) = &mut grown_rolling.bearings[0].bearing {
        bearing.moment = SteadyMoment::Palmgren(grease());
    }
    let mut tilted = base();
    tilt_contacts(planar(&mut tilted), 0.4);
    let mut resisted = oiled.clone();
    planar(&mut resisted).inlet_rolling = Some(inlets());
    let mut resisted_at_an_angle = resisted.clone();
    tilt_contacts(planar(&mut resisted_at_an_angle), 0.4);
    let separated = separations().map(|separation| {
        let mut c = base();
        separate(&mut c, separation);
        c
    });
    let separated_at_an_angle = separated.clone().map(|mut c| {
        tilt_contacts(planar(&mut c), 0.4);
        c
    });
    let mut worked = greased.clone();
    planar(&mut worked).lubricant = Some(lubricant());
    let mut worked_rolling = rolls.clone();
    if let BearingConstants::Rolling(bearing) = &mut worked_rolling.bearings[0].bearing {
        bearing.lubricant = Some(lubricant());
    }
    let mut warmed = resisted.clone();
    separate(&mut warmed, Separation::FreeCage(None));
    planar(&mut warmed).lubricant = Some(LubricantConstants {
        grease: None,
        ..lubricant()
    });
    let like_the_reference = base();
    [
        peaked,
        dry,
        seven,
        held,
        slanted,
        rolls,
        greased,
        like_the_reference,
        oiled,
        grown,
        grown_rolling,
        tilted,
    ]
    .into_iter()
    .chain(separated)
    .chain([resisted, resisted_at_an_angle])
    .chain([worked, worked_rolling, warmed])
    .chain(separated_at_an_angle)
    .enumerate()
    .map(|(i, constants)| RotorMachine::with_levitation(constants, i % 2 == 0))
    .collect()
}

/// Grease of 100 mm²/s in a 6005 of 6.55 kN.
pub fn grease() -> Palmgren<f64> {
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

/// What the state of a lubricant, from the states of its bearing, makes of the speed-dependent part, and of the traction coefficient.
pub fn lubricant_factors(slow: &Option<LubricantConstants>, part: &[f64]) -> (f64, f64) {
    let (Some(slow), [.., built, worked, rise]) = (slow, part) else {
        return (1.0, 1.0);
    };
    let of_grease = slow.grease.map_or(1.0, |grease| {
        (grease.rested_factor * (1.0 - built) + built)
            * ((1.0 - worked) + grease.worked_factor * worked)
    });
    let [drag, traction] = slow.films.map_or([1.0, 1.0], |films| {
        [films.drag_coefficient, films.traction_coefficient].map(|k| (-k * rise).exp())
    });
    (of_grease * drag, traction)
}
