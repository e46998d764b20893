//! Steady friction moment of a rolling bearing after Palmgren.
//!
//! M = M0 + M1: a part without load that grows with viscosity and speed, and a part with load.
//! The moment of this module opposes the rotation: it has the sign of the speed.
//!
//! Two forms of M0 exist here. [`printed_viscous_moment`] is (16) of the source paper letter by letter, with its
//! rounded constants and its step of 1 % at νΩ = 209; it serves comparison. [`viscous_moment`] is the product's:
//! exact constant, continuous, odd in speed, zero at rest.
//!
//! The diameter is that of the ball centres, as in the source paper. Schaeffler, whose f0 and f1 are the default, means
//! (d + D)/2: where the two differ M0 goes with the cube of their ratio (6205: 39 against 38.5 mm, 4 %).
//!
//! Not modelled: warming (ν is given), churning of an oil bath, seals, running-in, a moment at standstill, the factor 2 to 5
//! on f0 of a freshly greased bearing.

use crate::moment_parts::MomentParts;
use crate::power::power_from_zero;
use crate::static_load::equivalent_static_load;
use number::Real;
use std::f64::consts::PI;

/// Speed below which the continuous moment fades, rad/s: tanh(Ω/0.1) is 1 within 5e-9 above 1 rad/s.
pub const FADING_SPEED: f64 = 0.1;

number::constants! {
    /// Constants of Palmgren's moment of one bearing.
    pub struct Palmgren {
        /// f0: viscous factor of type and lubrication.
        viscous_factor: R,
        /// Kinematic viscosity ν, m²/s.
        viscosity: R,
        /// Pitch diameter d_m, m.
        pitch_diameter: R,
        /// z of f1 = z (P0/C0)^y.
        load_factor: R,
        /// y of f1 = z (P0/C0)^y.
        load_exponent: R,
        /// Static load rating C0, N.
        static_load_rating: R,
        /// Load W_p of rings that press on all balls, N: the one that a bearing without radial load has; 0 where none do.
        preload: R,
    }
}

impl<R: Real> Palmgren<R> {
    /// The radial load that presses the balls as hard as a radial load beside the preload does, N.
    ///
    /// Formula: √(W² + W_p²)
    ///
    /// - `load`: W, N; 0 for W ≤ 0
    ///
    /// Source: derived; beside load zones of 10 balls within 14 % for preloads of 0.4 to 35 µm and loads above that at which W_p was found.
    /// Valid: preload of rings that press all round.
    #[inline(always)]
    fn pressing(&self, load: R) -> R {
        let load = load.max(R::zero());
        let both = (load * load + self.preload * self.preload).sqrt();
        R::select(self.preload.greater(R::zero()), both, load)
    }

    /// Friction moment in the product's form, N m; it has the sign of the speed and vanishes at rest.
    ///
    /// Formula: M = M0(Ω) + M1(W) tanh(Ω/0.1 rad/s), P0 = P1 = W
    ///
    /// - `speed`: Ω, rad/s
    /// - `load`: radial load W, N; without load (W ≤ 0) M1 is 0
    ///
    /// Source: the source paper (16), (17) with the corrections of this module.
    /// Valid: purely radial load; ν n up to 1e6 mm²/s·rpm, W below C0.
    #[inline(always)]
    pub fn moment(&self, speed: R, load: R) -> R {
        self.parts(speed, load).sum()
    }

    /// The two parts of [`Palmgren::moment`], M0 and M1, N m, each with the sign of the speed.
    ///
    /// - `speed`: Ω, rad/s
    /// - `load`: radial load W, N
    ///
    /// Source: as [`Palmgren::moment`].
    /// Valid: as [`Palmgren::moment`].
    #[inline(always)]
    pub fn parts(&self, speed: R, load: R) -> MomentParts<R> {
        self.parts_with(speed, self.load_moment(load))
    }

    /// M0 of this speed beside a given M1 without its sign.
    #[inline(always)]
    fn parts_with(&self, speed: R, load_moment: R) -> MomentParts<R> {
        let fading = fading(speed);
        let size = viscous_magnitude(
            self.viscous_factor,
            self.viscosity,
            speed,
            self.pitch_diameter,
        );
        MomentParts {
            speed_dependent: size * fading,
            load_dependent: load_moment * fading,
        }
    }

