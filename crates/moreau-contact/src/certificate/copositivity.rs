//! Copositive: xᵀM x ≥ 0 for all x ≥ 0. Copositive-plus: moreover xᵀM x = 0 with x ≥ 0 implies (M + Mᵀ) x = 0.
//!
//! With S = ½(M + Mᵀ), both are decided exactly on the principal submatrices of S:
//!
//! - **Copositive** ⇔ no S_αα x = −1 has a unique solution, and that positive. If one has, xᵀS_αα x = −Σx < 0.
//!   Conversely take α minimal with S_αα not copositive and minimise over the simplex: the minimum −ν < 0 is attained
//!   at an interior x, so S_αα x = −ν 1, and a kernel vector y of S_αα would have Σy = 0 and slide x along the minimum
//!   to the boundary of the simplex, against minimality; so S_αα is nonsingular and x/ν is the solution.
//! - **Plus**, for copositive S: x ≥ 0 has xᵀS x = 0 iff S_αα x_α = 0 on its support α, and then S x ≥ 0 everywhere.
//!   So it fails iff for some α there is x_α ≥ 0 with S_αα x_α = 0 and Σ (S x)ⱼ = 1 over j ∉ α, a linear system.

use super::Decision;
use super::definiteness::{positive_semidefinite, symmetric_part};
use super::feasibility::nonnegative_solution;
use dashu_ratio::RBig;
use moreau_exact::elimination::{principal, solve};
use moreau_exact::number::counted;
use moreau_exact::scalar::{Rational, ratio};
use moreau_exact::witness::{Part, Witness, decided};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Largest matrix decided: 2¹² principal submatrices.
pub const LARGEST: usize = 12;

/// Why a matrix is not copositive-plus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotPlus {
    /// x ≥ 0 with xᵀM x < 0: not even copositive.
    Negative(DVector<Rational>),
    /// x ≥ 0 with xᵀM x = 0 but (M + Mᵀ) x ≠ 0.
    Zero(DVector<Rational>),
}

/// Whether xᵀM x ≥ 0 for all x ≥ 0; the witness x ≥ 0 has xᵀM x < 0.
///
/// # Errors
/// [`Error::Unsupported`] for more than [`LARGEST`] rows.
/// ```
/// use moreau_contact::certificate::{Decision, copositivity::copositive};
/// use moreau_contact::nalgebra::dmatrix;
/// use moreau_contact::scalar::ratio;
///
/// let matrix = |beside: i64| dmatrix![ratio(1, 1), ratio(beside, 1); ratio(beside, 1), ratio(1, 1)];
/// assert!(copositive(&matrix(5))?.holds()); // indefinite, but not on x ≥ 0
/// let Decision::Fails(x) = copositive(&matrix(-2))? else { panic!("(1, 1) has xᵀM x = −2") };
/// assert!(x.iter().all(|entry| *entry > ratio(0, 1)));
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn copositive(matrix: &DMatrix<Rational>) -> Result<Decision<DVector<Rational>>> {
    decided(
        || decide(matrix),
        |found| {
            let mut parts = vec![("matrix", Part::from(matrix))];
            match found.as_ref().ok()? {
                Decision::Holds => parts.push(("answer", Part::Word("holds"))),
                Decision::Fails(x) => parts.extend([("answer", Part::Word("fails")), ("x", x.into())]),
            }
            Some(Witness { kind: "copositive", parts })
        },
    )
}

fn decide(matrix: &DMatrix<Rational>) -> Result<Decision<DVector<Rational>>> {
    let symmetric = checked_symmetric_part(matrix)?;
    let relevant = without_nonnegative_rows(&symmetric);
    for support in subsets_by_size(&relevant) {
        if let Some(positive) = descent(&symmetric, &support) {
            return Ok(Decision::Fails(embed(matrix.nrows(), &support, &positive)));
        }
    }
    Ok(Decision::Holds)
}

