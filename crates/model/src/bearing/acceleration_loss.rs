//! Friction F of the balls in their pockets, given rather than computed: what the source paper's rig is to measure.
//!
//! ```text
//!   F = F0(Ω) + F1(Ω)|Ω̇|, the sum over the balls, with the sign of Ω            s = r/R
//!   at both races, against the rotation: arm F,  arm = (1+2s)R/(2(1+s))
//!   heat in the pockets: arm F Ω = r(ω_b + ω_c) F, force times sliding speed
//! ```
//! At rest F0 fades as the steady moment does, with tanh(Ω/0.1 rad/s); F1 does not, as it cannot drive.
//!
//! Assumes: the balls roll. Does not model: anything of the pockets; in the planar fidelity they are computed, and no
//! F exists.
//! Source: the source paper (6)-(11), (14), (15); its F(Ω, Ω̇) made affine in |Ω̇|.

use crate::table::{Lines, Table};
use number::{Gather, Real};
use physics::palmgren::FADING_SPEED;

/// Kinds of F. Forces in N over speeds |Ω| in rad/s; all values are at least zero, so F never drives.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum AccelerationLoss {
    /// F = 0.
    #[default]
    None,
    /// F = F0.
    Constant {
        /// F0, N.
        force: f64,
    },
    /// F = q|Ω̇|.
    Proportional {
        /// q, N s²/rad.
        per_acceleration: f64,
    },
    /// F = F0(|Ω|).
    OverSpeed {
        /// F0, N over rad/s.
        force: Table,
    },
    /// F = F0(|Ω|) + F1(|Ω|)|Ω̇|.
    Affine {
        /// F0, N over rad/s.
        force: Table,
        /// F1, N s²/rad over rad/s.
        per_acceleration: Table,
    },
}

impl AccelerationLoss {
    /// F0 and F1 over |Ω|; none where there is no F.
    pub fn parts(&self) -> Option<(Table, Table)> {
        let zero = || Table::constant(0.0);
        match self {
            AccelerationLoss::None => None,
            AccelerationLoss::Constant { force } => Some((Table::constant(*force), zero())),
            AccelerationLoss::Proportional { per_acceleration } => {
                Some((zero(), Table::constant(*per_acceleration)))
            }
            AccelerationLoss::OverSpeed { force } => Some((force.clone(), zero())),
            AccelerationLoss::Affine {
                force,
                per_acceleration,
            } => Some((force.clone(), per_acceleration.clone())),
        }
    }
    /// F at a speed and an acceleration, N.
    pub fn force(&self, speed: f64, acceleration: f64) -> f64 {
        self.parts().map_or(0.0, |(force, per_acceleration)| {
            let size = speed.abs();
            force.value(size) * (speed / FADING_SPEED).tanh()
                + per_acceleration.value(size) * acceleration.abs() * speed.signum()
        })
    }
    /// The largest F1, N s²/rad.
    pub fn largest_per_acceleration(&self) -> f64 {
        self.parts().map_or(0.0, |(_, f1)| f1.largest())
    }
    /// True where no value is negative: then F takes energy out whatever the race does.
    pub fn is_passive(&self) -> bool {
        self.parts()
            .is_none_or(|(f0, f1)| f0.smallest() >= 0.0 && f1.smallest() >= 0.0)
    }
}

/// F over `R`.
#[derive(Clone, Debug)]
pub(super) struct Loss<R> {
    /// (1+2s)R/(2(1+s)), m.
    arm: R,
    force: Lines<R>,
    per_acceleration: Lines<R>,
}

impl<R: Real> Loss<R> {
    /// One loss per lane, with its arm; none where there is none.
    pub fn gather<'a>(machine: &dyn Fn(usize) -> (f64, &'a AccelerationLoss)) -> Option<Self> {
        let parts: Vec<_> = (0..R::LANES).map(|lane| machine(lane).1.parts()).collect();
        let same = parts
            .iter()
            .all(|part| part.is_some() == parts[0].is_some());
        assert!(same, "lanes share the presence of an acceleration loss");
        parts[0].as_ref()?;
        let part = |lane: usize| parts[lane].as_ref().expect("lanes share it");
        Some(Loss {
            arm: R::from_lanes(|lane| machine(lane).0),
            force: Gather::<R>::gather(&|lane| &part(lane).0),
            per_acceleration: Gather::<R>::gather(&|lane| &part(lane).1),
        })
    }
    /// Moment arm F0(|Ω|) against the rotation, N m.
    #[inline(always)]
    pub fn moment(&self, speed: R) -> R {
        let fading = (speed * R::splat(1.0 / FADING_SPEED)).tanh();
        self.arm * self.force.value(speed.abs()) * fading
    }
    /// Moment per size of the acceleration arm F1(|Ω|), kg m².
    #[inline(always)]
    pub fn inertia(&self, speed: R) -> R {
        self.arm * self.per_acceleration.value(speed.abs())
    }
}
