//! Gaussian elimination A x = b over an ordered field, exact over rationals.

use crate::scalar::{Rational, Scalar};
use crate::witness::{Part, Witness, decided, rational};
use nalgebra::{DMatrix, DVector};

/// The x with A x = b, or `None` if A is singular (for `f64`: if a pivot is exactly zero or not a number).
///
/// # Panics
/// If A is not square or b has another size.
///
/// ```
/// use moreau_exact::{elimination::solve, scalar::ratio};
/// use nalgebra::{dmatrix, dvector};
///
/// let matrix = dmatrix![ratio(2, 1), ratio(1, 1); ratio(1, 1), ratio(2, 1)];
/// assert_eq!(solve(&matrix, &dvector![ratio(1, 1), ratio(-2, 1)]), Some(dvector![ratio(4, 3), ratio(-5, 3)]));
/// assert_eq!(solve(&dmatrix![1.0, 1.0; 1.0, 1.0], &dvector![1.0, 2.0]), None); // singular
/// ```
pub fn solve<T: Scalar>(matrix: &DMatrix<T>, right_side: &DVector<T>) -> Option<DVector<T>> {
    let columns = DMatrix::from_column_slice(right_side.len(), 1, right_side.as_slice());
    let decide = || solve_columns(matrix, &columns).map(|solution| solution.column(0).into_owned());
    decided(decide, |found| {
        let (matrix, right_side): (&DMatrix<Rational>, &DVector<Rational>) = (rational(matrix)?, rational(right_side)?);
        let mut parts = vec![("matrix", Part::from(matrix)), ("right_side", Part::from(right_side))];
        match found {
            Some(x) => parts.push(("x", rational::<_, DVector<Rational>>(x)?.into())),
            None => parts.push(("x", Part::Word("singular"))),
        }
        Some(Witness { kind: "linear-system", parts })
    })
}

/// The X with A X = B, column by column; `None` as for [`solve`].
///
/// # Panics
/// If A is not square or B has another number of rows.
pub fn solve_columns<T: Scalar>(matrix: &DMatrix<T>, right_sides: &DMatrix<T>) -> Option<DMatrix<T>> {
    let size = right_sides.nrows();
    assert!(matrix.is_square() && matrix.nrows() == size, "elimination needs a square matrix and right sides of its size");
    // Rows lie in memory one after the other in the transpose.
    let (mut a, mut x) = (matrix.transpose(), right_sides.transpose());
    for k in 0..size {
        let pivot = largest_below(&a, k)?;
        a.swap_columns(k, pivot);
        x.swap_columns(k, pivot);
        eliminate(a.as_mut_slice(), x.as_mut_slice(), size, k);
    }
    substitute_back(&a, &mut x);
    Some(x.transpose())
}

/// Subtracts multiples of row k of A and of X from the rows below, where A has an entry to remove.
fn eliminate<T: Scalar>(a: &mut [T], x: &mut [T], size: usize, k: usize) {
    let columns = x.len() / size;
    let ((above, below), (solved, rest)) = (a.split_at_mut((k + 1) * size), x.split_at_mut((k + 1) * columns));
    let (pivot_row, right_row) = (&above[k * size + k..], &solved[k * columns..]);
    for (i, row) in below.chunks_exact_mut(size).enumerate() {
        if row[k].is_zero() {
            continue;
        }
        let factor = row[k].clone() / pivot_row[0].clone();
        subtract(&mut row[k + 1..], &factor, &pivot_row[1..]);
        subtract(&mut rest[i * columns..(i + 1) * columns], &factor, right_row);
    }
}

/// y ← y − f x .
fn subtract<T: Scalar>(y: &mut [T], factor: &T, x: &[T]) {
    let exact = T::spacing().is_zero();
    for (entry, other) in y.iter_mut().zip(x) {
        // a product of rationals costs more than the question
        if !(exact && other.is_zero()) {
            *entry -= factor.clone() * other.clone();
        }
    }
}

