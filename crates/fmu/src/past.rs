//! A state as bytes: what an instance did since its start, from which any instance of the same unit comes to the same bits again.
//!
//! It does not depend on the layout of the library's memory, and costs its reader the computing time of the run until then.

use crate::instance::Past;

/// Bytes of a state of the unit with that guid.
pub(crate) fn written(guid: &str, past: &Past) -> Vec<u8> {
    // numbers are finite, and keys texts or numbers
    serde_json::to_vec(&(guid, past)).unwrap_or_default()
}

/// The state in bytes; none where they are not of this unit.
pub(crate) fn read(guid: &str, bytes: &[u8]) -> Option<Past> {
    let (own, past): (String, Past) = serde_json::from_slice(bytes).ok()?;
    (own == guid).then_some(past)
}
