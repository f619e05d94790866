//! P-matrix: every principal minor is positive; then the LCP has exactly one solution for every q.
//!
//! With a₁₁ > 0 and the Schur complement M/a₁₁ = M₂₂ − M₂₁ a₁₁⁻¹ M₁₂, det M_{α∪1} = a₁₁ det (M/a₁₁)_α; so M is a
//! P-matrix iff a₁₁ > 0 and both M₂₂ and M/a₁₁ are. The complements are enclosed by intervals, and a minor whose sign they leave open is
//! computed in rationals.

use super::Decision;
use super::complementary_cones::LARGEST;
use crate::tolerance::complementarity::EXACT_MINORS;
use dashu_ratio::RBig;
use moreau_exact::elimination::{principal, solve_columns};
use moreau_exact::number::counted;
use moreau_exact::scalar::Rational;
use moreau_exact::witness::{Part, Witness, decided};
use moreau_exact::{Error, Result};
use nalgebra::DMatrix;

/// A principal minor that is not positive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Minor {
    /// Rows and columns of the minor.
    pub indices: Vec<usize>,
    /// Its value.
    pub value: Rational,
}

/// Whether all principal minors of M are positive; the witness is one that is not.
///
/// # Errors
/// [`Error::Unsupported`] for more than [`LARGEST`] rows; [`Error::Solver`] with the failure `limit` if intervals leave more than
/// [`EXACT_MINORS`] signs open.
/// ```
/// use moreau_contact::certificate::p_matrix::p_matrix;
/// use moreau_contact::nalgebra::dmatrix;
/// use moreau_contact::scalar::ratio;
///
/// let matrix = |beside: i64| dmatrix![ratio(1, 1), ratio(beside, 1); ratio(1, 1), ratio(1, 1)];
/// assert!(p_matrix(&matrix(0))?.holds());
/// assert_eq!(p_matrix(&matrix(1))?.witness().expect("a minor").indices, [0, 1]); // 1 − 1 = 0
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn p_matrix(matrix: &DMatrix<Rational>) -> Result<Decision<Minor>> {
    if matrix.nrows() > LARGEST {
        let message = format!("principal minors are decided up to size {LARGEST}, this matrix has {}", counted(matrix.nrows(), "row"));
        return Err(Error::Unsupported(message));
    }
    let bad = decided(
        || Minors { matrix, left: EXACT_MINORS }.first_bad(matrix.transpose().iter().map(around).collect(), 0, &mut Vec::new()),
        |found| {
            let found = found.as_ref().ok()?;
            let mut parts = vec![("matrix", Part::from(matrix))];
            match found {
                None => parts.push(("answer", Part::Word("holds"))),
                Some(minor) => {
                    let value = Part::Number(minor.value.clone());
                    parts.extend([("answer", Part::Word("fails")), ("indices", Part::Counts(minor.indices.clone())), ("value", value)]);
                }
            }
            Some(Witness { kind: "p-matrix", parts })
        },
    );
    Ok(bad?.map_or(Decision::Holds, Decision::Fails))
}

/// An interval, its ends rounded outward at every operation.
type Interval = [f64; 2];

fn minus([a, b]: Interval, [c, d]: Interval) -> Interval {
    [(a - d).next_down(), (b - c).next_up()]
}

fn times([a, b]: Interval, [c, d]: Interval) -> Interval {
    let products = [a * c, a * d, b * c, b * d];
    // a product that is not a number, 0·∞, makes ends that are none
    let least = products.iter().fold(f64::INFINITY, |least, p| if *p < least || p.is_nan() { *p } else { least });
    let largest = products.iter().fold(f64::NEG_INFINITY, |largest, p| if *p > largest || p.is_nan() { *p } else { largest });
    [least.next_down(), largest.next_up()]
}

/// 1/x for x > 0.
fn reciprocal([a, b]: Interval) -> Interval {
    [b.recip().next_down(), a.recip().next_up()]
}

fn around(number: &Rational) -> Interval {
    let nearest = number.to_f64().value();
    [nearest.next_down(), nearest.next_up()]
}

