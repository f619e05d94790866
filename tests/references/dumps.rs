//! One step of an engine, solved again: our solvers agree with each other, and the certificate says how far the engine got.
//!
//! # What the engine's stopping rule allows
//! A primal solver (MuJoCo's Newton and CG, Drake's SAP) stops at velocities v with a gradient g = M(v − v_free) − Hᵀr(v). Its
//! impulses satisfy the law with Hv instead of Wr + u_free, and the two differ by HM⁻¹g, so the natural map of r is at most
//! ρ‖EᵀHM⁻¹‖‖g‖. With ‖g‖ at the engine's own limit this is the threshold between *converged* and not (`tolerance::references`).
//! A dual solver (PGS) has no gradient; it is held against the same threshold.

use crate::convexity::Generators;
use crate::document::{Document, stored};
use crate::{dumps_native, soft_step};
use libtest_mimic::Failed;
use moreau::certificate::{Residuals, residuals};
use moreau::checks::Finding;
use moreau::problem::{ContactProblem, Law, Solution};
use moreau::solvers::{
    AcceleratedProjectedGradient, ClarabelPolished, ContactSolver, GaussConjugateGradient, GaussNewton, LemkePivoting,
    ProjectedGaussSeidel, SemiAnalyticPrimal,
};
use moreau::tolerance::references as tolerance;
use std::path::Path;

/// What was found about one dump.
struct Judgement {
    findings: Vec<Finding>,
    converged: bool,
}

/// Every finding about one dump.
pub fn check(document: &Document) -> Result<Vec<Finding>, Failed> {
    Ok(judge(document)?.findings)
}

/// At least one stored step of this MuJoCo solver is unconverged, and at least one such verdict was needed for the family to mean anything.
pub fn some_unconverged(folder: &Path, solver: &str) -> Result<(), Failed> {
    for file in stored(folder) {
        let document = Document::read(&file)?;
        let of_solver = document.config().split('-').next() == Some(solver);
        if document.schema() == "dump/1" && of_solver && !judge(&document)?.converged {
            return Ok(());
        }
    }
    Err(format!("every stored {solver} step is converged").into())
}

fn judge(document: &Document) -> Result<Judgement, Failed> {
    let problem = ContactProblem::from_json(&document.value["problem"].to_string())?;
    let answer = Solution::from_json(&document.value["answer"].to_string())?;
    let generators = Generators::of(&problem).ok_or("a stored step is compliant, so that its solution is unique")?;
    let mut findings = dumps_native::check(document, &problem)?;
    if document.engine() == "mujoco" {
        findings.extend(soft_step::check(document, &problem)?);
    }
    let (ours, own_error) = solve_again(&problem, &generators, &mut findings)?;
    let theirs = residuals(&problem, &answer)?;
    let threshold = threshold(document, &problem, &answer, &generators)?;
    let converged = theirs.natural_map <= threshold;
    let error = generators.distance(&ours, &answer);
    // both natural maps are themselves known up to the rounding of impulses of this size only
    let known = moreau::tolerance::rounding(problem.rows(), answer.impulse.norm());
    let bound = |natural_map: f64| generators.condition * generators.weigh(natural_map + known) + own_error;
    findings.push(Finding::at_most(
        "the certificate bounds the engine's distance from our solution",
        error,
        bound(theirs.natural_map),
        "kg^½·m/s",
    ));
    if converged {
        findings.push(Finding::at_most("engine against ours, within its stopping tolerance", error, bound(threshold), "kg^½·m/s"));
    } else {
        let reach = threshold / (1.0 + generators.condition);
        findings.push(Finding::at_least("an answer the certificate calls unconverged is one", theirs.natural_map, reach, "N·s"));
    }
    let primal = ["newton", "sap"].contains(&document.config().split('-').next().unwrap_or(""));
    if primal {
        findings.push(Finding::decision("Newton's method ends converged", converged, true));
    }
    if document.config().ends_with("10sweeps") {
        findings.push(Finding::decision("ten sweeps do not converge", converged, false));
    }
    findings.push(control(&problem, &answer, threshold)?);
    Ok(Judgement { findings, converged })
}

