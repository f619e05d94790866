//! Equal bodies on top of each other on the floor, moving vertically, and projected Gauss–Seidel stopped after k sweeps.
//!
//! ```text
//!     W = tridiag(−1, 2, −1)/m , W₁₁ = 1/m ;   a sweep maps the contact velocity u ↦ G u ,   G = N (D − L)⁻¹ ,  W = D − L − N ,
//!     spectrum of G:  cos²((2j−1)π/(2n)) , j = 1 … n .
//! ```
//! *Derivation.* D⁻¹(L + N) has the eigenvectors x_k = cos((k−1)θ) with eigenvalue cos θ, nθ = (2j−1)π/2; Gauss–Seidel squares them
//! (W is tridiagonal, hence consistently ordered). G ≥ 0 entrywise, so from u ≤ 0 all impulses grow from zero and no projection acts.

use crate::Result;
use crate::contact::Contact;
use crate::mechanics::{BodyState, Mechanism, State};
use crate::problem::{ContactProblem, Law, Solution};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, StewartTrinkle, simulate};
use crate::solvers::{ContactSolver, ProjectedGaussSeidel};
use crate::trajectory::Recording;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;

/// Bodies of unit mass \[kg\]; q holds how far each has moved up from where it touches the one below.
pub struct Tower {
    /// n.
    pub bodies: usize,
    /// g \[m/s²\].
    pub gravity: f64,
    /// k of a spring that draws every body to where it touches the one below \[N/m\].
    pub stiffness: f64,
}

/// Overlap at the start under Moreau–Jean \[m\]: it does not see the size, and rounding cannot open the contact.
const OVERLAP: f64 = 1.0 / 1024.0;

impl Tower {
    /// At rest, every contact closed by the same overlap \[m\].
    fn at_rest(&self, overlap: f64) -> State {
        let sunk = |k: usize| -overlap * (k + 1) as f64;
        State { time: 0.0, position: DVector::from_fn(self.bodies, |k, _| sunk(k)), velocity: DVector::zeros(self.bodies) }
    }

    /// H, row k the velocity of body k relative to the one below.
    pub fn jacobian(&self) -> DMatrix<f64> {
        DMatrix::from_fn(self.bodies, self.bodies, |row, column| if row == column { 1.0 } else { -f64::from(row == column + 1) })
    }

    /// The first step of size h from rest: what is left to solve is u_free = −g h at the floor.
    pub fn first_step(&self, h: f64) -> ContactProblem {
        let jacobian = self.jacobian();
        ContactProblem::new(&jacobian * jacobian.transpose(), &jacobian * DVector::from_element(self.bodies, -self.gravity * h))
            .name("tower")
            .law(Law::Frictionless)
            .rows_per_contact(1)
            .build()
            .expect("numbers of a tower are finite")
    }

    /// cos²((2j−1)π/(2n)), the j-th largest factor of a sweep, j = 1 … n.
    pub fn sweep_factor(&self, place: usize) -> f64 {
        ((2 * place - 1) as f64 * PI / (2 * self.bodies) as f64).cos().powi(2)
    }

