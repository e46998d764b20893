//! The history of a spin-up as columns.

use super::outcome::Column;
use super::spin_up::Context;
use crate::scenario::Drive;
use model::bearing::BearingConstants;
use model::system::spin_up::layout::{
    DETAIL, HEATS, INNER, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, PROBES, ROTOR, SOURCES,
};
use model::system::spin_up::record::Row;
use physics::hertz::maximum_pressure;

/// What the probes of the model are, in their order.
const MEANINGS: [&str; PROBES.len()] = [
    "moment t_I of the bearing that resists the inner race",
    "moment t_O of the bearing on the outer race, which a torque arm feels",
    "friction moment M of the law at this speed and load",
    "moment of the drive on the inner race",
    "acceleration of the inner race",
    "radial load applied to the inner race",
    "size of the force of the balls on the inner race",
    "spin of the cage",
    "cage slip, 1 less cage speed over its rolling speed; 0 at rest",
    "slip of the rotor in the bore, rotor less race",
    "friction force of the rotor on the race, forward positive",
    "sum of the ball loads at the inner race",
    "largest ball load at the inner race",
    "largest ball load at the outer race",
];

/// All columns; `time` first.
pub(super) fn history(context: &Context) -> Vec<Column> {
    let machine = context.machine();
    let layout = machine.layout();
    let mut table = Table {
        columns: Vec::new(),
        context,
    };
    table.add("time", "s", "time since the start", |row| row.time);
    let slides = matches!(context.spin_up.drive, Drive::SlidingRotor { .. });
    if slides {
        table.channel("rotor.speed", "rad/s", "spin of the rotor", ROTOR + 1);
    }
    table.channel(
        "bearing.inner_race.x",
        "m",
        "inner race centre, to the right",
        INNER,
    );
    table.channel(
        "bearing.inner_race.y",
        "m",
        "inner race centre, upwards",
        INNER + 1,
    );
    table.channel(
        "bearing.inner_race.speed",
        "rad/s",
        "spin of the inner race",
        INNER + 5,
    );
    for (probe, ((name, unit), meaning)) in PROBES.iter().zip(MEANINGS).enumerate() {
        if slides || !name.starts_with("rotor.") {
            table.add(name, unit, meaning, |row| row.probe[probe]);
        }
    }
    let bearing = &machine.constants.bearing;
    let n = layout.balls;
    for ball in 0..n {
        let name = |what: &str| format!("bearing.ball_{:02}.{what}", ball + 1);
        table.add(
            &name("azimuth"),
            "rad",
            "azimuth of the ball from x",
            |row| bearing.azimuth(&row.state[layout.bearing()], ball),
        );
        let details = [
            ("inner_load", "N", "load of the ball on the inner race"),
            ("outer_load", "N", "load of the ball on the outer race"),
            (
                "inner_slip",
                "m/s",
                "sliding speed at the inner race, race less ball surface",
            ),
            (
                "outer_slip",
                "m/s",
                "sliding speed at the outer race, race less ball surface",
            ),
            ("pocket_force", "N", "force of the cage pocket"),
        ];
        let own = matches!(bearing, BearingConstants::Planar(_));
        let known = if own { details.len() } else { 2 };
        for (k, (what, unit, meaning)) in details.into_iter().take(known).enumerate() {
            table.add(&name(what), unit, meaning, |row| {
                row.probe[DETAIL + k * n + ball]
            });
        }
    }
    let (inner, outer) = (
        context.built.inner_pressure_factor,
        context.built.outer_pressure_factor,
    );
    table.add(
        "bearing.inner_pressure",
        "Pa",
        "largest Hertz pressure of all balls at the inner race",
        |row| maximum_pressure(inner, row.probe[LARGEST_INNER_LOAD]),
    );
    table.add(
        "bearing.outer_pressure",
        "Pa",
        "largest Hertz pressure of all balls at the outer race",
        |row| maximum_pressure(outer, row.probe[LARGEST_OUTER_LOAD]),
    );
    energies(&mut table);
    table.columns
}

fn energies(table: &mut Table<'_>) {
    let context = table.context;
    let machine = context.machine();
    let layout = machine.layout();
    for (i, heat) in HEATS.iter().enumerate() {
        let meaning = format!("heat made since the start: {}", heat.replace('_', " "));
        table.channel(
            &format!("energy.heat.{heat}"),
            "J",
            &meaning,
            layout.heat(i),
        );
    }
    for (i, source) in SOURCES.iter().enumerate() {
        let meaning = format!("work put in since the start: {}", source.replace('_', " "));
        table.channel(
            &format!("energy.source.{source}"),
            "J",
            &meaning,
            layout.source(i),
        );
    }
    table.channel(
        "energy.outer_race.moment_work",
        "J",
        "time integral of t_O times the speed of the inner race",
        layout.work(1),
    );
    table.channel(
        "energy.outer_race.path_term",
        "J",
        "integral of the race's speed over the angular momentum of balls and cage",
        layout.work(2),
    );
    table.add(
        "energy.kinetic",
        "J",
        "kinetic energy of all bodies",
        |row| row.content.translation + row.content.spin,
    );
    table.add(
        "energy.potential",
        "J",
        "energy in contacts; zero where nothing touches",
        |row| row.content.potential,
    );
    table.add(
        "energy.residual",
        "J",
        "what the energy ledger misses: works less heats less change of energy",
        |row| machine.energy_residual(context.start, row.state),
    );
    table.add(
        "angular_momentum.residual",
        "N m s",
        "external impulse less the change of angular momentum about the origin",
        |row| machine.angular_momentum_residual(context.start, row.state),
    );
}

struct Table<'a> {
    columns: Vec<Column>,
    context: &'a Context<'a>,
}

impl Table<'_> {
    fn add(&mut self, name: &str, unit: &'static str, meaning: &str, value: impl Fn(&Row) -> f64) {
        let rows = self.context.record.rows();
        self.columns.push(Column {
            name: name.to_string(),
            unit,
            meaning: meaning.to_string(),
            values: rows.map(|row| value(&row)).collect(),
        });
    }
    fn channel(&mut self, name: &str, unit: &'static str, meaning: &str, channel: usize) {
        self.add(name, unit, meaning, |row| row.state[channel]);
    }
}
