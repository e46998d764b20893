//! `auxbear new`.

use crate::console;
use auxbear::problem::{Code, Problem, Result, did_you_mean};
use auxbear::report::directory::{failed, misplaced};
use auxbear::scenario::{KINDS, template};
use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::path::Path;

/// Kinds of files that the command will know, so that asking for one is no spelling mistake.
const PLANNED: [&str; 2] = ["qualify", "mount"];

/// Prints or writes the starting file of a kind.
pub fn perform(kind: &str, path: Option<&Path>) -> Result<()> {
    let text = template(kind).ok_or_else(|| unknown("auxbear new", kind, KINDS))?;
    // A dash stands for the standard output.
    let Some(path) = path.filter(|path| *path != Path::new("-")) else {
        return console::print(&text);
    };
    write_new(path, &text)
}

/// Writes a file where none of its name is.
pub fn write_new(path: &Path, text: &str) -> Result<()> {
    let mut file = File::create_new(path).map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => Problem::at_path(
            Code::OutputExists,
            path,
            "something of this name",
            "a file is never written over another: choose another path",
        ),
        _ => misplaced(path, &error),
    })?;
    file.write_all(text.as_bytes()).map_err(|error| {
        let _ = fs::remove_file(path);
        failed(path, &error)
    })
}

/// What is wrong with a kind of file that a command does not have; it has these.
pub fn unknown(command: &str, kind: &str, kinds: &[&str]) -> Box<Problem> {
    let needed = format!("a kind is needed: {}", kinds.join(", "));
    if PLANNED.contains(&kind) {
        let found = format!("\"{kind}\", which is planned but not built yet");
        Problem::new(Code::NotBuilt, command, found, needed)
    } else {
        Problem::new(Code::UnknownWord, command, format!("\"{kind}\""), needed)
            .with_hint(did_you_mean(kind, kinds.iter().copied()))
    }
}
