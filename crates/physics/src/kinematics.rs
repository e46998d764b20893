//! Speeds of cage and balls that roll without slip, and the frequencies that follow.
//!
//! Absolute speeds are counted in one common direction (counter-clockwise positive), those of the ball about the
//! bearing axis alike; the ball's spin about its own axis is relative to the cage.

/// Geometry that fixes the speed ratios of a ball bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallSet {
    /// Number of balls Z.
    pub ball_count: usize,
    /// Ball diameter D, m.
    pub ball_diameter: f64,
    /// Pitch diameter d_m, m.
    pub pitch_diameter: f64,
    /// Contact angle α, rad.
    pub contact_angle: f64,
}

/// Characteristic frequencies, events per turn of the inner race with the outer race at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassingOrders {
    /// Ball passes of one point of the outer race (BPFO).
    pub outer_race: f64,
    /// Ball passes of one point of the inner race (BPFI).
    pub inner_race: f64,
    /// Turns of a ball about its own axis, relative to the cage (BSF).
    pub ball_spin: f64,
    /// Turns of the cage (FTF).
    pub cage: f64,
}

impl BallSet {
    /// γ = D cos α / d_m.
    fn gamma(&self) -> f64 {
        self.ball_diameter * self.contact_angle.cos() / self.pitch_diameter
    }

    /// Cage speed, rad/s.
    ///
    /// Formula: ω_c = ½[Ω_i (1 - γ) + Ω_o (1 + γ)], γ = D cos α/d_m
    ///
    /// - `inner_speed`, `outer_speed`: speeds of the races Ω_i, Ω_o, rad/s
    ///
    /// Source: T. A. Harris, Rolling Bearing Analysis, 4th ed. 2001, section 8 (from memory); equal to (8) of the
    /// source paper for α = 0, Ω_o = 0.
    /// Valid: rolling without slip at both races.
    pub fn cage_speed(&self, inner_speed: f64, outer_speed: f64) -> f64 {
        let gamma = self.gamma();
        0.5 * (inner_speed * (1.0 - gamma) + outer_speed * (1.0 + gamma))
    }

    /// Ball spin relative to the cage, rad/s; positive for Ω_i > Ω_o, when the ball turns against the inner race.
    ///
    /// Formula: ω = (d_m/(2D)) (1 - γ²) (Ω_i - Ω_o)
    ///
    /// - `inner_speed`, `outer_speed`: speeds of the races Ω_i, Ω_o, rad/s
    ///
    /// Source: T. A. Harris, Rolling Bearing Analysis, 4th ed. 2001, section 8 (from memory); equal to ω_b + ω_c of
    /// (8), (9) of the source paper for α = 0, Ω_o = 0.
    /// Valid: rolling without slip at both races, no spin about the contact normal.
    pub fn ball_spin(&self, inner_speed: f64, outer_speed: f64) -> f64 {
        let gamma = self.gamma();
        self.pitch_diameter / (2.0 * self.ball_diameter)
            * (1.0 - gamma * gamma)
            * (inner_speed - outer_speed)
    }

    /// Characteristic frequencies per turn of the inner race, outer race at rest.
    ///
    /// Formula: BPFO = Z/2 (1 - γ), BPFI = Z/2 (1 + γ), BSF = d_m/(2D) (1 - γ²), FTF = ½(1 - γ)
    ///
    /// Source: from [`BallSet::cage_speed`] and [`BallSet::ball_spin`] with Ω_i = 1, Ω_o = 0.
    /// Valid: rolling without slip; agrees with the CWRU bearings 6205 and 6203 to 2e-4.
    pub fn passing_orders(&self) -> PassingOrders {
        let cage = self.cage_speed(1.0, 0.0);
        let balls = self.ball_count as f64;
        PassingOrders {
            outer_race: balls * cage,
            inner_race: balls * (1.0 - cage),
            ball_spin: self.ball_spin(1.0, 0.0),
            cage,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INCH: f64 = 0.0254;

    fn bearing(ball_count: usize, ball_diameter: f64, pitch_diameter: f64) -> BallSet {
        BallSet {
            ball_count,
            ball_diameter,
            pitch_diameter,
            contact_angle: 0.0,
        }
    }

    #[test]
    fn the_bearings_of_the_cwru_test_stand() {
        // Case Western Reserve University, bearing data center: SKF 6205 (drive end) and 6203 (fan end, orders from
        // memory). Its fourth column counts two passes a turn. 4 to 5 digits from dimensions of 4 digits: 2e-4.
        // Public copies with 3.0489, 4.9511, 0.3811 at the fan end contradict the 0.2656 in balls on 1.122 in beside them.
        for (set, orders) in [
            (
                bearing(9, 0.3126 * INCH, 1.537 * INCH),
                [3.5848, 5.4152, 2.357, 0.3983],
            ),
            (
                bearing(8, 0.2656 * INCH, 1.122 * INCH),
                [3.0530, 4.9469, 0.5 * 3.9874, 0.3817],
            ),
        ] {
            let ours = set.passing_orders();
            let ours = [ours.outer_race, ours.inner_race, ours.ball_spin, ours.cage];
            for (ours, printed) in ours.into_iter().zip(orders) {
                assert!((ours / printed - 1.0).abs() < 2e-4, "{ours} {printed}");
            }
        }
    }
    #[test]
    fn races_that_turn_together_carry_everything_along() {
        let set = BallSet {
            contact_angle: 0.3,
            ..bearing(10, 6.35e-3, 36e-3)
        };
        assert!((set.cage_speed(70.0, 70.0) - 70.0).abs() < 1e-12);
        assert_eq!(set.ball_spin(70.0, 70.0), 0.0);
        assert_eq!(set.cage_speed(-70.0, 20.0), -set.cage_speed(70.0, -20.0));
        assert_eq!(set.ball_spin(-70.0, 20.0), -set.ball_spin(70.0, -20.0));
    }
    #[test]
    fn the_contacts_do_not_slip() {
        // Surface speeds at inner and outer contact, from rigid-body motion of the ball.
        let set = bearing(10, 6.35e-3, 36e-3);
        let (inner, outer) = (300.0, -40.0);
        let (cage, spin) = (set.cage_speed(inner, outer), set.ball_spin(inner, outer));
        let (r, pitch) = (set.ball_diameter / 2.0, set.pitch_diameter / 2.0);
        let absolute = cage - spin;
        let inner_slip = inner * (pitch - r) - (cage * pitch - absolute * r);
        let outer_slip = outer * (pitch + r) - (cage * pitch + absolute * r);
        // rounding of speeds near 5 m/s
        assert!(inner_slip.abs() < 1e-14 * 300.0 && outer_slip.abs() < 1e-14 * 300.0);
    }
    #[test]
    fn every_ball_passes_both_races_once_per_relative_turn() {
        let orders = bearing(9, 7.94e-3, 39e-3).passing_orders();
        assert!((orders.inner_race + orders.outer_race - 9.0).abs() < 1e-14);
        assert!(orders.inner_race > orders.outer_race);
    }
    #[test]
    fn at_right_angles_the_cage_turns_at_half_speed() {
        let thrust = BallSet {
            contact_angle: std::f64::consts::FRAC_PI_2,
            ..bearing(10, 6.35e-3, 36e-3)
        };
        assert!((thrust.cage_speed(100.0, 0.0) - 50.0).abs() < 1e-12);
    }
}
