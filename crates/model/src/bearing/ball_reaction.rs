//! What a ball feels and does: accelerations, forces on its neighbours, heats.

use crate::motion::Wrench;
use number::Real;
use physics::traction::SlidingContact;

/// The two accelerations and the spin acceleration of a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallAcceleration<R> {
    /// ρ̈, m/s².
    pub radial: R,
    /// θ̈, rad/s².
    pub orbit: R,
    /// σ̇, rad/s².
    pub spin: R,
}

/// Heat made around a ball by kind, W; all are never negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallHeat<R> {
    /// Contact damping at the inner race.
    pub inner_damping: R,
    /// Contact damping at the outer race.
    pub outer_damping: R,
    /// Sliding at the inner race.
    pub inner_sliding: R,
    /// Sliding at the outer race.
    pub outer_sliding: R,
    /// Drag to ground.
    pub drag: R,
    /// Contact damping in the pocket.
    pub pocket_damping: R,
    /// Sliding in the pocket.
    pub pocket_sliding: R,
}

/// What a ball feels and does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallReaction<R> {
    /// Acceleration of the ball.
    pub acceleration: BallAcceleration<R>,
    /// On the inner race, moment about its centre.
    pub on_inner: Wrench<R>,
    /// On the outer race, moment about its centre.
    pub on_outer: Wrench<R>,
    /// Moment on the cage, N m.
    pub on_cage: R,
    /// Moment about the origin from outside the bearing: weight and drag to ground, N m.
    pub external_moment: R,
    /// Heat by kind.
    pub heat: BallHeat<R>,
    /// Load of the contact at the inner race, N.
    pub inner_load: R,
    /// Load of the contact at the outer race, N.
    pub outer_load: R,
    /// Approach at the inner race, m; negative when open.
    pub inner_approach: R,
    /// Approach at the outer race, m; negative when open.
    pub outer_approach: R,
    /// Traction of the inner race on the ball along t, N.
    pub inner_traction: R,
    /// Traction of the outer race on the ball along t, N.
    pub outer_traction: R,
    /// Slip at the inner race, m/s.
    pub inner_slip: R,
    /// Slip at the outer race, m/s.
    pub outer_slip: R,
    /// Entrainment at the inner race, m/s.
    pub inner_entrainment: R,
    /// Entrainment at the outer race, m/s.
    pub outer_entrainment: R,
    /// Pocket force, N.
    pub pocket_force: R,
    /// Pocket friction on the ball along n of the outer race, N.
    pub pocket_friction: R,
    /// Side of the pocket: +1 where the ball leads its pocket.
    pub pocket_side: R,
    /// Pocket penetration, m; negative when free.
    pub pocket_penetration: R,
}

impl<R: Real> BallReaction<R> {
    /// Its contacts at the inner and the outer race, as traction sees them.
    pub fn contacts(&self) -> [SlidingContact<R>; 2] {
        [
            SlidingContact {
                slip: self.inner_slip,
                load: self.inner_load,
                entrainment: self.inner_entrainment,
            },
            SlidingContact {
                slip: self.outer_slip,
                load: self.outer_load,
                entrainment: self.outer_entrainment,
            },
        ]
    }
}
