//! A x = b over the integers, exactly: the digits of x to a prime base, one after the other, until they are those of fractions.
//!
//! ```text
//!     x ≡ Σ xₖ pᵏ ,   xₖ = A⁻¹rₖ mod p ,   r₀ = b ,   rₖ₊₁ = (rₖ − A xₖ)/p          (Dixon)
//!     x = y / d ,     A y = d b                                                     checked without rounding
//! ```
//! Elimination in fractions costs n³ operations on numbers of n times the digits of the data; a digit of all of x costs n² on the data's
//! own. What the digits stand for is guessed, as the fractions of least numerator and denominator; what is returned fits the equations.

use crate::scalar::Rational;
use dashu_int::ops::{Abs, BitTest, Gcd, SquareRoot};
use dashu_int::{IBig, UBig};
use nalgebra::{DMatrix, DVector};

/// The base of the digits, 2⁶¹ − 1.
const PRIME: u64 = (1 << 61) - 1;

/// x = y/d.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fractions {
    /// y.
    pub numerators: DVector<IBig>,
    /// d > 0.
    pub denominator: IBig,
}

impl Fractions {
    /// x as rationals.
    pub fn rationals(&self) -> DVector<Rational> {
        self.numerators.map(|y| Rational::from_parts_signed(y, self.denominator.clone()))
    }
}

/// Every row of (A, b) times the least common denominator of its entries.
///
/// # Panics
/// If b has not one entry per row of A.
pub fn whole_rows(matrix: &DMatrix<Rational>, vector: &DVector<Rational>) -> (DMatrix<IBig>, DVector<IBig>) {
    assert_eq!(matrix.nrows(), vector.len(), "one entry per row");
    let common = |i: usize| {
        let denominators = matrix.row(i).iter().chain(std::iter::once(&vector[i])).map(|x| x.denominator().clone()).collect::<Vec<_>>();
        denominators.into_iter().fold(UBig::ONE, |least, d| &least / (&least).gcd(&d) * d)
    };
    let factors: Vec<UBig> = (0..vector.len()).map(common).collect();
    let whole = |i: usize, x: &Rational| x.numerator() * (&factors[i] / x.denominator());
    let matrix = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| whole(i, &matrix[(i, j)]));
    (matrix, DVector::from_fn(vector.len(), |i, _| whole(i, &vector[i])))
}

/// The x with A x = b, or `None` if A is singular – or, which no matrix but one made for it is, singular modulo 2⁶¹ − 1.
///
/// # Panics
/// If A is not square or b has another size.
/// ```
/// use moreau_exact::lifting::{solve, whole_rows};
/// use moreau_exact::scalar::ratio;
/// use nalgebra::{dmatrix, dvector};
///
/// let (matrix, vector) = whole_rows(&dmatrix![ratio(1, 2), ratio(1, 3); ratio(0, 1), ratio(2, 1)], &dvector![ratio(1, 1), ratio(1, 1)]);
/// assert_eq!(solve(&matrix, &vector).expect("regular").rationals(), dvector![ratio(5, 3), ratio(1, 2)]);
/// ```
pub fn solve(matrix: &DMatrix<IBig>, right_side: &DVector<IBig>) -> Option<Fractions> {
    let size = right_side.len();
    assert!(matrix.is_square() && matrix.nrows() == size, "lifting needs a square matrix and a right side of its size");
    let inverse = inverse(matrix)?;
    let (mut residual, mut modulus) = (right_side.clone(), IBig::ONE);
    let mut x = DVector::from_element(size, IBig::ZERO);
    let (limit, mut next) = (digits_needed(matrix, right_side), 4);
    for count in 1..=limit {
        let residues: Vec<u64> = residual.iter().map(residue).collect();
        let digits: Vec<u64> = inverse.chunks_exact(size.max(1)).map(|row| product(row, &residues)).collect();
        for (j, &digit) in digits.iter().enumerate().filter(|(_, digit)| **digit != 0) {
            for (r, a) in residual.iter_mut().zip(matrix.column(j).iter()).filter(|(_, a)| !a.is_zero()) {
                *r -= a * digit;
            }
            x[j] += &modulus * digit;
        }
        residual.iter_mut().for_each(|r| *r /= PRIME);
        modulus *= PRIME;
        if count == next || count == limit {
            let found = fractions(&x, &modulus).filter(|found| fits(matrix, right_side, found));
            if found.is_some() {
                return found;
            }
            next += next / 2;
        }
    }
    None
}

/// Whether A y = d b.
fn fits(matrix: &DMatrix<IBig>, right_side: &DVector<IBig>, found: &Fractions) -> bool {
    let mut rest = right_side.map(|b| b * &found.denominator);
    for (column, y) in matrix.column_iter().zip(found.numerators.iter()).filter(|(_, y)| !y.is_zero()) {
        for (r, a) in rest.iter_mut().zip(column.iter()).filter(|(_, a)| !a.is_zero()) {
            *r -= a * y;
        }
    }
    rest.iter().all(|r| r.is_zero())
}

