//! The rig as the solver runs it, and its start.

use super::clutch;
use super::constants::RigConstants;
use super::layout::{self, Layout};
use super::mode::{Clutch, Mode};
use super::refusal::RigRefusal;
use crate::bearing::ball_states::CAGE_PLACE;
use crate::bearing::{Bearing, BearingConstants, Separation};
use crate::body::put;
use number::{Real, Vec2};
use solve::{Batch, Machine};

/// One rig, ready to run.
#[derive(Clone, Debug)]
pub struct RigMachine {
    /// Its constants.
    pub constants: RigConstants,
    pub(super) layout: Layout,
    pub(super) bearing: Bearing<f64>,
    /// Cage speed per shaft speed when the balls roll.
    pub(super) rolling_cage_ratio: f64,
    /// Mass that moves with the outer race, kg.
    pub(super) moving_mass: f64,
    /// Force on it: dead weight, and weight of cage or rolling balls, N.
    pub(super) weight: Vec2<f64>,
    pub(super) error_scale: Vec<f64>,
}

impl RigMachine {
    /// A rig at its start.
    pub fn new(constants: RigConstants) -> Result<Self, RigRefusal> {
        constants.check()?;
        let layout = layout::of(&constants.bearing);
        Ok(RigMachine {
            bearing: Bearing::gather(&|_| &constants.bearing),
            rolling_cage_ratio: constants.bearing.rolling_cage_ratio(),
            moving_mass: constants.housing.mass + constants.bearing.mass_with_outer_race(),
            weight: constants.housing.load_direction * constants.housing.load
                + constants.housing.gravity * constants.bearing.mass_with_outer_race(),
            error_scale: layout::error_scale(&layout, &constants),
            layout,
            constants,
        })
    }
    /// Where everything stands in the state.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }
    /// The state at the start: the bearing settled under its load, its balls rolling with the shaft, the arm settled under what
    /// disturbs it where the shaft rests.
    pub fn start(&self) -> Vec<f64> {
        let c = &self.constants;
        let mut state = vec![0.0; self.layout.dimension()];
        let own = self.layout.bearing();
        let housing = &c.housing;
        if housing.centre_held {
            c.bearing.settle(Vec2::zero(), &mut state[own.clone()]);
        } else {
            let place = settle_housing(&c.bearing, self.weight, &mut state[own.clone()]);
            put(&mut state, layout::HOUSING.centre(), place);
        }
        state[layout::SHAFT.spin()] = c.program.start.shaft_speed;
        state[layout::FLYWHEEL.spin()] = c.program.start.flywheel_speed;
        if c.program.start.shaft_speed == 0.0 {
            state[layout::ARM] = c.arm.disturbance.moment(state[layout::SHAFT.angle()], 0.0);
        }
        if let BearingConstants::Planar(bearing) = &c.bearing {
            bearing.roll(&mut state[own], c.program.start.shaft_speed);
        }
        state
    }
    /// Inertia of balls and cage that turn with the shaft, kg m²; none where they move by their own equations.
    pub(super) fn rolling_inertia(&self) -> f64 {
        match &self.constants.bearing {
            BearingConstants::Rolling(bearing) => bearing.set.inner_inertia(),
            BearingConstants::Planar(_) => 0.0,
        }
    }
}

/// Settles a bearing whose inner race is fixed at the origin under a force on its outer race; returns where the outer
/// race stands, m.
fn settle_housing(bearing: &BearingConstants, force: Vec2<f64>, state: &mut [f64]) -> Vec2<f64> {
    // the outer race at the origin, the inner one pushed the other way; then all of it moved back
    let place = -bearing.settle(-force, state);
    if let BearingConstants::Planar(planar) = bearing {
        for j in 0..planar.balls {
            let mut ball = planar.motion(state, j);
            let (sine, cosine) = ball.azimuth.sin_cos();
            let radial = Vec2::new(cosine, sine);
            let centre = radial * ball.radius + place;
            // the small angle between the old and the new direction
            ball.azimuth += radial.cross(centre).atan2(radial.dot(centre));
            ball.radius = centre.length_squared().sqrt();
            planar.set_motion(state, j, &ball);
        }
        if let Separation::FreeCage(_) = planar.separation {
            state[CAGE_PLACE] += place.x;
            state[CAGE_PLACE + 1] += place.y;
        }
    }
    place
}

impl Machine for RigMachine {
    type Mode = Mode;
    const STARTS_AFRESH: bool = true;

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
        self.layout.probes_with_loads()
    }
    fn watched_channels(&self) -> usize {
        layout::FLYWHEEL.channels().end
    }
    fn error_scale(&self, channel: usize) -> f64 {
        self.error_scale[channel]
    }
    fn channel_name(&self, channel: usize) -> String {
        self.layout.channel_name(channel)
    }
    fn start_mode(&self) -> Mode {
        let mut mode = Mode::idle();
        if mode.due(&self.constants.program) <= 0.0 {
            mode.advance(self, 0.0, &self.start());
        }
        mode
    }
    fn due(&self, mode: &Mode, _landing: usize) -> f64 {
        mode.due(&self.constants.program)
    }
    fn transition(&self, _landing: usize, mode: &mut Mode, state: &mut [f64]) {
        let time = mode.due(&self.constants.program);
        mode.advance(self, time, state);
    }
    fn guard(&self, mode: &Mode, _time: f64, at: (&[f64], &[f64])) -> f64 {
        clutch::reserve(mode, at)
    }
    fn guard_error(&self, mode: &Mode) -> f64 {
        match mode.clutch {
            Clutch::Slipping { .. } => 1e-13 * self.constants.target_speed.abs(),
            Clutch::Open | Clutch::Locked => f64::INFINITY,
        }
    }
    fn cross(&self, time: f64, mode: &mut Mode, state: &mut [f64]) {
        self.change_clutch(time, mode, state);
    }
    fn rate(&self, mode: &Mode, time: f64, state: &[f64], rate: &mut [f64], probe: &mut [f64]) {
        self.rate_of_change(&self.bearing, mode, time, state, rate, probe);
    }
}

/// A rig as the solver runs it; `R` is one machine whose balls are computed several at a time.
#[derive(Clone, Debug)]
pub struct Rig<R: Real> {
    machine: RigMachine,
    bearing: Bearing<R>,
}

impl<R: Real> Batch<R> for Rig<R> {
    type Machine = RigMachine;
    type Mode = Mode;

    fn gather<'a>(machine: &dyn Fn(usize) -> &'a RigMachine) -> Self
    where
        RigMachine: 'a,
    {
        assert!(R::LANES == 1, "one rig at a time");
        let machine = machine(0).clone();
        Rig {
            bearing: Bearing::gather(&|_| &machine.constants.bearing),
            machine,
        }
    }
    fn gather_mode(modes: &dyn Fn(usize) -> Mode) -> Mode {
        modes(0)
    }
    #[inline(always)]
    fn rate(&self, mode: &Mode, time: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
        let time = time.lane(0);
        (self.machine).rate_of_change(&self.bearing, mode, time, state, rate, probe);
    }
}
