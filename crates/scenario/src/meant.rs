//! What an unknown key was probably meant to be, and what may stand in its place.

use crate::key::Key;
use crate::measured::MEASURED;
use crate::several::{AUXILIARY_BEARING, LIMIT, VARY};
use crate::system::SystemName;
use crate::table;
use problem::question;
use units::nearest_names;

/// Most names of a section that a message lists.
const MOST_NAMES: usize = 14;

/// Lists of tables that a file of a system may have.
fn lists(system: SystemName) -> impl Iterator<Item = &'static str> {
    let of_drops = [AUXILIARY_BEARING, MEASURED, VARY];
    let of_drops = of_drops.into_iter();
    of_drops
        .filter(move |_| system.has_auxiliary_bearings())
        .chain([LIMIT])
}

/// What may stand where the unknown key stands.
pub fn allowed_near(path: &[String], system: SystemName) -> String {
    let section = path[..path.len() - 1].join(".");
    let names: Vec<&str> = if section.is_empty() {
        let keys = table::keys_of(system).filter(|key| key.section().is_empty());
        let sections = table::sections_of(system).filter(|section| !section.path.contains('.'));
        keys.map(|key| key.path)
            .chain(sections.map(|section| section.path))
            .chain(lists(system))
            .collect()
    } else {
        table::keys_of(system)
            .filter(|key| key.section() == section)
            .map(Key::name)
            .chain(
                table::sections_of(system)
                    .filter_map(|inner| inner.path.strip_prefix(&section)?.strip_prefix('.')),
            )
            .collect()
    };
    if names.is_empty() {
        let sections: Vec<&str> = table::sections_of(system)
            .map(|section| section.path)
            .collect();
        return format!("the sections are {}", sections.join(", "));
    }
    if names.len() > MOST_NAMES && !section.is_empty() {
        return format!(
            "a key of [{section}] is needed; auxbear new {} lists them",
            system.word()
        );
    }
    let place = if section.is_empty() {
        "the top level".to_string()
    } else {
        format!("[{section}]")
    };
    format!("{place} takes {}", names.join(", "))
}

/// What an unknown key was probably meant to be.
pub fn meant(path: &[String], system: SystemName) -> Option<String> {
    let name = path.last()?;
    if system.has_auxiliary_bearings() && is_another_bearing(&path[0]) {
        return Some(OTHERS.to_string());
    }
    if let Some(hint) = confused(name, system) {
        return Some(hint.to_string());
    }
    let dotted = path.join(".");
    if let Some((_, right)) = SYNONYMS.iter().find(|pair| pair.0 == dotted)
        && table::keys_of(system).any(|key| key.path == *right)
    {
        return question(&[right]);
    }
    let section = path[..path.len() - 1].join(".");
    let all = || {
        table::keys_of(system)
            .map(|key| key.path)
            .chain(table::sections_of(system).map(|section| section.path))
            .chain(lists(system))
    };
    let last = |path: &'static str| path.rsplit('.').next().unwrap_or(path);
    let inside = |path: &str| path.rsplit_once('.').map_or("", |(section, _)| section) == section;
    // The same name elsewhere, then a near name in the same section, then a near path, then a near name elsewhere.
    let mut names: Vec<&str> = all().filter(|path| last(path) == name).collect();
    if names.is_empty() {
        let near = nearest_names(name, all().filter(|path| inside(path)).map(last));
        names = all()
            .filter(|path| inside(path) && near.first() == Some(&last(path)))
            .collect();
    }
    if names.is_empty() {
        names = nearest_names(&dotted, all());
        names.truncate(1);
    }
    // Short names are near too many others.
    if names.is_empty() && name.len() > 3 {
        let near = nearest_names(name, all().map(last));
        names = all()
            .filter(|path| near.first() == Some(&last(path)))
            .collect();
    }
    names.truncate(3);
    question(&names)
}

const OTHERS: &str = "Bearings that differ are tables [[auxiliary_bearing]], each with name and with what it has of its own in contact, mount and bearing; equal rows are counted by planes there, equal bearings without names by rotor.planes";

