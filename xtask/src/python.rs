//! Guard: the Python package imports, and its tests pass.

use crate::repository::{Outcome, Repository};
use crate::shipped;
use crate::toolchain::quiet;
use std::path::Path;
use std::process::Command;

/// What the tests of the package need beside it.
const PACKAGES: &str = "distributed fmpy==0.3.26 numpy optuna pandas pint plotly polars pyarrow pytest pythonfmu==0.7.0 pythonfmu3==0.3.4";

/// Builds the native part as the tests are built, puts the package together in a folder of its own, and runs its tests there.
/// Where there is no Python, or nowhere to install from, it says so.
pub fn check(repository: &Repository) -> Outcome {
    let has_python = quiet(Command::new("python3").args(["-c", "import venv, ensurepip"]));
    if !has_python.findings.is_empty() {
        return Outcome::new("not run: no python3 with venv here", Vec::new());
    }
    let built =
        shipped::library(repository).and_then(|native| Ok((native, shipped::program(repository)?)));
    let (native, command) = match built {
        Ok(built) => built,
        Err(findings) => return Outcome::new("", findings),
    };
    let folder = std::env::temp_dir().join(format!("auxbear-python-{}", std::process::id()));
    let outcome = match put_together(repository, &native, &folder) {
        Ok(()) => tested(repository, &folder, &command),
        Err(error) => Outcome::new("", vec![format!("{}: {error}", folder.display())]),
    };
    // Nothing depends on the folder any more; one that stays behind is no fault of the product.
    let _ = std::fs::remove_dir_all(&folder);
    outcome
}

/// The package as it is installed.
fn put_together(repository: &Repository, native: &Path, folder: &Path) -> std::io::Result<()> {
    let package = folder.join("auxbear");
    std::fs::create_dir_all(&package)?;
    std::fs::copy(native, package.join("_auxbear.abi3.so"))?;
    let units = "libauxbear_fmu.so";
    std::fs::copy(native.with_file_name(units), package.join(units))?;
    for file in repository.below("python/auxbear/", "") {
        let name = file.trim_start_matches("python/auxbear/");
        std::fs::copy(repository.root.join(file), package.join(name))?;
    }
    Ok(())
}

fn tested(repository: &Repository, folder: &Path, command: &Path) -> Outcome {
    let mut made = Command::new("python3");
    let made = quiet((made.args(["-m", "venv", "environment"])).current_dir(folder));
    if !made.findings.is_empty() {
        return made;
    }
    let python = folder.join("environment/bin/python");
    let mut install = Command::new(&python);
    let words = format!("-m pip install --quiet --disable-pip-version-check {PACKAGES}");
    let installed = quiet(install.args(words.split(' ')).current_dir(folder));
    if !installed.findings.is_empty() {
        let seen = format!("not run: {PACKAGES} cannot be installed here");
        return Outcome::new(seen, Vec::new());
    }
    let mut tests = Command::new(&python);
    tests
        .args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider"])
        .arg(repository.root.join("python/tests"))
        .current_dir(folder)
        .env("PYTHONPATH", folder)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .env("AUXBEAR_COMMAND", command);
    let mut outcome = quiet(&mut tests);
    outcome.seen = "tests of the package pass".to_owned();
    outcome
}
