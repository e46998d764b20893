//! The resolved scenario: every value with its origin, and as a file that gives the same run.

use crate::problem::Place;
use crate::scenario::key::{Key, quoted};
use crate::scenario::provenance::Provenance;
use crate::scenario::table;

/// One value of a resolved scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct ResolvedValue {
    /// Dotted path of the key.
    pub path: &'static str,
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

/// All values of a scenario, in the order of the table of keys.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// The values.
    pub values: Vec<ResolvedValue>,
}

impl Resolved {
    /// The value of a key.
    pub fn get(&self, path: &str) -> Option<&ResolvedValue> {
        self.values.iter().find(|value| value.path == path)
    }

    /// The scenario file with every value written out. Reading it gives the same numbers bit for bit.
    ///
    /// Derived values stand as comments, so that they follow the values they come from when those are changed. Defaults and
    /// values of the catalogue say so (`from = …`), and are read as such as long as they are not changed.
    pub fn toml(&self) -> String {
        let mut out =
            String::from("# Resolved scenario: every value of the run and where it comes from.\n");
        let mut section = "";
        for value in &self.values {
            let Some(key) = table::keys().find(|key| key.path == value.path) else {
                continue;
            };
            if key.section() != section {
                section = key.section();
                out.push_str(&format!("\n[{section}]\n"));
            }
            out.push_str(&line(key, value));
            out.push('\n');
        }
        out
    }
}

fn line(key: &Key, value: &ResolvedValue) -> String {
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
