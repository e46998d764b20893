//! The torque of a drive or a load on the rotor, by tables over speed and time.

use crate::bearing::loss::table;
use crate::drop::Drop;
use model::magnets::MagnetsConstants;
use model::rotor::TorqueTables;
use model::schedule::Schedule;
use model::system::machine::Event;
use model::table::Table;

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

/// When the brake comes on, where a torque over time has its rows, what happens to the magnets up to the end: a step ends there.
pub(super) fn schedule(
    brake_start: f64,
    torque: Option<&TorqueTables>,
    magnets: Option<(&MagnetsConstants, f64)>,
) -> Schedule<Event> {
    let knots = torque.map_or(&[][..], |tables| tables.share_over_time.points());
    let knots = knots.iter().map(|(time, _)| (*time, Event::Knot));
    let control = magnets.into_iter().flat_map(|(own, end)| own.events(end));
    let control = control.map(|(time, event)| (time, Event::Control(event)));
    let brake = [(brake_start, Event::Brake)];
    Schedule::of(brake.into_iter().chain(knots).chain(control))
}
