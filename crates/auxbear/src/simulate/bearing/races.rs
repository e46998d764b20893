//! What the races have seen of their balls: flashes where balls skid, dents, rolling fatigue.

use crate::result::list::{List, NOT_GIVEN, Origin};
use crate::result::outcome::{Warning, warning};
use crate::scenario::Bearing;
use crate::simulate::bearing::run::BearingRun;
use crate::simulate::bearing::severity::STEEL_CHANGES;
use model::bearing::BearingConstants;
use model::system::race_record::{RaceRecord, RaceSeen};
use physics::life::RatedBearing;

const SIDES: [&str; 2] = ["inner", "outer"];

impl BearingRun<'_> {
    /// What the races have seen of balls that may slide.
    fn races_of_balls(&self) -> Option<&RaceRecord> {
        let planar = matches!(self.bearing, BearingConstants::Planar(_));
        self.races.filter(|_| planar)
    }
    /// A contact of ball and race that got too hot, and by how much it warmed, K.
    pub fn hot_skid(&self) -> Option<(f64, Warning)> {
        let races = &self.races_of_balls()?.races;
        let hotter = usize::from(races[1].flash.rise.value > races[0].flash.rise.value);
        let flash = &races[hotter].flash;
        let rise = flash.rise.value;
        let text = format!(
            "Where a ball skids on the {} race, their surfaces flash up by {rise:.0} K ({:.2} ms: {:.0} N, slip {:.1} m/s): steel is \
             tempered and may smear there, a lubricant is burnt, and the traction of this run no longer holds.",
            SIDES[hotter],
            1e3 * flash.rise.time,
            flash.load,
            flash.slip
        );
        (rise > STEEL_CHANGES).then(|| (rise, warning("AB2303", text)))
    }
}

impl List {
    /// The hottest contact of balls and each race, and how often a ball dented it; nothing where balls roll always.
    pub fn races(&mut self, run: &BearingRun) {
        let Some(record) = run.races_of_balls() else {
            return;
        };
        for (side, seen) in SIDES.into_iter().zip(&record.races) {
            let RaceSeen { flash, dents, .. } = seen;
            for (what, unit, value) in [
                ("flash_temperature_rise", "K", flash.rise.value),
                ("flash_time", "s", flash.rise.time),
            ] {
                self.number(&format!("{side}_{what}"), unit, Ok(value), &FLASH);
            }
            let count = *dents as f64;
            self.number(&format!("{side}_denting_passages"), "", Ok(count), &DENTS);
        }
    }

    /// What rolling fatigue takes of the life of the bearing.
    pub fn life_share(&mut self, bearing: &Bearing, record: Option<&RaceRecord>) {
        let rating = (bearing.dynamic_load_rating)
            .ok_or_else(|| format!("bearing.dynamic_load_rating{NOT_GIVEN}"));
        let used = |(rating, record): (f64, &RaceRecord)| {
            let [inner, outer] = &record.races;
            rated(bearing, rating).damage([&inner.sums, &outer.sums])
        };
        let none = || "the bearing has no balls".to_string();
        let known = rating.and_then(|rating| Ok((rating, record.ok_or_else(none)?)));
        self.number("life_share", "1", known.map(used), &LIFE);
    }
}

/// What the standard asks for of a bearing of a dynamic rating, N.
fn rated(bearing: &Bearing, rating: f64) -> RatedBearing {
    RatedBearing {
        rating,
        ball_count: bearing.ball_count as f64,
        gamma: bearing.ball_diameter * bearing.contact_angle.cos() / bearing.pitch_diameter,
        grooves: [
            bearing.inner_groove_curvature,
            bearing.outer_groove_curvature,
        ],
        contact_angle: bearing.contact_angle,
    }
}

const FILE: &str = "crates/model/src/system/race_record.rs";
const FLASH: Origin = Origin {
    law: "largest 1.19 q b/(G_ball + G_race) over all balls, q = μQ|u|/(πab), G = ½ k √(π(B + Pe)), Pe = |U| b/(2α): flash of both \
          surfaces above their own means, and its time",
    source: "J. C. Jaeger 1942, H. Blok 1937, crates/physics/src/flash.rs; 32 looks a turn, crates/model/src/system/race_record.rs",
    valid: "within 4 % of Hertz's ellipse that moves steadily; what the law of traction is off, the flash is off; asperities are hotter, \
            and traction does not follow it",
};
const DENTS: Origin = Origin {
    law: "how often the load of a ball rose above that of bearing.hertz_pressure_limit",
    source: FILE,
    valid: "32 looks a turn: shorter blows may be missed, hertz_pressure_share_of_limit misses none",
};
const LIFE: Origin = Origin {
    law: "Σ Q³ of the balls that pass each point of both rings over the rating loads of ISO/TS 16281, to the power 10/9: share of the \
          life L10, which 10 % of bearings do not reach",
    source: "heat-and-life, section 8; crates/physics/src/life.rs, crates/model/src/system/race_record.rs",
    valid: "Q below that of half the dynamic rating; 32 looks a turn; without lubricant factor (0.1 to 50). Blows that dent count by \
            largest_indentation",
};
