//! One test, as measured by its signals.

use crate::series::ages;
use physics::rolling::RollingSet;

/// Speed, acceleration and torque of one test on a common grid of times. All values are SI.
///
/// The deviations are standard deviations of one value; torques close in time share most of their error.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Name for messages.
    pub name: String,
    /// Radial load on the bearing, N.
    pub load: f64,
    /// Times, s; rising.
    pub time: Vec<f64>,
    /// Speed Ω of the inner race, rad/s.
    pub speed: Vec<f64>,
    /// Its standard deviation, rad/s.
    pub speed_deviation: Vec<f64>,
    /// Acceleration Ω̇ of the inner race, rad/s².
    pub acceleration: Vec<f64>,
    /// Its standard deviation, rad/s².
    pub acceleration_deviation: Vec<f64>,
    /// Torque t_O that the bearing exerts on its outer race, N m.
    pub torque: Vec<f64>,
    /// Its standard deviation with noise, zero and scale, N m.
    pub torque_deviation: Vec<f64>,
    /// Standard deviation of the zero of the torque alone, N m: an error that all torques of the test share.
    pub zero_deviation: f64,
    /// Relative standard deviation of the scale of the torque alone: shared by all tests of one sensor.
    pub scale_deviation: f64,
    /// Time after which two errors of the torque count as independent at each time, zero and scale apart, s: a torque is
    /// smoothed less while it changes.
    pub correlation_time: Vec<f64>,
    /// When the clutch engaged, s; none where nothing changed quickly.
    pub engagement: Option<f64>,
    /// Standard deviation of that time, s.
    pub engagement_deviation: f64,
    /// Time at rest since a test before that ran the bearing as this one does, s; none where it had rested for long.
    pub rest_before: Option<f64>,
    /// Speed of the cage, where it was measured.
    pub cage: Option<CageTrace>,
    /// Temperature of the outer race over `time`, K above the start; where it was measured.
    pub temperature: Option<Vec<f64>>,
}

/// Part of the largest speed within which the shaft counts as at speed.
const AT_SPEED: f64 = 0.01;

/// Speed of the cage over times of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct CageTrace {
    /// Times, s; rising.
    pub time: Vec<f64>,
    /// Speed ω_c, rad/s.
    pub speed: Vec<f64>,
    /// Its standard deviation, rad/s.
    pub deviation: Vec<f64>,
    /// Time after which two of its errors count as independent at each time, s.
    pub correlation_time: Vec<f64>,
}

impl CageTrace {
    /// Values with errors of their own: between two of them, on a straight line, errors are alike.
    ///
    /// - `time`: s; rising
    /// - `speed`, `deviation`: rad/s, of the same length
    pub fn independent(time: Vec<f64>, speed: Vec<f64>, deviation: Vec<f64>) -> Self {
        let correlation_time = spacing(&time);
        Self {
            time,
            speed,
            deviation,
            correlation_time,
        }
    }

    /// Age of its errors in correlation times.
    pub(crate) fn age(&self) -> Vec<f64> {
        ages(&self.time, &self.correlation_time)
    }
}

/// Distance of each time to its neighbours, the mean of both sides; 0 of a single one.
pub(crate) fn spacing(time: &[f64]) -> Vec<f64> {
    (0..time.len())
        .map(|k| {
            let (before, after) = (k.saturating_sub(1), (k + 1).min(time.len() - 1));
            (time[after] - time[before]) / (after - before).max(1) as f64
        })
        .collect()
}

/// Relative standard deviations of what a rolling set is made of: what is not known of the inertia of balls and cage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SetDeviation {
    /// Of the mass of all balls, 1.
    pub balls_mass: f64,
    /// Of the mass of the cage, 1.
    pub cage_mass: f64,
    /// Of the radius of the inner race track, 1.
    pub inner_track_radius: f64,
}

