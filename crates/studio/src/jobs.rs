//! Runs one after the other: a queue, the progress of each, and pictures of the one that is computed.

use crate::folder::{Folder, changed};
use auxbear::outcome::options::InterimRow;
use auxbear::outcome::{Options, Severity};
use auxbear::report::directory::{NewDirectory, RUNS, free_path_in};
use auxbear::report::study::{Directory, Wish};
use auxbear::study::Study;
use auxbear::{BuiltIn, Code, Problem, Scenario, StudyFile};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Most points of an orbit that is shown while it is computed; of more every second one is dropped.
const MOST_POINTS: usize = 12_000;

/// What is done with a file.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// What the file describes.
    Run,
    /// The analysis of its rotor alone.
    Rotor,
    /// Many runs.
    Study,
    /// Every case of a machine, with the document.
    Qualify,
}

/// How far a job is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// Others come first.
    Waiting,
    /// It is computed.
    Running,
    /// It was asked to stop and keeps what was computed.
    Stopping,
    /// All was computed.
    Done,
    /// It was stopped; what was computed is kept.
    Stopped,
    /// It failed, or its input is wrong.
    Failed,
}

/// A run in the queue, or one that was in it.
#[derive(Clone, Debug, Serialize)]
pub struct Job {
    /// Its number, from 1.
    pub id: usize,
    /// Name of its file.
    pub file: String,
    /// What is done with it.
    pub task: Task,
    /// How far it is.
    pub state: State,
    /// Share done, from 0 to 1.
    pub share: f64,
    /// What is done now, in words.
    pub words: String,
    /// Seconds since it began, or that it took.
    pub seconds: f64,
    /// Its directory below the folder, once there is one.
    pub directory: Option<String>,
    /// When the page of results so far was written, of a study or a qualification; 0 for not yet.
    pub page: u64,
    #[serde(skip)]
    text: String,
    #[serde(skip)]
    begun: Option<Instant>,
    #[serde(skip)]
    interrupt: Arc<AtomicBool>,
    #[serde(skip)]
    live: Arc<Mutex<Live>>,
}

/// What is known of the motion of a run that is computed.
#[derive(Debug, Default)]
struct Live {
    /// Instants, s, and the place of the rotor in each bearing, m.
    points: Vec<(f64, Vec<[f64; 2]>)>,
    /// Every so many rows make a point.
    every: usize,
    seen: usize,
    /// How often points were dropped.
    round: usize,
    last: Option<InterimRow>,
    clearances: Vec<(String, f64)>,
}

/// The queue with all jobs of this studio.
pub struct Jobs {
    list: Mutex<Vec<Job>>,
    woken: Condvar,
    folder: Arc<Folder>,
    say: Box<dyn Fn(&str) + Send + Sync>,
    date: fn() -> String,
}

impl Jobs {
    /// An empty queue; `say` hears of each job that begins and ends, `date` is the day that documents have.
    pub fn new(
        folder: Arc<Folder>,
        say: Box<dyn Fn(&str) + Send + Sync>,
        date: fn() -> String,
    ) -> Jobs {
        Jobs {
            list: Mutex::default(),
            woken: Condvar::new(),
            folder,
            say,
            date,
        }
    }

    /// Puts a run of a text at the end of the queue.
    pub fn add(&self, file: &str, task: Task, text: String) -> usize {
        let mut list = self.locked();
        let id = list.len() + 1;
        list.push(Job {
            id,
            file: file.to_string(),
            task,
            state: State::Waiting,
            share: 0.0,
            words: String::new(),
            seconds: 0.0,
            directory: None,
            page: 0,
            text,
            begun: None,
            interrupt: Arc::default(),
            live: Arc::default(),
        });
        self.woken.notify_all();
        id
    }

    /// Stops a job: one that waits is never begun, one that runs keeps what was computed.
    pub fn stop(&self, id: usize) {
        if let Some(job) = self.locked().iter_mut().find(|job| job.id == id) {
            job.interrupt.store(true, Ordering::Relaxed);
            match job.state {
                State::Waiting => job.state = State::Stopped,
                State::Running => job.state = State::Stopping,
                _ => {}
            }
        }
    }

    /// Stops all of them; whether one is still computed.
    pub fn stop_all(&self) -> bool {
        let ids: Vec<usize> = self.locked().iter().map(|job| job.id).collect();
        ids.into_iter().for_each(|id| self.stop(id));
        self.locked().iter().any(|job| job.state == State::Stopping)
    }

    /// All jobs, the last first.
    pub fn all(&self) -> Vec<Job> {
        let mut all = self.locked().clone();
        for job in &mut all {
            if let (Some(begun), State::Running | State::Stopping) = (job.begun, job.state) {
                job.seconds = begun.elapsed().as_secs_f64();
            }
        }
        all.reverse();
        all
    }

