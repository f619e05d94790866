//! Arrays of numpy and matrices of scipy.sparse, in and out.

use crate::errors::{IntoPython, invalid};
use moreau::memory;
use moreau::number::counted;
use moreau_contact::operator::Sparse;
use nalgebra::{DMatrix, DVector};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyInt};
use std::collections::BTreeMap;

/// A matrix as it was given.
pub enum Matrix {
    /// Of numpy, or what numpy makes an array of.
    Dense(DMatrix<f64>),
    /// Of scipy.sparse.
    Sparse(Sparse),
}

impl Matrix {
    /// Numbers of rows and columns.
    pub fn shape(&self) -> [usize; 2] {
        match self {
            Matrix::Dense(dense) => [dense.nrows(), dense.ncols()],
            Matrix::Sparse(sparse) => sparse.shape,
        }
    }
}

/// A matrix of two dimensions; `field` is the name of the argument.
///
/// # Errors
/// `InvalidInput` names the argument.
pub fn matrix(value: &Bound<'_, PyAny>, field: &str) -> PyResult<Matrix> {
    let py = value.py();
    if let Ok(array) = value.extract::<PyReadonlyArray2<'_, f64>>()
        && let Some(entries) = in_order(&array)
    {
        return dense(py, entries, array.shape());
    }
    if value.hasattr(intern!(py, "tocoo"))? {
        return sparse(value, field).map(Matrix::Sparse);
    }
    let array = as_floats(value, field)?;
    match array.extract::<PyReadonlyArray2<'_, f64>>() {
        Ok(array) => dense(py, in_order(&array).unwrap_or_default(), array.shape()),
        Err(_) => Err(invalid(py, field, format!("has {} dimensions", dimensions(&array)?), "give a matrix, an array of two dimensions")),
    }
}

/// A vector; `field` is the name of the argument.
///
/// # Errors
/// `InvalidInput` names the argument.
pub fn vector(value: &Bound<'_, PyAny>, field: &str) -> PyResult<Vec<f64>> {
    let py = value.py();
    if let Ok(array) = value.extract::<PyReadonlyArray1<'_, f64>>()
        && let Some(entries) = in_order(&array)
    {
        return Ok(entries.to_vec());
    }
    let array = as_floats(value, field)?;
    match array.extract::<PyReadonlyArray1<'_, f64>>() {
        Ok(array) => Ok(in_order(&array).unwrap_or_default().to_vec()),
        Err(_) => Err(invalid(py, field, format!("has {} dimensions", dimensions(&array)?), "give a vector, an array of one dimension")),
    }
}

/// A vector as numpy has it.
pub fn to_vector<'py>(py: Python<'py>, values: &[f64]) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_slice(py, values)
}

/// Rows of so many numbers as numpy has them.
///
/// # Errors
/// If numpy has no memory.
pub fn to_rows<'py>(py: Python<'py>, values: Vec<f64>, columns: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let rows = values.len() / columns.max(1);
    PyArray1::from_vec(py, values).reshape([rows, columns])
}

/// A matrix as numpy has it.
///
/// # Errors
/// If numpy has no memory.
pub fn to_matrix<'py>(py: Python<'py>, matrix: &DMatrix<f64>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    PyArray1::from_slice(py, matrix.transpose().as_slice()).reshape([matrix.nrows(), matrix.ncols()])
}

/// One number, of Python or of numpy; none where it is an array.
///
/// # Errors
/// `InvalidInput` where it is no real number.
pub fn number(value: &Bound<'_, PyAny>, field: &str) -> PyResult<Option<f64>> {
    if value.is_instance_of::<PyFloat>() || value.is_instance_of::<PyInt>() {
        return value.extract().map(Some);
    }
    let array = as_floats(value, field)?;
    if value.getattr("ndim").is_ok_and(|dimensions| dimensions.eq(0).unwrap_or(false)) {
        return array.call_method0("sum")?.extract().map(Some);
    }
    Ok(None)
}

