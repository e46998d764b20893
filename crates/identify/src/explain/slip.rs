//! Balls and cage that a limited traction spins up: cage speed and mean ball spin, and a film that may heat.
//!
//! With v_o = R(1+s)ω_c and v_b = sRω_b, Q the sums of ball loads, C = R μ_max ΣQ at both races:
//!
//! ```text
//!   (N m_b + m_c) v̇_o = T_I - T_O - f                   orbit of balls and cage
//!   ⅖ N m_b v̇_b       = T_I + T_O - (m_i + m_o + m_s)/r   spin of the balls
//!   T_I = C/R tanh((RΩ - v_o - v_b)/u0)     T_O = C/R tanh((v_o - v_b)/u0)
//!   f = 2χ/R D M0(2(1+s)ω_c)   m_s = 2s(1-χ) D M0(2sω_b)   m_i, m_o = s/(1+s) M1
//!   t_O = (1+2s)R T_O - m_o - m_s + R(1+s) f
//!   τ_Θ Θ̇ = P/(M Ω) - Θ,  C = C0 exp(-k_T Θ),  D = exp(-k_D Θ)      P all that turns into heat
//! ```
//! The drag on orbit and spin makes a steady run give t_I = t_O = M(Ω) while the balls roll, and less where the orbit
//! is slow. Both right sides are gradients of a convex function, so Euler's implicit step has one solution; its sums of
//! moment over time close the angular momentum exactly, whatever the step.
//!
//! Does not model: single balls (all share spin and load), pocket friction, the orbit's change of ball loads.

use physics::rolling::RollingSet;

use super::record::{Past, Trial};
use super::steady::Table;

/// Constants of the reduced model.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slip {
    /// C0 = R μ_max ΣQ, N m.
    pub traction_limit: f64,
    /// u0, m/s.
    pub slip_speed: f64,
    /// Part of M that does not depend on speed, N m.
    pub load_moment: f64,
    /// χ, share of the viscous part that brakes the orbit; the rest brakes the spin.
    pub orbit_share: f64,
    /// k_T for the film's rise in units of its balance with M Ω.
    pub traction_softening: f64,
    /// k_D likewise.
    pub drag_softening: f64,
    /// τ_Θ, s.
    pub film_time: f64,
}

/// The course of one test.
#[derive(Clone, Debug, Default)]
pub(crate) struct Course {
    /// t_O, N m, at the end of each step.
    pub outer_moment: Vec<f64>,
    /// ω_c, rad/s.
    pub cage: Vec<f64>,
    /// Change of k_T Θ from 0.3 s after the shaft is at speed on.
    pub softened: f64,
    /// t_I, N m; angular momentum of balls and cage, N m s; heat, W.
    #[cfg(test)]
    pub balance: Vec<(f64, f64, f64)>,
}

/// State at the end of a step: surface speeds of orbit and spin, m/s.
#[derive(Clone, Copy)]
struct State {
    orbit: f64,
    spin: f64,
}

/// All forces at a state.
struct Forces {
    inner: f64,
    outer: f64,
    drag: f64,
    couple: f64,
    inner_rolling: f64,
    outer_rolling: f64,
    /// Residuals of orbit and spin and their derivatives.
    residual: [f64; 2],
    slope: [f64; 3],
}

/// Constants of one step.
struct Moment<'a> {
    slip: &'a Slip,
    set: &'a RollingSet<f64>,
    table: &'a Table,
    speed: f64,
    limit: f64,
    drag: f64,
    load_moment: f64,
    /// Masses over the length of the step, kg/s.
    orbit_inertia: f64,
    spin_inertia: f64,
}

/// Time after which heating must still go on to be distinguished from a film that was warm at once, s: assumed.
const SETTLING: f64 = 0.3;
/// Speed at which rolling couples fade at rest, rad/s.
const ROLLING_SPEED: f64 = 1.0;

