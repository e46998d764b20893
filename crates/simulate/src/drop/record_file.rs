//! Records over time from a file: accelerations of the base, forces on the rotor.

use crate::bearing::loss::table;
use model::table::Table;
use problem::{Code, Result};
use recording::unit::si_factor;
use recording::{Channel, Clock, FileError, Recording};
use scenario::{Force, STANDARD_GRAVITY, problem_at};
use std::path::Path;

/// Before and after a record there is nothing: what it records gets there in this time, s.
const EDGE: f64 = 1e-6;
/// Largest number of a record: sums and slopes of what is beyond have no finite value.
const LARGEST: f64 = 1e100;

/// The sum of records, each zero outside its rows.
pub(super) fn sum(records: &[Vec<[f64; 2]>]) -> Table {
    let tables: Vec<Table> = (records.iter())
        .filter_map(|rows| {
            let (first, last) = (rows.first()?, rows.last()?);
            let edges = [(first[0] - EDGE, 0.0), (last[0] + EDGE, 0.0)];
            let mut points: Vec<_> = rows.iter().map(|[time, value]| (*time, *value)).collect();
            if first[1] != 0.0 {
                points.insert(0, edges[0]);
            }
            if last[1] != 0.0 {
                points.push(edges[1]);
            }
            // a start far away may round times to one
            points.dedup_by(|next, before| next.0 <= before.0);
            Some(Table::through(points).expect("times of a record rise"))
        })
        .collect();
    let mut times: Vec<f64> = (tables.iter())
        .flat_map(|table| table.points().iter().map(|point| point.0))
        .collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let value = |time: f64| tables.iter().map(|table| table.value(time)).sum();
    let points = times.into_iter().map(|time| (time, value(time))).collect();
    match tables.is_empty() {
        true => Table::constant(0.0),
        false => Table::through(points).expect("times of records rise"),
    }
}

/// A force from outside over time along x and along y, N, and a torque, N m.
pub(super) fn force(given: &Force) -> Result<[Table; 3]> {
    let Some(record) = &given.record else {
        return Ok(given.over_time.each_ref().map(|rows| table(rows, 1.0)));
    };
    let placed = |[time, force]: &[f64; 2]| [time + record.start, record.scale * force];
    let [x, y] = &record.file.channels;
    let channels = [
        (x, "x", "N"),
        (y, "y", "N"),
        (&record.torque, "torque", "N m"),
    ];
    let rows = read(&record.file.path, &record.name, channels)?;
    Ok(rows.map(|rows| sum(&[rows.iter().map(placed).collect()])))
}

/// The records of channels of a file, each with the end of its key and its unit of SI; `table` is where a scenario names them, such as `base`.
pub(super) fn read<const N: usize>(
    path: &Path,
    table: &str,
    channels: [(&Option<String>, &str, &str); N],
) -> Result<[Vec<[f64; 2]>; N]> {
    let of_file = |error: FileError| {
        problem_at(
            Code::MeasurementUnreadable,
            format!("{table}.file"),
            error.to_string(),
            "a file that can be read is needed",
        )
    };
    let mut recording = recording::open(path).map_err(of_file)?;
    let mut records = std::array::from_fn(|_| Vec::new());
    for ((name, key, unit), rows) in channels.iter().zip(&mut records) {
        let Some(name) = name else { continue };
        let key = &format!("{table}.channel_{key}");
        let (index, channel) = recording::find(recording.as_ref(), name).map_err(|why| {
            let found = format!("{}, {}", path.display(), why.found);
            problem_at(Code::UnknownChannel, key, found, why.needed).with_hint(why.hint)
        })?;
        let factor = factor_of(&channel, unit, key)?;
        let values = all(recording.as_mut(), index, channel.count).map_err(of_file)?;
        let times: Vec<f64> = match &channel.clock {
            Clock::Uniform { first, interval } => (0..values.len())
                .map(|k| first + k as f64 * interval)
                .collect(),
            Clock::Channel(clock) => {
                let own = recording.channels()[*clock].clone();
                let factor = factor_of(&own, "s", key)?;
                let times = all(recording.as_mut(), *clock, own.count).map_err(of_file)?;
                times.into_iter().map(|time| time * factor).collect()
            }
            Clock::Unknown => {
                let found = format!("channel \"{name}\" without times");
                let needed = "a file that states them is needed: a column of times, or an interval";
                return Err(problem_at(Code::ChannelClock, key, found, needed));
            }
        };
        let finite = |list: &[f64]| {
            list.iter()
                .position(|value| value.is_nan() || value.abs() > LARGEST)
        };
        if let Some(row) = finite(&values).or(finite(&times)) {
            let found = format!(
                "channel \"{name}\", whose value {} is no number below 1e100",
                row + 1
            );
            let needed = "a number in every row is needed";
            return Err(problem_at(Code::OutOfRange, key, found, needed));
        }
        if let Some(row) = times.windows(2).position(|pair| pair[1] <= pair[0]) {
            let found = format!("channel \"{name}\", whose time {} does not rise", row + 2);
            let needed = "times that rise from row to row are needed";
            return Err(problem_at(Code::TableOrder, key, found, needed));
        }
        if values.len() < 2 {
            let found = format!("channel \"{name}\" with {} values", values.len());
            return Err(problem_at(
                Code::OutOfRange,
                key,
                found,
                "two or more are needed",
            ));
        }
        rows.extend(
            times
                .into_iter()
                .zip(values)
                .map(|(time, value)| [time, value * factor]),
        );
    }
    Ok(records)
}

/// All values of a channel.
fn all(
    recording: &mut dyn Recording,
    channel: usize,
    count: u64,
) -> std::result::Result<Vec<f64>, FileError> {
    let mut values = vec![0.0; count as usize];
    let there = recording.read(channel, 0, &mut values)?;
    values.truncate(there);
    Ok(values)
}

/// What turns the values of a channel into a unit of SI.
fn factor_of(channel: &Channel, unit: &str, key: &str) -> Result<f64> {
    let needed = format!("a unit of the kind of {unit} is needed in the file");
    let found = match channel.unit.as_str() {
        "" => format!("channel \"{}\" without a unit", channel.name),
        own => format!("channel \"{}\" in {own}", channel.name),
    };
    // accelerometers count in g
    match (channel.unit.trim(), unit) {
        ("g", "m/s^2") => Ok(STANDARD_GRAVITY),
        (own, unit) => {
            si_factor(own, unit).ok_or_else(|| problem_at(Code::ChannelUnit, key, found, needed))
        }
    }
}
