//! Designations as people type them: which bearing of the catalogue is meant, and what of the designation is left out.
//!
//! ```text
//!   6205-2RS1/C3       core 6205, suffixes 2RS1 C3         a deep groove bearing with seals: the 6205
//!   6808               series 68 of JIS                    the 61808 of ISO
//!   7010 CD/P4ADBA     core 7010, CD 15 deg, DB            the 7010 C, back to back; class and preload left out
//!   HCB71910-E-T-P4S   ceramic balls, E 25 deg             the 71910 AC hybrid
//!   7010               no contact angle                    no bearing of this name: which ones have its size
//! ```
//! The catalogue has dimensions, not variants: seals, clearance, cage and grease are values of their own in a scenario.
//! The arrangement of a pair (DB, DF, DT) or of a set (TBT, QBC ...) is one too, which a scenario and a command take from the name.

/// What a designation stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Designation {
    /// A bearing of the catalogue.
    Known {
        /// Its name there.
        name: String,
        /// What of the designation is left out, in words; empty for nothing.
        left_out: String,
        /// How two of it stand, where the designation says it: DB, DF or DT.
        arrangement: Option<&'static str>,
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
const CERAMIC: &[&str] = &["HYBRID", "HC5", "HC", "SN24"];

/// Makers' letters of angular contact bearings with steel and with ceramic balls.
const PREFIXES: [&[&str]; 2] = [&["", "B", "HS", "S"], &["HCB", "XCB", "HCS", "HC"]];
/// First suffixes of angular contact bearings by their contact angle, as the catalogue spells it; empty where it has none.
const ANGLES: &[(&str, &[&str])] = &[
    ("C", &["C", "CD", "CE", "CB"]),
    ("AC", &["AC", "ACD", "ACE", "ACB", "AD", "A5"]),
    ("B", &["B", "BE"]),
    ("", &["A"]),
];
/// FAG's suffix of 25 deg, behind a prefix alone: others call a reinforced design so.
const FAG_25_DEG: &str = "E";
/// Arrangements of pairs and sets.
const PAIRED: [&str; 11] = [
    "DB", "DF", "DT", "TBT", "TFT", "TT", "QBC", "QFC", "QBT", "QFT", "QT",
];
/// Letters behind an arrangement: the class of preload.
const PRELOADS: &str = "ABCDLMH";
/// Suffixes of angular contact bearings by what they mean.
#[rustfmt::skip]
const ANGULAR_SUFFIXES: &[(&str, &[&str])] = &[
    ("rows matched for any arrangement (bearing.arrangement, bearing.axial_preload)",
        &["U", "UL", "G", "GA", "GB", "GC", "DU", "DUL", "DUM", "SU", "SUL", "DG", "DGA", "CA", "CB", "CC"]),
    ("class of precision", &["P0", "P6", "P5", "P4", "P4S", "P4A", "P2", "PA9A"]),
    ("kind of cage (bearing.cage_mass, [bearing.cage])",
        &["T", "TVP", "TVH", "TYN", "TR", "M", "MP", "MA", "P", "J", "Y", "F"]),
    ("internal design", &["XL"]),
    ("seals", &["2RS", "2RZ", "2RSD", "S", "V1V"]),
];

/// Angular contact bearings: series, and what stands before the bore in the names of one maker; empty where the catalogue has none.
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
        (_, b'7', 4..=5) => {
            let balls = PREFIXES.iter().position(|own| own.contains(&before))?;
            angular(core, (!before.is_empty(), balls == 1), &suffixes, known)
        }
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
        let Some(pieces) = pieces(suffix, SUFFIXES) else {
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
        arrangement: None,
    })
}

