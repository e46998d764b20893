//! The rolling bearing: one motion in, one reaction out, several fidelities.
//!
//! | fidelity | file | balls |
//! |---|---|---|
//! | [`Rolling`] | [`rolling`] | roll always; loads are quasi-static |
//! | [`Planar`] | [`planar`] | each ball moves by its own equations ([`ball`]) |
//! | [`SpatialBearing`] | [`spatial`](crate::spatial) | the same in space; it acts with rings, contact and mount as a whole |
//!
//! Both may have a steady friction moment: as a whole, or shared by the balls ([`steady_moment`]). Without one, oil resists the
//! rolling of each ball ([`inlet_couples`]). What the pockets take
//! while the race accelerates follows from the balls in the planar fidelity; in the rolling one it is given
//! ([`acceleration_loss`]). The lubricant may have a state that changes slowly, with factors on moment and traction
//! ([`lubricant_state`]).
//!
//! A bearing owns the states of its cage and balls; the system owns the races.
//! Besides its reaction it fills, where asked, a *detail* list with seven values a ball:
//! inner load, outer load (N), inner slip, outer slip (m/s), pocket force (N; without a cage the force between a ball and
//! the next), inner traction, outer traction (N), each value for all balls in turn; a shorter list takes the first of them.

pub mod acceleration_loss;
pub mod ball;
pub mod ball_pair;
pub mod ball_reaction;
pub mod ball_states;
pub(crate) mod ball_sums;
pub mod cage;
pub mod energy;
pub mod full_complement;
pub mod inlet_couples;
pub mod land;
pub mod lubricant_state;
pub mod planar;
pub mod planar_constants;
pub mod pocket;
pub mod reaction;
pub mod rolling;
pub mod settle;
mod shaken;
pub mod steady_moment;
pub mod tangents;

use crate::motion::Motion;
use crate::spatial::SpatialBearing;
pub use acceleration_loss::AccelerationLoss;
pub use ball_states::seat;
pub use lubricant_state::{LubricantAt, LubricantConstants};
use number::Real;
use physics::angular_contact::radial_stiffness;
use physics::load_zone::{cosines, displacement, joint_stiffness};
use physics::rolling::RollingSet;
use physics::traction::SlidingContact;
pub use planar::Planar;
pub use planar_constants::{PlanarConstants, RaceContact, Separation};
pub use reaction::{
    BearingEnergy, BearingHeat, BearingReaction, DETAIL_PER_BALL, HEATS, POCKET_FRICTION,
};
pub use rolling::{Rolling, RollingConstants};
pub use steady_moment::{SharedMoment, SteadyMoment};

/// Constants of a bearing of one machine.
#[derive(Clone, Debug, PartialEq)]
#[expect(
    clippy::large_enum_variant,
    reason = "a machine has one, and copies it only when it is built"
)]
pub enum BearingConstants {
    /// The balls roll.
    Rolling(RollingConstants),
    /// Every ball by its own equations.
    Planar(PlanarConstants),
    /// Every ball by its own equations, in space.
    Spatial(SpatialBearing),
}

/// A bearing over `R`.
#[derive(Clone, Debug)]
pub enum Bearing<R: Real> {
    /// The balls roll.
    Rolling(Rolling<R>),
    /// Every ball by its own equations.
    Planar(Planar<R>),
    /// In space, where it acts [as a whole](crate::spatial::Spatial).
    Spatial,
}

/// So many balls are computed before the first of them is seen: roots and divisions of one keep no other waiting.
const AT_ONCE: usize = 8;

