//! Contact problems that are linear complementarity problems, solved by lexicographic Lemke.
//!
//! ```text
//!     0 ≤ z ⟂ M z + q ≥ 0 ,   r = G z  (G z without σ)
//!     normal rows       frictionless               M = W_nn + R_nn
//!     Stewart–Trinkle   polyhedral Coulomb         z = (λ, β, σ); Coulomb in the plane with d = 2
//!     edges             polyhedral associated      M = Gᵀ(W + R)G + R_edge, columns n + μ Dⱼ; associated in the plane
//! ```

use super::lemke::{LemkeOutcome, lemke};
use super::{ContactSolver, NonsmoothNewton};
use crate::certificate::Judge;
use crate::cones::polyhedral;
use crate::problem::{Compliance, ContactProblem, Coordinates, Law, Lcp, Solution};
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

    fn takes(&self, law: Law, rows: usize, _symmetric: bool) -> bool {
        rows <= 2 || !matches!(law, Law::Coulomb | Law::Associated)
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let form = Form::of(problem)?;
        // pivoting starts from nothing, but impulses of another problem are a mistake here too
        super::start(problem, warm_start)?;
        let lcp = Scaled::new(&form.lcp(problem)?, form.scale(problem));
        let (mut judge, mut best, mut failure) = (Judge::default(), None::<(f64, Solution)>, None);
        for covering in lcp.coverings() {
            match lcp.solve(&covering) {
                Ok(end) => keep_better(&mut best, form.best(problem, end, &mut judge)?),
                Err(error) => failure = Some(failure.filter(|first| !is_ray(first)).unwrap_or(error)),
            }
            if best.as_ref().is_some_and(is_enough) {
                break;
            }
        }
        if best.is_none() && failure.as_ref().is_some_and(|error| !is_ray(error)) {
            // rounding ended every path: on a problem a little softer no basis is as close to a singular one
            if let Ok(end) = lcp.softened().solve(&lcp.coverings()[0]) {
                best = Some(form.best(problem, end, &mut judge)?).filter(is_enough);
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
        Form::of(problem).is_ok()
    }
}

/// Which LCP a contact problem is.
#[derive(Clone, Copy)]
enum Form {
    Normals,
    StewartTrinkle { directions: usize },
    Edges { directions: usize },
}

impl Form {
    fn of(problem: &ContactProblem) -> Result<Form> {
        let without_friction = problem.friction().iter().all(|mu| *mu == 0.0);
        match (problem.law(), problem.rows_per_contact()) {
            (Law::Frictionless, _) => Ok(Form::Normals),
            (Law::Coulomb | Law::Associated, _) if without_friction => Ok(Form::Normals),
            (Law::PolyhedralCoulomb { directions }, _) => Ok(Form::StewartTrinkle { directions }),
            (Law::Coulomb, 2) => Ok(Form::StewartTrinkle { directions: 2 }),
            (Law::PolyhedralAssociated { directions }, _) => Ok(Form::Edges { directions }),
            (Law::Associated, 2) => Ok(Form::Edges { directions: 2 }),
            (law, _) => {
                let reason = format!(
                    "the law `{}` in three dimensions is not linear; use `polyhedral-coulomb` or `polyhedral-associated`",
                    law.name()
                );
                Err(Error::refused(NAME, reason))
            }
        }
    }

    /// G: unknown impulses ↦ r.
    fn generators(self, problem: &ContactProblem) -> DMatrix<f64> {
        let (contacts, rows) = (problem.contacts(), problem.rows_per_contact());
        match self {
            Form::Normals => DMatrix::from_fn(contacts * rows, contacts, |i, j| if i == rows * j { 1.0 } else { 0.0 }),
            Form::StewartTrinkle { directions } => problem.stewart_trinkle_generators(directions),
            Form::Edges { directions } => DMatrix::from_fn(contacts * rows, contacts * directions, |i, j| {
                let contact = j / directions;
                let edge = polyhedral::edge(j % directions, directions, problem.friction()[contact]);
                if i / rows == contact { edge[i % rows] } else { 0.0 }
            }),
        }
    }

    fn lcp(self, problem: &ContactProblem) -> Result<Lcp<f64>> {
        if let Form::StewartTrinkle { .. } = self {
            return problem.stewart_trinkle_lcp();
        }
        let generators = self.generators(problem);
        let mut matrix = generators.tr_mul(&(problem.law_delassus()? * &generators));
        if let Some(Compliance { coordinates: Coordinates::Edge, diagonal }) = problem.compliance() {
            matrix += DMatrix::from_diagonal(diagonal);
        }
        Ok(Lcp::new(matrix, generators.tr_mul(&(problem.free_velocity() + problem.shift()))))
    }

    /// S with z = S z′: per contact s = (mean diagonal of W)^(−½) for impulses and 1/s for slip speeds, which makes
    /// S M S dimensionless with entries of order one and leaves the blocks E and −Eᵀ alone.
    fn scale(self, problem: &ContactProblem) -> DVector<f64> {
        let rows = problem.rows_per_contact();
        let contact_scale = |contact: usize| {
            let mean = (rows * contact..rows * (contact + 1)).map(|i| problem.entry(i, i)).sum::<f64>() / rows as f64;
            if mean > 0.0 { 1.0 / mean.sqrt() } else { 1.0 }
        };
        let scales: Vec<f64> = (0..problem.contacts()).map(contact_scale).collect();
        let repeated = |times: usize| scales.iter().flat_map(move |&s| std::iter::repeat_n(s, times));
        let list: Vec<f64> = match self {
            Form::Normals => scales.clone(),
            Form::StewartTrinkle { directions } => {
                repeated(1).chain(repeated(directions)).chain(scales.iter().map(|s| s.recip())).collect()
            }
            Form::Edges { directions } => repeated(directions).collect(),
        };
        DVector::from_vec(list)
    }

    /// The answer at the end of a path, or Newton's from there, whichever has the smaller relative residual.
    fn best(self, problem: &ContactProblem, (z, pivots): (DVector<f64>, usize), judge: &mut Judge) -> Result<(f64, Solution)> {
        let answer = self.solution(problem, &z, pivots);
        let relative = judge.judge(problem, &answer)?.relative();
        if relative <= ENOUGH {
            return Ok((relative, answer));
        }
        let Ok(finished) = self.finished(problem, &answer) else { return Ok((relative, answer)) };
        let finer = judge.judge(problem, &finished)?.relative();
        Ok(if finer < relative { (finer, finished) } else { (relative, answer) })
    }

    /// Nonsmooth Newton from the answer: pivoting leaves errors of the size of the whole problem at contacts that carry little.
    fn finished(self, problem: &ContactProblem, answer: &Solution) -> Result<Solution> {
        if problem.compliance().is_some_and(|compliance| compliance.coordinates == Coordinates::Edge) {
            return Ok(answer.clone());
        }
        let finished = NonsmoothNewton::default().solve(problem, Some(&answer.impulse))?;
        let (beta, sigma) = self.parts(problem, &finished);
        Ok(Solution { beta, sigma, solver: NAME.into(), iterations: answer.iterations + finished.iterations, ..finished })
    }

    /// β or f, and σ, of an answer's impulses: the parts with the smallest sum and the least σ ≥ 0 with Dⱼ·y_t + σ ≥ 0.
    fn parts(self, problem: &ContactProblem, answer: &Solution) -> (Option<DVector<f64>>, Option<DVector<f64>>) {
        let rows = problem.rows_per_contact();
        let contacts = answer.impulse.as_slice().chunks_exact(rows).zip(problem.friction());
        let tangent = |z: &[f64]| [z[1], z.get(2).copied().unwrap_or(0.0)];
        match self {
            Form::Normals => (None, None),
            Form::Edges { directions } => {
                let edges = contacts.flat_map(|(r, mu)| {
                    let mut edges = Vec::with_capacity(directions);
                    polyhedral::along_edges(r, *mu, directions, &mut edges);
                    edges
                });
                (Some(DVector::from_vec(edges.collect())), None)
            }
            Form::StewartTrinkle { directions } => {
                let slip = |y: &[f64]| {
                    let against = |j: usize| -polyhedral::direction(j, directions).iter().zip(tangent(y)).map(|(d, y)| d * y).sum::<f64>();
                    (0..directions).map(against).fold(0.0, f64::max)
                };
                let law_velocity = problem.law_velocity(&answer.impulse);
                let sigma = DVector::from_iterator(problem.contacts(), law_velocity.as_slice().chunks_exact(rows).map(slip));
                let beta = contacts.flat_map(|(r, _)| {
                    let mut beta = Vec::with_capacity(directions);
                    polyhedral::along_neighbours(tangent(r), directions, &mut beta);
                    beta
                });
                (Some(DVector::from_vec(beta.collect())), Some(sigma))
            }
        }
    }

    fn solution(self, problem: &ContactProblem, z: &DVector<f64>, pivots: usize) -> Solution {
        let generators = self.generators(problem);
        let impulse = &generators * z.rows(0, generators.ncols());
        let contacts = problem.contacts();
        let (beta, sigma) = match self {
            Form::Normals => (None, None),
            Form::StewartTrinkle { directions } => (
                Some(z.rows(contacts, contacts * directions).into_owned()),
                Some(z.rows(contacts * (1 + directions), contacts).into_owned()),
            ),
            Form::Edges { .. } => (Some(z.clone()), None),
        };
        Solution { velocity: problem.velocity(&impulse), impulse, beta, sigma, solver: NAME.into(), iterations: pivots }
    }
}

/// 0 ≤ z′ ⟂ S M S z′ + S q/κ ≥ 0 with κ = max |S q|; z = κ S z′.
struct Scaled {
    lcp: Lcp<f64>,
    scale: DVector<f64>,
    size: f64,
}

impl Scaled {
    fn new(lcp: &Lcp<f64>, scale: DVector<f64>) -> Scaled {
        let matrix = DMatrix::from_fn(lcp.size(), lcp.size(), |i, j| scale[i] * lcp.matrix[(i, j)] * scale[j]);
        let vector = lcp.vector.component_mul(&scale);
        let size = vector.iter().fold(0.0, |largest: f64, q| largest.max(q.abs()));
        let size = if size > 0.0 { size } else { 1.0 };
        Scaled { lcp: Lcp::new(matrix, vector / size), scale, size }
    }

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
        Scaled { lcp: Lcp::new(matrix, self.lcp.vector.clone()), scale: self.scale.clone(), size: self.size }
    }

    /// z and the pivots.
    fn solve(&self, covering: &DVector<f64>) -> Result<(DVector<f64>, usize)> {
        match lemke(&self.lcp, covering)? {
            LemkeOutcome::Solution { z, pivots } => Ok((z.component_mul(&self.scale) * self.size, pivots)),
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
