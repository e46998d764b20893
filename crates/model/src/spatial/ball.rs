//! One ball of a row: nine states in cylinder coordinates about the bearing's axis, its two races and its pocket.
//!
//! ```text
//!   states   ρ ρ̇ θ θ̇ z ż, absolute spin (w_r, w_t, w_z) in the directions that turn with θ
//!   ρ̈ = F_r/m + g_r + ρθ̇²     θ̈ = (F_t/m + g_t - 2ρ̇θ̇)/ρ     z̈ = F_z/m + g_z
//!   ẇ_r = M_r/I + θ̇ w_t        ẇ_t = M_t/I - θ̇ w_r            ẇ_z = M_z/I,   I = ⅖ m r²
//! ```
//! The last line is the whole gyroscopic effect. Of a row's balls each state is a list, one after the other.
//!
//! Drag of the reference files, to the housing: -c_d ρθ̇ along the track, couple -c_w w.

use super::pocket::SpatialPocket;
use super::race::{BallInSpace, RaceGroove};
use crate::bearing::steady_moment::Geometry;
use number::{Real, Vec3, constants};
use physics::load_zone::joint_stiffness;

/// Distance of the grooves' centres along the axis, over the ball's radius, up to which they stand opposite each other.
const OPPOSITE: f64 = 1e-4;
/// States of a ball.
pub const BALL_STATES: usize = 9;

constants! {
    /// A ball with its contacts.
    pub struct SpatialBall {
        /// Radius r, m.
        radius: R,
        /// Mass, kg.
        mass: R,
        /// Groove of the inner ring at standstill.
        inner: RaceGroove<R>,
        /// Growth k of the radius of that groove's circle with the square of the inner ring's speed, m s².
        inner_growth: R,
        /// Groove of the outer ring.
        outer: RaceGroove<R>,
        /// Contact damping time β, s.
        damping_time: R,
        /// Drag to the housing on the orbit speed, N s/m.
        orbit_drag: R,
        /// Drag to the housing on the spin, N m s.
        spin_drag: R,
        /// Gravity, m/s².
        gravity: Vec3<R>,
        /// Its pocket.
        pocket: SpatialPocket<R>,
    }
}

impl<R: Real> SpatialBall<R> {
    /// Groove of an inner ring that turns about its axis at a speed, rad/s.
    #[inline(always)]
    pub fn inner_at(&self, speed: R) -> RaceGroove<R> {
        RaceGroove {
            centre_radius: self.inner.centre_radius + self.inner_growth * speed.square(),
            ..self.inner
        }
    }
}

/// How rings and balls have grown with their temperatures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expansion {
    /// Strains of inner ring, balls and outer ring.
    pub strains: [f64; 3],
    /// What the seats of inner and outer ring have added to the radii of their tracks, m.
    pub seats: [f64; 2],
}

impl SpatialBall<f64> {
    /// The same when rings and balls have grown, each about its own centre.
    ///
    /// Assumes: bodies of one temperature each; masses, pockets and the stiffness of the contacts (half the strain) stay.
    pub fn expanded(&self, by: &Expansion) -> Self {
        let [inner, balls, outer] = by.strains.map(|strain| 1.0 + strain);
        let radius = self.radius * balls;
        let groove = |own: &RaceGroove<f64>, grown: f64, seat: f64| RaceGroove {
            centre_radius: own.centre_radius * grown + seat,
            place: own.place * grown,
            slack: (own.slack + self.radius) * grown - radius,
            ..*own
        };
        SpatialBall {
            radius,
            inner: groove(&self.inner, inner, by.seats[0]),
            outer: groove(&self.outer, outer, by.seats[1]),
            ..*self
        }
    }
    /// Thrust of a ball at rest between concentric rings on the inner one, which is moved along the axis by so much, m, N: K δ^1.5 sin α,
    /// both contacts in series.
    pub fn thrust_at_rest(&self, moved: f64) -> f64 {
        let [radial, axial] = self.groove_distance();
        let axial = axial - moved;
        let distance = radial.hypot(axial);
        let approach = (distance - self.inner.slack - self.outer.slack).max(0.0);
        let stiffness = joint_stiffness(self.inner.stiffness, self.outer.stiffness);
        stiffness * approach.powf(1.5) * axial / distance.max(f64::MIN_POSITIVE)
    }
    /// From the centre of the inner groove to that of the outer one, rings concentric: radially and along the axis, m.
    pub fn groove_distance(&self) -> [f64; 2] {
        [
            self.outer.centre_radius - self.inner.centre_radius,
            self.outer.place - self.inner.place,
        ]
    }
    /// Sign of the thrust on the inner ring that its row takes; 0 of grooves that stand opposite each other.
    pub fn side(&self) -> f64 {
        let apart = self.inner.place - self.outer.place;
        match apart.abs() > OPPOSITE * self.radius {
            true => apart.signum(),
            false => 0.0,
        }
    }
    /// As one of so many it rolls between concentric rings.
    pub(super) fn rolls(&self, balls: usize) -> Geometry {
        let [radial, axial] = self.groove_distance();
        let distance = radial.hypot(axial);
        let contact_cosine = match distance > 0.0 {
            true => radial.abs() / distance,
            false => 1.0,
        };
        Geometry {
            balls,
            ball_radius: self.radius,
            inner_track: self.between_rings()[0] - self.radius * contact_cosine,
            contact_cosine,
        }
    }
    /// Where it rests between concentric rings: radius and place along the axis, m. Pressed by both races alike, or in the middle of
    /// the gap.
    pub fn between_rings(&self) -> [f64; 2] {
        let [i, o] = [&self.inner, &self.outer];
        let [radial, axial] = self.groove_distance();
        let distance = radial.hypot(axial);
        let approach = distance - i.slack - o.slack;
        let share = if approach > 0.0 {
            1.0 / (1.0 + (i.stiffness / o.stiffness).powf(2.0 / 3.0))
        } else {
            0.5
        };
        // grooves whose centres are one press nothing, in no direction
        let part = (i.slack + share * approach) / distance.max(f64::MIN_POSITIVE);
        [i.centre_radius + radial * part, i.place + axial * part]
    }
}

