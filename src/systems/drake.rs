//! Drake's four contact approximations, each held against Drake's own stored runs.
//!
//! ```text
//!     SAP       K_μ ∋ r ⟂ u⁺ + φ/(h + τ) n + R r ∈ K_μ* ,   R > 0
//!     Similar, Lagged, TAMSI     r_n = h k (δ − h u_n)₊ (1 − d u_n)₊ ,   friction regularised below a slip v_s
//! ```

use super::{Agreement, Cone, ContactLaw, Level, Measured, System};
use crate::Result;
use crate::checks::Finding;
use crate::checks::replay::Replay;
use crate::trajectory::Trajectory;

const ENGINE: &str = "Drake 1.51.1";
const RESTITUTION: &str = "none; what dissipation leaves";
const POSITION: &str = "q + h v⁺";

macro_rules! stored {
    ($name:literal) => {
        include_str!(concat!("../../references/drake/", $name, ".json"))
    };
}

/// One of Drake's approximations: all compliant, written on the gap at the end of the step, with the round cone.
const fn drake(
    name: &'static str,
    algorithm: &'static str,
    schemes: &'static [&'static str],
    held_against: &'static [Agreement],
) -> System {
    System {
        name,
        level: Level::Position,
        cone: Cone::SecondOrder,
        law: ContactLaw::Compliant,
        algorithm,
        restitution: RESTITUTION,
        position_update: POSITION,
        schemes,
        held_against,
    }
}

/// Velocities, weighed by the mass, against a stored motion of Drake's.
const fn velocity(quantity: &'static str, measure: fn() -> Result<Measured>) -> Agreement {
    Agreement { against: ENGINE, quantity, unit: "kg^½·m/s", measure }
}

pub static SAP: System = drake(
    "Drake SAP",
    "Newton on velocities, analytic projection, exact line search",
    &["drake-sap"],
    &[
        velocity("velocity of a block that sticks and creeps, whole motion, h = 10 ms", || whole(stored!("block_stick__sap__h0.01"))),
        velocity("velocity of a sliding block, whole motion, h = 1 ms", || whole(stored!("block_slide__sap__h0.001"))),
        velocity("velocity after a step from each sample, sliding and hopping, h = 10 ms", || one_step(stored!("block_slide__sap__h0.01"))),
        velocity("velocity after every step of a block that falls on three corners in turn, h = 1 ms", || {
            one_step(stored!("block_impact__sap__h0.001"))
        }),
        velocity("velocity after every step of five boxes that land on each other, h = 5 ms", || {
            one_step(stored!("stack_landing__sap__h0.005"))
        }),
    ],
);

pub static SIMILAR: System = drake(
    "Drake Similar",
    "Newton on velocities, convex potential, exact line search",
    &["drake-similar"],
    &[
        velocity("velocity of a sliding block, whole motion, h = 1 ms", || whole(stored!("block_slide__similar__h0.001"))),
        velocity("velocity after a step from each sample, sticking, h = 10 ms", || one_step(stored!("block_stick__similar__h0.01"))),
        velocity("velocity after every step of a block that falls on three corners in turn, h = 1 ms", || {
            one_step(stored!("block_impact__similar__h0.001"))
        }),
        velocity("velocity after every step of five boxes that land on each other, h = 5 ms", || {
            one_step(stored!("stack_landing__similar__h0.005"))
        }),
    ],
);

pub static LAGGED: System = drake(
    "Drake Lagged",
    "Newton on velocities, convex potential, exact line search",
    &["drake-lagged"],
    &[
        velocity("velocity of a sliding block, whole motion, h = 1 ms", || whole(stored!("block_slide__lagged__h0.001"))),
        velocity("velocity after a step from each sample, sticking, h = 10 ms", || one_step(stored!("block_stick__lagged__h0.01"))),
        velocity("velocity after every step of a block that falls on three corners in turn, h = 1 ms", || {
            one_step(stored!("block_impact__lagged__h0.001"))
        }),
        velocity("velocity after every step of five boxes that land on each other, h = 5 ms", || {
            one_step(stored!("stack_landing__lagged__h0.005"))
        }),
    ],
);

