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
//! | [`moment_curve`](crate::moment_curve) | all of it: a measured curve does not separate its parts | 0 |
//!
//! Where a law has been left by speed, load or temperature is reported by [`Friction::departures`].
//!
//! Not modelled: a moment at standstill (every law fades with tanh(Ω/0.1 rad/s)), warming, running-in.

use crate::moment_curve::MomentCurve;
pub use crate::moment_parts::MomentParts;
use crate::palmgren::{Palmgren, PalmgrenCombined};
use crate::skf::SkfMoment;
use number::Real;

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
    /// Valid: of each law; see [`Friction::departures`].
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
    /// Valid: of each law; see [`Friction::departures`].
    #[inline(always)]
    pub fn moment(&self, speed: R, radial_load: R, axial_load: R) -> R {
        self.parts(speed, radial_load, axial_load).sum()
    }
}

impl Friction<f64> {
    /// The law with its moment multiplied, for a bearing that was measured to have a share of it.
    ///
    /// Formula: λ M
    ///
    /// - `factor`: λ, positive
    ///
    /// Source: every law is proportional to some of its constants.
    /// Valid: always.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        match &mut self {
            Friction::None => {}
            Friction::Palmgren(law) | Friction::PalmgrenPrinted(law) => law.scale(factor),
            Friction::PalmgrenCombined(combined) => combined.law.scale(factor),
            Friction::Skf(law) => law.scale(factor),
            Friction::Curve(law) => law.scale(factor),
        }
        self
    }
}

