//! What the user should know of an analysis of a rotor.

use crate::rotor::request::{Analyses, Request};
use crate::rotor::{levitated, rolling, whirl};
use outcome::Warning;
use simulate::drop::shaft_results::against_spin;
use units::number_text;

problem::warnings! {
    /// Of an analysis of a rotor.
    pub enum RotorWarning {
        Table { support: text, low: "rad/s", high: "rad/s", from: "rad/s", to: "rad/s" } "AB2020" Uncertain
            ("The table of {support} goes from {} to {} rad/s, the diagrams from {} to {} rad/s: beyond the table its coefficients stay what they are at its ends.", number_text(low), number_text(high), number_text(from), number_text(to));
        Grows { frequency: "rad/s", damping_ratio: "1" } "AB2021" Invalid
            ("At the rated speed the mode of {frequency:.1} rad/s grows: its damping ratio is {damping_ratio:.2e}. The rotor whirls until something that is not modelled here limits it.");
        PulledOver { rate: "1/s" } "AB2021" Invalid
            ("At the rated speed the rotor is pulled over: a motion grows with {rate:.6} 1/s and does not whirl. Negative stiffness exceeds that of shaft and supports, and the rotor has no position at rest.");
        Reduction { coordinates: "", error: "1" } "AB2022" Uncertain
            ("In the {coordinates} coordinates kept, eigenvalues are wrong by up to {error:.1e}. A higher analysis.cutoff keeps more.");
        NoSupport "AB2023" Uncertain
            ("The rotor has no support: modes are those of the free rotor, and there is no sag, no response and no stiffness map.");
        FewModes { modes: "", wanted: "" } "AB2025" Note
            ("{modes} modes oscillate at the rated speed in the coordinates kept, and all are shown: fewer than the {wanted} of the default of analysis.modes. More elements give more.");
        UnlistedPeak { speeds: text } "AB2040" Invalid
            ("The response has a narrow peak at {speeds} rad/s, and no critical speed is listed within its half width: the list may lack one. A verdict on the separation that is not \"fail\" is undecided.");
        PulledOverAtRest "AB2042" Invalid
            ("At rest the rotor is pulled over: negative stiffness exceeds that of shaft and supports, and gyroscopic moments alone hold it at the rated speed. Sag and support loads do not exist.");
        SpeedRange { from: "rad/s", to: "rad/s", low: "rad/s", high: "rad/s" } "AB2043" Invalid
            ("Critical speeds and growth are looked for from {} to {} rad/s, and the operating speeds with their margin reach from {} to {} rad/s: analysis.speed_from and analysis.speed_to must take them in. A verdict on the separation that is not \"fail\" is undecided.", number_text(from.round()), number_text(to.round()), number_text(low.round()), number_text(high.round()));
        DryWhirl { friction: "1", needed: "1", frequency: "rad/s", force: "N", settling: words, cure: words } "AB2044" Destroys
            ("Dry backward whirl is possible: the friction coefficient {friction} exceeds the {} that whirl of {frequency:.0} rad/s needs. {settling}. {cure}.", number_text((needed * 1e4).round() / 1e4));
        NotInWhirl { parts: text } "AB2045" Uncertain
            ("The needed friction of dry whirl, and the support of the rotor that rolls, leave out what is not linear in the mount: {parts}. Their stiffness and damping are not in it.");
        NotRolling { why: words } "AB2050" Note
            ("The rotor was not analysed as it rolls on its auxiliary bearings: {why}.");
        LiftsOff { load: "N", speeds: text } "AB2051" Uncertain
            ("While the rotor rolls, the force of its unbalance exceeds its weight of {load:.1} N on a row at {speeds} rad/s: it lifts off, and the linear answer does not hold there.");
        SwingsFar { speeds: text } "AB2051" Uncertain
            ("While the rotor rolls, its unbalance drives it more than half a clearance up the bore at {speeds} rad/s: the linear answer does not hold there. How far it goes depends on damping and on the time that the coast-down takes.");
        RollingRub { distance: "m", speed: "rad/s" } "AB2052" Destroys
            ("While the rotor rolls on its auxiliary bearings it reaches what stands around it: at {speed:.0} rad/s the clearance is exceeded by {:.4} mm.", -distance * 1e3);
        RollingGrows { from: "rad/s", to: "rad/s" } "AB2053" Invalid
            ("While the rotor rolls on its auxiliary bearings a motion grows from {from:.0} to {to:.0} rad/s: nothing in the linear model limits it, and there is no steady response.");
        RollingLimits "AB2054" Note
            ("Critical speeds on the auxiliary bearings hold for a rotor that rolls on them without leaving its races, by small motion about its position at rest, without friction. Across the weight it swings as a pendulum that nothing but the mount damps.");
        WhirlAveraged { supports: text } "AB2046" Uncertain
            ("Supports and seals that treat x and y differently ({supports}) count in dry whirl with their mean over a turn: its orbit is taken as a circle.");
        WhirlRange { to: "rad/s" } "AB2047" Uncertain
            ("The needed friction of dry whirl was looked at up to {to:.0} rad/s: faster whirl may need less. A higher analysis.whirl_to shows it.");
        WhirlLimits "AB2048" Note
            ("The needed friction of dry whirl holds for a circular orbit in full slip in one bearing alone, against a race that does not turn, with a linear mount and rigid balls. It says where whirl can live, not whether an impact starts it, and friction below it excludes this whirl alone.");
    }
}

