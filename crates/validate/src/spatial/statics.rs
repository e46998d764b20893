//! Equilibria: `spatial_quasistatic.json` and `spatial_iso16281.json`.

use super::given::Params;
use crate::compare::{Worst, part};
use crate::machines::json::{list, number, numbers};
use crate::report::{Row, Tolerance};
use model::spatial::race::RaceGroove;
use model::spatial::statics::ball::Running;
use model::spatial::statics::iso16281::LinearBearing;
use model::spatial::statics::{
    BallEquilibrium, Displacement, Equilibrium, RaceControl, RingLoad, StaticBall, StaticRow,
    StaticRows,
};
use physics::groove::{
    axis_over_root_approach, centre_distance, contact_surface_radius, free_contact_angle,
};
use physics::hertz::{BallRace, PointContact, Race};
use physics::load_zone::joint_stiffness;
use physics::materials::{BEARING_STEEL, Material, ball_mass, contact_modulus};
use serde_json::Value;
use std::fmt::Display;

/// Deviation of the two solvers.
const SHARE: f64 = 1e-6;
/// Of stiffness, which the file has by differences.
const STIFFNESS: f64 = 1e-4;

/// Compares numbers of one kind under a share of a size, plus an absolute part.
struct Kind<'a> {
    worst: &'a mut Worst,
    place: &'a str,
}

impl Kind<'_> {
    fn add(&mut self, name: &str, unit: &str, both: [f64; 2], size: f64) {
        self.with(name, unit, both, SHARE * size);
    }
    fn with(&mut self, name: &str, unit: &str, both: [f64; 2], allowed: f64) {
        let mut under = self.worst.under(Tolerance::Absolute(allowed), self.place);
        under.add(name, unit, both);
    }
    /// Lists measured by their largest number, with a floor.
    fn lists(
        &mut self,
        name: &str,
        unit: &str,
        [theirs, ours]: [&[f64]; 2],
        floor: f64,
    ) -> Result<(), String> {
        if theirs.len() != ours.len() {
            return Err(format!("{name}: not {} numbers", ours.len()));
        }
        let largest = theirs
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        for (theirs, ours) in theirs.iter().zip(ours) {
            self.with(name, unit, [*theirs, *ours], SHARE * largest + floor);
        }
        Ok(())
    }
}

fn told(error: impl Display) -> String {
    error.to_string()
}

fn mode(row: &Value) -> Result<RaceControl, String> {
    match row["mode"].as_str() {
        Some("orc") => Ok(RaceControl::Outer),
        Some("irc") => Ok(RaceControl::Inner),
        Some("half") => Ok(RaceControl::Half),
        Some("orc_half") => Ok(RaceControl::OuterHalf),
        other => Err(format!("mode {other:?} is not orc, irc, half or orc_half")),
    }
}

fn static_row(params: &Params, places: [f64; 2]) -> Result<StaticRow, String> {
    let machine = params.constants()?;
    let row = machine.rows.first().ok_or("no row of balls")?;
    let at = |groove: RaceGroove<f64>, place: f64| RaceGroove { place, ..groove };
    Ok(StaticRow {
        balls: row.balls,
        first_azimuth: 0.0,
        ball: StaticBall {
            radius: row.ball.radius,
            mass: row.ball.mass,
            inner: at(row.ball.inner, places[0]),
            outer: at(row.ball.outer, places[1]),
        },
    })
}

