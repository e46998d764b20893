//! Diameters of a ball bearing that contradict each other: one check, for files of bearings and for scenarios.
//!
//! ```text
//!   bore < inner track = pitch - ball < pitch < outer track = pitch + ball < outside
//! ```
//! and the balls fit beside each other on the pitch circle, and within the width.

use problem::Code;
use std::f64::consts::PI;

/// What is known of a bearing: lengths in m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Bore of the inner ring, m.
    pub bore: Option<f64>,
    /// Outside diameter, m.
    pub outside: Option<f64>,
    /// Width, m.
    pub width: Option<f64>,
    /// Diameter of the circle of ball centres, m.
    pub pitch: Option<f64>,
    /// Diameter of a ball, m.
    pub ball: Option<f64>,
    /// Number of balls.
    pub count: Option<f64>,
}

/// A contradiction, told for each key that may be the wrong one; the most doubtful comes first.
#[derive(Clone, Debug, PartialEq)]
pub struct Contradiction {
    /// What kind of contradiction it is.
    pub code: Code,
    /// The keys that may be wrong, the first of them most likely.
    pub blames: Vec<Blame>,
}

/// What is wrong if it is this key.
#[derive(Clone, Debug, PartialEq)]
pub struct Blame {
    /// The key.
    pub key: &'static str,
    /// What was found there.
    pub found: String,
    /// What would be possible.
    pub allowed: String,
}

const BORE: &str = "bore_diameter";
const OUTSIDE: &str = "outer_diameter";
const WIDTH: &str = "width";
const PITCH: &str = "pitch_diameter";
const BALL: &str = "ball_diameter";
const COUNT: &str = "ball_count";

impl Geometry {
    /// The first contradiction; the texts are the values as they are written.
    pub fn contradiction(&self, text: &dyn Fn(&str) -> String) -> Option<Contradiction> {
        self.order(text)
            .or_else(|| self.rings(text))
            .or_else(|| self.balls_fit(text))
    }

    /// What is smaller than what, pair by pair.
    fn order(&self, text: &dyn Fn(&str) -> String) -> Option<Contradiction> {
        let pairs = [
            ((BORE, self.bore), (OUTSIDE, self.outside), false),
            ((BORE, self.bore), (PITCH, self.pitch), false),
            ((PITCH, self.pitch), (OUTSIDE, self.outside), false),
            ((BALL, self.ball), (PITCH, self.pitch), false),
            ((BALL, self.ball), (WIDTH, self.width), true),
        ];
        pairs.into_iter().find_map(|(small, large, equal)| {
            let (a, b) = (small.1?, large.1?);
            if a < b || (equal && a == b) {
                return None;
            }
            let (less, more) = if equal {
                ("at most", "at least")
            } else {
                ("less than", "more than")
            };
            let blame = |key, word, other| Blame {
                key,
                found: text(key),
                allowed: format!("{word} {other} = {} is needed", text(other)),
            };
            let lower = blame(small.0, less, large.0);
            let upper = blame(large.0, more, small.0);
            Some(Contradiction {
                code: Code::BearingGeometry,
                // a pitch circle inside a ball is doubted before the ball
                blames: if large.0 == PITCH && small.0 == BALL {
                    vec![upper, lower]
                } else {
                    vec![lower, upper]
                },
            })
        })
    }

    /// Something of each ring is left between the balls and its smooth side.
    fn rings(&self, text: &dyn Fn(&str) -> String) -> Option<Contradiction> {
        let (ball, pitch) = (self.ball?, self.pitch?);
        let sides = [
            (BORE, self.bore, 1.0, ("inside", "less", "plus")),
            (OUTSIDE, self.outside, -1.0, ("outside", "plus", "less")),
        ];
        sides.into_iter().find_map(|(side, diameter, sign, words)| {
            let diameter = diameter?;
            let room = sign * (pitch - diameter);
            if ball < room {
                return None;
            }
            let (place, track, wall) = words;
            let blame = |key: &'static str, word, limit: f64, from: String| Blame {
                key,
                found: text(key),
                allowed: format!(
                    "{word} {} is needed, {from}, or no ring is left {place} the balls",
                    millimetres(limit)
                ),
            };
            let named = |key: &str| format!("{key} = {}", text(key));
            let (side_word, pitch_word) = if sign > 0.0 {
                ("less than", "more than")
            } else {
                ("more than", "less than")
            };
            let between = if sign > 0.0 {
                format!("{} less {}", named(PITCH), named(side))
            } else {
                format!("{} less {}", named(side), named(PITCH))
            };
            Some(Contradiction {
                code: Code::BearingGeometry,
                blames: vec![
                    blame(BALL, "less than", room, between),
                    blame(
                        PITCH,
                        pitch_word,
                        diameter + sign * ball,
                        format!("{} {wall} {}", named(side), named(BALL)),
                    ),
                    blame(
                        side,
                        side_word,
                        pitch - sign * ball,
                        format!("{} {track} {}", named(PITCH), named(BALL)),
                    ),
                ],
            })
        })
    }

    /// Balls spaced evenly on the pitch circle do not overlap.
    fn balls_fit(&self, text: &dyn Fn(&str) -> String) -> Option<Contradiction> {
        let (count, ball, pitch) = (self.count?, self.ball?, self.pitch?);
        let half_angle = PI / count;
        let spacing = pitch * half_angle.sin();
        if count < 2.0 || spacing >= ball {
            return None;
        }
        let most = (PI / (ball / pitch).asin()).floor();
        let found = format!(
            "{count} balls of {} on a pitch circle of {}, whose centres are only {} apart",
            text(BALL),
            text(PITCH),
            millimetres(spacing)
        );
        let blame = |key, allowed| Blame {
            key,
            found: found.clone(),
            allowed,
        };
        Some(Contradiction {
            code: Code::BallsDoNotFit,
            blames: vec![
                blame(COUNT, format!("at most {most} balls fit")),
                blame(
                    BALL,
                    format!("balls of at most {} fit", millimetres(spacing)),
                ),
                blame(
                    PITCH,
                    format!(
                        "a pitch circle of at least {} holds them",
                        millimetres(ball / half_angle.sin())
                    ),
                ),
            ],
        })
    }
}