/// Rows and columns of a largest submatrix that is regular modulo 2⁶¹ − 1, and so regular.
///
/// The others depend on them, unless a determinant is a multiple of that prime: no proof should rest on it.
pub fn independent(matrix: &DMatrix<IBig>) -> (Vec<usize>, Vec<usize>) {
    let mut rows: Vec<(usize, Vec<u64>)> = matrix.row_iter().map(|row| row.iter().map(residue).collect()).enumerate().collect();
    let mut columns = Vec::new();
    for j in 0..matrix.ncols() {
        let rank = columns.len();
        let Some(pivot) = (rank..rows.len()).find(|&i| rows[i].1[j] != 0) else { continue };
        rows.swap(rank, pivot);
        let (above, below) = rows.split_at_mut(rank + 1);
        let top = &above[rank].1;
        let quotient = reciprocal(top[j]);
        below.iter_mut().for_each(|(_, row)| subtract(&mut row[j..], &top[j..], quotient));
        columns.push(j);
    }
    let mut kept: Vec<usize> = rows[..columns.len()].iter().map(|(row, _)| *row).collect();
    kept.sort_unstable();
    (kept, columns)
}

/// A⁻¹ modulo p, row by row.
fn inverse(matrix: &DMatrix<IBig>) -> Option<Vec<u64>> {
    let size = matrix.nrows();
    let mut rows: Vec<Vec<u64>> = matrix
        .row_iter()
        .enumerate()
        .map(|(i, row)| row.iter().map(residue).chain((0..size).map(|j| u64::from(i == j))).collect())
        .collect();
    for k in 0..size {
        let pivot = (k..size).find(|&i| rows[i][k] != 0)?;
        rows.swap(k, pivot);
        let factor = reciprocal(rows[k][k]);
        rows[k].iter_mut().for_each(|entry| *entry = times(*entry, factor));
        let top = std::mem::take(&mut rows[k]);
        rows.iter_mut().enumerate().filter(|(i, _)| *i != k).for_each(|(_, row)| subtract(&mut row[k..], &top[k..], 1));
        rows[k] = top;
    }
    Some(rows.into_iter().flat_map(|row| row[size..].to_vec()).collect())
}

/// Takes from a row the multiple of another one, whose first entry is 1/`quotient`, that removes its first entry.
fn subtract(row: &mut [u64], other: &[u64], quotient: u64) {
    let factor = PRIME - times(row[0], quotient);
    if factor != PRIME {
        row.iter_mut().zip(other).filter(|(_, above)| **above != 0).for_each(|(entry, above)| *entry = plus(*entry, times(factor, *above)));
    }
}

fn residue(x: &IBig) -> u64 {
    let rest = x % IBig::from(PRIME);
    let rest = if rest < IBig::ZERO { rest + PRIME } else { rest };
    u64::try_from(rest).expect("a residue is below the prime")
}

fn plus(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= PRIME { sum - PRIME } else { sum }
}

/// a b modulo 2⁶¹ − 1, where 2⁶¹ ≡ 1.
fn times(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    plus((product & u128::from(PRIME)) as u64, (product >> 61) as u64)
}

fn product(row: &[u64], x: &[u64]) -> u64 {
    row.iter().zip(x).fold(0, |sum, (a, x)| plus(sum, times(*a, *x)))
}

/// 1/a = aᵖ⁻² (Fermat).
fn reciprocal(a: u64) -> u64 {
    let (mut power, mut result, mut exponent) = (a, 1, PRIME - 2);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = times(result, power);
        }
        power = times(power, power);
        exponent >>= 1;
    }
    result
}

/// Digits after which no fractions but x fit: numerators and d are determinants, at most the product of the rows of (A, b) in length
/// (Hadamard).
fn digits_needed(matrix: &DMatrix<IBig>, right_side: &DVector<IBig>) -> usize {
    let bits = |i: usize| {
        let square = matrix.row(i).iter().chain(std::iter::once(&right_side[i])).fold(IBig::ZERO, |sum, x| sum + x * x);
        square.abs().into_parts().1.bit_len().div_ceil(2)
    };
    (2 * (0..right_side.len()).map(bits).sum::<usize>() + 2).div_ceil(60) + 1
}

