//! What a finding says about the printed sentence that it belongs to.
//!
//! ```text
//!     supports   found and stated agree within the finding's bound
//!     refutes    they do not
//! ```
//! `stated` is what the sentence says of this instance: a number, a relation or a truth value, from the sentence alone. Who writes
//! a finding says which instance it is (the omitted condition is met or violated), which passage or reading speaks, or that the
//! finding decides nothing. Whether it supports or refutes is computed.

use crate::relation::Relation;
use moreau_exact::scalar::Rational;
use schemars::JsonSchema;
use serde::Serialize;

/// A number or a truth value of a sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Held exactly against a rational or a decision.
    Exact(Rational),
    /// Held against a rounded number, within the bound of the finding.
    Rounded(f64),
}

impl From<bool> for Value {
    fn from(truth: bool) -> Self {
        Value::from(usize::from(truth))
    }
}

impl From<usize> for Value {
    fn from(count: usize) -> Self {
        Value::Exact(Rational::from(count))
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Value::Rounded(number)
    }
}

impl From<Rational> for Value {
    fn from(number: Rational) -> Self {
        Value::Exact(number)
    }
}

impl From<&Rational> for Value {
    fn from(number: &Rational) -> Self {
        Value::Exact(number.clone())
    }
}

impl Value {
    /// The value as a floating-point number.
    pub fn rounded(&self) -> f64 {
        match self {
            Value::Exact(number) => number.to_f64().value(),
            Value::Rounded(number) => *number,
        }
    }
}

/// What the sentence says of the number that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Stated {
    /// How the found number is held against the stated one.
    pub relation: Relation,
    /// The stated number.
    pub value: Value,
}

/// Who says what is stated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Voice {
    /// The sentence.
    #[default]
    Sentence,
    /// One of two passages, named, which speak of the same instance.
    Passage(&'static str),
    /// One of the readings that the sentence has, named.
    Reading(&'static str),
    /// The sentence as an opinion on this point; the finding decides the part that can be decided.
    Opinion(&'static str),
}

/// Where the found number comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FindingOrigin {
    /// It follows from the data, exactly or within a derived bound.
    #[default]
    Computed,
    /// An experiment whose outcome no derivation bounds: an observed order, a stored run of an engine, a time, a count of iterations.
    Experiment,
    /// A look-up: a package at its version, stored facts about one, an identifier of a publication.
    LookUp,
}

/// What a finding has to do with the sentence.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bearing {
    /// What the sentence says of this instance; what is expected, if absent.
    pub stated: Option<Stated>,
    /// The condition that the sentence omits and that this instance violates, in words.
    pub violated: Option<&'static str>,
    /// Who says it.
    pub voice: Voice,
    /// Where the found number comes from.
    pub origin: FindingOrigin,
    /// Whether the finding decides nothing and is told beside the sentence.
    pub context: bool,
}
