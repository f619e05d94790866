//! `moreau verify`: runs the checks of the registered claims and reports what they found.

use super::claim_filters::Filters;
use super::near::suggestion;
use super::output::{print, style};
use super::outputs::{self, JSON};
use super::{Answer, Format};
use crate::claims::{self, CHAPTER, Claim, JudgedClaim, Status, matches_group};
use crate::files::write_atomically;
use crate::report::json::{ClaimEntry, ExplanationEntry, OutcomeEntry, pretty};
use crate::report::witnesses::WitnessDocument;
use crate::report::{explanation, text};
use crate::{Error, Result};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

/// Verify the claims of the chapter: verdict, evidence and the decisive number of each.
///
/// Every claim carries a check that computes: the recorded verdict must follow from the findings, and a control (another
/// subject, fed through the same check) must come out otherwise. Exit code 0
/// means that both hold for every claim that was run.
#[derive(clap::Args)]
#[command(after_help = format!("{EXAMPLES}\n\nThe chapter is {CHAPTER}."))]
pub struct Arguments {
    #[command(flatten)]
    filters: Filters,
    /// Explain one claim: proof or counterexample, findings, corrected statement, controls, sources.
    #[arg(long, value_name = "ID", conflicts_with_all = ["filter", "section", "search", "verdict", "severity", "kind"])]
    explain: Option<String>,
    /// List the claims without running them.
    #[arg(long, conflicts_with = "explain")]
    list: bool,
    /// Also write what the claims were decided from, in fractions, for scripts/check_witnesses.py or any other program.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["explain", "list"])]
    export: Option<PathBuf>,
    /// How to write the result.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  moreau verify                           run every claim
  moreau verify --filter S4               only the claims of section 4
  moreau verify --explain S4.copos-plus   one claim in full
  moreau verify --list                    the claims, without running them
  moreau verify --list --search zeno      those that speak of Zeno
  moreau verify --list --verdict false --severity theorem --section 4
  moreau verify --format json             an array of {id, section, statement, verdict, kind, severity,
                                          evidence, correct_statement, places, findings,
                                          figures, status, seconds}

A verdict is derived from the findings: each says what the sentence says of its instance, and supports
the sentence or refutes it. The figures count deciding findings, those that a control finds otherwise, and context.
--explain marks a finding [supports] or [refutes ]: the sentence, or what its correction says beside it;
[beside] is context and decides nothing. Under a control a finding keeps the name it has with the recorded
subject. A rounded number has as many digits as its bound supports, two of the bound; JSON has all.

Verdicts: true, conditional (holds under conditions the text omits), false as stated, inconsistent
(the text says two things that exclude each other), ambiguous (readings differ in truth). In JSON they
are TRUE, TRUE WITH CONDITIONS, FALSE AS STATED, INTERNALLY INCONSISTENT and AMBIGUOUS, and severities
have hyphens (broken-theorem); the options take the short words of `--help`.
Evidence: exact (rational arithmetic), certified (residual below a derived bound), measured, cited,
not decidable.";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    if let Some(id) = &arguments.explain {
        return explain(id, arguments.format);
    }
    let claims = arguments.filters.select()?;
    if arguments.list {
        print(&match arguments.format {
            Format::Text => style().fitted(&text::list(&claims, style())),
            Format::Json => pretty(&claims.iter().map(|&claim| ClaimEntry::from(claim)).collect::<Vec<_>>())?,
        })?;
        return Ok(Answer::Yes);
    }
    if arguments.export.as_deref() == Some(Path::new("-")) {
        return Err(Error::Unsupported("--export needs the name of a file: standard output has the report".into()));
    }
    outputs::require("--export", arguments.export.as_deref(), JSON)?;
    let outcomes = judge_all(&claims, if arguments.export.is_some() { claims::judge_with_witnesses } else { claims::judge });
    print(&match arguments.format {
        Format::Text => text::outcomes(&outcomes, style()),
        Format::Json => pretty(&outcomes.iter().map(OutcomeEntry::from).collect::<Vec<_>>())?,
    })?;
    if let Some(file) = &arguments.export {
        let document = WitnessDocument::of(&outcomes, arguments.filters.selection(), claims::all().count());
        write_atomically(file, pretty(&document)?.as_bytes())?;
    }
    Ok(conclusion(&outcomes))
}

fn explain(id: &str, format: Format) -> Result<Answer> {
    let claim = claims::find(id).ok_or_else(|| {
        let is_group = claims::all().any(|claim| matches_group(claim.id, id));
        let cure = if is_group { format!("this is a group, which `moreau verify --filter {id}` runs") } else { of_part(id) };
        Error::Unsupported(format!("no claim `{id}`; {cure}"))
    })?;
    let outcome = judge(claim, claims::judge);
    print(&match format {
        Format::Text => explanation::explanation(&outcome, style()),
        Format::Json => pretty(&ExplanationEntry::from(&outcome))?,
    })?;
    Ok(conclusion(&[outcome]))
}

