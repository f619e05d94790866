//! A contact problem from the arguments of a call: W or (M, H), u_free, μ, the law.
//!
//! ```text
//!     rows per contact   len(u_free)/len(mu), or 3 where μ is one number for all contacts; 1 without friction and without mu
//! ```

use crate::arrays::{Matrix, column, matrix, number, vector};
use crate::away::{away, enter};
use crate::errors::{IntoPython, invalid};
use crate::problem::Problem;
use moreau::cli::remarks::remarks;
use moreau::number::counted;
use moreau::problem::{ContactProblem, ContactProblemBuilder, Law, Posed};
use moreau::{Error, Result, memory};
use moreau_contact::operator::{BlockSparse, Sparse, SparseDynamics};
use nalgebra::DVector;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// What a problem is made of.
pub struct Arguments<'a, 'py> {
    /// W \[1/kg\], or a tuple of M and H.
    pub operator: &'a Bound<'py, PyAny>,
    /// \[m/s\].
    pub u_free: &'a Bound<'py, PyAny>,
    /// One number, or one per contact.
    pub mu: Option<&'a Bound<'py, PyAny>>,
    /// Its name in files.
    pub law: &'a str,
    /// Of a polyhedral law.
    pub directions: Option<usize>,
    /// \[m/s\].
    pub shift: Option<&'a Bound<'py, PyAny>>,
    /// Of the problem.
    pub name: &'a str,
}

/// The problem of these arguments.
///
/// # Errors
/// `InvalidInput` names the argument.
pub fn pose(arguments: &Arguments) -> PyResult<Problem> {
    let py = arguments.operator.py();
    let _here = enter()?;
    let law = law_of(py, arguments.law, arguments.directions)?;
    let free = vector(arguments.u_free, "u_free")?;
    let (rows, operator) = (free.len(), Operator::of(arguments.operator)?);
    let friction = arguments.mu.map(Friction::of).transpose()?;
    // a free motion in place of its contact velocities would be told as a wrong number of coefficients
    operator.fits(py, rows)?;
    if friction.is_none() && law != Law::Frictionless {
        return Err(invalid(py, "mu", "is missing", "give one number for all contacts, or one per contact; or law=\"frictionless\""));
    }
    let per_contact = rows_per_contact(py, free.len(), friction.as_ref())?;
    let friction = friction.map_or(vec![0.0; free.len() / per_contact], |friction| friction.of_each(free.len() / per_contact));
    let shift = arguments.shift.map(|shift| vector(shift, "shift")).transpose()?;
    let name = arguments.name;
    memory::require("posing this problem", operator.bytes(free.len())).python(py)?;
    let built = away(py, || {
        let begun = operator.begin(per_contact)?.free_velocity(column(free)).rows_per_contact(per_contact);
        let begun = begun.law(law).friction(friction).name(name);
        match shift {
            Some(shift) => begun.shift(column(shift)).build(),
            None => begun.build(),
        }
    });
    let posed = built?.map_err(renamed).python(py).map(|problem| Posed::Contacts(Box::new(problem)))?;
    if law != Law::Frictionless {
        // without friction it may be a linear complementarity problem, whose matrix may be any
        warn(py, &remarks(&posed))?;
    }
    Ok(Problem::from(posed))
}

/// Says what is unusual of a problem that is taken as it stands.
fn warn(py: Python<'_>, remarks: &[String]) -> PyResult<()> {
    for text in remarks {
        py.import("moreau_contact._errors")?.call_method1("warn_of", (text.replace("field `delassus`: ", ""),))?;
    }
    Ok(())
}

/// A law by its name in files.
///
/// # Errors
/// `InvalidInput` where there is no such law, or its directions are missing.
pub fn law_of(py: Python<'_>, name: &str, directions: Option<usize>) -> PyResult<Law> {
    let law = match (name, directions) {
        ("polyhedral-coulomb", Some(directions)) => return Ok(Law::PolyhedralCoulomb { directions }),
        ("polyhedral-associated", Some(directions)) => return Ok(Law::PolyhedralAssociated { directions }),
        ("polyhedral-coulomb" | "polyhedral-associated", None) => {
            return Err(invalid(py, "directions", "is missing", "give the number of friction directions, 2 in the plane"));
        }
        ("frictionless", _) => Law::Frictionless,
        ("coulomb", _) => Law::Coulomb,
        ("associated", _) => Law::Associated,
        _ => {
            let known = "use coulomb, associated, frictionless, polyhedral-coulomb or polyhedral-associated";
            return Err(invalid(py, "law", format!("`{name}` is unknown"), known));
        }
    };
    match directions {
        None => Ok(law),
        Some(_) => Err(invalid(py, "directions", format!("does nothing with the law {name}"), "leave it out, or use a polyhedral law")),
    }
}

/// μ as it was given.
enum Friction {
    /// One number for all contacts.
    Same(f64),
    /// One number per contact.
    Each(Vec<f64>),
}

