//! The native part of the Python package `auxbear`.
#![forbid(unsafe_code)]
use pyo3::prelude::*;
#[pyclass(frozen)]
struct A(f64);
#[pymethods]
impl A {
    #[new]
    fn new(x: f64) -> PyResult<Self> { Ok(A(x)) }
    fn y(&self) -> f64 { self.0 }
    fn __arrow_c_stream__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, pyo3::types::PyCapsule>> {
        let b = arrow_array::RecordBatch::new_empty(std::sync::Arc::new(arrow_schema::Schema::empty()));
        let s = b.schema();
        let r = arrow_array::RecordBatchIterator::new([Ok(b)], s);
        let s = arrow_array::ffi_stream::FFI_ArrowArrayStream::new(Box::new(r));
        pyo3::types::PyCapsule::new(py, s, Some(c"arrow_array_stream".into()))
    }
}
#[pymodule]
mod _auxbear {
    #[pymodule_export]
    use super::A;
}
