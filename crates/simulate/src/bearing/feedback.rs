//! What of a bearing follows its temperatures while it is computed in time: oil and clearance.
//!
//! ```text
//!   temperatures of the network ──► ν(T_lubricant), P_d(T_inner, T_balls, T_outer) ──► the constants of the bearing
//! ```
//! The network takes heat in spans; after each of them the bearing goes on with the constants of its temperatures, where these
//! have moved enough to matter. M1 of balls that their rings preload is that of the radial load which presses them as hard, as in
//! a coast-down.
//!
//! Source: derived; book/src/theory/heat.md. Assumes: rings at one temperature each; rings and balls free to grow.

use crate::bearing::build::bearing as constants_of;
use crate::bearing::contacts::ball_contacts;
use crate::bearing::spatial;
use crate::coast_down::build::{ICE_POINT, network, unpreloaded};
use model::bearing::BearingConstants;
use model::spatial::ball::{Expansion, SpatialBall};
use model::spatial::part::SpatialBearing;
use model::spatial::{PreloadSpring, preload_at_rest};
use model::system::energy::{Content, Flows};
use number::{Vec2, Vec3};
use physics::viscosity::Viscosity;
use scenario::{Bearing, Feedback, Moment, Traction, Warm};
use thermal::bearing_network::{BALLS, INNER_RACE, LUBRICANT, OUTER_RACE};
use thermal::load_zone::LoadZone;

/// Temperatures that the traction of oil films is known at, °C.
const FILMS: (f64, f64) = (30.0, 100.0);
/// Contact angle beyond which balls roll off the shoulder, rad.
const STEEPEST: f64 = 1.0;
/// Changes that matter: of the clearance, m; of the viscosity over it.
const CLOSES: f64 = 20e-9;
const THINS: f64 = 2e-3;

/// What of a bearing follows.
#[derive(Clone, Debug)]
pub(crate) struct Follows {
    feedback: Feedback,
    oil: Option<Viscosity>,
    zone: LoadZone,
    /// ΣQ under the weight without preload, N.
    unpreloaded: f64,
    /// At the start, °C.
    start: f64,
    /// Rows in space that press on each other, at the start: balls of each, and one of them.
    pressing: Option<Vec<(usize, SpatialBall<f64>)>>,
    /// The spring that presses them, where one does.
    spring: Option<PreloadSpring<f64>>,
}

impl Follows {
    /// What follows by these temperatures; none where nothing does.
    pub fn of(warm: &Warm, bearing: &Bearing) -> Option<Self> {
        let zone = network(warm).ok()?.1;
        let follows = Follows {
            feedback: warm.heat.feedback,
            oil: warm.viscosity(),
            unpreloaded: unpreloaded(&zone),
            zone,
            start: warm.heat.start_temperature - ICE_POINT,
            pressing: pressing(bearing),
            spring: spatial::spring(bearing),
        };
        let any = follows.thins(bearing)
            || follows.closes(bearing)
            || follows.tilts(bearing)
            || follows.swells(bearing);
        any.then_some(follows)
    }

    /// Whether anything of it depends on the temperature of its lubricant.
    pub fn thins(&self, bearing: &Bearing) -> bool {
        let by_moment = matches!(bearing.moment, Moment::Palmgren { .. } | Moment::Skf { .. });
        self.feedback != Feedback::None
            && (by_moment && self.oil.is_some()
                || matches!(bearing.traction, Traction::Lubricant(_)))
    }

    /// Whether its clearance follows: at an angle a preload is held by springs or by distances that are not given.
    pub fn closes(&self, bearing: &Bearing) -> bool {
        self.feedback == Feedback::Full && bearing.contact_angle == 0.0
    }

    /// Whether its contact angle follows, as that of a pair that springs press.
    pub fn tilts(&self, bearing: &Bearing) -> bool {
        self.feedback == Feedback::Full && bearing.contact_angle > 0.0 && bearing.spatial.is_none()
    }

    /// Whether its grooves and balls follow, as those of a bearing in space.
    pub fn swells(&self, bearing: &Bearing) -> bool {
        self.feedback == Feedback::Full && bearing.spatial.is_some()
    }

    /// How rings and balls of a bearing in space have grown at these temperatures, °C.
    fn expansion(&self, temperatures: &[f64]) -> Expansion {
        let [shaft, housing] = self.zone.by_seats(temperatures);
        Expansion {
            strains: self.zone.strains_at(temperatures),
            // a clearance is one of diameters
            seats: [-0.5 * shaft, 0.5 * housing],
        }
    }

