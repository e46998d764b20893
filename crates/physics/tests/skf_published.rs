//! The SKF model against the worked example of its source, an independent script, and the printed tables.

use physics::skf::{SkfContacts, SkfIntermediates, SkfMoment};
use physics::skf_constants::{SkfBearing, SkfLubricant, SkfOil, SkfSupply, SkfType};
use std::f64::consts::PI;

const MM2_S: f64 = 1e-6;
const RPM: f64 = PI / 30.0;

fn near(what: &str, ours: f64, printed: f64, tolerance: f64) {
    assert!(
        (ours / printed - 1.0).abs() < tolerance,
        "{what}: ours {ours}, printed {printed}"
    );
}

fn spherical_22208() -> (SkfBearing<'static>, SkfLubricant) {
    (
        SkfBearing {
            kind: SkfType::SphericalRoller,
            series: "222 E",
            bore: 40e-3,
            outer_diameter: 80e-3,
            width: 23e-3,
            static_load_rating: None,
            ceramic_balls: false,
        },
        SkfLubricant {
            viscosity: 68.0 * MM2_S,
            supply: SkfSupply::LowOilBathOrJet,
            oil: SkfOil::Mineral,
            drag_variable: 0.3e-4,
            seal_moment: 0.0,
        },
    )
}

fn bearing_6005() -> (SkfBearing<'static>, SkfLubricant) {
    (
        SkfBearing {
            kind: SkfType::DeepGroove,
            series: "60",
            bore: 25e-3,
            outer_diameter: 47e-3,
            width: 12e-3,
            static_load_rating: Some(6550.0),
            ceramic_balls: false,
        },
        SkfLubricant {
            viscosity: 100.0 * MM2_S,
            supply: SkfSupply::GreaseOrOilAir,
            oil: SkfOil::Mineral,
            drag_variable: 0.0,
            seal_moment: 0.0,
        },
    )
}

fn spindle(kind: SkfType) -> (SkfBearing<'static>, SkfLubricant) {
    (
        SkfBearing {
            kind,
            series: "",
            bore: 30e-3,
            outer_diameter: 55e-3,
            width: 13e-3,
            static_load_rating: None,
            ceramic_balls: false,
        },
        SkfLubricant {
            viscosity: 20.0 * MM2_S,
            supply: SkfSupply::LowOilBathOrJet,
            oil: SkfOil::Synthetic,
            drag_variable: 1e-4,
            seal_moment: 0.0,
        },
    )
}

/// SKF General Catalogue (edition 6000), pp. 104-105: 22208 E, 3500 rpm, 2990 N radial, 100 N axial.
#[test]
fn worked_example_22208_e() {
    let (bearing, lubricant) = spherical_22208();
    let law = bearing.moment(&lubricant).unwrap();
    let model = law.intermediates(3500.0 * RPM, 2990.0, 100.0);
    // intermediates are printed with two or three digits, the first one rounds 0.2585 to 0.26
    for (what, ours, printed) in [
        ("G_rr", model.rolling_variable, 0.26),
        ("M_rr", model.rolling_moment, 437.0),
        ("phi_ish", model.inlet_shear_factor, 0.85),
        ("phi_rs", model.starvation_factor, 0.8),
        ("G_sl", model.sliding_variable, 434.0),
        ("mu_sl", model.sliding_friction, 0.05),
        ("M_sl", model.sliding_moment, 21.7),
        ("M_drag", model.drag_moment, 14.5),
    ] {
        near(what, ours, printed, 0.02);
    }
    // those rounded intermediates make 334 of what is 331.1
    let total = law.parts(3500.0 * RPM, 2990.0, 100.0).sum();
    near("M", total, 334e-3, 0.01);
    near("M of an independent script", total, 331.075_07e-3, 1e-7);
    let SkfContacts::SphericalRoller(contacts) = law.contacts else {
        panic!("a spherical roller bearing");
    };
    // the branch of the large load, which the example prints and does not use
    let large = SkfMoment {
        contacts: SkfContacts::SphericalRoller(physics::skf::SkfSphericalRoller {
            r1: 1.0,
            s1: 1.0,
            ..contacts
        }),
        ..law
    }
    .intermediates(3500.0 * RPM, 2990.0, 100.0);
    near("G_rr.l", large.rolling_variable, 0.436, 0.02);
    near("G_sl.l", large.sliding_variable, 1236.6, 0.02);
}

/// The same formulas evaluated by a script of another language; eight digits.
#[test]
fn ball_bearings_by_an_independent_script() {
    let (bearing, lubricant) = bearing_6005();
    let law = bearing.moment(&lubricant).unwrap();
    let slow = bearing
        .moment(&SkfLubricant {
            viscosity: 10.0 * MM2_S,
            ..lubricant
        })
        .unwrap();
    #[rustfmt::skip]
    let rows: [(&str, SkfIntermediates<f64>, [f64; 7]); 4] = [
        ("6005 radial", law.intermediates(1500.0 * RPM, 80.0, 0.0),
            [0.004_906_879_03, 6.258_353_73, 0.961_519_566, 0.841_978_817, 2.182_161_19, 0.050_000_006_7, 0.109_108_074]),
        ("6005 combined", law.intermediates(1500.0 * RPM, 80.0, -50.0),
            [0.016_070_445_9, 20.496_640_4, 0.961_519_566, 0.841_978_817, 11.829_763_2, 0.050_000_006_7, 0.591_488_242]),
        ("6005 slow, thin oil", slow.intermediates(50.0 * RPM, 80.0, 50.0),
            [0.016_070_445_9, 0.668_975_064, 0.999_882_100, 0.999_426_830, 11.829_763_2, 0.149_439_451, 1.767_833_32]),
        ("single row angular contact", {
            let (bearing, lubricant) = spindle(SkfType::AngularContactSingleRow);
            bearing.moment(&lubricant).unwrap().intermediates(20_000.0 * RPM, 100.0, 200.0)
        }, [0.060_962_280_9, 140.054_543_6, 0.672_695_606, 0.738_908_709, 1_254.754_643, 0.04, 50.190_185_7]),
    ];
    for (case, model, expected) in rows {
        let ours = [
            model.rolling_variable,
            model.rolling_moment,
            model.inlet_shear_factor,
            model.starvation_factor,
            model.sliding_variable,
            model.sliding_friction,
            model.sliding_moment,
        ];
        for (ours, expected) in ours.into_iter().zip(expected) {
            near(case, ours, expected, 1e-8);
        }
    }
}

