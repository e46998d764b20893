//! What the races see of their balls: how hot skids are, and what fatigue takes.

use crate::outcomes::number;
use auxbear::outcome::Outcome;
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

const STEP: &str = include_str!("../../../scenarios/spin_up_step.toml");

fn ran(sets: &[&str]) -> Outcome {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let scenario = Scenario::parse(STEP, "step.toml", &sets, &BuiltIn).unwrap();
    let never = AtomicBool::new(false);
    run(&scenario, &Options::unwatched(&never)).unwrap()
}

/// Load and slip of every ball at the inner race in the first row.
fn at_the_start(outcome: &Outcome) -> Vec<[f64; 2]> {
    let column = |ball: usize, what: &str| {
        let name = format!("bearing.ball_{ball:02}.inner_{what}");
        let found = outcome.history.iter().find(|column| column.name == name);
        found.unwrap_or_else(|| panic!("{name}")).values[0]
    };
    (1..=10)
        .map(|ball| ["load", "slip"].map(|what| column(ball, what)))
        .collect()
}

#[test]
fn a_race_that_has_its_speed_at_once_flashes_as_by_hand() {
    let run = ran(&[]);
    // semi-axes of 1 N from Hertz's integrals, groove of 0.515 balls; steel as in the book
    let (across, along) = (1.3680e-4, 1.2637e-5);
    let (conductivity, diffusivity) = (46.0, 46.0 / (7850.0 * 460.0));
    // the middle of a uniform ellipse at rest: kT/(qb) = (2/π) K, by the arithmetic-geometric mean
    let (mut one, mut other): (f64, f64) = (1.0, along / across);
    for _ in 0..8 {
        (one, other) = (0.5 * (one + other), (one * other).sqrt());
    }
    let at_rest = 4.0 / PI * one * one;
    let expected = at_the_start(&run).into_iter().map(|[load, slip]| {
        // balls stand, the race passes them with all of the slip; 0.07 of traction is the default of the law
        assert!((slip / (1000.0 * 14.825e-3) - 1.0).abs() < 1e-3, "{slip}");
        let (across, along) = (across * load.cbrt(), along * load.cbrt());
        let side =
            |peclet: f64| 0.5 * conductivity * (PI * (at_rest + peclet)).sqrt() * PI * across;
        let power = 0.07 * load * slip;
        1.19 * power / (side(0.0) + side(slip * along / (2.0 * diffusivity)))
    });
    let expected = expected.fold(0.0, f64::max);
    let found = number(&run, "inner_flash_temperature_rise");
    // the first look is 10 ns later
    assert!((found / expected - 1.0).abs() < 2e-3, "{found} {expected}");
    assert!(number(&run, "inner_flash_time") < 1e-5);
    assert_eq!(number(&run, "skid_temperature_index"), found / 500.0);
    // the outer race is warmed by balls that the inner one has spun up, later and less
    let outer = number(&run, "outer_flash_temperature_rise");
    assert!(outer > 0.0 && outer < found, "{outer}");
    assert_eq!(number(&run, "inner_denting_passages"), 0.0);
}

#[test]
fn a_fast_and_heavily_loaded_skid_is_told_and_dents() {
    let hot = ["drive.final_speed=3000 rad/s", "drive.radial_load=3 kN"];
    let run = ran(&hot);
    let rise = number(&run, "inner_flash_temperature_rise");
    assert!(rise > 500.0, "{rise}");
    let told = |code: &str| run.warnings.iter().filter(|w| w.code == code).count();
    assert_eq!(told("AB2303"), 1);
    // 1.8 GPa more would be the limit; a lower one is passed by each ball in the load zone
    let soft = [&hot[..], &["bearing.hertz_pressure_limit=2 GPa"]].concat();
    let dents = number(&ran(&soft), "inner_denting_passages");
    assert!((2.0..=100.0).contains(&dents), "{dents}");
    assert_eq!(
        ran(&[])
            .warnings
            .iter()
            .filter(|w| w.code == "AB2303")
            .count(),
        0
    );
}
