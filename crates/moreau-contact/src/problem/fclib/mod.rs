//! FCLIB's HDF5 files: one friction problem each, local or global, with a solution and guesses where stored.
//!
//! ```text
//!     fclib_local     W, q, μ           u = W r + q                        r, u per contact (n, t₁, t₂)
//!     fclib_global    M, H, f, w, μ     M v = H r + f ,  u = Hᵀ v + w      so W = Hᵀ M⁻¹ H ,  q = Hᵀ M⁻¹ f + w
//! ```
//! The law is Coulomb's. Bilateral rows are read by `joints`.
//!
//! # Source
//! V. Acary et al., *FCLIB: a collection of discrete 3D frictional contact problems*; the format as its files show it.

use super::{ContactProblem, ContactProblemBuilder, Law, Posed, Solution};
use crate::memory;
use crate::operator::{BlockSparse, SparseDynamics};
use datasets::{dimension, numbers};
use hdf5_pure::File;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use std::io::Read;
use std::path::Path;

mod datasets;
mod joints;
mod matrix;
mod stored;
mod write;

pub use stored::StoredAnswers;

#[cfg(test)]
mod tests;

/// A file may take this part of the memory: what is read of it takes the rest.
const FILE_SHARE: u64 = 4;

/// Whether a file begins as HDF5 files do.
pub(super) fn is_hdf5(file: &Path) -> bool {
    let mut start = [0; 8];
    // what was read of a pipe would be lost
    std::fs::metadata(file).is_ok_and(|found| found.is_file())
        && std::fs::File::open(file).is_ok_and(|mut open| open.read_exact(&mut start).is_ok() && start == *b"\x89HDF\r\n\x1a\n")
}

/// Reads the problem of a file.
///
/// # Errors
/// [`Error::Invalid`] naming the group or dataset that is missing or does not fit.
pub(super) fn read(file: &Path) -> Result<Posed> {
    let open = open(file)?;
    let name = file.file_stem().unwrap_or_default().to_string_lossy();
    let has = |group: &str| open.group(group).is_ok();
    let contacts = |problem: ContactProblem| Posed::Contacts(Box::new(problem));
    match (has("fclib_local"), has("fclib_global")) {
        (true, true) | (false, false) => {}
        _ if joints::is_given(&open) => return joints::read(&open, &name).map(|problem| Posed::Jointed(Box::new(problem))),
        (true, false) => return local(&open, &name).map(contacts),
        (false, true) => return global(&open, &name).map(contacts),
    }
    Err(Error::invalid("fclib_local", "and `fclib_global` are both missing or both there", "give a file that holds one problem of FCLIB"))
}

/// Reads the group `solution`: r, and u as it is stored; with bilateral rows λ after r, and 0 for their velocities, which are not stored.
///
/// # Errors
/// [`Error::Invalid`] if there is none.
pub(super) fn read_solution(file: &Path) -> Result<Solution> {
    let open = open(file)?;
    if open.group("solution").is_err() {
        let cure = "give one: `moreau solve` makes one, and `moreau convert --solution` writes it into a file of FCLIB";
        return Err(Error::invalid("solution/r", "is missing: the file holds no answer", cure));
    }
    let [mut impulse, mut velocity] = [numbers(&open, "solution/r")?, numbers(&open, "solution/u")?];
    if joints::is_given(&open) {
        impulse.extend(numbers(&open, "solution/l")?);
        velocity.resize(impulse.len(), 0.0);
    }
    Ok(Solution::new("stored", DVector::from_vec(impulse), DVector::from_vec(velocity), 0))
}

fn open(file: &Path) -> Result<File> {
    let bytes = std::fs::metadata(file).map_err(|source| Error::Read { file: file.to_path_buf(), source })?.len();
    memory::require("reading this file", u128::from(bytes) * u128::from(FILE_SHARE))?;
    File::open(file).map_err(|error| Error::invalid("HDF5", error.to_string(), "give a whole HDF5 file; it may be truncated"))
}

fn local(file: &File, name: &str) -> Result<ContactProblem> {
    let dimension = dimension(file, "fclib_local/spacedim")?;
    let w = matrix::read(file, "fclib_local/W")?;
    let free = DVector::from_vec(numbers(file, "fclib_local/vectors/q")?);
    begun(BlockSparse::from_sparse(&w, dimension)?, free, numbers(file, "fclib_local/vectors/mu")?, dimension, name).build()
}

fn global(file: &File, name: &str) -> Result<ContactProblem> {
    let dimension = dimension(file, "fclib_global/spacedim")?;
    let [mass, jacobian] = [matrix::read(file, "fclib_global/M")?, matrix::read(file, "fclib_global/H")?];
    let [force, added] = [numbers(file, "fclib_global/vectors/f")?, numbers(file, "fclib_global/vectors/w")?].map(DVector::from_vec);
    for (what, found, wanted) in [("f", force.len(), mass.shape[0]), ("w", added.len(), jacobian.shape[1])] {
        if found != wanted {
            let field = format!("fclib_global/vectors/{what}");
            return Err(Error::invalid(field, format!("has {}", counted(found, "number")), format!("give {wanted}, as M and H have")));
        }
    }
    let mechanism = SparseDynamics::new(&mass, &jacobian.transposed(), dimension)?;
    let free = mechanism.contact_velocity(&mechanism.solve(&force)) + added;
    let friction = numbers(file, "fclib_global/vectors/mu")?;
    begun(mechanism.delassus()?, free, friction, dimension, name).sparse_dynamics(mechanism).build()
}

fn begun(delassus: BlockSparse, free: DVector<f64>, friction: Vec<f64>, dimension: usize, name: &str) -> ContactProblemBuilder {
    ContactProblem::new(delassus, free).name(name).law(Law::Coulomb).rows_per_contact(dimension).friction(friction)
}
