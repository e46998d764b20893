//! Inertia of a rotor from simple tests.

use statistics::uncertain::Uncertain;
use std::f64::consts::TAU;

/// Inertia about the own axis of a rotor that swings as a pendulum about a knife edge parallel to that axis.
///
/// Formula: I = m g a T₀²/(4π²) − m a², T₀ = T/(1 + φ²/16)
///
/// Arguments: mass m in kg, distance a from the knife edge to the mass centre in m, period T in s, amplitude φ of the swing in rad,
/// gravity g in m/s².
///
/// Source: textbook of mechanics (compound pendulum; first term of its amplitude series).
///
/// Valid: swing below 0.5 rad, light damping. Errors of mass, distance and period are taken as independent.
pub fn inertia_from_pendulum(
    mass: Uncertain,
    arm: Uncertain,
    period: Uncertain,
    amplitude: f64,
    gravity: f64,
) -> Uncertain {
    let small = period.value / (1.0 + amplitude * amplitude / 16.0);
    let turn = small / TAU;
    let (m, a) = (mass.value, arm.value);
    let value = m * gravity * a * turn * turn - m * a * a;
    let by_mass = value / m * mass.deviation;
    let by_arm = m * (gravity * turn * turn - 2.0 * a) * arm.deviation;
    let by_period = 2.0 * m * gravity * a * turn * turn / period.value * period.deviation;
    Uncertain::new(value, by_mass.hypot(by_arm).hypot(by_period))
}

/// Inertia about the vertical axis of a rotor that hangs on two equal vertical strings and turns to and fro.
///
/// Formula: I = m g d² T²/(16π² l)
///
/// Arguments: mass m in kg, distance d of the strings in m, their length l in m, period T in s, gravity g in m/s².
///
/// Source: textbook of mechanics (bifilar pendulum).
///
/// Valid: small swings, strings long against their distance, the mass centre midway between them.
pub fn inertia_from_bifilar(
    mass: Uncertain,
    distance: Uncertain,
    length: Uncertain,
    period: Uncertain,
    gravity: f64,
) -> Uncertain {
    let turn = period.value / (2.0 * TAU);
    let value = mass.value * gravity * distance.value.powi(2) * turn * turn / length.value;
    let relative = |u: Uncertain| u.deviation / u.value;
    let sum = relative(mass)
        .hypot(2.0 * relative(distance))
        .hypot(relative(length))
        .hypot(2.0 * relative(period));
    Uncertain::new(value, value.abs() * sum)
}

/// Inertia of a rotor from its acceleration at one speed with and without a known additional torque.
///
/// Formula: I = ΔM/(α₁ − α₀)
///
/// Arguments: additional torque ΔM in N m, acceleration α₁ with it and α₀ without it, at the same speed in rad/s².
///
/// Source: definition of inertia.
///
/// Valid: all other torques equal in both runs; accelerations that differ by many of their deviations.
pub fn inertia_from_known_torque(
    torque: Uncertain,
    with: Uncertain,
    without: Uncertain,
) -> Uncertain {
    let difference = with.minus(without);
    let value = torque.value / difference.value;
    Uncertain::new(
        value,
        (torque.deviation / difference.value)
            .hypot(value * difference.deviation / difference.value),
    )
}
