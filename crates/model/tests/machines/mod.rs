//! The reference machine of the tests, random states of it, and runs.
//!
//! A rotor of 8 kg at 12 000 rpm over a 6005 bearing (10 balls of 6.35 mm on a pitch circle of 36 mm, 2 µm of
//! interference), 0.25 mm above its inner race, the outer race on a mount of 20 N/µm. The numbers are those of the
//! reference drop of an independent implementation; 0.15 between rotor and race is arbitrary there and here.

pub mod bent;
pub mod counting;
pub mod missing;

use model::auxiliary_bearing::{AuxiliaryBearingConstants, RaceConstants};
use model::bearing::ball::{BallConstants, BallMotion};
use model::bearing::ball_pair::BallPair;
use model::bearing::ball_states::CAGE_PLACE;
use model::bearing::land::{Land, LandRace};
use model::bearing::{
    AccelerationLoss, BearingConstants, LubricantConstants, PlanarConstants, RollingConstants,
    Separation, SteadyMoment, lubricant_state, rolling::RollingBall, seat,
};
use model::contact::JournalContact;
use model::levitation::Levitation;
use model::motion::Motion;
use model::mount::{Mount, MountParts};
use model::rotor::RotorConstants;
use model::schedule::Schedule;
use model::system::machine::layout::ROTOR;
use model::system::machine::simulate::{Runs, Shape, Steps, simulate_on};
use model::system::machine::{MachineConstants, RotorMachine};
use number::{Level, Vec2};
use physics::angular_contact::spin_inertia;
use physics::film::EntrainedContact;
use physics::hertz::{BallRace, PointContact, Race};
use physics::inlet_rolling::ResistanceAtRaces;
use physics::lubricant::FVA_3;
use physics::lubricant_state::{FilmHeating, Grease};
use physics::lubricant_traction::{Asperities, LubricatedContact, STEEL_SURFACE};
use physics::materials::{BEARING_STEEL, contact_modulus};
use physics::rolling::RollingSet;
use physics::traction::{LubricatedRaces, TanhTraction, Traction};
use solve::{Ending, Flow, Observer, Settings, Step};
use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

/// First channel of the inner race of a machine's first bearing.
pub const INNER: usize = 6;
/// First channel of the outer race of a machine's only bearing.
pub const OUTER: usize = 12;
/// First channel of a machine's only bearing.
pub const BEARING: usize = 16;

/// Motion of both races of a machine's first bearing.
pub fn race_motion(machine: &RotorMachine, state: &[f64]) -> Motion<f64> {
    machine.layout().bearings[0].motion(state)
}

/// Gravity, m/s².
pub const G: f64 = 9.81;

/// A vector.
pub fn vec2(x: f64, y: f64) -> Vec2<f64> {
    Vec2::new(x, y)
}

/// The bearing, ball by ball.
pub fn planar_bearing() -> PlanarConstants {
    let (radius, mass) = (3.175e-3, 1.052_420_877_679_688_1e-3);
    PlanarConstants {
        balls: 10,
        ball: BallConstants {
            radius,
            ball_radius: radius,
            load_per_radial_force: 1.0,
            mass,
            inverse_mass: 1.0 / mass,
            inverse_inertia: 1.0 / (0.4 * mass * radius * radius),
            inner_track: 14.825e-3,
            inner_track_growth: 0.0,
            outer_track: 21.173e-3,
            inner_stiffness: 25_188_251_676.112_152,
            outer_stiffness: 22_185_150_515.377_434,
            damping_time: 2.5e-6,
            pocket_radius: 18e-3,
            pocket_gap: 0.1e-3,
            pocket_stiffness: 1e7,
            pocket_damping: 0.5,
            pocket_friction: 0.05,
            pocket_inverse_reference_speed: 1.0 / 0.1,
            orbit_drag: 2e-4,
            spin_drag: 1e-9,
            gravity: vec2(0.0, -G),
        },
        traction: Traction::Tanh(TanhTraction {
            maximum: 0.07,
            inverse_reference_speed: 1.0 / 0.1,
        }),
        separation: Separation::CentredCage,
        cage_mass: 5e-3,
        cage_inertia: 1.62e-6,
        cage_drag: 0.0,
        first_ball_angle: 0.0,
        moment: None,
        inlet_rolling: None,
        lubricant: None,
        races: None,
    }
}

