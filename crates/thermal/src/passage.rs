//! What heat passes between two bodies: a given conductance, a line that rolls, a ring on its seat, gas and radiation.
//!
//! ```text
//!   line     rough metal and rolling in series,  beside gas and radiation in the gap all round
//!   pressed  rough metal by the pressure that temperatures and speed leave and by the mean one of the load that the ring carries, beside the same
//!            gap; a loose ring is pressed by its load alone: what rough metal conducts goes with the force, whatever its area
//!   open     gas around a cylinder, radiation into the room
//! ```
//! Gas in a gap is that of a rotor which lies in its bore: thin near the line and thick opposite of it. Radiation is exact at
//! the temperatures of the instant, σ(T₁² + T₂²)(T₁ + T₂), and held for a step.
//!
//! Not modelled: a loose ring that creeps; gas that a turning rotor stirs in its gap (it turns with its race but for a hundredth, far below the onset of
//! vortices); ends and edges; what balls and cage radiate.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::clearance::Seat;
use physics::air::{cylinder_in_air, gap_transfer};
use physics::heat_conduction::STEEL_HEAT;
use physics::heat_exchange::{
    GROUND_STEEL, line_half_width, pressed_joint, radiation_conductance, rolling_line_conductance,
};
use physics::viscosity::ICE_POINT;
use std::f64::consts::TAU;

/// Distance of the mean planes of rough surfaces that touch, over their roughness: 1.53 (p/H)^−0.097 is 2.5 to 4. Source: Yovanovich (from
/// memory).
const APART: f64 = 3.0;

/// How heat passes between two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Passage {
    /// A conductance, W/K.
    Given(f64),
    /// A line of ground steel under a load, and the gap all round.
    Line(Line),
    /// A ring on its seat.
    Pressed(Pressed),
    /// From a body to a room.
    Open(Open),
}

/// A ring of ground steel on its seat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressed {
    /// The seat, of which the first body is inside.
    pub seat: Seat,
    /// Temperature at which it has its interference, °C.
    pub reference: f64,
    /// Length along the axis, m.
    pub length: f64,
    /// What fills the gaps of the joint.
    pub medium: Medium,
}

/// A rotor that rolls in the bore of a race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Radius of the bore, m.
    pub bore: f64,
    /// Radial clearance of the rotor in it, m.
    pub clearance: f64,
    /// Length along the axis, m.
    pub length: f64,
    /// Contact modulus E*, Pa.
    pub modulus: f64,
    /// What fills the gap.
    pub medium: Medium,
}

/// What passes between two surfaces that do not touch; nothing by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Medium {
    /// Pressure of the air, Pa.
    pub pressure: f64,
    /// Emissivities of the inner and the outer surface; 0 radiates nothing.
    pub emissivities: [f64; 2],
}

/// A cylinder in a room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Open {
    /// Diameter that decides the flow of the gas, m.
    pub diameter: f64,
    /// Surface, m².
    pub area: f64,
    /// Emissivity; 0 radiates nothing.
    pub emissivity: f64,
    /// Pressure of the air, Pa.
    pub pressure: f64,
}

impl Passage {
    /// Conductance under a force that presses the bodies together, N, at a speed, rad/s, and at the temperatures of both, °C: W/K.
    pub fn conductance(&self, force: f64, speed: f64, temperatures: [f64; 2]) -> f64 {
        let kelvin = temperatures.map(|celsius| celsius + ICE_POINT);
        match self {
            Passage::Given(conductance) => *conductance,
            Passage::Line(line) => {
                let size = [line.bore, line.length, line.clearance];
                line.metal(force, speed.abs()) + line.medium.across(size, kelvin)
            }
            Passage::Pressed(pressed) => {
                let now = pressed.interference(speed, temperatures);
                let (roughness, slope, hardness) = GROUND_STEEL;
                let metal = [STEEL_HEAT.conductivity; 2];
                let radius = 0.5 * pressed.seat.diameter;
                let area = TAU * radius * pressed.length;
                let pressure = pressed.seat.presses * now.max(0.0) + force / area;
                let joint = pressed_joint(metal, roughness, slope, pressure, hardness);
                let size = [radius, pressed.length, 0.5 * (-now).max(0.0)];
                area * joint + pressed.medium.across(size, kelvin)
            }
            Passage::Open(open) => {
                let gas = cylinder_in_air(open.diameter, speed, kelvin, open.pressure);
                let room = [open.area, f64::INFINITY];
                open.area * gas + radiation_conductance(kelvin, room, [open.emissivity, 1.0])
            }
        }
    }
}

