//! Two rods that lie across each other meet with their sides, beside the middle of both, without friction.
//!
//! ```text
//!     1/m₁ + a²/J₁ + 1/m₂ + b²/J₂ = W_n ,    W_n p = (1 + e) |u_n| ,    L = l × p n
//! ```
//! The axes are at right angles to each other and to n, so that the points next to each other are the same at every distance.

use crate::checks::pair::compliant;
use crate::checks::pair::meeting::{GAP, SPEED, in_space, undamped};
use crate::checks::pair::strike::Strike;
use crate::checks::pair::view::View;
use crate::{Bench, Measurement, Refusal, Reply};
use moreau_dynamics::scenes::Body;
use nalgebra::Vector3;
use std::f64::consts::FRAC_1_SQRT_2;

/// Radius and half the height \[m\], large against the motion of a step.
const SIZE: [f64; 2] = [1.0, 5.0];
/// Of the upper and the lower rod \[kg\].
const MASSES: [f64; 2] = [1.0, 2.0];
/// From the middle of the upper and of the lower rod to where they cross \[m\].
const ARMS: [f64; 2] = [1.5, 1.0];

/// A rod, by its name, mass and place.
type Rod = fn(&str, f64, [f64; 3]) -> Body;

fn capsule(name: &str, mass: f64, place: [f64; 3]) -> Body {
    Body::capsule(name, mass, SIZE[0], SIZE[1], place)
}

fn cylinder(name: &str, mass: f64, place: [f64; 3]) -> Body {
    Body::cylinder(name, mass, SIZE[0], SIZE[1], place)
}

/// The upper and the lower rod.
const PAIRS: [(&str, [Rod; 2]); 3] =
    [("capsules", [capsule, capsule]), ("capsule on cylinder", [capsule, cylinder]), ("cylinders", [cylinder, cylinder])];

/// The upper rod along x comes down on the lower one along y.
fn strike<'a>(words: &'a str, [upper, lower]: [Rod; 2], e: f64) -> Strike<'a> {
    let [radius, _] = SIZE;
    let turned = |body: Body, orientation: [f64; 4]| Body { orientation, ..body };
    let upper = turned(upper("upper", MASSES[0], [ARMS[0], ARMS[1], 2.0 * radius + GAP]), [FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2, 0.0]);
    let lower = turned(lower("lower", MASSES[1], [0.0; 3]), [FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.0, 0.0]);
    let upper = Body { linear_velocity: [0.0, 0.0, -SPEED], ..upper };
    let levers = [Vector3::new(-ARMS[0], 0.0, -radius), Vector3::new(0.0, ARMS[1], radius)];
    let scene = in_space("crossed rods", vec![upper, lower], 0.0, e);
    Strike { words, scene, normal: -Vector3::z(), levers, speed: SPEED, spread: 0.0, springs: Vec::new() }
}

pub(super) fn crossed(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let e = if bench.description().restitution { 0.5 } else { 0.0 };
    let mut measured = Vec::new();
    let mut unknown = None;
    for (name, rods) in PAIRS {
        let words = format!(", {name}");
        let mut strike = strike(&words, rods, e);
        strike.springs = compliant::one_point(bench, strike.inverse_mass(), &MASSES, h);
        // an engine that does not know a pair of shapes is judged by the others
        match strike.measured(bench, h, &View::turned(false)) {
            Err(Refusal::Unsupported(reason)) => unknown = Some(reason),
            answer => measured.extend(answer?),
        }
    }
    match unknown {
        Some(reason) if measured.is_empty() => Err(Refusal::Unsupported(reason)),
        _ => Ok(measured),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{RigidState, judge, measure};
    use crate::runner::SWEEP;
    use moreau_dynamics::scenes::Scene;

    #[test]
    fn our_engine_is_asked_every_pair_and_one_whose_cylinders_pass_through_each_other_fails_that_pair_alone() {
        let worst = |measured: &[Measurement], name: &str| {
            measured.iter().filter(|one| one.quantity.contains(&format!(", {name}"))).map(Measurement::verdict).max()
        };
        let right = measure("round/crossed", 0.01, &mut crate::own::by_name("moreau-jean").expect("listed"));
        let planted = crate::planted::find("round/cylinders-pass-through").expect("listed");
        let wrong = measure("round/crossed", 0.01, (planted.subject.engine)().as_mut());
        for (name, _) in PAIRS {
            assert_eq!(worst(&right, name), Some(Verdict::Pass), "{name}");
            let expected = if name == "cylinders" { Verdict::Fail } else { Verdict::Pass };
            assert_eq!(worst(&wrong, name), Some(expected), "{name}");
        }
    }

    /// J across the axis \[kg·m²\], written out: m (R²/4 + L²/3), and a capsule's with its two half balls.
    fn across(body: &Body) -> f64 {
        let [r, l] = SIZE;
        if body.cylinder.is_some() {
            return body.mass * (r * r / 4.0 + l * l / 3.0);
        }
        let balls = body.mass * 2.0 * r / (3.0 * l + 2.0 * r);
        (body.mass - balls) * (r * r / 4.0 + l * l / 3.0) + balls * (0.4 * r * r + l * l + 0.75 * l * r)
    }

    fn motion(scene: &Scene, index: usize, t: f64, [part, lever]: [f64; 2]) -> RigidState {
        let moments = [0, 1].map(|k| across(&scene.bodies[k]));
        let response: f64 = (0..2).map(|k| 1.0 / MASSES[k] + ARMS[k] * ARMS[k] / moments[k]).sum();
        let impulse = 1.5 * SPEED / response * part * [1.0, -1.0][index];
        let turn = View::turned(false).turn;
        let arm = [Vector3::new(-ARMS[0], 0.0, 0.0), Vector3::new(0.0, ARMS[1], 0.0)][index];
        let body = &scene.bodies[index];
        let before = Vector3::from(body.linear_velocity);
        let after = before + turn * Vector3::z() * (impulse / MASSES[index]);
        let spin = turn * arm.cross(&Vector3::z()) * (impulse * lever / moments[index]);
        let contact = GAP / SPEED;
        let place = Vector3::from(body.position) + before * t.min(contact) + after * (t - contact).max(0.0);
        let [velocity, spin] = if t < contact { [before, Vector3::zeros()] } else { [after, spin] };
        (place.into(), body.orientation, velocity.into(), spin.into())
    }

    #[test]
    fn the_closed_form_passes_and_another_impulse_or_lever_fails_at_every_step() {
        for h in SWEEP {
            let verdict = |parts: [f64; 2]| {
                let measured = judge("round/crossed", h, |scene, index, _, t| motion(scene, index, t, parts));
                measured.iter().map(Measurement::verdict).max().expect("measurements")
            };
            assert_eq!(verdict([1.0, 1.0]), Verdict::Pass, "{h}");
            for wrong in [[0.0, 1.0], [0.95, 1.0], [1.05, 1.0], [1.0, 0.5], [1.0, 0.0]] {
                assert_eq!(verdict(wrong), Verdict::Fail, "{wrong:?} at {h}");
            }
        }
    }
}
