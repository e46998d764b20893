//! What the tangents of a machine miss of the derivatives of its rates.

use solve::{Machine, Tangents};

/// γ of the method.
const GAMMA: f64 = solve::rosenbrock::GAMMA;

/// Where to look.
pub struct Looked<'a, M> {
    /// The machine.
    pub machine: &'a M,
    /// Its channels before the ledger.
    pub active: usize,
    /// Length of the step, s.
    pub length: f64,
    /// The state.
    pub state: &'a [f64],
    /// Unit of a channel at a diagonal G.
    pub unit: &'a dyn Fn(usize, f64) -> f64,
    /// Channels that cannot be given a speed.
    pub skipped: &'a dyn Fn(usize) -> bool,
}

/// Largest entry of (G - J)(G - A)⁻¹ - I at a state, all channels in their units: what the tangents A miss of the
/// derivatives J in a step of that length, and where.
pub fn missing<B: Tangents<f64>>(looked: &Looked<B::Machine>) -> (f64, String) {
    let Looked {
        machine,
        active,
        state,
        ..
    } = *looked;
    let batch = B::gather(&|_| machine);
    let mode = B::gather_mode(&|_| machine.start_mode());
    let g = 1.0 / (GAMMA * looked.length);
    let mut room = batch.room();
    batch.take(&mode, 0.0, state, &mut room);
    batch.factor(&mut room, g);
    let unit: Vec<f64> = (0..active).map(|k| (looked.unit)(k, g)).collect();
    let rate_beside = |u: &[f64], share: f64| {
        let mut moved = state.to_vec();
        for (moved, u) in moved.iter_mut().zip(u) {
            *moved += share * u;
        }
        let mut rate = vec![0.0; machine.dimension()];
        machine.rate(&machine.start_mode(), 0.0, &moved, &mut rate, &mut []);
        rate
    };
    let here = rate_beside(&vec![0.0; active], 0.0);
    let mut worst = (0.0, String::new());
    for column in (0..active).filter(|column| !(looked.skipped)(*column)) {
        let mut u = vec![0.0; active];
        u[column] = g * unit[column];
        batch.solve(&mut room, &mut u);
        // so near that all is smooth but where a contact opens or closes in between
        let share = 1e-4;
        let (above, below) = (rate_beside(&u, share), rate_beside(&u, -share));
        for row in 0..active {
            let slopes = [above[row] - here[row], here[row] - below[row]].map(|d| d / share);
            let of_row = g * unit[row];
            if (slopes[0] - slopes[1]).abs() > 0.1 * of_row {
                continue;
            }
            let slope = 0.5 * (slopes[0] + slopes[1]);
            let side = if row == column { of_row } else { 0.0 };
            let entry = ((g * u[row] - slope - side) / of_row).abs();
            if entry > worst.0 {
                let names = [row, column].map(|channel| machine.channel_name(channel));
                worst = (entry, names.join(" by "));
            }
        }
    }
    worst
}
