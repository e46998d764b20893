//! What a run shows of a flexible rotor: its shape over time, and what is left of the clearances along it.

use crate::bearing::columns::Table;
use crate::bearing::run::BearingRun;
use crate::drawing::{self, GIVEN};
use crate::drop::context::{Context, Setup};
use crate::drop::shaft::{BuiltShaft, HeldMode, least_cutoff};
use crate::drop::warning_table::{ShaftWarning, compared};
use crate::drop::{Shaft, housings};
use crate::rotor::RotorModel;
use model::system::sampling::Peak;
use outcome::columns::columns;
use outcome::list::results;
use outcome::list::{List, not_given, origins};
use outcome::{Column, Warning};
use physics::magnet::Magnet;
use scenario::drop::Rotor;
use scenario::{AuxiliaryBearing, CUTOFFS};

/// The results that only a flexible rotor has.
pub(crate) fn name(list: &mut List, setup: Setup, run: Option<&Context>) {
    let Some((given, built)) = setup.bent() else {
        return;
    };
    let bearings = untouched(setup, run);
    for mut node in named(given, built) {
        let own = bearings.iter().find(|own| own.place == node.place);
        node.clearance = node.clearance.or(own.and_then(|own| own.clearance));
        let peak = run.map(|run| run.finished.record.places[node.place].value);
        list.named(&[node.name], |list| place(list, &node, peak.as_ref()));
    }
    let bent = Bent {
        given,
        built,
        speed: setup.drop().rotor.speed.abs(),
        bearings,
        peaks: run.map_or(Vec::new(), |run| {
            let places = run.finished.record.places.iter();
            places.map(|peak| peak.value).collect()
        }),
    };
    basis(list, &(), run.map(|_| &bent));
    let places = given.places.iter().zip(&given.nodes);
    let z = &given.model.rotor.nodes;
    let housed = places.filter_map(|(place, node)| Some((place.on?, z[*node])));
    drawing::name(list, &given.model, &housed.collect::<Vec<_>>());
    positions(list, &(), run.map(|_| &bent));
    displacements(list, &(), run);
    if setup.machine.layout().rotor.axial {
        along(list, &setup.drop().rotor, run);
    }
    clearances_along(list, &(), run.map(|_| &bent));
    housings::name(list, setup, run);
}

results! {
    fn place(node: &Named, peak: &f64) {
        "node.*.largest_displacement": number "m", DISPLACEMENT, "largest displacement of the shaft at this node" => *peak;
        "node.*.least_distance": number "m", DISTANCE, "least distance left of the clearance at this node" in document "clearance", unless {
            not_given("rotor.node.clearance", node.clearance)
        } => node.clearance.unwrap_or(f64::NAN) - *peak;
    }
    /// What the modes are.
    fn basis(setup: &(), bent: &Bent) {
        "rotor_mass": number "kg", BASIS, "mass of the rotor" in rotor_line "rotor" => rotor::properties(&bent.given.model.rotor).mass;
        "first_bending_frequency": number "rad/s", BASIS, "frequency of the first bending mode of the free rotor" in rotor_line "bends at" in document "bending" => {
            let mut bends = bent.frequencies().filter(|omega| *omega > 0.0);
            bends.next().ok_or_else(|| "the rotor does not bend".to_string())
        };
        "rotor_cutoff": number "rad/s", BASIS, "frequency up to which free modes are coordinates" => bent.built.cutoff;
        "highest_frequency": number "rad/s", BASIS, "highest frequency of a coordinate" => bent.frequencies().last().unwrap_or(0.0);
        "coordinates": number "", BASIS, "number of coordinates" => bent.built.rotor.coordinates.len() as f64;
        "levitated_mode_frequencies": list "rad/s", HELD, "frequencies of the rotor's modes on its magnets or supports" => bent.modes(|mode| mode.frequency);
        "levitated_mode_damping_ratios": list "", HELD, "damping ratios of these modes" => bent.modes(|mode| mode.damping_ratio);
    }
    /// Where everything stands.
    fn positions(setup: &(), bent: &Bent) {
        "shape_positions": list "m", GIVEN, "places along the shaft at which its shape is known" in shape "place" => bent.z(bent.built.places.iter().copied());
        "bearing_positions": list "m", GIVEN, "places of the auxiliary bearings" in bearings "place" => bent.z(bent.given.nodes.iter().copied());
        "bearing_offsets_x": list "m", GIVEN, "misalignments of the auxiliary bearings to the right" in bearings "x" => bent.offsets(0);
        "bearing_offsets_y": list "m", GIVEN, "misalignments of the auxiliary bearings upwards" in bearings "y" => bent.offsets(1);
    }
    fn displacements(setup: &(), run: &Context) {
        "largest_displacements": list "m", DISPLACEMENT, "largest displacement of the shaft at each of shape_positions" in shape "displacement" => {
            let along = run.setup.bent().map_or(0, |(_, built)| built.places.len());
            run.finished.record.places[..along].iter().map(|peak| peak.value).collect::<Vec<_>>()
        };
    }
    /// Of a rotor that moves along its axis.
    fn along(given: &Rotor, run: &Context) {
        "max_rotor_axial_displacement": number "m", ALONG, "largest displacement of the rotor along its axis" in tile "Largest axial displacement" => {
            run.finished.record.axial.value
        };
        "rotor_axial_clearance": number "m", GIVEN, "how far the rotor may move along its axis" in note "Largest axial displacement: clearance" in bound "AB2425", unless {
            not_given("rotor.axial_clearance", given.axial_clearance)
        } => given.axial_clearance.unwrap_or(f64::NAN);
    }
    /// What stands around the shaft.
    fn clearances_along(setup: &(), bent: &Bent) {
        "clearance_names": text "", GIVEN, "what stands around the shaft" in clearances "name" => bent.around(|own| own.name).join("\n").as_str();
        "clearance_positions": list "m", GIVEN, "its places" in clearances "place" => bent.z(bent.around(|own| own.node).into_iter());
        "clearance_displacements": list "m", DISPLACEMENT, "largest displacements of the shaft there, against the housing that it is of" in clearances "displacement" => {
            bent.around(|own| bent.peaks[own.place])
        };
        "clearances": list "m", GIVEN, "its radial clearances" in clearances "clearance" => bent.around(|own| own.clearance.unwrap_or(f64::NAN));
    }
}

