//! Needed friction of dry backward whirl (`machine_whirl.json`): receptances, bands, minima, where whirl settles.

use super::given::{Coordinates, index, on_springs};
use super::json::{list, number, numbers};
use crate::compare::{Refusal, Worst};
use crate::levitated::machine::rotor_beside;
use crate::report::{Row, Tolerance};
use physics::dry_whirl::{WhirlContact, needed_friction};
use rotor::{Analysis, C64, Responder, WhirlCurve};
use serde_json::Value;
use std::ops::RangeInclusive;
use std::path::Path;

/// Frequencies of the bands, rad/s.
const GRID: RangeInclusive<u32> = 50..=7999;
/// Modes and residual flexibility that the reference allows to a reduced rotor; all coordinates give its digits.
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
        Ok([rotor.map_err(|error| error.to_string())?, race.inv()])
    }

    fn sample(&self, sample: &Value, worst: &mut Worst) -> Result<(), String> {
        let ours = self.parts(number(sample, "omega")?)?;
        for (key, ours) in ["alpha_rotor", "alpha_race"].into_iter().zip(ours) {
            let [re, im] = numbers(sample, key)?;
            let allowed = Tolerance::Absolute(1e-6 * re.hypot(im));
            for (theirs, ours) in [(re, ours.re), (im, ours.im)] {
                worst.add(Row::compared(key, "m/N", theirs, ours, allowed, WHY));
            }
        }
        let sum = ours[0] + ours[1];
        let found = [
            ("mu_needed", "", needed_friction(sum.re, sum.im), 1e-5),
            ("N", "N", self.contact.normal_force(sum.re, sum.im), 1e-4),
        ];
        for (key, unit, ours, share) in found {
            match (sample[key].as_f64(), ours) {
                (None, None) => {}
                (theirs, ours) => {
                    let [theirs, ours] = [theirs, ours].map(|own| own.unwrap_or(f64::NAN));
                    worst.add(Row::compared(
                        key,
                        unit,
                        theirs,
                        ours,
                        Tolerance::Relative(share),
                        WHY,
                    ));
                }
            }
        }
        Ok(())
    }

    fn bands(&self, file: &Value, worst: &mut Worst) -> Result<(), String> {
        let alpha = |frequency: f64| Some(self.parts(frequency).ok()?.into_iter().sum());
        let sampled = GRID.map(|own| Some((f64::from(own), alpha(f64::from(own))?)));
        let sampled: Option<Vec<(f64, C64)>> = sampled.collect();
        let curve = WhirlCurve::new(self.contact, sampled.ok_or("no receptance")?, &alpha);
        let mut add = |name: &str, unit, theirs, ours, allowed| {
            worst.add(Row::compared(name, unit, theirs, ours, allowed, WHY));
        };
        let (bands, points) = (list(file, "bands")?, curve.points());
        let found = curve.bands();
        let count = (bands.len() as f64, found.len() as f64);
        add(
            "number of bands",
            "",
            count.0,
            count.1,
            Tolerance::Absolute(0.0),
        );
        for (band, own) in bands.iter().zip(found) {
            let ends = [("from_rad_s", own.start), ("to_rad_s", own.end - 1)];
            for (key, at) in ends {
                let theirs = number(band, key)?;
                add(
                    "end of a band",
                    "rad/s",
                    theirs,
                    points[at].frequency,
                    Tolerance::Absolute(1.0),
                );
            }
            let least = curve
                .smallest_in(own, 1e-9)
                .ok_or("a band without minimum")?;
            let interior = band["minimum_interior"].as_bool().unwrap_or_default();
            let flags = (
                f64::from(u8::from(interior)),
                f64::from(u8::from(!least.at_end)),
            );
            add(
                "minimum inside its band",
                "",
                flags.0,
                flags.1,
                Tolerance::Absolute(0.0),
            );
            let theirs = number(band, "min_mu")?;
            add(
                "smallest friction of a band",
                "",
                theirs,
                least.point.friction,
                Tolerance::Relative(1e-5),
            );
            let theirs = number(band, "at_rad_s")?;
            add(
                "its frequency",
                "rad/s",
                theirs,
                least.point.frequency,
                Tolerance::Relative(1e-3),
            );
            let crossings = band["crossings_of_mu"]
                .as_object()
                .ok_or("crossings_of_mu is no table")?;
            for (friction, wanted) in crossings {
                let friction: f64 = friction
                    .parse()
                    .map_err(|_| "a friction that is no number")?;
                let [from, to] = ["from_rad_s", "to_rad_s"].map(|key| number(band, key));
                let within = from?..=to?;
                let ends = curve
                    .ranges(friction)
                    .into_iter()
                    .flat_map(|own| [own.from, own.to]);
                let ours: Vec<f64> = ends.filter(|own| within.contains(own)).collect();
                let theirs = wanted.as_array().map(Vec::as_slice).unwrap_or_default();
                let count = (theirs.len() as f64, ours.len() as f64);
                add(
                    "number of crossings",
                    "",
                    count.0,
                    count.1,
                    Tolerance::Absolute(0.0),
                );
                for (theirs, ours) in theirs.iter().filter_map(Value::as_f64).zip(ours) {
                    add("crossing", "rad/s", theirs, ours, Tolerance::Relative(1e-5));
                }
            }
        }
        for row in list(&file["full_slip_whirl"], "rows")? {
            let begins = number(row, "must_exceed_rad_s")?;
            let ranges = curve.ranges(number(row, "mu")?);
            let own = ranges.iter().min_by(|a, b| {
                let far = |own: &rotor::WhirlRange| (own.from - begins).abs();
                far(a).total_cmp(&far(b))
            });
            let own = own.ok_or("no range of whirl")?;
            add(
                "whirl must exceed",
                "rad/s",
                begins,
                own.from,
                Tolerance::Relative(1e-5),
            );
            let [frequency, force] = own
                .settles
                .map_or([f64::NAN; 2], |own| [own.frequency, own.force]);
            let theirs = number(row, "settles_at_rad_s")?;
            add(
                "whirl settles at",
                "rad/s",
                theirs,
                frequency,
                Tolerance::Relative(1e-5),
            );
            let theirs = number(row, "N_there")?;
            add(
                "contact force there",
                "N",
                theirs,
                force,
                Tolerance::Relative(1e-4),
            );
        }
        Ok(())
    }
}

