//! A residual b − Σ aᵢxᵢ as if computed with twice the digits: every sum and product is split without error into its rounded value and
//! what rounding left of it.
//!
//! T. Ogita, S. M. Rump, S. Oishi, *Accurate sum and dot product*, SIAM J. Sci. Comput. 26 (2005), algorithm 5.3.

use moreau_exact::scalar::Scalar;

/// b − Σ aᵢxᵢ, with an error of ε|b − Σ aᵢxᵢ| + (nε)²(|b| + Σ|aᵢxᵢ|).
pub(super) fn residual<'a, T: Scalar>(b: &T, products: impl Iterator<Item = (&'a T, &'a T)>) -> T {
    let (mut sum, mut left) = (b.clone(), T::zero());
    for (a, x) in products {
        let (product, below) = product(-a.clone(), x.clone());
        let (next, rounding) = add(sum, product);
        sum = next;
        left += rounding + below;
    }
    sum + left
}

/// a + b = sum + rest exactly (Knuth).
fn add<T: Scalar>(a: T, b: T) -> (T, T) {
    let sum = a.clone() + b.clone();
    let of_b = sum.clone() - a.clone();
    let rest = (a - (sum.clone() - of_b.clone())) + (b - of_b);
    (sum, rest)
}

/// a b = product + rest exactly (Dekker), unless a part underflows.
fn product<T: Scalar>(a: T, b: T) -> (T, T) {
    let product = a.clone() * b.clone();
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let rest = product.clone() - a_high.clone() * b_high.clone() - a_low.clone() * b_high - a_high * b_low.clone();
    (product, a_low * b_low - rest)
}

/// a = high + low with 26 bits in each (Veltkamp).
fn split<T: Scalar>(a: T) -> (T, T) {
    let shifted = T::ratio((1 << 27) + 1, 1) * a.clone();
    let high = shifted.clone() - (shifted - a.clone());
    (high.clone(), a - high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, exact};

    #[test]
    fn what_cancels_in_twice_the_digits_is_found() {
        let (a, x) = ([1.0 / 3.0, 1e10 / 7.0, -3e-8 / 11.0], [7.0 / 9.0, 1.1, 2.3e4]);
        let sum: Rational = a.iter().zip(&x).map(|(a, x)| exact(*a) * exact(*x)).fold(exact(0.0), |sum, term| sum + term);
        let b = Scalar::to_f64(&sum);
        let expected = Scalar::to_f64(&(exact(b) - sum));
        assert_ne!(expected, 0.0);
        assert_ne!(b - a.iter().zip(&x).map(|(a, x)| a * x).sum::<f64>(), expected, "plain sums see rounding alone");
        let found = residual(&b, a.iter().zip(&x));
        assert!(
            (found - expected).abs() <= f64::EPSILON * expected.abs() + (4.0 * f64::EPSILON).powi(2) * 2.0 * b.abs(),
            "{found} {expected}"
        );
    }
}
