//! `auxbear studio`.

use crate::arguments::Studio as Wish;
use crate::console;
use crate::exit::Exit;
use auxbear::problem::Result;
use auxbear::report::directory::{failed, misplaced};
use chrono::Utc;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::{env, fs, process};
use studio::{Settings, Studio, selftest};

/// Serves a folder until it is interrupted, or tries the studio itself.
pub fn perform(wish: &Wish) -> Result<Exit> {
    if wish.selftest {
        return tried();
    }
    let settings = Settings {
        folder: wish.folder.as_deref().unwrap_or(Path::new(".")),
        port: wish.port,
        say: Box::new(console::report),
        date: || Utc::now().date_naive().to_string(),
    };
    let folder = settings.folder;
    let is_new = !folder.exists();
    let studio = Arc::new(Studio::open(settings)?);
    if is_new {
        console::report(&format!(
            "{} was not there: an empty folder was made",
            folder.display()
        ));
    }
    let own = studio.clone();
    let stopped = Arc::new(AtomicBool::new(false));
    let computing = stopped.clone();
    let mut interrupted = false;
    let handler = move || {
        if std::mem::replace(&mut interrupted, true) {
            process::exit(130);
        }
        if own.end() {
            computing.store(true, Ordering::Relaxed);
            console::report("stopping: what was computed is kept; a second interrupt ends at once");
        }
    };
    if let Err(error) = ctrlc::set_handler(handler) {
        console::report(&format!("an interrupt will not keep results: {error}"));
    }
    let address = studio.address();
    console::print(&format!("{address}\n"))?;
    console::report("The studio serves this address to this machine alone; Ctrl-C ends it.");
    if !wish.no_browser && !opened(&address) {
        console::report("No browser could be opened: open the address above in one.");
    }
    studio.serve();
    match stopped.load(Ordering::Relaxed) {
        true => Ok(Exit::Interrupted),
        false => Ok(Exit::Done),
    }
}

/// Opens the address in the browser that the system prefers; whether there was a program to ask.
fn opened(address: &str) -> bool {
    let (program, words): (&str, &[&str]) = match env::consts::OS {
        "macos" => ("open", &[]),
        "windows" => ("rundll32", &["url.dll,FileProtocolHandler"]),
        _ => ("xdg-open", &[]),
    };
    let quiet = Stdio::null;
    let mut command = Command::new(program);
    command
        .args(words)
        .arg(address)
        .stdin(quiet())
        .stdout(quiet())
        .stderr(quiet());
    command.spawn().is_ok()
}

/// One of each kind, in a folder that is taken away afterwards.
fn tried() -> Result<Exit> {
    let folder = env::temp_dir().join(format!("auxbear-studio-{}", process::id()));
    fs::create_dir(&folder).map_err(|error| misplaced(&folder, &error))?;
    let tried = selftest::run(&folder, &mut |line| {
        // what cannot be printed is no fault of the studio
        let _ = console::print(&format!("{line}\n"));
    });
    fs::remove_dir_all(&folder).map_err(|error| failed(&folder, &error))?;
    match tried {
        Ok(()) => {
            console::print("the studio works\n")?;
            Ok(Exit::Done)
        }
        Err(why) => {
            console::report(&format!("the studio failed: {why}"));
            Ok(Exit::Failed)
        }
    }
}
