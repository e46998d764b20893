//! The bearing ball by ball, in the plane.
//!
//! States: those of the cage, then those of the balls: see [`ball_states`](super::ball_states); then those of the
//! lubricant where it has any: see [`lubricant_state`].
//!
//! ```text
//!   I_c ω̇_c = Σ cage moments of the balls - c_c ω_c        ball j: see `ball`
//! ```
//! What keeps the balls apart is one of three: a cage centred on the outer race, with which its mass moves; a cage that
//! is free to move, see [`cage`]; or nothing but the balls, see [`full_complement`].
//! Drag to ground (c_d on the orbit, c_w on the spin, c_c on the cage) exists to reproduce reference cases; it is no
//! bearing friction moment. That is [`steady_moment`], and excludes it; without it the oil of lubricated
//! contacts resists rolling by [`inlet_couples`].
//!
//! Does not model: what a ball leaves out ([`ball`](super::ball)), films in pockets and lands, heat.

use super::ball::{PocketMotion, Slowing, gather_group};
use super::ball_states::{
    BallRow, OF_BALL, Places, distances, kept_distances, load_ball, race, seats, split, split_mut,
};
use super::ball_sums::{BallSums, largest_part};
use super::cage::{self, FreeCage};
use super::full_complement::{self, FullComplement};
use super::inlet_couples::{self, InletCouples};
use super::lubricant_state::{self, Lubricant, Warmed};
use super::planar_constants::{PlanarConstants, Separation};
use super::reaction::{BearingHeat, BearingReaction};
use super::steady_moment::{self, MomentPairs};
use super::tangents::{BallTangents, ENTRIES, KnownRates, ROWS, TangentConstants};
use crate::base::Masses;
use crate::motion::{Motion, Wrench};
use number::{Gather, Real, Vec2, Vectorized};
use physics::traction::{Traction, TractionLaw};

/// What keeps the balls apart, where it is more than a centred cage, over `R`.
#[derive(Clone, Debug)]
enum Apart<R: Real> {
    Centred,
    Free(FreeCage<R>),
    Neighbours(FullComplement<R>),
}

/// So many balls have room for the steady moment's forces without an allocation.
const FEW_BALLS: usize = 32;

/// The planar bearing over `R`.
#[derive(Clone, Debug)]
pub struct Planar<R: Real> {
    row: BallRow<R>,
    traction: Traction<R::Group>,
    cage_inverse_inertia: R,
    cage_drag: R,
    /// 2k: twice the growth of the inner track's radius with the square of its speed, m s²; none where it does not grow.
    twice_growth: Option<R>,
    moment: Option<MomentPairs<R>>,
    couples: Option<InletCouples<R>>,
    lubricant: Option<Lubricant<R>>,
    apart: Apart<R>,
    /// Angle of each pocket on the cage, rad.
    seats: Vec<R>,
    of_tangents: TangentConstants<R>,
}

