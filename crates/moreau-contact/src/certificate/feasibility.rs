//! Is {x ≥ 0 : A x = b} empty? Decided exactly, with a point or a Farkas certificate.
//!
//! ```text
//!     either   x ≥ 0 with A x = b        or   y with Aᵀy ≤ 0 and bᵀy > 0 ,   never both (Farkas).
//! ```
//! Phase one of the simplex method with Bland's rule, which ends after finitely many pivots in exact arithmetic.

use dashu_ratio::RBig;
use moreau_exact::scalar::Rational;
use moreau_exact::witness::{Part, Witness, decided};
use nalgebra::{DMatrix, DVector};

/// The answer, with its witness.
#[derive(Clone, Debug, PartialEq)]
pub enum Feasibility {
    /// A vertex x ≥ 0 with A x = b: the columns of A with xⱼ > 0 are linearly independent.
    Point(DVector<Rational>),
    /// y with Aᵀy ≤ 0 and bᵀy > 0: proof that there is no such x.
    Farkas(DVector<Rational>),
}

impl Feasibility {
    /// The point, if there is one.
    pub fn point(self) -> Option<DVector<Rational>> {
        match self {
            Feasibility::Point(x) => Some(x),
            Feasibility::Farkas(_) => None,
        }
    }
}

/// Decides whether A x = b has a solution x ≥ 0.
///
/// # Panics
/// If b has not one entry per row of A.
/// ```
/// use moreau_contact::certificate::feasibility::{Feasibility, nonnegative_solution};
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::scalar::ratio;
///
/// let row = dmatrix![ratio(2, 1), ratio(3, 1)]; // 2 x₁ + 3 x₂ = b
/// assert!(nonnegative_solution(&row, &dvector![ratio(6, 1)]).point().is_some());
/// assert!(matches!(nonnegative_solution(&row, &dvector![ratio(-1, 1)]), Feasibility::Farkas(_)));
/// ```
pub fn nonnegative_solution(matrix: &DMatrix<Rational>, right_side: &DVector<Rational>) -> Feasibility {
    assert_eq!(matrix.nrows(), right_side.len(), "A x = b needs one entry of b per row");
    decided(
        || decide(matrix, right_side),
        |found| {
            let (answer, vector) = match found {
                Feasibility::Point(x) => ("point", x),
                Feasibility::Farkas(y) => ("farkas", y),
            };
            let data = [("matrix", matrix.into()), ("right_side", right_side.into())];
            let parts = data.into_iter().chain([("answer", Part::Word(answer)), ("vector", vector.into())]).collect();
            Some(Witness { kind: "nonnegative-solution", parts })
        },
    )
}

fn decide(matrix: &DMatrix<Rational>, right_side: &DVector<Rational>) -> Feasibility {
    let mut phase = PhaseOne::new(matrix, right_side);
    while let Some(entering) = phase.entering() {
        let row = phase.leaving(entering);
        phase.pivot(row, entering);
    }
    if phase.infeasibility() > RBig::ZERO { Feasibility::Farkas(phase.multipliers()) } else { Feasibility::Point(phase.point()) }
}

/// Rows (S A, I, S b) with S = diag(±1) making S b ≥ 0, and below them the sum of the rows whose basic variable is artificial.
struct PhaseOne {
    entries: DMatrix<Rational>,
    signs: Vec<Rational>,
    basis: Vec<usize>,
    variables: usize,
}

impl PhaseOne {
    fn new(matrix: &DMatrix<Rational>, right_side: &DVector<Rational>) -> Self {
        let (rows, variables) = matrix.shape();
        let signs: Vec<Rational> = right_side.iter().map(|b| if *b < RBig::ZERO { -RBig::ONE } else { RBig::ONE }).collect();
        let mut entries = DMatrix::from_element(rows + 1, variables + rows + 1, RBig::ZERO);
        for i in 0..rows {
            for j in 0..variables {
                entries[(i, j)] = &signs[i] * &matrix[(i, j)];
            }
            entries[(i, variables + i)] = RBig::ONE;
            entries[(i, variables + rows)] = &signs[i] * &right_side[i];
        }
        // The artificial columns get their cost 1 subtracted, which leaves 0 there.
        for j in (0..variables).chain([variables + rows]) {
            entries[(rows, j)] = (0..rows).fold(RBig::ZERO, |sum, i| sum + &entries[(i, j)]);
        }
        PhaseOne { entries, signs, basis: (variables..variables + rows).collect(), variables }
    }

