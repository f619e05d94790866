//! What `moreau bench` measured: times of solvers on problems, each beside the certified residual of its answer.
//!
//! ```text
//!     shifted geometric mean   exp(mean ln(t + s)) − s                                                  [s]
//!     performance profile      part of the problems that a solver certifies in at most τ times the best time
//! ```
//! A problem that a solver does not solve counts with its time in no mean and with τ = ∞ in the profile.

use super::profile::{Cost, within};
use super::quantity::short;
use crate::tolerance::bench::{MILLISECOND, SHIFT};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeSet;
use std::fmt::Write;

/// The factors τ of the profile.
pub const FACTORS: [f64; 7] = [1.0, 1.5, 2.0, 5.0, 10.0, 100.0, 1000.0];

/// All that was measured.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Bench {
    /// The largest relative residual that counts as solved.
    pub tolerance: f64,
    /// One line per problem and solver.
    pub runs: Vec<Run>,
    /// One line per solver.
    pub solvers: Vec<Summary>,
    /// The problems that could not be read, and those that a solver could not be asked about; absent where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub refused: Vec<Refused>,
}

/// A problem that could not be measured; it counts for no solver.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Refused {
    /// The file.
    pub problem: String,
    /// The solver that was asked; absent where the problem itself is refused.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solver: Option<String>,
    /// What is wrong with it.
    pub reason: String,
}

/// One solver on one problem.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Run {
    /// The file.
    pub problem: String,
    /// Number of contacts.
    pub contacts: usize,
    /// The solver that was asked.
    pub solver: String,
    /// The least time of an answer, without reading and certifying \[s\].
    pub seconds: f64,
    /// How often it was measured.
    pub repeats: usize,
    /// Whether the same command finds the answer again: false if a time limit ended a solve.
    pub reproducible: bool,
    /// Iterations, sweeps or pivots.
    pub iterations: usize,
    /// The time of the certificate of the answer \[s\]; absent where there is no answer.
    pub certifying: Option<f64>,
    /// The largest residual of a contact relative to its scale; absent where there is no answer.
    pub relative: Option<f64>,
    /// ‖r − P_K(r − ŷ)‖/‖q‖ with ρ = 1 kg, as other collections compare; absent for polyhedral laws and without an answer.
    pub natural_map_one: Option<f64>,
    /// Whether the certificate accepts the answer.
    pub solved: bool,
    /// Whether it is proved that the problem has no solution, which is asked where no solver of the run found one.
    pub without_solution: bool,
    /// The file of the answer in the folder of answers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub answer: Option<String>,
    /// Why there is no answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failure: Option<String>,
}

/// One solver on all problems.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Summary {
    /// Its name.
    pub solver: String,
    /// How many problems it solved.
    pub solved: usize,
    /// Of how many: problems that are proved to have no solution do not count.
    pub problems: usize,
    /// How many were proved to have no solution.
    pub without_solution: usize,
    /// The shifted geometric mean over those it solved \[s\]; absent if none.
    pub mean_seconds: Option<f64>,
    /// The part of the problems solved within τ times the best time, τ as in `factors`.
    pub profile: Vec<f64>,
    /// τ.
    pub factors: Vec<f64>,
}

impl Bench {
    /// The runs with what follows from them.
    pub fn new(tolerance: f64, runs: Vec<Run>) -> Self {
        let mut names: Vec<&str> = Vec::new();
        for run in &runs {
            if !names.contains(&run.solver.as_str()) {
                names.push(&run.solver);
            }
        }
        let solvers = names.iter().map(|name| summary(name, &runs)).collect();
        Bench { tolerance, runs, solvers, refused: Vec::new() }
    }

    /// The same with what could not be measured.
    pub fn with_refused(self, refused: Vec<Refused>) -> Self {
        Bench { refused, ..self }
    }

    /// How many problems could not be measured with every solver.
    pub fn refused_problems(&self) -> usize {
        self.refused.iter().map(|one| one.problem.as_str()).collect::<BTreeSet<_>>().len()
    }

    /// Whether every problem was solved by some solver, or has no solution.
    pub fn all_solved(&self) -> bool {
        let is_answered = |run: &Run| run.solved || run.without_solution;
        self.runs.iter().all(|run| self.runs.iter().any(|other| other.problem == run.problem && is_answered(other)))
    }

