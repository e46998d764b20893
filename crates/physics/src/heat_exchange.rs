//! Conductances between bodies: contacts of ball and race, walls, fits, gas, radiation, surroundings.

use crate::heat_conduction::{ThermalMaterial, joint_effusivity};
use crate::hertz::carlson_rf;
use std::f64::consts::PI;

/// Stefan and Boltzmann's constant, W/(m² K⁴).
/// Source: derived; book/src/theory/heat.md.
pub const STEFAN_BOLTZMANN: f64 = 5.670374419e-8;
/// Molar gas constant, J/(mol K), in the digits of the reference cases.
pub const GAS_CONSTANT: f64 = 8.31446;
/// Molar mass of air, kg/mol.
pub const AIR_MOLAR_MASS: f64 = 0.02896;
/// Adiabatic exponent of air.
pub const AIR_ADIABATIC_EXPONENT: f64 = 1.4;

/// Resistance of one half-space below an isothermal ellipse: R_F(0, (b/a)², 1)/(2πka), K/W; 1/(4ka) for a circle.
///
/// Arguments: semi-axes a ≥ b in m, conductivity W/(m K).
///
/// Source: Carlson's form of the
/// elliptic integral.
/// Valid: contact at rest, small beside the body.
pub fn constriction_resistance(semi_major: f64, semi_minor: f64, conductivity: f64) -> f64 {
    ellipse_integral(semi_major, semi_minor) / (2.0 * PI * conductivity * semi_major)
}

/// Mean rise per watt of an ellipse under uniform flux: 16 R_F(0, (b/a)², 1)/(3π³ka), K/W.
///
/// Source: derived from the mean of the potential of a uniform ellipse.
/// Valid: as [`constriction_resistance`].
pub fn uniform_flux_resistance(semi_major: f64, semi_minor: f64, conductivity: f64) -> f64 {
    16.0 * ellipse_integral(semi_major, semi_minor) / (3.0 * PI.powi(3) * conductivity * semi_major)
}

fn ellipse_integral(semi_major: f64, semi_minor: f64) -> f64 {
    carlson_rf(0.0, (semi_minor / semi_major).powi(2), 1.0)
}

/// Conductance of a ball/race contact, its two limits and the blend of both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactConductance {
    /// At rest: both constrictions in series, W/K.
    pub at_rest: f64,
    /// Rolling fast: fresh surfaces pass each other, W/K.
    pub rolling: f64,
}

impl ContactConductance {
    /// Of an elliptic contact with axis a across the groove and b along the motion, at the surface speed U past it.
    ///
    /// At rest 1/(R₁ + R₂); rolling 2 B(½, 5/4) √(2/π) a e₁₂ √(bU).
    ///
    /// Source: derived; each point of the patch is a pair of half-spaces that touch for its time of passage.
    /// Valid: elastic ellipse, bulk temperatures at each passage.
    pub fn of_ellipse(
        semi_major: f64,
        semi_minor: f64,
        speed: f64,
        first: ThermalMaterial,
        second: ThermalMaterial,
    ) -> Self {
        let resistance = |body: ThermalMaterial| {
            constriction_resistance(semi_major, semi_minor, body.conductivity)
        };
        // B(½, 5/4)
        const BETA: f64 = 1.748_038_369_528_079_9;
        Self {
            at_rest: 1.0 / (resistance(first) + resistance(second)),
            rolling: 2.0
                * BETA
                * (2.0 / PI).sqrt()
                * semi_major
                * joint_effusivity(first, second)
                * (semi_minor * speed).sqrt(),
        }
    }
    /// √(G_s² + G_m²), W/K: within 1.5 % of the exact one for a/b ≥ 3, 5.5 % for a circle.
    ///
    /// Source: compared with boundary elements.
    /// Valid: Ub/2α to 4; above, the rolling limit rules and is exact.
    pub fn blend(&self) -> f64 {
        self.at_rest.hypot(self.rolling)
    }
    /// The blend in series with a film: 1/G = 1/G_blend + h/(k_f πab), W/K.
    ///
    /// Arguments: film thickness m, conductivity of the film W/(m K).
    ///
    /// Source: resistances in series.
    /// Valid: film thin beside the ellipse.
    pub fn with_film(&self, thickness: f64, conductivity: f64, semi_axes: [f64; 2]) -> f64 {
        let film = thickness / (conductivity * PI * semi_axes[0] * semi_axes[1]);
        1.0 / (1.0 / self.blend() + film)
    }
}