impl SetDeviation {
    /// Standard deviation of the inertia J_O at the outer race, kg m².
    ///
    /// Formula: σ² = [(1+2s) R²]² [(3/20 N m_b σ_b)² + (¼ m_c σ_c)²] + (2 J_O σ_R)²
    pub fn outer_inertia(&self, set: &RollingSet<f64>) -> f64 {
        let arm = (1.0 + 2.0 * set.ball_ratio) * set.inner_track_radius.powi(2);
        (0.15 * set.balls_mass * self.balls_mass * arm)
            .hypot(0.25 * set.cage_mass * self.cage_mass * arm)
            .hypot(2.0 * set.outer_inertia() * self.inner_track_radius)
    }

    /// Standard deviation of the inertia J_I at the inner race, kg m².
    ///
    /// Formula: σ² = R⁴ [(7/20 N m_b σ_b)² + (¼ m_c σ_c)²] + (2 J_I σ_R)²
    pub fn inner_inertia(&self, set: &RollingSet<f64>) -> f64 {
        let square = set.inner_track_radius.powi(2);
        (0.35 * set.balls_mass * self.balls_mass * square)
            .hypot(0.25 * set.cage_mass * self.cage_mass * square)
            .hypot(2.0 * set.inner_inertia() * self.inner_track_radius)
    }

    /// Whether all deviations are finite and not negative.
    pub(crate) fn sound(&self) -> Result<(), String> {
        for (name, value) in [
            ("ball mass", self.balls_mass),
            ("cage mass", self.cage_mass),
            ("track radius", self.inner_track_radius),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(format!(
                    "the relative deviation of the {name} is {value}; it must be finite and not negative"
                ));
            }
        }
        Ok(())
    }
}

