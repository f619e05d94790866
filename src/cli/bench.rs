//! `moreau bench`: times solvers on problems, each beside the residual of its certified answer.

use super::limits::CommonOptions;
use super::output::{print, table};
use super::posed::{self, answer_of};
use super::problem_law::LawOption;
use super::solver_options::ToleranceOption;
use super::{Answer, Format, number, progress, several, solver_table};
use crate::files::write_atomically;
use crate::number::significant;
use crate::problem::{Posed, Solution};
use crate::report::bench::{Bench, FACTORS, Refused, Run};
use crate::report::json::pretty;
use crate::solvers::ContactSolver;
use crate::solvers::watch::watched;
use crate::tolerance::bench::SHIFT;
use crate::tolerance::cli::LONGEST_SECONDS;
use crate::{Error, Result};
use indicatif::ProgressBar;
use std::path::PathBuf;
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
    #[arg(long, default_value_t = 0.2, value_parser = number::seconds, value_name = "SECONDS", allow_hyphen_values = true)]
    repeat: f64,
    /// Solve this often instead, whatever the time.
    #[arg(long, value_parser = number::count, value_name = "NUMBER", conflicts_with = "repeat", allow_negative_numbers = true)]
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

Exit code 0: every problem was solved by some solver, or has no solution, as is proved; 1: some was not solved, by solvers
that refuse its law, too; 2: a file cannot be read, or what it says needs more memory than is allowed; the others are
measured all the same. A proved absence of solutions is no failure of a solver, so that it counts as 0 here; to
`moreau solve`, which is asked for answers, it is 1.";

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
proved` that the problem has none, so that no answer is the right one, and it counts neither as solved nor as not. Below the others
stand files that cannot be used, each with the reason.

A line per solver, below:
  shifted geometric mean    exp(mean ln(t + s)) − s over the problems that it solved, s = {shift} ms: ten times as long counts alike for
                            short and long problems, and times far below s count alike. Compare it only between solvers that solved the
                            same problems
  P % within τ              performance profile: of all problems, solved or not, this part was solved in at most τ times the best time
                            of any solver of this run; τ = {factors}. At τ = 1: how often it was the
                            fastest; at the largest τ: how many it solves at all. With one solver every number is the part that it solved"
    )
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    arguments.tolerance.check()?;
    if !(0.0..=LONGEST_SECONDS).contains(&arguments.repeat) {
        return Err(Error::invalid(
            "--repeat",
            format!("is {}", arguments.repeat),
            format!("give a time from 0 to {LONGEST_SECONDS:e} seconds"),
        ));
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
    let files = several::files(&arguments.problems)?;
    if let Some([one, other]) = several::twice(&files) {
        let problem = format!("has {} and {}, which the result could not tell apart", one.display(), other.display());
        return Err(Error::invalid("PROBLEMS", problem, "rename one of them, or run the command once for each"));
    }
    arguments.answers.as_deref().map_or(Ok(()), |folder| several::make_folder("--answers", folder))?;
    let bar = progress::parts(files.len() * solvers.len(), "solves");
    let mut all = progress::shown(&bar, || timed(&files, &solvers, arguments, &bar))?;
    if all.runs.is_empty() && all.failed.len() == 1 {
        // nothing else is lost with it
        return Err(all.failed.remove(0).error);
    }
    let refused = all.failed.iter().map(Failed::told).collect();
    let bench = Bench::new(arguments.tolerance.accepted(), all.runs).with_refused(refused);
    print(&match arguments.common.format {
        Format::Text => table(bench.text()),
        Format::Json => pretty(&bench)?,
    })?;
    let refused = bench.refused_problems();
    if refused > 0 {
        several::tell_refused(refused, files.len());
        return Ok(Answer::BadInput);
    }
    Ok(bench.all_solved().into())
}

/// What was measured, and what could not be.
#[derive(Default)]
struct Timed {
    runs: Vec<Run>,
    failed: Vec<Failed>,
}

/// A file that could not be read, or a solver that could not be asked about it.
struct Failed {
    problem: String,
    solver: Option<String>,
    error: Error,
}

impl Failed {
    fn told(&self) -> Refused {
        Refused { problem: self.problem.clone(), solver: self.solver.clone(), reason: several::reason(&self.error) }
    }
}

/// Every solver on every problem.
fn timed(files: &[PathBuf], solvers: &[Box<dyn ContactSolver>], arguments: &Arguments, bar: &ProgressBar) -> Result<Timed> {
    let mut all = Timed::default();
    for file in files {
        let (name, first) = (several::name(file), all.runs.len());
        let problem = match Posed::read(file).and_then(|posed| arguments.law.pose(posed)) {
            Ok(problem) => problem,
            Err(error) => {
                all.failed.push(Failed { problem: name, solver: None, error });
                bar.inc(solvers.len() as u64);
                continue;
            }
        };
        for solver in solvers {
            bar.set_message(format!(", {name}, {}", solver.name()));
            match measured(&problem, &name, solver.as_ref(), arguments) {
                Ok((run, solution)) => all.runs.push(kept(run, solution, &problem, arguments)?),
                Err(error) => {
                    let error = error.in_file(file);
                    all.failed.push(Failed { problem: name.clone(), solver: Some(solver.name().into()), error })
                }
            }
            bar.inc(1);
        }
        // where nobody found a solution there may be none: then that is the right answer
        let own = &mut all.runs[first..];
        if !own.is_empty() && !own.iter().any(|run| run.solved) && posed::refuted(&problem).is_some() {
            own.iter_mut().for_each(|run| run.without_solution = true);
        }
    }
    Ok(all)
}

/// One solver on one problem, with the answer where there is one.
fn measured(problem: &Posed, name: &str, solver: &dyn ContactSolver, arguments: &Arguments) -> Result<(Run, Option<Solution>)> {
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
        Ok(mut solution) => {
            judge(problem, &mut solution, arguments, &mut run)?;
            Ok((run, Some(solution)))
        }
        Err(error @ Error::Solver { .. }) => {
            run.failure = Some(posed::with_cure(error, problem).to_string());
            Ok((run, None))
        }
        Err(error) => Err(error),
    }
}

/// What the certificate says of the answer.
fn judge(problem: &Posed, solution: &mut Solution, arguments: &Arguments, run: &mut Run) -> Result<()> {
    let start = Instant::now();
    let judged = posed::judge_own(problem, solution, arguments.tolerance.accepted())?;
    run.certifying = Some(start.elapsed().as_secs_f64());
    run.iterations = solution.iterations;
    run.relative = Some(judged.relative());
    run.natural_map_one = posed::natural_map(problem, solution);
    run.solved = judged.is_solution(arguments.tolerance.accepted());
    Ok(())
}

/// The run with its answer in the folder of answers, where there is such a folder.
fn kept(mut run: Run, solution: Option<Solution>, problem: &Posed, arguments: &Arguments) -> Result<Run> {
    if let (Some(folder), Some(mut solution)) = (&arguments.answers, solution) {
        solution.reproducible = (!run.reproducible).then_some(false);
        let name = format!("{}.{}.json", run.problem, run.solver);
        write_atomically(&folder.join(&name), solution.to_json(Some(posed::name(problem)), None).as_bytes())?;
        run.answer = Some(name);
    }
    Ok(run)
}
