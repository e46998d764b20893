//! Needed friction of dry backward whirl over frequency: bands, minima and crossings, found between samples and refined.

use crate::C64;
use physics::dry_whirl::{WhirlContact, needed_friction};
use std::ops::Range;

/// Whirl of one frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WhirlPoint {
    /// Frequency, rad/s.
    pub frequency: f64,
    /// Friction that it needs.
    pub friction: f64,
    /// Its contact force, N.
    pub force: f64,
}

/// The whirl that needs least friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmallestFriction {
    /// That whirl.
    pub point: WhirlPoint,
    /// Whether it is an end of its band, and no minimum of the curve.
    pub at_end: bool,
}

/// Frequencies in which a friction coefficient exceeds the needed one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WhirlRange {
    /// Lower end, rad/s: slower whirl is braked.
    pub from: f64,
    /// Upper end, rad/s.
    pub to: f64,
    /// Full slip settles at the upper end; none where the band of whirl ends there.
    pub settles: Option<WhirlPoint>,
}

/// Needed friction over frequency, of a rotor and a race by their receptance.
pub struct WhirlCurve<'a> {
    contact: WhirlContact,
    /// Rising frequencies, rad/s.
    frequencies: Vec<f64>,
    /// Whirl at each of them; none where no friction drives it.
    points: Vec<Option<WhirlPoint>>,
    receptance: &'a dyn Fn(f64) -> Option<C64>,
}

fn point(contact: &WhirlContact, frequency: f64, alpha: C64) -> Option<WhirlPoint> {
    Some(WhirlPoint {
        frequency,
        friction: needed_friction(alpha.re, alpha.im)?,
        force: contact.normal_force(alpha.re, alpha.im)?,
    })
}

impl<'a> WhirlCurve<'a> {
    /// From samples of rising frequency (rad/s) with the receptance α of rotor and race for motion e^{-jωt} (m/N), and α at any other.
    #[must_use]
    pub fn new(
        contact: WhirlContact,
        sampled: Vec<(f64, C64)>,
        receptance: &'a dyn Fn(f64) -> Option<C64>,
    ) -> Self {
        let points = sampled
            .iter()
            .map(|(at, alpha)| point(&contact, *at, *alpha));
        Self {
            points: points.collect(),
            frequencies: sampled.into_iter().map(|(at, _)| at).collect(),
            contact,
            receptance,
        }
    }

    /// The samples; friction and force are no numbers where no friction drives whirl.
    #[must_use]
    pub fn points(&self) -> Vec<WhirlPoint> {
        let each = self.frequencies.iter().zip(&self.points);
        let shown = each.map(|(frequency, point)| {
            point.unwrap_or(WhirlPoint {
                frequency: *frequency,
                friction: f64::NAN,
                force: f64::NAN,
            })
        });
        shown.collect()
    }

    /// Whirl between the samples.
    #[must_use]
    pub fn between(&self, frequency: f64) -> Option<WhirlPoint> {
        point(&self.contact, frequency, (self.receptance)(frequency)?)
    }

    /// Ranges of samples in which some friction drives whirl.
    #[must_use]
    pub fn bands(&self) -> Vec<Range<usize>> {
        runs(self.points.iter().map(Option::is_some))
    }

    /// The last frequency at which a property holds between one where it does and one where it does not.
    fn edge(&self, holds: f64, fails: f64, property: &dyn Fn(&WhirlPoint) -> bool) -> f64 {
        let (mut holds, mut fails) = (holds, fails);
        while (fails - holds).abs() > 1e-11 * holds {
            let middle = 0.5 * (holds + fails);
            match self.between(middle).filter(|own| property(own)) {
                Some(_) => holds = middle,
                None => fails = middle,
            }
        }
        holds
    }

    /// The whirl of least friction between two frequencies, to a share of them, by the golden ratio.
    fn least(&self, [mut low, mut high]: [f64; 2], share: f64) -> Option<WhirlPoint> {
        let ratio = 0.5 * (5f64.sqrt() - 1.0);
        let of = |x: f64| self.between(x).map_or(f64::INFINITY, |own| own.friction);
        let mut inner = [high - ratio * (high - low), low + ratio * (high - low)];
        let mut found = inner.map(of);
        while high - low > share * low {
            if found[0] < found[1] {
                (high, inner[1], found[1]) = (inner[1], inner[0], found[0]);
                inner[0] = high - ratio * (high - low);
                found[0] = of(inner[0]);
            } else {
                (low, inner[0], found[0]) = (inner[0], inner[1], found[1]);
                inner[1] = low + ratio * (high - low);
                found[1] = of(inner[1]);
            }
        }
        self.between(0.5 * (low + high))
    }

