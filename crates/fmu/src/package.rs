//! The file of a unit: a description, the libraries of its platforms, and the scenario with its data files as resources.

use crate::description::{self, Version};
use crate::variables::{self, COMMANDS, Variable};
use auxbear::Scenario;
use auxbear::problem::{Code, Problem, Result};
use auxbear::run::{Commands, Driving};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{Seek, Write};
use std::path::{Path, PathBuf};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// The scenario among the resources.
pub(crate) const SCENARIO: &str = "scenario.toml";
/// What the library knows of its unit, among the resources.
const OWN: &str = "unit.toml";

/// What the library knows of its unit.
pub(crate) struct Resources {
    pub guid: String,
    pub commands: Commands,
}

/// What the resources in a folder say.
pub(crate) fn resources(folder: &Path) -> std::result::Result<Resources, String> {
    let path = folder.join(OWN);
    let text = fs::read_to_string(&path);
    let text = text.map_err(|error| format!("{}: {error}", path.display()))?;
    let damaged = || format!("{}: is not what auxbear wrote", path.display());
    let table: toml::Table = text.parse().map_err(|_| damaged())?;
    let word = |key: &str| table.get(key).and_then(|value| value.as_str());
    let commands = word("input").and_then(|word| COMMANDS.iter().find(|own| own.0 == word));
    Ok(Resources {
        guid: word("guid").ok_or_else(damaged)?.to_string(),
        commands: commands.ok_or_else(damaged)?.1,
    })
}

/// A library with the platform that it is for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Library {
    /// Its file.
    pub path: PathBuf,
    /// Its folder in a unit of version 2.0: `linux64`.
    pub platform: &'static str,
    /// The same in one of version 3.0: `x86_64-linux`.
    pub tuple: &'static str,
    /// End of its name there.
    ending: &'static str,
}

/// Platforms by what a library begins with and, where several do, the machine in its header: 2.0, 3.0, end of the name.
const PLATFORMS: [(&str, &str, &str); 7] = [
    ("linux64", "x86_64-linux", "so"),
    ("linux32", "x86-linux", "so"),
    ("linux-aarch64", "aarch64-linux", "so"),
    ("darwin64", "x86_64-darwin", "dylib"),
    ("darwin-aarch64", "aarch64-darwin", "dylib"),
    ("win64", "x86_64-windows", "dll"),
    ("win32", "x86-windows", "dll"),
];

/// The platform on which this runs: its folder in units of version 2.0 and 3.0, and the end of the name of a library.
pub(crate) fn here() -> Option<(&'static str, &'static str, &'static str)> {
    let system = match std::env::consts::OS {
        "macos" => "darwin",
        other => other,
    };
    let tuple = format!("{}-{system}", std::env::consts::ARCH);
    PLATFORMS.iter().find(|own| own.1 == tuple).copied()
}

/// The place of the platform of a library among [`PLATFORMS`], from its header: ELF, Mach-O or PE.
fn platform(bytes: &[u8]) -> Option<usize> {
    let number = |at: usize| Some(u16::from_le_bytes(bytes.get(at..at + 2)?.try_into().ok()?));
    match bytes.get(..4)? {
        [0x7f, b'E', b'L', b'F'] => match number(18)? {
            62 => Some(0),
            3 => Some(1),
            183 => Some(2),
            _ => None,
        },
        // of Mach-O the type of the processor
        [0xcf, 0xfa, 0xed, 0xfe] => match bytes.get(4..8)? {
            [7, 0, 0, 1] => Some(3),
            [12, 0, 0, 1] => Some(4),
            _ => None,
        },
        [b'M', b'Z', ..] => {
            let at = u32::from_le_bytes(bytes.get(60..64)?.try_into().ok()?) as usize;
            match number(at + 4)? {
                0x8664 => Some(5),
                0x14c => Some(6),
                _ => None,
            }
        }
        _ => None,
    }
}

