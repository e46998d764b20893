//! Initial value problems with known answers, and observers that keep what they see.

use number::Real;
use solve::{Batch, Ending, Flow, Machine, Observer, Scheme, Settings, Step};
use std::sync::atomic::AtomicBool;

/// A rate over `f64`: (mode, time, state, rate, probe).
pub type Rate = fn(&f64, f64, &[f64], &mut [f64], &mut [f64]);

/// A problem given by its right-hand side. Every error scale is one, the mode is a number.
#[derive(Clone)]
pub struct Problem {
    /// Number of channels.
    pub dimension: usize,
    /// Number of last channels that the rate does not depend on.
    pub quadratures: usize,
    /// Number of probes.
    pub probes: usize,
    /// The right-hand side.
    pub rate: Rate,
    /// Instants to land on.
    pub landings: Vec<f64>,
    /// What happens there: (landing, mode, state).
    pub transition: fn(usize, &mut f64, &mut [f64]),
}

impl Problem {
    /// A problem without landings.
    pub fn new(dimension: usize, probes: usize, rate: Rate) -> Self {
        Problem {
            dimension,
            quadratures: 0,
            probes,
            rate,
            landings: Vec::new(),
            transition: |_, _, _| {},
        }
    }

    /// ẏ = -2 t y²: from y(0) = 1 follows y = 1/(1 + t²).
    pub fn bell() -> Self {
        Problem::new(1, 0, |_, t, y, rate, _| rate[0] = -2.0 * t * y[0] * y[0])
    }

    /// A planet on an ellipse about the origin, gravitational parameter 1: state x, y, ẋ, ẏ.
    pub fn kepler() -> Self {
        Problem::new(4, 0, |_, _, y, rate, _| {
            let cube = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
            rate.copy_from_slice(&[y[2], y[3], -y[0] / cube, -y[1] / cube]);
        })
    }

    /// A unit mass above a linear spring: state height and its rate; probes penetration and spring force.
    pub fn bouncing_mass() -> Self {
        Problem::new(2, 2, |_, _, y, rate, probe| {
            let penetration = -y[0];
            let force = (BOUNCE_STIFFNESS * penetration).max(0.0);
            rate[0] = y[1];
            rate[1] = force - BOUNCE_GRAVITY;
            if !probe.is_empty() {
                probe[0] = penetration;
                probe[1] = force;
            }
        })
    }
}

/// Stiffness under the bouncing mass.
pub const BOUNCE_STIFFNESS: f64 = 1e4;
/// Gravity on the bouncing mass.
pub const BOUNCE_GRAVITY: f64 = 9.81;

impl Machine for Problem {
    type Mode = f64;
    fn dimension(&self) -> usize {
        self.dimension
    }
    fn quadratures(&self) -> usize {
        self.quadratures
    }
    fn probes(&self) -> usize {
        self.probes
    }
    fn error_scale(&self, _channel: usize) -> f64 {
        1.0
    }
    fn channel_name(&self, channel: usize) -> String {
        format!("y{channel}")
    }
    fn start_mode(&self) -> f64 {
        1.0
    }
    fn landings(&self) -> &[f64] {
        &self.landings
    }
    fn transition(&self, landing: usize, mode: &mut f64, state: &mut [f64]) {
        (self.transition)(landing, mode, state);
    }
    fn rate(&self, mode: &f64, time: f64, state: &[f64], rate: &mut [f64], probe: &mut [f64]) {
        (self.rate)(mode, time, state, rate, probe);
    }
}

/// A problem as a batch of one.
pub struct Alone<M>(M);

impl<M: Machine + Clone> Batch<f64> for Alone<M> {
    type Machine = M;
    type Mode = M::Mode;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a M) -> Self
    where
        M: 'a,
    {
        Alone(machine(0).clone())
    }
    fn gather_mode(modes: &dyn Fn(usize) -> M::Mode) -> M::Mode {
        modes(0)
    }
    #[inline(always)]
    fn rate(&self, mode: &M::Mode, time: f64, state: &[f64], rate: &mut [f64], probe: &mut [f64]) {
        self.0.rate(mode, time, state, rate, probe);
    }
}

/// Runs one problem by itself.
pub fn run_alone<O: Observer<Problem>>(
    problem: &Problem,
    start: &[f64],
    observer: &mut O,
    settings: &Settings,
) -> Ending {
    let interrupt = AtomicBool::new(false);
    run_until(problem, start, observer, settings, &interrupt)
}

