//! The W that a problem is about, in fractions: the stored one, or where mass and Jacobian are given the one that they make, not rounded.
//!
//! ```text
//!     W = H M̂⁻¹ Hᵀ = Σ_g H_g M̂_g⁻¹ H_gᵀ          g over the groups of velocities that M̂ couples
//! ```
//! With masses of 3 or 10 kg no stored W is that one: rows that are exactly dependent are so but for rounding there, and what is counted of
//! the stored W may have no solution where the problem has one.

use super::forward::groups;
use crate::problem::{ContactProblem, Dynamics};
use crate::tolerance::proof::{COUPLED_VELOCITIES, MADE_ROWS};
use moreau_exact::scalar::{Rational, exact};
use moreau_exact::{Error, Result};
use nalgebra::DMatrix;

/// What is known of W in fractions.
pub(super) enum TrueOperator {
    /// The problem is posed by W: the stored numbers are the problem.
    Stored,
    /// The problem is posed by mass and Jacobian, which make this W.
    Made(DMatrix<Rational>),
    /// The same, and making it takes too long.
    Unknown,
}

impl TrueOperator {
    pub(super) fn of(problem: &ContactProblem) -> Self {
        if !problem.knows_rows() {
            return TrueOperator::Stored;
        }
        let small = problem.rows() <= MADE_ROWS;
        problem.dynamics().filter(|_| small).and_then(made).map_or(TrueOperator::Unknown, TrueOperator::Made)
    }

    /// W, where it is known.
    pub(super) fn matrix(self, problem: &ContactProblem) -> Option<DMatrix<Rational>> {
        match self {
            TrueOperator::Stored => Some(problem.dense().map(exact)),
            TrueOperator::Made(matrix) => Some(matrix),
            TrueOperator::Unknown => None,
        }
    }
}

/// W in fractions.
///
/// # Errors
/// [`Error::Unsupported`] where making it takes too long.
pub(crate) fn operator(problem: &ContactProblem) -> Result<DMatrix<Rational>> {
    TrueOperator::of(problem).matrix(problem).ok_or_else(|| Error::Unsupported(UNKNOWN.into()))
}

/// Why nothing is counted of a problem whose W is not known in fractions.
const UNKNOWN: &str = "W of mass and Jacobian is made in fractions for small problems only";

/// Whether the stored W is the one of the problem to the last bit: what is proved of it is proved of the problem.
pub fn is_stored_exactly(problem: &ContactProblem) -> bool {
    match TrueOperator::of(problem) {
        TrueOperator::Stored => true,
        TrueOperator::Made(matrix) => matrix == problem.dense().map(exact),
        TrueOperator::Unknown => false,
    }
}

/// H M̂⁻¹ Hᵀ; none where a group of velocities is large or singular.
fn made(Dynamics { mass, jacobian }: &Dynamics) -> Option<DMatrix<Rational>> {
    let mut w = DMatrix::from_element(jacobian.nrows(), jacobian.nrows(), Rational::ZERO);
    for group in groups(mass) {
        let touching: Vec<usize> = (0..jacobian.nrows()).filter(|row| group.iter().any(|v| jacobian[(*row, *v)] != 0.0)).collect();
        if touching.is_empty() {
            continue;
        }
        if group.len() > COUPLED_VELOCITIES {
            return None;
        }
        let inverse = inverse(DMatrix::from_fn(group.len(), group.len(), |i, j| exact(mass[(group[i], group[j])])))?;
        let rows = DMatrix::from_fn(touching.len(), group.len(), |i, j| exact(jacobian[(touching[i], group[j])]));
        let own = &rows * inverse * rows.transpose();
        for (i, row) in touching.iter().enumerate() {
            touching.iter().enumerate().for_each(|(j, column)| w[(*row, *column)] += own[(i, j)].clone());
        }
    }
    Some(w)
}

