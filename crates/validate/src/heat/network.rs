//! A network of bodies: time constants, end temperatures, temperatures at times, energy.

use super::tally::{Allowed, Tally};
use crate::compare::told;
use crate::json::{exactly, list, within};
use serde_json::Value;
use thermal::network::{Ground, Link, Network};

/// Most bodies.
const MOST_NODES: usize = 200;
/// Capacities, conductances and times lie between its inverse and it.
const LARGEST: f64 = 1e13;

/// Compares a file.
pub(super) fn compare(file: &Value, tally: &mut Tally) -> Result<(), String> {
    let names = names(file)?;
    let n = names.len();
    let capacities = exactly(file, "capacity", n)?;
    let network = network(file, &names, &capacities, None)?;
    let (powers, start) = (exactly(file, "powers", n)?, exactly(file, "start", n)?);
    tally.place = "the network".to_string();
    let constants = exactly(file, "time_constants", n)?;
    for (reference, ours) in constants.iter().zip(network.time_constants()) {
        tally.add("time constants", "s", *reference, ours)?;
    }
    let end = network.steady(&powers);
    let end = end.ok_or("a part of the network has no ground: no steady state")?;
    for (reference, ours) in exactly(file, "steady", n)?.iter().zip(end) {
        tally.add("steady temperatures", "°C", *reference, ours)?;
    }
    for row in list(file, "rows")? {
        tally.row("a row of the network", row, |tally| {
            let time = within(row, "time", 0.0, LARGEST)?;
            tally.place = format!("at {time} s");
            let mut ours = start.clone();
            let given: f64 = network.advance(&mut ours, &powers, time).iter().sum();
            let references = exactly(row, "temperatures", n)?;
            for (reference, ours) in references.iter().zip(&ours) {
                tally.add("temperatures", "°C", *reference, *ours)?;
            }
            let put_in = powers.iter().sum::<f64>() * time;
            let end = network.stored(&ours);
            let size = end.abs() + powers.iter().map(|power| power.abs()).sum::<f64>() * time;
            let allowed = Allowed::size(tally.allowed()?.relative * size);
            let found = end - network.stored(&start) + given;
            tally.add_by("heat put in and found", "J", put_in, found, allowed);
            Ok(())
        })?;
    }
    Ok(())
}

pub(super) fn names(file: &Value) -> Result<Vec<&str>, String> {
    let mut names = Vec::new();
    for value in list(file, "nodes")? {
        let name = value.as_str().ok_or("a node has no name")?;
        if names.contains(&name) {
            return Err(format!("node {name} is there twice"));
        }
        names.push(name);
    }
    if (1..=MOST_NODES).contains(&names.len()) {
        Ok(names)
    } else {
        Err(format!("1 to {MOST_NODES} nodes are needed"))
    }
}

/// A node by its name.
pub(super) fn node(names: &[&str], value: &Value) -> Result<usize, String> {
    let found = names.iter().position(|name| value == name);
    found.ok_or_else(|| format!("{value} is no node"))
}

/// The network of a file or a case with these capacities: links by name, each ground with its temperature, or the one outside all.
pub(super) fn network(
    file: &Value,
    names: &[&str],
    capacities: &[f64],
    outside: Option<f64>,
) -> Result<Network, String> {
    let conductance = |value: &Value| {
        let number = value.as_f64().filter(|g| (0.0..=LARGEST).contains(g));
        number.ok_or_else(|| format!("conductance {value} is not 0 to {LARGEST}"))
    };
    let links = list(file, "links")?.iter().map(|link| {
        Ok(Link {
            nodes: [node(names, &link[0])?, node(names, &link[1])?],
            conductance: conductance(&link[2])?,
        })
    });
    let links = links.collect::<Result<Vec<_>, String>>()?;
    let grounds = list(file, "grounds")?.iter().map(|ground| {
        let own = || ground[2].as_f64().filter(|value| value.abs() <= LARGEST);
        Ok(Ground {
            node: node(names, &ground[0])?,
            conductance: conductance(&ground[1])?,
            temperature: outside.or_else(own).ok_or("a ground has no temperature")?,
        })
    });
    let grounds = grounds.collect::<Result<Vec<_>, String>>()?;
    let usual = 1.0 / LARGEST..=LARGEST;
    if !capacities.iter().all(|capacity| usual.contains(capacity)) {
        return Err(format!("a capacity is not {} to {LARGEST}", 1.0 / LARGEST));
    }
    Network::new(capacities, &links, &grounds).map_err(told)
}
