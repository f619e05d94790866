//! Sign of a quadratic form, xᵀA x, decided exactly by LDLᵀ with symmetric pivoting.
//!
//! Congruences TᵀA T = diag(positive pivots, rest) until the rest has no positive diagonal entry. If the rest is zero,
//! A is positive semidefinite; otherwise a unit vector, or the difference or sum of two, makes the form negative.

use super::Decision;
use dashu_ratio::RBig;
use moreau_exact::scalar::{Rational, ratio};
use moreau_exact::witness::{Part, Witness, decided};
use nalgebra::{DMatrix, DVector};

/// Inertia of a quadratic form as far as it decides definiteness.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Definiteness {
    /// xᵀA x > 0 for all x ≠ 0.
    Definite,
    /// xᵀA x ≥ 0, with equality for this x ≠ 0, where (A + Aᵀ) x = 0.
    Semidefinite {
        /// x.
        kernel: DVector<Rational>,
        /// Rank of A + Aᵀ.
        rank: usize,
    },
    /// xᵀA x < 0 for this x.
    Indefinite {
        /// x.
        witness: DVector<Rational>,
    },
}

/// Decides the sign of xᵀA x; only the symmetric part of A counts.
///
/// # Panics
/// If A is not square.
pub fn definiteness(matrix: &DMatrix<Rational>) -> Definiteness {
    decided(
        || decide(matrix),
        |found| {
            let mut parts = vec![("matrix", Part::from(matrix))];
            match found {
                Definiteness::Definite => parts.push(("answer", Part::Word("definite"))),
                Definiteness::Semidefinite { kernel, rank } => {
                    parts.extend([("answer", Part::Word("semidefinite")), ("kernel", kernel.into()), ("rank", Part::Counts(vec![*rank]))]);
                }
                Definiteness::Indefinite { witness } => parts.extend([("answer", Part::Word("indefinite")), ("x", witness.into())]),
            }
            Some(Witness { kind: "definiteness", parts })
        },
    )
}

fn decide(matrix: &DMatrix<Rational>) -> Definiteness {
    let size = matrix.nrows();
    let mut a = symmetric_part(matrix);
    let mut transform = DMatrix::<Rational>::identity(size, size);
    let mut rest: Vec<usize> = (0..size).collect();
    while let Some(position) = rest.iter().position(|&i| a[(i, i)] > RBig::ZERO) {
        let pivot = rest.swap_remove(position);
        eliminate(&mut a, &mut transform, pivot, &rest);
    }
    if let Some(reduced) = negative_direction(&a, &rest) {
        return Definiteness::Indefinite { witness: transform * reduced };
    }
    match rest.first() {
        None => Definiteness::Definite,
        Some(&i) => Definiteness::Semidefinite { kernel: transform.column(i).into_owned(), rank: size - rest.len() },
    }
}

/// Whether xᵀA x ≥ 0 for all x; the witness x has xᵀA x < 0.
/// ```
/// use moreau_contact::certificate::definiteness::{positive_semidefinite, quadratic_form};
/// use moreau_contact::nalgebra::dmatrix;
/// use moreau_contact::scalar::ratio;
///
/// let matrix = |beside: i64| dmatrix![ratio(1, 1), ratio(beside, 1); ratio(beside, 1), ratio(1, 1)];
/// assert!(positive_semidefinite(&matrix(1)).holds());
/// let x = positive_semidefinite(&matrix(2)).witness().expect("indefinite");
/// assert!(quadratic_form(&matrix(2), &x) < ratio(0, 1));
/// ```
pub fn positive_semidefinite(matrix: &DMatrix<Rational>) -> Decision<DVector<Rational>> {
    match definiteness(matrix) {
        Definiteness::Indefinite { witness } => Decision::Fails(witness),
        _ => Decision::Holds,
    }
}

/// ½(A + Aᵀ), which has the same quadratic form.
///
/// # Panics
/// If A is not square.
pub fn symmetric_part(matrix: &DMatrix<Rational>) -> DMatrix<Rational> {
    (matrix + matrix.transpose()) * ratio(1, 2)
}

