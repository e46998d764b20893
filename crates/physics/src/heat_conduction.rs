//! Heat that flows into a body: half-space, slab, bodies that touch.

use crate::materials::{BEARING_STEEL, BEARING_STEEL_SPECIFIC_HEAT, SILICON_NITRIDE};
use std::f64::consts::PI;

/// Conductivity, density and specific heat of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThermalMaterial {
    /// Conductivity k, W/(m K).
    pub conductivity: f64,
    /// Density ρ, kg/m³.
    pub density: f64,
    /// Specific heat c, J/(kg K).
    pub specific_heat: f64,
}

/// Bearing steel: 46 W/(m K), 7850 kg/m³, 460 J/(kg K).
///
/// Source: 40 to 50 W/(m K), 450 to 480 J/(kg K).
pub const STEEL_HEAT: ThermalMaterial = ThermalMaterial {
    conductivity: 46.0,
    density: BEARING_STEEL.density,
    specific_heat: BEARING_STEEL_SPECIFIC_HEAT,
};

/// Silicon nitride: 35 W/(m K), 3190 kg/m³, 800 J/(kg K).
///
/// Source: 30 to 40 W/(m K), 680 to 800 J/(kg K).
pub const SILICON_NITRIDE_HEAT: ThermalMaterial = ThermalMaterial {
    conductivity: 35.0,
    density: SILICON_NITRIDE.density,
    specific_heat: 800.0,
};

impl ThermalMaterial {
    /// Diffusivity α = k/(ρ c), m²/s.
    ///
    /// Source: definition.
    /// Valid: any body.
    pub fn diffusivity(&self) -> f64 {
        self.conductivity / (self.density * self.specific_heat)
    }
    /// Effusivity e = √(k ρ c), W √s/(m² K): what a surface takes up in a short time.
    ///
    /// Source: definition.
    /// Valid: any body.
    pub fn effusivity(&self) -> f64 {
        (self.conductivity * self.density * self.specific_heat).sqrt()
    }
}

/// Complement of the error function for x ≥ 0: power series below 2, continued fraction above.
///
/// Source: Abramowitz and Stegun 7.1.6 and 7.1.14 (from memory: check before quoting).
/// Valid: x ≥ 0.
pub fn erfc(x: f64) -> f64 {
    let gauss = (-x * x).exp();
    if x < 2.0 {
        let (mut term, mut sum, mut n) = (x, x, 0.0);
        while term > 1e-18 * sum {
            n += 1.0;
            term *= 2.0 * x * x / (2.0 * n + 1.0);
            sum += term;
        }
        return 1.0 - 2.0 / PI.sqrt() * gauss * sum;
    }
    let tail = (1..=120)
        .rev()
        .fold(x, |below, n| x + 0.5 * f64::from(n) / below);
    gauss / (PI.sqrt() * tail)
}

/// Integral of erfc from x to infinity: e^(−x²)/√π − x erfc x.
///
/// Source: definition.
/// Valid: x ≥ 0.
pub fn ierfc(x: f64) -> f64 {
    (-x * x).exp() / PI.sqrt() - x * erfc(x)
}

/// Rise at a depth of a half-space under a constant flux: (2q√(αt)/k) ierfc(z/(2√(αt))), K.
///
/// Arguments: flux W/m², time s, depth m.
///
/// Source: derived.
/// Valid: depth well inside the body, time > 0.
pub fn half_space_rise(material: ThermalMaterial, flux: f64, time: f64, depth: f64) -> f64 {
    let spread = (material.diffusivity() * time).sqrt();
    2.0 * flux * spread / material.conductivity * ierfc(depth / (2.0 * spread))
}

