//! `auxbear schema`.

use crate::console;
use crate::start::unknown;
use auxbear::problem::Problem;
use auxbear::scenario::schema;

/// Prints the JSON Schema of the files of a kind.
pub fn perform(kind: &str) -> Result<(), Box<Problem>> {
    let text = schema(kind).ok_or_else(|| unknown("auxbear schema", kind))?;
    console::print(&text)
}
