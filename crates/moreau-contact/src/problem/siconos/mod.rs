//! Siconos's text files `.dat`: friction problems, local and global, in the plane and in space, and linear complementarity problems.
//!
//! ```text
//!     local    d n  W  q  μ            u = W r + q                       r, u per contact (n, t₁, t₂)
//!     global   d n  M  H  f  b  μ      M v = H r + f ,  u = Hᵀ v + b     so W = Hᵀ M⁻¹ H ,  q = Hᵀ M⁻¹ f + b
//!     LCP      n  M  q                 0 ≤ z ⟂ M z + q ≥ 0               frictionless contacts of one row
//! ```
//! What a file is follows from its sizes. What stands after the last number that is needed is not read: some files carry remarks there.
//!
//! # Source
//! The printing routines of Siconos 4 (`frictionContact_printInFile`, `globalFrictionContact_printInFile`, `NM_write_in_file`), as the
//! files show them.

use super::{ContactProblem, ContactProblemBuilder, Law};
use crate::operator::{Operator, SparseDynamics};
use matrix::Matrix;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use tokens::Tokens;

mod matrix;
mod tokens;

#[cfg(test)]
mod tests;

/// Reads a `.dat`; whether it is a local or a global friction problem or an LCP is told by its sizes.
///
/// # Errors
/// [`Error::Invalid`] naming the number that is missing or does not fit, with its line.
pub(super) fn read(text: &str, name: &str) -> Result<ContactProblem> {
    let mut tokens = Tokens::new(text);
    let sizes = tokens.peek_whole(5);
    let is_friction = matches!(sizes[..], [2 | 3, _, 0..=2, rows, columns] if rows == columns && rows > 0);
    let is_lcp = matches!(sizes[..], [n, 0..=2, rows, columns, ..] if n == rows && n == columns && n > 0);
    match (is_friction, is_lcp) {
        (true, true) => friction(&mut tokens, name).or_else(|_| lcp(&mut Tokens::new(text), name)),
        (true, false) => friction(&mut tokens, name),
        (false, true) => lcp(&mut tokens, name),
        (false, false) => Err(Error::invalid(
            "sizes",
            match text.split_whitespace().take(5).map(|word| word.chars().take(20).collect()).collect::<Vec<String>>().join(" ") {
                none if none.is_empty() => "are missing: the file is empty".into(),
                first => format!("are `{first}` at the beginning of the file"),
            },
            "give Siconos's text whole, dimension, contacts and W first, or n and M; or `contact-problem/1` or `lcp/1` in JSON",
        )),
    }
}

fn friction(tokens: &mut Tokens, name: &str) -> Result<ContactProblem> {
    let [dimension, contacts] = [tokens.whole("dimension")?, tokens.whole("numberOfContacts")?];
    let rows = dimension.saturating_mul(contacts);
    let first = Matrix::read(tokens, "W")?;
    if first.shape() == [rows, rows] && !is_global(tokens, rows, contacts) {
        let free = tokens.vector("q", rows)?;
        return begun(first.into_operator(dimension)?, DVector::from_vec(free), dimension, tokens.vector("mu", contacts)?, name).build();
    }
    let jacobian = Matrix::read(tokens, "H")?;
    let velocities = first.shape()[0];
    let [force, added] = [tokens.vector("q", velocities)?, tokens.vector("b", rows)?].map(DVector::from_vec);
    let friction = tokens.vector("mu", contacts)?;
    if jacobian.shape() != [velocities, rows] {
        let problem = format!("has shape {}×{}", jacobian.shape()[0], jacobian.shape()[1]);
        return Err(Error::invalid("H", problem, format!("give {velocities}×{rows}: a row per velocity, a column per contact row")));
    }
    let mechanism = SparseDynamics::new(&first.into_sparse(), &jacobian.into_sparse().transposed(), dimension)?;
    let free = mechanism.contact_velocity(&mechanism.solve(&force)) + added;
    let delassus = mechanism.delassus()?;
    begun(delassus.into(), free, dimension, friction, name).sparse_dynamics(mechanism).build()
}

/// Whether what follows the first matrix is another one: a local problem has q and μ left, and perhaps a mark.
fn is_global(tokens: &Tokens, rows: usize, contacts: usize) -> bool {
    !(rows.saturating_add(contacts)..=rows.saturating_add(contacts + 1)).contains(&tokens.remaining())
        && matches!(tokens.clone().peek_whole(3)[..], [0..=2, matrix_rows, columns] if matrix_rows == rows && columns == rows)
}

fn begun(delassus: Operator, free: DVector<f64>, dimension: usize, friction: Vec<f64>, name: &str) -> ContactProblemBuilder {
    ContactProblem::new(delassus, free).name(name).law(Law::Coulomb).rows_per_contact(dimension).friction(friction)
}

fn lcp(tokens: &mut Tokens, name: &str) -> Result<ContactProblem> {
    let size = tokens.whole("size")?;
    let matrix = Matrix::read(tokens, "M")?;
    if matrix.shape() != [size, size] {
        let problem = format!("has shape {}×{}", matrix.shape()[0], matrix.shape()[1]);
        return Err(Error::invalid("M", problem, format!("give {size}×{size}")));
    }
    let vector = DVector::from_vec(tokens.vector("q", size)?);
    let matrix: DMatrix<f64> = matrix.into_dense()?;
    ContactProblem::new(matrix, vector).name(name).law(Law::Frictionless).rows_per_contact(1).of_any_matrix().build()
}
