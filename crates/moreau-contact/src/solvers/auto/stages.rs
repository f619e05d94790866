//! The algorithms of [`Auto`](super::Auto) in their order, each with the problems it is for.

#[cfg(feature = "clarabel")]
use super::super::ClarabelPolished;
use super::super::enumeration::LARGEST;
use super::super::watch;
use super::super::{
    AcceleratedProjectedGradient, AlternatingDirections, ContactSolver, ConvexSubproblems, Enumeration, GaussNewton, LemkePivoting,
    NewtonMin, NonsmoothNewton, ParametricPivoting, ProjectedGaussSeidel, ProjectedOverRelaxation, ProximalNewton, compliance,
};
use super::{fewer_contacts, interior, rounds, smoothing, stuck};
use crate::certificate::Judge;
use crate::problem::{Compliance, ContactProblem, Coordinates, Law, Solution};
use crate::tolerance::newton::{PATIENCE, PATIENT_STEPS, PATIENT_WORK, STEPS_IN_AUTO};
use crate::tolerance::solvers::{self as tolerance, ENOUGH};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Whether an algorithm is for a problem.
pub(super) type Takes = fn(&ContactProblem) -> bool;

/// One algorithm of [`Auto`](super::Auto), from the impulses to start from, which stops at this relative residual.
pub(super) type Stage = fn(&ContactProblem, Option<&DVector<f64>>, f64) -> Result<Solution>;

/// The algorithms with the problems they are for, in order, that cost little: they go on until the goal's `enough`.
pub(super) const QUICK: &[(Takes, Stage)] = &[
    (|problem| problem.compliance().is_some(), |problem, start, _| GaussNewton::default().solve(problem, start)),
    (is_direct, |problem, start, _| NewtonMin { steps: tolerance::direct_steps(problem.contacts()) }.solve(problem, start)),
    (|problem| is_direct(problem) && !is_swept_alone(problem), |problem, _, _| LemkePivoting.solve(problem, None)),
    (is_redundant, |problem, _, stop| interior::and_points(problem, stop)),
    (is_iterated, few_sweeps),
    (is_iterated, first_newton),
    (is_stuck, |problem, _, stop| interior::and_newton(problem, stop)),
    (is_stuck, |problem, _, stop| interior::and_points(problem, stop)),
    (is_rubbing, |problem, _, stop| smoothing::solve(problem, None, stop)),
    (is_many_and_free, through_sweeps),
    (|problem| is_large(problem) && !is_stuck(problem), |problem, _, stop| interior::and_newton(problem, stop)),
];

/// What follows where the answer is not good enough yet for the certificate, [`ACCEPTABLE`]; what is goes on to Newton's last steps.
pub(super) const SMOOTHED: &[(Takes, Stage)] = &[
    (is_smoothed_soon, |problem, _, stop| smoothing::briefly(problem, stop)),
    (stuck::fits, |problem, _, stop| stuck::solve(problem, stop)),
];

/// What ends the quick ones, until the goal's `enough`.
pub(super) const ENDING: &[(Takes, Stage)] = &[(is_iterated, newton), (is_principal, principal_pivots)];

