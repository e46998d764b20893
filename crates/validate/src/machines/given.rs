//! Machines of the files as constants of the model.

use crate::compare::{Refusal, part, told};
use crate::json::{array, list, number, pair};
use crate::machine::ReferenceMachine;
use crate::{rotors, simulation};
use auxbear::simulate::drop::shaft::{in_coordinates, planes, row};
use model::auxiliary_bearing::AuxiliaryBearingConstants;
use model::bearing::BearingConstants;
use model::levitation::Levitation;
use model::magnets::MagnetsConstants;
use model::mount::{FrictionRing, HardStop, Housing, MaxwellBranch, MountParts, SqueezeFilm};
use model::rotor::RotorConstants;
use model::schedule::Schedule;
use model::system::machine::MachineConstants;
use nalgebra::DVector;
use number::Vec2;
use rotor::{Basis, Block, Coefficients, Matrices, Place, Rotor, Support, Unbalance};
use serde::Deserialize;
use serde_json::{Map, Value, json};

/// A rotor of elements in some coordinates.
pub(super) struct Coordinates {
    pub rotor: Rotor,
    pub matrices: Matrices,
    pub basis: Basis,
}

impl Coordinates {
    /// In all its coordinates.
    pub fn full(rotor: Rotor) -> Result<Self, String> {
        let matrices = Matrices::new(&rotor);
        let basis = Basis::full(&rotor, &matrices).map_err(told)?;
        Ok(Coordinates {
            rotor,
            matrices,
            basis,
        })
    }
    /// In free modes up to a frequency (rad/s) and the residual flexibility of some nodes.
    pub fn reduced(rotor: Rotor, cut: f64, mut nodes: Vec<usize>) -> Result<Self, String> {
        let full = Self::full(rotor)?;
        nodes.sort_unstable();
        nodes.dedup();
        let kept: Vec<usize> = nodes.iter().map(|n| full.rotor.displacement(*n)).collect();
        let forces = rotor::unit_forces(full.rotor.size(), &kept);
        let basis = full.basis.reduced(cut, &forces);
        Ok(Coordinates {
            basis: basis.map_err(told)?,
            ..full
        })
    }
    pub fn row(&self, node: usize) -> Vec<f64> {
        row(&self.basis, node)
    }
    /// Constants of the rotor with its unbalances.
    pub fn constants(&self) -> RotorConstants {
        in_coordinates(&self.rotor, &self.matrices, &self.basis)
            .with_unbalance(&planes(&self.rotor, &self.basis))
    }
    /// Coordinates η of displacements and slopes of all nodes.
    pub fn of(&self, q: &[Vec2<f64>]) -> Vec<Vec2<f64>> {
        let plane = |of: &dyn Fn(&Vec2<f64>) -> f64| {
            let values = DVector::from_iterator(q.len(), q.iter().map(of));
            self.basis.shapes.tr_mul(&(&self.matrices.mass * values))
        };
        let (x, y) = (plane(&|q| q.x), plane(&|q| q.y));
        let pairs = x.iter().zip(y.iter());
        pairs.map(|(x, y)| Vec2::new(*x, *y)).collect()
    }
    /// Displacements and slopes of all nodes at coordinates η.
    pub fn to_nodes(&self, own: &[Vec2<f64>]) -> Vec<Vec2<f64>> {
        let plane = |of: &dyn Fn(&Vec2<f64>) -> f64| {
            &self.basis.shapes * DVector::from_iterator(own.len(), own.iter().map(of))
        };
        let (x, y) = (plane(&|a| a.x), plane(&|a| a.y));
        let pairs = x.iter().zip(y.iter());
        pairs.map(|(x, y)| Vec2::new(*x, *y)).collect()
    }
}

