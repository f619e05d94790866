//! Planted defects of the family `convergence`.

use crate::convergence::{Horizon, Stop, bouncing_ball, plastic_ball};
use crate::finding::Finding;
use crate::planted::{Beside, Kind, Planted};
use moreau_contact::contact::Components;
use moreau_contact::problem::Law;
use moreau_dynamics::schemes::assembly::{Candidate, Rules, normal_only};
use moreau_dynamics::schemes::{
    Activation, MoreauJean, RestitutionRule, Scheme, StepContext, StepProblem, StewartTrinkle, Waist, assembly, passes_the_waist,
};
use moreau_exact::Result;
use nalgebra::DVector;

/// The defects of this family.
pub const DEFECTS: &[Planted<Beside>] = &[
    Planted {
        name: "stewart-trinkle/gap-times-step",
        mistake: "the gap enters as φ·h instead of φ/h",
        kind: Kind::Assembly,
        subject: Beside {
            check: "properties/convergence",
            defective: || plastic_ball(&Altered(Mistake::GapTimesStep), Stop::On),
            reference: || plastic_ball(&StewartTrinkle::default(), Stop::On),
        },
    },
    Planted {
        name: "convergence/trapezoidal-position",
        mistake: "the constraint holds for q + h v⁺ but the position moves by ½h(v + v⁺): the ball sinks and is thrown out, at every h",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/convergence",
            defective: || plastic_ball(&Altered(Mistake::TrapezoidalPosition), Stop::On),
            reference: || plastic_ball(&StewartTrinkle::default(), Stop::On),
        },
    },
    Planted {
        name: "convergence/fixed-margin",
        mistake: "contacts are active at φ ≤ 1 cm instead of φ ≤ 0: the ball bounces above the floor by a length that does not shrink with \
            h",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/convergence",
            defective: || one_impact(&Altered(Mistake::FixedMargin)),
            reference: || one_impact(&JUDGED),
        },
    },
];

const JUDGED: MoreauJean = MoreauJean { theta: 0.5, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };

fn one_impact(subject: &dyn Scheme) -> Result<Vec<Finding>> {
    bouncing_ball(subject, &JUDGED, 0.8, Horizon::OneImpact)
}

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// Stewart–Trinkle with φ·h.
    GapTimesStep,
    /// Stewart–Trinkle with q⁺ = q + ½h(v + v⁺).
    TrapezoidalPosition,
    /// Moreau–Jean with rule A at φ ≤ 1 cm.
    FixedMargin,
}

/// A scheme with one mistake.
pub struct Altered(pub Mistake);

impl Rules for Altered {
    fn theta(&self) -> f64 {
        0.5
    }

    fn is_active(&self, candidate: &Candidate, _h: f64) -> bool {
        self.0 != Mistake::FixedMargin || candidate.contact.gap <= 0.01
    }

    fn shift(&self, candidate: &Candidate, h: f64) -> Components {
        let rows = candidate.velocity.len();
        match self.0 {
            Mistake::GapTimesStep => normal_only(candidate.contact.gap * h, rows),
            Mistake::TrapezoidalPosition => normal_only(candidate.contact.gap / h, rows),
            Mistake::FixedMargin => normal_only(candidate.contact.restitution * candidate.velocity[0], rows),
        }
    }

    fn law(&self, _rows_per_contact: usize) -> Law {
        Law::Frictionless
    }
}

impl Scheme for Altered {
    fn name(&self) -> String {
        format!("{:?}", self.0)
    }

    passes_the_waist!();
}

impl Waist for Altered {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        assembly::assemble("altered", self, at)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        let (state, h) = (at.state(), at.h());
        let used = match self.0 {
            Mistake::GapTimesStep => velocity_post.clone(),
            Mistake::TrapezoidalPosition | Mistake::FixedMargin => (velocity_post + &state.velocity) * 0.5,
        };
        at.mechanism().integrate(&at.state().position, &used, h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_contact::solvers::Auto;
    use moreau_dynamics::mechanics::{PointMass, State};
    use moreau_dynamics::schemes::simulate;
    use nalgebra::dvector;

    /// With θ=½ positions a step that reaches −δ is followed by v⁺ = δ/h: the trapezoid keeps half the landing speed.
    #[test]
    fn the_trapezoidal_ball_is_thrown_out_at_a_speed_that_does_not_shrink_with_h() {
        for steps in [100, 1000, 10_000] {
            let ball = PointMass::ball_on_floor(1.0, 9.81, 0.0);
            let initial = State { time: 0.0, position: dvector![1.0], velocity: dvector![0.0] };
            let scheme = Altered(Mistake::TrapezoidalPosition);
            let recording = simulate(&scheme, &Auto, &ball, initial, 1.0 / steps as f64, steps).expect("runs");
            let fastest = recording.samples.iter().map(|sample| sample.velocity[0]).fold(0.0, f64::max);
            assert!(fastest > 0.5, "{fastest}");
        }
    }
}
