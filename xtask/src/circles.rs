//! Guard: no files of a crate use each other in a circle.
//!
//! Seen are paths that begin with `crate`, `self` or `super`, or with a module of the own folder, in `use` and in code. What a
//! page hands on by `pub use` counts as taken from where it stands. Tests are not seen: they may look anywhere.

use crate::repository::{Outcome, Repository};
use crate::rust_text::{code_only, is_word, without_tests};
use std::collections::{BTreeMap, BTreeSet};

type Module = Vec<String>;

/// Looks at every crate.
pub fn check(repository: &Repository) -> Outcome {
    let mut findings = Vec::new();
    let mut seen = 0;
    let roots: BTreeSet<String> = (repository.below("", ".rs"))
        .filter_map(|file| Some(format!("{}src/", file.split_once("src/")?.0)))
        .collect();
    for root in &roots {
        let mut modules: BTreeMap<Module, String> = BTreeMap::new();
        for file in repository.below(root, ".rs") {
            let module = module_of(&file[root.len()..]);
            if module.last().is_some_and(|name| name == "tests") {
                continue;
            }
            let text = repository.text(file).unwrap_or_default();
            modules.insert(module, without_tests(&code_only(&text)));
        }
        seen += modules.len();
        for circle in circles(&modules) {
            let names: Vec<String> = circle.iter().map(|module| module.join("::")).collect();
            findings.push(format!("{root}: a circle of {}", names.join(", ")));
        }
    }
    Outcome::new(format!("{seen} files"), findings)
}

fn module_of(inner: &str) -> Module {
    let path = inner.trim_end_matches(".rs");
    let mut parts: Module = path.split('/').map(str::to_owned).collect();
    let last = parts.last().map_or("", String::as_str);
    if last == "mod" || (parts.len() == 1 && (last == "lib" || last == "main")) {
        parts.pop();
    }
    parts
}

/// Every set of files that reach each other.
fn circles(modules: &BTreeMap<Module, String>) -> Vec<Vec<Module>> {
    let names: Vec<&Module> = modules.keys().collect();
    let handed: BTreeMap<&Module, BTreeMap<String, Module>> = (modules.iter())
        .map(|(module, code)| (module, handed_on(modules, module, code)))
        .collect();
    let uses: Vec<BTreeSet<usize>> = (modules.iter())
        .map(|(module, code)| {
            let taken = paths(code, false).into_iter();
            let targets = taken.filter_map(|path| {
                let (target, name) = resolve(modules, module, &path)?;
                let origin = name.and_then(|name| handed[&target].get(&name).cloned());
                let target = origin.unwrap_or(target);
                (target != *module).then(|| names.iter().position(|name| **name == target))?
            });
            targets.collect()
        })
        .collect();
    let reach: Vec<BTreeSet<usize>> = (0..names.len())
        .map(|from| {
            let mut reached = BTreeSet::new();
            let mut open: Vec<usize> = uses[from].iter().copied().collect();
            while let Some(next) = open.pop() {
                if reached.insert(next) {
                    open.extend(&uses[next]);
                }
            }
            reached
        })
        .collect();
    let mut found: BTreeSet<Vec<Module>> = BTreeSet::new();
    for from in 0..names.len() {
        if reach[from].contains(&from) {
            let circle = reach[from].iter().filter(|to| reach[**to].contains(&from));
            found.insert(circle.map(|to| names[*to].clone()).collect());
        }
    }
    found.into_iter().collect()
}

/// What a page hands on by `pub use`: name and where it stands.
fn handed_on(
    modules: &BTreeMap<Module, String>,
    module: &Module,
    code: &str,
) -> BTreeMap<String, Module> {
    let taken = paths(code, true).into_iter();
    taken
        .filter_map(|path| {
            let (target, name) = resolve(modules, module, &path)?;
            Some((name.or_else(|| path.last().cloned())?, target))
        })
        .collect()
}

/// The file that a path leads to, and the name behind it.
fn resolve(
    modules: &BTreeMap<Module, String>,
    own: &Module,
    path: &[String],
) -> Option<(Module, Option<String>)> {
    let mut rest = path;
    let mut at: Module = match path.first()?.as_str() {
        "crate" => {
            rest = &rest[1..];
            Vec::new()
        }
        "self" => {
            rest = &rest[1..];
            own.clone()
        }
        "super" => own.clone(),
        first => {
            let mut child = own.clone();
            child.push(first.to_owned());
            modules.contains_key(&child).then(|| own.clone())?
        }
    };
    while rest.first().is_some_and(|part| part == "super") {
        at.pop()?;
        rest = &rest[1..];
    }
    while let Some(part) = rest.first() {
        let mut child = at.clone();
        child.push(part.clone());
        if !modules.contains_key(&child) {
            break;
        }
        at = child;
        rest = &rest[1..];
    }
    modules
        .contains_key(&at)
        .then(|| (at, rest.first().cloned()))
}

