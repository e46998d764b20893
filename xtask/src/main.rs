//! `cargo xtask`: what the repository demands of every change, in one command.

#![forbid(unsafe_code)]

mod advisories;
mod architecture;
mod bench;
mod book;
mod check;
mod coverage;
mod docs;
mod documentation;
mod golden;
mod licences;
mod pages;
mod python;
mod repository;
mod result_names;
mod scenarios;
mod shipped;
mod snapshots;
mod source_text;
mod suites;
mod toolchain;

use std::process::ExitCode;

const HELP: &str = "\
cargo xtask check           all guards, then all tests; exit status 1 on any finding
cargo xtask check --fast    the guards that build nothing of the product
cargo xtask bench           drops, flexible rotors and a bearing, beside others where there are some, in CPU time (benchmarks/README.md); minutes
cargo xtask bench PROGRAM   the same with a command that is built already
cargo xtask bench --against COMMIT
                            this tree beside a commit, built beside it, in turns; minutes (benchmarks/README.md)
cargo xtask docs            writes the book's page of validation from auxbear validate
cargo xtask docs PROGRAM    the same with a command that is built already
cargo xtask advisories PATH writes what of the RustSec database in a folder is about packages in Cargo.lock, advisories.toml
cargo xtask golden          runs all scenarios; writes golden values, xtask/golden.json, and snapshots to the bit, xtask/snapshots; minutes
cargo xtask coverage        writes what the bands of signals and identify hold, book/src/coverage.md; hours
cargo xtask coverage NAME   the same of one test binary; the rest of the page stays
cargo xtask help            this text
";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["check"] => check::run(check::Extent::Full),
        ["check", "--fast"] => check::run(check::Extent::Fast),
        ["bench"] => bench::run(None),
        ["bench", "--against", commit] => bench::against::run(commit),
        ["bench", program] => bench::run(Some(program)),
        ["docs"] => docs::run(None),
        ["docs", program] => docs::run(Some(program)),
        ["advisories", database] => advisories::write(database),
        ["golden"] => snapshots::write(),
        ["coverage"] => coverage::run(None),
        ["coverage", name] => coverage::run(Some(name)),
        ["help" | "--help" | "-h"] => {
            print!("{HELP}");
            Ok(())
        }
        _ => {
            eprint!("not understood: {}\n{HELP}", words.join(" "));
            return ExitCode::from(2);
        }
    };
    if let Err(error) = &done {
        eprintln!("{error}");
    }
    ExitCode::from(u8::from(done.is_err()))
}