/// A vector as the crates below have it.
pub fn column(values: Vec<f64>) -> DVector<f64> {
    DVector::from_vec(values)
}

/// The numbers of an array, if they stand one after the other in memory. Fields of records need not: they are copied by numpy.
fn in_order<'a, D: numpy::ndarray::Dimension>(array: &'a PyReadonlyArray<'_, f64, D>) -> Option<&'a [f64]> {
    let is_aligned = (array.data() as usize).is_multiple_of(align_of::<f64>());
    if array.is_c_contiguous() && is_aligned { array.as_slice().ok() } else { None }
}

fn dense(py: Python<'_>, entries: &[f64], shape: &[usize]) -> PyResult<Matrix> {
    memory::require("this matrix", memory::matrix(shape[0], shape[1])).python(py)?;
    Ok(Matrix::Dense(DMatrix::from_row_slice(shape[0], shape[1], entries)))
}

/// What numpy makes of it, in double precision and in order; complex numbers, texts and masked arrays are none.
fn as_floats<'py>(value: &Bound<'py, PyAny>, field: &str) -> PyResult<Bound<'py, PyAny>> {
    let py = value.py();
    let numpy = py.import(intern!(py, "numpy"))?;
    if value.hasattr(intern!(py, "mask"))? {
        return Err(invalid(py, field, "is a masked array", "fill what is masked: a mask has no meaning here"));
    }
    let array = numpy.call_method1(intern!(py, "asarray"), (value,));
    if let Ok(array) = &array {
        let bytes = array.getattr("size")?.extract::<u128>()?.saturating_mul(size_of::<f64>() as u128);
        memory::require("this array", bytes).python(py)?;
    }
    let real = array.and_then(|array| array.call_method1("astype", ("float64", "C", "same_kind")));
    let real = real.and_then(|array| numpy.call_method1("ascontiguousarray", (array,)));
    let cure = if field == "W" { "give an array of floats, or the tuple (M, H)" } else { "give an array of floats" };
    real.map_err(|error| invalid(py, field, format!("is no array of real numbers ({})", error.value(py)), cure))
}

fn dimensions(array: &Bound<'_, PyAny>) -> PyResult<usize> {
    Ok(array.cast::<numpy::PyUntypedArray>()?.ndim())
}

/// Entries that stand twice are added, as scipy does.
fn sparse(value: &Bound<'_, PyAny>, field: &str) -> PyResult<Sparse> {
    let py = value.py();
    let coo = value.call_method0("tocoo")?;
    let Ok([rows, columns]) = coo.getattr("shape")?.extract::<[usize; 2]>() else {
        return Err(invalid(py, field, "is a sparse vector", "give a matrix, a sparse array of two dimensions"));
    };
    memory::require("velocities and rows of this matrix", memory::matrix(rows.max(columns), 2)).python(py)?;
    let places = |name: &str| -> PyResult<Vec<usize>> {
        let places = coo.getattr(name)?.call_method1("astype", ("int64",))?;
        Ok(places.extract::<PyReadonlyArray1<'_, i64>>()?.as_array().iter().map(|place| *place as usize).collect())
    };
    let data = vector(&coo.getattr("data")?, "data")?;
    let mut entries = BTreeMap::new();
    for ((row, column), value) in places("row")?.into_iter().zip(places("col")?).zip(data) {
        if row >= rows || column >= columns {
            let problem = format!(
                "has an entry at ({}, {}) outside of its {rows} and {columns}",
                row as i64,
                column as i64,
                rows = counted(rows, "row"),
                columns = counted(columns, "column")
            );
            return Err(invalid(py, field, problem, "make the matrix again: its indices were changed"));
        }
        *entries.entry((row, column)).or_insert(0.0) += value;
    }
    Ok(Sparse { shape: [rows, columns], entries: entries.into_iter().map(|((row, column), value)| (row, column, value)).collect() })
}
