//! Newton's method on the program of Gauss's principle, with an exact line search.
//!
//! ```text
//!     Δ ← Δ − α (M + Hᵀ∇²s H)⁻¹ (MΔ − Hᵀr) ,      α exact .
//! ```
//! The Hessian is factored by Cholesky over the bodies that pieces join; M makes it positive definite in every zone. While no contact
//! changes its zone and none slips on a round cone the cost is quadratic and one step ends at its minimiser.

use super::line_search::exact_step;
use super::{GaussProgram, Minimiser, Progress, through_program};
use crate::problem::{ContactProblem, Law, Solution};
use crate::solvers::ContactSolver;
use crate::tolerance::solvers::{NEWTON_STALLED, NEWTON_STEPS, STOP};
use crate::watch::is_over;
use moreau_exact::Result;
use nalgebra::DVector;

/// Newton's method for soft convex contact.
///
/// # Source
/// Chapter §6, table of solvers; MuJoCo documentation, *Computation: solver algorithms* (3.17).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussNewton {
    /// Most steps.
    pub steps: usize,
    /// ‖MΔ − Hᵀr‖ relative to its parts at which it stops, see [`GaussProgram::relative_gradient`].
    pub tolerance: f64,
}

impl Default for GaussNewton {
    fn default() -> Self {
        GaussNewton { steps: NEWTON_STEPS, tolerance: STOP }
    }
}

impl GaussNewton {
    /// The minimiser, from a start Δ.
    ///
    /// It ends at the tolerance, where no step descends any more, or when several steps in a row reduce neither cost nor gradient: then
    /// rounding is all that is left.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Solver`] if the Hessian is not positive definite, which only overflow can bring about.
    pub fn minimise(&self, program: &GaussProgram, start: DVector<f64>) -> Result<Minimiser> {
        let mut change = start;
        let mut impulse = program.impulse(&program.violation(&change));
        let mut progress = Progress::new(program, &change, &impulse);
        let (mut iterations, mut hessian) = (0, program.hessian()?);
        while progress.gradient > self.tolerance && iterations < self.steps && progress.stalled < NEWTON_STALLED {
            let curvatures = program.curvatures(&program.violation(&change));
            let direction = match hessian.solve_definite("newton", &curvatures, &-program.gradient(&change, &impulse)) {
                Err(_) if is_over() => break,
                found => found?,
            };
            let step = exact_step(program, &change, &direction);
            if step == 0.0 {
                break;
            }
            change += direction * step;
            impulse = program.impulse(&program.violation(&change));
            iterations += 1;
            progress.take(&change, &impulse);
        }
        Ok(progress.ends(iterations))
    }
}

impl ContactSolver for GaussNewton {
    fn name(&self) -> &'static str {
        "newton"
    }

    fn takes(&self, law: Law, _rows: usize, symmetric: bool) -> bool {
        symmetric && law.is_convex()
    }

    /// From the motion that the given impulses would cause, or from free motion.
    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let start = super::super::start_of_use(problem, warm_start)?;
        through_program(self.name(), problem, |program| {
            let pushed = problem.dynamics().map(|dynamics| dynamics.jacobian.tr_mul(&start));
            self.minimise(program, pushed.map_or_else(|| DVector::zeros(program.velocities()), |push| program.accelerate(&push)))
        })
    }
}
