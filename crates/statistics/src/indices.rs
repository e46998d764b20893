//! Sobol indices: which share of the variance of a result is due to which input.
//!
//! ```text
//!   S_i  = mean( y_B (y_ABi - y_A) ) / V            by input i alone
//!   T_i  = mean( (y_A - y_ABi)² ) / (2 V)           by input i with all that it interacts in
//! ```
//! of results less their mean. The bands are the 2.5 and 97.5 % quantiles of 500 draws of as many blocks with repetition. They
//! hold for independent inputs alone: of correlated ones no share belongs to one input.
//!
//! Source: S_i by Saltelli et al., Comput. Phys. Commun. 181 (2010) 259; T_i by Jansen, Comput. Phys. Commun. 117 (1999) 35; bands
//! by Efron, Ann. Statist. 7 (1979) 1 (from memory)

use crate::random::below;

/// A value with its 95 % band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Banded {
    /// The value.
    pub value: f64,
    /// Ends of the band.
    pub band: [f64; 2],
}

/// Both indices of one input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Index {
    /// By the input alone.
    pub first: Banded,
    /// With all its interactions.
    pub total: Banded,
}

/// Draws of the bands.
const DRAWS: usize = 500;
/// Blocks from which indices are computed.
pub const LEAST_BLOCKS: usize = 8;

/// The indices of each input from the results of all members of a Saltelli design. Blocks with a member without result are left
/// out. None where fewer than [`LEAST_BLOCKS`] are whole, or the result does not vary.
pub fn indices(seed: u64, inputs: usize, results: &[Option<f64>]) -> Option<Vec<Index>> {
    let blocks: Vec<Vec<f64>> = (results.chunks_exact(inputs + 2))
        .filter_map(|block| block.iter().copied().collect())
        .collect();
    if blocks.len() < LEAST_BLOCKS {
        return None;
    }
    let all: Vec<usize> = (0..blocks.len()).collect();
    let found = of(&blocks, &all, inputs)?;
    let draws: Vec<Vec<[f64; 2]>> = (0..DRAWS)
        .filter_map(|draw| {
            let drawn: Vec<usize> = (0..blocks.len())
                .map(|at| below(blocks.len(), seed, draw as u64, at as u64))
                .collect();
            of(&blocks, &drawn, inputs)
        })
        .collect();
    let banded = |input: usize, kind: usize| {
        let mut values: Vec<f64> = draws.iter().map(|draw| draw[input][kind]).collect();
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values[(share * (values.len() - 1) as f64).round() as usize];
        Banded {
            value: found[input][kind],
            band: [at(0.025), at(0.975)],
        }
    };
    let index = |input| Index {
        first: banded(input, 0),
        total: banded(input, 1),
    };
    Some((0..inputs).map(index).collect())
}

/// First and total index of each input from some of the blocks.
fn of(blocks: &[Vec<f64>], some: &[usize], inputs: usize) -> Option<Vec<[f64; 2]>> {
    let count = some.len() as f64;
    let sum = |f: &dyn Fn(&[f64]) -> f64| some.iter().map(|k| f(&blocks[*k])).sum::<f64>();
    let mean = sum(&|y| y[0] + y[1]) / (2.0 * count);
    let variance = sum(&|y| (y[0] - mean).powi(2) + (y[1] - mean).powi(2)) / (2.0 * count);
    let size = sum(&|y| y[0] * y[0] + y[1] * y[1]) / (2.0 * count);
    if variance <= 1e-24 * size {
        return None;
    }
    let one = |input: usize| {
        let first = sum(&|y| (y[1] - mean) * (y[input + 2] - y[0])) / count;
        let total = sum(&|y| (y[0] - y[input + 2]).powi(2)) / (2.0 * count);
        [first / variance, total / variance]
    };
    Some((0..inputs).map(one).collect())
}
