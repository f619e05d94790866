//! The θ method: explicit Euler at 0, the midpoint rule at ½, implicit Euler at 1. As a scheme with contact it is Moreau–Jean's.
//!
//! ```text
//!     x⁺ = x + h f((1−θ) x + θ x⁺)                              spring: |R|² = (1 + (1−θ)² s²)/(1 + θ² s²)
//! ```

use super::planted::heavy;
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System, on_a_spring};
use moreau_checks::defects::schemes::HEAVY;
use moreau_dynamics::integrators::Theta;
use moreau_dynamics::schemes::{MoreauJean, Scheme};
use moreau_exact::Result;
use moreau_exact::scalar::exact;

pub static SYSTEM: System = System {
    name: "θ method, implicit Euler",
    level: ConstraintLevel::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "block projected Gauss–Seidel, accelerated",
    restitution: "Newton's e",
    position_update: "q + h(θ v⁺ + (1−θ) v)",
    schemes: &["moreau-jean"],
    held_against: &[
        Agreement {
            against: "exact rationals",
            quantity: "state after each step of a spring, θ = 0, ½ and 1, relative",
            unit: "1",
            measure: |_| over_theta(|scheme| Box::new(scheme), |scheme, theta| on_a_spring::steps(scheme, &Theta { theta: exact(theta) })),
            planted: &[heavy(|_| over_theta(too_heavy, |scheme, theta| on_a_spring::steps(scheme, &Theta { theta: exact(theta) })))],
        },
        Agreement {
            against: "closed form",
            quantity: "the spring's energy, |R|²ⁿ, θ = 0, ½ and 1, relative",
            unit: "1",
            measure: |_| over_theta(|scheme| Box::new(scheme), |scheme, theta| on_a_spring::energy(scheme, amplification(theta), 0.0)),
            planted: &[heavy(|_| over_theta(too_heavy, |scheme, theta| on_a_spring::energy(scheme, amplification(theta), 0.0)))],
        },
    ],
};

/// |R|² at s = hω.
fn amplification(theta: f64) -> f64 {
    let squared = on_a_spring::STEP.powi(2);
    (1.0 + (1.0 - theta).powi(2) * squared) / (1.0 + theta * theta * squared)
}

fn over_theta(subject: impl Fn(MoreauJean) -> Box<dyn Scheme>, measure: impl Fn(&dyn Scheme, f64) -> Result<Measured>) -> Result<Measured> {
    let measured = [0.0, 0.5, 1.0].map(|theta| measure(subject(MoreauJean { theta, ..MoreauJean::default() }).as_ref(), theta));
    let measured = measured.into_iter().collect::<Result<Vec<_>>>()?;
    Ok(Measured::worst(measured).expect("three values of θ"))
}

fn too_heavy(scheme: MoreauJean) -> Box<dyn Scheme> {
    Box::new(HEAVY.subject.of(scheme))
}
