//! `solve` and `Solution`: impulses and velocities with their certificate.

use crate::arrays::to_vector;
use crate::away::{away, enter};
use crate::certificate::{Certificate, accepted};
use crate::errors::{IntoPython, invalid, rejected};
use crate::interrupt;
use crate::posing::{Arguments, pose};
use crate::problem::Problem;
use moreau::cli::posed;
use moreau::problem::{Posed, WarmStart};
use moreau::solvers::watch::{Interrupt, watched};
use moreau::solvers::{ALL, ContactSolver};
use moreau::tolerance::certificate::CERTIFY;
use moreau::tolerance::cli::ASKED_SHARE;
use moreau::{Error, files};
use nalgebra::DVector;
use numpy::PyArray1;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;

/// From so many rows on, work goes on beside Python; smaller problems are solved before a thread has begun.
const LONG: usize = 120;

/// Impulses and velocities with their certificate; true where the certificate accepts them.
#[pyclass(frozen, module = "moreau_contact")]
pub struct Solution {
    posed: Arc<Posed>,
    /// Impulses and velocities.
    pub solution: Arc<moreau::Solution>,
    certificate: Py<Certificate>,
}

/// Solves a contact problem and certifies the answer.
#[pyfunction]
#[pyo3(signature = (W, u_free = None, mu = None, *, law = None, directions = None, shift = None, solver = "auto", tolerance = None,
                    iterations = None, warm_start = None, accept_rejected = false))]
#[expect(non_snake_case, clippy::too_many_arguments, reason = "the names of the arguments in Python")]
pub fn solve(
    py: Python<'_>,
    W: &Bound<'_, PyAny>,
    u_free: Option<&Bound<'_, PyAny>>,
    mu: Option<&Bound<'_, PyAny>>,
    law: Option<&str>,
    directions: Option<usize>,
    shift: Option<&Bound<'_, PyAny>>,
    solver: &str,
    tolerance: Option<f64>,
    iterations: Option<usize>,
    warm_start: Option<&Bound<'_, PyAny>>,
    accept_rejected: bool,
) -> PyResult<Py<Solution>> {
    let _here = enter()?;
    let made;
    let problem = match (W.cast::<Problem>(), u_free) {
        (Ok(problem), None) if mu.is_none() && shift.is_none() && directions.is_none() && law.is_none() => problem.get(),
        (Ok(_), _) => {
            return Err(invalid(
                py,
                "problem",
                "has its own data and law",
                "give the problem alone; `with_law` poses it under another law",
            ));
        }
        (Err(_), Some(u_free)) => {
            made = pose(&Arguments { operator: W, u_free, mu, law: law.unwrap_or("coulomb"), directions, shift, name: "" })?;
            &made
        }
        (Err(_), None) if W.extract::<PathBuf>().is_ok() => {
            return Err(invalid(py, "W", "is the name of a file", "give Problem.read(file) alone"));
        }
        (Err(_), None) => return Err(invalid(py, "u_free", "is missing", "give W, u_free and mu, or a Problem alone")),
    };
    let accepts = accepted(py, tolerance)?;
    let asked = asked(solver, tolerance, iterations).python(py)?;
    let start = warm_start.map(|start| start_of(problem, start)).transpose()?;
    if start.is_some() && !asked.takes_start() {
        let given = format!("does nothing with `{solver}`, which has a start of its own");
        return Err(invalid(py, "warm_start", given, "leave it out, or ask `auto`, which takes one"));
    }
    let (posed, size) = (problem.posed.clone(), posed::constraints(&problem.posed));
    let found = if 3 * size < LONG {
        away(py, || proved(&posed, &*asked, start.as_ref(), accepts, accept_rejected, solver))?
    } else {
        let interrupt = Interrupt::default();
        let (posed, solver, stop) = (problem.posed.clone(), solver.to_string(), interrupt.clone());
        let work = move || watched(&interrupt, || proved(&posed, &*asked, start.as_ref(), accepts, accept_rejected, &solver)).0;
        interrupt::abandoned(py, work, || stop.now())?
    };
    let (solution, certificate) = found.python(py)?;
    let is_rejected = !certificate.accepts();
    let message = is_rejected.then(|| certificate.verdict());
    let solution = Py::new(py, Solution { posed: problem.posed.clone(), solution, certificate: Py::new(py, certificate)? })?;
    match message {
        Some(message) if !accept_rejected => Err(rejected(py, &message, solver, solution.into_any())),
        _ => Ok(solution),
    }
}