/// xᵀA x.
pub fn quadratic_form(matrix: &DMatrix<Rational>, x: &DVector<Rational>) -> Rational {
    decided(
        || x.dot(&(matrix * x)),
        |value| Some(Witness::new("quadratic-form", vec![("matrix", matrix.into()), ("vector", x.into()), ("value", value.into())])),
    )
}

/// Clears row and column `pivot` of A by a congruence, on the indices that remain, and records it in the transformation.
fn eliminate(a: &mut DMatrix<Rational>, transform: &mut DMatrix<Rational>, pivot: usize, rest: &[usize]) {
    for &j in rest {
        let factor = &a[(pivot, j)] / &a[(pivot, pivot)];
        if factor.is_zero() {
            continue;
        }
        for &i in rest {
            let change = &factor * &a[(i, pivot)];
            a[(i, j)] -= change;
        }
        for i in 0..transform.nrows() {
            let change = &factor * &transform[(i, pivot)];
            transform[(i, j)] -= change;
        }
    }
}

/// A vector on `rest` with negative form, where no diagonal entry is positive.
fn negative_direction(a: &DMatrix<Rational>, rest: &[usize]) -> Option<DVector<Rational>> {
    let unit = |i: usize| DVector::from_fn(a.nrows(), |k, _| ratio(i64::from(k == i), 1));
    if let Some(&i) = rest.iter().find(|&&i| a[(i, i)] < RBig::ZERO) {
        return Some(unit(i));
    }
    let pairs = rest.iter().flat_map(|&i| rest.iter().map(move |&j| (i, j)));
    pairs
        .filter(|(i, j)| i < j)
        .find(|&(i, j)| !a[(i, j)].is_zero())
        .map(|(i, j)| if a[(i, j)] > RBig::ZERO { unit(i) - unit(j) } else { unit(i) + unit(j) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(size: usize, entries: &[i64]) -> DMatrix<Rational> {
        DMatrix::from_row_slice(size, size, &entries.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>())
    }

    #[test]
    fn a_gram_matrix_of_dependent_vectors_is_semidefinite_with_its_kernel() {
        let vectors = DMatrix::from_row_slice(2, 3, &[1, 2, 3, 0, 1, 1].map(|x| ratio(x, 3)));
        let gram = vectors.transpose() * &vectors;
        let Definiteness::Semidefinite { kernel, rank } = definiteness(&gram) else { panic!("rank 2 of 3") };
        assert_eq!(rank, 2);
        assert!(kernel.iter().any(|x| !x.is_zero()));
        assert_eq!(gram * kernel, DVector::from_element(3, RBig::ZERO));
    }

    #[test]
    fn both_sides_of_the_boundary_of_the_semidefinite_cone() {
        let tiny = ratio(1, 1 << 60);
        let mut matrix = square(2, &[1, 2, 2, 4]);
        assert!(positive_semidefinite(&matrix).holds());
        matrix[(1, 1)] += tiny.clone();
        assert_eq!(definiteness(&matrix), Definiteness::Definite);
        matrix[(1, 1)] -= ratio(2, 1) * tiny;
        let witness = positive_semidefinite(&matrix).witness().unwrap();
        assert!(quadratic_form(&matrix, &witness) < RBig::ZERO);
    }

    #[test]
    fn zero_diagonals_with_an_off_diagonal_entry_are_indefinite() {
        for entry in [1, -1] {
            let matrix = square(3, &[2, 1, 1, 1, 0, entry, 1, entry, 0]);
            let witness = positive_semidefinite(&matrix).witness().unwrap();
            assert!(quadratic_form(&matrix, &witness) < RBig::ZERO);
        }
    }

    #[test]
    fn only_the_symmetric_part_counts() {
        assert_eq!(definiteness(&square(2, &[1, 100, -100, 1])), Definiteness::Definite);
    }
}
