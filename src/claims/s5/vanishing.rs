//! Claims of §5 on h → 0: what vanishes, what does not, and what the relaxation converges to.

use crate::claims::experiments::planar_step::Block;
use crate::claims::prelude::*;
use crate::problem::Law;

/// The claims of this file.
pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "S5.Oh-vanish",
        statement: r"The price of the relaxation is an artefact of order $h$ that vanishes with $h$; it is not a permanent deviation.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"For motions that meet the contact compatibly (free landing, sliding that grows from stick, a slide started at
            $\varphi = \mu h|v_t|$) the error is $O(h)$. A tangential velocity imposed in closed contact ($\varphi = 0$, $v_t = V$: a
            shock, a moving belt) makes the body hop by $(\mu V)^2/(2g(1 + \mu^2)^2)$, whatever $h$.",
        argument: r"From $\varphi = 0$, $v = (0, V)$ the step projects on $u_n \ge \mu|u_t|$: $v_n = (\mu V - \mu^2hg)/(1 + \mu^2)$,
            $v_t = (V - \mu hg)/(1 + \mu^2)$, and flight follows. With $\mu = 1/2$, $V = 1$ m/s, $g = 10$ m/s² the gap rises to at least
            $1/125\,\mathrm{m} = 8$ mm for steps of a hundredth and of a thousandth of a second (exact steps; the limit is exactly 8 mm),
            while Coulomb's step stays at $\varphi = 0$. Started at $\varphi = \mu hV$ the gap never exceeds $\mu hV$.",
        controls: &[
            r"The compatible start $\varphi = \mu hV$ in place of $\varphi = 0$.",
            r"The shock under the relaxation, $\varphi = 0$, in place of the compatible slide and of Coulomb's step.",
        ],
        sources: &["chapter §5, convergence theorem and pitfalls", "exact steps of the convex program"],
        check: check!(hop),
    },
    Claim {
        id: "S5.conv2006",
        statement: r"Convergence theorem (Anitescu 2006): as $h \to 0$, and the relaxation parameter with it, the solutions of the convex
            step converge to solutions of the differential variational inequality, that is of the MDI.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"The limit satisfies the weak measure differential inclusion: no penetration, impulses in the friction cone.
            It is a motion of Signorini–Coulomb with $e = 0$ for motions that meet the contact compatibly; where a tangential velocity
            meets a closed contact, the limit separates with $v_n = \mu V/(1 + \mu^2)$.",
        argument: r"After one step from $\varphi = 0$, $v_t = V = 1$ m/s ($\mu = 1/2$, $g = 10$ m/s²) $v_n = 2/5 - 2h$: the sequence
            converges, to 2/5 m/s. All gaps are non-negative and all impulses in the cone, which is what the weak inclusion asks.
            Coulomb's law with $e = 0$, which the text calls the correct physics, asks $v_n = 0$; from the gap $\mu\,h\,V$ the limit is 0.
            The paper itself was not read; the statement is judged as printed here.",
        controls: &[
            r"Coulomb's step in place of the relaxed one: its limit is $v_n = 0$.",
            r"A penetration of 1 cm that does not shrink with $h$ in place of either gap: it is thrown out, the faster the shorter the
                step.",
            r"$\mu = 1$ in the step, 1/2 in the cone.",
        ],
        sources: &["chapter §5, convergence theorem"],
        check: check!(weak_limit),
    },
];

/// A block on level ground, μ = ½, moving at 1 m/s from the given gap.
fn shoved(law: Law, gap: Rational) -> Block {
    Block {
        law,
        gap,
        normal_gravity: ratio(10, 1),
        tangential_gravity: ratio(0, 1),
        velocity: [ratio(0, 1), ratio(1, 1)],
        ..Block::at_rest(ratio(1, 2))
    }
}

/// The largest gap in the first 9/100 s, longer than the flight of 2v_n/g = 8/100 s.
fn largest_gap(mut block: Block, denominator: i64) -> Result<f64> {
    let h = ratio(1, denominator);
    let mut largest = block.gap.clone();
    for _ in 0..9 * denominator / 100 {
        block.step(&h)?;
        largest = if block.gap > largest { block.gap.clone() } else { largest };
    }
    Ok(crate::scalar::Scalar::to_f64(&largest))
}