impl Library {
    /// The library in a file.
    ///
    /// # Errors
    /// A file that cannot be read, or is no library of a known platform.
    pub fn read(path: &Path) -> Result<Library> {
        let needed = "a library for co-simulation units is needed: cargo build --release makes it";
        let bytes = fs::read(path).map_err(|error| {
            Problem::at_path(
                Code::FileUnreadable,
                path,
                format!("what cannot be read ({error})"),
                needed,
            )
        })?;
        let known = platform(&bytes).ok_or_else(|| {
            let found = "no library of Linux, macOS or Windows";
            Problem::at_path(Code::FileUnreadable, path, found, needed)
        })?;
        let (platform, tuple, ending) = PLATFORMS[known];
        Ok(Library {
            path: path.to_path_buf(),
            platform,
            tuple,
            ending,
        })
    }
    /// Its folder in a unit.
    pub fn folder(&self, version: Version) -> &'static str {
        match version {
            Version::Two => self.platform,
            Version::Three => self.tuple,
        }
    }
}

/// Writes a machine as a unit by words: what its commands are, `current`, `voltage` or `force`, and the version, `2` or `3`; with
/// these libraries, one at least. What it holds.
///
/// # Errors
/// Words that are none of these, no library, and what [`Unit::write`] refuses.
pub fn written(
    scenario: &Scenario,
    (input, version): (&str, &str),
    libraries: &[PathBuf],
    path: &Path,
) -> Result<Written> {
    let unknown = |key: &str, word: &str, words: &[&str]| {
        let (found, needed) = (
            format!("\"{word}\""),
            format!("one of {} is needed", words.join(", ")),
        );
        Problem::new(Code::UnknownWord, "auxbear fmu", found, needed).on_key(key)
    };
    let commands = COMMANDS.iter().find(|(word, _)| *word == input);
    let words = COMMANDS.map(|(word, _)| word);
    let (_, commands) = commands.ok_or_else(|| unknown("--input", input, &words))?;
    let version = match version {
        "2" | "2.0" => Version::Two,
        "3" | "3.0" => Version::Three,
        other => return Err(unknown("--version", other, &["2", "3"])),
    };
    if libraries.is_empty() {
        library_in(None)?;
    }
    let libraries = libraries.iter().map(|path| Library::read(path));
    let libraries = libraries.collect::<Result<Vec<_>>>()?;
    let unit = Unit {
        scenario,
        commands: *commands,
        version,
        libraries: &libraries,
    };
    let variables = unit
        .write(path)
        .map_err(|problem| scenario.locate(problem))?;
    let platforms = libraries
        .iter()
        .map(|own| (own.folder(version), own.path.clone()));
    Ok(Written {
        commands: *commands,
        version,
        platforms: platforms.collect(),
        variables,
    })
}

