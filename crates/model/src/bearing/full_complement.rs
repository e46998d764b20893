//! Balls without a cage: each touches its neighbours.
//!
//! ```text
//!   ball j, its neighbour k = j + 1, the last one's is the first      e = (b_k - b_j)/|b_k - b_j|,  t: e turned +90°
//!   p = 2r - |b_k - b_j|       P = max(0, K(p^1.5 + 1.5 β p^½ ṗ)): Hertz, two equal spheres
//!   u = (v_k - v_j)·t - a(σ_j + σ_k),  a = r - p/2          surfaces of balls that turn alike run against each other
//!   on j  -P e + f t,  f = μ tanh(u/u0) P;  on k the opposite;  moment on both  a f
//! ```
//! The place of the cage in the states is taken by the balls' mean: φ_c is their mean travel, ω_c their mean orbit speed.
//!
//! Assumes: motion in the plane. Does not model: a film between the balls, a filling slot.

use super::ball_pair::{BallPair, Place};
use super::ball_states::{OF_CENTRED_CAGE, direction, split, split_mut};
use super::planar_constants::PlanarConstants;
use super::reaction::BearingReaction;
use number::{Gather, Real, Vec2, Vectorized};
use physics::contact::ball_race_energy;

/// The row of balls over `R`.
#[derive(Clone, Debug)]
pub(super) struct FullComplement<R: Real> {
    balls: usize,
    pair: BallPair<R>,
    inverse_mass: R,
    inverse_inertia: R,
    share: R,
}

#[inline(always)]
fn place<R: Real>(lists: &[&[R]; 5], ball: usize) -> Place<R> {
    let [radius, radial_speed, azimuth, orbit_speed, spin] = lists.map(|list| list[ball]);
    let e_r = direction(azimuth);
    Place {
        radius,
        e_r,
        position: e_r * radius,
        velocity: e_r * radial_speed + e_r.turned() * (radius * orbit_speed),
        spin,
    }
}

impl<R: Real> FullComplement<R> {
    /// One row of balls per lane.
    pub(super) fn gather<'a>(
        machine: &dyn Fn(usize) -> (&'a PlanarConstants, &'a BallPair<f64>),
    ) -> Self {
        let balls = machine(0).0.balls;
        FullComplement {
            balls,
            pair: Gather::<R>::gather(&|lane| machine(lane).1),
            inverse_mass: R::from_lanes(|lane| machine(lane).0.ball.inverse_mass),
            inverse_inertia: R::from_lanes(|lane| machine(lane).0.ball.inverse_inertia),
            share: R::splat(1.0 / balls as f64),
        }
    }

    /// Adds a force and a moment to the rates of a ball's speeds: radial, orbit, spin. No closure: the compiler would leave it outside the vector unit.
    #[inline(always)]
    fn push(
        &self,
        [radial, orbit, spin]: &mut [&mut [R]; 3],
        ball: usize,
        at: &Place<R>,
        (force, moment): (Vec2<R>, R),
    ) {
        let acceleration = force * self.inverse_mass;
        radial[ball] += acceleration.dot(at.e_r);
        orbit[ball] += acceleration.dot(at.e_r.turned()) / at.radius;
        spin[ball] += moment * self.inverse_inertia;
    }

    /// Adds what turns all balls together, rad/s², to the rate of the cage's speed, which is the balls' mean.
    #[inline(always)]
    pub(super) fn shake(&self, turning: R, rate: &mut [R]) {
        rate[1] += turning * self.share;
    }

    /// Adds the contacts of neighbours to the rates and to the reaction; the cage's rates become the balls' means.
    #[inline(always)]
    fn act(
        &self,
        state: &[R],
        rate: &mut [R],
        detail: &mut [R],
        reaction: &mut BearingReaction<R>,
    ) {
        let n = self.balls;
        let lists = split(state, OF_CENTRED_CAGE, n);
        let mut forces = detail.chunks_exact_mut(n).nth(super::cage::POCKET_LIST);
        let rates = split_mut(rate, OF_CENTRED_CAGE, n);
        let [_, d_radial_speed, _, d_orbit_speed, d_spin] = rates;
        let mut speeds = [d_radial_speed, d_orbit_speed, d_spin];
        let zero = R::zero();
        let (mut damping, mut sliding, mut largest) = (zero, zero, zero);
        let start = place(&lists, 0);
        let mut first = start;
        for ball in 0..n {
            let next = if ball + 1 == n { 0 } else { ball + 1 };
            let second = if next == 0 {
                start
            } else {
                place(&lists, next)
            };
            let touch = self.pair.react(&first, &second);
            self.push(&mut speeds, ball, &first, (-touch.force, touch.moment));
            self.push(&mut speeds, next, &second, (touch.force, touch.moment));
            damping += touch.damping_heat;
            sliding += touch.sliding_heat;
            largest = largest.max(touch.normal);
            if let Some(list) = &mut forces {
                list[ball] = touch.normal;
            }
            first = second;
        }
        reaction.heat.neighbour_damping = damping;
        reaction.heat.neighbour_sliding = sliding;
        reaction.largest_pocket_force = largest;
        let [_, _, d_azimuth, d_orbit_speed, _] = split(rate, OF_CENTRED_CAGE, n);
        let (mut travel, mut speeding) = (zero, zero);
        for (orbit, acceleration) in d_azimuth.iter().zip(d_orbit_speed) {
            travel += *orbit;
            speeding += *acceleration;
        }
        rate[0] = travel * self.share;
        rate[1] = speeding * self.share;
    }
}

/// What the neighbours add, as a task: it is compiled once for all systems and traction laws.
pub(super) struct Act<'a, R: Real> {
    pub row: &'a FullComplement<R>,
    pub state: &'a [R],
    pub rate: &'a mut [R],
    pub detail: &'a mut [R],
    pub reaction: &'a mut BearingReaction<R>,
}

impl<R: Real> Vectorized for Act<'_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Act {
            row,
            state,
            rate,
            detail,
            reaction,
        } = self;
        row.act(state, rate, detail, reaction);
    }
}

/// Energy in the contacts of neighbours, J.
pub(super) fn energy(bearing: &PlanarConstants, pair: &BallPair<f64>, state: &[f64]) -> f64 {
    let lists = split(state, OF_CENTRED_CAGE, bearing.balls);
    (0..bearing.balls)
        .map(|ball| {
            let first = place(&lists, ball);
            let second = place(&lists, (ball + 1) % bearing.balls);
            let distance = (second.position - first.position).length_squared().sqrt();
            ball_race_energy(pair.stiffness, 2.0 * pair.radius - distance)
        })
        .sum()
}
