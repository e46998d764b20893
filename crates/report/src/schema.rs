//! JSON Schemas of the files that are read and written.

use scenario;

/// The kind of a run directory's `summary.json`.
pub const SUMMARY: &str = "summary";

/// The JSON Schema (draft 2020-12) of the files of a kind: of a system, a study, or [`SUMMARY`]; `None` for any other.
pub fn schema(kind: &str) -> Option<String> {
    match kind {
        SUMMARY => Some(include_str!("summary_schema.json").to_string()),
        _ => scenario::schema(kind),
    }
}
