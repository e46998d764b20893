//! Rare events by widened members: a known probability of a thousandth lies in its stated interval as often as it should.

use statistics::correlation::Correlation;
use statistics::design::{Coordinate, Design};
use statistics::normal::quantile;
use statistics::share::weighted;

/// Standard normal numbers of a member, correlated or not.
fn numbers(design: &Design, seed: u64, k: usize, mixed: Option<&Correlation>) -> Vec<f64> {
    let shares = design.member(seed, k).into_iter();
    let mut shares: Vec<f64> = shares
        .map(|coordinate| match coordinate {
            Coordinate::Share(u) => u,
            other => panic!("{other:?}"),
        })
        .collect();
    if let Some(mixed) = mixed {
        shares = mixed.apply(&shares);
    }
    shares.into_iter().map(quantile).collect()
}

/// Whether a member shows an event of probability p, beyond which the normal number of `p` lies.
type Event = fn(&[f64], f64) -> bool;

#[test]
fn a_known_probability_lies_in_its_interval_as_often_as_it_should() {
    let seeds = std::env::var("AUXBEAR_SEEDS").ok();
    let seeds: u64 = seeds.and_then(|text| text.parse().ok()).unwrap_or(200);
    // one input alone beside an idle one; a sum; both tails of one
    let cases: [(&str, usize, Event); 3] = [
        ("one of two inputs", 2, |z, beyond| z[0] > beyond),
        ("a sum of three", 3, |z, beyond| {
            (z[0] + z[1] + z[2]) / 3.0_f64.sqrt() > beyond
        }),
        ("four inputs, two of them idle", 4, |z, beyond| {
            0.8 * z[1] + 0.6 * z[3] > beyond
        }),
    ];
    for (name, inputs, event) in cases {
        for p in [1e-3, 1e-4] {
            let beyond = quantile(1.0 - p);
            let members = 2000;
            let design = Design::Widened(inputs, members, 2.0);
            let (mut inside, mut width) = (0, 0.0);
            for seed in 0..seeds {
                let shown: Vec<f64> = (0..members)
                    .map(|k| match event(&numbers(&design, seed, k, None), beyond) {
                        true => design.weight(seed, k),
                        false => 0.0,
                    })
                    .collect();
                let (_, [low, high]) = weighted(&shown).expect("enough show it");
                width += (high - low) / p / seeds as f64;
                inside += u64::from((low..=high).contains(&p));
            }
            let share = 100.0 * inside as f64 / seeds as f64;
            println!(
                "{name}, p = {p:e}: in the interval in {share:.1} % of {seeds} seeds, its width {width:.2} p"
            );
            assert!((90.0..=98.5).contains(&share), "{name} {p}: {share}");
        }
    }
}

#[test]
fn weights_have_the_mean_one_and_correlation_changes_no_probability() {
    let design = Design::Widened(2, 20_000, 1.5);
    let all = |k: usize| design.weight(7, k);
    let mean = (0..20_000).map(all).sum::<f64>() / 20_000.0;
    assert!((mean - 1.0).abs() < 0.02, "{mean}");
    assert_eq!(Design::MonteCarlo(2, 10).weight(7, 3), 1.0);
    // a sum of two numbers of correlation 0.5 has the variance 3
    let mixed = Correlation::of(2, &[(0, 1, 0.5)]).expect("they can be together");
    let beyond = quantile(1.0 - 1e-3) * 3.0_f64.sqrt();
    let shown: Vec<f64> = (0..20_000)
        .map(
            |k| match numbers(&design, 7, k, Some(&mixed)).iter().sum::<f64>() > beyond {
                true => all(k),
                false => 0.0,
            },
        )
        .collect();
    let (p, [low, high]) = weighted(&shown).expect("enough show it");
    assert!(
        low < 1e-3 && 1e-3 < high && (p / 1e-3 - 1.0).abs() < 0.1,
        "{p}"
    );
    // what too few show has no probability
    assert_eq!(weighted(&[0.0; 50]), None);
}
