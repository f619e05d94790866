//! The arguments of `moreau gate`.

use crate::cli::{Format, number};
use std::path::PathBuf;

/// Judge a simulator: every check over a sweep of time steps, against its own model and against Coulomb–Signorini.
///
/// COMMAND is a program that speaks the protocol moreau-engine/1 (docs/protocol.md): JSON lines on standard input and
/// output. Each check gets a verdict: pass; difference (documented: as the engine's declared contact law predicts);
/// fail; unsupported, with the engine's reason; errored, with the cause.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The engine: a command with its arguments.
    #[arg(last = true, value_name = "COMMAND", required_unless_present_any = ["trajectory", "list", "explain", "failures", "write_scenes"])]
    pub command: Vec<String>,
    /// Judge stored trajectories instead of a program.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "command")]
    pub trajectory: Vec<PathBuf>,
    /// The description that goes with --trajectory and --write-scenes, a JSON file as `describe` returns it; without it the engine is taken
    /// for rigid, and what the checks ask depends on it.
    #[arg(long, value_name = "FILE")]
    pub description: Option<PathBuf>,
    /// Only the checks of contact solvers.
    #[arg(long, conflicts_with_all = ["trajectory", "projection"])]
    pub solver: bool,
    /// Only the checks of cone projections.
    #[arg(long, conflicts_with = "trajectory")]
    pub projection: bool,
    /// The quick sweep for CI: h = 1/60, 1/240 and 0.001 s.
    #[arg(long, conflicts_with = "steps")]
    pub quick: bool,
    /// The time steps of the sweep [s], such as 0.01,1/240. Long ones show less: what a sound step may err grows with the step.
    #[arg(long, value_name = "H,H,…", value_delimiter = ',', allow_hyphen_values = true)]
    pub steps: Vec<String>,
    /// Only checks whose name contains one of these.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub only: Vec<String>,
    /// Leave out checks whose name contains one of these.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub skip: Vec<String>,
    /// An option for the engine, sent with every request; the value is JSON, or a text.
    #[arg(long = "option", value_name = "NAME=VALUE")]
    pub options: Vec<String>,
    /// Engines that run at once; the report is the same for every number.
    #[arg(long, value_parser = number::count, value_name = "NUMBER", default_value_t = 1, allow_negative_numbers = true)]
    pub jobs: usize,
    /// Measure this often, perturbed by 1e-9, for the spread of each value; 3 with --save-baseline, otherwise 1.
    #[arg(long, value_parser = number::count, value_name = "NUMBER", allow_negative_numbers = true)]
    pub repeat: Option<usize>,
    /// Seconds an engine may take for one request.
    #[arg(long, value_parser = number::seconds, value_name = "SECONDS", default_value_t = 60.0, allow_hyphen_values = true)]
    pub time_limit: f64,
    /// Seconds an engine may take from its start to its first reply, for one that has much to load; --time-limit unless given.
    #[arg(long, value_parser = number::seconds, value_name = "SECONDS", allow_hyphen_values = true)]
    pub start_limit: Option<f64>,
    /// The part of the checks that must be answered with pass or difference, in percent; without it at least one check, which may fail
    /// beside a baseline.
    #[arg(long, value_parser = number::real, value_name = "PERCENT", allow_negative_numbers = true)]
    pub require: Option<f64>,
    /// Compare with this baseline: exit code 1 only for what is worse.
    #[arg(long, value_name = "FILE")]
    pub baseline: Option<PathBuf>,
    /// Store this run as a baseline.
    #[arg(long, value_name = "FILE")]
    pub save_baseline: Option<PathBuf>,
    /// Write the report as JUnit XML.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Write the report as one self-contained HTML page, what fails first.
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Write the report as JSON.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// List the checks.
    #[arg(long)]
    pub list: bool,
    /// Explain one check: question, derivation, control.
    #[arg(long, value_name = "CHECK")]
    pub explain: Option<String>,
    /// Run nothing: replace the section between `<!-- failures -->` and `<!-- /failures -->` of this file with the likely causes of a
    /// failure of each check; docs/failures.md is where it stands.
    #[arg(long, value_name = "FILE", conflicts_with = "command")]
    pub failures: Option<PathBuf>,
    /// Write the scenes of the sweep into this folder, each a scene/1, for simulators that are run elsewhere and judged with --trajectory;
    /// its index.json has the time step of each and how often to sample.
    #[arg(long, value_name = "FOLDER")]
    pub write_scenes: Option<PathBuf>,
    /// How to write the report to standard output.
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

const EXAMPLES: &str = "\
Examples:
  moreau gate --quick -- python3 my_engine.py
  moreau gate --html report.html --junit report.xml -- ./my-engine --stdio
  moreau gate --option cone=elliptic --option impratio=10 -- .venv/mujoco/bin/python scripts/engines/mujoco.py
  moreau gate --save-baseline engine.toml -- ./my-engine      then, in CI:
  moreau gate --baseline engine.toml -- ./my-engine
  moreau gate --quick -- moreau engine --scheme anitescu      our own scheme over the same protocol
  moreau gate --explain ball/energy

Exit codes: 0 nothing is bad (or nothing worse than the baseline); 1 a check fails or errors, or a regression,
or less is answered than --require; 2 usage; 3 the engine could not be run;
101 a check of ours panicked; 130 interrupted, by Ctrl-C, SIGTERM or SIGHUP, after its engines were ended.";