    /// Friction moment with (16) as printed, N m; it has the sign of the speed, with a step at rest.
    ///
    /// Formula: M = M0 + M1 sgn Ω with M0 of [`printed_viscous_moment`]
    ///
    /// - `speed`: Ω, rad/s
    /// - `load`: radial load W, N
    ///
    /// Source: the source paper (16), (17), the latter with its exponent.
    /// Valid: as [`Palmgren::moment`]; not at standstill.
    #[inline(always)]
    pub fn printed_moment(&self, speed: R, load: R) -> R {
        self.printed_parts(speed, load).sum()
    }

    /// The two parts of [`Palmgren::printed_moment`], N m, each with the sign of the speed.
    ///
    /// - `speed`: Ω, rad/s
    /// - `load`: radial load W, N
    ///
    /// Source: as [`Palmgren::printed_moment`].
    /// Valid: as [`Palmgren::printed_moment`].
    #[inline(always)]
    pub fn printed_parts(&self, speed: R, load: R) -> MomentParts<R> {
        MomentParts {
            speed_dependent: printed_viscous_moment(
                self.viscous_factor,
                self.viscosity,
                speed,
                self.pitch_diameter,
            ),
            load_dependent: self.load_moment(load) * sign(speed),
        }
    }

    /// Load-dependent part M1 of this bearing, N m, not negative.
    ///
    /// Formula: M1 = z (P/C0)^y P d_m, P = √(W² + W_p²)
    ///
    /// - `load`: radial load W, N; taken as 0 for W ≤ 0
    ///
    /// Source: as [`load_moment`] and [`load_friction_factor`], P0 = P1 = P.
    /// Valid: purely radial load below C0.
    #[inline(always)]
    pub fn load_moment(&self, load: R) -> R {
        let load = self.pressing(load);
        let factor = load_friction_factor(
            self.load_factor,
            self.load_exponent,
            load,
            self.static_load_rating,
        );
        load_moment(factor, load, self.pitch_diameter)
    }
}

impl Palmgren<f64> {
    /// Multiplies the moment: M0 goes with f0, M1 with z.
    pub(crate) fn scale(&mut self, factor: f64) {
        self.viscous_factor *= factor;
        self.load_factor *= factor;
    }
}

number::constants! {
    /// Palmgren's moment under radial and axial load.
    pub struct PalmgrenCombined {
        /// The constants of the bearing.
        law: Palmgren<R>,
        /// X1 of P1 = X1 F_r + Y1 F_a.
        radial_factor: R,
        /// Y1 of P1.
        axial_factor: R,
        /// X0 of the static equivalent load P0 = X0 F_r + Y0 F_a.
        static_radial_factor: R,
        /// Y0 of the static equivalent load.
        static_axial_factor: R,
    }
}

impl<R: Real> PalmgrenCombined<R> {
    /// M0 and M1 under combined load, N m, each with the sign of the speed.
    ///
    /// Formula: M0 as [`Palmgren::parts`]; M1 = z (P0/C0)^y P1 d_m, P0 = max(F_r, X0 F_r + Y0 F_a),
    /// P1 = max(F_r, X1 F_r + Y1 F_a)
    ///
    /// - `speed`: Ω, rad/s
    /// - `radial_load`: F_r, N
    /// - `axial_load`: F_a, N, either direction
    ///
    /// Source: [`FactorSource`](crate::palmgren_factors::FactorSource) (P1); ISO 76 (P0, from memory).
    /// Valid: P0 below C0; else as [`Palmgren::moment`].
    #[inline(always)]
    pub fn parts(&self, speed: R, radial_load: R, axial_load: R) -> MomentParts<R> {
        let axial_load = axial_load.abs();
        let radial_load = self.law.pressing(radial_load);
        let static_load = self.static_load(radial_load, axial_load);
        let factor = load_friction_factor(
            self.law.load_factor,
            self.law.load_exponent,
            static_load,
            self.law.static_load_rating,
        );
        let load =
            radial_load.max(self.radial_factor * radial_load + self.axial_factor * axial_load);
        let moment = load_moment(factor, load.max(R::zero()), self.law.pitch_diameter);
        self.law.parts_with(speed, moment)
    }

