//! Typed values taken out of the resolved ones, section by section.

use crate::values::Values;
use problem::words::Words;

/// Takes typed values out of the resolved ones.
pub struct Section<'a> {
    pub(crate) values: &'a Values,
    pub(crate) path: &'static str,
}

impl Values {
    /// The values of a section.
    pub(crate) fn section(&self, path: &'static str) -> Section<'_> {
        Section { values: self, path }
    }
}

impl Section<'_> {
    fn path(&self, name: &str) -> String {
        format!("{}.{name}", self.path)
    }

    pub(crate) fn maybe(&self, name: &str) -> Option<f64> {
        self.values.number(&self.path(name))
    }

    /// A number that is needed; where there is none the scenario is refused for it, see [`Values::complete`].
    pub fn number(&self, name: &str) -> f64 {
        let value = self.maybe(name);
        value.unwrap_or_else(|| self.values.lack(&self.path(name), 0.0))
    }

    /// A word that is needed; likewise.
    pub fn choice<T: Words>(&self, name: &str) -> T {
        let value = self.chosen(name);
        value.unwrap_or_else(|| self.values.lack(&self.path(name), T::ALL[0]))
    }

    /// A word, where there is one.
    pub fn chosen<T: Words>(&self, name: &str) -> Option<T> {
        self.values.chosen(&self.path(name))
    }

    pub(crate) fn switch(&self, name: &str) -> bool {
        self.values.switch(&self.path(name))
    }

    /// The rows of a table; none where it is not given.
    pub fn rows(&self, name: &str) -> Option<Vec<[f64; 2]>> {
        self.values.rows(&self.path(name))
    }

    pub(crate) fn count(&self, name: &str) -> u64 {
        self.values.count(&self.path(name))
    }
}
