//! A rotor that bends, in a machine: its parts, where its bearings stand, what holds it until the release.

use crate::document::Document;
use crate::key::quoted;
use crate::rotor::build::{self, RotorModel};
use crate::rotor::part_keys::STAYS;
use crate::rotor::parts;
use crate::values::Values;
use problem::{Code, Problem, did_you_mean};
use rotor::{Place, Properties, properties};

/// A rotor that bends.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaft {
    /// Its parts. Supports hold it until the release where there are no magnets.
    pub model: RotorModel,
    /// Modes of the free rotor up to this frequency are coordinates, rad/s.
    pub cutoff: f64,
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
    /// Instant at which the magnets lose their power, s; their controllers act until then.
    pub power_lost: f64,
    /// Where the auxiliary bearings stand, in their order.
    pub places: Vec<BearingPlace>,
}

/// Where an auxiliary bearing stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingPlace {
    /// Node of the rotor.
    pub node: usize,
    /// Its middle from the line of levitation, x and y, m.
    pub misalignment: [f64; 2],
    /// Its share of the rotor's weight by statics: of a rigid rotor on bearings that are equally stiff. Negative where it lifts.
    pub share: f64,
}

impl Shaft {
    /// The rotor of a file, with the values of each of its auxiliary bearings.
    pub fn of(document: &Document, all: &[Values]) -> Result<Shaft, Box<Problem>> {
        let values = &all[0];
        let parts = parts::resolve(document, values)?;
        let not_in_runs = |part: &parts::Part, key: &'static str, found: &str, allowed: &str| {
            Err(Box::new(part.problem(
                Code::NotModelled,
                key,
                found,
                allowed,
            )))
        };
        const ALONE: &str = "it is computed with system = \"rotor\" alone";
        if let Some(part) = parts.iter().find(|part| part.kind.word == "housing") {
            return not_in_runs(part, "", "a housing in a run", ALONE);
        }
        let model = build::model(&parts, values)?;
        let number = |values: &Values, path: &str| values.number(path).unwrap_or_default();
        // supports first, then seals, as the rotor has them
        let of = |word: &'static str| parts.iter().filter(move |part| part.kind.word == word);
        let staying = of("support").chain(of("seal")).zip(&model.rotor.supports);
        let staying = staying.zip(&model.stays).filter(|(_, stays)| **stays);
        for ((part, support), _) in staying {
            for (_, block) in support.coefficients.rows() {
                let [[xx, xy], [yx, yy]] = block.damping;
                let across = 0.5 * (xy + yx);
                if block.mass != [[0.0; 2]; 2] {
                    let found = format!("a {} with mass in a run", part.kind.word);
                    return not_in_runs(part, "", &found, ALONE);
                }
                if xx < 0.0 || yy < 0.0 || xx * yy < across * across {
                    let found = format!("a {} in a run whose damping makes energy", part.kind.word);
                    let allowed =
                        "damping that takes energy from every motion is needed, in every row";
                    return not_in_runs(part, "", &found, allowed);
                }
            }
        }
        let is_support = |part: &&parts::Part| part.kind.word == "support";
        let lets_go =
            |part: &&parts::Part| is_support(part) && part.word("after_release") != Some(STAYS);
        // supports that all stay release nothing: the rotor runs up or down on them
        let stands = parts.iter().any(|part| is_support(&part));
        let support = parts.iter().find(lets_go);
        match (support, &model.levitation) {
            (Some(part), Some(_)) => {
                let found = "a support beside magnets";
                let allowed = "one of the two is needed as what holds the rotor until the release and lets go; a support beside magnets has after_release = \"stays\"";
                return Err(Box::new(part.problem(Code::Conflict, "", found, allowed)));
            }
            (None, None) if !stands => {
                let found = "nothing that holds the rotor until the release";
                let allowed = "[[levitation.magnet]] with sensor and controller, or [[rotor.support]] as its springs and dampers, is needed";
                let problem = Problem::new(Code::NotHeld, &values.file, found, allowed);
                return Err(Box::new(problem));
            }
            _ => {}
        }
        let nodes = all
            .iter()
            .map(|own| node(own, &model))
            .collect::<Result<Vec<_>, _>>()?;
        lands(all, &nodes, &model)?;
        let shares = shares(&model, &nodes);
        let places = (all.iter().zip(&nodes).zip(shares))
            .map(|((own, node), share)| BearingPlace {
                node: *node,
                misalignment: ["contact.misalignment_x", "contact.misalignment_y"]
                    .map(|path| number(own, path)),
                share,
            })
            .collect();
        Ok(Shaft {
            model,
            cutoff: number(values, "rotor.cutoff"),
            cutoff_check: values.number("rotor.cutoff_check"),
            drive_torque: number(values, "rotor.drive_torque"),
            drive_slope: number(values, "rotor.drive_slope"),
            drag: number(values, "rotor.drag"),
            windage: number(values, "rotor.windage"),
            decay_time: number(values, "levitation.decay_time"),
            power_lost: number(values, "levitation.power_lost_at"),
            places,
        })
    }

    /// Mass, centre and inertia of the rotor.
    pub fn properties(&self) -> Properties {
        properties(&self.model.rotor)
    }
}

