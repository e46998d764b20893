//! The functions of FMI 3.0, as its header declares them: those of co-simulation, and all others, which refuse. Importers ask a library
//! for every one.
//!
//! Pointers are those of the standard, as in [version 2.0](crate::interface_2).

#![allow(clippy::missing_safety_doc, missing_docs)] // the page above, and the standard
#![allow(clippy::too_many_arguments)] // the standard's

use crate::handle::{
    Handle, Importer, Logger, Logger3, Status, free, functions, none, refused, room,
};
use crate::handle::{
    forget, get, get_texts, read, restore, save, set, set_texts, size, text, write,
};
use crate::instance::{Instance, Stepped};
use crate::variables::Role;
use std::ffi::{c_char, c_int, c_void};

type Component = *mut c_void;

#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

unsafe fn importer<'a>(
    [name, token, resources]: [*const c_char; 3],
    environment: *mut c_void,
    logger: Option<Logger3>,
) -> Importer<'a> {
    // SAFETY: see the page.
    unsafe {
        Importer {
            logger: logger.map_or(Logger::Nowhere, Logger::Three),
            environment,
            name: text(name),
            guid: text(token),
            resources: text(resources),
        }
    }
}
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging: bool,
    _event_mode: bool,
    early_return: bool,
    _intermediate: *const u32,
    _intermediate_count: usize,
    environment: *mut c_void,
    logger: Option<Logger3>,
    _update: *const c_void,
) -> Component {
    // SAFETY: see the page.
    unsafe {
        let made = importer([name, token, resources], environment, logger).instantiated();
        if let Some(handle) = made.cast::<Handle>().as_mut() {
            handle.may_return_early = early_return;
        }
        made
    }
}
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging: bool,
    environment: *mut c_void,
    logger: Option<Logger3>,
) -> Component {
    // SAFETY: see the page.
    let importer = unsafe { importer([name, token, resources], environment, logger) };
    importer.refused("model exchange was asked for: this unit is one for co-simulation")
}
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging: bool,
    environment: *mut c_void,
    logger: Option<Logger3>,
    _clock: *const c_void,
    _lock: *const c_void,
    _unlock: *const c_void,
) -> Component {
    // SAFETY: see the page.
    let importer = unsafe { importer([name, token, resources], environment, logger) };
    importer.refused("scheduled execution was asked for: this unit is one for co-simulation")
}
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(c: Component) {
    // SAFETY: see the page.
    unsafe { free::<Handle>(c) }
}
functions! {
    fn fmi3EnterInitializationMode(own, _has_tolerance: bool, _tolerance: f64, start: f64, _has_stop: bool, _stop: f64) {
        own.instance.initialize(Some(start))
    }
    fn fmi3ExitInitializationMode(own) { own.instance.begin() }
    fn fmi3Terminate(own) { own.instance.terminate() }
    fn fmi3Reset(own) { own.instance.reset() }

    fn fmi3GetFloat64(own, references: *const u32, count: usize, values: *mut f64, _value_count: usize) {
        get(own, (references, count), values, Instance::real)
    }
    fn fmi3SetFloat64(own, references: *const u32, count: usize, values: *const f64, _value_count: usize) {
        set(own, (references, count), values, Instance::set_real)
    }
    fn fmi3GetBoolean(own, references: *const u32, count: usize, values: *mut bool, _value_count: usize) {
        get(own, (references, count), values, |own, at| own.boolean(at))
    }
    fn fmi3SetBoolean(own, references: *const u32, count: usize, values: *const bool, _value_count: usize) {
        set(own, (references, count), values, Instance::set_boolean)
    }
    fn fmi3GetString(own, references: *const u32, count: usize, values: *mut *const c_char, _value_count: usize) {
        get_texts(own, (references, count), values)
    }
    fn fmi3SetString(own, references: *const u32, count: usize, values: *const *const c_char, _value_count: usize) {
        set_texts(own, (references, count), values)
    }

    fn fmi3GetFMUState(own, state: *mut *mut c_void) { save(own, state) }
    fn fmi3SetFMUState(own, state: *mut c_void) { restore(own, state) }
    fn fmi3FreeFMUState(_, state: *mut *mut c_void) { forget(state) }
    fn fmi3SerializedFMUStateSize(own, state: *mut c_void, bytes: *mut usize) { size(own, state, bytes) }
    fn fmi3SerializeFMUState(own, state: *mut c_void, into: *mut u8, room: usize) { write(own, state, (into, room)) }
    fn fmi3DeserializeFMUState(own, from: *const u8, size: usize, state: *mut *mut c_void) { read(own, (from, size), state) }

    fn fmi3DoStep(own, from: f64, length: f64, _no_way_back: bool, event: *mut bool, terminate: *mut bool, early: *mut bool, reached: *mut f64) {
        let mut stepped = own.instance.step(from, length)?;
        while stepped == Stepped::Contact && !own.may_return_early {
            let now = own.instance.time();
            stepped = own.instance.step(now, from + length - now)?;
        }
        *event = false;
        *terminate = matches!(stepped, Stepped::Over(_));
        *early = stepped == Stepped::Contact;
        *reached = own.instance.time();
        if let Stepped::Over(why) = &stepped {
            own.say(Status::Discard, why);
        }
        Ok(())
    }

    fn fmi3GetNumberOfVariableDependencies(own, reference: u32, count: *mut usize) {
        *count = depends_on(own, reference).len();
        Ok(())
    }
    fn fmi3GetVariableDependencies(own, reference: u32, elements: *mut usize, independents: *mut u32, their_elements: *mut usize, kinds: *mut c_int, count: usize) {
        let all = depends_on(own, reference);
        if all.len() != count {
            return Err(format!("{} dependencies, not {count}", all.len()));
        }
        room(elements, count).fill(0);
        room(their_elements, count).fill(0);
        room(kinds, count).fill(DEPENDENT);
        room(independents, count).copy_from_slice(&all);
        Ok(())
    }
    fn fmi3SetDebugLogging(_, _on: bool, _count: usize, _categories: *const *const c_char) { Ok(()) }
    fn fmi3EnterStepMode(_) { Ok(()) }
    fn fmi3EvaluateDiscreteStates(_) { Ok(()) }
    fn fmi3EnterConfigurationMode(_) { Ok(()) }
    fn fmi3ExitConfigurationMode(_) { Ok(()) }
}

