//! One ball with its derivatives: the blocks of the bearing's Jacobian.
//!
//! A ball acts on the races and the cage, and depends on them, but never on another ball: what a linearly implicit step
//! needs of it are the partial derivatives of its own rates and of its reactions with respect to its own five states and
//! to the motion of its neighbours.
//! The steady moment couples the balls weakly through their sums; that is left out, as the method allows.

use super::PlanarConstants;
use super::ball::{BallConstants, BallMotion, BallReaction, PocketMotion, RaceMotion};
use super::planar::{BALLS, distances};
use crate::motion::Motion;
use number::{Dual, Gather, Real, Vec2, Vectorized};
use physics::traction::Traction;

/// States of a ball.
pub const STATES: usize = 5;
/// What a ball depends on besides: x, y, ẋ, ẏ and spin of the inner race, x, y, ẋ, ẏ of the outer race, which does not
/// turn, angle and speed of the cage.
pub const NEIGHBOURS: usize = 11;
/// A number with its derivatives with respect to the states of a ball, then to those of its neighbours.
pub type BallDual = Dual<{ STATES + NEIGHBOURS }>;

/// A ball over numbers with derivatives.
#[derive(Clone, Debug)]
pub struct LinearBall {
    ball: BallConstants<BallDual>,
    traction: Traction<BallDual>,
}

/// The neighbours of the balls, with derivatives with respect to their own motion.
#[derive(Clone, Copy, Debug)]
struct Neighbours {
    inner: RaceMotion<BallDual>,
    outer: RaceMotion<BallDual>,
    cage: PocketMotion<BallDual>,
}

impl Neighbours {
    fn of(motion: &Motion<f64>, state: &[f64]) -> Self {
        let seeded = |v: Vec2<f64>, first: usize| {
            Vec2::new(
                BallDual::variable(v.x, STATES + first),
                BallDual::variable(v.y, STATES + first + 1),
            )
        };
        let (inner, outer) = (&motion.inner, &motion.outer);
        Neighbours {
            inner: RaceMotion {
                position: seeded(inner.position, 0),
                velocity: seeded(inner.velocity, 2),
                spin: BallDual::variable(inner.spin, STATES + 4),
            },
            outer: RaceMotion {
                position: seeded(outer.position, 5),
                velocity: seeded(outer.velocity, 7),
                spin: BallDual::splat(outer.spin),
            },
            cage: PocketMotion {
                angle: BallDual::variable(state[0], STATES + 9),
                spin: BallDual::variable(state[1], STATES + 10),
            },
        }
    }
}

impl LinearBall {
    /// The ball of a bearing.
    pub fn of(bearing: &PlanarConstants) -> Self {
        LinearBall {
            ball: Gather::<BallDual>::gather(&|_| &bearing.ball),
            traction: Gather::<BallDual>::gather(&|_| &bearing.traction),
        }
    }

    /// Reactions of all balls with their partial derivatives: by ρ, ρ̇, θ, θ̇, σ of the ball, then by its neighbours;
    /// `state` is the bearing's own.
    pub fn react(
        &self,
        bearing: &PlanarConstants,
        motion: &Motion<f64>,
        state: &[f64],
        take: &mut impl FnMut(usize, &BallMotion<BallDual>, &BallReaction<BallDual>),
    ) {
        let neighbours = Neighbours::of(motion, state);
        for ball in 0..bearing.balls {
            let own = bearing.motion(state, ball);
            let seeded = BallMotion {
                radius: BallDual::variable(own.radius, 0),
                radial_speed: BallDual::variable(own.radial_speed, 1),
                azimuth: BallDual::variable(own.azimuth, 2),
                orbit_speed: BallDual::variable(own.orbit_speed, 3),
                spin: BallDual::variable(own.spin, 4),
            };
            let reaction = BallDual::vectorized(OneBall {
                bearing: self,
                neighbours: &neighbours,
                seat: bearing.seat(ball),
                ball: &seeded,
            });
            take(ball, &seeded, &reaction);
        }
    }
}

/// The reaction of one ball as a task, for the vector unit.
struct OneBall<'a> {
    bearing: &'a LinearBall,
    neighbours: &'a Neighbours,
    seat: f64,
    ball: &'a BallMotion<BallDual>,
}

impl Vectorized for OneBall<'_> {
    type Output = BallReaction<BallDual>;
    #[inline(always)]
    fn run(self) -> BallReaction<BallDual> {
        let Neighbours { inner, outer, cage } = self.neighbours;
        let pocket = PocketMotion {
            angle: cage.angle + BallDual::splat(self.seat),
            spin: cage.spin,
        };
        self.bearing.ball.react(
            &self.bearing.traction,
            inner,
            outer,
            &pocket,
            self.ball,
            &distances(inner, outer, self.ball),
        )
    }
}

/// Channels of a ball among the bearing's own, in the order of its states.
pub fn channels(balls: usize, ball: usize) -> [usize; STATES] {
    std::array::from_fn(|state| BALLS + state * balls + ball)
}
