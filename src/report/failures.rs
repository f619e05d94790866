//! What to do about each failure of the gate: likely causes in order, for docs/failures.md.
//!
//! ```text
//!     causes(c) = ( causes found in engines that fail c, most configurations first ;
//!                   planted mistakes that fail c, those that fail fewest other checks first )
//! ```
//! Both are read from data: the stored scoreboard with its causes, and the planted engines with the checks that were shown to catch them.

use super::text::counted;
use crate::checks::planted::Kind;
use crate::gate::cause::{Cause, Component};
use crate::gate::planted::{self, Faulty, Planted};
use crate::gate::scoreboard::Standing;
use crate::gate::{Check, Verdict, checks};
use crate::matrix::STANDS;
use std::fmt::Write;

/// Where the section of a Markdown file begins.
pub const BEGIN: &str = "<!-- failures -->";
/// Where it ends.
pub const END: &str = "<!-- /failures -->";

/// Other checks that are named beside a planted mistake, at most.
const OTHERS: usize = 4;

/// What stands between [`BEGIN`] and [`END`]: what to try by kind of cause, then every check.
pub fn section(standings: &[Standing], causes: &[Cause]) -> String {
    let check = |check: &'static Check| of_check(check, standings, causes);
    format!("{}\n{}", remedies(), checks::all().map(check).collect::<Vec<_>>().join("\n"))
}

const COMPONENTS: [Component; 5] =
    [Component::Solver, Component::Discretisation, Component::Model, Component::Collision, Component::Interface];

/// What to try where a cause found in an engine is of this component.
fn of_component(component: Component) -> &'static str {
    match component {
        Component::Solver => "more iterations, a smaller stopping tolerance, another solver: if the number moves, the solver ended early",
        Component::Discretisation => {
            "`--steps` with halves of h: if the number moves with h, look at which contacts are active and when e acts"
        }
        Component::Model => {
            "declare the law that the engine documents; if it is declared, read the number as that law's, or change its parameters"
        }
        Component::Collision => "record contact points, normals and gaps of the scene, and look for one that is missing, late or turned",
        Component::Interface => "`moreau protocol-check`, then one sample by hand: units, frames, the time of the sample, sign of impulses",
        Component::Unknown => "what the evidence of the cause says was tried",
    }
}

/// What to try where a planted mistake of this kind fails the check as yours does.
fn of_kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Assembly => {
            "print W, u_free and the shift of one step, and compare them with `moreau simulate --dump-step` of the same scene"
        }
        Kind::Projection => "put the projection through `moreau gate --projection`",
        Kind::Solver => "certify one step's answer (`moreau certify`), or put the solver through `moreau gate --solver`",
        Kind::Scheme => {
            "one step by hand from the state before: which velocity moves the positions, which contacts are active, where e acts"
        }
        Kind::Certificate | Kind::ClosedForm => "compare with the closed form that `moreau gate --explain CHECK` names",
        Kind::Reader => "read the scene back from the engine: mass, inertia, friction and restitution of each pair, gravity",
        Kind::Report => "`moreau protocol-check`; what is declared in `describe` and what is reported must be what the engine does",
    }
}

fn singular(kind: Kind) -> &'static str {
    match kind {
        Kind::Assembly => "assembly",
        Kind::Projection => "projection",
        Kind::Solver => "solver",
        Kind::Certificate => "certificate",
        Kind::Scheme => "scheme",
        Kind::ClosedForm => "closed form",
        Kind::Reader => "reader",
        Kind::Report => "report",
    }
}

/// The two tables of what to try: by component of a cause, by kind of a planted mistake.
fn remedies() -> String {
    let row = |(word, cure): (&str, &str)| format!("| *{word}* | {cure} |\n");
    let kinds: Vec<Kind> = crate::checks::planted::KINDS.into_iter().filter(|kind| planted::all().any(|one| one.kind == *kind)).collect();
    let found: String = COMPONENTS.map(|component| row((component.word(), of_component(component)))).concat();
    let planted: String = kinds.iter().map(|kind| row((singular(*kind), of_kind(*kind)))).collect();
    format!("| found in an engine | try |\n|---|---|\n{found}\n| planted mistake of the | try |\n|---|---|\n{planted}")
}

/// One check: the question, how engines stand in it, likely causes in order.
fn of_check(check: &'static Check, standings: &[Standing], causes: &[Cause]) -> String {
    let mut text = format!("### {}\n\n{} {}\n", check.name, check.question, stand(check, standings));
    if let Some((_, why)) = STANDS.iter().find(|(name, _)| *name == check.name) {
        let _ = write!(text, "\nBeside its neighbours: {why}.\n");
    }
    text.push('\n');
    let lines = found(check, causes).into_iter().chain(planted_here(check));
    for (place, line) in lines.enumerate() {
        let _ = writeln!(text, "{}. {line}", place + 1);
    }
    text
}

/// How many stored configurations answer the check, and how many of them do not pass it.
fn stand(check: &Check, standings: &[Standing]) -> String {
    let reports = standings.iter().filter_map(|standing| standing.report.as_ref());
    let outcomes: Vec<Verdict> =
        reports.flat_map(|report| &report.checks).filter(|one| one.check == check.name).map(|one| one.verdict).collect();
    let answered = outcomes.iter().filter(|verdict| **verdict != Verdict::Unsupported).count();
    let bad = outcomes.iter().filter(|verdict| verdict.is_bad()).count();
    format!("Of {} on the scoreboard that answer it, {bad} do not pass.", counted(answered, "configuration"))
}

/// The causes found in engines, most configurations first; one mechanism that several engines have is one cause.
fn found(check: &Check, causes: &[Cause]) -> Vec<String> {
    let mut here: Vec<(&str, &str, Vec<&str>)> = Vec::new();
    for cause in causes.iter().filter(|cause| cause.checks.iter().any(|name| name == check.name)) {
        let engines = cause.engines.iter().map(String::as_str);
        match here.iter_mut().find(|(error, mechanism, _)| (*error, *mechanism) == (cause.error.word(), cause.cause.as_str())) {
            Some((_, _, known)) => known.extend(engines),
            None => here.push((cause.error.word(), &cause.cause, engines.collect())),
        }
    }
    here.sort_by_key(|(_, _, engines)| std::cmp::Reverse(engines.len()));
    here.iter().map(|(error, mechanism, engines)| format!("*{error}* ({}): {mechanism}", engines.join(", "))).collect()
}

/// The planted mistakes that fail the check, those that fail fewest others first.
fn planted_here(check: &Check) -> Vec<String> {
    let mut here: Vec<&Planted<Faulty>> = planted::all().filter(|one| one.subject.caught_by.contains(&check.name)).collect();
    here.sort_by_key(|one| one.subject.caught_by.len());
    here.iter().map(|one| format!("planted, *{}*: {}{}", singular(one.kind), one.mistake, beside(check, one))).collect()
}

/// `; then ball/zeno fails too`.
fn beside(check: &Check, one: &Planted<Faulty>) -> String {
    let others: Vec<String> = one.subject.caught_by.iter().filter(|name| **name != check.name).map(|name| format!("`{name}`")).collect();
    let more = if others.len() > OTHERS { format!(" and {} more", others.len() - OTHERS) } else { String::new() };
    match others.len() {
        0 => String::new(),
        1 => format!("; {} fails too", others[0]),
        count => format!("; {}{more} fail too", others[..count.min(OTHERS)].join(", ")),
    }
}