/// A land of that race with that radial clearance: a cage in the bore of the outer race, or on the inner race.
pub fn land(race: LandRace, radial_clearance: f64) -> Land<f64> {
    Land {
        race,
        contact: JournalContact {
            radial_clearance,
            bore_radius: match race {
                LandRace::Inner => 16e-3 + radial_clearance,
                LandRace::Outer => 20e-3,
            },
            stiffness: 1e7,
            exponent: 1.0,
            damping: 0.5,
            friction: 0.05,
            inverse_reference_speed: 1.0 / 0.1,
        },
    }
}

/// A grease that lies beside the contacts and is worked within seconds, between films that warm.
pub fn lubricant() -> LubricantConstants {
    LubricantConstants {
        grease: Some(Grease {
            rested_factor: 0.3,
            build_up_angle: 0.7 * 2.0 * PI,
            worked_factor: 0.7,
            breakdown_time: 3.5,
            recovery_time: 600.0,
        }),
        films: Some(FilmHeating {
            heat_capacity: 0.5,
            conductance: 0.25,
            drag_coefficient: 0.03,
            traction_coefficient: 0.02,
        }),
        build_up: 0.0,
        breakdown: 0.0,
    }
}

/// The row of balls of this bearing without a cage: steel on steel.
pub fn ball_pair() -> BallPair<f64> {
    BallPair {
        radius: 3.175e-3,
        stiffness: 6.02e9,
        damping_time: 2.5e-6,
        friction: 0.05,
        inverse_reference_speed: 1.0 / 0.1,
    }
}

/// What may keep the balls apart, besides a centred cage.
pub fn separations() -> [Separation<f64>; 4] {
    [
        Separation::FreeCage(Some(land(LandRace::Outer, 0.2e-3))),
        Separation::FreeCage(Some(land(LandRace::Inner, 0.1e-3))),
        Separation::FreeCage(None),
        Separation::Neighbours(ball_pair()),
    ]
}

/// Gives a machine what keeps its balls apart; without a cage the circle is filled with balls.
pub fn separate(constants: &mut MachineConstants, separation: Separation<f64>) {
    let bearing = planar(constants);
    if let Separation::Neighbours(pair) = &separation {
        // 17 balls leave 0.26 mm between neighbours
        bearing.balls = 17;
        assert!(2.0 * 18e-3 * (PI / 17.0).sin() > 2.0 * pair.radius);
        bearing.cage_drag = 0.0;
    }
    bearing.separation = separation;
    balance_mount(constants);
}

/// Contacts at an angle α: what the plane sees of them.
pub fn tilt_contacts(bearing: &mut PlanarConstants, contact_angle: f64) {
    let cosine = contact_angle.cos();
    let b = &mut bearing.ball;
    let interference = b.inner_track + 2.0 * b.radius - b.outer_track;
    let pitch = b.inner_track + b.radius;
    b.radius *= cosine;
    b.inner_track = pitch - b.radius;
    b.outer_track = pitch + b.radius - interference;
    b.inner_stiffness *= cosine.powf(2.5);
    b.outer_stiffness *= cosine.powf(2.5);
    b.load_per_radial_force = 1.0 / cosine;
    b.inverse_inertia = 1.0 / spin_inertia(b.mass, b.radius);
    b.pocket_friction *= cosine;
    b.pocket_inverse_reference_speed *= cosine;
    if let Separation::Neighbours(pair) = &mut bearing.separation {
        pair.friction *= cosine;
        pair.inverse_reference_speed *= cosine;
    }
}

/// A contact of this bearing in a mineral oil at 60 °C.
fn oiled_contact(race: Race, groove_curvature: f64) -> LubricatedContact {
    let curvature = BallRace {
        ball_diameter: 6.35e-3,
        pitch_diameter: 36e-3,
        groove_curvature,
        contact_angle: 0.0,
        race,
    }
    .curvature();
    let modulus = contact_modulus(BEARING_STEEL, BEARING_STEEL);
    LubricatedContact {
        entrained: EntrainedContact::new(curvature, modulus).expect("a groove"),
        hertz: PointContact::new(curvature, modulus).expect("a groove"),
        lubricant: FVA_3.at(333.15, None).expect("within its data"),
        supply: 1.0,
        surfaces: [STEEL_SURFACE; 2],
        asperities: Asperities::raceway(0.1e-6, 0.01),
    }
}

