//! Checks of the slow state of the lubricant.

use crate::bearing::Bearing;
use crate::bearing::kind::Fidelity;
use crate::bearing::moment::Moment;
use crate::checks::{Check, Context};
use problem::Code;

/// Shortest time in which a slow state changes, s: the largest step that a run takes unless asked for longer ones.
const SHORTEST: f64 = 1e-3;

impl Context<'_> {
    /// Something that the state acts on, and times that are slow.
    pub fn lubricant_state(&self, bearing: &Bearing) -> Check {
        let Some(state) = &bearing.lubricant_state else {
            return Ok(());
        };
        let refuse = |code: Code, path: &str, found: String, allowed: String| {
            self.refuse(code, path, found, allowed)
        };
        let without_moment = bearing.moment == Moment::None;
        let no_traction = bearing.fidelity == Fidelity::Rolling || state.films.is_none();
        if without_moment && (state.grease.is_some() || no_traction) {
            let path = "bearing.lubricant_state.kind";
            let found = format!(
                "\"{}\" in a bearing with bearing.moment.law = \"none\"",
                self.text(path)
            );
            let allowed = "a law of the friction moment is needed, which the state of the lubricant multiplies, e.g. bearing.moment.law = \"palmgren\"";
            return refuse(Code::Conflict, path, found, allowed.to_string());
        }
        let slow = format!(
            "at least {} ms is needed: what changes faster is no slow state",
            1e3 * SHORTEST
        );
        if let Some(grease) = &state.grease {
            for (path, time) in [
                (
                    "bearing.lubricant_state.breakdown_time",
                    grease.breakdown_time,
                ),
                (
                    "bearing.lubricant_state.recovery_time",
                    grease.recovery_time,
                ),
            ] {
                if time < SHORTEST {
                    return refuse(Code::Impossible, path, self.text(path), slow);
                }
            }
        }
        if let Some(films) = &state.films
            && films.time_constant() < SHORTEST
        {
            let path = self.blamed(&[
                "bearing.lubricant_state.film_heat_capacity",
                "bearing.lubricant_state.film_conductance",
            ]);
            let found = format!(
                "{}, by which films warm within {:.3e} ms",
                self.text(path),
                1e3 * films.time_constant()
            );
            return refuse(Code::Impossible, path, found, slow);
        }
        Ok(())
    }
}
