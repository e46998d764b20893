//! The energy that a spin-up dissipates in the bearing, read at the outer race.
//!
//! ```text
//!   printed (21)  D = (1+2s) ∫t_O Ω dt + ½ J_O Ω0²        counts the moment of the outer race (1+2s) times
//!   corrected     D =        ∫t_O Ω dt + ½ J_O Ω0²        balls roll all the way
//!   exact         D =        ∫t_O Ω dt + ∫Ω dL - Δ(KE)    any slip; L and KE from the measured cage speed
//!   no cage       ∫Ω dL anywhere between its bounds:      a range, of balls that roll at the end
//!   any slip      from ∫t_O Ω dt, balls not spun up, to the largest of that range
//! ```
//! The spin of the balls is not measured: in L and KE it lies between the two values of a ball that grips at least one race,
//! (1+s) ω_c/s and [Ω - (1+s) ω_c]/s; half the distance of what both give is one deviation. Their spin is 4 % of L.
//!
//! The printed form is wrong by 2s ∫t_O Ω dt when the balls roll: too large where the outer race was driven on the whole
//! (∫t_O Ω dt > 0), too small, down to less than nothing, where inertia made it drive the shaft; against slipping balls it lacks
//! up to ½ L0 Ω0 besides.
//!
//! The deviation of ∫t_O Ω dt holds the noise of the torque with its correlation, zero, scale and speed.
//!
//! **Does not model**: a test that does not start at rest; something that drags balls or cage to the frame; strain energy of the
//! contacts; balls that are not seen and spin at the end of the window while the cage nearly stands.
//!
//! Measured (`tests/energy.rs`, 400 seeds, band of two deviations): the true loss lies in the band of the exact form in
//! 94.0 % of the seeds, and within the range without a cage, widened by two deviations, in 99.8 %. The corrected form alone was too
//! small by more than two deviations in 38 % of them: the cages lagged by 5 to 35 ms.

use crate::measurement::{Measurement, SetDeviation};
use crate::series::{RunningVariance, trapezoid};
use physics::rolling::RollingSet;
use physics::spin_up_energy::{SpinUpEnergy, spin_up_loss};
use problem::{note, note::Note};
use statistics::interpolation::{between, held};
use statistics::normal::below;
use statistics::uncertain::Uncertain;

/// What a spin-up dissipates.
#[derive(Clone, Debug, PartialEq)]
pub struct Dissipation {
    /// From when to when, s.
    pub window: (f64, f64),
    /// ∫t_O Ω dt, J.
    pub outer_moment_work: Uncertain,
    /// (21) as printed, J: for comparison.
    pub printed: Uncertain,
    /// Balls that roll all the way, J.
    pub corrected: Uncertain,
    /// Least loss without a cage signal, J: that of balls that roll all the way; of balls that were not spun up where they may slip
    /// at the end, see [`Dissipation::with_any_slip`].
    pub least: Uncertain,
    /// Largest loss without a cage signal, J: balls that spin with the race and orbit last.
    pub largest: Uncertain,
    /// The loss without a cage signal, J: the middle of the range, the range counting as evenly likely.
    pub without_cage: Uncertain,
    /// The loss with the cage signal, J, where there is one over the whole window.
    pub exact: Option<Uncertain>,
    /// What the printed form is wrong by: printed minus exact, or minus the loss without a cage signal, J.
    pub printed_error: Uncertain,
    /// Probability that the printed form is too large.
    pub printed_too_large: f64,
    /// What is not trustworthy.
    pub notes: Vec<Note>,
}

impl Dissipation {
    /// The best that is known of the loss, J.
    pub fn best(&self) -> Uncertain {
        self.exact.unwrap_or(self.without_cage)
    }

    /// The same where the balls may still slip at the end of the window: without a cage signal the range begins at balls that were
    /// not spun up at all.
    ///
    /// Formula: least D = ∫t_O Ω dt, see [`SpinUpEnergy::loss_range_of_any_slip`]
    ///
    /// - `set`: balls and cage
    pub fn with_any_slip(mut self, set: &RollingSet<f64>) -> Self {
        if self.exact.is_some() {
            return self;
        }
        self.least = self.outer_moment_work;
        self.without_cage = anywhere(self.least, self.largest);
        (self.printed_error, self.printed_too_large) = error_of_printed(
            self.printed,
            self.without_cage,
            self.outer_moment_work,
            set.ball_ratio,
        );
        self.notes.push(note!(
            "nothing excludes slip at the end of the spin-up: without a cage signal the range of its energy begins at balls that were not spun up at all"
        ));
        self
    }