impl BearingConstants {
    /// Number of balls.
    pub fn balls(&self) -> usize {
        match self {
            BearingConstants::Rolling(bearing) => bearing.balls,
            BearingConstants::Planar(bearing) => bearing.balls,
            BearingConstants::Spatial(bearing) => bearing.balls(),
        }
    }
    /// Number of balls of each of its rows.
    pub fn rows(&self) -> Vec<usize> {
        match self {
            BearingConstants::Spatial(bearing) => {
                bearing.rows.iter().map(|row| row.balls).collect()
            }
            _ => vec![self.balls()],
        }
    }
    /// Displacement of the inner race under a radial load at rest, m, one ball on the load line; 0 of a bushing.
    pub fn displacement_under(&self, load: f64) -> f64 {
        let (stiffness, clearance) = match self {
            BearingConstants::Rolling(bearing) => (
                bearing.ball.series_stiffness,
                -2.0 * bearing.ball.interference,
            ),
            BearingConstants::Planar(bearing) => {
                let ball = &bearing.ball;
                let radial = ball.outer_track - ball.inner_track - 2.0 * ball.radius;
                let stiffness = joint_stiffness(ball.inner_stiffness, ball.outer_stiffness);
                (stiffness, 2.0 * radial)
            }
            BearingConstants::Spatial(bearing) => {
                if let Some(moved) = bearing.displacement_of_preloaded(load) {
                    return moved;
                }
                // without preload: each ball as it stands between concentric rings
                let ball = &bearing.rows[0].ball;
                let [radial, axial] = ball.groove_distance();
                let cosine = radial.abs() / radial.hypot(axial).max(f64::MIN_POSITIVE);
                let stiffness = joint_stiffness(ball.inner.stiffness, ball.outer.stiffness);
                (radial_stiffness(stiffness, cosine.acos()), 0.0)
            }
        };
        match self.balls() {
            0 => 0.0,
            balls => displacement(load, stiffness, clearance, &cosines(balls), 1.0),
        }
    }
    /// Name of a state, after `bearing.`.
    pub fn state_name(&self, state: usize) -> String {
        const CAGE: [&str; ball_states::OF_FREE_CAGE] =
            ["angle", "speed", "x", "y", "x_speed", "y_speed"];
        const BALL: [&str; ball_states::OF_BALL] =
            ["radius", "radial_speed", "azimuth", "orbit_speed", "spin"];
        let (first, balls) = match self {
            BearingConstants::Rolling(_) => (rolling::STATES, 1),
            BearingConstants::Planar(bearing) => (bearing.first_ball_state(), bearing.balls),
            BearingConstants::Spatial(bearing) => return bearing.state_name(state),
        };
        if state < first {
            return format!("cage.{}", CAGE[state]);
        }
        if let Some(own) = state.checked_sub(self.lubricant_states()) {
            return lubricant_state::STATE_NAMES[own].to_string();
        }
        let (list, ball) = ((state - first) / balls, (state - first) % balls);
        format!("ball_{:02}.{}", ball + 1, BALL[list])
    }
    /// Number of states: those of cage and balls, then those of the lubricant where it has any.
    pub fn states(&self) -> usize {
        let of_lubricant = self.lubricant().map_or(0, |_| lubricant_state::STATES);
        self.lubricant_states() + of_lubricant
    }
    /// Number of states of cage and balls: where those of the lubricant begin.
    fn lubricant_states(&self) -> usize {
        match self {
            BearingConstants::Rolling(_) => rolling::STATES,
            BearingConstants::Planar(bearing) => bearing.states(),
            BearingConstants::Spatial(bearing) => bearing.states(),
        }
    }
    /// Which of its states is the speed of the cage; none where it follows the race.
    pub fn cage_speed_state(&self) -> Option<usize> {
        match self {
            BearingConstants::Rolling(_) => None,
            BearingConstants::Planar(_) => Some(1),
            BearingConstants::Spatial(_) => Some(crate::spatial::part::SPIN),
        }
    }
    /// Which of its states is the azimuth of a ball; none where the balls have none.
    pub fn azimuth_state(&self, ball: usize) -> Option<usize> {
        match self {
            BearingConstants::Rolling(_) => None,
            BearingConstants::Planar(bearing) => Some(bearing.azimuth_channel(ball)),
            BearingConstants::Spatial(bearing) => Some(bearing.azimuth_channel(ball)),
        }
    }
    /// What balls that may slide do to the races, where it is recorded.
    pub fn race_laws(&self) -> Option<&[RaceContact; 2]> {
        match self {
            BearingConstants::Rolling(_) => None,
            BearingConstants::Planar(bearing) => bearing.races.as_ref(),
            BearingConstants::Spatial(bearing) => bearing.races.as_ref(),
        }
    }
    /// The slow state of the lubricant, where it has one.
    pub fn lubricant(&self) -> Option<&LubricantConstants> {
        match self {
            BearingConstants::Rolling(bearing) => bearing.lubricant.as_ref(),
            BearingConstants::Planar(bearing) => bearing.lubricant.as_ref(),
            BearingConstants::Spatial(_) => None,
        }
    }
    /// The same bearing with its lubricant in the state of the law, for good.
    #[must_use]
    pub fn at_the_law(mut self) -> Self {
        match &mut self {
            BearingConstants::Rolling(bearing) => bearing.lubricant = None,
            BearingConstants::Planar(bearing) => bearing.lubricant = None,
            BearingConstants::Spatial(_) => {}
        }
        self
    }
    /// The lubricant in the states of the bearing, where it has a state.
    pub fn lubricant_at(&self, state: &[f64]) -> Option<LubricantAt> {
        let lubricant = self.lubricant()?;
        Some(lubricant.at(&state[self.lubricant_states()..]))
    }
    /// D of the lubricant in the states of the bearing: 1 where it has none.
    pub fn drag_factor(&self, state: &dyn Fn(usize) -> f64) -> f64 {
        let lubricant = self.lubricant_by(state);
        lubricant.map_or(1.0, |(_, now)| now.drag_factor)
    }
    /// Heat that its contact films keep in the states of the bearing, J: C Θ; none where no film warms.
    pub fn in_films(&self, state: &dyn Fn(usize) -> f64) -> Option<f64> {
        let (lubricant, now) = self.lubricant_by(state)?;
        let films = lubricant.films?;
        Some(films.heat_capacity * now.film_temperature_rise)
    }
    fn lubricant_by(
        &self,
        state: &dyn Fn(usize) -> f64,
    ) -> Option<(&LubricantConstants, LubricantAt)> {
        let lubricant = self.lubricant()?;
        let first = self.lubricant_states();
        let own: [f64; lubricant_state::STATES] = std::array::from_fn(|k| state(first + k));
        Some((lubricant, lubricant.at(&own)))
    }
    /// Changes all speeds of its states that follow the inner race's by one factor, as when all turn faster at once.
    pub fn change_speeds(&self, state: &mut [f64], factor: f64) {
        let bearing = match self {
            BearingConstants::Planar(bearing) => bearing,
            BearingConstants::Spatial(bearing) => return bearing.change_speeds(state, factor),
            BearingConstants::Rolling(_) => return,
        };
        state[1] *= factor;
        let [_, _, _, orbit_speeds, spins] =
            ball_states::split_mut(state, bearing.first_ball_state(), bearing.balls);
        for speed in orbit_speeds.iter_mut().chain(spins) {
            *speed *= factor;
        }
    }
    /// Mass that moves with the outer race, kg: the cage, and the balls where they have no states.
    pub fn mass_with_outer_race(&self) -> f64 {
        match self {
            BearingConstants::Rolling(bearing) => bearing.set.balls_mass + bearing.cage_mass,
            BearingConstants::Planar(bearing) => bearing.mass_of_cage() - bearing.free_cage_mass(),
            BearingConstants::Spatial(bearing) => bearing.tied_mass(),
        }
    }
    /// Mass of balls and cage that move by their own states, kg.
    pub fn free_mass(&self) -> f64 {
        match self {
            BearingConstants::Rolling(_) => 0.0,
            BearingConstants::Planar(bearing) => {
                bearing.balls as f64 * bearing.ball.mass + bearing.free_cage_mass()
            }
            BearingConstants::Spatial(bearing) => bearing.free_mass(),
        }
    }
    /// Masses and radii of balls and cage.
    pub fn set(&self) -> RollingSet<f64> {
        match self {
            BearingConstants::Rolling(bearing) => bearing.set,
            BearingConstants::Planar(bearing) => bearing.set(),
            BearingConstants::Spatial(bearing) => bearing.set,
        }
    }
    /// Power that the contact films keep at the rates of the bearing's states, W: C Θ̇, which other nodes have yet to receive.
    pub fn kept_by_films<R: Real>(&self, rate: &[R]) -> R {
        let own = &rate[self.lubricant_states()..];
        (self.lubricant()).map_or(R::zero(), |lubricant| lubricant.kept_by_films(own))
    }
    /// Radius of the circle of the ball centres, m.
    pub fn pitch_radius(&self) -> f64 {
        let set = self.set();
        set.inner_track_radius * (1.0 + set.ball_ratio)
    }
    /// Cage speed per inner race speed when the balls roll.
    pub fn rolling_cage_ratio(&self) -> f64 {
        self.set().cage_speed(1.0)
    }
    /// The magnitude that matters in each state; `spin` is a speed of the inner race, `speed` one of centres.
    ///
    /// Ball radii by a ten-thousandth of the ball. Speeds of cage and balls along the orbit count a hundred times more
    /// than the spin: pocket impacts live on their small differences, and nearly all of the energy residual arises there.
    pub fn error_scale(&self, scale: &mut [f64], spin: f64, speed: f64) {
        if let BearingConstants::Spatial(bearing) = self {
            return bearing.error_scale(scale, spin, speed);
        }
        scale[0] = 1.0;
        if let BearingConstants::Planar(bearing) = self {
            let (radius, n) = (bearing.ball.radius, bearing.balls);
            scale[1] = 0.01 * spin;
            let (cage, ball) = scale.split_at_mut(bearing.first_ball_state());
            if let Some(place) = cage.get_mut(ball_states::CAGE_PLACE..) {
                let (centre, speeds) = place.split_at_mut(place.len() / 2);
                centre.fill(1e-4 * radius);
                speeds.fill(speed);
            }
            ball[..n].fill(1e-4 * radius);
            ball[n..2 * n].fill(speed);
            ball[2 * n..3 * n].fill(1.0);
            ball[3 * n..4 * n].fill(0.01 * spin);
            ball[4 * n..5 * n].fill(spin * bearing.ball.inner_track / radius);
        }
        if self.lubricant().is_some() {
            LubricantConstants::error_scale(&mut scale[self.lubricant_states()..]);
        }
    }
    /// Whether a kind of [`HEATS`] may be made in this bearing; other kinds always may.
    pub fn may_make(&self, heat: &str) -> bool {
        if self.balls() == 0 {
            // a bushing: neither balls nor cage
            return !HEATS.contains(&heat);
        }
        let separation = match self {
            BearingConstants::Rolling(_) => &Separation::CentredCage,
            BearingConstants::Planar(bearing) => &bearing.separation,
            BearingConstants::Spatial(bearing) => return bearing.may_make(heat),
        };
        match heat {
            "cage_land_damping" | "cage_land_friction" => {
                matches!(separation, Separation::FreeCage(Some(_)))
            }
            "ball_ball_damping" | "ball_ball_friction" => {
                matches!(separation, Separation::Neighbours(_))
            }
            "pocket_damping" | "pocket_friction" => {
                !matches!(separation, Separation::Neighbours(_))
            }
            "inlet_rolling" => match self {
                BearingConstants::Rolling(_) | BearingConstants::Spatial(_) => false,
                BearingConstants::Planar(bearing) => bearing.resisting_inlets().is_some(),
            },
            _ => true,
        }
    }
    /// Whether its inner race grows with its speed.
    pub fn grows(&self) -> bool {
        match self {
            BearingConstants::Rolling(bearing) => bearing.ball.inner_track_growth != 0.0,
            BearingConstants::Planar(bearing) => bearing.ball.inner_track_growth != 0.0,
            BearingConstants::Spatial(bearing) => {
                (bearing.rows.iter()).any(|row| row.ball.inner_growth != 0.0)
            }
        }
    }
    /// Energies and angular momentum at a state; of one in space see [`content`](crate::spatial::AssemblyConstants::content).
    pub fn energy(&self, motion: &Motion<f64>, state: &[f64]) -> BearingEnergy {
        match self {
            BearingConstants::Rolling(bearing) => bearing.energy(motion, state),
            BearingConstants::Planar(bearing) => bearing.energy(motion, state),
            BearingConstants::Spatial(_) => BearingEnergy::default(),
        }
    }
    /// States of a bearing at rest with concentric races.
    pub fn rest(&self, state: &mut [f64]) {
        match self {
            BearingConstants::Rolling(bearing) => bearing.rest(state),
            BearingConstants::Planar(bearing) => bearing.rest(state),
            BearingConstants::Spatial(bearing) => bearing.rest(state),
        }
        if let Some(lubricant) = self.lubricant() {
            lubricant.rest(&mut state[self.lubricant_states()..]);
        }
    }
    /// Azimuth of a ball, rad.
    pub fn azimuth(&self, state: &[f64], ball: usize) -> f64 {
        match self {
            BearingConstants::Rolling(bearing) => state[0] + seat(ball, bearing.balls),
            BearingConstants::Planar(bearing) => bearing.motion(state, ball).azimuth,
            BearingConstants::Spatial(bearing) => bearing.azimuth(state, ball),
        }
    }
    /// Shows the azimuth of each ball, rad, and its contacts at the inner and at the outer race.
    pub fn each_contact(
        &self,
        motion: &Motion<f64>,
        state: &[f64],
        see: &mut dyn FnMut(usize, f64, [SlidingContact<f64>; 2]),
    ) {
        match self {
            BearingConstants::Spatial(bearing) => {
                bearing.touches(motion, state, |_, ball, azimuth, touches| {
                    see(
                        ball,
                        azimuth,
                        touches.each_ref().map(|touch| touch.slides()),
                    );
                });
            }
            _ => {
                let all = self.balls();
                for from in (0..all).step_by(AT_ONCE) {
                    let balls = from..all.min(from + AT_ONCE);
                    let none = SlidingContact {
                        slip: 0.0,
                        load: 0.0,
                        entrainment: 0.0,
                    };
                    let mut found = [(0.0, [none; 2]); AT_ONCE];
                    for (own, ball) in found.iter_mut().zip(balls.clone()) {
                        *own = self.contacts(motion, state, ball);
                    }
                    for (ball, (azimuth, contacts)) in balls.zip(found) {
                        see(ball, azimuth, contacts);
                    }
                }
            }
        }
    }
    /// Azimuth of a ball, rad, and its contacts at the inner and at the outer race; a ball that rolls has no slip.
    pub fn contacts(
        &self,
        motion: &Motion<f64>,
        state: &[f64],
        ball: usize,
    ) -> (f64, [SlidingContact<f64>; 2]) {
        match self {
            BearingConstants::Rolling(bearing) => bearing.contacts(motion, state, ball),
            BearingConstants::Planar(bearing) => bearing.contacts(motion, state, ball),
            BearingConstants::Spatial(bearing) => {
                let found = bearing.contacts(motion, state, ball);
                let slides = found.races.touch.map(|touch| touch.slides());
                (bearing.azimuth(state, ball), slides)
            }
        }
    }
    /// Cage speed, rad/s.
    pub fn cage_speed(&self, motion: &Motion<f64>, state: &[f64]) -> f64 {
        match self {
            BearingConstants::Rolling(bearing) => {
                let speed = motion.inner.spin - motion.outer.spin;
                bearing.set.cage_speed(speed) + motion.outer.spin
            }
            BearingConstants::Planar(_) => state[1],
            BearingConstants::Spatial(_) => state[crate::spatial::part::SPIN],
        }
    }
}