impl Friction {
    fn of(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        match number(given, "mu")? {
            Some(same) => Ok(Friction::Same(same)),
            None => vector(given, "mu").map(Friction::Each),
        }
    }

    fn of_each(self, contacts: usize) -> Vec<f64> {
        match self {
            Friction::Same(same) => vec![same; contacts],
            Friction::Each(each) => each,
        }
    }
}

fn rows_per_contact(py: Python<'_>, rows: usize, friction: Option<&Friction>) -> PyResult<usize> {
    let found = match friction {
        None => Some(1),
        Some(Friction::Same(_)) => Some(3).filter(|per_contact| rows.is_multiple_of(*per_contact)),
        Some(Friction::Each(each)) if each.is_empty() => Some(3).filter(|_| rows == 0),
        Some(Friction::Each(each)) => {
            Some(rows / each.len()).filter(|per_contact| (1..=3).contains(per_contact) && per_contact * each.len() == rows)
        }
    };
    found.ok_or_else(|| {
        let given = match friction {
            Some(Friction::Each(each)) => format!("has {} for {rows}", counted(each.len(), "entry"), rows = counted(rows, "row")),
            _ => format!("is one number for {}, which are no contacts of three", counted(rows, "row")),
        };
        invalid(py, "mu", given, "give one number per contact; contacts have 3 rows in space, 2 in the plane, 1 without friction")
    })
}

/// W, or M and H.
enum Operator {
    Delassus(Matrix),
    Mechanism(Matrix, Matrix),
}

impl Operator {
    fn of(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        match given.cast::<PyTuple>() {
            Ok(pair) if pair.len() == 2 => Ok(Operator::Mechanism(matrix(&pair.get_item(0)?, "M")?, matrix(&pair.get_item(1)?, "H")?)),
            Ok(pair) => {
                Err(invalid(given.py(), "W", format!("is a tuple of {}", pair.len()), "give W, or the tuple (M, H) of mass and Jacobian"))
            }
            Err(_) => match given.extract::<std::path::PathBuf>() {
                Ok(file) => {
                    let cure = format!("give Problem.read({:?}) alone", file.display().to_string());
                    Err(invalid(given.py(), "W", "is the name of a file", cure))
                }
                Err(_) => matrix(given, "W").map(Operator::Delassus),
            },
        }
    }

    /// What W takes: dense M and H make it dense.
    fn bytes(&self, rows: usize) -> u128 {
        match self {
            Operator::Mechanism(Matrix::Dense(_), Matrix::Dense(_)) => memory::matrix(rows, rows),
            _ => 0,
        }
    }

    fn fits(&self, py: Python<'_>, rows: usize) -> PyResult<()> {
        let (of, given) = match self {
            Operator::Delassus(matrix) => ("W", matrix.shape()[0]),
            Operator::Mechanism(_, jacobian) => ("H", jacobian.shape()[0]),
        };
        if given == rows {
            return Ok(());
        }
        let cure = "give H v_free, one velocity per row, not the velocities of the mechanism";
        Err(invalid(
            py,
            "u_free",
            format!("has {rows}, and {of} has {given}", rows = counted(rows, "entry"), given = counted(given, "row")),
            cure,
        ))
    }

    fn begin(self, rows_per_contact: usize) -> Result<ContactProblemBuilder> {
        match self {
            Operator::Delassus(Matrix::Dense(dense)) => {
                let rows = dense.nrows();
                Ok(ContactProblem::new(dense, DVector::zeros(rows)))
            }
            Operator::Delassus(Matrix::Sparse(sparse)) => {
                let rows = sparse.shape[0];
                Ok(ContactProblem::new(BlockSparse::from_sparse(&sparse, rows_per_contact)?, DVector::zeros(rows)))
            }
            Operator::Mechanism(Matrix::Dense(mass), Matrix::Dense(jacobian)) => {
                let still = DVector::zeros(jacobian.ncols());
                Ok(ContactProblem::from_dynamics(mass, jacobian, &still))
            }
            Operator::Mechanism(mass, jacobian) => {
                let still = DVector::zeros(jacobian.shape()[1]);
                let mechanism = SparseDynamics::new(&as_sparse(mass), &as_sparse(jacobian), rows_per_contact)?;
                Ok(ContactProblem::from_sparse_dynamics(&mechanism, &still))
            }
        }
    }
}

fn as_sparse(matrix: Matrix) -> Sparse {
    match matrix {
        Matrix::Dense(dense) => Sparse::of(&dense),
        Matrix::Sparse(sparse) => sparse,
    }
}

/// The fields of files are arguments here: `free_velocity[2]` is `u_free[2]`.
fn renamed(error: Error) -> Error {
    let names = [("delassus", "W"), ("free_velocity", "u_free"), ("friction", "mu"), ("mass", "M"), ("jacobian", "H")];
    match error {
        Error::Invalid { field, problem, cure } => {
            let place = names.iter().find_map(|(name, argument)| field.strip_prefix(name).map(|rest| format!("{argument}{rest}")));
            Error::Invalid { field: place.unwrap_or(field), problem, cure }
        }
        other => other,
    }
}
