//! How good an answer to a contact problem is: residuals with units, and whether they are small enough.

use super::bound::above;
use super::lcp_proof::LcpProved;
use super::near::Near;
use super::quantity::{NO_NUMBER, short};
use super::text::{counted, quoted};
use crate::certificate::backward::{Backward, HeldAs};
use crate::certificate::forward::Forward;
use crate::certificate::impulse_set::ImpulseSet;
use crate::certificate::joints::JointedResiduals;
use crate::certificate::{Residuals, Worst};
use crate::number::{significant, with_unit};
use crate::problem::{ConstraintKind, ContactProblem, JointedProblem, Solution};
use crate::report::proofs::Proofs;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;

/// The certificate of one answer.
#[derive(Serialize, JsonSchema)]
pub struct Certificate<'a> {
    /// `solved` or `rejected`; of a solver's own answer that is rejected `stalled` or `limit`; `infeasible` where no solution is proved.
    #[schemars(extend("enum" = ["solved", "rejected", "stalled", "limit", "infeasible"]))]
    status: &'static str,
    /// The problem's name.
    problem: &'a str,
    /// Its law.
    law: &'static str,
    /// Number of contacts.
    contacts: usize,
    /// Limits and bilateral constraints, where there are joints.
    #[serde(flatten)]
    joints: Option<JointCounts>,
    /// Who proposed the answer; empty where nobody is named.
    solver: &'a str,
    /// Iterations or pivots; 0 where they are not known.
    iterations: usize,
    /// Every residual where it is worst, and norms.
    residuals: JointedResiduals,
    /// The largest relative residual that is accepted.
    tolerance: f64,
    /// Whether the answer is accepted.
    solution: bool,
    /// The nearest problem that impulses near these solve exactly, where it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    backward: Option<Proved>,
    /// Why there is no proved backward error.
    #[serde(skip_serializing_if = "Option::is_none")]
    backward_reason: Option<String>,
    /// What is proved of a linear complementarity problem, where it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    lcp: Option<LcpProved>,
    /// A solution of the problem itself near the answer, where it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    forward: Option<Near>,
    /// What is proved of all solutions, where it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    solutions: Option<Proofs>,
    /// Why the problem has no solution, where that is proved; it rejects the answer whatever its residuals are.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_solution: Option<String>,
    /// The norm that is too large for a number and rejects the answer, whatever its residuals are; absent where all are numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_number: Option<&'static str>,
    /// Whether the same command finds this answer again; absent where nobody knows how it was made.
    #[serde(skip_serializing_if = "Option::is_none")]
    reproducible: Option<bool>,
    /// Why the impulses are the solver's and not those of least norm, where these were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    not_least_norm: Option<String>,
    /// The largest relative residual of a contact, look by look of the solver.
    #[serde(skip_serializing_if = "Option::is_none")]
    history: Option<Vec<f64>>,
    /// Whether the text shows numbers without units, those of an LCP.
    #[serde(skip)]
    without_units: bool,
}

/// How many joints a problem has.
#[derive(Serialize, JsonSchema)]
struct JointCounts {
    /// Limits of one row.
    limits: usize,
    /// Bilateral constraints.
    bilateral: usize,
}

impl JointCounts {
    fn text(&self) -> String {
        format!(", limits: {}, bilateral constraints: {}", self.limits, self.bilateral)
    }
}

/// How the solver of an answer ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Ending {
    /// Whether it did as many iterations as it may, or took as long.
    pub exhausted: bool,
    /// Whether the same command finds this answer again.
    pub reproducible: bool,
    /// Why its impulses are not those of least norm, where these were asked for and not found.
    pub not_least_norm: Option<String>,
    /// The residuals of its looks, where they were asked for.
    pub history: Option<Vec<f64>>,
}

/// A proved backward error.
#[derive(Serialize, JsonSchema)]
struct Proved {
    /// The largest ‖δ_k‖ \[m/s\].
    velocity: f64,
    /// Its contact.
    contact: Option<usize>,
    /// The largest ‖r′ − r‖ \[N·s\].
    impulse: f64,
    /// Of every contact.
    states: Vec<&'static str>,
    /// ‖δ_k‖ of every contact \[m/s\].
    velocities: Vec<f64>,
}

impl<'a> Certificate<'a> {
    /// Holds the residuals against a tolerance relative to the scales of their units.
    pub fn new(problem: &'a ContactProblem, solution: &'a Solution, residuals: &Residuals, tolerance: f64) -> Self {
        let residuals = JointedResiduals { contacts: *residuals, bilateral: None };
        let named = (problem.name(), problem.law().name(), problem.contacts());
        Certificate::of(named, None, solution, residuals, tolerance)
    }

