//! A rotor that bends, in a machine: its parts, where its bearings stand, what holds it until the release.

use crate::document::Document;
use crate::drop::case::Cases;
use crate::drop::event::{self, Event};
use crate::drop::keys_mount::ON;
use crate::drop::kinds::SpinKind;
use crate::key::quoted;
use crate::rotor::tables::{self, Part};
use crate::rotor::{FlexibleRotor, Node};
use crate::run::{Accuracy, Until};
use crate::system::MACHINE;
use crate::values::{Value, Values};
use problem::{Code, Problem, did_you_mean};

/// A rotor that bends.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaft {
    /// Its parts. Supports hold it until the release where there are no magnets.
    pub rotor: FlexibleRotor,
    /// Modes of the free rotor up to this frequency are coordinates, rad/s; by the rotor where it is not given.
    pub cutoff: Option<f64>,
    /// Until when twice the cutoff is tried, s.
    pub cutoff_check: Option<f64>,
    /// Torque of a drive at standstill, N m.
    pub drive_torque: f64,
    /// Its fall with speed, N m s.
    pub drive_slope: f64,
    /// Drag over speed, N m s.
    pub drag: f64,
    /// Drag over the square of the speed, N m s².
    pub windage: f64,
    /// Time in which the currents of the magnets decay to 1/e, s.
    pub decay_time: f64,
    /// Instant at which the magnets lose their power by the key of the file, s.
    pub power_lost: f64,
    /// Its cases.
    pub cases: Cases,
    /// What happens during the run; with magnets the loss of their power.
    pub events: Vec<Event>,
    /// Where the auxiliary bearings stand, in their order.
    pub places: Vec<BearingPlace>,
}

/// Where an auxiliary bearing stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingPlace {
    /// Its place among the named nodes.
    pub node: usize,
    /// Its middle from the line of levitation, x and y, m.
    pub misalignment: [f64; 2],
    /// The housing on which its mount stands; the ground, or one of its own, without.
    pub on: Option<usize>,
}

impl Shaft {
    /// The rotor of a file, with the values of each of its auxiliary bearings.
    pub fn of(document: &Document, all: &[Values]) -> Result<Shaft, Box<Problem>> {
        let values = &all[0];
        let parts = tables::resolve(document, values)?;
        let not_in_runs = |part: &Part, found: &str, allowed: &str| {
            part.refuse(Code::NotModelled, "", found, allowed)
        };
        const ALONE: &str = "it is computed with system = \"rotor\" alone";
        let rotor = FlexibleRotor::of(&parts, values)?;
        // supports first, then seals, as the rotor has them
        let of = |word: &'static str| parts.iter().filter(move |part| part.kind.word == word);
        let standing = || of("support").chain(of("seal")).chain(of("housing"));
        let held = || standing().zip(&rotor.supports);
        for (part, support) in held().filter(|(_, support)| support.stays) {
            for (_, block) in support.coefficients.rows() {
                let [[xx, xy], [yx, yy]] = block.damping;
                let across = 0.5 * (xy + yx);
                if block.mass != [[0.0; 2]; 2] {
                    let found = format!("a {} with mass in a run", part.kind.word);
                    return not_in_runs(part, &found, ALONE);
                }
                if xx < 0.0 || yy < 0.0 || xx * yy < across * across {
                    let found = format!("a {} in a run whose damping makes energy", part.kind.word);
                    let allowed =
                        "damping that takes energy from every motion is needed, in every row";
                    return not_in_runs(part, &found, allowed);
                }
            }
        }
        // what they carried would have to stay on the housing
        let housed = held().find(|(_, support)| support.on.is_some() && !support.seal);
        if let (Some((part, _)), None) = (housed, &rotor.levitation) {
            let allowed = "a support on the ground is needed where no magnets hold the rotor";
            return part.refuse(
                Code::NotModelled,
                "on",
                "a support on a housing in a run",
                allowed,
            );
        }
        // supports that all stay release nothing: the rotor runs up or down on them
        let stands = (rotor.supports.iter()).any(|own| !own.seal && own.at.is_some());
        let lets_go = held().find(|(_, support)| !support.stays);
        match (lets_go, &rotor.levitation) {
            (Some((part, _)), Some(_)) => {
                let found = "a support beside magnets";
                let allowed = "one of the two is needed as what holds the rotor until the release and lets go; a support beside magnets has after_release = \"stays\"";
                return part.refuse(Code::Conflict, "", found, allowed);
            }
            (None, None) if !stands => {
                let found = "nothing that holds the rotor until the release";
                let allowed = "[[levitation.magnet]] with sensor and controller, or [[rotor.support]] as its springs and dampers, is needed";
                let problem = Problem::new(Code::NotHeld, &values.file, found, allowed);
                return Err(problem);
            }
            _ => {}
        }
        let forced = of("force").next();
        if let Some(part) = forced.filter(|_| values.chosen("run.until") == Some(Until::Standstill))
        {
            let found = "a force beside run.until = \"standstill\"";
            let allowed =
                "run.until = \"duration\" is needed: the coast-down knows no forces from outside";
            return part.refuse(Code::Conflict, "", found, allowed);
        }
        let turned = |part: &&Part| {
            ["torque", "channel_torque"]
                .iter()
                .any(|key| part.known.contains_key(key))
        };
        let held = values.chosen("rotor.spin") == Some(SpinKind::Held);
        if let Some(part) = of("force").find(turned).filter(|_| held) {
            let found = "a torque beside rotor.spin = \"held\"";
            let allowed = "a rotor whose spin is not held is needed";
            return part.refuse(Code::Conflict, "", found, allowed);
        }
        let (cases, events) = event::events(&parts, &rotor, values)?;
        let number = |values: &Values, path: &str| values.number(path).unwrap_or_default();
        let housings: Vec<&str> = of("housing").map(|part| part.label.as_str()).collect();
        let place = |own: &Values| {
            Ok(BearingPlace {
                node: node(own, &rotor.nodes)?,
                misalignment: ["contact.misalignment_x", "contact.misalignment_y"]
                    .map(|path| number(own, path)),
                on: on(own, &housings)?,
            })
        };
        let places: Vec<BearingPlace> =
            all.iter().map(place).collect::<Result<_, Box<Problem>>>()?;
        for (k, part) in of("housing").enumerate() {
            housing(part, &rotor, (k, &places), all)?;
        }
        Ok(Shaft {
            places,
            rotor,
            cutoff: values.number(CUTOFF),
            cutoff_check: values.number("rotor.cutoff_check"),
            drive_torque: number(values, "rotor.drive_torque"),
            drive_slope: number(values, "rotor.drive_slope"),
            drag: number(values, "rotor.drag"),
            windage: number(values, "rotor.windage"),
            decay_time: number(values, "levitation.decay_time"),
            power_lost: number(values, "levitation.power_lost_at"),
            cases,
            events,
        })
    }
}

