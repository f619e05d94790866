//! What every solver needs, your own included: impulses to start from, refusals, and a check that an answer is finite.

use crate::certificate::Judge;
use crate::cones::second_order;
use crate::memory::spare::{self, Lent, Spare};
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::first_order::SLIGHTLY;
use crate::tolerance::solvers::LARGEST_START;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// The impulses an iteration starts from \[N·s\]: the given ones, or zero. So do declared sweeps, which promise no solution.
///
/// # Errors
/// [`Error::Invalid`] if the given ones are not as many finite numbers as the problem has rows.
pub fn start(problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<DVector<f64>> {
    check_start(problem, warm_start)?;
    Ok(warm_start.map_or_else(|| spare::zeros(problem.rows()), Spare::copied))
}

/// The same of an iteration that looks for a solution: zero, too, where the given ones are so large that what they leave of the given
/// velocities is rounding.
///
/// ```text
///     |r_n| ≤ 10⁻⁸/(8ε) ρ_n V ,   ‖r_t‖ ≤ 10⁻⁸/(8ε) ρ_t V        at every contact, V the largest velocity given
/// ```
/// Where every given velocity is zero nothing tells, and they are taken.
///
/// # Errors
/// As [`start`].
pub(super) fn start_of_use(problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<DVector<f64>> {
    check_start(problem, warm_start)?;
    start(problem, warm_start.filter(|impulse| tells_more_than_rounding(problem, impulse)))
}

fn tells_more_than_rounding(problem: &ContactProblem, impulse: &DVector<f64>) -> bool {
    let given = problem.free_velocity().as_slice().iter().zip(problem.shift().as_slice());
    let most = LARGEST_START * given.fold(0.0, |most: f64, (free, shift)| most.max((free + shift).abs()));
    let mut contacts = Judge::weights(problem).iter().zip(impulse.as_slice().chunks_exact(problem.rows_per_contact()));
    let is_usual = |([normal, tangential], r): (&[f64; 2], &[f64])| {
        r[0].abs() <= normal * most && second_order::tangential_norm(r) <= tangential * most
    };
    most == 0.0 || contacts.all(is_usual)
}

/// Refuses given impulses that are not as many finite numbers as the problem has rows.
///
/// # Errors
/// [`Error::Invalid`] with their number, or the first row that is not finite.
pub(super) fn check_start(problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<()> {
    let Some(impulse) = warm_start else { return Ok(()) };
    problem.require_size("warm_start", impulse.len())?;
    match impulse.as_slice().iter().position(|r| !r.is_finite()) {
        None => Ok(()),
        Some(row) => Err(Error::invalid(format!("warm_start[{row}]"), format!("is {}", impulse[row]), "give finite impulses")),
    }
}

/// The solution itself, if all its impulses and velocities are finite.
///
/// # Errors
/// [`Error::Solver`] in the name of its solver if one is infinite or not a number.
pub fn finite(solution: Solution) -> Result<Solution> {
    if solution.impulse.iter().chain(&solution.velocity).all(|x| x.is_finite()) {
        return Ok(solution);
    }
    let reason = "ended with impulses or velocities too large for a number; ask another solver, for its impulses may grow without \
                  end where W + R is not positive semidefinite, or rescale the units of the problem";
    Err(Error::breakdown(&solution.solver, reason))
}

/// Makes one vector another one's copy, in its own memory if there is room.
pub(super) fn copy(from: &DVector<f64>, to: &mut DVector<f64>) {
    resize(to, from.len());
    to.copy_from(from);
}

/// Gives a vector so many entries, zeros where they were not so many, in its own memory if there is room.
pub(super) fn resize(vector: &mut DVector<f64>, size: usize) {
    if vector.len() != size {
        let mut entries = Lent::from(Vec::from(std::mem::replace(vector, Spare::nothing()).data));
        entries.make_room(size);
        entries.resize(size, 0.0);
        *vector = entries.into_inner().into();
    }
}

/// R of one contact row \[1/kg\], zero if the problem is hard or its compliance acts on edges.
pub fn compliance(problem: &ContactProblem, row: usize) -> f64 {
    problem.row_compliance(row)
}

/// (W + R) r \[m/s\] for impulses r \[N·s\]; a compliance on edges is not part of it.
pub fn law_product(problem: &ContactProblem, impulse: &DVector<f64>) -> DVector<f64> {
    let mut product = problem.apply(impulse);
    for (row, y) in product.iter_mut().enumerate() {
        *y += compliance(problem, row) * impulse[row];
    }
    product
}

/// μ of the cone that the law uses at contact k: 0 without friction.
pub fn cone_friction(problem: &ContactProblem, k: usize) -> f64 {
    problem.law().cone_friction(problem.friction()[k])
}

/// Replaces every contact's impulse by its projection on the second-order cone.
pub fn project(problem: &ContactProblem, impulse: &mut DVector<f64>) {
    for (k, contact) in impulse.as_mut_slice().chunks_exact_mut(problem.rows_per_contact()).enumerate() {
        second_order::project(contact, cone_friction(problem, k));
    }
}

/// The error of a solver for convex laws that is given another one.
pub fn not_convex(solver: &str, law: Law) -> Error {
    Error::refused(solver, format!("does not solve the law `{}`", law.name()))
}

/// Whether a solver of convex programs over second-order cones takes a problem with this law and symmetry.
pub fn takes_convex(law: Law, symmetric: bool) -> bool {
    symmetric && matches!(law, Law::Frictionless | Law::Associated)
}

/// Refuses what [`takes_convex`] does not take.
///
/// # Errors
/// [`Error::Solver`] with the law, or with the relative asymmetry.
pub fn require_convex(solver: &str, problem: &ContactProblem) -> Result<()> {
    if !takes_convex(problem.law(), true) {
        return Err(not_convex(solver, problem.law()));
    }
    require_symmetry(solver, problem)
}

/// Refuses another law than [`takes_convex`] takes, and a W that is asymmetric by more than [`SLIGHTLY`].
///
/// # Errors
/// [`Error::Solver`] with the law, or with the relative asymmetry.
pub fn require_nearly_convex(solver: &str, problem: &ContactProblem) -> Result<()> {
    if !takes_convex(problem.law(), true) {
        return Err(not_convex(solver, problem.law()));
    }
    require_near_symmetry(solver, problem)
}

/// Refuses a W that is asymmetric by more than [`SLIGHTLY`], in the name of a solver for symmetric ones whose answer is judged by the W
/// that was given.
///
/// # Errors
/// [`Error::Solver`] with the relative asymmetry.
pub fn require_near_symmetry(solver: &str, problem: &ContactProblem) -> Result<()> {
    at_most(solver, problem, SLIGHTLY)
}

/// Refuses an asymmetric W in the name of a solver that minimises ½rᵀWr, whose gradient is W r only if W is symmetric.
///
/// # Errors
/// [`Error::Solver`] with the relative asymmetry.
pub fn require_symmetry(solver: &str, problem: &ContactProblem) -> Result<()> {
    at_most(solver, problem, crate::tolerance::solvers::SYMMETRY)
}

fn at_most(solver: &str, problem: &ContactProblem, most: f64) -> Result<()> {
    let asymmetry = problem.asymmetry();
    if asymmetry <= most {
        return Ok(());
    }
    Err(Error::refused(solver, format!("needs a symmetric W, and this one has relative asymmetry {asymmetry:.1e}")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solvers::Solvers;
    use nalgebra::{DMatrix, dvector};

    /// One contact that slides, of 1 kg, and one of 4 kg along the tangents, in space.
    fn sliding(scale: f64) -> ContactProblem {
        let w = DMatrix::from_diagonal(&dvector![1.0, 1.0, 1.0, 1.0, 0.25, 0.25]);
        let free = dvector![-1.0, 2.0, 0.0, -0.5, 0.0, 1.0] * scale;
        ContactProblem::new(w, free).law(Law::Coulomb).friction(vec![0.5; 2]).build().unwrap()
    }

    #[test]
    fn a_start_is_taken_as_long_as_it_leaves_more_than_rounding_of_what_is_given() {
        let problem = sliding(1e-3);
        let most = LARGEST_START * 2e-3;
        for (row, most) in [(0, most), (1, most), (3, most), (5, 4.0 * most)] {
            for sign in [-1.0, 1.0] {
                let mut impulse = dvector![1e-3, 0.0, 0.0, 0.0, 0.0, 0.0];
                impulse[row] = sign * most;
                assert_eq!(start_of_use(&problem, Some(&impulse)).unwrap(), impulse);
                impulse[row] = sign * most.next_up();
                assert_eq!(start_of_use(&problem, Some(&impulse)).unwrap(), DVector::zeros(6), "{row}");
            }
        }
        let large = DVector::repeat(6, 1e300);
        assert_eq!(start(&problem, Some(&large)).unwrap(), large, "of declared sweeps");
        let at_rest = sliding(0.0);
        assert_eq!(start_of_use(&at_rest, Some(&DVector::repeat(6, 1e300))).unwrap(), DVector::repeat(6, 1e300), "nothing tells");
    }

    #[test]
    fn no_start_keeps_a_solver_from_the_answer() {
        let problem = sliding(1.0);
        let mut judge = Judge::default();
        let mut solved = 0;
        let all = Solvers::own();
        for name in all.names() {
            let solver = all.by_name(name).unwrap();
            let Ok(alone) = solver.solve(&problem, None) else { continue };
            assert!(judge.judge(&problem, &alone).unwrap().accepts(1e-8), "{name}");
            for size in [1e3, 1e6, 1e8, 1e12, 1e16, 1e100, 1e300] {
                let from = DVector::from_fn(6, |row, _| if row % 2 == 0 { size } else { -size });
                let answer = solver.solve(&problem, Some(&from)).unwrap();
                assert!(judge.judge(&problem, &answer).unwrap().accepts(1e-8), "{name} from {size:e}");
            }
            solved += 1;
        }
        assert!(solved >= 8, "{solved}");
    }
}
