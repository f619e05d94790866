//! Sequential impulses, Bullet's iteration: one row after the other, the normals of all contacts first, then their friction, a given number
//! of times.
//!
//! ```text
//!     r_n ← max(0, r_n − y_n / D_nn) ,     y = u_free + shift + (W + R) r ,   D = diag(W + R) ,
//!     cone:  r_t ← P(r_t − D_t⁻¹ y_t)               both rows at once, P scales into the disc ‖r_t‖ ≤ μ r_n
//!     box:   r_e ← min(max(r_e − y_e / D_ee, −b), b)    for one axis e after the other, b = μ r_n, left alone while r_n = 0
//! ```
//! with the r_n of the moment. At the start r_n is a share of the previous step's impulse and r_t = 0. A sweep in which no row's velocity
//! changed by more than the residual is the last; the two rows of a cone count by the sum of their changes, which may cancel.
//!
//! The box is the polyhedral law with four directions: |r·d₁| + |r·d₂| ≤ μ r_n is, along the axes turned by 45°, |r_e| ≤ μ r_n/√2. In the
//! plane box and cone are one row.
//!
//! A fixed point of the cone's sweeps solves Coulomb's law, P being the projection that the law is written with as long as D_t is a
//! multiple of the identity. A fixed point of the box's sweeps need not solve its law: a contact whose normal impulse comes back to zero
//! keeps the friction it had.

use crate::tolerance::solvers::BULLET_RESIDUAL;
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::watch::is_over;
use moreau_contact::solvers::{ContactSolver, SolverEntry, parts};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Sequential impulses for the frictionless and Coulomb's law and, with four directions, the polyhedral one; W may be asymmetric and rank
/// deficient.
///
/// # Source
/// Bullet 3.25, `btSequentialImpulseConstraintSolver::solveSingleIteration` and `btMultiBodyConstraintSolver::solveSingleIteration`; E.
/// Catto, Iterative dynamics with temporal coherence, 2005.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SequentialImpulses {
    /// Most sweeps (`numSolverIterations`).
    pub sweeps: usize,
    /// Share of the normal impulses given that the first sweep starts from (`warmStartingFactor`).
    pub warm_start: f64,
    /// Ends the sweeps \[m²/s²\] (`solverResidualThreshold`).
    pub residual: f64,
}

impl Default for SequentialImpulses {
    /// PyBullet's values for its multibodies, which start from zero; its rigid bodies start from 0.1. Bullet's own are 10 sweeps, 0.85
    /// and 0.
    fn default() -> Self {
        SequentialImpulses { sweeps: 50, warm_start: 0.0, residual: BULLET_RESIDUAL }
    }
}

const NAME: &str = "sequential-impulses";

/// Its line in a table of solvers.
pub const SOLVER: SolverEntry = SolverEntry {
    name: NAME,
    default: || Box::new(SequentialImpulses::default()),
    limited: Some(|limit| Box::new(SequentialImpulses { sweeps: limit, ..Default::default() })),
};

/// The two axes along which a box bounds friction, in the contact's tangents: those of the square with corners at ±t₁, ±t₂.
const TURNED: [[f64; 2]; 2] = [
    [std::f64::consts::FRAC_1_SQRT_2, -std::f64::consts::FRAC_1_SQRT_2],
    [std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2],
];

impl ContactSolver for SequentialImpulses {
    fn name(&self) -> &'static str {
        NAME
    }

    fn is_truncated(&self) -> bool {
        true
    }

    fn takes_start(&self) -> bool {
        self.warm_start > 0.0
    }

    fn takes(&self, law: Law, rows: usize, _symmetric: bool) -> bool {
        is_boxed(law, rows).is_ok()
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let boxed = is_boxed(problem.law(), problem.rows_per_contact())?;
        let mut impulse = parts::start(problem, warm_start)?;
        for (row, r) in impulse.iter_mut().enumerate() {
            *r *= if row % problem.rows_per_contact() == 0 { self.warm_start } else { 0.0 };
        }
        let law_velocity = problem.law_velocity(&impulse);
        let mut sweep = Sweep { problem, boxed, impulse, law_velocity };
        let mut iterations = 0;
        while iterations < self.sweeps && !is_over() {
            iterations += 1;
            let change = sweep.run();
            if change * change <= self.residual {
                break;
            }
        }
        let velocity = problem.velocity(&sweep.impulse);
        parts::finite(Solution::new(NAME, sweep.impulse, velocity, iterations))
    }
}

