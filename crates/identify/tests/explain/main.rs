//! Does the comparison of explanations name the truth of a laboratory that is finer than its models?

mod bearing;
mod lab;

use identify::explain::{Conclusion, Explanation, Priors, Settings, Verdict, explain};
use lab::{Campaign, Chance, Truth};

fn campaign(explanation: Explanation, seed: u64, with_cage: bool) -> Campaign {
    let mut chance = Chance::new(1000 * explanation as u64 + seed + 1);
    Truth::draw(explanation, &mut chance).campaign(&mut chance, with_cage)
}

fn judge(campaign: &Campaign) -> Verdict {
    explain(
        &campaign.tests,
        &campaign.steady,
        &campaign.set,
        &Priors::default(),
        &Settings::default(),
    )
    .expect("a usable campaign")
}

/// Runs of each explanation; more of them where the environment says so.
fn runs() -> u64 {
    std::env::var("EXPLAIN_RUNS")
        .ok()
        .and_then(|runs| runs.parse().ok())
        .unwrap_or(2)
}

#[test]
fn right_as_often_as_promised() {
    for with_cage in [true, false] {
        for truth in Explanation::ALL {
            let (mut right, mut undecided, mut none, mut wrong) = (0, 0, 0, 0);
            for seed in 0..runs() {
                let campaign = campaign(truth, seed, with_cage);
                let start = std::time::Instant::now();
                let verdict = judge(&campaign);
                let spent = start.elapsed().as_secs_f64();
                match &verdict.conclusion {
                    Conclusion::Supported(winner) if *winner == truth => right += 1,
                    Conclusion::Supported(_) => wrong += 1,
                    Conclusion::NoneOfThese => none += 1,
                    Conclusion::Undecided(left) if left.contains(&truth) => undecided += 1,
                    Conclusion::Undecided(_) => wrong += 1,
                }
                if std::env::var("EXPLAIN_TELL").is_ok() {
                    println!("{:?} {:?} {:?} {spent:.2} s", campaign.truth.fault, campaign.truth.bearing.lubricant, verdict.conclusion);
                    for a in &verdict.assessments {
                        println!(
                            "   {:28} {:.4} lnZ {:9.2} ± {:.2} fit {:?} {}",
                            a.explanation.name(), a.probability, a.log_evidence, a.log_evidence_deviation,
                            a.fit.map(|f| (f.chi_squared as i64, f.count, (1e4 * f.probability).round() / 1e4, (1e3 * f.discrepancy).round() / 1e3)),
                            a.parameters.iter().map(|p| format!("{:.3}±{:.3}", p.mean, p.deviation)).collect::<Vec<_>>().join(" "),
                        );
                    }
                }
            }
            println!("cage {with_cage} {truth:?}: right {right} undecided {undecided} none {none} wrong {wrong}");
        }
    }
}
