//! What is proved of a linear complementarity problem, for readers and in JSON.

use super::bound::above;
use super::text::quoted;
use crate::certificate::lcp_proof::{Answer, Count};
use crate::number::{counted, with_unit};
use crate::problem::Lcp;
use crate::scalar::{Rational, Scalar};
use nalgebra::DVector;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;

/// A proof of an answer and of the number of solutions.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LcpProved {
    /// A solution near the answer, where one is proved.
    #[serde(skip_serializing_if = "Option::is_none")]
    near: Option<Near>,
    /// Why none is.
    #[serde(skip_serializing_if = "Option::is_none")]
    not_proved: Option<NotProved>,
    /// What the unknowns are: `r`, or λ, β, σ of polyhedral friction.
    unknowns: &'static str,
    /// How many solutions there are; `some` where others were not excluded.
    #[schemars(extend("enum" = ["one", "several", "continuum", "none", "some", "unknown"]))]
    solutions: &'static str,
    /// How many, where there are several and no others.
    #[serde(skip_serializing_if = "Option::is_none")]
    count: Option<usize>,
    /// How many there are at least, where there may be more.
    #[serde(skip_serializing_if = "Option::is_none")]
    at_least: Option<usize>,
    /// By what it is proved, or why it is not.
    why: String,
    /// All solutions, or the two ends of a continuum, rounded.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    points: Vec<Vec<f64>>,
    /// y ≥ 0 with Mᵀy ≤ 0 and qᵀy < 0, in fractions.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    witness: Vec<String>,
}

/// A solution near the answer.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "NearLcp")]
struct Near {
    /// The arithmetic of the proof.
    #[serde(rename = "in")]
    #[schemars(extend("enum" = ["fractions", "intervals"]))]
    arithmetic: &'static str,
    /// How far it is from z at most, row by row.
    distance: f64,
    /// How far its w is from M z + q at most.
    slack_distance: f64,
    /// The rows where its z is positive.
    support: Vec<usize>,
    /// The rows where its z and w are both zero.
    degenerate: Vec<usize>,
}

/// Why no solution was found near.
#[derive(Debug, Serialize, JsonSchema)]
struct NotProved {
    /// The row where the proof failed.
    row: Option<usize>,
    /// Why.
    reason: String,
}

fn rounded(z: &DVector<Rational>) -> Vec<f64> {
    z.iter().map(Scalar::to_f64).collect()
}

impl LcpProved {
    /// What was proved of an answer, if there is one, and of the problem.
    pub fn new(lcp: &Lcp<f64>, answer: Option<&Answer>, count: &Count) -> Self {
        let near = match answer {
            Some(Answer::Near(near)) => Some(Near {
                arithmetic: if near.exact { "fractions" } else { "intervals" },
                distance: near.distance,
                slack_distance: near.slack_distance,
                support: near.support.clone(),
                degenerate: near.degenerate.clone(),
            }),
            _ => None,
        };
        let not_proved = match answer {
            Some(Answer::NotProved { row, reason }) => Some(NotProved { row: *row, reason: reason.clone() }),
            _ => None,
        };
        let size = lcp.size();
        let (solutions, why, points, witness) = match count {
            Count::One(why) => ("one", (*why).into(), Vec::new(), Vec::new()),
            Count::Exactly(points) => {
                ("several", format!("{}, all complementary cones", counted(size, "row")), points.iter().map(rounded).collect(), Vec::new())
            }
            Count::AtLeast(1, why) => ("some", why.clone(), Vec::new(), Vec::new()),
            Count::AtLeast(_, why) => ("several", why.clone(), Vec::new(), Vec::new()),
            Count::Continuum(ends) => {
                ("continuum", "all on the way between two ends".into(), ends.iter().map(rounded).collect(), Vec::new())
            }
            Count::Infeasible(y) => {
                ("none", "y ≥ 0 has Mᵀy ≤ 0 and qᵀy < 0".into(), Vec::new(), y.iter().map(ToString::to_string).collect())
            }
            Count::NoCone => ("none", "no complementary cone holds q".into(), Vec::new(), Vec::new()),
            Count::Unknown(why) => ("unknown", why.clone(), Vec::new(), Vec::new()),
        };
        let exactly = matches!(count, Count::Exactly(_)).then_some(points.len());
        let at_least = if let Count::AtLeast(least, _) = count { Some(*least) } else { None };
        LcpProved { near, not_proved, unknowns: "r", solutions, count: exactly, at_least, why, points, witness }
    }

