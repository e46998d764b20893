//! Sliding friction between rotor and race, from the spin-up of a drop.
//!
//! ```text
//!   (18), (10), (14)   R_0 μ W = I_I Ω̇ + t_I = (I_I + J_I) Ω̇ + M + share F       along the slip u = (R_0 - c0) ω - R_0 Ω
//! ```
//! Only while rotor and race touch (W above a least load) and slide (|u| above a least slip). Points share the errors of I_I, J_I,
//! R_0, M and F; means over slip keep those and average what is left. The rotor is thinner than the bore by its air clearance c0:
//! at 12 000 rpm 0.25 mm of it is a third of a metre a second.
//!
//! The unbalance of a rotor swings W with every turn, and a W that is taken as constant leaves that swing in μ: single points swing.
//! Means therefore take whole turns of the rotor. Turns of nearly the same slip are joined; the label of a mean is the mean slip of
//! its points, with their spread. What whole turns leave of a swing that changes from turn to turn, a radian of its phase, is in the
//! band; where no turn is whole, all of the swing is.
//!
//! **Does not model**: slip of the balls (J_I is that of rolling balls); whirl (u is that of a centred rotor: the orbit's own
//! speed at the contact is left out); a load W that does not press at one place; friction that rests; μ that bends within the slips
//! of one turn (at creep a turn holds slips from half its mean to one and a half).
//!
//! Measured (`tests/rotor.rs`, 400 seeds, band of two deviations): the true μ lies in its band at 94.0 % of all times, its means
//! over slip at 94.1 %.

use crate::measurement::SetDeviation;
use measure::speed::Speed;
use physics::rolling::RollingSet;
use problem::{note, note::Note};
use statistics::uncertain::Uncertain;
use std::f64::consts::TAU;

mod turns;

pub use turns::FrictionPoint;
use turns::Window;

/// The spin-up of a race by a rotor that rubs along it. All lists have the same length; all values are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct RubbingSpinUp {
    /// Name for messages.
    pub name: String,
    /// Times, s; rising.
    pub time: Vec<f64>,
    /// Speed Ω of the race with its deviation, rad/s.
    pub race_speed: Vec<Uncertain>,
    /// Acceleration Ω̇ of the race with its deviation, rad/s².
    pub race_acceleration: Vec<Uncertain>,
    /// Speed ω of the rotor with its deviation, rad/s.
    pub rotor_speed: Vec<Uncertain>,
    /// Force W between rotor and race with its deviation, N; 0 where they do not touch.
    pub load: Vec<Uncertain>,
    /// Time after which two errors of acceleration and load count as independent, s.
    pub correlation_time: f64,
}

/// Number of times at which a measured spin-up is looked at.
const TIMES: usize = 2000;

impl RubbingSpinUp {
    /// A spin-up from the motion of the race alone, by a rotor whose spin is held and whose force is constant.
    ///
    /// - `name`: name for messages
    /// - `speed`: the motion of the race
    /// - `within`: times between which the rotor lies on the race, s; those of the record count where they are narrower
    /// - `rotor_speed`: spin ω of the rotor, rad/s
    /// - `load`: force W, N
    ///
    /// Errors of a constant force are common to all times, so the correlation time is the whole.
    ///
    /// Refused: no time of the record within.
    pub fn measured(
        name: &str,
        speed: &Speed,
        within: (f64, f64),
        rotor_speed: Uncertain,
        load: Uncertain,
    ) -> Result<RubbingSpinUp, String> {
        let (first, last) = speed.range();
        let (from, to) = (first.max(within.0), last.min(within.1));
        if from >= to || !(to - from).is_finite() {
            return Err(format!(
                "{name}: the speed of the race is known from {first:.4} to {last:.4} s, the rotor lies on it from {:.4} to {:.4} s",
                within.0, within.1
            ));
        }
        let motions: Vec<_> = (0..TIMES)
            .map(|k| from + (to - from) * k as f64 / (TIMES - 1) as f64)
            .map(|time| speed.at(time))
            .collect();
        Ok(RubbingSpinUp {
            name: name.to_string(),
            time: motions.iter().map(|m| m.time).collect(),
            race_speed: (motions.iter())
                .map(|m| Uncertain::new(m.speed, m.speed_uncertainty()))
                .collect(),
            race_acceleration: (motions.iter())
                .map(|m| Uncertain::new(m.acceleration, m.acceleration_uncertainty()))
                .collect(),
            rotor_speed: vec![rotor_speed; motions.len()],
            load: vec![load; motions.len()],
            correlation_time: to - from,
        })
    }
}

