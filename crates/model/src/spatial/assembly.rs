//! Rows of balls on shared rings, the outer ring in its mount, and a rotor that may fall into the inner one.
//!
//! ```text
//!   states   bodies of 13: rotor, inner ring, outer ring, a cage for each row; then for each row its balls, nine lists; then the
//!            energy accounts [`LEDGER`], J
//!   inner    drive τ a_i, force and moment from outside, settling damper -c_i v, -c_it (ω - (ω·a)a)
//!   outer    mount;  tied cages move with it and add their mass;  of a set pressed by a spring the rings of one side slide by s
//! ```
//! s and its rate follow the balls where there is such a spring. A body that does not exist keeps its states.

use super::ball::BALL_STATES;
use super::landing::LandingReaction;
use super::mount::SpatialMount;
use super::pocket::CageMotion;
use super::race::RingMotion;
use super::rigid_body::{BODY_STATES, Inertia, RigidBody, SpatialWrench};
use super::rotor::{Rotor, SpatialRotor};
use super::row::{Around, BallContacts, CageGuide, Detail, Row, RowConstants, SpatialLand};
use super::spring::PreloadSpring;
use number::{Gather, Real, Vec3, Vectorized, constants};

/// Energy accounts in the order of the states: work that became heat, then work that was supplied.
pub const LEDGER: [&str; 18] = [
    "ball_inner_damping",
    "ball_outer_damping",
    "inner_slip_and_spin",
    "outer_slip_and_spin",
    "drag",
    "pocket_damping",
    "pocket_friction",
    "support_damping",
    "bore_contact_damping",
    "bore_contact_friction",
    "amb_damping",
    "land_damping",
    "land_friction",
    "face_damping",
    "face_friction",
    "settling_damper",
    "supplied_by_drive",
    "supplied_on_inner_ring",
];

constants! {
    /// The inner ring with its sleeve, and what acts on it from outside.
    pub struct InnerRing {
        /// Mass and inertias.
        inertia: Inertia<R>,
        /// Whether centre and axis are held, so that it only turns.
        held: bool,
        /// Drive torque about its axis, N m.
        torque: R,
        /// Force at its centre, N.
        force: Vec3<R>,
        /// Moment, N m.
        moment: Vec3<R>,
        /// Damping of its motion for settling, N s/m.
        settling: R,
        /// Damping of its tilt for settling, N m s.
        tilt_settling: R,
    }
}
constants! {
    /// The outer ring in its mount.
    pub struct OuterRing {
        /// Mass and inertias, without cages.
        inertia: Inertia<R>,
        /// Whether it turns and tilts; else it keeps its orientation.
        turns: bool,
        /// Its mount.
        mount: SpatialMount<R>,
    }
}
/// An assembly of one machine.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblyConstants {
    /// Gravity, m/s².
    pub gravity: Vec3<f64>,
    /// The inner ring.
    pub inner: InnerRing<f64>,
    /// The outer ring.
    pub outer: OuterRing<f64>,
    /// The rows of balls.
    pub rows: Vec<RowConstants>,
    /// What presses the rows of one side, where a spring does; the outer ring does not turn then.
    pub spring: Option<PreloadSpring<f64>>,
    /// The rotor.
    pub rotor: Option<SpatialRotor>,
}

/// Forces and couples of an assembly at a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssemblyProbe<R> {
    /// Normal force of rotor and bore, all stations, N.
    pub bore_normal_force: R,
    /// Sum of |friction| there, N.
    pub bore_friction: R,
    /// Largest penetration there, m; 0 without contact.
    pub bore_penetration: R,
    /// Normal force on the faces, N.
    pub face_normal_force: R,
    /// Torque of balls and lands on the inner ring about its axis, N m.
    pub inner_torque: R,
    /// The same on the outer ring.
    pub outer_torque: R,
    /// Largest penetration of a face, m; 0 without contact.
    pub face_penetration: R,
    /// Sum of |friction| on the faces, N.
    pub face_friction: R,
    /// ∂V/∂ω of the inner ring that grows with its speed, J s: with ω̇ a power that the accounts leave out.
    pub growth_impulse: R,
}

