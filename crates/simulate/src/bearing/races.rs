//! What the races have seen of their balls: flashes where balls skid, dents, rolling fatigue.

use crate::bearing::run::BearingRun;
use crate::bearing::severity::STEEL_CHANGES;
use crate::bearing::warm::{Followed, Heated};
use crate::bearing::warning_table::BearingWarning;
use crate::coast_down::build::ICE_POINT;
use model::system::layout::of_part;
use model::system::race_record::RaceRecord;
use outcome::list::results;
use outcome::list::{not_given, origins};
use outcome::{Quantity, Value, Warning};
use physics::life::{
    RatedBearing, add_points, bearing_damage, iso_life_factor, mean_damage, of_rows,
    reference_viscosity, repetitions, temperature_factor,
};
use physics::viscosity::Viscosity;
use scenario::{Bearing, Warm};
use std::f64::consts::TAU;
use thermal::bearing_network::{INNER_RACE, LUBRICANT, OUTER_RACE};

const SIDES: [&str; 2] = ["inner", "outer"];
/// How the names of life by points end.
pub const LIFE_BY_POINT: &str = "life_share_by_point";

/// Share of the life of a bearing by that at the points of its rings.
pub(crate) fn used_by([inner, outer]: &[Vec<f64>; 2]) -> f64 {
    bearing_damage(mean_damage(inner), mean_damage(outer))
}

impl BearingRun<'_> {
    /// What the races have seen of balls that may slide.
    fn races_of_balls(&self) -> Option<&RaceRecord> {
        self.bearing.race_laws()?;
        self.record?.races.as_ref()
    }
    /// A contact of ball and race that got too hot, and by how much it warmed, K.
    pub fn hot_skid(&self) -> Option<(f64, Warning)> {
        let (side, flash) = self.races_of_balls()?.hottest();
        let rise = flash.rise.value;
        let warning = BearingWarning::HotSkid {
            race: SIDES[side].to_string(),
            rise,
            time: flash.rise.time,
            load: flash.load,
            slip: flash.slip,
        };
        (rise > STEEL_CHANGES).then(|| (rise, warning.into()))
    }
}

results! {
    /// The hottest contact of balls and each race, and how often a ball dented it.
    pub(super) fn races(setup: &(), run: &RaceRecord) {
        "inner_flash_temperature_rise": number "K", FLASH, "largest flash temperature of a ball contact at the inner race" => run.races[0].flash.rise.value;
        "inner_flash_time": number "s", FLASH, "instant of this flash" => run.races[0].flash.rise.time;
        "inner_denting_passages": number "", DENTS, "ball loads above the denting load at the inner race" => run.races[0].dents as f64;
        "outer_flash_temperature_rise": number "K", FLASH, "largest flash temperature of a ball contact at the outer race" => run.races[1].flash.rise.value;
        "outer_flash_time": number "s", FLASH, "instant of this flash" => run.races[1].flash.rise.time;
        "outer_denting_passages": number "", DENTS, "ball loads above the denting load at the outer race" => run.races[1].dents as f64;
        "skid_temperature_index": number "1", INDEX, "largest flash over that which tempers steel" in worst "balls that skid too hot" => run.hottest().1.rise.value / STEEL_CHANGES;
    }
}

/// What rolling fatigue takes of the life of a bearing whose dynamic rating is given.
pub(crate) struct Life {
    /// By the load alone.
    pub share: f64,
    /// With the life factor of its lubricant.
    pub with_lubricant: Result<f64, String>,
    /// At the points of both rings, with that factor where it is known.
    pub points: [Vec<f64>; 2],
    /// Whether the run lasts to its end, or to the standstill, so that this is all that it takes.
    pub is_all: bool,
}

impl Life {
    /// Of a bearing with what its races have seen and the life factor of its lubricant at a share without it, or why that is not known.
    pub fn of(
        bearing: &Bearing,
        record: &RaceRecord,
        factor: impl FnOnce(f64) -> Result<f64, String>,
    ) -> Option<Life> {
        let rated = rated(bearing, bearing.dynamic_load_rating?);
        let rows = record.by_row().map(|sums| rated.by_point(sums));
        let (inner, outer): (Vec<_>, Vec<_>) = rows.map(|[inner, outer]| (inner, outer)).unzip();
        let points = [of_rows(&inner), of_rows(&outer)];
        let share = used_by(&points);
        let factor = factor(share);
        let lasts = factor.clone().unwrap_or(1.0);
        Some(Life {
            share,
            with_lubricant: factor.map(|factor| share / factor),
            points: points.map(|ring| ring.into_iter().map(|damage| damage / lasts).collect()),
            is_all: true,
        })
    }
    /// After how many of them so many bearings are left.
    pub fn repeated(&self, survival: f64) -> Result<f64, String> {
        let share = self.with_lubricant.as_ref().unwrap_or(&self.share);
        match self.is_all {
            true => drops(*share, survival),
            false => Err(NOT_WHOLE.to_string()),
        }
    }
}

