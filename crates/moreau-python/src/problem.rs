//! `Problem`: W, u_free, μ and the law, from arrays or from a file.

use crate::arrays::{column, to_matrix, to_vector, vector};
use crate::away::away;
use crate::errors::{IntoPython, invalid};
use crate::posing::{Arguments, law_of, pose};
use moreau::cli::posed;
use moreau::cli::remarks::remarks;
use moreau::number::counted;
use moreau::problem::{Law, Posed};
use moreau::{files, memory};
use nalgebra::DVector;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;

/// A contact problem: find impulses r [N·s] with u = W r + u_free [m/s] such that every contact obeys its law.
///
/// ```text
///     u = W r + u_free ,    y = u + shift ,    (r, y) in the contact law, contact by contact
/// ```
/// Rows stand contact by contact in the order normal, tangent₁, tangent₂ (3 rows in space, 2 in the plane, 1 without friction). The normal
/// points into the body on which r acts: r_n ≥ 0 pushes, u_n > 0 opens.
///
/// Problem(W, u_free, mu, *, law="coulomb", directions=None, shift=None, name="")
///
/// - W: the Delassus operator [1/kg], an array or a scipy.sparse matrix, rows × rows; or the tuple (M, H) of the mass matrix [kg], nv × nv,
///   and the contact Jacobian, rows × nv: then W = H M⁻¹ Hᵀ. Sparse M and H keep W by bodies, and it is never formed.
/// - u_free: H v_free [m/s], the contact velocities without contact impulses, one per row.
/// - mu: coefficients of friction, one number (contacts of 3 rows) or one per contact; may be absent without friction.
/// - law: "coulomb", "associated" (that of a convex program), "frictionless", "polyhedral-coulomb" or "polyhedral-associated".
/// - directions: friction directions of a polyhedral law, 2 in the plane.
/// - shift: added to u in the law [m/s], such as e u_n⁻ of Newton's restitution; one per row, zero if absent.
///
/// Raises InvalidInput, which names the argument and the cure.
#[pyclass(frozen, module = "moreau_contact")]
pub struct Problem {
    /// What is posed.
    pub posed: Arc<Posed>,
}

#[pymethods]
impl Problem {
    #[new]
    #[pyo3(signature = (W, u_free, mu = None, *, law = "coulomb", directions = None, shift = None, name = ""))]
    #[expect(non_snake_case, reason = "the names of the arguments in Python")]
    fn new(
        W: &Bound<'_, PyAny>,
        u_free: &Bound<'_, PyAny>,
        mu: Option<&Bound<'_, PyAny>>,
        law: &str,
        directions: Option<usize>,
        shift: Option<&Bound<'_, PyAny>>,
        name: &str,
    ) -> PyResult<Self> {
        pose(&Arguments { operator: W, u_free, mu, law, directions, shift, name })
    }

    /// Reads a file: contact-problem/1, lcp/1, .dat of Siconos, or HDF5 of FCLIB.
    #[staticmethod]
    fn read(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        away(py, || Posed::read(&file))?.python(py).map(Problem::from)
    }

