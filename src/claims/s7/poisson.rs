//! Poisson's law: compression, restitution, and why it does not gain energy.

use super::impacts::{ContactsLaw, PathLaw, cradle, ends, frictionless_grid, gain, impact, middle, rod_path, rough_grid, two_phases};
use crate::claims::prelude::*;
use crate::impact_laws::routh::Path;
use crate::impact_laws::{moreau, newton, poisson};
use crate::problem::{PlanarProblem, Response};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S7.poisson-def",
        statement: r"Poisson: a compression phase from $v^-$ to zero relative velocity with the impulse $P_c$, then a restitution phase
            with $P_r = e\,P_c$.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Definition,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Well defined for one contact: with a positive definite $W$ compression always ends, even if the contact is
            driven down at first. With several contacts both phases are complementarity problems, and a contact may take more than
            $e\,P_c$.",
        argument: r"$W = (2, 4; 4, 9)$, $U^- = (-1, 1)$, $\mu = 1$: $U_n$ falls to −7/5 while the slip lasts, then compression ends at
            $p_c = 13/2$. Two contacts, $W = (2, -1; -1, 2)$, $U^- = (-1, -1/2)$, $e = (1, 0)$: the second takes 5/12 in restitution
            instead of 0, else it would be driven into the ground.",
        controls: &[r"$e = 1$ at both contacts, where $P_r = e\,P_c$.", "The contact that is driven down without its friction."],
        sources: &["chapter §7, Poisson's law", "Pfeiffer and Glocker, Multibody Dynamics with Unilateral Contacts (1996)"],
        check: check!(definition),
    },
    Claim {
        id: "S7.poisson-conserved",
        statement: "Poisson's law constrains the impulse, a conserved quantity, instead of the velocity; that is why it is more consistent \
            in energy.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongReason),
        evidence: Evidence::Exact,
        correct_statement: r"A contact impulse is not conserved: it is what the contact hands over, and total momentum is kept under every
            law. Prescribing impulse ratios does not by itself prevent a gain, neither Newton's outcome, which is also one of a prescribed
            ratio, nor Poisson's law at two rough contacts with unequal coefficients. For one contact the reason is that $dT/dP_n$ is
            concave along the path and negative at the end of compression (S7.poisson-better).",
        argument: r"The rod with $\mu = 1$: $p_c = 2/5$, and Newton's $e = 1$ is the impulse ratio 25/16, which gains 9/80 J; the ratio 1
            loses 9/125 J. Two rough contacts (S7.poisson-better) with the impulse ratios $(1, 0)$: +9/25 J.",
        controls: &["The impulse ratio 1 in the place of 25/16 and of 0.", "Newton's ratio 25/16 in the place of 1."],
        sources: &["chapter §7, Poisson's law and its comparison with Newton's"],
        check: check!(conserved),
    },
    Claim {
        id: "S7.poisson-better",
        statement: "With friction and several bodies Poisson's law is more consistent in energy than Newton's.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"One contact with friction never gains for $e \le 1$, nor do any number of frictionless contacts with any
            coefficients. Two contacts with friction and unequal coefficients may gain where Newton's law loses; for equal ones this is
            not decided here.",
        argument: r"One contact: $g = dT/dp = U_n - \mu|U_t|$ is concave along Routh's path and at most 0 at $p_c$, so its mean over
            $(0, (1 + e)p_c)$ is at most $g((1 + e)p_c/2) \le 0$. Frictionless: the end minimises the kinetic energy over
            $P_r \ge E\,P_c$, and $P_r = P_c$, which undoes compression, is allowed. Of a grid of planar impacts with $e = 1$ Poisson
            gains in none, Newton in some; the rod: −9/125 against +9/80. Of frictionless ones with four pairs of coefficients none gains.
            Two rough contacts, $W = (3, 1, 0, -3; 1, 2, -1, 0; 0, -1, 3, -1; -3, 0, -1, 4)$, $U^- = (-1, 0, -1, 1)$, $\mu = 1$,
            $e = (1, 0)$: Poisson's law gains 9/25 J; Newton's, $U_n^+ \ge -e\,U_n^-$ at each contact, loses 21/100 J.",
        controls: &[
            r"Equal coefficients, $e = 1$, at the two rough contacts.",
            "Newton's and Poisson's laws exchanged.",
            "The work of the normal impulse alone, without that of friction.",
        ],
        sources: &["chapter §7, table of impact laws", "Wang and Mason, J. Appl. Mech. 59 (1992) 635"],
        check: check!(consistent),
    },
    Claim {
        id: "S7.newton-eq-poisson-single",
        statement: r"For one contact without friction Newton's and Poisson's laws agree: $P_c = m_\text{eff}|v^-|$ and $v^+ = e|v^-|$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, $m_\text{eff} = 1/W$.",
        argument: r"$P_c = -U^-/W$, $P_c + P_r = -(1 + e)U^-/W$, $U^+ = -eU^-$. $W = 2$, 1/3, 7 and $e = 0$, 2/5, 1 along Routh's path
            without friction, in rationals.",
        controls: &["One contact with friction."],
        sources: &["chapter §7, comparison of Poisson and Newton"],
        check: check!(one_frictionless_contact),
    },
    Claim {
        id: "S7.newton-neq-poisson-multi",
        statement: r"With several bodies or friction the off-diagonal entries of $W$ couple the contacts, and prescribing impulse ratios
            gives another result than prescribing velocity ratios.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"With friction, unequal coefficients or a separating contact. Without friction, for one $e$ and $U^- \le 0$,
            Poisson's law is Moreau's, $P = (1 + e)P_c$, however large the off-diagonal entries; Newton's law for all contacts together
            differs from both only where its impulses would pull.",
        argument: r"With $P = (1 + e)P_c$: $U^+ + eU^- = (1 + e)U_c$, complementary to $P_c$, and $U^+ = (1 + e)U_c - eU^- \ge 0$. No
            difference in any impact of a grid with $e = 0$, 1/2, 1. With $e = (1, 0)$ some differ. Rod with friction, $e = 1$:
            $U_n^+ = 16/25$ under Poisson, 1 under Newton.",
        controls: &[
            "Unequal coefficients among the equal ones.",
            r"One $e$, no friction and contacts that arrive alike where the laws differ.",
        ],
        sources: &["chapter §7, comparison of Poisson and Newton"],
        check: check!(when_different),
    },
    Claim {
        id: "S7.compression-end",
        statement: "Compression ends at the instant at which all normal velocities are zero.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Zero at the contacts that carry a compression impulse; the others may already separate:
            $0 \le U_c \perp P_c \ge 0$.",
        argument: r"Three balls: $U_c = (0, 0)$. $W = (2, 1; 1, 2)$, $U^- = (-1, -1/4)$: $P_c = (1/2, 0)$ and $U_c = (0, 1/4)$, although
            both contacts approach.",
        controls: &[
            r"The pair with $U^- = (-1, -1)$, where both contacts take an impulse.",
            r"The end of restitution, $e = 1/2$, in the place of that of compression.",
        ],
        sources: &["chapter §7, comparison of Poisson and Newton"],
        check: check!(end_of_compression),
    },
];

