//! Force of a radial magnet: linear, or an opposed pair with bias, gap and limited currents; its amplifier, and when commands act.
//!
//! ```text
//!     ┌───┐ b₋ - i                 f > 0 pulls towards +x, where the gap g₀ - x closes
//!     │   │──gap g₀ + x──┐
//!     └───┘            ( rotor )──gap g₀ - x──┌───┐       the nearer magnet pulls harder: without control
//!                                             │   │       current f has the sign of x and pushes the rotor
//!                                     b₊ + i  └───┘       away from the centre, k_s > 0
//! ```
//! Power to the rotor is f·v, v the velocity of its axis against the magnet; a magnet is a source of either sign.
//! Without current changes the force has the potential -½k_s x² (linear), -k[(b₊+i)²/(g₀-x) + (b₋-i)²/(g₀+x)] (pair).
//! Both coils have the bias i₀, or b₊ and b₋ with the mean i₀: the larger one carries a constant load k_i (b₊-b₋)/2 without control current.

use number::{Gather, Real, constants};

/// The force law of one axis of a magnet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Magnet<R> {
    /// f = k_i i + k_s x.
    Linear {
        /// Force over current k_i, N/A.
        current_stiffness: R,
        /// Force over displacement k_s, N/m; positive pushes away.
        position_stiffness: R,
    },
    /// Two magnets that pull against each other.
    Pair(OpposedPair<R>),
}

constants! {
    /// Two magnets that pull against each other about a bias current.
    pub struct OpposedPair {
        /// Force constant k of one magnet, N m²/A².
        force_constant: R,
        /// Bias current b₊ of the coil that pulls towards +x, A.
        bias_plus: R,
        /// Bias current b₋ of the other, A.
        bias_minus: R,
        /// Gap g₀ of both with the rotor in the centre, m.
        gap: R,
        /// Largest current of a coil, A.
        largest_current: R,
    }
}

impl<R: Real> Gather<R> for Magnet<f64> {
    type Out = Magnet<R>;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> Magnet<R>
    where
        Self: 'a,
    {
        let linear = |lane: usize| match *machine(lane) {
            Magnet::Linear {
                current_stiffness,
                position_stiffness,
            } => [current_stiffness, position_stiffness],
            Magnet::Pair(_) => panic!("lanes share the kind of their magnets"),
        };
        match machine(0) {
            Magnet::Linear { .. } => Magnet::Linear {
                current_stiffness: R::from_lanes(|lane| linear(lane)[0]),
                position_stiffness: R::from_lanes(|lane| linear(lane)[1]),
            },
            Magnet::Pair(_) => Magnet::Pair(Gather::<R>::gather(&|lane| match machine(lane) {
                Magnet::Pair(pair) => pair,
                Magnet::Linear { .. } => panic!("lanes share the kind of their magnets"),
            })),
        }
    }
}

impl<R: Real> OpposedPair<R> {
    /// The pair that has given stiffnesses about its centre: i₀ = g₀k_s/k_i, k = k_i g₀²/(4i₀).
    ///
    /// - `current_stiffness` k_i, N/A; `position_stiffness` k_s, N/m; `gap` g₀, m; `largest_current`, A
    ///
    /// Source: the two stiffnesses of the pair, solved for bias and constant.
    /// Valid: k_i, k_s and g₀ above zero.
    pub fn of_stiffness(
        current_stiffness: R,
        position_stiffness: R,
        gap: R,
        largest_current: R,
    ) -> Self {
        let bias_current = gap * position_stiffness / current_stiffness;
        Self {
            force_constant: current_stiffness * gap.square() / (R::splat(4.0) * bias_current),
            bias_plus: bias_current,
            bias_minus: bias_current,
            gap,
            largest_current,
        }
    }

    /// The same pair with biases that differ by b₊ - b₋, A, about their mean.
    ///
    /// Source: as given.
    /// Valid: below twice the mean: neither coil pushes.
    pub fn with_bias_difference(self, difference: R) -> Self {
        let (mean, half) = (self.bias_current(), R::splat(0.5) * difference);
        Self {
            bias_plus: mean + half,
            bias_minus: mean - half,
            ..self
        }
    }

    /// Mean bias i₀ of both coils, A.
    ///
    /// Source: as given.
    /// Valid: always.
    pub fn bias_current(&self) -> R {
        R::splat(0.5) * (self.bias_plus + self.bias_minus)
    }

    /// Currents of both coils, A: between nothing and the largest; `bias_share` of the bias is there.
    #[inline(always)]
    fn coils(&self, current: R, bias_share: R) -> (R, R) {
        let clip = |coil: R| coil.max(R::zero()).min(self.largest_current);
        (
            clip(self.bias_plus * bias_share + current),
            clip(self.bias_minus * bias_share - current),
        )
    }
}

