//! The built-in catalogue: every number has a reason, the parts fit, and the ball sets agree with what makers print.

use auxbear::catalogue::{Bearing, Catalogue, Mark, Ring, bearings, find, names};
use physics::hertz::{BallRace, PointContact, Race};
use physics::kinematics::BallSet;
use physics::materials::{BEARING_STEEL, SILICON_NITRIDE, ball_mass, contact_modulus};
use std::f64::consts::PI;
use std::path::Path;

fn number(bearing: &Bearing, key: &str) -> f64 {
    bearing
        .number(key)
        .unwrap_or_else(|| panic!("{} has no {key}", bearing.name))
}

fn named(name: &str) -> &'static Bearing {
    find(name).unwrap_or_else(|| panic!("no {name}"))
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a / b - 1.0).abs() < tolerance
}

#[test]
fn every_bearing_has_what_a_drop_needs_and_a_reason_for_it() {
    const KEYS: [&str; 17] = [
        "ball_count",
        "ball_diameter",
        "ball_material",
        "bore_diameter",
        "cage_mass",
        "dynamic_load_rating",
        "inner_groove_curvature",
        "inner_race_inertia",
        "inner_race_mass",
        "limiting_speed",
        "mass",
        "outer_diameter",
        "outer_groove_curvature",
        "pitch_diameter",
        "static_load_rating",
        "type",
        "width",
    ];
    assert!(bearings().len() > 450);
    for bearing in bearings() {
        for key in KEYS {
            assert!(
                bearing.value(key).is_some(),
                "{} has no {key}",
                bearing.name
            );
        }
        for value in &bearing.values {
            assert!(
                !value.note.is_empty() && !value.note.contains('{'),
                "{value:?}"
            );
            assert_ne!(value.mark, Mark::Given, "{}", bearing.name);
        }
        assert!(bearing.values.is_sorted_by_key(|value| &value.key));
        assert!(!bearing.description.is_empty() && !bearing.description.contains('{'));
        let angular = bearing.word("type") == Some("angular contact");
        assert_eq!(bearing.number("contact_angle").is_some(), angular);
    }
}

#[test]
fn names_are_distinct_in_natural_order_and_found_whatever_their_case() {
    let names = names();
    let mut lower: Vec<String> = names.iter().map(|name| name.to_lowercase()).collect();
    lower.sort();
    lower.dedup();
    assert_eq!(lower.len(), names.len());
    let place = |name: &str| names.iter().position(|known| known == name).unwrap();
    let order = [
        "6000",
        "6005",
        "6005 hybrid",
        "6203",
        "61800",
        "SNFA EX 9",
        "SNFA EX 25",
    ];
    assert!(order.is_sorted_by_key(|name| place(name)));
    assert_eq!(find(" snfa ex 25 ").unwrap().name, "SNFA EX 25");
    assert!(find("6999").is_none());
}

#[test]
fn the_parts_fit_into_the_bearing() {
    for bearing in bearings() {
        let get = |key| number(bearing, key);
        let name = &bearing.name;
        let (bore, outside) = (get("bore_diameter"), get("outer_diameter"));
        let (ball, pitch) = (get("ball_diameter"), get("pitch_diameter"));
        let balls = get("ball_count");
        assert!(bore < pitch - ball && pitch + ball < outside, "{name}");
        // Chord between neighbouring centres; the least room for a cage is that of large spindle bearings, 0.12 balls, and
        // of bearings of 40 deg, whose cage stands beside the pitch circle, 0.08 balls.
        let room = match bearing.number("contact_angle") {
            Some(angle) if angle > 0.6 => 1.07,
            _ => 1.1,
        };
        assert!(pitch * (PI / balls).sin() > room * ball, "{name}");
        assert!(ball < get("width"), "{name}");
        for key in ["inner_groove_curvature", "outer_groove_curvature"] {
            assert!((0.51..0.55).contains(&get(key)), "{name}");
        }
        let density = match bearing.word("ball_material") {
            Some("silicon nitride") => SILICON_NITRIDE.density,
            _ => BEARING_STEEL.density,
        };
        // The outer ring is always the heavier one.
        let parts = get("inner_race_mass") + get("cage_mass") + balls * ball_mass(ball, density);
        assert!(parts < 0.75 * get("mass"), "{name}: {parts}");
        let gyration = (get("inner_race_inertia") / get("inner_race_mass")).sqrt();
        assert!(gyration > bore / 2.0 && gyration < pitch / 2.0, "{name}");
    }
}

