//! Poisson's law: compression, restitution, and why it does not gain energy.

use super::impacts::{cradle, ends, frictionless_grid, gain, impact, middle, rod_path, rough_grid};
use crate::claims::prelude::*;
use crate::impact_laws::routh::Path;
use crate::impact_laws::{moreau, newton, poisson};
use crate::problem::{PlanarProblem, Response};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S7.poisson-def",
        statement: "Poisson: a compression phase from v⁻ to zero relative velocity with the impulse P_c, then a restitution phase with P_r \
            = e P_c.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Definition,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "Well defined for one contact: with a positive definite W compression always ends, even if the contact is \
            driven down at first. With several contacts both phases are complementarity problems, and a contact may take more than e P_c.",
        argument: "W = (2, 4; 4, 9), U⁻ = (−1, 1), μ = 1: U_n falls to −7/5 while the slip lasts, then compression ends at p_c = 13/2. Two \
            contacts, W = (2, −1; −1, 2), U⁻ = (−1, −1/2), e = (1, 0): P_c = (5/6, 2/3), but the second takes 5/12 in restitution instead \
            of 0, else it would be driven into the ground.",
        controls: &["e = 1 at both contacts, where P_r = e P_c."],
        sources: &["chapter §7, Poisson's law", "Pfeiffer and Glocker, Multibody Dynamics with Unilateral Contacts (1996)"],
        check: definition,
    },
    Claim {
        id: "S7.poisson-conserved",
        statement: "Poisson's law constrains the impulse, a conserved quantity, instead of the velocity; that is why it is more consistent \
            in energy.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongReason),
        evidence: Evidence::Exact,
        correct_statement: "A contact impulse is not conserved: it is what the contact hands over, and total momentum is kept under \
            every law. Prescribing impulse ratios does not by itself prevent a gain, neither Newton's outcome, which is also one of a \
            prescribed ratio, nor Poisson's law at two rough contacts with unequal coefficients. For one contact the reason is that \
            dT/dP_n is concave along the path and negative at the end of compression (S7.poisson-better).",
        argument: "The rod with μ = 1: p_c = 2/5, and Newton's e = 1 is the impulse ratio 25/16, which gains 9/80 J; the ratio 1 loses \
            9/125 J. Two rough contacts (S7.poisson-better) with the impulse ratios (1, 0): +9/25 J. Three balls keep their momentum \
            under Newton's law as under Poisson's.",
        controls: &["The impulse ratio 1 in the place of 25/16 and of 0."],
        sources: &["chapter §7, Poisson's law and its comparison with Newton's"],
        check: conserved,
    },
    Claim {
        id: "S7.poisson-better",
        statement: "With friction and several bodies Poisson's law is more consistent in energy than Newton's.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "One contact with friction never gains for e ≤ 1, nor do any number of frictionless contacts with any \
            coefficients. Two contacts with friction and unequal coefficients may gain where Newton's law loses; for equal ones this is \
            not decided here.",
        argument: "One contact: g = dT/dp = U_n − μ|U_t| is concave along Routh's path and at most 0 at p_c, so its mean over (0, \
            (1+e)p_c) is at most g((1+e)p_c/2) ≤ 0. Frictionless: the end minimises the kinetic energy over P_r ≥ E P_c, and P_r = P_c, \
            which undoes compression, is allowed. Of 150 planar impacts with e = 1 Poisson gains in none, Newton in some; the rod: \
            −9/125 against +9/80. Of 140 frictionless ones with four pairs of coefficients none gains. Two rough contacts, W = (3, 1, 0, \
            −3; 1, 2, −1, 0; 0, −1, 3, −1; −3, 0, −1, 4), U⁻ = (−1, 0, −1, 1), μ = 1, e = (1, 0): P_c = (4, −1, 2, 2)/5, P_r = (4, −2, \
            0, 0)/5, T from 1/2 to 43/50; Newton's law, U_n⁺ ≥ −e U_n⁻ at each contact, loses 21/100 J.",
        controls: &["Equal coefficients, e = 1, at the two rough contacts."],
        sources: &["chapter §7, table of impact laws", "Wang and Mason, J. Appl. Mech. 59 (1992) 635"],
        check: consistent,
    },
    Claim {
        id: "S7.newton-eq-poisson-single",
        statement: "For one contact without friction Newton's and Poisson's laws agree: P_c = m_eff|v⁻| and v⁺ = e|v⁻|.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated, m_eff = 1/W.",
        argument: "P_c = −U⁻/W, P_c + P_r = −(1 + e)U⁻/W, U⁺ = −eU⁻. W = 2, 1/3, 7 and e = 0, 2/5, 1 in rationals.",
        controls: &["One contact with friction."],
        sources: &["chapter §7, comparison of Poisson and Newton"],
        check: one_frictionless_contact,
    },
    Claim {
        id: "S7.newton-neq-poisson-multi",
        statement: "With several bodies or friction the off-diagonal entries of W couple the contacts, and prescribing impulse ratios \
            gives another result than prescribing velocity ratios.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "With friction, unequal coefficients or a separating contact. Without friction, for one e and U⁻ ≤ 0, Poisson's \
            law is Moreau's, P = (1 + e)P_c, however large the off-diagonal entries; Newton's law for all contacts together differs from \
            both only where its impulses would pull.",
        argument: "With P = (1 + e)P_c: U⁺ + eU⁻ = (1 + e)U_c, complementary to P_c, and U⁺ = (1 + e)U_c − eU⁻ ≥ 0. No difference in 60 \
            impacts (20 with three values of e). e = (1, 0), W = (2, −1; −1, 2), U⁻ = (−1, −1/2): P_r2 = 5/12 under Poisson, U⁺ differs. \
            Rod with friction, e = 1: U_n⁺ = 16/25 under Poisson, 1 under Newton.",
        controls: &["Unequal coefficients among the 60."],
        sources: &["chapter §7, comparison of Poisson and Newton"],
        check: when_different,
    },
    Claim {
        id: "S7.compression-end",
        statement: "Compression ends at the instant at which all normal velocities are zero.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "Zero at the contacts that carry a compression impulse; the others may already separate: 0 ≤ U_c ⟂ P_c ≥ 0.",
        argument: "Three balls: U_c = (0, 0). W = (2, 1; 1, 2), U⁻ = (−1, −1/4): P_c = (1/2, 0) and U_c = (0, 1/4), although both contacts \
            approach.",
        controls: &["The pair with U⁻ = (−1, −1), where both contacts take an impulse."],
        sources: &["chapter §7, comparison of Poisson and Newton"],
        check: end_of_compression,
    },
];

