//! What the user should know before trusting the moments of a bearing.

use crate::torque::asked::{Asked, law_of};
use outcome::Warning;
use outcome::warning;
use physics::friction::Friction;
use physics::friction_range::{OperatingPoint, farthest};
use scenario::{BearingType, DRAWN_ON, Moment, Scenario, drawn_on};
use simulate::assumptions::{assumptions, bath, constants, law_range};

/// All warnings, the most severe first.
pub(crate) fn of(scenario: &Scenario, asked: &Asked) -> Vec<Warning> {
    let torque = asked.torque;
    let mut list = Vec::new();
    if torque.moment == Moment::None {
        list.push(warning(
            "AB1016",
            "The bearing has no friction moment (bearing.moment.law is none): only its inertia is shown."
                .to_string(),
        ));
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
            Err(why) => list.push(warning(
                "AB1022",
                format!("The law {} is not compared: {why}.", compared.law),
            )),
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
            list.push(warning(
                "AB1023",
                format!(
                    "No moment with {} everywhere: {first}{more}.",
                    lubricant.name
                ),
            ));
        }
    }
    list.extend(torque.lubricants.iter().filter_map(|lubricant| {
        let (oil, temperature) = lubricant.farthest(torque)?;
        let text = drawn_on(&oil, temperature);
        Some(warning(
            DRAWN_ON,
            format!(
                "The viscosity of {} is extrapolated: {text}.",
                lubricant.name
            ),
        ))
    }));
    if let Some(limit) = torque.limiting_speed
        && torque.speed_to > limit
    {
        list.push(warning(
            "AB1015",
            format!(
                "The largest speed is {:.1} times the limiting speed of the bearing ({:.0} rpm), which holds for continuous running.",
                torque.speed_to / limit,
                limit * 30.0 / std::f64::consts::PI
            ),
        ));
    }
    if torque.kind != BearingType::DeepGroove {
        list.push(warning(
            "AB1019",
            "Balls and cage are computed as those of a deep groove bearing: the contact angle reaches nothing but the friction law."
                .to_string(),
        ));
    }
    let assumed = scenario.resolved.values.iter();
    let assumed = assumed.filter(|value| value.provenance.mark() == "assumed");
    list.extend(assumptions(
        &assumed.map(|value| value.path).collect::<Vec<_>>(),
    ));
    list
}

/// Where a law is left between the least and the largest speed and load: each quantity once.
fn departures(asked: &Asked, law: &Friction<f64>, which: &str) -> Vec<Warning> {
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
