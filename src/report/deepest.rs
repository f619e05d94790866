//! The deepest penetration of a motion beside the size of the body that it is in: a remark, no judgement.
//!
//! ```text
//!     depth/size > DEEP      size: the smallest half extent of the two bodies
//! ```

use crate::mechanics::Mechanism;
use crate::number::{significant, two_digits};
use crate::scenes::{Body, Scene};
use crate::tolerance::report::DEEP;
use crate::trajectory::Recording;

/// Where a motion penetrates most, relative to the bodies.
struct Deepest {
    pair: (usize, Option<usize>),
    /// Of the pair, the body with the smallest half extent.
    body: usize,
    depth: f64,
    size: f64,
    time: f64,
}

/// What is remarkable about the penetrations of a motion; nothing below [`DEEP`].
pub fn remark(recording: &Recording, mechanism: &dyn Mechanism, scene: &Scene) -> Option<String> {
    let deepest = deepest(recording, mechanism, scene).filter(|deepest| deepest.depth > DEEP * deepest.size)?;
    let name = |body: usize| scene.bodies[body].name.as_str();
    let (first, second) = deepest.pair;
    let [depth, size] = [deepest.depth, deepest.size].map(significant);
    Some(format!(
        "{} and {} overlap by {depth} m at t = {} s, {} % of the smallest half extent of {}, {size} m; {}",
        name(first),
        second.map_or("ground", name),
        significant(deepest.time),
        two_digits(100.0 * deepest.depth / deepest.size),
        name(deepest.body),
        if deepest.time > recording.samples.first().map_or(0.0, |start| start.time) {
            "a smaller --step makes it less, unless the contact is as soft as that"
        } else {
            "they are placed so: the positions of the scene say it"
        }
    ))
}

fn deepest(recording: &Recording, mechanism: &dyn Mechanism, scene: &Scene) -> Option<Deepest> {
    let sizes: Vec<f64> = scene.bodies.iter().map(smallest_half_extent).collect();
    let of = |bodies: Option<(usize, Option<usize>)>, depth: f64, time: f64| {
        let (first, second) = bodies?;
        let sized = [Some(first), second].into_iter().flatten().map(|body| (body, sizes[body]));
        let (body, size) = sized.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(Deepest { pair: (first, second), body, depth, size, time })
    };
    let mut worst: Option<Deepest> = None;
    for state in &recording.samples {
        mechanism.gaps_within(&state.position, 0.0, &mut |gap, bodies| {
            let Some(next) = of(bodies, -gap, state.time) else { return };
            // the first of several that are as deep
            if worst.as_ref().is_none_or(|worst| next.depth / next.size > worst.depth / worst.size) {
                worst = Some(next);
            }
        });
    }
    worst
}

/// The radius, or the smallest half edge or half height \[m\].
fn smallest_half_extent(body: &Body) -> f64 {
    let round = [body.sphere.map(|sphere| sphere.radius), body.capsule.map(|capsule| capsule.radius)];
    let cylinder = body.cylinder.map(|cylinder| cylinder.radius.min(cylinder.half_height));
    let cuboid = body.cuboid.map(|cuboid| cuboid.half_extents.into_iter().fold(f64::INFINITY, f64::min));
    round.into_iter().chain([cylinder, cuboid]).flatten().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::named;
    use crate::schemes::{MoreauJean, simulate};
    use crate::solvers::Auto;

    fn remarked(step: f64) -> Option<String> {
        let scene = named("ball-drop").expect("built in");
        let (mechanism, start) = scene.mechanism().expect("planar");
        let steps = (scene.duration / step).round() as usize;
        let run = simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, step, steps).expect("a ball");
        remark(&run, mechanism.as_ref(), &scene)
    }

    #[test]
    fn a_ball_that_is_deep_in_the_ground_at_large_steps_is_remarked_on_and_at_small_ones_not() {
        let text = remarked(0.05).expect("it lands at 4.4 m/s, up to 0.22 m a step");
        assert!(text.starts_with("ball and ground overlap by ") && text.contains("half extent of ball, 0.1 m"), "{text}");
        assert_eq!(remarked(0.001), None);
    }

    #[test]
    fn bodies_that_overlap_from_the_beginning_are_not_told_to_take_a_smaller_step() {
        let mut scene = named("ball-drop").expect("built in");
        scene.bodies[0].position[2] = 0.02;
        let (mechanism, start) = scene.mechanism().expect("planar");
        let run = simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, 0.001, 3).expect("a ball");
        let text = remark(&run, mechanism.as_ref(), &scene).expect("eighty per cent of its radius");
        assert!(text.contains("placed so") && !text.contains("--step"), "{text}");
        assert!(remarked(0.05).is_some_and(|text| text.contains("--step") && !text.contains("placed")));
    }

    #[test]
    fn the_smallest_half_extent_is_that_of_the_shape() {
        let mut body = Body::cuboid("box", 1.0, [0.3, 0.1, 0.2], [0.0; 3]);
        assert_eq!(smallest_half_extent(&body), 0.1);
        body.cuboid = None;
        body.cylinder = Some(crate::scenes::Cylinder { radius: 0.5, half_height: 0.25 });
        assert_eq!(smallest_half_extent(&body), 0.25);
        assert_eq!(smallest_half_extent(&Body::sphere("ball", 1.0, 0.4, [0.0; 3])), 0.4);
    }
}
