//! The rig as the solver runs it, and its start.

use super::constants::{InnerRace, RigConstants};
use super::drive::{Drive, DriveOver};
use super::housing::Housing;
use super::layout::{ARM, HOUSING, Layout};
use super::mode::{Clutch, Mode};
use super::refusal::Refusal;
use crate::bearing::ball_states::CAGE_PLACE;
use crate::bearing::{Bearing, BearingConstants, Separation};
use crate::body::put;
use crate::table::Piece;
use number::{Gather, Real, Vec2};
use solve::{Batch, Machine};

/// One rig, ready to run.
#[derive(Clone, Debug)]
pub struct RigMachine {
    /// Its constants.
    pub constants: RigConstants,
    layout: Layout,
    pub(super) one: Rig<f64>,
    /// Instants at which the load or the drive changes its line.
    landings: Vec<f64>,
    error_scale: Vec<f64>,
}

/// The system over `R`; of a rig with a clutch or a housing one machine, whose balls are computed several at a time.
#[derive(Clone, Debug)]
pub struct Rig<R: Real> {
    pub(super) race: InnerRace<R>,
    pub(super) bearing: Bearing<R>,
    pub(super) drive: DriveOver<R>,
    pub(super) housing: Option<OuterRace<R>>,
    /// Whether both races stay in the middle.
    pub(super) concentric: bool,
    /// Cage speed per speed of the inner race when the balls roll.
    pub(super) rolling_cage_ratio: R,
    pub(super) layout: Layout,
}

/// A housing over `R`.
#[derive(Clone, Debug)]
pub(super) struct OuterRace<R> {
    pub constants: Housing,
    /// The bearing, for what its films keep.
    pub bearing: BearingConstants,
    /// Weight of cage or rolling balls, which moves with the outer race, N.
    pub weight: Vec2<R>,
    /// 1/m of all that moves with it, 1/kg.
    pub inverse_mass: R,
}

impl RigMachine {
    /// A rig at its start.
    pub fn new(constants: RigConstants) -> Result<Self, Refusal> {
        constants.check()?;
        let layout = Layout::of(&constants);
        Ok(RigMachine {
            one: Rig::of(&|_| &constants, layout.clone()),
            landings: constants.landings(),
            error_scale: layout.error_scale(&constants),
            layout,
            constants,
        })
    }
    /// Where everything stands in the state.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }
    /// Mass that moves with the outer race, kg.
    pub(super) fn outer_mass(&self) -> f64 {
        let with_it = self.constants.bearing.mass_with_outer_race();
        (self.constants.housing.as_ref()).map_or(0.0, |housing| housing.mass + with_it)
    }
    /// The state at the start: the bearing settled under its load, given speeds at their first values. Balls roll with the shaft
    /// of a clutch, and the arm has settled under what disturbs it where that rests; else they are at rest.
    pub fn start(&self) -> Vec<f64> {
        let c = &self.constants;
        let layout = &self.layout;
        let mut state = vec![0.0; layout.dimension()];
        let own = layout.bearing();
        let load = c.race.load_direction * c.load.value(0.0);
        let with_race = match c.is_concentric() {
            true => Vec2::zero(),
            false => load + c.race.gravity * c.race.mass,
        };
        match &c.housing {
            Some(housing) if !housing.centre_held => {
                let weight = load + housing.gravity * c.bearing.mass_with_outer_race();
                let place = settle_housing(&c.bearing, weight, &mut state[own.clone()]);
                put(&mut state, HOUSING.centre(), place);
            }
            Some(_) => {
                c.bearing.settle(Vec2::zero(), &mut state[own.clone()]);
            }
            None => {
                let place = c.bearing.settle(with_race, &mut state[own.clone()]);
                put(&mut state, layout.race.centre(), place);
            }
        }
        let speed = c.start_speed();
        state[layout.race.spin()] = speed;
        state[layout.driver.spin()] = c.drive.start_speed();
        if let Some(housing) = &c.housing
            && speed == 0.0
        {
            let angle = state[layout.race.angle()];
            state[ARM] = housing.arm.disturbance.moment(angle, 0.0);
        }
        if let (Drive::Clutch(_), BearingConstants::Planar(bearing)) = (&c.drive, &c.bearing) {
            bearing.roll(&mut state[own], speed);
        }
        state
    }
    /// Inertia of balls and cage that turn with the inner race, kg m²; none where they move by their own equations.
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

impl<R: Real> Rig<R> {
    fn of<'a>(constants: &dyn Fn(usize) -> &'a RigConstants, layout: Layout) -> Self {
        let first = constants(0);
        let housing = first.housing.as_ref().map(|housing| {
            assert!(R::LANES == 1, "one housing at a time");
            let with_it = first.bearing.mass_with_outer_race();
            let weight = housing.gravity * with_it;
            OuterRace {
                constants: *housing,
                bearing: first.bearing.clone(),
                weight: Vec2::new(R::splat(weight.x), R::splat(weight.y)),
                inverse_mass: R::splat(1.0 / (housing.mass + with_it)),
            }
        });
        Rig {
            race: Gather::<R>::gather(&|lane| &constants(lane).race),
            bearing: Bearing::gather(&|lane| &constants(lane).bearing),
            drive: DriveOver::gather(&|lane| &constants(lane).drive),
            housing,
            concentric: first.is_concentric(),
            rolling_cage_ratio: R::from_lanes(|lane| constants(lane).bearing.rolling_cage_ratio()),
            layout,
        }
    }
}

