//! Planted defects of the family `zeno`.

use crate::finding::Finding;
use crate::planted::{Beside, Kind, Planted};
use crate::tolerance::zeno;
use crate::zeno::{DroppedBall, absorption};
use moreau_contact::contact::Components;
use moreau_contact::problem::Law;
use moreau_contact::solvers::ProjectedGaussSeidel;
use moreau_dynamics::schemes::assembly::{Candidate, Rules, normal_only};
use moreau_dynamics::schemes::{
    Activation, MoreauJean, RestitutionRule, Scheme, StepContext, StepProblem, Waist, assembly, passes_the_waist, simulate,
};
use moreau_exact::Result;
use nalgebra::DVector;

/// The defects of this family.
pub const DEFECTS: &[Planted<Beside>] = &[Planted {
    name: "rest/rule-c",
    mistake: "activates a contact when φ + h v ≤ 0 and v ≤ 0: at rest every second step is free and the body sinks",
    kind: Kind::Scheme,
    subject: Beside { check: "properties/zeno", defective: || family(&RULE_C), reference: || family(&JUDGED) },
}];

const JUDGED: MoreauJean =
    MoreauJean { theta: 1.0, activation: Activation::FreeVelocityForecast, restitution: RestitutionRule::NormalOnly };

/// The scheme that the family's check is about.
pub fn judged() -> MoreauJean {
    JUDGED
}

/// The family's check of a scheme on a ball with e = ½.
///
/// # Errors
/// Those of the scheme.
pub fn family(subject: &dyn Scheme) -> Result<Vec<Finding>> {
    let ball = DroppedBall { mass: 1.0, gravity: 9.81, height: 1.0, restitution: 0.5 };
    absorption(subject, &JUDGED, &ball, 0.01, 100)
}

/// Rule C on Moreau–Jean with θ = 1.
pub const RULE_C: Altered = Altered { base: JUDGED, mistake: Mistake::ApproachingOnly };

/// The speed at which a ball sinks, over the last two of [`zeno::SINKING_STEPS`] steps, against g h (1−e)/(2(1+e)) of rule C.
///
/// # Errors
/// Those of the scheme and the solver.
pub fn sinking(rule: &dyn Scheme, ball: &DroppedBall, h: f64) -> Result<Finding> {
    let (mechanism, initial) = ball.at_rest();
    let steps = zeno::SINKING_STEPS;
    let recording = simulate(rule, &ProjectedGaussSeidel::default(), &mechanism, initial, h, steps)?;
    let position = |k: usize| recording.samples[k].position[0];
    let fall = ball.gravity * h;
    let speed = (position(steps - 2) - position(steps)) / (2.0 * h);
    let tolerance = zeno::sinking_error(position(steps).abs(), ball.gravity, h, ball.restitution);
    Ok(Finding::equal("sinking speed under φ + hv ≤ 0, v ≤ 0", speed, fall * zeno::sinking_speed(ball.restitution), tolerance, "m/s"))
}

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// Rule C: active when φ + h v ≤ 0 and v ≤ 0.
    ApproachingOnly,
    /// Shift e v_free instead of e v.
    FreeVelocity,
}

/// Moreau–Jean with one mistake.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Altered {
    /// The scheme without the mistake.
    pub base: MoreauJean,
    /// The mistake.
    pub mistake: Mistake,
}

impl Rules for Altered {
    fn theta(&self) -> f64 {
        self.base.theta
    }

    fn is_active(&self, candidate: &Candidate, h: f64) -> bool {
        let (gap, speed) = (candidate.contact.gap, candidate.velocity[0]);
        match self.mistake {
            Mistake::ApproachingOnly => gap + h * speed <= 0.0 && speed <= 0.0,
            Mistake::FreeVelocity => self.base.is_active(candidate, h),
        }
    }

    fn shift(&self, candidate: &Candidate, h: f64) -> Components {
        match self.mistake {
            Mistake::ApproachingOnly => self.base.shift(candidate, h),
            Mistake::FreeVelocity => {
                let reversed = candidate.contact.restitution * candidate.free_velocity[0];
                normal_only(reversed, candidate.velocity.len())
            }
        }
    }

    fn law(&self, rows_per_contact: usize) -> Law {
        self.base.law(rows_per_contact)
    }
}

impl Scheme for Altered {
    fn name(&self) -> String {
        format!("{} with {:?}", self.base.name(), self.mistake)
    }

    passes_the_waist!();
}

impl Waist for Altered {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        assembly::assemble("altered moreau-jean", self, at)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        self.base.advance(at, velocity_post)
    }
}
