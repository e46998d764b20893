//! The table of keys: the one place that knows names, kinds, ranges, defaults and words of a scenario.
//!
//! The order is the order of the resolved file and of the starting file. A key that another one depends on stands before it.
//! Each system has some of the sections, and of a section all keys that name no other system.

use crate::drop::case::CASE;
use crate::key::{Key, Kind, Presence, Range, Section};
use crate::run::{Accuracy, Method, Until};
use crate::system::SystemName::{
    self, CoastDown, Drop, Identify, Machine, Rig, Rotor, Signals, SpinUp, Torque,
};
use crate::system::{COASTING_DOWN, FALLING, MACHINE, MOVING, STEPPED, WITH_BEARING};
use problem::words::Words;
use std::collections::HashMap;
use std::sync::LazyLock;

/// Format name of the scenario files that this version writes.
pub const FORMAT: &str = "auxbear.scenario/1";

/// All sections, in order.
pub fn sections() -> impl Iterator<Item = &'static Section> {
    crate::drop::keys::SECTIONS
        .iter()
        .chain(crate::drop::base::SECTIONS)
        .chain(crate::spin_up::keys::SECTIONS)
        .chain(crate::torque::keys::SECTIONS)
        .chain(crate::signals::keys::SECTIONS)
        .chain(crate::signals::keys_analysis::SECTIONS)
        .chain(crate::rig::keys::SECTIONS)
        .chain(crate::identify::keys::SECTIONS)
        .chain(crate::rotor::keys::SECTIONS)
        .chain(crate::bearing::keys::SECTIONS)
        .chain(crate::bearing::keys_cage::SECTIONS)
        .chain(crate::bearing::keys::TRACTION_SECTIONS)
        .chain(crate::bearing::keys_moment::SECTIONS)
        .chain(crate::bearing::keys_lubricant_state::SECTIONS)
        .chain(RUN_SECTIONS)
        .chain(crate::coast_down::keys::SECTIONS)
        .chain(crate::heat::keys::SECTIONS)
        .chain(crate::drop::keys::REPEAT_SECTIONS)
}

/// All keys, in order.
pub fn keys() -> impl Iterator<Item = &'static Key> {
    HEAD.iter()
        .chain(crate::drop::keys::KEYS)
        .chain(crate::drop::keys_surface::KEYS)
        .chain(crate::drop::keys_mount::KEYS)
        .chain(crate::drop::base::KEYS)
        .chain(crate::rotor::keys::KEYS)
        .chain(crate::spin_up::keys::KEYS)
        .chain(crate::torque::keys::KEYS)
        .chain(crate::signals::keys::KEYS)
        .chain(crate::signals::keys::TEMPERATURE)
        .chain(crate::rig::keys::KEYS)
        .chain(crate::identify::keys::KEYS)
        .chain(crate::signals::keys_analysis::KEYS)
        .chain(crate::bearing::keys::KEYS)
        .chain(crate::bearing::keys_spatial::KEYS)
        .chain(crate::bearing::keys_cage::KEYS)
        .chain(crate::bearing::keys::TRACTION)
        .chain(crate::bearing::keys_moment::KEYS)
        .chain(crate::bearing::keys_lubricant_state::KEYS)
        .chain(RUN)
        .chain(crate::coast_down::keys::KEYS)
        .chain(crate::heat::keys::KEYS)
        .chain(crate::rig::keys::TEMPERATURE)
        .chain(crate::drop::keys::REPEAT)
}

/// The sections of a system, in order.
pub fn sections_of(system: SystemName) -> impl Iterator<Item = &'static Section> {
    sections().filter(move |section| section.systems.contains(&system))
}

/// The keys of a system, in order.
pub fn keys_of(system: SystemName) -> impl Iterator<Item = &'static Key> {
    // every member of a study asks for them again
    static KEYS: LazyLock<Vec<Vec<&Key>>> = LazyLock::new(|| {
        let of = |system: &SystemName| keys().filter(|key| systems(key).contains(system)).collect();
        SystemName::ALL.iter().map(of).collect()
    });
    KEYS[system as usize].iter().copied()
}

