//! The Jacobian of a machine with planar bearings, as an arrow.
//!
//! ```text
//!   border   rotor 6; races 10, cage 2 or 6, lubricant 0 or 3 of each bearing     blocks   five states a ball     tail   ledger
//! ```
//! Each ball is evaluated once over numbers with partials by its own five states and by the eleven of its neighbours; the
//! rest of the machine once a bearing over numbers with partials by the 18 around it: rotor, races, turn of the cage.
//! Left out: the lubricant's own states, which change too slowly to need more than explicit steps; how the steady moment couples the balls through the sums of their loads, the rolling resistance of oil, what
//! follows from the place of a free cage, how neighbours without a cage press each other, the power of a growing race.

use super::layout::{Layout, ROTOR, ROTOR_CHANNELS};
use super::rate::Reactions;
use super::{Machines, Mode, RotorMachine};
use crate::auxiliary_bearing::BearingAt;
use crate::bearing::ball::{BallMotion, BallReaction};
use crate::bearing::linear::{BallDual, LinearBall, NEIGHBOURS, STATES, channels};
use crate::bearing::{BearingConstants, BearingReaction, PlanarConstants};
use crate::motion::{Motion, Wrench};
use number::{Dual, Real, Vec2, Vectorized};
use solve::{Arrowhead, BlockShape, Linear, Shape};

/// Channels of both races of a bearing.
const RACES: usize = 10;
/// Channels of the border that the equations around one bearing depend on: rotor, its races, angle and speed of its cage.
const AROUND: usize = ROTOR_CHANNELS + RACES + 2;
/// The Jacobian of a machine.
type Arrow = Arrowhead<STATES, NEIGHBOURS, ACTED_ON>;
/// A number with its derivatives with respect to what is around one bearing.
type BorderDual = Dual<AROUND>;
/// Place of the cage speed among what is around a bearing.
const CAGE_SPEED: usize = ROTOR_CHANNELS + RACES + 1;

/// Number of border rows that a ball acts on.
const ACTED_ON: usize = 6;

/// Channels around a bearing, in the order of their derivatives.
fn around(at: &BearingAt) -> [usize; AROUND] {
    std::array::from_fn(|k| match k {
        k if k < ROTOR_CHANNELS => ROTOR + k,
        k if k < ROTOR_CHANNELS + 6 => at.inner + k - ROTOR_CHANNELS,
        k if k < ROTOR_CHANNELS + RACES => at.outer + k - ROTOR_CHANNELS - 6,
        k => at.bearing + k - ROTOR_CHANNELS - RACES,
    })
}
/// Channels that balls act on: velocities and spin of the inner race, velocities of the outer race, cage speed.
fn acted_on(at: &BearingAt) -> [usize; ACTED_ON] {
    let (i, o) = (at.inner, at.outer);
    [i + 2, i + 3, i + 5, o + 2, o + 3, at.bearing + 1]
}
/// Places among what is around a bearing that its balls depend on: all of both races but the angle of the inner one, and
/// the cage.
const SEEN: [usize; NEIGHBOURS] = [6, 7, 8, 9, 11, 12, 13, 14, 15, 16, 17];

/// Gives the Jacobian of a machine.
#[derive(Clone, Debug)]
pub struct MachineLinear {
    layout: Layout,
    /// Channels of the border, in its order.
    border: Vec<usize>,
    /// Place of a channel in the border; none of what does not stand in it.
    place: Vec<Option<usize>>,
    bearings: Vec<LinearBearing>,
    machine: Machines<BorderDual>,
    state: Vec<BorderDual>,
    rate: Vec<BorderDual>,
}

/// One bearing of it.
#[derive(Clone, Debug)]
struct LinearBearing {
    at: BearingAt,
    constants: PlanarConstants,
    ball: LinearBall,
    /// 1/mass of the inner race, 0 where its centre is held, and 1/inertia of it.
    inner: (f64, f64),
    /// 1/mass that moves with the outer race.
    outer: f64,
    centre_held: bool,
}

impl LinearBearing {
    /// First state of the balls among the bearing's own: as many of the border stand before them.
    fn balls(&self) -> usize {
        self.constants.first_ball_state()
    }
}

