//! What is stiff in a machine, for linearly implicit steps: contacts of rotor and races, balls, mounts.
//!
//! ```text
//!   (G - A) u = R        positions follow their velocities: u_q = (R_q + u_v)/G;  a spring joins its damper: c* = c + k/G
//!
//!   border   rotor u_ẋ, u_ẏ, L u_ω; of each auxiliary bearing u_ẋi, u_ẏi, R_i u_ωi, u_ẋo, u_ẏo, R_p u_ωc
//!            G m on its diagonal, c* of the mount; six rows of each bearing from its balls: bearing::tangents
//!   rotor/race   normal     c* w wᵀ, w = (n, n·arm⊥/L, -n, 0)          n turns with the unbalance, by the known R_φ/G
//!                friction   τ w wᵀ,  w = (-t, -(a_j + arm × t)/L, t, a_i/R_i),  τ = N ∂μ/∂u
//! ```
//! L is the radius of the first bore: it makes the spin a speed. Every element acts on both of its bodies.
//!
//! Left out: levitation, brake, how rotor friction follows the load, how the contact's direction turns with the whirl.

use super::layout::ROTOR;
use super::rate::rotor_motion;
use super::{Machines, Mode, RotorMachine};
use crate::bearing::tangents::{BallTangents, KnownRates, ROWS};
use crate::bearing::{self, BearingConstants, Planar, Separation};
use number::{Mask, Real, Vec2};
use solve::Tangents;

/// What linearly implicit steps know of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// All that presses and rubs.
    All,
    /// All but what keeps the balls apart, pockets of a free cage, its land, neighbours: that bounds their steps as it
    /// does those of the explicit method.
    Races,
    /// Nothing: balls that roll have no states of their own.
    Nothing,
}

/// Rows of the rotor in the border.
const ROTOR_ROWS: usize = 3;
/// Heat of pocket damping among those of an auxiliary bearing; that of pocket friction follows.
const POCKET_HEAT: usize = bearing::POCKET_FRICTION - 1;
/// Heat of rotor/race damping among those of an auxiliary bearing; that of its friction follows.
const CONTACT_HEAT: usize = bearing::HEATS.len() + 1;

/// The tangents of a machine, and the factored border.
#[derive(Debug)]
pub struct Room<R: Real> {
    parts: Vec<Part<R>>,
    /// Lower triangle of the border row by row, then its factors L and D⁻¹.
    border: Vec<R>,
    /// Right-hand side of the border, then its u.
    side: Vec<R>,
    inverse_g: R,
}

/// Of one auxiliary bearing.
#[derive(Debug)]
struct Part<R: Real> {
    balls: BallTangents<R>,
    contact: Contact<R>,
}

/// Rotor and race where they touch. Directions over the rotor's rows, then those of the inner race.
#[derive(Clone, Copy, Debug)]
struct Contact<R> {
    /// Whether any lane touches; where none does, everything below is zero.
    touches: bool,
    normal: Vec2<R>,
    along_normal: [R; 6],
    along_slip: [R; 6],
    stiffness: R,
    damping: R,
    friction: R,
    /// Change of the normal force with the rotor's angle.
    turn: R,
    /// Changes of the heats of damping by ḋ, and of friction by the slip.
    heats: [R; 2],
}

impl<R: Real> Contact<R> {
    fn open() -> Self {
        let zero = R::zero();
        Contact {
            touches: false,
            normal: Vec2::zero(),
            along_normal: [zero; 6],
            along_slip: [zero; 6],
            stiffness: zero,
            damping: zero,
            friction: zero,
            turn: zero,
            heats: [zero; 2],
        }
    }
}

impl RotorMachine {
    /// How much of what is stiff here linearly implicit steps know.
    pub fn tangents(&self) -> Known {
        let bearings = self.constants.bearings.iter();
        bearings.fold(Known::All, |known, part| match &part.bearing {
            BearingConstants::Rolling(_) => Known::Nothing,
            BearingConstants::Planar(_) if known == Known::Nothing => known,
            BearingConstants::Planar(bearing) => match bearing.separation {
                Separation::CentredCage => known,
                Separation::FreeCage(_) | Separation::Neighbours(_) => Known::Races,
            },
        })
    }
}

