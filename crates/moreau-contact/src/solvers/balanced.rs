//! Rows and columns of a linear complementarity problem brought to one size, by powers of two: nothing is rounded.
//!
//! ```text
//!     0 ≤ z′ ⟂ R M C z′ + R q ≥ 0 ,   z = C z′ ,   R and C diagonal, of powers of two
//! ```
//! has the supports of 0 ≤ z ⟂ M z + q ≥ 0. Signs of pivots are those of M: with R M C for M, a path of pivots is one with the covering
//! vector R⁻¹d for d, so that what is proved of positive semidefinite M, of P-matrices and of copositive ones holds as before.

use crate::problem::Lcp;
use crate::tolerance::complementarity::{BALANCING_ROUNDS, ONE_SIZE};
use nalgebra::{DMatrix, DVector};

/// C and the problem with R M C and R q; `None` where rows are of one size already, and columns too.
pub(super) fn balanced(lcp: &Lcp<f64>) -> Option<(Lcp<f64>, DVector<f64>)> {
    let size = lcp.size();
    let sizes = lcp.matrix.map(exponent);
    let spread = |largest: Vec<i32>| {
        let known = || largest.iter().filter(|size| **size > NONE);
        known().max().zip(known().min()).map_or(0, |(most, least)| most - least)
    };
    let rows = spread((0..size).map(|i| sizes.row(i).max()).collect());
    let columns = spread((0..size).map(|j| sizes.column(j).max()).collect());
    if rows.max(columns) <= ONE_SIZE {
        return None;
    }
    let (mut row, mut column) = (vec![0; size], vec![0; size]);
    for _ in 0..BALANCING_ROUNDS {
        (0..size).for_each(|i| row[i] = -median((0..size).map(|j| (sizes[(i, j)], column[j]))));
        (0..size).for_each(|j| column[j] = -median((0..size).map(|i| (sizes[(i, j)], row[i]))));
    }
    // at last, the largest entry of each row is about one
    for i in 0..size {
        row[i] = -(0..size).filter(|j| sizes[(i, *j)] > NONE).map(|j| sizes[(i, j)] + column[j]).max().unwrap_or(0);
    }
    let power = |exponent: i32| 2f64.powi(exponent);
    let matrix = DMatrix::from_fn(size, size, |i, j| lcp.matrix[(i, j)] * power(row[i] + column[j]));
    let vector = DVector::from_fn(size, |i, _| lcp.vector[i] * power(row[i]));
    let is_exact = |(new, old): (&f64, &f64)| new.is_finite() && (new.is_normal() || *old == 0.0);
    let is_kept = matrix.iter().zip(&lcp.matrix).chain(vector.iter().zip(&lcp.vector)).all(is_exact);
    is_kept.then(|| (Lcp::new(matrix, vector), DVector::from_iterator(size, column.into_iter().map(power))))
}

/// The exponent of no number.
const NONE: i32 = i32::MIN;

/// e with 2ᵉ ≤ |x| < 2ᵉ⁺¹.
fn exponent(x: f64) -> i32 {
    if x.is_normal() { (x.abs().to_bits() >> (f64::MANTISSA_DIGITS - 1)) as i32 - (f64::MAX_EXP - 1) } else { NONE }
}

