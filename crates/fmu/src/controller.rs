//! A co-simulation unit, FMI 2.0 or 3.0, as the controller of a machine.
//!
//! At every sample its inputs are set, it does one step of a sampling period from there, and its outputs are the commands. It is native
//! code: what it does to the process is its own.

use crate::package;
use auxbear::Scenario;
use auxbear::outcome::options::{Controller, Controllers};
use auxbear::problem::{Code, Problem};
use auxbear::scenario::rotor::levitation::{Magnets, Unit as GivenUnit};
use auxbear::scenario::{Body, problem_at};
use libloading::Library;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use sha2::{Digest, Sha256};
use std::cell::RefCell;
use std::error::Error;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::ptr::{null, null_mut};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Units in files.
pub struct Units;

/// Files whose unit may be there once in a process, and is.
static ALONE: Mutex<Vec<String>> = Mutex::new(Vec::new());
/// Folders that have been unpacked by this process.
static FOLDERS: AtomicUsize = AtomicUsize::new(0);

impl Controllers for Units {
    fn start(&self, file: &str) -> Result<Box<dyn Controller>, String> {
        Unit::start(file).map(|unit| Box::new(unit) as Box<dyn Controller>)
    }
    fn content(&self, file: &str) -> Option<Vec<u8>> {
        fs::read(file).ok()
    }
}

/// The magnets of a scenario that a unit commands, with the unit.
fn commanded(scenario: &Scenario) -> Option<(&Magnets, &GivenUnit)> {
    let Body::Flexible(shaft) = &scenario.drop()?.body else {
        return None;
    };
    let magnets = shaft.rotor.levitation.as_ref()?;
    Some((magnets, magnets.unit.as_ref()?))
}

fn hash(file: &str) -> Result<String, String> {
    let bytes = fs::read(file).map_err(|error| error.to_string())?;
    let hash = Sha256::digest(bytes);
    let digits: String = hash.iter().map(|byte| format!("{byte:02x}")).collect();
    Ok(format!("sha256:{digits}"))
}

/// Refuses the unit of a scenario that could not command its magnets, before a run: it is started once, and gone again. The scenario with
/// the hash of the unit; none where there is no unit, or it has the hash already.
///
/// # Errors
/// Why it could not.
pub fn checked(scenario: &Scenario) -> Result<Option<Scenario>, Box<Problem>> {
    examined(scenario, true)
}

/// Refuses a scenario whose unit is not there, or is another one than that of its hash; the unit is not started.
///
/// # Errors
/// Why it is refused.
pub fn there(scenario: &Scenario) -> Result<(), Box<Problem>> {
    examined(scenario, false).map(drop)
}

fn examined(scenario: &Scenario, start: bool) -> Result<Option<Scenario>, Box<Problem>> {
    let Some((magnets, unit)) = commanded(scenario) else {
        return Ok(None);
    };
    let (file, axes) = (&unit.file, 2 * magnets.magnets.len());
    let members = scenario.drop().map_or(1, |drop| drop.repeat.count);
    let found = match (hash(file), &unit.hash) {
        (Ok(hash), Some(given)) if hash != *given => {
            Err(format!("another one than that of fmu_hash: {hash}"))
        }
        (hash, _) if !start => hash,
        (hash, _) => hash.and_then(|hash| {
            let alone = Unit::start(file)?.fits(axes, axes)?;
            match alone && members > 1 {
                true => Err(ONCE.to_string()),
                false => Ok(hash),
            }
        }),
    };
    let key = "levitation.controller.fmu";
    match found {
        Ok(_) if unit.hash.is_some() => Ok(None),
        Ok(hash) => scenario.with(&[(format!("{key}_hash"), hash)]).map(Some),
        Err(why) => {
            let needed = "a unit of FMI 2.0 or 3.0 for co-simulation is needed, with a signal of each sensor axis as input and a command of \
                          each magnet axis as output, for this platform";
            // the path is in the file
            let name = Path::new(file).file_name().unwrap_or_default().display();
            let problem = problem_at(Code::Conflict, key, format!("{name}: {why}"), needed);
            Err(scenario.locate(problem))
        }
    }
}

const ONCE: &str =
    "may be instantiated once in a process, and more members run: repeat.count = 1 is needed";

