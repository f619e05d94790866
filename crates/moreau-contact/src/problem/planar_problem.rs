//! Contacts in any ordered field, in rationals for instance: a Delassus operator and the velocities without impulses.
//!
//! ```text
//!     u = u_free + W r        W: rows × rows, symmetric positive semidefinite [1/kg];  u, u_free [m/s];  r [N·s]
//! ```
//! Rows are (n), (n, t) or (n, t₁, t₂) per contact. Without friction, and with friction that has finitely many directions,
//! the impulses solve a linear complementarity problem. In the plane the two senses of the tangent are all directions, so
//! that problem is Coulomb's law itself.

use super::{Lcp, stewart_trinkle};
use moreau_exact::number::counted;
use moreau_exact::scalar::{Rational, Scalar};
use moreau_exact::witness::{Part, Witness, decided, rational};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// The Delassus operator and the velocities without impulses.
///
/// ```
/// use moreau_contact::nalgebra::{DMatrix, DVector};
/// use moreau_contact::problem::PlanarProblem;
/// use moreau_contact::scalar::ratio;
///
/// // A unit mass hits the floor at (−1, 3) m/s with μ = ½: the tangential impulse is on the edge of the cone.
/// let problem = PlanarProblem::new(DMatrix::identity(2, 2), DVector::from_vec(vec![ratio(-1, 1), ratio(3, 1)]));
/// let impulse = problem.coulomb(&[ratio(1, 2)])?.solve()?;
/// assert_eq!(impulse.as_slice(), [ratio(1, 1), ratio(-1, 2)]); // exact
/// # Ok::<(), moreau_contact::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarProblem<T: Scalar> {
    /// W \[1/kg\], rows × rows.
    pub delassus: DMatrix<T>,
    /// u_free \[m/s\], with whatever the law adds to it; negative normal components approach.
    pub velocity: DVector<T>,
}

/// Impulses and the velocities that they leave.
#[derive(Clone, Debug, PartialEq)]
pub struct Response<T: Scalar> {
    /// r \[N·s\].
    pub impulse: DVector<T>,
    /// u = u_free + W r \[m/s\].
    pub after: DVector<T>,
}

/// A linear complementarity problem whose solutions z stand for impulses r = G z₁, z₁ the first unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct ImpulseLcp<T: Scalar> {
    /// 0 ≤ z ⟂ M z + q ≥ 0.
    pub lcp: Lcp<T>,
    /// G, rows × (unknowns that are impulses).
    pub generators: DMatrix<T>,
}

impl<T: Scalar> PlanarProblem<T> {
    /// The problem with this W and these velocities without impulses.
    ///
    /// # Panics
    /// If W is not square or the velocities have another size.
    pub fn new(delassus: DMatrix<T>, velocity: DVector<T>) -> Self {
        assert!(delassus.is_square() && delassus.nrows() == velocity.len(), "a problem needs a square W and a velocity of its size");
        PlanarProblem { delassus, velocity }
    }

    /// The same operator with the velocities u_free + shift.
    pub fn shifted(&self, shift: &DVector<T>) -> Self {
        PlanarProblem { delassus: self.delassus.clone(), velocity: &self.velocity + shift }
    }

    /// u = u_free + W r.
    pub fn response(&self, impulse: DVector<T>) -> Response<T> {
        let response = || Response { after: &self.velocity + &self.delassus * &impulse, impulse: impulse.clone() };
        decided(response, |found| {
            let (problem, found): (&PlanarProblem<Rational>, &Response<Rational>) = (rational(self)?, rational(found)?);
            let data = [("delassus", Part::from(&problem.delassus)), ("velocity", Part::from(&problem.velocity))];
            let answer = [("impulse", Part::from(&found.impulse)), ("after", Part::from(&found.after))];
            Some(Witness { kind: "response", parts: data.into_iter().chain(answer).collect() })
        })
    }

    /// The work of the impulses, ½ rᵀ(u + u_free) \[J\], if `velocity` is u_free alone, without a shift.
    pub fn energy_change(&self, response: &Response<T>) -> T {
        response.impulse.dot(&(&response.after + &self.velocity)) * T::ratio(1, 2)
    }

    /// 0 ≤ r ⟂ u_free + W r ≥ 0, one row per contact.
    pub fn frictionless(&self) -> Lcp<T> {
        Lcp::new(self.delassus.clone(), self.velocity.clone())
    }

    /// Coulomb's law in the plane, rows (n, t) per contact.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are not two rows per coefficient.
    pub fn coulomb(&self, friction: &[T]) -> Result<ImpulseLcp<T>> {
        if self.velocity.len() != 2 * friction.len() {
            let problem = format!("has {} for {}", counted(friction.len(), "coefficient"), counted(self.velocity.len(), "row"));
            return Err(Error::invalid("friction", problem, "give one coefficient per pair of rows (normal, tangent)"));
        }
        self.polyhedral(friction, &[[T::one(), T::zero()], [-T::one(), T::zero()]])
    }