/// Whether M is copositive-plus, with the reason if not; of several, one with the smallest support.
///
/// # Errors
/// [`Error::Unsupported`] for more than [`LARGEST`] rows.
/// ```
/// use moreau_contact::certificate::copositivity::{NotPlus, copositive_plus};
/// use moreau_contact::nalgebra::dmatrix;
/// use moreau_contact::scalar::ratio;
///
/// // xᵀM x = 2 x₁x₂ vanishes at (1, 0), where (M + Mᵀ) x does not
/// let matrix = dmatrix![ratio(0, 1), ratio(1, 1); ratio(1, 1), ratio(0, 1)];
/// assert!(matches!(copositive_plus(&matrix)?.witness(), Some(NotPlus::Zero(_))));
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn copositive_plus(matrix: &DMatrix<Rational>) -> Result<Decision<NotPlus>> {
    decided(
        || decide_plus(matrix),
        |found| {
            let mut parts = vec![("matrix", Part::from(matrix))];
            match found.as_ref().ok()? {
                Decision::Holds => parts.push(("answer", Part::Word("holds"))),
                Decision::Fails(NotPlus::Negative(x)) => parts.extend([("answer", Part::Word("negative")), ("x", x.into())]),
                Decision::Fails(NotPlus::Zero(x)) => parts.extend([("answer", Part::Word("zero")), ("x", x.into())]),
            }
            Some(Witness { kind: "copositive-plus", parts })
        },
    )
}

fn decide_plus(matrix: &DMatrix<Rational>) -> Result<Decision<NotPlus>> {
    let symmetric = checked_symmetric_part(matrix)?;
    // xᵀS x = ‖S^½ x‖², so a semidefinite form vanishes only where S x does.
    if positive_semidefinite(&symmetric).holds() {
        return Ok(Decision::Holds);
    }
    if let Decision::Fails(negative) = copositive(&symmetric)? {
        return Ok(Decision::Fails(NotPlus::Negative(negative)));
    }
    let all: Vec<usize> = (0..matrix.nrows()).collect();
    for support in subsets_by_size(&all) {
        if let Some(zero) = zero_outside_the_kernel(&symmetric, &support) {
            return Ok(Decision::Fails(NotPlus::Zero(embed(matrix.nrows(), &support, &zero))));
        }
    }
    Ok(Decision::Holds)
}

fn checked_symmetric_part(matrix: &DMatrix<Rational>) -> Result<DMatrix<Rational>> {
    if matrix.nrows() > LARGEST {
        let message = format!("copositivity is decided up to size {LARGEST}, this matrix has {}", counted(matrix.nrows(), "row"));
        return Err(Error::Unsupported(message));
    }
    Ok(symmetric_part(matrix))
}

/// Indices that remain when rows without a negative entry are dropped, one after the other: such an xᵢ only adds to the form.
fn without_nonnegative_rows(symmetric: &DMatrix<Rational>) -> Vec<usize> {
    let mut indices: Vec<usize> = (0..symmetric.nrows()).collect();
    while let Some(position) = indices.iter().position(|&i| indices.iter().all(|&j| symmetric[(i, j)] >= RBig::ZERO)) {
        indices.remove(position);
    }
    indices
}

/// All non-empty subsets, small ones first.
fn subsets_by_size(indices: &[usize]) -> Vec<Vec<usize>> {
    let subset = |mask: usize| (0..indices.len()).filter(|k| mask >> k & 1 == 1).map(|k| indices[k]).collect::<Vec<_>>();
    let mut subsets: Vec<Vec<usize>> = (1..1usize << indices.len()).map(subset).collect();
    subsets.sort_by_key(Vec::len);
    subsets
}

/// The x > 0 with S_αα x = −1, if S_αα is nonsingular and x is positive.
fn descent(symmetric: &DMatrix<Rational>, support: &[usize]) -> Option<DVector<Rational>> {
    // A row of S_αα without a negative entry excludes x > 0.
    let has_negative = |&i: &usize| support.iter().any(|&j| symmetric[(i, j)] < RBig::ZERO);
    if !support.iter().all(has_negative) {
        return None;
    }
    let x = solve(&principal(symmetric, support), &DVector::from_element(support.len(), ratio(-1, 1)))?;
    x.iter().all(|x| *x > RBig::ZERO).then_some(x)
}

