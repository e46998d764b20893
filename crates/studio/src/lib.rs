//! The studio: a local page that edits, runs, shows and compares, with a folder as all its state.
//!
//! ```text
//!   browser ──server──▶ routes ──▶ folder   files below FOLDER, saved whole, one studio at a time
//!                              ├─▶ check    values with their origin, the first mistake, the drawing
//!                              ├─▶ edit     a value set and taken away where it stands
//!                              ├─▶ jobs     a queue, progress, the motion while it is computed
//!                              └─▶ runs     run directories as a table
//! ```
//! The page is plain scripts of `page/`; runs are shown by the pages that they left, drawings by the scripts of those pages.

#![forbid(unsafe_code)]

pub mod check;
pub mod edit;
pub mod folder;
pub mod jobs;
pub mod keys;
pub mod motion;
mod routes;
pub mod runs;
pub mod selftest;
pub mod server;

use auxbear::{Code, Problem};
use folder::Folder;
use jobs::Jobs;
use runs::Runs;
use std::net::{Ipv4Addr, TcpListener};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;

/// Threads that answer: a browser asks for several things at a time, of which one may take a second.
const ANSWERERS: usize = 6;

/// What a caller decides of a studio.
pub struct Settings<'a> {
    /// The folder that it serves.
    pub folder: &'a Path,
    /// Port on the loopback address; a free one if none.
    pub port: Option<u16>,
    /// Called with a line for each run that begins and ends.
    pub say: Box<dyn Fn(&str) + Send + Sync>,
    /// The day that documents have.
    pub date: fn() -> String,
}

/// A studio that listens.
pub struct Studio {
    pub(crate) folder: Arc<Folder>,
    pub(crate) jobs: Jobs,
    pub(crate) runs: Runs,
    pub(crate) building: Latest,
    pub(crate) analysing: Latest,
    server: tiny_http::Server,
    port: u16,
    token: String,
    ended: AtomicBool,
}

impl Studio {
    /// Takes the folder and begins to listen.
    ///
    /// # Errors
    /// A folder that cannot be used, one that another studio serves, a port that another program has.
    pub fn open(settings: Settings) -> Result<Studio, Box<Problem>> {
        let port = settings.port.unwrap_or(0);
        let place = format!("127.0.0.1:{port}");
        let busy = |error: &dyn std::fmt::Display| {
            let needed = "a free port is needed: another --port, or none for any free one";
            let found = format!("that nothing can listen there ({error})");
            Problem::new(Code::PortInUse, place.clone(), found, needed).on_key("--port")
        };
        let listener =
            TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(|error| busy(&error))?;
        let port = listener.local_addr().map_err(|error| busy(&error))?.port();
        // a port that is taken leaves no folder behind
        let folder = Arc::new(Folder::open(settings.folder)?);
        let server =
            tiny_http::Server::from_listener(listener, None).map_err(|error| busy(&error))?;
        let mut secret = [0; 24];
        getrandom::fill(&mut secret).map_err(|error| busy(&error))?;
        let studio = Studio {
            jobs: Jobs::new(folder.clone(), settings.say, settings.date),
            folder,
            runs: Runs::default(),
            building: Latest::default(),
            analysing: Latest::default(),
            server,
            port,
            token: secret.iter().map(|byte| format!("{byte:02x}")).collect(),
            ended: AtomicBool::new(false),
        };
        // without it the next studio on this folder only learns that there is one
        let _ = studio.folder.served_at(&studio.plain_address());
        Ok(studio)
    }

    /// The first address, with the token: whoever has it may use the studio.
    pub fn address(&self) -> String {
        format!("{}?token={}", self.plain_address(), self.token)
    }

    /// The address without the token.
    pub fn plain_address(&self) -> String {
        format!("http://127.0.0.1:{}/", self.port)
    }

    /// Answers and computes until it is ended.
    pub fn serve(&self) {
        thread::scope(|scope| {
            for _ in 0..ANSWERERS {
                scope.spawn(|| {
                    while !self.ended.load(Ordering::Relaxed) {
                        match self.server.recv() {
                            Ok(request) => server::answer(self, request),
                            // it was unblocked to end
                            Err(_) => return,
                        }
                    }
                });
            }
            scope.spawn(|| self.jobs.work(&self.ended));
        });
    }

    /// Ends it: a run that is computed is stopped and keeps what it has. Whether there is one.
    pub fn end(&self) -> bool {
        let computes = self.jobs.stop_all();
        self.ended.store(true, Ordering::Relaxed);
        for _ in 0..ANSWERERS {
            self.server.unblock();
        }
        computes
    }

    pub(crate) fn token(&self) -> &str {
        &self.token
    }

    /// Name of the cookie: cookies do not tell ports apart.
    pub(crate) fn cookie(&self) -> String {
        format!("auxbear_studio_{}", self.port)
    }

    /// Names by which a browser may ask.
    pub(crate) fn hosts(&self) -> [String; 2] {
        ["127.0.0.1", "localhost"].map(|name| format!("{name}:{}", self.port))
    }
}

/// The last of several requests counts: those before it are dropped, also while they are computed.
#[derive(Default)]
pub(crate) struct Latest {
    number: AtomicUsize,
    turn: Mutex<()>,
    interrupt: Mutex<Arc<AtomicBool>>,
}

impl Latest {
    /// Computes where no later request has come meanwhile; none where one has.
    pub fn compute<T>(&self, compute: impl FnOnce(&AtomicBool) -> T) -> Option<T> {
        let own: Arc<AtomicBool> = Arc::default();
        let number = self.number.fetch_add(1, Ordering::Relaxed) + 1;
        if let Ok(mut interrupt) = self.interrupt.lock() {
            std::mem::replace(&mut *interrupt, own.clone()).store(true, Ordering::Relaxed);
        }
        let _turn = self.turn.lock();
        let is_last = || self.number.load(Ordering::Relaxed) == number;
        let found = is_last().then(|| compute(&own))?;
        is_last().then_some(found)
    }
}

#[cfg(test)]
mod tests;
