//! Shares, films and feedback of the heat of a bearing.

use super::*;
use physics::heat_conduction::SILICON_NITRIDE_HEAT;
use thermal::bearing_network::HOUSING;

#[test]
fn shares_add_to_one_and_every_heat_has_a_place() {
    for ball in [STEEL_HEAT, SILICON_NITRIDE_HEAT] {
        for row in shares(ball, STEEL_HEAT, OUTER_RACE, HOUSING) {
            assert_eq!(row.iter().sum::<f64>(), 1.0);
            assert!(row.iter().all(|share| (0.0..=1.0).contains(share)));
        }
    }
    assert!(place("steady_moment") < HEATS && place("rotor_race_friction") < HEATS);
    // steel on steel half and half; a ring takes 0.58 beside a ceramic ball
    let of = |ball| shares(ball, STEEL_HEAT, OUTER_RACE, HOUSING)[place("inner_ball_slip")];
    assert_eq!(of(STEEL_HEAT)[INNER_RACE], 0.5);
    assert!((of(SILICON_NITRIDE_HEAT)[INNER_RACE] - 0.58).abs() < 0.005);
    // sliding at both races: a ring's part of its contact is 0.58 beside silicon nitride
    assert_eq!(sliding(STEEL_HEAT)[BALLS], 0.5);
    let hybrid = sliding(SILICON_NITRIDE_HEAT);
    for (node, share) in [(INNER_RACE, 0.29), (BALLS, 0.42), (OUTER_RACE, 0.29)] {
        assert!((hybrid[node] - share).abs() < 0.005, "{hybrid:?}");
    }
    // of a polyamide cage's friction the cage takes 5 %
    let polyamide = ThermalMaterial {
        conductivity: 0.25,
        density: 1140.0,
        specific_heat: 1700.0,
    };
    let pocket = shares(STEEL_HEAT, polyamide, OUTER_RACE, HOUSING)[place("pocket_friction")];
    assert!((pocket[CAGE] - 0.05).abs() < 0.006, "{}", pocket[CAGE]);
}
