//! Traction of a ball on its race from the lubricant between them.
//!
//! ```text
//!   slip u ──► shear rate u/h_c ──► Eyring stress at the mean Hertz pressure ──► at most Λ p̄
//!                  ▲                          ▲      │
//!   entrainment v ─┘ film h_c(v, Q, u)        └──────┘ heat τu warms film and surfaces, the oil thins
//!
//!   σ:    τ = τ_E C(S),  C = S/[1 + (S τ_E/τ_L)⁴]^¼,  sinh S = η(p̄, T + ΔT) u/(h_c τ_E),  ΔT = τ u r
//!   oil:  τ_L = Λ p̄,  τ_E = 2 Λ (A + B p_max),  r = h_c/(8 k) + 1.064 √b/[(e₁ + e₂) √(w + w₀)]
//!   both: ξ = e^(-B_ξ Λ_c^C_ξ),  Λ_c = h_c/σ_q,  μ_r = (1 - ξ) μ_f + ξ μ_b tanh(u/u_b)
//!         μ_f = (τ/p̄)/√(1 + (τ u_b/(p̄ Λ u))²)
//!   μ = μ_r/√(1 + (μ_r/μ_e)²),  μ_e = (π/4) (E*/p̄) u/v
//! ```
//!
//! - **Film.** One mean stress over the area A that carries the load, p̄ = Q/A; its force is τ A = (τ/p̄) Q.
//! - **Area.** A = π a b + A_r: the Hertz ellipse and what rigid bodies shear, A_r = h_r ∫θ dA/h = 3π √(R_x R_y) h_r
//!   arsinh(1/s), s = √(h_r/h_g). Between paraboloids ∫dx/h = π √(2 R_x/h(y)) along the
//!   rolling direction, of which the outlet, whose oil is torn into streamers of share θ, leaves 3/4; across, the integral
//!   of 1/√h(y) ends at the shoulders of the groove, taken R_x from its middle, where the gap has opened by
//!   h_g = R_x²/(2 R_y). Own solutions of Reynolds' equation agree within 2 %, and their pressure has 0.9 to 1.3 times this
//!   area. As h_r falls with Q², loaded contacts are Hertz's.
//! - **Smooth limit.** C is Eyring's stress below and the limiting stress above, 16 % low where both are equal.
//! - **Heat.** Mean temperature of the film over that of the inlet: conduction to the walls, τ u h/(8k) (sheared in the
//!   middle, or the peak of an even shear), and flash of the surfaces: e = √(k ρ c) of each body, b half the contact along
//!   rolling, w² = v² + u²/4. The slow limit, a heated disc at rest, enters by w₀ = 1.571 [(k₁ + k₂)/(e₁ + e₂)]²/a (squares of
//!   conductances added). Because heat grows with u and stress only with ln u, traction has a peak and falls beyond it.
//! - **The equation for S is implicit.** g(S) = S - arsinh(X e^f) grows and is concave (f falls with the heat and is convex), so
//!   a step of Newton's from anywhere ends on the near side of the root: the stress is never too large. Two steps from a closed
//!   start leave it at most 1.3 % low, for slips up to 100 m/s and films up to 200 K warmer.
//! - **Asperities.** ξ is the share of the load that they carry, Zhou and Hoeprich's relation; boundary friction on that share.
//!   No film, h → 0: ξ = 1, boundary friction alone.
//! - **Creep of the bodies.** In rolling the elastic bodies take up slip before any film shears: Carter's slope
//!   (π/4) E* u/v of the mean stress. Without it the initial slope is that of oil stiffened ten thousand times, and no traction
//!   machine measures that.
//! - **Rest.** u_b regularises the sign of both frictions: μ_b tanh(u/u_b), and the film's slope is at most Λ/u_b. Where the
//!   film is thin and rolling slow, its own slope is up to 10⁶ s/m: sticking, which no law over slip can hold.
//!
//! Even in every argument but the slip, odd in the slip, zero at zero slip, so passive. Finite for no load, no entrainment, no
//! slip; the coefficient is at most Λ (1 - ξ) + μ_b ξ.
//!
//! Not modelled: differential (Heathcote) slip in the conforming groove, spin of the ball about the normal, pressure and stress
//! over the ellipse, elastic shear and squeeze of the film,
//! heat of the asperities, heating of the bodies themselves (the inlet temperature is an input).

