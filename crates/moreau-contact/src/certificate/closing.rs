//! The velocity that is complementary to the normal impulse.
//!
//! ```text
//!     w = y_n  (frictionless, Coulomb) ,    y_n − μ‖y_t‖  (associated) ,    y_n + μ min_j Dⱼ·y_t  (polyhedral associated)     [m/s]
//! ```

use crate::cones::polyhedral::direction;
use crate::cones::second_order::tangential_norm;
use crate::problem::Law;

/// The velocity at which these make the contact close \[m/s\]: q_n, reduced by the slip under the associated laws. Its rounding is 8ε of
/// its terms.
pub(super) fn closing(law: Law, mu: f64, q: &[f64]) -> f64 {
    match law {
        Law::Associated => q[0] - mu * tangential_norm(q),
        Law::PolyhedralAssociated { directions } => {
            let tangents = [q.get(1), q.get(2)].map(|q| q.copied().unwrap_or(0.0));
            let along = |j: usize| direction(j, directions).iter().zip(tangents).map(|(d, q)| d * q).sum::<f64>();
            q[0] + mu * (0..directions).map(along).fold(0.0, f64::min)
        }
        _ => q[0],
    }
}
