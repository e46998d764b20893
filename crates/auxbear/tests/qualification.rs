//! Cases of a machine, and a study that judges each of them.

use crate::machine::{parsed, ran};
use crate::outcomes::number;
use auxbear::outcome::Verdict;
use auxbear::report::study::Directory;
use auxbear::run::{Options, build, of_other_cases};
use auxbear::scenario::StudyFile;
use auxbear::study::Study;
use std::fs;
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

const CASING: &str = include_str!("../../../scenarios/machine_casing.toml");

/// The machine, for 60 ms, its events earlier.
fn machine() -> String {
    CASING
        .replace(
            "duration = \"0.3 s\"",
            "duration = \"60 ms\"\naccuracy = \"screening\"",
        )
        .replace("\"50 ms\"", "\"5 ms\"")
}

/// An event that comes just before the end, whatever came before it.
#[test]
fn what_follows_an_event_needs_time() {
    let late = "\n[[event]]\nname = \"later\"\ndo = \"load\"\nnode = \"seal\"\nforce_y = \"-200 N\"\nat = ";
    let warned = |at: &str| {
        let run = ran(&format!("{}{late}\"{at}\"\n", machine()), &[]);
        run.warnings.iter().any(|own| own.code == "AB2085")
    };
    assert!(warned("57 ms") && !warned("9 ms"));
}

#[test]
fn what_names_a_case_happens_in_it_alone() {
    let machine = machine();
    let first = ran(&machine, &[]);
    let same = ran(&machine, &["run.case=power lost"]);
    assert_eq!(first.quantities, same.quantities);
    assert!(first.quantity("event.all_lost.time").is_some());
    assert!(first.quantity("event.one_lost.time").is_none());
    assert!(first.column("base.acceleration_x").is_none());
    assert!(number(&first, "drive_end.first_impact_force") > 0.0);

    // in each case, and not at the instant of the other loss
    let one = "do = \"axis lost\"\nmagnet = \"drive_end\"\naxis = 1\nat = ";
    let alone = machine.replace(
        &format!("case = \"axis lost\"\n{one}\"5 ms\""),
        &format!("{one}\"4 ms\""),
    );
    let both = ran(&alone, &["run.case=shock"]);
    assert!(both.quantity("event.one_lost.time").is_some());
    assert!(both.column("base.acceleration_x").is_some());
    let lost = ran(&machine, &["run.case=axis lost"]);
    assert!(lost.column("base.acceleration_x").is_none());
}

#[test]
fn a_case_that_is_none_is_refused_and_so_is_one_that_contradicts_itself() {
    let machine = machine();
    let refused = |text: &str, sets: &[&str]| parsed(text, sets).map(|_| ()).unwrap_err();
    let told = refused(&machine, &["run.case=power_lost"]);
    assert!(
        told.contains("run.case") && told.contains("power lost, axis lost, blade lost, shock"),
        "{told}"
    );
    let limit = "\n[[limit]]\nquantity = \"energy_residual\"\nmost = 1e-3\ncase = \"shok\"\n";
    let told = refused(&format!("{machine}{limit}"), &[]);
    assert!(
        told.contains("limit.case") && told.contains("Did you mean \"shock\"?"),
        "{told}"
    );
    // a result that its case has not, where another case happens
    let nothing = limit.replace("energy_residual", "event.nobody.time");
    let nothing = nothing.replace("shok", "shock");
    let scenario = parsed(&format!("{machine}{nothing}"), &[]).unwrap();
    let first = build(&scenario).unwrap();
    let told = of_other_cases(&scenario, &first).unwrap_err().to_string();
    assert!(told.contains("event.nobody.time"), "{told}");
    // whichever happens
    let again = "\n[[event]]\nname = \"again\"\ncase = \"axis lost\"\ndo = \"re-levitate\"\nbias_time = \"1 ms\"\nat = \"1 ms\"\n";
    let told = refused(&format!("{machine}{again}"), &[]);
    assert!(told.contains("event"), "{told}");
}

