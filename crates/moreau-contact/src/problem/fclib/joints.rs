//! FCLIB's bilateral rows: V, R and s of a local problem, G and b of a global one.
//!
//! ```text
//!     fclib_local     u = W r + V λ + q ,   0 = Vᵀ r + R λ + s
//!     fclib_global    M v = H r + G λ + f ,   u = Hᵀ v + w ,   0 = Gᵀ v + b
//! ```
//! Rows of the contacts come first; each bilateral row is a constraint of its own.

use super::datasets::{dimension, numbers};
use super::matrix;
use crate::operator::{Operator, Sparse, SparseDynamics};
use crate::problem::contact_problem::Known;
use crate::problem::jointed::require_room;
use crate::problem::{ConstraintKind, JointedProblem, Law};
use hdf5_pure::File;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Whether the problem of a file has bilateral rows.
pub(super) fn is_given(file: &File) -> bool {
    file.group("fclib_global/G").is_ok() || file.group("fclib_local/V").is_ok()
}

/// The problem with its bilateral rows.
pub(super) fn read(file: &File, name: &str) -> Result<JointedProblem> {
    if file.group("fclib_global/G").is_ok() { global(file, name) } else { local(file, name) }
}

fn local(file: &File, name: &str) -> Result<JointedProblem> {
    let [w, v, r] = ["W", "V", "R"].map(|name| matrix::read(file, &format!("fclib_local/{name}")));
    let (w, v, r) = (w?, v?, r?);
    let [q, s] = [vector(file, "fclib_local", "q")?, vector(file, "fclib_local", "s")?];
    let (contacts, joints) = (q.len(), s.len());
    require_room(contacts + joints)?;
    for (name, found, wanted) in [("W", w.shape, [contacts; 2]), ("V", v.shape, [contacts, joints]), ("R", r.shape, [joints; 2])] {
        if found != wanted {
            let problem = format!("has shape {}×{}", found[0], found[1]);
            return Err(Error::invalid(
                format!("fclib_local/{name}"),
                problem,
                format!("use {}×{}, as q and s have", wanted[0], wanted[1]),
            ));
        }
    }
    let mut whole = DMatrix::zeros(contacts + joints, contacts + joints);
    w.entries.iter().for_each(|(i, j, value)| whole[(*i, *j)] += value);
    r.entries.iter().for_each(|(i, j, value)| whole[(contacts + i, contacts + j)] += value);
    for (i, j, value) in &v.entries {
        whole[(*i, contacts + j)] += value;
        whole[(contacts + j, *i)] += value;
    }
    let free = DVector::from_iterator(contacts + joints, q.into_iter().chain(s));
    problem(file, "fclib_local", name, whole, free, joints)
}

fn global(file: &File, name: &str) -> Result<JointedProblem> {
    let group = "fclib_global";
    let [mass, contacts, joints] = ["M", "H", "G"].map(|name| matrix::read(file, &format!("{group}/{name}")));
    let (mass, contacts, joints) = (mass?, contacts?, joints?);
    let [force, w, b] = [vector(file, group, "f")?, vector(file, group, "w")?, vector(file, group, "b")?];
    let sizes = [("f", force.len(), mass.shape[0]), ("w", w.len(), contacts.shape[1]), ("b", b.len(), joints.shape[1])];
    for (what, found, wanted) in sizes {
        if found != wanted {
            let field = format!("{group}/vectors/{what}");
            return Err(Error::invalid(field, format!("has {}", counted(found, "number")), format!("give {wanted}, as M, H and G have")));
        }
    }
    let (first, rows) = (contacts.shape[1], contacts.shape[1] + joints.shape[1]);
    require_room(rows)?;
    let below = joints.entries.into_iter().map(|(velocity, row, value)| (velocity, first + row, value));
    let columns = Sparse { shape: [contacts.shape[0], rows], entries: contacts.entries.into_iter().chain(below).collect() };
    let mechanism = SparseDynamics::new(&mass, &columns.transposed(), 1)?;
    let added = DVector::from_iterator(rows, w.into_iter().chain(b));
    let free = mechanism.contact_velocity(&mechanism.solve(&DVector::from_vec(force))) + added;
    let whole = Operator::from(mechanism.delassus()?).dense().clone();
    let dynamics = Known::listed(mechanism).dense().cloned();
    problem(file, group, name, whole, free, rows - first)?.made_of(dynamics)
}

fn vector(file: &File, group: &str, name: &str) -> Result<Vec<f64>> {
    numbers(file, &format!("{group}/vectors/{name}"))
}

fn problem(file: &File, group: &str, name: &str, whole: DMatrix<f64>, free: DVector<f64>, joints: usize) -> Result<JointedProblem> {
    let mut friction = vector(file, group, "mu")?;
    let contacts = std::iter::repeat_n(ConstraintKind::Contact, friction.len());
    let kinds = contacts.chain(std::iter::repeat_n(ConstraintKind::Bilateral { rows: 1 }, joints)).collect();
    friction.resize(friction.len() + joints, 0.0);
    let rows = dimension(file, &format!("{group}/spacedim"))?;
    JointedProblem::new(rows, kinds, whole, free)?.named(name).law(Law::Coulomb, friction)
}
