//! Events on dense output: where a function of the step changes sign, and how high it rises.

use crate::step::Step;
use crate::system::Machine;

/// Fraction of a step within which an event is found: 1e-12 of a step of microseconds is far below any physics.
const RESOLUTION: f64 = 1e-12;

/// The fraction in (low, high] at which a function of the step changes sign, by the Illinois method.
///
/// `low` and `high` are fractions with the function's values there. The signs must differ; zero counts as negative.
pub fn root<M: Machine>(
    step: &mut Step<M>,
    low: (f64, f64),
    high: (f64, f64),
    mut function: impl FnMut(&mut Step<M>, f64) -> f64,
) -> f64 {
    let ((mut a, mut fa), (mut b, mut fb)) = (low, high);
    let end_positive = fb > 0.0;
    // which end the last point replaced: an end that stays twice has its value halved
    let mut replaced_high = None;
    for _ in 0..80 {
        if b - a <= RESOLUTION {
            break;
        }
        let secant = b - fb * (b - a) / (fb - fa);
        // keep away from the ends so that the interval always shrinks
        let margin = 0.5 * RESOLUTION;
        let x = if secant.is_finite() {
            secant.clamp(a + margin, b - margin)
        } else {
            0.5 * (a + b)
        };
        let fx = function(step, x);
        let replaces_high = (fx > 0.0) == end_positive;
        if replaces_high {
            (b, fb) = (x, fx);
            if replaced_high == Some(true) {
                fa *= 0.5;
            }
        } else {
            (a, fa) = (x, fx);
            if replaced_high == Some(false) {
                fb *= 0.5;
            }
        }
        replaced_high = Some(replaces_high);
    }
    b
}

/// The fraction in (low, high] at which a probe changes sign: see [`root`].
pub fn crossing<M: Machine>(step: &mut Step<M>, probe: usize, low: f64, high: f64) -> f64 {
    // the stored values at the ends, so that neighbouring steps agree on the sign
    let mut value = |theta: f64| match theta {
        0.0 => step.start_probe(probe),
        1.0 => step.end_probe(probe),
        _ => step.probe(theta, probe),
    };
    let ends = (value(low), value(high));
    root(step, (low, ends.0), (high, ends.1), |step, theta| {
        step.probe(theta, probe)
    })
}

/// The largest value of a function of the step between two fractions: (fraction, value).
///
/// Golden-section search: the function must have one hump there. Ends are not compared.
pub fn maximum<M: Machine>(
    step: &mut Step<M>,
    low: f64,
    high: f64,
    mut function: impl FnMut(&mut Step<M>, f64) -> f64,
) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut a, mut b) = (low, high);
    let mut x = b - GOLDEN * (b - a);
    let mut y = a + GOLDEN * (b - a);
    let (mut fx, mut fy) = (function(step, x), function(step, y));
    // 24 halvings by the golden ratio: 1e-5 of a step, and its square in the value
    for _ in 0..24 {
        if fx > fy {
            (b, y, fy) = (y, x, fx);
            x = b - GOLDEN * (b - a);
            fx = function(step, x);
        } else {
            (a, x, fx) = (x, y, fy);
            y = a + GOLDEN * (b - a);
            fy = function(step, y);
        }
    }
    if fx > fy { (x, fx) } else { (y, fy) }
}
