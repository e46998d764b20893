//! Runs a drop and names what came out.

use super::bearing_run::BearingRun;
use super::build::{self, Built};
use super::ending::{settings, stop};
use super::ensemble::{self, Finished, Member, Plan};
use super::outcome::{Contact, Outcome, Picture, Spread, Stop, Value, Work};
use super::{Options, columns, method, quantities, warnings};
use crate::scenario::{Drop, Scenario};
use measure::random::Random;
use model::system::drop::DropMachine;
use model::system::drop::layout::{
    DETAIL, LAND_FORCE, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE,
};
use model::system::drop::rate::race_motion;
use number::Vec2;
use std::time::Instant;

/// Everything the pages that name results need to know.
pub(super) struct Context<'a> {
    pub drop: &'a Drop,
    pub built: &'a Built,
    pub machine: &'a DropMachine,
    pub finished: &'a Finished,
    pub members: usize,
}

impl<'a> Context<'a> {
    pub fn bearing(&self) -> BearingRun<'a> {
        BearingRun {
            bearing: &self.machine.constants.bearing,
            states: self.machine.layout().bearing(),
            detail: DETAIL,
            largest_loads: [LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD],
            cage_forces: [LARGEST_POCKET_FORCE, LAND_FORCE],
            pressure_factors: self.built.pressure_factors,
            motion: race_motion,
            rows: self.finished.record.rows().collect(),
        }
    }
}

/// Runs a drop.
pub(super) fn run(scenario: &Scenario, drop: &Drop, built: &Built, options: &Options) -> Outcome {
    let machine = DropMachine::new(built.constants.clone());
    let count = drop.repeat.count.max(1) as usize;
    let members: Vec<Member> = (0..count)
        .map(|k| member(&machine, drop, built, k))
        .collect();
    let implicit = method::is_implicit(drop, built);
    let clock = Instant::now();
    let finished = ensemble::run(
        &members,
        &Plan {
            settings: settings(&drop.run),
            implicit,
            interval: drop.run.output_interval,
            threads: options.threads,
            interrupt: options.interrupt,
            progress: options.progress,
        },
    );
    let seconds = clock.elapsed().as_secs_f64();

    let context = |k: usize| Context {
        drop,
        built,
        machine: &members[k].machine,
        finished: &finished[k],
        members: count,
    };
    let first = context(0);
    let mut named = quantities::name(&first);
    let mut table = Vec::new();
    if count > 1 {
        // a member that did not end as planned would pull every mean
        table = (0..count)
            .filter(|k| stop(&finished[*k].ending).complete())
            .map(|k| {
                quantities::name(&context(k))
                    .into_iter()
                    .filter_map(|q| match q.value {
                        Value::Number(value) => Some((q.name, Some(value))),
                        Value::None { .. } => Some((q.name, None)),
                        Value::List(_) | Value::Text(_) => None,
                    })
                    .collect()
            })
            .collect();
        for quantity in &mut named {
            quantity.spread = spread(&table, &quantity.name);
        }
    }
    Outcome {
        system: "drop",
        title: scenario
            .title
            .clone()
            .unwrap_or_else(|| "Drop of a levitated rotor".to_string()),
        quantities: named,
        history: columns::history(&first),
        contacts: contacts(&finished[0]),
        warnings: warnings::of(scenario, &first, &finished),
        stop: worst_stop(&finished),
        work: work(&finished, seconds, implicit),
        members: table,
        picture: Picture {
            clearance: Some(drop.contact.radial_air_clearance),
            pressure_limit: Some(drop.bearing.hertz_pressure_limit),
            rolling_cage_ratio: machine.rolling_cage_ratio(),
            balls: drop.bearing.ball_count,
        },
        files: Vec::new(),
    }
}

