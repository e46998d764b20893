//! Temperatures of the bearing of a rig during a run, and the machine that follows them.

use crate::bearing::feedback::{FollowedBearing, Renewals, State};
use crate::bearing::warm::{self, Followed, Heated};
use model::bearing::{self, BearingConstants};
use model::bearing_heat::{Seen, WarmBearing, Warmth};
use model::heats::HEATS;
use model::system::rig::layout::DRIVE_HEAT;
use model::system::rig::{Drive, Mode, Record, RigMachine};
use number::Vec2;
use outcome::list::List;
use outcome::options::Options;
use scenario::{Bearing, Warm};
use solve::{Ending, Flow, Observer, Step};

/// The network of a bearing while it runs.
pub(crate) struct Warming<'a> {
    heated: Heated<'a>,
    warmth: Warmth,
    followed: Option<FollowedBearing>,
    state: Option<State>,
    /// The machines that it has been.
    pub renewals: Renewals<RigMachine>,
    broken: Option<(f64, String)>,
}

impl<'a> Warming<'a> {
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
    pub fn step(&mut self, machine: &RigMachine, time: f64, state: &dyn Fn(usize) -> f64) -> bool {
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
    pub fn take(&mut self, machine: &RigMachine, time: f64, state: &dyn Fn(usize) -> f64) {
        let layout = machine.layout();
        let mut heats = [0.0; HEATS];
        for (k, heat) in heats[..bearing::HEATS.len()].iter_mut().enumerate() {
            *heat = state(layout.heat(k));
        }
        if let Drive::SlidingRotor(_) = machine.constants.drive {
            // the last of both is the friction of rotor and race
            heats[HEATS - 1] = state(layout.heat(DRIVE_HEAT));
        }
        let (bearing, own_states) = (&machine.constants.bearing, layout.bearing().start);
        let seen = Seen {
            time,
            heats,
            spin: state(layout.race.spin()),
            drag_factor: bearing.drag_factor(&|own| state(own_states + own)),
            films: bearing.in_films(&|own| state(own_states + own)),
            taken: None,
            impulse: None,
        };
        self.warmth.take(self.heated.part, &seen);
    }

    /// The machine at these temperatures; none where no law holds there.
    pub fn renewed(
        &mut self,
        machine: &RigMachine,
        time: f64,
        state: &[f64],
    ) -> Option<Box<RigMachine>> {
        let followed = self.followed.as_ref()?;
        let new = followed
            .renewed(
                &mut self.state,
                (&self.warmth.temperatures, self.warmth.spin()),
                time,
            )
            .and_then(|bearing| with(machine, bearing));
        match new {
            Ok(new) => {
                let new = Box::new(new);
                let done = new.content(state).energy() - machine.content(state).energy();
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

/// The machine with another bearing; why there is none.
fn with(machine: &RigMachine, bearing: BearingConstants) -> Result<RigMachine, String> {
    let mut constants = machine.constants.clone();
    constants.bearing = bearing;
    RigMachine::new(constants).map_err(|why| why.to_string())
}

/// A record with what follows the temperatures of its bearing, and the progress of its run.
pub(crate) struct Watched<'a> {
    record: Record,
    warming: Option<Warming<'a>>,
    progress: &'a (dyn Fn(f64) + Sync),
    reported: u64,
    end: f64,
}

impl<'a> Watched<'a> {
    /// Before a run until `end`, s.
    pub fn new(
        record: Record,
        warming: Option<Warming<'a>>,
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
    pub fn finish(
        mut self,
        machine: &RigMachine,
        ending: &Ending,
    ) -> (Record, Option<Warming<'a>>, RigMachine) {
        if let Some(warming) = &mut self.warming {
            warming.take(machine, ending.time, &|channel| ending.state[channel]);
        }
        let renewals = self.warming.as_ref().map(|warming| &warming.renewals);
        let at_end = renewals.map_or(machine, |renewals| renewals.machine(machine));
        let at_end = at_end.clone();
        (self.record, self.warming, at_end)
    }
}

impl Observer<RigMachine> for Watched<'_> {
    fn step(&mut self, step: &mut Step<RigMachine>) -> Flow {
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
    fn renewed(
        &mut self,
        machine: &RigMachine,
        time: f64,
        state: &[f64],
    ) -> Option<Box<RigMachine>> {
        self.warming.as_mut()?.renewed(machine, time, state)
    }
    fn switched(
        &mut self,
        machine: &RigMachine,
        mode: &Mode<f64>,
        time: f64,
        state: &[f64],
    ) -> Flow {
        self.record.switched(machine, mode, time, state)
    }
}