#[test]
fn the_shipped_file_passes_the_checks_of_a_users_file() {
    let text = include_str!("../../catalogue/src/bearings.toml");
    let catalogue = Catalogue::with_text(text, "bearings.toml").unwrap();
    assert_eq!(catalogue.iter().count(), bearings().len());
    for bearing in bearings() {
        // found section by section, and read as a whole
        assert_eq!(find(&bearing.name), Some(bearing));
        assert_eq!(
            catalogue.find(&bearing.name).unwrap().values,
            bearing.values
        );
    }
}

/// The four bearings whose race masses are typed in: the same by the ring's closed form.
#[test]
fn ring_masses_are_those_of_the_derivation() {
    for name in ["6005", "6005 hybrid", "6007", "61807"] {
        let bearing = named(name);
        let get = |key| number(bearing, key);
        let (volume, moment) = inner_ring(bearing).volume_moments();
        // three printed digits
        assert!(near(
            get("inner_race_mass"),
            BEARING_STEEL.density * volume,
            2e-3
        ));
        assert!(near(
            get("inner_race_inertia"),
            BEARING_STEEL.density * moment,
            2e-3
        ));
    }
}

fn inner_ring(bearing: &Bearing) -> Ring {
    let get = |key| number(bearing, key);
    Ring {
        smooth_radius: get("bore_diameter") / 2.0,
        shoulder_radius: get("inner_shoulder_diameter") / 2.0,
        track_radius: (get("pitch_diameter") - get("ball_diameter")) / 2.0,
        groove_radius: get("inner_groove_curvature") * get("ball_diameter"),
        width: get("width"),
    }
}

/// Rings, balls and cage together weigh what the maker prints: a check of ball sets that ratings alone suggest.
#[test]
fn the_parts_of_deep_groove_bearings_weigh_what_the_maker_prints() {
    let mut count = 0;
    for bearing in bearings() {
        let steel = bearing.word("ball_material") == Some("steel");
        let shoulder = bearing.value("inner_shoulder_diameter");
        let Some(shoulder) = shoulder.filter(|value| steel && value.mark == Mark::Catalogue) else {
            continue;
        };
        let shoulder = number(bearing, &shoulder.key);
        let get = |key| number(bearing, key);
        let (ball, pitch) = (get("ball_diameter"), get("pitch_diameter"));
        let outer = Ring {
            smooth_radius: get("outer_diameter") / 2.0,
            shoulder_radius: pitch - shoulder / 2.0,
            track_radius: (pitch + ball) / 2.0,
            groove_radius: get("outer_groove_curvature") * ball,
            width: get("width"),
        };
        let outer_mass = BEARING_STEEL.density * outer.volume_moments().0;
        let balls = get("ball_count") * ball_mass(ball, BEARING_STEEL.density);
        let parts = get("inner_race_mass") + outer_mass + balls + get("cage_mass");
        // Masses are printed to two digits, the cage is a guess, chamfers are left out.
        assert!(near(parts, get("mass"), 0.1), "{}: {parts}", bearing.name);
        count += 1;
    }
    assert_eq!(count, 65);
}

/// Factors of ISO 76 (f0) and ISO 281 (fc, for one row of balls, without b_m) over D cos α/d_m, from memory: that they
/// give three printed numbers of each of 82 bearings is their check.
const F0: [(f64, f64); 17] = [
    (0.05, 15.7),
    (0.07, 16.1),
    (0.09, 16.5),
    (0.1, 16.4),
    (0.12, 15.9),
    (0.14, 15.4),
    (0.16, 14.9),
    (0.18, 14.4),
    (0.2, 14.0),
    (0.22, 13.5),
    (0.24, 13.0),
    (0.26, 12.5),
    (0.28, 12.1),
    (0.3, 11.6),
    (0.32, 11.2),
    (0.34, 10.7),
    (0.36, 10.3),
];
const FC: [(f64, f64); 17] = [
    (0.05, 46.7),
    (0.06, 49.1),
    (0.07, 51.1),
    (0.08, 52.8),
    (0.09, 54.3),
    (0.1, 55.5),
    (0.12, 57.5),
    (0.14, 58.8),
    (0.16, 59.6),
    (0.18, 59.9),
    (0.2, 59.9),
    (0.22, 59.6),
    (0.24, 59.0),
    (0.26, 58.2),
    (0.3, 56.0),
    (0.34, 53.2),
    (0.36, 51.7),
];
/// b_m of ISO 281 for deep groove bearings.
const MATERIAL: f64 = 1.3;

fn interpolate(table: &[(f64, f64)], x: f64) -> f64 {
    let after = table.iter().position(|row| row.0 >= x).unwrap();
    let ((x0, y0), (x1, y1)) = (table[after - 1], table[after]);
    y0 + (y1 - y0) * (x - x0) / (x1 - x0)
}

