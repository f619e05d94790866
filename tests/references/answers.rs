//! A solver's stored answer to a contact problem (`answer/1`): our algorithms find the same velocities, and the certificate accepts it.

use crate::document::{Document, VERSIONS};
use libtest_mimic::Failed;
use moreau::certificate::residuals;
use moreau::checks::Finding;
use moreau::problem::{ContactProblem, Law, Solution};
use moreau::solvers::{AcceleratedProjectedGradient, AlternatingDirections, BarzilaiBorwein, ClarabelPolished};
use moreau::solvers::{ContactSolver, ProjectedGaussSeidel, ProjectedOverRelaxation};
use moreau::tolerance::cli::CERTIFY;
use moreau::tolerance::references as tolerance;

/// Every finding about one stored answer.
pub fn check(document: &Document) -> Result<Vec<Finding>, Failed> {
    let problem = ContactProblem::from_json(&document.value["problem"].to_string())?;
    let answer = Solution::from_json(&document.value["answer"].to_string())?;
    let mut findings = provenance(document, &problem);
    let accepted = residuals(&problem, &answer)?.is_solution(CERTIFY);
    findings.push(Finding::decision("the certificate accepts the engine's answer", accepted, true));
    for solver in solvers(problem.law()) {
        let ours = solver.solve(&problem, None)?;
        let relative = residuals(&problem, &ours)?;
        findings.push(Finding::at_most(
            format!("{}: relative natural map", solver.name()),
            relative.natural_map / relative.natural_map_scale,
            tolerance::OUR_SOLVERS,
            "1",
        ));
        findings.push(Finding::at_most(
            format!("{} against the engine", solver.name()),
            (&ours.velocity - &answer.velocity).amax(),
            tolerance::SAME_VELOCITY,
            "m/s",
        ));
    }
    findings.push(control(&problem, &answer)?);
    Ok(findings)
}

/// The algorithms for a law; the first is the engine's own.
fn solvers(law: Law) -> Vec<Box<dyn ContactSolver>> {
    let mut all: Vec<Box<dyn ContactSolver>> = vec![
        Box::new(AlternatingDirections::default()),
        Box::new(ProjectedGaussSeidel::default()),
        Box::new(ProjectedOverRelaxation::default()),
    ];
    if law == Law::Associated {
        all.push(Box::new(AcceleratedProjectedGradient::default()));
        all.push(Box::new(BarzilaiBorwein::default()));
        all.push(Box::new(ClarabelPolished));
    }
    all
}

fn provenance(document: &Document, problem: &ContactProblem) -> Vec<Finding> {
    let stored = |key: &str| document.value["provenance"][key].as_str().unwrap_or("");
    let pinned = VERSIONS.contains(&(document.engine(), stored("version")));
    vec![
        Finding::decision("the engine's version is the pinned one", pinned, true),
        Finding::decision("the file is named after its problem", document.name == format!("{}.json", problem.name()), true),
    ]
}

/// The engine's answer with a tenth more normal impulse at its first loaded contact is none.
fn control(problem: &ContactProblem, answer: &Solution) -> Result<Finding, Failed> {
    let rows = problem.rows_per_contact();
    let loaded = (0..problem.contacts()).find(|k| answer.impulse[rows * k] > 0.0).ok_or("a stored answer has a loaded contact")?;
    let mut wrong = answer.clone();
    wrong.impulse[rows * loaded] *= 1.1;
    wrong.velocity = problem.velocity(&wrong.impulse);
    let passes = residuals(problem, &wrong)?.is_solution(CERTIFY);
    Ok(Finding::decision("control: a tenth more impulse at one contact is an answer", passes, false))
}
