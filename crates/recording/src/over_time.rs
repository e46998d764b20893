//! A channel over time: rows of time and value in SI, for whoever compares or applies a record.

use crate::unit::{speed_factor, unit_of};
use crate::{Clock, FileError, Recording, find};
use problem::Code;
use units::{STANDARD_GRAVITY, Unit};

/// Largest number of a record: sums and slopes of what is beyond have no finite value.
const LARGEST: f64 = 1e100;

/// In which unit a channel is wanted.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<'a> {
    /// Unit of SI; `1` of a ratio.
    pub unit: &'a str,
    /// The unit of the values, where it is not that of the file.
    pub own: Option<&'a str>,
    /// Factor on the values of the file.
    pub scale: f64,
}

/// Why a channel cannot be read over time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unread {
    /// What kind of wrong input it is; `MeasurementUnreadable` where the file is.
    pub code: Code,
    /// What was found.
    pub found: String,
    /// What is needed.
    pub needed: String,
    /// A name that may be meant.
    pub hint: Option<String>,
    /// Whether it concerns the times of the channel, not its values.
    pub of_clock: bool,
}

impl From<FileError> for Unread {
    fn from(error: FileError) -> Unread {
        let needed = "a file that can be read is needed";
        unread(Code::MeasurementUnreadable, error.to_string(), needed)
    }
}

fn unread(code: Code, found: String, needed: impl Into<String>) -> Unread {
    Unread {
        code,
        found,
        needed: needed.into(),
        hint: None,
        of_clock: false,
    }
}

/// Rows of time, s, and value, SI, of the channel of a name.
///
/// # Errors
/// No such channel, no clock, a unit of another kind, a value that is no number, times that do not rise, fewer than two values.
pub fn over_time(
    recording: &mut dyn Recording,
    name: &str,
    wanted: Wanted,
) -> Result<Vec<[f64; 2]>, Unread> {
    let (index, channel) = find(recording, name).map_err(|why| Unread {
        hint: why.hint,
        ..unread(
            Code::UnknownChannel,
            format!("{}, {}", recording.path().display(), why.found),
            why.needed,
        )
    })?;
    let [offset, factor] = converted(name, &channel.unit, wanted)?;
    let values = all(recording, index, channel.count)?;
    let times: Vec<f64> = match &channel.clock {
        Clock::Uniform { first, interval } => (0..values.len())
            .map(|k| first + k as f64 * interval)
            .collect(),
        Clock::Channel(clock) => {
            let own = recording.channels()[*clock].clone();
            let seconds = Wanted {
                unit: "s",
                own: None,
                scale: 1.0,
            };
            let of_clock = |why: Unread| Unread {
                needed: format!(
                    "the unit of the times in the file is needed, e.g. {} [s]",
                    own.name
                ),
                of_clock: true,
                ..why
            };
            let [_, second] = converted(&own.name, &own.unit, seconds).map_err(of_clock)?;
            let times = all(recording, *clock, own.count)?;
            times.into_iter().map(|time| time * second).collect()
        }
        Clock::Unknown => {
            let found = format!("channel \"{name}\" without times");
            let needed = "a file that states them is needed: a column of times, or an interval";
            return Err(unread(Code::ChannelClock, found, needed));
        }
    };
    let beyond = |list: &[f64]| {
        list.iter()
            .position(|value| value.is_nan() || value.abs() > LARGEST)
    };
    if let Some(row) = beyond(&values).or(beyond(&times)) {
        // readers of texts note the line
        let own = recording.notes().iter();
        let mut own = own.filter(|note| note.channel.as_deref().is_none_or(|own| own == name));
        let note = own
            .next()
            .map_or(String::new(), |note| format!(" ({})", note.text));
        let found = format!(
            "channel \"{name}\", whose value {} is no number below 1e100{note}",
            row + 1
        );
        let needed = "a number in every row is needed";
        return Err(unread(Code::OutOfRange, found, needed));
    }
    if let Some(row) = times.windows(2).position(|pair| pair[1] <= pair[0]) {
        let found = format!("channel \"{name}\", whose time {} does not rise", row + 2);
        let needed = "times that rise from row to row are needed";
        return Err(unread(Code::TableOrder, found, needed));
    }
    if values.len() < 2 {
        let found = format!("channel \"{name}\" with {} values", values.len());
        return Err(unread(Code::OutOfRange, found, "two or more are needed"));
    }
    let rows = times.into_iter().zip(values);
    Ok(rows
        .map(|(time, value)| [time, value * factor + offset])
        .collect())
}

/// All values of a channel.
fn all(recording: &mut dyn Recording, channel: usize, count: u64) -> Result<Vec<f64>, FileError> {
    let mut values = vec![0.0; count as usize];
    let there = recording.read(channel, 0, &mut values)?;
    values.truncate(there);
    Ok(values)
}

/// Offset and factor that turn values of a unit as files write it into one of SI.
fn to_si(text: &str, unit: &str) -> Option<[f64; 2]> {
    match (text, unit) {
        ("g", "m/s^2") => Some([0.0, STANDARD_GRAVITY]),
        ("", "1") => Some([0.0, 1.0]),
        (text, "rad/s") => speed_factor(text).map(|factor| [0.0, factor]),
        (text, unit) => unit_of(text, unit).map(|unit| {
            let zero = unit.to_si(0.0);
            [zero, unit.to_si(1.0) - zero]
        }),
    }
}

/// Offset and factor that turn the values of a channel into those wanted.
fn converted(name: &str, file: &str, wanted: Wanted) -> Result<[f64; 2], Unread> {
    let Wanted { unit, own, scale } = wanted;
    // a sensor's voltage or current may stand for anything, a length in the file not for a speed
    let fits = |file: &str| [unit, "V", "A"].iter().any(|si| to_si(file, si).is_some());
    let contradicts = Unit::parse(file).is_ok() && !fits(file.trim());
    let text = own.filter(|_| !contradicts).unwrap_or(file).trim();
    let found = || match text {
        "" => format!("channel \"{name}\" without a unit"),
        text => format!("channel \"{name}\" in {text}"),
    };
    let place = if own.is_some() { "" } else { " in the file" };
    let needed = || format!("a unit of the kind of {unit} is needed{place}");
    let refused = || unread(Code::ChannelUnit, found(), needed());
    if let Some(given) = own
        && let (Some(one), Some(other)) = (to_si(file.trim(), unit), to_si(given.trim(), unit))
        && !file.trim().is_empty()
        && one != other
    {
        let found = format!("channel \"{name}\" in {}, and {given}", file.trim());
        let needed = "one of the two units is needed: without the key that of the file counts";
        return Err(unread(Code::ChannelUnit, found, needed.to_string()));
    }
    let [offset, factor] = to_si(text, unit).ok_or_else(refused)?;
    Ok([offset, factor * scale])
}
