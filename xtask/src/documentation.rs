//! Guard: every law says where it comes from and where it holds. That public items have a sentence at all is a lint of the compiler.

use crate::repository::{Outcome, Repository};
use crate::source_text::is_word;

/// Scans the crate that holds the laws.
pub fn check(repository: &Repository) -> Outcome {
    let mut findings = Vec::new();
    let mut count = 0;
    for file in repository.below("crates/physics/src/", ".rs") {
        let text = repository.text(file).unwrap_or_default();
        for law in laws(&text) {
            count += 1;
            let place = format!("{file}:{}: fn {}", law.line, law.name);
            findings.extend(faults(&law).map(|what| format!("{place}: {what}")));
        }
    }
    Outcome::new(format!("{count} laws"), findings)
}

/// A public function with the lines of its doc comment.
struct Law {
    line: usize,
    name: String,
    doc: Vec<String>,
}

fn faults(law: &Law) -> impl Iterator<Item = String> {
    let labels = ["Source:", "Valid:"].into_iter();
    let missing = labels.filter(|label| !says(&law.doc, label));
    missing.map(|label| format!("has no line `{label} …`"))
}

/// Whether a doc line starts with the label and goes on, there or in the next line.
fn says(doc: &[String], label: &str) -> bool {
    doc.iter().enumerate().any(|(at, line)| {
        line.strip_prefix(label).is_some_and(|rest| {
            !rest.trim().is_empty() || doc.get(at + 1).is_some_and(|next| !next.is_empty())
        })
    })
}

/// The public functions of a file. Tests are its end, which a lint of clippy asks for.
fn laws(source: &str) -> Vec<Law> {
    let tests = source.find("\n#[cfg(test)]\nmod ");
    let lines: Vec<&str> = source[..tests.unwrap_or(source.len())].lines().collect();
    let named = lines.iter().enumerate();
    let named = named.filter_map(|(at, line)| Some((at, declared(line)?)));
    let law = |(at, name): (usize, &str)| Law {
        line: at + 1,
        name: name.to_owned(),
        doc: doc_above(at, &lines),
    };
    named.map(law).collect()
}

/// Name of the function that a line declares as public.
fn declared(line: &str) -> Option<&str> {
    let words = line.trim_start().strip_prefix("pub ")?.split_whitespace();
    let before = ["const", "unsafe", "async", "extern"];
    let mut words = words.skip_while(|word| before.contains(word));
    let rest = (words.next()? == "fn").then(|| words.next())??;
    let name = &rest[..rest.find(|c| !is_word(c)).unwrap_or(rest.len())];
    (!name.is_empty()).then_some(name)
}

/// The doc comment above a line, attributes passed over.
fn doc_above(item: usize, lines: &[&str]) -> Vec<String> {
    let mut doc = Vec::new();
    let mut at = item;
    while at > 0 {
        at -= 1;
        let text = lines[at].trim();
        if let Some(line) = text.strip_prefix("///") {
            doc.push(line.trim().to_owned());
        } else if text.ends_with(']') && !text.starts_with("#[") {
            // The last line of an attribute written over several lines.
            while at > 0 && !lines[at].trim().starts_with("#[") {
                at -= 1;
            }
        } else if !text.starts_with("//") && !text.starts_with("#[") {
            break;
        }
    }
    doc.reverse();
    doc
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(source: &str) -> Vec<String> {
        let of = |law: &Law| -> Vec<String> {
            let faults = faults(law);
            faults.map(|what| format!("{} {what}", law.name)).collect()
        };
        laws(source).iter().flat_map(of).collect()
    }

    const LAW: &str = "/// Friction.\n///\n/// Source: Coulomb 1785.\n/// Valid: dry, slow.\n#[inline]\n#[allow(\n    dead_code\n)]\npub fn friction(x: f64) -> f64 {\n    x\n}\n";

    #[test]
    fn a_complete_law_is_fine() {
        assert_eq!(found(LAW), Vec::<String>::new());
    }

    #[test]
    fn each_missing_line_is_found() {
        let source = "friction has no line `Source: …`";
        assert_eq!(found(&LAW.replace("Source:", "From")), [source]);
        let valid = "friction has no line `Valid: …`";
        let empty = LAW.replace("/// Valid: dry, slow.", "/// Valid:");
        assert_eq!(found(&empty), [valid]);
        assert_eq!(found("pub const fn bare() {}").len(), 2);
        // The doc of the item above does not count for the next one.
        let next = found(&format!("{LAW}pub fn next() {{}}"));
        assert_eq!(next[0], "next has no line `Source: …`");
        assert_eq!(next.len(), 2);
    }

    #[test]
    fn functions_of_a_type_are_laws_too_and_types_are_none() {
        let source = "/// A part.\npub struct Part;\nimpl Part {\n    /// Makes one.\n    pub fn new() -> Self {\n        Part\n    }\n}\n";
        assert_eq!(found(source).len(), 2);
        assert!(found("#[derive(Clone)]\npub enum Kind {}").is_empty());
    }

    #[test]
    fn tests_and_private_items_are_passed_over() {
        let source = "pub(crate) fn inner() {}\nfn own() {}\n#[cfg(test)]\nmod tests {\n    pub fn probe() {}\n}\n";
        assert_eq!(found(source), Vec::<String>::new());
    }
}
