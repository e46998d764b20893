//! Answers other than the right name: undecided with a next test, none of these, refusals; and the laboratory itself.

use identify::explain::{Conclusion, Explanation, Proposal, Settings, Verdict, explain, next_test};

use super::bearing::{Bearing, Lubricant, MOMENT};
use super::lab::{Campaign, Chance, Fault, Slow, TOP, Truth, course};
use super::{campaign, judge};

/// A bearing that rolls, or slips where its traction limit is low.
fn bearing(traction_limit: f64) -> Bearing {
    Bearing {
        lubricant: Lubricant {
            grease: None,
            heating: None,
            traction_limit,
        },
        load_swing: 0.5,
        slip_speed: 0.05,
        load_share: 0.1,
        orbit_share: 0.45,
    }
}

#[test]
fn the_fine_bearing_closes_its_angular_momentum_and_makes_no_cold() {
    for limit in [0.7, 6.0] {
        let (speed, fine_until, _) = course(7200.0);
        let mut last: Option<super::bearing::Row> = None;
        for row in bearing(limit).run(speed, 1.0, fine_until) {
            if let Some(last) = last {
                let change =
                    (row.angular_momentum - last.angular_momentum) / (row.time - last.time);
                // the scalar equation for the orbit stops at steps of 1e-10 m/s
                let residual = row.inner_moment - row.outer_moment - change;
                assert!(residual.abs() < 1e-3 * MOMENT, "{} {residual}", row.time);
            }
            assert!(row.heat >= -1e-9);
            last = Some(row);
        }
        // at the end of a hold: M where it rolls, the traction limit (and its rolling couple) where it slips
        let end = last.map_or(0.0, |row| row.outer_moment);
        let expected = if limit > 1.0 {
            bearing(limit).steady(TOP * 0.9984)
        } else {
            limit * MOMENT
        };
        assert!((end / expected - 1.0).abs() < 0.04, "{end} {expected}");
    }
}

/// A campaign cut to the hold of its quickest test, without a signal of the cage.
fn cut(mut campaign: Campaign) -> Campaign {
    campaign.tests.drain(..2);
    let test = &mut campaign.tests[0];
    let count = test.time.partition_point(|t| *t < 5.2);
    for values in [
        &mut test.time,
        &mut test.speed,
        &mut test.speed_deviation,
        &mut test.acceleration,
        &mut test.acceleration_deviation,
        &mut test.torque,
        &mut test.torque_deviation,
        &mut test.correlation_time,
    ] {
        values.truncate(count);
    }
    test.cage = None;
    campaign
}

#[test]
fn below_the_slow_tests_nothing_speaks_against_rolling() {
    // a coast-down that ends at 52 rad/s of 150: at 8 rad/s M is a fifth of it, and no datum of the slow tests shows it
    for seed in 0..4 {
        let mut campaign = campaign(Explanation::Rolling, seed);
        let steady = &mut campaign.steady;
        let known = steady.speed.partition_point(|speed| *speed < 50.0);
        steady.speed.drain(..known);
        steady.moment.drain(..known);
        steady.covariance.drain(..known);
        for row in &mut steady.covariance {
            row.drain(..known);
        }
        let supported = Conclusion::Supported(Explanation::Rolling);
        assert_eq!(judge(&campaign).conclusion, supported, "{seed}");
        for test in &mut campaign.tests {
            test.cage = None;
        }
        // without a cage signal the holds alone do not exclude a slip just below M
        let conclusion = judge(&campaign).conclusion;
        let first = match &conclusion {
            Conclusion::Supported(one) => Some(one),
            Conclusion::Undecided(left) => left.first(),
            Conclusion::NoneOfThese => None,
        };
        assert_eq!(first, Some(&Explanation::Rolling), "{seed} {conclusion:?}");
    }
}

fn ask(campaign: &Campaign, verdict: &Verdict) -> Vec<identify::explain::Candidate> {
    next_test(
        verdict,
        &campaign.tests,
        &campaign.steady,
        &campaign.set,
        &Settings::default(),
    )
    .expect("a usable campaign")
}

