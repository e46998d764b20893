//! Machines with bearings in space.

use crate::coast_down::list;
use crate::machine::{parsed, ran};
use crate::outcomes::number;
use auxbear::outcome::Value;
use auxbear::run::{Options, run, stiffness};
use std::sync::atomic::AtomicBool;

const FLYWHEEL: &str = include_str!("../../../scenarios/vertical_flywheel.toml");
const AGAIN: &str = include_str!("../../../scenarios/machine_relevitation.toml");

#[test]
fn a_vertical_rotor_falls_freely_onto_the_face_of_its_pair() {
    let fallen_onto = ran(
        FLYWHEEL,
        &["run.duration=8 ms", "run.output_interval=20 us"],
    );
    let found = number(&fallen_onto, "lower.time_to_first_axial_contact");
    let fall = (2.0 * 0.2e-3 / 9.81_f64).sqrt();
    assert!((found / fall - 1.0).abs() < 1e-3, "{found} {fall}");
    assert!(number(&fallen_onto, "lower.peak_axial_force") > 60.0 * 9.81);
    assert!(number(&fallen_onto, "energy_residual").abs() < 1e-5);
    // the shaft slips on the face, though it touches no bore
    assert_eq!(number(&fallen_onto, "lower.contact_count"), 0.0);
    assert_eq!(number(&fallen_onto, "lower.slips_at_end"), 1.0);
    // the upper row of a back to back pair takes thrust downwards
    let rows = fallen_onto
        .column("lower.bearing.ball_01.inner_angle")
        .unwrap();
    let upper = (1..=99)
        .rev()
        .find_map(|ball| fallen_onto.column(&format!("lower.bearing.ball_{ball:02}.inner_angle")));
    assert!(rows.values[0] > 0.1 && upper.unwrap().values[0] < -0.1);
}

#[test]
fn a_set_of_three_rows_is_at_rest_under_its_preload() {
    let of = |sets: &[&str]| {
        let all = [sets, &["run.duration=8 ms", "run.output_interval=0.1 ms"]].concat();
        ran(FLYWHEEL, &all)
    };
    let set = of(&["auxiliary_bearing.lower.bearing.arrangement=TBT"]);
    let turned_round = of(&[
        "auxiliary_bearing.lower.bearing.arrangement=TBT",
        "auxiliary_bearing.lower.bearing.thrust_side=start",
    ]);
    for (run, signs) in [(&set, [1.0, 1.0, -1.0]), (&turned_round, [1.0, -1.0, -1.0])] {
        let balls = (1..=99).map(|ball| format!("lower.bearing.ball_{ball:02}.inner_angle"));
        let balls: Vec<_> = balls.map_while(|name| run.column(&name)).collect();
        for (row, sign) in signs.into_iter().enumerate() {
            let angle = balls[row * balls.len() / 3].values[0];
            assert!(angle * sign > 0.1, "row {row}: {angle}");
        }
        // its weight presses the ring down by 20 nm until the shaft lands; rows that were closed alike would move it by a micrometre
        let ring = &run.column("lower.bearing.inner_race.z").unwrap().values;
        let moved = ring[..50]
            .iter()
            .fold(0.0, |most: f64, z| most.max(z.abs()));
        assert!(moved < 5e-8, "{moved}");
        assert!(number(run, "lower.peak_axial_force") > 60.0 * 9.81);
        assert!(number(run, "energy_residual").abs() < 1e-5);
    }
}

#[test]
fn a_weight_that_is_given_in_part_is_warned_of() {
    let warned = |axial: &str| {
        let scenario = parsed(FLYWHEEL, &[&format!("gravity.axial={axial}")]).unwrap();
        let notes = scenario.notes.iter();
        notes.filter(|own| own.code == "AB1095").count()
    };
    assert_eq!(warned("-9.81 m/s^2"), 0);
    assert_eq!(warned("-1 m/s^2"), 1);
}

