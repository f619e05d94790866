//! Planted mistakes in the certificate of an answer: what it reads of the problem and of the answer, and which of its clauses it asks.

use crate::answers::{Accepts, accepts, exact_answers, near_misses};
use crate::planted::{Family, Kind, Planted};
use moreau_contact::certificate::{Residuals, residuals};
use moreau_contact::cones::second_order::project;
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// Certificates, held against exact answers and near misses.
pub static CERTIFICATES: Family<Accepts> = Family {
    reference: accepts,
    checks: &[("certificate/exact-answers", exact_answers), ("certificate/near-misses", near_misses)],
    planted: &[
        planted("certificate/primal-dropped", "does not ask whether r is in the cone", |p, s| without(p, s, "primal")),
        planted("certificate/normal-dropped", "asks for r_n y_n = 0 and no more: both may be small without either being zero", |p, s| {
            without(p, s, "normal")
        }),
        planted(
            "certificate/tangential-dropped",
            "asks how much energy friction takes, not where it points: a turn by δ costs δ²",
            |p, s| without(p, s, "tangential"),
        ),
        planted("certificate/velocity-dropped", "does not compare the velocity that is told with the one the impulses give", |p, s| {
            without(p, s, "velocity")
        }),
        planted("certificate/one-clause-is-enough", "accepts an answer if any of its residuals is small, where all must be", one_is_enough),
        planted("certificate/not-a-number-passes", "refuses what exceeds the limit, so that what is not a number is accepted", nan_passes),
        planted("certificate/absolute-limit", "holds residuals against the tolerance itself, in whatever unit they have", absolute),
        planted("certificate/one-scale-for-all", "holds the norm over all contacts against one scale, the heaviest contact's", norm_of_all),
        planted("certificate/accepts-everything", "takes the solver's word for it", |_, _| Ok(true)),
        planted("certificate/shift-forgotten", "leaves out of y what the scheme adds", |p, s| {
            accepts(&p.clone().into_builder().shift(DVector::zeros(p.rows())).build()?, s)
        }),
        planted("certificate/compliance-forgotten", "leaves R r out of y", |p, s| {
            accepts(&p.clone().into_builder().compliance(None).build()?, s)
        }),
        planted("certificate/associated-for-coulomb", "judges Coulomb's law by its convex relaxation, y in the dual cone", |p, s| {
            accepts(&with_law(p, Law::Coulomb, Law::Associated)?, s)
        }),
        planted("certificate/coulomb-for-associated", "judges the associated law by Coulomb's, which lets the contact close", |p, s| {
            accepts(&with_law(p, Law::Associated, Law::Coulomb)?, s)
        }),
        planted("certificate/round-for-polyhedral", "judges a pyramid by the round cone", |p, s| match p.law() {
            Law::PolyhedralCoulomb { .. } => accepts(&with_law(p, p.law(), Law::Coulomb)?, s),
            _ => accepts(p, s),
        }),
        planted("certificate/friction-forgotten", "judges every contact as a smooth one", |p, s| {
            accepts(&with_law(p, Law::Coulomb, Law::Frictionless)?, s)
        }),
        planted("certificate/friction-of-the-next", "takes μ of the next contact in the list", next_friction),
        planted("certificate/velocity-believed", "computes y from the velocity that is told, not from the impulses", believed),
        planted("certificate/last-contact-not-asked", "ends its loop one contact early", last_left_out),
        planted("certificate/coupling-forgotten", "computes y of a contact from its own impulse alone", alone),
        planted("certificate/impulse-mended-first", "puts r into its cone before it judges it", mended),
        planted("certificate/friction-reversed", "reads friction as what the body does to the ground", reversed),
    ],
};

const fn planted(name: &'static str, mistake: &'static str, subject: Accepts) -> Planted<Accepts> {
    Planted { name, mistake, kind: Kind::Certificate, subject }
}

fn is_finite(residuals: &Residuals) -> bool {
    residuals.norms().iter().all(|(_, norm, _)| norm.is_finite())
}

/// Every clause but one.
fn without(problem: &ContactProblem, solution: &Solution, dropped: &str) -> Result<bool> {
    let residuals = residuals(problem, solution)?;
    let asked = |(name, worst, _): &(&str, moreau_contact::certificate::Worst, &str)| *name == dropped || worst.part.relative() <= CERTIFY;
    Ok(is_finite(&residuals) && residuals.judged.entries().iter().all(asked))
}

fn one_is_enough(problem: &ContactProblem, solution: &Solution) -> Result<bool> {
    let residuals = residuals(problem, solution)?;
    Ok(is_finite(&residuals) && residuals.judged.entries().iter().any(|(_, worst, _)| worst.part.relative() <= CERTIFY))
}

fn nan_passes(problem: &ContactProblem, solution: &Solution) -> Result<bool> {
    let exceeds = residuals(problem, solution)?.judged.relative() > CERTIFY;
    Ok(!exceeds)
}

