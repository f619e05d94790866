//! Moreau's law: what the inclusion says of velocities, friction and resting contact.

use super::impacts::{ContactsLaw, ends, middle, pushed_rod, rod, rough_grid, two_phases};
use crate::claims::prelude::*;
use crate::exact_particle::{Ball, BallState, BallStep as Step};
use crate::impact_laws::{moreau, newton};
use crate::problem::{PlanarProblem, Response};
use crate::schemes::Activation;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S7.moreau-def",
        statement: r"Moreau: $-P \in N_{T_C}(v^+ + e\,v^-)$; its normal component gives $v_n^+ = -e\,v_n^-$, as Newton.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Definition,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"$v_n^+ = -e\,v_n^-$ where $P > 0$, $v_n^+ \ge -e\,v_n^-$ elsewhere. A contact that separated before may so
            leave into the ground.",
        argument: r"$0 \le U^+ + eU^- \perp P \ge 0$. $W = (2, 1; 1, 2)$, $e = 1/2$, $U^- = (-1, -1/4)$: no impulse at the second contact,
            and $U_2^+ = 1/2$, more than $-eU_2^-$. $W = (2, -1; -1, 2)$, $e = 1$, $U^- = (-1, 1/2)$: $U^+ = (1, -1/2)$; the second
            contact approaches, and no impulse acts there.",
        controls: &[r"Poisson's law in Moreau's place, and a pair with $U^- = (-1, -1)$, where both contacts take an impulse."],
        sources: &["chapter §7, Moreau's law"],
        check: check!(definition),
    },
    Claim {
        id: "S7.moreau-dissipative",
        statement: r"Moreau: $v_n^+ = -e\,v_n^-$ as the inclusion $-P \in N_{T_C}(v^+ + e\,v^-)$, which dissipates friction automatically
            (along the tangent, maximal dissipation).",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"It depends on what $e$ multiplies. As printed, on the whole vector $v^+ + e\,v^-$, the law never gains
            energy: $\Delta T = P^T\bar U/(1 + e) - \tfrac12(1 - e)/(1 + e)\,P^TWP$ with $P^T\bar U \le 0$; but $e$ then acts along the
            tangent, which the chapter advises against. On the normal component, as the pitfall on tangential restitution and the table of
            symbols have it, friction may feed energy in: it is Newton's law wherever the slip does not turn round.",
        argument: r"The rod, $\mu = 1$: $\Delta T = 9/80$, 17/320, 0, −39/320 for $e = 1$, 9/10, 4/5, 1/2 with $e$ on the normal
            component; 0 and −3/20 for $e = 1$ and 1/2 with the whole vector, which gains in no planar impact of a grid. At $e = 1$ the
            normal impulse does no work, so the 9/80 J are the work of friction, $P_t\,(U_t^+ + U_t^-)/2$. Where the slip turns round it
            differs from Newton's law along Routh's path: $\mu = 1/2$ sticks, $P_n = 41/40$, where Routh's path gives 368/385.",
        controls: &["The whole vector in the place of the normal component.", "The normal component in the place of the whole vector."],
        sources: &["chapter §7, table of impact laws; the chapter's table of symbols for U, the pitfall on tangential restitution for e_t"],
        check: check!(automatic_dissipation),
    },
    Claim {
        id: "S7.moreau-no-split",
        statement: r"One formula covers collision and resting contact: for $v^- \approx 0$ the argument $v^+ + e\,v^-$ demands
            $v^+ \ge 0$, for $v^- < 0$ it enforces $v^+ = -e\,v^-$; no case distinction.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Where an impulse acts, or $v^- \approx 0$. A contact that needs no impulse leaves faster than $-e\,v^-$, or,
            if it separated before, with $v^+$ down to $-e\,v^-$: into the ground.",
        argument: r"A ball of 1 kg, $e = 1/2$: $v = 0$, $g\,h = 1/10$: $v^+ = 0$, $P = 1/10$. $v = -1$ without load: $v^+ = 1/2$; pulled
            away by 2 m/s it leaves at 1 m/s. $v = 1$ at zero gap with $g\,h = 13/10$: $v^+ = -3/10$, into the ground.",
        controls: &["The ball that arrives is not pulled away.", "Balls that are still a metre above the floor."],
        sources: &["chapter §7, the meaning of Moreau's choice"],
        check: check!(no_distinction),
    },
    Claim {
        id: "S7.atom",
        statement: r"In a collision $P$ takes the value of an atom of the impulse measure; in resting contact it is the ordinary force
            times the step.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: $P/h \to \infty$ in one case and $P/h = m\,g$ in the other.",
        argument: r"Ball of 1 kg, $g = 10$, $e = 1/2$. Resting: $P/h = 10$ N for $h = 1/10$, 1/100, 1/1000 s. Arriving at −1 m/s:
            $P = 3/2 + 10\,h$, which tends to $(1 + e)\,m|v^-|$.",
        controls: &["The two exchanged: the resting contact read as an atom, the impact as rest."],
        sources: &["chapter §7, the meaning of Moreau's choice"],
        check: check!(atom),
    },
    Claim {
        id: "S7.no-tangential-restitution",
        statement: "Tangential motion belongs to friction; forcing a tangential coefficient of restitution on it conflicts with the \
            friction cone and may gain energy.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Imposed as an equation, $U_t^+ = -e_t\,U_t^-$, it conflicts with the cone. Posed within the inclusion, with
            the cone, it does not. Either way it may gain energy for $e_t < e_n$, and in the inclusion most at $e_t = 0$, which is what
            the chapter recommends; $e_t = e_n$ never gains (S7.moreau-dissipative).",
        argument: r"The rod, $\mu = 1$, $e_n = 1$: $\Delta T = 9/80$, 9/320, 0 for $e_t = 0$, 1/2, 1 in the inclusion, at $e_t = 1/2$ with
            $P = (73/80, 3/16)$, inside the cone. With $e_n = 1$, $e_t = 1/2$ the inclusion leaves the cone in no planar impact of a grid,
            the equation in some.",
        controls: &[r"The equation $U_t^+ = -e_t\,U_t^-$ and the inclusion exchanged.", r"$e_t = e_n = 1$ in the place of $e_t = 1/2$."],
        sources: &["chapter §7, pitfall on tangential restitution"],
        check: check!(tangential_coefficient),
    },
    Claim {
        id: "S7.friction-bound",
        statement: r"In a collision the tangential impulse is bounded by the normal one, $\|\beta\| \le \mu P_n$, and its direction is set
            by the sliding.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "The bound holds. The direction is that against the sliding at every instant, not against the sliding before \
            the collision: once the end sticks, coupling sets it.",
        argument: r"The rod, $\mu = 1$, $e = 1$: $P_t = +3/8$ while the end slid at +3/5. With $W_{nt} = +3/2$ and $\mu = 1/2$ the slip
            never stops, and $P_t = -4/7$.",
        controls: &[r"The two rods exchanged; the equation $U_t^+ = -\tfrac12U_t^-$ in the place of Coulomb's law."],
        sources: &["chapter §7, pitfall on tangential restitution"],
        check: check!(bound_and_direction),
    },
];

