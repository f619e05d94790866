//! A block that rocks from one edge of its base to the other.
//!
//! ```text
//!     on an edge   θ̈ = −p² sin(α − θ) ,  p² = 3 g/(4 R)           landing   ω⁺ = (1 − 3/2 sin²α) ω⁻
//!     energy       lift θ = cos(α − θ) − cos α = ½ ω²/p²           regained over lost = (1 − 3/2 sin²α)²
//! ```
//! The landing is an impact with restitution 0 at the edge that arrives, at which the old edge must be let go: three contacts' worth of
//! geometry decide the number.

use crate::check::{Control, Run};
use crate::checks::scenery::{GRAVITY, between, cuboid, over_floor, worst};
use crate::model::Model;
use crate::tolerance::rocking as tolerance;
use crate::{Bench, Check, Expectation, Kind, Level, Measurement, Refusal, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;
use moreau_forms::RockingBlock;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Half extents \[m\]: sin α = 3/5, R = 5 m, so that even a step of 1/60 s turns the block by little.
const HALF: [f64; 3] = [3.0, 2.0, 4.0];

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "rocking/impact",
        level: Level::Simulate,
        question: "Does a rocking block keep Housner's part of its energy when it lands on its other edge, without sliding?",
        derivation: "Angular momentum about the edge that is hit gives ω⁺/ω⁻ = 1 − 3/2 sin²α = 0.46, and the block rises to 0.46² of its \
            energy. The ratio of the impulses is 0.49 < μ = 1. A landing that is found 3/2 steps off, a lag of half a step and the \
            edge's departure from its circle cost h ω (4 sin α + angle/2)/E. A compliant floor may take more of the energy, but it gives \
            none. Where an edge is declared to be pushed out of its depth, it hops and does not stick meanwhile, or is moved along: its \
            travel is left out. An engine may move the centre by the mean of the velocities of a step and turn the block by the last one: \
            the edge is off by ½ h times the change of the centre's velocity.",
        source: "Housner 1963",
        run: Run::EachStep(impact),
        control: Control { passes: "moreau-jean", fails: "rocking/contacts-glued" },
    },
    Check {
        name: "rocking/fall-time",
        level: Level::Simulate,
        question: "Does a block that is released tilted on its edge land at the time that the pendulum equation gives?",
        derivation: "t = ∫ dθ/√(2p²(lift θ₀ − lift θ)), with the moment of inertia about the edge. A step passes until the edge carries, \
            and the speeds lag by half a step. In one more step the edge falls back onto its circle. The landing is read to one sample, \
            which is one step: 3.5 h in all. The edge of a compliant engine carries after the time of its contact, and twice that time \
            is allowed in addition.",
        source: "pendulum about the edge, I = 4/3 m R²",
        run: Run::EachStep(fall_time),
        control: Control { passes: "moreau-jean", fails: "rocking/full-edges" },
    },
];

/// The block with its left edge x = 0, z = 0 on the floor, tilted by θ onto it, turning back at ω \[rad/s\] about that edge.
fn rocking(tilt: f64, speed: f64) -> Scene {
    let turned = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -tilt);
    let arm = turned * Vector3::new(HALF[0], 0.0, HALF[2]);
    let mut block = cuboid("block", 1.0, HALF, arm.into());
    block.orientation = [turned.w, turned.i, turned.j, turned.k];
    let spin = Vector3::new(0.0, speed, 0.0);
    block.angular_velocity = spin.into();
    block.linear_velocity = spin.cross(&arm).into();
    over_floor("rocking block", vec![block], 1.0)
}

fn exact() -> Reply<RockingBlock> {
    RockingBlock::new(HALF[0], HALF[2], GRAVITY).map_err(Refusal::errored)
}

/// Tilt \[rad\] about the y axis at every sample: positive on the left edge, negative on the right. q and −q are one orientation.
fn tilts(trajectory: &Trajectory) -> impl Iterator<Item = f64> {
    trajectory.bodies[0].orientation.iter().map(|[w, _, y, _]| -2.0 * (y / w).atan())
}

