//! The folder that a studio serves: files by their names below it, nothing else; one studio at a time.

use auxbear::Code;
use auxbear::Problem;
use auxbear::report::directory::RUNS;
use auxbear::scenario::{SystemName, study_file::STUDY_FORMAT, template::STUDY};
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs::{self, File, TryLockError};
use std::io::Write;
use std::path::{Component, Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::UNIX_EPOCH;

/// Name of the file that holds the lock and the address of the studio that has it.
const LOCK: &str = ".auxbear-studio";
/// How deep below the folder files are listed.
const DEPTH: usize = 3;
/// Most entries of a folder that are looked through.
const MOST_ENTRIES: usize = 5000;
/// Most files of a list.
const MOST_FILES: usize = 2000;
/// Most bytes of an input file that is edited.
pub const MOST_BYTES: u64 = 4 << 20;

type Result<T> = std::result::Result<T, Box<Problem>>;

/// A folder with the lock on it.
pub struct Folder {
    root: PathBuf,
    lock: File,
    /// Input files by name, as they were at their last change.
    known: Mutex<BTreeMap<String, (u128, Option<InputFile>)>>,
}

/// An input file as lists show it.
#[derive(Clone, Debug, Serialize)]
pub struct InputFile {
    /// Name below the folder, with `/` between its parts.
    pub name: String,
    /// Word of its kind: a system, `study`, `qualify`; empty where the text does not say it.
    pub kind: String,
    /// Its title, where it has one.
    pub title: String,
    /// Last change, seconds since 1970.
    pub changed: u64,
}

fn own_in(root: &Path, name: &str) -> std::result::Result<PathBuf, String> {
    let path = root.join(name);
    match path.symlink_metadata() {
        Ok(about) if about.is_symlink() => Err(format!("a link by the name of {name}")),
        _ => Ok(path),
    }
}

impl Folder {
    /// Takes a folder, which is made where there is none.
    ///
    /// # Errors
    /// A place that is no folder or grants no right to write, and a folder that another studio has.
    pub fn open(path: &Path) -> Result<Folder> {
        let refused = |found: String, code| {
            let needed = "a folder is needed in which files can be written";
            Problem::at_path(code, path, found, needed)
        };
        if path.exists() && !path.is_dir() {
            return Err(refused("a file".to_string(), Code::OutputPlace));
        }
        let cannot = |error: std::io::Error| refused(error.to_string(), Code::OutputPlace);
        fs::create_dir_all(path).map_err(cannot)?;
        let root = fs::canonicalize(path).map_err(cannot)?;
        let place = own_in(&root, LOCK).map_err(|found| refused(found, Code::OutputPlace))?;
        let lock = (File::options()
            .create(true)
            .truncate(false)
            .read(true)
            .write(true))
        .open(&place)
        .map_err(cannot)?;
        if let Err(TryLockError::WouldBlock) = lock.try_lock() {
            let address = fs::read_to_string(&place).unwrap_or_default();
            let found = format!("a folder that another studio serves at {}", address.trim());
            let needed = "one studio a folder is possible: use that one, or end it first";
            return Err(Problem::at_path(Code::FolderInUse, path, found, needed));
        }
        Ok(Folder {
            root,
            lock,
            known: Mutex::default(),
        })
    }

    /// Notes the address for whoever asks for the folder meanwhile.
    ///
    /// # Errors
    /// What cannot be written.
    pub fn served_at(&self, address: &str) -> std::io::Result<()> {
        self.lock.set_len(0)?;
        (&self.lock).write_all(format!("{address}\n").as_bytes())
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The path of what the studio keeps at the top of the folder: a link is refused, which may lead out of it.
    ///
    /// # Errors
    /// A link.
    pub fn own(&self, name: &str) -> std::result::Result<PathBuf, String> {
        own_in(&self.root, name)
    }

    /// The path of a name below the folder. What leads out of it, also by a link, is refused.
    ///
    /// # Errors
    /// A name that is none, and one that leads out.
    pub fn path(&self, name: &str) -> std::result::Result<PathBuf, String> {
        let relative = Path::new(name);
        let plain = |part: Component| match part {
            Component::Normal(part) => !part.to_string_lossy().starts_with('.'),
            _ => false,
        };
        if name.is_empty() || name.contains(['\\', '\0']) || !relative.components().all(plain) {
            return Err(format!("{name:?} is no name of a file in this folder"));
        }
        let path = self.root.join(relative);
        // of what does not exist yet the folder that holds it
        let mut there = path.as_path();
        while !there.exists() && there.symlink_metadata().is_err() {
            there = there.parent().unwrap_or(&self.root);
        }
        match fs::canonicalize(there) {
            Ok(real) if real.starts_with(&self.root) => Ok(path),
            _ => Err(format!("{name:?} leads out of this folder")),
        }
    }

    /// All input files below the folder, by name.
    pub fn files(&self) -> Vec<InputFile> {
        let mut found = Vec::new();
        self.list(&self.root, "", DEPTH, &mut found);
        found.sort_by(|a, b| a.name.cmp(&b.name));
        found
    }

    fn list(&self, folder: &Path, before: &str, depth: usize, found: &mut Vec<InputFile>) {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        for entry in entries.take(MOST_ENTRIES) {
            let own = entry.file_name().to_string_lossy().into_owned();
            let name = format!("{before}{own}");
            let path = entry.path();
            if own.starts_with('.') || found.len() >= MOST_FILES || self.path(&name).is_err() {
                continue;
            }
            if path.is_dir() {
                // what runs and studies left is no input
                let left =
                    name == RUNS || own.ends_with(".partial") || path.join("summary.json").exists();
                if depth > 1 && !left {
                    self.list(&path, &format!("{name}/"), depth - 1, found);
                }
            } else if own.ends_with(".toml") {
                found.extend(self.known(name, &path));
            }
        }
    }

    /// An input file, which is read again only where it has changed.
    fn known(&self, name: String, path: &Path) -> Option<InputFile> {
        let at = stamp(path);
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, file)) = known.get(&name).filter(|(then, _)| *then == at) {
            return file.clone();
        }
        let file = listed(name.clone(), path);
        known.insert(name, (at, file.clone()));
        file
    }

    /// Reads an input file: its text and the hash of it.
    ///
    /// # Errors
    /// What is no readable text.
    pub fn read(&self, name: &str) -> std::result::Result<(String, String), String> {
        let path = self.path(name)?;
        let size = fs::metadata(&path).map_or(0, |about| about.len());
        if size > MOST_BYTES {
            return Err(format!(
                "{name} has {size} bytes: no input file that an editor opens"
            ));
        }
        let text = fs::read_to_string(&path).map_err(|error| format!("{name}: {error}"))?;
        let hash = hash(&text);
        Ok((text, hash))
    }

    /// Writes an input file, whole or not at all, where the text in the file is still the one of this hash, or there is no file.
    ///
    /// # Errors
    /// `Ok(Err(text))` gives what somebody else wrote meanwhile.
    pub fn save(
        &self,
        name: &str,
        text: &str,
        known: Option<&str>,
    ) -> std::result::Result<std::result::Result<String, String>, String> {
        let path = self.path(name)?;
        if let Ok((there, now)) = self.read(name)
            && known != Some(now.as_str())
            && there != text
        {
            return Ok(Err(there));
        }
        let said = |error: std::io::Error| format!("{name} cannot be written: {error}");
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(said)?;
        }
        let fresh = path.with_extension("toml.partial");
        let write = || {
            let mut file = File::create(&fresh)?;
            file.write_all(text.as_bytes())?;
            file.sync_all()?;
            fs::rename(&fresh, &path)
        };
        write().map_err(|error| {
            let _ = fs::remove_file(&fresh);
            said(error)
        })?;
        Ok(Ok(hash(text)))
    }
}

