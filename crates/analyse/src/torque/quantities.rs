//! Every named result of a torque computation with its law, source and valid range.

use crate::torque::request::{Moments, Request, law_of};
use outcome::list::{List, origins, results};
use outcome::{Quantity, Value};
use physics::friction::{Friction, MomentParts};
use scenario::Lubricant;
use simulate::static_safety::{AT_THE_LOAD, StaticLoad, static_safety};

/// Names the results; without a second argument those of any computation.
pub(crate) fn name(asked: &Request, after: Option<&Request>) -> Vec<Quantity> {
    let torque = asked.torque;
    let mut list = List::default();
    steady(&mut list, asked, after);
    over_acceleration(&mut list, asked, after);
    over_load(&mut list, asked, after);
    for compared in &torque.laws {
        let law = compared
            .moment
            .clone()
            .and_then(|moment| law_of(torque, &moment));
        let parts = law.map(|law| asked.friction(&law, torque.speed, asked.load()));
        list.named(&[&compared.law.replace(' ', "_")], |list| {
            by_law(list, &(), after.map(|_| &parts));
        });
    }
    for (number, lubricant) in (1..).zip(&torque.lubricants) {
        let running = Lubricated { asked, lubricant };
        list.named(&[&format!("{number}")], |list| {
            lubricants(list, &(), after.map(|_| &running));
        });
    }
    list.quantities
}

results! {
    fn steady(asked: &Request, run: &Request) {
        "speed": number "rad/s", GIVEN, "speed of the inner race" in place "rad/s" => run.torque.speed;
        "radial_load": number "N", GIVEN, "radial load" in place "N" => run.load();
        "viscosity": number "m^2/s", VISCOSITY, "kinematic viscosity of the oil" in place "mm^2/s" => {
            run.torque.moment.viscosity().ok_or_else(|| "this law sees no lubricant".to_string())
        };
        "temperature": number "K", GIVEN, "temperature of the oil" in place "degC" => {
            run.torque.temperature.ok_or_else(|| "the viscosity is given as it is".to_string())
        };
        "speed_dependent_moment": number "N m", FRICTION, "speed-dependent part M0 of the friction" in parts "M0" => run.steady().speed_dependent;
        "load_dependent_moment": number "N m", FRICTION, "load-dependent part M1 of the friction" in parts "M1" => run.steady().load_dependent;
        "friction_moment": number "N m", FRICTION, "steady moment M = M0 + M1" in parts "M" => run.steady().sum();
        "power_loss": number "W", POWER, "power of the steady moment" in torque_lines "power loss M Ω" => run.steady().sum() * run.torque.speed;
        "static_safety": number "1", AT_THE_LOAD, "static load rating over equivalent static load" => {
            static_safety(&run.torque.rated(), &StaticLoad {
                radial: run.torque.loads.iter().copied().fold(0.0, f64::max),
                axial: run.torque.moment.axial_load(),
                contact_angle: None,
            })
        };
        "starting_moment": number "N m", STARTING, "moment at standstill" in torque_lines "to start from standstill" => match &run.law {
            Friction::Skf(law) => Ok(law.starting_moment(run.load(), run.torque.moment.axial_load())),
            _ => Err("only the SKF model knows a moment at standstill".to_string()),
        };
        "inner_race_set_inertia": number "kg m^2", INNER_INERTIA, "inertia J_I of balls and cage at the inner race" => run.set.inner_inertia();
        "outer_race_set_inertia": number "kg m^2", OUTER_INERTIA, "inertia J_O of balls and cage at the outer race" => run.set.outer_inertia();
        "pocket_friction_arm": number "m", ARM, "arm of the pocket friction" => run.set.pocket_friction_arm();
    }
}

results! {
    fn over_acceleration(asked: &Request, run: &Request) {
        "accelerations": list "rad/s^2", GIVEN, "accelerations of the inner race" in by_acceleration "acceleration" => run.torque.accelerations.clone();
        "inner_race_inertia_moments": list "N m", INNER_INERTIA, "inertia of balls and cage at the inner race" in by_acceleration "inertia, inner" => run.accelerated(|m| m.inner_inertia);
        "outer_race_inertia_moments": list "N m", OUTER_INERTIA, "inertia of balls and cage at the outer race" in by_acceleration "inertia, outer" => run.accelerated(|m| m.outer_inertia);
        "acceleration_loss_moments": list "N m", LOSS, "pocket friction at both races" in by_acceleration "loss F" => run.accelerated(|m| m.loss);
        "inner_race_moments": list "N m", INNER, "moment that resists the inner race" in by_acceleration "t_I" => run.accelerated(Moments::inner);
        "outer_race_moments": list "N m", OUTER, "moment on the outer race" in by_acceleration "t_O" => run.accelerated(Moments::outer);
    }
}

results! {
    fn over_load(asked: &Request, run: &Request) {
        "loads": list "N", GIVEN, "radial loads" in by_load "load" => run.torque.loads.clone();
        "load_dependent_moments_over_load": list "N m", FRICTION, "load-dependent part M1 under each load" in by_load "M1" => run.loaded(|parts| parts.load_dependent);
        "friction_moments_over_load": list "N m", FRICTION, "steady moment M under each load" in by_load "M" => run.loaded(|parts| parts.sum());
    }
}

results! {
    /// By another law.
    fn by_law(setup: &(), run: &Result<MomentParts<f64>, String>) {
        "law_*_speed_dependent_moment": number "N m", FRICTION, "speed-dependent part M0 by this law" in by_law "*" => run.clone().map(|parts| parts.speed_dependent);
        "law_*_load_dependent_moment": number "N m", FRICTION, "load-dependent part M1 by this law" in by_law "*" => run.clone().map(|parts| parts.load_dependent);
        "law_*_friction_moment": number "N m", FRICTION, "steady moment M by this law" in by_law "*" => run.clone().map(|parts| parts.sum());
    }
}