/// Why nothing is known of the life of a bearing.
pub(crate) fn no_rating(rating: Option<f64>) -> Option<String> {
    not_given("bearing.dynamic_load_rating", rating)
}

/// The life factor of the lubricant under a mean load, N, at a mean speed, rad/s.
pub(crate) fn lubricant_factor(run: &Followed, load: f64, speed: f64) -> Result<f64, String> {
    let of = run.heated;
    let (rating, oil) = factor_data(&of).ok_or("no lubricant is known")?;
    let warmest = |node: usize| run.warmth.peaks[node].0;
    let kappa = viscosity_ratio(of.given, oil.held(warmest(LUBRICANT) + ICE_POINT), speed);
    let hot = warmest(INNER_RACE).max(warmest(OUTER_RACE));
    Ok(life_factor(of.given, rating, load, kappa, hot))
}

/// What that factor needs.
fn factor_data(of: &Heated) -> Option<(f64, Viscosity)> {
    of.bearing.static_load_rating.zip(of.part.oil)
}

fn no_factor(of: &Heated) -> Option<String> {
    let keys = "bearing.static_load_rating or viscosity_points";
    not_given(keys, factor_data(of))
}

results! {
    /// What a drop takes of the life of a bearing, whose temperatures may be followed.
    pub(crate) fn life(setup: &(Option<f64>, Option<Heated>), run: &Life) {
        "life_share": number "1", LIFE, "share of the rating life that this run takes" in added_up "rolling fatigue, of L10" in life "Share of the life L10 that it uses", unless no_rating(setup.0) => run.share;
        "life_share_with_lubricant": number "1", LUBRICATED, "the same with the life factor of the lubricant" in added_up "rolling fatigue, of L10" in life "Share with lubricant, cleanliness and temperature" when setup.1.is_some(), unless {
            no_rating(setup.0).or(setup.1.as_ref().and_then(no_factor))
        } => run.with_lubricant.clone();
        "inner_life_share_by_point": list "1", BY_POINT, "share of life at each point of the inner ring" when setup.0.is_some() => run.points[0].clone();
        "outer_life_share_by_point": list "1", BY_POINT, "share of life at each point of the outer ring" when setup.0.is_some() => run.points[1].clone();
        "drops_until_one_percent_fail": number "", DROPS, "drops after which 1 % of bearings have failed" in life "Drops until 1 % of bearings have failed", unless no_rating(setup.0) => run.repeated(0.99);
        "drops_until_ten_percent_fail": number "", DROPS, "drops after which 10 % of bearings have failed" in life "Drops until 10 % of bearings have failed", unless no_rating(setup.0) => run.repeated(0.9);
        "drops_until_fifty_percent_fail": number "", DROPS, "drops after which 50 % of bearings have failed" in life "Drops until 50 % of bearings have failed", unless no_rating(setup.0) => run.repeated(0.5);
    }
}

/// After how many drops so many bearings are left.
const DROPS_UNTIL: [(&str, f64); 3] = [
    ("drops_until_one_percent_fail", 0.99),
    ("drops_until_ten_percent_fail", 0.9),
    ("drops_until_fifty_percent_fail", 0.5),
];

fn drops(share: f64, survival: f64) -> Result<f64, String> {
    let none = || {
        let why = match share.is_nan() {
            true => "what it takes of the life is not known",
            false => "no ball loaded a race that turned",
        };
        why.to_string()
    };
    (share > 0.0)
        .then(|| repetitions(share, survival))
        .ok_or_else(none)
}

/// Why a run that did not end as planned has no number of drops: what it takes of a bearing is not all known.
const NOT_WHOLE: &str = "the run did not go on to its end, or to the standstill: what one takes is not all known, and may be the whole bearing";

/// Takes the numbers of drops from a run that did not go on to its end or to the standstill.
pub(crate) fn without_count(list: &mut [Quantity]) {
    let of_drops = |name: &str| DROPS_UNTIL.iter().any(|(known, _)| name.ends_with(known));
    for quantity in list.iter_mut().filter(|quantity| of_drops(&quantity.name)) {
        quantity.value = Value::None {
            why: NOT_WHOLE.to_string(),
        };
    }
}

/// Points that those of a drop and of its coast-down are added at.
const PLACES: usize = 360;

