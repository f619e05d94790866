//! `peers/1`, what `scripts/bench_peers.py` writes: every setting of every peer on every problem, and how ours stands beside the best.

use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Schema name of the report.
pub const PEERS_SCHEMA: &str = "peers/1";

/// One run of the benchmark.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PeerReport {
    /// Always `peers/1`.
    #[schemars(extend("const" = PEERS_SCHEMA))]
    pub schema: String,
    /// When it was measured, as year-month-day.
    pub date: String,
    /// Where.
    pub machine: PeerMachine,
    /// The version of each peer, and of moreau with its commit.
    pub versions: BTreeMap<String, String>,
    /// The command line.
    pub command: String,
    /// The values of ‖r − P_K(r − ŷ)‖/‖q‖ (ρ = 1 kg) that were asked for.
    pub accuracies: Vec<f64>,
    /// How often every setting was timed, in turn.
    pub rounds: usize,
    /// The longest solve \[s\].
    pub limit: f64,
    /// A peer's setting is given up after so many times our time, but not before so many seconds.
    pub patience: [f64; 2],
    /// Every problem.
    pub problems: Vec<PeerProblem>,
    /// What follows from them, one entry per accuracy.
    pub summary: Vec<PeerSummary>,
}

/// The machine of the run.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PeerMachine {
    /// Its processor.
    pub processor: String,
    /// How many cores it has.
    pub cores: usize,
    /// Its operating system.
    pub system: String,
    /// Processes that ran or waited, over a minute, at the end.
    pub load: f64,
}

/// One problem with what every setting made of it.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PeerProblem {
    /// The file.
    pub name: String,
    /// Number of contacts.
    pub contacts: usize,
    /// The contact law.
    pub law: String,
    /// Number of rows.
    pub rows: usize,
    /// max |W − Wᵀ| / max |W|.
    pub asymmetry: f64,
    /// One entry per setting and accuracy.
    pub results: Vec<PeerResult>,
}

/// What one setting made of one problem.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PeerResult {
    /// The program: `moreau` or a peer.
    pub peer: String,
    /// Its algorithm and storage.
    pub setting: String,
    /// The accuracy that counts.
    pub accuracy: f64,
    /// Whether it was given (W + Wᵀ)/2.
    pub symmetrised: bool,
    /// Whether its answer has the accuracy, computed apart.
    pub reached: bool,
    /// The tolerance that it was asked for.
    pub asked: Option<f64>,
    /// ‖r − P_K(r − ŷ)‖/‖q‖ of its answer.
    pub residual: Option<f64>,
    /// The least time of a solve \[s\].
    pub seconds: Option<f64>,
    /// Iterations, as it counts them.
    pub iterations: Option<usize>,
    /// What it says, or why it gave nothing.
    pub note: Option<String>,
    /// The times of all rounds \[s\].
    pub times: Option<Vec<f64>>,
    /// The time of our certificate \[s\].
    pub certifying: Option<f64>,
    /// Whether our certificate accepts our answer.
    pub certified: Option<bool>,
    /// The largest residual of our certificate, relative to its scale.
    pub relative: Option<f64>,
    /// Instructions of one solve, where they were counted.
    pub instructions: Option<u64>,
}

/// Ours beside the virtual best peer at one accuracy.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PeerSummary {
    /// The accuracy.
    pub accuracy: f64,
    /// How many problems there are.
    pub problems: usize,
    /// How many of them ours solved.
    pub moreau: usize,
    /// How many some peer solved.
    pub peers: usize,
    /// The same by size of the problem.
    pub classes: Vec<PeerClass>,
    /// Of every setting the part of all problems that it solves within 1, 1.2, 1.5, 2, 5, 10 and 100 times the best time of all.
    pub profile: BTreeMap<String, Vec<f64>>,
}

/// Problems of one size.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PeerClass {
    /// The sizes, in words.
    pub class: String,
    /// How many problems.
    pub problems: usize,
    /// How many both solved.
    pub both: usize,
    /// The geometric mean of our time over the best peer's, on these.
    pub ratio: Option<f64>,
    /// The largest ratio.
    pub worst: Option<f64>,
    /// Our shifted geometric mean \[s\].
    pub moreau_seconds: Option<f64>,
    /// The best peer's \[s\].
    pub peer_seconds: Option<f64>,
}
