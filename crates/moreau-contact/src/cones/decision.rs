//! Which of the three cases of the projection on K_μ holds, decided by comparing squares – exactly, for rational data.
//!
//! ```text
//!     stays     z_n ≥ 0  and  ‖z_t‖² ≤ μ² z_n²
//!     apex      z_n ≤ 0  and  μ²‖z_t‖² ≤ z_n²
//!     boundary  otherwise
//! ```

use moreau_exact::scalar::Scalar;

/// The three cases of the projection on the friction cone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// `z ∈ K_μ`: the point is its own projection (the apex itself included).
    Stays,
    /// `z ∈ K_μ° \ {0}`: the projection is zero.
    Apex,
    /// The projection lies on the lateral boundary, `‖r_t‖ = μ r_n > 0` (for μ = 0, on the ray).
    Boundary,
}

/// The case that holds for `z = (z_n, z_t…)`; no square root is taken, so rational data give a proof.
///
/// ```
/// use moreau_contact::cones::{Case, decide};
/// use moreau_contact::scalar::ratio;
/// // μ = 1/2, z_n = −1 < 0, yet the projection is not zero: μ‖z_t‖ = 5/2 > 1.
/// let z = [ratio(-1, 1), ratio(3, 1), ratio(4, 1)];
/// assert_eq!(decide(&z, &ratio(1, 2)), Case::Boundary);
/// ```
pub fn decide<T: Scalar>(z: &[T], mu: &T) -> Case {
    let normal_squared = z[0].clone() * z[0].clone();
    let tangential_squared = z[1..].iter().fold(T::zero(), |sum, entry| sum + entry.clone() * entry.clone());
    let mu_squared = mu.clone() * mu.clone();
    if z[0] >= T::zero() && tangential_squared <= mu_squared.clone() * normal_squared.clone() {
        Case::Stays
    } else if z[0] <= T::zero() && mu_squared * tangential_squared <= normal_squared {
        Case::Apex
    } else {
        Case::Boundary
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};

    fn at(normal: Rational) -> Case {
        decide(&[normal, ratio(3, 1), ratio(-4, 1)], &ratio(1, 3))
    }

    #[test]
    fn both_sides_of_both_boundaries() {
        // ‖z_t‖ = 5, μ = 1/3: K from z_n = 15 up, polar from z_n = −5/3 down.
        let tiny = ratio(1, 1_000_000_000_000_000_000);
        assert_eq!(at(ratio(15, 1)), Case::Stays);
        assert_eq!(at(ratio(15, 1) - tiny.clone()), Case::Boundary);
        assert_eq!(at(ratio(-5, 3)), Case::Apex);
        assert_eq!(at(ratio(-5, 3) + tiny), Case::Boundary);
    }

    #[test]
    fn zero_friction_and_the_apex() {
        let zero = ratio(0, 1);
        let case = |normal: i64, tangent: i64| decide(&[ratio(normal, 1), ratio(tangent, 1)], &zero);
        assert_eq!(case(1, 0), Case::Stays);
        assert_eq!(case(1, 1), Case::Boundary);
        assert_eq!(case(0, 0), Case::Stays);
        assert_eq!(case(0, 1), Case::Apex);
        assert_eq!(case(-1, 0), Case::Apex);
    }
}
