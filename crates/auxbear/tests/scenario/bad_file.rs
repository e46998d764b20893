//! Files that cannot be a scenario: each its own message.

use auxbear::problem::Code;
use auxbear::scenario::{BuiltIn, NoBearings, Scenario, template};
use std::path::PathBuf;

/// A path in a fresh folder that is removed afterwards.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("auxbear-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn files_that_are_no_scenario_are_distinguished() {
    let folder = Folder::new("bad-files");
    let shown = |path: &PathBuf| {
        let problem = Scenario::read(path, &[], &NoBearings).unwrap_err();
        let text = problem.to_string();
        (
            problem.code,
            text.replace(&path.display().to_string(), "FILE"),
        )
    };
    assert_eq!(
        shown(&folder.0),
        (
            Code::FileIsFolder,
            "error[AB0002]: FILE: found a folder; the path of a scenario file is needed"
                .to_string()
        )
    );
    assert_eq!(
        shown(&folder.0.join("none.toml")),
        (
            Code::FileMissing,
            "error[AB0001]: FILE: found no file of this name; the path of a scenario file is needed"
                .to_string()
        )
    );
    assert_eq!(
        shown(&folder.file("empty.toml", b" \n")),
        (
            Code::FileEmpty,
            "error[AB0004]: FILE: found an empty file; a scenario is needed; auxbear new drop writes one to start from"
                .to_string()
        )
    );
    assert_eq!(
        shown(&folder.file("latin.toml", b"a = 1\nb = \"\xe4\"\n")),
        (
            Code::FileNotUtf8,
            "error[AB0003]: FILE:2: found bytes that are not UTF-8 text; a text file in UTF-8 is needed"
                .to_string()
        )
    );
    assert_eq!(
        shown(&folder.file("large.toml", &vec![b'#'; 10_000_001])),
        (
            Code::FileTooLarge,
            "error[AB0005]: FILE: found more than 10 MB; a scenario file of at most 10 MB is needed"
                .to_string()
        )
    );
    let start = template("drop").expect("a drop has a starting file");
    let good = folder.file("good.toml", start.as_bytes());
    assert!(Scenario::read(&good, &[], &BuiltIn).is_ok());
}
