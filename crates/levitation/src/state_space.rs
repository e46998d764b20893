//! Linear filters as ẋ = A x + B u, y = C x + D u, with named states.

use crate::{C64, Refused};
use nalgebra::{DMatrix, DVector};
use number::Real;

/// A linear filter: ẋ = A x + B u, y = C x + D u.
#[derive(Debug, Clone, PartialEq)]
pub struct StateSpace {
    a: DMatrix<f64>,
    b: DMatrix<f64>,
    c: DMatrix<f64>,
    d: DMatrix<f64>,
    names: Vec<String>,
}

impl StateSpace {
    /// From its matrices, named by `name`; refused unless their sizes fit and every entry is a number.
    pub fn new(
        name: &str,
        a: DMatrix<f64>,
        b: DMatrix<f64>,
        c: DMatrix<f64>,
        d: DMatrix<f64>,
    ) -> Result<Self, Refused> {
        let states = a.nrows();
        let fits = a.ncols() == states
            && b.nrows() == states
            && c.ncols() == states
            && d.shape() == (c.nrows(), b.ncols());
        if !fits {
            let [a, b, c, d] = [&a, &b, &c, &d].map(|m| format!("{} × {}", m.nrows(), m.ncols()));
            return Err(Refused::Sizes(format!(
                "matrices that do not fit: A {a}, B {b}, C {c}, D {d}; n states, m inputs and p outputs need A n × n, B n × m, C p × n, D p × m"
            )));
        }
        if [&a, &b, &c, &d]
            .iter()
            .any(|m| m.iter().any(|value| !value.is_finite()))
        {
            return Err(Refused::not_finite());
        }
        let names = (1..=states).map(|index| format!("{name} {index}"));
        Ok(Self {
            a,
            b,
            c,
            d,
            names: names.collect(),
        })
    }

    /// A factor, without states.
    #[must_use]
    pub fn gain(factor: f64) -> Self {
        Self::scalar(&[], &[], &[], &[factor], &[])
    }

    /// num(s)/den(s), the highest power first, of second order at most; refused where num is of higher order than den.
    ///
    /// States are scaled by the corner of den, so that they are of the size of the input.
    pub fn rational(name: &str, num: &[f64], den: &[f64]) -> Result<Self, Refused> {
        let (num, den) = (without_leading_zeros(num), without_leading_zeros(den));
        if num.iter().chain(den).any(|value| !value.is_finite()) {
            return Err(Refused::not_finite());
        }
        if den.is_empty() || den.len() > 3 || num.len() > den.len() {
            return Err(Refused::Filter(format!(
                "{} coefficients over {}; a filter has 1 to 3 below and at most as many above, the highest power first",
                num.len(),
                den.len()
            )));
        }
        let order = den.len() - 1;
        let lead = den[0];
        // of s^order … s^0, of num padded to the length of den
        let p = |power: usize| den[order - power] / lead;
        let q = |power: usize| match num.len().checked_sub(power + 1) {
            Some(at) => num[at] / lead,
            None => 0.0,
        };
        let d = q(order);
        Ok(match order {
            0 => Self::gain(d),
            1 => {
                // ẋ = -p₀x + w u; y = (q₀ - d p₀)/w x + d u
                let w = scale(&[p(0).abs()]);
                Self::scalar(&[-p(0)], &[w], &[(q(0) - d * p(0)) / w], &[d], &[name])
            }
            _ => {
                // ẋ₁ = w x₂, ẋ₂ = -(p₀/w)x₁ - p₁x₂ + w u: x₁ = w²u/den, x₂ = w s u/den
                let w = scale(&[p(0).abs().sqrt(), p(1).abs()]);
                Self::scalar(
                    &[0.0, w, -p(0) / w, -p(1)],
                    &[0.0, w],
                    &[(q(0) - d * p(0)) / (w * w), (q(1) - d * p(1)) / w],
                    &[d],
                    &[&format!("{name} 1"), &format!("{name} 2")],
                )
            }
        })
    }

    /// Delay T as a quotient, (T²s²/12 - Ts/2 + 1)/(T²s²/12 + Ts/2 + 1): gain 1 at every frequency, phase -ωT to 1 % up to ωT = 2.6.
    pub fn pade(name: &str, delay: f64) -> Result<Self, Refused> {
        let (first, zeroth) = (6.0 / delay, 12.0 / (delay * delay));
        Self::rational(name, &[1.0, -first, zeroth], &[1.0, first, zeroth])
    }