fn definition(reading: Reading) -> Result<Vec<Finding>> {
    let path = Path::new(impact(&[2, 4, 4, 9], [ratio(-1, 1), ratio(1, 1)]), &ratio(1, 1))?;
    let falling = path.pieces()[0].slopes.normal.clone();
    let stop = path.pieces()[1].start.normal.clone();
    let compressed = path.state(&path.compression_end());
    let pair = ends([ratio(-1, 1), ratio(-1, 2)]);
    let second = reading.pick(ratio(0, 1), ratio(1, 1));
    let phases = poisson::two_problems(&pair, &[ratio(1, 1), second.clone()])?;
    let restitution = &phases.end.impulse[1] - &phases.compression.impulse[1];
    let prescribed = second * &phases.compression.impulse[1];
    Ok(vec![
        Finding::exact("P_r at the second of two contacts, e = (1, 0)", &restitution, &ratio(5, 12), "N·s")
            .says(prescribed)
            .violating("a single contact"),
        Finding::exact("dU_n/dp while the slip drives the contact down", &falling, &ratio(-2, 1), "1/kg").context(),
        Finding::exact("U_n where the slip stops", &stop, &ratio(-7, 5), "m/s").context(),
        Finding::exact("p_c of that contact", &path.compression_end(), &ratio(13, 2), "N·s"),
        Finding::exact("U_n at p_c", &compressed.normal, &ratio(0, 1), "m/s"),
        Finding::exact("P_c of the first of two contacts", &phases.compression.impulse[0], &ratio(5, 6), "N·s"),
    ])
}

