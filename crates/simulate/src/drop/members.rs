//! The members of a repeated drop: perturbed starts, and machines that differ.

use crate::drop::Drop;
use crate::drop::build::{self, Built};
use crate::drop::ensemble::Member;
use crate::drop::feedback::Following;
use model::bearing::BearingConstants;
use model::system::machine::RotorMachine;
use number::Vec2;
use problem::{Place, Problem};
use scenario::{Scenario, System};
use statistics::random::Random;
use std::sync::Arc;

/// A member whose machine differs from the one given.
pub struct Varied {
    /// What it drew: paths with their values.
    pub drawn: Vec<(String, String)>,
    /// Its machine.
    pub built: Built,
    /// What its lanes must share: words, counts and switches of its file.
    kind: usize,
}

/// The machines of members 1, 2, … where they differ; none where starts alone do.
pub fn varied(scenario: &Scenario, built: &Built) -> Result<Vec<Varied>, Box<Problem>> {
    let repeat = &built.drop.repeat;
    let count = repeat.count.max(1) as usize;
    if scenario.vary.is_empty() {
        return Ok(Vec::new());
    }
    let given = RotorMachine::new(built.constants.clone());
    let mut kinds = vec![(kind_of(scenario), given)];
    (1..count)
        .map(|k| {
            let mut random = numbers(repeat.seed ^ MACHINES, k);
            let drawn: Vec<_> = (scenario.vary.iter())
                .flat_map(|vary| vary.draw(&mut random))
                .collect();
            let blame = |problem: Box<Problem>| member_problem(k, &drawn, *problem);
            let member = scenario.with(&drawn).map_err(blame)?;
            let System::Drop(of) = &member.system else {
                unreachable!("no value that is varied changes the system");
            };
            let built = build::drop(of).map_err(blame)?;
            let kind = kind_of(&member);
            let machine = RotorMachine::new(built.constants.clone());
            let known =
                (kinds.iter()).position(|(of, first)| *of == kind && share_lanes(first, &machine));
            Ok(Varied {
                kind: known.unwrap_or_else(|| {
                    kinds.push((kind, machine));
                    kinds.len() - 1
                }),
                drawn,
                built,
            })
        })
        .collect()
}

/// Whether machines of one kind have the same states: another rotor or cutoff has other modes.
pub(crate) fn share_lanes(a: &RotorMachine, b: &RotorMachine) -> bool {
    let rows = |machine: &RotorMachine| -> Vec<usize> {
        let seals = machine.constants.seals.iter();
        seals.map(|seal| seal.rows.len()).collect()
    };
    a.layout() == b.layout()
        && match (&a.constants.magnets, &b.constants.magnets) {
            (Some(a), Some(b)) => a.share_lanes(b),
            (a, b) => a.is_none() && b.is_none(),
        }
        && a.constants.rotor.spin_held == b.constants.rotor.spin_held
        && rows(a) == rows(b)
}

/// Values that are no real numbers, by their paths.
pub(crate) type Kind = Vec<(String, Option<String>)>;

/// Values that are no real numbers: machines that share them have the same laws and the same states.
pub(crate) fn kind_of(scenario: &Scenario) -> Kind {
    let values = scenario.resolved.values.iter();
    values
        .filter(|value| value.is_of_kind())
        .map(|value| (value.shown(), value.text.clone()))
        .collect()
}

/// What is wrong with a member, with what it drew.
fn member_problem(k: usize, drawn: &[(String, String)], mut problem: Problem) -> Box<Problem> {
    let draws: Vec<String> = (drawn.iter())
        .map(|(path, value)| format!("{path} = {value}"))
        .collect();
    problem.found = format!("{} in member {k} of the repetition", problem.found);
    problem.place = Place::Whole;
    Box::new(problem.with_hint(format!("It drew {}", draws.join(", "))))
}

/// All members: the machine and start given, then others by numbers that depend on (seed, k) alone.
pub(crate) fn of(built: &Built, varied: &[Varied]) -> Vec<Member> {
    let drop = &built.drop;
    let count = drop.repeat.count.max(1) as usize;
    let given = Arc::new(RotorMachine::new(built.constants.clone()));
    let following = Following::of(drop).map(Arc::new);
    (0..count)
        .map(|k| {
            let other = k.checked_sub(1).and_then(|k| varied.get(k));
            let machine = match other {
                Some(varied) => Arc::new(RotorMachine::new(varied.built.constants.clone())),
                None => given.clone(),
            };
            let from = other.map_or(built, |varied| &varied.built);
            let mut start = match &from.shaft {
                Some(shaft) => machine.start_with(&shaft.position, &shaft.velocity),
                None => machine.start(),
            };
            if k > 0 {
                perturb(drop, &machine, &mut start, k);
            }
            Member {
                kind: other.map_or(0, |varied| varied.kind),
                following: match other {
                    Some(varied) => Following::of(&varied.built.drop).map(Arc::new),
                    None => following.clone(),
                },
                machine,
                start,
                keep_rows: k == 0,
            }
        })
        .collect()
}

/// Moves the rotor and every ball a little.
fn perturb(drop: &Drop, machine: &RotorMachine, start: &mut [f64], k: usize) {
    let mut random = numbers(drop.repeat.seed, k);
    let mut normal = || random.normal();
    let shift = Vec2::new(normal(), normal()) * drop.repeat.rotor_position_deviation;
    let angles: Vec<Vec<f64>> = (machine.constants.bearings.iter())
        .map(|part| {
            let balls = match &part.bearing {
                BearingConstants::Planar(bearing) => bearing.balls,
                BearingConstants::Rolling(_) => 0,
            };
            (0..balls)
                .map(|_| normal() * drop.repeat.ball_angle_deviation)
                .collect()
        })
        .collect();
    machine.perturb(start, shift, &|bearing, ball| angles[bearing][ball]);
}

/// Keeps the numbers of machines apart from those of starts.
const MACHINES: u64 = 0x5851_f42d_4c95_7f2d;

/// The random numbers of a member: (seed, k) mixed so that neighbouring pairs share nothing.
fn numbers(seed: u64, k: usize) -> Random {
    // finaliser of SplitMix64, twice
    let mix = |mut x: u64| {
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    };
    Random::new(mix(
        mix(seed.wrapping_add(0x9e37_79b9_7f4a_7c15)).wrapping_add(k as u64)
    ))
}
