//! What the races of a bearing have seen of their balls in a run: an observer.
//!
//! ```text
//!   S(φ) = Σ Q³ over the balls that pass a point φ of a ring        rolling fatigue
//!   loads that rise above the one that dents                        indentation
//!   flash of the hottest contact of ball and race                   where balls skid
//! ```
//! It looks a few times a turn. Between two looks a ball passes the points between its places with the cubes of its loads between
//! those seen. Points of the inner ring turn with it, so that a load that goes round with the shaft stays where it is.
//!
//! Source: heat-and-life, sections 4, 7 and 8. Range: a load or a flash that lasts shorter than a look may be missed.

use super::sampling::Peak;
use crate::bearing::{BearingConstants, PlanarConstants};
use crate::motion::Motion;
use solve::{Machine, Step};
use std::f64::consts::PI;
use std::ops::Range;

/// Points of a ring.
const POINTS: usize = 180;
/// Looks a turn of the shaft.
const LOOKS: f64 = 32.0;
/// The hottest contact is searched for where slip times the root of the load comes this near to the record's: both make the flash,
/// friction and entrainment change it little.
const NEAR_RECORD: f64 = 0.8;

/// The hottest contact of balls and one race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flash {
    /// Rise of both surfaces above their means, K.
    pub rise: Peak,
    /// Load of that contact, N.
    pub load: f64,
    /// Its slip, m/s.
    pub slip: f64,
    /// Slip times root of the load of the record, (m/s)√N.
    score: f64,
}

/// What one race has seen.
#[derive(Clone, Debug, PartialEq)]
pub struct RaceSeen {
    /// Σ Q³ at each of its points, N³.
    pub sums: Vec<f64>,
    /// How often the load of a ball rose above the one that dents.
    pub dents: u64,
    /// The hottest contact.
    pub flash: Flash,
}

/// What both races have seen.
#[derive(Clone, Debug, PartialEq)]
pub struct RaceRecord {
    /// Inner and outer race.
    pub races: [RaceSeen; 2],
    /// Angle from each race, in points, and load of each ball at the last look.
    last: Vec<[(f64, f64); 2]>,
    next: f64,
    interval: f64,
}

/// What a look shows.
pub struct Seen<'a> {
    /// s.
    pub time: f64,
    /// Of the races.
    pub motion: Motion<f64>,
    /// The bearing's own states.
    pub state: &'a [f64],
    /// Its detail: see [`bearing`](crate::bearing).
    pub detail: &'a [f64],
}

impl RaceRecord {
    /// An empty record of a shaft of a speed, rad/s.
    pub fn new(speed: f64) -> Self {
        let race = RaceSeen {
            sums: vec![0.0; POINTS],
            dents: 0,
            flash: Flash {
                rise: Peak::NONE,
                load: 0.0,
                slip: 0.0,
                score: 0.0,
            },
        };
        RaceRecord {
            races: [race.clone(), race],
            last: Vec::new(),
            next: 0.0,
            interval: 2.0 * PI / (LOOKS * speed.abs().max(1.0)),
        }
    }

    /// Whether it is time to look; if so the next look is an interval later.
    pub fn is_due(&mut self, time: f64) -> bool {
        let due = time >= self.next;
        if due {
            self.next = time + self.interval;
        }
        due
    }

    /// Looks at the only bearing of a system a few times a turn: the bearing, its own channels, the first probe of its detail, the
    /// motion of its races in a state.
    pub fn watch<M: Machine>(
        &mut self,
        step: &mut Step<M>,
        (bearing, own, detail): (&BearingConstants, Range<usize>, usize),
        motion: impl Fn(&[f64]) -> Motion<f64>,
    ) {
        let time = step.end;
        if !self.is_due(time) {
            return;
        }
        let (state, probe) = step.evaluate(1.0);
        let seen = Seen {
            time,
            motion: motion(state),
            state: &state[own],
            detail: &probe[detail..],
        };
        self.look(bearing, &seen);
    }

    /// Looks at the balls.
    pub fn look(&mut self, bearing: &BearingConstants, seen: &Seen) {
        let balls = bearing.balls();
        let first = self.last.is_empty();
        let races = [&seen.motion.inner, &seen.motion.outer];
        for ball in 0..balls {
            let azimuth = bearing.azimuth(seen.state, ball);
            let now = [0, 1].map(|race| {
                let place = (azimuth - races[race].angle) * POINTS as f64 / (2.0 * PI);
                (place, seen.detail[race * balls + ball])
            });
            if first {
                self.last.push(now);
                continue;
            }
            for (race, seen) in self.races.iter_mut().enumerate() {
                seen.pass(self.last[ball][race], now[race]);
            }
            if let BearingConstants::Planar(planar) = bearing {
                self.contacts(planar, seen, ball, now.map(|(_, load)| load));
            }
            self.last[ball] = now;
        }
    }