    fn rows(&self) -> usize {
        self.basis.len()
    }

    fn last(&self) -> usize {
        self.entries.ncols() - 1
    }

    fn infeasibility(&self) -> Rational {
        self.entries[(self.rows(), self.last())].clone()
    }

    /// Bland: the first variable that lowers the infeasibility.
    fn entering(&self) -> Option<usize> {
        (0..self.variables).find(|&j| self.entries[(self.rows(), j)] > RBig::ZERO)
    }

    /// Bland: the smallest ratio, ties to the smallest variable.
    fn leaving(&self, entering: usize) -> usize {
        let candidates = (0..self.rows()).filter(|&i| self.entries[(i, entering)] > RBig::ZERO);
        let key = |i: &usize| (&self.entries[(*i, self.last())] / &self.entries[(*i, entering)], self.basis[*i]);
        candidates.min_by_key(key).expect("the infeasibility is bounded below by zero")
    }

    fn pivot(&mut self, row: usize, entering: usize) {
        let pivot = self.entries[(row, entering)].clone();
        for j in 0..self.entries.ncols() {
            self.entries[(row, j)] /= &pivot;
        }
        for i in (0..self.entries.nrows()).filter(|&i| i != row) {
            let factor = self.entries[(i, entering)].clone();
            if factor.is_zero() {
                continue;
            }
            for j in 0..self.entries.ncols() {
                if !self.entries[(row, j)].is_zero() {
                    let change = &factor * &self.entries[(row, j)];
                    self.entries[(i, j)] -= change;
                }
            }
        }
        self.basis[row] = entering;
    }

    fn point(&self) -> DVector<Rational> {
        let mut x = DVector::from_element(self.variables, RBig::ZERO);
        for (row, &variable) in self.basis.iter().enumerate().filter(|(_, variable)| **variable < self.variables) {
            x[variable] = self.entries[(row, self.last())].clone();
        }
        x
    }

    /// y = S (1 + the entries below the artificial columns): yᵀA and yᵀb stand in the last row.
    fn multipliers(&self) -> DVector<Rational> {
        let cost = |i: usize| &self.entries[(self.rows(), self.variables + i)] + RBig::ONE;
        DVector::from_fn(self.rows(), |i, _| &self.signs[i] * cost(i))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;

    fn system(rows: usize, columns: usize, a: &[i64], b: &[i64]) -> (DMatrix<Rational>, DVector<Rational>) {
        let numbers = |slice: &[i64]| slice.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>();
        (DMatrix::from_row_slice(rows, columns, &numbers(a)), DVector::from_vec(numbers(b)))
    }

    fn assert_proved(a: &DMatrix<Rational>, b: &DVector<Rational>, feasible: bool) {
        match nonnegative_solution(a, b) {
            Feasibility::Point(x) => {
                assert!(feasible && x.iter().all(|x| *x >= RBig::ZERO));
                assert_eq!(a * x, *b);
            }
            Feasibility::Farkas(y) => {
                assert!(!feasible && b.dot(&y) > RBig::ZERO);
                assert!((a.transpose() * y).iter().all(|x| *x <= RBig::ZERO));
            }
        }
    }

    #[test]
    fn every_answer_carries_its_proof() {
        for (a, b, feasible) in [
            (vec![1, 1, 0, 1, -1, 2], vec![1, 5], true),
            (vec![1, 1, 1, -1, -1, -1], vec![1, -1], true),
            (vec![1, 1, 1, -1, -1, -1], vec![1, 1], false),
            (vec![-1, -2, 0, 0, 1, 1], vec![1, 3], false),
            (vec![0, 0, 0, 0, 0, 0], vec![0, 0], true),
        ] {
            let (a, b) = system(2, 3, &a, &b);
            assert_proved(&a, &b, feasible);
        }
    }

    #[test]
    fn a_degenerate_system_ends() {
        // Beale's cycling example without its objective: all right sides zero but one.
        let (a, b) = system(3, 7, &[1, -240, -4, 36, 4, 0, 0, 1, -180, -1, 6, 0, 2, 0, 0, 0, 1, 0, 0, 0, 1], &[0, 0, 1]);
        assert_proved(&a, &b, true);
    }
}
