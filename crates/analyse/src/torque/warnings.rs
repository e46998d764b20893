//! What the user should know before trusting the moments of a bearing.

use crate::torque::request::{Request, law_of};
use outcome::Warning;
use physics::friction::Friction;
use physics::friction_range::{OperatingPoint, farthest};
use scenario::{BearingType, LubricantWarning, Moment, Scenario, drawn_on};
use simulate::assumptions::{AssumptionWarning, assumptions, bath, constants, law_range};

problem::warnings! {
    /// Of the moments of a bearing.
    pub enum TorqueWarning {
        NotCompared { law: text, why: words } "AB1022" Note ("The law {law} is not compared: {why}.");
        NoMoment { lubricant: text, first: words, more: words } "AB1023" Note ("No moment with {lubricant} everywhere: {first}{more}.");
    }
}

/// All warnings, the most severe first.
pub(crate) fn of(scenario: &Scenario, asked: &Request) -> Vec<Warning> {
    let torque = asked.torque;
    let mut list = Vec::new();
    if torque.moment == Moment::None {
        list.push(AssumptionWarning::NoMomentShown.into());
    }
    list.extend(departures(asked, &asked.law, ""));
    list.extend(constants(scenario, "", &torque.moment, &torque.rated()));
    for compared in &torque.laws {
        let law = compared.moment.clone();
        match law.and_then(|moment| law_of(torque, &moment)) {
            Ok(law) if law != asked.law => {
                let moment = compared.moment.as_ref().ok();
                list.extend(moment.and_then(|moment| bath(moment, &torque.rated())));
                list.extend(departures(asked, &law, &format!(" ({})", compared.law)));
            }
            Ok(_) => {}
            Err(why) => {
                let law = compared.law.to_string();
                list.push(TorqueWarning::NotCompared { law, why }.into());
            }
        }
    }
    for lubricant in &torque.lubricants {
        let running = [torque.temperature].into_iter();
        let all = running.chain(torque.temperatures.iter().copied().map(Some));
        let unknown: Vec<String> = all.filter_map(|at| lubricant.at(at).err()).collect();
        if let Some(first) = unknown.first() {
            let more = match unknown.len() {
                1 => String::new(),
                several => format!(" ({several} temperatures in all)"),
            };
            let (lubricant, first) = (lubricant.name.clone(), first.clone());
            let warning = TorqueWarning::NoMoment {
                lubricant,
                first,
                more,
            };
            list.push(warning.into());
        }
    }
    list.extend(torque.lubricants.iter().filter_map(|lubricant| {
        let (oil, temperature) = lubricant.farthest(torque)?;
        let how = drawn_on(&oil, temperature);
        let lubricant = lubricant.name.clone();
        Some(LubricantWarning::DrawnOf { lubricant, how }.into())
    }));
    if let Some(limit) = torque.limiting_speed
        && torque.speed_to > limit
    {
        let factor = torque.speed_to / limit;
        list.push(AssumptionWarning::LargestOverspeed { factor, limit }.into());
    }
    if torque.kind != BearingType::DeepGroove {
        list.push(AssumptionWarning::DeepGrooveMotion.into());
    }
    let assumed = scenario.resolved.values.iter();
    let assumed = assumed.filter(|value| value.provenance.mark() == "assumed");
    list.extend(assumptions(
        &assumed.map(|value| value.path).collect::<Vec<_>>(),
    ));
    list
}

/// Where a law is left between the least and the largest speed and load: each quantity once.
fn departures(asked: &Request, law: &Friction<f64>, which: &str) -> Vec<Warning> {
    let torque = asked.torque;
    let speeds = [torque.speed_to, torque.speed, torque.speed_from];
    let points = torque.loads.iter().flat_map(|&radial_load| {
        speeds.map(|speed| OperatingPoint {
            speed,
            radial_load,
            axial_load: torque.moment.axial_load(),
        })
    });
    law_range(which, &farthest(points.flat_map(|at| law.departures(&at))))
}
