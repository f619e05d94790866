//! Solvers of contact problems with one mistake each. They show in problems as well as in scenes.

mod answer;
mod extrapolated;
mod row_by_row;

pub use answer::answer;

use crate::answers::{Answers, certified, forgets_its_start, in_any_order};
use crate::planted::{Family, Kind, Planted};
use extrapolated::extrapolated;
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::{Auto, ContactSolver, ProjectedGaussSeidel};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};
use row_by_row::{along_slip, boxed, by_rows, kinetic, lagged, regularised, row_by_row, sliding_early, turned_to_diagonals};
use std::f64::consts::PI;

/// Solvers, held against the certificate of their answers.
pub static SOLVERS: Family<Answers> = Family {
    reference: |problem, start| Auto.solve(problem, Some(start)),
    checks: &[("answers/certificate", certified), ("answers/any-start", forgets_its_start), ("answers/any-order", in_any_order)],
    planted: LIST,
};

/// Sweeps in which a contact that needs more than 0.97 μ r_n to stick slides, with μ r_n: wrong only where a contact is that near to its
/// limit. It stands beside the list, whose problems have no such contact.
///
/// # Errors
/// Those of the reference, which answers problems that are not Coulomb's in space.
pub fn sticking_up_to_0_97(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    by_rows(problem, start, sliding_early)
}

/// One constant per mistake, and the list of all.
macro_rules! mistakes {
    ($($constant:ident = $name:literal, $mistake:literal, $subject:expr;)*) => {
        $(
            #[doc = $mistake]
            pub const $constant: Planted<Answers> = Planted { name: $name, mistake: $mistake, kind: Kind::Solver, subject: $subject };
        )*
        const LIST: &[Planted<Answers>] = &[$($constant),*];
    };
}

mistakes! {
    THREE_SWEEPS = "solver/three-sweeps",
        "Gauss–Seidel stops after three sweeps and forgets the impulses of the step before",
        three_sweeps;
    A_THOUSANDTH_LEFT = "solver/a-thousandth-left",
        "stops when a thousandth of every impulse is still missing, three times what the gate allows",
        |p, s| left_over(p, s, 1e-3);
    NO_IMPULSE = "solver/no-impulse",
        "answers zero impulses to every problem",
        |p, _| Ok(answer(p, DVector::zeros(p.rows()), 0));
    NORMALS_CLIPPED = "solver/normal-impulses-clipped",
        "keeps normal impulses from pulling and lets friction be as large as sticking needs",
        normals_clipped;
    SHIFT_IGNORED = "solver/shift-ignored",
        "leaves out what the scheme adds to the velocity: restitution, φ/h",
        shift_ignored;
    CONVEX_RELAXATION = "solver/convex-relaxation",
        "declares Coulomb's law and solves the associated one, which lifts what slides",
        convex_relaxation;
    VELOCITY_AS_WISHED = "solver/velocity-as-wished",
        "reports the velocity the law asks for instead of the one its impulses give",
        velocity_as_wished;
    EXTRAPOLATED = "tumbling/extrapolated-sweeps",
        "extrapolates sweeps by Anderson's rule, takes no step back however much worse it is, and answers its last iterate at the limit",
        extrapolated;
    TWO_SWEEPS = "tumbling/two-sweeps",
        "starts from zero impulses, stops after two sweeps and answers the impulses of that moment",
        two_sweeps;
    STALE = "tumbling/stale-impulses",
        "answers the impulses of the step before, as they are, where the contacts are the same",
        stale;
    ALONG_AXES = "metamorphic/friction-along-axes",
        "bounds friction along two tangents taken from the world's axes by μ r_n each, and declares a cone",
        friction_along_axes;
    ROUNDED_DOWN = "metamorphic/direction-rounded-down",
        "turns sliding friction to the next lower of sixteen directions instead of the nearest",
        direction_rounded_down;
    GLUED = "rocking/contacts-glued",
        "solves the active contacts as equations, so that an impact also holds the edge that should lift",
        contacts_glued;
    SLIP_FIXED = "painleve/slip-fixed-in-advance",
        "sweeps over normal impulses with friction −μ r_n t tied to them, t the slip before the step",
        slip_fixed_in_advance;
    TURNED_TO_DIAGONALS = "incline/friction-not-opposed",
        "keeps sliding friction on the cone, but turned from the slip towards the diagonals of the tangents",
        |p, s| by_rows(p, s, turned_to_diagonals);
    BOXED = "isotropy/boxed-friction",
        "bounds each tangent's friction by μ r_n for itself, and declares a cone",
        |p, s| by_rows(p, s, boxed);
    LAGGED = "contact/lagged-normal",
        "bounds friction by the normal impulse of the step before",
        |p, s| by_rows(p, s, lagged);
    KINETIC = "incline/kinetic-friction",
        "uses 0.8 μ as soon as a contact slides",
        |p, s| by_rows(p, s, kinetic);
    REGULARISED = "incline/regularised-friction",
        "smooths friction over slips of 1 cm/s and does not declare it",
        |p, s| by_rows(p, s, regularised);
    ALONG_SLIP = "contact/friction-along-slip",
        "has the sign of sliding friction wrong in one tangent",
        |p, s| by_rows(p, s, along_slip);
    LAST_FORGOTTEN = "solver/last-contact-forgotten",
        "solves all contacts but the last, which gets no impulse",
        last_forgotten;
    FRICTION_OF_THE_NEXT = "solver/friction-of-the-next",
        "bounds the friction of a contact by μ of the next one in the list",
        friction_of_the_next;
    COMPLIANCE_IGNORED = "solver/compliance-ignored",
        "solves soft contacts as hard ones",
        compliance_ignored;
    ALONE = "solver/coupling-ignored",
        "solves every contact as if it were the only one",
        alone;
    RELAXED_AFTER = "solver/relaxed-after-the-projection",
        "goes half a step beyond the projected impulse and answers what is no longer in the cone",
        relaxed_after;
    VELOCITY_BEFORE = "solver/velocity-before-its-impulses",
        "tells the velocity without its impulses",
        velocity_before;
    VELOCITY_SHIFTED = "solver/velocity-with-the-shift",
        "tells y, with what the scheme adds, in place of u",
        velocity_shifted;
    START_ADDED = "solver/start-added",
        "adds the impulses it started from to its answer",
        start_added;
    SORTED = "solver/sorted-by-load",
        "sorts the contacts by load and does not sort them back",
        sorted;
    PULLS = "solver/equations",
        "solves y = 0 for every row by elimination, so that contacts pull and friction is without a bound",
        equations;
}

