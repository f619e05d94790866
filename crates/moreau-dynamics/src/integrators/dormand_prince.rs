//! The method of Dormand and Prince, order five, with an error estimate of order four and a continuous extension of order four:
//!
//! ```text
//!     k_i = f(x + h Σ_{j<i} a_ij k_j) ,   x⁺ = x + h Σ b_i k_i ,   error = h Σ (b_i − b̂_i) k_i
//!     x(ϑh) = x + h Σ b_i(ϑ) k_i ,  0 ≤ ϑ ≤ 1 ,  b_i(1) = b_i
//! ```
//! For linear f the step is R(hA) x with R(z) = 1 + z + z²/2 + z³/6 + z⁴/24 + z⁵/120 + z⁶/600. The coefficients are rationals, and the
//! conditions of order are decided in rationals.

use moreau_exact::scalar::Scalar;
use nalgebra::DVector;

/// Rows of a_ij; the last row is b, so that k₇ is the first stage of the next step.
const STAGES: [&[(i64, i64)]; 7] = [
    &[],
    &[(1, 5)],
    &[(3, 40), (9, 40)],
    &[(44, 45), (-56, 15), (32, 9)],
    &[(19372, 6561), (-25360, 2187), (64448, 6561), (-212, 729)],
    &[(9017, 3168), (-355, 33), (46732, 5247), (49, 176), (-5103, 18656)],
    &[(35, 384), (0, 1), (500, 1113), (125, 192), (-2187, 6784), (11, 84)],
];

/// b − b̂.
const ERROR: [(i64, i64); 7] = [(71, 57600), (0, 1), (-71, 16695), (71, 1920), (-17253, 339200), (22, 525), (-1, 40)];

/// (p, r, s) in b_i(ϑ) = ϑ²(3−2ϑ) b_i + ϑ²(ϑ−1)² (p − r ϑ)/s, and the terms of its own that stages 1 and 7 have.
const EXTENSION: [(i64, i64, i64); 7] = [
    (-5 * 2558722523, -5 * 31403016, 11282082432),
    (0, 0, 1),
    (100 * 882725551, 100 * 15701508, 32700410799),
    (-25 * 443332067, -25 * 31403016, 1880347072),
    (32805 * 23143187, 32805 * 3489224, 199316789632),
    (-55 * 29972135, -55 * 7076736, 822651844),
    (10 * 7414447, 10 * 829305, 29380423),
];

/// A step, from x to x⁺, and the motion in between.
///
/// # Source
/// Dormand and Prince, *A family of embedded Runge–Kutta formulae* (1980); the extension from Hairer, Nørsett and Wanner, *Solving Ordinary
/// Differential Equations I*, §II.6.
#[derive(Clone, Debug)]
pub struct DormandPrinceStep<T: Scalar> {
    start: DVector<T>,
    h: T,
    rates: Vec<DVector<T>>,
    /// x⁺.
    pub end: DVector<T>,
}

impl<T: Scalar> DormandPrinceStep<T> {
    /// The step h \[s\] from `start` of ẋ = f(x).
    ///
    /// # Errors
    /// Those of f.
    pub fn take<E>(rate: impl Fn(&DVector<T>) -> Result<DVector<T>, E>, start: &DVector<T>, h: &T) -> Result<Self, E> {
        let mut rates: Vec<DVector<T>> = Vec::with_capacity(STAGES.len());
        let mut end = start.clone();
        for row in STAGES {
            end = row.iter().zip(&rates).fold(start.clone(), |x, (&(p, q), k)| x + k * (h.clone() * T::ratio(p, q)));
            rates.push(rate(&end)?);
        }
        Ok(DormandPrinceStep { start: start.clone(), h: h.clone(), rates, end })
    }

    /// x⁺ less the step of order four, an estimate of the error.
    pub fn error(&self) -> DVector<T> {
        let zero = DVector::from_element(self.start.len(), T::zero());
        self.rates.iter().zip(ERROR).fold(zero, |sum, (k, (p, q))| sum + k * (self.h.clone() * T::ratio(p, q)))
    }

    /// x(ϑh).
    pub fn at(&self, share: &T) -> DVector<T> {
        let weights = (0..STAGES.len()).map(|stage| weight(stage, share));
        self.rates.iter().zip(weights).fold(self.start.clone(), |x, (k, b)| x + k * (self.h.clone() * b))
    }
}

