//! An impact in contact coordinates, and what came of it: U⁺ = U⁻ + W P.

use moreau_contact::problem::{Lcp, stewart_trinkle};
use moreau_contact::solvers::lemke::{LemkeOutcome, lemke};
use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// The contact velocities before an impact and the Delassus operator; one row per contact without friction, rows
/// (normal, tangent) per contact with friction in the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Impact<T: Scalar> {
    /// W \[1/kg\], symmetric positive semidefinite, rows × rows.
    pub delassus: DMatrix<T>,
    /// U⁻ \[m/s\], negative normal components approach.
    pub before: DVector<T>,
}

/// Impulses and velocities of an impact.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome<T: Scalar> {
    /// P \[N·s\].
    pub impulse: DVector<T>,
    /// U⁺ \[m/s\].
    pub after: DVector<T>,
}

impl<T: Scalar> Impact<T> {
    /// The impact with this W and U⁻.
    ///
    /// # Panics
    /// If W is not square or U⁻ has another size.
    pub fn new(delassus: DMatrix<T>, before: DVector<T>) -> Self {
        assert!(delassus.is_square() && delassus.nrows() == before.len(), "an impact needs a square W and a velocity of its size");
        Impact { delassus, before }
    }

    /// U⁺ = U⁻ + W P.
    pub fn outcome(&self, impulse: DVector<T>) -> Outcome<T> {
        Outcome { after: &self.before + &self.delassus * &impulse, impulse }
    }

    /// ΔT = ½ Pᵀ(U⁺ + U⁻) \[J\].
    pub fn energy_change(&self, outcome: &Outcome<T>) -> T {
        outcome.impulse.dot(&(&outcome.after + &self.before)) * T::ratio(1, 2)
    }

    /// P with 0 ≤ U⁺ + shift ⟂ P ≥ 0.
    ///
    /// # Errors
    /// [`Error::Solver`] if Lemke's method ends on a ray, which exact arithmetic excludes for a semidefinite W that comes from a Jacobian.
    pub(super) fn unilateral(&self, shift: &DVector<T>) -> Result<DVector<T>> {
        solve(&Lcp::new(self.delassus.clone(), &self.before + shift))
    }

    /// P of planar Coulomb friction on the velocities U⁺ with at least these normal impulses, 0 ≤ U_n⁺ ⟂ P_n − least ≥ 0; rows (normal,
    /// tangent) per contact: the Stewart–Trinkle problem with both senses of the tangent, whose friction bound starts at μ least.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are not two rows per coefficient; [`Error::Solver`] if Lemke's method ends on a ray.
    pub(super) fn coulomb(&self, friction: &[T], least: &DVector<T>) -> Result<DVector<T>> {
        if self.before.len() != 2 * friction.len() {
            let problem = format!("has {} coefficients for {} rows", friction.len(), self.before.len());
            return Err(Error::invalid("friction", problem, "give one coefficient per pair of rows (normal, tangent)"));
        }
        let senses = [[T::one(), T::zero()], [-T::one(), T::zero()]];
        let generators = stewart_trinkle::generators(friction.len(), 2, &senses);
        let given = DVector::from_fn(self.before.len(), |i, _| if i % 2 == 0 { least[i / 2].clone() } else { T::zero() });
        let reduced = generators.transpose() * &self.delassus * &generators;
        let velocity = generators.transpose() * (&self.before + &self.delassus * &given);
        let mut lcp = stewart_trinkle::lcp(&reduced, friction, &velocity);
        for (k, mu) in friction.iter().enumerate() {
            lcp.vector[generators.ncols() + k] = mu.clone() * least[k].clone();
        }
        let z = solve(&lcp)?;
        Ok(given + &generators * z.rows(0, generators.ncols()))
    }
}

/// A solution of an LCP by Lemke's method.
pub(super) fn solve<T: Scalar>(lcp: &Lcp<T>) -> Result<DVector<T>> {
    match lemke(lcp, &DVector::from_element(lcp.size(), T::one()))? {
        LemkeOutcome::Solution { z, .. } => Ok(z),
        LemkeOutcome::Ray { .. } => Err(Error::ray("lemke", "ended on a ray")),
    }
}

/// Refuses coefficients outside \[0, 1\] or in the wrong number.
pub(super) fn check_restitution<T: Scalar>(restitution: &[T], contacts: usize) -> Result<()> {
    if restitution.len() != contacts || restitution.iter().any(|e| !(*e >= T::zero() && *e <= T::one())) {
        return Err(Error::invalid(
            "restitution",
            "is not a list of numbers in [0, 1], one per contact",
            format!("give {contacts} numbers from 0 to 1"),
        ));
    }
    Ok(())
}
