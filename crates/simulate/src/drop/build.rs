//! From a drop to the constants of the model.

use crate::bearing;
use crate::bearing::pressure::PressureFactors;
use crate::bearing::steady::{SteadyFinding, SteadyPoint};
use crate::drop::Drop;
use crate::drop::axial;
use crate::drop::base;
use crate::drop::clearances;
use crate::drop::housings;
use crate::drop::layers;
use crate::drop::magnets_in_time::InTime;
use crate::drop::mount;
use crate::drop::shaft::{self, BuiltShaft};
use crate::drop::torque;
use model::auxiliary_bearing::{AuxiliaryBearingConstants, RaceConstants};
use model::base::BaseConstants;
use model::bearing::{BearingConstants, RollingConstants};
use model::contact::JournalContact;
use model::force::ForceConstants;
use model::levitation::Levitation;
use model::mount::{Housing, Mount};
use model::rotor::RotorConstants;
use model::system::machine::{Event, MachineConstants};
use number::{Vec2, Vec3};
use problem::Problem;
use scenario::several::path_of;
use scenario::{AuxiliaryBearing, Spin};

/// A drop ready to be simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct DropModel {
    /// The drop with the model of its rotor.
    pub drop: Drop,
    /// Constants of the model.
    pub constants: MachineConstants,
    /// What the model does not hold of each auxiliary bearing.
    pub bearings: Vec<BuiltBearing>,
    /// A rotor that bends.
    pub shaft: Option<BuiltShaft>,
}

/// What belongs to an auxiliary bearing besides the constants of the model.
#[derive(Clone, Debug, PartialEq)]
pub struct BuiltBearing {
    /// Hertz pressure in the contacts of a ball.
    pub pressure_factors: PressureFactors,
    /// What traction can carry at full speed under the weight on it; none without a steady moment.
    pub steady: Option<SteadyFinding>,
}

/// Builds the constants of a drop.
pub fn drop(given: &scenario::Drop) -> Result<DropModel, Box<Problem>> {
    built(Drop::of(given)?)
}

/// Builds the constants of a drop whose rotor has its model.
pub(super) fn built(drop: Drop) -> Result<DropModel, Box<Problem>> {
    let shaft = match &drop.shaft {
        Some(given) => {
            let built = shaft::build(&drop, given, gravity(&drop))?;
            clearances::clear(&drop, given, &built)?;
            Some(built)
        }
        None => None,
    };
    let mut parts = Vec::new();
    let mut bearings = Vec::new();
    for k in 0..drop.auxiliary_bearings.len() {
        let (mut constants, built) = auxiliary_bearing(&drop, k)?;
        // the results of an only bearing need no name
        if drop.auxiliary_bearings.len() == 1 {
            constants.name.clear();
        }
        if let (Some(given), Some(built)) = (&drop.shaft, &shaft) {
            let [x, y] = given.places[k].misalignment;
            constants.node = built.nodes[k].clone();
            if let BearingConstants::Spatial(own) = &mut constants.bearing {
                (own.rotation, own.lever) = built.turns[k].clone();
            }
            constants.datum = Vec2::new(x, y);
            constants.mount_parts.on = built.stands[k].clone();
        }
        parts.push(constants);
        bearings.push(built);
    }
    let in_time = shaft.as_ref().map(|built| built.in_time.clone());
    let base = base::base(&drop)?;
    let forces = (shaft.as_ref()).map_or_else(Vec::new, |built| built.forces.clone());
    let in_time = in_time.unwrap_or_default();
    let mut constants = constants(&drop, parts, in_time, base, forces);
    if let Some(built) = &shaft {
        constants.rotor = built.rotor.clone();
        constants.seals = built.seals.clone();
        constants.loaded = built.loaded.clone();
        constants.unbalances = built.unbalances.clone();
    }
    Ok(DropModel {
        drop,
        constants,
        bearings,
        shaft,
    })
}

/// The auxiliary bearings of a drop with their contacts and mounts, at no node yet; each alone on the housing that others share.
///
/// # Errors
/// What the drop would be refused for.
pub fn auxiliary_bearings(
    given: &scenario::Drop,
) -> Result<Vec<AuxiliaryBearingConstants>, Box<Problem>> {
    let drop = Drop::of(given)?;
    let all = 0..drop.auxiliary_bearings.len();
    let of = |k: usize| {
        let (mut constants, _) = auxiliary_bearing(&drop, k)?;
        let shaft = drop.shaft.as_ref();
        if let Some((shaft, on)) = shaft.and_then(|shaft| Some((shaft, shaft.places[k].on?))) {
            let own = housings::alone(&shaft.model.rotor, on, drop.rotor.speed);
            let row = |whole: f64| whole / constants.planes;
            constants.mount_parts.housing = Some(Housing {
                mass: row(own.mass),
                stiffness: row(own.stiffness),
                damping: row(own.damping),
            });
        }
        Ok(constants)
    };
    all.map(of).collect()
}

fn auxiliary_bearing(
    drop: &Drop,
    k: usize,
) -> Result<(AuxiliaryBearingConstants, BuiltBearing), Box<Problem>> {
    let part = &drop.auxiliary_bearings[k];
    bearing_of(drop, part, k).map_err(|mut problem| {
        let of = Some(part.name.as_str()).filter(|name| !name.is_empty());
        problem.key = problem.key.map(|key| path_of(of, &key));
        problem
    })
}

