//! Thickness of the lubricant film between ball and race, in the four regimes of elliptical contacts.
//!
//! ```text
//!      surfaces drag oil into the inlet          h_c  central thickness: the flat middle
//!    ────────╮                  ╭────────        h_min  at the two side lobes
//!   oil →    ╰──────────────────╯   →
//!            film h_c, pressure nearly Hertz's
//!
//!   U = η v/(E' R_x),  G = α E',  W = Q/(E' R_x²),  k = a/b,  α_r = R_y/R_x
//!   rigid, isoviscous      H_IR = 128 α_r λ_b² [0.131 atan(α_r/2) + 1.683]² (U/W)²,   λ_b = 1/(1 + 2/(3 α_r))
//!   rigid, piezoviscous    H_VR = 141 G^0.375 U^1.25 W^-0.875 (1 - e^(-0.0387 α_r))
//!   elastic, isoviscous    H_IE = 7.32 U^0.64 W^-0.22 (1 - 0.72 e^(-0.28 k))        minimum 7.43 U^0.65 W^-0.21 (1 - 0.85 e^(-0.31 k))
//!   elastic, piezoviscous  H_VE = 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k))
//!                                                                minimum 3.63 U^0.68 G^0.49 W^-0.073 (1 - e^(-0.68 k))
//!   h = φ_s φ_T R_x max(H_r, H_VR, H_IE, H_VE),   H_r = H_IR/(1 + H_IR),   at most φ_s R_x
//! ```
//! v is the entrainment speed, the *mean* of the two surface speeds seen from the contact; R_x the radius of the
//! equivalent ball along the rolling direction, R_y across it; k the long axis of the ellipse (across the groove) over the
//! short one; φ_s ≤ 1 what starvation leaves, an input; φ_T ≤ 1 what heating in the inlet leaves, [`InletHeating`].
//!
//! - **Light and fast contacts are rigid**: their film is many times thicker than Hamrock and Dowson's, and falls with Q².
//! - **The thickest counts**, as in the charts of regimes. Own solutions of Reynolds' equation between rigid bodies for Barus's
//!   oil, from constant viscosity to where it has no solution any more (α_r = 42), are 6 % below to 10 % above the thicker of
//!   H_IR and H_VR. Where two films meet the true one is somewhat thicker than both. The older H_VR = 1.66 (G U)^(2/3) does not
//!   fall with load: it is the bound at which rigid bodies carry any load, and above H_VE, 1.1 to 1.6 times, for all loaded bearings.
//! - **The meeting is a kink**, not a jump: the thickness is continuous in load and speed, and so is traction.
//! - **No load.** Where H_IR would pass 1 the ball is no longer near its race: R_x is the limit.
//!
//! Two moduli are in use. Here E' = 2/[(1 - ν₁²)/E₁ + (1 - ν₂²)/E₂], as Hamrock has it: **twice** the contact modulus
//! E* of [`contact_modulus`](crate::materials::contact_modulus).
//!
//! In the time loop all but H_r is one exponential of the largest of lines in two logarithms: everything constant is in
//! one number each.
//!
//! Assumed: steady, fully flooded up to φ_s, smooth surfaces, Newtonian inlet. Not modelled: squeeze in an impact (the
//! film follows load and speed at once), the time a film needs to be carried through the contact, grease thickener, the
//! shoulders of the groove: a rigid film of a tenth of the gap R_x²/(2 R_y) that opens towards them is 0.6, one as thick as
//! that gap 0.2 of this one (own solution of Reynolds' equation).

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
    /// α_r = R_y/R_x: radius of the equivalent ball across over that along the rolling direction.
    pub radius_ratio: f64,
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
    /// Formula: R_x = 1/ρ_b, R_y = 1/ρ_a, k = a/b of [`PointContact`]
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
            radius_ratio: curvature.rolling / curvature.axial,
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

