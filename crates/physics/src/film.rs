//! Thickness of the lubricant film between ball and race: Hamrock and Dowson's point contact.
//!
//! ```text
//!      surfaces drag oil into the inlet          h_c  central thickness: the flat middle
//!    ────────╮                  ╭────────        h_min  at the two side lobes
//!   oil →    ╰──────────────────╯   →
//!            film h_c, pressure nearly Hertz's
//!
//!   U = η v/(E' R_x),  G = α E',  W = Q/(E' R_x²),  k = a/b
//!   h_c   = φ_s φ_T R_x 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k))
//!   h_min = φ_s φ_T R_x 3.63 U^0.68 G^0.49 W^-0.073 (1 - e^(-0.68 k))
//! ```
//! v is the entrainment speed, the *mean* of the two surface speeds seen from the contact; R_x the radius of the
//! equivalent ball along the rolling direction; k the long axis of the ellipse (across the groove) over the short one;
//! φ_s ≤ 1 what starvation leaves, an input; φ_T ≤ 1 what heating in the inlet leaves, [`InletHeating`].
//!
//! Two moduli are in use. Here E' = 2/[(1 - ν₁²)/E₁ + (1 - ν₂²)/E₂], as Hamrock has it: **twice** the contact modulus
//! E* of [`contact_modulus`](crate::materials::contact_modulus).
//!
//! In the time loop the thickness is one exponential of two logarithms: everything constant is in one number.
//!
//! Assumed: steady, fully flooded up to φ_s, smooth surfaces, Newtonian inlet. Not modelled: squeeze in an impact (the
//! film follows load and speed at once), the time a film needs to be carried through the contact, grease thickener.

use crate::hertz::{Curvature, NotAPoint, PointContact};
use number::{Real, constants};

/// Entrainment below which the film is taken as thick as here, m/s: keeps logarithms finite at standstill.
pub(crate) const SLOWEST: f64 = 1e-9;

/// Load below which the film is taken as thick as here, N.
pub(crate) const LIGHTEST: f64 = 1e-9;

/// What part of the thickness heating in the inlet leaves at least: below, the fit has no data.
const LEAST_SHARE_OF_PRESSURE: f64 = 0.1;

/// Largest slide-to-roll ratio of the fit: one surface at rest.
const LARGEST_SLIDE_TO_ROLL: f64 = 2.0;

/// Geometry and elasticity of a contact that drags oil into itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EntrainedContact {
    /// R_x: radius of the equivalent ball along the rolling direction, m.
    pub rolling_radius: f64,
    /// k: long over short axis of the contact ellipse, the long one across the rolling direction.
    pub ellipticity: f64,
    /// E* of the two bodies, Pa; E' is 2 E*.
    pub contact_modulus: f64,
}

/// The three dimensionless groups of a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmGroups {
    /// U = η v/(E' R_x).
    pub speed: f64,
    /// G = α E'.
    pub material: f64,
    /// W = Q/(E' R_x²).
    pub load: f64,
}

impl EntrainedContact {
    /// The contact of two bodies, its ellipticity exact.
    ///
    /// Formula: R_x = 1/ρ_b, k = a/b of [`PointContact`]
    ///
    /// - `curvature`: sums of principal curvatures, 1/m
    /// - `contact_modulus`: E*, Pa
    ///
    /// Source: Hertz 1881; Hamrock and Dowson's own fit k = 1.03 (R_y/R_x)^0.64 differs by less than 3 % where k > 1.25.
    /// Valid: ellipse long across the rolling direction, as in grooves; else an error.
    pub fn new(curvature: Curvature, contact_modulus: f64) -> Result<Self, NotAPoint> {
        let contact = PointContact::new(curvature, contact_modulus)?;
        if curvature.axial > curvature.rolling {
            return Err(NotAPoint(curvature));
        }
        Ok(EntrainedContact {
            rolling_radius: 1.0 / curvature.rolling,
            ellipticity: contact.ellipticity,
            contact_modulus,
        })
    }

    /// E', Pa: the modulus of lubrication papers.
    ///
    /// Formula: E' = 2/[(1 - ν₁²)/E₁ + (1 - ν₂²)/E₂] = 2 E*
    ///
    /// Source: B. J. Hamrock, D. Dowson, J. Lubr. Technol. 99 (1977) 264.
    /// Valid: isotropic, linear elastic bodies.
    pub fn effective_modulus(&self) -> f64 {
        2.0 * self.contact_modulus
    }

