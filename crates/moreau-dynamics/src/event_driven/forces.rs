//! Contact forces between impacts: the complementarity problem of accelerations.
//!
//! ```text
//!     M v̇ = F + Hᵀ G z ,    a = H v̇ + Ḣ v
//!     opening or pressing     0 ≤ λ ⟂ a_n ≥ 0
//!     slipping, u_t ≠ 0       force λ (n − μ s t) ,  s = sign u_t
//!     sticking, u_t = 0       0 ≤ β± ⟂ ±a_t + σ ≥ 0 ,  0 ≤ σ ⟂ μλ − β⁺ − β⁻ ≥ 0          (Coulomb's law on accelerations)
//! ```
//! z = (λ, or λ, β⁺, β⁻, σ, contact by contact), 0 ≤ z ⟂ Nz + b ≥ 0. For slipping contacts N is not symmetric, and for Painlevé's rod there
//! may be no solution or several; Lemke's method then ends on a ray, or picks one.
//!
//! # Source
//! Lötstedt, *Mechanical systems of rigid bodies subject to unilateral constraints* (1982); Pfeiffer and Glocker (1996).

use crate::mechanics::Mechanism;
use moreau_contact::certificate::lcp::residuals;
use moreau_contact::contact::Contact;
use moreau_contact::contact::delassus::MassFactor;
use moreau_contact::problem::Lcp;
use moreau_contact::solvers::lemke::{LemkeOutcome, lemke};
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_contact::tolerance::cones::DIFFERENCE_STEP;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// How a closed contact moves along its tangent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tangent {
    /// There is no friction.
    Free,
    /// u_t = 0.
    Sticking,
    /// u_t has this sign.
    Slipping(f64),
}

/// A contact that is held: φ = 0 and u_n = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closed {
    /// Index into [`Mechanism::contacts`].
    pub contact: usize,
    /// What its tangent does.
    pub tangent: Tangent,
}

impl Closed {
    /// Number of its entries of z.
    pub fn unknowns(&self) -> usize {
        if self.tangent == Tangent::Sticking { 4 } else { 1 }
    }
}

/// The problem of accelerations at a state.
#[derive(Clone, Debug)]
pub struct Accelerations {
    /// N and b.
    pub lcp: Lcp<f64>,
    /// M⁻¹F \[m/s²\].
    free: DVector<f64>,
    /// M⁻¹HᵀG \[1/kg\].
    answer: DMatrix<f64>,
    /// G, contact rows × unknowns.
    generators: DMatrix<f64>,
}

impl Accelerations {
    /// The problem of the closed contacts of a mechanism.
    ///
    /// # Errors
    /// If the mass matrix is not positive definite or a number is not finite.
    pub fn new(mechanism: &dyn Mechanism, closed: &[Closed], position: &DVector<f64>, velocity: &DVector<f64>) -> Result<Self> {
        let factor = MassFactor::new(&mechanism.mass_matrix(position))?;
        let free = factor.solve(&mechanism.force(position, velocity));
        let contacts = if closed.is_empty() { Vec::new() } else { mechanism.contacts(position) };
        let rows = mechanism.rows_per_contact();
        let jacobian = rows_of(&contacts, closed, rows, velocity.len());
        let drift = if closed.is_empty() { DVector::zeros(0) } else { turning(mechanism, closed, position, velocity) };
        let (generators, probes, coupling) = structure(&contacts, closed, rows);
        let mut answer = jacobian.tr_mul(&generators);
        for mut column in answer.column_iter_mut() {
            let solved = factor.solve(&column.clone_owned());
            column.copy_from(&solved);
        }
        let matrix = &probes * &jacobian * &answer + coupling;
        let vector = &probes * (&jacobian * &free + drift);
        Ok(Accelerations { lcp: Lcp::new(matrix, vector), free, answer, generators })
    }

    /// v̇ under the forces z.
    pub fn acceleration(&self, z: &DVector<f64>) -> DVector<f64> {
        &self.free + &self.answer * z
    }

    /// The contact forces G z \[N\].
    pub fn forces(&self, z: &DVector<f64>) -> DVector<f64> {
        &self.generators * z
    }

    /// A solution by Lemke's method, the problem scaled to entries of order one.
    ///
    /// # Errors
    /// [`Error::Solver`] where the method ends without one: Painlevé's paradox, or rounding.
    pub fn solve(&self) -> Result<DVector<f64>> {
        let [size, pull] = [self.lcp.matrix.amax(), self.lcp.vector.amax()].map(|scale| if scale > 0.0 { scale } else { 1.0 });
        let scaled = Lcp::new(self.lcp.matrix.clone(), &self.lcp.vector / pull * size);
        match lemke(&scaled, &DVector::from_element(self.lcp.size(), 1.0))? {
            LemkeOutcome::Solution { z, .. } => {
                let left = residuals(&scaled, &z);
                let largest = left.primal.max(left.dual).max(left.complementarity / size);
                // a NaN is not small either
                if largest <= CERTIFY * size * (1.0 + z.amax()) {
                    return Ok(z * (pull / size));
                }
                Err(Error::breakdown(
                    "event-driven",
                    format!("finds contact forces with a residual of {largest:.1e}; rescale the units of the scene"),
                ))
            }
            LemkeOutcome::Ray { .. } => Err(Error::ray(
                "event-driven",
                "finds no contact forces that keep the contacts closed or open (Painlevé's paradox): the method is not defined here",
            )),
        }
    }
}