    /// How the printed form is wrong, in words.
    pub fn printed_verdict(&self) -> String {
        let error = match self.printed_too_large {
            p if p > 0.975 => "too large",
            p if p < 0.025 => "too small",
            _ => "wrong by an amount whose sign these data do not determine",
        };
        let negative = if self.printed.value < 0.0 {
            "; it is negative, which no loss can be"
        } else {
            ""
        };
        format!(
            "(21) as printed is {error}: {} J{negative}",
            self.printed_error
        )
    }
}

/// The spin-up of a test: from the engagement, or the last rest, to the time at which 99 % of the fastest speed is reached.
pub fn spin_up_window(test: &Measurement) -> Result<(f64, f64), String> {
    test.sound()?;
    let top = test.fastest();
    if top == 0.0 {
        return Err(format!("{}: the shaft never turns", test.name));
    }
    let Some(end) = test
        .speed
        .iter()
        .position(|speed| speed.abs() >= 0.99 * top)
    else {
        return Err(format!("{}: the shaft never turns", test.name));
    };
    let start = test.engagement.or_else(|| {
        test.speed[..end]
            .iter()
            .rposition(|speed| speed.abs() <= 0.01 * top)
            .map(|k| test.time[k])
    });
    match start {
        Some(start) if start < test.time[end] => Ok((start, test.time[end])),
        _ => Err(format!(
            "{}: no spin-up from rest is in the record",
            test.name
        )),
    }
}

/// The energy that a spin-up dissipates.
///
/// Formula: as on this page
///
/// - `test`: a spin-up from rest
/// - `set`: balls and cage
/// - `set_deviation`: what is not known of them
/// - `window`: from rest to when, s; none for [`spin_up_window`]
///
/// Refused: no spin-up in the record; a window that does not start at rest.
pub fn dissipation(
    test: &Measurement,
    set: &RollingSet<f64>,
    set_deviation: &SetDeviation,
    window: Option<(f64, f64)>,
) -> Result<Dissipation, String> {
    test.sound()?;
    set_deviation.sound()?;
    let window = match window {
        Some(window) => window,
        None => spin_up_window(test)?,
    };
    if !(window.0.is_finite() && window.1.is_finite() && window.0 < window.1) {
        return Err(format!(
            "{}: the window from {} s to {} s has no length",
            test.name, window.0, window.1
        ));
    }
    let part = test.between(window.0, window.1);
    if part.time.len() < 3 {
        return Err(format!(
            "{}: {} values between {} s and {} s; at least 3 are needed",
            test.name,
            part.time.len(),
            window.0,
            window.1
        ));
    }
    let top = part.fastest();
    if part.speed[0].abs() > 0.1 * top {
        return Err(format!(
            "{}: the shaft turns with {:.4} rad/s at {} s already: the loss is that of a spin-up from rest",
            test.name, part.speed[0], window.0
        ));
    }
    if !(set.outer_inertia().is_finite() && set.inner_inertia().is_finite() && set.ball_ratio > 0.0)
    {
        return Err("masses and radii of balls and cage must be positive and finite".into());
    }
    let last = part.speed.len() - 1;
    let (final_speed, speed_deviation) = (part.speed[last], part.speed_deviation[last]);
    let work = outer_moment_work(&part);
    let energy = SpinUpEnergy {
        set: *set,
        final_speed,
        outer_moment_work: work.value,
    };
    let relative_speed = 2.0 * speed_deviation / final_speed.abs();
    let inertia_deviation = (0.5 * set_deviation.outer_inertia(set) * final_speed.powi(2))
        .hypot(relative_speed * energy.inertia_term());
    let shifted = |value: f64, factor: f64, inertia: f64| {
        Uncertain::new(value, (factor * work.deviation).hypot(inertia))
    };
    let factor = 1.0 + 2.0 * set.ball_ratio;
    let printed = shifted(energy.printed_loss(), factor, inertia_deviation);
    let corrected = shifted(energy.rolling_loss(), 1.0, inertia_deviation);
    let (low, high) = energy.loss_range();
    // beyond the least the largest has ½ (J_I + J_O) Ω0² and the spin 0.2 s N m_b R² Ω0²
    let spin = 0.2 * set.ball_ratio * set.balls_mass * set.inner_track_radius.powi(2);
    let both = set_deviation.outer_inertia(set)
        + 0.5 * set_deviation.inner_inertia(set)
        + set_deviation.balls_mass * spin;
    let largest_deviation =
        (both * final_speed.powi(2)).hypot(relative_speed * (high - work.value));
    let least = shifted(low, 1.0, inertia_deviation);
    let largest = shifted(high, 1.0, largest_deviation);
    let without_cage = anywhere(least, largest);
    let mut notes = Vec::new();
    let exact = match with_cage(test, &part, set, set_deviation, window, work) {
        Ok(found) => Some(found),
        Err(why) => {
            notes.push(note!(
                "{}: the path term counts as unknown between its bounds",
                why
            ));
            None
        }
    };
    let best: Uncertain = exact.unwrap_or(without_cage);
    let (printed_error, printed_too_large) = error_of_printed(printed, best, work, set.ball_ratio);
    Ok(Dissipation {
        window: (part.time[0], part.time[last]),
        outer_moment_work: work,
        printed,
        corrected,
        least,
        largest,
        without_cage,
        exact,
        printed_error,
        printed_too_large,
        notes,
    })
}

