//! A drop as its file gives it, with the model of its rotor: mass, inertia, and what each bearing carries.

use crate::rotor::RotorModel;
use ::rotor::{C64, Place, properties};
use number::Vec2;
use physics::heat_conduction::STEEL_HEAT;
use physics::support::weight_share;
use problem::{Code, Problem};
use scenario::several::path_of;
use scenario::{Body, RigidBody, problem_at};
use std::ops::Deref;
use units::number_text;

/// A drop with the model of its rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct Drop {
    pub(super) given: scenario::Drop,
    /// Mass and inertia of the rotor as a whole.
    pub body: RigidBody,
    /// The rotor as it bends.
    pub shaft: Option<Box<Shaft>>,
}

/// A rotor that bends.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaft {
    given: scenario::Shaft,
    /// Its model. Supports hold it until the release where there are no magnets.
    pub model: RotorModel,
    /// Nodes of the auxiliary bearings, in their order.
    pub nodes: Vec<usize>,
    /// Shares of its weight on one row of each by statics: of a rigid rotor on rows that are equally stiff. Negative where one lifts.
    pub shares: Vec<f64>,
}

impl Deref for Drop {
    type Target = scenario::Drop;

    fn deref(&self) -> &scenario::Drop {
        &self.given
    }
}

impl Deref for Shaft {
    type Target = scenario::Shaft;

    fn deref(&self) -> &scenario::Shaft {
        &self.given
    }
}

impl Drop {
    /// The drop with the model of its rotor.
    ///
    /// # Errors
    /// A rotor that has none, or that cannot land.
    pub fn of(given: &scenario::Drop) -> Result<Drop, Box<Problem>> {
        let (body, shaft) = match &given.body {
            Body::Rigid(body) => (*body, None),
            Body::Flexible(own) => {
                let shaft = Shaft::of(given, own)?;
                (shaft.body(), Some(Box::new(shaft)))
            }
        };
        let this = Drop {
            given: given.clone(),
            body,
            shaft,
        };
        this.loaded()
    }

    /// What one row of an auxiliary bearing carries of the rotor's weight.
    pub fn share(&self, bearing: usize) -> f64 {
        match &self.shaft {
            Some(shaft) => shaft.shares[bearing].abs(),
            None => 1.0 / self.rows(),
        }
    }

    /// Weight of the rotor on one row of an auxiliary bearing, N.
    pub fn weight(&self, bearing: usize) -> f64 {
        self.body.mass * self.gravity.acceleration * self.share(bearing)
    }

    /// Load on one row of each auxiliary bearing under the weight and forces at nodes of the model, by levers: its size, N, and its direction
    /// from x, rad.
    pub fn loads(&self, forces: &[(usize, Vec2<f64>)]) -> Vec<(f64, f64)> {
        let (sine, cosine) = self.gravity.direction.sin_cos();
        let of_bearing = |k: usize| {
            let weight = (self.weight(k), self.gravity.direction);
            let Some(shaft) = self.shaft.as_ref().filter(|_| !forces.is_empty()) else {
                return weight;
            };
            let of_weight = self.body.mass * self.gravity.acceleration * shaft.shares[k];
            let load =
                forces
                    .iter()
                    .fold(Vec2::new(cosine, sine) * of_weight, |sum, (node, force)| {
                        let share = shares(
                            &shaft.model,
                            &shaft.nodes,
                            self,
                            shaft.model.rotor.nodes[*node],
                        );
                        sum + *force * share[k]
                    });
            (load.length_squared().sqrt(), load.y.atan2(load.x))
        };
        (0..self.auxiliary_bearings.len()).map(of_bearing).collect()
    }

    /// With the weight on each bearing that warms, and the rotor's part that warms with it.
    fn loaded(mut self) -> Result<Drop, Box<Problem>> {
        for k in 0..self.auxiliary_bearings.len() {
            let load = self.weight(k);
            let capacity = self.body.mass * self.share(k) * STEEL_HEAT.specific_heat;
            let part = &mut self.given.auxiliary_bearings[k];
            let Some(warm) = &mut part.warm else {
                continue;
            };
            warm.radial_load = load;
            warm.heat.radial_air_clearance = Some(part.contact.radial_air_clearance);
            let whole = *warm.heat.rotor_capacity.get_or_insert(capacity);
            if let Some(needed) = part.without_core() {
                let found = format!("{} J/K", number_text(whole));
                return Err(conflict(&part.name, "heat.rotor_capacity", &found, &needed));
            }
        }
        Ok(self)
    }
}

impl Shaft {
    fn of(drop: &scenario::Drop, given: &scenario::Shaft) -> Result<Shaft, Box<Problem>> {
        let model = RotorModel::new(&given.rotor, drop.rotor.speed)?;
        let nodes = given.places.iter().map(|place| model.named[place.node]);
        let nodes: Vec<usize> = nodes.collect();
        lands(drop, &nodes, &model)?;
        Ok(Shaft {
            shares: shares(&model, &nodes, drop, properties(&model.rotor).centre),
            given: given.clone(),
            model,
            nodes,
        })
    }

    fn body(&self) -> RigidBody {
        let whole = properties(&self.model.rotor);
        let planes = self.model.rotor.unbalance.iter();
        let moment: C64 = planes
            .map(|plane| C64::from_polar(plane.amount, plane.phase))
            .sum();
        RigidBody {
            mass: whole.mass,
            polar_inertia: whole.polar,
            unbalance_eccentricity: moment.norm() / whole.mass,
        }
    }
}

/// Bearings, and supports that stay, must be at two nodes at least: about one alone nothing keeps the rotor from tilting.
fn lands(drop: &scenario::Drop, nodes: &[usize], model: &RotorModel) -> Result<(), Box<Problem>> {
    let stays = model.rotor.supports.iter().zip(&model.supports);
    let staying = stays.filter_map(|(support, given)| match support.at {
        Place::Node(node) if given.stays && !support.seal => Some(node),
        _ => None,
    });
    let mut all = nodes.iter().copied().chain(staying);
    if all.any(|node| node != nodes[0]) {
        return Ok(());
    }
    let (part, found) = match drop.auxiliary_bearings.as_slice() {
        [only] => (only, "the only auxiliary bearing"),
        all => (&all[1], "the node of all other bearings"),
    };
    let needed = "a rotor lands on two nodes at least";
    Err(conflict(&part.name, "contact.node", found, needed))
}

/// A key of an auxiliary bearing that contradicts the rotor.
fn conflict(bearing: &str, key: &str, found: &str, needed: &str) -> Box<Problem> {
    let of = Some(bearing).filter(|name| !name.is_empty());
    problem_at(Code::Conflict, path_of(of, key), found, needed)
}

/// Shares of a load at a place along the shaft, m, on one row of each bearing.
fn shares(model: &RotorModel, nodes: &[usize], drop: &scenario::Drop, at: f64) -> Vec<f64> {
    let place = |node: &usize| model.rotor.nodes[*node];
    let parts = drop.auxiliary_bearings.iter().zip(nodes);
    let rows = parts.map(|(part, node)| (place(node), part.planes));
    let share = weight_share(rows, at);
    nodes.iter().map(|node| share(place(node))).collect()
}
