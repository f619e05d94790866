//! A ball whose mass is far outside sticks on a slope with μ a little above what holds it: one contact, which shares its load with none.
//!
//! ```text
//!     J = κ m R² :   u̇ = g sin α − (1 + 1/κ) f/m ,    f = κ/(1 + κ) m g sin α ≤ μ m g cos α   sticks ,    v = g sin α t/(1 + κ)
//!     v̇ = g sin α − f/m ,   κ R ω̇ = f/m                         v + κ R ω = g sin α t ,  whatever f is
//! ```
//!
//! The last line tells J, which a ball that sticks hardly does: with 2/5 m R² it would stick, too.

use crate::checks::incline::scenes::slope;
use crate::checks::limits::sloping::{MARGIN, MASS, RADIUS, ball_on_slope};
use crate::checks::motion::{Sample, Slope, samples, yields};
use crate::checks::scenery::{between, worst};
use crate::description::Friction;
use crate::model::Model;
use crate::model::addition::Addition;
use crate::tolerance::{incline, limits as tolerance};
use crate::{Bench, Expectation, Measurement, Refusal, Reply};
use moreau_dynamics::scenes::{Body, Scene};

/// κ = J/(m R²).
const GYRATION: f64 = 100.0;
/// Duration \[s\]; measured is its second half.
const DURATION: f64 = 0.25;

/// The ball, with friction for a fiftieth more than holds it.
fn sticking(bench: &Bench, h: f64) -> Scene {
    let friction = (1.0 + MARGIN) * 20f64.to_radians().tan() * GYRATION / (1.0 + GYRATION);
    let mut scene = ball_on_slope(bench, h, "ball with its mass outside", friction);
    scene.bodies = scene.bodies.into_iter().map(|ball| Body { inertia: Some([GYRATION * MASS * RADIUS * RADIUS; 3]), ..ball }).collect();
    scene
}

/// What pull and spin make together, and the mean slip of the ball over the second half, where the declared law holds it without creep by
/// a cone.
pub(super) fn ball(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let held = match Model::of(bench.description()) {
        Model::Coulomb(limits) => limits.force_mixing == 0.0,
        Model::Anitescu => true,
        _ => false,
    };
    if !held || yields(bench) || bench.description().friction != Friction::Cone {
        return Ok(Vec::new());
    }
    let scene = sticking(bench, h);
    let slope = slope(&scene)?;
    let half = (0.5 * DURATION / h).round() as usize;
    // an engine that takes no given inertia is asked for the rest
    let motion = match bench.simulate(&scene, h, 2 * half, 1) {
        Err(Refusal::Unsupported(_)) => return Ok(Vec::new()),
        answer => answer?,
    };
    let states = samples(&motion.bodies[0]);
    let late = &states[half..];
    let slip = late.iter().map(|state| state.velocity_at(slope.normal * -RADIUS)).map(|velocity| along(&slope, velocity));
    let measured = slip.sum::<f64>() / late.len() as f64;
    let depth = late.iter().map(|state| (RADIUS - slope.height(&state.position)).abs()).fold(0.0, worst);
    let (time, speed) = (half as f64 * h, slope.pull * DURATION / (1.0 + GYRATION));
    let size = states[0].position.norm();
    let lever = tolerance::rim(speed, depth.min(incline::found(slope.press, h)), RADIUS);
    let allowed = incline::creep(slope.pull, h, bench.epsilon(), size, time) + lever;
    let law =
        pushed(bench, &scene, &slope, h).map(|most| between([0.0, most], allowed, "the fall after each declared correction of a depth"));
    let ideal = Expectation::at_most(0.0, allowed, "it sticks: its only contact holds a fiftieth more");
    let slips = Measurement::new("mean slip of a ball that needs 50/51 of μ", "m/s", measured, ideal).predicted(law);
    Ok(turns(bench, &slope, &states, h).into_iter().chain([slips]).collect())
}