#[test]
fn an_axial_magnet_holds_until_all_power_is_lost() {
    let fallen_onto = ran(
        AGAIN,
        &[
            "bearing.fidelity=spatial",
            "bearing.operating_diametral_clearance=5 um",
            "contact.gap_to_end=0.5 mm",
            "gravity.axial=2 m/s^2",
            "levitation.axial_stiffness=1 MN/m",
            "levitation.axial_damping=1000 N s/m",
            // before friction in the bore brakes it along the axis too
            "run.duration=26 ms",
            "run.output_interval=1 ms",
        ],
    );
    let place = fallen_onto.column("rotor.z").unwrap();
    let time = fallen_onto.column("time").unwrap();
    for (time, place) in time.values.iter().zip(&place.values) {
        // power is lost at 20 ms
        let fallen = (time - 0.02).max(0.0).powi(2);
        assert!(
            (place - fallen).abs() < 1e-6 * fallen + 1e-12,
            "{time} {place} {fallen}"
        );
    }
}

#[test]
fn an_axial_magnet_may_be_lost_alone() {
    let event = "[[event]]\nname = \"thrust\"\ndo = \"axial magnet lost\"\nat = \"5 ms\"\n";
    let scenario = format!("{AGAIN}\n{event}");
    let sets = [
        "bearing.fidelity=spatial",
        "bearing.operating_diametral_clearance=5 um",
        "contact.gap_to_end=0.5 mm",
        "gravity.axial=2 m/s^2",
        "levitation.axial_stiffness=1 MN/m",
        "run.duration=15 ms",
        "run.output_interval=1 ms",
    ];
    let fallen = ran(&scenario, &sets);
    let place = fallen.column("rotor.z").unwrap().values.last().unwrap();
    assert!((place / 1e-4 - 1.0).abs() < 1e-6, "{place}");
    let without: Vec<&str> = (sets.iter().copied())
        .filter(|set| !set.starts_with("levitation"))
        .collect();
    let found = parsed(&scenario, &without).unwrap_err();
    assert!(found.contains("without it"), "{found}");
}

#[test]
fn an_axial_magnet_that_is_never_lost_is_warned_of() {
    let pairs = include_str!("../../../scenarios/machine_expander_pairs.toml");
    let warned = |scenario: &str| {
        let run = ran(scenario, &["run.duration=1 ms"]);
        run.warnings.iter().any(|own| own.code == "AB2417")
    };
    let radial = "\"magnet lost\"\nmagnet = \"expander_end\"";
    assert!(!warned(pairs) && warned(&pairs.replace("\"power lost\"", radial)));
    assert!(!warned(
        &pairs.replace("\"power lost\"", "\"axial magnet lost\"")
    ));
}

/// The rotor that rolls on a preloaded pair feels all its balls: the stiffness is that of `auxbear bearings stiffness`, not of a loose row.
#[test]
fn a_preloaded_pair_is_as_stiff_to_the_rotor_as_alone() {
    let pairs = include_str!("../../../scenarios/machine_expander_pairs.toml");
    let scenario = parsed(pairs, &["analysis.speed_count=11"]).unwrap();
    let rotor = scenario.rotor_alone().unwrap().unwrap();
    let never = AtomicBool::new(false);
    let found = run(&rotor, &Options::unwatched(&never)).unwrap();
    let of = |name: &str| {
        number(
            &found,
            &format!("on_auxiliary_bearings.expander_end.{name}"),
        )
    };
    let load = format!("{} N", of("static_load"));
    let catalogue = auxbear::Catalogue::built_in();
    let meant = catalogue.meant("7010 C hybrid DB", "test").unwrap();
    let typed = stiffness::Typed {
        texts: &[
            ("--radial", Some(load.as_str())),
            ("--preload", Some("240 N")),
        ],
        place: "test",
    };
    let asked = stiffness::Request::read(&meant, &typed).unwrap();
    let alone = stiffness::run(&asked, "test").unwrap();
    let alone = alone.stiffness[0][0];
    assert!((of("ball_stiffness") / alone - 1.0).abs() < 1e-3, "{alone}");
    // at the rated speed against tilt: in series with the contact at both edges, 32 mm apart
    let fast = stiffness::Typed {
        texts: &[
            ("--radial", Some(load.as_str())),
            ("--preload", Some("240 N")),
            ("--speed", Some("25000 rpm")),
            ("--race-control", Some("half")),
        ],
        place: "test",
    };
    let asked = stiffness::Request::read(&meant, &fast).unwrap();
    let fast = stiffness::run(&asked, "test").unwrap().stiffness;
    let contact = of("contact_stiffness") * (0.5 * 32e-3_f64).powi(2);
    let expected = 1.0 / (1.0 / fast[4][4] + 1.0 / contact);
    let found = of("tilt_stiffness");
    assert!((found / expected - 1.0).abs() < 0.03, "{found} {expected}");
}

