//! What each address of the studio gives.

use crate::check::{check, of_problem};
use crate::edit::{AddedHeader, Edited, Step};
use crate::folder::MOST_BYTES;
use crate::jobs::Task;
use crate::server::{Call, Reply};
use crate::{Studio, edit, keys, runs};
use auxbear::report::directory::RUNS;
use auxbear::report::{directory, export, page};
use auxbear::scenario::several::AUXILIARY_BEARING;
use auxbear::{BuiltIn, Options, Scenario, bearings};
use serde_json::{Value, json};
use std::fs;
use std::sync::atomic::AtomicBool;

const PAGE: &str = include_str!("page/index.html");
const STYLE: &str = include_str!("page/studio.css");
const SCRIPTS: [&str; 8] = [
    include_str!("page/base.js"),
    include_str!("page/text.js"),
    include_str!("page/forms.js"),
    include_str!("page/drawing.js"),
    include_str!("page/motion.js"),
    include_str!("page/edit.js"),
    include_str!("page/runs.js"),
    include_str!("page/start.js"),
];
/// What hands the drawings of a run's page to the studio.
const FIGURES: &str = include_str!("page/figures.js");
/// What a page of a run adds in the studio: an input that is clicked is named to the studio around it.
const NAMED: &str = include_str!("page/named.js");
/// Where the arrangement of the studio is kept.
const LAYOUT: &str = ".auxbear-studio.json";

const SCRIPT: &str = "text/javascript; charset=utf-8";

/// Values of an analysis that is shown while its file is edited: the closed loop needs no fine diagrams.
const QUICK: [(&str, &str); 3] = [
    ("analysis.speed_count", "11"),
    ("analysis.map_count", "2"),
    ("analysis.modes", "2"),
];

type Answer = Result<Reply, (u16, String)>;

/// Answers a request that may ask.
pub(crate) fn route(studio: &Studio, asked: &Call) -> Reply {
    let answered = match asked.changes {
        true => change(studio, asked),
        false => give(studio, asked),
    };
    answered.unwrap_or_else(|(status, why)| Reply::refused(status, &why))
}

fn wrong(why: impl Into<String>) -> (u16, String) {
    (400, why.into())
}

fn give(studio: &Studio, asked: &Call) -> Answer {
    let folder = &studio.folder;
    let needed = |name: &str| {
        asked
            .get(name)
            .ok_or_else(|| wrong(format!("{name} is needed")))
    };
    Ok(match asked.path {
        "/" => Reply::own("text/html; charset=utf-8", PAGE),
        "/studio.css" => Reply::own("text/css; charset=utf-8", STYLE),
        "/studio.js" => Reply::own(
            SCRIPT,
            format!("\"use strict\";\n(() => {{\n{}}})();\n", SCRIPTS.concat()),
        ),
        "/figures.js" => Reply::own(SCRIPT, page::script(FIGURES)),
        "/favicon.ico" => Reply::own("image/svg+xml", include_str!("page/icon.svg")),
        "/api/state" => Reply::json(&json!({
            "folder": folder.root().display().to_string(),
            "version": env!("CARGO_PKG_VERSION"),
            "kinds": auxbear::scenario::KINDS,
            "files": folder.files(),
            "jobs": studio.jobs.all(),
        })),
        "/api/keys" => {
            Reply::json(&keys::of_kind(needed("kind")?).ok_or_else(|| wrong("no such kind"))?)
        }
        "/api/file" => {
            let (text, hash) = folder.read(needed("name")?).map_err(|why| (404, why))?;
            Reply::json(&json!({ "text": text, "hash": hash }))
        }
        "/api/live" => {
            let number = |name: &str| {
                asked
                    .get(name)
                    .and_then(|text| text.parse().ok())
                    .unwrap_or(0)
            };
            let live = studio
                .jobs
                .live(number("id"), number("round"), number("from"));
            Reply::json(&live.ok_or((404, "no such run".to_string()))?)
        }
        "/api/runs" => Reply::json(&studio.runs.table(folder)),
        "/api/bearings" => Reply::json(&catalogue()),
        "/api/layout" => {
            let text = folder.own(LAYOUT).ok();
            let text = text.and_then(|path| fs::read_to_string(path).ok());
            let text = text.unwrap_or_default();
            Reply::json(&serde_json::from_str(&text).unwrap_or_else(|_| json!({})))
        }
        "/api/motion" => {
            let path = folder.path(needed("run")?).map_err(|why| (404, why))?;
            let run = directory::read(&path).map_err(|problem| wrong(problem.to_string()))?;
            Reply::json(&crate::motion::motion(&run).unwrap_or_else(|| json!({ "none": true })))
        }
        "/page/compare" => {
            let names: Vec<String> = asked.all("run").map(str::to_string).collect();
            Reply::page(runs::compared(folder, &names).map_err(|why| (404, why))?)
        }
        "/page/run" => {
            let file = asked.get("file").unwrap_or("report.html");
            let html = fs::read_to_string(inside(studio, needed("run")?, file)?);
            let html = html.map_err(|error| (404, format!("{file}: {error}")))?;
            let script = format!("<script>\n{NAMED}</script>\n</body>");
            let html = match html.rsplit_once("</body>") {
                Some((before, after)) => format!("{before}{script}{after}"),
                None => html + &script,
            };
            Reply::page(html)
        }
        "/file" => {
            let (run, file) = (needed("run")?, needed("file")?);
            let path = inside(studio, run, file)?;
            if file == "run.xlsx" && !path.exists() {
                let run = folder.path(run).map_err(|why| (404, why))?;
                export::export(&run, export::Format::Xlsx, None, &[])
                    .map_err(|problem| wrong(problem.to_string()))?;
            }
            let body = fs::read(&path).map_err(|error| (404, format!("{file}: {error}")))?;
            let name = format!("{}-{file}", run.rsplit('/').next().unwrap_or(run));
            Reply::download(&name, body)
        }
        _ => return Err((404, "nothing has this address".to_string())),
    })
}