fn conserved(reading: Reading) -> Result<Vec<Finding>> {
    let path = rod_path(&ratio(1, 1))?;
    let compression = path.compression_end();
    let ended = |quotient: Rational| path.outcome(&(&compression * (ratio(1, 1) + quotient)));
    let subject = ended(reading.pick(ratio(25, 16), ratio(1, 1)));
    let rough = wedged();
    let released = poisson::two_frictional_problems(&rough, &ones(), &[ratio(1, 1), reading.pick(ratio(0, 1), ratio(1, 1))])?;
    let loses = poisson::along(&path, &ratio(1, 1));
    // momentum of three balls of 1 kg from their impulses: −P₁ + (P₁ − P₂) + P₂
    let cradle = cradle();
    let pair = [ratio(1, 2), ratio(1, 2)];
    let momentum = |end: &Response<Rational>| {
        let [first, second] = [end.impulse[0].clone(), end.impulse[1].clone()];
        [-first.clone(), &first - &second, second].into_iter().fold(ratio(0, 1), |sum, change| sum + change)
    };
    Ok(vec![
        Finding::exact("energy gained with the impulse ratio 25/16", &path.impact().energy_change(&subject), &ratio(9, 80), "J")
            .says_at_most(ratio(0, 1)),
        Finding::exact(
            "energy gained by two rough contacts with the ratios (1, 0)",
            &rough.energy_change(&released.end),
            &ratio(9, 25),
            "J",
        )
        .says_at_most(ratio(0, 1)),
        Finding::exact("U_n⁺ of that ratio, Newton's with e = 1", &ended(ratio(25, 16)).after[0], &ratio(1, 1), "m/s").context(),
        Finding::exact("energy gained with the impulse ratio 1", &gain(&path, loses)?, &ratio(-9, 125), "J"),
        Finding::exact("impulse of compression", &compression, &ratio(2, 5), "N·s"),
        Finding::exact("momentum gained by three balls under Newton", &momentum(&newton::together(&cradle, &pair)?), &ratio(0, 1), "N·s"),
        Finding::exact("under Poisson", &momentum(&poisson::two_problems(&cradle, &pair)?.end), &ratio(0, 1), "N·s"),
    ])
}

type ImpactLaw = fn(&Path<Rational>, &Rational) -> Result<Response<Rational>>;

fn gains_on_the_rough_grid(law: ImpactLaw) -> Result<usize> {
    let mut count = 0;
    for (path, _) in rough_grid()? {
        count += usize::from(gain(&path, law(&path, &ratio(1, 1)))? > ratio(0, 1));
    }
    Ok(count)
}

/// Gains of Poisson's law without friction, four pairs of coefficients, separating contacts included.
fn gains_without_friction() -> Result<usize> {
    let mut count = 0;
    for impact in frictionless_grid(false) {
        for [first, second] in [[1, 0], [0, 1], [1, 1], [2, 1]] {
            let end = poisson::two_problems(&impact, &[ratio(first, 2), ratio(second, 2)])?.end;
            count += usize::from(impact.energy_change(&end) > ratio(0, 1));
        }
    }
    Ok(count)
}

