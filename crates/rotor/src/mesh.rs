//! From pieces of a drawing to nodes and elements.
//!
//! A drawing lists pieces of shaft from one position to another; some lie over others. Nodes stand where a piece begins or
//! ends, where something is attached, and where a span would be longer than wanted.

use crate::Element;
use physics::shaft::{Layer, SAME_PLACE};

/// Nodes and elements.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Positions of the nodes, m.
    pub nodes: Vec<f64>,
    /// The elements, from left to right.
    pub elements: Vec<Element>,
}

/// Why there is no mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MeshError {
    /// Two layers (by index) fill the same place at this position, m.
    Conflict(usize, usize, f64),
    /// No layer that carries lies between these positions, m.
    Gap(f64, f64),
    /// This position, m, is not on the shaft.
    Outside(f64),
    /// There is no layer at all.
    Empty,
}

impl Mesh {
    /// The node at a position, m.
    #[must_use]
    pub fn node(&self, position: f64) -> Option<usize> {
        let node = self
            .nodes
            .iter()
            .position(|z| (z - position).abs() <= SAME_PLACE)?;
        Some(node)
    }
}

/// Nodes and elements of layers, with a node at each of `positions` (m).
///
/// # Errors
///
/// Where layers fill the same place, leave a gap, or a position is beside the shaft.
pub fn mesh(layers: &[Layer], positions: &[f64]) -> Result<Mesh, MeshError> {
    conflict(layers)?;
    let ends = layers.iter().flat_map(|layer| [layer.from, layer.to]);
    let marks = merged(ends.chain(positions.iter().copied()));
    let (Some(first), Some(last)) = (
        layers.iter().map(|l| l.from).reduce(f64::min),
        layers.iter().map(|l| l.to).reduce(f64::max),
    ) else {
        return Err(MeshError::Empty);
    };
    let beside = |z: &&f64| **z < first - SAME_PLACE || **z > last + SAME_PLACE;
    if let Some(outside) = positions.iter().find(beside) {
        return Err(MeshError::Outside(*outside));
    }
    let mut out = Mesh {
        nodes: vec![marks[0]],
        elements: Vec::new(),
    };
    for span in marks.windows(2) {
        let (from, to) = (span[0], span[1]);
        let covering: Vec<&Layer> = layers
            .iter()
            .filter(|layer| layer.from < to - SAME_PLACE && layer.to > from + SAME_PLACE)
            .collect();
        if !covering.iter().any(|layer| layer.carries) {
            return Err(MeshError::Gap(from, to));
        }
        let longest = covering.iter().map(|layer| layer.longest);
        let longest = longest.fold(f64::INFINITY, f64::min);
        // A span that is longer by rounding alone is not split.
        let pieces = ((to - from) / longest - 1e-9).ceil().max(1.0) as usize;
        for piece in 0..pieces {
            let at = |k: usize| from + (to - from) * k as f64 / pieces as f64;
            let (a, b) = (
                at(piece),
                if piece + 1 == pieces {
                    to
                } else {
                    at(piece + 1)
                },
            );
            let left = out.nodes.len() - 1;
            out.elements
                .extend(covering.iter().map(|layer| element(layer, left, a, b)));
            out.nodes.push(b);
        }
    }
    Ok(out)
}

/// A layer between two positions, as an element that begins at node `left`.
fn element(layer: &Layer, left: usize, from: f64, to: f64) -> Element {
    let at = |z: f64| {
        let share = (z - layer.from) / (layer.to - layer.from);
        layer.start.towards(&layer.end, share.clamp(0.0, 1.0))
    };
    Element {
        left,
        length: to - from,
        start: at(from),
        end: at(to),
        material: layer.material,
        carries: layer.carries,
        damping_of_mass: layer.damping_of_mass,
        damping_of_stiffness: layer.damping_of_stiffness,
        damping_rotating: layer.damping_rotating,
    }
}

