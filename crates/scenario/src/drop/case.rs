//! Cases of a machine, one of which happens in a run: those that events and the base name.

use crate::key::quoted;
use crate::rotor::keys::EVENT;
use crate::rotor::tables::Part;
use crate::values::Values;
use problem::{Code, Result, did_you_mean};

/// Key of the case that happens.
pub const CASE: &str = "run.case";
/// Key of the case in which the base moves.
pub(super) const OF_BASE: &str = "base.case";

const NAMED: &str = "the name of a case is needed";

/// The cases that a file names, and which of them happens.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cases {
    /// In the order of the file, that of the base the last.
    pub names: Vec<String>,
    chosen: usize,
}

impl Cases {
    /// Those of a file; the first happens unless it says another.
    ///
    /// # Errors
    /// A case that nothing names.
    pub(super) fn of(parts: &[Part], values: &Values) -> Result<Cases> {
        let events = || parts.iter().filter(|part| part.kind.word == EVENT);
        let blank = |name: &str| name.trim().is_empty();
        if let Some(part) = events().find(|part| part.text("case").is_some_and(blank)) {
            return part.refuse(Code::UnknownWord, "case", "a name without letters", NAMED);
        }
        if values.text(OF_BASE).is_some_and(|name| blank(&name)) {
            return values.refuse(Code::UnknownWord, OF_BASE, "a name without letters", NAMED);
        }
        let of_events = events().filter_map(|part| part.text("case").map(str::to_string));
        let mut names: Vec<String> = Vec::new();
        for name in of_events.chain(values.text(OF_BASE)) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let asked = values.text(CASE);
        let at = match &asked {
            None => Some(0),
            Some(asked) => names.iter().position(|name| name == asked),
        };
        let Some(chosen) = at else {
            let asked = asked.unwrap_or_default();
            let allowed = match names.as_slice() {
                [] => "a case that [[event]] or [base] names is needed; none does".to_string(),
                names => format!("one of the cases {} is needed", names.join(", ")),
            };
            let place = values.place(CASE);
            let problem = values.problem(Code::UnknownWord, CASE, place, quoted(&asked), allowed);
            return Err(problem.with_hint(did_you_mean(&asked, names.iter().map(String::as_str))));
        };
        Ok(Cases { names, chosen })
    }
    /// The one that happens; none where there are none.
    pub fn chosen(&self) -> Option<&str> {
        self.names.get(self.chosen).map(String::as_str)
    }
    /// Those that do not happen.
    pub fn others(&self) -> impl Iterator<Item = &str> {
        let names = self.names.iter().enumerate();
        let others = names.filter(|(k, _)| *k != self.chosen);
        others.map(|(_, name)| name.as_str())
    }
    /// Whether something happens that names this case; what names none happens in all.
    pub fn happens(&self, case: Option<&str>) -> bool {
        case.is_none() || case == self.chosen()
    }
}
