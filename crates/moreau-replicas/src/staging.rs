//! A scene as a scheme runs it: in the plane or in space, and plastic where the scheme has no restitution.

use moreau_dynamics::scenes::{Scene, Staged};
use moreau_dynamics::schemes::Scheme;
use moreau_exact::Result;

/// What [`plastic_if_needed`] says of a scheme without restitution.
pub const PLASTIC: &str = "this scheme has no restitution: every impact is plastic, e = 0 in place of the scene's";

/// What it says of MuJoCo's.
pub const SOFT: &str = "soft contact has no restitution: how far a body bounces follows from solref and solimp, not from the scene's e";

/// What it says of Drake's.
pub const COMPLIANT: &str =
    "compliant contact has no restitution: how far a body bounces follows from stiffness, dissipation and h, not from the scene's e";

/// The scene's mechanism. How soft a body rests depends on the number of its contact points, which is that of the body in space.
///
/// # Errors
/// Those of [`Scene::staged`].
pub fn for_scheme(scene: &Scene, scheme: &str) -> Result<Staged> {
    let staged = scene.staged()?;
    if scheme != "mujoco" {
        return Ok(staged);
    }
    let (mechanism, start) = scene.spatial_mechanism()?;
    Ok(Staged { mechanism, start, ..staged })
}

/// The scene with e of every pair where it is given, and plastic for a scheme that has no restitution, with a note where that changes it.
pub fn plastic_if_needed(mut scene: Scene, scheme: &dyn Scheme, name: &str, restitution: Option<f64>) -> (Scene, Option<&'static str>) {
    let bounces = scene.material.restitution != 0.0 || scene.material.pairs.iter().any(|pair| pair.restitution.is_some_and(|e| e != 0.0));
    let plastic = !scheme.has_restitution() && bounces;
    if let Some(restitution) = if plastic { Some(0.0) } else { restitution } {
        scene.material.restitution = restitution;
        scene.material.pairs.iter_mut().for_each(|pair| pair.restitution = None);
    }
    let note = match name {
        "mujoco" => SOFT,
        name if name.starts_with("drake-") => COMPLIANT,
        _ => PLASTIC,
    };
    (scene, plastic.then_some(note))
}
