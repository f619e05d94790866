//! Planted defects of the family `energy`: the assembled problem of Moreau–Jean, altered.

use super::schemes::Alteration;
use crate::energy::impact;
use crate::finding::Finding;
use crate::planted::{Beside, Kind, Planted};
use crate::zeno::DroppedBall;
use moreau_contact::problem::ContactProblem;
use moreau_dynamics::schemes::{Activation, MoreauJean, RestitutionRule, Scheme};
use moreau_exact::Result;

/// The defects of this family.
pub const DEFECTS: &[Planted<Beside>] = &[Planted {
    name: "energy/restitution-on-the-wrong-side",
    mistake: "0 ≤ e v⁺ + v⁻ ⟂ r ≥ 0: the ball leaves with v⁻/e and gains the factor 1/e² of energy",
    kind: Kind::Assembly,
    subject: Beside {
        check: "properties/energy",
        defective: || family(&RESTITUTION_ON_THE_WRONG_SIDE.of(SCHEME)),
        reference: || family(&SCHEME),
    },
}];

const RESTITUTION: f64 = 0.5;
const SCHEME: MoreauJean = MoreauJean { theta: 0.5, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };

/// The family's check of a scheme on a ball of 2 kg with e = ½.
///
/// # Errors
/// Those of the scheme.
pub fn family(subject: &dyn Scheme) -> Result<Vec<Finding>> {
    let ball = DroppedBall { mass: 2.0, gravity: 9.81, height: 1.0, restitution: RESTITUTION };
    impact(subject, &SCHEME, &ball, 0.01)
}

/// The scheme that the family's check is about.
pub fn judged() -> MoreauJean {
    SCHEME
}

/// y = e u⁺ + u⁻ has the zeros of y = u⁺ + u⁻/e, and u⁻ = shift/e; for e = ½.
pub const RESTITUTION_ON_THE_WRONG_SIDE: Alteration = Alteration {
    posed: |_, mut step| {
        let divided = |problem: ContactProblem| {
            let shift = problem.shift() / (RESTITUTION * RESTITUTION);
            problem.into_builder().shift(shift).build()
        };
        step.problem = step.problem.map(divided).transpose()?;
        Ok(step)
    },
    ..Alteration::NONE
};