/// Conductance of a line contact rolling without slip: 2 L e₁₂ √(2bU/π), W/K.
///
/// Arguments: length m, half-width b m, speed U m/s.
///
/// Source: derived as [`ContactConductance`].
/// Valid: smooth surfaces.
pub fn rolling_line_conductance(
    length: f64,
    half_width: f64,
    speed: f64,
    first: ThermalMaterial,
    second: ThermalMaterial,
) -> f64 {
    2.0 * length * joint_effusivity(first, second) * (2.0 * half_width * speed / PI).sqrt()
}

/// Half-width of the contact of a rotor in the bore of a race: √(4NR'/(πLE*)), R' = R₀(R₀ − c₀)/c₀, m.
///
/// Arguments: normal force N, bore radius and radial clearance m, length m, contact modulus E* Pa.
///
/// Source: H. Hertz 1881.
/// Valid: b < 0.1 R₀, c₀/R₀ > 1e-3; edges and tilt not modelled.
pub fn line_half_width(force: f64, bore: f64, clearance: f64, length: f64, modulus: f64) -> f64 {
    let radius = bore * (bore - clearance) / clearance;
    (4.0 * force * radius / (PI * length * modulus)).sqrt()
}

/// Whether that half-width, m, is one of the law's range in a bore of this radius with this radial clearance, m.
///
/// Source: derived; book/src/theory/heat.md.
/// Valid: as [`line_half_width`].
pub fn line_holds(half_width: f64, bore: f64, clearance: f64) -> bool {
    half_width < 0.1 * bore && clearance > 1e-3 * bore
}

/// Conductance through the wall of a tube: 2πkL/ln(r₂/r₁), W/K.
///
/// Source: derived.
/// Valid: steady, no flow along the axis.
pub fn cylinder_wall(conductivity: f64, length: f64, inner: f64, outer: f64) -> f64 {
    2.0 * PI * conductivity * length / (outer / inner).ln()
}

/// Ground surfaces: roughness, m, slope of both combined, and hardness of the softer body, Pa. Source: usual ground steel,
/// assumed; book/src/theory/heat.md.
pub const GROUND_STEEL: (f64, f64, f64) = (0.8e-6, 0.1, 3e9);

/// Conductance of a pressed joint of rough surfaces: 1.25 k_s (m/σ)(p/H)^0.95, k_s = 2k₁k₂/(k₁ + k₂), W/(m² K).
///
/// Arguments: conductivities W/(m K); roughness σ m and slope m of both surfaces combined; pressure and hardness of the
/// softer body, Pa.
///
/// Source: Cooper, Mikic and Yovanovich 1969.
/// Valid: p/H 1e-6 to 2e-2 (from memory: check before quoting).
pub fn pressed_joint(
    conductivities: [f64; 2],
    roughness: f64,
    slope: f64,
    pressure: f64,
    hardness: f64,
) -> f64 {
    let [first, second] = conductivities;
    let harmonic = 2.0 * first * second / (first + second);
    1.25 * harmonic * (slope / roughness) * (pressure / hardness).powf(0.95)
}

/// Conductance of air so thin that molecules fly from wall to wall: α (γ+1)/(γ−1) √(R/(8πMT)) p, W/(m² K).
///
/// Arguments: accommodation α, pressure Pa, temperature K.
///
/// Source: kinetic theory of a diatomic gas.
/// Valid: mean free path long beside the gap; else in series with the continuum value.
pub fn free_molecular_air(accommodation: f64, pressure: f64, temperature: f64) -> f64 {
    let gamma = AIR_ADIABATIC_EXPONENT;
    accommodation * (gamma + 1.0) / (gamma - 1.0)
        * (GAS_CONSTANT / (8.0 * PI * AIR_MOLAR_MASS * temperature)).sqrt()
        * pressure
}