impl<R: Real> Machines<R> {
    #[inline(always)]
    fn planar(&self, k: usize) -> &Planar<R> {
        match self.bearings[k].bearing.planar() {
            Some(bearing) => bearing,
            None => panic!("balls that roll take explicit steps"),
        }
    }
    /// The radius that makes the rotor's spin a speed.
    #[inline(always)]
    fn rotor_radius(&self) -> R {
        self.bearings[0].contact.bore_radius
    }
    fn border_rows(&self) -> usize {
        ROTOR_ROWS + ROWS * self.bearings.len()
    }

    /// The contact of rotor and race of a bearing at a state.
    #[inline(always)]
    fn contact_tangent(&self, k: usize, state: &[R]) -> Contact<R> {
        let zero = R::zero();
        let part = &self.bearings[k];
        let rotor = rotor_motion(state);
        let centre = self.rotor.geometric_centre(&rotor);
        let inner = self.layout.bearings[k].motion(state).inner;
        let reaction = part.contact.react(&centre, rotor.spin, &inner);
        if !reaction.penetration.greater(zero).any() {
            return Contact::open();
        }
        let tangent = part.contact.tangent(&reaction, &centre, &inner);
        let (n, t) = (tangent.normal, tangent.normal.turned());
        let inverse_l = self.inverse_rotor_radius;
        let [_, inverse_inner_radius] = self.planar(k).border().inner_radius;
        let around = n.dot(centre.arm.turned());
        let two = R::splat(2.0);
        Contact {
            touches: true,
            normal: n,
            along_normal: [n.x, n.y, around * inverse_l, -n.x, -n.y, zero],
            along_slip: [
                -t.x,
                -t.y,
                -((tangent.journal_arm + centre.arm.cross(t)) * inverse_l),
                t.x,
                t.y,
                tangent.bore_arm * inverse_inner_radius,
            ],
            stiffness: tangent.stiffness,
            damping: tangent.damping,
            friction: tangent.friction,
            turn: tangent.stiffness * around - tangent.damping * rotor.spin * n.dot(centre.arm),
            heats: [
                two * tangent.damping * reaction.penetration_speed,
                reaction.friction_force + tangent.friction * reaction.slip_speed,
            ],
        }
    }
}

/// Rows of rotor and inner race of a bearing in the border.
#[inline(always)]
fn touched(k: usize) -> [usize; 6] {
    let own = ROTOR_ROWS + ROWS * k;
    [0, 1, 2, own, own + 1, own + 2]
}

impl<R: Real> Tangents<R> for Machines<R> {
    type Room = Room<R>;

    fn room(&self) -> Room<R> {
        let rows = self.border_rows();
        let parts = (0..self.bearings.len()).map(|k| Part {
            balls: BallTangents::new(self.planar(k).balls()),
            contact: Contact::open(),
        });
        Room {
            parts: parts.collect(),
            border: vec![R::zero(); rows * rows],
            side: vec![R::zero(); rows],
            inverse_g: R::one(),
        }
    }

    fn at_points(&self) -> Vec<bool> {
        let mut at_points = vec![true; self.layout.ledger_length()];
        for at in &self.layout.bearings {
            at_points[at.heat + POCKET_HEAT..][..2].fill(false);
            at_points[at.heat + CONTACT_HEAT..][..2].fill(false);
        }
        at_points
    }

    #[inline(always)]
    fn take(&self, _mode: &Mode<R>, state: &[R], room: &mut Room<R>) {
        for k in 0..self.bearings.len() {
            let at = &self.layout.bearings[k];
            let part = &mut room.parts[k];
            let motion = at.motion(state);
            self.planar(k)
                .tangents(&motion, &state[at.own()], &mut part.balls);
            part.contact = self.contact_tangent(k, state);
        }
    }

