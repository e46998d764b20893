//! What is stiff in a machine, for linearly implicit steps: contacts of rotor and races, balls, mounts.
//!
//! ```text
//!   (G - A) u = R        positions follow their velocities: u_q = (R_q + u_v)/G;  a spring joins its damper: c* = c + k/G
//!
//!   border   rotor: see rotor_rows, then L u_ω; of each auxiliary bearing u_ẋi, u_ẏi, R_i u_ωi, u_ẋo, u_ẏo, R_p u_ωc
//!            G m on its diagonal, c* of the mount; six rows of each bearing from its balls: bearing::tangents
//!            of n equal rows every term counts n times
//!   rotor/race   normal     c* w wᵀ, w = (n, n·arm⊥/L, -n, 0)          n turns with the unbalance, by the known R_φ/G
//!                friction   τ w wᵀ,  w = (-t, -(a_j + arm × t)/L, t, a_i/R_i),  τ = N ∂μ/∂u
//! ```
//! On a rig without clutch and housing the sliding rotor has one row, that of its spin, and the contact friction alone, τ = W ∂μ/∂u; races that
//! are held, and a speed that is given, are rows that do not answer.
//!
//! w over the node's velocity, spin and race. L is the radius of the first bore: it makes the spin a speed. Every element acts on
//! both of its bodies.
//!
//! Left out: how the friction of a sliding rotor pushes the race aside, levitation, magnets, seals, gyroscopic moments, what damping and spin do from one coordinate to another, drive, drag, brake, how rotor friction follows the load, how the contact's direction turns with the whirl.

use super::rotor_rows::RotorRows;
use super::{Machines, Mode, RotorMachine};
use crate::bearing::tangents::{BallTangents, Known, KnownRates, ROWS};
use crate::bearing::{self, Planar};
use crate::body::pair;
use crate::rotor::RotorMotion;
use crate::system::border::{add_bearing, factor, follow, hold, solve, turn};
use crate::system::rig::Drive;
use number::{Mask, Real, Vec2};
use solve::Tangents;

/// Heat of pocket damping among those of an auxiliary bearing; that of pocket friction follows.
const POCKET_HEAT: usize = bearing::POCKET_FRICTION - 1;
/// Heat of rotor/race damping among those of an auxiliary bearing; that of its friction follows.
const CONTACT_HEAT: usize = bearing::HEATS.len() + 1;

/// The tangents of a machine, and the factored border.
#[derive(Debug)]
pub struct Room<R: Real> {
    parts: Vec<Part<R>>,
    rotor: RotorRows<R>,
    /// Directions of a contact over the rows that it touches.
    along: [Vec<R>; 2],
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

/// Rotor and race where they touch. Directions over the node, the spin, and the rows of the inner race.
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
        if self.controlled() {
            return Known::NotControllers;
        }
        if (self.fixture()).is_some_and(|own| own.housing.is_some()) || self.clutch().is_some() {
            return Known::Nothing;
        }
        let bearings = self.constants.bearings.iter();
        let each = bearings.map(|part| match part.bearing.tangents() {
            known if known < Known::Nothing && part.mount_parts.any() => Known::NotMounts,
            known => known,
        });
        each.max().unwrap_or(Known::All)
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
    /// What of the spin and of the centre of the inner race, and of the centre of the outer one does not answer.
    #[inline(always)]
    fn held(&self, k: usize) -> [bool; 3] {
        let part = &self.bearings[k];
        let fixture = part.fixture.as_ref();
        let given = fixture.is_some_and(|fixture| matches!(fixture.own.drive, Drive::Speed(_)));
        [given, part.inner_race.centre_held, part.outer_held]
    }
    /// The friction of a rotor that slides in the bore of a rig.
    #[inline(always)]
    fn sliding_tangent(&self, mode: &Mode<R>, time: R, [rotor, race]: [R; 2]) -> Contact<R> {
        let (zero, one) = (R::zero(), R::one());
        let bore = &self.bearings[0].contact;
        let fixture = self.bearings[0].fixture.as_ref();
        if !fixture.is_some_and(|fixture| matches!(fixture.own.drive, Drive::SlidingRotor(_))) {
            return Contact::open();
        }
        let slip = bore.bore_radius * (rotor - race);
        let saturation = (slip * bore.inverse_reference_speed).tanh();
        let slope = bore.friction * bore.inverse_reference_speed * (one - saturation.square());
        let [_, inverse_inner_radius] = self.planar(0).border().inner_radius;
        let per_race = bore.bore_radius * inverse_inner_radius;
        Contact {
            touches: true,
            along_slip: [zero, zero, -one, zero, zero, per_race],
            friction: slope * mode.load.at(time),
            ..Contact::open()
        }
    }
    /// The radius that makes the rotor's spin a speed.
    #[inline(always)]
    fn rotor_radius(&self) -> R {
        self.bearings[0].contact.bore_radius
    }

