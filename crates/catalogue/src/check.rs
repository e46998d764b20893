//! Refuses a bearing whose numbers contradict each other.

use super::complete::mass_of_ball;
use super::draft::{Draft, Read, Reader};
use super::geometry::{Geometry, digits, millimetres, rating_beyond_balls};
use problem::{Code, Problem};

/// Refuses contradictions.
pub(super) fn check(draft: &Draft, reader: &Reader<'_>) -> Read<()> {
    let context = Context { draft, reader };
    context.geometry()?;
    context.shoulder()?;
    context.static_rating()?;
    context.mass()
}

struct Context<'a, 'r> {
    draft: &'a Draft,
    reader: &'a Reader<'r>,
}

impl Context<'_, '_> {
    fn number(&self, key: &str) -> Option<f64> {
        self.draft.bearing.number(key)
    }

    fn text(&self, key: &str) -> &str {
        self.draft
            .bearing
            .value(key)
            .map_or("", |value| value.text())
    }

    /// The problem stands at the first of the keys that the file has.
    fn refuse(&self, code: Code, keys: &[&str], found: String, allowed: String) -> Box<Problem> {
        let given = |key: &&&str| self.draft.starts.iter().find(|start| start.0 == **key);
        let start = keys.iter().find_map(|key| given(&key));
        let (key, start) = start.copied().unwrap_or(("name", self.draft.start));
        let found = format!("{found} in bearing \"{}\"", self.draft.bearing.name);
        self.reader.problem(code, start, key, found, allowed)
    }

    /// Diameters, width and balls go together.
    fn geometry(&self) -> Read<()> {
        let geometry = Geometry {
            bore: self.number("bore_diameter"),
            outside: self.number("outer_diameter"),
            width: self.number("width"),
            pitch: self.number("pitch_diameter"),
            ball: self.number("ball_diameter"),
            count: self.number("ball_count"),
        };
        let Some(found) = geometry.contradiction(&|key| self.text(key).to_string()) else {
            return Ok(());
        };
        let given = |key: &str| self.draft.starts.iter().any(|start| start.0 == key);
        let mut blames = found.blames;
        let first = blames.iter().position(|blame| given(blame.key));
        let blame = blames.swap_remove(first.unwrap_or(0));
        Err(self.refuse(found.code, &[blame.key], blame.found, blame.allowed))
    }

    /// The shoulder lies between the bottom of the groove and the ball centres, and above the bore.
    fn shoulder(&self) -> Read<()> {
        let (Some(shoulder), Some(ball), Some(pitch)) = (
            self.number("inner_shoulder_diameter"),
            self.number("ball_diameter"),
            self.number("pitch_diameter"),
        ) else {
            return Ok(());
        };
        let bore = self.number("bore_diameter").unwrap_or(0.0);
        let least = (pitch - ball).max(bore);
        if shoulder > least && shoulder < pitch {
            return Ok(());
        }
        Err(self.refuse(
            Code::BearingGeometry,
            &["inner_shoulder_diameter", "pitch_diameter", "ball_diameter"],
            format!("a shoulder of {}", self.text("inner_shoulder_diameter")),
            format!(
                "between {} (bottom of the groove) and {} (ball centres) is needed",
                millimetres(least),
                millimetres(pitch)
            ),
        ))
    }

    fn static_rating(&self) -> Read<()> {
        let (Some(rating), Some(count), Some(ball)) = (
            self.number("static_load_rating"),
            self.number("ball_count"),
            self.number("ball_diameter"),
        ) else {
            return Ok(());
        };
        let angle = self.number("contact_angle").unwrap_or(0.0);
        let area = count * ball * ball * angle.cos();
        let Some(allowed) = rating_beyond_balls(rating, area) else {
            return Ok(());
        };
        Err(self.refuse(
            Code::RatingContradictsBalls,
            &["static_load_rating", "ball_count", "ball_diameter"],
            format!(
                "{} with {count} balls of {}",
                self.text("static_load_rating"),
                self.text("ball_diameter")
            ),
            allowed,
        ))
    }

    /// Inner race, balls and cage weigh less than the bearing.
    fn mass(&self) -> Read<()> {
        let bearing = &self.draft.bearing;
        let (Some(mass), Some(race), Some(count), Some(ball)) = (
            self.number("mass"),
            self.number("inner_race_mass"),
            self.number("ball_count"),
            self.number("ball_diameter"),
        ) else {
            return Ok(());
        };
        let cage = self.number("cage_mass").unwrap_or(0.0);
        let parts = race + cage + count * mass_of_ball(bearing, ball);
        if parts < mass {
            return Ok(());
        }
        Err(self.refuse(
            Code::BearingGeometry,
            &["mass", "inner_race_mass", "ball_diameter"],
            format!("a mass of {}", self.text("mass")),
            format!(
                "more than {} g is needed, which inner race, balls and cage weigh",
                digits(parts * 1e3)
            ),
        ))
    }
}