#[test]
fn a_shock_closes_the_ledger_of_bearings_in_space() {
    let shaken = ran(
        FLYWHEEL,
        &[
            "base.shock_x=50 m/s^2",
            "base.shock_start=5 ms",
            "base.shock_duration=11 ms",
            "run.duration=25 ms",
        ],
    );
    assert!(number(&shaken, "energy_residual").abs() < 1e-5);
    // five g for 11 ms bring the rotor to the bore, which it would meet after 0.1 s by itself
    let bore = number(&shaken, "lower.time_to_first_contact");
    assert!(bore < 25e-3, "{bore}");
}

#[test]
fn a_thrust_moves_the_rotor_along_its_axis() {
    let force = "[[rotor.force]]\nname = \"gas\"\nat = \"0.2 m\"\ntimes = [\"5 ms\", \"10 ms\"]\nz = [\"0 N\", \"40 N\"]\n";
    let scenario = format!("{AGAIN}\n{force}");
    let moved = ran(
        &scenario,
        &[
            "bearing.fidelity=spatial",
            "bearing.operating_diametral_clearance=5 um",
            "contact.gap_to_end=0.5 mm",
            "run.duration=15 ms",
            "run.output_interval=1 ms",
        ],
    );
    let mass = number(&moved, "rotor_mass");
    let place = moved.column("rotor.z").unwrap();
    let time = moved.column("time").unwrap();
    for (time, place) in time.values.iter().zip(&place.values) {
        // m z'' = F(t): a ramp of 5 ms, constant from there on
        let (ramp, on) = ((time - 5e-3).clamp(0.0, 5e-3), (time - 10e-3).max(0.0));
        let expected = 40.0 / mass * (ramp.powi(3) / 30e-3 + 2.5e-3 * on + 0.5 * on * on);
        assert!(
            (place - expected).abs() < 1e-6 * expected + 1e-13,
            "{time} {place} {expected}"
        );
    }
    assert!(number(&moved, "energy_residual").abs() < 1e-6);
    let found = parsed(&scenario, &[]).unwrap_err();
    assert!(
        found.contains("rotor.force.gas.z") && found.contains("\"spatial\" is needed"),
        "{found}"
    );
}

#[test]
fn the_preload_of_a_pair_follows_heat_and_speed() {
    let run = |sets: &[&str]| {
        let sets: Vec<String> = (sets.iter())
            .map(|set| format!("auxiliary_bearing.lower.{set}"))
            .collect();
        let all = ["run.duration=60 ms"].into_iter();
        let all: Vec<&str> = all.chain(sets.iter().map(String::as_str)).collect();
        ran(FLYWHEEL, &all)
    };
    let last =
        |run: &auxbear::Outcome, name: &str| *run.column(name).unwrap().values.last().unwrap();
    let plain = run(&[]);
    let heats = ["heat.network=on", "bearing.inner_race_mass=0.05 kg"];
    let hot = run(&heats);
    assert!(number(&hot, "lower.relative_heat_residual") < 1e-9);
    assert!(number(&hot, "energy_residual").abs() < 1e-6);
    let [least, most] =
        ["smallest", "largest"].map(|which| number(&hot, &format!("lower.{which}_preload")));
    assert!(least == 90.0 && most > 91.0, "{least} {most}");
    let preload = last(&hot, "lower.bearing.preload");
    assert!(preload > 91.0 && preload <= most, "{preload} {most}");
    // a spring lets the rings grow
    let springs = [
        "bearing.preload_spring_stiffness=1e5 N/m",
        "bearing.preload_spring_side=end",
    ];
    let sprung = run(&[&heats[..], &springs[..]].concat());
    assert!(number(&sprung, "energy_residual").abs() < 1e-6);
    let grown = number(&sprung, "lower.largest_preload") - 90.0;
    assert!(
        grown > 0.0 && grown < 0.05 * (most - 90.0),
        "{grown} {most}"
    );
    // the masses given are those of one row: steel of both rings keeps the heat
    let rise = number(&hot, "lower.peak_inner_race_temperature") - 298.15;
    let kept = number(&hot, "lower.stored_heat_in_inner_race");
    assert!(
        (kept / rise / (0.1 * 465.0) - 1.0).abs() < 0.05,
        "{kept} {rise}"
    );
    // a ring that grows with its speed presses all balls
    let grown = run(&["bearing.inner_race_growth=free ring"]);
    assert!(number(&grown, "energy_residual").abs() < 1e-6);
    let pressed = |run: &auxbear::Outcome| {
        let load = |ball: usize| last(run, &format!("lower.bearing.ball_{ball:02}.inner_load"));
        (1..=9).map(load).sum::<f64>()
    };
    let [grown, plain] = [&grown, &plain].map(pressed);
    assert!(grown > 1.02 * plain, "{grown} {plain}");
}

