//! What a thermocouple reads of an outer race whose temperature a network has given.
//!
//! ```text
//!   Ṫ_m = (T − T_m)/τ      T = T_0 + a s straight between known instants
//!   T_m = T − a τ + (T_m0 − T_0 + a τ) exp(−s/τ)
//! ```

/// Reading over time.
#[derive(Clone, Debug)]
pub(crate) struct Bead {
    lag: f64,
    /// Instants, s, with the temperature and its reading, K.
    known: Vec<[f64; 3]>,
}

impl Bead {
    /// Of a lag τ, s, at the temperature of the first instant.
    pub fn new(lag: f64, temperatures: impl Iterator<Item = (f64, f64)>) -> Self {
        let mut bead = Bead {
            lag,
            known: Vec::new(),
        };
        for (time, temperature) in temperatures {
            let last = bead.known.last().copied();
            let reading = last.map_or(temperature, |last| {
                bead.within(last, [time, temperature], time)
            });
            bead.known.push([time, temperature, reading]);
        }
        bead
    }

    /// Reading at an instant, K: what is known last from there on.
    pub fn at(&self, time: f64) -> f64 {
        let next = self.known.partition_point(|known| known[0] < time);
        let before = next.checked_sub(1).map(|last| self.known[last]);
        match (before, self.known.get(next)) {
            (Some(from), Some(to)) => self.within(from, [to[0], to[1]], time),
            (None, Some(first)) => first[2],
            (Some(last), None) => last[2],
            (None, None) => f64::NAN,
        }
    }

    fn within(&self, [start, from, reading]: [f64; 3], [end, to]: [f64; 2], time: f64) -> f64 {
        let slope = (to - from) / (end - start);
        let past = time - start;
        let behind = slope * self.lag;
        from + slope * past - behind + (reading - from + behind) * (-past / self.lag).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_is_read_behind_by_its_lag() {
        let bead = Bead::new(2.0, [(0.0, 20.0), (1.0, 23.0), (40.0, 140.0)].into_iter());
        assert_eq!(bead.at(0.0), 20.0);
        // a ramp of 3 K/s through an instant that is known: T_m = 20 + 3 (t − τ (1 − e^{−t/τ}))
        for time in [0.3, 1.0, 5.0, 40.0] {
            let closed = 20.0 + 3.0 * (time - 2.0 * (1.0 - f64::exp(-time / 2.0)));
            assert!((bead.at(time) - closed).abs() < 1e-12, "{time}");
        }
        assert_eq!(bead.at(50.0), bead.at(40.0));
    }
}
