//! What the converter did to the channels that were read.

use crate::signals::read::Series;
use measure::converter::{Fault, faults};
use problem::{note, note::Note};

/// Share of the noise that rounding may have before it is told.
const COARSE: f64 = 0.5;

/// A channel held against its converter.
pub(crate) struct Converted {
    pub name: String,
    pub clipped: usize,
    /// Noise of rounding over the noise of the channel.
    pub rounding_share: f64,
    /// What of it is at a limit.
    pub at_limit: Option<Note>,
    /// What its steps hide.
    pub coarse: Option<Note>,
}

impl Converted {
    /// None where nothing is known of the converter.
    pub fn of(series: &Series) -> Option<Converted> {
        let converter = series.converter?;
        let found = faults(&series.values, Some(&converter));
        let cut = || found.iter().filter(|one| one.fault == Fault::Clipped);
        let clipped = cut().map(|one| one.count).sum();
        let at_limit = cut().next().map(|first| {
            note!(
                "{} of {} values are at the limit of the converter (clipped), in {} stretches, the first at {:.6} s",
                clipped,
                series.values.len(),
                cut().count(),
                series.time(first.first)
            )
        });
        let noise = noise(&series.values);
        let rounding = converter.rounding_noise();
        // The noise that was measured holds that of rounding.
        let rounding_share = (rounding / noise.max(rounding)).min(1.0);
        let coarse = (rounding_share > COARSE).then(|| {
            note!(
                "the steps of the converter make {:.0} % of the noise: a smaller range would show more",
                100.0 * rounding_share
            )
        });
        Some(Converted {
            name: series.name.clone(),
            clipped,
            rounding_share,
            at_limit,
            coarse,
        })
    }
}

/// Noise of a channel, rms: fourth differences let pass what changes from value to value; their median leaves steps out.
fn noise(values: &[f64]) -> f64 {
    // The weights 1, -4, 6, -4, 1 make √70 of white noise; the median of |x| is 0.6745 standard deviations for normal x.
    let differences = values.windows(5);
    let mut sizes: Vec<f64> = differences
        .map(|w| (w[0] - 4.0 * w[1] + 6.0 * w[2] - 4.0 * w[3] + w[4]).abs())
        .filter(|size| size.is_finite())
        .collect();
    if sizes.is_empty() {
        return 0.0;
    }
    let middle = sizes.len() / 2;
    *sizes.select_nth_unstable_by(middle, f64::total_cmp).1 / (0.6745 * 70.0_f64.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use measure::converter::Converter;

    fn series(step_share: f64) -> Series {
        let converter = Converter {
            lowest: -10.0,
            highest: 10.0,
            bits: 14,
        };
        let step = converter.step();
        let mut state = 1u64;
        let mut uniform = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        // The sum of twelve is normal enough, with variance 1.
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let values = (0..4000).map(|k| {
            let truth = 3.0 * (0.002 * f64::from(k)).sin() + step / step_share * normal();
            (truth / step).round() * step
        });
        Series {
            name: "a".to_string(),
            unit: "V".to_string(),
            first: 0.0,
            interval: 1e-3,
            values: values.collect(),
            converter: Some(converter),
        }
    }

    #[test]
    fn limits_and_coarse_steps_are_told() {
        // Noise of five steps: rounding is 1/√12 of a step, a twentieth of the noise.
        let mut fine = series(0.2);
        let found = Converted::of(&fine).unwrap();
        assert_eq!(found.clipped, 0);
        assert_eq!((&found.at_limit, &found.coarse), (&None, &None));
        assert!(
            (found.rounding_share - 0.0577).abs() < 0.006,
            "{}",
            found.rounding_share
        );
        let coarse = Converted::of(&series(4.0)).unwrap();
        assert!(
            coarse.rounding_share > 0.5 && coarse.coarse.is_some() && coarse.at_limit.is_none()
        );
        fine.values[700..750].fill(10.0);
        fine.values[900] = -10.0;
        let found = Converted::of(&fine).unwrap();
        assert_eq!(found.clipped, 51);
        let told = found.at_limit.unwrap().to_string();
        assert!(
            told.contains("51 of 4000") && told.contains("at 0.700000 s"),
            "{told}"
        );
        fine.converter = None;
        assert!(Converted::of(&fine).is_none());
    }
}
