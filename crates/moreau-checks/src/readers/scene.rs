//! Readers of `scene/1`.

use super::{refused, same, with};
use crate::finding::Finding;
use moreau_dynamics::scenes::Scene;
use moreau_exact::Result;

/// A reader of scenes.
pub type ReadsScene = fn(&str) -> Result<Scene>;

/// A ball and a turned box over a tilted plane, every number once.
pub(crate) const SCENE: &str = r#"{"schema": "scene/1", "name": "two", "gravity": [0.1, 0.2, -9.81],
    "ground": {"normal": [0, 0.6, 0.8], "offset": 0.25},
    "bodies": [
        {"name": "ball", "sphere": {"radius": 0.5}, "mass": 2, "inertia": [0.11, 0.12, 0.13], "position": [1, 2, 3],
         "linear_velocity": [4, 5, 6], "angular_velocity": [7, 8, 9]},
        {"name": "block", "box": {"half_extents": [0.3, 0.4, 0.7]}, "mass": 1.25, "position": [-1, -2, 8],
         "orientation": [0.1, 0.5, 0.7, 0.5]}],
    "material": {"friction": 0.45, "restitution": 0.35, "pairs": [{"bodies": ["ball", "block"], "friction": 0.15}]}, "duration": 1.5}"#;

/// Every number of a scene stands where the format says.
///
/// # Errors
/// None: a text that is not read fails every finding.
pub fn as_written(subject: &ReadsScene) -> Result<Vec<Finding>> {
    let scene = subject(SCENE);
    Ok(vec![
        same("gravity", &scene, |s| s.gravity, [0.1, 0.2, -9.81]),
        same("ground", &scene, |s| s.ground.map(|g| (g.normal, g.offset)), Some(([0.0, 0.6, 0.8], 0.25))),
        same("names", &scene, |s| s.bodies.iter().map(|b| b.name.clone()).collect(), vec!["ball".to_string(), "block".to_string()]),
        same("radius", &scene, |s| s.bodies[0].sphere.map(|sphere| sphere.radius), Some(0.5)),
        same("half extents", &scene, |s| s.bodies[1].cuboid.map(|cuboid| cuboid.half_extents), Some([0.3, 0.4, 0.7])),
        same("masses", &scene, |s| s.bodies.iter().map(|b| b.mass).collect(), vec![2.0, 1.25]),
        same("inertia", &scene, |s| s.bodies.iter().map(|b| b.inertia).collect(), vec![Some([0.11, 0.12, 0.13]), None]),
        same("positions", &scene, |s| s.bodies.iter().map(|b| b.position).collect(), vec![[1.0, 2.0, 3.0], [-1.0, -2.0, 8.0]]),
        same("orientation", &scene, |s| s.bodies[1].orientation, [0.1, 0.5, 0.7, 0.5]),
        same("an upright body", &scene, |s| s.bodies[0].orientation, [1.0, 0.0, 0.0, 0.0]),
        same("velocity", &scene, |s| s.bodies[0].linear_velocity, [4.0, 5.0, 6.0]),
        same("spin", &scene, |s| s.bodies[0].angular_velocity, [7.0, 8.0, 9.0]),
        same("friction", &scene, |s| s.material.friction, 0.45),
        same("restitution", &scene, |s| s.material.restitution, 0.35),
        same("friction of a pair", &scene, |s| s.material.pairs.iter().map(|pair| pair.friction).collect(), vec![Some(0.15)]),
        same("duration", &scene, |s| s.duration, 1.5),
    ])
}

/// Scenes that break the format in one place are refused.
///
/// # Errors
/// None.
pub fn refusals(subject: &ReadsScene) -> Result<Vec<Finding>> {
    let texts = [
        ("another version", with(SCENE, "scene/1", "scene/2")),
        ("a body without mass", with(SCENE, "\"mass\": 2", "\"mass\": 0")),
        ("a quaternion that is no rotation", with(SCENE, "[0.1, 0.5, 0.7, 0.5]", "[0.1, 0.5, 0.7, 0.6]")),
        ("a normal that is no direction", with(SCENE, "[0, 0.6, 0.8]", "[0, 0.6, 0.9]")),
        ("two bodies of one name", with(SCENE, "\"name\": \"block\"", "\"name\": \"ball\"")),
        (
            "a body with two shapes",
            with(SCENE, "\"sphere\": {\"radius\": 0.5}", "\"sphere\": {\"radius\": 0.5}, \"box\": {\"half_extents\": [1, 1, 1]}"),
        ),
        ("a coefficient of restitution above one", with(SCENE, "0.35", "1.35")),
        ("negative friction", with(SCENE, "0.45", "-0.45")),
        ("a pair that is not there", with(SCENE, "[\"ball\", \"block\"]", "[\"ball\", \"brick\"]")),
        ("a mass that is not a number", with(SCENE, "1.25", "NaN")),
        ("an unknown field", with(SCENE, "\"duration\"", "\"length\"")),
        ("a text cut short", SCENE[..SCENE.len() - 1].to_string()),
    ];
    Ok(refused(subject, texts))
}
