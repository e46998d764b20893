//! `auxbear mount`: dynamic stiffness of the mounts of a drop or a machine, and a fit to a measured one.

use crate::arguments::Mount;
use crate::exit::Exit;
use crate::{console, summary};
use auxbear::outcome::Value;
use auxbear::problem::{self, Code, Problem};
use auxbear::report::directory::NewDirectory;
use auxbear::run::mount::{self, Request, fit::MeasuredStiffness};
use auxbear::units::parse_quantity;

/// Computes it and writes a run directory.
pub fn perform(wish: &Mount) -> problem::Result<Exit> {
    let scenario = wish.given.read()?;
    let metres = parse_quantity(&wish.amplitude)
        .ok()
        .filter(|own| own.dimension.si_unit() == "m" && own.value_si > 0.0);
    let Some(metres) = metres else {
        let found = format!("\"{}\"", wish.amplitude);
        let needed = "a length above 0 is needed, e.g. \"20 um\"";
        let problem = Problem::new(Code::OutOfRange, "auxbear mount", found, needed);
        return Err(problem.on_key("--amplitude"));
    };
    let read = |path: &std::path::PathBuf| {
        let text = problem::read_text(path, "a table of stiffness over frequency")?;
        MeasuredStiffness::parse(&text, &path.display().to_string())
    };
    let request = Request {
        amplitude: metres.value_si,
        table: wish.fit.as_ref().map(read).transpose()?,
    };
    let outcome = mount::run(&scenario, &request).map_err(|own| scenario.locate(own))?;
    let path = wish.output.place(&wish.given.name());
    NewDirectory::reserve(&path)?.finish(&scenario, &outcome)?;
    if !wish.output.quiet {
        console::print(&summary::text(&path, &outcome))?;
    }
    let mut all = outcome.quantities.iter();
    let lines = all.find(|own| own.words_in("fit_lines").is_some());
    if let Some(Value::Text(lines)) = lines.map(|own| &own.value) {
        console::print(&format!("[mount]\n{lines}\n"))?;
    }
    console::warn(&outcome.warnings);
    Ok(Exit::Done)
}