use crate::film::{EntrainedContact, FilmThickness, InletHeating, SLOWEST, logarithms};
use crate::hertz::PointContact;
use crate::inlet_rolling::{InletResistance, InletRolling};
use crate::lubricant::{HIGHEST_PRESSURE, LubricantError, LubricantState};
use crate::materials::BEARING_STEEL_SPECIFIC_HEAT;
use number::{Real, constants};
use std::f64::consts::PI;

/// Slip that stands for none, m/s: divisions by it stay finite, and the slope at rest comes out.
const STANDSTILL: f64 = 1e-30;

/// Steps of Newton's method for the heated stress.
const STEPS: usize = 2;

/// How the surfaces of a body take up heat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceHeat {
    /// Thermal conductivity k, W/(m K).
    pub conductivity: f64,
    /// Density times specific heat ρ c, J/(m³ K).
    pub volumetric_heat: f64,
}

/// Bearing steel: 45 W/(m K), 7800 kg/m³ · 460 J/(kg K).
///
/// Source: SNFA precision bearing catalogue, p. 109 (40 to 50 W/(m K)); specific heat from memory.
pub const STEEL_SURFACE: SurfaceHeat = SurfaceHeat {
    conductivity: 45.0,
    volumetric_heat: 7800.0 * BEARING_STEEL_SPECIFIC_HEAT,
};

/// Silicon nitride: 35 W/(m K), 3190 kg/m³ · 700 J/(kg K).
///
/// Source: SNFA precision bearing catalogue, p. 109 (30 to 40 W/(m K)); specific heat from memory.
pub const SILICON_NITRIDE_SURFACE: SurfaceHeat = SurfaceHeat {
    conductivity: 35.0,
    volumetric_heat: 3190.0 * 700.0,
};

impl SurfaceHeat {
    /// e = √(k ρ c), W √s/(m² K).
    fn effusivity(&self) -> f64 {
        (self.conductivity * self.volumetric_heat).sqrt()
    }
}

/// What happens where asperities touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asperities {
    /// σ_q = √(Rq₁² + Rq₂²), m.
    pub roughness: f64,
    /// B_ξ of the load share.
    pub share_factor: f64,
    /// C_ξ of the load share.
    pub share_exponent: f64,
    /// μ_b: coefficient of boundary friction.
    pub friction: f64,
    /// u_b: slip at which boundary friction reaches 76 % and the film at most 71 % of its limit, m/s.
    pub reference_speed: f64,
}

impl Asperities {
    /// Asperities of a raceway with given roughness.
    ///
    /// Formula: B_ξ = 2.1, C_ξ = 0.85, μ_b = 0.12
    ///
    /// - `roughness`: σ_q, m
    /// - `reference_speed`: u_b, m/s: a regularisation, not a measurement; 0.001 m/s leaves the film and the creep of bodies
    ///   that roll at 1 m/s and more to themselves
    ///
    /// Source: share: P. Wingertszahn et al., Lubricants 11 (2023) 369, table A2 (σ_q 0.1 µm; table 4 has 2.32, 0.97 at 0.16 µm);
    /// friction: measured 0.12 to 0.135 by Masjedi and Khonsari, quoted by A. Arana et al. 2019.
    /// Valid: ground raceways of rolling bearings.
    pub fn raceway(roughness: f64, reference_speed: f64) -> Self {
        Asperities {
            roughness,
            share_factor: 2.1,
            share_exponent: 0.85,
            friction: 0.12,
            reference_speed,
        }
    }
}

/// Everything a traction law of one contact is built from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LubricatedContact {
    /// Geometry and elasticity of the film.
    pub entrained: EntrainedContact,
    /// Its Hertz contact.
    pub hertz: PointContact,
    /// The lubricant in the inlet.
    pub lubricant: LubricantState,
    /// φ_s: share of the flooded film that starvation leaves, above 0 up to 1.
    pub supply: f64,
    /// The two surfaces.
    pub surfaces: [SurfaceHeat; 2],
    /// Their asperities.
    pub asperities: Asperities,
}

