//! Scenarios whose numbers were changed, run under a budget: they end, and what was computed is kept.

use crate::inputs::scenarios;
use crate::mutator::{Dice, numbers};
use crate::watch::{Watch, count};
use auxbear::report::directory;
use auxbear::run::{Options, build};
use auxbear::scenario::{BuiltIn, Scenario, SystemName};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Runs of each system and their budget in the short form.
const USUAL: usize = 2;
const SHORT: Duration = Duration::from_millis(200);
/// The budget in the long form.
const LONG: Duration = Duration::from_secs(10);
/// Time from an interrupt to the end, with the writing of what was computed.
const HEEDED: Duration = Duration::from_secs(5);
/// Mutations that are tried for one that can be run.
const TRIES: u64 = 50;

#[test]
fn mutated_scenarios_end_and_keep_what_was_computed() {
    let runs = count("AUXBEAR_MUTATED_RUNS", USUAL);
    let budget = if runs > USUAL { LONG } else { SHORT };
    let folder = tempfile::tempdir().unwrap();
    let seeds = scenarios();
    for &system in SystemName::ALL.iter() {
        let word = system.word();
        let of_system = |text: &str, name: &str| {
            let read = Scenario::parse(text, name, &[], &BuiltIn);
            read.is_ok_and(|scenario| scenario.system.name() == system && build(&scenario).is_ok())
        };
        let seeds: Vec<&(String, String)> = (seeds.iter())
            .filter(|(name, text)| of_system(text, name))
            .collect();
        if seeds.is_empty() {
            println!("{word}: no scenario that can be run as it is");
            continue;
        }
        let mut watch = Watch::new(word);
        for k in 0..runs as u64 {
            let tried = (0..TRIES).find_map(|part| {
                let mut dice = Dice::new(k * TRIES + part);
                let (name, seed) = dice.of(&seeds);
                let text = numbers(&mut dice, seed);
                of_system(&text, name).then_some((name, text))
            });
            let Some((name, text)) = tried else {
                continue;
            };
            let out = folder.path().join(format!("{word}-{k}"));
            watch.budgeted(text.as_bytes(), budget + HEEDED, || {
                let scenario = Scenario::parse(&text, name, &[], &BuiltIn).unwrap();
                let interrupt = AtomicBool::new(false);
                let ended = AtomicBool::new(false);
                let begin = Instant::now();
                std::thread::scope(|scope| {
                    scope.spawn(|| {
                        while !ended.load(Ordering::Relaxed) {
                            std::thread::sleep(Duration::from_millis(5));
                            if begin.elapsed() > budget {
                                interrupt.store(true, Ordering::Relaxed);
                            }
                        }
                    });
                    let options = Options {
                        threads: Some(1),
                        ..Options::unwatched(&interrupt)
                    };
                    let outcome = auxbear::run::run(&scenario, &options);
                    ended.store(true, Ordering::Relaxed);
                    let outcome = outcome.expect("what is built can be run");
                    directory::write(&out, &scenario, &outcome).expect("what was computed is kept");
                    let kept = directory::read(&out).expect("what is kept can be read");
                    let summary: serde_json::Value =
                        serde_json::from_str(&kept.summary_json).unwrap();
                    assert_eq!(summary["complete"], outcome.stop.complete());
                    std::fs::remove_dir_all(&out).unwrap();
                    outcome.stop.complete()
                })
            });
        }
        watch.end();
    }
}
