//! MuJoCo's first 500 steps again with MuJoCo's own contact points: sphere, box and stack, whatever our collision detection would find.
//!
//! A stored contact is a gap, the point halfway between the two bodies and the two bodies; the normal is the ground's. Its rows at our own
//! state are (d, Rᵀ(r × d)) with r from a body's centre to that point. State, forces and impulses are ours from the first step on.

use crate::document::Document;
use crate::soft_motion::scheme;
use delegate::delegate;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::contact::frame::spatial_tangents;
use moreau::contact::{Contact, Place};
use moreau::mechanics::{BodyState, Mechanism, State};
use moreau::scenes::Scene;
use moreau::schemes::step;
use moreau::solvers::GaussNewton;
use moreau::tolerance::references::{ENGINE_ROUNDING, REPLAYED_MOTION};
use nalgebra::{DMatrix, DVector, Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;

/// A mechanism whose contacts are the stored ones of one step.
struct Stored<'a> {
    mechanism: &'a dyn Mechanism,
    contacts: &'a [[f64; 6]],
    normal: [f64; 3],
    friction: f64,
}

impl Stored<'_> {
    fn contact(&self, bodies: &[BodyState], [first, second, gap, x, y, z]: [f64; 6]) -> Contact {
        let [t1, t2] = spatial_tangents(self.normal);
        let frame = [self.normal, t1, t2];
        let mut jacobian = DMatrix::zeros(3, self.degrees_of_freedom());
        for (body, sign) in [(first, 1.0), (second, -1.0)] {
            if body < 0.0 {
                continue;
            }
            let (k, state) = (body as usize, &bodies[body as usize]);
            let [w, i, j, l] = state.orientation;
            let turned = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, l)).inverse();
            let arm = Vector3::new(x, y, z) - Vector3::from(state.position);
            for (row, direction) in frame.iter().enumerate() {
                let direction = Vector3::from(*direction);
                let turn = turned * arm.cross(&direction);
                for axis in 0..3 {
                    jacobian[(row, 6 * k + axis)] = sign * direction[axis];
                    jacobian[(row, 6 * k + 3 + axis)] = sign * turn[axis];
                }
            }
        }
        let second = (second >= 0.0).then_some(second as usize);
        let place = Some(Place { bodies: (first as usize, second), features: [0, 0], frame });
        Contact { gap, jacobian: jacobian.into(), friction: self.friction, restitution: 0.0, place }
    }
}

impl Mechanism for Stored<'_> {
    delegate! {
        to self.mechanism {
            fn name(&self) -> &str;
            fn degrees_of_freedom(&self) -> usize;
            fn mass_matrix(&self, position: &DVector<f64>) -> DMatrix<f64>;
            fn force(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64>;
            fn inverse_mass(&self, contact: &Contact) -> Option<f64>;
            fn potential_energy(&self, position: &DVector<f64>) -> f64;
            fn integrate(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64>;
            fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState>;
        }
    }

    fn rows_per_contact(&self) -> usize {
        3
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let bodies = self.bodies(position, &DVector::zeros(self.degrees_of_freedom()));
        self.contacts.iter().map(|contact| self.contact(&bodies, *contact)).collect()
    }
}

/// The state after the stored steps; and that contacts of another step, as a control, do not lead there.
pub fn check(document: &Document) -> Result<Vec<Finding>, Failed> {
    let geometry = contacts(document)?;
    let [position, velocity] = ["position", "velocity"].map(|key| document.vector(&["end", key]));
    let (position, velocity) = (position?, velocity?);
    let reached = replay(document, &geometry)?;
    let moved: Vec<Vec<[f64; 6]>> = geometry.iter().map(|step| step.iter().map(|contact| deeper(*contact)).collect()).collect();
    let control = replay(document, &moved)?;
    let tilt = document.number(&["checks", "tilt"])?;
    Ok(vec![
        Finding::at_most("configuration after the steps", (&reached.position - &position).amax(), REPLAYED_MOTION, "m, 1"),
        Finding::at_most("velocity after the steps", (&reached.velocity - &velocity).amax(), REPLAYED_MOTION, "m/s, rad/s"),
        Finding::at_most("tilt of a normal against the ground's", tilt, ENGINE_ROUNDING, "1"),
        Finding::equal("steps that were replayed", geometry.len() as f64, 500.0, 0.0, "1"),
        Finding::at_least("control: with gaps a hundredth deeper", (control.position - position).amax(), REPLAYED_MOTION, "m, 1"),
    ])
}

fn deeper([first, second, gap, x, y, z]: [f64; 6]) -> [f64; 6] {
    [first, second, 1.01 * gap, x, y, z]
}

/// Our state after steps with these contacts.
fn replay(document: &Document, geometry: &[Vec<[f64; 6]>]) -> Result<State, Failed> {
    let scene = Scene::from_json(&document.value["scene"].to_string())?;
    let scheme = scheme(&document.value["engine"]["options"])?;
    let h = document.number(&["time_step"])?;
    let normal = scene.ground.ok_or("the scene has a ground")?.normal;
    let (mechanism, mut state) = scene.spatial_mechanism()?;
    for contacts in geometry {
        let stored = Stored { mechanism: mechanism.as_ref(), contacts, normal, friction: scene.material.friction };
        state = step(&scheme, &GaussNewton::default(), &stored, &state, h)?.state;
    }
    Ok(state)
}

/// \[body, other, gap, x, y, z\] of every contact of every step.
fn contacts(document: &Document) -> Result<Vec<Vec<[f64; 6]>>, Failed> {
    let contact = |value: &Value| -> Option<[f64; 6]> {
        let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(Value::as_f64).collect();
        numbers?.try_into().ok()
    };
    let step = |value: &Value| -> Option<Vec<[f64; 6]>> { value.as_array()?.iter().map(contact).collect() };
    let steps: Option<Vec<_>> = document.value["geometry"].as_array().map(|steps| steps.iter().map(step).collect()).unwrap_or(None);
    steps.ok_or_else(|| "geometry lists six numbers a contact, step by step".into())
}
