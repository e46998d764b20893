//! What the page needs to draw a rotor to scale, as lists.

use crate::rotor::RotorModel;
use outcome::list::results;
use outcome::list::{List, origins};
use rotor::{Layer, Place};
use scenario::rotor::{Disk, FlexibleRotor, Unbalance};

origins! {
    /// What the scenario says.
    pub GIVEN: law "",
        source "the scenario",
        valid "";
    BALANCE: law "U = G m/Ω at the rated speed, shared by the levers of the mass centre",
        source "ISO 21940-11 (from memory); crates/physics/src/unbalance.rs",
        valid "a permissible value: a rotor may have less, and in other directions";
}

/// Positions, diameters and names of all parts; of auxiliary bearings on housings which, and where.
pub fn name(list: &mut List, model: &RotorModel, bearings: &[(usize, f64)]) {
    parts(list, model, Some(&Drawn(model, bearings)));
    let balanced = |at: f64| (model.balance_planes.iter()).any(|own| own.at.contains(&at));
    for plane in model.unbalance.iter().filter(|own| balanced(own.at)) {
        list.named(&[&plane.name], |list| balance(list, plane, Some(plane)));
    }
}

results! {
    fn parts(model: &RotorModel, run: &Drawn) {
        "node_positions": list "m", GIVEN, "positions of the nodes" in nodes "place" => run.rotor.nodes.clone();
        "piece_starts": list "m", GIVEN, "where each piece of the shaft begins" in pieces "start" => run.over_pieces(|l| l.from);
        "piece_ends": list "m", GIVEN, "where each piece ends" in pieces "end" => run.over_pieces(|l| l.to);
        "piece_outer_starts": list "m", GIVEN, "outer diameter of each piece where it begins" in pieces "outer start" => run.over_pieces(|l| l.start.outer);
        "piece_outer_ends": list "m", GIVEN, "outer diameter of each piece where it ends" in pieces "outer end" => run.over_pieces(|l| l.end.outer);
        "piece_inner_starts": list "m", GIVEN, "inner diameter of each piece where it begins" in pieces "inner start" => run.over_pieces(|l| l.start.inner);
        "piece_inner_ends": list "m", GIVEN, "inner diameter of each piece where it ends" in pieces "inner end" => run.over_pieces(|l| l.end.inner);
        "piece_carries": list "1", GIVEN, "1 for a piece that bends with the shaft, else 0" in pieces "carries" => run.over_pieces(|l| f64::from(u8::from(l.carries)));
        "disk_positions": list "m", GIVEN, "positions of the disks" in disks "place" => run.at(run.rotor.disks.iter().map(|disk| disk.node));
        "disk_masses": list "kg", GIVEN, "masses of the disks" in disks "mass" => run.rotor.disks.iter().map(|disk| disk.mass).collect::<Vec<_>>();
        "disk_diameters": list "m", GIVEN, "diameters of the disks, 0 where not given" in disks "diameter" => run.over_disks(|disk| disk.outer_diameter);
        "disk_widths": list "m", GIVEN, "widths of the disks, 0 where not given" in disks "width" => run.over_disks(|disk| disk.width);
        "support_positions": list "m", GIVEN, "positions of the supports" in supports "place" => run.at(run.on_nodes(false).map(|(_, node)| node));
        "seal_positions": list "m", GIVEN, "positions of the seals" in seals "place" => run.at(run.on_nodes(true).map(|(_, node)| node));
        "mass_positions": list "m", GIVEN, "positions of the point masses" in masses "place" => run.at(run.rotor.masses.iter().map(|mass| mass.node));
        "point_masses": list "kg", GIVEN, "point masses" in masses "mass" => run.rotor.masses.iter().map(|mass| mass.mass).collect::<Vec<_>>();
        "unbalance_positions": list "m", GIVEN, "positions of the unbalances" in unbalances "place" => run.at(run.rotor.unbalance.iter().map(|unbalance| unbalance.node));
        "named_node_positions": list "m", GIVEN, "positions of the named nodes" in named_places "place" => run.at(run.named.iter().copied());
        "magnet_positions": list "m", GIVEN, "positions of the magnets" in magnets "place" => run.at(run.magnets().map(|(_, magnet, _)| *magnet));
        "sensor_positions": list "m", GIVEN, "positions of their sensors" in sensors "place" => run.at(run.magnets().map(|(_, _, sensor)| *sensor));
        "housed_positions": list "m", GIVEN, "positions of what stands on housings" in housed "place" => run.housed().map(|own| own.1).collect::<Vec<_>>();
        "housed_on": text "", GIVEN, "the housing of each" in housed "name" => lines(run.housed().map(|own| own.0));
        "piece_materials": text "", GIVEN, "materials of the pieces" in pieces "material" => lines(run.pieces.iter().map(|piece| &piece.material));
        "piece_names": text "", GIVEN, "names of the pieces" in pieces "name" => lines(run.pieces.iter().map(|piece| &piece.name));
        "disk_names": text "", GIVEN, "names of the disks" in disks "name" => lines(run.disks.iter().map(|disk| &disk.name));
        "unbalance_names": text "", GIVEN, "names of the unbalances" in unbalances "name" => lines(run.unbalance.iter().map(|plane| &plane.name));
        "named_node_names": text "", GIVEN, "names of the named nodes" in named_places "name" => lines(run.nodes.iter().map(|node| &node.name));
        "magnet_names": text "", GIVEN, "names of the magnets" in magnets "name" in sensors "name" => lines(run.magnets().map(|(name, _, _)| name));
        "support_names": text "", GIVEN, "names of the supports" in supports "name" => lines(run.on_nodes(false).map(|(name, _)| name));
        "seal_names": text "", GIVEN, "names of the seals" in seals "name" => lines(run.on_nodes(true).map(|(name, _)| name));
    }
}

