//! The contact of two neighbouring balls: the law stands in [`full_complement`](super::full_complement).

use number::{Mask, Real, Vec2, constants};
use physics::contact::ball_race;

constants! {
    /// The contact of two balls.
    pub struct BallPair {
        /// Ball radius r, m.
        radius: R,
        /// Hertz stiffness K of two equal balls, N/m^1.5.
        stiffness: R,
        /// Contact damping time β, s.
        damping_time: R,
        /// Friction coefficient μ; with contacts at an angle α times cos α.
        friction: R,
        /// 1/u0, s/m; with contacts at an angle α times cos α.
        inverse_reference_speed: R,
    }
}

/// A ball as its neighbour sees it.
#[derive(Clone, Copy)]
pub(super) struct Place<R> {
    pub(super) radius: R,
    pub(super) e_r: Vec2<R>,
    pub(super) position: Vec2<R>,
    pub(super) velocity: Vec2<R>,
    pub(super) spin: R,
}

/// What two neighbours do to each other.
pub(super) struct Touch<R> {
    /// Force on the second ball, N; on the first the opposite.
    pub(super) force: Vec2<R>,
    /// Moment on each of both, N m.
    pub(super) moment: R,
    pub(super) normal: R,
    pub(super) damping_heat: R,
    pub(super) sliding_heat: R,
}

impl<R: Real> BallPair<R> {
    #[inline(always)]
    pub(super) fn react(&self, first: &Place<R>, second: &Place<R>) -> Touch<R> {
        let zero = R::zero();
        let apart = second.position - first.position;
        let two = R::splat(2.0);
        let square = apart.length_squared();
        let reach = two * self.radius;
        let mut touch = Touch {
            force: Vec2::zero(),
            moment: zero,
            normal: zero,
            damping_heat: zero,
            sliding_heat: zero,
        };
        if square.less(reach.square()).any() {
            let distance = square.max(R::splat(1e-30)).sqrt();
            let e = apart * distance.recip();
            let t = e.turned();
            let relative = second.velocity - first.velocity;
            let approach = reach - distance;
            let closing = -relative.dot(e);
            let press = ball_race(self.stiffness, self.damping_time, approach, closing);
            let arm = self.radius - R::splat(0.5) * approach;
            let slip = relative.dot(t) - arm * (first.spin + second.spin);
            let coefficient = self.friction * (slip * self.inverse_reference_speed).tanh();
            let friction = coefficient * press.force;
            touch.force = e * press.force - t * friction;
            touch.moment = arm * friction;
            touch.normal = press.force;
            touch.damping_heat = (press.force - press.elastic) * closing;
            touch.sliding_heat = friction * slip;
        }
        touch
    }
}