    /// The motion under Moreau–Jean, φ ≤ 0, e = 0.
    pub fn simulate(&self, solver: &dyn ContactSolver, theta: f64, h: f64, steps: usize) -> Result<Recording> {
        let scheme = MoreauJean { theta, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
        simulate(&scheme, solver, self, self.at_rest(OVERLAP), h, steps)
    }

    /// The motion under Stewart–Trinkle.
    pub fn simulate_positions(&self, solver: &dyn ContactSolver, h: f64, steps: usize) -> Result<Recording> {
        simulate(&StewartTrinkle::default(), solver, self, self.at_rest(0.0), h, steps)
    }

    /// How far the top has sunk up to a sample \[m\].
    pub fn sinking(&self, recording: &Recording, sample: usize) -> f64 {
        let top = self.bodies - 1;
        recording.samples[0].position[top] - recording.samples[sample].position[top]
    }

    /// Gᵏ for k sweeps.
    fn sweeps(&self, count: usize) -> DMatrix<f64> {
        let first = self.first_step(1.0);
        let delassus = first.dense();
        let lower = delassus.lower_triangle().try_inverse().expect("a lower triangle with a positive diagonal");
        let identity = DMatrix::identity(self.bodies, self.bodies);
        let sweep = &identity - delassus * lower;
        (0..count).fold(identity, |power, _| &sweep * power)
    }

    /// How far the top sinks \[m\], and its speed in the end \[m/s\], if every step does k linear sweeps from zero impulses,
    /// u⁺ = Gᵏ(u + u_g), by matrix powers.
    pub fn predicted_sinking(&self, count: usize, theta: f64, h: f64, steps: usize) -> [f64; 2] {
        let (sweeps, fall) = (self.sweeps(count), self.first_step(h).free_velocity().clone());
        let mut velocity = DVector::zeros(self.bodies);
        let mut sunk = 0.0;
        for _ in 0..steps {
            let next = &sweeps * (&velocity + &fall);
            // the top moves with the sum of the relative velocities
            sunk -= h * (theta * next.sum() + (1.0 - theta) * velocity.sum());
            velocity = next;
        }
        [sunk, -velocity.sum()]
    }

    /// The constant sinking speed u = Gᵏ(u + u_g) of the top \[m/s\].
    pub fn sinking_speed(&self, count: usize, h: f64) -> f64 {
        let (sweeps, fall) = (self.sweeps(count), self.first_step(h).free_velocity().clone());
        let left = DMatrix::identity(self.bodies, self.bodies) - &sweeps;
        -left.lu().solve(&(sweeps * fall)).expect("the factors of a sweep are below 1").sum()
    }
}

impl Mechanism for Tower {
    fn name(&self) -> &str {
        "tower"
    }
    fn degrees_of_freedom(&self) -> usize {
        self.bodies
    }
    fn rows_per_contact(&self) -> usize {
        1
    }
    fn mass_matrix(&self, _position: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::identity(self.bodies, self.bodies)
    }
    fn force(&self, position: &DVector<f64>, _velocity: &DVector<f64>) -> DVector<f64> {
        position.map(|moved| -self.gravity - self.stiffness * moved)
    }
    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let jacobian = self.jacobian();
        let contact = |k: usize| Contact {
            gap: position[k] - if k > 0 { position[k - 1] } else { 0.0 },
            jacobian: jacobian.rows(k, 1).into_owned().into(),
            friction: 0.0,
            restitution: 0.0,
            place: None,
        };
        (0..self.bodies).map(contact).collect()
    }
    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        self.gravity * position.sum() + 0.5 * self.stiffness * position.norm_squared()
    }
    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        let body = |k: usize| BodyState {
            name: format!("body{k}"),
            position: [0.0, 0.0, k as f64 + position[k]],
            orientation: [1.0, 0.0, 0.0, 0.0],
            linear_velocity: [0.0, 0.0, velocity[k]],
            angular_velocity: [0.0; 3],
        };
        (0..self.bodies).map(body).collect()
    }
}

/// Projected Gauss–Seidel with a fixed budget, warm or cold.
pub struct Sweeps {
    /// Sweeps per step.
    pub count: usize,
    /// Whether a step starts from the impulses of the one before.
    pub warm: bool,
}

impl Sweeps {
    /// From zero impulses in every step.
    pub fn cold(count: usize) -> Self {
        Sweeps { count, warm: false }
    }
}

impl ContactSolver for Sweeps {
    fn name(&self) -> &'static str {
        "truncated pgs"
    }
    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let solver = ProjectedGaussSeidel { sweeps: self.count, ..ProjectedGaussSeidel::default() };
        solver.solve(problem, warm_start.filter(|_| self.warm))
    }
}

/// Largest approach velocity that `sweeps` cold sweeps leave in a first step \[m/s\].
pub fn approach_left(tower: &Tower, sweeps: usize, h: f64) -> Result<f64> {
    let solution = Sweeps::cold(sweeps).solve(&tower.first_step(h), None)?;
    Ok(-solution.velocity.min())
}

/// Kinetic energy over (g h)² of a tower of three at rest after its weight was taken away, when the impulses (3, 2, 1) g h of the step
/// before are corrected by a few sweeps only.
pub fn energy_of_stale_impulses(sweeps: usize) -> Result<f64> {
    let weightless = Tower { bodies: 3, gravity: 0.0, stiffness: 0.0 };
    let stale = DVector::from_vec(vec![3.0, 2.0, 1.0]);
    let solution = Sweeps { count: sweeps, warm: true }.solve(&weightless.first_step(1.0), Some(&stale))?;
    Ok(0.5 * weightless.jacobian().tr_mul(&solution.impulse).norm_squared())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::{claims::pathology::solved_tower, rounding};

    #[test]
    fn the_predicted_factor_is_the_largest_eigenvalue_of_a_sweep() {
        let tower = Tower { bodies: 4, gravity: 10.0, stiffness: 0.0 };
        let eigenvalues = tower.sweeps(1).complex_eigenvalues();
        let largest = eigenvalues.iter().map(|value| value.re).fold(0.0, f64::max);
        assert!((largest - tower.sweep_factor(1)).abs() <= rounding(64, 1.0));
    }

    #[test]
    fn a_solved_tower_stands() {
        let tower = Tower { bodies: 5, gravity: 9.81, stiffness: 0.0 };
        let recording = tower.simulate(&ProjectedGaussSeidel::default(), 0.5, 0.01, 20).unwrap();
        assert!(tower.sinking(&recording, 20).abs() <= solved_tower(5, 0.01, 20));
    }
}
