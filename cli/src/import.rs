//! `auxbear import`.

use crate::arguments::Import;
use crate::console;
use crate::start::write_new;
use auxbear::import::{Compared, import};
use auxbear::problem::Result;

/// Writes the scenario of a rotor of another program, and tells what was not understood.
pub fn perform(wish: &Import) -> Result<()> {
    let imported = import(&wish.file)?;
    match &wish.out {
        None => console::print(&imported.toml)?,
        Some(path) => write_new(path, &imported.toml)?,
    }
    // The text may go into a pipe: what is told of it goes beside it.
    console::report(&format!("read: a {}", imported.kind));
    for note in &imported.notes {
        console::report(&format!("not taken as it stands: {note}"));
    }
    for compared in &imported.eigenvalues {
        console::report(&eigenvalues(compared));
    }
    Ok(())
}

fn eigenvalues(compared: &Compared) -> String {
    let whose = match compared.stated {
        true => "the file states",
        false => "the rotor as read has",
    };
    let before: Vec<String> = (compared.before.iter())
        .map(|z| format!("{:.4}{:+.4}j", z.re, z.im))
        .collect();
    format!(
        "eigenvalues at {} rad/s: {whose} {} 1/s; those of what was written differ by {:.1e} at most",
        compared.speed,
        before.join(", "),
        compared.deviation()
    )
}
