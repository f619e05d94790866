//! Planted mistakes in exact decisions on matrices and in the certificate of an LCP.

use crate::decisions::{Decides, Solves, copositive, copositive_plus, lcp, p_matrix, semidefinite};
use crate::planted::{Family, Kind, Planted};
use moreau_contact::certificate::lcp::residuals;
use moreau_contact::certificate::{copositivity, definiteness, p_matrix as minors};
use moreau_contact::problem::Lcp;
use moreau_exact::scalar::{Rational, Scalar, ratio};
use nalgebra::{DMatrix, DVector};

const fn planted<S>(name: &'static str, mistake: &'static str, subject: S) -> Planted<S> {
    Planted { name, mistake, kind: Kind::Certificate, subject }
}

/// Decisions on semidefinite matrices.
pub static SEMIDEFINITE: Family<Decides> = Family {
    reference: |m| Ok(definiteness::positive_semidefinite(m).holds()),
    checks: &[("decisions/semidefinite", semidefinite)],
    planted: &[
        planted("decisions/leading-minors", "asks for leading minors that are not negative", |m| {
            Ok((1..=m.nrows()).all(|n| determinant(m, &(0..n).collect::<Vec<_>>()) >= ratio(0, 1)))
        }),
        planted("decisions/diagonal-alone", "asks for a diagonal that is not negative", |m| {
            Ok((0..m.nrows()).all(|i| m[(i, i)] >= ratio(0, 1)))
        }),
        planted("decisions/strictly", "asks for a definite matrix", |m| {
            let symmetric = definiteness::symmetric_part(m);
            Ok((1..=m.nrows()).all(|n| determinant(&symmetric, &(0..n).collect::<Vec<_>>()) > ratio(0, 1)))
        }),
        planted("decisions/upper-triangle-mirrored", "mirrors the upper triangle of a matrix that is not symmetric", |m| {
            let mirrored = DMatrix::from_fn(m.nrows(), m.ncols(), |i, j| m[(i.min(j), i.max(j))].clone());
            Ok(definiteness::positive_semidefinite(&mirrored).holds())
        }),
    ],
};

/// Decisions on copositive matrices.
pub static COPOSITIVE: Family<Decides> = Family {
    reference: |m| Ok(copositivity::copositive(m)?.holds()),
    checks: &[("decisions/copositive", copositive)],
    planted: &[
        planted("decisions/copositive-as-semidefinite", "asks for a semidefinite matrix", |m| {
            Ok(definiteness::positive_semidefinite(m).holds())
        }),
        planted("decisions/copositive-by-its-entries", "asks for entries that are not negative", |m| {
            Ok(m.iter().all(|entry| *entry >= ratio(0, 1)))
        }),
        planted("decisions/copositive-by-pairs", "asks every pair of rows and no more", |m| {
            let pairs = (0..m.nrows()).flat_map(|i| (0..=i).map(move |j| [j, i]));
            let copositive = |pair: [usize; 2]| {
                let rows = if pair[0] == pair[1] { vec![pair[0]] } else { pair.to_vec() };
                let part = DMatrix::from_fn(rows.len(), rows.len(), |i, j| m[(rows[i], rows[j])].clone());
                copositivity::copositive(&part).map(|decision| decision.holds())
            };
            pairs.map(copositive).collect::<moreau_exact::Result<Vec<_>>>().map(|all| all.into_iter().all(|one| one))
        }),
    ],
};

/// Decisions on copositive-plus matrices.
pub static COPOSITIVE_PLUS: Family<Decides> = Family {
    reference: |m| Ok(copositivity::copositive_plus(m)?.holds()),
    checks: &[("decisions/copositive-plus", copositive_plus)],
    planted: &[
        planted("decisions/plus-forgotten", "takes every copositive matrix for copositive-plus", |m| {
            Ok(copositivity::copositive(m)?.holds())
        }),
        planted("decisions/plus-of-one-side", "asks for M x = 0 in place of (M + Mᵀ) x = 0 at the unit vectors", |m| {
            let kernel = (0..m.nrows()).all(|i| m[(i, i)] != ratio(0, 1) || m.column(i).iter().all(|entry| *entry == ratio(0, 1)));
            Ok(kernel && copositivity::copositive(m)?.holds())
        }),
    ],
};