    /// Equivalent static load P0, N.
    ///
    /// Formula: P0 = max(F_r, X0 F_r + Y0 F_a)
    ///
    /// - `radial_load`: F_r, N
    /// - `axial_load`: F_a, N, not negative
    ///
    /// Source: ISO 76 (from memory); makers print X0 0.6, Y0 0.5 for single row deep groove bearings.
    /// Valid: as the two factors.
    #[inline(always)]
    pub fn static_load(&self, radial_load: R, axial_load: R) -> R {
        let factors = [self.static_radial_factor, self.static_axial_factor];
        equivalent_static_load(factors, radial_load, axial_load)
    }
}

/// tanh(Ω/0.1 rad/s): the smooth sign that every continuous moment fades with at rest.
#[inline(always)]
pub(crate) fn fading<R: Real>(speed: R) -> R {
    (speed * R::splat(1.0 / FADING_SPEED)).tanh_far_out()
}

/// ν n in the unit of Palmgren's constants, mm²/s · rpm.
#[inline(always)]
pub(crate) fn viscosity_times_speed_mm2_s_rpm<R: Real>(viscosity: R, speed: R) -> R {
    viscosity * R::splat(1e6) * speed.abs() * R::splat(30.0 / PI)
}

/// d_m³ f0 with the moment in N m instead of N mm: (1000 d_m)³ / 1000.
#[inline(always)]
fn size_mm3_per_1000<R: Real>(viscous_factor: R, pitch_diameter: R) -> R {
    viscous_factor * pitch_diameter * pitch_diameter * pitch_diameter * R::splat(1e6)
}

/// +1, 0 or -1.
#[inline(always)]
fn sign<R: Real>(x: R) -> R {
    R::select(
        x.greater(R::zero()),
        R::one(),
        R::select(x.less(R::zero()), -R::one(), R::zero()),
    )
}

/// M0 of the continuous form without its sign, N m.
#[inline(always)]
fn viscous_magnitude<R: Real>(viscous_factor: R, viscosity: R, speed: R, pitch_diameter: R) -> R {
    // 2000^(2/3) = 158.7 lies below the floor of 160, so the power never meets 0.
    let product = viscosity_times_speed_mm2_s_rpm(viscosity, speed).max(R::splat(2000.0));
    let power = product.two_thirds().max(R::splat(160.0));
    size_mm3_per_1000(viscous_factor, pitch_diameter) * R::splat(1e-7) * power
}

/// Load-independent moment M0, continuous and odd, N m.
///
/// Formula: M0 = 1e-7 f0 d_m³ max(160, (ν|n|)^(2/3)) tanh(Ω/0.1 rad/s) [N mm; d_m mm, ν mm²/s, n rpm]
///
/// - `viscous_factor`: f0
/// - `viscosity`: kinematic viscosity ν, m²/s
/// - `speed`: Ω, rad/s, either sign
/// - `pitch_diameter`: d_m, m
///
/// Source: A. Palmgren; Schaeffler HR 1 (2006) p. 54 (constants 1e-7, 160e-7, limit 2000); smoothed here.
/// Valid: 1 to 2000 rad/s and ν 5 to 500 mm²/s: within 0.96 % of the printed (16); below 1 rad/s a smooth way to 0.
#[inline(always)]
pub fn viscous_moment<R: Real>(viscous_factor: R, viscosity: R, speed: R, pitch_diameter: R) -> R {
    viscous_magnitude(viscous_factor, viscosity, speed, pitch_diameter) * fading(speed)
}