fn absolute(problem: &ContactProblem, solution: &Solution) -> Result<bool> {
    let residuals = residuals(problem, solution)?;
    Ok(is_finite(&residuals) && residuals.judged.entries().iter().all(|(_, worst, _)| worst.largest <= CERTIFY))
}

fn norm_of_all(problem: &ContactProblem, solution: &Solution) -> Result<bool> {
    let residuals = residuals(problem, solution)?;
    let told = residuals.judged.velocity.part.relative();
    Ok(residuals.natural_map <= CERTIFY * residuals.natural_map_scale && told <= CERTIFY)
}

fn with_law(problem: &ContactProblem, from: Law, to: Law) -> Result<ContactProblem> {
    let law = if problem.law() == from { to } else { problem.law() };
    problem.clone().into_builder().law(law).build()
}

fn next_friction(problem: &ContactProblem, solution: &Solution) -> Result<bool> {
    let mut friction = problem.friction().to_vec();
    friction.rotate_left(1);
    accepts(&problem.clone().into_builder().friction(friction).build()?, solution)
}

/// u_free such that W r + u_free is what is told.
fn believed(problem: &ContactProblem, solution: &Solution) -> Result<bool> {
    let free = &solution.velocity - problem.apply(&solution.impulse);
    if free.iter().any(|u| !u.is_finite()) {
        return Ok(false);
    }
    accepts(&problem.clone().into_builder().free_velocity(free).build()?, solution)
}

/// The problem of all contacts but the last, under its impulse.
fn last_left_out(problem: &ContactProblem, solution: &Solution) -> Result<bool> {
    let rows = problem.rows() - problem.rows_per_contact();
    let given = |vector: &DVector<f64>| vector.rows(0, rows).into_owned();
    let (first, last) = (given(&solution.impulse), solution.impulse.rows_range(rows..).into_owned());
    if rows == 0 || last.iter().any(|r| !r.is_finite()) {
        return accepts(problem, solution);
    }
    let pushed = problem.dense().view((0, rows), (rows, problem.rows_per_contact())) * last;
    let delassus: DMatrix<f64> = problem.dense().view((0, 0), (rows, rows)).into_owned();
    let shorter = ContactProblem::new(delassus, given(problem.free_velocity()) + pushed)
        .law(problem.law())
        .rows_per_contact(problem.rows_per_contact())
        .friction(problem.friction()[..problem.contacts() - 1].to_vec())
        .shift(given(problem.shift()))
        .build()?;
    accepts(&shorter, &Solution::new(solution.solver.clone(), first, given(&solution.velocity), solution.iterations))
}

fn alone(problem: &ContactProblem, solution: &Solution) -> Result<bool> {
    let rows = problem.rows_per_contact();
    let own = |i: usize, j: usize| if i / rows == j / rows { problem.entry(i, j) } else { 0.0 };
    let delassus = DMatrix::from_fn(problem.rows(), problem.rows(), own);
    accepts(&problem.clone().into_builder().dynamics(None).delassus(delassus).build()?, solution)
}

fn mended(problem: &ContactProblem, solution: &Solution) -> Result<bool> {
    let mut solution = solution.clone();
    let rows = problem.rows_per_contact();
    for (impulse, mu) in solution.impulse.as_mut_slice().chunks_mut(rows).zip(problem.friction()) {
        project(impulse, problem.law().cone_friction(*mu));
    }
    solution.velocity = problem.velocity(&solution.impulse);
    accepts(problem, &solution)
}

fn reversed(problem: &ContactProblem, solution: &Solution) -> Result<bool> {
    let mut solution = solution.clone();
    let rows = problem.rows_per_contact();
    let tangential = solution.impulse.iter_mut().enumerate().filter(|(i, _)| i % rows != 0);
    tangential.for_each(|(_, r)| *r = -*r);
    solution.velocity = problem.velocity(&solution.impulse);
    accepts(problem, &solution)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::finding::Finding;

    #[test]
    fn the_certificate_accepts_every_exact_answer_and_no_changed_one() {
        for (name, check) in CERTIFICATES.checks {
            let findings = check(&CERTIFICATES.reference).expect("judged");
            let failing: Vec<_> = findings.iter().filter(|finding| !finding.holds()).collect();
            assert!(failing.is_empty() && !findings.is_empty(), "{name}: {failing:?}");
        }
    }

    /// What each clause alone refuses: without it, one kind of change is accepted and every exact answer still is.
    #[test]
    fn each_dropped_clause_lets_its_own_change_pass() {
        for (planted, change) in [("primal", "Strengthen"), ("normal", "Push"), ("tangential", "Turn"), ("velocity", "Told")] {
            let name = format!("certificate/{planted}-dropped");
            let subject = CERTIFICATES.planted.iter().find(|planted| planted.name == name).expect("planted").subject;
            assert!(exact_answers(&subject).expect("judged").iter().all(Finding::holds));
            let missed: Vec<_> = near_misses(&subject).expect("judged").into_iter().filter(|finding| !finding.holds()).collect();
            assert!(missed.iter().any(|finding| finding.name.starts_with(change)), "{name}: {missed:?}");
        }
    }
}
