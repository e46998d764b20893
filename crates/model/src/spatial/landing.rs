//! Where a rotor lands on an inner ring: stations of its bore, and faces with the shoulders of the rotor.
//!
//! Penetration, its rate and slip are those of the station with the largest penetration; forces are sums over all stations.

use super::face::{Face, FaceNodes};
use super::rigid_body::{RigidBody, SpatialWrench};
use crate::contact::JournalContact;
use number::{Gather, Real, Vec3};

/// Landing surfaces of one bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct LandingConstants {
    /// Rotor and bore of the inner ring; stiffness at one station.
    pub contact: JournalContact<f64>,
    /// Stations of the contact on the inner ring's axis, m.
    pub stations: Vec<f64>,
    /// Shoulders on faces of the inner ring.
    pub faces: Vec<Face<f64>>,
    /// Directions of a face's nodes, cosine and sine.
    pub face_nodes: Vec<[f64; 2]>,
}

/// The same over `R`.
#[derive(Clone, Debug)]
pub struct Landing<R> {
    contact: JournalContact<R>,
    stations: Vec<R>,
    faces: Vec<Face<R>>,
    nodes: FaceNodes<R>,
}

/// What rotor and inner ring do to each other.
#[derive(Clone, Copy, Debug)]
pub struct LandingReaction<R> {
    /// On the rotor about the point that stands for it.
    pub on_rotor: SpatialWrench<R>,
    /// On the inner ring about its centre.
    pub on_ring: SpatialWrench<R>,
    /// In the bore.
    pub bore: Rubbing<R>,
    /// On the faces.
    pub face: Rubbing<R>,
}

/// Surfaces that touch.
#[derive(Clone, Copy, Debug)]
pub struct Rubbing<R> {
    /// Largest penetration, m; negative when open.
    pub penetration: R,
    /// Its rate there, m/s.
    pub penetration_speed: R,
    /// Slip there, ring less rotor along the circumference, m/s.
    pub slip: R,
    /// Sum of the normal forces, N.
    pub normal_force: R,
    /// Rate of their elastic part, N/s.
    pub elastic_rate: R,
    /// Sum of the sizes of friction, N.
    pub friction: R,
    /// Friction on the rotor along the circumference, N.
    pub along: R,
    /// Heats of damping and of sliding, W.
    pub heats: [R; 2],
}

impl<R: Real> Rubbing<R> {
    #[inline(always)]
    fn none() -> Self {
        let zero = R::zero();
        Rubbing {
            penetration: R::splat(f64::NEG_INFINITY),
            penetration_speed: zero,
            slip: zero,
            normal_force: zero,
            elastic_rate: zero,
            friction: zero,
            along: zero,
            heats: [zero; 2],
        }
    }
}

/// A list of constants, one a lane.
pub(super) fn gather_list<'a, R: Real, T: Gather<R> + 'a>(
    machine: &dyn Fn(usize) -> &'a [T],
) -> Vec<T::Out> {
    let one = |k: usize| T::gather(&|lane| &machine(lane)[k]);
    (0..machine(0).len()).map(one).collect()
}

impl<R: Real> Landing<R> {
    /// One a lane.
    pub fn gather<'a>(machine: &dyn Fn(usize) -> &'a LandingConstants) -> Self {
        let sides = |k: usize| {
            let first = &machine(0).face_nodes;
            first.iter().map(|node| R::splat(node[k])).collect()
        };
        Landing {
            contact: Gather::gather(&|lane| &machine(lane).contact),
            stations: gather_list(&|lane| &machine(lane).stations),
            faces: gather_list(&|lane| &machine(lane).faces),
            nodes: FaceNodes {
                cosines: sides(0),
                sines: sides(1),
            },
        }
    }
    /// Contacts of a rotor, about a point of it, with a ring; `centre` is the point C of its geometric axis.
    #[inline(always)]
    pub fn react(
        &self,
        rotor: &RigidBody<R>,
        centre: Vec3<R>,
        ring: &RigidBody<R>,
    ) -> LandingReaction<R> {
        let mut all = LandingReaction {
            on_rotor: SpatialWrench::zero(),
            on_ring: SpatialWrench::zero(),
            bore: Rubbing::none(),
            face: Rubbing::none(),
        };
        let mut k = 0;
        while k < self.stations.len() {
            let r = (self.contact).at_station::<false>(rotor, centre, ring, self.stations[k]);
            all.on_rotor.add(r.on_cylinder);
            all.on_ring.add(r.on_bore);
            let bore = &mut all.bore;
            let deeper = r.penetration.greater(bore.penetration);
            bore.penetration = bore.penetration.max(r.penetration);
            bore.penetration_speed = R::select(deeper, r.penetration_speed, bore.penetration_speed);
            bore.slip = R::select(deeper, r.slip, bore.slip);
            bore.normal_force += r.normal_force;
            bore.elastic_rate += r.elastic_rate;
            bore.friction += r.friction;
            bore.along += r.along;
            bore.heats[0] += r.damping_heat;
            bore.heats[1] += r.friction_heat;
            k += 1;
        }
        let mut k = 0;
        while k < self.faces.len() {
            let r = self.faces[k].react(&self.nodes, rotor, centre, ring);
            all.on_rotor.add(r.on_rotor);
            all.on_ring.add(r.on_ring);
            let face = &mut all.face;
            face.penetration = face.penetration.max(r.penetration);
            face.normal_force += r.normal_force;
            face.friction += r.friction;
            face.heats[0] += r.damping_heat;
            face.heats[1] += r.friction_heat;
            k += 1;
        }
        all
    }
}