impl Machine for RigMachine {
    type Mode = Mode<f64>;

    fn starts_afresh(&self) -> bool {
        // a clutch that changes changes what moves at once
        matches!(self.constants.drive, Drive::Clutch(_))
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
        self.layout.probes_with_loads()
    }
    fn watched_channels(&self) -> usize {
        // what the guard of a clutch sees
        match &self.constants.drive {
            Drive::Clutch(_) => self.layout.driver.channels().end,
            _ => 0,
        }
    }
    fn error_scale(&self, channel: usize) -> f64 {
        self.error_scale[channel]
    }
    fn channel_name(&self, channel: usize) -> String {
        self.layout.channel_name(channel)
    }
    fn start_mode(&self) -> Mode<f64> {
        let mut mode = self.constants.mode(0.0);
        if let Drive::Clutch(clutch) = &self.constants.drive
            && mode.clutch.due(&clutch.program) <= 0.0
        {
            mode.advance(self, &clutch.program, 0.0, &self.start());
        }
        mode
    }
    fn landings(&self) -> &[f64] {
        &self.landings
    }
    fn due(&self, mode: &Mode<f64>, landing: usize) -> f64 {
        match &self.constants.drive {
            Drive::Clutch(clutch) => mode.clutch.due(&clutch.program),
            _ => (self.landings().get(landing).copied()).unwrap_or(f64::INFINITY),
        }
    }
    fn transition(&self, landing: usize, mode: &mut Mode<f64>, state: &mut [f64]) {
        match &self.constants.drive {
            Drive::Clutch(clutch) => {
                let time = mode.clutch.due(&clutch.program);
                mode.advance(self, &clutch.program, time, state);
            }
            _ => *mode = self.constants.mode(self.landings[landing]),
        }
    }
    fn guard(&self, mode: &Mode<f64>, _time: f64, at: (&[f64], &[f64])) -> f64 {
        self.reserve(mode, at)
    }
    fn guard_error(&self, mode: &Mode<f64>) -> f64 {
        match mode.clutch.state {
            Clutch::Slipping { .. } => 1e-13 * self.constants.target_speed.abs(),
            Clutch::Open | Clutch::Locked => f64::INFINITY,
        }
    }
    fn cross(&self, time: f64, mode: &mut Mode<f64>, state: &mut [f64]) {
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

impl<R: Real> Batch<R> for Rig<R> {
    type Machine = RigMachine;
    type Mode = Mode<R>;

    fn gather<'a>(machine: &dyn Fn(usize) -> &'a RigMachine) -> Self
    where
        RigMachine: 'a,
    {
        let first = machine(0);
        let kind = |machine: &RigMachine| std::mem::discriminant(&machine.constants.drive);
        for lane in 1..R::LANES {
            let other = machine(lane);
            assert!(other.layout == first.layout, "lanes share their layout");
            assert!(kind(other) == kind(first), "lanes share the kind of drive");
        }
        Rig::of(&|lane| &machine(lane).constants, first.layout.clone())
    }
    fn gather_mode(modes: &dyn Fn(usize) -> Mode<f64>) -> Mode<R> {
        let piece = |of: &dyn Fn(Mode<f64>) -> Piece<f64>| Piece {
            start: R::from_lanes(|lane| of(modes(lane)).start),
            value: R::from_lanes(|lane| of(modes(lane)).value),
            slope: R::from_lanes(|lane| of(modes(lane)).slope),
        };
        Mode {
            load: piece(&|mode| mode.load),
            drive: piece(&|mode| mode.drive),
            clutch: modes(0).clutch,
        }
    }
    #[inline(always)]
    fn rate(&self, mode: &Mode<R>, time: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
        self.rate_of_change(mode, time, state, rate, probe);
    }
}