impl Moment<'_> {
    /// M0 and its slope over the race speed.
    fn viscous(&self, speed: f64) -> (f64, f64) {
        let (moment, slope, fading) = self.table.with_fading(speed);
        let load = self.slip.load_moment * fading;
        // a curve that falls below its own load part has no viscous part there
        if moment > load {
            let viscous = self.drag * (moment - load);
            (viscous.copysign(speed), self.drag * slope.max(0.0))
        } else {
            (0.0, 0.0)
        }
    }

    fn forces(&self, state: State, last: State) -> Forces {
        let (radius, s) = (self.set.inner_track_radius, self.set.ball_ratio);
        let ball = s * radius;
        let push = self.limit / radius;
        let inner_slip = (radius * self.speed - state.orbit - state.spin) / self.slip.slip_speed;
        let outer_slip = (state.orbit - state.spin) / self.slip.slip_speed;
        let (inner, outer) = (saturating(inner_slip), saturating(outer_slip));
        let stiffness = push / self.slip.slip_speed;
        let (inner_slope, outer_slope) = (
            stiffness * (1.0 - inner * inner),
            stiffness * (1.0 - outer * outer),
        );
        // 2(1+s)ω_c and 2sω_b are 2v/R
        let (orbit_moment, orbit_slope) = self.viscous(2.0 * state.orbit / radius);
        let (spin_moment, spin_slope) = self.viscous(2.0 * state.spin / radius);
        let on_orbit = 2.0 * self.slip.orbit_share / radius;
        let on_spin = 2.0 * s * (1.0 - self.slip.orbit_share);
        let (drag, drag_slope) = (
            on_orbit * orbit_moment,
            on_orbit * 2.0 * orbit_slope / radius,
        );
        let (couple, couple_slope) = (on_spin * spin_moment, on_spin * 2.0 * spin_slope / radius);
        let rolling = s / (1.0 + s) * self.load_moment;
        let spin = state.spin / ball;
        let against_inner = saturating((spin + self.speed) / ROLLING_SPEED);
        let against_outer = saturating(spin / ROLLING_SPEED);
        let (inner_rolling, outer_rolling) = (rolling * against_inner, rolling * against_outer);
        let rolling_slope = rolling / (ROLLING_SPEED * ball)
            * (2.0 - against_inner * against_inner - against_outer * against_outer);
        let (inner, outer) = (push * inner, push * outer);
        let grip = inner_slope + outer_slope;
        Forces {
            residual: [
                self.orbit_inertia * (state.orbit - last.orbit) - inner + outer + drag,
                self.spin_inertia * (state.spin - last.spin) - inner - outer
                    + (couple + inner_rolling + outer_rolling) / ball,
            ],
            slope: [
                self.orbit_inertia + grip + drag_slope,
                inner_slope - outer_slope,
                self.spin_inertia + grip + (couple_slope + rolling_slope) / ball,
            ],
            inner,
            outer,
            drag,
            couple,
            inner_rolling,
            outer_rolling,
        }
    }

    /// Implicit step by Newton's method, shortened where the residual would grow: the residual is the gradient of a
    /// convex function, so a short enough step always lowers it.
    fn advance(&self, last: State, last_speed: f64) -> (State, Forces) {
        let size = |f: &Forces| f.residual[0].powi(2) + f.residual[1].powi(2);
        // either the balls stay as they are (slipping) or they follow the race with the slip they had (rolling)
        let follow = 0.5 * self.set.inner_track_radius * (self.speed - last_speed);
        let following = State {
            orbit: last.orbit + follow,
            spin: last.spin + follow,
        };
        let (mut state, mut forces) = (last, self.forces(last, last));
        let other = self.forces(following, last);
        if size(&other) < size(&forces) {
            (state, forces) = (following, other);
        }
        // residuals of 1e-5 of the traction limit move t_O by as little
        let enough = (1e-5 * self.limit / self.set.inner_track_radius).powi(2);
        for _ in 0..60 {
            let now = size(&forces);
            if now < enough {
                break;
            }
            let [a, b, d] = forces.slope;
            let [f, g] = forces.residual;
            let determinant = a * d - b * b;
            let step = [(d * f - b * g) / determinant, (a * g - b * f) / determinant];
            let mut share = 1.0;
            let better = loop {
                let next = State {
                    orbit: state.orbit - share * step[0],
                    spin: state.spin - share * step[1],
                };
                let tried = self.forces(next, last);
                if size(&tried) < now {
                    break Some((next, tried));
                }
                share *= 0.35;
                if share < 1e-9 {
                    break None;
                }
            };
            let Some(better) = better else { break };
            (state, forces) = better;
        }
        (state, forces)
    }
}