    /// The Stewart–Trinkle problem with these friction directions in the tangent plane; in the plane their first
    /// components count.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are not two or three rows per coefficient.
    pub fn polyhedral(&self, friction: &[T], directions: &[[T; 2]]) -> Result<ImpulseLcp<T>> {
        let (rows, contacts) = (self.velocity.len(), friction.len());
        if contacts == 0 || !(rows == 2 * contacts || rows == 3 * contacts) {
            let problem = format!("has {contacts} for {rows}", contacts = counted(contacts, "coefficient"), rows = counted(rows, "row"));
            return Err(Error::invalid("friction", problem, "give one coefficient per contact of two or three rows"));
        }
        let decide = || {
            let generators = stewart_trinkle::generators(contacts, rows / contacts, directions);
            let transposed = generators.transpose();
            let reduced = &transposed * &self.delassus * &generators;
            let lcp = stewart_trinkle::lcp(&reduced, friction, &(transposed * &self.velocity));
            ImpulseLcp { lcp, generators }
        };
        Ok(decided(decide, |found| self.written_down(friction, directions, &found.lcp)))
    }

    /// The witness of a Stewart–Trinkle problem.
    fn written_down(&self, friction: &[T], directions: &[[T; 2]], lcp: &Lcp<T>) -> Option<Witness> {
        let numbers = |of: &[T]| of.iter().map(|number| rational::<T, Rational>(number).cloned()).collect::<Option<Vec<_>>>();
        let [delassus, matrix]: [&DMatrix<Rational>; 2] = [rational(&self.delassus)?, rational(&lcp.matrix)?];
        let [velocity, vector]: [&DVector<Rational>; 2] = [rational(&self.velocity)?, rational(&lcp.vector)?];
        // in the plane a direction has one component
        let components = (self.velocity.len() / friction.len() - 1).min(2);
        let directions = directions.iter().map(|direction| numbers(&direction[..components])).collect::<Option<Vec<_>>>()?;
        let mut parts = vec![("delassus", Part::from(delassus)), ("velocity", velocity.into())];
        parts.extend([("friction", Part::Vector(numbers(friction)?)), ("directions", Part::Vectors(directions))]);
        parts.extend([("matrix", matrix.into()), ("vector", vector.into())]);
        Some(Witness::new("stewart-trinkle", parts))
    }
}

impl<T: Scalar> ImpulseLcp<T> {
    /// r of a solution z.
    pub fn impulse(&self, solution: &DVector<T>) -> DVector<T> {
        &self.generators * solution.rows(0, self.generators.ncols())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};

    fn numbers<const N: usize>(entries: [i64; N]) -> DVector<Rational> {
        DVector::from_row_slice(&entries.map(|x| ratio(x, 1)))
    }

    #[test]
    fn the_lcp_of_one_planar_contact_is_that_of_the_chapter() {
        let delassus = DMatrix::from_row_slice(2, 2, numbers([2, 1, 1, 3]).as_slice());
        let problem = PlanarProblem::new(delassus, numbers([-1, 4])).coulomb(&[ratio(1, 2)]).expect("two rows");
        let rows = [[2, 1, -1, 0], [1, 3, -3, 1], [-1, -3, 3, 1], [0, -1, -1, 0]];
        let mut expected = DMatrix::from_fn(4, 4, |i, j| ratio(rows[i][j], 1));
        expected[(3, 0)] = ratio(1, 2);
        assert_eq!(problem.lcp.matrix, expected);
        assert_eq!(problem.lcp.vector, numbers([-1, 4, -4, 0]));
        assert_eq!(problem.impulse(&numbers([5, 1, 3, 7])), numbers([5, -2]));
    }

    #[test]
    fn the_work_of_the_impulses_is_the_change_of_kinetic_energy() {
        // one particle of 2 kg: W = 1/2, u from −3 to 1 m/s, ½·2·(1 − 9) J
        let problem = PlanarProblem::new(DMatrix::from_element(1, 1, ratio(1, 2)), numbers([-3]));
        let response = problem.response(numbers([8]));
        assert_eq!(response.after, numbers([1]));
        assert_eq!(problem.energy_change(&response), ratio(-8, 1));
    }

    #[test]
    fn rows_that_do_not_fit_the_coefficients_are_refused() {
        let problem = PlanarProblem::new(DMatrix::identity(3, 3), numbers([0, 0, 0]));
        assert!(problem.coulomb(&[ratio(1, 1)]).is_err());
        assert!(problem.polyhedral(&[ratio(1, 1)], &[]).is_ok());
        assert!(problem.polyhedral(&[ratio(1, 1), ratio(1, 1)], &[]).is_err());
        assert!(problem.polyhedral(&[], &[]).is_err());
    }
}