impl<R: Real> Bearing<R> {
    /// One bearing per lane.
    ///
    /// # Panics
    /// When the lanes do not share fidelity, traction law and number of balls.
    pub fn gather<'a>(machine: &dyn Fn(usize) -> &'a BearingConstants) -> Self {
        match machine(0) {
            BearingConstants::Rolling(_) => {
                Bearing::Rolling(Rolling::gather(&|lane| match machine(lane) {
                    BearingConstants::Rolling(bearing) => bearing,
                    _ => panic!("lanes share the fidelity"),
                }))
            }
            BearingConstants::Planar(_) => {
                Bearing::Planar(Planar::gather(&|lane| match machine(lane) {
                    BearingConstants::Planar(bearing) => bearing,
                    _ => panic!("lanes share the fidelity"),
                }))
            }
            BearingConstants::Spatial(_) => Bearing::Spatial,
        }
    }

    /// Reaction to the motion of the races; writes the rates of the bearing's own states, and the detail where asked.
    #[inline(always)]
    pub fn react(
        &self,
        motion: &Motion<R>,
        state: &[R],
        rate: &mut [R],
        detail: &mut [R],
    ) -> BearingReaction<R> {
        self.react_under(motion, (R::zero(), true), state, rate, detail)
    }

    /// The same where something holds the races apart from a radial load: that load, N, moves nothing, but adds to the
    /// load that the steady moment's law sees. Largest values only where somebody looks.
    #[inline(always)]
    pub fn react_under(
        &self,
        motion: &Motion<R>,
        (held_load, looks): (R, bool),
        state: &[R],
        rate: &mut [R],
        detail: &mut [R],
    ) -> BearingReaction<R> {
        match self {
            Bearing::Rolling(bearing) => bearing.react(motion, held_load, state, rate, detail),
            Bearing::Planar(bearing) => {
                bearing.react(motion, (held_load, looks), state, rate, detail)
            }
            Bearing::Spatial => BearingReaction::zero(),
        }
    }

    /// The planar bearing, whose balls have tangents.
    #[inline(always)]
    pub fn planar(&self) -> Option<&Planar<R>> {
        match self {
            Bearing::Planar(bearing) => Some(bearing),
            Bearing::Rolling(_) | Bearing::Spatial => None,
        }
    }

    /// Rate of the angular momentum of balls and cage about the origin, N m, from the rates of their states; the outer
    /// race at rest.
    #[inline(always)]
    pub fn angular_momentum_rate(&self, state: &[R], rate: &[R], race_acceleration: R) -> R {
        match self {
            Bearing::Rolling(bearing) => bearing.angular_momentum_rate(race_acceleration),
            Bearing::Planar(bearing) => bearing.angular_momentum_rate(state, rate),
            Bearing::Spatial => R::zero(),
        }
    }
}
