//! The resolved scenario: every value with its origin, and as a file that gives the same run.

use crate::key::{Key, Kind, quoted};
use crate::several::{self, AUXILIARY_BEARING, VARY};
use crate::table;
use crate::vary::Vary;
use problem::Place;
use problem::provenance::Provenance;
use problem::value::Known;

/// One value of a resolved scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct ResolvedValue {
    /// Dotted path of the key.
    pub path: &'static str,
    /// Name of the auxiliary bearing that it belongs to, where there are several.
    pub bearing: Option<String>,
    /// The value as written, with its unit; `None` for what is not given or is derived when the run starts.
    pub text: Option<String>,
    /// The value in SI, where it is a number.
    pub value_si: Option<f64>,
    /// SI unit; empty for what has none.
    pub unit: String,
    /// Where it comes from.
    pub provenance: Provenance,
    /// Where it stands in the input.
    pub place: Place,
}

impl ResolvedValue {
    /// Whether machines that differ in it are of different kinds: a word, a switch, a text, a count, or whether it is given.
    pub fn is_of_kind(&self) -> bool {
        let counted = || table::key(self.path).is_some_and(|key| matches!(key.kind, Kind::Count));
        !self.path.starts_with("repeat.") && (self.value_si.is_none() || counted())
    }
    /// The path as the file has it: `auxiliary_bearing.drive_end.bearing.name`.
    pub fn shown(&self) -> String {
        several::path_of(self.bearing.as_deref(), self.path)
    }
}

/// All values of a scenario, in the order of the table of keys.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// The values.
    pub values: Vec<ResolvedValue>,
    /// What `[vary]` says, a line each.
    vary: Vec<String>,
    /// What results must hold, and measured channels, a table each.
    tables: Vec<String>,
    /// Parts of a flexible rotor, a table each, with its values by their paths.
    parts: Vec<(String, Vec<(String, Known)>)>,
}

impl Resolved {
    pub(crate) fn new(values: Vec<ResolvedValue>) -> Resolved {
        Resolved {
            values,
            vary: Vec::new(),
            tables: Vec::new(),
            parts: Vec::new(),
        }
    }
    /// The same with the parts of a flexible rotor, each as a file has it, and its values.
    pub fn of_parts(mut self, parts: Vec<(String, Vec<(String, Known)>)>) -> Resolved {
        self.parts = parts;
        self
    }
    /// The values of all parts of a flexible rotor by their paths, such as `rotor.unbalance.wheel.amount`.
    pub fn of_all_parts(&self) -> impl Iterator<Item = (&str, &Known)> {
        let values = self.parts.iter().flat_map(|(_, values)| values);
        values.map(|(path, known)| (path.as_str(), known))
    }
    /// Those of them that are assumed.
    pub fn assumed_of_parts(&self) -> impl Iterator<Item = (&str, &Known)> {
        let values = self.of_all_parts();
        values.filter(|(_, known)| known.provenance.mark() == "assumed")
    }
    /// The same with tables of a list, each as a file has it: what results must hold, measured channels.
    pub fn listed(mut self, tables: impl Iterator<Item = String>) -> Resolved {
        self.tables.extend(tables);
        self
    }
    /// The same with what repeated runs vary; what the keys of `[repeat]` say stands there.
    pub fn varied(mut self, vary: &[Vary]) -> Resolved {
        let own = vary.iter().filter(|one| !one.by_repeat);
        self.vary = own.map(Vary::toml).collect();
        self
    }
    /// The value of a key, of the first where several auxiliary bearings have it.
    pub fn get(&self, path: &str) -> Option<&ResolvedValue> {
        self.values.iter().find(|value| value.path == path)
    }

    /// The value of a key of an auxiliary bearing; its name is empty where it is the only one.
    pub fn of_bearing(&self, bearing: &str, path: &str) -> Option<&ResolvedValue> {
        let of = |value: &&ResolvedValue| {
            value.path == path && value.bearing.as_ref().is_none_or(|name| name == bearing)
        };
        self.values.iter().find(of)
    }

    /// The scenario file with every value written out. Reading it gives the same numbers bit for bit.
    ///
    /// Derived values stand as comments, so that they follow the values they come from when those are changed. Defaults and
    /// values of the catalogue say so (`from = …`), and are read as such as long as they are not changed.
    pub fn toml(&self) -> String {
        let mut out =
            String::from("# Resolved scenario: every value of the run and where it comes from.\n");
        let mut section = "";
        let mut bearing = None;
        for value in &self.values {
            if value.bearing != bearing {
                bearing.clone_from(&value.bearing);
                section = "";
                if let Some(name) = &bearing {
                    out.push_str(&format!(
                        "\n[[{AUXILIARY_BEARING}]]\nname = {}\n",
                        quoted(name)
                    ));
                }
            }
            let Some(key) = table::key(value.path) else {
                continue;
            };
            if key.section() != section {
                section = key.section();
                let of = bearing
                    .as_ref()
                    .map_or(String::new(), |_| format!("{AUXILIARY_BEARING}."));
                out.push_str(&format!("\n[{of}{section}]\n"));
            }
            out.push_str(&line(key, value));
            out.push('\n');
        }
        for (part, _) in &self.parts {
            out.push_str(&format!("\n{part}"));
        }
        if !self.vary.is_empty() {
            out.push_str(&format!("\n[{VARY}]\n{}\n", self.vary.join("\n")));
        }
        for table in &self.tables {
            out.push_str(&format!("\n{table}"));
        }
        out
    }
}

pub(crate) fn line(key: &Key, value: &ResolvedValue) -> String {
    let name = key.name();
    let Some(text) = &value.text else {
        let note = comment(&value.provenance.note());
        let mark = match value.provenance {
            Provenance::Derived(_) => "derived: ",
            _ => "",
        };
        return format!("# {name}: {mark}{note}");
    };
    let literal = key.literal(text);
    let table = |word: &str, why: &str| {
        format!("{name} = {{ value = {literal}, {word} = {} }}", quoted(why))
    };
    let filled = |word: &str, why: &str, from: &str| {
        let why = quoted(why);
        format!("{name} = {{ value = {literal}, {word} = {why}, from = \"{from}\" }}")
    };
    match &value.provenance {
        Provenance::Given => format!("{name} = {literal}"),
        Provenance::GivenWithSource(source) => table("source", source),
        Provenance::Assumed(why) => table("assumed", why),
        Provenance::Default(reason) => {
            format!("{} # {}", table("from", "default"), comment(reason))
        }
        Provenance::DefaultAssumed(reason) => filled("assumed", reason, "default"),
        Provenance::Catalogue {
            bearing,
            mark,
            source,
        } => {
            let word = if mark == "assumed" {
                "assumed"
            } else {
                "source"
            };
            format!(
                "{} # {}, {}",
                filled(word, source, "catalogue"),
                comment(bearing),
                comment(mark)
            )
        }
        Provenance::Derived(how) => format!("# {name} = {literal} # derived: {}", comment(how)),
    }
}

/// A text that stays in one comment.
fn comment(text: &str) -> String {
    text.chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}
