//! A row of balls with its cage, between two rings.
//!
//! Adds up, in one pass over the balls, what they do to inner ring, outer ring and cage, and the heats. Where asked it fills a detail:
//! inner load, outer load (N), inner slip, outer slip along rolling (m/s), pocket force, inner traction, outer traction along rolling
//! (N), each value for the balls of all rows in turn.

use super::ball::{BALL_STATES, BallState, SpatialBall, Turned};
use super::pocket::{CageMotion, InPocket, PocketPlace};
use super::race::{BallInSpace, RingMotion, Touch, Traction as ContactTraction, traction};
use super::rigid_body::{Inertia, RigidBody, SpatialWrench};
use super::steady_moment::Resist;
use crate::bearing::ball::gather_group;
use crate::bearing::ball_sums::BallSums;
use crate::bearing::steady_moment::MomentPairs;
use crate::bearing::{SharedMoment, seat};
use crate::contact::JournalContact;
use number::{Gather, Real, Vectorized, constants};
use physics::contact_nodes::ContactNode;
use physics::traction::{Traction, TractionLaw};

/// A row of balls of one machine.
#[derive(Clone, Debug, PartialEq)]
pub struct RowConstants {
    /// Number of balls.
    pub balls: usize,
    /// The ball.
    pub ball: SpatialBall<f64>,
    /// Where slip is taken in a contact.
    pub nodes: Vec<ContactNode<f64>>,
    /// Traction in the contacts.
    pub traction: Traction<f64>,
    /// The steady friction moment that its balls share; none of the reference files.
    pub moment: Option<SharedMoment>,
    /// The cage.
    pub cage: CageConstants,
}

/// The cage of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CageConstants {
    /// Mass and inertias.
    pub inertia: Inertia<f64>,
    /// Drag to the housing on its turning, N m s.
    pub drag: f64,
    /// What guides it.
    pub guide: CageGuide<f64>,
}

impl CageConstants {
    /// Whether it moves with the outer ring.
    pub fn is_tied(&self) -> bool {
        matches!(self.guide, CageGuide::Tied)
    }
}

impl RowConstants {
    /// Azimuth of each ball, rad, and where and how it touches inner and outer ring, in the states of its row.
    pub(super) fn touches(
        &self,
        rings: [&RingMotion<f64>; 2],
        state: &[f64],
    ) -> impl Iterator<Item = (f64, [Touch<f64>; 2])> {
        let lists = lists(state, 0, self.balls);
        (0..self.balls).map(move |ball| {
            let own = BallState::from_array(lists.map(|list| list[ball]));
            let space = own.in_space(Turned::to(own.azimuth));
            (own.azimuth, self.ball.touches(rings, &space))
        })
    }
    /// Contacts and pocket of a ball between inner ring, outer ring and cage, in the states of its row.
    pub fn contacts(
        &self,
        [inner, outer, cage]: [&RigidBody<f64>; 3],
        state: &[f64],
        ball: usize,
    ) -> BallContacts<f64> {
        let own = lists(state, 0, self.balls).map(|list| list[ball]);
        let own = BallState::from_array(own);
        let space = own.in_space(Turned::to(own.azimuth));
        let rings = [&RingMotion::of(inner), &RingMotion::of(outer)];
        let (sine, cosine) = seat(ball, self.balls).sin_cos();
        let (law, cage) = (&self.ball, CageMotion::of(cage));
        let place = (law.pocket).place(&cage, [cosine, sine], &space, self.cage.is_tied());
        BallContacts {
            races: law.between(&self.traction, &self.nodes, rings, &space),
            pocket: law.pocket.react(&cage, &space, law.radius, &place),
        }
    }
}

/// What guides a cage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CageGuide<R> {
    /// It turns about its own axis and moves with the outer ring, which takes the forces of its pockets and must not turn.
    Tied,
    /// Its balls.
    Balls,
    /// A land of the outer ring.
    OuterLand(SpatialLand<R>),
    /// A land of the inner ring.
    InnerLand(SpatialLand<R>),
}

constants! {
    /// A cage on a land: a cylinder in a bore at two stations of the bore's axis.
    pub struct SpatialLand {
        /// The surfaces; stiffness at one station.
        contact: JournalContact<R>,
        /// Middle of the stations on the axis of the body with the bore, m.
        middle: R,
        /// Half their distance, m.
        half_width: R,
    }
}

