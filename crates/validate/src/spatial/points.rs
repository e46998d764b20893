//! Derivatives, forces of every ball, energies and momenta at whole states.

use super::given::{Params, by_class, inward, rates_outward};
use crate::compare::{Worst, part};
use crate::json::{array, list, number};
use crate::report::{Row, Tolerance};
use model::spatial::row::BallContacts;
use model::spatial::{Assembly, AssemblyConstants, AssemblyProbe};
use number::Vec3;
use serde_json::Value;

/// Columns of a contact, with their units; then those of the pocket.
const CONTACT: [(&str, &str); 14] = [
    ("approach", "m"),
    ("load", "N"),
    ("elastic_load", "N"),
    ("closing_speed", "m/s"),
    ("slip_power", "W"),
    ("slip_x", "m/s"),
    ("slip_y", "m/s"),
    ("traction_x", "N"),
    ("traction_y", "N"),
    ("spin_couple", "N m"),
    ("sine_of_contact_angle", ""),
    ("spin_rate", "rad/s"),
    ("half_axis", "m"),
    ("rolling_couple", "N m"),
];
const POCKET: [(&str, &str); 4] = [
    ("pocket_penetration", "m"),
    ("pocket_force", "N"),
    ("pocket_arc", "m"),
    ("pocket_axial_offset", "m"),
];
/// Name, unit and value of a force of the assembly.
type Global = (&'static str, &'static str, fn(&AssemblyProbe<f64>) -> f64);
const GLOBALS: [Global; 8] = [
    ("bore_normal_force", "N", |probe| probe.bore_normal_force),
    ("bore_friction", "N", |probe| probe.bore_friction),
    ("bore_penetration", "m", |probe| probe.bore_penetration),
    ("face_normal_force", "N", |probe| probe.face_normal_force),
    ("inner_torque", "N m", |probe| probe.inner_torque),
    ("outer_torque", "N m", |probe| probe.outer_torque),
    ("face_penetration", "m", |probe| probe.face_penetration),
    ("face_friction", "N", |probe| probe.face_friction),
];

pub(super) fn rows(value: &Value) -> Result<Vec<Row>, String> {
    let mut worst = Worst::default();
    for (index, given) in list(value, "points")?.iter().enumerate() {
        let name = given["name"].as_str().unwrap_or_default();
        let place = format!("points[{index}] {name}");
        worst.row(&place, given, |worst| point(given, &place, worst))?;
    }
    Ok(worst.into_rows())
}

fn point(given: &Value, place: &str, worst: &mut Worst) -> Result<(), String> {
    let params = Params(&given["params"]);
    let (machine, frame) = (params.constants()?, params.frame()?);
    let (y, dy): (Vec<f64>, Vec<f64>) = (part(&given["y"])?, part(&given["dy"])?);
    let states = machine.states();
    if y.len() != states || dy.len() != states {
        return Err(format!("y and dy are not {states} numbers"));
    }
    let state = inward(&machine, &frame, &y);
    let assembly = Assembly::<f64>::gather(&|_| &machine);
    let mut rate = vec![0.0; states];
    let probe = assembly.rate(&state, &mut rate);
    let ours = rates_outward(&machine, &frame, &state, &rate);
    for (k, [name, _, unit], largest) in by_class(&machine, &dy) {
        let share = 1e-9 * dy[k].abs().max(1e-3 * largest);
        let why =
            format!("{place}, state {k}; 1e-9 of the value or of 1e-3 of the largest of its class");
        let mut compared = worst.under(Tolerance::Absolute(share), why);
        compared.add(&format!("rate_of_{name}"), unit, [dy[k], ours[k]]);
    }
    balls(given, place, (&machine, &state), worst)?;

    let theirs: [f64; 8] = array(given, "globals")?;
    let mut globals = worst.under(Tolerance::Relative(1e-9), place);
    for ((name, unit, value), theirs) in GLOBALS.into_iter().zip(theirs) {
        globals.add(name, unit, [theirs, value(&probe)]);
    }
    let content = machine.content(&state);
    let mut energies = worst.under(Tolerance::Relative(1e-11), place);
    energies.add(
        "kinetic_energy",
        "J",
        [number(given, "kinetic")?, content.kinetic],
    );
    energies.add(
        "potential_energy",
        "J",
        [number(given, "potential")?, content.potential],
    );
    for (key, unit, momentum, terms) in [
        ("momentum", "N s", content.momentum, content.momentum_terms),
        (
            "angular_momentum",
            "N m s",
            content.angular_momentum,
            content.angular_terms,
        ),
    ] {
        let theirs: [f64; 3] = array(given, key)?;
        let Vec3 { x, y, z } = frame.outward(momentum);
        let why = format!("{place}; 1e-11 of the sum of absolute terms");
        let mut all = worst.under(Tolerance::Absolute(1e-11 * terms), why);
        for (theirs, ours) in theirs.into_iter().zip([x, y, z]) {
            all.add(key, unit, [theirs, ours]);
        }
    }
    Ok(())
}

fn balls(
    given: &Value,
    place: &str,
    (machine, state): (&AssemblyConstants, &[f64]),
    worst: &mut Worst,
) -> Result<(), String> {
    let theirs: Vec<Vec<f64>> = part(&given["per_ball"])?;
    let mut ours = Vec::new();
    for (row, constants) in machine.rows.iter().enumerate() {
        let free = !matches!(constants.cage.guide, model::spatial::CageGuide::Tied);
        ours.extend(
            (0..constants.balls).map(|ball| columns(&machine.ball(row, ball, state), free)),
        );
    }
    let wide = theirs.iter().all(|columns| columns.len() == 32);
    if theirs.len() != ours.len() || !wide {
        return Err("per_ball is no row of 32 numbers a ball".to_string());
    }
    let names = ["inner", "outer"].into_iter().flat_map(|race| {
        CONTACT
            .into_iter()
            .map(move |(name, unit)| (format!("{race}_{name}"), unit))
    });
    let names = names.chain(POCKET.map(|(name, unit)| (name.to_string(), unit)));
    for (k, (name, unit)) in names.enumerate() {
        let largest = theirs
            .iter()
            .fold(0.0_f64, |most, ball| most.max(ball[k].abs()));
        let why = format!("{place}; 1e-9 of the largest of the column");
        let mut column = worst.under(Tolerance::Absolute(1e-9 * largest), why);
        for (theirs, ours) in theirs.iter().zip(&ours) {
            column.add(&name, unit, [theirs[k], ours[k]]);
        }
    }
    Ok(())
}

/// The columns of a ball in the order of the files.
fn columns(ball: &BallContacts<f64>, free: bool) -> [f64; 32] {
    let mut columns = [0.0; 32];
    for (k, (touch, traction)) in ball
        .races
        .touch
        .iter()
        .zip(&ball.races.traction)
        .enumerate()
    {
        let own = &mut columns[14 * k..14 * (k + 1)];
        own[0] = touch.approach;
        if touch.approach > 0.0 {
            let sine = touch.triad.normal[1];
            own[1..].copy_from_slice(&[
                touch.load.force,
                touch.load.elastic,
                touch.closing,
                traction.heat,
                touch.slip.x,
                touch.slip.y,
                traction.force.x,
                traction.force.y,
                traction.couple.z,
                sine,
                touch.turning.z,
                touch.half_axis,
                traction.couple.x,
            ]);
        }
    }
    let pocket = &ball.pocket;
    let zeta = if free { pocket.offset[1] } else { 0.0 };
    columns[28..].copy_from_slice(&[
        pocket.penetration,
        pocket.load.force,
        pocket.offset[0],
        zeta,
    ]);
    columns
}
