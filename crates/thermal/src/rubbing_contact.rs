//! Two bodies that rub in a patch: how the friction power divides, and how hot the patch becomes.
//!
//! ```text
//!   T₁ + P₁F₁ = T₂ + P₂F₂        both sides of the patch are equally hot
//!   P₁ + P₂   = P                friction power, W
//!   F = g(patch/track) · 2√(t_c/π)/(e · patch)      flash of a body above its own surface, K/W
//!   t_c = min(2b/v, time since the touch)           how long a point of the surface stays in the patch
//! ```
//!
//! T is the surface of each body's [`layer`](crate::layer), averaged over its track; v is the speed of each surface past
//! the patch, not past the other surface. Equal temperatures divide the power as Blok's rule does, unequal ones let heat
//! flow to the cooler body even without friction. In a step the match holds at its middle (second order).
//! Once the profiles of both layers are steady, P₁ = (P R₂ + T₂ − T₁)/(R₁ + R₂), R = F + (5/3) L/(2kA) from the mean of the metal on.
//!
//! Not modelled: asperities, which are hotter than the mean of the patch; uneven pressure along the contact; cooling by oil.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::layer::{Answer, HalfStep, Layer, LayerState};
use physics::flash::{flash_rise, return_factor};
use physics::heat_exchange::GROUND_STEEL;

/// How two bodies touch, in the middle of a step or at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Friction power, W.
    pub power: f64,
    /// Half-width b of the patch along the motion, m.
    pub half_width: f64,
    /// Length of the patch across the motion, m.
    pub length: f64,
    /// Speed of each surface past the patch, m/s; its sign does not matter.
    pub passing: [f64; 2],
    /// Time since the touch, s.
    pub since: f64,
    /// Track of each body that the patch sweeps, m².
    pub tracks: [f64; 2],
    /// Rise of the metal behind each layer, to which its state is a rise, K.
    pub metals: [f64; 2],
}

/// What a touch does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shared {
    /// Power into each body, W; they add to the friction power.
    pub powers: [f64; 2],
    /// Rise of both sides of the patch, at its hottest edge, K.
    pub contact: f64,
    /// Rise of each surface under the patch above its metal, averaged over its track, K.
    pub surfaces: [f64; 2],
}

impl Touch {
    /// Area of the patch, m².
    pub fn patch(&self) -> f64 {
        2.0 * self.half_width * self.length
    }

    /// How far a mean slip, m/s, makes one patch of both surfaces: the share of a surface that the spots where they touch sweep as they pass.
    ///
    /// Formula: s/(s + σ/m), s = 2b |u|/v, v the faster of both speeds past the patch: 1 of one that slides, 0 of those that roll
    ///
    /// Source: assumed, not measured: between the patch of smooth bodies that slide and the rough line of those that roll.
    /// Valid: as an order of magnitude where slip is 0.1 to 10 %; asperities that keep their own resistance while they slide are not modelled.
    pub fn slides(&self, slip: f64) -> f64 {
        let (roughness, slope, _) = GROUND_STEEL;
        let fastest = self.passing[0].abs().max(self.passing[1].abs());
        let swept = 2.0 * self.half_width * slip.abs();
        match swept > 0.0 {
            true => swept / (swept + roughness / slope * fastest),
            false => 0.0,
        }
    }

    /// F of a body, K/W.
    fn flash(&self, body: usize, layer: &Layer) -> f64 {
        let patch = self.patch();
        let (speed, effusivity) = (self.passing[body].abs(), layer.material().effusivity());
        let rise = flash_rise(1.0 / patch, self.half_width, speed, self.since, effusivity);
        return_factor((patch / self.tracks[body]).min(1.0)) * rise
    }

    /// From the mean of the metal behind each layer to the patch, once the profiles of both layers are steady, K/W.
    ///
    /// Formula: F + L/(2kA) + L/(3kA)
    pub fn steady(&self, layers: &[Layer; 2]) -> [f64; 2] {
        [0, 1].map(|body| {
            let layer = &layers[body];
            self.flash(body, layer) + 5.0 / 3.0 / layer.to_core(self.tracks[body])
        })
    }

    /// Divides the power between two bodies by how their surfaces answer.
    fn shared(&self, layers: &[Layer; 2], answers: [Answer; 2]) -> Shared {
        let flashes = [0, 1].map(|body| self.flash(body, &layers[body]));
        let resistances = [0, 1].map(|body| flashes[body] + answers[body].resistance);
        let free = [0, 1].map(|body: usize| self.metals[body] + answers[body].free);
        let first =
            (self.power * resistances[1] + free[1] - free[0]) / (resistances[0] + resistances[1]);
        let powers = [first, self.power - first];
        let surface = |body: usize| answers[body].free + powers[body] * answers[body].resistance;
        Shared {
            powers,
            contact: free[0] + first * resistances[0],
            surfaces: [surface(0), surface(1)],
        }
    }

    /// What it does now, with the layers in these states.
    pub fn at_once(&self, layers: &[Layer; 2], states: &[LayerState; 2]) -> Shared {
        let answer = |body: usize| {
            let now = layers[body].half_step(0.0);
            layers[body].answer(&states[body], &now, self.tracks[body])
        };
        self.shared(layers, [answer(0), answer(1)])
    }

