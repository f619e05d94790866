//! Leaps along a creep of proximal points.
//!
//! ```text
//!     p_k = P(c_k) ,   d_k = p_k − c_k ,       c_k+1 = P_K(p_k + ℓ d_k)   where ‖d_k − d_k−1‖ ≤ ½ ‖d_k−1‖ ,   otherwise c_k+1 = p_k
//! ```
//! with P the proximal map, which has the solutions as its fixed points, and P_K the projection on the cone of the law. Where a load can
//! wander between contacts of the same two bodies while hardly anything slips, point after point moves by nearly the same small step, a
//! hundred thousand times, until a contact opens or sticks. Then ℓ = 2, 4, 8, …: each point tells by its own step whether the creep goes
//! on there. It is over where the step is another one, as it is where a leap was too long. Where nothing is found around a centre that was
//! leapt to, the leap is taken back, and the next one is shorter.
//!
//! The leaps change where the next point is looked for and nothing of what a solution is: a fixed point of P is one however it was found.

use crate::problem::ContactProblem;
use crate::tolerance::newton::{LEAPS_GROW, LEAPS_SHRINK, STRAIGHT};
use nalgebra::DVector;

/// The last step of the points, and how far was leapt along it.
#[derive(Default)]
pub(super) struct Creep {
    /// d of the last point, none before the first.
    step: Option<DVector<f64>>,
    /// ℓ of the last leap, zero where there was none.
    length: f64,
    /// How many points in a row went straight on, and how many leaps in a row were taken back.
    straight: usize,
    failed: usize,
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
        self.straight = if goes_on { self.straight + 1 } else { 0 };
        if self.left.take().is_some() && goes_on {
            self.failed = 0;
        }
        let mut next = point;
        if !falls && self.straight > self.failed {
            self.length = LEAPS_GROW * self.length.max(1.0);
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
        let left = self.left.take()?;
        self.length /= LEAPS_SHRINK;
        (self.failed, self.straight) = (self.failed + 1, 0);
        Some(left)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Law;
    use crate::solvers::test_problems::point;
    use nalgebra::dvector;

    /// A map whose points creep by a thousandth of r_n until the contact opens: P(c) = c − (2⁻¹⁰, 0, 0), at least zero.
    fn crept(centre: &DVector<f64>) -> DVector<f64> {
        dvector![(centre[0] - 1.0 / 1024.0).max(0.0), 0.0, 0.0]
    }

    /// Points until r_n = 0 from r_n = 1.
    fn points(falls: bool) -> usize {
        let (problem, mut creep, mut centre) =
            (point(Law::Coulomb, 0.5, dvector![1.0, 0.0, 0.0]), Creep::default(), dvector![1.0, 0.0, 0.0]);
        (1..)
            .find(|_| {
                let point = crept(&centre);
                let is_open = point[0] == 0.0;
                centre = creep.next(&problem, &centre, point, falls);
                is_open
            })
            .expect("it comes nearer with every point")
    }

    #[test]
    fn what_creeps_a_thousand_points_is_there_after_a_few_and_what_falls_by_itself_is_left_alone() {
        // one point, nine from each of which 2, 4, …, 512 steps are leapt, 1 022 in all, and the one that opens
        assert_eq!(points(false), 1 + 9 + 1);
        assert_eq!(points(true), 1024);
    }

    #[test]
    fn a_step_that_turns_ends_the_leaps_and_one_that_found_nothing_is_taken_back() {
        let (problem, mut creep) = (point(Law::Coulomb, 0.5, dvector![1.0, 0.0, 0.0]), Creep::default());
        let step = dvector![-0.0625, 0.0, 0.0];
        let next = |creep: &mut Creep, from: f64, step: &DVector<f64>| {
            let centre = dvector![from, 0.0, 0.0];
            creep.next(&problem, &centre, &centre + step, false)
        };
        assert_eq!(next(&mut creep, 1.0, &step), dvector![0.9375, 0.0, 0.0], "one step tells nothing");
        assert_eq!(next(&mut creep, 0.9375, &step), dvector![0.875 - 2.0 * 0.0625, 0.0, 0.0]);
        assert!(creep.has_leapt());
        // the step after a leap turned round: the creep is over
        assert_eq!(next(&mut creep, 0.75, &-&step), dvector![0.8125, 0.0, 0.0]);
        assert!(!creep.has_leapt() && creep.take_back().is_none());
        next(&mut creep, 0.8125, &-&step);
        assert_eq!(creep.take_back(), Some(dvector![0.875, 0.0, 0.0]), "the point before the leap");
        assert!(!creep.has_leapt());
    }

    #[test]
    fn a_leap_ends_at_the_cone() {
        let (problem, mut creep, centre) = (point(Law::Coulomb, 0.5, dvector![1.0, 0.0, 0.0]), Creep::default(), dvector![1.0, 0.25, 0.0]);
        let step = dvector![-0.375, 0.0, 0.0];
        creep.next(&problem, &centre, &centre + &step, false);
        let leapt = creep.next(&problem, &(&centre + &step), &centre + &step * 2.0, false);
        assert!(leapt[0] >= 0.0 && leapt[1] <= 0.5 * leapt[0] + f64::EPSILON, "{leapt}");
    }
}