    /// The whirl that needs least friction, its frequency to a share of it; none where no friction drives whirl.
    #[must_use]
    pub fn smallest(&self, share: f64) -> Option<SmallestFriction> {
        self.smallest_in(0..self.points.len(), share)
    }

    /// The same of a range of samples.
    #[must_use]
    pub fn smallest_in(&self, samples: Range<usize>, share: f64) -> Option<SmallestFriction> {
        let of = |k: usize| self.points.get(k).copied().flatten();
        let whirls = |k: &usize| of(*k).is_some();
        let friction = |k: &usize| of(*k).map_or(f64::INFINITY, |own| own.friction);
        let lowest = samples.filter(whirls);
        let k = lowest.min_by(|a, b| friction(a).total_cmp(&friction(b)))?;
        let here = self.frequencies[k];
        let near = [k.checked_sub(1), Some(k + 1)];
        let near = near.map(|next| next.filter(|next| *next < self.points.len()));
        // the band reaches to a neighbour, between two samples, or to the end of the samples
        let reach = near.map(|next| match next {
            Some(next) if whirls(&next) => self.frequencies[next],
            Some(next) => self.edge(here, self.frequencies[next], &|_| true),
            None => here,
        });
        let inner = self.least(reach, share);
        let ends = [0, 1]
            .into_iter()
            .filter(|side| !near[*side].is_some_and(|next| whirls(&next)));
        let ends = ends.filter_map(|side| self.between(reach[side]));
        let end = ends.min_by(|a, b| a.friction.total_cmp(&b.friction));
        // towards an end that is the lowest the search comes down to it, and never below
        let above =
            |end: &WhirlPoint| inner.is_none_or(|own| own.friction >= end.friction * (1.0 - 1e-9));
        let at_end = end.filter(above);
        let best = at_end.or(inner).or(of(k))?;
        Some(SmallestFriction {
            point: best,
            at_end: at_end.is_some(),
        })
    }

    /// Ranges in which a friction coefficient exceeds the needed one, with their ends refined.
    #[must_use]
    pub fn ranges(&self, friction: f64) -> Vec<WhirlRange> {
        let driven = |own: &WhirlPoint| own.friction < friction;
        let inside = self
            .points
            .iter()
            .map(|own| own.is_some_and(|own| driven(&own)));
        let range = |samples: Range<usize>| {
            let [first, last] = [samples.start, samples.end - 1].map(|k| self.frequencies[k]);
            let before = samples.start.checked_sub(1).map(|k| self.frequencies[k]);
            let after = self.frequencies.get(samples.end).copied();
            let from = before.map_or(first, |fails| self.edge(first, fails, &driven));
            let to = after.map_or(last, |fails| self.edge(last, fails, &driven));
            // where whirl ceases at any friction, the needed one does not rise through this one
            let crossed = after.is_some() && self.between(to * (1.0 + 1e-8)).is_some();
            WhirlRange {
                from,
                to,
                settles: self.between(to).filter(|_| crossed),
            }
        };
        let mut found: Vec<WhirlRange> = runs(inside).into_iter().map(range).collect();
        // a minimum between two samples that both need more
        let least = self.smallest(1e-9).map(|own| own.point);
        let least = least.filter(|own| found.is_empty() && driven(own));
        found.extend(least.map(|own| {
            let k = (self.frequencies).partition_point(|at| *at < own.frequency);
            let near = |k: Option<usize>| k.and_then(|k| self.frequencies.get(k)).copied();
            let end = |at: Option<f64>| {
                at.map_or(own.frequency, |at| self.edge(own.frequency, at, &driven))
            };
            let (from, to) = (end(near(k.checked_sub(1))), end(near(Some(k))));
            let crossed = self.between(to * (1.0 + 1e-8)).is_some();
            WhirlRange {
                from,
                to,
                settles: self.between(to).filter(|_| crossed),
            }
        }));
        found
    }
}

/// Ranges in which flags are set.
fn runs(flags: impl Iterator<Item = bool>) -> Vec<Range<usize>> {
    let mut out: Vec<Range<usize>> = Vec::new();
    for (k, _) in flags.enumerate().filter(|(_, set)| *set) {
        match out.last_mut() {
            Some(last) if last.end == k => last.end = k + 1,
            _ => out.push(k..k + 1),
        }
    }
    out
}
