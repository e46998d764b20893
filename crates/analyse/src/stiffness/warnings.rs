//! What to know before the stiffness of a bearing is used.

use super::answer::Ball;
use super::request::Request;
use model::spatial::PreloadSpring;
use model::spatial::record::OPEN;
use outcome::Warning;
use physics::groove::reaches_shoulder;

problem::warnings! {
    /// Of equilibria of balls between toroidal grooves.
    pub enum StiffnessWarning {
        Shoulder { angle: "rad", height: "m" } "AB2401" Invalid
            ("The contact ellipse reaches the shoulder of the inner ring: contact angle up to {:.1} deg, shoulder {:.2} mm above the groove's bottom. Pressure at the edge is unknown.", angle.to_degrees(), 1e3 * height);
        UnloadedBalls { unloaded: "1", balls: "1" } "AB2402" Uncertain
            ("{unloaded} of {balls} balls carry nothing: stiffness changes where one more is loaded or unloaded.");
        UnloadedRow { row: "1" } "AB2403" Invalid
            ("Row {row} is unloaded: no ball of it touches the inner ring. A larger preload keeps it loaded.");
        LostInner { balls: "1" } "AB2404" Uncertain
            ("{balls} balls are held by the outer race alone: centrifugal force has lifted them from the inner race.");
        OpenSide { row: "1", angle: "rad" } "AB2409" Invalid
            ("Row {row} carries on its open side, {:.1} deg beyond the bottom of its groove: an angular contact row has no shoulder there, its rings come apart, and this stiffness is that of a bearing that does not exist. Turn the load or the arrangement round.", angle.to_degrees());
        SpringFree { followed: "m" } "AB2407" Uncertain
            ("The preload spring is free: it has followed the rows by {:.1} um. The rows on it carry nothing.", 1e6 * followed);
        SpringSolid { travel: "m" } "AB2408" Uncertain
            ("The preload spring is solid: the load has compressed it by {:.0} um, and the stiffness is that of a stop of 2e8 N/m behind it.", 1e6 * travel);
        BeyondRange { what: words } "AB2405" Uncertain
            ("Beyond the range of the contact law: {what}.");
        Pressure { pressure: "Pa" } "AB2406" Destroys
            ("Hertz pressure of {:.0} MPa: 4200 MPa dent the races (ISO 76).", 1e-6 * pressure);
    }
}

/// What to know of a preload spring by its compression, m, and its force, N.
pub(super) fn of_spring(
    spring: &PreloadSpring<f64>,
    compression: f64,
    force: f64,
) -> Option<Warning> {
    let (followed, travel) = (-compression, spring.travel);
    match (force <= 0.0, compression > travel) {
        (true, _) => Some(StiffnessWarning::SpringFree { followed }.into()),
        (_, true) => Some(StiffnessWarning::SpringSolid { travel }.into()),
        _ => None,
    }
}

/// Static limit of ISO 76 for ball bearings, Pa.
const STATIC_PRESSURE: f64 = 4.2e9;
/// Contact angle up to which the constant of the contact holds to 1 %, rad.
const LARGEST_ANGLE: f64 = std::f64::consts::FRAC_PI_4;

/// Rows of balls.
pub(super) struct Rows<'a>(pub &'a [Vec<Ball>]);

impl Rows<'_> {
    fn all(&self) -> impl Iterator<Item = &Ball> {
        self.0.iter().flatten()
    }
}

pub(super) fn of(asked: &Request, rows: &Rows<'_>) -> Vec<Warning> {
    let mut list: Vec<Warning> = Vec::new();
    let loaded = || rows.all().filter(|ball| ball.loads[0] > 0.0);
    let largest = |value: fn(&Ball) -> f64| loaded().map(value).fold(0.0, f64::max);
    let pressure = largest(|ball| ball.pressures[0].max(ball.pressures[1]));
    if pressure > STATIC_PRESSURE {
        list.push(StiffnessWarning::Pressure { pressure }.into());
    }
    let radius = 0.5 * asked.ball_diameter;
    let groove = asked.curvatures[0] * asked.ball_diameter;
    if let Some(height) = asked.shoulder {
        let reaching = loaded().filter(|ball| {
            reaches_shoulder(ball.angles[0], ball.half_axes[0] / radius, height / groove)
        });
        let angle = reaching.map(|ball| ball.angles[0].abs()).reduce(f64::max);
        list.extend(angle.map(|angle| StiffnessWarning::Shoulder { angle, height }.into()));
    }
    let signs = asked.arrangement.signs();
    for (row, (balls, sign)) in rows.0.iter().zip(signs).enumerate() {
        let wrong = balls.iter().filter(|ball| ball.loads[0] > 0.0);
        let angles = wrong.map(|ball| -ball.angles[0] * sign);
        let angle = angles.fold(0.0, f64::max);
        if angle > OPEN && !asked.opposite {
            let row = row as f64 + 1.0;
            list.push(StiffnessWarning::OpenSide { row, angle }.into());
        }
    }
    let mut closed_rows = 0;
    for (index, balls) in rows.0.iter().enumerate() {
        if balls.iter().all(|ball| ball.loads[0] == 0.0) {
            let row = index as f64 + 1.0;
            list.push(StiffnessWarning::UnloadedRow { row }.into());
        } else {
            closed_rows += balls.len();
        }
    }
    let lost = rows
        .all()
        .filter(|ball| ball.loads[0] == 0.0 && ball.loads[1] > 0.0)
        .count();
    if lost > 0 {
        let balls = lost as f64;
        list.push(StiffnessWarning::LostInner { balls }.into());
    }
    let touching = loaded().count();
    if touching < closed_rows && lost == 0 {
        let (unloaded, balls) = ((closed_rows - touching) as f64, closed_rows as f64);
        list.push(StiffnessWarning::UnloadedBalls { unloaded, balls }.into());
    }
    let mut beyond = Vec::new();
    let angle = largest(|ball| ball.angles[0].abs().max(ball.angles[1].abs()));
    if angle > LARGEST_ANGLE {
        beyond.push(format!(
            "contact angles up to {:.1} deg (45 deg for 1 %)",
            angle.to_degrees()
        ));
    }
    if asked.curvatures.iter().any(|f| !(0.505..=0.58).contains(f)) {
        let [inner, outer] = asked.curvatures;
        beyond.push(format!(
            "groove curvatures {inner} and {outer} (0.505 to 0.58)"
        ));
    }
    let ratio = asked.ball_diameter / asked.pitch_diameter;
    if !(0.08..=0.35).contains(&ratio) {
        beyond.push(format!(
            "ball over pitch diameter {ratio:.3} (0.08 to 0.35)"
        ));
    }
    if !beyond.is_empty() {
        let what = beyond.join("; ");
        list.push(StiffnessWarning::BeyondRange { what }.into());
    }
    list
}
