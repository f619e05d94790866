//! Contact problems that are linear complementarity problems, solved by lexicographic Lemke.
//!
//! ```text
//!     0 ≤ z ⟂ M z + q ≥ 0 ,   r = G z
//! ```

use super::lemke::{LemkeOutcome, lemke};
use super::linear_form::{Form, Scaled};
use super::{ContactSolver, NonsmoothNewton};
use crate::certificate::Judge;
use crate::problem::{ContactProblem, Coordinates, Law, Solution};
use crate::tolerance::solvers::{ENOUGH, SOFTENED};
use moreau_exact::error::Failure;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Lexicographic Lemke on the laws that are LCPs; any W, symmetric or not, singular or not.
///
/// Several covering vectors are tried until an answer meets the problem to rounding. If rounding ends the path of every one of them, the
/// problem made a little softer, M + 2⁻³⁴ 1 in units of the problem, leads to an answer, which is taken only if it meets the problem
/// itself.
///
/// A secondary ray is an error: for a problem without the hypotheses of the existence theorem it leaves open whether a
/// solution exists.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LemkePivoting;

const NAME: &str = "lemke";

impl ContactSolver for LemkePivoting {
    fn name(&self) -> &'static str {
        NAME
    }

    fn takes_start(&self) -> bool {
        false
    }

    fn takes(&self, law: Law, rows: usize, _symmetric: bool) -> bool {
        rows <= 2 || !matches!(law, Law::Coulomb | Law::Associated)
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let form = Form::of(problem, NAME)?;
        // pivoting starts from nothing, but impulses of another problem are a mistake here too
        super::start_of_use(problem, warm_start)?;
        let lcp = form.scaled(problem, &form.lcp(problem, NAME)?);
        let (mut judge, mut best, mut failure) = (Judge::default(), None::<(f64, Solution)>, None);
        for covering in lcp.coverings() {
            match lcp.solve(&covering) {
                Ok(end) => keep_better(&mut best, best_of(form, problem, end, &mut judge)?),
                Err(error) => failure = Some(failure.filter(|first| !is_ray(first)).unwrap_or(error)),
            }
            if best.as_ref().is_some_and(is_enough) {
                break;
            }
        }
        if best.is_none() && failure.as_ref().is_some_and(|error| !is_ray(error)) {
            // rounding ended every path: on a problem a little softer no basis is as close to a singular one
            if let Ok(end) = lcp.softened().solve(&lcp.coverings()[0]) {
                best = Some(best_of(form, problem, end, &mut judge)?).filter(is_enough);
            }
        }
        match (best, failure) {
            (Some((_, solution)), _) => super::finite(solution),
            (None, failure) => Err(failure.expect("every covering vector that gives no answer leaves a failure")),
        }
    }
}

/// Whether an answer's relative residual is small enough to stop at.
fn is_enough((relative, _): &(f64, Solution)) -> bool {
    *relative <= ENOUGH
}

fn keep_better(best: &mut Option<(f64, Solution)>, answer: (f64, Solution)) {
    if best.as_ref().is_none_or(|(least, _)| answer.0 < *least) {
        *best = Some(answer);
    }
}

impl LemkePivoting {
    /// Whether the law of this problem is an LCP.
    pub fn fits(problem: &ContactProblem) -> bool {
        Form::of(problem, NAME).is_ok()
    }
}

/// The answer at the end of a path, or Newton's from there, whichever has the smaller relative residual.
fn best_of(form: Form, problem: &ContactProblem, (z, pivots): (DVector<f64>, usize), judge: &mut Judge) -> Result<(f64, Solution)> {
    let answer = form.solution(problem, &z, NAME, pivots);
    let relative = judge.look(problem, &answer)?.relative();
    if relative <= ENOUGH {
        return Ok((relative, answer));
    }
    let Ok(finished) = finished(form, problem, &answer) else { return Ok((relative, answer)) };
    let finer = judge.look(problem, &finished)?.relative();
    Ok(if finer < relative { (finer, finished) } else { (relative, answer) })
}

/// Nonsmooth Newton from the answer: pivoting leaves errors of the size of the whole problem at contacts that carry little.
fn finished(form: Form, problem: &ContactProblem, answer: &Solution) -> Result<Solution> {
    if problem.compliance().is_some_and(|compliance| compliance.coordinates == Coordinates::Edge) {
        return Ok(answer.clone());
    }
    let finished = NonsmoothNewton::default().solve(problem, Some(&answer.impulse))?;
    let (beta, sigma) = form.parts(problem, &finished);
    Ok(Solution { beta, sigma, solver: NAME.into(), iterations: answer.iterations + finished.iterations, ..finished })
}

impl Scaled {
    /// The theorem holds for every positive covering vector; a basis that rounding spoils on one path is not on the others. A problem
    /// without the hypotheses may have a solution at the end of one path and a ray at the end of another.
    fn coverings(&self) -> [DVector<f64>; 5] {
        let n = self.lcp.size();
        let rising = DVector::from_fn(n, |i, _| 1.0 + i as f64 / n as f64);
        let falling = rising.map(|d: f64| 3.0 - d);
        let alternating = DVector::from_fn(n, |i, _| if i % 2 == 0 { 1.0 } else { 2.0 });
        let opposite = alternating.map(|d: f64| 3.0 - d);
        [DVector::from_element(n, 1.0), rising, falling, alternating, opposite]
    }

    /// The same with M + δ 1, δ = [`SOFTENED`]: strictly copositive where M is copositive but for rounding. Its solution misses the rows of
    /// M by δ z, which Newton's method takes away.
    fn softened(&self) -> Scaled {
        let size = self.lcp.size();
        let matrix = &self.lcp.matrix + DMatrix::from_diagonal_element(size, size, SOFTENED);
        self.with_matrix(matrix)
    }

