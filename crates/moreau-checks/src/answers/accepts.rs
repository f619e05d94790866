//! The certificate as a function that accepts or refuses.

use moreau_contact::certificate::residuals;
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_exact::Result;

/// A certificate: whether an answer is a solution.
pub type Accepts = fn(&ContactProblem, &Solution) -> Result<bool>;

/// The certificate of this workspace.
///
/// # Errors
/// If the answer does not fit the problem.
pub fn accepts(problem: &ContactProblem, solution: &Solution) -> Result<bool> {
    Ok(residuals(problem, solution)?.is_solution(CERTIFY))
}