impl MachineLinear {
    /// For a machine; none where balls have no states of their own.
    pub fn of(machine: &RotorMachine) -> Option<Self> {
        let constants = &machine.constants;
        let layout = machine.layout().clone();
        let parts = layout.bearings.iter().zip(&constants.bearings);
        let bearings = parts.map(|(at, part)| {
            let BearingConstants::Planar(bearing) = &part.bearing else {
                return None;
            };
            let race = &part.inner_race;
            let inverse_mass = if race.centre_held {
                0.0
            } else {
                1.0 / race.mass
            };
            Some(LinearBearing {
                at: *at,
                ball: LinearBall::of(bearing),
                inner: (inverse_mass, 1.0 / race.inertia),
                outer: 1.0 / part.outer_moving_mass(),
                centre_held: race.centre_held,
                constants: bearing.clone(),
            })
        });
        let bearings: Vec<LinearBearing> = bearings.collect::<Option<_>>()?;
        // rotor and races, the cages, then the lubricants, which have no derivatives
        let mut border: Vec<usize> = (ROTOR..layout.bearings[0].bearing).collect();
        for bearing in &bearings {
            border.extend(bearing.at.bearing..bearing.at.bearing + bearing.balls());
        }
        for bearing in &bearings {
            border.extend(bearing.at.bearing + bearing.constants.states()..bearing.at.own().end);
        }
        let mut place = vec![None; layout.dimension()];
        for (k, channel) in border.iter().enumerate() {
            place[*channel] = Some(k);
        }
        Some(MachineLinear {
            border,
            place,
            machine: Machines::of(&|_| constants, layout.clone()),
            state: vec![BorderDual::zero(); layout.dimension()],
            rate: vec![BorderDual::zero(); layout.dimension()],
            bearings,
            layout,
        })
    }
    /// Place of a channel that stands in the border.
    fn place(&self, channel: usize) -> usize {
        self.place[channel].expect("a channel of the border")
    }
}

impl Linear<RotorMachine, STATES, NEIGHBOURS, ACTED_ON> for MachineLinear {
    fn shape(&self) -> Shape<STATES, NEIGHBOURS, ACTED_ON> {
        let mut blocks = Vec::new();
        for bearing in &self.bearings {
            let at = &bearing.at;
            let around = around(at);
            let rows = acted_on(at).map(|channel| self.place(channel));
            let columns = SEEN.map(|k| self.place(around[k]));
            blocks.extend((0..at.balls).map(|ball| BlockShape {
                channels: channels(&bearing.constants, ball).map(|own| at.bearing + own),
                rows,
                columns,
            }));
        }
        Shape {
            border: self.border.clone(),
            blocks,
            tail: self.layout.ledger()..self.layout.dimension(),
        }
    }

    fn jacobian(&mut self, mode: &Mode<f64>, _time: f64, state: &[f64], into: &mut Arrow) {
        let mut first = 0;
        for k in 0..self.bearings.len() {
            let bearing = &self.bearings[k];
            let at = &bearing.at;
            let races = at.motion(state);
            let mut sum = Sum {
                reaction: BearingReaction::zero(),
                on_cage: BorderDual::zero(),
            };
            let this = &*self;
            bearing.ball.react(
                &bearing.constants,
                &races,
                &state[at.own()],
                &mut |ball, motion, reaction| {
                    sum.add(reaction);
                    this.ball_part(bearing, &races, first + ball, motion, reaction, into);
                },
            );
            first += at.balls;
            sum.drag_on_cage(bearing.constants.cage_drag, state[at.bearing + 1]);
            self.border_part(mode, state, k, &sum, into);
        }
    }
}

impl MachineLinear {
    /// Derivatives of the rates of the border and of the ledger with respect to what is around a bearing, under the reaction
    /// of its balls. What the balls of the others do depends on nothing around this one.
    fn border_part(
        &mut self,
        mode: &Mode<f64>,
        state: &[f64],
        k: usize,
        sum: &Sum,
        into: &mut Arrow,
    ) {
        let bearing = &self.bearings[k];
        let (at, balls) = (bearing.at, bearing.balls());
        let inverse_inertia = 1.0 / bearing.constants.cage_inertia;
        let around = around(&at);
        for (seeded, value) in self.state.iter_mut().zip(state) {
            *seeded = BorderDual::splat(*value);
        }
        for (seed, channel) in around.into_iter().enumerate() {
            self.state[channel] = BorderDual::variable(state[channel], seed);
        }
        let mode = Mode {
            levitation: BorderDual::splat(mode.levitation),
            brake: BorderDual::splat(mode.brake),
        };
        BorderDual::vectorized(Border {
            machine: &self.machine,
            mode: &mode,
            state: &self.state,
            bearing: k,
            reaction: &sum.reaction,
            rate: &mut self.rate,
        });
        self.rate[at.bearing] = self.state[at.bearing + 1];
        self.rate[at.bearing + 1] = sum.on_cage * BorderDual::splat(inverse_inertia);
        let border = self.border.len();
        for row in around {
            let into = &mut into.corner[self.place(row) * border..][..border];
            for (partial, column) in self.rate[row].partial.iter().zip(around) {
                into[self.place(column)] = *partial;
            }
        }
        // a free cage moves with its speed; forces on its centre are taken explicitly
        let free = (balls - 2) / 2;
        for channel in at.bearing + 2..at.bearing + 2 + free {
            into.corner[self.place(channel) * border + self.place(channel + free)] = 1.0;
        }
        let ledger = &self.rate[self.layout.ledger()..];
        for (seed, channel) in around.into_iter().enumerate() {
            let column = &mut into.tail_border[self.place(channel) * ledger.len()..];
            for (value, rate) in column.iter_mut().zip(ledger) {
                *value = rate.partial[seed];
            }
        }
    }

