//! The closed loop of a rotor on magnets: refused where it does not hold, else poles, sensitivity, static and turning state.

use crate::rotor::request::gravity;
use levitation::response::{Equilibrium, Excess, Synchronous, excesses, unbalance};
use levitation::sensitivity::{Band, Margins, Peak, Sensitivity, open_loop, zone};
use levitation::{
    C64, ClosedLoop, Coordinates, Plant, Pole, Refused, Verdict, suspension, verdict, weight,
};
use nalgebra::DVector;
use outcome::Warning;
use outcome::list::results;
use outcome::list::{List, origins};
use problem::Problem;
use rotor::{Analysis, Basis, Block, Coefficients, Matrices, Place, Rotor, Support, Unbalance};
use scenario::RotorAnalysis;
use simulate::drawing::GIVEN;
use simulate::levitated::{at_rest, failed, holds, rise, warnings};
use simulate::rotor::{LevitationModel, RotorModel};
use std::f64::consts::TAU;

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
    let magnets = (model.levitation.iter()).flat_map(|own| own.levitation.actuators());
    // both axes of a magnet stand at its node
    out.supports.extend(magnets.step_by(2).map(|own| Support {
        at: Place::Node(own.axis.node),
        on: own.axis.on,
        coefficients: Coefficients::constant(Block::equal(1.0, 0.0)),
        seal: false,
    }));
    out
}

