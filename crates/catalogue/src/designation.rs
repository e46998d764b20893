//! Designations as people type them: which bearing of the catalogue is meant, and what of the designation is left out.
//!
//! ```text
//!   6205-2RS1/C3    core 6205, suffixes 2RS1 C3         a deep groove bearing with seals: the 6205
//!   6808            series 68 of JIS                    the 61808 of ISO
//!   7010 CD         angular contact, bore 50, suffix CD no bearing of this name: which ones have its size
//! ```
//! The catalogue has dimensions, not variants: seals, clearance, cage and grease are values of their own in a scenario.

/// What a designation stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Designation {
    /// A bearing of the catalogue.
    Known {
        /// Its name there.
        name: String,
        /// What of the designation is left out, in words; empty for nothing.
        left_out: String,
    },
    /// None; the text says what is missing, and what there is instead.
    Missing(String),
}

/// Makers before a designation.
const MAKERS: &[&str] = &["SKF", "FAG", "NSK", "NTN", "KOYO", "NACHI", "TIMKEN", "GMN"];

/// Suffixes of deep groove bearings by what they mean.
const SUFFIXES: &[(&str, &[&str])] = &[
    (
        "seals (their friction is bearing.moment.seal_moment; limiting speeds are lower)",
        &[
            "RS", "RS1", "2RS", "2RS1", "2RS2", "RSR", "2RSR", "RSH", "2RSH", "RSL", "2RSL", "RZ",
            "2RZ", "DD", "DDU", "DU", "LU", "LLU", "LB", "LLB",
        ],
    ),
    ("shields", &["Z", "ZZ", "2Z", "ZR", "2ZR", "VV"]),
    (
        "internal clearance (bearing.unmounted_diametral_clearance)",
        &["C2", "CN", "C3", "C4", "C5", "CM"],
    ),
    ("class of precision", &["P0", "P6", "P5", "P4", "P2"]),
    (
        "kind of cage (bearing.cage_mass, [bearing.cage])",
        &[
            "M", "MA", "MB", "J", "JR", "T", "TN", "TN9", "TNH", "TNG", "TVH", "TVP",
        ],
    ),
    ("grease", &["WT", "MT33", "MT47", "LHT23", "GJN", "VT307"]),
    ("snap ring", &["N", "NR"]),
    ("heat treatment", &["S0", "S1", "S2"]),
];
/// Suffixes of ceramic balls.
const CERAMIC: &[&str] = &["HYBRID", "HC5", "HC"];

/// Angular contact bearings: series, and what stands before the bore in the names of the catalogue; empty where it has none.
const ANGULAR: &[(&str, &str)] = &[
    ("718", "SNFA SEA "),
    ("719", "SNFA SEB "),
    ("70", "SNFA EX "),
    ("72", "SNFA E 2"),
    ("73", ""),
];
/// What the catalogue's spindle bearings of the larger angle are called.
const LARGER_ANGLE: &str = " 25deg";

/// Reads a designation that is no name of the catalogue; `known` tells whether a name is one. None for what is not understood.
pub fn read(typed: &str, known: &dyn Fn(&str) -> bool) -> Option<Designation> {
    let upper = typed.trim().to_uppercase();
    let mut words: Vec<&str> = upper
        .split([' ', '-', '/', ',', '_', '.'])
        .filter(|word| !word.is_empty())
        .collect();
    if words.first().is_some_and(|word| MAKERS.contains(word)) {
        words.remove(0);
    }
    let first = words.first()?;
    let prefix = first.find(|c: char| c.is_ascii_digit())?;
    let (before, rest) = first.split_at(prefix);
    let end = rest
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(rest.len());
    let (core, behind) = rest.split_at(end);
    let suffixes: Vec<&str> = (!behind.is_empty())
        .then_some(behind)
        .into_iter()
        .chain(words[1..].iter().copied())
        .collect();
    match (before, *core.as_bytes().first()?, core.len()) {
        ("", b'6', 3..=5) | ("", b'1', 5) => deep_groove(core, &suffixes, known),
        // B, HCB, XCB, HS, S: makers' letters of spindle bearings
        ("" | "B" | "HCB" | "XCB" | "HS" | "HCS" | "S", b'7', 4..=5) => angular(core, known),
        ("", b'3', 4) if matches!(core.as_bytes()[1], b'0' | b'2' | b'3' | b'8') => {
            Some(Designation::Missing(format!(
                "a double row angular contact bearing is not in the catalogue. {PAIRS}"
            )))
        }
        ("QJ", ..) => Some(Designation::Missing(
            "four-point contact bearings are not in the catalogue".to_string(),
        )),
        _ => None,
    }
}

/// How several rows or bearings at one place are described.
pub const PAIRS: &str = "Each row is a bearing of its own: for a pair at each of two places rotor.planes = 4, or planes = 2 in the [[auxiliary_bearing]] of each, with bearing.type = \"angular contact\", the ball_count of one row, and half of the place's mount.stiffness, mount.damping and mount.moving_mass each";

