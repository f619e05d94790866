//! Newton's cradle with three equal balls, the first of which arrives at 1 m/s: the balls collide at once, or two by two.
//!
//! ```text
//!     at once       v⁺ = v_c + e (v_c − v⁻) ,  v_c = (1, 1, 1)/3:      v⁺ = (1 − 2e, 1 + e, 1 + e)/3
//!     two by two    ball 1 on 2, then 2 on 3:                          v  = ((1 − e)/2, (1 − e²)/4, (1 + e)²/4)
//!                   for e < 1 the first ball then catches up with the second: further impacts follow; for e = 1 none does
//! ```
//! Both keep momentum, and at e = 1 both keep energy: the coefficients do not decide between them.

use moreau_exact::scalar::Scalar;

/// Velocities \[m/s\] after all three collide at once.
pub fn at_once<T: Scalar>(restitution: &T) -> [T; 3] {
    let third = T::ratio(1, 3);
    let later = (T::one() + restitution.clone()) * third.clone();
    [(T::one() - T::ratio(2, 1) * restitution.clone()) * third, later.clone(), later]
}

/// Velocities \[m/s\] after the first ball has hit the second and the second the third.
///
/// ```
/// use moreau_exact::scalar::ratio;
/// use moreau_forms::newtons_cradle::{after_two_impacts, at_once};
///
/// let elastic = ratio(1, 1);
/// assert_eq!(after_two_impacts(&elastic), [ratio(0, 1), ratio(0, 1), ratio(1, 1)]); // as on the desk
/// assert_eq!(at_once(&elastic), [ratio(-1, 3), ratio(2, 3), ratio(2, 3)]); // the same momentum and energy
/// ```
pub fn after_two_impacts<T: Scalar>(restitution: &T) -> [T; 3] {
    let (keep, pass) = ((T::one() - restitution.clone()) * T::ratio(1, 2), (T::one() + restitution.clone()) * T::ratio(1, 2));
    [keep.clone(), keep * pass.clone(), pass.clone() * pass]
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};

    fn momentum_and_energy(velocities: &[Rational; 3]) -> [Rational; 2] {
        let square = |v: &Rational| v * v * ratio(1, 2);
        let sum = |a: Rational, b: Rational| a + b;
        [velocities.iter().cloned().fold(ratio(0, 1), sum), velocities.iter().map(square).fold(ratio(0, 1), sum)]
    }

    #[test]
    fn both_outcomes_keep_momentum_and_at_e_1_energy() {
        for e in [ratio(0, 1), ratio(1, 2), ratio(1, 1)] {
            for velocities in [at_once(&e), after_two_impacts(&e)] {
                assert_eq!(momentum_and_energy(&velocities)[0], ratio(1, 1));
            }
        }
        let elastic = ratio(1, 1);
        for velocities in [at_once(&elastic), after_two_impacts(&elastic)] {
            assert_eq!(momentum_and_energy(&velocities)[1], ratio(1, 2));
        }
        assert_eq!(at_once(&elastic), [ratio(-1, 3), ratio(2, 3), ratio(2, 3)]);
        assert_eq!(after_two_impacts(&elastic), [ratio(0, 1), ratio(0, 1), ratio(1, 1)]);
    }
}