impl Passage {
    /// Whether a person has given it, whatever the bodies do.
    pub fn is_given(&self) -> bool {
        matches!(self, Passage::Given(_))
    }
    /// Whether it follows temperatures so closely that only short steps see it.
    pub fn is_pressed(&self) -> bool {
        matches!(self, Passage::Pressed(_))
    }
    /// Whether a ring that was pressed on its seat is loose at a speed and at the temperatures of both bodies, °C.
    pub fn is_loose(&self, speed: f64, temperatures: [f64; 2]) -> bool {
        matches!(self, Passage::Pressed(pressed) if pressed.seat.interference > 0.0
            && pressed.interference(speed, temperatures) <= 0.0)
    }
}

impl Pressed {
    /// Diametral interference at a speed (rad/s) and at temperatures, °C: m; below 0 the ring is loose.
    fn interference(&self, speed: f64, temperatures: [f64; 2]) -> f64 {
        self.seat.between(temperatures, self.reference) - self.seat.spins * speed * speed
    }
}

impl Line {
    /// Half-width of the contact under a force, N: m.
    pub fn half_width(&self, force: f64) -> f64 {
        line_half_width(force, self.bore, self.clearance, self.length, self.modulus)
    }

    /// Through the metal under a force, N: W/K.
    fn metal(&self, force: f64, speed: f64) -> f64 {
        if force <= 0.0 {
            return 0.0;
        }
        let half = self.half_width(force);
        let (roughness, slope, hardness) = GROUND_STEEL;
        let area = 2.0 * half * self.length;
        let metal = [STEEL_HEAT.conductivity; 2];
        let joint = area * pressed_joint(metal, roughness, slope, force / area, hardness);
        let rolling =
            rolling_line_conductance(self.length, half, speed * self.bore, STEEL_HEAT, STEEL_HEAT);
        joint * rolling / (joint + rolling)
    }
}

