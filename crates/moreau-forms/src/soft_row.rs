//! One row of a softly constrained motion in any ordered field: inverse inertia A, regularisation R \[1/kg\], force f \[N\], accelerations
//! \[m/s²\].
//!
//! ```text
//!     a = a_u + A f ,    a_ref − a = R f    ⇒    f = (a_ref − a_u)/(A + R) ,    a = (A a_ref + R a_u)/(A + R) ;
//!                                             one-sided: f ← max(0, f)
//!     R = (1−d)/d·A      ⇒    a = d a_ref + (1−d) a_u
//! ```
//! f is the minimiser of ½(A+R)f² + (a_u − a_ref)f, over f ≥ 0 if the row is one-sided.

use moreau_exact::minimum::Minimum;
use moreau_exact::scalar::Scalar;
use moreau_exact::witness::{Witness, decided};

/// The row.
///
/// # Source
/// MuJoCo documentation, *Computation: constraint model* (3.17).
#[derive(Clone, Debug, PartialEq)]
pub struct SoftRow<T> {
    /// A \[1/kg\].
    pub inverse_inertia: T,
    /// R \[1/kg\].
    pub regularisation: T,
}

impl<T: Scalar> SoftRow<T> {
    /// R = (1−d)/d·A, the impedance d in (0, 1].
    pub fn of_impedance(inverse_inertia: T, impedance: &T) -> Self {
        let regularisation = (T::one() - impedance.clone()) / impedance.clone() * inverse_inertia.clone();
        SoftRow { inverse_inertia, regularisation }
    }

    /// f of a two-sided row \[N\].
    pub fn force(&self, reference: &T, free: &T) -> T {
        let force = || (reference.clone() - free.clone()) / (self.inverse_inertia.clone() + self.regularisation.clone());
        decided(force, |found| self.least(reference, free, Vec::new(), found))
    }

    /// f of a one-sided row \[N\], a contact.
    pub fn one_sided_force(&self, reference: &T, free: &T) -> T {
        let push = || {
            let force = self.force(reference, free);
            if force > T::zero() { force } else { T::zero() }
        };
        decided(push, |found| self.least(reference, free, vec![[T::one()]], found))
    }

    /// The witness that a force is the minimiser.
    fn least(&self, reference: &T, free: &T, rows: Vec<[T; 1]>, force: &T) -> Option<Witness> {
        let matrix = [[self.inverse_inertia.clone() + self.regularisation.clone()]];
        Minimum { matrix, vector: [free.clone() - reference.clone()], rows }.witness(std::array::from_ref(force))
    }

    /// a under a force \[m/s²\].
    pub fn acceleration(&self, force: &T, free: &T) -> T {
        free.clone() + self.inverse_inertia.clone() * force.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;

    #[test]
    fn with_the_regularisation_of_an_impedance_the_acceleration_is_the_weighted_mean() {
        let row = SoftRow::of_impedance(ratio(2, 3), &ratio(9, 10));
        let (reference, free) = (ratio(7, 1), ratio(-10, 1));
        let force = row.force(&reference, &free);
        assert_eq!(row.acceleration(&force, &free), ratio(9, 10) * reference.clone() + ratio(1, 10) * free.clone());
        assert_eq!(reference - row.acceleration(&force, &free), row.regularisation.clone() * force);
    }

    #[test]
    fn a_one_sided_row_does_not_pull() {
        let row = SoftRow::of_impedance(ratio(1, 1), &ratio(1, 2));
        assert_eq!(row.one_sided_force(&ratio(-3, 1), &ratio(2, 1)), ratio(0, 1));
        assert_eq!(row.one_sided_force(&ratio(3, 1), &ratio(1, 1)), ratio(1, 1));
    }
}
