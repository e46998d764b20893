//! Where a body stands in the state of its machine, and which freedoms it has.
//!
//! ```text
//!   centre in the plane    x y, ẋ ẏ
//!   turn about the axis    φ, Ω        after them
//!   in space               13 states of a rigid body, then its turned angle φ
//! ```
//! A body has a centre that moves, or a turn, or both: freedoms that it lacks have no channels. Axial motion and tilt are none that
//! a planar part asks for.

use crate::motion::Body;
use crate::spatial::part::SPIN;
use crate::spatial::part_states::{BODY_NAMES, orientation_scale};
use crate::spatial::rigid_body::{BODY_STATES, RigidBody};
use number::{Real, Vec2, Vectorized};
use std::ops::Range;

/// Where a body stands in the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BodyAt {
    first: usize,
    moves: bool,
    turns: bool,
    /// Channels from the position of its centre to the velocity.
    to_velocity: usize,
    /// The same to the angle and to the spin.
    to_angle: usize,
    to_spin: usize,
    in_space: bool,
}

impl BodyAt {
    /// A body whose centre moves and that turns, from a channel on.
    pub const fn free(first: usize) -> Self {
        BodyAt {
            first,
            moves: true,
            turns: true,
            to_velocity: 2,
            to_angle: 4,
            to_spin: 5,
            in_space: false,
        }
    }
    /// A body with all six freedoms.
    pub const fn in_space(first: usize) -> Self {
        BodyAt {
            to_velocity: 3,
            to_angle: BODY_STATES,
            to_spin: SPIN,
            in_space: true,
            ..Self::free(first)
        }
    }
    /// A body whose centre moves and that does not turn.
    pub const fn moving(first: usize) -> Self {
        BodyAt {
            turns: false,
            ..Self::free(first)
        }
    }
    /// A body that turns about a centre at rest.
    pub const fn turning(first: usize) -> Self {
        BodyAt {
            moves: false,
            to_angle: 0,
            to_spin: 1,
            ..Self::free(first)
        }
    }
    /// A body that neither moves nor turns: it has no channels.
    pub const STILL: Self = BodyAt {
        turns: false,
        ..Self::turning(0)
    };
    /// The same, taken as one that does not turn.
    pub const fn without_turn(self) -> Self {
        BodyAt {
            turns: false,
            ..self
        }
    }
    /// Its channels.
    #[inline(always)]
    pub const fn channels(self) -> Range<usize> {
        if self.in_space {
            return self.first..self.first + BODY_STATES + 1;
        }
        let count = if self.moves { 4 } else { 0 } + if self.turns { 2 } else { 0 };
        self.first..self.first + count
    }
    /// Channels of x and y of its centre.
    #[inline(always)]
    pub const fn centre(self) -> [usize; 2] {
        [self.first, self.first + 1]
    }
    /// Channel of its place along the axis, of a body with all six freedoms.
    #[inline(always)]
    pub const fn axial(self) -> usize {
        self.first + 2
    }
    /// Channels of their rates.
    #[inline(always)]
    pub const fn velocity(self) -> [usize; 2] {
        [
            self.first + self.to_velocity,
            self.first + self.to_velocity + 1,
        ]
    }
    /// Channel of its angle.
    #[inline(always)]
    pub const fn angle(self) -> usize {
        self.first + self.to_angle
    }
    /// Channel of its spin.
    #[inline(always)]
    pub const fn spin(self) -> usize {
        self.first + self.to_spin
    }
    /// Names of its channels, of a body of that name.
    pub fn names(self, body: &str) -> impl Iterator<Item = String> {
        let planar = !self.in_space;
        let centre = ["x", "y", "x_speed", "y_speed"].map(|name| (name, self.moves && planar));
        let turn = ["angle", "speed"].map(|name| (name, self.turns && planar));
        let space = BODY_NAMES.into_iter().chain(["angle"]);
        let names = centre
            .into_iter()
            .chain(turn)
            .chain(space.map(move |name| (name, !planar)));
        let body = body.to_string();
        let names = names.filter(|name| name.1);
        names.map(move |(name, _)| format!("{body}.{name}"))
    }
    /// Its states at rest, where they are not zero.
    pub fn rest(self, state: &mut [f64]) {
        if self.in_space {
            state[self.first + 6] = 1.0;
        }
    }
    /// Its motion in a state; what it has no freedom for is zero.
    #[inline(always)]
    pub fn motion<R: Real>(self, state: &[R]) -> Body<R> {
        if self.in_space {
            return R::vectorized(InSpace { at: self, state });
        }
        let mut body = Body::planar(Vec2::zero(), Vec2::zero(), R::zero(), R::zero());
        if self.moves {
            body.position = pair(state, self.centre());
            body.velocity = pair(state, self.velocity());
        }
        if self.turns {
            (body.angle, body.spin) = (state[self.angle()], state[self.spin()]);
        }
        body
    }
    /// Writes the rates of its centre, where that moves.
    #[inline(always)]
    pub fn move_at<R: Real>(self, rate: &mut [R], velocity: Vec2<R>, acceleration: Vec2<R>) {
        if self.moves {
            put(rate, self.centre(), velocity);
            put(rate, self.velocity(), acceleration);
        }
    }
    /// Writes the rates of its turn.
    #[inline(always)]
    pub fn turn_at<R: Real>(self, rate: &mut [R], spin: R, acceleration: R) {
        rate[self.angle()] = spin;
        rate[self.spin()] = acceleration;
    }
    /// Writes the magnitudes that matter: of lengths, m, speeds, m/s, and spins, rad/s; of angles 1 rad.
    pub fn error_scale(self, scale: &mut [f64], length: f64, speed: f64, spin: f64) {
        if self.moves {
            put(scale, self.centre(), Vec2::new(length, length));
            put(scale, self.velocity(), Vec2::new(speed, speed));
        }
        if self.turns {
            self.turn_at(scale, 1.0, spin);
        }
        if self.in_space {
            let body = &mut scale[self.channels()];
            (body[2], body[5]) = (length, speed);
            // tilt and its rate by what they do at a lever of 1 cm
            orientation_scale(body, 100.0 * length, 100.0 * speed);
        }
    }
}

/// The motion of a body in space, apart: few machines have one.
struct InSpace<'a, R> {
    at: BodyAt,
    state: &'a [R],
}

impl<R: Real> Vectorized for InSpace<'_, R> {
    type Output = Body<R>;
    #[inline(always)]
    fn run(self) -> Body<R> {
        let InSpace { at, state } = self;
        RigidBody::read(&state[at.first..]).seen(state[at.angle()])
    }
}

/// Two channels of a list.
#[inline(always)]
pub fn pair<R: Real>(list: &[R], at: [usize; 2]) -> Vec2<R> {
    Vec2::new(list[at[0]], list[at[1]])
}

/// Writes two channels of a list.
#[inline(always)]
pub fn put<R: Real>(list: &mut [R], at: [usize; 2], value: Vec2<R>) {
    (list[at[0]], list[at[1]]) = (value.x, value.y);
}