fn deep_groove(core: &str, suffixes: &[&str], known: &dyn Fn(&str) -> bool) -> Option<Designation> {
    // the thin series of JIS have four digits, those of ISO five
    let iso = match core.len() {
        4 if core.starts_with("68") || core.starts_with("69") => format!("61{}", &core[1..]),
        _ => core.to_string(),
    };
    let steel = [core, iso.as_str()].into_iter().find(|name| known(name))?;
    let mut left_out = Vec::new();
    let mut ceramic = false;
    for suffix in suffixes {
        let Some(pieces) = pieces(suffix) else {
            return Some(Designation::Missing(format!(
                "\"{steel}\" is in the catalogue; what \"{suffix}\" behind it means is not known here"
            )));
        };
        for (piece, meaning) in pieces {
            match meaning {
                Some(meaning) => left_out.push(format!("{piece}, {meaning}")),
                None => ceramic = true,
            }
        }
    }
    let name = match ceramic {
        true => format!("{steel} hybrid"),
        false => steel.to_string(),
    };
    if !known(&name) {
        return Some(Designation::Missing(format!(
            "the catalogue has \"{steel}\" with steel balls alone; with bearing.ball_material = \"silicon nitride\" beside that name \
             it is a hybrid bearing, whose limiting speed is then yours to give"
        )));
    }
    Some(Designation::Known {
        name,
        left_out: left_out.join("; "),
    })
}

/// A suffix, or several written as one word, each with its meaning; none of ceramic balls. `None` where a letter is left over.
fn pieces(suffix: &str) -> Option<Vec<(&str, Option<&'static str>)>> {
    if suffix.is_empty() {
        return Some(Vec::new());
    }
    let plain = SUFFIXES
        .iter()
        .flat_map(|(meaning, list)| list.iter().map(|piece| (*piece, Some(*meaning))));
    let mut all: Vec<_> = plain
        .chain(CERAMIC.iter().map(|piece| (*piece, None)))
        .filter(|(piece, _)| suffix.starts_with(piece))
        .collect();
    all.sort_by_key(|(piece, _)| std::cmp::Reverse(piece.len()));
    all.into_iter().find_map(|(piece, meaning)| {
        let mut list = vec![(&suffix[..piece.len()], meaning)];
        list.extend(pieces(&suffix[piece.len()..])?);
        Some(list)
    })
}

fn angular(core: &str, known: &dyn Fn(&str) -> bool) -> Option<Designation> {
    let (series, family) = ANGULAR.iter().find(|(series, _)| {
        core.strip_prefix(series)
            .is_some_and(|rest| rest.len() == 2)
    })?;
    let code: u32 = core[series.len()..].parse().ok()?;
    let bore = match code {
        0 => 10,
        1 => 12,
        2 => 15,
        3 => 17,
        code => 5 * code,
    };
    let name = format!("{family}{bore}");
    let names: Vec<String> = [name.clone(), name + LARGER_ANGLE]
        .into_iter()
        .filter(|name| !family.is_empty() && known(name))
        .map(|name| format!("\"{name}\""))
        .collect();
    let what = format!(
        "an angular contact bearing of series {series} with a bore of {bore} mm is not in the catalogue under that name, because balls \
         differ between makers"
    );
    Some(Designation::Missing(match names.as_slice() {
        [] => format!("{what}; give its balls, pitch_diameter and contact_angle"),
        names => format!(
            "{what}; it has this size as {} (15 and 25 deg). Compare ball_count and ball_diameter, or give them",
            names.join(" and ")
        ),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate as catalogue;

    fn of(typed: &str) -> Option<Designation> {
        read(typed, &|name| catalogue::find(name).is_some())
    }

    fn known(typed: &str) -> (String, String) {
        match of(typed) {
            Some(Designation::Known { name, left_out }) => (name, left_out),
            other => panic!("{typed}: {other:?}"),
        }
    }

    fn missing(typed: &str) -> String {
        match of(typed) {
            Some(Designation::Missing(why)) => why,
            other => panic!("{typed}: {other:?}"),
        }
    }

    #[test]
    fn suffixes_are_told_and_left_out() {
        for typed in [
            "6205-2RS",
            "6205-2Z",
            "6205 2RSH",
            "6205zz",
            "6205-2rs1/c3",
            "SKF 6205",
            "6205DDU",
            "6205 P5",
        ] {
            assert_eq!(known(typed).0, "6205", "{typed}");
        }
        assert!(
            known("6205-2RS1/C3").1.contains("seals")
                && known("6205-2RS1/C3").1.contains("clearance")
        );
        assert_eq!(known("SKF 6205").1, "");
        // the maker's full designation of the hybrid bearing, as the catalogue's own description has it
        for typed in ["6005-2RSLTN9/HC5C3WT", "6005 HC5", "6005-2RZ hybrid"] {
            assert_eq!(known(typed).0, "6005 hybrid", "{typed}");
        }
        assert_eq!(known("6907").0, "61907");
        assert!(missing("6205-XQ").contains("\"XQ\""));
        assert!(missing("6303 hybrid").contains("silicon nitride"));
    }

    #[test]
    fn an_angular_contact_designation_names_what_has_its_size() {
        for (typed, name) in [
            ("7010", "\"SNFA EX 50\" and \"SNFA EX 50 25deg\""),
            ("7010 CD", "\"SNFA EX 50\""),
            ("b7010-c-t-p4s", "\"SNFA EX 50\""),
            ("71910", "\"SNFA SEB 50\""),
            ("71802", "\"SNFA SEA 15\""),
            ("7205", "\"SNFA E 225\""),
        ] {
            assert!(missing(typed).contains(name), "{}", missing(typed));
        }
        assert!(missing("7310 BECBP").contains("contact_angle"));
        assert!(missing("3205 A").contains("rotor.planes = 4"));
    }

    #[test]
    fn what_is_no_designation_is_left_to_the_near_names() {
        for typed in ["", "my bearing", "6995", "SNFA XE 50", "NU 205", "62055"] {
            assert_eq!(of(typed), None, "{typed}");
        }
    }
}
