//! The layer of a body that is heated at its surface: a slab with an insulated back.
//!
//! ```text
//!      P ↓ surface T_s            T_s = (E + 2 Σ m_k z_k)/C + R_fast P
//!   ███████████  thickness L       Ė  = P                    all energy
//!   ▓▓▓▓▓▓▓▓▓▓▓                    ż_k = P − λ_k z_k          λ_k = (π n_k/L)² α,  C = ρ c A L
//!   ───────────  insulated
//! ```
//!
//! The modes hold no energy: they are how far the surface stands above the mean. High ones are taken together in groups
//! of m_k, with n_k⁻² the mean of their n⁻²; those beyond the last group answer at once (R_fast). Under constant power a
//! step of any length is exact, and splitting it changes nothing.
//!
//! Temperatures are rises above the start. What a layer gives to the metal behind it is drawn from its mean, by its user.
//!
//! Source: the series of a slab under constant flux.

use physics::heat_conduction::ThermalMaterial;
use std::f64::consts::PI;

/// Most groups of modes.
pub const MOST_GROUPS: usize = 24;
/// Shortest time, s, from which on the surface follows a constant power within 1.2 %.
const SHORTEST_TIME: f64 = 1e-5;
/// Where a group begins over where the one before it began.
const RATIO: f64 = 1.7;
/// Integers that stand alone.
const ALONE: usize = 3;

/// Constants of a layer; its area comes with each question, because a track may grow.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    material: ThermalMaterial,
    thickness: f64,
    groups: Vec<Group>,
    /// R_fast A, K m²/W.
    fast: f64,
}

/// Modes taken together.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Group {
    count: f64,
    /// λ, 1/s.
    rate: f64,
}

/// State of a layer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LayerState {
    /// Energy above the start, J.
    pub energy: f64,
    /// Heat given to the metal behind or beside it, J.
    pub given: f64,
    /// z of each group, J.
    modes: [f64; MOST_GROUPS],
}

/// What a step of one length does to the modes: e^(−λh/2) of each group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfStep {
    time: f64,
    decays: [f64; MOST_GROUPS],
}

/// How the surface answers half a step of constant power: T_s = free + resistance · P.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// Rise that the surface would have without power, K.
    pub free: f64,
    /// K/W.
    pub resistance: f64,
}

impl Layer {
    /// A layer of a thickness in m.
    pub fn new(material: ThermalMaterial, thickness: f64) -> Self {
        let alpha = material.diffusivity();
        let highest = 2.0 * thickness / (PI * (alpha * SHORTEST_TIME).sqrt());
        let mut groups = Vec::new();
        let (mut first, mut taken) = (1, 0.0);
        while groups.len() < MOST_GROUPS {
            let next = match first <= ALONE {
                true => first + 1,
                false => (RATIO * first as f64) as usize,
            };
            let sum: f64 = (first..next).map(|n| (n as f64).powi(-2)).sum();
            let count = (next - first) as f64;
            groups.push(Group {
                count,
                rate: alpha * (PI / thickness).powi(2) * count / sum,
            });
            taken += sum;
            if next as f64 > highest {
                break;
            }
            first = next;
        }
        let rest = (PI * PI / 6.0 - taken).max(0.0);
        Layer {
            material,
            thickness,
            groups,
            fast: 2.0 * thickness / (PI * PI * material.conductivity) * rest,
        }
    }

    /// What it is made of.
    pub fn material(&self) -> ThermalMaterial {
        self.material
    }

    /// Time in which heat passes it, s: L²/α.
    pub fn through(&self) -> f64 {
        self.thickness * self.thickness / self.material.diffusivity()
    }

    /// C = ρ c A L, J/K.
    pub fn capacity(&self, area: f64) -> f64 {
        self.material.density * self.material.specific_heat * area * self.thickness
    }

    /// From its mean to the core behind it: k A/(L/2), W/K.
    pub fn to_core(&self, area: f64) -> f64 {
        2.0 * self.material.conductivity * area / self.thickness
    }

