//! Explicit schemes, by their coefficients: order, stability, dense output.

use solve::scheme::dense_weights;
use solve::{BOGACKI_SHAMPINE, HEUN, Scheme};

const SCHEMES: [Scheme; 2] = [BOGACKI_SHAMPINE, HEUN];

trait Judged {
    fn instants(&self) -> [f64; 4];
    fn factor(&self, z: [f64; 2]) -> [f64; 2];
    fn reach(&self, damping_ratio: f64) -> f64;
}

impl Judged for Scheme {
    /// Instants of the first rate, the second, the last of the chain, and that at the end.
    fn instants(&self) -> [f64; 4] {
        [0.0, self.chain[0], self.chain[self.chain.len() - 1], 1.0]
    }
    /// Factor of an eigenvalue z = h λ over a step, by the stages themselves.
    fn factor(&self, z: [f64; 2]) -> [f64; 2] {
        let times =
            |a: [f64; 2], b: [f64; 2]| [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
        let rate = |state: [f64; 2]| times(z, state);
        let first = rate([1.0, 0.0]);
        let mut rates = vec![first];
        for c in self.chain {
            let before = rates[rates.len() - 1];
            rates.push(rate([1.0 + c * before[0], c * before[1]]));
        }
        let of = [first, rates[1], rates[rates.len() - 1]];
        [0, 1].map(|part| {
            let sum: f64 = (0..3).map(|i| self.step[i] * of[i][part]).sum();
            sum + [1.0, 0.0][part]
        })
    }
    /// Longest step over 1/ω, per evaluation, of a motion of frequency ω and this damping ratio, all slower ones damped by the
    /// same damper with it.
    fn reach(&self, damping_ratio: f64) -> f64 {
        let stable = |h: f64| {
            (1..=50).all(|k| {
                let w = h * f64::from(k) / 50.0;
                let zeta = damping_ratio * f64::from(k) / 50.0;
                let [x, y] = self.factor([-zeta * w, w * (1.0 - zeta * zeta).sqrt()]);
                x * x + y * y <= 1.0 + 1e-9
            })
        };
        let steps = (1..2000).map(|k| f64::from(k) * 5e-3);
        let last = steps.take_while(|h| stable(*h)).last().unwrap();
        last / self.evaluations() as f64
    }
}
fn sum(weights: &[f64], value: impl Fn(usize) -> f64) -> f64 {
    weights.iter().enumerate().map(|(i, w)| w * value(i)).sum()
}

#[test]
fn order_conditions_hold_to_three() {
    for scheme in SCHEMES {
        let (b, c) = (scheme.step, scheme.instants());
        for power in 0..3 {
            let exact = 1.0 / f64::from(power + 1);
            assert!((sum(&b, |i| c[i].powi(power)) - exact).abs() < 1e-15);
        }
        // Σ b_i a_ij c_j = 1/6; the rate before that of the second stage is that at the start
        let chain = scheme.chain;
        let before = [0.0, 0.0, chain[chain.len() - 2]];
        assert!((sum(&b, |i| c[i] * before[i]) - 1.0 / 6.0).abs() < 1e-15);
    }
}
#[test]
fn the_embedded_step_has_order_two_and_not_three() {
    for scheme in SCHEMES {
        let c = scheme.instants();
        let moment = |power: i32| sum(&scheme.error, |i| c[i].powi(power));
        assert!(moment(0).abs() < 1e-15 && moment(1).abs() < 1e-15);
        assert!(moment(2).abs() > 1e-2);
    }
}
#[test]
fn the_extended_region_pays_where_a_quick_motion_is_damped() {
    // and costs a fifth where it is not, and stability binds all the same
    for (damping_ratio, least) in [(0.1, 0.8), (0.4, 0.85), (0.6, 1.2), (0.75, 1.25)] {
        let gain = HEUN.reach(damping_ratio) / BOGACKI_SHAMPINE.reach(damping_ratio);
        assert!(gain > least, "{damping_ratio}: {gain}");
    }
    // the test would notice a region that is none
    assert!((BOGACKI_SHAMPINE.reach(0.0) - 3.0_f64.sqrt() / 3.0).abs() < 0.01);
}
#[test]
fn dense_output_meets_both_ends_with_their_rates() {
    let ends = [dense_weights(0.0), dense_weights(1.0)];
    assert_eq!(
        ends.map(|w| (w.change, w.first, w.last)),
        [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)]
    );
    // its slope is the first rate at the start and the last one at the end
    let h = 1e-6;
    let (start, end) = (dense_weights(h), dense_weights(1.0 - h));
    // differences over 1e-6: a few times that
    assert!((start.first / h - 1.0).abs() < 1e-5 && (start.last / h).abs() < 1e-5);
    assert!((end.last / h + 1.0).abs() < 1e-5 && (end.first / h).abs() < 1e-5);
}
#[test]
fn dense_output_has_order_three_along_the_solution() {
    for scheme in SCHEMES {
        let c = scheme.instants();
        for theta in [0.2_f64, 0.5, 0.8] {
            let w = dense_weights(theta);
            let b = scheme.step;
            let rates = [
                w.change * b[0] + w.first,
                w.change * b[1],
                w.change * b[2],
                w.last,
            ];
            for power in 0..3 {
                let exact = theta.powi(power + 1) / f64::from(power + 1);
                let ours = sum(&rates, |i| c[i].powi(power));
                assert!((ours - exact).abs() < 1e-15, "{theta} {power}");
            }
        }
    }
}
