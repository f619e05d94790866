//! Mistakes of how bodies turn.

use crate::model::solid::box_moments;
use crate::planted::wrapped::{EachStep, Moment};
use crate::planted::{Faulty, Kind, Planted};
use moreau_dynamics::scenes::Scene;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "spin/sphere-not-turned",
        mistake: "does not integrate the orientation of spheres",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { after: sphere_not_turned, ..EachStep::NOTHING }),
            caught_by: &["spin/free-sphere"],
        },
    },
    Planted {
        name: "spin/drilling-friction",
        mistake: "brakes the upright spin of a sphere with μ p_n R, though it touches in a point",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(EachStep { after: drilled, ..EachStep::NOTHING }), caught_by: &["spin/drilling"] },
    },
    Planted {
        name: "spin/no-yaw-friction",
        mistake: "lets friction of the floor not turn a box about the normal",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(EachStep { after: yaw_kept, ..EachStep::NOTHING }), caught_by: &["spin/flat-box"] },
    },
    Planted {
        name: "spin/explicit-gyroscopic-torque",
        mistake: "takes the gyroscopic torque of the state before the step, Ω − h J⁻¹(Ω × JΩ): energy and momentum grow",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(EachStep { after: explicit_torque, ..EachStep::NOTHING }), caught_by: &["spin/gyroscopic"] },
    },
];

fn sphere_not_turned(scene: &mut Scene, moment: &Moment) {
    for (body, before) in scene.bodies.iter_mut().zip(&moment.start.bodies).filter(|(body, _)| body.sphere.is_some()) {
        body.orientation = before.orientation;
    }
}

fn drilled(scene: &mut Scene, moment: &Moment) {
    for body in &mut scene.bodies {
        let floor = moment.contacts.iter().filter(|contact| contact.bodies[0] == body.name && contact.bodies[1] == "ground");
        let pressed: f64 = floor.map(|contact| contact.impulse[2]).sum();
        if let Some(sphere) = body.sphere {
            let most = scene.material.friction * pressed.max(0.0) / (0.4 * body.mass * sphere.radius);
            body.angular_velocity[2] -= body.angular_velocity[2].clamp(-most, most);
        }
    }
}

fn yaw_kept(scene: &mut Scene, moment: &Moment) {
    for (body, before) in scene.bodies.iter_mut().zip(&moment.start.bodies).filter(|(body, _)| body.cuboid.is_some()) {
        if moment.contacts.iter().any(|contact| contact.bodies.contains(&body.name)) {
            body.angular_velocity[2] = before.angular_velocity[2];
        }
    }
}

/// Boxes without contact.
fn explicit_torque(scene: &mut Scene, moment: &Moment) {
    for (body, before) in scene.bodies.iter_mut().zip(&moment.start.bodies) {
        let touched = moment.contacts.iter().any(|contact| contact.bodies.contains(&body.name));
        let Some(cuboid) = body.cuboid.filter(|_| !touched) else { continue };
        let moments = box_moments(body.mass, cuboid.half_extents.into());
        let [w, x, y, z] = before.orientation;
        let start = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let rate = start.inverse() * Vector3::from(before.angular_velocity);
        let rate = rate + moments.component_mul(&rate).cross(&rate).component_div(&moments) * moment.h;
        let turned = start * UnitQuaternion::from_scaled_axis(rate * moment.h);
        body.orientation = [turned.w, turned.i, turned.j, turned.k];
        body.angular_velocity = (turned * rate).into();
    }
}
