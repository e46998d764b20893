//! Half a second of a drop beside an ensemble.

use serde_json::Value;
use std::collections::BTreeMap;
use validate::reference::{self, DropReference};
use validate::simulator::DropAnswer;
use validate::{Row, Simulator, Verdict};

/// A drop of the reference, short.
pub fn file() -> Value {
    serde_json::from_str(include_str!("drop.json")).unwrap()
}

/// Gives an answer that is known.
struct Known(DropAnswer);

impl Simulator for Known {
    fn drop(&self, _: &DropReference) -> Result<DropAnswer, String> {
        Ok(self.0.clone())
    }
}

fn compare(answer: DropAnswer) -> Vec<Row> {
    reference::rows(&file(), &Known(answer)).expect("a drop")
}

#[test]
fn spread_and_mean_bound_the_answer() {
    let answer = DropAnswer {
        values: BTreeMap::from([
            ("peak1", Some(675.5 + 5.0 * 0.04 + 0.06)),
            ("peak_all", Some(676.0)),
            ("maxouter", Some(3e-5 * 1.00025)),
        ]),
        contact_start_times: vec![0.007],
    };
    let rows = compare(answer);
    let verdict = |name: &str| {
        rows.iter()
            .find(|row| row.quantity == name)
            .unwrap()
            .verdict
    };
    assert_eq!(verdict("first_impact_force"), Verdict::Pass);
    assert_eq!(verdict("peak_contact_force"), Verdict::Fail);
    assert_eq!(verdict("max_mount_displacement"), Verdict::Pass);
    // null in the reference and nothing from us: as it must be
    assert_eq!(verdict("cage_time_to_95_percent_of_rolling"), Verdict::Pass);
    // in the reference but not with us
    assert_eq!(verdict("contact_start_times[01]"), Verdict::Fail);
    assert_eq!(verdict("contact_start_times[00]"), Verdict::Pass);
}
#[test]
fn an_event_that_must_not_happen_fails() {
    let answer = DropAnswer {
        values: BTreeMap::from([("t_cage_95%roll", Some(0.04))]),
        ..DropAnswer::default()
    };
    let rows = compare(answer);
    let row = rows
        .iter()
        .find(|row| row.quantity == "cage_time_to_95_percent_of_rolling")
        .unwrap();
    assert_eq!(row.verdict, Verdict::Fail);
}