#[test]
fn the_clearance_of_a_deep_groove_bearing_follows_its_heat() {
    let sets = [
        "bearing.fidelity=spatial",
        "bearing.operating_diametral_clearance=5 um",
        "run.duration=60 ms",
        "heat.network=on",
    ];
    let hot = ran(AGAIN, &sets);
    let least = number(&hot, "drive_end.smallest_clearance");
    let rise = number(&hot, "drive_end.peak_inner_race_temperature") - 298.15;
    // the inner ring closes by α d ΔT at most, the balls and the outer ring are cooler
    let closed = 5e-6 - least;
    let most = 11.5e-6 * 40e-3 * rise;
    assert!(
        closed > 0.2 * most && closed < 1.5 * most,
        "{closed} {most}"
    );
    assert!(number(&hot, "energy_residual").abs() < 1e-5);
}

#[test]
fn life_of_a_pair_is_that_of_both_its_rows() {
    const LOWER: &str = "auxiliary_bearing.lower.bearing.";
    let rating = format!("{LOWER}dynamic_load_rating=14 kN");
    let fallen = ran(FLYWHEEL, &["run.duration=60 ms", &rating]);
    let share = number(&fallen, "lower.life_share");
    // the row below carries the thrust: nearly all of the life that is used is its own, and it turns as often as the ring
    let turns = number(&fallen, "lower.inner_race_turns");
    let load = 14e3 * (1e6 * share / turns).cbrt();
    let peak = number(&fallen, "lower.peak_axial_force");
    assert!(load > 0.3 * peak && load < peak, "{load} N of {peak} N");
    // and the same bearing of twice the rating uses an eighth
    let stronger = ran(
        FLYWHEEL,
        &["run.duration=60 ms", &rating.replace("14", "28")],
    );
    let ratio = share / number(&stronger, "lower.life_share");
    assert!((ratio - 8.0).abs() < 1e-6, "{ratio}");
}

#[test]
fn outer_rings_tilt_in_their_mount() {
    let tilting = |stiffness: &str| {
        let sets = [
            "run.duration=12 ms".to_string(),
            "auxiliary_bearing.lower.bearing.cage.guidance=balls".to_string(),
            "rotor.start_speed_x=20 mm/s".to_string(),
            format!("auxiliary_bearing.lower.mount.tilt_stiffness={stiffness}"),
            "auxiliary_bearing.lower.mount.tilt_damping=0.5 N m s/rad".to_string(),
        ];
        let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
        ran(FLYWHEEL, &sets)
    };
    let largest = |run: &auxbear::Outcome| {
        let tilt = run.column("lower.bearing.outer_race.tilt_y").unwrap();
        tilt.values.iter().fold(0.0, |m: f64, own| m.max(own.abs()))
    };
    let [soft, stiff] = ["2e3 N m/rad", "2e5 N m/rad"].map(tilting);
    for run in [&soft, &stiff] {
        assert!(number(run, "energy_residual").abs() < 1e-5);
    }
    let [soft, stiff] = [largest(&soft), largest(&stiff)];
    assert!(soft > 1e-7 && stiff < 0.2 * soft, "{soft} {stiff}");
    refused(
        &["auxiliary_bearing.lower.mount.tilt_stiffness=2e3 N m/rad"],
        "centred on the outer ring",
    );
}