    #[inline(always)]
    fn factor(&self, room: &mut Room<R>, g: R) {
        let n = self.border_rows();
        let inverse_g = g.recip();
        room.inverse_g = inverse_g;
        let Room { parts, border, .. } = room;
        for entry in border.iter_mut() {
            *entry = R::zero();
        }
        let rotor = &self.rotor;
        border[0] = g * rotor.mass;
        border[n + 1] = g * rotor.mass;
        border[2 * n + 2] = g * rotor.polar_inertia * self.inverse_rotor_radius.square();
        for (k, part) in parts.iter_mut().enumerate() {
            let own = ROTOR_ROWS + ROWS * k;
            let (auxiliary, planar) = (&self.bearings[k], self.planar(k));
            let entries = planar.factor(&mut part.balls, [g, inverse_g]);
            let mut entry = 0;
            for row in 0..ROWS {
                for column in row..ROWS {
                    border[(own + column) * n + own + row] = entries[entry];
                    entry += 1;
                }
            }
            let race = &auxiliary.inner_race;
            let scales = planar.border();
            let mount = auxiliary.mount.damping + auxiliary.mount.stiffness * inverse_g;
            let outer = g * auxiliary.outer_moving_mass + mount;
            let masses = [
                g * race.mass,
                g * race.mass,
                g * race.inertia * scales.inner_radius[1].square(),
                outer,
                outer,
                g * scales.cage_inertia * scales.cage_radius[1].square(),
            ];
            for (row, mass) in masses.into_iter().enumerate() {
                border[(own + row) * (n + 1)] += mass;
            }
            let contact = &part.contact;
            if contact.touches {
                let rows = touched(k);
                let damping = contact.damping + contact.stiffness * inverse_g;
                for i in 0..6 {
                    let of_normal = damping * contact.along_normal[i];
                    let of_slip = contact.friction * contact.along_slip[i];
                    for j in 0..=i {
                        border[rows[i] * n + rows[j]] +=
                            of_normal * contact.along_normal[j] + of_slip * contact.along_slip[j];
                    }
                }
            }
        }
        if rotor.spin_held {
            hold(border, n, 2);
        }
        for (k, part) in self.bearings.iter().enumerate() {
            if part.inner_race.centre_held {
                hold(border, n, ROTOR_ROWS + ROWS * k);
                hold(border, n, ROTOR_ROWS + ROWS * k + 1);
            }
        }
        factor(border, n);
    }

    #[inline(always)]
    fn solve(&self, room: &mut Room<R>, side: &mut [R]) {
        let n = self.border_rows();
        let Room {
            parts,
            border,
            side: of_border,
            inverse_g,
        } = room;
        let inverse_g = *inverse_g;
        let (l, inverse_l) = (self.rotor_radius(), self.inverse_rotor_radius);
        let rotor = &self.rotor;
        let pair = |side: &[R], at: usize| Vec2::new(side[at], side[at + 1]);
        of_border[0] = rotor.mass * side[ROTOR + 2];
        of_border[1] = rotor.mass * side[ROTOR + 3];
        of_border[2] = rotor.polar_inertia * side[ROTOR + 5] * inverse_l;
        for (k, part) in parts.iter_mut().enumerate() {
            let at = &self.layout.bearings[k];
            let (auxiliary, planar) = (&self.bearings[k], self.planar(k));
            let known = KnownRates {
                inner: pair(side, at.inner),
                outer: pair(side, at.outer),
                cage: side[at.bearing],
            };
            let of_balls = planar.forward(&part.balls, &known, &mut side[at.own()]);
            let race = &auxiliary.inner_race;
            let scales = planar.border();
            let outer = known.outer * (auxiliary.mount.stiffness * inverse_g);
            let own = [
                race.mass * side[at.inner + 2],
                race.mass * side[at.inner + 3],
                race.inertia * side[at.inner + 5] * scales.inner_radius[1],
                auxiliary.outer_moving_mass * side[at.outer + 2] - outer.x,
                auxiliary.outer_moving_mass * side[at.outer + 3] - outer.y,
                scales.cage_inertia * side[at.bearing + 1] * scales.cage_radius[1],
            ];
            for row in 0..ROWS {
                of_border[ROTOR_ROWS + ROWS * k + row] = own[row] + of_balls[row];
            }
            let contact = &part.contact;
            if contact.touches {
                let apart = pair(side, ROTOR) - known.inner;
                let q = (contact.stiffness * contact.normal.dot(apart)
                    + contact.turn * side[ROTOR + 4])
                    * inverse_g;
                let rows = touched(k);
                for i in 0..6 {
                    of_border[rows[i]] -= contact.along_normal[i] * q;
                }
            }
        }
        if rotor.spin_held {
            of_border[2] = side[ROTOR + 5] * inverse_g * l;
        }
        for (k, part) in self.bearings.iter().enumerate() {
            if part.inner_race.centre_held {
                let held = pair(side, self.layout.bearings[k].inner + 2) * inverse_g;
                of_border[ROTOR_ROWS + ROWS * k] = held.x;
                of_border[ROTOR_ROWS + ROWS * k + 1] = held.y;
            }
        }
        solve(border, n, of_border);
        follow(side, ROTOR, [of_border[0], of_border[1]], inverse_g);
        turn(side, ROTOR, of_border[2] * inverse_l, inverse_g);
        for (k, part) in parts.iter().enumerate() {
            let at = &self.layout.bearings[k];
            let planar = self.planar(k);
            let [_, inverse_inner_radius] = planar.border().inner_radius;
            let own = ROTOR_ROWS + ROWS * k;
            let mut z = [R::zero(); ROWS];
            z.copy_from_slice(&of_border[own..own + ROWS]);
            planar.back(&part.balls, inverse_g, &z, &mut side[at.own()]);
            follow(side, at.inner, [z[0], z[1]], inverse_g);
            turn(side, at.inner, z[2] * inverse_inner_radius, inverse_g);
            follow(side, at.outer, [z[3], z[4]], inverse_g);
        }
    }