/// An assembly over `R`.
#[derive(Clone, Debug)]
pub struct Assembly<R: Real> {
    pub(super) gravity: Vec3<R>,
    pub(super) inner: InnerRing<R>,
    pub(super) outer: OuterRing<R>,
    /// Mass that moves with the outer ring, kg.
    outer_mass: R,
    rows: Vec<Row<R>>,
    spring: Option<PreloadSpring<R>>,
    rotor: Option<Rotor<R>>,
}

impl AssemblyConstants {
    /// First state of a body: 0 rotor, 1 inner ring, 2 outer ring, then the cages.
    pub const fn body(&self, index: usize) -> usize {
        BODY_STATES * index
    }
    /// First state of the balls of a row.
    pub fn first_ball_state(&self, row: usize) -> usize {
        let before: usize = self.rows[..row].iter().map(|row| row.balls).sum();
        BODY_STATES * (3 + self.rows.len()) + BALL_STATES * before
    }
    /// First of the energy accounts, which are the last states.
    pub fn first_account(&self) -> usize {
        let sliding = if self.spring.is_some() { SLIDING } else { 0 };
        self.first_sliding() + sliding
    }
    /// First of both states of outer rings that slide.
    pub fn first_sliding(&self) -> usize {
        self.first_ball_state(self.rows.len())
    }
    /// The outer ring of a row.
    pub(super) fn outer_of<R: Real>(
        &self,
        row: usize,
        outer: RigidBody<R>,
        state: &[R],
    ) -> RigidBody<R> {
        let ball = &self.rows[row].ball;
        match self.spring.filter(|own| own.presses(ball)) {
            Some(_) => outer.slid([state[self.first_sliding()], state[self.first_sliding() + 1]]),
            None => outer,
        }
    }
    /// Number of states.
    pub fn states(&self) -> usize {
        self.first_account() + LEDGER.len()
    }
    /// Contacts and pocket of a ball of a row.
    pub fn ball(&self, row: usize, ball: usize, state: &[f64]) -> BallContacts<f64> {
        let [inner, outer, cage] =
            [1, 2, 3 + row].map(|body| RigidBody::read(&state[self.body(body)..]));
        let outer = self.outer_of(row, outer, state);
        self.rows[row].contacts(
            [&inner, &outer, &cage],
            &state[self.first_ball_state(row)..],
            ball,
        )
    }
    /// Place of the outer ring at which its mount must be free so that its weight and that of all it carries leave it at the origin, m.
    pub fn balanced_free_position(&self) -> Vec3<f64> {
        let rows = self.rows.iter();
        let of_rows: f64 = rows
            .map(|row| row.cage.inertia.mass + row.balls as f64 * row.ball.mass)
            .sum();
        let inner = if self.inner.held {
            0.0
        } else {
            self.inner.inertia.mass
        };
        let mount = &self.outer.mount;
        let mass = self.outer.inertia.mass + of_rows + inner;
        let radial = -mass / mount.radial_stiffness;
        let g = self.gravity;
        Vec3::new(
            g.x * radial,
            g.y * radial,
            -mass * g.z / mount.axial_stiffness,
        )
    }
}

