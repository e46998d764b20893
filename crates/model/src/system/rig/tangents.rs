//! What is stiff in a rig without clutch and housing, for linearly implicit steps: balls, and the rotor that slides in the bore.
//!
//! ```text
//!   (G - A) u = R        positions follow their velocities: u_q = (R_q + u_v)/G
//!
//!   border   R_0 u_ω of the rotor, then u_ẋ, u_ẏ, R_i u_Ω of the inner race, two of the outer race, which stands, R_p u_ωc
//!            G m on its diagonal; six rows from the balls: bearing::tangents
//!   rotor/race friction   τ w wᵀ,  w = (1, ..., -R_0/R_i, ...),  τ = W ∂μ/∂u
//! ```
//! Left out: how the friction of the rotor pushes the race aside, the loss of accelerated balls where it is given.

use super::drive::{Drive, DriveOver};
use super::layout::{INNER, ROTOR};
use super::machine::{Rig, RigMachine};
use super::mode::Mode;
use crate::bearing::tangents::{BallTangents, Known, KnownRates, ROWS};
use crate::bearing::{self, Planar};
use crate::body::pair;
use crate::system::border::{add_bearing, factor, follow, hold, solve, turn};
use number::{Real, Vec2};
use solve::Tangents;

/// Rows of the border: the rotor, then the bearing.
const BORDER: usize = 1 + ROWS;
/// Heat of pocket damping among those of the bearing; that of pocket friction follows.
const POCKET_HEAT: usize = bearing::POCKET_FRICTION - 1;

/// The tangents, and the factored border.
#[derive(Debug)]
pub struct Room<R: Real> {
    balls: BallTangents<R>,
    /// τ of the sliding rotor, N s/m.
    friction: R,
    /// Lower triangle of the border row by row, then its factors L and D⁻¹.
    border: [R; BORDER * BORDER],
    inverse_g: R,
}

impl RigMachine {
    /// How much of what is stiff here linearly implicit steps know: nothing with a clutch or a housing.
    pub fn tangents(&self) -> Known {
        match (&self.constants.drive, &self.constants.housing) {
            (Drive::Clutch(_), _) | (_, Some(_)) => Known::Nothing,
            (_, None) => self.constants.bearing.tangents(),
        }
    }
}

impl<R: Real> Rig<R> {
    #[inline(always)]
    fn planar(&self) -> &Planar<R> {
        match (&self.drive, &self.housing, self.bearing.planar()) {
            (DriveOver::Clutch(_), ..) | (_, Some(_), _) => {
                panic!("a clutch and a housing take explicit steps")
            }
            (_, None, Some(bearing)) => bearing,
            (_, None, None) => panic!("balls that roll take explicit steps"),
        }
    }
    /// Arm of the sliding rotor, inertia of the rotor, whether its spin is held.
    #[inline(always)]
    fn rotor_row(&self) -> (R, R, bool) {
        match &self.drive {
            DriveOver::SlidingRotor(rotor) => {
                (rotor.bore_radius, rotor.polar_inertia, rotor.spin_held)
            }
            _ => (R::one(), R::one(), true),
        }
    }
    /// Rows that do not answer: their speeds are given.
    #[inline(always)]
    fn held(&self) -> [bool; BORDER] {
        let centre = self.race.centre_held;
        let speed = matches!(self.drive, DriveOver::Speed);
        [self.rotor_row().2, centre, centre, speed, true, true, false]
    }
}

impl<R: Real> Tangents<R> for Rig<R> {
    type Room = Room<R>;

    fn room(&self) -> Room<R> {
        Room {
            balls: BallTangents::new(self.planar().balls()),
            friction: R::zero(),
            border: [R::zero(); BORDER * BORDER],
            inverse_g: R::one(),
        }
    }

    fn at_points(&self) -> Vec<bool> {
        let mut at_points = vec![true; self.layout.ledger_length()];
        at_points[POCKET_HEAT..][..2].fill(false);
        at_points
    }