fn impact(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    bench.without_damping()?;
    let (tilt, speed, duration) = (0.1, 0.9, 0.75);
    let block = exact()?;
    let steps = (duration / h).round() as usize;
    let trajectory = bench.simulate(&rocking(tilt, speed), h, steps, 1)?;
    let landing_speed = block.landing_speed(tilt, speed);
    let energy = 0.5 * landing_speed * landing_speed / block.frequency_squared();
    let highest = tilts(&trajectory).map(|tilt| -tilt).fold(0.0, worst);
    let ratio = block.landing_ratio().powi(2);
    let sine = HALF[0] / block.radius();
    let allowed = tolerance::regained(sine, tilt + highest, landing_speed, h, energy);
    let compliant = bench.description().contact_model.kind == Kind::Compliant;
    let [reduction, moved] = match Model::of(bench.description()) {
        Model::Coulomb(limits) => [limits.error_reduction, limits.position_correction],
        _ => [0.0; 2],
    };
    let taken = compliant.then(|| Expectation::at_most(1.0, allowed, "a compliant floor gives no energy"));
    // An impulse 1 + e' times as large at the edge that is hit: ω⁺/ω⁻ = 1 − 3/2 sin²α (1 + e'), and a block that turns back does not rise.
    let returned = 1.0 - (1.0 - block.landing_ratio()) * (1.0 + tolerance::returned(reduction));
    let least = returned.max(0.0).powi(2);
    let taken = taken.or((reduction > 0.0).then(|| between([least, ratio], allowed, "the declared push out of the depth of the landing")));
    let unlike = tolerance::unlike_means(trajectory.bodies[0].linear_velocity.iter().map(|v| v[0]), h);
    let travel = tolerance::travel(block.radius(), tilt + highest, landing_speed, h) + unlike;
    let ideal = Expectation::equal(ratio, allowed, "(1 − 3/2 sin²α)²");
    let mut measurements = vec![
        Measurement::new("energy after the landing over the energy before", "1", block.lift(highest) / energy, ideal).predicted(taken),
    ];
    if !compliant && reduction.max(moved) == 0.0 {
        let still = Expectation::equal(0.0, travel, "the edge sticks: its impulses are inside the cone");
        measurements.push(Measurement::new("travel of the edge that was hit", "m", edge(&trajectory) - 2.0 * HALF[0], still));
    }
    Ok(measurements)
}

/// Where the right edge of the base is at the end, along the floor \[m\].
fn edge(trajectory: &Trajectory) -> f64 {
    let last = trajectory.times.len() - 1;
    let ([w, x, y, z], position) = (trajectory.bodies[0].orientation[last], trajectory.bodies[0].position[last]);
    let turned = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    position[0] + (turned * Vector3::new(HALF[0], 0.0, -HALF[2])).x
}

fn fall_time(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    bench.without_damping()?;
    let tilt = 0.3;
    let exact = exact()?.fall_time(tilt);
    let steps = (1.5 * exact / h).round() as usize;
    let trajectory = bench.simulate(&rocking(tilt, 0.0), h, steps, 1)?;
    let time = landing(&trajectory);
    let ideal = Expectation::equal(exact, tolerance::fall_time(h), "∫ dθ/√(2p²(lift θ₀ − lift θ))");
    let law = contact_time(&Model::of(bench.description()), h)
        .map(|own| Expectation::equal(exact, 2.0 * own + tolerance::fall_time(h), "the edge carries after the contact's own time"));
    Ok(vec![Measurement::new("time until the landing", "s", time, ideal).predicted(law)])
}

/// The time at which the tilt changes sign \[s\], between two samples; the end if it does not.
fn landing(trajectory: &Trajectory) -> f64 {
    let tilts: Vec<f64> = tilts(trajectory).collect();
    let pairs = tilts.windows(2).zip(trajectory.times.windows(2));
    let crossing = |(tilt, time): (&[f64], &[f64])| {
        (tilt[0] > 0.0 && tilt[1] <= 0.0).then(|| time[0] + (time[1] - time[0]) * tilt[0] / (tilt[0] - tilt[1]))
    };
    pairs.filter_map(crossing).next().unwrap_or(trajectory.times.last().copied().unwrap_or(0.0))
}

/// The time in which a declared compliant contact takes up a load \[s\]: MuJoCo's time constant, √(m/k) of a spring.
fn contact_time(model: &Model, h: f64) -> Option<f64> {
    let mass: f64 = 1.0;
    match *model {
        Model::Mujoco(parameters) => {
            let (stiffness, _) = parameters.stiffness_and_damping(h);
            (stiffness > 0.0).then(|| 1.0 / stiffness.sqrt())
        }
        Model::DrakeSap { stiffness, relaxation_time } => Some((mass / stiffness).sqrt() + relaxation_time + h),
        Model::DrakeRegularised { stiffness, .. } | Model::SpringDamper { stiffness, .. } => Some((mass / stiffness).sqrt()),
        Model::Coulomb(_) | Model::Anitescu | Model::StewartTrinkle { .. } | Model::Unknown => None,
    }
}
