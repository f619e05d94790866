//! What was proved about all solutions of a problem: how many there are, or that there is none.

use crate::Result;
use crate::certificate::infeasible::{Infeasible, infeasible};
use crate::certificate::patterns::{Solutions, solutions};
use crate::certificate::several::{Distinct, distinct};
use crate::certificate::spatial::{Velocities, velocities};
use crate::certificate::uniqueness::{Uniqueness, uniqueness};
use crate::number::significant;
use crate::problem::{ContactProblem, Solution};
use crate::scalar::{Rational, Scalar};
use schemars::JsonSchema;
use serde::Serialize;

/// What is known about all solutions of one problem.
#[derive(Serialize, JsonSchema)]
pub struct Proofs {
    /// What is proved to be unique.
    #[schemars(extend("enum" = ["solution", "velocity", "unknown"]))]
    unique: &'static str,
    /// Why it is, or why it is not known.
    reason: String,
    /// All solutions, where all patterns were tried and decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    all: Option<All>,
    /// Solutions with different velocities, where not all are known.
    #[serde(skip_serializing_if = "Option::is_none")]
    several: Option<Several>,
    /// Where further velocities may be, although all directions of slip in space were tried.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    undecided: Vec<String>,
    /// A witness that there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    infeasible: Option<Refuted>,
}

/// All solutions of a problem in the plane, or of few contacts in space.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "AllSolutions")]
struct All {
    /// How many patterns of open, sticking and sliding contacts were tried: all there are.
    patterns: usize,
    /// Into how many pieces they were cut by directions of slip, in space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pieces: Option<usize>,
    /// How many velocities; at the vertices, if they are a continuum.
    velocities: usize,
    /// Whether they are a continuum.
    continuum: bool,
    /// u of each \[m/s\], rounded.
    found: Vec<Vec<f64>>,
}

/// Answers whose enclosures are disjoint.
#[derive(Serialize, JsonSchema)]
struct Several {
    /// How many velocities there are at least.
    at_least: usize,
    /// u of each answer \[m/s\].
    velocities: Vec<Vec<f64>>,
    /// The largest ‖u* − u‖ of a contact, of each \[m/s\].
    radii: Vec<f64>,
}

/// p in fractions, and p·(u_free + shift).
#[derive(Serialize, JsonSchema)]
struct Refuted {
    /// p, a fraction per row.
    witness: Vec<String>,
    /// p·(u_free + shift), a negative fraction.
    product: String,
    /// Of which W, in words, where mass and Jacobian are given and W is rounded.
    #[serde(skip_serializing_if = "str::is_empty")]
    of_which: &'static str,
}

impl Proofs {
    /// Proves what can be proved; a witness against any solution is searched only where none is proved to exist, and other solutions
    /// among these answers only where neither uniqueness nor all solutions are known.
    ///
    /// # Errors
    /// As [`distinct`].
    pub fn new(problem: &ContactProblem, exists: bool, answers: impl FnOnce() -> Vec<Solution>) -> Result<Self> {
        let (unique, reason) = match uniqueness(problem) {
            Uniqueness::Solution(reason) => ("solution", reason.into()),
            Uniqueness::Velocity(reason) => ("velocity", reason.into()),
            Uniqueness::Unknown(reason) => ("unknown", reason),
        };
        let infeasible = if exists { None } else { infeasible(problem).map(|found| Refuted::new(problem, found)) };
        let (all, met, undecided) = match (solutions(problem), velocities(problem)) {
            (Ok(all), _) => (Some(All::from(all)), Vec::new(), Vec::new()),
            (_, Ok(all)) if all.exactly().is_some() => (Some(All::from(all)), Vec::new(), Vec::new()),
            (_, Ok(all)) => (None, all.found, all.undecided),
            _ => (None, Vec::new(), Vec::new()),
        };
        let is_open = unique == "unknown" && all.is_none() && infeasible.is_none() && problem.law().directions().is_none();
        let answers = || met.into_iter().map(|(answer, _)| answer).chain(answers()).collect::<Vec<_>>();
        let several = if is_open { Several::among(problem, &answers())? } else { None };
        let undecided = if is_open { undecided.into_iter().map(|reason| reason.text).collect() } else { Vec::new() };
        Ok(Proofs { unique, reason, all, several, undecided, infeasible })
    }

