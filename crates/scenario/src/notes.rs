//! What a user should know of the values themselves, before anything is computed from them: it becomes warnings of `check`, of
//! the run and of the report.

use crate::bearing::kind::BearingType;
use crate::bearing::lubricant::{LubricantWarning, drawn_on};
use crate::drop::axial_share;
use crate::heat::Network;
use crate::system::COAST_DOWN;
use crate::table;
use crate::values::Values;
use catalogue::designation::{self, Designation, PAIRS};
use physics::viscosity::Viscosity;
use problem::warning::Warning;
use units::display;

problem::warnings! {
    /// Of the values of a file.
    pub enum ValueWarning {
        LeftOut { typed: text, name: text, behind: words } "AB1091" Uncertain ("{typed} is computed as the {name} of the catalogue{behind}.");
        AnotherBearing { differ: words, name: text } "AB1092" Invalid
            ("Given values differ from those of the {name}, and count: {differ} (the catalogue's in brackets). Ratings, limiting speed and whatever is not given are still those of the {name}.");
        Information { key: text, value: text } "AB1093" Note ("{key} = {value} is kept as information: nothing here is computed from it.");
        Implausible { key: text, value: text, usual: words } "AB1094" Invalid ("{key} = {value} is implausible: {usual}.");
        ImplausibleUnbalance { eccentricity: "m", speed: "rad/s", grade: "m/s" } "AB1094" Invalid
            ("The unbalance is implausible: {eccentricity:.3e} m of eccentricity (all planes in one direction) at {speed:.0} rad/s are a balance quality grade G {:.0} (ISO 21940-11, mm/s); turbomachines have G 1 to G 6.3. A lost blade would be one.", grade * 1e3);
        Inclined { angle: "rad", gravity: "m/s^2", share: "1" } "AB1095" [NO_QUALIFICATION] Invalid
            ("The shaft stands {:.1} deg from the horizontal ({gravity} m/s^2 across it): {share:.3} of g acts along it. What carries that, the axial drop onto the thrust faces, is not described, nor the friction of the loaded balls. Radial forces of such a run are no qualification of the machine.", angle.to_degrees());
    }
}

/// On which side of the catalogue's value a given one is doubtful.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Both,
    /// A sleeve adds mass: less than the bare ring has is doubtful.
    Below,
    /// A sleeve narrows the bore: more than the bare ring has is doubtful.
    Above,
}

/// What makes a bearing the one named, and the share by which tables, roundings and, of ring masses, estimates of one bearing differ.
const IDENTITY: &[(&str, f64, Side)] = &[
    ("bearing.type", 0.0, Side::Both),
    ("bearing.ball_material", 0.0, Side::Both),
    ("bearing.ball_count", 0.0, Side::Both),
    ("bearing.ball_diameter", 5e-3, Side::Both),
    ("bearing.pitch_diameter", 2e-2, Side::Both),
    ("bearing.contact_angle", 5e-2, Side::Both),
    ("bearing.static_load_rating", 0.1, Side::Both),
    ("bearing.inner_race_mass", 0.3, Side::Below),
    ("bearing.inner_race_inertia", 0.3, Side::Below),
    ("contact.bore_diameter", 1e-3, Side::Above),
    ("drive.bore_diameter", 1e-3, Side::Above),
    ("bearing.fits.bore_diameter", 1e-3, Side::Both),
    ("bearing.fits.outer_diameter", 1e-3, Side::Both),
    ("bearing.moment.bore_diameter", 1e-3, Side::Both),
    ("bearing.moment.outer_diameter", 1e-3, Side::Both),
];

const NAME: &str = "bearing.name";
/// Wear coefficient of metals that seize, with a decade to spare, m²/N.
const LARGEST_WEAR: f64 = 1e-11;
/// Friction of landing pairs: above 1 only clean metals in vacuum are known.
const LARGEST_FRICTION: f64 = 1.0;
/// Radius of gyration of a rotor over the radius of its shaft: a solid shaft has 0.71, a large disk on a thin one 15.
const GYRATION: [f64; 2] = [0.5, 20.0];
/// Static load rating over Z D² cos α, N/mm²: makers' values lie between 6 and 22.
const RATING: [f64; 2] = [5.0, 25.0];
/// Stiffness of a solid seat: Young's modulus of steel times the width of a bearing of 24 mm, N/m.
const STIFFEST_MOUNT: f64 = 5e9;
/// Share of critical damping that a rotor's material and fits give a mode at its speed.
const LARGEST_ROTOR_DAMPING: f64 = 0.05;
/// What damps a mount besides its damper.
const DAMPING_PARTS: [&str; 3] = [
    "mount.branch_stiffness",
    "mount.ring_stiffness",
    "mount.film_radius",
];