/// Its contacts at the inner and the outer race.
fn oiled_contacts() -> [LubricatedContact; 2] {
    [
        oiled_contact(Race::Inner, 0.515),
        oiled_contact(Race::Outer, 0.525),
    ]
}

/// Traction of this bearing in that oil.
pub fn oil() -> Traction<f64> {
    let [inner, outer] =
        oiled_contacts().map(|contact| contact.traction().expect("positive constants"));
    Traction::Lubricated(LubricatedRaces { inner, outer })
}

/// Rolling resistance of that oil in the inlets.
pub fn inlets() -> ResistanceAtRaces<f64> {
    let [inner, outer] = oiled_contacts().map(|contact| contact.resistance(0.01));
    ResistanceAtRaces { inner, outer }
}

/// The same bearing with balls that roll: contacts in series, the source paper's inertias, no friction moment.
pub fn rolling_bearing(planar: &PlanarConstants) -> RollingConstants {
    let ball = &planar.ball;
    let soft = |stiffness: f64| stiffness.powf(-2.0 / 3.0);
    let balls_mass = planar.balls as f64 * ball.mass;
    let pitch = ball.inner_track + ball.radius;
    let set = RollingSet {
        inner_track_radius: ball.inner_track,
        ball_ratio: ball.radius / ball.inner_track,
        balls_mass,
        cage_mass: planar.cage_inertia / (pitch * pitch),
    };
    RollingConstants {
        balls: planar.balls,
        ball: RollingBall {
            series_stiffness: (soft(ball.inner_stiffness) + soft(ball.outer_stiffness)).powf(-1.5),
            load_per_radial_force: ball.load_per_radial_force,
            damping_time: ball.damping_time,
            interference: ball.inner_track + 2.0 * ball.radius - ball.outer_track,
            inner_track_growth: ball.inner_track_growth,
            mass_radius: ball.mass * (ball.inner_track + ball.radius),
        },
        set,
        cage_mass: planar.cage_mass,
        first_ball_angle: planar.first_ball_angle,
        moment: SteadyMoment::None,
        axial_load: 0.0,
        loss: AccelerationLoss::None,
        lubricant: None,
    }
}

/// The reference machine.
pub fn reference() -> MachineConstants {
    let bearing = planar_bearing();
    let rotor_mass = 8.0;
    let mut constants = MachineConstants {
        rotor: RotorConstants::point(rotor_mass, 0.01, 5e-6),
        axial: None,
        levitation: Levitation {
            stiffness: 1e6,
            damping: 1e3,
            centre: vec2(0.0, 0.0),
            carried: vec2(0.0, rotor_mass * G),
        },
        magnets: None,
        seals: Vec::new(),
        forces: Vec::new(),
        loaded: Vec::new(),
        base: None,
        unbalances: Vec::new(),
        bearings: vec![AuxiliaryBearingConstants {
            name: String::new(),
            node: vec![1.0],
            planes: 1.0,
            datum: vec2(0.0, 0.0),
            contact: JournalContact {
                radial_clearance: 0.25e-3,
                bore_radius: 12.5e-3,
                stiffness: 5e8,
                exponent: 10.0 / 9.0,
                damping: 0.5,
                friction: 0.15,
                inverse_reference_speed: 1.0 / 0.05,
            },
            inner_race: RaceConstants {
                mass: 20.4e-3,
                inertia: 3.9e-6,
                centre_held: false,
                torque: 0.0,
            },
            bearing: BearingConstants::Planar(bearing),
            outer_race_mass: 0.15,
            mount: Mount {
                stiffness: 2e7,
                damping: 5e3,
                free_position: vec2(0.0, 0.0),
            },
            mount_parts: MountParts::NONE,
            surfaces: None,
            warm: None,
            fixture: None,
        }],
        gravity: vec2(0.0, -G),
        speed: 400.0 * PI,
        unbalance_angle: 0.0,
        schedule: Schedule::default(),
        at_speeds: Vec::new(),
    };
    balance_mount(&mut constants);
    constants
}