/// A rotor that bends.
struct Bent<'a> {
    given: &'a Shaft,
    built: &'a BuiltShaft,
    /// At the start, rad/s.
    speed: f64,
    /// Auxiliary bearings that the rotor did not touch.
    bearings: Vec<Named<'a>>,
    /// Largest displacement at each watched place, m; none before the run.
    peaks: Vec<f64>,
}

impl<'a> Bent<'a> {
    /// Of its coordinates, rad/s.
    fn frequencies(&self) -> impl Iterator<Item = f64> {
        let coordinates = self.built.rotor.coordinates.iter();
        coordinates.map(|own| own.frequency)
    }
    /// A number of each mode near its speed on its magnets or supports.
    fn modes(&self, of: fn(&HeldMode) -> f64) -> Vec<f64> {
        let held = self.built.held.iter();
        let shown = held.filter(|mode| mode.frequency.abs() <= SHOWN * self.speed);
        shown.map(of).collect()
    }
    /// Positions of nodes, m.
    fn z(&self, nodes: impl Iterator<Item = usize>) -> Vec<f64> {
        nodes
            .map(|node| self.given.model.rotor.nodes[node])
            .collect()
    }
    /// Misalignments of the auxiliary bearings along an axis, m.
    fn offsets(&self, axis: usize) -> Vec<f64> {
        let places = self.given.places.iter();
        places.map(|place| place.misalignment[axis]).collect()
    }
    /// Of each place along it with a clearance.
    fn around<T>(&self, of: impl Fn(&Named<'a>) -> T) -> Vec<T> {
        let all = around(self.given, self.built);
        let around = all.filter(|own| own.clearance.is_some());
        let around = around.map(|own| of(&own));
        around.chain(self.bearings.iter().map(&of)).collect()
    }
}

/// Displacements along the shaft.
pub(crate) fn columns(setup: Setup, run: &BearingRun) -> Vec<Column> {
    let Some((given, built)) = setup.bent() else {
        return Vec::new();
    };
    let mut table = Table::over(run);
    for (place, node) in built.places.iter().enumerate() {
        let (number, z) = (place + 1, 1e3 * given.model.rotor.nodes[*node]);
        let at = |state| setup.machine.place(place, state);
        columns! { table.columns, |row|
            "shape.{number}.x": "m", "displacement of the shaft at {z:.1} mm, to the right" => at(row.state).x;
            "shape.{number}.y": "m", "displacement of the shaft at {z:.1} mm, upwards" => at(row.state).y;
        }
    }
    housings::columns(&mut table, setup);
    table.columns.list
}

/// Number of places whose clearance may be watched.
pub(crate) fn clearances(context: &Context) -> usize {
    let bent = context.setup.bent();
    bent.map_or(0, |(given, built)| around(given, built).count())
}

/// A clearance along the shaft that a member uses up, and by how much.
pub(crate) fn reached(context: &Context, node: usize) -> Option<(f64, Warning)> {
    let (given, built) = context.setup.bent()?;
    let node = around(given, built).nth(node)?;
    let (peak, clearance) = (context.finished.record.places[node.place], node.clearance?);
    let warning = ShaftWarning::Rub {
        part: node.name.to_string(),
        displacement: peak.value,
        time: peak.time,
        clearance,
    };
    (peak.value >= clearance).then(|| (peak.value - clearance, warning.into()))
}

/// A rotor that moves farther along its axis than it may.
pub(crate) fn strikes(context: &Context) -> Option<(f64, Warning)> {
    let clearance = context.setup.drop().rotor.axial_clearance?;
    let Peak { value, time } = context.finished.record.axial;
    let warning = ShaftWarning::Strikes {
        displacement: value,
        time,
        clearance,
    };
    (value >= clearance).then(|| (value - clearance, warning.into()))
}

/// Modes that are too few for impacts.
pub(crate) fn few_modes(context: &Context) -> Option<Warning> {
    let (_, built) = context.setup.bent()?;
    let frequencies = built.rotor.coordinates.iter().map(|own| own.frequency);
    let needed = least_cutoff(frequencies, context.release_speed())?;
    let cutoff = built.cutoff;
    (cutoff < needed).then(|| ShaftWarning::FewModes { cutoff, needed }.into())
}

/// Penetration at which contacts of different exponents are compared, m: 2e9 N/m^(10/9) is 6.19e8 N/m there.
const DEPTH: f64 = 1e-5;

/// Contacts and mounts so stiff that the default number of modes was not shown to do.
pub(crate) fn stiff(context: &Context) -> Option<Warning> {
    let (_, built) = context.setup.bent()?;
    let limits = compared(built.cutoff);
    let slope = |part: &AuxiliaryBearing| {
        let own = &part.contact;
        own.exponent * own.stiffness * DEPTH.powf(own.exponent - 1.0)
    };
    let mut parts = context.setup.drop().auxiliary_bearings.iter();
    let hard =
        parts.find(|part| slope(part) > limits.contact || part.mount.stiffness > limits.mount)?;
    let warning = ShaftWarning::StiffContact {
        contact: slope(hard),
        mount: hard.mount.stiffness,
        cutoff: built.cutoff,
    };
    (built.cutoff <= CUTOFFS[1]).then(|| Warning::from(warning).of_part(&hard.name))
}

/// Supports and seals whose coefficients drive whirl of one sense, as xy differs from yx, about a rotor that turns backward.
pub fn against_spin(model: &RotorModel, speed: f64) -> Option<Warning> {
    let crosses = |own: &rotor::Support| {
        let rows = own.coefficients.rows().iter();
        let mut all = rows.flat_map(|(_, block)| [block.stiffness, block.damping]);
        all.any(|m| m[0][1] != m[1][0])
    };
    let all = model.supports.iter().zip(&model.rotor.supports);
    let names = all
        .filter(|(_, own)| crosses(own))
        .map(|(given, _)| given.name.as_str());
    let names: Vec<&str> = names.collect();
    let supports = names.join(", ");
    (speed < 0.0 && !names.is_empty()).then(|| ShaftWarning::AgainstSpin { supports }.into())
}

/// A mode of the levitated rotor near the speed at which it is released, with its amplification.
pub(crate) fn resonance(context: &Context) -> Option<(f64, Warning)> {
    let (given, built) = context.setup.bent()?;
    // modes are those of the start: a rotor that runs up is released elsewhere
    if context.setup.controlled().is_some() {
        return None;
    }
    let speed = context.setup.drop().rotor.speed.abs();
    let near = built.held.iter().filter(|mode| {
        mode.excited
            && (mode.frequency.abs() - speed).abs() < NEAR * speed
            && mode.damping_ratio < DAMPED
    });
    let worst = near.min_by(|a, b| a.damping_ratio.total_cmp(&b.damping_ratio))?;
    let amplification = 0.5 / worst.damping_ratio.max(0.0);
    let held = match given.model.levitation {
        Some(_) => "on its magnets",
        None => "on its supports",
    };
    let size = match amplification.is_finite() {
        true => format!("an amplification of {amplification:.1}"),
        false => "no damping".to_string(),
    };
    let warning = ShaftWarning::Resonance {
        speed,
        held: held.to_string(),
        frequency: worst.frequency.abs(),
        amplification,
        size,
    };
    Some((amplification, warning.into()))
}

/// Distance between a speed and a mode, over the speed, within which they are near.
const NEAR: f64 = 0.1;
/// Damping ratio from which on a mode does not stand out: an amplification of 2.5.
const DAMPED: f64 = 0.2;
/// Modes up to so many times the speed are shown.
const SHOWN: f64 = 3.0;

/// A place along the shaft with something around it.
struct Named<'a> {
    name: &'a str,
    node: usize,
    place: usize,
    clearance: Option<f64>,
}