/// Those that follow where the answer is not good enough yet for the certificate, [`ACCEPTABLE`].
pub(super) const THOROUGH: &[(Takes, Stage)] = &[
    (|problem| problem.compliance().is_some(), |problem, _, _| GaussNewton::default().solve(problem, None)),
    (is_piled, in_a_round),
    (is_iterated, |problem, _, stop| ProximalNewton { steps: STEPS_IN_AUTO, tolerance: stop, ..Default::default() }.solve(problem, None)),
    (is_smoothed_late, |problem, _, stop| smoothing::solve(problem, None, stop)),
    (has_second_order_cone, patient_points),
    (has_blocks, |problem, _, stop| newton(problem, None, stop)),
    (is_pivoted_soon, |problem, _, _| LemkePivoting.solve(problem, None)),
    (is_swept, more_sweeps),
    (is_swept, newton),
    (is_iterated, |problem, _, stop| newton(problem, None, stop)),
    (is_iterated, through_softness),
    (has_second_order_cone, |problem, start, stop| {
        ProjectedGaussSeidel { sweeps: tolerance::PLAIN_SWEEPS, tolerance: stop, ..Default::default() }.solve(problem, start)
    }),
    (has_second_order_cone, newton),
    (has_second_order_cone, |problem, start, stop| {
        AlternatingDirections { iterations: tolerance::FIRST_ALTERNATIONS, tolerance: stop }.solve(problem, start)
    }),
    (has_second_order_cone, newton),
    (is_pivoted, |problem, _, _| LemkePivoting.solve(problem, None)),
    (|problem| has_second_order_cone(problem) && fewer_contacts::fits(problem), fewer_contacts::solve),
    (is_round, |problem, _, stop| through_polygon(problem, tolerance::LEMKE_DIRECTIONS[0], stop)),
    (is_round, |problem, _, stop| through_polygon(problem, tolerance::LEMKE_DIRECTIONS[1], stop)),
    (has_second_order_cone, |problem, start, stop| AlternatingDirections { tolerance: stop, ..Default::default() }.solve(problem, start)),
    (has_second_order_cone, newton),
    (is_lifted, |problem, _, stop| ConvexSubproblems { tolerance: stop, ..Default::default() }.solve(problem, None)),
    (has_second_order_cone, |problem, start, stop| {
        ProjectedOverRelaxation { sweeps: tolerance::AUTO_SWEEPS, tolerance: stop, ..Default::default() }.solve(problem, start)
    }),
    (
        |problem| problem.rows_per_contact() == 3 && matches!(problem.law(), Law::PolyhedralCoulomb { .. }),
        |problem, start, stop| {
            ProjectedGaussSeidel { sweeps: tolerance::AUTO_SWEEPS, tolerance: stop, ..Default::default() }.solve(problem, start)
        },
    ),
    (
        |problem| problem.law() == Law::Associated,
        |problem, start, stop| AcceleratedProjectedGradient { tolerance: stop, ..Default::default() }.solve(problem, start),
    ),
    #[cfg(feature = "clarabel")]
    (is_convex, |problem, _, _| ClarabelPolished.solve(problem, None)),
    (|problem| is_pivoted_last(problem) && !is_pivoted_soon(problem), |problem, _, _| LemkePivoting.solve(problem, None)),
    (is_enumerated, |problem, _, _| Enumeration.solve(problem, None)),
];

/// Whether it is a linear complementarity problem of a few contacts.
fn is_direct(problem: &ContactProblem) -> bool {
    problem.is_frictionless() && problem.contacts() <= tolerance::DIRECT_CONTACTS && is_iterated(problem)
}

/// Whether it is a linear complementarity problem of more contacts, for which pivots on its principal minors are for sure where W is
/// positive semidefinite.
fn is_principal(problem: &ContactProblem) -> bool {
    problem.is_frictionless() && is_iterated(problem) && problem.contacts() <= tolerance::LEMKE_SOON
}

/// Parametric principal pivoting. What it says of a problem without solution is said with rounding, and is no proof.
fn principal_pivots(problem: &ContactProblem, _: Option<&DVector<f64>>, _: f64) -> Result<Solution> {
    let solver = ParametricPivoting { pivots: tolerance::PIVOTS_OF_A_CONTACT * problem.contacts() };
    solver.solve(problem, None).map_err(|_| Error::breakdown(solver.name(), "ended without a solution"))
}

/// Whether every contact can be solved alone: its normal impulse moves itself.
fn is_swept_alone(problem: &ContactProblem) -> bool {
    let normal = |contact: usize| contact * problem.rows_per_contact();
    (0..problem.contacts()).all(|k| problem.entry(normal(k), normal(k)) + compliance(problem, normal(k)) > 0.0)
}

/// Whether it is a linear complementarity problem with few enough unknowns for all of its complementary cones: as it stands, or with λ, β
/// and σ of friction that may jam, or with the edges of an associated law, which W that is singular or none of bodies may jam as well.
fn is_enumerated(problem: &ContactProblem) -> bool {
    let few = || unknowns(problem, problem.law().directions().unwrap_or(2)) <= LARGEST;
    Enumeration::fits(problem) && (problem.rows_per_contact() == 1 || few())
}

/// Laws of a convex program, the interior point's.
fn is_convex(problem: &ContactProblem) -> bool {
    matches!(problem.law(), Law::Associated | Law::PolyhedralAssociated { .. })
}

/// The algorithms for this problem that the features of this build left out, in words for the answer's solver; empty if none.
pub(super) fn left_out(problem: &ContactProblem) -> &'static str {
    if is_convex(problem) && !cfg!(feature = "clarabel") { " (not tried: clarabel, a feature of moreau-contact)" } else { "" }
}

/// Whether W is stored by blocks, so that a step of Newton's method costs little more than a sweep.
fn has_blocks(problem: &ContactProblem) -> bool {
    is_iterated(problem) && problem.delassus().blocks().is_some()
}

