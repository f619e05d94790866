//! Bullet: velocity level, Coulomb's cone or a box in its place, sequential impulses; gap and depth enter as a bias velocity.
//!
//! ```text
//!     K_μ ∋ r ⟂ u⁺ + (ERP d/h − e|u_n|) n + μ‖u_t⁺‖n ∈ K_μ* ,     d/h in place of ERP d/h while d = φ + slop > 0
//! ```

use super::{Agreement, Cone, ContactLaw, Level, Measured, System, replay};
use crate::Result;
use crate::checks::bullet_steps::BulletSteps;
use crate::schemes::{Bodies, Bullet, Scheme};
use crate::solvers::ContactSolver;
use crate::trajectory::Trajectory;

const SUNK: &str = include_str!("../../references/bullet/ball_sunk__multi__h0.01.json");
const BOUNCE: &str = include_str!("../../references/bullet/ball_bounce__multi__h0.01.json");
const RIGID_BOUNCE: &str = include_str!("../../references/bullet/ball_bounce__rigid__h0.01.json");
const DEEP: &str = include_str!("../../references/bullet/ball_deep__rigid__h0.01.json");
const STEPS: &str = include_str!("../../references/bullet/block_slide__box-default__h0.01.steps.json");
const FIVE_SWEEPS: &str = include_str!("../../references/bullet/block_slide__box-5-sweeps__h0.01.steps.json");
const PYRAMID: &str = include_str!("../../references/bullet/block_oblique__pyramid__h0.005.steps.json");
const WARM: &str = include_str!("../../references/bullet/block_stick__rigid-warm__h0.01.steps.json");
const SLIDE: &str = include_str!("../../references/bullet/block_slide__box__h0.005.json");

const ENGINE: &str = "PyBullet 3.2.7";

pub static SYSTEM: System = System {
    name: "Bullet",
    level: Level::Velocity,
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
            measure: || velocity(SUNK, &Bullet::default()),
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity of a bouncing multibody, every step",
            unit: "m/s",
            measure: || velocity(BOUNCE, &Bullet::default()),
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity of a bouncing rigid body, every step",
            unit: "m/s",
            measure: || velocity(RIGID_BOUNCE, &rigid()),
        },
        Agreement {
            against: ENGINE,
            quantity: "position under split impulses, every step",
            unit: "m",
            measure: || position(DEEP, &rigid()),
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity of a block sliding on a box, every second step",
            unit: "m/s",
            measure: || velocity(SLIDE, &boxes()),
        },
        Agreement {
            against: ENGINE,
            quantity: "impulses of every step by its sweeps at its contact points: sliding block",
            unit: "N·s",
            measure: || by_sweeps(STEPS),
        },
        Agreement { against: ENGINE, quantity: "the same after five sweeps", unit: "N·s", measure: || by_sweeps(FIVE_SWEEPS) },
        Agreement {
            against: ENGINE,
            quantity: "the same under the pyramid, sliding obliquely",
            unit: "N·s",
            measure: || by_sweeps(PYRAMID),
        },
        Agreement { against: ENGINE, quantity: "the same of rigid bodies, warm start 0.85", unit: "N·s", measure: || by_sweeps(WARM) },
    ],
};

/// Contact points between boxes begin where they overlap.
fn boxes() -> Bullet {
    Bullet { margin: 0.0, ..Bullet::default() }
}

fn rigid() -> Bullet {
    Bullet { bodies: Bodies::Rigid, ..Bullet::default() }
}

fn velocity(stored: &str, scheme: &dyn Scheme) -> Result<Measured> {
    let stored = Trajectory::from_json(stored)?;
    Ok(replay::replay(&stored, scheme, stored.times.len() - 1)?.velocity)
}

fn position(stored: &str, scheme: &dyn Scheme) -> Result<Measured> {
    let stored = Trajectory::from_json(stored)?;
    Ok(replay::replay(&stored, scheme, stored.times.len() - 1)?.position)
}

