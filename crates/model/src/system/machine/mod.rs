//! A machine of parts: a rotor, magnets, seals, auxiliary bearings. A drop, a coast-down, a spin-up, a test on a rig are machines.
//!
//! ```text
//!        rotor η, φ ──(levitation, until t = 0; magnets with controllers or with currents that decay; seals)
//!          │ ... at each auxiliary bearing:
//!          │ contact: clearance c0, N, friction
//!        inner race c_i, φ_i ── drive torque
//!          │ bearing: balls, cage
//!        outer race c_o ──/\/\/── ground        does not turn: the ground takes t_O
//! ```
//! | page | subject |
//! |---|---|
//! | [`layout`] | where everything stands in the state |
//! | [`rate`] | the equations of motion |
//! | `in_space` | bearings in space, and the rotor along its axis |
//! | [`start`] | the levitated state at release |
//! | [`ledger`] | energies, momentum, what closes |
//! | [`tangents`] | what is stiff, for linearly implicit steps |
//! | [`rotor_rows`] | the rotor in these |
//! | [`record`] | what is watched and kept of a run |
//! | [`unbalances`] | those that come on the way |
//! | [`simulate`] | a run, alone or in lanes |
//! | [`driven`] | one that is driven from outside, from stop to stop |
//!
//! The auxiliary bearing is a part: [`auxiliary_bearing`](crate::auxiliary_bearing).
//!
//! The rotor is a part too: [`rotor`](crate::rotor). Each bearing meets it at a node of its own and counts its coordinates from
//! a datum of its own. On a point rotor all see the same motion. Equal rows at one node are computed once: rotor and ledger count
//! their bearing [`planes`](crate::auxiliary_bearing::AuxiliaryBearingConstants::planes) times.
//!
//! On a [`rig`](super::rig) one bearing stands in a fixture, and the rotor only turns.

pub mod bearing_record;
pub mod constants;
pub mod driven;
mod in_space;
pub mod layout;
pub mod ledger;
mod of_magnets;
pub mod rate;
pub mod record;
pub mod rotor_rows;
pub mod simulate;
pub mod start;
pub mod tangents;
pub mod travel;
pub mod unbalances;

use crate::auxiliary_bearing::AuxiliaryBearing;
use crate::base::Base;
use crate::force::Force;
use crate::levitation::Levitation;
use crate::magnets::Magnets;
use crate::rotor::{Node, Rotor};
use crate::seal::Seal;
use crate::spatial::SpatialBearing;
use crate::system::rig::{Clutch, ClutchDrive, ClutchMode, Drive, Fixture, Refusal, RigConstants};
use crate::table::Piece;
pub use constants::{
    AtSpeed, Event, MOST_LOADED, MOST_SPEEDS, MOST_UNBALANCES, MachineConstants, Reached,
};
use driven::Outside;
use in_space::InSpace;
use layout::Layout;
use number::{Gather, Real, Vec2};
use rate::Rates;
use solve::{Batch, Machine};

/// What holds between two landings: 1 for on, 0 for off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode<R> {
    /// Levitation.
    pub levitation: R,
    /// Axial magnet: share of its force.
    pub thrust: R,
    /// Brake of the rotor: share of its torque.
    pub brake: R,
    /// What the drive of the rotor has more than at the start, N m.
    pub driving: R,
    /// Radial load on a rig, N.
    pub load: Piece<R>,
    /// Loads from outside that have come, N.
    pub loads: [Vec2<R>; MOST_LOADED],
    /// Recorded acceleration of the base along x and y, m/s², with what is added from outside.
    pub base: [Piece<R>; 2],
    /// What is given from outside between two stops.
    pub outside: Outside,
    /// Torque, N m, or speed, rad/s, that is given on a rig; zero where neither is.
    pub drive: Piece<R>,
    /// Motor and clutch of a rig.
    pub clutch: ClutchMode,
    /// Which of the unbalances that come on the way are there, bit by bit.
    pub unbalances: u16,
    /// What the rotor has reached of the speeds at which something happens.
    pub reached: [Reached; MOST_SPEEDS],
}

/// Share of a speed to which the instant is found at which it is reached.
const AT_SPEED: f64 = 1e-9;

impl Mode<f64> {
    /// What an event switches.
    fn happen(&mut self, event: Event) {
        match event {
            Event::Brake(share) => self.brake = share,
            Event::Thrust(share) => self.thrust = share,
            Event::Drive(torque) => self.driving = torque + self.outside.torque,
            Event::Load(place, force) => self.loads[place] = force,
            Event::Unbalance(plane) => self.unbalances |= 1 << plane,
            Event::Knot | Event::Control(_) => {}
        }
    }
}