    /// The motion of a job that is computed, from the point after those that are known of this round.
    pub fn live(&self, id: usize, round: usize, from: usize) -> Option<Value> {
        let live = self.locked().iter().find(|job| job.id == id)?.live.clone();
        let live = locked(&live);
        let from = if round == live.round {
            from.min(live.points.len())
        } else {
            0
        };
        let points = &live.points[from..];
        let of_bearing = |k: usize| -> Value {
            let path: Vec<[f64; 2]> = points
                .iter()
                .filter_map(|(_, places)| places.get(k).copied())
                .collect();
            let now = live.last.as_ref().and_then(|row| row.bearings.get(k));
            let (name, clearance) = live.clearances.get(k).cloned().unwrap_or_default();
            json!({
                "name": name,
                "clearance": clearance,
                "path": path,
                "force": now.map(|now| now.force),
                "balls": now.map(|now| &now.balls),
            })
        };
        let count = live.last.as_ref().map_or(0, |row| row.bearings.len());
        Some(json!({
            "round": live.round,
            "from": from,
            "next": live.points.len(),
            "time": live.last.as_ref().map(|row| row.time),
            "speed": live.last.as_ref().map(|row| row.speed),
            "bearings": (0..count).map(of_bearing).collect::<Vec<_>>(),
        }))
    }

    /// Computes what is in the queue until `ended` says so; called by one thread.
    pub fn work(&self, ended: &AtomicBool) {
        loop {
            let mut list = self.locked();
            let next = loop {
                if ended.load(Ordering::Relaxed) {
                    return;
                }
                if let Some(job) = list.iter_mut().find(|job| job.state == State::Waiting) {
                    job.state = State::Running;
                    job.begun = Some(Instant::now());
                    break job.clone();
                }
                let wait = Duration::from_millis(200);
                list = self
                    .woken
                    .wait_timeout(list, wait)
                    .unwrap_or_else(PoisonError::into_inner)
                    .0;
            };
            drop(list);
            self.begin(&next);
        }
    }

    fn begin(&self, job: &Job) {
        (self.say)(&format!("{}: begun", job.file));
        let found = catch_unwind(AssertUnwindSafe(|| match job.task {
            Task::Run | Task::Rotor => self.run(job),
            Task::Study | Task::Qualify => self.study(job),
        }));
        let (state, words) = match found {
            Ok(Ok(done)) => done,
            Ok(Err(problem)) => (State::Failed, problem.to_string()),
            Err(_) => (
                State::Failed,
                "the program met an error of its own; the terminal shows it".to_string(),
            ),
        };
        let place = self.change(job.id, |own| {
            own.state = state;
            own.words.clone_from(&words);
            own.seconds = own.begun.map_or(0.0, |begun| begun.elapsed().as_secs_f64());
            own.share = if state == State::Done { 1.0 } else { own.share };
            own.directory.clone().unwrap_or_default()
        });
        let place = place.unwrap_or_default();
        (self.say)(format!("{}: {words} {place}", job.file).trim_end());
    }

    fn change<T>(&self, id: usize, change: impl FnOnce(&mut Job) -> T) -> Option<T> {
        self.locked()
            .iter_mut()
            .find(|job| job.id == id)
            .map(change)
    }