    /// What was proved of an answer under polyhedral friction.
    pub fn polyhedral(lcp: &Lcp<f64>, answer: &Answer) -> Self {
        let count = Count::Unknown("the velocities are counted, in `solutions`: λ, β, σ of one velocity may differ".into());
        LcpProved { unknowns: "λ, β, σ", ..LcpProved::new(lcp, Some(answer), &count) }
    }

    /// Whether it is proved that there is no solution.
    pub fn denies(&self) -> bool {
        self.solutions == "none"
    }

    /// The same for readers, with the units of z and w; 1 is none.
    pub fn lines(&self, [push, speed]: [&str; 2]) -> Vec<String> {
        let mut lines = Vec::new();
        if let Some(near) = &self.near {
            let [z, w] = [near.distance, near.slack_distance].map(above);
            let degenerate =
                if near.degenerate.is_empty() { String::new() } else { format!(", rows with z = w = 0: {:?}", near.degenerate) };
            lines.push(match self.unknowns {
                "r" => format!(
                    "proved in {}: a solution z with |z − r| ≤ {} and |w − u| ≤ {} in every row{degenerate}",
                    near.arithmetic,
                    with_unit(&z, push),
                    with_unit(&w, speed)
                ),
                unknowns => format!(
                    "proved in {}: a solution ({unknowns}) of the law's complementarity problem differs by at most {z}, and what it is \
                     complementary to by at most {w}, in SI units",
                    near.arithmetic
                ),
            });
        }
        if let Some(NotProved { row, reason }) = &self.not_proved {
            let place = row.map_or(String::new(), |row| format!(" (row {row})"));
            lines.push(format!("NOT proved that a solution is near{place}: {reason}"));
        }
        if self.unknowns != "r" {
            // the velocities are counted, not their parts
            return lines;
        }
        lines.push(match (self.solutions, self.count) {
            ("one", _) => format!("proved: exactly one solution; {}", self.why),
            (_, Some(count)) => format!("proved: exactly {count} solutions; {}", self.why),
            ("some", _) => format!("proved: at least one solution; {}", self.why),
            ("several", _) => format!("proved: at least {} solutions; {}", self.at_least.unwrap_or_default(), self.why),
            ("continuum", _) => format!("proved: infinitely many solutions, {}", self.why),
            ("none", _) => format!("proved: NO solution; {}", self.why),
            _ => format!("how many solutions there are is not known: {}", self.why),
        });
        let vector = |numbers: &[f64]| format!("  z = {numbers:?}");
        lines.extend(self.points.iter().map(|point| vector(point)));
        if !self.witness.is_empty() {
            lines.push(format!("  y = [{}]", self.witness.join(", ")));
        }
        lines
    }
}

/// How many solutions a problem has, without an answer.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Counted<'a> {
    /// Whether it is proved to have a solution, or none.
    #[schemars(extend("enum" = ["solvable", "infeasible", "unknown"]))]
    status: &'static str,
    /// The problem's name.
    problem: &'a str,
    /// Its rows.
    rows: usize,
    /// How many solutions it has.
    lcp: LcpProved,
}

impl<'a> Counted<'a> {
    /// What was proved of a problem of this name.
    pub fn new(problem: &'a str, lcp: &Lcp<f64>, count: &Count) -> Self {
        let status = match count.is_solvable() {
            Some(true) => "solvable",
            Some(false) => "infeasible",
            None => "unknown",
        };
        Counted { status, problem, rows: lcp.size(), lcp: LcpProved::new(lcp, None, count) }
    }

    /// Whether it is proved that there is a solution.
    pub fn is_solvable(&self) -> bool {
        self.status == "solvable"
    }

    /// The same for readers.
    pub fn text(&self) -> String {
        let mut text = format!("linear complementarity problem {}, rows: {}\n", quoted(self.problem), self.rows);
        self.lcp.lines(["1"; 2]).iter().for_each(|line| writeln!(text, "{line}").expect("writing to a String cannot fail"));
        text
    }
}
