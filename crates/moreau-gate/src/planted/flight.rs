//! Mistakes of free flight.

use crate::planted::wrapped::{EachStep, Misreport, Moment};
use crate::planted::{Faulty, Kind, Planted};
use moreau_dynamics::scenes::Scene;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "flight/half-g-h-squared-twice",
        mistake: "adds ½ g h² to a position that already moves with the velocity after the step",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { after: half_g_h_squared_twice, ..EachStep::NOTHING }),
            caught_by: &["flight/projectile"],
        },
    },
    Planted {
        name: "flight/undeclared-damping",
        mistake: "multiplies every velocity by 0.96^h, which is Bullet's default, and declares no damping",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { after: damped, ..EachStep::NOTHING }),
            caught_by: &["flight/projectile", "flight/momentum"],
        },
    },
    Planted {
        name: "flight/no-gyroscopic-term",
        mistake: "leaves ω of a free body constant, as if its inertia were that of a sphere",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { after: |scene, moment| turned(scene, moment, 0.0), ..EachStep::NOTHING }),
            caught_by: &["flight/spinning-box"],
        },
    },
    Planted {
        name: "flight/gyroscopic-sign",
        mistake: "adds ω × Jω where it is to be subtracted",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { after: |scene, moment| turned(scene, moment, -1.0), ..EachStep::NOTHING }),
            caught_by: &["flight/spinning-box"],
        },
    },
    Planted {
        name: "flight/spin-in-the-body-frame",
        mistake: "reports the angular velocity in the body's frame",
        kind: Kind::Report,
        subject: Faulty { engine: || Box::new(Misreport(spin_in_the_body_frame)), caught_by: &["flight/spinning-box"] },
    },
    Planted {
        name: "flight/samples-a-step-late",
        mistake: "reports the state at the beginning of a step for its end",
        kind: Kind::Report,
        subject: Faulty { engine: || Box::new(Misreport(a_step_late)), caught_by: &["flight/projectile", "flight/momentum"] },
    },
];

fn half_g_h_squared_twice(scene: &mut Scene, moment: &Moment) {
    // The trapezoidal update is ½ g h² short of the semi-implicit one, to which another ½ g h² is added.
    for body in &mut scene.bodies {
        (0..3).for_each(|k| body.position[k] += moment.start.gravity[k] * moment.h * moment.h);
    }
}

fn damped(scene: &mut Scene, moment: &Moment) {
    let left = 0.96f64.powf(moment.h);
    for body in &mut scene.bodies {
        body.linear_velocity = body.linear_velocity.map(|v| left * v);
        body.angular_velocity = body.angular_velocity.map(|w| left * w);
    }
}

/// The change of ω of bodies without contact, times a factor.
fn turned(scene: &mut Scene, moment: &Moment, factor: f64) {
    for (body, before) in scene.bodies.iter_mut().zip(&moment.start.bodies) {
        if moment.contacts.iter().all(|contact| !contact.bodies.contains(&body.name)) {
            (0..3).for_each(|k| {
                let change = body.angular_velocity[k] - before.angular_velocity[k];
                body.angular_velocity[k] = before.angular_velocity[k] + factor * change;
            });
        }
    }
}

fn spin_in_the_body_frame(track: &moreau_dynamics::trajectory::BodyTrack, step: usize) -> [[f64; 3]; 3] {
    let [w, x, y, z] = track.orientation[step];
    let orientation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let spin = orientation.inverse() * Vector3::from(track.angular_velocity[step]);
    [track.position[step], track.linear_velocity[step], spin.into()]
}

fn a_step_late(track: &moreau_dynamics::trajectory::BodyTrack, step: usize) -> [[f64; 3]; 3] {
    let step = step.saturating_sub(1);
    [track.position[step], track.linear_velocity[step], track.angular_velocity[step]]
}
