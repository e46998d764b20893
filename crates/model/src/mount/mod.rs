//! The mount of an outer race: parts side by side between race and housing.
//!
//! ```text
//!   ground ──/\/\/──┬── housing ──/\/\/──┬── outer race     s = c_o - h,  v = its rate
//!          ──[  ]───┘           ──[  ]───┤                 spring and damper  F = -k (s - c_0) - c v
//!                               ──/\/[ ]─┤ ...             Maxwell branches   maxwell
//!                               ─ ring ──┤                 friction ring      friction_ring
//!                               ─ film ──┤                 squeeze film       squeeze_film
//!                               ─  |gap|─┘                 hard stop          hard_stop
//!   m_h ḧ = -(F without preload) - k_h h - c_h ḣ           without a housing h = 0
//! ```
//! c_0 is chosen so that the weight of the bearing is balanced at c_o = 0; a mount without a spring carries it by a force that
//! does not yield. States: d of each branch, e of the ring, h and ḣ of the housing. All start at rest.
//!
//! Source: derived; book/src/theory/drop.md, mounts. Assumes: isotropic, massless but for the housing. Does not model: a housing that several
//! bearings share, tilt.

pub mod friction_ring;
pub mod hard_stop;
pub mod maxwell;
pub mod squeeze_film;

pub use friction_ring::FrictionRing;
pub use hard_stop::HardStop;
pub use maxwell::MaxwellBranch;
use number::{Gather, Real, Vec2, constants};
use squeeze_film::Film;
pub use squeeze_film::SqueezeFilm;

constants! {
    /// A spring with a damper between outer race and housing.
    pub struct Mount {
        /// Stiffness k, N/m.
        stiffness: R,
        /// Damping c, N s/m.
        damping: R,
        /// Position of the outer race at which the spring is free, m.
        free_position: Vec2<R>,
    }
}

impl<R: Real> Mount<R> {
    /// Force on the outer race, N.
    #[inline(always)]
    pub fn force(&self, position: Vec2<R>, velocity: Vec2<R>) -> Vec2<R> {
        -((position - self.free_position) * self.stiffness + velocity * self.damping)
    }
    /// Heat made per second, W.
    #[inline(always)]
    pub fn heat(&self, velocity: Vec2<R>) -> R {
        self.damping * velocity.length_squared()
    }
    /// Energy in the spring, J.
    #[inline(always)]
    pub fn energy(&self, position: Vec2<R>) -> R {
        R::splat(0.5) * self.stiffness * (position - self.free_position).length_squared()
    }
}

/// Dynamic stiffness K' + jK'' of a part whose force on the race is -K s under s ~ e^{jωt}, N/m; K'' ≥ 0 takes energy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DynamicStiffness {
    /// K', in phase with the displacement.
    pub storage: f64,
    /// K'', in phase with the velocity.
    pub loss: f64,
}

impl std::ops::Add for DynamicStiffness {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            storage: self.storage + other.storage,
            loss: self.loss + other.loss,
        }
    }
}

impl DynamicStiffness {
    /// Of this and another part in series, as race, mount and a housing that yields are: K Z/(K + Z).
    pub fn in_series(self, other: Self) -> Self {
        let (a, b, c, d) = (self.storage, self.loss, other.storage, other.loss);
        let square = (a + c) * (a + c) + (b + d) * (b + d);
        Self {
            storage: ((a * c - b * d) * (a + c) + (a * d + b * c) * (b + d)) / square,
            loss: ((a * d + b * c) * (a + c) - (a * c - b * d) * (b + d)) / square,
        }
    }
}

impl Mount<f64> {
    /// Dynamic stiffness at a frequency ω (rad/s): k + jωc.
    pub fn dynamic_stiffness(&self, frequency: f64) -> DynamicStiffness {
        DynamicStiffness {
            storage: self.stiffness,
            loss: frequency * self.damping,
        }
    }
}