    /// Derivatives of a ball's rates, and of what it makes elsewhere.
    fn ball_part(
        &self,
        bearing: &LinearBearing,
        races: &Motion<f64>,
        block: usize,
        motion: &BallMotion<BallDual>,
        r: &BallReaction<BallDual>,
        into: &mut Arrow,
    ) {
        let (inner, outer) = (&r.on_inner, &r.on_outer);
        let rates = [
            motion.radial_speed,
            r.acceleration.radial,
            motion.orbit_speed,
            r.acceleration.orbit,
            r.acceleration.spin,
        ];
        let block = &mut into.blocks[block];
        own_partials(&mut block.own, &rates);
        for (row, rate) in block.right.iter_mut().zip(&rates) {
            row.copy_from_slice(&rate.partial[STATES..]);
        }
        let by = BallDual::splat;
        own_partials(
            &mut block.left,
            &[
                by(bearing.inner.0) * inner.force.x,
                by(bearing.inner.0) * inner.force.y,
                by(bearing.inner.1) * inner.moment,
                by(bearing.outer) * outer.force.x,
                by(bearing.outer) * outer.force.y,
                by(1.0 / bearing.constants.cage_inertia) * r.on_cage,
            ],
        );
        let heat = &r.heat;
        let mut impulse = r.external_moment - outer.moment;
        if bearing.centre_held {
            let centre = races.inner.position;
            impulse -= Vec2::new(by(centre.x), by(centre.y)).cross(inner.force);
        }
        let made = [
            heat.inner_damping,
            heat.outer_damping,
            heat.inner_sliding,
            heat.outer_sliding,
            heat.drag,
            heat.pocket_damping,
            heat.pocket_sliding,
        ];
        let last = self.layout.angular_impulse() - self.layout.ledger();
        for (channel, column) in block.tail.iter_mut().enumerate() {
            for (value, heat) in column[bearing.at.heat..].iter_mut().zip(&made) {
                *value = heat.partial[channel];
            }
            column[last] = impulse.partial[channel];
        }
    }
}

/// Writes the derivatives with respect to the ball's own states, row by row.
fn own_partials(rows: &mut [[f64; STATES]], rates: &[BallDual]) {
    for (row, rate) in rows.iter_mut().zip(rates) {
        row.copy_from_slice(&rate.partial[..STATES]);
    }
}

/// A ball's number over the border: its derivatives with respect to the neighbours.
#[inline(always)]
fn over_border(value: BallDual) -> BorderDual {
    let mut wide = BorderDual::splat(value.value);
    for (column, partial) in SEEN.iter().zip(&value.partial[STATES..]) {
        wide.partial[*column] = *partial;
    }
    wide
}

/// What all balls do to the border.
struct Sum {
    reaction: BearingReaction<BorderDual>,
    on_cage: BorderDual,
}

impl Sum {
    /// Adds a ball's reaction.
    fn add(&mut self, ball: &BallReaction<BallDual>) {
        let wrench = |w: &Wrench<BallDual>| {
            Wrench::planar(
                Vec2::new(over_border(w.force.x), over_border(w.force.y)),
                over_border(w.moment),
            )
        };
        let sum = &mut self.reaction;
        sum.on_inner += wrench(&ball.on_inner);
        sum.on_outer += wrench(&ball.on_outer);
        sum.external_moment += over_border(ball.external_moment);
        let (heat, made) = (&mut sum.heat, &ball.heat);
        heat.inner_damping += over_border(made.inner_damping);
        heat.outer_damping += over_border(made.outer_damping);
        heat.inner_sliding += over_border(made.inner_sliding);
        heat.outer_sliding += over_border(made.outer_sliding);
        heat.drag += over_border(made.drag);
        heat.pocket_damping += over_border(made.pocket_damping);
        heat.pocket_sliding += over_border(made.pocket_sliding);
        self.on_cage += over_border(ball.on_cage);
    }
    /// Adds the drag of the cage to ground.
    fn drag_on_cage(&mut self, drag: f64, speed: f64) {
        let speed = BorderDual::variable(speed, CAGE_SPEED);
        let moment = BorderDual::splat(drag) * speed;
        self.on_cage -= moment;
        self.reaction.external_moment -= moment;
        self.reaction.heat.drag += moment * speed;
    }
}

/// The rates of the border as a task, for the vector unit.
struct Border<'a> {
    machine: &'a Machines<BorderDual>,
    mode: &'a Mode<BorderDual>,
    state: &'a [BorderDual],
    bearing: usize,
    reaction: &'a BearingReaction<BorderDual>,
    rate: &'a mut [BorderDual],
}

impl Vectorized for Border<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let given = Given {
            bearing: self.bearing,
            reaction: self.reaction,
        };
        (self.machine).accelerate(self.mode, self.state, self.rate, &mut [], &given);
    }
}

/// A reaction of one bearing that is known; the others do nothing.
struct Given<'a> {
    bearing: usize,
    reaction: &'a BearingReaction<BorderDual>,
}

impl Reactions<BorderDual> for Given<'_> {
    #[inline(always)]
    fn reaction(
        &self,
        k: usize,
        _: &mut [BorderDual],
        _: &mut [BorderDual],
    ) -> BearingReaction<BorderDual> {
        if k == self.bearing {
            *self.reaction
        } else {
            BearingReaction::zero()
        }
    }
}
