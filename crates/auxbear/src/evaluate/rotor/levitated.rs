//! The closed loop of a rotor on magnets: refused where it does not hold, else poles, sensitivity, static and turning state.

use crate::problem::Problem;
use crate::result::list::{List, Origin};
use crate::result::outcome::Value;
use crate::result::outcome::Warning;
use crate::scenario::{LevitationModel, RotorAnalysis, RotorModel};
use crate::simulate::levitated::{at_rest, failed, holds, rise, warnings};
use levitation::response::{Equilibrium, Excess, Synchronous, excesses, unbalance};
use levitation::sensitivity::{Band, Sensitivity, open_loop, zone};
use levitation::{
    C64, ClosedLoop, Coordinates, Plant, Pole, Refused, Verdict, suspension, verdict, weight,
};
use nalgebra::DVector;
use rotor::{Analysis, Basis, Block, Coefficients, Matrices, Place, Rotor, Support};

/// Largest frequency of the coordinates over that of the band: residual flexibilities have the rest.
const BEYOND: f64 = 4.0;

/// What was found of the closed loop.
pub(crate) struct Levitated {
    poles: Vec<Pole>,
    band: Band,
    /// At standstill, at the rated speed.
    sensitivity: [Sensitivity; 2],
    /// At standstill.
    rest: Equilibrium,
    /// k_i and k_s of each axis about the static position at the rated speed.
    slopes: Vec<(f64, f64)>,
    turning: Option<Synchronous>,
    /// Limits that the steady motion at the rated speed passes.
    excesses: Vec<Excess>,
    coordinates: usize,
    /// x + jy of each coordinate of the rotor at rest under its weight.
    pub(crate) sag: DVector<C64>,
}

/// A rotor in the coordinates of an analysis, held by its magnets too, as they act about the static position at the rated speed.
pub(crate) fn on_magnets(
    within: Analysis,
    model: &RotorModel,
    found: Option<&Levitated>,
) -> Result<Analysis, Box<Problem>> {
    let (Some(levitation), Some(found)) = (&model.levitation, found) else {
        return Ok(within);
    };
    let (nodes, slopes) = (model.rotor.nodes.len(), &found.slopes);
    let feedback = suspension(&within, nodes, &levitation.levitation, slopes);
    Ok(within.held_by(feedback.map_err(|error| failed(&error.to_string()))?))
}

/// The rotor on springs where its magnets act, whose stiffness stands for theirs.
pub(crate) fn on_springs(model: &RotorModel) -> Rotor {
    let mut out = model.rotor.clone();
    let magnets = model.levitation.iter().flat_map(|own| &own.magnets);
    out.supports.extend(magnets.map(|(_, at, _)| Support {
        at: Place::Node(*at),
        on: None,
        coefficients: Coefficients::constant(Block::equal(1.0, 0.0)),
        seal: false,
    }));
    out
}

/// Analyses the closed loop. Everything that keeps it from holding the rotor is told here.
pub(crate) fn find(
    analysis: &RotorAnalysis,
    model: &LevitationModel,
    within: &Analysis,
) -> Result<Levitated, Box<Problem>> {
    let rotor = &analysis.model.rotor;
    let band = Band::of_speed(analysis.speed);
    let nodes = rotor.nodes.len();
    let told = |error: Refused| failed(&error.to_string());
    let loops = |speed: f64, slopes: &[(f64, f64)]| -> Result<Looped, Refused> {
        let plane = model.levitation.one_plane_about(slopes);
        let turning = plane.filter(|_| rotor.turns()).and_then(|(plane, slopes)| {
            let plant = Plant::turning(within, nodes, speed)?;
            Some(
                ClosedLoop::about(plant, &plane, slopes)
                    .and_then(|closed| looped(&closed, analysis, speed, band)),
            )
        });
        turning.unwrap_or_else(|| {
            let plant = Plant::planes(within, nodes, speed);
            let closed = ClosedLoop::about(plant, &model.levitation, slopes.to_vec())?;
            looped(&closed, analysis, speed, band)
        })
    };
    let gravity = [analysis.weight().re, analysis.weight().im];
    let loads = weight(rotor, within, gravity);
    let mut found = Vec::new();
    for speed in [analysis.speed, 0.0] {
        let plant = Plant::planes(within, nodes, speed);
        let rest = at_rest(model, &plant, &loads, speed)?;
        let one = loops(speed, &rest.slopes).map_err(told)?;
        holds(model, &one.poles, &rest.slopes, speed)?;
        found.push((rest, one));
    }
    let (Some((rest, still)), Some((loaded, rated))) = (found.pop(), found.pop()) else {
        return Err(failed("no speed"));
    };
    let turning = rated.turning.as_ref();
    let excesses = excesses(&model.levitation, &loaded, turning, analysis.speed);
    let shapes = &within.basis.shapes;
    let plane = |from: usize| shapes * rest.coordinates.rows(from, shapes.ncols());
    Ok(Levitated {
        sag: plane(0).zip_map(&plane(shapes.ncols()), C64::new),
        poles: rated.poles,
        band,
        sensitivity: [still.sensitivity, rated.sensitivity],
        turning: rated.turning,
        slopes: loaded.slopes,
        excesses,
        rest,
        coordinates: within.basis.len(),
    })
}

