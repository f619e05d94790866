//! The mass and Jacobian that a problem is known to come from: as matrices, or by bodies until something asks for matrices.

use super::dynamics::Dynamics;
use crate::contact::{Inertia, Jacobian};
use crate::operator::BlockRows;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// M̂ and H, however they are kept.
#[derive(Clone, Debug)]
pub(super) enum Known {
    /// As matrices.
    Dense(Dynamics),
    /// As a step has them, with the matrices once something asked for them.
    Sparse { inertia: Arc<Inertia>, jacobian: Arc<Jacobian>, dense: OnceLock<Dynamics> },
}

impl Known {
    /// Whether M̂ is a matrix of numbers: no velocity is prescribed.
    pub fn is_finite(&self) -> bool {
        match self {
            Known::Dense(_) => true,
            Known::Sparse { inertia, .. } => inertia.mass().is_finite(),
        }
    }

    /// M̂ and H with all their zeros.
    pub fn dense(&self) -> &Dynamics {
        match self {
            Known::Dense(dynamics) => dynamics,
            Known::Sparse { inertia, jacobian, dense } => {
                dense.get_or_init(|| Dynamics { mass: inertia.matrix().clone(), jacobian: jacobian.to_dense() })
            }
        }
    }

    /// Appends the columns of H that the rows of a contact touch, growing.
    pub fn push_touched(&self, contact: usize, rows: usize, columns: &mut Vec<usize>) {
        match self {
            Known::Sparse { jacobian, .. } => columns.extend(jacobian.contacts()[contact].touched()),
            Known::Dense(Dynamics { jacobian, .. }) => {
                let rows = jacobian.rows(contact * rows, rows);
                columns.extend((0..jacobian.ncols()).filter(|column| rows.column(*column).iter().any(|entry| *entry != 0.0)));
            }
        }
    }
}

/// Appends the columns that the rows of a contact touch, of an H by bodies.
pub(super) fn push_columns_of(jacobian: &BlockRows, contact: usize, columns: &mut Vec<usize>) {
    let blocks = jacobian.contact(contact).map(|(body, block)| (jacobian.velocities(body), block));
    let is_touched =
        |range: &Range<usize>, block: &[f64], v: &usize| block.iter().skip(v - range.start).step_by(range.len()).any(|entry| *entry != 0.0);
    columns.extend(blocks.flat_map(|(range, block)| range.clone().filter(move |v| is_touched(&range, block, v))));
}

impl PartialEq for Known {
    /// Whether both are the same mass and Jacobian.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Known::Sparse { inertia, jacobian, .. }, Known::Sparse { inertia: mass, jacobian: rows, .. }) => {
                jacobian == rows && inertia.mass() == mass.mass()
            }
            _ => self.dense() == other.dense(),
        }
    }
}
