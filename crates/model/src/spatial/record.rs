//! What is watched of a bearing in space during a run, besides what is of every bearing: an observer.
//!
//! Contact angles, rows without load and ellipses that reach over the shoulder are seen at the looks at the balls, a few a turn and
//! whenever their loads change; faces at the ends of the steps.

use super::face_heat::FaceHeat;
use super::part::SpatialBearing;
use super::spring::PreloadSpring;
use crate::motion::Motion;
use crate::system::sampling::{Growth, Peak};
use smallvec::SmallVec;

/// An ellipse that is cut off by the shoulder of its groove.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunOver {
    /// When first, s.
    pub time: f64,
    /// Ball, from 0.
    pub ball: usize,
    /// 0 at the inner, 1 at the outer race.
    pub race: usize,
    /// Contact angle there, rad.
    pub angle: f64,
    /// Load there, N.
    pub load: f64,
}

/// A ball that carries on the side of its groove that has no shoulder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenSide {
    /// Row, from 0.
    pub row: usize,
    /// When it carried most, s.
    pub time: f64,
    /// Its load at the inner race then, N.
    pub load: f64,
    /// Contact angle there, of its size, rad.
    pub angle: f64,
}

/// Contact angle beyond which a ball of a row with an angle is on the other side of the groove's bottom, rad.
pub const OPEN: f64 = 0.05;

/// Load under which no edge of a shoulder marks a ball, N.
const LEAST_LOAD: f64 = 1.0;

/// Everything kept of a bearing in space.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialRecord {
    /// Largest size of a contact angle at the inner and at the outer race, rad.
    pub largest_angles: [Peak; 2],
    /// When each row was first without a ball that both races press, having had one, s.
    pub unloaded: Vec<Option<f64>>,
    /// The first ellipse over a shoulder.
    pub run_over: Option<RunOver>,
    /// The largest load of a row on its open side.
    pub open_side: Option<OpenSide>,
    /// Largest force on the faces, N.
    pub axial_force: Peak,
    /// When it last grew.
    pub growth: Growth,
    /// Largest displacement of the outer ring along the axis, m, at the ends of the steps.
    pub outer_place: Peak,
    /// When a shoulder first met a face, s.
    pub first_axial_contact: Option<f64>,
    /// The last instant at which they touched, at the end of a step, s.
    pub last_axial_contact: Option<f64>,
    /// Largest force of a spring that presses rows and largest size below its preload, N, at the ends of the steps.
    pub spring_forces: [Peak; 2],
    /// When it was first free, and first solid, s.
    pub spring_ends: [Option<f64>; 2],
    /// How hot shoulder and face became.
    pub face_heat: FaceHeat,
    /// Which rows have carried something.
    loaded: Vec<bool>,
}

impl SpatialRecord {
    /// Nothing seen yet.
    pub fn new(bearing: &SpatialBearing) -> Self {
        SpatialRecord {
            largest_angles: [Peak::NONE; 2],
            unloaded: vec![None; bearing.rows.len()],
            run_over: None,
            open_side: None,
            axial_force: Peak::NONE,
            growth: Growth::default(),
            outer_place: Peak::NONE,
            first_axial_contact: None,
            last_axial_contact: None,
            spring_forces: [Peak::NONE; 2],
            spring_ends: [None; 2],
            face_heat: FaceHeat::default(),
            loaded: vec![false; bearing.rows.len()],
        }
    }
    /// Sees the faces at both ends of a step: penetrations, m, and the force at its end, N.
    pub fn faces(&mut self, times: [f64; 2], depths: [f64; 2], force: f64) {
        self.axial_force.raise(force, times[1]);
        self.growth.watch(force, times[1]);
        if depths[1] > 0.0 {
            self.last_axial_contact = Some(times[1]);
        }
        if self.first_axial_contact.is_some() || depths[1] <= 0.0 {
            return;
        }
        let share = match depths[0] < 0.0 {
            true => depths[0] / (depths[0] - depths[1]),
            false => 0.0,
        };
        self.first_axial_contact = Some(times[0] + share * (times[1] - times[0]));
    }
    /// Sees a spring whose ring has slid, m, at the end of a step.
    pub fn spring(&mut self, spring: &PreloadSpring<f64>, time: f64, slid: f64) {
        let force = spring.force(slid);
        self.spring_forces[0].raise(force, time);
        self.spring_forces[1].raise(spring.preload - force, time);
        let solid = spring.side * slid > spring.travel;
        for (own, comes) in self.spring_ends.iter_mut().zip([force <= 0.0, solid]) {
            if comes {
                own.get_or_insert(time);
            }
        }
    }
    /// Looks at the balls.
    pub fn look(
        &mut self,
        bearing: &SpatialBearing,
        time: f64,
        motion: &Motion<f64>,
        state: &[f64],
    ) {
        let mut pressed: SmallVec<[bool; 4]> = SmallVec::from_elem(false, bearing.rows.len());
        bearing.touches(motion, state, |row, ball, _, touches| {
            for (race, touch) in touches.iter().enumerate() {
                let load = touch.load.force;
                if load <= 0.0 {
                    continue;
                }
                pressed[row] |= race == 0;
                let turned = touch.triad.normal[1].asin();
                let angle = turned.abs();
                self.largest_angles[race].raise(angle, time);
                if race == 0 && turned * bearing.rows[row].ball.side() > OPEN {
                    let most = self.open_side.map_or(0.0, |own| own.load);
                    if load > most {
                        self.open_side = Some(OpenSide {
                            row,
                            time,
                            load,
                            angle,
                        });
                    }
                }
                let half = touch.half_axis / bearing.rows[row].ball.radius;
                let beyond = load > LEAST_LOAD
                    && (bearing.groove_ends).is_some_and(|ends| angle + half > ends[race]);
                if beyond && self.run_over.is_none() {
                    self.run_over = Some(RunOver {
                        time,
                        ball,
                        race,
                        angle,
                        load,
                    });
                }
            }
        });
        for (index, pressed) in pressed.into_iter().enumerate() {
            if self.loaded[index] && !pressed {
                self.unloaded[index].get_or_insert(time);
            }
            self.loaded[index] |= pressed;
        }
    }
}
