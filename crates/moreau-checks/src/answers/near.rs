//! Answers that are none: one contact of an exact answer is changed, or the velocity that is told with it.

use super::posed::Posed;
use moreau_contact::problem::Solution;
use nalgebra::DVector;

/// How one contact of an answer is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// r (1 + δ) of a loaded contact.
    Heavier,
    /// r (1 − δ).
    Lighter,
    /// r_n = δ/W_nn at a contact without load.
    Push,
    /// r_n = −δ/W_nn there.
    Pull,
    /// r_t turned by δ where it rubs.
    Turn,
    /// r_t (1 − δ).
    Weaken,
    /// r_t (1 + δ).
    Strengthen,
    /// −r_t.
    Flip,
    /// r = 0.
    Forget,
    /// r_t = δ r_n where the law allows no friction.
    Rub,
    /// u of the first row told δ m/s too large.
    Told,
    /// The first impulse of the contact is not a number.
    NotANumber,
}

/// Every change.
pub const CHANGES: [Change; 12] = [
    Change::Heavier,
    Change::Lighter,
    Change::Push,
    Change::Pull,
    Change::Turn,
    Change::Weaken,
    Change::Strengthen,
    Change::Flip,
    Change::Forget,
    Change::Rub,
    Change::Told,
    Change::NotANumber,
];

/// The sizes δ of a change. The least is a hundred times the tolerance of the certificate; a rule that squares a residual sees 2⁻¹⁴ as
/// 4·10⁻⁹, which is below that tolerance.
pub const SIZES: [f64; 3] = [1.0 / 1024.0, 1.0 / 16384.0, 1.0 / 1_048_576.0];

/// The exact answer, told as it is.
pub fn exact(posed: &Posed) -> Solution {
    told(posed, posed.impulse.clone())
}

fn told(posed: &Posed, impulse: DVector<f64>) -> Solution {
    let velocity = posed.problem.velocity(&impulse);
    Solution::new("exact", impulse, velocity, 0)
}

/// The answer with contact k changed by δ; none where the change does not apply.
pub fn changed(posed: &Posed, change: Change, k: usize, delta: f64) -> Option<Solution> {
    let rows = posed.problem.rows_per_contact();
    let n = k * rows;
    let mut r = posed.impulse.clone();
    let loaded = r[n] > 0.0;
    let rubs = (n + 1..n + rows).any(|i| r[i] != 0.0);
    let mobility = posed.problem.entry(n, n);
    match change {
        Change::Heavier if loaded => r.rows_mut(n, rows).scale_mut(1.0 + delta),
        Change::Lighter if loaded => r.rows_mut(n, rows).scale_mut(1.0 - delta),
        Change::Push if !loaded => r[n] = delta / mobility,
        Change::Pull if !loaded => r[n] = -delta / mobility,
        Change::Turn if rubs && rows == 3 => {
            let (sine, cosine) = delta.sin_cos();
            (r[n + 1], r[n + 2]) = (cosine * r[n + 1] - sine * r[n + 2], sine * r[n + 1] + cosine * r[n + 2]);
        }
        Change::Weaken if rubs => r.rows_mut(n + 1, rows - 1).scale_mut(1.0 - delta),
        Change::Strengthen if rubs => r.rows_mut(n + 1, rows - 1).scale_mut(1.0 + delta),
        Change::Flip if rubs => r.rows_mut(n + 1, rows - 1).neg_mut(),
        Change::Forget if loaded => r.rows_mut(n, rows).fill(0.0),
        Change::Rub if loaded && !rubs && rows > 1 => r[n + 1] = delta * r[n],
        Change::NotANumber => r[n] = f64::NAN,
        Change::Told => {
            let mut solution = exact(posed);
            solution.velocity[n] += delta * (posed.problem.free_velocity().amax() + 1.0);
            return Some(solution);
        }
        _ => return None,
    }
    Some(told(posed, r))
}
