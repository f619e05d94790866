//! MuJoCo: soft contact, a strictly convex problem for the accelerations, held against stored runs of the engine itself.
//!
//! ```text
//!     min ½‖a − a₀‖²_M + s(H a − a_ref)   ⇔   K ∋ f ⟂ (W + R) f + H a₀ − a_ref ∈ K* ,   R > 0
//! ```

use super::planted::{Kind, half_friction, heavy, mistake};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System};
use crate::mujoco::GaussSweeps;
use crate::mujoco::Mujoco;
use crate::mujoco::{Cone as Shape, Integrator, Rotational};
use crate::stored::{StoredRuns, problem_and_answer, read_by};
use crate::tolerance::references::{self as tolerance, REPLAYED_STEP, stored_number};
use moreau_checks::defects::schemes::{HALF_FRICTION, HEAVY};
use moreau_contact::solvers::{ContactSolver, GaussNewton};
use moreau_dynamics::mechanics::{PointMass, State};
use moreau_dynamics::schemes::{Scheme, Step, run};
use moreau_dynamics::trajectory::Trajectory;
use moreau_exact::tolerance::rounding;
use moreau_exact::{Error, Result};
use moreau_forms::mujoco_contact::ContactParameters;
use nalgebra::dvector;
use serde_json::Value;

const BALL: &str = "mujoco/ball_drop__newton-elliptic__h0.01.json";
const STICKING: &str = "mujoco/block_stick__newton-elliptic__h0.01.json";
const SLIDING: &str = "mujoco/block_slide__newton-pyramidal__h0.01.json";
const STACK: &str = "mujoco/five_box_stack__newton-pyramidal__h0.01.json";
const STEP: &str = "mujoco/block_stick__newton-elliptic__h0.002__step400.dump.json";

const CONVERGED_STEP: &str = "mujoco/block_slide__newton-elliptic-converged__h0.002__step100.dump.json";
const CONVERGED_SLIDE: &str = "mujoco/block_slide__newton-elliptic-converged__h0.002.json";
const TUMBLE: &str = "mujoco/box_tumble__newton-elliptic-implicitfast__h0.002.json";
const STAGES: &str = "mujoco/box_tumble__newton-pyramidal-rk4__h0.002.json";
const ROLL: &str = "mujoco/ball_roll__newton-elliptic-rolling__h0.002.json";

const ELLIPTIC: Mujoco = Mujoco::standard(Shape::Elliptic);
const PYRAMIDAL: Mujoco = Mujoco::standard(Shape::Pyramidal);

const FAST: Mujoco = Mujoco { integrator: Integrator::ImplicitFast, ..ELLIPTIC };
const RK4: Mujoco = Mujoco { integrator: Integrator::RungeKutta, ..PYRAMIDAL };
const ROLLING: Mujoco = Mujoco { rotational: Rotational { torsional: 0.01, rolling: 0.01 }, ..ELLIPTIC };

