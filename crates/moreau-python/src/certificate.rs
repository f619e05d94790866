//! `certify` and `Certificate`: how good an answer is, contact by contact.

use crate::arrays::to_vector;
use crate::away::{away, enter};
use crate::errors::{IntoPython, invalid};
use crate::problem::Problem;
use crate::solution::Solution;
use moreau::certificate::joints::JointedResiduals;
use moreau::certificate::{ContactResiduals, Worst, by_contact};
use moreau::cli::posed;
use moreau::number::{significant, with_unit};
use moreau::problem::Posed;
use moreau::report::json::pretty;
use moreau::tolerance::certificate::CERTIFY;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::fmt::Write;
use std::sync::Arc;

/// Names and units of the residuals of a contact.
const RESIDUALS: [(&str, &str); 6] =
    [("primal", "N·s"), ("dual", "m/s"), ("complementarity", "J"), ("normal", "N·s"), ("tangential", "N·s"), ("velocity", "m/s")];

/// So many contacts are told in a text.
const TOLD: usize = 10;

/// The certificate of an answer, judged from the impulses alone; true where they are a solution.
#[pyclass(frozen, module = "moreau_contact")]
pub struct Certificate {
    posed: Arc<Posed>,
    solution: Arc<moreau::Solution>,
    residuals: JointedResiduals,
    tolerance: f64,
    no_solution: Option<String>,
}

/// Certifies an answer: impulses of any origin.
#[pyfunction]
#[pyo3(signature = (problem, impulse, *, tolerance = None, velocity = None))]
pub fn certify(
    problem: &Bound<'_, Problem>,
    impulse: &Bound<'_, PyAny>,
    tolerance: Option<f64>,
    velocity: Option<&Bound<'_, PyAny>>,
) -> PyResult<Certificate> {
    let (py, problem) = (impulse.py(), problem.get());
    let _here = enter()?;
    let solution = match impulse.cast::<Solution>() {
        Ok(_) if velocity.is_some() => {
            return Err(invalid(py, "velocity", "is given beside a Solution, which has its own", "give solution.impulse and velocity"));
        }
        Ok(solution) => solution.get().solution.clone(),
        Err(_) => {
            let impulse = problem.impulse(impulse)?;
            let velocity = match velocity {
                Some(velocity) => problem.fitting("velocity", velocity)?,
                None => problem.velocity_of(&impulse),
            };
            Arc::new(moreau::Solution::new("", impulse, velocity, 0))
        }
    };
    let tolerance = accepted(py, tolerance)?;
    let posed = problem.posed.clone();
    away(py, || Certificate::of(posed, solution, tolerance))?.python(py)
}

/// The tolerance that was asked for.
///
/// # Errors
/// `InvalidInput` for a number that is no tolerance.
pub fn accepted(py: Python<'_>, tolerance: Option<f64>) -> PyResult<f64> {
    match tolerance {
        None => Ok(CERTIFY),
        Some(tolerance) if tolerance > 0.0 && tolerance < 1.0 => Ok(tolerance),
        Some(other) => Err(invalid(
            py,
            "tolerance",
            format!("is {other}"),
            format!("give a number above 0 and below 1, such as {}", significant(CERTIFY)),
        )),
    }
}

impl Certificate {
    /// Judges an answer whose size fits.
    ///
    /// # Errors
    /// Those of the residuals.
    pub fn of(posed: Arc<Posed>, solution: Arc<moreau::Solution>, tolerance: f64) -> moreau::Result<Self> {
        let residuals = posed::judge(&posed, &solution)?;
        let no_solution = if residuals.is_solution(tolerance) { posed::denied(&posed, &residuals) } else { None };
        Ok(Certificate { posed, solution, residuals, tolerance, no_solution })
    }

    /// The same where it is proved that there is no solution, if that is so.
    pub fn with_refutation(self) -> Self {
        let no_solution = self.no_solution.or_else(|| posed::refuted(&self.posed));
        Certificate { no_solution, ..self }
    }

    /// What is accepted.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// The proof that there is no solution, where there is one.
    pub fn no_solution(&self) -> Option<&str> {
        self.no_solution.as_deref()
    }

    /// Whether the answer is a solution.
    pub fn accepts(&self) -> bool {
        self.residuals.is_solution(self.tolerance) && self.no_solution.is_none()
    }

    /// The verdict in words, with the contacts that are refused or the proof that there is no solution.
    pub fn verdict(&self) -> String {
        let text = self.report().text();
        let last = text.lines().last().unwrap_or_default();
        let told = self.no_solution.clone().unwrap_or_else(|| self.refused());
        format!("{last}\n{}", told.trim_end())
    }

