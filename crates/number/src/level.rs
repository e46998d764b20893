//! The vector unit, chosen at run time.

use crate::Real;
#[cfg(target_arch = "x86_64")]
use crate::pair::Pair;
#[cfg(target_arch = "x86_64")]
use crate::single::Single;
#[cfg(target_arch = "x86_64")]
use crate::x86::{Eight, Four};

/// How wide this machine computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// What the compiler's target guarantees: one number at a time.
    Baseline,
    /// AVX2: four numbers at a time.
    Avx2,
    /// AVX-512 F, DQ, VL: eight numbers at a time.
    Avx512,
}

/// Work over a number whose shape the machine decides.
pub trait Task {
    /// What the work returns.
    type Output;
    /// Does the work with the number type of the machine.
    fn run<R: Real>(self) -> Self::Output;
}

impl Level {
    /// The widest level of this machine.
    pub fn detect() -> Level {
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx2")
            {
                return Level::Avx512;
            }
            if is_x86_feature_detected!("avx2") {
                return Level::Avx2;
            }
        }
        Level::Baseline
    }

    /// Every level this machine has, narrowest first.
    pub fn available() -> impl Iterator<Item = Level> {
        [Level::Baseline, Level::Avx2, Level::Avx512]
            .into_iter()
            .filter(|level| *level <= Level::detect())
    }

    /// Machines that [`run_many`](Level::run_many) puts side by side.
    pub fn lanes(self) -> usize {
        match self {
            Level::Avx512 => 8,
            Level::Avx2 => 4,
            Level::Baseline => 1,
        }
    }

    /// Runs a task for one machine. Its equal parts are computed several at a time where the level can.
    ///
    /// # Panics
    /// When this machine does not have the level: a `Level` other than from [`Level::detect`] was asked for.
    pub fn run_one<T: Task>(self, task: T) -> T::Output {
        self.assert_available();
        match self {
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => task.run::<Single<Four>>(),
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => task.run::<Single<Pair<Eight>>>(),
            _ => task.run::<f64>(),
        }
    }

    /// Runs a task for [`lanes`](Level::lanes) machines side by side.
    ///
    /// # Panics
    /// As [`run_one`](Level::run_one).
    pub fn run_many<T: Task>(self, task: T) -> T::Output {
        self.assert_available();
        match self {
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => task.run::<Four>(),
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => task.run::<Eight>(),
            _ => task.run::<f64>(),
        }
    }

    fn assert_available(self) {
        assert!(self <= Level::detect(), "this machine has no {self:?}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mask;

    /// Every operation on each lane; returns the bits of all lanes.
    struct Everything;
    impl Task for Everything {
        type Output = Vec<[u64; 20]>;
        fn run<R: Real>(self) -> Self::Output {
            // the same number in every lane; then lane by lane other numbers
            let mut lanes = Vec::new();
            for shift in 0..8 {
                let x = R::from_lanes(|i| 0.37 * ((i + shift) % 8) as f64 - 1.2);
                let y = R::from_lanes(|i| 1e-6 + ((i + shift) % 8) as f64 * 1.7);
                let values = everything(x, y);
                lanes.push(std::array::from_fn(|k| values[k].lane(0).to_bits()));
            }
            lanes
        }
    }

    fn everything<R: Real>(x: R, y: R) -> [R; 20] {
        let (s, c) = (x * R::splat(7.0)).sin_cos();
        let positive = x.greater(R::zero());
        let small = x.abs().less(R::splat(0.5));
        [
            x + y,
            x - y,
            x * y,
            x / y,
            -x,
            x.abs().sqrt(),
            x.exp(),
            y.ln(),
            x.tanh(),
            s,
            c,
            y.powf(R::splat(1.37)),
            R::select(positive, x.max(y), (x * R::splat(0.1)).asin_small()),
            R::select(positive & small, x, y),
            R::select(positive | !small, x, y).round(),
            x.sign_or_plus() * y.min(x),
            x.tanh_pair(y).0,
            x.tanh_pair(y).1,
            y.two_thirds(),
            (x * R::splat(40.0)).tanh_far_out(),
        ]
    }

    #[test]
    fn every_level_and_every_lane_gives_the_same_bits() {
        let reference = Level::Baseline.run_one(Everything);
        for level in Level::available() {
            assert_eq!(level.run_one(Everything), reference, "one, {level:?}");
            assert_eq!(level.run_many(Everything), reference, "many, {level:?}");
        }
    }

    struct Lanewise;
    impl Task for Lanewise {
        type Output = ();
        fn run<R: Real>(self) {
            let x = R::from_lanes(|i| i as f64 - 1.5);
            let mask = x.greater(R::zero());
            for i in 0..R::LANES {
                assert_eq!(x.lane(i), i as f64 - 1.5);
                assert_eq!(mask.lane(i), i as f64 > 1.5);
                assert_eq!((!mask).lane(i), i as f64 <= 1.5);
            }
            assert_eq!(mask.any(), R::LANES > 2);
            let odd = R::Mask::from_lanes(|i| i % 2 == 1);
            assert_eq!(odd.any(), R::LANES > 1);
            let picked = R::select(odd, R::one(), R::zero());
            assert!((0..R::LANES).all(|i| picked.lane(i) == (i % 2) as f64));
        }
    }
    #[test]
    fn lanes_and_masks_keep_their_places() {
        for level in Level::available() {
            level.run_many(Lanewise);
        }
    }

    struct Groups;
    impl Task for Groups {
        type Output = ();
        fn run<R: Real>(self) {
            let parts: Vec<R> = (0..5).map(|i| R::splat(f64::from(i))).collect();
            let mut copy = vec![R::zero(); 5];
            let mut from = 0;
            while from < 5 {
                let group = R::load_group(&parts, from);
                for part in 0..R::GROUP {
                    for machine in 0..R::LANES {
                        let value = group.lane(part * R::LANES + machine);
                        assert_eq!(value, (from + part).min(4) as f64);
                    }
                }
                R::store_group(group, &mut copy, from);
                from += R::GROUP;
            }
            for (a, b) in parts.iter().zip(&copy) {
                assert_eq!(a.lane(0), b.lane(0));
            }
            for count in 1..20 {
                assert_eq!(sum_of_parts::<R>(count), sum_of_parts::<f64>(count));
            }
        }
    }
    /// The sum of numbers whose sum depends on the order of addition.
    fn sum_of_parts<R: Real>(count: usize) -> u64 {
        let value = |i: usize| 0.1 * (i as f64 + 1.0).powi(5);
        let parts: Vec<R> = (0..count).map(|i| R::splat(value(i))).collect();
        let mut sums = [R::zero(); 4];
        for from in (0..count).step_by(R::GROUP) {
            R::add_group(R::load_group(&parts, from), &mut sums, from, count - from);
        }
        let total = (sums[0] + sums[1]) + (sums[2] + sums[3]);
        total.lane(R::LANES - 1).to_bits()
    }
    #[test]
    fn groups_hold_the_parts_and_repeat_the_last() {
        for level in Level::available() {
            level.run_one(Groups);
            level.run_many(Groups);
        }
    }
}