/// What a description says.
#[derive(Default)]
struct Description {
    three: bool,
    token: String,
    identifier: String,
    alone: bool,
    inputs: Vec<u32>,
    outputs: Vec<u32>,
}

impl Description {
    fn read(text: &str) -> Result<Self, String> {
        let mut own = Description::default();
        let mut reader = Reader::from_str(text);
        let mut scalar = None;
        loop {
            let event = reader.read_event();
            match event.map_err(|error| format!("modelDescription.xml: {error}"))? {
                Event::Start(tag) | Event::Empty(tag) => own.take(&tag, &mut scalar)?,
                Event::Eof => break,
                _ => {}
            }
        }
        match own.identifier.is_empty() {
            true => Err("is no unit for co-simulation".to_string()),
            false => Ok(own),
        }
    }
    /// Takes an element; `scalar` is what stands around the type of a variable in version 2.0.
    fn take(&mut self, tag: &BytesStart, scalar: &mut Option<(String, u32)>) -> Result<(), String> {
        let get = |name: &str| -> String {
            let found = tag.try_get_attribute(name).ok().flatten();
            found.map_or_else(String::new, |own| own.value.into_owned())
        };
        match tag.name().as_ref() {
            "fmiModelDescription" => {
                let version = get("fmiVersion");
                self.three = version.starts_with("3.");
                if !self.three && !version.starts_with("2.") {
                    return Err(format!("is of FMI {version}; 2.0 or 3.0 is needed"));
                }
                self.token = get(if self.three {
                    "instantiationToken"
                } else {
                    "guid"
                });
            }
            "CoSimulation" => {
                self.identifier = get("modelIdentifier");
                self.alone = get("canBeInstantiatedOnlyOncePerProcess") == "true";
            }
            "ScalarVariable" => {
                let reference = get("valueReference").parse().unwrap_or_default();
                *scalar = Some((get("causality"), reference));
            }
            "Real" => {
                let (causality, reference) = scalar.take().unwrap_or_default();
                self.add(&causality, reference);
            }
            "Float64" => {
                self.add(
                    &get("causality"),
                    get("valueReference").parse().unwrap_or_default(),
                );
            }
            _ => {}
        }
        Ok(())
    }
    fn add(&mut self, causality: &str, reference: u32) {
        match causality {
            "input" => self.inputs.push(reference),
            "output" => self.outputs.push(reference),
            _ => {}
        }
    }
}

/// A unit that is unpacked into a folder of its own, for as long as it lives.
struct Folder(PathBuf);

