//! A rigid body of revolution with six freedoms.
//!
//! ```text
//!   states   x (m), v (m/s) of the centre of mass;  quaternion q, body to frame;  ω (rad/s) in the frame: 13
//!   axes     d1, d2, a: columns of R(q) = 1 + s q_w [q]× + s [q]×[q]×,  s = 2/|q|²
//!   q̇_w = -½ ω·q,  q̇ = ½ (q_w ω + ω × q)                              q as stored: R alone normalises
//!   m v̇ = F + m g;   L = I_t ω + (I_a - I_t)(ω·a)a;   h = M - ω × L;   ω̇ = h/I_t + (1/I_a - 1/I_t)(h·a)a
//! ```

use crate::motion::Body;
use number::{Real, Vec2, Vec3, constants};

/// States of a body.
pub const BODY_STATES: usize = 13;

constants! {
    /// Mass and inertias of a body of revolution.
    pub struct Inertia {
        /// Mass m, kg.
        mass: R,
        /// Inertia about the axis I_a, kg m².
        axial: R,
        /// Inertia about any axis across through the centre of mass I_t, kg m².
        transverse: R,
    }
}

/// Motion of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBody<R> {
    /// Centre of mass x, m.
    pub position: Vec3<R>,
    /// v, m/s.
    pub velocity: Vec3<R>,
    /// q_w of the quaternion.
    pub scalar: R,
    /// Its vector.
    pub vector: Vec3<R>,
    /// ω, rad/s.
    pub spin: Vec3<R>,
    /// Axis a.
    pub axis: Vec3<R>,
}

/// Force and moment on a body, the moment about its centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialWrench<R> {
    /// N.
    pub force: Vec3<R>,
    /// N m.
    pub moment: Vec3<R>,
}

impl<R: Real> SpatialWrench<R> {
    /// Nothing.
    #[inline(always)]
    pub fn zero() -> Self {
        SpatialWrench {
            force: Vec3::zero(),
            moment: Vec3::zero(),
        }
    }
    /// Of six numbers: the force, then the moment.
    #[inline(always)]
    pub fn from_array(list: [R; 6]) -> Self {
        SpatialWrench {
            force: triple(&list, 0),
            moment: triple(&list, 3),
        }
    }
    /// Its six numbers.
    #[inline(always)]
    pub fn to_array(self) -> [R; 6] {
        let (f, m) = (self.force, self.moment);
        [f.x, f.y, f.z, m.x, m.y, m.z]
    }
    /// Adds a force at a place from the centre of mass.
    #[inline(always)]
    pub fn add_at(&mut self, force: Vec3<R>, arm: Vec3<R>) {
        self.force += force;
        self.moment += arm.cross(force);
    }
    /// Adds another.
    #[inline(always)]
    pub fn add(&mut self, other: Self) {
        self.force += other.force;
        self.moment += other.moment;
    }
}

/// Three states from one on.
#[inline(always)]
fn triple<R: Real>(list: &[R], at: usize) -> Vec3<R> {
    Vec3::new(list[at], list[at + 1], list[at + 2])
}
#[inline(always)]
fn put<R: Real>(list: &mut [R], at: usize, value: Vec3<R>) {
    (list[at], list[at + 1], list[at + 2]) = (value.x, value.y, value.z);
}

