//! Named results of one test with acceleration.

use crate::analyse::identify::found::TestFound;
use crate::result::list::{List, Origin};
use crate::result::outcome::Value;
use identify::Measurement;
use identify::loss::Loss;
use identify::slip::Established;
use physics::rolling::RollingSet;
use physics::spin_up_energy::SpinUpEnergy;
use statistics::uncertain::Uncertain;

/// Names the results of one test; those of the cage where its channel is given.
pub(crate) fn name(
    list: &mut List,
    number: usize,
    test: &TestFound,
    set: &RollingSet<f64>,
    cage: bool,
) {
    let named = |name: &str| format!("test_{number}.{name}");
    let m = &test.measurement;
    list.push(&named("name"), "", Value::Text(test.name.clone()), &TEST);
    list.number(&named("radial_load"), "N", Ok(m.load), &TEST);
    list.number(
        &named("engagement_time"),
        "s",
        m.engagement
            .ok_or_else(|| "no quick change was found".to_string()),
        &ENGAGED,
    );
    uncertain(
        list,
        &named("peak_acceleration"),
        "rad/s^2",
        Ok(test.peak_acceleration),
        &TEST,
    );
    torques(list, &named, test);
    rolling_up(list, &named, test, set);
    energies(list, &named, test);
    if cage {
        slip(list, &named, test);
    }
    skid(list, &named, test);
}

/// A value with its standard deviation under the same name.
pub(crate) fn uncertain(
    list: &mut List,
    name: &str,
    unit: &'static str,
    value: Result<Uncertain, String>,
    origin: &Origin,
) {
    list.number(name, unit, value.clone().map(|u| u.value), origin);
    list.number(
        &format!("{name}_deviation"),
        unit,
        value.map(|u| u.deviation),
        origin,
    );
}

fn torques(list: &mut List, named: &dyn Fn(&str) -> String, test: &TestFound) {
    let loss = test.loss.as_ref().map_err(Clone::clone);
    type Part = fn(&Loss, &Measurement) -> Option<Uncertain>;
    for (name, part, lacking) in [
        (
            "excess_torque_settled",
            Loss::settled_excess as Part,
            "no engagement was found, or t_O - M is not known 0.2 to 0.4 s after it",
        ),
        (
            "excess_torque_at_end",
            Loss::excess_at_end,
            "the test does not hold its full speed long enough, or t_O - M is not known there",
        ),
    ] {
        let unknown = || lacking.to_string();
        let value =
            (loss.clone()).and_then(|loss| part(loss, &test.measurement).ok_or_else(unknown));
        uncertain(list, &named(name), "N m", value, &EXCESS);
    }
}

/// Net torque that would bring balls and cage to rolling speed within the time in which the source paper's torque fell, s.
const FALL: f64 = 3.5;

fn rolling_up(
    list: &mut List,
    named: &dyn Fn(&str) -> String,
    test: &TestFound,
    set: &RollingSet<f64>,
) {
    let rolling = SpinUpEnergy {
        set: *set,
        final_speed: test.measurement.fastest(),
        outer_moment_work: 0.0,
    };
    let torque = rolling.final_angular_momentum() / FALL;
    list.number(
        &named("torque_to_roll_within_3_5_s"),
        "N m",
        Ok(torque),
        &ROLLING_UP,
    );
}

fn energies(list: &mut List, named: &dyn Fn(&str) -> String, test: &TestFound) {
    let found = test.energy();
    let none = || "without a cage signal over the whole spin-up".to_string();
    uncertain(
        list,
        &named("dissipated_energy"),
        "J",
        test.best_energy(),
        &ENERGY,
    );
    for (name, pick) in [
        (
            "dissipated_energy_printed",
            (|d| Some(d.printed)) as fn(&identify::dissipation::Dissipation) -> Option<Uncertain>,
        ),
        ("dissipated_energy_corrected", |d| Some(d.corrected)),
        ("dissipated_energy_exact", |d| d.exact),
        ("dissipated_energy_without_cage", |d| Some(d.without_cage)),
    ] {
        let value = found.clone().and_then(|d| pick(d).ok_or_else(none));
        uncertain(list, &named(name), "J", value, &ENERGY);
    }
    list.number(
        &named("dissipation_until"),
        "s",
        (test.dissipation.as_ref().map_err(Clone::clone))
            .map(|d| d.window.1 - test.measurement.begin()),
        &UNTIL,
    );
    list.push(
        &named("printed_form"),
        "",
        match &found {
            Ok(found) => Value::Text(found.printed_verdict()),
            Err(why) => Value::None { why: why.clone() },
        },
        &ENERGY,
    );
}

