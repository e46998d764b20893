//! A linear seal or support at a node of the rotor: stiffness and damping of two axes, coupled and over speed.
//!
//! ```text
//!   F = F_0 - K(|Ω|) s - C(|Ω|) ṡ   s = C - C_0, C the geometric centre, C_0 where it is centred; F_0 what it carries there
//! ```
//! It acts before and after the release. Cross-coupled stiffness drives a whirl, so its work is a signed source and it stores
//! nothing; ṡᵀ C ṡ is heat. Tables are over the amount of the speed, straight between their rows and constant beyond them.
//!
//! Does not model: mass of the fluid, gaps that close, forces that are not linear.

use number::{Real, Vec2};

/// A matrix of two axes by rows: xx, xy, yx, yy.
pub type Axes<R> = [R; 4];

/// A seal at a node of the rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct SealConstants {
    /// Row φ of the node.
    pub node: Vec<f64>,
    /// Where it is centred, m.
    pub centre: Vec2<f64>,
    /// Force that it carries there, N; of seals none.
    pub carried: Vec2<f64>,
    /// Speed, rad/s, rising; stiffness, N/m; damping, N s/m. One row at least.
    pub rows: Vec<(f64, Axes<f64>, Axes<f64>)>,
}

/// From one speed of a table to the next.
#[derive(Clone, Copy, Debug)]
struct Piece<R> {
    from: R,
    span: R,
    /// Slopes of stiffness and damping.
    slopes: [Axes<R>; 2],
}

/// A seal over `R`.
#[derive(Clone, Debug)]
pub struct Seal<R> {
    centre: Vec2<R>,
    pub(crate) carried: Vec2<R>,
    first: [Axes<R>; 2],
    pieces: Vec<Piece<R>>,
}

/// What a seal does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SealReaction<R> {
    /// Force on the rotor, N.
    pub force: Vec2<R>,
    /// Power of what it carries and of its stiffness on the rotor, W.
    pub work: R,
    /// Heat of its damping, W.
    pub heat: R,
}

impl<R: Real> Seal<R> {
    /// The seals of machines side by side, whose tables have as many rows.
    pub(crate) fn gather<'a>(seal: &dyn Fn(usize) -> &'a SealConstants) -> Self {
        let axes = |of: &dyn Fn(usize) -> Axes<f64>| -> Axes<R> {
            [0, 1, 2, 3].map(|k| R::from_lanes(|lane| of(lane)[k]))
        };
        let row = |lane: usize, at: usize| seal(lane).rows[at];
        let slope = |lane: usize, at: usize, which: usize| -> Axes<f64> {
            let (before, after) = (row(lane, at), row(lane, at + 1));
            let (low, high) = match which {
                0 => (before.1, after.1),
                _ => (before.2, after.2),
            };
            [0, 1, 2, 3].map(|k| (high[k] - low[k]) / (after.0 - before.0))
        };
        Seal {
            centre: Vec2::new(
                R::from_lanes(|lane| seal(lane).centre.x),
                R::from_lanes(|lane| seal(lane).centre.y),
            ),
            carried: Vec2::new(
                R::from_lanes(|lane| seal(lane).carried.x),
                R::from_lanes(|lane| seal(lane).carried.y),
            ),
            first: [axes(&|lane| row(lane, 0).1), axes(&|lane| row(lane, 0).2)],
            pieces: (0..seal(0).rows.len() - 1)
                .map(|at| Piece {
                    from: R::from_lanes(|lane| row(lane, at).0),
                    span: R::from_lanes(|lane| row(lane, at + 1).0 - row(lane, at).0),
                    slopes: [0, 1].map(|which| axes(&|lane| slope(lane, at, which))),
                })
                .collect(),
        }
    }

    /// Stiffness and damping at a speed.
    #[inline(always)]
    fn coefficients(&self, speed: R) -> [Axes<R>; 2] {
        let mut found = self.first;
        for piece in &self.pieces {
            let into = (speed.abs() - piece.from).max(R::zero()).min(piece.span);
            for (own, slopes) in found.iter_mut().zip(&piece.slopes) {
                for (value, slope) in own.iter_mut().zip(slopes) {
                    *value += *slope * into;
                }
            }
        }
        found
    }

    /// What it does to a rotor whose geometric centre is there.
    #[inline(always)]
    pub fn react(&self, centre: Vec2<R>, velocity: Vec2<R>, speed: R) -> SealReaction<R> {
        let [stiffness, damping] = self.coefficients(speed);
        let times =
            |m: &Axes<R>, v: Vec2<R>| Vec2::new(m[0] * v.x + m[1] * v.y, m[2] * v.x + m[3] * v.y);
        let elastic = self.carried - times(&stiffness, centre - self.centre);
        let damping = times(&damping, velocity);
        SealReaction {
            force: elastic - damping,
            work: elastic.dot(velocity),
            heat: damping.dot(velocity),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seal() -> Seal<f64> {
        let constants = SealConstants {
            node: vec![1.0],
            centre: Vec2::new(1e-5, 0.0),
            carried: Vec2::zero(),
            rows: vec![
                (100.0, [1e6, 2e5, -2e5, 1e6], [300.0, 10.0, -10.0, 300.0]),
                (300.0, [3e6, 6e5, -6e5, 3e6], [500.0, 30.0, -30.0, 500.0]),
            ],
        };
        Seal::gather(&|_| &constants)
    }

    #[test]
    fn coefficients_run_straight_between_rows_and_stay_beyond_them() {
        let seal = seal();
        for (speed, stiffness, damping) in [
            (0.0, 1e6, 300.0),
            (200.0, 2e6, 400.0),
            (-200.0, 2e6, 400.0),
            (1e4, 3e6, 500.0),
        ] {
            let [k, c] = seal.coefficients(speed);
            assert_eq!((k[0], c[3]), (stiffness, damping), "{speed}");
        }
        assert_eq!(seal.coefficients(200.0)[0][1], 4e5);
    }

    #[test]
    fn where_it_is_centred_it_only_damps_and_all_power_is_work_or_heat() {
        let seal = seal();
        let still = seal.react(Vec2::new(1e-5, 0.0), Vec2::zero(), 200.0);
        assert_eq!(still.force, Vec2::zero());
        let moved = seal.react(Vec2::new(3e-5, -2e-5), Vec2::new(0.02, 0.05), 200.0);
        let power = moved.force.dot(Vec2::new(0.02, 0.05));
        assert!((power - (moved.work - moved.heat)).abs() < 1e-12 * moved.heat);
        // what couples the axes of damping makes no heat
        let alone = 400.0 * (0.02f64.powi(2) + 0.05f64.powi(2));
        assert!((moved.heat / alone - 1.0).abs() < 1e-12);
    }

    #[test]
    fn cross_coupling_drives_forward_whirl() {
        // xy > 0 and yx < 0: the force has a part along +90° from the displacement, which forward whirl runs along
        let seal = seal();
        let [stiffness, _] = seal.coefficients(200.0);
        let forward = seal.react(Vec2::new(2e-5, 0.0), Vec2::new(0.0, 1e-3), 200.0);
        assert!(stiffness[2] < 0.0 && forward.work > 0.0);
        let backward = seal.react(Vec2::new(2e-5, 0.0), Vec2::new(0.0, -1e-3), 200.0);
        assert!(backward.work < 0.0);
    }
}
