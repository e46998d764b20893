use super::*;

#[test]
fn certain_spins_are_reported_and_uncertain_ones_are_not() {
    let chance = |value, deviation| probability(Uncertain::new(value, deviation), 0.0);
    // half the rolling spin, known to 5 %: skids
    assert!(chance(0.5, 0.05).unwrap() > 0.99);
    // rolling, known to 5 %: a mass at 1 against an even spread below favours rolling 1 to 0.06
    let rolls = chance(1.0, 0.05).unwrap();
    assert!(rolls < 0.08 && rolls > 0.0);
    // known to twice its range: nothing
    assert_eq!(chance(0.8, 2.0), None);
}