impl Medium {
    /// Across the gap in a bore of a radius, length and radial clearance, m, at temperatures in K: W/K.
    fn across(&self, [bore, length, clearance]: [f64; 3], kelvin: [f64; 2]) -> f64 {
        let area = |radius: f64| TAU * radius * length;
        let mean = 0.5 * (kelvin[0] + kelvin[1]);
        let nearest = APART * GROUND_STEEL.0;
        let gas = gap_transfer(clearance, nearest, self.pressure, mean);
        let areas = [area(bore - clearance), area(bore)];
        area(bore) * gas + radiation_conductance(kelvin, areas, self.emissivities)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::heat_exchange::STEFAN_BOLTZMANN;
    use physics::materials::{BEARING_STEEL, contact_modulus};

    fn line(medium: Medium) -> Passage {
        Passage::Line(Line {
            bore: 12.5e-3,
            clearance: 0.25e-3,
            length: 12e-3,
            modulus: contact_modulus(BEARING_STEEL, BEARING_STEEL),
            medium,
        })
    }

    #[test]
    fn a_rough_line_insulates_in_proportion_to_the_load() {
        // ground surfaces at 40 N: about 0.13 W/K
        let found = line(Medium::default()).conductance(40.0, 2000.0, [20.0, 20.0]);
        assert!((0.08..0.2).contains(&found), "{found}");
        assert_eq!(
            line(Medium::default()).conductance(40.0, 0.0, [20.0, 20.0]),
            0.0
        );
        assert_eq!(
            line(Medium::default()).conductance(0.0, 2000.0, [20.0, 20.0]),
            0.0
        );
    }

    #[test]
    fn a_gap_passes_what_its_gas_and_its_walls_do() {
        let at_rest = |pressure, emissivity| {
            let medium = Medium {
                pressure,
                emissivities: [emissivity; 2],
            };
            line(medium).conductance(40.0, 0.0, [60.0, 20.0])
        };
        // air all round would be k/c A = 0.1 W/K; lying on one side it is k A/√(s (s + 2c)), s of 2.4 µm and 0.24 µm at 1 bar
        let (area, s) = (TAU * 12.5e-3 * 12e-3, 2.64e-6);
        let air = area * 0.0273 / f64::sqrt(s * (s + 0.5e-3));
        assert!((at_rest(1e5, 0.0) / air - 1.0).abs() < 0.03);
        // black walls at 60 and 20 °C: σ A₁ (T₁⁴ − T₂⁴)/ΔT, and of emissivity 0.2 a ninth of it
        let smaller = area * 12.25 / 12.5;
        let black = STEFAN_BOLTZMANN * smaller * (333.15f64.powi(4) - 293.15f64.powi(4)) / 40.0;
        assert!((at_rest(0.0, 1.0) / black - 1.0).abs() < 1e-12);
        let grey = black / (5.0 + 4.0 * 12.25 / 12.5);
        assert!((at_rest(0.0, 0.2) / grey - 1.0).abs() < 1e-12);
        // thinner than 1 Pa the gas counts less than radiation between black walls
        assert!(at_rest(1.0, 0.0) < at_rest(0.0, 1.0));
        assert_eq!(at_rest(0.0, 0.0), 0.0);
    }

    #[test]
    fn a_seat_conducts_by_its_pressure_and_a_loose_one_by_its_gap() {
        let seat = Seat {
            interference: 5e-6,
            diameter: 47e-3,
            nodes: [0, 1],
            expansions: [11.5e-6, 23e-6],
            closes: 0.8,
            presses: 1e12,
            spins: 1e-12,
        };
        let at = |pressure, emissivity, speed, temperatures| {
            let medium = Medium {
                pressure,
                emissivities: [emissivity; 2],
            };
            let pressed = Pressed {
                seat,
                reference: 20.0,
                length: 12e-3,
                medium,
            };
            Passage::Pressed(pressed).conductance(0.0, speed, temperatures)
        };
        // 5 MPa: 17 kW/m²K, and 3.6 at 1 MPa
        let area = TAU * 23.5e-3 * 12e-3;
        let still = at(0.0, 0.0, 0.0, [20.0, 20.0]) / area;
        assert!((still / 17e3 - 1.0).abs() < 0.03, "{still}");
        // a speed of 2000 rad/s takes 4 µm: a fifth of the pressure
        let fast = at(0.0, 0.0, 2000.0, [20.0, 20.0]) / area;
        assert!(
            (fast / still / 0.2f64.powf(0.95) - 1.0).abs() < 1e-12
                && (3.5e3..3.8e3).contains(&fast)
        );
        // housing of aluminium 20 K warmer with its ring: 10.8 µm are gone, radiation is left; a thousandth
        let warm = [40.0, 40.0];
        let loose = at(0.0, 1.0, 0.0, warm) / area;
        assert!(
            (5.0..8.0).contains(&loose) && loose < 1e-3 * still,
            "{loose}"
        );
        assert_eq!(at(0.0, 0.0, 0.0, warm), 0.0);
        // with 40 N on it a loose one conducts as a line of that load does, whatever its area: 0.13 to 0.18 W/K
        let loaded = Pressed {
            seat,
            reference: 20.0,
            length: 12e-3,
            medium: Medium::default(),
        };
        let loose = Passage::Pressed(loaded).conductance(40.0, 0.0, warm);
        assert!((0.13..0.2).contains(&loose), "{loose}");
        // gas of the rough joint is there pressed and loose: no step where it lets go
        let lets_go = |rest: f64| {
            let kelvin = (5e-6 - rest) / (11.5e-6 * 47e-3);
            at(1e5, 0.0, 0.0, [20.0 + kelvin, 20.0 + kelvin])
        };
        assert!((lets_go(1e-12) / lets_go(-1e-12) - 1.0).abs() < 1e-3);
        assert!(lets_go(-5e-6) < 0.7 * lets_go(0.0));
    }

    #[test]
    fn a_body_that_radiates_into_the_cold_cools_as_its_fourth_power() {
        use crate::network::{Ground, Network};
        // C Ṫ = −ε σ A T⁴ to nothing: T^−3 = T₀^−3 + 3 ε σ A t/C
        let (capacity, area, emissivity) = (200.0, 0.05, 0.4);
        let open = Passage::Open(Open {
            diameter: 0.1,
            area,
            emissivity,
            pressure: 0.0,
        });
        let mut now = vec![600.0 - ICE_POINT];
        let (steps, step) = (4000, 2.0);
        for _ in 0..steps {
            let ground = Ground {
                node: 0,
                conductance: open.conductance(0.0, 0.0, [now[0], -ICE_POINT]),
                temperature: -ICE_POINT,
            };
            let network = Network::new(&[capacity], &[], &[ground]).unwrap();
            network.advance(&mut now, &[0.0], step);
        }
        let rate = 3.0 * emissivity * STEFAN_BOLTZMANN * area / capacity;
        let exact = (600f64.powi(-3) + rate * step * f64::from(steps)).powf(-1.0 / 3.0);
        let found = now[0] + ICE_POINT;
        assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
        assert!(exact < 400.0);
    }
}
