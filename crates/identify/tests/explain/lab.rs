//! A virtual laboratory: draws a truth, runs three tests on the fine bearing, reads them with an imperfect sensor.

use identify::SteadyMoment;
use identify::explain::Explanation;
use identify::{CageTrace, Measurement};
use physics::rolling::RollingSet;

use super::bearing::{BALL_MASS, BALLS, Bearing, CAGE_MASS, Lubricant, MOMENT, RADIUS, RATIO, Row};

/// Numbers from a seed (xorshift and a sum of uniforms: nothing in common with the product's).
pub struct Chance(u64);

impl Chance {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ 0x1234_5678_9abc_def1)
    }
    pub fn uniform(&mut self) -> f64 {
        for _ in 0..2 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
        }
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }
    pub fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// What the sensor does beside noise, zero and scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    None,
    /// Size over M, time.
    Drift(f64, f64),
    /// Size, time.
    Creep(f64, f64),
    /// Time.
    Slow(f64),
}

/// A truth: a bearing and a sensor, and which bearing the slow tests were made with.
#[derive(Clone, Copy, Debug)]
pub struct Truth {
    pub bearing: Bearing,
    pub fault: Fault,
    pub slow: Slow,
}

/// The steady moment of the slow tests over that of the bearing at 150 rad/s, and its part without speed dependence.
#[derive(Clone, Copy, Debug)]
pub struct Slow {
    pub level: f64,
    pub load_share: f64,
}

impl Slow {
    /// Slow tests with the same bearing.
    pub fn same(bearing: &Bearing) -> Self {
        Self {
            level: 1.0,
            load_share: bearing.load_share,
        }
    }
}

/// Tests of one truth with the curve of its coast-down.
pub struct Campaign {
    pub truth: Truth,
    pub tests: Vec<Measurement>,
    pub steady: SteadyMoment,
    pub set: RollingSet<f64>,
}

pub const TOP: f64 = 150.0;
pub const ENGAGEMENT: f64 = 0.2;
pub const PEAKS: [f64; 3] = [1300.0, 7200.0, 11_500.0];
/// Deviation of the noise per mean of 10 ms is drawn from 0.2 to 0.5 N mm.
const GRID: f64 = 2e-3;
/// Deviation of the cage's speed at a ball over its change since the last one.
const CHANGE: f64 = 0.25;

pub fn set() -> RollingSet<f64> {
    RollingSet {
        inner_track_radius: RADIUS,
        ball_ratio: RATIO,
        balls_mass: BALLS as f64 * BALL_MASS,
        cage_mass: CAGE_MASS,
    }
}

/// Speed of a test: a run-up whose acceleration is a half sine, 5 s of hold, a run-down of 1.5 s.
pub fn course(peak: f64) -> (impl Fn(f64) -> f64 + Copy, f64, f64) {
    let ramp = TOP * std::f64::consts::PI / (2.0 * peak);
    let down = ENGAGEMENT + ramp + 5.0;
    let speed = move |t: f64| {
        let x = ((t - ENGAGEMENT) / ramp).clamp(0.0, 1.0);
        let up = 0.5 * (1.0 - (std::f64::consts::PI * x).cos());
        let left = (1.0 - (t - down) / 1.5).clamp(0.0, 1.0);
        TOP * up * left.powf(1.1) * (1.0 - 0.002 * (t - ENGAGEMENT).clamp(0.0, 2.0))
    };
    (speed, ENGAGEMENT + ramp + 0.2, down + 2.5)
}