#[test]
fn a_spring_keeps_a_row_pressed_that_a_distance_would_free() {
    let run = |sets: &[&str]| {
        let sets: Vec<String> = (sets.iter())
            .map(|set| format!("auxiliary_bearing.lower.{set}"))
            .collect();
        let all = ["run.duration=10 ms"].into_iter();
        let all: Vec<&str> = all.chain(sets.iter().map(String::as_str)).collect();
        ran(FLYWHEEL, &all)
    };
    let unloaded =
        |run: &auxbear::Outcome| match &run.quantity("lower.row_unloaded_times").unwrap().value {
            Value::List(times) => times.iter().filter(|time| time.is_finite()).count(),
            _ => panic!("no list"),
        };
    let forces = |run: &auxbear::Outcome| {
        ["smallest", "largest"]
            .map(|which| number(run, &format!("lower.{which}_preload_spring_force")))
    };
    // the shaft lands on the lower face: towards the start. Rows that stand take the thrust, the spring follows by some micrometres
    let soft = "bearing.preload_spring_stiffness=2e5 N/m";
    let kept = run(&[soft, "bearing.preload_spring_side=end"]);
    assert!(number(&kept, "energy_residual").abs() < 1e-5);
    assert_eq!([unloaded(&run(&[])), unloaded(&kept)], [1, 0]);
    let [least, most] = forces(&kept);
    assert!(
        least > 70.0 && least < 90.0 && most < 95.0,
        "{least} {most}"
    );
    let column = |name: &str| &kept.column(name).unwrap().values;
    let (slid, force) = (
        column("lower.bearing.sliding_outer_race.z"),
        column("lower.bearing.preload_spring.force"),
    );
    for (slid, force) in slid.iter().zip(force) {
        assert!((force - (90.0 + 2e5 * slid)).abs() < 1e-6, "{slid} {force}");
    }
    // the same thrust on the spring: it is compressed until it is solid, and the rotor sinks
    let sunk = run(&[soft, "bearing.preload_spring_travel=0.1 mm"]);
    assert!(number(&sunk, "energy_residual").abs() < 1e-5);
    assert!(sunk.warnings.iter().any(|own| own.code == "AB2419"));
    let [_, most] = forces(&sunk);
    assert!(most > 90.0 + 2e5 * 0.1e-3 + 200.0, "{most}");
    let place = |run: &auxbear::Outcome| *run.column("rotor.z").unwrap().values.last().unwrap();
    let deeper = place(&kept) - place(&sunk);
    assert!(deeper > 0.08e-3, "{deeper}");
    // stiff, it is free before the row is
    let freed = run(&[
        "bearing.preload_spring_stiffness=1e8 N/m",
        "bearing.preload_spring_side=end",
    ]);
    assert!(freed.warnings.iter().any(|own| own.code == "AB2418"));
    assert_eq!((unloaded(&freed), forces(&freed)[0]), (1, 0.0));
    // what is not computed
    for (set, needed) in [
        (
            "bearing.preload_spring_mass=9 kg",
            "less than mount.moving_mass",
        ),
        ("bearing.arrangement=DT", "stand against each other"),
        ("mount.tilt_stiffness=1e4 N m/rad", "keep their orientation"),
    ] {
        let sets = [soft, "bearing.cage.guidance=balls", set]
            .map(|set| format!("auxiliary_bearing.lower.{set}"));
        refused(&sets.each_ref().map(String::as_str), needed);
    }
    let idle = "auxiliary_bearing.lower.bearing.preload_spring_travel=0.1 mm";
    refused(&[idle], "preload_spring_stiffness is needed beside it");
}

#[test]
fn what_is_not_computed_of_a_bearing_in_space_is_refused() {
    const LOWER: &str = "auxiliary_bearing.lower.";
    for (sets, needed) in [
        (
            &["bearing.arrangement=single"][..],
            "nothing presses a single row",
        ),
        (&["bearing.arrangement=DT"], "tandem"),
        (
            &[
                "bearing.moment.law=palmgren printed",
                "bearing.static_load_rating=5 kN",
                "bearing.moment.f0=2",
                "bearing.moment.f1_factor=0.001",
                "bearing.moment.f1_exponent=0.33",
                "bearing.moment.viscosity=20 mm^2/s",
            ],
            "knows no axial load",
        ),
        (
            &[
                "bearing.moment.law=palmgren",
                "bearing.moment.axial_load=20 N",
            ],
            "the loads of each row along the axis are computed",
        ),
        (&["contact.face_radius=14.9 mm"], "15.00 to "),
        (&["contact.face_radius=24 mm"], "no shoulder meets a face"),
        (&["bearing.shoulder_height=0.01 mm"], "groove ends"),
        (
            &["bearing.operating_diametral_clearance=5 um"],
            "how its grooves stand",
        ),
        (
            &[
                "bearing.cage.guidance=balls",
                "bearing.separation=full complement",
            ],
            "\"cage\"",
        ),
    ] {
        let sets: Vec<String> = sets.iter().map(|set| format!("{LOWER}{set}")).collect();
        let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
        refused(&sets, needed);
    }
}