/// tanh by one exponential: absolute error below 1e-15.
fn saturating(x: f64) -> f64 {
    if x.abs() > 20.0 {
        x.signum()
    } else {
        1.0 - 2.0 / ((2.0 * x).exp() + 1.0)
    }
}

/// Share of the load-dependent moment at another load: M1 ∝ W^1.5 (Palmgren's W (W/C0)^0.5).
pub(crate) fn load_moment_factor(past: &Past) -> f64 {
    past.load_factor.powf(1.5)
}

impl Slip {
    /// The course of one test.
    pub fn course(&self, test: &Trial, table: &Table, set: &RollingSet<f64>) -> Course {
        let mut course = Course::default();
        course.outer_moment.reserve(test.steps.len());
        course.cage.reserve(test.steps.len());
        let (radius, s) = (set.inner_track_radius, set.ball_ratio);
        let start = if test.starts_turning {
            0.5 * radius * test.steps.first().map_or(0.0, |step| step.speed)
        } else {
            0.0
        };
        let mut state = State {
            orbit: start,
            spin: start,
        };
        let mut last_speed = 2.0 * start / radius;
        let mut film = test.past.film;
        let mut settled: Option<(f64, f64)> = None;
        // preload keeps part of the ball loads when the dead weight changes: a power below 1, assumed
        let cold_limit = self.traction_limit * test.past.load_factor.powf(0.8);
        let power = table.reference * table.top_speed;
        for step in &test.steps {
            let moment = Moment {
                slip: self,
                set,
                table,
                speed: step.speed,
                limit: cold_limit * (-self.traction_softening * film).exp(),
                drag: (-self.drag_softening * film).exp(),
                load_moment: self.load_moment * load_moment_factor(&test.past),
                orbit_inertia: (set.balls_mass + set.cage_mass) / step.duration,
                spin_inertia: 0.4 * set.balls_mass / step.duration,
            };
            let (next, forces) = moment.advance(state, last_speed);
            state = next;
            last_speed = step.speed;
            let outer_moment =
                (1.0 + 2.0 * s) * radius * forces.outer - forces.outer_rolling - forces.couple
                    + radius * (1.0 + s) * forces.drag;
            let cage = state.orbit / (radius * (1.0 + s));
            let spin = state.spin / (s * radius);
            let heat = forces.inner * (radius * step.speed - state.orbit - state.spin)
                + forces.outer * (state.orbit - state.spin)
                + forces.drag * state.orbit
                + (forces.couple + forces.outer_rolling) * spin
                + forces.inner_rolling * (spin + step.speed);
            course.outer_moment.push(outer_moment);
            course.cage.push(cage);
            #[cfg(test)]
            course.balance.push((
                radius * forces.inner + forces.inner_rolling,
                (set.balls_mass + set.cage_mass) * radius * (1.0 + s) * state.orbit
                    - 0.4 * set.balls_mass * s * radius * state.spin,
                heat,
            ));
            let kept = (-step.duration / self.film_time).exp();
            film = film * kept + (1.0 - kept) * heat / power;
            if step.speed > 0.95 * table.top_speed {
                let (since, early) = settled.get_or_insert((step.elapsed, film));
                if step.elapsed < *since + SETTLING {
                    *early = film;
                }
                let softened = self.traction_softening * (film - *early).abs();
                course.softened = course.softened.max(softened);
            }
        }
        course
    }
}

#[cfg(test)]
#[path = "../../tests/unit/explain_slip.rs"]
mod tests;
