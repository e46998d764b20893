//! Guard: no advisory of the RustSec database that is listed in `advisories.toml` applies to a version in Cargo.lock, unless its
//! entry says why it is accepted. The list is of one day; `cargo xtask advisories PATH` writes it from a copy of the database.

use crate::repository::{Outcome, Repository};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use toml::{Table, Value};

const LIST: &str = "advisories.toml";
const HEAD: &str = "\
# Advisories of https://github.com/RustSec/advisory-db for packages in Cargo.lock, whatever their version.
# `cargo xtask advisories PATH` writes this file from a copy of that database and keeps `accepted`, and entries that the copy lacks;
# `cargo xtask check` compares it with Cargo.lock, offline. `newest` is the date of the copy's newest advisory.
";
/// Keys of an advisory, in their order; the last two stand only in the list.
const KEYS: [&str; 5] = ["package", "patched", "unaffected", "accepted", "origin"];

/// Versions of the packages from a registry, by name.
type Packages = BTreeMap<String, Vec<String>>;

/// The list: when the newest advisory was made, how many the database had, and those that touch Cargo.lock, by id.
#[derive(Default)]
struct List {
    newest: String,
    looked_at: i64,
    advisories: BTreeMap<String, Table>,
}

/// Compares the list with Cargo.lock.
pub fn check(repository: &Repository) -> Outcome {
    match packages(repository).and_then(|packages| Ok((read(repository)?, packages))) {
        Ok((list, packages)) => Outcome::new(
            format!("{} listed of {}", list.advisories.len(), list.newest),
            findings(&list, &packages),
        ),
        Err(error) => Outcome::new("", vec![error]),
    }
}

/// Writes the list from a copy of the database.
pub fn write(database: &str) -> Result<(), String> {
    let repository = Repository::open()?;
    let packages = packages(&repository)?;
    let old = match repository.text(LIST) {
        Some(_) => read(&repository)?,
        None => List::default(),
    };
    let list = gather(Path::new(database), &packages, old)?;
    repository.write(LIST, &text(&list))?;
    let count = list.advisories.len();
    println!("{LIST}: {count} listed of {}", list.newest);
    for finding in findings(&list, &packages) {
        println!("{finding}");
    }
    Ok(())
}

fn packages(repository: &Repository) -> Result<Packages, String> {
    let lock = repository.text("Cargo.lock").ok_or("Cargo.lock: missing")?;
    let lock = table(&lock)?;
    let mut packages = Packages::new();
    let all = lock.get("package").and_then(Value::as_array);
    for package in all.into_iter().flatten() {
        let word = |key: &str| package.get(key).and_then(Value::as_str);
        if let (Some(name), Some(version), Some(_)) =
            (word("name"), word("version"), word("source"))
        {
            let versions = packages.entry(name.to_owned()).or_default();
            versions.push(version.to_owned());
        }
    }
    Ok(packages)
}

fn table(text: &str) -> Result<Table, String> {
    text.parse()
        .map_err(|error: toml::de::Error| error.to_string())
}

fn read(repository: &Repository) -> Result<List, String> {
    let text = repository.text(LIST).ok_or(format!("{LIST}: missing"))?;
    let all = table(&text).map_err(|error| format!("{LIST}: {error}"))?;
    let wanted = |key: &str| all.get(key).ok_or(format!("{LIST}: no {key}"));
    let own = |(id, value): (&String, &Value)| Some((id.clone(), value.as_table()?.clone()));
    Ok(List {
        newest: wanted("newest")?.as_str().unwrap_or_default().to_owned(),
        looked_at: wanted("looked_at")?.as_integer().unwrap_or_default(),
        advisories: all.iter().filter_map(own).collect(),
    })
}