/// A value that is as likely anywhere between two.
fn anywhere(least: Uncertain, largest: Uncertain) -> Uncertain {
    let width = (largest.value - least.value).abs() / 12_f64.sqrt();
    let deviation = least.deviation.max(largest.deviation);
    Uncertain::new(0.5 * (least.value + largest.value), deviation.hypot(width))
}

/// The printed form minus the loss, J, and the probability that it is too large.
///
/// - `work`: ∫t_O Ω dt, J
/// - `s`: ball ratio
fn error_of_printed(
    printed: Uncertain,
    loss: Uncertain,
    work: Uncertain,
    s: f64,
) -> (Uncertain, f64) {
    // what printed and true loss do not share: 2s of the work, and the inertia terms
    let extra = 2.0 * s * work.deviation;
    let own = (loss.deviation.powi(2) - work.deviation.powi(2))
        .max(0.0)
        .sqrt();
    let error = Uncertain::new(printed.value - loss.value, extra.hypot(own));
    let too_large = if error.deviation > 0.0 {
        below(error.value / error.deviation)
    } else {
        f64::from(u8::from(error.value > 0.0))
    };
    (error, too_large)
}

/// ∫t_O Ω dt, J, of a measurement.
///
/// Formula: σ² = ΣΣ n_i n_j σ_i σ_j e^(-2|∫dt/τ|) + (σ_zero ∫Ω dt)² + (σ_scale ∫t_O Ω dt)² + (∫|t_O| σ_Ω dt)², n = Ω dt
///
/// - `test`: speed and torque with their deviations
pub fn outer_moment_work(test: &Measurement) -> Uncertain {
    let weights = trapezoid(&test.time);
    let age = test.noise_age();
    let mut noise = RunningVariance::default();
    let (mut work, mut angle, mut by_speed, mut variance) = (0.0, 0.0, 0.0, 0.0);
    for (k, weight) in weights.iter().enumerate() {
        let turned = weight * test.speed[k];
        work += test.torque[k] * turned;
        angle += turned;
        by_speed += weight * test.torque[k].abs() * test.speed_deviation[k];
        variance = noise.add(age[k], turned * test.torque_noise(k));
    }
    let deviation = variance
        .max(0.0)
        .sqrt()
        .hypot(test.zero_deviation * angle)
        .hypot(test.scale_deviation * work)
        .hypot(by_speed);
    Uncertain::new(work, deviation)
}