    /// The dimensionless groups.
    ///
    /// Formula: U = η v/(E' R_x), G = α E', W = Q/(E' R_x²)
    ///
    /// - `viscosity`: η at the temperature of the inlet and ambient pressure, Pa s
    /// - `pressure_coefficient`: α, 1/Pa
    /// - `entrainment`: v, mean of the two surface speeds, m/s
    /// - `load`: Q, N
    ///
    /// Source: B. J. Hamrock, D. Dowson, J. Lubr. Technol. 99 (1977) 264.
    /// Valid: always.
    pub fn groups(
        &self,
        viscosity: f64,
        pressure_coefficient: f64,
        entrainment: f64,
        load: f64,
    ) -> FilmGroups {
        let modulus = self.effective_modulus();
        FilmGroups {
            speed: viscosity * entrainment / (modulus * self.rolling_radius),
            material: pressure_coefficient * modulus,
            load: load / (modulus * self.rolling_radius * self.rolling_radius),
        }
    }
}

/// Central film thickness over R_x.
///
/// Formula: H_c = 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k))
///
/// - `groups`: U, G, W
/// - `ellipticity`: k
///
/// Source: B. J. Hamrock, D. Dowson, J. Lubr. Technol. 99 (1977) 264; formula as printed by A. Arana et al.,
/// Proc. IMechE J 233 (2019) 303, equation 19.
/// Valid: fully flooded, elastic and piezoviscous; fitted for k 1 to 8, U 1.7e-12 to 5e-11, W 1.1e-7 to 1.3e-6 (from memory).
/// Loaded balls have W up to 1e-3: its authors' own bearing examples extrapolate as well, by a weak power.
pub fn central_film(groups: FilmGroups, ellipticity: f64) -> f64 {
    2.69 * groups.speed.powf(0.67)
        * groups.material.powf(0.53)
        * groups.load.powf(-0.067)
        * (1.0 - 0.61 * (-0.73 * ellipticity).exp())
}

/// Minimum film thickness over R_x.
///
/// Formula: H_min = 3.63 U^0.68 G^0.49 W^-0.073 (1 - e^(-0.68 k))
///
/// - `groups`: U, G, W
/// - `ellipticity`: k
///
/// Source: B. J. Hamrock, D. Dowson, J. Lubr. Technol. 99 (1977) 264, abstract.
/// Valid: as [`central_film`].
pub fn minimum_film(groups: FilmGroups, ellipticity: f64) -> f64 {
    3.63 * groups.speed.powf(0.68)
        * groups.material.powf(0.49)
        * groups.load.powf(-0.073)
        * (1.0 - (-0.68 * ellipticity).exp())
}

/// Ratio of film thickness to combined roughness.
///
/// Formula: Λ = h/√(Rq₁² + Rq₂²)
///
/// - `thickness`: h, m: minimum or central, whichever the user of Λ means
/// - `first_roughness`, `second_roughness`: root mean square heights of the two surfaces, m
///
/// Source: definition.
/// Valid: at least one surface is rough; infinite where both are smooth.
pub fn lambda_ratio(thickness: f64, first_roughness: f64, second_roughness: f64) -> f64 {
    thickness / first_roughness.hypot(second_roughness)
}

constants! {
    /// Film thickness of one contact and one oil in the time loop, before heating of the inlet.
    pub struct FilmThickness {
        /// ln of the central thickness in m at 1 m/s and 1 N.
        central_logarithm: R,
        /// ln of the minimum thickness in m at 1 m/s and 1 N.
        minimum_logarithm: R,
    }
}

impl FilmThickness<f64> {
    /// Constants of a contact.
    ///
    /// Formula: [`central_film`] and [`minimum_film`] times R_x φ_s, at v = 1 m/s and Q = 1 N
    ///
    /// - `contact`: geometry and elasticity
    /// - `viscosity`: η at the temperature of the inlet and ambient pressure, Pa s
    /// - `pressure_coefficient`: α, 1/Pa
    /// - `supply`: φ_s, share of the flooded thickness that starvation leaves, above 0 up to 1
    ///
    /// Source: as the two functions.
    /// Valid: positive arguments.
    pub fn new(
        contact: &EntrainedContact,
        viscosity: f64,
        pressure_coefficient: f64,
        supply: f64,
    ) -> Self {
        let unit = contact.groups(viscosity, pressure_coefficient, 1.0, 1.0);
        let scale = contact.rolling_radius * supply;
        FilmThickness {
            central_logarithm: (scale * central_film(unit, contact.ellipticity)).ln(),
            minimum_logarithm: (scale * minimum_film(unit, contact.ellipticity)).ln(),
        }
    }
}

