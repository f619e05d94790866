//! A solver of your own, certified: `cargo run --example own_solver`.
//!
//! The projected gradient method on ½ rᵀ(W + R)r + (u_free + shift)ᵀr over the cones, for the convex laws:
//!     r ← P_K(r − y/L) ,    y = u_free + shift + (W + R) r ,    L ≥ ‖W + R‖ .
//! What every solver needs stands in `moreau::solvers::parts`. It takes a place in the table beside the others, and a scheme takes it too.

use moreau::nalgebra::{self, DVector, dmatrix, dvector};
use moreau::prelude::*;
use moreau::solvers::{self, SolverEntry, parts};

/// Projected gradients, with a limit of iterations.
#[derive(Default)]
struct ProjectedGradient;

const NAME: &str = "projected-gradient";
const ITERATIONS: usize = 100_000;

impl ContactSolver for ProjectedGradient {
    fn name(&self) -> &'static str {
        NAME
    }

    fn takes(&self, law: Law, _rows: usize, symmetric: bool) -> bool {
        symmetric && matches!(law, Law::Frictionless | Law::Associated)
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> moreau::Result<Solution> {
        parts::require_symmetry(NAME, problem)?;
        if !self.takes(problem.law(), problem.rows_per_contact(), true) {
            return Err(parts::not_convex(NAME, problem.law()));
        }
        let bound = solvers::largest_eigenvalue_bound(&problem.law_delassus()?);
        let mut impulse = parts::start(problem, warm_start)?;
        let mut done = 0;
        while done < ITERATIONS {
            let mut next = &impulse - problem.law_velocity(&impulse) / bound;
            parts::project(problem, &mut next);
            let change = (&next - &impulse).amax();
            (impulse, done) = (next, done + 1);
            if change <= 1e-15 * impulse.amax() {
                break;
            }
        }
        let velocity = problem.velocity(&impulse);
        parts::finite(Solution::new(NAME, impulse, velocity, done))
    }
}

/// Solves a problem by name, certifies it, and lets a scheme step with the solver.
pub fn main() -> moreau::Result<()> {
    let mine = SolverEntry { name: NAME, default: || Box::new(ProjectedGradient), limited: None };
    let table = Solvers::own().with(&[mine])?;
    // two contacts of one body, μ = ½
    let delassus = dmatrix![2.0, 0.0, 1.0, 0.0; 0.0, 1.0, 0.0, 1.0; 1.0, 0.0, 2.0, 0.0; 0.0, 1.0, 0.0, 1.0];
    let free = dvector![-1.0, 2.0, -0.5, 2.0];
    let problem = ContactProblem::new(delassus, free).law(Law::Associated).rows_per_contact(2).friction(vec![0.5; 2]).build()?;
    let answer = table.by_name(NAME)?.solve(&problem, None)?;
    let found = residuals(&problem, &answer)?;
    println!("{NAME}: u = {:.3?} m/s after {} iterations", answer.velocity.as_slice(), answer.iterations);
    assert!(found.is_solution(1e-8), "{found:?}");
    let refused = ProjectedGradient.solve(&problem.into_builder().law(Law::Coulomb).build()?, None);
    println!("{}", refused.expect_err("Coulomb's law is not convex"));

    // every step of a simulation is certified on its way
    let (mechanism, start) = scenes::named("box-stack")?.mechanism()?;
    let run = simulate(&moreau::schemes::Anitescu, &ProjectedGradient, mechanism.as_ref(), start, 0.01, 20)?;
    assert!(run.residuals.iter().flatten().all(|step| step.is_accepted()), "a step was rejected");
    println!("{} steps of {}, all accepted", run.residuals.len(), run.mechanism);
    Ok(())
}