/// Auxiliary bearings that the rotor did not touch, each at its node with what it is from the line of levitation on.
fn untouched<'a>(setup: Setup<'a>, run: Option<&Context>) -> Vec<Named<'a>> {
    let (Some((given, built)), Some(run)) = (setup.bent(), run) else {
        return Vec::new();
    };
    let parts = given.places.iter().enumerate();
    let free = parts.filter(|(k, _)| run.record(*k).contacts.is_empty());
    let at = free.filter_map(|(k, place)| {
        let node = given.model.named[place.node];
        let [x, y] = place.misalignment;
        let clearance = setup.given(k).contact.radial_air_clearance - x.hypot(y);
        Some(Named {
            name: &given.model.nodes[place.node].name,
            node,
            place: built.watched(node, place.on)?,
            clearance: Some(clearance),
        })
    });
    at.collect()
}

fn named<'a>(given: &'a Shaft, built: &'a BuiltShaft) -> impl Iterator<Item = Named<'a>> {
    let nodes = given.model.nodes.iter().zip(&given.model.named);
    nodes.filter_map(|(own, node)| {
        Some(Named {
            name: &own.name,
            node: *node,
            place: built.watched(*node, own.on)?,
            clearance: own.clearance,
        })
    })
}

/// Named places, and magnets whose gap is given.
fn around<'a>(given: &'a Shaft, built: &'a BuiltShaft) -> impl Iterator<Item = Named<'a>> {
    named(given, built).chain(magnets(given, built))
}

