//! What is held possible before the data: odds of the explanations and ranges of their parameters.

use super::explanation::Explanation;
use crate::SteadyMoment;

/// Range that holds 90 % of what is thought possible: 5 % lie below `low`, 5 % above `high`.
///
/// A positive quantity is log-normal within it; a share is normal in ln(x/(1-x)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// 5 % quantile.
    pub low: f64,
    /// 95 % quantile.
    pub high: f64,
}

/// 95 % quantile of the standard normal distribution.
const QUANTILE: f64 = 1.644_853_627;

impl Range {
    /// Range from its 5 % to its 95 % quantile.
    pub const fn new(low: f64, high: f64) -> Self {
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
    fn is_positive(self) -> bool {
        self.low > 0.0 && self.high > self.low && self.high.is_finite()
    }
    fn is_share(self) -> bool {
        self.is_positive() && self.high < 1.0
    }
}

fn place(low: f64, high: f64, z: f64) -> f64 {
    0.5 * (low + high) + 0.5 * (high - low) / QUANTILE * z
}

/// Odds and ranges before the data. The defaults are assumed unless a source stands beside them.
#[derive(Clone, Debug, PartialEq)]
pub struct Priors {
    /// Prior weight of each explanation in the order of [`Explanation::ALL`]; only ratios matter. 0 rules one out.
    pub odds: [f64; 7],
    /// Share of M that depends on speed (M0/M) at the highest speed; none: from the curve itself, see
    /// [`Priors::share_of`].
    pub viscous_share: Option<Range>,
    /// Grease: drag factor of fresh grease g0, before the build-up.
    pub fresh_drag: Range,
    /// Grease: drag factor after breakdown g_w.
    pub worked_drag: Range,
    /// Grease: cage angle of the build-up φ_b, rad; 0.1 to 3 turns.
    pub build_up_angle: Range,
    /// Grease: time constant of the breakdown τ_w, s.
    pub breakdown_time: Range,
    /// Grease and sensor: time constant of the recovery at rest, s; only the next test needs it.
    pub recovery_time: Range,
    /// Slip: moment R μ_max ΣQ that the inner race can transmit, over M at the highest speed.
    pub traction_limit: Range,
    /// Slip with heating: the same while cold.
    pub cold_traction_limit: Range,
    /// Slip: speed u0 at which traction reaches 76 % of its limit, m/s.
    pub slip_speed: Range,
    /// Slip: share of the viscous part that brakes the orbit of the balls; the rest brakes their spin.
    pub orbit_share: Range,
    /// Heating: logarithm of the loss of traction when the film is in balance with the power M Ω.
    pub traction_softening: Range,
    /// Heating: logarithm of the loss of viscous drag at the same rise.
    pub drag_softening: Range,
    /// Heating: time constant of the film temperature, s.
    pub film_time: Range,
    /// Oil that warms: logarithm of the loss of viscous drag when it is in balance with the power M Ω.
    pub oil_softening: Range,
    /// Oil that warms: time constant of its temperature, s.
    pub oil_time: Range,
    /// Sensor: size of a drift of the zero, over M at the highest speed; either sign.
    pub drift: Range,
    /// Sensor: size of the creep c; either sign.
    pub creep: Range,
    /// Sensor: time constant of drift and creep, s.
    pub sensor_time: Range,
    /// Sensor: time constant by which it settles more slowly than stated, s.
    pub settling_time: Range,
    /// Another steady moment: that of the tests over that of the slow tests, at the highest speed.
    pub moment_ratio: Range,
    /// Another steady moment: that ratio at half the highest speed over the ratio at the highest.
    pub ratio_at_half_speed: Range,
}

impl Default for Priors {
    fn default() -> Self {
        let turn = std::f64::consts::TAU;
        Self {
            odds: [1.0; 7],
            viscous_share: None,
            fresh_drag: Range::new(0.2, 0.95),
            worked_drag: Range::new(0.5, 0.95),
            build_up_angle: Range::new(0.1 * turn, 3.0 * turn),
            breakdown_time: Range::new(0.8, 4.0),
            recovery_time: Range::new(30.0, 36_000.0),
            traction_limit: Range::new(0.4, 1.2),
            cold_traction_limit: Range::new(0.7, 2.0),
            slip_speed: Range::new(0.01, 0.3),
            orbit_share: Range::new(0.3, 0.7),
            traction_softening: Range::new(0.15, 1.5),
            drag_softening: Range::new(0.02, 0.3),
            film_time: Range::new(0.5, 5.0),
            oil_softening: Range::new(0.1, 0.8),
            oil_time: Range::new(0.5, 5.0),
            drift: Range::new(0.08, 0.6),
            creep: Range::new(0.08, 0.5),
            sensor_time: Range::new(0.3, 5.0),
            settling_time: Range::new(0.05, 1.0),
            moment_ratio: Range::new(0.5, 2.0),
            ratio_at_half_speed: Range::new(0.8, 1.25),
        }
    }
}

impl Priors {
    /// Range of the viscous share, which the comparison has taken from the curve where none was given.
    pub(super) fn share_range(&self) -> Range {
        self.viscous_share.unwrap_or(Range::new(0.8, 0.95))
    }
    /// Name of the first range that is none.
    pub(crate) fn fault(&self) -> Option<&'static str> {
        let odds_are_odds = self
            .odds
            .iter()
            .all(|odds| odds.is_finite() && *odds >= 0.0)
            && self.odds.iter().sum::<f64>() > 0.0;
        if !odds_are_odds {
            return Some("odds");
        }
        if !self.viscous_share.is_none_or(Range::is_share) {
            return Some("viscous_share");
        }
        if !self.orbit_share.is_share() {
            return Some("orbit_share");
        }
        [
            ("fresh_drag", self.fresh_drag),
            ("worked_drag", self.worked_drag),
            ("build_up_angle", self.build_up_angle),
            ("breakdown_time", self.breakdown_time),
            ("recovery_time", self.recovery_time),
            ("traction_limit", self.traction_limit),
            ("cold_traction_limit", self.cold_traction_limit),
            ("slip_speed", self.slip_speed),
            ("traction_softening", self.traction_softening),
            ("drag_softening", self.drag_softening),
            ("film_time", self.film_time),
            ("oil_softening", self.oil_softening),
            ("oil_time", self.oil_time),
            ("drift", self.drift),
            ("creep", self.creep),
            ("sensor_time", self.sensor_time),
            ("settling_time", self.settling_time),
            ("moment_ratio", self.moment_ratio),
            ("ratio_at_half_speed", self.ratio_at_half_speed),
        ]
        .into_iter()
        .find_map(|(name, range)| (!range.is_positive()).then_some(name))
    }

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
    pub fn share_of(steady: &SteadyMoment, top_speed: f64) -> Range {
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
            return Self::UNKNOWN_SHARE;
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
            return Self::UNKNOWN_SHARE;
        }
        let low = (share - open).clamp(0.002, 0.4);
        let high = (share + 0.03 + open).clamp(0.03, 0.6);
        Range::new(1.0 - high, 1.0 - low)
    }

    /// Viscous share where too few speeds show it: most of what Palmgren's law and a plain coefficient of friction give for light
    /// loads.
    const UNKNOWN_SHARE: Range = Range::new(0.7, 0.995);

    /// The same with the viscous share of the curve where none was given.
    pub(crate) fn resolved(&self, steady: &SteadyMoment, top_speed: f64) -> Self {
        let mut resolved = self.clone();
        resolved
            .viscous_share
            .get_or_insert_with(|| Self::share_of(steady, top_speed));
        resolved
    }

    /// Prior probability of an explanation.
    pub(crate) fn probability(&self, explanation: Explanation) -> f64 {
        self.odds[explanation as usize] / self.odds.iter().sum::<f64>()
    }
}

#[cfg(test)]
#[path = "../../tests/unit/explain_prior.rs"]
mod tests;
