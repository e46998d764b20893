//! A unit through the functions that importers call: states, wrong calls, stops at contacts, parameters, the run directory.

use auxbear::Scenario;
use auxbear::run::Commands;
use auxbear::scenario::BuiltIn;
use auxbear_fmu::Version;
use auxbear_fmu::interface_2::*;
use auxbear_fmu::package::{Library, Unit, written};
use auxbear_fmu::variables::{Role, Variable};
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::fs;
use std::path::Path;
use std::ptr::{null, null_mut};

const SETS: [&str; 3] = [
    "levitation.power_lost_at=1 ms",
    "auxiliary_bearing.drive_end.contact.radial_air_clearance=30 um",
    "run.duration=8 ms",
];

fn machine(more: &[&str]) -> Scenario {
    let text = include_str!("../../../scenarios/amb_rig_drop.toml");
    let sets: Vec<String> = SETS.iter().chain(more).map(ToString::to_string).collect();
    Scenario::parse(text, "machine.toml", &sets, &BuiltIn).unwrap()
}

/// A unit of a scenario, unpacked.
struct Packed {
    folder: tempfile::TempDir,
    variables: Vec<Variable>,
    guid: String,
}

fn packed(scenario: &Scenario, commands: Commands) -> Packed {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("machine.fmu");
    let unit = Unit {
        scenario,
        commands,
        version: Version::Two,
        libraries: &[],
    };
    let variables = unit.write(&file).unwrap();
    let mut zip = zip::ZipArchive::new(fs::File::open(&file).unwrap()).unwrap();
    zip.extract(folder.path()).unwrap();
    let xml = fs::read_to_string(folder.path().join("modelDescription.xml")).unwrap();
    let guid = xml
        .split("guid=\"")
        .nth(1)
        .unwrap()
        .split('"')
        .next()
        .unwrap()
        .to_string();
    Packed {
        folder,
        variables,
        guid,
    }
}

/// An instance as an importer has it.
struct Instance<'a> {
    of: &'a Packed,
    c: *mut c_void,
}

thread_local! {
    static SAID: std::cell::RefCell<Vec<String>> = const { std::cell::RefCell::new(Vec::new()) };
}

unsafe extern "C" fn heard(
    _: *mut c_void,
    _: *const c_char,
    _: c_int,
    _: *const c_char,
    message: *const c_char,
) {
    let text = unsafe { CStr::from_ptr(message) }
        .to_string_lossy()
        .into_owned();
    SAID.with_borrow_mut(|said| said.push(text));
}

/// What was said last.
fn said() -> String {
    SAID.with_borrow(|said| said.last().cloned().unwrap_or_default())
}

/// As `fmi2CallbackFunctions`: the logger and four pointers.
#[repr(C)]
struct Callbacks(
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char),
    [*const c_void; 4],
);

fn instantiated(of: &Packed, guid: &str) -> *mut c_void {
    let callbacks = Callbacks(heard, [null(); 4]);
    let place = format!("file://{}/resources", of.folder.path().display());
    let [name, guid, place] = ["machine", guid, &place].map(|text| CString::new(text).unwrap());
    unsafe {
        fmi2Instantiate(
            name.as_ptr(),
            1,
            guid.as_ptr(),
            place.as_ptr(),
            (&raw const callbacks).cast(),
            0,
            0,
        )
    }
}

impl<'a> Instance<'a> {
    fn new(of: &'a Packed) -> Self {
        let c = instantiated(of, &of.guid);
        assert!(!c.is_null(), "{}", said());
        Instance { of, c }
    }
    fn begun(of: &'a Packed) -> Self {
        let own = Instance::new(of);
        own.begin();
        own
    }
    fn begin(&self) {
        unsafe {
            assert_eq!(fmi2SetupExperiment(self.c, 0, 0.0, 0.0, 0, 0.0), 0);
            assert_eq!(fmi2EnterInitializationMode(self.c), 0, "{}", said());
            assert_eq!(fmi2ExitInitializationMode(self.c), 0, "{}", said());
        }
    }
    fn reference(&self, name: &str) -> u32 {
        let found = self.of.variables.iter().position(|own| own.name == name);
        found.unwrap_or_else(|| panic!("{name}")) as u32
    }
    fn put(&self, name: &str, value: f64) -> c_int {
        let reference = self.reference(name);
        unsafe { fmi2SetReal(self.c, &raw const reference, 1, &raw const value) }
    }
    fn get(&self, name: &str) -> f64 {
        let (reference, mut value) = (self.reference(name), f64::NAN);
        let status = unsafe { fmi2GetReal(self.c, &raw const reference, 1, &raw mut value) };
        assert_eq!(status, 0, "{name}: {}", said());
        value
    }
    fn outputs(&self) -> Vec<u64> {
        let all = self.of.variables.iter();
        let outputs = all.filter(|own| matches!(own.role, Role::Output(..)));
        outputs.map(|own| self.get(&own.name).to_bits()).collect()
    }
    fn step(&self, from: f64, length: f64) -> c_int {
        unsafe { fmi2DoStep(self.c, from, length, 0) }
    }
    fn time(&self) -> f64 {
        let mut time = f64::NAN;
        assert_eq!(unsafe { fmi2GetRealStatus(self.c, 2, &raw mut time) }, 0);
        time
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        unsafe { fmi2FreeInstance(self.c) }
    }
}

