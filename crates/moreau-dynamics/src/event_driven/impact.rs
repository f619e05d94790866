//! Impacts of touching contacts: Newton's restitution and Coulomb's law in one contact problem, and the rule that carries on beyond
//! infinitely many of them.
//!
//! ```text
//!     M (v⁺ − v⁻) = Hᵀ r ,   K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = H v⁺ + e min(u_n⁻, 0) n
//!     flight that e would start:  2 e |u_n⁻| / (−a_n) ,   a_n the acceleration of the gap without contact forces
//!     Zeno rule: where it is shorter than `shortest_flight`, e = 0 for this impact
//! ```
//! The rule skips flights that last τ(1 + e + e² + …) ≤ τ/(1 − e) in all and rise by at most |a_n|τ²/8; the energy lost with them is at
//! most ½ m (½|a_n|τ)². Without it (τ = 0) an event-driven method gets through infinitely many impacts only because floating-point time
//! stops.

use crate::mechanics::Mechanism;
use moreau_contact::contact::delassus::{MassFactor, delassus};
use moreau_contact::contact::{Contact, pairs};
use moreau_contact::problem::{ContactProblem, Dynamics, Law};
use moreau_contact::solvers::ContactSolver;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// The contacts that touch, and what solves their impact.
pub struct Impact<'a> {
    /// The mechanism.
    pub mechanism: &'a dyn Mechanism,
    /// The solver of the contact problem.
    pub solver: &'a dyn ContactSolver,
    /// Every candidate at q.
    pub contacts: &'a [Contact],
    /// Indices of the candidates that touch.
    pub touching: &'a [usize],
    /// q.
    pub position: &'a DVector<f64>,
    /// τ \[s\] of the Zeno rule.
    pub shortest_flight: f64,
}

impl Impact<'_> {
    /// Velocities after the impact and the impulses of the touching contacts, row by row; `None` if no contact arrives faster than `slow`
    /// \[m/s\].
    ///
    /// # Errors
    /// Those of the solver, or if the mass matrix is not positive definite.
    pub fn resolve(&self, velocity: &DVector<f64>, slow: f64) -> Result<Option<(DVector<f64>, DVector<f64>)>> {
        let rows = self.mechanism.rows_per_contact();
        let mut jacobian = DMatrix::zeros(rows * self.touching.len(), velocity.len());
        for (place, &k) in self.touching.iter().enumerate() {
            jacobian.rows_mut(place * rows, rows).copy_from(&self.contacts[k].jacobian.to_dense());
        }
        let arriving = &jacobian * velocity;
        if (0..self.touching.len()).all(|place| arriving[place * rows] >= -slow) {
            return Ok(None);
        }
        let mass = self.mechanism.mass_matrix(self.position);
        let factor = MassFactor::new(&mass)?;
        let free = &jacobian * factor.solve(&self.mechanism.force(self.position, velocity));
        let mut shift = DVector::zeros(arriving.len());
        for (place, &k) in self.touching.iter().enumerate() {
            let normal = place * rows;
            shift[normal] = self.restitution(&self.contacts[k], arriving[normal], free[normal]) * arriving[normal].min(0.0);
        }
        let problem = ContactProblem::new(delassus(&mass, &jacobian)?, arriving)
            .name(format!("{} impact", self.mechanism.name()))
            .law(if rows == 1 { Law::Frictionless } else { Law::Coulomb })
            .rows_per_contact(rows)
            .friction(self.touching.iter().map(|&k| self.contacts[k].friction).collect())
            .shift(shift)
            .dynamics(Dynamics { mass, jacobian: jacobian.clone() })
            .bodies(pairs(&self.touching.iter().map(|&k| self.contacts[k].place).collect::<Vec<_>>()))
            .build()?;
        let impulse = self.solver.solve(&problem, None)?.impulse;
        Ok(Some((velocity + factor.solve(&jacobian.tr_mul(&impulse)), impulse)))
    }

    /// e, or 0 by the Zeno rule.
    fn restitution(&self, contact: &Contact, arriving: f64, acceleration: f64) -> f64 {
        let flight = -2.0 * contact.restitution * arriving / -acceleration;
        let short = acceleration < 0.0 && flight < self.shortest_flight;
        if short { 0.0 } else { contact.restitution }
    }
}
