//! Guard: every law says where it comes from and where it holds; every public item has a sentence.

use crate::repository::{Outcome, Repository};
use crate::rust_text::{code_only, is_word, without_tests};

/// Scans the crates that hold laws and parts.
pub fn check(repository: &Repository) -> Outcome {
    let mut findings = Vec::new();
    let mut laws = 0;
    let mut items = 0;
    for (folder, holds_laws) in [("crates/physics/src/", true), ("crates/model/src/", false)] {
        for file in repository.below(folder, ".rs") {
            let text = repository.text(file).unwrap_or_default();
            for item in public_items(&text) {
                items += 1;
                laws += usize::from(holds_laws && item.kind == "fn");
                findings.extend(faults(&item, holds_laws).into_iter().map(|what| {
                    format!("{file}:{}: {} {}: {what}", item.line, item.kind, item.name)
                }));
            }
        }
    }
    Outcome::new(format!("{items} public items, {laws} laws"), findings)
}

/// A public item with the lines of its doc comment.
struct Item {
    line: usize,
    kind: &'static str,
    name: String,
    doc: Vec<String>,
}

fn faults(item: &Item, holds_laws: bool) -> Vec<String> {
    if item.doc.iter().all(|line| line.is_empty()) {
        return vec!["has no doc comment".to_owned()];
    }
    if !holds_laws || item.kind != "fn" {
        return Vec::new();
    }
    ["Source:", "Valid:"]
        .into_iter()
        .filter(|label| !says(&item.doc, label))
        .map(|label| format!("has no line `{label} …`"))
        .collect()
}

/// Whether a doc line starts with the label and goes on, there or in the next line.
fn says(doc: &[String], label: &str) -> bool {
    doc.iter().enumerate().any(|(at, line)| {
        line.strip_prefix(label).is_some_and(|rest| {
            !rest.trim().is_empty() || doc.get(at + 1).is_some_and(|next| !next.is_empty())
        })
    })
}

/// The public functions and types of a file, tests aside.
fn public_items(source: &str) -> Vec<Item> {
    let code = without_tests(&code_only(source));
    let code: Vec<&str> = code.lines().collect();
    let source: Vec<&str> = source.lines().collect();
    let mut items = Vec::new();
    for (at, line) in code.iter().enumerate() {
        if let Some((kind, name)) = declared(line) {
            items.push(Item {
                line: at + 1,
                kind,
                name: name.to_owned(),
                doc: doc_above(at, &code, &source),
            });
        }
    }
    items
}

/// Kind and name of what a line declares as public; names made by a macro are left to the compiler's own lint.
fn declared(line: &str) -> Option<(&'static str, &str)> {
    let mut words = line.trim_start().strip_prefix("pub ")?.split_whitespace();
    loop {
        let kind = match words.next()? {
            "const" | "unsafe" | "async" | "extern" => continue,
            "fn" => "fn",
            "struct" => "struct",
            "enum" => "enum",
            "trait" => "trait",
            "union" => "union",
            _ => return None,
        };
        let rest = words.next()?;
        let name = &rest[..rest.find(|c| !is_word(c)).unwrap_or(rest.len())];
        return (!name.is_empty()).then_some((kind, name));
    }
}

/// The doc comment above a line, attributes passed over.
fn doc_above(item: usize, code: &[&str], source: &[&str]) -> Vec<String> {
    let mut doc = Vec::new();
    let mut at = item;
    while at > 0 {
        at -= 1;
        let text = source[at].trim();
        let bare = code[at].trim();
        if let Some(line) = text.strip_prefix("///") {
            doc.push(line.trim().to_owned());
        } else if bare.ends_with(']') && !bare.starts_with("#[") {
            // The last line of an attribute written over several lines.
            while at > 0 && !code[at].trim().starts_with("#[") {
                at -= 1;
            }
        } else {
            let is_comment = bare.is_empty() && text.starts_with("//");
            if !is_comment && !bare.starts_with("#[") {
                break;
            }
        }
    }
    doc.reverse();
    doc
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(source: &str, holds_laws: bool) -> Vec<String> {
        public_items(source)
            .iter()
            .flat_map(|item| {
                faults(item, holds_laws)
                    .into_iter()
                    .map(|what| format!("{} {}", item.name, what))
            })
            .collect()
    }

    const LAW: &str = "/// Friction.\n///\n/// Source: Coulomb 1785.\n/// Valid: dry, slow.\n#[inline]\n#[allow(\n    dead_code\n)]\npub fn friction(x: f64) -> f64 {\n    x\n}\n";

    #[test]
    fn a_complete_law_is_fine() {
        assert_eq!(found(LAW, true), Vec::<String>::new());
    }

    #[test]
    fn each_missing_line_is_found() {
        assert_eq!(
            found(&LAW.replace("Source:", "From"), true),
            ["friction has no line `Source: …`"]
        );
        assert_eq!(
            found(&LAW.replace("/// Valid: dry, slow.", "/// Valid:"), true),
            ["friction has no line `Valid: …`"]
        );
        assert_eq!(
            found("pub const fn bare() {}", true),
            ["bare has no doc comment"]
        );
        // The doc of the item above does not count for the next one.
        assert_eq!(
            found(&format!("{LAW}pub fn next() {{}}"), true),
            ["next has no doc comment"]
        );
    }

    #[test]
    fn only_laws_need_source_and_range() {
        let source = "/// A part.\npub struct Part;\nimpl Part {\n    /// Makes one.\n    pub fn new() -> Self {\n        Part\n    }\n}\n";
        assert_eq!(found(source, false), Vec::<String>::new());
        assert_eq!(found(source, true).len(), 2);
        assert_eq!(
            found("#[derive(Clone)]\npub enum Kind {}", false),
            ["Kind has no doc comment"]
        );
    }

    #[test]
    fn tests_strings_and_private_items_are_passed_over() {
        let source = "const TEXT: &str = \"\npub fn text() {}\n\";\npub(crate) fn inner() {}\nfn own() {}\n#[cfg(test)]\nmod tests {\n    pub fn probe() {}\n}\n";
        assert_eq!(found(source, true), Vec::<String>::new());
    }
}
