//! Elementary effects: which inputs matter, by few runs.
//!
//! ```text
//!   d_i = (y(x + Δ e_i) - y(x)) / Δ        an effect: change of the result over the whole range of input i
//!   μ*  = mean |d_i|      μ = mean d_i      σ = deviation of d_i: large where input i interacts or bends
//! ```
//! Source: Morris, Technometrics 33 (1991) 161; μ* by Campolongo, Cariboni, Saltelli, Environ. Model. Softw. 22 (2007) 1509
//! (from memory)

use crate::design::{MOVE, moved};

/// What elementary effects say of one input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    /// Mean of the sizes.
    pub mean_size: f64,
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
    /// Number of effects.
    pub count: usize,
}

/// The effects of each input from the results of all members of a Morris design; a step beside a member without result is
/// left out. None for an input with fewer than two effects.
pub fn effects(seed: u64, inputs: usize, results: &[Option<f64>]) -> Vec<Option<Effect>> {
    let mut found = vec![Vec::new(); inputs];
    for (block, values) in results.chunks_exact(inputs + 1).enumerate() {
        for step in 0..inputs {
            let (input, up) = moved(seed, inputs, block, step);
            if let (Some(before), Some(after)) = (values[step], values[step + 1]) {
                let change = if up { after - before } else { before - after };
                found[input].push(change / MOVE);
            }
        }
    }
    let of = |list: &Vec<f64>| {
        let count = list.len() as f64;
        let mean = list.iter().sum::<f64>() / count;
        let square: f64 = list.iter().map(|d| (d - mean).powi(2)).sum();
        (list.len() > 1).then(|| Effect {
            mean_size: list.iter().map(|d| d.abs()).sum::<f64>() / count,
            mean,
            deviation: (square / (count - 1.0)).sqrt(),
            count: list.len(),
        })
    };
    found.iter().map(of).collect()
}
