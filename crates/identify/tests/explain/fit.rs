//! What the probability of the fit is worth: over campaigns of a truth that is asked for it must be about even between 0 and 1.
//!
//! Of seven campaigns, one of each truth, judged by the torque alone both slips lie below 0.05 (0.02 and 0.05): their reduced model has
//! one load for all balls. With a signal of the cage, for which more is allowed than this laboratory needs, all lie above.

use identify::explain::{Explanation, LEAST_FIT, Settings, explain};

use super::lab::Campaign;
use super::{campaign, runs};

/// Probability of the fit of the true explanation.
fn fit(campaign: &Campaign, truth: Explanation) -> f64 {
    let mut settings = Settings {
        odds: [0.0; 7],
        ..Settings::default()
    };
    settings.odds[truth as usize] = 1.0;
    let verdict = explain(&campaign.tests, &campaign.steady, &campaign.set, &settings)
        .expect("a usable campaign");
    verdict.of(truth).fit.map_or(0.0, |fit| fit.probability)
}

#[test]
fn the_probability_of_the_fit_is_about_even() {
    let mut all: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    for seed in 0..runs() {
        for truth in Explanation::ALL {
            let mut campaign = campaign(truth, seed);
            all[0].push(fit(&campaign, truth));
            for test in &mut campaign.tests {
                test.cage = None;
            }
            all[1].push(fit(&campaign, truth));
        }
    }
    for mut list in all {
        list.sort_by(f64::total_cmp);
        let count = list.len();
        let below = list.iter().filter(|p| **p < 0.05).count();
        // 12 % of many; of seven, the two slips
        assert!(below <= (count * 12 / 100).max(2), "{list:?}");
        // "none of these" of a true explanation would be a wrong answer: one in a hundred
        assert!(list[count / 100] > LEAST_FIT, "{list:?}");
        // not good whatever the data are
        assert!(list[count / 4] < 0.98, "{list:?}");
        println!(
            "below 0.05: {below} of {count}, quartiles {:.2} {:.2} {:.2}",
            list[count / 4],
            list[count / 2],
            list[3 * count / 4]
        );
    }
}
