//! Printing that outlives its reader: a closed pipe ends the output, not the program.

use auxbear::outcome::Warning;
use auxbear::problem::Result;
use auxbear::report::directory::failed;
use std::io::{ErrorKind, Write, stderr, stdout};
use std::path::Path;

/// Prints results. A problem where they cannot be written, as on a full disk.
pub fn print(text: &str) -> Result<()> {
    let mut out = stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        // The reader may have left, as `head` does; there is nobody to tell.
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(failed(Path::new("standard output"), &error))
        }
        _ => Ok(()),
    }
}

/// Prints a problem or the progress on a line of its own beside the results.
pub fn report(line: &str) {
    let _ = writeln!(stderr().lock(), "{line}");
}

/// Tells warnings, one a line; nothing silences them.
pub fn warn(warnings: &[Warning]) {
    for warning in warnings {
        report(&format!("warning[{}]: {warning}", warning.code));
    }
}

/// A table: columns aligned but for the last, two spaces between them, no space at the end of a line.
pub fn table<R: AsRef<[String]>>(rows: &[R]) -> String {
    let rows = || rows.iter().map(AsRef::as_ref);
    let columns = rows().map(<[String]>::len).max().unwrap_or(0);
    let cells = |column: usize| rows().filter_map(move |row| row.get(column));
    let width = |column: usize| cells(column).map(|cell| cell.chars().count()).max();
    let widths: Vec<usize> = (0..columns)
        .map(|column| width(column).unwrap_or(0))
        .collect();
    let mut text = String::new();
    for row in rows() {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(&widths) {
            line.push_str(&format!("{cell:width$}  "));
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned_by_letters() {
        let row = |a: &str, b: &str| [a.to_string(), b.to_string()];
        let rows = [row("µm", "x"), row("metre", ""), row("", "y")];
        assert_eq!(table(&rows), "µm     x\nmetre\n       y\n");
    }
}
