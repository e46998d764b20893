//! Limits of a file: what is read, refused, judged and written back.

use super::several::{HEAD, TWINS, outcome, read};
use auxbear::outcome::{Judged, Value, Verdict};
use auxbear::problem::Code;
use auxbear::run::{Options, build, run};
use auxbear::scenario::{BuiltIn, Scenario, Side, SystemName, template};
use std::sync::atomic::AtomicBool;

/// The head of a drop with a limit of these lines.
fn limited(lines: &str) -> String {
    format!("{HEAD}\n[[limit]]\n{lines}\n")
}

fn judged(text: &str, sets: &[&str]) -> Vec<Judged> {
    outcome(text, sets).limits
}

#[test]
fn a_limit_is_judged_by_the_value_of_the_run() {
    let text = limited("quantity = \"first_impact_force\"\nmost = \"5 kN\"");
    let run = outcome(&text, &[]);
    let force = (run.quantities.iter()).find(|quantity| quantity.name == "first_impact_force");
    let Value::Number(force) = force.unwrap().value else {
        panic!("it is a number");
    };
    let [limit] = run.limits.as_slice() else {
        panic!("there is one limit");
    };
    assert_eq!((limit.limit.side, limit.limit.bound), (Side::Most, 5000.0));
    assert_eq!((limit.value, limit.unit), (Some(force), "N"));
    assert!(force < 5000.0 && limit.verdict == Verdict::Pass);
    assert!(run.stop.complete());
    // and for other programs
    let json = serde_json::to_value(&run).unwrap();
    assert_eq!(json["limits"][0]["limit"], "first_impact_force most 5 kN");
    assert_eq!(json["limits"][0]["verdict"], "pass");
    assert_eq!(json["quantities"][0]["name"], run.quantities[0].name);
    assert_eq!(
        json["history"][0]["values"],
        serde_json::json!(run.history[0].values)
    );

    let failed = judged(&text, &["limit.first_impact_force.most=10 N"]);
    assert_eq!(failed.len(), 1);
    assert_eq!(failed[0].verdict, Verdict::Fail);
    assert!(
        failed[0].why.ends_with("above the bound"),
        "{}",
        failed[0].why
    );
    let both = judged(&text, &["limit.first_impact_force.least=10 N"]);
    assert_eq!(both.len(), 2);
    assert!(both.iter().all(|limit| limit.verdict == Verdict::Pass));
}

#[test]
fn what_is_not_reached_is_not_decided() {
    // 15 ms are too short
    let text = limited("quantity = \"inner_race_time_to_95_percent\"\nmost = \"1 s\"");
    let limits = judged(&text, &[]);
    assert_eq!(limits[0].verdict, Verdict::Undecided);
    assert_eq!(limits[0].value, None);
    assert!(
        limits[0].why.contains("was not reached"),
        "{}",
        limits[0].why
    );
}

#[test]
fn an_instant_that_the_run_outlasted_is_past_its_bound() {
    // 15 ms are too short for the race, and longer than 10 ms
    let text = limited("quantity = \"inner_race_time_to_95_percent\"\nmost = \"10 ms\"");
    let late = judged(&text, &[]);
    assert_eq!((late[0].verdict, late[0].value), (Verdict::Fail, None));
    assert!(late[0].why.contains("past the bound"), "{}", late[0].why);
    let least = limited("quantity = \"inner_race_time_to_95_percent\"\nleast = \"10 ms\"");
    assert_eq!(judged(&least, &[])[0].verdict, Verdict::Pass);
    // the run may have missed it by a little
    let open = judged(&least, &["run.duration=9 ms"]);
    assert_eq!(open[0].verdict, Verdict::Undecided);
    let members = judged(&text, &["repeat.count=5"]);
    assert_eq!(members[0].verdict, Verdict::Fail);
    assert!(
        members[0]
            .why
            .contains("5 of 5 members break it; in 5 it did not come"),
        "{}",
        members[0].why
    );
}

