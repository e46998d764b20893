//! The torque of a drive or a load on the rotor, by tables over speed and time.

use crate::bearing::loss::table;
use crate::coast_down::build::Brake;
use crate::drop::Drop;
use crate::drop::magnets_in_time::happens;
use model::rotor::TorqueTables;
use model::schedule::Schedule;
use model::system::machine::{AtSpeed, Event, MachineConstants};
use model::table::Table;
use scenario::{Happens, MagnetEvent, Spin, When};

/// Torque of the rotor's drive or load over speed and time.
pub(super) fn tables(drop: &Drop) -> Option<TorqueTables> {
    let over_speed = &drop.rotor.torque_over_speed;
    let over_time = &drop.rotor.torque_share_over_time;
    (!over_speed.is_empty()).then(|| TorqueTables {
        over_speed: table(over_speed, 1.0),
        share_over_time: match over_time.is_empty() {
            true => Table::constant(1.0),
            false => table(over_time, 1.0),
        },
    })
}

/// Size of the torque of the brake, N m, and when it comes on with which share of it; `at_speeds` gains what follows a speed.
pub(super) fn brakes(drop: &Drop, at_speeds: &mut Vec<AtSpeed>) -> (f64, Vec<(f64, Event)>) {
    let events = drop.shaft.iter().flat_map(|shaft| &shaft.events);
    // the brake of the keys follows the release
    let axes = drop.shaft.iter().flat_map(|own| &own.rotor.levitation);
    let axes: usize = axes.map(|own| 2 * own.magnets.len()).sum();
    let release = |event: &scenario::Event| match (event.when, &event.what) {
        (When::At(time), Happens::Magnets(lost, MagnetEvent::Lost(_))) if lost.len() == axes => {
            Some(time)
        }
        _ => None,
    };
    let released = events.clone().filter_map(release).reduce(f64::min);
    let released = released.unwrap_or(0.0);
    let mut all: Vec<(When, f64)> = match drop.rotor.spin {
        Spin::Braked { torque, start } => vec![(When::At(start + released), torque)],
        Spin::Free | Spin::Held => Vec::new(),
    };
    all.extend(events.filter_map(|event| match event.what {
        Happens::Brake(torque) => Some((event.when, torque)),
        _ => None,
    }));
    let largest = all.iter().map(|(_, torque)| *torque).fold(0.0, f64::max);
    let mut known = Vec::new();
    for (when, torque) in all {
        let event = Event::Brake(if largest > 0.0 { torque / largest } else { 0.0 });
        happens(when, event, &mut known, at_speeds);
    }
    (largest, known)
}

/// What is known of events at the end of a drop, with those of speeds that were reached, and the speeds to which a rotor that only slows down
/// from this speed, rad/s, comes yet.
pub(super) fn ahead(
    machine: &MachineConstants,
    reached: &[f64],
    speed: f64,
) -> (Schedule<Event>, Vec<AtSpeed>) {
    let after = machine.at_speeds.iter().zip(reached).flat_map(|(own, at)| {
        let then = own.then.iter();
        then.map(move |(delay, event)| (at + delay, *event))
    });
    let waits = |(own, at): &(&AtSpeed, &f64)| !at.is_finite() && !own.rising && own.speed < speed;
    let yet = machine.at_speeds.iter().zip(reached).filter(waits);
    (
        Schedule::of(machine.schedule.all().chain(after)),
        yet.map(|(own, _)| own.clone()).collect(),
    )
}

/// Whether a rotor goes on as another one, or under another load.
pub(super) fn changes(event: &Event) -> bool {
    matches!(event, Event::Load(..) | Event::Unbalance(_))
}

/// The torques that brake such a rotor: those that came, and those whose time or speed is to come; loads and unbalances that come have none.
pub(super) fn coming(machine: &MachineConstants, reached: &[f64], speed: f64) -> Vec<Brake> {
    let (known, mut yet) = ahead(machine, reached, speed);
    yet.sort_by(|a, b| b.speed.total_cmp(&a.speed));
    let known = known
        .all()
        .map(|(from, event)| (from, f64::INFINITY, event));
    let yet = yet
        .iter()
        .flat_map(|own| own.then.iter().map(|then| (0.0, own.speed, then.1)));
    let mut now = [0.0; 3];
    let brakes = known.chain(yet).filter_map(|(from, below, event)| {
        let (kind, torque) = match event {
            Event::Brake(share) => (0, share * machine.rotor.brake_torque),
            Event::Drive(more) => (1, -more),
            _ if changes(&event) => (2, 0.0),
            _ => return None,
        };
        let torque = torque - std::mem::replace(&mut now[kind], torque);
        Some(Brake {
            from,
            below,
            torque,
        })
    });
    brakes.collect()
}

/// When the brake comes on, where a torque over time has its rows, what happens to the magnets: a step ends there.
pub(super) fn schedule(
    brakes: Vec<(f64, Event)>,
    torque: Option<&TorqueTables>,
    magnets: Vec<(f64, Event)>,
) -> Schedule<Event> {
    let knots = torque.map_or(&[][..], |tables| tables.share_over_time.points());
    let knots = knots.iter().map(|(time, _)| (*time, Event::Knot));
    Schedule::of(brakes.into_iter().chain(knots).chain(magnets))
}
