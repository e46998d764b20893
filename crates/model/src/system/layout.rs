//! Where everything stands in the state of a system: named blocks, then the ledger.
//!
//! ```text
//!   blocks    bodies and the states of the parts, each under its name
//!   ledger    heats, works of the sources, external angular impulses, works by the moments on the races
//! ```
//! A layout is built once for each machine. Systems keep where their blocks start in a struct of indices beside it. Heats, sources
//! and names carry the name of their part; a part without a name, as the only bearing of a machine, has no prefix.

use crate::bearing::BearingConstants;
use crate::body::BodyAt;
use std::ops::Range;

/// One kind of heat, source, impulse or work of one part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Name of the part, empty for the machine as a whole and for an only part.
    pub part: String,
    /// Kind, as in results.
    pub kind: &'static str,
}

/// A name with its part before it: `drive_end.first_impact_force`, without a part the name alone.
pub fn of_part(part: &str, name: &str) -> String {
    if part.is_empty() {
        name.to_string()
    } else {
        format!("{part}.{name}")
    }
}

/// Named blocks of a state, and the ledger behind them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// Names of the channels before the ledger.
    names: Vec<String>,
    heats: Vec<Entry>,
    sources: Vec<Entry>,
    impulses: Vec<Entry>,
    works: Vec<Entry>,
}

impl Layout {
    /// Adds a body of that name, of a part; where it stands, from its first channel on.
    pub fn body(&mut self, part: &str, name: &str, at: fn(usize) -> BodyAt) -> BodyAt {
        let body = at(self.names.len());
        self.block(part, body.names(name));
        body
    }
    /// Adds a block of channels with these names after a part's; returns where it stands.
    pub fn block(&mut self, part: &str, names: impl IntoIterator<Item = String>) -> Range<usize> {
        let start = self.names.len();
        self.names
            .extend(names.into_iter().map(|name| of_part(part, &name)));
        start..self.names.len()
    }
    /// Adds the states of a bearing; returns where they stand.
    pub fn bearing(&mut self, part: &str, bearing: &BearingConstants) -> Range<usize> {
        let states = (0..bearing.states()).map(|state| bearing.state_name(state));
        self.block(part, states.map(|name| format!("bearing.{name}")))
    }
    /// Adds kinds of heat of a part; returns the place of the first among all heats.
    pub fn heats_of(&mut self, part: &str, kinds: impl IntoIterator<Item = &'static str>) -> usize {
        add(&mut self.heats, part, kinds)
    }
    /// Adds sources of a part; returns the place of the first among all sources.
    pub fn sources_of(
        &mut self,
        part: &str,
        kinds: impl IntoIterator<Item = &'static str>,
    ) -> usize {
        add(&mut self.sources, part, kinds)
    }
    /// Adds external angular impulses: that of the system first.
    pub fn impulses_of(&mut self, part: &str, kinds: impl IntoIterator<Item = &'static str>) {
        add(&mut self.impulses, part, kinds);
    }
    /// Adds works by the moments on the races.
    pub fn works_of(&mut self, part: &str, kinds: impl IntoIterator<Item = &'static str>) {
        add(&mut self.works, part, kinds);
    }

    /// Kinds of heat, in the order of their channels.
    pub fn heats(&self) -> &[Entry] {
        &self.heats
    }
    /// Kinds of source, in the order of their channels.
    pub fn sources(&self) -> &[Entry] {
        &self.sources
    }
    /// First channel of the ledger.
    #[inline(always)]
    pub fn ledger(&self) -> usize {
        self.names.len()
    }
    /// Number of channels of the ledger.
    pub fn ledger_length(&self) -> usize {
        self.heats.len() + self.sources.len() + self.impulses.len() + self.works.len()
    }
    /// Number of channels.
    #[inline(always)]
    pub fn dimension(&self) -> usize {
        self.ledger() + self.ledger_length()
    }
    /// Channel of a heat by its place among all.
    #[inline(always)]
    pub fn heat(&self, index: usize) -> usize {
        self.ledger() + index
    }
    /// What a kind of heat of a part has summed up in a state, J, or its rate, W; none where there is no such heat.
    pub fn heat_of(&self, state: &[f64], part: &str, kind: &str) -> Option<f64> {
        let is = |heat: &Entry| heat.kind == kind && heat.part == part;
        Some(state[self.heat(self.heats.iter().position(is)?)])
    }
    /// Channel of the work of a source by its place among all.
    #[inline(always)]
    pub fn source(&self, index: usize) -> usize {
        self.heat(self.heats.len()) + index
    }
    /// Channel of the external angular impulse of the system.
    #[inline(always)]
    pub fn angular_impulse(&self) -> usize {
        self.source(self.sources.len())
    }
    /// Channels of the heats, of the works of the sources, and of the external angular impulse of the system.
    pub fn flows(&self) -> Range<usize> {
        self.heat(0)..self.angular_impulse() + 1
    }
    /// Channel of a work by the moments on the races, by its place among all.
    #[inline(always)]
    pub fn work(&self, index: usize) -> usize {
        self.angular_impulse() + self.impulses.len() + index
    }
    /// Channel of a name; none where there is no such channel.
    pub fn channel(&self, name: &str) -> Option<usize> {
        (0..self.dimension()).find(|channel| self.channel_name(*channel) == name)
    }
    /// Name of a channel.
    pub fn channel_name(&self, channel: usize) -> String {
        let named =
            |what: &str, entry: &Entry| of_part(&entry.part, &format!("{what}.{}", entry.kind));
        match channel {
            c if c < self.ledger() => self.names[c].clone(),
            c if c < self.source(0) => named("energy.heat", &self.heats[c - self.heat(0)]),
            c if c < self.angular_impulse() => {
                named("energy.source", &self.sources[c - self.source(0)])
            }
            c if c < self.work(0) => named(
                "angular_momentum",
                &self.impulses[c - self.angular_impulse()],
            ),
            c => named("energy.work", &self.works[c - self.work(0)]),
        }
    }
}

fn add(
    entries: &mut Vec<Entry>,
    part: &str,
    kinds: impl IntoIterator<Item = &'static str>,
) -> usize {
    let first = entries.len();
    entries.extend(kinds.into_iter().map(|kind| Entry {
        part: part.to_string(),
        kind,
    }));
    first
}
