//! The bearing ball by ball, in the plane.
//!
//! States: those of the cage, then those of the balls: see [`ball_states`](super::ball_states).
//!
//! ```text
//!   I_c ω̇_c = Σ cage moments of the balls - c_c ω_c        ball j: see `ball`
//! ```
//! What keeps the balls apart is one of three: a cage centred on the outer race, with which its mass moves; a cage that
//! is free to move, see [`cage`](super::cage); or nothing but the balls, see [`full_complement`](super::full_complement).
//! Drag to ground (c_d on the orbit, c_w on the spin, c_c on the cage) exists to reproduce reference cases; it is no
//! bearing friction moment. That is [`steady_moment`](super::steady_moment), and excludes it; without it the oil of lubricated
//! contacts resists rolling by [`inlet_couples`](super::inlet_couples).
//!
//! Does not model: squeeze of the film, heat.

use super::ball::{
    BallConstants, BallDistances, BallMotion, BallReaction, PocketMotion, RaceMotion, gather_group,
};
use super::ball_states::{
    OF_BALL, OF_CENTRED_CAGE, OF_FREE_CAGE, direction, load_ball, race, split, split_mut,
};
use super::cage::{self, FreeCage, Land};
use super::full_complement::{self, BallPair, FullComplement};
use super::inlet_couples::{self, InletCouples};
use super::steady_moment::{self, Geometry, MomentPairs, SharedMoment};
use super::{BallSums, BearingEnergy, BearingHeat, BearingReaction, largest_part};
use crate::motion::{Motion, Wrench};
use number::{Gather, Real, Vec2, Vectorized};
use physics::inlet_rolling::ResistanceAtRaces;
use physics::traction::{Traction, TractionLaw};

/// Constants of one planar bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarConstants {
    /// Number of balls.
    pub balls: usize,
    /// The ball, its contacts and its pocket.
    pub ball: BallConstants<f64>,
    /// Friction between ball and race.
    pub traction: Traction<f64>,
    /// What keeps the balls apart.
    pub separation: Separation<f64>,
    /// Cage mass, kg; without meaning where there is no cage.
    pub cage_mass: f64,
    /// Cage moment of inertia, kg m²; without meaning where there is no cage.
    pub cage_inertia: f64,
    /// Drag of the cage to ground, N m s.
    pub cage_drag: f64,
    /// Azimuth of ball 1 at the start, rad.
    pub first_ball_angle: f64,
    /// The steady friction moment; with it the drags to ground are zero.
    pub moment: Option<SharedMoment>,
    /// Rolling resistance of the oil in the inlets; not counted beside a steady moment, which holds it.
    pub inlet_rolling: Option<ResistanceAtRaces<f64>>,
}

/// What keeps the balls apart.
#[derive(Clone, Debug, PartialEq)]
pub enum Separation<R> {
    /// A cage whose centre is that of the outer race.
    CentredCage,
    /// A cage that is free to move, within its pockets and the clearance of its land if it has one.
    FreeCage(Option<Land<R>>),
    /// No cage: a full complement of balls, each against its neighbours.
    Neighbours(BallPair<R>),
}

/// What keeps the balls apart, where it is more than a centred cage, over `R`.
#[derive(Clone, Debug)]
enum Apart<R: Real> {
    Centred,
    Free(FreeCage<R>),
    Neighbours(FullComplement<R>),
}

/// The planar bearing over `R`.
#[derive(Clone, Debug)]
pub struct Planar<R: Real> {
    pub(super) balls: usize,
    pub(super) ball: BallConstants<R::Group>,
    traction: Traction<R::Group>,
    cage_inverse_inertia: R,
    cage_drag: R,
    /// 2k: twice the growth of the inner track's radius with the square of its speed, m s².
    twice_growth: R,
    moment: Option<MomentPairs<R>>,
    couples: Option<InletCouples<R>>,
    apart: Apart<R>,
    /// First state of the balls.
    pub(super) first: usize,
    /// Angle of each pocket on the cage, rad.
    seats: Vec<R>,
}

