//! Newton's law: what it keeps, what it takes.

use super::impacts::{ContactsLaw, PathLaw, cradle, ends, frictionless_grid, gain, impact, middle, rod, rod_path, two_phases};
use crate::claims::prelude::*;
use crate::impact_laws::energy_projection::energy;
use crate::impact_laws::{moreau, newton, poisson, stronge};
use crate::problem::{PlanarProblem, Response};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S7.newton-single",
        statement: r"The naive law $v_n^+ = -e\,v_n^-$ is fine for one contact point; it goes wrong when several points collide at once or
            when there is friction.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated. For one contact without friction $\Delta T = -\tfrac12(1 - e^2)(U^-)^2/W$. With friction one
            contact is enough to gain energy; with several, one law for all of them may need an impulse that pulls, and unequal
            coefficients may gain.",
        argument: r"$W = 2$, $U^- = -1$: $\Delta T = 0$ at $e = 1$ and −3/16 at $e = 1/2$. One contact of a rod, $\mu = 1$, $e = 1$:
            $\Delta T = +9/80$. $W = (2, 1; 1, 2)$, $U^- = (-1, -1/2)$, $e = (1, 0)$: $P_2 = -1/3$ and $\Delta T = +1/12$.",
        controls: &["The rod with friction as the one contact.", "Poisson's law in Newton's place where it goes wrong."],
        sources: &["chapter §7, the energy trap of Newton's law"],
        check: check!(one_contact),
    },
    Claim {
        id: "S7.four-generations",
        statement: "Four generations, Newton (17th century), Poisson (19th), Stronge (1990s, mending Kane's counterexample), Moreau \
            (1980s), are not replacements of one another but corrections of different defects.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: each mends what another leaves. Newton's law gains energy with friction, Poisson's does not;
            Poisson's $e = 1$ still loses normal work, Stronge's does not; Newton's law for all contacts may pull, Moreau's never does. As
            a chronology Moreau stands before Stronge, whose energetic restitution was published in 1990.",
        argument: r"The rod with $\mu = 1$ and $e = 1$: $\Delta T = 9/80$ under Newton, −9/125 under Poisson; the normal impulse takes
            27/1000 J under Poisson, 0 under Stronge. Four outcomes: $P_n = 41/40$ (Newton), $P_t = 6/25$ (Poisson), $P_t = 0$ (Moreau,
            full vector), and $U_n^{+2} = 62/125$ (Stronge). $W = (2, 1; 1, 2)$, $U^- = (-1, -1/4)$, $e = 1/2$: $P_2 = -1/4$ under Newton,
            0 under Moreau. Dates as cited, not checked.",
        controls: &[
            "The rod without friction, where the four agree.",
            r"Moreau's law with $e$ on the normal component alone; contacts that arrive alike, $U^- = (-1, -1)$.",
        ],
        sources: &["chapter §7, history", "Stronge, Proc. R. Soc. A 431 (1990), and J. Appl. Mech. 58 (1991) 1049 (titles and dates only)"],
        check: check!(four_laws),
    },
    Claim {
        id: "S7.table-newton",
        statement: r"Newton: $e = 1$ conserves energy, $e < 1$ dissipates; with several bodies it may gain energy (Kane). Above the table
            it is said that with friction, too, it goes wrong.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated. Without friction and with one $e$ for all contacts, solved together:
            $\Delta T = -\tfrac12(1 - e^2)U^{-T}W^{-1}U^-$, for any number of bodies. A gain needs friction, unequal coefficients, or
            impulses computed contact by contact.",
        argument: r"The identity holds exactly for every impact of a grid of two coupled contacts and $e = 0$, 1/2, 1. $W = (2, 1; 1, 2)$,
            $U^- = (-1, -1/2)$, $e = (1, 0)$ gains 1/12. One contact with friction gains +17/320 at $e = 9/10$.",
        controls: &["Impulses computed contact by contact; the rod without friction."],
        sources: &["chapter §7, table of impact laws, and the energy trap of Newton's law for friction"],
        check: check!(table),
    },
    Claim {
        id: "S7.e0-max-dissipation",
        statement: r"$e = 0$ is completely plastic and dissipates the most.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Without friction. With friction a rebound lengthens the rubbing, and $e = 1$ may take most.",
        argument: r"Without friction $\Delta T \propto -(1 - e^2)$. A particle of 1 kg with $U^- = (-1, 10)$, $\mu = 1/2$:
            $\Delta T = -43/8$, −243/32, −19/2 for $e = 0$, 1/2, 1.",
        controls: &["The particle without friction where there is some, and with friction where there is none."],
        sources: &["chapter §7, Newton's law"],
        check: check!(most_dissipative),
    },
    Claim {
        id: "S7.newton-pointwise-best",
        statement: "Newton's law is the most intuitive, and the most accurate for single points.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "Intuition cannot be checked, and accuracy would be a matter of measured collisions. What can be decided: for \
            one contact without friction all four laws are the same law, so none is more accurate.",
        argument: r"$W = 2$, $U^- = -1$, $e = 1/2$: $P = 3/4$ under Newton, Poisson and Moreau. The rod without friction, $e = 1$: one $P$
            under the three, and Stronge's $U_n^{+2}$ is that of Newton.",
        controls: &[r"The rod with friction, where they differ; two contacts with $e = (1/2, 0)$ in the place of the one."],
        sources: &["chapter §7, Newton's law"],
        check: check!(same_law),
    },
];

