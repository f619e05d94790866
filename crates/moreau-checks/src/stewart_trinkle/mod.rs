//! Family 2: the Stewart–Trinkle matrix is copositive, and copositive-plus only without friction.
//!
//! ```text
//!     xᵀM x = pᵀM⁻¹p + Σ μᵢλᵢσᵢ ,   p = Σ nᵢλᵢ + Dᵢβᵢ .
//! ```
//! The subject is an [`Assembly`], a function from a system of contacts to an LCP. What is expected of it comes from the
//! system itself, in impulses and velocities, and from exact decisions on the matrix; theorem and proof stand in
//! [`moreau_contact::certificate::existence`].

mod rational_step;

use crate::finding::Finding;
use dashu_ratio::RBig;
use moreau_contact::certificate::copositivity::{NotPlus, copositive, copositive_plus};
use moreau_contact::certificate::definiteness::{positive_semidefinite, quadratic_form};
use moreau_contact::certificate::p_matrix::p_matrix;
use moreau_contact::certificate::{Decision, existence, lcp as certificate};
use moreau_contact::contact::delassus::delassus;
use moreau_contact::problem::{Lcp, PlanarProblem};
use moreau_contact::solvers::lemke::{LemkeOutcome, lemke};
use moreau_exact::Result;
use moreau_exact::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

pub use rational_step::{RationalStep, rational_directions};

/// The subject of this family: how the LCP of a system is written down.
pub type Assembly = fn(&RationalStep) -> Result<Lcp<Rational>>;

/// The crate's own assembly: W̃ = Gᵀ H M⁻¹ Hᵀ G, b = φ/h.
///
/// # Errors
/// If the system's mass is not positive.
pub fn reference(system: &RationalStep) -> Result<Lcp<Rational>> {
    Ok(problem(system)?.polyhedral(&system.friction, &system.directions)?.lcp)
}

/// W and the velocities u_free, with φ/h added to the normal ones.
///
/// # Errors
/// If the system's mass is not positive.
pub fn problem(system: &RationalStep) -> Result<PlanarProblem<Rational>> {
    let delassus = delassus(&DMatrix::from_diagonal(&system.mass), &system.jacobian)?;
    let mut velocity = &system.jacobian * &system.free_velocity;
    for (i, gap) in system.gap.iter().enumerate() {
        velocity[i * system.rows_per_contact] += gap / &system.step;
    }
    Ok(PlanarProblem::new(delassus, velocity))
}

/// W̃ and the velocities (nᵀv_free + φ/h, Dᵀv_free).
///
/// # Errors
/// If the system's mass is not positive.
pub fn reduced(system: &RationalStep) -> Result<(DMatrix<Rational>, DVector<Rational>)> {
    let lcp = reference(system)?;
    let impulses = lcp.size() - system.contacts();
    Ok((lcp.matrix.view((0, 0), (impulses, impulses)).into_owned(), lcp.vector.rows(0, impulses).into_owned()))
}

/// The identity xᵀM x = pᵀM⁻¹p + Σμλσ at these x, and the two facts it implies at x = (0, 0, σ).
///
/// # Errors
/// If the assembly fails.
pub fn identity(system: &RationalStep, assembly: Assembly, points: &[DVector<Rational>]) -> Result<Vec<Finding>> {
    let matrix = assembly(system)?.matrix;
    let mut findings: Vec<Finding> =
        points.iter().map(|x| Finding::exact("xᵀMx", &quadratic_form(&matrix, x), &system.expected_form(x), "J")).collect();
    for contact in 0..system.contacts() {
        let sigma = unit(system.unknowns(), system.sigma(contact));
        let image = (&matrix + matrix.transpose()) * &sigma;
        let expected = unit(system.unknowns(), system.lambda(contact)) * system.friction[contact].clone();
        findings.push(Finding::exact("xᵀMx at x = (0, 0, σ)", &quadratic_form(&matrix, &sigma), &RBig::ZERO, "J"));
        findings.push(Finding::decision("(M + Mᵀ)x = (μσ, 0, 0) at x = (0, 0, σ)", image == expected, true));
    }
    Ok(findings)
}