/// Power radiated between coaxial cylinders: σA₁(T₁⁴ − T₂⁴)/(1/ε₁ + (A₁/A₂)(1/ε₂ − 1)), W.
///
/// Arguments, the inner body first: temperatures K, areas m², emissivities.
///
/// Source: derived.
/// Valid: diffuse grey surfaces, ends closed.
pub fn coaxial_radiation(temperatures: [f64; 2], areas: [f64; 2], emissivities: [f64; 2]) -> f64 {
    radiation_conductance(temperatures, areas, emissivities) * (temperatures[0] - temperatures[1])
}

/// The same over the difference of the temperatures, W/K: σA₁(T₁² + T₂²)(T₁ + T₂)/(1/ε₁ + (A₁/A₂)(1/ε₂ − 1)).
///
/// Arguments as those of [`coaxial_radiation`]; an infinite second area is a room.
///
/// Source: derived.
/// Valid: exact at these temperatures; as [`coaxial_radiation`].
pub fn radiation_conductance(
    temperatures: [f64; 2],
    areas: [f64; 2],
    emissivities: [f64; 2],
) -> f64 {
    let resistance = 1.0 / emissivities[0] + areas[0] / areas[1] * (1.0 / emissivities[1] - 1.0);
    let [first, second] = temperatures;
    let slope = (first * first + second * second) * (first + second);
    STEFAN_BOLTZMANN * areas[0] * slope / resistance
}

/// Conductance of a mounted radial bearing to its surroundings: 320 W/(m² K) · πB(D + d), W/K; above 0.05 m² times
/// (A/0.05 m²)^−0.34.
///
/// Arguments: bore, outside diameter and width, m.
///
/// Source: ISO 15312, 0.016 W/mm² at 50 K.
/// Valid: in air, not in vacuum.
pub fn to_surroundings(bore: f64, outside: f64, width: f64) -> f64 {
    let area = PI * width * (outside + bore);
    320.0 * area * (area / 0.05).max(1.0).powf(-0.34)
}

/// Heat transfer of a stream along a surface: 0.332 k Pr^⅓ √(u/(νx)), W/(m² K).
///
/// Arguments: speed of the stream m/s, length along it m, conductivity W/(m K), kinematic viscosity m²/s, ρc J/(m³ K).
///
/// Source: laminar flat plate (a well-known book prints 0.0332, a tenth, which nobody settles).
/// Valid: laminar; of a bearing u is a third of the cage's surface speed, x its pitch diameter.
pub fn stream_transfer(
    speed: f64,
    length: f64,
    conductivity: f64,
    viscosity: f64,
    volumetric_heat: f64,
) -> f64 {
    let prandtl = viscosity * volumetric_heat / conductivity;
    0.332 * conductivity * prandtl.cbrt() * (speed / (viscosity * length)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_constricts_as_printed_and_radiation_runs_downhill() {
        assert!(
            (constriction_resistance(1e-3, 1e-3, 46.0) * 4.0 * 46.0 * 1e-3 - 1.0).abs() < 1e-12
        );
        assert_eq!(
            coaxial_radiation([300.0, 300.0], [1e-3, 2e-3], [0.3, 0.8]),
            0.0
        );
        let power = |a, b| coaxial_radiation([a, b], [1e-3, 2e-3], [0.3, 0.8]);
        assert!(power(310.0, 300.0) > 0.0 && power(300.0, 310.0) < 0.0);
    }

    #[test]
    fn area_rule_of_the_surroundings_has_no_step() {
        // πB(D + d) = 0.05 m² at B 0.05 m and D + d = 1/π m.
        let sum = 1.0 / PI;
        let (below, above) = (
            to_surroundings(0.4 * sum, 0.6 * sum * (1.0 - 1e-9), 0.05),
            to_surroundings(0.4 * sum, 0.6 * sum * (1.0 + 1e-9), 0.05),
        );
        assert!((above / below - 1.0).abs() < 1e-8);
    }
}