pub static SYSTEM: System = System {
    name: "MuJoCo",
    level: ConstraintLevel::Acceleration,
    cone: Cone::Polyhedral,
    law: ContactLaw::Compliant,
    algorithm: "Newton, conjugate gradients, or Gauss–Seidel; the cone may be round, too",
    restitution: "none; solref sets the damping",
    position_update: "q + h v⁺; RK4: q + h/6 (v₁ + 2v₂ + 2v₃ + v₄)",
    schemes: &["mujoco"],
    held_against: &[
        Agreement {
            against: "MuJoCo 3.17.0",
            quantity: "impulses of a stored step, block on a slope, relative",
            unit: "",
            measure: |runs| stored_step(runs, STEP, &GaussNewton::default(), REPLAYED_STEP),
            planted: &[mistake(Kind::Solver, "systems/no-newton-step", "no step of Newton", |runs| {
                stored_step(runs, STEP, &GaussNewton { steps: 0, ..GaussNewton::default() }, REPLAYED_STEP)
            })],
        },
        Agreement {
            against: "MuJoCo 3.17.0",
            quantity: "place of a dropped ball over 2 s",
            unit: "m",
            measure: |runs| replay(runs, BALL, &ELLIPTIC),
            planted: &[heavy(|runs| replay(runs, BALL, &HEAVY.subject.of(ELLIPTIC)))],
        },
        Agreement {
            against: "MuJoCo 3.17.0",
            quantity: "place of a block that creeps on a slope over 1 s, round cone",
            unit: "m",
            measure: |runs| replay(runs, STICKING, &ELLIPTIC),
            planted: &[heavy(|runs| replay(runs, STICKING, &HEAVY.subject.of(ELLIPTIC)))],
        },
        Agreement {
            against: "MuJoCo 3.17.0",
            quantity: "place of a block that slides and hops over 1 s, pyramid",
            unit: "m",
            measure: |runs| replay(runs, SLIDING, &PYRAMIDAL),
            planted: &[half_friction(|runs| replay(runs, SLIDING, &HALF_FRICTION.subject.of(PYRAMIDAL)))],
        },
        Agreement {
            against: "MuJoCo 3.17.0",
            quantity: "places of a stack of five boxes over 1 s, pyramid",
            unit: "m",
            measure: |runs| replay(runs, STACK, &PYRAMIDAL),
            planted: &[heavy(|runs| replay(runs, STACK, &HEAVY.subject.of(PYRAMIDAL)))],
        },
        Agreement {
            against: "MuJoCo 3.17.0, run to the end",
            quantity: "impulses of a stored step, sliding block, round cone, relative",
            unit: "",
            measure: |runs| stored_step(runs, CONVERGED_STEP, &GaussNewton::default(), tolerance::CONVERGED_STEP),
            planted: &[mistake(Kind::Solver, "systems/no-newton-step", "no step of Newton", |runs| {
                stored_step(runs, CONVERGED_STEP, &GaussNewton { steps: 0, ..GaussNewton::default() }, REPLAYED_STEP)
            })],
        },
        Agreement {
            against: "MuJoCo 3.17.0, run to the end",
            quantity: "place of a block that slides and hops over 1 s, round cone",
            unit: "m",
            measure: |runs| replay(runs, CONVERGED_SLIDE, &ELLIPTIC),
            planted: &[half_friction(|runs| replay(runs, CONVERGED_SLIDE, &HALF_FRICTION.subject.of(ELLIPTIC)))],
        },
        Agreement {
            against: "MuJoCo 3.17.0, run to the end",
            quantity: "place of a box that tumbles and lands, implicitfast",
            unit: "m",
            measure: |runs| replay(runs, TUMBLE, &FAST),
            planted: &[
                mistake(Kind::Scheme, "systems/euler-in-its-place", "Euler in its place", |runs| replay(runs, TUMBLE, &ELLIPTIC)),
                mistake(Kind::Scheme, "systems/runge-kutta-in-its-place", "RK4 in its place", |runs| {
                    replay(runs, TUMBLE, &Mujoco { integrator: Integrator::RungeKutta, ..ELLIPTIC })
                }),
            ],
        },
        Agreement {
            against: "MuJoCo 3.17.0, run to the end",
            quantity: "place of a box that tumbles and lands, RK4, pyramid",
            unit: "m",
            measure: |runs| replay(runs, STAGES, &RK4),
            planted: &[mistake(Kind::Scheme, "systems/euler-in-its-place", "Euler in its place", |runs| replay(runs, STAGES, &PYRAMIDAL))],
        },
        Agreement {
            against: "MuJoCo 3.17.0, run to the end",
            quantity: "place of a ball that rolling friction stops, six contact directions",
            unit: "m",
            measure: |runs| replay(runs, ROLL, &ROLLING),
            planted: &[
                mistake(Kind::Assembly, "systems/no-rolling-friction", "no torsional and rolling friction", |runs| {
                    replay(runs, ROLL, &ELLIPTIC)
                }),
                mistake(Kind::Reader, "systems/rolling-friction", "rolling friction 1 % larger", |runs| {
                    replay(runs, ROLL, &Mujoco { rotational: Rotational { torsional: 0.01, rolling: 0.0101 }, ..ELLIPTIC })
                }),
            ],
        },
        Agreement {
            against: "closed form",
            quantity: "depth of a ball at rest",
            unit: "m",
            measure: |_| rest_depth(&ELLIPTIC),
            planted: &[heavy(|_| rest_depth(&HEAVY.subject.of(ELLIPTIC)))],
        },
        Agreement {
            against: "MuJoCo 3.17.0",
            quantity: "impulses of Gauss–Seidel along rays and discs, the same stored step, relative",
            unit: "",
            measure: |runs| stored_step(runs, STEP, &GaussSweeps::default(), REPLAYED_STEP),
            planted: &[mistake(Kind::Solver, "systems/one-sweep", "one sweep", |runs| {
                stored_step(runs, STEP, &GaussSweeps { sweeps: 1, ..GaussSweeps::default() }, REPLAYED_STEP)
            })],
        },
    ],
};