fn definition(reading: Reading) -> Result<Vec<Finding>> {
    let law = reading.pick(moreau::frictionless as ContactsLaw, two_phases);
    let (lifted, e) = (middle([ratio(-1, 1), reading.pick(ratio(-1, 4), ratio(-1, 1))]), ratio(1, 2));
    let half = law(&lifted, &[e.clone(), e.clone()])?;
    let separating = ends([ratio(-1, 1), ratio(1, 2)]);
    let elastic = law(&separating, &[ratio(1, 1), ratio(1, 1)])?;
    Ok(vec![
        Finding::exact("U⁺ at a contact that takes an impulse", &elastic.after[0], &ratio(1, 1), "m/s"),
        Finding::exact("P at the contact that its neighbour lifts", &half.impulse[1], &ratio(0, 1), "N·s").context(),
        Finding::exact("U⁺ there", &half.after[1], &ratio(1, 2), "m/s").context(),
        Finding::exact("U⁺ + e U⁻ there", &(&half.after[1] + &e * &lifted.velocity[1]), &ratio(3, 8), "m/s")
            .says(ratio(0, 1))
            .violating("an impulse at the contact, P > 0"),
        Finding::exact("U⁺ at a contact that separated before", &elastic.after[1], &ratio(-1, 2), "m/s"),
        Finding::exact("its impulse", &elastic.impulse[1], &ratio(0, 1), "N·s"),
    ])
}

/// The rod under Coulomb's law with these coefficients of restitution.
fn on_the_rod(friction: Rational, normal: Rational, tangential: Rational) -> Result<(Response<Rational>, Rational)> {
    let rod = rod();
    let outcome = moreau::two_coefficients(&rod, &[friction], &normal, &tangential)?;
    let change = rod.energy_change(&outcome);
    Ok((outcome, change))
}

type PlanarLaw = fn(&PlanarProblem<Rational>, &Rational) -> Result<Response<Rational>>;

/// Coulomb's law on (U_n⁺ + U_n⁻, U_t⁺ + ½U_t⁻).
fn by_the_inclusion(impact: &PlanarProblem<Rational>, friction: &Rational) -> Result<Response<Rational>> {
    moreau::two_coefficients(impact, std::slice::from_ref(friction), &ratio(1, 1), &ratio(1, 2))
}