/// Load-independent moment M0 as (16) is printed, N m; it has the sign of the speed and is 0 at rest.
///
/// Formula: M0 = 4.5e-7 f0 (νΩ)^(2/3) d_m³ for νΩ ≥ 209, else 1.6e-5 f0 d_m³ [N mm; d_m mm, ν mm²/s, Ω rad/s]
///
/// - `viscous_factor`: f0
/// - `viscosity`: kinematic viscosity ν, m²/s
/// - `speed`: Ω, rad/s, either sign
/// - `pitch_diameter`: d_m, m
///
/// Source: the source paper (16). The exact constant is 1e-7 (30/π)^(2/3) = 4.5011e-7, the limit 2000·π/30 = 209.4.
/// Valid: for comparison with the paper; steps by 1 % at νΩ = 209 and from -M0 to M0 at rest.
#[inline(always)]
pub fn printed_viscous_moment<R: Real>(
    viscous_factor: R,
    viscosity: R,
    speed: R,
    pitch_diameter: R,
) -> R {
    let limit = R::splat(209.0);
    let product = viscosity * R::splat(1e6) * speed.abs();
    let power = product.max(limit).powf(R::splat(2.0 / 3.0)) * R::splat(4.5e-7);
    let factor = R::select(product.less(limit), R::splat(1.6e-5), power);
    size_mm3_per_1000(viscous_factor, pitch_diameter) * factor * sign(speed)
}

/// Friction factor f1 of the load-dependent moment.
///
/// Formula: f1 = z (P0/C0)^y, 0 without load
///
/// - `load_factor`: z; 0.0009 at most for deep groove bearings, 0.0007 for series 60
/// - `load_exponent`: y; 0.55 after Palmgren/Harris (from memory), 0.5 in one maker's table
/// - `static_load`: equivalent static load P0, N
/// - `static_load_rating`: C0, N
///
/// Source: A. Palmgren/T. A. Harris (from memory); Schaeffler HR 1 (2006) p. 56 (y 0.5). (17) of the source paper
/// prints 0.0009 (P0/C0) without the exponent: at P0/C0 = 0.01 that is 8 times too small.
/// Valid: P0 up to C0.
#[inline(always)]
pub fn load_friction_factor<R: Real>(
    load_factor: R,
    load_exponent: R,
    static_load: R,
    static_load_rating: R,
) -> R {
    load_factor * power_from_zero(static_load / static_load_rating, load_exponent)
}

/// Load-dependent moment M1, N m.
///
/// Formula: M1 = f1 P1 d_m
///
/// - `friction_factor`: f1 of [`load_friction_factor`]
/// - `load`: P1, N
/// - `pitch_diameter`: d_m, m
///
/// Source: the source paper (17).
/// Valid: P1 ≥ 0.
#[inline(always)]
pub fn load_moment<R: Real>(friction_factor: R, load: R, pitch_diameter: R) -> R {
    friction_factor * load * pitch_diameter
}

#[cfg(test)]
mod tests {
    use super::*;
    use number::{Dual, Gather};

    const MM2_S: f64 = 1e-6;

    fn bearing() -> Palmgren<f64> {
        Palmgren {
            viscous_factor: 2.0,
            viscosity: 100.0 * MM2_S,
            pitch_diameter: 36e-3,
            load_factor: 0.0009,
            load_exponent: 0.55,
            static_load_rating: 6550.0,
            preload: 0.0,
        }
    }