impl<R: Real> Planar<R> {
    /// One bearing per lane.
    pub(crate) fn gather<'a>(machine: &dyn Fn(usize) -> &'a PlanarConstants) -> Self {
        let balls = Gather::<R>::gather(&|lane| &machine(lane).balls);
        Planar {
            row: BallRow {
                balls,
                first: machine(0).first_ball_state(),
                ball: machine(0)
                    .separation
                    .beyond_pockets(gather_group::<R, _>(&|lane| &machine(lane).ball)),
            },
            traction: gather_group::<R, _>(&|lane| &machine(lane).traction),
            cage_inverse_inertia: R::from_lanes(|lane| 1.0 / machine(lane).cage_inertia),
            cage_drag: R::from_lanes(|lane| machine(lane).cage_drag),
            twice_growth: (0..R::LANES)
                .any(|lane| machine(lane).ball.inner_track_growth != 0.0)
                .then(|| R::from_lanes(|lane| 2.0 * machine(lane).ball.inner_track_growth)),
            moment: MomentPairs::gather(&|lane| {
                let bearing = machine(lane);
                (bearing.geometry(), bearing.moment.as_ref())
            }),
            couples: InletCouples::gather(&|lane| machine(lane)),
            lubricant: Lubricant::gather(&|lane| machine(lane).lubricant.as_ref()),
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
            seats: seats(balls),
            of_tangents: TangentConstants::gather(machine),
        }
    }

    /// Reaction to the motion of the races; the load that is held besides theirs reaches the steady moment only.
    #[inline(always)]
    pub(crate) fn react(
        &self,
        motion: &Motion<R>,
        (held_load, looks): (R, bool),
        state: &[R],
        rate: &mut [R],
        detail: &mut [R],
    ) -> BearingReaction<R> {
        let of_lubricant = self.row.first + OF_BALL * self.row.balls;
        let factors = match &self.lubricant {
            None => None,
            Some(lubricant) => Some(R::vectorized(lubricant_state::Act {
                lubricant,
                state: &state[of_lubricant..],
            })),
        };
        R::vectorized(Places {
            row: &self.row,
            motion,
            state,
            rate,
        });
        // apart from the sum below: without a steady moment nothing is paid, and the code below stands once a law
        let (mut few, mut many);
        let mut slowing: &mut [R] = &mut [];
        let mut shared = None;
        if let Some(pairs) = &self.moment {
            slowing = if self.row.balls <= FEW_BALLS {
                few = [R::zero(); 2 * FEW_BALLS];
                &mut few[..2 * self.row.balls]
            } else {
                many = vec![R::zero(); 2 * self.row.balls];
                &mut many
            };
            shared = Some(R::vectorized(steady_moment::Share {
                row: &self.row,
                pairs,
                motion,
                held_load,
                drag_factor: match &factors {
                    Some(factors) => factors.drag,
                    None => R::one(),
                },
                state,
                kept: rate,
                slowing,
            }));
        }
        let sum = Sum {
            bearing: self,
            motion,
            state,
            slowing,
            rate,
            detail,
            looks,
        };
        let mut reaction = match factors {
            // the law is chosen once a call, not once a ball
            None => match &self.traction {
                Traction::Tanh(law) => sum.by(law),
                Traction::FourParameter(law) => sum.by(law),
                Traction::Dry(law) => sum.by(law),
                Traction::Lubricated(law) => sum.by(law),
                Traction::Algebraic(law) => sum.by(law),
            },
            // here once a ball: the code of the sum stands once for all laws
            Some(factors) => sum.by(&Warmed {
                law: &self.traction,
                factor: factors.traction.map(R::grouped),
            }),
        };
        if let Some(shared) = shared {
            shared.add_to(&mut reaction);
        }
        if let Some(couples) = &self.couples {
            R::vectorized(inlet_couples::Act {
                row: &self.row,
                couples,
                motion,
                state,
                rate,
                reaction: &mut reaction,
            });
        }
        if let Some(twice_growth) = self.twice_growth {
            let pressed = R::vectorized(InnerElastic {
                bearing: self,
                motion,
                state,
            });
            reaction.growth_impulse = twice_growth * motion.inner.spin * pressed;
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
        if let Some(lubricant) = &self.lubricant {
            R::vectorized(lubricant_state::Change {
                lubricant,
                cage_speed: state[1] - motion.outer.spin,
                film_heat: lubricant_state::film_heat(&reaction.heat),
                state: &state[of_lubricant..],
                rate: &mut rate[of_lubricant..],
            });
        }
        reaction
    }

    /// Takes the tangents of the balls at a state.
    #[inline(always)]
    pub fn tangents(&self, motion: &Motion<R>, state: &[R], into: &mut BallTangents<R>) {
        let (row, seats) = (&self.row, &self.seats[..]);
        match &self.lubricant {
            None => match &self.traction {
                Traction::Tanh(law) => into.take(row, seats, law, motion, state),
                Traction::FourParameter(law) => into.take(row, seats, law, motion, state),
                Traction::Dry(law) => into.take(row, seats, law, motion, state),
                Traction::Lubricated(law) => into.take(row, seats, law, motion, state),
                Traction::Algebraic(law) => into.take(row, seats, law, motion, state),
            },
            Some(lubricant) => {
                let factors = R::vectorized(lubricant_state::Act {
                    lubricant,
                    state: &state[self.row.first + OF_BALL * self.row.balls..],
                });
                let law = Warmed {
                    law: &self.traction,
                    factor: factors.traction.map(R::grouped),
                };
                into.take(row, seats, &law, motion, state);
            }
        }
    }

    /// Eliminates the balls at a diagonal G, given with 1/G: what they add to the border. See [`tangents`](super::tangents).
    #[inline(always)]
    pub fn factor(&self, tangents: &mut BallTangents<R>, g: [R; 2]) -> [R; ENTRIES] {
        tangents.factor(&self.row, &self.of_tangents, g)
    }
    /// Eliminates the balls from a right-hand side: what they add to that of the border.
    #[inline(always)]
    pub fn forward(
        &self,
        tangents: &BallTangents<R>,
        known: &KnownRates<R>,
        side: &mut [R],
    ) -> [R; ROWS] {
        tangents.forward(&self.row, &self.of_tangents, known, side)
    }
    /// The u of balls and cage from that of the border.
    #[inline(always)]
    pub fn back(&self, tangents: &BallTangents<R>, inverse_g: R, z: &[R; ROWS], side: &mut [R]) {
        tangents.back(&self.row, &self.of_tangents, inverse_g, z, side);
        let cage = z[5] * self.of_tangents.cage_radius[1];
        side[0] = (side[0] + cage) * inverse_g;
        side[1] = cage;
        // the place of a cage that is free to move, and the lubricant, have no tangents
        let place = (self.row.first - 2) / 2;
        for k in 2..2 + place {
            side[k + place] *= inverse_g;
            side[k] = (side[k] + side[k + place]) * inverse_g;
        }
        for own in &mut side[self.row.first + OF_BALL * self.row.balls..] {
            *own *= inverse_g;
        }
    }
    /// Changes of the heats of pocket damping and of pocket friction along a vector over the bearing's own states.
    #[inline(always)]
    pub fn heats_along(&self, tangents: &BallTangents<R>, vector: &[R]) -> [R; 2] {
        tangents.heats_along(&self.row, vector)
    }
    /// What its rows in a border are scaled by.
    pub fn border(&self) -> &TangentConstants<R> {
        &self.of_tangents
    }
    /// Number of balls.
    pub fn balls(&self) -> usize {
        self.row.balls
    }
    /// Its balls.
    pub(super) fn row(&self) -> &BallRow<R> {
        &self.row
    }
    /// Adds an acceleration of all bodies alike, m/s², to the rates of what keeps the balls apart, which turns all of them by so much,
    /// rad/s²; returns the masses that are not those of balls.
    #[inline(always)]
    pub(super) fn shake_apart(
        &self,
        by: Vec2<R>,
        turning: R,
        state: &[R],
        rate: &mut [R],
    ) -> Masses<R> {
        match &self.apart {
            Apart::Centred => Masses::none(),
            Apart::Free(cage) => cage.shake(by, state, rate),
            Apart::Neighbours(row) => {
                row.shake(turning, rate);
                Masses::none()
            }
        }
    }

    /// Sum of the elastic loads of all balls at the inner race, N.
    #[inline(always)]
    fn inner_elastic(&self, motion: &Motion<R>, state: &[R]) -> R {
        let n = self.row.balls;
        let lists = split(state, self.row.first, n);
        let (inner, outer) = (race(&motion.inner), race(&motion.outer));
        let mut sum = BallSums::<R, 1>::new(n);
        let mut from = 0;
        while from < n {
            let ball = load_ball(&lists, from);
            let places = distances(&inner, &outer, &ball);
            let between = self.row.ball.between(&inner, &outer, &ball, &places);
            sum.add(from, &[between.inner.normal.elastic]);
            from += R::GROUP;
        }
        sum.total()[0]
    }

    /// Rate of the angular momentum of balls and cage about the origin, N m, from the rates of their states.
    #[inline(always)]
    pub(crate) fn angular_momentum_rate(&self, state: &[R], rate: &[R]) -> R {
        let n = self.row.balls;
        let (lists, rates) = (
            split(state, self.row.first, n),
            split(rate, self.row.first, n),
        );
        let mut sum = BallSums::<R, 1>::new(n);
        let mut from = 0;
        while from < n {
            let (ball, change) = (load_ball(&lists, from), load_ball::<R>(&rates, from));
            let two = <R::Group as Real>::splat(2.0);
            let orbit = ball.radius.square() * change.orbit_speed
                + two * ball.radius * ball.radial_speed * ball.orbit_speed;
            let spin = change.spin / self.row.ball.inverse_inertia;
            sum.add(from, &[self.row.ball.mass * orbit + spin]);
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
    fn sum<L: TractionLaw<R::Group>>(&self, traction: &L, sum: Sum<'_, R>) -> BearingReaction<R> {
        let Sum {
            motion,
            state,
            slowing,
            rate,
            detail,
            looks,
            ..
        } = sum;
        let n = self.row.balls;
        let (cage_angle, cage_speed) = (state[0], state[1]);
        let lists = split(state, self.row.first, n);
        let (inner, outer) = (race(&motion.inner), race(&motion.outer));
        let mut largest = [<R::Group as Real>::zero(); 5];
        let mut sums = BallSums::<R, 15>::new(n);
        let mut from = 0;
        while from < n {
            let ball = load_ball(&lists, from);
            let pocket = PocketMotion {
                angle: cage_angle.grouped() + R::load_group(&self.seats, from),
                spin: cage_speed.grouped(),
            };
            let distances = kept_distances(&split(rate, self.row.first, n), from);
            let mut slowed = Slowing::none();
            if !slowing.is_empty() {
                slowed = Slowing {
                    drag: R::load_group(&slowing[..n], from),
                    couple: R::load_group(&slowing[n..], from),
                };
            }
            let around = (&inner, &outer, &pocket);
            let r = (self.row.ball).react(traction, around, &ball, &distances, &slowed);
            let [d_radius, d_radial_speed, d_azimuth, d_orbit_speed, d_spin] =
                split_mut(rate, self.row.first, n);
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
                ],
            );
            if looks {
                // a group repeats the last ball behind the end of the list: no harm to a maximum
                largest = [
                    largest[0].max(r.inner_load),
                    largest[1].max(r.outer_load),
                    largest[2].max(r.pocket_force),
                    largest[3].max(r.inner_slip * r.inner_slip * r.inner_load),
                    largest[4].max(r.outer_slip * r.outer_slip * r.outer_load),
                ];
                let details = [
                    r.inner_load,
                    r.outer_load,
                    r.inner_slip,
                    r.outer_slip,
                    r.pocket_force,
                    r.inner_traction,
                    r.outer_traction,
                ];
                for (list, value) in detail.chunks_exact_mut(n).zip(details) {
                    R::store_group(value, list, from);
                }
            }
            from += R::GROUP;
        }
        let mut of_all = [R::zero(); 5];
        if looks {
            for (own, largest) in of_all.iter_mut().zip(largest) {
                *own = largest_part::<R>(largest);
            }
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
            growth_impulse: R::zero(),
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
            largest_inner_load: of_all[0],
            largest_outer_load: of_all[1],
            largest_skids: [of_all[3], of_all[4]],
            largest_pocket_force: of_all[2],
            land_force: R::zero(),
        }
    }
}

