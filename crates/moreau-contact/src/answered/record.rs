//! What is stored of an answered problem, `answered-problem/1`: its answers, how each was checked, and how hard solvers find it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Schema name of a record.
pub const RECORD_SCHEMA: &str = "answered-problem/1";

/// A contact problem of the collection with its certified answers.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// Always `answered-problem/1`.
    #[schemars(extend("const" = RECORD_SCHEMA))]
    pub schema: String,
    /// The problem's name.
    pub name: String,
    /// The family it belongs to.
    pub group: String,
    /// What it is, in a sentence.
    pub about: String,
    /// Number of contacts.
    pub contacts: usize,
    /// Rows per contact.
    pub dimension: usize,
    /// The contact law.
    pub law: String,
    /// The smallest and the largest μ.
    pub friction: [f64; 2],
    /// Whether the problem is stored; otherwise `script` makes it.
    pub stored: bool,
    /// SHA-256 of the problem's file.
    pub sha256: String,
    /// The command that writes the problem, from the repository.
    pub script: String,
    /// Answers with different velocities, the best certified first; none where there is no solution or nothing found one.
    pub answers: Vec<Answered>,
    /// Whether u is the only one.
    pub uniqueness: Uniqueness,
    /// How hard it is for plain sweeps.
    pub difficulty: Difficulty,
    /// What every solver did, each from zero impulses.
    pub solvers: Vec<Outcome>,
}

/// One answer, and what stands behind it.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Answered {
    /// r \[N·s\]; u = W r + u_free.
    pub impulse: Vec<f64>,
    /// β of Stewart–Trinkle, or edge impulses \[N·s\]; of polyhedral laws.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beta: Option<Vec<f64>>,
    /// σ of Stewart–Trinkle \[m/s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma: Option<Vec<f64>>,
    /// Who proposed it.
    pub by: String,
    /// The largest residual of the certificate relative to the scale of its contact.
    pub relative: f64,
    /// Which residual that is.
    pub residual: String,
    /// The contact where it is.
    pub contact: usize,
    /// ‖r − P_K(r − ŷ)‖/‖q‖ with ρ = 1 kg, as other collections compare; absent for polyhedral laws and q = 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub natural_map_one: Option<f64>,
    /// Proved: impulses near these solve exactly a problem whose free velocity is near.
    pub backward: Bound,
    /// Proved: a solution of the problem itself lies this near in u.
    pub forward: Bound,
    /// Others that found the same velocity, of other families of algorithms, nearest first.
    pub agreement: Vec<OtherAnswer>,
}

/// A proved bound, or the reason why there is none.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bound {
    /// At any contact, at most \[m/s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<f64>,
    /// At any contact, at most \[N·s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impulse: Option<f64>,
    /// Why there is no bound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Another answer with the same velocity.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OtherAnswer {
    /// The solver, the engine, or how a closed form comes about.
    pub by: String,
    /// max |u − u′| \[m/s\].
    pub difference: f64,
}

/// Whether the velocity u of a solution is the only one.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Uniqueness {
    /// What is known.
    pub velocity: Known,
    /// How many velocities there are, where all are known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
    /// The proof, or what stands in its way.
    pub reason: String,
}

/// What is known of the number of velocities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Known {
    /// There is one, proved.
    Unique,
    /// There is at most one, proved; whether there is a solution is not.
    AtMostOne,
    /// There are several, proved.
    Several,
    /// There is no solution, proved.
    None,
    /// Nothing is proved.
    Unknown,
}

impl Known {
    /// The word in files.
    pub fn name(self) -> &'static str {
        match self {
            Known::Unique => "unique",
            Known::AtMostOne => "at-most-one",
            Known::Several => "several",
            Known::None => "none",
            Known::Unknown => "unknown",
        }
    }
}

/// Plain Gauss–Seidel sweeps from zero until the certificate accepts 1e-8.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Difficulty {
    /// Their number; absent where they do not get there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweeps: Option<usize>,
    /// Why there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// What one solver did.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Outcome {
    /// Its name.
    pub solver: String,
    /// How it ended.
    pub ended: Ended,
    /// Iterations, sweeps or pivots.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub iterations: Option<usize>,
    /// The largest residual relative to the scale of its contact; absent without an answer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative: Option<f64>,
    /// max |u − u′| to the nearest of the answers, of a solver that solved \[m/s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub difference: Option<f64>,
    /// Why there is no answer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// How a solver ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Ended {
    /// The certificate accepts its answer at 1e-8.
    Solved,
    /// The certificate rejects its answer.
    Rejected,
    /// It gave up: a breakdown, a ray, a limit.
    Failed,
    /// The problem is not of its kind.
    Refused,
    /// It was not asked: the problem is too large for it.
    LeftOut,
}

impl Ended {
    /// Whether the solver failed at a problem of its kind: its answer is rejected, or it gave up.
    pub fn is_failure(self) -> bool {
        matches!(self, Ended::Rejected | Ended::Failed)
    }

    /// The word in files.
    pub fn name(self) -> &'static str {
        match self {
            Ended::Solved => "solved",
            Ended::Rejected => "rejected",
            Ended::Failed => "failed",
            Ended::Refused => "refused",
            Ended::LeftOut => "left-out",
        }
    }
}

impl Record {
    /// How many solvers failed at the problem; none fails at one that is proved to have no solution.
    pub fn failures(&self) -> usize {
        if self.uniqueness.velocity == Known::None {
            return 0;
        }
        self.solvers.iter().filter(|outcome| outcome.ended.is_failure()).count()
    }
}