impl Housing<f64> {
    /// Dynamic stiffness at a frequency ω (rad/s), to ground: k - mω² + jωc.
    pub fn dynamic_stiffness(&self, frequency: f64) -> DynamicStiffness {
        DynamicStiffness {
            storage: self.stiffness - self.mass * frequency * frequency,
            loss: frequency * self.damping,
        }
    }
}

constants! {
    /// A housing that yields.
    pub struct Housing {
        /// Mass m_h, kg.
        mass: R,
        /// Stiffness k_h to ground, N/m.
        stiffness: R,
        /// Damping c_h to ground, N s/m.
        damping: R,
    }
}

/// What a mount has besides its spring and damper.
#[derive(Clone, Debug, PartialEq)]
pub struct MountParts {
    /// Maxwell branches.
    pub branches: Vec<MaxwellBranch<f64>>,
    /// Friction ring.
    pub ring: Option<FrictionRing<f64>>,
    /// Squeeze film.
    pub film: Option<SqueezeFilm<f64>>,
    /// Hard stop.
    pub stop: Option<HardStop<f64>>,
    /// A housing of its own; ground without.
    pub housing: Option<Housing<f64>>,
    /// Row φ of the housing of the machine on which it stands, beside bearings and magnets; ground without.
    pub on: Option<Vec<f64>>,
    /// Force on the race that does not yield, N: it carries the weight where no spring does.
    pub preload: Vec2<f64>,
}

impl MountParts {
    /// Nothing besides spring and damper.
    pub const NONE: MountParts = MountParts {
        branches: Vec::new(),
        ring: None,
        film: None,
        stop: None,
        housing: None,
        on: None,
        preload: Vec2 { x: 0.0, y: 0.0 },
    };
    /// Whether there is anything besides spring and damper.
    pub fn any(&self) -> bool {
        *self
            != MountParts {
                preload: self.preload,
                ..Self::NONE
            }
    }
    /// Dynamic stiffness at a frequency ω (rad/s) of what is linear between race and housing: spring, damper and Maxwell branches.
    pub fn linear(&self, spring: &Mount<f64>, frequency: f64) -> DynamicStiffness {
        let branches = self.branches.iter();
        branches.fold(spring.dynamic_stiffness(frequency), |sum, branch| {
            sum + branch.dynamic_stiffness(frequency)
        })
    }
    /// What of it is not linear.
    pub fn not_linear(&self) -> Vec<&'static str> {
        let all = [
            (self.ring.is_some(), "friction ring"),
            (self.film.is_some(), "squeeze film"),
            (self.stop.is_some(), "hard stop"),
        ];
        let present = all.into_iter().filter(|(present, _)| *present);
        present.map(|(_, name)| name).collect()
    }
    /// Names of its states.
    pub fn state_names(&self) -> Vec<String> {
        let mut names = Vec::new();
        let mut of = |what: &str, kinds: &[&str]| {
            names.extend(kinds.iter().map(|kind| format!("mount.{what}.{kind}")));
        };
        for k in 1..=self.branches.len() {
            of(&format!("branch_{k}"), &["x", "y"]);
        }
        if self.ring.is_some() {
            of("ring", &["x", "y"]);
        }
        if self.housing.is_some() {
            of("housing", &["x", "y", "x_speed", "y_speed"]);
        }
        names
    }
    /// The magnitude that matters in each state, from those of a length (m) and a speed (m/s).
    pub fn error_scale(&self, scale: &mut [f64], length: f64, speed: f64) {
        scale.fill(length);
        if self.housing.is_some() {
            let count = scale.len();
            scale[count - 2..].fill(speed);
        }
    }
}

/// Kinds of heat of a mount, for inspection; the ledger counts their sum.
pub const HEATS: [&str; 6] = ["damper", "branches", "ring", "film", "stop", "housing"];

/// What a mount does.
#[derive(Clone, Copy, Debug)]
pub struct MountReaction<R> {
    /// Force on the outer race with the preload, N.
    pub force: Vec2<R>,
    /// Heat of each kind of [`HEATS`], W.
    pub heats: [R; HEATS.len()],
}

