//! An unbalance that comes on the way, as where a blade is lost: the rotor that goes on is another one.
//!
//! ```text
//!   η_G' = η_G + ΔN,   η̇_G' = η̇_G + jΩ ΔN        ΔN = M⁻¹ u e^{j(φ+δ)} φ_k: axis and spin go on as they were
//! ```
//! What the rotor has less of energy and angular momentum left with the blade: both are booked. Does not model: the mass of what is lost,
//! nor that it strikes anything.

use super::{MachineConstants, RotorMachine};
use number::Vec2;

impl RotorMachine {
    /// The same machine with these of the unbalances that come on the way.
    #[must_use]
    pub fn unbalanced(&self, unbalances: u16) -> Self {
        let mut constants = self.constants.clone();
        let new = unbalances & !self.unbalances;
        let planes = constants.unbalances.iter().enumerate();
        let planes = planes.filter(|(k, _)| new & (1 << k) != 0);
        let planes: Vec<_> = planes.map(|(_, plane)| plane.clone()).collect();
        constants.rotor = constants.rotor.with_unbalance(&planes);
        let pairs = self.added.iter().zip(&constants.rotor.coordinates);
        let pairs = pairs.zip(&self.constants.rotor.coordinates);
        let added = pairs.map(|((before, new), old)| *before + (new.unbalance - old.unbalance));
        let added = added.collect();
        RotorMachine {
            unbalances,
            added,
            ..self.renewed(constants)
        }
    }

    /// The same machine with other constants; what has come on the way stays.
    #[must_use]
    pub fn renewed(&self, constants: MachineConstants) -> Self {
        RotorMachine {
            unbalances: self.unbalances,
            added: self.added.clone(),
            ..Self::with_levitation(constants, self.levitated)
        }
    }

    /// Puts a state of the rotor with some of these unbalances where that with others has it, and books what that changes.
    pub fn unbalance(&self, of: [u16; 2], state: &mut [f64]) {
        let [old, new] = of.map(|unbalances| self.unbalanced(unbalances));
        let before = old.content(state);
        let pairs = new.added.iter().zip(&old.added);
        let added: Vec<_> = pairs.map(|(new, old)| *new - *old).collect();
        self.shift(&added, state);
        let after = new.content(state);
        if let Some(source) = self.layout().of_rotor.unbalance {
            state[self.layout().source(source)] += after.energy() - before.energy();
        }
        state[self.layout().angular_impulse()] += after.angular_momentum - before.angular_momentum;
    }

    /// Puts a state where the rotor of the start would have it: its axis, and everything else, stays.
    pub(super) fn as_begun(&self, state: &mut [f64]) {
        if self.unbalances != 0 {
            let added: Vec<_> = self.added.iter().map(|own| -*own).collect();
            self.shift(&added, state);
        }
    }

    /// Adds to N at φ = 0.
    fn shift(&self, added: &[Vec2<f64>], state: &mut [f64]) {
        let rotor = self.layout().rotor;
        let (sine, cosine) = state[rotor.angle()].sin_cos();
        let spin = state[rotor.spin()];
        for (k, own) in added.iter().enumerate() {
            let place = *own * cosine + own.turned() * sine;
            let speed = place.turned() * spin;
            for (block, by) in [place.x, place.y, speed.x, speed.y].into_iter().enumerate() {
                state[rotor.block(block).start + k] += by;
            }
        }
    }
}
