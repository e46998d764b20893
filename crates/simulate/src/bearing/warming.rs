//! How warm the one bearing of a run becomes, and what of it follows: of a spin-up, and of a test on a rig.

use crate::bearing::feedback::{FollowedBearing, Renewals, State};
use crate::bearing::warm::{self, Followed, Heated};
use model::bearing::{self, BearingConstants};
use model::bearing_heat::{Seen, WarmBearing, Warmth};
use model::heats::HEATS;
use model::system::energy::Content;
use model::system::rig::RigMachine;
use model::system::rig::layout::SHAFT;
use model::system::spin_up::SpinUpMachine;
use model::system::spin_up::layout::INNER;
use number::Vec2;
use outcome::list::List;
use outcome::options::Options;
use scenario::{Bearing, Warm};
use solve::{Ending, Flow, Machine, Observer, Step};

/// A machine with one bearing whose temperatures are followed.
pub(crate) trait Warms: Machine + Clone {
    /// Heats of the bearing in a state, J, in the order of [`bearing::HEATS`]: their first channel.
    fn first_heat(&self) -> usize;
    /// Friction of rotor and race in a state, J; none where nothing rubs on the race.
    fn rubbing(&self) -> Option<usize>;
    /// Channel of the spin of the inner race, rad/s.
    fn spin(&self) -> usize;
    /// The bearing, and where its own states begin.
    fn bearing(&self) -> (&BearingConstants, usize);
    /// The machine with another bearing; why there is none.
    fn with(&self, bearing: BearingConstants) -> Result<Self, String>;
    /// What it holds in a state.
    fn held(&self, state: &[f64]) -> Content;
}

impl Warms for SpinUpMachine {
    fn first_heat(&self) -> usize {
        self.layout().flows().start
    }
    fn rubbing(&self) -> Option<usize> {
        Some(self.first_heat() + bearing::HEATS.len())
    }
    fn spin(&self) -> usize {
        INNER.spin()
    }
    fn bearing(&self) -> (&BearingConstants, usize) {
        (&self.constants.bearing, self.layout().bearing().start)
    }
    fn with(&self, bearing: BearingConstants) -> Result<Self, String> {
        let mut constants = self.constants.clone();
        constants.bearing = bearing;
        SpinUpMachine::new(constants).map_err(|why| why.to_string())
    }
    fn held(&self, state: &[f64]) -> Content {
        self.content(state)
    }
}

impl Warms for RigMachine {
    fn first_heat(&self) -> usize {
        self.layout().flows().start
    }
    fn rubbing(&self) -> Option<usize> {
        None
    }
    fn spin(&self) -> usize {
        SHAFT.spin()
    }
    fn bearing(&self) -> (&BearingConstants, usize) {
        (&self.constants.bearing, self.layout().bearing().start)
    }
    fn with(&self, bearing: BearingConstants) -> Result<Self, String> {
        let mut constants = self.constants.clone();
        constants.bearing = bearing;
        RigMachine::new(constants).map_err(|why| why.to_string())
    }
    fn held(&self, state: &[f64]) -> Content {
        self.content(state)
    }
}

/// The network of a bearing while it runs.
pub(crate) struct Warming<'a, M> {
    heated: Heated<'a>,
    warmth: Warmth,
    followed: Option<FollowedBearing>,
    state: Option<State>,
    /// The machines that it has been.
    pub renewals: Renewals<M>,
    broken: Option<(f64, String)>,
}

impl<'a, M: Warms> Warming<'a, M> {
    /// None where its temperatures are not followed.
    pub fn of(
        given: Option<&'a Warm>,
        bearing: &'a Bearing,
        part: Option<&'a WarmBearing>,
    ) -> Option<Self> {
        let heated = Heated::of(given, bearing, part)?;
        Some(Warming {
            heated,
            warmth: Warmth::new(heated.part, true),
            followed: FollowedBearing::of(given, bearing, Vec2::zero()),
            state: None,
            renewals: Renewals::default(),
            broken: None,
        })
    }

    /// Takes note of the end of a step; whether the machine is to go on with other constants.
    pub fn step(&mut self, machine: &M, time: f64, state: &dyn Fn(usize) -> f64) -> bool {
        if !self.warmth.is_due(time) {
            return false;
        }
        self.take(machine, time, state);
        let warmth = &self.warmth;
        let moved = |followed: &FollowedBearing| {
            followed.moved(self.state, &warmth.temperatures, warmth.spin())
        };
        self.broken.is_none() && self.followed.as_ref().is_some_and(moved)
    }

