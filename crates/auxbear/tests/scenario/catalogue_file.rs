//! A catalogue of one's own, named in a scenario.

use super::files::SPIN_UP;
use auxbear::scenario::{BuiltIn, Scenario, System};
use std::fs;

#[test]
fn a_catalogue_beside_the_file_is_used_and_its_problems_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("spin_up.toml");
    let text = SPIN_UP
        .replace("name = \"6005\"", "name = \"mine\"")
        .replace("[drive]", "catalogue = \"my_bearings.toml\"\n\n[drive]");
    fs::write(&file, text).unwrap();
    let read = || Scenario::read(&file, &[], &BuiltIn).map_err(|problem| problem.to_string());
    let shown = read().unwrap_err();
    assert!(
        shown.starts_with("error[AB0001]") && shown.contains("my_bearings.toml"),
        "{shown}"
    );
    assert!(shown.contains("It is named by catalogue in"), "{shown}");

    let own = folder.path().join("my_bearings.toml");
    let bearing = "format = \"auxbear.bearings/1\"\n\n[[bearing]]\nname = \"mine\"\ndescription = \"my bearing\"\ntype = \"deep groove\"\nbore_diameter = \"25 mm\"\nouter_diameter = \"47 mm\"\nwidth = \"12 mm\"\nball_count = 10\nball_diameter = \"6.35 mm\"\npitch_diameter = \"36 mm\"\ninner_race_mass = \"20 g\"\ninner_race_inertia = \"3.9e-6 kg m^2\"\n";
    fs::write(&own, bearing.replace("\"6.35 mm\"", "\"6.35 kg\"")).unwrap();
    let shown = read().unwrap_err();
    assert!(
        shown.contains("my_bearings.toml") && shown.contains("6.35 kg"),
        "{shown}"
    );

    fs::write(&own, bearing).unwrap();
    let scenario = read().unwrap();
    let System::SpinUp(spin_up) = &scenario.system else {
        panic!();
    };
    assert_eq!(spin_up.bearing.ball_diameter, 0.00635);
    // the resolved file finds it from another folder
    let elsewhere = tempfile::tempdir().unwrap();
    let resolved = elsewhere.path().join("scenario.toml");
    fs::write(&resolved, scenario.resolved.toml()).unwrap();
    let again = Scenario::read(&resolved, &[], &BuiltIn).unwrap();
    assert_eq!(again.system, scenario.system);
}
