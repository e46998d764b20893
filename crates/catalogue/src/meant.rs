//! The bearing that somebody means who types its name or its designation.

use super::designation::{self, Designation};
use super::{Bearing, Catalogue};
use problem::{Code, Problem, Result, did_you_mean};

/// Most names that a message lists.
const MOST_NAMES: usize = 8;

/// A bearing that was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Meant<'a> {
    /// The bearing.
    pub bearing: &'a Bearing,
    /// Whether it has this name; else it was found by its designation.
    pub by_name: bool,
    /// What of the designation is left out, in words; empty for nothing.
    pub left_out: String,
    /// How two of it stand, where the designation says it: DB, DF or DT.
    pub arrangement: Option<&'static str>,
}

impl Meant<'_> {
    /// What of the designation the bearing alone has not: what is left out, and the arrangement.
    pub fn beyond_one(&self) -> String {
        let rows = self.arrangement.map(|own| format!("{own}, arrangement"));
        let left_out = Some(self.left_out.clone()).filter(|words| !words.is_empty());
        let both: Vec<String> = rows.into_iter().chain(left_out).collect();
        both.join("; ")
    }
}

impl Catalogue {
    /// The bearing of this name, or the one that a designation of no name stands for. `place` stands for the file in messages.
    ///
    /// # Errors
    /// Where there is none: which names are near, or what is missing.
    pub fn meant(&self, name: &str, place: &str) -> Result<Meant<'_>> {
        if let Some(bearing) = self.find(name) {
            return Ok(Meant {
                bearing,
                by_name: true,
                left_out: String::new(),
                arrangement: None,
            });
        }
        let found = format!("\"{name}\", which is not in the catalogue");
        let problem = |allowed: String| Problem::new(Code::UnknownBearing, place, found, allowed);
        let known = |name: &str| self.find(name).is_some();
        let own = match designation::read(name, &known) {
            Some(Designation::Known {
                name,
                left_out,
                arrangement,
            }) => Some((name, left_out, arrangement)),
            Some(Designation::Missing(why)) => return Err(problem(why)),
            None => None,
        };
        let meant = own.and_then(|(own, left_out, rows)| Some((self.find(&own)?, left_out, rows)));
        match meant {
            Some((bearing, left_out, arrangement)) => Ok(Meant {
                bearing,
                by_name: false,
                left_out,
                arrangement,
            }),
            None => {
                let names = self.names();
                let near = did_you_mean(name, names.iter().map(String::as_str));
                let listed = names[..names.len().min(MOST_NAMES)].join(", ");
                let count = names.len();
                Err(problem(format!(
                        "one of its {count} bearings is needed ({listed}, …); auxbear bearings list names them"
                    ))
                    .with_hint(near))
            }
        }
    }
}