    /// Lets the network take the heat until a time.
    pub fn take(&mut self, machine: &M, time: f64, state: &dyn Fn(usize) -> f64) {
        let first = machine.first_heat();
        let mut heats = [0.0; HEATS];
        for (k, heat) in heats[..bearing::HEATS.len()].iter_mut().enumerate() {
            *heat = state(first + k);
        }
        // the last of both is the friction of rotor and race
        heats[HEATS - 1] = machine.rubbing().map_or(0.0, state);
        let (bearing, own_states) = machine.bearing();
        let seen = Seen {
            time,
            heats,
            spin: state(machine.spin()),
            drag_factor: bearing.drag_factor(&|own| state(own_states + own)),
            films: bearing.in_films(&|own| state(own_states + own)),
            taken: None,
            impulse: None,
        };
        self.warmth.take(self.heated.part, &seen);
    }

    /// The machine at these temperatures; none where no law holds there.
    pub fn renewed(&mut self, machine: &M, time: f64, state: &[f64]) -> Option<Box<M>> {
        let followed = self.followed.as_ref()?;
        let new = followed
            .renewed(
                &mut self.state,
                (&self.warmth.temperatures, self.warmth.spin()),
                time,
            )
            .and_then(|bearing| machine.with(bearing));
        match new {
            Ok(new) => {
                let new = Box::new(new);
                let done = new.held(state).energy() - machine.held(state).energy();
                self.renewals.renew(new.clone(), time, done);
                Some(new)
            }
            Err(why) => {
                self.broken = Some((time, why));
                None
            }
        }
    }

    /// Names what it became, and the work of its rings; before a run what these are.
    pub fn name(list: &mut List, heated: Option<Heated>, run: Option<&Self>) {
        let Some(heated) = heated else {
            return;
        };
        warm::name(list, &heated, run.map(Warming::followed).as_ref());
        let work = run.map(|run| run.renewals.work_until(f64::INFINITY));
        warm::work_of_rings(list, &(), work.as_ref());
    }

    /// What has become of it.
    pub fn followed(&self) -> Followed<'_> {
        Followed {
            heated: self.heated,
            warmth: &self.warmth,
            state: self.state,
            broken: self.broken.as_ref(),
        }
    }
}

/// A record with what follows the temperatures of its bearing, and the progress of its run.
pub(crate) struct Watched<'a, M, K> {
    record: K,
    warming: Option<Warming<'a, M>>,
    progress: &'a (dyn Fn(f64) + Sync),
    reported: u64,
    end: f64,
}

impl<'a, M: Warms, K: Observer<M>> Watched<'a, M, K> {
    /// Before a run until `end`, s.
    pub fn new(
        record: K,
        warming: Option<Warming<'a, M>>,
        end: f64,
        options: &Options<'a>,
    ) -> Self {
        Watched {
            record,
            warming,
            progress: options.progress,
            reported: 0,
            end,
        }
    }
    /// Its parts after a run, and the machine as it is then.
    pub fn finish(mut self, machine: &M, ending: &Ending) -> (K, Option<Warming<'a, M>>, M) {
        if let Some(warming) = &mut self.warming {
            warming.take(machine, ending.time, &|channel| ending.state[channel]);
        }
        let renewals = self.warming.as_ref().map(|warming| &warming.renewals);
        let at_end = renewals.map_or(machine, |renewals| renewals.machine(machine));
        let at_end = at_end.clone();
        (self.record, self.warming, at_end)
    }
}

impl<M: Warms, K: Observer<M>> Observer<M> for Watched<'_, M, K> {
    fn step(&mut self, step: &mut Step<M>) -> Flow {
        let thousandths = (1000.0 * step.end / self.end) as u64;
        if thousandths > self.reported {
            (self.progress)(thousandths as f64 * 1e-3);
            self.reported = thousandths;
        }
        let flow = self.record.step(step);
        let warms = (self.warming.as_mut()).is_some_and(|warming| {
            warming.step(step.machine, step.end, &|channel| step.end_state(channel))
        });
        match flow {
            Flow::Continue if warms => Flow::Renew,
            flow => flow,
        }
    }
    fn renewed(&mut self, machine: &M, time: f64, state: &[f64]) -> Option<Box<M>> {
        self.warming.as_mut()?.renewed(machine, time, state)
    }
    fn switched(&mut self, machine: &M, mode: &M::Mode, time: f64, state: &[f64]) -> Flow {
        self.record.switched(machine, mode, time, state)
    }
}