/// The Schur complement of some pivots on the indices that follow, enclosed.
fn enclosed_complement(matrix: &DMatrix<Rational>, pivots: &[usize], next: usize) -> Vec<Interval> {
    let rest: Vec<usize> = (next..matrix.nrows()).collect();
    let (k, n) = (pivots.len(), rest.len());
    let right = DMatrix::from_fn(k, n, |i, j| matrix[(pivots[i], rest[j])].clone());
    let through = solve_columns(&principal(matrix, pivots), &right).expect("its principal minors are positive");
    let entry = |i: usize, j: usize| {
        let sum = (0..k).fold(Rational::ZERO, |sum, l| sum + &matrix[(rest[i], pivots[l])] * &through[(l, j)]);
        around(&(&matrix[(rest[i], rest[j])] - sum))
    };
    (0..n * n).map(|place| entry(place / n, place % n)).collect()
}

/// The principal minors of a matrix.
struct Minors<'a> {
    matrix: &'a DMatrix<Rational>,
    /// How many more may be computed in fractions.
    left: usize,
}

impl Minors<'_> {
    /// Searches the minors that contain the `pivots`, none of the other indices below `next`, and any from there on; `complement` encloses
    /// the Schur complement of the pivots on the indices from `next`, row by row. Where it leaves a sign open, the minor is computed in
    /// rationals.
    fn first_bad(&mut self, mut complement: Vec<Interval>, next: usize, pivots: &mut Vec<usize>) -> Result<Option<Minor>> {
        let size = self.matrix.nrows() - next;
        if size == 0 {
            return Ok(None);
        }
        pivots.push(next);
        if complement[0][0] <= 0.0 || complement[0][0].is_nan() {
            self.left = self.left.checked_sub(1).ok_or_else(|| {
                Error::limit("p-matrix", format!("intervals leave the signs of more than {EXACT_MINORS} principal minors open"))
            })?;
            let value = minor(self.matrix, pivots);
            if value <= RBig::ZERO {
                return Ok(Some(Minor { indices: pivots.clone(), value }));
            }
            pivots.pop();
            complement = enclosed_complement(self.matrix, pivots, next);
            pivots.push(next);
        }
        let entry = |i: usize, j: usize| complement[i * size + j];
        let rest = |new: &dyn Fn(usize, usize) -> Interval| -> Vec<Interval> {
            (1..size).flat_map(|i| (1..size).map(move |j| (i, j))).map(|(i, j)| new(i, j)).collect()
        };
        let inverse = if complement[0][0] > 0.0 { reciprocal(complement[0]) } else { [0.0, f64::INFINITY] };
        let row: Vec<Interval> = (0..size).map(|j| times(entry(0, j), inverse)).collect();
        let with = rest(&|i, j| minus(entry(i, j), times(entry(i, 0), row[j])));
        pivots.pop();
        let without = self.first_bad(rest(&entry), next + 1, pivots)?;
        if without.is_some() {
            return Ok(without);
        }
        pivots.push(next);
        let found = self.first_bad(with, next + 1, pivots)?;
        pivots.pop();
        Ok(found)
    }
}

