//! Texts that a user types: scenarios, overrides, catalogues, cases; rotors to import; directories of runs and studies.

use crate::mutator::{Dice, bytes, numbers, text};
use crate::watch::{Watch, count};
use crate::{files, repository};
use auxbear::catalogue::Catalogue;
use auxbear::import::import;
use auxbear::report::{directory, page, study as studies};
use auxbear::run::build;
use auxbear::scenario::{BuiltIn, Scenario, StudyFile, SystemName, keys, template};
use auxbear::study::Study;
use std::fs;
use std::sync::atomic::AtomicBool;
use std::time::Duration;
use validate::{LawsOnly, case, reference};

/// Mutations of each kind in the short form: a second each.
const USUAL: usize = 300;

/// Longest time of a check: a rig searches the engagement that gives the wanted acceleration, run by run, which the command
/// tells from two seconds on. It took up to 13 s beside other work.
const SEARCHED: Duration = Duration::from_secs(60);

fn mutations() -> usize {
    count("AUXBEAR_MUTATIONS", USUAL)
}

/// Names of files, as messages have them, and what stands in them.
pub fn scenarios() -> Vec<(String, String)> {
    let shipped = files("scenarios", "toml").into_iter();
    let shipped = shipped.map(|(path, text)| {
        (
            path.display().to_string(),
            String::from_utf8(text).expect("scenarios are UTF-8"),
        )
    });
    let started = SystemName::ALL.iter().map(|system| {
        let name = repository("scenarios").join("started.toml");
        let text = template(system.word()).expect("every system has a starting file");
        (name.display().to_string(), text)
    });
    shipped.chain(started).collect()
}

/// Reads and checks a scenario as `auxbear check` does.
fn checked(text: &str, name: &str, sets: &[String]) -> bool {
    let Ok(scenario) = Scenario::parse(text, name, sets, &BuiltIn).inspect_err(|problem| {
        assert!(problem.to_string().starts_with("error[AB"), "{problem}");
    }) else {
        return false;
    };
    match build(&scenario) {
        Ok(machine) => {
            machine.warnings();
            assert!(!scenario.resolved.toml().is_empty());
            true
        }
        Err(_) => false,
    }
}

#[test]
fn mutated_scenarios_are_checked() {
    let seeds = scenarios();
    let mut watch = Watch::new("scenario");
    for k in 0..mutations() {
        let mut dice = Dice::new(k as u64);
        let (name, seed) = dice.of(&seeds).clone();
        let other = &dice.of(&seeds).1;
        let mutated = text(&mut dice, &seed, other);
        watch.budgeted(mutated.as_bytes(), SEARCHED, || {
            checked(&mutated, &name, &[])
        });
    }
    watch.end();
}

#[test]
fn mutated_overrides_are_checked() {
    let read = |(name, text): &(String, String)| Scenario::parse(text, name, &[], &BuiltIn);
    let mut seeds = scenarios();
    seeds.retain(|seed| read(seed).is_ok());
    assert!(seeds.len() > 10, "{}", seeds.len());
    let paths: Vec<&str> = keys().map(|key| key.path).collect();
    let values = [
        "0",
        "1",
        "-1",
        "3",
        "1e400",
        "nan",
        "\"1 mm\"",
        "1 mm",
        "5 rpm",
        "-3 K",
        "0 s",
        "80 N",
        "[1, 2]",
        "[\"1 N\"]",
        "true",
        "6205",
        "hybrid",
        "",
        "{ value = \"1 mm\", assumed = \"a\" }",
        "2 um",
        "1e9 m",
        "1e-12 kg",
    ];
    // the values that each scenario has by itself: overrides of these mean something
    let own: Vec<Vec<(String, String)>> = (seeds.iter())
        .map(|seed| {
            let scenario = read(seed).unwrap();
            let known = scenario.resolved.values.iter();
            known
                .filter_map(|value| Some((value.shown(), value.text.clone()?)))
                .collect()
        })
        .collect();
    let mut watch = Watch::new("set");
    for k in 0..mutations() {
        let mut dice = Dice::new(k as u64);
        let place = dice.below(seeds.len());
        let (name, seed) = &seeds[place];
        let sets: Vec<String> = (0..1 + dice.below(3))
            .map(|_| match dice.below(4) {
                0 => format!("{}={}", dice.of(&paths), dice.of(&values)),
                1 => {
                    let set = format!("{}={}", dice.of(&paths), dice.of(&values));
                    text(&mut dice, &set, seed)
                }
                _ => {
                    let (path, value) = dice.of(&own[place]).clone();
                    format!("{path}={}", numbers(&mut dice, &value))
                }
            })
            .collect();
        watch.budgeted(sets.join("\n").as_bytes(), SEARCHED, || {
            checked(seed, name, &sets)
        });
    }
    watch.end();
}