    /// Advances both bodies by a step, this being the touch in its middle; what it does there.
    pub fn advance(
        &self,
        layers: &[Layer; 2],
        states: &mut [LayerState; 2],
        halves: &[HalfStep; 2],
    ) -> Shared {
        let answer =
            |body: usize| layers[body].answer(&states[body], &halves[body], self.tracks[body]);
        let shared = self.shared(layers, [answer(0), answer(1)]);
        for body in 0..2 {
            layers[body].advance(&mut states[body], &halves[body], shared.powers[body]);
        }
        shared
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::heat_conduction::ThermalMaterial;

    const STEEL: ThermalMaterial = ThermalMaterial {
        conductivity: 46.0,
        density: 7850.0,
        specific_heat: 460.0,
    };
    const BRONZE: ThermalMaterial = ThermalMaterial {
        conductivity: 60.0,
        density: 8700.0,
        specific_heat: 380.0,
    };
    const TOUCH: Touch = Touch {
        power: 400.0,
        half_width: 2.4e-4,
        length: 0.012,
        passing: [49.0, 3.0],
        since: 2e-3,
        tracks: [9.2e-4, 9.4e-4],
        metals: [0.0; 2],
    };

    #[test]
    fn equal_bodies_that_pass_equally_fast_share_equally() {
        let layers = [Layer::new(STEEL, 4e-3), Layer::new(STEEL, 4e-3)];
        let touch = Touch {
            passing: [-20.0, 20.0],
            tracks: [9e-4, 9e-4],
            ..TOUCH
        };
        let shared = touch.at_once(&layers, &Default::default());
        assert!((shared.powers[0] - 200.0).abs() < 1e-10);
    }

    #[test]
    fn shares_swap_when_the_bodies_swap() {
        let layers = [Layer::new(STEEL, 5e-3), Layer::new(BRONZE, 3.6e-3)];
        let mut states = [LayerState::default(); 2];
        let halves = [0, 1].map(|k| layers[k].half_step(1e-4));
        let first = TOUCH.advance(&layers, &mut states, &halves);
        let swapped = Touch {
            passing: [3.0, 49.0],
            tracks: [9.4e-4, 9.2e-4],
            ..TOUCH
        };
        let layers = [layers[1].clone(), layers[0].clone()];
        let other = swapped.at_once(&layers, &[LayerState::default(); 2]);
        let first_at_once = TOUCH.at_once(
            &[layers[1].clone(), layers[0].clone()],
            &[LayerState::default(); 2],
        );
        assert!((other.powers[1] / first_at_once.powers[0] - 1.0).abs() < 1e-12);
        assert!((other.contact / first_at_once.contact - 1.0).abs() < 1e-12);
        assert_eq!(first.powers[0] + first.powers[1], 400.0);
    }

    #[test]
    fn without_friction_heat_flows_to_the_cooler_body_alone() {
        let layers = [Layer::new(STEEL, 5e-3), Layer::new(STEEL, 3.6e-3)];
        let mut states = [LayerState::default(); 2];
        let halves = [0, 1].map(|k| layers[k].half_step(1e-3));
        layers[1].advance(&mut states[1], &halves[1], 2000.0);
        let still = Touch {
            power: 0.0,
            ..TOUCH
        };
        let shared = still.at_once(&layers, &states);
        assert!(shared.powers[0] > 0.0 && shared.powers[1] == -shared.powers[0]);
        // the metals alone: steady, both layers held at theirs
        let metals = [20.0, 70.0];
        let warm = Touch { metals, ..still };
        let mut states = [LayerState::default(); 2];
        for _ in 0..20_000 {
            warm.advance(&layers, &mut states, &halves);
            for (body, layer) in layers.iter().enumerate() {
                let track = TOUCH.tracks[body];
                let back = (1.0 / layer.to_core(track), 0.0);
                layer.exchange(&mut states[body], track, back, 1e-3);
            }
        }
        let [rotor, race] = warm.steady(&layers);
        let found = warm.at_once(&layers, &states);
        let right = 50.0 / (rotor + race);
        assert!(
            (found.powers[0] / right - 1.0).abs() < 2e-3,
            "{found:?} {right}"
        );
        assert!((metals[0]..metals[1]).contains(&found.contact));
        // 15 m/s on a race that stands is one patch, 0.5 mm/s of 30 m/s is rolling: a spot moves by 8 nm in the patch, by its size of 8 um at 1.7 %
        let at = |passing: [f64; 2], slip: f64| Touch { passing, ..TOUCH }.slides(slip);
        assert!(at([15.0, 0.0], 15.0) > 0.98 && at([30.0, 30.0], 5e-4) < 2e-3);
        assert!((at([30.0, 29.5], 0.5) - 0.5).abs() < 1e-12 && at([0.0; 2], 0.0) == 0.0);
        // no slip and equal temperatures: nothing
        let nothing = still.at_once(&layers, &Default::default());
        assert_eq!((nothing.powers[0], nothing.contact), (0.0, 0.0));
    }
}
