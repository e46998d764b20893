//! Truth for the estimators, made by models that differ from theirs; shares no code with them.
#![allow(dead_code)]

/// Random numbers: SplitMix64 (public domain algorithm by Steele, Lea, Flood).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x5DEE_CE66_D123_4567)
    }

    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Normal by the sum of twelve uniforms: tails end at 6, as those of a real logger do.
    pub fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }

    /// Noise of unit variance, a part `share` of the variance correlated from sample to sample by `correlation`.
    pub fn coloured(&mut self, count: usize, share: f64, correlation: f64) -> Vec<f64> {
        let mut slow = self.normal();
        let fresh = (1.0 - correlation * correlation).sqrt();
        (0..count)
            .map(|_| {
                slow = correlation * slow + fresh * self.normal();
                share.sqrt() * slow + (1.0 - share).sqrt() * self.normal()
            })
            .collect()
    }
}

/// Spin-up of a bearing by a clutch: acceleration rises in a millisecond to its peak and falls to nothing at `duration`.
#[derive(Clone, Copy)]
pub struct SpinUp {
    pub engaged: f64,
    pub duration: f64,
    pub peak: f64,
    pub fall: f64,
}

const RISE: f64 = 0.001;

impl SpinUp {
    /// With a final speed of 150 rad/s.
    pub fn to_150(engaged: f64, duration: f64, peak: f64) -> Self {
        // 150 = peak (duration - rise)/(fall + 1) + peak rise/2
        let fall = peak * (duration - RISE) / (150.0 - 0.5 * peak * RISE) - 1.0;
        Self {
            engaged,
            duration,
            peak,
            fall,
        }
    }

    pub fn acceleration(&self, time: f64) -> f64 {
        let t = time - self.engaged;
        if t <= 0.0 || t >= self.duration {
            0.0
        } else if t < RISE {
            self.peak * t / RISE
        } else {
            self.peak * (1.0 - (t - RISE) / (self.duration - RISE)).powf(self.fall)
        }
    }

    pub fn speed(&self, time: f64) -> f64 {
        let t = (time - self.engaged).min(self.duration);
        if t <= 0.0 {
            0.0
        } else if t < RISE {
            0.5 * self.peak * t * t / RISE
        } else {
            let (p, d) = (self.fall + 1.0, self.duration - RISE);
            0.5 * self.peak * RISE + self.peak * d / p * (1.0 - (1.0 - (t - RISE) / d).powf(p))
        }
    }

    pub fn angle(&self, time: f64) -> f64 {
        let t = (time - self.engaged).min(self.duration);
        let after = (time - self.engaged - self.duration).max(0.0)
            * self.speed(self.engaged + self.duration);
        if t <= 0.0 {
            0.0
        } else if t < RISE {
            self.peak * t.powi(3) / (6.0 * RISE)
        } else {
            let (p, d) = (self.fall + 1.0, self.duration - RISE);
            let start = self.peak * RISE * RISE / 6.0;
            let even = (0.5 * self.peak * RISE + self.peak * d / p) * (t - RISE);
            start + even
                - self.peak * d * d / (p * (p + 1.0)) * (1.0 - (1.0 - (t - RISE) / d).powf(p + 1.0))
                + after
        }
    }

    /// Moment at the outer race, N mm: the moment of friction, built up by the grease over half a cage turn and broken down over
    /// 1.5 s, less the inertia part of -12.9 N mm at 11 500 rad/s².
    pub fn torque(&self, time: f64) -> f64 {
        let t = time - self.engaged;
        if t <= 0.0 {
            return 0.0;
        }
        let speed = self.speed(time);
        let steady = 3.0 + 22.0 * (speed.max(2.0) / 150.0).powf(2.0 / 3.0);
        let turns = 0.4 * self.angle(time) / std::f64::consts::TAU;
        let grease = (1.0 - 0.7 * (-turns / 0.5).exp()) * (0.75 + 0.25 * (-t / 1.5).exp()) / 0.95;
        steady * grease - 12.9 / 11_500.0 * self.acceleration(time)
    }
}

/// Median of some numbers.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
