//! How hot rotor and inner race become where they rub: an observer of a run, which changes nothing of it.
//!
//! ```text
//!   friction heat of the ledger ──► patch ──► surface layer of the rotor (energy, modes)
//!                                      └────► surface layer of the race
//! ```
//! The friction heat that the ledger books while they touch is divided by [`rubbing_contact`](thermal::rubbing_contact):
//! what both layers have taken is that heat to rounding. The patch is Hertz's line contact; each body's track is the arc
//! that the patch has swept, up to its circumference.
//!
//! Spans of heat are as long as a step at the touch and then a share of the time since: short where the flash grows, never
//! so long that the force changes much.
//!
//! Assumes: steel-like layers with an insulated back (right until L²/α, about 2 s for 5 mm), the same heat at all places of
//! a track. Does not model: friction and clearance that follow the temperature, hot spots beside each other, cooling by gas.

use crate::system::sampling::Peak;
use number::Vec2;
use physics::heat_exchange::line_half_width;
use thermal::layer::{Layer, LayerState};
use thermal::rubbing_contact::Touch;

/// The surfaces of rotor and inner race.
#[derive(Clone, Debug, PartialEq)]
pub struct Surfaces {
    /// Layer of the rotor, layer of the race.
    pub layers: [Layer; 2],
    /// Length of the contact along the axis, m.
    pub length: f64,
    /// Contact modulus E*, Pa.
    pub modulus: f64,
}

/// A span of heat over the time since the touch.
const SHARE: f64 = 0.05;
/// Longest span, s.
const LONGEST: f64 = 1e-4;

/// What has become of the surfaces of one bearing.
#[derive(Clone, Debug)]
pub struct SurfaceHeat {
    states: [LayerState; 2],
    /// Angle that the patch has swept of each body, rad.
    swept: [f64; 2],
    /// Begin of this touch, s.
    touched: Option<f64>,
    /// Until when the layers are known, s, and the friction heat until then, J.
    known: (f64, f64),
    /// ∫N dt since, N s.
    impulse: f64,
    /// Rise of the patch in the last span of a touch, K; once it is over the mean of both surfaces.
    pub rise: f64,
    /// Largest rise of the patch, K.
    pub contact: Peak,
    /// Largest rise of the patch in this touch, K.
    pub of_touch: f64,
    /// Largest rises of both surfaces, rotor and race, each averaged over its track, K.
    pub surfaces: [Peak; 2],
    /// Largest nominal pressure times sliding speed, W/m².
    pub pressure_speed: Peak,
    /// Distance slid, m.
    pub distance: f64,
    /// Longest time that one place of a rotor which whirls with its spin stayed in the patch, s.
    pub longest_stay: f64,
    /// Since when one stays now, s, and the angle by which it has moved through the patch, rad.
    stays: Option<(f64, f64)>,
}

/// What a step shows of a contact.
pub(crate) struct Seen {
    /// Begin and end, s.
    pub times: [f64; 2],
    /// Normal force at both, N.
    pub forces: [f64; 2],
    /// Sliding speed at both, m/s.
    pub slips: [f64; 2],
    /// Friction heat so far at both, J.
    pub heats: [f64; 2],
}

/// Where the surfaces are, and how they move.
#[derive(Clone, Copy)]
pub(crate) struct Motions {
    /// Rotor's centre from the race's, m, and its velocity from there, m/s.
    pub offset: Vec2<f64>,
    pub velocity: Vec2<f64>,
    /// Spins of rotor and race, rad/s.
    pub spins: [f64; 2],
}

impl SurfaceHeat {
    /// Before anything has touched.
    pub fn new() -> Self {
        SurfaceHeat {
            states: Default::default(),
            swept: [0.0; 2],
            touched: None,
            known: (0.0, 0.0),
            impulse: 0.0,
            rise: 0.0,
            contact: Peak::NONE,
            of_touch: 0.0,
            surfaces: [Peak::NONE; 2],
            pressure_speed: Peak::NONE,
            distance: 0.0,
            longest_stay: 0.0,
            stays: None,
        }
    }

    /// Heat that rotor and race have taken, J.
    pub fn taken(&self) -> [f64; 2] {
        self.states.map(|state| state.energy)
    }

    /// Takes a step; true when its heat is due, which needs the motions at its end.
    pub(crate) fn watch(&mut self, surfaces: &Surfaces, bore: f64, seen: &Seen) -> bool {
        let [start, end] = seen.times;
        let length = end - start;
        if seen.forces == [0.0; 2] {
            return false;
        }
        if self.touched.is_none() {
            self.rest(surfaces, start);
            // what was made in a touch within one step is taken with this one
            self.known = (start, self.known.1);
            self.touched = Some(start);
            self.of_touch = 0.0;
        }
        self.impulse += 0.5 * (seen.forces[0] + seen.forces[1]) * length;
        self.distance += 0.5 * (seen.slips[0].abs() + seen.slips[1].abs()) * length;
        let pressure = seen.forces[1] / (2.0 * bore * surfaces.length);
        self.pressure_speed
            .raise(pressure * seen.slips[1].abs(), end);
        let since = end - self.touched.unwrap_or(end);
        let span = end - self.known.0;
        seen.forces[1] == 0.0 || span >= (SHARE * since).min(LONGEST)
    }