    /// Preload of rows in space at rest and at these temperatures, °C: N; none where they do not press on each other.
    pub fn preload(&self, temperatures: &[f64]) -> Option<f64> {
        let by = self.expansion(temperatures);
        let rows = self.pressing.as_ref()?.iter();
        let rows: Vec<_> = rows
            .map(|(balls, ball)| (*balls, ball.expanded(&by)))
            .collect();
        Some(preload_at_rest(&rows, self.spring.as_ref()))
    }

    /// Contact angle at these temperatures (°C), rad: cos α = 1 − P_d/(2A), of which P_d changes; A = (f_i + f_o − 1) D.
    pub fn contact_angle(&self, bearing: &Bearing, temperatures: &[f64]) -> f64 {
        let grooves = bearing.inner_groove_curvature + bearing.outer_groove_curvature - 1.0;
        let opened = self.changes(temperatures).iter().sum::<f64>();
        let cosine = bearing.contact_angle.cos() - 0.5 * opened / (grooves * bearing.ball_diameter);
        cosine.clamp(STEEPEST.cos(), 1.0).acos()
    }

    /// Diametral clearance at these temperatures (°C) and at a speed of the inner race, rad/s: m.
    pub fn clearance(&self, temperatures: &[f64], speed: f64) -> f64 {
        self.zone.clearance_at(temperatures, speed)
    }

    /// What inner ring, balls and outer ring have added to it at these temperatures (°C), m.
    pub fn changes(&self, temperatures: &[f64]) -> [f64; 3] {
        self.zone.changes_at(temperatures)
    }

    /// Whether a ring that was pressed is loose on its shaft, or in its housing.
    pub fn loose(&self, temperatures: &[f64]) -> [bool; 2] {
        self.zone.loose(temperatures)
    }

    /// Viscosity of the lubricant at these temperatures (°C), m²/s; 1 where none is known.
    pub fn viscosity(&self, temperatures: &[f64]) -> f64 {
        let kelvin = temperatures[LUBRICANT] + ICE_POINT;
        self.oil.as_ref().map_or(1.0, |oil| oil.held(kelvin))
    }

    /// Makes a bearing one of these temperatures, °C, and its steady moment that of a speed of the inner race, rad/s.
    pub fn condition(&self, bearing: &mut Bearing, temperatures: &[f64], speed: f64) {
        if self.thins(bearing) {
            let warmer = self.viscosity(temperatures);
            if let (Moment::Palmgren { viscosity, .. } | Moment::Skf { viscosity, .. }, Some(_)) =
                (&mut bearing.moment, &self.oil)
            {
                *viscosity = warmer;
            }
            if let Traction::Lubricant(film) = &mut bearing.traction {
                let races = 0.5 * (temperatures[INNER_RACE] + temperatures[OUTER_RACE]);
                let rise = 0.5 * (temperatures[BALLS] + races) - self.start;
                let [least, most] = [FILMS.0, FILMS.1].map(|limit| limit + ICE_POINT);
                let warm = film.temperature + rise;
                film.temperature =
                    warm.clamp(least.min(film.temperature), most.max(film.temperature));
            }
        }
        if self.tilts(bearing) {
            bearing.contact_angle = self.contact_angle(bearing, temperatures);
        }
        // grooves in space expand by themselves
        if self.closes(bearing) && !self.swells(bearing) {
            // its balls meet the growth of the inner track themselves
            bearing.operating_diametral_clearance = self.clearance(temperatures, 0.0);
            let clearance = self.clearance(temperatures, speed);
            if let Moment::Palmgren {
                f1_factor,
                f1_exponent,
                preload,
                ..
            } = &mut bearing.moment
            {
                let (weight, pressing) = (
                    self.zone.load,
                    self.zone.pressing(clearance, self.unpreloaded),
                );
                match pressing > weight || weight == 0.0 {
                    true => *preload = (pressing * pressing - weight * weight).sqrt(),
                    // fewer balls carry: less at every load, P = W ΣQ/ΣQ_0 in M1 = z (P/C0)^y P d_m
                    false => *f1_factor *= (pressing / weight).powf(1.0 + *f1_exponent),
                }
            }
        }
    }
}

/// Rows in space that press on each other.
fn pressing(bearing: &Bearing) -> Option<Vec<(usize, SpatialBall<f64>)>> {
    let own = bearing.spatial.as_ref()?;
    if bearing.axial_preload <= 0.0 {
        return None;
    }
    let contacts = ball_contacts(bearing).ok()?;
    let rows = spatial::rows((bearing, own), &contacts, Vec3::zero()).ok()?;
    Some(rows.into_iter().map(|row| (row.balls, row.ball)).collect())
}

/// A bearing that follows its temperatures.
#[derive(Debug)]
pub(crate) struct FollowedBearing {
    follows: Follows,
    /// As it is at the start.
    bearing: Bearing,
    gravity: Vec2<f64>,
}