impl<R: Real> RigidBody<R> {
    /// Reads 13 states.
    #[inline(always)]
    pub fn read(state: &[R]) -> Self {
        let state = &state[..BODY_STATES];
        let (scalar, vector) = (state[6], triple(state, 7));
        let two = R::splat(2.0);
        let s = two / (scalar.square() + vector.length_squared());
        let Vec3 { x, y, z } = vector;
        let axis = Vec3::new(
            s * (x * z + scalar * y),
            s * (y * z - scalar * x),
            R::one() - s * (x.square() + y.square()),
        );
        RigidBody {
            position: triple(state, 0),
            velocity: triple(state, 3),
            scalar,
            vector,
            spin: triple(state, 10),
            axis,
        }
    }
    /// The same body moved along the axis of the frame, m, and faster along it, m/s.
    #[inline(always)]
    pub(super) fn slid(mut self, [by, faster]: [R; 2]) -> Self {
        self.position.z += by;
        self.velocity.z += faster;
        self
    }
    /// A body whose motion a part sees: its turn about the axis is not known.
    pub fn of(body: &Body<R>) -> Self {
        let (one, zero) = (R::one(), R::zero());
        let Vec2 { x, y } = body.tilt;
        let up = (one - x.square() - y.square()).max(zero).sqrt();
        RigidBody {
            position: Vec3::new(body.position.x, body.position.y, body.axial),
            velocity: Vec3::new(body.velocity.x, body.velocity.y, body.axial_speed),
            scalar: one,
            vector: Vec3::zero(),
            spin: Vec3::new(body.tilt_rate.x, body.tilt_rate.y, body.spin),
            axis: Vec3::new(y, -x, up),
        }
    }
    /// What a part sees of its motion.
    #[inline(always)]
    pub fn seen(&self, angle: R) -> Body<R> {
        let across = |v: Vec3<R>| Vec2::new(v.x, v.y);
        Body {
            position: across(self.position),
            axial: self.position.z,
            tilt: Vec2::new(-self.axis.y, self.axis.x),
            angle,
            velocity: across(self.velocity),
            axial_speed: self.velocity.z,
            tilt_rate: across(self.spin),
            spin: self.spin.z,
        }
    }
    /// Axes d1 and d2.
    #[inline(always)]
    pub fn transverse_axes(&self) -> [Vec3<R>; 2] {
        let (w, Vec3 { x, y, z }) = (self.scalar, self.vector);
        let one = R::one();
        let s = R::splat(2.0) / (w.square() + self.vector.length_squared());
        [
            Vec3::new(
                one - s * (y.square() + z.square()),
                s * (x * y + w * z),
                s * (x * z - w * y),
            ),
            Vec3::new(
                s * (x * y - w * z),
                one - s * (x.square() + z.square()),
                s * (y * z + w * x),
            ),
        ]
    }
    /// Velocity of its material at a place from its centre of mass.
    #[inline(always)]
    pub fn velocity_at(&self, arm: Vec3<R>) -> Vec3<R> {
        self.velocity + self.spin.cross(arm)
    }
    /// Writes the rates of 13 states for a velocity and accelerations.
    #[inline(always)]
    pub fn write_rates(&self, rate: &mut [R], moving: [Vec3<R>; 2], turning: Vec3<R>) {
        let rate = &mut rate[..BODY_STATES];
        let half = R::splat(0.5);
        put(rate, 0, moving[0]);
        put(rate, 3, moving[1]);
        rate[6] = -(half * self.spin.dot(self.vector));
        let vector = self.spin * self.scalar + self.spin.cross(self.vector);
        put(rate, 7, vector * half);
        put(rate, 10, turning);
    }
}

impl<R: Real> Inertia<R> {
    /// Angular momentum L, N m s.
    #[inline(always)]
    pub fn angular_momentum(&self, body: &RigidBody<R>) -> Vec3<R> {
        let more = (self.axial - self.transverse) * body.spin.dot(body.axis);
        body.spin * self.transverse + body.axis * more
    }
    /// ω̇, rad/s².
    #[inline(always)]
    pub fn angular_acceleration(&self, body: &RigidBody<R>, moment: Vec3<R>) -> Vec3<R> {
        let h = moment - body.spin.cross(self.angular_momentum(body));
        let (across, along) = (self.transverse.recip(), self.axial.recip());
        h * across + body.axis * ((along - across) * h.dot(body.axis))
    }
    /// ω̇ of a body whose axis is held, rad/s².
    #[inline(always)]
    pub fn held_acceleration(&self, body: &RigidBody<R>, moment: Vec3<R>) -> Vec3<R> {
        body.axis * (moment.dot(body.axis) / self.axial)
    }
    /// Kinetic energy of its turning, J.
    pub fn turning_energy(&self, body: &RigidBody<R>) -> R {
        R::splat(0.5) * body.spin.dot(self.angular_momentum(body))
    }
}