fn half() -> Rational {
    ratio(1, 2)
}

/// One contact without friction, W = 2, U⁻ = −1.
fn single() -> PlanarProblem<Rational> {
    impact(&[2], [ratio(-1, 1)])
}

/// ΔT of the rod \[J\].
fn rod_gain(law: PathLaw, friction: &Rational, restitution: &Rational) -> Result<Rational> {
    let path = rod_path(friction)?;
    gain(&path, law(&path, restitution))
}

fn one_contact(reading: Reading) -> Result<Vec<Finding>> {
    let elastic = ratio(1, 1);
    let subject = |restitution: Rational| match reading.only(0) {
        Reading::Recorded => Ok(single().energy_change(&newton::together(&single(), &[restitution])?)),
        Reading::Control(_) => rod_gain(newton::along, &ratio(1, 1), &restitution),
    };
    let law = reading.only(1).pick(newton::along as PathLaw, poisson::along);
    let (pulling, reversed) = unequal(reading.only(1).pick(newton::together as ContactsLaw, two_phases))?;
    Ok(vec![
        Finding::exact("energy gained by one contact, e = 1", &subject(elastic.clone())?, &ratio(0, 1), "J"),
        Finding::exact("the same, e = 1/2", &subject(half())?, &ratio(-3, 16), "J"),
        Finding::exact("one contact of a rod, μ = 1, e = 1", &rod_gain(law, &elastic, &elastic)?, &ratio(9, 80), "J"),
        Finding::exact("two contacts, e = (1, 0): P₂", &reversed.impulse[1], &ratio(-1, 3), "N·s"),
        Finding::exact("energy gained by them", &pulling.energy_change(&reversed), &ratio(1, 12), "J"),
    ])
}

/// Two contacts that lift each other, with e = (1, 0).
fn unequal(law: ContactsLaw) -> Result<(PlanarProblem<Rational>, Response<Rational>)> {
    let pulling = middle([ratio(-1, 1), ratio(-1, 2)]);
    let end = law(&pulling, &[ratio(1, 1), ratio(0, 1)])?;
    Ok((pulling, end))
}

/// P of Newton, Poisson and Moreau, with this coefficient on the sliding, and U_n⁺² of Stronge, on the rod with e = 1.
fn laws_on_the_rod(friction: &Rational, tangential: &Rational) -> Result<([Vec<Rational>; 3], Rational)> {
    let (path, e) = (rod_path(friction)?, ratio(1, 1));
    let moreau = moreau::two_coefficients(path.impact(), std::slice::from_ref(friction), &e, tangential)?;
    let impulses = [newton::along(&path, &e)?, poisson::along(&path, &e)?, moreau].map(|outcome| outcome.impulse.as_slice().to_vec());
    Ok((impulses, stronge::end(&path, &e)?.speed_squared))
}

fn four_laws(reading: Reading) -> Result<Vec<Finding>> {
    let (friction, e) = (reading.only(0).pick(ratio(1, 1), ratio(0, 1)), ratio(1, 1));
    let ([newton, poisson, moreau], stronge) = laws_on_the_rod(&friction, &reading.only(1).pick(ratio(1, 1), ratio(0, 1)))?;
    let different = newton != poisson && newton != moreau && poisson != moreau;
    let path = rod_path(&friction)?;
    let normal_work = path.normal_work(&ratio(0, 1), &(ratio(2, 1) * path.compression_end()));
    let lifted = middle([ratio(-1, 1), reading.only(1).pick(ratio(-1, 4), ratio(-1, 1))]);
    let [pulling, pushing] = [newton::together(&lifted, &[half(), half()])?, moreau::frictionless(&lifted, &[half(), half()])?];
    Ok(vec![
        Finding::decision("Newton, Poisson and Moreau differ on the rod", different, true),
        Finding::exact("P_n under Newton", &newton[0], &ratio(41, 40), "N·s"),
        Finding::exact("P_t under Poisson", &poisson[1], &ratio(6, 25), "N·s"),
        Finding::exact("P_t under Moreau, full vector", &moreau[1], &ratio(0, 1), "N·s"),
        Finding::exact("U_n⁺² under Stronge, 1 under Newton", &stronge, &ratio(62, 125), "m²/s²"),
        Finding::exact("ΔT under Newton", &gain(&path, newton::along(&path, &e))?, &ratio(9, 80), "J"),
        Finding::exact("ΔT under Poisson", &gain(&path, poisson::along(&path, &e))?, &ratio(-9, 125), "J"),
        Finding::exact("work of the normal impulse under Poisson, 0 under Stronge", &normal_work, &ratio(-27, 1000), "J"),
        Finding::exact("P₂ of two contacts under Newton", &pulling.impulse[1], &ratio(-1, 4), "N·s"),
        Finding::exact("P₂ of two contacts under Moreau", &pushing.impulse[1], &ratio(0, 1), "N·s"),
    ])
}

