//! Many drops of several kinds together.

use crate::place::Place;
use auxbear::report::service::{Occasion, service};

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
    near(fatigue[0], 3.0 * of("gentle") + 20.0 * of("rough"));
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
    assert!(
        told.out
            .contains("% of machines have lost a bearing by rolling fatigue")
    );
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
    for (what, name) in [
        ("rolling fatigue, of L10", "life_share_with_lubricant"),
        ("wear depth", "wear_depth"),
    ] {
        near(
            mode(what),
            40.0 * of("full", name) + 10.0 * of("half", name),
        );
    }
    let dents = ["full", "half"].map(|out| of(out, "indentation_index"));
    near(mode("dents by ball loads"), dents[0].max(dents[1]));
    // a share of a life so small that fatigue decides nothing
    assert!(found.survival.unwrap() > 0.999);
    assert!(told.out.contains("40 x full") && told.out.contains("10 x half"));
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