constants! {
    /// The traction law of one contact in the time loop.
    pub struct LubricantTraction {
        /// Film thickness.
        film: FilmThickness<R>,
        /// Heating in the inlet.
        inlet: InletHeating<R>,
        /// η of the inlet at ambient pressure, Pa s.
        viscosity: R,
        /// C of the modulus equation, K.
        temperature_constant: R,
        /// D + T of the inlet, K.
        temperature_above: R,
        /// A at the inlet temperature, Pa.
        modulus: R,
        /// a₂, Pa/K.
        modulus_slope: R,
        /// B at the inlet temperature.
        stiffening: R,
        /// b₂, 1/K.
        stiffening_slope: R,
        /// Λ of the limiting stress.
        limiting: R,
        /// p̄ of Hertz's ellipse at 1 N, Pa.
        mean_pressure: R,
        /// 3π √(R_x R_y), m.
        rigid_width: R,
        /// h_g = R_x²/(2 R_y), m.
        groove_gap: R,
        /// 1/(8k) of the film, m K/W.
        conduction: R,
        /// 1.064 √b/(e₁ + e₂) at 1 N, m² K √(m/s)/W.
        flash: R,
        /// w₀ at 1 N, m/s.
        standing_speed: R,
        /// ln σ_q, σ_q in m.
        roughness_logarithm: R,
        /// B_ξ.
        share_factor: R,
        /// C_ξ.
        share_exponent: R,
        /// μ_b.
        boundary_friction: R,
        /// 1/u_b, s/m.
        inverse_reference_speed: R,
        /// u_b/Λ, m/s.
        film_reference_speed: R,
        /// 4/(π E*), 1/Pa.
        creep: R,
    }
}

/// What a contact is like under the law, for outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactState<R> {
    /// Traction coefficient μ.
    pub coefficient: R,
    /// Central film thickness h_c, m.
    pub thickness: R,
    /// Minimum film thickness h_min, m.
    pub minimum_thickness: R,
    /// λ = h_min/σ_q, as the bearing trade has it.
    pub lambda: R,
    /// ξ: share of the load on asperities.
    pub asperity_share: R,
    /// p̄, Pa.
    pub mean_pressure: R,
    /// |τ| of the film before the creep of the bodies, Pa.
    pub stress: R,
    /// ΔT of the film over the inlet, K.
    pub temperature_rise: R,
}