    /// Lets the layers take the heat since they were known, with the motions at the end of that span.
    pub(crate) fn take(
        &mut self,
        surfaces: &Surfaces,
        [bore, clearance]: [f64; 2],
        seen: &Seen,
        motions: &Motions,
    ) {
        let (from, heat) = self.known;
        let end = seen.times[1];
        let span = end - from;
        let force = self.impulse / span;
        let power = (seen.heats[1] - heat) / span;
        let touched = self.touched.unwrap_or(from);
        let half_width = line_half_width(force, bore, clearance, surfaces.length, surfaces.modulus);
        let radii = [bore - clearance, bore];
        // the patch goes round with the centre of the rotor
        let distance = motions.offset.length_squared().max(1e-30);
        let whirl = motions.offset.cross(motions.velocity) / distance;
        let turning = motions.spins.map(|spin| (spin - whirl).abs());
        for (swept, turning) in self.swept.iter_mut().zip(turning) {
            *swept = (*swept + turning * span).min(2.0 * std::f64::consts::PI);
        }
        let since = 0.5 * (from + end) - touched;
        let touch = Touch {
            power,
            half_width,
            length: surfaces.length,
            passing: [0, 1].map(|body| radii[body] * turning[body]),
            since,
            tracks: self.tracks(surfaces, radii, half_width),
        };
        let halves = [0, 1].map(|body: usize| surfaces.layers[body].half_step(span));
        if half_width > 0.0 {
            let shared = touch.advance(&surfaces.layers, &mut self.states, &halves);
            let middle = 0.5 * (from + end);
            self.contact.raise(shared.contact, middle);
            self.rise = match seen.forces[1] > 0.0 {
                true => shared.contact,
                false => 0.5 * (shared.surfaces[0] + shared.surfaces[1]),
            };
            self.of_touch = self.of_touch.max(shared.contact);
            for (peak, rise) in self.surfaces.iter_mut().zip(shared.surfaces) {
                peak.raise(rise, middle);
            }
        }
        self.stay(
            [from, end],
            [motions.spins[0], whirl],
            2.0 * half_width / radii[0],
        );
        self.known = (end, seen.heats[1]);
        self.impulse = 0.0;
        if seen.forces[1] == 0.0 {
            self.touched = None;
            self.stays = None;
        }
    }

    /// How long one place of the rotor stays in a patch that is so wide, rad: one that whirls with its spin carries it along.
    fn stay(&mut self, [from, end]: [f64; 2], [spin, whirl]: [f64; 2], width: f64) {
        if whirl * spin.signum() <= 0.5 * spin.abs() {
            self.stays = None;
            return;
        }
        let (since, moved) = self.stays.unwrap_or((from, 0.0));
        let now = moved + (spin - whirl) * (end - from);
        let left = match now.abs() > width {
            true => from + (width - moved.abs()).max(0.0) / (spin - whirl).abs(),
            false => end,
        };
        self.longest_stay = self.longest_stay.max(left - since);
        self.stays = (now.abs() <= width).then_some((since, now));
    }

    /// Tracks of both bodies, m².
    fn tracks(&self, surfaces: &Surfaces, radii: [f64; 2], half_width: f64) -> [f64; 2] {
        [0, 1].map(|body: usize| {
            let whole = 2.0 * std::f64::consts::PI * radii[body];
            surfaces.length * (2.0 * half_width + radii[body] * self.swept[body]).min(whole)
        })
    }

    /// Nothing touches until a time.
    fn rest(&mut self, surfaces: &Surfaces, until: f64) {
        let span = until - self.known.0;
        if span > 0.0 {
            for (layer, state) in surfaces.layers.iter().zip(&mut self.states) {
                layer.advance(state, &layer.half_step(span), 0.0);
            }
        }
    }
}

impl Default for SurfaceHeat {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_stays_while_the_whirl_keeps_up_with_the_spin() {
        let stays = |spin: f64, whirl: f64, steps: usize| {
            let mut heat = SurfaceHeat::new();
            for k in 0..steps {
                let from = 1e-3 * k as f64;
                heat.stay([from, from + 1e-3], [spin, whirl], 0.02);
            }
            heat.longest_stay
        };
        // synchronous: as long as it lasts; nearly so: until the patch is passed
        assert!((stays(300.0, 300.0, 200) - 0.2).abs() < 1e-12);
        assert!((stays(300.0, 299.0, 200) - 0.02).abs() < 1e-12);
        assert!((stays(-300.0, -301.0, 200) - 0.02).abs() < 1e-12);
        // a rotor that whirls backward, rolls, or stands carries no place along
        for (spin, whirl) in [(300.0, -300.0), (300.0, 0.0), (0.0, 0.0), (1e-3, 0.0)] {
            assert_eq!(stays(spin, whirl, 200), 0.0);
        }
    }
}
