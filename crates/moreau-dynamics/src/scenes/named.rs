//! The built-in scenes.

use super::{Body, Ground, Material, Scene};
use moreau_exact::{Error, Result};
use std::collections::BTreeMap;

/// The names [`named`] knows.
pub const NAMES: [&str; 9] = [
    "ball-drop",
    "bouncing-ball",
    "elastic-ball",
    "incline-stick",
    "incline-slide",
    "box-stack",
    "two-ball-impact",
    "rolling-disk",
    "rolling-sphere",
];

/// Standard gravity of the scenes \[m/s²\].
const GRAVITY: f64 = 9.81;

/// Inclination of the slopes \[rad\], 20°; tan 20° = 0.364 lies between the two friction coefficients.
const INCLINE: f64 = std::f64::consts::PI / 9.0;

/// A built-in scene.
///
/// # Errors
/// [`Error::Unsupported`] lists the known names.
///
/// ```
/// use moreau_dynamics::scenes::{NAMES, named};
///
/// let (mechanism, start) = named("box-stack")?.mechanism()?;
/// assert!(start.velocity.amax() == 0.0 && !mechanism.contacts(&start.position).is_empty());
/// assert!(NAMES.iter().all(|name| named(name).is_ok()) && named("no-such-scene").is_err());
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn named(name: &str) -> Result<Scene> {
    match name {
        "ball-drop" => Ok(ball(name, "A 1 kg sphere falls 1 m onto the ground and stays.", 0.0)),
        "bouncing-ball" => Ok(ball(name, "A 1 kg sphere falls 1 m and bounces infinitely often in finite time.", 0.5)),
        "elastic-ball" => Ok(ball(name, "A 1 kg sphere falls 1 m and bounces for ever.", 1.0)),
        "incline-stick" => Ok(block(name, "A 1 kg block on a 20 degree incline; 0.5 > tan 20: it must not move.", 0.5)),
        "incline-slide" => Ok(block(name, "A 1 kg block on a 20 degree incline; 0.3 < tan 20: it slides down.", 0.3)),
        "box-stack" => Ok(stack(name)),
        "two-ball-impact" => Ok(two_balls(name)),
        "rolling-disk" => {
            Ok(rolling(name, "A disk slides at 1 m/s until friction makes it roll, at 2/3 m/s.", Some([0.0025, 0.005, 0.0025])))
        }
        "rolling-sphere" => Ok(rolling(name, "A sphere slides at 1 m/s until friction makes it roll, at 5/7 m/s.", None)),
        _ => Err(Error::Unsupported(format!("unknown scene `{name}`; known: {}", NAMES.join(", ")))),
    }
}

fn scene(name: &str, description: &str, bodies: Vec<Body>, friction: f64, restitution: f64) -> Scene {
    Scene {
        schema: super::scene::SCHEMA.into(),
        name: name.into(),
        description: description.into(),
        gravity: [0.0, 0.0, -GRAVITY],
        ground: Some(Ground { normal: [0.0, 0.0, 1.0], offset: 0.0 }),
        bodies,
        material: Material { friction, restitution, pairs: Vec::new() },
        duration: 2.0,
        engines: BTreeMap::new(),
    }
}

fn cuboid(name: &str, half_extents: [f64; 3], position: [f64; 3]) -> Body {
    Body::cuboid(name, 1.0, half_extents, position)
}

fn ball(name: &str, description: &str, restitution: f64) -> Scene {
    scene(name, description, vec![Body::sphere("ball", 1.0, 0.1, [0.0, 0.0, 1.1])], 0.5, restitution)
}

/// A flat block that touches the slope with its whole lower face.
fn block(name: &str, description: &str, friction: f64) -> Scene {
    let (sine, cosine) = INCLINE.sin_cos();
    let (half_sine, half_cosine) = (INCLINE / 2.0).sin_cos();
    let half_height = 0.05;
    let mut body = cuboid("block", [0.1, 0.1, half_height], [half_height * sine, 0.0, half_height * cosine]);
    body.orientation = [half_cosine, 0.0, half_sine, 0.0];
    let ground = Some(Ground { normal: [sine, 0.0, cosine], offset: 0.0 });
    Scene { ground, duration: 1.0, ..scene(name, description, vec![body], friction, 0.0) }
}

fn stack(name: &str) -> Scene {
    let half = 0.1;
    let bodies = (0..5).map(|k| cuboid(&format!("box{}", k + 1), [half; 3], [0.0, 0.0, f64::from(2 * k + 1) * half]));
    Scene { duration: 1.0, ..scene(name, "Five 1 kg cubes of 0.2 m stand on each other.", bodies.collect(), 0.5, 0.0) }
}

/// Without gravity and ground: the heavy sphere goes on, the light one leaves faster.
fn two_balls(name: &str) -> Scene {
    let mut heavy = Body::sphere("heavy", 2.0, 0.1, [-0.6, 0.0, 0.0]);
    heavy.linear_velocity = [1.0, 0.0, 0.0];
    let bodies = vec![heavy, Body::sphere("light", 1.0, 0.1, [0.0, 0.0, 0.0])];
    let description = "A 2 kg sphere at 1 m/s hits a 1 kg sphere at rest, centrally, with restitution 1/2.";
    Scene { gravity: [0.0; 3], ground: None, duration: 1.0, ..scene(name, description, bodies, 0.0, 0.5) }
}

/// A round body of 1 kg and radius 0.1 m on level ground, thrown without spin; moments of inertia of a solid sphere, or others
/// \[kg·m²\] (a disk that rolls about y has m r²/2 about y and half of that across).
fn rolling(name: &str, description: &str, inertia: Option<[f64; 3]>) -> Scene {
    let mut body = Body::sphere(if inertia.is_some() { "disk" } else { "sphere" }, 1.0, 0.1, [0.0, 0.0, 0.1]);
    body.linear_velocity = [1.0, 0.0, 0.0];
    body.inertia = inertia;
    Scene { duration: 1.0, ..scene(name, description, vec![body], 0.2, 0.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_scene_is_valid_survives_its_file_and_becomes_a_mechanism() {
        for name in NAMES {
            let scene = named(name).expect("listed");
            assert_eq!(scene.name, name);
            let text = scene.to_json().expect("valid");
            assert_eq!(Scene::from_json(&text).expect("what is written can be read"), scene);
            let (mechanism, state) = scene.mechanism().expect("planar");
            assert_eq!(state.position.len(), mechanism.degrees_of_freedom());
        }
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let message = named("perpetuum mobile").expect_err("unknown").to_string();
        assert!(message.contains("ball-drop") && message.contains("two-ball-impact"), "{message}");
    }
}
