//! Needed friction of dry backward whirl (`machine_whirl.json`): receptances, bands, minima, where whirl settles.

use super::given::{Coordinates, index, on_springs};
use crate::compare::{Refusal, Worst, told};
use crate::json::{array, list, number};
use crate::levitated::machine::rotor_beside;
use crate::report::{Row, Tolerance};
use physics::dry_whirl::{WhirlContact, needed_friction};
use rotor::{Analysis, C64, Responder, WhirlCurve, WhirlRange};
use serde_json::Value;
use std::ops::RangeInclusive;
use std::path::Path;

/// Frequencies of the bands, rad/s.
const GRID: RangeInclusive<u32> = 50..=7999;
/// Why a tolerance is what it is.
const WHY: &str = "as the file states";

pub(super) fn rows(file: &Value, path: &Path) -> Result<Vec<Row>, Refusal> {
    let mut worst = Worst::default();
    let whirl = Whirl::of(file, path)?;
    for sample in list(file, "samples")? {
        whirl.sample(sample, &mut worst)?;
    }
    whirl.bands(file, &mut worst)?;
    jeffcott(&file["jeffcott"], &mut worst)?;
    Ok(worst.into_rows())
}

struct Whirl {
    responder: Responder,
    coordinate: usize,
    speed: f64,
    race: [f64; 3],
    contact: WhirlContact,
}

impl Whirl {
    fn of(file: &Value, path: &Path) -> Result<Self, Refusal> {
        let mut rotor = rotor_beside("ross_amb_rotor_freefree.json", path)?;
        for element in &mut rotor.elements {
            (element.damping_of_mass, element.damping_of_stiffness) = (2.5, 1e-6);
        }
        let rotor = on_springs(rotor, file)?;
        let all = Coordinates::full(rotor)?;
        let node = index(file, "contact_node")?;
        let race = ["m", "k", "c"].map(|key| number(&file["race"], key));
        let [mass, stiffness, damping] = race;
        Ok(Whirl {
            coordinate: all.rotor.displacement(node),
            responder: Responder::within(&Analysis::new(&all.rotor, &all.matrices, all.basis)),
            speed: number(file, "Om")?,
            race: [mass?, stiffness?, damping?],
            contact: WhirlContact {
                clearance: number(file, "c0")?,
                stiffness: number(file, "k_c")?,
                exponent: 1.0,
            },
        })
    }

    fn parts(&self, frequency: f64) -> Result<[C64; 2], String> {
        let s = C64::new(0.0, -frequency);
        let rotor = self.responder.receptance(self.coordinate, self.speed, s);
        let [mass, stiffness, damping] = self.race;
        let race = C64::new(
            stiffness - mass * frequency * frequency,
            -frequency * damping,
        );
        Ok([rotor.map_err(told)?, race.inv()])
    }

    fn sample(&self, sample: &Value, worst: &mut Worst) -> Result<(), String> {
        let ours = self.parts(number(sample, "omega")?)?;
        for (key, ours) in ["alpha_rotor", "alpha_race"].into_iter().zip(ours) {
            let [re, im] = array(sample, key)?;
            let allowed = Tolerance::Absolute(1e-6 * re.hypot(im));
            let mut parts = worst.under(allowed, WHY);
            parts.add(key, "m/N", [re, ours.re]);
            parts.add(key, "m/N", [im, ours.im]);
        }
        let sum = ours[0] + ours[1];
        let force = self.contact.normal_force(sum.re, sum.im);
        let friction = needed_friction(sum.re, sum.im).filter(|_| force.is_some());
        for (key, ours, share) in [("mu_needed", friction, 1e-5), ("N", force, 1e-4)] {
            let theirs = sample[key].as_f64();
            if theirs.is_some() || ours.is_some() {
                let both = [theirs, ours].map(|own| own.unwrap_or(f64::NAN));
                add(worst, key, both, share);
            }
        }
        Ok(())
    }

