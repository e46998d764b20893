//! Rotors of other programs, and tables of sections.

use super::rotor::parsed;
use auxbear::import::import;
use auxbear::scenario::System;
use auxbear::simulate::rotor::RotorModel;
use std::path::PathBuf;

fn file(name: &str, text: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("auxbear-import-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

/// A rotor in the form in which ROSS 2 saves it.
fn saved(version: &str) -> String {
    let shaft = |n: usize| {
        format!(
            "\"ShaftElement_Shaft Element {n}\": {{\"L\": 0.25, \"idl\": 0.0, \"odl\": 0.05, \"idr\": 0.0, \"odr\": 0.05, \
             \"material\": {{\"name\": \"Steel\", \"rho\": 7810.0, \"E\": 211e9, \"G_s\": 81.2e9, \"color\": \"#525252\"}}, \
             \"n\": {n}, \"axial_force\": {n}, \"torque\": 0, \"shear_effects\": true, \"rotary_inertia\": true, \
             \"gyroscopic\": true, \"tag\": \"Shaft Element {n}\", \"alpha\": 0.0, \"beta\": 0.0}}"
        )
    };
    format!(
        "{{{version} \"parameters\": {{\"min_w\": null, \"max_w\": null, \"rated_w\": 300.0}}, {}, {}, \
         \"DiskElement_Disk 0\": {{\"n\": 1, \"m\": 32.6, \"Id\": 0.178, \"Ip\": 0.33, \"tag\": \"Disk 0\"}}, \
         \"BearingElement_de\": {{\"n\": 0, \"n_link\": 3, \"kxx\": [1e6], \"kyy\": [0.8e6], \"kxy\": [0.0], \"kyx\": [0.0], \
         \"cxx\": [100.0], \"cyy\": [100.0], \"cxy\": [0.0], \"cyx\": [0.0], \"mxx\": [0.0], \"myy\": [0.0], \"kzz\": [5.0], \
         \"frequency\": null}}, \
         \"BearingElement_floor\": {{\"n\": 3, \"n_link\": null, \"kxx\": 2e6, \"kyy\": 2e6, \"cxx\": 800.0, \"cyy\": 800.0}}, \
         \"SealElement_seal\": {{\"n\": 2, \"kxx\": [1e5, 2e5], \"kyy\": [1e5, 2e5], \"kxy\": [1e4, 1e4], \"kyx\": [-1e4, -1e4], \
         \"cxx\": [50.0, 60.0], \"cyy\": [50.0, 60.0], \"frequency\": [0.0, 400.0]}}, \
         \"PointMass_pedestal\": {{\"n\": 3, \"m\": 5.0, \"mx\": 5.0, \"my\": 5.0}}, \
         \"CouplingElement_c\": {{\"n\": 0}}}}",
        shaft(0),
        shaft(1)
    )
}

#[test]
fn a_rotor_saved_by_ross_is_written_without_loss() {
    let path = file("saved.json", &saved("\"ross_version\": \"2.3.0\","));
    let imported = import(&path).unwrap();
    assert!(imported.kind.contains("ROSS 2.3.0"));
    for words in ["axial_force", "kzz", "CouplingElement c", "over frequency"] {
        assert!(
            imported.notes.iter().any(|note| note.contains(words)),
            "{words}: {:?}",
            imported.notes
        );
    }
    // another shear coefficient than Cowper's is no matter of looks
    let other = "\"gyroscopic\": true, \"shear_method_calc\": \"hutchinson\"";
    let other = saved("\"ross_version\": \"2.3.0\",").replace("\"gyroscopic\": true", other);
    let other = import(&file("shear.json", &other)).unwrap().notes;
    let told = |note: &String| note.contains("shear coefficient of hutchinson");
    assert!(other.iter().any(told), "{other:?}");
    assert!(!imported.notes.iter().any(|note| note.contains("shear")));
    assert_eq!(imported.eigenvalues.len(), 2);
    for compared in &imported.eigenvalues {
        assert!(
            compared.before.len() == 8 && compared.deviation() < 1e-12,
            "{}",
            compared.deviation()
        );
    }
    let System::Rotor(rotor) = parsed(&imported.toml, &[]).unwrap().system else {
        panic!("a rotor");
    };
    let model = &rotor.rotor;
    assert_eq!((model.housings.len(), model.supports.len()), (1, 3));
    let seal = model.supports.iter().find(|support| support.seal).unwrap();
    assert_eq!(
        seal.coefficients.at(200.0).stiffness,
        [[1.5e5, 1e4], [-1e4, 1.5e5]]
    );
    assert_eq!(rotor.speed, 300.0);
}

/// One rotor, saved by ROSS 2.3.0 with tables over frequency, by ROSS 3.1.0 over speed, over frequency and over both.
#[test]
fn a_rotor_saved_by_ross_2_and_3_is_the_same_rotor() {
    let [two, three] = [include_str!("ross_2.json"), include_str!("ross_3.json")]
        .map(|text| import(&file("ross.json", text)).unwrap());
    let numbers = |toml: &str| -> String {
        let lines = toml.lines().filter(|line| !line.starts_with('#'));
        lines.skip_while(|line| *line != "[rotor]").collect()
    };
    assert_eq!(numbers(&two.toml), numbers(&three.toml));
    assert!(three.kind.contains("ROSS 3.1.0"));
    // Source: `run_modal(200.0)` of both versions, where the tables have a row
    let source = [
        (-18.5883176, 827.2930342),
        (-17.1977425, 852.6134123),
        (-143.7229598, 2062.9851591),
        (-142.6969671, 2248.7448343),
    ];
    for imported in [&two, &three] {
        let at_speed = &imported.eigenvalues[1];
        assert_eq!(at_speed.speed, 200.0);
        for (re, im) in source {
            let near = |z: &rotor::C64| {
                // with the spin Im λ > 0
                ((z.re - re).powi(2) + (z.im.abs() - im).powi(2)).sqrt() < 1e-6 * im
            };
            assert!(at_speed.after.iter().any(near), "{:?}", at_speed.after);
        }
    }
    for (note, imported) in [
        (
            "balance: its table over frequency is taken as one over speed, and is linear",
            &two,
        ),
        ("(a spline in ROSS 2)", &two),
        (
            "drive_end: its table is linear between its rows and constant beyond",
            &three,
        ),
        (
            "balance: its table over frequency is taken as one over speed",
            &three,
        ),
        (
            "labyrinth: its table over speed and frequency is taken where both are the same",
            &three,
        ),
        ("(PCHIP, and the slope of its ends, in ROSS 3)", &three),
    ] {
        assert!(
            imported.notes.iter().any(|told| told.contains(note)),
            "{note}: {:?}",
            imported.notes
        );
    }
    // between the frequencies of its table, and a rotor damped as a whole
    let three = include_str!("ross_3.json");
    let other = three.replacen("\"alpha\":0.0", "\"alpha\":2.0", 1);
    let other = other.replace(
        "\"frequency\":[100.0,200.0,400.0],\"interpolation\":\"pchip\",\"kxx\":[[",
        "\"frequency\":[100.0,300.0,400.0],\"interpolation\":\"pchip\",\"kxx\":[[",
    );
    let other = import(&file("other.json", &other)).unwrap();
    assert!(
        other
            .notes
            .iter()
            .any(|note| note.contains("parameters: alpha")),
        "{:?}",
        other.notes
    );
    let System::Rotor(rotor) = parsed(&other.toml, &[]).unwrap().system else {
        panic!("a rotor");
    };
    let mut supports = rotor.rotor.supports.iter();
    assert!(supports.any(|own| own.coefficients.at(200.0).stiffness[0][0] == 3.15e5));
}

#[test]
fn a_rotor_of_an_unknown_version_is_refused() {
    for (version, wanted) in [
        ("\"ross_version\": \"4.0.0\",", "ROSS version 4.0.0"),
        ("\"ross_version\": \"1.6.1\",", "ROSS version 1.6.1"),
    ] {
        let path = file("version.json", &saved(version));
        let told = import(&path).map(|_| ()).unwrap_err().to_string();
        assert!(told.contains("AB2005") && told.contains(wanted), "{told}");
    }
    // without a version it is that of 2.0 where bearings have axial coefficients, else unknown
    assert!(import(&file("two.json", &saved(""))).is_ok());
    let older = saved("").replace("\"kzz\": [5.0], ", "");
    let told = import(&file("older.json", &older))
        .map(|_| ())
        .unwrap_err()
        .to_string();
    assert!(
        told.contains("AB2005") && told.contains("unknown version"),
        "{told}"
    );
}

#[test]
fn a_table_of_sections_becomes_a_shaft() {
    const TABLE: &str = "length [mm];outer diameter [mm];inner diameter [mm];material;disk mass [kg];note\n\
                         100;40;0;steel;;end\n250;60;12;steel;4.5;\n100;40;;titanium;;\n";
    let imported = import(&file("shaft.csv", TABLE)).unwrap();
    let System::Rotor(rotor) = parsed(&imported.toml, &[]).unwrap().system else {
        panic!("a rotor");
    };
    let model = RotorModel::new(&rotor.rotor, rotor.speed).unwrap();
    let body = rotor::properties(&model.rotor);
    let quarter = std::f64::consts::FRAC_PI_4;
    let expected = quarter
        * (7850.0 * (0.1 * 0.04_f64.powi(2) + 0.25 * (0.06_f64.powi(2) - 0.012_f64.powi(2)))
            + 4430.0 * 0.1 * 0.04_f64.powi(2))
        + 4.5;
    assert!((body.mass / expected - 1.0).abs() < 1e-12);
    assert_eq!(model.rotor.nodes[model.rotor.disks[0].node], 0.1);
    assert!(imported.notes.iter().any(|note| note.contains("\"note\"")));
    for which in ["polar", "diametral"] {
        let told = format!("disk_1 of line 3: no {which} inertia");
        assert!(imported.notes.iter().any(|note| note.contains(&told)));
    }
    for (old, new, wanted) in [
        (
            "length [mm]",
            "length",
            "the column \"length\" without a unit",
        ),
        (
            "length [mm]",
            "length [kg]",
            "unit is none of its dimension",
        ),
        ("length [mm]", "len [mm]", "a header without length"),
        ("100;40;0;steel", "100;-40;0;steel", "AB2006"),
        ("titanium", "wood", "a row without material"),
        ("60;12", "60;70", "csv:3: found an inner diameter of 0.07 m"),
    ] {
        let told = import(&file("wrong.csv", &TABLE.replacen(old, new, 1)))
            .map(|_| ())
            .unwrap_err();
        let told = told.to_string();
        assert!(
            told.contains("AB2006") && told.contains(wanted),
            "{new}: {told}"
        );
    }
}

/// The sheet was written by a spreadsheet library of Python.
#[test]
fn a_workbook_says_what_the_same_table_says_as_text_without_a_tail_of_digits() {
    const TABLE: &str = "length [m];outer diameter [mm];material;disk mass [kg]\n0.1;40;steel;\n0.2;60.5;steel;4.5\n0.1;8.8;titanium;1\n";
    let text = import(&file("sections.csv", TABLE)).unwrap();
    let path = file("sections.xlsx", "");
    let workbook = include_bytes!("sections.xlsx");
    std::fs::write(&path, workbook).unwrap();
    assert_eq!(import(&path).unwrap().toml, text.toml);
    // 0.1 m + 0.2 m is 0.30000000000000004 m to a computer
    assert!(text.toml.contains("0.3 m"), "{}", text.toml);
    let mut numbers = text.toml.split(|c: char| !c.is_ascii_digit());
    assert!(numbers.all(|digits| digits.len() < 16), "{}", text.toml);
    std::fs::write(&path, &workbook[..200]).unwrap();
    let told = import(&path).map(|_| ()).unwrap_err().to_string();
    assert!(told.contains("a workbook that cannot be read"), "{told}");
}

/// Two rows of sections each, and a stray cell far out, a column twice, or a comma that may be thousands.
#[test]
fn workbooks_and_tables_that_are_no_sections_are_refused_at_once() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenario/workbooks");
    let refused = |path: &std::path::Path, wanted: &str| {
        let told = import(path).map(|_| ()).unwrap_err().to_string();
        assert!(told.contains(wanted), "{}: {told}", path.display());
    };
    for (name, wanted) in [
        ("farcell", "row 1048576 and column 16384"),
        ("mid", "row 200000 and column 702"),
        ("hdr", "two columns outer diameter"),
        ("thousands", "a decimal comma or thousands"),
    ] {
        refused(
            &std::path::Path::new(folder).join(format!("{name}.xlsx")),
            wanted,
        );
    }
    let head = "length [mm];outer diameter [mm];material\n";
    let long = format!("{head}{}", "1;40;steel\n".repeat(501));
    refused(&file("long.csv", &long), "501 rows of sections");
    let wide = format!("{head}1;40;steel;7\n");
    refused(&file("wide.csv", &wide), "a column without a name");
    refused(
        &file("comma.csv", &format!("{head}1,234;40;steel\n")),
        "thousands",
    );
    assert!(import(&file("decimal.csv", &format!("{head}100,5;40;steel\n"))).is_ok());
    let large = "#".repeat(10_000_001);
    refused(&file("large.csv", &large), "AB0005");
}

#[test]
fn the_reference_rotors_are_imported_with_their_eigenvalues() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../validation/cases/rotor");
    let entries = std::fs::read_dir(folder).unwrap();
    let mut seen = 0;
    for path in entries.map(|entry| entry.unwrap().path()) {
        let Ok(imported) = import(&path) else {
            continue;
        };
        for compared in &imported.eigenvalues {
            assert!(
                compared.stated && compared.deviation() < 1e-6,
                "{}: {}",
                path.display(),
                compared.deviation()
            );
        }
        seen += 1;
    }
    assert_eq!(seen, 8);
}