/// A file of a run directory.
fn inside(studio: &Studio, run: &str, file: &str) -> Result<std::path::PathBuf, (u16, String)> {
    studio
        .folder
        .path(&format!("{run}/{file}"))
        .map_err(|why| (404, why))
}

fn change(studio: &Studio, asked: &Call) -> Answer {
    let folder = &studio.folder;
    let (name, text) = (asked.text("name"), asked.text("text"));
    if text.len() as u64 > MOST_BYTES {
        return Err(wrong("a text of this size is no input file"));
    }
    let path = || folder.path(name).map_err(wrong);
    Ok(match asked.path {
        "/api/check" => Reply::json(&check(text, &path()?)),
        "/api/build" => Reply::json(&built(studio, text, &path()?)),
        "/api/analysis" => Reply::json(&analysed(studio, text, &path()?)),
        "/api/save" => match folder
            .save(name, text, asked.body["hash"].as_str())
            .map_err(wrong)?
        {
            Ok(hash) => Reply::json(&json!({ "hash": hash })),
            Err(theirs) => {
                let hash = crate::folder::hash(&theirs);
                Reply::json(&json!({ "theirs": theirs, "hash": hash }))
            }
        },
        "/api/new" => Reply::json(&new(studio, asked)?),
        "/api/set" => {
            let steps = steps(asked)?;
            let literal = keys::literal(asked.text("kind"), &key_of(&steps), asked.text("value"));
            edited(text, edit::set(text, &steps, &literal))?
        }
        "/api/unset" => {
            let made: Vec<AddedHeader> =
                serde_json::from_value(asked.body["made"].clone()).unwrap_or_default();
            let rest = edit::unset(text, &steps(asked)?, &made);
            edited(text, rest.map(|text| Edited { text, made: None }))?
        }
        "/api/add" => {
            let keys: Vec<(String, String)> =
                serde_json::from_value(asked.body["keys"].clone()).unwrap_or_default();
            let steps = steps(asked)?;
            let of = key_of(&steps);
            let keys: Vec<(String, String)> = keys
                .into_iter()
                .map(|(name, value)| {
                    let literal =
                        keys::literal(asked.text("kind"), &format!("{of}.{name}"), &value);
                    (name, literal)
                })
                .collect();
            edited(
                text,
                edit::add(text, &steps, &keys).map(|text| Edited { text, made: None }),
            )?
        }
        "/api/remove" => edited(
            text,
            edit::remove(text, &steps(asked)?).map(|text| Edited { text, made: None }),
        )?,
        "/api/run" => {
            let task: Task = serde_json::from_value(asked.body["task"].clone())
                .map_err(|error| wrong(error.to_string()))?;
            let (text, _) = folder.read(name).map_err(wrong)?;
            folder.own(RUNS).map_err(wrong)?;
            Reply::json(&json!({ "id": studio.jobs.add(name, task, text) }))
        }
        "/api/stop" => {
            studio
                .jobs
                .stop(asked.body["id"].as_u64().unwrap_or(0) as usize);
            Reply::json(&json!({}))
        }
        "/api/layout" => {
            let place = folder.own(LAYOUT).map_err(wrong)?;
            let kept = fs::write(place, asked.body.to_string());
            kept.map_err(|error| wrong(error.to_string()))?;
            Reply::json(&json!({}))
        }
        _ => return Err((404, "nothing has this address".to_string())),
    })
}