    /// K_p + K_i/s + K_d s/(1 + T_d s); without K_i no state for it, which would add a zero of its own.
    pub fn pid(kp: f64, ki: f64, kd: f64, td: f64) -> Result<Self, Refused> {
        if kd != 0.0 && !(td > 0.0 && td.is_finite()) {
            return Err(Refused::Filter(format!(
                "a derivative with the time constant {td} s; it must be above 0, or noise would be amplified without bound"
            )));
        }
        if [kp, ki, kd].iter().any(|value| !value.is_finite()) {
            return Err(Refused::not_finite());
        }
        let mut out = Self::gain(kp);
        if ki != 0.0 {
            let integral = Self::scalar(&[0.0], &[1.0], &[ki], &[0.0], &["integral"]);
            out = out.beside(&integral);
        }
        if kd != 0.0 {
            let rate = 1.0 / td;
            let derivative = Self::scalar(
                &[-rate],
                &[rate],
                &[-kd * rate],
                &[kd * rate],
                &["derivative"],
            );
            out = out.beside(&derivative);
        }
        Ok(out)
    }

    fn scalar(a: &[f64], b: &[f64], c: &[f64], d: &[f64; 1], names: &[&str]) -> Self {
        let states = b.len();
        Self {
            a: DMatrix::from_row_slice(states, states, a),
            b: DMatrix::from_row_slice(states, 1, b),
            c: DMatrix::from_row_slice(1, states, c),
            d: DMatrix::from_row_slice(1, 1, d),
            names: names.iter().map(|name| (*name).to_owned()).collect(),
        }
    }

    /// Both fed with the same, their outputs added; sizes of inputs and outputs must be equal.
    #[must_use]
    fn beside(&self, other: &Self) -> Self {
        let (first, second) = (self.states(), other.states());
        let mut a = DMatrix::zeros(first + second, first + second);
        a.view_mut((0, 0), (first, first)).copy_from(&self.a);
        a.view_mut((first, first), (second, second))
            .copy_from(&other.a);
        let mut b = DMatrix::zeros(first + second, self.inputs());
        b.rows_mut(0, first).copy_from(&self.b);
        b.rows_mut(first, second).copy_from(&other.b);
        let mut c = DMatrix::zeros(self.outputs(), first + second);
        c.columns_mut(0, first).copy_from(&self.c);
        c.columns_mut(first, second).copy_from(&other.c);
        Self {
            a,
            b,
            c,
            d: &self.d + &other.d,
            names: [self.names.clone(), other.names.clone()].concat(),
        }
    }