/// A Jeffcott rotor against a held race, by the curve of its receptance.
fn jeffcott(given: &Value, worst: &mut Worst) -> Result<(), String> {
    let [zeta, kappa] = ["zeta", "kappa"].map(|key| number(given, key));
    let (zeta, kappa) = (zeta?, kappa?);
    let alpha = |omega: f64| C64::new(1.0 - omega * omega, -2.0 * zeta * omega).inv();
    let contact = WhirlContact {
        clearance: 1.0,
        stiffness: kappa,
        exponent: 1.0,
    };
    let edge = alpha((1.0 + kappa).sqrt());
    let threshold = needed_friction(edge.re, edge.im).unwrap_or(f64::NAN);
    let friction = number(given, "mu_star")?;
    let mut add = |name: &str, theirs, ours| {
        let allowed = Tolerance::Relative(1e-12);
        worst.add(Row::compared(name, "", theirs, ours, allowed, WHY));
    };
    add("threshold of a Jeffcott rotor", friction, threshold);
    let twice = &given["at_mu_2mu_star"];
    let settled = number(twice, "omega_s_over_omega_n")?;
    let there = alpha(settled);
    let needed = needed_friction(there.re, there.im).unwrap_or(f64::NAN);
    add("its friction at ω_s", 2.0 * friction, needed);
    let force = contact.normal_force(there.re, there.im).unwrap_or(f64::NAN);
    let orbit = number(twice, "A_s_over_c0")?;
    add("its orbit at ω_s", orbit, 1.0 + force / kappa);
    Ok(())
}
