//! A cage that is free to move: guided by its balls, or by a land of the inner or the outer race.
//!
//! ```text
//!   m_c c̈   = -Σ F_j + land + m_c g          F_j, M_j: pocket j on its ball, on the cage, see `pocket`
//!   I_c ω̇_c =  Σ M_j + land moment
//! ```
//! A land is a journal in a bore ([`contact`](crate::contact)): the cage in a bore of the outer race, or the inner race in
//! the cage's bore.
//!
//! Added to the sums over the balls only where a cage is free: a centred one pays nothing.
//!
//! Assumes: rigid cage; its centre of mass at its centre; dry friction at the land.
//! Does not model: a lubricant film in the land, unbalance of the cage, tilt.

use super::ball::{BallConstants, RaceMotion};
use super::ball_states::{
    CAGE_PLACE, OF_FREE_CAGE, add, direction, grouped, load_ball, seat, split, split_mut,
};
use super::ball_sums::{BallSums, largest_part};
use super::land::{Land, LandRace};
use super::planar_constants::PlanarConstants;
use super::pocket::PocketShape;
use super::reaction::{BearingEnergy, BearingReaction};
use crate::base::Masses;
use crate::motion::{Body, Motion};
use number::{Gather, Real, Vec2, Vectorized};

/// A cage that is free to move, over `R`.
#[derive(Clone, Debug)]
pub(super) struct FreeCage<R: Real> {
    balls: usize,
    ball: BallConstants<R::Group>,
    land: Option<Land<R>>,
    inverse_mass: R,
    inverse_inertia: R,
    mass: R,
    gravity: Vec2<R>,
    /// Direction of each pocket on the cage.
    seat_x: Vec<R>,
    seat_y: Vec<R>,
}

/// Pockets of a cage: one that has no land rides on its balls, and needs them around it.
pub(super) fn shape<R>(land: Option<&Land<R>>) -> PocketShape {
    match land {
        Some(_) => PocketShape::Flat,
        None => PocketShape::Spherical,
    }
}

/// Motion of a free cage in the states of its bearing.
#[inline(always)]
fn cage_body<R: Real>(state: &[R]) -> Body<R> {
    Body::planar(
        Vec2::new(state[CAGE_PLACE], state[CAGE_PLACE + 1]),
        Vec2::new(state[CAGE_PLACE + 2], state[CAGE_PLACE + 3]),
        state[0],
        state[1],
    )
}

/// The same as its balls see it.
#[inline(always)]
fn cage_motion<R: Real>(state: &[R]) -> RaceMotion<R::Group> {
    let cage = cage_body(state);
    RaceMotion {
        position: grouped(cage.position),
        velocity: grouped(cage.velocity),
        spin: cage.spin.grouped(),
    }
}

