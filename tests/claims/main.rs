//! One named trial per claim of the registry; `cargo test --test claims S4` runs one section.
//!
//! A trial judges the claim and its control. Then it breaks the judgement on purpose: no other verdict may be supported by the same
//! findings, and with what the sentence says in place of what was found the verdict must become "true". Numbers that use a bound must not
//! have moved from what is stored.

mod numbers;
mod regression;
#[path = "../architecture/strip.rs"]
mod strip;

use libtest_mimic::{Arguments, Failed, Trial};
use moreau::checks::{Finding, Voice};
use moreau::claims::{self, ClaimVerdict, Evidence, JudgedClaim, Status};
use numbers::{Sources, unaccounted};
use regression::{Number, Stored, complaints, stored};
use std::sync::Arc;

const VERDICTS: [ClaimVerdict; 5] =
    [ClaimVerdict::True, ClaimVerdict::Conditional, ClaimVerdict::False, ClaimVerdict::Inconsistent, ClaimVerdict::Ambiguous];

fn supported(outcome: &JudgedClaim) -> Result<(), Failed> {
    if outcome.status == Status::Supported {
        return Ok(());
    }
    let line = |finding: &Finding| format!("\n  [{}] {finding}", if finding.holds() { "holds" } else { "FAILS" });
    let lines = |findings: &[Finding]| findings.iter().map(line).collect::<String>();
    Err(format!(
        "{:?}{}\n control:{}",
        outcome.status,
        lines(&outcome.findings),
        outcome.controls.iter().map(|control| lines(control)).collect::<String>()
    )
    .into())
}

/// No other verdict is supported by these findings: recorded verdicts that differ cannot be exchanged.
fn no_other_verdict(outcome: &JudgedClaim) -> Result<(), Failed> {
    for other in VERDICTS.into_iter().filter(|other| *other != outcome.claim.verdict) {
        if claims::conclude(other, &outcome.findings, &outcome.controls) == Status::Supported {
            return Err(format!("the findings support {other:?} as well").into());
        }
    }
    Ok(())
}

/// With what the sentence says in place of what was found every finding supports it. Two passages that differ still do.
fn as_stated(outcome: &JudgedClaim) -> Result<(), Failed> {
    let opinion = outcome.findings.iter().any(|finding| matches!(finding.bearing.voice, Voice::Opinion(_)));
    let stated: Vec<_> = outcome.findings.iter().map(Finding::as_stated).collect();
    match claims::derive(&stated) {
        Ok(ClaimVerdict::True) => Ok(()),
        _ if opinion || outcome.claim.verdict == ClaimVerdict::Inconsistent => Ok(()),
        other => Err(format!("with found := stated the verdict is {other:?}").into()),
    }
}

/// The recorded grade is the one that follows from the findings that decide.
fn graded(outcome: &JudgedClaim) -> Result<(), Failed> {
    let grade = claims::grade(&outcome.findings);
    if grade == outcome.claim.evidence {
        Ok(())
    } else {
        Err(format!("recorded is {:?}; its findings give {grade:?}", outcome.claim.evidence).into())
    }
}

/// An exact claim has a witness that another program can decide again.
fn witnessed(outcome: &JudgedClaim) -> Result<(), Failed> {
    if outcome.claim.evidence == Evidence::Exact && outcome.witnesses.is_empty() {
        return Err("it is graded exact, and none of its decisions is told as a witness".into());
    }
    Ok(())
}

/// Every number of the argument is found, fed in, printed or the number of a place.
fn accounted(outcome: &JudgedClaim, sources: &Sources) -> Result<(), Failed> {
    let missing = unaccounted(outcome, sources);
    if missing.is_empty() { Ok(()) } else { Err(format!("no finding and no datum: {}", missing.join(" | ")).into()) }
}

/// No number that uses a bound has moved from what is stored by more than its regression bound, which catches a planted mistake.
fn unmoved(outcome: &JudgedClaim, known: &Stored) -> Result<(), Failed> {
    let known = known.get(outcome.claim.id).map(Vec::as_slice).unwrap_or_default();
    let used = outcome.findings.iter().filter(|finding| finding.used().is_some());
    let numbers: Vec<_> = used
        .map(|finding| Number { name: finding.name.clone(), measured: finding.measured, expectation: finding.expectation.clone() })
        .collect();
    match complaints(known, &numbers) {
        told if told.is_empty() => Ok(()),
        told => Err(told.join("\n").into()),
    }
}

fn main() {
    let sources = Arc::new(Sources::read());
    let known = Arc::new(stored("claims"));
    let unknown: Vec<_> = known.keys().filter(|id| claims::find(id).is_none()).cloned().collect();
    let trials = claims::all().map(|claim| {
        let (sources, known) = (Arc::clone(&sources), Arc::clone(&known));
        Trial::test(claim.id, move || {
            let outcome = claims::judge_with_witnesses(claim);
            supported(&outcome)?;
            graded(&outcome)?;
            witnessed(&outcome)?;
            accounted(&outcome, &sources)?;
            unmoved(&outcome, &known)?;
            no_other_verdict(&outcome)?;
            as_stated(&outcome)
        })
    });
    let planted = Trial::test("what is taken for a number of a result", || numbers::planted().map_err(Failed::from));
    let owned = Trial::test("every stored number belongs to a claim", move || {
        if unknown.is_empty() { Ok(()) } else { Err(format!("stored for no claim: {unknown:?}").into()) }
    });
    libtest_mimic::run(&Arguments::from_args(), trials.chain([planted, owned]).collect()).exit();
}