/// Multiplies the mass of a point rotor.
pub fn times_mass(constants: &mut MachineConstants, factor: f64) {
    let own = &mut constants.rotor.coordinates[0];
    own.mass *= factor;
    own.weight *= factor;
}

/// Takes the unbalance of a point rotor away.
pub fn centred(constants: &mut MachineConstants) {
    constants.rotor.coordinates[0].unbalance = vec2(0.0, 0.0);
}

/// Sets the free position of the mount so that the weight of the bearing is balanced at zero.
pub fn balance_mount(constants: &mut MachineConstants) {
    let gravity = constants.gravity;
    let part = &mut constants.bearings[0];
    let mut mass = part.outer_moving_mass() + part.bearing.free_mass();
    if !part.inner_race.centre_held {
        mass += part.inner_race.mass;
    }
    part.mount.free_position = -(gravity * (mass / part.mount.stiffness));
}

/// The planar bearing of a machine.
pub fn planar(constants: &mut MachineConstants) -> &mut PlanarConstants {
    match &mut constants.bearings[0].bearing {
        BearingConstants::Planar(bearing) => bearing,
        _ => panic!("the bearing is planar here"),
    }
}

/// Gives a machine the rolling bearing that corresponds to its planar one.
pub fn let_roll(constants: &mut MachineConstants) {
    constants.bearings[0].bearing = BearingConstants::Rolling(rolling_bearing(planar(constants)));
    balance_mount(constants);
}

/// What a kind of heat has summed up in a state.
pub fn heat_of(machine: &RotorMachine, state: &[f64], kind: &str) -> f64 {
    let heat = machine.layout().heat_of(state, "", kind);
    heat.expect("a kind of heat")
}

/// Removes gravity from a machine, and the weight that the levitation carries.
pub fn weightless(constants: &mut MachineConstants) {
    constants.gravity = vec2(0.0, 0.0);
    constants.levitation.carried = vec2(0.0, 0.0);
    planar(constants).ball.gravity = vec2(0.0, 0.0);
    balance_mount(constants);
}

/// The states of the bearing within the state of a machine, or their rates within its rate.
pub fn bearing_part<'a>(machine: &RotorMachine, state: &'a [f64]) -> &'a [f64] {
    &state[BEARING..machine.layout().ledger()]
}

/// One ball within the state of a machine. Of a rate it gives the derivatives of the same quantities.
pub fn ball_of(machine: &RotorMachine, state: &[f64], ball: usize) -> BallMotion<f64> {
    match &machine.constants.bearings[0].bearing {
        BearingConstants::Planar(bearing) => bearing.motion(bearing_part(machine, state), ball),
        _ => panic!("the bearing is planar here"),
    }
}

/// Error control at a tolerance, from 0 to an end.
pub fn settings(end: f64, tolerance: f64) -> Settings {
    Settings {
        start: 0.0,
        end,
        tolerance,
        first_step: 1e-7,
        largest_step: 1e-3,
        step_limit: 10_000_000,
    }
}

/// Equal steps: the tolerance accepts whatever comes.
pub fn equal_steps(end: f64, length: f64) -> Settings {
    Settings {
        first_step: length,
        largest_step: length,
        tolerance: 1e12,
        ..settings(end, 1.0)
    }
}

/// Watches nothing.
pub struct Blind;

impl Observer<RotorMachine> for Blind {
    fn step(&mut self, _step: &mut Step<RotorMachine>) -> Flow {
        Flow::Continue
    }
}

/// Runs a machine from a state by some steps under an observer, in plain numbers.
pub fn by(
    steps: Steps,
    machine: &RotorMachine,
    start: &[f64],
    settings: &Settings,
    observer: &mut dyn Observer<RotorMachine>,
) -> Ending {
    let runs = Runs {
        machines: &[machine],
        starts: &[start.to_vec()],
        settings: *settings,
        steps,
        interrupt: &AtomicBool::new(false),
    };
    simulate_on(Level::Baseline, Shape::Balls, runs, &mut [observer]).remove(0)
}

