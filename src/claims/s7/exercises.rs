//! The exercises of §7, and Routh's construction against which the planar laws are held.

use super::impacts::{ContactsLaw, impact, middle, pushed_rod, rod, rod_path};
use super::simultaneous::rod_above_supports;
use crate::claims::prelude::*;
use crate::closed_forms::rough_impact::RoughImpact;
use crate::closed_forms::two_body_impact::TwoBodyImpact;
use crate::impact_laws::routh::Path;
use crate::impact_laws::{moreau, newton, poisson, stronge};
use crate::problem::PlanarProblem;
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S7.ex1",
        statement: r"Exercise 1: two balls in central impact under Newton's law and conservation of momentum have
            $\Delta E = -\tfrac12(1 - e^2)\,\mu_{12}\,(v_1 - v_2)^2$, $\mu_{12} = m_1m_2/(m_1 + m_2)$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated; $v_1^+ = (m_1v_1 + m_2v_2 - e\,m_2(v_1 - v_2))/(m_1 + m_2)$ and
            $v_2^+ = (m_1v_1 + m_2v_2 + e\,m_1(v_1 - v_2))/(m_1 + m_2)$.",
        argument: r"$W = 1/\mu_{12}$ and $U^- = v_2 - v_1$ in Moreau's law give the impulse; the energies of both balls before and after
            it differ by the formula, in rationals, for masses 2/7, 1, 5 and $e = 0$, 1/3, 1.",
        controls: &["A second ball that is held on its course, as if its mass were infinite."],
        sources: &["chapter §7, exercise 1"],
        check: check!(two_balls),
    },
    Claim {
        id: "S7.ex2",
        statement: r"Exercise 2: find a counterexample like Kane's, for instance a rod that hits two fixed points at once; why may
            Newton's law, applied point by point with $e = 1$ at each, increase the total kinetic energy?",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"It depends on what “pointwise” means. With impulses computed as if each point were alone the rod gains
            energy. If both velocities are reversed, $U^+ = -U^-$, it does not: without friction that conserves energy, whatever the
            coupling. Further gains need unequal coefficients with a separating end, or friction.",
        argument: r"Rod of 1 kg and 2 m, supports at ±1, ±1/2, ±1/4 m, three pairs of velocities: $\Delta T = 0$ with $U^+ = -U^-$.
            Supports at ±1/4 m, $U^- = (-1, -1)$, impulses computed point by point: a gain of 832/361 J.",
        controls: &[
            "Two bodies of their own in the rod's place: each point is alone.",
            "Impulses computed point by point for the rods whose velocities are reversed.",
        ],
        sources: &["chapter §7, exercise 2"],
        check: check!(rod_on_two_points),
    },
    Claim {
        id: "S7.ex3",
        statement: r"Exercise 3: expand $-P \in N_{T_C}(v^+ + e\,v^-)$ for $v^- \approx 0$ and for $v^- < 0$; to which conditions does it
            reduce? By the section's own text to $v^+ \ge 0$ with resting contact, and to $v^+ = -e\,v^-$.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"For a contact that takes an impulse, $0 \le v^+ + e\,v^- \perp P \ge 0$. A contact that its neighbour lifts
            takes none and leaves faster than $-e\,v^-$.",
        argument: r"$W = 2$, $e = 1/2$: $v^+ = 1/2$ for $v^- = -1$. For small $v^- = -1/1000$ the same formula gives 1/2000: it tends to
            the resting case. Beside a contact that arrives at −4 m/s it leaves at 2 m/s.",
        controls: &["The contact without its neighbour.", "The restitution forgotten."],
        sources: &["chapter §7, exercise 3"],
        check: check!(two_cases),
    },
    Claim {
        id: "S7.routh",
        statement: r"With friction the compression impulse couples through $W$ into the tangential direction, so that the end of
            compression is not tied to the velocity ratio.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated, and solvable in closed form for one planar contact: the slip stops at
            $P_s = |U_t|/(\mu W_{tt} - sW_{nt})$, then sticks if $\mu \ge |W_{nt}|/W_{tt}$ and turns round otherwise; Newton, Poisson and
            Stronge end at different points of one path of at most two straight pieces.",
        argument: r"The rod, $e = 1$. $\mu = 1$ sticks: $P = (41/40, 3/8)$ and $(4/5, 6/25)$ under Newton and Poisson, so that the
            velocity ratio 1 is the impulse ratio 25/16. $\mu = 1/2$ turns round: $(368/385, 20/77)$ and $(296/385, 64/385)$, under
            Stronge $\Delta T = -0.055264$. With $W_{nt} > 0$ it slides on and the laws agree: $(8/7, -4/7)$. Each from the path and from
            the formulas by regime.",
        controls: &["The rod without friction, where the velocity ratio 1 is the impulse ratio 1.", r"$W_{nt}$ with the wrong sign."],
        sources: &["chapter §7, comparison of Poisson and Newton", "Routh 1905; Wang and Mason, J. Appl. Mech. 59 (1992) 635"],
        check: check!(routh),
    },
];

