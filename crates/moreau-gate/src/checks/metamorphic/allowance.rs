//! What the checks of the family share: how often they look, and what a covariant engine may leave.

use crate::checks::metamorphic::compare::Differences;
use crate::checks::metamorphic::scenes::{ARM, DURATION, SPEED};
use crate::tolerance::metamorphic as tolerance;

/// Samples of a motion.
pub(super) const SAMPLES: usize = 20;

/// What a covariant engine may leave.
pub(super) fn allowance() -> Differences {
    Differences::of_velocity(tolerance::velocity(SPEED, crate::checks::scenery::GRAVITY, DURATION), DURATION, ARM)
}
