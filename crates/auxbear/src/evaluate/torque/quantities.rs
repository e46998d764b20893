//! Every named result of a torque computation with its law, source and valid range.

use crate::evaluate::torque::asked::{Asked, Moments, law_of, name_of};
use crate::result::list::{List, Origin};
use crate::result::outcome::{Quantity, Value};
use crate::result::static_safety::{AT_THE_LOAD, StaticLoad};
use physics::friction::{Friction, MomentParts};

/// Names the results.
pub(crate) fn name(asked: &Asked) -> Vec<Quantity> {
    let mut list = List(Vec::new());
    place(&mut list, asked);
    steady(&mut list, asked);
    over_acceleration(&mut list, asked);
    over_load(&mut list, asked);
    laws(&mut list, asked);
    lubricants(&mut list, asked);
    list.0
}

fn place(list: &mut List, asked: &Asked) {
    let torque = asked.torque;
    list.number("speed", "rad/s", Ok(torque.speed), &GIVEN);
    list.number("radial_load", "N", Ok(asked.load()), &GIVEN);
    list.number(
        "viscosity",
        "m^2/s",
        torque
            .moment
            .viscosity()
            .ok_or_else(|| "this law sees no lubricant".to_string()),
        &VISCOSITY,
    );
    list.number(
        "temperature",
        "K",
        torque
            .temperature
            .ok_or_else(|| "the viscosity is given as it is".to_string()),
        &GIVEN,
    );
}

fn steady(list: &mut List, asked: &Asked) {
    let parts = asked.friction(&asked.law, asked.torque.speed, asked.load());
    parts_of(list, "", Ok(parts));
    let power = parts.sum() * asked.torque.speed;
    list.number("power_loss", "W", Ok(power), &POWER);
    let load = StaticLoad {
        radial: asked.torque.loads.iter().copied().fold(0.0, f64::max),
        axial: asked.torque.moment.axial_load(),
        contact_angle: None,
    };
    list.static_safety(&asked.torque.rated(), &load, &AT_THE_LOAD);
    let starting = match &asked.law {
        Friction::Skf(law) => {
            Ok(law.starting_moment(asked.load(), asked.torque.moment.axial_load()))
        }
        _ => Err("only the SKF model knows a moment at standstill".to_string()),
    };
    list.number("starting_moment", "N m", starting, &STARTING);
    for (name, unit, value, origin) in [
        (
            "inner_race_set_inertia",
            "kg m^2",
            asked.set.inner_inertia(),
            &INNER_INERTIA,
        ),
        (
            "outer_race_set_inertia",
            "kg m^2",
            asked.set.outer_inertia(),
            &OUTER_INERTIA,
        ),
        (
            "pocket_friction_arm",
            "m",
            asked.set.pocket_friction_arm(),
            &ARM,
        ),
    ] {
        list.number(name, unit, Ok(value), origin);
    }
}

/// M0, M1 and M under names with this beginning.
fn parts_of(list: &mut List, begin: &str, parts: Result<MomentParts<f64>, String>) {
    for (name, part) in [
        (
            "speed_dependent_moment",
            (|parts| parts.speed_dependent) as fn(MomentParts<f64>) -> f64,
        ),
        ("load_dependent_moment", |parts| parts.load_dependent),
        ("friction_moment", |parts| parts.sum()),
    ] {
        let value = parts.as_ref().map(|parts| part(*parts));
        list.number(
            &format!("{begin}{name}"),
            "N m",
            value.map_err(String::clone),
            &FRICTION,
        );
    }
}

fn over_acceleration(list: &mut List, asked: &Asked) {
    let accelerations = &asked.torque.accelerations;
    let all = |part: fn(&Moments) -> f64| {
        let moments = accelerations
            .iter()
            .map(|&acceleration| asked.moments(asked.torque.speed, acceleration));
        Value::List(moments.map(|moments| part(&moments)).collect())
    };
    list.push(
        "accelerations",
        "rad/s^2",
        Value::List(accelerations.clone()),
        &GIVEN,
    );
    for (name, part, origin) in [
        (
            "inner_race_inertia_moments",
            (|moments| moments.inner_inertia) as fn(&Moments) -> f64,
            &INNER_INERTIA,
        ),
        (
            "outer_race_inertia_moments",
            |moments| moments.outer_inertia,
            &OUTER_INERTIA,
        ),
        ("acceleration_loss_moments", |moments| moments.loss, &LOSS),
        ("inner_race_moments", Moments::inner, &INNER),
        ("outer_race_moments", Moments::outer, &OUTER),
    ] {
        list.push(name, "N m", all(part), origin);
    }
}

fn over_load(list: &mut List, asked: &Asked) {
    let loads = &asked.torque.loads;
    list.push("loads", "N", Value::List(loads.clone()), &GIVEN);
    for (name, part) in [
        (
            "load_dependent_moments_over_load",
            (|parts| parts.load_dependent) as fn(MomentParts<f64>) -> f64,
        ),
        ("friction_moments_over_load", |parts| parts.sum()),
    ] {
        let moments = loads
            .iter()
            .map(|&load| part(asked.friction(&asked.law, asked.torque.speed, load)));
        list.push(name, "N m", Value::List(moments.collect()), &FRICTION);
    }
}