/// States of a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallState<R> {
    /// ρ, m.
    pub radius: R,
    /// ρ̇, m/s.
    pub radial_speed: R,
    /// θ, rad.
    pub azimuth: R,
    /// θ̇, rad/s.
    pub orbit_speed: R,
    /// z, m.
    pub axial: R,
    /// ż, m/s.
    pub axial_speed: R,
    /// (w_r, w_t, w_z), rad/s.
    pub spin: Vec3<R>,
}

/// Directions of the cylinder at a ball: cosine and sine of its azimuth.
#[derive(Clone, Copy, Debug)]
pub struct Turned<R> {
    cosine: R,
    sine: R,
}

impl<R: Real> Turned<R> {
    /// At an azimuth.
    #[inline(always)]
    pub fn to(azimuth: R) -> Self {
        let (sine, cosine) = azimuth.sin_cos();
        Turned { cosine, sine }
    }
    /// A vector of the cylinder (r, t, z) in the frame.
    #[inline(always)]
    pub fn to_frame(self, v: Vec3<R>) -> Vec3<R> {
        let x = v.x * self.cosine - v.y * self.sine;
        Vec3::new(x, v.x * self.sine + v.y * self.cosine, v.z)
    }
    /// A vector of the frame in the cylinder.
    #[inline(always)]
    pub fn to_cylinder(self, v: Vec3<R>) -> Vec3<R> {
        let t = v.y * self.cosine - v.x * self.sine;
        Vec3::new(v.x * self.cosine + v.y * self.sine, t, v.z)
    }
}

impl<R: Real> BallState<R> {
    /// From the lists of a row.
    #[inline(always)]
    pub fn load<S: Real<Group = R>>(lists: &[&[S]; BALL_STATES], from: usize) -> Self {
        let [rho, d_rho, theta, d_theta, z, d_z, r, t, a] = lists;
        BallState {
            radius: S::load_group(rho, from),
            radial_speed: S::load_group(d_rho, from),
            azimuth: S::load_group(theta, from),
            orbit_speed: S::load_group(d_theta, from),
            axial: S::load_group(z, from),
            axial_speed: S::load_group(d_z, from),
            spin: Vec3::new(
                S::load_group(r, from),
                S::load_group(t, from),
                S::load_group(a, from),
            ),
        }
    }
    /// From the nine states.
    pub fn from_array(values: [R; BALL_STATES]) -> Self {
        let [
            radius,
            radial_speed,
            azimuth,
            orbit_speed,
            axial,
            axial_speed,
            x,
            y,
            z,
        ] = values;
        BallState {
            radius,
            radial_speed,
            azimuth,
            orbit_speed,
            axial,
            axial_speed,
            spin: Vec3::new(x, y, z),
        }
    }
    /// The nine states.
    #[inline(always)]
    pub fn to_array(self) -> [R; BALL_STATES] {
        let spin = self.spin;
        [
            self.radius,
            self.radial_speed,
            self.azimuth,
            self.orbit_speed,
            self.axial,
            self.axial_speed,
            spin.x,
            spin.y,
            spin.z,
        ]
    }
    /// In the frame.
    #[inline(always)]
    pub fn in_space(&self, turned: Turned<R>) -> BallInSpace<R> {
        let zero = R::zero();
        let along = self.radius * self.orbit_speed;
        BallInSpace {
            position: turned.to_frame(Vec3::new(self.radius, zero, self.axial)),
            velocity: turned.to_frame(Vec3::new(self.radial_speed, along, self.axial_speed)),
            spin: turned.to_frame(self.spin),
        }
    }
    /// Its rates under a force per mass and a moment per inertia, both in the cylinder.
    #[inline(always)]
    pub fn rates(&self, force: Vec3<R>, moment: Vec3<R>) -> BallState<R> {
        let two = R::splat(2.0);
        let turn = self.orbit_speed;
        BallState {
            radius: self.radial_speed,
            radial_speed: force.x + self.radius * turn.square(),
            azimuth: turn,
            orbit_speed: (force.y - two * self.radial_speed * turn) / self.radius,
            axial: self.axial_speed,
            axial_speed: force.z,
            spin: Vec3::new(
                moment.x + turn * self.spin.y,
                moment.y - turn * self.spin.x,
                moment.z,
            ),
        }
    }
}