/// The rotor of a file, with its unbalances.
pub(super) fn rotor(model: &Value, unbalances: &Value) -> Result<Rotor, Refusal> {
    let mut rotor = rotors::modelled(&json!({ "model": model }))?.rotor();
    rotor.unbalance = unbalance(unbalances)?;
    let nodes = rotor.nodes.len();
    match rotor.unbalance.iter().find(|plane| plane.node >= nodes) {
        Some(plane) => Err(format!("unbalance at node {} of {nodes}", plane.node).into()),
        None => Ok(rotor),
    }
}

fn unbalance(value: &Value) -> Result<Vec<Unbalance>, String> {
    let planes = list(value, "unbalance")?.iter();
    let plane = |plane: &Value| {
        Ok(Unbalance {
            node: index(plane, "node")?,
            amount: number(plane, "kg_m")?,
            phase: number(plane, "phase_rad")?,
        })
    };
    planes.map(plane).collect()
}

/// A rotor on the springs and dampers to ground that a file lists as its supports.
pub(super) fn on_springs(mut rotor: Rotor, file: &Value) -> Result<Rotor, String> {
    for support in list(file, "supports")? {
        let block = Block::equal(number(support, "k")?, number(support, "c")?);
        rotor.supports.push(Support {
            at: Place::Node(index(support, "node")?),
            on: None,
            coefficients: Coefficients::constant(block),
            seal: false,
        });
    }
    Ok(rotor)
}

/// A node or a count.
pub(super) fn index(value: &Value, key: &str) -> Result<usize, String> {
    let index = value[key].as_u64();
    index
        .map(|index| index as usize)
        .ok_or_else(|| format!("{key} is no count"))
}

/// Keys of a mount, and of where a bearing stands.
#[derive(Deserialize)]
pub(super) struct GivenMount {
    pub ks: f64,
    pub cs: f64,
    k1: f64,
    tau1: f64,
    k2: f64,
    tau2: f64,
    kf: f64,
    ef: f64,
    nf: f64,
    sfd: f64,
    sfd_c: f64,
    sfd_pi: i64,
    hs_k: f64,
    hs_gap: f64,
    hs_a: f64,
    #[serde(default)]
    m_h: f64,
    #[serde(default)]
    kh: f64,
    #[serde(default)]
    ch: f64,
}

impl GivenMount {
    /// What it has besides spring and damper. Both branches and the ring are there always: they keep the places of the file's states.
    pub fn parts(&self) -> Result<MountParts, String> {
        let above = [self.tau1, self.tau2, self.ef];
        if above.iter().any(|value| *value <= 0.0) {
            return Err("tau1, tau2 and ef of a mount must be above 0".to_string());
        }
        Ok(MountParts {
            branches: [(self.k1, self.tau1), (self.k2, self.tau2)]
                .map(|(stiffness, time)| MaxwellBranch {
                    stiffness,
                    rate: 1.0 / time,
                })
                .to_vec(),
            ring: Some(FrictionRing {
                stiffness: self.kf,
                travel: self.ef,
                exponent: self.nf,
            }),
            film: (self.sfd > 0.0).then_some(SqueezeFilm {
                factor: self.sfd,
                clearance: self.sfd_c,
                cavitates: self.sfd_pi == 1,
            }),
            stop: (self.hs_k > 0.0).then_some(HardStop {
                stiffness: self.hs_k,
                gap: self.hs_gap,
                damping: self.hs_a,
            }),
            housing: (self.m_h > 0.0).then_some(Housing {
                mass: self.m_h,
                stiffness: self.kh,
                damping: self.ch,
            }),
            ..MountParts::NONE
        })
    }
}

/// Keys that a bearing of these files has besides those of a machine with one bearing.
const OF_THE_MACHINE: [&str; 19] = [
    "node", "ox", "oy", "k1", "tau1", "k2", "tau2", "kf", "ef", "nf", "sfd", "sfd_c", "sfd_pi",
    "hs_k", "hs_gap", "hs_a", "m_h", "kh", "ch",
];