/// Magnets whose gap is given.
fn magnets<'a>(given: &'a Shaft, built: &'a BuiltShaft) -> impl Iterator<Item = Named<'a>> {
    let models = given.model.levitation.iter();
    models.flat_map(|model| {
        let magnets = model.magnets.iter().enumerate();
        magnets.filter_map(|(k, (name, node, _))| {
            // both axes of a magnet stand beside each other
            let own = &model.levitation.actuators()[2 * k];
            match own.magnet {
                Magnet::Pair(pair) => Some(Named {
                    name,
                    node: *node,
                    place: built.watched(*node, own.axis.on)?,
                    clearance: Some(pair.gap),
                }),
                Magnet::Linear { .. } => None,
            }
        })
    })
}

origins! {
    DISPLACEMENT: law "largest distance of the rotor's axis from the line of levitation, of a node on a housing from where this has it, at 64 points a turn",
        source "crates/model/src/system/machine/record.rs",
        valid "small tilt; modes up to rotor.cutoff with residual flexibility";
    DISTANCE: law "clearance of the node less its largest displacement, against the housing that it is of; negative: the rotor reaches what stands there",
        source "crates/model/src/system/machine/record.rs",
        valid "what stands around the rotor is centred on the line of levitation and touches nothing else";
    ALONG: law "largest distance of the rotor along its axis from where it is levitated, at the ends of steps",
        source "crates/model/src/system/machine/record.rs",
        valid "a rotor that is rigid along its axis";
    HELD: law "eigenvalues of the rotor on its magnets with their controllers, or on its supports, at the speed of the release, up to three \
          times that speed; positive turns with the spin",
        source "crates/levitation/src/closed_loop.rs, crates/rotor/src/modes.rs",
        valid "small motion; samples as a delay; on unequal supports without magnets both ways round stand as positive";
    BASIS: law "free modes up to rotor.cutoff with the residual flexibility of every place that carries something (Rubin)",
        source "Rubin 1975 (from memory), crates/rotor/src/basis.rs",
        valid "a higher rotor.cutoff shows what is left out";
}

/// A shaft that does not go through the bore of an auxiliary bearing; at a step the thinner side counts.
pub(crate) fn thick(context: &Context, k: usize) -> Option<Warning> {
    let given = context.setup.drop().shaft.as_ref()?;
    let z = given.model.rotor.nodes[given.nodes[k]];
    let side = |at: f64| {
        let there = (given.model.pieces.iter()).map(|piece| &piece.layer);
        let there = there.filter(|layer| layer.from < at && at < layer.to);
        let outer = there.map(|layer| {
            let share = (at - layer.from) / (layer.to - layer.from);
            layer.start.outer + (layer.end.outer - layer.start.outer) * share
        });
        outer.fold(0.0, f64::max)
    };
    let sides = [z - BESIDE, z + BESIDE].map(side);
    let shaft = sides.into_iter().filter(|outer| *outer > 0.0);
    let shaft = shaft.fold(f64::INFINITY, f64::min);
    let bore = context.setup.given(k).contact.bore_diameter;
    (shaft.is_finite() && shaft > bore).then(|| ShaftWarning::ThickShaft { shaft, bore }.into())
}

/// Beside a node, m.
const BESIDE: f64 = 1e-6;
