//! Runs a drop and names what came out.

mod axial;
mod base;
mod body;
pub mod build;
mod clearances;
pub(crate) mod columns;
pub(crate) mod context;
mod controlled;
pub mod driven;
pub mod driven_columns;
pub mod each;
pub(crate) mod events;
mod housings;
mod layers;
pub(crate) mod magnets;
mod magnets_in_time;
pub(crate) mod method;
mod mount;
mod mount_results;
mod multirate;
pub(crate) mod orders;
pub(crate) mod quantities;
mod record_file;
pub mod shaft;
pub mod shaft_results;
pub(crate) mod surfaces;
mod torque;
mod unbalances;
pub mod warning_table;
pub(crate) mod warnings;

pub use body::{Drop, Shaft};

use crate::bearing::races::without_count;
use crate::drop::build::DropModel;
use crate::drop::context::{Context, Setup};
use crate::drop::each::One;
use crate::drop::multirate::results::{self as coast_down, After};
use model::system::machine::RotorMachine;
use outcome::{Column, Contact, Outcome, Picture, Quantity, Work};
use scenario::Scenario;

/// The columns of its history, without values.
pub fn columns(built: &DropModel) -> Vec<Column> {
    let machine = &RotorMachine::new(built.constants.clone());
    let setup = Setup { built, machine };
    columns::history(setup, None)
}

/// The results of a drop, without values.
pub fn results(built: &DropModel) -> Vec<Quantity> {
    let machine = &RotorMachine::new(built.constants.clone());
    let setup = Setup { built, machine };
    let mut list = quantities::name(setup, None);
    if built.drop.coast_down.is_some() {
        list.extend(coast_down::results(setup));
    }
    list.extend(orders::named(setup.parts(), None));
    list
}

/// What came out of one drop; its history only where that is kept.
pub(crate) fn outcome(one: &One, context: &Context, after: Option<&After>) -> Outcome {
    let drop = &one.built.drop;
    let stop = after.map_or_else(|| magnets::stop(context), |after| after.stop.clone());
    let mut quantities = coast_down::quantities(context, after);
    if stop.reason != "finished" {
        without_count(&mut quantities);
    }
    let work = &context.finished.ending.work;
    let mut outcome = Outcome {
        system: one.scenario.system.name().word(),
        title: title(one.scenario),
        quantities,
        warnings: warnings::of(one.scenario, context, after.filter(|_| one.speaks())),
        stop,
        work: Work {
            steps: work.accepted + after.map_or(0, |after| after.steps),
            rejected: work.rejected,
            rate_calls: work.rate_calls,
            method: Some(one.stepping.name()),
            ..Work::default()
        },
        ..Outcome::default()
    };
    if one.member.keep_rows {
        outcome.history = columns::history(context.setup, Some(context));
        let counted = Some((outcome.history.as_slice(), context.counted_from()));
        let orders = orders::named(context.setup.parts(), counted);
        outcome.quantities.extend(orders);
        outcome.contacts = contacts(context);
        let parts = 0..drop.auxiliary_bearings.len();
        outcome.pictures = parts.map(|k| picture(context, k)).collect();
    }
    outcome
}

/// Title of a run, with the case that happens in it.
fn title(scenario: &Scenario) -> String {
    let own = scenario.title.as_deref();
    let own = own.unwrap_or("Drop of a levitated rotor");
    match scenario.system.cases().chosen() {
        Some(case) => format!("{own}: case {case}"),
        None => own.to_string(),
    }
}

/// What pictures need of an auxiliary bearing.
fn picture(context: &Context, k: usize) -> Picture {
    let part = &context.setup.machine.constants.bearings[k];
    let given = context.setup.given(k);
    Picture {
        bearing: part.name.clone(),
        clearance: Some(given.contact.radial_air_clearance),
        pressure_limit: (given.bearing.as_ref()).map(|bearing| bearing.hertz_pressure_limit),
        rolling_cage_ratio: part.bearing.rolling_cage_ratio(),
        balls: part.bearing.balls(),
    }
}

/// The contacts of all auxiliary bearings, in order.
fn contacts(context: &Context) -> Vec<Contact> {
    let mut all: Vec<Contact> = (context.setup.parts().enumerate())
        .flat_map(|(k, name)| {
            context.record(k).contacts.iter().map(move |c| Contact {
                bearing: name.to_string(),
                start: c.start,
                end: c.end,
                peak_force: c.peak_force,
                peak_time: c.peak_time,
            })
        })
        .collect();
    all.sort_by(|a, b| a.start.total_cmp(&b.start));
    all
}