const FRICTION: &str = "scenario.auxiliary_bearing.drive_end.contact.friction_coefficient";
const COMMAND: &str = "magnet.drive_end.current_command_1";

#[test]
fn a_state_that_was_saved_or_written_gives_the_same_bits() {
    let packed = packed(&machine(&[]), Commands::Current);
    let own = Instance::begun(&packed);
    let on = |own: &Instance| {
        assert_eq!(own.put(COMMAND, 0.9), 0);
        let _ = own.outputs();
        for k in 0..40 {
            assert_eq!(own.step(own.time(), 1e-4), 0, "{k}: {}", said());
        }
        own.outputs()
    };
    let names: std::collections::BTreeSet<_> =
        packed.variables.iter().map(|own| &own.name).collect();
    assert_eq!(names.len(), packed.variables.len());
    assert_eq!(own.put(COMMAND, 0.4), 0);
    assert_eq!(own.step(0.0, 0.8e-3), 0);
    unsafe {
        let mut state = null_mut();
        assert_eq!(fmi2GetFMUstate(own.c, &raw mut state), 0);
        let first = on(&own);
        let contacts = own.get("drive_end.contact_count");
        assert!(contacts >= 1.0, "{contacts}");
        assert_eq!(fmi2SetFMUstate(own.c, state), 0);
        assert_eq!(own.time(), 0.8e-3);
        assert_eq!(on(&own), first);
        // the same in bytes, by another instance
        let mut size = 0;
        assert_eq!(fmi2SerializedFMUstateSize(own.c, state, &raw mut size), 0);
        let mut bytes = vec![0; size];
        assert_eq!(
            fmi2SerializeFMUstate(own.c, state, bytes.as_mut_ptr(), size),
            0
        );
        assert_eq!(fmi2FreeFMUstate(own.c, &raw mut state), 0);
        assert!(state.is_null());
        let other = Instance::begun(&packed);
        let mut again = null_mut();
        assert_eq!(
            fmi2DeSerializeFMUstate(other.c, bytes.as_ptr(), size, &raw mut again),
            0,
            "{}",
            said()
        );
        assert_eq!(other.time(), 0.0);
        assert_eq!(fmi2SetFMUstate(other.c, again), 0);
        assert_eq!(on(&other), first);
        assert_eq!(fmi2FreeFMUstate(other.c, &raw mut again), 0);
        // bytes that are cut, or of nothing
        for wrong in [&bytes[..size - 1], &bytes[..20], b"what"] {
            let read =
                fmi2DeSerializeFMUstate(other.c, wrong.as_ptr(), wrong.len(), &raw mut again);
            assert!(
                read == 3 && said().contains("no state of this unit"),
                "{}",
                said()
            );
        }
    }
}