/// Suffixes by what they mean.
type Suffixes = [(&'static str, &'static [&'static str])];

/// A suffix, or several written as one word, each with its meaning; none of ceramic balls. `None` where a letter is left over.
fn pieces<'s>(
    suffix: &'s str,
    suffixes: &Suffixes,
) -> Option<Vec<(&'s str, Option<&'static str>)>> {
    if suffix.is_empty() {
        return Some(Vec::new());
    }
    let plain = suffixes
        .iter()
        .flat_map(|(meaning, list)| list.iter().map(|piece| (*piece, Some(*meaning))));
    let mut all: Vec<_> = plain
        .chain(CERAMIC.iter().map(|piece| (*piece, None)))
        .filter(|(piece, _)| suffix.starts_with(piece))
        .collect();
    all.sort_by_key(|(piece, _)| std::cmp::Reverse(piece.len()));
    all.into_iter().find_map(|(piece, meaning)| {
        let mut list = vec![(&suffix[..piece.len()], meaning)];
        list.extend(pieces(&suffix[piece.len()..], suffixes)?);
        Some(list)
    })
}

/// What the suffixes of an angular contact bearing say.
#[derive(Default)]
struct Angular {
    angle: Option<&'static str>,
    ceramic: bool,
    arrangement: Option<&'static str>,
    left_out: Vec<String>,
}

impl Angular {
    /// Reads a suffix behind the contact angle; false where a letter is left over or a second arrangement is named.
    fn read(&mut self, suffix: &str) -> bool {
        let places = PAIRED.map(|word| suffix.find(word).map(|place| (place, word)));
        let found = places.into_iter().flatten().min();
        let Some((place, arrangement)) = found.filter(|_| self.arrangement.is_none()) else {
            return self.read_rest(suffix);
        };
        let (before, behind) = (&suffix[..place], &suffix[place + arrangement.len()..]);
        let class = behind.starts_with(|letter| PRELOADS.contains(letter));
        let (class, behind) = behind.split_at(usize::from(class));
        let start = self.left_out.len();
        if self.read_rest(before) && self.read_rest(behind) {
            self.arrangement = Some(arrangement);
            let class = (!class.is_empty()).then(|| {
                format!("{arrangement}{class}, class of preload {class} (bearing.axial_preload)")
            });
            self.left_out.extend(class);
            return true;
        }
        self.left_out.truncate(start);
        self.read_rest(suffix)
    }

    fn read_rest(&mut self, suffix: &str) -> bool {
        let Some(pieces) = pieces(suffix, ANGULAR_SUFFIXES) else {
            return false;
        };
        for (piece, meaning) in pieces {
            match meaning {
                Some(meaning) => self.left_out.push(format!("{piece}, {meaning}")),
                None => self.ceramic = true,
            }
        }
        true
    }

    /// The first suffix: the angle, and what is written to it. An arrangement counts before longer letters of the angle, so that
    /// CDB is C and DB.
    fn first(suffix: &str, prefixed: bool) -> Option<Angular> {
        let fag = prefixed.then_some(("AC", FAG_25_DEG));
        let marks = ANGLES
            .iter()
            .flat_map(|(angle, marks)| marks.iter().map(|mark| (*angle, *mark)));
        let readings = marks.chain(fag).filter_map(|(angle, mark)| {
            let mut own = Angular {
                angle: Some(angle),
                ..Angular::default()
            };
            let rest = suffix.strip_prefix(mark)?;
            own.read(rest)
                .then_some((own.arrangement.is_some(), mark.len(), own))
        });
        readings
            .max_by_key(|own| (own.0, own.1))
            .map(|(_, _, own)| own)
    }
}

/// Reads an angular contact bearing; whether makers' letters stand before it, and whether they say ceramic balls.
fn angular(
    core: &str,
    (prefixed, ceramic): (bool, bool),
    suffixes: &[&str],
    known: &dyn Fn(&str) -> bool,
) -> Option<Designation> {
    let size = &core[core.len() - 2..];
    // the thin series of JIS have four digits, those of ISO five
    let series = match &core[..core.len() - 2] {
        "78" => "718",
        "79" => "719",
        series => series,
    };
    let (_, family) = ANGULAR.iter().find(|own| own.0 == series)?;
    let bore = match size.parse::<u32>().ok()? {
        0 => 10,
        1 => 12,
        2 => 15,
        3 => 17,
        code => 5 * code,
    };
    let balls = |angle: &str, ceramic: bool| match ceramic {
        true => format!("{series}{size} {angle} hybrid"),
        false => format!("{series}{size} {angle}"),
    };
    let maker = format!("{family}{bore}");
    let sizes = ["C", "AC", "B"].map(|angle| balls(angle, ceramic));
    let makers = [maker.clone(), maker + LARGER_ANGLE];
    let names: Vec<String> = sizes
        .into_iter()
        .chain(makers)
        .filter(|name| !family.is_empty() && known(name))
        .map(|name| format!("\"{name}\""))
        .collect();
    let missing = |what: &str| {
        let size = match names.as_slice() {
            [] => format!(
                "no angular contact bearing of series {series} with a bore of {bore} mm is in the catalogue; give its balls, pitch_diameter and contact_angle"
            ),
            names => format!(
                "the catalogue has angular contact bearings of this size as {} (C 15, AC 25, B 40 deg; SNFA 15 and 25 deg). Balls differ between makers: compare ball_count and ball_diameter, or give them",
                names.join(", ")
            ),
        };
        Some(Designation::Missing(format!("{what}{size}")))
    };
    let Some((first, others)) = suffixes.split_first() else {
        return missing("its contact angle is not named; ");
    };
    let unknown = |suffix: &str| format!("what \"{suffix}\" means is not known here; ");
    let Some(mut own) = Angular::first(first, prefixed) else {
        return missing(&unknown(first));
    };
    own.ceramic |= ceramic;
    for suffix in others {
        if !own.read(suffix) {
            return missing(&unknown(suffix));
        }
    }
    let name = balls(own.angle.unwrap_or_default(), own.ceramic);
    if !known(&name) {
        return missing("");
    }
    Some(Designation::Known {
        name,
        left_out: own.left_out.join("; "),
        arrangement: own.arrangement,
    })
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
            Some(Designation::Known { name, left_out, .. }) => (name, left_out),
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
    fn angular_contact_bearings_have_their_angle_balls_and_arrangement_in_the_name() {
        for (typed, name, arrangement, left_out) in [
            ("7010C", "7010 C", None, ""),
            ("7010 CD", "7010 C", None, ""),
            ("7010 C DB", "7010 C", Some("DB"), ""),
            ("7010CDB", "7010 C", Some("DB"), ""),
            ("7010CDT", "7010 C", Some("DT"), ""),
            ("SKF 7010 CD/P4ADBA", "7010 C", Some("DB"), "preload A"),
            ("SKF 7010 CD/HCP4ADFB", "7010 C hybrid", Some("DF"), "P4A"),
            ("71910 ACD/HC", "71910 AC hybrid", None, ""),
            ("b7010-c-t-p4s", "7010 C", None, "cage"),
            ("HCB7010-C-T-P4S-DBL", "7010 C hybrid", Some("DB"), "P4S"),
            ("HCB71910-E-T-P4S-UL", "71910 AC hybrid", None, "matched"),
            ("NSK 7010A5TYNDBLP4", "7010 AC", Some("DB"), "precision"),
            ("7910 C SN24 DT", "71910 C hybrid", Some("DT"), ""),
            ("7210 BECBP", "7210 B", None, "arrangement"),
            ("7210-B-XL-TVP", "7210 B", None, "design"),
            ("7210BDF", "7210 B", Some("DF"), ""),
            ("SKF 7010 CD/P4ATBTA", "7010 C", Some("TBT"), "preload A"),
            ("7010 C QBC", "7010 C", Some("QBC"), ""),
        ] {
            match of(typed) {
                Some(Designation::Known {
                    name: own,
                    left_out: words,
                    arrangement: rows,
                }) => {
                    assert_eq!((own.as_str(), rows), (name, arrangement), "{typed}");
                    assert!(words.contains(left_out), "{typed}: {words}");
                    assert_eq!(words.is_empty(), left_out.is_empty(), "{typed}: {words}");
                }
                other => panic!("{typed}: {other:?}"),
            }
        }
    }

    #[test]
    fn an_angular_contact_designation_that_is_incomplete_names_what_has_its_size() {
        for (typed, names) in [
            ("7010", "\"7010 C\", \"7010 AC\", \"SNFA EX 50\""),
            ("HCB7010", "\"7010 C hybrid\", \"7010 AC hybrid\""),
            ("71910 X", "what \"X\" means is not known here"),
            ("7010 C DB DF", "what \"DF\" means is not known here"),
            ("7010 C QXC", "what \"QXC\" means is not known here"),
            ("7010 A", "\"7010 AC\""),
            ("7010 B", "\"7010 AC\""),
            ("7010 E", "what \"E\" means is not known here"),
            ("7205", "\"7205 B\", \"SNFA E 225\""),
            ("7030 C", "\"SNFA EX 150\""),
            ("7310 BECBP", "contact_angle"),
        ] {
            assert!(missing(typed).contains(names), "{}", missing(typed));
        }
        assert!(missing("3205 A").contains("rotor.planes = 4"));
    }

    #[test]
    fn what_is_no_designation_is_left_to_the_near_names() {
        for typed in ["", "my bearing", "6995", "SNFA XE 50", "NU 205", "62055"] {
            assert_eq!(of(typed), None, "{typed}");
        }
    }
}