/// The fractions with one denominator whose residues modulo m are these.
fn fractions(residues: &DVector<IBig>, modulus: &IBig) -> Option<Fractions> {
    let bound = IBig::from((modulus / IBig::from(2)).into_parts().1.sqrt());
    let mut denominator = IBig::ONE;
    let mut numerators = DVector::from_element(residues.len(), IBig::ZERO);
    for i in 0..residues.len() {
        let least = centred(&residues[i] * &denominator, modulus);
        if least.clone().abs() <= bound {
            numerators[i] = least;
            continue;
        }
        let (numerator, factor) = fraction(&least, modulus, &bound)?;
        numerators.rows_mut(0, i).iter_mut().for_each(|y| *y *= &factor);
        denominator *= factor;
        numerators[i] = numerator;
    }
    Some(Fractions { numerators, denominator })
}

/// n/d with |n|, d ≤ bound and n ≡ a d, by Euclid's algorithm stopped halfway.
fn fraction(a: &IBig, modulus: &IBig, bound: &IBig) -> Option<(IBig, IBig)> {
    let (mut last, mut rest) = (modulus.clone(), if *a < IBig::ZERO { a + modulus } else { a.clone() });
    let (mut last_factor, mut factor) = (IBig::ZERO, IBig::ONE);
    while rest > *bound {
        let quotient = &last / &rest;
        let next = &last - &quotient * &rest;
        let next_factor = &last_factor - &quotient * &factor;
        (last, rest) = (rest, next);
        (last_factor, factor) = (factor, next_factor);
    }
    if factor.clone().abs() > *bound || factor.is_zero() {
        return None;
    }
    Some(if factor < IBig::ZERO { (-rest, -factor) } else { (rest, factor) })
}

/// The residue of least size.
fn centred(x: IBig, modulus: &IBig) -> IBig {
    let rest = x % modulus;
    let twice: IBig = &rest * 2;
    if twice > *modulus {
        rest - modulus
    } else if -twice > *modulus {
        rest + modulus
    } else {
        rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elimination;
    use crate::scalar::{exact, ratio};

    fn pseudo(seed: u64) -> impl FnMut() -> u64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            state >> 33
        }
    }

    #[test]
    fn fractions_of_floating_point_data_are_those_of_elimination() {
        let mut next = pseudo(7);
        for size in [1, 2, 5, 9] {
            let matrix = DMatrix::from_fn(size, size, |_, _| exact((next() as f64 / 1e9 - 1.0) / 3.0));
            let vector = DVector::from_fn(size, |_, _| exact((next() as f64 - 1e9) * 1e-17));
            let (whole, right) = whole_rows(&matrix, &vector);
            let found = solve(&whole, &right).expect("random matrices are regular").rationals();
            assert_eq!(Some(found), elimination::solve(&matrix, &vector), "{size}");
        }
    }

    #[test]
    fn a_known_solution_of_hilberts_matrix_is_found_and_a_singular_matrix_has_none() {
        let hilbert = DMatrix::from_fn(12, 12, |i, j| ratio(1, (i + j + 1) as i64));
        let x = DVector::from_fn(12, |i, _| ratio(i as i64 - 3, 7));
        let (whole, right) = whole_rows(&hilbert, &(&hilbert * &x));
        assert_eq!(solve(&whole, &right).expect("regular").rationals(), x);
        let one = DMatrix::from_element(2, 2, IBig::ONE);
        assert_eq!(solve(&one, &DVector::from_element(2, IBig::ONE)), None);
        assert_eq!(
            solve(&DMatrix::from_element(0, 0, IBig::ZERO), &DVector::from_element(0, IBig::ZERO))
                .expect("nothing to solve")
                .numerators
                .len(),
            0
        );
    }

    #[test]
    fn independent_rows_and_columns_are_those_of_the_rank() {
        let mut next = pseudo(3);
        let [left, right] = [(6, 3), (3, 6)].map(|(m, n)| DMatrix::from_fn(m, n, |_, _| ratio(next() as i64 % 19 - 9, 1)));
        let (whole, _) = whole_rows(&(left * right), &DVector::from_element(6, ratio(0, 1)));
        let (rows, columns) = independent(&whole);
        assert_eq!((rows.len(), columns.len()), (3, 3));
        let block = DMatrix::from_fn(3, 3, |i, j| Rational::from(whole[(rows[i], columns[j])].clone()));
        assert_eq!(elimination::rank(&block), 3);
    }

    #[test]
    fn a_wrong_answer_does_not_fit() {
        let matrix = DMatrix::from_row_slice(2, 2, &[2, 1, 1, 3].map(IBig::from));
        let right = DVector::from_row_slice(&[1, 1].map(IBig::from));
        let found = solve(&matrix, &right).expect("regular");
        assert!(fits(&matrix, &right, &found));
        let moved = Fractions { numerators: found.numerators.map(|y| y + 1), ..found.clone() };
        let scaled = Fractions { denominator: found.denominator.clone() + 1, ..found };
        assert!(!fits(&matrix, &right, &moved) && !fits(&matrix, &right, &scaled));
    }
}