impl<R: Real> MountReaction<R> {
    /// A force that comes without heat, N.
    #[inline(always)]
    pub fn of(force: Vec2<R>) -> Self {
        MountReaction {
            force,
            heats: [R::zero(); HEATS.len()],
        }
    }
    /// All heat, W.
    #[inline(always)]
    pub fn heat(&self) -> R {
        let [damper, rest @ ..] = self.heats;
        rest.into_iter().fold(damper, |sum, heat| sum + heat)
    }
}

/// What the parts of a mount do; zero of what it lacks.
#[derive(Clone, Copy, Debug)]
pub struct PartsAt<R> {
    /// Force of the friction ring on the outer race, N.
    pub ring: Vec2<R>,
    /// Force of the squeeze film on the outer race, N.
    pub film: Vec2<R>,
    /// Force of the hard stop on the outer race, N.
    pub stop: Vec2<R>,
    /// Displacement, m, and velocity, m/s, of the housing.
    pub housing: [Vec2<R>; 2],
}

/// A mount with all its parts over `R`.
#[derive(Clone, Debug)]
pub struct WholeMount<R: Real> {
    /// Spring and damper.
    pub(crate) spring: Mount<R>,
    branches: Vec<MaxwellBranch<R>>,
    ring: Option<FrictionRing<R>>,
    film: Option<Film<R>>,
    stop: Option<HardStop<R>>,
    housing: Option<Housing<R>>,
    preload: Vec2<R>,
}

/// Two channels as a vector.
#[inline(always)]
fn pair<R: Real>(state: &[R], at: usize) -> Vec2<R> {
    Vec2::new(state[at], state[at + 1])
}

/// Where ring and housing stand among the states of a mount with so many branches.
#[inline(always)]
fn places(branches: usize, ring: bool) -> (usize, usize) {
    let at = 2 * branches;
    (at, at + 2 * usize::from(ring))
}

