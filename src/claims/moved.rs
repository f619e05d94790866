//! Whether a control finds a finding otherwise.

use crate::checks::Finding;

/// Whether the other list has another finding in the place of this one, the one of its name and of its turn among those of that name: with
/// another number found, which comes out otherwise.
pub fn is_moved(finding: &Finding, findings: &[Finding], others: &[Finding]) -> bool {
    let namesakes = |all: &[Finding]| all.iter().filter(|other| other.name == finding.name).cloned().collect::<Vec<_>>();
    let turn = findings.iter().filter(|other| other.name == finding.name).position(|other| std::ptr::eq(other, finding));
    let counterpart = turn.and_then(|turn| namesakes(others).into_iter().nth(turn));
    let differs = |other: &Finding| other.supports() != finding.supports() || other.holds() != finding.holds();
    counterpart.is_none_or(|other| measures_otherwise(&other, finding) && differs(&other))
}

/// Whether another number was found, and not only another one expected or stated.
fn measures_otherwise(other: &Finding, finding: &Finding) -> bool {
    let exact = |finding: &Finding| finding.exact.as_ref().map(|[found, _]| found.clone());
    other.measured.to_bits() != finding.measured.to_bits() || exact(other) != exact(finding)
}
