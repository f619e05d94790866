//! How much work iterations need at the collection's problems: passes through W, which are the same on every machine.
//!
//! Iterations that factorise nothing are compared alone. A pass is W r for one r, or a sweep over all contacts; the rounding floors of the
//! certificate, found anew now and then, and the gradients' first estimate of a step read W as well and are not counted. An
//! answer counts with all its passes, those that measured its residual too, and only where the certificate accepts it.

use super::{ALL, Known};
use crate::error::Failure;
use crate::problem::{ContactProblem, Law};
use crate::tolerance::cli::{ASKED_SHARE, CERTIFY};
use crate::{Error, Result};
use moreau_contact::certificate::residuals;
use moreau_contact::operator::passes::counted;
use moreau_contact::solvers::{
    AcceleratedProjectedGradient, BarzilaiBorwein, ContactSolver, ProjectedGaussSeidel, ProjectedOverRelaxation,
};
use moreau_contact::tolerance::solvers::SYMMETRY;
use rayon::prelude::*;

/// Iterations that are allowed: one that needs more counts as one without an answer.
const MOST: usize = 500;

/// The passes of some iterations at the problems of some laws.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The laws, in a few English words.
    pub laws: &'static str,
    /// The iterations.
    pub solvers: Vec<&'static str>,
    /// Problem by problem, in the order of the collection: the passes of every iteration, ∞ where it has no answer.
    pub passes: Vec<Vec<f64>>,
}

/// Laws under which the same iterations are asked: problems that all of them take.
struct Group {
    laws: &'static str,
    is_of: fn(Law) -> bool,
    /// How many of [`iterations`], from the first.
    asked: usize,
}

const GROUPS: [Group; 2] = [
    Group { laws: "Coulomb", is_of: |law| law == Law::Coulomb, asked: 3 },
    Group { laws: "convex laws", is_of: |law| matches!(law, Law::Associated | Law::Frictionless), asked: 5 },
];

/// Sweeps, for any of these laws; then gradients, for convex ones.
fn iterations() -> [(&'static str, Box<dyn ContactSolver>); 5] {
    let tolerance = ASKED_SHARE * CERTIFY;
    [
        ("pgs", Box::new(ProjectedGaussSeidel { sweeps: MOST, tolerance, memory: 0 })),
        ("pgs, Anderson", Box::new(ProjectedGaussSeidel { sweeps: MOST, tolerance, ..ProjectedGaussSeidel::accelerated() })),
        ("psor", Box::new(ProjectedOverRelaxation { sweeps: MOST, tolerance, ..Default::default() })),
        ("apgd", Box::new(AcceleratedProjectedGradient { iterations: MOST, tolerance, ..Default::default() })),
        ("bb", Box::new(BarzilaiBorwein { iterations: MOST, tolerance })),
    ]
}

/// The passes at every problem that the program holds, law by law.
///
/// # Errors
/// If a stored problem cannot be read, which a test excludes.
/// ```no_run
/// let tables = moreau::problems::work::tables()?;
/// assert_eq!(tables[0].solvers, ["pgs", "pgs, Anderson", "psor"]);
/// # Ok::<(), moreau::Error>(())
/// ```
pub fn tables() -> Result<Vec<Table>> {
    let mut problems = Vec::new();
    for stored in ALL.iter().filter(|stored| stored.problem.is_some()) {
        // where there is no solution, no answer is the right one
        if stored.record()?.uniqueness.velocity != Known::None {
            problems.push(stored.problem()?);
        }
    }
    GROUPS.iter().map(|group| table(group, &problems)).collect()
}

fn table(group: &Group, problems: &[ContactProblem]) -> Result<Table> {
    let all = iterations();
    let asked = &all[..group.asked];
    let takes = |problem: &ContactProblem| {
        let (rows, symmetric) = (problem.rows_per_contact(), problem.asymmetry() <= SYMMETRY);
        (group.is_of)(problem.law()) && asked.iter().all(|(_, solver)| solver.takes(problem.law(), rows, symmetric))
    };
    let of: Vec<&ContactProblem> = problems.iter().filter(|problem| takes(problem)).collect();
    let row = |problem: &&ContactProblem| {
        let all = iterations();
        all[..group.asked].iter().map(|(_, solver)| passes(problem, solver.as_ref())).collect::<Result<Option<Vec<f64>>>>()
    };
    let rows: Vec<Option<Vec<f64>>> = of.par_iter().map(row).collect::<Result<_>>()?;
    let passes = rows.into_iter().flatten().collect();
    Ok(Table { laws: group.laws, solvers: asked.iter().map(|(name, _)| *name).collect(), passes })
}

/// How often an iteration goes through W until its answer is accepted; ∞ if it has none, nothing where it does not take the problem.
fn passes(problem: &ContactProblem, solver: &dyn ContactSolver) -> Result<Option<f64>> {
    let (answer, passes) = counted(|| solver.solve(problem, None));
    let answer = match answer {
        Ok(answer) => answer,
        Err(Error::Solver { failure: Failure::Refused, .. }) => return Ok(None),
        Err(_) => return Ok(Some(f64::INFINITY)),
    };
    let is_accepted = residuals(problem, &answer)?.is_solution(CERTIFY);
    Ok(Some(if is_accepted { passes as f64 } else { f64::INFINITY }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_repeat_and_every_group_has_answers_of_every_iteration() {
        let tables = tables().expect("readable");
        assert_eq!(tables, super::tables().expect("readable"));
        for table in &tables {
            assert!(table.passes.len() >= 20, "{}: {}", table.laws, table.passes.len());
            for (k, name) in table.solvers.iter().enumerate() {
                let answered = table.passes.iter().filter(|row| row[k].is_finite()).count();
                assert!(answered > 0, "{name} answers {answered} of {} under {}", table.passes.len(), table.laws);
            }
        }
        // no counter stands still: a problem of one contact under pgs takes a sweep, a look at it and u of the answer
        let single = passes(&ALL[0].problem().expect("stored"), iterations()[0].1.as_ref()).expect("readable").expect("taken");
        assert!((2.0..=6.0).contains(&single), "{single}");
    }
}
