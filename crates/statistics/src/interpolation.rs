//! Straight lines between the values of a list.

/// Index and weight of the later of two neighbours of a place in a rising list; none outside, and of fewer than two values.
///
/// - `list`: places, rising
pub fn place(list: &[f64], at: f64) -> Option<(usize, f64)> {
    let (first, last) = (*list.first()?, *list.last()?);
    if !(at >= first && at <= last) || list.len() < 2 {
        return None;
    }
    let next = list.partition_point(|&x| x <= at).clamp(1, list.len() - 1);
    let width = list[next] - list[next - 1];
    // two that coincide at the end: the later one
    let weight = if width > 0.0 {
        (at - list[next - 1]) / width
    } else {
        1.0
    };
    Some((next, weight))
}

/// Value at a place; none outside the list. A value that is not a number leaves its neighbour as it is.
///
/// - `list`, `values`: places, rising, and the values there, of the same length
pub fn between(list: &[f64], values: &[f64], at: f64) -> Option<f64> {
    let (next, weight) = place(list, at)?;
    Some(mixed(values[next - 1], values[next], weight))
}

/// As [`between`], the first or the last value outside; not-a-number of an empty list and at a place that is none.
///
/// - `list`, `values`: places, rising, and the values there, of the same length
pub fn held(list: &[f64], values: &[f64], at: f64) -> f64 {
    match (list.first(), list.last()) {
        (Some(first), Some(last)) if !at.is_nan() => {
            between(list, values, at.max(*first).min(*last)).unwrap_or(values[0])
        }
        _ => f64::NAN,
    }
}

/// Value at a place that counts in indices; none outside.
///
/// - `values`: at places 0, 1, 2 ...
pub fn at_index(values: &[f64], place: f64) -> Option<f64> {
    if !(place >= 0.0 && place <= values.len() as f64 - 1.0) {
        return None;
    }
    let low = place as usize;
    let next = values.get(low + 1).unwrap_or(&values[low]);
    Some(mixed(values[low], *next, place - low as f64))
}

/// The line from one value to the next; its ends need not know each other.
fn mixed(before: f64, after: f64, weight: f64) -> f64 {
    match weight {
        0.0 => before,
        1.0 => after,
        _ => before + weight * (after - before),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: [f64; 3] = [1.0, 2.0, 4.0];
    const VALUES: [f64; 3] = [10.0, 30.0, 20.0];

    #[test]
    fn lines_are_straight_and_end_with_the_list() {
        for (at, value) in [
            (1.0, 10.0),
            (1.5, 20.0),
            (2.0, 30.0),
            (3.0, 25.0),
            (4.0, 20.0),
        ] {
            assert_eq!(between(&LIST, &VALUES, at), Some(value));
            assert_eq!(held(&LIST, &VALUES, at), value);
        }
        for outside in [0.9, 4.1, f64::NAN] {
            assert_eq!(between(&LIST, &VALUES, outside), None);
        }
        assert_eq!(
            (held(&LIST, &VALUES, 0.0), held(&LIST, &VALUES, 9.0)),
            (10.0, 20.0)
        );
        assert!(held(&LIST, &VALUES, f64::NAN).is_nan() && held(&[], &[], 1.0).is_nan());
        assert_eq!((place(&[1.0], 1.0), held(&[1.0], &[7.0], 3.0)), (None, 7.0));
        // two that coincide
        assert_eq!(held(&[1.0, 2.0, 2.0], &VALUES, 2.0), 20.0);
    }

    #[test]
    fn indices_are_places() {
        for (at, value) in [(0.0, 10.0), (0.25, 15.0), (2.0, 20.0)] {
            assert_eq!(at_index(&VALUES, at), Some(value));
        }
        for outside in [-0.1, 2.1, f64::NAN] {
            assert_eq!(at_index(&VALUES, outside), None);
        }
        assert_eq!(at_index(&[], 0.0), None);
    }

    #[test]
    fn what_is_missing_hides_its_own_place_alone() {
        let values = [10.0, f64::NAN, 20.0];
        assert_eq!(
            (between(&LIST, &values, 1.0), at_index(&values, 2.0)),
            (Some(10.0), Some(20.0))
        );
        assert!(between(&LIST, &values, 1.5).is_some_and(f64::is_nan));
        assert_eq!(between(&LIST, &values, 4.0), Some(20.0));
    }
}
