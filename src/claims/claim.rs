//! One claim of the chapter: statement, verdict, evidence, check and control.

use crate::Result;
use crate::checks::Finding;
use crate::checks::formula::unicode;
use schemars::JsonSchema;
use serde::Serialize;

/// What became of a claim of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
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

/// What kind of sentence a claim is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// It says that something is so.
    Assertion,
    /// An exercise or a question, with the answer that it presumes.
    Exercise,
    /// It fixes the meaning of a word or a symbol.
    Definition,
    /// It says who wrote, proved or named something, and where.
    Citation,
    /// It names a file, a function, an option or a version of a package.
    Path,
    /// It says what to do.
    Advice,
    /// It values.
    Opinion,
}

impl Kind {
    /// The words used in reports.
    pub fn words(self) -> &'static str {
        match self {
            Kind::Assertion => "assertion",
            Kind::Exercise => "exercise or question",
            Kind::Definition => "definition",
            Kind::Citation => "citation",
            Kind::Path => "path or version",
            Kind::Advice => "advice",
            Kind::Opinion => "opinion",
        }
    }
}

/// How much is wrong with a claim that does not hold as printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Severity {
    /// A slip that a reader corrects at sight: a sign, an index, a number, a name.
    Misprint,
    /// What is said holds, for another reason than the one given.
    WrongReason,
    /// It holds under a condition that is not printed.
    MissingHypothesis,
    /// It does not hold.
    WrongStatement,
    /// It is offered as a theorem, or others rest on it as on one, and it does not hold.
    BrokenTheorem,
}

impl Severity {
    /// The words used in reports.
    pub fn words(self) -> &'static str {
        match self {
            Severity::Misprint => "misprint",
            Severity::WrongReason => "wrong reason",
            Severity::MissingHypothesis => "missing hypothesis",
            Severity::WrongStatement => "wrong statement",
            Severity::BrokenTheorem => "broken theorem",
        }
    }
}

/// How strong the evidence is, from the strongest to the weakest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
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
    /// A control, by its place in [`Claim::controls()`]: another subject; a deciding finding must come out otherwise.
    Control(usize),
}

impl Reading {
    /// Whether another subject is fed through the check.
    pub fn is_control(self) -> bool {
        self != Reading::Recorded
    }

    /// The reading for what only the control with this place changes: any other control leaves it as recorded.
    pub fn only(self, place: usize) -> Reading {
        if self == Reading::Control(place) { self } else { Reading::Recorded }
    }

    /// The recorded or the control value of a quantity; of a claim with several controls, after [`Reading::only`].
    pub fn pick<T>(self, recorded: T, control: T) -> T {
        match self {
            Reading::Recorded => recorded,
            Reading::Control(_) => control,
        }
    }
}

/// The check of a claim: a function, and where a reader finds it.
#[derive(Clone, Copy, Debug)]
pub struct CheckFunction {
    /// Findings of the recorded reading, or of a control.
    pub run: fn(Reading) -> Result<Vec<Finding>>,
    /// Path of the function, `moreau::claims::s3::drift::sinking`.
    pub path: &'static str,
}

/// The [`CheckFunction`] that a function of this module is.
macro_rules! check {
    ($($function:ident)::+) => {
        $crate::claims::CheckFunction { run: $($function)::+, path: concat!(module_path!(), $("::", stringify!($function)),+) }
    };
}
pub(crate) use check;

/// One claim of the chapter.
///
/// Its texts hold formulas in TeX between dollar signs. A terminal and JSON get them in Unicode, from the methods; a page gets them from
/// `formula::html`.
pub struct Claim {
    /// Identifier: `group.name`, for instance `S4.copos-plus`, or a numbered row of a table, `R6`.
    pub id: &'static str,
    /// What the chapter says, with its own hedges.
    pub(crate) statement: &'static str,
    /// The verdict in force.
    pub verdict: ClaimVerdict,
    /// What kind of sentence it is.
    pub kind: Kind,
    /// How much is wrong; absent where the claim is true or ambiguous.
    pub severity: Option<Severity>,
    /// The grade of the evidence.
    pub evidence: Evidence,
    /// The statement as it should read; the claim itself where it is true.
    pub(crate) correct_statement: &'static str,
    /// Proof or counterexample, with its numbers.
    pub(crate) argument: &'static str,
    /// What each control feeds through the check: the first must lead to another verdict, each further one must move a deciding finding
    /// that none before it moves.
    pub(crate) controls: &'static [&'static str],
    /// Where the claim stands and what the argument rests on.
    pub sources: &'static [&'static str],
    /// The check: findings that hold for the recorded reading and not all for a control.
    pub check: CheckFunction,
}

impl Claim {
    /// The group of the id, `S4` for `S4.copos-plus`.
    pub fn section(&self) -> &'static str {
        group_of(self.id)
    }

    /// What the chapter says, with its own hedges.
    pub fn statement(&self) -> String {
        written(self.statement)
    }

    /// The statement as it should read; the claim itself where it is true.
    pub fn correct_statement(&self) -> String {
        written(self.correct_statement)
    }

    /// Proof or counterexample, with its numbers.
    pub fn argument(&self) -> String {
        written(self.argument)
    }

    /// What each control feeds through the check.
    pub fn controls(&self) -> Vec<String> {
        self.controls.iter().map(|text| written(text)).collect()
    }
}

/// The text with its formulas in Unicode.
fn written(text: &str) -> String {
    unicode(text).expect("a test reads every text of every claim")
}

/// The group of an id: `S4` of `S4.sigma`; an id without a dot is a letter and a number, and `R6` is in `R`.
pub fn group_of(id: &str) -> &str {
    match id.split_once('.') {
        Some((group, _)) => group,
        None => id.trim_end_matches(|letter: char| letter.is_ascii_digit()),
    }
}
