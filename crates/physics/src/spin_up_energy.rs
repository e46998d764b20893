//! What a bearing dissipates while it is spun up, read from the moment on its outer race.
//!
//! Races concentric and fixed, from rest to the speed Ω0. The work of the inner race is ∫t_I Ω dt; with
//! t_I = t_O + t_g + dL/dt, L the angular momentum of balls and cage and t_g what they lose to neither ring,
//!
//! ```text
//!   D = ∫t_I Ω dt - Δ(KE + U) = ∫(t_O + t_g) Ω dt + ∫Ω dL - Δ(KE + U)         exact, with any slip
//!
//!   rolling throughout   L = (J_I + J_O) Ω, KE = ½ J_I Ω²:  D = ∫t_O Ω dt + ½ J_O Ω0²
//!   as (21) is printed                                      D = (1+2s) ∫t_O Ω dt + ½ J_O Ω0²
//!
//!   path term   ∫Ω dL = ½ L0 Ω0 when the balls roll all the way, L0 Ω0 when they follow a race already at Ω0,
//!               L0 Ω0 + 0.2 s N m_b R² Ω0² when they first spin with the race, the cage at rest, and orbit last
//!   L0 = (J_I + J_O) Ω0 = R² Ω0 [N m_b (½ + 0.3 s) + ½ m_c (1+s)]
//! ```
//! In parts ∫Ω dL = L0 Ω0 - ∫L dΩ: what L is on the way decides. The spin of the balls counts negative in L, so balls that spin
//! before they orbit have L < 0 while Ω rises, and their path term is larger than L0 Ω0. With ω_c ≥ 0 and an inner race whose
//! surface is not overtaken, s ω_b + (1+s) ω_c ≤ Ω, L is least at ω_c = 0, ω_b = Ω/s. Where no ball spins more slowly than it
//! would roll on the outer race, s ω_b ≥ (1+s) ω_c besides, L is largest when both are equal and Ω is no more than they need: rolling.
//! Balls that the inner race drives obey that: its traction gives their surface 5/2 times the speed by spin that it gives by orbit.
//!
//! J_I and J_O are those of [`RollingSet`]. The factor 1+2s of the printed form counts the moment of the outer race
//! twice: t_O is a moment already. Without friction at all, rolling, it gives the negative loss -s J_O Ω0². The paper's
//! sentence that rolling need only be a final condition is false: the path term depends on how the balls were spun up.
//!
//! Without a measured cage speed the loss of a spin-up is known within [`SpinUpEnergy::loss_range`] only, and where the balls may
//! still slip at the end within [`SpinUpEnergy::loss_range_of_any_slip`].
//!
//! Assumed: races concentric and fixed, start from rest, balls at rolling speed at the end but for that last range. In a drop the races move:
//! the energy ledger of the run counts there.

use crate::rolling::RollingSet;

/// A spin-up from rest to a final speed at which the balls roll.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpinUpEnergy {
    /// Balls and cage.
    pub set: RollingSet<f64>,
    /// Final speed of the inner race Ω0, rad/s.
    pub final_speed: f64,
    /// ∫t_O Ω dt over the spin-up, J.
    pub outer_moment_work: f64,
}

/// Loss of any spin-up, J, whatever the balls did on the way.
///
/// Formula: D = ∫(t_O + t_g) Ω dt + ∫Ω dL - Δ(KE + U)
///
/// - `outer_moment_work`: ∫t_O Ω dt, J; t_O everything that the outer ring receives
/// - `ground_moment_work`: ∫t_g Ω dt, J; t_g what balls and cage lose to neither ring, 0 unless something drags
/// - `path_term`: ∫Ω dL, J; L the angular momentum of balls and cage about the centre
/// - `energy_change`: Δ(KE + U) of balls and cage and of the contacts, J
///
/// Source: balance of work and of angular momentum; the exact form of the source paper's (21).
/// Valid: concentric fixed races.
pub fn spin_up_loss(
    outer_moment_work: f64,
    ground_moment_work: f64,
    path_term: f64,
    energy_change: f64,
) -> f64 {
    outer_moment_work + ground_moment_work + path_term - energy_change
}