type Answered = (Arc<moreau::Solution>, Certificate);

/// The answer; a proof that there is no solution is an error, unless what the solver gives is wanted all the same.
fn proved(
    posed: &Arc<Posed>,
    solver: &dyn ContactSolver,
    start: Option<&DVector<f64>>,
    tolerance: f64,
    accept_rejected: bool,
    name: &str,
) -> moreau::Result<Answered> {
    let (solution, certificate) = answer(posed, solver, start, tolerance)?;
    match certificate.no_solution() {
        Some(proof) if !accept_rejected => Err(Error::solver(name, moreau::error::Failure::Infeasible, proof.trim_end())),
        _ => Ok((solution, certificate)),
    }
}

fn answer(posed: &Arc<Posed>, solver: &dyn ContactSolver, start: Option<&DVector<f64>>, tolerance: f64) -> moreau::Result<Answered> {
    posed::require_memory(posed)?;
    let solution = Arc::new(posed::solve(posed, solver, start).map_err(|error| refuted(error, posed))?);
    let certificate = Certificate::of(posed.clone(), solution.clone(), tolerance)?;
    let certificate = if certificate.accepts() { certificate } else { certificate.with_refutation() };
    Ok((solution, certificate))
}

/// A solver's failure, with the proof that there is no solution where there is one.
fn refuted(error: Error, posed: &Posed) -> Error {
    match (error, posed::refuted(posed)) {
        (Error::Solver { solver, reason, .. }, Some(proof)) => {
            Error::solver(solver, moreau::error::Failure::Infeasible, format!("{reason}; {}", proof.trim_end()))
        }
        (error, _) => error,
    }
}

/// The solver of this name, with the limit of iterations and the tolerance that were asked for.
fn asked(name: &str, tolerance: Option<f64>, iterations: Option<usize>) -> moreau::Result<Box<dyn ContactSolver>> {
    if !ALL.names().any(|known| known == name) {
        let cure = format!("use one of {}", ALL.names().collect::<Vec<_>>().join(", "));
        return Err(Error::invalid("solver", format!("`{name}` is unknown"), cure));
    }
    let solver = ALL.with_iterations(name, iterations)?;
    let exact = tolerance.and_then(|tolerance| solver.with_tolerance(ASKED_SHARE * tolerance));
    Ok(exact.unwrap_or(solver))
}

fn start_of(problem: &Problem, start: &Bound<'_, PyAny>) -> PyResult<DVector<f64>> {
    match start.cast::<Solution>() {
        Ok(solution) => {
            let Solution { solution, posed, .. } = solution.get();
            let mut answer = moreau::Solution::clone(solution);
            answer.keys = answer.keys.or_else(|| posed::keys(posed));
            WarmStart::of_solution(&answer, &problem.posed).map(|start| start.impulse).map_err(|error| {
                invalid(start.py(), "warm_start", format!("answers another problem: {error}"), "give impulses of this problem")
            })
        }
        Err(_) => problem.fitting("warm_start", start),
    }
}

/// How long it takes to pose, solve and certify these contacts so many times [s], without Python: what a call is compared with.
#[pyfunction]
pub fn seconds_of(py: Python<'_>, problem: &Bound<'_, Problem>, times: usize) -> PyResult<f64> {
    let posed = problem.get().posed.clone();
    away(py, || {
        let Posed::Contacts(problem) = &*posed else { return Err(Error::Unsupported("has joints".into())) };
        let solver = asked("auto", None, None)?;
        let begin = std::time::Instant::now();
        for _ in 0..times {
            let (dense, free) = (problem.dense().clone(), problem.free_velocity().clone());
            let again = moreau::ContactProblem::new(dense, free).friction(problem.friction().to_vec()).build()?;
            let (_, certificate) = answer(&Arc::new(Posed::Contacts(Box::new(again))), &*solver, None, CERTIFY)?;
            std::hint::black_box(certificate.accepts());
        }
        Ok(begin.elapsed().as_secs_f64())
    })?
    .python(py)
}

