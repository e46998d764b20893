//! Linear supports and seals: two-by-two stiffness, damping and mass, constant or over speed.

/// What a support pushes with: F = -(k s + c ṡ + m s̈), s the displacement (x, y) across it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Block {
    /// Stiffness [[xx, xy], [yx, yy]], N/m.
    pub stiffness: [[f64; 2]; 2],
    /// Damping [[xx, xy], [yx, yy]], N s/m.
    pub damping: [[f64; 2]; 2],
    /// Mass [[xx, xy], [yx, yy]], kg; of seals.
    pub mass: [[f64; 2]; 2],
}

impl Block {
    /// Equal in both directions and not coupled.
    ///
    /// Source: as given.
    /// Valid: always.
    pub fn equal(stiffness: f64, damping: f64) -> Self {
        Self {
            stiffness: [[stiffness, 0.0], [0.0, stiffness]],
            damping: [[damping, 0.0], [0.0, damping]],
            mass: [[0.0; 2]; 2],
        }
    }

    /// Its part that is equal in all directions: the mean of xx and yy, and half of yx - xy.
    ///
    /// Source: symmetry; a force averaged over one turn of a circular orbit.
    /// Valid: circular orbits.
    pub fn equal_part(&self) -> Self {
        let mean = |m: &[[f64; 2]; 2]| {
            let (along, across) = (0.5 * (m[0][0] + m[1][1]), 0.5 * (m[1][0] - m[0][1]));
            [[along, -across], [across, along]]
        };
        Self {
            stiffness: mean(&self.stiffness),
            damping: mean(&self.damping),
            mass: mean(&self.mass),
        }
    }

    fn parts(&self) -> [&[[f64; 2]; 2]; 3] {
        [&self.stiffness, &self.damping, &self.mass]
    }

    /// Whether turning the rotor turns the answer: xx = yy and xy = -yx in every matrix.
    ///
    /// Source: symmetry.
    /// Valid: always.
    pub fn turns(&self) -> bool {
        self.parts()
            .iter()
            .all(|m| m[0][0] == m[1][1] && m[0][1] == -m[1][0])
    }

    fn between(&self, other: &Self, share: f64) -> Self {
        let mix = |a: [[f64; 2]; 2], b: [[f64; 2]; 2]| {
            let mut out = a;
            for (row, (x, y)) in out.iter_mut().zip(a.iter().zip(&b)) {
                for (value, (p, q)) in row.iter_mut().zip(x.iter().zip(y)) {
                    *value = p + (q - p) * share;
                }
            }
            out
        };
        Self {
            stiffness: mix(self.stiffness, other.stiffness),
            damping: mix(self.damping, other.damping),
            mass: mix(self.mass, other.mass),
        }
    }
}

/// Coefficients over speed: one row, or rows at rising speeds.
///
/// Between rows they are linear; beyond the first and the last they stay what they are there.
#[derive(Debug, Clone, PartialEq)]
pub struct Coefficients {
    rows: Vec<(f64, Block)>,
}

impl Coefficients {
    /// The same at every speed.
    ///
    /// Source: as given.
    /// Valid: always.
    pub fn constant(block: Block) -> Self {
        Self {
            rows: vec![(0.0, block)],
        }
    }

    /// Rows of (speed rad/s, block); `None` unless there is one and speeds rise.
    ///
    /// Source: as given.
    /// Valid: always.
    pub fn table(rows: Vec<(f64, Block)>) -> Option<Self> {
        let rising = rows.windows(2).all(|pair| pair[0].0 < pair[1].0);
        (!rows.is_empty() && rising).then_some(Self { rows })
    }

    /// The block at a speed, rad/s. Tables are over the amount of the speed.
    ///
    /// Source: interpolation.
    /// Valid: small motion.
    pub fn at(&self, speed: f64) -> Block {
        let speed = speed.abs();
        let next = self.rows.partition_point(|(at, _)| *at <= speed);
        match (next.checked_sub(1), self.rows.get(next)) {
            (Some(before), Some((high, above))) => {
                let (low, below) = &self.rows[before];
                below.between(above, (speed - low) / (high - low))
            }
            (Some(last), None) => self.rows[last].1,
            (None, _) => self.rows[0].1,
        }
    }

    /// Rows of (speed rad/s, block), one of what is the same at every speed.
    ///
    /// Source: as given.
    /// Valid: always.
    pub fn rows(&self) -> &[(f64, Block)] {
        &self.rows
    }

    /// First and last speed of a table, rad/s; `None` of constants.
    ///
    /// Source: as given.
    /// Valid: always.
    pub fn range(&self) -> Option<(f64, f64)> {
        let (first, last) = (self.rows.first()?, self.rows.last()?);
        (self.rows.len() > 1).then_some((first.0, last.0))
    }

    /// Whether every row turns with the rotor.
    ///
    /// Source: symmetry.
    /// Valid: always.
    pub fn turns(&self) -> bool {
        self.rows.iter().all(|(_, block)| block.turns())
    }
}

/// Share of a rigid rotor's weight on each of several equally stiff rows, over their position along the shaft.
///
/// Formula: s(z) = 1/n + (z_G − z̄)(z − z̄)/Σ(z_i − z̄)²,   z̄ = Σ z_i/n; 1/n where all are at one place
///
/// - `rows`: positions z_i, m, each with the number of its rows, n in all; `centre` z_G of mass, m
///
/// Source: derived; equilibrium of forces and of moments about z̄.
/// Valid: statics; deflections of the shaft small against those of the rows; negative where a row would hold the rotor down.
pub fn weight_share(
    rows: impl Iterator<Item = (f64, f64)> + Clone,
    centre: f64,
) -> impl Fn(f64) -> f64 {
    let over_rows =
        |of: &dyn Fn(f64) -> f64| -> f64 { rows.clone().map(|(z, rows)| rows * of(z)).sum() };
    let count = over_rows(&|_| 1.0);
    let middle = over_rows(&|z| z) / count;
    let spread = over_rows(&|z| (z - middle).powi(2));
    let lever = centre - middle;
    move |z| match spread > 0.0 {
        true => 1.0 / count + lever * (z - middle) / spread,
        false => 1.0 / count,
    }
}
