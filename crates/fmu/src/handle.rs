//! What stands behind a pointer that an importer holds: an instance, its messages, and the border that no panic crosses.
//!
//! Safety of all functions here: texts end with a zero or are null; lists and room for values are as long as their counts say and live
//! through the call; handles and states came from here and are not freed yet, or are null.

use crate::instance::{Fault, Instance, State};
use crate::past;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

/// What a call says: the numbers of both versions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    Done = 0,
    Discard = 2,
    Error = 3,
    Fatal = 4,
}

impl From<()> for Status {
    fn from((): ()) -> Self {
        Status::Done
    }
}

/// The logger of an importer of version 2.0; it formats like `printf`.
pub(crate) type Logger2 = unsafe extern "C" fn(
    environment: *mut c_void,
    instance: *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
    ...
);
/// The same of version 3.0.
pub(crate) type Logger3 = unsafe extern "C" fn(
    environment: *mut c_void,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
);

/// Where messages go.
pub(crate) enum Logger {
    Nowhere,
    Two(Logger2),
    Three(Logger3),
}

/// An instance with its messages.
pub(crate) struct Handle {
    pub instance: Instance,
    logger: Logger,
    environment: *mut c_void,
    name: CString,
    /// Whether a step was discarded because nothing comes after it.
    pub over: bool,
    /// Whether the importer lets a step end early.
    pub may_return_early: bool,
    /// Texts that the importer reads until its next call.
    pub texts: Vec<CString>,
}

fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

/// A text that an importer gave; none where it is no UTF-8.
pub(crate) unsafe fn text<'a>(from: *const c_char) -> Option<&'a str> {
    if from.is_null() {
        return None;
    }
    // SAFETY: see the page.
    unsafe { CStr::from_ptr(from) }.to_str().ok()
}

/// A list that an importer gave.
pub(crate) unsafe fn list<'a, T>(from: *const T, count: usize) -> &'a [T] {
    if count == 0 || from.is_null() {
        return &[];
    }
    // SAFETY: see the page.
    unsafe { std::slice::from_raw_parts(from, count) }
}

/// A list that an importer wants filled.
pub(crate) unsafe fn room<'a, T>(from: *mut T, count: usize) -> &'a mut [T] {
    if count == 0 || from.is_null() {
        return &mut [];
    }
    // SAFETY: see the page.
    unsafe { std::slice::from_raw_parts_mut(from, count) }
}

/// The folder in a URI of a file, or a path.
fn folder(location: &str) -> PathBuf {
    let Some(rest) = location.strip_prefix("file:") else {
        return PathBuf::from(location);
    };
    let rest = rest.strip_prefix("//localhost").unwrap_or(rest);
    let rest = rest.strip_prefix("//").unwrap_or(rest);
    let mut bytes = Vec::with_capacity(rest.len());
    let mut left = rest.as_bytes();
    while let [byte, after @ ..] = left {
        let digits = (after.get(..2)).filter(|_| *byte == b'%');
        let digits = digits.and_then(|digits| std::str::from_utf8(digits).ok());
        match digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(value) => {
                bytes.push(value);
                left = &after[2..];
            }
            None => {
                bytes.push(*byte);
                left = after;
            }
        }
    }
    let path = String::from_utf8_lossy(&bytes).into_owned();
    // `/C:/folder` of Windows
    let drive = path
        .strip_prefix('/')
        .filter(|path| path.chars().nth(1) == Some(':'));
    PathBuf::from(drive.unwrap_or(&path))
}

/// Who instantiates a unit.
pub(crate) struct Importer<'a> {
    pub logger: Logger,
    pub environment: *mut c_void,
    pub name: Option<&'a str>,
    pub guid: Option<&'a str>,
    pub resources: Option<&'a str>,
}