impl<R: Real> FreeCage<R> {
    /// One cage per lane.
    pub(super) fn gather<'a>(
        machine: &dyn Fn(usize) -> (&'a PlanarConstants, Option<&'a Land<f64>>),
    ) -> Self {
        let (first, land) = machine(0);
        let balls = first.balls;
        let constant =
            |value: &dyn Fn(&PlanarConstants) -> f64| R::from_lanes(|lane| value(machine(lane).0));
        let of_seat = |part: &dyn Fn(f64) -> f64| {
            (0..balls)
                .map(|j| constant(&|bearing| part(seat(j, bearing.balls))))
                .collect()
        };
        let of_lane = |lane: usize| machine(lane).1;
        FreeCage {
            balls,
            ball: super::ball::gather_group::<R, _>(&|lane| &machine(lane).0.ball),
            land: land.map(|land| Land {
                race: land.race,
                contact: Gather::<R>::gather(&|lane| match of_lane(lane) {
                    Some(other) if other.race == land.race => &other.contact,
                    _ => panic!("lanes share how the cage is guided"),
                }),
            }),
            inverse_mass: constant(&|bearing| 1.0 / bearing.cage_mass),
            inverse_inertia: constant(&|bearing| 1.0 / bearing.cage_inertia),
            mass: constant(&|bearing| bearing.cage_mass),
            gravity: Vec2::new(
                constant(&|bearing| bearing.ball.gravity.x),
                constant(&|bearing| bearing.ball.gravity.y),
            ),
            seat_x: of_seat(&f64::cos),
            seat_y: of_seat(&f64::sin),
        }
    }

    /// Adds pockets and land to the rates and to the reaction; writes the cage's own rates.
    #[inline(always)]
    fn act(
        &self,
        motion: &Motion<R>,
        state: &[R],
        rate: &mut [R],
        detail: &mut [R],
        reaction: &mut BearingReaction<R>,
    ) {
        let n = self.balls;
        let cage = cage_body(state);
        let of_balls = cage_motion(state);
        let along = direction(cage.angle);
        let lists = split(state, OF_FREE_CAGE, n);
        let (own, _) = rate.split_at(CAGE_PLACE);
        let turning = own[1];
        let [_, d_radial_speed, _, d_orbit_speed, d_spin] = split_mut(rate, OF_FREE_CAGE, n);
        let mut pocket_forces = detail.chunks_exact_mut(n).nth(POCKET_LIST);
        let mut largest = <R::Group as Real>::zero();
        let mut sums = BallSums::<R, 5>::new(n);
        let mut from = 0;
        while from < n {
            let ball = load_ball(&lists, from);
            let (x, y) = (
                R::load_group(&self.seat_x, from),
                R::load_group(&self.seat_y, from),
            );
            let along = grouped(along);
            let axis = along * x + along.turned() * y;
            let r = (self.ball).in_pocket(shape(self.land.as_ref()), &of_balls, axis, &ball);
            let e_r = direction(ball.azimuth);
            let pushed = r.on_ball * self.ball.inverse_mass;
            add(d_radial_speed, from, pushed.dot(e_r));
            add(d_orbit_speed, from, pushed.dot(e_r.turned()) / ball.radius);
            add(d_spin, from, r.ball_moment * self.ball.inverse_inertia);
            largest = largest.max(r.force);
            if let Some(list) = &mut pocket_forces {
                R::store_group(r.force, list, from);
            }
            sums.add(
                from,
                &[
                    r.on_ball.x,
                    r.on_ball.y,
                    r.cage_moment,
                    r.damping_heat,
                    r.sliding_heat,
                ],
            );
            from += R::GROUP;
        }
        let [x, y, pockets, damping, sliding] = sums.total();
        let (mut force, mut moment) = (-Vec2::new(x, y), pockets);
        reaction.heat.pocket_damping += damping;
        reaction.heat.pocket_sliding += sliding;
        reaction.largest_pocket_force = largest_part::<R>(largest);
        if let Some(land) = &self.land {
            let touch = land.react(&cage, motion);
            let (on_cage, on_race) = match land.race {
                LandRace::Inner => (touch.on_bore, touch.on_journal),
                LandRace::Outer => (touch.on_journal, touch.on_bore),
            };
            force += on_cage.force;
            moment += on_cage.moment;
            match land.race {
                LandRace::Inner => reaction.on_inner += on_race,
                LandRace::Outer => reaction.on_outer += on_race,
            }
            reaction.heat.land_damping = touch.damping_heat;
            reaction.heat.land_sliding = touch.friction_heat;
            reaction.land_force = touch.normal_force;
        }
        let acceleration = force * self.inverse_mass + self.gravity;
        rate[1] = turning + moment * self.inverse_inertia;
        rate[CAGE_PLACE] = cage.velocity.x;
        rate[CAGE_PLACE + 1] = cage.velocity.y;
        rate[CAGE_PLACE + 2] = acceleration.x;
        rate[CAGE_PLACE + 3] = acceleration.y;
        reaction.external_moment += cage.position.cross(self.gravity) * self.mass;
    }

    /// Adds an acceleration of all bodies alike, m/s², to the rate of its motion; returns its mass with place and velocity.
    #[inline(always)]
    pub(super) fn shake(&self, by: Vec2<R>, state: &[R], rate: &mut [R]) -> Masses<R> {
        let cage = cage_body(state);
        rate[CAGE_PLACE + 2] += by.x;
        rate[CAGE_PLACE + 3] += by.y;
        Masses::of(self.mass, cage.position, cage.velocity)
    }

    /// Rate of the angular momentum of the cage's centre about the origin, N m.
    #[inline(always)]
    pub(super) fn orbital_momentum_rate(&self, state: &[R], rate: &[R]) -> R {
        let acceleration = Vec2::new(rate[CAGE_PLACE + 2], rate[CAGE_PLACE + 3]);
        cage_body(state).position.cross(acceleration) * self.mass
    }
}

/// The list of pocket forces in a bearing's detail.
pub(super) const POCKET_LIST: usize = 4;

/// What a free cage adds, as a task: it is compiled once for all systems and traction laws.
pub(super) struct Act<'a, R: Real> {
    pub cage: &'a FreeCage<R>,
    pub motion: &'a Motion<R>,
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
            cage,
            motion,
            state,
            rate,
            detail,
            reaction,
        } = self;
        cage.act(motion, state, rate, detail, reaction);
    }
}

/// What a free cage stores at a state: its translation, its weight, its pockets and its land, and the angular momentum of
/// its centre. Its spin is the bearing's.
pub(super) fn energy(
    bearing: &PlanarConstants,
    land: Option<&Land<f64>>,
    motion: &Motion<f64>,
    state: &[f64],
) -> BearingEnergy {
    let cage = cage_body(state);
    let of_balls = cage_motion(state);
    let mass = bearing.cage_mass;
    let in_pockets: f64 = (0..bearing.balls)
        .map(|ball| {
            let axis = direction(cage.angle + seat(ball, bearing.balls));
            let own = bearing.motion(state, ball);
            let pocket = (bearing.ball).in_pocket(shape(land), &of_balls, axis, &own);
            bearing.ball.pocket_energy(pocket.penetration)
        })
        .sum();
    let in_land = land.map_or(0.0, |land| land.contact.energy(&land.react(&cage, motion)));
    BearingEnergy {
        translation: 0.5 * mass * cage.velocity.length_squared(),
        spin: 0.0,
        elastic: in_pockets + in_land,
        weight: -mass * bearing.ball.gravity.dot(cage.position),
        angular_momentum: mass * cage.position.cross(cage.velocity),
    }
}
