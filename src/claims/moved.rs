//! Whether a control finds a finding otherwise.
//!
//! ```text
//!     moved     another number is measured under the same name, a finite one, and it comes out otherwise twice:
//!               held against what the control expects and states, and held against what the recorded check expects and states
//! ```
//! The second keeps a control from moving a finding by another expectation, bound or statement. What a passage states follows from the
//! instance, so it is held against its own: see [`super::conclude`] for what a control of passages must show.

use crate::checks::{Finding, Voice};

/// The finding of the other list that stands in the place of this one of `findings`: the one of its name and of its turn among those of
/// that name.
pub fn counterpart<'a>(finding: &Finding, findings: &[Finding], others: &'a [Finding]) -> Option<&'a Finding> {
    let turn = findings.iter().filter(|other| other.name == finding.name).position(|other| std::ptr::eq(other, finding))?;
    others.iter().filter(|other| other.name == finding.name).nth(turn)
}

/// Whether the other list, that of a control, has another finding in the place of this one, by the rule of this module.
pub fn is_moved(finding: &Finding, findings: &[Finding], others: &[Finding]) -> bool {
    let differs = |other: &Finding| other.supports() != finding.supports() || other.holds() != finding.holds();
    counterpart(finding, findings, others).is_some_and(|other| {
        other.measured.is_finite() && measures_otherwise(other, finding) && differs(other) && differs(&held_against(finding, other))
    })
}

/// The findings of a control, each held against what its counterpart in the recorded check expects and states.
pub fn held_against_recorded(recorded: &[Finding], control: &[Finding]) -> Vec<Finding> {
    let held =
        |other: &Finding| counterpart(other, control, recorded).map_or_else(|| other.clone(), |finding| held_against(finding, other));
    control.iter().map(held).collect()
}

fn held_against(recorded: &Finding, other: &Finding) -> Finding {
    if matches!(recorded.bearing.voice, Voice::Passage(_)) { other.clone() } else { recorded.with_measured(other) }
}

/// Whether another number was found, and not only another one expected or stated.
fn measures_otherwise(other: &Finding, finding: &Finding) -> bool {
    let exact = |finding: &Finding| finding.exact.as_ref().map(|[found, _]| found.clone());
    other.measured.to_bits() != finding.measured.to_bits() || exact(other) != exact(finding)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moves(recorded: Finding, control: Finding) -> bool {
        let recorded = [recorded];
        is_moved(&recorded[0], &recorded, &[control])
    }

    fn within(measured: f64, expected: f64, tolerance: f64) -> Finding {
        Finding::equal("x", measured, expected, tolerance, "m")
    }

    #[test]
    fn another_number_that_comes_out_otherwise_moves() {
        assert!(moves(within(1.0, 1.0, 0.5), within(2.0, 1.0, 0.5)));
        assert!(!moves(within(1.0, 1.0, 0.5), within(1.25, 1.0, 0.5)));
        assert!(moves(Finding::count("k", 3, 3), Finding::count("k", 4, 3)));
    }

    #[test]
    fn another_expectation_bound_or_statement_moves_nothing() {
        assert!(!moves(within(1.0, 1.0, 0.5), within(1.0, 2.0, 0.5)));
        assert!(!moves(within(1.0, 1.0, 0.5), within(1.0 + 1e-9, 2.0, 0.5)));
        assert!(!moves(within(1.25, 1.0, 0.5), within(1.375, 1.0, 0.125)));
        assert!(!moves(Finding::count("k", 3, 3), Finding::count("k", 3, 4)));
        assert!(!moves(Finding::at_most("x", 1.0, 2.0, "m").says_at_most(1.5), Finding::at_most("x", 1.25, 2.0, "m").says_at_most(0.5)));
    }

    #[test]
    fn a_changed_expectation_may_not_excuse_the_number_either() {
        assert!(!moves(within(1.0, 1.0, 0.5), within(2.0, 2.0, 0.5)));
    }

    #[test]
    fn what_the_control_does_not_measure_is_not_moved() {
        assert!(!moves(within(1.0, 1.0, 0.5), Finding::equal("y", 2.0, 1.0, 0.5, "m")));
        assert!(!moves(within(1.0, 1.0, 0.5), within(f64::NAN, 1.0, 0.5)));
    }

    #[test]
    fn a_passage_is_held_against_its_own_statement() {
        let passage = |found: usize, stated: usize| Finding::count("k", found, 3).says(stated).passage("§1");
        assert!(moves(passage(3, 5), passage(0, 0)));
        assert!(!moves(passage(3, 5), passage(3, 3)));
    }

    #[test]
    fn a_control_is_held_against_the_recorded_statements() {
        let recorded = [Finding::count("k", 1, 1).says(2), within(1.0, 1.0, 0.5)];
        let control = [within(3.0, 3.0, 0.5), Finding::count("k", 1, 1)];
        let held = held_against_recorded(&recorded, &control);
        assert_eq!(held.iter().map(Finding::supports).collect::<Vec<_>>(), [false, false]);
    }
}