/// Overwrites B by the X with U X = B, both given by their transposes.
fn substitute_back<T: Scalar>(transposed: &DMatrix<T>, x: &mut DMatrix<T>) {
    let (size, columns) = (transposed.ncols(), x.nrows());
    for k in (0..size).rev() {
        let (above, solved) = x.as_mut_slice().split_at_mut((k + 1) * columns);
        let value = &mut above[k * columns..];
        for j in (k + 1..size).filter(|&j| !transposed[(j, k)].is_zero()) {
            subtract(value, &transposed[(j, k)], &solved[(j - k - 1) * columns..(j - k) * columns]);
        }
        value.iter_mut().for_each(|entry| *entry /= transposed[(k, k)].clone());
    }
}

/// The rank of A, exact over rationals (for `f64`: the number of pivots that are not exactly zero).
///
/// ```
/// use moreau_exact::{elimination::rank, scalar::ratio};
/// use nalgebra::dmatrix;
///
/// assert_eq!(rank(&dmatrix![ratio(1, 3), ratio(1, 7); ratio(7, 3), ratio(1, 1)]), 1); // the second row is seven times the first
/// ```
pub fn rank<T: Scalar>(matrix: &DMatrix<T>) -> usize {
    decided(
        || count_pivots(matrix),
        |rank| {
            let matrix: &DMatrix<Rational> = rational(matrix)?;
            Some(Witness { kind: "rank", parts: vec![("matrix", matrix.into()), ("rank", Part::Counts(vec![*rank]))] })
        },
    )
}

fn count_pivots<T: Scalar>(matrix: &DMatrix<T>) -> usize {
    let mut a = matrix.clone();
    let mut rank = 0;
    for column in 0..a.ncols() {
        let Some(pivot) = (rank..a.nrows()).find(|&i| !a[(i, column)].is_zero()) else { continue };
        a.swap_rows(rank, pivot);
        for i in rank + 1..a.nrows() {
            let factor = a[(i, column)].clone() / a[(rank, column)].clone();
            for j in column..a.ncols() {
                let change = factor.clone() * a[(rank, j)].clone();
                a[(i, j)] -= change;
            }
        }
        rank += 1;
    }
    rank
}

/// Row of the largest entry on or below the diagonal of column k, if one is non-zero; A is given by its transpose.
fn largest_below<T: Scalar>(transposed: &DMatrix<T>, k: usize) -> Option<usize> {
    let entry = |i: usize| transposed[(k, i)].magnitude();
    let best = (k + 1..transposed.ncols()).fold(k, |best, i| if entry(i) > entry(best) { i } else { best });
    (entry(best) > T::zero()).then_some(best)
}

/// The principal submatrix with these rows and columns.
pub fn principal<T: Scalar>(matrix: &DMatrix<T>, indices: &[usize]) -> DMatrix<T> {
    DMatrix::from_fn(indices.len(), indices.len(), |i, j| matrix[(indices[i], indices[j])].clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Rational, ratio};

    #[test]
    fn a_hilbert_system_is_solved_exactly_by_rationals() {
        let hilbert = DMatrix::from_fn(8, 8, |i, j| ratio(1, (i + j + 1) as i64));
        let x = DVector::from_fn(8, |i, _| ratio(i as i64 - 3, 7));
        let right_side = &hilbert * &x;
        assert_eq!(solve(&hilbert, &right_side), Some(x));
    }

    #[test]
    fn a_zero_leading_entry_needs_a_row_exchange_and_gets_it() {
        let a = DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 4.0, 0.0]);
        assert_eq!(solve(&a, &DVector::from_vec(vec![2.0, 8.0])), Some(DVector::from_vec(vec![2.0, 1.0])));
    }

    #[test]
    fn singular_and_nan_matrices_have_no_solution() {
        let singular = DMatrix::from_element(2, 2, ratio(1, 3));
        assert_eq!(solve(&singular, &DVector::<Rational>::from_element(2, ratio(1, 1))), None);
        assert_eq!(solve(&DMatrix::from_element(1, 1, f64::NAN), &DVector::from_element(1, 1.0)), None);
    }

    #[test]
    fn dependent_rows_are_recognised_and_independent_ones_too() {
        let matrix = |entries: [i64; 6]| DMatrix::from_row_slice(3, 2, &entries.map(|x| ratio(x, 1)));
        assert_eq!(rank(&matrix([1, 2, 2, 4, 3, 6])), 1);
        assert_eq!(rank(&matrix([0, 2, 2, 4, 3, 6])), 2);
        assert_eq!(rank(&matrix([0; 6])), 0);
    }
}
