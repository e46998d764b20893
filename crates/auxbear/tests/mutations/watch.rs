//! Watches over what is done with each mutation: time, memory, panics. What is found is kept with its input.

use std::alloc::{GlobalAlloc, Layout, System};
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};
use std::time::{Duration, Instant};

/// Longest time of one input; after three times that the process ends, since it may be without end.
pub const LONGEST: Duration = Duration::from_secs(10);
/// Most memory that one input may take, bytes.
pub const MOST: usize = 1 << 30;

/// The system's memory, counted.
struct Counting;

static LIVE: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

fn taken(bytes: usize) {
    let live = LIVE.fetch_add(bytes, Ordering::Relaxed) + bytes;
    PEAK.fetch_max(live, Ordering::Relaxed);
}

// SAFETY: every call is handed on to the system's allocator as it came; only numbers are kept beside.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        taken(layout.size());
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        taken(layout.size());
        // SAFETY: the caller's promise.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        LIVE.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static MEMORY: Counting = Counting;

/// An input that is being tried.
struct Tried {
    begin: Instant,
    longest: Duration,
    name: String,
    input: Vec<u8>,
}

static CURRENT: Mutex<Option<Tried>> = Mutex::new(None);

fn current() -> MutexGuard<'static, Option<Tried>> {
    CURRENT.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Where inputs are kept with which something is wrong.
fn keep(name: &str, input: &[u8]) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("mutations");
    let path = folder.join(name);
    let kept = fs::create_dir_all(&folder).and_then(|()| fs::write(&path, input));
    kept.expect("the folder for tests can be written");
    path
}

/// One test over many mutations; tests wait for each other, so that time and memory are those of one.
pub struct Watch {
    name: &'static str,
    tried: usize,
    accepted: usize,
    slowest: Duration,
    largest: usize,
    findings: Vec<String>,
    _alone: MutexGuard<'static, ()>,
}

impl Watch {
    pub fn new(name: &'static str) -> Watch {
        static ALONE: Mutex<()> = Mutex::new(());
        static FIRST: Once = Once::new();
        let alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        FIRST.call_once(|| {
            let usual = std::panic::take_hook();
            std::panic::set_hook(Box::new(move |panic| {
                if !auxbear::run::panic_is_caught() {
                    usual(panic);
                }
            }));
            std::thread::spawn(|| {
                loop {
                    std::thread::sleep(Duration::from_secs(1));
                    if let Some(tried) = &*current()
                        && tried.begin.elapsed() > 3 * tried.longest
                    {
                        let path = keep(&tried.name, &tried.input);
                        eprintln!("without end: {}", path.display());
                        std::process::abort();
                    }
                }
            });
        });
        Watch {
            name,
            tried: 0,
            accepted: 0,
            slowest: Duration::ZERO,
            largest: 0,
            findings: Vec::new(),
            _alone: alone,
        }
    }

    /// Does something with an input; it tells whether the input was accepted.
    pub fn each(&mut self, input: &[u8], act: impl FnOnce() -> bool) {
        self.budgeted(input, LONGEST, act);
    }

    /// The same with another longest time.
    pub fn budgeted(&mut self, input: &[u8], longest: Duration, act: impl FnOnce() -> bool) {
        let name = format!("{}-{}", self.name, self.tried);
        self.tried += 1;
        let before = LIVE.load(Ordering::Relaxed);
        PEAK.store(before, Ordering::Relaxed);
        let begin = Instant::now();
        *current() = Some(Tried {
            begin,
            longest,
            name: name.clone(),
            input: input.to_vec(),
        });
        let done = catch_unwind(AssertUnwindSafe(act));
        *current() = None;
        let (time, memory) = (
            begin.elapsed(),
            PEAK.load(Ordering::Relaxed).saturating_sub(before),
        );
        self.slowest = self.slowest.max(time);
        self.largest = self.largest.max(memory);
        let wrong = match done {
            Err(_) => Some("panics".to_string()),
            Ok(_) if time > longest => Some(format!("takes {:.1} s", time.as_secs_f64())),
            Ok(_) if memory > MOST => Some(format!("takes {} MB", memory >> 20)),
            Ok(accepted) => {
                self.accepted += usize::from(accepted);
                None
            }
        };
        if let Some(wrong) = wrong {
            let path = keep(&name, input);
            self.findings.push(format!("{wrong}: {}", path.display()));
        }
    }

    /// Fails where something was found.
    pub fn end(self) {
        println!(
            "{}: {} mutations, {} accepted, slowest {:.2} s, largest {} MB, {} findings",
            self.name,
            self.tried,
            self.accepted,
            self.slowest.as_secs_f64(),
            self.largest >> 20,
            self.findings.len()
        );
        assert!(self.findings.is_empty(), "{}", self.findings.join("\n"));
    }
}

/// How many: by an environment variable in the long form.
pub fn count(variable: &str, usual: usize) -> usize {
    std::env::var(variable).map_or(usual, |text| {
        text.parse()
            .unwrap_or_else(|_| panic!("{variable}={text} is no count"))
    })
}
