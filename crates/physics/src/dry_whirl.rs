//! Dry backward whirl of a rotor that slides round the bore of a race: the friction it needs, and its contact force.
//!
//! ```text
//!   orbit z = ε e^{-jωt} of the rotor relative to the race, spin +;  n = z/ε,  t = jn
//!   on the rotor  F = -N(1 + jμ) n   while its surface slides with the spin;  on the race -F
//!   z = α F,  ε = c0 + d,  N = k dⁿ    ⇒    c0 + d = -N (1 + jμ) α(ω)
//! ```
//! α(ω) is the receptance of the rotor at the contact for motion e^{-jωt} plus that of the race on its mount, which is the conjugate of
//! the one for e^{jωt}. The imaginary part gives μ, the real part N. Damping opposes whirl by Im α > 0; Re α < 0 says that mass prevails.

/// Friction coefficient at which backward whirl of a given frequency goes on unchanged in full slip; none where Re α ≥ 0.
///
/// Formula: μ_e = Im α/|Re α|
///
/// - `real`, `imaginary`: receptance α of rotor and race for motion e^{-jωt}, m/N
///
/// Source: derived; book/src/theory/whirl.md. Black 1968 (from memory).
/// Valid: circular orbit, linear rotor and mount equal in all directions, one contact that slides all the way round.
pub fn needed_friction(real: f64, imaginary: f64) -> Option<f64> {
    (real < 0.0).then(|| imaginary / -real)
}

/// The contact of rotor and race in whirl.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhirlContact {
    /// Radial clearance c0, m.
    pub clearance: f64,
    /// Stiffness k, N/mⁿ.
    pub stiffness: f64,
    /// Exponent n ≥ 1.
    pub exponent: f64,
}

impl WhirlContact {
    /// Contact force of whirl with the friction that it needs, N; none where the contact yields more than the orbit asks for, of
    /// one with n > 1 by more than its clearance.
    ///
    /// Formula: N (|Re α| + μ_e Im α) = c0 + d,  N = k dⁿ
    ///
    /// - `real`, `imaginary`: receptance α of rotor and race for motion e^{-jωt}, m/N
    ///
    /// Source: derived; book/src/theory/whirl.md.
    /// Valid: as [`needed_friction`].
    pub fn normal_force(&self, real: f64, imaginary: f64) -> Option<f64> {
        let friction = needed_friction(real, imaginary)?;
        let orbit = friction * imaginary - real;
        let (clearance, linear) = (self.clearance, self.exponent == 1.0);
        if linear {
            let yielding = orbit - 1.0 / self.stiffness;
            return (yielding > 0.0).then(|| clearance / yielding);
        }
        // k α dⁿ - d - c0 is convex over d, negative at 0: Newton's steps come down to its only root from above
        let excess = |d: f64| self.stiffness * orbit * d.powf(self.exponent) - d - clearance;
        let mut d = clearance;
        if excess(d) < 0.0 {
            return None;
        }
        for _ in 0..60 {
            let slope = (excess(d) + d + clearance) * self.exponent / d - 1.0;
            let step = excess(d) / slope;
            d -= step;
            if step.abs() <= 1e-15 * d {
                break;
            }
        }
        Some(self.stiffness * d.powf(self.exponent))
    }
}

/// Largest frequency of backward whirl, rad/s: there the surfaces roll on each other, and friction no longer drives it.
///
/// Formula: ω ≤ |R_r Ω - R_0 ω_i|/c0,  R_r = R_0 - c0
///
/// - `bore_radius`: R_0 of the race, m
/// - `clearance`: c0, m
/// - `speeds`: [Ω of the rotor, ω_i of the race], rad/s
///
/// Source: derived; book/src/theory/whirl.md.
/// Valid: penetration small against the clearance.
pub fn rolling_limit(bore_radius: f64, clearance: f64, speeds: [f64; 2]) -> f64 {
    ((bore_radius - clearance) * speeds[0] - bore_radius * speeds[1]).abs() / clearance
}
