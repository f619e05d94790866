//! The Delassus operator W of a contact problem: dense, by blocks, or by the bodies that contacts touch and never formed.
//!
//! ```text
//!     u = W r + u_free                                                                                [m/s]
//! ```

use crate::memory::spare;
use crate::tolerance::certificate::OVERREACHING;
use nalgebra::{DMatrix, DVector, DVectorView, DVectorViewMut};
use std::sync::OnceLock;

mod block_rows;
mod blocks;
mod contact_operator;
mod dense;
mod doubled;
mod islands;
mod lists;
mod lost_digits;
mod mass_block;
mod matrix_free;
mod of_mechanism;
pub mod passes;
pub(crate) mod slot;
mod sparse;
mod sparse_dynamics;
mod velocity_factor;
mod velocity_recovery;
mod written_out;

pub use block_rows::BlockRows;
pub use blocks::BlockSparse;
pub use contact_operator::ContactOperator;
pub(crate) use islands::Islands;
pub use islands::islands_of;
pub(crate) use lists::Lists;
pub use matrix_free::MatrixFree;
pub use of_mechanism::of_mechanism;
pub use sparse::Sparse;
pub use sparse_dynamics::SparseDynamics;
pub(crate) use velocity_factor::VelocityFactor;
#[cfg(test)]
pub(crate) use velocity_recovery::tests::wall;

/// W, however it is stored.
#[derive(Clone, Debug)]
pub enum Operator {
    /// All entries.
    Dense(DMatrix<f64>),
    /// The blocks of contacts that meet.
    Blocks(Blocks),
    /// The bodies that contacts touch; W is not formed.
    Bodies(Box<Bodies>),
}

/// W by the bodies that contacts touch, with its blocks once something asked for them.
#[derive(Clone, Debug)]
pub struct Bodies {
    free: MatrixFree,
    blocks: OnceLock<Option<Blocks>>,
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

impl From<MatrixFree> for Operator {
    fn from(free: MatrixFree) -> Self {
        Operator::Bodies(Box::new(Bodies { free, blocks: OnceLock::new() }))
    }
}

impl Bodies {
    /// The blocks of W, formed once; `None` where they would take more memory than is allowed.
    fn formed(&self) -> Option<&Blocks> {
        let form = || Some(Blocks { blocks: self.free.delassus().ok()?, dense: OnceLock::new() });
        self.blocks.get_or_init(form).as_ref()
    }
}

impl PartialEq for Operator {
    /// Whether both store the same entries in the same way.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Operator::Dense(own), Operator::Dense(other)) => own == other,
            (Operator::Blocks(own), Operator::Blocks(other)) => own.blocks == other.blocks,
            (Operator::Bodies(own), Operator::Bodies(other)) => own.free == other.free,
            _ => false,
        }
    }
}

impl Operator {
    /// The blocks of W, if it is stored so; where it is given by bodies they are formed once, if memory allows them.
    pub fn blocks(&self) -> Option<&BlockSparse> {
        match self {
            Operator::Dense(_) => None,
            Operator::Blocks(stored) => Some(&stored.blocks),
            Operator::Bodies(bodies) => bodies.formed().map(|formed| &formed.blocks),
        }
    }

    /// The blocks of W, if they are what is stored.
    pub(crate) fn stored_blocks(&self) -> Option<&BlockSparse> {
        match self {
            Operator::Blocks(stored) => Some(&stored.blocks),
            _ => None,
        }
    }

    /// Whether [`Self::blocks`] has them; those of W by bodies are not formed to know it.
    pub fn has_blocks(&self) -> bool {
        match self {
            Operator::Dense(_) => false,
            Operator::Blocks(_) => true,
            Operator::Bodies(bodies) => bodies.free.has_room_for_blocks(),
        }
    }

    /// W by the bodies that contacts touch, if it is given so.
    pub fn matrix_free(&self) -> Option<&MatrixFree> {
        match self {
            Operator::Bodies(bodies) => Some(&bodies.free),
            _ => None,
        }
    }

    /// Whether all entries are stored in a square matrix.
    pub fn is_dense(&self) -> bool {
        matches!(self, Operator::Dense(_))
    }

    /// What solvers and certificates ask of it.
    pub fn of_contacts(&self) -> &dyn ContactOperator {
        match self {
            Operator::Dense(dense) => dense,
            Operator::Blocks(stored) => &stored.blocks,
            Operator::Bodies(bodies) => &bodies.free,
        }
    }

    /// Rows of each contact; `None` where a square matrix does not tell.
    pub fn rows_per_contact(&self) -> Option<usize> {
        match self {
            Operator::Dense(_) => None,
            Operator::Blocks(stored) => Some(stored.blocks.rows_per_contact()),
            Operator::Bodies(bodies) => Some(bodies.free.rows_per_contact()),
        }
    }