#[test]
fn a_vertical_shaft_gets_no_verdict() {
    let text = limited("quantity = \"peak_contact_force\"\nmost = \"1 MN\"");
    assert_eq!(judged(&text, &[SPUN_UP])[0].verdict, Verdict::Pass);
    for gravity in ["0", "0.4"] {
        let across = format!("gravity.acceleration={gravity} m/s^2");
        let limits = judged(&text, &[&across, SPUN_UP]);
        assert_eq!(limits[0].verdict, Verdict::Undecided);
        assert!(limits[0].why.contains("AB1095"), "{}", limits[0].why);
    }
}

#[test]
fn members_too_few_for_the_share_do_not_decide() {
    let text = limited("quantity = \"first_impact_force\"\nmost = \"5 kN\"\nshare = 0.8");
    let few = judged(&text, &["repeat.count=6"]);
    assert_eq!((few[0].members, few[0].hold), (6, 6));
    assert_eq!(few[0].verdict, Verdict::Undecided);
    // 0.8^14 < 5 % < 0.8^13
    assert!(few[0].why.contains("8 more"), "{}", few[0].why);
    let enough = judged(&text, &["repeat.count=14"]);
    assert_eq!(enough[0].verdict, Verdict::Pass);
    let all = judged(
        &text,
        &["repeat.count=6", "limit.first_impact_force.share=1"],
    );
    assert_eq!(all[0].verdict, Verdict::Pass);
}

/// After 40 ms the race no longer slips.
const SPUN_UP: &str = "run.duration=100 ms";

/// The verdict of a limit of warnings, and why.
fn without(key: &str, sets: &[&str]) -> (Verdict, String) {
    let judged = judged(&limited(key), &[sets, &[SPUN_UP]].concat()).remove(0);
    (judged.verdict, judged.why)
}

#[test]
fn a_warning_that_must_not_come_is_a_limit() {
    let soft = ["bearing.hertz_pressure_limit=500 MPa"];
    let (verdict, why) = without("warning = \"AB1002\"", &[]);
    assert_eq!((verdict, why.as_str()), (Verdict::Pass, "no such warning"));
    for key in [
        "warning = \"AB1002\"",
        "severity = \"invalid\"",
        "severity = \"note\"",
    ] {
        assert_eq!(without(key, &soft).0, Verdict::Fail, "{key}");
    }
    let (_, why) = without("warning = \"ab1002\"", &soft);
    assert!(why.starts_with("AB1002 The peak Hertz pressure"), "{why}");
    // by --set alone
    let set = [
        "limit.warning=AB2300",
        "limit.warning=AB1002",
        soft[0],
        SPUN_UP,
    ];
    let verdicts: Vec<Verdict> = (judged(HEAD, &set).iter()).map(|own| own.verdict).collect();
    assert_eq!(verdicts, [Verdict::Pass, Verdict::Fail]);
}

#[test]
fn a_warning_that_could_not_come_decides_nothing() {
    let (verdict, why) = without("warning = \"AB2301\"", &[]);
    assert_eq!(verdict, Verdict::Undecided);
    assert!(why.contains("contact.width is not given"), "{why}");
    // a rigid rotor has no clearances along its shaft
    let (verdict, why) = without("warning = \"AB2030\"", &[]);
    assert_eq!(verdict, Verdict::Undecided);
    assert!(why.contains("this run has no clearance_positions"), "{why}");
    let wide = "contact.width=10 mm";
    assert_eq!(without("warning = \"AB2301\"", &[wide]).0, Verdict::Pass);
    for key in ["warning = \"AB1014\"", "severity = \"destroys\""] {
        let (verdict, why) = without(key, &[wide]);
        assert_eq!(verdict, Verdict::Undecided, "{key}");
        assert!(why.contains("unbalance angles"), "{why}");
    }
}

#[test]
fn a_warning_that_did_not_come_yet_decides_nothing() {
    let text = limited("severity = \"destroys\"");
    let scenario = read(&text, &[]).unwrap();
    let ended = run(&scenario, &Options::unwatched(&AtomicBool::new(true))).unwrap();
    assert!(ended.stop.interrupted());
    assert_eq!(ended.limits[0].verdict, Verdict::Undecided);
    assert!(
        ended.limits[0].why.contains("nterrupted"),
        "{:?}",
        ended.limits
    );
    // what came stays so
    let text = limited("warning = \"AB1094\"");
    let scenario = read(&text, &["rotor.unbalance_eccentricity=100 um"]).unwrap();
    let ended = run(&scenario, &Options::unwatched(&AtomicBool::new(true))).unwrap();
    assert_eq!(ended.limits[0].verdict, Verdict::Fail);
}

