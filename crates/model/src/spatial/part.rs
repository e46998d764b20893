//! A bearing in space as a part of a machine: rows on shared rings, the landing surfaces of the inner one, the mount of the outer one.
//!
//! ```text
//!   states   inner ring, outer ring: 13 and the turned angle each;  own: a cage for each row (13), then the rows' balls, nine lists each,
//!            then how far and how fast outer rings slide against a spring
//!   outer ring   across the axis the mount as in the plane, along it and against tilt [`SpatialMount`]; without tilt it keeps its orientation
//! ```
//! Frame: origin at the datum of the bearing, axes of the machine. The rotor's node comes in as a body, the wrench on it goes out, about
//! the point C of its axis.
//!
//! Does not model: mounts on housings that move.

use super::assembly::{AMB, Assembly, AssemblyConstants, Bodies, InnerRing, MOMENT, OuterRing};
use super::ball::BALL_STATES;
use super::face_heat::FaceSurfaces;
use super::landing::{Landing, LandingConstants, LandingReaction};
use super::mount::SpatialMount;
use super::race::{RingMotion, Touch};
use super::rigid_body::{BODY_STATES, Inertia, RigidBody, SpatialWrench};
use super::row::{BallContacts, CageGuide, RowConstants};
use super::statics::ball::Running;
use super::statics::{Equilibrium, RaceControl, RingLoad, StaticBall, StaticRow, StaticRows};
use super::{PreloadSpring, preload_at_rest};
use crate::auxiliary_bearing::{AuxiliaryBearingConstants, BearingAt, Outlet, probe};
use crate::base::Masses;
use crate::bearing::ball_sums::largest;
use crate::bearing::{self, BearingConstants, RaceContact};
use crate::contact::ContactReaction;
use crate::heats::HEATS;
use crate::motion::{Motion, Wrench};
use number::{Real, Vec2, Vec3};
use physics::rolling::RollingSet;

/// What a bearing in space has besides what every auxiliary bearing has.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialBearing {
    /// Rows by rising place, each with the gravity on its balls; the cage of the first turns as results say.
    pub rows: Vec<RowConstants>,
    /// Balls and cages in the plane: how they roll.
    pub set: RollingSet<f64>,
    /// What presses the rows of one side, where a spring does.
    pub spring: Option<PreloadSpring<f64>>,
    /// Row of the rotation of the rotor's node in it; zero of a point.
    pub rotation: Vec<f64>,
    /// That node's place along the axis from the rotor's centre of mass, m.
    pub lever: f64,
    /// Inertia of the inner ring about an axis across, kg m².
    pub inner_transverse: f64,
    /// Inertias of the outer ring about its axis and across, kg m², where it tilts and twists in its mount.
    pub outer_inertias: Option<[f64; 2]>,
    /// The mount along the axis and against tilt; across the axis it is that of the part.
    pub mount: SpatialMount<f64>,
    /// Azimuth of the first ball of each row at the start, rad.
    pub first_ball_angle: f64,
    /// Where the rotor lands; the contact of one station.
    pub landing: LandingConstants,
    /// Angles at which the grooves of inner and outer race end, rad, where they are known.
    pub groove_ends: Option<[f64; 2]>,
    /// Shoulder and face that rub, where there are any, for the record alone.
    pub face_surfaces: Option<FaceSurfaces>,
    /// What its balls do to the inner and to the outer race, for the record alone.
    pub races: Option<[RaceContact; 2]>,
}

/// Among the states of a body: that of its turning about the axis of the frame.
pub const SPIN: usize = BODY_STATES - 1;
/// A preload that is rounding, N: rows without one just touch.
const LEAST_PRELOAD: f64 = 1e-6;

