//! How far a run is: a bar on a terminal, a few lines in a log, nothing when quiet; and what takes long before it begins.

use crate::console;
use auxbear::scenario::Scenario;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

/// Time between lines in a log, at least.
const PAUSE: Duration = Duration::from_secs(1);

/// Time after which a line says what takes so long, and between two such lines.
const PATIENCE: Duration = Duration::from_secs(2);
const REPEATED: Duration = Duration::from_secs(10);

/// Tells what is done where it takes longer than two seconds, until it is dropped.
pub struct Busy(#[allow(dead_code)] Sender<()>); // its end is what is heard

impl Busy {
    /// Reports the building of the machine that a scenario describes.
    pub fn building(scenario: &Scenario) -> Busy {
        let what = scenario.system.name().preparation();
        let (held, dropped) = channel::<()>();
        thread::spawn(move || {
            let (begin, mut wait) = (Instant::now(), PATIENCE);
            while dropped.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                console::report(&format!("{what}: {:.0} s", begin.elapsed().as_secs_f64()));
                wait = REPEATED;
            }
        });
        Busy(held)
    }
}

/// Shows how far a run is.
pub enum Progress {
    Quiet,
    Bar(ProgressBar),
    Lines(Mutex<Lines>),
}

/// What was printed in a log: a line each 10 %, and none sooner than a second after the last.
pub struct Lines {
    tenths: u32,
    last: Instant,
}

impl Progress {
    /// The form that fits where the messages go.
    pub fn new(quiet: bool) -> Progress {
        if quiet {
            return Progress::Quiet;
        }
        if !std::io::stderr().is_terminal() {
            return Progress::Lines(Mutex::new(Lines {
                tenths: 0,
                last: Instant::now(),
            }));
        }
        let bar = ProgressBar::with_draw_target(Some(1000), ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("run {wide_bar} {percent:>3} % {eta:>5}");
        Progress::Bar(bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())))
    }

    /// Shows the fraction done, from any thread.
    pub fn show(&self, fraction: f64) {
        match self {
            Progress::Quiet => {}
            Progress::Bar(bar) => {
                bar.set_position((1000.0 * fraction) as u64);
            }
            Progress::Lines(lines) => {
                let tenths = (10.0 * fraction) as u32;
                let Ok(mut lines) = lines.lock() else {
                    return;
                };
                if tenths > lines.tenths && lines.last.elapsed() >= PAUSE {
                    lines.tenths = tenths;
                    lines.last = Instant::now();
                    console::report(&format!("run: {} %", 10 * tenths));
                }
            }
        }
    }

    /// Takes the bar away.
    pub fn end(&self) {
        if let Progress::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}