#[test]
fn a_shoulder_says_where_the_grooves_end() {
    let key = "auxiliary_bearing.lower.bearing.shoulder_height=0.45 mm";
    let low = ran(FLYWHEEL, &["run.duration=7.2 ms", key]);
    let [ends, halves] = ["groove_end_angles", "contact_ellipse_half_angles"]
        .map(|name| list(&low, &format!("lower.{name}")));
    // acos(1 - h/r_g), r_g = 0.521 times 7.94 mm
    let end = (1.0 - 0.45 / (0.521 * 7.94_f64)).acos();
    assert!(ends.len() == 2 && ends.iter().all(|own| (own / end - 1.0).abs() < 1e-12));
    // the first ellipse that reaches over the shoulder ends there
    let over = low.warnings.iter().find(|own| own.code == "AB2412");
    let text = &over.unwrap().text;
    let after = |words: &str| -> f64 {
        let (_, rest) = text.split_once(words).unwrap();
        rest.split(' ').next().unwrap().parse().unwrap()
    };
    let reach = after("contact angle ").to_radians() + halves[0] * after("deg, ").cbrt();
    assert!((reach - end).abs() < 0.01, "{reach} {end}: {text}");
}

#[test]
fn the_arrangement_in_a_name_is_that_of_the_pair_and_no_other() {
    const KEY: &str = "bearing.arrangement";
    let lines = FLYWHEEL
        .lines()
        .filter(|line| !line.starts_with("arrangement = "));
    let open: String = lines.map(|line| format!("{line}\n")).collect();
    let named = |text: &str, name: &str| {
        parsed(text, &[&format!("bearing.name={name}")]).map(|own| own.resolved)
    };
    let resolved = named(&open, "7006 C DF").unwrap();
    let own = resolved.of_bearing("lower", KEY).unwrap();
    assert_eq!(own.text.as_deref(), Some("DF"));
    assert_eq!(own.provenance.note(), "the DF in bearing.name");
    // a resolved file says it as well, and is read again
    let again = parsed(&resolved.toml(), &[]).unwrap().resolved;
    assert_eq!(
        again.of_bearing("lower", KEY).unwrap().provenance,
        own.provenance
    );
    // a file that says the same, and one that says another
    assert!(named(FLYWHEEL, "7006 C DB").is_ok());
    for other in ["7006 C DF", "7006 C DT"] {
        let refused = named(FLYWHEEL, other).unwrap_err();
        assert!(
            refused.contains(KEY) && refused.contains(other),
            "{refused}"
        );
    }
    // without a suffix the pair needs its key: one row cannot be preloaded
    let single = named(&open, "7006 C").unwrap_err();
    assert!(single.contains("nothing presses a single row"), "{single}");
}

fn refused(sets: &[&str], needed: &str) {
    let found = match parsed(FLYWHEEL, sets) {
        Ok(scenario) => run(&scenario, &Options::unwatched(&AtomicBool::new(false)))
            .err()
            .map(|problem| problem.to_string()),
        Err(problem) => Some(problem),
    };
    let found = found.unwrap_or_else(|| panic!("{sets:?} is taken"));
    assert!(found.contains(needed), "{sets:?}: {found}");
}

#[test]
fn a_weight_that_nothing_stops_is_refused_with_the_word_spatial() {
    let lines = FLYWHEEL
        .lines()
        .filter(|line| !line.starts_with("gap_to_start"));
    let open: String = lines.map(|line| format!("{line}\n")).collect();
    assert!(
        parsed(&open, &[])
            .unwrap_err()
            .contains("fall through its bearings")
    );
    // the default of what acts across the shaft would make 1.41 g of it
    let whole = FLYWHEEL.replacen("acceleration = \"0 m/s^2\"\n", "", 1);
    let refused = parsed(&whole, &[]).unwrap_err();
    assert!(
        refused.contains("gravity.acceleration") && refused.contains("13.9"),
        "{refused}"
    );
    let found = parsed(AGAIN, &["gravity.axial=9.81 m/s^2"]).unwrap_err();
    assert!(
        found.contains("\"spatial\" is needed") && found.contains("carry no thrust"),
        "{found}"
    );
}
