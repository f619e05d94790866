//! §11, convergence with friction: what Painlevé's configurations need, and who proved what when.

use crate::claims::experiments::identifiers;
use crate::claims::experiments::painleve::{answers, sliding_forces};
use crate::claims::lookups::{DZONOU, STEWART, STEWART_TRINKLE, year};
use crate::claims::prelude::*;
use moreau_exact::witness::{Part, Witness, decided};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S11.painleve",
        statement: "Stewart (1998) constructs the solution with an atom; so a solution exists in Painlevé's configurations, as a measure, \
            and the paradox of a hundred years is dissolved for good.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Existence is; uniqueness is not. Where no sliding force exists the step has one answer, an impulse that stays
            finite as $h \to 0$. Where two exist it has three, of which the construction takes one.",
        argument: r"The rod of S4.painleve-atom, $\mu = 2$: for $b = -5$ m/s² no sliding force and one answer, $P_n = 9/25 + (73/20)\,h$;
            for $b = +5$ m/s² three answers, at $h = 10^{-3}$, $10^{-4}$ and $10^{-5}$, in rationals.",
        controls: &[
            r"$\mu = 1$, below $\mu_P = 13/9$: one answer each, without an impulse that stays.",
            r"$b = +5$ m/s² in place of −5 m/s², where the end is being lifted.",
        ],
        sources: &["chapter §11, Painlevé as a by-product", "Stewart 1998 (not read)"],
        check: check!(painleve),
    },
    Claim {
        id: "S11.friction-split",
        statement: "The proof above (Stewart's, whose by-product is the solution of Painlevé's paradox) is the case without friction; with \
            friction convergence was first shown in 2007.",
        verdict: ClaimVerdict::Inconsistent,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"Painlevé's paradox needs friction, $\mu > \mu_P > 0$, and so does the Stewart–Trinkle scheme whose limit the
            proof takes. A proof that resolves it is one with friction.",
        argument: r"The rod at $b = -1$: with $\mu = 0$, 1 and 13/9 − 1/100 there is one sliding force, with $13/9 + 1/100$ and 2 there is
            none.",
        controls: &[
            r"A by-product at $\mu = 1/10$, where there is no paradox to resolve.",
            r"$b = +1$ in place of −1: no force is needed.",
        ],
        sources: &["chapter §11, four steps; Painlevé as a by-product; convergence with friction"],
        check: check!(needs_friction),
    },
    Claim {
        id: "S11.dmm",
        statement: r"Dzonou and Monteiro Marques (Nonlinear Anal. TMA 2007), by de Saxcé's bipotential: for sufficiently small $\mu$ and
            Lipschitz $M$ a subsequence of Moreau–Jean's solutions with Coulomb friction converges; the first rigorous result that
            time-stepping with friction converges.",
        verdict: ClaimVerdict::False,
        kind: Kind::Citation,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Cited,
        correct_statement: "Not the first: by the chapter's own account Stewart's proof of 1998 has friction, enough of it for Painlevé, \
            and Monteiro Marques's book of 1993 has “Shocks and Dry Friction” in its title. No such paper of 2007 was found; what was \
            found of these authors (2007, 2009) is about one constraint without friction, in its abstract.",
        argument: r"The rod is without a sliding force at $\mu = 2$, and not at 1/10, exactly. A proof that covers the rod at $\mu = 2$ is
            one with friction, and by the chapter's account there was one in 1998; a result for small $\mu$ does not reach so far.",
        controls: &[r"Painlevé's rod at $\mu = 1/10$, which has no paradox for the proof of 1998 to resolve."],
        sources: &[
            "chapter §11, convergence with friction",
            "Monteiro Marques, Differential Inclusions in Nonsmooth Mechanical Problems: Shocks and Dry Friction (1993), for title and \
                year",
            "Dzonou, Monteiro Marques and Paoli, Nonlinear Dynamics 58 (2009) 361 (abstract)",
        ],
        check: check!(first),
    },
    Claim {
        id: "S11.discontinuous-friction",
        statement: "With friction the core obstacle is that Coulomb's law is not semicontinuous: the direction of friction jumps where \
            sliding and sticking meet, and the closedness that step 4 uses no longer holds directly.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongReason),
        evidence: Evidence::Exact,
        correct_statement: "As a set-valued law Coulomb's has a closed graph, which is what step 4 uses; only the single-valued sign jumps \
            (and the set is not lower semicontinuous). What friction takes away is monotonicity: the law is not the normal-cone relation \
            of a fixed set.",
        argument: r"Slips $(3, 4)/5\cdot10^{-k}$ with $r = (1, -(3, 4)\mu/5)$: all in the law, and so is the limit, slip 0 with the same
            $r$. Two states of sliding with $r = (1, -\mu)$, slip 2, and $(10, -10\mu)$, slip 1:
            $\langle \Delta u, \Delta r\rangle = +9\mu$, where a monotone law has $\le 0$. Lifted by $u_n = \mu|u_t|$, as in the
            associated law: 0.",
        controls: &[r"The single-valued law, $r_t = 0$ at slip 0.", "Friction along the slip in place of against it."],
        sources: &["chapter §11, convergence with friction; exercise 2"],
        check: check!(closed_graph),
    },
    Claim {
        id: "S11.ten-years",
        statement: "With friction, which is not semicontinuous, the proof took ten years.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "Ten years, if counted from the proof of 1998, taken to be without friction, to 2007. Counted from the scheme \
            to the proof that covers Painlevé's configurations, and so friction, it took two.",
        argument: r"The scheme: 1996, from the SICI of its paper. The proof that resolves the paradox, which exists above $\mu_P = 13/9$
            only: 1998, two years later. From there to 2007: nine, ten to the nearest ten.",
        controls: &[
            r"A rod at $\mu = 1/10$ in place of that at $\mu = 2$: it has no paradox, and the proof of 1998 need not cover it.",
            r"A rod at $\mu = 2$ in place of that at $\mu = 1/10$: the first proof that covers it is that of 1998.",
        ],
        sources: &["chapter §11, pitfalls", "S11.friction-split", "S4.cites", "references/facts/literature.json, for the years"],
        check: check!(years),
    },
];