/// Whether a section is one for a second bearing: `bearing_2`, `bearings`, `drive_end`.
fn is_another_bearing(section: &str) -> bool {
    let numbered = section.strip_prefix("bearing").is_some_and(|rest| {
        let rest = rest.trim_start_matches('_');
        rest == "s" || (rest.len() == 1 && rest.starts_with(|c: char| c.is_ascii_alphanumeric()))
    });
    numbered || ["drive_end", "non_drive_end", "second_bearing"].contains(&section)
}

/// Names that another key bears elsewhere, and what is meant by them.
const SYNONYMS: [(&str, &str); 1] = [("rig.logger.format", "rig.logger.file")];

/// Keys of one system and what stands for them in another.
const COUNTERPARTS: [(&str, &str); 4] = [
    ("rotor.speed", "drive.rotor_speed"),
    ("rotor.spin", "drive.rotor_spin"),
    ("rotor.polar_inertia", "drive.rotor_polar_inertia"),
    ("bearing.inner_race_torque", "drive.torque"),
];

/// The keys of a system that stand for a key of another one, or bear its name.
pub fn namesake(path: &[String], system: SystemName) -> Option<String> {
    if path.first().is_some_and(|section| section == "repeat") {
        return Some(REPEATED.to_string());
    }
    let (name, dotted) = (path.last()?, path.join("."));
    let counterpart = COUNTERPARTS.iter().find(|pair| pair.0 == dotted);
    if let Some((_, other)) = counterpart
        && table::keys_of(system).any(|key| key.path == *other)
    {
        return question(&[other]);
    }
    let names: Vec<&str> = table::keys_of(system)
        .filter(|key| key.name() == name)
        .map(|key| key.path)
        .collect();
    question(&names)
}

const REPEATED: &str = "Only drops are repeated so far (--repeat and [repeat]): their late impacts are chaotic, while the same file gives the same numbers here. To see what a value does, run once for each with --set PATH=VALUE --out DIR, and put the runs side by side with auxbear report DIR…";
const CLEARANCES: &str = "contact.radial_air_clearance is the radial gap between rotor and inner race, half the difference of their diameters; bearing.operating_diametral_clearance is the diametral internal clearance of the bearing";
const DIAMETERS: &str = "The file takes diameters: bearing.ball_diameter, bearing.pitch_diameter, contact.bore_diameter";

/// Names that are commonly confused, by the last part of the path.
fn confused(name: &str, system: SystemName) -> Option<&'static str> {
    let name = name.to_lowercase();
    if !system.falls() {
        return confused_without_rotor(&name);
    }
    if ["clearance", "air_gap", "airgap", "preload", "internal_play"]
        .iter()
        .any(|part| name.contains(part))
    {
        // A near miss of the right name is better told as such.
        let right = ["radial_air_clearance", "operating_diametral_clearance"];
        let near = right
            .iter()
            .any(|right| units::edit_distance(&name, right) <= 4);
        return (!near).then_some(CLEARANCES);
    }
    if name.contains("radius") {
        return Some(DIAMETERS);
    }
    Some(match name.as_str() {
        "rpm" | "omega" | "spin_speed" | "rotational_speed" => {
            "The spin of the rotor is rotor.speed, e.g. \"12000 rpm\""
        }
        "mu" | "friction" => {
            "Friction between rotor and inner race is contact.friction_coefficient"
        }
        "inertia" | "moment_of_inertia" => {
            "The inertia of the rotor about its axis is rotor.polar_inertia"
        }
        "balls" | "number_of_balls" | "n_balls" => "The number of balls is bearing.ball_count",
        "eccentricity" => "The eccentricity of the rotor is rotor.unbalance_eccentricity",
        "timestep" | "time_step" | "dt" | "step" => {
            "The step follows from run.tolerance and is at most run.largest_step; run.output_interval is the time between rows of the history"
        }
        "gravity" | "g" => "Gravity is gravity.acceleration with gravity.direction",
        _ => return None,
    })
}

/// The same in systems that have no dropping rotor.
fn confused_without_rotor(name: &str) -> Option<&'static str> {
    if name.contains("radius") {
        return Some("The file takes diameters: bearing.ball_diameter, bearing.pitch_diameter");
    }
    Some(match name {
        "balls" | "number_of_balls" | "n_balls" => "The number of balls is bearing.ball_count",
        "timestep" | "time_step" | "dt" | "step" => {
            "The step follows from run.tolerance and is at most run.largest_step; run.output_interval is the time between rows of the history"
        }
        _ => return None,
    })
}
