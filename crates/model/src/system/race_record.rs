//! What the races of a bearing have seen of their balls in a run: an observer.
//!
//! ```text
//!   S(φ) = Σ Q³ over the balls that pass a point φ of a ring        rolling fatigue
//!   loads that rise above the one that dents                        indentation
//!   flash of the hottest contact of ball and race                   where balls skid
//! ```
//! It looks a few times a turn, when the largest load has changed, and at the end of every step at which a ball skids harder, by u²Q, than
//! at any look before. Between two looks a ball passes the points between its places
//! with the cubes of its loads between those seen. Points of the inner ring turn with it, so that a load that goes round with the
//! shaft stays where it is.
//!
//! Source: derived; book/src/theory/heat.md. Range: a flash is one of the end of a step; where u²Q is not the largest but the entrainment is smaller, of a look.

use super::sampling::Peak;
use crate::bearing::BearingConstants;
use crate::motion::Motion;
use physics::traction::SlidingContact;
use std::f64::consts::PI;

/// Points of a ring.
const POINTS: usize = 72;
/// Looks a turn of the shaft.
const LOOKS: f64 = 8.0;
/// Change of the largest ball load, over the largest so far, after which it looks again.
const CHANGES: f64 = 0.1;
/// The hottest contact is searched for where slip times the root of the load comes this near to the record's: the flash goes with
/// both, and with the inverse root of the entrainment, which may be four times smaller there.
const NEAR_RECORD: f64 = 0.5;

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
pub struct RaceInstant {
    /// Σ Q³ at each of its points, N³, of one row of balls after the other.
    pub sums: Vec<f64>,
    /// How often the load of a ball rose above the one that dents.
    pub dents: u64,
    /// The hottest contact.
    pub flash: Flash,
    /// Largest u²Q at any look, (m/s)² N.
    skid: f64,
}

/// What both races have seen.
#[derive(Clone, Debug, PartialEq)]
pub struct RaceRecord {
    /// Inner and outer race.
    pub races: [RaceInstant; 2],
    /// Balls of each row.
    rows: Vec<usize>,
    /// Angle from each race, in points, and load of each ball at the last look.
    last: Vec<[(f64, f64); 2]>,
    next: f64,
    interval: f64,
    /// Largest ball load at the last look, and of all steps, N.
    loads: [f64; 2],
}

/// A bearing at an instant.
pub struct BearingInstant<'a> {
    /// The bearing.
    pub bearing: &'a BearingConstants,
    /// s.
    pub time: f64,
    /// Of the races.
    pub motion: Motion<f64>,
    /// The bearing's own states.
    pub state: &'a [f64],
}

impl RaceRecord {
    /// An empty record of a bearing with so many balls in each of its rows, whose shaft has a speed, rad/s.
    pub fn new(rows: &[usize], speed: f64) -> Self {
        let race = RaceInstant {
            sums: vec![0.0; POINTS * rows.len()],
            dents: 0,
            flash: Flash {
                rise: Peak::NONE,
                load: 0.0,
                slip: 0.0,
                score: 0.0,
            },
            skid: 0.0,
        };
        RaceRecord {
            races: [race.clone(), race],
            last: Vec::with_capacity(rows.iter().sum()),
            rows: rows.to_vec(),
            next: 0.0,
            interval: 2.0 * PI / (LOOKS * speed.abs().max(1.0)),
            loads: [0.0; 2],
        }
    }

    /// The race with the hotter contact, 0 the inner one, and that contact.
    pub fn hottest(&self) -> (usize, &Flash) {
        let [inner, outer] = &self.races;
        match outer.flash.rise.value > inner.flash.rise.value {
            true => (1, &outer.flash),
            false => (0, &inner.flash),
        }
    }

    /// Whether it is time to look, with the largest ball load of the bearing, N, and the largest u²Q at both races, (m/s)² N.
    pub fn is_due(&mut self, time: f64, load: f64, skids: [f64; 2]) -> bool {
        let [last, largest] = &mut self.loads;
        *largest = largest.max(load);
        let mut races = self.races.iter().zip(skids);
        let due = time >= self.next
            || (load - *last).abs() > CHANGES * *largest
            || races.any(|(race, skid)| skid > race.skid);
        if due {
            (*last, self.next) = (load, time + self.interval);
            for (race, skid) in self.races.iter_mut().zip(skids) {
                race.skid = race.skid.max(skid);
            }
        }
        due
    }