impl LubricatedContact {
    /// The traction law of this contact.
    ///
    /// Formula: the page's, with everything constant put together
    ///
    /// Source: that of [`LubricantTraction::state`].
    /// Valid: positive constants; else an error that names the first that is not.
    pub fn traction(&self) -> Result<LubricantTraction<f64>, LubricantError> {
        let (oil, hertz, rough) = (&self.lubricant, &self.hertz, &self.asperities);
        let [first, second] = self.surfaces;
        for (value, what) in [
            (self.supply, "supply of the film"),
            (rough.roughness, "roughness"),
            (rough.share_factor, "factor of the asperity share"),
            (rough.share_exponent, "exponent of the asperity share"),
            (
                rough.reference_speed,
                "reference speed of boundary friction",
            ),
            (first.effusivity(), "heat of the first surface"),
            (second.effusivity(), "heat of the second surface"),
            (rough.friction, "coefficient of boundary friction"),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(LubricantError::NotPositive(what));
            }
        }
        let effusivity = first.effusivity() + second.effusivity();
        let conductivity = first.conductivity + second.conductivity;
        let equation = &oil.equation;
        // the long semi-axis lies across the rolling direction
        let (across, along) = (hertz.semi_major_factor, hertz.semi_minor_factor);
        let EntrainedContact {
            rolling_radius: radius,
            radius_ratio,
            ..
        } = self.entrained;
        Ok(LubricantTraction {
            film: FilmThickness::new(
                &self.entrained,
                oil.viscosity,
                oil.film_coefficient,
                self.supply,
            ),
            inlet: self.heating(),
            viscosity: oil.viscosity,
            temperature_constant: equation.temperature_constant,
            temperature_above: equation.temperature_offset + oil.temperature,
            modulus: equation.modulus + equation.modulus_slope * oil.temperature,
            modulus_slope: equation.modulus_slope,
            stiffening: equation.stiffening + equation.stiffening_slope * oil.temperature,
            stiffening_slope: equation.stiffening_slope,
            limiting: oil.limiting_coefficient,
            mean_pressure: hertz.pressure_factor * 2.0 / 3.0,
            rigid_width: 3.0 * PI * radius * radius_ratio.sqrt(),
            groove_gap: 0.5 * radius / radius_ratio,
            conduction: 1.0 / (8.0 * oil.conductivity),
            flash: 1.064 * along.sqrt() / effusivity,
            standing_speed: 1.571 * (conductivity / effusivity).powi(2) / across,
            roughness_logarithm: rough.roughness.ln(),
            share_factor: rough.share_factor,
            share_exponent: rough.share_exponent,
            boundary_friction: rough.friction,
            inverse_reference_speed: 1.0 / rough.reference_speed,
            film_reference_speed: rough.reference_speed / oil.limiting_coefficient,
            creep: 4.0 / (PI * self.entrained.contact_modulus),
        })
    }

    /// The rolling resistance of the inlet of this contact, as starved and as heated as its film.
    ///
    /// Formula: that of [`InletResistance`], with [`InletRolling::new`] and the φ_s and φ_T of the film
    ///
    /// - `reference_speed`: rolling speed at which the couple has 71 % of its size, m/s
    ///
    /// Source: as there.
    /// Valid: as there; positive constants.
    pub fn resistance(&self, reference_speed: f64) -> InletResistance<f64> {
        InletResistance {
            rolling: InletRolling::new(
                &self.entrained,
                &self.hertz,
                self.lubricant.viscosity,
                reference_speed,
            ),
            heating: self.heating(),
            supply: self.supply,
        }
    }

    /// Heating in the inlet.
    fn heating(&self) -> InletHeating<f64> {
        let oil = &self.lubricant;
        InletHeating::new(
            oil.viscosity,
            oil.sensitivity,
            oil.conductivity,
            self.hertz.pressure_factor,
            self.entrained.effective_modulus(),
        )
    }
}

/// Film, load share and pressure of a contact at a slip.
struct Conditions<R> {
    slip: R,
    entrainment: R,
    /// φ_T.
    heating: R,
    thickness: R,
    share: R,
    pressure: R,
    /// ΔT over τ u, m² K/W.
    resistance: R,
}

impl<R: Real> LubricantTraction<R> {
    /// Traction coefficient μ: force on the ball μ Q along the slip.
    ///
    /// Formula: μ of the page
    ///
    /// - `slip`: u, race surface less ball surface, m/s
    /// - `load`: Q, N
    /// - `entrainment`: v, mean of the two surface speeds seen from the contact, m/s; its sign has no effect
    ///
    /// Source: as [`LubricantTraction::state`].
    /// Valid: as there; odd in u, finite and passive for every argument.
    #[inline(always)]
    pub fn coefficient(&self, slip: R, load: R, entrainment: R) -> R {
        self.state(slip, load, entrainment).coefficient
    }

