//! The signals files of the tests, and their channels.

use crate::signals;
use problem::{Code, Result};
use scenario::{Identify, Signals, problem_at};
use std::path::Path;
use std::sync::Arc;

/// One test as its signals file describes it, its channels read.
pub struct Test {
    /// Name for people: that of the file, or of its folder where the file is called signals.toml.
    pub name: String,
    /// Weight on the bearing, N.
    pub load: Option<f64>,
    /// What is asked of the channels.
    pub signals: Signals,
    /// The channels.
    pub asked: Arc<signals::Request>,
}

/// Tests whose channels were read, and what is asked of them.
pub struct Request<'a> {
    /// What is asked.
    pub identify: &'a Identify,
    /// Slow tests.
    pub coast_downs: Vec<Test>,
    /// Tests with acceleration.
    pub tests: Vec<Test>,
    /// The spin-up of a drop.
    pub rotor: Option<Test>,
}

impl Request<'_> {
    /// Reads all files; refuses what is not there or not what it should be.
    pub fn of(identify: &Identify) -> Result<Request<'_>> {
        let list = |key: &'static str, paths: &[std::path::PathBuf]| {
            let read = |path: &std::path::PathBuf| test(key, path, identify, true);
            paths.iter().map(read).collect::<Result<Vec<_>, _>>()
        };
        Ok(Request {
            coast_downs: list("identify.coast_down", &identify.coast_downs)?,
            tests: list("identify.tests", &identify.tests)?,
            rotor: match &identify.rotor_friction {
                Some(rotor) => {
                    let key = "identify.rotor_friction.file";
                    Some(test(key, &rotor.file, identify, false)?)
                }
                None => None,
            },
            identify,
        })
    }
}

fn test(key: &'static str, path: &Path, identify: &Identify, with_torque: bool) -> Result<Test> {
    let refuse = |code, found: String, needed: &str| {
        problem_at(code, key, format!("{}, {found}", path.display()), needed)
    };
    let (scenario, signals) = signals::request::signals_file(key, path)?;
    let coasts = key == "identify.coast_down"
        && (signals.steady.as_ref()).is_some_and(|steady| steady.inertia.is_some());
    if signals.speed.is_none() || (with_torque && signals.torque.is_none() && !coasts) {
        let lacks = match signals.speed {
            None => "[signals.speed]",
            Some(_) => "[signals.torque]",
        };
        return Err(refuse(
            Code::MissingKey,
            format!("which has no {lacks}"),
            match key {
                "identify.coast_down" => {
                    "speed and torque of each test are needed; of a coast-down without torque sensor the speed, and signals.steady.from, to and inertia"
                }
                _ => "speed and torque of each test are needed",
            },
        ));
    }
    if let Some(cage) = &signals.cage
        && cage.ball_count != identify.ball_count
    {
        return Err(refuse(
            Code::Conflict,
            format!(
                "whose cage signal is read with {} balls, where the bearing has {}",
                cage.ball_count, identify.ball_count
            ),
            "the number of balls of the bearing is needed: signals.cage.ball_count or bearing.ball_count is wrong",
        ));
    }
    let load = signals.radial_load.or(identify.radial_load);
    if load.is_none() && with_torque {
        return Err(refuse(
            Code::MissingKey,
            "which gives no signals.radial_load".to_string(),
            "the weight on the bearing is needed, in each signals file or as identify.radial_load, e.g. \"60 N\"",
        ));
    }
    let asked = signals::Request::of(&signals).map_err(|problem| scenario.locate(problem))?;
    Ok(Test {
        name: name(path),
        load,
        signals,
        asked: Arc::new(asked),
    })
}

/// Name of a test by its file.
fn name(path: &Path) -> String {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy());
    let stem = stem.map_or_else(|| "test".to_string(), |stem| stem.into_owned());
    let folder = path.parent().and_then(Path::file_name);
    match folder {
        Some(folder) if stem == "signals" => folder.to_string_lossy().into_owned(),
        _ => stem,
    }
}
