//! `moreau new`: files to begin with, each read as it is by the command that it is for.

use super::kind::read_problem;
use super::output::{print, print_aside};
use super::outputs::{self, Content, JAVASCRIPT, JSON, PYTHON, RUST};
use super::{Answer, posed};
use crate::files::write_atomically;
use crate::problem::Posed;
use crate::report::json::pretty;
use crate::{Error, Result};
use clap::{Subcommand, ValueEnum};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Write a file to begin with: a contact problem, a solution, a scene, or an engine for the gate.
///
/// The file is complete: the commands that are named on standard error take it as it is. Change it into yours.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(subcommand)]
    what: What,
}

const EXAMPLES: &str = "\
Examples:
  moreau new problem --out problem.json                    then: moreau solve problem.json
  moreau new solution problem.json --out answer.json       then: moreau certify problem.json answer.json
  moreau new scene --out scene.json                        then: moreau simulate --scene scene.json
  moreau new engine --language python --out my_engine.py   then: moreau gate --quick -- python3 my_engine.py";

#[derive(Subcommand)]
enum What {
    /// A contact-problem/1: a block of 1 kg arrives at 1 m/s and slides at 2 m/s, μ = 1/2.
    Problem(Output),
    /// A solution/1 of the size of a problem, all impulses 0: certify says what is wrong with it.
    Solution(SolutionArguments),
    /// A scene/1: a ball falls beside a block that slides.
    Scene(Output),
    /// An adapter of the protocol moreau-engine/1 with an engine in it, one ball over a plane, that gets verdicts.
    Engine(EngineArguments),
}

#[derive(clap::Args)]
struct Output {
    /// The file to write; it must not exist. Without it, standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

#[derive(clap::Args)]
struct SolutionArguments {
    /// The problem: contact-problem/1, lcp/1, .dat of Siconos, or HDF5 of FCLIB.
    #[arg(value_name = "PROBLEM")]
    problem: PathBuf,
    #[command(flatten)]
    output: Output,
}

#[derive(clap::Args)]
struct EngineArguments {
    /// The language.
    #[arg(long, value_enum)]
    language: Language,
    #[command(flatten)]
    output: Output,
}

#[derive(Clone, Copy, ValueEnum)]
enum Language {
    /// Python 3, with its standard library alone.
    Python,
    /// Rust, with the crate `moreau` of a checkout.
    Rust,
    /// JavaScript for Node, without packages.
    #[value(alias = "js")]
    Javascript,
}

/// A file to begin with: its text, and what to do with it; `FILE` stands for its name.
struct Skeleton {
    text: String,
    advice: &'static str,
    content: Content,
}

const PROBLEM: &str = "\
contact-problem/1: u = W r + u_free. `delassus` is W [1/kg], `free_velocity` is u_free [m/s]; of every contact first the normal row, then
`dimension` - 1 tangential ones. `law` and `friction` say which impulses r [N s] answer which velocities. Every field: docs/formats.md,
`moreau schema contact-problem`.
  moreau solve FILE --out answer.json
  moreau new solution FILE
";

const SOLUTION: &str = "\
solution/1: `impulse` is r [N s], of every contact first the normal entry, then the tangential ones. All are 0 here: write yours.
  moreau certify PROBLEM FILE
";

const SCENE: &str = "\
scene/1: SI units, z upwards. A body has one of `sphere`, `box`, `capsule`, `cylinder`. Every field: docs/formats.md, `moreau schema scene`.
  moreau simulate --scene FILE --plot motion.svg
  moreau compare FILE
";

const IN_PYTHON: &str = "\
An adapter of moreau-engine/1 with one ball over a plane; put your engine where YOURS is written.
  moreau protocol-check -- python3 FILE
  moreau gate --quick -- python3 FILE
";

const IN_JAVASCRIPT: &str = "\
An adapter of moreau-engine/1 with one ball over a plane; put your engine where YOURS is written.
  moreau protocol-check -- node FILE
  moreau gate --quick -- node FILE
";

const IN_RUST: &str = "\
An adapter of moreau-engine/1 with one ball over a plane, the src/main.rs of a program; put your engine where YOURS is written.
  cargo add --path CHECKOUT_OF_MOREAU && cargo build --release
  moreau protocol-check -- target/release/PROGRAM
  moreau gate --quick -- target/release/PROGRAM
";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    let of = |text: &str, advice| Skeleton { text: text.into(), advice, content: JSON };
    let (skeleton, output) = match &arguments.what {
        What::Problem(output) => (of(include_str!("templates/problem.json"), PROBLEM), output),
        What::Scene(output) => (of(include_str!("templates/scene.json"), SCENE), output),
        What::Solution(SolutionArguments { problem, output }) => (of(&answer_of_zeros(problem)?, SOLUTION), output),
        What::Engine(EngineArguments { language, output }) => (engine(*language), output),
    };
    write(&skeleton, output.out.as_deref())
}

fn engine(language: Language) -> Skeleton {
    let (text, advice, content) = match language {
        Language::Python => (include_str!("templates/engine.py"), IN_PYTHON, PYTHON),
        Language::Javascript => (include_str!("templates/engine.js"), IN_JAVASCRIPT, JAVASCRIPT),
        Language::Rust => (include_str!("../../examples/adapter.rs"), IN_RUST, RUST),
    };
    Skeleton { text: text.into(), advice, content }
}

/// The file, or standard output; what to do with it on standard error.
fn write(skeleton: &Skeleton, out: Option<&Path>) -> Result<Answer> {
    match out {
        Some(file) if file.exists() => {
            let problem = format!("is {}, which is there already", file.display());
            return Err(Error::invalid("--out", problem, "name another file, or remove this one"));
        }
        Some(file) => {
            outputs::require("--out", out, skeleton.content)?;
            write_atomically(file, skeleton.text.as_bytes())?;
        }
        None => print(&skeleton.text)?,
    }
    let name = out.map_or("FILE".into(), |file| file.display().to_string());
    print_aside(&skeleton.advice.replace("FILE", &name));
    Ok(Answer::Yes)
}

/// A solution/1 as people write it: nothing that follows from the impulses.
#[derive(Serialize)]
struct Written<'a> {
    schema: &'static str,
    #[serde(skip_serializing_if = "str::is_empty")]
    problem: &'a str,
    solver: &'static str,
    impulse: Vec<f64>,
}

/// The answer of no impulse at all to a problem.
fn answer_of_zeros(file: &Path) -> Result<String> {
    let posed = read_problem(file, "moreau new solution PROBLEM")?;
    let rows = match &posed {
        Posed::Contacts(problem) => problem.rows(),
        Posed::Jointed(problem) => problem.rows(),
    };
    pretty(&Written { schema: "solution/1", problem: posed::name(&posed), solver: "by hand", impulse: vec![0.0; rows] })
}
