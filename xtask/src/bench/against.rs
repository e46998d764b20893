//! `cargo xtask bench --against COMMIT`: this tree beside a commit of its own, in CPU time. Nothing is judged.
//!
//! The two commands run in turns, one block each, and every pair gives one ratio: what slows the machine for longer than a
//! pair slows both. Which of the two begins changes from pair to pair.

use super::clock;
use super::page::{Page, three};
use super::program::{Program, Task, build, executable, runs_in_a_block, target};
use super::{DROP, LANE_RUNS};
use crate::repository::Repository;
use crate::toolchain::{cargo, quiet};
use std::path::{Path, PathBuf};
use std::process::Command;

const PAIRS: usize = 10;

/// What is measured: name, scenario, settings, number of machines.
type Case = (&'static str, &'static str, &'static [&'static str], usize);

const MOMENT: &[&str] = &[
    "bearing.moment.law=palmgren",
    "bearing.moment.f0=2",
    "bearing.moment.viscosity=30 mm^2/s",
    "bearing.moment.f1_factor=0.0007",
    "bearing.moment.f1_exponent=0.5",
    "bearing.static_load_rating=6.55 kN",
    "bearing.drag.orbit=0 N s/m",
    "bearing.drag.spin=0 N m s",
];
const STIFF: &[&str] = &[
    "bearing.traction.reference_speed=0.001 m/s",
    "run.duration=0.05 s",
];
const CASES: [Case; 7] = [
    ("reference drop", DROP, &[], 1),
    ("in lanes", DROP, &[], LANE_RUNS),
    ("friction moment", DROP, MOMENT, 1),
    ("friction moment, in lanes", DROP, MOMENT, LANE_RUNS),
    ("stiff traction", DROP, STIFF, 1),
    (
        "oil between balls and races",
        "scenarios/oil_lubricated_drop.toml",
        &[],
        1,
    ),
    ("spin-up", "scenarios/spin_up_6005.toml", &[], 1),
];

/// Builds the command of a commit, measures it beside that of this tree, and prints the table.
pub fn run(commit: &str) -> Result<(), String> {
    let repository = Repository::open()?;
    let hash = resolve(&repository.root, commit)?;
    let old = Program::new(&repository.root, built_at(&repository, &hash)?);
    let new = Program::new(&repository.root, build(&repository)?);
    let mut page = Page::default();
    page.line(&format!("This tree (new) beside {hash} (old)."));
    page.line(&clock::machine());
    page.line("");
    page.table([
        "case",
        "old, CPU s",
        "new, CPU s",
        "new/old",
        "middle six of ten",
        "right-hand sides, new/old",
    ]);
    for (name, scenario, settings, count) in CASES {
        let settings: Vec<String> = settings.iter().map(|set| (*set).to_owned()).collect();
        let task = Task {
            scenario,
            settings: &settings,
            count,
        };
        match compare(&old, &new, task) {
            Ok(cells) => page.row(&[vec![name.to_owned()], cells].concat()),
            // a key that one of the two does not know
            Err(error) => page.line(&format!("{name}: {error}")),
        }
    }
    Ok(())
}

/// Cells of one case: CPU seconds of one machine, old and new; the ratio and its spread; the ratio of right-hand sides.
fn compare(old: &Program, new: &Program, task: Task) -> Result<Vec<String>, String> {
    let runs = runs_in_a_block(old.block(task, 1)?.max(new.block(task, 1)?));
    let calls = new.rate_calls()? / old.rate_calls()?;
    let mut seconds = [Vec::new(), Vec::new()];
    for pair in 0..PAIRS {
        let order = if pair % 2 == 0 { [0, 1] } else { [1, 0] };
        for side in order {
            seconds[side].push([old, new][side].block(task, runs)?);
        }
    }
    let ratios = seconds[0]
        .iter()
        .zip(&seconds[1])
        .map(|(old, new)| new / old);
    let [low, ratio, high] = spread(ratios.collect());
    let each = |seconds: &Vec<f64>| spread(seconds.clone())[1] / (runs * task.count) as f64;
    Ok(vec![
        three(each(&seconds[0])),
        three(each(&seconds[1])),
        format!("{ratio:.3}"),
        format!("{low:.3} to {high:.3}"),
        format!("{calls:.3}"),
    ])
}

/// Of an even number of values: the least of the middle six tenths, the median, and the largest of those.
fn spread(mut values: Vec<f64>) -> [f64; 3] {
    values.sort_by(f64::total_cmp);
    let (count, outside) = (values.len(), values.len() / 5);
    let median = 0.5 * (values[count / 2 - 1] + values[count / 2]);
    [values[outside], median, values[count - 1 - outside]]
}

/// The whole name of a commit.
fn resolve(root: &Path, commit: &str) -> Result<String, String> {
    let mut git = git(root);
    git.args(["rev-parse", "--verify", "--quiet", "--end-of-options"]);
    git.arg(format!("{commit}^{{commit}}"));
    let output = git.output().map_err(|error| format!("git: {error}"))?;
    let hash = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    if output.status.success() {
        Ok(hash)
    } else {
        Err(format!("git knows no commit {commit}"))
    }
}

/// The release command of a commit. It is kept beside this tool's builds; the tree and the build are not.
fn built_at(repository: &Repository, hash: &str) -> Result<PathBuf, String> {
    let kept = target()?.join("against").join(hash);
    let program = kept.join(executable());
    if program.is_file() {
        return Ok(program);
    }
    let tree = Worktree::of(&repository.root, hash)?;
    let (checkout, builds) = (tree.folder.join("tree"), tree.folder.join("target"));
    let mut command = cargo(repository);
    command.args(["build", "--quiet", "--release", "--locked"]);
    command.current_dir(&checkout);
    command.env("CARGO_TARGET_DIR", &builds);
    let outcome = quiet(&mut command).result();
    outcome.map_err(|findings| format!("{hash} was not built\n{findings}"))?;
    let built = builds.join("release").join(executable());
    std::fs::create_dir_all(&kept)
        .and_then(|()| std::fs::copy(&built, &program))
        .map_err(|error| format!("{}: {error}", built.display()))?;
    Ok(program)
}

/// A commit checked out in a folder of its own, removed with everything in it.
struct Worktree<'a> {
    root: &'a Path,
    folder: PathBuf,
}

impl<'a> Worktree<'a> {
    fn of(root: &'a Path, hash: &str) -> Result<Self, String> {
        let name = format!("auxbear-against-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let tree = Worktree { root, folder };
        let mut git = git(root);
        git.args(["worktree", "add", "--quiet", "--detach"]);
        let outcome = quiet(git.arg(tree.folder.join("tree")).arg(hash));
        outcome.result().map(|()| tree)
    }
}

impl Drop for Worktree<'_> {
    fn drop(&mut self) {
        let mut git = git(self.root);
        git.args(["worktree", "remove", "--force"]);
        quiet(git.arg(self.folder.join("tree")));
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

fn git(root: &Path) -> Command {
    let mut git = Command::new("git");
    git.current_dir(root);
    git
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_slowest_and_the_two_quickest_of_ten_pairs_do_not_count() {
        let values = vec![9.0, 1.0, 1.2, 1.1, 0.9, 1.3, 0.1, 1.4, 0.2, 8.0];
        assert_eq!(spread(values), [0.9, 1.15, 1.4]);
    }

    #[test]
    fn a_commit_that_is_not_there_is_named() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let wrong = "no-such-commit";
        assert_eq!(
            resolve(root, wrong),
            Err(format!("git knows no commit {wrong}"))
        );
    }
}