impl SpinUpEnergy {
    /// Inertia term of (21), J.
    ///
    /// Formula: ½ (1+2s)(3/20 N m_b + ¼ m_c) R² Ω0² = ½ J_O Ω0²
    ///
    /// Source: the source paper (21).
    /// Valid: rolling at the end.
    pub fn inertia_term(&self) -> f64 {
        0.5 * self.set.outer_inertia() * self.final_speed * self.final_speed
    }

    /// Loss as (21) is printed, J: for comparison; it can be negative.
    ///
    /// Formula: D = (1+2s) ∫t_O Ω dt + ½ (1+2s)(3/20 N m_b + ¼ m_c) R² Ω0²
    ///
    /// Source: the source paper (21), printed with a factor 1+2s too many.
    /// Valid: never exactly; wrong by 2s ∫t_O Ω dt even when the balls roll.
    pub fn printed_loss(&self) -> f64 {
        (1.0 + 2.0 * self.set.ball_ratio) * self.outer_moment_work + self.inertia_term()
    }

    /// Loss of balls that roll all the way, J: (21) put right.
    ///
    /// Formula: D = ∫t_O Ω dt + ½ (1+2s)(3/20 N m_b + ¼ m_c) R² Ω0²
    ///
    /// Source: the source paper (21), corrected; derived on this module's page.
    /// Valid: rolling throughout, nothing drags to the frame.
    pub fn rolling_loss(&self) -> f64 {
        self.outer_moment_work + self.inertia_term()
    }

    /// Angular momentum L0 of balls and cage that roll at the final speed, kg m²/s.
    ///
    /// Formula: L0 = R² Ω0 [N m_b (½ + 0.3 s) + ½ m_c (1+s)]
    ///
    /// Source: (8), (9) of the source paper in L = Σ m_b ρ² θ̇ + I_c ω_c + I_b Σσ.
    /// Valid: rolling at the end.
    pub fn final_angular_momentum(&self) -> f64 {
        let (s, r) = (self.set.ball_ratio, self.set.inner_track_radius);
        r * r
            * self.final_speed
            * (self.set.balls_mass * (0.5 + 0.3 * s) + 0.5 * self.set.cage_mass * (1.0 + s))
    }

    /// Path term ∫Ω dL of balls that follow a race already at its final speed, J; half of it when they roll all the way.
    ///
    /// Formula: L0 Ω0
    ///
    /// Source: ∫Ω dL with Ω = Ω0 throughout; L ∝ Ω for the half.
    /// Valid: rolling at the end.
    pub fn path_term_behind_the_race(&self) -> f64 {
        self.final_angular_momentum() * self.final_speed
    }

    /// Least and largest path term ∫Ω dL, J.
    ///
    /// Formula: ½ L0 Ω0 (rolling all the way) … L0 Ω0 + 0.2 s N m_b R² Ω0² = ½ (1+s)(N m_b + m_c) R² Ω0² (balls that spin with the
    /// race, the cage at rest, until it has its speed)
    ///
    /// Source: ∫Ω dL = L0 Ω0 - ∫L dΩ with the least and the largest L at each Ω; derived on this module's page.
    /// Valid: a speed that only rises, rolling at the end; on the way ω_c ≥ 0, an inner race that is not overtaken, and balls that spin
    /// no more slowly than they would roll on the outer race. Balls that the cage carries without spin fall short of the least by
    /// up to 0.1 s N m_b R² Ω0².
    pub fn path_term_bounds(&self) -> (f64, f64) {
        let (s, r) = (self.set.ball_ratio, self.set.inner_track_radius);
        let orbit = 0.5 * (1.0 + s) * (self.set.balls_mass + self.set.cage_mass);
        (
            0.5 * self.path_term_behind_the_race(),
            orbit * (r * self.final_speed).powi(2),
        )
    }

    /// Least and largest loss, J, when the cage speed was not measured.
    ///
    /// Formula: ∫t_O Ω dt + path term - ½ J_I Ω0², path term within [`SpinUpEnergy::path_term_bounds`]
    ///
    /// Source: [`spin_up_loss`] with rolling at start and end.
    /// Valid: as the bounds; the least is [`SpinUpEnergy::rolling_loss`].
    pub fn loss_range(&self) -> (f64, f64) {
        let kinetic = 0.5 * self.set.inner_inertia() * self.final_speed * self.final_speed;
        let (least, largest) = self.path_term_bounds();
        (
            spin_up_loss(self.outer_moment_work, 0.0, least, kinetic),
            spin_up_loss(self.outer_moment_work, 0.0, largest, kinetic),
        )
    }