fn laws(list: &mut List, asked: &Asked) {
    for compared in &asked.torque.laws {
        let law = compared.moment.clone();
        let law = law.and_then(|moment| law_of(asked.torque, &moment));
        let parts = law.map(|law| asked.friction(&law, asked.torque.speed, asked.load()));
        parts_of(list, &format!("{}_", name_of(compared.law)), parts);
    }
}

fn lubricants(list: &mut List, asked: &Asked) {
    let torque = asked.torque;
    let law = |viscosity| law_of(torque, &torque.moment.with_viscosity(viscosity));
    let moment = |law: Friction<f64>| asked.friction(&law, torque.speed, asked.load()).sum();
    for (number, lubricant) in (1..).zip(&torque.lubricants) {
        let name = |end: &str| format!("lubricant_{number}{end}");
        list.push(&name(""), "", Value::Text(lubricant.name.clone()), &GIVEN);
        let viscosity = lubricant.at(torque.temperature);
        list.number(&name("_viscosity"), "m^2/s", viscosity.clone(), &VISCOSITY);
        let running = viscosity.and_then(law).map(moment);
        list.number(&name("_friction_moment"), "N m", running, &FRICTION);
        // temperature, viscosity and moment, where all are known
        let known = |temperature: &f64| {
            let viscosity = lubricant.at(Some(*temperature))?;
            Ok([*temperature, viscosity, moment(law(viscosity)?)])
        };
        let rows: Vec<Result<[f64; 3], String>> = torque.temperatures.iter().map(known).collect();
        let why = rows.iter().find_map(|row| row.as_ref().err());
        let rows: Vec<[f64; 3]> = rows.iter().filter_map(|row| row.clone().ok()).collect();
        for (place, (end, unit, origin)) in [
            ("_temperatures", "K", &GIVEN),
            ("_viscosities", "m^2/s", &VISCOSITY),
            ("_friction_moments", "N m", &FRICTION),
        ]
        .into_iter()
        .enumerate()
        {
            let value = match (rows.is_empty(), why) {
                (true, Some(why)) => Value::None { why: why.clone() },
                (true, None) => Value::None {
                    why: "no torque.temperatures are given".to_string(),
                },
                (false, _) => Value::List(rows.iter().map(|row| row[place]).collect()),
            };
            list.push(&name(end), unit, value, origin);
        }
    }
}

const ROLLING: &str = "rolling balls, concentric races";

const GIVEN: Origin = Origin {
    law: "",
    source: "the scenario",
    valid: "",
};
const VISCOSITY: Origin = Origin {
    law: "lg lg(ν + 0.7) = A - B lg T through two points [mm²/s, K], where it is not given",
    source: "ASTM D341, Ubbelohde and Walther (from memory)",
    valid: "0.21 to 2e7 mm²/s; sure half the span of the two points beyond them, at most 30 K, drawn on farther out (AB2313)",
};
const FRICTION: Origin = Origin {
    law: "M = M0 + M1 by bearing.moment.law, or by the law named",
    source: "Palmgren 1959, SKF General Catalogue (edition 6000), or the curve given: by the law named; crates/physics/src",
    valid: "where the law holds; a warning says where it is left",
};
const POWER: Origin = Origin {
    law: "M Ω of the steady moment M = M0 + M1",
    source: FRICTION.source,
    valid: "balls that roll at an even speed; all of it becomes heat in the bearing",
};
const STARTING: Origin = Origin {
    law: "M_start = G_sl μ_bl + M_seal",
    source: "SKF General Catalogue (edition 6000), p. 103",
    valid: "20 to 30 °C; it acts in no run: every law fades to 0 at rest",
};
const INNER_INERTIA: Origin = Origin {
    law: "J_I Ω̇, J_I = (7/20 N m_b + ¼ m_c) R²",
    source: "the source paper (10), (14), (19)",
    valid: ROLLING,
};
const OUTER_INERTIA: Origin = Origin {
    law: "-J_O Ω̇, J_O = (1+2s)(3/20 N m_b + ¼ m_c) R²",
    source: "the source paper (11), (15)",
    valid: ROLLING,
};
const ARM: Origin = Origin {
    law: "(1+2s) R/(2(1+s))",
    source: "the source paper (10), (11), (14), (15)",
    valid: "any acceleration; F is the sum over the balls",
};
const LOSS: Origin = Origin {
    law: "arm F(Ω, |Ω̇|), arm = (1+2s) R/(2(1+s))",
    source: "the source paper (10), (11); F is bearing.acceleration_loss",
    valid: ROLLING,
};
const INNER: Origin = Origin {
    law: "t_I = M + J_I Ω̇ + arm F",
    source: "the source paper (10), (14)",
    valid: ROLLING,
};
const OUTER: Origin = Origin {
    law: "t_O = M - J_O Ω̇ + arm F",
    source: "the source paper (11), (15)",
    valid: ROLLING,
};