/// Without an event of magnets a default would begin each case with the loss of their power, whatever it is called.
#[test]
fn cases_say_when_the_magnets_lose_their_power() {
    let machine = machine();
    let (head, events) = machine.split_once("[[event]]").unwrap();
    let mut blade = events
        .split("[[event]]")
        .filter(|own| own.contains("\"unbalance\""));
    let text = format!("{head}[[event]]{}", blade.next().unwrap());
    let told = parsed(&text, &[]).map(|_| ()).unwrap_err();
    assert!(
        told.contains("levitation.power_lost_at") && told.contains("run.duration"),
        "{told}"
    );
    assert!(parsed(&text, &["levitation.power_lost_at=1 s"]).is_ok());
}

/// An event waits for one of its own case; a case without a loss of power has no instant of it, and a page says which case it shows.
#[test]
fn a_case_stands_apart_from_the_others() {
    let machine = machine();
    let waits = |after: &str| {
        let event = format!(
            "\n[[event]]\ncase = \"shock\"\ndo = \"brake\"\ntorque = \"1 N m\"\nafter = \"{after}\"\n"
        );
        parsed(&(machine.clone() + &event), &[]).unwrap_err()
    };
    let told = waits("blade");
    assert!(
        told.contains("in the case \"blade lost\" alone") && told.contains("of the same case"),
        "{told}"
    );
    // no key says when the power is lost where an event of any case does
    let told = waits("power_lost");
    assert!(told.contains("there is none"), "{told}");
    let resolved = |case: &str| {
        let scenario = parsed(&machine, &[&format!("run.case={case}")]).unwrap();
        scenario.resolved.toml()
    };
    assert!(!resolved("shock").contains("power_lost_at"));
    let (plain, _) = machine.split_once("[[event]]").unwrap();
    let plain = parsed(plain, &[]).unwrap();
    assert!(plain.resolved.toml().contains("power_lost_at"));
    let run = ran(&machine, &["run.case=shock"]);
    assert!(run.title.ends_with(": case shock"), "{}", run.title);
}

#[test]
fn a_limit_of_a_case_is_judged_in_it_alone_and_no_contact_is_no_force() {
    let limits = "\n[[limit]]\nquantity = \"drive_end.peak_contact_force\"\nmost = \"1 N\"\n\
        \n[[limit]]\ncase = \"axis lost\"\nquantity = \"drive_end.contact_count\"\nmost = 100\n";
    let machine = format!("{}{limits}", machine());
    let verdicts = |case: &str| -> Vec<Verdict> {
        let run = ran(&machine, &[&format!("run.case={case}")]);
        run.limits.iter().map(|judged| judged.verdict).collect()
    };
    assert_eq!(verdicts("power lost"), [Verdict::Fail]);
    assert_eq!(verdicts("blade lost"), [Verdict::Pass]);
    assert_eq!(verdicts("axis lost").len(), 2);
}

