//! The vector unit, chosen at run time.

/// How wide this machine computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// What the compiler's target guarantees (SSE2 on x86-64, NEON on AArch64).
    Baseline,
    /// AVX2: four lanes.
    Avx2,
    /// AVX-512 F, DQ, VL: eight lanes.
    Avx512,
}

/// Work that is compiled once per [`Level`].
///
/// `run` and everything it calls must be `#[inline(always)]`: only inlined code is compiled for the level.
pub trait Task {
    /// What the work returns.
    type Output;
    /// Does the work.
    fn run(self) -> Self::Output;
}

impl Level {
    /// The widest level of this machine.
    pub fn detect() -> Level {
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl")
            {
                return Level::Avx512;
            }
            if is_x86_feature_detected!("avx2") {
                return Level::Avx2;
            }
        }
        Level::Baseline
    }

    /// Lanes that are worth running side by side.
    pub fn lanes(self) -> usize {
        match self {
            Level::Avx512 => 8,
            Level::Baseline | Level::Avx2 => 4,
        }
    }

    /// Runs the task with this level's instructions.
    ///
    /// # Panics
    /// When this machine does not have the level: a `Level` other than from [`Level::detect`] was asked for.
    #[inline]
    pub fn run<T: Task>(self, task: T) -> T::Output {
        #[cfg(target_arch = "x86_64")]
        {
            assert!(self <= Level::detect(), "this machine has no {self:?}");
            match self {
                Level::Baseline => task.run(),
                // SAFETY: the assertion above holds, so the machine has the features.
                Level::Avx2 => unsafe { avx2(task) },
                // SAFETY: as above.
                Level::Avx512 => unsafe { avx512(task) },
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            assert!(self == Level::Baseline, "this machine has no {self:?}");
            task.run()
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2<T: Task>(task: T) -> T::Output {
    task.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,avx512f,avx512dq,avx512vl")]
fn avx512<T: Task>(task: T) -> T::Output {
    task.run()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Lanes, Real};

    struct Tanh(Lanes<8>);
    impl Task for Tanh {
        type Output = Lanes<8>;
        #[inline(always)]
        fn run(self) -> Lanes<8> {
            (self.0.tanh() * self.0.exp()).sqrt()
        }
    }

    #[test]
    fn every_level_gives_the_same_bits() {
        let x = Lanes([0.1, 0.2, 0.3, 1.0, 2.0, 3.0, 10.0, 30.0]);
        let reference = Level::Baseline.run(Tanh(x));
        for level in [Level::Avx2, Level::Avx512] {
            if level <= Level::detect() {
                assert_eq!(
                    level.run(Tanh(x)).0.map(f64::to_bits),
                    reference.0.map(f64::to_bits)
                );
            }
        }
    }
}
