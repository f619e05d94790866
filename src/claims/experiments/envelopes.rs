//! What a study of convergence shows in short: of every metric its order, and its constant at the finest step.

use crate::checks::Finding;

/// Of the findings of a study those on the order of each metric and on its constant at the finest step, under the name of the subject;
/// without sup|v|, which does not converge.
pub fn in_short(subject: &str, findings: Vec<Finding>) -> Vec<Finding> {
    let metric = |finding: &Finding| finding.name.split(": ").next().unwrap_or_default().to_string();
    let is_constant = |finding: &Finding| finding.name.contains(": constant at");
    let metrics: Vec<String> = findings.iter().map(metric).collect();
    let last_of = |index: usize| metrics.iter().rposition(|other| *other == metrics[index]) == Some(index);
    let kept = |index: usize, finding: &Finding| finding.name.ends_with(": order") || is_constant(finding) && last_of(index);
    let short = findings.into_iter().enumerate().filter(|(index, finding)| kept(*index, finding) && metrics[*index] != "sup|v|");
    short
        .map(|(_, mut finding)| {
            finding.name = format!("{subject}, {}", finding.name);
            finding
        })
        .collect()
}
