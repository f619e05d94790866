//! What a contact problem must satisfy: its sizes fit together, its numbers are finite, and its signs and its law are valid.

use super::known::Known;
use super::{ContactProblem, Coordinates, Dynamics, Law};
use crate::memory;
use crate::operator::Operator;
use crate::problem::keys::{self, two_bodies};
use crate::tolerance::problem::POLYHEDRAL_UNKNOWNS;
use moreau_exact::number::{are_finite, counted};
use moreau_exact::{Error, Result};
use nalgebra::DMatrix;

/// What to do where a contact has other rows.
pub(in crate::problem) const ROWS: &str =
    "use 1 (normal rows only), 2 or 3; friction of 4 to 6 rows, rolling and drilling, is no law here; joints are bilateral `kinds`";

impl ContactProblem {
    /// Checks sizes, finiteness and signs.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the first field that is not valid.
    pub(super) fn validate(&self) -> Result<()> {
        if !(1..=3).contains(&self.rows_per_contact) {
            return Err(Error::invalid("dimension", format!("is {}", self.rows_per_contact), ROWS));
        }
        let sizes = [
            ("free_velocity", self.free_velocity.len()),
            ("shift", self.shift.len()),
            ("delassus", self.delassus.shape()[0]),
            ("delassus", self.delassus.shape()[1]),
        ];
        sizes.into_iter().try_for_each(|(field, size)| self.require_size(field, size))?;
        if let Some(rows) = self.delassus.rows_per_contact().filter(|rows| *rows != self.rows_per_contact) {
            let problem = format!("has blocks of {}", counted(rows, "row"));
            return Err(Error::invalid(
                "delassus",
                problem,
                format!("use blocks of the contacts, of {}", counted(self.rows_per_contact, "row")),
            ));
        }
        finite("free_velocity", self.free_velocity.as_slice())?;
        finite("shift", self.shift.as_slice())?;
        finite_operator(&self.delassus)?;
        not_negative("friction", &self.friction)?;
        self.validate_law()?;
        self.validate_compliance()?;
        self.validate_bodies()?;
        self.validate_keys()?;
        match &self.dynamics {
            Some(Known::Dense(dynamics)) => validate_dynamics(dynamics, self.rows()),
            _ => Ok(()), // by bodies and as lists they were checked with W
        }
    }

    /// Refuses a list of another size than the problem has rows.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the field, its size and that of the problem.
    pub(crate) fn require_size(&self, field: &str, size: usize) -> Result<()> {
        let rows = self.rows();
        if size == rows {
            return Ok(());
        }
        let cure =
            format!("give size {rows}, for {} with {} each", counted(self.contacts(), "contact"), counted(self.rows_per_contact, "row"));
        Err(Error::invalid(field, format!("has size {size}"), cure))
    }

    fn validate_law(&self) -> Result<()> {
        if self.rows_per_contact == 1 && self.friction.iter().any(|&mu| mu > 0.0) {
            return Err(Error::invalid(
                "friction",
                "is positive although the contacts have no tangential row",
                "use 0, or dimension 2 or 3",
            ));
        }
        let unknowns = self.law.directions().map_or(0, |d| d.saturating_add(2).saturating_mul(self.contacts()));
        // matrix, scaled matrix, and a tableau twice as wide with its copy
        let name = format_args!("a polyhedral problem of {}", counted(unknowns, "unknown"));
        memory::require(name, memory::matrix(unknowns, unknowns).saturating_mul(6))?;
        match (self.law.directions(), self.rows_per_contact) {
            (Some(d), 3) if unknowns > POLYHEDRAL_UNKNOWNS => {
                let problem = format!(
                    "is {d}, which makes {unknowns} with {}",
                    counted(self.contacts(), "contact"),
                    unknowns = counted(unknowns, "unknown")
                );
                Err(Error::invalid("directions", problem, format!("use at most {POLYHEDRAL_UNKNOWNS} unknowns (2 + d) n")))
            }
            (Some(2), 2) | (None, _) => Ok(()),
            (Some(_), 2) => Err(Error::invalid("directions", "is not 2 in a planar problem", "use 2 (both senses of tangent 1)")),
            (Some(d), 3) if d >= 3 => Ok(()),
            (Some(d), rows) => Err(Error::invalid(
                "directions",
                format!("is {d} with dimension {rows}"),
                "use at least 3 directions in dimension 3, or 2 in dimension 2",
            )),
        }
    }

