//! What follows from a verdict for the other results.

use identify::explain::{Conclusion, Explanation};

/// What a conclusion names as the cause of t_O - M, where that is neither friction nor inertia of the balls.
pub(crate) fn other_cause(conclusion: &Conclusion) -> Option<String> {
    let Conclusion::Supported(explanation) = conclusion else {
        return None;
    };
    match explanation {
        Explanation::Grease | Explanation::Sensor | Explanation::AnotherMoment => Some(format!(
            "the tests support \"{}\", by which t_O - M is not the friction and inertia of the balls alone",
            explanation.name()
        )),
        Explanation::Rolling | Explanation::IsothermalSlip | Explanation::HeatedSlip => None,
    }
}

/// What a conclusion says against the reading of the torque as such.
pub(crate) fn false_reading(conclusion: &Conclusion) -> Option<String> {
    let sensor = Explanation::Sensor;
    (*conclusion == Conclusion::Supported(sensor)).then(|| {
        format!(
            "the tests support \"{}\": the reading is not the torque on the outer race alone",
            sensor.name()
        )
    })
}

/// Whether a conclusion leaves slip of the balls open, or says that they slip.
pub(crate) fn slip_is_open(conclusion: &Conclusion) -> bool {
    match conclusion {
        Conclusion::Supported(explanation) => slips(*explanation),
        Conclusion::Undecided(left) => left.iter().copied().any(slips),
        Conclusion::NoneOfThese => true,
    }
}

pub(crate) fn slips(explanation: Explanation) -> bool {
    matches!(
        explanation,
        Explanation::IsothermalSlip | Explanation::HeatedSlip
    )
}

/// Probability from which on a cage signal shows that the balls slip.
const SHOWN: f64 = 0.5;

/// What speaks for oil that warms while the balls roll, where the conclusion is slip with heating: no explanation describes that.
///
/// - `slipped`: of each test with a cage signal that can show it, the probability that its cage slipped
pub(crate) fn oil_may_warm(conclusion: &Conclusion, slipped: &[f64]) -> Option<String> {
    let heated = Explanation::HeatedSlip;
    let named = match conclusion {
        Conclusion::Supported(explanation) => *explanation == heated,
        Conclusion::Undecided(left) => left.contains(&heated),
        Conclusion::NoneOfThese => false,
    };
    let most = slipped.iter().copied().fold(0.0, f64::max);
    if !named || most > SHOWN {
        return None;
    }
    let cage = match slipped {
        [] => "no test shows its cage".to_string(),
        _ => format!("no cage shows a slip (with a probability of {most:.2} at most)"),
    };
    Some(format!(
        "\"{}\" may be balls that roll in oil that warms, which is none of the explanations: {cage}. Its heating is supported, its slip is \
         not; a test at half the speed and one after 20 s at rest tell heat from the rest",
        heated.name()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_with_heating_that_no_cage_shows_may_be_warm_oil() {
        let heated = Explanation::HeatedSlip;
        let supported = Conclusion::Supported(heated);
        let open = Conclusion::Undecided(vec![Explanation::Sensor, heated]);
        for conclusion in [&supported, &open] {
            assert!(
                oil_may_warm(conclusion, &[0.01, 0.2])
                    .unwrap()
                    .contains("0.20 at most")
            );
            assert!(
                oil_may_warm(conclusion, &[])
                    .unwrap()
                    .contains("no test shows its cage")
            );
            assert_eq!(oil_may_warm(conclusion, &[0.01, 0.99]), None);
        }
        let grease = Conclusion::Supported(Explanation::Grease);
        assert_eq!(oil_may_warm(&grease, &[0.01]), None);
        assert_eq!(oil_may_warm(&Conclusion::NoneOfThese, &[0.01]), None);
    }

    #[test]
    fn what_is_explained_otherwise_is_not_friction_of_balls() {
        for explanation in Explanation::ALL {
            let cause = other_cause(&Conclusion::Supported(explanation));
            let other = matches!(
                explanation,
                Explanation::Grease | Explanation::Sensor | Explanation::AnotherMoment
            );
            assert_eq!(cause.is_some(), other, "{}", explanation.name());
            assert!(cause.is_none_or(|why| why.contains(explanation.name())));
            // a false reading says nothing of energy, a slip leaves the end of the spin-up open
            let supported = Conclusion::Supported(explanation);
            let sensor = explanation == Explanation::Sensor;
            assert_eq!(false_reading(&supported).is_some(), sensor);
            let slip = explanation.name().contains("slip");
            assert_eq!(slip_is_open(&supported), slip, "{}", explanation.name());
        }
        let left = Conclusion::Undecided(Explanation::ALL.to_vec());
        assert_eq!(other_cause(&left), None);
        assert_eq!(other_cause(&Conclusion::NoneOfThese), None);
        assert!(slip_is_open(&left) && slip_is_open(&Conclusion::NoneOfThese));
        let rolls = vec![Explanation::Rolling, Explanation::Grease];
        assert!(!slip_is_open(&Conclusion::Undecided(rolls)));
    }
}