/// Decisions on P-matrices.
pub static P_MATRIX: Family<Decides> = Family {
    reference: |m| Ok(minors::p_matrix(m)?.holds()),
    checks: &[("decisions/p-matrix", p_matrix)],
    planted: &[
        planted("decisions/p-by-leading-minors", "asks the leading principal minors", |m| {
            Ok((1..=m.nrows()).all(|n| determinant(m, &(0..n).collect::<Vec<_>>()) > ratio(0, 1)))
        }),
        planted("decisions/p-as-definite", "asks for a positive definite symmetric part", |m| {
            let symmetric = definiteness::symmetric_part(m);
            Ok((1..=m.nrows()).all(|n| determinant(&symmetric, &(0..n).collect::<Vec<_>>()) > ratio(0, 1)))
        }),
        planted("decisions/p-nought", "lets minors be zero", |m| {
            let subsets = (1u32..1 << m.nrows()).map(|set| (0..m.nrows()).filter(|i| set >> i & 1 == 1).collect::<Vec<_>>());
            Ok(subsets.into_iter().all(|set| determinant(m, &set) >= ratio(0, 1)))
        }),
        planted("decisions/p-by-its-determinant", "asks for a positive determinant", |m| {
            Ok(determinant(m, &(0..m.nrows()).collect::<Vec<_>>()) > ratio(0, 1))
        }),
    ],
};

/// Certificates of an LCP.
pub static LCP: Family<Solves> = Family {
    reference: |lcp, z| residuals(lcp, z).vanish(),
    checks: &[("certificate/lcp", lcp)],
    planted: &[
        planted("certificate/lcp-without-signs-of-z", "lets z be negative", |lcp, z| {
            let found = residuals(lcp, z);
            found.dual == ratio(0, 1) && found.complementarity == ratio(0, 1)
        }),
        planted("certificate/lcp-without-signs-of-w", "lets w be negative", |lcp, z| {
            let found = residuals(lcp, z);
            found.primal == ratio(0, 1) && found.complementarity == ratio(0, 1)
        }),
        planted("certificate/lcp-without-products", "lets both members of a pair be positive", |lcp, z| {
            let found = residuals(lcp, z);
            found.primal == ratio(0, 1) && found.dual == ratio(0, 1)
        }),
        planted("certificate/lcp-transposed", "multiplies z by Mᵀ", |lcp, z| {
            residuals(&Lcp::new(lcp.matrix.transpose(), lcp.vector.clone()), z).vanish()
        }),
        planted("certificate/lcp-rounded", "decides in rounded numbers", |lcp, z| {
            let rounded = |vector: &DVector<Rational>| vector.map(|entry| Scalar::to_f64(&entry));
            let lcp = Lcp::new(lcp.matrix.map(|entry| Scalar::to_f64(&entry)), rounded(&lcp.vector));
            residuals(&lcp, &rounded(z)).vanish()
        }),
    ],
};

/// det M over these rows and columns, by cofactors.
fn determinant(matrix: &DMatrix<Rational>, rows: &[usize]) -> Rational {
    fn expand(matrix: &DMatrix<Rational>, rows: &[usize], columns: &[usize]) -> Rational {
        let Some((&first, rest)) = rows.split_first() else { return ratio(1, 1) };
        let term = |(k, &column): (usize, &usize)| {
            let left: Vec<usize> = columns.iter().copied().filter(|other| *other != column).collect();
            let sign = if k % 2 == 0 { ratio(1, 1) } else { ratio(-1, 1) };
            sign * &matrix[(first, column)] * expand(matrix, rest, &left)
        };
        columns.iter().enumerate().map(term).fold(ratio(0, 1), |sum, term| sum + term)
    }
    expand(matrix, rows, rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planted::passes;

    #[test]
    fn every_decision_passes_its_cases_and_every_wrong_one_does_not() {
        passes(&SEMIDEFINITE);
        passes(&COPOSITIVE);
        passes(&COPOSITIVE_PLUS);
        passes(&P_MATRIX);
        passes(&LCP);
    }
}
