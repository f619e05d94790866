//! Mistakes of contact solvers. They show in scenes as well as in problems.

use crate::planted::Planted;
use crate::planted::parts::{Answers, answer, row_by_row, with_solver};
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::{Auto, ContactSolver, ProjectedGaussSeidel};
use moreau_exact::Result;
use nalgebra::DVector;

/// The mistakes of this family.
pub const PLANTED: &[Planted] = &[
    Planted {
        name: "solver/three-sweeps",
        mistake: "Gauss–Seidel stops after three sweeps and forgets the impulses of the step before",
        engine: || with_solver(|| Box::new(Answers(three_sweeps))),
        caught_by: &["solver/redundant", "solver/conditioning", "stack/five", "stack/ten", "stack/mass-ratio", "metamorphic/body-order"],
    },
    Planted {
        name: "solver/a-thousandth-left",
        mistake: "stops when a thousandth of every impulse is still missing, three times what the gate allows",
        engine: || with_solver(|| Box::new(Answers(|problem, start| left_over(problem, start, 1e-3)))),
        caught_by: UNSOLVED,
    },
    Planted {
        name: "solver/no-impulse",
        mistake: "answers zero impulses to every problem",
        engine: || with_solver(|| Box::new(Answers(|problem, _| Ok(answer(problem, DVector::zeros(problem.rows()), 0))))),
        caught_by: &["solver/certificate", "solver/redundant", "solver/jamming", "stack/five"],
    },
    Planted {
        name: "solver/normal-impulses-clipped",
        mistake: "keeps normal impulses from pulling and lets friction be as large as sticking needs",
        engine: || with_solver(|| Box::new(Answers(normals_clipped))),
        caught_by: &["solver/certificate", "solver/jamming"],
    },
    Planted {
        name: "solver/shift-ignored",
        mistake: "leaves out what the scheme adds to the velocity: restitution, φ/h",
        engine: || with_solver(|| Box::new(Answers(shift_ignored))),
        caught_by: &["solver/certificate", "solver/redundant"],
    },
    Planted {
        name: "solver/convex-relaxation",
        mistake: "declares Coulomb's law and solves the associated one, which lifts what slides",
        engine: || with_solver(|| Box::new(Answers(convex_relaxation))),
        caught_by: &["solver/certificate", "solver/friction-range"],
    },
    Planted {
        name: "solver/velocity-as-wished",
        mistake: "reports the velocity the law asks for instead of the one its impulses give",
        engine: || with_solver(|| Box::new(Answers(velocity_as_wished))),
        caught_by: &["solver/infeasible"],
    },
];

/// The checks that ask how well a step is solved, where one body makes it plain.
const UNSOLVED: &[&str] = &["rest/jitter", "incline/stick", "incline/stick-threshold", "solver/certificate"];

/// The solution, but for a part of every impulse.
fn left_over(problem: &ContactProblem, start: &DVector<f64>, part: f64) -> Result<Solution> {
    let solution = Auto.solve(problem, Some(start))?;
    Ok(answer(problem, solution.impulse * (1.0 - part), solution.iterations))
}

fn three_sweeps(problem: &ContactProblem, _start: &DVector<f64>) -> Result<Solution> {
    ProjectedGaussSeidel { sweeps: 3, ..Default::default() }.solve(problem, None)
}

fn normals_clipped(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let sweeps = 200;
    Ok(answer(problem, row_by_row(problem, start, sweeps, |impulse, _| impulse[0] = impulse[0].max(0.0)), sweeps))
}

fn shift_ignored(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let plain = problem.clone().into_builder().shift(DVector::zeros(problem.rows())).build()?;
    Auto.solve(&plain, Some(start))
}

fn convex_relaxation(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let law = if problem.law() == Law::Coulomb { Law::Associated } else { problem.law() };
    let convex = problem.clone().into_builder().law(law).build()?;
    Auto.solve(&convex, Some(start))
}

fn velocity_as_wished(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let mut solution = Auto.solve(problem, Some(start))?;
    for normal in (0..problem.rows()).step_by(problem.rows_per_contact()) {
        solution.velocity[normal] = solution.velocity[normal].max(-problem.shift()[normal]);
    }
    Ok(solution)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Level;
    use crate::planted::judge;
    use crate::{Verdict, checks};

    /// The other side of the boundary: with a tenth of what the planted solver leaves, every question about motion is answered as the ideal
    /// demands.
    #[test]
    fn a_solver_that_leaves_a_ten_thousandth_passes_where_one_that_leaves_a_thousandth_fails() {
        let engine = || with_solver(|| Box::new(Answers(|problem, start| left_over(problem, start, 1e-4))));
        let careful = Planted { name: "a ten-thousandth left", mistake: "", engine, caught_by: UNSOLVED };
        let families = ["rest", "stack", "incline", "contact", "metamorphic", "isotropy", "rolling", "energy"];
        let asked = |check: &&crate::Check| check.level == Level::Simulate && families.contains(&check.family());
        let checks: Vec<_> = checks::all().filter(asked).collect();
        let report = judge(&careful, &checks).expect("an engine");
        for outcome in &report.checks {
            assert_eq!(outcome.verdict, Verdict::Pass, "{} {:?}", outcome.check, outcome.reason);
        }
    }
}