impl<R: Real> Magnet<R> {
    /// Force over current at the centre, N/A.
    ///
    /// Formula: k_i, or 4k i₀/g₀²
    ///
    /// Source: derivative of the law at i = 0, x = 0.
    /// Valid: bias below the largest current.
    pub fn current_stiffness(&self) -> R {
        match *self {
            Self::Linear {
                current_stiffness, ..
            } => current_stiffness,
            Self::Pair(pair) => {
                R::splat(4.0) * pair.force_constant * pair.bias_current() / pair.gap.square()
            }
        }
    }

    /// Force over displacement at the centre, N/m; positive pushes away.
    ///
    /// Formula: k_s, or 2k(b₊² + b₋²)/g₀³; of equal biases 4k i₀²/g₀³, so that k_s/k_i = i₀/g₀
    ///
    /// Source: derivative of the law at i = 0, x = 0.
    /// Valid: bias below the largest current.
    pub fn position_stiffness(&self) -> R {
        match *self {
            Self::Linear {
                position_stiffness, ..
            } => position_stiffness,
            Self::Pair(pair) => {
                let mean = pair.bias_current();
                let half = R::splat(0.5) * (pair.bias_plus - pair.bias_minus);
                self.current_stiffness() * (mean + half * half / mean) / pair.gap
            }
        }
    }

    /// Gap g₀ to each pole with the rotor in the centre, m; infinite of a linear magnet, which has none.
    ///
    /// Source: as given.
    /// Valid: always.
    pub fn gap(&self) -> R {
        match self {
            Self::Linear { .. } => R::splat(f64::INFINITY),
            Self::Pair(pair) => pair.gap,
        }
    }

    /// Bias currents of both coils, A: nothing of a linear magnet.
    ///
    /// Source: as given.
    /// Valid: always.
    #[inline(always)]
    pub fn biases(&self) -> [R; 2] {
        match self {
            Self::Linear { .. } => [R::zero(); 2],
            Self::Pair(pair) => [pair.bias_plus, pair.bias_minus],
        }
    }

    /// Currents of both coils under one control current, A.
    ///
    /// Formula: ±i, or e b₊ + i and e b₋ - i within [0, i_max]
    ///
    /// - `current` i, A; `bias_share` e of the bias that is there
    ///
    /// Source: two coils in one circuit.
    /// Valid: coils that have no current of their own.
    #[inline(always)]
    pub fn coils(&self, current: R, bias_share: R) -> [R; 2] {
        match self {
            Self::Linear { .. } => [current, -current],
            Self::Pair(pair) => pair.coils(current, bias_share).into(),
        }
    }

    /// Force on the rotor along the axis under one control current, N.
    ///
    /// Formula: k_i e i + k_s e² x, or k[(e b₊ + i)²/(g₀ - x)² - (e b₋ - i)²/(g₀ + x)²], coil currents within [0, i_max]
    ///
    /// - `current` i, A; `displacement` x of the rotor's axis from the magnet's, m
    /// - `bias_share` e of the bias that is there: 1 while on, decaying to 0 after a loss of power
    ///
    /// Source: reluctance force of two magnets (G. Schweitzer, E. Maslen, Magnetic Bearings, 2009, from memory).
    /// Valid: |x| < g₀; no saturation of iron, no eddy currents, no hysteresis.
    #[inline(always)]
    pub fn force(&self, current: R, displacement: R, bias_share: R) -> R {
        self.force_of_coils(self.coils(current, bias_share), displacement, bias_share)
    }

    /// Force on the rotor along the axis, N.
    ///
    /// Formula: ½k_i e (i₊ - i₋) + k_s e² x, or k[i₊²/(g₀ - x)² - i₋²/(g₀ + x)²]
    ///
    /// - `coils` i₊, i₋ of the coil that pulls towards + and of the other, A, what is left of their biases in them
    /// - `displacement` x of the rotor's axis from the magnet's, m; `bias_share` e of the bias that is there
    ///
    /// Source: reluctance force of two magnets (G. Schweitzer, E. Maslen, Magnetic Bearings, 2009, from memory).
    /// Valid: |x| < g₀; no saturation of iron, no eddy currents, no hysteresis.
    #[inline(always)]
    pub fn force_of_coils(&self, [near, far]: [R; 2], displacement: R, bias_share: R) -> R {
        match *self {
            Self::Linear {
                current_stiffness,
                position_stiffness,
            } => {
                let current = R::splat(0.5) * (near - far);
                bias_share
                    * (current_stiffness * current + position_stiffness * bias_share * displacement)
            }
            Self::Pair(pair) => {
                let (near_gap, far_gap) = (pair.gap - displacement, pair.gap + displacement);
                pair.force_constant * ((near / near_gap).square() - (far / far_gap).square())
            }
        }
    }

