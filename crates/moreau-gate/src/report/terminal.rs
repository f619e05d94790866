//! The scoreboard for a terminal: a paragraph per engine, in lines of its width.

use super::scoreboard::{counted, families, marks};
use crate::cause::Cause;
use crate::report::counts;
use crate::scoreboard::Standing;
use moreau_checks::text::Style;

/// Every engine with its counts, the marks of its checks by family (which no line breaks apart), and what it does not pass; at last what
/// the marks mean.
pub fn table(standings: &[Standing], causes: &[Cause], style: Style) -> String {
    let engines: String = standings.iter().map(|standing| engine(standing, causes, style) + "\n").collect();
    let marks = "✓ as Coulomb–Signorini demands · ≈ different, as the engine's declared law predicts · ✗ fails · ! errored · – the engine \
                 does not do this; of every family in the order of `moreau gate --list`. `moreau gate --explain CHECK` explains a check, \
                 --html FILE has every number.";
    engines + &style.wrapped("", "", marks) + "\n"
}

fn engine(standing: &Standing, causes: &[Cause], style: Style) -> String {
    let name = style.heading(&standing.entry.name);
    let Some(report) = &standing.report else {
        let reason = standing.not_run.as_deref().unwrap_or("no reason stored");
        return style.wrapped("", "  ", &format!("{name}: not run: {reason}")) + "\n";
    };
    let head = format!("{name} ({} {}): {}", report.engine.name, report.engine.version, counts(report));
    let families = families().into_iter().map(|family| (family, marks(report, family))).filter(|(_, marks)| !marks.is_empty());
    let families: Vec<_> = families.map(|(family, marks)| format!("{family}\u{a0}{marks}")).collect();
    let mut lines = vec![style.wrapped("", "  ", &head), style.wrapped("  ", "  ", &families.join("  "))];
    let bad: Vec<_> = report.checks.iter().filter(|outcome| outcome.verdict.is_bad()).map(|outcome| outcome.check.as_str()).collect();
    if !bad.is_empty() {
        let why = counted(&standing.entry.name, report, causes);
        lines.push(style.wrapped("  ", "    ", &format!("{}: {} ({why})", style.no("not passed"), bad.join(", "))));
    }
    lines.join("\n") + "\n"
}
