//! Mounts under prescribed motions: force, heat, stored energy and work; dynamic stiffness; tables of the squeeze film.

use super::given::GivenMount;
use crate::compare::{Refusal, Worst, part};
use crate::json::{array, list, number, pair};
use crate::report::{Row, Tolerance};
use model::mount::squeeze_film::Film;
use model::mount::{Mount, MountParts, SqueezeFilm, WholeMount};
use number::Vec2;
use serde_json::Value;
use std::path::Path;

/// Longest step, s: kinks of ring and stop cost its square.
const STEP: f64 = 5e-7;

pub(super) fn rows(file: &Value, _: &Path) -> Result<Vec<Row>, Refusal> {
    let mut worst = Worst::default();
    for (at, series) in list(file, "results")?.iter().enumerate() {
        worst.row(&format!("series {}", at + 1), series, |worst| {
            of_series(file, series, worst)
        })?;
    }
    dynamic_stiffness(file, &mut worst)?;
    squeeze_film(file, &mut worst)?;
    Ok(worst.into_rows())
}

/// A mount of the file under its number type.
fn mount(file: &Value, kind: &str) -> Result<(Mount<f64>, MountParts), String> {
    let given: GivenMount =
        part(&file["kinds"][kind]).map_err(|error| format!("kinds.{kind}: {error}"))?;
    let spring = Mount {
        stiffness: given.ks,
        damping: given.cs,
        free_position: Vec2::zero(),
    };
    Ok((spring, given.parts()?))
}

/// A sum of turning vectors.
struct Motion(Vec<[f64; 3]>);

impl Motion {
    fn of(file: &Value, name: &str) -> Result<Self, String> {
        let terms = list(&file["motions"], name)?.iter();
        let term = |term: &Value| Ok([number(term, "A")?, number(term, "w")?, number(term, "p")?]);
        Ok(Motion(terms.map(term).collect::<Result<_, String>>()?))
    }
    /// Displacement and velocity at a time.
    fn at(&self, time: f64) -> (Vec2<f64>, Vec2<f64>) {
        let (mut s, mut v) = (Vec2::zero(), Vec2::zero());
        for [size, rate, phase] in &self.0 {
            let (sine, cosine) = (rate * time + phase).sin_cos();
            let turning = Vec2::new(cosine, sine) * *size;
            s += turning;
            v += turning.turned() * *rate;
        }
        (s, v)
    }
}