/// The sum over the balls, whose directions and distances [`Places`] has left in the rates.
struct Sum<'a, R: Real> {
    bearing: &'a Planar<R>,
    motion: &'a Motion<R>,
    state: &'a [R],
    /// Drags and couples of the steady moment; empty where there is none.
    slowing: &'a [R],
    rate: &'a mut [R],
    detail: &'a mut [R],
    /// Whether somebody looks at the largest loads.
    looks: bool,
}

impl<R: Real> Sum<'_, R> {
    /// As a task of its own: it is compiled once for all systems, apart from their steps.
    #[inline(always)]
    fn by<L: TractionLaw<R::Group>>(self, traction: &L) -> BearingReaction<R> {
        R::vectorized(SumBy {
            traction,
            sum: self,
        })
    }
}

/// [`Planar::sum`] as a task.
struct SumBy<'a, R: Real, L> {
    traction: &'a L,
    sum: Sum<'a, R>,
}

impl<R: Real, L: TractionLaw<R::Group>> Vectorized for SumBy<'_, R, L> {
    type Output = BearingReaction<R>;
    #[inline(always)]
    fn run(self) -> BearingReaction<R> {
        self.sum.bearing.sum(self.traction, self.sum)
    }
}

/// [`Planar::inner_elastic`] as a task.
struct InnerElastic<'a, R: Real> {
    bearing: &'a Planar<R>,
    motion: &'a Motion<R>,
    state: &'a [R],
}

impl<R: Real> Vectorized for InnerElastic<'_, R> {
    type Output = R;
    #[inline(always)]
    fn run(self) -> R {
        self.bearing.inner_elastic(self.motion, self.state)
    }
}