    fn report(&self) -> moreau::report::certificate::Certificate<'_> {
        posed::certificate(&self.posed, &self.solution, self.residuals, self.tolerance).with_no_solution(self.no_solution.clone())
    }

    fn entries(&self) -> Vec<(&'static str, Worst, &'static str)> {
        let bilateral = self.residuals.bilateral.map(|worst| ("bilateral", worst, "m/s"));
        self.residuals.contacts.judged.entries().into_iter().chain(bilateral).collect()
    }

    fn each(&self) -> moreau::Result<Vec<ContactResiduals>> {
        match &*self.posed {
            Posed::Contacts(problem) => by_contact(problem, &self.solution),
            Posed::Jointed(_) => Err(moreau::Error::Unsupported("a problem with joints has no residuals contact by contact".into())),
        }
    }

    /// One line for each contact that is refused, of a few.
    fn refused(&self) -> String {
        let mut text = String::new();
        let contacts = self.each().unwrap_or_default();
        let refused: Vec<usize> = (0..contacts.len()).filter(|k| !contacts[*k].accepts(self.tolerance)).collect();
        for k in refused.iter().take(TOLD) {
            let wrong = RESIDUALS
                .iter()
                .zip(contacts[*k].parts)
                .filter(|(_, part)| !matches!(part.relative(), relative if relative <= self.tolerance));
            let told: Vec<_> = wrong
                .map(|((name, unit), part)| {
                    format!("{name} {} (relative {})", with_unit(&significant(part.value), unit), significant(part.relative()))
                })
                .collect();
            let _ = writeln!(text, "contact {k} is refused: {}", told.join(", "));
        }
        if refused.len() > TOLD {
            let _ = writeln!(text, "and {} more", refused.len() - TOLD);
        }
        text
    }
}

#[pymethods]
impl Certificate {
    /// The largest relative residual that is accepted.
    #[getter(tolerance)]
    fn limit(&self) -> f64 {
        self.tolerance
    }

    /// The proof that the problem has no solution, where there is one; then no answer is accepted.
    #[getter(no_solution)]
    fn refutation(&self) -> Option<&str> {
        self.no_solution()
    }

    fn __bool__(&self) -> bool {
        self.accepts()
    }

    /// Whether every residual is within its limit, and the problem is not proved to have no solution.
    #[getter]
    fn is_solution(&self) -> bool {
        self.accepts()
    }

    /// The largest residual, relative to the scale of its contact.
    #[getter]
    fn relative(&self) -> f64 {
        self.residuals.contacts.judged.relative()
    }

    /// Each residual where it is worst: its value, unit, relative size, limit and contact.
    #[getter]
    fn residuals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (name, worst, unit) in self.entries() {
            let one = PyDict::new(py);
            one.set_item("value", worst.part.value)?;
            one.set_item("unit", unit)?;
            one.set_item("relative", worst.part.relative())?;
            one.set_item("limit", worst.part.limit(self.tolerance))?;
            one.set_item("contact", worst.contact)?;
            all.set_item(name, one)?;
        }
        Ok(all)
    }

    /// Arrays of one entry per contact: `accepted`, each residual in its unit, and its relative size (`…_relative`).
    #[getter]
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let contacts = away(py, || self.each())?.python(py)?;
        let all = PyDict::new(py);
        let accepted: Vec<bool> = contacts.iter().map(|contact| contact.accepts(self.tolerance)).collect();
        all.set_item("accepted", numpy::PyArray1::from_vec(py, accepted))?;
        for (entry, (name, _)) in RESIDUALS.iter().enumerate() {
            let values: Vec<f64> = contacts.iter().map(|contact| contact.parts[entry].value).collect();
            let relative: Vec<f64> = contacts.iter().map(|contact| contact.parts[entry].relative()).collect();
            all.set_item(*name, to_vector(py, &values))?;
            all.set_item(format!("{name}_relative"), to_vector(py, &relative))?;
        }
        Ok(all)
    }

    /// The certificate as `moreau certify --format json` prints it.
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        pretty(&self.report()).python(py)
    }

    fn __str__(&self) -> String {
        format!("{}{}", self.refused(), self.report().text().trim_end())
    }

    fn __repr__(&self) -> String {
        let verdict = if self.accepts() { "a solution" } else { "NOT a solution" };
        format!("Certificate({verdict} to {}, largest relative residual {})", significant(self.tolerance), significant(self.relative()))
    }
}
