//! A plank that slides on a plank: on the floor, which holds the lower one, or on a floor without friction.
//!
//! ```text
//!     upper   ‖w‖ M/(m + M) + μ v_n = … − μ g t          for every sequence of normal impulses, while it slips with w, along no edge
//!     lower   held: μ m g ≤ μ (m + M) g
//!             free: m v + M V = m v₀ ,   V + … = (m/M) μ g t
//! ```

use crate::checks::conveyor::pyramid;
use crate::checks::incline::slide::prediction;
use crate::checks::motion::{Sample, does_not_hop, pushed_to_hop, start_gap, stays_closed};
use crate::checks::scenery::{GRAVITY, between, cuboid, over_floor};
use crate::model::Model;
use crate::model::sliding::hops;
use crate::tolerance::{impact, incline};
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, PairOverride, Scene};
use nalgebra::Vector3;

const FRICTION: f64 = 0.3;
/// Of the upper plank \[m/s\]; it slides all the time.
const SPEED: f64 = 2.0;
/// \[s\].
const DURATION: f64 = 0.25;
/// Upper and lower \[kg\].
const MASSES: [f64; 2] = [1.0, 4.0];
/// Of the upper and the lower plank \[m\].
const UPPER: [f64; 3] = [0.3, 0.2, 0.05];
const LOWER: [f64; 3] = [1.5, 0.4, 0.1];

/// Where the upper plank starts \[m\]: it stays over the lower one.
const START: [f64; 2] = [-0.5, -0.15];

/// The direction of the slide, along no edge of the planks.
fn along() -> Vector3<f64> {
    Vector3::new(4.0, 3.0, 0.0) / 5.0
}

/// Both as deep as they lie, by declaration.
fn scene(bench: &Bench, h: f64) -> Scene {
    let floor = LOWER[2] + start_gap(bench, h, (MASSES[0] + MASSES[1], 4.0), GRAVITY, FRICTION, 0.0);
    let height = floor + LOWER[2] + UPPER[2] + start_gap(bench, h, (MASSES[0], 4.0), GRAVITY, FRICTION, SPEED);
    let [x, y] = START;
    let upper = Body { linear_velocity: (along() * SPEED).into(), ..cuboid("upper", MASSES[0], UPPER, [x, y, height]) };
    over_floor("plank on plank", vec![upper, cuboid("lower", MASSES[1], LOWER, [0.0, 0.0, floor])], FRICTION)
}

/// Upper and lower plank at the end, and when that is \[s\].
fn end(bench: &mut Bench, scene: &Scene, h: f64) -> Reply<([Sample; 2], f64)> {
    let steps = steps(h);
    let motion = bench.simulate(scene, h, steps, steps)?;
    Ok(([0, 1].map(|k| Sample::of(&motion.bodies[k], 1)), steps as f64 * h))
}

/// Steps of [`DURATION`].
fn steps(h: f64) -> usize {
    (DURATION / h).round() as usize
}

/// (‖w‖ (M/(m + M)) + μ v_n − …)/T of the upper plank, whose slip w against the lower one of mass M falls by what both feel; a plank that
/// the floor holds has no M.
fn braked(bench: &Bench, h: f64, words: &str, [upper, lower]: &[Sample; 2], (share, time): (f64, f64)) -> Measurement {
    let exact = -FRICTION * GRAVITY;
    let slip = (upper.velocity - lower.velocity).xy().norm();
    let gained = share * (slip - SPEED) + FRICTION * upper.velocity.z;
    let ideal = Expectation::equal(exact, incline::momentum(GRAVITY), "−μ g, whatever the normal impulses");
    let model = Model::of(bench.description());
    // a law that hops and softens friction with σ w μ n₀ of each landing has some of it
    let softened = matches!(model, Model::DrakeRegularised { .. }) && hops(bench.description());
    let some = || Expectation::equal(0.5 * exact, -0.5 * exact + incline::momentum(GRAVITY), "friction that landings soften, up to μ g");
    let full = || prediction(&model, (FRICTION * GRAVITY, GRAVITY), exact, 0.5 * SPEED, (h, time));
    let edged = pyramid(bench).map(|([low, high], why)| {
        // friction is part · μ (g t + v_n), and μ v_n is added in full
        let part = |part: f64| part * exact + (1.0 - part) * FRICTION * upper.velocity.z / time;
        let law = between([low, high].map(part), incline::momentum(GRAVITY), why);
        Expectation { tolerance: law.tolerance + full().map_or(0.0, |law| law.tolerance), ..law }
    });
    let law = if softened { Some(some()) } else { edged.or_else(full) };
    Measurement::new(format!("(v_t + μ v_n)/T of the upper plank, less the initial speed{words}"), "m/s^2", gained / time, ideal)
        .predicted(law)
}

