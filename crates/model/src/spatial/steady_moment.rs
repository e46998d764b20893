//! The steady friction moment of a row in space: the pairs of the plane along the directions of the contacts.
//!
//! ```text
//!   v_t ball past the outer ring along t_y,  d its distance from that ring's axis;  Δ_x = (ω_ring - w)·t_x at a contact
//!   orbit drag       f   = w 2χ_o/R M0(2(1+s) v_t/d)                       on the ball -f t_y, on the outer ring +f t_y at the ball
//!   spin couple      m_s = w 2χ_s r/R M0(2 r/R Δ_x,o)                      on the ball +m_s t_x,o, on the outer ring the opposite
//!   rolling couples  m   = w (r/R)/(1+s) M1 tanh(Δ_x/ω_r)  at each race    on the ball +m t_x, on the ring the opposite
//!   s = r cos α/R,  R = ρ - r cos α,  α at rest
//! ```
//! Why these arms. Of a row that rolls v_t/d = Ω/(2(1+s)), -Δ_x,o = Ω R/(2r), Δ_x,i = Ω R(1+2s)/(2r), wherever the axis of the ball's
//! spin stands: the power of the pairs is then M Ω. A couple about the ring's axis instead would miss a part of M that depends on that.
//!
//! Laws of M1 were measured with the spin and the curvature of the contacts in it, which are computed here: M1 is taken
//! without P/|Ω|, P = Σ M·Δ of the couples in the contacts, as far as it reaches; a measured curve, whose parts are not known, as a whole. Of one node P is zero, and the row is that of the plane.
//!
//! A row has the law of one row, with its own radial and axial loads |Σ Q_i n|.
//!
//! Source: derived; book/src/theory/spatial.md. Assumes: the angle α of rest in R and s. Does not model: drag on the cage, the moment at standstill.

use super::ball::{BallState, SpatialBall, Turned};
use super::rigid_body::SpatialWrench;
use super::row::{Around, CARRIED, lists};
use crate::bearing::ball_sums::BallSums;
use crate::bearing::steady_moment::{BallPlace, Loads, MomentPairs};
use number::{Real, Vec3, Vectorized};

/// What the pairs do besides slowing the balls, whose rates have it already.
pub(super) struct Resisted<R> {
    /// Moment on the inner ring, N m.
    pub on_inner: Vec3<R>,
    pub on_outer: SpatialWrench<R>,
    /// W.
    pub heat: R,
}

/// A second pass over the balls, as a task: it is compiled once for all laws of traction.
pub(super) struct Resist<'a, R: Real> {
    pub ball: &'a SpatialBall<R::Group>,
    pub balls: usize,
    pub pairs: &'a MomentPairs<R>,
    pub around: &'a Around<R::Group>,
    /// Speed of the inner ring against the outer one, rad/s, and that one's axis.
    pub turns: (R, Vec3<R>),
    /// What the first pass has found.
    pub carried: &'a [R; CARRIED],
    pub state: &'a [R],
    pub rate: &'a mut [R],
}

impl<R: Real> Vectorized for Resist<'_, R> {
    type Output = Resisted<R>;
    #[inline(always)]
    fn run(self) -> Resisted<R> {
        let Resist {
            ball: law,
            balls: n,
            around,
            turns: (speed, axis),
            ..
        } = self;
        let rings = [&around.inner, &around.outer];
        let [x, y, z, inner_sum, spun] = *self.carried;
        let load = Vec3::new(x, y, z);
        let loads = Loads {
            radial: load
                .across(axis)
                .length_squared()
                .max(R::splat(1e-30))
                .sqrt(),
            axial: load.dot(axis).abs(),
            inner_sum,
            by_contacts: spun.max(R::zero()) / speed.abs().max(R::one()),
        };
        let shared = self.pairs.share(speed, &loads, R::one());

        let states = lists(self.state, 0, n);
        let inverse_mass = law.mass.recip();
        let inverse_inertia =
            inverse_mass * (<R::Group as Real>::splat(0.4) * law.radius.square()).recip();
        let mut sums = BallSums::<R, 10>::new(n);
        let mut from = 0;
        while from < n {
            let ball = BallState::load(&states, from);
            let turned = Turned::to(ball.azimuth);
            let [inner, outer] = law.touches(rings, &ball.in_space(turned));
            let d = outer
                .from_ring
                .across(around.outer.axis)
                .length_squared()
                .sqrt();
            let p = shared.pairs(&BallPlace {
                past: outer.past(),
                inverse_distance: d.recip(),
                on_inner: -inner.turning.x,
                on_outer: outer.turning.x,
                inner_load: inner.load.force,
            });
            let drag = outer.along() * p.orbit_drag;
            let (by_inner, by_outer) = (
                inner.across() * p.inner_couple,
                outer.across() * p.outer_couple,
            );
            let force = turned.to_cylinder(drag) * inverse_mass;
            let moment = turned.to_cylinder(by_outer - by_inner) * inverse_inertia;
            let slows = [
                (1, -force.x),
                (3, -(force.y / ball.radius)),
                (5, -force.z),
                (6, moment.x),
                (7, moment.y),
                (8, moment.z),
            ];
            let mut k = 0;
            while k < slows.len() {
                let (list, by) = slows[k];
                let rates = &mut self.rate[list * n..(list + 1) * n];
                R::store_group(R::load_group(rates, from) + by, rates, from);
                k += 1;
            }
            let on_outer = outer.from_ring.cross(drag) - by_outer;
            sums.add(
                from,
                &[
                    by_inner.x, by_inner.y, by_inner.z, drag.x, drag.y, drag.z, on_outer.x,
                    on_outer.y, on_outer.z, p.heat,
                ],
            );
            from += R::GROUP;
        }
        let [a, b, c, u, v, w, f, g, h, heat] = sums.total();
        Resisted {
            on_inner: Vec3::new(a, b, c),
            on_outer: SpatialWrench::from_array([u, v, w, f, g, h]),
            heat,
        }
    }
}
