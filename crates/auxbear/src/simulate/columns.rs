//! The history of a drop as columns.

use super::drop::Context;
use super::outcome::Column;
use model::system::drop::layout::{
    DETAIL, FRICTION_FORCE, HEATS, INNER, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, NORMAL_FORCE,
    OUTER, PENETRATION, ROTOR, SLIP_SPEED, SOURCES,
};
use model::system::drop::record::Row;
use physics::hertz::maximum_pressure;

/// All columns; `time` first.
pub(super) fn history(context: &Context) -> Vec<Column> {
    let machine = context.machine;
    let layout = machine.layout();
    let record = &context.finished.record;
    let start = record
        .rows()
        .next()
        .map(|row| (row.content, machine.flows(row.state)));
    let mut table = Table {
        columns: Vec::new(),
        context,
    };

    table.add("time", "s", "time since release", |row| row.time);
    let centre = |row: &Row| machine.rotor_centre(row.state);
    table.add(
        "rotor.x",
        "m",
        "rotor centre at the bearing plane, to the right",
        |row| centre(row).x,
    );
    table.add(
        "rotor.y",
        "m",
        "rotor centre at the bearing plane, upwards",
        |row| centre(row).y,
    );
    table.channel("rotor.speed", "rad/s", "spin of the rotor", ROTOR + 5);
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
    table.channel(
        "bearing.outer_race.x",
        "m",
        "outer race centre, to the right",
        OUTER,
    );
    table.channel(
        "bearing.outer_race.y",
        "m",
        "outer race centre, upwards",
        OUTER + 1,
    );
    table.add("bearing.cage.speed", "rad/s", "spin of the cage", |row| {
        machine.cage_speed(row.state)
    });
    table.probe(
        "bearing.contact.force",
        "N",
        "normal force of rotor and inner race",
        NORMAL_FORCE,
    );
    table.probe(
        "bearing.contact.friction_force",
        "N",
        "friction force on the rotor, positive along t (counter-clockwise about the race)",
        FRICTION_FORCE,
    );
    table.probe(
        "bearing.contact.penetration",
        "m",
        "penetration of rotor and inner race; negative is the remaining gap",
        PENETRATION,
    );
    table.probe(
        "bearing.contact.slip_speed",
        "m/s",
        "sliding speed of the surfaces, inner race less rotor",
        SLIP_SPEED,
    );
    let n = layout.balls;
    for ball in 0..n {
        let name = |what: &str| format!("bearing.ball_{:02}.{what}", ball + 1);
        table.add(
            &name("azimuth"),
            "rad",
            "azimuth of the ball from x",
            |row| machine.ball_azimuth(row.state, ball),
        );
        let detail = |k: usize| DETAIL + k * n + ball;
        table.probe(
            &name("inner_load"),
            "N",
            "load of the ball on the inner race",
            detail(0),
        );
        table.probe(
            &name("outer_load"),
            "N",
            "load of the ball on the outer race",
            detail(1),
        );
        if layout.ball_states {
            table.probe(
                &name("inner_slip"),
                "m/s",
                "sliding speed at the inner race, race less ball surface",
                detail(2),
            );
            table.probe(
                &name("outer_slip"),
                "m/s",
                "sliding speed at the outer race, race less ball surface",
                detail(3),
            );
            table.probe(
                &name("pocket_force"),
                "N",
                "force of the cage pocket",
                detail(4),
            );
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
    for (i, heat) in HEATS.iter().enumerate() {
        let meaning = format!("heat made since release: {}", heat.replace('_', " "));
        table.channel(
            &format!("energy.heat.{heat}"),
            "J",
            &meaning,
            layout.heat(i),
        );
    }
    for (i, source) in SOURCES.iter().enumerate() {
        let meaning = format!("work put in since release: {}", source.replace('_', " "));
        table.channel(
            &format!("energy.source.{source}"),
            "J",
            &meaning,
            layout.source(i),
        );
    }
    table.add(
        "energy.kinetic",
        "J",
        "kinetic energy of all bodies",
        |row| row.content.translation + row.content.spin,
    );
    table.add(
        "energy.potential",
        "J",
        "energy in springs, contacts and height; zero at the origin",
        |row| row.content.potential,
    );
    if let Some((content, flows)) = start {
        table.add(
            "energy.residual",
            "J",
            "what the energy ledger misses: change of energy plus heats less works",
            |row| {
                let now = machine.flows(row.state);
                row.content.energy() - content.energy() + (now.heat - flows.heat)
                    - (now.work - flows.work)
            },
        );
        table.add(
            "angular_momentum.residual",
            "N m s",
            "change of angular momentum about the origin less the external impulse",
            |row| {
                let now = machine.flows(row.state);
                row.content.angular_momentum
                    - content.angular_momentum
                    - (now.angular_impulse - flows.angular_impulse)
            },
        );
    }
    table.columns
}

struct Table<'a> {
    columns: Vec<Column>,
    context: &'a Context<'a>,
}

impl Table<'_> {
    fn add(&mut self, name: &str, unit: &'static str, meaning: &str, value: impl Fn(&Row) -> f64) {
        let rows = self.context.finished.record.rows();
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
    fn probe(&mut self, name: &str, unit: &'static str, meaning: &str, probe: usize) {
        self.add(name, unit, meaning, |row| row.probe[probe]);
    }
}
