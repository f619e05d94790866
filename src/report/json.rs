//! What `verify` writes as JSON: one flat object per claim.
//!
//! Numbers that are not finite become `null`, never `NaN`.

use crate::checks::{Finding, FindingOrigin, Voice};
use crate::claims::{Claim, ClaimVerdict, Evidence, Figures, JudgedClaim, Kind, PLACES, Place, Severity, Status, original, title};
use crate::{Error, Result};
use schemars::JsonSchema;
use serde::Serialize;

/// A claim as it stands in the registry, without running its check.
#[derive(Serialize, JsonSchema)]
pub struct ClaimEntry {
    /// Section and name, `S4.copos-plus`.
    id: &'static str,
    /// The part of the id before its point.
    section: &'static str,
    /// What it is about, in a few words.
    title: &'static str,
    /// What the chapter says, with its hedges.
    statement: String,
    /// What became of it.
    verdict: ClaimVerdict,
    /// What kind of sentence it is.
    kind: Kind,
    /// How much is wrong; absent where the statement holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    severity: Option<Severity>,
    /// The claim that says the same, at which the mistake is charged; absent where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    repeats: Option<&'static str>,
    /// How strong the evidence is.
    evidence: Evidence,
    /// What holds.
    correct_statement: String,
    /// The sentences that make it, the main one first; none for what the chapter does not say.
    places: &'static [Place],
}

impl From<&Claim> for ClaimEntry {
    fn from(claim: &Claim) -> Self {
        ClaimEntry {
            id: claim.id,
            section: claim.section(),
            title: title(claim.id),
            statement: claim.statement(),
            verdict: claim.verdict,
            kind: claim.kind,
            severity: claim.severity,
            repeats: original(claim.id),
            evidence: claim.evidence,
            correct_statement: claim.correct_statement(),
            places: PLACES.of(claim.id),
        }
    }
}

/// A finding with what it says about the sentence.
#[derive(Serialize, JsonSchema)]
pub struct FindingEntry<'a> {
    #[serde(flatten)]
    finding: &'a Finding,
    /// How much of its bound the found number uses; absent where it is held exactly.
    #[serde(skip_serializing_if = "Option::is_none")]
    used: Option<f64>,
    /// Whether what was found is what the sentence says; `context` does not decide.
    #[schemars(extend("enum" = ["supports", "refutes", "context"]))]
    role: &'static str,
    /// What the sentence says of this instance; where it prints nothing of it, what is expected if it holds.
    stated: String,
    /// The condition that the sentence omits and that this instance violates; absent where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    violated: Option<&'static str>,
    /// Who says what is stated; absent where it is the sentence.
    #[serde(skip_serializing_if = "is_sentence")]
    voice: Voice,
    /// Where the found number comes from.
    origin: FindingOrigin,
}

fn is_sentence(voice: &Voice) -> bool {
    *voice == Voice::Sentence
}

impl<'a> From<&'a Finding> for FindingEntry<'a> {
    fn from(finding: &'a Finding) -> Self {
        let role = match (finding.bearing.context, finding.supports()) {
            (true, _) => "context",
            (false, true) => "supports",
            (false, false) => "refutes",
        };
        FindingEntry {
            finding,
            used: finding.used(),
            role,
            stated: finding.stated(),
            violated: finding.bearing.violated,
            voice: finding.bearing.voice,
            origin: finding.bearing.origin,
        }
    }
}

/// A finding of a claim, with whether a control finds it otherwise.
#[derive(Serialize, JsonSchema)]
pub struct DecidingEntry<'a> {
    #[serde(flatten)]
    finding: FindingEntry<'a>,
    /// Whether a control finds it otherwise.
    moved: bool,
}

/// A claim with what its check found.
#[derive(Serialize, JsonSchema)]
pub struct OutcomeEntry<'a> {
    #[serde(flatten)]
    claim: ClaimEntry,
    /// What the check found.
    findings: Vec<DecidingEntry<'a>>,
    /// How many findings decide, and how many of these a control moves.
    figures: Figures,
    /// Whether the findings support the recorded verdict.
    #[schemars(extend("enum" = ["supported", "contradicted", "control-passed", "other-verdict", "failed"]))]
    status: &'static str,
    /// Why the status is `other-verdict` or `failed`; else it is absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    failure: Option<&'a str>,
    /// Wall-clock time \[s\].
    seconds: f64,
}

impl<'a> From<&'a JudgedClaim> for OutcomeEntry<'a> {
    fn from(outcome: &'a JudgedClaim) -> Self {
        let (status, failure) = match &outcome.status {
            Status::Supported => ("supported", None),
            Status::Contradicted => ("contradicted", None),
            Status::ControlPassed => ("control-passed", None),
            Status::OtherVerdict(reason) => ("other-verdict", Some(reason.as_str())),
            Status::Failed(reason) => ("failed", Some(reason.as_str())),
        };
        let figures = Figures::of(outcome);
        let entry = |finding| DecidingEntry { finding: FindingEntry::from(finding), moved: Figures::moves(finding, outcome) };
        OutcomeEntry {
            claim: outcome.claim.into(),
            findings: outcome.findings.iter().map(entry).collect(),
            figures,
            status,
            failure,
            seconds: outcome.seconds,
        }
    }
}

