//! Planted defects of the family `energy`: the assembled problem of Moreau–Jean, altered.

use crate::planted::{Beside, Kind, Planted};
use crate::energy::impact;
use crate::finding::Finding;
use crate::zeno::DroppedBall;
use moreau_contact::problem::ContactProblem;
use moreau_dynamics::schemes::{Activation, MoreauJean, RestitutionRule, Scheme, StepContext, StepProblem, Waist, passes_the_waist};
use moreau_exact::Result;
use nalgebra::DVector;

/// The defects of this family.
pub const DEFECTS: &[Planted<Beside>] = &[
    Planted {
        name: "energy/restitution-on-the-wrong-side",
        mistake: "0 ≤ e v⁺ + v⁻ ⟂ r ≥ 0: the ball leaves with v⁻/e and gains the factor 1/e² of energy",
        kind: Kind::Assembly,
        subject: Beside {
            check: "properties/energy",
            defective: || family(&Misassembled { base: SCHEME, alter: restitution_on_the_wrong_side }),
            reference: || family(&SCHEME),
        },
    },
    Planted {
        name: "energy/delassus-with-mass",
        mistake: "W = H M Hᵀ instead of H M⁻¹ Hᵀ: right only for m = 1",
        kind: Kind::Assembly,
        subject: Beside {
            check: "properties/energy",
            defective: || family(&Misassembled { base: SCHEME, alter: delassus_with_mass }),
            reference: || family(&SCHEME),
        },
    },
    Planted {
        name: "energy/restitution-of-the-free-velocity",
        mistake: "e multiplies v_free instead of v: each bounce gains e g h of speed",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy",
            defective: || family(&Misassembled { base: SCHEME, alter: restitution_of_the_free_velocity }),
            reference: || family(&SCHEME),
        },
    },
    Planted {
        name: "energy/restitution-forgotten",
        mistake: "the shift e v is left out: every impact is plastic",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy",
            defective: || family(&Misassembled { base: SCHEME, alter: restitution_forgotten }),
            reference: || family(&SCHEME),
        },
    },
];

const RESTITUTION: f64 = 0.5;
const SCHEME: MoreauJean = MoreauJean { theta: 0.5, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };

fn family(subject: &dyn Scheme) -> Result<Vec<Finding>> {
    let ball = DroppedBall { mass: 2.0, gravity: 9.81, height: 1.0, restitution: RESTITUTION };
    impact(subject, &SCHEME, &ball, 0.01)
}

/// y = e u⁺ + u⁻ has the zeros of y = u⁺ + u⁻/e, and u⁻ = shift/e; for e = ½.
pub fn restitution_on_the_wrong_side(problem: ContactProblem) -> Result<ContactProblem> {
    let shift = problem.shift() / (RESTITUTION * RESTITUTION);
    problem.into_builder().shift(shift).build()
}

fn delassus_with_mass(problem: ContactProblem) -> Result<ContactProblem> {
    let Some(dynamics) = problem.dynamics() else { return Ok(problem) };
    let delassus = &dynamics.jacobian * &dynamics.mass * dynamics.jacobian.transpose();
    problem.into_builder().delassus(delassus).build()
}

fn restitution_of_the_free_velocity(problem: ContactProblem) -> Result<ContactProblem> {
    let shift = problem.free_velocity() * RESTITUTION;
    problem.into_builder().shift(shift).build()
}

/// A mistake: the shift e u⁻ is left out.
pub fn restitution_forgotten(problem: ContactProblem) -> Result<ContactProblem> {
    let shift = DVector::zeros(problem.rows());
    problem.into_builder().shift(shift).build()
}

/// Moreau–Jean whose contact problem is altered before it is solved.
pub struct Misassembled {
    /// The scheme that assembles it correctly.
    pub base: MoreauJean,
    /// What is done to the problem.
    pub alter: fn(ContactProblem) -> Result<ContactProblem>,
}

impl Scheme for Misassembled {
    fn name(&self) -> String {
        format!("{}, altered", self.base.name())
    }

    passes_the_waist!();
}

impl Waist for Misassembled {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        let mut assembled = self.base.assemble(at)?;
        assembled.problem = assembled.problem.map(self.alter).transpose()?;
        Ok(assembled)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        self.base.advance(at, velocity_post)
    }
}
