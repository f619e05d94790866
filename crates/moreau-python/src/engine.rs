//! An engine that is a Python class, asked in this process by the messages of `moreau-engine/1`.

use delegate::delegate;
use moreau::Result;
use moreau::gate::process::messages::{self, Answer, Question, Request};
use moreau::gate::{Description, Engine, Options, Refusal, Reply};
use moreau::problem::{ContactProblem, Solution};
use moreau::scenes::Scene;
use moreau::trajectory::Trajectory;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// What the engines of one run share.
#[derive(Clone, Default)]
pub struct Shared {
    /// Whether the run is to end.
    pub stopped: Arc<AtomicBool>,
    /// The motion that was answered last.
    pub last: Arc<Mutex<Option<Trajectory>>>,
}

/// One object of the class.
pub struct PythonEngine {
    class: Py<PyAny>,
    engine: Option<Py<PyAny>>,
    id: u64,
    shared: Shared,
}

impl PythonEngine {
    /// The object is made when it is first asked.
    pub fn new(class: Py<PyAny>, shared: Shared) -> Self {
        PythonEngine { class, engine: None, id: 0, shared }
    }

    /// The text of the reply to a line.
    fn exchange(&mut self, line: &str) -> PyResult<String> {
        Python::attach(|py| {
            let glue = py.import("moreau_contact._engine")?;
            let engine = match self.engine.take() {
                Some(engine) => engine,
                None => glue.call_method1("made", (&self.class,))?.unbind(),
            };
            let reply = glue.call_method1("answer", (&engine, line))?.extract();
            self.engine = Some(engine);
            reply
        })
    }

    fn ask<T>(&mut self, question: Question, read: impl FnOnce(&str) -> Result<T>) -> Reply<T> {
        self.id += 1;
        let reply = self.exchange(&Request::new(self.id, question).line()).map_err(Refusal::errored)?;
        let answer = messages::open(reply.as_bytes(), Some(self.id)).map_err(Refusal::errored)?;
        match answer {
            Answer::Result(text) => read(text).map_err(|error| Refusal::errored(format!("the result is not well formed: {error}"))),
            Answer::Unsupported(reason) => Err(Refusal::Unsupported(reason)),
            Answer::Error(message) => Err(Refusal::Errored(message)),
        }
    }
}

/// An engine that is asked nothing more once the run is to end.
pub struct Stoppable {
    /// The engine.
    pub engine: Box<dyn Engine>,
    /// Whether the run is to end.
    pub stopped: Arc<AtomicBool>,
}

impl Stoppable {
    fn allowed(&mut self) -> Reply<&mut dyn Engine> {
        match self.stopped.load(Ordering::Relaxed) {
            true => Err(Refusal::errored("the run was interrupted")),
            false => Ok(self.engine.as_mut()),
        }
    }
}

impl Engine for Stoppable {
    delegate! {
        to self.allowed()? {
            fn describe(&mut self, options: &Options) -> Reply<Description>;
            fn simulate(&mut self, scene: &Scene, time_step: f64, sample_every: usize, options: &Options) -> Reply<Trajectory>;
            fn solve(&mut self, problem: &ContactProblem, options: &Options) -> Reply<Solution>;
            fn project(&mut self, friction: f64, points: &[Vec<f64>], options: &Options) -> Reply<Vec<Vec<f64>>>;
        }
        to self.engine {
            fn in_conversation(&self) -> bool;
        }
    }
}

impl Engine for PythonEngine {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        self.ask(Question::Describe { options: options.clone() }, messages::description)
    }

    fn simulate(&mut self, scene: &Scene, time_step: f64, sample_every: usize, options: &Options) -> Reply<Trajectory> {
        let question = Question::Simulate { scene: Box::new(scene.clone()), time_step, sample_every, options: options.clone() };
        let trajectory = self.ask(question, messages::trajectory)?;
        *self.shared.last.lock().unwrap_or_else(PoisonError::into_inner) = Some(trajectory.clone());
        Ok(trajectory)
    }

    fn solve(&mut self, problem: &ContactProblem, options: &Options) -> Reply<Solution> {
        self.ask(Question::solve(problem, options), |text| messages::solution(text, problem.rows()))
    }

    fn project(&mut self, friction: f64, points: &[Vec<f64>], options: &Options) -> Reply<Vec<Vec<f64>>> {
        let question = Question::Project { friction, points: points.to_vec(), options: options.clone() };
        self.ask(question, |text| messages::points(text, points))
    }
}
