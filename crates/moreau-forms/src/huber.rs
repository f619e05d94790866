//! The Huber function of a row with friction loss in any ordered field: bound η \[N\], regularisation R \[1/kg\], y \[m/s²\].
//!
//! ```text
//!     s(y) = y²/(2R)  for |y| ≤ Rη ,   η|y| − η²R/2  beyond ;      f = −s′(y) = −y/R cut off at ±η ;
//!     s*(f) = sup_y (−f y − s(y)) = R f²/2  for |f| ≤ η ,   ∞ beyond
//! ```
//! s is convex and continuously differentiable; its force is bounded, s itself is not.

use moreau_exact::scalar::Scalar;

/// The row.
///
/// # Source
/// MuJoCo documentation, *Computation: constraint model* (3.17); Huber, *Robust estimation of a location parameter* (1964).
///
/// ```
/// use moreau_exact::scalar::ratio;
/// use moreau_forms::huber::Huber;
///
/// let row = Huber { bound: ratio(3, 1), regularisation: ratio(2, 1) }; // η, R
/// assert_eq!(row.force(&ratio(4, 1)), ratio(-2, 1)); // −y/R
/// assert_eq!(row.force(&ratio(40, 1)), ratio(-3, 1)); // cut off at η
/// assert_eq!(row.penalty(&ratio(4, 1)), ratio(4, 1)); // y²/(2R)
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Huber<T> {
    /// η ≥ 0 \[N\].
    pub bound: T,
    /// R > 0 \[1/kg\].
    pub regularisation: T,
}

impl<T: Scalar> Huber<T> {
    /// s(y) \[N m/s²\].
    pub fn penalty(&self, y: &T) -> T {
        let (eta, r) = (self.bound.clone(), self.regularisation.clone());
        let half = T::ratio(1, 2);
        if y.magnitude() <= r.clone() * eta.clone() {
            half * y.clone() * y.clone() / r
        } else {
            eta.clone() * y.magnitude() - half * eta.clone() * eta * r
        }
    }

    /// f = −s′(y) \[N\].
    pub fn force(&self, y: &T) -> T {
        let free = -y.clone() / self.regularisation.clone();
        if free > self.bound {
            self.bound.clone()
        } else if free < -self.bound.clone() {
            -self.bound.clone()
        } else {
            free
        }
    }

    /// s*(f) \[N m/s²\], `None` where it is infinite.
    pub fn conjugate(&self, force: &T) -> Option<T> {
        let value = T::ratio(1, 2) * self.regularisation.clone() * force.clone() * force.clone();
        (force.magnitude() <= self.bound).then_some(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Dual, Rational, ratio};

    #[test]
    fn the_force_is_the_negative_derivative_on_both_sides_of_the_bend() {
        let huber = Huber { bound: Dual::constant(ratio(2, 1)), regularisation: Dual::constant(ratio(1, 2)) };
        for quarters in -8..9 {
            for direction in [-1, 1] {
                let y = Dual { value: ratio(quarters, 4), slope: ratio(direction, 1) };
                assert_eq!(huber.penalty(&y).slope, -huber.force(&y).value * ratio(direction, 1));
            }
        }
    }

    #[test]
    fn penalty_and_conjugate_add_up_to_the_product_at_the_force_and_to_more_elsewhere() {
        let huber = Huber { bound: ratio(2, 1), regularisation: ratio(1, 2) };
        for y in (-8..9).map(|quarters| ratio(quarters, 4)) {
            let gap = |f: &Rational| huber.penalty(&y) + huber.conjugate(f).expect("within the bound") + f * &y;
            assert_eq!(gap(&huber.force(&y)), ratio(0, 1));
            assert!((-4..5).map(|halves| gap(&ratio(halves, 2))).all(|gap| gap >= ratio(0, 1)));
        }
        assert_eq!(huber.conjugate(&ratio(3, 1)), None);
    }
}