    fn validate_compliance(&self) -> Result<()> {
        let Some(compliance) = &self.compliance else { return Ok(()) };
        let (needed, of) = match (compliance.coordinates, self.law) {
            (Coordinates::Contact, _) => (self.rows(), "row"),
            (Coordinates::Edge, Law::PolyhedralAssociated { directions }) => (directions * self.contacts(), "edge"),
            (Coordinates::Edge, law) => {
                let problem = format!("uses edge coordinates with the law `{}`", law.name());
                return Err(Error::invalid("compliance.coordinates", problem, "use `contact`, or the law `polyhedral-associated`"));
            }
        };
        if compliance.diagonal.len() != needed {
            return Err(Error::invalid(
                "compliance.diagonal",
                format!("has size {}", compliance.diagonal.len()),
                format!("give size {needed}, one for each {of} of the {}", counted(self.contacts(), "contact")),
            ));
        }
        not_negative("compliance.diagonal", compliance.diagonal.as_slice())
    }

    fn validate_bodies(&self) -> Result<()> {
        let Some(bodies) = &self.bodies else { return Ok(()) };
        if bodies.len() != self.contacts() {
            let cure = format!("give one pair for each of the {}", counted(self.contacts(), "contact"));
            return Err(Error::invalid("bodies", format!("has size {}", bodies.len()), cure));
        }
        bodies.iter().enumerate().try_for_each(|(k, pair)| two_bodies("bodies", k, *pair))
    }

    fn validate_keys(&self) -> Result<()> {
        let Some(keys) = &self.keys else { return Ok(()) };
        if keys.len() != self.contacts() {
            let cure = format!("give one for each of the {}", counted(self.contacts(), "contact"));
            return Err(Error::invalid("keys", format!("has size {}", keys.len()), cure));
        }
        keys::validate(keys)?;
        for (k, key) in keys.iter().enumerate() {
            if self.bodies.as_ref().is_some_and(|bodies| bodies[k] != key.bodies) {
                return Err(Error::invalid(format!("keys[{k}]"), "names other bodies than `bodies`", "name the same two in both"));
            }
        }
        Ok(())
    }
}

/// Refuses a mass and a Jacobian that do not fit so many rows or hold what is no number.
pub(in crate::problem) fn validate_dynamics(Dynamics { mass, jacobian }: &Dynamics, rows: usize) -> Result<()> {
    if !mass.is_square() {
        return Err(Error::invalid("mass", format!("has shape {}×{}", mass.nrows(), mass.ncols()), "give a square mass matrix"));
    }
    if jacobian.nrows() != rows || jacobian.ncols() != mass.nrows() {
        let cure = format!("use the shape {rows}×{}, which fits the contacts and the mass", mass.nrows());
        return Err(Error::invalid("jacobian", format!("has shape {}×{}", jacobian.nrows(), jacobian.ncols()), cure));
    }
    finite_matrix("mass", mass)?;
    finite_matrix("jacobian", jacobian)
}

pub(in crate::problem) fn finite(field: &str, values: &[f64]) -> Result<()> {
    if are_finite(values) {
        return Ok(());
    }
    match values.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(k) => finite_at(format!("{field}[{k}]"), values[k]),
    }
}

/// Refuses a matrix with an entry that is no finite number, and names it by row and column, counted from 0.
pub(in crate::problem) fn finite_matrix(field: &str, matrix: &DMatrix<f64>) -> Result<()> {
    match matrix.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(k) => {
            let place = format!("{field}[{}, {}]", k % matrix.nrows(), k / matrix.nrows());
            finite_at(place, matrix[k])
        }
    }
}

/// The same of W, however it is stored.
fn finite_operator(w: &Operator) -> Result<()> {
    if are_finite(w.entries()) {
        return Ok(());
    }
    let mut first = None;
    for column in 0..w.shape()[1] {
        w.for_each_in_column(column, |row, value| first = first.or((!value.is_finite()).then_some((row, column, value))));
        if let Some((row, column, value)) = first {
            return finite_at(format!("delassus[{row}, {column}]"), value);
        }
    }
    // what W is stored as overflows in no column
    finite("delassus", w.entries())
}

fn finite_at(place: String, value: f64) -> Result<()> {
    if value.is_finite() { Ok(()) } else { Err(Error::invalid(place, format!("is {value}"), "use a finite number")) }
}

pub(in crate::problem) fn not_negative(field: &str, values: &[f64]) -> Result<()> {
    finite(field, values)?;
    match values.iter().position(|x| *x < 0.0) {
        None => Ok(()),
        Some(k) => Err(Error::invalid(format!("{field}[{k}]"), format!("is {}, negative", values[k]), "use a number ≥ 0")),
    }
}
