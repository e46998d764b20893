//! A bearing while its file is read.

use super::bearing::Bearing;
use problem::Result;
use std::collections::BTreeMap;

pub(super) type Read<T> = Result<T>;

/// A file while it is read.
pub(super) struct Reader<'a> {
    pub(super) text: &'a str,
    pub(super) file: &'a str,
    pub(super) built_in: bool,
    pub(super) sources: BTreeMap<String, String>,
}

/// A bearing while it is read: its values, and where each stands in the file.
pub(super) struct Draft {
    pub(super) bearing: Bearing,
    pub(super) start: usize,
    pub(super) starts: Vec<(&'static str, usize)>,
}