/// How many impacts of the grid break ΔT = −½(1 − e²)U⁻ᵀW⁻¹U⁻.
fn broken_identities(law: ContactsLaw) -> Result<usize> {
    let mut broken = 0;
    for impact in frictionless_grid(false) {
        let stored = energy(&impact, &impact.velocity)?;
        for e in [ratio(0, 1), half(), ratio(1, 1)] {
            let outcome = law(&impact, &[e.clone(), e.clone()])?;
            let predicted = -(half() * (ratio(1, 1) - &e * &e) * &stored);
            broken += usize::from(impact.energy_change(&outcome) != predicted);
        }
    }
    Ok(broken)
}

fn table(reading: Reading) -> Result<Vec<Finding>> {
    let (e, cradle) = (ratio(9, 10), cradle());
    let law = reading.pick(newton::together as ContactsLaw, newton::uncoupled);
    let together = law(&cradle, &[e.clone(), e.clone()])?;
    let friction = reading.pick(ratio(1, 1), ratio(0, 1));
    let (pulling, reversed) = unequal(law)?;
    // U⁻ᵀW⁻¹U⁻ = 2/3
    Ok(vec![
        Finding::count("frictionless impacts that break ΔT = −½(1 − e²)U⁻ᵀW⁻¹U⁻", broken_identities(law)?, 0),
        Finding::exact("energy gained with e = 9/10, three balls", &cradle.energy_change(&together), &ratio(-19, 300), "J"),
        Finding::exact("energy gained by two contacts, e = (1, 0)", &pulling.energy_change(&reversed), &ratio(1, 12), "J"),
        Finding::exact("energy gained by the rod with friction, e = 9/10", &rod_gain(newton::along, &friction, &e)?, &ratio(17, 320), "J"),
    ])
}

/// ΔT of a particle of 1 kg with U⁻ = (−1, 10) for e = 0, 1/2, 1.
fn particle(friction: &Rational) -> Result<[Rational; 3]> {
    let particle = impact(&[1, 0, 0, 1], [ratio(-1, 1), ratio(10, 1)]);
    let change = |e: Rational| moreau::normal_only(&particle, std::slice::from_ref(friction), &e).map(|end| particle.energy_change(&end));
    Ok([change(ratio(0, 1))?, change(half())?, change(ratio(1, 1))?])
}

fn most_dissipative(reading: Reading) -> Result<Vec<Finding>> {
    let smooth = particle(&reading.pick(ratio(0, 1), half()))?;
    let rough = particle(&reading.pick(half(), ratio(0, 1)))?;
    let least = |change: Finding| change.says_at_least(ratio(0, 1)).violating("no friction");
    Ok(vec![
        Finding::decision("e = 0 takes more energy than e = 1/2 and e = 1", smooth[0] < smooth[1] && smooth[0] < smooth[2], true),
        Finding::exact("ΔT with friction, e = 0", &rough[0], &ratio(-43, 8), "J").context(),
        Finding::exact("ΔT with friction, e = 1/2", &rough[1], &ratio(-243, 32), "J").context(),
        Finding::exact("ΔT with friction, e = 1", &rough[2], &ratio(-19, 2), "J").context(),
        least(Finding::exact("ΔT with friction, e = 1/2, less that of e = 0", &(&rough[1] - &rough[0]), &ratio(-71, 32), "J")),
        least(Finding::exact("ΔT with friction, e = 1, less that of e = 0", &(&rough[2] - &rough[0]), &ratio(-33, 8), "J")),
    ])
}

fn same_law(reading: Reading) -> Result<Vec<Finding>> {
    let (contact, e) = match reading {
        Reading::Recorded => (single(), vec![half()]),
        Reading::Control(_) => (ends([ratio(-1, 1), ratio(-1, 2)]), vec![half(), ratio(0, 1)]),
    };
    let laws = [newton::together(&contact, &e)?, two_phases(&contact, &e)?, moreau::frictionless(&contact, &e)?];
    let smooth = laws_on_the_rod(&reading.pick(ratio(0, 1), ratio(1, 1)), &ratio(1, 1))?;
    let squared = &rod().velocity[0] * &rod().velocity[0];
    let alike = smooth.0.iter().all(|law| *law == smooth.0[0]) && smooth.1 == squared;
    let mut findings = vec![
        Finding::decision("the laws agree on a frictionless rod", alike, true)
            .opinion("which law is the most intuitive, and the most accurate for single points"),
    ];
    for (law, end) in ["Newton", "Poisson", "Moreau"].into_iter().zip(laws) {
        findings.push(Finding::exact(format!("P under {law}"), &end.impulse[0], &ratio(3, 4), "N·s"));
    }
    Ok(findings)
}