impl<R: Real> Gather<R> for CageGuide<f64> {
    type Out = CageGuide<R>;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> CageGuide<R>
    where
        Self: 'a,
    {
        use CageGuide::{Balls, InnerLand, OuterLand, Tied};
        let land = |lane: usize| match machine(lane) {
            OuterLand(land) | InnerLand(land) => land,
            Tied | Balls => panic!("lanes share how a cage is guided"),
        };
        match machine(0) {
            Tied => Tied,
            Balls => Balls,
            OuterLand(_) => OuterLand(Gather::gather(&land)),
            InnerLand(_) => InnerLand(Gather::gather(&land)),
        }
    }
}

/// A row over `R`.
#[derive(Clone, Debug)]
pub(super) struct Row<R: Real> {
    pub balls: usize,
    pub ball: SpatialBall<R::Group>,
    nodes: Vec<ContactNode<R::Group>>,
    traction: Traction<R::Group>,
    moment: Option<MomentPairs<R>>,
    pub cage: Inertia<R>,
    pub cage_drag: R,
    pub guide: CageGuide<R>,
    /// Cosines and sines of the pockets' places on the cage.
    seats: [Vec<R>; 2],
}

/// What the balls of a row do.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowReaction<R> {
    pub on_inner: SpatialWrench<R>,
    pub on_outer: SpatialWrench<R>,
    /// By the pockets.
    pub on_cage: SpatialWrench<R>,
    /// Damping inner and outer, slip and spin inner and outer, drag, damping and friction of pockets, steady moment, W.
    pub heats: [R; 8],
    /// Moment of weight and drag about the axis through the origin, N m.
    pub external: R,
    /// ∂V/∂ω of the inner ring that grows, J s.
    pub growth_impulse: R,
}

/// Where the detail of the balls goes, an empty list where nobody asks.
pub(super) struct Detail<'a, R> {
    pub list: &'a mut [R],
    /// Balls of the rows before.
    pub before: usize,
    /// Balls of all rows.
    pub balls: usize,
}

/// Bodies around a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Around<R> {
    pub inner: RingMotion<R>,
    pub outer: RingMotion<R>,
    pub cage: CageMotion<R>,
}

/// A ball between its races.
#[derive(Clone, Copy, Debug)]
pub struct BetweenRaces<R> {
    /// At inner and outer race.
    pub touch: [Touch<R>; 2],
    /// Their traction.
    pub traction: [ContactTraction<R>; 2],
}

/// A ball in its races and in its pocket.
#[derive(Clone, Copy, Debug)]
pub struct BallContacts<R> {
    /// At inner and outer race.
    pub races: BetweenRaces<R>,
    /// In its pocket.
    pub pocket: InPocket<R>,
}

/// The lists of ball states that begin at a state.
#[inline(always)]
pub(super) fn lists<R>(state: &[R], first: usize, balls: usize) -> [&[R]; BALL_STATES] {
    let all = &state[first..first + BALL_STATES * balls];
    std::array::from_fn(|k| &all[k * balls..(k + 1) * balls])
}

impl<R: Real> SpatialBall<R> {
    /// Where and how it touches inner and outer ring.
    #[inline(always)]
    pub(super) fn touches(
        &self,
        rings: [&RingMotion<R>; 2],
        ball: &BallInSpace<R>,
    ) -> [Touch<R>; 2] {
        let groove = self.inner_at(rings[0].spin.dot(rings[0].axis));
        [
            groove.touch(rings[0], ball, self.radius, self.damping_time),
            (self.outer).touch(rings[1], ball, self.radius, self.damping_time),
        ]
    }
    /// Its two contacts.
    #[inline(always)]
    pub(super) fn between<L: TractionLaw<R>>(
        &self,
        law: &L,
        nodes: &[ContactNode<R>],
        rings: [&RingMotion<R>; 2],
        ball: &BallInSpace<R>,
    ) -> BetweenRaces<R> {
        let touch = self.touches(rings, ball);
        BetweenRaces {
            traction: traction(law, nodes, [&touch[0], &touch[1]]),
            touch,
        }
    }
}

