//! How hot a shoulder of the rotor and the face under it become where they rub: an observer, which changes nothing of the run.
//!
//! ```text
//!   friction power of the faces ──► layer of the shoulder, layer of the ring      both surfaces of one temperature
//! ```
//! The annulus touches as a whole: the rise is its mean, which an edge that touches first passes by far. Both faces of a bearing are one annulus here.
//!
//! Source: derived; book/src/theory/spatial.md. Assumes: insulated backs of both layers; the heat of steps by the powers at their ends.

use crate::system::sampling::Peak;
use thermal::layer::{Layer, LayerState};

/// A shoulder and a face.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceSurfaces {
    /// Layer of the shoulder, layer of the ring.
    pub layers: [Layer; 2],
    /// Area of the annulus, m².
    pub area: f64,
}

/// A span of heat over the time since the touch.
const SHARE: f64 = 0.05;
/// Longest span, s.
const LONGEST: f64 = 1e-4;

/// What has become of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceHeat {
    states: [LayerState; 2],
    /// Until when the layers are known, s, and the heat since, J.
    known: (f64, f64),
    /// Begin of this touch, s.
    touched: Option<f64>,
    /// Largest mean rise, K.
    pub rise: Peak,
}

impl FaceHeat {
    /// Takes the friction powers at both ends of a step, W.
    pub fn watch(
        &mut self,
        surfaces: &FaceSurfaces,
        [start, end]: [f64; 2],
        [before, after]: [f64; 2],
    ) {
        if before <= 0.0 && after <= 0.0 && self.touched.is_none() {
            return;
        }
        let touched = *self.touched.get_or_insert_with(|| {
            // what was touched before has cooled since
            let rested = start - self.known.0;
            for (layer, state) in surfaces.layers.iter().zip(&mut self.states) {
                layer.advance(state, &layer.half_step(rested), 0.0);
            }
            self.known = (start, 0.0);
            start
        });
        self.known.1 += 0.5 * (before + after) * (end - start);
        let span = end - self.known.0;
        if after > 0.0 && span < (SHARE * (end - touched)).min(LONGEST) {
            return;
        }
        let power = self.known.1 / span;
        let halves = surfaces
            .layers
            .each_ref()
            .map(|layer| layer.half_step(span));
        let [shoulder, face] =
            [0, 1].map(|k| surfaces.layers[k].answer(&self.states[k], &halves[k], surfaces.area));
        let into_shoulder = (face.free - shoulder.free + face.resistance * power)
            / (shoulder.resistance + face.resistance);
        let middle = self.known.0 + 0.5 * span;
        (self.rise).raise(shoulder.free + shoulder.resistance * into_shoulder, middle);
        for (k, own) in [into_shoulder, power - into_shoulder]
            .into_iter()
            .enumerate()
        {
            surfaces.layers[k].advance(&mut self.states[k], &halves[k], own);
        }
        self.known = (end, 0.0);
        if after <= 0.0 {
            self.touched = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::heat_conduction::STEEL_HEAT;

    #[test]
    fn a_constant_flux_heats_two_half_spaces_as_the_square_root_of_time() {
        let layer = Layer::new(STEEL_HEAT, 10e-3);
        let surfaces = FaceSurfaces {
            layers: [layer.clone(), layer],
            area: 3e-4,
        };
        let (power, step) = (20e3, 2e-5);
        let mut heat = FaceHeat::default();
        for k in 0..1000 {
            let times = [k, k + 1].map(|k| step * f64::from(k));
            heat.watch(&surfaces, times, [power; 2]);
        }
        // half of the flux each: T = 2 q √(t/π)/√(kρc)
        let flux = 0.5 * power / surfaces.area;
        let time: f64 = heat.rise.time;
        let expected = 2.0 * flux * (time / std::f64::consts::PI).sqrt() / STEEL_HEAT.effusivity();
        let ratio = heat.rise.value / expected;
        assert!(
            time > 0.0198 && (ratio - 1.0).abs() < 0.01,
            "{time} {ratio}"
        );
        // a face that rested is cooler: the same power makes no record at once, as it would without a rest
        heat.watch(&surfaces, [0.02, 0.02 + step], [power, 0.0]);
        let first = heat.rise;
        for k in 0..10 {
            let times = [k, k + 1].map(|k| 0.3 + step * f64::from(k));
            heat.watch(&surfaces, times, [power; 2]);
        }
        assert_eq!(heat.rise, first);
    }
}