    /// The same of an answer with joints.
    pub fn of_jointed(problem: &'a JointedProblem, solution: &'a Solution, residuals: JointedResiduals, tolerance: f64) -> Self {
        let count = |is: fn(&ConstraintKind) -> bool| problem.kinds().iter().filter(|kind| is(kind)).count();
        let joints = JointCounts {
            limits: count(|kind| *kind == ConstraintKind::Limit),
            bilateral: count(|kind| matches!(kind, ConstraintKind::Bilateral { .. })),
        };
        let named = (problem.name(), problem.contact_law().name(), count(|kind| *kind == ConstraintKind::Contact));
        Certificate::of(named, Some(joints), solution, residuals, tolerance)
    }

    fn of(
        (problem, law, contacts): (&'a str, &'static str, usize),
        joints: Option<JointCounts>,
        solution: &'a Solution,
        residuals: JointedResiduals,
        tolerance: f64,
    ) -> Self {
        let (solution_found, no_number) = (residuals.is_solution(tolerance), residuals.contacts.no_number());
        Certificate {
            status: if solution_found { "solved" } else { "rejected" },
            problem,
            law,
            contacts,
            joints,
            solver: &solution.solver,
            iterations: solution.iterations,
            residuals,
            tolerance,
            solution: solution_found,
            backward: None,
            backward_reason: None,
            lcp: None,
            forward: None,
            solutions: None,
            no_solution: None,
            no_number,
            reproducible: solution.reproducible,
            not_least_norm: None,
            history: None,
            without_units: false,
        }
    }

    /// The same of a linear complementarity problem, whose numbers have no units.
    pub fn without_units(self) -> Self {
        Certificate { without_units: true, ..self }
    }