/// Bearings, and supports that stay, must be at two nodes at least: about one alone nothing keeps the rotor from tilting.
fn lands(all: &[Values], nodes: &[usize], model: &RotorModel) -> Result<(), Box<Problem>> {
    let stays = model.rotor.supports.iter().zip(&model.stays);
    let staying = stays.filter_map(|(support, stays)| match support.at {
        Place::Node(node) if *stays && !support.seal => Some(node),
        _ => None,
    });
    if nodes
        .iter()
        .copied()
        .chain(staying)
        .any(|node| node != nodes[0])
    {
        return Ok(());
    }
    const PATH: &str = "contact.node";
    let (own, found) = match all {
        [only] => (only, "the only auxiliary bearing"),
        _ => (&all[1], "the node of all other bearings"),
    };
    let needed = "a rotor lands on two nodes at least".to_string();
    let place = own.place(PATH);
    let problem = own.problem(Code::Conflict, PATH, place, found.to_string(), needed);
    Err(Box::new(problem))
}

/// The node at which a bearing stands.
fn node(values: &Values, model: &RotorModel) -> Result<usize, Box<Problem>> {
    const PATH: &str = "contact.node";
    let named = values.text(PATH).unwrap_or_default();
    if let Some((_, node)) = model.nodes.iter().find(|(name, _)| *name == named) {
        return Ok(*node);
    }
    let names = || model.nodes.iter().map(|(name, _)| name.as_str());
    let allowed = match model.nodes.is_empty() {
        true => "a [[rotor.node]] with this name is needed".to_string(),
        false => format!(
            "one of the names of [[rotor.node]] is needed: {}",
            names().collect::<Vec<_>>().join(", ")
        ),
    };
    let problem = values.problem(
        Code::NoSuchNode,
        PATH,
        values.place(PATH),
        quoted(&named),
        allowed,
    );
    Err(Box::new(problem.with_hint(did_you_mean(&named, names()))))
}

/// Shares of the weight: 1/n and what balances the moment about the middle of the bearings.
fn shares(model: &RotorModel, nodes: &[usize]) -> Vec<f64> {
    let places: Vec<f64> = nodes.iter().map(|node| model.rotor.nodes[*node]).collect();
    let count = places.len() as f64;
    let middle = places.iter().sum::<f64>() / count;
    let spread: f64 = places.iter().map(|z| (z - middle).powi(2)).sum();
    let lever = properties(&model.rotor).centre - middle;
    places
        .iter()
        .map(|z| match spread > 0.0 {
            true => 1.0 / count + lever * (z - middle) / spread,
            false => 1.0 / count,
        })
        .collect()
}