/// The names of the solvers, `auto` first.
#[pyfunction]
pub fn solvers() -> Vec<&'static str> {
    ALL.names().collect()
}

#[pymethods]
impl Solution {
    fn __bool__(&self) -> bool {
        self.certificate.get().accepts()
    }

    /// Its certificate.
    #[getter]
    fn certificate(&self, py: Python<'_>) -> Py<Certificate> {
        self.certificate.clone_ref(py)
    }

    /// r [N·s], one per row.
    #[getter]
    fn impulse<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        to_vector(py, self.solution.impulse.as_slice())
    }

    /// u = W r + u_free [m/s], one per row.
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        to_vector(py, self.solution.velocity.as_slice())
    }

    /// β of Stewart–Trinkle or edge impulses [N·s], directions per contact; None under other laws.
    #[getter]
    fn beta<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.solution.beta.as_ref().map(|beta| to_vector(py, beta.as_slice()))
    }

    /// σ, the slip speeds of Stewart–Trinkle [m/s], one per contact; None under other laws.
    #[getter]
    fn sigma<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.solution.sigma.as_ref().map(|sigma| to_vector(py, sigma.as_slice()))
    }

    /// The name of the solver.
    #[getter]
    fn solver(&self) -> &str {
        &self.solution.solver
    }

    /// Iterations or pivots.
    #[getter]
    fn iterations(&self) -> usize {
        self.solution.iterations
    }

    /// The problem that it answers.
    #[getter]
    fn problem(&self) -> Problem {
        Problem { posed: self.posed.clone() }
    }

    /// The text of a solution/1.
    fn to_json(&self) -> String {
        let mut solution = (*self.solution).clone();
        solution.keys = posed::keys(&self.posed);
        solution.to_json(Some(posed::name(&self.posed)), None)
    }

    /// Writes a solution/1, whole or not at all.
    fn write(&self, py: Python<'_>, file: PathBuf) -> PyResult<()> {
        away(py, || files::write_atomically(&file, self.to_json().as_bytes()))?.python(py)
    }

    /// The answer of a text solution/1, certified.
    #[staticmethod]
    #[pyo3(signature = (text, problem, *, tolerance = None))]
    fn from_json(py: Python<'_>, text: &str, problem: &Bound<'_, Problem>, tolerance: Option<f64>) -> PyResult<Self> {
        let (posed, tolerance) = (problem.get().posed.clone(), accepted(py, tolerance)?);
        let solution = Arc::new(moreau::Solution::from_json(text).python(py)?);
        let certificate = Certificate::of(posed.clone(), solution.clone(), tolerance).python(py)?;
        Ok(Solution { posed, solution, certificate: Py::new(py, certificate)? })
    }

    /// A copy, and what is sent to another process, is read from its solution/1, and certified again.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String, Problem, f64))> {
        let again = py.import("moreau_contact._errors")?.getattr("solution_again")?;
        Ok((again, (self.to_json(), self.problem(), self.certificate.get().tolerance())))
    }

    /// Reads a solution/1 that answers a problem, and certifies it.
    #[staticmethod]
    #[pyo3(signature = (file, problem, *, tolerance = None))]
    fn read(py: Python<'_>, file: PathBuf, problem: &Bound<'_, Problem>, tolerance: Option<f64>) -> PyResult<Self> {
        let (posed, tolerance) = (problem.get().posed.clone(), accepted(py, tolerance)?);
        let found = away(py, || {
            let solution = Arc::new(moreau::Solution::read_posed(&file, &posed)?);
            let certificate = Certificate::of(posed.clone(), solution.clone(), tolerance)?;
            Ok((solution, certificate))
        });
        let (solution, certificate) = found?.python(py)?;
        Ok(Solution { posed, solution, certificate: Py::new(py, certificate)? })
    }

    fn __repr__(&self) -> String {
        let verdict = if self.certificate.get().accepts() { "certified" } else { "REJECTED" };
        let name = posed::name(&self.posed);
        format!("Solution({verdict}, {name:?}, contacts={}, solver={:?})", posed::constraints(&self.posed), self.solution.solver)
    }
}
