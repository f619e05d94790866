//! Stronge's law: the normal impulse gives back e² of the work that compression took from the bodies.
//!
//! ```text
//!     ∫_{p_c}^{p} U_n dp = −e² ∫_0^{p_c} U_n dp ,     along Routh's path
//!     U_n dU_n = k U_n dp  on a piece of slope k:     U_n² = U_n,start² + 2 k (work still due)
//! ```
//! U_n⁺² is rational where the data are; U_n⁺ and the impulse need a square root.

use super::impact::check_restitution;
use super::routh::{Path, PathState};
use moreau_contact::problem::Response;
use moreau_exact::Result;
use moreau_exact::scalar::Scalar;

/// The end of restitution: a piece of the path, and the squared normal velocity there.
#[derive(Clone, Debug, PartialEq)]
pub struct End<T: Scalar> {
    /// The end of compression, or the start of a later piece: where the last stretch begins.
    pub start: PathState<T>,
    /// dU_n/dp on it \[1/kg\].
    pub slope: T,
    /// U_n⁺² \[m²/s²\].
    pub speed_squared: T,
}

/// Work of the normal impulse in compression, ∫_0^{p_c} U_n dp < 0 \[J\].
pub fn compression_work<T: Scalar>(path: &Path<T>) -> T {
    path.normal_work(&T::zero(), &path.compression_end())
}

/// The end of restitution with the energetic coefficient e.
///
/// # Errors
/// [`moreau_exact::Error::Invalid`] for e outside \[0, 1\].
///
/// # Source
/// Stronge, *Rigid body collisions with friction*, Proc. R. Soc. A 431 (1990).
pub fn end<T: Scalar>(path: &Path<T>, restitution: &T) -> Result<End<T>> {
    check_restitution(std::slice::from_ref(restitution), 1)?;
    let mut due = -restitution.clone() * restitution.clone() * compression_work(path);
    let mut start = path.compression_end();
    for piece in path.pieces() {
        let Some(last) = piece.end.clone().filter(|last| *last > start) else { continue };
        let work = path.normal_work(&start, &last);
        if work >= due {
            return Ok(finish(path, &start, &due));
        }
        due -= work;
        start = last;
    }
    Ok(finish(path, &start, &due))
}

fn finish<T: Scalar>(path: &Path<T>, at: &T, due: &T) -> End<T> {
    let slope = path.piece_after(at).slopes.normal.clone();
    let start = path.state(at);
    let speed_squared = start.normal.clone() * start.normal.clone() + T::ratio(2, 1) * slope.clone() * due.clone();
    End { start, slope, speed_squared }
}

/// The impact of one planar contact with Coulomb friction.
///
/// # Errors
/// As [`end`].
pub fn along(path: &Path<f64>, restitution: f64) -> Result<Response<f64>> {
    let end = end(path, &restitution)?;
    let impulse = end.start.impulse + (end.speed_squared.sqrt() - end.start.normal) / end.slope;
    Ok(path.outcome(&impulse))
}
