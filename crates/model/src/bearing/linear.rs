//! One ball with its derivatives: the blocks of the bearing's Jacobian.
//!
//! A ball acts on the races and the cage, and depends on them, but never on another ball: what a linearly implicit step
//! needs of it are the partial derivatives of its own rates and of its reactions with respect to its own five states and
//! to the motion of its neighbours.
//! Left out, as the method allows, which then takes those parts explicitly: how the steady moment couples the balls through
//! their sums, the rolling resistance of oil, how fast the state of the lubricant changes, how neighbours without a cage press each other, and what follows from the place
//! of a free cage.

use super::ball::{BallConstants, BallMotion, BallReaction, PocketMotion, RaceMotion};
use super::ball_states::{CAGE_PLACE, OF_BALL, direction, distances, seat};
use super::cage;
use super::lubricant_state::Warmed;
use super::planar_constants::{PlanarConstants, Separation};
use super::pocket::PocketShape;
use crate::motion::Motion;
use number::{Dual, Gather, Real, Vec2, Vectorized};
use physics::traction::Traction;

/// States of a ball.
pub const STATES: usize = OF_BALL;
/// What a ball depends on besides: x, y, ẋ, ẏ and spin of the inner race, x, y, ẋ, ẏ of the outer race, which does not
/// turn, angle and speed of the cage.
pub const NEIGHBOURS: usize = 11;
/// A number with its derivatives with respect to the states of a ball, then to those of its neighbours.
pub type BallDual = Dual<{ STATES + NEIGHBOURS }>;

/// A ball over numbers with derivatives.
#[derive(Clone, Debug)]
pub struct LinearBall {
    pockets: PocketShape,
    between_races: BallConstants<BallDual>,
    ball: BallConstants<BallDual>,
    traction: Traction<BallDual>,
}

/// The neighbours of the balls, with derivatives with respect to their own motion.
#[derive(Clone, Copy, Debug)]
struct Neighbours {
    inner: RaceMotion<BallDual>,
    outer: RaceMotion<BallDual>,
    cage: PocketMotion<BallDual>,
    /// A cage that is free to move; its place without derivatives.
    free_cage: Option<RaceMotion<BallDual>>,
}

impl Neighbours {
    fn of(bearing: &PlanarConstants, motion: &Motion<f64>, state: &[f64]) -> Self {
        let seeded = |v: Vec2<f64>, first: usize| {
            Vec2::new(
                BallDual::variable(v.x, STATES + first),
                BallDual::variable(v.y, STATES + first + 1),
            )
        };
        let (inner, outer) = (&motion.inner, &motion.outer);
        let cage_speed = BallDual::variable(state[1], STATES + 10);
        let place = |first: usize| {
            Vec2::new(
                BallDual::splat(state[first]),
                BallDual::splat(state[first + 1]),
            )
        };
        Neighbours {
            free_cage: match bearing.separation {
                Separation::FreeCage(_) => Some(RaceMotion {
                    position: place(CAGE_PLACE),
                    velocity: place(CAGE_PLACE + 2),
                    spin: cage_speed,
                }),
                Separation::CentredCage | Separation::Neighbours(_) => None,
            },
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
                spin: cage_speed,
            },
        }
    }
}

impl LinearBall {
    /// The ball of a bearing.
    pub fn of(bearing: &PlanarConstants) -> Self {
        LinearBall {
            pockets: match &bearing.separation {
                Separation::FreeCage(land) => cage::shape(land.as_ref()),
                Separation::CentredCage | Separation::Neighbours(_) => PocketShape::Flat,
            },
            between_races: bearing
                .separation
                .beyond_pockets(Gather::<BallDual>::gather(&|_| &bearing.ball)),
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
        let neighbours = Neighbours::of(bearing, motion, state);
        let warmed = bearing.warmed_traction(state).map(BallDual::splat);
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
                warmed,
                neighbours: &neighbours,
                seat: seat(ball, bearing.balls),
                ball: &seeded,
            });
            take(ball, &seeded, &reaction);
        }
    }
}

/// The reaction of one ball as a task, for the vector unit.
struct OneBall<'a> {
    bearing: &'a LinearBall,
    /// Traction coefficient over that of the law, where the films warm.
    warmed: Option<BallDual>,
    neighbours: &'a Neighbours,
    seat: f64,
    ball: &'a BallMotion<BallDual>,
}

impl Vectorized for OneBall<'_> {
    type Output = BallReaction<BallDual>;
    #[inline(always)]
    fn run(self) -> BallReaction<BallDual> {
        let Neighbours {
            inner,
            outer,
            cage,
            free_cage,
        } = self.neighbours;
        let pocket = PocketMotion {
            angle: cage.angle + BallDual::splat(self.seat),
            spin: cage.spin,
        };
        let mut reaction = self.bearing.between_races.react(
            &Warmed {
                law: &self.bearing.traction,
                factor: self.warmed,
            },
            inner,
            outer,
            &pocket,
            self.ball,
            &distances(inner, outer, self.ball),
        );
        if let Some(cage) = free_cage {
            self.add_pocket(&mut reaction, cage, direction(pocket.angle));
        }
        reaction
    }
}

impl OneBall<'_> {
    /// Adds the pocket of a cage that is free to move.
    #[inline(always)]
    fn add_pocket(
        &self,
        reaction: &mut BallReaction<BallDual>,
        cage: &RaceMotion<BallDual>,
        axis: Vec2<BallDual>,
    ) {
        let ball = &self.bearing.ball;
        let r = ball.in_pocket(self.bearing.pockets, cage, axis, self.ball);
        let e_r = direction(self.ball.azimuth);
        let pushed = r.on_ball * ball.inverse_mass;
        let acceleration = &mut reaction.acceleration;
        acceleration.radial += pushed.dot(e_r);
        acceleration.orbit += pushed.dot(e_r.turned()) / self.ball.radius;
        acceleration.spin += r.ball_moment * ball.inverse_inertia;
        reaction.on_cage += r.cage_moment;
        reaction.heat.pocket_damping += r.damping_heat;
        reaction.heat.pocket_sliding += r.sliding_heat;
    }
}

/// Channels of a ball among the bearing's own, in the order of its states.
pub fn channels(bearing: &PlanarConstants, ball: usize) -> [usize; STATES] {
    std::array::from_fn(|state| bearing.first_ball_state() + state * bearing.balls + ball)
}
