//! What the user should know of an analysis of a rotor.

use crate::rotor::asked::{Asked, Found};
use crate::rotor::levitated;
use outcome::{Warning, warning};
use simulate::drop::shaft_results::against_spin;
use units::number_text;

/// Error of eigenvalues in the reduced coordinates from which a warning is given.
const REDUCTION: f64 = 1e-5;

pub(crate) fn of(asked: &Asked, found: &Found) -> Vec<Warning> {
    let analysis = &asked.analysis;
    let mut out: Vec<Warning> = (asked.levitated.iter())
        .flat_map(|own| levitated::warned(analysis, own))
        .collect();
    let all = analysis.model.supports.iter().zip(&asked.rotor().supports);
    for (name, support) in all {
        let Some((low, high)) = support.coefficients.range() else {
            continue;
        };
        if analysis.speed_from < low || analysis.speed_to > high {
            out.push(warning(
                "AB2020",
                format!(
                    "The table of {name} goes from {} to {} rad/s, the diagrams from {} to {} rad/s: beyond the table its \
                     coefficients stay what they are at its ends.",
                    number_text(low),
                    number_text(high),
                    number_text(analysis.speed_from),
                    number_text(analysis.speed_to)
                ),
            ));
        }
    }
    if let Some(value) = found.growing {
        let (frequency, ratio) = (value.im.abs(), -value.re / value.norm());
        let text = match frequency > 0.01 * value.norm() {
            true => format!(
                "At the rated speed the mode of {frequency:.1} rad/s grows: its damping ratio is {ratio:.2e}. The rotor whirls until \
                 something that is not modelled here limits it."
            ),
            false => format!(
                "At the rated speed the rotor is pulled over: a motion grows with {:.6} 1/s and does not whirl. Negative stiffness \
                 exceeds that of shaft and supports, and the rotor has no position at rest.",
                value.re
            ),
        };
        out.push(warning("AB2021", text));
    } else if found.pulled_over {
        out.push(warning(
            "AB2042",
            "At rest the rotor is pulled over: negative stiffness exceeds that of shaft and supports, and gyroscopic moments alone hold it at \
             the rated speed. Sag and support loads do not exist."
                .to_string(),
        ));
    }
    if !found.unlisted.is_empty() {
        let speeds: Vec<String> = found
            .unlisted
            .iter()
            .map(|own| format!("{own:.2}"))
            .collect();
        out.push(warning(
            "AB2040",
            format!(
                "The response has a narrow peak at {} rad/s, and no critical speed is listed within its half width: the list may lack one. A \
                 verdict on the separation that is not \"fail\" is undecided.",
                speeds.join(", ")
            ),
        ));
    }
    if let Some([low, high]) = analysis.not_looked_at() {
        out.push(warning(
            "AB2043",
            format!(
                "Critical speeds and growth are looked for from {} to {} rad/s, and the operating speeds with their margin reach from {} to {} rad/s: \
                 analysis.speed_from and analysis.speed_to must take them in. A verdict on the separation that is not \"fail\" is undecided.",
                number_text(analysis.speed_from.round()),
                number_text(analysis.speed_to.round()),
                number_text(low.round()),
                number_text(high.round())
            ),
        ));
    }
    out.extend(against_spin(&analysis.model, analysis.speed));
    if let Some(error) = found.reduction_error.filter(|error| *error > REDUCTION) {
        out.push(warning(
            "AB2022",
            format!(
                "In the {} coordinates kept, eigenvalues are wrong by up to {error:.1e}. A higher \
                 analysis.cutoff keeps more.",
                asked.within.basis.len()
            ),
        ));
    }
    let (there, most) = (found.modes.len(), analysis.modes.most());
    if there < most {
        out.push(warning(
            "AB2025",
            format!(
                "{there} modes oscillate at the rated speed in the coordinates kept, and all are shown: fewer than the {most} of the default \
                 of analysis.modes. More elements give more."
            ),
        ));
    }
    if !asked.held {
        out.push(warning(
            "AB2023",
            "The rotor has no support: modes are those of the free rotor, and there is no sag, no response and no stiffness map."
                .to_string(),
        ));
    }
    out
}
