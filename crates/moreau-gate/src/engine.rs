//! What the gate may ask of a simulator: the Rust form of the protocol `moreau-engine/1` (see `docs/protocol.md`).

use crate::Description;
pub use crate::description::Options;
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;

/// An engine's answer, or why there is none.
pub type Reply<T> = std::result::Result<T, Refusal>;

/// Why an engine gave no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The engine cannot express what was asked; the text is its reason. This answer never counts against the engine.
    Unsupported(String),
    /// The engine should have answered but did not; the text is the cause.
    Errored(String),
}

impl Refusal {
    /// `unsupported` with this reason.
    pub fn unsupported(reason: impl Into<String>) -> Self {
        Refusal::Unsupported(reason.into())
    }

    /// `errored` with this cause.
    pub fn errored(cause: impl std::fmt::Display) -> Self {
        Refusal::Errored(cause.to_string())
    }
}

impl std::fmt::Display for Refusal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Refusal::Unsupported(reason) => write!(f, "unsupported: {reason}"),
            Refusal::Errored(cause) => write!(f, "errored: {cause}"),
        }
    }
}

/// A simulator, a contact solver or a cone projection, as the gate sees it.
///
/// Only [`Engine::describe`] is required; what an engine does not have, it refuses by the default methods.
pub trait Engine: Send {
    /// Who the engine is and which contact model it declares, under these options.
    ///
    /// # Errors
    /// [`Refusal::Errored`] if the options are unknown or the engine cannot be asked.
    fn describe(&mut self, options: &Options) -> Reply<Description>;

    /// The motion of a scene in steps of h \[s\]; samples at k · `sample_every` · h, beginning with t = 0.
    ///
    /// # Errors
    /// [`Refusal`], if there is no answer.
    fn simulate(&mut self, scene: &Scene, time_step: f64, sample_every: usize, options: &Options) -> Reply<Trajectory> {
        let _ = (scene, time_step, sample_every, options);
        Err(Refusal::unsupported("this engine does not simulate"))
    }

    /// Impulses and velocities of a contact problem.
    ///
    /// # Errors
    /// [`Refusal`], if there is no answer.
    fn solve(&mut self, problem: &ContactProblem, options: &Options) -> Reply<Solution> {
        let _ = (problem, options);
        Err(Refusal::unsupported("this engine does not solve contact problems"))
    }

    /// The projections of points (n, t₁) or (n, t₁, t₂) on the cone ‖t‖ ≤ μ n.
    ///
    /// # Errors
    /// [`Refusal`], if there is no answer.
    fn project(&mut self, friction: f64, points: &[Vec<f64>], options: &Options) -> Reply<Vec<Vec<f64>>> {
        let _ = (friction, points, options);
        Err(Refusal::unsupported("this engine does not project on friction cones"))
    }

    /// Whether the engine can be asked on as it is: an answer `error` leaves it so, a crash, silence or garbage do not.
    fn in_conversation(&self) -> bool {
        true
    }
}
