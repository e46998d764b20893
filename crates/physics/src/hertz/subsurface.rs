//! Stresses under the middle of a Hertz contact.

use super::{PointContact, carlson_rd};

/// Principal stresses under the middle of the contact ellipse, Pa; compression is negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisStress {
    /// Along the long axis of the ellipse.
    pub along_major: f64,
    /// Along the short axis of the ellipse.
    pub along_minor: f64,
    /// Normal to the surface.
    pub normal: f64,
}

impl AxisStress {
    /// Maximum shear stress at this point, Pa.
    ///
    /// Formula: τ = (σ_largest - σ_smallest)/2
    ///
    /// Source: statics (Mohr's circle).
    /// Valid: the three stresses are principal stresses, as they are on the axis.
    pub fn maximum_shear(&self) -> f64 {
        let largest = self.along_major.max(self.along_minor).max(self.normal);
        let smallest = self.along_major.min(self.along_minor).min(self.normal);
        0.5 * (largest - smallest)
    }
}

/// The largest shear stress under a contact and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaximumShear {
    /// Maximum shear stress, Pa.
    pub shear: f64,
    /// Its depth under the surface, m.
    pub depth: f64,
}

impl PointContact {
    /// Principal stresses at a depth under the middle of the contact.
    ///
    /// Formula, with A² = a² + z², B² = b² + z², I_x = ⅔ R_D(B², z², A²), I_y = ⅔ R_D(A², z², B²):
    ///
    /// ```text
    /// σ_z = -p ab/(AB)
    /// σ_x = (p ab/2) [2(1-ν) z I_x - 2ν z I_z - (1-2ν)·2/(A(A+B))]
    /// σ_y = (p ab/2) [2(1-ν) z I_y - 2ν z I_z - (1-2ν)·2/(B(A+B))]        z I_z = 2/(AB) - z(I_x + I_y)
    /// ```
    ///
    /// - `load`: Q > 0, N
    /// - `depth`: z ≥ 0, m
    /// - `poisson_ratio`: ν of the body looked into
    ///
    /// Source: Boussinesq's potentials of the Hertz pressure (K. L. Johnson, Contact Mechanics, 1985, chapter 3),
    /// integrated here with Carlson's R_D; tested against a direct sum of point loads.
    /// Valid: frictionless elastic half-space.
    pub fn axis_stress(&self, load: f64, depth: f64, poisson_ratio: f64) -> AxisStress {
        let (a, b, z, nu) = (
            self.semi_major(load),
            self.semi_minor(load),
            depth,
            poisson_ratio,
        );
        let pressure = self.pressure_factor * load.cbrt();
        let (square_a, square_b) = (a * a + z * z, b * b + z * z);
        let (major, minor) = (square_a.sqrt(), square_b.sqrt());
        let product = major * minor;
        let (z_ix, z_iy) = if z > 0.0 {
            (
                z * 2.0 / 3.0 * carlson_rd(square_b, z * z, square_a),
                z * 2.0 / 3.0 * carlson_rd(square_a, z * z, square_b),
            )
        } else {
            (0.0, 0.0)
        };
        let z_iz = 2.0 / product - z_ix - z_iy;
        let half = 0.5 * pressure * a * b;
        let across = |z_i: f64, own: f64| {
            half * (2.0 * (1.0 - nu) * z_i
                - 2.0 * nu * z_iz
                - (1.0 - 2.0 * nu) * 2.0 / (own * (major + minor)))
        };
        AxisStress {
            along_major: across(z_ix, major),
            along_minor: across(z_iy, minor),
            normal: -pressure * a * b / product,
        }
    }

    /// The largest shear stress on the axis under the contact and its depth.
    ///
    /// Formula: max over z of the shear of [`PointContact::axis_stress`], 0 ≤ z ≤ 2b
    ///
    /// - `load`: Q > 0, N
    /// - `poisson_ratio`: ν of the body looked into
    ///
    /// Source: as [`PointContact::axis_stress`]; limits 0.310 p_max at 0.48 a for a circle, 0.300 p_max at 0.786 b for
    /// a line (ν 0.3, K. L. Johnson 1985).
    /// Valid: frictionless elastic half-space; depth to 1e-7 relative.
    pub fn maximum_shear(&self, load: f64, poisson_ratio: f64) -> MaximumShear {
        let shear = |depth: f64| self.axis_stress(load, depth, poisson_ratio).maximum_shear();
        // Golden section: between the surface and 2b the shear of ν 0.2 to 0.4 has one maximum.
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let (mut low, mut high) = (0.1 * self.semi_minor(load), 2.0 * self.semi_minor(load));
        for _ in 0..60 {
            let width = GOLDEN * (high - low);
            if shear(high - width) < shear(low + width) {
                low = high - width;
            } else {
                high = low + width;
            }
        }
        let depth = 0.5 * (low + high);
        MaximumShear {
            shear: shear(depth),
            depth,
        }
    }
}
