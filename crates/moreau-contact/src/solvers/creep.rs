//! Leaps along a creep of proximal points.
//!
//! ```text
//!     p_k = P(c_k) ,   d_k = p_k − c_k ,       c_k+1 = P_K(p_k + ℓ d_k)   where ‖d_k − d_k−1‖ ≤ ½ ‖d_k−1‖ ,   otherwise c_k+1 = p_k
//! ```
//! with P the proximal map, which has the solutions as its fixed points, and P_K the projection on the cone of the law. Where a load can
//! wander between contacts of the same two bodies while hardly anything slips, point after point moves by nearly the same small step, a
//! hundred thousand times, until a contact opens or sticks. Then ℓ = 2, 4, 8, …: each point tells by its own step whether the creep goes
//! on there. It is over where the step is another one, as it is where a leap was too long. Where nothing is found around a centre that was leapt
//! to, the leap is taken back, and the next one is an eighth as long as the one after it would have been.
//!
//! The leaps change where the next point is looked for and nothing of what a solution is: a fixed point of P is one however it was found.

use crate::problem::ContactProblem;
use nalgebra::DVector;

/// Part of the last step by which this one may differ from it for the two to be one creep.
const STRAIGHT: f64 = 0.5;

/// The last step of the points, and how far was leapt along it.
#[derive(Default)]
pub(super) struct Creep {
    /// d of the last point, none before the first.
    step: Option<DVector<f64>>,
    /// ℓ of the last leap, zero where there was none.
    length: f64,
    /// The point that was left for the centre that is tried now.
    left: Option<DVector<f64>>,
}

impl Creep {
    /// Whether the centre that is tried now was leapt to.
    pub(super) fn has_leapt(&self) -> bool {
        self.left.is_some()
    }

    /// The centre after the point that was found around this one; the point itself where residuals fall by themselves.
    pub(super) fn next(&mut self, problem: &ContactProblem, centre: &DVector<f64>, point: DVector<f64>, falls: bool) -> DVector<f64> {
        let step = &point - centre;
        let goes_on = self.step.as_ref().is_some_and(|last| (&step - last).norm() <= STRAIGHT * last.norm());
        self.left = None;
        let mut next = point;
        if goes_on && !falls {
            self.length = (2.0 * self.length).max(2.0);
            self.left = Some(next.clone());
            next.axpy(self.length, &step, 1.0);
            super::project(problem, &mut next);
        } else {
            self.length = 0.0;
        }
        self.step = Some(step);
        next
    }

    /// The point from which the centre was leapt to around which nothing was found.
    pub(super) fn take_back(&mut self) -> Option<DVector<f64>> {
        self.length /= 4.0;
        self.left.take()
    }
}