/// The solution, but for a part of every impulse.
///
/// # Errors
/// Those of the solver.
pub fn left_over(problem: &ContactProblem, start: &DVector<f64>, part: f64) -> Result<Solution> {
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

fn two_sweeps(problem: &ContactProblem, _start: &DVector<f64>) -> Result<Solution> {
    ProjectedGaussSeidel { sweeps: 2, ..Default::default() }.solve(problem, None)
}

fn stale(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let known = start.as_slice().chunks(problem.rows_per_contact()).all(|impulse| impulse[0] > 0.0);
    if known { Ok(answer(problem, start.clone(), 0)) } else { Auto.solve(problem, Some(start)) }
}

fn friction_along_axes(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    if problem.law() != Law::Coulomb {
        return Auto.solve(problem, Some(start));
    }
    let sweeps = 100;
    let limit = |impulse: &mut [f64], mu: f64| {
        impulse[0] = impulse[0].max(0.0);
        let bound = mu * impulse[0];
        impulse[1..].iter_mut().for_each(|r| *r = r.clamp(-bound, bound));
    };
    Ok(answer(problem, row_by_row(problem, start, sweeps, limit), sweeps))
}

fn direction_rounded_down(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let mut solution = Auto.solve(problem, Some(start))?;
    if problem.rows_per_contact() != 3 {
        return Ok(solution);
    }
    for (contact, r) in solution.impulse.as_mut_slice().chunks_mut(3).enumerate() {
        let friction = r[1].hypot(r[2]);
        let sliding = 0.999 * problem.friction()[contact] * r[0];
        if friction > 0.0 && friction >= sliding {
            let facet = PI / 8.0;
            let (sine, cosine) = ((r[2].atan2(r[1]) / facet).floor() * facet).sin_cos();
            (r[1], r[2]) = (friction * cosine, friction * sine);
        }
    }
    Ok(answer(problem, solution.impulse, solution.iterations))
}

fn contacts_glued(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let sweeps = 400;
    Ok(answer(problem, row_by_row(problem, start, sweeps, |_, _| {}), sweeps))
}

/// Gauss–Seidel over the contacts with one unknown each, r = r_n (1, −μ t), t the direction of the slip without impulses: where
/// W_nn + μ W_nt < 0 every sweep adds to the impulse.
fn slip_fixed_in_advance(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let (rows, sweeps) = (problem.rows_per_contact(), 8);
    let mut impulse = DVector::zeros(start.len());
    for _ in 0..sweeps {
        for contact in 0..problem.contacts() {
            let first = contact * rows;
            let slip = problem.free_velocity().rows(first + 1, rows - 1);
            let norm = slip.norm();
            let direction = DVector::from_fn(rows, |k, _| match k {
                0 => 1.0,
                _ if norm > 0.0 => -problem.friction()[contact] * slip[k - 1] / norm,
                _ => 0.0,
            });
            let row = problem.dense().row(first);
            let y = row.tr_dot(&impulse) + problem.free_velocity()[first] + problem.shift()[first];
            let known = impulse[first];
            let normal = (known - y / row[first]).max(0.0);
            impulse.rows_mut(first, rows).copy_from(&(direction * normal));
        }
    }
    Ok(answer(problem, impulse, sweeps))
}

fn last_forgotten(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let (contacts, rows) = (problem.contacts(), problem.rows_per_contact());
    let kept = rows * (contacts - 1);
    let mut impulse = DVector::zeros(problem.rows());
    if contacts > 1 {
        let first = ContactProblem::new(problem.dense().view((0, 0), (kept, kept)).into_owned(), part(problem.free_velocity(), kept))
            .law(problem.law())
            .rows_per_contact(rows)
            .friction(problem.friction()[..contacts - 1].to_vec())
            .shift(part(problem.shift(), kept))
            .build()?;
        impulse.rows_mut(0, kept).copy_from(&Auto.solve(&first, Some(&part(start, kept)))?.impulse);
    }
    Ok(answer(problem, impulse, 1))
}

fn part(vector: &DVector<f64>, rows: usize) -> DVector<f64> {
    vector.rows(0, rows).into_owned()
}

fn friction_of_the_next(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let mut friction = problem.friction().to_vec();
    friction.rotate_left(1);
    Auto.solve(&problem.clone().into_builder().friction(friction).build()?, Some(start))
}

fn compliance_ignored(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    Auto.solve(&problem.clone().into_builder().compliance(None).build()?, Some(start))
}

fn alone(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let rows = problem.rows_per_contact();
    let own = |i: usize, j: usize| if i / rows == j / rows { problem.entry(i, j) } else { 0.0 };
    let delassus = DMatrix::from_fn(problem.rows(), problem.rows(), own);
    let solution = Auto.solve(&problem.clone().into_builder().dynamics(None).delassus(delassus).build()?, Some(start))?;
    Ok(answer(problem, solution.impulse, solution.iterations))
}

/// r + ½ (r − r₀), r₀ one sweep before the answer r.
fn relaxed_after(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let before = ProjectedGaussSeidel { sweeps: 1, ..Default::default() }.solve(problem, Some(start))?.impulse;
    let solution = Auto.solve(problem, Some(start))?;
    let beyond = &solution.impulse + (&solution.impulse - before) * 0.5;
    Ok(answer(problem, beyond, solution.iterations))
}

fn velocity_before(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let solution = Auto.solve(problem, Some(start))?;
    Ok(Solution::new("auto", solution.impulse, problem.free_velocity().clone(), solution.iterations))
}

fn velocity_shifted(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let solution = Auto.solve(problem, Some(start))?;
    let velocity = problem.velocity(&solution.impulse) + problem.shift();
    Ok(Solution::new("auto", solution.impulse, velocity, solution.iterations))
}

fn start_added(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let solution = Auto.solve(problem, Some(start))?;
    Ok(answer(problem, solution.impulse + start, solution.iterations))
}

/// Contacts in the order of their normal impulses, the largest first.
fn sorted(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let solution = Auto.solve(problem, Some(start))?;
    let mut parts: Vec<&[f64]> = solution.impulse.as_slice().chunks(problem.rows_per_contact()).collect();
    parts.sort_by(|one, other| other[0].total_cmp(&one[0]));
    Ok(answer(problem, DVector::from_vec(parts.concat()), solution.iterations))
}

/// y = 0 in every row; a singular operator is left to the reference.
fn equations(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let softness = DVector::from_fn(problem.rows(), |row, _| problem.row_compliance(row));
    let matrix = problem.dense() + DMatrix::from_diagonal(&softness);
    match matrix.lu().solve(&-(problem.free_velocity() + problem.shift())) {
        Some(impulse) => Ok(answer(problem, impulse, 1)),
        None => Auto.solve(problem, Some(start)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::finding::Finding;

    #[test]
    fn the_reference_and_the_sweeps_without_a_mistake_pass_every_check() {
        for subject in [SOLVERS.reference, |problem, start| by_rows(problem, start, row_by_row::coulomb)] {
            for (name, check) in SOLVERS.checks {
                let findings = check(&subject).expect("solved");
                assert!(!findings.is_empty() && findings.iter().all(Finding::holds), "{name}: {findings:?}");
            }
        }
    }
}