    /// Slopes of the force with full bias: over current, N/A, and over displacement, N/m.
    ///
    /// Formula: derivatives of [`Magnet::force`]; a coil at a limit adds nothing to the first
    ///
    /// - `current` i, A; `displacement` x, m
    ///
    /// Source: derivative of the law.
    /// Valid: as the force.
    pub fn slopes(&self, current: R, displacement: R) -> (R, R) {
        let Self::Pair(pair) = *self else {
            return (self.current_stiffness(), self.position_stiffness());
        };
        let free = |coil: R| {
            let inside = coil.greater(R::zero()) & coil.less(pair.largest_current);
            R::select(inside, coil, R::zero())
        };
        let (near, far) = pair.coils(current, R::one());
        let (near_gap, far_gap) = (pair.gap - displacement, pair.gap + displacement);
        let twice = R::splat(2.0) * pair.force_constant;
        (
            twice * (free(near) / near_gap.square() + free(far) / far_gap.square()),
            twice * ((near / near_gap).square() / near_gap + (far / far_gap).square() / far_gap),
        )
    }
}

/// How a command becomes a current.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amplifier {
    /// The current is the command.
    Direct,
    /// i̇ = ω(command - i) of each coil, |i̇| ≤ s.
    Current {
        /// Bandwidth ω, rad/s.
        bandwidth: f64,
        /// Largest rate s, A/s; infinite without limit.
        slew: f64,
    },
    /// L di/dt = u - R i - k_i ẋ, |u| ≤ U.
    Voltage {
        /// Inductance L, H.
        inductance: f64,
        /// Resistance R, Ω.
        resistance: f64,
        /// u = gain (command - i), V/A; without it the command is u itself.
        gain: Option<f64>,
        /// Largest voltage U, V.
        largest_voltage: f64,
    },
}

/// When a command takes effect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Timing {
    /// The controller runs at every instant; its commands come `delay` later (Padé 2/2).
    Continuous {
        /// Delay T, s; 0 for none.
        delay: f64,
    },
    /// The controller runs at k T_s; its commands are held from k T_s + T_c on.
    Sampled {
        /// Period T_s, s.
        period: f64,
        /// Time to compute T_c, s.
        computation: f64,
    },
    /// No controller: whoever drives the machine changes its commands, which are held between.
    Held,
}

