//! Which known name a misspelt one was meant to be.

/// Number of single-letter edits (insert, delete, replace, swap of neighbours) that turn `a` into `b`.
///
/// Case counts half, so that `Mpa` is nearer to `MPa` than to `kPa`; the result is in half edits.
pub fn edit_distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.chars().collect();
    let b: Vec<char> = b.chars().collect();
    let replace = |x: char, y: char| {
        if x == y {
            0
        } else if x.to_lowercase().eq(y.to_lowercase()) {
            1
        } else {
            2
        }
    };
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).map(|j| 2 * j).collect();
    for i in 1..=a.len() {
        let mut row = vec![2 * i];
        for j in 1..=b.len() {
            let mut best = (last[j] + 2)
                .min(row[j - 1] + 2)
                .min(last[j - 1] + replace(a[i - 1], b[j - 1]));
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(before[j - 2] + 2);
            }
            row.push(best);
        }
        before = last;
        last = row;
    }
    last[b.len()]
}

/// The known names near `found`, nearest first, at most three; empty when none is near.
///
/// Near means: at most one edit per three letters of the longer name, never all of them; another case alone is always near.
pub fn nearest_names<'a>(found: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let length = found.chars().count();
    let mut near: Vec<(usize, &str)> = known
        .into_iter()
        .filter_map(|name| {
            let other = name.chars().count();
            let allowed = (2 * length.max(other)).div_ceil(3).max(2);
            // The length difference is a lower bound of the distance: a long text is refused before the table is filled.
            if 2 * length.abs_diff(other) > allowed {
                return None;
            }
            let distance = if name.to_lowercase() == found.to_lowercase() {
                1
            } else {
                let small = edit_distance(&found.to_lowercase(), &name.to_lowercase());
                edit_distance(found, name).min(small + 1)
            };
            // Replacing every letter makes any name of the same length.
            (distance <= allowed && distance < 2 * length.max(other)).then_some((distance, name))
        })
        .collect();
    near.sort();
    near.dedup();
    near.truncate(3);
    near.into_iter().map(|(_, name)| name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_count_half_edits() {
        assert_eq!(edit_distance("mass", "mass"), 0);
        assert_eq!(edit_distance("mass", "Mass"), 1);
        assert_eq!(edit_distance("mass", "mas"), 2);
        assert_eq!(edit_distance("mass", "masss"), 2);
        assert_eq!(edit_distance("mass", "amss"), 2);
        assert_eq!(edit_distance("mass", "miss"), 2);
        assert_eq!(edit_distance("", "abc"), 6);
        // kitten -> sitting: the textbook example of three edits.
        assert_eq!(edit_distance("kitten", "sitting"), 6);
    }

    #[test]
    fn the_nearest_comes_first_and_far_names_are_left_out() {
        let known = ["MPa", "kPa", "Pa", "m"];
        assert_eq!(nearest_names("Mpa", known)[0], "MPa");
        assert_eq!(nearest_names("MPA", known)[0], "MPa");
        assert!(nearest_names("furlong", known).is_empty());
        assert!(nearest_names("x", known).is_empty());
    }
}
