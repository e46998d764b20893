//! Many drops of several kinds together.

use crate::place::Place;
use auxbear::report::service::{Occasion, service};
use std::fs;

/// A short drop with a dynamic load rating, which catalogues rarely tell.
fn drop(place: &Place, name: &str, more: &[&str]) {
    let mut all = vec![
        "--out",
        name,
        "--set",
        "bearing.dynamic_load_rating=11.9 kN",
    ];
    all.extend(more);
    place.short_run(&all).done();
}

#[test]
fn drops_add_up_and_the_worst_counts_where_they_do_not() {
    let place = Place::new();
    drop(&place, "gentle", &[]);
    let rough = ["--repeat", "4", "--set", "contact.friction_coefficient=0.3"];
    drop(&place, "rough", &rough);
    let told = place.call(&["service", "3:gentle", "20:rough"]).done();
    let row = |words: &str| -> Vec<f64> {
        let line = told.out.lines().find(|line| line.contains(words)).unwrap();
        let numbers = line.split("  ").map(str::trim);
        let leading = |text: &str| text.split(' ').next()?.parse().ok();
        numbers.filter_map(leading).collect()
    };
    let known = |run: &str, name: &str| place.summary(run)["quantities"][name].clone();
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
    let fatigue = row("rolling fatigue");
    let of = |run: &str| {
        let share = known(run, "life_share");
        share["spread"]["mean"]
            .as_f64()
            .or(share["value"].as_f64())
            .unwrap()
    };
    near(fatigue[1], 3.0 * of("gentle"));
    near(fatigue[2], 20.0 * of("rough"));
    // loads that stand at other places add up to less
    let sum = 3.0 * of("gentle") + 20.0 * of("rough");
    assert!(fatigue[0] < 1.001 * sum && fatigue[0] > 0.93 * sum);
    let dents = row("dents by ball loads");
    let worst = known("rough", "indentation_index")["spread"]["max"]
        .as_f64()
        .unwrap();
    near(
        dents[0],
        worst.max(
            known("gentle", "indentation_index")["value"]
                .as_f64()
                .unwrap(),
        ),
    );
    // what no run gives says so
    assert!(
        told.out
            .contains("contact.surface.wear_coefficient is not given")
    );
    assert!(told.out.contains("Rolling fatigue is not decisive"));
}

#[test]
fn fifty_drops_of_shipped_scenarios_are_a_service() {
    let place = Place::new();
    let skid = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenarios/drop_skid.toml");
    let kinds: [(&str, &[&str]); 2] =
        [("half", &[]), ("full", &["--set", "rotor.speed=15000 rpm"])];
    for (out, more) in kinds {
        let mut all = vec!["run", skid, "--out", out, "--set", "run.duration=20 ms"];
        all.extend(more);
        place.call(&all).done();
    }
    let told = place.call(&["service", "40:full", "10:half"]).done();
    let occasion = |count, out: &str| Occasion {
        count,
        directory: place.path(out),
    };
    let found = service(&[occasion(40, "full"), occasion(10, "half")]).unwrap();
    let of = |out: &str, name: &str| {
        let all = place.summary(out)["quantities"][name].clone();
        all["value"].as_f64().unwrap()
    };
    let mode = |what: &str| {
        let mode = found.modes.iter().find(|mode| mode.what == what).unwrap();
        *mode.value.as_ref().unwrap()
    };
    let near = |one: f64, other: f64| assert!((one / other - 1.0).abs() < 1e-12, "{one} {other}");
    near(
        mode("wear depth"),
        40.0 * of("full", "wear_depth") + 10.0 * of("half", "wear_depth"),
    );
    let dents = ["full", "half"].map(|out| of(out, "indentation_index"));
    near(mode("dents by ball loads"), dents[0].max(dents[1]));
    // a share of a life so small that fatigue decides nothing
    assert!(found.survival.unwrap() > 0.999);
    assert!(told.out.contains("40 x full") && told.out.contains("10 x half"));
    // drops of a bearing that does not hold together are no service
    let file = place.path("half").join("summary.json");
    let text = fs::read_to_string(&file).unwrap();
    let (start, rest) = text.split_once("\"code\": \"AB").unwrap();
    fs::write(&file, format!("{start}\"code\": \"AB2420{}", &rest[4..])).unwrap();
    let called = place.call(&["service", "40:full", "10:half"]);
    called.refused(&["half", "AB2420", "open side"]);
}