    /// Reads the text of a contact-problem/1 or an lcp/1.
    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str) -> PyResult<Self> {
        away(py, || Posed::from_json(text))?.python(py).map(Problem::from)
    }

    /// The text of a contact-problem/1.
    fn to_json(&self) -> String {
        match &*self.posed {
            Posed::Contacts(problem) => problem.to_json(),
            Posed::Jointed(problem) => problem.to_json(),
        }
    }

    /// Writes a contact-problem/1, whole or not at all.
    fn write(&self, py: Python<'_>, file: PathBuf) -> PyResult<()> {
        away(py, || files::write_atomically(&file, self.to_json().as_bytes()))?.python(py)
    }

    /// The same data under another law.
    #[pyo3(signature = (law, directions = None))]
    fn with_law(&self, py: Python<'_>, law: &str, directions: Option<usize>) -> PyResult<Self> {
        let law = law_of(py, law, directions)?;
        let posed = match &*self.posed {
            Posed::Contacts(problem) => {
                (**problem).clone().into_builder().law(law).build().map(|problem| Posed::Contacts(Box::new(problem)))
            }
            Posed::Jointed(problem) => {
                (**problem).clone().law(law, problem.friction().to_vec()).map(|problem| Posed::Jointed(Box::new(problem)))
            }
        };
        posed.python(py).map(Problem::from)
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        posed::name(&self.posed)
    }

    /// The name of its law.
    #[getter]
    fn law(&self) -> &'static str {
        self.of_law().name()
    }

    /// The number of friction directions of a polyhedral law, else None.
    #[getter]
    fn directions(&self) -> Option<usize> {
        self.of_law().directions()
    }

    /// What is unusual of W, a sentence each: that it is not symmetric, or has W_ii < 0.
    #[getter]
    fn remarks(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        away(py, || remarks(&self.posed))
    }

    /// The number of contacts; with joints, of all constraints.
    #[getter]
    fn contacts(&self) -> usize {
        posed::constraints(&self.posed)
    }

    /// The number of rows.
    #[getter]
    fn rows(&self) -> usize {
        match &*self.posed {
            Posed::Contacts(problem) => problem.rows(),
            Posed::Jointed(problem) => problem.rows(),
        }
    }

    /// Rows of a contact: 3 in space, 2 in the plane, 1 without friction.
    #[getter]
    fn rows_per_contact(&self) -> usize {
        match &*self.posed {
            Posed::Contacts(problem) => problem.rows_per_contact(),
            Posed::Jointed(problem) => problem.rows_per_contact(),
        }
    }

    /// Whether it has bilateral constraints or limits beside contacts.
    #[getter]
    fn has_joints(&self) -> bool {
        matches!(&*self.posed, Posed::Jointed(_))
    }

    /// Coefficients of friction, one per contact.
    #[getter]
    fn mu<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        match &*self.posed {
            Posed::Contacts(problem) => to_vector(py, problem.friction()),
            Posed::Jointed(problem) => to_vector(py, problem.friction()),
        }
    }

    /// Contact velocities without contact impulses [m/s], one per row.
    #[getter]
    fn u_free<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        match &*self.posed {
            Posed::Contacts(problem) => to_vector(py, problem.free_velocity().as_slice()),
            Posed::Jointed(problem) => to_vector(py, problem.free_velocity().as_slice()),
        }
    }

    /// What the law adds to u [m/s], one per row.
    #[getter]
    fn shift<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        match &*self.posed {
            Posed::Contacts(problem) => to_vector(py, problem.shift().as_slice()),
            Posed::Jointed(problem) => to_vector(py, problem.shifts().as_slice()),
        }
    }

    /// The Delassus operator [1/kg] as a dense array, rows × rows.
    #[getter(W)]
    fn delassus<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        memory::require("W as a dense array", 3 * memory::matrix(self.rows(), self.rows())).python(py)?;
        match &*self.posed {
            Posed::Contacts(problem) => to_matrix(py, problem.dense()),
            Posed::Jointed(problem) => to_matrix(py, problem.delassus()),
        }
    }

    /// W [1/kg] as a `scipy.sparse.csr_array`, rows × rows.
    fn sparse<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (mut places, mut values) = ([Vec::new(), Vec::new()], Vec::new());
        let mut take = |row: usize, column: usize, value: f64| {
            places[0].push(row as i64);
            places[1].push(column as i64);
            values.push(value);
        };
        match &*self.posed {
            Posed::Contacts(problem) => {
                let operator = problem.delassus();
                (0..problem.rows()).for_each(|column| operator.for_each_in_column(column, |row, value| take(row, column, value)));
            }
            Posed::Jointed(problem) => {
                for (column, entries) in problem.delassus().column_iter().enumerate() {
                    entries.iter().enumerate().filter(|(_, value)| **value != 0.0).for_each(|(row, value)| take(row, column, *value));
                }
            }
        }
        let [rows, columns] = places.map(|places| PyArray1::from_vec(py, places));
        let shape = (self.rows(), self.rows());
        py.import("scipy.sparse")?.call_method1("csr_array", ((to_vector(py, &values), (rows, columns)), shape))
    }

    /// u = W r + u_free [m/s] of impulses r [N·s].
    fn velocity<'py>(&self, py: Python<'py>, impulse: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let impulse = self.impulse(impulse)?;
        Ok(to_vector(py, self.velocity_of(&impulse).as_slice()))
    }

    /// A copy, and what is sent to another process, is read from its contact-problem/1.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let class = py.import("moreau_contact")?.getattr("Problem")?;
        Ok((class.getattr("from_json")?, (self.to_json(),)))
    }

    fn __repr__(&self) -> String {
        let (law, name) = (self.law(), self.name());
        format!("Problem({name:?}, law={law:?}, contacts={}, rows={})", self.contacts(), self.rows())
    }
}

impl From<Posed> for Problem {
    fn from(posed: Posed) -> Self {
        Problem { posed: Arc::new(posed) }
    }
}

impl Problem {
    fn of_law(&self) -> Law {
        match &*self.posed {
            Posed::Contacts(problem) => problem.law(),
            Posed::Jointed(problem) => problem.contact_law(),
        }
    }

    /// u = W r + u_free of an impulse whose size fits.
    pub fn velocity_of(&self, impulse: &DVector<f64>) -> DVector<f64> {
        match &*self.posed {
            Posed::Contacts(problem) => problem.velocity(impulse),
            Posed::Jointed(problem) => problem.velocity(impulse),
        }
    }

    /// An impulse \[N·s\] that fits.
    ///
    /// # Errors
    /// `InvalidInput` where it does not.
    pub fn impulse(&self, impulse: &Bound<'_, PyAny>) -> PyResult<DVector<f64>> {
        self.fitting("impulse", impulse)
    }

    /// A vector of one finite number per row.
    ///
    /// # Errors
    /// `InvalidInput` names the argument, and the entry that is not finite.
    pub fn fitting(&self, field: &str, given: &Bound<'_, PyAny>) -> PyResult<DVector<f64>> {
        let values = vector(given, field)?;
        if values.len() != self.rows() {
            let cure = format!("give {}, one per row of the problem", self.rows());
            return Err(invalid(given.py(), field, format!("has {}", counted(values.len(), "entry")), cure));
        }
        if let Some(k) = values.iter().position(|value| !value.is_finite()) {
            let cure = "give finite numbers: an answer that has none is no answer";
            return Err(invalid(given.py(), &format!("{field}[{k}]"), format!("is {}", values[k]), cure));
        }
        Ok(column(values))
    }
}
