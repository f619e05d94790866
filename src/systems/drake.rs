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

pub static SAP: System = System {
    name: "Drake SAP",
    level: Level::Position,
    cone: Cone::SecondOrder,
    law: ContactLaw::Compliant,
    algorithm: "Newton on velocities, analytic projection, exact line search",
    restitution: RESTITUTION,
    position_update: POSITION,
    schemes: &["drake-sap"],
    held_against: &[
        Agreement {
            against: ENGINE,
            quantity: "velocity of a block that sticks and creeps, whole motion, h = 10 ms",
            unit: "kg^½·m/s",
            measure: || whole(stored!("block_stick__sap__h0.01")),
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity of a sliding block, whole motion, h = 1 ms",
            unit: "kg^½·m/s",
            measure: || whole(stored!("block_slide__sap__h0.001")),
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity after a step from each sample, sliding and hopping, h = 10 ms",
            unit: "kg^½·m/s",
            measure: || one_step(stored!("block_slide__sap__h0.01")),
        },
    ],
};

pub static SIMILAR: System = System {
    name: "Drake Similar",
    level: Level::Position,
    cone: Cone::SecondOrder,
    law: ContactLaw::Compliant,
    algorithm: "Newton on velocities, convex potential, exact line search",
    restitution: RESTITUTION,
    position_update: POSITION,
    schemes: &["drake-similar"],
    held_against: &[
        Agreement {
            against: ENGINE,
            quantity: "velocity of a sliding block, whole motion, h = 1 ms",
            unit: "kg^½·m/s",
            measure: || whole(stored!("block_slide__similar__h0.001")),
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity after a step from each sample, sticking, h = 10 ms",
            unit: "kg^½·m/s",
            measure: || one_step(stored!("block_stick__similar__h0.01")),
        },
    ],
};

pub static LAGGED: System = System {
    name: "Drake Lagged",
    level: Level::Position,
    cone: Cone::SecondOrder,
    law: ContactLaw::Compliant,
    algorithm: "Newton on velocities, convex potential, exact line search",
    restitution: RESTITUTION,
    position_update: POSITION,
    schemes: &["drake-lagged"],
    held_against: &[
        Agreement {
            against: ENGINE,
            quantity: "velocity of a sliding block, whole motion, h = 1 ms",
            unit: "kg^½·m/s",
            measure: || whole(stored!("block_slide__lagged__h0.001")),
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity after a step from each sample, sticking, h = 10 ms",
            unit: "kg^½·m/s",
            measure: || one_step(stored!("block_stick__lagged__h0.01")),
        },
    ],
};

pub static TAMSI: System = System {
    name: "Drake TAMSI",
    level: Level::Position,
    cone: Cone::SecondOrder,
    law: ContactLaw::Compliant,
    algorithm: "Newton on velocities, residual halved along each step",
    restitution: RESTITUTION,
    position_update: POSITION,
    schemes: &["drake-tamsi"],
    held_against: &[
        Agreement {
            against: ENGINE,
            quantity: "velocity of a sliding block, whole motion, h = 1 ms",
            unit: "kg^½·m/s",
            measure: || whole(stored!("block_slide__tamsi__h0.001")),
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity after a step from each sample, sticking, h = 10 ms",
            unit: "kg^½·m/s",
            measure: || one_step(stored!("block_stick__tamsi__h0.01")),
        },
    ],
};

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
}