pub(super) fn quasi_static(value: &Value) -> Result<Vec<Row>, String> {
    let mut worst = Worst::default();
    for (at, given) in list(value, "rows")?.iter().enumerate() {
        let place = format!("rows[{at}]");
        worst.row(&place, given, |worst| {
            let balls = given["balls"].as_str().unwrap_or_default();
            let params = Params(&value[format!("params_{balls}")]);
            let own = |key: &str| Ok::<_, String>(*params.list(key)?.first().ok_or("no place")?);
            let row = static_row(&params, [own("zgi")?, own("zgo")?])?;
            let running = running(given)?;
            let rows = StaticRows(vec![row]);
            let mut kind = Kind {
                worst,
                place: &place,
            };
            if given.get("Fa").is_some() {
                let force = [0.0, 0.0, number(given, "Fa")?];
                let load = RingLoad {
                    force,
                    moment: [0.0; 2],
                };
                axial(
                    given,
                    &rows.settle(&load, &running).map_err(told)?,
                    &mut kind,
                )
            } else {
                let (force, moment) = (numbers(given, "F")?, numbers(given, "M")?);
                let found = rows.settle(&RingLoad { force, moment }, &running);
                combined(given, &found.map_err(told)?, &mut kind)
            }
        })?;
    }
    for (at, given) in list(value, "duplex")?.iter().enumerate() {
        let place = format!("duplex[{at}]");
        worst.row(&place, given, |worst| {
            duplex(
                given,
                &Params(&value["params_steel"]),
                &mut Kind {
                    worst,
                    place: &place,
                },
            )
        })?;
    }
    Ok(worst.into_rows())
}

fn running(given: &Value) -> Result<Running, String> {
    Ok(Running {
        speed: number(given, "Om")?,
        control: mode(given)?,
    })
}

fn axial(given: &Value, found: &Equilibrium, kind: &mut Kind) -> Result<(), String> {
    let ball = &found.rows[0][0];
    let n = |key: &str| number(given, key);
    for (key, unit, ours) in [
        ("delta_a", "m", found.displacement.shift[2]),
        ("rho", "m", ball.place[0]),
        ("Qi", "N", ball.loads[0]),
        ("Qo", "N", ball.loads[1]),
        ("alpha_i", "rad", ball.angles[0]),
        ("alpha_o", "rad", ball.angles[1]),
        ("cage_speed", "rad/s", ball.orbit_speed),
        ("spin_radial", "rad/s", ball.spin[0]),
        ("spin_axial", "rad/s", ball.spin[1]),
    ] {
        let theirs = n(key)?;
        kind.add(key, unit, [theirs, ours], theirs.abs());
    }
    let z = n("z")?;
    kind.with("z", "m", [z, ball.place[1]], SHARE * z.abs() + 1e-12);
    for (keys, unit, ours) in [
        (["f_i", "f_o"], "N", ball.gyroscopic),
        (["spin_i", "spin_o"], "rad/s", ball.contact_spin),
    ] {
        let theirs = [n(keys[0])?, n(keys[1])?];
        let larger = theirs[0].abs().max(theirs[1].abs());
        for k in 0..2 {
            kind.add(keys[k], unit, [theirs[k], ours[k]], larger);
        }
    }
    for (key, unit, at) in [
        ("Kxx", "N/m", 0),
        ("Kzz", "N/m", 2),
        ("Ktilt", "N m/rad", 3),
    ] {
        let theirs = n(key)?;
        let both = [theirs, found.stiffness[at][at]];
        kind.with(key, unit, both, STIFFNESS * theirs.abs());
    }
    Ok(())
}

fn combined(given: &Value, found: &Equilibrium, kind: &mut Kind) -> Result<(), String> {
    displacement(given, found.displacement, [0.0; 2], kind)?;
    let balls = &found.rows[0];
    of_balls(given, balls, "Qi", "N", |ball| ball.loads[0], kind)?;
    of_balls(given, balls, "Qo", "N", |ball| ball.loads[1], kind)?;
    of_balls(given, balls, "alpha_i", "rad", |ball| ball.angles[0], kind)?;
    of_balls(given, balls, "alpha_o", "rad", |ball| ball.angles[1], kind)
}

