//! The formats of measurement files.
//!
//! A format is recognised by its content, not by the name of its file.