fn definition(reading: Reading) -> Result<Vec<Finding>> {
    let friction = reading.only(1).pick(ratio(1, 1), ratio(0, 1));
    let path = Path::new(impact(&[2, 4, 4, 9], [ratio(-1, 1), ratio(1, 1)]), &friction)?;
    let stop = path.state(&ratio(1, 5)).normal;
    let pair = ends([ratio(-1, 1), ratio(-1, 2)]);
    let second = reading.only(0).pick(ratio(0, 1), ratio(1, 1));
    let phases = poisson::two_problems(&pair, &[ratio(1, 1), second.clone()])?;
    let restitution = &phases.end.impulse[1] - &phases.compression.impulse[1];
    let prescribed = second * &phases.compression.impulse[1];
    Ok(vec![
        Finding::exact("P_r − e P_c at the second of two contacts, e = (1, 0)", &(restitution - prescribed), &ratio(5, 12), "N·s")
            .says(ratio(0, 1))
            .violating("a single contact"),
        Finding::exact("p_c of a contact that is driven down at first", &path.compression_end(), &ratio(13, 2), "N·s"),
        Finding::exact("U_n where its slip stops, p = 1/5", &stop, &ratio(-7, 5), "m/s").context(),
    ])
}

fn conserved(reading: Reading) -> Result<Vec<Finding>> {
    let path = rod_path(&ratio(1, 1))?;
    let compression = path.compression_end();
    let ended = |quotient: Rational| path.outcome(&(&compression * (ratio(1, 1) + quotient)));
    let newton = ended(reading.only(0).pick(ratio(25, 16), ratio(1, 1)));
    let poisson = ended(reading.only(1).pick(ratio(1, 1), ratio(25, 16)));
    let rough = wedged();
    let second = reading.only(0).pick(ratio(0, 1), ratio(1, 1));
    let released = poisson::two_frictional_problems(&rough, &ones(), &[ratio(1, 1), second])?;
    let gained = rough.energy_change(&released.end);
    Ok(vec![
        Finding::exact("energy gained with the impulse ratio 25/16", &path.impact().energy_change(&newton), &ratio(9, 80), "J")
            .says_at_most(ratio(0, 1)),
        Finding::exact("energy gained by two rough contacts with the ratios (1, 0)", &gained, &ratio(9, 25), "J").says_at_most(ratio(0, 1)),
        Finding::exact("energy gained with the impulse ratio 1", &path.impact().energy_change(&poisson), &ratio(-9, 125), "J")
            .says_at_most(ratio(0, 1)),
        Finding::exact("U_n⁺ of the ratio 25/16, Newton's with e = 1", &ended(ratio(25, 16)).after[0], &ratio(1, 1), "m/s").context(),
        Finding::exact("impulse of compression", &compression, &ratio(2, 5), "N·s").context(),
    ])
}

