//! The bench a check works at: the engine with its description, and replies that have been looked at before they are used.

use crate::description::Friction;
use crate::tolerance::{PERTURBATION, SAME_TIME};
use crate::{Description, Engine, Options, Refusal, Reply};
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;

/// An engine on the bench, under fixed options.
pub struct Bench<'a> {
    engine: &'a mut dyn Engine,
    description: &'a Description,
    options: &'a Options,
    /// Relative change of gravity and of linear velocities.
    perturbation: f64,
}

impl<'a> Bench<'a> {
    /// The engine with the description it gave under these options.
    pub fn new(engine: &'a mut dyn Engine, description: &'a Description, options: &'a Options) -> Self {
        Bench { engine, description, options, perturbation: 0.0 }
    }

    /// The bench of the `repeat`-th measurement: gravity and linear velocities are changed by ±1, ±2, … times 2⁻³⁰ of themselves, which
    /// moves no exact value by more than that and shows how far the engine's numbers scatter. The 0-th is not perturbed.
    pub fn perturbed(mut self, repeat: usize) -> Self {
        let sign = if repeat % 2 == 1 { 1.0 } else { -1.0 };
        self.perturbation = sign * repeat.div_ceil(2) as f64 * PERTURBATION;
        self
    }

    /// What the engine said of itself.
    pub fn description(&self) -> &Description {
        self.description
    }

    /// ε of the engine's arithmetic.
    pub fn epsilon(&self) -> f64 {
        self.description.precision.epsilon()
    }

    /// The motion of a scene over `steps` steps of h \[s\], every `sample_every`-th state; the scene's duration is replaced by steps · h.
    ///
    /// # Errors
    /// `unsupported` if the scene has restitution or friction and the engine does not, or as the engine answers; `errored` also if the
    /// trajectory does not answer the question: other bodies, other times, another start, numbers that are not finite.
    pub fn simulate(&mut self, scene: &Scene, time_step: f64, steps: usize, sample_every: usize) -> Reply<Trajectory> {
        self.simulate_with(scene, time_step, steps, sample_every, &Options::new())
    }

    /// [`Bench::simulate`] with further options.
    ///
    /// # Errors
    /// Those of [`Bench::simulate`].
    pub fn simulate_with(&mut self, scene: &Scene, time_step: f64, steps: usize, sample_every: usize, more: &Options) -> Reply<Trajectory> {
        self.can_express(scene)?;
        let mut scene = scene.clone();
        scene.duration = steps as f64 * time_step;
        self.perturb(&mut scene);
        scene.validate().map_err(Refusal::errored)?;
        let mut options = self.options.clone();
        options.extend(more.clone());
        let trajectory = self.engine.simulate(&scene, time_step, sample_every, &options)?;
        answers(&trajectory, &scene, time_step, steps, sample_every).map_err(Refusal::Errored)?;
        Ok(trajectory)
    }

    /// The engine's answer to a contact problem; sizes are checked, the answer is not judged.
    ///
    /// # Errors
    /// As the engine answers; `errored` if sizes are wrong or numbers not finite.
    pub fn solve(&mut self, problem: &ContactProblem) -> Reply<Solution> {
        let solution = self.engine.solve(problem, self.options)?;
        for (field, vector) in [("impulse", &solution.impulse), ("velocity", &solution.velocity)] {
            if vector.len() != problem.rows() {
                return Err(Refusal::Errored(format!("`{field}` has {} entries instead of {}", vector.len(), problem.rows())));
            }
            if vector.iter().any(|x| !x.is_finite()) {
                return Err(Refusal::Errored(format!("`{field}` is not finite")));
            }
        }
        Ok(solution)
    }

    /// Whether the engine answered what it was asked last, if only with `error` or `unsupported`: see [`Engine::in_conversation`].
    pub fn in_conversation(&self) -> bool {
        self.engine.in_conversation()
    }

    /// The engine's projections of points on the cone ‖t‖ ≤ μ n; sizes are checked.
    ///
    /// # Errors
    /// As the engine answers; `errored` if sizes are wrong or numbers not finite.
    pub fn project(&mut self, friction: f64, points: &[Vec<f64>]) -> Reply<Vec<Vec<f64>>> {
        let projected = self.engine.project(friction, points, self.options)?;
        let same = projected.len() == points.len() && projected.iter().zip(points).all(|(one, other)| one.len() == other.len());
        if !same {
            return Err(Refusal::errored("`points` differs in size from the points of the request"));
        }
        if projected.iter().flatten().any(|x| !x.is_finite()) {
            return Err(Refusal::errored("`points` is not finite"));
        }
        Ok(projected)
    }

    fn perturb(&self, scene: &mut Scene) {
        let velocities = scene.bodies.iter_mut().flat_map(|body| body.linear_velocity.iter_mut());
        for number in velocities.chain(&mut scene.gravity) {
            *number *= 1.0 + self.perturbation;
        }
    }

    fn can_express(&self, scene: &Scene) -> Reply<()> {
        let pairs = &scene.material.pairs;
        let restitution = scene.material.restitution > 0.0 || pairs.iter().any(|pair| pair.restitution.is_some_and(|e| e > 0.0));
        if restitution && !self.description.restitution {
            return Err(Refusal::unsupported("the engine has no coefficient of restitution"));
        }
        let friction = scene.material.friction > 0.0 || pairs.iter().any(|pair| pair.friction.is_some_and(|mu| mu > 0.0));
        if friction && self.description.friction == Friction::None {
            return Err(Refusal::unsupported("the engine has no friction"));
        }
        Ok(())
    }
}

/// Whether a trajectory answers the request, and if not, why.
fn answers(trajectory: &Trajectory, scene: &Scene, time_step: f64, steps: usize, sample_every: usize) -> Result<(), String> {
    trajectory.validate().map_err(|error| error.to_string())?;
    let names = |scene: &Scene| scene.bodies.iter().map(|body| body.name.clone()).collect::<Vec<_>>();
    if names(&trajectory.scene) != names(scene) {
        return Err("the trajectory is of another scene: its bodies differ".into());
    }
    let samples = steps / sample_every + 1;
    if trajectory.times.len() != samples {
        return Err(format!("the trajectory has {} samples instead of {samples}", trajectory.times.len()));
    }
    for (k, time) in trajectory.times.iter().enumerate() {
        let expected = (k * sample_every) as f64 * time_step;
        if (time - expected).abs() > SAME_TIME * scene.duration {
            return Err(format!("times[{k}] is {time} instead of {expected}"));
        }
    }
    Ok(())
}