impl Truth {
    /// A truth of an explanation, its effect on the torque 15 to 40 % of M.
    pub fn draw(explanation: Explanation, chance: &mut Chance) -> Self {
        let mut bearing = Bearing {
            lubricant: Lubricant {
                grease: None,
                heating: None,
                traction_limit: chance.between(4.0, 10.0),
            },
            load_swing: chance.between(0.2, 0.7),
            slip_speed: chance.between(0.02, 0.1),
            load_share: chance.between(0.05, 0.2),
            orbit_share: chance.between(0.35, 0.65),
        };
        let mut fault = Fault::None;
        let mut slow = Slow::same(&bearing);
        let effect = chance.between(0.15, 0.4);
        let turn = std::f64::consts::TAU;
        match explanation {
            Explanation::Rolling => {}
            Explanation::Grease => {
                bearing.lubricant.grease = Some([
                    chance.between(0.55, 0.85),
                    turn * chance.between(0.2, 2.0),
                    1.0 - effect,
                    chance.between(0.8, 3.0),
                ]);
            }
            Explanation::IsothermalSlip => bearing.lubricant.traction_limit = 1.0 - effect,
            Explanation::HeatedSlip => {
                let cold = chance.between(1.0, 1.5);
                bearing.lubricant.traction_limit = cold;
                bearing.lubricant.heating = Some([
                    cold / (1.0 - effect) - 1.0,
                    chance.between(0.03, 0.15),
                    chance.between(0.8, 3.0),
                ]);
            }
            Explanation::Sensor => {
                let time = chance.between(0.6, 3.0);
                let sign = if chance.uniform() < 0.8 { -1.0 } else { 1.0 };
                fault = match (3.0 * chance.uniform()) as u32 {
                    0 => Fault::Drift(sign * effect, time),
                    1 => Fault::Creep(sign * effect, time),
                    _ => Fault::Slow(chance.between(0.1, 0.5)),
                };
            }
            Explanation::WarmOil => {
                // the film comes to the power of what is left
                let softening = effect / (1.0 - effect).powi(2);
                bearing.lubricant.heating = Some([0.0, softening, chance.between(0.8, 3.0)]);
            }
            Explanation::AnotherMoment => {
                let sign = if chance.uniform() < 0.5 { -1.0 } else { 1.0 };
                slow = Slow {
                    level: 1.0 / (1.0 + sign * effect),
                    load_share: chance.between(0.05, 0.2),
                };
            }
        }
        Self {
            bearing,
            fault,
            slow,
        }
    }

    /// The three tests of the paper.
    pub fn campaign(self, chance: &mut Chance) -> Campaign {
        let scale = 1.0 + 0.01 * chance.normal();
        let noise = 1e-3 * chance.between(0.2, 0.5);
        let tests = (PEAKS.iter())
            .map(|peak| {
                let (speed, fine_until, end) = course(*peak);
                let rows = self.bearing.run(speed, end, fine_until);
                self.read(&rows, *peak, scale, noise, chance)
            })
            .collect();
        Campaign {
            truth: self,
            tests,
            steady: self.coast_down(chance),
            set: set(),
        }
    }

    /// M(Ω) of a coast-down: right within its band.
    fn coast_down(&self, chance: &mut Chance) -> SteadyMoment {
        let speed: Vec<f64> = (0..16).map(|i| 3.0 + 9.8 * f64::from(i)).collect();
        let (level, tilt) = (0.007 * chance.normal(), 0.005 * chance.normal());
        let tilted = |speed: f64| 1.0 - 2.0 * speed / TOP;
        let slow = Bearing {
            load_share: self.slow.load_share,
            ..self.bearing
        };
        let exact: Vec<f64> = (speed.iter())
            .map(|w| self.slow.level * slow.steady(*w))
            .collect();
        let moment = (exact.iter().zip(&speed))
            .map(|(m, w)| m * (1.0 + level + tilt * tilted(*w)) + 5e-5 * chance.normal())
            .collect();
        let mut covariance = Vec::new();
        for (i, (m, w)) in exact.iter().zip(&speed).enumerate() {
            let mut row = Vec::new();
            for (j, (n, v)) in exact.iter().zip(&speed).enumerate() {
                let own = if i == j { 5e-5_f64.powi(2) } else { 0.0 };
                let shared = 0.007_f64.powi(2) + 0.005_f64.powi(2) * tilted(*w) * tilted(*v);
                row.push(m * n * shared + own);
            }
            covariance.push(row);
        }
        SteadyMoment {
            load: 50.0,
            speed,
            moment,
            covariance,
            scale_deviation: 0.0,
        }
    }