/// Sorted, and those closer than one place to the one before left out.
fn merged(positions: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut sorted: Vec<f64> = positions.collect();
    sorted.sort_by(f64::total_cmp);
    let mut out: Vec<f64> = Vec::new();
    for z in sorted {
        if out.last().is_none_or(|last| z - last > SAME_PLACE) {
            out.push(z);
        }
    }
    out
}

/// Refuses layers whose material would be in the same place.
fn conflict(layers: &[Layer]) -> Result<(), MeshError> {
    for (i, a) in layers.iter().enumerate() {
        for (j, b) in layers.iter().enumerate().skip(i + 1) {
            let (from, to) = (a.from.max(b.from), a.to.min(b.to));
            if to - from <= SAME_PLACE {
                continue;
            }
            // Diameters are straight lines: layers apart at both ends on the same side are apart between them.
            let side = |z: f64| {
                let (p, q) = (element(a, 0, z, z).start, element(b, 0, z, z).start);
                let room = SAME_PLACE;
                (p.outer <= q.inner + room, q.outer <= p.inner + room)
            };
            let (left, right) = (side(from), side(to));
            if !(left.0 && right.0 || left.1 && right.1) {
                return Err(MeshError::Conflict(i, j, 0.5 * (from + to)));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Annulus, Material};

    fn layer(from: f64, to: f64, outer: f64, inner: f64) -> Layer {
        let section = Annulus { outer, inner };
        Layer {
            from,
            to,
            start: section,
            end: section,
            material: Material::new(206e9, 0.3, 7850.0),
            longest: f64::INFINITY,
            carries: true,
            damping_of_mass: 0.0,
            damping_of_stiffness: 0.0,
            damping_rotating: 0.0,
        }
    }

    #[test]
    fn nodes_stand_where_something_begins_and_spans_are_divided() {
        let mut first = layer(0.0, 0.3, 0.05, 0.0);
        first.longest = 0.1;
        let layers = [
            first,
            layer(0.3, 0.5, 0.04, 0.0),
            layer(0.1, 0.2, 0.08, 0.05),
        ];
        let mesh = mesh(&layers, &[0.4]).unwrap();
        let expected = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5];
        assert_eq!(mesh.nodes.len(), expected.len());
        assert!(
            mesh.nodes
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
        // five spans, one of them with a layer over it
        assert_eq!(mesh.elements.len(), 6);
        assert_eq!(mesh.elements.iter().filter(|e| e.left == 1).count(), 2);
        assert_eq!(mesh.node(0.4), Some(4));
        assert_eq!(mesh.node(0.45), None);
    }

    #[test]
    fn a_divided_taper_keeps_its_volume() {
        let mut whole = layer(0.0, 0.4, 0.10, 0.02);
        whole.end = Annulus {
            outer: 0.06,
            inner: 0.04,
        };
        let mass = |longest: f64| {
            let cut = mesh(&[Layer { longest, ..whole }], &[]).unwrap();
            let rotor = crate::Rotor {
                nodes: cut.nodes,
                elements: cut.elements,
                ..Default::default()
            };
            crate::properties(&rotor).mass
        };
        assert!((mass(0.4) / mass(0.03) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let solid = layer(0.0, 0.3, 0.05, 0.0);
        let over = |layer: Layer| mesh(&[solid, layer], &[]);
        assert!(matches!(
            over(layer(0.1, 0.2, 0.06, 0.04)),
            Err(MeshError::Conflict(0, 1, _))
        ));
        assert!(over(layer(0.1, 0.2, 0.06, 0.05)).is_ok());
        assert_eq!(
            over(layer(0.4, 0.5, 0.05, 0.0)),
            Err(MeshError::Gap(0.3, 0.4))
        );
        assert_eq!(mesh(&[solid], &[0.31]), Err(MeshError::Outside(0.31)));
        assert_eq!(mesh(&[], &[]), Err(MeshError::Empty));
        // A layer that only adds mass holds nothing together.
        let sleeve = Layer {
            carries: false,
            ..layer(0.3, 0.4, 0.05, 0.0)
        };
        assert_eq!(over(sleeve), Err(MeshError::Gap(0.3, 0.4)));
    }
}