impl<R: Real> Planar<R> {
    /// One bearing per lane.
    pub(crate) fn gather<'a>(machine: &dyn Fn(usize) -> &'a PlanarConstants) -> Self {
        let balls = Gather::<R>::gather(&|lane| &machine(lane).balls);
        Planar {
            balls,
            ball: machine(0)
                .separation
                .beyond_pockets(gather_group::<R, _>(&|lane| &machine(lane).ball)),
            traction: gather_group::<R, _>(&|lane| &machine(lane).traction),
            cage_inverse_inertia: R::from_lanes(|lane| 1.0 / machine(lane).cage_inertia),
            cage_drag: R::from_lanes(|lane| machine(lane).cage_drag),
            twice_growth: R::from_lanes(|lane| 2.0 * machine(lane).ball.inner_track_growth),
            moment: MomentPairs::gather(&|lane| {
                let bearing = machine(lane);
                (bearing.geometry(), bearing.moment.as_ref())
            }),
            couples: InletCouples::gather(&|lane| machine(lane)),
            apart: match &machine(0).separation {
                Separation::CentredCage => Apart::Centred,
                Separation::FreeCage(_) => {
                    Apart::Free(FreeCage::gather(&|lane| match &machine(lane).separation {
                        Separation::FreeCage(land) => (machine(lane), land.as_ref()),
                        _ => panic!("lanes share what keeps the balls apart"),
                    }))
                }
                Separation::Neighbours(_) => {
                    Apart::Neighbours(FullComplement::gather(
                        &|lane| match &machine(lane).separation {
                            Separation::Neighbours(pair) => (machine(lane), pair),
                            _ => panic!("lanes share what keeps the balls apart"),
                        },
                    ))
                }
            },
            first: machine(0).first_ball_state(),
            seats: (0..balls)
                .map(|j| R::from_lanes(|lane| machine(lane).seat(j)))
                .collect(),
        }
    }

    /// Reaction to the motion of the races; the load that is held besides theirs reaches the steady moment only.
    #[inline(always)]
    pub(crate) fn react(
        &self,
        motion: &Motion<R>,
        held_load: R,
        state: &[R],
        rate: &mut [R],
        detail: &mut [R],
    ) -> BearingReaction<R> {
        // the law is chosen once a call, not once a ball
        let mut reaction = match &self.traction {
            Traction::Tanh(law) => self.apart(law, motion, state, rate, detail),
            Traction::FourParameter(law) => self.apart(law, motion, state, rate, detail),
            Traction::Dry(law) => self.apart(law, motion, state, rate, detail),
            Traction::Lubricated(law) => self.apart(law, motion, state, rate, detail),
        };
        // apart from the sum above: without a steady moment nothing is paid, and the code above stands once a law
        if let Some(pairs) = &self.moment {
            R::vectorized(steady_moment::Share {
                bearing: self,
                pairs,
                motion,
                held_load,
                state,
                rate,
                reaction: &mut reaction,
            });
        }
        if let Some(couples) = &self.couples {
            R::vectorized(inlet_couples::Act {
                bearing: self,
                couples,
                motion,
                state,
                rate,
                reaction: &mut reaction,
            });
        }
        match &self.apart {
            Apart::Centred => {}
            Apart::Free(cage) => R::vectorized(cage::Act {
                cage,
                motion,
                state,
                rate,
                detail,
                reaction: &mut reaction,
            }),
            Apart::Neighbours(row) => R::vectorized(full_complement::Act {
                row,
                state,
                rate,
                detail,
                reaction: &mut reaction,
            }),
        }
        reaction
    }

    /// The sum over the balls as a task of its own: it is compiled once for all systems, apart from their steps.
    #[inline(always)]
    fn apart<L: TractionLaw<R::Group>>(
        &self,
        traction: &L,
        motion: &Motion<R>,
        state: &[R],
        rate: &mut [R],
        detail: &mut [R],
    ) -> BearingReaction<R> {
        R::vectorized(Sum {
            bearing: self,
            traction,
            motion,
            state,
            rate,
            detail,
        })
    }

    /// Rate of the angular momentum of balls and cage about the origin, N m, from the rates of their states.
    #[inline(always)]
    pub(crate) fn angular_momentum_rate(&self, state: &[R], rate: &[R]) -> R {
        let n = self.balls;
        let (lists, rates) = (split(state, self.first, n), split(rate, self.first, n));
        let mut sum = BallSums::<R, 1>::new(n);
        let mut from = 0;
        while from < n {
            let (ball, change) = (load_ball(&lists, from), load_ball::<R>(&rates, from));
            let two = <R::Group as Real>::splat(2.0);
            let orbit = ball.radius.square() * change.orbit_speed
                + two * ball.radius * ball.radial_speed * ball.orbit_speed;
            let spin = change.spin / self.ball.inverse_inertia;
            sum.add(from, &[self.ball.mass * orbit + spin]);
            from += R::GROUP;
        }
        let turning = rate[1] / self.cage_inverse_inertia;
        sum.total()[0]
            + match &self.apart {
                Apart::Centred => turning,
                Apart::Free(cage) => turning + cage.orbital_momentum_rate(state, rate),
                Apart::Neighbours(_) => R::zero(),
            }
    }

    #[inline(always)]
    fn sum<L: TractionLaw<R::Group>>(
        &self,
        traction: &L,
        motion: &Motion<R>,
        state: &[R],
        rate: &mut [R],
        detail: &mut [R],
    ) -> BearingReaction<R> {
        let n = self.balls;
        let (cage_angle, cage_speed) = (state[0], state[1]);
        let lists = split(state, self.first, n);
        let [d_radius, d_radial_speed, d_azimuth, d_orbit_speed, d_spin] =
            split_mut(rate, self.first, n);

        let (inner, outer) = (race(&motion.inner), race(&motion.outer));
        // all directions and distances first: the roots and divisions of one ball keep no other ball waiting; they
        // stand where rates are written afterwards
        let mut from = 0;
        while from < n {
            let (radius, azimuth) = (R::load_group(lists[0], from), R::load_group(lists[2], from));
            let d = BallDistances::of(&inner, &outer, radius, direction(azimuth));
            R::store_group(d.inverse_product, d_radius, from);
            R::store_group(d.e_r.x, d_radial_speed, from);
            R::store_group(d.inner, d_azimuth, from);
            R::store_group(d.e_r.y, d_orbit_speed, from);
            R::store_group(d.outer, d_spin, from);
            from += R::GROUP;
        }
        let mut largest = [<R::Group as Real>::zero(); 3];
        let mut sums = BallSums::<R, 16>::new(n);
        let mut from = 0;
        while from < n {
            let ball = load_ball(&lists, from);
            let pocket = PocketMotion {
                angle: cage_angle.grouped() + R::load_group(&self.seats, from),
                spin: cage_speed.grouped(),
            };
            let distances = BallDistances {
                e_r: Vec2::new(
                    R::load_group(d_radial_speed, from),
                    R::load_group(d_orbit_speed, from),
                ),
                inner: R::load_group(d_azimuth, from),
                outer: R::load_group(d_spin, from),
                inverse_product: R::load_group(d_radius, from),
            };
            let r = (self.ball).react(traction, &inner, &outer, &pocket, &ball, &distances);
            R::store_group(ball.radial_speed, d_radius, from);
            R::store_group(r.acceleration.radial, d_radial_speed, from);
            R::store_group(ball.orbit_speed, d_azimuth, from);
            R::store_group(r.acceleration.orbit, d_orbit_speed, from);
            R::store_group(r.acceleration.spin, d_spin, from);
            sums.add(
                from,
                &[
                    r.on_inner.force.x,
                    r.on_inner.force.y,
                    r.on_inner.moment,
                    r.on_outer.force.x,
                    r.on_outer.force.y,
                    r.on_outer.moment,
                    r.on_cage,
                    r.external_moment,
                    r.heat.inner_damping,
                    r.heat.outer_damping,
                    r.heat.inner_sliding,
                    r.heat.outer_sliding,
                    r.heat.drag,
                    r.heat.pocket_damping,
                    r.heat.pocket_sliding,
                    r.inner_elastic,
                ],
            );
            // a group repeats the last ball behind the end of the list: no harm to a maximum
            largest = [
                largest[0].max(r.inner_load),
                largest[1].max(r.outer_load),
                largest[2].max(r.pocket_force),
            ];
            let details = [
                r.inner_load,
                r.outer_load,
                r.inner_slip,
                r.outer_slip,
                r.pocket_force,
            ];
            for (list, value) in detail.chunks_exact_mut(n).zip(details) {
                R::store_group(value, list, from);
            }
            from += R::GROUP;
        }
        let s = sums.total();
        let cage_drag = self.cage_drag * cage_speed;
        rate[0] = cage_speed;
        rate[1] = (s[6] - cage_drag) * self.cage_inverse_inertia;
        BearingReaction {
            on_inner: Wrench::planar(Vec2::new(s[0], s[1]), s[2]),
            on_outer: Wrench::planar(Vec2::new(s[3], s[4]), s[5]),
            inner_inertia: R::zero(),
            outer_inertia: R::zero(),
            loss_inertia: R::zero(),
            steady_moment: R::zero(),
            growth_impulse: self.twice_growth * motion.inner.spin * s[15],
            external_moment: s[7] - cage_drag,
            heat: BearingHeat {
                inner_damping: s[8],
                outer_damping: s[9],
                inner_sliding: s[10],
                outer_sliding: s[11],
                drag: s[12] + cage_drag * cage_speed,
                pocket_damping: s[13],
                pocket_sliding: s[14],
                ..BearingHeat::zero()
            },
            largest_inner_load: largest_part::<R>(largest[0]),
            largest_outer_load: largest_part::<R>(largest[1]),
            largest_pocket_force: largest_part::<R>(largest[2]),
            land_force: R::zero(),
        }
    }
}

