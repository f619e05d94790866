//! Friction is the same in every direction of the floor, and opposed to the slip.
//!
//! ```text
//!     Δp_t = −μ d (Δp_n + m g t)      for every direction d of the slip
//! ```
//! Measured as the impulse of friction over that of the normal force, along the slip and across it: Coulomb's coefficient whatever the
//! normal impulses do, so that models that hop are judged by the same numbers.
//! ```text
//!     d directions      μ cos(π/d) ≤ along ≤ μ ,   |across| ≤ μ sin(π/d)
//! ```

use crate::check::{Control, Expected, Run};
use crate::checks::motion::{Sample, samples, start_gap};
use crate::checks::scenery::{GRAVITY, cuboid, over_floor, sphere};
use crate::description::Friction;
use crate::model::Model;
use crate::model::sliding::hops;
use crate::tolerance::{audit_rounding, isotropy as tolerance};
use crate::{Bench, Check, Expectation, Level, Measurement, Refusal, Reply, Verdict};
use moreau_contact::cones::polyhedral;
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2, TAU};

const FRICTION: f64 = 0.3;
/// Speed at the start \[m/s\]: the sphere slips for 0.19 s.
const SPEED: f64 = 2.0;
/// Steps of a push of small steps.
const STEPS: usize = 10;
/// Longest push \[s\]: the sphere still slips.
const LONGEST: f64 = 0.18;
const DIRECTIONS: usize = 16;

/// Direction k \[rad\]: the eight of the compass, and eight that lie 7° beside the middle between them.
fn direction(k: usize) -> f64 {
    let beside = if k % 2 == 1 { 7f64.to_radians() } else { 0.0 };
    TAU * k as f64 / DIRECTIONS as f64 + beside
}

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "isotropy/deceleration",
        level: Level::Simulate,
        question: "Is sliding friction μ times the normal force in each of 16 directions, and opposed to the slip?",
        derivation: "Impulse of friction over impulse of the normal force along and across the slip: μ and 0. With d directions, maximal \
                     dissipation picks a corner or a side of the polygon: along between μ cos(π/d) and μ, across at most μ sin(π/d).",
        source: "Coulomb's law; cones::polyhedral",
        run: Run::EachStep(deceleration),
        control: Control { passes: "moreau-jean", fails: "incline/friction-not-opposed" },
    },
    Check {
        name: "isotropy/straight",
        level: Level::Simulate,
        question: "Does a pushed body move on a straight line, without turning about the vertical, in each of 16 directions?",
        derivation: "The resultant of friction and pressure on a box acts at a point straight ahead of its centre. So there is no torque \
            about the vertical and no force across: sideways displacement and yaw are 0. With d directions the sideways acceleration is \
            at most μ g sin(π/d).",
        source: "Coulomb's law and the balance of moments",
        run: Run::EachStep(straight),
        control: Control { passes: "moreau-jean", fails: "isotropy/boxed-friction" },
    },
];

const FACETS: &str = "8 directions: friction between μ cos(π/8) and μ along the slip, up to μ sin(π/8) across it";

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] = &[
    Expected { scheme: "stewart-trinkle", check: "isotropy/deceleration", verdict: Verdict::Difference, why: FACETS },
    Expected { scheme: "stewart-trinkle", check: "isotropy/straight", verdict: Verdict::Difference, why: FACETS },
];

/// A body pushed in one direction, at the start and at the end.
struct Push {
    along: Vector3<f64>,
    across: Vector3<f64>,
    start: Sample,
    end: Sample,
}

/// The shapes that are pushed: a sphere, and a box unless the law hops, which would tip it and turn it about the vertical.
///
/// Anitescu's law does not hop from its own gap μ h v₀.
fn shapes(bench: &Bench, h: f64) -> Vec<(&'static str, Body)> {
    let model = Model::of(bench.description());
    let gap = |contacts: f64| start_gap(bench, h, (1.0, contacts), GRAVITY, FRICTION, SPEED);
    let ball = sphere("ball", 1.0, 0.1, [0.0, 0.0, 0.1 + gap(1.0)]);
    let block = cuboid("block", 1.0, [0.1, 0.1, 0.05], [0.0, 0.0, 0.05 + gap(4.0)]);
    let mut shapes = vec![("sphere", ball)];
    if !hops(bench.description()) || model == Model::Anitescu {
        shapes.push(("box", block));
    }
    shapes
}

/// Steps of a push: the same number for all steps h up to 1/60 s, fewer above.
fn steps(h: f64) -> usize {
    STEPS.min((LONGEST / h) as usize).max(1)
}

/// All pushes of a shape, and the time they take.
fn pushes(bench: &mut Bench, h: f64, body: &Body) -> Reply<(Vec<Push>, f64)> {
    let mut pushes = Vec::new();
    for k in 0..DIRECTIONS {
        let (sine, cosine) = direction(k).sin_cos();
        let scene = pushed(body, [SPEED * cosine, SPEED * sine, 0.0]);
        let motion = bench.simulate(&scene, h, steps(h), steps(h))?;
        let states = samples(&motion.bodies[0]);
        pushes.push(Push {
            along: Vector3::new(cosine, sine, 0.0),
            across: Vector3::new(-sine, cosine, 0.0),
            start: states[0],
            end: states[1],
        });
    }
    Ok((pushes, steps(h) as f64 * h))
}

fn pushed(body: &Body, velocity: [f64; 3]) -> Scene {
    over_floor("push", vec![Body { linear_velocity: velocity, ..body.clone() }], FRICTION)
}