/// Film thickness over R_x between rigid bodies, of an oil whose viscosity does not grow with pressure; central and minimum.
///
/// Formula: H_IR = 128 α_r λ_b² [0.131 atan(α_r/2) + 1.683]² (U/W)², λ_b = 1/(1 + 2/(3 α_r))
///
/// - `groups`: U, W
/// - `radius_ratio`: α_r = R_y/R_x
///
/// Source: D. E. Brewe, B. J. Hamrock, C. M. Taylor, J. Lubr. Technol. 101 (1979) 231 (from memory).
/// Valid: fully flooded paraboloids, H up to some 0.01; held within 10 % by a solution of Reynolds' equation for α_r 1 and 42.
pub fn rigid_film(groups: FilmGroups, radius_ratio: f64) -> f64 {
    let leakage = 1.0 / (1.0 + 2.0 / (3.0 * radius_ratio));
    let shape = leakage * (0.131 * (0.5 * radius_ratio).atan() + 1.683);
    128.0 * radius_ratio * (shape * groups.speed / groups.load).powi(2)
}

/// Film thickness over R_x between rigid bodies, of oil that stiffens under pressure; central and minimum.
///
/// Formula: H_VR = 141 G^0.375 U^1.25 W^-0.875 (1 - e^(-0.0387 α_r)), which is Ĥ = 141 g_V^0.375 (1 - e^(-0.0387 α_r)) with
/// Ĥ = H (W/U)² and g_V = G W³/U²
///
/// - `groups`: U, G, W
/// - `radius_ratio`: α_r = R_y/R_x
///
/// Source: H. Y. Jeng, B. J. Hamrock, D. E. Brewe, ASLE Trans. 30 (1987) 452; in this form M. Esfahanian, B. J. Hamrock, Tribol.
/// Trans. 34 (1991) 628 (both from memory).
/// Valid: held within 10 % by a solution of Reynolds' equation for α_r 42 and Barus's oil; half of it for a circle.
pub fn piezoviscous_rigid_film(groups: FilmGroups, radius_ratio: f64) -> f64 {
    141.0
        * groups.material.powf(0.375)
        * groups.speed.powf(1.25)
        * groups.load.powf(-0.875)
        * (1.0 - (-0.0387 * radius_ratio).exp())
}

/// Central film thickness over R_x of elastic bodies and an oil whose viscosity does not grow with pressure.
///
/// Formula: H_IE = 7.32 U^0.64 W^-0.22 (1 - 0.72 e^(-0.28 k))
///
/// - `groups`: U, W
/// - `ellipticity`: k
///
/// Source: B. J. Hamrock, D. Dowson, J. Lubr. Technol. 100 (1978) 236 (from memory).
/// Valid: fully flooded soft bodies; of steel and oil it is the thickest of slow, nearly unloaded contacts alone (1 mm/s, 0.01 N).
pub fn soft_central_film(groups: FilmGroups, ellipticity: f64) -> f64 {
    7.32 * groups.speed.powf(0.64)
        * groups.load.powf(-0.22)
        * (1.0 - 0.72 * (-0.28 * ellipticity).exp())
}

/// Minimum film thickness over R_x of elastic bodies and an oil whose viscosity does not grow with pressure.
///
/// Formula: H_IE = 7.43 U^0.65 W^-0.21 (1 - 0.85 e^(-0.31 k))
///
/// - `groups`: U, W
/// - `ellipticity`: k
///
/// Source: as [`soft_central_film`].
/// Valid: as there; the chart of regimes has Ĥ = 8.70 g_E^0.67 in the same factor of k, g_E = W^(8/3)/U²: within 10 %.
pub fn soft_minimum_film(groups: FilmGroups, ellipticity: f64) -> f64 {
    7.43 * groups.speed.powf(0.65)
        * groups.load.powf(-0.21)
        * (1.0 - 0.85 * (-0.31 * ellipticity).exp())
}

/// Central film thickness over R_x of elastic bodies and oil that stiffens under pressure.
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

