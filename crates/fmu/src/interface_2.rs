//! The functions of FMI 2.0 for co-simulation, as its header declares them.
//!
//! Pointers are those of the standard: what the importer got from here and has not freed, lists as long as their counts, texts that end
//! with a zero. Every function is safe to call with such, and only with such.

#![allow(clippy::missing_safety_doc, missing_docs)] // the page above, and the standard
#![allow(clippy::too_many_arguments)] // the standard's

use crate::handle::{
    Handle, Importer, Logger, Logger2, Status, free, functions, none, refused, text,
};
use crate::handle::{forget, get, get_texts, read, restore, save, set, set_texts, size, write};
use crate::instance::{Instance, Stepped};
use std::ffi::{c_char, c_int, c_void};

type Component = *mut c_void;

/// What an importer offers.
#[repr(C)]
pub struct Callbacks {
    logger: Option<Logger2>,
    allocate: Option<unsafe extern "C" fn(usize, usize) -> *mut c_void>,
    free: Option<unsafe extern "C" fn(*mut c_void)>,
    finished: Option<unsafe extern "C" fn(*mut c_void, c_int)>,
    environment: *mut c_void,
}

const CO_SIMULATION: c_int = 1;

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: c_int,
    guid: *const c_char,
    resources: *const c_char,
    callbacks: *const Callbacks,
    _visible: c_int,
    _logging: c_int,
) -> Component {
    // SAFETY: see the page.
    unsafe {
        let (logger, environment) = match callbacks.as_ref() {
            Some(own) => (
                own.logger.map_or(Logger::Nowhere, Logger::Two),
                own.environment,
            ),
            None => (Logger::Nowhere, std::ptr::null_mut()),
        };
        let importer = Importer {
            logger,
            environment,
            name: text(name),
            guid: text(guid),
            resources: text(resources),
        };
        match kind {
            CO_SIMULATION => importer.instantiated(),
            _ => {
                importer.refused("model exchange was asked for: this unit is one for co-simulation")
            }
        }
    }
}
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: Component) {
    // SAFETY: see the page.
    unsafe { free::<Handle>(c) }
}
functions! {
    fn fmi2SetDebugLogging(_, _on: c_int, _count: usize, _categories: *const *const c_char) { Ok(()) }
    fn fmi2SetupExperiment(own, _has_tolerance: c_int, _tolerance: f64, start: f64, _has_stop: c_int, _stop: f64) {
        own.instance.begin_at(start)
    }
    fn fmi2EnterInitializationMode(own) { own.instance.initialize(None) }
    fn fmi2ExitInitializationMode(own) { own.instance.begin() }
    fn fmi2Terminate(own) { own.instance.terminate() }
    fn fmi2Reset(own) {
        own.over = false;
        own.instance.reset()
    }

    fn fmi2GetReal(own, references: *const u32, count: usize, values: *mut f64) {
        get(own, (references, count), values, Instance::real)
    }
    fn fmi2SetReal(own, references: *const u32, count: usize, values: *const f64) {
        set(own, (references, count), values, Instance::set_real)
    }
    fn fmi2GetBoolean(own, references: *const u32, count: usize, values: *mut c_int) {
        get(own, (references, count), values, |own, at| own.boolean(at).map(c_int::from))
    }
    fn fmi2SetBoolean(own, references: *const u32, count: usize, values: *const c_int) {
        set(own, (references, count), values, |own, at, value| own.set_boolean(at, value != 0))
    }
    fn fmi2GetString(own, references: *const u32, count: usize, values: *mut *const c_char) {
        get_texts(own, (references, count), values)
    }
    fn fmi2SetString(own, references: *const u32, count: usize, values: *const *const c_char) {
        set_texts(own, (references, count), values)
    }
    fn fmi2GetInteger(_, _references: *const u32, count: usize, _values: *mut c_int) { none(count) }
    fn fmi2SetInteger(_, _references: *const u32, count: usize, _values: *const c_int) { none(count) }

    fn fmi2GetFMUstate(own, state: *mut *mut c_void) { save(own, state) }
    fn fmi2SetFMUstate(own, state: *mut c_void) { restore(own, state) }
    fn fmi2FreeFMUstate(_, state: *mut *mut c_void) { forget(state) }
    fn fmi2SerializedFMUstateSize(own, state: *mut c_void, bytes: *mut usize) { size(own, state, bytes) }
    fn fmi2SerializeFMUstate(own, state: *mut c_void, into: *mut u8, room: usize) { write(own, state, (into, room)) }
    fn fmi2DeSerializeFMUstate(own, from: *const u8, size: usize, state: *mut *mut c_void) { read(own, (from, size), state) }

    fn fmi2DoStep(own, from: f64, length: f64, _no_way_back: c_int) {
        Ok(match own.instance.step(from, length)? {
            Stepped::There => Status::Done,
            Stepped::Contact => Status::Discard,
            Stepped::Over(why) => {
                own.over = true;
                own.say(Status::Discard, &why);
                Status::Discard
            }
        })
    }
    fn fmi2CancelStep(_) { refused("no step is under way: steps end before their call returns") }
    fn fmi2GetStatus(_, _kind: c_int, _value: *mut c_int) { refused(NO_STATUS) }
    fn fmi2GetIntegerStatus(_, _kind: c_int, _value: *mut c_int) { refused(NO_STATUS) }
    fn fmi2GetStringStatus(_, _kind: c_int, _value: *mut *const c_char) { refused(NO_STATUS) }
    fn fmi2GetRealStatus(own, kind: c_int, value: *mut f64) {
        if kind != LAST_SUCCESSFUL_TIME {
            return refused(NO_STATUS);
        }
        *value = own.instance.time();
        Ok(())
    }
    fn fmi2GetBooleanStatus(own, kind: c_int, value: *mut c_int) {
        if kind != TERMINATED {
            return refused(NO_STATUS);
        }
        *value = c_int::from(own.over);
        Ok(())
    }

    fn fmi2SetRealInputDerivatives(_, _references: *const u32, _count: usize, _orders: *const c_int, _values: *const f64) {
        refused(NO_DERIVATIVES)
    }
    fn fmi2GetRealOutputDerivatives(_, _references: *const u32, _count: usize, _orders: *const c_int, _values: *mut f64) {
        refused(NO_DERIVATIVES)
    }
    fn fmi2GetDirectionalDerivative(_, _unknowns: *const u32, _count: usize, _knowns: *const u32, _known_count: usize, _seed: *const f64, _values: *mut f64) {
        refused(NO_DERIVATIVES)
    }
}

const LAST_SUCCESSFUL_TIME: c_int = 2;
const TERMINATED: c_int = 3;
const NO_STATUS: &str =
    "a status of another type, or of steps that are under way; these end before their call returns";
const NO_DERIVATIVES: &str = "the unit has no derivatives: inputs are held between steps";