impl Importer<'_> {
    fn say(&self, status: Status, message: &str) {
        say(
            &self.logger,
            self.environment,
            &c_text(self.name.unwrap_or_default()),
            (status, message),
        );
    }
    /// The instance, to be freed by the importer; null where there is none, which a message explains.
    pub fn instantiated(self) -> *mut c_void {
        let made = catch_unwind(AssertUnwindSafe(|| {
            let missing = |what: &str| format!("{what}: is missing, or no UTF-8");
            let guid = self
                .guid
                .ok_or_else(|| missing("the guid of the description"))?;
            let place = self
                .resources
                .ok_or_else(|| missing("the place of the resources"))?;
            Instance::new(Path::new(&folder(place)), guid)
        }));
        match made {
            Ok(Ok(instance)) => {
                let name = c_text(self.name.unwrap_or_default());
                let handle = Handle {
                    instance,
                    logger: self.logger,
                    environment: self.environment,
                    name,
                    over: false,
                    may_return_early: true,
                    texts: Vec::new(),
                };
                Box::into_raw(Box::new(handle)).cast()
            }
            Ok(Err(fault)) => {
                self.say(Status::Error, &fault);
                std::ptr::null_mut()
            }
            Err(_) => {
                self.say(Status::Fatal, PANIC);
                std::ptr::null_mut()
            }
        }
    }
    /// Refuses to be instantiated.
    pub fn refused(self, why: &str) -> *mut c_void {
        self.say(Status::Error, why);
        std::ptr::null_mut()
    }
}

const PANIC: &str = "a fault of auxbear, which its standard error describes: please report it";

fn say(logger: &Logger, environment: *mut c_void, name: &CStr, (status, message): (Status, &str)) {
    let category = match status {
        Status::Done => c"logAll",
        Status::Discard => c"logStatusDiscard",
        Status::Error => c"logStatusError",
        Status::Fatal => c"logStatusFatal",
    };
    match logger {
        Logger::Nowhere => {}
        Logger::Two(logger) => {
            let message = c_text(&message.replace('%', "%%"));
            // SAFETY: the importer's function, with what it is to be called with; the message asks for no argument.
            unsafe {
                logger(
                    environment,
                    name.as_ptr(),
                    status as c_int,
                    category.as_ptr(),
                    message.as_ptr(),
                );
            }
        }
        Logger::Three(logger) => {
            let message = c_text(message);
            // SAFETY: see the page.
            unsafe {
                logger(
                    environment,
                    status as c_int,
                    category.as_ptr(),
                    message.as_ptr(),
                )
            };
        }
    }
}

impl Handle {
    pub fn say(&self, status: Status, message: &str) {
        say(
            &self.logger,
            self.environment,
            &self.name,
            (status, message),
        );
    }
}

/// Does something with an instance: what failed is said, and a panic ends here.
pub(crate) unsafe fn with<S: Into<Status>>(
    handle: *mut c_void,
    act: impl FnOnce(&mut Handle) -> Result<S, Fault>,
) -> c_int {
    // SAFETY: see the page.
    let Some(handle) = (unsafe { handle.cast::<Handle>().as_mut() }) else {
        return Status::Error as c_int;
    };
    let done = catch_unwind(AssertUnwindSafe(|| act(handle)));
    let status = match done {
        Ok(Ok(status)) => status.into(),
        Ok(Err(fault)) => {
            handle.say(Status::Error, &fault);
            Status::Error
        }
        Err(_) => {
            handle.say(Status::Fatal, PANIC);
            Status::Fatal
        }
    };
    status as c_int
}

/// Frees what stands behind a pointer.
pub(crate) unsafe fn free<T>(pointer: *mut c_void) {
    if !pointer.is_null() {
        // SAFETY: see the page.
        drop(unsafe { Box::from_raw(pointer.cast::<T>()) });
    }
}

/// Functions of the standard whose first argument is an instance: each does something with it, and says what failed.
macro_rules! functions {
    ($(fn $name:ident($own:pat $(, $argument:ident: $of:ty)*) $body:block)*) => {$(
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(c: *mut std::ffi::c_void $(, $argument: $of)*) -> std::ffi::c_int {
            // SAFETY: arguments are as the standard has them; see the page.
            unsafe { $crate::handle::with(c, |$own| $body) }
        }
    )*};
}
pub(crate) use functions;

/// Refuses, and says why.
pub(crate) fn refused(why: &str) -> Result<(), Fault> {
    Err(why.to_string())
}
/// Does nothing with no variables, and refuses any.
pub(crate) fn none(count: usize) -> Result<(), Fault> {
    match count {
        0 => Ok(()),
        _ => refused("the unit has no variables of this type"),
    }
}

/// Value references with their number.
pub(crate) type References = (*const u32, usize);

/// Values of variables.
pub(crate) unsafe fn get<T>(
    own: &mut Handle,
    (references, count): References,
    values: *mut T,
    of: impl Fn(&mut Instance, u32) -> Result<T, Fault>,
) -> Result<(), Fault> {
    // SAFETY: see the page.
    let (references, values) = unsafe { (list(references, count), room(values, count)) };
    for (reference, value) in references.iter().zip(values) {
        *value = of(&mut own.instance, *reference)?;
    }
    Ok(())
}