    #[inline(always)]
    fn take(&self, mode: &Mode<R>, time: R, state: &[R], room: &mut Room<R>) {
        let motion = self.layout.motion(state);
        let own = &state[self.layout.bearing()];
        self.planar().tangents(&motion, own, &mut room.balls);
        if let DriveOver::SlidingRotor(rotor) = &self.drive {
            let slip = rotor.bore_radius * (state[ROTOR.spin()] - motion.inner.spin);
            let saturation = (slip * rotor.inverse_reference_speed).tanh();
            let slope =
                rotor.friction * rotor.inverse_reference_speed * (R::one() - saturation.square());
            room.friction = slope * mode.load.at(time);
        }
    }

    #[inline(always)]
    fn factor(&self, room: &mut Room<R>, g: R) {
        room.inverse_g = g.recip();
        let planar = self.planar();
        let entries = planar.factor(&mut room.balls, [g, room.inverse_g]);
        let n = BORDER;
        let border = &mut room.border;
        for entry in border.iter_mut() {
            *entry = R::zero();
        }
        add_bearing(border, n, 1, &entries);
        let scales = planar.border();
        let (arm, rotor_inertia, _) = self.rotor_row();
        let inertia = self.race.inertia * scales.inner_radius[1].square();
        let cage = scales.cage_inertia * scales.cage_radius[1].square();
        let (zero, mass) = (R::zero(), self.race.mass);
        let rotor = rotor_inertia / arm.square();
        let masses = [rotor, mass, mass, inertia, zero, zero, cage];
        for (row, mass) in masses.into_iter().enumerate() {
            border[row * (n + 1)] += g * mass;
        }
        let spin = 1 + 2;
        let per_race = arm * scales.inner_radius[1];
        border[0] += room.friction;
        border[spin * n] -= room.friction * per_race;
        border[spin * (n + 1)] += room.friction * per_race.square();
        for (row, held) in self.held().into_iter().enumerate() {
            if held {
                hold(border, n, row);
            }
        }
        factor(border, n);
    }

    #[inline(always)]
    fn solve(&self, room: &mut Room<R>, side: &mut [R]) {
        let planar = self.planar();
        let inverse_g = room.inverse_g;
        let own = self.layout.bearing();
        let known = KnownRates {
            inner: pair(side, INNER.centre()),
            outer: Vec2::zero(),
            cage: side[own.start],
        };
        let of_cage = side[own.start + 1];
        let of_balls = planar.forward(&room.balls, &known, &mut side[own.clone()]);
        let scales = planar.border();
        let (arm, rotor_inertia, _) = self.rotor_row();
        let [inner_radius, inverse_inner_radius] = scales.inner_radius;
        let race = &self.race;
        let zero = R::zero();
        let mut of_border = [
            rotor_inertia * side[ROTOR.spin()] / arm,
            race.mass * side[INNER.velocity()[0]] + of_balls[0],
            race.mass * side[INNER.velocity()[1]] + of_balls[1],
            race.inertia * side[INNER.spin()] * inverse_inner_radius + of_balls[2],
            zero,
            zero,
            scales.cage_inertia * of_cage * scales.cage_radius[1] + of_balls[5],
        ];
        let given = [
            side[ROTOR.spin()] * arm,
            side[INNER.velocity()[0]],
            side[INNER.velocity()[1]],
            side[INNER.spin()] * inner_radius,
            zero,
            zero,
            zero,
        ];
        let rows = of_border.iter_mut().zip(given).zip(self.held());
        for ((row, given), held) in rows {
            if held {
                *row = given * inverse_g;
            }
        }
        solve(&room.border, BORDER, &mut of_border);
        let [rotor, x, y, spin, outer_x, outer_y, cage] = of_border;
        turn(side, ROTOR.angle(), rotor / arm, inverse_g);
        let z = [x, y, spin, outer_x, outer_y, cage];
        planar.back(&room.balls, inverse_g, &z, &mut side[own]);
        follow(side, INNER, [x, y], inverse_g);
        turn(side, INNER.angle(), spin * inverse_inner_radius, inverse_g);
    }

    #[inline(always)]
    fn along(&self, room: &Room<R>, vector: &[R], rates: &mut [R]) {
        let own = &vector[self.layout.bearing()];
        let in_pockets = self.planar().heats_along(&room.balls, own);
        rates[POCKET_HEAT] += in_pockets[0];
        rates[POCKET_HEAT + 1] += in_pockets[1];
    }
}
