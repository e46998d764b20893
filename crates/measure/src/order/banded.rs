//! A symmetric positive matrix whose entries lie near its diagonal: factor, solution, diagonal of the inverse.

/// Lower half by rows: entry (i, i - j) at `rows[i][j]`.
pub(super) struct Banded {
    size: usize,
    width: usize,
    rows: Vec<f64>,
}

/// Factor L D Lᵀ with 1 on the diagonal of L; D in its place.
pub(super) struct Factor {
    size: usize,
    width: usize,
    rows: Vec<f64>,
}

impl Banded {
    /// Nothing but zeros; entries up to `width` - 1 beside the diagonal.
    pub(super) fn new(size: usize, width: usize) -> Self {
        Self {
            size,
            width,
            rows: vec![0.0; size * width],
        }
    }

    /// Adds to an entry on or below the diagonal.
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row * self.width + row - column] += value;
    }

    /// Adds the square of `((1 - part) row, part row)` at a place on the diagonal.
    pub(super) fn gather(&mut self, first: usize, row: &[f64], part: f64) {
        let size = row.len();
        let (low, mixed, high) = (
            (1.0 - part) * (1.0 - part),
            part * (1.0 - part),
            part * part,
        );
        for (i, a) in row.iter().enumerate() {
            let own = (first + i) * self.width + i;
            let next = (first + size + i) * self.width + i;
            for (j, b) in row.iter().enumerate() {
                let square = a * b;
                if j <= i {
                    self.rows[own - j] += low * square;
                    self.rows[next - j] += high * square;
                }
                self.rows[next + size - j] += mixed * square;
            }
        }
    }

    /// The factor; none if the matrix is not positive.
    pub(super) fn factored(mut self) -> Option<Factor> {
        let width = self.width;
        for i in 0..self.size {
            let reach = i.min(width - 1);
            for back in (1..=reach).rev() {
                let j = i - back;
                // l(i, j) d(j) = a(i, j) - Σ l(i, k) d(k) l(j, k), rows hold l d until they are divided.
                let mut sum = 0.0;
                for k in i - reach..j {
                    if j - k < width {
                        sum += self.rows[i * width + i - k] * self.rows[j * width + j - k];
                    }
                }
                self.rows[i * width + back] -= sum;
            }
            let mut diagonal = self.rows[i * width];
            for back in 1..=reach {
                let scaled = self.rows[i * width + back];
                let unit = scaled / self.rows[(i - back) * width];
                diagonal -= scaled * unit;
                self.rows[i * width + back] = unit;
            }
            if diagonal <= 0.0 || !diagonal.is_finite() {
                return None;
            }
            self.rows[i * width] = diagonal;
        }
        Some(Factor {
            size: self.size,
            width,
            rows: self.rows,
        })
    }
}

impl Factor {
    /// Solution of the system.
    pub(super) fn solved(&self, right: &[f64]) -> Vec<f64> {
        let width = self.width;
        let mut x = right.to_vec();
        for i in 0..self.size {
            let sum: f64 = (1..=i.min(width - 1))
                .map(|back| self.rows[i * width + back] * x[i - back])
                .sum();
            x[i] -= sum;
        }
        for (i, value) in x.iter_mut().enumerate() {
            *value /= self.rows[i * width];
        }
        for i in (0..self.size).rev() {
            let value = x[i];
            for back in 1..=i.min(width - 1) {
                x[i - back] -= self.rows[i * width + back] * value;
            }
        }
        x
    }

    /// Diagonal of the inverse, by the recursion of Takahashi inside the band.
    pub(super) fn inverse_diagonal(&self) -> Vec<f64> {
        let (n, width) = (self.size, self.width);
        // Entry (i, i - j) of the inverse at z[i * width + j].
        let mut z = vec![0.0; n * width];
        for i in (0..n).rev() {
            let last = (i + width - 1).min(n - 1);
            // z(j, i) for j > i: -Σ l(k, i) z(max, min)
            for j in (i + 1..=last).rev() {
                let mut sum = 0.0;
                for k in i + 1..=last {
                    let entry = if k >= j {
                        z[k * width + k - j]
                    } else {
                        z[j * width + j - k]
                    };
                    sum += self.rows[k * width + k - i] * entry;
                }
                z[j * width + j - i] = -sum;
            }
            let sum: f64 = (i + 1..=last)
                .map(|k| self.rows[k * width + k - i] * z[k * width + k - i])
                .sum();
            z[i * width] = 1.0 / self.rows[i * width] - sum;
        }
        (0..n).map(|i| z[i * width]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_of_a_small_matrix_is_right() {
        let (n, width) = (7, 3);
        let entry = |i: usize, j: usize| match i.abs_diff(j) {
            0 => 4.0 + i as f64,
            1 => -1.0 + 0.1 * i.max(j) as f64,
            2 => 0.5,
            _ => 0.0,
        };
        let mut matrix = Banded::new(n, width);
        for i in 0..n {
            for j in i.saturating_sub(2)..=i {
                matrix.add(i, j, entry(i, j));
            }
        }
        let factor = matrix.factored().expect("positive");
        let diagonal = factor.inverse_diagonal();
        for k in 0..n {
            let mut unit = vec![0.0; n];
            unit[k] = 1.0;
            let column = factor.solved(&unit);
            for (i, wanted) in unit.iter().enumerate() {
                let product: f64 = (0..n).map(|j| entry(i, j) * column[j]).sum();
                assert!((product - wanted).abs() < 1e-13);
            }
            assert!((column[k] - diagonal[k]).abs() < 1e-14);
        }
        let mut wrong = Banded::new(2, 2);
        wrong.add(0, 0, 1.0);
        wrong.add(1, 1, -1.0);
        assert!(wrong.factored().is_none());
    }
}
