//! Channels by their names.

use crate::{Channel, Content, Recording};
use problem::did_you_mean;

/// Why a recording has no channel of numbers of a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoChannel {
    /// What was found, after the name of the file.
    pub found: String,
    /// What is needed.
    pub needed: String,
    /// A name that may be meant, and what of the file was not read.
    pub hint: Option<String>,
}

/// The channel of a name, which holds numbers, with its index. `name#2` is the second of that name; a name without its group serves where only one
/// channel has it.
///
/// # Errors
/// No channel or several of the name; one of texts, or without values.
pub fn find(recording: &dyn Recording, name: &str) -> Result<(usize, Channel), NoChannel> {
    let refuse = |found: String, needed: String, hint| {
        Err(NoChannel {
            found,
            needed,
            hint,
        })
    };
    let channels = recording.channels();
    let alike = || (0..channels.len()).filter(|k| channels[*k].name == name);
    if let (Some(first), Some(second)) = (alike().next(), alike().nth(1)) {
        let found = format!(
            "which has {} channels \"{name}\", the first two as numbers {} and {} of {}",
            alike().count(),
            first + 1,
            second + 1,
            channels.len()
        );
        let needed =
            format!("which of them is needed: \"{name}#1\" is the first, \"{name}#2\" the second");
        return refuse(found, needed, None);
    }
    let exact = alike().next().or_else(|| {
        let (name, place) = name.rsplit_once('#')?;
        let place = place.parse::<usize>().ok()?.checked_sub(1)?;
        (0..channels.len())
            .filter(|k| channels[*k].name == name)
            .nth(place)
    });
    // a name without its group, where only one channel has it
    let mut ends = channels.iter().enumerate().filter(|(_, channel)| {
        let end = channel.name.strip_suffix(name);
        end.is_some_and(|start| start.ends_with('/'))
    });
    let only = match (ends.next(), ends.next()) {
        (Some((index, _)), None) => Some(index),
        _ => None,
    };
    let Some(index) = exact.or(only) else {
        let names = || channels.iter().map(|channel| channel.name.as_str());
        let mut known: Vec<String> = names().take(12).map(|name| format!("\"{name}\"")).collect();
        if channels.len() > known.len() {
            known.push(format!("{} more", channels.len() - known.len()));
        }
        let needed = match known.len() {
            0 => "a file with channels is needed".to_string(),
            _ => format!("it has the channels {}", known.join(", ")),
        };
        let hints = [did_you_mean(name, names()), unread(recording, name)];
        let hints: Vec<String> = hints.into_iter().flatten().collect();
        let hint = (!hints.is_empty()).then(|| hints.join(" "));
        return refuse(format!("which has no channel \"{name}\""), needed, hint);
    };
    let channel = channels[index].clone();
    let found = match (channel.content, channel.count) {
        (Content::Text, _) => "whose values are texts",
        (_, 0) => "which holds no values",
        _ => return Ok((index, channel)),
    };
    let found = format!("channel \"{name}\", {found}");
    let needed = "a channel of numbers is needed".to_string();
    refuse(found, needed, unread(recording, name))
}

/// What the reader found wrong with the file, for a message that misses a channel: of this one first. A file cut by a crash
/// tells it here.
fn unread(recording: &dyn Recording, name: &str) -> Option<String> {
    const TOLD: usize = 3;
    let own = |channel: &Option<String>| {
        let end = |path: &str| path.rsplit('/').next().unwrap_or_default().to_string();
        channel
            .as_ref()
            .is_some_and(|other| end(other) == end(name))
    };
    let mut notes: Vec<_> = recording.notes().iter().collect();
    notes.sort_by_key(|note| !own(&note.channel));
    let first = notes.iter().take(TOLD).map(|note| match &note.channel {
        Some(channel) => format!("{channel} {}", note.text),
        None => note.text.clone(),
    });
    let more = match notes.len().saturating_sub(TOLD) {
        0 => String::new(),
        more => format!("; and {more} more"),
    };
    let told: Vec<String> = first.collect();
    (!told.is_empty()).then(|| format!("What was not read: {}{more}", told.join("; ")))
}