    #[test]
    fn a_6005_at_150_rad_s_needs_25_n_mm() {
        // By hand: ν n = 100·1432.4 = 143 239, ^(2/3) = 2737.7; 1e-7·2·46656·2737.7 = 25.55 N mm.
        let moment = viscous_moment(2.0, 100.0 * MM2_S, 150.0, 36e-3);
        assert!((moment / 25.546e-3 - 1.0).abs() < 1e-4, "{moment}");
    }
    #[test]
    fn within_0_96_percent_of_the_printed_form() {
        let mut largest: f64 = 0.0;
        for viscosity in [5.0, 20.0, 100.0, 500.0] {
            for step in 0..=4000 {
                let speed = 2000_f64.powf(f64::from(step) / 4000.0);
                let ours = viscous_moment(1.5, viscosity * MM2_S, speed, 36e-3);
                let printed = printed_viscous_moment(1.5, viscosity * MM2_S, speed, 36e-3);
                largest = largest.max((ours / printed - 1.0).abs());
            }
        }
        // 160/(4.5·209^(2/3)) = 1.00955 is the printed step itself
        assert!((0.009..0.0096).contains(&largest), "{largest}");
    }
    #[test]
    fn the_exponent_lost_in_print_matters_eightfold() {
        let with_exponent = load_friction_factor(0.0009, 0.55, 65.5, 6550.0);
        let as_printed = 0.0009 * 0.01;
        // 0.01^(0.55 - 1) = 7.94
        assert!((with_exponent / as_printed - 7.943).abs() < 1e-3);
    }
    #[test]
    fn axial_load_enters_through_two_equivalent_loads() {
        let combined = PalmgrenCombined {
            law: bearing(),
            radial_factor: -0.1,
            axial_factor: 0.9 / 25_f64.to_radians().tan(),
            static_radial_factor: 0.5,
            static_axial_factor: 0.38,
        };
        // By a script: F_r 100, F_a 400: P1 = 1.930057·400 - 10 = 762.022 N, P0 = 50 + 152 = 202 N,
        // f1 = 0.0009 (202/6550)^0.55 = 1.328168e-4, M1 = f1·762.022·0.036 = 3.643538e-3 N m.
        let parts = combined.parts(150.0, 100.0, -400.0);
        assert!(
            (parts.load_dependent / 3.643_538e-3 - 1.0).abs() < 1e-6,
            "{parts:?}"
        );
        // little axial load: P1 = P0 = F_r, the law of the radial load
        let radial = combined.parts(150.0, 100.0, 10.0);
        assert_eq!(radial, bearing().parts(150.0, 100.0));
        assert_eq!(parts.speed_dependent, radial.speed_dependent);
    }
    #[test]
    fn odd_in_speed_and_zero_at_rest() {
        let bearing = bearing();
        for speed in [1e-3, 0.1, 2.0, 150.0, 3000.0] {
            assert_eq!(bearing.moment(-speed, 80.0), -bearing.moment(speed, 80.0));
            assert_eq!(
                bearing.printed_moment(-speed, 80.0),
                -bearing.printed_moment(speed, 80.0)
            );
            assert!(bearing.moment(speed, 80.0) > 0.0);
        }
        assert_eq!(bearing.moment(0.0, 80.0), 0.0);
        assert_eq!(bearing.printed_moment(0.0, 80.0), 0.0);
    }
    #[test]
    fn continuous_where_the_printed_form_steps() {
        // Around νn = 2023.9 (160^1.5) and around rest the moment moves by no more than its slope allows.
        let bearing = bearing();
        let mut last = bearing.moment(-3.0, 0.0);
        for step in -2999..=3000 {
            let moment = bearing.moment(f64::from(step) * 1e-3, 0.0);
            // slope at rest 160e-7 f0 d_m³/0.1 = 14.9 mN m per rad/s; a flat part may lose a rounding
            assert!(moment - last > -1e-15 && moment - last < 1.5e-5);
            last = moment;
        }
    }
    #[test]
    fn scaling_by_dimension() {
        // d_m³ in the viscous part, ν and Ω only as a product, W^(1+y) in the load part.
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-14;
        let base = viscous_moment(2.0, 100.0 * MM2_S, 150.0, 36e-3);
        assert!(near(
            viscous_moment(2.0, 100.0 * MM2_S, 150.0, 72e-3),
            8.0 * base
        ));
        assert!(near(viscous_moment(2.0, 50.0 * MM2_S, 300.0, 36e-3), base));
        assert!(near(
            viscous_moment(2.0, 100.0 * MM2_S, 1200.0, 36e-3),
            4.0 * base
        ));
        let bearing = bearing();
        let double = 2_f64.powf(1.55);
        assert!(near(
            bearing.load_moment(80.0),
            bearing.load_moment(40.0) * double
        ));
        assert_eq!(bearing.load_moment(0.0), 0.0);
        assert_eq!(bearing.load_moment(-1.0), 0.0);
    }
    #[test]
    fn duals_agree_with_differences() {
        let bearing = bearing();
        let dual: Palmgren<Dual<1>> = Gather::gather(&|_| &bearing);
        for speed in [0.0, 0.03, 1.0, 400.0] {
            let slope = dual
                .moment(Dual::variable(speed, 0), Dual::splat(90.0))
                .partial[0];
            let h = 1e-4 * (1.0 + speed) * 0.01;
            let difference =
                (bearing.moment(speed + h, 90.0) - bearing.moment(speed - h, 90.0)) / (2.0 * h);
            // truncation of the central difference (h/0.1)²
            assert!((slope - difference).abs() < 1e-4 * slope.abs().max(1e-6));
        }
    }
}
