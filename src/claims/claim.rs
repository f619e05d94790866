//! One claim of the chapter: statement, verdict, evidence, check and control.

use crate::Result;
use crate::checks::Finding;
use serde::Serialize;

/// What became of a claim of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum ClaimVerdict {
    /// Holds as stated.
    #[serde(rename = "TRUE")]
    True,
    /// Holds under conditions the text omits.
    #[serde(rename = "TRUE WITH CONDITIONS")]
    Conditional,
    /// Does not hold as printed.
    #[serde(rename = "FALSE AS STATED")]
    False,
    /// The text states two things that exclude each other.
    #[serde(rename = "INTERNALLY INCONSISTENT")]
    Inconsistent,
    /// Has readings that differ in truth, or cannot be decided by mathematics or experiment.
    #[serde(rename = "AMBIGUOUS")]
    Ambiguous,
}

impl ClaimVerdict {
    /// The words used in reports.
    pub fn words(self) -> &'static str {
        match self {
            ClaimVerdict::True => "true",
            ClaimVerdict::Conditional => "conditional",
            ClaimVerdict::False => "false as stated",
            ClaimVerdict::Inconsistent => "inconsistent",
            ClaimVerdict::Ambiguous => "ambiguous",
        }
    }
}

/// How strong the evidence is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Evidence {
    /// Rational arithmetic, no rounding.
    Exact,
    /// A residual below a derived bound.
    Certified,
    /// An experiment with a stated spread.
    Measured,
    /// A fact about software or literature, with version and source.
    Cited,
    /// An opinion; the check decides only the part that can be decided.
    NotDecidable,
}

impl Evidence {
    /// The word used in reports.
    pub fn word(self) -> &'static str {
        match self {
            Evidence::Exact => "exact",
            Evidence::Certified => "certified",
            Evidence::Measured => "measured",
            Evidence::Cited => "cited",
            Evidence::NotDecidable => "not decidable",
        }
    }
}

/// Which statement is fed through a claim's check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// The statement the recorded verdict stands for: every finding must hold.
    Recorded,
    /// The control: the rejected verdict or a perturbed statement; at least one finding must fail.
    Control,
}

impl Reading {
    /// The recorded or the control value of a quantity.
    pub fn pick<T>(self, recorded: T, control: T) -> T {
        match self {
            Reading::Recorded => recorded,
            Reading::Control => control,
        }
    }
}

/// One claim of the chapter.
pub struct Claim {
    /// Identifier: `group.name`, for instance `S4.copos-plus`, or a numbered row of a table, `R6`.
    pub id: &'static str,
    /// What the chapter says, with its own hedges.
    pub statement: &'static str,
    /// The verdict in force.
    pub verdict: ClaimVerdict,
    /// The grade of the evidence.
    pub evidence: Evidence,
    /// The statement as it should read; the claim itself where it is true.
    pub correct_statement: &'static str,
    /// Proof or counterexample, with its numbers.
    pub argument: &'static str,
    /// What the control feeds through the check.
    pub control: &'static str,
    /// Where the claim stands and what the argument rests on.
    pub sources: &'static [&'static str],
    /// The check: findings that hold for the recorded reading and not all for the control.
    pub check: fn(Reading) -> Result<Vec<Finding>>,
}

impl Claim {
    /// The group of the id, `S4` for `S4.copos-plus`.
    pub fn section(&self) -> &'static str {
        group_of(self.id)
    }
}

/// The group of an id: `S4` of `S4.sigma`; an id without a dot is a letter and a number, and `R6` is in `R`.
pub fn group_of(id: &str) -> &str {
    match id.split_once('.') {
        Some((group, _)) => group,
        None => id.trim_end_matches(|letter: char| letter.is_ascii_digit()),
    }
}
