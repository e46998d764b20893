//! A bearing under a pure axial load at a steady speed, without a hypothesis: the dynamics with all accelerations zero.
//!
//! Unknown are ρ, z, θ̇, w_r, w_t, w_z of one ball, which stands for all of a row, and the axial displacement of the ring. Traction over the
//! nodes and drag take part; w_t is not zero. Started from a quasi-static equilibrium.

use super::ball::{RaceControl, Running, StaticBall};
use super::linear::solve;
use super::ring::{Displacement, NoEquilibrium, RingLoad, StaticRow, StaticRows};
use crate::spatial::ball::{BallState, SpatialBall, Turned};
use crate::spatial::race::RingMotion;
use crate::spatial::row::{BetweenRaces, RowConstants};
use number::{Dual, Gather, Real, Vec3};
use physics::contact_nodes::ContactNode;
use physics::traction::Traction;

/// A steady ball and its ring.
#[derive(Clone, Copy, Debug)]
pub struct SteadyRow {
    /// Axial displacement of the inner ring, m.
    pub displacement: f64,
    /// State of a ball at azimuth 0.
    pub ball: BallState<f64>,
    /// Its contacts.
    pub contacts: BetweenRaces<f64>,
}

const UNKNOWNS: usize = 7;

/// Steady motion of a row without pocket forces, the inner ring turning with a speed under an axial load, N, without gravity.
///
/// # Errors
/// Where the quasi-static equilibrium to start from, or the steady motion, is not found.
pub fn steady_row(
    row: &RowConstants,
    axial_load: f64,
    speed: f64,
    from: RaceControl,
) -> Result<SteadyRow, NoEquilibrium> {
    let ball = &row.ball;
    let rows = StaticRows::from(vec![StaticRow {
        balls: row.balls,
        first_azimuth: 0.0,
        ball: StaticBall {
            radius: ball.radius,
            mass: ball.mass,
            inner: ball.inner,
            outer: ball.outer,
        },
    }]);
    let load = RingLoad {
        force: [0.0, 0.0, axial_load],
        moment: [0.0; 2],
    };
    let start = rows.settle(
        &load,
        &Running {
            speed,
            control: from,
        },
    )?;
    let first = start.rows[0][0];
    let Displacement { shift, .. } = start.displacement;
    let mut x = [
        first.place[0],
        first.place[1],
        first.orbit_speed,
        first.spin[0],
        0.0,
        first.spin[1],
        shift[2],
    ];
    let rates = RateOf { row, speed };
    // a step may change lengths by a µm and speeds by 1 % of the ring's
    let most = [
        1e-6,
        1e-6,
        0.01 * speed,
        0.01 * speed,
        0.01 * speed,
        0.01 * speed,
        1e-6,
    ];
    for _ in 0..1000 {
        let (residual, _) =
            rates.of::<Dual<UNKNOWNS>>(std::array::from_fn(|k| Dual::variable(x[k], k)));
        let mut left = residual.map(|r| -r.value);
        left[6] -= axial_load / row.balls as f64;
        let step = solve(residual.map(|r| r.partial), left).ok_or(NoEquilibrium::Ball)?;
        let longest =
            (0..UNKNOWNS).fold(0.0_f64, |longest, k| longest.max((step[k] / most[k]).abs()));
        for (value, step) in x.iter_mut().zip(&step) {
            *value += step / longest.max(1.0);
        }
        if longest < 1e-9 {
            let (_, contacts) = rates.of::<f64>(x);
            return Ok(SteadyRow {
                displacement: x[6],
                ball: rates.state(x),
                contacts,
            });
        }
    }
    Err(NoEquilibrium::Ring)
}

struct RateOf<'a> {
    row: &'a RowConstants,
    speed: f64,
}

impl RateOf<'_> {
    fn state<R: Real>(&self, x: [R; UNKNOWNS]) -> BallState<R> {
        let zero = R::zero();
        BallState {
            radius: x[0],
            radial_speed: zero,
            azimuth: zero,
            orbit_speed: x[2],
            axial: x[1],
            axial_speed: zero,
            spin: Vec3::new(x[3], x[4], x[5]),
        }
    }
    /// ρ̈, z̈, θ̈, ẇ and the axial force of the ball on the ring.
    fn of<R: Real>(&self, x: [R; UNKNOWNS]) -> ([R; UNKNOWNS], BetweenRaces<R>) {
        let ball: SpatialBall<R> = Gather::gather(&|_| &self.row.ball);
        let law: Traction<R> = Gather::gather(&|_| &self.row.traction);
        let nodes = self.row.nodes.iter();
        let nodes: Vec<ContactNode<R>> = nodes.map(|node| Gather::gather(&|_| node)).collect();
        let zero = R::zero();
        let ring = |place: R, speed: f64| RingMotion {
            position: Vec3::new(zero, zero, place),
            velocity: Vec3::zero(),
            spin: Vec3::new(zero, zero, R::splat(speed)),
            axis: Vec3::new(zero, zero, R::one()),
        };
        let state = self.state(x);
        let space = state.in_space(Turned::to(zero));
        let (inner, outer) = (ring(x[6], self.speed), ring(zero, 0.0));
        let between = ball.between(&law, &nodes, [&inner, &outer], &space);
        let [(on_ball, on_ring), (by_outer, _)] = [0, 1].map(|k| {
            let [ball, ring] = between.touch[k].on_ball_and_ring(&between.traction[k]);
            (ball, ring)
        });
        let inverse_mass = ball.mass.recip();
        let inertia = R::splat(0.4) * ball.mass * ball.radius.square();
        let mut force = (on_ball.force + by_outer.force) * inverse_mass;
        force.y -= ball.orbit_drag * state.radius * state.orbit_speed * inverse_mass;
        let moment = on_ball.moment + by_outer.moment - state.spin * ball.spin_drag;
        let rates = state.rates(force, moment * inertia.recip());
        (
            [
                rates.radial_speed,
                rates.axial_speed,
                rates.orbit_speed,
                rates.spin.x,
                rates.spin.y,
                rates.spin.z,
                on_ring.force.z,
            ],
            between,
        )
    }
}