results! {
    /// With another lubricant.
    fn lubricants(setup: &(), run: &Lubricated) {
        "lubricant_*": text "", GIVEN, "name of the lubricant" in by_lubricant "*" => run.lubricant.name.as_str();
        "lubricant_*_viscosity": number "m^2/s", VISCOSITY, "its viscosity" in by_lubricant "*" => run.viscosity(run.asked.torque.temperature);
        "lubricant_*_friction_moment": number "N m", FRICTION, "steady moment M with it" in by_lubricant "*" => {
            run.viscosity(run.asked.torque.temperature).and_then(|viscosity| run.moment(viscosity))
        };
        "lubricant_*_temperatures": list "K", GIVEN, "temperatures at which all of this is known" in by_lubricant "*" => run.over_temperature(0);
        "lubricant_*_viscosities": list "m^2/s", VISCOSITY, "its viscosity at each of them" in by_lubricant "*" => run.over_temperature(1);
        "lubricant_*_friction_moments": list "N m", FRICTION, "steady moment M with it at each of them" in by_lubricant "*" => run.over_temperature(2);
    }
}

impl Request<'_> {
    fn steady(&self) -> MomentParts<f64> {
        self.friction(&self.law, self.torque.speed, self.load())
    }

    /// A moment at each acceleration.
    fn accelerated(&self, part: fn(&Moments) -> f64) -> Vec<f64> {
        let moment = |&acceleration: &f64| part(&self.moments(self.torque.speed, acceleration));
        self.torque.accelerations.iter().map(moment).collect()
    }

    /// A moment under each load.
    fn loaded(&self, part: fn(MomentParts<f64>) -> f64) -> Vec<f64> {
        let moment = |&load: &f64| part(self.friction(&self.law, self.torque.speed, load));
        self.torque.loads.iter().map(moment).collect()
    }
}

/// A bearing with another lubricant.
struct Lubricated<'a> {
    asked: &'a Request<'a>,
    lubricant: &'a Lubricant,
}

impl Lubricated<'_> {
    fn viscosity(&self, temperature: Option<f64>) -> Result<f64, String> {
        self.lubricant.at(temperature)
    }

    /// M, N m.
    fn moment(&self, viscosity: f64) -> Result<f64, String> {
        let torque = self.asked.torque;
        let law = law_of(torque, &torque.moment.with_viscosity(viscosity))?;
        Ok(self
            .asked
            .friction(&law, torque.speed, self.asked.load())
            .sum())
    }

    /// Temperature (0), viscosity (1) or moment (2) at each temperature at which all of them are known.
    fn over_temperature(&self, which: usize) -> Value {
        let row = |temperature: &f64| {
            let viscosity = self.viscosity(Some(*temperature))?;
            Ok([*temperature, viscosity, self.moment(viscosity)?])
        };
        let rows: Vec<Result<[f64; 3], String>> =
            self.asked.torque.temperatures.iter().map(row).collect();
        let known: Vec<f64> = rows.iter().flatten().map(|row| row[which]).collect();
        match (known.is_empty(), rows.into_iter().find_map(Result::err)) {
            (false, _) => Value::List(known),
            (true, Some(why)) => Value::None { why },
            (true, None) => Value::None {
                why: "no torque.temperatures are given".to_string(),
            },
        }
    }
}

const ROLLING: &str = "rolling balls, concentric races";

origins! {
    GIVEN: law "",
        source "the scenario",
        valid "";
    VISCOSITY: law "lg lg(ν + 0.7) = A - B lg T through two points [mm²/s, K], where it is not given",
        source "ASTM D341, Ubbelohde and Walther (from memory)",
        valid "0.21 to 2e7 mm²/s; sure half the span of the two points beyond them, at most 30 K, drawn on farther out (AB2313)";
    FRICTION: law "M = M0 + M1 by bearing.moment.law, or by the law named",
        source "Palmgren 1959, SKF General Catalogue (edition 6000), or the curve given: by the law named; crates/physics/src",
        valid "where the law holds; a warning says where it is left";
    POWER: law "M Ω of the steady moment M = M0 + M1",
        source FRICTION.source,
        valid "balls that roll at an even speed; all of it becomes heat in the bearing";
    STARTING: law "M_start = G_sl μ_bl + M_seal",
        source "SKF General Catalogue (edition 6000), p. 103",
        valid "20 to 30 °C; it acts in no run: every law fades to 0 at rest";
    INNER_INERTIA: law "J_I Ω̇, J_I = (7/20 N m_b + ¼ m_c) R²",
        source "the source paper (10), (14), (19)",
        valid ROLLING;
    OUTER_INERTIA: law "-J_O Ω̇, J_O = (1+2s)(3/20 N m_b + ¼ m_c) R²",
        source "the source paper (11), (15)",
        valid ROLLING;
    ARM: law "(1+2s) R/(2(1+s))",
        source "the source paper (10), (11), (14), (15)",
        valid "any acceleration; F is the sum over the balls";
    LOSS: law "arm F(Ω, |Ω̇|), arm = (1+2s) R/(2(1+s))",
        source "the source paper (10), (11); F is bearing.acceleration_loss",
        valid ROLLING;
    INNER: law "t_I = M + J_I Ω̇ + arm F",
        source "the source paper (10), (14)",
        valid ROLLING;
    OUTER: law "t_O = M - J_O Ω̇ + arm F",
        source "the source paper (11), (15)",
        valid ROLLING;
}