/// Impacts of the rough grid on which g = U_n − μ|U_t| at p_c, ½(1+e)p_c and (1+e)p_c contradicts concavity or g(p_c) ≤ 0.
fn breaks_of_concavity() -> Result<usize> {
    let mut count = 0;
    for (path, mu) in rough_grid()? {
        let g = |p: &Rational| {
            let state = path.state(p);
            state.normal - &mu * if state.tangential < ratio(0, 1) { -state.tangential } else { state.tangential }
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
    let [poisson, newton] = gains_of_two_rough_contacts(&[ratio(1, 1), reading.pick(ratio(0, 1), ratio(1, 1))])?;
    let unequal = "equal coefficients";
    Ok(vec![
        Finding::count("planar impacts with friction that gain energy, e = 1", gains_on_the_rough_grid(poisson::along)?, 0),
        Finding::decision("Newton gains in some of them", gains_on_the_rough_grid(newton::along)? > 0, true),
        Finding::exact("energy gained by the rod", &gain(&path, poisson::along(&path, &ratio(1, 1)))?, &ratio(-9, 125), "J"),
        Finding::count("impacts on which dT/dp is not concave or positive at p_c", breaks_of_concavity()?, 0),
        Finding::count("frictionless impacts with any coefficients that gain", gains_without_friction()?, 0),
        Finding::exact("energy gained by two rough contacts, e = (1, 0)", &poisson, &ratio(9, 25), "J")
            .says_at_most(ratio(0, 1))
            .violating(unequal),
        Finding::exact("the same under Newton", &newton, &ratio(-21, 100), "J").says_at_least(&poisson).violating(unequal),
    ])
}

fn one_frictionless_contact(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for w in [ratio(2, 1), ratio(1, 3), ratio(7, 1)] {
        for e in [ratio(0, 1), ratio(2, 5), ratio(1, 1)] {
            let mut contact = impact(&[1], [ratio(-3, 2)]);
            contact.delassus *= w.clone();
            let phases = poisson::two_problems(&contact, std::slice::from_ref(&e))?;
            findings.push(Finding::exact(format!("P_c, W = {w}"), &phases.compression.impulse[0], &(ratio(3, 2) / &w), "N·s"));
            let newton = newton::together(&contact, std::slice::from_ref(&e))?;
            findings.push(Finding::exact(format!("U⁺ of Poisson, e = {e}"), &phases.end.after[0], &newton.after[0], "m/s"));
        }
    }
    let path = rod_path(&reading.pick(ratio(0, 1), ratio(1, 1)))?;
    let elastic = poisson::along(&path, &ratio(1, 1))?;
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
    let path = rod_path(&ratio(1, 1))?;
    let elastic = poisson::along(&path, &ratio(1, 1))?;
    let pulling: PlanarProblem<Rational> = middle([ratio(-1, 1), ratio(-1, 4)]);
    let pair = [ratio(1, 2), ratio(1, 2)];
    let [together, apart] = [newton::together(&pulling, &pair)?, moreau::frictionless(&pulling, &pair)?];
    Ok(vec![
        Finding::count("frictionless impacts that tell Poisson from Moreau", differences(&reading.pick(equal, unequal.clone()))?, 0)
            .says_at_least(1)
            .violating("friction, unequal coefficients or a separating contact"),
        Finding::decision("some do with unequal coefficients", differences(&unequal)? > 0, true),
        Finding::exact("U_n⁺ of the rod with friction, Poisson, e = 1", &elastic.after[0], &ratio(16, 25), "m/s"),
        Finding::decision(
            "Newton for all contacts together differs where an impulse pulls",
            together != apart && together.impulse[1] < ratio(0, 1),
            true,
        ),
    ])
}

fn end_of_compression(reading: Reading) -> Result<Vec<Finding>> {
    let zero = [ratio(0, 1), ratio(0, 1)];
    let second = reading.pick(ratio(-1, 4), ratio(-1, 1));
    let pair = poisson::two_problems(&middle([ratio(-1, 1), second]), &zero)?.compression;
    let cradle = poisson::two_problems(&cradle(), &zero)?.compression;
    Ok(vec![
        Finding::exact("U_c at the cradle's second contact", &cradle.after[1], &ratio(0, 1), "m/s"),
        Finding::exact("U_c at the first contact of the pair", &pair.after[0], &ratio(0, 1), "m/s"),
        Finding::exact("U_c at the second", &pair.after[1], &ratio(1, 4), "m/s")
            .says(ratio(0, 1))
            .violating("an impulse of compression at every contact"),
        Finding::exact("P_c at the second", &pair.impulse[1], &ratio(0, 1), "N·s").context(),
    ])
}