/// One machine, ready to run.
#[derive(Clone, Debug)]
pub struct RotorMachine {
    /// Its constants.
    pub constants: MachineConstants,
    layout: Layout,
    one: Machines<f64>,
    /// What is watched of the rotor besides its bearings.
    places: Vec<Node<f64>>,
    error_scale: Vec<f64>,
    levitated: bool,
    /// Which of the unbalances that come on the way are there.
    unbalances: u16,
    /// What they have added to N at φ = 0, of each coordinate, m.
    added: Vec<Vec2<f64>>,
}

/// The system over `R`.
#[derive(Clone, Debug)]
pub struct Machines<R: Real> {
    rotor: Rotor<R>,
    /// Of a point rotor, with its only node.
    levitation: Option<(Node<R>, Levitation<R>)>,
    magnets: Option<Magnets<R>>,
    seals: Vec<(Node<R>, Seal<R>)>,
    forces: Vec<Force<R>>,
    /// Nodes at which loads come on the way.
    loaded: Vec<Node<R>>,
    base: Option<Base<R>>,
    gravity: Vec2<R>,
    bearings: Vec<AuxiliaryBearing<R>>,
    /// The rotor along its axis, and its nodes in bearings in space.
    space: Option<InSpace<R>>,
    /// The rotor's node in each.
    nodes: Vec<Node<R>>,
    /// Of each, the housing on which it stands; none on the ground.
    stands: Vec<Option<Node<R>>>,
    /// Whether any stands on one.
    housed: bool,
    /// 1/L, L the radius of the first bore, 1/m.
    inverse_rotor_radius: R,
    layout: Layout,
}

