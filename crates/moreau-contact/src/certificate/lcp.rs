//! Residuals of a proposed solution z of an LCP, w = M z + q; exact zeros over rationals are a proof.

use crate::problem::Lcp;
use moreau_exact::scalar::Scalar;
use nalgebra::DVector;

/// How far z is from 0 ≤ z ⟂ w ≥ 0.
#[derive(Clone, Debug, PartialEq)]
pub struct LcpResiduals<T: Scalar> {
    /// max(0, −zᵢ).
    pub primal: T,
    /// max(0, −wᵢ).
    pub dual: T,
    /// max |zᵢ wᵢ|.
    pub complementarity: T,
}

impl<T: Scalar> LcpResiduals<T> {
    /// Whether all residuals are exactly zero: over rationals, whether z is a solution.
    pub fn vanish(&self) -> bool {
        self.primal.is_zero() && self.dual.is_zero() && self.complementarity.is_zero()
    }
}

/// Residuals of z; a number that is not a number is passed on, not dropped.
///
/// # Panics
/// If z has another size than the problem.
pub fn residuals<T: Scalar>(lcp: &Lcp<T>, z: &DVector<T>) -> LcpResiduals<T> {
    let w = lcp.slack(z);
    LcpResiduals {
        primal: largest(z.iter().map(|z| -z.clone())),
        dual: largest(w.iter().map(|w| -w.clone())),
        complementarity: largest(z.iter().zip(w.iter()).map(|(z, w)| (z.clone() * w.clone()).magnitude())),
    }
}

/// max(0, values); an incomparable value (NaN) wins, whatever comes after it.
fn largest<T: Scalar>(values: impl Iterator<Item = T>) -> T {
    values.fold(T::zero(), |largest, value| if value <= largest || incomparable(&largest) { largest } else { value })
}

fn incomparable<T: Scalar>(x: &T) -> bool {
    x.partial_cmp(x).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};
    use nalgebra::DMatrix;

    fn lcp() -> Lcp<Rational> {
        Lcp::new(DMatrix::from_row_slice(2, 2, &[2, 1, 1, 2].map(|x| ratio(x, 1))), DVector::from_vec(vec![ratio(-1, 1), ratio(1, 1)]))
    }

    #[test]
    fn the_solution_leaves_exact_zeros() {
        assert!(residuals(&lcp(), &DVector::from_vec(vec![ratio(1, 2), ratio(0, 1)])).vanish());
    }

    #[test]
    fn each_residual_sees_its_own_violation() {
        let at = |a, b| residuals(&lcp(), &DVector::from_vec(vec![a, b]));
        assert_eq!(at(ratio(-1, 2), ratio(0, 1)).primal, ratio(1, 2));
        assert_eq!(at(ratio(0, 1), ratio(0, 1)).dual, ratio(1, 1));
        assert_eq!(at(ratio(1, 1), ratio(0, 1)).complementarity, ratio(1, 1));
        assert!(
            !at(ratio(-1, 2), ratio(0, 1)).vanish() && !at(ratio(0, 1), ratio(0, 1)).vanish() && !at(ratio(1, 1), ratio(0, 1)).vanish()
        );
    }

    #[test]
    fn nan_does_not_vanish() {
        let lcp = Lcp::new(DMatrix::identity(2, 2), DVector::from_vec(vec![1.0, 1.0]));
        let residuals = residuals(&lcp, &DVector::from_vec(vec![f64::NAN, 0.0]));
        assert!(!residuals.vanish() && residuals.complementarity.is_nan());
    }
}