    fn locked(&self) -> MutexGuard<'_, Vec<Job>> {
        locked(&self.list)
    }

    /// Where a file's runs go: named as the file is, with its folder before it.
    fn free_place(&self, file: &str) -> PathBuf {
        free_path_in(&self.folder.root().join(RUNS), &run_name(file))
    }

    fn shown(&self, path: &Path) -> String {
        let below = path.strip_prefix(self.folder.root()).unwrap_or(path);
        below
            .components()
            .map(|part| part.as_os_str().to_string_lossy())
            .collect::<Vec<_>>()
            .join("/")
    }

    fn run(&self, job: &Job) -> Result<(State, String), Box<Problem>> {
        let path = self.folder.root().join(&job.file);
        let mut scenario = Scenario::parse(&job.text, &path.display().to_string(), &[], &BuiltIn)?;
        if job.task == Task::Rotor
            && let Some(alone) = scenario.rotor_alone()
        {
            scenario = alone?;
        }
        self.change(job.id, |own| {
            own.words = scenario.system.name().preparation().to_string()
        });
        let machine = auxbear::build(&scenario)?;
        let place = self.free_place(&job.file);
        let directory = NewDirectory::reserve(&place)?;
        if let Some(drop) = scenario.drop() {
            let clearances = drop
                .auxiliary_bearings
                .iter()
                .map(|own| (own.name.clone(), own.contact.radial_air_clearance));
            locked(&job.live).clearances = clearances.collect();
        }
        self.change(job.id, |own| own.words = "computing".to_string());
        let outcome = machine.run(&Options {
            threads: None,
            interrupt: &job.interrupt,
            progress: &|share| {
                self.change(job.id, |own| own.share = share);
            },
            // native code of others is not started from a page
            controllers: None,
            rows: Some(&|rows| locked(&job.live).add(rows)),
        });
        directory.finish(&scenario, &outcome)?;
        self.change(job.id, |own| own.directory = Some(self.shown(&place)));
        let warned = outcome
            .warnings
            .iter()
            .filter(|warning| warning.severity < Severity::Note)
            .count();
        let state = match outcome.stop.reason {
            _ if outcome.stop.complete() => State::Done,
            "interrupted" => State::Stopped,
            _ => State::Failed,
        };
        let warned = match warned {
            0 => String::new(),
            1 => ", 1 warning".to_string(),
            many => format!(", {many} warnings"),
        };
        Ok((
            state,
            format!("{}{warned}", outcome.stop.text.trim_end_matches('.')),
        ))
    }

    fn study(&self, job: &Job) -> Result<(State, String), Box<Problem>> {
        let path = self.folder.root().join(&job.file);
        self.change(job.id, |own| own.words = "reading".to_string());
        let read = || StudyFile::parse(&job.text, &path.display().to_string(), path.parent());
        if job.task == Task::Qualify {
            read()?.require_qualification()?;
        }
        // the same study goes on where it stopped; another one gets a place of its own
        let first = self.folder.root().join(RUNS).join(run_name(&job.file));
        let directory = match Directory::open(&first, Study::new(read()?)?, 0) {
            Err(problem) if matches!(problem.code, Code::StudyChanged | Code::OutputExists) => {
                Directory::open(&self.free_place(&job.file), Study::new(read()?)?, 0)
            }
            other => other,
        }?;
        let place = self.shown(directory.path());
        self.change(job.id, |own| own.directory = Some(place));
        let count = directory.study.members();
        let page = match job.task {
            Task::Qualify => "document.html",
            _ => "report.html",
        };
        let page = directory.path().join(page);
        let tell = |what: &str, done: f64, all: usize| {
            self.change(job.id, |own| {
                own.share = done / all.max(1) as f64;
                own.page = changed(&page);
                own.words = format!("{:.0} % of {all} {what}", 100.0 * own.share);
            });
        };
        let options = Options::unwatched(&job.interrupt);
        let (complete, failed, members) = match job.task {
            Task::Qualify => {
                let wish = Wish {
                    date: &(self.date)(),
                    progress: &tell,
                };
                let found = directory.qualify(&options, &wish)?;
                (found.complete, found.done.failed, found.done.answer.members)
            }
            _ => {
                let found = directory.run(&options, &|done| tell("runs", done, count))?;
                (found.complete, found.failed, found.answer.members)
            }
        };
        let words = match failed {
            0 => format!("{members} of {count} runs"),
            some => format!("{members} of {count} runs, {some} failed"),
        };
        let state = match complete {
            true if failed == members => State::Failed,
            true => State::Done,
            false => State::Stopped,
        };
        Ok((state, words))
    }
}

impl Live {
    /// Takes rows; of more than fit every second point is dropped.
    fn add(&mut self, rows: Vec<InterimRow>) {
        self.every = self.every.max(1);
        for row in rows {
            if self.seen.is_multiple_of(self.every) {
                let places = row.bearings.iter().map(|own| own.rotor).collect();
                self.points.push((row.time, places));
            }
            self.seen += 1;
            self.last = Some(row);
        }
        if self.points.len() > MOST_POINTS {
            let mut k = 0;
            self.points.retain(|_| {
                k += 1;
                k % 2 == 1
            });
            self.every *= 2;
            self.round += 1;
        }
    }
}

/// Name of the runs of a file.
pub fn run_name(file: &str) -> String {
    file.trim_end_matches(".toml").replace('/', "-")
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use auxbear::outcome::options::InterimBearing;

    #[test]
    fn an_orbit_of_many_points_is_thinned() {
        let mut live = Live::default();
        let row = |k: usize| InterimRow {
            time: k as f64,
            speed: 1.0,
            bearings: vec![InterimBearing::default(); 2],
        };
        for k in 0..5 * MOST_POINTS {
            live.add(vec![row(k)]);
        }
        assert!(live.points.len() <= MOST_POINTS && live.points.len() > MOST_POINTS / 3);
        assert!(live.round > 0);
        let apart: Vec<f64> = live
            .points
            .windows(2)
            .map(|pair| pair[1].0 - pair[0].0)
            .collect();
        assert!(apart.iter().all(|gap| *gap == apart[0]), "equal distances");
        assert_eq!(live.last.unwrap().time, (5 * MOST_POINTS - 1) as f64);
    }

    #[test]
    fn runs_are_named_as_their_files() {
        assert_eq!(run_name("drop.toml"), "drop");
        assert_eq!(run_name("old/drop.toml"), "old-drop");
    }
}