    /// From its mean under an arc of a ring of this depth to the mean of that ring, K/W: the heat goes along the ring.
    ///
    /// Formula: π r (1 − s)²/(6 k L b), s the arc's share of the circumference, b its width along the axis: uniform heat on the arc, which the
    /// whole ring stores, once the shape of the temperatures has settled; 0 of the whole circumference
    pub fn along_ring(&self, area: f64, radius: f64, width: f64) -> f64 {
        let rest = (1.0 - area / (2.0 * PI * radius * width)).max(0.0);
        let section = self.thickness * width;
        PI * radius * rest * rest / (6.0 * self.material.conductivity * section)
    }

    /// Mean rise, K.
    pub fn mean(&self, state: &LayerState, area: f64) -> f64 {
        state.energy / self.capacity(area)
    }

    /// Factors of a step of a length in s.
    pub fn half_step(&self, step: f64) -> HalfStep {
        let mut decays = [0.0; MOST_GROUPS];
        for (decay, group) in decays.iter_mut().zip(&self.groups) {
            *decay = (-0.5 * group.rate * step).exp();
        }
        HalfStep {
            time: 0.5 * step,
            decays,
        }
    }

    /// The surface half a step later; of a step without length: now.
    pub fn answer(&self, state: &LayerState, half: &HalfStep, area: f64) -> Answer {
        let capacity = self.capacity(area);
        let (mut free, mut reached) = (0.0, 0.0);
        for (group, (z, decay)) in self.groups.iter().zip(state.modes.iter().zip(&half.decays)) {
            free += group.count * z * decay;
            reached += group.count * (1.0 - decay) / group.rate;
        }
        Answer {
            free: (state.energy + 2.0 * free) / capacity,
            resistance: (half.time + 2.0 * reached) / capacity + self.fast / area,
        }
    }

    /// Advances by the whole step under a constant power, W.
    pub fn advance(&self, state: &mut LayerState, half: &HalfStep, power: f64) {
        state.energy += power * 2.0 * half.time;
        for (group, (z, decay)) in
            (self.groups.iter()).zip(state.modes.iter_mut().zip(&half.decays))
        {
            let whole = decay * decay;
            *z = *z * whole + power * (1.0 - whole) / group.rate;
        }
    }

    /// Lets its mean exchange heat with metal of a rise in K through a resistance in K/W for a time in s; without resistance they are one.
    ///
    /// Formula: C d(T̄ − T_c)/dt = −(T̄ − T_c)/R
    pub fn exchange(
        &self,
        state: &mut LayerState,
        area: f64,
        (resistance, rise): (f64, f64),
        time: f64,
    ) {
        let capacity = self.capacity(area);
        if capacity > 0.0 {
            let above = state.energy - capacity * rise;
            let given = -above * (-time / (resistance * capacity)).exp_m1();
            state.energy -= given;
            state.given += given;
        }
    }