    #[inline(always)]
    fn along(&self, room: &Room<R>, vector: &[R], rates: &mut [R]) {
        let l = self.rotor_radius();
        for (k, part) in room.parts.iter().enumerate() {
            let at = &self.layout.bearings[k];
            let planar = self.planar(k);
            let in_pockets = planar.heats_along(&part.balls, &vector[at.own()]);
            rates[at.heat + POCKET_HEAT] += in_pockets[0];
            rates[at.heat + POCKET_HEAT + 1] += in_pockets[1];
            let contact = &part.contact;
            if contact.touches {
                let [inner_radius, _] = planar.border().inner_radius;
                let z = [
                    vector[ROTOR + 2],
                    vector[ROTOR + 3],
                    vector[ROTOR + 5] * l,
                    vector[at.inner + 2],
                    vector[at.inner + 3],
                    vector[at.inner + 5] * inner_radius,
                ];
                let (mut closing, mut slip) = (R::zero(), R::zero());
                let along = contact.along_normal.iter().zip(&contact.along_slip);
                for ((normal, tangential), z) in along.zip(&z) {
                    closing += *normal * *z;
                    slip += *tangential * *z;
                }
                rates[at.heat + CONTACT_HEAT] += contact.heats[0] * closing;
                rates[at.heat + CONTACT_HEAT + 1] += contact.heats[1] * slip;
            }
        }
    }
}

/// u of a body's velocities, and of its position, whose right-hand sides stand there.
#[inline(always)]
fn follow<R: Real>(side: &mut [R], body: usize, velocity: [R; 2], inverse_g: R) {
    for i in 0..2 {
        side[body + i] = (side[body + i] + velocity[i]) * inverse_g;
        side[body + 2 + i] = velocity[i];
    }
}

/// u of a body's spin, and of its angle.
#[inline(always)]
fn turn<R: Real>(side: &mut [R], body: usize, spin: R, inverse_g: R) {
    side[body + 4] = (side[body + 4] + spin) * inverse_g;
    side[body + 5] = spin;
}

/// Takes a row that does not move out of the border.
#[inline(always)]
fn hold<R: Real>(border: &mut [R], n: usize, held: usize) {
    for other in 0..n {
        let (row, column) = (held.max(other), held.min(other));
        border[row * n + column] = R::zero();
    }
    border[held * (n + 1)] = R::one();
}

/// L D Lᵀ of a symmetric positive matrix in its lower triangle, without pivots; the reciprocals of D on the diagonal.
#[inline(always)]
fn factor<R: Real>(a: &mut [R], n: usize) {
    for k in 0..n {
        let inverse = a[k * (n + 1)].recip();
        for i in k + 1..n {
            let below = a[i * n + k];
            let factor = below * inverse;
            // the columns behind still hold the unscaled entries
            for j in k + 1..=i {
                a[i * n + j] -= factor * a[j * n + k];
            }
        }
        for i in k + 1..n {
            a[i * n + k] *= inverse;
        }
        a[k * (n + 1)] = inverse;
    }
}

/// Solves with those factors, in place.
#[inline(always)]
fn solve<R: Real>(a: &[R], n: usize, side: &mut [R]) {
    for i in 1..n {
        let mut value = side[i];
        for j in 0..i {
            value -= a[i * n + j] * side[j];
        }
        side[i] = value;
    }
    for i in 0..n {
        side[i] *= a[i * (n + 1)];
    }
    for i in (0..n).rev() {
        let mut value = side[i];
        for j in i + 1..n {
            value -= a[j * n + i] * side[j];
        }
        side[i] = value;
    }
}
