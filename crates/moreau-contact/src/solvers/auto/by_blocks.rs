//! A dense W of which most blocks are zero, as the blocks that are not: the same numbers, and algorithms that pass over the zeros.

use crate::certificate::Judge;
use crate::operator::BlockSparse;
use crate::problem::ContactProblem;
use crate::tolerance::solvers::FEWEST_BY_BLOCKS;

/// The same problem by blocks, if W is dense, its rows are many and at least half of their pairs do not meet.
pub(super) fn stored(problem: &ContactProblem) -> Option<ContactProblem> {
    // a soft one is solved by its mass and Jacobian
    if problem.rows() < FEWEST_BY_BLOCKS || !problem.delassus().is_dense() || problem.compliance().is_some() {
        return None;
    }
    let blocks = BlockSparse::of_dense(problem.delassus().dense(), problem.rows_per_contact())?;
    // which contacts share a pair of bodies is told by mass and Jacobian, too
    Judge::default().prepare(problem);
    Some(problem.stored_as(blocks))
}
