//! Files of an independent reference implementation, read as they are.
//!
//! They name no format; their keys distinguish them: contacts (`hertz.json`), rolling moments (`rolling.json`), whole
//! states with their derivative (`derivative_points*.json`), drops (`drop_*.json`), rotors element by element. Laws are
//! compared here, rotors in `rotors.rs`; states and drops go to the [`Simulator`] and are compared in `points.rs` and `drops.rs`.
//! A file with hundreds of numbers becomes one row per quantity: the one that deviates most.

use super::compare::{Refusal, Worst, never, part, rows_of, told};
use super::report::{Row, Tolerance};
use super::simulator::Simulator;
use super::{drops, points, rotors};
use physics::hertz::{BallRace, EllipseFactors, PointContact, Race, maximum_pressure};
use physics::materials::{BEARING_STEEL, Material, contact_modulus};
use physics::palmgren::Palmgren;
use physics::rolling::{RollingSet, spin_up_time};
use serde::Deserialize;
use serde_json::{Map, Value};

pub use super::simulator::{DerivativePoint, DropReference};

/// Rows of a reference file; `None` when the keys are those of no known file.
pub fn rows(value: &Value, simulator: &dyn Simulator) -> Option<Vec<Row>> {
    let top = value.as_object()?;
    let has = |keys: &[&str]| keys.iter().all(|key| top.contains_key(*key));
    let rows = if has(&["rows", "spinup", "params"]) {
        rolling(value).map_err(Refusal::from)
    } else if has(&["rows", "tol_rel"]) && first_row_has(top, "stars") {
        hertz(value).map_err(Refusal::from)
    } else if has(&["points", "per_ball_cols", "quadratures"]) {
        points::rows(value, simulator).map_err(Refusal::from)
    } else if has(&["model", "eigenvalues"]) {
        rotors::rows(value)
    } else if has(&["input", "M", "K", "G"]) {
        rotors::element(value)
    } else if has(&["params", "y0", "mean", "sd"]) {
        drops::rows(value, simulator).map_err(Refusal::from)
    } else {
        return None;
    };
    Some(rows_of(rows))
}

fn first_row_has(top: &Map<String, Value>, key: &str) -> bool {
    top["rows"]
        .as_array()
        .and_then(|rows| rows.first())
        .is_some_and(|row| row.get(key).is_some())
}

#[derive(Deserialize)]
struct HertzFile {
    rows: Vec<Value>,
    tol_rel: f64,
}

#[derive(Deserialize)]
struct HertzRow {
    #[serde(rename = "D")]
    ball_diameter: f64,
    #[serde(rename = "d_m")]
    pitch_diameter: f64,
    #[serde(rename = "f")]
    groove_curvature: f64,
    inner: bool,
    #[serde(rename = "E")]
    young_modulus: f64,
    #[serde(rename = "nu")]
    poisson_ratio: f64,
    sum_rho: f64,
    #[serde(rename = "F_rho")]
    difference: f64,
    /// a*, b*, δ*, κ.
    stars: [f64; 4],
    #[serde(rename = "K")]
    stiffness: f64,
    #[serde(rename = "K_hamrock_brewe")]
    fast_stiffness: Option<f64>,
    /// a, b, δ, p_max.
    #[serde(rename = "contact_100N")]
    at_100_newton: [f64; 4],
}

fn hertz(value: &Value) -> Result<Vec<Row>, String> {
    let file: HertzFile = part(value)?;
    let mut worst = Worst::default();
    for (at, row) in file.rows.iter().enumerate() {
        worst.row(&format!("row {}", at + 1), row, |worst| {
            hertz_row(&part(row)?, file.tol_rel, worst)
        })?;
    }
    Ok(worst.into_rows())
}

