//! The contact law an engine declares, as the gate can predict with it.
//!
//! One file per quantity that a law predicts; each returns `None` where the law predicts the same as Coulomb–Signorini.

pub mod addition;
pub mod compression;
pub mod creep;
pub mod damping;
pub mod normal;
pub mod regularised;
pub mod sink;
pub mod sliding;
pub mod solid;
pub mod springs;

use crate::{ContactModel, Description};
use moreau_forms::mujoco_contact::ContactParameters;

/// A declared law with its numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum Model {
    /// Coulomb–Signorini with documented imperfections.
    Coulomb(RigidLimits),
    /// Anitescu's convex relaxation.
    Anitescu,
    /// Friction along d directions.
    StewartTrinkle {
        /// d.
        directions: usize,
    },
    /// MuJoCo's soft constraint; the cone stands in the description.
    Mujoco(ContactParameters),
    /// Drake's SAP.
    DrakeSap {
        /// k \[N/m\].
        stiffness: f64,
        /// τ \[s\].
        relaxation_time: f64,
    },
    /// Drake's regularised friction: TAMSI, Similar, Lagged.
    DrakeRegularised {
        /// k \[N/m\].
        stiffness: f64,
        /// d \[s/m\], Hunt–Crossley.
        dissipation: f64,
        /// v_s \[m/s\].
        stiction_tolerance: f64,
    },
    /// A linear spring and damper per contact point.
    SpringDamper {
        /// k \[N/m\].
        stiffness: f64,
        /// c \[N·s/m\].
        damping: f64,
        /// The longest step \[s\] within a step, if it is declared.
        substep: Option<f64>,
    },
    /// Compliant without a documented law, or a law the gate does not know: nothing is predicted.
    Unknown,
}

/// What a rigid engine documents as its deviations from the ideal; zero where it documents none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RigidLimits {
    /// Depth \[m\] left uncorrected at rest.
    pub penetration_allowance: f64,
    /// Gap \[m\] kept at rest.
    pub contact_margin: f64,
    /// Approach speed \[m/s\] below which restitution is 0.
    pub restitution_threshold: f64,
    /// Rebound speed e|u| \[m/s\] below which restitution is 0.
    pub rebound_threshold: f64,
    /// f \[1/s\] of the springs at contact points between bodies, see [`SoftContact`](moreau_forms::soft_rigid_contact::SoftContact).
    pub contact_frequency: f64,
    /// f \[1/s\] against the ground.
    pub ground_contact_frequency: f64,
    /// Part of a depth that a step takes back by a normal velocity, which the bodies keep.
    pub error_reduction: f64,
    /// Largest such velocity \[m/s\]; 0 if it has no limit.
    pub correction_speed: f64,
    /// Part of a depth that a step takes back by moving the bodies, whose velocities stay.
    pub position_correction: f64,
    /// c: a contact answers as if its own 1/m_p were (1 + c) times what it is.
    pub force_mixing: f64,
    /// Damping rate of linear velocities \[1/s\].
    pub linear_damping: f64,
    /// Damping rate of angular velocities \[1/s\].
    pub angular_damping: f64,
}

impl RigidLimits {
    /// Approach speed \[m/s\] below which an impact with this e ends without rebound: max(restitution_threshold, rebound_threshold/e).
    pub fn slowest_bounce(&self, restitution: f64) -> f64 {
        let rebound = if self.rebound_threshold > 0.0 { self.rebound_threshold / restitution } else { 0.0 };
        self.restitution_threshold.max(rebound)
    }

    /// Part of a depth that a step takes back, by a velocity or in the position alone.
    pub fn taken_back(&self) -> f64 {
        self.error_reduction.max(self.position_correction)
    }

    /// Normal velocity \[m/s\] with which a step pushes a pair of bodies out of a depth \[m\].
    pub fn push(&self, depth: f64, h: f64) -> f64 {
        let speed = self.error_reduction * depth / h;
        if self.correction_speed > 0.0 { speed.min(self.correction_speed) } else { speed }
    }
}

impl Model {
    /// The declared law; [`Model::Unknown`] if the law is not among those of `docs/protocol.md` or a number it needs is missing.
    pub fn of(description: &Description) -> Model {
        let model = &description.contact_model;
        model.law.as_deref().and_then(|law| known(law, model)).unwrap_or(Model::Unknown)
    }
}

/// Whether a law's friction is associated, as in the convex relaxation: such a contact lifts off when it slips, by itself.
pub fn convex(model: &Model) -> bool {
    matches!(model, Model::Anitescu | Model::Mujoco(_) | Model::DrakeSap { .. })
}

fn known(law: &str, model: &ContactModel) -> Option<Model> {
    let number = |name: &str| model.number(name);
    Some(match law {
        "coulomb" => {
            let or_zero = |name: &str| number(name).unwrap_or(0.0);
            let contact_frequency = or_zero("contact_frequency");
            Model::Coulomb(RigidLimits {
                penetration_allowance: or_zero("penetration_allowance"),
                contact_margin: or_zero("contact_margin"),
                restitution_threshold: or_zero("restitution_threshold"),
                rebound_threshold: or_zero("rebound_threshold"),
                contact_frequency,
                ground_contact_frequency: number("ground_contact_frequency").unwrap_or(contact_frequency),
                error_reduction: or_zero("error_reduction"),
                correction_speed: or_zero("correction_speed"),
                position_correction: or_zero("position_correction"),
                force_mixing: or_zero("force_mixing"),
                linear_damping: or_zero("linear_damping"),
                angular_damping: or_zero("angular_damping"),
            })
        }
        "anitescu" => Model::Anitescu,
        "stewart-trinkle" => Model::StewartTrinkle { directions: number("directions")? as usize },
        "mujoco" => Model::Mujoco(ContactParameters {
            reference: model.numbers("solref")?.try_into().ok()?,
            impedance: model.numbers("solimp")?.try_into().ok()?,
            impedance_ratio: number("impratio")?,
        }),
        "drake-sap" => Model::DrakeSap { stiffness: number("stiffness")?, relaxation_time: number("relaxation_time")? },
        "drake-regularised" => Model::DrakeRegularised {
            stiffness: number("stiffness")?,
            dissipation: number("dissipation")?,
            stiction_tolerance: number("stiction_tolerance")?,
        },
        "spring-damper" => Model::SpringDamper {
            stiffness: number("stiffness")?,
            damping: number("damping")?,
            substep: number("substep").filter(|substep| *substep > 0.0),
        },
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_larger_of_both_thresholds_ends_the_bounces() {
        let limits = RigidLimits { restitution_threshold: 0.25, rebound_threshold: 0.5, ..Default::default() };
        assert_eq!((limits.slowest_bounce(1.0), limits.slowest_bounce(0.5)), (0.5, 1.0));
        assert_eq!(RigidLimits { rebound_threshold: 0.0, ..limits }.slowest_bounce(0.0), 0.25);
    }

    #[test]
    fn a_depth_is_taken_back_by_its_declared_part_and_at_most_at_the_declared_speed() {
        let limits = RigidLimits { error_reduction: 0.25, ..Default::default() };
        assert_eq!((limits.push(0.5, 0.125), limits.push(0.0, 0.125)), (1.0, 0.0));
        assert_eq!(RigidLimits { correction_speed: 0.5, ..limits }.push(0.5, 0.125), 0.5);
    }
}