    /// Least and largest loss, J, when the cage speed was not measured and the balls may slip at the end.
    ///
    /// Formula: ∫t_O Ω dt (balls that were not spun up) … the largest of [`SpinUpEnergy::loss_range`]
    ///
    /// Balls and cage that end at a part x of rolling have L = x L0 and KE = ½ x² J_I Ω0². Their path term is ½ x² L0 Ω0 where they
    /// rolled up to x Ω0 and kept that speed, x L0 Ω0 + 0.2 s N m_b R² Ω0² at most; so beyond ∫t_O Ω dt the loss is from
    /// ½ x² J_O Ω0² to x L0 Ω0 + 0.2 s N m_b R² Ω0² - ½ x² J_I Ω0², and both rise with x.
    ///
    /// Source: [`spin_up_loss`] with any slip at the end.
    /// Valid: as the bounds; spin and orbit that end at about the same part of rolling: balls that spin at a standing cage store up
    /// to 0.2 N m_b (1+s) R² Ω0², by which the loss would be less.
    pub fn loss_range_of_any_slip(&self) -> (f64, f64) {
        (self.outer_moment_work, self.loss_range().1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing_6005::rolling_set as set;
    use crate::rolling::Acceleration;

    const FINAL: f64 = 1000.0;
    const STEPS: u32 = 1000;

    /// Kinetic energy of balls and cage.
    fn kinetic(set: &RollingSet<f64>, cage: f64, spin: f64) -> f64 {
        let (s, r) = (set.ball_ratio, set.inner_track_radius);
        0.5 * (set.balls_mass + set.cage_mass) * (r * (1.0 + s) * cage).powi(2)
            + 0.2 * set.balls_mass * (s * r * spin).powi(2)
    }
    /// Their angular momentum; ball spin is against the race.
    fn momentum(set: &RollingSet<f64>, cage: f64, spin: f64) -> f64 {
        let (s, r) = (set.ball_ratio, set.inner_track_radius);
        (set.balls_mass + set.cage_mass) * (r * (1.0 + s)).powi(2) * cage
            - 0.4 * set.balls_mass * (s * r).powi(2) * spin
    }

    /// What is integrated over a spin-up.
    struct Account {
        energy: SpinUpEnergy,
        /// ∫Ω dL.
        path: f64,
        /// Work of the inner race.
        work: f64,
        /// Heat, of friction power.
        heat: f64,
    }
    impl Account {
        fn of(outer_moment_work: f64, path: f64, work: f64, heat: f64) -> Self {
            let energy = SpinUpEnergy {
                set: set(),
                final_speed: FINAL,
                outer_moment_work,
            };
            Account {
                energy,
                path,
                work,
                heat,
            }
        }
    }

    /// Balls that roll while the race gains `rate` against a constant moment.
    fn rolling(moment: f64, rate: f64) -> Account {
        let set = set();
        let motion = set.rolling(rate);
        let t_inner = set.inner_moment(moment, set.inner_traction(motion, 0.0));
        let t_outer = set.outer_moment(moment, set.outer_traction(motion, 0.0));
        let step = FINAL / rate / f64::from(STEPS);
        let (mut outer, mut path, mut work, mut heat) = (0.0, 0.0, 0.0, 0.0);
        for k in 0..STEPS {
            // the midpoint is exact for what is linear in time
            let speed = rate * step * (f64::from(k) + 0.5);
            outer += t_outer * speed * step;
            path += speed * momentum(&set, motion.cage * step, motion.ball_spin * step);
            work += t_inner * speed * step;
            heat += moment * speed * step;
        }
        Account::of(outer, path, work, heat)
    }

    /// A race at full speed from the start; balls roll at the outer race and skid at the inner one until they catch up.
    fn skidding(moment: f64) -> Account {
        let set = set();
        let (s, r) = (set.ball_ratio, set.inner_track_radius);
        let end = set.cage_speed(FINAL);
        let cage = 2000.0;
        let motion = Acceleration {
            cage,
            ball_spin: (1.0 + s) / s * cage,
        };
        let traction = set.inner_traction(motion, 0.0);
        let t_outer = set.outer_moment(moment, set.outer_traction(motion, 0.0));
        let step = end / cage / f64::from(STEPS);
        let (mut outer, mut path, mut work, mut heat) = (0.0, 0.0, 0.0, 0.0);
        for k in 0..STEPS {
            let orbit = cage * step * (f64::from(k) + 0.5);
            outer += t_outer * FINAL * step;
            path += FINAL * momentum(&set, cage * step, motion.ball_spin * step);
            work += set.inner_moment(moment, traction) * FINAL * step;
            // the ball's surface at the inner race runs with 2(1+s) R ω_c
            heat += (traction * r * (FINAL - 2.0 * (1.0 + s) * orbit) + moment * FINAL) * step;
        }
        Account::of(outer, path, work, heat)
    }
    fn kinetic_at_the_end() -> f64 {
        let set = set();
        kinetic(&set, set.cage_speed(FINAL), set.ball_spin(FINAL))
    }
    /// Rounding of 1000 sums.
    fn near(value: f64, reference: f64) -> bool {
        (value / reference - 1.0).abs() < 1e-12
    }

    #[test]
    fn rolling_against_a_constant_moment() {
        for (moment, rate) in [(0.025, 7200.0), (0.01, 50_000.0)] {
            let account = rolling(moment, rate);
            let energy = account.energy;
            // closed form: M Ω0²/(2 Ω̇)
            let loss = moment * FINAL * FINAL / (2.0 * rate);
            assert!(near(account.heat, loss));
            assert!(near(energy.rolling_loss(), loss));
            assert!(near(account.work - kinetic_at_the_end(), loss));
            let exact = spin_up_loss(
                energy.outer_moment_work,
                0.0,
                account.path,
                kinetic_at_the_end(),
            );
            assert!(near(exact, loss));
            assert!(near(energy.loss_range().0, loss));
            assert!(near(account.path, energy.path_term_bounds().0));
            // printed: (1+2s) D - s J_O Ω0²
            let (s, j) = (energy.set.ball_ratio, energy.set.outer_inertia());
            let printed = (1.0 + 2.0 * s) * loss - s * j * FINAL * FINAL;
            assert!(near(energy.printed_loss(), printed));
            assert!((printed / loss - 1.0).abs() > 0.2);
        }
    }
    #[test]
    fn the_printed_form_can_lose_less_than_nothing() {
        // Frictionless rolling: no loss. Printed: -s J_O Ω0².
        let account = rolling(0.0, 7200.0);
        let energy = account.energy;
        let (s, j) = (energy.set.ball_ratio, energy.set.outer_inertia());
        assert!(energy.rolling_loss().abs() < 1e-13 * energy.inertia_term());
        assert!(near(energy.printed_loss(), -s * j * FINAL * FINAL));
        assert!(energy.printed_loss() < 0.0);
        // and worse where the balls skid, although heat is made
        let account = skidding(0.0);
        assert!(account.heat > 0.0 && account.energy.printed_loss() < 0.0);
    }
    #[test]
    fn skidding_spin_up() {
        for moment in [0.0, 0.025] {
            let account = skidding(moment);
            let energy = account.energy;
            let exact = spin_up_loss(
                energy.outer_moment_work,
                0.0,
                account.path,
                kinetic_at_the_end(),
            );
            assert!(near(exact, account.heat));
            assert!(near(account.work - kinetic_at_the_end(), account.heat));
            // balls spun up after the race
            assert!(near(account.path, energy.path_term_behind_the_race()));
            let (least, largest) = energy.loss_range();
            assert!((least..largest).contains(&account.heat));
            // both short forms miss half of L0 Ω0
            let missed = account.heat - energy.rolling_loss();
            assert!(near(missed, energy.path_term_bounds().0));
        }
        // without a steady moment: skidding loses as much as it stores, ½ J_I Ω0²
        let lost = skidding(0.0).heat;
        assert!(near(lost, 0.5 * set().inner_inertia() * FINAL * FINAL));
    }
    #[test]
    fn every_path_of_a_race_that_leads_its_balls_lies_within_the_bounds() {
        // surface speeds of a ball over half of the final race's: x by its orbit, y by its spin; w the race's over its final one
        let energy = Account::of(0.0, 0.0, 0.0, 0.0).energy;
        let (least, largest) = energy.path_term_bounds();
        let path_of = |places: &[(f64, f64, f64)]| {
            let l = |x: f64, y: f64| {
                let (cage, spin) = (energy.set.cage_speed(FINAL), energy.set.ball_spin(FINAL));
                momentum(&energy.set, x * cage, y * spin)
            };
            let parts = places.windows(2).map(|part| {
                let ((x, y, w), (nx, ny, nw)) = (part[0], part[1]);
                0.5 * (w + nw) * FINAL * (l(nx, ny) - l(x, y))
            });
            parts.sum::<f64>()
        };
        // the bounds are reached: rolling, and balls that spin with the race and orbit last
        assert!(near(path_of(&[(0.0, 0.0, 0.0), (1.0, 1.0, 1.0)]), least));
        let spun = path_of(&[(0.0, 0.0, 0.0), (0.0, 2.0, 1.0), (1.0, 1.0, 1.0)]);
        assert!(near(spun, largest));
        let s = energy.set.ball_ratio;
        let beyond = spun / energy.path_term_behind_the_race() - 1.0;
        // 0.2 s/(0.5 + 0.3 s) of balls without a cage
        assert!(beyond > 0.05 && beyond < 0.2 * s / (0.5 + 0.3 * s));
        // steps of the race and of the balls in random order and size
        let mut random = 0x9e37_79b9_u32;
        let mut next = || {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(random >> 8) / f64::from(1 << 24)
        };
        let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
        for _ in 0..2000 {
            let lazy = next();
            let mut places = vec![(0.0, 0.0, 0.0)];
            let mut w: f64 = 0.0;
            while w < 1.0 {
                w = (w + 0.2 * next()).min(1.0);
                let (x, _, _) = places[places.len() - 1];
                // orbit and spin anywhere between rolling on the outer race and being dragged along by the inner one
                let orbit = x + (w - x) * next() * lazy;
                places.push((orbit, orbit + (2.0 * w - 2.0 * orbit) * next(), w));
            }
            places.push((1.0, 1.0, 1.0));
            let path = path_of(&places);
            assert!(
                (least..=largest).contains(&path),
                "{path} {least} {largest}"
            );
            (low, high) = (low.min(path), high.max(path));
        }
        assert!(low < 1.2 * least && high > 0.9 * largest);
    }
    #[test]
    fn angular_momentum_is_that_of_both_inertias() {
        let energy = rolling(0.0, 100.0).energy;
        let both = set().inner_inertia() + set().outer_inertia();
        assert!(near(energy.final_angular_momentum(), both * FINAL));
        let direct = momentum(&set(), set().cage_speed(FINAL), set().ball_spin(FINAL));
        assert!(near(energy.final_angular_momentum(), direct));
    }

    #[test]
    fn any_slip_at_the_end_lies_in_its_range() {
        let set = set();
        let energy = SpinUpEnergy {
            set,
            final_speed: FINAL,
            outer_moment_work: 3.0,
        };
        let (least, largest) = energy.loss_range_of_any_slip();
        for part in [0.0, 0.1, 0.3, 0.7, 1.0] {
            let (cage, spin) = (part * set.cage_speed(FINAL), part * set.ball_spin(FINAL));
            let (l, kinetic) = (momentum(&set, cage, spin), kinetic(&set, cage, spin));
            // rolled up to that part of the speed and kept there, or spun up after the race
            for path in [0.5 * part * FINAL * l, FINAL * l] {
                let loss = spin_up_loss(energy.outer_moment_work, 0.0, path, kinetic);
                assert!(
                    (least..=largest * (1.0 + 1e-12)).contains(&loss),
                    "{part} {loss}"
                );
                if part == 0.0 {
                    assert_eq!(loss, least);
                }
            }
        }
        // rolling all the way lies above the least by the inertia term
        assert!(energy.rolling_loss() - least - energy.inertia_term() < 1e-12 * largest);
    }
}
