//! Family 1: W = H M⁻¹ Hᵀ is symmetric and positive semidefinite, and definite iff the rows of H are independent.
//!
//! The reference is not the factorisation under test: M X = Hᵀ is solved by exact elimination with row exchanges, and
//! W = H X. Column j of X is the velocity change of a unit impulse at row j, so this is the physical meaning of W.

use crate::finding::Finding;
use crate::tolerance::delassus::{EIGENVALUE_STEPS, gram_matrix};
use moreau_contact::certificate::definiteness::{Definiteness, definiteness, positive_semidefinite, quadratic_form};
use moreau_exact::elimination::{rank, solve};
use moreau_exact::scalar::{Rational, Scalar, exact};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use num_traits::Zero;

/// A way to compute the Delassus operator, over any numbers: the library's, or one with a planted mistake.
pub trait DelassusRule {
    /// W from M (nv × nv) and H (rows × nv).
    ///
    /// # Errors
    /// If the rule cannot be carried out.
    fn delassus<T: Scalar>(&self, mass: &DMatrix<T>, jacobian: &DMatrix<T>) -> Result<DMatrix<T>>;
}

/// The library's [`moreau_contact::contact::delassus::delassus`].
pub struct Library;

impl DelassusRule for Library {
    fn delassus<T: Scalar>(&self, mass: &DMatrix<T>, jacobian: &DMatrix<T>) -> Result<DMatrix<T>> {
        moreau_contact::contact::delassus::delassus(mass, jacobian)
    }
}

/// The findings of the family for one mechanism, given by its mass matrix and contact Jacobian.
///
/// # Errors
/// Those of the rule, and [`Error::Invalid`] if M is singular.
pub fn check(rule: &impl DelassusRule, mass: &DMatrix<Rational>, jacobian: &DMatrix<Rational>) -> Result<Vec<Finding>> {
    let w = rule.delassus(mass, jacobian)?;
    let rank = rank(jacobian);
    let decided = definiteness(&w);
    let mut findings = vec![
        Finding::exact("largest |W − Wᵀ|", &largest(&(&w - w.transpose())), &Rational::zero(), "1/kg"),
        Finding::exact(
            "largest |W − H (velocity changes of unit impulses)|",
            &largest(&(&w - unit_responses(mass, jacobian)?)),
            &Rational::zero(),
            "1/kg",
        ),
        Finding::decision("W is positive semidefinite", !matches!(decided, Definiteness::Indefinite { .. }), true),
        Finding::decision("W is positive definite iff H has full row rank", decided == Definiteness::Definite, rank == jacobian.nrows()),
    ];
    if let Definiteness::Semidefinite { rank: found, .. } = decided {
        findings.push(Finding::count("rank of W is the rank of H", found, rank));
    }
    let rounded = rule.delassus(&mass.map(|x| Scalar::to_f64(&x)), &jacobian.map(|x| Scalar::to_f64(&x)))?;
    findings.push(smallest_rayleigh_quotient(&rounded, mass.nrows()));
    Ok(findings)
}

/// The floating-point W is positive semidefinite up to the rounding of its own last step.
///
/// The smallest eigenvector is only a suggestion: its Rayleigh quotient is evaluated exactly, so the measured number is an upper bound of
/// λ_min whatever the eigenvalue solver does. Where the solver suggests nothing, since its iteration has left the numbers, elimination in
/// rationals finds a direction below the bound or shows that there is none.
pub fn smallest_rayleigh_quotient(delassus: &DMatrix<f64>, velocities: usize) -> Finding {
    let name = "smallest Rayleigh quotient of the rounded W";
    if delassus.is_empty() || delassus.iter().any(|x| !x.is_finite()) {
        return Finding::at_least(name, f64::NAN, 0.0, "1/kg");
    }
    along(delassus, suggested(delassus), name, gram_matrix(velocities, delassus.trace()))
}

