//! Which columns of a file are channels, and how the values of one are read on.

use std::sync::Arc;

use parquet::basic::{ConvertedType, LogicalType, TimeUnit, Type as Physical};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{DataType, FixedLenByteArray, Int96};
use parquet::errors::ParquetError;
use parquet::schema::types::ColumnDescriptor;

/// What the values of a column are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// Numbers, to be multiplied by a scale.
    Number { scale: f64, unsigned: bool },
    /// Half-precision numbers.
    Half,
    /// Instants, in units of so many to a second.
    Instant { per_second: f64 },
    /// Instants of an old form: nanoseconds of a day, and the day.
    OldInstant,
    /// Texts.
    Text,
}

impl Kind {
    /// What its times are rounded to, s.
    pub(super) fn rounding(&self) -> f64 {
        match self {
            Kind::Instant { per_second } => 1.0 / per_second,
            _ => 0.0,
        }
    }

    /// What a column holds; or why it is left out.
    pub fn of(column: &ColumnDescriptor) -> Result<Kind, &'static str> {
        if column.max_rep_level() > 0 {
            return Err("holds lists");
        }
        let per_second = |unit: &TimeUnit| match unit {
            TimeUnit::MILLIS => 1e3,
            TimeUnit::MICROS => 1e6,
            TimeUnit::NANOS => 1e9,
        };
        let plain = Kind::Number {
            scale: 1.0,
            unsigned: false,
        };
        let logical = column.logical_type_ref();
        // Files of old writers state only the kind that was converted.
        let old_instant = match column.converted_type() {
            ConvertedType::TIMESTAMP_MILLIS => Some(1e3),
            ConvertedType::TIMESTAMP_MICROS => Some(1e6),
            _ => None,
        };
        if let (None, Some(per_second), Physical::INT64) =
            (logical, old_instant, column.physical_type())
        {
            return Ok(Kind::Instant { per_second });
        }
        match (column.physical_type(), logical) {
            (Physical::INT64, Some(LogicalType::Timestamp(stamp))) => Ok(Kind::Instant {
                per_second: per_second(&stamp.unit),
            }),
            (Physical::INT32 | Physical::INT64, Some(LogicalType::Time(time))) => {
                Ok(Kind::Number {
                    scale: 1.0 / per_second(&time.unit),
                    unsigned: false,
                })
            }
            (Physical::INT32, Some(LogicalType::Date)) => Ok(Kind::Instant {
                per_second: 1.0 / 86_400.0,
            }),
            (Physical::INT32 | Physical::INT64, Some(LogicalType::Decimal(decimal))) => {
                Ok(Kind::Number {
                    scale: 10f64.powi(decimal.scale.saturating_neg().clamp(-300, 300)),
                    unsigned: false,
                })
            }
            (Physical::INT32 | Physical::INT64, Some(LogicalType::Integer(whole))) => {
                Ok(Kind::Number {
                    scale: 1.0,
                    unsigned: !whole.is_signed,
                })
            }
            (Physical::INT96, _) => Ok(Kind::OldInstant),
            (Physical::FIXED_LEN_BYTE_ARRAY, Some(LogicalType::Float16)) => Ok(Kind::Half),
            (Physical::BYTE_ARRAY, Some(LogicalType::Decimal(_))) => Err("holds long decimals"),
            (Physical::BYTE_ARRAY, Some(LogicalType::String | LogicalType::Enum)) => Ok(Kind::Text),
            (Physical::BYTE_ARRAY, _) if column.converted_type() == ConvertedType::UTF8 => {
                Ok(Kind::Text)
            }
            (Physical::BYTE_ARRAY | Physical::FIXED_LEN_BYTE_ARRAY, _) => {
                Err("holds bytes that are no text")
            }
            _ => Ok(plain),
        }
    }
}

/// Values of a column, read on from row to row of one row group.
pub(super) struct Cursor {
    reader: ColumnReader,
    full: i16,
    /// The row that comes next.
    pub row: u64,
}

impl Cursor {
    /// From the first row of a group on.
    pub fn new(reader: ColumnReader, column: &Arc<ColumnDescriptor>) -> Cursor {
        Cursor {
            reader,
            full: column.max_def_level(),
            row: 0,
        }
    }

    /// Goes forward to a row; returns whether it is there.
    pub fn go_to(&mut self, row: u64) -> Result<bool, ParquetError> {
        let rows = row.saturating_sub(self.row) as usize;
        if rows == 0 {
            return Ok(true);
        }
        let passed = match &mut self.reader {
            ColumnReader::BoolColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::Int32ColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::Int64ColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::Int96ColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::FloatColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::DoubleColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::ByteArrayColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::FixedLenByteArrayColumnReader(reader) => reader.skip_records(rows),
        }?;
        self.row += passed as u64;
        Ok(passed == rows)
    }