fn by_sweeps(stored: &str) -> Result<Measured> {
    let run = BulletSteps::from_json(stored)?;
    stepped(&run, &run.scheme()?, &run.solver()?)
}

/// The scheme's steps from the engine's states with the engine's contact points.
fn stepped(run: &BulletSteps, scheme: &Bullet, solver: &dyn ContactSolver) -> Result<Measured> {
    Ok(Measured { difference: run.deviation(scheme, solver)?.impulse, tolerance: run.tolerance() })
}

#[cfg(test)]
mod tests {
    use super::super::planted::{Mistake, caught, planted};
    use super::*;
    use crate::problem::{ContactProblem, Solution};
    use crate::schemes::Friction;
    use crate::solvers::{ProjectedGaussSeidel, SequentialImpulses};
    use nalgebra::DVector;

    #[test]
    fn a_mistake_puts_every_agreement_out_of_its_tolerance() {
        caught(velocity(SUNK, &Bullet { error_reduction: 0.2, ..Bullet::default() }));
        caught(velocity(BOUNCE, &rigid()));
        caught(velocity(RIGID_BOUNCE, &Bullet::default()));
        caught(position(DEEP, &Bullet { error_reduction: 0.2, ..rigid() }));
        caught(velocity(SLIDE, &planted(boxes(), Mistake::HalfFriction)));
    }

    /// Friction before the normals of each sweep, so that the last normals have no friction after them.
    struct FrictionFirst(SequentialImpulses);

    impl ContactSolver for FrictionFirst {
        fn name(&self) -> &'static str {
            "friction first"
        }

        fn takes(&self, law: crate::Law, rows: usize, symmetric: bool) -> bool {
            self.0.takes(law, rows, symmetric)
        }

        fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
            let shorter = SequentialImpulses { sweeps: self.0.sweeps - 1, ..self.0 };
            let solution = shorter.solve(problem, warm_start)?;
            let velocity = problem.velocity(&solution.impulse);
            let rows = problem.rows_per_contact;
            let mut impulse = solution.impulse.clone();
            for k in (0..impulse.len()).step_by(rows) {
                let wanted = impulse[k] - (velocity[k] + problem.shift[k]) / problem.delassus[(k, k)];
                impulse[k] = wanted.max(0.0);
            }
            Ok(Solution { impulse, velocity, ..solution })
        }
    }

    #[test]
    fn a_mistake_in_the_sweeps_puts_every_step_out_of_its_tolerance() {
        let caught_in = |stored: &str, scheme: &dyn Fn(Bullet) -> Bullet, solver: &dyn Fn(SequentialImpulses) -> Box<dyn ContactSolver>| {
            let run = BulletSteps::from_json(stored).expect("stored");
            let right = (run.scheme().expect("given"), run.solver().expect("given"));
            assert!(stepped(&run, &right.0, &right.1).expect("steps").holds());
            caught(stepped(&run, &scheme(right.0), solver(right.1).as_ref()));
        };
        let same = |scheme| scheme;
        caught_in(FIVE_SWEEPS, &same, &|right| Box::new(FrictionFirst(right)));
        caught_in(FIVE_SWEEPS, &same, &|right| Box::new(SequentialImpulses { sweeps: right.sweeps + 1, ..right }));
        caught_in(STEPS, &same, &|right| Box::new(SequentialImpulses { residual: 0.0, ..right }));
        caught_in(STEPS, &same, &|_| Box::new(ProjectedGaussSeidel::accelerated()));
        caught_in(WARM, &same, &|right| Box::new(SequentialImpulses { warm_start: 0.1, ..right }));
        caught_in(PYRAMID, &|scheme| Bullet { friction: Friction::Cone, ..scheme }, &|right| Box::new(right));
        caught_in(PYRAMID, &|scheme| Bullet { bodies: Bodies::Rigid, ..scheme }, &|right| Box::new(right));
    }
}