/// Error of eigenvalues in the reduced coordinates from which a warning is given.
const REDUCTION: f64 = 1e-5;

pub(crate) fn of(asked: &Request, found: &Analyses) -> Vec<Warning> {
    let analysis = &asked.analysis;
    let mut out: Vec<Warning> = (asked.levitated.iter())
        .flat_map(|own| levitated::warned(&asked.model, analysis.speed, own))
        .collect();
    for support in &asked.model.supports {
        let Some((low, high)) = support.coefficients.range() else {
            continue;
        };
        if analysis.speed_from < low || analysis.speed_to > high {
            let warning = RotorWarning::Table {
                support: support.name.clone(),
                low,
                high,
                from: analysis.speed_from,
                to: analysis.speed_to,
            };
            out.push(warning.into());
        }
    }
    if let Some(value) = found.growing {
        let (frequency, damping_ratio) = (value.im.abs(), -value.re / value.norm());
        let warning = match frequency > 0.01 * value.norm() {
            true => RotorWarning::Grows {
                frequency,
                damping_ratio,
            },
            false => RotorWarning::PulledOver { rate: value.re },
        };
        out.push(warning.into());
    } else if found.pulled_over {
        out.push(RotorWarning::PulledOverAtRest.into());
    }
    if !found.unlisted.is_empty() {
        let speeds: Vec<String> = found
            .unlisted
            .iter()
            .map(|own| format!("{own:.2}"))
            .collect();
        let speeds = speeds.join(", ");
        out.push(RotorWarning::UnlistedPeak { speeds }.into());
    }
    if let Some([low, high]) = analysis.not_looked_at() {
        let (from, to) = (analysis.speed_from, analysis.speed_to);
        let warning = RotorWarning::SpeedRange {
            from,
            to,
            low,
            high,
        };
        out.push(warning.into());
    }
    out.extend(against_spin(&asked.model, analysis.speed));
    if let Some(error) = found.reduction_error.filter(|error| *error > REDUCTION) {
        let coordinates = asked.within.basis.len() as f64;
        out.push(RotorWarning::Reduction { coordinates, error }.into());
    }
    let (there, most) = (found.modes.len(), analysis.modes);
    if there < most {
        let (modes, wanted) = (there as f64, most as f64);
        out.push(RotorWarning::FewModes { modes, wanted }.into());
    }
    if let Some(model) = &asked.whirl {
        out.extend(whirl::results::warned(model, &found.whirl));
    }
    if let Some(model) = &asked.rolling {
        out.extend(rolling::results::warned(model, found.rolling.as_deref()));
    }
    if !asked.held {
        out.push(RotorWarning::NoSupport.into());
    }
    out
}