impl RotorMachine {
    /// A bearing on a rig.
    pub fn on_rig(constants: RigConstants) -> Result<Self, Refusal> {
        constants.check()?;
        Ok(Self::new(constants.machine()))
    }
    /// A machine whose levitation has just been lost.
    pub fn new(constants: MachineConstants) -> Self {
        Self::with_levitation(constants, false)
    }
    /// A machine, levitated or not.
    ///
    /// # Panics
    /// When it has no auxiliary bearing, when lists do not have the length of its coordinates, and when a rotor that bends is to
    /// be levitated.
    pub fn with_levitation(constants: MachineConstants, levitated: bool) -> Self {
        if let Some(fault) = constants.fault() {
            panic!("{fault}");
        }
        let point = constants.rotor.coordinates.len() == 1;
        assert!(point || !levitated, "levitation holds a point rotor");
        let layout = Layout::of(&constants);
        let place = |row: &Vec<f64>| Node::gather(&|_| (&constants.rotor, &row[..], Vec2::zero()));
        RotorMachine {
            places: constants.rotor.places.iter().map(place).collect(),
            one: Machines::of(&|_| &constants, layout.clone()),
            error_scale: layout.error_scale(&constants),
            layout,
            levitated,
            unbalances: 0,
            added: vec![Vec2::zero(); constants.rotor.coordinates.len()],
            constants,
        }
    }
    /// Whether lanes may hold both: the same states, magnets, seals, shocks, switches and drives; a clutch and a housing stand alone.
    pub fn shares_lanes(&self, other: &Self) -> bool {
        let (a, b) = (&self.constants, &other.constants);
        let rows = |own: &MachineConstants| -> Vec<usize> {
            own.seals.iter().map(|seal| seal.rows.len()).collect()
        };
        let forces = |own: &MachineConstants| [own.forces.len(), own.loaded.len()];
        let shocks = |own: &MachineConstants| own.base.as_ref().map(|base| base.shocks.len());
        let drive = |machine: &Self| {
            let fixture = machine.fixture();
            fixture.map(|own| std::mem::discriminant(&own.drive))
        };
        let held = |own: &MachineConstants| -> Vec<[bool; 3]> {
            let each = own.bearings.iter();
            each.map(|part| {
                let stands = part.mount_parts.on.is_some();
                [part.inner_race.centre_held, part.is_concentric(), stands]
            })
            .collect()
        };
        let in_space = |own: &MachineConstants| -> Vec<_> {
            let each = own.bearings.iter();
            each.map(|part| part.spatial().map(SpatialBearing::counts))
                .collect()
        };
        let alone = |own: &Fixture| own.housing.is_some() || matches!(own.drive, Drive::Clutch(_));
        let magnets = match (&a.magnets, &b.magnets) {
            (Some(a), Some(b)) => a.share_lanes(b),
            (a, b) => a.is_none() && b.is_none(),
        };
        self.layout == other.layout
            && magnets
            && rows(a) == rows(b)
            && forces(a) == forces(b)
            && shocks(a) == shocks(b)
            && a.rotor.spin_held == b.rotor.spin_held
            && drive(self) == drive(other)
            && held(a) == held(b)
            && in_space(a) == in_space(b)
            && !self.fixture().is_some_and(alone)
    }
    /// Where everything stands in the state.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }
    /// What turns, loads and carries the bearing of a rig; none of another machine.
    pub fn fixture(&self) -> Option<&Fixture> {
        self.constants.bearings[0].fixture.as_deref()
    }
    /// What an event does to mode and state.
    fn happen(&self, event: Event, time: f64, mode: &mut Mode<f64>, state: &mut [f64]) {
        let before = mode.unbalances;
        mode.happen(event);
        mode.base = self.base_at(time, mode.outside.base);
        if mode.unbalances != before {
            self.unbalance([before, mode.unbalances], state);
        }
        if let (Event::Control(event), Some(magnets)) = (event, &self.one.magnets) {
            let at = (self.layout.rotor, self.layout.magnets.clone());
            magnets.happen(event, time, at, state);
        }
    }
    fn clutch(&self) -> Option<&ClutchDrive> {
        match &self.fixture()?.drive {
            Drive::Clutch(clutch) => Some(clutch),
            _ => None,
        }
    }
    /// The mode at an instant, before an event or a clutch does anything.
    pub(super) fn mode_at(&self, time: f64) -> Mode<f64> {
        let nothing = [Piece::NONE; 2];
        let [load, drive] = (self.fixture()).map_or(nothing, |fixture| fixture.pieces(time));
        Mode {
            levitation: f64::from(u8::from(self.levitated)),
            thrust: 1.0,
            brake: 0.0,
            driving: 0.0,
            loads: [Vec2::zero(); MOST_LOADED],
            base: self.base_at(time, Vec2::zero()),
            outside: Outside::NONE,
            load,
            drive,
            clutch: ClutchMode::idle(),
            unbalances: 0,
            reached: [Reached::NEVER; MOST_SPEEDS],
        }
    }
    /// The record of the base from an instant to its next point, with what is added, m/s².
    fn base_at(&self, time: f64, added: Vec2<f64>) -> [Piece<f64>; 2] {
        let base = self.constants.base.as_ref();
        let [mut x, mut y] = base.map_or([Piece::NONE; 2], |base| base.pieces(time));
        x.value += added.x;
        y.value += added.y;
        [x, y]
    }
    /// What a rotor with a size of spin, rad/s, lacks of the nearest speed at which something happens, or from which on it may; infinite where all
    /// is reached.
    fn left(&self, mode: &Mode<f64>, spin: f64) -> f64 {
        let speeds = self.constants.at_speeds.iter().zip(&mode.reached);
        let waiting = speeds.filter(|(_, reached)| !reached.at.is_finite());
        let left = waiting.map(|(own, reached)| own.waits(reached, spin));
        left.fold(f64::INFINITY, f64::min)
    }
    /// What follows next after a speed that was reached, with its instant: which speed, infinite where nothing does.
    fn follows(&self, mode: &Mode<f64>) -> (usize, f64) {
        let next = |(k, own): (usize, &AtSpeed)| {
            let reached = mode.reached[k];
            let then = own.then.get(reached.done);
            (
                k,
                then.map_or(f64::INFINITY, |(delay, _)| reached.at + delay),
            )
        };
        let all = self.constants.at_speeds.iter().enumerate().map(next);
        all.fold((0, f64::INFINITY), |a, b| if b.1 < a.1 { b } else { a })
    }
    /// How many landings were known before the run, of so many.
    fn known(&self, mode: &Mode<f64>, landing: usize) -> usize {
        let reached = mode.reached.iter().map(|own| own.done);
        landing - reached.sum::<usize>()
    }
}

