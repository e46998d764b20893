//! What a rotor that bends touches before its release, or where it starts.

use crate::drop::shaft::BuiltShaft;
use crate::drop::{Drop, Shaft};
use catalogue::geometry::millimetres;
use model::magnets::AxisConstants;
use number::Vec2;
use physics::magnet::Magnet;
use problem::{Code, Problem};
use scenario::problem_at;
use scenario::several::path_of;

/// Refuses bearings that the rotor touches before its release or where it starts, and those that let it reach a magnet.
pub(crate) fn clear(drop: &Drop, shaft: &Shaft, built: &BuiltShaft) -> Result<(), Box<Problem>> {
    let [x, y] = drop.rotor.start_displacement;
    let start = Vec2::new(x, y);
    let magnets = built.in_time.magnets.iter().flat_map(|own| &own.magnets);
    for magnet in magnets {
        let place = built.displacement(&magnet.node) + start;
        let at_pole = |axis: &&AxisConstants| place.dot(axis.direction).abs() >= axis.law.gap();
        if let Some(axis) = magnet.axes.iter().find(at_pole) {
            let found = "a start at a pole of a magnet";
            let gap = millimetres(axis.law.gap());
            let allowed = format!("less than the gap of {gap} along each axis is needed");
            return Err(problem_at(
                Code::ContactAtStart,
                "rotor.start_x",
                found,
                allowed,
            ));
        }
    }
    for (part, (place, row)) in
        (drop.auxiliary_bearings.iter()).zip(shaft.places.iter().zip(&built.nodes))
    {
        let clearance = part.contact.radial_air_clearance;
        let [x, y] = place.misalignment;
        let steady = built.displacement(row) - Vec2::new(x, y);
        let apart = steady.length_squared().sqrt();
        let started = (steady + start).length_squared().sqrt();
        let key = "contact.radial_air_clearance";
        let problem = |code, found: String, allowed: String| {
            let key = path_of(Some(&part.name), key);
            Err(problem_at(code, key, found, allowed))
        };
        let within = format!(
            "less than the radial air clearance of {} is needed",
            millimetres(clearance)
        );
        if apart >= clearance {
            let found = format!(
                "a levitated rotor that is {} from the middle of the bearing at the release",
                millimetres(apart)
            );
            return problem(Code::ContactAtStart, found, within);
        }
        if started >= clearance {
            let found = format!(
                "a rotor that starts {} from the middle of the bearing {}",
                millimetres(started),
                part.name
            );
            return Err(problem_at(
                Code::ContactAtStart,
                "rotor.start_x",
                found,
                within,
            ));
        }
        let gaps = shaft
            .model
            .levitation
            .iter()
            .flat_map(|model| model.levitation.actuators());
        let gaps = gaps.filter_map(|actuator| match actuator.magnet {
            Magnet::Pair(pair) => Some(pair.gap),
            Magnet::Linear { .. } => None,
        });
        let smallest = gaps.fold(f64::INFINITY, f64::min);
        let travel = part.mount.parts.stop_gap.unwrap_or(0.0);
        if clearance + travel >= smallest {
            let found = match travel > 0.0 {
                true => format!(
                    "{} and {} of travel up to the stop of the mount",
                    millimetres(clearance),
                    millimetres(travel)
                ),
                false => millimetres(clearance),
            };
            return problem(
                Code::ClearanceTooLarge,
                found,
                format!(
                    "less than the gap of the magnets, {}, is needed: the rotor would land on them",
                    millimetres(smallest)
                ),
            );
        }
    }
    Ok(())
}