/// x_α ≥ 0 with S_αα x_α = 0 and Σ_{j∉α} (S x)ⱼ > 0, scaled to Σx = 1.
fn zero_outside_the_kernel(symmetric: &DMatrix<Rational>, support: &[usize]) -> Option<DVector<Rational>> {
    let size = support.len();
    let block = principal(symmetric, support);
    if solve(&block, &DVector::from_element(size, RBig::ZERO)).is_some() {
        return None;
    }
    let outside: Vec<usize> = (0..symmetric.nrows()).filter(|j| !support.contains(j)).collect();
    let system = DMatrix::from_fn(size + 1, size, |i, j| {
        if i < size {
            block[(i, j)].clone()
        } else {
            outside.iter().map(|&k| &symmetric[(k, support[j])]).fold(RBig::ZERO, |sum, x| sum + x)
        }
    });
    let right_side = DVector::from_fn(size + 1, |i, _| ratio(i64::from(i == size), 1));
    let zero = nonnegative_solution(&system, &right_side).point()?;
    let sum = zero.iter().fold(RBig::ZERO, |sum, x| sum + x);
    Some(zero / sum)
}

fn embed(size: usize, support: &[usize], values: &DVector<Rational>) -> DVector<Rational> {
    let mut x = DVector::from_element(size, RBig::ZERO);
    for (&i, value) in support.iter().zip(values.iter()) {
        x[i] = value.clone();
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::definiteness::quadratic_form;

    fn square(size: usize, entries: &[i64]) -> DMatrix<Rational> {
        DMatrix::from_row_slice(size, size, &entries.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>())
    }

    /// Horn's form, copositive but not the sum of a semidefinite and a non-negative matrix.
    fn horn() -> DMatrix<Rational> {
        DMatrix::from_fn(5, 5, |i, j| match (5 + i - j) % 5 {
            0 => ratio(1, 1),
            1 | 4 => ratio(-1, 1),
            _ => ratio(1, 1),
        })
    }

    #[test]
    fn horns_form_is_copositive_and_an_entry_less_is_not() {
        assert!(copositive(&horn()).unwrap().holds());
        for (i, j) in [(0, 0), (0, 1), (0, 2)] {
            let mut less = horn();
            less[(i, j)] -= ratio(1, 1 << 40);
            let witness = copositive(&less).unwrap().witness().expect("Horn's form is extreme");
            assert!(witness.iter().all(|x| *x >= RBig::ZERO));
            assert!(quadratic_form(&less, &witness) < RBig::ZERO);
        }
    }

    #[test]
    fn horns_form_vanishes_outside_its_kernel_and_is_not_copositive_plus() {
        let Some(NotPlus::Zero(x)) = copositive_plus(&horn()).unwrap().witness() else { panic!("e₁ + e₂ is a zero") };
        assert_eq!(quadratic_form(&horn(), &x), RBig::ZERO);
        assert!((horn() * x).iter().any(|y| !y.is_zero()));
    }

    #[test]
    fn two_by_two_matrices_follow_the_closed_form() {
        // [[a, b], [b, c]] is copositive iff a, c ≥ 0 and b ≥ −√(ac).
        for a in -1..=4 {
            for c in -1..=4 {
                for b in -5..=2i64 {
                    let expected = a >= 0 && c >= 0 && (b >= 0 || b * b <= a * c);
                    assert_eq!(copositive(&square(2, &[a, b, b, c])).unwrap().holds(), expected, "{a} {b} {c}");
                }
            }
        }
    }

    #[test]
    fn semidefinite_and_skew_matrices_are_copositive_plus() {
        assert!(copositive_plus(&square(2, &[1, -1, -1, 1])).unwrap().holds());
        assert!(copositive_plus(&square(2, &[0, 3, -3, 0])).unwrap().holds());
        assert!(!copositive_plus(&square(2, &[0, 1, 0, 0])).unwrap().holds());
        assert!(copositive_plus(&square(2, &[1, 4, 0, 1])).unwrap().holds(), "positive on the orthant apart from 0");
        assert!(matches!(copositive_plus(&square(2, &[1, -2, -1, 1])).unwrap(), Decision::Fails(NotPlus::Negative(_))));
    }

    #[test]
    fn thirteen_rows_are_refused() {
        assert!(copositive(&DMatrix::identity(13, 13)).is_err());
    }
}