    /// The unit that is shown; 1 is none.
    fn unit<'u>(&self, unit: &'u str) -> &'u str {
        if self.without_units { "1" } else { unit }
    }

    /// The same with what was proved about all solutions.
    pub fn with_proofs(self, proofs: Proofs) -> Self {
        let denied = proofs.denies();
        Certificate { solutions: Some(proofs), ..self }.denied(denied)
    }

    /// The same with what was proved about a solution near.
    pub fn with_solution_near(self, found: &Forward, impulses: Option<ImpulseSet>) -> Self {
        Certificate { forward: Some(Near::new(found, impulses)), ..self }
    }

    /// The same of an answer whose solver ended like this.
    pub fn with_ending(self, ending: Ending) -> Self {
        let status = match (self.solution, ending.exhausted) {
            (true, _) => "solved",
            (false, true) => "limit",
            (false, false) => "stalled",
        };
        let Ending { reproducible, not_least_norm, history, .. } = ending;
        Certificate { status, reproducible: Some(reproducible), not_least_norm, history, ..self }
    }

    /// The same with a proved backward error.
    pub fn with_proof(self, proof: &Backward) -> Self {
        let word = |state: &HeldAs| match state {
            HeldAs::Open => "open",
            HeldAs::Sticking => "sticking",
            HeldAs::Sliding => "sliding",
            HeldAs::Joined => "held",
        };
        let (contact, velocity) = proof.worst().map_or((None, 0.0), |(contact, velocity)| (Some(contact), velocity));
        let states = proof.states.iter().map(word).collect();
        let proved = Proved { velocity, contact, impulse: proof.moved(), states, velocities: proof.velocity.clone() };
        Certificate { backward: Some(proved), ..self }
    }

    /// The same without a proved backward error, for this reason.
    pub fn without_proof(self, reason: String) -> Self {
        Certificate { backward_reason: Some(reason), ..self }
    }

    /// The same with a proof that the problem has no solution.
    pub fn with_no_solution(self, no_solution: Option<String>) -> Self {
        let denied = no_solution.is_some();
        Certificate { no_solution, ..self }.denied(denied)
    }

    /// The same with what is proved of the linear complementarity problem that it is.
    pub fn with_lcp(self, proved: LcpProved) -> Self {
        let denied = proved.denies();
        Certificate { lcp: Some(proved), ..self }.denied(denied)
    }

    /// What is proved to have no solution has none, whatever the residuals say.
    fn denied(self, denied: bool) -> Self {
        if denied { Certificate { status: "infeasible", solution: false, ..self } } else { self }
    }

    /// Whether a solution of the problem itself is proved to be near.
    pub fn is_near_a_solution(&self) -> bool {
        self.forward.as_ref().is_some_and(|near| near.is_proved())
    }

    /// Whether the answer is a solution.
    pub fn accepts(&self) -> bool {
        self.solution
    }

    /// `solved`, or why not.
    pub fn status(&self) -> &'static str {
        self.status
    }

    /// Whether the same command finds the answer again, where somebody knows.
    pub fn reproducible(&self) -> Option<bool> {
        self.reproducible
    }

    /// Who proposed the answer; empty where nobody is named.
    pub fn solver(&self) -> &str {
        self.solver
    }

    /// Why the problem has no solution, where that is proved.
    pub fn no_solution(&self) -> Option<&str> {
        self.no_solution.as_deref()
    }

    /// The certificate for readers.
    pub fn text(&self) -> String {
        let solver = if self.solver.is_empty() { "not named" } else { self.solver };
        let joints = self.joints.as_ref().map_or(String::new(), JointCounts::text);
        let name = quoted(self.problem);
        let mut text = if self.without_units {
            format!("linear complementarity problem {name}, rows: {}; the impulse is z, the velocity M z + q\n", self.contacts)
        } else {
            format!("problem {name}, law {}, contacts: {}{joints}\n", self.law, self.contacts)
        };
        let mut line = |content: String| writeln!(text, "{content}").expect("writing to a String cannot fail");
        line(format!("solver {solver}, iterations: {}", self.iterations));
        let bilateral = self.residuals.bilateral.map(|worst| ("bilateral", worst, "m/s"));
        // contacts are counted among all constraints where there are joints
        let place = if self.joints.is_some() { "constraint" } else { "contact" };
        let pushing = self.contacts + self.joints.as_ref().map_or(0, |joints| joints.limits);
        for (name, Worst { part, contact, .. }, unit) in self.residuals.contacts.judged.entries().into_iter().chain(bilateral) {
            let unit = self.unit(unit);
            let [value, limit] = [part.value, part.limit(self.tolerance)].map(|number| told(number, unit));
            let relative = told(part.relative(), "1");
            let mark = if part.relative() <= self.tolerance { ' ' } else { '✗' };
            // what no contact has is worst at none; only joints have velocities then, too
            let is_anywhere = pushing > 0 || (self.joints.is_some() && ["velocity", "bilateral"].contains(&name));
            let at = if is_anywhere { format!("{place} {contact}") } else { format!("no {place}") };
            line(format!("{mark} {name:18} {value:16} relative {relative:10} limit {limit:16} {at}"));
        }
        line("norms over all contacts, shown for comparison only:".into());
        for (name, value, unit) in self.residuals.contacts.norms() {
            let mark = if self.no_number == Some(name) { '✗' } else { ' ' };
            line(format!("{mark} {name:18} {}", told(value, self.unit(unit))));
        }
        let of_residuals = || self.residuals.contacts.judged.entries().into_iter().find(|(_, worst, _)| worst.part.value.is_nan());
        if let Some(name) = self.no_number.or_else(|| of_residuals().map(|(name, ..)| name)) {
            line(format!("{name} is no number, so that nothing is shown: give the problem and its answer in other units"));
        }
        if let Some(proof) = &self.backward {
            let [velocity, impulse] =
                [(proof.velocity, "m/s"), (proof.impulse, "N·s")].map(|(number, unit)| with_unit(&above(number), self.unit(unit)));
            let at = proof.contact.map_or(String::new(), |contact| format!(" ({place} {contact})"));
            line(format!(
                "proved in fractions: impulses that differ by at most {impulse} at a {place} solve exactly the problem whose free"
            ));
            line(format!("  velocity differs by at most {velocity} at a {place}{at}"));
        }
        if let Some(reason) = &self.backward_reason {
            line(format!("no backward error is proved: {}", reason.trim_start_matches("not proved: ")));
        }
        if let Some(near) = &self.forward {
            near.lines(place, ["m/s", "N·s"].map(|unit| self.unit(unit))).into_iter().for_each(&mut line);
        }
        for said in self.lcp.iter().flat_map(|lcp| lcp.lines(["N·s", "m/s"].map(|unit| self.unit(unit)))) {
            line(said);
        }
        if let Some(proofs) = &self.solutions {
            proofs.lines().into_iter().for_each(&mut line);
        }
        if let Some(history) = &self.history {
            line(format!("largest relative residual of {}, look by look of the solver:", counted(history.len(), "look")));
            for looks in history.chunks(PER_LINE) {
                line(format!("  {}", looks.iter().map(|residual| short(*residual)).collect::<Vec<_>>().join(" ")));
            }
        }
        if let Some(reason) = &self.not_least_norm {
            line(format!("the impulses are the solver's, not those of least norm: {reason}"));
        }
        if self.reproducible == Some(false) {
            line("ended by the time limit: another run need not find this answer again".into());
        }
        if let Some(proof) = &self.no_solution {
            line(proof.trim_end().into());
        }
        let verdict = if self.solution { "a solution" } else { "NOT a solution" };
        line(format!("{verdict} to the relative tolerance {}", significant(self.tolerance)));
        text
    }
}