impl Measurement {
    /// Says what is wrong with a measurement; nothing if it can be used.
    pub fn sound(&self) -> Result<(), String> {
        let name = &self.name;
        let count = self.time.len();
        for (what, list) in [
            ("speeds", &self.speed),
            ("deviations of speed", &self.speed_deviation),
            ("accelerations", &self.acceleration),
            ("deviations of acceleration", &self.acceleration_deviation),
            ("torques", &self.torque),
            ("deviations of torque", &self.torque_deviation),
            ("correlation times", &self.correlation_time),
        ] {
            listed(name, what, list, count)?;
        }
        if let Some(temperature) = &self.temperature {
            listed(name, "temperatures", temperature, count)?;
        }
        rising(name, "times", &self.time)?;
        for (what, list) in [
            ("speed", &self.speed_deviation),
            ("acceleration", &self.acceleration_deviation),
            ("torque", &self.torque_deviation),
            ("correlation in time", &self.correlation_time),
        ] {
            not_negative(name, what, list)?;
        }
        for (what, value) in [
            ("load", self.load),
            ("deviation of the zero", self.zero_deviation),
            ("deviation of the scale", self.scale_deviation),
            ("deviation of the engagement", self.engagement_deviation),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(format!(
                    "{name}: the {what} is {value}; it must be finite and not negative"
                ));
            }
        }
        if let Some(engagement) = self.engagement
            && !engagement.is_finite()
        {
            return Err(format!("{name}: the time of engagement is {engagement}"));
        }
        if let Some(cage) = &self.cage {
            let count = cage.time.len();
            listed(name, "cage speeds", &cage.speed, count)?;
            listed(name, "deviations of cage speed", &cage.deviation, count)?;
            rising(name, "times of the cage", &cage.time)?;
            not_negative(name, "cage speed", &cage.deviation)?;
            let correlation = &cage.correlation_time;
            listed(name, "correlation times of the cage", correlation, count)?;
            not_negative(name, "cage's correlation time", correlation)?;
        }
        Ok(())
    }

    /// When the test begins, s: at its engagement, else with its record.
    pub fn begin(&self) -> f64 {
        let first = self.time.first().copied().unwrap_or(0.0);
        self.engagement.unwrap_or(first)
    }

    /// The largest speed of the shaft without sign, rad/s.
    pub fn fastest(&self) -> f64 {
        self.speed
            .iter()
            .fold(0.0, |top: f64, speed| top.max(speed.abs()))
    }

    /// The last time at which the shaft turns within 1 % of its largest speed, s.
    pub fn last_at_speed(&self) -> f64 {
        let at_speed = (1.0 - AT_SPEED) * self.fastest();
        let last = (self.time.iter().zip(&self.speed))
            .rfind(|(_, speed)| speed.abs() >= at_speed)
            .map(|(time, _)| *time);
        last.unwrap_or_else(|| self.begin())
    }

    /// The part of a measurement between two times, s, both included.
    pub fn between(&self, from: f64, to: f64) -> Measurement {
        let cut = |time: &[f64]| {
            let first = time.partition_point(|&t| t < from);
            first..time.partition_point(|&t| t <= to).max(first)
        };
        let own = cut(&self.time);
        let part = |list: &[f64]| list[own.clone()].to_vec();
        Measurement {
            name: self.name.clone(),
            load: self.load,
            time: part(&self.time),
            speed: part(&self.speed),
            speed_deviation: part(&self.speed_deviation),
            acceleration: part(&self.acceleration),
            acceleration_deviation: part(&self.acceleration_deviation),
            torque: part(&self.torque),
            torque_deviation: part(&self.torque_deviation),
            zero_deviation: self.zero_deviation,
            scale_deviation: self.scale_deviation,
            correlation_time: part(&self.correlation_time),
            engagement: self.engagement,
            engagement_deviation: self.engagement_deviation,
            rest_before: self.rest_before,
            cage: self.cage.as_ref().map(|cage| {
                let range = cut(&cage.time);
                CageTrace {
                    time: cage.time[range.clone()].to_vec(),
                    speed: cage.speed[range.clone()].to_vec(),
                    deviation: cage.deviation[range.clone()].to_vec(),
                    correlation_time: cage.correlation_time[range].to_vec(),
                }
            }),
            temperature: self.temperature.as_deref().map(part),
        }
    }

    /// Age of the torque's noise in correlation times since the first time: what two times are apart, their errors are alike by
    /// e^(-2 apart).
    ///
    /// Formula: ∫dt/τ
    pub(crate) fn noise_age(&self) -> Vec<f64> {
        ages(&self.time, &self.correlation_time)
    }

    /// The correlation time at a time, s; at the nearest one that was measured.
    pub(crate) fn correlation_time_at(&self, time: f64) -> f64 {
        let above = self.time.partition_point(|t| *t < time);
        let count = self.correlation_time.len();
        self.correlation_time
            .get(above.min(count.saturating_sub(1)))
            .copied()
            .unwrap_or(0.0)
    }

    /// Standard deviation of one torque without zero and scale, N m.
    ///
    /// Formula: √(σ² - σ_zero² - (σ_scale t_O)²), 0 where the whole is smaller than its parts
    pub fn torque_noise(&self, index: usize) -> f64 {
        let shared =
            self.zero_deviation.powi(2) + (self.scale_deviation * self.torque[index]).powi(2);
        (self.torque_deviation[index].powi(2) - shared)
            .max(0.0)
            .sqrt()
    }
}

fn listed(name: &str, what: &str, list: &[f64], count: usize) -> Result<(), String> {
    if list.len() != count {
        return Err(format!("{name}: {} {what} for {count} times", list.len()));
    }
    match list.iter().position(|value| !value.is_finite()) {
        Some(at) => Err(format!("{name}: number {at} of the {what} is {}", list[at])),
        None => Ok(()),
    }
}

fn rising(name: &str, what: &str, time: &[f64]) -> Result<(), String> {
    if time.len() < 2 {
        return Err(format!(
            "{name}: {} {what}; at least 2 are needed",
            time.len()
        ));
    }
    let ordered = time.windows(2).all(|pair| pair[1] > pair[0]);
    if ordered && time[0].is_finite() && time[time.len() - 1].is_finite() {
        Ok(())
    } else {
        Err(format!("{name}: the {what} do not rise"))
    }
}

fn not_negative(name: &str, what: &str, list: &[f64]) -> Result<(), String> {
    if list.iter().any(|&value| value < 0.0) {
        return Err(format!("{name}: a deviation of the {what} is negative"));
    }
    Ok(())
}
