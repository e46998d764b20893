//! Rolling contact fatigue: rating loads of a ball, damage of any history, factors of life.

/// Weibull slope e of bearings, 10/9.
/// Source: Lundberg and Palmgren (from memory: check before quoting).
pub const WEIBULL_SLOPE: f64 = 10.0 / 9.0;

/// Geometry that the rating load of a ball asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RatedBearing {
    /// Dynamic rating C, N.
    pub rating: f64,
    /// Balls of one row.
    pub ball_count: f64,
    /// γ = D cos α/d_m.
    pub gamma: f64,
    /// Groove radius over ball diameter, inner and outer ring.
    pub grooves: [f64; 2],
    /// Nominal contact angle α, rad; 0 for deep groove also under axial load.
    pub contact_angle: f64,
}

impl RatedBearing {
    /// Load of one ball at the dynamic rating, inner and outer ring: Q_ci, Q_ce, N.
    ///
    /// Q_ci = C/(0.407 Z cos^0.7 α) · {1 + b^(10/3)}^0.3, Q_ce with 0.389 and b^(−10/3),
    /// b = 1.044 ((1−γ)/(1+γ))^1.72 (f_i(2f_e−1)/(f_e(2f_i−1)))^0.41.
    ///
    /// Source: ISO/TS 16281.
    /// Valid: one row of balls, C of the standard.
    pub fn ball_rating_loads(&self) -> [f64; 2] {
        let [inner, outer] = self.grooves;
        let bracket = 1.044
            * ((1.0 - self.gamma) / (1.0 + self.gamma)).powf(1.72)
            * (inner * (2.0 * outer - 1.0) / (outer * (2.0 * inner - 1.0))).powf(0.41);
        let share = self.ball_count * self.contact_angle.cos().powf(0.7);
        [
            self.rating / (0.407 * share) * (1.0 + bracket.powf(10.0 / 3.0)).powf(0.3),
            self.rating / (0.389 * share) * (1.0 + bracket.powf(-10.0 / 3.0)).powf(0.3),
        ]
    }

    /// Share of L10 that the passages of a run use at the points of the inner and of the outer ring, S/(z 1e6 Q_c³) of S = Σ Q³, N³.
    ///
    /// Source: [`ring_damage`].
    /// Valid: as this; what passes a point adds up, also across runs.
    pub fn by_point(&self, sums: [&[f64]; 2]) -> [Vec<f64>; 2] {
        let passages = passages_per_turn(self.ball_count, self.gamma);
        let loads = self.ball_rating_loads();
        [0, 1].map(|k| point_damages(sums[k], passages[k], loads[k]))
    }
}

/// Balls that pass a fixed point of the inner and of the outer ring per turn of the inner ring: Z(1 ± γ)/2.
///
/// Source: kinematics of rolling.
/// Valid: outer ring at rest, no slip of the cage.
pub fn passages_per_turn(ball_count: f64, gamma: f64) -> [f64; 2] {
    [
        0.5 * ball_count * (1.0 + gamma),
        0.5 * ball_count * (1.0 - gamma),
    ]
}

/// Share of the rating life that a ring has used: [mean_φ (S/z)^(10/9)]^(9/10)/(1e6 Q_c³).
///
/// Arguments: S = Σ Q³ over all passages at each point of the ring, N³; passages z per turn; rating load Q_c N. S adds
/// across drops before the power is taken.
///
/// Source: derived; equals the L10r of ISO/TS 16281 for constant motion.
/// Valid: P ≤ 0.5 C.
pub fn ring_damage(sums: &[f64], passages: f64, rating_load: f64) -> f64 {
    mean_damage(&point_damages(sums, passages, rating_load))
}

fn point_damages(sums: &[f64], passages: f64, rating_load: f64) -> Vec<f64> {
    let whole = passages * 1e6 * rating_load.powi(3);
    sums.iter().map(|sum| sum / whole).collect()
}

/// Damage of a ring from that of its points: [mean_φ d^(10/9)]^(9/10).
///
/// Source: as [`ring_damage`].
/// Valid: points at equal distances.
pub fn mean_damage(points: &[f64]) -> f64 {
    let powers = points.iter().map(|damage| damage.powf(WEIBULL_SLOPE));
    (powers.sum::<f64>() / points.len() as f64).powf(1.0 / WEIBULL_SLOPE)
}