    /// This filter, and another fed with its output.
    ///
    /// # Panics
    /// Where the other has another number of inputs than this has outputs.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        assert_eq!(self.outputs(), next.inputs(), "filters in a row must fit");
        let (first, second) = (self.states(), next.states());
        let mut a = DMatrix::zeros(first + second, first + second);
        a.view_mut((0, 0), (first, first)).copy_from(&self.a);
        a.view_mut((first, 0), (second, first))
            .copy_from(&(&next.b * &self.c));
        a.view_mut((first, first), (second, second))
            .copy_from(&next.a);
        let mut b = DMatrix::zeros(first + second, self.inputs());
        b.rows_mut(0, first).copy_from(&self.b);
        b.rows_mut(first, second).copy_from(&(&next.b * &self.d));
        let mut c = DMatrix::zeros(next.outputs(), first + second);
        c.columns_mut(0, first).copy_from(&(&next.d * &self.c));
        c.columns_mut(first, second).copy_from(&next.c);
        Self {
            a,
            b,
            c,
            d: &next.d * &self.d,
            names: [self.names.clone(), next.names.clone()].concat(),
        }
    }

    /// The same filter in steps of a period T by the bilinear rule, s = (2/T)(z - 1)/(z + 1), and what has to be taken from its
    /// states for every unit of input when steps begin in the middle of a motion.
    ///
    /// With M = (1 - AT/2)⁻¹: A' = M(1 + AT/2), B' = T M²B, C' = C, D' = D + CMB T/2; x' = x - MB T/2 u.
    #[must_use]
    pub fn stepped(&self, period: f64) -> Option<(Self, DMatrix<f64>)> {
        let one = DMatrix::identity(self.states(), self.states());
        let half = &self.a * (0.5 * period);
        let factor = match half.is_empty() {
            true => half.clone(),
            false => (&one - &half).try_inverse()?,
        };
        let entry = &factor * &self.b * (0.5 * period);
        let filter = Self {
            a: &factor * (one + half),
            b: &factor * &entry * 2.0,
            c: self.c.clone(),
            d: &self.d + &self.c * &entry,
            names: self.names.clone(),
        };
        Some((filter, entry))
    }

    /// Number of states.
    #[must_use]
    pub fn states(&self) -> usize {
        self.a.nrows()
    }
    /// Number of inputs.
    #[must_use]
    pub fn inputs(&self) -> usize {
        self.d.ncols()
    }
    /// Number of outputs.
    #[must_use]
    pub fn outputs(&self) -> usize {
        self.d.nrows()
    }
    /// Names of the states.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// A x + B u: the rates of the states, or the next states of a stepped filter.
    #[inline(always)]
    pub fn rates<R: Real>(&self, x: &[R], u: &[R], rates: &mut [R]) {
        product(&self.a, x, &self.b, u, rates);
    }

    /// C x + D u.
    #[inline(always)]
    pub fn output<R: Real>(&self, x: &[R], u: &[R], y: &mut [R]) {
        product(&self.c, x, &self.d, u, y);
    }

    /// The states under a constant input: A x = -B u, integrators, whose rows of A are zero, at zero; `None` where nothing settles.
    #[must_use]
    pub fn settled(&self, u: &DVector<f64>) -> Option<DVector<f64>> {
        let mut left = self.a.clone();
        let mut right = -(&self.b * u);
        for state in 0..self.states() {
            if left.row(state).amax() == 0.0 {
                (left[(state, state)], right[state]) = (1.0, 0.0);
            }
        }
        match left.is_empty() {
            true => Some(right),
            false => left.lu().solve(&right),
        }
    }

    /// C (s - A)⁻¹ B + D; `None` where s is a pole.
    #[must_use]
    pub fn response(&self, s: C64) -> Option<DMatrix<C64>> {
        let inner = resolvent(&self.a, s, self.b.map(C64::from))?;
        Some(self.c.map(C64::from) * inner + self.d.map(C64::from))
    }

    /// Whether all matrices are equal, whatever the states are called.
    #[must_use]
    pub(crate) fn same_matrices(&self, other: &Self) -> bool {
        self.a == other.a && self.b == other.b && self.c == other.c && self.d == other.d
    }

    /// Gain at rest; `None` where a constant input never settles, as with an integrator.
    #[must_use]
    pub fn static_gain(&self) -> Option<DMatrix<f64>> {
        let gain = self.response(C64::from(0.0))?.map(|value| value.re);
        let finite = gain.iter().all(|value| value.is_finite());
        finite.then_some(gain)
    }
}

/// (s - A)⁻¹ times columns; `None` where s is an eigenvalue of A.
fn resolvent(a: &DMatrix<f64>, s: C64, right: DMatrix<C64>) -> Option<DMatrix<C64>> {
    if a.is_empty() {
        return Some(right);
    }
    let mut left = a.map(|value| C64::from(-value));
    for state in 0..left.nrows() {
        left[(state, state)] += s;
    }
    left.lu().solve(&right)
}

/// out = left x + right u, row by row.
#[inline(always)]
fn product<R: Real>(left: &DMatrix<f64>, x: &[R], right: &DMatrix<f64>, u: &[R], out: &mut [R]) {
    for (row, value) in out.iter_mut().enumerate() {
        let mut sum = R::zero();
        for (matrix, vector) in [(left, x), (right, u)] {
            for (column, entry) in vector.iter().enumerate() {
                sum += R::splat(matrix[(row, column)]) * *entry;
            }
        }
        *value = sum;
    }
}

fn without_leading_zeros(list: &[f64]) -> &[f64] {
    let zeros = list.iter().take_while(|value| **value == 0.0).count();
    &list[zeros..]
}