#[test]
fn members_with_a_warning_count_where_it_is_evaluated() {
    let four = "repeat.count=4";
    let soft = [four, "bearing.hertz_pressure_limit=500 MPa"];
    let (verdict, why) = without("warning = \"AB1002\"", &soft);
    assert_eq!(verdict, Verdict::Fail);
    assert!(why.starts_with("4 of 4 members break it: AB1002 "), "{why}");
    let (verdict, why) = without("warning = \"AB2300\"", &[four]);
    assert_eq!(verdict, Verdict::Pass, "{why}");
    assert!(why.starts_with("all 4 members hold it"), "{why}");
    let (verdict, why) = without("warning = \"AB1004\"", &[four]);
    assert_eq!(verdict, Verdict::Undecided);
    assert!(
        why.contains("AB1004 is evaluated in the unperturbed member alone"),
        "{why}"
    );
    // a share that one of the members decides
    let some = [four, "limit.warning=AB1126"];
    assert_eq!(judged(HEAD, &some)[0].verdict, Verdict::Fail);
}

#[test]
fn the_first_impact_is_decided_once_it_is_over() {
    let text = limited("quantity = \"first_impact_force\"\nmost = \"5 kN\"");
    // in the fall, in the first blow, after it
    for (duration, verdict, code) in [
        ("6 ms", Verdict::Undecided, "AB2424"),
        ("7.2 ms", Verdict::Undecided, "AB2423"),
        ("20 ms", Verdict::Pass, ""),
    ] {
        let set = format!("run.duration={duration}");
        for sets in [vec![&*set], vec![&*set, "repeat.count=2"]] {
            let found = &judged(&text, &sets)[0];
            assert_eq!(found.verdict, verdict, "{sets:?}: {}", found.why);
            assert!(sets.len() > 1 || found.why.contains(code), "{}", found.why);
        }
    }
    // and of a machine before what happens to it has happened, and while it still strikes
    let blade = include_str!("../../../../scenarios/machine_blade_loss.toml");
    let limit = "limit.drive_end.first_impact_force.most=200 N";
    for duration in ["run.duration=10 ms", "run.duration=24.35 ms"] {
        let found = judged(blade, &[duration, limit]);
        let found = found.last().expect("it is the last");
        assert_eq!(found.verdict, Verdict::Undecided, "{}", found.why);
    }
    // what may still grow may come to it
    let least = text.replace("most", "least");
    for sets in [
        vec!["run.duration=7.2 ms"],
        vec!["run.duration=7.2 ms", "repeat.count=2"],
    ] {
        let found = &judged(&least, &sets)[0];
        assert_eq!(found.verdict, Verdict::Undecided, "{}", found.why);
    }
    let broken = text.replace("5 kN", "10 N");
    let found = &judged(&broken, &["run.duration=7.2 ms"])[0];
    assert_eq!(found.verdict, Verdict::Fail, "{}", found.why);
}

#[test]
fn a_warning_that_a_rigid_drop_never_gives_is_no_limit_of_it() {
    for code in ["AB2044", "AB1043", "AB1052"] {
        let scenario = read(&limited(&format!("warning = \"{code}\"")), &[]).unwrap();
        let refused = build(&scenario).err().map(|problem| problem.to_string());
        assert!(refused.is_some_and(|text| text.contains(code)), "{code}");
    }
    // and is missed in none of its members
    let severe = limited("severity = \"destroys\"");
    let sets = [
        "run.duration=150 ms",
        "repeat.count=8",
        "contact.width=10 mm",
    ];
    let found = &judged(&severe, &sets)[0];
    assert_eq!(found.verdict, Verdict::Pass, "{}", found.why);
}

