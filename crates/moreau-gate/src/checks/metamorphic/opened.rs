//! Contacts that open in one motion and not in its image, because a step takes their depth back.
//!
//! ```text
//!     n levels of contacts whose depths are taken back to rounding :   ‖v − v'‖ ≤ 2 n v_pushed
//! ```

use crate::Bench;
use crate::checks::metamorphic::compare::Differences;
use crate::checks::metamorphic::scenes::{ARM, DURATION};
use crate::checks::scenery::GRAVITY;
use crate::model::Model;
use crate::tolerance::metamorphic as tolerance;
use crate::tolerance::rest::pushed_velocity;

/// What corrections of depths may change, for a transformation that leaves the directions as they are.
pub(super) fn opened(bench: &Bench, h: f64) -> Option<Differences> {
    opening(bench, h, 1).map(|velocity| Differences::of_velocity(velocity, DURATION, ARM))
}

/// The velocity \[m/s\] of contacts that have opened in one motion and not in the other, because nothing was left of their depth but
/// rounding and what solvers leave: both move at up to [`pushed_velocity`], level by level.
pub(super) fn opening(bench: &Bench, h: f64, levels: usize) -> Option<f64> {
    let Model::Coulomb(limits) = Model::of(bench.description()) else { return None };
    let steps = DURATION / h;
    tolerance::vanishes(limits.taken_back(), steps).then(|| 2.0 * levels as f64 * pushed_velocity(GRAVITY, h))
}