/// The first that is above zero, or 1.
fn scale(candidates: &[f64]) -> f64 {
    let found = candidates.iter().find(|value| **value > 0.0);
    found.copied().unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const J: C64 = C64::new(0.0, 1.0);

    fn at(filter: &StateSpace, s: C64) -> C64 {
        filter.response(s).expect("not a pole")[(0, 0)]
    }
    fn close(a: C64, b: C64) -> bool {
        (a - b).norm() <= 1e-13 * b.norm()
    }
    fn quotient(num: &[f64], den: &[f64], s: C64) -> C64 {
        let value = |list: &[f64]| list.iter().fold(C64::from(0.0), |sum, c| sum * s + c);
        value(num) / value(den)
    }

    #[test]
    fn quotients_are_what_they_say_at_every_order() {
        let cases: [(&[f64], &[f64]); 7] = [
            (&[3.0], &[2.0]),
            (&[5e4], &[1.0, 5e4]),
            (&[2.0, 1.0], &[0.1, 7.0]),
            (&[1.0, 30.0, 6.3e6], &[1.0, 900.0, 6.3e6]),
            (&[0.0, 4.0], &[1.0, 20.0, 400.0]),
            (&[1.0], &[2.0, 0.0, 0.0]),
            (&[1.0, 2.0], &[1.0, 3.0, 0.0]),
        ];
        for (num, den) in cases {
            let filter = StateSpace::rational("filter", num, den).unwrap();
            for s in [J * 10.0, J * 2500.0, C64::new(-3.0, 700.0)] {
                assert!(
                    close(at(&filter, s), quotient(num, den, s)),
                    "{num:?} {den:?}"
                );
            }
        }
        for (num, den) in [
            (&[1.0, 0.0][..], &[1.0][..]),
            (&[1.0], &[0.0]),
            (&[1.0], &[1.0; 4]),
        ] {
            assert!(matches!(
                StateSpace::rational("", num, den),
                Err(Refused::Filter { .. })
            ));
        }
    }

    #[test]
    fn a_pid_in_a_row_with_filters_is_the_product_of_their_responses() {
        let pid = StateSpace::pid(8000.0, 8e4, 22.0, 4.5e-5).unwrap();
        assert_eq!(pid.names(), ["integral", "derivative"]);
        assert!(pid.static_gain().is_none());
        let notch =
            StateSpace::rational("notch", &[1.0, 30.0, 6.3e6], &[1.0, 900.0, 6.3e6]).unwrap();
        let row = pid.then(&notch).then(&StateSpace::gain(0.5));
        assert_eq!(row.states(), 4);
        for omega in [3.0, 655.0, 2e4] {
            let s = J * omega;
            let expected = (8000.0 + 8e4 / s + s * 22.0 / (s * 4.5e-5 + 1.0)) * at(&notch, s) * 0.5;
            assert!(close(at(&row, s), expected));
        }
        assert_eq!(StateSpace::pid(4000.0, 0.0, 0.0, 0.0).unwrap().states(), 0);
        assert!(StateSpace::pid(1.0, 0.0, 1.0, 0.0).is_err());
    }

    #[test]
    fn the_quotient_of_a_delay_has_gain_one_and_its_phase() {
        let delay = StateSpace::pade("delay", 5e-5).unwrap();
        for omega in [100.0, 5e3, 2e4] {
            let value = at(&delay, J * omega);
            assert!((value.norm() - 1.0).abs() < 1e-14);
            // phase error of the 2/2 quotient: (ωT)⁵/720
            let error = (value * (J * omega * 5e-5).exp()).arg();
            let bound = (omega * 5e-5_f64).powi(5) / 720.0;
            assert!(error.abs() < bound * 1.1 + 1e-14, "{omega}: {error}");
        }
    }

    #[test]
    fn steps_are_the_bilinear_rule_and_begin_where_the_filter_is() {
        let period = 1e-3;
        let filter = StateSpace::pid(2.0, 300.0, 0.1, 4e-3).unwrap();
        let (stepped, entry) = filter.stepped(period).unwrap();
        for omega in [1.0, 200.0, 2000.0] {
            let z = (J * omega * period).exp();
            let s = 2.0 / period * (z - 1.0) / (z + 1.0);
            // C'(z - A')⁻¹B' + D' is the response of the stepped matrices at z
            assert!(close(at(&stepped, z), at(&filter, s)));
        }
        // a constant state of the derivative under a constant input stays
        let (x, u) = ([0.0, 5.0], [5.0]);
        let start: Vec<f64> = (0..2).map(|k| x[k] - entry[(k, 0)] * u[0]).collect();
        let (mut next, mut y) = ([0.0; 2], [0.0]);
        stepped.rates(&start, &u, &mut next);
        stepped.output(&start, &u, &mut y);
        assert!(
            (next[1] - start[1]).abs() < 1e-14 && (next[0] - start[0] - 5.0 * period).abs() < 1e-14
        );
        assert!((y[0] - 10.0).abs() < 1e-12);
    }
}
