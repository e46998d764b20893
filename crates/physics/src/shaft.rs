//! What a shaft is made of: round sections, elastic materials, pieces of a drawing.

/// Outer and inner diameter of a round section, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Annulus {
    /// Outer diameter, m.
    pub outer: f64,
    /// Inner diameter, m; zero where solid.
    pub inner: f64,
}

impl Annulus {
    /// Area π(d_o² - d_i²)/4, m².
    ///
    /// Source: geometry.
    /// Valid: always.
    pub fn area(&self) -> f64 {
        std::f64::consts::FRAC_PI_4 * (self.outer.powi(2) - self.inner.powi(2))
    }

    /// Second moment of area about a diameter, π(d_o⁴ - d_i⁴)/64, m⁴.
    ///
    /// Source: geometry.
    /// Valid: always.
    pub fn second_moment(&self) -> f64 {
        std::f64::consts::PI / 64.0 * (self.outer.powi(4) - self.inner.powi(4))
    }

    /// The section at `share` of the way to another.
    ///
    /// Source: diameters linear along a taper.
    /// Valid: `share` from 0 to 1.
    pub fn towards(&self, other: &Self, share: f64) -> Self {
        let between = |a: f64, b: f64| a + (b - a) * share;
        Self {
            outer: between(self.outer, other.outer),
            inner: between(self.inner, other.inner),
        }
    }
}

/// An isotropic elastic material of a shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    ///
    /// Source: linear elasticity.
    /// Valid: isotropic.
    pub fn new(young: f64, poisson: f64, density: f64) -> Self {
        Self {
            young,
            shear: young / (2.0 * (1.0 + poisson)),
            density,
        }
    }

    /// Poisson's ratio E/(2G) - 1.
    ///
    /// Source: linear elasticity.
    /// Valid: isotropic.
    pub fn poisson(&self) -> f64 {
        self.young / (2.0 * self.shear) - 1.0
    }
}

/// A piece of shaft, as a drawing gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Position of its left end, m.
    pub from: f64,
    /// Position of its right end, m.
    pub to: f64,
    /// Section at its left end.
    pub start: Annulus,
    /// Section at its right end.
    pub end: Annulus,
    /// What it is made of.
    pub material: Material,
    /// Longest element that it is divided into, m.
    pub longest: f64,
    /// Whether it bends with the shaft; one that does not adds mass alone.
    pub carries: bool,
    /// Non-rotating damping as a multiple of its mass matrix, 1/s.
    pub damping_of_mass: f64,
    /// Non-rotating damping as a multiple of its stiffness matrix, s.
    pub damping_of_stiffness: f64,
    /// Rotating damping (of the material, of shrink fits) as a multiple of its stiffness matrix, s.
    pub damping_rotating: f64,
}

/// Positions closer than this are one node, m: far below any drawing, far above rounding.
pub const SAME_PLACE: f64 = 1e-9;

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