fn gains_on_the_rough_grid(law: PathLaw) -> Result<usize> {
    let mut count = 0;
    for (path, _) in rough_grid()? {
        count += usize::from(gain(&path, law(&path, &ratio(1, 1)))? > ratio(0, 1));
    }
    Ok(count)
}

/// Gains without friction, four pairs of coefficients, separating contacts included.
fn gains_without_friction(law: ContactsLaw) -> Result<usize> {
    let mut count = 0;
    for impact in frictionless_grid(false) {
        for [first, second] in [[1, 0], [0, 1], [1, 1], [2, 1]] {
            let end = law(&impact, &[ratio(first, 2), ratio(second, 2)])?;
            count += usize::from(impact.energy_change(&end) > ratio(0, 1));
        }
    }
    Ok(count)
}

/// Impacts of the rough grid on which g = U_n − f μ|U_t| from 0 to 2p_c contradicts concavity or g(p_c) ≤ 0; dT/dp has f = 1.
fn breaks_of_concavity(rubbing: &Rational) -> Result<usize> {
    let mut count = 0;
    for (path, mu) in rough_grid()? {
        let g = |p: &Rational| {
            let state = path.state(p);
            state.normal - rubbing * &mu * state.tangential.magnitude()
        };
        let end = path.compression_end();
        let points: Vec<_> = (0..=8).map(|k| g(&(&end * ratio(k, 4)))).collect();
        let concave = points.windows(3).all(|w| &w[0] + &w[2] <= ratio(2, 1) * &w[1]);
        count += usize::from(!concave || points[4] > ratio(0, 1));
    }
    Ok(count)
}