number::variants!(Friction, "friction law": None; Palmgren, PalmgrenPrinted, PalmgrenCombined, Skf, Curve);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing_6005::{PALMGREN, SKF, SKF_GREASE};
    use crate::palmgren::viscous_moment;
    use crate::skf_constants::SkfLubricant;
    use number::Gather;
    use number::{Level, Task};
    use proptest::prelude::*;

    /// A 6005 under every law.
    fn laws() -> [Friction<f64>; 6] {
        let grease = SkfLubricant {
            seal_moment: 2e-3,
            ..SKF_GREASE
        };
        let points = [(0.0, 0.01), (20.0, 0.012), (100.0, 0.011), (400.0, 0.03)];
        [
            Friction::None,
            Friction::Palmgren(PALMGREN),
            Friction::PalmgrenPrinted(PALMGREN),
            Friction::PalmgrenCombined(PalmgrenCombined {
                law: PALMGREN,
                radial_factor: -0.1,
                axial_factor: 3.36,
                static_radial_factor: 0.6,
                static_axial_factor: 0.5,
            }),
            Friction::Skf(SKF.moment(&grease).unwrap()),
            Friction::Curve(MomentCurve::through(&points).unwrap()),
        ]
    }

    proptest! {
        #[test]
        fn no_law_drives_and_all_are_odd(
            speed in -3e3..3e3_f64,
            radial in 0.0..6e3_f64,
            axial in -3e3..3e3_f64,
        ) {
            for law in laws() {
                let (ahead, back) = (law.parts(speed, radial, axial), law.parts(-speed, radial, axial));
                prop_assert!(ahead.speed_dependent * speed >= 0.0);
                prop_assert!(ahead.load_dependent * speed >= 0.0);
                prop_assert_eq!(ahead.speed_dependent, -back.speed_dependent);
                prop_assert_eq!(ahead.load_dependent, -back.load_dependent);
                prop_assert_eq!(law.moment(speed, radial, axial), ahead.sum());
            }
        }
    }
    #[test]
    fn the_parts_stand_where_the_table_says() {
        let [_, palmgren, printed, _, skf, curve] = laws();
        let parts = palmgren.parts(150.0, 80.0, 0.0);
        assert_eq!(
            parts.speed_dependent,
            viscous_moment(1.7, 100e-6, 150.0, 36e-3)
        );
        // 0.0007 (80/6550)^0.5·80·0.036 = 2.2280e-4 N m
        assert!((parts.load_dependent / 2.2280e-4 - 1.0).abs() < 1e-4);
        assert_eq!(
            printed.parts(150.0, 80.0, 0.0).load_dependent,
            parts.load_dependent
        );
        // without load a deep groove bearing after SKF keeps its seals alone
        let idle = skf.parts(150.0, 0.0, 0.0);
        assert_eq!((idle.speed_dependent, idle.load_dependent), (0.0, 2e-3));
        assert_eq!(curve.parts(20.0, 80.0, 0.0).load_dependent, 0.0);
    }
    #[test]
    fn a_scaled_law_has_both_parts_scaled() {
        for law in laws() {
            let scaled = law.clone().scaled(0.7);
            for (speed, radial, axial) in [(150.0, 80.0, 0.0), (-900.0, 500.0, 200.0)] {
                let (is, was) = (
                    scaled.parts(speed, radial, axial),
                    law.parts(speed, radial, axial),
                );
                for (is, was) in [
                    (is.speed_dependent, was.speed_dependent),
                    (is.load_dependent, was.load_dependent),
                ] {
                    assert!(
                        (is - 0.7 * was).abs() <= 1e-14 * was.abs(),
                        "{law:?} {is} {was}"
                    );
                }
            }
        }
    }
    #[test]
    fn laws_of_one_bearing_agree_in_size() {
        // 6005, grease of 100 mm²/s, 150 rad/s, 500 N radial: Palmgren with the f0 of settled grease (1.1)
        // and the SKF model without seals. Neither knows the other; makers' models agree within a factor of 2.
        let settled = Palmgren {
            viscous_factor: 1.1,
            ..PALMGREN
        };
        let palmgren = Friction::Palmgren(settled).moment(150.0, 500.0, 0.0);
        let [.., skf, _] = laws();
        let skf = skf.moment(150.0, 500.0, 0.0) - 2e-3;
        assert!((0.5..2.0).contains(&(skf / palmgren)), "{skf} {palmgren}");
    }
    /// The moments of every law, one lane a speed, as bits.
    struct SideBySide;
    impl Task for SideBySide {
        type Output = Vec<Vec<u64>>;
        #[inline(always)]
        fn run<R: Real>(self) -> Vec<Vec<u64>> {
            laws()
                .iter()
                .map(|law| {
                    let wide: Friction<R> = Gather::gather(&|_| law);
                    let speed = R::from_lanes(|lane| SPEEDS[lane]);
                    let moment = wide.moment(speed, speed.abs() - R::splat(20.0), R::splat(30.0));
                    (0..R::LANES)
                        .map(|lane| moment.lane(lane).to_bits())
                        .collect()
                })
                .collect()
        }
    }
    const SPEEDS: [f64; 8] = [-0.05, 400.0, 0.0, 3.0, -2e3, 19.0, 21.0, 1e-9];

    #[test]
    fn lanes_agree_with_the_scalar_bit_for_bit() {
        let level = Level::detect();
        for (wide, law) in level.run_many(SideBySide).iter().zip(laws()) {
            assert_eq!(wide.len(), level.lanes());
            for (bits, speed) in wide.iter().zip(SPEEDS) {
                let scalar = law.moment(speed, speed.abs() - 20.0, 30.0);
                assert_eq!(f64::from_bits(*bits), scalar);
            }
        }
    }
    #[test]
    #[should_panic(expected = "lanes share the friction law")]
    fn lanes_of_different_laws_are_refused() {
        struct Mixed;
        impl Task for Mixed {
            type Output = ();
            #[inline(always)]
            fn run<R: Real>(self) {
                let [_, first, second, ..] = laws();
                let gathered: Friction<R> =
                    Gather::gather(&|lane| if lane == 0 { &first } else { &second });
                // one lane alone cannot differ
                assert!(R::LANES > 1, "lanes share the friction law: {gathered:?}");
            }
        }
        Level::detect().run_many(Mixed);
    }
}