fn bearing(
    given: &Value,
    coordinates: &Coordinates,
    gravity: Vec2<f64>,
) -> Result<AuxiliaryBearingConstants, String> {
    let mount: GivenMount = part(given)?;
    let own = given.as_object().ok_or("a bearing is no table")?;
    let rest = [
        "g", "tau_i", "fix_i", "rotor", "m_r", "I_r", "e_u", "ka", "ca",
    ];
    let alone: Map<String, Value> = own
        .iter()
        .filter(|(key, _)| !OF_THE_MACHINE.contains(&key.as_str()))
        .map(|(key, value)| (key.clone(), value.clone()))
        .chain(rest.map(|key| {
            let value = match key {
                "rotor" => json!(1),
                "fix_i" => json!(0),
                _ => json!(0.0),
            };
            (key.to_string(), value)
        }))
        .collect();
    let mut alone: ReferenceMachine = part(&Value::Object(alone))?;
    alone.states()?;
    alone.rotor_mass = 1.0;
    alone.rotor_inertia = 1.0;
    let mut built = simulation::constants(&alone, 0.0)?.bearings.remove(0);
    let node = index(given, "node")?;
    if node >= coordinates.rotor.nodes.len() {
        return Err(format!(
            "a bearing at node {node}, which the rotor does not have"
        ));
    }
    built.name = format!("at_{node}");
    built.node = coordinates.row(node);
    built.datum = Vec2::new(number(given, "ox")?, number(given, "oy")?);
    built.mount_parts = mount.parts()?;
    if let BearingConstants::Planar(planar) = &mut built.bearing {
        planar.ball.gravity = gravity;
    }
    Ok(built)
}

/// A machine of a file on a rotor in some coordinates, at a speed at release.
pub(super) fn machine(
    given: &Value,
    coordinates: &Coordinates,
    speed: f64,
) -> Result<MachineConstants, String> {
    let [x, y] = array(given, "gravity")?;
    let gravity = Vec2::new(x, y);
    let torque = |part: &str, key: &str| given[part][key].as_f64().unwrap_or(0.0);
    let bearings = list(given, "bearings")?.iter();
    let bearings = bearings.map(|given| bearing(given, coordinates, gravity));
    let mut constants = MachineConstants {
        rotor: RotorConstants {
            drive_torque: torque("drive", "d0"),
            drive_slope: torque("drive", "d1"),
            drag: torque("drag", "a"),
            drag_square: torque("drag", "b"),
            ..coordinates.constants()
        },
        axial: None,
        levitation: Levitation {
            stiffness: 0.0,
            damping: 0.0,
            centre: Vec2::zero(),
            carried: Vec2::zero(),
        },
        magnets: None,
        seals: Vec::new(),
        forces: Vec::new(),
        loaded: Vec::new(),
        base: None,
        unbalances: Vec::new(),
        bearings: bearings.collect::<Result<_, _>>()?,
        gravity,
        speed,
        unbalance_angle: 0.0,
        schedule: Schedule::default(),
        at_speeds: Vec::new(),
    };
    // with a decay time of zero they are off at once
    let decay = number(given, "tau_m")?;
    if decay > 0.0 {
        let magnets = list(given, "magnets")?
            .iter()
            .enumerate()
            .map(|(k, magnet)| {
                // control currents at the release, of each magnet or of the start
                let current = match &given["start"]["control_current_A"][k] {
                    Value::Null => pair(&magnet["i0"]),
                    of_start => pair(of_start),
                };
                let key = ["node", "actuator_node"]
                    .into_iter()
                    .find(|key| !magnet[key].is_null());
                let node = index(magnet, key.unwrap_or("node"))?;
                if node >= coordinates.rotor.nodes.len() {
                    return Err(format!(
                        "a magnet at node {node}, which the rotor does not have"
                    ));
                }
                let node = coordinates.row(node);
                let force = current? * number(magnet, "ki")?;
                Ok((node, force, number(magnet, "ks")?))
            });
        let magnets = magnets.collect::<Result<Vec<_>, String>>()?;
        constants.magnets = Some(MagnetsConstants::fading(magnets, 1.0 / decay, 0.0));
    }
    constants.balance_mounts();
    Ok(constants)
}