/// What a unit holds that was written.
pub struct Written {
    /// What its commands are.
    pub commands: Commands,
    /// Of the interface.
    pub version: Version,
    /// Folders of its libraries with their files.
    pub platforms: Vec<(&'static str, PathBuf)>,
    /// Its variables.
    pub variables: Vec<Variable>,
}

/// The library in the folder of the program, or of the package.
///
/// # Errors
/// Where none is there, with what makes one.
pub fn library_in(folder: Option<&Path>) -> Result<PathBuf> {
    let name = format!(
        "{}auxbear_fmu{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    );
    let path = folder
        .map(|folder| folder.join(&name))
        .filter(|path| path.is_file());
    path.ok_or_else(|| {
        let found = format!("no {name} beside the program");
        let needed = "it is needed there, or named by --library: cargo build --release makes it";
        Problem::new(Code::FileUnreadable, "auxbear fmu", found, needed)
    })
}

/// What a unit is made of.
pub struct Unit<'a> {
    /// The machine.
    pub scenario: &'a Scenario,
    /// What its commands are.
    pub commands: Commands,
    /// Of the interface.
    pub version: Version,
    /// For each platform.
    pub libraries: &'a [Library],
}

impl Unit<'_> {
    /// Writes the unit to a file, whole or not at all; its variables.
    ///
    /// # Errors
    /// What is wrong with the scenario, why it cannot be driven so, libraries of one platform, and a file that is there or cannot be written.
    pub fn write(&self, path: &Path) -> Result<Vec<Variable>> {
        if path.exists() {
            let needed = "a file is never written over another: choose another path";
            return Err(Problem::at_path(
                Code::OutputExists,
                path,
                "something of this name",
                needed,
            ));
        }
        let way = Driving {
            commands: self.commands,
            keep_history: false,
            stops_at_contacts: false,
        };
        let driven = variables::driven(self.scenario, way)?;
        for (place, own) in self.libraries.iter().enumerate() {
            if (self.libraries[..place].iter()).any(|other| other.platform == own.platform) {
                let found = format!("a second library for {}", own.platform);
                let needed = "one library a platform is needed";
                return Err(Problem::at_path(Code::Conflict, &own.path, found, needed));
            }
        }
        let list = variables::of(self.scenario, &driven);
        let title = self.scenario.title.as_deref().unwrap_or("Rotor on magnets");
        let (scenario, data) = portable(&self.scenario.resolved.toml());
        let model = description::Model {
            title,
            variables: &list,
            end: driven.end(),
            // what it computes is of this version, its scenario and its commands
            content: &format!("{}{scenario}{:?}", env!("CARGO_PKG_VERSION"), self.commands),
        };
        let (guid, xml) = model.written(self.version);
        let word = COMMANDS.iter().find(|own| own.1 == self.commands);
        let own = format!(
            "guid = \"{guid}\"\ninput = \"{}\"\n",
            word.map_or("current", |own| own.0)
        );
        let failed = |error: &dyn std::fmt::Display| {
            let found = format!("that it cannot be written ({error})");
            let needed = "a place with room and permission to write is needed";
            Problem::at_path(Code::OutputFailed, path, found, needed)
        };
        let partial = path.with_extension("fmu.partial");
        let filled = File::create(&partial)
            .map_err(|error| failed(&error))
            .and_then(|file| {
                self.fill(file, [&xml, &scenario, &own], &data)
                    .map_err(|error| failed(&error))
            });
        let named =
            filled.and_then(|()| fs::rename(&partial, path).map_err(|error| failed(&error)));
        if named.is_err() {
            let _ = fs::remove_file(&partial);
        }
        named.map(|()| list)
    }

    fn fill(
        &self,
        file: impl Write + Seek,
        [xml, scenario, own]: [&String; 3],
        data: &BTreeMap<String, PathBuf>,
    ) -> std::io::Result<()> {
        let mut zip = ZipWriter::new(file);
        let options = SimpleFileOptions::default();
        let mut add = |name: &str, bytes: &[u8]| {
            zip.start_file(name, options)?;
            zip.write_all(bytes)
        };
        add("modelDescription.xml", xml.as_bytes())?;
        for library in self.libraries {
            let name = format!(
                "binaries/{}/{}.{}",
                library.folder(self.version),
                description::IDENTIFIER,
                library.ending
            );
            add(&name, &fs::read(&library.path)?)?;
        }
        add(&format!("resources/{SCENARIO}"), scenario.as_bytes())?;
        add(&format!("resources/{OWN}"), own.as_bytes())?;
        for (name, path) in data {
            add(&format!("resources/{name}"), &fs::read(path)?)?;
        }
        zip.finish().map(|_| ())?;
        Ok(())
    }
}

/// A resolved scenario that names its data files beside it, with where these are now.
fn portable(text: &str) -> (String, BTreeMap<String, PathBuf>) {
    let (mut text, mut data) = (text.to_string(), BTreeMap::new());
    let table: toml::Table = text.parse().unwrap_or_default();
    let mut found = Vec::new();
    texts(&toml::Value::Table(table), &mut found);
    for path in found {
        let from = PathBuf::from(&path);
        if !(from.is_absolute() && from.is_file()) {
            continue;
        }
        let file = from
            .file_name()
            .map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let name = format!("data/{}_{file}", data.len() + 1);
        // as the resolved file quotes it
        let quoted = auxbear::scenario::quoted(&path);
        text = text.replace(&quoted, &format!("\"{name}\""));
        data.insert(name, from);
    }
    (text, data)
}

/// All texts in a value.
fn texts(value: &toml::Value, found: &mut Vec<String>) {
    match value {
        toml::Value::String(text) if !found.contains(text) => found.push(text.clone()),
        toml::Value::Array(list) => list.iter().for_each(|own| texts(own, found)),
        toml::Value::Table(table) => table.values().for_each(|own| texts(own, found)),
        _ => {}
    }
}