/// A few steps of Newton's method, which end most problems; where they do not, others lead it.
fn first_newton(problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    let steps = if is_smoothed_soon(problem) { tolerance::STEPS_OF_FEW } else { tolerance::SHORT_STEPS };
    NonsmoothNewton { steps, starts: 1, tolerance: stop, ..Default::default() }.solve(problem, start)
}

/// Newton's last steps.
fn short_newton(problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    NonsmoothNewton { steps: tolerance::SHORT_STEPS, starts: 1, tolerance: stop, ..Default::default() }.solve(problem, start)
}

/// Whether interior points are for it, and it has so many more rows than velocities that they cost little where others go astray.
fn is_redundant(problem: &ContactProblem) -> bool {
    problem.contacts() >= tolerance::FEWEST_REDUNDANT && has_many_rows(problem)
}

/// Whether it is one of fewer contacts, of a law that interior points alone do not end, which a few of Newton's steps did not end either.
fn is_stuck(problem: &ContactProblem) -> bool {
    is_rubbing(problem) && !is_redundant(problem)
}

/// Whether it is one of few contacts or many, of a law that interior points alone do not end.
fn is_rubbing(problem: &ContactProblem) -> bool {
    problem.law() == Law::Coulomb && problem.contacts() >= tolerance::FEWEST_STUCK && has_many_rows(problem)
}

/// Whether interior points are for it, and it has many rows for each velocity.
fn has_many_rows(problem: &ContactProblem) -> bool {
    let is_many = |velocities: usize| problem.rows() >= tolerance::REDUNDANT * velocities;
    is_large(problem) && problem.velocity_factor().is_some_and(|factor| is_many(factor.velocities()))
}

/// Whether so many contacts leave so many bodies so free that sweeps come near a solution, and steps of Newton's method cost much.
fn is_many_and_free(problem: &ContactProblem) -> bool {
    problem.contacts() >= tolerance::FEWEST_FREE && is_large(problem) && !is_redundant(problem)
}

/// Whether sweeps over so many contacts under Coulomb's law find the way of loads through them that interior points and Newton's method do
/// not, for the price of some of their steps. A thousand and more, few for each velocity, come to them sooner.
fn is_piled(problem: &ContactProblem) -> bool {
    let is_many = (tolerance::FEWEST_IN_ROUNDS..tolerance::FEWEST_FREE).contains(&problem.contacts());
    is_many && problem.law() == Law::Coulomb && is_large(problem)
}

/// Whether so many contacts leave bodies so free that, from the impulses of the step before, sweeps and Newton's method take turns.
pub(super) fn is_taken_in_rounds(problem: &ContactProblem) -> bool {
    problem.contacts() >= tolerance::FEWEST_IN_ROUNDS && is_large(problem) && !has_many_rows(problem)
}

/// Whether interior points are for it.
fn is_large(problem: &ContactProblem) -> bool {
    has_blocks(problem) && has_second_order_cone(problem)
}

/// Whether Fischer and Burmeister's equations are for it, and their steps cost little.
fn is_smoothed(problem: &ContactProblem) -> bool {
    is_iterated(problem) && has_second_order_cone(problem) && (has_blocks(problem) || problem.contacts() <= tolerance::SMOOTHED_CONTACTS)
}

/// Whether these equations end it sooner than all starts of Newton's method: friction at so few contacts that a factor of all costs little.
fn is_smoothed_soon(problem: &ContactProblem) -> bool {
    is_smoothed(problem) && !is_rubbing(problem) && !problem.is_frictionless() && problem.contacts() <= tolerance::SMOOTHED_CONTACTS
}

/// Whether they are for it and were not tried.
fn is_smoothed_late(problem: &ContactProblem) -> bool {
    is_smoothed(problem) && !is_rubbing(problem) && !is_smoothed_soon(problem)
}

/// All but a compliance on edges.
pub(super) fn is_iterated(problem: &ContactProblem) -> bool {
    NonsmoothNewton::fits(problem)
}

/// What sweeps solve of it: in the plane the polyhedral laws with two directions are those of the round cones.
fn is_swept(problem: &ContactProblem) -> bool {
    is_iterated(problem) && (problem.rows_per_contact() == 2 || !matches!(problem.law(), Law::PolyhedralAssociated { .. }))
}

fn has_second_order_cone(problem: &ContactProblem) -> bool {
    problem.law().directions().is_none()
}

/// Whether it is a convex problem but for the lift of Coulomb's law, not too large for many of those.
fn is_lifted(problem: &ContactProblem) -> bool {
    problem.law() == Law::Coulomb && is_iterated(problem) && problem.contacts() <= tolerance::LIFTED_CONTACTS
}

