//! Dual numbers, x + ẋ ε with ε² = 0: arithmetic that carries the derivative along (forward mode).
//!
//! ```text
//!     (x + ẋε) + (y + ẏε) = x + y + (ẋ + ẏ)ε        (x + ẋε)(y + ẏε) = x y + (ẋ y + x ẏ)ε
//!     (x + ẋε)/(y + ẏε) = x/y + (ẋ − (x/y) ẏ)/y ε   if y ≠ 0
//! ```
//! ε counts as positive and smaller than every positive number, so that the order is lexicographic. A comparison at equality is
//! decided by the derivatives: a program that branches there follows the branch on the side to which ẋ points, and what it
//! computes is a one-sided derivative.
//!
//! Over rationals the derivative is exact. Libraries of dual numbers ask for the functions of floating point (exp, sin), which
//! rationals do not have.

use super::{Rational, Scalar};
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number and its derivative along one direction.
///
/// ```
/// use moreau_exact::scalar::{Dual, ratio};
///
/// let x = Dual { value: ratio(3, 1), slope: ratio(1, 1) }; // x = 3, and dx/dx = 1
/// let square = x.clone() * x;
/// assert_eq!((square.value, square.slope), (ratio(9, 1), ratio(6, 1))); // x² = 9, and its derivative 2x
/// ```
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub struct Dual<T> {
    /// x.
    pub value: T,
    /// ẋ.
    pub slope: T,
}

impl<T: Scalar> Dual<T> {
    /// A number that does not change, ẋ = 0.
    pub fn constant(value: T) -> Self {
        Dual { value, slope: T::zero() }
    }
}

impl<T: Scalar> Add for Dual<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Dual { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<T: Scalar> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Dual { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<T: Scalar> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Dual { slope: self.slope * other.value.clone() + self.value.clone() * other.slope, value: self.value * other.value }
    }
}

impl<T: Scalar> Div for Dual<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value.clone();
        Dual { slope: (self.slope - value.clone() * other.slope) / other.value, value }
    }
}

impl<T: Scalar> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Dual { value: -self.value, slope: -self.slope }
    }
}

macro_rules! in_place {
    ($($name:ident $method:ident $operator:tt),*) => { $(
        impl<T: Scalar> $name for Dual<T> {
            fn $method(&mut self, other: Self) {
                *self = self.clone() $operator other;
            }
        }
    )* };
}

in_place!(AddAssign add_assign +, SubAssign sub_assign -, MulAssign mul_assign *, DivAssign div_assign /);

impl<T: Scalar> Zero for Dual<T> {
    fn zero() -> Self {
        Dual::constant(T::zero())
    }
    fn is_zero(&self) -> bool {
        self.value.is_zero() && self.slope.is_zero()
    }
}

impl<T: Scalar> One for Dual<T> {
    fn one() -> Self {
        Dual::constant(T::one())
    }
}

impl<T: Scalar> Scalar for Dual<T> {
    fn ratio(numerator: i64, denominator: i64) -> Self {
        Dual::constant(T::ratio(numerator, denominator))
    }
    fn nearest(number: &Rational) -> Self {
        Dual::constant(T::nearest(number))
    }
    fn to_f64(&self) -> f64 {
        self.value.to_f64()
    }
    fn spacing() -> Self {
        Dual::constant(T::spacing())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::ratio;

    fn dual(value: i64, slope: i64) -> Dual<Rational> {
        Dual { value: ratio(value, 1), slope: ratio(slope, 1) }
    }

    #[test]
    fn a_rational_function_has_its_exact_derivative() {
        // f = (x³ − 2)/(x + 1), f′ = (2x³ + 3x² + 2)/(x + 1)², at x = 3: 25/4 and 83/16
        let x = dual(3, 1);
        let f = (x.clone() * x.clone() * x.clone() - dual(2, 0)) / (x + dual(1, 0));
        assert_eq!((f.value, f.slope), (ratio(25, 4), ratio(83, 16)));
    }

    #[test]
    fn the_order_is_that_of_the_values_and_at_equality_that_of_the_slopes() {
        assert!(dual(1, -7) < dual(2, 0) && dual(1, -1) < dual(1, 0) && dual(1, 0) < dual(1, 1));
        assert!(dual(0, 1) > Dual::zero() && !dual(0, 1).is_zero());
        assert_eq!((dual(0, -2).magnitude(), dual(-3, 5).magnitude()), (dual(0, 2), dual(3, -5)));
    }

    #[test]
    fn a_kink_has_the_slope_of_the_side_that_the_direction_points_to() {
        let ramp = |x: Dual<Rational>| if x > Dual::zero() { x } else { Dual::zero() };
        assert_eq!([ramp(dual(0, 1)).slope, ramp(dual(0, -1)).slope], [ratio(1, 1), ratio(0, 1)]);
    }

    #[test]
    fn second_derivatives_are_duals_of_duals() {
        // x⁴ at 2: 12 x² = 48
        let x = Dual { value: dual(2, 1), slope: Dual::one() };
        let fourth = x.clone() * x.clone() * x.clone() * x;
        assert_eq!(fourth.slope.slope, ratio(48, 1));
    }

    #[test]
    fn operations_in_place_are_the_same_operations() {
        let (a, b) = (dual(5, 3), dual(2, -1));
        let mut x = a.clone();
        x += b.clone();
        x *= b.clone();
        x -= a.clone();
        x /= b.clone();
        assert_eq!(x, ((a.clone() + b.clone()) * b.clone() - a) / b);
    }
}