impl<R: Real> Assembly<R> {
    /// One assembly a lane.
    pub fn gather<'a>(machine: &dyn Fn(usize) -> &'a AssemblyConstants) -> Self {
        let row = |k: usize| Row::gather(&|lane| &machine(lane).rows[k]);
        let rows: Vec<Row<R>> = (0..machine(0).rows.len()).map(row).collect();
        let outer: OuterRing<R> = Gather::gather(&|lane| &machine(lane).outer);
        let tied = rows.iter().filter(|row| row.is_tied());
        let outer_mass = tied.fold(outer.inertia.mass, |sum, row| sum + row.cage.mass);
        Assembly {
            gravity: Gather::gather(&|lane| &machine(lane).gravity),
            inner: Gather::gather(&|lane| &machine(lane).inner),
            outer,
            outer_mass,
            rows,
            spring: machine(0).spring.as_ref().map(|_| {
                Gather::gather(&|lane| {
                    let spring = machine(lane).spring.as_ref();
                    spring.expect("lanes share whether a spring presses")
                })
            }),
            rotor: machine(0).rotor.as_ref().map(|_| {
                Rotor::gather(&|lane| {
                    let rotor = machine(lane).rotor.as_ref();
                    rotor.expect("lanes share whether there is a rotor")
                })
            }),
        }
    }

    /// Rates of all states.
    pub fn rate(&self, state: &[R], rate: &mut [R]) -> AssemblyProbe<R> {
        R::vectorized(Rates {
            assembly: self,
            state,
            rate,
        })
    }
}

/// Rings, what acts on them and the powers of the accounts.
pub(super) struct Bodies<R> {
    pub inner: RigidBody<R>,
    pub outer: RigidBody<R>,
    pub on_inner: SpatialWrench<R>,
    pub on_outer: SpatialWrench<R>,
    /// Moment about the axis through the origin on balls and cages from outside: weight and drag, N m.
    pub external: R,
    /// ∂V/∂ω of the inner ring that grows with its speed, J s.
    pub growth_impulse: R,
    /// Normal force between cages and lands, N.
    pub land_force: R,
    /// Along the axis on the outer rings that slide, by their rows and by the spring, N, and their speed beside the others, m/s.
    sliding: [R; 3],
    /// Powers of the accounts, W, and of the steady moment, which is a drag there.
    pub power: [R; MOMENT + 1],
}

#[inline(always)]
fn around<R: Real>(bodies: &Bodies<R>, cage: &RigidBody<R>) -> Around<R::Group> {
    Around {
        inner: RingMotion::grouped(&bodies.inner),
        outer: RingMotion::grouped(&bodies.outer),
        cage: CageMotion::grouped(cage),
    }
}

impl<R: Real> Bodies<R> {
    /// Both rings from their states.
    #[inline(always)]
    pub fn read(inner: &[R], outer: &[R]) -> Self {
        Bodies {
            inner: RigidBody::read(inner),
            outer: RigidBody::read(outer),
            on_inner: SpatialWrench::zero(),
            on_outer: SpatialWrench::zero(),
            external: R::zero(),
            growth_impulse: R::zero(),
            land_force: R::zero(),
            sliding: [R::zero(); 3],
            power: [R::zero(); MOMENT + 1],
        }
    }
    /// What a rotor that has landed does to the inner ring, and the heats.
    #[inline(always)]
    pub fn land(&mut self, landed: &LandingReaction<R>) {
        self.on_inner.add(landed.on_ring);
        self.power[BORE] += landed.bore.heats[0];
        self.power[BORE + 1] += landed.bore.heats[1];
        self.power[FACE] += landed.face.heats[0];
        self.power[FACE + 1] += landed.face.heats[1];
    }
    /// A cage: its land, its drag, its rates.
    #[inline(always)]
    fn move_cage(
        &mut self,
        row: &Row<R>,
        cage: &RigidBody<R>,
        by_balls: SpatialWrench<R>,
        (gravity, rate): (Vec3<R>, &mut [R]),
    ) {
        let mut on_cage = by_balls;
        let drag = row.cage_drag;
        on_cage.moment += cage.spin * -drag;
        self.power[DRAG] += drag * cage.spin.length_squared();
        let weight = gravity * row.cage.mass;
        self.external += cage.position.cross(weight).z - drag * cage.spin.z;
        match &row.guide {
            CageGuide::Tied => {
                // its place follows the outer ring, which has the forces of its pockets: their couple no ring that is held feels
                self.on_outer.force += on_cage.force;
                let turning = row.cage.held_acceleration(cage, on_cage.moment);
                cage.write_rates(rate, [cage.velocity, Vec3::zero()], turning);
                return;
            }
            CageGuide::Balls => {}
            CageGuide::OuterLand(land) => {
                let mut k = 0;
                while k < 2 {
                    let station = land.station(k);
                    let r = (land.contact).at_station::<true>(
                        cage,
                        cage.position,
                        &self.outer,
                        station,
                    );
                    on_cage.add(r.on_cylinder);
                    self.on_outer.add(r.on_bore);
                    self.land_force += r.normal_force;
                    self.power[LAND] += r.damping_heat;
                    self.power[LAND + 1] += r.friction_heat;
                    k += 1;
                }
            }
            CageGuide::InnerLand(land) => {
                let mut k = 0;
                while k < 2 {
                    let (inner, station) = (&self.inner, land.station(k));
                    let r = (land.contact).at_station::<true>(inner, inner.position, cage, station);
                    on_cage.add(r.on_bore);
                    self.on_inner.add(r.on_cylinder);
                    self.land_force += r.normal_force;
                    self.power[LAND] += r.damping_heat;
                    self.power[LAND + 1] += r.friction_heat;
                    k += 1;
                }
            }
        }
        let acceleration = on_cage.force * row.cage.mass.recip() + gravity;
        let turning = row.cage.angular_acceleration(cage, on_cage.moment);
        cage.write_rates(rate, [cage.velocity, acceleration], turning);
    }
}

