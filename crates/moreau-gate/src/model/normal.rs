//! What compliant laws do along the normal of one contact: replays of their one-dimensional discrete maps, and the depth at rest.

use crate::description::Friction;
use crate::model::{Model, springs};
use moreau_forms::drake_normal::HuntCrossley;
use moreau_forms::drake_sap::{SapContact, TANGENTIAL_RATIO};
use moreau_forms::mujoco_normal::NormalContact;

/// The arms of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Arms {
    /// Radius r \[m\] and 1/J \[1/(kg·m²)\] of up to two spheres; (0, 0) for none.
    Spheres([(f64, f64); 2]),
    /// ‖W_ii‖_F/3 \[1/kg\] of a contact that is not between spheres. It does not depend on the depth.
    Fixed(f64),
}

/// One of several equal contacts that carry a body along a common normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normal {
    /// 1/W_n \[kg\] of all of them together: m̄, 1/m̄ = Σ 1/m, if the bodies do not turn.
    pub mass: f64,
    /// Σ 1/m of the bodies \[1/kg\], which MuJoCo's softness is a multiple of.
    pub inverse_masses: f64,
    /// What the contact turns, which Drake's SAP scales its softness by.
    pub arms: Arms,
    /// Relative normal acceleration without contact \[m/s²\], −g for a body on the floor.
    pub acceleration: f64,
    /// μ.
    pub friction: f64,
    /// The declared cone.
    pub cone: Friction,
    /// h \[s\].
    pub time_step: f64,
}

impl Normal {
    /// Solid spheres of (mass \[kg\], radius \[m\]): one on the floor, or two that meet.
    pub fn spheres(bodies: &[(f64, f64)], gravity: f64, friction: f64, cone: Friction, time_step: f64) -> Self {
        let mut arms = [(0.0, 0.0); 2];
        for (arm, (mass, radius)) in arms.iter_mut().zip(bodies) {
            *arm = (*radius, 1.0 / (0.4 * mass * radius * radius));
        }
        let mass = 1.0 / bodies.iter().map(|(mass, _)| 1.0 / mass).sum::<f64>();
        Normal { mass, inverse_masses: 1.0 / mass, arms: Arms::Spheres(arms), acceleration: -gravity, friction, cone, time_step }
    }

    /// ‖W_ii‖_F/3 \[1/kg\]: normal 1/m̄, both tangents 1/m̄ + Σ (r − δ/2)²/J, as equal stiffnesses put the contact point in the middle of
    /// the overlap.
    fn diagonal_mean(&self, depth: f64) -> f64 {
        match self.arms {
            Arms::Fixed(mean) => mean,
            Arms::Spheres(arms) => {
                let normal = 1.0 / self.mass;
                let tangential = normal + arms.iter().map(|(radius, inverse)| (radius - 0.5 * depth).powi(2) * inverse).sum::<f64>();
                (normal * normal + 2.0 * tangential * tangential).sqrt() / 3.0
            }
        }
    }

    /// r \[N·s\] of one step at a depth \[m\] and velocity \[m/s\], if the law gives it.
    fn impulse(&self, model: &Model, depth: f64, velocity: f64) -> Option<f64> {
        let free = velocity + self.time_step * self.acceleration;
        match model {
            Model::Mujoco(_) => Some(self.mujoco(model)?.impulse(depth, velocity, self.acceleration)),
            Model::DrakeSap { .. } => Some(self.sap(model, depth)?.normal_impulse(self.mass, depth, free)),
            Model::DrakeRegularised { stiffness, dissipation, .. } => {
                let law = HuntCrossley { time_step: self.time_step, stiffness: *stiffness, dissipation: *dissipation };
                Some(law.normal_impulse(self.mass, depth, free))
            }
            _ => None,
        }
    }

    fn mujoco(&self, model: &Model) -> Option<NormalContact> {
        let Model::Mujoco(parameters) = model else { return None };
        let pyramid = self.cone == Friction::Pyramid && self.friction > 0.0;
        Some(if pyramid {
            NormalContact::pyramidal(*parameters, self.time_step, self.mass, self.friction)
        } else {
            NormalContact { diagonal: self.inverse_masses, ..NormalContact::elliptic(*parameters, self.time_step, self.mass) }
        })
    }

    fn sap(&self, model: &Model, depth: f64) -> Option<SapContact> {
        let Model::DrakeSap { stiffness, relaxation_time } = model else { return None };
        Some(SapContact {
            time_step: self.time_step,
            stiffness: *stiffness,
            relaxation_time: *relaxation_time,
            diagonal_mean: self.diagonal_mean(depth),
            tangential_ratio: TANGENTIAL_RATIO,
            friction: self.friction,
        })
    }

