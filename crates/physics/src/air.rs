//! Air that takes heat, at any pressure: its properties, gaps between surfaces, cylinders in open air.
//!
//! Thin gas does not take the temperature of a wall: k/h_fm, the length that the jump of temperature at both walls is worth, adds to every
//! gap. In thick gas it is a fifth of a micrometre, in thin gas longer than any gap, and molecules fly from wall to wall.

use crate::heat_exchange::{AIR_MOLAR_MASS, GAS_CONSTANT, free_molecular_air};
use units::STANDARD_GRAVITY;

/// Pressure of air at sea level, Pa. Source: ISO 2533.
pub const SEA_LEVEL: f64 = 101_325.0;
/// Share of the energy that a molecule exchanges at a wall. Source: technical surfaces in air, 0.8 to 1 (from memory).
const ACCOMMODATION: f64 = 1.0;
/// Prandtl number of air. Source: tables, 0.69 to 0.71 from 250 to 600 K.
const PRANDTL: f64 = 0.7;
/// Largest Reynolds number ΩD²/(2ν) that the law of [`cylinder_in_air`] was fitted to.
pub const LARGEST_REYNOLDS: f64 = 4.3e5;
/// Reynolds number from which on buoyancy has no part in it.
const FAST: f64 = 1.5e4;

/// Conductivity of air: 2.646e-3 T^1.5/(T + 245.4 · 10^(−12/T)), W/(m K).
///
/// - `temperature`: K
///
/// Source: U.S. Standard Atmosphere 1976 (from memory); 0.0262 at 300 K.
/// Valid: 200 to 700 K, pressures at which it does not depend on them.
pub fn conductivity(temperature: f64) -> f64 {
    2.64638e-3 * temperature.powf(1.5) / (temperature + 245.4 * 10f64.powf(-12.0 / temperature))
}

/// Kinematic viscosity of air: 1.458e-6 T^1.5/(T + 110.4) over its density, m²/s.
///
/// - `temperature`: K; `pressure`: Pa
///
/// Source: Sutherland's law, U.S. Standard Atmosphere 1976 (from memory).
/// Valid: as [`conductivity`]; ideal gas.
pub fn viscosity(temperature: f64, pressure: f64) -> f64 {
    let dynamic = 1.458e-6 * temperature.powf(1.5) / (temperature + 110.4);
    dynamic * GAS_CONSTANT * temperature / (AIR_MOLAR_MASS * pressure)
}

/// Heat transfer through the gap between a cylinder and the bore it lies in, mean all round: k/√(s (s + 2c)), s = s₀ + k/h_fm, W/(m² K).
///
/// - `clearance`: radial c, m; 0 for surfaces that are pressed together
/// - `nearest`: distance s₀ of the mean planes of both surfaces where they touch, m
/// - `pressure`: Pa; `temperature`: of the gas, K
///
/// Source: derived: mean of k/(s + c (1 − cos φ)), conduction in series with [`free_molecular_air`].
/// Valid: c small beside the radius; gas that is not stirred; each surface of one temperature all round.
pub fn gap_transfer(clearance: f64, nearest: f64, pressure: f64, temperature: f64) -> f64 {
    if pressure <= 0.0 {
        return 0.0;
    }
    let k = conductivity(temperature);
    let least = nearest + k / free_molecular_air(ACCOMMODATION, pressure, temperature);
    k / (least * (least + 2.0 * clearance)).sqrt()
}

/// Reynolds number ΩD²/(2ν) of a cylinder that turns in air.
///
/// - `diameter`: m; `speed`: rad/s; `temperature`: of the air, K; `pressure`: Pa
///
/// Source: definition.
/// Valid: always.
pub fn reynolds(diameter: f64, speed: f64, temperature: f64, pressure: f64) -> f64 {
    speed.abs() * diameter * diameter / (2.0 * viscosity(temperature, pressure))
}