/// Sets variables.
pub(crate) unsafe fn set<T: Copy>(
    own: &mut Handle,
    (references, count): References,
    values: *const T,
    put: impl Fn(&mut Instance, u32, T) -> Result<(), Fault>,
) -> Result<(), Fault> {
    // SAFETY: see the page.
    let (references, values) = unsafe { (list(references, count), list(values, count)) };
    let mut all = references.iter().zip(values);
    all.try_for_each(|(reference, value)| put(&mut own.instance, *reference, *value))
}

/// Texts of variables, which live until the next call.
pub(crate) unsafe fn get_texts(
    own: &mut Handle,
    (references, count): References,
    values: *mut *const c_char,
) -> Result<(), Fault> {
    // SAFETY: see the page.
    let (references, values) = unsafe { (list(references, count), room(values, count)) };
    let found = references
        .iter()
        .map(|reference| own.instance.text(*reference));
    own.texts = found
        .map(|text| Ok(c_text(text?)))
        .collect::<Result<_, Fault>>()?;
    for (value, text) in values.iter_mut().zip(&own.texts) {
        *value = text.as_ptr();
    }
    Ok(())
}

/// Sets texts.
pub(crate) unsafe fn set_texts(
    own: &mut Handle,
    references: References,
    values: *const *const c_char,
) -> Result<(), Fault> {
    // SAFETY: see the page.
    unsafe {
        set(own, references, values, |instance, reference, value| {
            instance.set_text(reference, text(value).ok_or("a text that is no UTF-8")?)
        })
    }
}

/// Saves the state of an instance, in the place of an earlier one where there is one.
pub(crate) unsafe fn save(own: &mut Handle, state: *mut *mut c_void) -> Result<(), Fault> {
    let saved = own.instance.save()?;
    // SAFETY: see the page.
    unsafe {
        match (*state).cast::<State>().as_mut() {
            Some(earlier) => *earlier = saved,
            None => *state = Box::into_raw(Box::new(saved)).cast(),
        }
    }
    Ok(())
}

/// A state that was saved.
unsafe fn saved<'a>(state: *mut c_void) -> Result<&'a State, Fault> {
    // SAFETY: see the page.
    let state = unsafe { state.cast::<State>().as_ref() };
    state.ok_or_else(|| "no state was given".to_string())
}

/// Goes back to a state.
pub(crate) unsafe fn restore(own: &mut Handle, state: *mut c_void) -> Result<(), Fault> {
    own.over = false;
    // SAFETY: see the page.
    own.instance.restore(unsafe { saved(state) }?)
}

/// Frees a state.
pub(crate) unsafe fn forget(state: *mut *mut c_void) -> Result<(), Fault> {
    // SAFETY: see the page.
    unsafe {
        if let Some(state) = state.as_mut() {
            free::<State>(std::mem::replace(state, std::ptr::null_mut()));
        }
    }
    Ok(())
}

/// Size of a state as bytes.
pub(crate) unsafe fn size(own: &Handle, state: *mut c_void, size: *mut usize) -> Result<(), Fault> {
    // SAFETY: see the page.
    unsafe { *size = past::written(own.instance.guid(), &saved(state)?.past).len() };
    Ok(())
}

/// Writes a state as bytes.
pub(crate) unsafe fn write(
    own: &Handle,
    state: *mut c_void,
    (into, size): (*mut u8, usize),
) -> Result<(), Fault> {
    // SAFETY: see the page.
    let (state, into) = unsafe { (saved(state)?, room(into, size)) };
    let bytes = past::written(own.instance.guid(), &state.past);
    let into = into
        .get_mut(..bytes.len())
        .ok_or("too little room for the state")?;
    into.copy_from_slice(&bytes);
    Ok(())
}

/// A state from its bytes: the instance goes through all that the other did, and back to where it is.
pub(crate) unsafe fn read(
    own: &mut Handle,
    (from, size): (*const u8, usize),
    state: *mut *mut c_void,
) -> Result<(), Fault> {
    // SAFETY: see the page.
    let past = past::read(own.instance.guid(), unsafe { list(from, size) });
    let past = past.ok_or("bytes that are no state of this unit")?;
    let before = own.instance.save()?;
    let repeated = own.instance.repeat(past).and_then(|()| own.instance.save());
    own.instance.restore(&before)?;
    // SAFETY: see the page.
    unsafe { *state = Box::into_raw(Box::new(repeated?)).cast() };
    Ok(())
}