    fn bands(&self, file: &Value, worst: &mut Worst) -> Result<(), String> {
        let alpha = |frequency: f64| Some(self.parts(frequency).ok()?.into_iter().sum());
        let sampled = GRID.map(|own| Some((f64::from(own), alpha(f64::from(own))?)));
        let sampled: Option<Vec<(f64, C64)>> = sampled.collect();
        let curve = WhirlCurve::new(self.contact, sampled.ok_or("no receptance")?, &alpha);
        let (bands, found, points) = (list(file, "bands")?, curve.bands(), curve.points());
        let count = [bands.len(), found.len()].map(|count| count as f64);
        add(worst, "number of bands", count, 0.0);
        for (band, own) in bands.iter().zip(found) {
            let [from, to] = ["from_rad_s", "to_rad_s"].map(|key| number(band, key));
            let (from, to) = (from?, to?);
            add(
                worst,
                "begin of a band",
                [from, points[own.start].frequency],
                1.0 / from,
            );
            add(
                worst,
                "end of a band",
                [to, points[own.end - 1].frequency],
                1.0 / to,
            );
            let least = curve
                .smallest_in(own, 1e-9)
                .ok_or("a band without minimum")?;
            let inside = [band["minimum_interior"] == true, !least.at_end];
            add(
                worst,
                "minimum inside its band",
                inside.map(|own| f64::from(u8::from(own))),
                0.0,
            );
            let minimum = [number(band, "min_mu")?, least.point.friction];
            add(worst, "smallest friction of a band", minimum, 1e-5);
            let place = [number(band, "at_rad_s")?, least.point.frequency];
            add(worst, "its frequency", place, 1e-3);
            let crossings = band["crossings_of_mu"].as_object();
            for (friction, theirs) in crossings.into_iter().flatten() {
                let ranges = curve.ranges(friction.parse().unwrap_or(f64::NAN));
                let ends = ranges.into_iter().flat_map(|own| [own.from, own.to]);
                let ours: Vec<f64> = ends.filter(|own| (from..=to).contains(own)).collect();
                let theirs = theirs.as_array().into_iter().flatten();
                let theirs: Vec<f64> = theirs.filter_map(Value::as_f64).collect();
                let count = [theirs.len(), ours.len()].map(|count| count as f64);
                add(worst, "number of crossings", count, 0.0);
                for (theirs, ours) in theirs.into_iter().zip(ours) {
                    add(worst, "crossing", [theirs, ours], 1e-5);
                }
            }
        }
        for row in list(&file["full_slip_whirl"], "rows")? {
            let begins = number(row, "must_exceed_rad_s")?;
            let ranges = curve.ranges(number(row, "mu")?).into_iter();
            let far = |own: &WhirlRange| (own.from - begins).abs();
            let own = ranges.min_by(|a, b| far(a).total_cmp(&far(b)));
            let own = own.ok_or("no range of whirl")?;
            let settles = own.settles.ok_or("whirl that settles nowhere")?;
            add(worst, "whirl must exceed", [begins, own.from], 1e-5);
            let frequency = [number(row, "settles_at_rad_s")?, settles.frequency];
            add(worst, "whirl settles at", frequency, 1e-5);
            let force = [number(row, "N_there")?, settles.force];
            add(worst, "contact force where it settles", force, 1e-4);
        }
        Ok(())
    }
}

/// Compares two numbers, theirs and ours, of the units of the file.
fn add(worst: &mut Worst, name: &str, both: [f64; 2], share: f64) {
    (worst.under(Tolerance::Relative(share), WHY)).add(name, "", both);
}

/// A Jeffcott rotor against a held race, by its receptance.
fn jeffcott(given: &Value, worst: &mut Worst) -> Result<(), String> {
    let (zeta, kappa) = (number(given, "zeta")?, number(given, "kappa")?);
    let alpha = |omega: f64| C64::new(1.0 - omega * omega, -2.0 * zeta * omega).inv();
    let needed = |alpha: C64| needed_friction(alpha.re, alpha.im).unwrap_or(f64::NAN);
    let (friction, twice) = (number(given, "mu_star")?, &given["at_mu_2mu_star"]);
    let edge = needed(alpha((1.0 + kappa).sqrt()));
    add(
        worst,
        "threshold of a Jeffcott rotor",
        [friction, edge],
        1e-12,
    );
    let there = alpha(number(twice, "omega_s_over_omega_n")?);
    add(
        worst,
        "its friction at ω_s",
        [2.0 * friction, needed(there)],
        1e-12,
    );
    let contact = WhirlContact {
        clearance: 1.0,
        stiffness: kappa,
        exponent: 1.0,
    };
    let force = contact.normal_force(there.re, there.im).unwrap_or(f64::NAN);
    let orbit = [number(twice, "A_s_over_c0")?, 1.0 + force / kappa];
    add(worst, "its orbit at ω_s", orbit, 1e-12);
    Ok(())
}
