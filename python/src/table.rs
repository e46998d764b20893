//! Columns of numbers, which Arrow readers take as they are.

use arrow_array::ffi::FFI_ArrowSchema;
use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{Array, ArrayRef, Float64Array, RecordBatch, RecordBatchIterator};
use arrow_buffer::{NullBuffer, ScalarBuffer};
use arrow_schema::{ArrowError, DataType, Field, Schema};
pub use auxbear::study::table::Column;
use auxbear::study::table::Table as Members;
use numpy::PyArray1;
use pyo3::exceptions::{PyKeyError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use std::collections::HashMap;
use std::sync::Arc;

/// Columns of equal length, each with name, unit and meaning.
#[pyclass(frozen)]
pub struct Table(RecordBatch);

impl Table {
    /// Takes the values over without a copy. What is not a finite number is an empty cell, as in a file.
    pub fn of(columns: impl IntoIterator<Item = Column>) -> PyResult<Table> {
        let (fields, arrays): (Vec<Field>, Vec<ArrayRef>) = columns.into_iter().map(made).unzip();
        let schema = Arc::new(Schema::new(fields));
        let batch = match arrays.is_empty() {
            true => Ok(RecordBatch::new_empty(schema)),
            false => RecordBatch::try_new(schema, arrays),
        };
        batch.map(Table).map_err(refused)
    }

    /// Members of a study: their numbers, then their columns.
    pub fn of_members(members: Members) -> PyResult<Table> {
        let numbers = members.members.iter().map(|member| *member as f64);
        let first = Column {
            name: "member".to_string(),
            unit: "1".to_string(),
            meaning: "number of the member".to_string(),
            values: numbers.collect(),
        };
        Table::of(std::iter::once(first).chain(members.columns))
    }

    /// The values of each column, copied.
    pub fn values(&self) -> impl Iterator<Item = (&str, Vec<f64>)> {
        let names = self.0.schema_ref().fields().iter();
        let columns = names.zip(self.0.columns());
        columns.map(|(field, array)| (field.name().as_str(), numbers(array)))
    }

    fn told(&self, key: &str) -> Vec<(String, String)> {
        let of = |field: &Arc<Field>| {
            let value = field.metadata().get(key).cloned().unwrap_or_default();
            (field.name().clone(), value)
        };
        self.0.schema_ref().fields().iter().map(of).collect()
    }
}

#[pymethods]
impl Table {
    fn names(&self) -> Vec<String> {
        let names = self.0.schema_ref().fields().iter();
        names.map(|field| field.name().clone()).collect()
    }

    fn units(&self) -> Vec<(String, String)> {
        self.told("unit")
    }

    fn meanings(&self) -> Vec<(String, String)> {
        self.told("meaning")
    }

    fn rows(&self) -> usize {
        self.0.num_rows()
    }

    fn column<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        match self.0.column_by_name(name) {
            Some(array) => Ok(PyArray1::from_vec(py, numbers(array))),
            None => Err(PyKeyError::new_err(name.to_string())),
        }
    }

    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // a wish that need not be met: doubles are what there is
        drop(requested_schema);
        let batches = RecordBatchIterator::new([Ok(self.0.clone())], self.0.schema());
        let stream = FFI_ArrowArrayStream::new(Box::new(batches));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }

    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        let schema = FFI_ArrowSchema::try_from(self.0.schema_ref().as_ref()).map_err(refused)?;
        PyCapsule::new_with_value(py, schema, c"arrow_schema")
    }
}

fn made(column: Column) -> (Field, ArrayRef) {
    let is_whole = column.values.iter().all(|value| value.is_finite());
    let gaps = (!is_whole).then(|| {
        let present = column.values.iter().map(|value| value.is_finite());
        NullBuffer::from(present.collect::<Vec<bool>>())
    });
    let field =
        Field::new(column.name, DataType::Float64, !is_whole).with_metadata(HashMap::from([
            ("unit".to_string(), column.unit),
            ("meaning".to_string(), column.meaning),
        ]));
    let array = Float64Array::new(ScalarBuffer::from(column.values), gaps);
    (field, Arc::new(array))
}

/// The values of a column; an empty cell is not a number.
fn numbers(array: &ArrayRef) -> Vec<f64> {
    let Some(array) = array.as_any().downcast_ref::<Float64Array>() else {
        return Vec::new();
    };
    match array.null_count() {
        0 => array.values().to_vec(),
        _ => array
            .iter()
            .map(|value| value.unwrap_or(f64::NAN))
            .collect(),
    }
}

fn refused(error: ArrowError) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}
