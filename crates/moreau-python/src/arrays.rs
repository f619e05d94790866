//! Arrays of numpy and matrices of scipy.sparse, in and out.

use crate::errors::invalid;
use moreau_contact::operator::Sparse;
use nalgebra::{DMatrix, DVector};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::intern;
use pyo3::prelude::*;
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
    if let Ok(array) = value.extract::<PyReadonlyArray2<'_, f64>>() {
        return Ok(Matrix::Dense(dense(&array)));
    }
    if value.hasattr(intern!(py, "tocoo"))? {
        return sparse(value).map(Matrix::Sparse);
    }
    let array = as_floats(value, field)?;
    match array.extract::<PyReadonlyArray2<'_, f64>>() {
        Ok(array) => Ok(Matrix::Dense(dense(&array))),
        Err(_) => Err(invalid(py, field, format!("has {} dimensions", dimensions(&array)?), "give a matrix, an array of two dimensions")),
    }
}

/// A vector; `field` is the name of the argument.
///
/// # Errors
/// `InvalidInput` names the argument.
pub fn vector(value: &Bound<'_, PyAny>, field: &str) -> PyResult<Vec<f64>> {
    let py = value.py();
    if let Ok(array) = value.extract::<PyReadonlyArray1<'_, f64>>() {
        return Ok(array.as_array().to_vec());
    }
    let array = as_floats(value, field)?;
    match array.extract::<PyReadonlyArray1<'_, f64>>() {
        Ok(array) => Ok(array.as_array().to_vec()),
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

/// A vector as the crates below have it.
pub fn column(values: Vec<f64>) -> DVector<f64> {
    DVector::from_vec(values)
}

fn dense(array: &PyReadonlyArray2<'_, f64>) -> DMatrix<f64> {
    let array = array.as_array();
    DMatrix::from_row_iterator(array.nrows(), array.ncols(), array.iter().copied())
}

/// What numpy makes of it, in double precision; complex numbers and texts are none.
fn as_floats<'py>(value: &Bound<'py, PyAny>, field: &str) -> PyResult<Bound<'py, PyAny>> {
    let py = value.py();
    let numpy = py.import(intern!(py, "numpy"))?;
    let array = numpy.call_method1(intern!(py, "asarray"), (value,));
    let real = array.and_then(|array| array.call_method1("astype", ("float64", "K", "same_kind")));
    let cure = if field == "W" { "give an array of floats, or the tuple (M, H)" } else { "give an array of floats" };
    real.map_err(|error| invalid(py, field, format!("is no array of real numbers ({})", error.value(py)), cure))
}

fn dimensions(array: &Bound<'_, PyAny>) -> PyResult<usize> {
    Ok(array.cast::<numpy::PyUntypedArray>()?.ndim())
}

/// Entries that stand twice are added, as scipy does.
fn sparse(value: &Bound<'_, PyAny>) -> PyResult<Sparse> {
    let coo = value.call_method0("tocoo")?;
    let [rows, columns] = coo.getattr("shape")?.extract::<[usize; 2]>()?;
    let places = |name: &str| -> PyResult<Vec<usize>> {
        let places = coo.getattr(name)?.call_method1("astype", ("int64",))?;
        Ok(places.extract::<PyReadonlyArray1<'_, i64>>()?.as_array().iter().map(|place| *place as usize).collect())
    };
    let data = vector(&coo.getattr("data")?, "data")?;
    let mut entries = BTreeMap::new();
    for ((row, column), value) in places("row")?.into_iter().zip(places("col")?).zip(data) {
        *entries.entry((row, column)).or_insert(0.0) += value;
    }
    Ok(Sparse { shape: [rows, columns], entries: entries.into_iter().map(|((row, column), value)| (row, column, value)).collect() })
}
