//! XPBD and PBD: contact as a projection of positions, velocities read off them.
//!
//! ```text
//!     q⁺ = q + h v_free + M⁻¹HᵀΛ ,   0 ≤ Λ ⟂ φ(q⁺) + (α/h²) Λ ≥ 0 ,   v = (q⁺ − q)/h
//! ```

use super::planted::{Kind, mistake};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System};
use moreau_contact::solvers::Auto;
use moreau_dynamics::mechanics::{PointMass, State};
use moreau_dynamics::schemes::{PositionBased, Softness, simulate, step};
use moreau_exact::Result;
use moreau_exact::tolerance::rounding;
use moreau_forms::PositionBasedContact;
use nalgebra::dvector;

pub static SYSTEM: System = System {
    name: "XPBD, PBD",
    level: ConstraintLevel::Position,
    cone: Cone::SecondOrder,
    law: ContactLaw::Compliant,
    algorithm: "projected Gauss–Seidel on positions, gaps taken anew",
    restitution: "e on the velocity after the positions, 0 below 2 g h",
    position_update: "q + h v_free + M⁻¹HᵀΛ, v = (q⁺ − q)/h",
    schemes: &["xpbd", "pbd"],
    held_against: &[
        Agreement {
            against: "closed form",
            quantity: "rest depth under XPBD, α m g at every h",
            unit: "m",
            measure: |_| depth(xpbd(COMPLIANCE), |contact| contact.rest_depth_of_compliance(COMPLIANCE)),
            planted: &[mistake(Kind::Assembly, "systems/compliance-larger", "a compliance 1 % larger", |_| {
                depth(xpbd(1.01 * COMPLIANCE), |contact| contact.rest_depth_of_compliance(COMPLIANCE))
            })],
        },
        Agreement {
            against: "closed form",
            quantity: "rest depth under PBD, g h² (1−s)^k/(1−(1−s)^k)",
            unit: "m",
            measure: |_| depth(pbd(3), |contact| contact.rest_depth_of_share(0.5, 3)),
            planted: &[mistake(Kind::Solver, "systems/four-sweeps", "four sweeps in place of three", |_| {
                depth(pbd(4), |contact| contact.rest_depth_of_share(0.5, 3))
            })],
        },
        Agreement {
            against: "closed form",
            quantity: "velocity after the step of an impact, e|v − g h|",
            unit: "m/s",
            measure: |_| rebound(xpbd(0.0), 0.5),
            planted: &[mistake(Kind::Reader, "systems/restitution-off", "e = 0.5 taken for 0.51", |_| rebound(xpbd(0.0), 0.51))],
        },
    ],
};

/// α \[m/N\].
const COMPLIANCE: f64 = 0.0001;
const GRAVITY: f64 = 9.81;

fn xpbd(compliance: f64) -> PositionBased {
    PositionBased { softness: Softness::Compliance(compliance), sweeps: 20 }
}

fn pbd(sweeps: usize) -> PositionBased {
    PositionBased { softness: Softness::Share(0.5), sweeps }
}

/// Where 2 kg come to rest, at two steps.
fn depth(scheme: PositionBased, expected: impl Fn(&PositionBasedContact) -> f64) -> Result<Measured> {
    let mut found = Vec::new();
    for h in [0.01, 0.0025] {
        let ball = PointMass::ball_on_floor(2.0, GRAVITY, 0.0);
        let start = State { time: 0.0, position: dvector![0.0], velocity: dvector![0.0] };
        let end = simulate(&scheme, &Auto, &ball, start, h, 4000)?.last().position[0];
        let expected = expected(&PositionBasedContact { mass: 2.0, gravity: GRAVITY, time_step: h });
        found.push(Measured::within((end + expected).abs(), rounding(512, expected)));
    }
    Ok(Measured::worst(found).expect("two steps"))
}

/// Velocities after one step into the floor.
fn rebound(scheme: PositionBased, restitution: f64) -> Result<Measured> {
    let mut found = Vec::new();
    for (gap, speed, h) in [(0.05, -2.0, 0.0625), (0.001, -0.3, 0.01), (0.0, -0.1, 0.0625)] {
        let ball = PointMass::ball_on_floor(2.0, GRAVITY, 0.5);
        let start = State { time: 0.0, position: dvector![gap], velocity: dvector![speed] };
        let after = step(&scheme, &Auto, &ball, &start, h)?.state.velocity[0];
        let exact = PositionBasedContact { mass: 2.0, gravity: GRAVITY, time_step: h }.rebound(restitution, speed);
        found.push(Measured::within((after - exact).abs(), rounding(64, 4.0)));
    }
    Ok(Measured::worst(found).expect("three landings"))
}
