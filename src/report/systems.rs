//! The systems on their four axes: text for the terminal, a table for docs/systems.md.

use super::text::{Style, counted};
use crate::number::{significant, two_digits, with_unit};
use crate::systems::{AgreementReport, Report, SystemReport};
use crate::tolerance::systems::{DIGITS_SHOWN, SMALLEST_SHOWN};
use std::fmt::Write;

/// Where the table of a Markdown file begins.
pub const BEGIN: &str = "<!-- systems -->";
/// Where it ends.
pub const END: &str = "<!-- /systems -->";

/// One paragraph per system, where to learn more, and a count as the last line.
pub fn text(report: &Report, style: Style) -> String {
    let mut text = String::new();
    for system in &report.systems {
        let SystemReport { name, level, cone, law, algorithm, restitution, position_update, schemes, .. } = system;
        let mut line = |first: &str, next: &str, line: &str| text.push_str(&(style.wrapped(first, next, line) + "\n"));
        line("", "    ", &format!("{}   --scheme {}", style.heading(name), schemes.join(", ")));
        line("  ", "    ", &format!("level {level}, cone {cone}, law {law}, algorithm: {algorithm}"));
        line("  ", "    ", &format!("restitution: {restitution}; q⁺ = {position_update}"));
        for agreement in &system.held_against {
            let mark = if agreement.holds { style.yes("✓") } else { style.alarm("✗") };
            let found = agreement.difference.map_or("not a number".into(), significant);
            let bound = with_unit(&significant(agreement.tolerance), &agreement.unit);
            let used = agreement.used.map(|used| format!(" ({} of it)", two_digits(used))).unwrap_or_default();
            line("  ", "    ", &format!("{mark} {}: {}: {found}, at most {bound}{used}", agreement.against, agreement.quantity));
        }
        text.push('\n');
    }
    let agreements: Vec<_> = report.systems.iter().flat_map(|system| &system.held_against).collect();
    let outside = agreements.iter().filter(|agreement| !agreement.holds).count();
    let [systems, all] = [(report.systems.len(), "system"), (agreements.len(), "agreement")].map(|(count, word)| counted(count, word));
    text += &(style.wrapped("", "", EXPLAINED) + "\n");
    text + &format!("{systems}, {all}, {outside} outside the tolerance\n")
}

/// What the list does not show.
const EXPLAINED: &str = "`moreau compare SCENE` runs the schemes; `moreau verify --list --search NAME` finds the claims that speak of a \
                         simulator, `moreau verify --explain ID` explains one.";

/// What stands between [`BEGIN`] and [`END`]: one row per system.
pub fn markdown(report: &Report) -> String {
    let mut text = String::from(
        "| system | level | cone | law | algorithm | restitution | q⁺ | `--scheme` | agreement: measured (bound; measured/bound) \
            |\n|---|---|---|---|---|---|---|---|---|\n",
    );
    for system in &report.systems {
        let schemes: Vec<_> = system.schemes.iter().map(|name| format!("`{name}`")).collect();
        let agreements: Vec<_> = system.held_against.iter().map(agreement).collect();
        let SystemReport { name, level, cone, law, algorithm, restitution, position_update, .. } = system;
        let _ = writeln!(
            text,
            "| {name} | {level} | {cone} | {law} | {algorithm} | {restitution} | {position_update} | {} | {} |",
            schemes.join(", "),
            agreements.join("<br>")
        );
    }
    text
}

/// `exact rationals: velocity of a ball < 1e-14 m/s (5e-14; < 0.2)`, with a warning where it does not hold.
fn agreement(agreement: &AgreementReport) -> String {
    let warning = if agreement.holds { "" } else { "**outside** " };
    let AgreementReport { against, quantity, unit, tolerance, .. } = agreement;
    let bound = two_digits(*tolerance);
    let used = match agreement.difference {
        Some(difference) if *tolerance > 0.0 => format!("; {}", share(difference, *tolerance)),
        _ => String::new(),
    };
    format!("{warning}{against}: {quantity} {} ({bound}{used})", with_unit(&shown(agreement.difference), unit))
}

/// Two digits of a difference; of rounding only the power of ten above it, which is the same on every processor.
fn shown(difference: Option<f64>) -> String {
    match difference {
        None => "not a number".into(),
        Some(difference) if difference < DIGITS_SHOWN => format!("< 1e{}", power_above(difference)),
        Some(difference) => two_digits(difference),
    }
}

/// measured/bound, of what is shown of either.
fn share(difference: f64, tolerance: f64) -> String {
    if difference < DIGITS_SHOWN {
        return format!("< {}", two_digits(10f64.powi(power_above(difference)) / tolerance));
    }
    two_digits(difference / tolerance)
}

/// The power of ten above a difference.
fn power_above(difference: f64) -> i32 {
    difference.max(SMALLEST_SHOWN / 2.0).log10().ceil() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_shown_as_a_power_of_ten_and_an_error_by_two_digits() {
        assert_eq!(shown(Some(0.0)), "< 1e-16");
        assert_eq!(shown(Some(3.3e-14)), "< 1e-13");
        assert_eq!(shown(Some(0.012_345)), "0.012");
        assert_eq!(shown(Some(4.56e-6)), "4.6e-6");
        assert_eq!(shown(None), "not a number");
    }

    #[test]
    fn a_share_of_a_bound_is_shown_as_the_difference_is() {
        assert_eq!(share(3.3e-14, 5e-13), "< 0.2");
        assert_eq!(share(0.012_345, 0.1), "0.12");
    }
}