    /// Fills `values` with the next numbers; instants are in s after `origin`. Returns how many there were.
    pub fn numbers(
        &mut self,
        kind: Kind,
        origin: (i64, f64),
        values: &mut [f64],
    ) -> Result<usize, ParquetError> {
        let full = self.full;
        let whole = |value: i64| match kind {
            Kind::Instant { per_second } => after(value, per_second, origin),
            Kind::Number { scale, unsigned } => {
                let value = if unsigned {
                    value as u64 as f64
                } else {
                    value as f64
                };
                value * scale
            }
            _ => value as f64,
        };
        let read = match &mut self.reader {
            ColumnReader::BoolColumnReader(reader) => fill(reader, full, values, |value: &bool| {
                f64::from(u8::from(*value))
            }),
            ColumnReader::Int32ColumnReader(reader) => {
                fill(reader, full, values, |value: &i32| match kind {
                    Kind::Number { unsigned: true, .. } => whole(i64::from(*value as u32)),
                    _ => whole(i64::from(*value)),
                })
            }
            ColumnReader::Int64ColumnReader(reader) => {
                fill(reader, full, values, |value: &i64| whole(*value))
            }
            ColumnReader::Int96ColumnReader(reader) => {
                fill(reader, full, values, |value: &Int96| {
                    let data = value.data();
                    let nanos = u64::from(data[1]) << 32 | u64::from(data[0]);
                    // Days are counted from noon of -4713-11-24; 2440588 is 1970-01-01.
                    let days = i64::from(data[2]) - 2_440_588;
                    let seconds = (days * 86_400 - origin.0) as f64;
                    seconds + (nanos as f64 * 1e-9 - origin.1)
                })
            }
            ColumnReader::FloatColumnReader(reader) => {
                fill(reader, full, values, |value: &f32| f64::from(*value))
            }
            ColumnReader::DoubleColumnReader(reader) => {
                fill(reader, full, values, |value: &f64| *value)
            }
            ColumnReader::FixedLenByteArrayColumnReader(reader) => fill(
                reader,
                full,
                values,
                |value: &FixedLenByteArray| match value.data().first_chunk() {
                    Some(bytes) => half::f16::from_le_bytes(*bytes).to_f64(),
                    None => f64::NAN,
                },
            ),
            ColumnReader::ByteArrayColumnReader(_) => Ok(0),
        }?;
        self.row += read as u64;
        Ok(read)
    }
}

/// Seconds from an origin to an instant since 1970 in units of so many to a second.
fn after(value: i64, per_second: f64, origin: (i64, f64)) -> f64 {
    if per_second < 1.0 {
        let seconds = i128::from(value) * 86_400 - i128::from(origin.0);
        return seconds as f64 - origin.1;
    }
    let units = per_second as i64;
    let whole = value.div_euclid(units).saturating_sub(origin.0);
    whole as f64 + (value.rem_euclid(units) as f64 / per_second - origin.1)
}

/// Which of the next rows hold a value, and the values.
fn records<T: DataType>(
    reader: &mut ColumnReaderImpl<T>,
    full: i16,
    count: usize,
) -> Result<(Vec<bool>, Vec<T::T>), ParquetError> {
    let (mut levels, mut present) = (Vec::new(), Vec::new());
    let mut rows = 0;
    while rows < count {
        let definitions = (full > 0).then_some(&mut levels);
        let (read, ..) = reader.read_records(count - rows, definitions, None, &mut present)?;
        if read == 0 {
            break;
        }
        rows += read;
    }
    let there = match full {
        0 => vec![true; present.len()],
        full => levels.iter().map(|&level| level == full).collect(),
    };
    Ok((there, present))
}

fn fill<T: DataType>(
    reader: &mut ColumnReaderImpl<T>,
    full: i16,
    values: &mut [f64],
    number: impl Fn(&T::T) -> f64,
) -> Result<usize, ParquetError> {
    let (levels, present) = records(reader, full, values.len())?;
    let mut present = present.iter();
    let mut read = 0;
    for (to, &there) in values.iter_mut().zip(&levels) {
        *to = match there {
            true => present.next().map_or(f64::NAN, &number),
            false => f64::NAN,
        };
        read += 1;
    }
    Ok(read)
}