/// What an O(h) error takes.
const COMPATIBLE: &str = "no tangential velocity meets a closed contact, φ ≥ μ h |v_t|";

fn hop(reading: Reading) -> Result<Vec<Finding>> {
    let compatible = |denominator: i64| ratio(1, 2 * denominator);
    let shocked = |denominator: i64| {
        let start = reading.only(0).pick(ratio(0, 1), compatible(denominator));
        largest_gap(shoved(Law::Associated, start), denominator)
    };
    let (fine, coarse) = (shocked(1000)?, shocked(100)?);
    let mut findings = vec![
        // order h: a tenth of the gap with h = 1/100; half of it is allowed
        Finding::at_least("largest gap after a shock, h = 1/1000 over h = 1/100", fine / coarse, 0.5, "1")
            .says_at_most(0.5)
            .violating(COMPATIBLE),
        Finding::at_least("largest gap after a shock, h = 1/1000", fine, 1.0 / 125.0, "m").context(),
        Finding::at_least("largest gap after a shock, h = 1/100", coarse, 1.0 / 125.0, "m").context(),
    ];
    for denominator in [1000, 100] {
        let (start, law) = reading.only(1).pick((compatible(denominator), Law::Coulomb), (ratio(0, 1), Law::Associated));
        let slide = largest_gap(shoved(Law::Associated, start), denominator)?;
        findings.push(Finding::at_most(
            format!("largest gap of a compatible slide, h = 1/{denominator}"),
            slide,
            0.5 / denominator as f64,
            "m",
        ));
        let coulomb = largest_gap(shoved(law, ratio(0, 1)), denominator)?;
        findings.push(Finding::at_most(format!("largest gap of Coulomb's step, h = 1/{denominator}"), coulomb, 0.0, "m"));
    }
    Ok(findings)
}

/// v_n after one step of size h from a gap, and whether gap and impulse are admissible for μ = ½.
fn first_step(law: Law, friction: &Rational, gap: Rational, h: &Rational) -> Result<(Rational, bool)> {
    let mut block = Block { friction: friction.clone(), ..shoved(law, gap) };
    let impulse: DVector<Rational> = block.step(h)?;
    let friction = crate::scalar::Scalar::magnitude(&impulse[1]);
    let admissible = block.gap >= ratio(0, 1) && friction <= ratio(1, 2) * impulse[0].clone();
    Ok((block.velocity[0].clone(), admissible))
}

fn weak_limit(reading: Reading) -> Result<Vec<Finding>> {
    let law = reading.only(0).pick(Law::Associated, Law::Coulomb);
    let half = ratio(1, 2);
    let friction = reading.only(2).pick(half.clone(), ratio(1, 1));
    let step = |gap: Rational, h: &Rational| first_step(law, &friction, reading.only(1).pick(gap, ratio(-1, 100)), h);
    let (coarse, one) = step(ratio(0, 1), &ratio(1, 100))?;
    let (fine, other) = step(ratio(0, 1), &ratio(1, 200))?;
    let (finest, third) = step(ratio(0, 1), &ratio(1, 400))?;
    // v_n is linear in h, so extrapolation gives the limit exactly
    let limit = |fine: &Rational, coarse: &Rational| ratio(2, 1) * fine - coarse;
    let (compatible, _) = step(ratio(1, 200), &ratio(1, 100))?;
    let (finer, _) = step(ratio(1, 400), &ratio(1, 200))?;
    let (coulomb, _) = first_step(Law::Coulomb, &half, ratio(0, 1), &ratio(1, 400))?;
    Ok(vec![
        Finding::exact("limit of v_n as h → 0", &limit(&fine, &coarse), &ratio(2, 5), "m/s").says(coulomb).violating(COMPATIBLE),
        Finding::exact("limit of v_n from the gap μ h v_t", &limit(&finer, &compatible), &ratio(0, 1), "m/s"),
        Finding::exact("Cauchy ratio of the differences", &((coarse - fine.clone()) - ratio(2, 1) * (fine - finest)), &ratio(0, 1), "m/s"),
        Finding::decision("no penetration, impulses in the cone", one && other && third, true),
    ])
}