#[test]
fn the_other_rows_of_angular_contact() {
    let variables = |bearing: SkfBearing| {
        let (_, lubricant) = spindle(bearing.kind);
        let law = bearing.moment(&lubricant).unwrap();
        let model = law.intermediates(20_000.0 * RPM, 100.0, 200.0);
        (
            model.rolling_variable,
            model.sliding_variable,
            model.drag_moment,
        )
    };
    // independent script: G_rr, G_sl; drag 82.97289 N mm for K_z 4.4 and one row
    for (kind, rolling, sliding, drag) in [
        (
            SkfType::AngularContactSingleRow,
            0.060_962_280_9,
            1_254.754_643,
            82.972_893_4,
        ),
        (
            SkfType::AngularContactDoubleRow,
            0.051_234_774_4,
            261.960_392,
            82.972_893_4 * 3.1 / 4.4 * 2.0,
        ),
        (
            SkfType::FourPointContact,
            0.051_730_027_6,
            796.285_535,
            82.972_893_4 * 3.1 / 4.4,
        ),
    ] {
        let ours = variables(spindle(kind).0);
        near("G_rr", ours.0, rolling, 1e-8);
        near("G_sl", ours.1, sliding, 1e-8);
        near("M_drag", ours.2, drag, 1e-8);
    }
    let hybrid = variables(SkfBearing {
        ceramic_balls: true,
        ..spindle(SkfType::AngularContactSingleRow).0
    });
    near("G_rr hybrid", hybrid.0, 0.042_289_836_9, 1e-8);
    near("G_sl hybrid", hybrid.1, 429.161_374_7, 1e-8);
}

/// Table 3a, p. 93, column by column.
#[test]
fn deep_groove_constants_as_printed() {
    let series = [
        "2, 3",
        "42, 43",
        "60, 630",
        "62, 622",
        "63, 623",
        "64",
        "160, 161",
        "617, 618, 628, 637, 638",
        "619, 639",
    ];
    let r1 = [4.4, 5.4, 4.1, 3.9, 3.7, 3.6, 4.3, 4.7, 4.3];
    let r2 = [1.7, 0.96, 1.7, 1.7, 1.7, 1.7, 1.7, 1.7, 1.7];
    let s1 = [2.00, 3.00, 3.73, 3.23, 2.84, 2.43, 4.63, 6.50, 4.75];
    let s2 = [100.0, 40.0, 14.6, 36.5, 92.8, 198.0, 4.25, 0.78, 3.6];
    let (bearing, lubricant) = bearing_6005();
    let mut names = 0;
    for (k, row) in series.iter().enumerate() {
        for series in row.split(", ") {
            let law = SkfBearing { series, ..bearing }.moment(&lubricant).unwrap();
            let SkfContacts::DeepGroove(own) = law.contacts else {
                panic!("a deep groove bearing");
            };
            near("R1", own.r1, r1[k] * 1e-7, 1e-12);
            near("S1", own.s1, s1[k] * 1e-3, 1e-12);
            assert_eq!((own.r2, own.s2), (r2[k], s2[k]), "{series}");
            names += 1;
        }
    }
    assert_eq!(names, 20);
}

#[test]
fn what_has_no_source_is_refused_with_its_reason() {
    let (groove, grease) = bearing_6005();
    let reason = |bearing: SkfBearing, lubricant: &SkfLubricant| {
        bearing.moment(lubricant).unwrap_err().to_string()
    };
    for (bearing, why) in [
        (
            SkfBearing {
                kind: SkfType::CylindricalRoller,
                ..groove
            },
            "no checked load formula and constants for a cylindrical roller bearing",
        ),
        (
            SkfBearing {
                series: "600",
                ..groove
            },
            "no constants for series \"600\" of a deep groove ball bearing; known are 2, 3, 42",
        ),
        (
            SkfBearing {
                kind: SkfType::SphericalRoller,
                ..groove
            },
            "known are 213 E, 222 E",
        ),
        (
            SkfBearing {
                ceramic_balls: true,
                ..groove
            },
            "no factor for ceramic balls in a deep groove",
        ),
        (
            SkfBearing {
                static_load_rating: None,
                ..groove
            },
            "needs its static load rating",
        ),
        (
            SkfBearing {
                bore: 47e-3,
                ..groove
            },
            "outer diameter less bore",
        ),
    ] {
        let found = reason(bearing, &grease);
        assert!(found.contains(why), "{found}");
    }
    for (lubricant, why) in [
        (
            SkfLubricant {
                drag_variable: 1e-4,
                ..grease
            },
            "belongs to an oil bath",
        ),
        (
            SkfLubricant {
                viscosity: 0.0,
                ..grease
            },
            "viscosity 0",
        ),
        (
            SkfLubricant {
                seal_moment: f64::NAN,
                ..grease
            },
            "seal moment NaN",
        ),
    ] {
        let found = reason(groove, &lubricant);
        assert!(found.contains(why), "{found}");
    }
}
