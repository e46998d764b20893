//! The steady friction moment of a rolling bearing: one interface, several laws.
//!
//! M = M(Ω, F_r, F_a) opposes the rotation; every law here returns it with the sign of the speed, odd in speed, so the
//! heat M Ω is never negative. It comes in two parts, because a bearing computed ball by ball feels them at different
//! places: a part that the flow of the lubricant makes (`speed_dependent`) and one that the contacts make
//! (`load_dependent`).
//!
//! | law | `speed_dependent` | `load_dependent` |
//! |---|---|---|
//! | [`palmgren`](crate::palmgren) | M0 | M1 |
//! | [`skf`](crate::skf) | φ_ish φ_rs M_rr + M_drag | M_sl + M_seal |
//! | [`moment_curve`](crate::moment_curve) | all of it: a measured curve does not tell its parts | 0 |
//!
//! Where a law has been left by speed, load or temperature is told by `Friction::departures`.
//!
//! Not modelled: a moment at standstill (every law fades with tanh(Ω/0.1 rad/s)), warming, running-in.

use crate::moment_curve::MomentCurve;
use crate::palmgren::{Palmgren, PalmgrenCombined};
use crate::skf::SkfMoment;
use number::{Gather, Real};

/// A steady friction moment in its two parts, N m, each with the sign of the speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentParts<R> {
    /// Made by the flow of the lubricant: churning, inlet of the contacts.
    pub speed_dependent: R,
    /// Made by what slides: contacts, seals.
    pub load_dependent: R,
}

impl<R: Real> MomentParts<R> {
    /// The whole moment M, N m.
    ///
    /// Source: sum of the parts.
    /// Valid: always.
    #[inline(always)]
    pub fn sum(self) -> R {
        self.speed_dependent + self.load_dependent
    }
}

/// The laws of the steady friction moment a bearing can be built with.
#[derive(Clone, Debug, PartialEq)]
pub enum Friction<R> {
    /// None.
    None,
    /// Palmgren's law, continuous and odd in speed; its P1 is the radial load, an axial load has no effect.
    Palmgren(Palmgren<R>),
    /// Palmgren's law as the source paper prints it, with its steps; radial load only.
    PalmgrenPrinted(Palmgren<R>),
    /// Palmgren's law with the equivalent loads of a combined load.
    PalmgrenCombined(PalmgrenCombined<R>),
    /// The SKF model.
    Skf(SkfMoment<R>),
    /// A measured curve over speed; no load has an effect.
    Curve(MomentCurve<R>),
}

impl<R: Real> Friction<R> {
    /// The moment in its parts, N m, each odd in speed.
    ///
    /// Formula: M = speed_dependent + load_dependent, see the table of this module
    ///
    /// - `speed`: of the inner race against the outer Ω, rad/s, either sign
    /// - `radial_load`: F_r, N, not negative
    /// - `axial_load`: F_a, N; its sign has no effect
    ///
    /// Source: of each law.
    /// Valid: of each law; see `Friction::departures`.
    #[inline(always)]
    pub fn parts(&self, speed: R, radial_load: R, axial_load: R) -> MomentParts<R> {
        match self {
            Friction::None => MomentParts {
                speed_dependent: R::zero(),
                load_dependent: R::zero(),
            },
            Friction::Palmgren(law) => law.parts(speed, radial_load),
            Friction::PalmgrenPrinted(law) => law.printed_parts(speed, radial_load),
            Friction::PalmgrenCombined(law) => law.parts(speed, radial_load, axial_load),
            Friction::Skf(law) => law.parts(speed, radial_load, axial_load),
            Friction::Curve(law) => MomentParts {
                speed_dependent: law.moment(speed),
                load_dependent: R::zero(),
            },
        }
    }

    /// The whole moment M, N m, odd in speed: what the inner race feels against its rotation in a steady run.
    ///
    /// Formula: the sum of [`Friction::parts`], its arguments as there
    ///
    /// Source: of each law.
    /// Valid: of each law; see `Friction::departures`.
    #[inline(always)]
    pub fn moment(&self, speed: R, radial_load: R, axial_load: R) -> R {
        self.parts(speed, radial_load, axial_load).sum()
    }
}

impl<R: Real> Gather<R> for Friction<f64> {
    type Out = Friction<R>;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> Friction<R>
    where
        Self: 'a,
    {
        macro_rules! variant {
            ($Variant:ident) => {
                Friction::$Variant(Gather::<R>::gather(&|lane| match machine(lane) {
                    Friction::$Variant(law) => law,
                    _ => panic!("lanes share the friction law"),
                }))
            };
        }
        match machine(0) {
            Friction::None => Friction::None,
            Friction::Palmgren(_) => variant!(Palmgren),
            Friction::PalmgrenPrinted(_) => variant!(PalmgrenPrinted),
            Friction::PalmgrenCombined(_) => variant!(PalmgrenCombined),
            Friction::Skf(_) => variant!(Skf),
            Friction::Curve(_) => variant!(Curve),
        }
    }
}
