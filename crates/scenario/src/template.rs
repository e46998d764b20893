//! The commented starting file, written from the table of keys.

use crate::key::{Condition, Key, Otherwise, Presence, quoted};
use crate::rotor::keys::{PARTS, kind_within};
use crate::several::{AUXILIARY_BEARING, LIMIT};
use crate::system::{RIG, SystemName};
use crate::table;

/// What differs most from machine to machine and stands on no drawing: left as it is it counts as assumed.
const EXAMPLES: &[&str] = &[
    "rotor.polar_inertia",
    "mount.stiffness",
    "mount.damping",
    "mount.moving_mass",
];
/// The commented starting file of a study.
const STUDY_TEMPLATE: &str = include_str!("study.toml");
/// The kind of a study, which is no system.
pub const STUDY: &str = "study";
/// Reason of a value that a starting file has as an example.
pub const LEFT: &str = "example of the starting file";
/// Width of a comment line.
const WIDTH: usize = 100;

/// The commented starting file of a kind; `None` for a kind that is not built yet. It reads without a problem.
pub fn template(kind: &str) -> Option<String> {
    if kind == STUDY {
        return Some(STUDY_TEMPLATE.to_string());
    }
    let system = SystemName::of(kind)?;
    let about = system.about();
    let mut out = String::new();
    comment(
        &mut out,
        &format!(
            "{about} Replace the examples by your machine. A value is a text with a unit, or a table that says where it comes from:"
        ),
    );
    out.push_str("#   mass = { value = \"8 kg\", source = \"drawing 4711\" }\n");
    out.push_str("#   mass = { value = \"8 kg\", assumed = \"not weighed yet\" }\n");
    comment(
        &mut out,
        "A line that starts with # is not read. Such lines show each default, or an example where there is none.",
    );
    out.push('\n');
    let mut section = "";
    for key in table::keys_of(system) {
        if key.section() != section {
            section = key.section();
            if let Some(section) = table::sections().find(|known| known.path == section) {
                comment(&mut out, section.doc);
            }
            out.push_str(&format!("[{section}]\n\n"));
        }
        describe(&mut out, key, system);
    }
    if system.has_shaft() {
        describe_parts(&mut out, system);
    }
    if system.bends() {
        describe_bearings(&mut out);
    }
    limit_example(&mut out, system);
    Some(out.trim_end().to_string() + "\n")
}

/// Parts of a flexible rotor: the keys of each kind once, and the parts of the example.
fn describe_parts(out: &mut String, system: SystemName) {
    for kind in PARTS.iter().filter(|kind| system.has_part(kind.word)) {
        comment(out, kind.doc);
        let given = |part: &[(&str, &str)], key: &Key| {
            let own = part.iter().find(|(name, _)| *name == key.name());
            own.map(|(_, text)| format!("{} = {}", key.name(), key.literal(text)))
        };
        let first = kind.starting.first().copied().unwrap_or_default();
        out.push_str(&format!(
            "{}[[{}]]\n\n",
            if first.is_empty() { "# " } else { "" },
            kind.path()
        ));
        for key in kind.keys {
            describe_as(out, key, system, given(first, key));
        }
        for part in kind.starting.iter().skip(1) {
            out.push_str(&format!("[[{}]]\n", kind.path()));
            for line in kind.keys.iter().filter_map(|key| given(part, key)) {
                out.push_str(&format!("{line}\n"));
            }
            out.push('\n');
        }
    }
}

/// The auxiliary bearings of the example, at the nodes of its rotor.
fn describe_bearings(out: &mut String) {
    let doc = "Auxiliary bearings, each at a node of the rotor. What they have in common stands above, what differs below each: any key of [contact], [mount] and [bearing].";
    comment(out, doc);
    for node in ["drive_end", "other_end"] {
        out.push_str(&format!(
            "[[{AUXILIARY_BEARING}]]\nname = {0}\n[{AUXILIARY_BEARING}.contact]\nnode = {0}\n\n",
            quoted(node)
        ));
    }
}

/// What results must hold stands at the end, as lines that are not read.
fn limit_example(out: &mut String, system: SystemName) {
    comment(
        out,
        "Limits that the results must hold, as many as you like, each with a verdict: name of a result, most or least.",
    );
    let (quantity, bound) = system.limit_example();
    out.push_str(&format!(
        "# [[{LIMIT}]]\n# quantity = \"{quantity}\"\n# {bound}\n"
    ));
    if system.falls() {
        out.push_str("# share = 0.95 # of repeated runs; without it all of them\n");
    }
}