#[test]
fn wrong_calls_are_refused_and_say_why() {
    let packed = packed(&machine(&[]), Commands::Current);
    assert!(instantiated(&packed, "{other}").is_null());
    assert!(said().contains("not of one unit"), "{}", said());
    let own = Instance::new(&packed);
    // nothing goes on before the initialisation
    assert!(
        own.step(0.0, 1e-3) == 3 && said().contains("its turn is in"),
        "{}",
        said()
    );
    assert_eq!(own.put(FRICTION, -1.0), 0);
    let refused = unsafe { fmi2EnterInitializationMode(own.c) };
    assert!(
        refused == 3 && said().contains("friction_coefficient"),
        "{}",
        said()
    );
    assert_eq!(own.put(FRICTION, 0.2), 0);
    own.begin();
    for (name, value, why) in [
        (COMMAND, f64::NAN, "a finite number is needed"),
        (COMMAND, f64::INFINITY, "a finite number is needed"),
        (
            "scenario.rotor.speed",
            1000.0,
            "scenario.rotor.speed: is a parameter, fixed since the initialisation",
        ),
        (
            "magnets.powered",
            1.0,
            "magnets.powered: is an output of the unit and cannot be set",
        ),
        ("time", 1.0, "cannot be set"),
        ("stop_at_contacts", 1.0, "is no number"),
    ] {
        assert!(
            own.put(name, value) == 3 && said().contains(why),
            "{name}: {}",
            said()
        );
    }
    let (unknown, value) = (1_000_000_u32, 1.0);
    let refused = unsafe { fmi2SetReal(own.c, &raw const unknown, 1, &raw const value) };
    assert!(
        refused == 3 && said().contains("value reference 1000000: there are 0 to"),
        "{}",
        said()
    );
    assert_eq!(own.step(0.0, 1e-3), 0);
    for (from, length, why) in [
        (0.0, 1e-3, "a step backwards to 0 s: 0.001 s is reached"),
        (2e-3, 1e-3, "a step that leaps to 0.002 s"),
        (1e-3, -1e-3, "a step goes forwards"),
        (1e-3, 0.0, "a step goes forwards"),
        (1e-3, f64::NAN, "a step goes forwards"),
    ] {
        assert!(
            own.step(from, length) == 3 && said().contains(why),
            "{}",
            said()
        );
    }
    assert_eq!(own.time(), 1e-3);
    // beyond the end: what there is was done, and why there is no more
    assert_eq!(own.step(1e-3, 1.0), 2);
    assert!(
        said().contains("the run ends at run.duration, 0.008 s"),
        "{}",
        said()
    );
    let mut over = 0;
    assert_eq!(unsafe { fmi2GetBooleanStatus(own.c, 3, &raw mut over) }, 0);
    assert_eq!((own.time(), over), (8e-3, 1));
}

#[test]
fn steps_end_at_contacts_where_that_is_wanted() {
    let packed = packed(&machine(&[]), Commands::Current);
    let own = Instance::new(&packed);
    let (reference, on) = (own.reference("stop_at_contacts"), 1);
    assert_eq!(
        unsafe { fmi2SetBoolean(own.c, &raw const reference, 1, &raw const on) },
        0
    );
    own.begin();
    let mut stops = Vec::new();
    while own.time() < 8e-3 {
        let status = own.step(own.time(), 8e-3 - own.time());
        stops.push((own.time(), own.get("drive_end.touching")));
        assert!(status == 2 || own.time() == 8e-3, "{}", said());
    }
    assert!(stops.len() > 3 && stops[0].1 == 1.0, "{stops:?}");
    let whole = Instance::begun(&packed);
    assert_eq!(whole.step(0.0, stops[0].0), 0);
    assert_eq!(whole.get("drive_end.touching"), 1.0);
    assert_eq!(whole.get("drive_end.contact_count"), 1.0);
}

#[test]
fn parameters_are_values_of_the_scenario_and_the_run_directory_has_them() {
    let limit = "[[limit]]\nquantity = \"drive_end.first_impact_force\"\nmost = \"1 N\"\n";
    let text = include_str!("../../../scenarios/amb_rig_drop.toml").to_string() + limit;
    let limited =
        Scenario::parse(&text, "machine.toml", &SETS.map(str::to_string), &BuiltIn).unwrap();
    let packed = packed(&limited, Commands::Current);
    let own = Instance::new(&packed);
    assert_eq!(own.put(FRICTION, 0.3), 0);
    assert_eq!(own.put("scenario.rotor.speed", 1000.0), 0);
    let place = packed.folder.path().join("run");
    let reference = own.reference("run_directory");
    let text = CString::new(place.display().to_string()).unwrap();
    let value = text.as_ptr();
    assert_eq!(
        unsafe { fmi2SetString(own.c, &raw const reference, 1, &raw const value) },
        0
    );
    own.begin();
    assert_eq!(own.get("rotor.speed"), 1000.0);
    assert_eq!(own.step(0.0, 8e-3), 0);
    let mut state = null_mut();
    assert_eq!(unsafe { fmi2GetFMUstate(own.c, &raw mut state) }, 0);
    assert_eq!(unsafe { fmi2Terminate(own.c) }, 0, "{}", said());
    // one that was terminated goes on from a state, and keeps what is there
    assert_eq!(unsafe { fmi2SetFMUstate(own.c, state) }, 0);
    assert_eq!(unsafe { fmi2Terminate(own.c) }, 3);
    fs::rename(&place, place.with_file_name("first")).unwrap();
    assert_eq!(unsafe { fmi2SetFMUstate(own.c, state) }, 0);
    assert_eq!(unsafe { fmi2Terminate(own.c) }, 0, "{}", said());
    assert_eq!(unsafe { fmi2FreeFMUstate(own.c, &raw mut state) }, 0);
    let written = fs::read_to_string(place.join("scenario.toml")).unwrap();
    assert!(
        written.contains("friction_coefficient = \"0.3\"")
            || written.contains("friction_coefficient = 0.3")
    );
    let summary = fs::read_to_string(place.join("summary.json")).unwrap();
    assert!(summary.contains("drive_end.first_impact_force"));
    assert!(summary.contains("\"verdict\": \"fail\""), "{summary}");
    assert!(place.join("report.html").exists());
    // what is there is not written over
    let next = Instance::new(&packed);
    assert_eq!(
        unsafe { fmi2SetString(next.c, &raw const reference, 1, &raw const value) },
        0
    );
    // and before anything is computed
    let begun = unsafe {
        assert_eq!(fmi2EnterInitializationMode(next.c), 0);
        fmi2ExitInitializationMode(next.c)
    };
    assert_eq!(begun, 3);
    assert!(said().contains("run"), "{}", said());
}

