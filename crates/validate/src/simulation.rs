//! The program's own simulation behind [`Simulator`].

use super::machine::ReferenceMachine;
use super::reference::{DerivativePoint, DropReference};
use super::simulator::{DerivativeAnswer, DropAnswer, ElasticBounce, FreeFall, Simulator};
use auxbear::simulate::ensemble::{self, Finished, Member, Plan};
use model::auxiliary_bearing::probe::{FRICTION_FORCE, NORMAL_FORCE, PENETRATION, SLIP_SPEED};
use model::auxiliary_bearing::{AuxiliaryBearingConstants, BearingAt, RaceConstants};
use model::bearing::ball::{BallConstants, BallMotion, BallReaction};
use model::bearing::{BearingConstants, PlanarConstants, Separation};
use model::contact::JournalContact;
use model::levitation::Levitation;
use model::mount::{Mount, MountParts};
use model::rotor::RotorConstants;
use model::schedule::Schedule;
use model::system::machine::simulate::Steps;
use model::system::machine::{MachineConstants, RotorMachine};
use number::Vec2;
use physics::traction::{FourParameterTraction, TanhTraction, Traction};
use solve::Settings;
use std::collections::BTreeMap;
use std::sync::atomic::AtomicBool;

/// Runs the cases with this program's model and solver.
#[derive(Clone, Copy, Debug, Default)]
pub struct Simulation {
    /// Cases too that take long.
    pub long: bool,
}

/// Tolerance of reference drops: ten times tighter than the default of a scenario.
const TOLERANCE: f64 = 1e-5;
/// Tolerance of closed forms, which ask for more digits.
const CLOSED_FORM_TOLERANCE: f64 = 1e-8;

impl Simulator for Simulation {
    fn long(&self) -> bool {
        self.long
    }
    fn machines(&self) -> Result<(), String> {
        Ok(())
    }
    fn free_fall(&self, case: &FreeFall) -> Result<f64, String> {
        let machine = falling_machine(1.0, 1e7, case.clearance, case.gravity)?;
        let fall = (2.0 * case.clearance / case.gravity).sqrt();
        let finished = simulate(machine, None, 1.1 * fall, CLOSED_FORM_TOLERANCE)?;
        finished.record.bearings[0]
            .contacts
            .first()
            .map(|contact| contact.start)
            .ok_or_else(|| "the rotor never touched".to_string())
    }

    fn elastic_bounce(&self, case: &ElasticBounce) -> Result<f64, String> {
        let machine = falling_machine(case.mass, case.stiffness, case.clearance, case.gravity)?;
        let fall = (2.0 * case.clearance / case.gravity).sqrt();
        let half_period = std::f64::consts::PI * (case.mass / case.stiffness).sqrt();
        let finished = simulate(
            machine,
            None,
            fall + 1.2 * half_period,
            CLOSED_FORM_TOLERANCE,
        )?;
        finished.record.bearings[0]
            .peak_contact_force()
            .map(|peak| peak.value)
            .ok_or_else(|| "the rotor never touched".to_string())
    }

    fn derivative(&self, point: &DerivativePoint) -> Result<DerivativeAnswer, String> {
        let machine = &point.params;
        let levitated = machine.levitation_stiffness > 0.0;
        let drop = RotorMachine::with_levitation(constants(machine, 0.0)?, levitated);
        let state = state(&drop, &point.y);
        let (rate, probe) = drop.inspect(&state);
        let layout = drop.layout();

        let mut rates = reference_order(&drop, &rate);
        let centre = drop.node(0, &state);
        let levitation = if levitated { 1.0 } else { 0.0 };
        let heat = |name: &str| layout.heat_of(&rate, "", name).unwrap_or(f64::NAN);
        rates.extend([
            heat("inner_contact_damping"),
            heat("outer_contact_damping"),
            heat("inner_ball_slip"),
            heat("outer_ball_slip"),
            heat("drag"),
            heat("pocket_damping"),
            heat("pocket_friction"),
            heat("mount_damping"),
            heat("rotor_race_damping"),
            heat("rotor_race_friction"),
            levitation * machine.levitation_damping * centre.velocity.length_squared(),
            rate[layout.source(2)],
        ]);

        let content = drop.content(&state);
        let held = drop.constants.levitation.energy(centre.position);
        Ok(DerivativeAnswer {
            rates,
            per_ball: per_ball(&drop, &state),
            globals: globals(&drop, &state, &probe),
            kinetic: content.translation + content.spin,
            potential: content.potential + levitation * held,
        })
    }

