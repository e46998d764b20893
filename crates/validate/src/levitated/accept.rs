//! Tolerances that files of levitated rotors state in words. The integration tests compile this page by itself.

use serde_json::Value;

/// The tolerances of the files for a basis.
#[derive(Clone, Copy)]
pub(super) struct Accept {
    pub(super) name: &'static str,
    /// Free modes up to this, rad/s.
    pub(super) cut: f64,
    pub(super) eigenvalues: f64,
    /// Of roots of filters, `far` from the origin, 1/s.
    pub(super) filters: f64,
    pub(super) far: f64,
    pub(super) sensitivity: f64,
    pub(super) peaks: f64,
    pub(super) unbalance: f64,
    pub(super) impulse: f64,
    pub(super) early_impulse: f64,
}

/// In all coordinates, where a file says nothing else.
pub(super) const WHOLE: Accept = Accept {
    name: "all coordinates",
    cut: f64::INFINITY,
    eigenvalues: 1e-6,
    filters: 1e-6,
    far: 2.5e4,
    sensitivity: 1e-6,
    peaks: 1e-5,
    unbalance: 1e-6,
    impulse: 1e-6,
    early_impulse: 1e-6,
};
/// In the reduced basis.
pub(super) const REDUCED: Accept = Accept {
    name: "free modes to 6e4 rad/s and residual flexibility",
    cut: 6e4,
    eigenvalues: 1e-5,
    filters: 2e-4,
    far: 2.5e4,
    sensitivity: 4e-5,
    peaks: 4e-5,
    unbalance: 2e-5,
    impulse: 1e-3,
    early_impulse: 5e-3,
};

impl Accept {
    /// With the numbers that the text `accept` of a file gives: what it says of the reduced rotor begins at "free modes".
    pub(super) fn of(self, file: &Value) -> Self {
        let text = file["accept"].as_str().unwrap_or_default();
        let (whole, reduced) = text.split_once("free modes").unwrap_or((text, ""));
        let (own, peaks) = match self.cut.is_finite() {
            true => (reduced, "(reduced"),
            false => (whole, "Peaks of |S|"),
        };
        let after = |text: &str, word: &str, usual: f64| {
            let numbers = text.split_once(word).map(|(_, rest)| numbers(rest));
            numbers.and_then(|mut all| all.next()).unwrap_or(usual)
        };
        // "2e-4 for the two filter roots", or "filter roots 2e-4"
        let near = |word: &str, usual: f64| {
            let clause = own.split_once(word).map_or("", |(text, _)| text);
            let clause = clause.rsplit([',', ';']).next().unwrap_or_default();
            let share = numbers(clause).filter(|number| *number < 1.0).last();
            share.unwrap_or_else(|| after(own, word, usual))
        };
        let eigenvalues = after(own, "eigenvalues", self.eigenvalues);
        let impulse = after(own, "impulse response", self.impulse);
        Accept {
            eigenvalues,
            filters: near("filter root", self.filters.max(eigenvalues)),
            far: after(reduced, "|lambda| <", self.far),
            sensitivity: after(own, "|S|", self.sensitivity),
            peaks: after(text, peaks, self.peaks),
            unbalance: after(own, "unbalance", self.unbalance),
            impulse,
            early_impulse: near("before", self.early_impulse.max(impulse)),
            ..self
        }
    }
}

/// The numbers of a text.
fn numbers(text: &str) -> impl Iterator<Item = f64> + '_ {
    let words = text.split(|letter: char| letter.is_whitespace() || "(),;:".contains(letter));
    let numbers = words.filter_map(|word| word.trim_end_matches('.').parse().ok());
    numbers.filter(|number: &f64| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_of_a_file_gives_its_tolerances() {
        let text = "unreduced rotor: eigenvalues |dlambda| <= 3e-6 |lambda| + 1e-5 1/s, |S| samples 2e-6 relative, unbalance and \
                    impulse response 4e-6 of the largest; free modes to 6e4 rad/s (18 coordinates): eigenvalues 2e-5 for |lambda| < 2e4 \
                    and 1e-3 for the two nearly double filter roots near -26 200, |S| 5e-5, unbalance response 6e-5, impulse response \
                    7e-3 from t = 1 ms on, 8e-3 before. Peaks of |S| 9e-5 (reduced 1e-4), their frequency 1e-4";
        let file = serde_json::json!({ "accept": text });
        let shown = |of: Accept| {
            let (modes, peaks) = (
                [of.eigenvalues, of.filters, of.far],
                [of.sensitivity, of.peaks],
            );
            let impulses = [of.unbalance, of.impulse, of.early_impulse];
            (of.name, modes, peaks, impulses)
        };
        let whole = (
            "all coordinates",
            [3e-6, 3e-6, 2e4],
            [2e-6, 9e-5],
            [4e-6; 3],
        );
        assert_eq!(shown(WHOLE.of(&file)), whole);
        let reduced = (
            REDUCED.name,
            [2e-5, 1e-3, 2e4],
            [5e-5, 1e-4],
            [6e-5, 7e-3, 8e-3],
        );
        assert_eq!(shown(REDUCED.of(&file)), reduced);
        let after = serde_json::json!({"accept": "; free modes: eigenvalues 1e-5, filter roots 1e-3 |lambda|"});
        assert_eq!(REDUCED.of(&after).filters, 1e-3);
        // what a file does not say is as usual
        assert_eq!(shown(REDUCED.of(&Value::Null)), shown(REDUCED));
    }
}