    /// The rise of the surface now, under a power in W.
    pub fn surface(&self, state: &LayerState, power: f64, area: f64) -> f64 {
        let now = self.answer(state, &self.half_step(0.0), area);
        now.free + now.resistance * power
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::heat_conduction::slab_rise;

    const STEEL: ThermalMaterial = ThermalMaterial {
        conductivity: 46.0,
        density: 7850.0,
        specific_heat: 460.0,
    };
    const AREA: f64 = 9e-4;

    #[test]
    fn the_surface_under_constant_power_is_the_slab_s() {
        for thickness in [3e-3, 3.6e-3, 6e-3] {
            let layer = Layer::new(STEEL, thickness);
            assert!((10..=12).contains(&layer.groups.len()));
            for time in [1e-5, 3e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0] {
                let mut state = LayerState::default();
                layer.advance(&mut state, &layer.half_step(time), 500.0);
                let ours = layer.surface(&state, 500.0, AREA);
                let exact = slab_rise(STEEL, 500.0 / AREA, thickness, time, 0.0);
                assert!(
                    (ours / exact - 1.0).abs() < 0.012,
                    "{thickness} {time}: {ours} {exact}"
                );
                assert_eq!(state.energy, 500.0 * time);
            }
        }
    }

    #[test]
    fn a_step_split_anywhere_is_the_same_step() {
        let layer = Layer::new(STEEL, 3.6e-3);
        let mut whole = LayerState::default();
        layer.advance(&mut whole, &layer.half_step(2e-3), 300.0);
        let mut parts = LayerState::default();
        for step in [1e-6, 4e-4, 1.599e-3] {
            layer.advance(&mut parts, &layer.half_step(step), 300.0);
        }
        let [a, b] = [&whole, &parts].map(|state| layer.surface(state, 0.0, AREA));
        assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
        // half a step later the surface is where the answer says
        let mut half = LayerState::default();
        layer.advance(&mut half, &layer.half_step(1e-3), 300.0);
        let answer = layer.answer(&LayerState::default(), &layer.half_step(2e-3), AREA);
        let reached = layer.surface(&half, 300.0, AREA);
        assert!((answer.free + 300.0 * answer.resistance - reached).abs() < 1e-12 * reached);
    }

    #[test]
    fn an_arc_under_power_is_warmer_than_its_ring_by_the_way_along_it() {
        // own finite differences of a ring unrolled: half the circumference, heat on the first share s of it, no heat through its ends
        let (layer, radius, width) = (Layer::new(STEEL, 3.2e-3), 12.5e-3, 12e-3);
        let whole = 2.0 * PI * radius * width;
        for share in [0.1, 0.5] {
            let cells = 200;
            let step = PI * radius / cells as f64;
            let heated = (share * cells as f64) as usize;
            // flux through each face of 1 W on both halves, the ring storing evenly: temperatures from the middle of the arc on
            let (mut rise, mut rises) = (0.0, vec![0.0]);
            for cell in 1..cells {
                let passed = 0.5 * cell.min(heated) as f64 / heated as f64;
                let stored = 0.5 * cell as f64 / cells as f64;
                rise -= (passed - stored) * step / (46.0 * 3.2e-3 * width);
                rises.push(rise);
            }
            let mean = |rises: &[f64]| rises.iter().sum::<f64>() / rises.len() as f64;
            let exact = mean(&rises[..heated]) - mean(&rises);
            let ours = layer.along_ring(share * whole, radius, width);
            // cells of a hundredth of the arc and less
            assert!((ours / exact - 1.0).abs() < 0.01, "{share} {ours} {exact}");
        }
        assert_eq!(layer.along_ring(whole, radius, width), 0.0);
        // heat that the arc keeps and has given is what it got; at rest it has the temperature of the ring
        let mut state = LayerState::default();
        layer.advance(&mut state, &layer.half_step(1e-3), 300.0);
        layer.exchange(&mut state, AREA, (0.3, 0.02), 0.1);
        assert!((state.energy + state.given - 0.3).abs() < 1e-15 && state.given > 0.0);
        layer.exchange(&mut state, AREA, (0.0, 0.02), 0.1);
        assert!((layer.mean(&state, AREA) - 0.02).abs() < 1e-15);
    }

    #[test]
    fn without_power_the_surface_settles_at_the_mean() {
        let layer = Layer::new(STEEL, 3.6e-3);
        let mut state = LayerState::default();
        layer.advance(&mut state, &layer.half_step(1e-3), 300.0);
        let hot = layer.surface(&state, 0.0, AREA);
        layer.advance(&mut state, &layer.half_step(10.0), 0.0);
        let mean = layer.mean(&state, AREA);
        assert!((layer.surface(&state, 0.0, AREA) / mean - 1.0).abs() < 1e-12 && hot > 3.0 * mean);
        // on twice the area the same heat is half as warm
        assert!((layer.mean(&state, 2.0 * AREA) / mean - 0.5).abs() < 1e-12);
    }
}
