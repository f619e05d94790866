//! The number systems of the crate: `f64`, exact rationals ([`RBig`]) for everything that is decided rather than measured, and over
//! either of them the dual numbers ([`Dual`]) that carry a derivative along.

use dashu_ratio::RBig;
use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign};
use num_traits::{One, Zero};
use std::ops::Neg;

mod dual;

pub use dual::Dual;

/// Exact rational number.
pub type Rational = RBig;

/// An ordered field: `f64` (rounded) or [`Rational`] (exact); or the dual numbers over one, in which only numbers with a value are
/// divisors.
pub trait Scalar:
    nalgebra::Scalar
    + Zero
    + One
    + PartialOrd
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + ClosedDivAssign
    + Neg<Output = Self>
    + Send
    + Sync
{
    /// The number `numerator / denominator` (rounded to nearest for `f64`).
    fn ratio(numerator: i64, denominator: i64) -> Self;
    /// The number nearest to a rational.
    fn nearest(number: &Rational) -> Self;
    /// The nearest `f64`.
    fn to_f64(&self) -> f64;
    /// The spacing of the numbers at 1: ε = 2⁻⁵² for `f64`, 0 for exact rationals.
    fn spacing() -> Self;
    /// |x|.
    fn magnitude(&self) -> Self {
        if *self < Self::zero() { -self.clone() } else { self.clone() }
    }
}

impl Scalar for f64 {
    fn ratio(numerator: i64, denominator: i64) -> Self {
        numerator as f64 / denominator as f64
    }
    fn nearest(number: &Rational) -> Self {
        RBig::to_f64(number).value()
    }
    fn to_f64(&self) -> f64 {
        *self
    }
    fn spacing() -> Self {
        f64::EPSILON
    }
}

impl Scalar for Rational {
    fn ratio(numerator: i64, denominator: i64) -> Self {
        assert!(denominator != 0, "a rational needs a non-zero denominator");
        RBig::from(numerator) / RBig::from(denominator)
    }
    fn nearest(number: &Rational) -> Self {
        number.clone()
    }
    fn to_f64(&self) -> f64 {
        RBig::to_f64(self).value()
    }
    fn spacing() -> Self {
        Self::zero()
    }
}

/// The rational `numerator / denominator`.
///
/// # Panics
/// If the denominator is zero.
pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    <Rational as Scalar>::ratio(numerator, denominator)
}

/// The rational that an `f64` is, exactly.
///
/// # Panics
/// If the number is NaN or infinite.
///
/// ```
/// use moreau_exact::scalar::{exact, ratio};
///
/// assert_eq!(exact(0.5), ratio(1, 2));
/// assert_ne!(exact(0.1), ratio(1, 10)); // the float next to a tenth is another number
/// ```
pub fn exact(number: f64) -> Rational {
    RBig::try_from(number).expect("only finite numbers are rational")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_third_is_exact_only_as_a_rational() {
        assert_eq!(ratio(1, 3) * ratio(3, 1), ratio(1, 1));
        assert_ne!(exact(1.0 / 3.0), ratio(1, 3));
        assert_eq!(Scalar::to_f64(&ratio(1, 3)), 1.0 / 3.0);
    }

    #[test]
    fn magnitude_drops_the_sign() {
        assert_eq!(ratio(-2, 4).magnitude(), ratio(1, 2));
        assert_eq!((-0.5f64).magnitude(), 0.5);
    }
}