    fn drop(&self, reference: &DropReference) -> Result<DropAnswer, String> {
        let machine = RotorMachine::new(constants(&reference.params, reference.rotor_speed)?);
        let start = state(&machine, &reference.y0);
        let layout = machine.layout().clone();
        let finished = simulate(machine.clone(), Some(start), reference.duration, TOLERANCE)?;
        let (record, end) = (&finished.record.bearings[0], &finished.ending.state);
        let heat = |name: &str| layout.heat_of(end, "", name).unwrap_or(f64::NAN);
        let contacts = &record.contacts;
        let slip = heat("inner_ball_slip") + heat("outer_ball_slip");
        Ok(DropAnswer {
            values: BTreeMap::from([
                ("peak1", contacts.first().map(|contact| contact.peak_force)),
                ("peak_all", record.peak_contact_force().map(|p| p.value)),
                ("n_contacts", Some(contacts.len() as f64)),
                ("t_inner_50%", record.inner_race_time_to_50_percent()),
                ("t_inner_95%", record.inner_race_time_to_95_percent()),
                ("t_cage_95%roll", record.cage_time_to_95_percent()),
                ("fric", Some(heat("rotor_race_friction"))),
                ("slip", Some(slip)),
                ("dissipated", Some(machine.flows(end).heat)),
                ("wi_end", Some(end[layout.bearings[0].inner.spin()])),
                ("wc_end", Some(machine.cage_speed(0, end))),
                ("rotor_end", Some(end[layout.rotor.spin()])),
                ("maxrel", Some(record.rotor_race_displacement.value)),
                ("maxouter", Some(record.mount_displacement.value)),
            ]),
            contact_start_times: contacts.iter().map(|contact| contact.start).collect(),
        })
    }
}

fn simulate(
    machine: RotorMachine,
    start: Option<Vec<f64>>,
    duration: f64,
    tolerance: f64,
) -> Result<Finished, String> {
    let start = start.unwrap_or_else(|| machine.start());
    let member = Member::of(machine, start);
    let mut finished = ensemble::run(
        std::slice::from_ref(&member),
        &Plan {
            settings: Settings {
                start: 0.0,
                end: duration,
                tolerance,
                first_step: 1e-8,
                largest_step: 1e-3,
                step_limit: 100_000_000,
            },
            until_rolling: None,
            within: Vec::new(),
            steps: Steps::Explicit,
            interval: duration,
            taps: &[],
            interrupt: &AtomicBool::new(false),
            progress: &|_| {},
            rows: None,
        },
    );
    match finished.pop() {
        Some(finished) if finished.ending.stop == solve::Stop::Finished => Ok(finished),
        Some(finished) => Err(format!(
            "the run ended at {} s: {:?}",
            finished.ending.time, finished.ending.stop
        )),
        None => Err("nothing was run".to_string()),
    }
}

/// A rotor without spin, unbalance and friction above a race whose centre is held, on a linear contact.
pub(super) fn falling_machine(
    mass: f64,
    stiffness: f64,
    clearance: f64,
    gravity: f64,
) -> Result<RotorMachine, String> {
    let machine = ReferenceMachine {
        ball_count: 8,
        gravity,
        ball_radius: 3e-3,
        inner_track_radius: 15e-3,
        outer_track_radius: 21e-3,
        ball_mass: 1e-3,
        inner_race_mass: 0.02,
        inner_race_inertia: 4e-6,
        outer_race_mass: 0.15,
        cage_mass: 5e-3,
        cage_inertia: 1.6e-6,
        inner_contact_stiffness: 2e10,
        outer_contact_stiffness: 2e10,
        contact_damping_time: 2e-6,
        traction_reference_speed: 0.1,
        pocket_radius: 18e-3,
        pocket_gap: 1e-4,
        pocket_stiffness: 1e7,
        pocket_friction_reference_speed: 0.1,
        mount_stiffness: 1e8,
        inner_race_centre_held: 1,
        has_rotor: 1,
        rotor_mass: mass,
        rotor_inertia: 1e-2,
        bore_radius: 12.5e-3 + clearance,
        radial_air_clearance: clearance,
        contact_stiffness: stiffness,
        contact_exponent: 1.0,
        contact_friction_reference_speed: 0.1,
        levitation_stiffness: 1e6,
        ..ReferenceMachine::default()
    };
    constants(&machine, 0.0).map(RotorMachine::new)
}

