//! The explanations that are compared.

/// An explanation of a torque transient. Each is a claim of its own: one without a noticeable effect
/// (`LEAST_EFFECT`) is not that explanation but rolling.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Explanation {
    /// Balls roll, the lubricant is as in the coast-down.
    Rolling,
    /// Balls roll; the grease builds up over cage angle and breaks down over time.
    Grease,
    /// A limited traction does not bring balls and cage to rolling speed.
    IsothermalSlip,
    /// Slip, with a traction that falls as the contact films heat.
    HeatedSlip,
    /// Balls roll; the reading drifts, creeps, or settles more slowly than stated.
    Sensor,
    /// Balls roll; the steady moment of the slow tests is not that of these tests.
    AnotherMoment,
    /// Balls roll; the oil warms, and the viscous part falls with its viscosity.
    WarmOil,
}

impl Explanation {
    /// All explanations, in the order of the prior odds.
    pub const ALL: [Self; 7] = [
        Self::Rolling,
        Self::Grease,
        Self::IsothermalSlip,
        Self::HeatedSlip,
        Self::Sensor,
        Self::AnotherMoment,
        Self::WarmOil,
    ];

    /// Name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rolling => "rolling",
            Self::Grease => "rolling with a grease state",
            Self::IsothermalSlip => "isothermal slip",
            Self::HeatedSlip => "slip with heating",
            Self::Sensor => "sensor artefact",
            Self::WarmOil => "rolling in oil that warms",
            Self::AnotherMoment => "another steady moment",
        }
    }
}