/// b_i(ϑ).
fn weight<T: Scalar>(stage: usize, share: &T) -> T {
    let whole = |number: i64| T::ratio(number, 1);
    let (p, q) = STAGES[6].get(stage).copied().unwrap_or((0, 1));
    let left = share.clone() - T::one();
    let square = share.clone() * share.clone();
    let bubble = square.clone() * left.clone() * left.clone();
    let (first, slope, divisor) = EXTENSION[stage];
    let own = match stage {
        0 => share.clone() * left.clone() * left,
        6 => square.clone() * left,
        _ => T::zero(),
    };
    square * (whole(3) - whole(2) * share.clone()) * T::ratio(p, q)
        + own
        + bubble * (whole(first) - whole(slope) * share.clone()) / whole(divisor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};
    use std::convert::Infallible;

    type Tree = Vec<Rational>;

    fn coefficient(row: usize, column: usize) -> Rational {
        STAGES[row].get(column).map_or(ratio(0, 1), |&(p, q)| ratio(p, q))
    }

    fn apply(values: &Tree) -> Tree {
        (0..7).map(|i| (0..7).fold(ratio(0, 1), |sum, j| sum + coefficient(i, j) * &values[j])).collect()
    }

    fn times(a: &Tree, b: &Tree) -> Tree {
        a.iter().zip(b).map(|(x, y)| x * y).collect()
    }

    /// Φ of the rooted trees with up to five nodes, as (order, density γ, values by stage).
    fn trees() -> Vec<(u32, i64, Tree)> {
        let one: Tree = vec![ratio(1, 1); 7];
        let c = apply(&one);
        let [c2, c3] = [times(&c, &c), times(&times(&c, &c), &c)];
        let (ac, ac2, ac3) = (apply(&c), apply(&c2), apply(&c3));
        let (aac, aac2) = (apply(&ac), apply(&ac2));
        let caac = apply(&times(&c, &ac));
        vec![
            (1, 1, one),
            (2, 2, c.clone()),
            (3, 3, c2.clone()),
            (3, 6, ac.clone()),
            (4, 4, c3.clone()),
            (4, 8, times(&c, &ac)),
            (4, 12, ac2.clone()),
            (4, 24, aac.clone()),
            (5, 5, times(&c3, &c)),
            (5, 10, times(&c2, &ac)),
            (5, 15, times(&c, &ac2)),
            (5, 20, times(&ac, &ac)),
            (5, 20, ac3),
            (5, 30, times(&c, &aac)),
            (5, 40, caac),
            (5, 60, aac2),
            (5, 120, apply(&aac)),
        ]
    }

    fn sum(weights: impl Fn(usize) -> Rational, values: &Tree) -> Rational {
        (0..7).fold(ratio(0, 1), |total, i| total + weights(i) * &values[i])
    }

    #[test]
    fn the_step_satisfies_the_seventeen_conditions_of_order_five_exactly() {
        for (order, density, values) in trees() {
            assert_eq!(sum(|i| coefficient(6, i), &values), ratio(1, density), "order {order}, γ = {density}");
        }
    }

    #[test]
    fn the_extension_satisfies_the_eight_conditions_of_order_four_at_every_share() {
        for share in [ratio(1, 7), ratio(1, 2), ratio(9, 10), ratio(1, 1)] {
            for (order, density, values) in trees().into_iter().filter(|(order, ..)| *order <= 4) {
                // the coefficients of the extension are rounded to ten digits by their authors
                let found = sum(|i| weight(i, &share), &values);
                let expected = (0..order).fold(ratio(1, density), |power, _| power * &share);
                let difference = Scalar::to_f64(&(found - expected)).abs();
                assert!(
                    difference <= crate::tolerance::integrators::PUBLISHED_EXTENSION,
                    "order {order}, γ = {density}, ϑ = {share}: {difference:e}"
                );
            }
        }
    }

    #[test]
    fn the_estimate_compares_with_order_four() {
        for (order, _, values) in trees() {
            let found = sum(|i| ratio(ERROR[i].0, ERROR[i].1), &values);
            assert!(order == 5 || found == ratio(0, 1), "order {order}: {found}");
        }
        assert!(trees().iter().any(|(order, _, values)| *order == 5 && sum(|i| ratio(ERROR[i].0, ERROR[i].1), values) != ratio(0, 1)));
    }

    #[test]
    fn on_a_linear_motion_the_step_is_its_polynomial() {
        let z = ratio(2, 3);
        let rate = |x: &DVector<Rational>| Ok::<_, Infallible>(x * z.clone());
        let step = DormandPrinceStep::take(rate, &DVector::from_element(1, ratio(1, 1)), &ratio(1, 1)).expect("no error");
        let terms = [(1, 1), (1, 1), (1, 2), (1, 6), (1, 24), (1, 120), (1, 600)];
        let (_, value) = terms.iter().fold((ratio(1, 1), ratio(0, 1)), |(power, sum), &(p, q)| (&power * &z, sum + &power * ratio(p, q)));
        assert_eq!(step.end[0], value);
        assert_eq!(step.at(&ratio(1, 1))[0], value);
        assert_eq!(step.at(&ratio(0, 1))[0], ratio(1, 1));
    }
}
