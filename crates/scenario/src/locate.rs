//! Where in the file a problem stands that is found after reading, when the machine is built.

use crate::resolved::Resolved;
use problem::{Place, Problem};
use std::collections::BTreeMap;

/// What a problem names as its file until the scenario is known in which it stands.
pub const UNNAMED: &str = "the scenario";

/// The text of a scenario, as far as messages name it.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The file, as the user named it.
    pub name: String,
    /// Where its sections start.
    pub sections: BTreeMap<String, Place>,
}

impl Text {
    /// The problem with the file and the line of its key: where the key stands, else where the section begins.
    pub fn locate(&self, resolved: &Resolved, mut problem: Box<Problem>) -> Box<Problem> {
        // what names a file already is wrong in that one
        if problem.file != UNNAMED {
            return problem;
        }
        problem.file.clone_from(&self.name);
        if let Some(key) = &problem.key
            && problem.place == Place::Whole
        {
            problem.place = self.place_of(resolved, key);
        }
        problem
    }

    fn place_of(&self, resolved: &Resolved, key: &str) -> Place {
        let given = |place: &Place| *place != Place::Whole;
        if let Some(place) = resolved.get(key).map(|value| value.place).filter(given) {
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