/// A number with its unit, or that it is none.
fn told(number: f64, unit: &str) -> String {
    if number.is_nan() { NO_NUMBER.into() } else { with_unit(&significant(number), unit) }
}

/// So many looks of a solver stand in a line.
const PER_LINE: usize = 12;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::Law;
    use nalgebra::{DMatrix, dmatrix, dvector};

    /// A mass of 1 kg that arrives at 1 m/s; the impulse 1 N·s stops it.
    fn certificate(impulse: f64) -> (String, bool) {
        let problem =
            ContactProblem::new(dmatrix![1.0], dvector![-1.0]).name("stop").law(Law::Frictionless).rows_per_contact(1).build().unwrap();
        let impulse = dvector![impulse];
        let velocity = problem.velocity(&impulse);
        let solution = Solution::new("", impulse, velocity, 0);
        let residuals = residuals(&problem, &solution).expect("sizes fit");
        let certificate = Certificate::new(&problem, &solution, &residuals, 0.25);
        (certificate.text(), certificate.accepts())
    }

    #[test]
    fn residuals_carry_units_and_the_verdict_is_the_last_line() {
        let (text, accepted) = certificate(1.0);
        assert!(accepted && text.ends_with("\na solution to the relative tolerance 0.25\n"), "{text}");
        assert!(text.contains("primal             0 N·s") && text.contains("complementarity    0 J"), "{text}");
    }

    #[test]
    fn a_norm_that_is_no_number_is_named_where_it_refuses_the_answer() {
        let of = |fast: f64| {
            let problem = ContactProblem::new(DMatrix::identity(2, 2), dvector![fast, fast]).law(Law::Frictionless).rows_per_contact(1);
            let (problem, solution) = (problem.build().unwrap(), Solution::new("", dvector![0.0, 0.0], dvector![fast, fast], 0));
            Certificate::new(&problem, &solution, &residuals(&problem, &solution).expect("sizes fit"), 1e-8).text()
        };
        assert!(of(1e200).ends_with("\na solution to the relative tolerance 1e-8\n"), "{}", of(1e200));
        let text = of(1.5e308);
        assert!(
            text.contains("✗ velocity_scale") && text.contains("velocity_scale is no number") && text.contains("NOT a solution"),
            "{text}"
        );
    }

    #[test]
    fn a_residual_that_is_no_number_is_told_in_words_with_a_cure() {
        let fast = dvector![-1e308, 1e308];
        let problem = ContactProblem::new(DMatrix::identity(2, 2), fast).rows_per_contact(2).friction(vec![0.5]).build().unwrap();
        let impulse = dvector![1e308, -5e307];
        let solution = Solution::new("", impulse.clone(), problem.velocity(&impulse), 0);
        let certificate = Certificate::new(&problem, &solution, &residuals(&problem, &solution).expect("sizes fit"), 1e-8);
        let text = Certificate { history: Some(vec![f64::NAN, 0.5]), ..certificate }.text();
        assert!(!text.contains("NaN") && text.contains("✗ dual               no number"), "{text}");
        assert!(text.contains("  no number 5.0e-1") && text.contains("dual is no number, so that nothing is shown: give "), "{text}");
        assert!(text.ends_with("NOT a solution to the relative tolerance 1e-8\n"), "{text}");
    }

    #[test]
    fn a_pull_is_no_solution() {
        let (text, accepted) = certificate(-1.0);
        assert!(!accepted && text.ends_with("NOT a solution to the relative tolerance 0.25\n"), "{text}");
        let marked = |text: &str| text.lines().filter(|line| line.starts_with('✗')).map(str::to_owned).collect::<Vec<_>>();
        assert!(marked(&text).iter().any(|line| line.starts_with("✗ primal ")), "{text}");
        assert!(marked(&certificate(1.0).0).is_empty(), "{}", certificate(1.0).0);
    }
}
