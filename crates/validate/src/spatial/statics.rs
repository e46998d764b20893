//! Equilibria: `spatial_quasistatic.json` and `spatial_iso16281.json`.

use super::given::{MOST, Params};
use crate::compare::{Worst, part, told};
use crate::json::{array, count, list, number, numbers};
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

/// The first row, at places of its grooves of their own.
fn static_row(params: &Params, places: Option<[f64; 2]>) -> Result<StaticRow, String> {
    let machine = params.constants()?;
    let row = machine.rows.first().ok_or("no row of balls")?;
    let (mut inner, mut outer) = (row.ball.inner, row.ball.outer);
    if let Some(places) = places {
        [inner.place, outer.place] = places;
    }
    Ok(StaticRow {
        balls: row.balls,
        first_azimuth: 0.0,
        ball: StaticBall {
            radius: row.ball.radius,
            mass: row.ball.mass,
            inner,
            outer,
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
            let row = static_row(&params, None)?;
            let running = running(given)?;
            let rows = StaticRows::from(vec![row]);
            let mut kind = Kind {
                worst,
                place: &place,
            };
            let along = given.get("Fa").is_some();
            let (force, moment) = match along {
                true => ([0.0, 0.0, number(given, "Fa")?], [0.0; 2]),
                false => (array(given, "F")?, array(given, "M")?),
            };
            let found = rows.settle(&RingLoad { force, moment }, &running);
            let found = found.map_err(told)?;
            if along {
                axial(given, &found, &mut kind)
            } else {
                displacement(given, found.displacement, [0.0; 2], &mut kind)?;
                of_balls(given, &found.rows[0], 4, &mut kind)
            }
        })?;
    }
    for (at, given) in list(value, "duplex")?.iter().enumerate() {
        let place = format!("duplex[{at}]");
        worst.row(&place, given, |worst| {
            let place = &place;
            let params = Params(&value["params_steel"]);
            duplex(given, &params, &mut Kind { worst, place })
        })?;
    }
    Ok(worst.into_rows())
}

fn running(given: &Value) -> Result<Running, String> {
    let control = match given["mode"].as_str() {
        Some("orc") => RaceControl::Outer,
        Some("irc") => RaceControl::Inner,
        Some("half") => RaceControl::Half,
        Some("orc_half") => RaceControl::OuterHalf,
        other => return Err(format!("mode {other:?} is not orc, irc, half or orc_half")),
    };
    Ok(Running {
        speed: number(given, "Om")?,
        control,
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

/// Name, unit and value of what files list of every ball.
type OfBall = (&'static str, &'static str, fn(&BallEquilibrium) -> f64);
const OF_BALLS: [OfBall; 4] = [
    ("Qi", "N", |ball| ball.loads[0]),
    ("alpha_i", "rad", |ball| ball.angles[0]),
    ("Qo", "N", |ball| ball.loads[1]),
    ("alpha_o", "rad", |ball| ball.angles[1]),
];

fn displacement(
    given: &Value,
    found: Displacement,
    floors: [f64; 2],
    kind: &mut Kind,
) -> Result<(), String> {
    let theirs: [f64; 5] = array(given, "u")?;
    let [shift, tilt] = [
        (&theirs[..3], &found.shift[..]),
        (&theirs[3..], &found.tilt[..]),
    ];
    kind.lists("displacement", "m", [shift.0, shift.1], floors[0])?;
    kind.lists("tilt", "rad", [tilt.0, tilt.1], floors[1])
}

/// Compares the first so many of [`OF_BALLS`].
fn of_balls(
    given: &Value,
    balls: &[BallEquilibrium],
    count: usize,
    kind: &mut Kind,
) -> Result<(), String> {
    for (key, unit, value) in &OF_BALLS[..count] {
        let theirs: Vec<f64> = part(&given[key])?;
        let ours: Vec<f64> = balls.iter().map(value).collect();
        let floor = if *unit == "rad" { 1e-10 } else { 0.0 };
        kind.lists(key, unit, [&theirs, &ours], floor)?;
    }
    Ok(())
}

fn duplex(given: &Value, params: &Params, kind: &mut Kind) -> Result<(), String> {
    let (inner, outer) = (numbers(given, "zgi")?, numbers(given, "zgo")?);
    let places = inner.into_iter().zip(outer);
    let rows = places.map(|(i, o)| static_row(params, Some([i, o])));
    let rows: Result<Vec<_>, String> = rows.collect();
    let u: [f64; 5] = array(given, "u")?;
    let at = Displacement {
        shift: [u[0], u[1], u[2]],
        tilt: [u[3], u[4]],
    };
    let found = StaticRows::from(rows?)
        .at(at, &running(given)?)
        .map_err(told)?;
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
        [&numbers(given, "row_axial_load")?, &thrusts],
        0.0,
    )?;
    let first: Vec<BallEquilibrium> = found.rows.iter().map(|balls| balls[0]).collect();
    of_balls(given, &first, 4, kind)?;
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
    let inputs = &value["inputs"];
    let material = Material {
        young_modulus: number(inputs, "E")?,
        poisson_ratio: number(inputs, "nu")?,
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
        iso_row(given, inputs, material, &mut kind).map_err(|why| format!("{place}: {why}"))?;
    }
    Ok(worst.into_rows())
}

fn iso_row(
    given: &Value,
    inputs: &Value,
    material: Material,
    kind: &mut Kind,
) -> Result<(), String> {
    let (balls, diameter) = (count(given, "Z", MOST)?, number(given, "D")?);
    let (pitch, clearance) = (number(inputs, "D_pw")?, number(given, "clearance")?);
    let curvatures = [number(inputs, "f_i")?, number(inputs, "f_o")?];
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
    let (radial, axial) = (number(given, "Fx")?, number(given, "Fa")?);
    let moment = [number(given, "M_about_load_axis")?, 0.0];
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
    let groove = |contact: &PointContact, curvature: f64, side: f64| RaceGroove {
        centre_radius: 0.5 * pitch
            + side * (0.5 * diameter + 0.25 * clearance - curvature * diameter),
        place: 0.0,
        slack: (curvature - 0.5) * diameter,
        stiffness: contact.stiffness,
        half_axis: axis_over_root_approach(contact),
        half_curvature: 0.5 / contact_surface_radius(0.5 * diameter, curvature * diameter),
    };
    let rows = StaticRows::from(vec![StaticRow {
        balls,
        first_azimuth: 0.0,
        ball: StaticBall {
            radius: 0.5 * diameter,
            mass: ball_mass(diameter, BEARING_STEEL.density),
            inner: groove(&inner, curvatures[0], -1.0),
            outer: groove(&outer, curvatures[1], 1.0),
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
    of_balls(theirs, &found.rows[0], 2, kind)
}
