//! `moreau bench`: times solvers on problems, each beside the residual of its certified answer.

use super::limits::CommonOptions;
use super::output::print;
use super::posed::{self, answer_of};
use super::problem_law::LawOption;
use super::solver_options::ToleranceOption;
use super::{Answer, Format, progress, solver_table};
use crate::files::write_atomically;
use crate::number::significant;
use crate::problem::{Posed, Solution};
use crate::report::bench::{Bench, FACTORS, Run};
use crate::report::json::pretty;
use crate::solvers::ContactSolver;
use crate::solvers::watch::watched;
use crate::tolerance::bench::SHIFT;
use crate::{Error, Result};
use indicatif::ProgressBar;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Time solvers on contact problems, each time beside the certified residual of its answer.
///
/// Solving is timed alone, without reading and certifying, and repeated until the given time is used up; the least time counts. One
/// thread solves.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{}", explained()))]
pub struct Arguments {
    /// Problems (contact-problem/1, lcp/1, .dat of Siconos, HDF5 of FCLIB), or folders of them.
    #[arg(required = true)]
    problems: Vec<PathBuf>,
    /// A solver to time; may be given several times.
    #[arg(long, default_value = "auto", value_name = "NAME", long_help = format!("{}; may be given several times", solver_table::table()))]
    solver: Vec<String>,
    #[command(flatten)]
    tolerance: ToleranceOption,
    /// Time to spend on repeating one measurement [s].
    #[arg(long, default_value_t = 0.2, value_name = "SECONDS", allow_hyphen_values = true)]
    repeat: f64,
    /// Solve this often instead, whatever the time.
    #[arg(long, value_name = "NUMBER", conflicts_with = "repeat")]
    solves: Option<usize>,
    /// Write every answer into this folder, a solution/1 named after problem and solver.
    #[arg(long, value_name = "FOLDER")]
    answers: Option<PathBuf>,
    #[command(flatten)]
    law: LawOption,
    #[command(flatten)]
    common: CommonOptions,
}

const EXAMPLES: &str = "\
Examples:
  moreau bench problems/
  moreau bench problems/ --solver auto --solver pgs --format json > times.json
  moreau bench problems/ --law associated --tolerance 1e-12 --answers answers/

Exit code 0: every problem was solved by some solver, or has no solution, as is proved; 1: some was not solved; 2: a file
cannot be read.";

/// What the columns and the lines below them are.
fn explained() -> String {
    let (shift, factors) = (significant(1e3 * SHIFT), FACTORS.map(significant).join(", "));
    format!(
        "\
A line per problem and solver:
  contacts    of the problem
  time        the least time of a solve, without reading and certifying
  residual    the largest residual of the certificate relative to the scale of its contact; solved is what has at most --tolerance
              (`moreau certify --help` explains each residual)
  ρ = 1       ‖r − P_K(r − ŷ)‖/‖q‖ with ρ = 1 kg and q = u_free + shift, the number other collections compare; it decides nothing, and
              polyhedral laws have none
  iterations  sweeps, steps or pivots of that solve
In place of the numbers stands why there is no answer; `not solved` is an answer that the certificate rejects; `no solution, as is
proved` that the problem has none, so that no answer is the right one, and it counts neither as solved nor as not.

A line per solver, below:
  shifted geometric mean    exp(mean ln(t + s)) − s over the problems that it solved, s = {shift} ms: ten times as long counts alike for
                            short and long problems, and times far below s count alike. Compare it only between solvers that solved the
                            same problems
  P % within τ              performance profile: of all problems, solved or not, this part was solved in at most τ times the best time
                            of any solver of this run; τ = {factors}. At τ = 1: how often it was the
                            fastest; at the largest τ: how many it solves at all. With one solver every number is the part that it solved"
    )
}

/// The ends of files that hold problems.
const ENDS: [&str; 4] = ["json", "dat", "hdf5", "h5"];

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    arguments.tolerance.check()?;
    if !(arguments.repeat >= 0.0 && arguments.repeat.is_finite()) {
        return Err(Error::invalid("--repeat", format!("is {}", arguments.repeat), "give a time ≥ 0 in seconds"));
    }
    arguments.common.apply()?;
    if arguments.solves == Some(0) {
        return Err(Error::invalid("--solves", "is 0", "give a number from 1"));
    }
    if let Some((_, twice)) = arguments.solver.iter().enumerate().find(|(place, name)| arguments.solver[..*place].contains(name)) {
        return Err(Error::invalid("--solver", format!("names `{twice}` twice"), "name every solver once"));
    }
    if let Some(several) = arguments.solver.iter().find(|name| name.contains(',')) {
        let each = several.split(',').map(|name| format!("--solver {}", name.trim())).collect::<Vec<_>>().join(" ");
        return Err(Error::invalid("--solver", format!("is `{several}`, several names"), format!("give it once for each: {each}")));
    }
    let named = |name: &String| arguments.tolerance.solver(name, None);
    let solvers: Vec<Box<dyn ContactSolver>> = arguments.solver.iter().map(named).collect::<Result<_>>()?;
    let files = files(&arguments.problems)?;
    let bar = progress::parts(files.len() * solvers.len(), "solves");
    let runs = progress::shown(&bar, || timed(&files, &solvers, arguments, &bar))?;
    let bench = Bench::new(arguments.tolerance.accepted(), runs);
    print(&match arguments.common.format {
        Format::Text => bench.text(),
        Format::Json => pretty(&bench)?,
    })?;
    Ok(bench.all_solved().into())
}