/// Analyses the closed loop. Everything that keeps it from holding the rotor is told here.
pub(crate) fn find(
    analysis: &RotorAnalysis,
    rotor: &Rotor,
    model: &LevitationModel,
    within: &Analysis,
) -> Result<Levitated, Box<Problem>> {
    let band = Band::of_speed(analysis.speed);
    let nodes = rotor.nodes.len();
    let told = |error: Refused| failed(&error.to_string());
    let loops = |speed: f64, slopes: &[(f64, f64)]| -> Result<Looped, Refused> {
        let plane = model.levitation.one_plane_about(slopes);
        let turning = plane.filter(|_| rotor.turns()).and_then(|(plane, slopes)| {
            let plant = Plant::turning(within, nodes, speed)?;
            Some(
                ClosedLoop::about(plant, &plane, slopes)
                    .and_then(|closed| looped(&closed, &rotor.unbalance, speed, band)),
            )
        });
        turning.unwrap_or_else(|| {
            let plant = Plant::planes(within, nodes, speed);
            let closed = ClosedLoop::about(plant, &model.levitation, slopes.to_vec())?;
            looped(&closed, &rotor.unbalance, speed, band)
        })
    };
    let gravity = gravity(analysis);
    let loads = weight(rotor, within, [gravity.re, gravity.im]);
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
pub(crate) fn warned(model: &RotorModel, speed: f64, found: &Levitated) -> Vec<Warning> {
    let of = |model| warnings(model, &found.excesses, speed);
    model.levitation.iter().flat_map(of).collect()
}

/// One speed.
struct Looped {
    poles: Vec<Pole>,
    sensitivity: Sensitivity,
    turning: Option<Synchronous>,
}

fn looped<T: Coordinates>(
    closed: &ClosedLoop<T>,
    planes: &[Unbalance],
    speed: f64,
    band: Band,
) -> Result<Looped, Refused> {
    let poles = closed.poles()?;
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
    rotor: &Rotor,
    model: &LevitationModel,
    full: &Basis,
    matrices: &Matrices,
    (speed, cut): (f64, f64),
) -> Result<Basis, Box<Problem>> {
    let band = Band::of_speed(speed);
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

/// The named results; without values where nothing was found.
pub(crate) fn name(list: &mut List, model: &RotorModel, found: Option<&Levitated>) {
    let Some(model) = &model.levitation else {
        return;
    };
    closed_loop(list, model, found);
    for (index, actuator) in model.levitation.actuators().iter().enumerate() {
        let label = actuator.axis.name.replace(['.', ' '], "_");
        list.named(&[&label], |list| axis(list, &(model, index), found));
        for (at, speed) in SPEEDS.iter().enumerate() {
            let open = found.map(|found| OpenLoop {
                one: &found.sensitivity[at],
                index,
            });
            list.named(&[&label, speed], |list| {
                open_loops(list, &(), open.as_ref())
            });
        }
    }
    for (at, speed) in SPEEDS.iter().enumerate() {
        let one = found.map(|found| &found.sensitivity[at]);
        list.named(&[speed], |list| frequencies(list, &(), one));
    }
}

/// Names of the speeds of [`Levitated::sensitivity`].
const SPEEDS: [&str; 2] = ["standstill", "rated"];

results! {
    fn closed_loop(model: &LevitationModel, run: &Levitated) {
        "levitation.slowest_eigenvalue": number "1/s" headline, POLES, "largest real part of an eigenvalue" in note "Largest sensitivity: slowest eigenvalue" => {
            run.poles.iter().map(|pole| pole.value.re).fold(f64::MIN, f64::max)
        };
        "levitation.pole_real_parts": list "1/s", POLES, "real parts of the eigenvalues in the band" in poles "Re λ" => run.shown(|pole| pole.value.re);
        "levitation.pole_imaginary_parts": list "rad/s", POLES, "their imaginary parts" in poles "Im λ" => run.shown(|pole| pole.value.im);
        "levitation.pole_damping_ratios": list "", POLES, "their damping ratios" in poles "damping ratio" => run.shown(Pole::damping_ratio);
        "levitation.coordinates": number "", POLES, "number of coordinates of the rotor" => run.coordinates as f64;
        "levitation.largest_sensitivity": number "" headline, SENSITIVITY, "largest sensitivity of all axes" in tile "Largest sensitivity" => run.largest_sensitivity();
        "levitation.zone": text "" headline, SENSITIVITY, "zone of ISO 14839-3 of all axes" in note "Largest sensitivity: zone" => zone(run.largest_sensitivity()).to_string();
        "levitation.axes": text "", GIVEN, "names of the axes" in levitated_axes "axis" => {
            let names: Vec<&str> = model.levitation.actuators().iter().map(|a| a.axis.name.as_str()).collect();
            names.join("\n")
        };
    }

    fn axis(of: &(&LevitationModel, usize), run: &Levitated) {
        "levitation.*.static_stiffness": number "N/m" headline, STATIC, "static stiffness" in magnet_axes "static stiffness" => static_stiffness(of.0, of.1, run);
        "levitation.*.static_current": number "A" headline, STATIC, "control current at rest" in magnet_axes "static current" => run.rest.currents[of.1];
        "levitation.*.static_displacement": number "m", STATIC, "displacement at rest" in magnet_axes "static displacement" => run.rest.gaps[of.1];
        "levitation.*.position_stiffness_rise": number "", STATIC, "rise of the position stiffness at rest" => rise(of.0, of.1, &run.rest.slopes);
        "levitation.*.unbalance_current": number "A", TURNING, "amplitude of the current under unbalance" in magnet_axes "unbalance current" => {
            let turning = run.turning.as_ref().map(|turning| turning.currents[of.1].norm());
            turning.ok_or_else(|| "no [[rotor.unbalance]] is given".to_string())
        };
    }

    fn open_loops(setup: &(), run: &OpenLoop) {
        "levitation.*.*.sensitivity_peak": number "" headline, SENSITIVITY, "largest sensitivity" in sensitivities "peak |S|" => run.peak().size;
        "levitation.*.*.sensitivity_peak_frequency": number "Hz", SENSITIVITY, "frequency of the largest sensitivity" in sensitivities "at" => run.peak().at / TAU;
        "levitation.*.*.zone": text "", SENSITIVITY, "zone of ISO 14839-3" in sensitivities "zone" => zone(run.peak().size).to_string();
        "levitation.*.*.phase_margin": number "rad" headline, SENSITIVITY, "phase margin" => run.margin(|margins| margins.phase);
        "levitation.*.*.gain_margin_up": number "", SENSITIVITY, "largest factor on the gain that is stable" => run.margin(|margins| margins.upper_gain);
        "levitation.*.*.gain_margin_down": number "", SENSITIVITY, "smallest factor on the gain that is stable" => run.margin(|margins| margins.lower_gain);
        "levitation.*.*.sensitivity": list "", SENSITIVITY, "sensitivity over frequency" => run.over_frequency(|s| s.norm());
        "levitation.*.*.open_loop_real": list "", SENSITIVITY, "real part of the open loop over frequency" => run.over_frequency(|s| open_loop(s).re);
        "levitation.*.*.open_loop_imaginary": list "", SENSITIVITY, "imaginary part of the open loop over frequency" => run.over_frequency(|s| open_loop(s).im);
    }

    fn frequencies(setup: &(), run: &Sensitivity) {
        "levitation.*.frequencies": list "Hz", SENSITIVITY, "frequencies of these curves" => run.grid.iter().map(|omega| omega / TAU).collect::<Vec<_>>();
    }
}

impl Levitated {
    /// A value of each pole in the band.
    fn shown(&self, value: fn(&Pole) -> f64) -> Vec<f64> {
        let in_band = |pole: &&Pole| pole.value.im.abs() <= self.band.to;
        self.poles.iter().filter(in_band).map(value).collect()
    }

    fn largest_sensitivity(&self) -> f64 {
        let peaks = self.sensitivity.iter().flat_map(|one| &one.peaks);
        peaks.map(|peak| peak.size).fold(0.0, f64::max)
    }
}

fn static_stiffness(
    model: &LevitationModel,
    index: usize,
    found: &Levitated,
) -> Result<f64, String> {
    let all = model.levitation.static_stiffness(&found.rest.slopes);
    match all.get(index) {
        Some(k) if k.is_infinite() => Err("without bound: the controller integrates".to_string()),
        Some(k) => Ok(*k),
        None => Err("one filter serves all axes".to_string()),
    }
}

/// One axis at one speed, all others closed.
struct OpenLoop<'a> {
    one: &'a Sensitivity,
    index: usize,
}

impl OpenLoop<'_> {
    fn peak(&self) -> Peak {
        self.one.peaks[self.index]
    }

    fn margin(&self, which: fn(Margins) -> Option<f64>) -> Result<f64, String> {
        let none = "the open loop does not cross there from 0 to the end of the band";
        which(self.one.margins(self.index)).ok_or_else(|| none.to_string())
    }

    fn over_frequency(&self, value: fn(C64) -> f64) -> Vec<f64> {
        self.one.values[self.index]
            .iter()
            .map(|s| value(*s))
            .collect()
    }
}

const LINEAR: &str = "small motion about the static position under weight, of a pair with its slopes there; samples as a delay, no limit of current and voltage";
origins! {
    POLES: law "eigenvalues of rotor, magnets, amplifiers, controller, delay and sensors as one system; Im λ > 0 turns with positive spin",
        source "crates/levitation/src/closed_loop.rs",
        valid LINEAR;
    SENSITIVITY: law "S = 1/(1 + L) of one axis with all others closed; zones A below 3, B below 4, C below 5, D",
        source "crates/levitation/src/sensitivity.rs; ISO 14839-3 (zones and band from memory, to be verified)",
        valid LINEAR;
    STATIC: law "k_i C(0) - k_s of an axis about the static position; position and currents under weight with the full force law; share by which k_s there exceeds that of equal biases in the centre",
        source "crates/levitation/src/response.rs",
        valid "a rotor at rest";
    TURNING: law "synchronous response of the closed loop at the rated speed; amplitude",
        source "crates/levitation/src/response.rs",
        valid LINEAR;
}

#[cfg(test)]
mod tests;
