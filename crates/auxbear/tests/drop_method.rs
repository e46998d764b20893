//! Which steps a drop takes, and that threads change nothing.

use auxbear::scenario::{BuiltIn, Scenario, template};
use auxbear::simulate::{Options, Outcome, run};
use std::sync::atomic::AtomicBool;

/// A drop of the starting file, until after its first impact.
fn outcome(sets: &[&str], threads: usize) -> Outcome {
    let text = template("drop").expect("a drop has a starting file");
    let mut all = vec![String::from("run.duration=10 ms")];
    all.extend(sets.iter().map(|set| (*set).to_string()));
    let scenario = Scenario::parse(&text, "drop.toml", &all, &BuiltIn).expect("it is right");
    let interrupt = AtomicBool::new(false);
    let options = Options {
        threads: Some(threads),
        ..Options::unwatched(&interrupt)
    };
    run(&scenario, &options).expect("it builds")
}

fn method(outcome: &Outcome) -> &'static str {
    outcome.work.method.expect("something moves")
}

const STIFF: &str = "bearing.traction.reference_speed=0.001 m/s";

#[test]
fn stiff_friction_takes_implicit_steps_by_itself() {
    assert!(method(&outcome(&[], 1)).contains("explicit"));
    let stiff = outcome(&[STIFF], 1);
    assert!(method(&stiff).contains("implicit"), "{:?}", stiff.work);
    assert!(stiff.stop.complete());
    let forced = outcome(&[STIFF, "run.method=explicit"], 1);
    assert!(method(&forced).contains("explicit"));
    assert!(forced.work.steps > 5 * stiff.work.steps);
    let rolling = outcome(&["bearing.fidelity=rolling", "run.method=implicit"], 1);
    assert!(
        method(&rolling).contains("explicit"),
        "balls that roll have no friction to be stiff"
    );
}

#[test]
fn implicit_members_are_the_same_on_any_number_of_threads() {
    let sets = [STIFF, "repeat.count=5"];
    let (one, three) = (outcome(&sets, 1), outcome(&sets, 3));
    assert_eq!(one.members.len(), 5);
    assert_eq!(one.members, three.members);
    assert_eq!(one.quantities, three.quantities);
}
