//! Mass and inertia of the ring of a ball bearing, by geometry.

use std::f64::consts::PI;

/// A ring with a groove: a cylinder from one diameter to another less a torus of circular section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Radius of the cylinder's smooth side (bore or outside), m.
    pub smooth_radius: f64,
    /// Radius of the shoulder beside the groove, m.
    pub shoulder_radius: f64,
    /// Radius of the bottom of the groove, m.
    pub track_radius: f64,
    /// Radius of the groove's section, m.
    pub groove_radius: f64,
    /// Width, m.
    pub width: f64,
}

impl Ring {
    /// Volume and volume moment of inertia about the axis, m³ and m⁵; times the density, mass and inertia.
    ///
    /// Formula: V = π b |R_s² - R²| - 2π ∫ r c dr, J = ½ π b |R_s⁴ - R⁴| - 2π ∫ r³ c dr,
    /// c = 2 √(r_g² - (r - r_c)²) the width of the groove, from its bottom to the shoulder R_s
    ///
    /// Chamfers and the relief of a counterbored shoulder are left out; both make the real ring lighter.
    pub fn volume_moments(&self) -> (f64, f64) {
        let outward = self.shoulder_radius > self.smooth_radius;
        let side = if outward { 1.0 } else { -1.0 };
        let centre = self.track_radius + side * self.groove_radius;
        let (inner, outer) = if outward {
            (self.smooth_radius, self.shoulder_radius)
        } else {
            (self.shoulder_radius, self.smooth_radius)
        };
        // From the bottom of the groove to the shoulder, as offsets from the centre of the section.
        let depth = (self.shoulder_radius - centre).clamp(-self.groove_radius, self.groove_radius);
        let (from, to) = if outward {
            (-self.groove_radius, depth)
        } else {
            (depth, self.groove_radius)
        };
        let [m0, m1, m2, m3] = std::array::from_fn(|power| {
            chord_moment(self.groove_radius, to, power)
                - chord_moment(self.groove_radius, from, power)
        });
        let first = centre * m0 + m1;
        let third = centre.powi(3) * m0 + 3.0 * centre.powi(2) * m1 + 3.0 * centre * m2 + m3;
        let volume = PI * self.width * (outer.powi(2) - inner.powi(2)) - 2.0 * PI * first;
        let moment = 0.5 * PI * self.width * (outer.powi(4) - inner.powi(4)) - 2.0 * PI * third;
        (volume, moment)
    }
}

/// Antiderivative of 2 uⁿ √(a² - u²), the chord of a circle weighted by the offset, for n = 0 to 3.
fn chord_moment(a: f64, u: f64, power: usize) -> f64 {
    let rest = (a * a - u * u).max(0.0);
    let root = rest.sqrt();
    let angle = (u / a).clamp(-1.0, 1.0).asin();
    match power {
        0 => u * root + a * a * angle,
        1 => -2.0 / 3.0 * rest * root,
        2 => 0.25 * (u * (2.0 * u * u - a * a) * root + a.powi(4) * angle),
        _ => -2.0 / 15.0 * rest * root * (3.0 * u * u + 2.0 * a * a),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same by thin shells.
    fn shells(ring: &Ring) -> (f64, f64) {
        let count = 20_000;
        let thickness = (ring.shoulder_radius - ring.smooth_radius) / f64::from(count);
        let side = thickness.signum();
        let centre = ring.track_radius + side * ring.groove_radius;
        let (mut volume, mut moment) = (0.0, 0.0);
        for shell in 0..count {
            let radius = ring.smooth_radius + thickness * (f64::from(shell) + 0.5);
            let cut = (ring.groove_radius.powi(2) - (radius - centre).powi(2)).max(0.0);
            let part = 2.0 * PI * radius * thickness.abs() * (ring.width - 2.0 * cut.sqrt());
            volume += part;
            moment += part * radius * radius;
        }
        (volume, moment)
    }

    #[test]
    fn inner_and_outer_rings_equal_the_sum_of_thin_shells() {
        // 6005 with 6.35 mm balls; the second is its outer ring.
        let inner = Ring {
            smooth_radius: 12.5e-3,
            shoulder_radius: 16e-3,
            track_radius: 14.825e-3,
            groove_radius: 0.515 * 6.35e-3,
            width: 12e-3,
        };
        let outer = Ring {
            smooth_radius: 23.5e-3,
            shoulder_radius: 20e-3,
            track_radius: 21.175e-3,
            groove_radius: 0.525 * 6.35e-3,
            width: 12e-3,
        };
        for ring in [inner, outer] {
            let (volume, moment) = ring.volume_moments();
            let (thin_volume, thin_moment) = shells(&ring);
            // midpoint rule of 20 000 shells through a square root at the groove's bottom
            assert!((volume / thin_volume - 1.0).abs() < 1e-6);
            assert!((moment / thin_moment - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn a_groove_to_the_equator_takes_half_a_torus() {
        // Shoulder at the centre of the section: by Pappus the half torus has the volume
        // 2π (R - 4a/3π) π a²/2.
        let (centre, a) = (20e-3, 3e-3);
        let ring = Ring {
            smooth_radius: 10e-3,
            shoulder_radius: centre,
            track_radius: centre - a,
            groove_radius: a,
            width: 15e-3,
        };
        let plain = PI * ring.width * (centre * centre - 1e-4);
        let half_torus = 2.0 * PI * (centre - 4.0 * a / (3.0 * PI)) * PI * a * a / 2.0;
        let (volume, _) = ring.volume_moments();
        assert!((volume / (plain - half_torus) - 1.0).abs() < 1e-12);
    }
}
