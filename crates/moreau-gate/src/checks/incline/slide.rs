//! The sliding box: acceleration and the momentum law.

use crate::checks::incline::scenes::{box_gap, slope, slope_box};
use crate::checks::motion::{Sample, Slope};
use crate::model::sliding::hops;
use crate::model::{Model, convex};
use crate::tolerance::incline as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_contact::cones::polyhedral;

/// Duration of the motion \[s\].
const DURATION: f64 = 0.25;

const FRICTION: f64 = 0.3;

/// Speed down the slope at the start \[m/s\], so that no corner sticks.
const SPEED: f64 = 1.0;

pub(super) fn slide(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let model = Model::of(bench.description());
    let mut scene = slope_box("slide", [0.1, 0.1, 0.05], box_gap(bench, h, FRICTION, SPEED), FRICTION);
    let slope = slope(&scene)?;
    scene.bodies[0].linear_velocity = (slope.down * SPEED).into();
    let steps = (DURATION / h).round() as usize;
    let motion = bench.simulate(&scene, h, steps, steps)?;
    let (end, time) = (Sample::of(&motion.bodies[0], 1), steps as f64 * h);
    let (gained, up) = (end.velocity.dot(&slope.down) - SPEED, end.velocity.dot(&slope.normal));
    let exact = slope.pull - FRICTION * slope.press;
    let law = prediction(&model, &slope, exact, h, time);
    let hop = if hops(bench.description()) { FRICTION * up / time } else { 0.0 };
    let hopped = law.clone().map(|law| Expectation { value: law.value - hop, ..law });
    let ideal = Expectation::equal(exact, tolerance::slide(FRICTION, slope.press, h, time), "g (sin α − μ cos α)");
    let balance = Expectation::equal(exact, tolerance::momentum(slope.press), "g (sin α − μ cos α), whatever the normal impulses");
    Ok(vec![
        Measurement::new("acceleration", "m/s^2", gained / time, ideal).predicted(hopped),
        Measurement::new("(v_t + μ v_n)/T, less the initial speed", "m/s^2", (gained + FRICTION * up) / time, balance).predicted(law),
    ])
}

/// (v_t − v₀ + μ v_n)/T of a slide at full speed, where the declared law is not Coulomb's or hops; `None` otherwise.
fn prediction(model: &Model, slope: &Slope, acceleration: f64, h: f64, time: f64) -> Option<Expectation> {
    let full = FRICTION * slope.press;
    let (most, why) = match model {
        Model::StewartTrinkle { directions } => (full * polyhedral::strength_error(*directions), "friction between μ cos(π/d) and μ"),
        Model::DrakeRegularised { stiction_tolerance, .. } => {
            // 1 − c(s) ≤ 1/(2 s²) at slips of half the initial speed and more; a lagged law misses one step's friction.
            let slip = stiction_tolerance / (0.5 * SPEED);
            (full * (h / time + 0.5 * slip * slip), "friction lacks one step and 1 − c(s) of itself")
        }
        _ if convex(model) => (0.0, "the law's friction lies on the cone and is opposed to the slip; it hops"),
        _ => return None,
    };
    Some(Expectation::equal(acceleration + 0.5 * most, 0.5 * most + tolerance::momentum(slope.press), why))
}
