//! Whether a control finds a finding otherwise.

use crate::checks::Finding;

/// Whether the other list has another finding in the place of this one: the one of its name, and of its turn among those of that name.
pub fn is_moved(finding: &Finding, findings: &[Finding], others: &[Finding]) -> bool {
    let namesakes = |all: &[Finding]| all.iter().filter(|other| other.name == finding.name).cloned().collect::<Vec<_>>();
    let turn = findings.iter().filter(|other| other.name == finding.name).position(|other| std::ptr::eq(other, finding));
    let counterpart = turn.and_then(|turn| namesakes(others).into_iter().nth(turn));
    counterpart.is_none_or(|other| other.supports() != finding.supports() || other.holds() != finding.holds())
}