/// The state at the end of one problem by itself, by a scheme.
pub fn end_by(scheme: &Scheme, problem: &Problem, start: &[f64], settings: &Settings) -> Vec<f64> {
    let interrupt = AtomicBool::new(false);
    let mut endings = solve::run::<f64, Alone<Problem>, Blind>(
        scheme,
        &[problem],
        &[start.to_vec()],
        &mut [Blind],
        settings,
        &interrupt,
    );
    endings.remove(0).state
}

/// Runs one problem by itself, until somebody asks to stop.
pub fn run_until<O: Observer<Problem>>(
    problem: &Problem,
    start: &[f64],
    observer: &mut O,
    settings: &Settings,
    interrupt: &AtomicBool,
) -> Ending {
    solve::run::<f64, Alone<Problem>, O>(
        &solve::BOGACKI_SHAMPINE,
        &[problem],
        &[start.to_vec()],
        std::slice::from_mut(observer),
        settings,
        interrupt,
    )
    .remove(0)
}

/// Error control at a tolerance, from 0 to an end.
pub fn adaptive(end: f64, tolerance: f64) -> Settings {
    Settings {
        start: 0.0,
        end,
        tolerance,
        first_step: 1e-4,
        largest_step: f64::INFINITY,
        step_limit: 1_000_000,
    }
}

/// Equal steps: the tolerance accepts whatever comes.
pub fn equal_steps(start: f64, end: f64, count: u32) -> Settings {
    let length = (end - start) / f64::from(count);
    Settings {
        start,
        end,
        tolerance: 1e6,
        first_step: length,
        largest_step: length,
        step_limit: u64::MAX,
    }
}

/// Watches nothing.
pub struct Blind;

impl<M: Machine> Observer<M> for Blind {
    fn step(&mut self, _step: &mut Step<M>) -> Flow {
        Flow::Continue
    }
}

/// Keeps start and end of every step.
#[derive(Default)]
pub struct Log {
    /// (start, end) of every step.
    pub steps: Vec<(f64, f64)>,
}

impl<M: Machine> Observer<M> for Log {
    fn step(&mut self, step: &mut Step<M>) -> Flow {
        self.steps.push((step.start, step.end));
        Flow::Continue
    }
}

/// The Van der Pol oscillator ẍ = μ(1 - x²)ẋ - x + push; the push, a mode, starts at one and changes its sign
/// at each landing. Written once for every number type.
#[derive(Clone)]
pub struct VanDerPol {
    /// μ.
    pub stiffness: f64,
    /// Instants at which the push changes its sign.
    pub landings: Vec<f64>,
}

/// Van der Pol oscillators side by side.
pub struct VanDerPols<R> {
    stiffness: R,
}

#[inline(always)]
fn van_der_pol<R: Real>(stiffness: R, push: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
    let (x, v) = (state[0], state[1]);
    rate[0] = v;
    rate[1] = stiffness * (R::one() - x.square()) * v - x + push;
    if !probe.is_empty() {
        probe[0] = x;
    }
}

impl Machine for VanDerPol {
    type Mode = f64;
    fn dimension(&self) -> usize {
        2
    }
    fn probes(&self) -> usize {
        1
    }
    fn error_scale(&self, channel: usize) -> f64 {
        [1.0, 2.0][channel]
    }
    fn channel_name(&self, channel: usize) -> String {
        ["x", "v"][channel].to_string()
    }
    fn start_mode(&self) -> f64 {
        1.0
    }
    fn landings(&self) -> &[f64] {
        &self.landings
    }
    fn transition(&self, _landing: usize, mode: &mut f64, _state: &mut [f64]) {
        *mode = -*mode;
    }
    fn rate(&self, mode: &f64, _time: f64, state: &[f64], rate: &mut [f64], probe: &mut [f64]) {
        van_der_pol(self.stiffness, *mode, state, rate, probe);
    }
}

impl<R: Real> Batch<R> for VanDerPols<R> {
    type Machine = VanDerPol;
    type Mode = R;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a VanDerPol) -> Self
    where
        VanDerPol: 'a,
    {
        VanDerPols {
            stiffness: R::from_lanes(|lane| machine(lane).stiffness),
        }
    }
    fn gather_mode(modes: &dyn Fn(usize) -> f64) -> R {
        R::from_lanes(modes)
    }
    #[inline(always)]
    fn rate(&self, mode: &R, _time: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
        van_der_pol(self.stiffness, *mode, state, rate, probe);
    }
}