impl<R: Real> Row<R> {
    pub(super) fn gather<'a>(machine: &dyn Fn(usize) -> &'a RowConstants) -> Self {
        let balls = Gather::<R>::gather(&|lane| &machine(lane).balls);
        let of_seat = |part: fn(f64) -> f64| {
            let one = |j: usize| R::splat(part(seat(j, balls)));
            (0..balls).map(one).collect()
        };
        let count = machine(0).nodes.len();
        let same = (1..R::LANES).all(|lane| machine(lane).nodes.len() == count);
        assert!(same, "lanes share the number of nodes");
        let node = |k: usize| gather_group::<R, _>(&|lane| &machine(lane).nodes[k]);
        Row {
            balls,
            ball: gather_group::<R, _>(&|lane| &machine(lane).ball),
            nodes: (0..count).map(node).collect(),
            traction: gather_group::<R, _>(&|lane| &machine(lane).traction),
            moment: MomentPairs::gather(&|lane| {
                let row = machine(lane);
                (row.ball.rolls(row.balls), row.moment.as_ref())
            }),
            cage: Gather::gather(&|lane| &machine(lane).cage.inertia),
            cage_drag: Gather::<R>::gather(&|lane| &machine(lane).cage.drag),
            guide: Gather::gather(&|lane| &machine(lane).cage.guide),
            seats: [of_seat(f64::cos), of_seat(f64::sin)],
        }
    }
    pub(super) fn is_tied(&self) -> bool {
        matches!(self.guide, CageGuide::Tied)
    }
    /// Writes the rates of the balls, whose states are these lists, between inner and outer ring.
    #[inline(always)]
    pub(super) fn react(
        &self,
        [inner, outer]: [&RigidBody<R>; 2],
        around: &Around<R::Group>,
        (state, rate): (&[R], &mut [R]),
        detail: Detail<'_, R>,
    ) -> RowReaction<R> {
        let (mut reaction, carried) = self.sum(around, (state, &mut *rate), detail);
        if let Some(pairs) = &self.moment {
            let speed = (inner.spin - outer.spin).dot(outer.axis);
            let resisted = R::vectorized(Resist {
                ball: &self.ball,
                balls: self.balls,
                pairs,
                around,
                turns: (speed, outer.axis),
                carried: &carried,
                state,
                rate,
            });
            reaction.on_inner.moment += resisted.on_inner;
            reaction.on_outer.add(resisted.on_outer);
            reaction.heats[7] = resisted.heat;
        }
        reaction
    }
    #[inline(always)]
    fn sum(
        &self,
        around: &Around<R::Group>,
        (state, rate): (&[R], &mut [R]),
        detail: Detail<'_, R>,
    ) -> (RowReaction<R>, [R; CARRIED]) {
        // the law is chosen once a call, not once a ball
        match &self.traction {
            Traction::Tanh(law) => self.by(law, around, (state, rate), detail),
            Traction::FourParameter(law) => self.by(law, around, (state, rate), detail),
            Traction::Dry(law) => self.by(law, around, (state, rate), detail),
            Traction::Lubricated(law) => self.by(law, around, (state, rate), detail),
            Traction::Algebraic(law) => self.by(law, around, (state, rate), detail),
        }
    }
    #[inline(always)]
    fn by<L: TractionLaw<R::Group>>(
        &self,
        law: &L,
        around: &Around<R::Group>,
        (state, rate): (&[R], &mut [R]),
        detail: Detail<'_, R>,
    ) -> (RowReaction<R>, [R; CARRIED]) {
        R::vectorized(Sum {
            row: self,
            law,
            around,
            state,
            rate,
            detail,
        })
    }
    #[inline(always)]
    fn place(
        &self,
        cage: &CageMotion<R::Group>,
        from: usize,
        ball: &BallInSpace<R::Group>,
    ) -> PocketPlace<R::Group> {
        let seat = [
            R::load_group(&self.seats[0], from),
            R::load_group(&self.seats[1], from),
        ];
        self.ball.pocket.place(cage, seat, ball, self.is_tied())
    }
}

/// What a steady moment must know of a row: the loads at its inner race along x, y, z and their sum, N, and the heat of spin and curvature
/// in its contacts, W.
pub(super) const CARRIED: usize = 5;

/// The pass over the balls.
struct Sum<'a, R: Real, L> {
    row: &'a Row<R>,
    law: &'a L,
    around: &'a Around<R::Group>,
    state: &'a [R],
    rate: &'a mut [R],
    detail: Detail<'a, R>,
}