/// C and C0 in kN, and f0, of a set of balls in mm.
fn ratings(balls: f64, ball: f64, pitch: f64) -> [f64; 3] {
    let gamma = ball / pitch;
    let f0 = interpolate(&F0, gamma);
    let c = MATERIAL * interpolate(&FC, gamma) * balls.powf(2.0 / 3.0) * ball.powf(1.8);
    [c / 1e3, f0 * balls * ball * ball / 1e3, f0]
}

#[test]
fn the_ball_sets_give_the_ratings_that_their_notes_quote() {
    let mut count = 0;
    for bearing in bearings() {
        let note = &bearing.value("ball_count").unwrap().note;
        let deep_groove = bearing.word("type") == Some("deep groove");
        let Some((_, quoted)) = note.split_once("ISO 76 give C ").filter(|_| deep_groove) else {
            continue;
        };
        let quoted: Vec<f64> = quoted
            .split([' ', ',', ';'])
            .filter_map(|word| word.parse().ok())
            .collect();
        let get = |key| number(bearing, key);
        let [balls, ball, pitch] = [
            get("ball_count"),
            1e3 * get("ball_diameter"),
            1e3 * get("pitch_diameter"),
        ];
        let ours = ratings(balls, ball, pitch);
        // Makers round to 1 to 2 % and place the pitch circle within 1 % of the middle of the section, which moves f0
        // by as much.
        for (place, tolerance) in [0.026, 0.026, 0.017].into_iter().enumerate() {
            assert!(
                near(ours[place], quoted[place], tolerance),
                "{}: {ours:?}, quoted {quoted:?}",
                bearing.name
            );
        }
        // One ball more or less, or the next standard ball, does not.
        for [balls, ball] in [
            [balls - 1.0, ball],
            [balls + 1.0, ball],
            [balls, ball - 0.397],
            [balls, ball + 0.397],
        ] {
            let other = ratings(balls, ball, pitch);
            let worst = |numbers: [f64; 3]| {
                let errors = numbers
                    .iter()
                    .zip(&quoted)
                    .map(|(a, b)| (a / b - 1.0).abs());
                errors.fold(0.0, f64::max)
            };
            assert!(
                worst(other) > worst(ours),
                "{} with {balls} x {ball}",
                bearing.name
            );
        }
        count += 1;
    }
    assert_eq!(count, 82);
}

/// C0 = Z Q cos α/5 with the ball load Q at 4200 MPa on the inner race (ISO 76): the groove derived for each series
/// gives each of the 340 ratings that SNFA prints.
#[test]
fn the_grooves_of_spindle_bearings_give_their_static_ratings() {
    let modulus = contact_modulus(BEARING_STEEL, BEARING_STEEL);
    let mut count = 0;
    for bearing in bearings() {
        let spindle = bearing.number("contact_angle");
        let Some(contact_angle) = spindle.filter(|_| bearing.name.starts_with("SNFA")) else {
            continue;
        };
        let get = |key| number(bearing, key);
        let contact = BallRace {
            ball_diameter: get("ball_diameter"),
            pitch_diameter: get("pitch_diameter"),
            groove_curvature: get("inner_groove_curvature"),
            contact_angle,
            race: Race::Inner,
        };
        let load = PointContact::new(contact.curvature(), modulus)
            .unwrap()
            .load_at_pressure(4200e6);
        let rating = get("ball_count") * load * contact_angle.cos() / 5.0;
        // C0 is printed to two or three digits.
        assert!(
            near(rating, get("static_load_rating"), 0.03),
            "{}",
            bearing.name
        );
        count += 1;
    }
    assert_eq!(count, 340);
}

/// The public bearing data of Case Western Reserve University: orders of damage per turn.
#[test]
fn passing_orders_are_those_of_the_cwru_bearings() {
    // BPFO, BPFI, BSF, FTF, and tolerance. 6203 has the dimensions of the data set, whose γ = D/d_m is 0.2367 while its
    // orders are those of 0.2378; its 6205 has a pitch circle of 39.04 mm, 1.4 % outside the middle of the section,
    // which moves BSF by 1.5 %.
    for (name, orders, tolerance) in [
        ("6203", [3.0489, 4.9511, 1.9940, 0.3811], 2e-3),
        ("6205", [3.5848, 5.4152, 2.357, 0.3983], 1.6e-2),
    ] {
        let bearing = named(name);
        let set = BallSet {
            ball_count: number(bearing, "ball_count") as usize,
            ball_diameter: number(bearing, "ball_diameter"),
            pitch_diameter: number(bearing, "pitch_diameter"),
            contact_angle: 0.0,
        };
        let ours = set.passing_orders();
        let ours = [ours.outer_race, ours.inner_race, ours.ball_spin, ours.cage];
        for (ours, printed) in ours.into_iter().zip(orders) {
            assert!(near(ours, printed, tolerance), "{name}: {ours} {printed}");
        }
    }
}

