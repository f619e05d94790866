//! Impulses that move nothing although they may press, proposed by rounded numbers and made exact in fractions.
//!
//! ```text
//!     λ ≥ 0 ,   B λ = 0 ,   c·λ < 0           B: what generators do, rows × generators;   c: their products with u_free + shift
//!     c·λ = −1   or, where that is too far for rounded numbers,   Σ λ = 1
//! ```
//! Where W is symmetric and semidefinite, no other impulses are witnesses that a problem has no solution: p ∈ K and −Wᵀp ∈ K* give
//! p·W p ≤ 0, hence W p = 0. The nearest point of the cone of the columns (b_j, c_j) to (0, −1), or of (b_j, 1) to (0, 1), tells which
//! generators take part, in rounded numbers, and so for any number of contacts; what these are times is a linear system, solved in whole
//! numbers digit by digit. What it returns solves the equations without rounding, or nothing is returned.

use super::least::nonnegative;
use crate::tolerance::proof::{TAKES_PART, WITNESS_DROPS};
use moreau_exact::lifting;
use moreau_exact::scalar::{Rational, Scalar};
use nalgebra::{DMatrix, DVector};

/// λ for the columns of B and the numbers c, if one is found within so many steps.
pub(super) fn weights(matrix: &DMatrix<Rational>, products: &[Rational], steps: usize) -> Option<DVector<Rational>> {
    let all: Vec<usize> = (0..products.len()).collect();
    let ones = vec![Rational::ONE; products.len()];
    let closing = Balance { matrix, row: products, value: -Rational::ONE }.weights(all, steps);
    closing.or_else(|| {
        let found = Balance { matrix, row: &ones, value: Rational::ONE }.weights(without_opposites(matrix, products), steps)?;
        let product = products.iter().zip(found.iter()).fold(Rational::ZERO, |sum, (c, x)| sum + c * x);
        (product < Rational::ZERO).then_some(found)
    })
}

/// All generators but those that undo the one before them, of which the one is kept that closes: both together do nothing.
fn without_opposites(matrix: &DMatrix<Rational>, products: &[Rational]) -> Vec<usize> {
    let undoes = |i: usize, j: usize| products[i] == -&products[j] && matrix.column(i).iter().zip(&matrix.column(j)).all(|(a, b)| *a == -b);
    let n = products.len();
    let after = |j: usize| j + 1 < n && undoes(j + 1, j);
    let before = |j: usize| j > 0 && undoes(j - 1, j);
    (0..n).filter(|&j| if products[j] < Rational::ZERO { true } else { !before(j) && (!after(j) || products[j].is_zero()) }).collect()
}

/// B λ = 0 beside one more equation.
struct Balance<'a> {
    matrix: &'a DMatrix<Rational>,
    row: &'a [Rational],
    value: Rational,
}

