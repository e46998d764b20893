//! The states of a bearing in space as a part: their names, where they start, what matters in each.
//!
//! A cage for each row, 13 each; then the balls of each row, nine lists; then how far and how fast outer rings slide against a spring.

use super::assembly::SLIDING;
use super::ball::BALL_STATES;
use super::part::{SPIN, SpatialBearing};
use super::rigid_body::BODY_STATES;
use super::row::RowConstants;
use crate::bearing::seat;

/// Names of the states of a body in space.
pub const BODY_NAMES: [&str; BODY_STATES] = [
    "x",
    "y",
    "z",
    "x_speed",
    "y_speed",
    "z_speed",
    "orientation_w",
    "orientation_x",
    "orientation_y",
    "orientation_z",
    "x_spin",
    "y_spin",
    "speed",
];
const BALL_NAMES: [&str; BALL_STATES] = [
    "radius",
    "radial_speed",
    "azimuth",
    "orbit_speed",
    "z",
    "z_speed",
    "radial_spin",
    "tangential_spin",
    "spin",
];
const AZIMUTH: usize = 2;

impl SpatialBearing {
    /// Number of its own states.
    pub fn states(&self) -> usize {
        self.sliding_state() + if self.spring.is_some() { SLIDING } else { 0 }
    }
    /// The first of its own states of outer rings that slide against a spring: how far, m.
    pub fn sliding_state(&self) -> usize {
        BODY_STATES * self.rows.len() + BALL_STATES * self.balls()
    }
    /// Row of a ball, its place in it, and the first state of that row's balls.
    pub(super) fn place(&self, ball: usize) -> (&RowConstants, usize, usize) {
        let (mut first, mut left) = (BODY_STATES * self.rows.len(), ball);
        for row in &self.rows {
            if left < row.balls {
                return (row, left, first);
            }
            left -= row.balls;
            first += BALL_STATES * row.balls;
        }
        panic!("a bearing of {} balls has no ball {ball}", self.balls())
    }
    /// Channel of the azimuth of a ball among its own states.
    pub fn azimuth_channel(&self, ball: usize) -> usize {
        let (row, own, first) = self.place(ball);
        first + AZIMUTH * row.balls + own
    }
    /// Name of one of its states.
    pub fn state_name(&self, state: usize) -> String {
        let (row, of) = (state / BODY_STATES, state % BODY_STATES);
        if row < self.rows.len() {
            return match row {
                0 => format!("cage.{}", BODY_NAMES[of]),
                row => format!("cage_{}.{}", row + 1, BODY_NAMES[of]),
            };
        }
        if let Some(sliding) = state.checked_sub(self.sliding_state()) {
            return ["sliding_outer_race.z", "sliding_outer_race.z_speed"][sliding].into();
        }
        let (mut ball, mut left) = (0, state - BODY_STATES * self.rows.len());
        for row in &self.rows {
            if left < BALL_STATES * row.balls {
                ball += left % row.balls + 1;
                return format!("ball_{ball:02}.{}", BALL_NAMES[left / row.balls]);
            }
            left -= BALL_STATES * row.balls;
            ball += row.balls;
        }
        panic!("no state {state}")
    }
    /// Its own states at rest between concentric rings, with the preload of its rows.
    pub fn rest(&self, state: &mut [f64]) {
        state.fill(0.0);
        let (sine, cosine) = (0.5 * self.first_ball_angle).sin_cos();
        for (index, row) in self.rows.iter().enumerate() {
            let cage = &mut state[BODY_STATES * index..];
            let [_, axial] = row.ball.between_rings();
            (cage[2], cage[6], cage[9]) = (axial, cosine, sine);
        }
        let mut first = BODY_STATES * self.rows.len();
        for row in &self.rows {
            let [radius, axial] = row.ball.between_rings();
            for j in 0..row.balls {
                let azimuth = self.first_ball_angle + seat(j, row.balls);
                for (k, value) in [(0, radius), (AZIMUTH, azimuth), (4, axial)] {
                    state[first + k * row.balls + j] = value;
                }
            }
            first += BALL_STATES * row.balls;
        }
    }
    /// Changes the spins of cages, and orbits and spins of balls, by one factor.
    pub fn change_speeds(&self, state: &mut [f64], factor: f64) {
        for index in 0..self.rows.len() {
            state[BODY_STATES * index + SPIN] *= factor;
        }
        let mut first = BODY_STATES * self.rows.len();
        for row in &self.rows {
            for list in [AZIMUTH + 1, 6, 7, 8] {
                let speeds = &mut state[first + list * row.balls..][..row.balls];
                speeds.iter_mut().for_each(|speed| *speed *= factor);
            }
            first += BALL_STATES * row.balls;
        }
    }
    /// The magnitude that matters in each of its own states; `spin` is a speed of the inner ring, `speed` one of centres.
    pub fn error_scale(&self, scale: &mut [f64], spin: f64, speed: f64) {
        let radius = self.rows[0].ball.radius;
        for index in 0..self.rows.len() {
            let body = &mut scale[BODY_STATES * index..BODY_STATES * (index + 1)];
            orientation_scale(body, 1e-4, 0.01 * spin);
            body[..3].fill(1e-4 * radius);
            body[3..6].fill(speed);
            body[SPIN] = 0.01 * spin;
        }
        let mut first = BODY_STATES * self.rows.len();
        for row in &self.rows {
            let turning = spin * self.set.inner_track_radius / row.ball.radius;
            let of_list = [
                1e-4 * radius,
                speed,
                1.0,
                0.01 * spin,
                1e-4 * radius,
                speed,
                turning,
                turning,
                turning,
            ];
            for value in of_list {
                scale[first..first + row.balls].fill(value);
                first += row.balls;
            }
        }
        if self.spring.is_some() {
            (scale[first], scale[first + 1]) = (1e-4 * radius, speed);
        }
    }
}

/// The magnitude that matters in the orientation of a body: of its tilt, rad, and of the rate of that, rad/s; its turn counts whole.
pub fn orientation_scale(body: &mut [f64], tilt: f64, rate: f64) {
    body[6..10].copy_from_slice(&[1.0, tilt, tilt, 1.0]);
    body[10..12].fill(rate);
}
