//! One piece of shaft between two neighbouring nodes.
//!
//! Two nodes, Timoshenko's beam, solid or hollow, diameters linear along it. Displacement and slope of the element come
//! from the four coordinates of its ends by shape functions that are exact for an end-loaded prismatic beam, with the ratio
//! Φ = 12EI/(κGAL²) of bending to shear stiffness taken from the middle of a tapered element. The integrands are
//! polynomials of degree eight at most, so six Gauss points are exact.
//!
//! Source: consistent matrices of a two-node Timoshenko element; shear coefficient κ of Cowper (1966) for a hollow
//! circle. Where rotary inertia matters natural frequencies converge with the square of the length of the elements.

use crate::{Annulus, Material};
use nalgebra::{Matrix4, RowVector4};

/// A piece of shaft from node `left` to the next node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Element {
    /// Node at its left end; its right end is at the next node.
    pub left: usize,
    /// Length, m.
    pub length: f64,
    /// Section at its left end.
    pub start: Annulus,
    /// Section at its right end.
    pub end: Annulus,
    /// What it is made of.
    pub material: Material,
    /// Whether it bends with the shaft; a sleeve that is only pushed on adds mass and inertia alone.
    pub carries: bool,
    /// Non-rotating damping as a multiple of the element's mass matrix, 1/s.
    pub damping_of_mass: f64,
    /// Non-rotating damping as a multiple of the element's stiffness matrix, s.
    pub damping_of_stiffness: f64,
    /// Rotating damping (of the material, of shrink fits) as a multiple of the element's stiffness matrix, s.
    pub damping_rotating: f64,
}

/// Matrices of one element for (w, ψ) of its left and its right node.
#[derive(Debug, Clone, Copy)]
pub struct ElementMatrices {
    /// Mass: kg, kg m, kg m².
    pub mass: Matrix4<f64>,
    /// Stiffness: N/m, N, N m.
    pub stiffness: Matrix4<f64>,
    /// Gyroscopic matrix, multiplies -jΩq̇: kg, kg m, kg m².
    pub gyroscopic: Matrix4<f64>,
}

/// Abscissas on 0..1 and weights of Gauss's rule with six points.
const GAUSS: [(f64, f64); 6] = [
    (0.033_765_242_898_423_99, 0.085_662_246_189_585_17),
    (0.169_395_306_766_867_74, 0.180_380_786_524_069_3),
    (0.380_690_406_958_401_56, 0.233_956_967_286_345_52),
    (0.619_309_593_041_598_4, 0.233_956_967_286_345_52),
    (0.830_604_693_233_132_3, 0.180_380_786_524_069_3),
    (0.966_234_757_101_576, 0.085_662_246_189_585_17),
];

impl Element {
    /// The section half way.
    #[must_use]
    pub fn middle(&self) -> Annulus {
        self.start.towards(&self.end, 0.5)
    }

    /// Cowper's shear coefficient of the middle section.
    ///
    /// Formula: κ = 6(1+ν)(1+m²)² / [(7+6ν)(1+m²)² + (20+12ν)m²],  m = d_i/d_o
    #[must_use]
    pub fn shear_coefficient(&self) -> f64 {
        let nu = self.material.poisson();
        let middle = self.middle();
        let m2 = (middle.inner / middle.outer).powi(2);
        let ring = (1.0 + m2).powi(2);
        6.0 * (1.0 + nu) * ring / ((7.0 + 6.0 * nu) * ring + (20.0 + 12.0 * nu) * m2)
    }

    /// Ratio of bending to shear stiffness, Φ = 12EI/(κGAL²), at the middle.
    #[must_use]
    pub fn shear_ratio(&self) -> f64 {
        let middle = self.middle();
        12.0 * self.material.young * middle.second_moment()
            / (self.shear_coefficient() * self.material.shear * middle.area() * self.length.powi(2))
    }

    /// Mass, stiffness and gyroscopic matrix.
    #[must_use]
    pub fn matrices(&self) -> ElementMatrices {
        self.matrices_in(self.shear_ratio())
    }

    /// The same in the shapes of a shaft of this shear ratio: a sleeve that only adds mass moves as the shaft it rides on.
    #[must_use]
    pub fn matrices_in(&self, shear_ratio: f64) -> ElementMatrices {
        let Material {
            young,
            shear,
            density,
        } = self.material;
        let (phi, kappa) = (shear_ratio, self.shear_coefficient());
        let mut out = ElementMatrices {
            mass: Matrix4::zeros(),
            stiffness: Matrix4::zeros(),
            gyroscopic: Matrix4::zeros(),
        };
        for (s, weight) in GAUSS {
            let at = self.start.towards(&self.end, s);
            let shapes = Shapes::at(s, self.length, phi);
            let step = weight * self.length;
            let rotary =
                shapes.slope.transpose() * shapes.slope * (density * at.second_moment() * step);
            out.mass += shapes.displacement.transpose()
                * shapes.displacement
                * (density * at.area() * step)
                + rotary;
            out.gyroscopic += rotary * 2.0;
            if self.carries {
                out.stiffness += shapes.curvature.transpose()
                    * shapes.curvature
                    * (young * at.second_moment() * step)
                    + shapes.shear.transpose() * shapes.shear * (kappa * shear * at.area() * step);
            }
        }
        out
    }
}

/// Rows that give displacement, slope, curvature and shear angle from the four end coordinates.
struct Shapes {
    displacement: RowVector4<f64>,
    slope: RowVector4<f64>,
    curvature: RowVector4<f64>,
    shear: RowVector4<f64>,
}

impl Shapes {
    fn at(s: f64, length: f64, phi: f64) -> Self {
        let c = 1.0 / (1.0 + phi);
        let (s2, s3) = (s * s, s * s * s);
        Self {
            displacement: RowVector4::new(
                1.0 - 3.0 * s2 + 2.0 * s3 + phi * (1.0 - s),
                length * (s - 2.0 * s2 + s3 + phi * (s - s2) / 2.0),
                3.0 * s2 - 2.0 * s3 + phi * s,
                length * (s3 - s2 + phi * (s2 - s) / 2.0),
            ) * c,
            slope: RowVector4::new(
                6.0 * (s2 - s) / length,
                1.0 - 4.0 * s + 3.0 * s2 + phi * (1.0 - s),
                6.0 * (s - s2) / length,
                3.0 * s2 - 2.0 * s + phi * s,
            ) * c,
            curvature: RowVector4::new(
                6.0 * (2.0 * s - 1.0) / length,
                6.0 * s - 4.0 - phi,
                6.0 * (1.0 - 2.0 * s) / length,
                6.0 * s - 2.0 + phi,
            ) * (c / length),
            shear: RowVector4::new(-1.0 / length, -0.5, 1.0 / length, -0.5) * (c * phi),
        }
    }
}
