//! Balls on a line: M = diag(m), φ_k = q_{k+1} − q_k − (r_k + r_{k+1}), no force but contact.

use super::point_mass::{material, positive};
use super::{BodyState, Mechanism};
use moreau_contact::contact::{Contact, Rows};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Frictionless balls on a line (Newton's cradle); q holds the places of the centres, in order.
#[derive(Clone, Debug)]
pub struct BallChain {
    masses: Vec<f64>,
    radii: Vec<f64>,
    restitution: f64,
}

impl BallChain {
    /// Balls of masses m \[kg\] and radii r \[m\] with one coefficient of restitution.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there is no ball, the lists differ in length, a mass or radius is not positive or e ∉ \[0, 1\].
    ///
    /// ```
    /// use moreau_dynamics::mechanics::{BallChain, Mechanism};
    /// use nalgebra::dvector;
    ///
    /// let two = BallChain::new(vec![1.0, 3.0], vec![0.5, 0.5], 1.0)?;
    /// let contacts = two.contacts(&dvector![0.0, 1.25]); // centres on a line
    /// assert_eq!((contacts.len(), contacts[0].gap), (1, 0.25));
    /// assert!(BallChain::new(vec![-1.0], vec![0.5], 1.0).is_err());
    /// # Ok::<(), moreau_exact::Error>(())
    /// ```
    pub fn new(masses: Vec<f64>, radii: Vec<f64>, restitution: f64) -> Result<Self> {
        if masses.is_empty() || masses.len() != radii.len() {
            let problem = format!("has {} for {}", counted(radii.len(), "entry"), counted(masses.len(), "ball"));
            return Err(Error::invalid("radii", problem, "give every ball, at least one, a mass and a radius"));
        }
        masses.iter().try_for_each(|&m| positive("masses", m))?;
        radii.iter().try_for_each(|&r| positive("radii", r))?;
        material(0.0, restitution)?;
        Ok(BallChain { masses, radii, restitution })
    }
}

impl Mechanism for BallChain {
    fn name(&self) -> &str {
        "chain of balls"
    }

    fn degrees_of_freedom(&self) -> usize {
        self.masses.len()
    }

    fn rows_per_contact(&self) -> usize {
        1
    }

    fn mass_matrix(&self, _position: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::from_diagonal(&DVector::from_column_slice(&self.masses))
    }

    fn force(&self, _position: &DVector<f64>, _velocity: &DVector<f64>) -> DVector<f64> {
        DVector::zeros(self.masses.len())
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let contact = |k: usize| Contact {
            gap: position[k + 1] - position[k] - (self.radii[k] + self.radii[k + 1]),
            jacobian: Rows::zeros(1, self.masses.len()).with(k, [[-1.0]]).with(k + 1, [[1.0]]),
            friction: 0.0,
            restitution: self.restitution,
            place: None,
        };
        (0..self.masses.len() - 1).map(contact).collect()
    }

    fn potential_energy(&self, _position: &DVector<f64>) -> f64 {
        0.0
    }

    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        let ball = |k: usize| BodyState {
            name: format!("ball{k}"),
            position: [position[k], 0.0, 0.0],
            orientation: [1.0, 0.0, 0.0, 0.0],
            linear_velocity: [velocity[k], 0.0, 0.0],
            angular_velocity: [0.0; 3],
        };
        (0..self.masses.len()).map(ball).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::assert_consistent;
    use super::*;
    use moreau_contact::contact::delassus::delassus;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn neighbours_couple_through_the_mass_of_the_ball_between_them() {
        let chain = BallChain::new(vec![1.0, 2.0, 4.0], vec![0.1; 3], 1.0).expect("valid");
        let contacts = chain.contacts(&dvector![0.0, 0.3, 0.5]);
        assert!((contacts[0].gap - 0.1).abs() < f64::EPSILON && contacts[1].gap.abs() < f64::EPSILON);
        let jacobian = DMatrix::from_fn(2, 3, |i, j| contacts[i].jacobian[(0, j)]);
        let w = delassus(&chain.mass_matrix(&dvector![0.0, 0.3, 0.5]), &jacobian).expect("SPD");
        assert_eq!(w, dmatrix![1.5, -0.5; -0.5, 0.75]);
    }

    #[test]
    fn gaps_and_jacobians_agree() {
        let chain = BallChain::new(vec![1.0, 2.0, 4.0], vec![0.1, 0.2, 0.3], 1.0).expect("valid");
        assert_consistent(&chain, &dvector![0.0, 0.3, 0.5], &dvector![1.0, -0.3, 0.2]);
    }

    #[test]
    fn nonsense_is_refused() {
        assert!(BallChain::new(vec![], vec![], 1.0).is_err());
        assert!(BallChain::new(vec![1.0], vec![0.1, 0.1], 1.0).is_err());
        assert!(BallChain::new(vec![-1.0], vec![0.1], 1.0).is_err());
        assert!(BallChain::new(vec![1.0], vec![f64::NAN], 1.0).is_err());
    }
}