impl<R: Real, L: TractionLaw<R::Group>> Vectorized for Sum<'_, R, L> {
    type Output = (RowReaction<R>, [R; CARRIED]);
    #[inline(always)]
    fn run(mut self) -> Self::Output {
        let Sum { row, around, .. } = self;
        let (n, law) = (row.balls, &row.ball);
        let states = lists(self.state, 0, n);
        let inverse_mass = law.mass.recip();
        let inverse_inertia =
            inverse_mass * (<R::Group as Real>::splat(0.4) * law.radius.square()).recip();
        let (mut on_inner, mut on_outer) = (BallSums::<R, 6>::new(n), BallSums::<R, 6>::new(n));
        let (mut on_cage, mut heats) = (BallSums::<R, 6>::new(n), BallSums::<R, 7>::new(n));
        let mut pocket_heats = BallSums::<R, 2>::new(n);
        let mut carried = BallSums::<R, CARRIED>::new(n);
        let ring = &around.inner;
        let growing = <R::Group as Real>::splat(2.0) * law.inner_growth * ring.spin.dot(ring.axis);
        let mut from = 0;
        while from < n {
            let ball = BallState::load(&states, from);
            let turned = Turned::to(ball.azimuth);
            let space = ball.in_space(turned);
            let rings = [&around.inner, &around.outer];
            let between = law.between(self.law, &row.nodes, rings, &space);
            let [t_i, t_o] = &between.touch;
            let [f_i, f_o] = &between.traction;
            let [mut on_ball, inner] = t_i.on_ball_and_ring(f_i);
            let [by_outer, outer] = t_o.on_ball_and_ring(f_o);
            on_ball.add(by_outer);

            let place = row.place(&around.cage, from, &space);
            let mut in_pocket = <R::Group as Real>::zero();
            if law.pocket.may_press(&place) {
                let p = law.pocket.react(&around.cage, &space, law.radius, &place);
                in_pocket = p.load.force;
                on_ball.add(p.on_ball);
                on_cage.add(from, &p.on_cage.to_array());
                pocket_heats.add(from, &[p.damping_heat, p.sliding_heat]);
            }

            let along = ball.radius * ball.orbit_speed;
            let mut force = turned.to_cylinder(on_ball.force * inverse_mass + law.gravity);
            let drag = law.orbit_drag * along;
            // the weight along the track, less the drag
            let outside = turned.to_cylinder(law.gravity).y * law.mass - drag;
            force.y -= drag * inverse_mass;
            let moment = turned.to_cylinder(on_ball.moment) - ball.spin * law.spin_drag;
            let rates = ball.rates(force, moment * inverse_inertia).to_array();
            let mut k = 0;
            while k < BALL_STATES {
                R::store_group(rates[k], &mut self.rate[k * n..(k + 1) * n], from);
                k += 1;
            }
            if row.moment.is_some() {
                let (push, load) = (t_i.push(), t_i.load.force);
                let turned = f_i.couple.dot(t_i.turning) + f_o.couple.dot(t_o.turning);
                carried.add(from, &[push.x, push.y, push.z, load, turned]);
            }
            on_inner.add(from, &inner.to_array());
            on_outer.add(from, &outer.to_array());
            heats.add(
                from,
                &[
                    (t_i.load.force - t_i.load.elastic) * t_i.closing,
                    (t_o.load.force - t_o.load.elastic) * t_o.closing,
                    f_i.heat,
                    f_o.heat,
                    drag * along + law.spin_drag * ball.spin.length_squared(),
                    ball.radius * outside - law.spin_drag * ball.spin.z,
                    -growing * t_i.load.elastic * t_i.triad.normal[0],
                ],
            );
            if !self.detail.list.is_empty() {
                let values = [
                    t_i.load.force,
                    t_o.load.force,
                    t_i.slip.y,
                    t_o.slip.y,
                    in_pocket,
                    f_i.force.y,
                    f_o.force.y,
                ];
                let Detail {
                    list,
                    before,
                    balls,
                } = &mut self.detail;
                let mut k = 0;
                while k < values.len() {
                    let first = k * *balls + *before;
                    R::store_group(values[k], &mut list[first..first + n], from);
                    k += 1;
                }
            }
            from += R::GROUP;
        }
        let [d_i, d_o, s_i, s_o, drag, external, growth_impulse] = heats.total();
        let [damping, friction] = pocket_heats.total();
        let reaction = RowReaction {
            on_inner: SpatialWrench::from_array(on_inner.total()),
            on_outer: SpatialWrench::from_array(on_outer.total()),
            on_cage: SpatialWrench::from_array(on_cage.total()),
            heats: [d_i, d_o, s_i, s_o, drag, damping, friction, R::zero()],
            external,
            growth_impulse,
        };
        (reaction, carried.total())
    }
}
