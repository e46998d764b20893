//! How hot rotor and inner race become where they rub: an observer of a run, which changes nothing of it.
//!
//! ```text
//!   friction heat of the ledger ──► patch ──► surface layer of the rotor (energy, modes)
//!                                      └────► surface layer of the race
//! ```
//! The friction heat that the ledger books while they touch is divided by [`rubbing_contact`](thermal::rubbing_contact):
//! what both layers have taken is that heat to rounding. The patch is Hertz's line contact; each body's track is the arc
//! between the smallest and the largest angle on that body where the patch has been, up to its circumference.
//!
//! Each layer exchanges heat with the metal behind it, k A/(L/2) from its mean: the rotor's with its core, the race's with its ring, to the
//! mean of which the heat of an arc goes along the ring as well. It holds what it is above that metal, and the patch has the temperatures of the
//! network behind both layers: while the surfaces slide, heat between the bodies goes through it, under the force of rolling through the network's
//! rough line. Without a network the ring is alone and keeps what it gets, and the rotor's layer has an insulated back.
//!
//! Spans of heat are as long as a step at the touch and then a share of the time since: short where the flash grows, never
//! so long that the force changes much.
//!
//! Assumes: the same heat at all places of a track; without a network an insulated back of the rotor's layer (right until L²/α,
//! about 2 s for 5 mm). Does not model: friction and clearance that follow the temperature, hot spots beside each other, cooling by gas.

use crate::system::sampling::Peak;
use number::Vec2;
use physics::heat_exchange::line_half_width;
use std::f64::consts::TAU;
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
    /// Angle of the patch on each body, rad, and its smallest and largest.
    angles: [[f64; 3]; 2],
    /// When the patch was seen last, s, at which angle in space, rad, and the spins of both bodies then, rad/s.
    seen: Option<(f64, f64, [f64; 2])>,
    /// Track of each body, m²; 0 before anything has touched.
    tracks: [f64; 2],
    /// Begin of this touch, s.
    touched: Option<f64>,
    /// Until when the layers are known, s, and the friction heat until then, J.
    known: (f64, f64),
    /// ∫N dt and ∫N|u| dt since, N s, N m.
    impulse: f64,
    worked: f64,
    /// What slid of all that.
    pub slid: Slid,
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
    /// ∫N|u| dt, N m.
    pub rubbed: f64,
    /// Longest time that one place of a rotor which whirls with its spin stayed in the patch, s.
    pub longest_stay: f64,
    /// Since when one stays now, s, and the angle by which it has moved through the patch, rad.
    stays: Option<(f64, f64)>,
}

/// What has slid so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct Slid {
    /// ∫N dt of it, N s.
    pub impulse: f64,
    /// What the patches would have conducted between bodies 1 K apart, layers steady and touched all round, J/K.
    pub conducted: f64,
    /// By how much more of the friction heat they would have given the rotor than the race, both equally warm, J.
    pub uneven: f64,
}