/// What is known of race and bearing.
pub struct Race<'a> {
    /// Inertia I_I of the inner race with its sleeve, kg m².
    pub inertia: Uncertain,
    /// Radius R_0 of the bore, m.
    pub bore_radius: Uncertain,
    /// Radial air clearance c0, m: by so much the rotor's radius is less than that of the bore.
    pub air_clearance: Uncertain,
    /// Balls and cage.
    pub set: RollingSet<f64>,
    /// What is not known of them.
    pub set_deviation: SetDeviation,
    /// M at a speed, rad/s, and a load, N; none where it is not known.
    pub steady_moment: &'a dyn Fn(f64, f64) -> Option<Uncertain>,
    /// F at a speed, rad/s, and an acceleration, rad/s²; none where it is not known.
    pub friction: &'a dyn Fn(f64, f64) -> Option<Uncertain>,
    /// Least W that counts as contact, N.
    pub least_load: f64,
    /// Least |u| that counts as sliding, m/s.
    pub least_slip: f64,
}

/// Friction over slip.
#[derive(Clone, Debug, PartialEq)]
pub struct RotorFriction {
    /// Points at which rotor and race slide.
    pub points: Vec<FrictionPoint>,
    /// What is not trustworthy.
    pub notes: Vec<Note>,
    /// Parts of `points`, each of one turn of the rotor.
    windows: Vec<Window>,
    correlation_time: f64,
}

/// Sliding friction between rotor and race over the spin-up of a drop.
///
/// Formula: μ = [(I_I + J_I) Ω̇ + M + share F]/(R_0 W)
///
/// - `run`: what was measured
/// - `race`: race, bearing, moments
///
/// Refused: lists that do not fit, nothing that slides under load.
pub fn rotor_friction(run: &RubbingSpinUp, race: &Race) -> Result<RotorFriction, String> {
    refuse(run, race)?;
    let set = &race.set;
    let share = set.pocket_friction_arm();
    let inertia = race.inertia.value + set.inner_inertia();
    let inertia_deviation = race
        .inertia
        .deviation
        .hypot(race.set_deviation.inner_inertia(set));
    let (mut beyond, mut without) = (0, 0);
    let mut points = Vec::new();
    let turned = turned(run);
    let mut places = Vec::new();
    for k in 0..run.time.len() {
        let (speed, rate, load) = (run.race_speed[k], run.race_acceleration[k], run.load[k]);
        let bore = race.bore_radius;
        let slip = slip(run.rotor_speed[k], speed, bore, race.air_clearance);
        if load.value < race.least_load || slip.value.abs() < race.least_slip {
            continue;
        }
        let Some(moment) = (race.steady_moment)(speed.value, load.value) else {
            beyond += 1;
            continue;
        };
        let friction = (race.friction)(speed.value, rate.value).unwrap_or_else(|| {
            without += 1;
            Uncertain::exact(0.0)
        });
        let drive = inertia * rate.value + moment.value + share * friction.value;
        let press = bore.value * load.value * slip.value.signum();
        let value = drive / press;
        let own = (inertia * rate.deviation / press).hypot(value * load.deviation / load.value);
        let shared = (inertia_deviation * rate.value / press)
            .hypot(moment.deviation / press)
            .hypot(share * friction.deviation / press)
            .hypot(value * bore.deviation / bore.value);
        let (before, after) = (k.saturating_sub(1), (k + 1).min(turned.len() - 1));
        places.push((turned[k], 0.5 * (turned[after] - turned[before])));
        points.push(FrictionPoint {
            time: run.time[k],
            slip,
            friction: Uncertain::new(value, own.hypot(shared)),
            shared_deviation: shared,
        });
    }
    let mut notes = Vec::new();
    if beyond > 0 {
        notes.push(note!(
            "at {} times the steady moment is not known: they are left out",
            beyond
        ));
    }
    if without > 0 {
        notes.push(note!(
            "at {} times the friction of accelerated balls is not known: it is taken as 0, μ is then too small by share F/(R_0 W)",
            without
        ));
    }
    if points.is_empty() {
        return Err(format!(
            "{}: rotor and race never slide under {} N and {} m/s with a known steady moment",
            run.name, race.least_load, race.least_slip
        ));
    }
    let windows = turns::windows(&points, &places);
    notes.extend(turns::note(&windows));
    Ok(RotorFriction {
        points,
        windows,
        notes,
        correlation_time: run.correlation_time,
    })
}