fn hertz_row(row: &HertzRow, tolerance: f64, worst: &mut Worst) -> Result<(), String> {
    let geometry = BallRace {
        ball_diameter: row.ball_diameter,
        pitch_diameter: row.pitch_diameter,
        groove_curvature: row.groove_curvature,
        contact_angle: 0.0,
        race: if row.inner { Race::Inner } else { Race::Outer },
    };
    let material = Material {
        young_modulus: row.young_modulus,
        poisson_ratio: row.poisson_ratio,
        ..BEARING_STEEL
    };
    let curvature = geometry.curvature();
    let modulus = contact_modulus(material, material);
    let contact = PointContact::new(curvature, modulus).map_err(told)?;
    let fast = PointContact::hamrock_brewe(curvature, modulus).map_err(told)?;
    let factors = EllipseFactors::exact(curvature.difference().abs())
        .ok_or("a curvature difference outside 0 to 1")?;
    let which = format!(
        "{} race, f {}, D {} mm; exact integrals on both sides",
        if row.inner { "inner" } else { "outer" },
        row.groove_curvature,
        row.ball_diameter * 1e3
    );
    let mut all = worst.under(Tolerance::Relative(tolerance), which);
    let difference = curvature.difference();
    all.add("curvature_sum", "1/m", [row.sum_rho, curvature.sum()]);
    all.add("curvature_difference", "", [row.difference, difference]);
    let [a, b, approach, ellipticity] = row.stars;
    all.add("semi_major_factor", "", [a, factors.semi_major]);
    all.add("semi_minor_factor", "", [b, factors.semi_minor]);
    all.add("approach_factor", "", [approach, factors.approach]);
    all.add("ellipticity", "", [ellipticity, factors.ellipticity]);
    all.add("stiffness", "N/m^1.5", [row.stiffness, contact.stiffness]);
    let load = 100.0;
    let [a, b, approach, pressure] = row.at_100_newton;
    let maximum = maximum_pressure(contact.pressure_factor, load);
    all.add(
        "semi_major_axis_at_100_N",
        "m",
        [a, contact.semi_major(load)],
    );
    all.add(
        "semi_minor_axis_at_100_N",
        "m",
        [b, contact.semi_minor(load)],
    );
    all.add("approach_at_100_N", "m", [approach, contact.approach(load)]);
    all.add("max_pressure_at_100_N", "Pa", [pressure, maximum]);
    if let Some(reference) = row.fast_stiffness {
        let both = [reference, fast.stiffness];
        all.add("stiffness_hamrock_brewe", "N/m^1.5", both);
    }
    Ok(())
}

