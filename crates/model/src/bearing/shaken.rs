//! Balls and a free cage in a bearing whose base is accelerated: an acceleration of all bodies alike is added to what their
//! contacts do.

use super::Bearing;
use super::ball_states::{add, direction, grouped, load_ball, split, split_mut};
use super::ball_sums::BallSums;
use super::planar::Planar;
use crate::base::Masses;
use number::{Real, Vec2, Vectorized};

impl<R: Real> Bearing<R> {
    /// Adds an acceleration, m/s², to the rates of balls and of a cage that have places of their own; returns their masses.
    #[inline(always)]
    pub fn shake(&self, by: Vec2<R>, state: &[R], rate: &mut [R]) -> Masses<R> {
        match self {
            Bearing::Rolling(_) | Bearing::Spatial => Masses::none(),
            Bearing::Planar(bearing) => R::vectorized(Shake {
                bearing,
                by,
                state,
                rate,
            }),
        }
    }
}

struct Shake<'a, R: Real> {
    bearing: &'a Planar<R>,
    by: Vec2<R>,
    state: &'a [R],
    rate: &'a mut [R],
}

impl<R: Real> Vectorized for Shake<'_, R> {
    type Output = Masses<R>;
    #[inline(always)]
    fn run(self) -> Masses<R> {
        let Shake {
            bearing,
            by,
            state,
            rate,
        } = self;
        let (row, by_balls) = (bearing.row(), grouped(by));
        let lists = split(state, row.first, row.balls);
        let [_, d_radial_speed, _, d_orbit_speed, _] = split_mut(rate, row.first, row.balls);
        let mut sums = BallSums::<R, 5>::new(row.balls);
        let mut from = 0;
        while from < row.balls {
            let ball = load_ball(&lists, from);
            let e_r = direction(ball.azimuth);
            let turning = by_balls.dot(e_r.turned()) / ball.radius;
            add(d_radial_speed, from, by_balls.dot(e_r));
            add(d_orbit_speed, from, turning);
            let velocity =
                e_r * ball.radial_speed + e_r.turned() * (ball.radius * ball.orbit_speed);
            let (moment, momentum) = (e_r * ball.radius * row.ball.mass, velocity * row.ball.mass);
            sums.add(from, &[momentum.x, momentum.y, moment.x, moment.y, turning]);
            from += R::GROUP;
        }
        let [vx, vy, x, y, turning] = sums.total();
        let balls = Masses {
            momentum: Vec2::new(vx, vy),
            moment: Vec2::new(x, y),
        };
        balls.and(bearing.shake_apart(by, turning, state, rate))
    }
}
