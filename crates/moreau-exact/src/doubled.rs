//! A residual b − Σ aᵢxᵢ as if computed with twice the digits: every sum and product is split without error into its rounded value and
//! what rounding left of it.
//!
//! T. Ogita, S. M. Rump, S. Oishi, *Accurate sum and dot product*, SIAM J. Sci. Comput. 26 (2005), algorithm 5.3.

use crate::scalar::Scalar;

/// b − Σ aᵢxᵢ, with an error of ε|b − Σ aᵢxᵢ| + (nε)²(|b| + Σ|aᵢxᵢ|).
///
/// ```
/// use moreau_exact::doubled::residual;
///
/// let (a, x) = ([1e16, 1.0, -1e16], [1.0, 1.0, 1.0]);
/// assert_eq!(residual(&0.0, a.iter().zip(&x)), -1.0);
/// assert_eq!(-(a[0] + a[1] + a[2]), 0.0); // what plain sums make of it
/// ```
pub fn residual<'a, T: Scalar>(b: &T, products: impl Iterator<Item = (&'a T, &'a T)>) -> T {
    let (mut sum, mut left) = (b.clone(), T::zero());
    for (a, x) in products {
        let (product, below) = product(-a.clone(), x.clone());
        let (next, rounding) = add(sum, product);
        sum = next;
        left += rounding + below;
    }
    sum + left
}

/// Sums b − Σ aᵢxᵢ of many rows at once, as [`residual`] computes each.
#[derive(Clone, Debug)]
pub struct DoubledResiduals<T: Scalar> {
    sums: Vec<T>,
    left: Vec<T>,
}

impl<T: Scalar> DoubledResiduals<T> {
    /// b.
    pub fn new(b: &[T]) -> Self {
        DoubledResiduals { sums: b.to_vec(), left: vec![T::zero(); b.len()] }
    }

    /// Takes a column of A times its x from all rows.
    ///
    /// # Panics
    /// If the column has fewer entries than there are rows.
    pub fn subtract(&mut self, column: &[T], x: &T) {
        assert!(column.len() >= self.sums.len(), "one entry per row");
        self.subtract_from(0, column, x);
    }

    /// Takes a part of a column of A times its x from the rows from the first on that it has entries of.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn subtract_from(&mut self, first: usize, column: &[T], x: &T) {
        let minus = -x.clone();
        let parts = split(minus.clone());
        for ((sum, left), a) in self.sums[first..].iter_mut().zip(&mut self.left[first..]).zip(column) {
            subtract_one(sum, left, a, &minus, &parts);
        }
    }

    /// Takes x times the unit vector of a row.
    pub fn subtract_unit(&mut self, row: usize, x: &T) {
        let minus = -x.clone();
        subtract_one(&mut self.sums[row], &mut self.left[row], &T::one(), &minus, &split(minus.clone()));
    }

    /// The residuals.
    pub fn values(self) -> Vec<T> {
        self.sums.into_iter().zip(self.left).map(|(sum, left)| sum + left).collect()
    }

    /// The residuals with twice the digits: rounded, and what rounding left of them.
    pub fn parts(self) -> (Vec<T>, Vec<T>) {
        self.sums.into_iter().zip(self.left).map(|(sum, left)| add(sum, left)).unzip()
    }
}

#[inline(always)]
fn subtract_one<T: Scalar>(sum: &mut T, left: &mut T, a: &T, minus: &T, parts: &(T, T)) {
    let (product, below) = product_of(a.clone(), minus.clone(), parts);
    let (next, rounding) = add(sum.clone(), product);
    *sum = next;
    *left += rounding + below;
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
    let parts = split(b.clone());
    product_of(a, b, &parts)
}

/// The same with the parts of b.
fn product_of<T: Scalar>(a: T, b: T, parts: &(T, T)) -> (T, T) {
    let product = a.clone() * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), parts.clone());
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
    use crate::scalar::{Rational, exact};

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

    #[test]
    fn rows_at_once_are_rows_one_by_one() {
        let columns = [[1.0 / 3.0, 1e10 / 7.0, -3e-8 / 11.0], [2.0 / 7.0, -1e3 / 9.0, 0.1]];
        let (x, b) = ([7.0 / 9.0, -1.1e-3], [0.25, 1.1e9, -7.0]);
        let mut at_once = DoubledResiduals::new(&b);
        columns.iter().zip(&x).for_each(|(column, x)| at_once.subtract(column, x));
        at_once.subtract_unit(1, &0.3);
        let found = at_once.values();
        for (i, b) in b.iter().enumerate() {
            let unit = if i == 1 { 1.0 } else { 0.0 };
            let row = [columns[0][i], columns[1][i], unit];
            assert_eq!(found[i], residual(b, row.iter().zip(&[x[0], x[1], 0.3])), "{i}");
        }
    }

    #[test]
    fn a_part_of_a_column_is_taken_from_its_rows_and_both_halves_are_kept() {
        let small = 2f64.powi(-70);
        let mut sums = DoubledResiduals::new(&[1.0, 1.0, 1.0]);
        sums.subtract_from(1, &[small], &1.0);
        sums.subtract_from(2, &[3.0], &-small);
        assert_eq!(sums.parts(), (vec![1.0; 3], vec![0.0, -small, 3.0 * small]));
    }
}