/// Static load rating over Z D² cos α, N/m²: makers' values lie between 6e6 (spindle bearings with open grooves) and
/// 22e6; beyond these limits a digit or a unit is wrong.
const RATING: (f64, f64) = (2e6, 60e6);

/// What is allowed instead of a static load rating, N, that balls of this area Z D² cos α, m², cannot have.
pub fn rating_beyond_balls(rating: f64, area: f64) -> Option<String> {
    let (least, most) = (RATING.0 * area, RATING.1 * area);
    (!(least..=most).contains(&rating)).then(|| {
        format!(
            "between {} kN and {} kN is needed: 2 to 60 N/mm² times Z D² cos α; makers' bearings have 6 to 22",
            digits(least * 1e-3),
            digits(most * 1e-3)
        )
    })
}

/// A number for a message, to four digits.
pub fn digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    units::number_text(rounded)
}

/// A length for a message, to four digits.
pub fn millimetres(length: f64) -> String {
    format!("{} mm", digits(length * 1e3))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A 6005: bore 25, outside 47, width 12, ten balls of 6.35 on 36 mm.
    const SOUND: Geometry = Geometry {
        bore: Some(25e-3),
        outside: Some(47e-3),
        width: Some(12e-3),
        pitch: Some(36e-3),
        ball: Some(6.35e-3),
        count: Some(10.0),
    };

    fn keys(geometry: Geometry) -> Vec<&'static str> {
        let found = geometry.contradiction(&|key| key.to_string());
        let blames = found.map_or(Vec::new(), |found| found.blames);
        blames.into_iter().map(|blame| blame.key).collect()
    }

    #[test]
    fn a_sound_bearing_and_one_of_which_little_is_known_pass() {
        assert!(keys(SOUND).is_empty());
        assert!(keys(Geometry::default()).is_empty());
    }

    #[test]
    fn every_contradiction_can_be_told_of_each_key_in_it() {
        let with = |change: fn(&mut Geometry)| {
            let mut geometry = SOUND;
            change(&mut geometry);
            keys(geometry)
        };
        assert_eq!(with(|g| g.outside = Some(20e-3)), [BORE, OUTSIDE]);
        assert_eq!(with(|g| g.pitch = Some(24e-3)), [BORE, PITCH]);
        assert_eq!(with(|g| g.pitch = Some(48e-3)), [PITCH, OUTSIDE]);
        assert_eq!(with(|g| g.ball = Some(37e-3)), [PITCH, BALL]);
        assert_eq!(with(|g| g.width = Some(6e-3)), [BALL, WIDTH]);
        // 31 - 6.35 = 24.65 mm is inside the bore, 41 + 6.35 = 47.35 mm outside the outer ring
        assert_eq!(with(|g| g.pitch = Some(31e-3)), [BALL, PITCH, BORE]);
        assert_eq!(with(|g| g.pitch = Some(41e-3)), [BALL, PITCH, OUTSIDE]);
        assert_eq!(with(|g| g.count = Some(18.0)), [COUNT, BALL, PITCH]);
    }

    #[test]
    fn each_blame_names_the_limit_that_would_do() {
        let narrow = Geometry {
            pitch: Some(31e-3),
            ..SOUND
        };
        let found = narrow.contradiction(&|key| key.to_string()).unwrap();
        for (blame, limit) in found.blames.iter().zip(["6 mm", "31.35 mm", "24.65 mm"]) {
            assert!(blame.allowed.contains(limit), "{blame:?}");
        }
    }
}
