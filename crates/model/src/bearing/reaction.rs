//! What a bearing does to its two bodies: forces, heat by kind, what it stores.

use crate::motion::Wrench;
use number::Real;

/// Values a ball in a bearing's detail.
pub const DETAIL_PER_BALL: usize = 7;

/// Kinds of heat made in a bearing, in the order of [`BearingHeat::kinds`]: names as in results.
pub const HEATS: [&str; 13] = [
    "inner_contact_damping",
    "outer_contact_damping",
    "inner_ball_slip",
    "outer_ball_slip",
    "drag",
    "pocket_damping",
    "pocket_friction",
    "steady_moment",
    "cage_land_damping",
    "cage_land_friction",
    "ball_ball_damping",
    "ball_ball_friction",
    "inlet_rolling",
];

/// Index of the heat in the pockets among [`HEATS`]: the loss of accelerated balls belongs to it as well.
pub const POCKET_FRICTION: usize = 6;

/// Heat made in a bearing by kind, W; all are never negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingHeat<R> {
    /// Contact damping at the inner race; in the rolling fidelity at both races.
    pub inner_damping: R,
    /// Contact damping at the outer race.
    pub outer_damping: R,
    /// Balls sliding on the inner race.
    pub inner_sliding: R,
    /// Balls sliding on the outer race.
    pub outer_sliding: R,
    /// Drag on balls and cage.
    pub drag: R,
    /// Contact damping in the pockets.
    pub pocket_damping: R,
    /// Balls sliding in the pockets; in the rolling fidelity what F0 takes.
    pub pocket_sliding: R,
    /// The steady friction moment.
    pub steady_moment: R,
    /// Contact damping between cage and land.
    pub land_damping: R,
    /// Cage sliding on its land.
    pub land_sliding: R,
    /// Contact damping between neighbouring balls.
    pub neighbour_damping: R,
    /// Neighbouring balls sliding on each other.
    pub neighbour_sliding: R,
    /// Oil that is squeezed in the inlets of rolling contacts.
    pub inlet_rolling: R,
}

impl<R: Real> BearingHeat<R> {
    /// No heat.
    #[inline(always)]
    pub fn zero() -> Self {
        let zero = R::zero();
        BearingHeat {
            inner_damping: zero,
            outer_damping: zero,
            inner_sliding: zero,
            outer_sliding: zero,
            drag: zero,
            pocket_damping: zero,
            pocket_sliding: zero,
            steady_moment: zero,
            land_damping: zero,
            land_sliding: zero,
            neighbour_damping: zero,
            neighbour_sliding: zero,
            inlet_rolling: zero,
        }
    }
    /// The heats in the order of [`HEATS`].
    #[inline(always)]
    pub fn kinds(&self) -> [R; HEATS.len()] {
        [
            self.inner_damping,
            self.outer_damping,
            self.inner_sliding,
            self.outer_sliding,
            self.drag,
            self.pocket_damping,
            self.pocket_sliding,
            self.steady_moment,
            self.land_damping,
            self.land_sliding,
            self.neighbour_damping,
            self.neighbour_sliding,
            self.inlet_rolling,
        ]
    }
}

/// What a bearing does to its two bodies.
///
/// The moment on the inner race is `on_inner.moment - (inner_inertia + j) Ω̇`: the part that is proportional to the race's
/// acceleration moves to the left side of its equation. The outer race receives `on_outer.moment - (outer_inertia - j) Ω̇`.
/// j is `loss_inertia`, negative while the race is braked: see [`BearingReaction::with_loss`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingReaction<R> {
    /// On the inner race, moment about its centre.
    pub on_inner: Wrench<R>,
    /// On the outer race, moment about its centre.
    pub on_outer: Wrench<R>,
    /// Inertia that the balls and cage add to the inner race, kg m².
    pub inner_inertia: R,
    /// Moment on the outer race per acceleration of the inner race, reversed, kg m².
    pub outer_inertia: R,
    /// Size of the inertia j with which the acceleration loss F1|Ω̇| acts, kg m².
    pub loss_inertia: R,
    /// The steady moment of the law at this speed, load and state of the lubricant, N m.
    pub steady_moment: R,
    /// Power with which a growing inner race presses its balls, over the race's acceleration, N m s: 2kΩ ΣQ_el, from
    /// Ṙ = 2kΩΩ̇. It comes from outside the model, which knows no elastic race.
    pub growth_impulse: R,
    /// Moment about the origin that balls and cage receive from outside: weight and drag to ground, N m.
    pub external_moment: R,
    /// Heat by kind.
    pub heat: BearingHeat<R>,
    /// Largest ball load at the inner race, N.
    pub largest_inner_load: R,
    /// Largest ball load at the outer race, N.
    pub largest_outer_load: R,
    /// Largest u²Q of a ball at the inner and at the outer race, (m/s)² N: its root goes with the flash of a skid.
    pub largest_skids: [R; 2],
    /// Largest force between a ball and its pocket, or between two balls without a cage, N.
    pub largest_pocket_force: R,
    /// Force between cage and land, N.
    pub land_force: R,
}

impl<R: Real> BearingReaction<R> {
    /// No reaction.
    pub fn zero() -> Self {
        let zero = R::zero();
        BearingReaction {
            on_inner: Wrench::zero(),
            on_outer: Wrench::zero(),
            inner_inertia: zero,
            outer_inertia: zero,
            loss_inertia: zero,
            steady_moment: zero,
            growth_impulse: zero,
            external_moment: zero,
            heat: BearingHeat::zero(),
            largest_inner_load: zero,
            largest_outer_load: zero,
            largest_skids: [zero; 2],
            largest_pocket_force: zero,
            land_force: zero,
        }
    }
    /// The reaction with its acceleration loss F1|Ω̇| as an inertia like the others.
    ///
    /// - `speed`: of the inner race against the outer, rad/s
    /// - `acceleration`: anything with the sign of Ω̇, as the moment on the race without its inertial part
    ///
    /// F has the sign of Ω, so its moment is arm F1 |Ω̇| sgn Ω = j Ω̇ with j = +arm F1 while the race is sped up and
    /// -arm F1 while it is braked. (I + J_I + j) Ω̇ = A has one solution, with the sign of A, as long as
    /// arm F1 < I + J_I: then the sign of A gives j, and there is no loop. From rest any motion speeds up.
    #[inline(always)]
    #[must_use]
    pub fn with_loss(mut self, speed: R, acceleration: R) -> Self {
        let braked = (speed * acceleration).less(R::zero());
        let j = R::select(braked, -self.loss_inertia, self.loss_inertia);
        self.inner_inertia += j;
        self.outer_inertia -= j;
        self.loss_inertia = j;
        self
    }
    /// Heat that F1|Ω̇| makes in the pockets at an acceleration, W; of a reaction [`with_loss`](Self::with_loss).
    #[inline(always)]
    pub fn loss_heat(&self, speed: R, acceleration: R) -> R {
        self.loss_inertia * acceleration * speed
    }
}

/// Energies and angular momentum inside a bearing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BearingEnergy {
    /// Kinetic energy of the centres of the balls, J.
    pub translation: f64,
    /// Kinetic energy of the spins of balls and cage, J.
    pub spin: f64,
    /// Energy in contacts and pockets, J.
    pub elastic: f64,
    /// Potential of the weight, J.
    pub weight: f64,
    /// Angular momentum of balls and cage about the origin, N m s.
    pub angular_momentum: f64,
}

impl BearingEnergy {
    /// Kinetic and potential energy, J.
    pub fn sum(&self) -> f64 {
        self.translation + self.spin + self.elastic + self.weight
    }
}