/// Minimum film thickness over R_x of elastic bodies and oil that stiffens under pressure.
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
/// - `thickness`: h, m: the minimum for the λ of the bearing trade (T. E. Tallian, ISO/TR 1281-2, makers); the central one for the
///   share of asperities
/// - `first_roughness`, `second_roughness`: root mean square heights of the two surfaces, m
///
/// Source: definition.
/// Valid: at least one surface is rough; infinite where both are smooth.
pub fn lambda_ratio(thickness: f64, first_roughness: f64, second_roughness: f64) -> f64 {
    thickness / first_roughness.hypot(second_roughness)
}

/// What sets the thickness of a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmRegime {
    /// Neither yields: light and fast contacts.
    IsoviscousRigid,
    /// The oil stiffens, the bodies do not yield.
    PiezoviscousRigid,
    /// The bodies yield, the oil does not stiffen: soft bodies.
    IsoviscousElastic,
    /// Both: loaded rolling bearings.
    PiezoviscousElastic,
}

impl FilmRegime {
    /// All four.
    pub const ALL: [FilmRegime; 4] = [
        FilmRegime::IsoviscousRigid,
        FilmRegime::PiezoviscousRigid,
        FilmRegime::IsoviscousElastic,
        FilmRegime::PiezoviscousElastic,
    ];
    /// The field's word for it.
    ///
    /// Source: the names of the regimes in Hamrock and Dowson's charts.
    /// Valid: always.
    pub fn name(self) -> &'static str {
        match self {
            FilmRegime::IsoviscousRigid => "isoviscous-rigid",
            FilmRegime::PiezoviscousRigid => "piezoviscous-rigid",
            FilmRegime::IsoviscousElastic => "isoviscous-elastic",
            FilmRegime::PiezoviscousElastic => "piezoviscous-elastic",
        }
    }
}

constants! {
    /// Film thickness of one contact and one oil in the time loop, before heating of the inlet.
    pub struct FilmThickness {
        /// h_IR at 1 m/s and 1 N, m.
        rigid: R,
        /// The same over φ_s R_x.
        rigid_share: R,
        /// ln of h_VR in m at 1 m/s and 1 N.
        stiff_logarithm: R,
        /// ln of the central h_IE in m at 1 m/s and 1 N.
        soft_central_logarithm: R,
        /// ln of the minimum h_IE in m at 1 m/s and 1 N.
        soft_minimum_logarithm: R,
        /// ln of the central h_VE in m at 1 m/s and 1 N.
        central_logarithm: R,
        /// ln of the minimum h_VE in m at 1 m/s and 1 N.
        minimum_logarithm: R,
        /// ln of φ_s R_x in m: the limit without load.
        largest_logarithm: R,
    }
}

impl FilmThickness<f64> {
    /// Constants of a contact.
    ///
    /// Formula: the page's times R_x φ_s, at v = 1 m/s and Q = 1 N
    ///
    /// - `contact`: geometry and elasticity
    /// - `viscosity`: η at the temperature of the inlet and ambient pressure, Pa s
    /// - `pressure_coefficient`: α, 1/Pa
    /// - `supply`: φ_s, share of the flooded thickness that starvation leaves, above 0 up to 1
    ///
    /// Source: as the functions of the four regimes.
    /// Valid: positive arguments.
    pub fn new(
        contact: &EntrainedContact,
        viscosity: f64,
        pressure_coefficient: f64,
        supply: f64,
    ) -> Self {
        let unit = contact.groups(viscosity, pressure_coefficient, 1.0, 1.0);
        let k = contact.ellipticity;
        let rigid = rigid_film(unit, contact.radius_ratio);
        let scale = contact.rolling_radius * supply;
        let logarithm = |film: f64| (scale * film).ln();
        FilmThickness {
            rigid: scale * rigid,
            rigid_share: rigid,
            stiff_logarithm: logarithm(piezoviscous_rigid_film(unit, contact.radius_ratio)),
            soft_central_logarithm: logarithm(soft_central_film(unit, k)),
            soft_minimum_logarithm: logarithm(soft_minimum_film(unit, k)),
            central_logarithm: logarithm(central_film(unit, k)),
            minimum_logarithm: logarithm(minimum_film(unit, k)),
            largest_logarithm: scale.ln(),
        }
    }

