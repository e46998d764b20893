//! What is held possible before the data: ranges of parameters. Those of the explanations stand in `parameter`.

use crate::SteadyMoment;

/// Range that holds 90 % of what is thought possible: 5 % lie below `low`, 5 % above `high`.
///
/// A positive quantity is log-normal within it; a share is normal in ln(x/(1-x)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    /// 5 % quantile.
    pub low: f64,
    /// 95 % quantile.
    pub high: f64,
}

/// 95 % quantile of the standard normal distribution.
const QUANTILE: f64 = 1.644_853_627;

impl Range {
    /// Range from its 5 % to its 95 % quantile.
    pub(crate) const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }
    /// Value of a positive quantity at a standard normal coordinate.
    pub(crate) fn positive(self, z: f64) -> f64 {
        place(self.low.ln(), self.high.ln(), z).exp()
    }
    /// Value of a share at a standard normal coordinate.
    pub(crate) fn share(self, z: f64) -> f64 {
        let logit = |x: f64| (x / (1.0 - x)).ln();
        1.0 / (1.0 + (-place(logit(self.low), logit(self.high), z)).exp())
    }
}

fn place(low: f64, high: f64, z: f64) -> f64 {
    0.5 * (low + high) + 0.5 * (high - low) / QUANTILE * z
}

/// Time of the recovery at rest of grease and sensor, s.
pub(crate) const RECOVERY_TIME: Range = Range::new(30.0, 36_000.0);

/// Share of M that depends on speed as the curve shows it.
///
/// ```text
///   M = M1 + c Ω^(2/3)     x = M1/M(Ω0) by least squares of relative deviations     σ_x from the band of the curve
///   load part 1 - share    5 %: x - 1.64 σ_x, at least 0.2 %      95 %: x + 0.03 + 1.64 σ_x, at least 3 %
/// ```
/// With Palmgren's exponent x is the load part. Where M0 grows with Ω^0.6 and churning, as in SKF's form, x lies lower by
/// 3 % of M. Palmgren's own load part f1 P d_m is small against f0 (ν n)^(2/3) d_m³ where tests are lightly loaded: of a
/// deep groove bearing 6005 under 20 to 200 N at 50 to 150 rad/s with f1 of 0.0005 to 0.0009 (P/C0)^½, f0 of 1.1 to 3.4
/// and 50 to 200 mm²/s it is 0.03 to 21 % of M, 0.9 % in the middle; a plain coefficient of friction of 0.0015 makes it
/// 0.5 to 47 %. So the curve decides, and its lower end is open down to 0.2 %, below which nothing changes.
///
/// Source: `crates/physics/src/palmgren.rs` with the factors for deep groove bearings of `palmgren_factors.rs`.
///
/// - `steady`: the curve
/// - `top_speed`: highest speed of the tests Ω0, rad/s
pub(crate) fn share_of(steady: &SteadyMoment, top_speed: f64) -> Range {
    // M = a + c x, weights 1/M²
    let (mut w, mut wx, mut wxx, mut wm, mut wxm) = (0.0, 0.0, 0.0, 0.0, 0.0);
    let place = |speed: f64| (speed / top_speed).powf(2.0 / 3.0);
    for (speed, moment) in steady.speed.iter().zip(&steady.moment) {
        let (weight, x) = (1.0 / (moment * moment), place(*speed));
        w += weight;
        wx += weight * x;
        wxx += weight * x * x;
        wm += weight * moment;
        wxm += weight * x * moment;
    }
    let determinant = w * wxx - wx * wx;
    if determinant <= 1e-6 * w * wxx {
        return UNKNOWN_SHARE;
    }
    let (a, c) = (
        (wxx * wm - wx * wxm) / determinant,
        (w * wxm - wx * wm) / determinant,
    );
    // change of the intercept by each moment, over M
    let by: Vec<f64> = (steady.speed.iter().zip(&steady.moment))
        .map(|(speed, moment)| {
            (wxx - wx * place(*speed)) / (determinant * moment * moment * (a + c))
        })
        .collect();
    let mut variance = 0.0;
    for (row, one) in steady.covariance.iter().zip(&by) {
        for (entry, other) in row.iter().zip(&by) {
            variance += one * other * entry;
        }
    }
    let (share, open) = (a / (a + c), QUANTILE * variance.max(0.0).sqrt());
    if !(share.is_finite() && open.is_finite()) {
        return UNKNOWN_SHARE;
    }
    let low = (share - open).clamp(0.002, 0.4);
    let high = (share + 0.03 + open).clamp(0.03, 0.6);
    Range::new(1.0 - high, 1.0 - low)
}

/// Viscous share where too few speeds show it: most of what Palmgren's law and a plain coefficient of friction give for light
/// loads.
const UNKNOWN_SHARE: Range = Range::new(0.7, 0.995);

#[cfg(test)]
#[path = "../../tests/unit/explain_prior.rs"]
mod tests;
