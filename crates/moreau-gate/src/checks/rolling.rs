//! A sphere from sliding to rolling, and down a slope without slipping.
//!
//! ```text
//!     angular momentum about the floor      m v R + I ω = m v₀ R ,  I = ⅖ m R²   ⇒   v = 5/7 v₀ when v = ω R
//!     while it slips                        slip = v₀ − 7/2 μ (g t + v_n)        whatever the normal impulses
//!     rolling down without slip             v̇ = 5/7 g sin α
//! ```
//! The final speed does not depend on the friction law at all: only on the point where friction acts, and on the inertia.

use crate::check::{Control, Expected, Run};
use crate::checks::motion::{Sample, Slope, samples, start_gap, yields};
use crate::checks::scenery::{GRAVITY, over_floor, sphere};
use crate::model::sliding::{SPHERE, full_slip, hops};
use crate::tolerance::rolling as tolerance;
use crate::{Bench, Check, Expectation, Level, Measurement, Refusal, Reply};
use moreau_dynamics::scenes::{Ground, Scene};
use nalgebra::Vector3;

const RADIUS: f64 = 0.1;
/// Speed without spin at the start \[m/s\].
const SPEED: f64 = 4.0;
const FRICTION: f64 = 0.3;

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "rolling/five-sevenths",
        level: Level::Simulate,
        question: "Does a sphere thrown along the floor end with 5/7 of its speed, rolling, and after the right time?",
        derivation: "Friction at the floor does not change the angular momentum about a point of the floor: v = 5/7 v₀. Slip falls as v₀ \
            − 7/2 μ (g t + v_n). So rolling begins at 2 v₀/(7 μ g), and by v_n/g earlier in a model that hops within the step. There is \
            no rolling resistance, so that speed and spin do not change after that. A contact at a depth δ has the lever R − δ.",
        source: "Newton–Euler and Coulomb; Goldsmith, Impact (billiards)",
        run: Run::EachStep(throw),
        control: Control { passes: "moreau-jean", fails: "rolling/hollow-sphere" },
    },
    Check {
        name: "rolling/incline",
        level: Level::Simulate,
        question: "Does a sphere roll down a 20° slope with 5/7 g sin α?",
        derivation: "Sticking needs 2/7 tan α ≤ μ, here 0.10 < 0.5. Constant forces are integrated exactly; the acceleration is taken over \
            the \
                     second half, after the start has settled. A contact at a depth δ has the lever R − δ.",
        source: "Newton–Euler: a = g sin α/(1 + I/mR²)",
        run: Run::EachStep(incline),
        control: Control { passes: "moreau-jean", fails: "rolling/resistance" },
    },
];

/// The derived verdicts that are not `pass`: none. Anitescu's sphere starts at its own gap μ h v₀ and does not hop.
pub const EXPECTED: &[Expected] = &[];

/// A sphere thrown along the floor.
fn thrown(bench: &Bench, h: f64) -> Scene {
    let gap = start_gap(bench, h, (1.0, 1.0), GRAVITY, FRICTION, SPEED);
    let mut ball = sphere("ball", 1.0, RADIUS, [0.0, 0.0, RADIUS + gap]);
    ball.linear_velocity = [SPEED, 0.0, 0.0];
    over_floor("thrown sphere", vec![ball], FRICTION)
}

fn throw(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let transition = SPEED / (SPHERE * FRICTION * GRAVITY);
    let steps = (2.0 * transition / h).round() as usize;
    let motion = bench.simulate(&thrown(bench, h), h, steps, 1)?;
    let states = samples(&motion.bodies[0]);
    let end = states[steps];
    let depth = states.iter().map(|state| (RADIUS - state.position.z).max(0.0)).fold(0.0, f64::max);
    let final_speed = 5.0 / 7.0 * SPEED;
    let speed = Measurement::new(
        "final speed",
        "m/s",
        end.velocity.x,
        Expectation::equal(final_speed, tolerance::speed(SPEED), "5/7 of the initial speed"),
    );
    let rolling = Measurement::new("final slip", "m/s", slip(&end), Expectation::equal(0.0, tolerance::speed(SPEED), "v = ω R"));
    let lever = |value: f64| {
        let allowed = tolerance::speed(SPEED) + tolerance::lever(SPEED, depth, RADIUS);
        yields(bench).then(|| Expectation::equal(value, allowed, "the contact has the lever R − δ"))
    };
    Ok(vec![speed.predicted(lever(final_speed)), rolling.predicted(lever(0.0)), time_to_rolling(bench, &states, depth, h)])
}

/// The first sample at which the slip is gone, or too small for the declared law's full friction.
fn time_to_rolling(bench: &Bench, states: &[Sample], depth: f64, h: f64) -> Measurement {
    let rate = SPHERE * FRICTION * GRAVITY;
    let full = full_slip(bench.description(), rate, h);
    let transition = (SPEED - full) / rate;
    let found = states.iter().position(|state| slip(state) <= full + tolerance::no_slip(rate, h));
    let measured = found.map_or(f64::INFINITY, |k| k as f64 * h);
    let ideal =
        Expectation::equal(transition, tolerance::transition(h), "2 v₀/(7 μ g), less the time of slips too small for full friction");
    let measurement = Measurement::new("time to rolling", "s", measured, ideal);
    let Some(k) = found.filter(|k| *k > 0 && (hops(bench.description()) || yields(bench))) else { return measurement };
    // Still slipping at sample k − 1, no more at k: 7/2 μ (g t + v_n) passes v₀ between them.
    let [late, early] = [k - 1, k].map(|k| transition - states[k].velocity.z / GRAVITY);
    let (low, high) = (early.min(late), early.max(late));
    let allowed = 0.5 * (high - low) + tolerance::transition(h) + tolerance::lever(transition, depth, RADIUS);
    measurement.predicted(Some(Expectation::equal(0.5 * (low + high), allowed, "the same, less v_n/g of a hop, with the lever R − δ")))
}

/// Velocity of the sphere's lowest point along x \[m/s\].
fn slip(state: &Sample) -> f64 {
    state.velocity_at(Vector3::new(0.0, 0.0, -RADIUS)).x
}

fn incline(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (sine, cosine) = 20f64.to_radians().sin_cos();
    let height = RADIUS + start_gap(bench, h, (1.0, 1.0), GRAVITY * cosine, 0.5, 0.0);
    let mut scene = over_floor("rolling down", vec![sphere("ball", 1.0, RADIUS, [height * sine, 0.0, height * cosine])], 0.5);
    scene.ground = Some(Ground { normal: [sine, 0.0, cosine], offset: 0.0 });
    let slope = Slope::of(&scene).ok_or_else(|| Refusal::errored("the scene has no plane"))?;
    let half = (0.5 / h).round() as usize;
    let motion = bench.simulate(&scene, h, 2 * half, half)?;
    let [middle, end] = [1, 2].map(|k| Sample::of(&motion.bodies[0], k));
    let time = half as f64 * h;
    let acceleration = (end.velocity - middle.velocity).dot(&slope.down) / time;
    let exact = 5.0 / 7.0 * slope.pull;
    let ideal = Expectation::equal(exact, tolerance::acceleration(slope.pull), "5/7 g sin α");
    let depth = (RADIUS - slope.height(&end.position)).abs();
    let model = yields(bench).then(|| {
        let allowed = tolerance::acceleration(slope.pull) + tolerance::lever(slope.pull, depth, RADIUS);
        Expectation::equal(exact, allowed, "the contact has the lever R − δ")
    });
    Ok(vec![Measurement::new("acceleration", "m/s^2", acceleration, ideal).predicted(model)])
}