/// Two rough contacts that wedge each other in compression.
fn wedged() -> PlanarProblem<Rational> {
    impact(&[3, 1, 0, -3, 1, 2, -1, 0, 0, -1, 3, -1, -3, 0, -1, 4], [-1, 0, -1, 1].map(|u| ratio(u, 1)))
}

fn ones() -> [Rational; 2] {
    [ratio(1, 1), ratio(1, 1)]
}

/// ΔT of two contacts with μ = 1 under Poisson's law and under Newton's, U_n⁺ ≥ −e U_n⁻.
fn gains_of_two_rough_contacts(restitution: &[Rational; 2]) -> Result<[Rational; 2]> {
    let impact = wedged();
    let phases = poisson::two_frictional_problems(&impact, &ones(), restitution)?;
    // Coulomb's law on (U_n⁺ + e U_n⁻, U_t⁺) with an e per contact is that without restitution on velocities moved by e U_n⁻
    let mut moved = impact.clone();
    for (contact, e) in restitution.iter().enumerate() {
        moved.velocity[2 * contact] += e * &impact.velocity[2 * contact];
    }
    let newton = impact.response(moreau::normal_only(&moved, &ones(), &ratio(0, 1))?.impulse);
    Ok([impact.energy_change(&phases.end), impact.energy_change(&newton)])
}

fn consistent(reading: Reading) -> Result<Vec<Finding>> {
    let path = rod_path(&ratio(1, 1))?;
    let [released, reversed] = gains_of_two_rough_contacts(&[ratio(1, 1), reading.only(0).pick(ratio(0, 1), ratio(1, 1))])?;
    let laws = [poisson::along as PathLaw, newton::along];
    let [poisson, newton] = reading.only(1).pick(laws, [laws[1], laws[0]]);
    let phases = reading.only(1).pick(two_phases as ContactsLaw, newton::together);
    let rubbing = reading.only(2).pick(ratio(1, 1), ratio(0, 1));
    let unequal = "equal coefficients";
    Ok(vec![
        Finding::count("planar impacts with friction that gain energy, e = 1", gains_on_the_rough_grid(poisson)?, 0),
        Finding::decision("Newton gains in some of them", gains_on_the_rough_grid(newton)? > 0, true),
        Finding::exact("energy gained by the rod", &gain(&path, poisson(&path, &ratio(1, 1)))?, &ratio(-9, 125), "J"),
        Finding::count("impacts on which dT/dp is not concave or positive at p_c", breaks_of_concavity(&rubbing)?, 0),
        Finding::count("frictionless impacts with any coefficients that gain", gains_without_friction(phases)?, 0),
        Finding::exact("energy gained by two rough contacts, e = (1, 0)", &released, &ratio(9, 25), "J")
            .says_at_most(ratio(0, 1))
            .violating(unequal),
        Finding::exact("energy gained under Newton less that under Poisson", &(&reversed - &released), &ratio(-57, 100), "J")
            .says_at_least(ratio(0, 1))
            .violating(unequal),
        Finding::exact("energy gained by the two under Newton", &reversed, &ratio(-21, 100), "J").context(),
        Finding::exact("energy gained by the rod under Newton", &gain(&path, newton::along(&path, &ratio(1, 1)))?, &ratio(9, 80), "J")
            .context(),
    ])
}