/// Every solver on every problem.
fn timed(files: &[PathBuf], solvers: &[Box<dyn ContactSolver>], arguments: &Arguments, bar: &ProgressBar) -> Result<Vec<Run>> {
    let mut runs: Vec<Run> = Vec::new();
    for file in files {
        let problem = arguments.law.pose(Posed::read(file)?)?;
        let (name, first) = (file.file_name().unwrap_or_default().to_string_lossy().into_owned(), runs.len());
        for solver in solvers {
            bar.set_message(format!(", {name}, {}", solver.name()));
            runs.push(measured(&problem, &name, solver.as_ref(), arguments)?);
            bar.inc(1);
        }
        // where nobody found a solution there may be none: then that is the right answer
        let own = &mut runs[first..];
        if !own.iter().any(|run| run.solved) && posed::refuted(&problem).is_some() {
            own.iter_mut().for_each(|run| run.without_solution = true);
        }
    }
    Ok(runs)
}

/// The files given, and those of problems in the folders given, in order.
fn files(given: &[PathBuf]) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for path in given {
        if !path.is_dir() {
            found.push(path.clone());
            continue;
        }
        let failed = |source| Error::Read { file: path.clone(), source };
        let entries: Vec<PathBuf> = std::fs::read_dir(path)
            .map_err(failed)?
            .map(|entry| entry.map(|entry| entry.path()))
            .collect::<std::io::Result<_>>()
            .map_err(failed)?;
        let ends = |file: &Path| file.extension().is_some_and(|end| ENDS.iter().any(|known| end == *known));
        let is_problem = |file: &Path| ends(file) && !is_answer(file);
        let mut problems: Vec<PathBuf> = entries.into_iter().filter(|file| is_problem(file)).collect();
        if problems.is_empty() {
            let cure = format!("give a folder with files that end in {}", ENDS.join(", "));
            return Err(Error::invalid("PROBLEMS", format!("has none in the folder {}", path.display()), cure));
        }
        problems.sort();
        found.extend(problems);
    }
    Ok(found)
}

/// Whether a file of a folder is an answer, as `moreau problems export` puts beside its problem.
fn is_answer(file: &Path) -> bool {
    #[derive(serde::Deserialize)]
    struct Head {
        schema: Option<String>,
    }
    let text = || std::fs::read_to_string(file).ok();
    let head = || serde_json::from_str::<Head>(&text()?).ok();
    file.extension().is_some_and(|end| end == "json") && head().is_some_and(|head| head.schema.as_deref() == Some("solution/1"))
}

fn measured(problem: &Posed, name: &str, solver: &dyn ContactSolver, arguments: &Arguments) -> Result<Run> {
    let (begun, mut repeats, mut seconds, mut reproducible) = (Instant::now(), 0, f64::INFINITY, true);
    let answer = loop {
        let start = Instant::now();
        let answer = if arguments.tolerance.has_time_limit() {
            let (answer, seen) = arguments.tolerance.within_time(|interrupt| watched(interrupt, || answer_of(problem, solver)));
            reproducible &= !seen.interrupted;
            answer
        } else {
            answer_of(problem, solver)
        };
        seconds = seconds.min(start.elapsed().as_secs_f64());
        repeats += 1;
        let enough = arguments.solves.map_or(begun.elapsed().as_secs_f64() >= arguments.repeat, |solves| repeats >= solves);
        if answer.is_err() || enough {
            break answer;
        }
    };
    let mut run = Run {
        problem: name.into(),
        contacts: posed::constraints(problem),
        solver: solver.name().into(),
        seconds,
        repeats,
        reproducible,
        iterations: 0,
        certifying: None,
        relative: None,
        natural_map_one: None,
        solved: false,
        without_solution: false,
        answer: None,
        failure: None,
    };
    match answer {
        Ok(solution) => judge(problem, &solution, arguments, &mut run)?,
        Err(error @ Error::Solver { .. }) => run.failure = Some(posed::with_cure(error, problem).to_string()),
        Err(error) => return Err(error),
    }
    Ok(run)
}

/// What the certificate says of the answer, and the answer itself where it is kept.
fn judge(problem: &Posed, solution: &Solution, arguments: &Arguments, run: &mut Run) -> Result<()> {
    let start = Instant::now();
    let judged = posed::judge(problem, solution)?;
    run.certifying = Some(start.elapsed().as_secs_f64());
    run.iterations = solution.iterations;
    run.relative = Some(judged.relative());
    run.natural_map_one = posed::natural_map(problem, solution);
    run.solved = judged.is_solution(arguments.tolerance.accepted());
    if let Some(folder) = &arguments.answers {
        std::fs::create_dir_all(folder).map_err(|source| Error::Write { file: folder.clone(), source })?;
        let name = format!("{}.{}.json", run.problem, run.solver);
        write_atomically(&folder.join(&name), solution.to_json(Some(posed::name(problem)), None).as_bytes())?;
        run.answer = Some(name);
    }
    Ok(())
}
