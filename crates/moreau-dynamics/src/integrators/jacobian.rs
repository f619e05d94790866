//! The Jacobian of a map by forward-mode differentiation: column j is the slope of f(x + ε e_j).

use moreau_exact::scalar::{Dual, Scalar};
use nalgebra::{DMatrix, DVector};

/// ∂f/∂x at a point, one row per entry of f; where f has a kink, column j is the derivative to the side of +e_j.
///
/// ```
/// use moreau_dynamics::integrators::jacobian::jacobian;
/// use nalgebra::{dmatrix, dvector};
///
/// let found = jacobian(&dvector![3.0, 5.0], |x| dvector![x[0].clone() * x[1].clone()]);
/// assert_eq!(found, dmatrix![5.0, 3.0]);
/// ```
pub fn jacobian<T: Scalar>(at: &DVector<T>, map: impl Fn(&DVector<Dual<T>>) -> DVector<Dual<T>>) -> DMatrix<T> {
    let column = |j: usize| {
        let slope = |i: usize| if i == j { T::one() } else { T::zero() };
        let point = DVector::from_fn(at.len(), |i, _| Dual { value: at[i].clone(), slope: slope(i) });
        map(&point).map(|entry| entry.slope)
    };
    let columns: Vec<DVector<T>> = (0..at.len()).map(column).collect();
    DMatrix::from_columns(&columns)
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;

    #[test]
    fn a_polynomial_map_has_its_exact_jacobian() {
        let at = DVector::from_vec(vec![ratio(2, 1), ratio(-1, 3)]);
        let map = |x: &DVector<Dual<_>>| DVector::from_vec(vec![x[0].clone() * x[1].clone(), x[1].clone(), x[0].clone() * x[0].clone()]);
        let rows = [ratio(-1, 3), ratio(2, 1), ratio(0, 1), ratio(1, 1), ratio(4, 1), ratio(0, 1)];
        assert_eq!(jacobian(&at, map), DMatrix::from_row_slice(3, 2, &rows));
    }
}
