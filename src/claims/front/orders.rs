//! Front matter and table of misconceptions: the order of integrators at impacts.

use crate::claims::experiments::runge_kutta::{Impacts, Norm, order};
use crate::claims::prelude::*;
use crate::tolerance::claims::ORDER_GAP;

/// Claims of the preface.
pub const PREFACE: &[Claim] = &[Claim {
    id: "P.order-zero",
    statement: "Where the velocity jumps, the order of any high-order integrator (Runge–Kutta, Adams, Verlet) that rests on a smooth \
                right-hand side collapses to zero.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Measured,
    correct_statement: r#"Order 0 in the maximum norm of the velocity, order 1 in the position, and only for integrators that do not
        locate the impact. (§0 says "at most $O(h)$, first order", which fits both.)"#,
    argument: r"RK4 on $\ddot q = -g - 4q$ with $e = 0.8$, the velocity flipped at the end of the step that penetrates, through one
        impact: between the impact and that node the velocities differ by the jump $(1 + e)V$ for every $h$; the position at the end is
        wrong by $V(1 + e)$ times the lag, $O(h)$. Without any reaction the ball falls through the floor and the position is wrong by
        $O(1)$.",
    controls: &[
        "The integrator that sees no floor in the place of the one that flips: its position has order 0 as well.",
        "A run that ends before the impact, where the velocity does not jump.",
    ],
    sources: &["chapter, preface: what you miss without §0–§1"],
    check: check!(order_zero),
}];

/// Claims of the table of misconceptions.
pub const MISCONCEPTIONS: &[Claim] = &[Claim {
    id: "M.high-order",
    statement: r#""A high-order integrator (RK4) suits contact better" is a misconception: at impacts all integrators collapse to $O(h)$;
        convergence, energy and penetration are the criteria, not the order."#,
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Measured,
    correct_statement: "True of integrators that step over the impact, whatever their order in smooth phases. With the impact located \
        RK4 keeps order 4 until impacts accumulate (the same as S0.all-Oh).",
    argument: "The same RK4, the same ball on a spring: flipped after penetration the end position is of order 1; with the impact \
        bisected, of \
               order 4 through one, two and three impacts.",
    controls: &["The integrator that steps over the impact and the one that locates it, exchanged."],
    sources: &["chapter, table of misconceptions"],
    check: check!(high_order),
}];

fn order_zero(reading: Reading) -> Result<Vec<Finding>> {
    let count = reading.only(1).pick(1, 0);
    let judged = order(Impacts::Flipped, Norm::VelocitySup, count)?;
    let position = order(reading.only(0).pick(Impacts::Flipped, Impacts::Ignored), Norm::EndPosition, 1)?;
    let ignored = order(Impacts::Ignored, Norm::EndPosition, count)?;
    Ok(vec![
        Finding::equal("order in sup|v|, flipped after penetration", judged.slope, 0.0, ORDER_GAP, "1").experiment(),
        Finding::equal("order in q at the end, flipped after penetration", position.slope, 1.0, ORDER_GAP, "1")
            .experiment()
            .says(0.0)
            .violating("the error is that of the velocity"),
        Finding::equal("order in q at the end, impact ignored", ignored.slope, 0.0, ORDER_GAP, "1").experiment(),
    ])
}

fn high_order(reading: Reading) -> Result<Vec<Finding>> {
    let (locating, blind) = reading.pick((Impacts::Located, Impacts::Flipped), (Impacts::Flipped, Impacts::Located));
    let blind = order(blind, Norm::EndPosition, 1)?;
    let mut findings =
        vec![Finding::equal("order of RK4 in q, impact stepped over", blind.slope, 1.0, ORDER_GAP, "1").experiment().says_at_most(1.0)];
    for impacts in 1..=3 {
        let located = order(locating, Norm::EndPosition, impacts)?;
        let name = format!("order of RK4 in q, {impacts} impacts located");
        findings.push(
            Finding::equal(name, located.slope, 4.0, ORDER_GAP, "1").experiment().says_at_most(1.0).violating("the impact is stepped over"),
        );
    }
    Ok(findings)
}