    /// The regime of a contact: whose central thickness is the largest.
    ///
    /// - `entrainment`: v, m/s; its sign has no effect
    /// - `load`: Q, N
    ///
    /// Source: as [`FilmThickness::central`].
    /// Valid: as there.
    pub fn regime(&self, entrainment: f64, load: f64) -> FilmRegime {
        let (speed, force) = logarithms(entrainment, load);
        let thickest = self.yielding(speed, force);
        if self.rigid_of(entrainment, load) >= thickest.exp() {
            FilmRegime::IsoviscousRigid
        } else if thickest > self.hard(speed, force).max(self.soft(speed, force)) {
            FilmRegime::PiezoviscousRigid
        } else if thickest > self.hard(speed, force) {
            FilmRegime::IsoviscousElastic
        } else {
            FilmRegime::PiezoviscousElastic
        }
    }
}

impl<R: Real> FilmThickness<R> {
    /// Central thickness, m.
    ///
    /// Formula: h_c = min(max(h_r, h_VR, h_IE, h_VE), φ_s R_x), h_r = h_IR/(1 + h_IR/(φ_s R_x))
    ///
    /// - `entrainment`: v, m/s; its sign has no effect
    /// - `load`: Q, N
    ///
    /// Source: [`rigid_film`], [`piezoviscous_rigid_film`], [`soft_central_film`], [`central_film`].
    /// Valid: as there; finite for every argument (speeds and loads below 1e-9 count as 1e-9).
    #[inline(always)]
    pub fn central(&self, entrainment: R, load: R) -> R {
        let (speed, force) = logarithms(entrainment, load);
        (self.yielding(speed, force).exp()).max(self.rigid_of(entrainment, load))
    }

    /// Minimum thickness, m.
    ///
    /// Formula: as [`FilmThickness::central`], of the minimum films; a rigid contact is thinnest in its middle
    ///
    /// - `entrainment`: v, m/s; its sign has no effect
    /// - `load`: Q, N
    ///
    /// Source: [`soft_minimum_film`], [`minimum_film`].
    /// Valid: as [`FilmThickness::central`].
    #[inline(always)]
    pub fn minimum(&self, entrainment: R, load: R) -> R {
        let (speed, force) = logarithms(entrainment, load);
        let hard = self.minimum_logarithm + R::splat(0.68) * speed - R::splat(0.073) * force;
        let soft = self.soft_minimum_logarithm + R::splat(0.65) * speed - R::splat(0.21) * force;
        let yielding = self.largest_of(speed, force, hard.max(soft)).exp();
        yielding.max(self.rigid_of(entrainment, load))
    }

    /// h_r, m.
    #[inline(always)]
    pub(crate) fn rigid_of(&self, entrainment: R, load: R) -> R {
        let speed = entrainment.abs().max(R::splat(SLOWEST)).square();
        let force = load.max(R::splat(LIGHTEST)).square();
        self.rigid * speed / (force + self.rigid_share * speed)
    }

    /// ln of the largest central thickness but h_r, from ln |v| and ln Q.
    #[inline(always)]
    pub(crate) fn yielding(&self, speed: R, force: R) -> R {
        let elastic = self.hard(speed, force).max(self.soft(speed, force));
        self.largest_of(speed, force, elastic)
    }

    /// ln of the larger one of h_VR and an elastic thickness, at most that without load.
    #[inline(always)]
    fn largest_of(&self, speed: R, force: R, elastic: R) -> R {
        let stiff = self.stiff_logarithm + R::splat(1.25) * speed - R::splat(0.875) * force;
        stiff.max(elastic).min(self.largest_logarithm)
    }

    /// ln of the central h_VE.
    #[inline(always)]
    fn hard(&self, speed: R, force: R) -> R {
        self.central_logarithm + R::splat(0.67) * speed - R::splat(0.067) * force
    }

    /// ln of the central h_IE.
    #[inline(always)]
    fn soft(&self, speed: R, force: R) -> R {
        self.soft_central_logarithm + R::splat(0.64) * speed - R::splat(0.22) * force
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
mod tests;