/// What to do about a part of an id or of a title: ids that begin so, else those that are spelt nearly so, and how to list the claims that
/// have it as a word.
fn of_part(id: &str) -> String {
    let begins = |claim: &&Claim| claim.id.to_lowercase().starts_with(&id.to_lowercase());
    let beginning: Vec<String> = claims::all().filter(begins).take(3).map(|claim| format!("`{}`", claim.id)).collect();
    let ids = || claims::all().map(|claim| claim.id);
    let near = match beginning.as_slice() {
        [] => suggestion(id, ids(), "`moreau verify --list` shows every id"),
        some => format!("did you mean {}?", some.join(" or ")),
    };
    if claims::all().any(|claim| claims::has_words(claim, id)) {
        format!("{near} `moreau verify --list --search {id}` lists the claims that have this word")
    } else {
        near
    }
}

/// How a claim is judged.
pub(super) type Judge = fn(&'static Claim) -> JudgedClaim;

/// Judges claims in parallel; the answer is in the order of the question.
fn judge_all(claims: &[&'static Claim], by: Judge) -> Vec<JudgedClaim> {
    let bar = ProgressBar::new(claims.len() as u64); // hidden unless standard error is a terminal
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} claims  {elapsed}") {
        bar.set_style(style);
    }
    let outcomes = claims.par_iter().map(|claim| judge(claim, by)).inspect(|_| bar.inc(1)).collect();
    bar.finish_and_clear();
    outcomes
}

/// Judges one claim; a check that panics fails alone instead of taking the others with it.
pub(super) fn judge(claim: &'static Claim, by: Judge) -> JudgedClaim {
    catch_unwind(|| by(claim)).unwrap_or_else(|_| JudgedClaim {
        claim,
        findings: Vec::new(),
        controls: Vec::new(),
        witnesses: Vec::new(),
        status: Status::Failed("the check panicked".into()),
        seconds: 0.0,
    })
}

/// Yes if every outcome is supported; a run that judged nothing has shown nothing.
fn conclusion(outcomes: &[JudgedClaim]) -> Answer {
    let shown = !outcomes.is_empty() && outcomes.iter().all(|outcome| outcome.status == Status::Supported);
    shown.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::CheckFunction;
    use crate::report::text::tests::{CLAIM, outcome};
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn one_unsupported_claim_makes_the_answer_no() {
        assert_eq!(conclusion(&[outcome(Status::Supported)]), Answer::Yes);
        assert_eq!(conclusion(&[]), Answer::No);
        for status in [Status::Contradicted, Status::ControlPassed, Status::Failed("x".into())] {
            assert_eq!(conclusion(&[outcome(Status::Supported), outcome(status)]), Answer::No);
        }
    }

    #[test]
    fn outcomes_keep_the_order_of_the_claims() {
        static SLOW: Claim = Claim { id: "S4.slow", check: CheckFunction { run: slow, path: "slow" }, ..CLAIM };
        fn slow(reading: claims::Reading) -> Result<Vec<crate::checks::Finding>> {
            std::thread::sleep(std::time::Duration::from_millis(20));
            (CLAIM.check.run)(reading)
        }
        let ids: Vec<_> = judge_all(&[&SLOW, &CLAIM], claims::judge).iter().map(|outcome| outcome.claim.id).collect();
        assert_eq!(ids, ["S4.slow", "S4.example"]);
    }

    #[test]
    fn a_panicking_check_fails_alone() {
        static BROKEN: Claim = Claim { id: "S4.broken", check: CheckFunction { run: |_| panic!("on purpose"), path: "broken" }, ..CLAIM };
        for by in [claims::judge, claims::judge_with_witnesses] {
            let outcomes = judge_all(&[&BROKEN, &CLAIM], by);
            assert!(matches!(outcomes[0].status, Status::Failed(_)));
            assert_eq!(outcomes[1].status, Status::Supported);
            assert_eq!(conclusion(&outcomes), Answer::No);
        }
    }

    #[test]
    fn an_export_runs_a_check_as_often_as_a_plain_run_does() {
        static RUNS: AtomicUsize = AtomicUsize::new(0);
        static COUNTED: Claim = Claim { id: "S4.counted", check: CheckFunction { run: counted, path: "counted" }, ..CLAIM };
        fn counted(reading: claims::Reading) -> Result<Vec<crate::checks::Finding>> {
            RUNS.fetch_add(1, Ordering::Relaxed);
            (CLAIM.check.run)(reading)
        }
        judge_all(&[&COUNTED], claims::judge_with_witnesses);
        assert_eq!(RUNS.load(Ordering::Relaxed), 1 + CLAIM.controls.len());
    }
}