    /// For reading.
    pub fn text(&self) -> String {
        let problems = self.runs.iter().map(|run| &run.problem).chain(self.refused.iter().map(|one| &one.problem));
        let width = problems.map(|problem| problem.chars().count()).max().unwrap_or(0).max("problem".len());
        let heads = ["contacts", "solver", "time", "residual", "ρ = 1", "iterations"];
        let mut text = format!(
            "{:width$} {:>8} {:18} {:>11} {:>10} {:>10} {:>10}\n",
            "problem", heads[0], heads[1], heads[2], heads[3], heads[4], heads[5]
        );
        for run in &self.runs {
            let end = match (&run.failure, run.relative) {
                (Some(failure), _) => failure.clone(),
                (None, relative) => {
                    let [residual, map] = [relative, run.natural_map_one].map(|e| e.map_or("-".into(), short));
                    format!(
                        "{residual:>10} {map:>10} {:>10}{}",
                        run.iterations,
                        match (run.solved || run.without_solution, run.reproducible) {
                            (_, false) => "  ended by the time limit",
                            (true, true) => "",
                            (false, true) => "  not solved",
                        }
                    )
                }
            };
            let end = if run.without_solution { format!("{end}  no solution, as is proved") } else { end };
            let (problem, contacts, solver) = (&run.problem, run.contacts, &run.solver);
            let _ = writeln!(text, "{problem:width$} {contacts:>8} {solver:18} {:>11} {end}", time(run.seconds));
        }
        for Refused { problem, solver, reason } in &self.refused {
            let _ = writeln!(text, "{problem:width$} {:>8} {:18} {:>11} {reason}", "-", solver.as_deref().unwrap_or("-"), "-");
        }
        for one in &self.solvers {
            let mean = one.mean_seconds.map_or("no answer".into(), |mean| format!("shifted geometric mean {}", time(mean)));
            let within: Vec<String> =
                one.factors.iter().zip(&one.profile).map(|(factor, part)| format!("{:.0} % within {factor}", 100.0 * part)).collect();
            let none = match one.without_solution {
                0 => String::new(),
                count => format!(", {count} without solution"),
            };
            let (solver, solved, problems) = (&one.solver, one.solved, one.problems);
            let _ = writeln!(text, "{solver}: {solved} of {problems} solved{none}, {mean}; of the best time {}", within.join(", "));
        }
        text
    }
}

fn summary(name: &str, runs: &[Run]) -> Summary {
    let (none, own): (Vec<&Run>, Vec<&Run>) = runs.iter().filter(|run| run.solver == name).partition(|run| run.without_solution);
    let best =
        |problem: &str| runs.iter().filter(|run| run.problem == problem && run.solved).map(|run| run.seconds).fold(f64::INFINITY, f64::min);
    let solved: Vec<&&Run> = own.iter().filter(|run| run.solved).collect();
    let logarithms: f64 = solved.iter().map(|run| (run.seconds + SHIFT).ln()).sum();
    let seconds = |run: &&Run| Cost { own: if run.solved { run.seconds } else { f64::INFINITY }, least: best(&run.problem) };
    let costs: Vec<Cost> = own.iter().map(seconds).collect();
    Summary {
        solver: name.into(),
        solved: solved.len(),
        problems: own.len(),
        without_solution: none.len(),
        mean_seconds: (!solved.is_empty()).then(|| (logarithms / solved.len() as f64).exp() - SHIFT),
        profile: FACTORS.iter().map(|factor| within(*factor, &costs)).collect(),
        factors: FACTORS.to_vec(),
    }
}

fn time(seconds: f64) -> String {
    match seconds {
        s if s < MILLISECOND => format!("{:.2} µs", s * 1e6),
        s if s < 1.0 => format!("{:.2} ms", s * 1e3),
        s => format!("{s:.2} s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(problem: &str, solver: &str, seconds: f64, solved: bool) -> Run {
        let (problem, solver) = (problem.into(), solver.into());
        Run {
            problem,
            contacts: 1,
            solver,
            seconds,
            repeats: 1,
            reproducible: true,
            iterations: 1,
            certifying: Some(0.0),
            relative: Some(0.0),
            natural_map_one: None,
            solved,
            without_solution: false,
            answer: None,
            failure: None,
        }
    }

    #[test]
    fn means_and_profiles_count_only_what_is_solved() {
        let runs = vec![run("a", "x", 1.0, true), run("a", "y", 1.5, true), run("b", "x", 1.0, false), run("b", "y", 4.0, true)];
        let bench = Bench::new(1e-8, runs);
        let [x, y] = &bench.solvers[..] else { panic!("two solvers") };
        assert_eq!((x.solved, x.problems, y.solved), (1, 2, 2));
        assert!((x.mean_seconds.unwrap() - 1.0).abs() < 1e-12);
        assert!((y.mean_seconds.unwrap() - ((1.5 + SHIFT) * (4.0 + SHIFT)).sqrt() + SHIFT).abs() < 1e-12);
        assert_eq!((x.profile[0], x.profile[6]), (0.5, 0.5));
        assert_eq!((y.profile[0], y.profile[1]), (0.5, 1.0), "the best on b, one and a half times the best on a");
        assert!(bench.all_solved());
    }

    #[test]
    fn a_problem_without_solution_is_answered_by_no_solution_and_counts_for_nobody() {
        let none = Run { without_solution: true, ..run("b", "x", 1.0, false) };
        let bench = Bench::new(1e-8, vec![run("a", "x", 2e-6, true), none]);
        assert!(bench.all_solved());
        assert_eq!((bench.solvers[0].solved, bench.solvers[0].problems, bench.solvers[0].profile[0]), (1, 1, 1.0));
        let text = bench.text();
        assert!(text.contains("no solution, as is proved") && !text.contains("not solved"), "{text}");
        assert!(text.contains("1 of 1 solved, 1 without solution"), "{text}");
    }

    #[test]
    fn a_problem_that_nobody_solves_is_told() {
        let bench = Bench::new(1e-8, vec![run("a", "x", 2e-6, true), run("b", "x", 1.0, false)]);
        assert!(!bench.all_solved());
        let text = bench.text();
        assert!(text.contains("not solved") && text.contains("2.00 µs") && text.contains("1 of 2 solved"), "{text}");
    }
}