fn slip(list: &mut List, named: &dyn Fn(&str) -> String, test: &TestFound) {
    let slip = test.slip.as_ref().map_err(Clone::clone);
    list.number(
        &named("slip_probability"),
        "1",
        slip.clone().and_then(|slip| {
            slip.slipped.ok_or_else(|| {
                "the band of the slip is wider than its limit throughout".to_string()
            })
        }),
        &SLIP,
    );
    list.number(
        &named("rolling_established_at"),
        "s",
        slip.and_then(|slip| match slip.established {
            Established::At { time, .. } => Ok(time - test.measurement.begin()),
            Established::Throughout => {
                Err("as far as the signal shows, the cage never slipped".to_string())
            }
            Established::Never => Err("not before the record ends".to_string()),
        }),
        &ROLLS,
    );
}

fn skid(list: &mut List, named: &dyn Fn(&str) -> String, test: &TestFound) {
    list.number(
        &named("skid_probability"),
        "1",
        match test.withheld() {
            None if test.rolls => {
                Err("the balls roll throughout, as it is stated or the tests support".to_string())
            }
            Some(why) => Err(format!(
                "{why}, and a torque that is low for another reason looks like skid"
            )),
            None => test.skid.as_ref().map_err(Clone::clone).and_then(|skid| {
                skid.skidded
                    .ok_or_else(|| "torque and cage do not show the spin of the balls".to_string())
            }),
        },
        &SKID,
    );
}

const TEST: Origin = Origin {
    law: "as measured by the signals of the test",
    source: "Bierman 1977 (filter and smoother), crates/measure/src/speed/mod.rs",
    valid: "see auxbear signals of its file",
};
const ENGAGED: Origin = Origin {
    law: "when the quick change of the speed begins, in the time of the file; other times of a test count from here",
    source: "Bierman 1977 (filter and smoother), crates/measure/src/speed/mod.rs",
    valid: "see auxbear signals of its file",
};
const EXCESS: Origin = Origin {
    law: "mean of t_O - M, 0.2 to 0.4 s after the engagement, or over the last 0.5 s at full speed",
    source: "crates/identify/src/loss/mod.rs",
    valid: "the deviation is that of one value: errors close in time are shared",
};
const ROLLING_UP: Origin = Origin {
    law: "L0/3.5 s, L0 = R² Ω0 [N m_b (½ + 0.3 s) + ½ m_c (1+s)]: net torque that brings balls and cage to rolling speed in the time in which the source paper's torque fell",
    source: "crates/physics/src/spin_up_energy.rs",
    valid: "compare it with the fall of the torque: balls that still speed up would need traction and drag to agree this closely",
};
const ENERGY: Origin = Origin {
    law: "D = ∫t_O Ω dt + ∫Ω dL - Δ(KE + U) with a cage signal; (21) as printed, corrected; without a cage signal the corrected form where rolling is stated or the verdict, else the middle of a range: of balls that roll at the end, or of any slip where the verdict does not exclude it",
    source: "the source paper, (21), and its correction; crates/identify/src/dissipation.rs",
    valid: "from the engagement until the final speed is reached",
};
const UNTIL: Origin = Origin {
    law: "when 99 % of the largest speed is reached, counted from the engagement",
    source: "crates/identify/src/dissipation.rs",
    valid: "engagement_time is in the time of the file",
};
const ROLLS: Origin = Origin {
    law: "from when on |S| above 1 % stays less likely than not, counted from the engagement",
    source: "Harris 2001, section 8 (kinematics), crates/identify/src/slip.rs",
    valid: "needs a cage signal; engagement_time is in the time of the file",
};
const SLIP: Origin = Origin {
    law: "S = 1 - 2(1+s)ω_c/Ω; the largest probability of |S| above 1 % at any time",
    source: "Harris 2001, section 8 (kinematics), crates/identify/src/slip.rs",
    valid: "needs a cage signal",
};
const SKID: Origin = Origin {
    law: "spin of the balls from (4), (5), (7) with F ≥ 0",
    source: "the source paper, (4), (5) and (7); crates/identify/src/skid.rs",
    valid: "shortly after the engagement, as long as the torque shows it, with the lubricant in the state of the slow tests: a grease that starts low looks like skid",
};