    /// The contact of rotor and race of a bearing at a state.
    #[inline(always)]
    fn contact_tangent(&self, k: usize, rotor: &RotorMotion<R>, state: &[R]) -> Contact<R> {
        let zero = R::zero();
        let part = &self.bearings[k];
        let centre = self.nodes[k].centre(rotor);
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
            stiffness: tangent.stiffness * part.planes,
            damping: tangent.damping * part.planes,
            friction: tangent.friction * part.planes,
            turn: (tangent.stiffness * around - tangent.damping * rotor.spin * n.dot(centre.arm))
                * part.planes,
            heats: [
                two * tangent.damping * reaction.penetration_speed,
                reaction.friction_force + tangent.friction * reaction.slip_speed,
            ],
        }
    }
}

impl<R: Real> Tangents<R> for Machines<R> {
    type Room = Room<R>;

    fn room(&self) -> Room<R> {
        let rotor = RotorRows::new(&self.nodes);
        let rows = rotor.count() + ROWS * self.bearings.len();
        let parts = (0..self.bearings.len()).map(|k| Part {
            balls: BallTangents::new(self.planar(k).balls()),
            contact: Contact::open(),
        });
        Room {
            parts: parts.collect(),
            along: [0, 1].map(|_| vec![R::zero(); rotor.touched(0).len()]),
            rotor,
            border: vec![R::zero(); rows * rows],
            side: vec![R::zero(); rows],
            inverse_g: R::one(),
        }
    }

    fn at_points(&self) -> Vec<bool> {
        let mut at_points = vec![true; self.layout.ledger_length()];
        for (at, part) in self.layout.bearings.iter().zip(&self.bearings) {
            at_points[at.heat + POCKET_HEAT..][..2].fill(false);
            if part.fixture.is_none() {
                at_points[at.heat + CONTACT_HEAT..][..2].fill(false);
            }
        }
        at_points
    }

    #[inline(always)]
    fn take(&self, mode: &Mode<R>, time: R, state: &[R], room: &mut Room<R>) {
        let rotor = self.layout.rotor.motion(state);
        for k in 0..self.bearings.len() {
            let at = &self.layout.bearings[k];
            let part = &mut room.parts[k];
            let motion = at.motion(state);
            self.planar(k)
                .tangents(&motion, &state[at.own()], &mut part.balls);
            part.contact = match &self.bearings[k].fixture {
                None => self.contact_tangent(k, &rotor, state),
                Some(_) => self.sliding_tangent(mode, time, [rotor.spin, motion.inner.spin]),
            };
        }
    }

