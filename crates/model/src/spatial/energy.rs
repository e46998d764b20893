//! Energies and momenta of an assembly.
//!
//! ```text
//!   T = Σ ½m|v|² + ½ω·L,  balls ½m|v|² + ½I|w|²
//!   V = Σ ⅖ K δ^2.5 + ½ k pen² + stores of lands, bore, faces, mount, levitation - Σ m g·x over every body that moves
//!   momentum Σ m v;  angular momentum about the origin Σ x × m v + L + I w
//! ```
//! Written over `Real`: tests differentiate V. It knows places and penetrations alone, no points of contact.

use super::assembly::AssemblyConstants;
use super::ball::{BallState, SpatialBall, Turned};
use super::face::Face;
use super::landing::LandingConstants;
use super::race::RaceGroove;
use super::rigid_body::{Inertia, RigidBody};
use super::rotor::SpatialRotor;
use super::row::{CageGuide, lists};
use super::spring::PreloadSpring;
use crate::bearing::seat;
use crate::contact::JournalContact;
use number::{Gather, Real, Vec3, direction_angle};
use physics::contact::ball_race_energy;

/// Energies and momenta.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialContent<R> {
    /// T, J.
    pub kinetic: R,
    /// Its part of turning, J.
    pub turning: R,
    /// V, J.
    pub potential: R,
    /// N s.
    pub momentum: Vec3<R>,
    /// Sum of the sizes of its terms, N s.
    pub momentum_terms: R,
    /// About the origin, N m s.
    pub angular_momentum: Vec3<R>,
    /// Sum of the sizes of its terms, N m s.
    pub angular_terms: R,
}

impl<R: Real> SpatialContent<R> {
    fn add_body(&mut self, inertia: &Inertia<R>, body: &RigidBody<R>, gravity: Vec3<R>) {
        let momentum = body.velocity * inertia.mass;
        let turning = inertia.turning_energy(body);
        self.turning += turning;
        self.kinetic += turning + R::splat(0.5) * momentum.dot(body.velocity);
        self.potential -= gravity.dot(body.position) * inertia.mass;
        self.add_momentum(momentum, body.position, inertia.angular_momentum(body));
    }
    fn add_momentum(&mut self, momentum: Vec3<R>, position: Vec3<R>, spinning: Vec3<R>) {
        let orbital = position.cross(momentum);
        self.momentum += momentum;
        self.momentum_terms += length(momentum);
        self.angular_momentum += orbital + spinning;
        self.angular_terms += length(orbital) + length(spinning);
    }
}

fn length<R: Real>(v: Vec3<R>) -> R {
    v.length_squared().sqrt()
}

/// The same constants over `R`.
fn over<R: Real, T: Gather<R>>(constants: &T) -> T::Out {
    T::gather(&|_| constants)
}

impl<R: Real> RaceGroove<R> {
    fn approach(&self, ring: &RigidBody<R>, ball: Vec3<R>) -> R {
        let d = ball - ring.position;
        let along = d.dot(ring.axis);
        let distance = d.across(ring.axis).length_squared().sqrt();
        let (x, y) = (distance - self.centre_radius, along - self.place);
        (x.square() + y.square()).sqrt() - self.slack
    }
}

impl AssemblyConstants {
    /// Energies and momenta at a state.
    pub fn content<R: Real>(&self, state: &[R]) -> SpatialContent<R> {
        let body = |index: usize| RigidBody::<R>::read(&state[self.body(index)..]);
        let (inner, outer) = (body(1), body(2));
        let gravity: Vec3<R> = over(&self.gravity);
        let mut all = SpatialContent {
            kinetic: R::zero(),
            turning: R::zero(),
            potential: R::zero(),
            momentum: Vec3::zero(),
            momentum_terms: R::zero(),
            angular_momentum: Vec3::zero(),
            angular_terms: R::zero(),
        };
        let of_inner = if self.inner.held {
            Vec3::zero()
        } else {
            gravity
        };
        all.add_body(&over(&self.inner.inertia), &inner, of_inner);
        all.add_body(&over(&self.outer.inertia), &outer, gravity);
        let mount: super::mount::SpatialMount<R> = over(&self.outer.mount);
        all.potential += mount.energy(&outer);
        for (index, row) in self.rows.iter().enumerate() {
            let cage = body(3 + index);
            all.add_body(&over(&row.cage.inertia), &cage, gravity);
            let outer = self.outer_of(index, outer, state);
            let guide = <CageGuide<f64> as Gather<R>>::gather(&|_| &row.cage.guide);
            all.potential += land_energy(&guide, [&inner, &outer, &cage]);
            let balls = lists(state, self.first_ball_state(index), row.balls);
            let ball: SpatialBall<R> = over(&row.ball);
            let tied = matches!(guide, CageGuide::Tied);
            let ball_at = |j: usize| BallState::from_array(balls.map(|list| list[j]));
            for j in 0..row.balls {
                let at = ball_at(j);
                let bodies = [&inner, &outer, &cage];
                add_ball(&mut all, &ball, &at, bodies, seat(j, row.balls), tied);
            }
        }
        if let Some(spring) = &self.spring {
            let spring: PreloadSpring<R> = over(spring);
            let [slid, speed] = [0, 1].map(|k| state[self.first_sliding() + k]);
            let both = outer.velocity.z + speed;
            let faster = both.square() - outer.velocity.z.square();
            all.kinetic += R::splat(0.5) * spring.mass * faster;
            all.potential += spring.energy(slid) - spring.mass * gravity.z * slid;
            let along = Vec3::new(R::zero(), R::zero(), spring.mass * speed);
            all.add_momentum(along, outer.position, Vec3::zero());
        }
        if let Some(rotor) = &self.rotor {
            let body = body(0);
            all.add_body(&over(&rotor.inertia), &body, gravity);
            all.potential += rotor.energy(&body, &inner, gravity);
        }
        all
    }
}