    /// The contact at a slip, a load and an entrainment.
    ///
    /// Formula: the page's
    ///
    /// - `slip`: u, m/s
    /// - `load`: Q, N; below 1e-9 N it counts as 1e-9
    /// - `entrainment`: v, m/s; below 1e-9 m/s it counts as 1e-9
    ///
    /// Source: film friction, 2Λ/α, film and flash temperature: A. Arana, J. Larrañaga, I. Ulacia, Proc. IMechE J 233 (2019)
    /// 303, equations 7, 13, 26 to 28 after K. L. Johnson, J. L. Tevaarwerk 1977 and S. Bair, W. O. Winer 1979; share of
    /// asperities: R. S. Zhou, M. R. Hoeprich, J. Tribol. 113 (1991) 590 (ξ = e^(-B Λ_c^C)); creep: K. L. Johnson, Contact Mechanics, 1985, section 8.3 (from memory).
    /// Valid: the source reports 0.005 (read from a poor print) from traction coefficients measured on three oils at 1 GPa,
    /// 60 °C, 2 to 16 m/s, slip up to 40 %; there with min in place of C, without creep, and iterated to 1 K.
    #[inline(always)]
    pub fn state(&self, slip: R, load: R, entrainment: R) -> ContactState<R> {
        let at = self.conditions(slip, load, entrainment);
        let (stress, temperature_rise) = self.film_stress(&at);
        let boundary = self.boundary_friction * (at.slip * self.inverse_reference_speed).tanh();
        let free = stress / at.pressure;
        let resting = free * self.film_reference_speed / at.slip;
        let film = free / (R::one() + resting.square()).sqrt();
        let rough = (R::one() - at.share) * film + at.share * boundary;
        let over_creep = rough * at.pressure * at.entrainment * self.creep / at.slip;
        let magnitude = rough / (R::one() + over_creep.square()).sqrt();
        let minimum_thickness = self.film.minimum(entrainment, load) * at.heating;
        ContactState {
            coefficient: slip / at.slip * magnitude,
            thickness: at.thickness,
            minimum_thickness,
            lambda: minimum_thickness / self.roughness_logarithm.exp(),
            asperity_share: at.share,
            mean_pressure: at.pressure,
            stress,
            temperature_rise,
        }
    }

    /// Slope ∂μ/∂u at zero slip, s/m.
    ///
    /// Formula: 1/√(1/s_r² + 1/s_e²), s_r = (1 - ξ)/√((h_c p̄/η(p̄))² + (u_b/Λ)²) + ξ μ_b/u_b, s_e = (π/4) E*/(v p̄)
    ///
    /// - `load`: Q, N
    /// - `entrainment`: v, m/s
    ///
    /// Source: derivative of [`LubricantTraction::state`].
    /// Valid: as there; for loads of 1 N and more no slope at any slip is more than 1.2 times this one (tested on a grid; a rigid
    /// contact whose film the heat of slip thins is steeper), so times Q it is the friction rate that a solver has to expect.
    #[inline(always)]
    pub fn slope_at_rest(&self, load: R, entrainment: R) -> R {
        let at = self.conditions(R::zero(), load, entrainment);
        let (film, boundary) = self.initial_slopes(&at);
        let rough = (R::one() - at.share) * film + at.share * boundary;
        let over_creep = rough * at.pressure * at.entrainment * self.creep;
        rough / (R::one() + over_creep.square()).sqrt()
    }

    #[inline(always)]
    fn conditions(&self, slip: R, load: R, entrainment: R) -> Conditions<R> {
        let magnitude = slip.abs().max(R::splat(STANDSTILL));
        let (speed, force) = logarithms(entrainment, load);
        let sixth = (force * R::splat(1.0 / 6.0)).exp();
        let third = sixth.square();
        let heating = self.inlet.factor_of(magnitude, speed, third);
        let rigid = self.film.rigid_of(entrainment, load);
        let thickness = heating * (self.film.yielding(speed, force).exp()).max(rigid);
        let central_ratio = thickness.ln() - self.roughness_logarithm;
        let share = (-(self.share_factor * (self.share_exponent * central_ratio).exp())).exp();
        // A_r over Hertz's area, which is Q over its mean pressure
        let opening = self.groove_gap / (heating * rigid);
        let across = (opening.sqrt() + (opening + R::one()).sqrt()).ln();
        let rigid_area = self.rigid_width * heating * rigid * across;
        let widening = R::one() + rigid_area * self.mean_pressure / third.square();
        let rolling = entrainment.abs().max(R::splat(SLOWEST));
        let surface = (rolling.square() + R::splat(0.25) * magnitude.square()).sqrt()
            + self.standing_speed / third;
        Conditions {
            slip: magnitude,
            entrainment: rolling,
            heating,
            thickness,
            share,
            pressure: (self.mean_pressure * third / widening).min(R::splat(HIGHEST_PRESSURE / 1.5)),
            resistance: thickness * self.conduction + self.flash * sixth / surface.sqrt(),
        }
    }