/// A user's file of bearings, by hand and as a family.
const CATALOGUE: &str = r#"format = "auxbear.bearings/1"

[sources]
maker = "Maker's catalogue 2024, p. 12"

[[bearing]]
name = "my 6205"
type = "deep groove"
bore_diameter = { value = "25 mm", catalogue = "maker" }
outer_diameter = "52 mm"
width = "15 mm"
ball_diameter = { value = "7.938 mm", assumed = "as other makers" }
ball_count = 9
static_load_rating = "7.8 kN"

[[family]]
name = "mine {size}"
type = "deep groove"
columns = [
  { note = "size" },
  { key = "bore_diameter", unit = "mm", catalogue = "maker" },
  { key = "outer_diameter", unit = "mm", catalogue = "maker" },
  { key = "ball_diameter", unit = "mm", catalogue = "maker" },
  { key = "ball_count", derived = "from C0 of {size}" },
]
rows = [["A", 25, 52, 7.9, 9], ["B", 30, 62, 9.5, { value = 9, assumed = "as A" }]]
"#;

#[test]
fn mutated_catalogues_are_read() {
    assert!(Catalogue::with_text(CATALOGUE, "mine.toml").is_ok());
    let built_in = fs::read_to_string(repository("crates/catalogue/src/bearings.toml")).unwrap();
    let mut watch = Watch::new("catalogue");
    for k in 0..mutations() {
        let mut dice = Dice::new(k as u64);
        let mutated = text(
            &mut dice,
            CATALOGUE,
            &built_in[..built_in.len().min(1 << 16)],
        );
        watch.each(mutated.as_bytes(), || {
            let read = Catalogue::with_text(&mutated, "mine.toml");
            read.is_ok_and(|catalogue| catalogue.find("my 6205").is_some())
        });
    }
    watch.end();
}

#[test]
fn mutated_cases_are_read() {
    let seeds: Vec<String> = (files("crates/validate/cases", "toml").into_iter())
        .map(|(_, text)| String::from_utf8(text).expect("cases are UTF-8"))
        .collect();
    // the shape of a file of the reference implementation
    let json = r#"{"params": {"N": 10, "d": 0.008}, "tol_rel": 1e-6, "rows": [{"stars": 1, "k": 2e10}], "points": [[1, 2.5]]}"#;
    let mut watch = Watch::new("case");
    for k in 0..mutations() {
        let mut dice = Dice::new(k as u64);
        if dice.below(4) == 0 {
            let mutated = text(&mut dice, json, json);
            watch.each(mutated.as_bytes(), || {
                let value = serde_json::from_str(&mutated);
                value.is_ok_and(|value| reference::rows(&value, &LawsOnly).is_some())
            });
            continue;
        }
        let mutated = text(
            &mut dice,
            &seeds[k % seeds.len()],
            &seeds[(k + 1) % seeds.len()],
        );
        watch.each(mutated.as_bytes(), || {
            !case::rows(&mutated, &LawsOnly)
                .iter()
                .any(|row| row.damaged)
        });
    }
    watch.end();
}

#[test]
fn mutated_rotors_are_imported_or_refused() {
    let tests = repository("crates/auxbear/tests/scenario");
    let table = b"length [mm];outer diameter [mm];material;disk mass [kg]\n100;40;steel;\n250;60.5;steel;4.5\n";
    let names = ["ross_2.json", "ross_3.json", "sections.xlsx"];
    let mut seeds: Vec<Vec<u8>> = names.map(|name| fs::read(tests.join(name)).unwrap()).into();
    seeds.push(table.to_vec());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mutated");
    let mut watch = Watch::new("import");
    for k in 0..mutations() {
        let mut dice = Dice::new(k as u64);
        let seed = dice.of(&seeds);
        let mutated = bytes(&mut dice, seed, &seeds[k % seeds.len()]);
        fs::write(&path, &mutated).unwrap();
        watch.each(&mutated, || match import(&path) {
            Ok(imported) => !imported.toml.is_empty(),
            Err(problem) => {
                assert!(problem.to_string().starts_with("error[AB"), "{problem}");
                false
            }
        });
    }
    watch.end();
}

/// A file with one bit flipped.
fn flipped(dice: &mut Dice, seed: &[u8]) -> Vec<u8> {
    let mut flipped = seed.to_vec();
    flipped[dice.below(seed.len())] ^= 1 << dice.below(8);
    flipped
}

