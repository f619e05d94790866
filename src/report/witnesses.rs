//! `verify --export`: what every exact claim was decided from, as JSON that any program can decide again.
//!
//! A claim holds its findings, with what the sentence says of each, and the witnesses of the exact decisions that its check made:
//! matrices, vectors, solutions, rays, minors, steps. Numbers are texts, fractions of whole numbers, so that nothing is rounded.

use crate::checks::{Finding, FindingOrigin, Relation, Value, Voice};
use crate::claims::{ClaimVerdict, Evidence, JudgedClaim, Kind, Severity, Status};
use crate::scalar::Rational;
use moreau_exact::witness::{Part, Witness};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// witnesses/1: what claims were decided from.
#[derive(Serialize, JsonSchema)]
pub struct WitnessDocument {
    /// witnesses/1.
    schema: Form,
    /// How many there are of what follows, so that a file that was cut is noticed.
    counts: Counts,
    /// How many claims there are, with those that are not in this file.
    of: usize,
    /// Which claims were chosen; `null` if all are here.
    selected: Option<Selection>,
    /// The claims.
    claims: Vec<WitnessedClaim>,
}

/// Which claims were chosen: those that meet everything that is not `null`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Selection {
    /// A group or one claim, by its id: whole parts, so that S1 is not S12.
    pub group: Option<String>,
    /// Their verdict.
    pub verdict: Option<ClaimVerdict>,
    /// How much is wrong with them.
    pub severity: Option<Severity>,
    /// What kind of sentence they are.
    pub kind: Option<Kind>,
}

/// The name of the form.
#[derive(Serialize, JsonSchema)]
enum Form {
    #[serde(rename = "witnesses/1")]
    First,
}

/// How many there are.
#[derive(Serialize, JsonSchema)]
struct Counts {
    /// Claims.
    claims: usize,
    /// Findings of all claims.
    findings: usize,
    /// Witnesses of all claims.
    witnesses: usize,
}

/// What one claim was decided from.
#[derive(Serialize, JsonSchema)]
struct WitnessedClaim {
    /// The claim's identifier.
    id: &'static str,
    /// The recorded verdict, which follows from the findings.
    verdict: ClaimVerdict,
    /// The recorded grade, which follows from the findings.
    evidence: Evidence,
    /// Why the check could not be carried out; else `null`.
    failed: Option<String>,
    /// What was found.
    findings: Vec<WitnessedFinding>,
    /// The exact decisions that its check made.
    witnesses: Vec<WitnessEntry>,
}

/// What was found, what was expected and what the sentence says; decisions are 0 and 1.
#[derive(Serialize, JsonSchema)]
struct WitnessedFinding {
    /// What was measured.
    name: String,
    /// The number.
    found: Number,
    /// What is expected of it.
    expected: Number,
    /// How the two are compared.
    relation: Relation,
    /// How far a rounded number may differ.
    tolerance: f64,
    /// What the sentence says, where it says something else than what is expected.
    stated: Option<StatedEntry>,
    /// The condition that the sentence omits and that this instance violates.
    violated: Option<&'static str>,
    /// Who says it, if not the sentence.
    voice: Option<VoiceEntry>,
    /// Where the found number comes from; what is computed is exact if the number is a fraction, and else held within a derived bound.
    origin: FindingOrigin,
    /// Whether it decides nothing.
    context: bool,
}

/// A fraction as a text, or a rounded number; `null` if it is not finite.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
enum Number {
    Exact(String),
    Rounded(Option<f64>),
}

/// What the sentence says.
#[derive(Serialize, JsonSchema)]
struct StatedEntry {
    /// How the found number is held against it.
    relation: Relation,
    /// The stated number.
    value: Number,
}