/// A text in few letters: two that differ have others.
pub fn hash(text: &str) -> String {
    let digest = Sha256::digest(text.as_bytes());
    digest
        .iter()
        .take(12)
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// Last change of a file, nanoseconds since 1970; 0 where nothing says it.
pub fn stamp(path: &Path) -> u128 {
    let time = fs::metadata(path).and_then(|about| about.modified()).ok();
    let since = time.and_then(|time| time.duration_since(UNIX_EPOCH).ok());
    since.map_or(0, |since| since.as_nanos())
}

/// The same in seconds.
pub fn changed(path: &Path) -> u64 {
    (stamp(path) / 1_000_000_000) as u64
}

/// An input file; none where the text is that of another program.
fn listed(name: String, path: &Path) -> Option<InputFile> {
    let small = fs::metadata(path).is_ok_and(|about| about.len() <= MOST_BYTES);
    let text = small.then(|| fs::read_to_string(path).ok())??;
    let (kind, title) = match toml::from_str::<toml::Table>(&text) {
        Ok(table) => {
            let kind = kind_of(&table)?;
            let title = table.get("title").and_then(toml::Value::as_str);
            (kind.to_string(), title.unwrap_or_default().to_string())
        }
        // a text that somebody is working on
        Err(_) if text.contains("auxbear.") => Default::default(),
        Err(_) => return None,
    };
    Some(InputFile {
        name,
        kind,
        title,
        changed: changed(path),
    })
}

/// Word of the kind of a file; none of what is no input of this program.
pub fn kind_of(table: &toml::Table) -> Option<&'static str> {
    let format = table.get("format")?.as_str()?;
    if format == STUDY_FORMAT {
        let design = table.get("design").and_then(|design| design.get("kind"));
        let qualifies = design.and_then(toml::Value::as_str) == Some("qualification");
        return Some(if qualifies { "qualify" } else { STUDY });
    }
    if !format.starts_with("auxbear.scenario/") {
        return None;
    }
    let system = table
        .get("system")
        .and_then(|own| own.get("value").or(Some(own)));
    Some(
        system
            .and_then(toml::Value::as_str)
            .and_then(SystemName::of)
            .map_or("", SystemName::word),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_lead_out_are_refused() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::open(&place.path().join("own")).unwrap();
        fs::write(place.path().join("secret.toml"), "a = 1").unwrap();
        for name in [
            "../secret.toml",
            "/etc/passwd",
            "",
            ".",
            "a/../../secret.toml",
            ".auxbear-studio",
            "a/.b",
            "..\\secret.toml",
            "a\0b",
        ] {
            assert!(folder.path(name).is_err(), "{name}");
        }
        assert!(folder.path("sub/new.toml").is_ok());
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(place.path(), folder.root().join("out")).unwrap();
            std::os::unix::fs::symlink(
                place.path().join("secret.toml"),
                folder.root().join("link.toml"),
            )
            .unwrap();
            std::os::unix::fs::symlink("nowhere/at/all", folder.root().join("dangling.toml"))
                .unwrap();
            for name in [
                "out/secret.toml",
                "out/new.toml",
                "link.toml",
                "dangling.toml",
            ] {
                assert!(folder.path(name).is_err(), "{name}");
            }
            assert!(folder.files().is_empty());
            // nor does what the studio keeps itself
            let kept = place.path().join("kept.txt");
            fs::write(&kept, "mine").unwrap();
            std::os::unix::fs::symlink(&kept, folder.root().join("layout")).unwrap();
            assert!(folder.own("layout").is_err() && folder.own("other").is_ok());
            let other = place.path().join("other");
            fs::create_dir(&other).unwrap();
            std::os::unix::fs::symlink(&kept, other.join(LOCK)).unwrap();
            assert!(Folder::open(&other).is_err());
            assert_eq!(fs::read_to_string(&kept).unwrap(), "mine");
        }
    }

    #[test]
    fn one_studio_has_a_folder_and_the_next_is_sent_to_it() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::open(place.path()).unwrap();
        folder.served_at("http://127.0.0.1:1234/").unwrap();
        let second = Folder::open(place.path()).err().unwrap().to_string();
        assert!(second.contains("http://127.0.0.1:1234/"), "{second}");
        drop(folder);
        assert!(Folder::open(place.path()).is_ok());
    }

    #[test]
    fn what_somebody_else_wrote_is_not_written_over() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::open(place.path()).unwrap();
        let first = folder.save("a.toml", "x = 1\n", None).unwrap().unwrap();
        fs::write(place.path().join("a.toml"), "x = 2\n").unwrap();
        assert_eq!(
            folder.save("a.toml", "x = 3\n", Some(&first)).unwrap(),
            Err("x = 2\n".to_string())
        );
        assert_eq!(
            fs::read_to_string(place.path().join("a.toml")).unwrap(),
            "x = 2\n"
        );
        let (_, now) = folder.read("a.toml").unwrap();
        assert!(
            folder
                .save("a.toml", "x = 3\n", Some(&now))
                .unwrap()
                .is_ok()
        );
        // a new file is none that exists
        assert!(folder.save("a.toml", "x = 4\n", None).unwrap().is_err());
    }

    #[test]
    fn files_are_listed_with_their_kind() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::open(place.path()).unwrap();
        for kind in ["drop", "study"] {
            let text = auxbear::template(kind).unwrap();
            fs::write(place.path().join(format!("{kind}.toml")), text).unwrap();
        }
        fs::write(place.path().join("other.toml"), "[package]\nname = 1\n").unwrap();
        fs::write(
            place.path().join("broken.toml"),
            "format = \"auxbear.scenario/1\"\n[[",
        )
        .unwrap();
        let kinds: Vec<_> = folder
            .files()
            .into_iter()
            .map(|file| (file.name, file.kind))
            .collect();
        let pair = |name: &str, kind: &str| (name.to_string(), kind.to_string());
        assert_eq!(
            kinds,
            [
                pair("broken.toml", ""),
                pair("drop.toml", "drop"),
                pair("study.toml", "study")
            ]
        );
    }
}