results! {
    fn balance(plane: &Unbalance, run: &Unbalance) {
        "balance.*.amount": number "kg m", BALANCE, "residual unbalance of this plane by rotor.balance_grade" => run.amount;
        "balance.*.phase": number "rad", BALANCE, "its angle on the rotor, drawn from repeat.seed" => run.phase;
    }
}

fn lines<'a>(names: impl Iterator<Item = &'a String>) -> String {
    names.map(String::as_str).collect::<Vec<_>>().join("\n")
}

/// A rotor as it is drawn.
struct Drawn<'a>(&'a RotorModel, &'a [(usize, f64)]);

impl std::ops::Deref for Drawn<'_> {
    type Target = RotorModel;

    fn deref(&self) -> &RotorModel {
        self.0
    }
}

impl Drawn<'_> {
    /// A value of each piece of the shaft.
    fn over_pieces(&self, value: fn(&Layer) -> f64) -> Vec<f64> {
        let layers = self.pieces.iter().map(|piece| &piece.layer);
        layers.map(value).collect()
    }

    /// A diameter or width of each disk, m; 0, to be drawn by its mass, where it is not given.
    fn over_disks(&self, size: fn(&Disk) -> Option<f64>) -> Vec<f64> {
        let sizes = self.disks.iter().map(size);
        sizes.map(Option::unwrap_or_default).collect()
    }

    /// Positions of nodes, m.
    fn at(&self, nodes: impl Iterator<Item = usize>) -> Vec<f64> {
        nodes.map(|node| self.rotor.nodes[node]).collect()
    }

    fn magnets(&self) -> impl Iterator<Item = &(String, usize, usize)> {
        self.levitation.iter().flat_map(|own| &own.magnets)
    }

    /// What stands on housings: the name of its housing, and where, m.
    fn housed(&self) -> impl Iterator<Item = (&String, f64)> {
        let mounts = self.supports.iter().filter(|own| own.at.is_none());
        let names: Vec<&String> = mounts.map(|own| &own.name).collect();
        let supports = self
            .supports
            .iter()
            .filter_map(|own| Some((own.on?, own.at?)));
        let given: &FlexibleRotor = self.0;
        let magnets = given.levitation.iter().flat_map(|own| &own.magnets);
        let magnets = magnets.filter_map(|own| Some((own.on?, own.at)));
        let all = self.1.iter().copied().chain(magnets).chain(supports);
        all.map(move |(on, at)| (names[on], at))
    }

    /// Names and nodes of supports, or of seals, that stand on a node.
    fn on_nodes(&self, seal: bool) -> impl Iterator<Item = (&String, usize)> {
        let all = self.supports.iter().zip(&self.rotor.supports);
        let own = all.filter(move |(_, support)| support.seal == seal);
        own.filter_map(|(given, support)| match support.at {
            Place::Node(node) => Some((&given.name, node)),
            Place::Housing(_) => None,
        })
    }
}
