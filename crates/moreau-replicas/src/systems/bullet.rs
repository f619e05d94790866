//! Bullet: velocity level, Coulomb's cone or a box in its place, sequential impulses; gap and depth enter as a bias velocity.
//!
//! ```text
//!     K_μ ∋ r ⟂ u⁺ + (ERP d/h − e|u_n|) n + μ‖u_t⁺‖n ∈ K_μ* ,     d/h in place of ERP d/h while d = φ + slop > 0
//! ```

use super::planted::{Kind, half_friction, mistake};
use super::replay::{self, Replay};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System};
use crate::bullet::SequentialImpulses;
use crate::bullet::steps::BulletSteps;
use crate::bullet::{Bodies, Bullet, Friction};
use crate::stored::{StoredRuns, read_by};
use moreau_checks::defects::schemes::HALF_FRICTION;
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::{ContactSolver, ProjectedGaussSeidel};
use moreau_dynamics::schemes::Scheme;
use moreau_dynamics::trajectory::Trajectory;
use moreau_exact::Result;
use nalgebra::DVector;

const SUNK: &str = "bullet/ball_sunk__multi__h0.01.json";
const BOUNCE: &str = "bullet/ball_bounce__multi__h0.01.json";
const RIGID_BOUNCE: &str = "bullet/ball_bounce__rigid__h0.01.json";
const DEEP: &str = "bullet/ball_deep__rigid__h0.01.json";
const STEPS: &str = "bullet/block_slide__box-default__h0.01.steps.json";
const FIVE_SWEEPS: &str = "bullet/block_slide__box-5-sweeps__h0.01.steps.json";
const PYRAMID: &str = "bullet/block_oblique__pyramid__h0.005.steps.json";
const WARM: &str = "bullet/block_stick__rigid-warm__h0.01.steps.json";
const SLIDE: &str = "bullet/block_slide__box__h0.005.json";

const ENGINE: &str = "PyBullet 3.2.7";

pub static SYSTEM: System = System {
    name: "Bullet",
    level: ConstraintLevel::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "sequential impulses, a given number of sweeps (`--solver sequential-impulses`); or their limit",
    restitution: "Newton's e on the velocity after the forces, less d/h of a gap",
    position_update: "q + h v⁺, and split impulses of deep rigid bodies",
    schemes: &["bullet"],
    held_against: &[
        Agreement {
            against: ENGINE,
            quantity: "velocity of a sunken ball, every step",
            unit: "m/s",
            measure: |runs| velocity(runs, SUNK, &Bullet::default()),
            planted: &[mistake(Kind::Assembly, "systems/error-reduction", "ERP = 0.2", |runs| {
                velocity(runs, SUNK, &eager(Bullet::default()))
            })],
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity of a bouncing multibody, every step",
            unit: "m/s",
            measure: |runs| velocity(runs, BOUNCE, &Bullet::default()),
            planted: &[mistake(Kind::Scheme, "systems/rigid-for-multibody", "a rigid body in place of the multibody", |runs| {
                velocity(runs, BOUNCE, &rigid())
            })],
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity of a bouncing rigid body, every step",
            unit: "m/s",
            measure: |runs| velocity(runs, RIGID_BOUNCE, &rigid()),
            planted: &[mistake(Kind::Scheme, "systems/multibody-for-rigid", "a multibody in place of the rigid body", |runs| {
                velocity(runs, RIGID_BOUNCE, &Bullet::default())
            })],
        },
        Agreement {
            against: ENGINE,
            quantity: "position under split impulses, every step",
            unit: "m",
            measure: |runs| position(runs, DEEP, &rigid()),
            planted: &[mistake(Kind::Assembly, "systems/error-reduction", "ERP = 0.2", |runs| position(runs, DEEP, &eager(rigid())))],
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity of a block sliding on a box, every second step",
            unit: "m/s",
            measure: |runs| velocity(runs, SLIDE, &boxes()),
            planted: &[half_friction(|runs| velocity(runs, SLIDE, &HALF_FRICTION.subject.of(boxes())))],
        },
        Agreement {
            against: ENGINE,
            quantity: "impulses of every step by its sweeps at its contact points: sliding block",
            unit: "N·s",
            measure: |runs| by_sweeps(runs, STEPS),
            planted: &[
                mistake(Kind::Solver, "systems/residual-ignored", "sweeps to the end, whatever the residual", |runs| {
                    swept(runs, STEPS, |scheme| scheme, |right| Box::new(SequentialImpulses { residual: 0.0, ..right }))
                }),
                mistake(Kind::Solver, "systems/solution-for-sweeps", "the solution in place of its sweeps", |runs| {
                    swept(runs, STEPS, |scheme| scheme, |_| Box::new(ProjectedGaussSeidel::accelerated()))
                }),
            ],
        },
        Agreement {
            against: ENGINE,
            quantity: "the same after five sweeps",
            unit: "N·s",
            measure: |runs| by_sweeps(runs, FIVE_SWEEPS),
            planted: &[
                mistake(Kind::Solver, "systems/friction-first", "friction before the normals of each sweep", |runs| {
                    swept(runs, FIVE_SWEEPS, |scheme| scheme, |right| Box::new(FrictionFirst(right)))
                }),
                mistake(Kind::Solver, "systems/one-sweep-more", "one sweep more", |runs| {
                    swept(runs, FIVE_SWEEPS, |scheme| scheme, |right| Box::new(SequentialImpulses { sweeps: right.sweeps + 1, ..right }))
                }),
            ],
        },
        Agreement {
            against: ENGINE,
            quantity: "the same under the pyramid, sliding obliquely",
            unit: "N·s",
            measure: |runs| by_sweeps(runs, PYRAMID),
            planted: &[
                mistake(Kind::Assembly, "systems/round-for-pyramid", "the round cone in place of the pyramid", |runs| {
                    swept(runs, PYRAMID, |scheme| Bullet { friction: Friction::Cone, ..scheme }, |right| Box::new(right))
                }),
                mistake(Kind::Scheme, "systems/rigid-for-multibody", "a rigid body in place of the multibody", |runs| {
                    swept(runs, PYRAMID, |scheme| Bullet { bodies: Bodies::Rigid, ..scheme }, |right| Box::new(right))
                }),
            ],
        },
        Agreement {
            against: ENGINE,
            quantity: "the same of rigid bodies, warm start 0.85",
            unit: "N·s",
            measure: |runs| by_sweeps(runs, WARM),
            planted: &[mistake(Kind::Solver, "systems/warm-start", "warm start 0.1", |runs| {
                swept(runs, WARM, |scheme| scheme, |right| Box::new(SequentialImpulses { warm_start: 0.1, ..right }))
            })],
        },
    ],
};