/// A control: the subject that it feeds through the check, and what the check finds then.
#[derive(Serialize, JsonSchema)]
pub struct ControlEntry<'a> {
    /// The other subject.
    subject: String,
    /// What the check finds on it.
    findings: Vec<FindingEntry<'a>>,
}

impl<'a> From<(String, &'a Vec<Finding>)> for ControlEntry<'a> {
    fn from((subject, findings): (String, &'a Vec<Finding>)) -> Self {
        ControlEntry { subject, findings: findings.iter().map(FindingEntry::from).collect() }
    }
}

/// A claim with its argument, its controls and its sources: what `verify --explain` writes.
#[derive(Serialize, JsonSchema)]
pub struct ExplanationEntry<'a> {
    #[serde(flatten)]
    outcome: OutcomeEntry<'a>,
    /// The proof, the counterexample or the experiment.
    argument: String,
    /// Path of the function that checks it.
    check: &'static str,
    /// Other subjects, which must come out otherwise.
    controls: Vec<ControlEntry<'a>>,
    /// Where the statement and what it is held against are from.
    sources: &'static [&'static str],
}

impl<'a> From<&'a JudgedClaim> for ExplanationEntry<'a> {
    fn from(outcome: &'a JudgedClaim) -> Self {
        ExplanationEntry {
            argument: outcome.claim.argument(),
            check: outcome.claim.check.path,
            controls: outcome.claim.controls().into_iter().zip(&outcome.controls).map(ControlEntry::from).collect(),
            sources: outcome.claim.sources,
            outcome: outcome.into(),
        }
    }
}

/// Indented JSON with a final newline.
///
/// # Errors
/// [`Error::Json`] if the value cannot be written as JSON.
///
/// ```
/// use moreau::report::json::pretty;
///
/// assert_eq!(pretty(&[0.5, 1e-9])?, "[\n  0.5,\n  1e-9\n]\n");
/// # Ok::<(), moreau::Error>(())
/// ```
pub fn pretty<T: Serialize + ?Sized>(value: &T) -> Result<String> {
    serde_json::to_string_pretty(value).map(|text| text + "\n").map_err(Error::Json)
}

/// JSON on one line, for what no one reads as it is.
///
/// # Errors
/// [`Error::Json`] if the value cannot be written as JSON.
pub fn compact<T: Serialize + ?Sized>(value: &T) -> Result<String> {
    serde_json::to_string(value).map(|text| text + "\n").map_err(Error::Json)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::text::tests::{CLAIM, outcome};
    use serde_json::Value;

    fn value<T: Serialize>(entry: &T) -> Value {
        serde_json::from_str(&pretty(entry).expect("plain data serialises")).expect("what was written parses")
    }

    #[test]
    fn an_outcome_is_one_flat_object() {
        let outcome = outcome(Status::Supported);
        let object = value(&OutcomeEntry::from(&outcome));
        assert_eq!(object["id"], CLAIM.id);
        assert_eq!(object["section"], "S4");
        assert_eq!(object["verdict"], "FALSE AS STATED");
        assert_eq!(object["status"], "supported");
        assert_eq!(object["findings"][0]["unit"], "m");
        assert_eq!(object.get("failure"), None);
    }

    #[test]
    fn formulas_are_in_unicode() {
        let all: Vec<ClaimEntry> = crate::claims::all().map(ClaimEntry::from).collect();
        assert!(!pretty(&all).expect("plain data").contains('$'));
        assert!(all.iter().any(|entry| entry.statement.contains("xᵀNx ≥ 0")));
    }

    #[test]
    fn a_finding_has_the_names_it_always_had_and_tells_how_much_of_its_bound_it_uses() {
        let finding = Finding::at_most("x", 1.0, 2.0, "m");
        let numbers = serde_json::json!({
            "name": "x", "measured": 1.0, "expected": 2.0, "tolerance": 0.0, "unit": "m", "relation": "at-most", "holds": true
        });
        assert_eq!(serde_json::to_value(&finding).expect("plain data"), numbers);
        let entry = value(&FindingEntry::from(&finding));
        assert_eq!(entry["used"], 0.5);
        assert!(numbers.as_object().expect("an object").iter().all(|(name, number)| entry[name] == *number), "{entry}");
        assert_eq!(value(&FindingEntry::from(&Finding::count("k", 3, 3))).get("used"), None);
    }

    #[test]
    fn a_failed_check_says_why_and_nan_becomes_null() {
        let mut outcome = outcome(Status::Failed("no convergence".into()));
        outcome.findings = vec![Finding::equal("x", f64::NAN, 1.0, 0.0, "m")];
        let object = value(&OutcomeEntry::from(&outcome));
        assert_eq!(object["status"], "failed");
        assert_eq!(object["failure"], "no convergence");
        assert!(object["findings"][0]["measured"].is_null());
    }

    #[test]
    fn an_explanation_adds_argument_control_and_sources() {
        let outcome = outcome(Status::Supported);
        let object = value(&ExplanationEntry::from(&outcome));
        assert_eq!(object["argument"], CLAIM.argument());
        assert_eq!(object["controls"][0]["findings"][0]["holds"], false);
        assert_eq!(object["sources"][0], CLAIM.sources[0]);
    }
}