/// Copositive; copositive-plus and semidefinite iff every μ is 0; never P. Exact, for at most 12 unknowns.
///
/// # Errors
/// If the assembly fails or the matrix is too large.
pub fn decisions(system: &RationalStep, assembly: Assembly) -> Result<Vec<Finding>> {
    let matrix = assembly(system)?.matrix;
    let frictionless = system.friction.iter().all(|mu| mu.is_zero());
    let plus = copositive_plus(&matrix)?;
    let witness = match &plus {
        Decision::Fails(NotPlus::Zero(x)) => {
            let image = (&matrix + matrix.transpose()) * x;
            x.iter().all(|x| *x >= RBig::ZERO) && quadratic_form(&matrix, x).is_zero() && image.iter().any(|y| !y.is_zero())
        }
        _ => false,
    };
    Ok(vec![
        Finding::decision("copositive", copositive(&matrix)?.holds(), true),
        Finding::decision("copositive-plus", plus.holds(), frictionless),
        Finding::decision("a zero of the form shows that it is not copositive-plus", witness, !frictionless),
        Finding::decision("positive semidefinite", positive_semidefinite(&matrix).holds(), frictionless),
        Finding::decision("P-matrix", p_matrix(&matrix)?.holds(), false),
    ])
}

/// Lemke's method solves the LCP wherever the existence theorem applies, and what it returns is a step of the system.
///
/// A system outside the theorem gets the one finding that a solution, if the method finds one, is a step.
///
/// # Errors
/// If the assembly fails.
pub fn solvability(system: &RationalStep, assembly: Assembly) -> Result<Vec<Finding>> {
    let lcp = assembly(system)?;
    let mut findings = Vec::new();
    let outcome = lemke(&lcp, &DVector::from_element(lcp.size(), RBig::ONE))?;
    if theorem_applies(system)? {
        findings.push(Finding::decision("Lemke ends at a solution", matches!(outcome, LemkeOutcome::Solution { .. }), true));
    }
    if let LemkeOutcome::Solution { z, .. } = outcome {
        findings.push(Finding::decision("0 ≤ z ⟂ Mz + q ≥ 0", certificate::residuals(&lcp, &z).vanish(), true));
        let slack = system.slack(&z);
        let least = z.iter().chain(slack.iter()).fold(RBig::ZERO, |least, x| if *x < least { x.clone() } else { least });
        findings.push(Finding::exact("least of z and of the slacks of the step", &least, &RBig::ZERO, "1"));
        findings.push(Finding::exact("zᵀ(slacks of the step)", &z.dot(&slack), &RBig::ZERO, "J"));
    }
    Ok(findings)
}

/// Whether every gap is ≥ 0 or the friction cone is pointed, decided exactly on the reference's W̃.
///
/// # Errors
/// If the system's mass is not positive.
pub fn theorem_applies(system: &RationalStep) -> Result<bool> {
    let open = system.gap.iter().all(|gap| *gap >= RBig::ZERO);
    Ok(open || existence::pointed(&reduced(system)?.0, &system.friction).holds())
}

fn unit(size: usize, index: usize) -> DVector<Rational> {
    DVector::from_fn(size, |i, _| ratio(i64::from(i == index), 1))
}

/// The chapter's point contact (M = 1, d = ±x, μ = 1/2) at the gap φ, with h = 1/10.
pub fn chapter_example(gap: Rational, free_velocity: [Rational; 2]) -> RationalStep {
    RationalStep {
        mass: DVector::from_element(2, RBig::ONE),
        jacobian: DMatrix::from_row_slice(2, 2, &[0, 1, 1, 0].map(|x| ratio(x, 1))),
        rows_per_contact: 2,
        directions: rational_directions(2),
        friction: vec![ratio(1, 2)],
        gap: vec![gap],
        step: ratio(1, 10),
        free_velocity: DVector::from_row_slice(&free_velocity),
    }
}

/// A point in a wedge of two walls with normals (±4/5, 3/5), friction μ and gaps φ = −h on both sides.
pub fn wedge(friction: Rational) -> RationalStep {
    let rows = [[4, 3], [3, -4], [-4, 3], [3, 4]].map(|row| row.map(|x| ratio(x, 5)));
    RationalStep {
        mass: DVector::from_element(2, RBig::ONE),
        jacobian: DMatrix::from_row_slice(4, 2, rows.as_flattened()),
        rows_per_contact: 2,
        directions: rational_directions(2),
        friction: vec![friction.clone(), friction],
        gap: vec![ratio(-1, 10), ratio(-1, 10)],
        step: ratio(1, 10),
        free_velocity: DVector::from_element(2, RBig::ZERO),
    }
}
