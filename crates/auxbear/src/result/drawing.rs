//! What the page needs to draw a rotor to scale, as lists.

use crate::result::list::{List, Origin};
use crate::result::outcome::Value;
use crate::scenario::RotorModel;
use rotor::Place;

/// What the scenario says.
pub(crate) const GIVEN: Origin = Origin {
    law: "",
    source: "the scenario",
    valid: "",
};

/// Positions, diameters and names of all parts.
pub(crate) fn name(list: &mut List, model: &RotorModel) {
    let rotor = &model.rotor;
    let z = |node: usize| rotor.nodes[node];
    let mut numbers = |name: &str, unit, values: Vec<f64>| {
        list.push(name, unit, Value::List(values), &GIVEN);
    };
    numbers("node_positions", "m", rotor.nodes.clone());
    let layers = || model.pieces.iter().map(|piece| &piece.layer);
    for (name, value) in [
        ("piece_starts", (|l| l.from) as fn(&rotor::Layer) -> f64),
        ("piece_ends", |l| l.to),
        ("piece_outer_starts", |l| l.start.outer),
        ("piece_outer_ends", |l| l.end.outer),
        ("piece_inner_starts", |l| l.start.inner),
        ("piece_inner_ends", |l| l.end.inner),
    ] {
        numbers(name, "m", layers().map(value).collect());
    }
    let carries = layers().map(|l| f64::from(u8::from(l.carries)));
    numbers("piece_carries", "1", carries.collect());
    numbers(
        "disk_positions",
        "m",
        rotor.disks.iter().map(|d| z(d.node)).collect(),
    );
    numbers(
        "disk_masses",
        "kg",
        rotor.disks.iter().map(|d| d.mass).collect(),
    );
    // zero: not given, to be drawn by its mass
    let sizes = || model.disk_sizes.iter();
    let diameters = sizes().map(|size| size.0.unwrap_or_default());
    numbers("disk_diameters", "m", diameters.collect());
    let widths = sizes().map(|size| size.1.unwrap_or_default());
    numbers("disk_widths", "m", widths.collect());
    for (name, seal) in [("support_positions", false), ("seal_positions", true)] {
        let places = rotor.supports.iter().filter(|support| support.seal == seal);
        let at = places.filter_map(|support| match support.at {
            Place::Node(node) => Some(z(node)),
            Place::Housing(_) => None,
        });
        numbers(name, "m", at.collect());
    }
    numbers(
        "mass_positions",
        "m",
        rotor.masses.iter().map(|m| z(m.node)).collect(),
    );
    let masses = rotor.masses.iter().map(|m| m.mass);
    numbers("point_masses", "kg", masses.collect());
    let unbalance = rotor.unbalance.iter().map(|u| z(u.node));
    numbers("unbalance_positions", "m", unbalance.collect());
    let named = model.nodes.iter().map(|(_, node)| z(*node));
    numbers("named_node_positions", "m", named.collect());
    let magnets = || model.levitation.iter().flat_map(|own| &own.magnets);
    numbers("magnet_positions", "m", magnets().map(|m| z(m.1)).collect());
    numbers("sensor_positions", "m", magnets().map(|m| z(m.2)).collect());
    let mut text = |name: &str, words: Vec<String>| {
        list.push(name, "", Value::Text(words.join("\n")), &GIVEN);
    };
    text(
        "piece_materials",
        model.pieces.iter().map(|p| p.material.clone()).collect(),
    );
    text(
        "piece_names",
        model.pieces.iter().map(|p| p.name.clone()).collect(),
    );
    text("disk_names", model.disks.clone());
    text("unbalance_names", model.unbalance.clone());
    text(
        "named_node_names",
        model.nodes.iter().map(|n| n.0.clone()).collect(),
    );
    text("magnet_names", magnets().map(|m| m.0.clone()).collect());
    let supports = |seal: bool| {
        let all = model.supports.iter().zip(&rotor.supports);
        let own = all.filter(|(_, s)| s.seal == seal && matches!(s.at, Place::Node(_)));
        own.map(|(name, _)| name.clone()).collect()
    };
    text("support_names", supports(false));
    text("seal_names", supports(true));
}