/// States of a mount, then its heat and the work done on it.
type Path6 = [f64; 8];
/// Rates of these, and the force on the race.
type Rates<'a> = dyn Fn(f64, &Path6) -> (Path6, Vec2<f64>) + 'a;
/// Force, ours and theirs; energies by name, ours and theirs.
type Compared = (Vec2<f64>, Vec2<f64>, [(&'static str, f64, f64); 3]);

fn of_series(file: &Value, series: &Value, worst: &mut Worst) -> Result<(), String> {
    let text = |key: &str| series[key].as_str().ok_or(format!("{key} is no text"));
    let (kind, motion) = (text("kind")?, Motion::of(file, text("motion")?)?);
    let (spring, parts) = mount(file, kind)?;
    if parts.housing.is_some() {
        return Err("a housing under a prescribed motion".to_string());
    }
    let mount = WholeMount::<f64>::gather(&|_| (&spring, &parts));
    let rates = |time: f64, y: &Path6| -> (Path6, Vec2<f64>) {
        let mut rate = [0.0; 8];
        let (s, v) = motion.at(time);
        let reaction = mount.react((s, v), &y[..6], &mut rate[..6]);
        rate[6] = reaction.heat();
        rate[7] = -v.dot(reaction.force);
        (rate, reaction.force)
    };
    let (start, _) = motion.at(0.0);
    let mut y = [start.x, start.y, start.x, start.y, 0.0, 0.0, 0.0, 0.0];
    let mut time = 0.0;
    let mut found: Vec<Compared> = Vec::new();
    for row in list(series, "rows")? {
        if worst.lacks(&format!("row of {kind}"), row) {
            continue;
        }
        let until = number(row, "t")?;
        let steps = ((until - time) / STEP).ceil().max(0.0);
        let step = (until - time) / steps.max(1.0);
        for _ in 0..steps as usize {
            y = advance(&rates, time, &y, step);
            time += step;
        }
        time = until;
        let force = rates(time, &y).1;
        let stored = mount.energy(motion.at(time).0, &y[..6])[0];
        let [x, y_] = array(row, "F")?;
        let energies = [
            ("heat", y[6], number(row, "heat")?),
            ("stored energy", stored, number(row, "stored")?),
            ("work on the mount", y[7], number(row, "work_on_mount")?),
        ];
        found.push((force, Vec2::new(x, y_), energies));
    }
    let most = |of: &dyn Fn(&Compared) -> f64| {
        found
            .iter()
            .map(of)
            .fold(0.0_f64, |most, x| most.max(x.abs()))
    };
    let force = 1e-6 * most(&|row| row.1.length_squared().sqrt());
    let energy = 1e-6 * (most(&|row| row.2[0].2) + most(&|row| row.2[1].2));
    let why = format!("{kind}: 1e-6 of the largest of its series");
    for (ours, theirs, energies) in &found {
        let mut forces = worst.under(Tolerance::Absolute(force), why.as_str());
        forces.add("force", "N", [theirs.x, ours.x]);
        forces.add("force", "N", [theirs.y, ours.y]);
        for (name, ours, theirs) in energies {
            let mut own = worst.under(Tolerance::Absolute(energy), why.as_str());
            own.add(name, "J", [*theirs, *ours]);
        }
    }
    Ok(())
}

/// One classical Runge-Kutta step.
fn advance(rates: &Rates, time: f64, y: &Path6, step: f64) -> Path6 {
    let moved =
        |by: &Path6, share: f64| -> Path6 { std::array::from_fn(|k| y[k] + share * step * by[k]) };
    let first = rates(time, y).0;
    let second = rates(time + 0.5 * step, &moved(&first, 0.5)).0;
    let third = rates(time + 0.5 * step, &moved(&second, 0.5)).0;
    let fourth = rates(time + step, &moved(&third, 1.0)).0;
    std::array::from_fn(|k| {
        y[k] + step / 6.0 * (first[k] + 2.0 * (second[k] + third[k]) + fourth[k])
    })
}

fn dynamic_stiffness(file: &Value, worst: &mut Worst) -> Result<(), String> {
    let table = &file["maxwell_dynamic_stiffness"];
    let text = table["text"].as_str().unwrap_or_default();
    let kind = text.rsplit("kind ").next().unwrap_or_default().trim();
    let (spring, parts) = mount(file, kind)?;
    for row in list(table, "rows")? {
        let frequency = number(row, "w")?;
        let ours = parts.linear(&spring, frequency);
        let [real, imaginary] = array(row, "K")?;
        let mut all = worst.under(Tolerance::Relative(1e-12), "1e-12, closed form");
        let name = |part| format!("dynamic stiffness, {part} part");
        all.add(&name("real"), "N/m", [real, ours.storage]);
        all.add(&name("imaginary"), "N/m", [imaginary, ours.loss]);
    }
    Ok(())
}

fn squeeze_film(file: &Value, worst: &mut Worst) -> Result<(), String> {
    let films = [("2pi", false, 1e-9), ("pi", true, 1e-7)];
    for row in list(&file["squeeze_film"], "rows")? {
        let eccentricity = number(row, "eps")?;
        for (key, cavitates, share) in films {
            let constants = SqueezeFilm {
                factor: 1.0,
                clearance: 1.0,
                cavitates,
            };
            let film = Film::<f64>::gather(&|_| &constants);
            let motions = [
                ("centred_whirl", Vec2::new(0.0, eccentricity)),
                ("outward", Vec2::new(1.0, 0.0)),
                ("sideways", Vec2::new(0.0, 1.0)),
            ];
            for (motion, velocity) in motions {
                let ours = film.force(Vec2::new(eccentricity, 0.0), velocity);
                let theirs = pair(&row[key][motion])?;
                let name = format!("squeeze film {key}, {motion}");
                for both in [[theirs.x, ours.x], [theirs.y, ours.y]] {
                    let allowed = Tolerance::Absolute((share * both[0].abs()).max(1e-12));
                    let why = "1e-9 (flooded) and 1e-7 (cavitated), zeros to 1e-12";
                    worst.under(allowed, why).add(&name, "", both);
                }
            }
        }
    }
    Ok(())
}