    /// Σ Q³ at the points of both races under each row of balls, N³.
    pub fn by_row(&self) -> impl Iterator<Item = [&[f64]; 2]> {
        let [inner, outer] = &self.races;
        let rows = inner.sums.chunks(POINTS).zip(outer.sums.chunks(POINTS));
        rows.map(|(inner, outer)| [inner, outer])
    }
    /// Row of a ball.
    fn row(&self, ball: usize) -> usize {
        let mut end = 0;
        let past = self.rows.iter().take_while(|balls| {
            end += **balls;
            end <= ball
        });
        past.count()
    }

    /// Looks at the balls.
    pub fn look(&mut self, seen: &BearingInstant) {
        let first = self.last.is_empty();
        let races = [&seen.motion.inner, &seen.motion.outer].map(|race| race.angle);
        let (motion, state) = (&seen.motion, seen.state);
        (seen.bearing).each_contact(motion, state, &mut |ball, azimuth, contacts| {
            let now = [0, 1].map(|race| {
                let place = (azimuth - races[race]) * (POINTS as f64 / (2.0 * PI));
                (place, contacts[race].load)
            });
            if first {
                self.last.push(now.map(|(place, _)| (place, 0.0)));
            } else {
                let first = POINTS * self.row(ball);
                for (race, seen) in self.races.iter_mut().enumerate() {
                    seen.pass(first, self.last[ball][race], now[race]);
                }
            }
            self.dents_and_flashes(seen, ball, &contacts);
            self.last[ball] = now;
        });
    }

    fn dents_and_flashes(
        &mut self,
        seen: &BearingInstant,
        ball: usize,
        contacts: &[SlidingContact<f64>; 2],
    ) {
        let Some(laws) = seen.bearing.race_laws() else {
            return;
        };
        for (race, contact) in contacts.iter().enumerate() {
            let (law, of) = (&laws[race], &mut self.races[race]);
            let load = contact.load;
            let rises = self.last[ball][race].1 <= law.denting_load;
            of.dents += u64::from(rises && load > law.denting_load);
            let slip = contact.slip.abs();
            let score = slip * load.sqrt();
            if score <= NEAR_RECORD * of.flash.score {
                continue;
            }
            let (power, surfaces) = match seen.bearing {
                BearingConstants::Planar(own) => own.sliding(seen.state, contacts)[race],
                BearingConstants::Spatial(own) => own.sliding(&seen.motion, seen.state, ball)[race],
                BearingConstants::Rolling(_) => continue,
            };
            let rise = law.skidding.flash(power, load, surfaces);
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

impl RaceInstant {
    /// A ball whose row has its points from the first on goes from one place, in points, to another, with these loads.
    fn pass(&mut self, first: usize, from: (f64, f64), to: (f64, f64)) {
        if from.1 <= 0.0 && to.1 <= 0.0 {
            return;
        }
        let cubes = [from.1, to.1].map(|load| load * load * load);
        let distance = to.0 - from.0;
        let pieces = distance.abs().ceil().max(1.0);
        let each = distance.abs() / pieces;
        // signed integers: what turns them into numbers and back is one instruction each
        for piece in 0..pieces as i64 {
            let share = (piece as f64 + 0.5) / pieces;
            let turns = (from.0 + share * distance) * (1.0 / POINTS as f64);
            let point = ((turns - whole_below(turns)) * POINTS as f64) as i64 as usize;
            // rounding may reach the end
            self.sums[first + point.min(POINTS - 1)] +=
                each * (cubes[0] + share * (cubes[1] - cubes[0]));
        }
    }
}

/// The largest whole number that is not above a number below 2^63 in size, without the call that `floor` is.
fn whole_below(value: f64) -> f64 {
    let towards_zero = value as i64 as f64;
    towards_zero - f64::from(u8::from(towards_zero > value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::life::{RatedBearing, bearing_damage, mean_damage, passages_per_turn};

    #[test]
    fn constant_motion_uses_the_life_of_the_standard() {
        // nine balls under a load that stands still; the inner ring turns 20 times, the cage as balls that roll make it
        let (balls, gamma, turns) = (9, 0.2, 20.0);
        let load = |angle: f64| 500.0 * angle.cos().max(0.0).powf(1.5);
        let mut record = RaceRecord::new(&[9], 100.0);
        let looks = LOOKS as i32 * 20;
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
                        seen.pass(0, last[race], now[race]);
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
        let points = rated.by_point([&record.races[0].sums, &record.races[1].sums]);
        let [inner, outer] = points.map(|ring| mean_damage(&ring));
        let found = bearing_damage(inner, outer);
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
        let mut record = RaceRecord::new(&[1], 100.0);
        // one ball that the load follows: it stands against the inner ring, and passes the whole outer one once
        record.races[0].pass(0, (10.2, 300.0), (10.4, 300.0));
        for k in 0..POINTS {
            let place = k as f64;
            record.races[1].pass(0, (place, 300.0), (place + 1.0, 300.0));
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