impl Timing {
    /// The delay that linear analysis sees, s: T, or T_c + T_s/2.
    ///
    /// Source: a hold of one period delays by half of it.
    /// Valid: frequencies below half the sampling rate.
    pub fn delay(self) -> f64 {
        match self {
            Self::Continuous { delay } => delay,
            Self::Sampled {
                period,
                computation,
            } => computation + 0.5 * period,
            Self::Held => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use number::Dual;

    const PAIR: OpposedPair<f64> = OpposedPair {
        force_constant: 1.2e-5,
        bias_plus: 2.0,
        bias_minus: 2.0,
        gap: 0.4e-3,
        largest_current: 4.0,
    };

    fn same(a: f64, b: f64, share: f64) -> bool {
        (a - b).abs() <= share * b.abs()
    }

    #[test]
    fn stiffnesses_are_the_slopes_at_the_centre_and_their_ratio_is_bias_over_gap() {
        let magnet = Magnet::Pair(PAIR);
        let (over_current, over_displacement) = magnet.slopes(0.0, 0.0);
        assert!(same(over_current, 4.0 * 1.2e-5 * 2.0 / 0.16e-6, 1e-14));
        assert!(same(over_current, magnet.current_stiffness(), 1e-14));
        assert!(same(over_displacement, magnet.position_stiffness(), 1e-14));
        assert!(same(over_displacement / over_current, 2.0 / 0.4e-3, 1e-14));
        let again = OpposedPair::of_stiffness(over_current, over_displacement, 0.4e-3, 4.0);
        assert!(same(again.force_constant, PAIR.force_constant, 1e-14));
        assert!(same(again.bias_current(), PAIR.bias_current(), 1e-14));
    }

    #[test]
    fn slopes_equal_forward_derivatives_also_where_a_coil_is_at_a_limit() {
        let lift = |value: f64| Dual::<2>::splat(value);
        let magnet = Magnet::Pair(OpposedPair {
            force_constant: lift(PAIR.force_constant),
            bias_plus: lift(PAIR.bias_plus),
            bias_minus: lift(PAIR.bias_minus),
            gap: lift(PAIR.gap),
            largest_current: lift(PAIR.largest_current),
        });
        for (current, displacement) in [(0.3, 5e-5), (-1.1, 2e-4), (2.5, -1e-4), (-2.2, 0.0)] {
            let force = magnet.force(
                Dual::variable(current, 0),
                Dual::variable(displacement, 1),
                lift(1.0),
            );
            let (over_current, over_displacement) =
                Magnet::Pair(PAIR).slopes(current, displacement);
            assert!(same(over_current, force.partial[0], 1e-13), "{current}");
            assert!(
                same(over_displacement, force.partial[1], 1e-13),
                "{current}"
            );
        }
    }

    /// By hand, k 1.2e-5, biases 2.5 and 1.5 A, gap 0.4 mm: F = k(6.25 - 2.25)/g₀² = 300 N = k_i·½ A, k_i = 2k·4/g₀² = 600 N/A,
    /// k_s = 2k·8.5/g₀³ = 3.1875e6 N/m. It is the equal pair with ½ A more control current, in every state within its limits.
    #[test]
    fn unequal_biases_carry_a_load_and_have_slopes_of_their_own() {
        let unequal = Magnet::Pair(PAIR.with_bias_difference(1.0));
        assert!(same(unequal.force(0.0, 0.0, 1.0), 300.0, 1e-14));
        let (over_current, over_displacement) = unequal.slopes(0.0, 0.0);
        assert!(same(over_current, 600.0, 1e-14) && same(over_displacement, 3.1875e6, 1e-14));
        assert!(same(unequal.current_stiffness(), 600.0, 1e-14));
        assert!(same(unequal.position_stiffness(), 3.1875e6, 1e-14));
        let (i, x) = (0.3, 5e-5);
        for share in [1.0, 0.4] {
            let equal = Magnet::Pair(PAIR).force((i + 0.5) * share, x, share);
            assert!(same(unequal.force(i * share, x, share), equal, 1e-14));
        }
        let mirrored = Magnet::Pair(PAIR.with_bias_difference(-1.0));
        assert!(same(
            mirrored.force(-i, -x, 1.0),
            -unequal.force(i, x, 1.0),
            1e-15
        ));
    }

    #[test]
    fn both_laws_push_away_and_the_pair_is_odd_and_linear_near_its_centre() {
        let pair = Magnet::Pair(PAIR);
        let linear = Magnet::Linear {
            current_stiffness: pair.current_stiffness(),
            position_stiffness: pair.position_stiffness(),
        };
        for magnet in [pair, linear] {
            assert!(magnet.force(0.0, 1e-5, 1.0) > 0.0 && magnet.force(0.0, -1e-5, 1.0) < 0.0);
            assert!(magnet.force(0.1, 0.0, 1.0) > 0.0);
        }
        let (i, x) = (1.1, 1.3e-4);
        assert!(same(pair.force(-i, -x, 1.0), -pair.force(i, x, 1.0), 1e-15));
        let (i, x) = (1e-4, 1e-8);
        // relative terms of third order: (x/g₀)² of 1e-9
        assert!(same(pair.force(i, x, 1.0), linear.force(i, x, 1.0), 1e-8));
    }

    #[test]
    fn a_constant_current_does_no_work_around_a_closed_path() {
        // f·v integrated over x = 2e-4 sin s is zero: what the magnet gives outwards it takes back
        let magnet = Magnet::Pair(PAIR);
        let steps = 4000;
        let mut work = 0.0;
        let mut outward = 0.0;
        for step in 0..steps {
            let s = std::f64::consts::TAU * (f64::from(step) + 0.5) / f64::from(steps);
            let power = magnet.force(0.4, 2e-4 * s.sin(), 1.0) * 2e-4 * s.cos();
            work += power;
            outward += power.abs();
        }
        assert!(work.abs() < 1e-12 * outward);
    }

    #[test]
    fn without_bias_nothing_of_the_displacement_stays() {
        let linear = Magnet::Linear {
            current_stiffness: 40.0,
            position_stiffness: 1.6e5,
        };
        assert_eq!(linear.force(0.0, 1e-4, 0.0), 0.0);
        assert_eq!(Magnet::Pair(PAIR).force(0.0, 1e-4, 0.0), 0.0);
        assert!(same(linear.force(1.0, 1e-4, 0.5), 20.0 + 4.0, 1e-15));
    }

    #[test]
    fn the_force_ends_at_the_largest_current() {
        let magnet = Magnet::Pair(PAIR);
        let most = PAIR.force_constant * (4.0 / PAIR.gap).powi(2);
        assert!(same(magnet.force(2.0, 0.0, 1.0), most, 1e-14));
        assert!(same(magnet.force(50.0, 0.0, 1.0), most, 1e-14));
    }
}
