//! Values that are right in form and doubtful for the machine: each is told, and nothing else is.

use super::files::owned;
use auxbear::catalogue;
use auxbear::run;
use auxbear::scenario::{BuiltIn, Provenance, Scenario, template};

fn start(kind: &str) -> String {
    template(kind).expect("it has a starting file")
}

fn scenario(text: &str, sets: &[&str]) -> Result<Scenario, String> {
    Scenario::parse(text, "a.toml", &owned(sets), &BuiltIn).map_err(|problem| problem.to_string())
}

/// The texts of the warnings of a code before a run of a starting file with these values.
fn told(kind: &str, code: &str, sets: &[&str]) -> Vec<String> {
    let scenario = scenario(&start(kind), sets).unwrap_or_else(|problem| panic!("{problem}"));
    let machine = run::build(&scenario).unwrap();
    let of_code = machine
        .warnings()
        .into_iter()
        .filter(|warning| warning.code == code);
    of_code.map(|warning| warning.to_string()).collect()
}

fn refused(kind: &str, sets: &[&str]) -> String {
    scenario(&start(kind), sets).expect_err("it is refused")
}

#[test]
fn another_name_in_a_starting_file_is_that_bearing_and_no_other() {
    let bearing = catalogue::find("6205").unwrap();
    for kind in ["drop", "spin_up", "rig", "torque", "identify"] {
        let text = start(kind);
        let named = text.replacen("\nname = \"6005\"", "\nname = \"6205\"", 1);
        assert_ne!(named, text, "{kind}");
        let scenario = scenario(&named, &[]).unwrap();
        let mut compared = 0;
        for value in &bearing.values {
            let path = format!("bearing.{}", value.key);
            let Some(resolved) = scenario.resolved.get(&path) else {
                continue;
            };
            assert_eq!(
                resolved.value_si,
                bearing.number(&value.key),
                "{path} of {kind}"
            );
            assert!(
                matches!(&resolved.provenance, Provenance::Catalogue { bearing, .. } if bearing == "6205"),
                "{path} of {kind}"
            );
            compared += 1;
        }
        assert!(compared >= 5, "{kind}: {compared}");
        let series = scenario.resolved.get("bearing.moment.series");
        assert!(
            series.is_none_or(|series| series.text.as_deref() != Some("60")),
            "{kind}"
        );
    }
    assert!(told("drop", "AB1092", &["bearing.name=6205"]).is_empty());
}

#[test]
fn given_values_that_are_not_those_of_the_name_are_told_and_count() {
    let trap = [
        "bearing.name=6205",
        "bearing.ball_count=10",
        "bearing.ball_diameter=6.35 mm",
        "bearing.pitch_diameter=36 mm",
        "bearing.inner_race_mass=20.4 g",
    ];
    let [told_once] = told("drop", "AB1092", &trap).try_into().unwrap();
    for part in [
        "differ from those of the 6205, and count",
        "bearing.ball_count 10 (9)",
        "bearing.ball_diameter 6.35 mm (7.938 mm)",
        "bearing.pitch_diameter 36 mm (38.5 mm)",
        "bearing.inner_race_mass 20.4 g",
    ] {
        assert!(told_once.contains(part), "{part}: {told_once}");
    }
    let counts = scenario(&start("drop"), &trap).unwrap();
    assert_eq!(
        counts.resolved.get("bearing.ball_count").unwrap().value_si,
        Some(10.0)
    );
    // a resolved file says what is the catalogue's, and rounding and sleeves are no difference
    let again = scenario(&counts.resolved.toml(), &[]).unwrap();
    assert_eq!(
        run::build(&again).unwrap().warnings(),
        run::build(&counts).unwrap().warnings()
    );
    let same = [
        "bearing.name=6205",
        "bearing.ball_diameter=7.94 mm",
        "bearing.inner_race_mass=90 g",
        "contact.bore_diameter=20 mm",
    ];
    assert!(told("drop", "AB1092", &same).is_empty());
    let hybrid = ["bearing.name=6205", "bearing.ball_material=silicon nitride"];
    assert!(told("drop", "AB1092", &hybrid)[0].contains("silicon nitride (steel)"));
}

#[test]
fn designations_as_people_type_them() {
    let [sealed] = told("drop", "AB1091", &["bearing.name=6205-2RS1/C3"])
        .try_into()
        .unwrap();
    assert!(
        sealed.starts_with("6205-2RS1/C3 is computed as the 6205") && sealed.contains("clearance"),
        "{sealed}"
    );
    assert!(told("drop", "AB1091", &["bearing.name=6205"]).is_empty());
    let thin = [
        "bearing.name=6907",
        "bearing.moment.law=palmgren",
        "bearing.moment.lubrication=grease",
    ];
    let thin = [&thin[..], &["bearing.moment.viscosity=100 mm^2/s"]].concat();
    assert_eq!(
        scenario(&start("drop"), &thin)
            .unwrap()
            .resolved
            .get("bearing.moment.series")
            .unwrap()
            .text
            .as_deref(),
        Some("619")
    );
    let [pair] = told("drop", "AB1091", &["bearing.name=7005 C DB"])
        .try_into()
        .unwrap();
    assert!(
        pair.contains("the 7005 C of the catalogue, without DB, the other rows (bearing.fidelity"),
        "{pair}"
    );
    for (name, parts) in [
        ("7010", ["AB0201", "\"SNFA EX 50\"", "\"SNFA EX 50 25deg\""]),
        ("71910", ["AB0201", "\"SNFA SEB 50\"", "angular contact"]),
        (
            "6303 hybrid",
            ["AB0201", "\"6303\"", "bearing.ball_material"],
        ),
    ] {
        let told = refused("drop", &[&format!("bearing.name={name}")]);
        assert!(parts.iter().all(|part| told.contains(part)), "{told}");
    }
}