/// M⁻¹ by Gauss and Jordan; none where M is singular.
fn inverse(mut matrix: DMatrix<Rational>) -> Option<DMatrix<Rational>> {
    let n = matrix.nrows();
    let mut inverse = DMatrix::from_fn(n, n, |i, j| if i == j { Rational::ONE } else { Rational::ZERO });
    for j in 0..n {
        let pivot = (j..n).find(|i| !matrix[(*i, j)].is_zero())?;
        [&mut matrix, &mut inverse].into_iter().for_each(|of| of.swap_rows(j, pivot));
        let by = Rational::ONE / matrix[(j, j)].clone();
        for of in [&mut matrix, &mut inverse] {
            (0..n).for_each(|k| of[(j, k)] *= by.clone());
        }
        for i in (0..n).filter(|i| *i != j) {
            let factor = matrix[(i, j)].clone();
            for of in [&mut matrix, &mut inverse] {
                for k in 0..n {
                    let part = factor.clone() * of[(j, k)].clone();
                    of[(i, k)] -= part;
                }
            }
        }
    }
    Some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Law;
    use crate::certificate::infeasible::infeasible;
    use crate::certificate::patterns::solutions;
    use crate::certificate::uniqueness::{Uniqueness, uniqueness};
    use moreau_exact::scalar::ratio;
    use nalgebra::{DVector, dmatrix, dvector};

    fn line(mass: f64, rows: &[f64], free: f64, law: Law, dimension: usize) -> ContactProblem {
        let jacobian = DMatrix::from_column_slice(rows.len(), 1, rows);
        ContactProblem::from_dynamics(DMatrix::from_element(1, 1, mass), jacobian, &DVector::from_element(1, free))
            .law(law)
            .rows_per_contact(dimension)
            .friction(vec![if dimension == 1 { 0.0 } else { 0.5 }; rows.len() / dimension])
            .build()
            .unwrap()
    }

    #[test]
    fn coupled_velocities_make_the_w_of_fractions_and_an_asymmetric_mass_its_own() {
        let (mass, rows) = (dmatrix![2.0, 1.0, 0.0; 0.5, 3.0, 0.0; 0.0, 0.0, 7.0], dmatrix![1.0, 2.0, 3.0; 0.0, 1.0, -1.0]);
        // M⁻¹ of the first two velocities is (3 −1; −½ 2)·2/11
        let of = |a: [i64; 3], b: [i64; 3]| {
            let inverse = [[ratio(6, 11), ratio(-2, 11)], [ratio(-1, 11), ratio(4, 11)]];
            let pair = |i: usize, j: usize| ratio(a[i], 1) * inverse[i][j].clone() * ratio(b[j], 1);
            pair(0, 0) + pair(0, 1) + pair(1, 0) + pair(1, 1) + ratio(a[2] * b[2], 7)
        };
        let (one, two) = ([1, 2, 3], [0, 1, -1]);
        let expected = DMatrix::from_row_slice(2, 2, &[of(one, one), of(one, two), of(two, one), of(two, two)]);
        assert_eq!(made(&Dynamics { mass, jacobian: rows }).unwrap(), expected);
        assert!(made(&Dynamics { mass: dmatrix![1.0, 1.0; 1.0, 1.0], jacobian: dmatrix![1.0, 0.0] }).is_none(), "singular");
    }

    #[test]
    fn rows_of_one_velocity_have_the_solutions_that_they_have_with_thirds_and_tenths() {
        // 49 kg: r = (0, 49) gives u = 0 exactly; of the stored W there is a witness against any solution
        let turned = line(49.0, &[3.0, -1.0], 1.0, Law::Frictionless, 1);
        assert!(infeasible(&turned).is_none() && !solutions(&turned).unwrap().found.is_empty());
        let stored = ContactProblem::new(turned.dense().clone(), turned.free_velocity().clone()).rows_per_contact(1);
        let stored = stored.law(Law::Frictionless).friction(vec![0.0; 2]).build().unwrap();
        assert!(solutions(&stored).unwrap().found.is_empty(), "what is planted: the rounded W");
        // in the plane, r = (98, 24.5, 0, 0)
        let slides = line(49.0, &[-1.0, 1.0, 3.0, -3.0], 1.5, Law::Coulomb, 2);
        assert_eq!(solutions(&slides).unwrap().found.len(), 1);
        // W of 10 kg and rows 5 and 1 has rank one: two impulses, one velocity
        let twice = line(10.0, &[5.0, 1.0], -10.0, Law::Frictionless, 1);
        assert!(matches!(uniqueness(&twice), Uniqueness::Velocity(_)));
    }

    #[test]
    fn a_stored_w_is_exact_where_masses_are_powers_of_two() {
        assert!(is_stored_exactly(&line(4.0, &[3.0, -1.0], 1.0, Law::Frictionless, 1)));
        assert!(!is_stored_exactly(&line(7.0, &[3.0, -1.0], 1.0, Law::Frictionless, 1)));
        let stored = ContactProblem::new(dmatrix![0.1], dvector![-1.0]).rows_per_contact(1).build().unwrap();
        assert!(is_stored_exactly(&stored), "W is the problem");
    }
}