fn painleve(reading: Reading) -> Result<Vec<Finding>> {
    let friction = reading.only(0).pick(ratio(2, 1), ratio(1, 1));
    let down = reading.only(1).pick(ratio(-5, 1), ratio(5, 1));
    let mut findings = vec![Finding::count("sliding forces for b < 0", sliding_forces(&friction, -1)?, 0)];
    for exponent in [3, 4, 5] {
        let h = ratio(1, 10i64.pow(exponent));
        let falling = answers(&friction, &(&down * &h))?;
        findings.push(Finding::count(format!("answers for b < 0, h = 1e-{exponent} s"), falling.len(), 1));
        let expected = ratio(9, 25) + ratio(73, 20) * &h;
        findings.push(Finding::exact(format!("P_n, h = 1e-{exponent} s"), &falling[0], &expected, "N·s"));
        let rising = answers(&friction, &(ratio(5, 1) * &h))?;
        findings.push(
            Finding::count(format!("answers for b > 0, h = 1e-{exponent} s"), rising.len(), 3)
                .says(1)
                .violating("b < 0, where no sliding force exists"),
        );
    }
    Ok(findings)
}

fn needs_friction(reading: Reading) -> Result<Vec<Finding>> {
    let (zero, close, threshold) = (ratio(0, 1), ratio(1, 100), ratio(13, 9));
    let resolved = reading.only(0).pick(ratio(2, 1), ratio(1, 10));
    let covered = Finding::count("sliding forces of a rod that the proof covers, b = −1", sliding_forces(&resolved, -1)?, 0);
    let pushed = reading.only(1).pick(-1, 1);
    let counts = |of: &[Rational]| of.iter().map(|friction| sliding_forces(friction, pushed)).collect::<Result<Vec<_>>>();
    let below = counts(&[zero.clone(), ratio(1, 1), &threshold - &close])?;
    let beyond = counts(&[&threshold + &close, ratio(2, 1)])?;
    let exists = |count: &&usize| **count == 0;
    Ok(vec![
        // the paradox, no sliding force, which there is from 13/9 on; without friction there is one force
        covered.clone().says(usize::from(resolved < threshold)).passage("Painlevé as a by-product"),
        covered.says(1usize).passage("convergence with friction: the proof above is without"),
        Finding::count("rods without a sliding force at μ = 13/9 + 1/100 and 2, b = −1", beyond.iter().filter(exists).count(), 2),
        Finding::count("rods without a sliding force at μ = 0, 1 and 13/9 − 1/100", below.iter().filter(exists).count(), 0).context(),
    ])
}

fn first(reading: Reading) -> Result<Vec<Finding>> {
    let friction = reading.pick(ratio(2, 1), ratio(1, 10));
    let paradox = sliding_forces(&friction, -1)? == 0;
    Ok(vec![
        Finding::decision("the paradox that a proof of 1998 resolves is one with friction", paradox && friction > ratio(0, 1), true)
            .says(false)
            .looked_up(),
        Finding::count("sliding forces at small friction, μ = 1/10, b = −1", sliding_forces(&ratio(1, 10), -1)?, 1).context(),
    ])
}