impl<R: Real> FilmThickness<R> {
    /// Central thickness, m.
    ///
    /// Formula: h_c = c |v|^0.67 Q^-0.067
    ///
    /// - `entrainment`: v, m/s; its sign has no effect
    /// - `load`: Q, N
    ///
    /// Source: [`central_film`].
    /// Valid: as there; finite for every argument (speeds and loads below 1e-9 count as 1e-9).
    #[inline(always)]
    pub fn central(&self, entrainment: R, load: R) -> R {
        let (speed, force) = logarithms(entrainment, load);
        self.central_of(speed, force).exp()
    }

    /// Minimum thickness, m.
    ///
    /// Formula: h_min = c |v|^0.68 Q^-0.073
    ///
    /// - `entrainment`: v, m/s; its sign has no effect
    /// - `load`: Q, N
    ///
    /// Source: [`minimum_film`].
    /// Valid: as [`FilmThickness::central`].
    #[inline(always)]
    pub fn minimum(&self, entrainment: R, load: R) -> R {
        let (speed, force) = logarithms(entrainment, load);
        (self.minimum_logarithm + R::splat(0.68) * speed - R::splat(0.073) * force).exp()
    }

    /// ln h_c from ln |v| and ln Q.
    #[inline(always)]
    pub(crate) fn central_of(&self, speed: R, force: R) -> R {
        self.central_logarithm + R::splat(0.67) * speed - R::splat(0.067) * force
    }
}

/// ln |v| and ln Q, clamped.
#[inline(always)]
pub(crate) fn logarithms<R: Real>(entrainment: R, load: R) -> (R, R) {
    (
        entrainment.abs().max(R::splat(SLOWEST)).ln(),
        load.max(R::splat(LIGHTEST)).ln(),
    )
}

constants! {
    /// What shear heating in the inlet leaves of the film.
    pub struct InletHeating {
        /// ln(η β/k) in ln(s²/m²): thermal load at 1 m/s.
        thermal_logarithm: R,
        /// p_max/E' at 1 N.
        pressure_ratio: R,
    }
}

impl InletHeating<f64> {
    /// Constants of a contact and an oil.
    ///
    /// Formula: L = η β v²/k, p_max/E' = factor Q^(1/3)/E'
    ///
    /// - `viscosity`: η of the inlet, Pa s
    /// - `sensitivity`: β = -∂ ln η/∂T of the inlet at ambient pressure, 1/K
    /// - `conductivity`: k of the oil, W/(m K)
    /// - `pressure_factor`: [`PointContact::pressure_factor`], Pa/N^(1/3)
    /// - `effective_modulus`: E', Pa
    ///
    /// Source: as [`InletHeating::factor`].
    /// Valid: positive arguments.
    pub fn new(
        viscosity: f64,
        sensitivity: f64,
        conductivity: f64,
        pressure_factor: f64,
        effective_modulus: f64,
    ) -> Self {
        InletHeating {
            thermal_logarithm: (viscosity * sensitivity / conductivity).ln(),
            pressure_ratio: pressure_factor / effective_modulus,
        }
    }
}

impl<R: Real> InletHeating<R> {
    /// The factor φ_T.
    ///
    /// Formula: φ_T = [1 - 13.2 (p_max/E') L^0.42]/[1 + 0.213 (1 + 2.23 S^0.83) L^0.64], L = η β v²/k, S = |u|/|v|
    ///
    /// - `slip`: u, difference of the surface speeds, m/s
    /// - `entrainment`: v, their mean, m/s
    /// - `load`: Q, N
    ///
    /// Source: P. K. Gupta, H. S. Cheng, D. Zhu, N. H. Forster, J. B. Schrand, Tribol. Trans. 35 (1992) 269 (attribution from
    /// memory); printed alike by P. Wingertszahn et al., Lubricants 11 (2023) 369, equation 12, and by A. Arana et al.,
    /// Proc. IMechE J 233 (2019) 303, equation 24.
    /// Valid: S up to 2, larger ones count as 2; the numerator counts as at least 0.1, where the fit ends; by the second of
    /// these authors too small a factor at low entrainment.
    #[inline(always)]
    pub fn factor(&self, slip: R, entrainment: R, load: R) -> R {
        let (speed, force) = logarithms(entrainment, load);
        let third = (force * R::splat(1.0 / 3.0)).exp();
        self.factor_of(slip.abs(), speed, third)
    }