/// [`Planar::sum`] as a task.
struct Sum<'a, R: Real, L> {
    bearing: &'a Planar<R>,
    traction: &'a L,
    motion: &'a Motion<R>,
    state: &'a [R],
    rate: &'a mut [R],
    detail: &'a mut [R],
}

impl<R: Real, L: TractionLaw<R::Group>> Vectorized for Sum<'_, R, L> {
    type Output = BearingReaction<R>;
    #[inline(always)]
    fn run(self) -> BearingReaction<R> {
        self.bearing.sum(
            self.traction,
            self.motion,
            self.state,
            self.rate,
            self.detail,
        )
    }
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

impl PlanarConstants {
    /// Angle of a pocket on the cage, rad.
    pub fn seat(&self, ball: usize) -> f64 {
        2.0 * std::f64::consts::PI * ball as f64 / self.balls as f64
    }
    /// Motion of one ball.
    pub fn motion(&self, state: &[f64], ball: usize) -> BallMotion<f64> {
        let [radius, radial_speed, azimuth, orbit_speed, spin] =
            split(state, self.first_ball_state(), self.balls).map(|list| list[ball]);
        BallMotion {
            radius,
            radial_speed,
            azimuth,
            orbit_speed,
            spin,
        }
    }
    /// Writes the motion of one ball.
    pub fn set_motion(&self, state: &mut [f64], ball: usize, motion: &BallMotion<f64>) {
        let [radius, radial_speed, azimuth, orbit_speed, spin] =
            split_mut(state, self.first_ball_state(), self.balls);
        radius[ball] = motion.radius;
        radial_speed[ball] = motion.radial_speed;
        azimuth[ball] = motion.azimuth;
        orbit_speed[ball] = motion.orbit_speed;
        spin[ball] = motion.spin;
    }
    /// Index of the azimuth of a ball among the bearing's states.
    pub fn azimuth_channel(&self, ball: usize) -> usize {
        self.first_ball_state() + 2 * self.balls + ball
    }
    /// First state of the balls.
    pub fn first_ball_state(&self) -> usize {
        match self.separation {
            Separation::CentredCage | Separation::Neighbours(_) => OF_CENTRED_CAGE,
            Separation::FreeCage(_) => OF_FREE_CAGE,
        }
    }
    /// Number of states.
    pub fn states(&self) -> usize {
        self.first_ball_state() + OF_BALL * self.balls
    }
    /// Mass of the cage where it moves by its own states, kg.
    pub(super) fn free_cage_mass(&self) -> f64 {
        match self.separation {
            Separation::FreeCage(_) => self.cage_mass,
            Separation::CentredCage | Separation::Neighbours(_) => 0.0,
        }
    }
    /// Mass of a cage, kg; zero where there is none.
    pub fn mass_of_cage(&self) -> f64 {
        match self.separation {
            Separation::Neighbours(_) => 0.0,
            Separation::CentredCage | Separation::FreeCage(_) => self.cage_mass,
        }
    }
    pub(super) fn rest(&self, state: &mut [f64]) {
        state[0] = self.first_ball_angle;
        state[1] = 0.0;
        for ball in 0..self.balls {
            let motion = BallMotion {
                radius: self.rest_radius(),
                radial_speed: 0.0,
                azimuth: self.first_ball_angle + self.seat(ball),
                orbit_speed: 0.0,
                spin: 0.0,
            };
            self.set_motion(state, ball, &motion);
        }
    }
    /// Makes cage and balls roll with an inner race of this speed, rad/s, the outer race at rest.
    pub fn roll(&self, state: &mut [f64], speed: f64) {
        let s = self.ball.radius / self.ball.inner_track;
        let cage_speed = speed / (2.0 * (1.0 + s));
        state[1] = cage_speed;
        for j in 0..self.balls {
            let mut ball = self.motion(state, j);
            ball.orbit_speed = cage_speed;
            ball.spin = -speed / (2.0 * s);
            self.set_motion(state, j, &ball);
        }
    }
    /// Reaction of one ball, for inspection; without its part of the steady moment, and without its pocket where the
    /// cage is not centred.
    pub fn ball_reaction(
        &self,
        motion: &Motion<f64>,
        state: &[f64],
        ball: usize,
    ) -> BallReaction<f64> {
        let (inner, outer) = (race(&motion.inner), race(&motion.outer));
        let (pocket, ball) = (self.pocket(state, ball), self.motion(state, ball));
        self.separation.beyond_pockets(self.ball).react(
            &self.traction,
            &inner,
            &outer,
            &pocket,
            &ball,
            &distances(&inner, &outer, &ball),
        )
    }
    fn geometry(&self) -> Geometry {
        Geometry {
            balls: self.balls,
            ball_radius: self.ball.radius,
            inner_track: self.ball.inner_track,
        }
    }
    /// True where anything drags on balls or cage from the ground.
    pub fn drags_to_ground(&self) -> bool {
        self.ball.orbit_drag != 0.0 || self.ball.spin_drag != 0.0 || self.cage_drag != 0.0
    }
    fn pocket(&self, state: &[f64], ball: usize) -> PocketMotion<f64> {
        PocketMotion {
            angle: state[0] + self.seat(ball),
            spin: state[1],
        }
    }
    pub(super) fn energy(&self, motion: &Motion<f64>, state: &[f64]) -> BearingEnergy {
        let (inner, outer) = (race(&motion.inner), race(&motion.outer));
        let between_races = self.separation.beyond_pockets(self.ball);
        let mut sum = BearingEnergy::default();
        for j in 0..self.balls {
            let ball = self.motion(state, j);
            let pocket = self.pocket(state, j);
            let (elastic, weight) = between_races.energy(&inner, &outer, &pocket, &ball);
            let (translation, spin) = self.ball.kinetic_energy(&ball);
            sum.translation += translation;
            sum.spin += spin;
            sum.elastic += elastic;
            sum.weight += weight;
            sum.angular_momentum += self.ball.angular_momentum(&ball);
        }
        match &self.separation {
            Separation::CentredCage => {}
            Separation::FreeCage(land) => {
                let cage = cage::energy(self, land.as_ref(), motion, state);
                sum.translation += cage.translation;
                sum.weight += cage.weight;
                sum.elastic += cage.elastic;
                sum.angular_momentum += cage.angular_momentum;
            }
            Separation::Neighbours(pair) => {
                sum.elastic += full_complement::energy(self, pair, state);
                return sum;
            }
        }
        sum.spin += 0.5 * self.cage_inertia * state[1] * state[1];
        sum.angular_momentum += self.cage_inertia * state[1];
        sum
    }
}

impl<T> Separation<T> {
    /// The ball for the sum over the races: where the cage is not centred, pockets are no part of it.
    pub(super) fn beyond_pockets<R: Real>(&self, mut ball: BallConstants<R>) -> BallConstants<R> {
        if !matches!(self, Separation::CentredCage) {
            ball.pocket_gap = R::splat(f64::INFINITY);
        }
        ball
    }
}
