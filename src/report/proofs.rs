//! What was proved about all solutions of a problem: how many there are, or that there is none.

use super::all_solutions::{All, End, Enumerated, Several, end_lines, ends, named, told};
use super::solutions_by_parts::enumerated;
use crate::Result;
use crate::certificate::infeasible::{Infeasible, infeasible};
use crate::certificate::jointed_proof::{infeasible_jointed, uniqueness_jointed};
use crate::certificate::patterns::{Solutions, solutions};
use crate::certificate::segment::segment;
use crate::certificate::separate::{Separate, separate};
use crate::certificate::spatial::{Velocities, velocities};
use crate::certificate::uniqueness::uniqueness;
use crate::number::{counted, significant};
use crate::problem::{ContactProblem, JointedProblem, Solution};
use crate::scalar::{Rational, Scalar};
use crate::tolerance::joints::AGREES;
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
    /// Two ends of a continuum of velocities; every mean of their impulses is a solution.
    #[serde(skip_serializing_if = "Option::is_none")]
    continuum: Option<[End; 2]>,
    /// Where further velocities may be, although all directions of slip in space were tried.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    undecided: Vec<String>,
    /// A witness that there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    infeasible: Option<Refuted>,
}

/// p in fractions, and p·(u_free + shift).
#[derive(Serialize, JsonSchema)]
struct Refuted {
    /// p, a fraction per row.
    witness: Vec<String>,
    /// p·(u_free + shift), a negative fraction.
    product: String,
    /// Its size relative to the sum of its terms without their signs, rounded.
    relative: f64,
    /// Whether the problem may contradict itself by this rounding of its data, and still be solved to it: joints that repeat each other.
    #[serde(skip)]
    by_rounding: bool,
    /// Of which W, in words, where mass and Jacobian are given and W is rounded.
    #[serde(skip_serializing_if = "str::is_empty")]
    of_which: &'static str,
}

impl Proofs {
    /// Proves what can be proved; a witness against any solution is searched only where none is proved to exist, and other solutions
    /// among these answers only where neither uniqueness nor all solutions are known.
    ///
    /// # Errors
    /// As [`distinct`](crate::certificate::several::distinct).
    pub fn new(problem: &ContactProblem, exists: bool, answers: impl FnOnce() -> Vec<Solution>) -> Result<Self> {
        let mut known = enumerated(problem).unless_contradicted(exists);
        let unique = known.unique.take().unwrap_or_else(|| told(uniqueness(problem)));
        let (unique, reason) = known.or_counted(unique);
        let infeasible = if exists { None } else { infeasible(problem).map(|found| Refuted::new(found, "")) };
        if unique == "unknown" && known.is_open() && infeasible.is_none() {
            let met: Vec<Solution> = std::mem::take(&mut known.met).into_iter().chain(answers()).collect();
            known.continuum = segment(problem, &met).ok().flatten().map(ends);
            known.several = Several::among(problem, &met)?;
        } else {
            known.undecided.clear();
        }
        let Enumerated { all, several, continuum, undecided, .. } = known;
        Ok(Proofs { unique, reason, all, several, continuum, undecided, infeasible })
    }

    /// The same of a problem with joints, whose solutions are not counted.
    ///
    /// # Errors
    /// [`Error::Invalid`](crate::Error::Invalid) if a proof takes more memory than is allowed.
    pub fn of_jointed(problem: &JointedProblem, exists: bool) -> Result<Self> {
        let (unique, reason) = told(uniqueness_jointed(problem)?);
        let found = if exists { None } else { infeasible_jointed(problem)? };
        let infeasible = found.map(|found| Refuted { by_rounding: found.relative <= AGREES, ..Refuted::new(found, STORED) });
        Ok(Proofs { unique, reason, all: None, several: None, continuum: None, undecided: Vec::new(), infeasible })
    }