/// Rise at a depth below the heated face of a slab with an insulated back, K.
///
/// Arguments: flux W/m², thickness m, time s, depth m from the heated face. By images below αt = 0.05 L², where the
/// series is rounding noise; by the series above.
///
/// Source: derived.
/// Valid: 0 ≤ depth ≤ thickness, time > 0.
pub fn slab_rise(
    material: ThermalMaterial,
    flux: f64,
    thickness: f64,
    time: f64,
    depth: f64,
) -> f64 {
    let fourier = material.diffusivity() * time / (thickness * thickness);
    if fourier < 0.05 {
        let spread = (material.diffusivity() * time).sqrt();
        let images: f64 = (0..8)
            .map(|j| {
                let near = 2.0 * f64::from(j) * thickness + depth;
                let far = 2.0 * f64::from(j + 1) * thickness - depth;
                ierfc(near / (2.0 * spread)) + ierfc(far / (2.0 * spread))
            })
            .sum();
        return 2.0 * flux * spread / material.conductivity * images;
    }
    let from_back = (thickness - depth) / thickness;
    // e^(−n²π²·0.05) is below 1e-21 from n = 10 on; 30 terms serve every longer time.
    let series: f64 = (1..=30)
        .map(|n| {
            let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
            let n = f64::from(n);
            sign / (n * n) * (-n * n * PI * PI * fourier).exp() * (n * PI * from_back).cos()
        })
        .sum();
    flux * thickness / material.conductivity
        * (fourier + (3.0 * from_back * from_back - 1.0) / 6.0 - 2.0 / (PI * PI) * series)
}

/// Temperature of the common face of two half-spaces that touch: (e₁T₁ + e₂T₂)/(e₁ + e₂).
///
/// Source: derived.
/// Valid: perfect contact, times before a back face is felt.
pub fn touch_temperature(
    first: ThermalMaterial,
    second: ThermalMaterial,
    first_temperature: f64,
    second_temperature: f64,
) -> f64 {
    let (a, b) = (first.effusivity(), second.effusivity());
    (a * first_temperature + b * second_temperature) / (a + b)
}

/// Effusivity of two bodies in series: e₁e₂/(e₁ + e₂).
///
/// Source: derived, equal flux from both sides.
/// Valid: perfect contact.
pub fn joint_effusivity(first: ThermalMaterial, second: ThermalMaterial) -> f64 {
    let (a, b) = (first.effusivity(), second.effusivity());
    a * b / (a + b)
}

/// Flux between two half-spaces at a time after they touched: e₁₂ (T₁ − T₂)/√(πt), W/m².
///
/// Source: derived.
/// Valid: as [`touch_temperature`].
pub fn touch_flux(
    first: ThermalMaterial,
    second: ThermalMaterial,
    difference: f64,
    time: f64,
) -> f64 {
    joint_effusivity(first, second) * difference / (PI * time).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: ThermalMaterial = ThermalMaterial {
        conductivity: 46.0,
        density: 7850.0,
        specific_heat: 460.0,
    };

    #[test]
    fn erfc_agrees_with_printed_digits_and_across_its_seam() {
        for (x, printed) in [
            (0.5, 0.479500122),
            (1.0, 0.157299207),
            (3.0, 2.209049700e-5),
        ] {
            assert!((erfc(x) / printed - 1.0).abs() < 3e-9, "{x}");
        }
        assert!((erfc(2.0) / erfc(2.0 - 1e-12) - 1.0).abs() < 1e-10);
    }

    #[test]
    fn images_and_series_of_the_slab_meet() {
        let thickness = 0.004;
        let seam = 0.05 * thickness * thickness / STEEL.diffusivity();
        for depth in [0.0, 0.001, 0.004] {
            let (before, after) = (
                slab_rise(STEEL, 1e5, thickness, seam * (1.0 - 1e-12), depth),
                slab_rise(STEEL, 1e5, thickness, seam * (1.0 + 1e-12), depth),
            );
            assert!((before - after).abs() < 1e-10, "{depth}: {before} {after}");
        }
    }

    #[test]
    fn the_mean_rise_of_a_slab_holds_the_heat_put_in() {
        let (thickness, flux) = (0.003, 2e5);
        for time in [0.005, 0.05, 0.5] {
            let n = 400;
            let mean: f64 = (0..n)
                .map(|i| {
                    let depth = thickness * (f64::from(i) + 0.5) / f64::from(n);
                    slab_rise(STEEL, flux, thickness, time, depth)
                })
                .sum::<f64>()
                / f64::from(n);
            let stored = mean * thickness * STEEL.density * STEEL.specific_heat;
            assert!((stored / (flux * time) - 1.0).abs() < 1e-4, "{time}");
        }
    }

    #[test]
    fn equal_temperatures_exchange_nothing() {
        assert_eq!(touch_flux(STEEL, STEEL, 0.0, 1e-3), 0.0);
        assert!((touch_temperature(STEEL, STEEL, 40.0, 40.0) - 40.0).abs() < 1e-12);
    }
}
