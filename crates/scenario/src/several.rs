//! What stands in a file besides sections of the table of keys: several auxiliary bearings, what repeated runs vary, what
//! results must hold.

/// The array of tables that tells several auxiliary bearings apart.
pub const AUXILIARY_BEARING: &str = "auxiliary_bearing";

/// Number of equal rows of an auxiliary bearing.
pub const PLANES: &str = "planes";

/// Sections, and keys, that each of several auxiliary bearings may have of its own; in the head of the file they hold for all.
const OF_EACH_BEARING: [&str; 6] = [
    PLANES,
    "contact",
    "mount",
    "bearing",
    "heat",
    "coast_down.radial_load",
];

/// Whether a key or section may belong to one of several auxiliary bearings.
pub fn of_each_bearing(path: &str) -> bool {
    let under = |path: &str, above: &str| {
        path.strip_prefix(above)
            .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    OF_EACH_BEARING
        .iter()
        .any(|own| under(path, own) || under(own, path))
}

/// A path with the auxiliary bearing that it belongs to before it.
pub fn path_of(bearing: Option<&str>, path: &str) -> String {
    match bearing {
        Some(name) if of_each_bearing(path) => format!("{AUXILIARY_BEARING}.{name}.{path}"),
        _ => path.to_string(),
    }
}

/// The section of values that repeated runs vary.
pub const VARY: &str = "vary";

/// The array of tables of what results must hold.
pub const LIMIT: &str = "limit";