    /// A + B p at the inlet temperature, Pa.
    #[inline(always)]
    fn piezo_modulus(&self, pressure: R) -> R {
        self.modulus + self.stiffening * pressure
    }

    /// Slopes of film and boundary friction over slip at rest, s/m.
    #[inline(always)]
    fn initial_slopes(&self, at: &Conditions<R>) -> (R, R) {
        let fluidity = (-(at.pressure / self.piezo_modulus(at.pressure))).exp();
        let slip = at.thickness * at.pressure * fluidity / self.viscosity;
        (
            (slip.square() + self.film_reference_speed.square())
                .sqrt()
                .recip(),
            self.boundary_friction * self.inverse_reference_speed,
        )
    }

    /// Mean shear stress of the film, Pa, and its temperature rise, K.
    #[inline(always)]
    fn film_stress(&self, at: &Conditions<R>) -> (R, R) {
        let one = R::one();
        let eyring =
            R::splat(2.0) * self.limiting * self.piezo_modulus(at.pressure * R::splat(1.5));
        let inverse_limit = eyring / (self.limiting * at.pressure);
        let modulus = self.piezo_modulus(at.pressure);
        let slope = self.modulus_slope + self.stiffening_slope * at.pressure;
        let cold =
            self.viscosity * (at.pressure / modulus).exp() * at.slip / (at.thickness * eyring);
        let heating = eyring * at.slip * at.resistance;
        let above = self.temperature_above;
        let mut strain = {
            // arsinh shifted by the heat, f as -κ S/(1 + ρ S) with its first two derivatives at 0
            let thermal = self.temperature_constant / above.square();
            let piezo = at.pressure * slope / modulus.square();
            let growth = heating * (thermal / above + piezo * slope / modulus) / (thermal + piezo);
            let isothermal = arsinh(cold);
            let shift = heating * (thermal + piezo) * cold / (one + cold.square()).sqrt();
            let middle = one + shift - growth * isothermal;
            let root = (middle.square() + R::splat(4.0) * growth * isothermal).sqrt();
            // the form of the root that does not cancel, whichever sign the middle has
            let sum = root + middle.abs();
            let falling = R::splat(2.0) * isothermal / sum;
            let rising = sum / (R::splat(2.0) * growth);
            R::select(middle.greater(R::zero()), falling, rising)
        };
        for _ in 0..STEPS {
            let ratio = strain * inverse_limit;
            let excess = (one + ratio.square().square()).recip();
            let root = excess.sqrt().sqrt();
            // C and dC/dS
            let (capped, rate) = (strain * root, root * excess);
            let rise = heating * capped;
            let (hot, soft) = (above + rise, modulus + slope * rise);
            // f and -df/dΔT of the viscosity's exponent
            let thermal = self.temperature_constant / (above * hot);
            let piezo = at.pressure * slope / (modulus * soft);
            let softening = -(thermal + piezo) * rise;
            let sensitivity = thermal * above / hot + piezo * modulus / soft;
            let shear = cold * softening.exp();
            let steepness =
                one + heating * rate * sensitivity * shear / (one + shear.square()).sqrt();
            strain = (strain + (arsinh(shear) - strain) / steepness).max(R::zero());
        }
        let ratio = strain * inverse_limit;
        let capped = strain / (one + ratio.square().square()).sqrt().sqrt();
        (eyring * capped, heating * capped)
    }
}

/// arsinh x for x ≥ 0: its series below 0.1, where the logarithm would cancel.
#[inline(always)]
fn arsinh<R: Real>(x: R) -> R {
    let square = x.min(R::splat(0.1)).square();
    // binomial series of the derivative (1 + x²)^(-1/2), integrated; the next term is 1e-16 of x at 0.1
    let mut series = R::splat(231.0 / 13312.0);
    for factor in [
        -63.0 / 2816.0,
        35.0 / 1152.0,
        -15.0 / 336.0,
        3.0 / 40.0,
        -1.0 / 6.0,
        1.0,
    ] {
        series = series * square + R::splat(factor);
    }
    let large = (x + (x.square() + R::one()).sqrt()).ln();
    R::select(x.less(R::splat(0.1)), x * series, large)
}