/// The machine of a reference file.
pub(super) fn constants(
    machine: &ReferenceMachine,
    speed: f64,
) -> Result<MachineConstants, String> {
    if machine.has_rotor != 1 {
        return Err("a machine without a rotor is no drop".to_string());
    }
    let gravity = Vec2::new(0.0, -machine.gravity);
    let traction = match machine.traction_kind {
        0 => Traction::Tanh(TanhTraction {
            maximum: machine.traction_maximum,
            inverse_reference_speed: 1.0 / machine.traction_reference_speed,
        }),
        1 => Traction::FourParameter(FourParameterTraction {
            a: machine.traction_a,
            b: machine.traction_b,
            c: machine.traction_c,
            d: machine.traction_d,
        }),
        other => return Err(format!("traction law {other} is not known")),
    };
    let radius = machine.ball_radius;
    let mut constants = MachineConstants {
        rotor: RotorConstants::point(
            machine.rotor_mass,
            machine.rotor_inertia,
            machine.unbalance_eccentricity,
        ),
        axial: None,
        levitation: Levitation {
            stiffness: machine.levitation_stiffness,
            damping: machine.levitation_damping,
            centre: Vec2::zero(),
            carried: -(gravity * machine.rotor_mass),
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
            datum: Vec2::zero(),
            contact: JournalContact {
                radial_clearance: machine.radial_air_clearance,
                bore_radius: machine.bore_radius,
                stiffness: machine.contact_stiffness,
                exponent: machine.contact_exponent,
                damping: machine.contact_damping,
                friction: machine.contact_friction_coefficient,
                inverse_reference_speed: 1.0 / machine.contact_friction_reference_speed,
            },
            inner_race: RaceConstants {
                mass: machine.inner_race_mass,
                inertia: machine.inner_race_inertia,
                centre_held: machine.inner_race_centre_held == 1,
                torque: machine.inner_race_torque,
            },
            bearing: BearingConstants::Planar(PlanarConstants {
                balls: machine.ball_count,
                ball: BallConstants {
                    radius,
                    ball_radius: radius,
                    load_per_radial_force: 1.0,
                    mass: machine.ball_mass,
                    inverse_mass: 1.0 / machine.ball_mass,
                    inverse_inertia: 1.0 / (0.4 * machine.ball_mass * radius * radius),
                    inner_track: machine.inner_track_radius,
                    inner_track_growth: 0.0,
                    outer_track: machine.outer_track_radius,
                    inner_stiffness: machine.inner_contact_stiffness,
                    outer_stiffness: machine.outer_contact_stiffness,
                    damping_time: machine.contact_damping_time,
                    pocket_radius: machine.pocket_radius,
                    pocket_gap: machine.pocket_gap,
                    pocket_stiffness: machine.pocket_stiffness,
                    pocket_damping: machine.pocket_damping,
                    pocket_friction: machine.pocket_friction_coefficient,
                    pocket_inverse_reference_speed: 1.0 / machine.pocket_friction_reference_speed,
                    orbit_drag: machine.orbit_drag,
                    spin_drag: machine.spin_drag,
                    gravity,
                },
                traction,
                separation: Separation::CentredCage,
                cage_mass: machine.cage_mass,
                cage_inertia: machine.cage_inertia,
                cage_drag: machine.cage_drag,
                first_ball_angle: 0.0,
                moment: None,
                inlet_rolling: None,
                lubricant: None,
                races: None,
            }),
            outer_race_mass: machine.outer_race_mass,
            mount: Mount {
                stiffness: machine.mount_stiffness,
                damping: machine.mount_damping,
                free_position: Vec2::zero(),
            },
            mount_parts: MountParts::NONE,
            surfaces: None,
            warm: None,
            fixture: None,
        }],
        gravity,
        speed,
        unbalance_angle: 0.0,
        schedule: Schedule::default(),
        at_speeds: Vec::new(),
    };
    constants.balance_mounts();
    Ok(constants)
}