/// Positions of a stored motion against the scheme's, with what the engine itself determines of them as tolerance.
fn replay(runs: &dyn StoredRuns, path: &str, scheme: &dyn Scheme) -> Result<Measured> {
    let stored = read_by(runs, path, Trajectory::from_json)?;
    let missing = || Error::invalid("provenance", "lacks the sensitivity", "run scripts/generate_references.py");
    let provenance = stored.provenance.as_ref().ok_or_else(missing)?;
    let sensitivity = &provenance["sensitivity"]["bodies/position"];
    let number = |value: &Value| value.as_f64().ok_or_else(missing);
    let (steps, every) = (number(&provenance["steps"])?, number(&provenance["sample_every"])? as usize);
    let (mechanism, start) = stored.scene.spatial_mechanism()?;
    let (mut difference, mut size, mut n) = (0.0f64, 0.0f64, 0usize);
    let observe = |step: &Step| {
        let state = &step.state;
        n += 1;
        if n.is_multiple_of(every) {
            for (body, track) in mechanism.bodies(&state.position, &state.velocity).iter().zip(&stored.bodies) {
                for (ours, theirs) in body.position.iter().zip(track.position[n / every]) {
                    difference = difference.max((ours - theirs).abs());
                    size = size.max(theirs.abs());
                }
            }
        }
    };
    run(scheme, &GaussNewton::default(), mechanism.as_ref(), start, stored.time_step, steps as usize, observe)?;
    Ok(Measured::within(difference, stored_number(number(&sensitivity[0])?, number(&sensitivity[1])?, steps, size)))
}

/// ‖r − r_engine‖/‖r_engine‖ of a stored step.
fn stored_step(runs: &dyn StoredRuns, path: &str, solver: &dyn ContactSolver, tolerance: f64) -> Result<Measured> {
    let (problem, engine) = problem_and_answer(runs, path)?;
    let ours = solver.solve(&problem, None)?;
    Ok(Measured::within((ours.impulse - &engine.impulse).norm() / engine.impulse.norm(), tolerance))
}

/// A ball of 1 kg after two seconds on the floor against k d² δ = (1 − d) g.
fn rest_depth(scheme: &dyn Scheme) -> Result<Measured> {
    let ball = PointMass::ball_on_floor(1.0, 9.81, 0.0);
    let start = State { time: 0.0, position: dvector![0.001], velocity: dvector![0.0] };
    let end = run(scheme, &GaussNewton::default(), &ball, start, 0.001, 2000, |_| ())?;
    let expected = ContactParameters::default().rest_depth(0.001, 1.0, 9.81)?;
    // velocities of size g h are balanced to rounding, and the stiffness of 2000/s² turns what is left over a step into less than itself in
    // metres
    Ok(Measured::within((end.position[0] + expected).abs(), rounding(64, 9.81 * 0.001)))
}
