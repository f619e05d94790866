//! Energy: a passive world never gains any.
//!
//! ```text
//!     E = ½ m‖v‖² + ½ ωᵀJω + m g z
//!     positions with (v + v⁺)/2:   ΔE = ½ pᵀ(u⁻ + u⁺) ≤ 0
//!     positions with v⁺:           ΔE = ½ pᵀ(u⁻ + u⁺) + ½ m g h Δv_z
//! ```
//! So E − ½ m g h v_z is the invariant of a semi-implicit scheme, and E may rise by ½ m g h times the range of v_z. The body is a cube,
//! whose gyroscopic torque is zero: the error of a rotation scheme plays no part.

use crate::check::{Control, Expected, Run};
use crate::checks::motion::{Sample, samples};
use crate::checks::scenery::{GRAVITY, cuboid, over_floor, worst};
use crate::tolerance::energy as tolerance;
use crate::{Bench, Check, Expectation, Kind, Level, Measurement, Reply};

/// Half the edge of the cube \[m\].
const HALF: f64 = 0.1;
/// Height of the centre at the start \[m\].
const HEIGHT: f64 = 0.3;
/// Duration of the motion \[s\].
const DURATION: f64 = 0.5;

/// The checks of the family.
pub const CHECKS: &[Check] = &[Check {
    name: "energy/passive",
    level: Level::Simulate,
    question: "Does the energy of a cube that tumbles onto a rough floor ever rise?",
    derivation: "Contacts without restitution do no positive work. E may rise by ½ m g h times the range of v_z if positions advance \
        with v⁺. It may rise by ½ m (g h)²/4 in a step that finds a contact while the corner rises slower than g h. It may rise by ½ P u \
        if corners that have turned below the floor by ½ ω²ρ h² are pushed out within a step at u = ½ ω²ρ h. A compliant contact stores \
        energy and starts unloaded, so that its energy is compared with that of the start.",
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
    let scene = over_floor("tumbling cube", vec![cube], 0.4);
    let steps = (DURATION / h).round() as usize;
    let motion = bench.simulate(&scene, h, steps, 1)?;
    let energies: Vec<f64> = samples(&motion.bodies[0]).iter().map(energy).collect();
    let compliant = bench.description().contact_model.kind == Kind::Compliant;
    let (mut least, mut rise) = (energies[0], 0.0);
    for energy in &energies {
        rise = worst(energy - least, rise);
        least = if compliant { least } else { least.min(*energy) };
    }
    let quantity = if compliant { "rise of the energy above its start" } else { "largest rise of the energy" };
    let allowed = tolerance::rise(GRAVITY, h, HEIGHT, HALF, DURATION) + tolerance::rounding(bench.epsilon(), energies[0], steps);
    Ok(vec![Measurement::new(quantity, "J", rise, Expectation::at_most(0.0, allowed, "contacts do no positive work"))])
}

/// E \[J\] of the cube of 1 kg, J = ⅔ m a².
fn energy(state: &Sample) -> f64 {
    0.5 * state.velocity.norm_squared() + HALF * HALF / 3.0 * state.spin.norm_squared() + GRAVITY * state.position.z
}