    /// Dents and flashes of a ball with these loads.
    fn contacts(&mut self, bearing: &PlanarConstants, seen: &Seen, ball: usize, loads: [f64; 2]) {
        let Some(contacts) = &bearing.races else {
            return;
        };
        let mut reaction = None;
        for (race, load) in loads.into_iter().enumerate() {
            let (contact, of) = (&contacts[race], &mut self.races[race]);
            let rises = self.last[ball][race].1 <= contact.denting_load;
            of.dents += u64::from(rises && load > contact.denting_load);
            let slip = seen.detail[(2 + race) * bearing.balls + ball].abs();
            let score = slip * load.sqrt();
            if score <= NEAR_RECORD * of.flash.score {
                continue;
            }
            let both = reaction.get_or_insert_with(|| {
                let reaction = bearing.ball_reaction(&seen.motion, seen.state, ball);
                reaction.sliding()
            });
            let (power, surfaces) = both[race];
            let rise = contact.skidding.flash(power, load, surfaces);
            if rise > of.flash.rise.value {
                let time = seen.time;
                of.flash = Flash {
                    rise: Peak { value: rise, time },
                    load,
                    slip,
                    score,
                };
            }
        }
    }
}

impl RaceSeen {
    /// A ball goes from one place, in points, to another, with these loads.
    fn pass(&mut self, from: (f64, f64), to: (f64, f64)) {
        if from.1 <= 0.0 && to.1 <= 0.0 {
            return;
        }
        let cubes = [from.1, to.1].map(|load| load * load * load);
        let distance = to.0 - from.0;
        let pieces = distance.abs().ceil().max(1.0);
        let each = distance.abs() / pieces;
        for piece in 0..pieces as usize {
            let share = (piece as f64 + 0.5) / pieces;
            let point = (from.0 + share * distance).rem_euclid(POINTS as f64) as usize;
            // rounding may reach the end
            self.sums[point % POINTS] += each * (cubes[0] + share * (cubes[1] - cubes[0]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::life::{RatedBearing, passages_per_turn};

    #[test]
    fn constant_motion_uses_the_life_of_the_standard() {
        // nine balls under a load that stands still; the inner ring turns 20 times, the cage as balls that roll make it
        let (balls, gamma, turns) = (9, 0.2, 20.0);
        let load = |angle: f64| 500.0 * angle.cos().max(0.0).powf(1.5);
        let mut record = RaceRecord::new(100.0);
        let looks = 32 * 20;
        for look in 0..=looks {
            let turned = 2.0 * PI * turns * f64::from(look) / f64::from(looks);
            let cage = 0.5 * (1.0 - gamma) * turned;
            let balls: Vec<_> = (0..balls)
                .map(|j| {
                    let azimuth = cage + 2.0 * PI * f64::from(j) / f64::from(balls);
                    let scale = POINTS as f64 / (2.0 * PI);
                    [turned, 0.0].map(|race| ((azimuth - race) * scale, load(azimuth)))
                })
                .collect();
            for (ball, now) in balls.iter().enumerate() {
                if let Some(last) = record.last.get(ball) {
                    for (race, seen) in record.races.iter_mut().enumerate() {
                        seen.pass(last[race], now[race]);
                    }
                }
            }
            record.last = balls;
        }
        let rated = RatedBearing {
            rating: 20e3,
            ball_count: f64::from(balls),
            gamma,
            grooves: [0.52; 2],
            contact_angle: 0.0,
        };
        let found = rated.damage([&record.races[0].sums, &record.races[1].sums]);
        // cubic mean where the load stands against the ring, mean of power 10/3 where it turns
        let mean = |power: f64| {
            let all = (0..3600).map(|k| load(2.0 * PI * f64::from(k) / 3600.0).powf(power));
            (all.sum::<f64>() / 3600.0).powf(1.0 / power)
        };
        let ratings = rated.ball_rating_loads();
        let life = ((mean(3.0) / ratings[0]).powf(10.0 / 3.0)
            + (mean(10.0 / 3.0) / ratings[1]).powf(10.0 / 3.0))
        .powf(-0.9);
        let expected = turns / (1e6 * life);
        assert!(
            (found / expected - 1.0).abs() < 0.01,
            "{}",
            found / expected
        );
        // as many balls have passed a point of each ring as roll past it
        let passed = [0, 1].map(|race| record.races[race].sums.iter().sum::<f64>());
        let passages = passages_per_turn(f64::from(balls), gamma);
        for race in 0..2 {
            let expected = POINTS as f64 * turns * passages[race] * mean(3.0).powi(3);
            assert!((passed[race] / expected - 1.0).abs() < 2e-3);
        }
    }

    #[test]
    fn a_load_that_goes_round_with_the_shaft_wears_one_place_of_the_inner_ring() {
        let mut record = RaceRecord::new(100.0);
        // one ball that the load follows: it stands against the inner ring, and passes the whole outer one once
        record.races[0].pass((10.2, 300.0), (10.4, 300.0));
        for k in 0..POINTS {
            let place = k as f64;
            record.races[1].pass((place, 300.0), (place + 1.0, 300.0));
        }
        let [inner, outer] = &record.races;
        assert_eq!(inner.sums.iter().filter(|sum| **sum > 0.0).count(), 1);
        assert!(
            outer
                .sums
                .iter()
                .all(|sum| (sum / 2.7e7 - 1.0).abs() < 1e-12)
        );
    }
}
