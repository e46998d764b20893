//! From a flexible rotor as its file gives it to that of the kernel: nodes and elements, scaled unbalances, magnets.

mod levitation;

use ::rotor::{
    Disk, Housing, MeshError, Place, PointMass, Rotor, Support, Unbalance, mesh, properties,
};
pub use levitation::LevitationModel;
use physics::unbalance::{residual, shares};
use problem::{Code, Problem};
use scenario::rotor::BalancePlanes;
use scenario::{FlexibleRotor, problem_at};
use std::f64::consts::TAU;
use std::ops::Deref;
use units::number_text;

/// A flexible rotor with its model.
#[derive(Clone, Debug, PartialEq)]
pub struct RotorModel {
    given: FlexibleRotor,
    /// The rotor of the kernel; its parts stand in the order of the file's.
    pub rotor: Rotor,
    /// Nodes of the named places, in their order.
    pub named: Vec<usize>,
    /// Nodes of the forces from outside, in their order.
    pub pushed: Vec<usize>,
    /// Magnets, sensors and controllers.
    pub levitation: Option<LevitationModel>,
}

impl Deref for RotorModel {
    type Target = FlexibleRotor;

    fn deref(&self) -> &FlexibleRotor {
        &self.given
    }
}

impl RotorModel {
    /// The model of a rotor that is rated for a speed, rad/s.
    ///
    /// # Errors
    /// Pieces that are no shaft, and controllers that are none.
    pub fn new(given: &FlexibleRotor, speed: f64) -> Result<RotorModel, Box<Problem>> {
        let magnets = given.levitation.iter().flat_map(|own| &own.magnets);
        let positions = (given.nodes.iter().map(|node| node.at))
            .chain(given.disks.iter().map(|disk| disk.at))
            .chain(given.masses.iter().map(|mass| mass.at))
            .chain(given.supports.iter().filter_map(|support| support.at))
            .chain(given.unbalance.iter().map(|plane| plane.at))
            .chain(given.balance_planes.iter().flat_map(|planes| planes.at))
            .chain(given.forces.iter().map(|force| force.at))
            .chain(magnets.flat_map(|magnet| [magnet.at, magnet.sensed_at]));
        let layers: Vec<_> = given.pieces.iter().map(|piece| piece.layer).collect();
        let mesh = mesh(&layers, &positions.collect::<Vec<_>>());
        let mesh = mesh.map_err(|error| no_shaft(given, error))?;
        let node = |at: f64| mesh.node(at).unwrap_or_default();
        let mut housings = 0..;
        let supports = given.supports.iter().map(|own| Support {
            at: match own.at {
                Some(at) => Place::Node(node(at)),
                None => Place::Housing(housings.next().unwrap_or_default()),
            },
            on: own.on,
            coefficients: own.coefficients.clone(),
            seal: own.seal,
        });
        let mut rotor = Rotor {
            disks: (given.disks.iter())
                .map(|own| Disk {
                    node: node(own.at),
                    mass: own.mass,
                    polar: own.polar,
                    diametral: own.diametral,
                })
                .collect(),
            masses: (given.masses.iter())
                .map(|own| PointMass {
                    node: node(own.at),
                    mass: own.mass,
                })
                .collect(),
            supports: supports.collect(),
            housings: (given.housings.iter())
                .map(|mass| Housing { mass: *mass })
                .collect(),
            unbalance: Vec::new(),
            nodes: mesh.nodes.clone(),
            elements: mesh.elements.clone(),
        };
        let mut given = given.clone();
        if let (Some(grade), Some(planes)) = (given.balance_grade, &given.balance_planes) {
            let residual = balanced(grade, planes, &rotor, speed)?;
            given.unbalance.extend(residual);
        }
        rotor.unbalance = (given.unbalance.iter())
            .map(|own| Unbalance {
                node: node(own.at),
                amount: own.amount,
                phase: own.phase,
            })
            .collect();
        let scaled = given.balance_planes.is_none();
        if let Some(grade) = given.balance_grade.filter(|_| scaled) {
            // all of them in one direction would be the grade: Σ|U| Ω/m = G; directions and shares of the planes stay
            let all: f64 = rotor.unbalance.iter().map(|plane| plane.amount.abs()).sum();
            let factor = residual(grade, properties(&rotor).mass, speed) / all;
            for plane in &mut rotor.unbalance {
                plane.amount *= factor;
            }
        }
        let levitation = given.levitation.as_ref();
        Ok(RotorModel {
            named: given.nodes.iter().map(|own| node(own.at)).collect(),
            pushed: given.forces.iter().map(|own| node(own.at)).collect(),
            levitation: levitation
                .map(|own| LevitationModel::new(own, &node, rotor.nodes.len()))
                .transpose()?,
            rotor,
            given,
        })
    }

    /// Named places with their nodes.
    pub fn named_nodes(&self) -> impl Iterator<Item = (&str, usize)> {
        let names = self.given.nodes.iter().map(|node| node.name.as_str());
        names.zip(self.named.iter().copied())
    }
}

/// What a balance grade leaves in its planes, each in a direction of its own.
fn balanced(
    grade: f64,
    planes: &BalancePlanes,
    rotor: &Rotor,
    speed: f64,
) -> Result<[scenario::rotor::Unbalance; 2], Box<Problem>> {
    let whole = properties(rotor);
    let Some(shares) = shares(planes.at, whole.centre) else {
        let ([one, other], centre) = (planes.at, whole.centre);
        let found = format!("{one:.4} m and {other:.4} m, the mass centre at {centre:.4} m");
        let allowed = "planes on both sides of the mass centre are needed: its levers share the residual unbalance";
        let key = "rotor.balance_planes";
        return Err(problem_at(Code::Conflict, key, found, allowed));
    };
    let all = residual(grade, whole.mass, speed);
    Ok([0, 1].map(|k| scenario::rotor::Unbalance {
        name: planes.names[k].clone(),
        at: planes.at[k],
        amount: all * shares[k],
        phase: TAU * statistics::random::uniform(planes.seed, k as u64, BALANCE),
    }))
}

/// Keeps these numbers apart from others of the same seed.
const BALANCE: u64 = 0x6261_6c61;

/// What is wrong with the pieces of a shaft.
fn no_shaft(given: &FlexibleRotor, error: MeshError) -> Box<Problem> {
    let metres = |z: f64| number_text((z * 1e9).round() / 1e9);
    let path = |index: usize| {
        let piece = &given.pieces[index];
        let word = if piece.layer.carries {
            "section"
        } else {
            "sleeve"
        };
        format!("rotor.{word}.{}", piece.name)
    };
    let (key, found, allowed) = match error {
        MeshError::Conflict(first, second, at) => (
            path(second),
            format!(
                "material where {} has its own, at {} m",
                path(first)["rotor.".len()..].replacen('.', " ", 1),
                metres(at)
            ),
            "pieces that follow each other, or one outside the other (inner_diameter at least the outer_diameter below it), are needed",
        ),
        MeshError::Gap(from, to) => (
            "rotor.section".to_string(),
            format!("no section from {} m to {} m", metres(from), metres(to)),
            "sections without a gap are needed",
        ),
        MeshError::Outside(_) | MeshError::Empty => (
            "rotor.section".to_string(),
            "no section where a part sits".to_string(),
            "tables [[rotor.section]] are needed",
        ),
    };
    problem_at(Code::RotorGeometry, key, found, allowed)
}