fn describe(out: &mut String, key: &Key, system: SystemName) {
    describe_as(out, key, system, None);
}

/// A key with its words; with a line of its own in the place of its example, which is then read.
fn describe_as(out: &mut String, key: &Key, system: SystemName, own: Option<String>) {
    let mut doc = key.doc.to_string();
    let conditions: Vec<String> = key
        .when
        .iter()
        .filter(|condition| choice(condition, system))
        .map(Condition::text)
        .collect();
    if !conditions.is_empty() {
        doc.push_str(&format!(" Only with {}.", conditions.join(" and ")));
    }
    let example = match key.path {
        "system" => system.word(),
        // Without preload and law the balls of a light test hardly touch: it would show nothing.
        "bearing.operating_diametral_clearance" if RIG.contains(&system) => "-4 um",
        // fits the shaft of the example
        "bearing.name" if system.bends() => "6008",
        _ => key.example,
    };
    let holds = key.when.iter().all(|condition| holds(condition, system));
    let line = |text: &str| format!("{} = {}", key.name(), key.literal(text));
    let (active, text) = match table::presence(key, system) {
        Presence::Required if EXAMPLES.contains(&key.path) => {
            let value = key.literal(example);
            let text = format!(
                "{} = {{ value = {value}, assumed = \"{LEFT}\" }}",
                key.name()
            );
            (holds, text)
        }
        // each bearing says it where it is named
        Presence::Required => (holds && key.path != "contact.node", line(example)),
        Presence::FromBearing => {
            doc.push_str(" Not needed with a bearing.name that the catalogue knows.");
            // the starting file names a bearing: dimensions of an example would be those of another one once the name changes
            (false, line(key.example))
        }
        Presence::Optional(meaning) => {
            doc.push_str(&format!(" Without it {meaning}."));
            (holds && table::starts_with(key, system), line(example))
        }
        Presence::Derived(how) => {
            doc.push_str(&format!(" Without it: {how}."));
            (holds && table::starts_with(key, system), line(key.example))
        }
        Presence::Default(_) if table::starts_with(key, system) => (holds, line(example)),
        Presence::Default(fallback) => {
            let mark = if fallback.assumed {
                "assumed"
            } else {
                "default"
            };
            (
                false,
                format!("{} # {mark}: {}", line(fallback.text), fallback.reason),
            )
        }
        Presence::DefaultWhen(condition, fallback, otherwise) => {
            let mark = if fallback.assumed {
                "assumed"
            } else {
                "default"
            };
            let rest = match otherwise {
                Otherwise::Required => "required otherwise".to_string(),
                Otherwise::Fallback(fallback) => {
                    format!("otherwise {}: {}", fallback.text, fallback.reason)
                }
            };
            doc.push_str(&format!(" Default with {}; {rest}.", condition.text()));
            (
                false,
                format!("{} # {mark}: {}", line(fallback.text), fallback.reason),
            )
        }
    };
    comment(out, &doc);
    let of_part = own.is_some() || kind_within(key.path).is_some() && system.has_shaft();
    let active = if of_part { own.is_some() } else { active };
    let text = own.unwrap_or(text);
    out.push_str(if active { "" } else { "# " });
    out.push_str(&text);
    out.push_str("\n\n");
}

/// Whether the system has the choice that a condition speaks of.
fn choice(condition: &Condition, system: SystemName) -> bool {
    table::keys_of(system).any(|key| key.path == condition.path)
}

/// Whether a condition holds with the examples and defaults of the starting file.
fn holds(condition: &Condition, system: SystemName) -> bool {
    let Some(key) = table::keys_of(system).find(|key| key.path == condition.path) else {
        return true;
    };
    let value = match table::presence(key, system) {
        Presence::Required => key.example,
        _ if table::starts_with(key, system) => key.example,
        Presence::Default(fallback) => fallback.text,
        Presence::FromBearing
        | Presence::Optional(_)
        | Presence::Derived(_)
        | Presence::DefaultWhen(..) => return false,
    };
    condition.values.contains(&value) && key.when.iter().all(|condition| holds(condition, system))
}

/// Writes a text as comment lines of limited width.
fn comment(out: &mut String, text: &str) {
    let mut line = String::from("#");
    for word in text.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            out.push_str(&line);
            out.push('\n');
            line = String::from("#");
        }
        line.push(' ');
        line.push_str(word);
    }
    out.push_str(&line);
    out.push('\n');
}