fn one_frictionless_contact(reading: Reading) -> Result<Vec<Finding>> {
    let friction = reading.pick(ratio(0, 1), ratio(1, 1));
    let (mut findings, mut wrong) = (Vec::new(), 0);
    for w in [ratio(2, 1), ratio(1, 3), ratio(7, 1)] {
        let mut contact = impact(&[2, 1, 1, 2], [ratio(-3, 2), ratio(1, 1)]);
        contact.delassus *= ratio(1, 2) * &w;
        let path = Path::new(contact, &friction)?;
        findings.push(Finding::exact(format!("P_c, W = {w}"), &path.compression_end(), &(ratio(3, 2) / &w), "N·s"));
        for e in [ratio(0, 1), ratio(2, 5), ratio(1, 1)] {
            wrong += usize::from(poisson::along(&path, &e)?.after[0] != e * ratio(3, 2));
        }
    }
    let elastic = poisson::along(&rod_path(&friction)?, &ratio(1, 1))?;
    findings.push(Finding::count("of these contacts with e = 0, 2/5, 1, those with U⁺ ≠ e|U⁻|", wrong, 0));
    findings.push(Finding::exact("U_n⁺ of the rod under Poisson, e = 1", &elastic.after[0], &ratio(1, 1), "m/s"));
    Ok(findings)
}

/// How many approaching impacts of the grid tell Poisson from Moreau, with these pairs of coefficients.
fn differences(pairs: &[[Rational; 2]]) -> Result<usize> {
    let mut count = 0;
    for impact in frictionless_grid(true) {
        for pair in pairs {
            count += usize::from(poisson::two_problems(&impact, pair)?.end != moreau::frictionless(&impact, pair)?);
        }
    }
    Ok(count)
}

fn when_different(reading: Reading) -> Result<Vec<Finding>> {
    let equal: Vec<_> = [ratio(0, 1), ratio(1, 2), ratio(1, 1)].into_iter().map(|e| [e.clone(), e]).collect();
    let unequal = vec![[ratio(1, 1), ratio(0, 1)]];
    let path = rod_path(&reading.only(1).pick(ratio(1, 1), ratio(0, 1)))?;
    let elastic = poisson::along(&path, &ratio(1, 1))?;
    let pulling: PlanarProblem<Rational> = middle([ratio(-1, 1), reading.only(1).pick(ratio(-1, 4), ratio(-1, 1))]);
    let pair = [ratio(1, 2), ratio(1, 2)];
    let [together, apart] = [newton::together(&pulling, &pair)?, moreau::frictionless(&pulling, &pair)?];
    let same_e = differences(&reading.only(0).pick(equal.clone(), unequal.clone()))?;
    let other_e = differences(&reading.only(1).pick(unequal, equal))?;
    Ok(vec![
        Finding::count("frictionless impacts that tell Poisson from Moreau", same_e, 0)
            .says_at_least(1)
            .violating("friction, unequal coefficients or a separating contact"),
        Finding::decision("some do with unequal coefficients", other_e > 0, true),
        Finding::exact("U_n⁺ of the rod with friction, Poisson, e = 1", &elastic.after[0], &ratio(16, 25), "m/s"),
        Finding::decision("Newton for all contacts together differs where an impulse pulls", together != apart, true),
    ])
}

fn end_of_compression(reading: Reading) -> Result<Vec<Finding>> {
    let second = reading.only(0).pick(ratio(-1, 4), ratio(-1, 1));
    let end = |impact: &PlanarProblem<Rational>| -> Result<Response<Rational>> {
        let phases = poisson::two_problems(impact, &[ratio(1, 2), ratio(1, 2)])?;
        Ok(reading.only(1).pick(phases.compression, phases.end))
    };
    let (pair, cradle) = (end(&middle([ratio(-1, 1), second]))?, end(&cradle())?);
    Ok(vec![
        Finding::decision("three balls: U_c = (0, 0)", cradle.after.iter().all(|u| *u == ratio(0, 1)), true),
        Finding::exact("U_c at the first contact of the pair", &pair.after[0], &ratio(0, 1), "m/s"),
        Finding::exact("U_c at the second", &pair.after[1], &ratio(1, 4), "m/s")
            .says(ratio(0, 1))
            .violating("an impulse of compression at every contact"),
        Finding::exact("P_c at the first", &pair.impulse[0], &ratio(1, 2), "N·s").context(),
        Finding::exact("P_c at the second", &pair.impulse[1], &ratio(0, 1), "N·s").context(),
    ])
}