#[derive(Deserialize)]
struct RollingFile {
    params: RollingParameters,
    rows: Vec<Value>,
    spinup: Vec<Value>,
    tol_rel: f64,
    tol_spinup_rel: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RollingParameters {
    #[serde(rename = "N")]
    ball_count: f64,
    #[serde(rename = "R")]
    inner_track_radius: f64,
    #[serde(rename = "r")]
    ball_radius: f64,
    #[serde(rename = "m_b")]
    ball_mass: f64,
    #[serde(rename = "m_c")]
    cage_mass: f64,
    #[serde(rename = "C0")]
    static_load_rating: f64,
    /// Kinematic viscosity, mm²/s.
    #[serde(rename = "nu")]
    nu_mm2_s: f64,
    #[serde(rename = "f0")]
    viscous_factor: f64,
    #[serde(rename = "z")]
    load_factor: f64,
    #[serde(rename = "y")]
    load_exponent: f64,
    #[serde(rename = "I_i")]
    race_inertia: f64,
    #[serde(rename = "R0")]
    bore_radius: f64,
}

#[derive(Deserialize)]
struct RollingRow {
    #[serde(rename = "W")]
    load: f64,
    #[serde(rename = "Om")]
    speed: f64,
    #[serde(rename = "dOm")]
    acceleration: f64,
    #[serde(rename = "F")]
    pocket_friction: f64,
    #[serde(rename = "M0")]
    viscous: f64,
    #[serde(rename = "M1")]
    by_load: f64,
    #[serde(rename = "T_I")]
    inner_traction: f64,
    #[serde(rename = "T_O")]
    outer_traction: f64,
    #[serde(rename = "t_I")]
    inner_moment: f64,
    #[serde(rename = "t_O")]
    outer_moment: f64,
}

#[derive(Deserialize)]
struct SpinUp {
    #[serde(rename = "W")]
    load: f64,
    #[serde(rename = "mu")]
    friction_coefficient: f64,
    #[serde(rename = "Om_end")]
    end_speed: f64,
    /// Pocket friction over acceleration, N s²/rad.
    q: f64,
    /// Time to the end speed, s; null where it is never reached.
    t: Option<f64>,
}

fn rolling(value: &Value) -> Result<Vec<Row>, String> {
    let file: RollingFile = part(value)?;
    let p = &file.params;
    let set = RollingSet {
        inner_track_radius: p.inner_track_radius,
        ball_ratio: p.ball_radius / p.inner_track_radius,
        balls_mass: p.ball_count * p.ball_mass,
        cage_mass: p.cage_mass,
    };
    let palmgren = Palmgren {
        viscous_factor: p.viscous_factor,
        viscosity: p.nu_mm2_s * 1e-6,
        pitch_diameter: 2.0 * (p.inner_track_radius + p.ball_radius),
        load_factor: p.load_factor,
        load_exponent: p.load_exponent,
        static_load_rating: p.static_load_rating,
        preload: 0.0,
    };
    let mut worst = Worst::default();
    for (at, given) in file.rows.iter().enumerate() {
        worst.row(&format!("row {}", at + 1), given, |worst| {
            let row: RollingRow = part(given)?;
        let motion = set.rolling(row.acceleration);
        let inner = set.inner_traction(motion, row.pocket_friction);
        let outer = set.outer_traction(motion, row.pocket_friction);
        let steady = palmgren.printed_moment(row.speed, row.load);
        let by_load = palmgren.load_moment(row.load);
        let which = format!(
            "W {} N, speed {} rad/s, acceleration {} rad/s², F {} N; (16) as printed on both sides",
            row.load, row.speed, row.acceleration, row.pocket_friction
        );
            let viscous = palmgren.printed_moment(row.speed, 0.0);
            let moments = [set.inner_moment(steady, inner), set.outer_moment(steady, outer)];
            let mut all = worst.under(Tolerance::Relative(file.tol_rel), which);
            all.add("viscous_moment", "N m", [row.viscous, viscous]);
            all.add("load_moment", "N m", [row.by_load, by_load]);
            all.add("inner_traction", "N", [row.inner_traction, inner]);
            all.add("outer_traction", "N", [row.outer_traction, outer]);
            all.add("inner_moment", "N m", [row.inner_moment, moments[0]]);
            all.add("outer_moment", "N m", [row.outer_moment, moments[1]]);
            Ok(())
        })?;
    }
    for (at, given) in file.spinup.iter().enumerate() {
        worst.row(&format!("spinup {}", at + 1), given, |worst| {
            let case: SpinUp = part(given)?;
            let quantity = format!(
                "spin_up_time W {} N, mu {}, q {}",
                case.load, case.friction_coefficient, case.q
            );
            let inertia = p.race_inertia + set.inner_inertia() + set.pocket_friction_arm() * case.q;
            let drive = p.bore_radius * case.friction_coefficient * case.load;
            // (16) as printed steps where ν Ω = 209 mm²/s·rad/s.
            let knots = [0.0, 209.0 / p.nu_mm2_s, case.end_speed];
            let moment = |speed: f64| palmgren.printed_moment(speed, case.load);
            let ours = spin_up_time(inertia, drive, moment, &knots);
            worst.add(match (case.t, ours) {
                (Some(reference), Some(ours)) => Row::compared(
                    quantity,
                    "s",
                    reference,
                    ours,
                    Tolerance::Relative(file.tol_spinup_rel),
                    "quadrature of (19)",
                ),
                (reference, ours) => never(quantity, "s", reference, ours),
            });
            Ok(())
        })?;
    }
    Ok(worst.into_rows())
}