/// A unit is refused where it cannot be, before anything is written.
#[test]
fn what_cannot_be_a_unit_is_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("machine.fmu");
    let refused = |scenario: &Scenario, commands, path: &Path, libraries: &[Library]| {
        let unit = Unit {
            scenario,
            commands,
            version: Version::Three,
            libraries,
        };
        unit.write(path).unwrap_err().to_string()
    };
    let why = refused(&machine(&[]), Commands::Voltage, &file, &[]);
    assert!(why.contains("inductance and resistance"), "{why}");
    let standing = include_str!("../../../scenarios/drop_until_standstill.toml");
    let standing = Scenario::parse(standing, "standing.toml", &[], &BuiltIn).unwrap();
    let why = refused(&standing, Commands::Current, &file, &[]);
    assert!(why.contains("run.until"), "{why}");
    let torque = Scenario::parse(
        &auxbear::template("torque").unwrap(),
        "torque.toml",
        &[],
        &BuiltIn,
    )
    .unwrap();
    let why = refused(&torque, Commands::Current, &file, &[]);
    assert!(why.contains("a drop or a machine is needed"), "{why}");
    let why = written(&machine(&[]), ("current", "2"), &[], &file);
    let why = why.err().unwrap().to_string();
    assert!(why.contains("cargo build --release"), "{why}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    fs::write(&file, "mine").unwrap();
    let why = refused(&machine(&[]), Commands::Current, &file, &[]);
    assert!(why.contains("never written over"), "{why}");
    assert_eq!(fs::read(&file).unwrap(), b"mine");
    assert!(
        Library::read(&file)
            .unwrap_err()
            .to_string()
            .contains("no library of Linux")
    );
}

/// Data files travel with a unit; the base moves besides its record.
#[test]
fn data_files_are_in_the_unit_and_inputs_add_to_what_the_file_gives() {
    let source = tempfile::tempdir().unwrap();
    let record = "time [s],shake [m/s^2]\n0,0\n0.001,1\n0.01,0\n";
    fs::write(source.path().join("shake.csv"), record).unwrap();
    let base = "[base]\nfile = \"shake.csv\"\nchannel_x = \"shake\"\n\n[run]\n";
    let rig = include_str!("../../../scenarios/amb_rig_drop.toml").replace("[run]\n", base);
    let path = source.path().join("rig.toml");
    fs::write(&path, rig).unwrap();
    let sets = SETS.map(str::to_string);
    let scenario = Scenario::read(&path, &sets, &BuiltIn).unwrap();
    let packed = packed(&scenario, Commands::Current);
    let text = fs::read_to_string(packed.folder.path().join("resources/scenario.toml")).unwrap();
    assert!(text.contains("file = \"data/1_"), "{text}");
    drop(source);
    let own = Instance::begun(&packed);
    let other = Instance::begun(&packed);
    assert_eq!(other.put("base.acceleration_x_added", 50.0), 0);
    assert_eq!(other.put("rotor.drive_torque_added", 5.0), 0);
    for instance in [&own, &other] {
        assert_eq!(instance.step(0.0, 3e-3), 0, "{}", said());
    }
    let speed = |of: &Instance| of.get("rotor.speed");
    assert!(speed(&other) > speed(&own));
    let name = |of: &str| {
        packed
            .variables
            .iter()
            .find(|own| own.name.ends_with(of))
            .unwrap()
            .name
            .clone()
    };
    // relative to the base the rotor moves the other way
    let x = name("bearing.outer_race.x");
    assert!(
        other.get(&x) < own.get(&x),
        "{} {}",
        other.get(&x),
        own.get(&x)
    );
}
