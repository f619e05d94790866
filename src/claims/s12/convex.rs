//! Claims of §12 on exercise 3: the worked example as a convex program, and a tangential direction beside it.

use crate::claims::experiments::planar_step::{Block, PlanarStep};
use crate::claims::prelude::*;
use crate::problem::{Law, Lcp};
use crate::solvers::lemke::solution;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[Claim {
    id: "S12.ex3",
    statement: r"Exercise: write the convex QP of each step; is it equivalent to the LCP in one dimension without friction? With a
        tangential direction (friction, horizontal initial velocity) LCP and relaxation begin to differ by an $O(h)$ gliding: show it.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Exercise,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Exact,
    correct_statement: r"They are: the one-dimensional QP and LCP have the same solution. With friction they differ only while the contact
        slides, by the gap $\mu h|v_t|$; they agree where it sticks, with a horizontal velocity too.",
    argument: r"QP: min $\tfrac12P^2 - 1.585\,P$ over $P \ge 0$ has the minimiser $\max(0, 1.585) = 317/200$, which is the solution of the
        LCP $0 \le P \perp P - 317/200 \ge 0$ of the chapter’s contact step. With 1 m/s along the ground and $\mu = \tfrac12$ the ball
        slides, and the relaxed step lifts it by $\mu\,h\,v_t$ more, for $h = 1/100$ and 1/200; with ½ m/s the impact stops it and both
        laws give the same velocity. On a slope, $h = 1/200$, $\mu = \tfrac12$: Coulomb slides at $\varphi = 0$ and the relaxed step at
        $\varphi = \mu\,h\,v_t$ exactly.",
    controls: &[
        "A landing at 1 m/s, which slides, in place of the one that sticks.",
        r"The LCP with $e\,v_\text{free}$ in the place of $e\,v$.",
        "Coulomb's law in the place of the relaxation.",
    ],
    sources: &["chapter §12, exercise 3"],
    check: check!(exercise),
}];

/// v⁺ of the example's contact step with a velocity along the ground, (normal, tangential), g h = 10 h, μ = ½.
fn landing(law: Law, sideways: &Rational, h: &Rational) -> Result<DVector<Rational>> {
    let incoming = ratio(-99, 100);
    let restitution = ratio(1, 2) * &incoming;
    let free = [incoming - ratio(10, 1) * h, sideways.clone()];
    Ok(PlanarStep::point(free, restitution, ratio(1, 2)).solve(law)?.velocity)
}

fn exercise(reading: Reading) -> Result<Vec<Finding>> {
    let (free, reversed) = (ratio(-317, 200), ratio(-109, 100) * ratio(3, 2));
    let vector = reading.only(1).pick(free.clone(), reversed);
    let lcp = Lcp::new(DMatrix::from_element(1, 1, ratio(1, 1)), DVector::from_element(1, vector));
    let by_lcp = solution(&lcp)?[0].clone();
    // ½P² + fP = ½(P + f)² − ½f²: smaller nowhere on P ≥ 0 than at the LCP's solution
    let objective = |p: &Rational| ratio(1, 2) * p.clone() * p.clone() + free.clone() * p.clone();
    let better = (0..400).filter(|&k| objective(&ratio(k, 100)) < objective(&by_lcp)).count();
    let mut findings = vec![
        Finding::exact("P of the LCP", &by_lcp, &ratio(317, 200), "N·s"),
        Finding::count("points of a grid on P ≥ 0 with a smaller objective", better, 0),
    ];
    let law = reading.only(2).pick(Law::Associated, Law::Coulomb);
    for inverse in [100, 200] {
        let h = ratio(1, inverse);
        let (relaxed, exact) = (landing(law, &ratio(1, 1), &h)?, landing(Law::Coulomb, &ratio(1, 1), &h)?);
        let lift = &h * (&relaxed[0] - &exact[0]) / (ratio(1, 2) * &h * &relaxed[1]);
        findings.push(Finding::exact(format!("gap over μ h v_t after a landing that slides, h = 1/{inverse}"), &lift, &ratio(1, 1), "1"));
    }
    let (h, speed) = (ratio(1, 100), reading.only(0).pick(ratio(1, 2), ratio(1, 1)));
    let differ = landing(Law::Associated, &speed, &h)? != landing(Law::Coulomb, &speed, &h)?;
    findings.push(Finding::decision("the two differ at a landing with ½ m/s", differ, false).says(true).violating("the contact slides"));
    let slope = |law: Law| -> Result<Block> {
        let mut block = Block { law, ..Block::at_rest(ratio(1, 2)) };
        block.steps(25, &ratio(1, 200))?;
        Ok(block)
    };
    let (relaxed, exact) = (slope(law)?, slope(Law::Coulomb)?);
    let own_gap = ratio(1, 400) * &relaxed.velocity[1];
    findings.push(Finding::exact("φ/(μ h v_t) of the relaxed slide on a slope", &((relaxed.gap - exact.gap) / own_gap), &ratio(1, 1), "1"));
    Ok(findings)
}