#[test]
fn one_short_test_leaves_doubt_and_the_next_test_is_named() {
    // creep of the sensor: one hold alone separates it from neither grease nor heated slip
    let mut chance = Chance::new(17);
    let truth = Truth {
        bearing: bearing(5.0),
        fault: Fault::Creep(-0.25, 1.5),
        slow: Slow::same(&bearing(5.0)),
    };
    let campaign = cut(truth.campaign(&mut chance));
    let verdict = judge(&campaign);
    let Conclusion::Undecided(left) = &verdict.conclusion else {
        panic!("{:?}", verdict.conclusion);
    };
    assert!(
        left.contains(&Explanation::Sensor) && left.len() > 1,
        "{left:?}"
    );
    let candidates = ask(&campaign, &verdict);
    assert_eq!(candidates.len(), Proposal::ALL.len());
    let information = |proposal: Proposal| {
        candidates
            .iter()
            .find(|c| c.proposal == proposal)
            .map_or(f64::NAN, |c| c.information)
    };
    let entropy: f64 = (verdict.assessments.iter())
        .filter(|a| a.probability > 0.0)
        .map(|a| -a.probability * a.probability.ln())
        .sum();
    for pair in candidates.windows(2) {
        assert!(pair[0].information >= pair[1].information);
    }
    for candidate in &candidates {
        // explanations below half a percent are left out of the ranking: their entropy is missing
        assert!(candidate.information >= 0.0 && candidate.information < entropy + 0.05);
        assert!(candidate.proposal.difference().len() > 20);
    }
    // the outer race warms the same whatever the cause: least of all
    assert!(candidates[0].information > information(Proposal::Temperature) + 0.1);
    assert!(candidates[0].share > 0.3, "{candidates:?}");
    // the same seed, the same answers
    assert_eq!(verdict, judge(&campaign));
    assert_eq!(candidates, ask(&campaign, &verdict));
}

#[test]
fn a_transient_of_another_kind_is_none_of_these() {
    // a particle in the races: 40 % more torque for a second, in one test of three
    let mut campaign = campaign(Explanation::Rolling, 3);
    let test = &mut campaign.tests[1];
    for (time, torque) in test.time.iter().zip(&mut test.torque) {
        if (1.8..2.9).contains(time) {
            *torque += 0.4 * MOMENT;
        }
    }
    assert_eq!(judge(&campaign).conclusion, Conclusion::NoneOfThese);
}

#[test]
fn what_cannot_be_used_is_refused() {
    let good = cut(campaign(Explanation::Rolling, 4));
    let ask = |change: &dyn Fn(&mut Campaign, &mut Settings)| {
        let (mut campaign, mut settings) = (
            Campaign {
                truth: good.truth,
                tests: good.tests.clone(),
                steady: good.steady.clone(),
                set: good.set,
            },
            Settings::default(),
        );
        change(&mut campaign, &mut settings);
        explain(&campaign.tests, &campaign.steady, &campaign.set, &settings).map(|_| ())
    };
    let refused = |change: &dyn Fn(&mut Campaign, &mut Settings), why: &str| {
        let said = ask(change).unwrap_err();
        assert!(said.contains(why), "{said}");
    };
    refused(&|c, _| c.tests.clear(), "no test was given");
    let bad = format!("test \"{}\": at least ten values", good.tests[0].name);
    refused(&|c, _| c.tests[0].torque[5] = f64::NAN, &bad);
    refused(&|c, _| c.tests[0].time[5] = 0.0, &bad);
    refused(&|c, _| c.tests[0].speed.truncate(7), &bad);
    refused(&|c, _| c.tests[0].speed.fill(0.0), &bad);
    refused(&|c, _| c.tests[0].torque_deviation[3] = 0.0, &bad);
    refused(
        &|c, _| {
            let mut other = c.tests[0].clone();
            other.load *= 2.0;
            c.tests.push(other);
        },
        "ran at another load than the first",
    );
    let curve = "the steady moment needs rising positive speeds";
    refused(&|c, _| c.steady.moment[0] = -1.0, curve);
    refused(&|c, _| c.steady.covariance.truncate(3), curve);
    let setting = "setting \"decision\" is out of its range";
    refused(&|_, s| s.decision = 1.0, setting);
}