impl<R: Real> SpatialLand<R> {
    #[inline(always)]
    fn station(&self, k: usize) -> R {
        self.middle + [-self.half_width, self.half_width][k]
    }
}

const DRAG: usize = 4;
const SUPPORT: usize = 7;
const BORE: usize = 8;
pub(super) const AMB: usize = 10;
const LAND: usize = 11;
const FACE: usize = 13;
const SETTLING: usize = 15;
pub(super) const MOMENT: usize = LEDGER.len();

/// States of outer rings that slide: how far, m, and how fast, m/s.
pub(super) const SLIDING: usize = 2;

/// All rates.
struct Rates<'a, R: Real> {
    assembly: &'a Assembly<R>,
    state: &'a [R],
    rate: &'a mut [R],
}

impl<R: Real> Vectorized for Rates<'_, R> {
    type Output = AssemblyProbe<R>;
    #[inline(always)]
    fn run(self) -> AssemblyProbe<R> {
        let Rates {
            assembly,
            state,
            rate,
        } = self;
        let mut bodies = Bodies::read(&state[BODY_STATES..], &state[2 * BODY_STATES..]);
        let (own, end) = (3 * BODY_STATES, assembly.first_account());
        assembly.act(
            &mut bodies,
            (&state[own..end], &mut rate[own..end]),
            &mut [],
        );
        let probe = assembly.move_rings(&mut bodies, state, rate);
        bodies.power[DRAG] += bodies.power[MOMENT];
        rate[end..end + MOMENT].copy_from_slice(&bodies.power[..MOMENT]);
        probe
    }
}

