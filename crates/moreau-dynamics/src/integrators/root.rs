//! Numbers defined by an equation f(x) = 0, with the derivatives that the implicit function theorem gives them.
//!
//! ```text
//!     x ← x − f(x)/f′(x)
//! ```
//! A step from a root stays there. If f depends on a parameter that carries a derivative, ṗ, the step gives ẋ = −(∂f/∂p) ṗ/f′(x), which is
//! the derivative of the root: exactly, where the root is exact.

use moreau_exact::scalar::{Dual, Scalar};

/// Newton steps from a guess; f is asked for its value and slope.
pub fn root<T: Scalar>(function: impl Fn(&Dual<T>) -> Dual<T>, guess: &T, steps: usize) -> T {
    let newton = |x: T| {
        let Dual { value, slope } = function(&Dual { value: x.clone(), slope: T::one() });
        x - value / slope
    };
    (0..steps).fold(guess.clone(), |x, _| newton(x))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};

    #[test]
    fn a_square_root_that_is_rational_has_its_exact_derivative() {
        // x² = p at p = 9/4: x = 3/2, ẋ = 1/(2x) = 1/3
        let p = Dual { value: ratio(9, 4), slope: ratio(1, 1) };
        let square = |x: &Dual<Dual<Rational>>| x.clone() * x.clone() - Dual::constant(p.clone());
        assert_eq!(root(square, &Dual::constant(ratio(3, 2)), 1), Dual { value: ratio(3, 2), slope: ratio(1, 3) });
    }

    #[test]
    fn newton_converges_on_floats() {
        let found = root(|x: &Dual<f64>| x.clone() * x.clone() - Dual::constant(2.0), &1.0, 6);
        assert!((found - 2f64.sqrt()).abs() <= f64::EPSILON);
    }
}
