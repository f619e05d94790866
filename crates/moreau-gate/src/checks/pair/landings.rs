//! A spinning ball and a sliding plate land without gravity, each with μ and e of its own pair with the ground.
//!
//! ```text
//!     p_n = (1 + e) m |u_n| ,    p_t = μ p_n  against the slip;  a plate so flat that friction does not tip it keeps its four corners down
//! ```

use crate::checks::pair::compliant::{self, Approach, restitution};
use crate::checks::pair::encounter::across;
use crate::checks::pair::friction;
use crate::checks::pair::meeting::{GAP, SPEED, steps};
use crate::checks::scenery::{cuboid, over_floor, sphere};
use crate::description::{Friction, Kind};
use crate::tolerance::pair as tolerance;
use crate::{Bench, Measurement, Reply};
use moreau_dynamics::scenes::{Body, PairOverride, Scene};
use nalgebra::Vector3;

/// μ and e of every pair without its own; none that meets has them.
pub(super) const COMMON: [f64; 2] = [0.6, 0.5];
/// \[kg\].
const MASS: f64 = 1.0;
/// Of the ball \[m\], large against the motion of a step.
const RADIUS: f64 = 4.0;
const PLATE: [f64; 3] = [8.0, 8.0, 0.5];
/// μ and e of the ball and of the plate with the ground, and the slip \[m/s\]; one of the coefficients of friction is more than 1.
const VALUES: [[f64; 3]; 2] = [[0.2, 0.25, 8.0], [1.2, 0.75, 20.0]];
const NAMES: [&str; 2] = ["ball", "plate"];

/// s in the plane of the floor.
fn along() -> Vector3<f64> {
    let [first, second] = [across().y, across().z];
    Vector3::new(first, second, 0.0)
}

/// The ground is named second once, and first once.
fn scene(bouncing: f64) -> Scene {
    let down = Vector3::z() * -SPEED;
    let ball = Body {
        linear_velocity: down.into(),
        // the lowest point moves along s
        angular_velocity: (along().cross(&Vector3::z()) * (VALUES[0][2] / RADIUS)).into(),
        ..sphere(NAMES[0], MASS, RADIUS, [0.0, 0.0, RADIUS + GAP])
    };
    let plate = cuboid(NAMES[1], MASS, PLATE, [60.0, 0.0, PLATE[2] + GAP]);
    let plate = Body { linear_velocity: (down + along() * VALUES[1][2]).into(), ..plate };
    let mut scene = Scene { gravity: [0.0; 3], ..over_floor("landings", vec![ball, plate], COMMON[0]) };
    scene.material.restitution = COMMON[1] * bouncing;
    let own = |bodies: [&str; 2], [mu, e, _]: [f64; 3]| PairOverride {
        bodies: bodies.map(String::from),
        friction: Some(mu),
        restitution: Some(e * bouncing),
    };
    scene.material.pairs = vec![own([NAMES[0], "ground"], VALUES[0]), own(["ground", NAMES[1]], VALUES[1])];
    scene
}

pub(super) fn with_the_ground(bench: &mut Bench, h: f64, bouncing: f64) -> Reply<Vec<Measurement>> {
    let scene = scene(bouncing);
    let steps = steps(h);
    let motion = bench.simulate(&scene, h, steps, steps)?;
    let mut measured = Vec::new();
    for (k, [mu, e, slip]) in VALUES.into_iter().enumerate() {
        let words = format!(", {} on the ground", NAMES[k]);
        let track = &motion.bodies[k];
        let gained = Vector3::from(track.linear_velocity[1]) - Vector3::from(track.linear_velocity[0]);
        // the corners of a plate that yield let friction tip it, and give its turning back along the normal
        let tips = k == 1 && bench.description().contact_model.kind == Kind::Compliant;
        let tipped = if tips { tolerance::tipped(mu, [PLATE[0], PLATE[2]]) } else { 0.0 };
        let corners = || compliant::points(bench, 1.0 / MASS, &[MASS], 4.0, h).into_iter().collect();
        let springs = if k == 0 { compliant::balls(bench, [(MASS, RADIUS)], h) } else { corners() };
        measured.extend(restitution(
            bench,
            h,
            (&words, e * bouncing),
            gained.z / SPEED - 1.0,
            tipped,
            mu * slip,
            (&springs, Approach::usual(h)),
        ));
        let (ideal, law) = friction::slipping(bench, mu, 0.0);
        let lever = tolerance::apart(SPEED + mu * slip, h) / RADIUS;
        let replays = k == 0 && bench.description().friction != Friction::Pyramid;
        let replayed = replays.then(|| friction::spheres_replayed(bench, h, [MASS, RADIUS], mu, slip)).flatten();
        let law = replayed.map(|impulses| friction::of_the_replay(friction::ratio(impulses), lever, 0.0, bench)).or(law);
        let value = friction::ratio([gained.z, gained.xy().norm()]);
        let ratio = || Measurement::new(format!("friction over normal impulse{words}"), "1", value, ideal);
        measured.extend(friction::on_the_cone(bench).then(|| ratio().predicted(law)));
    }
    Ok(measured)
}