/// Adds what points of a ring have borne, `count` times, to what other points of it have: the nearest before counts.
///
/// Source: definition.
/// Valid: points at equal distances, from one angle on.
pub fn add_points(sum: &mut [f64], points: &[f64], count: f64) {
    let places = sum.len();
    for (place, sum) in sum.iter_mut().enumerate() {
        let point = points.get(place * points.len() / places);
        *sum += count * point.copied().unwrap_or(0.0);
    }
}

/// Damage of the bearing from that of its rings: (D_i^(10/9) + D_o^(10/9))^(9/10).
///
/// Source: product of survivals.
/// Valid: both rings of one bearing, slope 10/9.
pub fn bearing_damage(inner: f64, outer: f64) -> f64 {
    (inner.powf(WEIBULL_SLOPE) + outer.powf(WEIBULL_SLOPE)).powf(1.0 / WEIBULL_SLOPE)
}

/// Damage of the points of a ring that carries rows of balls side by side, from that of each row: (Σ d^(10/9))^(9/10).
///
/// Source: product of survivals.
/// Valid: rows with as many points, slope 10/9.
pub fn of_rows(rows: &[Vec<f64>]) -> Vec<f64> {
    let one = |point: usize| {
        let powers = rows.iter().map(|row| row[point].powf(WEIBULL_SLOPE));
        powers.sum::<f64>().powf(1.0 / WEIBULL_SLOPE)
    };
    match rows {
        [only] => only.clone(),
        _ => (0..rows.first().map_or(0, Vec::len)).map(one).collect(),
    }
}

/// Load under which a bearing uses this share of its life in so many turns, N: C (1e6 D/turns)^(1/3).
///
/// Source: ISO 281, L10 = (C/P)³ of a million turns; derived.
/// Valid: P ≤ 0.5 C.
pub fn load_of_damage(rating: f64, damage: f64, turns: f64) -> f64 {
    rating * (1e6 * damage / turns).cbrt()
}

/// Repetitions of a damage that the share `survival` of bearings outlives: [ln(1/S)/ln(1/0.9)]^(9/10)/D.
///
/// Source: Weibull, slope 10/9.
/// Valid: 0 < S < 1.
pub fn repetitions(damage: f64, survival: f64) -> f64 {
    weibull(survival, WEIBULL_SLOPE) / damage
}

/// Share of bearings that outlive a damage, in shares of L10: 0.9^(D^(10/9)).
///
/// Source: as [`repetitions`].
/// Valid: D of 0 and more.
pub fn survival(damage: f64) -> f64 {
    0.9f64.powf(damage.powf(WEIBULL_SLOPE))
}

fn weibull(survival: f64, slope: f64) -> f64 {
    (survival.ln() / 0.9f64.ln()).powf(1.0 / slope)
}

/// Reliability factor of catalogues, a1 = [ln(1/S)/ln(1/0.9)]^(1/1.5).
///
/// Source: Weibull, slope 1.5.
/// Valid: S ≥ 0.9.
pub fn reliability_factor(survival: f64) -> f64 {
    weibull(survival, 1.5)
}

/// Reliability factor of ISO 281:2007: 0.95 times [`reliability_factor`] + 0.05.
///
/// Source: ISO 281:2007.
/// Valid: S ≥ 0.9.
pub fn reliability_factor_iso(survival: f64) -> f64 {
    0.95 * reliability_factor(survival) + 0.05
}

/// Life factor a_ISO of radial ball bearings: 0.1[1 − (2.5671 − c/κ^x)^0.83 (e_C C_u/P)^⅓]^−9.3, 0.1 to 50.
///
/// Arguments: viscosity ratio κ, e_C C_u/P. κ above 4 counts as 4, and below 0.1 gives 0.1.
///
/// Source: ISO 281:2007 (from memory: check before quoting).
/// Valid: κ ≥ 0.1; below, no factor holds.
pub fn iso_life_factor(kappa: f64, load_ratio: f64) -> f64 {
    if kappa < 0.1 {
        return 0.1;
    }
    let kappa = kappa.min(4.0);
    let (factor, exponent) = if kappa < 0.4 {
        (2.2649, 0.054381)
    } else if kappa < 1.0 {
        (1.9987, 0.19087)
    } else {
        (1.9987, 0.071739)
    };
    let bracket = 1.0 - (2.5671 - factor / kappa.powf(exponent)).powf(0.83) * load_ratio.cbrt();
    if bracket <= 0.0 {
        return 50.0;
    }
    (0.1 * bracket.powf(-9.3)).clamp(0.1, 50.0)
}

