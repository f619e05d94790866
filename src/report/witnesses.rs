//! `verify --export`: what every exact claim was decided from, as JSON that any program can decide again.
//!
//! A claim holds its findings, with what the sentence says of each, and the witnesses of the exact decisions that its check made:
//! matrices, vectors, solutions, rays, minors, steps. Numbers are texts, fractions of whole numbers, so that nothing is rounded.

use crate::checks::{Finding, Stated, Value, Voice};
use crate::claims::Claim;
use crate::scalar::Rational;
use moreau_exact::witness::{Part, Witness};
use serde_json::{Map, Value as Json, json};

/// A claim with its findings and with the witnesses of the exact decisions that its check made.
pub type Witnessed = (&'static Claim, Vec<Finding>, Vec<Witness>);

/// The witnesses of these claims, one document; how many there are of what stands in front, so that a part is not taken for the whole.
pub fn document(claims: &[Witnessed]) -> Json {
    let counts = json!({
        "claims": claims.len(),
        "findings": claims.iter().map(|(_, findings, _)| findings.len()).sum::<usize>(),
        "witnesses": claims.iter().map(|(_, _, witnesses)| witnesses.len()).sum::<usize>(),
    });
    json!({ "schema": "witnesses/1", "counts": counts, "claims": claims.iter().map(entry).collect::<Vec<_>>() })
}

fn entry((claim, findings, witnesses): &Witnessed) -> Json {
    json!({
        "id": claim.id,
        "verdict": claim.verdict,
        "evidence": claim.evidence,
        "findings": findings.iter().map(finding).collect::<Vec<_>>(),
        "witnesses": witnesses.iter().map(witness).collect::<Vec<_>>(),
    })
}

/// What was found, what was expected and what the sentence says; exact numbers as fractions, decisions as 0 and 1.
fn finding(finding: &Finding) -> Json {
    let number = |text: &str| match text {
        "true" => "1".into(),
        "false" => "0".into(),
        other => other.to_string(),
    };
    let (found, expected) = match &finding.exact {
        Some([found, expected]) => (json!(number(found)), json!(number(expected))),
        None => (json!(finding.measured), json!(finding.expectation.value)),
    };
    let stated = finding.bearing.stated.as_ref().map(|Stated { relation, value }| match value {
        Value::Exact(value) => json!({ "relation": relation, "value": value.to_string() }),
        Value::Rounded(value) => json!({ "relation": relation, "value": value }),
    });
    let voice = match finding.bearing.voice {
        Voice::Sentence => Json::Null,
        Voice::Passage(name) => json!({ "passage": name }),
        Voice::Reading(name) => json!({ "reading": name }),
        Voice::Opinion(name) => json!({ "opinion": name }),
    };
    json!({
        "name": finding.name, "found": found, "expected": expected,
        "relation": finding.expectation.relation, "tolerance": finding.expectation.tolerance,
        "stated": stated, "violated": finding.bearing.violated, "voice": voice, "context": finding.bearing.context,
    })
}

fn witness(witness: &Witness) -> Json {
    let mut entry = Map::from_iter([("kind".to_string(), json!(witness.kind))]);
    entry.extend(witness.parts.iter().map(|(name, value)| ((*name).to_string(), part(value))));
    Json::Object(entry)
}

fn part(part: &Part) -> Json {
    let texts = |numbers: &[Rational]| numbers.iter().map(Rational::to_string).collect::<Vec<_>>();
    match part {
        Part::Number(number) => json!(number.to_string()),
        Part::Vector(vector) => json!(texts(vector)),
        Part::Matrix(rows) | Part::Vectors(rows) => json!(rows.iter().map(|row| texts(row)).collect::<Vec<_>>()),
        Part::Counts(counts) => json!(counts),
        Part::Word(word) => json!(word),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims;

    #[test]
    fn an_exact_decision_is_written_in_fractions() {
        let claim = claims::find("S4.copos-plus").expect("registered");
        let (findings, witnesses) = claims::witnesses(claim).expect("it can be carried out");
        let document = document(&[(claim, findings, witnesses)]);
        let kinds: Vec<_> = document["claims"][0]["witnesses"].as_array().expect("a list").iter().map(|one| one["kind"].clone()).collect();
        assert!(kinds.contains(&json!("copositive-plus")), "{kinds:?}");
        assert!(document["claims"][0]["findings"][0]["found"].is_string());
        let length = |name: &str| document["claims"][0][name].as_array().expect("a list").len();
        assert_eq!(document["counts"], json!({ "claims": 1, "findings": length("findings"), "witnesses": length("witnesses") }));
    }
}
