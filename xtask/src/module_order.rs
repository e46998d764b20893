//! Guard: inside the crate `auxbear` each module uses only those before it.

use crate::repository::{Outcome, Repository};
use crate::rust_text::{code_only, is_word};

const SOURCE: &str = "crates/auxbear/src/";

/// The modules in their order; each may use those to its left.
const ORDER: [&str; 10] = [
    "scenario", "options", "result", "simulate", "analyse", "evaluate", "run", "study", "report",
    "import",
];

/// Scans every file of every module.
pub fn check(repository: &Repository) -> Outcome {
    let mut findings = Vec::new();
    let mut modules = Vec::new();
    for file in repository.below(SOURCE, ".rs") {
        let inner = &file[SOURCE.len()..];
        if inner == "lib.rs" {
            continue;
        }
        let module = module_of(inner);
        if !modules.contains(&module) {
            modules.push(module);
            if !ORDER.contains(&module) {
                findings.push(format!(
                    "{file}: module {module} has no place in the order {}",
                    ORDER.join(" -> ")
                ));
            }
        }
        let text = repository.text(file).unwrap_or_default();
        findings.extend(
            scan(inner, &text)
                .into_iter()
                .map(|(line, what)| format!("{file}:{line}: {what}")),
        );
    }
    Outcome::new(format!("{} modules in auxbear", modules.len()), findings)
}

fn module_of(inner: &str) -> &str {
    let first = inner.split('/').next().unwrap_or(inner);
    first.strip_suffix(".rs").unwrap_or(first)
}

/// How many `super::` lead from the top of this file to the crate root.
fn depth_of(inner: &str) -> usize {
    let folders = inner.split('/').count();
    if inner.ends_with("/mod.rs") {
        folders - 1
    } else {
        folders
    }
}

/// Lines of one file, named from `src/`, that name a module to the right of their own.
fn scan(inner: &str, source: &str) -> Vec<(usize, String)> {
    let Some(own) = ORDER.iter().position(|name| *name == module_of(inner)) else {
        return Vec::new();
    };
    let code = code_only(source);
    let root = "super::".repeat(depth_of(inner));
    let mut found = Vec::new();
    for start in ["crate::", root.as_str()] {
        for (at, _) in code.match_indices(start) {
            let inside_a_path = code[..at]
                .chars()
                .next_back()
                .is_some_and(|before| is_word(before) || before == ':' || before == '$');
            if inside_a_path {
                continue;
            }
            let line = code[..at].matches('\n').count() + 1;
            for name in first_names(&code[at + start.len()..]) {
                let used = ORDER.iter().position(|module| *module == name);
                if used.is_some_and(|used| used > own) {
                    found.push((
                        line,
                        format!("{} may not use {name}: it comes later", ORDER[own]),
                    ));
                }
            }
        }
    }
    found.sort();
    found
}

/// The names a path may go on with: one, or each of a braced group.
fn first_names(rest: &str) -> Vec<&str> {
    let rest = rest.trim_start();
    let Some(group) = rest.strip_prefix('{') else {
        return vec![leading_name(rest)];
    };
    let mut names = Vec::new();
    let mut depth = 0_usize;
    let mut begin = 0;
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                names.push(leading_name(group[begin..at].trim_start()));
                begin = at + 1;
                if c == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    names
}

fn leading_name(text: &str) -> &str {
    let end = text.find(|c| !is_word(c)).unwrap_or(text.len());
    &text[..end]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(inner: &str, source: &str) -> Vec<usize> {
        scan(inner, source)
            .into_iter()
            .map(|(line, _)| line)
            .collect()
    }

    #[test]
    fn a_later_module_is_found_in_any_form() {
        assert_eq!(lines("scenario.rs", "use crate::simulate::Run;"), [1]);
        assert_eq!(
            lines("scenario/read.rs", "\nlet r = crate::report::html();"),
            [2]
        );
        assert_eq!(
            lines(
                "scenario.rs",
                "use crate::{\n    scenario::{BuiltIn, Scenario},\n    run,\n};"
            ),
            [1]
        );
        assert_eq!(lines("scenario.rs", "use super::import;"), [1]);
        assert_eq!(lines("scenario/read.rs", "use super::super::import;"), [1]);
        assert_eq!(lines("scenario/mod.rs", "use super::import;"), [1]);
    }

    #[test]
    fn earlier_modules_own_module_and_comments_are_fine() {
        let source = "use crate::problem::Code;\nuse crate::simulate::Run;\n// crate::report\nlet s = \"crate::report\";";
        assert_eq!(lines("simulate/run.rs", source), Vec::<usize>::new());
        // One step up from a child is the own module, not the crate.
        assert_eq!(
            lines("scenario/read.rs", "use super::report;"),
            Vec::<usize>::new()
        );
        assert_eq!(
            lines("scenario.rs", "use other::crate::report;"),
            Vec::<usize>::new()
        );
    }
}