impl Values {
    /// Everything worth a note.
    pub fn notes(&self) -> Vec<Warning> {
        let mut list = Vec::new();
        list.extend(self.inclined());
        list.extend(self.another_bearing());
        list.extend(self.left_out());
        list.extend(self.implausible());
        list.extend(self.extrapolated());
        list.extend(self.without_effect.iter().map(|path| {
            let (key, value) = (self.shown(path), self.text(path).unwrap_or_default());
            ValueWarning::Information { key, value }.into()
        }));
        list
    }

    /// An oil beyond the data of its viscosity, where the run does not follow its temperature and say so itself.
    fn extrapolated(&self) -> Option<Warning> {
        const TEMPERATURE: &str = "bearing.moment.temperature";
        let points = self.rows("bearing.moment.viscosity_points")?;
        let temperature = self.number(TEMPERATURE)?;
        let [one, other] = points.as_slice() else {
            return None;
        };
        let oil = Viscosity::through((one[0], one[1]), (other[0], other[1])).ok()?;
        let followed = self.chosen("heat.network") == Some(Network::On) || self.is_in(COAST_DOWN);
        (!followed && oil.beyond(temperature) > 0.0).then(|| {
            let how = drawn_on(&oil, temperature);
            let key = self.shown(TEMPERATURE);
            LubricantWarning::Drawn { key, how }.into()
        })
    }

    /// A shaft whose weight the radial bearings carry in part, or not at all.
    fn inclined(&self) -> Option<Warning> {
        let gravity = self.number("gravity.acceleration")?;
        // a weight along the shaft that is given is one that a bearing in space carries
        let carried = self.number("gravity.axial").unwrap_or(0.0);
        let share = axial_share(gravity.hypot(carried));
        (self.system().falls() && share > 0.0).then(|| {
            let angle = share.asin();
            ValueWarning::Inclined {
                angle,
                gravity,
                share,
            }
            .into()
        })
    }

    /// Given values that are not those of the bearing named.
    fn another_bearing(&self) -> Option<Warning> {
        let record = self.record.as_ref()?;
        let differ: Vec<String> = IDENTITY
            .iter()
            .filter_map(|&(path, share, side)| {
                let known = self.known.get(path)?;
                let key = table::keys_of(self.system()).find(|key| key.path == path)?;
                let own = self.catalogued(key, Some(record)).ok().flatten()?;
                let differs = match (known.value.number(), own.value.number()) {
                    (Some(value), Some(own)) => {
                        let excess = value - own;
                        let counts = match side {
                            Side::Both => excess.abs(),
                            Side::Below => -excess,
                            Side::Above => excess,
                        };
                        counts > share * own.abs()
                    }
                    _ => known.value != own.value,
                };
                // in the unit of the given value
                let unit = known.text.split_once(' ').map(|(_, unit)| unit);
                let own_text = (own.value.number().zip(unit))
                    .and_then(|(si, unit)| display(si, unit).ok())
                    .unwrap_or(own.text);
                (self.is_own(path) && differs)
                    .then(|| format!("{} {} ({own_text})", self.shown(path), known.text))
            })
            .collect();
        let name = &record.name;
        (!differ.is_empty()).then(|| {
            let (differ, name) = (differ.join(", "), name.clone());
            ValueWarning::AnotherBearing { differ, name }.into()
        })
    }

    /// What of a designation the catalogue does not tell apart.
    fn left_out(&self) -> Option<Warning> {
        let typed = self.text(NAME)?;
        let record = self.record.as_ref()?;
        if typed.trim().eq_ignore_ascii_case(&record.name) {
            return None;
        }
        // the steel bearing of a hybrid one too
        let known = |name: &str| record.name.starts_with(name);
        let Some(Designation::Known {
            left_out,
            arrangement,
            ..
        }) = designation::read(&typed, &known)
        else {
            return None;
        };
        let planar = self.text("bearing.arrangement").is_none();
        let rows = arrangement.filter(|_| planar).map(|own| {
            format!("{own}, the other rows (bearing.fidelity = \"spatial\" has all). {PAIRS}")
        });
        let left_out = Some(left_out).filter(|words| !words.is_empty());
        let words: Vec<String> = left_out.into_iter().chain(rows).collect();
        let behind = match words.is_empty() {
            true => String::new(),
            false => format!(", without {}", words.join("; ")),
        };
        let name = record.name.clone();
        Some(
            ValueWarning::LeftOut {
                typed,
                name,
                behind,
            }
            .into(),
        )
    }

