//! Whether a reading swings at another frequency than the one stated of its sensor.
//!
//! The ringing after an engagement shows the frequency. The likelihood of the part of the record about it is compared for sensors
//! of other frequencies: what another makes likelier by far is no matter of noise or torque.

use super::Swing;
use super::chain::{Chain, Hyper};

/// Frequencies that are tried, over the stated one, and how many.
const REACH: f64 = 5.0;
const TRIED: usize = 24;
/// Values in a period that a frequency needs to be told from others.
const VALUES: f64 = 3.0;
/// Logarithm of the likelihood by which another frequency must be better: that of white noise gains 2 at one time in twenty.
const SURE: f64 = 15.0;
/// Part by which it must be another, and deviations of the stated one.
const APART: f64 = 0.1;
const DEVIATIONS: f64 = 4.0;
/// Calls of the likelihood by which the intensities follow a frequency.
const CALLS: usize = 40;
/// Logarithm by which the intensities of the torque are less than usual while frequencies are tried.
const HELD: f64 = 9.0;
/// Halvings of the interval in which the best frequency lies.
const FINER: usize = 4;

/// Frequency that the reading shows, Hz, where it is surely another than the stated one.
///
/// - `chain`: the part of the record about the engagement, by a sensor
/// - `stated`: the sensor as stated, with the relative deviation of its frequency
/// - `hyper`: intensities that are likeliest with it; `colour`: variance of its innovations over that of white ones
/// - `interval`: between values, s
pub(super) fn frequency<'a>(
    chain: impl Fn(Swing) -> Chain<'a>,
    (stated, deviation): (Swing, f64),
    hyper: &Hyper,
    colour: f64,
    interval: f64,
) -> Option<f64> {
    let at = |omega: f64| Swing { omega, ..stated };
    // a torque that is free to swing suits any frequency: one that hardly may shows which is that of the sensor
    let held = |chain: &Chain| {
        let [noise, slow, fast, calming] = chain.guess();
        [noise, slow - HELD, fast - HELD, calming]
    };
    let fitted = |swing: Swing| {
        let chain = chain(swing);
        let starts =
            [*hyper, held(&chain)].map(|start| chain.cost(&chain.most_likely(start, CALLS)));
        starts[0].min(starts[1])
    };
    let cost = |logarithm: f64| {
        let chain = chain(at(logarithm.exp()));
        chain.cost(&held(&chain))
    };
    let highest = (std::f64::consts::TAU / (VALUES * interval)).ln();
    let middle = stated.omega.ln();
    let (low, high) = (middle - REACH.ln(), highest.min(middle + REACH.ln()));
    if high <= low {
        return None;
    }
    let step = (high - low) / (TRIED - 1) as f64;
    let tried = (0..TRIED).map(|k| low + step * k as f64);
    let costs = tried.map(|place| (place, cost(place)));
    let (mut best, mut least) = costs.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let mut reach = 0.5 * step;
    for _ in 0..FINER {
        for place in [best - reach, best + reach] {
            let other = cost(place);
            if other < least {
                (best, least) = (place, other);
            }
        }
        reach *= 0.5;
    }
    let apart = (best - middle).abs();
    if apart < APART.max(DEVIATIONS * deviation) {
        return None;
    }
    let gain = (fitted(stated) - fitted(at(best.exp()))) / colour.max(1.0);
    (gain > SURE).then(|| best.exp() / std::f64::consts::TAU)
}