/// As which it was made last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    /// Diametral, m.
    pub clearance: f64,
    viscosity: f64,
    /// Least diametral clearance so far, m.
    pub least: f64,
    /// When it closed, s.
    pub closed: Option<f64>,
    /// Smallest and largest preload at rest of a pair in space so far, N.
    pub preload: Option<[f64; 2]>,
    /// When a pressed ring became loose on its shaft, in its housing, s.
    pub loose: [Option<f64>; 2],
}

impl FollowedBearing {
    /// None where nothing of it follows.
    pub fn of(warm: Option<&Warm>, bearing: &Bearing, gravity: Vec2<f64>) -> Option<Self> {
        Some(FollowedBearing {
            follows: Follows::of(warm?, bearing)?,
            bearing: bearing.clone(),
            gravity,
        })
    }

    /// Whether it is another one at these temperatures of its nodes (°C) and this speed of its inner race (rad/s) than it was in this state.
    pub fn moved(&self, last: Option<State>, nodes: &[f64], speed: f64) -> bool {
        let Some(last) = last else {
            return true;
        };
        let follows = &self.follows;
        let closes = (follows.clearance(nodes, speed) - last.clearance).abs() > CLOSES;
        let thins = (follows.viscosity(nodes) / last.viscosity - 1.0).abs() > THINS;
        let grows = follows.closes(&self.bearing)
            || follows.tilts(&self.bearing)
            || follows.swells(&self.bearing);
        closes && grows || thins && follows.thins(&self.bearing)
    }

    /// Its constants at these temperatures of its nodes, °C, and this speed of its inner race, rad/s, at a time, s, where they are others
    /// now; why no law holds there.
    pub fn renewed(
        &self,
        last: &mut Option<State>,
        (nodes, speed): (&[f64], f64),
        time: f64,
        now: &BearingConstants,
    ) -> Result<BearingConstants, String> {
        let mut bearing = self.bearing.clone();
        self.follows.condition(&mut bearing, nodes, speed);
        let constants = ball_contacts(&bearing)
            .and_then(|contacts| match (now, &bearing.spatial) {
                (BearingConstants::Spatial(now), Some(own)) => {
                    let gravity = now.rows[0].ball.gravity;
                    let mut rows = spatial::rows((&bearing, own), &contacts, gravity)?;
                    if self.follows.swells(&bearing) {
                        let grown = self.follows.expansion(nodes);
                        for row in &mut rows {
                            row.ball = row.ball.expanded(&grown);
                        }
                    }
                    let other = SpatialBearing {
                        rows,
                        ..now.clone()
                    };
                    Ok(BearingConstants::Spatial(other))
                }
                _ => constants_of(&bearing, &contacts, self.gravity),
            })
            .map_err(|problem| problem.found)?;
        let clearance = self.follows.clearance(nodes, speed);
        let closed = last.and_then(|last| last.closed);
        let loose = self.follows.loose(nodes);
        let loose = [0, 1].map(|seat| {
            let before = last.and_then(|last| last.loose[seat]);
            before.or_else(|| loose[seat].then_some(time))
        });
        let opened = self.bearing.operating_diametral_clearance >= 0.0;
        let closes = clearance < 0.0 && opened && self.follows.closes(&self.bearing);
        *last = Some(State {
            clearance,
            viscosity: self.follows.viscosity(nodes),
            least: last.map_or(clearance, |last| last.least.min(clearance)),
            closed: closed.or_else(|| closes.then_some(time)),
            preload: self.follows.preload(nodes).map(|now| {
                let [least, most] = last.and_then(|last| last.preload).unwrap_or([now; 2]);
                [least.min(now), most.max(now)]
            }),
            loose,
        });
        Ok(constants)
    }
}

/// Work that was done on loaded balls by rings that closed on them, as the constants of a machine changed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Renewals {
    /// Instants, s, and the work until then, J.
    work: Vec<(f64, f64)>,
}

impl Renewals {
    /// At a time, s, rings have closed on loaded balls and done this work, J.
    pub fn book(&mut self, time: f64, work: f64) {
        let before = self.work.last().map_or(0.0, |(_, work)| *work);
        if work != 0.0 {
            self.work.push((time, before + work));
        }
    }
    /// Work of rings that close on loaded balls until an instant, J.
    pub fn work_until(&self, time: f64) -> f64 {
        let past = self.work.partition_point(|(at, _)| *at < time);
        past.checked_sub(1).map_or(0.0, |last| self.work[last].1)
    }
    /// What must close, with that work as a source, until an instant.
    pub fn booked(&self, time: f64, (content, mut flows): (Content, Flows)) -> (Content, Flows) {
        let work = self.work_until(time);
        flows.work += work;
        flows.work_size += work.abs();
        (content, flows)
    }
}
