//! Housings that carry several bearings, magnets with their sensors, and seals.
//!
//! ```text
//!   m_h ḧ = m_h (g - b̈) + Σ F - K h - C ḣ + F_0       F of all that stands on it; F_0 is such that h = 0 at rest, the rotor levitated
//! ```
//! A housing is a coordinate of the rotor's analysis; its mount is a seal at its row, the last of the machine's.

use crate::drop::Shaft;
use crate::drop::context::{Context, Setup};
use crate::levitated::at_rest;
use crate::rotor::{LevitationModel, RotorModel};
use levitation::Plant;
use model::mount::Housing;
use nalgebra::DVector;
use number::Vec2;
use outcome::list::{List, origins, results};
use problem::Problem;
use rotor::{Basis, Block, Place, Rotor};

/// Stiffness over mass of a housing that does not yield, 1/s²: what it carries is found on it.
const UNYIELDING: f64 = 1e12;

/// Row of a node, less that of the housing against which its displacement counts.
pub(super) fn row_against(
    (rotor, basis): (&Rotor, &Basis),
    place: Place,
    on: Option<usize>,
) -> Vec<f64> {
    let row = |place| basis.shapes.row(rotor.coordinate(place));
    let own = row(place);
    match on {
        None => own.iter().copied().collect(),
        Some(housing) => (own - row(Place::Housing(housing)))
            .iter()
            .copied()
            .collect(),
    }
}

/// Force that the mount of each housing carries at rest, N: its weight, and what a rotor on magnets puts on it; `loads` then have both.
pub(super) fn carried(
    rotor: &Rotor,
    levitation: Option<(&LevitationModel, &Plant<f64>)>,
    (loads, gravity): (&mut DVector<f64>, Vec2<f64>),
    speed: f64,
) -> Result<Vec<Vec2<f64>>, Box<Problem>> {
    let (count, size) = (rotor.housings.len(), loads.len() / 2);
    let mut forces: Vec<_> = (rotor.housings.iter())
        .map(|own| gravity * -own.mass)
        .collect();
    let Some((model, plant)) = levitation.filter(|_| count > 0) else {
        return Ok(forces);
    };
    let mut held = plant.clone();
    let places = || (0..count).flat_map(|k| [k, size + k]);
    for at in places() {
        held.stiffness[(at, at)] += UNYIELDING;
    }
    let rest = at_rest(model, &held, loads, speed)?;
    for at in places() {
        loads[at] -= UNYIELDING * rest.coordinates[at];
    }
    for (k, (force, own)) in forces.iter_mut().zip(&rotor.housings).enumerate() {
        *force += Vec2::new(loads[k], loads[size + k]) * own.mass.sqrt();
    }
    Ok(forces)
}

/// Nodes whose displacement counts against a housing: named ones with a clearance, magnets, bearings.
pub(super) fn against(shaft: &Shaft) -> Vec<(usize, usize)> {
    let model = &shaft.model;
    let named = model.nodes.iter().zip(&model.named);
    let named = named.map(|(own, node)| (*node, own.on));
    let magnets = model.levitation.iter().flat_map(|own| {
        let axes = own.levitation.actuators().iter();
        axes.map(|own| (own.axis.node, own.axis.on))
    });
    let bearings = shaft.nodes.iter().zip(&shaft.places);
    let bearings = bearings.map(|(node, own)| (*node, own.on));
    let all = named.chain(magnets).chain(bearings);
    let mut all: Vec<_> = all.filter_map(|(node, on)| Some((node, on?))).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// A housing as one bearing meets it, in the mean of its directions; what else stands on it is left out.
pub(super) fn alone(rotor: &Rotor, housing: usize, speed: f64) -> Housing<f64> {
    let own = |own: &&rotor::Support| own.at == Place::Housing(housing);
    let mounts = rotor.supports.iter().filter(own);
    let blocks = mounts.map(|own| own.coefficients.at(speed));
    let mean = |of: &dyn Fn(&Block) -> [[f64; 2]; 2]| -> f64 {
        let each = blocks.clone().map(|block| of(&block));
        each.map(|m| 0.5 * (m[0][0] + m[1][1])).sum()
    };
    Housing {
        mass: rotor.housings[housing].mass,
        stiffness: mean(&|block| block.stiffness),
        damping: mean(&|block| block.damping),
    }
}

/// Names of the housings.
fn names(model: &RotorModel) -> impl Iterator<Item = &str> {
    let mounts = model.supports.iter().filter(|own| own.at.is_none());
    mounts.map(|own| own.name.as_str())
}

/// Largest displacement, m, and force, N, of a housing.
struct Peaks([f64; 2]);

/// The results of the housings.
pub(super) fn name(list: &mut List, setup: Setup, run: Option<&Context>) {
    let Some((given, built)) = setup.bent() else {
        return;
    };
    for (k, name) in names(&given.model).enumerate() {
        let peaks = run.map(|run| {
            let record = &run.finished.record;
            let place = built.housing(k);
            Peaks([record.places[place].value, record.on_ground[k].value])
        });
        list.named(&[name], |list| housing(list, &(), peaks.as_ref()));
    }
}

results! {
    fn housing(setup: &(), peaks: &Peaks) {
        "housing.*.largest_displacement": number "m", MOTION, "largest displacement of the housing from where it rests with the levitated rotor" => peaks.0[0];
        "housing.*.largest_force": number "N", FORCE, "largest force of the housing on its mount, besides what this carries at rest" => peaks.0[1];
    }
}

/// Motion of the housings, and their forces on their mounts.
pub(super) fn columns(table: &mut crate::bearing::columns::Table, setup: Setup) {
    let Some((given, built)) = setup.bent() else {
        return;
    };
    let machine = setup.machine;
    for (k, name) in names(&given.model).enumerate() {
        let at = |state| machine.place(built.housing(k), state);
        let force = |state| machine.on_ground(k, state);
        outcome::columns::columns! { table.columns, |row|
            "housing.{name}.x": "m", "displacement of the housing {name}, to the right" => at(row.state).x;
            "housing.{name}.y": "m", "displacement of the housing {name}, upwards" => at(row.state).y;
            "housing.{name}.force_x": "N", "force of the housing {name} on its mount besides what this carries at rest, to the right" => force(row.state).x;
            "housing.{name}.force_y": "N", "the same upwards" => force(row.state).y;
        }
    }
}

origins! {
    MOTION: law "m_h ḧ = m_h (g - b̈) + Σ F - K h - C ḣ + F_0, F of the bearings, magnets and seals that stand on it; at 64 points a turn",
        source "crates/simulate/src/drop/housings.rs, crates/model/src/system/machine/record.rs",
        valid "a rigid housing that translates in the plane of the bearings; it does not tilt";
    FORCE: law "K h + C ḣ of the mount of the housing, at 64 points a turn",
        source "crates/model/src/system/machine/record.rs",
        valid "as the displacement; the static load comes to it";
}