    /// Numbers of rows and columns.
    pub fn shape(&self) -> [usize; 2] {
        match self {
            Operator::Dense(dense) => [dense.nrows(), dense.ncols()],
            Operator::Blocks(stored) => [stored.blocks.contacts() * stored.blocks.rows_per_contact(); 2],
            Operator::Bodies(bodies) => [bodies.free.contacts() * bodies.free.rows_per_contact(); 2],
        }
    }

    /// The entries that are stored, in the order they are: of W, or of the factor Y it is the product of.
    pub fn entries(&self) -> &[f64] {
        match self {
            Operator::Dense(dense) => dense.as_slice(),
            Operator::Blocks(stored) => stored.blocks.entries(),
            Operator::Bodies(bodies) => bodies.free.left(),
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
            Operator::Bodies(bodies) => bodies.free.entry(row, column),
        }
    }

    /// W r \[m/s\] for impulses r \[N·s\].
    ///
    /// # Panics
    /// If there are not as many impulses as rows.
    pub fn apply(&self, impulse: &DVector<f64>) -> DVector<f64> {
        let mut velocity = spare::zeros(impulse.len());
        self.write_product(impulse.as_slice(), velocity.as_mut_slice());
        velocity
    }

    /// Overwrites `velocity` \[m/s\] with W r for impulses r \[N·s\].
    pub(crate) fn write_product(&self, impulse: &[f64], velocity: &mut [f64]) {
        passes::note();
        if let Operator::Dense(dense) = self {
            let mut product = DVectorViewMut::from_slice(velocity, dense.nrows());
            return product.gemv(1.0, dense, &DVectorView::from_slice(impulse, dense.ncols()), 0.0);
        }
        velocity.fill(0.0);
        self.of_contacts().add_product(impulse, velocity);
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
            Operator::Bodies(bodies) => {
                let d = bodies.free.rows_per_contact();
                let mut contact = [0.0; 6];
                contact[j % d] = impulse;
                bodies.free.add_contact(j / d, &contact[..d], velocity);
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
        match (self, self.blocks()) {
            (Operator::Dense(dense), _) => dense.column(j).iter().enumerate().for_each(|(i, w)| nonzero(i, *w)),
            (_, Some(blocks)) => {
                let d = blocks.rows_per_contact();
                for (i, block) in blocks.column(j / d) {
                    block[j % d * d..(j % d + 1) * d].iter().enumerate().for_each(|(row, w)| nonzero(d * i + row, *w));
                }
            }
            // there is no memory for the blocks
            (_, None) => (0..self.shape()[0]).for_each(|i| nonzero(i, self.entry(i, j))),
        }
    }

    /// W as a square matrix; blocks are written out once and kept.
    ///
    /// # Panics
    /// If W is given by bodies and its blocks take more memory than is allowed;
    /// [`law_delassus`](crate::ContactProblem::law_delassus) is refused first.
    pub fn dense(&self) -> &DMatrix<f64> {
        let stored = match self {
            Operator::Dense(dense) => return dense,
            Operator::Blocks(stored) => stored,
            Operator::Bodies(bodies) => bodies.formed().expect("the blocks of W fit into memory where its square matrix does"),
        };
        stored.dense.get_or_init(|| stored.blocks.to_dense())
    }

    /// Whether some entry is larger than those of H M⁻¹ Hᵀ are, |W_ij|² ≤ W_ii W_jj, by more than their rounding.
    pub(crate) fn overreaches(&self, rows_per_contact: usize) -> bool {
        if let Operator::Bodies(_) = self {
            return false;
        }
        let mut block = vec![0.0; rows_per_contact * rows_per_contact];
        let mut diagonal = Vec::with_capacity(self.shape()[0]);
        for k in 0..self.shape()[0] / rows_per_contact.max(1) {
            self.of_contacts().diagonal_block(k, &mut block);
            diagonal.extend(block.iter().step_by(rows_per_contact + 1).map(|w| w.max(0.0).sqrt()));
        }
        (0..diagonal.len()).any(|j| {
            let mut found = false;
            self.for_each_in_column(j, |i, w| found |= w.abs() > OVERREACHING * diagonal[i] * diagonal[j]);
            found
        })
    }

    /// max |W − Wᵀ| / max |W|, zero where it is symmetric.
    pub fn asymmetry(&self) -> f64 {
        let [difference, scale] = match (self, self.matrix_free()) {
            (_, Some(free)) if free.is_symmetric() => return 0.0,
            (Operator::Dense(dense), _) => [(dense - dense.transpose()).amax(), dense.amax()],
            _ => self.blocks().map_or([f64::INFINITY, 1.0], BlockSparse::asymmetry),
        };
        if scale == 0.0 { 0.0 } else { difference / scale }
    }
}