fn two_balls(reading: Reading) -> Result<Vec<Finding>> {
    let (mut findings, before) = (Vec::new(), [ratio(3, 2), ratio(-1, 1)]);
    for masses in [[ratio(2, 7), ratio(1, 1)], [ratio(5, 1), ratio(2, 7)]] {
        for e in [ratio(0, 1), ratio(1, 3), ratio(1, 1)] {
            let formula = TwoBodyImpact { masses: masses.clone(), velocities: before.clone(), restitution: e.clone() };
            let mut contact = impact(&[1], [-formula.closing_speed()]);
            contact.delassus *= ratio(1, 1) / reading.pick(formula.reduced_mass(), masses[0].clone());
            let given = moreau::frictionless(&contact, std::slice::from_ref(&e))?.impulse[0].clone();
            let [m1, m2] = &masses;
            let after = [&before[0] - &given / m1, &before[1] + &given / m2];
            let energy = |v: &[Rational; 2]| ratio(1, 2) * (m1 * &v[0] * &v[0] + m2 * &v[1] * &v[1]);
            let factor = ratio(1, 1) - &e * &e;
            let lost = -(ratio(1, 2) * factor * formula.reduced_mass() * formula.closing_speed() * formula.closing_speed());
            findings.push(Finding::exact(format!("ΔE, m = ({m1}, {m2}), e = {e}"), &(energy(&after) - energy(&before)), &lost, "J"));
            let first = (m1 * &before[0] + m2 * &before[1] - &e * m2 * formula.closing_speed()) / (m1 + m2);
            findings.push(Finding::exact(format!("v₁⁺, m = ({m1}, {m2}), e = {e}"), &after[0], &first, "m/s"));
        }
    }
    Ok(findings)
}

/// Rods above supports.
fn rods() -> Vec<PlanarProblem<Rational>> {
    let mut rods = Vec::new();
    for distance in [ratio(1, 1), ratio(1, 2), ratio(1, 4)] {
        for velocity in [[-1, -1], [-3, -1], [-2, 1]] {
            rods.push(rod_above_supports(&distance, velocity.map(|u| ratio(u, 1))));
        }
    }
    rods
}

fn rod_on_two_points(reading: Reading) -> Result<Vec<Finding>> {
    let pair = [ratio(1, 1), ratio(1, 1)];
    let law = reading.only(1).pick(newton::together as ContactsLaw, newton::uncoupled);
    let mut changes = 0;
    for rod in rods() {
        changes += usize::from(rod.energy_change(&law(&rod, &pair)?) != ratio(0, 1));
    }
    let near = rod_above_supports(&ratio(1, 4), [ratio(-1, 1), ratio(-1, 1)]);
    let alone = PlanarProblem::new(DMatrix::from_diagonal(&near.delassus.diagonal()), near.velocity.clone());
    let subject = reading.only(0).pick(near, alone);
    let uncoupled = subject.energy_change(&newton::uncoupled(&subject, &pair)?);
    Ok(vec![
        Finding::count("rods whose energy changes under Newton's law, e = 1", changes, 0)
            .says_at_least(1)
            .reading("as U⁺ = −U⁻ at both points"),
        Finding::exact("gain of uncoupled impulses, supports at ±1/4 m", &uncoupled, &ratio(832, 361), "J")
            .reading("as impulses computed point by point"),
    ])
}