    /// Whether it is proved that there is no solution.
    pub fn denies(&self) -> bool {
        self.infeasible.is_some() || self.all.as_ref().is_some_and(|all| all.velocities == 0)
    }

    /// For reading, line by line.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![match self.unique {
            "solution" => format!("proved: at most one solution: {}", self.reason),
            "velocity" => format!("proved: all solutions have the same velocities: {}", self.reason),
            _ => format!("not proved that the velocities are unique: {}", self.reason),
        }];
        if let Some(all) = &self.all {
            let count = match (all.velocities, all.continuum) {
                (0, _) => "there is no solution".into(),
                (_, true) => "the velocities of the solutions are a continuum".into(),
                (1, false) => "the solutions have exactly 1 velocity".into(),
                (count, false) => format!("the solutions have exactly {count} velocities"),
            };
            lines.push(match all.pieces {
                None => format!("proved in fractions: all {} patterns tried, {count}", all.patterns),
                Some(pieces) => format!("proved by intervals: all {} patterns tried in {pieces} pieces, {count}", all.patterns),
            });
        }
        if let Some(several) = &self.several {
            lines.push(format!(
                "proved by intervals: at least {} different velocities: so many answers have disjoint enclosures",
                several.at_least
            ));
        }
        if let Some(first) = self.undecided.first() {
            lines.push(format!("not proved that these are all velocities: {first} ({} patterns)", self.undecided.len()));
        }
        if let Some(refuted) = &self.infeasible {
            lines.push(format!(
                "proved in fractions{}: there is no solution; impulses p with −Wᵀp in K* and p·(u_free + shift) = {}",
                refuted.of_which, refuted.product
            ));
        }
        lines
    }
}

/// That there is no solution, in a line; nothing where no witness is found.
pub fn no_solution(problem: &ContactProblem) -> Option<String> {
    let found = infeasible(problem)?;
    let product = significant(Scalar::to_f64(&found.product));
    let of_which = of_which(problem);
    Some(format!(
        "proved in fractions{of_which}: the problem has no solution; impulses p with −Wᵀp in K* have p·(u_free + shift) = {product} J\n"
    ))
}

impl Several {
    fn among(problem: &ContactProblem, answers: &[Solution]) -> Result<Option<Self>> {
        let found = distinct(problem, answers)?;
        let velocity = |one: &Distinct| answers[one.answer].velocity.as_slice().to_vec();
        let radius = |one: &Distinct| one.radius.worst().map_or(0.0, |(_, radius)| radius);
        Ok((found.len() > 1).then(|| Several {
            at_least: found.len(),
            velocities: found.iter().map(velocity).collect(),
            radii: found.iter().map(radius).collect(),
        }))
    }
}

impl From<Solutions> for All {
    fn from(all: Solutions) -> Self {
        let rounded = |numbers: &[Rational]| numbers.iter().map(Scalar::to_f64).collect();
        All {
            patterns: all.patterns,
            pieces: None,
            velocities: all.found.len(),
            continuum: all.continuum.is_some(),
            found: all.found.iter().map(|one| rounded(one.velocity.as_slice())).collect(),
        }
    }
}

impl From<Velocities> for All {
    fn from(all: Velocities) -> Self {
        All {
            patterns: all.patterns,
            pieces: Some(all.pieces),
            velocities: all.found.len(),
            continuum: false,
            found: all.found.iter().map(|(answer, _)| answer.velocity.as_slice().to_vec()).collect(),
        }
    }
}

impl Refuted {
    fn new(problem: &ContactProblem, found: Infeasible) -> Self {
        let witness = found.witness.iter().map(Rational::to_string).collect();
        Refuted { witness, product: found.product.to_string(), of_which: of_which(problem) }
    }
}

/// Of which W it is proved, where there are two: W of mass and Jacobian is rounded before the witness is checked.
fn of_which(problem: &ContactProblem) -> &'static str {
    if problem.knows_rows() { " of W as it is rounded from mass and Jacobian" } else { "" }
}