impl<R: Real> WholeMount<R> {
    /// One mount per lane.
    pub fn gather<'a>(constants: &dyn Fn(usize) -> (&'a Mount<f64>, &'a MountParts)) -> Self {
        let first = constants(0).1;
        for lane in 1..R::LANES {
            let (count, own) = (first.branches.len(), constants(lane).1.branches.len());
            assert!(count == own, "lanes share what is present");
        }
        let branch = |k: usize| Gather::<R>::gather(&|lane| &constants(lane).1.branches[k]);
        WholeMount {
            spring: Gather::<R>::gather(&|lane| constants(lane).0),
            branches: (0..first.branches.len()).map(branch).collect(),
            ring: Gather::<R>::gather(&|lane| &constants(lane).1.ring),
            film: first.film.as_ref().map(|_| {
                Film::gather(&|lane| {
                    let film = constants(lane).1.film.as_ref();
                    film.expect("lanes share what is present")
                })
            }),
            stop: Gather::<R>::gather(&|lane| &constants(lane).1.stop),
            housing: Gather::<R>::gather(&|lane| &constants(lane).1.housing),
            preload: Gather::<R>::gather(&|lane| &constants(lane).1.preload),
        }
    }

    /// What it does at a motion of the outer race against what it stands on; writes the rates of its states.
    #[inline(always)]
    pub fn react(
        &self,
        (position, velocity): (Vec2<R>, Vec2<R>),
        state: &[R],
        rate: &mut [R],
    ) -> MountReaction<R> {
        let zero = R::zero();
        let (ring_at, housing_at) = places(self.branches.len(), self.ring.is_some());
        let (mut s, mut v) = (position, velocity);
        if self.housing.is_some() {
            s = s - pair(state, housing_at);
            v = v - pair(state, housing_at + 2);
        }
        let mut write = |at: usize, value: Vec2<R>| {
            rate[at] = value.x;
            rate[at + 1] = value.y;
        };
        let mut force = self.spring.force(s, v);
        let mut heats = [zero; HEATS.len()];
        heats[0] = self.spring.heat(v);
        for (k, branch) in self.branches.iter().enumerate() {
            let (own, d_rate, heat) = branch.react(s, pair(state, 2 * k));
            force += own;
            write(2 * k, d_rate);
            heats[1] += heat;
        }
        if let Some(ring) = &self.ring {
            let (own, e_rate, heat) = ring.react(v, pair(state, ring_at));
            force += own;
            write(ring_at, e_rate);
            heats[2] = heat;
        }
        if let Some(film) = &self.film {
            let own = film.force(s, v);
            force += own;
            heats[3] = -own.dot(v);
        }
        if let Some(stop) = &self.stop {
            let (own, heat) = stop.react(s, v);
            force += own;
            heats[4] = heat;
        }
        if let Some(housing) = &self.housing {
            let (h, speed) = (pair(state, housing_at), pair(state, housing_at + 2));
            let without_preload = force - self.spring.free_position * self.spring.stiffness;
            let on_housing = -without_preload - h * housing.stiffness - speed * housing.damping;
            write(housing_at, speed);
            write(housing_at + 2, on_housing * housing.mass.recip());
            heats[5] = housing.damping * speed.length_squared();
        }
        MountReaction {
            force: force + self.preload,
            heats,
        }
    }

    /// Adds an acceleration of all bodies alike, m/s², to the rate of the housing's motion; returns its momentum, kg m/s.
    #[inline(always)]
    pub fn shake(&self, by: Vec2<R>, state: &[R], rate: &mut [R]) -> Vec2<R> {
        let Some(housing) = &self.housing else {
            return Vec2::zero();
        };
        let (_, at) = places(self.branches.len(), self.ring.is_some());
        rate[at + 2] += by.x;
        rate[at + 3] += by.y;
        pair(state, at + 2) * housing.mass
    }

    /// The part of its force that balances weights, N, which a housing on which it stands does not feel.
    #[inline(always)]
    pub fn weight(&self) -> Vec2<R> {
        self.preload + self.spring.free_position * self.spring.stiffness
    }

    /// What its parts do at a motion of the outer race.
    pub fn parts(&self, (position, velocity): (Vec2<R>, Vec2<R>), state: &[R]) -> PartsAt<R> {
        let (ring_at, housing_at) = places(self.branches.len(), self.ring.is_some());
        let (mut s, mut v) = (position, velocity);
        let mut housing = [Vec2::zero(); 2];
        if self.housing.is_some() {
            housing = [pair(state, housing_at), pair(state, housing_at + 2)];
            (s, v) = (s - housing[0], v - housing[1]);
        }
        let zero = Vec2::zero();
        let ring = |ring: &FrictionRing<R>| ring.react(v, pair(state, ring_at)).0;
        PartsAt {
            ring: self.ring.as_ref().map_or(zero, ring),
            film: self.film.as_ref().map_or(zero, |film| film.force(s, v)),
            stop: self.stop.as_ref().map_or(zero, |stop| stop.react(s, v).0),
            housing,
        }
    }

    /// Energies at a position of the outer race, J: potential, and that of the housing's motion.
    pub fn energy(&self, position: Vec2<R>, state: &[R]) -> [R; 2] {
        let (ring_at, housing_at) = places(self.branches.len(), self.ring.is_some());
        let mut s = position;
        let mut kinetic = R::zero();
        let mut potential = -self.preload.dot(position);
        let half = R::splat(0.5);
        if let Some(housing) = &self.housing {
            let h = pair(state, housing_at);
            s = s - h;
            // what the preload does on the race beyond what it does between race and housing
            let preload = self.spring.free_position * self.spring.stiffness;
            potential += half * housing.stiffness * h.length_squared() - preload.dot(h);
            kinetic = half * housing.mass * pair(state, housing_at + 2).length_squared();
        }
        potential += self.spring.energy(s);
        for (k, branch) in self.branches.iter().enumerate() {
            potential += branch.energy(s, pair(state, 2 * k));
        }
        if let Some(ring) = &self.ring {
            potential += ring.energy(pair(state, ring_at));
        }
        if let Some(stop) = &self.stop {
            potential += stop.energy(s);
        }
        [potential, kinetic]
    }
}