/// (v + κ R ω)/T at the end, where nothing but the contact turns or slows the ball.
fn turns(bench: &Bench, slope: &Slope, states: &[Sample], h: f64) -> Option<Measurement> {
    let Model::Coulomb(limits) = Model::of(bench.description()) else { return None };
    let resists = Addition::RollingFriction.declared(bench.description()) > 0.0 || limits.linear_damping + limits.angular_damping > 0.0;
    let end = states.last().filter(|_| !resists)?;
    let time = (states.len() - 1) as f64 * h;
    // what it turns with at the lever κ R: the slip of a point there
    let spun = end.velocity_at(slope.normal * (GYRATION * RADIUS)).dot(&slope.down);
    let depth = states.iter().map(|state| (RADIUS - slope.height(&state.position)).abs()).fold(0.0, worst);
    let allowed = incline::momentum(slope.press) + tolerance::rim(slope.pull, depth, RADIUS);
    let ideal = Expectation::equal(slope.pull, allowed, "g sin α, whatever friction is");
    Some(Measurement::new("(v + 100 R ω)/T of a ball with J = 100 m R²", "m/s^2", spun / time, ideal))
}

/// Part of a velocity along the slope \[m/s\].
fn along(slope: &Slope, velocity: nalgebra::Vector3<f64>) -> f64 {
    velocity.dot(&slope.down).hypot(velocity.dot(&slope.side))
}

/// The most that a ball slips on the average which a rigid engine pushes off the slope \[m/s\].
fn pushed(bench: &Bench, scene: &Scene, slope: &Slope, h: f64) -> Option<f64> {
    let Model::Coulomb(limits) = Model::of(bench.description()) else { return None };
    let taken = limits.taken_back();
    (taken > 0.0).then(|| incline::pushed_creep(taken, scene.material.friction * slope.press, h))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::judge;
    use crate::runner::SWEEP;
    use nalgebra::Vector3;

    /// The ball with J = κ m R² in place of 100 m R²: the two verdicts of the ball.
    fn with_gyration(h: f64, gyration: f64) -> [Verdict; 2] {
        let measured = judge("limits/stick", h, |scene, index, _, t| {
            let slope = Slope::of(scene).expect("a plane");
            let body = &scene.bodies[index];
            let speed = slope.pull * t / (1.0 + gyration);
            let place = Vector3::from(body.position) + slope.down * (0.5 * speed * t);
            (place.into(), body.orientation, (slope.down * speed).into(), (slope.side * (speed / RADIUS)).into())
        });
        let [.., turns, slips] = &measured[..] else { panic!("{measured:?}") };
        [turns, slips].map(Measurement::verdict)
    }

    #[test]
    fn a_ball_with_another_inertia_than_the_given_one_sticks_as_well_and_fails() {
        for h in SWEEP {
            assert_eq!(with_gyration(h, GYRATION), [Verdict::Pass; 2], "{h}");
            for wrong in [0.4, 0.97 * GYRATION, 1.03 * GYRATION] {
                assert_eq!(with_gyration(h, wrong), [Verdict::Fail, Verdict::Pass], "{wrong} at {h}");
            }
        }
    }

    /// The ball that rolls and, every other step, slips with a part of g sin α h.
    fn verdict(h: f64, part: f64) -> Verdict {
        let measured = judge("limits/stick", h, |scene, index, _, t| {
            let slope = Slope::of(scene).expect("a plane");
            let body = &scene.bodies[index];
            let share = 1.0 / (1.0 + GYRATION);
            let every_other = ((t / h).round() as usize % 2) as f64;
            let speed = share * slope.pull * t;
            let velocity = slope.down * (speed + part * slope.pull * h * every_other);
            let place = Vector3::from(body.position) + slope.down * (0.5 * speed * t);
            (place.into(), body.orientation, velocity.into(), (slope.side * (speed / RADIUS)).into())
        });
        measured.last().expect("measurements").verdict()
    }

    #[test]
    fn a_ball_that_sticks_passes_and_one_that_slips_a_hundredth_of_a_step_s_pull_every_other_step_fails() {
        for h in SWEEP {
            assert_eq!(verdict(h, 0.0), Verdict::Pass, "{h}");
            assert_eq!(verdict(h, 0.01), Verdict::Fail, "{h}");
        }
    }
}