/// Exact loss from the cage speed.
fn with_cage(
    test: &Measurement,
    part: &Measurement,
    set: &RollingSet<f64>,
    set_deviation: &SetDeviation,
    window: (f64, f64),
    work: Uncertain,
) -> Result<Uncertain, Note> {
    let cage = (test.cage.as_ref()).ok_or_else(|| note!("no cage signal"))?;
    let (s, radius) = (set.ball_ratio, set.inner_track_radius);
    // KE = ½ orbit ω_c² + ½ spin ω_b², L = orbit ω_c - spin ω_b: balls spin against the race
    let orbit = (set.balls_mass + set.cage_mass) * (radius * (1.0 + s)).powi(2);
    let spin = 0.4 * set.balls_mass * (s * radius).powi(2);
    let missing = || {
        note!(
            "the cage signal does not cover the spin-up from {:.4} s to {:.4} s",
            window.0,
            window.1
        )
    };
    let age = cage.age();
    let mut times: Vec<(f64, f64)> = Vec::new();
    // deviation and age of the cage's error at each time
    let mut errors: Vec<(f64, f64)> = Vec::new();
    for (k, &time) in part.time.iter().enumerate() {
        let (own, deviation) = match (
            between(&cage.time, &cage.speed, time),
            between(&cage.time, &cage.deviation, time),
        ) {
            (Some(own), Some(deviation)) => (own, deviation),
            // a sensor of passing balls shows nothing before the first has passed: the cage starts from rest
            _ if k == 0 || part.speed[k].abs() < 0.1 * part.speed[part.speed.len() - 1].abs() => {
                (0.0, 0.0)
            }
            _ => return Err(missing()),
        };
        times.push((part.speed[k], own));
        errors.push((deviation, held(&cage.time, &age, time)));
    }
    // sum over one bound of the ball spin: grips outside (true) or inside
    let sums = |outside: bool| {
        let spin_of = |speed: f64, own: f64| {
            if outside {
                (1.0 + s) * own / s
            } else {
                (speed - (1.0 + s) * own) / s
            }
        };
        let momentum = |speed: f64, own: f64| orbit * own - spin * spin_of(speed, own);
        let path: f64 = times
            .windows(2)
            .map(|p| {
                0.5 * (p[0].0 + p[1].0) * (momentum(p[1].0, p[1].1) - momentum(p[0].0, p[0].1))
            })
            .sum();
        let kinetic = |speed: f64, own: f64| {
            0.5 * orbit * own * own + 0.5 * spin * spin_of(speed, own).powi(2)
        };
        let (first, last) = (times[0], times[times.len() - 1]);
        (path, kinetic(last.0, last.1) - kinetic(first.0, first.1))
    };
    let (outside, inside) = (sums(true), sums(false));
    let exact = |of: (f64, f64)| spin_up_loss(work.value, 0.0, of.0, of.1);
    let value = 0.5 * (exact(outside) + exact(inside));
    let last = times[times.len() - 1];
    // ∫Ω dL = [ΩL] - ∫L dΩ and ΔKE = orbit ω_c dω_c at the end: sums over one error of the cage that fades with time
    let by_cage = |at_end: f64| {
        let mut error = RunningVariance::default();
        let mut variance = 0.0;
        for (k, (deviation, age)) in errors.iter().enumerate() {
            let (before, after) = (k.saturating_sub(1), (k + 1).min(times.len() - 1));
            let mut share = -0.5 * (times[after].0 - times[before].0);
            if k + 1 == times.len() {
                share += at_end;
            }
            variance = error.add(*age, orbit * share * deviation);
        }
        variance.max(0.0).sqrt()
    };
    let masses = {
        let total = set.balls_mass + set.cage_mass;
        let inertial = value - work.value;
        (set_deviation.balls_mass * set.balls_mass / total * inertial)
            .hypot(set_deviation.cage_mass * set.cage_mass / total * inertial)
            .hypot(2.0 * set_deviation.inner_track_radius * inertial)
    };
    let deviation = work
        .deviation
        .hypot(by_cage(last.0 - last.1))
        .hypot(0.5 * (exact(outside) - exact(inside)))
        .hypot(masses);
    Ok(Uncertain::new(value, deviation))
}
