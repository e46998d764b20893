//! The motion while the pickup was silent.
//!
//! ```text
//! Ω(x) = cubic through speed and acceleration on both sides,   x = (t - t_1)/T
//! deviation of Ω:  that of the sides, carried on by the cubic, and  4x(1 - x) (T |ΔΩ̇|/8 + |ΔΩ - T (Ω̇_1 + Ω̇_2)/2|/2)
//! ```
//! The pulses of one side say nothing of the other. In between the speed is that of a motion which leaves one side and arrives at
//! the other; what the accelerations of the sides do not explain of it may have happened at any time.
//!
//! **Does not model**: a shaft that brakes and speeds up again unseen.

use super::motion::Motion;
use crate::pulse::{Gap, Pulses};

/// A silence, with the motion on both sides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bridge {
    pub gap: Gap,
    begin: Motion,
    end: Motion,
    /// Usual angle between marks, rad.
    pitch: f64,
}

impl Bridge {
    /// Those of a record, given its motion.
    pub fn all(pulses: &Pulses, motion: impl Fn(f64) -> Motion) -> Vec<Bridge> {
        let of = |gap: &Gap| Bridge {
            gap: *gap,
            begin: motion(gap.from),
            end: motion(gap.to),
            pitch: pulses.pitch(),
        };
        pulses.gaps.iter().map(of).collect()
    }

    /// That between two values of a speed channel: the angle between is that of the cubic.
    pub fn between(from: f64, to: f64, motion: impl Fn(f64) -> Motion) -> Bridge {
        let (positions, pulse, deviation, sure) = (0, 0, 0.0, true);
        Bridge {
            gap: Gap {
                from,
                to,
                pulse,
                positions,
                deviation,
                sure,
            },
            begin: motion(from),
            end: motion(to),
            pitch: 0.0,
        }
    }

    pub fn holds(&self, time: f64) -> bool {
        time > self.gap.from && time < self.gap.to
    }

    /// The motion at an instant within.
    pub fn at(&self, time: f64) -> Motion {
        let (a, b) = (&self.begin, &self.end);
        let length = self.gap.to - self.gap.from;
        let x = (time - self.gap.from) / length;
        let y = 1.0 - x;
        // Weights of speeds and accelerations in the speed, in its slope and in its integral.
        let weights = [
            y * y * (1.0 + 2.0 * x),
            x * x * (3.0 - 2.0 * x),
            length * x * y * y,
            -length * x * x * y,
        ];
        let slopes = [
            -6.0 * x * y / length,
            6.0 * x * y / length,
            y * (1.0 - 3.0 * x),
            x * (3.0 * x - 2.0),
        ];
        let integrals = |x: f64| {
            let (square, cube, fourth) = (x * x, x.powi(3), x.powi(4));
            [
                length * (x - cube + 0.5 * fourth),
                length * (cube - 0.5 * fourth),
                length * length * (0.5 * square - 2.0 / 3.0 * cube + 0.25 * fourth),
                length * length * (0.25 * fourth - cube / 3.0),
            ]
        };
        let values = [a.speed, b.speed, a.acceleration, b.acceleration];
        let sum = |row: [f64; 4]| row.iter().zip(&values).map(|(w, v)| w * v).sum::<f64>();
        let variance = |row: [f64; 4]| {
            let own = |motion: &Motion, speed: f64, acceleration: f64| {
                let c = &motion.covariance;
                let both = 2.0 * speed * acceleration * c[1][2];
                speed * speed * c[1][1] + acceleration * acceleration * c[2][2] + both
            };
            (own(a, row[0], row[2]) + own(b, row[1], row[3])).max(0.0)
        };
        let bend = (b.acceleration - a.acceleration).abs();
        let mean = 0.5 * (a.acceleration + b.acceleration);
        let step = (b.speed - a.speed - length * mean).abs();
        let open = 4.0 * x * y;
        let speed = open * (length * bend / 8.0 + 0.5 * step);
        let acceleration = open * 0.5 * bend + 2.0 * step / length;
        let missed = b.angle - a.angle - sum(integrals(1.0));
        let count = match self.gap.deviation.is_finite() {
            true => self.gap.deviation * self.pitch,
            false => b.angle - a.angle,
        };
        let angle = variance(integrals(x)) + (count * x).powi(2) + a.covariance[0][0];
        Motion {
            time,
            angle: a.angle + sum(integrals(x)) + missed * x,
            speed: sum(weights),
            acceleration: sum(slopes),
            covariance: [
                [angle, 0.0, 0.0],
                [0.0, variance(weights) + speed * speed, 0.0],
                [0.0, 0.0, variance(slopes) + acceleration * acceleration],
            ],
        }
    }
}
