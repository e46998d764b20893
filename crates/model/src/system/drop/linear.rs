//! The Jacobian of a drop with a planar bearing, as an arrow.
//!
//! ```text
//!   border   rotor 6, inner race 6, outer race 4, cage 2 or 6, lubricant 0 or 3     blocks   five states a ball     tail   ledger
//! ```
//! Each ball is evaluated once over numbers with partials by its own five states and by the eleven of its neighbours; the
//! rest of the machine once over numbers with partials by the 18 of the border that turn or carry the balls.
//! Left out: the lubricant's own states, which change too slowly to need more than explicit steps; how the steady moment couples the balls through the sums of their loads, the rolling resistance of oil, what
//! follows from the place of a free cage, how neighbours without a cage press each other, the power of a growing race.

use super::layout::{BEARING, INNER, Layout, OUTER, ROTOR};
use super::rate::race_motion;
use super::{Drop, DropMachine, Mode};
use crate::bearing::ball::{BallMotion, BallReaction};
use crate::bearing::linear::{BallDual, LinearBall, NEIGHBOURS, STATES, channels};
use crate::bearing::{BearingConstants, BearingReaction, PlanarConstants};
use crate::motion::{Motion, Wrench};
use number::{Dual, Real, Vec2, Vectorized};
use solve::{Arrowhead, Linear, Shape};
use std::ops::Range;

/// Channels of the border with derivatives: everything before the place of a free cage and the balls.
const BORDER: usize = BEARING + 2;
/// Channel of the cage speed.
const CAGE_SPEED: usize = BEARING + 1;
/// The Jacobian of a drop.
type Arrow = Arrowhead<STATES, NEIGHBOURS, ACTED_ON>;
/// A number with its derivatives with respect to the border.
type BorderDual = Dual<BORDER>;

/// Number of border rows that balls act on.
const ACTED_ON: usize = 6;
/// Border rows that balls act on: velocities and spin of the inner race, velocities of the outer race, cage speed.
const ROWS: [usize; ACTED_ON] = [
    INNER + 2,
    INNER + 3,
    INNER + 5,
    OUTER + 2,
    OUTER + 3,
    CAGE_SPEED,
];
/// Border columns that balls depend on: all of both races but the angle of the inner one, and the cage.
const COLUMNS: [usize; NEIGHBOURS] = [
    INNER,
    INNER + 1,
    INNER + 2,
    INNER + 3,
    INNER + 5,
    OUTER,
    OUTER + 1,
    OUTER + 2,
    OUTER + 3,
    BEARING,
    CAGE_SPEED,
];

/// Tells the Jacobian of a drop.
#[derive(Clone, Debug)]
pub struct DropLinear {
    layout: Layout,
    bearing: PlanarConstants,
    ball: LinearBall,
    border: Drop<BorderDual>,
    /// 1/mass of the inner race, 0 where its centre is held, and 1/inertia of it.
    inner: (f64, f64),
    /// 1/mass that moves with the outer race.
    outer: f64,
    centre_held: bool,
    state: Vec<BorderDual>,
    rate: Vec<BorderDual>,
}

impl DropLinear {
    /// For a machine; none where its balls have no states of their own.
    pub fn of(machine: &DropMachine) -> Option<Self> {
        let constants = &machine.constants;
        let BearingConstants::Planar(bearing) = &constants.bearing else {
            return None;
        };
        let layout = *machine.layout();
        let m = &constants.machine;
        let inner_mass = if m.inner_race_centre_held {
            0.0
        } else {
            1.0 / m.inner_race_mass
        };
        Some(DropLinear {
            ball: LinearBall::of(bearing),
            border: Drop::of(&|_| constants, layout),
            inner: (inner_mass, 1.0 / m.inner_race_inertia),
            outer: 1.0 / constants.outer_moving_mass(),
            centre_held: m.inner_race_centre_held,
            state: vec![BorderDual::zero(); layout.dimension()],
            rate: vec![BorderDual::zero(); layout.dimension()],
            bearing: bearing.clone(),
            layout,
        })
    }
}

impl Linear<DropMachine, STATES, NEIGHBOURS, ACTED_ON> for DropLinear {
    fn shape(&self) -> Shape<STATES, NEIGHBOURS, ACTED_ON> {
        let n = self.layout.balls;
        Shape {
            border: (ROTOR..self.balls()).chain(self.lubricant()).collect(),
            blocks: (0..n)
                .map(|ball| channels(&self.bearing, ball).map(|own| BEARING + own))
                .collect(),
            tail: self.layout.ledger()..self.layout.dimension(),
            rows: ROWS,
            columns: COLUMNS,
        }
    }