impl SpatialBearing {
    /// Number of balls of all rows.
    pub fn balls(&self) -> usize {
        self.rows.iter().map(|row| row.balls).sum()
    }
    /// What machines share whose lanes hold it: nodes of each row, stations, faces.
    pub(crate) fn counts(&self) -> Vec<usize> {
        let landing = [self.landing.stations.len(), self.landing.faces.len()];
        let nodes = self.rows.iter().map(|row| row.nodes.len());
        // which side a spring presses
        let spring = self.spring.map_or(0, |own| 1 + usize::from(own.side > 0.0));
        nodes.chain(landing).chain([spring]).collect()
    }
    /// Displacement of the inner ring under a radial load, N, at rest, m, one ball of each row on the load line; none where no preload
    /// presses its rows, or no equilibrium is found.
    pub fn displacement_of_preloaded(&self, load: f64) -> Option<f64> {
        let found = self.preloaded(load, 0.0)?;
        Some(found.displacement.shift[0])
    }
    /// Equilibrium of the inner ring under a radial load along x, N, at a speed of it, rad/s, one ball of each row on the load line; none
    /// where no preload presses its rows, or no equilibrium is found.
    pub fn preloaded(&self, load: f64, speed: f64) -> Option<Equilibrium> {
        let pressed: Vec<_> = self.rows.iter().map(|row| (row.balls, row.ball)).collect();
        if preload_at_rest(&pressed, self.spring.as_ref()) < LEAST_PRELOAD {
            return None;
        }
        let rows = pressed.into_iter().map(|(balls, ball)| StaticRow {
            balls,
            first_azimuth: 0.0,
            ball: StaticBall {
                radius: ball.radius,
                mass: ball.mass,
                inner: ball.inner_at(speed),
                outer: ball.outer,
            },
        });
        let radial = RingLoad {
            force: [load, 0.0, 0.0],
            moment: [0.0; 2],
        };
        let running = Running {
            speed,
            control: RaceControl::Half,
        };
        let rows = StaticRows {
            rows: rows.collect(),
            spring: self.spring,
        };
        rows.settle(&radial, &running).ok()
    }
    /// The outer ring of a row in these own states.
    fn outer_of(&self, row: &RowConstants, outer: RigidBody<f64>, state: &[f64]) -> RigidBody<f64> {
        let at = self.sliding_state();
        match self.spring.filter(|own| own.presses(&row.ball)) {
            Some(_) => outer.slid([state[at], state[at + 1]]),
            None => outer,
        }
    }
    /// Azimuth of a ball, rad.
    pub fn azimuth(&self, state: &[f64], ball: usize) -> f64 {
        state[self.azimuth_channel(ball)]
    }
    /// Shows where and how each ball touches both races: its row, its place among all balls, its azimuth, rad.
    pub fn touches(
        &self,
        motion: &Motion<f64>,
        state: &[f64],
        mut see: impl FnMut(usize, usize, f64, &[Touch<f64>; 2]),
    ) {
        let [inner, outer] = [&motion.inner, &motion.outer].map(RigidBody::of);
        let inner = RingMotion::of(&inner);
        let (mut first, mut ball) = (BODY_STATES * self.rows.len(), 0);
        for (index, row) in self.rows.iter().enumerate() {
            let outer = RingMotion::of(&self.outer_of(row, outer, state));
            for (azimuth, touch) in row.touches([&inner, &outer], &state[first..]) {
                see(index, ball, azimuth, &touch);
                ball += 1;
            }
            first += BALL_STATES * row.balls;
        }
    }
    /// Contacts and pocket of a ball.
    pub fn contacts(&self, motion: &Motion<f64>, state: &[f64], ball: usize) -> BallContacts<f64> {
        let (row, own, first) = self.place(ball);
        let index = (self.rows.iter()).position(|other| std::ptr::eq(other, row));
        let cage = RigidBody::read(&state[BODY_STATES * index.unwrap_or(0)..]);
        let [inner, outer] = [&motion.inner, &motion.outer].map(RigidBody::of);
        let outer = self.outer_of(row, outer, state);
        row.contacts([&inner, &outer, &cage], &state[first..], own)
    }
    /// What slip and spin at the contacts of a ball heat: power, W, and the speeds of the surfaces of ball and race past the contact, m/s.
    pub fn sliding(
        &self,
        motion: &Motion<f64>,
        state: &[f64],
        ball: usize,
    ) -> [(f64, [f64; 2]); 2] {
        let races = self.contacts(motion, state, ball).races;
        [0, 1].map(|race| {
            let contact = races.touch[race].slides();
            let half = 0.5 * contact.slip;
            let speeds = [contact.entrainment - half, contact.entrainment + half];
            (races.traction[race].heat, speeds)
        })
    }
    /// Whether a shoulder of the rotor may meet a face.
    pub fn stops(&self) -> bool {
        !self.landing.faces.is_empty()
    }
    /// Whether a kind of heat may be made in it.
    pub fn may_make(&self, heat: &str) -> bool {
        match heat {
            "cage_land_damping" | "cage_land_friction" => {
                let lands = |row: &RowConstants| {
                    matches!(
                        row.cage.guide,
                        CageGuide::OuterLand(_) | CageGuide::InnerLand(_)
                    )
                };
                self.rows.iter().any(lands)
            }
            "steady_moment" => self.rows.iter().any(|row| row.moment.is_some()),
            "ball_ball_damping" | "ball_ball_friction" | "inlet_rolling" => false,
            _ => true,
        }
    }
    /// Mass of its cages that moves with the outer ring, kg.
    pub fn tied_mass(&self) -> f64 {
        let tied = self.rows.iter().filter(|row| row.cage.is_tied());
        tied.map(|row| row.cage.inertia.mass).sum()
    }
    /// Mass of balls and cages that move by their own states, kg.
    pub fn free_mass(&self) -> f64 {
        let rows = self.rows.iter();
        let all = rows.map(|row| row.cage.inertia.mass + row.balls as f64 * row.ball.mass);
        all.sum::<f64>() - self.tied_mass()
    }
}