/// What a step shows of a contact.
pub(crate) struct ContactStep {
    /// Begin and end, s.
    pub times: [f64; 2],
    /// Normal force at both, N.
    pub forces: [f64; 2],
    /// Sliding speed at both, m/s.
    pub slips: [f64; 2],
    /// Friction heat so far at both, J.
    pub heats: [f64; 2],
    /// Coefficient of friction.
    pub friction: f64,
    /// Rises of the rotor's core and of the ring of the race above the start, K; none without a network.
    pub cores: Option<[f64; 2]>,
    /// Whether the patch conducts between them; not where a conductance is given.
    pub conducts: bool,
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
            angles: [[0.0; 3]; 2],
            seen: None,
            tracks: [0.0; 2],
            touched: None,
            known: (0.0, 0.0),
            impulse: 0.0,
            worked: 0.0,
            slid: Slid::default(),
            rise: 0.0,
            contact: Peak::NONE,
            of_touch: 0.0,
            surfaces: [Peak::NONE; 2],
            pressure_speed: Peak::NONE,
            distance: 0.0,
            rubbed: 0.0,
            longest_stay: 0.0,
            stays: None,
        }
    }

    /// Heat that rotor and race have taken, J.
    pub fn taken(&self) -> [f64; 2] {
        self.states.map(|state| state.energy + state.given)
    }

    /// Carries on after a leap of the run in time, s: layers, tracks and touch are as they were before it.
    pub fn leap(&mut self, time: f64) {
        self.known.0 += time;
        for instant in self
            .touched
            .iter_mut()
            .chain(self.seen.as_mut().map(|seen| &mut seen.0))
        {
            *instant += time;
        }
        self.stays = None;
    }

    /// Takes a step; true when its heat is due, which needs the motions at its end.
    pub(crate) fn watch(&mut self, surfaces: &Surfaces, bore: f64, seen: &ContactStep) -> bool {
        let [start, end] = seen.times;
        let length = end - start;
        if seen.forces == [0.0; 2] {
            return false;
        }
        if self.touched.is_none() {
            self.rest(surfaces, [bore, start], seen.cores);
            // what was made in a touch within one step is taken with this one
            self.known = (start, self.known.1);
            self.touched = Some(start);
            self.of_touch = 0.0;
        }
        self.impulse += 0.5 * (seen.forces[0] + seen.forces[1]) * length;
        self.worked += 0.5
            * (seen.forces[0] * seen.slips[0].abs() + seen.forces[1] * seen.slips[1].abs())
            * length;
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
        seen: &ContactStep,
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
        self.turn([from, end], whirl, motions);
        self.tracks = self.tracks_of(surfaces, radii, half_width);
        if seen.friction > 0.0 {
            self.rubbed += power * span / seen.friction;
        }
        let since = 0.5 * (from + end) - touched;
        let mut touch = Touch {
            power,
            half_width,
            length: surfaces.length,
            passing: [0, 1].map(|body| radii[body] * turning[body]),
            since,
            tracks: self.tracks,
            metals: [0.0; 2],
        };
        let slides = touch.slides(self.worked / self.impulse.max(f64::MIN_POSITIVE));
        // of bodies that roll, or conduct by a given number, the patch is between both
        let behind = seen.cores.unwrap_or_default();
        let mean = 0.5 * (behind[0] + behind[1]);
        let through = if seen.conducts { slides } else { 0.0 };
        touch.metals = behind.map(|metal| mean + through * (metal - mean));
        let halves = [0, 1].map(|body: usize| surfaces.layers[body].half_step(span));
        if half_width > 0.0 {
            let shared = touch.advance(&surfaces.layers, &mut self.states, &halves);
            let middle = 0.5 * (from + end);
            // over a long time patches go round: a race that stands for good takes less than this
            let tracks = radii.map(|radius| TAU * radius * surfaces.length);
            let [rotor, race] = Touch { tracks, ..touch }.steady(&surfaces.layers);
            self.slid.impulse += slides * self.impulse;
            self.slid.conducted += slides * span / (rotor + race);
            self.slid.uneven += power * span * (race - rotor) / (rotor + race);
            let surfaces = [0, 1].map(|body: usize| shared.surfaces[body] + behind[body]);
            let contact = shared.contact;
            self.contact.raise(contact, middle);
            self.rise = match seen.forces[1] > 0.0 {
                true => contact,
                false => 0.5 * (surfaces[0] + surfaces[1]),
            };
            self.of_touch = self.of_touch.max(contact);
            for (peak, rise) in self.surfaces.iter_mut().zip(surfaces) {
                peak.raise(rise, middle);
            }
        }
        self.exchange(surfaces, bore, seen.cores, span);
        self.stay(
            [from, end],
            [motions.spins[0], whirl],
            2.0 * half_width / radii[0],
        );
        self.known = (end, seen.heats[1]);
        (self.impulse, self.worked) = (0.0, 0.0);
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

    /// Where the patch is on each body: its way in space less what the body has turned, between two touches the short way round.
    fn turn(&mut self, [from, time]: [f64; 2], whirl: f64, motions: &Motions) {
        let whole = |angle: f64| angle - TAU * (angle / TAU).round();
        let place = motions.offset.y.atan2(motions.offset.x);
        let first = (from, place - whirl * (time - from), motions.spins);
        let (before, was, spins) = self.seen.unwrap_or(first);
        let span = time - before;
        for (body, [angle, least, most]) in self.angles.iter_mut().enumerate() {
            let turned = 0.5 * (spins[body] + motions.spins[body]) * span;
            *angle += match before == from {
                true => whole(place - was) - turned,
                false => whole(place - was - turned),
            };
            (*least, *most) = (least.min(*angle), most.max(*angle));
        }
        self.seen = Some((time, place, motions.spins));
    }

    /// Tracks of both bodies, m².
    fn tracks_of(&self, surfaces: &Surfaces, radii: [f64; 2], half_width: f64) -> [f64; 2] {
        [0, 1].map(|body: usize| {
            let (whole, [_, least, most]) = (TAU * radii[body], self.angles[body]);
            surfaces.length * (2.0 * half_width + radii[body] * (most - least)).min(whole)
        })
    }

    /// Lets both layers exchange heat with the metal behind their tracks for a time, s.
    fn exchange(&mut self, surfaces: &Surfaces, bore: f64, cores: Option<[f64; 2]>, span: f64) {
        let [rotor, race] = &surfaces.layers;
        let [track, arc] = self.tracks;
        let taken = self.taken()[1];
        let [on_rotor, on_race] = &mut self.states;
        // a layer holds what it is above the metal behind it: between the bodies themselves the network conducts
        if cores.is_some() {
            rotor.exchange(on_rotor, track, (1.0 / rotor.to_core(track), 0.0), span);
        }
        let along = race.along_ring(arc, bore, surfaces.length);
        let ring = match cores {
            Some(_) => (along + 1.0 / race.to_core(arc), 0.0),
            None => {
                let whole = TAU * bore * surfaces.length;
                (along, taken / race.capacity(whole))
            }
        };
        race.exchange(on_race, arc, ring, span);
    }

    /// Nothing touches until a time.
    fn rest(&mut self, surfaces: &Surfaces, [bore, until]: [f64; 2], cores: Option<[f64; 2]>) {
        let span = until - self.known.0;
        if span > 0.0 {
            for (layer, state) in surfaces.layers.iter().zip(&mut self.states) {
                layer.advance(state, &layer.half_step(span), 0.0);
            }
            self.exchange(surfaces, bore, cores, span);
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
    use std::f64::consts::PI;

    #[test]
    fn surfaces_that_rub_for_long_are_as_hot_as_their_layers_pass_the_heat_on() {
        use physics::heat_conduction::STEEL_HEAT;
        let depths = [5e-3, 3.2e-3];
        let surfaces = Surfaces {
            layers: depths.map(|depth| Layer::new(STEEL_HEAT, depth)),
            length: 12e-3,
            modulus: 113e9,
        };
        let (bore, clearance, power) = (12.5e-3, 0.25e-3, 180.0);
        let motions = Motions {
            offset: Vec2::new(0.0, -clearance),
            velocity: Vec2::zero(),
            spins: [1200.0, 5.0],
        };
        let mut heat = SurfaceHeat::new();
        let mut before = [0.0; 2];
        for k in 1..=10_000 {
            let times = [k - 1, k].map(|k| 1e-3 * f64::from(k));
            let seen = ContactStep {
                times,
                forces: [80.0; 2],
                slips: [15.0; 2],
                heats: times.map(|time| power * time),
                friction: 0.15,
                cores: Some([0.0; 2]),
                conducts: true,
            };
            if k == 9_001 {
                before = heat.taken();
                heat.surfaces = [Peak::NONE; 2];
            }
            assert!(heat.watch(&surfaces, bore, &seen));
            heat.take(&surfaces, [bore, clearance], &seen, &motions);
        }
        // cores held: the mean of a layer is P L/(2kA) above its core, the surface P L/(3kA) above the mean; after five times C/G and more
        let radii = [bore - clearance, bore];
        for body in 0..2 {
            let taken = heat.taken()[body] - before[body];
            let area = TAU * radii[body] * surfaces.length;
            let right = taken * depths[body] / (STEEL_HEAT.conductivity * area) * (0.5 + 1.0 / 3.0);
            let surface = heat.surfaces[body].value;
            assert!((surface / right - 1.0).abs() < 0.01, "{surface} {right}");
        }
        // every joule is one body's, and the distance slid under the force is the heat over the coefficient
        let all = heat.taken().iter().sum::<f64>();
        assert!((all / (10.0 * power) - 1.0).abs() < 1e-10);
        assert!((heat.rubbed / (80.0 * 15.0 * 10.0) - 1.0).abs() < 1e-10);
    }

    #[test]
    fn a_track_is_the_range_of_angles_at_which_a_body_was_touched() {
        let range = |spins: [f64; 2], place: &dyn Fn(f64) -> f64| {
            let mut heat = SurfaceHeat::new();
            for k in 1..=1000 {
                let [from, to] = [k - 1, k].map(|k| 1e-4 * f64::from(k));
                let (angle, whirl) = (place(to), (place(to) - place(from)) / (to - from));
                let motions = Motions {
                    offset: Vec2::new(angle.cos(), angle.sin()),
                    velocity: Vec2::zero(),
                    spins,
                };
                heat.turn([from, to], whirl, &motions);
            }
            heat.angles.map(|[_, least, most]| most - least)
        };
        // a race that stands while the rotor rocks in it: from the bottom 0.3 rad to both sides, sampled to 1e-4 of its swing
        let rocks = |time: f64| -0.5 * PI + 0.3 * (400.0 * time).sin();
        let [rotor, race] = range([1000.0, 0.0], &rocks);
        assert!((race - 0.6).abs() < 1e-3 && rotor > TAU, "{race} {rotor}");
        // across the angle where a circle is cut, and a rotor that carries its patch along
        let over = |time: f64| PI + 0.3 * (400.0 * time).sin();
        assert!((range([0.0; 2], &over)[1] - 0.6).abs() < 1e-3);
        let [rotor, race] = range([300.0, 0.0], &|time| 300.0 * time);
        assert!(rotor < 1e-9 && (race - 30.0).abs() < 1e-9, "{rotor} {race}");
    }

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
