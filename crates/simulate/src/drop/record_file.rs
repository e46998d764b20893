//! Records over time from a file: accelerations of the base, forces on the rotor.

use crate::bearing::loss::table;
use model::table::Table;
use problem::{Code, Result};
use recording::over_time::{Unread, Wanted, over_time};
use scenario::{Force, problem_at};
use std::path::Path;

/// Before and after a record there is nothing: what it records gets there in this time, s.
const EDGE: f64 = 1e-6;

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

/// A force from outside over time along x, y and the shaft, N, and a torque, N m.
pub(super) fn force(given: &Force) -> Result<[Table; 4]> {
    let Some(record) = &given.record else {
        return Ok(given.over_time.each_ref().map(|rows| table(rows, 1.0)));
    };
    let placed = |[time, force]: &[f64; 2]| [time + record.start, record.scale * force];
    let [x, y] = &record.file.channels;
    let channels = [
        (x, "x", "N"),
        (y, "y", "N"),
        (&record.along, "z", "N"),
        (&record.torque, "torque", "N m"),
    ];
    let rows = read(&record.file.path, &given.path, channels)?;
    Ok(rows.map(|rows| sum(&[rows.iter().map(placed).collect()])))
}

/// The records of channels of a file, each with the end of its key and its unit of SI; `table` is where a scenario names them, such as `base`.
pub(super) fn read<const N: usize>(
    path: &Path,
    table: &str,
    channels: [(&Option<String>, &str, &str); N],
) -> Result<[Vec<[f64; 2]>; N]> {
    let refused = |key: &str, why: Unread| {
        let key = match why.code {
            Code::MeasurementUnreadable => format!("{table}.file"),
            _ => format!("{table}.channel_{key}"),
        };
        problem_at(why.code, key, why.found, why.needed).with_hint(why.hint)
    };
    let mut recording = recording::open(path).map_err(|error| refused("", error.into()))?;
    let mut records = std::array::from_fn(|_| Vec::new());
    for ((name, key, unit), rows) in channels.iter().zip(&mut records) {
        let Some(name) = name else { continue };
        let wanted = Wanted {
            unit,
            own: None,
            scale: 1.0,
        };
        *rows = over_time(recording.as_mut(), name, wanted).map_err(|why| refused(key, why))?;
    }
    Ok(records)
}
