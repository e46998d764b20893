//! What checks between values share: each refuses what no simulation could mean.

use crate::run::Run;
use crate::values::Values;
use problem::{Code, Place, Problem, Result};

/// Most values of a history, in memory at the end of a run: 1.6 GB.
const MOST_VALUES: f64 = 2e8;
/// Values of a row that do not depend on the balls, kept twice: as states and as columns.
const VALUES_PER_ROW: f64 = 100.0;
/// Values of a row for each ball, likewise.
const VALUES_PER_BALL: f64 = 20.0;

pub(crate) type Check = Result<()>;

/// What every check needs to tell a problem.
pub struct Context<'a> {
    pub(crate) values: &'a Values,
    pub(crate) file: &'a str,
}

impl Context<'_> {
    pub(crate) fn problem(
        &self,
        code: Code,
        path: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Box<Problem> {
        Problem::new(code, self.file, found, allowed)
            .at(self.values.place(path))
            .on_key(self.values.shown(path))
    }

    /// Refuses the value of a key.
    pub(crate) fn refuse(
        &self,
        code: Code,
        path: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Check {
        Err(self.problem(code, path, found, allowed))
    }

    /// Refuses the value of a key as it is written.
    pub(crate) fn refuse_value(&self, code: Code, path: &str, allowed: impl Into<String>) -> Check {
        self.refuse(code, path, self.text(path), allowed)
    }

    /// The value as the file or catalogue writes it.
    pub fn text(&self, path: &str) -> String {
        self.values.text(path).unwrap_or_default()
    }

    /// The key that is most probably wrong: the first of an override, else the first of the file, else the first.
    pub fn blamed<'p>(&self, paths: &[&'p str]) -> &'p str {
        let places = |wanted: fn(Place) -> bool| {
            let mut paths = paths.iter().copied();
            paths.find(|path| wanted(self.values.place(path)))
        };
        places(|place| place == Place::Set)
            .or_else(|| places(|place| place != Place::Whole))
            .unwrap_or(paths[0])
    }

    pub(crate) fn output(&self, run: &Run, balls: usize) -> Check {
        const INTERVAL: &str = "run.output_interval";
        const DURATION: &str = "run.duration";
        let path = self.blamed(&[INTERVAL, DURATION]);
        let (interval, duration) = (self.text(INTERVAL), self.text(DURATION));
        if run.output_interval > run.duration {
            let allowed = match path {
                DURATION => format!("at least {INTERVAL} = {interval} is needed"),
                _ => format!("at most {DURATION} = {duration} is needed"),
            };
            return self.refuse_value(Code::OutputInterval, path, allowed);
        }
        let rows = run.duration / run.output_interval;
        let most = MOST_VALUES / (VALUES_PER_ROW + VALUES_PER_BALL * balls as f64);
        if rows <= most {
            return Ok(());
        }
        let found = match path {
            DURATION => {
                format!("{duration}, which gives {rows:.3e} rows at {INTERVAL} = {interval}")
            }
            _ => format!("{interval}, which gives {rows:.3e} rows in {duration}"),
        };
        self.refuse(
            Code::TooManyRows,
            path,
            found,
            format!("at most {most:.2e} rows are kept with {balls} balls"),
        )
    }
}