/// First ball channel of the reference files.
const REFERENCE_BALLS: usize = 18;

/// Where the only bearing stands.
fn at(machine: &RotorMachine) -> &BearingAt {
    &machine.layout().bearings[0]
}

fn planar(machine: &RotorMachine) -> &PlanarConstants {
    match &machine.constants.bearings[0].bearing {
        BearingConstants::Planar(bearing) => bearing,
        _ => unreachable!("reference machines are planar"),
    }
}

/// A state of the reference files in our layout; the ledger starts at zero.
fn state(machine: &RotorMachine, reference: &[f64]) -> Vec<f64> {
    let layout = machine.layout();
    let mut state = vec![0.0; layout.ledger()];
    state[..REFERENCE_BALLS].copy_from_slice(&reference[..REFERENCE_BALLS]);
    for (ball, values) in reference[REFERENCE_BALLS..]
        .chunks_exact(5)
        .take(at(machine).balls)
        .enumerate()
    {
        let motion = BallMotion {
            radius: values[0],
            radial_speed: values[1],
            azimuth: values[2],
            orbit_speed: values[3],
            spin: values[4],
        };
        planar(machine).set_motion(&mut state[at(machine).bearing..], ball, &motion);
    }
    state.resize(layout.dimension(), 0.0);
    state
}

/// Our rates in the order of the reference files, without their accounts.
fn reference_order(machine: &RotorMachine, rate: &[f64]) -> Vec<f64> {
    let mut out = rate[..REFERENCE_BALLS].to_vec();
    for ball in 0..at(machine).balls {
        let m = planar(machine).motion(&rate[at(machine).bearing..], ball);
        out.extend([m.radius, m.radial_speed, m.azimuth, m.orbit_speed, m.spin]);
    }
    out
}

fn reactions(machine: &RotorMachine, state: &[f64]) -> Vec<BallReaction<f64>> {
    let own = &state[at(machine).own()];
    (0..at(machine).balls)
        .map(|ball| planar(machine).ball_reaction(&at(machine).motion(state), own, ball))
        .collect()
}

fn per_ball(machine: &RotorMachine, state: &[f64]) -> Vec<Vec<f64>> {
    let ball = &planar(machine).ball;
    reactions(machine, state)
        .iter()
        .map(|r| {
            vec![
                r.inner_load,
                r.outer_load,
                r.inner_traction,
                // the source paper counts the outer traction against the rotation
                -r.outer_traction,
                r.pocket_force,
                r.pocket_side,
                -(r.pocket_side * r.pocket_friction),
                r.inner_approach,
                r.outer_approach,
                r.inner_slip,
                r.outer_slip,
                r.pocket_penetration,
                ball.inner_track - 0.5 * r.inner_approach,
                ball.outer_track + 0.5 * r.outer_approach,
            ]
        })
        .collect()
}

fn globals(machine: &RotorMachine, state: &[f64], probe: &[f64]) -> Vec<f64> {
    let constants = &machine.constants;
    let part = &constants.bearings[0];
    let races = at(machine).motion(state);
    let centre = machine.node(0, state);
    let spin = state[machine.layout().rotor.spin()];
    let contact = part.contact.react(&centre, spin, &races.inner);
    let balls = reactions(machine, state);
    let mount = part.mount.force(races.outer.position, races.outer.velocity);
    vec![
        probe[NORMAL_FORCE],
        probe[FRICTION_FORCE],
        probe[PENETRATION],
        -probe[SLIP_SPEED],
        balls.iter().map(|r| r.on_inner.moment).sum(),
        balls.iter().map(|r| r.on_outer.moment).sum(),
        contact.on_journal.force.x,
        contact.on_journal.force.y,
        mount.x,
        mount.y,
    ]
}
