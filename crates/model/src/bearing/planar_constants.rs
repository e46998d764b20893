//! What a planar bearing is made of: its constants, its states, what it stores.

use super::ball::{BallConstants, BallMotion, BallReaction, PocketMotion, Slowing};
use super::ball_pair::BallPair;
use super::ball_states::{
    OF_BALL, OF_CENTRED_CAGE, OF_FREE_CAGE, distances, race, seat, split, split_mut,
};
use super::land::Land;
use super::lubricant_state::{LubricantConstants, Warmed};
use super::steady_moment::{Geometry, SharedMoment};
use crate::motion::Motion;
use number::Real;
use physics::flash::SkiddingContact;
use physics::inlet_rolling::ResistanceAtRaces;
use physics::rolling::{RollingSet, ring_mass};
use physics::traction::{SlidingContact, Traction, TractionLaw};

/// Constants of one planar bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarConstants {
    /// Number of balls.
    pub balls: usize,
    /// The ball, its contacts and its pocket.
    pub ball: BallConstants<f64>,
    /// Friction between ball and race.
    pub traction: Traction<f64>,
    /// What keeps the balls apart.
    pub separation: Separation<f64>,
    /// Cage mass, kg, which its centre moves; without meaning where there is no cage.
    pub cage_mass: f64,
    /// Cage moment of inertia, kg m², which alone counts where it turns; without meaning where there is no cage.
    pub cage_inertia: f64,
    /// Drag of the cage to ground, N m s.
    pub cage_drag: f64,
    /// Azimuth of ball 1 at the start, rad.
    pub first_ball_angle: f64,
    /// The steady friction moment; with it the drags to ground are zero.
    pub moment: Option<SharedMoment>,
    /// Rolling resistance of the oil in the inlets; not counted beside a steady moment, which holds it.
    pub inlet_rolling: Option<ResistanceAtRaces<f64>>,
    /// The slow state of the lubricant; none where it has none.
    pub lubricant: Option<LubricantConstants>,
    /// What its balls do to the inner and to the outer race, for the record alone.
    pub races: Option<[RaceContact; 2]>,
}

/// What a ball does to a race, for the record alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RaceContact {
    /// What sliding heats.
    pub skidding: SkiddingContact,
    /// Load that dents, N.
    pub denting_load: f64,
}

/// What keeps the balls apart.
#[derive(Clone, Debug, PartialEq)]
pub enum Separation<R> {
    /// A cage whose centre is that of the outer race.
    CentredCage,
    /// A cage that is free to move, within its pockets and the clearance of its land if it has one.
    FreeCage(Option<Land<R>>),
    /// No cage: a full complement of balls, each against its neighbours.
    Neighbours(BallPair<R>),
}