/// What is read of a damaged file is what was written, or nothing.
fn same(read: &str, written: &str) -> bool {
    assert!(read == written, "other numbers than were written");
    true
}

#[test]
fn study_directories_with_flipped_bits_are_read_or_refused() {
    const STUDY: &str = "format = \"auxbear.study/1\"\nscenario = \"drop.toml\"\nset = [\"run.duration=8 ms\", \
        \"run.accuracy=screening\"]\nseed = 3\n[design]\nkind = \"monte carlo\"\nmembers = 20\n[[input]]\n\
        path = \"contact.friction_coefficient\"\nlognormal = 0.2\n[question]\nresults = [\"first_impact_force\"]\n";
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    fs::write(place("study.toml"), STUDY).unwrap();
    fs::write(place("drop.toml"), template("drop").unwrap()).unwrap();
    let never = AtomicBool::new(false);
    let options = auxbear::run::Options::unwatched(&never);
    let study = Study::new(StudyFile::read(&place("study.toml")).unwrap()).unwrap();
    let directory = studies::Directory::open(&place("out"), study, 0).unwrap();
    directory.run(&options, &|_| {}).unwrap();
    let table = || studies::read(&place("out")).map(|(_, table)| format!("{table:?}"));
    let written = table().unwrap();
    let names = [
        "out/members/0000.parquet",
        "out/study.toml",
        "out/scenario.toml",
    ];
    let seeds = names.map(|name| fs::read(place(name)).unwrap());
    let mut watch = Watch::new("study-directory");
    for k in 0..mutations() {
        let mut dice = Dice::new(k as u64);
        // mostly the members, which have a checksum
        let which = [0, 0, 1, 2][dice.below(4)];
        let mutated = flipped(&mut dice, &seeds[which]);
        fs::write(place(names[which]), &mutated).unwrap();
        watch.each(&mutated, || {
            table().is_ok_and(|read| which != 0 || same(&read, &written))
        });
        fs::write(place(names[which]), &seeds[which]).unwrap();
    }
    watch.end();
}

#[test]
fn mutated_run_directories_are_reported_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole");
    let text = template("drop").unwrap();
    let sets = [
        "run.duration=1 ms".to_string(),
        "run.output_interval=0.05 ms".to_string(),
    ];
    let scenario = Scenario::parse(&text, "drop.toml", &sets, &BuiltIn).unwrap();
    let never = AtomicBool::new(false);
    let outcome = auxbear::run::run(&scenario, &auxbear::run::Options::unwatched(&never)).unwrap();
    directory::write(&whole, &scenario, &outcome).unwrap();
    let names = ["history.parquet", "summary.json", "scenario.toml"];
    let seeds = names.map(|name| fs::read(whole.join(name)).unwrap());
    let mutated_folder = folder.path().join("mutated");
    fs::create_dir(&mutated_folder).unwrap();
    for (name, seed) in names.iter().zip(&seeds) {
        fs::write(mutated_folder.join(name), seed).unwrap();
    }
    let mut watch = Watch::new("run-directory");
    let columns = || directory::read(&mutated_folder).map(|run| format!("{:?}", run.columns));
    let written = columns().unwrap();
    for k in 0..mutations() {
        let flipped = flipped(&mut Dice::new(k as u64), &seeds[0]);
        fs::write(mutated_folder.join(names[0]), &flipped).unwrap();
        watch.each(&flipped, || {
            columns().is_ok_and(|read| same(&read, &written))
        });
    }
    fs::write(mutated_folder.join(names[0]), &seeds[0]).unwrap();
    for k in 0..mutations() {
        let mut dice = Dice::new(k as u64);
        // half of them the history, whose end describes the rest
        let which = [0, 0, 1, 2][dice.below(4)];
        let mutated = match (which, dice.below(2)) {
            (0, 0) => {
                let at = seeds[0].len() - seeds[0].len() / 4;
                let end = bytes(&mut dice, &seeds[0][at..], &seeds[1]);
                [&seeds[0][..at], &end].concat()
            }
            _ => bytes(&mut dice, &seeds[which], &seeds[2]),
        };
        let path = mutated_folder.join(names[which]);
        fs::write(&path, &mutated).unwrap();
        watch.each(&mutated, || match directory::read(&mutated_folder) {
            Ok(run) => page::html(&[run]).contains("</html>"),
            Err(_) => false,
        });
        fs::write(&path, &seeds[which]).unwrap();
    }
    watch.end();
}