/// A passage, a reading or the point of an opinion.
#[derive(Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum VoiceEntry {
    /// One of two passages that speak of the same instance.
    Passage(&'static str),
    /// One of the readings that the sentence has.
    Reading(&'static str),
    /// The point on which it is an opinion.
    Opinion(&'static str),
}

/// One exact decision: its kind, and its data and answer by name.
#[derive(Serialize, JsonSchema)]
struct WitnessEntry {
    /// What was decided; `DECISIONS` in scripts/witnesses/decisions.py has a function for each, which says what it shows.
    kind: &'static str,
    #[serde(flatten)]
    parts: BTreeMap<&'static str, PartEntry>,
}

/// A datum or an answer: a fraction or a word, fractions, rows of fractions, counts.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
enum PartEntry {
    Text(String),
    Texts(Vec<String>),
    Rows(Vec<Vec<String>>),
    Counts(Vec<usize>),
}

impl WitnessDocument {
    /// The witnesses of these claims, of so many that there are.
    pub fn of(claims: &[JudgedClaim], selected: Option<Selection>, of: usize) -> Self {
        let counts = Counts {
            claims: claims.len(),
            findings: claims.iter().map(|claim| claim.findings.len()).sum(),
            witnesses: claims.iter().map(|claim| claim.witnesses.len()).sum(),
        };
        WitnessDocument { schema: Form::First, counts, of, selected, claims: claims.iter().map(entry).collect() }
    }
}

fn entry(JudgedClaim { claim, findings, witnesses, status, .. }: &JudgedClaim) -> WitnessedClaim {
    let failed = match status {
        Status::Failed(why) => Some(why.clone()),
        _ => None,
    };
    WitnessedClaim {
        id: claim.id,
        verdict: claim.verdict,
        evidence: claim.evidence,
        failed,
        findings: findings.iter().map(finding).collect(),
        witnesses: witnesses.iter().map(witness).collect(),
    }
}

fn finding(finding: &Finding) -> WitnessedFinding {
    let number = |text: &str| match text {
        "true" => "1".into(),
        "false" => "0".into(),
        other => other.to_string(),
    };
    let (found, expected) = match &finding.exact {
        Some([found, expected]) => (Number::Exact(number(found)), Number::Exact(number(expected))),
        None => (rounded(finding.measured), rounded(finding.expectation.value)),
    };
    let stated = finding.bearing.stated.as_ref().map(|stated| StatedEntry {
        relation: stated.relation,
        value: match &stated.value {
            Value::Exact(value) => Number::Exact(value.to_string()),
            Value::Rounded(value) => rounded(*value),
        },
    });
    let voice = match finding.bearing.voice {
        Voice::Sentence => None,
        Voice::Passage(name) => Some(VoiceEntry::Passage(name)),
        Voice::Reading(name) => Some(VoiceEntry::Reading(name)),
        Voice::Opinion(name) => Some(VoiceEntry::Opinion(name)),
    };
    let expectation = &finding.expectation;
    WitnessedFinding {
        name: finding.name.clone(),
        found,
        expected,
        relation: expectation.relation,
        tolerance: expectation.tolerance,
        stated,
        violated: finding.bearing.violated,
        voice,
        origin: finding.bearing.origin,
        context: finding.bearing.context,
    }
}

fn rounded(number: f64) -> Number {
    Number::Rounded(number.is_finite().then_some(number))
}

fn witness(witness: &Witness) -> WitnessEntry {
    WitnessEntry { kind: witness.kind, parts: witness.parts.iter().map(|(name, value)| (*name, part(value))).collect() }
}

fn part(part: &Part) -> PartEntry {
    let texts = |numbers: &[Rational]| numbers.iter().map(Rational::to_string).collect::<Vec<_>>();
    match part {
        Part::Number(number) => PartEntry::Text(number.to_string()),
        Part::Vector(vector) => PartEntry::Texts(texts(vector)),
        Part::Matrix(rows) | Part::Vectors(rows) => PartEntry::Rows(rows.iter().map(|row| texts(row)).collect()),
        Part::Counts(counts) => PartEntry::Counts(counts.clone()),
        Part::Word(word) => PartEntry::Text((*word).into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims;
    use crate::report::text::tests::outcome;
    use serde_json::json;

    #[test]
    fn an_exact_decision_is_written_in_fractions() {
        let claim = claims::find("S4.copos-plus").expect("registered");
        let outcome = claims::judge_with_witnesses(claim);
        let selected = Selection { group: Some("S4".into()), ..Selection::default() };
        let document = serde_json::to_value(WitnessDocument::of(&[outcome], Some(selected), 2)).expect("it is JSON");
        assert_eq!((&document["of"], &document["selected"]["group"]), (&json!(2), &json!("S4")));
        assert_eq!(document["claims"][0]["findings"][0]["origin"], json!("computed"));
        let kinds: Vec<_> = document["claims"][0]["witnesses"].as_array().expect("a list").iter().map(|one| one["kind"].clone()).collect();
        assert!(kinds.contains(&json!("copositive-plus")), "{kinds:?}");
        assert!(document["claims"][0]["findings"][0]["found"].is_string());
        let length = |name: &str| document["claims"][0][name].as_array().expect("a list").len();
        assert_eq!(document["counts"], json!({ "claims": 1, "findings": length("findings"), "witnesses": length("witnesses") }));
    }

    #[test]
    fn a_check_that_could_not_be_carried_out_stands_there_with_the_reason() {
        let all = [outcome(Status::Failed("the check panicked".into())), outcome(Status::Supported)];
        let document = serde_json::to_value(WitnessDocument::of(&all, None, 2)).expect("it is JSON");
        assert_eq!(document["selected"], json!(null));
        let failed: Vec<_> = document["claims"].as_array().expect("a list").iter().map(|claim| &claim["failed"]).collect();
        assert_eq!(failed, [&json!("the check panicked"), &json!(null)]);
    }
}
