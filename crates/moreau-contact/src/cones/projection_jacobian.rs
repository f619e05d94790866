//! An element of the Clarke Jacobian of the projection on the friction cone.
//!
//! With `e = z_t/‖z_t‖`, generator `g = (c, s e)` and `along = gᵀz` (see [`second_order`](super::second_order)):
//! ```text
//!     z ∈ int K_μ      J = I
//!     z ∈ int K_μ°     J = 0
//!     otherwise        J = g gᵀ + (s·along/‖z_t‖) · diag(0, I − e eᵀ)
//! ```
//! On the kinks the element of the closed case is taken: I on K_μ, 0 on K_μ° \ {0}. Both are limits of Jacobians at
//! nearby points of differentiability, hence members of the Clarke Jacobian. For μ = 0 the cone has no interior and
//! every neighbour of a point of the ray has `J = n nᵀ`, so that is the element taken there.

use super::second_order::{contains, half_angle, polar_contains, tangential_norm};
use nalgebra::DMatrix;

/// A symmetric positive semidefinite element of the Clarke Jacobian of `z ↦ P_{K_μ}(z)`, `k × k` for `k` entries.
///
/// ```text
///     0 ≼ J ≼ I ,      J z = P(z)   (the projection is positively homogeneous)
/// ```
pub fn projection_jacobian(z: &[f64], mu: f64) -> DMatrix<f64> {
    let size = z.len();
    if contains(z, mu) && (mu > 0.0 || size == 1) {
        return DMatrix::identity(size, size);
    }
    if polar_contains(z, mu) && !contains(z, mu) {
        return DMatrix::zeros(size, size);
    }
    let (c, s) = half_angle(mu);
    let norm = tangential_norm(z);
    let along = c * z[0] + s * norm;
    let unit = |row: usize| if norm > 0.0 { z[row] / norm } else { 0.0 };
    let stretch = if norm > 0.0 { s * along / norm } else { 0.0 };
    DMatrix::from_fn(size, size, |row, column| {
        let generator = |index: usize| if index == 0 { c } else { s * unit(index) };
        let across = match (row, column) {
            (0, _) | (_, 0) => 0.0,
            _ => f64::from(row == column) - unit(row) * unit(column),
        };
        generator(row) * generator(column) + stretch * across
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cones::second_order::project;
    use crate::tolerance::cones::{DIFFERENCE_STEP, difference_error};

    const MUS: [f64; 4] = [0.0, 0.3, 1.0, 2.5];

    /// Central differences of the projection, which do not know the formula above.
    fn differences(z: &[f64], mu: f64) -> DMatrix<f64> {
        let shifted = |column: usize, step: f64| {
            let mut point = z.to_vec();
            point[column] += step;
            project(&mut point, mu);
            point
        };
        DMatrix::from_fn(z.len(), z.len(), |row, column| {
            let (ahead, behind) = (shifted(column, DIFFERENCE_STEP), shifted(column, -DIFFERENCE_STEP));
            (ahead[row] - behind[row]) / (2.0 * DIFFERENCE_STEP)
        })
    }

    fn close(left: &DMatrix<f64>, right: &DMatrix<f64>) -> bool {
        (left - right).amax() <= difference_error(1.0, 4.0)
    }

    #[test]
    fn equals_central_differences_away_from_the_kinks() {
        for mu in MUS {
            for z in [[2.0, 1.0, -3.0], [-1.0, 2.0, 2.0], [-4.0, 1.0, 0.2], [4.0, 0.5, 0.8], [0.5, -1.0, 1.5]] {
                assert!(close(&projection_jacobian(&z, mu), &differences(&z, mu)), "μ = {mu}, z = {z:?}");
                assert!(close(&projection_jacobian(&z[..2], mu), &differences(&z[..2], mu)), "μ = {mu}, z = {z:?}");
            }
        }
    }

    #[test]
    fn central_differences_would_notice_the_missing_tangential_term() {
        let z = [-1.0, 2.0, 2.0];
        let generator = nalgebra::DVector::from_vec(vec![0.8, 0.6 / 2f64.sqrt(), 0.6 / 2f64.sqrt()]);
        assert!(!close(&(&generator * generator.transpose()), &differences(&z, 0.75)));
    }

    #[test]
    fn on_a_kink_it_is_the_limit_from_the_closed_case() {
        let reach = 1.0 / 64.0;
        let (boundary, polar) = ([2.5, 3.0, 4.0], [-10.0, 3.0, 4.0]);
        assert!(close(&projection_jacobian(&boundary, 2.0), &differences(&[2.5 + reach, 3.0, 4.0], 2.0)));
        assert!(close(&projection_jacobian(&polar, 2.0), &differences(&[-10.0 - reach, 3.0, 4.0], 2.0)));
        assert!(close(&projection_jacobian(&[0.0; 3], 2.0), &differences(&[reach, 0.0, 0.0], 2.0)));
    }

    #[test]
    fn differences_across_a_kink_average_the_two_sides() {
        // Along the normal axis at a point of ∂K: half of I from inside, half of g gᵀ + … from outside.
        let z = [2.5, 3.0, 4.0];
        let outside = projection_jacobian(&[2.5f64.next_down(), 3.0, 4.0], 2.0);
        let average = (projection_jacobian(&z, 2.0) + outside) * 0.5;
        // One-sided quotients err by ‖P″‖·step/2 ≤ step/(2‖z_t‖), first order instead of second.
        assert!((average - differences(&z, 2.0)).amax() <= DIFFERENCE_STEP + difference_error(1.0, 4.0));
    }

    #[test]
    fn on_the_frictionless_ray_it_is_the_normal_projector_not_the_identity() {
        let jacobian = projection_jacobian(&[2.0, 0.0, 0.0], 0.0);
        assert!(close(&jacobian, &differences(&[2.0, 0.25, 0.0], 0.0)));
        assert_eq!(jacobian, DMatrix::from_diagonal(&nalgebra::dvector![1.0, 0.0, 0.0]));
    }

    #[test]
    fn reproduces_the_projection_of_its_own_point() {
        for mu in MUS {
            for z in [[2.0, 1.0, -3.0], [-1.0, 2.0, 2.0], [-4.0, 1.0, 0.2], [4.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
                let product = projection_jacobian(&z, mu) * nalgebra::DVector::from_row_slice(&z);
                let mut point = z;
                project(&mut point, mu);
                let error = (product - nalgebra::DVector::from_row_slice(&point)).amax();
                assert!(error <= moreau_exact::tolerance::rounding(12, 8.0), "μ = {mu}, z = {z:?}: {error}");
            }
        }
    }
}
