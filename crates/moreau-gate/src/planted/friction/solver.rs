//! A projected Gauss–Seidel solver with the limit of friction left open.

use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::ContactSolver;
use moreau_exact::Result;
use nalgebra::DVector;

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

/// Sweeps over contacts: r_n ← max(0, r_n − y_n/W_nn), r_t ← limit(r_t − u_t/W_tt).
pub(super) struct RowByRow(pub Limit);

/// Sweeps per step: the scenes of these checks have at most four contacts of one body.
const SWEEPS: usize = 400;

impl ContactSolver for RowByRow {
    /// The name of the solver it stands in for.
    fn name(&self) -> &'static str {
        "auto"
    }

    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let before = warm_start.cloned().unwrap_or_else(|| DVector::zeros(problem.rows()));
        let mut impulse = before.clone();
        for _ in 0..SWEEPS {
            for contact in 0..problem.contacts() {
                self.relax(problem, &before, &mut impulse, contact);
            }
        }
        let velocity = problem.velocity(&impulse);
        Ok(Solution::new("auto", impulse, velocity, SWEEPS))
    }
}

impl RowByRow {
    fn relax(&self, problem: &ContactProblem, before: &DVector<f64>, impulse: &mut DVector<f64>, contact: usize) {
        let (rows, matrix) = (problem.rows_per_contact(), problem.dense());
        let velocity = |row: usize, impulse: &DVector<f64>| matrix.row(row).tr_dot(impulse) + problem.free_velocity()[row];
        let n = rows * contact;
        impulse[n] = (impulse[n] - (velocity(n, impulse) + problem.shift()[n]) / matrix[(n, n)]).max(0.0);
        if rows != 3 {
            return;
        }
        let slip = [n + 1, n + 2].map(|row| velocity(row, impulse));
        let response = 0.5 * (matrix[(n + 1, n + 1)] + matrix[(n + 2, n + 2)]);
        let row = Row { friction: problem.friction()[contact], normal: impulse[n], previous: before[n], slip, response };
        let wanted = [0, 1].map(|k| impulse[n + 1 + k] - slip[k] / response);
        let limited = (self.0)(&row, wanted);
        impulse[n + 1] = limited[0];
        impulse[n + 2] = limited[1];
    }
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
