//! Channels from memory, written as a file that every reader of measurements takes.

use auxbear::recording::file;
use auxbear::recording::{Channel, Clock, FileError};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use std::path::PathBuf;

/// Name, unit and values of each channel; without an interval the file states no clock.
#[pyfunction]
pub fn write_recording(
    path: PathBuf,
    channels: Vec<(String, String, PyReadonlyArray1<'_, f64>)>,
    interval: Option<f64>,
    first: f64,
) -> PyResult<()> {
    let refused = |error: FileError| PyOSError::new_err(error.to_string());
    let told: Vec<Channel> = (channels.iter())
        .map(|(name, unit, values)| Channel {
            unit: unit.clone(),
            clock: match interval {
                Some(interval) => Clock::Uniform { first, interval },
                None => Clock::Unknown,
            },
            ..Channel::new(name, values.len().unwrap_or(0) as u64)
        })
        .collect();
    let mut writer = file::create(&path, &told).map_err(refused)?;
    let values = (channels.iter())
        .map(|(_, _, values)| Ok(values.as_slice()?))
        .collect::<PyResult<Vec<&[f64]>>>()?;
    writer.append(&values).map_err(refused)?;
    writer.finish().map_err(refused)
}