/// Up to which frequency free modes are kept where the file does not say it, rad/s: at design accuracy the larger one; at screening accuracy as
/// the rotor needs, between both.
pub const CUTOFFS: [f64; 2] = [20e3, 60e3];

const CUTOFF: &str = "rotor.cutoff";

impl Values {
    /// The cutoff of design accuracy. That of screening accuracy waits for the modes of the rotor.
    pub(crate) fn cutoff(&mut self) -> Result<(), Box<Problem>> {
        let design = self.chosen("run.accuracy") == Some(Accuracy::Design);
        if !self.is_in(MACHINE) || !design || !self.lacks(CUTOFF) {
            return Ok(());
        }
        let how = "first impacts of a rotor whose first mode bends at 655 rad/s within half a percent of those of all modes";
        self.put_derived(CUTOFF, Value::Number(CUTOFFS[1]), how)
    }
}

/// Refuses a housing that nothing stands on, that does not stand itself, or whose name another part has.
fn housing(
    part: &Part,
    rotor: &FlexibleRotor,
    (own, places): (usize, &[BearingPlace]),
    all: &[Values],
) -> Result<(), Box<Problem>> {
    let magnets = rotor.levitation.iter().flat_map(|own| &own.magnets);
    let carried = (rotor.supports.iter().map(|own| own.on))
        .chain(magnets.map(|own| own.on))
        .chain(places.iter().map(|own| own.on));
    if !carried.flatten().any(|on| on == own) {
        let found = "a housing that nothing stands on";
        let allowed = "on = its name is needed in a [mount], a [[levitation.magnet]], a [[rotor.seal]] or a [[rotor.support]]";
        return part.refuse(Code::UnusedKey, "", found, allowed);
    }
    let mounts = rotor.supports.iter().filter(|own| own.at.is_none());
    let stands = mounts.skip(own).take(1).all(|mount| {
        let mut rows = mount.coefficients.rows().iter();
        rows.all(|(_, block)| block.stiffness[0][0] > 0.0 && block.stiffness[1][1] > 0.0)
    });
    if !stands {
        let found = "a housing without stiffness";
        let allowed = "a stiffness above 0 in both directions is needed: its own mount";
        return part.refuse(Code::OutOfRange, "stiffness", found, allowed);
    }
    let named = |own: &Values| own.bearing.as_ref() == Some(&part.label);
    if all.iter().any(named) {
        let allowed = "another name is needed: results of both would have the same";
        let found = format!("{}, the name of an auxiliary bearing", quoted(&part.label));
        return part.refuse(Code::Conflict, "name", found, allowed);
    }
    Ok(())
}

/// The node at which a bearing stands.
fn node(values: &Values, nodes: &[Node]) -> Result<usize, Box<Problem>> {
    let names: Vec<&str> = nodes.iter().map(|node| node.name.as_str()).collect();
    let named = values.text("contact.node").unwrap_or_default();
    named_part(values, ("contact.node", &named), "node", &names)
}

/// The housing on which its mount stands.
fn on(values: &Values, housings: &[&str]) -> Result<Option<usize>, Box<Problem>> {
    let named = values.text(ON);
    named
        .map(|named| named_part(values, (ON, &named), "housing", housings))
        .transpose()
}

/// The place of a part that a key names among those of its kind.
fn named_part(
    values: &Values,
    (path, named): (&str, &str),
    kind: &str,
    names: &[&str],
) -> Result<usize, Box<Problem>> {
    if let Some(at) = names.iter().position(|name| *name == named) {
        return Ok(at);
    }
    let allowed = match names {
        [] => format!("a [[rotor.{kind}]] with this name is needed"),
        names => format!(
            "one of the names of [[rotor.{kind}]] is needed: {}",
            names.join(", ")
        ),
    };
    let place = values.place(path);
    let problem = values.problem(Code::NoSuchNode, path, place, quoted(named), allowed);
    Err(problem.with_hint(did_you_mean(named, names.iter().copied())))
}