/// What the steady motion at the rated speed makes doubtful.
pub(crate) fn warned(analysis: &RotorAnalysis, found: &Levitated) -> Vec<Warning> {
    let model = analysis.model.levitation.iter();
    let of = |model| warnings(model, &found.excesses, analysis.speed);
    model.flat_map(of).collect()
}

/// One speed.
struct Looped {
    poles: Vec<Pole>,
    sensitivity: Sensitivity,
    turning: Option<Synchronous>,
}

fn looped<T: Coordinates>(
    closed: &ClosedLoop<T>,
    analysis: &RotorAnalysis,
    speed: f64,
    band: Band,
) -> Result<Looped, Refused> {
    let poles = closed.poles()?;
    let planes = &analysis.model.rotor.unbalance;
    let turning = (!planes.is_empty() && speed != 0.0).then(|| unbalance(closed, planes, speed));
    let mut sensitivity = match verdict(&poles) {
        Verdict::Stable => {
            // the open loops are large at frequencies of their own
            let open = closed.open_loop()?.into_iter().map(|value| Pole {
                value,
                turning: 1.0,
            });
            let seen: Vec<Pole> = poles.iter().copied().chain(open).collect();
            Sensitivity::new(closed, &seen, band)?
        }
        _ => Sensitivity::default(),
    };
    let mut turning = turning.transpose()?;
    if T::COMPLEX {
        // one number stands for both axes
        sensitivity = sensitivity.of_both_axes();
        if let Some(turning) = &mut turning {
            for list in [&mut turning.currents, &mut turning.gaps] {
                *list = list.iter().flat_map(|own| [*own, *own]).collect();
            }
        }
    }
    Ok(Looped {
        poles,
        sensitivity,
        turning,
    })
}

/// Free modes and residual flexibility of what carries supports, unbalances, magnets and sensors, and of gyroscopic moments.
pub(crate) fn basis(
    analysis: &RotorAnalysis,
    model: &LevitationModel,
    full: &Basis,
    matrices: &Matrices,
    cut: f64,
) -> Result<Basis, Box<Problem>> {
    let rotor = &analysis.model.rotor;
    let band = Band::of_speed(analysis.speed);
    let cut = cut.max(BEYOND * band.to);
    let mut kept = rotor.kept();
    let nodes = model
        .magnets
        .iter()
        .flat_map(|(_, at, sensed)| [*at, *sensed]);
    kept.extend(nodes.map(|node| rotor.displacement(node)));
    kept.sort_unstable();
    kept.dedup();
    let slow = full
        .frequencies
        .partition_point(|omega| *omega <= cut / BEYOND);
    let moments = &matrices.gyroscopic * full.shapes.columns(0, slow);
    let mut forces = rotor::unit_forces(rotor.size(), &kept);
    let first = forces.ncols();
    forces = forces.insert_columns(first, slow, 0.0);
    forces.columns_mut(first, slow).copy_from(&moments);
    let reduced = full.reduced(cut, &forces);
    reduced.map_err(|error| failed(&error.to_string()))
}

/// The named results.
pub(crate) fn name(list: &mut List, analysis: &RotorAnalysis, found: &Levitated) {
    let Some(model) = &analysis.model.levitation else {
        return;
    };
    let slowest = found
        .poles
        .iter()
        .map(|pole| pole.value.re)
        .fold(f64::MIN, f64::max);
    list.number("levitation.slowest_eigenvalue", "1/s", Ok(slowest), &POLES);
    let shown: Vec<&Pole> = found
        .poles
        .iter()
        .filter(|p| p.value.im.abs() <= found.band.to)
        .collect();
    let mut poles = |name: &str, unit, value: fn(&Pole) -> f64| {
        list.push(
            name,
            unit,
            Value::List(shown.iter().map(|p| value(p)).collect()),
            &POLES,
        );
    };
    poles("levitation.pole_real_parts", "1/s", |pole| pole.value.re);
    poles("levitation.pole_imaginary_parts", "rad/s", |pole| {
        pole.value.im
    });
    poles("levitation.pole_damping_ratios", "", Pole::damping_ratio);
    list.number(
        "levitation.coordinates",
        "",
        Ok(found.coordinates as f64),
        &POLES,
    );
    let peaks = found.sensitivity.iter().flat_map(|one| &one.peaks);
    let largest = peaks.map(|peak| peak.size).fold(0.0, f64::max);
    list.number(
        "levitation.largest_sensitivity",
        "",
        Ok(largest),
        &SENSITIVITY,
    );
    let letter = zone(largest).to_string();
    list.push("levitation.zone", "", Value::Text(letter), &SENSITIVITY);
    let names = model
        .levitation
        .actuators()
        .iter()
        .map(|a| a.axis.name.as_str());
    let names: Vec<&str> = names.collect();
    list.push("levitation.axes", "", Value::Text(names.join("\n")), &GIVEN);
    for (index, label) in names.iter().enumerate() {
        axis(
            list,
            model,
            found,
            index,
            &format!("levitation.{}", label.replace(['.', ' '], "_")),
        );
    }
    for (at, one) in ["standstill", "rated"].iter().zip(&found.sensitivity) {
        let hertz = one.grid.iter().map(|omega| omega / std::f64::consts::TAU);
        list.push(
            &format!("levitation.{at}.frequencies"),
            "Hz",
            Value::List(hertz.collect()),
            &SENSITIVITY,
        );
    }
}