impl<R: Real> Machines<R> {
    fn of<'a>(constants: &dyn Fn(usize) -> &'a MachineConstants, layout: Layout) -> Self {
        let bearings = 0..constants(0).bearings.len();
        let node = |k: usize| {
            Node::gather(&|lane| {
                let part = &constants(lane).bearings[k];
                (&constants(lane).rotor, &part.node[..], part.datum)
            })
        };
        let stand = |k: usize| {
            let on = |lane: usize| constants(lane).bearings[k].mount_parts.on.as_deref();
            on(0)?;
            Some(Node::gather(&|lane| {
                let row = on(lane).expect("lanes share what mounts stand on");
                (&constants(lane).rotor, row, Vec2::zero())
            }))
        };
        let seal = |k: usize| {
            let node = Node::gather(&|lane| {
                let of = constants(lane);
                (&of.rotor, &of.seals[k].node[..], Vec2::zero())
            });
            (node, Seal::gather(&|lane| &constants(lane).seals[k]))
        };
        let force = |k: usize| {
            let of = |lane: usize| &constants(lane).forces[k];
            let over_time = (0..R::LANES).map(|lane| of(lane).over_time.clone());
            Force {
                node: Node::gather(&|lane| {
                    (&constants(lane).rotor, &of(lane).node[..], Vec2::zero())
                }),
                over_time: over_time.collect(),
            }
        };
        let loaded = |k: usize| {
            let row = |lane: usize| &constants(lane).loaded[k][..];
            Node::gather(&|lane| (&constants(lane).rotor, row(lane), Vec2::zero()))
        };
        let point = constants(0).rotor.coordinates.len() == 1;
        Machines {
            rotor: Rotor::gather(&|lane| &constants(lane).rotor),
            levitation: point.then(|| {
                let node = Node::gather(&|lane| (&constants(lane).rotor, &[1.0][..], Vec2::zero()));
                (
                    node,
                    Gather::<R>::gather(&|lane| &constants(lane).levitation),
                )
            }),
            magnets: constants(0).magnets.is_some().then(|| {
                Magnets::gather(&|lane| {
                    let own = constants(lane).magnets.as_ref();
                    (
                        &constants(lane).rotor,
                        own.expect("lanes share their magnets"),
                    )
                })
            }),
            seals: (0..constants(0).seals.len()).map(seal).collect(),
            forces: (0..constants(0).forces.len()).map(force).collect(),
            loaded: (0..constants(0).loaded.len()).map(loaded).collect(),
            nodes: bearings.clone().map(node).collect(),
            housed: bearings.clone().any(|k| stand(k).is_some()),
            stands: bearings.clone().map(stand).collect(),
            base: constants(0).base.is_some().then(|| {
                Base::gather(&|lane| {
                    let own = constants(lane).base.as_ref();
                    own.expect("lanes share the motion of the base")
                })
            }),
            gravity: Gather::<R>::gather(&|lane| &constants(lane).gravity),
            space: InSpace::gather(constants),
            bearings: bearings
                .map(|k| AuxiliaryBearing::gather(&|lane| &constants(lane).bearings[k]))
                .collect(),
            inverse_rotor_radius: R::from_lanes(|lane| {
                1.0 / constants(lane).bearings[0].contact.bore_radius
            }),
            layout,
        }
    }
}

impl Machine for RotorMachine {
    type Mode = Mode<f64>;

