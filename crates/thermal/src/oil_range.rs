//! Whether a lubricant has left the temperatures near which its viscosity is known.

use physics::viscosity::ICE_POINT;
use physics::viscosity::Viscosity;

/// A lubricant that has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeyondData {
    /// Since when, s.
    pub since: f64,
    /// Its temperature where it was farthest outside, °C.
    pub farthest: f64,
    /// When that was, s.
    pub at: f64,
}

/// Takes note of a temperature, °C, at a time, s.
pub fn look(found: &mut Option<BeyondData>, oil: &Viscosity, temperature: f64, time: f64) {
    let beyond = |celsius: f64| oil.beyond(celsius + ICE_POINT);
    let now = beyond(temperature);
    if now <= 0.0 {
        return;
    }
    let found = found.get_or_insert(BeyondData {
        since: time,
        farthest: temperature,
        at: time,
    });
    if now > beyond(found.farthest) {
        (found.farthest, found.at) = (temperature, time);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_instant_and_the_farthest_are_kept() {
        let oil = Viscosity::through((ICE_POINT + 40.0, 32e-6), (ICE_POINT + 100.0, 5.4e-6));
        let oil = oil.unwrap();
        let mut found = None;
        for (time, temperature) in [
            (1.0, 10.0),
            (2.0, 130.0),
            (3.0, 140.0),
            (4.0, 0.0),
            (5.0, 131.0),
        ] {
            look(&mut found, &oil, temperature, time);
        }
        let (since, farthest, at) = (3.0, 140.0, 3.0);
        assert_eq!(
            found,
            Some(BeyondData {
                since,
                farthest,
                at
            })
        );
    }
}