/// Paths of a text: those of `pub use`, or all others, groups in braces one by one.
fn paths(code: &str, handed_on: bool) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let mut rest = code;
    let mut others = String::new();
    while let Some(at) = rest.find("use ") {
        let before = &rest[..at];
        let is_word_of_its_own = !before.chars().next_back().is_some_and(is_word);
        let Some(end) = rest[at..].find(';').filter(|_| is_word_of_its_own) else {
            others.push_str(&rest[..at + 4]);
            rest = &rest[at + 4..];
            continue;
        };
        others.push_str(before);
        let line = before.trim_end();
        let public = line.ends_with("pub") || (line.ends_with(')') && line.contains("pub("));
        let public = public
            && line
                .rfind("pub")
                .is_some_and(|p| !line[p..].contains([';', '}']));
        if public == handed_on {
            expand(&rest[at + 4..at + end], &mut Vec::new(), &mut found);
        }
        rest = &rest[at + end..];
    }
    others.push_str(rest);
    if !handed_on {
        found.extend(in_code(&others));
    }
    found
}

/// The paths of a `use`, groups in braces one by one.
fn expand(text: &str, before: &mut Vec<String>, found: &mut Vec<Vec<String>>) {
    let text = text.trim();
    let (head, group) = match text.split_once('{') {
        Some((head, group)) => (
            head,
            Some(group.trim_end().strip_suffix('}').unwrap_or(group)),
        ),
        None => (text.split(" as ").next().unwrap_or(text), None),
    };
    let length = before.len();
    before.extend(
        head.split("::")
            .map(str::trim)
            .filter(|p| !p.is_empty())
            .map(str::to_owned),
    );
    match group {
        None => found.push(before.clone()),
        Some(group) => {
            let mut depth = 0;
            let mut begin = 0;
            for (at, c) in group.char_indices().chain([(group.len(), ',')]) {
                match c {
                    '{' => depth += 1,
                    '}' => depth -= 1,
                    ',' if depth == 0 => {
                        if !group[begin..at].trim().is_empty() {
                            expand(&group[begin..at], before, found);
                        }
                        begin = at + 1;
                    }
                    _ => {}
                }
            }
        }
    }
    before.truncate(length);
}

/// Paths in code: words with `::` between them.
fn in_code(code: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let mut rest = code;
    while let Some(at) = rest.find("::") {
        let start = rest[..at].rfind(|c| !is_word(c)).map_or(0, |p| {
            p + rest[p..].chars().next().map_or(1, char::len_utf8)
        });
        let leads = rest[..start].chars().next_back();
        let mut path = vec![rest[start..at].to_owned()];
        let mut tail = &rest[at..];
        while let Some(next) = tail.strip_prefix("::") {
            let end = next.find(|c| !is_word(c)).unwrap_or(next.len());
            if end == 0 {
                break;
            }
            path.push(next[..end].to_owned());
            tail = &next[end..];
        }
        if !path[0].is_empty() && leads != Some(':') && leads != Some('$') && path.len() > 1 {
            found.push(path);
        }
        rest = match tail.len() < rest.len() - at {
            true => tail,
            false => &rest[at + 2..],
        };
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(files: &[(&str, &str)]) -> Vec<Vec<Module>> {
        let modules = files
            .iter()
            .map(|(file, code)| (module_of(file), (*code).to_owned()));
        circles(&modules.collect())
    }

    #[test]
    fn files_that_use_each_other_are_found() {
        let two = [
            ("lib.rs", "pub mod a; pub mod b;"),
            ("a.rs", "use crate::b::B;"),
            ("b.rs", "fn f() { super::a::g() }"),
        ];
        assert_eq!(of(&two), [vec![vec!["a".to_owned()], vec!["b".to_owned()]]]);
        let groups = [
            ("a.rs", "use crate::{c::C, b::{B, D}};"),
            ("b.rs", "use super::a;"),
            ("c.rs", ""),
        ];
        assert_eq!(of(&groups).len(), 1);
        // a page and the front of its folder
        let folder = [
            ("a/mod.rs", "mod b; use b::B; pub struct A;"),
            ("a/b.rs", "use super::A;"),
        ];
        assert_eq!(of(&folder).len(), 1);
    }

    #[test]
    fn what_is_handed_on_is_taken_from_where_it_stands() {
        let files = [
            ("a/mod.rs", "pub mod b; pub mod c; pub use b::B; use c::C;"),
            ("a/b.rs", "pub struct B;"),
            ("a/c.rs", "use super::B; pub struct C;"),
        ];
        assert_eq!(of(&files), Vec::<Vec<Module>>::new());
        let other = [
            ("a.rs", "use other::b::B; let x = std::a::b();"),
            ("b.rs", "use crate::a::A;"),
        ];
        assert_eq!(of(&other), Vec::<Vec<Module>>::new());
    }
}