#[test]
fn palmgrens_factors_take_one_round() {
    let law = "bearing.moment.law=palmgren";
    let all = refused("drop", &[law]);
    assert!(
        all.contains("bearing.moment.viscosity: found no value")
            && all.contains("Missing as well: bearing.moment.lubrication"),
        "{all}"
    );
    let spindle = refused("torque", &["bearing.name=SNFA EX 50", law]);
    assert!(
        spindle.contains("No table has factors")
            && spindle.contains("f0, f1_factor and f1_exponent are needed, all three"),
        "{spindle}"
    );
    let by_hand = [
        "bearing.moment.f0=2",
        "bearing.moment.f1_factor=1e-3",
        "bearing.moment.f1_exponent=0.33",
        "bearing.moment.lubrication=grease",
    ];
    let sets = [&["bearing.name=SNFA EX 50", law][..], &by_hand].concat();
    assert_eq!(told("torque", "AB1093", &sets).len(), 1);
    let none = [
        "bearing.moment.law=none",
        "bearing.moment.lubrication=grease",
    ];
    assert_eq!(
        told("drop", "AB1093", &none),
        [
            "bearing.moment.lubrication = grease is kept as information: nothing here is computed from it."
        ]
    );
    // the one dimension series of spindle bearings that a table has
    let read = scenario(&start("torque"), &["bearing.name=SNFA E 225 25deg", law]).unwrap();
    assert_eq!(
        read.resolved.get("bearing.moment.f0").unwrap().value_si,
        Some(2.0)
    );
}

#[test]
fn what_the_model_would_compute_as_something_else_is_refused_or_told() {
    let double = [
        "bearing.type=angular contact double row",
        "bearing.contact_angle=30 deg",
    ];
    let told_double = refused("drop", &double);
    assert!(
        told_double.contains("AB0212") && told_double.contains("rotor.planes = 4"),
        "{told_double}"
    );
    assert_eq!(
        told("drop", "AB1095", &["gravity.acceleration=0 m/s^2"]).len(),
        1
    );
    assert!(told("drop", "AB1095", &[]).is_empty());
    for (set, parts) in [
        ("rotor.axial_gap=1 mm", ["AB0212", "point 10"]),
        (
            "thermal.enabled=true",
            ["AB0212", "bearing.lubricant_state"],
        ),
        ("bearing.paired=true", ["AB0212", "rotor.planes = 4"]),
        ("levitation.controller=pid", ["AB0212", "until time 0"]),
        ("bearing_2.name=6005", ["AB0101", "[[auxiliary_bearing]]"]),
    ] {
        let told = refused("drop", &[set]);
        assert!(parts.iter().all(|part| told.contains(part)), "{told}");
    }
}

#[test]
fn a_preload_that_the_weight_exceeds_is_told() {
    // 78.48 N a plane; 15 deg: 0.7203/tan 15 deg = 2.688 N held for each newton of preload
    let of = |preload: &str| {
        let preload = format!("bearing.axial_preload={preload}");
        told("drop", "AB1096", &["bearing.name=SNFA EX 25", &preload])
    };
    assert!(of("30 N").is_empty());
    let [exceeded] = of("20 N").try_into().unwrap();
    assert!(
        exceeded.contains("a radial load of 54 N: exceeded by the weight of 78 N alone"),
        "{exceeded}"
    );
}

#[test]
fn implausible_values_are_told_and_impossible_ones_refused() {
    for (set, path) in [
        (
            "contact.friction_coefficient=1.5",
            "contact.friction_coefficient = 1.5",
        ),
        (
            "rotor.polar_inertia=9 kg m^2",
            "rotor.polar_inertia = 9 kg m^2",
        ),
        ("rotor.polar_inertia=9e-5 kg m^2", "rotor.polar_inertia"),
        (
            "bearing.static_load_rating=18 kN",
            "bearing.static_load_rating",
        ),
        ("mount.stiffness=1e10 N/m", "mount.stiffness"),
        ("mount.stiffness=1e4 N/m", "mount.stiffness"),
    ] {
        let [told] = told("drop", "AB1094", &[set]).try_into().expect(set);
        assert!(told.starts_with(path), "{told}");
    }
    let worn = [
        "contact.width=12 mm",
        "contact.surface.wear_coefficient=1 m^2/N",
    ];
    let [told_of_wear] = told("drop", "AB1094", &worn).try_into().expect("wear");
    assert!(told_of_wear.starts_with("contact.surface.wear_coefficient"));
    assert!(told("drop", "AB1094", &[]).is_empty());
    assert!(refused("drop", &["contact.friction_coefficient=15"]).contains("AB0106"));
    assert!(refused("drop", &["bearing.static_load_rating=60 kN"]).contains("AB0402"));
}

#[test]
fn small_slips_of_quantities_name_what_was_meant() {
    for (set, meant) in [
        ("mount.damping=5000 Ns/m", "Did you mean \"N s/m\"?"),
        ("rotor.polar_inertia=0.09 kgm2", "Did you mean \"kg m^2\"?"),
        ("rotor.speed=25 000 rpm", "Did you mean \"25000 rpm\"?"),
        ("rotor.speed=25'000 rpm", "Did you mean \"25000 rpm\"?"),
        ("rotor.mass=8 kgs", "Did you mean \"kg\"?"),
    ] {
        let told = refused("drop", &[set]);
        assert!(told.contains("AB0104") && told.ends_with(meant), "{told}");
    }
}
