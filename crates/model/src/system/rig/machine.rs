//! The rig as the solver runs it: one rig, its start, and its segments.

use super::constants::RigConstants;
use super::layout::{self, Layout};
use super::mode::Mode;
use super::refusal::RigRefusal;
use crate::bearing::ball_states::CAGE_PLACE;
use crate::bearing::{Bearing, BearingConstants, Separation};
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
    /// Name of a channel of the state.
    pub fn channel_name(&self, channel: usize) -> String {
        self.layout.channel_name(channel)
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
            state[layout::HOUSING] = place.x;
            state[layout::HOUSING + 1] = place.y;
        }
        state[layout::SHAFT + 1] = c.program.start.shaft_speed;
        state[layout::FLYWHEEL + 1] = c.program.start.flywheel_speed;
        if c.program.start.shaft_speed == 0.0 {
            state[layout::ARM] = c.arm.disturbance.moment(state[layout::SHAFT], 0.0);
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
    /// The rig from an instant on in a mode that stays.
    pub fn segment(&self, mode: Mode) -> Segment<'_> {
        Segment { rig: self, mode }
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

/// A rig in a mode that stays: what the solver integrates between two instants.
#[derive(Clone, Copy, Debug)]
pub struct Segment<'a> {
    /// The rig.
    pub rig: &'a RigMachine,
    /// Its mode.
    pub mode: Mode,
}

impl Machine for Segment<'_> {
    type Mode = Mode;

    fn dimension(&self) -> usize {
        self.rig.layout.dimension()
    }
    fn quadratures(&self) -> usize {
        self.rig.layout.ledger_length()
    }
    fn probes(&self) -> usize {
        self.rig.layout.probes()
    }
    fn watched_probes(&self) -> usize {
        self.rig.layout.probes_with_loads()
    }
    fn watched_channels(&self) -> usize {
        layout::FLYWHEEL + 2
    }
    fn error_scale(&self, channel: usize) -> f64 {
        self.rig.error_scale[channel]
    }
    fn channel_name(&self, channel: usize) -> String {
        self.rig.channel_name(channel)
    }
    fn start_mode(&self) -> Mode {
        self.mode
    }
    fn landings(&self) -> &[f64] {
        &[]
    }
    fn transition(&self, _landing: usize, _mode: &mut Mode, _state: &mut [f64]) {}
    fn rate(&self, mode: &Mode, time: f64, state: &[f64], rate: &mut [f64], probe: &mut [f64]) {
        let rig = self.rig;
        rig.rate_of_change(&rig.bearing, mode, time, state, rate, probe);
    }
}

/// A segment as the solver runs it; `R` is one machine whose balls are computed several at a time.
#[derive(Clone, Debug)]
pub struct SegmentRun<'a, R: Real> {
    rig: &'a RigMachine,
    bearing: Bearing<R>,
}

impl<'a, R: Real> Batch<R> for SegmentRun<'a, R> {
    type Machine = Segment<'a>;
    type Mode = Mode;

    fn gather<'b>(machine: &dyn Fn(usize) -> &'b Segment<'a>) -> Self
    where
        Segment<'a>: 'b,
    {
        assert!(R::LANES == 1, "one rig at a time");
        let rig = machine(0).rig;
        SegmentRun {
            rig,
            bearing: Bearing::gather(&|_| &rig.constants.bearing),
        }
    }
    fn gather_mode(modes: &dyn Fn(usize) -> Mode) -> Mode {
        modes(0)
    }
    #[inline(always)]
    fn rate(&self, mode: &Mode, time: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
        let time = time.lane(0);
        (self.rig).rate_of_change(&self.bearing, mode, time, state, rate, probe);
    }
}