fn two_cases(reading: Reading) -> Result<Vec<Finding>> {
    let half = ratio(1, 2);
    let e = reading.only(1).pick(half.clone(), ratio(0, 1));
    let end = |velocity: Rational| moreau::frictionless(&impact(&[2], [velocity]), std::slice::from_ref(&e));
    let lifted = match reading.only(0) {
        Reading::Recorded => moreau::frictionless(&middle([ratio(-1, 1), ratio(-4, 1)]), &[half.clone(), half.clone()])?,
        Reading::Control(_) => end(ratio(-1, 1))?,
    };
    Ok(vec![
        Finding::exact("v⁺ for v⁻ = −1, e = 1/2", &end(ratio(-1, 1))?.after[0], &half, "m/s"),
        Finding::exact("v⁺ for v⁻ = −1 beside a contact that arrives at −4 m/s", &lifted.after[0], &ratio(2, 1), "m/s")
            .says(half)
            .violating("an impulse acts"),
        Finding::exact("v⁺ for v⁻ = −1/1000", &end(ratio(-1, 1000))?.after[0], &ratio(1, 2000), "m/s").says_at_least(ratio(0, 1)),
    ])
}

/// The formulas by regime for an impact with rows (n, t).
fn formulas(impact: &PlanarProblem<Rational>, friction: Rational) -> RoughImpact<Rational> {
    let w = &impact.delassus;
    RoughImpact {
        delassus: [w[(0, 0)].clone(), w[(0, 1)].clone(), w[(1, 1)].clone()],
        approach: -impact.velocity[0].clone(),
        slide: impact.velocity[1].clone(),
        friction,
    }
}

/// ΔT of the rod that turns round under Stronge's law, e_* = 1, and by the formulas \[J\].
fn energetic(rod: &PlanarProblem<Rational>) -> Result<[f64; 2]> {
    let rounded = Path::new(super::impacts::rounded(rod), &0.5)?;
    let closed = formulas(&self::rod(), ratio(1, 2));
    let squared = closed.stronge_speed_squared(&ratio(1, 1)).ok_or_else(|| Error::Unsupported("the slip stops in compression".into()))?;
    let closed = RoughImpact {
        delassus: closed.delassus.map(|w| w.to_f64().value()),
        approach: closed.approach.to_f64().value(),
        slide: closed.slide.to_f64().value(),
        friction: 0.5,
    };
    let end = closed.impulse(closed.impulse_reaching(&squared.to_f64().value().sqrt()));
    Ok([rounded.impact().energy_change(&stronge::along(&rounded, 1.0)?), closed.energy_change(&end)])
}

fn routh(reading: Reading) -> Result<Vec<Finding>> {
    let e = ratio(1, 1);
    let mut findings = Vec::new();
    let tied = rod_path(&reading.only(0).pick(ratio(1, 1), ratio(0, 1)))?;
    let quotient = &newton::along(&tied, &e)?.impulse[0] / tied.compression_end() - ratio(1, 1);
    findings.push(Finding::exact("impulse ratio of the velocity ratio 1", &quotient, &ratio(25, 16), "1"));
    let cases = [("sticks", rod(), ratio(1, 1)), ("turns round", rod(), ratio(1, 2)), ("slides on", pushed_rod(), ratio(1, 2))];
    for (regime, impact, mu) in cases {
        let closed = formulas(&impact, mu.clone());
        let mut subject = impact;
        for place in [(0, 1), (1, 0)] {
            subject.delassus[place] *= reading.only(1).pick(ratio(1, 1), ratio(-1, 1));
        }
        let path = Path::new(subject, &mu)?;
        let ends = [(newton::along(&path, &e)?, closed.newton(&e)), (poisson::along(&path, &e)?, closed.poisson(&e))];
        for (law, (end, expected)) in ["Newton", "Poisson"].into_iter().zip(ends) {
            findings.push(Finding::exact(format!("P_n under {law}, the rod {regime}"), &end.impulse[0], &expected[0], "N·s"));
            findings.push(Finding::exact(format!("P_t under {law}, the rod {regime}"), &end.impulse[1], &expected[1], "N·s"));
        }
    }
    let [change, expected] = energetic(&reading.only(1).pick(rod(), pushed_rod()))?;
    findings.push(Finding::equal("ΔT under Stronge, μ = 1/2", change, expected, rounding(64, 1.0), "J"));
    Ok(findings)
}
