//! Mistakes of how bodies turn.

use crate::checks::spin::LONG_STEP;
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
    Planted {
        name: "spin/slow-growth",
        mistake: "takes the gyroscopic torque at 0.4999 of the step instead of its middle: what grows shows in hundreds of turns only",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(EachStep { after: early_torque, ..EachStep::NOTHING }), caught_by: &["spin/gyroscopic"] },
    },
];

/// The mistakes that no step of the quick sweep shows, with one that does \[s\].
pub const SHOW_AT: &[(&str, f64)] = &[("spin/slow-growth", LONG_STEP)];

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

fn explicit_torque(scene: &mut Scene, moment: &Moment) {
    turn_free_boxes(scene, moment, |moments, rate, h| {
        let end = rate + acceleration(moments, &rate) * h;
        [end, end]
    });
}

fn early_torque(scene: &mut Scene, moment: &Moment) {
    let part = 0.4999;
    turn_free_boxes(scene, moment, |moments, rate, h| {
        let step = |next: Vector3<f64>, _| rate + acceleration(moments, &(rate * (1.0 - part) + next * part)) * h;
        let end = (0..12).fold(rate, step);
        [(rate + end) * 0.5, end]
    });
}

/// Ω̇ of Euler's equations.
fn acceleration(moments: &Vector3<f64>, rate: &Vector3<f64>) -> Vector3<f64> {
    moments.component_mul(rate).cross(rate).component_div(moments)
}

/// Boxes without contact turn by this map of J, Ω and h to the Ω by which a step turns and that after it.
fn turn_free_boxes(scene: &mut Scene, moment: &Moment, step: impl Fn(&Vector3<f64>, Vector3<f64>, f64) -> [Vector3<f64>; 2]) {
    for (body, before) in scene.bodies.iter_mut().zip(&moment.start.bodies).filter(|(body, _)| body.is_free()) {
        let touched = moment.contacts.iter().any(|contact| contact.bodies.contains(&body.name));
        let Some(cuboid) = body.cuboid.filter(|_| !touched) else { continue };
        let moments = body.inertia.map_or_else(|| box_moments(body.mass, cuboid.half_extents.into()), Vector3::from);
        let [w, x, y, z] = before.orientation;
        let start = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let [turning, rate] = step(&moments, start.inverse() * Vector3::from(before.angular_velocity), moment.h);
        let turned = start * UnitQuaternion::from_scaled_axis(turning * moment.h);
        body.orientation = [turned.w, turned.i, turned.j, turned.k];
        body.angular_velocity = (turned * rate).into();
    }
}