impl PlanarConstants {
    /// Motion of one ball.
    pub fn motion(&self, state: &[f64], ball: usize) -> BallMotion<f64> {
        let [radius, radial_speed, azimuth, orbit_speed, spin] =
            split(state, self.first_ball_state(), self.balls).map(|list| list[ball]);
        BallMotion {
            radius,
            radial_speed,
            azimuth,
            orbit_speed,
            spin,
        }
    }
    /// Writes the motion of one ball.
    pub fn set_motion(&self, state: &mut [f64], ball: usize, motion: &BallMotion<f64>) {
        let [radius, radial_speed, azimuth, orbit_speed, spin] =
            split_mut(state, self.first_ball_state(), self.balls);
        radius[ball] = motion.radius;
        radial_speed[ball] = motion.radial_speed;
        azimuth[ball] = motion.azimuth;
        orbit_speed[ball] = motion.orbit_speed;
        spin[ball] = motion.spin;
    }
    /// Index of the azimuth of a ball among the bearing's states.
    pub fn azimuth_channel(&self, ball: usize) -> usize {
        self.first_ball_state() + 2 * self.balls + ball
    }
    /// First state of the balls.
    pub fn first_ball_state(&self) -> usize {
        match self.separation {
            Separation::CentredCage | Separation::Neighbours(_) => OF_CENTRED_CAGE,
            Separation::FreeCage(_) => OF_FREE_CAGE,
        }
    }
    /// Number of states of cage and balls; those of a lubricant come behind.
    pub fn states(&self) -> usize {
        self.first_ball_state() + OF_BALL * self.balls
    }
    /// Mass of the cage where it moves by its own states, kg.
    pub(super) fn free_cage_mass(&self) -> f64 {
        match self.separation {
            Separation::FreeCage(_) => self.cage_mass,
            Separation::CentredCage | Separation::Neighbours(_) => 0.0,
        }
    }
    /// Mass of a cage, kg; zero where there is none.
    pub fn mass_of_cage(&self) -> f64 {
        match self.separation {
            Separation::Neighbours(_) => 0.0,
            Separation::CentredCage | Separation::FreeCage(_) => self.cage_mass,
        }
    }
    /// Masses and radii of balls and cage.
    pub(super) fn set(&self) -> RollingSet<f64> {
        let ball = &self.ball;
        RollingSet {
            inner_track_radius: ball.inner_track,
            ball_ratio: ball.radius / ball.inner_track,
            balls_mass: self.balls as f64 * ball.mass,
            cage_mass: match self.separation {
                Separation::Neighbours(_) => 0.0,
                Separation::CentredCage | Separation::FreeCage(_) => {
                    ring_mass(self.cage_inertia, ball.inner_track + ball.radius)
                }
            },
        }
    }
    pub(super) fn rest(&self, state: &mut [f64]) {
        state[0] = self.first_ball_angle;
        state[1] = 0.0;
        for ball in 0..self.balls {
            let motion = BallMotion {
                radius: self.rest_radius(),
                radial_speed: 0.0,
                azimuth: self.first_ball_angle + seat(ball, self.balls),
                orbit_speed: 0.0,
                spin: 0.0,
            };
            self.set_motion(state, ball, &motion);
        }
    }
    /// Makes cage and balls roll with an inner race of this speed, rad/s, the outer race at rest.
    pub fn roll(&self, state: &mut [f64], speed: f64) {
        let s = self.ball.radius / self.ball.inner_track;
        let cage_speed = speed / (2.0 * (1.0 + s));
        state[1] = cage_speed;
        for j in 0..self.balls {
            let mut ball = self.motion(state, j);
            ball.orbit_speed = cage_speed;
            ball.spin = -speed / (2.0 * s);
            self.set_motion(state, j, &ball);
        }
    }
    /// Reaction of one ball, for inspection; without its part of the steady moment, and without its pocket where the
    /// cage is not centred.
    pub fn ball_reaction(
        &self,
        motion: &Motion<f64>,
        state: &[f64],
        ball: usize,
    ) -> BallReaction<f64> {
        let (inner, outer) = (race(&motion.inner), race(&motion.outer));
        let (pocket, ball) = (self.pocket(state, ball), self.motion(state, ball));
        self.separation.beyond_pockets(self.ball).react(
            &Warmed {
                law: &self.traction,
                factor: self.warmed_traction(state),
            },
            (&inner, &outer, &pocket),
            &ball,
            &distances(&inner, &outer, &ball),
            &Slowing::none(),
        )
    }
    /// Azimuth of a ball, and its contacts at the inner and at the outer race.
    pub(super) fn contacts(
        &self,
        motion: &Motion<f64>,
        state: &[f64],
        ball: usize,
    ) -> (f64, [SlidingContact<f64>; 2]) {
        let (inner, outer) = (race(&motion.inner), race(&motion.outer));
        let (law, ball) = (&self.ball, self.motion(state, ball));
        let between = law.between(&inner, &outer, &ball, &distances(&inner, &outer, &ball));
        let inner = law.on_inner(&between.inner, inner.spin, ball.spin);
        let outer = law.on_outer(&between.outer, outer.spin, ball.spin);
        (ball.azimuth, [inner.contact, outer.contact])
    }
    /// What sliding at the contacts of a ball heats: its power, W, and the speeds of the surfaces of ball and race past the contact,
    /// m/s.
    pub fn sliding(
        &self,
        state: &[f64],
        contacts: &[SlidingContact<f64>; 2],
    ) -> [(f64, [f64; 2]); 2] {
        let [inner, outer] = contacts;
        let law = Warmed {
            law: &self.traction,
            factor: self.warmed_traction(state),
        };
        let (at_inner, at_outer) = law.at_races(inner, outer);
        [(at_inner, inner), (at_outer, outer)].map(|(coefficient, contact)| {
            // slip is that of the race past the ball
            let half = 0.5 * contact.slip;
            let speeds = [contact.entrainment - half, contact.entrainment + half];
            (coefficient * contact.load * contact.slip, speeds)
        })
    }
    /// Traction coefficient in a state of the bearing over that of the law, where the films warm.
    pub(super) fn warmed_traction(&self, state: &[f64]) -> Option<f64> {
        let lubricant = self.lubricant?;
        let at = lubricant.at(&state[self.states()..]);
        lubricant.films.map(|_| at.traction_factor)
    }
    pub(super) fn geometry(&self) -> Geometry {
        Geometry {
            balls: self.balls,
            ball_radius: self.ball.radius,
            inner_track: self.ball.inner_track,
            contact_cosine: 1.0,
        }
    }
    /// True where anything drags on balls or cage from the ground.
    pub fn drags_to_ground(&self) -> bool {
        self.ball.orbit_drag != 0.0 || self.ball.spin_drag != 0.0 || self.cage_drag != 0.0
    }
    pub(super) fn pocket(&self, state: &[f64], ball: usize) -> PocketMotion<f64> {
        PocketMotion {
            angle: state[0] + seat(ball, self.balls),
            spin: state[1],
        }
    }
}

impl<T> Separation<T> {
    /// The ball for the sum over the races: where the cage is not centred, pockets are no part of it.
    pub(super) fn beyond_pockets<R: Real>(&self, mut ball: BallConstants<R>) -> BallConstants<R> {
        if !matches!(self, Separation::CentredCage) {
            ball.pocket_gap = R::splat(f64::INFINITY);
        }
        ball
    }
}
