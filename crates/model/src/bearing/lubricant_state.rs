//! The slow state of the lubricant of a bearing, whatever its fidelity: three states behind those of cage and balls.
//!
//! ```text
//!   0  b   build-up of the grease    1   ḃ = T |ω| (1 - b)/φ_b - (1 - T) b/τ_r       ω: cage against outer ring
//!   1  w   its breakdown             1   ẇ = T (1 - w)/τ_w     - (1 - T) w/τ_r       T = ω²/(ω² + ω_q²)
//!   2  Θ   rise of contact films     K   C Θ̇ = P - G Θ       P = sliding at both races + steady moment + inlet rolling
//!
//!   the steady moment becomes  D M0 + M1      D = [g_0 + (1-g_0) b] [1 - (1-g_w) w] e^(-k_D Θ)
//!   the traction coefficient   F μ            F = e^(-k_T Θ)
//! ```
//! The laws stand in [`lubricant_state`](physics::lubricant_state). D and F multiply what acts on a ball and on a ring in
//! opposite directions alike, so every pair stays a pair and every heat stays not negative. P is made of heats that stand
//! in the ledger already: Θ stores nothing mechanical, and neither energy nor momentum notices these states. Of that heat the
//! films keep C Θ̇; the rest, P - C Θ̇ = G Θ, flows into balls and races, on a rig into its node.
//!
//! Where the balls roll, no traction is computed: F has no effect. A bearing without a steady moment has no D.
//!
//! A bearing without this part has none of these states and pays nothing.
//!
//! Assumes: one state for all contacts. Does not model: places; see the laws for the rest.

use super::reaction::BearingHeat;
use number::{Gather, Real, Vectorized};
use physics::lubricant_state::{FilmHeating, Grease};
use physics::traction::{SlidingContact, Traction, TractionLaw};

/// Number of states.
pub const STATES: usize = 3;
/// Names of the states, after `bearing.`.
pub const STATE_NAMES: [&str; STATES] = [
    "lubricant.build_up",
    "lubricant.breakdown",
    "lubricant.film_temperature_rise",
];
/// Place of the build-up among the states.
const BUILD_UP: usize = 0;
/// Place of the breakdown.
const BREAKDOWN: usize = 1;
/// Place of the films' temperature rise.
const FILM_RISE: usize = 2;
/// Rise whose tolerated error equals that of a share between 0 and 1, K: drag changes by some percent a kelvin.
const RISE_SCALE: f64 = 10.0;

/// The lubricant of one bearing: what of it changes, and from where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LubricantConstants {
    /// A grease that builds up and breaks down; none for a lubricant whose drag is that of the law.
    pub grease: Option<Grease<f64>>,
    /// Contact films that warm; none where they keep the temperature of the law.
    pub films: Option<FilmHeating<f64>>,
    /// Build-up b at the start, 0 to 1.
    pub build_up: f64,
    /// Breakdown w at the start, 0 to 1.
    pub breakdown: f64,
}

/// The lubricant at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LubricantAt {
    /// Build-up b, 0 to 1.
    pub build_up: f64,
    /// Breakdown w, 0 to 1.
    pub breakdown: f64,
    /// Rise Θ of the contact films above the bulk, K.
    pub film_temperature_rise: f64,
    /// Drag factor D.
    pub drag_factor: f64,
    /// Traction factor F.
    pub traction_factor: f64,
}

impl LubricantConstants {
    /// True where the parameters have a meaning and the start lies between 0 and 1.
    pub fn is_valid(&self) -> bool {
        let share = |x: f64| (0.0..=1.0).contains(&x);
        share(self.build_up)
            && share(self.breakdown)
            && self.grease.is_none_or(|grease| grease.is_valid())
            && self.films.is_none_or(|films| films.is_valid())
    }
    /// Power that warms the films and stays there, W: C Θ̇ of the rates of its own states.
    pub(super) fn kept_by_films<R: Real>(&self, rate: &[R]) -> R {
        let capacity = self.films.map_or(0.0, |films| films.heat_capacity);
        rate[FILM_RISE] * R::splat(capacity)
    }
    /// The lubricant in its own states.
    pub fn at(&self, state: &[f64]) -> LubricantAt {
        let factors = Lubricant::<f64>::of(&|_| self).factors(state);
        LubricantAt {
            build_up: state[BUILD_UP],
            breakdown: state[BREAKDOWN],
            film_temperature_rise: state[FILM_RISE],
            drag_factor: factors.drag,
            traction_factor: factors.traction.unwrap_or(1.0),
        }
    }
    /// Writes the states at the start.
    pub(super) fn rest(&self, state: &mut [f64]) {
        state[BUILD_UP] = self.build_up;
        state[BREAKDOWN] = self.breakdown;
        state[FILM_RISE] = 0.0;
    }
    /// The magnitudes that matter.
    pub(super) fn error_scale(scale: &mut [f64]) {
        scale.fill(1.0);
        scale[FILM_RISE] = RISE_SCALE;
    }
}

