//! The symplectic form dq ∧ M dv and what a map does to it.
//!
//! ```text
//!     J = ( 0  M ; −M  0 ) ,     a map with Jacobian D is symplectic iff  DᵀJD = J ;     it then has det D = 1
//! ```
//! M is constant; in coordinates (q, p = M v) it is the identity.

use moreau_exact::scalar::{Rational, Scalar};
use moreau_exact::witness::{Witness, decided, rational};
use nalgebra::DMatrix;

/// J of a constant mass matrix M, n × n, in the coordinates (q, v), 2n × 2n.
pub fn form<T: Scalar>(mass: &DMatrix<T>) -> DMatrix<T> {
    let n = mass.nrows();
    DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, false) => mass[(i, j - n)].clone(),
        (false, true) => -mass[(i - n, j)].clone(),
        _ => T::zero(),
    })
}

/// DᵀJD − J, the zero matrix for a symplectic map.
///
/// ```
/// use moreau_dynamics::integrators::{Method, Phase, RungeKutta, SemiImplicitEuler, SpringDamper, Damping, symplectic::defect};
/// use moreau_exact::scalar::ratio;
/// use nalgebra::DMatrix;
///
/// let (spring, now) = (SpringDamper::of_ratio(ratio(0, 1)), Phase::of_one(ratio(1, 1), ratio(0, 1)));
/// let (h, mass) = (ratio(1, 10), DMatrix::from_element(1, 1, ratio(1, 1)));
/// let symplectic = SemiImplicitEuler { damping: Damping::Explicit };
/// let zero = DMatrix::from_element(2, 2, ratio(0, 1));
/// assert_eq!(defect(&symplectic.jacobian(&spring, &now, &h), &mass), zero);
/// assert_ne!(defect(&RungeKutta.jacobian(&spring, &now, &h), &mass), zero);
/// ```
pub fn defect<T: Scalar>(jacobian: &DMatrix<T>, mass: &DMatrix<T>) -> DMatrix<T> {
    let decide = || {
        let form = form(mass);
        jacobian.transpose() * &form * jacobian - form
    };
    decided(decide, |found| {
        let [map, mass, found]: [&DMatrix<Rational>; 3] = [rational(jacobian)?, rational(mass)?, rational(found)?];
        Some(Witness::new("symplectic-defect", vec![("map", map.into()), ("mass", mass.into()), ("defect", found.into())]))
    })
}

/// det D, the factor of phase volume, by expansion along the first row (for small matrices).
pub fn volume<T: Scalar>(jacobian: &DMatrix<T>) -> T {
    decided(
        || expanded(jacobian),
        |found| {
            let (matrix, value): (&DMatrix<Rational>, &Rational) = (rational(jacobian)?, rational(found)?);
            Some(Witness::new("determinant", vec![("matrix", matrix.into()), ("value", value.into())]))
        },
    )
}

fn expanded<T: Scalar>(jacobian: &DMatrix<T>) -> T {
    if jacobian.is_empty() {
        return T::one();
    }
    let minor = |j: usize| jacobian.clone().remove_row(0).remove_column(j);
    (0..jacobian.ncols()).filter(|&j| !jacobian[(0, j)].is_zero()).fold(T::zero(), |sum, j| {
        let term = jacobian[(0, j)].clone() * expanded(&minor(j));
        if j % 2 == 0 { sum + term } else { sum - term }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};

    fn matrix(rows: usize, entries: &[i64]) -> DMatrix<Rational> {
        DMatrix::from_row_slice(rows, rows, &entries.iter().map(|x| ratio(*x, 1)).collect::<Vec<_>>())
    }

    #[test]
    fn determinants_of_known_matrices() {
        assert_eq!(volume(&matrix(3, &[2, 0, 1, 3, 5, -1, 0, 4, 7])), ratio(90, 1));
        assert_eq!(volume(&matrix(2, &[1, 2, 2, 4])), ratio(0, 1));
    }

    #[test]
    fn a_shear_of_the_velocities_by_a_force_is_symplectic_and_one_across_is_not() {
        // M v⁺ = M v − K q is symplectic iff K is symmetric
        let identity = DMatrix::identity(2, 2);
        let shear = |k: [i64; 4]| {
            let mut map = DMatrix::<Rational>::identity(4, 4);
            map.view_mut((2, 0), (2, 2)).copy_from(&matrix(2, &k));
            map
        };
        assert!(defect(&shear([1, 2, 2, -5]), &identity).iter().all(|entry| *entry == ratio(0, 1)));
        assert!(defect(&shear([1, 2, 3, -5]), &identity).iter().any(|entry| *entry != ratio(0, 1)));
        assert_eq!(volume(&shear([1, 2, 3, -5])), ratio(1, 1));
    }
}
