//! How hard the evidence is, in numbers: verdicts that follow from their findings, findings that decide, findings that a control moves.

use super::moved::is_moved;
use super::{JudgedClaim, Kind, original};
use crate::checks::Finding;
use schemars::JsonSchema;
use serde::Serialize;

/// The figures of some claims.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Figures {
    /// Claims.
    pub claims: usize,
    /// Claims that assert something; the others ask, define, cite, name a path, advise or value.
    pub assertions: usize,
    /// Claims that repeat another one, whose mistake is charged there.
    pub repeats: usize,
    /// Findings that decide.
    pub deciding: usize,
    /// Those of them that a control finds otherwise.
    pub moved: usize,
    /// Findings told beside the sentence.
    pub context: usize,
}

impl Figures {
    /// The figures of one judged claim.
    pub fn of(outcome: &JudgedClaim) -> Self {
        let deciding: Vec<_> = outcome.findings.iter().filter(|finding| !finding.bearing.context).collect();
        Figures {
            claims: 1,
            assertions: usize::from(outcome.claim.kind == Kind::Assertion),
            repeats: usize::from(original(outcome.claim.id).is_some()),
            deciding: deciding.len(),
            moved: deciding.iter().filter(|finding| Figures::moves(finding, outcome)).count(),
            context: outcome.findings.len() - deciding.len(),
        }
    }

    /// The figures of all these claims together.
    pub fn sum(outcomes: &[JudgedClaim]) -> Self {
        outcomes.iter().map(Figures::of).fold(Figures::default(), |sum, one| Figures {
            claims: sum.claims + one.claims,
            assertions: sum.assertions + one.assertions,
            repeats: sum.repeats + one.repeats,
            deciding: sum.deciding + one.deciding,
            moved: sum.moved + one.moved,
            context: sum.context + one.context,
        })
    }

    /// Whether a control finds this finding of the outcome otherwise.
    pub fn moves(finding: &Finding, outcome: &JudgedClaim) -> bool {
        outcome.controls.iter().any(|control| is_moved(finding, &outcome.findings, control))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::Status;
    use crate::report::text::tests::outcome;

    fn found(name: &str, value: usize) -> Finding {
        Finding::count(name, value, 1)
    }

    #[test]
    fn a_finding_is_moved_if_its_counterpart_in_the_control_comes_out_otherwise() {
        let mut judged = outcome(Status::Supported);
        judged.findings = vec![found("a", 1), found("a", 1), found("b", 1), found("c", 1), found("d", 7).context()];
        judged.controls = vec![vec![found("a", 1), found("a", 2), found("b", 1)]];
        let figures = Figures::of(&judged);
        assert_eq!((figures.deciding, figures.moved, figures.context), (4, 1, 1));
    }

    #[test]
    fn figures_add_up() {
        let sum = Figures::sum(&[outcome(Status::Supported), outcome(Status::Supported)]);
        assert_eq!((sum.claims, sum.deciding), (2, 2 * Figures::of(&outcome(Status::Supported)).deciding));
    }
}