    /// What the laboratory knows of one run: a torque smoothed by the inversion of its sensor, with coloured noise and
    /// what is left of the synchronous vibration.
    fn read(
        &self,
        rows: &[Row],
        peak: f64,
        scale: f64,
        noise: f64,
        chance: &mut Chance,
    ) -> Measurement {
        let zero = 0.3e-3 * chance.normal();
        // noise of 10 ms correlation: a mean of 10 ms keeps 86 % of its deviation
        let sigma = noise / 0.86;
        let kept = (-GRID / 0.01_f64).exp();
        let mut coloured = sigma * chance.normal();
        let synchronous = 1e-3 * chance.between(0.0, 0.3);
        let (mut smooth, mut smoother, mut slow, mut slower) = (0.0, 0.0, 0.0, 0.0);
        let (mut angle, mut last, mut next) = (chance.between(0.0, 6.0), 0.0, GRID);
        let mut m = Measurement {
            name: format!("{peak} rad/s²"),
            load: 50.0,
            time: Vec::new(),
            speed: Vec::new(),
            speed_deviation: Vec::new(),
            acceleration: Vec::new(),
            acceleration_deviation: Vec::new(),
            torque: Vec::new(),
            torque_deviation: Vec::new(),
            zero_deviation: 0.3e-3,
            scale_deviation: 0.01,
            correlation_time: Vec::new(),
            engagement: Some(ENGAGEMENT),
            engagement_deviation: 0.0,
            rest_before: None,
            cage: None,
            temperature: None,
        };
        let (mut cage_time, mut cage_speed, mut cage_deviation) =
            (Vec::new(), Vec::new(), Vec::new());
        let cage_bias = 1.0 + 0.001 * chance.normal();
        let pitch = std::f64::consts::TAU / BALLS as f64;
        let (mut cage_angle, mut next_ball) = (0.0, pitch * chance.uniform());
        let mut last_cage = 0.0;
        let mut last_speed = 0.0;
        for row in rows {
            let h = row.time - last;
            last = row.time;
            angle += row.speed * h;
            let age = (row.time - ENGAGEMENT).max(0.0);
            let mut torque = row.outer_moment;
            if let Fault::Slow(time) = self.fault {
                slow += (1.0 - (-h / time).exp()) * (torque - slow);
                slower += (1.0 - (-5.0 * h / time).exp()) * (slow - slower);
                torque = slower;
            }
            if let Fault::Creep(size, time) = self.fault {
                torque *= 1.0 + size * (1.0 - (-age / time).exp());
            }
            if let Fault::Drift(size, time) = self.fault {
                torque += size * MOMENT * (1.0 - (-age / time).exp());
            }
            smooth += (1.0 - (-h / 4e-3).exp()) * (torque - smooth);
            smoother += (1.0 - (-h / 4e-3).exp()) * (smooth - smoother);
            cage_angle += row.cage * h;
            if cage_angle >= next_ball {
                // a ball passes
                next_ball += pitch;
                // between two balls it is known by as much as it changes at most
                let change = row.cage - last_cage;
                last_cage = row.cage;
                let noise = 0.005 * row.cage.abs() + 0.05;
                let deviation = noise.hypot(CHANGE * change);
                if cage_time.is_empty() {
                    // from rest to the first ball the speed is hardly known
                    cage_time.push(ENGAGEMENT);
                    cage_speed.push(0.0);
                    cage_deviation.push(deviation);
                }
                cage_time.push(row.time);
                cage_speed.push(row.cage * cage_bias + noise * chance.normal());
                cage_deviation.push(deviation);
            }
            if row.time < next - 1e-9 {
                continue;
            }
            next += GRID;
            coloured = kept * coloured + sigma * (1.0 - kept * kept).sqrt() * chance.normal();
            let reading = scale * smoother * (1.0 + 0.004 * smoother / MOMENT)
                + zero
                + coloured
                + synchronous * (row.speed / TOP).powi(2) * angle.cos();
            m.time.push(row.time);
            m.speed.push((row.speed + 0.03 * chance.normal()).max(0.0));
            m.speed_deviation.push(0.03);
            m.acceleration.push((row.speed - last_speed) / GRID);
            m.acceleration_deviation.push(20.0);
            last_speed = row.speed;
            m.torque.push(reading);
            m.correlation_time.push(0.02);
            m.torque_deviation
                .push((sigma * sigma + 0.3e-3_f64.powi(2) + (0.01 * reading).powi(2)).sqrt());
        }
        m.cage = Some(CageTrace::independent(
            cage_time,
            cage_speed,
            cage_deviation,
        ));
        m
    }
}