/// Contact points between boxes begin where they overlap.
fn boxes() -> Bullet {
    Bullet { margin: 0.0, ..Bullet::default() }
}

fn rigid() -> Bullet {
    Bullet { bodies: Bodies::Rigid, ..Bullet::default() }
}

/// ERP = 0.2 in place of 0.08.
fn eager(scheme: Bullet) -> Bullet {
    Bullet { error_reduction: 0.2, ..scheme }
}

fn velocity(runs: &dyn StoredRuns, path: &str, scheme: &dyn Scheme) -> Result<Measured> {
    Ok(replayed(runs, path, scheme)?.velocity)
}

fn position(runs: &dyn StoredRuns, path: &str, scheme: &dyn Scheme) -> Result<Measured> {
    Ok(replayed(runs, path, scheme)?.position)
}

fn replayed(runs: &dyn StoredRuns, path: &str, scheme: &dyn Scheme) -> Result<Replay> {
    let stored = read_by(runs, path, Trajectory::from_json)?;
    replay::replay(&stored, scheme, stored.times.len() - 1)
}

fn by_sweeps(runs: &dyn StoredRuns, path: &str) -> Result<Measured> {
    swept(runs, path, |scheme| scheme, |solver| Box::new(solver))
}

/// Steps from the engine's states with the engine's contact points, by what is made of the run's own scheme and sweeps.
fn swept(
    runs: &dyn StoredRuns,
    path: &str,
    scheme: impl Fn(Bullet) -> Bullet,
    solver: impl Fn(SequentialImpulses) -> Box<dyn ContactSolver>,
) -> Result<Measured> {
    let run = read_by(runs, path, BulletSteps::from_json)?;
    let deviation = run.deviation(&scheme(run.scheme()?), solver(run.solver()?).as_ref())?;
    Ok(Measured::within(deviation.impulse, run.tolerance()))
}

/// A mistake: friction before the normals of each sweep, so that the last normals have no friction after them.
struct FrictionFirst(SequentialImpulses);

impl ContactSolver for FrictionFirst {
    fn name(&self) -> &'static str {
        "friction first"
    }

    fn takes(&self, law: Law, rows: usize, symmetric: bool) -> bool {
        self.0.takes(law, rows, symmetric)
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let shorter = SequentialImpulses { sweeps: self.0.sweeps - 1, ..self.0 };
        let solution = shorter.solve(problem, warm_start)?;
        let velocity = problem.velocity(&solution.impulse);
        let rows = problem.rows_per_contact();
        let mut impulse = solution.impulse.clone();
        for k in (0..impulse.len()).step_by(rows) {
            let wanted = impulse[k] - (velocity[k] + problem.shift()[k]) / problem.entry(k, k);
            impulse[k] = wanted.max(0.0);
        }
        Ok(Solution::new(solution.solver, impulse, velocity, solution.iterations))
    }
}
