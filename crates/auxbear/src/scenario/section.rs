//! Typed values taken out of the resolved ones, section by section.

use crate::scenario::values::Values;

/// Takes typed values out of the resolved ones.
pub(crate) struct Section<'a> {
    pub(crate) values: &'a Values,
    pub(crate) path: &'static str,
}

impl Section<'_> {
    fn path(&self, name: &str) -> String {
        format!("{}.{name}", self.path)
    }

    pub(crate) fn maybe(&self, name: &str) -> Option<f64> {
        self.values.number(&self.path(name))
    }

    /// A number that the table of keys guarantees; not-a-number would show a gap in that table, which the tests exclude.
    pub(crate) fn number(&self, name: &str) -> f64 {
        let value = self.maybe(name);
        debug_assert!(value.is_some(), "{} has no value", self.path(name));
        value.unwrap_or(f64::NAN)
    }

    pub(crate) fn word(&self, name: &str) -> &'static str {
        self.values.word(&self.path(name))
    }

    pub(crate) fn switch(&self, name: &str) -> bool {
        self.values.switch(&self.path(name))
    }

    /// The rows of a table; none where it is not given.
    pub(crate) fn rows(&self, name: &str) -> Option<Vec<[f64; 2]>> {
        self.values.rows(&self.path(name))
    }

    pub(crate) fn count(&self, name: &str) -> u64 {
        self.values.count(&self.path(name))
    }
}