#[test]
fn ball_sets_known_from_elsewhere_are_the_derived_ones() {
    // 6205, 6203: CWRU; 6206: worked example of eng-tools.dev; 6010: measured by the author of EXUDYN; mm.
    for (name, balls, ball) in [
        ("6205", 9.0, 0.3126 * 25.4),
        ("6203", 8.0, 0.2656 * 25.4),
        ("6206", 9.0, 9.525),
        ("6010", 14.0, 8.73),
    ] {
        let bearing = named(name);
        assert_eq!(bearing.number("ball_count"), Some(balls), "{name}");
        // a thousandth of an inch
        assert!(
            (1e3 * number(bearing, "ball_diameter") - ball).abs() < 0.025,
            "{name}"
        );
    }
}

#[test]
fn numbers_are_those_of_the_makers_tables() {
    let check = |name: &str, key: &str, text: &str, mark: Mark| {
        let value = named(name).value(key).unwrap();
        assert_eq!((value.text(), value.mark), (text, mark), "{name} {key}");
    };
    use Mark::{Assumed, Catalogue, Derived};
    check("6005", "bore_diameter", "25 mm", Catalogue);
    check("6005", "static_load_rating", "6.55 kN", Catalogue);
    check("6005", "ball_count", "10", Derived);
    check("6005", "ball_diameter", "6.35 mm", Catalogue);
    check("6203", "dynamic_load_rating", "9.95 kN", Catalogue);
    check("6203", "static_load_rating", "4.75 kN", Catalogue);
    check("6203", "limiting_speed", "24000 rpm", Catalogue);
    check("6012", "outer_diameter", "95 mm", Catalogue);
    check("61906", "inner_shoulder_diameter", "35.2 mm", Catalogue);
    check("61800", "static_load_rating", "0.84 kN", Catalogue);
    check("61808", "ball_count", "21", Assumed);
    check("6202", "ball_diameter", "5.953 mm", Assumed);
    check("6204 hybrid", "limiting_speed", "30000 rpm", Catalogue);
    check("6204 hybrid", "ball_material", "silicon nitride", Catalogue);
    check("SNFA EX 25", "ball_count", "13", Catalogue);
    check("SNFA EX 25", "static_load_rating", "8.9 kN", Catalogue);
    check("SNFA EX 25", "limiting_speed", "50000 rpm", Catalogue);
    check(
        "SNFA EX 25 25deg",
        "static_load_rating",
        "8.5 kN",
        Catalogue,
    );
    check("SNFA EX 25 25deg", "limiting_speed", "45000 rpm", Derived);
    check("SNFA VEX 25", "ball_count", "14", Catalogue);
    check("SNFA EX 25", "pitch_diameter", "36 mm", Derived);
    check("SNFA EX 25", "cage_mass", "2.92 g", Assumed);
    assert_eq!(named("6005").number("bore_diameter"), Some(0.025));
    assert_eq!(named("6005").number("static_load_rating"), Some(6550.0));
}

#[test]
fn a_hybrid_has_the_dimensions_of_its_steel_bearing() {
    let mut count = 0;
    for bearing in bearings() {
        let Some(steel) = bearing.name.strip_suffix(" hybrid") else {
            continue;
        };
        let steel = named(steel);
        for key in [
            "ball_count",
            "ball_diameter",
            "bore_diameter",
            "outer_diameter",
            "width",
            "static_load_rating",
        ] {
            assert_eq!(
                bearing.number(key),
                steel.number(key),
                "{} {key}",
                bearing.name
            );
        }
        count += 1;
    }
    // deep groove; four series with C and AC, one with B, of 24 bores
    assert_eq!(count, 30 + 9 * 24);
}

/// The published reference file with 109 spindle bearings.
#[test]
fn spindle_bearings_are_those_of_the_reference_file() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../validation/cases/published/snfa_pair_axial_rigidity.toml");
    let text = std::fs::read_to_string(file).unwrap();
    let table: toml::Table = text.parse().unwrap();
    let list = table["bearings"].as_array().unwrap();
    assert_eq!(list.len(), 109);
    for row in list {
        let name = row["name"].as_str().unwrap();
        let printed = |key: &str| row[key].as_float().unwrap() * 1e-3;
        let ours = |key| number(named(name), key);
        for (key, printed) in [
            ("bore_diameter", printed("bore_mm")),
            ("outer_diameter", printed("outer_diameter_mm")),
            ("width", printed("width_mm")),
            ("ball_diameter", printed("ball_diameter_mm")),
            (
                "ball_count",
                row["number_of_balls"].as_integer().unwrap() as f64,
            ),
        ] {
            assert!(near(ours(key), printed, 1e-12), "{name} {key}");
        }
    }
}
