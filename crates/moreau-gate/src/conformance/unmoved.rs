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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conformance::ProbeOutcome;
    use crate::exact::Reporting;
    use moreau_dynamics::trajectory::{BodyTrack, Trajectory};

    /// What is told of our engine if the slab's track is changed in the `asked`-th answer.
    fn seen(asked: usize, change: impl Fn(&mut BodyTrack, usize) + Send + Sync) -> Seen {
        let mut answers = 0;
        let mut engine = Reporting(|motion: &mut Trajectory| {
            answers += 1;
            let last = motion.times.len() - 1;
            if answers == asked {
                change(&mut motion.bodies[1], last);
            }
        });
        let description = engine.describe(&Options::new()).expect("describes itself");
        stay_or_move_as_prescribed(&mut engine, &description)
    }

    #[test]
    fn a_slab_that_is_elsewhere_or_has_another_velocity_at_one_sample_is_seen_if_it_is_static_and_if_it_is_driven() {
        assert_eq!(seen(0, |_, _| ()), Ok(()));
        for asked in [1, 2] {
            for late in [false, true] {
                let place = move |last: usize| if late { last } else { 1 };
                let moved = seen(asked, |track, last| track.position[place(last)][1] += 1.0 / 1024.0);
                assert!(matches!(moved, Err(ProbeOutcome::Problem { .. })), "{asked} {late}: {moved:?}");
                let faster = seen(asked, |track, last| track.linear_velocity[place(last)][2] += 1.0 / 1024.0);
                assert!(matches!(faster, Err(ProbeOutcome::Problem { .. })), "{asked} {late}: {faster:?}");
            }
        }
    }
}
