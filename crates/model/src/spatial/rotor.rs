//! A rigid rotor in the bore of an inner ring: bore contact at stations, shoulders on its faces, levitation.
//!
//! ```text
//!   C = x_r - e_u d1, its axis C + s a_r
//!   levitation at stations s:  F = -(k_a x_⊥ + c_a v_⊥ + m g_⊥)/n of C + s a_r;  along the axis at C; each direction carries its weight
//! ```

use super::assembly::{AMB, AssemblyProbe, Bodies};
use super::landing::{Landing, LandingConstants, gather_list};
use super::rigid_body::{Inertia, RigidBody, SpatialWrench};
use number::{Gather, Real, Vec3, constants};

constants! {
    /// Levitation of the reference files: springs and dampers at stations of the rotor's axis.
    pub struct SpatialLevitation {
        /// Across the axis, all stations together, N/m.
        stiffness: R,
        /// N s/m.
        damping: R,
        /// Along the axis, N/m.
        axial_stiffness: R,
        /// N s/m.
        axial_damping: R,
        /// Whether the weight across the axis is carried.
        carries: bool,
        /// Whether the weight along the axis is carried.
        carries_axially: bool,
    }
}

/// The rotor of one machine: free, rigid, six freedoms.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialRotor {
    /// Mass and inertias.
    pub inertia: Inertia<f64>,
    /// Distance of the centre of mass from the axis along d1, m.
    pub eccentricity: f64,
    /// Where it lands on the inner ring.
    pub landing: LandingConstants,
    /// Levitation, and its stations on the rotor's axis, m.
    pub levitation: Option<(SpatialLevitation<f64>, Vec<f64>)>,
}

/// The rotor over `R`.
#[derive(Clone, Debug)]
pub(super) struct Rotor<R> {
    pub inertia: Inertia<R>,
    eccentricity: R,
    landing: Landing<R>,
    levitation: Option<(SpatialLevitation<R>, Vec<R>)>,
}

/// The part of a vector across the bearing's axis.
#[inline(always)]
fn transverse<R: Real>(v: Vec3<R>) -> Vec3<R> {
    Vec3::new(v.x, v.y, R::zero())
}

impl<R: Real> Rotor<R> {
    pub(super) fn gather<'a>(machine: &dyn Fn(usize) -> &'a SpatialRotor) -> Self {
        let of_levitation = |lane: usize| {
            let levitation = machine(lane).levitation.as_ref();
            levitation.expect("lanes share whether the rotor is levitated")
        };
        Rotor {
            inertia: Gather::gather(&|lane| &machine(lane).inertia),
            eccentricity: Gather::<R>::gather(&|lane| &machine(lane).eccentricity),
            landing: Landing::gather(&|lane| &machine(lane).landing),
            levitation: machine(0).levitation.as_ref().map(|_| {
                (
                    Gather::gather(&|lane| &of_levitation(lane).0),
                    gather_list(&|lane| &of_levitation(lane).1),
                )
            }),
        }
    }
    /// Contacts and levitation: what acts on the rotor.
    #[inline(always)]
    pub(super) fn react(
        &self,
        body: &RigidBody<R>,
        gravity: Vec3<R>,
        bodies: &mut Bodies<R>,
        probe: &mut AssemblyProbe<R>,
    ) -> SpatialWrench<R> {
        let mut on_rotor = SpatialWrench::zero();
        let [d1, _] = body.transverse_axes();
        let from_mass = d1 * -self.eccentricity;
        let centre = body.position + from_mass;
        let landed = self.landing.react(body, centre, &bodies.inner);
        on_rotor.add(landed.on_rotor);
        bodies.land(&landed);
        *probe = AssemblyProbe {
            bore_normal_force: landed.bore.normal_force,
            bore_friction: landed.bore.friction,
            bore_penetration: landed.bore.penetration.max(R::zero()),
            face_normal_force: landed.face.normal_force,
            face_friction: landed.face.friction,
            face_penetration: landed.face.penetration.max(R::zero()),
            ..*probe
        };
        if let Some((levitation, stations)) = &self.levitation {
            let weight = gravity * self.inertia.mass;
            let zero = R::zero();
            if levitation.carries {
                let share = R::splat(1.0 / stations.len() as f64);
                let mut k = 0;
                while k < stations.len() {
                    let arm = from_mass + body.axis * stations[k];
                    let x = transverse(body.position + arm);
                    let v = transverse(body.velocity_at(arm));
                    let force =
                        x * levitation.stiffness + v * levitation.damping + transverse(weight);
                    on_rotor.add_at(force * -share, arm);
                    bodies.power[AMB] += levitation.damping * share * v.length_squared();
                    k += 1;
                }
            }
            if levitation.carries_axially {
                let v = body.velocity_at(from_mass).z;
                let force =
                    levitation.axial_stiffness * centre.z + levitation.axial_damping * v + weight.z;
                on_rotor.add_at(Vec3::new(zero, zero, -force), from_mass);
                bodies.power[AMB] += levitation.axial_damping * v.square();
            }
        }
        on_rotor
    }
}
