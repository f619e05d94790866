//! The probe of bodies that nothing moves: they are where their prescribed velocity takes them, and stay in their place without one.

use crate::conformance::scenes::ball_on_slab;
use crate::conformance::{Seen, demand, refused, skipped};
use crate::description::BodyKind;
use crate::tolerance::conformance::{STEP, kept_velocity};
use crate::{Description, Engine, Options};
use nalgebra::Vector3;

/// V of the slab \[m/s\].
const VELOCITY: [f64; 3] = [0.5, -0.25, 0.125];

pub(super) fn stay_or_move_as_prescribed(engine: &mut dyn Engine, description: &Description) -> Seen {
    let asked = [(BodyKind::Static, None), (BodyKind::Prescribed, Some(VELOCITY))];
    let declared: Vec<_> = asked.into_iter().filter(|(kind, _)| description.bodies.contains(kind)).collect();
    if declared.is_empty() {
        return Err(skipped("the description declares neither `static` nor `prescribed` bodies"));
    }
    for (kind, velocity) in declared {
        let scene = ball_on_slab(velocity);
        if let Some(reason) = description.lacks(&scene) {
            return Err(skipped(reason));
        }
        let motion = engine.simulate(&scene, STEP, 1, &Options::new()).map_err(refused)?;
        let Some(track) = motion.body("slab") else { return Err(skipped("there is no motion to look at")) };
        let given = Vector3::from(velocity.unwrap_or_default());
        let start = Vector3::from(scene.bodies[1].position);
        let allowed = kept_velocity(description.precision.epsilon(), given.norm(), motion.times.len());
        for (k, time) in motion.times.iter().enumerate() {
            let (place, speed) = (Vector3::from(track.position[k]), Vector3::from(track.linear_velocity[k]));
            let why = || {
                format!("at sample {k} the {} body has the velocity {:?} and is at {:?}", kind.word(), speed.as_slice(), place.as_slice())
            };
            let met = (speed - given).amax() <= allowed / STEP && (place - start - given * *time).amax() <= allowed;
            demand(met, why, "give it no mass and set its velocity: x₀ + V t and V in every sample, whatever touches it")?;
        }
    }
    Ok(())
}