/// The section that a file of a system may have for the analysis of its rotor alone, which a run does not read.
pub const ANALYSIS: &str = "analysis";

/// The keys of [`ANALYSIS`] in a file of a system that does not read them.
pub fn keys_of_analysis(system: SystemName) -> impl Iterator<Item = &'static Key> {
    let there = (system == SystemName::Machine).then(|| keys_of(SystemName::Rotor));
    (there.into_iter().flatten()).filter(|key| key.section() == ANALYSIS)
}

/// The keys that give the same thing as another.
pub fn keys_that_exclude() -> &'static [&'static Key] {
    static KEYS: LazyLock<Vec<&Key>> =
        LazyLock::new(|| keys().filter(|key| key.excludes.is_some()).collect());
    &KEYS
}

/// The key of a path; none where there is no such key.
pub fn key(path: &str) -> Option<&'static Key> {
    static KEYS: LazyLock<HashMap<&str, &Key>> =
        LazyLock::new(|| first_of_each(keys().map(|key| (key.path, key))));
    KEYS.get(path).copied()
}

/// The first value of each name.
fn first_of_each<T>(all: impl Iterator<Item = (&'static str, T)>) -> HashMap<&'static str, T> {
    let mut found = HashMap::new();
    for (name, value) in all {
        found.entry(name).or_insert(value);
    }
    found
}

/// The systems that have a key.
pub fn systems(key: &Key) -> &'static [SystemName] {
    static OF_SECTION: LazyLock<HashMap<&str, &[SystemName]>> =
        LazyLock::new(|| first_of_each(sections().map(|section| (section.path, section.systems))));
    let of_section = || OF_SECTION.get(key.section()).copied();
    (key.systems.or_else(of_section)).unwrap_or(SystemName::ALL)
}

/// What a system does without a key: mostly what all systems do.
pub fn presence(key: &Key, system: SystemName) -> Presence {
    let own = match system {
        Torque => crate::torque::keys::PRESENCES,
        SpinUp => crate::spin_up::keys::PRESENCES,
        Rig => crate::rig::keys::PRESENCES,
        CoastDown => crate::coast_down::keys::PRESENCES,
        Drop | Signals | Identify | Rotor | Machine => &[],
    };
    let own = own.iter().find(|(path, _)| *path == key.path);
    own.map_or(key.presence, |(_, presence)| *presence)
}

/// Whether the starting file of a system gives a key that could stay away in a file of another bearing.
pub fn starts_with(key: &Key, system: SystemName) -> bool {
    if key.path == "bearing.name" {
        return true;
    }
    match system {
        Signals => crate::signals::keys::GIVEN.contains(&key.path),
        Rig => crate::rig::keys::GIVEN.contains(&key.path),
        Identify => crate::identify::keys::GIVEN.contains(&key.path),
        Drop | SpinUp | Torque | Rotor | Machine | CoastDown => false,
    }
}

/// Keys that name files beside the scenario.
pub fn names_files(key: &Key) -> bool {
    let all = crate::signals::keys::FILES
        .iter()
        .chain(crate::identify::keys::FILES)
        .chain(&[
            crate::drop::base::FILE,
            "rotor.force.file",
            "levitation.controller.fmu",
        ]);
    all.into_iter().any(|path| *path == key.path)
}

#[rustfmt::skip]
const RUN_SECTIONS: &[Section] = &[Section::new("run", "The simulation.", MOVING)];

#[rustfmt::skip]
const HEAD: &[Key] = &[
    Key::new("format", Kind::Word(&[FORMAT]), FORMAT, "Format and version of this file."),
    Key::new("system", Kind::Word(SystemName::WORDS), "drop", "What is simulated: drop, a levitated rotor that is released onto its auxiliary bearing; spin_up, an inner race that is brought to speed; torque, the torque of a bearing without motion; signals, speed and torque from a measurement; rig, a test on a rig with the raw file of its logger; identify, what measured tests show of a bearing; rotor, modes, critical speeds and response of a flexible rotor; machine, a flexible rotor that is released onto its auxiliary bearings; coast_down, a rotor that coasts down on its warming auxiliary bearings."),
    Key::new("title", Kind::Text, "Test rotor at full speed", "Title of the report.").optional("the report is titled by the file name"),
    Key::new("description", Kind::Text, "What was changed, and why", "Text for the report.").optional("the report has no introduction"),
    Key::new("catalogue", Kind::Text, "my_bearings.toml", "File with your own bearings, relative to this one; they are added to the catalogue, or replace those of the same name.")
        .optional("the built-in catalogue alone is used").only(WITH_BEARING),
    Key::new("planes", Kind::Count, "2", "Number of equal rows of an [[auxiliary_bearing]] at its node, such as 2 of a duplex pair. They share each force equally, so that one of them is computed: rotor and energies count it so many times; contact, mount, bearing, heat and the results of the bearing are those of one row, but for the heats of a coast-down, which are of all.")
        .within(Range::FromTo(1.0, 16.0)).default("1", "the bearing is one row").only(COASTING_DOWN),
];

#[rustfmt::skip]
const RUN: &[Key] = &[
    Key::new("run.duration", Kind::Quantity("s"), "0.5 s", "Simulated time. Time 0 is the release of a rotor that drops, or the start of a drive.")
        .positive().default("0.5 s", "long enough for the first impacts and the spin-up of a small inner race"),
    Key::new(CASE, Kind::Text, "axis lost", "Which of the cases that [[event]] and [base] name happens; what names none happens in each.")
        .optional("the first that the file names").only(MACHINE),
    Key::new("run.until", Kind::Word(Until::WORDS), "standstill", "duration: the run ends at run.duration. standstill: once the rotor has rolled for 20 turns of every cage it coasts down on bearings that warm, until it stands.")
        .default("duration", "a drop decides itself in its first second").only(FALLING),
    Key::new("run.accuracy", Kind::Word(Accuracy::WORDS), "screening", "design: the energy ledger closes to a millionth of what is turned over. screening: for ensembles and long runs, several times quicker; means within some 1e-4 of those of design, the ledger within 2e-4.")
        .default("design", "numbers that a design may rest on").only(STEPPED),
    Key::new("run.tolerance", Kind::Coefficient, "1e-4", "Allowed error of a step, relative to each channel's own scale, such as a clearance, the full speed and the energy turned over.")
        .within(Range::FromTo(1e-12, 1e-1)).optional("1e-4, by linearly implicit steps 2e-4, of a spin-up 5e-5, where the rotor bends 2e-5; at screening accuracy 3e-2 by linearly implicit steps, of a spin-up 2e-3, where the rotor has modes above 20000 rad/s 3e-3; 1e-2 by explicit ones"),
    Key::new("run.output_interval", Kind::Quantity("s"), "0.1 ms", "Time between rows of the history. Peaks and instants do not depend on it.")
        .positive().default("0.1 ms", "5000 rows for the default duration"),
    Key::new("run.largest_step", Kind::Quantity("s"), "1 ms", "Largest step of the time integration.")
        .positive().default("1 ms", "short against a fall through a usual air clearance and against a spin-up"),
    Key::new("run.method", Kind::Word(Method::WORDS), "auto", "Time integration: explicit steps are bound by stability, implicit ones are not; auto takes implicit steps at screening accuracy, and of a drop where sliding friction is too stiff for explicit ones.")
        .default("auto", "the quicker one at equal error, judged by the friction rate of a ball in the first impact; of a spin-up by its accuracy").only(STEPPED),
];