    /// z and the pivots.
    fn solve(&self, covering: &DVector<f64>) -> Result<(DVector<f64>, usize)> {
        match lemke(&self.lcp, covering)? {
            LemkeOutcome::Solution { z, pivots } => Ok((self.unscaled(&z), pivots)),
            LemkeOutcome::Ray { .. } => Err(Error::ray(NAME, SECONDARY_RAY)),
        }
    }
}

fn is_ray(error: &Error) -> bool {
    matches!(error, Error::Solver { failure: Failure::Ray, .. })
}

const SECONDARY_RAY: &str = "the LCP ended on a secondary ray for five covering vectors; it may have no solution";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Compliance;
    use moreau_exact::tolerance::rounding;

    /// A unit point mass with one contact, free velocity (normal, tangents).
    fn point(law: Law, friction: f64, free_velocity: &[f64]) -> ContactProblem {
        let rows = free_velocity.len();
        ContactProblem::new(DMatrix::identity(rows, rows), DVector::from_row_slice(free_velocity))
            .name("point")
            .law(law)
            .rows_per_contact(rows)
            .friction(vec![friction])
            .build()
            .unwrap()
    }

    fn assert_close(actual: &DVector<f64>, expected: &[f64]) {
        let error = (actual - DVector::from_row_slice(expected)).amax();
        assert!(error <= rounding(20, 10.0), "{actual} is not {expected:?}");
    }

    #[test]
    fn a_sliding_point_gets_friction_mu_times_the_normal_impulse_and_sigma_is_its_speed() {
        for law in [Law::Coulomb, Law::PolyhedralCoulomb { directions: 2 }] {
            let solution = LemkePivoting.solve(&point(law, 0.5, &[-1.0, 2.0]), None).unwrap();
            assert_close(&solution.impulse, &[1.0, -0.5]);
            assert_close(&solution.velocity, &[0.0, 1.5]);
            assert_close(&solution.sigma.unwrap(), &[1.5]);
        }
    }

    #[test]
    fn a_sticking_point_stops_and_sigma_is_zero() {
        let solution = LemkePivoting.solve(&point(Law::PolyhedralCoulomb { directions: 4 }, 0.5, &[-1.0, 0.25, -0.125]), None).unwrap();
        assert_close(&solution.velocity, &[0.0, 0.0, 0.0]);
        assert_close(&solution.sigma.unwrap(), &[0.0]);
    }

    #[test]
    fn the_associated_law_lifts_a_sliding_point_by_mu_times_its_speed() {
        for law in [Law::Associated, Law::PolyhedralAssociated { directions: 2 }] {
            let velocity = LemkePivoting.solve(&point(law, 0.5, &[-1.0, 2.0]), None).unwrap().velocity;
            assert_close(&velocity, &[0.5 * velocity[1], velocity[1]]);
            assert!(velocity[1] > 0.0);
        }
    }

    #[test]
    fn edge_compliance_softens_every_edge() {
        let compliance = Compliance { coordinates: Coordinates::Edge, diagonal: DVector::from_element(2, 1.0) };
        let hard = point(Law::PolyhedralAssociated { directions: 2 }, 0.5, &[-1.0, 0.0]);
        let problem = hard.into_builder().compliance(compliance).build().unwrap();
        // By symmetry f₁ = f₂ = f with (1 + 1/4) f + (1 − 1/4) f + f = 1.
        let solution = LemkePivoting.solve(&problem, None).unwrap();
        assert_close(&solution.beta.unwrap(), &[1.0 / 3.0, 1.0 / 3.0]);
        assert_close(&solution.impulse, &[2.0 / 3.0, 0.0]);
    }

    #[test]
    fn contact_compliance_softens_the_normal() {
        let compliance = Compliance { coordinates: Coordinates::Contact, diagonal: DVector::from_element(1, 1.0) };
        let problem = point(Law::Frictionless, 0.0, &[-1.0]).into_builder().compliance(compliance).build().unwrap();
        assert_close(&LemkePivoting.solve(&problem, None).unwrap().impulse, &[0.5]);
    }

    #[test]
    fn an_asymmetric_delassus_operator_is_solved_as_given() {
        let problem = ContactProblem::new(DMatrix::from_row_slice(2, 2, &[2.0, 1.0, -1.0, 1.0]), DVector::from_row_slice(&[-1.0, 0.0]));
        let problem = problem.law(Law::Frictionless).rows_per_contact(1).build().unwrap();
        assert_close(&LemkePivoting.solve(&problem, None).unwrap().impulse, &[1.0 / 3.0, 1.0 / 3.0]);
    }

    #[test]
    fn curved_cones_are_refused_by_name_and_a_ray_is_an_error() {
        let refused = LemkePivoting.solve(&point(Law::Coulomb, 0.5, &[-1.0, 1.0, 0.0]), None).unwrap_err().to_string();
        assert!(refused.contains("`lemke`") && refused.contains("`coulomb`"), "{refused}");
        let impossible = point(Law::Frictionless, 0.0, &[-1.0]).into_builder().delassus(DMatrix::zeros(1, 1)).build().unwrap();
        let ray = LemkePivoting.solve(&impossible, None).unwrap_err().to_string();
        assert!(ray.contains("secondary ray"), "{ray}");
    }

    #[test]
    fn a_problem_without_contacts_has_the_empty_solution() {
        let empty = ContactProblem::new(DMatrix::zeros(0, 0), DVector::zeros(0))
            .name("empty")
            .law(Law::PolyhedralCoulomb { directions: 4 })
            .friction(Vec::new())
            .build()
            .unwrap();
        assert_eq!(LemkePivoting.solve(&empty, None).unwrap().impulse.len(), 0);
    }
}