fn displacement(
    given: &Value,
    found: Displacement,
    floors: [f64; 2],
    kind: &mut Kind,
) -> Result<(), String> {
    let theirs: [f64; 5] = numbers(given, "u")?;
    let [shift, tilt] = [
        (&theirs[..3], &found.shift[..]),
        (&theirs[3..], &found.tilt[..]),
    ];
    kind.lists("displacement", "m", [shift.0, shift.1], floors[0])?;
    kind.lists("tilt", "rad", [tilt.0, tilt.1], floors[1])
}

fn of_balls(
    given: &Value,
    balls: &[BallEquilibrium],
    key: &str,
    unit: &str,
    value: fn(&BallEquilibrium) -> f64,
    kind: &mut Kind,
) -> Result<(), String> {
    let theirs: Vec<f64> = part(&given[key])?;
    let ours: Vec<f64> = balls.iter().map(value).collect();
    let floor = if unit == "rad" { 1e-10 } else { 0.0 };
    kind.lists(key, unit, [&theirs, &ours], floor)
}

fn duplex(given: &Value, params: &Params, kind: &mut Kind) -> Result<(), String> {
    let own = Params(given);
    let (inner, outer) = (own.list("zgi")?, own.list("zgo")?);
    let places = inner.iter().zip(&outer);
    let rows: Result<Vec<_>, String> = places.map(|(i, o)| static_row(params, [*i, *o])).collect();
    let u: [f64; 5] = numbers(given, "u")?;
    let at = Displacement {
        shift: [u[0], u[1], u[2]],
        tilt: [u[3], u[4]],
    };
    let found = StaticRows(rows?).at(at, &running(given)?).map_err(told)?;
    let thrust = |balls: &Vec<BallEquilibrium>| {
        balls
            .iter()
            .map(|ball| ball.loads[0] * ball.axial_share)
            .sum::<f64>()
    };
    let thrusts: Vec<f64> = found.rows.iter().map(thrust).collect();
    kind.lists(
        "row_axial_load",
        "N",
        [&own.list("row_axial_load")?, &thrusts],
        0.0,
    )?;
    let first: Vec<BallEquilibrium> = found.rows.iter().map(|balls| balls[0]).collect();
    of_balls(given, &first, "Qi", "N", |ball| ball.loads[0], kind)?;
    of_balls(given, &first, "Qo", "N", |ball| ball.loads[1], kind)?;
    of_balls(given, &first, "alpha_i", "rad", |ball| ball.angles[0], kind)?;
    of_balls(given, &first, "alpha_o", "rad", |ball| ball.angles[1], kind)?;
    let theirs: Vec<Vec<f64>> = part(&given["K"])?;
    if theirs.len() != 5 || theirs.iter().any(|row| row.len() != 5) {
        return Err("K is not 5 by 5".to_string());
    }
    for i in 0..5 {
        for k in 0..5 {
            let allowed = STIFFNESS * (theirs[i][i] * theirs[k][k]).abs().sqrt();
            let both = [theirs[i][k], found.stiffness[i][k]];
            kind.with("stiffness of a pair", "", both, allowed);
        }
    }
    Ok(())
}

pub(super) fn iso16281(value: &Value) -> Result<Vec<Row>, String> {
    let inputs = Params(&value["inputs"]);
    let material = Material {
        young_modulus: inputs.number("E")?,
        poisson_ratio: inputs.number("nu")?,
        ..BEARING_STEEL
    };
    let mut worst = Worst::default();
    for (at, given) in list(value, "rows")?.iter().enumerate() {
        let place = format!("rows[{at}]");
        // a row lists null where a displacement is none: those are left out one by one
        let mut kind = Kind {
            worst: &mut worst,
            place: &place,
        };
        iso_row(given, &inputs, material, &mut kind).map_err(|why| format!("{place}: {why}"))?;
    }
    Ok(worst.into_rows())
}