/// Solves by every algorithm for the law; each answer is certified and all agree. Returns the first with its own error bound.
fn solve_again(problem: &ContactProblem, generators: &Generators, findings: &mut Vec<Finding>) -> Result<(Solution, f64), Failed> {
    let mut solvers: Vec<Box<dyn ContactSolver>> = match problem.law() {
        Law::PolyhedralAssociated { .. } => vec![Box::new(LemkePivoting), Box::new(ClarabelPolished)],
        _ => vec![
            Box::new(ProjectedGaussSeidel::default()),
            Box::new(AcceleratedProjectedGradient::default()),
            Box::new(ClarabelPolished),
            Box::new(SemiAnalyticPrimal),
        ],
    };
    solvers.push(Box::new(GaussNewton::default()));
    solvers.push(Box::new(GaussConjugateGradient::default()));
    let mut answers: Vec<(Solution, Residuals)> = Vec::new();
    for solver in solvers {
        let answer = solver.solve(problem, None)?;
        let judged = residuals(problem, &answer)?;
        let relative = judged.natural_map / judged.natural_map_scale;
        findings.push(Finding::at_most(format!("{}: relative natural map", solver.name()), relative, tolerance::OUR_SOLVERS, "1"));
        answers.push((answer, judged));
    }
    // a natural map is known up to the rounding of the impulses it is made of
    let error = |judged: &Residuals| {
        let known = moreau::tolerance::rounding(problem.rows(), judged.impulse_scale);
        generators.condition * generators.weigh(judged.natural_map + known)
    };
    let (first, first_judged) = answers.remove(0);
    for (answer, judged) in &answers {
        let allowed = error(judged) + error(&first_judged);
        let name = format!("{} against {}", answer.solver, first.solver);
        findings.push(Finding::at_most(name, generators.distance(answer, &first), allowed, "kg^½·m/s"));
    }
    Ok((first, error(&first_judged)))
}

/// The natural map of an answer whose gradient is just at the engine's limit \[N·s\].
fn threshold(document: &Document, problem: &ContactProblem, answer: &Solution, generators: &Generators) -> Result<f64, Failed> {
    let dynamics = problem.dynamics().ok_or("a stored step gives mass and Jacobian")?;
    let cholesky = dynamics.mass.clone().cholesky().ok_or("the mass is positive definite")?;
    let response = generators.generators.tr_mul(&dynamics.jacobian) * cholesky.inverse();
    let gradient = match document.engine() {
        "mujoco" => {
            let [option, h] = [document.number(&["native", "tolerance"])?, document.number(&["native", "time_step"])?];
            let pushed = dynamics.jacobian.tr_mul(&answer.impulse).norm();
            let rounded = moreau::tolerance::rounding(problem.rows() * dynamics.mass.ncols(), pushed);
            let left = tolerance::mujoco_gradient(option, &dynamics.mass) * h;
            // where the limit of the gradient is below its rounding, the other rule, that of the cost, has stopped the engine
            let by_cost = tolerance::last_improvement(option, problem.rows() as f64, dynamics.mass.trace());
            if left > rounded { left } else { by_cost * dynamics.mass.diagonal().max().sqrt() * h + rounded }
        }
        _ => {
            let momentum = &dynamics.mass * document.vector(&["native", "v_next"])?;
            tolerance::sap_gradient(&dynamics.mass, &momentum, &dynamics.jacobian.tr_mul(&answer.impulse))
        }
    };
    Ok(generators.largest_scale() * response.norm() * gradient)
}

/// The engine's answer with a tenth more normal impulse at its first loaded contact must not pass.
fn control(problem: &ContactProblem, answer: &Solution, threshold: f64) -> Result<Finding, Failed> {
    let rows = problem.rows_per_contact();
    let loaded = (0..problem.contacts()).find(|k| answer.impulse[rows * k] > 0.0).ok_or("a stored step has a loaded contact")?;
    let mut wrong = answer.clone();
    wrong.impulse[rows * loaded] *= 1.1;
    if let (Some(beta), Some(directions)) = (&mut wrong.beta, problem.law().directions()) {
        (0..directions).for_each(|j| beta[directions * loaded + j] *= 1.1);
    }
    let passes = residuals(problem, &wrong)?.natural_map <= threshold;
    Ok(Finding::decision("control: a tenth more impulse at one contact is not converged", passes, false))
}
