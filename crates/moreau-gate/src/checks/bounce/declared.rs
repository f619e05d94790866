//! What a declared law makes of an impact: thresholds, error reduction, force mixing, damping.
//!
//! ```text
//!     e' from e − c (1 + e), or 0 below a threshold, to e + push/v ;    damping takes at most c T of a velocity in the time T
//! ```

use crate::checks::bounce::scene::RESTITUTION;
use crate::checks::impact::softness;
use crate::checks::scenery::between;
use crate::model::Model;
use crate::{Bench, Expectation};

/// What a declared law may make of a restitution and of velocities.
pub(super) struct Declared {
    /// Least and greatest effective restitution.
    pub restitution: [f64; 2],
    /// Part of a velocity that declared damping may take.
    pub drag: f64,
}

impl Declared {
    /// For an impact at `approach` \[m/s\] within a motion over `time` \[s\]; `None` if nothing is declared that changes it.
    pub fn of(bench: &Bench, approach: f64, time: f64, h: f64) -> Option<Self> {
        let Model::Coulomb(limits) = Model::of(bench.description()) else { return None };
        let drag = (limits.linear_damping.max(limits.angular_damping) * time).min(1.0);
        let kept = |speed: f64| if speed <= limits.slowest_bounce(RESTITUTION) { 0.0 } else { RESTITUTION };
        let [push, mixing] = softness(bench, approach, h);
        let least = kept(approach * (1.0 - drag));
        let restitution = [least - mixing * (1.0 + least), kept(approach) + push];
        (restitution != [RESTITUTION; 2] || drag > 0.0).then_some(Declared { restitution, drag })
    }

    /// The prediction of v⁺/v, with the allowance of the ideal.
    pub fn rebound(&self, allowed: f64) -> Expectation {
        let [low, high] = self.restitution;
        between([low - self.drag * low.abs(), high], allowed, "the declared thresholds, force mixing, error reduction and damping")
    }

    /// Something of this size that only damping changes.
    pub fn damped(&self, ideal: &Expectation, size: f64) -> Option<Expectation> {
        let tolerance = ideal.tolerance + self.drag * size;
        (self.drag > 0.0).then(|| Expectation { tolerance, why: "the declared damping".into(), ..ideal.clone() })
    }
}