    /// Whether it is proved that there is no solution, and not one to rounding either.
    pub fn denies(&self) -> bool {
        self.infeasible.as_ref().is_some_and(|refuted| !refuted.by_rounding) || self.all.as_ref().is_some_and(|all| all.velocities == 0)
    }

    /// For reading, line by line.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = match self.unique {
            "solution" => vec![format!("proved: at most one solution: {}", self.reason)],
            "velocity" => vec![format!("proved: all solutions have the same velocities: {}", self.reason)],
            // how many there are is told below
            _ if self.all.is_some() || self.several.is_some() || self.continuum.is_some() => Vec::new(),
            _ => vec![format!("not proved that the velocities are unique: {}", self.reason)],
        };
        lines.extend(self.all.as_ref().map(All::line));
        lines.extend(self.several.as_ref().map(Several::line));
        if let Some(ends) = &self.continuum {
            if self.all.is_none() {
                lines.push("proved in fractions: the velocities of the solutions are a continuum".into());
            }
            lines.extend(end_lines(ends));
        }
        if let Some(first) = self.undecided.first() {
            lines.push(format!("not proved that these are all velocities: {first} ({})", counted(self.undecided.len(), "pattern")));
        }
        if let Some(refuted) = &self.infeasible {
            lines.push(format!(
                "proved in fractions{}: there is no solution; impulses p with −Wᵀp in K* and p·(u_free + shift) = {}",
                refuted.of_which, refuted.product
            ));
            if refuted.by_rounding {
                lines.push(format!("  but it is {} of its terms: the joints agree up to rounding", significant(refuted.relative)));
            }
        }
        lines
    }
}

/// That a problem has no solution.
pub struct NoSolution {
    /// In a line.
    pub text: String,
    /// By how much the witness contradicts the data, relative to its terms; nothing where there is no witness.
    pub relative: Option<f64>,
}

impl NoSolution {
    /// Whether the data may contradict themselves by their rounding alone, as those of a W that was formed of fewer velocities than it has
    /// rows: a witness says how much, other proofs do not.
    pub fn is_by_rounding(&self) -> bool {
        self.relative.is_none_or(|relative| relative <= AGREES)
    }
}

/// That there is no solution, by a witness, or by all patterns of few contacts; nothing where neither is found.
pub fn no_solution(problem: &ContactProblem) -> Option<NoSolution> {
    infeasible(problem).map(|found| in_a_line(&found, "")).or_else(|| none_of_the_patterns(problem))
}

/// That all patterns of few contacts were tried and none is a solution; nothing where one is, or there are too many. Of contacts that fall
/// into parts which share nothing it is enough that one part has none.
fn none_of_the_patterns(problem: &ContactProblem) -> Option<NoSolution> {
    let parts = separate(problem).unwrap_or_default();
    if parts.is_empty() {
        return none_of_them(problem, "its contacts");
    }
    let none = |part: &Separate| none_of_them(&part.problem, &named(&part.contacts));
    parts.iter().find_map(none)
}

/// The same of contacts that are all together.
fn none_of_them(problem: &ContactProblem, which: &str) -> Option<NoSolution> {
    let in_plane = |all: Solutions| (all.found.is_empty() && all.continuum.is_none()).then_some(all.patterns);
    let in_space = |all: Velocities| (all.exactly() == Some(0)).then_some(all.patterns);
    let patterns = match solutions(problem) {
        Ok(all) => in_plane(all),
        Err(_) => velocities(problem).ok().and_then(in_space),
    }?;
    let patterns = counted(patterns, "pattern");
    let text = format!("proved in fractions: the problem has no solution; all {patterns} of what {which} may do were tried\n");
    Some(NoSolution { text, relative: None })
}

/// The same of a problem with joints, by a witness.
pub fn no_solution_jointed(problem: &JointedProblem) -> Option<NoSolution> {
    infeasible_jointed(problem).ok().flatten().map(|found| in_a_line(&found, STORED))
}