impl RotorFriction {
    /// Means of slip and μ over whole turns of the rotor, from the smallest slip to the largest.
    ///
    /// - `ranges`: number of ranges of |u| into which its largest is divided: turns are joined up to that width, and up to half as
    ///   much again of the smallest slip among them
    ///
    /// The deviation of a mean holds what its points share in full, the rest over the number of independent points (their time over
    /// the correlation time), and what is left of the swing within a turn. That of its slip holds the spread of the slips.
    pub fn over_slip(&self, ranges: usize) -> Vec<FrictionPoint> {
        turns::joined(&self.windows, ranges.max(1))
            .iter()
            .map(|part| turns::mean(part, self.correlation_time))
            .collect()
    }

    /// Mean of slip and μ over all whole turns of the rotor; over all points where no turn is whole.
    pub fn mean(&self) -> FrictionPoint {
        let all: Vec<&Window> = self.windows.iter().collect();
        turns::mean(&all, self.correlation_time)
    }
}

/// Slip of the rotor's surface over that of the race, m/s: u = (R_0 - c0) ω - R_0 Ω.
fn slip(rotor: Uncertain, race: Uncertain, bore: Uncertain, clearance: Uncertain) -> Uncertain {
    let own = bore.value - clearance.value;
    Uncertain::new(
        own * rotor.value - bore.value * race.value,
        (own * rotor.deviation)
            .hypot(bore.value * race.deviation)
            .hypot((rotor.value - race.value) * bore.deviation)
            .hypot(rotor.value * clearance.deviation),
    )
}

/// Turns of the rotor since the first time.
fn turned(run: &RubbingSpinUp) -> Vec<f64> {
    let mut sum = 0.0;
    let mut list = vec![0.0; run.time.len().min(1)];
    for (times, spins) in run.time.windows(2).zip(run.rotor_speed.windows(2)) {
        let mean = 0.5 * (spins[0].value.abs() + spins[1].value.abs());
        sum += mean * (times[1] - times[0]) / TAU;
        list.push(sum);
    }
    list
}

fn refuse(run: &RubbingSpinUp, race: &Race) -> Result<(), String> {
    race.set_deviation.sound()?;
    let count = run.time.len();
    for (what, list) in [
        ("race speeds", &run.race_speed),
        ("race accelerations", &run.race_acceleration),
        ("rotor speeds", &run.rotor_speed),
        ("loads", &run.load),
    ] {
        if list.len() != count {
            return Err(format!(
                "{}: {} {what} for {count} times",
                run.name,
                list.len()
            ));
        }
        if let Some(at) = list.iter().position(|value| !value.is_sound()) {
            return Err(format!(
                "{}: number {at} of the {what} is not finite",
                run.name
            ));
        }
    }
    if run
        .time
        .windows(2)
        .any(|p| !(p[1] > p[0] && p[1].is_finite()))
    {
        return Err(format!("{}: the times do not rise", run.name));
    }
    for (what, value) in [
        ("inertia of the race", race.inertia),
        ("bore radius", race.bore_radius),
    ] {
        if !(value.is_sound() && value.value > 0.0) {
            return Err(format!(
                "the {what} is missing: it must be positive and finite, with a deviation"
            ));
        }
    }
    let clearance = race.air_clearance;
    if !(clearance.is_sound() && (0.0..race.bore_radius.value).contains(&clearance.value)) {
        return Err(
            "the air clearance must be finite, not negative and less than the bore's radius".into(),
        );
    }
    let inner = race.set.inner_inertia();
    if !(inner.is_finite() && inner >= 0.0) {
        return Err("masses and radii of balls and cage must be positive and finite".into());
    }
    if !(race.least_load > 0.0 && race.least_slip > 0.0 && run.correlation_time >= 0.0) {
        return Err(
            "least load and least slip must be positive, the correlation time not negative".into(),
        );
    }
    Ok(())
}