fn bearing_of(
    drop: &Drop,
    part: &AuxiliaryBearing,
    k: usize,
) -> Result<(AuxiliaryBearingConstants, BuiltBearing), Box<Problem>> {
    let Some(given) = &part.bearing else {
        return Ok(bushing(part));
    };
    let gravity = gravity(drop);
    let (sine, cosine) = drop.gravity.direction.sin_cos();
    let contacts = bearing::contacts::ball_contacts(given)?;
    let constants = match &given.spatial {
        Some(own) => {
            let gravity = Vec3::new(gravity.x, gravity.y, drop.gravity.axial);
            let built = bearing::spatial::bearing(part, (given, own), &contacts, gravity)?;
            BearingConstants::Spatial(built)
        }
        None => bearing::build::bearing(given, &contacts, gravity)?,
    };
    let [mass, inertia] = given.inner_race();
    let inner_race = RaceConstants {
        mass,
        inertia,
        centre_held: given.inner_race_centre_held,
        torque: given.inner_race_torque,
    };
    let at = SteadyPoint {
        speed: drop.rotor.speed,
        load: drop.body.mass * drop.share(k) * drop.gravity.acceleration,
        direction: Vec2::new(cosine, sine),
        gravity,
    };
    let steady = bearing::steady::steady(&constants, given, &inner_race, at)?;
    let built = BuiltBearing {
        pressure_factors: contacts.pressure_factors(),
        steady,
    };
    let mut warm = bearing::networks::built(part.warm.as_deref(), given)?;
    if let (Some(warm), Some(area)) = (&mut warm, part.area_over_core()) {
        let layer = layers::rotor_layer(&part.contact);
        let capacity = layer.capacity(area);
        warm.network.with_layer(capacity, layer.to_core(area));
    }
    let around = AuxiliaryBearingConstants {
        warm,
        ..around(part, inner_race, constants)
    };
    Ok((around, built))
}

/// A plain bushing: its ring is the mass on the mount.
fn bushing(part: &AuxiliaryBearing) -> (AuxiliaryBearingConstants, BuiltBearing) {
    let radius = 0.5 * part.contact.bore_diameter;
    let ring = RaceConstants {
        mass: 0.0,
        inertia: part.mount.moving_mass * radius * radius,
        centre_held: false,
        torque: 0.0,
    };
    let none = BearingConstants::Rolling(RollingConstants::bushing(radius));
    let built = BuiltBearing {
        pressure_factors: PressureFactors::NONE,
        steady: None,
    };
    (around(part, ring, none), built)
}

/// Contact and mount around a bearing.
fn around(
    part: &AuxiliaryBearing,
    inner_race: RaceConstants<f64>,
    bearing: BearingConstants,
) -> AuxiliaryBearingConstants {
    let contact = &part.contact;
    AuxiliaryBearingConstants {
        name: part.name.clone(),
        node: vec![1.0],
        planes: part.planes,
        datum: Vec2::zero(),
        contact: JournalContact {
            radial_clearance: contact.radial_air_clearance,
            bore_radius: 0.5 * contact.bore_diameter,
            stiffness: contact.stiffness,
            exponent: contact.exponent,
            damping: contact.damping,
            friction: contact.friction_coefficient,
            inverse_reference_speed: 1.0 / contact.friction_reference_speed,
        },
        inner_race,
        bearing,
        outer_race_mass: part.mount.moving_mass,
        mount: Mount {
            stiffness: part.mount.stiffness,
            damping: part.mount.damping,
            free_position: Vec2::zero(),
        },
        mount_parts: mount::parts(&part.mount.parts),
        surfaces: layers::built(part),
        warm: None,
        fixture: None,
    }
}

pub(crate) fn gravity(drop: &Drop) -> Vec2<f64> {
    let (sine, cosine) = drop.gravity.direction.sin_cos();
    Vec2::new(cosine, sine) * drop.gravity.acceleration
}

/// The constants of a drop onto auxiliary bearings that are built.
fn constants(
    drop: &Drop,
    bearings: Vec<AuxiliaryBearingConstants>,
    in_time: InTime,
    base: Option<BaseConstants>,
    forces: Vec<ForceConstants>,
) -> MachineConstants {
    let gravity = gravity(drop);
    let mass = drop.body.mass;
    let torque = torque::tables(drop);
    let InTime {
        magnets,
        known,
        mut at_speeds,
    } = in_time;
    let (brake_torque, brakes) = torque::brakes(drop, &mut at_speeds);
    let knots = forces.iter().flat_map(ForceConstants::knots);
    let knots = knots.map(|time| (time, Event::Knot));
    let shaken = base.iter().flat_map(BaseConstants::knots);
    let shaken = shaken.map(|time| (time, Event::Knot));
    let mut known: Vec<_> = known.into_iter().chain(knots).chain(shaken).collect();
    axial::switches(drop, &mut known, &mut at_speeds);
    let mut constants = MachineConstants {
        rotor: RotorConstants {
            torque: torque.clone(),
            brake_torque,
            spin_held: drop.rotor.spin == Spin::Held,
            ..RotorConstants::point(
                mass,
                drop.body.polar_inertia,
                drop.body.unbalance_eccentricity,
            )
        },
        axial: axial::motion(drop, mass),
        // a magnetic bearing stands beside each row of the auxiliary ones
        levitation: Levitation {
            stiffness: drop.levitation.stiffness * drop.rows(),
            damping: drop.levitation.damping * drop.rows(),
            centre: Vec2::new(drop.levitation.offset_x, drop.levitation.offset_y),
            carried: -(gravity * mass),
        },
        seals: Vec::new(),
        forces,
        loaded: Vec::new(),
        base,
        unbalances: Vec::new(),
        bearings,
        gravity,
        speed: drop.rotor.speed,
        unbalance_angle: drop.rotor.unbalance_angle,
        schedule: torque::schedule(brakes, torque.as_ref(), known),
        at_speeds,
        magnets,
    };
    constants.balance_mounts();
    constants
}