/// The results of one axis.
fn axis(list: &mut List, model: &LevitationModel, found: &Levitated, index: usize, begin: &str) {
    let slopes = &found.rest.slopes;
    let stiffness = (model.levitation.static_stiffness(slopes).get(index)).copied();
    let stiffness = match stiffness {
        Some(k) if k.is_infinite() => Err("without bound: the controller integrates".to_string()),
        Some(k) => Ok(k),
        None => Err("one filter serves all axes".to_string()),
    };
    list.number(
        &format!("{begin}.static_stiffness"),
        "N/m",
        stiffness,
        &STATIC,
    );
    list.number(
        &format!("{begin}.static_current"),
        "A",
        Ok(found.rest.currents[index]),
        &STATIC,
    );
    list.number(
        &format!("{begin}.static_displacement"),
        "m",
        Ok(found.rest.gaps[index]),
        &STATIC,
    );
    list.number(
        &format!("{begin}.position_stiffness_rise"),
        "",
        Ok(rise(model, index, slopes)),
        &STATIC,
    );
    let turning = (found.turning.as_ref())
        .map(|turning| turning.currents[index].norm())
        .ok_or_else(|| "no [[rotor.unbalance]] is given".to_string());
    list.number(
        &format!("{begin}.unbalance_current"),
        "A",
        turning,
        &TURNING,
    );
    for (at, one) in ["standstill", "rated"].iter().zip(&found.sensitivity) {
        let begin = format!("{begin}.{at}");
        let (peak, values) = (one.peaks[index], &one.values[index]);
        list.number(
            &format!("{begin}.sensitivity_peak"),
            "",
            Ok(peak.size),
            &SENSITIVITY,
        );
        let hertz = peak.at / std::f64::consts::TAU;
        list.number(
            &format!("{begin}.sensitivity_peak_frequency"),
            "Hz",
            Ok(hertz),
            &SENSITIVITY,
        );
        let letter = zone(peak.size).to_string();
        list.push(
            &format!("{begin}.zone"),
            "",
            Value::Text(letter),
            &SENSITIVITY,
        );
        let open: Vec<C64> = values.iter().map(|s| open_loop(*s)).collect();
        let margins = one.margins(index);
        let none =
            || "the open loop does not cross there from 0 to the end of the band".to_string();
        for (name, unit, value) in [
            ("phase_margin", "rad", margins.phase),
            ("gain_margin_up", "", margins.upper_gain),
            ("gain_margin_down", "", margins.lower_gain),
        ] {
            list.number(
                &format!("{begin}.{name}"),
                unit,
                value.ok_or_else(none),
                &SENSITIVITY,
            );
        }
        let mut curve = |name: &str, values: Vec<f64>| {
            list.push(
                &format!("{begin}.{name}"),
                "",
                Value::List(values),
                &SENSITIVITY,
            );
        };
        curve("sensitivity", values.iter().map(|s| s.norm()).collect());
        curve("open_loop_real", open.iter().map(|l| l.re).collect());
        curve("open_loop_imaginary", open.iter().map(|l| l.im).collect());
    }
}

const GIVEN: Origin = Origin {
    law: "",
    source: "the scenario",
    valid: "",
};
const LINEAR: &str = "small motion about the static position under weight, of a pair with its slopes there; samples as a delay, no limit of current and voltage";
const POLES: Origin = Origin {
    law: "eigenvalues of rotor, magnets, amplifiers, controller, delay and sensors as one system; Im λ > 0 turns with positive spin",
    source: "crates/levitation/src/closed_loop.rs",
    valid: LINEAR,
};
const SENSITIVITY: Origin = Origin {
    law: "S = 1/(1 + L) of one axis with all others closed; zones A below 3, B below 4, C below 5, D",
    source: "crates/levitation/src/sensitivity.rs; ISO 14839-3 (zones and band from memory, to be verified)",
    valid: LINEAR,
};
const STATIC: Origin = Origin {
    law: "k_i C(0) - k_s of an axis about the static position; position and currents under weight with the full force law; share by which k_s there exceeds that of equal biases in the centre",
    source: "crates/levitation/src/response.rs",
    valid: "a rotor at rest",
};
const TURNING: Origin = Origin {
    law: "synchronous response of the closed loop at the rated speed; amplitude",
    source: "crates/levitation/src/response.rs",
    valid: LINEAR,
};

#[cfg(test)]
mod tests;