/// det M_αα, by elimination.
fn minor(matrix: &DMatrix<Rational>, indices: &[usize]) -> Rational {
    let mut rest = principal(matrix, indices);
    let mut value = RBig::ONE;
    while !rest.is_empty() {
        let Some(pivot) = (0..rest.nrows()).find(|&i| !rest[(i, 0)].is_zero()) else { return RBig::ZERO };
        if pivot > 0 {
            rest.swap_rows(0, pivot);
            value = -value;
        }
        value *= &rest[(0, 0)];
        let size = rest.nrows() - 1;
        rest = DMatrix::from_fn(size, size, |i, j| &rest[(i + 1, j + 1)] - &rest[(i + 1, 0)] * &rest[(0, j + 1)] / &rest[(0, 0)]);
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;

    fn square(size: usize, entries: &[i64]) -> DMatrix<Rational> {
        DMatrix::from_row_slice(size, size, &entries.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>())
    }

    #[test]
    fn a_dominant_asymmetric_matrix_is_p() {
        assert!(p_matrix(&square(3, &[4, -1, 2, 3, 5, -1, -2, 1, 6])).unwrap().holds());
    }

    #[test]
    fn the_bad_minor_is_named_with_its_value() {
        let minor = p_matrix(&square(3, &[1, 0, 2, 0, 1, 0, 3, 0, 1])).unwrap().witness().unwrap();
        assert_eq!(minor, Minor { indices: vec![0, 2], value: ratio(-5, 1) });
        let zero = p_matrix(&square(2, &[1, 1, 1, 1])).unwrap().witness().unwrap();
        assert_eq!(zero, Minor { indices: vec![0, 1], value: ratio(0, 1) });
    }

    /// Signs from determinants of all principal submatrices.
    fn by_all_minors(matrix: &DMatrix<Rational>) -> bool {
        (1..1usize << matrix.nrows()).all(|mask| {
            let indices: Vec<usize> = (0..matrix.nrows()).filter(|i| mask >> i & 1 == 1).collect();
            minor(matrix, &indices) > RBig::ZERO
        })
    }

    proptest::proptest! {
        #[test]
        fn intervals_decide_what_all_minors_decide(entries in proptest::collection::vec(-4i64..5, 25), size in 1usize..6, lift in 0i64..9) {
            let matrix = DMatrix::from_fn(size, size, |i, j| ratio(entries[5 * i + j] + if i == j { lift } else { 0 }, 3));
            let decision = p_matrix(&matrix).unwrap();
            proptest::prop_assert_eq!(decision.holds(), by_all_minors(&matrix));
            if let Decision::Fails(bad) = decision {
                proptest::prop_assert!(bad.value <= RBig::ZERO && minor(&matrix, &bad.indices) == bad.value);
            }
        }
    }

    #[test]
    fn a_minor_that_rounding_hides_is_decided_on_both_sides() {
        // det = ±2⁻⁷⁰, which intervals of 53 bits cannot tell from zero
        for sign in [1, -1] {
            let third = ratio(1, 3);
            let tiny = ratio(sign, 1 << 35) * ratio(1, 1 << 35);
            let matrix =
                DMatrix::from_row_slice(2, 2, &[third.clone(), ratio(1, 1), third.clone() * ratio(1, 7), ratio(1, 7) + tiny * ratio(3, 1)]);
            assert_eq!(p_matrix(&matrix).unwrap().holds(), sign == 1);
        }
    }

    #[test]
    fn more_open_signs_than_are_computed_end_undecided_and_never_as_yes_or_no() {
        // Σ_k 2⁻⁷⁰ᵏ v_k v_kᵀ with v_k = (1ᵏ, 2ᵏ, …): definite, and every further row of a minor is below the rounding of those before
        let matrix = |size: usize| {
            let tiny = ratio(1, 1 << 35) * ratio(1, 1 << 35);
            let power = |base: &Rational, k: usize| (0..k).fold(RBig::ONE, |product, _| product * base);
            let whole = |i: usize| ratio(i as i64 + 1, 1);
            let entry = |i, j| (0..size).fold(RBig::ZERO, |sum, k| sum + power(&(&tiny * whole(i) * whole(j)), k));
            DMatrix::from_fn(size, size, entry)
        };
        assert!(p_matrix(&matrix(6)).unwrap().holds());
        assert!(matches!(p_matrix(&matrix(10)), Err(Error::Solver { failure: moreau_exact::error::Failure::Limit, .. })));
    }

    #[test]
    fn twenty_rows_are_decided() {
        let mut matrix = DMatrix::from_fn(20, 20, |i, j| {
            if i == j {
                ratio(1, 1)
            } else if i > j {
                ratio(2, 1)
            } else {
                RBig::ZERO
            }
        });
        assert!(p_matrix(&matrix).unwrap().holds(), "triangular");
        matrix[(18, 19)] = ratio(1, 1); // [[1, 1], [2, 1]]
        assert_eq!(p_matrix(&matrix).unwrap().witness().expect("1 − 2").indices, [18, 19]);
        assert!(p_matrix(&DMatrix::identity(21, 21)).is_err());
    }
}