/// How declared friction without symmetry about the normal may differ from Coulomb's: (weakest, strongest, across) over μ.
///
/// With d directions inside the cone: cos(π/d), 1, sin(π/d). A pyramid with four edges may lie inside the cone, or around it with every
/// tangent bounded by itself: 1/√2, √2, 1.
fn facets(bench: &Bench) -> Option<[f64; 3]> {
    let inside = |d: usize| [1.0 - polyhedral::strength_error(d), 1.0, polyhedral::direction_error(d).sin()];
    match Model::of(bench.description()) {
        Model::StewartTrinkle { directions } => Some(inside(directions)),
        Model::Mujoco(_) if bench.description().friction == Friction::Pyramid => Some(inside(4)),
        _ if bench.description().friction == Friction::Pyramid => Some([FRAC_1_SQRT_2, SQRT_2, 1.0]),
        _ => None,
    }
}

fn deceleration(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let mut measurements = Vec::new();
    for (shape, body) in shapes(bench, h) {
        let (pushes, time) = pushes(bench, h, &body)?;
        let pressed = |push: &Push| push.end.velocity.z - push.start.velocity.z + GRAVITY * time;
        let rounding = audit_rounding(bench.epsilon(), GRAVITY * time);
        if steps(h) == 1 && pushes.iter().any(|push| pressed(push) <= rounding) {
            let reason = "the sphere slips for one step of this length, and a contact may act from the second on; take shorter ones";
            return Err(Refusal::unsupported(reason));
        }
        let damping = Model::of(bench.description()).damping().map_or(0.0, |(linear, _)| linear);
        let ratio = |push: &Push, axis: &Vector3<f64>| {
            // What declared damping took, c Δx, is no friction.
            let way = push.end.position - push.start.position;
            let change = push.end.velocity - push.start.velocity + way * damping;
            -change.dot(axis) / pressed(push)
        };
        let along: Vec<f64> = pushes.iter().map(|push| ratio(push, &push.along)).collect();
        let across = largest(pushes.iter().map(|push| ratio(push, &push.across)));
        let allowed = tolerance::coefficient() + crate::tolerance::contact::damped(damping, SPEED, GRAVITY, h);
        let law = facets(bench);
        let strength = law.map(|[weakest, strongest, _]| {
            let [middle, half] = [weakest + strongest, strongest - weakest].map(|x| 0.5 * FRICTION * x);
            Expectation::equal(middle, half + allowed, "between the weakest and the strongest direction of the polygon")
        });
        let strength = strength.or_else(|| lagged(bench, allowed, h));
        let sideways = law.map(|[_, _, across]| Expectation::at_most(FRICTION * across, allowed, "the force of a corner of the polygon"));
        let ideal = || Expectation::equal(FRICTION, allowed, "μ in every direction");
        let weakest = along.iter().copied().fold(f64::INFINITY, f64::min);
        measurements.extend([
            Measurement::new(format!("weakest friction over normal impulse ({shape})"), "1", weakest, ideal()).predicted(strength.clone()),
            Measurement::new(format!("strongest friction over normal impulse ({shape})"), "1", largest(along.into_iter()), ideal())
                .predicted(strength),
            Measurement::new(
                format!("friction across the slip over normal impulse ({shape})"),
                "1",
                across,
                Expectation::equal(0.0, allowed, "opposed to the slip"),
            )
            .predicted(sideways),
        ]);
    }
    Ok(measurements)
}

/// A lagged law takes friction from the normal force of the step before: in [`steps`] steps of a steady slide one is missing.
fn lagged(bench: &Bench, allowed: f64, h: f64) -> Option<Expectation> {
    let missing = FRICTION / steps(h) as f64;
    let model = Expectation::equal(FRICTION - 0.5 * missing, 0.5 * missing + allowed, "friction of the previous normal force");
    matches!(Model::of(bench.description()), Model::DrakeRegularised { .. }).then_some(model)
}

fn straight(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let mut measurements = Vec::new();
    for (shape, body) in shapes(bench, h) {
        let (pushes, time) = pushes(bench, h, &body)?;
        let sideways = largest(pushes.iter().map(|push| (push.end.position - push.start.position).dot(&push.across)));
        let yaw = largest(pushes.iter().map(|push| push.end.spin.z));
        let allowed = tolerance::sideways(SPEED, time);
        // A hop gives at most μ v of normal velocity beyond what gravity gives.
        let normal = GRAVITY * time + FRICTION * SPEED;
        let law = facets(bench).map(|[_, _, across]| FRICTION * across * normal);
        let model = law.map(|speed| Expectation::at_most(speed * time, allowed, "friction beside the slip by π/d"));
        let ideal = Expectation::equal(0.0, allowed, "no force across the slip");
        measurements.push(Measurement::new(format!("sideways displacement ({shape})"), "m", sideways, ideal).predicted(model));
        let arm = 0.1;
        let turning =
            law.map(|speed| Expectation::at_most(tolerance::yaw_of(speed, arm), allowed / (arm * time), "friction beside the slip"));
        let ideal = Expectation::equal(0.0, allowed / (arm * time), "no torque about the vertical");
        measurements.push(Measurement::new(format!("yaw rate ({shape})"), "rad/s", yaw, ideal).predicted(turning));
    }
    Ok(measurements)
}

/// The largest absolute value, NaN if there is one.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |worst, value| crate::checks::scenery::worst(value.abs(), worst))
}