const DEPENDENT: c_int = 5;

/// Value references of the inputs that an output shows at once.
fn depends_on(own: &Handle, reference: u32) -> Vec<u32> {
    let all = own.instance.variables();
    let Some(Role::Output(_, feeds)) = all.get(reference as usize).map(|own| &own.role) else {
        return Vec::new();
    };
    let inputs = (0..).zip(all).filter_map(|(at, own)| match own.role {
        Role::Input(place) => feeds.contains(&place).then_some(at),
        _ => None,
    });
    inputs.collect()
}

/// Functions for variables of a type that no unit has.
macro_rules! no_such_variables {
    ($($name:ident($($argument:ident: $of:ty),*);)*) => {
        functions! {$(fn $name(_, _references: *const u32, count: usize $(, $argument: $of)*) { none(count) })*}
    };
}
no_such_variables! {
    fmi3GetFloat32(_values: *mut f32, _entries: usize);
    fmi3GetInt8(_values: *mut i8, _entries: usize);
    fmi3GetUInt8(_values: *mut u8, _entries: usize);
    fmi3GetInt16(_values: *mut i16, _entries: usize);
    fmi3GetUInt16(_values: *mut u16, _entries: usize);
    fmi3GetInt32(_values: *mut i32, _entries: usize);
    fmi3GetUInt32(_values: *mut u32, _entries: usize);
    fmi3GetInt64(_values: *mut i64, _entries: usize);
    fmi3GetUInt64(_values: *mut u64, _entries: usize);
    fmi3GetBinary(_sizes: *mut usize, _values: *mut *const u8, _entries: usize);
    fmi3GetClock(_values: *mut bool);
    fmi3SetFloat32(_values: *const f32, _entries: usize);
    fmi3SetInt8(_values: *const i8, _entries: usize);
    fmi3SetUInt8(_values: *const u8, _entries: usize);
    fmi3SetInt16(_values: *const i16, _entries: usize);
    fmi3SetUInt16(_values: *const u16, _entries: usize);
    fmi3SetInt32(_values: *const i32, _entries: usize);
    fmi3SetUInt32(_values: *const u32, _entries: usize);
    fmi3SetInt64(_values: *const i64, _entries: usize);
    fmi3SetUInt64(_values: *const u64, _entries: usize);
    fmi3SetBinary(_sizes: *const usize, _values: *const *const u8, _entries: usize);
    fmi3SetClock(_values: *const bool);
    fmi3GetIntervalDecimal(_intervals: *mut f64, _kinds: *mut c_int);
    fmi3GetIntervalFraction(_counters: *mut u64, _resolutions: *mut u64, _kinds: *mut c_int);
    fmi3GetShiftDecimal(_shifts: *mut f64);
    fmi3GetShiftFraction(_counters: *mut u64, _resolutions: *mut u64);
    fmi3SetIntervalDecimal(_intervals: *const f64);
    fmi3SetIntervalFraction(_counters: *const u64, _resolutions: *const u64);
    fmi3SetShiftDecimal(_shifts: *const f64);
    fmi3SetShiftFraction(_counters: *const u64, _resolutions: *const u64);
    fmi3GetOutputDerivatives(_orders: *const i32, _values: *mut f64, _entries: usize);
}

/// Functions of other kinds of units, and of what this one cannot do.
macro_rules! of_others {
    ($($name:ident($($argument:ident: $of:ty),*);)*) => {
        functions! {$(fn $name(_ $(, $argument: $of)*) {
            refused(concat!(stringify!($name), ": the unit is one for co-simulation, without events, clocks and derivatives"))
        })*}
    };
}
of_others! {
    fmi3EnterEventMode();
    fmi3UpdateDiscreteStates(_update: *mut bool, _end: *mut bool, _nominals: *mut bool, _values: *mut bool, _is_next: *mut bool, _next: *mut f64);
    fmi3GetDirectionalDerivative(_of: *const u32, _count: usize, _by: *const u32, _by_count: usize, _seed: *const f64, _seeds: usize, _out: *mut f64, _outs: usize);
    fmi3GetAdjointDerivative(_of: *const u32, _count: usize, _by: *const u32, _by_count: usize, _seed: *const f64, _seeds: usize, _out: *mut f64, _outs: usize);
    fmi3EnterContinuousTimeMode();
    fmi3CompletedIntegratorStep(_no_way_back: bool, _event: *mut bool, _end: *mut bool);
    fmi3SetTime(_time: f64);
    fmi3SetContinuousStates(_states: *const f64, _count: usize);
    fmi3GetContinuousStateDerivatives(_rates: *mut f64, _count: usize);
    fmi3GetEventIndicators(_values: *mut f64, _count: usize);
    fmi3GetContinuousStates(_states: *mut f64, _count: usize);
    fmi3GetNominalsOfContinuousStates(_values: *mut f64, _count: usize);
    fmi3GetNumberOfEventIndicators(_count: *mut usize);
    fmi3GetNumberOfContinuousStates(_count: *mut usize);
    fmi3ActivateModelPartition(_clock: u32, _time: f64);
}