impl AuxiliaryBearingConstants {
    /// What it is in space, where it is.
    pub fn spatial(&self) -> Option<&SpatialBearing> {
        match &self.bearing {
            BearingConstants::Spatial(own) => Some(own),
            _ => None,
        }
    }
    /// Its rows, rings and mount in space; across the axis the mount is left to its own law.
    ///
    /// # Panics
    /// When it is none in space.
    pub fn assembly(&self) -> AssemblyConstants {
        let own = self.spatial().expect("a bearing in space");
        let race = &self.inner_race;
        let [axial, transverse] = own.outer_inertias.unwrap_or([1.0; 2]);
        AssemblyConstants {
            gravity: own.rows[0].ball.gravity,
            inner: InnerRing {
                inertia: Inertia {
                    mass: race.mass,
                    axial: race.inertia,
                    transverse: own.inner_transverse,
                },
                held: race.centre_held,
                torque: race.torque,
                force: Vec3::zero(),
                moment: Vec3::zero(),
                settling: 0.0,
                tilt_settling: 0.0,
            },
            outer: OuterRing {
                inertia: Inertia {
                    mass: self.outer_race_mass,
                    axial,
                    transverse,
                },
                turns: own.outer_inertias.is_some(),
                mount: own.mount,
            },
            rows: own.rows.clone(),
            spring: own.spring,
            rotor: None,
        }
    }
}

/// A bearing in space over `R`.
#[derive(Clone, Debug)]
pub struct Spatial<R: Real> {
    assembly: Assembly<R>,
    landing: Landing<R>,
    /// Balls of each row and their mass, kg.
    balls: Vec<(usize, R)>,
}

/// What a bearing in space does to its machine.
#[derive(Clone, Copy, Debug)]
pub struct SpatialReaction<R> {
    /// On the rotor about C.
    pub on_rotor: SpatialWrench<R>,
    /// Moment from outside about the axis through the datum, N m.
    pub external: R,
}