/// The drops that a bearing survives where each goes on until the rotor stands: what the coast-down takes adds up with what the drop has
/// taken, point by point.
pub(crate) fn count_coast_down(drop: &mut [Quantity], bearing: &str, coast_down: &[Quantity]) {
    let points = |list: &[Quantity], name: &str| -> Option<Vec<f64>> {
        let found = list.iter().find(|quantity| quantity.name == name)?;
        match &found.value {
            Value::List(points) if !points.is_empty() => Some(points.clone()),
            _ => None,
        }
    };
    let ring = |side: &str| {
        let name = format!("{side}_{LIFE_BY_POINT}");
        let taken = points(drop, &of_part(bearing, &name))?;
        let then = points(coast_down, &of_part(bearing, &format!("coast_down.{name}")));
        let mut sum = vec![0.0; PLACES];
        add_points(&mut sum, &taken, 1.0);
        Some(then.map(|then| {
            add_points(&mut sum, &then, 1.0);
            sum
        }))
    };
    // without a life of the drop it has said why
    let (Some(inner), Some(outer)) = (ring(SIDES[0]), ring(SIDES[1])) else {
        return;
    };
    let share = inner
        .zip(outer)
        .map(|(inner, outer)| used_by(&[inner, outer]));
    let share = share.ok_or_else(|| "the coast-down has no life".to_string());
    for (name, survival) in DROPS_UNTIL {
        let name = of_part(bearing, name);
        for quantity in drop.iter_mut().filter(|quantity| quantity.name == name) {
            let share = share.clone();
            quantity.value = share.and_then(|share| drops(share, survival)).into();
        }
    }
}

/// Pitch diameter up to which C_u = C0/22, m. Source: ISO 281:2007 (from memory).
const SMALL: f64 = 0.1;

/// Life factor of lubricant and cleanliness, a_ISO, with the rating of a hot ring in it: static rating and load, N, κ, and the
/// temperature of the hotter ring, °C.
pub(crate) fn life_factor(warm: &Warm, static_rating: f64, load: f64, kappa: f64, hot: f64) -> f64 {
    let fatigue = static_rating / 22.0 * (SMALL / warm.pitch_diameter.max(SMALL)).sqrt();
    let ratio = warm.heat.contamination * fatigue / load;
    iso_life_factor(kappa, ratio) * temperature_factor(hot).powi(3)
}

/// κ of a lubricant of this viscosity, m²/s, at a speed, rad/s.
pub(crate) fn viscosity_ratio(warm: &Warm, viscosity: f64, speed: f64) -> f64 {
    1e6 * viscosity / reference_viscosity(speed * 60.0 / TAU, 1e3 * warm.pitch_diameter)
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
origins! {
    FLASH: law "largest 1.19 q b/(G_ball + G_race) over all balls, q = μQ|u|/(πab), G = ½ k √(π(B + Pe)), Pe = |U| b/(2α): flash of both \
          surfaces above their own means, and its time",
        source "J. C. Jaeger 1942, H. Blok 1937, crates/physics/src/flash.rs, crates/model/src/system/race_record.rs",
        valid "within 4 % of Hertz's ellipse that moves steadily, where the motion is known: it scatters by 7 % with run.tolerance, by a third with the unbalance angle; of the ends of steps, where slip times the root of the load is the largest so far, and of eight looks a turn; what the \
            law of traction is off, the flash is off; asperities are hotter, and traction does not follow it";
    INDEX: law "the larger flash of both races over 500 K",
        source "above about 500 °C steel is tempered and its surface smears; an order",
        valid "as inner_flash_temperature_rise";
    DENTS: law "how often the load of a ball rose above that of bearing.hertz_pressure_limit",
        source FILE,
        valid "eight looks a turn, more where loads change: a load that rises and falls between two looks is not counted; hertz_pressure_share_of_limit misses none";
    LIFE: law "Σ Q³ of the balls that pass each point of both rings over the rating loads of ISO/TS 16281, to the power 10/9: share of the \
          life L10, which 10 % of bearings do not reach",
        source "book/src/theory/heat.md; crates/physics/src/life.rs, crates/model/src/system/race_record.rs",
        valid "Q below that of half the dynamic rating; without lubricant factor (0.1 to 50). Blows that dent count by \
            largest_indentation";
    pub(crate) BY_POINT: law "S/(z 10⁶ Q_c³), S = Σ Q³ over the balls that pass a point; of the outer ring from the frame's x axis on, of the inner one from its angle 0 \
          at the release. life_share_with_lubricant, else life_share, is the mean of their powers 10/9 to the \
          power 9/10, of both rings",
        source "book/src/theory/heat.md; crates/physics/src/life.rs",
        valid "as life_share; of repeated runs the mean of the members. Drops of one bearing add up point by point (auxbear service)";
    DROPS: law "(ln(1/S)/ln(1/0.9))^(9/10)/D of one bearing that 1, 10, 50 % do not outlive; D is life_share_with_lubricant where it is known, else \
          life_share. A drop until standstill counts with its coast-down, added at the points of both rings",
        source "Weibull, slope 10/9; book/src/theory/heat.md",
        valid "rolling fatigue alone; of a coast-down its intervals count as they find the balls; an order, never a promise: single bearings scatter 50 to 1";
    LUBRICATED: law "life_share over a_ISO(κ, e_C C_u/P) and over the cube of the temperature factor of the hotter race; P the cubic mean load, of bearings in space the load of the same life, κ of the \
          warmest lubricant at the mean speed, C_u = C0/22",
        source "ISO 281:2007 (from memory), crates/physics/src/life.rs; book/src/theory/heat.md",
        valid "one phase, what was computed ball by ball, P without preload; below κ = 0.1 no factor holds, and 0.1 is taken; heat.contamination decides within a \
            factor of ten";
}