/// Member `k`: the machine and start given for 0, else changed by numbers that depend on (seed, k) alone.
fn member(machine: &DropMachine, drop: &Drop, built: &Built, k: usize) -> Member {
    if k == 0 {
        return Member {
            start: machine.start(),
            machine: machine.clone(),
            keep_rows: true,
        };
    }
    let mut random = Random::new(member_seed(drop.repeat.seed, k));
    let mut normal = || random.normal();
    let shift = Vec2::new(normal(), normal()) * drop.repeat.rotor_position_deviation;
    let angles: Vec<f64> = (0..drop.bearing.ball_count)
        .map(|_| normal() * drop.repeat.ball_angle_deviation)
        .collect();
    let machine = if drop.repeat.varies_the_machine() {
        let varied = varied(drop, &mut normal);
        DropMachine::new(build::constants(&varied, built.constants.bearing.clone()))
    } else {
        machine.clone()
    };
    let mut start = machine.start();
    machine.perturb(&mut start, shift, &|ball| angles[ball]);
    Member {
        machine,
        start,
        keep_rows: false,
    }
}

/// A machine of the same kind with other tolerances.
fn varied(drop: &Drop, normal: &mut impl FnMut() -> f64) -> Drop {
    let mut varied = drop.clone();
    let repeat = &drop.repeat;
    let mut factor = |deviation: f64| (deviation * normal()).exp();
    varied.contact.friction_coefficient *= factor(repeat.friction_coefficient_deviation);
    varied.mount.stiffness *= factor(repeat.mount_stiffness_deviation);
    varied.contact.radial_air_clearance *= factor(repeat.radial_air_clearance_deviation);
    // the direction of two normal numbers is uniform
    let (x, y) = (normal(), normal());
    if repeat.random_unbalance_angle {
        varied.rotor.unbalance_angle = y.atan2(x);
    }
    varied
}

/// The seed of a member: (study seed, k) mixed so that neighbouring pairs share nothing.
fn member_seed(seed: u64, k: usize) -> u64 {
    // finaliser of SplitMix64, twice
    let mix = |mut x: u64| {
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    };
    mix(mix(seed.wrapping_add(0x9e37_79b9_7f4a_7c15)).wrapping_add(k as u64))
}

fn spread(members: &[Vec<(String, Option<f64>)>], name: &str) -> Option<Spread> {
    let values: Vec<f64> = members
        .iter()
        .filter_map(|member| member.iter().find(|(n, _)| n == name)?.1)
        .collect();
    Spread::of(values)
}

fn contacts(finished: &Finished) -> Vec<Contact> {
    finished
        .record
        .contacts
        .iter()
        .map(|c| Contact {
            start: c.start,
            end: c.end,
            peak_force: c.peak_force,
            peak_time: c.peak_time,
        })
        .collect()
}

/// The ending of the unperturbed run; if that is whole, of the first member that is not.
fn worst_stop(finished: &[Finished]) -> Stop {
    let first = stop(&finished[0].ending);
    if !first.complete() {
        return first;
    }
    match finished
        .iter()
        .map(|member| stop(&member.ending))
        .enumerate()
        .find(|(_, s)| !s.complete())
    {
        Some((k, mut stop)) => {
            let whole = finished
                .iter()
                .filter(|member| self::stop(&member.ending).complete());
            stop.text = format!(
                "Member {k} of the repetition: {} {} of {} members are whole; only these enter the spread.",
                stop.text,
                whole.count(),
                finished.len()
            );
            stop
        }
        None => first,
    }
}

fn work(finished: &[Finished], seconds: f64, implicit: bool) -> Work {
    let mut work = Work {
        members: finished.len(),
        seconds,
        method: Some(if implicit {
            method::IMPLICIT
        } else {
            method::EXPLICIT
        }),
        ..Work::default()
    };
    for member in finished {
        work.steps += member.ending.work.accepted;
        work.rejected += member.ending.work.rejected;
        work.rate_calls += member.ending.work.rate_calls;
    }
    work
}