impl<R: Real> Spatial<R> {
    pub(crate) fn gather<'a>(
        machine: &dyn Fn(usize) -> &'a AuxiliaryBearingConstants,
    ) -> Option<Self> {
        machine(0).spatial()?;
        let each: Vec<AssemblyConstants> =
            (0..R::LANES).map(|lane| machine(lane).assembly()).collect();
        let landing = |lane: usize| {
            &machine(lane)
                .spatial()
                .expect("lanes share the fidelity")
                .landing
        };
        Some(Spatial {
            assembly: Assembly::gather(&|lane| &each[lane]),
            landing: Landing::gather(&landing),
            balls: (each[0].rows.iter().enumerate())
                .map(|(k, row)| {
                    (
                        row.balls,
                        R::from_lanes(|lane| each[lane].rows[k].ball.mass),
                    )
                })
                .collect(),
        })
    }

    /// Rates of rings, cages and balls, heats, sources and probes of a bearing whose rotor does this, its mount across the axis with
    /// this force, N, and heat, W.
    #[inline(always)]
    pub(crate) fn react(
        &self,
        at: &BearingAt,
        rotor: &RigidBody<R>,
        (across, heat): (Vec2<R>, R),
        into: Outlet<'_, R>,
    ) -> SpatialReaction<R> {
        let Outlet {
            heat: first_heat,
            source,
            state,
            rate,
            probe,
        } = into;
        let zero = R::zero();
        let (inner_at, outer_at) = (at.inner.channels(), at.outer.channels());
        let mut bodies = Bodies::read(&state[inner_at.clone()], &state[outer_at.clone()]);
        let landed = self.landing.react(rotor, rotor.position, &bodies.inner);
        bodies.land(&landed);
        let balls = self.assembly.balls();
        let detail = if probe.is_empty() {
            &mut [][..]
        } else {
            let end = at.detail + bearing::DETAIL_PER_BALL * balls;
            &mut probe[at.detail..end]
        };
        let own = at.own();
        let both = (&state[own.clone()], &mut rate[own.clone()]);
        self.assembly.act(&mut bodies, both, detail);

        let by_balls = bodies.on_outer.force;
        let across = Vec3::new(across.x, across.y, zero);
        bodies.on_outer.force += across;
        let along = self.assembly.outer.mount.wrench(&bodies.outer);
        let external = bodies.external + self.outside_moment(&bodies, along, across);
        self.assembly
            .move_inner(&mut bodies, &mut rate[inner_at.clone()]);
        let turning = &rate[inner_at][SPIN - 2..];
        let speed_rate = Vec3::new(turning[0], turning[1], turning[2]).dot(bodies.inner.axis);
        let acceleration = (self.assembly).move_outer(&mut bodies, &mut rate[outer_at]);
        self.assembly.carry(&bodies, acceleration, &mut rate[own]);
        for (body, at) in [(&bodies.inner, at.inner), (&bodies.outer, at.outer)] {
            rate[at.angle()] = body.spin.dot(body.axis);
        }

        let power = &bodies.power;
        let mut heats = [zero; HEATS];
        heats[..7].copy_from_slice(&power[..7]);
        heats[7] = power[MOMENT];
        heats[8..10].copy_from_slice(&power[AMB + 1..AMB + 3]);
        heats[HEATS - 3] = power[7] + heat;
        heats[HEATS - 2] = landed.bore.heats[0] + landed.face.heats[0];
        heats[HEATS - 1] = landed.bore.heats[1] + landed.face.heats[1];
        rate[first_heat..first_heat + HEATS].copy_from_slice(&heats);
        rate[source] = power[16];
        rate[source + 1] = bodies.growth_impulse * speed_rate;
        if !probe.is_empty() {
            let of_mount = across + along.force;
            let largest = |list| largest(&probe[at.detail..], balls, list);
            let loads = [largest(0), largest(1)];
            let skids = [0, 1].map(|race| skid(&probe[at.detail..], balls, race));
            let values = [
                landed.bore.penetration,
                landed.bore.penetration_speed,
                landed.bore.normal_force,
                landed.bore.elastic_rate,
                landed.bore.along,
                landed.bore.slip,
                loads[0],
                loads[1],
                largest(4),
                bodies.land_force,
                by_balls.length_squared().sqrt(),
                of_mount.length_squared().sqrt(),
                skids[0],
                skids[1],
                landed.face.penetration,
                landed.face.normal_force,
                landed.face.heats[1],
            ];
            let own: [R; probe::COUNT] = values;
            probe[at.probe..at.probe + probe::COUNT].copy_from_slice(&own);
        }
        SpatialReaction {
            on_rotor: landed.on_rotor,
            external,
        }
    }

    /// Adds an acceleration across the axis, m/s², that all bodies have alike, to the rates of rings, cages and balls; returns their masses.
    #[inline(always)]
    pub(crate) fn shake(
        &self,
        at: &BearingAt,
        by: Vec2<R>,
        state: &[R],
        rate: &mut [R],
    ) -> Masses<R> {
        let Assembly { inner, outer, .. } = &self.assembly;
        let own = at.own().start;
        let cages = (0..self.balls.len()).map(|row| own + BODY_STATES * row);
        // a tied cage moves with the outer ring, which does not count its mass here
        let cages = cages.zip(self.assembly.cage_masses());
        let rings = [(at.inner.channels().start, inner.inertia.mass, inner.held)];
        let rings =
            rings
                .into_iter()
                .chain([(at.outer.channels().start, outer.inertia.mass, false)]);
        let mut all = Masses::none();
        for (first, mass, held) in rings.chain(cages.map(|(first, mass)| (first, mass, false))) {
            if held {
                continue;
            }
            let body = RigidBody::read(&state[first..]);
            let [place, velocity] = [body.position, body.velocity].map(|v| Vec2::new(v.x, v.y));
            all = all.and(Masses::of(mass, place, velocity));
            rate[first + 3] += by.x;
            rate[first + 4] += by.y;
        }
        let mut first = own + BODY_STATES * self.balls.len();
        for (balls, mass) in &self.balls {
            for ball in first..first + balls {
                let [radius, speed, azimuth, orbit] = [0, 1, 2, 3].map(|k| state[ball + k * balls]);
                let (sine, cosine) = azimuth.sin_cos();
                let out = Vec2::new(cosine, sine);
                let velocity = out * speed + out.turned() * (radius * orbit);
                all = all.and(Masses::of(*mass, out * radius, velocity));
                rate[ball + balls] += by.dot(out);
                rate[ball + 3 * balls] += by.dot(out.turned()) / radius;
            }
            first += BALL_STATES * balls;
        }
        all
    }

    /// Moment about the axis through the origin by drive, mount, weights, what holds the inner ring and what keeps the outer one from
    /// turning.
    #[inline(always)]
    fn outside_moment(&self, bodies: &Bodies<R>, along: SpatialWrench<R>, across: Vec3<R>) -> R {
        let Assembly {
            gravity,
            inner,
            outer,
            ..
        } = &self.assembly;
        let (ring, outer_ring) = (&bodies.inner, &bodies.outer);
        let on_inner = match inner.held {
            true => -bodies.on_inner.force,
            false => *gravity * inner.inertia.mass,
        };
        let on_outer = across + along.force + *gravity * outer.inertia.mass;
        let mut moment = inner.torque * ring.axis.z
            + ring.position.cross(on_inner).z
            + outer_ring.position.cross(on_outer).z;
        if outer.turns {
            moment += along.moment.z;
        } else {
            moment -= bodies.on_outer.moment.z;
        }
        moment
    }
    /// The contact of a rotor in the bore, as the plane has it; `rings` is the inner ring's states.
    #[inline(always)]
    pub(crate) fn contact(&self, rotor: &RigidBody<R>, ring: &[R]) -> ContactReaction<R> {
        let LandingReaction { bore, .. } =
            (self.landing).react(rotor, rotor.position, &RigidBody::read(ring));
        ContactReaction {
            on_journal: Wrench::zero(),
            on_bore: Wrench::zero(),
            penetration: bore.penetration,
            penetration_speed: bore.penetration_speed,
            normal_force: bore.normal_force,
            elastic_force: bore.normal_force,
            friction_force: bore.along,
            slip_speed: bore.slip,
            damping_heat: bore.heats[0],
            friction_heat: bore.heats[1],
        }
    }
}

/// Largest u²Q of a ball at a race, from the detail.
#[inline(always)]
fn skid<R: Real>(detail: &[R], balls: usize, race: usize) -> R {
    let mut largest = R::zero();
    for ball in 0..balls {
        let (load, slip) = (
            detail[race * balls + ball],
            detail[(2 + race) * balls + ball],
        );
        largest = largest.max(load * slip.square());
    }
    largest
}