pub(super) fn plank_on_plank(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    super::meeting::undamped(bench)?;
    does_not_hop(bench)?;
    let (planks, time) = end(bench, &scene(bench, h), h)?;
    let aside = planks[0].velocity.cross(&along()).z.abs();
    let straight = Expectation::at_most(
        0.0,
        incline::momentum(GRAVITY) * time + impact::velocity(bench.epsilon()) * SPEED,
        "friction is opposed to the slip",
    );
    let mut measured = vec![braked(bench, h, "", &planks, (1.0, time))];
    // along a pyramid's edges friction is beside the slip, and where corners open the plank turns
    if pyramid(bench).is_none() && stays_closed(bench, steps(h), LOWER[0]) {
        measured.push(Measurement::new("sideward speed of the upper plank", "m/s", aside, straight));
    }
    Ok(measured)
}

/// The same on a floor that has no friction for the lower plank, which is a pair of its own; nothing where declared corrections let planks
/// hop.
pub(super) fn on_smooth_floor(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    if pushed_to_hop(bench) {
        return Ok(Vec::new());
    }
    let mut scene = scene(bench, h);
    scene.material.pairs = vec![PairOverride { bodies: ["ground".into(), "lower".into()], friction: Some(0.0), restitution: None }];
    let (planks, time) = end(bench, &scene, h)?;
    let momentum = (planks[0].velocity * MASSES[0] + planks[1].velocity * MASSES[1]).xy();
    let kept_along = (momentum - along().xy() * (MASSES[0] * SPEED)).norm();
    let kept = Expectation::at_most(
        0.0,
        impact::velocity(bench.epsilon()) * MASSES[0] * SPEED + incline::momentum(GRAVITY) * time * MASSES[0],
        "the floor has no friction, and the planks' is opposite",
    );
    Ok(vec![
        braked(bench, h, ", on a floor without friction", &planks, (MASSES[1] / (MASSES[0] + MASSES[1]), time)),
        Measurement::new("change of momentum along the floor of both planks", "kg*m/s", kept_along, kept),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{declaring_a_pyramid, refusal};
    use nalgebra::UnitQuaternion;
    use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

    fn moving(velocity: Vector3<f64>) -> Sample {
        Sample { position: Vector3::zeros(), rotation: UnitQuaternion::identity(), velocity, spin: Vector3::zeros() }
    }

    #[test]
    fn a_plank_that_rises_at_either_end_of_a_pyramid_is_a_difference_and_one_beyond_it_fails() {
        let verdict = |part: f64, rising: f64| {
            let slip = SPEED - part * FRICTION * (GRAVITY * DURATION + rising);
            let planks = [along() * slip + Vector3::z() * rising, Vector3::zeros()].map(moving);
            declaring_a_pyramid(|bench| braked(bench, 0.01, "", &planks, (1.0, DURATION)).verdict())
        };
        for rising in [-0.2, 0.0, 0.2] {
            assert_eq!([FRAC_1_SQRT_2, SQRT_2].map(|part| verdict(part, rising)), [Verdict::Difference; 2], "{rising}");
            assert_eq!([0.7, 1.42].map(|part| verdict(part, rising)), [Verdict::Fail; 2], "{rising}");
        }
    }

    #[test]
    fn planks_that_declared_corrections_let_hop_are_not_asked() {
        let reason = refusal("pair/plank-on-plank", 0.01, &[("error_reduction", 0.4, "1")]);
        assert!(reason.is_some_and(|reason| reason.contains("error_reduction")));
        assert_eq!(refusal("pair/plank-on-plank", 0.01, &[("error_reduction", 0.3, "1")]), None);
    }
}