impl Folder {
    fn of(file: &str) -> Result<Self, String> {
        let number = FOLDERS.fetch_add(1, Ordering::Relaxed);
        let name = format!("auxbear-unit-{}-{number}", std::process::id());
        let path = std::env::temp_dir().join(name);
        // one that is there is somebody else's
        fs::create_dir(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let folder = Folder(path);
        let opened = File::open(file).map_err(|error| error.to_string())?;
        let zip = zip::ZipArchive::new(opened);
        let unpacked = zip.and_then(|mut zip| zip.extract(&folder.0));
        unpacked.map_err(|error| format!("is no unit that can be unpacked ({error})"))?;
        Ok(folder)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

type Component = *mut c_void;

thread_local! {
    /// What units said on this thread since it was last taken.
    static SAID: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
}

unsafe fn heard(message: *const c_char) {
    if !message.is_null() {
        // SAFETY: a text of the unit that ends with a zero.
        let text = unsafe { CStr::from_ptr(message) }
            .to_string_lossy()
            .into_owned();
        SAID.with_borrow_mut(|said| said.push(text));
    }
}
/// The logger of version 2.0, without the arguments behind the message, which nobody formats.
unsafe extern "C" fn heard_2(
    _: *mut c_void,
    _: *const c_char,
    _: c_int,
    _: *const c_char,
    message: *const c_char,
) {
    // SAFETY: see `heard`.
    unsafe { heard(message) }
}
unsafe extern "C" fn heard_3(_: *mut c_void, _: c_int, _: *const c_char, message: *const c_char) {
    // SAFETY: see `heard`.
    unsafe { heard(message) }
}
unsafe extern "C" {
    fn calloc(count: usize, size: usize) -> *mut c_void;
    fn free(memory: *mut c_void);
}

/// `fmi2CallbackFunctions`.
#[repr(C)]
struct Callbacks {
    logger: unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char),
    allocate: unsafe extern "C" fn(usize, usize) -> *mut c_void,
    free: unsafe extern "C" fn(*mut c_void),
    finished: *const c_void,
    environment: *mut c_void,
}

/// An instance; fields are dropped in their order.
struct Unit {
    component: Component,
    description: Description,
    file: String,
    /// They must stay where they are while the instance lives.
    _callbacks: Box<Callbacks>,
    library: Library,
    _folder: Folder,
}

/// Calls a function of the library: its name, its types, what it is called with.
macro_rules! call {
    ($library:expr, $name:literal ( $($value:expr => $of:ty),* ) -> $out:ty) => {{
        // SAFETY: the function as the standard declares it, with arguments that live through the call.
        let found = unsafe { $library.get::<unsafe extern "C" fn($($of),*) -> $out>($name) };
        found
            .map_err(|_| format!("its library has no {}", String::from_utf8_lossy($name)))
            .map(|function| unsafe { function($($value),*) })
    }};
}

/// The same of a function that returns a status.
macro_rules! status {
    ($library:expr, $name:literal ( $($value:expr => $of:ty),* )) => {
        done(&String::from_utf8_lossy($name), call!($library, $name ( $($value => $of),* ) -> c_int))
    };
}

/// What a status says.
fn done(what: &str, status: Result<c_int, String>) -> Result<(), String> {
    match status? {
        0 | 1 => Ok(()),
        status => Err(refused(what, status)),
    }
}
fn refused(what: &str, status: c_int) -> String {
    let said = SAID.take().join("; ");
    let said = if said.is_empty() {
        "nothing".to_string()
    } else {
        said
    };
    format!("{what} returns status {status}; the unit says {said}")
}

impl Unit {
    fn start(file: &str) -> Result<Unit, String> {
        let folder = Folder::of(file)?;
        let text = fs::read_to_string(folder.0.join("modelDescription.xml"));
        let text = text.map_err(|_| "is no unit: it has no modelDescription.xml".to_string())?;
        let description = Description::read(&text)?;
        if description.alone {
            let mut alone = ALONE
                .lock()
                .map_err(|_| "another unit has failed".to_string())?;
            if alone.iter().any(|own| own == file) {
                return Err(ONCE.to_string());
            }
            alone.push(file.to_string());
        }
        let library = Self::library(&folder.0, &description)?;
        let callbacks = Box::new(Callbacks {
            logger: heard_2,
            allocate: calloc,
            free,
            finished: null(),
            environment: null_mut(),
        });
        let mut own = Unit {
            component: null_mut(),
            description,
            file: file.to_string(),
            _callbacks: callbacks,
            library,
            _folder: folder,
        };
        own.instantiate()?;
        Ok(own)
    }

    fn library(folder: &Path, of: &Description) -> Result<Library, String> {
        let (platform, tuple, ending) =
            package::here().ok_or("no platform of units is known here")?;
        let platform = if of.three { tuple } else { platform };
        let path = folder.join(format!("binaries/{platform}/{}.{ending}", of.identifier));
        if !path.is_file() {
            return Err(format!("holds no library for {platform}"));
        }
        // SAFETY: native code that the user named; see the page.
        unsafe { Library::new(&path) }.map_err(|error| {
            let why = error
                .source()
                .map_or(String::new(), |why| format!(": {why}"));
            let python = match why.contains("_Py") {
                true => "made with Python, run it with the Python package auxbear: ",
                false => "",
            };
            format!("{python}{error}{why}")
        })
    }

    fn instantiate(&mut self) -> Result<(), String> {
        let text = |own: &str| CString::new(own).map_err(|error| error.to_string());
        let resources = self._folder.0.join("resources").display().to_string();
        let name = text("controller")?;
        let token = text(&self.description.token)?;
        SAID.take();
        let library = &self.library;
        let c = if self.description.three {
            let path = text(&format!("{resources}{}", std::path::MAIN_SEPARATOR))?;
            call!(library, b"fmi3InstantiateCoSimulation" (
                name.as_ptr() => *const c_char, token.as_ptr() => *const c_char, path.as_ptr() => *const c_char,
                false => bool, false => bool, false => bool, false => bool, null() => *const u32, 0 => usize,
                null_mut() => *mut c_void,
                heard_3 => unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char),
                null() => *const c_void
            ) -> Component)?
        } else {
            let place = resources
                .replace('\\', "/")
                .replace('%', "%25")
                .replace(' ', "%20");
            let place = text(&format!(
                "file://{}{place}",
                if place.starts_with('/') { "" } else { "/" }
            ))?;
            call!(library, b"fmi2Instantiate" (
                name.as_ptr() => *const c_char, 1 => c_int, token.as_ptr() => *const c_char, place.as_ptr() => *const c_char,
                &raw const *self._callbacks => *const Callbacks, 0 => c_int, 0 => c_int
            ) -> Component)?
        };
        if c.is_null() {
            return Err(refused("the instantiation", 3));
        }
        self.component = c;
        if self.description.three {
            status!(library, b"fmi3EnterInitializationMode" (
                c => Component, false => bool, 0.0 => f64, 0.0 => f64, false => bool, 0.0 => f64))?;
            status!(library, b"fmi3ExitInitializationMode" (c => Component))
        } else {
            status!(library, b"fmi2SetupExperiment" (
                c => Component, 0 => c_int, 0.0 => f64, 0.0 => f64, 0 => c_int, 0.0 => f64))?;
            status!(library, b"fmi2EnterInitializationMode" (c => Component))?;
            status!(library, b"fmi2ExitInitializationMode" (c => Component))
        }
    }
}

impl Unit {
    /// Whether it is alone in its process; refused where it does not take so many signals and give so many commands.
    fn fits(&self, signals: usize, commands: usize) -> Result<bool, String> {
        let Description {
            inputs,
            outputs,
            alone,
            ..
        } = &self.description;
        match (inputs.len() == signals, outputs.len() == commands) {
            (false, _) => Err(format!(
                "it has {} inputs, and {signals} axes of sensors give a signal each",
                inputs.len()
            )),
            (_, false) => Err(format!(
                "it has {} outputs, and {commands} axes of magnets need a command each",
                outputs.len()
            )),
            _ => Ok(*alone),
        }
    }
}

impl Controller for Unit {
    fn sample(&mut self, time: f64, signals: &[f64], period: f64) -> Result<Vec<f64>, String> {
        self.fits(signals.len(), self.description.outputs.len())?;
        let Unit {
            component,
            description,
            library,
            ..
        } = self;
        let (c, inputs, outputs) = (*component, &description.inputs, &description.outputs);
        let mut commands = vec![f64::NAN; outputs.len()];
        SAID.take();
        if description.three {
            let mut ended = [false; 3];
            let mut reached = 0.0;
            let [event, end, early] = &mut ended;
            status!(library, b"fmi3SetFloat64" (
                c => Component, inputs.as_ptr() => *const u32, inputs.len() => usize, signals.as_ptr() => *const f64, signals.len() => usize))?;
            status!(library, b"fmi3DoStep" (
                c => Component, time => f64, period => f64, true => bool, event => *mut bool, end => *mut bool, early => *mut bool, &raw mut reached => *mut f64))?;
            status!(library, b"fmi3GetFloat64" (
                c => Component, outputs.as_ptr() => *const u32, outputs.len() => usize, commands.as_mut_ptr() => *mut f64, commands.len() => usize))?;
        } else {
            status!(library, b"fmi2SetReal" (
                c => Component, inputs.as_ptr() => *const u32, inputs.len() => usize, signals.as_ptr() => *const f64))?;
            status!(library, b"fmi2DoStep" (c => Component, time => f64, period => f64, 1 => c_int))?;
            status!(library, b"fmi2GetReal" (
                c => Component, outputs.as_ptr() => *const u32, outputs.len() => usize, commands.as_mut_ptr() => *mut f64))?;
        }
        Ok(commands)
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        let (c, library) = (self.component, &self.library);
        if !c.is_null() {
            // a unit that fails here is gone all the same
            let _ = match self.description.three {
                true => call!(library, b"fmi3Terminate" (c => Component) -> c_int)
                    .and_then(|_| call!(library, b"fmi3FreeInstance" (c => Component) -> ())),
                false => call!(library, b"fmi2Terminate" (c => Component) -> c_int)
                    .and_then(|_| call!(library, b"fmi2FreeInstance" (c => Component) -> ())),
            };
        }
        if self.description.alone
            && let Ok(mut alone) = ALONE.lock()
        {
            alone.retain(|own| *own != self.file);
        }
    }
}