    /// Values that hardly any machine has.
    fn implausible(&self) -> Vec<Warning> {
        let mut list = Vec::new();
        let mut doubt = |path: &str, usual: String| {
            let (key, value) = (self.shown(path), self.text(path).unwrap_or_default());
            list.push(ValueWarning::Implausible { key, value, usual }.into());
        };
        for path in ["contact.friction_coefficient", "drive.friction_coefficient"] {
            if self
                .number(path)
                .is_some_and(|friction| friction > LARGEST_FRICTION)
            {
                doubt(
                    path,
                    "landing pairs have 0.05 to 0.5, and only clean metals in vacuum more than 1"
                        .to_string(),
                );
            }
        }
        let wear = "contact.surface.wear_coefficient";
        if self.number(wear).is_some_and(|wear| wear > LARGEST_WEAR) {
            doubt(
                wear,
                "dry steel on steel has 1e-15 m²/N where it wears mildly, and 1e-12 m²/N where it seizes".to_string(),
            );
        }
        let shaft = || {
            Some(
                0.5 * self.number("contact.bore_diameter")?
                    - self.number("contact.radial_air_clearance")?,
            )
        };
        if let (Some(mass), Some(inertia), Some(shaft)) = (
            self.number("rotor.mass"),
            self.number("rotor.polar_inertia"),
            shaft(),
        ) {
            let gyration = (inertia / mass).sqrt();
            let [least, most] = GYRATION.map(|share| share * shaft);
            if shaft > 0.0 && !(least..=most).contains(&gyration) {
                doubt(
                    "rotor.polar_inertia",
                    format!(
                        "with rotor.mass = {} it is a radius of gyration of {:.4} m, and a shaft of {:.4} m radius carries rotors of \
                         {least:.4} to {most:.4} m",
                        self.text("rotor.mass").unwrap_or_default(),
                        gyration,
                        shaft
                    ),
                );
            }
        }
        for path in ["rotor.damping_of_stiffness", "rotor.damping_rotating"] {
            let share = self.number(path).zip(self.number("rotor.speed"));
            let share = share.map_or(0.0, |(time, speed)| 0.5 * time * speed.abs());
            if share > LARGEST_ROTOR_DAMPING {
                doubt(
                    path,
                    format!(
                        "it damps a mode at the speed of the rotor with {:.0} % of critical (half the product of both), and shafts have 0.1 to 2 %",
                        1e2 * share
                    ),
                );
            }
        }
        if self.number("mount.damping") == Some(0.0)
            && DAMPING_PARTS.iter().all(|part| !self.is_own(part))
        {
            doubt(
                "mount.damping",
                "nothing damps the mount, so the rotor bounces on it for as long as the run lasts; even a solid seat damps".to_string(),
            );
        }
        let rating = self
            .number("bearing.static_load_rating")
            .zip(self.area_of_balls());
        if let Some(rating) = rating.map(|(rating, area)| rating / area * 1e-6)
            && !(RATING[0]..=RATING[1]).contains(&rating)
        {
            doubt(
                "bearing.static_load_rating",
                format!("it is {rating:.1} N/mm² of Z D² cos α, and makers' bearings have 6 to 22"),
            );
        }
        let mount = "mount.stiffness";
        if self.number(mount).is_some_and(|own| own > STIFFEST_MOUNT) {
            doubt(
                mount,
                format!("a seat of solid steel has some {STIFFEST_MOUNT:e} N/m"),
            );
        }
        list
    }

    /// Z D² cos α of the balls of all rows, m².
    pub fn area_of_balls(&self) -> Option<f64> {
        let rows = match self.chosen("bearing.type") {
            Some(BearingType::AngularContactDoubleRow) => 2.0,
            _ => 1.0,
        };
        let ball = self.number("bearing.ball_diameter")?;
        let angle = self.number("bearing.contact_angle").unwrap_or(0.0);
        Some(rows * self.number("bearing.ball_count")? * ball * ball * angle.cos())
    }
}