/// A qualification is each case at each level, with the draws that a run alone would have.
#[test]
fn a_qualification_judges_every_case_at_every_level() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("machine.toml"), machine()).unwrap();
    let study = "format = \"auxbear.study/1\"\nscenario = \"machine.toml\"\nseed = 2\n[design]\nkind = \"qualification\"\ndraws = 3\n\
        [[input]]\npath = \"rotor.speed\"\nchoice = [\"6000 rpm\", \"9000 rpm\"]\n\
        [[limit]]\nquantity = \"*.peak_contact_force\"\nmost = \"1 N\"\n\
        [[limit]]\ncase = \"shock\"\nquantity = \"housing.casing.largest_displacement\"\nmost = \"1 m\"\n";
    let path = folder.path().join("study.toml");
    fs::write(&path, study).unwrap();
    let study = Study::new(StudyFile::read(&path).unwrap()).unwrap();
    let written = study.file.toml();
    assert_eq!(study.members(), 4 * 2 * 3);
    let drawn = study.drawn(4);
    let directory = Directory::open(&folder.path().join("out"), study, 0).unwrap();
    let never = AtomicBool::new(false);
    let done = directory.run(&Options::unwatched(&never), &|_| {}).unwrap();
    let found: Vec<(String, Verdict, usize)> = (done.answer.ranking.iter())
        .map(|one| {
            let values: Vec<&str> = one.values.iter().map(|(_, value)| value.as_str()).collect();
            (values.join(", "), one.verdict, one.limits.len())
        })
        .collect();
    let names: Vec<&str> = found.iter().map(|(name, ..)| name.as_str()).collect();
    assert_eq!(
        names,
        [
            "power lost, 6000 rpm",
            "power lost, 9000 rpm",
            "axis lost, 6000 rpm",
            "axis lost, 9000 rpm",
            "blade lost, 6000 rpm",
            "blade lost, 9000 rpm",
            "shock, 6000 rpm",
            "shock, 9000 rpm",
        ]
    );
    for (name, verdict, limits) in &found {
        let shaken = name.starts_with("shock");
        assert_eq!(*limits, 2 + usize::from(shaken), "{name}");
        let wanted = match name.starts_with("blade lost") {
            true => Verdict::Pass,
            false => Verdict::Fail,
        };
        assert_eq!(*verdict, wanted, "{name}");
    }
    // the run behind a verdict is that of its member
    let worst = done.answer.ranking[1].worst[0].unwrap();
    assert!((3..6).contains(&worst), "{worst}");
    let sets: Vec<String> = (drawn.values.iter())
        .map(|(path, value)| format!("{path}={value}"))
        .collect();
    let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
    assert!(
        sets.iter()
            .any(|set| set.starts_with("rotor.unbalance_angle="))
    );
    let alone = ran(&machine(), &sets);
    let judged = &done.answer.ranking[1].limits[0];
    assert!(number(&alone, "drive_end.peak_contact_force") <= judged.value.unwrap());
    // what was asked reads again as it was resolved
    fs::write(folder.path().join("scenario.toml"), machine()).unwrap();
    fs::write(&path, &written).unwrap();
    assert_eq!(StudyFile::read(&path).unwrap().toml(), written);
}

/// A study of the machine, beside it; what is asked of it follows.
fn study_of(machine: &str, asked: &str) -> Result<(TempDir, Study), String> {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("machine.toml"), machine).unwrap();
    let path = folder.path().join("study.toml");
    let head = "format = \"auxbear.study/1\"\nscenario = \"machine.toml\"\n";
    fs::write(&path, format!("{head}{asked}")).unwrap();
    let study = StudyFile::read(&path).and_then(Study::new);
    study
        .map(|study| (folder, study))
        .map_err(|problem| problem.to_string())
}

const FORCE: &str = "[[limit]]\nquantity = \"*.peak_contact_force\"\nmost = \"1 MN\"\n";
const QUALIFIED: &str = "[design]\nkind = \"qualification\"\ndraws = 1\n";

#[test]
fn a_qualification_that_would_judge_nothing_is_refused() {
    let refused = |machine: &str, asked: &str| study_of(machine, asked).map(|_| ()).unwrap_err();
    let told = refused(&machine(), QUALIFIED);
    assert!(told.contains("no limit"), "{told}");
    let left_out = format!(
        "{QUALIFIED}[[input]]\npath = \"run.case\"\nchoice = [\"shock\"]\n[[limit]]\ncase = \"axis lost\"\nquantity = \"energy_residual\"\nmost = 1\n"
    );
    let told = refused(&machine(), &left_out);
    assert!(told.contains("left out"), "{told}");
    let unknown =
        format!("{QUALIFIED}[[input]]\npath = \"run.case\"\nchoice = [\"shok\"]\n{FORCE}");
    let told = refused(&machine(), &unknown);
    assert!(told.contains("shok"), "{told}");
    let told = refused(
        include_str!("../../../scenarios/machine_compressor.toml"),
        &format!("{QUALIFIED}{FORCE}"),
    );
    assert!(told.contains("without cases"), "{told}");
    let blank = machine().replace("case = \"axis lost\"", "case = \" \"");
    let told = parsed(&blank, &[]).map(|_| ()).unwrap_err();
    assert!(told.contains("event.one_lost.case"), "{told}");
}