    fn starts_afresh(&self) -> bool {
        // a clutch that changes changes what moves at once
        self.clutch().is_some()
    }
    fn dimension(&self) -> usize {
        self.layout.dimension()
    }
    fn quadratures(&self) -> usize {
        self.layout.ledger_length()
    }
    fn probes(&self) -> usize {
        self.layout.probes()
    }
    fn watched_probes(&self) -> usize {
        self.layout.watched_probes()
    }
    fn watched_channels(&self) -> usize {
        self.layout.watched_channels()
    }
    fn error_scale(&self, channel: usize) -> f64 {
        self.error_scale[channel]
    }
    fn channel_name(&self, channel: usize) -> String {
        self.layout.channel_name(channel)
    }
    fn start_mode(&self) -> Mode<f64> {
        let mut mode = self.mode_at(0.0);
        for (own, reached) in self.constants.at_speeds.iter().zip(&mut mode.reached) {
            reached.armed = own.left(self.constants.speed.abs()) > 0.0;
        }
        for event in self.constants.schedule.at_the_start() {
            mode.happen(event);
        }
        if let Some(clutch) = self.clutch()
            && mode.clutch.due(&clutch.program) <= 0.0
        {
            mode.advance(self, &clutch.program, 0.0, &self.start());
        }
        mode
    }
    fn landings(&self) -> &[f64] {
        self.constants.schedule.instants()
    }
    fn due(&self, mode: &Mode<f64>, landing: usize) -> f64 {
        if let Some(clutch) = self.clutch() {
            return mode.clutch.due(&clutch.program);
        }
        let known = self.landings().get(self.known(mode, landing));
        known
            .map_or(f64::INFINITY, |at| *at)
            .min(self.follows(mode).1)
    }
    fn transition(&self, landing: usize, mode: &mut Mode<f64>, state: &mut [f64]) {
        if let Some(clutch) = self.clutch() {
            let time = mode.clutch.due(&clutch.program);
            return mode.advance(self, &clutch.program, time, state);
        }
        if let Some(fixture) = self.fixture() {
            [mode.load, mode.drive] = fixture.pieces(self.landings()[landing]);
        }
        let landing = self.known(mode, landing);
        let known = self.landings().get(landing).copied();
        let (event, time) = match self.follows(mode) {
            (speed, time) if known.is_none_or(|known| time <= known) => {
                let reached = &mut mode.reached[speed];
                reached.done += 1;
                let (_, event) = self.constants.at_speeds[speed].then[reached.done - 1];
                (event, time)
            }
            _ => {
                let event = self.constants.schedule.event(landing);
                (event, known.unwrap_or_default())
            }
        };
        self.happen(event, time, mode, state);
    }
    fn changed(&self, mode: &Mode<f64>) -> Option<Box<Self>> {
        (mode.unbalances != self.unbalances).then(|| Box::new(self.unbalanced(mode.unbalances)))
    }
    fn guard(&self, mode: &Mode<f64>, _time: f64, at: (&[f64], &[f64])) -> f64 {
        if self.constants.at_speeds.is_empty() {
            return self.reserve(mode, at);
        }
        self.left(mode, at.0[self.layout.rotor.spin()].abs())
    }
    fn guard_error(&self, mode: &Mode<f64>) -> f64 {
        if let Some(own) = self.constants.at_speeds.first() {
            return AT_SPEED * own.speed;
        }
        match mode.clutch.state {
            Clutch::Slipping { .. } => 1e-13 * self.constants.speed.abs(),
            Clutch::Open | Clutch::Locked => f64::INFINITY,
        }
    }
    fn cross(&self, time: f64, mode: &mut Mode<f64>, state: &mut [f64]) {
        // the one whose guard was found, and any at the same speed
        let spin = state[self.layout.rotor.spin()].abs();
        let least = self.left(mode, spin);
        let speeds = self.constants.at_speeds.iter().zip(&mut mode.reached);
        for (own, reached) in speeds.filter(|(_, reached)| !reached.at.is_finite()) {
            if own.waits(reached, spin) > least {
                continue;
            }
            match reached.armed {
                true => reached.at = time,
                false => reached.armed = true,
            }
        }
        self.change_clutch(time, mode, state);
    }
    fn rate(
        &self,
        mode: &Mode<f64>,
        time: f64,
        state: &[f64],
        rate: &mut [f64],
        probe: &mut [f64],
    ) {
        self.one.rate_of_change(mode, time, state, rate, probe);
    }
}

impl<R: Real> Batch<R> for Machines<R> {
    type Machine = RotorMachine;
    type Mode = Mode<R>;

    fn gather<'a>(machine: &dyn Fn(usize) -> &'a RotorMachine) -> Self
    where
        RotorMachine: 'a,
    {
        let first = machine(0);
        for lane in 1..R::LANES {
            let shares = machine(lane).shares_lanes(first);
            assert!(shares, "lanes share states, laws and switches");
        }
        Machines::of(&|lane| &machine(lane).constants, first.layout.clone())
    }
    fn gather_mode(modes: &dyn Fn(usize) -> Mode<f64>) -> Mode<R> {
        Mode {
            levitation: R::from_lanes(|lane| modes(lane).levitation),
            thrust: R::from_lanes(|lane| modes(lane).thrust),
            brake: R::from_lanes(|lane| modes(lane).brake),
            driving: R::from_lanes(|lane| modes(lane).driving),
            loads: std::array::from_fn(|k| Vec2 {
                x: R::from_lanes(|lane| modes(lane).loads[k].x),
                y: R::from_lanes(|lane| modes(lane).loads[k].y),
            }),
            base: [0, 1].map(|axis| Piece::from_lanes(&|lane| modes(lane).base[axis])),
            outside: Outside::NONE,
            load: Piece::from_lanes(&|lane| modes(lane).load),
            drive: Piece::from_lanes(&|lane| modes(lane).drive),
            clutch: modes(0).clutch,
            unbalances: modes(0).unbalances,
            reached: modes(0).reached,
        }
    }
    #[inline(always)]
    fn rate(&self, mode: &Mode<R>, time: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
        R::vectorized(Rates {
            machines: self,
            mode,
            time,
            state,
            rate,
            probe,
        });
    }
}
