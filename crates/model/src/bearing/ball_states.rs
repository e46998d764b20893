//! Where cage and balls stand in the states of a planar bearing, and how several balls are read at a time.
//!
//! ```text
//!   0..2   cage    φ_c (rad), ω_c (rad/s)
//!   2..6   cage    x, y (m), ẋ, ẏ (m/s): only where it is free to move
//!   then   balls   ρ (m), ρ̇ (m/s), θ (rad), θ̇ (rad/s), σ (rad/s), each for all balls in turn
//! ```

use super::ball::{BallConstants, BallDistances, BallMotion, RaceMotion};
use crate::motion::{Body, Motion};
use number::{Real, Vec2, Vectorized};

/// States of a ball.
pub const OF_BALL: usize = 5;
/// States of a cage that turns about the outer race's centre.
pub const OF_CENTRED_CAGE: usize = 2;
/// First state of the place of a cage that is free to move: x, y, ẋ, ẏ.
pub const CAGE_PLACE: usize = 2;
/// States of a cage that is free to move.
pub const OF_FREE_CAGE: usize = 6;

/// Angle of a ball's seat on the cage, rad: seats are spread evenly.
pub fn seat(ball: usize, balls: usize) -> f64 {
    2.0 * std::f64::consts::PI * ball as f64 / balls as f64
}

/// The seats of all balls.
pub(super) fn seats<R: Real>(balls: usize) -> Vec<R> {
    (0..balls).map(|ball| R::splat(seat(ball, balls))).collect()
}

/// The balls of a bearing: how many, where their states begin, what each is.
#[derive(Clone, Debug)]
pub(super) struct BallRow<R: Real> {
    /// Number of balls.
    pub balls: usize,
    /// First state of the balls.
    pub first: usize,
    /// The ball.
    pub ball: BallConstants<R::Group>,
}

/// The lists of ball states, one after the other.
#[inline(always)]
pub(super) fn split<R>(state: &[R], first: usize, balls: usize) -> [&[R]; OF_BALL] {
    let (radius, rest) = state[first..].split_at(balls);
    let (radial_speed, rest) = rest.split_at(balls);
    let (azimuth, rest) = rest.split_at(balls);
    let (orbit_speed, rest) = rest.split_at(balls);
    [radius, radial_speed, azimuth, orbit_speed, &rest[..balls]]
}

/// The same lists, to write.
#[inline(always)]
pub(super) fn split_mut<R>(state: &mut [R], first: usize, balls: usize) -> [&mut [R]; OF_BALL] {
    let (radius, rest) = state[first..].split_at_mut(balls);
    let (radial_speed, rest) = rest.split_at_mut(balls);
    let (azimuth, rest) = rest.split_at_mut(balls);
    let (orbit_speed, rest) = rest.split_at_mut(balls);
    [
        radius,
        radial_speed,
        azimuth,
        orbit_speed,
        &mut rest[..balls],
    ]
}

/// The balls from an index on.
#[inline(always)]
pub(super) fn load_ball<R: Real>(lists: &[&[R]; OF_BALL], from: usize) -> BallMotion<R::Group> {
    let [radius, radial_speed, azimuth, orbit_speed, spin] = lists;
    BallMotion {
        radius: R::load_group(radius, from),
        radial_speed: R::load_group(radial_speed, from),
        azimuth: R::load_group(azimuth, from),
        orbit_speed: R::load_group(orbit_speed, from),
        spin: R::load_group(spin, from),
    }
}

/// Adds to the values of the balls from an index on.
#[inline(always)]
pub(super) fn add<R: Real>(list: &mut [R], from: usize, change: R::Group) {
    R::store_group(R::load_group(list, from) + change, list, from);
}

/// A vector as several balls at a time see it.
#[inline(always)]
pub(super) fn grouped<R: Real>(v: Vec2<R>) -> Vec2<R::Group> {
    Vec2::new(v.x.grouped(), v.y.grouped())
}

/// A race as several balls at a time see it.
#[inline(always)]
pub(super) fn race<R: Real>(body: &Body<R>) -> RaceMotion<R::Group> {
    RaceMotion {
        position: grouped(body.position),
        velocity: grouped(body.velocity),
        spin: body.spin.grouped(),
    }
}

/// Unit vector at an azimuth.
#[inline(always)]
pub(super) fn direction<R: Real>(azimuth: R) -> Vec2<R> {
    let (sine, cosine) = azimuth.sin_cos();
    Vec2::new(cosine, sine)
}

/// Distances of a ball from the centres of the races.
#[inline(always)]
pub(super) fn distances<R: Real>(
    inner: &RaceMotion<R>,
    outer: &RaceMotion<R>,
    ball: &BallMotion<R>,
) -> BallDistances<R> {
    BallDistances::of(inner, outer, ball.radius, direction(ball.azimuth))
}

/// Directions and distances of all balls, written where their rates are written afterwards. A pass of its own: the roots and
/// divisions of one ball keep no other ball waiting, and what follows need not repeat them.
pub(super) struct Places<'a, R: Real> {
    pub row: &'a BallRow<R>,
    pub motion: &'a Motion<R>,
    pub state: &'a [R],
    pub rate: &'a mut [R],
}

impl<R: Real> Vectorized for Places<'_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let BallRow { balls, first, .. } = *self.row;
        let (inner, outer) = (race(&self.motion.inner), race(&self.motion.outer));
        let lists = split(self.state, first, balls);
        let kept = split_mut(self.rate, first, balls);
        let mut from = 0;
        while from < balls {
            let (radius, azimuth) = (R::load_group(lists[0], from), R::load_group(lists[2], from));
            let d = BallDistances::of(&inner, &outer, radius, direction(azimuth));
            R::store_group(d.e_r.x, kept[0], from);
            R::store_group(d.e_r.y, kept[1], from);
            R::store_group(d.inner, kept[2], from);
            R::store_group(d.outer, kept[3], from);
            R::store_group(d.inverse_product, kept[4], from);
            from += R::GROUP;
        }
    }
}

/// What [`Places`] keeps of the balls from an index on.
#[inline(always)]
pub(super) fn kept_distances<R: Real>(
    kept: &[&[R]; OF_BALL],
    from: usize,
) -> BallDistances<R::Group> {
    BallDistances {
        e_r: Vec2::new(R::load_group(kept[0], from), R::load_group(kept[1], from)),
        inner: R::load_group(kept[2], from),
        outer: R::load_group(kept[3], from),
        inverse_product: R::load_group(kept[4], from),
    }
}