/// Whether friction is bounded axis by axis.
fn is_boxed(law: Law, rows: usize) -> Result<bool> {
    match (law, rows) {
        (Law::Frictionless | Law::Coulomb, _) => Ok(false),
        (Law::PolyhedralCoulomb { .. }, 2) => Ok(false),
        (Law::PolyhedralCoulomb { directions: 4 }, 3) => Ok(true),
        (Law::PolyhedralCoulomb { directions }, _) => {
            Err(Error::refused(NAME, format!("bounds friction by a square, and this problem has {directions} directions")))
        }
        (law, _) => Err(parts::not_convex(NAME, law)),
    }
}

/// What a sweep works on.
struct Sweep<'a> {
    problem: &'a ContactProblem,
    boxed: bool,
    /// r \[N·s\].
    impulse: DVector<f64>,
    /// y \[m/s\], updated column by column.
    law_velocity: DVector<f64>,
}

impl Sweep<'_> {
    /// One sweep; the largest change of a row's velocity \[m/s\].
    fn run(&mut self) -> f64 {
        let rows = self.problem.rows_per_contact();
        let mut largest = 0.0f64;
        for row in (0..self.impulse.len()).step_by(rows).take_while(|_| !is_over()) {
            let (wanted, diagonal) = self.alone(row, &[1.0]);
            largest = largest.max((self.add(row, wanted.max(-self.impulse[row])) * diagonal).abs());
        }
        for k in (0..self.problem.contacts()).take_while(|_| !is_over()) {
            let normal = self.impulse[k * rows];
            let bound = parts::cone_friction(self.problem, k) * normal;
            let change = match rows {
                _ if self.boxed && normal > 0.0 => self.box_friction(k * rows + 1, bound * std::f64::consts::FRAC_1_SQRT_2),
                2 => self.one_friction(k * rows + 1, bound),
                3 if !self.boxed => self.cone_friction(k * rows + 1, bound),
                _ => 0.0,
            };
            largest = largest.max(change);
        }
        largest
    }

    /// What the row Σ axis_i · row_{first+i} would add to its impulse if it were alone and without bound \[N·s\], and its D \[1/kg\];
    /// nothing where D is zero.
    fn alone(&self, first: usize, axis: &[f64]) -> (f64, f64) {
        let (mut velocity, mut diagonal) = (0.0, 0.0);
        for (i, a) in axis.iter().enumerate() {
            velocity += a * self.law_velocity[first + i];
            diagonal += a * a * parts::compliance(self.problem, first + i);
            diagonal += axis.iter().enumerate().map(|(j, b)| a * b * self.problem.entry(first + i, first + j)).sum::<f64>();
        }
        if diagonal > f64::EPSILON { (-velocity / diagonal, diagonal) } else { (0.0, 0.0) }
    }

    /// Adds to the impulse of a row and carries y along; returns what was added.
    fn add(&mut self, row: usize, change: f64) -> f64 {
        if change != 0.0 {
            self.problem.add_column(row, change, self.law_velocity.as_mut_slice());
            self.law_velocity[row] += parts::compliance(self.problem, row) * change;
            self.impulse[row] += change;
        }
        change
    }

    /// The one friction row of a contact in the plane.
    fn one_friction(&mut self, row: usize, bound: f64) -> f64 {
        let (wanted, diagonal) = self.alone(row, &[1.0]);
        let reached = (self.impulse[row] + wanted).clamp(-bound, bound);
        (self.add(row, reached - self.impulse[row]) * diagonal).abs()
    }

    /// Both friction rows from the same y, scaled into the disc.
    fn cone_friction(&mut self, first: usize, bound: f64) -> f64 {
        let [(one, own), (other, across)] = [self.alone(first, &[1.0]), self.alone(first + 1, &[1.0])];
        let sum = [self.impulse[first] + one, self.impulse[first + 1] + other];
        let size = sum[0].hypot(sum[1]);
        let share = if size > bound { bound / size } else { 1.0 };
        let changes = [0, 1].map(|i: usize| sum[i] * share - self.impulse[first + i]);
        (self.add(first, changes[0]) * own + self.add(first + 1, changes[1]) * across).abs()
    }

    /// One axis of the square after the other.
    fn box_friction(&mut self, first: usize, bound: f64) -> f64 {
        let mut largest = 0.0f64;
        for axis in TURNED {
            let (wanted, diagonal) = self.alone(first, &axis);
            let now = axis[0] * self.impulse[first] + axis[1] * self.impulse[first + 1];
            let change = (now + wanted).clamp(-bound, bound) - now;
            self.add(first, axis[0] * change);
            self.add(first + 1, axis[1] * change);
            largest = largest.max((change * diagonal).abs());
        }
        largest
    }
}

#[cfg(test)]
#[path = "sequential_impulses_tests.rs"]
mod tests;
