//! The numbers of a hard problem in fractions, for proofs that go through its patterns.

use crate::problem::ContactProblem;
use moreau_exact::scalar::{Rational, exact};
use nalgebra::{DMatrix, DVector};

/// u = W r + u_free and y = u + shift, with μ per contact.
pub(super) struct Data {
    /// Rows per contact.
    pub rows: usize,
    /// W \[1/kg\].
    pub w: DMatrix<Rational>,
    /// u_free \[m/s\].
    pub free: DVector<Rational>,
    /// The shift \[m/s\].
    pub shift: DVector<Rational>,
    /// μ, zero where nothing rubs.
    pub friction: Vec<Rational>,
}

impl Data {
    /// Those of a problem, with its W.
    pub fn new(problem: &ContactProblem, w: DMatrix<Rational>) -> Self {
        let rows = problem.rows_per_contact();
        let mu = |mu: &f64| if rows == 1 { Rational::ZERO } else { exact(problem.law().cone_friction(*mu)) };
        let (free, shift) = (problem.free_velocity().map(exact), problem.shift().map(exact));
        Data { rows, w, free, shift, friction: problem.friction().iter().map(mu).collect() }
    }
}
