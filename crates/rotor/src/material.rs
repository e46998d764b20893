//! What a shaft is made of.

/// An isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Young's modulus, Pa.
    pub young: f64,
    /// Shear modulus, Pa.
    pub shear: f64,
    /// Density, kg/m³.
    pub density: f64,
}

impl Material {
    /// A material by Young's modulus (Pa), Poisson's ratio and density (kg/m³): shear modulus E/(2(1 + ν)).
    #[must_use]
    pub fn new(young: f64, poisson: f64, density: f64) -> Self {
        Self {
            young,
            shear: young / (2.0 * (1.0 + poisson)),
            density,
        }
    }

    /// Poisson's ratio, from both moduli.
    #[must_use]
    pub fn poisson(&self) -> f64 {
        self.young / (2.0 * self.shear) - 1.0
    }
}

/// Materials by name: Young's modulus Pa, Poisson's ratio, density kg/m³, and where the numbers are from.
///
/// Values at room temperature, as handbooks round them. A drawing's own values belong into the file.
pub const MATERIALS: [(&str, f64, f64, f64, &str); 5] = [
    (
        "steel",
        206e9,
        0.30,
        7850.0,
        "carbon and low-alloy steel, room temperature, rounded handbook value",
    ),
    (
        "stainless_steel",
        200e9,
        0.30,
        7900.0,
        "austenitic steel 1.4301, room temperature, rounded handbook value",
    ),
    (
        "titanium",
        114e9,
        0.33,
        4430.0,
        "Ti-6Al-4V, grade 5, room temperature, rounded handbook value",
    ),
    (
        "aluminium",
        71e9,
        0.33,
        2800.0,
        "wrought alloys of the 7000 series, rounded handbook value",
    ),
    (
        "nickel_alloy",
        205e9,
        0.29,
        8190.0,
        "Inconel 718, aged, room temperature, rounded handbook value",
    ),
];
