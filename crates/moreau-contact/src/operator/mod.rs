//! The Delassus operator W of a contact problem, stored densely or by blocks: what solvers and certificates ask of it.
//!
//! ```text
//!     u = W r + u_free                                                                                [m/s]
//! ```

use nalgebra::{DMatrix, DVector};
use std::sync::OnceLock;

mod blocks;
mod sparse;
mod sparse_dynamics;

pub use blocks::BlockSparse;
pub use sparse::Sparse;
pub use sparse_dynamics::SparseDynamics;

/// W, however it is stored.
#[derive(Clone, Debug)]
pub enum Operator {
    /// All entries.
    Dense(DMatrix<f64>),
    /// The blocks of contacts that meet.
    Blocks(Blocks),
}

/// W by blocks, with the square matrix of all entries once something asked for it.
#[derive(Clone, Debug)]
pub struct Blocks {
    blocks: BlockSparse,
    dense: OnceLock<DMatrix<f64>>,
}

impl From<DMatrix<f64>> for Operator {
    fn from(dense: DMatrix<f64>) -> Self {
        Operator::Dense(dense)
    }
}

impl From<BlockSparse> for Operator {
    fn from(blocks: BlockSparse) -> Self {
        Operator::Blocks(Blocks { blocks, dense: OnceLock::new() })
    }
}

impl PartialEq for Operator {
    /// Whether both store the same entries in the same way.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Operator::Dense(own), Operator::Dense(other)) => own == other,
            (Operator::Blocks(own), Operator::Blocks(other)) => own.blocks == other.blocks,
            _ => false,
        }
    }
}

impl Operator {
    /// The blocks, if W is stored so.
    pub fn blocks(&self) -> Option<&BlockSparse> {
        match self {
            Operator::Dense(_) => None,
            Operator::Blocks(stored) => Some(&stored.blocks),
        }
    }

    /// Numbers of rows and columns.
    pub fn shape(&self) -> [usize; 2] {
        match self {
            Operator::Dense(dense) => [dense.nrows(), dense.ncols()],
            Operator::Blocks(stored) => [stored.blocks.contacts() * stored.blocks.rows_per_contact(); 2],
        }
    }

    /// The entries that are stored, in the order they are.
    pub fn entries(&self) -> &[f64] {
        match self {
            Operator::Dense(dense) => dense.as_slice(),
            Operator::Blocks(stored) => stored.blocks.entries(),
        }
    }

    /// W_ij \[1/kg\].
    ///
    /// # Panics
    /// If there is no such row or column.
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        match self {
            Operator::Dense(dense) => dense[(row, column)],
            Operator::Blocks(stored) => stored.blocks.entry(row, column),
        }
    }

    /// W r \[m/s\] for impulses r \[N·s\].
    ///
    /// # Panics
    /// If there are not as many impulses as rows.
    pub fn apply(&self, impulse: &DVector<f64>) -> DVector<f64> {
        match self {
            Operator::Dense(dense) => dense * impulse,
            Operator::Blocks(stored) => {
                let d = stored.blocks.rows_per_contact();
                let mut velocity = DVector::zeros(impulse.len());
                for (k, contact) in impulse.as_slice().chunks_exact(d.max(1)).enumerate() {
                    if contact.iter().any(|r| *r != 0.0) {
                        stored.blocks.add_contact(k, contact, velocity.as_mut_slice());
                    }
                }
                velocity
            }
        }
    }

    /// Adds W e_j r to `velocity` \[m/s\]: what the impulse r \[N·s\] at row j alone changes.
    ///
    /// # Panics
    /// If there is no row j.
    pub fn add_column(&self, j: usize, impulse: f64, velocity: &mut [f64]) {
        match self {
            Operator::Dense(dense) => velocity.iter_mut().zip(dense.column(j).iter()).for_each(|(u, w)| *u += impulse * w),
            Operator::Blocks(stored) => {
                let d = stored.blocks.rows_per_contact();
                for (i, block) in stored.blocks.column(j / d) {
                    let column = &block[j % d * d..(j % d + 1) * d];
                    velocity[d * i..d * i + d].iter_mut().zip(column).for_each(|(u, w)| *u += impulse * w);
                }
            }
        }
    }

    /// Gives every entry of column j that is stored and not zero, with its row, rows growing.
    ///
    /// # Panics
    /// If there is no column j.
    pub fn for_each_in_column(&self, j: usize, mut give: impl FnMut(usize, f64)) {
        let mut nonzero = |i: usize, w: f64| {
            if w != 0.0 {
                give(i, w)
            }
        };
        match self {
            Operator::Dense(dense) => dense.column(j).iter().enumerate().for_each(|(i, w)| nonzero(i, *w)),
            Operator::Blocks(stored) => {
                let d = stored.blocks.rows_per_contact();
                for (i, block) in stored.blocks.column(j / d) {
                    block[j % d * d..(j % d + 1) * d].iter().enumerate().for_each(|(row, w)| nonzero(d * i + row, *w));
                }
            }
        }
    }

    /// Adds Σ_j |W_ij| |r_j| to every entry i, for bounds of rounding.
    pub(crate) fn add_magnitudes(&self, impulse: &[f64], sums: &mut [f64]) {
        match self {
            Operator::Dense(dense) => {
                for (column, r) in impulse.iter().enumerate().filter(|(_, r)| **r != 0.0) {
                    sums.iter_mut().zip(dense.column(column).iter()).for_each(|(sum, w)| *sum += w.abs() * r.abs());
                }
            }
            Operator::Blocks(stored) => {
                for (k, contact) in impulse.chunks_exact(stored.blocks.rows_per_contact()).enumerate() {
                    if contact.iter().any(|r| *r != 0.0) {
                        stored.blocks.add_magnitudes(k, contact, sums);
                    }
                }
            }
        }
    }

    /// W as a square matrix; blocks are written out once and kept.
    pub fn dense(&self) -> &DMatrix<f64> {
        match self {
            Operator::Dense(dense) => dense,
            Operator::Blocks(stored) => stored.dense.get_or_init(|| stored.blocks.to_dense()),
        }
    }

    /// max |W − Wᵀ| / max |W|, zero where it is symmetric.
    pub fn asymmetry(&self) -> f64 {
        let [difference, scale] = match self {
            Operator::Dense(dense) => [(dense - dense.transpose()).amax(), dense.amax()],
            Operator::Blocks(stored) => stored.blocks.asymmetry(),
        };
        if scale == 0.0 { 0.0 } else { difference / scale }
    }
}
