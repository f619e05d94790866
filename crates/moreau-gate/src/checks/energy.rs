//! Energy: a passive world never gains any.
//!
//! ```text
//!     E = ½ m‖v‖² + ½ ωᵀJω + m g z ,    E_σ = E − σ g h m v_z      with the σ that the flight before the first contact shows
//!     ΔE_σ = r·u⁺ − (½ ‖p‖²/m − ½ h g p_z) − ½ ℓᵀJ⁻¹ℓ  ≤  max(0, ½ h g p_z − ½ p_z²/m) + ½ ω²ρ h R
//! ```
//! E_σ is what the observed scheme keeps, p its impulse in the step: see `checks::tumbling`, whose law of a step this is. The body is a
//! cube, whose gyroscopic torque is zero: the error of a rotation scheme plays no part.

use crate::check::{Control, Expected, Run};
use crate::checks::scenery::{cuboid, over_floor};
use crate::checks::tumbling::{Tumble, passive_rise};
use crate::{Bench, Check, Kind, Level, Measurement, Reply};

/// Half the edge of the cube \[m\].
const HALF: f64 = 0.1;
/// Height of the centre at the start \[m\].
const HEIGHT: f64 = 0.3;
/// μ.
const FRICTION: f64 = 0.4;
/// Duration of the motion \[s\].
const DURATION: f64 = 0.5;

/// The checks of the family.
pub const CHECKS: &[Check] = &[Check {
    name: "energy/passive",
    level: Level::Simulate,
    question: "Does the energy of a cube that tumbles onto a rough floor ever rise?",
    derivation: "Contacts without restitution do no positive work. A scheme that moves on with (½ + σ) v⁺ + (½ − σ) v keeps E − σ g h m \
        v_z in flight; the σ that the flight shows is taken. A step with the impulse p may raise it by ½ h g p_z − ½ p_z²/m, where that is \
        positive, and by R u if corners that have turned below the floor by ½ ω²ρ h² are pushed out within a step at u = ½ ω²ρ h. The \
        interval of steps that is farthest above the sum of these is reported. A compliant contact stores energy and starts unloaded, \
        so that its energy is compared with that of the start. Declared corrections and springs are added as in tumbling/passive, \
        whose boxes also have a gyroscopic torque and each other.",
    source: "work of an impulse over its step; chapter §9",
    run: Run::EachStep(passive),
    control: Control { passes: "moreau-jean", fails: "energy/baumgarte" },
}];

/// The derived verdicts that are not `pass`: none.
pub const EXPECTED: &[Expected] = &[];

fn passive(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let mut cube = cuboid("cube", 1.0, [HALF; 3], [0.0, 0.0, HEIGHT]);
    cube.orientation = [0.8, 0.36, 0.48, 0.0];
    cube.linear_velocity = [1.0, 0.5, 0.0];
    cube.angular_velocity = [2.0, -1.0, 0.5];
    let scene = over_floor("tumbling cube", vec![cube], FRICTION);
    let tumble = Tumble::of_scene(bench, scene, h, DURATION)?;
    let compliant = bench.description().contact_model.kind == Kind::Compliant;
    let quantity = if compliant { "rise of the energy above its start" } else { "largest rise of the energy" };
    Ok(vec![passive_rise(bench, &tumble, FRICTION, quantity)])
}