#[test]
fn limits_of_warnings_are_written_back_and_refused_with_near_names() {
    let lines = "severity = \"invalid\"\nshare = 0.9\n\n[[limit]]\nwarning = \"AB2030\"";
    let scenario = read(&limited(lines), &[]).unwrap();
    let again = read(&scenario.resolved.toml(), &[]).unwrap();
    let known = |scenario: &Scenario| -> Vec<_> {
        let limits = scenario.limits.iter();
        limits.map(|own| (own.forbids.clone(), own.share)).collect()
    };
    assert_eq!(known(&again), known(&scenario));
    assert_eq!(known(&again).len(), 2);
    for (lines, code, told) in [
        (
            "warning = \"AB2039\"",
            Code::UnknownQuantity,
            "Did you mean \"AB2030\"",
        ),
        (
            "warning = \"AB0103\"",
            Code::UnknownQuantity,
            "which is no warning",
        ),
        (
            "severity = \"destroy\"",
            Code::UnknownWord,
            "Did you mean \"destroys\"?",
        ),
        (
            "severity = \"note\"\nmost = 1",
            Code::Conflict,
            "no bound is needed",
        ),
        (
            "severity = \"note\"\nwarning = \"AB2030\"",
            Code::Conflict,
            "warning and severity in one limit",
        ),
        (
            "share = 0.5",
            Code::MissingKey,
            "limit.quantity: found no value",
        ),
    ] {
        let problem = match read(&limited(lines), &[]) {
            Err(problem) => problem,
            Ok(scenario) => build(&scenario).err().unwrap_or_else(|| panic!("{lines}")),
        };
        assert_eq!(problem.code, code, "{problem}");
        assert!(problem.to_string().contains(told), "{problem}");
    }
}

#[test]
fn a_star_is_every_bearing_and_the_only_one() {
    const LIMIT: &str = "[[limit]]\nquantity = \"*.first_impact_force\"\nleast = \"1 N\"\n";
    let names = |text: &str| -> Vec<String> {
        let limits = judged(text, &[]);
        assert!(limits.iter().all(|held| held.verdict == Verdict::Pass));
        limits.into_iter().map(|held| held.limit.quantity).collect()
    };
    let two = names(&format!("{HEAD}{TWINS}\n{LIMIT}"));
    assert_eq!(
        two,
        [
            "drive_end.first_impact_force",
            "other_end.first_impact_force"
        ]
    );
    assert_eq!(names(&format!("{HEAD}\n{LIMIT}")), ["first_impact_force"]);
    let none = LIMIT.replace("impact_force", "impact_forse");
    let scenario = read(&format!("{HEAD}{TWINS}\n{none}"), &[]).unwrap();
    let message = build(&scenario).err().unwrap().to_string();
    assert!(
        message.contains("Did you mean \"*.first_impact_force\""),
        "{message}"
    );
    let wrong = LIMIT.replace("1 N", "1 mm");
    let scenario = read(&format!("{HEAD}{TWINS}\n{wrong}"), &[]).unwrap();
    assert_eq!(build(&scenario).err().unwrap().code, Code::WrongDimension);
}

#[test]
fn one_of_several_bearings_has_its_own() {
    let text = format!(
        "{HEAD}{TWINS}\n[[limit]]\nquantity = \"drive_end.first_impact_force\"\nleast = \"1 N\"\n"
    );
    assert_eq!(judged(&text, &[])[0].verdict, Verdict::Pass);
    let bare = text.replace("drive_end.first", "first");
    let problem = build(&read(&bare, &[]).unwrap()).err().unwrap();
    assert_eq!(problem.code, Code::UnknownQuantity);
    let message = problem.to_string();
    let line = bare.lines().position(|line| line.starts_with("quantity"));
    assert!(
        message.contains(&format!("two.toml:{}", line.unwrap() + 1)),
        "{message}"
    );
    assert!(
        message.contains(
            "Did you mean \"drive_end.first_impact_force\" or \"other_end.first_impact_force\"?"
        ),
        "{message}"
    );
}