/// Heat transfer of a horizontal cylinder in open air, W/(m² K): the larger of still air and stirred air, in series with h_fm.
///
/// Formula: still Nu = (0.6 + 0.387 Ra^⅙/[1 + (0.559/Pr)^(9/16)]^(8/27))²; turning Nu = 0.095 (½ Re² + Gr)^0.35 to
/// Re 1.5e4, then 0.073 Re^0.7; 1/h = D/(Nu k) + 1/h_fm
///
/// - `diameter`: m; `speed`: rad/s; `temperatures`: of surface and air, K; `pressure`: Pa
///
/// Source: S. W. Churchill, H. H. S. Chu 1975; D. Dropkin, A. Carmi 1957 (both from memory).
/// Valid: Ra 1e-5 to 1e12; Re to [`LARGEST_REYNOLDS`].
pub fn cylinder_in_air(diameter: f64, speed: f64, temperatures: [f64; 2], pressure: f64) -> f64 {
    if pressure <= 0.0 {
        return 0.0;
    }
    let film = 0.5 * (temperatures[0] + temperatures[1]);
    let nu = viscosity(film, pressure);
    let warmer = (temperatures[0] - temperatures[1]).abs() / film;
    let grashof = STANDARD_GRAVITY * warmer * diameter.powi(3) / (nu * nu);
    let fluid = (1.0 + (0.559 / PRANDTL).powf(9.0 / 16.0)).powf(8.0 / 27.0);
    let still = (0.6 + 0.387 * (grashof * PRANDTL).powf(1.0 / 6.0) / fluid).powi(2);
    let turns = reynolds(diameter, speed, film, pressure);
    let stirred = match turns < FAST {
        true => 0.095 * (0.5 * turns * turns + grashof).powf(0.35),
        false => 0.073 * turns.powf(0.7),
    };
    let thick = still.max(stirred) * conductivity(film) / diameter;
    let thin = free_molecular_air(ACCOMMODATION, pressure, film);
    thick * thin / (thick + thin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn air_is_that_of_the_tables() {
        // 300 K and 400 K: 0.0263 and 0.0338 W/(m K), 15.9e-6 and 26.4e-6 m²/s
        for (kelvin, k, nu) in [(300.0, 0.0263, 15.9e-6), (400.0, 0.0338, 26.4e-6)] {
            assert!((conductivity(kelvin) / k - 1.0).abs() < 0.01);
            assert!((viscosity(kelvin, 1e5) / nu - 1.0).abs() < 0.02);
        }
    }

    #[test]
    fn a_gap_is_the_mean_all_round_and_free_flight_in_thin_gas() {
        let (c, s, p, t) = (0.25e-3, 2.4e-6, 1e5, 320.0);
        let jump = conductivity(t) / free_molecular_air(1.0, p, t);
        let places = 200_000;
        let local = |k: usize| {
            let angle = TAU * (k as f64 + 0.5) / f64::from(places as u32);
            conductivity(t) / (s + jump + c * (1.0 - angle.cos()))
        };
        let mean = (0..places).map(local).sum::<f64>() / f64::from(places as u32);
        assert!((gap_transfer(c, s, p, t) / mean - 1.0).abs() < 1e-6);
        // 1.17 W/m²K per Pa at 300 K, whatever the gap
        let thin = gap_transfer(c, s, 0.1, 300.0);
        assert!((thin / 0.117 - 1.0).abs() < 0.01, "{thin}");
        assert_eq!(gap_transfer(c, s, 0.0, 300.0), 0.0);
    }

    #[test]
    fn open_air_takes_what_is_usual_and_less_the_thinner_it_is() {
        // 94 mm, 40 K above the room: 5 to 7 W/(m² K) without radiation
        let at = |speed, pressure| cylinder_in_air(0.094, speed, [340.0, 300.0], pressure);
        assert!((5.0..7.0).contains(&at(0.0, 1e5)), "{}", at(0.0, 1e5));
        assert!(at(40.0, 1e5) > 1.5 * at(0.0, 1e5));
        // both laws of a turning cylinder meet within 4 % at Re 1.5e4, 61 rad/s here
        let meet = 2.0 * FAST * viscosity(320.0, 1e5) / (0.094f64 * 0.094);
        let [below, above] = [0.9999, 1.0001].map(|share| at(share * meet, 1e5));
        assert!((above / below - 1.0).abs() < 0.04, "{below} {above}");
        let thinner = [1e5, 1e3, 10.0, 1e-3].map(|pressure| at(0.0, pressure));
        assert!(thinner.windows(2).all(|two| two[1] < two[0]), "{thinner:?}");
        let free = free_molecular_air(1.0, 1e-3, 320.0);
        assert!((thinner[3] / free - 1.0).abs() < 0.02);
        assert_eq!(at(40.0, 0.0), 0.0);
    }
}
