//! Gauss's principle with soft contacts: the change of velocity Δ = v⁺ − v_free that deviates least from free motion, paying for violation.
//!
//! ```text
//!     min over Δ   ½ ΔᵀM Δ + Σ s_k(y_k) ,   y = H Δ + b ,   b = u_free + shift ;      r = −∇s(y) ,   M Δ = Hᵀ r ,
//!     min over r   ½ rᵀ(W + R) r + bᵀr   over the cones                             (its dual, with the same r)
//! ```
//! M \[kg\] is nv × nv and positive definite, H has one row per row of a [`SoftPiece`], y and b are in m/s, r in N·s. The sum is strictly
//! convex and has one minimiser. MuJoCo writes the same problem for accelerations, which divides Δ, y and b by h.

mod line_search;
mod newton;
mod piece;
mod program;

pub use line_search::exact_step;
pub use newton::GaussNewton;
pub use piece::SoftPiece;
pub use program::GaussProgram;

use crate::problem::{ContactProblem, Solution};
use crate::tolerance::solvers::COST_FLOOR;
use moreau_exact::Result;
use nalgebra::DVector;

/// Where an iteration ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimiser {
    /// Δ, the change of velocity.
    pub change: DVector<f64>,
    /// r, one entry per row of the program \[N·s\].
    pub impulse: DVector<f64>,
    /// Iterations made.
    pub iterations: usize,
    /// The gradient of the program, relative to its larger term.
    pub relative_gradient: f64,
}

/// The best iterate so far, and how long nothing better has come.
///
/// The cost decides while it falls by more than its own rounding; the gradient may well grow then, where contacts change their zones. Where
/// the cost stands still the gradient decides.
pub struct Progress<'a> {
    program: &'a GaussProgram,
    cost: f64,
    gradient: f64,
    change: DVector<f64>,
    impulse: DVector<f64>,
    stalled: usize,
}

impl<'a> Progress<'a> {
    /// The first iterate: Δ and its r.
    pub fn new(program: &'a GaussProgram, change: &DVector<f64>, impulse: &DVector<f64>) -> Self {
        let gradient = program.relative_gradient(change, impulse);
        Progress { program, cost: program.cost(change), gradient, change: change.clone(), impulse: impulse.clone(), stalled: 0 }
    }

    /// Keeps the iterate if it is better.
    pub fn take(&mut self, change: &DVector<f64>, impulse: &DVector<f64>) {
        let (cost, gradient) = (self.program.cost(change), self.program.relative_gradient(change, impulse));
        if cost < self.cost * (1.0 - COST_FLOOR) || gradient < self.gradient {
            *self = Progress { cost: cost.min(self.cost), stalled: 0, ..Progress::new(self.program, change, impulse) };
        } else {
            self.stalled += 1;
        }
    }

    /// The relative gradient of the best iterate.
    pub fn gradient(&self) -> f64 {
        self.gradient
    }

    /// Iterates since the best one.
    pub fn stalled(&self) -> usize {
        self.stalled
    }

    /// The best iterate, after so many iterations.
    pub fn ends(self, iterations: usize) -> Minimiser {
        Minimiser { change: self.change, impulse: self.impulse, iterations, relative_gradient: self.gradient }
    }
}

/// Solves a contact problem by what minimises its program, and reads the answer in the problem's coordinates.
///
/// # Errors
/// Those of [`GaussProgram::of_problem`] and of `minimise`; [`moreau_exact::Error::Solver`] if the answer is not finite.
pub fn through_program(
    name: &'static str,
    problem: &ContactProblem,
    minimise: impl FnOnce(&GaussProgram) -> Result<Minimiser>,
) -> Result<Solution> {
    let program = GaussProgram::of_problem(name, problem)?;
    let Minimiser { impulse, iterations, .. } = minimise(&program)?;
    let (impulse, beta) = program::in_contacts(problem, &impulse);
    let velocity = problem.velocity(&impulse);
    super::finite(Solution { beta, ..Solution::new(name, impulse, velocity, iterations) })
}