fn iso_row(
    given: &Value,
    inputs: &Params,
    material: Material,
    kind: &mut Kind,
) -> Result<(), String> {
    let params = Params(given);
    let (balls, diameter) = (params.count("Z")?, params.number("D")?);
    let (pitch, clearance) = (inputs.number("D_pw")?, params.number("clearance")?);
    let curvatures = [inputs.number("f_i")?, inputs.number("f_o")?];
    let contact = |race: Race, groove_curvature: f64| {
        let geometry = BallRace {
            ball_diameter: diameter,
            pitch_diameter: pitch,
            groove_curvature,
            contact_angle: 0.0,
            race,
        };
        PointContact::new(geometry.curvature(), contact_modulus(material, material)).map_err(told)
    };
    let inner = contact(Race::Inner, curvatures[0])?;
    let outer = contact(Race::Outer, curvatures[1])?;
    let distance = centre_distance(curvatures, diameter);
    let linear = LinearBearing {
        balls,
        pitch_diameter: pitch,
        centre_distance: distance,
        free_angle: free_contact_angle(clearance, distance),
        stiffness: joint_stiffness(inner.stiffness, outer.stiffness),
    };
    let (radial, axial) = (params.number("Fx")?, params.number("Fa")?);
    let moment = [params.number("M_about_load_axis")?, 0.0];
    let load = RingLoad {
        force: [radial, 0.0, axial],
        moment,
    };
    let Displacement { shift, tilt } = linear.settle(&load).map_err(told)?;
    let ours = [
        ("radial_um", shift[0].hypot(shift[1]) * 1e6, 1e-6),
        ("axial_um", shift[2].abs() * 1e6, 1e-6),
        ("tilt_mrad", tilt[0].hypot(tilt[1]) * 1e3, 1e-7),
    ];
    let own = &given["iso_mode"];
    for (key, ours, floor) in ours {
        if key == "axial_um" && axial == 0.0 {
            continue;
        }
        let unit = if key == "tilt_mrad" { "mrad" } else { "um" };
        let theirs = number(own, key)?;
        kind.with(
            &format!("ISO mode, {key}"),
            unit,
            [theirs, ours],
            SHARE * theirs.abs() + floor,
        );
        if let Some(published) = given["masta"][key].as_f64() {
            let both = [published, ours];
            kind.with(
                &format!("published, {key}"),
                unit,
                both,
                3e-4 * published.abs(),
            );
        }
    }
    let groove = |contact: &PointContact, curvature: f64, centre_radius: f64| RaceGroove {
        centre_radius,
        place: 0.0,
        slack: (curvature - 0.5) * diameter,
        stiffness: contact.stiffness,
        half_axis: axis_over_root_approach(contact),
        half_curvature: 0.5 / contact_surface_radius(0.5 * diameter, curvature * diameter),
    };
    let out = 0.5 * diameter + 0.25 * clearance;
    let rows = StaticRows(vec![StaticRow {
        balls,
        first_azimuth: 0.0,
        ball: StaticBall {
            radius: 0.5 * diameter,
            mass: ball_mass(diameter, BEARING_STEEL.density),
            inner: groove(
                &inner,
                curvatures[0],
                0.5 * pitch - out + curvatures[0] * diameter,
            ),
            outer: groove(
                &outer,
                curvatures[1],
                0.5 * pitch + out - curvatures[1] * diameter,
            ),
        },
    }]);
    let load = RingLoad {
        force: [radial, 0.0, -axial],
        moment,
    };
    let rest = Running {
        speed: 0.0,
        control: RaceControl::Outer,
    };
    let found = rows.settle(&load, &rest).map_err(told)?;
    let theirs = &given["torus_mode"];
    displacement(theirs, found.displacement, [1e-12, 1e-10], kind)?;
    of_balls(
        theirs,
        &found.rows[0],
        "Qi",
        "N",
        |ball| ball.loads[0],
        kind,
    )?;
    of_balls(
        theirs,
        &found.rows[0],
        "alpha_i",
        "rad",
        |ball| ball.angles[0],
        kind,
    )
}