/// What did not happen is not held, and what is judged in one case says nothing of another.
#[test]
fn a_case_whose_event_never_comes_is_undecided() {
    let late = machine().replace("axis = 1\nat = \"5 ms\"", "axis = 1\nat = \"2 s\"");
    let (folder, study) = study_of(&late, &format!("{QUALIFIED}{FORCE}")).unwrap();
    let never = AtomicBool::new(false);
    let directory = Directory::open(&folder.path().join("out"), study, 0).unwrap();
    let done = directory.run(&Options::unwatched(&never), &|_| {}).unwrap();
    let verdicts: Vec<Verdict> = done.answer.ranking.iter().map(|one| one.verdict).collect();
    let (pass, open) = (Verdict::Pass, Verdict::Undecided);
    // the shaken rotor slips on its races as well when its run ends, though its magnets have power
    assert_eq!(verdicts, [open, open, pass, open]);
    let why = |case: usize| done.answer.ranking[case].open.as_deref().unwrap();
    assert!(why(1).contains("AB2083"), "{}", why(1));
    // the rotor has landed, and slips still when its run ends
    for case in [0, 3] {
        assert!(
            why(case).starts_with("1 of 1 runs end while"),
            "{}",
            why(case)
        );
    }
    let (folder, study) = study_of(
        &machine(),
        &format!("set = [\"run.duration=8 ms\"]\n{QUALIFIED}{FORCE}"),
    )
    .unwrap();
    let directory = Directory::open(&folder.path().join("out"), study, 0).unwrap();
    let done = directory.run(&Options::unwatched(&never), &|_| {}).unwrap();
    let falling = &done.answer.ranking[0];
    assert_eq!(falling.verdict, open);
    assert!(
        falling.open.as_deref().unwrap().contains("not landed"),
        "{:?}",
        falling.open
    );
    // the rotor has touched nothing in the 3 ms since the blade was lost
    let just_lost = &done.answer.ranking[2];
    assert_eq!(just_lost.verdict, open);
    let why = just_lost.open.as_deref().unwrap();
    assert!(why.contains("AB2085"), "{why}");

    // runs that stop at a pole of a magnet have reached the seal: that stays broken, with its value
    let soft = "set = [\"mount.stiffness=1e4 N/m\", \"mount.damping=1 N s/m\"]\n";
    let limit = "[[limit]]\nquantity = \"node.seal.least_distance\"\nleast = \"20 um\"\n";
    let one = "[[input]]\npath = \"run.case\"\nchoice = [\"power lost\"]\n";
    let (folder, study) = study_of(&machine(), &format!("{soft}{QUALIFIED}{one}{limit}")).unwrap();
    let directory = Directory::open(&folder.path().join("out"), study, 0).unwrap();
    let done = directory.run(&Options::unwatched(&never), &|_| {}).unwrap();
    let stopped = &done.answer.ranking[0];
    assert_eq!((stopped.draws, stopped.verdict), ([1, 1], Verdict::Fail));
    assert!(stopped.limits[0].value.unwrap() < -0.2e-3);

    let other = "set = [\"run.case=blade lost\"]\n[design]\nkind = \"monte carlo\"\nmembers = 2\n[[input]]\npath = \"contact.friction_coefficient\"\nlognormal = 0.1\n\
        [[limit]]\ncase = \"axis lost\"\nquantity = \"drive_end.contact_count\"\nmost = 0\n";
    let (folder, study) = study_of(&machine(), other).unwrap();
    let directory = Directory::open(&folder.path().join("out"), study, 0).unwrap();
    let done = directory.run(&Options::unwatched(&never), &|_| {}).unwrap();
    let judged = &done.answer.limits[0].judged;
    assert_eq!(judged.verdict, Verdict::Undecided, "{}", judged.why);
}

/// Instants count from the release: what did not come in the 55 ms after it is not past 57 ms, though the run lasted 60.
#[test]
fn an_instant_that_did_not_come_is_judged_from_the_release_on() {
    let judged = |bound: &str, case: &str| {
        let limit = format!("limit.drive_end.inner_race_time_to_95_percent.most={bound}");
        let run = ran(&machine(), &[&format!("run.case={case}"), &limit]);
        run.limits[0].verdict
    };
    assert_eq!(judged("57 ms", "power lost"), Verdict::Undecided);
    assert_eq!(judged("53 ms", "power lost"), Verdict::Fail);
    // a race that the rotor does not touch comes to no speed, and need not
    assert_eq!(judged("1 ms", "blade lost"), Verdict::Pass);
}