/// The lubricant over `R`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lubricant<R> {
    grease: Option<Grease<R>>,
    films: Option<FilmHeating<R>>,
}

/// What the lubricant does to the laws.
#[derive(Clone, Copy, Debug)]
pub(super) struct Factors<R> {
    /// D.
    pub drag: R,
    /// F, where films warm.
    pub traction: Option<R>,
}

impl<R: Real> Lubricant<R> {
    /// One lubricant per lane; none where it has no state.
    pub fn gather<'a>(machine: &dyn Fn(usize) -> Option<&'a LubricantConstants>) -> Option<Self> {
        let present = machine(0).is_some();
        for lane in 1..R::LANES {
            let same = machine(lane).is_some() == present;
            assert!(same, "lanes share whether the lubricant has a state");
        }
        present.then(|| Self::of(&|lane| machine(lane).expect("lanes share it")))
    }

    fn of<'a>(machine: &dyn Fn(usize) -> &'a LubricantConstants) -> Self {
        let first = machine(0);
        for lane in 1..R::LANES {
            let other = machine(lane);
            let same = other.grease.is_some() == first.grease.is_some()
                && other.films.is_some() == first.films.is_some();
            assert!(same, "lanes share what of the lubricant changes");
        }
        Lubricant {
            grease: Gather::<R>::gather(&|lane| &machine(lane).grease),
            films: Gather::<R>::gather(&|lane| &machine(lane).films),
        }
    }

    #[inline(always)]
    fn factors(&self, state: &[R]) -> Factors<R> {
        let of_grease = match &self.grease {
            Some(grease) => grease.drag_factor(state[BUILD_UP], state[BREAKDOWN]),
            None => R::one(),
        };
        match &self.films {
            Some(films) => Factors {
                drag: of_grease * films.drag_factor(state[FILM_RISE]),
                traction: Some(films.traction_factor(state[FILM_RISE])),
            },
            None => Factors {
                drag: of_grease,
                traction: None,
            },
        }
    }

    #[inline(always)]
    fn rates(&self, cage_speed: R, film_heat: R, state: &[R], rate: &mut [R]) {
        let [mut built, mut worked, mut warmed] = [R::zero(); STATES];
        if let Some(grease) = &self.grease {
            built = grease.build_up_rate(state[BUILD_UP], cage_speed);
            worked = grease.breakdown_rate(state[BREAKDOWN], cage_speed);
        }
        if let Some(films) = &self.films {
            warmed = films.rise_rate(state[FILM_RISE], film_heat);
        }
        rate[BUILD_UP] = built;
        rate[BREAKDOWN] = worked;
        rate[FILM_RISE] = warmed;
    }
}

/// The kinds of heat that warm the films: those of `film_heat`.
pub const FILM_KINDS: [&str; 4] = [
    "inner_ball_slip",
    "outer_ball_slip",
    "steady_moment",
    "inlet_rolling",
];

/// Power that warms the films, W: what is made where lubricant is sheared between balls and races.
#[inline(always)]
pub(super) fn film_heat<R: Real>(heat: &BearingHeat<R>) -> R {
    heat.inner_sliding + heat.outer_sliding + heat.steady_moment + heat.inlet_rolling
}

/// The factors as a task.
pub(super) struct Act<'a, R: Real> {
    pub lubricant: &'a Lubricant<R>,
    /// The lubricant's own.
    pub state: &'a [R],
}

impl<R: Real> Vectorized for Act<'_, R> {
    type Output = Factors<R>;
    #[inline(always)]
    fn run(self) -> Factors<R> {
        self.lubricant.factors(self.state)
    }
}

/// The rates as a task.
pub(super) struct Change<'a, R: Real> {
    pub lubricant: &'a Lubricant<R>,
    /// Of the cage against the outer ring.
    pub cage_speed: R,
    /// Power that warms the films, W: of [`film_heat`].
    pub film_heat: R,
    /// The lubricant's own.
    pub state: &'a [R],
    /// The lubricant's own.
    pub rate: &'a mut [R],
}

impl<R: Real> Vectorized for Change<'_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        (self.lubricant).rates(self.cage_speed, self.film_heat, self.state, self.rate);
    }
}

/// A traction law between warmed films. Where nothing warms, the law as it is.
pub(super) struct Warmed<'a, R> {
    pub law: &'a Traction<R>,
    /// F.
    pub factor: Option<R>,
}

impl<R: Real> TractionLaw<R> for Warmed<'_, R> {
    #[inline(always)]
    fn at_races(&self, inner: &SlidingContact<R>, outer: &SlidingContact<R>) -> (R, R) {
        let (inner, outer) = self.law.at_races(inner, outer);
        match self.factor {
            Some(factor) => (inner * factor, outer * factor),
            None => (inner, outer),
        }
    }
}