pub static TAMSI: System = drake(
    "Drake TAMSI",
    "Newton on velocities, residual halved along each step",
    &["drake-tamsi"],
    &[
        velocity("velocity of a sliding block, whole motion, h = 1 ms", || whole(stored!("block_slide__tamsi__h0.001"))),
        velocity("velocity after a step from each sample, sticking, h = 10 ms", || one_step(stored!("block_stick__tamsi__h0.01"))),
        velocity("velocity after every step of a block that falls on three corners in turn, h = 1 ms", || {
            one_step(stored!("block_impact__tamsi__h0.001"))
        }),
        velocity("velocity after every step of five boxes that land on each other, h = 5 ms", || {
            one_step(stored!("stack_landing__tamsi__h0.005"))
        }),
    ],
);

/// The velocity of the whole stored motion, in the kinetic norm: of a body of 1 kg, the speed.
fn whole(stored: &str) -> Result<Measured> {
    let [velocity, _] = Replay::new(&Trajectory::from_json(stored)?)?.whole()?;
    Ok(measured(velocity))
}

/// The velocity after the steps between two samples, from the stored state before.
fn one_step(stored: &str) -> Result<Measured> {
    Ok(measured(Replay::new(&Trajectory::from_json(stored)?)?.intervals()?))
}

fn measured(finding: Finding) -> Measured {
    Measured { difference: finding.measured, tolerance: finding.expected }
}

#[cfg(test)]
mod tests {
    use super::super::planted::caught;
    use super::*;
    use crate::schemes::drake::Material;
    use crate::schemes::{DrakeLagged, DrakeSap, DrakeTamsi, Scheme};

    fn replayed(stored: &str, scheme: impl Scheme + 'static) -> Result<Measured> {
        let trajectory = Trajectory::from_json(stored)?;
        Ok(measured(Replay::by(&trajectory, |_| Ok(Box::new(scheme)))?.intervals()?))
    }

    #[test]
    fn another_law_or_material_is_out_of_tolerance() {
        let slide = stored!("block_slide__sap__h0.01");
        let material = Replay::material(&Trajectory::from_json(slide).expect("stored")).expect("stored");
        assert!(replayed(slide, DrakeSap { material }).expect("valid").holds());
        caught(replayed(slide, DrakeSap { material: Material { stiffness: 1.01 * material.stiffness, ..material } }));
        caught(replayed(slide, DrakeSap { material: Material { relaxation_time: 0.0, ..material } }));
        caught(replayed(slide, DrakeLagged { material }));
        let stick = stored!("block_stick__lagged__h0.01");
        let material = Replay::material(&Trajectory::from_json(stick).expect("stored")).expect("stored");
        caught(replayed(stick, DrakeTamsi { material }));
    }

    #[test]
    fn boxes_that_land_with_other_friction_or_other_corners_are_out_of_tolerance() {
        for stored in
            [stored!("stack_landing__sap__h0.005"), stored!("stack_landing__lagged__h0.005"), stored!("stack_landing__tamsi__h0.005")]
        {
            let trajectory = Trajectory::from_json(stored).expect("stored");
            let found = |trajectory: &Trajectory| Ok(measured(Replay::new(trajectory)?.intervals()?));
            assert!(found(&trajectory).expect("valid").holds());
            let mut rougher = trajectory.clone();
            rougher.scene.material.friction *= 1.01;
            caught(found(&rougher));
            let mut rounder = trajectory.clone();
            rounder.engine.options.insert("corner_radius".into(), 0.006.into());
            caught(found(&rounder));
            let mut narrower = trajectory.clone();
            let cuboid = narrower.scene.bodies[0].cuboid.as_mut().expect("a box");
            cuboid.half_extents[0] *= 0.9;
            caught(found(&narrower));
        }
    }
}