    fn jacobian(&mut self, mode: &Mode<f64>, _time: f64, state: &[f64], into: &mut Arrow) {
        let races = race_motion(state);
        let own = &state[BEARING..self.layout.ledger()];
        let mut sum = Sum {
            reaction: BearingReaction::zero(),
            on_cage: BorderDual::zero(),
        };
        let this = &*self;
        (this.ball).react(&this.bearing, &races, own, &mut |ball, motion, reaction| {
            sum.add(reaction);
            this.ball_part(&races, ball, motion, reaction, into);
        });
        sum.drag_on_cage(self.bearing.cage_drag, state[CAGE_SPEED]);
        self.border_part(mode, state, &sum, into);
    }
}

impl DropLinear {
    /// First channel of the balls: as many of the border stand before them.
    fn balls(&self) -> usize {
        BEARING + self.bearing.first_ball_state()
    }
    /// Channels of the border behind the balls: of the lubricant, without derivatives.
    fn lubricant(&self) -> Range<usize> {
        BEARING + self.bearing.states()..self.layout.ledger()
    }

    /// Derivatives of the rates of the border and of the ledger with respect to the border, under the balls' reaction.
    fn border_part(&mut self, mode: &Mode<f64>, state: &[f64], sum: &Sum, into: &mut Arrow) {
        for (channel, (seeded, value)) in self.state.iter_mut().zip(state).enumerate() {
            *seeded = if channel < BORDER {
                BorderDual::variable(*value, channel)
            } else {
                BorderDual::splat(*value)
            };
        }
        let mode = Mode {
            levitation: BorderDual::splat(mode.levitation),
            brake: BorderDual::splat(mode.brake),
        };
        BorderDual::vectorized(Border {
            drop: &self.border,
            mode: &mode,
            state: &self.state,
            bearing: &sum.reaction,
            rate: &mut self.rate,
        });
        self.rate[BEARING] = self.state[CAGE_SPEED];
        let inverse_inertia = BorderDual::splat(1.0 / self.bearing.cage_inertia);
        self.rate[CAGE_SPEED] = sum.on_cage * inverse_inertia;
        let (balls, border) = (self.balls(), self.balls() + self.lubricant().len());
        let rows = into.corner.chunks_exact_mut(border);
        for (row, rate) in rows.zip(&self.rate[..BORDER]) {
            row[..BORDER].copy_from_slice(&rate.partial);
        }
        // a free cage moves with its speed; forces on its centre are taken explicitly
        for channel in BORDER..balls - (balls - BORDER) / 2 {
            into.corner[channel * border + channel + (balls - BORDER) / 2] = 1.0;
        }
        let ledger = &self.rate[self.layout.ledger()..];
        let columns = into.tail_border.chunks_exact_mut(ledger.len());
        for (channel, column) in columns.take(BORDER).enumerate() {
            for (value, rate) in column.iter_mut().zip(ledger) {
                *value = rate.partial[channel];
            }
        }
    }

    /// Derivatives of a ball's rates, and of what it makes elsewhere.
    fn ball_part(
        &self,
        races: &Motion<f64>,
        ball: usize,
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
        let block = &mut into.blocks[ball];
        own_partials(&mut block.own, &rates);
        for (row, rate) in block.right.iter_mut().zip(&rates) {
            row.copy_from_slice(&rate.partial[STATES..]);
        }
        let by = BallDual::splat;
        own_partials(
            &mut block.left,
            &[
                by(self.inner.0) * inner.force.x,
                by(self.inner.0) * inner.force.y,
                by(self.inner.1) * inner.moment,
                by(self.outer) * outer.force.x,
                by(self.outer) * outer.force.y,
                by(1.0 / self.bearing.cage_inertia) * r.on_cage,
            ],
        );
        let heat = &r.heat;
        let mut impulse = r.external_moment - outer.moment;
        if self.centre_held {
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
            for (value, heat) in column.iter_mut().zip(&made) {
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
    for (column, partial) in COLUMNS.iter().zip(&value.partial[STATES..]) {
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
    drop: &'a Drop<BorderDual>,
    mode: &'a Mode<BorderDual>,
    state: &'a [BorderDual],
    bearing: &'a BearingReaction<BorderDual>,
    rate: &'a mut [BorderDual],
}

impl Vectorized for Border<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        (self.drop).accelerate(self.mode, self.state, self.bearing, self.rate, &mut []);
    }
}
