//! Where in the file a problem stands that is found after reading, when the machine is built.

use crate::document::Document;
use crate::resolved::Resolved;
use crate::rotor::tables;
use problem::{Code, Place, Problem};

/// What a problem names as its file until the scenario is known in which it stands.
pub const UNNAMED: &str = "the scenario";

/// A problem with a key of a scenario that is known later: [`Scenario::locate`](crate::Scenario::locate) adds file and line.
pub fn problem_at(
    code: Code,
    key: impl Into<String>,
    found: impl Into<String>,
    allowed: impl Into<String>,
) -> Box<Problem> {
    Problem::new(code, UNNAMED, found, allowed).on_key(key)
}

impl Document {
    /// The problem with the file and the line of its key: where the key stands, else where the section begins.
    pub(crate) fn locate(&self, resolved: &Resolved, mut problem: Box<Problem>) -> Box<Problem> {
        // what names a file already is wrong in that one
        if problem.file != UNNAMED {
            return problem;
        }
        problem.file.clone_from(&self.file);
        if let Some(key) = &problem.key
            && problem.place == Place::Whole
        {
            problem.place = self.place_of(resolved, key);
        }
        problem
    }

    fn place_of(&self, resolved: &Resolved, key: &str) -> Place {
        let given = |place: &Place| *place != Place::Whole;
        let mut of_key = resolved.values.iter().filter(|value| value.shown() == key);
        if let Some(place) = of_key.next().map(|value| value.place).filter(given) {
            return place;
        }
        if let Some(place) = tables::place(&self.parts, key) {
            return place;
        }
        // of a section, what an override changed is the nearest cause
        let inside = format!("{key}.");
        let mut values = resolved.values.iter();
        if values.any(|value| value.shown().starts_with(&inside) && value.place == Place::Set) {
            return Place::Set;
        }
        let sections = std::iter::successors(Some(key), |path| {
            path.rsplit_once('.').map(|(section, _)| section)
        });
        let mut places = sections.filter_map(|section| self.sections.get(section));
        places.next().copied().unwrap_or_default()
    }
}