#[test]
fn a_wrong_limit_is_refused_before_the_run() {
    for (lines, code, told) in [
        (
            "quantity = \"peak_contact_forse\"\nmost = \"5 kN\"",
            Code::UnknownQuantity,
            "Did you mean \"peak_contact_force\"",
        ),
        (
            "quantity = \"peak_contact_force\"\nmost = \"5 mm\"",
            Code::WrongDimension,
            "peak_contact_force is force (N)",
        ),
        (
            "quantity = \"peak_*\"\nmost = \"5 kN\"",
            Code::WrongDimension,
            "is pressure (Pa)",
        ),
        (
            "quantity = \"peak_contact_force\"\nmost = 5",
            Code::WrongDimension,
            "a bare number",
        ),
        (
            "quantity = \"contact_count\"\nmost = \"5 N\"",
            Code::WrongDimension,
            "contact_count is a bare number",
        ),
        (
            "quantity = \"peak_contact_force\"\nmost = \"5\"",
            Code::BareNumber,
            "most = \"5 kN\"",
        ),
        (
            "quantity = \"peak_contact_force\"\nmost = \"5 kN\"\nleast = \"1 N\"",
            Code::Conflict,
            "both most and least",
        ),
        (
            "quantity = \"peak_contact_force\"",
            Code::MissingKey,
            "without most or least",
        ),
        (
            "most = \"5 kN\"",
            Code::MissingKey,
            "limit.quantity: found no value",
        ),
        (
            "quantity = \"peak_contact_force\"\nmax = \"5 kN\"",
            Code::UnknownKey,
            "Did you mean \"most\"?",
        ),
        (
            "quantity = \"peak_contact_force\"\nmost = \"5 kN\"\nshare = 1.5",
            Code::OutOfRange,
            "not above 1",
        ),
        (
            "quantity = \"contact_start_times\"\nmost = \"5 ms\"",
            Code::UnknownQuantity,
            "which is a list",
        ),
        (
            "quantity = \"whirl_direction\"\nmost = 5",
            Code::UnknownQuantity,
            "which is a word",
        ),
        (
            "quantity = \"rotor_race_friction_energy_per_area\"\nmost = \"5 kJ/m^2\"",
            Code::UnknownQuantity,
            "contact.width is not given",
        ),
        (
            "quantity = 7\nmost = \"5 kN\"",
            Code::WrongType,
            "a text in quotes is needed",
        ),
    ] {
        let text = limited(lines);
        let problem = match read(&text, &[]) {
            Err(problem) => problem,
            Ok(scenario) => build(&scenario).err().unwrap_or_else(|| panic!("{lines}")),
        };
        let message = problem.to_string();
        assert_eq!(problem.code, code, "{message}");
        assert!(
            message.contains("two.toml:") && message.contains("limit"),
            "{message}"
        );
        assert!(message.contains(told), "{message}");
    }
    let single = format!("{HEAD}\n[limit]\nquantity = \"contact_count\"\nmost = 5\n");
    assert_eq!(read(&single, &[]).unwrap_err().code, Code::WrongType);
    let share = read(
        &limited("quantity = \"contact_count\"\nmost = 5"),
        &["limit.peak_contact_force.share=0.9"],
    );
    assert_eq!(share.unwrap_err().code, Code::MissingKey);
}

#[test]
fn the_resolved_file_has_the_same_limits() {
    let text = limited("quantity = \"peak_contact_force\"\nmost = \"5 kN\"\nshare = 0.95");
    let scenario = read(&text, &["limit.contact_count.least=3"]).unwrap();
    let again = read(&scenario.resolved.toml(), &[]).unwrap();
    let known = |scenario: &Scenario| -> Vec<_> {
        let limits = scenario.limits.iter();
        limits
            .map(|limit| (limit.quantity.clone(), limit.side, limit.bound, limit.share))
            .collect()
    };
    assert_eq!(known(&scenario), known(&again));
    assert_eq!(
        known(&scenario)[1],
        ("contact_count".to_string(), Side::Least, 3.0, 1.0)
    );
}

/// The lines of each starting file that show a limit.
#[test]
fn the_example_of_each_starting_file_is_a_limit_of_its_results() {
    for system in [
        SystemName::Drop,
        SystemName::SpinUp,
        SystemName::Torque,
        SystemName::Rig,
    ] {
        let text = template(system.word()).unwrap();
        let at = text.find("# [[limit]]").expect("it shows one");
        let (head, example) = text.split_at(at);
        let example = example.replace("# [[", "[[").replace("\n# ", "\n");
        let text = format!("{head}{example}");
        let scenario = Scenario::parse(&text, system.word(), &[], &BuiltIn).unwrap();
        assert_eq!(scenario.limits.len(), 1);
        build(&scenario).map(|_| ()).unwrap();
    }
}
