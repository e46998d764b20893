//! `auxbear schema`.

use crate::console;
use crate::start::unknown;
use auxbear::problem::Result;
use auxbear::report::schema::{SUMMARY, schema};
use auxbear::scenario::KINDS;

/// Prints the JSON Schema of the files of a kind.
pub fn perform(kind: &str) -> Result<()> {
    let text = schema(kind).ok_or_else(|| {
        let kinds = [KINDS, &[SUMMARY]].concat();
        unknown("auxbear schema", kind, &kinds)
    })?;
    console::print(&text)
}