/// The median of the sizes, each with what is added to it; zero where there is none. One entry that is rounding moves it little.
fn median(sizes: impl Iterator<Item = (i32, i32)>) -> i32 {
    let mut known: Vec<i32> = sizes.filter(|(size, _)| *size > NONE).map(|(size, added)| size + added).collect();
    let middle = known.len() / 2;
    if known.is_empty() { 0 } else { *known.select_nth_unstable(middle).1 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::{ContactProblem, Law};
    use crate::solvers::{ContactSolver, LemkePivoting, Murty, NewtonMin, ParametricPivoting};
    use nalgebra::{dmatrix, dvector};

    /// A P-matrix, and q whose solution is (1, 0, 2) with w = (0, 3, 0).
    fn plain() -> Lcp<f64> {
        let matrix = dmatrix![4.0, -1.0, 2.0; 3.0, 5.0, -1.0; -2.0, 1.0, 6.0];
        let (z, w) = (dvector![1.0, 0.0, 2.0], dvector![0.0, 3.0, 0.0]);
        Lcp::new(matrix.clone(), w - matrix * z)
    }

    fn with_sizes(lcp: &Lcp<f64>, rows: [i32; 3], columns: [i32; 3]) -> Lcp<f64> {
        let power = |exponent: i32| 2f64.powi(exponent);
        let matrix = DMatrix::from_fn(3, 3, |i, j| lcp.matrix[(i, j)] * power(rows[i] + columns[j]));
        Lcp::new(matrix, DVector::from_fn(3, |i, _| lcp.vector[i] * power(rows[i])))
    }

    #[test]
    fn rows_of_one_size_are_left_alone_and_one_power_more_is_not() {
        let row_of = |exponent: i32| with_sizes(&plain(), [0, exponent, 0], [0; 3]);
        assert!(balanced(&row_of(ONE_SIZE)).is_none());
        let (lcp, columns) = balanced(&row_of(ONE_SIZE + 1)).expect("row 1 is of another size");
        assert!(lcp.matrix.row_iter().all(|row| (1.0..2.0).contains(&row.amax())), "{}", lcp.matrix);
        assert!(columns.max() <= 4.0 * columns.min(), "{columns}");
        assert!(balanced(&Lcp::new(DMatrix::zeros(2, 2), dvector![-1.0, 1.0])).is_none(), "nothing has a size");
        assert!(balanced(&Lcp::new(DMatrix::zeros(0, 0), DVector::zeros(0))).is_none());
    }

    #[test]
    fn what_was_made_of_several_sizes_is_undone_to_the_last_bit() {
        let wild = with_sizes(&plain(), [-40, 35, 0], [30, 0, -25]);
        let (lcp, columns) = balanced(&wild).expect("of several sizes");
        let ratio = |i: usize, j: usize| lcp.matrix[(i, j)] / (wild.matrix[(i, j)] * columns[j]);
        for i in 0..3 {
            assert!((0..3).all(|j| ratio(i, j) == ratio(i, 0)) && lcp.vector[i] == wild.vector[i] * ratio(i, 0), "row {i}");
            assert!(exponent(ratio(i, 0)) > NONE && ratio(i, 0).to_bits() << 12 == 0, "a power of two");
        }
        assert!(lcp.matrix.amin() > 0.06, "{}", lcp.matrix);
        // what would underflow is left as it is
        let tiny = 2f64.powi(-1000);
        for (large, known) in [(2f64.powi(60), false), (2f64.powi(9), true)] {
            assert_eq!(balanced(&Lcp::new(dmatrix![tiny, large; 1.0, tiny], dvector![1.0, -1.0])).is_some(), known);
        }
    }

    #[test]
    fn pivots_solve_a_problem_whose_rows_and_columns_are_of_several_sizes() {
        let (rows, columns) = ([-40, 38, 3], [25, -40, 0]);
        let Lcp { matrix, vector } = with_sizes(&plain(), rows, columns);
        let problem = ContactProblem::new(matrix, vector).law(Law::Frictionless).rows_per_contact(1).build().unwrap();
        let solvers: [&dyn ContactSolver; 4] = [&LemkePivoting, &Murty::default(), &ParametricPivoting::default(), &NewtonMin::default()];
        for solver in solvers {
            let answer = solver.solve(&problem, None).unwrap_or_else(|error| panic!("{error}"));
            let found = DVector::from_fn(3, |j, _| answer.impulse[j] * 2f64.powi(columns[j]));
            assert!((&found - dvector![1.0, 0.0, 2.0]).amax() <= 1e-14, "{}: {found}", solver.name());
            assert!(residuals(&problem, &answer).unwrap().is_solution(1e-12), "{}", solver.name());
        }
    }
}
