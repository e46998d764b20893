//! Rainflow counting of a load history.

/// A counted cycle, or half of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// Peak minus valley.
    pub range: f64,
    /// Middle of peak and valley.
    pub mean: f64,
    /// 1 for a whole cycle, 0.5 for a half.
    pub count: f64,
}

fn cycle(first: f64, second: f64, count: f64) -> Cycle {
    Cycle {
        range: (second - first).abs(),
        mean: 0.5 * (first + second),
        count,
    }
}

/// Peaks and valleys of a series, its ends included.
fn reversals(series: &[f64]) -> Vec<f64> {
    let mut kept: Vec<f64> = Vec::new();
    for &value in series {
        if kept.last() == Some(&value) {
            continue;
        }
        if let [.., before, last] = kept[..]
            && (last > before) == (value > last)
        {
            kept.pop();
        }
        kept.push(value);
    }
    kept
}

/// Cycles of a series in the order they close; what does not close counts in halves.
///
/// Source: ASTM E1049-85, 5.4.4.
/// Valid: finite numbers; the order of the whole history must be kept.
pub fn rainflow(series: &[f64]) -> Vec<Cycle> {
    let mut cycles = Vec::new();
    let mut open: Vec<f64> = Vec::new();
    for point in reversals(series) {
        open.push(point);
        while let [.., a, b, c] = open[..] {
            if (c - b).abs() < (b - a).abs() {
                break;
            }
            if open.len() == 3 {
                cycles.push(cycle(a, b, 0.5));
                open.remove(0);
            } else {
                cycles.push(cycle(a, b, 1.0));
                open.truncate(open.len() - 3);
                open.push(c);
            }
        }
    }
    cycles.extend(open.windows(2).map(|pair| cycle(pair[0], pair[1], 0.5)));
    cycles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_add_to_half_the_reversals_and_a_flat_line_counts_nothing() {
        let series = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0];
        let total: f64 = rainflow(&series).iter().map(|cycle| cycle.count).sum();
        assert_eq!(total, 4.0);
        assert!(rainflow(&[1.0, 1.0, 1.0]).is_empty());
        // points on the way add nothing
        let finer = [-2.0, 0.0, 1.0, -1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0];
        assert_eq!(rainflow(&finer), rainflow(&series));
    }
}