fn newton(problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    NonsmoothNewton { tolerance: stop, ..Default::default() }.solve(problem, start)
}

/// Whether Lemke's pivots are not too many here, or nothing else is for the problem.
fn is_pivoted(problem: &ContactProblem) -> bool {
    LemkePivoting::fits(problem)
        && (!is_iterated(problem) || unknowns(problem, problem.law().directions().unwrap_or(2)) <= tolerance::LEMKE_UNKNOWNS)
}

/// Whether it is a linear complementarity problem, too large to be pivoted early and small enough to be pivoted at all.
fn is_pivoted_last(problem: &ContactProblem) -> bool {
    let size = unknowns(problem, problem.law().directions().unwrap_or(2));
    LemkePivoting::fits(problem) && !is_pivoted(problem) && size <= tolerance::LEMKE_LAST
}

/// Whether Lemke's pivots cost less than the sweeps that may end it, which many contacts of few bodies hold up.
fn is_pivoted_soon(problem: &ContactProblem) -> bool {
    let size = unknowns(problem, problem.law().directions().unwrap_or(2));
    is_pivoted_last(problem) && size <= tolerance::LEMKE_SOON
}

/// Whether no linear complementarity problem is equivalent, and that of a polygon is not too large.
fn is_round(problem: &ContactProblem) -> bool {
    let small = unknowns(problem, tolerance::LEMKE_DIRECTIONS[0]) <= tolerance::POLYGON_UNKNOWNS;
    has_second_order_cone(problem) && !LemkePivoting::fits(problem) && small
}

/// How many λ, β and σ there are with this many directions; only λ without friction.
fn unknowns(problem: &ContactProblem, directions: usize) -> usize {
    if problem.is_frictionless() { problem.contacts() } else { (2 + directions) * problem.contacts() }
}

/// Newton's method on softer contacts, W + α/ρ in place of W, from soft to hard, α = 1, ¼, …: each answer is near the next, and where none
/// is the last one is.
fn through_softness(problem: &ContactProblem, _: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    let (weights, mut softer) = (Judge::weights(problem), problem.clone());
    let (rows, mut impulse, mut iterations) = (problem.rows_per_contact(), None, 0);
    for alpha in tolerance::softnesses() {
        let added = |row: usize| alpha / weights[row / rows][usize::from(!row.is_multiple_of(rows))];
        let diagonal = DVector::from_fn(problem.rows(), |row, _| compliance(problem, row) + added(row));
        softer = softer.into_builder().compliance(Compliance { coordinates: Coordinates::Contact, diagonal }).build()?;
        let solver = NonsmoothNewton { steps: tolerance::SOFT_STEPS, tolerance: ENOUGH, ..Default::default() };
        let solution = watch::unnoted(|| solver.solve(&softer, impulse.as_ref()))?;
        iterations += solution.iterations;
        impulse = Some(solution.impulse);
    }
    let ended = newton(problem, impulse.as_ref(), stop)?;
    Ok(Solution { iterations: iterations + ended.iterations, ..ended })
}

/// Plain sweeps from zero, and proximal points from there.
fn in_a_round(problem: &ContactProblem, _: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    rounds::in_rounds(problem, &DVector::zeros(problem.rows()), [tolerance::SWEEPS_OF_FREE, 1], [stop; 2])
        .ok_or_else(|| Error::breakdown("pgs", "ended without an answer made of numbers"))
}

/// Plain sweeps, which go on where accelerated ones jump between contacts that open and slide, and proximal points from there.
fn through_sweeps(problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    let solver = ProjectedGaussSeidel { sweeps: tolerance::SWEEPS_OF_FREE, tolerance: stop, ..Default::default() };
    let begun = solver.solve(problem, start)?;
    let ended = ProximalNewton { steps: STEPS_IN_AUTO, tolerance: stop, ..Default::default() }.solve(problem, Some(&begun.impulse))?;
    Ok(Solution { iterations: begun.iterations + ended.iterations, ..ended })
}

/// Many proximal points, which creep and leap to where a contact opens or sticks that nothing else tells, and Newton for the last digits.
fn patient_points(problem: &ContactProblem, _: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    let (steps, near) = (PATIENT_STEPS.min(PATIENT_WORK / problem.contacts()), stop.max(tolerance::ACCEPTABLE / 2.0));
    let points = ProximalNewton { steps, patience: PATIENCE, tolerance: near, ..Default::default() }.solve(problem, None)?;
    let ended = short_newton(problem, Some(&points.impulse), stop)?;
    Ok(Solution { iterations: points.iterations + ended.iterations, ..ended })
}