/// Viscosity that a bearing asks for, ν₁, mm²/s: 45000 n^−0.83 d_m^−½ below 1000/min, 4500 n^−½ d_m^−½ above.
///
/// Arguments: speed 1/min, pitch diameter mm.
///
/// Source: ISO 281:2007 (from memory: check before quoting).
/// Valid: n > 0; steps by 2 % at 1000/min.
pub fn reference_viscosity(speed_rpm: f64, pitch_diameter_mm: f64) -> f64 {
    let speed = if speed_rpm < 1000.0 {
        45000.0 * speed_rpm.powf(-0.83)
    } else {
        4500.0 * speed_rpm.powf(-0.5)
    };
    speed / pitch_diameter_mm.sqrt()
}

/// Basic life (C/P)^p, million turns.
///
/// Arguments: dynamic rating C and equivalent load P, N; exponent p, 3 for balls and 10/3 for rollers.
///
/// Source: ISO 281 (from memory: check before quoting).
/// Valid: P ≤ 0.5 C.
pub fn basic_life(rating: f64, load: f64, exponent: f64) -> f64 {
    (rating / load).powf(exponent)
}

/// Hours of a life in million turns at a speed in 1/min.
///
/// Source: definition of the units.
/// Valid: constant speed above 0.
pub fn life_hours(millions: f64, speed_rpm: f64) -> f64 {
    1e6 * millions / (60.0 * speed_rpm)
}

/// Load that uses as much life as given ones do: (Σ n P^p/Σ n)^(1/p), N.
///
/// Arguments: loads, N; turns under each, in any one unit; exponent p.
///
/// Source: derived; damage adds up.
/// Valid: as [`basic_life`]; lists of one length, at least one turn.
pub fn mean_load(loads: &[f64], turns: &[f64], exponent: f64) -> f64 {
    let used: f64 = loads
        .iter()
        .zip(turns)
        .map(|(load, turns)| turns * load.powf(exponent))
        .sum();
    (used / turns.iter().sum::<f64>()).powf(1.0 / exponent)
}

/// Life under conditions that alternate: Σ shares/Σ (share/life), in the unit of the lives.
///
/// Arguments: life under each condition alone; its share of time.
///
/// Source: derived; damage adds up.
/// Valid: lists of one length, lives above 0.
pub fn interval_life(lives: &[f64], shares: &[f64]) -> f64 {
    let used: f64 = lives
        .iter()
        .zip(shares)
        .map(|(life, share)| share / life)
        .sum();
    shares.iter().sum::<f64>() / used
}

/// Factor on the dynamic rating of a warm ring, linear between 1.0 to 150 °C, 0.95 at 175, 0.90 at 200, 0.75 at 250.
///
/// Argument: °C.
///
/// Source: NSK Rolling Bearings, table 5.3.
/// Valid: to 250 °C, held beyond.
pub fn temperature_factor(celsius: f64) -> f64 {
    let table = [(150.0, 1.0), (175.0, 0.95), (200.0, 0.90), (250.0, 0.75)];
    if celsius <= 150.0 {
        return 1.0;
    }
    for pair in table.windows(2) {
        let ((low, before), (high, after)) = (pair[0], pair[1]);
        if celsius <= high {
            let share = (celsius - low) / (high - low);
            return before * (1.0 - share) + after * share;
        }
    }
    0.75
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_drops_use_n_times_the_life() {
        let once: Vec<f64> = (0..36).map(|i| 1e9 * f64::from(i)).collect();
        let many: Vec<f64> = once.iter().map(|sum| 7.0 * sum).collect();
        let (one, seven) = (ring_damage(&once, 4.0, 3e3), ring_damage(&many, 4.0, 3e3));
        assert!((seven / (7.0 * one) - 1.0).abs() < 1e-14);
        let joined = bearing_damage(7.0 * one, 7.0 * 2.0 * one);
        assert!((joined / (7.0 * bearing_damage(one, 2.0 * one)) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn constant_motion_gives_the_life_of_the_standard() {
        // one ring under Q at each passage: L10 = (Qc/Q)³ million turns
        let (passages, load, rating, turns) = (5.9, 300.0, 3000.0, 2.5e6);
        let damage = ring_damage(&[turns * passages * 300.0f64.powi(3)], passages, rating);
        assert!((damage / (turns / 1e6 * f64::powi(load / rating, 3)) - 1.0).abs() < 1e-13);
        assert!((repetitions(damage, 0.9) * damage - 1.0).abs() < 1e-14);
        assert!((repetitions(1.0, 0.5) - 5.45).abs() < 0.01);
    }
}
