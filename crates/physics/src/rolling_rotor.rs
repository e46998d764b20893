//! A rotor that rolls in a bore under its weight, without leaving it: stiffness of its contact for small motion.
//!
//! ```text
//!        race ⊙ ─ ─ ─            radial, along the weight:  dN/dd of the contact
//!             │ ε = c0 + d       across: the contact force N points along the line of centres; a rotor
//!      rotor  ⊙ ──► s            that is s aside feels N s/ε back, as a pendulum of length ε does
//!             ▼ N
//! ```
//! With the whole mass on it, N = m g, the motion across has ω = √(N/(ε m)) = √(g/ε), whatever the mass.

/// Stiffness of a contact N = k dⁿ about a load, N/m.
///
/// Formula: dN/dd = n N/d = n k^(1/n) N^(1 - 1/n)
///
/// - `stiffness` k, N/mⁿ; `exponent` n; `load` N, N, above 0
///
/// Source: derivative of k dⁿ.
/// Valid: motion small against the penetration; the load stays above 0.
pub fn contact_stiffness(stiffness: f64, exponent: f64, load: f64) -> f64 {
    exponent * load / penetration(stiffness, exponent, load)
}

/// Penetration of a contact N = k dⁿ under a load, m.
///
/// Formula: d = (N/k)^(1/n)
///
/// - `stiffness` k, N/mⁿ; `exponent` n; `load` N, N, not below 0
///
/// Source: inverse of k dⁿ.
/// Valid: at rest.
pub fn penetration(stiffness: f64, exponent: f64, load: f64) -> f64 {
    (load / stiffness).powf(1.0 / exponent)
}

/// Stiffness across the load of a rotor that rolls in the bottom of a bore, N/m.
///
/// Formula: k = N/ε
///
/// - `load` N, N; `distance` ε of the centres of rotor and bore, the clearance with the penetration, m
///
/// Source: derived; book/src/theory/rolling.md.
/// Valid: small angles of the pendulum; a race that turns with the rotor, so that friction holds nothing; inertia of the race left out.
pub fn pendulum_stiffness(load: f64, distance: f64) -> f64 {
    load / distance
}