fn along(delassus: &DMatrix<f64>, suggested: Option<DVector<Rational>>, name: &str, bound: f64) -> Finding {
    let direction = suggested.unwrap_or_else(|| below(delassus, bound));
    let quotient = quadratic_form(&delassus.map(exact), &direction) / direction.dot(&direction);
    Finding::at_least(name, Scalar::to_f64(&quotient), -bound, "1/kg")
}

/// The eigenvector of the smallest eigenvalue as `nalgebra` computes it, if its iteration ends and stays within the numbers.
fn suggested(delassus: &DMatrix<f64>) -> Option<DVector<Rational>> {
    let eigen = SymmetricEigen::try_new(delassus.clone(), f64::EPSILON, EIGENVALUE_STEPS * delassus.nrows())?;
    let direction = eigen.eigenvectors.column(eigen.eigenvalues.imin());
    direction.iter().all(|x| x.is_finite()).then(|| direction.map(exact)).filter(|direction| !direction.iter().all(Zero::is_zero))
}

/// A direction with xᵀWx < −bound xᵀx; the first axis, if there is none.
fn below(delassus: &DMatrix<f64>, bound: f64) -> DVector<Rational> {
    let shifted = delassus.map_with_location(|i, j, x| if i == j { exact(x) + exact(bound) } else { exact(x) });
    let axis = || DVector::from_fn(delassus.nrows(), |i, _| exact(if i == 0 { 1.0 } else { 0.0 }));
    positive_semidefinite(&shifted).witness().unwrap_or_else(axis)
}

/// H X with M X = Hᵀ, by Gaussian elimination.
fn unit_responses(mass: &DMatrix<Rational>, jacobian: &DMatrix<Rational>) -> Result<DMatrix<Rational>> {
    let response = |row: usize| solve(mass, &jacobian.row(row).transpose());
    let changes: Option<Vec<_>> = (0..jacobian.nrows()).map(response).collect();
    let changes = changes.ok_or_else(|| Error::invalid("mass", "is singular", "every velocity needs inertia"))?;
    Ok(DMatrix::from_fn(jacobian.nrows(), jacobian.nrows(), |i, j| jacobian.row(i).transpose().dot(&changes[j])))
}

fn largest(matrix: &DMatrix<Rational>) -> Rational {
    matrix.iter().map(Scalar::magnitude).fold(Rational::zero(), |a, b| if b > a { b } else { a })
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;

    fn matrix(rows: usize, columns: usize, entries: &[i64]) -> DMatrix<Rational> {
        DMatrix::from_row_slice(rows, columns, &entries.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>())
    }

    #[test]
    fn the_library_passes_with_and_without_redundant_rows() {
        let mass = matrix(2, 2, &[2, 1, 1, 3]);
        for jacobian in [matrix(2, 2, &[1, 0, 1, 1]), matrix(3, 2, &[1, 0, 1, 1, 2, 1]), matrix(1, 2, &[0, 0])] {
            let findings = check(&Library, &mass, &jacobian).unwrap();
            assert!(findings.iter().all(Finding::holds), "{findings:?}");
        }
    }

    /// Of 10⁶ random W `nalgebra` 0.35 suggests NaN for seven, all of rank one like this one.
    #[test]
    fn without_a_suggestion_elimination_decides() {
        let h = nalgebra::dvector![-1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, -1.0, -2.0, 0.0, -1.0, 3.0];
        let w = &h * h.transpose() / 128.0;
        let bound = gram_matrix(1, w.trace());
        assert!(along(&w, None, "x", bound).holds());
        let mut wrong = w.clone();
        wrong[(11, 11)] -= 1e-9;
        assert!(!along(&wrong, None, "x", bound).holds());
    }

    #[test]
    fn an_indefinite_or_broken_matrix_fails_the_rounded_check() {
        assert!(!smallest_rayleigh_quotient(&nalgebra::dmatrix![1.0, 1.0 + 1e-9; 1.0 + 1e-9, 1.0], 2).holds());
        assert!(smallest_rayleigh_quotient(&nalgebra::dmatrix![1.0, 1.0; 1.0, 1.0], 2).holds());
        assert!(!smallest_rayleigh_quotient(&nalgebra::dmatrix![f64::NAN], 1).holds());
    }
}