    /// The motions that the law allows, each as by [`Normal::replay`]: one of a law with a documented step, several of a spring and damper,
    /// whose steps nobody documents; `None` if the law gives none.
    pub fn replays(&self, model: &Model, gap: f64, velocity: f64, steps: usize) -> Option<Vec<Vec<(f64, f64)>>> {
        match model {
            Model::SpringDamper { .. } => {
                Some(springs::replays(model, (self.mass, self.acceleration), self.time_step, (gap, velocity), steps))
            }
            _ => self.replay(model, gap, velocity, steps).map(|states| vec![states]),
        }
    }

    /// (gap, velocity) at the start and after each of `steps` steps v⁺ = v + h a₀ + r/m̄, gap⁺ = gap + h v⁺, if the law gives r.
    pub fn replay(&self, model: &Model, gap: f64, velocity: f64, steps: usize) -> Option<Vec<(f64, f64)>> {
        let mut states = vec![(gap, velocity)];
        let (mut gap, mut velocity) = (gap, velocity);
        for _ in 0..steps {
            velocity += self.time_step * self.acceleration + self.impulse(model, -gap, velocity)? / self.mass;
            gap += self.time_step * velocity;
            states.push((gap, velocity));
        }
        Some(states)
    }

    /// Depth \[m\] at rest under a normal force \[N\] on this contact, if the law gives it. `mass` is the mass of the whole body here.
    pub fn rest_depth(&self, model: &Model, force: f64) -> Option<f64> {
        match model {
            Model::Mujoco(parameters) => parameters.rest_depth(self.time_step, self.mujoco(model)?.diagonal, force).ok(),
            Model::DrakeSap { .. } => {
                // The softness depends on the depth by δ/r ≪ 1: a contraction, exhausted by 53 halvings or more.
                (0..53).try_fold(0.0, |depth, _| Some(-self.sap(model, depth)?.rest_gap(force)))
            }
            Model::DrakeRegularised { stiffness, .. } | Model::SpringDamper { stiffness, .. } => Some(force / stiffness),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::rest::settled;
    use moreau_forms::mujoco_contact::ContactParameters;

    const LAWS: [Model; 3] = [
        Model::Mujoco(ContactParameters { reference: [0.02, 1.0], impedance: [0.9, 0.95, 0.001, 0.5, 2.0], impedance_ratio: 1.0 }),
        Model::DrakeSap { stiffness: 1e4, relaxation_time: 0.02 },
        Model::DrakeRegularised { stiffness: 1e4, dissipation: 5.0, stiction_tolerance: 1e-3 },
    ];

    #[test]
    fn a_replayed_ball_comes_to_rest_at_the_depth_of_its_law() {
        for (model, h) in LAWS.iter().flat_map(|model| [(model, 1e-2), (model, 1e-3)]) {
            for cone in [Friction::Cone, Friction::Pyramid] {
                let normal = Normal::spheres(&[(2.0, 0.1)], 9.81, 0.4, cone, h);
                let depth = normal.rest_depth(model, 2.0 * 9.81).expect("the law says");
                let states = normal.replay(model, -depth, 0.0, 1000).expect("the law says");
                let farthest = states.iter().map(|(gap, _)| (gap + depth).abs()).fold(0.0, f64::max);
                assert!(farthest <= settled(1000, 0.1, 9.81, h, f64::EPSILON), "{model:?} h = {h}: {farthest}");
            }
        }
    }

    #[test]
    fn the_arm_of_a_pressed_sphere_ends_in_the_middle_of_the_overlap() {
        let ball = Normal::spheres(&[(2.0, 0.1)], 9.81, 0.0, Friction::Cone, 1e-3);
        let mean = |tangential: f64| (1.0 + 2.0 * tangential * tangential).sqrt() / 6.0;
        assert!((ball.diagonal_mean(0.0) - mean(3.5)).abs() <= moreau_exact::tolerance::rounding(16, 4.0));
        // δ = r/5: the arm is 0.9 r, 1 + 2.5·0.81.
        assert!((ball.diagonal_mean(0.02) - mean(3.025)).abs() <= moreau_exact::tolerance::rounding(16, 4.0));
    }

    #[test]
    fn rigid_laws_replay_nothing() {
        let normal = Normal::spheres(&[(1.0, 0.1)], 9.81, 0.0, Friction::Cone, 1e-3);
        assert!(normal.replay(&Model::Anitescu, 0.0, -1.0, 3).is_none() && normal.rest_depth(&Model::Unknown, 1.0).is_none());
    }
}
