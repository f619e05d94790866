//! An engine in a process of its own, which speaks `moreau-engine/1` on its standard streams (see `docs/protocol.md`).
//!
//! Whatever the process does, a request ends: with its reply, or with a cause in words. After a fault the process is ended with
//! everything it has started, and begins anew for the next request.

pub(crate) mod deadline;
mod descendants;
mod group;
#[cfg(unix)]
mod guard;
mod limits;
pub mod messages;
mod not_finite;
mod pipes;
mod session;
mod words;

pub use group::{end_engines, end_engines_on_interrupt};
pub use limits::Limits;
pub use session::{Fate, Fault, Session};

use crate::{Description, Engine, Options, Refusal, Reply};
use messages::{Answer, Question, Request};
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;

/// A program that speaks the protocol; started when it is first asked, told `bye` when it is dropped.
pub struct ProcessEngine {
    command: Vec<String>,
    limits: Limits,
    session: Option<Session>,
    /// The number of the last request, over all sessions.
    id: u64,
}

impl ProcessEngine {
    /// The program with its arguments; nothing is started yet. It inherits working directory and environment.
    pub fn new(command: Vec<String>, limits: Limits) -> Self {
        ProcessEngine { command, limits, session: None, id: 0 }
    }

    /// The process number of the running program, if it runs.
    pub fn process(&self) -> Option<u32> {
        self.session.as_ref().map(Session::id)
    }

    /// Asks, and reads the result with `read`; a result that `read` refuses is a fault like any other.
    fn ask<T>(&mut self, question: Question, read: impl FnOnce(&str) -> moreau_exact::Result<T>) -> Reply<T> {
        let mut session = match self.session.take() {
            Some(session) => session,
            None => Session::start(&self.command, self.limits).map_err(Refusal::errored)?,
        };
        self.id += 1;
        let line = session.exchange(&Request::new(self.id, question).line()).map_err(Refusal::errored)?;
        let answer = messages::open(&line, Some(self.id)).and_then(|answer| match answer {
            Answer::Result(text) => read(text).map(Ok).map_err(|error| format!("the result is not well formed: {error}")),
            Answer::Unsupported(reason) => Ok(Err(Refusal::Unsupported(reason))),
            Answer::Error(message) => Ok(Err(Refusal::Errored(message))),
        });
        match answer {
            Ok(reply) => {
                self.session = Some(session);
                reply
            }
            Err(problem) => Err(Refusal::errored(session.fail(Fate::Malformed(problem)))),
        }
    }
}

impl Engine for ProcessEngine {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        self.ask(Question::Describe { options: options.clone() }, messages::description)
    }

    fn simulate(&mut self, scene: &Scene, time_step: f64, sample_every: usize, options: &Options) -> Reply<Trajectory> {
        finite([time_step])?;
        let question = Question::Simulate { scene: Box::new(scene.clone()), time_step, sample_every, options: options.clone() };
        self.ask(question, messages::trajectory)
    }

    fn solve(&mut self, problem: &ContactProblem, options: &Options) -> Reply<Solution> {
        self.ask(Question::solve(problem, options), |text| messages::solution(text, problem.rows()))
    }

    fn project(&mut self, friction: f64, points: &[Vec<f64>], options: &Options) -> Reply<Vec<Vec<f64>>> {
        finite(points.iter().flatten().copied().chain([friction]))?;
        let question = Question::Project { friction, points: points.to_vec(), options: options.clone() };
        self.ask(question, |text| messages::points(text, points))
    }

    fn in_conversation(&self) -> bool {
        self.session.is_some()
    }
}

impl Drop for ProcessEngine {
    fn drop(&mut self) {
        if let Some(session) = self.session.take() {
            // what does not end by itself is ended with the session
            let _ = session.farewell(&Request::new(self.id + 1, Question::Bye {}).line());
        }
    }
}

/// Refuses numbers that JSON cannot express: infinity and not-a-number.
fn finite(numbers: impl IntoIterator<Item = f64>) -> Reply<()> {
    if numbers.into_iter().all(f64::is_finite) { Ok(()) } else { Err(Refusal::errored("the question's numbers are not finite")) }
}