fn steps(asked: &Call) -> Result<Vec<Step>, (u16, String)> {
    serde_json::from_value(asked.body["path"].clone()).map_err(|error| wrong(error.to_string()))
}

/// The dotted path of the key that steps lead to, whichever of several bearings it is of.
fn key_of(steps: &[Step]) -> String {
    let names = steps.iter().filter_map(Step::name);
    let names: Vec<&str> = names.filter(|name| *name != AUXILIARY_BEARING).collect();
    names.join(".")
}

/// A text after a change; one that cannot be read has none yet.
fn edited(text: &str, found: Result<Edited, String>) -> Answer {
    match found {
        Ok(edited) => Ok(Reply::json(&json!(edited))),
        Err(_) if edit::typed(text).is_err() => Ok(Reply::json(&json!({ "broken": true }))),
        Err(why) => Err((422, why)),
    }
}

/// A starting file under a name that is free, with the scenario that a study names.
fn new(studio: &Studio, asked: &Call) -> Result<Value, (u16, String)> {
    let kind = asked.text("kind");
    let text = auxbear::template(kind).ok_or_else(|| wrong("no such kind"))?;
    let stem = asked.text("name").trim().trim_end_matches(".toml");
    let stem = if stem.is_empty() { kind } else { stem };
    let name = format!("{stem}.toml");
    studio.folder.path(&name).map_err(wrong)?;
    match studio.folder.save(&name, &text, None).map_err(wrong)? {
        Ok(_) => {}
        Err(_) => return Err((409, format!("{name} exists: another name is needed"))),
    }
    if kind == "study" {
        let drop = auxbear::template("drop").unwrap_or_default();
        // one that is there stays
        let _ = studio.folder.save("drop.toml", &drop, None);
    }
    Ok(json!({ "name": name }))
}

/// What building says of a text: a mistake that reading does not find, or warnings; nothing where a later text was asked for.
fn built(studio: &Studio, text: &str, path: &std::path::Path) -> Value {
    let found = studio.building.compute(|_| {
        let scenario = Scenario::parse(text, &path.display().to_string(), &[], &BuiltIn).ok()?;
        Some(match auxbear::build(&scenario) {
            Ok(machine) => {
                let warnings = machine.warnings();
                let said = warnings
                    .iter()
                    .map(|warning| format!("{}: {warning}", warning.code));
                json!({ "warnings": said.collect::<Vec<_>>() })
            }
            Err(problem) => json!({ "problem": of_problem(&problem, path) }),
        })
    });
    found
        .flatten()
        .unwrap_or_else(|| json!({ "dropped": true }))
}

/// The closed loop of the magnets of a text, as the scripts of a rotor's page draw it; nothing without magnets.
fn analysed(studio: &Studio, text: &str, path: &std::path::Path) -> Value {
    let analyse = |interrupt: &AtomicBool| -> Option<Result<String, Value>> {
        let scenario = Scenario::parse(text, &path.display().to_string(), &[], &BuiltIn).ok()?;
        let alone = match scenario.rotor_alone() {
            Some(alone) => alone.ok()?,
            None => scenario,
        };
        alone.rotor()?.rotor.levitation.as_ref()?;
        let quick = QUICK.map(|(path, value)| (path.to_string(), value.to_string()));
        let mut alone = alone.with(&quick).ok()?;
        // whirl in the auxiliary bearings is no matter of the controller
        if let auxbear::System::Rotor(analysis) = &mut alone.system {
            analysis.machine = None;
        }
        let found = auxbear::run(&alone, &Options::unwatched(interrupt));
        Some(match found {
            Err(problem) => Err(of_problem(&problem, path)),
            Ok(outcome) if !outcome.stop.complete() => Err(json!({ "message": outcome.stop.text })),
            Ok(outcome) => directory::page_run("", &alone, &outcome)
                .map(|run| page::brief(&run))
                .map_err(|problem| of_problem(&problem, path)),
        })
    };
    match studio.analysing.compute(analyse) {
        None => json!({ "dropped": true }),
        Some(None) => json!({ "none": true }),
        Some(Some(Ok(run))) => json!({ "run": run }),
        Some(Some(Err(problem))) => json!({ "problem": problem }),
    }
}

/// Bearings of the catalogue as a picker shows them.
fn catalogue() -> Value {
    let of = |bearing: &auxbear::Bearing| {
        let text = |key: &str| bearing.value(key).map(|value| value.text().to_string());
        json!({
            "name": bearing.name,
            "bore": bearing.number("bore_diameter"),
            "outside": bearing.number("outside_diameter"),
            "type": text("type"),
            "balls": format!("{} × {}", text("ball_count").unwrap_or_default(), text("ball_diameter").unwrap_or_default()),
            "speed": text("limiting_speed"),
        })
    };
    bearings().iter().map(of).collect()
}