#[test]
fn loads_at_other_places_of_the_rings_use_less_life_than_the_sum() {
    let place = Place::new();
    let skid = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenarios/drop_skid.toml");
    for (out, gravity) in [
        ("down", "gravity.direction=-90 deg"),
        ("aside", "gravity.direction=0 deg"),
    ] {
        let all = ["run", skid, "--out", out, "--set", "run.duration=20 ms"];
        place.call(&[&all[..], &["--set", gravity]].concat()).done();
    }
    let fatigue = |kinds: &[(u64, &str)]| -> f64 {
        let occasion = |(count, out): &(u64, &str)| Occasion {
            count: *count,
            directory: place.path(out),
        };
        let occasions: Vec<Occasion> = kinds.iter().map(occasion).collect();
        let found = service(&occasions).unwrap();
        let mode = found
            .modes
            .iter()
            .find(|mode| mode.what.contains("fatigue"));
        *mode.unwrap().value.as_ref().unwrap()
    };
    let share = |out: &str| {
        let known = &place.summary(out)["quantities"]["life_share_with_lubricant"];
        known["value"].as_f64().unwrap()
    };
    // equal drops: n times one, also where they are told apart
    let down = share("down");
    for kinds in [&[(7, "down")][..], &[(3, "down"), (4, "down")]] {
        assert!((fatigue(kinds) / (7.0 * down) - 1.0).abs() < 1e-12);
    }
    // by hand from what passed the points: Σ first, then the power
    let points = |out: &str, side: &str| -> Vec<f64> {
        let name = format!("{side}_life_share_by_point");
        let list = place.summary(out)["quantities"][name]["value"].clone();
        let list = list.as_array().unwrap().clone();
        list.iter().map(|point| point.as_f64().unwrap()).collect()
    };
    let rings = ["inner", "outer"].map(|side| {
        let both = points("down", side).into_iter().zip(points("aside", side));
        let powers: Vec<f64> = both
            .map(|(down, aside)| (40.0 * down + 10.0 * aside).powf(10.0 / 9.0))
            .collect();
        powers.iter().sum::<f64>() / powers.len() as f64
    });
    let expected = (rings[0] + rings[1]).powf(0.9);
    let found = fatigue(&[(40, "down"), (10, "aside")]);
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    let sum = 40.0 * down + 10.0 * share("aside");
    assert!(found < 0.99 * sum && found > 40.0 * down, "{found} {sum}");
}

#[test]
fn a_sum_beyond_all_numbers_says_so() {
    let place = Place::new();
    drop(&place, "run", &[]);
    let mut summary = place.summary("run");
    summary["quantities"]["life_share"]["value"] = 1e308.into();
    std::fs::write(place.path("run/summary.json"), summary.to_string()).unwrap();
    let told = place.call(&["service", "40:run"]).done();
    assert!(told.out.contains("a sum that is not finite"), "{told:?}");
    assert!(!told.out.contains("inf"), "{told:?}");
}

#[test]
fn what_is_no_drop_of_this_machine_is_refused() {
    let place = Place::new();
    drop(&place, "run", &[]);
    place
        .call(&["service", "3:nowhere"])
        .refused(&["AB0001", "nowhere"]);
    for wrong in ["run", "x:run", "0:run", "-2:run", "3:"] {
        let called = place.call(&["service", "--", wrong]);
        called.refused(&["AB0102", "40:runs/full_speed"]);
    }
}