fn add_ball<R: Real>(
    all: &mut SpatialContent<R>,
    ball: &SpatialBall<R>,
    at: &BallState<R>,
    [inner, outer, cage]: [&RigidBody<R>; 3],
    seat: f64,
    tied: bool,
) {
    let half = R::splat(0.5);
    let space = at.in_space(Turned::to(at.azimuth));
    let inertia = R::splat(0.4) * ball.mass * ball.radius.square();
    let momentum = space.velocity * ball.mass;
    let turning = half * inertia * space.spin.length_squared();
    all.turning += turning;
    all.kinetic += half * momentum.dot(space.velocity) + turning;
    all.add_momentum(momentum, space.position, space.spin * inertia);
    all.potential -= ball.gravity.dot(space.position) * ball.mass;
    let grown = ball.inner_at(inner.spin.dot(inner.axis));
    for (race, ring) in [(&grown, inner), (&ball.outer, outer)] {
        all.potential += ball_race_energy(race.stiffness, race.approach(ring, space.position));
    }
    let s = space.position - cage.position;
    let zeta = s.dot(cage.axis);
    let [d1, d2] = cage.transverse_axes();
    let (x, y) = (s.dot(d1), s.dot(d2));
    let (sine, cosine) = (R::splat(seat.sin()), R::splat(seat.cos()));
    let inverse = (x.square() + y.square()).sqrt().recip();
    let along = (cosine * x + sine * y) * inverse;
    let psi = ball.pocket.circle * direction_angle(along, (cosine * y - sine * x) * inverse);
    let off = if tied {
        psi.abs()
    } else {
        (psi.square() + zeta.square()).sqrt()
    };
    let pressed = (off - ball.pocket.gap).max(R::zero());
    all.potential += half * ball.pocket.stiffness * pressed.square();
}

/// Penetration of a cylinder into a bore at a station, m.
fn penetration<R: Real>(
    clearance: R,
    [cylinder, bore]: [&RigidBody<R>; 2],
    through: Vec3<R>,
    station: R,
) -> R {
    let e = through - bore.position - bore.axis * station;
    let squared = e.across(cylinder.axis).length_squared();
    squared.max(R::splat(1e-30)).sqrt() - clearance
}

fn land_energy<R: Real>(guide: &CageGuide<R>, [inner, outer, cage]: [&RigidBody<R>; 3]) -> R {
    let (land, bodies) = match guide {
        CageGuide::Tied | CageGuide::Balls => return R::zero(),
        CageGuide::OuterLand(land) => (land, [cage, outer]),
        CageGuide::InnerLand(land) => (land, [inner, cage]),
    };
    let at = |station| {
        let clearance = land.contact.radial_clearance;
        let d = penetration(clearance, bodies, bodies[0].position, station);
        land.contact.energy_at(d)
    };
    at(land.middle - land.half_width) + at(land.middle + land.half_width)
}

impl LandingConstants {
    /// Energy of its contacts with a rotor whose axis goes through a point, J.
    pub fn energy<R: Real>(&self, body: &RigidBody<R>, centre: Vec3<R>, inner: &RigidBody<R>) -> R {
        let half = R::splat(0.5);
        let contact: JournalContact<R> = over(&self.contact);
        let mut energy = R::zero();
        for station in &self.stations {
            let clearance = contact.radial_clearance;
            let d = penetration(clearance, [body, inner], centre, R::splat(*station));
            energy += contact.energy_at(d);
        }
        let [e1, e2] = inner.transverse_axes();
        for face in &self.faces {
            let face: Face<R> = over(face);
            let share = face.stiffness * R::splat(1.0 / self.face_nodes.len() as f64);
            for [cosine, sine] in &self.face_nodes {
                let out = e1 * R::splat(*cosine) + e2 * R::splat(*sine);
                let p = inner.position + inner.axis * face.place + out * face.radius;
                let shoulder = centre + body.axis * face.shoulder;
                let d = (-(face.side * (shoulder - p).dot(body.axis))).max(R::zero());
                energy += half * share * d.square();
            }
        }
        energy
    }
}

impl SpatialRotor {
    /// Energy of its contacts and of its levitation, J.
    fn energy<R: Real>(&self, body: &RigidBody<R>, inner: &RigidBody<R>, gravity: Vec3<R>) -> R {
        let half = R::splat(0.5);
        let [d1, _] = body.transverse_axes();
        let centre = body.position - d1 * R::splat(self.eccentricity);
        let mut energy = self.landing.energy(body, centre, inner);
        if let Some((levitation, stations)) = &self.levitation {
            let mass = R::splat(self.inertia.mass);
            if levitation.carries {
                let share = R::splat(1.0 / stations.len() as f64);
                let stiffness = R::splat(levitation.stiffness);
                for station in stations {
                    let x = centre + body.axis * R::splat(*station);
                    let squared = x.x.square() + x.y.square();
                    let weight = mass * (gravity.x * x.x + gravity.y * x.y);
                    energy += share * (half * stiffness * squared + weight);
                }
            }
            if levitation.carries_axially {
                let stiffness = R::splat(levitation.axial_stiffness);
                energy += half * stiffness * centre.z.square() + mass * gravity.z * centre.z;
            }
        }
        energy
    }
}
