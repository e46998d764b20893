//! Files of input: opened and read with one message for each way in which that fails. Nothing else that computes asks for a file; without the
//! feature `files` there are none.

use crate::{Code, Place, Problem, Result};
#[cfg(feature = "files")]
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

/// Largest text read, bytes.
const LARGEST_TEXT: u64 = 10_000_000;

/// Opens a file of bytes for reading.
///
/// # Errors
/// A pipe, a socket or a device: to open or to read it may wait, or never end.
#[cfg(feature = "files")]
pub fn open_file(path: &Path) -> io::Result<File> {
    let kind = fs::metadata(path)?;
    if !kind.is_file() && !kind.is_dir() {
        let found = "a pipe, a socket or a device, not a file";
        return Err(io::Error::new(ErrorKind::InvalidInput, found));
    }
    File::open(path)
}

/// Opens no file.
///
/// # Errors
/// Always.
#[cfg(not(feature = "files"))]
pub fn open_file(_path: &Path) -> io::Result<io::Empty> {
    Err(io::Error::new(
        ErrorKind::Unsupported,
        "this build reads no files",
    ))
}

/// The path as it is found from any folder; as it is where there is no such file.
pub fn lasting(path: PathBuf) -> PathBuf {
    #[cfg(feature = "files")]
    return fs::canonicalize(&path).unwrap_or(path);
    #[cfg(not(feature = "files"))]
    path
}

/// Reads a text of at most 10 MB; `what` names it in messages, such as "a scenario file".
///
/// # Errors
/// No file, a folder, a file that is too large, cannot be read or is not UTF-8.
pub fn read_text(path: &Path, what: &str) -> Result<String> {
    let problem = |code, found: &str| {
        let needed = format!("the path of {what} is needed");
        Problem::at_path(code, path, found, needed)
    };
    let unreadable = |error: io::Error| match error.kind() {
        ErrorKind::NotFound => problem(Code::FileMissing, "no file of this name"),
        ErrorKind::IsADirectory => problem(Code::FileIsFolder, "a folder"),
        _ => problem(
            Code::FileUnreadable,
            &format!("a file that cannot be read ({error})"),
        ),
    };
    // the size of the metadata is that of a file alone
    let mut bytes = Vec::new();
    let file = open_file(path).map_err(unreadable)?;
    file.take(LARGEST_TEXT + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_TEXT {
        let needed = format!("{what} of at most 10 MB is needed");
        let found = "more than 10 MB";
        return Err(Problem::at_path(Code::FileTooLarge, path, found, needed));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(&error.as_bytes()[..valid]).into_owned();
        let found = "bytes that are not UTF-8 text";
        let needed = "a text file in UTF-8 is needed";
        let problem = Problem::at_path(Code::FileNotUtf8, path, found, needed);
        problem.at(Place::of_offset(&text, valid))
    })
}
