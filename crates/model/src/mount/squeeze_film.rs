//! A squeeze-film damper: a short bearing around an outer race that does not turn.
//!
//! ```text
//!   flooded (2π film)      F_r = -A π (1 + 2ε²)/(c³ (1 - ε²)^(5/2)) v_r,   F_t = -A π/(c³ (1 - ε²)^(3/2)) v_t,   A = μ R L³
//!   cavitated (π film)     F = -A ∫ (v·n)₊ n/h³ dθ,   h = c - s·n,   over the half circle around v
//! ```
//! ε = |s|/c, r outwards, t across. The π film by Gauss's rule with 64 points. Beyond ε = 0.999 the film is that of 0.999.
//!
//! Source: derived; book/src/theory/drop.md, mounts. Assumes: L/D < 0.5, open ends, no inertia of the oil; a π film needs ambient pressure at
//! cavitation.

use number::{Gather, Real, Vec2, constants};

constants! {
    /// The film.
    pub struct SqueezeFilm {
        /// A = μ R L³: viscosity, radius and cube of the length, N s m².
        factor: R,
        /// Radial clearance c, m.
        clearance: R,
        /// Whether the half that opens carries nothing: a π film.
        cavitates: bool,
    }
}

/// Points of Gauss's rule on a quarter of the circle from the direction of the velocity.
const POINTS: usize = 32;

/// Cosine, sine and weight at each point: the other quarter mirrors them.
pub type Rule = [(f64, f64, f64); POINTS];

/// Gauss's rule with 64 points over the half circle, one side of it.
pub fn rule() -> Rule {
    let count = 2 * POINTS;
    std::array::from_fn(|k| {
        // root of the Legendre polynomial by Newton's method
        let n = count as f64;
        let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..100 {
            let (mut before, mut now) = (1.0, x);
            for j in 2..=count {
                let j = j as f64;
                (before, now) = (now, ((2.0 * j - 1.0) * x * now - (j - 1.0) * before) / j);
            }
            slope = n * (x * now - before) / (x * x - 1.0);
            let step = now / slope;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        let weight = 2.0 / ((1.0 - x * x) * slope * slope);
        let half = std::f64::consts::FRAC_PI_2;
        let (sine, cosine) = (half * x).sin_cos();
        (cosine, sine, half * weight)
    })
}

/// The film over `R`, with its rule where it cavitates.
#[derive(Clone, Debug)]
pub struct Film<R> {
    constants: SqueezeFilm<R>,
    rule: Vec<(f64, f64, f64)>,
}

impl<R: Real> Film<R> {
    /// One film per lane.
    pub fn gather<'a>(constants: &dyn Fn(usize) -> &'a SqueezeFilm<f64>) -> Self {
        let constants: SqueezeFilm<R> = Gather::<R>::gather(constants);
        let rule = if constants.cavitates {
            rule().to_vec()
        } else {
            Vec::new()
        };
        Film { constants, rule }
    }

    /// Force on the outer race, N.
    #[inline(always)]
    pub fn force(&self, s: Vec2<R>, v: Vec2<R>) -> Vec2<R> {
        let own = &self.constants;
        let (zero, one) = (R::zero(), R::one());
        let tiny = R::splat(1e-300);
        let limit = R::splat(0.999) * own.clearance;
        let length = s.length_squared().sqrt();
        let s = s * R::select(length.greater(limit), limit / length.max(tiny), one);
        if own.cavitates {
            let speed = v.length_squared().sqrt();
            let ahead = v * speed.max(tiny).recip();
            let across = ahead.turned();
            let (along, aside) = (s.dot(ahead), s.dot(across));
            let (mut on, mut off) = (zero, zero);
            for (cosine, sine, weight) in &self.rule {
                let (cosine, sine) = (R::splat(*cosine), R::splat(*sine));
                let weight = R::splat(*weight) * cosine;
                let cube = |h: R| {
                    let inverse = h.recip();
                    inverse * inverse * inverse
                };
                let middle = own.clearance - along * cosine;
                let left = cube(middle - aside * sine);
                let right = cube(middle + aside * sine);
                on += weight * cosine * (left + right);
                off += weight * sine * (left - right);
            }
            return (ahead * on + across * off) * -(own.factor * speed);
        }
        let inverse = own.clearance.recip();
        let reduced = s * inverse;
        let square = reduced.length_squared();
        let rest = one - square;
        let root = rest.sqrt();
        let sideways = own.factor * R::splat(std::f64::consts::PI) * inverse * inverse * inverse
            / (rest * root);
        // v_t part on all of v, the rest of v_r besides: (1 + 2ε²)/(1 - ε²) - 1 = 3ε²/(1 - ε²)
        let outwards = reduced * (R::splat(3.0) * reduced.dot(v) / rest);
        -((v + outwards) * sideways)
    }
}

impl SqueezeFilm<f64> {
    /// Damping for small motion about the middle, N s/m.
    pub fn small_damping(&self) -> f64 {
        let film = Film::<f64>::gather(&|_| self);
        -film.force(Vec2::zero(), Vec2::new(1.0, 0.0)).x
    }
}