    #[inline(always)]
    fn factor(&self, room: &mut Room<R>, g: R) {
        let inverse_g = g.recip();
        room.inverse_g = inverse_g;
        let Room {
            parts,
            rotor: rows,
            along: [along_normal, along_slip],
            border,
            side,
            ..
        } = room;
        let n = side.len();
        for entry in border.iter_mut() {
            *entry = R::zero();
        }
        let rotor = &self.rotor;
        rows.factor(rotor, &self.nodes, [g, inverse_g], border, n);
        let spin = rows.spin();
        border[spin * (n + 1)] = g * rotor.polar_inertia * self.inverse_rotor_radius.square();
        for (k, part) in parts.iter_mut().enumerate() {
            let own = rows.of_bearing(k);
            let (auxiliary, planar) = (&self.bearings[k], self.planar(k));
            let entries = planar.factor(&mut part.balls, [g, inverse_g]);
            add_bearing(
                border,
                n,
                own,
                &entries.map(|entry| entry * auxiliary.planes),
            );
            let race = &auxiliary.inner_race;
            let scales = planar.border();
            let mount =
                auxiliary.mount.spring.damping + auxiliary.mount.spring.stiffness * inverse_g;
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
                border[(own + row) * (n + 1)] += mass * auxiliary.planes;
            }
            let contact = &part.contact;
            if contact.touches {
                let touched = rows.touched(k);
                let damping = contact.damping + contact.stiffness * inverse_g;
                for (i, touch) in touched.iter().enumerate() {
                    along_normal[i] = contact.along_normal[touch.entry] * touch.shape;
                    along_slip[i] = contact.along_slip[touch.entry] * touch.shape;
                }
                for (i, row) in touched.iter().enumerate() {
                    let of_normal = damping * along_normal[i];
                    let of_slip = contact.friction * along_slip[i];
                    for (j, column) in touched[..=i].iter().enumerate() {
                        border[row.row * n + column.row] +=
                            of_normal * along_normal[j] + of_slip * along_slip[j];
                    }
                }
            }
        }
        if rotor.spin_held {
            hold(border, n, spin);
        }
        for k in 0..self.bearings.len() {
            let [spin, inner, outer] = self.held(k);
            for (row, held) in [inner, inner, spin, outer, outer].into_iter().enumerate() {
                if held {
                    hold(border, n, rows.of_bearing(k) + row);
                }
            }
        }
        factor(border, n);
    }

    #[inline(always)]
    fn solve(&self, room: &mut Room<R>, side: &mut [R]) {
        let Room {
            parts,
            rotor: rows,
            border,
            side: of_border,
            inverse_g,
            ..
        } = room;
        let n = of_border.len();
        let inverse_g = *inverse_g;
        let (l, inverse_l) = (self.rotor_radius(), self.inverse_rotor_radius);
        let (rotor, at_rotor) = (&self.rotor, &self.layout.rotor);
        let (angle, spin) = (at_rotor.angle(), at_rotor.spin());
        rows.side(rotor, &self.nodes, at_rotor, side, of_border);
        of_border[rows.spin()] = rotor.polar_inertia * side[spin] * inverse_l;
        for (k, part) in parts.iter_mut().enumerate() {
            let at = &self.layout.bearings[k];
            let (auxiliary, planar) = (&self.bearings[k], self.planar(k));
            let known = KnownRates {
                inner: pair(side, at.inner.centre()),
                outer: at.outer.motion(side).position,
                cage: side[at.bearing],
            };
            let of_balls = planar.forward(&part.balls, &known, &mut side[at.own()]);
            let race = &auxiliary.inner_race;
            let scales = planar.border();
            let outer = known.outer * (auxiliary.mount.spring.stiffness * inverse_g);
            let outer_rate = at.outer.motion(side).velocity;
            let own = [
                race.mass * side[at.inner.velocity()[0]],
                race.mass * side[at.inner.velocity()[1]],
                race.inertia * side[at.inner.spin()] * scales.inner_radius[1],
                auxiliary.outer_moving_mass * outer_rate.x - outer.x,
                auxiliary.outer_moving_mass * outer_rate.y - outer.y,
                scales.cage_inertia * side[at.bearing + 1] * scales.cage_radius[1],
            ];
            for row in 0..ROWS {
                of_border[rows.of_bearing(k) + row] = (own[row] + of_balls[row]) * auxiliary.planes;
            }
            let contact = &part.contact;
            if contact.touches && auxiliary.fixture.is_none() {
                let (x, y) = (&side[at_rotor.block(0)], &side[at_rotor.block(1)]);
                let apart = self.nodes[k].along(x, y) - known.inner;
                let q = (contact.stiffness * contact.normal.dot(apart)
                    + contact.turn * side[angle])
                    * inverse_g;
                for touch in rows.touched(k) {
                    of_border[touch.row] -= contact.along_normal[touch.entry] * touch.shape * q;
                }
            }
        }
        if rotor.spin_held {
            of_border[rows.spin()] = side[spin] * inverse_g * l;
        }
        for (k, at) in self.layout.bearings.iter().enumerate() {
            let own = &mut of_border[rows.of_bearing(k)..];
            let [spin, inner, outer] = self.held(k);
            if inner {
                let held = pair(side, at.inner.velocity()) * inverse_g;
                (own[0], own[1]) = (held.x, held.y);
            }
            if spin {
                let [radius, _] = self.planar(k).border().inner_radius;
                own[2] = side[at.inner.spin()] * radius * inverse_g;
            }
            if outer {
                own[3..5].fill(R::zero());
            }
        }
        solve(border, n, of_border);
        rows.follow(rotor, &self.nodes, at_rotor, of_border, (side, inverse_g));
        turn(side, angle, of_border[rows.spin()] * inverse_l, inverse_g);
        for (k, part) in parts.iter().enumerate() {
            let at = &self.layout.bearings[k];
            let planar = self.planar(k);
            let [_, inverse_inner_radius] = planar.border().inner_radius;
            let own = rows.of_bearing(k);
            let mut z = [R::zero(); ROWS];
            z.copy_from_slice(&of_border[own..own + ROWS]);
            planar.back(&part.balls, inverse_g, &z, &mut side[at.own()]);
            follow(side, at.inner, [z[0], z[1]], inverse_g);
            turn(
                side,
                at.inner.angle(),
                z[2] * inverse_inner_radius,
                inverse_g,
            );
            follow(side, at.outer, [z[3], z[4]], inverse_g);
        }
    }

    #[inline(always)]
    fn along(&self, room: &Room<R>, vector: &[R], rates: &mut [R]) {
        let l = self.rotor_radius();
        let rotor = &self.layout.rotor;
        for (k, part) in room.parts.iter().enumerate() {
            let at = &self.layout.bearings[k];
            let planar = self.planar(k);
            let in_pockets = planar.heats_along(&part.balls, &vector[at.own()]);
            rates[at.heat + POCKET_HEAT] += in_pockets[0];
            rates[at.heat + POCKET_HEAT + 1] += in_pockets[1];
            let contact = &part.contact;
            if contact.touches && self.bearings[k].fixture.is_none() {
                let [inner_radius, _] = planar.border().inner_radius;
                let (x, y) = (&vector[rotor.block(2)], &vector[rotor.block(3)]);
                let node = self.nodes[k].along(x, y);
                let z = [
                    node.x,
                    node.y,
                    vector[rotor.spin()] * l,
                    vector[at.inner.velocity()[0]],
                    vector[at.inner.velocity()[1]],
                    vector[at.inner.spin()] * inner_radius,
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