impl<R: Real> Assembly<R> {
    /// Number of balls of all rows.
    #[inline(always)]
    pub(super) fn balls(&self) -> usize {
        let mut balls = 0;
        let mut index = 0;
        while index < self.rows.len() {
            balls += self.rows[index].balls;
            index += 1;
        }
        balls
    }
    /// Masses of the cages, kg.
    #[inline(always)]
    pub(super) fn cage_masses(&self) -> impl Iterator<Item = R> + '_ {
        self.rows.iter().map(|row| row.cage.mass)
    }
    #[inline(always)]
    fn first_account(&self) -> usize {
        3 * BODY_STATES + self.first_sliding() + if self.spring.is_some() { SLIDING } else { 0 }
    }
    /// Of both states of outer rings that slide, behind those of cages and balls.
    #[inline(always)]
    fn first_sliding(&self) -> usize {
        BODY_STATES * self.rows.len() + BALL_STATES * self.balls()
    }
    /// Cages and balls, whose states follow each other: their rates, and what they do to the rings. The detail of the balls is filled
    /// where asked, see [`super::row`].
    #[inline(always)]
    pub(super) fn act(
        &self,
        bodies: &mut Bodies<R>,
        (state, rate): (&[R], &mut [R]),
        detail: &mut [R],
    ) {
        let balls = self.balls();
        let mut first = BODY_STATES * self.rows.len();
        let fixed = bodies.outer;
        let mut slid = fixed;
        if let Some(spring) = &self.spring {
            let at = self.first_sliding();
            slid = fixed.slid([state[at], state[at + 1]]);
            let by_spring = spring.act(state[at], state[at + 1]);
            bodies.sliding[1] = by_spring.on_ring;
            bodies.sliding[2] = state[at + 1];
            bodies.power[SUPPORT] += by_spring.heat;
        }
        let (mut index, mut before) = (0, 0);
        while index < self.rows.len() {
            let row = &self.rows[index];
            let slides = match &self.spring {
                Some(spring) => spring.carries([&row.ball.inner, &row.ball.outer]),
                None => false,
            };
            bodies.outer = if slides { slid } else { fixed };
            let place = BODY_STATES * index;
            index += 1;
            let cage = RigidBody::read(&state[place..]);
            let around = around(bodies, &cage);
            let own = first..first + BALL_STATES * row.balls;
            first = own.end;
            let into = Detail {
                list: &mut *detail,
                before,
                balls,
            };
            before += row.balls;
            let lists = (&state[own.clone()], &mut rate[own]);
            let reaction = row.react([&bodies.inner, &bodies.outer], &around, lists, into);
            let own = &mut rate[place..place + BODY_STATES];
            let mut by_others = bodies.on_outer.force.z;
            bodies.move_cage(row, &cage, reaction.on_cage, (self.gravity, own));
            if row.is_tied() {
                // a tied cage moves with the rings that stand
                by_others = bodies.on_outer.force.z;
            }
            bodies.on_inner.add(reaction.on_inner);
            bodies.on_outer.add(reaction.on_outer);
            if slides {
                bodies.sliding[0] += bodies.on_outer.force.z - by_others;
            }
            bodies.external += reaction.external;
            bodies.growth_impulse += reaction.growth_impulse;
            let mut k = 0;
            while k < SUPPORT {
                bodies.power[k] += reaction.heats[k];
                k += 1;
            }
            bodies.power[MOMENT] += reaction.heats[SUPPORT];
        }
        bodies.outer = fixed;
    }
    /// Gives tied cages the acceleration of the outer ring, and rings that slide their own beside it; the rates are those of cages and balls.
    #[inline(always)]
    pub(super) fn carry(&self, bodies: &Bodies<R>, acceleration: Vec3<R>, rate: &mut [R]) {
        if let Some(spring) = &self.spring {
            let [by_rows, by_spring, speed] = bodies.sliding;
            let own = (by_rows + by_spring) * spring.mass.recip() + self.gravity.z;
            let at = self.first_sliding();
            rate[at] = speed;
            rate[at + 1] = own - acceleration.z;
        }
        let mut index = 0;
        while index < self.rows.len() {
            if self.rows[index].is_tied() {
                let at = BODY_STATES * index + 3;
                rate[at] = acceleration.x;
                rate[at + 1] = acceleration.y;
                rate[at + 2] = acceleration.z;
            }
            index += 1;
        }
    }
    /// Rotor and rings, when all balls and cages have acted.
    #[inline(always)]
    fn move_rings(&self, bodies: &mut Bodies<R>, state: &[R], rate: &mut [R]) -> AssemblyProbe<R> {
        let zero = R::zero();
        let mut probe = AssemblyProbe {
            bore_normal_force: zero,
            bore_friction: zero,
            bore_penetration: zero,
            face_normal_force: zero,
            inner_torque: bodies.on_inner.moment.dot(bodies.inner.axis),
            outer_torque: bodies.on_outer.moment.dot(bodies.outer.axis),
            face_penetration: zero,
            face_friction: zero,
            growth_impulse: bodies.growth_impulse,
        };
        match &self.rotor {
            None => {
                let mut k = 0;
                while k < BODY_STATES {
                    rate[k] = zero;
                    k += 1;
                }
            }
            Some(rotor) => {
                let body = RigidBody::read(state);
                let on_rotor = rotor.react(&body, self.gravity, bodies, &mut probe);
                let acceleration = on_rotor.force * rotor.inertia.mass.recip() + self.gravity;
                let turning = rotor.inertia.angular_acceleration(&body, on_rotor.moment);
                body.write_rates(rate, [body.velocity, acceleration], turning);
            }
        }
        self.move_inner(bodies, &mut rate[BODY_STATES..2 * BODY_STATES]);
        let acceleration = self.move_outer(bodies, &mut rate[2 * BODY_STATES..3 * BODY_STATES]);
        self.carry(bodies, acceleration, &mut rate[3 * BODY_STATES..]);
        probe
    }
    #[inline(always)]
    pub(super) fn move_inner(&self, bodies: &mut Bodies<R>, rate: &mut [R]) {
        let (ring, body) = (&self.inner, &bodies.inner);
        let turn = body.spin.dot(body.axis);
        let tilting = body.spin - body.axis * turn;
        let damping = body.velocity * ring.settling;
        let tilt_damping = tilting * ring.tilt_settling;
        bodies.power[SETTLING] += damping.dot(body.velocity) + tilt_damping.dot(tilting);
        bodies.power[SETTLING + 1] += ring.torque * turn;
        bodies.power[SETTLING + 2] += ring.force.dot(body.velocity) + ring.moment.dot(body.spin);
        let force = bodies.on_inner.force + ring.force - damping;
        let moment = bodies.on_inner.moment + body.axis * ring.torque + ring.moment - tilt_damping;
        if ring.held {
            let turning = ring.inertia.held_acceleration(body, moment);
            body.write_rates(rate, [Vec3::zero(); 2], turning);
        } else {
            let acceleration = force * ring.inertia.mass.recip() + self.gravity;
            let turning = ring.inertia.angular_acceleration(body, moment);
            body.write_rates(rate, [body.velocity, acceleration], turning);
        }
    }
    /// Returns the acceleration of the outer ring.
    #[inline(always)]
    pub(super) fn move_outer(&self, bodies: &mut Bodies<R>, rate: &mut [R]) -> Vec3<R> {
        let (ring, body) = (&self.outer, &bodies.outer);
        let by_mount = ring.mount.wrench(body);
        bodies.power[SUPPORT] += ring.mount.heat(body);
        let force = bodies.on_outer.force + by_mount.force;
        let mut acceleration = force * self.outer_mass.recip() + self.gravity;
        if let Some(spring) = &self.spring {
            // along the axis without the rings that slide, and with the other end of the spring
            let [by_rows, by_spring, _] = bodies.sliding;
            let along = force.z - by_rows - by_spring;
            acceleration.z = along * (self.outer_mass - spring.mass).recip() + self.gravity.z;
        }
        let moment = bodies.on_outer.moment + by_mount.moment;
        let mut turning = ring.inertia.angular_acceleration(body, moment);
        if !ring.turns {
            turning = Vec3::zero();
        }
        body.write_rates(rate, [body.velocity, acceleration], turning);
        if !ring.turns {
            let mut k = 6;
            while k < 10 {
                rate[k] = R::zero();
                k += 1;
            }
        }
        acceleration
    }
}