impl Balance<'_> {
    fn weights(&self, among: Vec<usize>, steps: usize) -> Option<DVector<Rational>> {
        let mut support = self.proposed(&among, steps);
        for _ in 0..=WITNESS_DROPS {
            let (kept, found) = self.solved(&support)?;
            support = (0..kept.len()).filter(|place| found[*place] > Rational::ZERO).map(|place| kept[place]).collect();
            if support.len() < kept.len() {
                continue; // without those that would pull or do nothing
            }
            let mut weights = DVector::from_element(self.row.len(), Rational::ZERO);
            kept.iter().zip(found.iter()).for_each(|(j, weight)| weights[*j] = weight.clone());
            return Some(weights);
        }
        None
    }

    /// Of these generators those that the nearest point of their cone takes part of.
    fn proposed(&self, among: &[usize], steps: usize) -> Vec<usize> {
        let m = self.matrix.nrows();
        let of = |number: &Rational, size: f64| if size > 0.0 { Scalar::to_f64(number) / size } else { 0.0 };
        let largest = |numbers: &mut dyn Iterator<Item = &Rational>| numbers.fold(0.0_f64, |most, x| most.max(Scalar::to_f64(x).abs()));
        let (moved, given) = (largest(&mut self.matrix.iter()), largest(&mut self.row.iter()));
        let entry = |i: usize, j: usize| if i < m { of(&self.matrix[(i, j)], moved) } else { of(&self.row[j], given) };
        let columns = DMatrix::from_fn(m + 1, among.len(), |i, j| entry(i, among[j]));
        let wanted = DVector::from_fn(m + 1, |i, _| if i < m { 0.0 } else { Scalar::to_f64(&self.value) });
        let (found, _) = nonnegative(&columns, &wanted, steps);
        let least = TAKES_PART * found.amax();
        (0..among.len()).filter(|j| found[*j] > least).map(|j| among[j]).collect()
    }

    /// The only λ of these columns, or of independent ones among them, without regard to its signs; none where the equations contradict.
    fn solved(&self, support: &[usize]) -> Option<(Vec<usize>, DVector<Rational>)> {
        if support.is_empty() {
            return None;
        }
        let m = self.matrix.nrows();
        let entry = |i: usize, j: usize| if i < m { self.matrix[(i, support[j])].clone() } else { self.row[support[j]].clone() };
        let all = DMatrix::from_fn(m + 1, support.len(), entry);
        let right = DVector::from_fn(m + 1, |i, _| if i < m { Rational::ZERO } else { self.value.clone() });
        let (whole, right) = lifting::whole_rows(&all, &right);
        let (rows, columns) = lifting::independent(&whole);
        let square = DMatrix::from_fn(rows.len(), columns.len(), |i, j| whole[(rows[i], columns[j])].clone());
        let found = lifting::solve(&square, &DVector::from_fn(rows.len(), |i, _| right[rows[i]].clone()))?.rationals();
        let fits = |i: usize| {
            let sum = columns.iter().zip(found.iter()).fold(Rational::ZERO, |sum, (j, x)| sum + Rational::from(whole[(i, *j)].clone()) * x);
            sum == Rational::from(right[i].clone())
        };
        let kept = columns.iter().map(|j| support[*j]).collect();
        (0..=m).all(fits).then_some((kept, found))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{exact, ratio};

    fn checked(matrix: &DMatrix<Rational>, products: &[Rational]) -> bool {
        weights(matrix, products, 50).is_some_and(|found| {
            let moved = matrix * &found;
            let product = products.iter().zip(found.iter()).fold(Rational::ZERO, |sum, (c, x)| sum + c * x);
            assert!(moved.iter().all(Rational::is_zero) && product < Rational::ZERO && found.iter().all(|x| *x >= Rational::ZERO));
            true
        })
    }

    /// Columns that balance with weights 1, ⅓, ¼, … of the last one, the first and so on: no rounded weights do.
    fn balanced(n: usize) -> DMatrix<Rational> {
        DMatrix::from_fn(n - 1, n, |i, j| match j {
            _ if j == i => exact(0.1 * (i + 1) as f64),
            _ if j + 1 == n => exact(-0.1 * (i + 1) as f64) * ratio(1, i as i64 + 3),
            _ => Rational::ZERO,
        })
    }

    #[test]
    fn weights_that_are_no_numbers_are_found_and_a_last_digit_hides_them() {
        let n = 30;
        let products = |last: i64| (0..n).map(|j| if j + 1 == n { ratio(last, 10) } else { ratio(1, 10) }).collect::<Vec<_>>();
        assert!(checked(&balanced(n), &products(-50)), "the last one closes faster than the others open");
        assert!(!checked(&balanced(n), &products(1)), "they open");
        assert!(!checked(&balanced(n).remove_column(3), &products(-50)[1..]), "without one of them nothing balances");
        // the last row says nearly what the eighth does
        let twice = |moved: Rational| {
            let mut rows = balanced(n).insert_row(n - 1, Rational::ZERO);
            (0..n).for_each(|j| rows[(n - 1, j)] = rows[(7, j)].clone());
            rows[(n - 1, 7)] += moved;
            rows
        };
        assert!(checked(&twice(Rational::ZERO), &products(-50)));
        assert!(!checked(&twice(ratio(1, 1 << 60)), &products(-50)), "nothing solves both");
    }

    #[test]
    fn a_balance_that_closes_by_a_last_digit_is_found_by_what_it_is() {
        let n = 25;
        // Σ c λ of weights 1, ⅓, ¼, … is −2⁻⁵⁰
        let mut products = vec![Rational::ONE; n];
        let others = (0..n - 1).fold(Rational::ZERO, |sum, j| sum + ratio(1, j as i64 + 3));
        products[n - 1] = -others - ratio(1, 1 << 50);
        assert!(checked(&balanced(n), &products));
        products[n - 1] += ratio(1, 1 << 50);
        assert!(!checked(&balanced(n), &products), "they are carried along");
    }

    #[test]
    fn of_opposites_that_of_them_is_kept_which_closes() {
        let matrix = DMatrix::from_row_slice(1, 6, &[1, -1, 2, -2, 3, -3].map(|x| ratio(x, 1)));
        assert_eq!(without_opposites(&matrix, &[1, -1, -5, 5, 0, 0].map(|x| ratio(x, 1))), [1, 2, 4]);
        assert_eq!(without_opposites(&matrix, &[1, 2, -5, -5, 0, 1].map(|x| ratio(x, 1))), [0, 1, 2, 3, 4, 5], "they differ");
    }

    #[test]
    fn generators_that_would_pull_are_left_out() {
        // 1 and 2 push against each other; 3 is there beside them, and with it the weights are not unique
        let matrix = DMatrix::from_row_slice(1, 3, &[1, -1, 0].map(|x| ratio(x, 1)));
        assert!(checked(&matrix, &[-1, 0, 1].map(|x| ratio(x, 1))));
        assert!(checked(&matrix, &[-1, 0, -1].map(|x| ratio(x, 1))), "3 alone");
        assert!(!checked(&matrix, &[1, 0, 1].map(|x| ratio(x, 1))));
    }
}
