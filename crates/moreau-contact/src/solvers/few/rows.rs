//! M and q of a few contacts without friction, on the stack, and supports among their rows.

use super::parts::MOST;
use crate::operator::Operator;
use crate::problem::ContactProblem;

/// Rows as bits.
pub(super) type Support = u16;

/// M and q.
pub(super) struct Rows {
    pub size: usize,
    pub matrix: [[f64; MOST]; MOST],
    pub vector: [f64; MOST],
    /// Whether q is u_free and M is W, with nothing added.
    pub is_plain: bool,
}

const _: () = assert!(MOST <= Support::BITS as usize, "a support has a bit for every row");

/// The support of one row.
pub(super) fn bit(row: usize) -> Support {
    1 << row
}

impl Rows {
    /// Of a W that is stored.
    pub(super) fn of(problem: &ContactProblem) -> Option<Rows> {
        let (size, rows) = (problem.contacts(), problem.rows_per_contact());
        let mut made = Rows { size, matrix: [[0.0; MOST]; MOST], vector: [0.0; MOST], is_plain: true };
        match problem.delassus() {
            Operator::Dense(dense) => {
                for k in 0..size {
                    let column = &dense.as_slice()[k * rows * size * rows..][..size * rows];
                    (0..size).for_each(|j| made.matrix[j][k] = column[j * rows]);
                }
            }
            stored => {
                let blocks = stored.blocks()?;
                (0..size).for_each(|k| blocks.column(k).for_each(|(j, block)| made.matrix[j][k] = block[0]));
            }
        }
        let (free, shift) = (problem.free_velocity().as_slice(), problem.shift().as_slice());
        for k in 0..size {
            made.matrix[k][k] += problem.row_compliance(k * rows);
            made.vector[k] = free[k * rows] + shift[k * rows];
            made.is_plain &= shift[k * rows] == 0.0 && problem.row_compliance(k * rows) == 0.0;
        }
        Some(made)
    }
}