fn in_a_line(found: &Infeasible, of_which: &str) -> NoSolution {
    let product = significant(Scalar::to_f64(&found.product));
    let of_which = if found.of_mechanism { MECHANISM } else { of_which };
    let witness = format!("impulses p with −Wᵀp in K* have p·(u_free + shift) = {product} J");
    let text = format!("proved in fractions{of_which}: the problem has no solution; {witness}\n");
    NoSolution { text, relative: Some(found.relative) }
}

impl Refuted {
    fn new(found: Infeasible, of_which: &'static str) -> Self {
        let witness = found.witness.iter().map(Rational::to_string).collect();
        let of_which = if found.of_mechanism { MECHANISM } else { of_which };
        Refuted { witness, product: found.product.to_string(), relative: found.relative, by_rounding: false, of_which }
    }
}

/// Where Hᵀp = 0.
const MECHANISM: &str = " of W = H M̂⁻¹ Hᵀ, not rounded";

/// With joints W alone is kept.
const STORED: &str = " of W as it is stored";

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector, dvector};

    fn posed(w: &[f64], free: &[f64], rows: usize, mu: f64) -> ContactProblem {
        let made = ContactProblem::new(DMatrix::from_row_slice(free.len(), free.len(), w), DVector::from_row_slice(free));
        made.rows_per_contact(rows).friction(vec![mu; free.len() / rows]).build().expect("sizes fit")
    }

    fn told(problem: &ContactProblem, exists: bool, answers: Vec<Solution>) -> (String, bool) {
        let proofs = Proofs::new(problem, exists, || answers).expect("finite numbers");
        (proofs.lines().join("\n"), proofs.denies())
    }

    #[test]
    fn a_report_tells_what_is_proved_of_all_solutions_and_nothing_else() {
        let (one, denied) = told(&posed(&[1.0, 0.0, 0.0, 1.0], &[-1.0, 2.0], 2, 0.5), true, Vec::new());
        assert!(one.starts_with("proved: at most one solution") && !one.contains("no solution") && !denied, "{one}");
        let (three, denied) = told(&posed(&[1.0, 2.0, 2.0, 5.0], &[1.0, 4.0], 2, 1.0), true, Vec::new());
        assert!(three.contains("exactly 3 velocities") && !three.contains("same velocities") && !denied, "{three}");
        let (none, denied) = told(&posed(&[-1.0, 0.0, 0.0, 1.0], &[-1.0, 0.0], 2, 0.5), false, Vec::new());
        assert!(none.contains("no solution") && denied, "{none}");
    }

    #[test]
    fn a_continuum_in_space_is_told_with_its_ends_and_one_where_slip_turns_is_not() {
        let rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let h = DMatrix::from_row_iterator(6, 3, rows.into_iter().flatten());
        for (free, is_told) in [([3.0, 4.0], true), ([1.0, 2.0], false)] {
            let free = dvector![0.0, free[0], free[1], 0.0, free[0], free[1]];
            let walls = posed((&h * h.transpose()).as_slice(), free.as_slice(), 3, 0.5);
            let (lines, denied) = told(&walls, true, vec![Solution::new("", DVector::zeros(6), free, 0)]);
            assert_eq!((lines.contains("continuum") && lines.contains("other end"), denied), (is_told, false), "{lines}");
        }
    }

    #[test]
    fn one_part_without_solution_is_enough_and_is_named() {
        // its impulse pulls it in: no pattern holds
        let w = DMatrix::from_diagonal(&DVector::from_fn(16, |i, _| if i == 6 { -1.0 } else { 1.0 }));
        let problem = ContactProblem::new(w, DVector::from_element(16, -1.0)).rows_per_contact(2).friction(vec![0.5; 8]).build().unwrap();
        let proofs = Proofs::new(&problem, false, Vec::new).unwrap();
        let told = proofs.lines().join("\n");
        assert!(proofs.denies() && told.contains("there is no solution of contact 3, which shares nothing"), "{told}");
        assert!(none_of_the_patterns(&problem).is_some_and(|none| none.text.contains("of what contact 3 may do")));
    }
}
