//! Clocks of the columns of a text.

use std::io::{Read, Seek};

use super::Csv;
use super::layout::Kind;
use crate::file::clock::{self, Spacing};
use crate::{Clock, Content, Note};

impl<S: Read + Seek> Csv<S> {
    pub(super) fn set_clock(&mut self, time: Option<usize>, spacing: &Spacing, back_line: u64) {
        if self.layout.labview {
            self.set_labview_clocks(time, spacing);
            return;
        }
        let Some(time) = time else {
            let properties = std::mem::take(&mut self.layout.properties);
            let (clocks, notes) = clock::clocks(self, &properties, &[]);
            for (channel, clock) in clocks {
                self.channels[channel].clock = clock;
            }
            self.notes.extend(notes);
            return;
        };
        let name = self.channels[time].name.clone();
        let mut note = |text: String| {
            self.notes.push(Note::of(&name, text));
        };
        let is_moment = self.layout.columns[time].kind == Kind::Moment;
        let unit = if is_moment {
            "s"
        } else {
            &self.channels[time].unit
        };
        if let Some((_, times)) = spacing.back {
            note(format!(
                "{times} times are not after the one before, the first in line {back_line}"
            ));
        }
        if clock::seconds_in(unit).is_none() {
            note("is a time by its name, but its unit is not stated".to_string());
        }
        let clock = spacing.clock(time, unit);
        let start = self.starts[time];
        for channel in &mut self.channels {
            channel.clock = clock.clone();
            channel.start = start;
        }
        for (channel, start) in self.channels.iter_mut().zip(&self.starts) {
            if channel.content == Content::Time {
                channel.unit = "s".to_string();
                channel.start = *start;
            }
        }
        if let Clock::Uniform { .. } = clock {
            return;
        }
        if spacing.missing > 0 {
            self.notes.push(Note::of(
                &name,
                format!("{} times are not numbers", spacing.missing),
            ));
        }
    }

    /// Clocks of a file of LabVIEW: one column of times for all, one for each channel, or what its head states of each.
    fn set_labview_clocks(&mut self, time: Option<usize>, spacing: &Spacing) {
        let alone = self.layout.columns.iter().filter(|c| c.time).count() == 1;
        let mut own = None;
        for k in 0..self.channels.len() {
            let column = &self.layout.columns[k];
            own = if column.time { Some(k) } else { own };
            let stated = column.steps.filter(|_| self.heads == 0);
            self.channels[k].clock = match (alone.then_some(time).flatten(), stated, own) {
                (Some(time), ..) => spacing.clock(time, &self.layout.columns[time].unit),
                (None, Some((first, interval)), _) => Clock::Uniform { first, interval },
                (None, None, Some(own)) => Clock::Channel(own),
                (None, None, None) => Clock::Unknown,
            };
        }
        if self.heads > 0 {
            self.notes.push(Note::of_file(format!(
                "{} more heads stand between the values; the columns are named by the first",
                self.heads
            )));
        }
        if let Some(time) = time.filter(|_| alone) {
            self.notes
                .extend(spacing.notes(&self.layout.columns[time].name));
        }
    }
}
