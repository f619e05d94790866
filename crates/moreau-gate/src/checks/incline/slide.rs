//! The sliding box: acceleration and the momentum law.

use crate::checks::incline::scenes::{box_gap, slope, slope_box};
use crate::checks::motion::Sample;
use crate::checks::scenery::GRAVITY;
use crate::model::addition::Addition;
use crate::model::damping::driven;
use crate::model::sliding::hops;
use crate::model::{Model, convex};
use crate::tolerance::flight::damped_velocity;
use crate::tolerance::incline as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_contact::cones::polyhedral;

/// Duration of the motion \[s\].
const DURATION: f64 = 0.25;

const FRICTION: f64 = 0.3;

/// Speed down the slope at the start \[m/s\], so that no corner sticks.
const SPEED: f64 = 1.0;

pub(super) fn slide(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    bench.predicts(&[Addition::StaticFriction, Addition::TorsionalFriction]);
    let model = Model::of(bench.description());
    let mut scene = slope_box("slide", [0.1, 0.1, 0.05], box_gap(bench, h, FRICTION, SPEED), FRICTION);
    let slope = slope(&scene)?;
    scene.bodies[0].linear_velocity = (slope.down * SPEED).into();
    let steps = (DURATION / h).round() as usize;
    let motion = bench.simulate(&scene, h, steps, steps)?;
    let (end, time) = (Sample::of(&motion.bodies[0], 1), steps as f64 * h);
    let (gained, up) = (end.velocity.dot(&slope.down) - SPEED, end.velocity.dot(&slope.normal));
    let exact = slope.pull - FRICTION * slope.press;
    let law = prediction(&model, (FRICTION * slope.press, slope.press), exact, 0.5 * SPEED, (h, time));
    let hop = if hops(bench.description()) { FRICTION * up / time } else { 0.0 };
    let hopped = law.clone().map(|law| Expectation { value: law.value - hop, ..law });
    let ideal = Expectation::equal(exact, tolerance::slide(FRICTION, slope.press, h, time), "g (sin α − μ cos α)");
    let balance = Expectation::equal(exact, tolerance::momentum(slope.press), "g (sin α − μ cos α), whatever the normal impulses");
    let slowed = |ideal: &Expectation| model.damping().map(|(damping, _)| damped(damping, exact, ideal, h, time));
    let (hopped, law) = (slowed(&ideal).or(hopped), slowed(&balance).or(law));
    Ok(vec![
        Measurement::new("acceleration", "m/s^2", gained / time, ideal).predicted(hopped),
        Measurement::new("(v_t + μ v_n)/T, less the initial speed", "m/s^2", (gained + FRICTION * up) / time, balance).predicted(law),
    ])
}

/// The mean acceleration of a slide under declared damping: v̇ = a − c v. The gravity and the friction of a step may each be damped or not.
fn damped(damping: f64, acceleration: f64, ideal: &Expectation, h: f64, time: f64) -> Expectation {
    let slowed = (driven(damping, acceleration, SPEED, time) - SPEED) / time;
    let error = damped_velocity(damping, GRAVITY, SPEED + GRAVITY * time, time, h) / time;
    Expectation::equal(slowed, ideal.tolerance + error, "v̇ = g (sin α − μ cos α) − c v with the declared damping")
}

/// (v_t − v₀ + μ v_n)/T of a slide with `slip` \[m/s\] and more, μ g_n and g_n being (`full`, `press`) \[m/s²\], where the declared law is
/// not Coulomb's or hops; `None` otherwise. (h, T) are \[s\].
pub(in crate::checks) fn prediction(
    model: &Model,
    (full, press): (f64, f64),
    acceleration: f64,
    slip: f64,
    (h, time): (f64, f64),
) -> Option<Expectation> {
    let (most, why) = match model {
        Model::StewartTrinkle { directions } => (full * polyhedral::strength_error(*directions), "friction between μ cos(π/d) and μ"),
        Model::DrakeRegularised { stiction_tolerance, .. } => {
            // 1 − c(s) ≤ 1/(2 s²); a lagged law misses one step's friction.
            let slip = stiction_tolerance / slip;
            (full * (h / time + 0.5 * slip * slip), "friction lacks one step and 1 − c(s) of itself")
        }
        _ if convex(model) => (0.0, "the law's friction lies on the cone and is opposed to the slip; it hops"),
        _ => return None,
    };
    Some(Expectation::equal(acceleration + 0.5 * most, 0.5 * most + tolerance::momentum(press), why))
}