    /// φ_T from |u|, ln |v| and Q^(1/3).
    #[inline(always)]
    pub(crate) fn factor_of(&self, slip: R, speed: R, third: R) -> R {
        let thermal = self.thermal_logarithm + speed + speed;
        let pressure =
            R::splat(13.2) * self.pressure_ratio * third * (thermal * R::splat(0.42)).exp();
        let ratio =
            (slip.max(R::splat(1e-300)).ln() - speed).min(R::splat(LARGEST_SLIDE_TO_ROLL.ln()));
        let sliding = R::splat(2.23) * (ratio * R::splat(0.83)).exp();
        let shear = R::splat(0.213) * (R::one() + sliding) * (thermal * R::splat(0.64)).exp();
        (R::one() - pressure).max(R::splat(LEAST_SHARE_OF_PRESSURE)) / (R::one() + shear)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hertz::{BallRace, Race, maximum_pressure};
    use crate::materials::{BEARING_STEEL, Material, contact_modulus};
    use number::Gather;
    use proptest::prelude::*;

    /// The deep groove ball bearing 209 of Hamrock's book; inputs as `hamrock_209_film_thickness.toml` has them.
    fn bearing_209(race: Race) -> EntrainedContact {
        let curvature = BallRace {
            ball_diameter: 12.7e-3,
            pitch_diameter: 0.5 * (52.291e-3 + 77.706e-3),
            groove_curvature: 6.604 / 12.7,
            contact_angle: 0.0,
            race,
        }
        .curvature();
        let steel = Material {
            young_modulus: 200e9,
            poisson_ratio: 0.3,
            ..BEARING_STEEL
        };
        EntrainedContact::new(curvature, contact_modulus(steel, steel)).unwrap()
    }
    /// Stribeck's load of the most loaded of nine balls under 8900 N, N.
    const LOAD: f64 = 5.0 * 8900.0 / 9.0;

    #[test]
    fn film_of_the_bearing_209_by_another_route() {
        // By a script of another language from the inputs, E' = 219.780 GPa, the ellipse by arithmetic-geometric means and
        // bisection, cage at half the speed of a stationary outer race: v = 400 (d_e² - d²)/(4 d_e) = 6.25170581 m/s.
        // The printed results of the book were not at hand.
        let entrainment = 6.251_705_812_057_202;
        for (race, radius, ellipticity, speed, load, minimum, central) in [
            (
                Race::Inner,
                5.109_279_06e-3,
                9.284_968_33,
                2.226_949_13e-10,
                8.618_062_72e-4,
                5.526_600_91e-7,
                6.903_563_89e-7,
            ),
            (
                Race::Outer,
                7.590_720_94e-3,
                7.295_090_75,
                1.498_949_13e-10,
                3.904_476_80e-4,
                6.611_611_56e-7,
                8.276_684_97e-7,
            ),
        ] {
            let contact = bearing_209(race);
            let groups = contact.groups(0.04, 2.3e-8, entrainment, LOAD);
            let film = FilmThickness::new(&contact, 0.04, 2.3e-8, 1.0);
            for (ours, other) in [
                (contact.rolling_radius, radius),
                (contact.ellipticity, ellipticity),
                (groups.speed, speed),
                (groups.material, 5_054.945_05),
                (groups.load, load),
                (film.minimum(entrainment, LOAD), minimum),
                (film.central(entrainment, LOAD), central),
            ] {
                // nine printed digits
                assert!((ours / other - 1.0).abs() < 1e-8, "{ours} {other}");
            }
        }
        let thickness = 5.526_600_91e-7;
        assert!((lambda_ratio(thickness, 0.0625e-6, 0.0175e-6) - 8.515_07).abs() < 1e-4);
    }
    #[test]
    fn the_effective_modulus_is_twice_the_contact_modulus() {
        // 200 GPa/(1 - 0.09) for equal bodies
        assert!(
            (bearing_209(Race::Inner).effective_modulus() / (200e9 / 0.91) - 1.0).abs() < 1e-14
        );
    }
    #[test]
    fn a_contact_long_along_the_rolling_direction_is_refused() {
        let curvature = Curvature {
            axial: 400.0,
            rolling: 100.0,
        };
        assert!(EntrainedContact::new(curvature, 1e11).is_err());
    }
    #[test]
    fn heating_vanishes_when_slow_and_stays_positive_when_fast() {
        let heating = InletHeating::new(0.08, 0.05, 0.13, 2e8, 2.2e11);
        assert!((heating.factor(0.0, 1e-4, 50.0) - 1.0).abs() < 1e-3);
        let fast = heating.factor(0.0, 1e3, 50.0);
        assert!(fast > 0.0 && fast < 0.01);
        // more slip, more heat, up to slide-to-roll 2
        let shares = [0.0, 1.0, 10.0, 20.0, 40.0].map(|slip| heating.factor(slip, 10.0, 50.0));
        assert!(shares.windows(2).take(3).all(|pair| pair[1] < pair[0]));
        assert!((shares[4] / shares[3] - 1.0).abs() < 1e-12);
    }
    #[test]
    fn the_factor_of_inlet_heating_by_hand() {
        // L = 0.08·0.05·3²/0.12 = 0.3, Q = 8 N: p_max = 4e8, p_max/E' = 0.002, S = 0.5. In another language:
        // (1 - 13.2·0.002·0.3^0.42)/(1 + 0.213 (1 + 2.23·0.5^0.83)·0.3^0.64) = 0.805159…
        let heating = InletHeating::new(0.08, 0.05, 0.12, 2e8, 2e11);
        let pressure = maximum_pressure(2e8, 8.0) / 2e11;
        assert!((pressure / 0.002 - 1.0).abs() < 1e-12);
        let ours = heating.factor(-1.5, 3.0, 8.0);
        assert!((ours - 0.8051587061015041).abs() < 1e-12, "{ours}");
    }

    proptest! {
        #[test]
        fn a_film_over_its_radius_knows_no_units(length in -3.0..3.0_f64, force in -3.0..3.0_f64, time in -3.0..3.0_f64) {
            let [length, force, time] = [length, force, time].map(f64::exp);
            let pressure = force / (length * length);
            let contact = bearing_209(Race::Outer);
            let scaled = EntrainedContact {
                rolling_radius: contact.rolling_radius * length,
                ellipticity: contact.ellipticity,
                contact_modulus: contact.contact_modulus * pressure,
            };
            let film = FilmThickness::new(&contact, 0.04, 2.3e-8, 0.7);
            let other = FilmThickness::new(&scaled, 0.04 * pressure * time, 2.3e-8 / pressure, 0.7);
            let (v, q) = (3.0, 200.0);
            let ratio = other.central(v * length / time, q * force) / film.central(v, q) / length;
            prop_assert!((ratio - 1.0).abs() < 1e-12);
            let ratio = other.minimum(v * length / time, q * force) / film.minimum(v, q) / length;
            prop_assert!((ratio - 1.0).abs() < 1e-12);
        }
        #[test]
        fn the_loop_agrees_with_the_formula(v in -9.0..3.0_f64, q in -6.0..5.0_f64, supply in 0.1..1.0_f64) {
            let (v, q) = (10_f64.powf(v), 10_f64.powf(q));
            let contact = bearing_209(Race::Inner);
            let film = FilmThickness::new(&contact, 0.04, 2.3e-8, supply);
            let groups = contact.groups(0.04, 2.3e-8, v, q);
            let scale = contact.rolling_radius * supply;
            let central = scale * central_film(groups, contact.ellipticity);
            let minimum = scale * minimum_film(groups, contact.ellipticity);
            // logarithms up to 50: 50 rounding errors
            prop_assert!((film.central(-v, q) / central - 1.0).abs() < 1e-13);
            prop_assert!((film.minimum(v, q) / minimum - 1.0).abs() < 1e-13);
            prop_assert!(minimum < central);
        }
    }
    #[test]
    fn standstill_and_no_load_stay_finite() {
        let film = FilmThickness::new(&bearing_209(Race::Inner), 0.04, 2.3e-8, 1.0);
        let wide: FilmThickness<number::Dual<1>> = Gather::gather(&|_| &film);
        for (v, q) in [(0.0, 100.0), (1.0, 0.0), (0.0, 0.0), (0.0, -1.0)] {
            let dual = wide.central(number::Dual::variable(v, 0), number::Dual::splat(q));
            assert!(
                film.central(v, q) > 0.0 && dual.value.is_finite() && dual.partial[0].is_finite()
            );
        }
        assert!(film.central(0.0, 100.0) < 1e-11);
    }
}