/// U_n⁺ = −U_n⁻ and U_t⁺ = −½U_t⁻, whatever the impulse.
fn by_the_equation(impact: &PlanarProblem<Rational>, _: &Rational) -> Result<Response<Rational>> {
    newton::together(impact, &[ratio(1, 1), ratio(1, 2)])
}

/// Whether the impulse of some planar impact lies outside the friction cone.
fn leaves_the_cone(law: PlanarLaw) -> Result<bool> {
    for (path, mu) in rough_grid()? {
        let end = law(path.impact(), &mu)?;
        if end.impulse[1].magnitude() > mu * &end.impulse[0] {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Planar impacts that gain energy, e = 0, 1/2, 1 on the normal component and this share of it on the sliding.
fn gains(share: &Rational) -> Result<usize> {
    let mut count = 0;
    for (path, mu) in rough_grid()? {
        for e in [ratio(0, 1), ratio(1, 2), ratio(1, 1)] {
            let end = moreau::two_coefficients(path.impact(), std::slice::from_ref(&mu), &e, &(&e * share))?;
            count += usize::from(path.impact().energy_change(&end) > ratio(0, 1));
        }
    }
    Ok(count)
}

const NORMAL: &str = "as e on the normal component";
const WHOLE: &str = "as e on the whole vector";

fn automatic_dissipation(reading: Reading) -> Result<Vec<Finding>> {
    let [normal, whole] = [reading.only(0).pick(ratio(0, 1), ratio(1, 1)), reading.only(1).pick(ratio(1, 1), ratio(0, 1))];
    let on_the_rod = |mu: Rational, e: Rational, share: &Rational| on_the_rod(mu, e.clone(), e * share);
    let mut findings = Vec::new();
    for (e, expected) in
        [(ratio(1, 1), ratio(9, 80)), (ratio(9, 10), ratio(17, 320)), (ratio(4, 5), ratio(0, 1)), (ratio(1, 2), ratio(-39, 320))]
    {
        let (_, change) = on_the_rod(ratio(1, 1), e.clone(), &normal)?;
        let name = format!("ΔT of the rod, e = {e}");
        findings.push(Finding::exact(name, &change, &expected, "J").says_at_most(ratio(0, 1)).reading(NORMAL));
    }
    let elastic = on_the_rod(ratio(1, 1), ratio(1, 1), &normal)?.0;
    let rubbed = &elastic.impulse[1] * (&elastic.after[1] + &rod().velocity[1]) * ratio(1, 2);
    let turning = on_the_rod(ratio(1, 2), ratio(1, 1), &ratio(0, 1))?.0;
    let along = newton::along(&super::impacts::rod_path(&ratio(1, 2))?, &ratio(1, 1))?;
    let [conserved, lost] = [ratio(1, 1), ratio(1, 2)].map(|e| on_the_rod(ratio(1, 1), e, &whole));
    findings.extend([
        Finding::exact("work of friction, e = 1", &rubbed, &ratio(9, 80), "J").says_at_most(ratio(0, 1)).reading(NORMAL),
        Finding::exact("whole vector, e = 1", &conserved?.1, &ratio(0, 1), "J").reading(WHOLE),
        Finding::exact("whole vector, e = 1/2", &lost?.1, &ratio(-3, 20), "J").reading(WHOLE),
        Finding::count("planar impacts that gain with the whole vector", gains(&whole)?, 0).reading(WHOLE),
        Finding::exact("P_n with μ = 1/2, e = 1", &turning.impulse[0], &ratio(41, 40), "N·s").context(),
        Finding::exact("and under Newton along Routh's path", &along.impulse[0], &ratio(368, 385), "N·s").context(),
    ]);
    Ok(findings)
}

/// A Moreau–Jean step of a ball of 1 kg at this height, h = 1/10 s.
fn step(height: &Rational, velocity: Rational, fall: Rational) -> Step<Rational> {
    let ball = Ball { mass: ratio(1, 1), gravity: fall * ratio(10, 1), restitution: ratio(1, 2) };
    ball.moreau_jean(&BallState { position: height.clone(), velocity }, &ratio(1, 2), Activation::Gap, &ratio(1, 10))
}

fn no_distinction(reading: Reading) -> Result<Vec<Finding>> {
    let (floor, height) = (ratio(0, 1), reading.only(1).pick(ratio(0, 1), ratio(1, 1)));
    let resting = step(&height, ratio(0, 1), ratio(1, 10));
    let arriving = step(&height, ratio(-1, 1), ratio(0, 1));
    let pulled = step(&floor, ratio(-1, 1), reading.only(0).pick(ratio(-2, 1), ratio(0, 1)));
    let leaving = step(&floor, ratio(1, 1), ratio(13, 10));
    Ok(vec![
        Finding::exact("v⁺ of a ball that separates into a large load", &leaving.motion.velocity, &ratio(-3, 10), "m/s").context(),
        Finding::exact("v⁺ at rest", &resting.motion.velocity, &ratio(0, 1), "m/s"),
        Finding::exact("P at rest", &resting.impulse, &ratio(1, 10), "N·s"),
        Finding::exact("v⁺ of an impact at −1 m/s", &arriving.motion.velocity, &ratio(1, 2), "m/s"),
        Finding::exact("v⁺ of a ball that arrives at −1 m/s and is pulled away by 2 m/s", &pulled.motion.velocity, &ratio(1, 1), "m/s")
            .says(ratio(1, 2))
            .violating("an impulse acts"),
    ])
}

fn atom(reading: Reading) -> Result<Vec<Finding>> {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(10, 1), restitution: ratio(1, 2) };
    let impulse = |velocity: &Rational, h: &Rational| {
        let state = BallState { position: ratio(0, 1), velocity: velocity.clone() };
        ball.moreau_jean(&state, &ratio(1, 2), Activation::Gap, h).impulse
    };
    let [arriving, resting] = reading.pick([ratio(-1, 1), ratio(0, 1)], [ratio(0, 1), ratio(-1, 1)]);
    let mut findings = Vec::new();
    for h in [ratio(1, 10), ratio(1, 100), ratio(1, 1000)] {
        let expected = ratio(3, 2) + ratio(10, 1) * &h;
        findings.push(Finding::exact(format!("P of an impact, h = {h} s"), &impulse(&arriving, &h), &expected, "N·s"));
        findings.push(Finding::exact(format!("P/h at rest, h = {h} s"), &(impulse(&resting, &h) / &h), &ratio(10, 1), "N"));
    }
    Ok(findings)
}

fn tangential_coefficient(reading: Reading) -> Result<Vec<Finding>> {
    let one = ratio(1, 1);
    let in_the_inclusion = |e_t: Rational| on_the_rod(one.clone(), one.clone(), e_t);
    let (end, change) = in_the_inclusion(reading.only(1).pick(ratio(1, 2), ratio(1, 1)))?;
    let [none, full] = [in_the_inclusion(ratio(0, 1))?.1, in_the_inclusion(ratio(1, 1))?.1];
    let laws = [by_the_inclusion as PlanarLaw, by_the_equation];
    let [inclusion, equation] = reading.only(0).pick(laws, [laws[1], laws[0]]);
    Ok(vec![
        Finding::exact("ΔT with e_n = 1, e_t = 1/2", &change, &ratio(9, 320), "J"),
        Finding::exact("P_n with e_t = 1/2", &end.impulse[0], &ratio(73, 80), "N·s"),
        Finding::exact("P_t with e_t = 1/2", &end.impulse[1], &ratio(3, 16), "N·s"),
        Finding::decision("with the equation U_t⁺ = −½U_t⁻ some impulse leaves the cone", leaves_the_cone(equation)?, true),
        Finding::decision("with the inclusion some impulse leaves the cone", leaves_the_cone(inclusion)?, false)
            .says(true)
            .violating("the coefficient is imposed as an equation"),
        Finding::exact("ΔT with e_t = 0", &none, &ratio(9, 80), "J").context(),
        Finding::exact("ΔT with e_t = 1", &full, &ratio(0, 1), "J").context(),
    ])
}

fn bound_and_direction(reading: Reading) -> Result<Vec<Finding>> {
    let stuck = moreau::normal_only(&rod(), &[ratio(1, 1)], &ratio(1, 1))?;
    let driven = moreau::normal_only(&pushed_rod(), &[ratio(1, 2)], &ratio(1, 1))?;
    let [stuck, driven] = reading.pick([&stuck, &driven], [&driven, &stuck]);
    let against = |tangential: Finding| tangential.says_at_most(ratio(0, 1));
    let law: PlanarLaw = |impact, mu| moreau::normal_only(impact, std::slice::from_ref(mu), &ratio(1, 1));
    Ok(vec![
        against(Finding::exact("P_t of the rod", &stuck.impulse[1], &ratio(3, 8), "N·s")).violating("sliding throughout the collision"),
        against(Finding::exact("P_t of the rod whose slip never stops", &driven.impulse[1], &ratio(-4, 7), "N·s")),
        Finding::decision("in some planar impact |P_t| > μP_n", leaves_the_cone(reading.pick(law, by_the_equation))?, false),
    ])
}