/// Whether (u_t, r) is in Coulomb's law of a closed contact, exactly: ‖r_t‖ ≤ μ r_n, and r_t = −μ r_n u_t/‖u_t‖ where the body slides.
fn in_coulombs_law(friction: &Rational, slip: [&Rational; 2], impulse: [&Rational; 3]) -> bool {
    let numbers = |of: &[&Rational]| Part::Vector(of.iter().map(|number| (*number).clone()).collect());
    let velocity = [&ratio(0, 1), slip[0], slip[1]];
    let vectors = || [("velocity", numbers(&velocity)), ("impulse", numbers(&impulse)), ("friction", friction.into())];
    let decide = || opposes(friction, slip, impulse);
    decided(decide, |found| Some(Witness::new("coulomb", vectors().into_iter().chain([("answer", (*found).into())]).collect())))
}

fn opposes(friction: &Rational, slip: [&Rational; 2], impulse: [&Rational; 3]) -> bool {
    let zero = ratio(0, 1);
    let [x, y] = slip;
    let [normal, along, across] = impulse;
    let limit = friction * normal;
    let within = along * along + across * across;
    if *x == zero && *y == zero {
        return *normal >= zero && within <= &limit * &limit;
    }
    let opposite = along * x + across * y <= zero && along * y == across * x;
    *normal >= zero && opposite && within == &limit * &limit
}

/// The same with r_t = 0 where the body does not slide.
fn in_the_single_valued_law(friction: &Rational, slip: [&Rational; 2], impulse: [&Rational; 3]) -> bool {
    let zero = ratio(0, 1);
    let sticks = slip.iter().all(|part| **part == zero);
    in_coulombs_law(friction, slip, impulse) && (!sticks || impulse[1..].iter().all(|part| **part == zero))
}

/// A law of friction: whether it holds (μ, slip, impulse).
type Law = fn(&Rational, [&Rational; 2], [&Rational; 3]) -> bool;

fn closed_graph(reading: Reading) -> Result<Vec<Finding>> {
    let law = reading.only(0).pick(in_coulombs_law as Law, in_the_single_valued_law);
    let (friction, zero, one) = (ratio(1, 2), ratio(0, 1), ratio(1, 1));
    let along = reading.only(1).pick(ratio(-1, 1), ratio(1, 1)) * &friction;
    let force = [ratio(3, 5) * &along, ratio(4, 5) * &along];
    let holds = |size: Rational| {
        let slip = [ratio(3, 5) * &size, ratio(4, 5) * &size];
        law(&friction, [&slip[0], &slip[1]], [&one, &force[0], &force[1]])
    };
    let members = [0, 3, 6, 9].into_iter().filter(|k| holds(ratio(1, 10i64.pow(*k)))).count();
    // ⟨Δu, Δr⟩ of (slip 2, r = (1, −μ)) and (slip 1, r = (10, −10μ)), the normal velocities 0 or μ times the slip
    let [normal, tangential] = [ratio(1 - 10, 1), (ratio(10, 1) - &one) * &friction];
    let lifted = &friction * ratio(2 - 1, 1);
    Ok(vec![
        Finding::count("slips of 1, 10⁻³, 10⁻⁶ and 10⁻⁹ m/s that are in the law with one impulse", members, 4),
        Finding::decision("and so is the limit, slip 0", holds(zero.clone()), true).says(false),
        Finding::exact("⟨Δu, Δr⟩ of Coulomb's law", &tangential, &ratio(9, 2), "J").context(),
        Finding::exact("⟨Δu, Δr⟩ with the associated law's lift", &(lifted * normal + &tangential), &zero, "J").context(),
    ])
}

/// The year of the first proof that covers the rod with this friction: where the rod is in Painlevé's paradox, that of the proof that
/// resolves it, else that of the one that the chapter calls the first with friction.
fn first_proof(friction: &Rational) -> Result<usize> {
    year(if sliding_forces(friction, -1)? == 0 { STEWART } else { DZONOU })
}

fn years(reading: Reading) -> Result<Vec<Finding>> {
    let friction = reading.only(0).pick(ratio(2, 1), ratio(1, 10));
    let with_friction = first_proof(&reading.only(1).pick(ratio(1, 10), ratio(2, 1)))?;
    let scheme = identifiers::year(&STEWART_TRINKLE.text("sici")?).unwrap_or_default();
    let covered = first_proof(&friction)? - scheme;
    let nearest_ten = |years: usize| (years + 5) / 10 * 10;
    Ok(vec![
        Finding::count(
            "years from the proof of 1998 to one for small friction, to the nearest ten",
            nearest_ten(with_friction - year(STEWART)?),
            10,
        )
        .reading("from the proof of 1998 to that of 2007")
        .looked_up(),
        Finding::count("years from the scheme, to the nearest ten", nearest_ten(covered), 0)
            .says(10)
            .reading("from the scheme to the first proof that covers the rod")
            .looked_up(),
        Finding::count("years from the scheme to the first proof that covers the rod", covered, 2).context(),
    ])
}
