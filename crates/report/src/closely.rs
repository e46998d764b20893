//! The part of a run that its page shows closely, and of which it therefore keeps every row.

use serde_json::Value;
use std::collections::BTreeMap;

/// Contacts that the close-up of a drop shows.
const CONTACTS: usize = 4;
/// Shortest and longest close-up of a drop after its first contact, s.
const SHORTEST: f64 = 5e-3;
const LONGEST: f64 = 30e-3;
/// Room before and behind a close-up over its length.
const BEFORE: f64 = 0.1;
const BEHIND: f64 = 0.15;

/// Begin and end of the close-up, s, by the bearing it belongs to (an empty name for all): the first contacts of a drop, the engagement
/// of a test. Empty where nothing of the kind happened, or the summary is none.
pub(super) fn windows(summary_json: &str) -> BTreeMap<String, [f64; 2]> {
    let summary: Value = serde_json::from_str(summary_json).unwrap_or_default();
    let mut contacts: BTreeMap<String, Vec<(f64, f64)>> = BTreeMap::new();
    for contact in summary["contacts"].as_array().into_iter().flatten() {
        let Some(start) = contact["start_s"].as_f64() else {
            continue;
        };
        let end = contact["end_s"].as_f64().unwrap_or(start);
        let bearing = contact["auxiliary_bearing"].as_str().unwrap_or_default();
        let known = contacts.entry(bearing.to_string()).or_default();
        known.push((start, end));
    }
    let first = contacts.into_iter().filter_map(|(bearing, mut list)| {
        list.sort_by(|one, other| one.0.total_cmp(&other.0));
        let start = list.first()?.0;
        let end = list.get(CONTACTS - 1).or(list.last())?.1;
        Some((
            bearing,
            [start, start + (end - start).clamp(SHORTEST, LONGEST)],
        ))
    });
    // the instants of a quick change, as the table lists them
    let all = summary["quantities"].as_object();
    let change = all.into_iter().flat_map(|all| all.values());
    let instants = change.filter(|quantity| quantity["shown"]["change"].is_string());
    let known = instants.map(|quantity| quantity["value"].as_f64());
    let known: Vec<f64> = known.collect::<Option<_>>().unwrap_or_default();
    let begin = known.iter().copied().fold(f64::INFINITY, f64::min);
    let end = known.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let quick = (begin < end).then(|| (String::new(), [begin, end]));
    first
        .chain(quick)
        .map(|(bearing, [begin, end])| {
            let length = end - begin;
            (bearing, [begin - BEFORE * length, end + BEHIND * length])
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn window(summary: &str) -> [f64; 2] {
        windows(summary)[""]
    }

    #[test]
    fn the_first_contacts_are_seen_closely() {
        // 4.5 to 22 ms: the first four of five, with 1.75 ms before and 2.625 ms behind
        let contacts = [
            [4.5, 6.0],
            [12.0, 14.0],
            [17.0, 18.0],
            [20.0, 22.0],
            [90.0, 99.0],
        ]
        .map(|[start, end]| {
            format!(
                "{{\"start_s\": {}, \"end_s\": {}}}",
                start * 1e-3,
                end * 1e-3
            )
        })
        .join(",");
        let [begin, end] = window(&format!("{{\"contacts\": [{contacts}]}}"));
        assert!((begin - 2.75e-3).abs() < 1e-9 && (end - 24.625e-3).abs() < 1e-9);
    }

    #[test]
    fn a_single_contact_and_one_that_lasts_have_bounds() {
        let [begin, end] = window("{\"contacts\": [{\"start_s\": 0.01, \"end_s\": 0.0101}]}");
        assert!((end - begin - 1.25 * SHORTEST).abs() < 1e-12);
        let [begin, end] = window("{\"contacts\": [{\"start_s\": 0.01, \"end_s\": 2.0}]}");
        assert!((end - begin - 1.25 * LONGEST).abs() < 1e-12);
    }

    #[test]
    fn the_engagement_of_a_test_is_seen_closely() {
        let text = |figure: &str| {
            let instant =
                |value: f64| format!("{{\"value\": {value}, \"shown\": {{\"{figure}\": \"\"}}}}");
            format!(
                "{{\"quantities\": {{\"begin\": {}, \"end\": {}}}}}",
                instant(0.2),
                instant(0.226)
            )
        };
        let [begin, end] = window(&text("change"));
        assert!((begin - 0.1974).abs() < 1e-9 && (end - 0.2299).abs() < 1e-9);
        assert!(windows(&text("elsewhere")).is_empty());
    }

    #[test]
    fn what_is_damaged_has_none() {
        for text in [
            "",
            "{",
            "[]",
            "{\"contacts\": 3}",
            "{\"contacts\": [{}, 1, null]}",
        ] {
            assert!(windows(text).is_empty(), "{text}");
        }
    }
}