/// Runs a machine from a state by explicit steps under an observer; it must finish.
pub fn observe(
    machine: &RotorMachine,
    start: &[f64],
    settings: &Settings,
    observer: &mut dyn Observer<RotorMachine>,
) -> Ending {
    let ending = by(Steps::Explicit, machine, start, settings, observer);
    assert_eq!(ending.stop, solve::Stop::Finished);
    assert!(ending.state.iter().all(|value| value.is_finite()));
    ending
}

/// Runs a machine from a state; returns the last state.
pub fn run(machine: &RotorMachine, start: &[f64], settings: &Settings) -> Vec<f64> {
    observe(machine, start, settings, &mut Blind).state
}

/// Pseudo-random numbers, the same on every machine: SplitMix64 (Steele, Lea, Flood 2014; from memory).
pub struct Random(pub u64);

impl Random {
    /// A number between -size and size.
    pub fn within(&mut self, size: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        let unit = (bits >> 11) as f64 / (1_u64 << 53) as f64;
        size * (2.0 * unit - 1.0)
    }
}

/// A state in which anything may touch anything: half of the contacts are closed, slips have both signs.
pub fn random_state(machine: &RotorMachine, random: &mut Random) -> Vec<f64> {
    let c = &machine.constants;
    let mut state = machine.start();
    let mut body = |at: usize, position: f64, speed: f64| {
        for channel in at..at + 2 {
            state[channel] = random.within(position);
            state[channel + 2] = random.within(speed);
        }
    };
    let held = c.bearings[0].inner_race.centre_held;
    body(
        INNER,
        if held { 0.0 } else { 1e-5 },
        if held { 0.0 } else { 0.2 },
    );
    body(OUTER, 1e-5, 0.2);
    body(ROTOR, 0.0, 0.3);
    let (angle, spin) = (random.within(7.0), random.within(1500.0));
    state[ROTOR + 4] = angle;
    state[ROTOR + 5] = spin;
    state[INNER + 4] = random.within(7.0);
    state[INNER + 5] = random.within(1500.0);
    // the geometric centre on either side of contact
    let distance = c.bearings[0].contact.radial_clearance + random.within(2e-5);
    let (sine, cosine) = random.within(PI).sin_cos();
    let e = c.rotor.coordinates[0].unbalance.x;
    state[ROTOR] = state[INNER] + distance * cosine + e * angle.cos();
    state[ROTOR + 1] = state[INNER + 1] + distance * sine + e * angle.sin();

    let own = BEARING..machine.layout().ledger();
    match &c.bearings[0].bearing {
        BearingConstants::Spatial(_) => panic!("the bearing lies in the plane"),
        BearingConstants::Rolling(_) => state[own.start] = random.within(7.0),
        BearingConstants::Planar(bearing) => {
            let (cage_angle, cage_speed) = (random.within(7.0), random.within(600.0));
            let part = &mut state[own];
            part[0] = cage_angle;
            part[1] = cage_speed;
            let b = &bearing.ball;
            let place = CAGE_PLACE..bearing.first_ball_state().max(CAGE_PLACE);
            for (channel, value) in part[place].iter_mut().enumerate() {
                *value = random.within(if channel < 2 { 0.2e-3 } else { 0.3 });
            }
            // neighbours without a cage are as often pressed as apart
            let gap = match bearing.separation {
                Separation::Neighbours(_) => 0.15e-3,
                _ => b.pocket_gap,
            };
            for ball in 0..bearing.balls {
                let travel = 2.0 * gap / b.pocket_radius;
                let motion = BallMotion {
                    radius: bearing.rest_radius() + random.within(8e-6),
                    radial_speed: random.within(0.2),
                    azimuth: cage_angle + seat(ball, bearing.balls) + random.within(travel),
                    orbit_speed: random.within(600.0),
                    spin: random.within(6000.0),
                };
                bearing.set_motion(part, ball, &motion);
            }
        }
    }
    if c.bearings[0].bearing.lubricant().is_some() {
        let part = &mut state[BEARING..machine.layout().ledger()];
        let first = part.len() - lubricant_state::STATES;
        let share = |random: &mut Random| 0.5 + random.within(0.5);
        part[first] = share(random);
        part[first + 1] = share(random);
        part[first + 2] = 40.0 * share(random);
    }
    state
}
