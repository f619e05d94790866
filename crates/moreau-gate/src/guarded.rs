//! An engine whose panics are its own: they become [`Refusal::Errored`] where the engine is asked, so that any other panic is the gate's.

use crate::{Description, Engine, Options, Refusal, Reply};
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// An engine that is made when it is first asked, and again after it panicked.
pub struct Guarded<'a> {
    make: &'a (dyn Fn() -> Box<dyn Engine> + Sync),
    engine: Option<Box<dyn Engine>>,
}

impl<'a> Guarded<'a> {
    /// The engine that `make` makes.
    pub fn new(make: &'a (dyn Fn() -> Box<dyn Engine> + Sync)) -> Self {
        Guarded { make, engine: None }
    }

    fn ask<T>(&mut self, question: impl FnOnce(&mut dyn Engine) -> Reply<T>) -> Reply<T> {
        let (make, engine) = (self.make, self.engine.take());
        let answered = catch_unwind(AssertUnwindSafe(move || {
            let mut engine = engine.unwrap_or_else(make);
            let reply = question(engine.as_mut());
            (engine, reply)
        }));
        let (engine, reply) = answered.map_err(|_| Refusal::errored("the engine panicked; its message is on standard error"))?;
        self.engine = Some(engine);
        reply
    }
}

impl Engine for Guarded<'_> {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        self.ask(|engine| engine.describe(options))
    }

    fn simulate(&mut self, scene: &Scene, time_step: f64, sample_every: usize, options: &Options) -> Reply<Trajectory> {
        self.ask(|engine| engine.simulate(scene, time_step, sample_every, options))
    }

    fn solve(&mut self, problem: &ContactProblem, options: &Options) -> Reply<Solution> {
        self.ask(|engine| engine.solve(problem, options))
    }

    fn project(&mut self, friction: f64, points: &[Vec<f64>], options: &Options) -> Reply<Vec<Vec<f64>>> {
        self.ask(|engine| engine.project(friction, points, options))
    }

    fn in_conversation(&self) -> bool {
        self.engine.as_ref().is_none_or(|engine| engine.in_conversation())
    }
}