/// H of the closed contacts.
fn rows_of(contacts: &[Contact], closed: &[Closed], rows: usize, columns: usize) -> DMatrix<f64> {
    let mut jacobian = DMatrix::zeros(rows * closed.len(), columns);
    for (k, one) in closed.iter().enumerate() {
        jacobian.rows_mut(k * rows, rows).copy_from(&contacts[one.contact].jacobian.to_dense());
    }
    jacobian
}

/// Ḣ v, the difference of H along v.
fn turning(mechanism: &dyn Mechanism, closed: &[Closed], position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
    let speed = velocity.amax();
    let rows = mechanism.rows_per_contact();
    if speed == 0.0 {
        return DVector::zeros(rows * closed.len());
    }
    let time = DIFFERENCE_STEP / speed;
    let at = |sign: f64| rows_of(&mechanism.contacts(&mechanism.integrate(position, velocity, sign * time)), closed, rows, velocity.len());
    (at(1.0) - at(-1.0)) * velocity / (2.0 * time)
}

/// G, the rows that turn accelerations into the left sides, and the entries of N that are not W.
fn structure(contacts: &[Contact], closed: &[Closed], rows: usize) -> (DMatrix<f64>, DMatrix<f64>, DMatrix<f64>) {
    let size = closed.iter().map(Closed::unknowns).sum();
    let mut generators = DMatrix::zeros(rows * closed.len(), size);
    let mut probes = DMatrix::zeros(size, rows * closed.len());
    let mut coupling = DMatrix::zeros(size, size);
    let mut at = 0;
    for (k, one) in closed.iter().enumerate() {
        let (normal, tangent, mu) = (k * rows, k * rows + 1, contacts[one.contact].friction);
        generators[(normal, at)] = 1.0;
        probes[(at, normal)] = 1.0;
        match one.tangent {
            Tangent::Free => {}
            Tangent::Slipping(sign) => generators[(tangent, at)] = -mu * sign,
            Tangent::Sticking => {
                for (beta, sign) in [(at + 1, 1.0), (at + 2, -1.0)] {
                    generators[(tangent, beta)] = sign;
                    probes[(beta, tangent)] = sign;
                    coupling[(beta, at + 3)] = 1.0;
                    coupling[(at + 3, beta)] = -1.0;
                }
                coupling[(at + 3, at)] = mu;
            }
        }
        at += one.unknowns();
    }
    (generators, probes, coupling)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{BeadInCircle, PainleveRod, PointMass};
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    #[test]
    fn a_block_on_a_slope_sticks_or_slides_as_coulomb_says() {
        let angle = 0.35f64;
        for (friction, expected) in [(0.5, 0.0), (0.3, 9.81 * (angle.sin() - 0.3 * angle.cos()))] {
            let block = PointMass::block_on_incline(2.0, 9.81, angle, friction, 0.0);
            let closed = [Closed { contact: 0, tangent: Tangent::Sticking }];
            let problem = Accelerations::new(&block, &closed, &dvector![0.0, 0.0], &dvector![0.0, 0.0]).expect("valid");
            let z = problem.solve().expect("solvable");
            let found = problem.acceleration(&z);
            assert!((found[0] - expected).abs() <= rounding(64, 10.0) && found[1].abs() <= rounding(64, 10.0), "{found}");
            assert!((problem.forces(&z)[0] - 2.0 * 9.81 * angle.cos()).abs() <= rounding(64, 20.0));
        }
    }

    #[test]
    fn a_bead_in_a_circle_is_pressed_by_its_speed() {
        let bead = BeadInCircle::new(2.0, 0.5, 0.0, 0.0, 0.0).expect("valid");
        let closed = [Closed { contact: 0, tangent: Tangent::Free }];
        let problem = Accelerations::new(&bead, &closed, &dvector![0.5, 0.0], &dvector![0.0, 3.0]).expect("valid");
        // m v²/R
        assert!((problem.solve().expect("solvable")[0] - 2.0 * 9.0 / 0.5).abs() <= 1e-7);
    }

    #[test]
    fn painleves_rod_has_no_force() {
        let state = (dvector![0.0, 0.8, 0.8f64.atan2(0.6)], dvector![-1.0, 0.0, 0.0]);
        let force = |friction: f64| {
            let rod = PainleveRod::new(1.0, 1.0, 9.81, friction, 0.0).expect("valid");
            let closed = [Closed { contact: 0, tangent: Tangent::Slipping(-1.0) }];
            Accelerations::new(&rod, &closed, &state.0, &state.1).expect("valid").solve()
        };
        assert!(force(1.0).expect("below μ_P = 13/9")[0] > 0.0);
        assert!(force(2.0).expect_err("above it").to_string().contains("Painlevé"));
    }
}
