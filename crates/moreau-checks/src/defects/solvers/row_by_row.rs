//! Projected Gauss–Seidel row by row and contact by contact, with the limit of friction left open.

use super::answer::answer;
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::{Auto, ContactSolver};
use moreau_exact::Result;
use nalgebra::DVector;

/// Gauss–Seidel row by row: r_i ← r_i − y_i/W_ii, then the contact's impulse is limited.
pub(super) fn row_by_row(problem: &ContactProblem, start: &DVector<f64>, sweeps: usize, limit: fn(&mut [f64], f64)) -> DVector<f64> {
    let rows = problem.rows_per_contact();
    let mut impulse = start.clone();
    for _ in 0..sweeps {
        for i in 0..problem.rows() {
            let y = problem.dense().row(i).tr_dot(&impulse) + problem.free_velocity()[i] + problem.shift()[i];
            if problem.entry(i, i) > 0.0 {
                impulse[i] -= y / problem.entry(i, i);
            }
            let contact = i / rows;
            let mu = if problem.law() == moreau_contact::problem::Law::Frictionless { 0.0 } else { problem.friction()[contact] };
            limit(&mut impulse.as_mut_slice()[contact * rows..(contact + 1) * rows], mu);
        }
    }
    impulse
}

/// What a limit may look at: one contact in the middle of a sweep.
pub(super) struct Row {
    /// μ.
    pub friction: f64,
    /// r_n \[N·s\], and that of the step before.
    pub normal: f64,
    /// r_n of the step before \[N·s\].
    pub previous: f64,
    /// u_t \[m/s\].
    pub slip: [f64; 2],
    /// W_tt \[1/kg\], the mean of both tangents.
    pub response: f64,
}

/// Turns the friction impulse that would stop the slip into the one that acts.
pub(super) type Limit = fn(&Row, [f64; 2]) -> [f64; 2];

/// Sweeps per step: the scenes and problems of these checks have at most four contacts of one body.
const SWEEPS: usize = 400;

/// Sweeps over contacts under Coulomb's law in space: r_n ← max(0, r_n − y_n/W_nn), r_t ← limit(r_t − y_t/W_tt). Other laws are left to the
/// reference.
pub(super) fn by_rows(problem: &ContactProblem, start: &DVector<f64>, limit: Limit) -> Result<Solution> {
    if problem.law() != Law::Coulomb || problem.rows_per_contact() != 3 {
        return Auto.solve(problem, Some(start));
    }
    let mut impulse = start.clone();
    for _ in 0..SWEEPS {
        (0..problem.contacts()).for_each(|contact| relax(problem, start, &mut impulse, contact, limit));
    }
    Ok(answer(problem, impulse, SWEEPS))
}

fn relax(problem: &ContactProblem, before: &DVector<f64>, impulse: &mut DVector<f64>, contact: usize, limit: Limit) {
    let n = 3 * contact;
    let mobility = |row: usize| problem.entry(row, row) + problem.row_compliance(row);
    impulse[n] = (impulse[n] - law_velocity(problem, n, impulse) / mobility(n)).max(0.0);
    let slip = [n + 1, n + 2].map(|row| law_velocity(problem, row, impulse));
    let response = 0.5 * (mobility(n + 1) + mobility(n + 2));
    let row = Row { friction: problem.friction()[contact], normal: impulse[n], previous: before[n], slip, response };
    let wanted = [0, 1].map(|k| impulse[n + 1 + k] - slip[k] / response);
    [impulse[n + 1], impulse[n + 2]] = limit(&row, wanted);
}

/// y of a row \[m/s\].
fn law_velocity(problem: &ContactProblem, row: usize, impulse: &DVector<f64>) -> f64 {
    let u = problem.dense().row(row).tr_dot(impulse) + problem.free_velocity()[row];
    u + problem.shift()[row] + problem.row_compliance(row) * impulse[row]
}

/// Coulomb's law, without a mistake.
#[cfg(test)]
pub(super) fn coulomb(row: &Row, wanted: [f64; 2]) -> [f64; 2] {
    let bound = row.friction * row.normal;
    disk(wanted, bound, bound)
}

/// The friction of Coulomb with a bound on its size.
fn disk(wanted: [f64; 2], bound: f64, sliding: f64) -> [f64; 2] {
    let size = wanted[0].hypot(wanted[1]);
    if size <= bound { wanted } else { wanted.map(|r| r * sliding / size) }
}

/// Each tangent by itself.
pub(super) fn boxed(row: &Row, wanted: [f64; 2]) -> [f64; 2] {
    let bound = row.friction * row.normal;
    wanted.map(|r| r.clamp(-bound, bound))
}

/// The bound of the step before.
pub(super) fn lagged(row: &Row, wanted: [f64; 2]) -> [f64; 2] {
    let bound = row.friction * row.previous;
    disk(wanted, bound, bound)
}

/// The friction of a contact that slides as soon as it would need more than 0.97 of what it can hold, with all of that.
pub(super) fn sliding_early(row: &Row, wanted: [f64; 2]) -> [f64; 2] {
    let bound = row.friction * row.normal;
    disk(wanted, 0.97 * bound, bound)
}

/// Less friction once it slides.
pub(super) fn kinetic(row: &Row, wanted: [f64; 2]) -> [f64; 2] {
    let bound = row.friction * row.normal;
    disk(wanted, bound, 0.8 * bound)
}

/// Sliding friction turned by half of the way to the diagonal of its quadrant, at most 22.5°.
pub(super) fn turned_to_diagonals(row: &Row, wanted: [f64; 2]) -> [f64; 2] {
    let bound = row.friction * row.normal;
    let size = wanted[0].hypot(wanted[1]);
    if size <= bound {
        return wanted;
    }
    let angle = wanted[1].atan2(wanted[0]);
    let quarter = std::f64::consts::FRAC_PI_2;
    let diagonal = ((angle / quarter).floor() + 0.5) * quarter;
    let (sine, cosine) = (0.5 * (angle + diagonal)).sin_cos();
    [bound * cosine, bound * sine]
}

/// r_t = −μ r_n u_t/√(u_t² + v_s²) with v_s = 1 cm/s, taken implicitly: u_t = u₀ + W r_t.
pub(super) fn regularised(row: &Row, wanted: [f64; 2]) -> [f64; 2] {
    let bound = row.friction * row.normal;
    let strength = bound / row.slip[0].hypot(row.slip[1]).hypot(0.01);
    wanted.map(|r| r * strength * row.response / (1.0 + strength * row.response))
}

/// The second tangent's sliding friction has the wrong sign.
pub(super) fn along_slip(row: &Row, wanted: [f64; 2]) -> [f64; 2] {
    let bound = row.friction * row.normal;
    let [first, second] = disk(wanted, bound, bound);
    if wanted[0].hypot(wanted[1]) <= bound { wanted } else { [first, -second] }
}