/// Lemke on a polygon in place of the disk, which tells which contacts press, stick and slide, and Newton from there.
fn through_polygon(problem: &ContactProblem, directions: usize, stop: f64) -> Result<Solution> {
    let law =
        if problem.law() == Law::Associated { Law::PolyhedralAssociated { directions } } else { Law::PolyhedralCoulomb { directions } };
    let begun = LemkePivoting.solve(&problem.clone().into_builder().law(law).build()?, None)?;
    let ended = newton(problem, Some(&begun.impulse), stop)?;
    Ok(Solution { iterations: begun.iterations + ended.iterations, ..ended })
}

fn few_sweeps(problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    swept(problem, start, tolerance::FEW_SWEEPS, stop)
}

/// Where Lemke ends the problem, sweeps are not worth more than it.
fn more_sweeps(problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    swept(problem, start, if has_second_order_cone(problem) { tolerance::AUTO_SWEEPS } else { tolerance::FIRST_SWEEPS }, stop)
}

/// Accelerated sweeps; of the round cone where the law has none of its own, which in the plane is the same one and in space tells which
/// contacts press.
fn swept(problem: &ContactProblem, start: Option<&DVector<f64>>, sweeps: usize, stop: f64) -> Result<Solution> {
    let solver = ProjectedGaussSeidel { sweeps, tolerance: stop, ..ProjectedGaussSeidel::accelerated() };
    let round = match problem.law() {
        Law::PolyhedralCoulomb { .. } if problem.rows_per_contact() == 2 => Law::Coulomb,
        Law::PolyhedralAssociated { .. } => Law::Associated,
        _ => return solver.solve(problem, start),
    };
    solver.solve(&problem.clone().into_builder().law(round).build()?, start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::contact::delassus::delassus;
    use nalgebra::DMatrix;

    /// n points of one planar body of 1 kg along its lower side, closing at 1 m/s while it slides and turns: rank three of 2 n.
    fn points(n: usize, law: Law) -> ContactProblem {
        let mut jacobian = DMatrix::zeros(2 * n, 3);
        for k in 0..n {
            let x = 2.0 * k as f64 / (n as f64 - 1.0) - 1.0;
            jacobian.row_mut(2 * k).copy_from_slice(&[0.0, 1.0, x]);
            jacobian.row_mut(2 * k + 1).copy_from_slice(&[1.0, 0.0, 1.0]);
        }
        let mass = DMatrix::from_diagonal(&DVector::from_row_slice(&[1.0, 1.0, 0.5]));
        ContactProblem::new(delassus(&mass, &jacobian).unwrap(), &jacobian * DVector::from_row_slice(&[0.7, -1.0, 0.4]))
            .name("points")
            .law(law)
            .rows_per_contact(2)
            .friction(vec![0.3; n])
            .bodies(vec![[Some(0), None]; n])
            .build()
            .unwrap()
    }

    #[test]
    fn softer_contacts_lead_to_the_answer_of_the_hard_ones() {
        for law in [Law::Frictionless, Law::Coulomb, Law::Associated, Law::PolyhedralCoulomb { directions: 2 }] {
            let problem = points(4, law);
            let solution = through_softness(&problem, None, tolerance::STOP).unwrap();
            assert!(residuals(&problem, &solution).unwrap().is_solution(ENOUGH), "{law:?}");
            let other = LemkePivoting.solve(&problem, None).unwrap();
            assert!((&other.velocity - &solution.velocity).amax() <= crate::tolerance::certificate::CERTIFY, "{law:?}");
        }
    }

    #[test]
    fn many_contacts_are_not_pivoted_unless_nothing_else_is_for_them() {
        let fits = tolerance::LEMKE_UNKNOWNS / 4;
        let polyhedral = |n: usize| points(n, Law::PolyhedralCoulomb { directions: 2 });
        assert!(is_pivoted(&polyhedral(fits)) && !is_pivoted(&polyhedral(fits + 1)));
        let edges = Compliance { coordinates: Coordinates::Edge, diagonal: DVector::from_element(2 * (fits + 1), 1.0) };
        let soft = points(fits + 1, Law::PolyhedralAssociated { directions: 2 }).into_builder().compliance(edges).build().unwrap();
        assert!(is_pivoted(&soft), "edges that give way are a linear complementarity problem and nothing else");
    }

    #[test]
    fn an_answer_that_a_left_out_algorithm_might_have_found_says_so() {
        let untried = |law: Law| left_out(&points(2, law));
        assert_eq!(untried(Law::Coulomb), "");
        assert_eq!(untried(Law::Associated).contains("clarabel"), !cfg!(feature = "clarabel"));
    }
}
