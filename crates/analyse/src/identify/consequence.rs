//! What follows from a verdict for the other results.

use identify::explain::{Conclusion, Explanation};

/// What a conclusion names as the cause of t_O - M, where that is neither friction nor inertia of the balls.
pub(crate) fn other_cause(conclusion: &Conclusion) -> Option<String> {
    let Conclusion::Supported(explanation) = conclusion else {
        return None;
    };
    match explanation {
        Explanation::Grease
        | Explanation::Sensor
        | Explanation::WarmOil
        | Explanation::AnotherMoment => Some(format!(
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

/// Whether a conclusion says that the balls roll.
pub(crate) fn rolls(conclusion: &Conclusion) -> bool {
    matches!(conclusion, Conclusion::Supported(one) if !slips(*one) && *one != Explanation::Sensor)
}

pub(crate) fn slips(explanation: Explanation) -> bool {
    matches!(
        explanation,
        Explanation::IsothermalSlip | Explanation::HeatedSlip
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_explained_otherwise_is_not_friction_of_balls() {
        for explanation in Explanation::ALL {
            let cause = other_cause(&Conclusion::Supported(explanation));
            let other = matches!(
                explanation,
                Explanation::Grease
                    | Explanation::Sensor
                    | Explanation::WarmOil
                    | Explanation::AnotherMoment
            );
            assert_eq!(cause.is_some(), other, "{}", explanation.name());
            assert!(cause.is_none_or(|why| why.contains(explanation.name())));
            // a false reading says nothing of energy, a slip leaves the end of the spin-up open
            let supported = Conclusion::Supported(explanation);
            let sensor = explanation == Explanation::Sensor;
            assert_eq!(false_reading(&supported).is_some(), sensor);
            let slip = explanation.name().contains("slip");
            assert_eq!(slip_is_open(&supported), slip, "{}", explanation.name());
            assert_eq!(rolls(&supported), !slip && !sensor);
        }
        let left = Conclusion::Undecided(Explanation::ALL.to_vec());
        assert_eq!(other_cause(&left), None);
        assert_eq!(other_cause(&Conclusion::NoneOfThese), None);
        assert!(slip_is_open(&left) && slip_is_open(&Conclusion::NoneOfThese));
        let rolls = vec![Explanation::Rolling, Explanation::Grease];
        assert!(!slip_is_open(&Conclusion::Undecided(rolls)));
    }
}