/// The list of a copy of the database: folders `crates/NAME` with a page for each advisory, whose head is a block of TOML.
fn gather(database: &Path, packages: &Packages, old: List) -> Result<List, String> {
    let mut list = old;
    (list.looked_at, list.newest) = (0, String::new());
    list.advisories
        .retain(|_, own| packages.contains_key(word(own, "package")));
    let folders = entries(&database.join("crates"))?;
    let pages: Result<Vec<_>, String> = folders.iter().map(|folder| entries(folder)).collect();
    for page in pages?.iter().flatten() {
        let text = std::fs::read_to_string(page).map_err(|e| format!("{}: {e}", page.display()))?;
        let head = text.split("```").nth(1);
        let head = head.and_then(|part| part.strip_prefix("toml"));
        let head = head.ok_or(format!("{}: no block of TOML", page.display()))?;
        let head = table(head).map_err(|error| format!("{}: {error}", page.display()))?;
        let part = |key: &str| head.get(key).and_then(Value::as_table).cloned();
        let (mut advisory, versions) = (part("advisory").unwrap_or_default(), part("versions"));
        list.looked_at += 1;
        list.newest = list.newest.max(word(&advisory, "date").to_owned());
        let id = word(&advisory, "id").to_owned();
        if advisory.contains_key("withdrawn") {
            list.advisories.remove(&id);
        } else if packages.contains_key(word(&advisory, "package")) {
            advisory.extend(versions.unwrap_or_default());
            if let Some(accepted) = list.advisories.get(&id).and_then(|own| own.get("accepted")) {
                advisory.insert("accepted".to_owned(), accepted.clone());
            }
            list.advisories.insert(id, advisory);
        }
    }
    match list.looked_at {
        0 => Err(format!("{}: no advisories", database.display())),
        _ => Ok(list),
    }
}

fn entries(folder: &Path) -> Result<BTreeSet<std::path::PathBuf>, String> {
    let entries = std::fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    Ok(entries.flatten().map(|entry| entry.path()).collect())
}

fn text(list: &List) -> String {
    let mut text = format!(
        "{HEAD}newest = \"{}\"\nlooked_at = {}\n",
        list.newest, list.looked_at
    );
    for (id, advisory) in &list.advisories {
        text += &format!("\n[{id}]\n");
        for key in KEYS {
            if let Some(value) = advisory.get(key) {
                text += &format!("{key} = {}\n", shown(value));
            }
        }
    }
    text
}

/// A text or a list of texts, which JSON writes as TOML does.
fn shown(value: &Value) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

fn word<'a>(advisory: &'a Table, key: &str) -> &'a str {
    let text = advisory.get(key).and_then(Value::as_str);
    text.unwrap_or_default()
}

/// Advisories that apply, and no reason to accept them.
fn findings(list: &List, packages: &Packages) -> Vec<String> {
    let mut findings = Vec::new();
    for (id, advisory) in &list.advisories {
        let name = word(advisory, "package");
        let is_open = word(advisory, "accepted").is_empty();
        for version in packages.get(name).into_iter().flatten() {
            if is_open && applies(advisory, version) {
                let patched = advisory.get("patched").map(shown);
                findings.push(format!(
                    "{name} {version}: {id} applies, patched are {}; update it, or give the reason as `accepted` in {LIST}",
                    patched.unwrap_or_default()
                ));
            }
        }
    }
    findings
}

/// Whether a version is neither patched nor unaffected.
fn applies(advisory: &Table, version: &str) -> bool {
    let ranges = ["patched", "unaffected"].map(|key| advisory.get(key).and_then(Value::as_array));
    let mut ranges = ranges.into_iter().flatten().flatten();
    !ranges.any(|range| lies_in(version, range.as_str().unwrap_or_default()))
}

/// Whether a version lies in a range: `>= 1.2.0, < 2`, `^0.3.1`, `=1.0.0`.
fn lies_in(version: &str, range: &str) -> bool {
    let version = order(version);
    range.split(',').all(|bound| {
        let bound = bound.trim();
        let digits = bound.trim_start_matches(['<', '>', '=', '^', '~', ' ']);
        let limit = order(digits);
        match bound[..bound.len() - digits.len()].trim() {
            ">=" => version >= limit,
            ">" => version > limit,
            "<=" => version <= limit,
            "<" => version < limit,
            "=" => version == limit,
            "~" => version >= limit && version[..2] == limit[..2],
            // the first number that is not zero stays
            _ => {
                let kept = limit[..3].iter().position(|n| *n != 0).unwrap_or(2);
                version >= limit && version[..=kept] == limit[..=kept]
            }
        }
    })
}

/// Numbers that are ordered as versions are; one before a release is below it.
fn order(version: &str) -> [u64; 4] {
    let version = version.split('+').next().unwrap_or_default();
    let (numbers, before) = version.split_once('-').unwrap_or((version, ""));
    let mut order = [0, 0, 0, u64::from(before.is_empty())];
    for (place, number) in order.iter_mut().zip(numbers.split('.').take(3)) {
        *place = number.trim().parse().unwrap_or(0);
    }
    order
}

#[cfg(test)]
#[path = "../tests/unit/advisories.rs"]
mod tests;
